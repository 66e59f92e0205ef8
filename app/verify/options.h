// Options of `diptych verify`.
#ifndef DIP_APP_VERIFY_OPTIONS_H
#define DIP_APP_VERIFY_OPTIONS_H

#include "app/cli/command.h"

#include <stdbool.h>

typedef struct DipVerifyOptions {
    DipProgramOptions program;
    bool all;     // Run as many cases of each row as ./test does.
    int threads;  // Greatest number of threads; 0: all processors.
    bool verbose; // Print a line for every row.
} DipVerifyOptions;

extern const DipOptionParts dip_verify_option_parts;

#endif
