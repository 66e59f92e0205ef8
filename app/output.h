// Standard output that may be full, such as a file on a full disk.
#ifndef DIP_APP_OUTPUT_H
#define DIP_APP_OUTPUT_H

#include "renderer/base/error.h"

#include <stdbool.h>

// Writes what standard output still holds back. Fails with IO if anything that the program printed
// was lost. Call it once, at the end.
bool dip_output_finish(DipError *err);

#endif
