// Passes each call on to the peer's kind.
#include "tests/peer/peer.h"

#include "tests/peer/peer_kind.h"

#include <stddef.h>

const char *const dip_peer_api_names[DIP_PEER_API_COUNT] = {
    [DIP_PEER_GL] = "gl", [DIP_PEER_VULKAN] = "vulkan"};

static const DipPeerKind *const kinds[DIP_PEER_API_COUNT] = {
    [DIP_PEER_GL] = &dip_peer_kind_gl,
#ifdef DIP_PEER_HAS_VULKAN
    [DIP_PEER_VULKAN] = &dip_peer_kind_vulkan,
#endif
};

DipPeer *dip_peer_create(const DipPeerDef *def, DipError *err) {
    const DipPeerKind *kind = kinds[def->api];
    if (!kind) {
        dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, "--api",
                      "this program was built without Vulkan; its build needs libvulkan-dev and "
                      "glslang-tools");
        return NULL;
    }
    return kind->create(def, err);
}

void dip_peer_destroy(DipPeer **peer) {
    if (*peer) {
        (*peer)->kind->destroy(*peer);
        *peer = NULL;
    }
}

const char *dip_peer_renderer(const DipPeer *peer) {
    return peer->kind->renderer(peer);
}

const char *dip_peer_version(const DipPeer *peer) {
    return peer->kind->version(peer);
}

bool dip_peer_set(DipPeer *peer, int sample_count, int max_anisotropy, DipError *err) {
    return peer->kind->set(peer, sample_count, max_anisotropy, err);
}

void dip_peer_draw(DipPeer *peer, const DipPose *pose) {
    peer->kind->draw(peer, pose);
}

bool dip_peer_read(DipPeer *peer, uint8_t *rgba8, DipError *err) {
    return peer->kind->read(peer, rgba8, err);
}
