// Checks that everything printed has been written to standard output. The output may be a file on
// a full disk.
#ifndef DIP_APP_CLI_OUTPUT_H
#define DIP_APP_CLI_OUTPUT_H

#include "renderer/base/error.h"

#include <stdbool.h>

// Flushes standard output. Fails with DIP_ERROR_IO if anything that the program printed was lost.
// Call it once, at the end of the program.
bool dip_output_finish(DipError *err);

#endif
