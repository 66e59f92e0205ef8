// Pictures as PFM files ("portable float map"): 32-bit floating point, without loss.
#ifndef DIP_APP_FILES_PFM_H
#define DIP_APP_FILES_PFM_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// Writes the whole file or none. `rgb` holds three floats per pixel in packed rows, the top row
// first. The file has the type PF, the scale -1 (little-endian) and, as the format demands, its
// rows from the bottom up. Fails with DIP_ERROR_IO or DIP_ERROR_MEMORY. Thread-safe for different
// files.
DIP_API bool dip_pfm_write(const char *file, const float *rgb, int width, int height,
                           DipError *err);

#ifdef __cplusplus
}
#endif

#endif
