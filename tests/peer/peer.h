// The peer is one of Mesa's software renderers, with which the peer bench compares Diptych's
// renderer: llvmpipe by OpenGL, or lavapipe by Vulkan. It draws a scene from a pose, with the
// settings that Diptych and the peer have in common.
#ifndef DIP_TESTS_PEER_PEER_H
#define DIP_TESTS_PEER_PEER_H

#include "renderer/base/error.h"
#include "renderer/scene/pose.h"
#include "renderer/scene/scene.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct DipPeer DipPeer;

typedef enum DipPeerApi { DIP_PEER_GL, DIP_PEER_VULKAN, DIP_PEER_API_COUNT } DipPeerApi;

extern const char *const dip_peer_api_names[DIP_PEER_API_COUNT]; // gl, vulkan

typedef struct DipPeerDef {
    DipPeerApi api;
    const DipSceneDef *scene; // must stay valid until the peer is destroyed
    int width;                // of the frames, in pixels
    int height;
    int threads; // number of the peer's rasteriser threads
} DipPeerDef;

// Creates a peer. A process has at most one peer, which only the thread that created it may use.
// Fails with UNSUPPORTED if the peer is not installed, or if the program was built without its API.
DipPeer *dip_peer_create(const DipPeerDef *def, DipError *err);
void dip_peer_destroy(DipPeer **peer);

const char *dip_peer_renderer(const DipPeer *peer); // valid until the peer is destroyed
const char *dip_peer_version(const DipPeer *peer);

// Sets the sample count (1 or 4) and the maximum anisotropy (1 to 16; 1 means trilinear) for the
// next frames.
bool dip_peer_set(DipPeer *peer, int sample_count, int max_anisotropy, DipError *err);

// Draws a frame. Returns when the picture is complete in memory.
void dip_peer_draw(DipPeer *peer, const DipPose *pose);

// Copies the last picture: width * height sRGB pixels of R, G, B, A, the top row first.
bool dip_peer_read(DipPeer *peer, uint8_t *rgba8, DipError *err);

#endif
