// Layout of a scene pack (scene_pack.h). Private to the reader and the writer.
//
// A pack begins with a PackHeader. The header places one section of records for each kind of
// record. Texts are offsets into the section of text, where every text ends with a zero byte.
// Arrays (texels, vertices, indices) are offsets from the start of the pack; the offset 0 means
// that there is no array. Arrays lie in the order of the records that name them, and do not
// overlap. So the arrays of all records together are no larger than the pack.
#ifndef DIP_ASSETS_PACK_SCENE_PACK_LAYOUT_H
#define DIP_ASSETS_PACK_SCENE_PACK_LAYOUT_H

#include "renderer/base/error.h"

#include <stdint.h>

enum {
    PACK_VERSION = 7, // Increase this number with every change of the layout.
    PACK_ALIGNMENT = 64,
    PACK_MAX_RECORDS = 1 << 24 // Most records in a section.
};

static const char pack_magic[8] = {'D', 'I', 'P', 'P', 'A', 'C', 'K', '\n'};

// The sections, as X(name of the section, type of its records).
#define PACK_SECTION_LIST(X)                                                                       \
    X(textures, PackTexture)                                                                       \
    X(materials, PackMaterial)                                                                     \
    X(meshes, PackMesh)                                                                            \
    X(objects, PackObject)                                                                         \
    X(lights, PackLight)                                                                           \
    X(rigs, PackRig)                                                                               \
    X(nodes, PackNode)                                                                             \
    X(skins, PackSkin)                                                                             \
    X(tracks, PackTrack)                                                                           \
    X(moving_objects, PackMovingObject)                                                            \
    X(moving_meshes, PackMovingMesh)                                                               \
    X(clips, PackClip)                                                                             \
    X(warnings, PackError)                                                                         \
    X(failures, PackError)                                                                         \
    X(text, char)

typedef struct PackSection {
    uint64_t offset; // From the start of the pack, in bytes.
    uint64_t count;  // Number of records.
} PackSection;

typedef struct PackHeader {
    char magic[8];
    uint32_t version;
    uint32_t header_bytes; // sizeof(PackHeader)
    uint32_t stage;        // A DipImportStage.
    uint32_t file_index;   // Index of the model file that the stage works on.
    uint64_t total_bytes;  // Size of the pack.
    double import_ms;
    double pictures_ms;
    float background_lin[3];
    float near_m;
    float ambient_lin[3]; // of the lighting, which the pack has if it has lights
    float sky_lin[3];
    uint32_t shading;
    uint32_t unused;
#define PACK_SECTION_FIELD(name, type) PackSection name;
    PACK_SECTION_LIST(PACK_SECTION_FIELD)
#undef PACK_SECTION_FIELD
} PackHeader;

// The records have the fields of DipTextureDef and so on. Booleans are 0 or 1.
typedef struct PackTexture {
    uint64_t name;  // Offset of the text.
    uint64_t rgba8; // Offset of the array: 4 * width * height bytes.
    int32_t width;
    int32_t height;
    uint32_t encoding;
    uint32_t wrap_u;
    uint32_t wrap_v;
    uint32_t unused;
} PackTexture;

// A DipPbrDef.
typedef struct PackPbr {
    float metallic;
    float roughness;
    float f0_lin[3];
    int32_t metal_rough_map;
    int32_t occlusion_map;
    uint32_t maps_at_uv1; // 1: the occlusion map; 2: the emission map; 3: both
    float occlusion_strength;
    int32_t emission_map;
    float f90;
    float emission_lin[3];
    float normal_scale;
    float coat;
    float coat_roughness;
    float sheen_lin[3];
    float sheen_roughness;
    float transmission;
    float scattering;
} PackPbr;

typedef struct PackMaterial {
    uint64_t name;
    uint32_t surface;
    float base_colour_lin[3];
    int32_t colour_texture;
    int32_t light_map;
    int32_t normal_map;
    float light_map_scale;
    float roughness;
    float alpha_cutoff;
    float specular_lin[3];
    float shininess;
    uint32_t double_sided;
    uint32_t lit;
    float opacity;
    uint32_t has_pbr; // 0: the material has no DipPbrDef, and `pbr` is ignored
    PackPbr pbr;
    float transmission;
} PackMaterial;

typedef struct PackMesh {
    uint64_t name;
    uint64_t positions; // Offsets of arrays: vertex_count rows of 3, 3, 2, 2, 3 and 1 floats.
    uint64_t normals;
    uint64_t uv0;
    uint64_t uv1;
    uint64_t colours_lin;
    uint64_t alphas;
    uint64_t indices; // index_count numbers of 32 bits
    uint32_t vertex_count;
    uint32_t index_count;
    int32_t material;
    uint32_t unused;
} PackMesh;

typedef struct PackObject {
    uint64_t name;
    int32_t mesh;
    float transform[12];
    uint32_t unused;
} PackObject;

typedef struct PackLight {
    uint64_t name;
    uint32_t kind;
    float colour_lin[3];
    float position_world[3];
    float direction_world[3];
    float attenuation[3];
    float range_m;
    float inner_deg;
    float outer_deg;
} PackLight;

// A DipMotionRig. Its nodes, skins and tracks follow those of the rig before it.
typedef struct PackRig {
    uint64_t clip;
    double duration_s;
    double held_s;
    double root[12];
    uint64_t rest_weights; // offset of an array: weight_count floats
    uint32_t is_held;
    uint32_t node_count;
    uint32_t skin_count;
    uint32_t track_count;
    uint32_t weight_count;
    uint32_t unused;
} PackRig;

typedef struct PackNode {
    double matrix[12];
    double translation[3];
    double rotation[4];
    double scale[3];
    int32_t parent;
    uint32_t has_matrix;
    int32_t first_weight;
    int32_t weight_count;
} PackNode;

typedef struct PackSkin {
    uint64_t nodes;         // offset of an array: joint_count numbers of 32 bits
    uint64_t inverse_binds; // offset of an array: joint_count rows of 12 doubles
    uint32_t joint_count;
    uint32_t unused;
} PackSkin;

typedef struct PackTrack {
    uint64_t times;  // offset of an array: key_count floats
    uint64_t values; // offset of an array of floats
    uint32_t target;
    uint32_t interpolation;
    int32_t node;
    int32_t width;
    uint32_t key_count;
    uint32_t unused;
} PackTrack;

typedef struct PackMovingObject {
    double offset[12];
    int32_t object;
    int32_t rig;
    int32_t node;
    uint32_t unused;
} PackMovingObject;

typedef struct PackMovingMesh {
    uint64_t positions; // offsets of arrays: shape_count * vertex_count rows of 3 floats
    uint64_t normals;
    uint64_t joints;        // vertex_count rows of 4 numbers of 16 bits
    uint64_t joint_weights; // vertex_count rows of 4 floats
    uint64_t box;           // 6 floats
    int32_t mesh;
    int32_t rig;
    int32_t node;
    int32_t skin;
    uint32_t vertex_count;
    uint32_t shape_count;
} PackMovingMesh;

// The name of an animation of the files.
typedef struct PackClip {
    uint64_t name;
} PackClip;

typedef struct PackError {
    uint32_t code;
    uint32_t origin;
    uint32_t severity;
    int32_t line;
    char file[sizeof((DipError *)0)->file];
    char key[sizeof((DipError *)0)->key];
    char message[sizeof((DipError *)0)->message];
} PackError;

#endif
