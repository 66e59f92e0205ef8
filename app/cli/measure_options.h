// Declares the options for timing frames, which several commands share.
#ifndef DIP_APP_CLI_MEASURE_OPTIONS_H
#define DIP_APP_CLI_MEASURE_OPTIONS_H

#include "app/cli/options.h"
#include "app/measure/timing/sample.h"

enum { DIP_MEASURE_MOST_ROUNDS = 10000, DIP_MEASURE_MOST_STARTS = DIP_TIMED_MOST_STARTS };

typedef struct DipMeasureOptions {
    int rounds; // Number of rounds of each start (driver.h); 0 if the command chooses.
    int starts; // Number of starts (driver.h). If it is 1, `diptych cost` draws in its own process.
    bool has_seed;
    int seed;
} DipMeasureOptions;

extern const DipOptionTable dip_measure_option_table; // --rounds --seed; fills DipMeasureOptions.
extern const DipOptionTable dip_starts_option_table;  // --starts; fills DipMeasureOptions.
extern const DipOptionTable dip_serve_option_table;   // --serve; fills a bool.
extern const DipOptionTable dip_json_option_table;    // --json; fills a `const char *`.

// Returns the seed that was given, or a seed from the clock if none was given.
int dip_measure_seed(const DipMeasureOptions *options);

#endif
