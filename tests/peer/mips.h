// The mip levels of a texture with 8 bits per channel, as both peers use them.
#ifndef DIP_TESTS_PEER_MIPS_H
#define DIP_TESTS_PEER_MIPS_H

#include "renderer/scene/scene.h"

#include <stdbool.h>
#include <stdint.h>

// Receives a level: width * height texels R, G, B, A, which are valid during the call. Returns
// false to stop.
typedef bool DipPeerMipSink(void *context, int level, int width, int height, const uint8_t *rgba8,
                            DipError *err);

int dip_peer_mip_count(const DipTextureDef *def);

// Hands all levels to the sink, the largest first. Level 0 has def's texels. Our own box filter
// computes the smaller levels in linear light and rounds them to def's encoding.
bool dip_peer_mips(const DipTextureDef *def, DipPeerMipSink *sink, void *context, DipError *err);

#endif
