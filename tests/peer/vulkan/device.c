// Opens the device, and makes buffers and images.
#include "tests/peer/vulkan/device.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool dip_vk_check(VkResult result, const char *what, DipError *err) {
    if (result == VK_SUCCESS) {
        return true;
    }
    const bool memory =
        result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY;
    return dip_error_set(err, memory ? DIP_ERROR_MEMORY : DIP_ERROR_RUNTIME, NULL, 0, what,
                         "Vulkan error %d", (int)result);
}

// --- the device --------------------------------------------------------------------------------

static bool open_instance(DipVk *vk, DipError *err) {
    const VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                           .apiVersion = VK_API_VERSION_1_2};
    const VkInstanceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                       .pApplicationInfo = &application};
    return vkCreateInstance(&info, NULL, &vk->instance) == VK_SUCCESS ||
           dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, "Vulkan",
                         "there is no driver; install Mesa's lavapipe (mesa-vulkan-drivers)");
}

// Chooses the first device that draws on the processor.
static bool choose_device(DipVk *vk, DipError *err) {
    enum { MOST_DEVICES = 16 };
    VkPhysicalDevice devices[MOST_DEVICES];
    uint32_t count = MOST_DEVICES;
    const VkResult listed = vkEnumeratePhysicalDevices(vk->instance, &count, devices);
    for (uint32_t i = 0; listed >= VK_SUCCESS && i < count; i++) {
        VkPhysicalDeviceDriverProperties driver = {
            .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
        VkPhysicalDeviceProperties2 found = {
            .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &driver};
        vkGetPhysicalDeviceProperties2(devices[i], &found);
        const VkPhysicalDeviceProperties *device = &found.properties;
        if (device->deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU) {
            continue;
        }
        vk->physical = devices[i];
        vk->sample_counts = device->limits.framebufferColorSampleCounts &
                            device->limits.framebufferDepthSampleCounts;
        snprintf(vk->renderer, sizeof vk->renderer, "%s", device->deviceName);
        snprintf(vk->version, sizeof vk->version, "Vulkan %u.%u.%u %s",
                 VK_API_VERSION_MAJOR(device->apiVersion), VK_API_VERSION_MINOR(device->apiVersion),
                 VK_API_VERSION_PATCH(device->apiVersion), driver.driverInfo);
        vkGetPhysicalDeviceMemoryProperties(vk->physical, &vk->memory);
        return true;
    }
    return dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, "Vulkan",
                         "no device draws on the processor; install Mesa's lavapipe "
                         "(mesa-vulkan-drivers)");
}

// Opens the device with one queue. Its first family of queues can draw: lavapipe has only one.
static bool open_device(DipVk *vk, DipError *err) {
    VkPhysicalDeviceFeatures features;
    vkGetPhysicalDeviceFeatures(vk->physical, &features);
    if (!features.samplerAnisotropy) {
        return dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, "Vulkan",
                             "'%s' has no anisotropic filter", vk->renderer);
    }
    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                           .queueCount = 1,
                                           .pQueuePriorities = &priority};
    const VkPhysicalDeviceFeatures used = {.samplerAnisotropy = VK_TRUE};
    const VkDeviceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                     .queueCreateInfoCount = 1,
                                     .pQueueCreateInfos = &queue,
                                     .pEnabledFeatures = &used};
    if (!dip_vk_check(vkCreateDevice(vk->physical, &info, NULL, &vk->device), "device", err)) {
        return false;
    }
    vkGetDeviceQueue(vk->device, 0, 0, &vk->queue);
    return true;
}

static bool make_commands(DipVk *vk, DipError *err) {
    const VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                          .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT};
    const VkFenceCreateInfo fence = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    if (!dip_vk_check(vkCreateCommandPool(vk->device, &pool, NULL, &vk->pool), "commands", err) ||
        !dip_vk_check(vkCreateFence(vk->device, &fence, NULL, &vk->fence), "fence", err)) {
        return false;
    }
    const VkCommandBufferAllocateInfo commands = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
        .commandPool = vk->pool,
        .commandBufferCount = 1};
    return dip_vk_check(vkAllocateCommandBuffers(vk->device, &commands, &vk->commands), "commands",
                        err);
}

bool dip_vk_open(DipVk *vk, int threads, DipError *err) {
    char text[16];
    snprintf(text, sizeof text, "%d", threads);
    setenv("LP_NUM_THREADS", text, 1);
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
    *vk = (DipVk){.instance = VK_NULL_HANDLE};
    const bool opened = open_instance(vk, err) && choose_device(vk, err) && open_device(vk, err) &&
                        make_commands(vk, err);
    if (!opened) {
        dip_vk_close(vk);
    }
    return opened;
}

void dip_vk_close(DipVk *vk) {
    if (vk->device) {
        vkDestroyFence(vk->device, vk->fence, NULL);
        vkDestroyCommandPool(vk->device, vk->pool, NULL);
        vkDestroyDevice(vk->device, NULL);
    }
    if (vk->instance) {
        vkDestroyInstance(vk->instance, NULL);
    }
    *vk = (DipVk){.instance = VK_NULL_HANDLE};
}

// --- memory ------------------------------------------------------------------------------------

static bool allocate(const DipVk *vk, const VkMemoryRequirements *needs,
                     VkMemoryPropertyFlags properties, VkDeviceMemory *memory, DipError *err) {
    uint32_t type = 0;
    while (type < vk->memory.memoryTypeCount &&
           (!(needs->memoryTypeBits >> type & 1) ||
            (vk->memory.memoryTypes[type].propertyFlags & properties) != properties)) {
        type++;
    }
    const VkMemoryAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                       .allocationSize = needs->size,
                                       .memoryTypeIndex = type};
    return dip_vk_check(type < vk->memory.memoryTypeCount
                            ? vkAllocateMemory(vk->device, &info, NULL, memory)
                            : VK_ERROR_OUT_OF_DEVICE_MEMORY,
                        "memory", err);
}

static bool fill(const DipVk *vk, VkDeviceMemory memory, const void *data, VkDeviceSize size_bytes,
                 DipError *err) {
    void *to;
    if (!dip_vk_check(vkMapMemory(vk->device, memory, 0, VK_WHOLE_SIZE, 0, &to), "memory", err)) {
        return false;
    }
    memcpy(to, data, (size_t)size_bytes);
    vkUnmapMemory(vk->device, memory);
    return true;
}

bool dip_vk_buffer_make(const DipVk *vk, VkDeviceSize size_bytes, VkBufferUsageFlags usage,
                        const void *data, DipVkBuffer *buffer, DipError *err) {
    const VkBufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                     .size = size_bytes ? size_bytes : 4,
                                     .usage = usage};
    *buffer = (DipVkBuffer){.buffer = VK_NULL_HANDLE};
    if (!dip_vk_check(vkCreateBuffer(vk->device, &info, NULL, &buffer->buffer), "buffer", err)) {
        return false;
    }
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(vk->device, buffer->buffer, &needs);
    const bool made =
        allocate(vk, &needs,
                 VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                 &buffer->memory, err) &&
        dip_vk_check(vkBindBufferMemory(vk->device, buffer->buffer, buffer->memory, 0), "buffer",
                     err) &&
        (!data || fill(vk, buffer->memory, data, size_bytes, err));
    if (!made) {
        dip_vk_buffer_free(vk, buffer);
    }
    return made;
}

void dip_vk_buffer_free(const DipVk *vk, DipVkBuffer *buffer) {
    vkDestroyBuffer(vk->device, buffer->buffer, NULL);
    vkFreeMemory(vk->device, buffer->memory, NULL);
    *buffer = (DipVkBuffer){.buffer = VK_NULL_HANDLE};
}

static bool make_view(const DipVk *vk, const DipVkImageDef *def, DipVkImage *image, DipError *err) {
    const VkImageViewCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = image->image,
        .viewType = VK_IMAGE_VIEW_TYPE_2D,
        .format = def->format,
        .subresourceRange = {def->aspect, 0, (uint32_t)def->levels, 0, 1}};
    return dip_vk_check(vkCreateImageView(vk->device, &info, NULL, &image->view), "image", err);
}

bool dip_vk_image_make(const DipVk *vk, const DipVkImageDef *def, DipVkImage *image,
                       DipError *err) {
    const VkImageCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                    .imageType = VK_IMAGE_TYPE_2D,
                                    .format = def->format,
                                    .extent = {(uint32_t)def->width, (uint32_t)def->height, 1},
                                    .mipLevels = (uint32_t)def->levels,
                                    .arrayLayers = 1,
                                    .samples = (VkSampleCountFlagBits)def->sample_count,
                                    .tiling = VK_IMAGE_TILING_OPTIMAL,
                                    .usage = def->usage};
    *image = (DipVkImage){.image = VK_NULL_HANDLE};
    if (!dip_vk_check(vkCreateImage(vk->device, &info, NULL, &image->image), "image", err)) {
        return false;
    }
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(vk->device, image->image, &needs);
    const bool made =
        allocate(vk, &needs, 0, &image->memory, err) &&
        dip_vk_check(vkBindImageMemory(vk->device, image->image, image->memory, 0), "image", err) &&
        make_view(vk, def, image, err);
    if (!made) {
        dip_vk_image_free(vk, image);
    }
    return made;
}

void dip_vk_image_free(const DipVk *vk, DipVkImage *image) {
    vkDestroyImageView(vk->device, image->view, NULL);
    vkDestroyImage(vk->device, image->image, NULL);
    vkFreeMemory(vk->device, image->memory, NULL);
    *image = (DipVkImage){.image = VK_NULL_HANDLE};
}

// --- commands ----------------------------------------------------------------------------------

bool dip_vk_begin(const DipVk *vk, DipError *err) {
    const VkCommandBufferBeginInfo info = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                           .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    return dip_vk_check(vkBeginCommandBuffer(vk->commands, &info), "commands", err);
}

bool dip_vk_finish(const DipVk *vk, DipError *err) {
    const VkSubmitInfo info = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                               .commandBufferCount = 1,
                               .pCommandBuffers = &vk->commands};
    return dip_vk_check(vkEndCommandBuffer(vk->commands), "commands", err) &&
           dip_vk_check(vkResetFences(vk->device, 1, &vk->fence), "fence", err) &&
           dip_vk_check(vkQueueSubmit(vk->queue, 1, &info, vk->fence), "commands", err) &&
           dip_vk_check(vkWaitForFences(vk->device, 1, &vk->fence, VK_TRUE, UINT64_MAX), "fence",
                        err);
}
