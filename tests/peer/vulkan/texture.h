// The scene's textures and samplers in Vulkan.
#ifndef DIP_TESTS_PEER_VULKAN_TEXTURE_H
#define DIP_TESTS_PEER_VULKAN_TEXTURE_H

#include "renderer/scene/scene.h"
#include "tests/peer/vulkan/device.h"

// Creates a texture with def's mip levels (mips.h), ready to be read by shaders.
bool dip_vk_texture_make(const DipVk *vk, const DipTextureDef *def, DipVkImage *texture,
                         DipError *err);

// Creates a trilinear sampler. max_anisotropy: 1 (trilinear) to 16.
bool dip_vk_sampler_make(const DipVk *vk, DipWrap wrap_u, DipWrap wrap_v, int max_anisotropy,
                         VkSampler *sampler, DipError *err);

#endif
