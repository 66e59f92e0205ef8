// Hashing frames.
#include "renderer/scene/frame.h"

#include <stdio.h>

// FNV-1a, 64 bit: offset basis and prime.
#define FNV_BASIS 0xcbf29ce484222325u
#define FNV_PRIME 0x100000001b3u

void dip_frame_hash(const DipFrame *frame, char hex[33]) {
    // The second lane starts elsewhere and takes every byte inverted, so that the two differ.
    uint64_t a = FNV_BASIS;
    uint64_t b = FNV_BASIS ^ (uint64_t)frame->width << 32 ^ (uint64_t)frame->height;
    for (int y = 0; y < frame->height; y++) {
        const uint8_t *row = frame->rgba8 + (size_t)y * frame->stride_bytes;
        for (size_t i = 0; i < (size_t)frame->width * 4; i++) {
            a = (a ^ row[i]) * FNV_PRIME;
            b = (b ^ (uint8_t)~row[i]) * FNV_PRIME;
        }
    }
    snprintf(hex, 33, "%016llx%016llx", (unsigned long long)a, (unsigned long long)b);
}
