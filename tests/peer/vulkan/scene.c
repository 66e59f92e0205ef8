// Uploads and draws a scene description by Vulkan.
#include "tests/peer/vulkan/scene.h"

#include "tests/peer/matrices.h"
#include "tests/peer/vulkan/texture.h"

#include <stdlib.h>
#include <string.h>

// --- meshes ------------------------------------------------------------------------------------

static bool make_mesh(const DipVk *vk, DipVkScene *scene, int index, DipError *err) {
    const DipMeshDef *def = &scene->def->meshes[index];
    DipVkMesh *mesh = &scene->meshes[index];
    mesh->features = dip_peer_features(def, &scene->def->materials[def->material]);
    mesh->layout = dip_peer_layout(def, mesh->features);
    dip_peer_bounds(def, mesh->min, mesh->max);
    const VkDeviceSize stride_bytes = (VkDeviceSize)mesh->layout.stride * sizeof(float);
    float *rows = dip_peer_interleave(def, &mesh->layout, err);
    const bool made =
        rows &&
        dip_vk_buffer_make(vk, stride_bytes * def->vertex_count, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
                           rows, &mesh->vertices, err) &&
        dip_vk_buffer_make(vk, sizeof(uint32_t) * (VkDeviceSize)def->index_count,
                           VK_BUFFER_USAGE_INDEX_BUFFER_BIT, def->indices, &mesh->indices, err);
    free(rows);
    DipVkShaders *shaders = &scene->shaders[mesh->features];
    return made && (shaders->fragment || dip_vk_shaders_make(vk, mesh->features, shaders, err));
}

// --- textures and samplers -----------------------------------------------------------------------

static bool make_texture(const DipVk *vk, DipVkScene *scene, int index, DipError *err) {
    return index == DIP_NO_TEXTURE || scene->textures[index].image ||
           dip_vk_texture_make(vk, &scene->def->textures[index], &scene->textures[index], err);
}

// Makes the textures that materials use, and a white one for materials without a texture.
static bool make_textures(const DipVk *vk, DipVkScene *scene, DipError *err) {
    static const uint8_t texel[4] = {255, 255, 255, 255};
    const DipTextureDef white = {
        .name = "white", .width = 1, .height = 1, .rgba8 = texel, .encoding = DIP_ENCODING_LINEAR};
    bool made = dip_vk_texture_make(vk, &white, &scene->textures[scene->def->texture_count], err);
    for (int i = 0; made && i < scene->def->material_count; i++) {
        const DipMaterialDef *material = &scene->def->materials[i];
        made = make_texture(vk, scene, material->colour_texture, err) &&
               make_texture(vk, scene, material->light_map, err);
    }
    return made;
}

static bool describe_texture(const DipVk *vk, DipVkScene *scene, VkDescriptorSet set,
                             uint32_t binding, int texture, int max_anisotropy, DipError *err) {
    const bool exists = texture != DIP_NO_TEXTURE;
    const DipTextureDef *def = exists ? &scene->def->textures[texture] : NULL;
    const DipWrap wrap_u = def ? def->wrap_u : DIP_WRAP_REPEAT;
    const DipWrap wrap_v = def ? def->wrap_v : DIP_WRAP_REPEAT;
    VkSampler *sampler = &scene->samplers[wrap_u][wrap_v][max_anisotropy];
    if (!*sampler && !dip_vk_sampler_make(vk, wrap_u, wrap_v, max_anisotropy, sampler, err)) {
        return false;
    }
    const VkDescriptorImageInfo image = {
        .sampler = *sampler,
        .imageView = scene->textures[exists ? texture : scene->def->texture_count].view,
        .imageLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    const VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                        .dstSet = set,
                                        .dstBinding = binding,
                                        .descriptorCount = 1,
                                        .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                        .pImageInfo = &image};
    vkUpdateDescriptorSets(vk->device, 1, &write, 0, NULL);
    return true;
}

bool dip_vk_scene_set_anisotropy(const DipVk *vk, DipVkScene *scene, int max_anisotropy,
                                 DipError *err) {
    for (int i = 0; i < scene->def->material_count; i++) {
        const DipMaterialDef *material = &scene->def->materials[i];
        if (!describe_texture(vk, scene, scene->sets[i], 0, material->colour_texture,
                              max_anisotropy, err) ||
            !describe_texture(vk, scene, scene->sets[i], 1, material->light_map, 1, err)) {
            return false;
        }
    }
    return true;
}

// --- layouts -------------------------------------------------------------------------------------

static bool make_layouts(const DipVk *vk, DipVkScene *scene, DipError *err) {
    const VkDescriptorSetLayoutBinding bindings[2] = {
        {0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, NULL},
        {1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, NULL}};
    const VkDescriptorSetLayoutCreateInfo set = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = 2,
        .pBindings = bindings};
    if (!dip_vk_check(vkCreateDescriptorSetLayout(vk->device, &set, NULL, &scene->set_layout),
                      "material", err)) {
        return false;
    }
    const VkPushConstantRange constants = {
        VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(DipVkConstants)};
    const VkPipelineLayoutCreateInfo layout = {.sType =
                                                   VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                               .setLayoutCount = 1,
                                               .pSetLayouts = &scene->set_layout,
                                               .pushConstantRangeCount = 1,
                                               .pPushConstantRanges = &constants};
    return dip_vk_check(vkCreatePipelineLayout(vk->device, &layout, NULL, &scene->layout),
                        "pipeline", err);
}

static bool make_sets(const DipVk *vk, DipVkScene *scene, DipError *err) {
    const uint32_t count = (uint32_t)scene->def->material_count;
    const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 2 * count + 1};
    const VkDescriptorPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                             .maxSets = count + 1,
                                             .poolSizeCount = 1,
                                             .pPoolSizes = &size};
    bool made = dip_vk_check(vkCreateDescriptorPool(vk->device, &pool, NULL, &scene->set_pool),
                             "material", err);
    for (uint32_t i = 0; made && i < count; i++) {
        const VkDescriptorSetAllocateInfo info = {
            .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
            .descriptorPool = scene->set_pool,
            .descriptorSetCount = 1,
            .pSetLayouts = &scene->set_layout};
        made = dip_vk_check(vkAllocateDescriptorSets(vk->device, &info, &scene->sets[i]),
                            "material", err);
    }
    return made;
}

// --- the scene ---------------------------------------------------------------------------------

bool dip_vk_scene_make(const DipVk *vk, const DipSceneDef *def, DipVkScene *scene, DipError *err) {
    *scene = (DipVkScene){.def = def};
    scene->meshes = calloc((size_t)def->mesh_count + 1, sizeof *scene->meshes);
    scene->textures = calloc((size_t)def->texture_count + 1, sizeof *scene->textures);
    scene->sets = calloc((size_t)def->material_count + 1, sizeof *scene->sets);
    bool made = (scene->meshes && scene->textures && scene->sets) ||
                dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "scene", "out of memory");
    made = made && make_textures(vk, scene, err) && make_layouts(vk, scene, err) &&
           make_sets(vk, scene, err);
    for (int i = 0; made && i < def->mesh_count; i++) {
        made = make_mesh(vk, scene, i, err);
    }
    return made;
}

static void free_pipelines(const DipVk *vk, DipVkScene *scene) {
    for (int samples = 0; samples <= DIP_VK_MAX_SAMPLES; samples++) {
        for (int i = 0; i < 4 * DIP_PEER_SURFACE_COUNT; i++) {
            vkDestroyPipeline(vk->device, scene->pipelines[samples][i / 4][i / 2 % 2][i % 2], NULL);
        }
    }
    for (int i = 0; i < 4 * (DIP_VK_MAX_ANISOTROPY + 1); i++) {
        vkDestroySampler(vk->device, scene->samplers[i / 2 % 2][i % 2][i / 4], NULL);
    }
    for (int i = 0; i < DIP_PEER_SURFACE_COUNT; i++) {
        dip_vk_shaders_free(vk, &scene->shaders[i]);
    }
    vkDestroyDescriptorPool(vk->device, scene->set_pool, NULL);
    vkDestroyDescriptorSetLayout(vk->device, scene->set_layout, NULL);
    vkDestroyPipelineLayout(vk->device, scene->layout, NULL);
}

void dip_vk_scene_free(const DipVk *vk, DipVkScene *scene) {
    if (!scene->def) {
        return;
    }
    free_pipelines(vk, scene);
    for (int i = 0; scene->meshes && i < scene->def->mesh_count; i++) {
        dip_vk_buffer_free(vk, &scene->meshes[i].vertices);
        dip_vk_buffer_free(vk, &scene->meshes[i].indices);
    }
    for (int i = 0; scene->textures && i <= scene->def->texture_count; i++) {
        dip_vk_image_free(vk, &scene->textures[i]);
    }
    free(scene->meshes);
    free(scene->textures);
    free(scene->sets);
    *scene = (DipVkScene){.def = NULL};
}

// --- a frame -----------------------------------------------------------------------------------

// What the command buffer has bound, so that nothing is bound twice in a row.
typedef struct Bound {
    VkPipeline pipeline;
    int material;
    int mesh;
} Bound;

static bool choose_pipeline(const DipVk *vk, DipVkScene *scene, const DipVkTarget *target,
                            const DipVkMesh *mesh, bool culls, bool mirrored, VkPipeline *pipeline,
                            DipError *err) {
    VkPipeline *known = &scene->pipelines[target->sample_count][mesh->features][culls][mirrored];
    const DipVkPipelineDef def = {.shaders = &scene->shaders[mesh->features],
                                  .vertices = mesh->layout,
                                  .culls = culls,
                                  .mirrored = mirrored,
                                  .sample_count = target->sample_count,
                                  .layout = scene->layout,
                                  .pass = target->pass};
    if (!*known && !dip_vk_pipeline_make(vk, &def, known, err)) {
        return false;
    }
    *pipeline = *known;
    return true;
}

static DipVkConstants constants_of(const DipMaterialDef *material, const float to_clip[16],
                                   const float normal_to_world[9]) {
    DipVkConstants constants = {.light_map_scale = material->light_map_scale};
    for (int i = 0; i < 16; i++) {
        constants.to_clip[4 * (i % 4) + i / 4] = to_clip[i];
    }
    for (int i = 0; i < 9; i++) {
        constants.normal_to_world[i / 3][i % 3] = normal_to_world[i];
    }
    constants.normal_to_world[0][3] = material->alpha_cutoff;
    memcpy(constants.base_colour_lin, material->base_colour_lin, sizeof material->base_colour_lin);
    return constants;
}

static void bind_object(const DipVk *vk, const DipVkScene *scene, int mesh_index,
                        VkPipeline pipeline, Bound *bound) {
    const DipVkMesh *mesh = &scene->meshes[mesh_index];
    const int material = scene->def->meshes[mesh_index].material;
    if (bound->pipeline != pipeline) {
        vkCmdBindPipeline(vk->commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    }
    if (bound->material != material) {
        vkCmdBindDescriptorSets(vk->commands, VK_PIPELINE_BIND_POINT_GRAPHICS, scene->layout, 0, 1,
                                &scene->sets[material], 0, NULL);
    }
    if (bound->mesh != mesh_index) {
        const VkDeviceSize offset = 0;
        vkCmdBindVertexBuffers(vk->commands, 0, 1, &mesh->vertices.buffer, &offset);
        vkCmdBindIndexBuffer(vk->commands, mesh->indices.buffer, 0, VK_INDEX_TYPE_UINT32);
    }
    *bound = (Bound){pipeline, material, mesh_index};
}

static bool draw_object(const DipVk *vk, DipVkScene *scene, const DipVkTarget *target,
                        const DipObjectDef *object, const double world_to_clip[16], Bound *bound,
                        DipError *err) {
    const DipMeshDef *def = &scene->def->meshes[object->mesh];
    const DipVkMesh *mesh = &scene->meshes[object->mesh];
    float to_clip[16];
    dip_peer_place(world_to_clip, object->transform, to_clip);
    if (!def->index_count || !dip_peer_box_visible(to_clip, mesh->min, mesh->max)) {
        return true;
    }
    const DipMaterialDef *material = &scene->def->materials[def->material];
    float normal_to_world[9];
    const bool mirrored = dip_peer_normal_matrix(object->transform, normal_to_world);
    VkPipeline pipeline;
    if (!choose_pipeline(vk, scene, target, mesh, !material->double_sided, mirrored, &pipeline,
                         err)) {
        return false;
    }
    const DipVkConstants constants = constants_of(material, to_clip, normal_to_world);
    bind_object(vk, scene, object->mesh, pipeline, bound);
    vkCmdPushConstants(vk->commands, scene->layout,
                       VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                       sizeof constants, &constants);
    vkCmdDrawIndexed(vk->commands, def->index_count, 1, 0, 0, 0);
    return true;
}

bool dip_vk_scene_draw(const DipVk *vk, DipVkScene *scene, const DipVkTarget *target,
                       const DipPose *pose, DipError *err) {
    double world_to_clip[16];
    dip_peer_world_to_clip(pose, (double)target->width / target->height, (double)scene->def->near_m,
                           world_to_clip);
    Bound bound = {VK_NULL_HANDLE, -1, -1};
    bool drawn = true;
    for (int i = 0; drawn && i < scene->def->object_count; i++) {
        drawn = draw_object(vk, scene, target, &scene->def->objects[i], world_to_clip, &bound, err);
    }
    return drawn;
}
