// Hashing frames.
#include "renderer/scene/frame.h"

#include "renderer/base/hash.h"

void dip_frame_hash(const DipFrame *frame, char hex[33]) {
    // The size is hashed too: frames of 2x1 and 1x2 pixels may have the same bytes.
    DipHash hash = dip_hash_begin((uint64_t)frame->width << 32 ^ (uint64_t)frame->height);
    for (int y = 0; y < frame->height; y++) {
        dip_hash_bytes(&hash, frame->rgba8 + (size_t)y * frame->stride_bytes,
                       (size_t)frame->width * 4);
    }
    dip_hash_hex(&hash, hex);
}
