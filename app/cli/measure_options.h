// Declares the options that all commands share that time frames.
#ifndef DIP_APP_CLI_MEASURE_OPTIONS_H
#define DIP_APP_CLI_MEASURE_OPTIONS_H

#include "app/cli/options.h"

enum { DIP_MEASURE_MOST_ROUNDS = 10000, DIP_MEASURE_MOST_STARTS = 100 };

typedef struct DipMeasureOptions {
    int rounds; // Number of rounds of each start; 0: the command chooses.
    int starts; // How often programs are started.
    bool has_seed;
    int seed;
} DipMeasureOptions;

// Options of a command that starts its own program again, to draw in another process.
typedef struct DipServeOptions {
    bool serve; // This process was started to draw for another one.
    int argc;   // The whole command line.
    char *const *argv;
} DipServeOptions;

extern const DipOptionTable dip_measure_option_table; // --rounds --seed
extern const DipOptionTable dip_starts_option_table;  // --starts
extern const DipOptionTable dip_serve_option_table;   // --serve, of DipServeOptions
extern const DipOptionTable dip_json_option_table;    // --json, for the file's name

// Returns the seed that was given, or one from the clock.
int dip_measure_seed(const DipMeasureOptions *options);

#endif
