// Pictures as JPEG files.
#ifndef DIP_APP_FILES_JPEG_H
#define DIP_APP_FILES_JPEG_H

#include "renderer/base/api.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Encodes 8-bit RGBA pixels, the top row first, as a JPEG in memory; alpha is left out. `quality`
// is 1..100; above 90, colour has the full resolution. The caller frees *bytes. Returns false when
// memory runs out. Thread-safe.
DIP_API bool dip_jpeg_encode(const uint8_t *rgba8, size_t stride_bytes, int width, int height,
                             int quality, unsigned char **bytes, size_t *size_bytes);

#ifdef __cplusplus
}
#endif

#endif
