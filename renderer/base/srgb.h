// Conversion between sRGB and linear light: a slow, precise function for use at set-up, and fast
// tables for use per pixel.
//
// The formulas follow IEC 61966-2-1. The functions use only + - * /, so the tables are the same on
// every machine. A code is an 8-bit encoded value, 0..255. All functions are thread-safe.
#ifndef DIP_RENDERER_BASE_SRGB_H
#define DIP_RENDERER_BASE_SRGB_H

#include "renderer/base/api.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Decodes an sRGB value 0..1 to linear light 0..1. The relative error is below 1e-14.
DIP_API double dip_srgb_decode(double encoded);

// Linear light, 0..1, of the 256 sRGB codes.
typedef struct DipSrgbDecodeTable {
    double linear[256];
} DipSrgbDecodeTable;

DIP_API void dip_srgb_decode_table(DipSrgbDecodeTable *table);

// sRGB codes of 16-bit linear light: code[i] = floor(255 * encode(i / 65535) + 0.5), where encode
// is the inverse of dip_srgb_decode. The table has three more entries, so that a kernel can read
// four bytes from any i on.
enum { DIP_LINEAR16_MAX = 65535 };
typedef struct DipSrgbEncodeTable {
    uint8_t code[DIP_LINEAR16_MAX + 1 + 3];
} DipSrgbEncodeTable;

DIP_API void dip_srgb_encode_table(DipSrgbEncodeTable *table);

#ifdef __cplusplus
}
#endif

#endif
