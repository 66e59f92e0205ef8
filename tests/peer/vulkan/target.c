// Creates, clears and reads the Vulkan peer's images.
#include "tests/peer/vulkan/target.h"

#include <string.h>

static const VkFormat COLOUR_FORMAT = VK_FORMAT_R8G8B8A8_SRGB;
static const VkFormat DEPTH_FORMAT = VK_FORMAT_D32_SFLOAT;

enum { COLOUR, DEPTH, RESOLVED, ATTACHMENT_COUNT };

static bool is_resolved(const DipVkTarget *target) {
    return target->sample_count > 1;
}

static bool make_images(const DipVk *vk, DipVkTarget *target, DipError *err) {
    const VkImageUsageFlags read =
        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    DipVkImageDef def = {.width = target->width,
                         .height = target->height,
                         .levels = 1,
                         .sample_count = target->sample_count,
                         .format = COLOUR_FORMAT,
                         .usage = is_resolved(target) ? VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT : read,
                         .aspect = VK_IMAGE_ASPECT_COLOR_BIT};
    DipVkImageDef depth = def;
    depth.format = DEPTH_FORMAT;
    depth.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    depth.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
    if (!dip_vk_image_make(vk, &def, &target->colour, err) ||
        !dip_vk_image_make(vk, &depth, &target->depth, err)) {
        return false;
    }
    def.sample_count = 1;
    def.usage = read;
    return !is_resolved(target) || dip_vk_image_make(vk, &def, &target->resolved, err);
}

static bool make_pass(const DipVk *vk, DipVkTarget *target, DipError *err) {
    const VkSampleCountFlagBits samples = (VkSampleCountFlagBits)target->sample_count;
    VkAttachmentDescription attachments[ATTACHMENT_COUNT] = {
        [COLOUR] = {.format = COLOUR_FORMAT,
                    .samples = samples,
                    .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                    .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                    .finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL},
        [DEPTH] = {.format = DEPTH_FORMAT,
                   .samples = samples,
                   .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                   .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
                   .finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL},
        [RESOLVED] = {.format = COLOUR_FORMAT,
                      .samples = VK_SAMPLE_COUNT_1_BIT,
                      .loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                      .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                      .finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL},
    };
    for (int i = 0; i < ATTACHMENT_COUNT; i++) {
        attachments[i].stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        attachments[i].stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    }
    if (is_resolved(target)) {
        attachments[COLOUR].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        attachments[COLOUR].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    }
    const VkAttachmentReference colour = {COLOUR, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference depth = {DEPTH, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference resolved = {RESOLVED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkSubpassDescription subpass = {.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
                                          .colorAttachmentCount = 1,
                                          .pColorAttachments = &colour,
                                          .pResolveAttachments =
                                              is_resolved(target) ? &resolved : NULL,
                                          .pDepthStencilAttachment = &depth};
    const VkRenderPassCreateInfo info = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                         .attachmentCount = is_resolved(target) ? 3 : 2,
                                         .pAttachments = attachments,
                                         .subpassCount = 1,
                                         .pSubpasses = &subpass};
    return dip_vk_check(vkCreateRenderPass(vk->device, &info, NULL, &target->pass), "pass", err);
}

static bool make_framebuffer(const DipVk *vk, DipVkTarget *target, DipError *err) {
    const VkImageView views[ATTACHMENT_COUNT] = {target->colour.view, target->depth.view,
                                                 target->resolved.view};
    const VkFramebufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                          .renderPass = target->pass,
                                          .attachmentCount = is_resolved(target) ? 3 : 2,
                                          .pAttachments = views,
                                          .width = (uint32_t)target->width,
                                          .height = (uint32_t)target->height,
                                          .layers = 1};
    return dip_vk_check(vkCreateFramebuffer(vk->device, &info, NULL, &target->framebuffer),
                        "framebuffer", err);
}

bool dip_vk_target_make(const DipVk *vk, int width, int height, int sample_count,
                        DipVkTarget *target, DipError *err) {
    *target = (DipVkTarget){.width = width, .height = height, .sample_count = sample_count};
    const VkDeviceSize size_bytes = (VkDeviceSize)width * (VkDeviceSize)height * 4;
    return make_images(vk, target, err) && make_pass(vk, target, err) &&
           make_framebuffer(vk, target, err) &&
           dip_vk_buffer_make(vk, size_bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, NULL,
                              &target->pixels, err);
}

void dip_vk_target_free(const DipVk *vk, DipVkTarget *target) {
    vkDestroyFramebuffer(vk->device, target->framebuffer, NULL);
    vkDestroyRenderPass(vk->device, target->pass, NULL);
    dip_vk_buffer_free(vk, &target->pixels);
    dip_vk_image_free(vk, &target->colour);
    dip_vk_image_free(vk, &target->depth);
    dip_vk_image_free(vk, &target->resolved);
    *target = (DipVkTarget){.sample_count = 0};
}

void dip_vk_target_begin(const DipVk *vk, const DipVkTarget *target, const float clear_lin[3]) {
    // Depth is clip z / w, as in our renderer: 1 at the near plane, 0 at infinity.
    const VkClearValue clear[ATTACHMENT_COUNT] = {
        [COLOUR] = {.color = {.float32 = {clear_lin[0], clear_lin[1], clear_lin[2], 1.0f}}},
        [DEPTH] = {.depthStencil = {.depth = 0.0f}}};
    const VkRect2D all = {.extent = {(uint32_t)target->width, (uint32_t)target->height}};
    // The height is negative, since Vulkan's clip space has y down and ours has y up.
    const VkViewport viewport = {.y = (float)target->height,
                                 .width = (float)target->width,
                                 .height = -(float)target->height,
                                 .maxDepth = 1.0f};
    const VkRenderPassBeginInfo info = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                        .renderPass = target->pass,
                                        .framebuffer = target->framebuffer,
                                        .renderArea = all,
                                        .clearValueCount = 2,
                                        .pClearValues = clear};
    vkCmdBeginRenderPass(vk->commands, &info, VK_SUBPASS_CONTENTS_INLINE);
    vkCmdSetViewport(vk->commands, 0, 1, &viewport);
    vkCmdSetScissor(vk->commands, 0, 1, &all);
}

bool dip_vk_target_read(const DipVk *vk, const DipVkTarget *target, uint8_t *rgba8, DipError *err) {
    const VkImage picture = is_resolved(target) ? target->resolved.image : target->colour.image;
    const VkBufferImageCopy region = {
        .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
        .imageExtent = {(uint32_t)target->width, (uint32_t)target->height, 1}};
    if (!dip_vk_begin(vk, err)) {
        return false;
    }
    vkCmdCopyImageToBuffer(vk->commands, picture, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           target->pixels.buffer, 1, &region);
    void *pixels;
    if (!dip_vk_finish(vk, err) ||
        !dip_vk_check(vkMapMemory(vk->device, target->pixels.memory, 0, VK_WHOLE_SIZE, 0, &pixels),
                      "memory", err)) {
        return false;
    }
    memcpy(rgba8, pixels, (size_t)target->width * (size_t)target->height * 4);
    vkUnmapMemory(vk->device, target->pixels.memory);
    return true;
}
