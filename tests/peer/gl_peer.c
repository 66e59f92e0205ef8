// The peer by OpenGL: creates the context, the scene and the targets, and draws with them.
#include "tests/peer/gl.h"
#include "tests/peer/gl_scene.h"
#include "tests/peer/gl_target.h"
#include "tests/peer/peer_kind.h"

#include <stdlib.h>

enum { MAX_SAMPLES = 4 };

typedef struct GlPeer {
    DipPeer peer;
    DipGl gl;
    DipGlScene scene;
    int width;
    int height;
    DipGlTarget targets[MAX_SAMPLES + 1]; // by sample count; created at first use
    int sample_count;
} GlPeer;

static bool set(DipPeer *peer, int sample_count, int max_anisotropy, DipError *err) {
    GlPeer *own = (GlPeer *)peer;
    if (sample_count < 1 || sample_count > MAX_SAMPLES || sample_count > own->gl.max_samples) {
        return dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, "samples",
                             "llvmpipe does not support %d samples per pixel; give 1 or 4",
                             sample_count);
    }
    DipGlTarget *target = &own->targets[sample_count];
    if (!target->drawn &&
        !dip_gl_target_make(&own->gl, own->width, own->height, sample_count, target, err)) {
        return false;
    }
    own->sample_count = sample_count;
    dip_gl_scene_set_anisotropy(&own->gl, &own->scene, max_anisotropy);
    return dip_gl_check(&own->gl, "settings", err);
}

static void destroy(DipPeer *peer) {
    GlPeer *own = (GlPeer *)peer;
    dip_gl_scene_free(&own->scene);
    dip_gl_close(&own->gl);
    free(own);
}

static DipPeer *create(const DipPeerDef *def, DipError *err) {
    GlPeer *own = calloc(1, sizeof *own);
    if (!own) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "peer", "out of memory");
        return NULL;
    }
    own->peer.kind = &dip_peer_kind_gl;
    own->width = def->width;
    own->height = def->height;
    if (!dip_gl_open(&own->gl, def->threads, err) ||
        !dip_gl_scene_make(&own->gl, def->scene, &own->scene, err) || !set(&own->peer, 1, 1, err)) {
        destroy(&own->peer);
        return NULL;
    }
    return &own->peer;
}

static const char *renderer(const DipPeer *peer) {
    return ((const GlPeer *)peer)->gl.renderer;
}

static const char *version(const DipPeer *peer) {
    return ((const GlPeer *)peer)->gl.version;
}

static void draw(DipPeer *peer, const DipPose *pose) {
    GlPeer *own = (GlPeer *)peer;
    const DipGlTarget *target = &own->targets[own->sample_count];
    dip_gl_target_begin(&own->gl, target, own->scene.def->background_lin);
    dip_gl_scene_draw(&own->gl, &own->scene, pose, (double)own->width / own->height);
    dip_gl_target_finish(&own->gl, target);
}

static bool read(DipPeer *peer, uint8_t *rgba8, DipError *err) {
    GlPeer *own = (GlPeer *)peer;
    dip_gl_target_read(&own->gl, &own->targets[own->sample_count], rgba8);
    return dip_gl_check(&own->gl, "frame", err);
}

const DipPeerKind dip_peer_kind_gl = {create, destroy, renderer, version, set, draw, read};
