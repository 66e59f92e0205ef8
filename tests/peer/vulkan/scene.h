// A scene description in Vulkan's memory, and the drawing of its objects.
#ifndef DIP_TESTS_PEER_VULKAN_SCENE_H
#define DIP_TESTS_PEER_VULKAN_SCENE_H

#include "renderer/scene/pose.h"
#include "renderer/scene/scene.h"
#include "tests/peer/vulkan/shaders.h"
#include "tests/peer/vulkan/target.h"

enum { DIP_VK_MAX_SAMPLES = 4, DIP_VK_MAX_ANISOTROPY = 16 };

typedef struct DipVkMesh {
    DipVkBuffer vertices;
    DipVkBuffer indices;
    DipPeerLayout layout;
    int features; // features (surfaces.h) of the shaders that draw the mesh
    float min[3]; // corners of the bounding box
    float max[3];
} DipVkMesh;

typedef struct DipVkScene {
    const DipSceneDef *def; // the description, borrowed
    DipVkMesh *meshes;      // one per mesh
    DipVkImage *textures;   // one per texture, and a white one
    VkDescriptorSet *sets;  // one per material: its colour texture and its light map
    VkSampler samplers[2][2][DIP_VK_MAX_ANISOTROPY + 1]; // [wrap_u][wrap_v][max_anisotropy]
    VkDescriptorSetLayout set_layout;
    VkDescriptorPool set_pool;
    VkPipelineLayout layout;
    DipVkShaders shaders[DIP_PEER_SURFACE_COUNT];
    // [sample_count][features][culls][mirrored]; created at first use
    VkPipeline pipelines[DIP_VK_MAX_SAMPLES + 1][DIP_PEER_SURFACE_COUNT][2][2];
} DipVkScene;

// Uploads the scene. def is borrowed until the scene is freed. On failure the caller still frees
// the scene.
bool dip_vk_scene_make(const DipVk *vk, const DipSceneDef *def, DipVkScene *scene, DipError *err);
void dip_vk_scene_free(const DipVk *vk, DipVkScene *scene);

// Sets the anisotropy of colour textures, 1 (trilinear) to 16. Light maps stay trilinear.
bool dip_vk_scene_set_anisotropy(const DipVk *vk, DipVkScene *scene, int max_anisotropy,
                                 DipError *err);

// Records the drawing of the objects in the scene's order into the target. Skips objects whose
// bounding box is out of view.
bool dip_vk_scene_draw(const DipVk *vk, DipVkScene *scene, const DipVkTarget *target,
                       const DipPose *pose, DipError *err);

#endif
