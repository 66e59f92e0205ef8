// A material of a glTF file, as the file describes it. Private to assets/.
#ifndef DIP_ASSETS_GLTF_MATERIALS_H
#define DIP_ASSETS_GLTF_MATERIALS_H

#include "assets/gltf/document.h"
#include "renderer/pipeline/texture.h"

struct cJSON;

typedef enum DipGltfAlpha { DIP_GLTF_OPAQUE, DIP_GLTF_MASK, DIP_GLTF_BLEND } DipGltfAlpha;

// Which of the mesh's texture coordinates place a picture, and how they are moved.
typedef struct DipGltfPlacement {
    int set; // 0 or more
    // Rows of a 2x3 matrix that turns the set's (u, v, 1) into the coordinates of the picture.
    double matrix[6];
} DipGltfPlacement;

// How a material uses a texture.
typedef struct DipGltfTexture {
    int index; // Index of a texture, or -1.
    DipGltfPlacement placement;
} DipGltfTexture;

// The numbers are within their ranges. Extensions are included; a feature that the file lacks has
// the value that the specification gives it.
typedef struct DipGltfMaterial {
    const char *name; // "" if the file gives none; belongs to the document
    double base[4];   // linear, with alpha
    double metallic;
    double roughness;
    double f0[3]; // reflected share at normal incidence where metallic is 0
    double f90;   // The same at grazing incidence.
    double emission[3];
    double normal_scale;
    double occlusion_strength;
    double coat;
    double coat_roughness;
    double sheen[3]; // linear colour
    double sheen_roughness;
    double transmission;
    double scattering; // of what is transmitted: how much the roughness blurs it
    double cutoff;     // of DIP_GLTF_MASK
    DipGltfAlpha alpha;
    bool double_sided;
    bool unlit;
    bool is_glossy;       // KHR_materials_pbrSpecularGlossiness describes the material.
    DipGltfTexture gloss; // Of is_glossy: it multiplies f0, and its alpha 1 - roughness.
    DipGltfTexture colour;
    DipGltfTexture metal_rough;
    DipGltfTexture normal;
    DipGltfTexture occlusion;
    DipGltfTexture emission_map;
} DipGltfMaterial;

// Reads a material. index: -1 for that of a primitive without a material.
bool dip_gltf_describe_material(const DipGltf *gltf, int index, DipGltfMaterial *material);

// Returns whether the alpha of the colours changes a material's surface. index: as above.
bool dip_gltf_shows_alpha(const DipGltf *gltf, int index);

// A texture of a glTF file: its picture, and how it goes on beyond its edges.
typedef struct DipGltfTextureSource {
    int image; // Index of an image, or -1.
    DipWrap wrap_u;
    DipWrap wrap_v;
    bool is_nearest; // The file asks for texels with hard edges.
} DipGltfTextureSource;

bool dip_gltf_describe_texture(const DipGltf *gltf, int index, DipGltfTextureSource *source);

#endif
