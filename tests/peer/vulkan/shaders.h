// The shaders and the pipelines of the Vulkan peer. The build compiles surface.vert and
// surface.frag to SPIR-V, once for each combination of surface features.
#ifndef DIP_TESTS_PEER_VULKAN_SHADERS_H
#define DIP_TESTS_PEER_VULKAN_SHADERS_H

#include "tests/peer/surfaces.h"
#include "tests/peer/vulkan/device.h"

// The constants of a draw, as both shaders declare them.
typedef struct DipVkConstants {
    float to_clip[16];           // column by column
    float normal_to_world[3][4]; // rows; the first row's last value is the alpha cutoff
    float base_colour_lin[3];
    float light_map_scale;
} DipVkConstants;

typedef struct DipVkShaders {
    VkShaderModule vertex;
    VkShaderModule fragment;
} DipVkShaders;

typedef struct DipVkPipelineDef {
    const DipVkShaders *shaders;
    DipPeerLayout vertices;
    bool culls; // back faces are not drawn
    bool mirrored;
    int sample_count;
    VkPipelineLayout layout;
    VkRenderPass pass;
} DipVkPipelineDef;

// Loads the shaders of a combination of features (surfaces.h).
bool dip_vk_shaders_make(const DipVk *vk, int features, DipVkShaders *shaders, DipError *err);
void dip_vk_shaders_free(const DipVk *vk, DipVkShaders *shaders);

bool dip_vk_pipeline_make(const DipVk *vk, const DipVkPipelineDef *def, VkPipeline *pipeline,
                          DipError *err);

#endif
