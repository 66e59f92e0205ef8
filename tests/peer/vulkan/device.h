// Vulkan without a window: a device that draws on the processor (Mesa's lavapipe), its memory, and
// a command buffer whose work is waited for.
#ifndef DIP_TESTS_PEER_VULKAN_DEVICE_H
#define DIP_TESTS_PEER_VULKAN_DEVICE_H

#include "renderer/base/error.h"

#include <stdbool.h>
#include <vulkan/vulkan.h>

// Objects whose handles are VK_NULL_HANDLE have not been created. Vulkan ignores such handles when
// they are destroyed.
typedef struct DipVk {
    VkInstance instance;
    VkPhysicalDevice physical;
    VkDevice device;
    VkQueue queue;
    VkCommandPool pool;
    VkCommandBuffer commands;
    VkFence fence;
    VkPhysicalDeviceMemoryProperties memory;
    VkSampleCountFlags sample_counts; // of both colour and depth
    char renderer[VK_MAX_PHYSICAL_DEVICE_NAME_SIZE];
    char version[VK_MAX_DRIVER_INFO_SIZE + 64];
} DipVk;

typedef struct DipVkBuffer {
    VkBuffer buffer;
    VkDeviceMemory memory;
} DipVkBuffer;

typedef struct DipVkImage {
    VkImage image;
    VkDeviceMemory memory;
    VkImageView view;
} DipVkImage;

typedef struct DipVkImageDef {
    int width;
    int height;
    int levels;
    int sample_count;
    VkFormat format;
    VkImageUsageFlags usage;
    VkImageAspectFlags aspect;
} DipVkImageDef;

// Opens a device with `threads` rasteriser threads. Fails with UNSUPPORTED if none of Vulkan's
// devices draws on the processor. On failure *vk is closed.
bool dip_vk_open(DipVk *vk, int threads, DipError *err);
void dip_vk_close(DipVk *vk);

// Returns true if the result is a success. Otherwise sets the error.
bool dip_vk_check(VkResult result, const char *what, DipError *err);

// Makes a buffer that the processor can write and read. If data is not NULL, copies it there.
bool dip_vk_buffer_make(const DipVk *vk, VkDeviceSize size_bytes, VkBufferUsageFlags usage,
                        const void *data, DipVkBuffer *buffer, DipError *err);
void dip_vk_buffer_free(const DipVk *vk, DipVkBuffer *buffer);

bool dip_vk_image_make(const DipVk *vk, const DipVkImageDef *def, DipVkImage *image, DipError *err);
void dip_vk_image_free(const DipVk *vk, DipVkImage *image);

// Begins to record commands. dip_vk_finish executes them and returns when they are complete.
bool dip_vk_begin(const DipVk *vk, DipError *err);
bool dip_vk_finish(const DipVk *vk, DipError *err);

#endif
