// Describes the options --rounds, --seed, --starts, --serve and --json in tables (options.h).
#include "app/cli/measure_options.h"

#include "renderer/base/assert.h"
#include "renderer/base/clock.h"

#include <stdint.h>

#define FIELD(name) offsetof(DipMeasureOptions, name)

static const DipOptionRow rows[] = {
    {"--rounds", "N", DIP_OPTION_INTEGER, FIELD(rounds), .least = 1,
     .most = DIP_MEASURE_MOST_ROUNDS,
     .text = "Time in this many rounds; with --starts, in this many for each start. A round "
             "visits all sets of settings that are compared, in a new random order. In cost, a "
             "visit draws only some of the frames, and the rounds together draw all of them. The "
             "default is 4 for cost, 10 for bench, and 8 for cost diff (1 if it compares a program "
             "with a report)."},
    {"--seed", "N", DIP_OPTION_INTEGER, FIELD(seed), .given = FIELD(has_seed), .most = INT32_MAX,
     .text = "Seed of the random order of frames. The default comes from the clock."},
};

static const DipOptionRow start_rows[] = {
    {"--starts", "N", DIP_OPTION_INTEGER, FIELD(starts), .least = 1,
     .most = DIP_MEASURE_MOST_STARTS,
     .text = "Start the drawing programs this many times, because each start has luck of "
             "its own. The default is 4 for cost, or 2 if a start takes long, and 6 for cost "
             "diff. With 1, cost draws in its own process."},
};

static const DipOptionRow serve_rows[] = {
    {"--serve", NULL, DIP_OPTION_FLAG,
     .text = "Draw the frames that standard input asks for. This option is only for --starts of "
             "cost and --vs of bench, which start programs with it."},
};

static const DipOptionRow json_rows[] = {
    {"--json", "FILE", DIP_OPTION_TEXT, .text = "Also write the result to this file, as JSON."},
};

const DipOptionTable dip_measure_option_table = DIP_OPTION_TABLE("Timing", rows);
const DipOptionTable dip_starts_option_table = DIP_OPTION_TABLE("Starts", start_rows);
const DipOptionTable dip_serve_option_table = DIP_OPTION_TABLE("Starts", serve_rows);
const DipOptionTable dip_json_option_table = DIP_OPTION_TABLE("Output", json_rows);

int dip_measure_seed(const DipMeasureOptions *options) {
    return options->has_seed ? options->seed : (int)(dip_clock_ns() / 1000 % 1000000);
}
