// Reads the materials and textures of glTF files.
#include "assets/gltf/materials.h"

#include "renderer/base/trig.h"

#include <cjson/cJSON.h>

#include <string.h>

enum { WRAP_CLAMP = 33071, WRAP_MIRROR = 33648, FILTER_NEAREST = 9728 };

static const double max_emission = 1e9;
static const double max_normal_scale = 1e6;

// --- textures ------------------------------------------------------------------------------------

static DipWrap wrap_of(int mode) {
    return mode == WRAP_CLAMP    ? DIP_WRAP_CLAMP
           : mode == WRAP_MIRROR ? DIP_WRAP_MIRROR
                                 : DIP_WRAP_REPEAT;
}

static bool read_sampler(const DipGltf *gltf, const cJSON *texture, DipGltfTextureSource *source) {
    int index;
    int wrap_s;
    int wrap_t;
    int filter;
    if (!dip_gltf_integer(gltf, texture, "sampler", -1, &index)) {
        return false;
    }
    const cJSON *sampler = index >= 0 ? dip_gltf_item(gltf, DIP_GLTF_samplers, index) : NULL;
    if ((index >= 0 && !sampler) || !dip_gltf_integer(gltf, sampler, "wrapS", 0, &wrap_s) ||
        !dip_gltf_integer(gltf, sampler, "wrapT", 0, &wrap_t) ||
        !dip_gltf_integer(gltf, sampler, "magFilter", 0, &filter)) {
        return false;
    }
    source->wrap_u = wrap_of(wrap_s);
    source->wrap_v = wrap_of(wrap_t);
    source->is_nearest = filter == FILTER_NEAREST;
    return true;
}

// A texture may name the same picture in several formats. The plain one is preferred.
bool dip_gltf_describe_texture(const DipGltf *gltf, int index, DipGltfTextureSource *source) {
    static const char *const formats[] = {"EXT_texture_webp", "MSFT_texture_dds",
                                          "KHR_texture_basisu"};
    const cJSON *texture = dip_gltf_item(gltf, DIP_GLTF_textures, index);
    *source = (DipGltfTextureSource){.image = -1};
    if (!texture || !dip_gltf_integer(gltf, texture, "source", -1, &source->image)) {
        return false;
    }
    for (size_t i = 0; source->image < 0 && i < sizeof formats / sizeof *formats; ++i) {
        const cJSON *extension = dip_gltf_extension(texture, formats[i]);
        if (extension && !dip_gltf_integer(gltf, extension, "source", -1, &source->image)) {
            return false;
        }
    }
    return (source->image < 0 || dip_gltf_item(gltf, DIP_GLTF_images, source->image)) &&
           read_sampler(gltf, texture, source);
}

// Reads KHR_texture_transform: u' = R(rotation) S(scale) u + offset, where a positive rotation
// turns the coordinates, as the extension says, "counter-clockwise about the origin".
static bool read_transform(const DipGltf *gltf, const cJSON *json, DipGltfPlacement *placement) {
    const cJSON *transform = dip_gltf_extension(json, "KHR_texture_transform");
    double offset[2] = {0.0, 0.0};
    double scale[2] = {1.0, 1.0};
    if (!transform) {
        return true;
    }
    if (!dip_gltf_numbers(gltf, transform, "offset", 2, offset) ||
        !dip_gltf_numbers(gltf, transform, "scale", 2, scale) ||
        !dip_gltf_integer(gltf, transform, "texCoord", placement->set, &placement->set)) {
        return false;
    }
    const double rotation = dip_gltf_number_of(transform, "rotation", 0.0);
    const double c = dip_cos(rotation);
    const double s = dip_sin(rotation);
    const double matrix[6] = {c * scale[0],  s * scale[1], offset[0],
                              -s * scale[0], c * scale[1], offset[1]};
    memcpy(placement->matrix, matrix, sizeof matrix);
    return true;
}

static bool read_texture(const DipGltf *gltf, const cJSON *parent, const char *name,
                         DipGltfTexture *texture) {
    const cJSON *json = cJSON_GetObjectItemCaseSensitive(parent, name);
    *texture = (DipGltfTexture){.index = -1, .placement = {.matrix = {1, 0, 0, 0, 1, 0}}};
    if (!json) {
        return true;
    }
    return dip_gltf_integer(gltf, json, "index", -1, &texture->index) &&
           dip_gltf_integer(gltf, json, "texCoord", 0, &texture->placement.set) &&
           read_transform(gltf, json, &texture->placement) &&
           (texture->index < 0 || dip_gltf_item(gltf, DIP_GLTF_textures, texture->index));
}

// --- materials -----------------------------------------------------------------------------------

static double clamp(double value, double low, double high) {
    return value < low ? low : value > high ? high : value;
}

static double unit_of(const cJSON *object, const char *name, double otherwise) {
    return clamp(dip_gltf_number_of(object, name, otherwise), 0.0, 1.0);
}

// Returns the description of the material in the shading of old files, or NULL. Of its specular
// picture only the mean is drawn, so a description with a metallic-roughness picture outranks it.
static const cJSON *glossy_of(const cJSON *json) {
    const cJSON *glossy = dip_gltf_extension(json, "KHR_materials_pbrSpecularGlossiness");
    const cJSON *metallic = cJSON_GetObjectItemCaseSensitive(json, "pbrMetallicRoughness");
    const bool outranked = cJSON_GetObjectItemCaseSensitive(glossy, "specularGlossinessTexture") &&
                           cJSON_GetObjectItemCaseSensitive(metallic, "metallicRoughnessTexture");
    return outranked ? NULL : glossy;
}

// The shading of old files: a diffuse colour, and a specular colour that is f0.
static bool read_glossy(const DipGltf *gltf, const cJSON *glossy, DipGltfMaterial *material) {
    double specular[3] = {1.0, 1.0, 1.0};
    double greatest = 0.0;
    for (int i = 0; i < 4; ++i) {
        material->base[i] = 1.0;
    }
    material->metal_rough.index = -1;
    if (!dip_gltf_numbers(gltf, glossy, "diffuseFactor", 4, material->base) ||
        !dip_gltf_numbers(gltf, glossy, "specularFactor", 3, specular) ||
        !read_texture(gltf, glossy, "diffuseTexture", &material->colour) ||
        !read_texture(gltf, glossy, "specularGlossinessTexture", &material->gloss)) {
        return false;
    }
    material->is_glossy = true;
    material->metallic = 0.0;
    material->roughness = 1.0 - unit_of(glossy, "glossinessFactor", 1.0);
    for (int i = 0; i < 3; ++i) {
        material->f0[i] = clamp(specular[i], 0.0, 1.0);
        greatest = material->f0[i] > greatest ? material->f0[i] : greatest;
    }
    material->f90 = clamp(50.0 * greatest, 0.0, 1.0); // Black reflects nothing.
    return true;
}

static bool read_metallic(const DipGltf *gltf, const cJSON *json, DipGltfMaterial *material) {
    const cJSON *shading = cJSON_GetObjectItemCaseSensitive(json, "pbrMetallicRoughness");
    material->metallic = unit_of(shading, "metallicFactor", 1.0);
    material->roughness = unit_of(shading, "roughnessFactor", 1.0);
    return dip_gltf_numbers(gltf, shading, "baseColorFactor", 4, material->base) &&
           read_texture(gltf, shading, "baseColorTexture", &material->colour) &&
           read_texture(gltf, shading, "metallicRoughnessTexture", &material->metal_rough);
}

// Computes f0, f90 and the scattering from KHR_materials_ior and KHR_materials_specular. An ior of
// 0 stands for infinity. What is transmitted without refraction, with an ior of 1, is not
// scattered.
static bool read_specular(const DipGltf *gltf, const cJSON *json, DipGltfMaterial *material) {
    const cJSON *specular = dip_gltf_extension(json, "KHR_materials_specular");
    const double ior =
        dip_gltf_number_of(dip_gltf_extension(json, "KHR_materials_ior"), "ior", 1.5);
    const double ratio = ior >= 1.0 ? (ior - 1.0) / (ior + 1.0) : ior == 0.0 ? 1.0 : 0.2;
    const double strength = unit_of(specular, "specularFactor", 1.0);
    double colour[3] = {1.0, 1.0, 1.0};
    if (!dip_gltf_numbers(gltf, specular, "specularColorFactor", 3, colour)) {
        return false;
    }
    for (int i = 0; i < 3; ++i) {
        material->f0[i] = strength * clamp(ratio * ratio * colour[i], 0.0, 1.0);
    }
    material->f90 = strength;
    material->scattering = ior == 0.0 ? 1.0 : clamp(2.0 * ior - 2.0, 0.0, 1.0);
    return true;
}

static bool read_emission(const DipGltf *gltf, const cJSON *json, DipGltfMaterial *material) {
    const cJSON *extension = dip_gltf_extension(json, "KHR_materials_emissive_strength");
    const double strength = dip_gltf_number_of(extension, "emissiveStrength", 1.0);
    if (!dip_gltf_numbers(gltf, json, "emissiveFactor", 3, material->emission) ||
        !read_texture(gltf, json, "emissiveTexture", &material->emission_map)) {
        return false;
    }
    for (int i = 0; i < 3; ++i) {
        material->emission[i] = clamp(strength * material->emission[i], 0.0, max_emission);
    }
    return true;
}

static DipGltfAlpha alpha_of(const cJSON *json) {
    const cJSON *mode = cJSON_GetObjectItemCaseSensitive(json, "alphaMode");
    const char *name = cJSON_IsString(mode) ? mode->valuestring : "OPAQUE";
    return strcmp(name, "MASK") == 0    ? DIP_GLTF_MASK
           : strcmp(name, "BLEND") == 0 ? DIP_GLTF_BLEND
                                        : DIP_GLTF_OPAQUE;
}

bool dip_gltf_shows_alpha(const DipGltf *gltf, int index) {
    return index >= 0 &&
           alpha_of(dip_gltf_item(gltf, DIP_GLTF_materials, index)) != DIP_GLTF_OPAQUE;
}

static void read_alpha(const cJSON *json, DipGltfMaterial *material) {
    material->alpha = alpha_of(json);
    material->cutoff = dip_gltf_number_of(json, "alphaCutoff", 0.5);
    material->double_sided = cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(json, "doubleSided"));
}

bool dip_gltf_describe_material(const DipGltf *gltf, int index, DipGltfMaterial *material) {
    static const cJSON nothing = {.type = cJSON_Object};
    const cJSON *json = index < 0 ? &nothing : dip_gltf_item(gltf, DIP_GLTF_materials, index);
    const cJSON *name = cJSON_GetObjectItemCaseSensitive(json, "name");
    *material = (DipGltfMaterial){.name = cJSON_IsString(name) ? name->valuestring : "",
                                  .base = {1.0, 1.0, 1.0, 1.0},
                                  .gloss.index = -1};
    const cJSON *normal = cJSON_GetObjectItemCaseSensitive(json, "normalTexture");
    const cJSON *occlusion = cJSON_GetObjectItemCaseSensitive(json, "occlusionTexture");
    const cJSON *glossy = glossy_of(json);
    const cJSON *coat = dip_gltf_extension(json, "KHR_materials_clearcoat");
    const cJSON *sheen = dip_gltf_extension(json, "KHR_materials_sheen");
    const cJSON *transmission = dip_gltf_extension(json, "KHR_materials_transmission");
    if (!json || !read_metallic(gltf, json, material) || !read_specular(gltf, json, material) ||
        (glossy && !read_glossy(gltf, glossy, material)) || !read_emission(gltf, json, material) ||
        !read_texture(gltf, json, "normalTexture", &material->normal) ||
        !read_texture(gltf, json, "occlusionTexture", &material->occlusion) ||
        !dip_gltf_numbers(gltf, sheen, "sheenColorFactor", 3, material->sheen)) {
        return false;
    }
    read_alpha(json, material);
    material->unlit = dip_gltf_extension(json, "KHR_materials_unlit") != NULL;
    material->normal_scale =
        clamp(dip_gltf_number_of(normal, "scale", 1.0), -max_normal_scale, max_normal_scale);
    material->occlusion_strength = unit_of(occlusion, "strength", 1.0);
    material->coat = unit_of(coat, "clearcoatFactor", 0.0);
    material->coat_roughness = unit_of(coat, "clearcoatRoughnessFactor", 0.0);
    material->sheen_roughness = unit_of(sheen, "sheenRoughnessFactor", 0.0);
    for (int i = 0; i < 3; ++i) {
        material->sheen[i] = clamp(material->sheen[i], 0.0, 1.0);
    }
    material->transmission = unit_of(transmission, "transmissionFactor", 0.0);
    for (int i = 0; i < 4; ++i) {
        material->base[i] = clamp(material->base[i], 0.0, 1.0);
    }
    return true;
}
