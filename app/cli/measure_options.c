// The rows --rounds, --seed and --starts.
#include "app/cli/measure_options.h"

#include "renderer/base/assert.h"
#include "renderer/base/clock.h"

#include <stdint.h>

#define FIELD(name) offsetof(DipMeasureOptions, name)

static const DipOptionRow rows[] = {
    {.name = "--rounds",
     .argument = "N",
     .text = "Time in this many rounds; with --starts, in this many of each start. A round draws "
             "everything that is compared once, in a new random order. The default is 4 for cost, "
             "10 for bench, and 8 for cost axes and cost diff (1 if cost diff compares a program "
             "with a report).",
     .kind = DIP_OPTION_INTEGER,
     .field = FIELD(rounds),
     .least = 1,
     .most = DIP_MEASURE_MOST_ROUNDS},
    {.name = "--seed",
     .argument = "N",
     .text = "Seed of the random order of frames. The default comes from the clock.",
     .kind = DIP_OPTION_INTEGER,
     .field = FIELD(seed),
     .given = FIELD(has_seed),
     .most = INT32_MAX},
};

static const DipOptionRow start_rows[] = {
    {.name = "--starts",
     .argument = "N",
     .text = "Start the programs that draw anew this many times, because each start has luck of "
             "its own. The default is 4 for cost, or 2 if a start takes long, and 6 for cost "
             "diff. With 1, cost draws in its own process.",
     .kind = DIP_OPTION_INTEGER,
     .field = FIELD(starts),
     .least = 1,
     .most = DIP_MEASURE_MOST_STARTS},
};

const DipOptionTable dip_measure_option_table = {"Timing", rows, DIP_ARRAY_COUNT(rows)};
const DipOptionTable dip_starts_option_table = {"Starts", start_rows, DIP_ARRAY_COUNT(start_rows)};

int dip_measure_seed(const DipMeasureOptions *options) {
    return options->has_seed ? options->seed : (int)(dip_clock_ns() / 1000 % 1000000);
}
