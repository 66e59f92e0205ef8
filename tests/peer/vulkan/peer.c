// The peer by Vulkan: opens the device, makes the scene and the targets, and draws with them.
#include "tests/peer/peer_kind.h"
#include "tests/peer/vulkan/scene.h"

#include <stdlib.h>

typedef struct VkPeer {
    DipPeer peer;
    DipVk vk;
    DipVkScene scene;
    int width;
    int height;
    DipVkTarget targets[DIP_VK_MAX_SAMPLES + 1]; // by sample count; created at first use
    int sample_count;
    bool failed; // a frame could not be drawn, because of `fault`
    DipError fault;
} VkPeer;

static bool set(DipPeer *peer, int sample_count, int max_anisotropy, DipError *err) {
    VkPeer *own = (VkPeer *)peer;
    if (sample_count < 1 || sample_count > DIP_VK_MAX_SAMPLES ||
        !(own->vk.sample_counts & (VkSampleCountFlags)sample_count)) {
        return dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, "samples",
                             "lavapipe does not support %d samples per pixel; give 1 or 4",
                             sample_count);
    }
    DipVkTarget *target = &own->targets[sample_count];
    if (!target->sample_count &&
        !dip_vk_target_make(&own->vk, own->width, own->height, sample_count, target, err)) {
        return false;
    }
    own->sample_count = sample_count;
    return dip_vk_scene_set_anisotropy(&own->vk, &own->scene, max_anisotropy, err);
}

static void destroy(DipPeer *peer) {
    VkPeer *own = (VkPeer *)peer;
    for (int i = 0; own->vk.device && i <= DIP_VK_MAX_SAMPLES; i++) {
        dip_vk_target_free(&own->vk, &own->targets[i]);
    }
    dip_vk_scene_free(&own->vk, &own->scene);
    dip_vk_close(&own->vk);
    free(own);
}

static DipPeer *create(const DipPeerDef *def, DipError *err) {
    VkPeer *own = calloc(1, sizeof *own);
    if (!own) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "peer", "out of memory");
        return NULL;
    }
    own->peer.kind = &dip_peer_kind_vulkan;
    own->width = def->width;
    own->height = def->height;
    if (!dip_vk_open(&own->vk, def->threads, err) ||
        !dip_vk_scene_make(&own->vk, def->scene, &own->scene, err) || !set(&own->peer, 1, 1, err)) {
        destroy(&own->peer);
        return NULL;
    }
    return &own->peer;
}

static const char *renderer(const DipPeer *peer) {
    return ((const VkPeer *)peer)->vk.renderer;
}

static const char *version(const DipPeer *peer) {
    return ((const VkPeer *)peer)->vk.version;
}

static bool try_to_draw(VkPeer *own, const DipPose *pose, DipError *err) {
    const DipVkTarget *target = &own->targets[own->sample_count];
    if (!dip_vk_begin(&own->vk, err)) {
        return false;
    }
    dip_vk_target_begin(&own->vk, target, own->scene.def->background_lin);
    if (!dip_vk_scene_draw(&own->vk, &own->scene, target, pose, err)) {
        return false;
    }
    vkCmdEndRenderPass(own->vk.commands);
    return dip_vk_finish(&own->vk, err);
}

static void draw(DipPeer *peer, const DipPose *pose) {
    VkPeer *own = (VkPeer *)peer;
    own->failed = own->failed || !try_to_draw(own, pose, &own->fault);
}

static bool read(DipPeer *peer, uint8_t *rgba8, DipError *err) {
    VkPeer *own = (VkPeer *)peer;
    if (own->failed) {
        *err = own->fault;
        return false;
    }
    return dip_vk_target_read(&own->vk, &own->targets[own->sample_count], rgba8, err);
}

const DipPeerKind dip_peer_kind_vulkan = {create, destroy, renderer, version, set, draw, read};
