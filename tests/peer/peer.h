// The peer as a whole: a scene drawn by llvmpipe from a pose, with the settings both know.
#ifndef DIP_TESTS_PEER_PEER_H
#define DIP_TESTS_PEER_PEER_H

#include "renderer/base/error.h"
#include "renderer/scene/pose.h"
#include "renderer/scene/scene.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct DipPeer DipPeer;

// def is borrowed for the peer's life. threads: llvmpipe's rasteriser threads. One peer per
// process, used on the thread that made it. Fails with UNSUPPORTED where llvmpipe is not there.
DipPeer *dip_peer_create(const DipSceneDef *def, int width, int height, int threads, DipError *err);
void dip_peer_destroy(DipPeer **peer);

const char *dip_peer_renderer(const DipPeer *peer); // valid as long as the peer
const char *dip_peer_version(const DipPeer *peer);

// Settings of the next frames. sample_count: 1 or 4; max_anisotropy: 1 (trilinear)..16.
bool dip_peer_set(DipPeer *peer, int sample_count, int max_anisotropy, DipError *err);

// Returns when the picture is complete in memory.
void dip_peer_draw(DipPeer *peer, const DipPose *pose);

// Copies the last picture: width * height sRGB pixels R, G, B, A, the top row first.
bool dip_peer_read(DipPeer *peer, uint8_t *rgba8, DipError *err);

#endif
