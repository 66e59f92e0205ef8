// What the Vulkan peer draws into: an sRGB colour image and a float depth image. If they have more
// than one sample per pixel, the render pass ends with a resolve to a third image.
#ifndef DIP_TESTS_PEER_VULKAN_TARGET_H
#define DIP_TESTS_PEER_VULKAN_TARGET_H

#include "tests/peer/vulkan/device.h"

#include <stdint.h>

typedef struct DipVkTarget {
    int width;
    int height;
    int sample_count; // 0 until the target is created
    DipVkImage colour;
    DipVkImage depth;
    DipVkImage resolved; // unused with 1 sample
    DipVkBuffer pixels;  // the picture, once it is read
    VkRenderPass pass;
    VkFramebuffer framebuffer;
} DipVkTarget;

// On failure the caller still frees the target.
bool dip_vk_target_make(const DipVk *vk, int width, int height, int sample_count,
                        DipVkTarget *target, DipError *err);
void dip_vk_target_free(const DipVk *vk, DipVkTarget *target);

// Records the begin of the render pass: clears the images and sets the viewport.
void dip_vk_target_begin(const DipVk *vk, const DipVkTarget *target, const float clear_lin[3]);

// Copies the picture to width * height sRGB pixels R, G, B, A, the top row first.
bool dip_vk_target_read(const DipVk *vk, const DipVkTarget *target, uint8_t *rgba8, DipError *err);

#endif
