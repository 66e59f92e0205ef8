// The options of `diptych verify`.
#include "app/verify/options.h"

#include "renderer/base/assert.h"
#include "renderer/base/pool.h"

#define FIELD(name) offsetof(DipVerifyOptions, name)

static const DipOptionRow rows[] = {
    {"--threads", "N", DIP_OPTION_INTEGER, FIELD(threads), .least = 0, .most = DIP_MAX_THREADS,
     .text =
         "Compare one thread with this many threads. 0, the default, stands for all processors, "
         "but at least 2 threads."},
    {"--all", NULL, DIP_OPTION_FLAG, FIELD(all),
     .text = "Run as many cases of every hard case as the tests do. This takes a few minutes."},
    {"--list", NULL, DIP_OPTION_FLAG, FIELD(verbose),
     .text = "Also print every promise, its bound and the greatest error found."},
};

static const DipOptionTable table = DIP_OPTION_TABLE("What to verify", rows);

static const DipOptionPart parts[] = {
    {&table, 0},
    {&dip_program_option_table, FIELD(program)},
};
const DipOptionParts dip_verify_option_parts = {parts, DIP_ARRAY_COUNT(parts)};
