// Uploads textures level by level, and makes samplers.
#include "tests/peer/vulkan/texture.h"

#include "tests/peer/mips.h"

typedef struct Upload {
    const DipVk *vk;
    VkImage image;
} Upload;

static bool upload(void *context, int level, int width, int height, const uint8_t *rgba8,
                   DipError *err) {
    const Upload *to = context;
    const DipVk *vk = to->vk;
    const VkDeviceSize size_bytes = (VkDeviceSize)width * (VkDeviceSize)height * 4;
    DipVkBuffer staging;
    if (!dip_vk_buffer_make(vk, size_bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, rgba8, &staging,
                            err)) {
        return false;
    }
    const VkBufferImageCopy region = {
        .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, (uint32_t)level, 0, 1},
        .imageExtent = {(uint32_t)width, (uint32_t)height, 1}};
    bool done = dip_vk_begin(vk, err);
    if (done) {
        vkCmdCopyBufferToImage(vk->commands, staging.buffer, to->image,
                               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
        done = dip_vk_finish(vk, err);
    }
    dip_vk_buffer_free(vk, &staging);
    return done;
}

static bool change_layout(const DipVk *vk, VkImage image, int levels, VkImageLayout from,
                          VkImageLayout to, DipError *err) {
    const VkImageMemoryBarrier barrier = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
        .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT,
        .dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
        .oldLayout = from,
        .newLayout = to,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = image,
        .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, (uint32_t)levels, 0, 1}};
    if (!dip_vk_begin(vk, err)) {
        return false;
    }
    vkCmdPipelineBarrier(vk->commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, NULL, 0, NULL, 1, &barrier);
    return dip_vk_finish(vk, err);
}

bool dip_vk_texture_make(const DipVk *vk, const DipTextureDef *def, DipVkImage *texture,
                         DipError *err) {
    const int levels = dip_peer_mip_count(def);
    const DipVkImageDef image = {
        .width = def->width,
        .height = def->height,
        .levels = levels,
        .sample_count = 1,
        .format =
            def->encoding == DIP_ENCODING_SRGB ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM,
        .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
        .aspect = VK_IMAGE_ASPECT_COLOR_BIT};
    if (!dip_vk_image_make(vk, &image, texture, err)) {
        return false;
    }
    Upload to = {vk, texture->image};
    return change_layout(vk, texture->image, levels, VK_IMAGE_LAYOUT_UNDEFINED,
                         VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, err) &&
           dip_peer_mips(def, upload, &to, err) &&
           change_layout(vk, texture->image, levels, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                         VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, err);
}

static VkSamplerAddressMode address_mode(DipWrap wrap) {
    return wrap == DIP_WRAP_REPEAT ? VK_SAMPLER_ADDRESS_MODE_REPEAT
                                   : VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
}

bool dip_vk_sampler_make(const DipVk *vk, DipWrap wrap_u, DipWrap wrap_v, int max_anisotropy,
                         VkSampler *sampler, DipError *err) {
    const VkSamplerCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                      .magFilter = VK_FILTER_LINEAR,
                                      .minFilter = VK_FILTER_LINEAR,
                                      .mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR,
                                      .addressModeU = address_mode(wrap_u),
                                      .addressModeV = address_mode(wrap_v),
                                      .anisotropyEnable = max_anisotropy > 1,
                                      .maxAnisotropy = (float)max_anisotropy,
                                      .maxLod = VK_LOD_CLAMP_NONE};
    return dip_vk_check(vkCreateSampler(vk->device, &info, NULL, sampler), "sampler", err);
}
