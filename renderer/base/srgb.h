// sRGB and linear light: exact functions for set-up, tables for pixels.
//
// IEC 61966-2-1. Computed with + - * / alone, so every machine has the same tables.
#ifndef DIP_RENDERER_BASE_SRGB_H
#define DIP_RENDERER_BASE_SRGB_H

#include "renderer/base/api.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// encoded 0..1 -> linear 0..1; relative error below 1e-14.
DIP_API double dip_srgb_decode(double encoded);

// Linear light of the 256 codes.
typedef struct DipSrgbDecodeTable {
    double linear[256];
} DipSrgbDecodeTable;

DIP_API void dip_srgb_decode_table(DipSrgbDecodeTable *table);

// code[i] = floor(255 * encode(i / 65535) + 0.5); padded so that four bytes may be read at any i.
enum { DIP_LINEAR16_MAX = 65535 };
typedef struct DipSrgbEncodeTable {
    uint8_t code[DIP_LINEAR16_MAX + 1 + 3];
} DipSrgbEncodeTable;

DIP_API void dip_srgb_encode_table(DipSrgbEncodeTable *table);

#ifdef __cplusplus
}
#endif

#endif
