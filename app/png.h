// Frames to PNG files.
#ifndef DIP_APP_PNG_H
#define DIP_APP_PNG_H

#include "renderer/base/error.h"
#include "renderer/frame.h"

// Writes the file whole or not at all: under another name first, then renamed.
bool dip_png_write(const char *file, const DipFrame *frame, DipError *err);

#endif
