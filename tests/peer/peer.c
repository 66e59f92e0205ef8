// Creates the peer's OpenGL context, its scene and its targets, and draws with them.
#include "tests/peer/peer.h"

#include "tests/peer/gl.h"
#include "tests/peer/gl_scene.h"
#include "tests/peer/gl_target.h"

#include <stdlib.h>

enum { MAX_SAMPLES = 4 };

struct DipPeer {
    DipGl gl;
    DipGlScene scene;
    int width;
    int height;
    DipGlTarget targets[MAX_SAMPLES + 1]; // by sample count; created at first use
    int sample_count;
};

DipPeer *dip_peer_create(const DipSceneDef *def, int width, int height, int threads,
                         DipError *err) {
    DipPeer *peer = calloc(1, sizeof *peer);
    if (!peer) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "peer", "out of memory");
        return NULL;
    }
    peer->width = width;
    peer->height = height;
    if (!dip_gl_open(&peer->gl, threads, err) ||
        !dip_gl_scene_make(&peer->gl, def, &peer->scene, err) || !dip_peer_set(peer, 1, 1, err)) {
        dip_peer_destroy(&peer);
    }
    return peer;
}

void dip_peer_destroy(DipPeer **peer) {
    if (*peer) {
        dip_gl_scene_free(&(*peer)->scene);
        dip_gl_close(&(*peer)->gl);
        free(*peer);
        *peer = NULL;
    }
}

const char *dip_peer_renderer(const DipPeer *peer) {
    return peer->gl.renderer;
}

const char *dip_peer_version(const DipPeer *peer) {
    return peer->gl.version;
}

bool dip_peer_set(DipPeer *peer, int sample_count, int max_anisotropy, DipError *err) {
    if (sample_count < 1 || sample_count > MAX_SAMPLES || sample_count > peer->gl.max_samples) {
        return dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, "samples",
                             "llvmpipe does not support %d samples per pixel; give 1 or 4",
                             sample_count);
    }
    DipGlTarget *target = &peer->targets[sample_count];
    if (!target->drawn &&
        !dip_gl_target_make(&peer->gl, peer->width, peer->height, sample_count, target, err)) {
        return false;
    }
    peer->sample_count = sample_count;
    dip_gl_scene_set_anisotropy(&peer->gl, &peer->scene, max_anisotropy);
    return dip_gl_check(&peer->gl, "settings", err);
}

void dip_peer_draw(DipPeer *peer, const DipPose *pose) {
    const DipGlTarget *target = &peer->targets[peer->sample_count];
    dip_gl_target_begin(&peer->gl, target, peer->scene.def->background_lin);
    dip_gl_scene_draw(&peer->gl, &peer->scene, pose, (double)peer->width / peer->height);
    dip_gl_target_finish(&peer->gl, target);
}

bool dip_peer_read(DipPeer *peer, uint8_t *rgba8, DipError *err) {
    dip_gl_target_read(&peer->gl, &peer->targets[peer->sample_count], rgba8);
    return dip_gl_check(&peer->gl, "frame", err);
}
