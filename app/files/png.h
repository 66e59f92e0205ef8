// Frames to PNG files.
#ifndef DIP_APP_FILES_PNG_H
#define DIP_APP_FILES_PNG_H

#include "renderer/base/error.h"
#include "renderer/scene/frame.h"

// A PNG in memory: free() it. Alpha is left out. False when memory runs out.
bool dip_png_encode(const uint8_t *rgba8, size_t stride_bytes, int width, int height,
                    unsigned char **bytes, size_t *size_bytes);

// Writes the file whole or not at all: under another name first, then renamed.
bool dip_png_write(const char *file, const DipFrame *frame, DipError *err);

#endif
