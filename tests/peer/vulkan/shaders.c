// Loads SPIR-V and makes pipelines.
#include "tests/peer/vulkan/shaders.h"

#include <stdio.h>

static bool load(const DipVk *vk, int features, const char *stage, VkShaderModule *module,
                 DipError *err) {
    enum { MOST_WORDS = 16384 };
    static uint32_t words[MOST_WORDS];
    char file[512];
    snprintf(file, sizeof file, "%s/%d.%s.spv", DIP_PEER_SPIRV_DIR, features, stage);
    FILE *in = fopen(file, "rb");
    const size_t count = in ? fread(words, sizeof *words, MOST_WORDS, in) : 0;
    if (in) {
        fclose(in);
    }
    if (!count || count == MOST_WORDS) {
        return dip_error_set(err, DIP_ERROR_IO, file, 0, "shader", "cannot be read");
    }
    const VkShaderModuleCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                           .codeSize = count * sizeof *words,
                                           .pCode = words};
    return dip_vk_check(vkCreateShaderModule(vk->device, &info, NULL, module), "shader", err);
}

bool dip_vk_shaders_make(const DipVk *vk, int features, DipVkShaders *shaders, DipError *err) {
    return load(vk, features, "vert", &shaders->vertex, err) &&
           load(vk, features, "frag", &shaders->fragment, err);
}

void dip_vk_shaders_free(const DipVk *vk, DipVkShaders *shaders) {
    vkDestroyShaderModule(vk->device, shaders->vertex, NULL);
    vkDestroyShaderModule(vk->device, shaders->fragment, NULL);
}

bool dip_vk_pipeline_make(const DipVk *vk, const DipVkPipelineDef *def, VkPipeline *pipeline,
                          DipError *err) {
    const VkPipelineShaderStageCreateInfo stages[] = {
        {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
         .stage = VK_SHADER_STAGE_VERTEX_BIT,
         .module = def->shaders->vertex,
         .pName = "main"},
        {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
         .stage = VK_SHADER_STAGE_FRAGMENT_BIT,
         .module = def->shaders->fragment,
         .pName = "main"}};
    VkVertexInputAttributeDescription attributes[DIP_PEER_ATTRIBUTE_COUNT];
    uint32_t offset_bytes = 0;
    for (int i = 0; i < def->vertices.count; i++) {
        const DipPeerAttribute *attribute = &def->vertices.attributes[i];
        attributes[i] = (VkVertexInputAttributeDescription){
            .location = attribute->location,
            .format = attribute->size == 2 ? VK_FORMAT_R32G32_SFLOAT : VK_FORMAT_R32G32B32_SFLOAT,
            .offset = offset_bytes};
        offset_bytes += (uint32_t)attribute->size * (uint32_t)sizeof(float);
    }
    const VkVertexInputBindingDescription binding = {.stride = offset_bytes,
                                                     .inputRate = VK_VERTEX_INPUT_RATE_VERTEX};
    const VkPipelineVertexInputStateCreateInfo input = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
        .vertexBindingDescriptionCount = 1,
        .pVertexBindingDescriptions = &binding,
        .vertexAttributeDescriptionCount = (uint32_t)def->vertices.count,
        .pVertexAttributeDescriptions = attributes};
    const VkPipelineInputAssemblyStateCreateInfo assembly = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
    const VkPipelineViewportStateCreateInfo viewport = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .scissorCount = 1};
    const VkPipelineRasterizationStateCreateInfo raster = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .polygonMode = VK_POLYGON_MODE_FILL,
        .cullMode = def->culls ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE,
        .frontFace = def->mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE,
        .lineWidth = 1.0f};
    const VkPipelineMultisampleStateCreateInfo multisample = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = (VkSampleCountFlagBits)def->sample_count};
    const VkPipelineDepthStencilStateCreateInfo depth = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = VK_TRUE,
        .depthWriteEnable = VK_TRUE,
        .depthCompareOp = VK_COMPARE_OP_GREATER};
    const VkPipelineColorBlendAttachmentState written = {
        .colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                          VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT};
    const VkPipelineColorBlendStateCreateInfo blend = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = 1,
        .pAttachments = &written};
    const VkDynamicState states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    const VkPipelineDynamicStateCreateInfo dynamic = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
        .dynamicStateCount = 2,
        .pDynamicStates = states};
    const VkGraphicsPipelineCreateInfo info = {.sType =
                                                   VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                               .stageCount = 2,
                                               .pStages = stages,
                                               .pVertexInputState = &input,
                                               .pInputAssemblyState = &assembly,
                                               .pViewportState = &viewport,
                                               .pRasterizationState = &raster,
                                               .pMultisampleState = &multisample,
                                               .pDepthStencilState = &depth,
                                               .pColorBlendState = &blend,
                                               .pDynamicState = &dynamic,
                                               .layout = def->layout,
                                               .renderPass = def->pass};
    return dip_vk_check(
        vkCreateGraphicsPipelines(vk->device, VK_NULL_HANDLE, 1, &info, NULL, pipeline), "pipeline",
        err);
}
