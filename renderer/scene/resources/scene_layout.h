// Inside of a scene, for the renderer: textures, meshes and materials as the pipeline takes them.
#ifndef DIP_RENDERER_SCENE_RESOURCES_SCENE_LAYOUT_H
#define DIP_RENDERER_SCENE_RESOURCES_SCENE_LAYOUT_H

#include "renderer/pipeline/mesh.h"
#include "renderer/pipeline/texture.h"
#include "renderer/scene/materials/surface.h"
#include "renderer/scene/resources/late_textures.h"
#include "renderer/scene/scene.h"

typedef struct DipSceneMesh {
    DipMesh *mesh;
    int material;
    DipSurfaceUniforms
        layout; // attributes, varyings and material; matrices are filled in per frame
    int varying_count;
    bool normal_mapped;
    DipSurfaceUniforms mapped_layout; // of normal_mapped, likewise
    int mapped_varying_count;
    bool sky; // with the texture and coordinates that the effect needs
} DipSceneMesh;

typedef struct DipSceneObject {
    int mesh;
    float transform[12];
    bool first_of_mesh; // no object before it uses its mesh
    DipBox bounds;      // in the world, see dip_cull_transform_box
} DipSceneObject;

typedef struct DipSceneMaterial {
    DipSurface surface;
    int colour_texture; // index or DIP_NO_TEXTURE
    int light_map;
    int normal_map; // DIP_NO_TEXTURE too where it is not drawn
    bool double_sided;
} DipSceneMaterial;

struct DipScene {
    uint64_t serial; // different for every scene made, so that a renderer sees a change
    int texture_count;
    int material_count;
    int mesh_count;
    int object_count;
    DipTexture **textures; // NULL where nothing that is drawn uses it
    bool *compressible;    // per texture: a colour texture of what is no sky
    DipLateTextures *late; // the one part that may grow after
    DipSceneMaterial *materials;
    DipSceneMesh *meshes;
    DipSceneObject *objects;
    float background_lin[3];
    float near_m;
    float min_world[3];
    float max_world[3];
    uint64_t triangle_count;
    int drawn_mesh_count;    // those that some object uses
    uint64_t geometry_bytes; // likewise
    bool has_light_map;
    bool has_clipped;
    bool has_normal_map; // some mesh is normal-mapped
    bool has_sky;
    DipSkyDef sky;
    bool has_water;     // some object is water;
    double water_level; // the least world y of these
    uint64_t normal_map_bytes;
    uint64_t clip_map_bytes; // of their alpha
    uint64_t cloud_bytes;
    DipSceneTimes times;
};

#endif
