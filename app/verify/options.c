// The options of `diptych verify`.
#include "app/verify/options.h"

#include "renderer/base/assert.h"
#include "renderer/base/pool.h"

#define FIELD(name) offsetof(DipVerifyOptions, name)

static const DipOptionRow rows[] = {
    {.name = "--threads",
     .argument = "N",
     .text =
         "Compare one thread with this many threads. 0, the default, stands for all processors, "
         "but at least 2 threads.",
     .kind = DIP_OPTION_INTEGER,
     .field = FIELD(threads),
     .least = 0,
     .most = DIP_MAX_THREADS},
    {.name = "--all",
     .text = "Run as many cases of every hard case as the tests do. This takes a few minutes.",
     .kind = DIP_OPTION_FLAG,
     .field = FIELD(all)},
    {.name = "--list",
     .text = "Also print every promise, its bound and the greatest error found.",
     .kind = DIP_OPTION_FLAG,
     .field = FIELD(verbose)},
};

static const DipOptionTable table = {"What to verify", rows, DIP_ARRAY_COUNT(rows)};

static const DipOptionPart parts[] = {
    {&table, 0},
    {&dip_program_option_table, FIELD(program)},
};
const DipOptionParts dip_verify_option_parts = {parts, DIP_ARRAY_COUNT(parts)};
