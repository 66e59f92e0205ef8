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

enum { DIP_LINEAR16_MAX = 65535 };

// The sRGB codes of 16-bit linear light, in 8 KB, so that most of them stay in the first-level
// cache. In a run of 16 values that starts at a multiple of 16, the code rises at most once, by 1.
// The entry of a run is 16 times its first code, plus the number of its values that have the next
// code. The table has one more entry, so that a kernel can read four bytes from any entry on.
enum { DIP_SRGB_RUN = 16 };
typedef struct DipSrgbEncodeTable {
    uint16_t runs[(DIP_LINEAR16_MAX + 1) / DIP_SRGB_RUN + 1];
} DipSrgbEncodeTable;

DIP_API void dip_srgb_encode_table(DipSrgbEncodeTable *table);

// Returns floor(255 * encode(linear16 / 65535) + 0.5), where encode is the inverse of
// dip_srgb_decode. linear16 must lie within 0..DIP_LINEAR16_MAX.
static inline uint8_t dip_srgb_code(const DipSrgbEncodeTable *table, int32_t linear16) {
    const uint32_t light = (uint32_t)linear16;
    return (uint8_t)((table->runs[light / DIP_SRGB_RUN] + light % DIP_SRGB_RUN) / DIP_SRGB_RUN);
}

#ifdef __cplusplus
}
#endif

#endif
