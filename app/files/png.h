// Pictures as PNG files.
#ifndef DIP_APP_FILES_PNG_H
#define DIP_APP_FILES_PNG_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"
#include "renderer/scene/frame.h"

#ifdef __cplusplus
extern "C" {
#endif

// A text in a PNG file: what it is, such as "Software", and its content.
typedef struct DipPngText {
    const char *keyword; // 1 to 79 letters of ASCII, words separated by single spaces.
    const char *text;    // UTF-8. A byte that is not part of valid UTF-8 is written as '?'.
} DipPngText;

// Encodes 8-bit RGBA pixels, the top row first, as an RGB PNG in memory; alpha is left out. The
// caller frees *bytes. Returns false when memory runs out. Thread-safe.
DIP_API bool dip_png_encode(const uint8_t *rgba8, size_t stride_bytes, int width, int height,
                            unsigned char **bytes, size_t *size_bytes);

// Encodes 8-bit indices into a palette of 256 sRGB colours, 3 bytes each, as a PNG in memory. The
// rows of indices are packed, the top row first. The caller frees *bytes. Returns false when memory
// runs out. Thread-safe.
DIP_API bool dip_png_encode_indexed(const uint8_t *indices, const uint8_t *palette, int width,
                                    int height, unsigned char **bytes, size_t *size_bytes);

// Inserts texts into a PNG in memory that dip_png_encode has made: before its picture, as a chunk
// tEXt each, or iTXt if the text has characters beyond ASCII. *bytes may move. Returns false, and
// leaves the PNG as it is, when memory runs out. Thread-safe.
DIP_API bool dip_png_add_texts(unsigned char **bytes, size_t *size_bytes, const DipPngText *texts,
                               int count);

// Writes a frame to a file, whole or not at all (whole_file.h). Fails with DIP_ERROR_IO or
// DIP_ERROR_MEMORY.
DIP_API bool dip_png_write(const char *file, const DipFrame *frame, DipError *err);

// Does the same with texts in the file.
DIP_API bool dip_png_write_with_texts(const char *file, const DipFrame *frame,
                                      const DipPngText *texts, int count, DipError *err);

#ifdef __cplusplus
}
#endif

#endif
