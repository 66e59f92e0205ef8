// Makes the parts of a YUV4MPEG2 stream ("y4m"). Such a stream is video without compression, and
// ffmpeg, mpv and encoders read it. The stream begins with one header. For each frame, the line
// "FRAME" and three planes of bytes follow.
//
// The streams have the format C444: the planes Y, Cb and Cr hold one byte per pixel, so chroma is
// not subsampled. The matrix is that of ITU-R BT.709, and the range is limited: black is Y = 16,
// white is Y = 235, and grey is Cb = Cr = 128. The header names the format and the range. It cannot
// name the matrix, so a player may guess another one.
#ifndef DIP_APP_FILES_Y4M_H
#define DIP_APP_FILES_Y4M_H

#include "renderer/base/api.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// A frame rate as an exact ratio: `frames` frames in `seconds` seconds, both at least 1.
typedef struct DipFrameRate {
    int64_t frames;
    int64_t seconds;
} DipFrameRate;

// Returns the same rate with the smallest numbers.
DIP_API DipFrameRate dip_frame_rate_reduce(DipFrameRate rate);

enum { DIP_Y4M_HEADER_SIZE = 160 }; // Greatest number of bytes that dip_y4m_header writes.

// Writes the stream's header with its line feed and a final 0. Returns its length without the 0.
DIP_API size_t dip_y4m_header(int width, int height, DipFrameRate rate,
                              char header[DIP_Y4M_HEADER_SIZE]);

// Converts packed RGB pixels of 3 bytes each to the planes Y, Cb and Cr, `count` bytes each, one
// plane after the other. Every value is the exact result rounded to the nearest integer; a half is
// rounded up. Thread-safe.
DIP_API void dip_y4m_planes(const uint8_t *rgb, size_t count, uint8_t *planes);

#ifdef __cplusplus
}
#endif

#endif
