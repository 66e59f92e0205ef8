// The inside of a scene, for the renderer: textures, meshes and materials in the form that the
// pipeline takes.
#ifndef DIP_RENDERER_SCENE_RESOURCES_SCENE_LAYOUT_H
#define DIP_RENDERER_SCENE_RESOURCES_SCENE_LAYOUT_H

#include "renderer/pipeline/mesh.h"
#include "renderer/pipeline/texture.h"
#include "renderer/scene/materials/surface.h"
#include "renderer/scene/resources/late_textures.h"
#include "renderer/scene/resources/lighting.h"
#include "renderer/scene/resources/pbr.h"
#include "renderer/scene/motion.h"
#include "renderer/scene/scene.h"

typedef struct DipSceneMesh {
    DipMesh *mesh;
    int material;
    // Uniforms with the indices of attributes and varyings and the values of the material. The
    // matrices are set for each frame.
    DipSurfaceUniforms layout;
    int varying_count;
    bool lit_by_lights; // the scene's lights light the mesh
    bool fragments_lit; // `layout` has the light computed at the fragments
    bool normal_mapped;
    bool pbr; // the surface is drawn by its metallic-roughness description
    // `layout` and `varying_count` for the shaders of normal-mapped and metallic-roughness
    // surfaces; valid if normal_mapped or pbr is true.
    DipSurfaceUniforms full_layout;
    int full_varying_count;
    int attribute_count;         // floats of a vertex
    int normal_attribute;        // index of the first attribute of the normals, or DIP_ABSENT
    int uv_varyings[2];          // index of the first varying of uv0 and of uv1, or DIP_ABSENT
    uint32_t repeating_varyings; // see DipDraw
    bool sky; // true for a sky that has the texture and the coordinates that moving clouds need
} DipSceneMesh;

typedef struct DipSceneObject {
    int mesh;
    float transform[12];
    float normal_to_world[9]; // gives a normal the right direction, but any length
    bool mirrors;             // the transform reverses windings
    // The inverse of the transform's 3x3 part. All elements are 0 if the transform is singular or
    // one of its columns lies within 14 degrees of the plane of the other two.
    double world_to_object[9];
    bool first_of_mesh; // no earlier object uses the same mesh
    DipBox bounds;      // in world space, see dip_cull_transform_box
} DipSceneObject;

typedef struct DipSceneMaterial {
    DipSurface surface;
    bool blended;       // surfaces of the material are drawn over what lies behind them
    int colour_texture; // index or DIP_NO_TEXTURE
    int light_map;
    int normal_map; // DIP_NO_TEXTURE also if the material's normal map is not drawn
    DipPbrMaps pbr; // the maps of a metallic-roughness surface
    bool double_sided;
    bool casts; // surfaces of the material cast shadows
} DipSceneMaterial;

// Whether surfaces of a material are drawn over what lies behind them.
static inline bool dip_material_is_blended(const DipMaterialDef *material) {
    return material->surface == DIP_SURFACE_BLENDED ||
           (material->surface == DIP_SURFACE_WATER && material->transmission > 0.0f);
}

struct DipScene {
    uint64_t serial; // unique number of the scene, so that a renderer notices another scene
    int texture_count;
    int material_count;
    int mesh_count;
    int object_count;
    DipTexture **textures; // one per texture; NULL if no material draws with the texture
    bool *compressible;    // one per texture: true for colour textures, except the sky's
    DipLateTextures *late; // the only member that may change after creation
    DipSceneMaterial *materials;
    DipSceneMesh *meshes;
    DipSceneObject *objects;
    float background_lin[3];
    float near_m;
    float min_world[3];
    float max_world[3];
    uint64_t triangle_count;
    int drawn_mesh_count;    // meshes that at least one object uses
    uint64_t geometry_bytes; // bytes of these meshes
    bool has_light_map;      // some material has a light map
    bool has_clipped;        // some material is alpha-clipped
    bool has_normal_map;     // some mesh is normal-mapped
    bool has_occlusion;      // some metallic-roughness mesh has an occlusion map
    bool has_emission;       // some metallic-roughness mesh sends out light
    bool has_coat;           // some metallic-roughness mesh has a clear coat
    bool has_transmission;   // some metallic-roughness mesh transmits light
    bool has_scattering;     // some such mesh blurs what is seen through it
    bool has_sheen;          // some metallic-roughness mesh has a sheen
    bool has_sky;            // some mesh is a sky with moving clouds
    int blended_count;       // objects whose material is blended
    int blended_added_draws; // draws that these take beyond one each: a double-sided object takes
                             // two, a transmitting one two for each side
    DipSkyDef sky;
    DipSceneLighting *lighting; // NULL: the fixed light of sky and sun
    DipScenePbr *pbr;           // NULL: no mesh has a metallic-roughness surface
    bool has_lit;               // the scene's lights light some mesh
    bool has_caster;            // some object with triangles casts shadows
    bool has_water;             // some object is water
    double water_level;         // least world y of all water; 0 without water
    uint64_t normal_map_bytes;
    uint64_t clip_map_bytes; // bytes of the clip maps' alpha
    uint64_t cloud_bytes;    // bytes of the textures of skies with moving clouds
    // The motion, copied, and for each of its meshes the rows of attributes, of which positions and
    // normals change. NULL: nothing moves. Such a scene's objects and meshes have the shape at
    // rest; posed.h makes a scene at a time of it.
    DipMotionDef *motion;
    float **moving_rows;
    uint64_t moving_vertices; // vertices of the moving meshes
    DipSceneTimes times;
};

#endif
