// Encodes pictures as PNG and JPEG, and writes PNG and PFM files.
#ifndef DIP_APP_FILES_PICTURES_H
#define DIP_APP_FILES_PICTURES_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"
#include "renderer/scene/frame.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    DIP_MAX_WRITTEN_PIXELS = 1 << 28, // greatest width * height of a picture: 16384x16384
    DIP_MAX_JPEG_SIZE = 65535,        // greatest width and height of a JPEG
};

// A text in a PNG file. The keyword says what the text is, for example "Software".
typedef struct DipPngText {
    const char *keyword; // 1 to 79 ASCII characters: words separated by single spaces.
    const char *text;    // UTF-8. A byte that is not part of valid UTF-8 is written as '?'.
} DipPngText;

// Encodes 8-bit RGBA pixels, the top row first, as an RGB PNG in memory; alpha is left out. The
// caller frees *bytes. Returns false when memory runs out, or if the picture has no pixels or more
// than DIP_MAX_WRITTEN_PIXELS. Thread-safe.
DIP_API bool dip_png_encode(const uint8_t *rgba8, size_t stride_bytes, int width, int height,
                            unsigned char **bytes, size_t *size_bytes);

// Encodes 8-bit indices into a palette of 256 sRGB colours, 3 bytes each, as a PNG in memory. The
// rows of indices are packed, the top row first. The caller frees *bytes. Returns false as
// dip_png_encode does. Thread-safe.
DIP_API bool dip_png_encode_indexed(const uint8_t *indices, const uint8_t *palette, int width,
                                    int height, unsigned char **bytes, size_t *size_bytes);

// Encodes 8-bit RGBA pixels, the top row first, as a JPEG in memory; alpha is left out. `quality`
// is 1..100; above 90, colour has the full resolution. The caller frees *bytes. Returns false as
// dip_png_encode does, and if `quality` is out of range or the picture is wider or higher than
// DIP_MAX_JPEG_SIZE. Thread-safe.
DIP_API bool dip_jpeg_encode(const uint8_t *rgba8, size_t stride_bytes, int width, int height,
                             int quality, unsigned char **bytes, size_t *size_bytes);

// Writes 8-bit RGBA pixels, the top row first, as a PNG file, whole or not at all (whole_file.h);
// alpha is left out. Fails with MISSING if rgba8 is NULL, with RANGE if the picture has no pixels,
// or more than DIP_MAX_WRITTEN_PIXELS, or stride_bytes is less than a row, and with IO or MEMORY.
DIP_API bool dip_png_write_rgba8(const char *file, const uint8_t *rgba8, size_t stride_bytes,
                                 int width, int height, DipError *err);

// Writes a frame's pixels as dip_png_write_rgba8 does.
DIP_API bool dip_png_write(const char *file, const DipFrame *frame, DipError *err);

// Does what dip_png_write does, and inserts texts into the file, before the picture.
DIP_API bool dip_png_write_with_texts(const char *file, const DipFrame *frame,
                                      const DipPngText *texts, int count, DipError *err);

// Writes 32-bit floating-point values without loss to a PFM file ("portable float map"), whole or
// not at all (whole_file.h). `rgb` holds three floats per pixel in packed rows, the top row first.
// The file has the type PF and the scale -1, which means little-endian. As the format demands, its
// rows go from the bottom up. Fails as dip_png_write_rgba8 does. Thread-safe for different files.
DIP_API bool dip_pfm_write(const char *file, const float *rgb, int width, int height,
                           DipError *err);

#ifdef __cplusplus
}
#endif

#endif
