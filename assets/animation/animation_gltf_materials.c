// Reads the materials, textures and pictures of animated glTF models.
#include "assets/animation/animation_gltf.h"

#include <cjson/cJSON.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TEXTURE_UNREAD = -2, MATERIAL_UNREAD = -1, WRAP_CLAMP = 33071, WRAP_MIRROR = 33648 };

bool dip_gltf_prepare_materials(DipGltfReader *reader) {
    const size_t materials = (size_t)reader->gltf.tables[DIP_GLTF_materials].count;
    const size_t textures = (size_t)reader->gltf.tables[DIP_GLTF_textures].count;
    DipAnimatedModel *model = reader->model;
    reader->material_of = dip_gltf_alloc(reader, materials + 1, sizeof(int));
    reader->coordinates_of = dip_gltf_alloc(reader, materials + 1, sizeof(int));
    reader->texture_of = dip_gltf_alloc(reader, textures, sizeof(int));
    model->materials = dip_gltf_alloc(reader, materials + 1, sizeof *model->materials);
    model->textures = dip_gltf_alloc(reader, textures, sizeof *model->textures);
    model->pictures = dip_gltf_alloc(reader, textures, sizeof *model->pictures);
    if (!reader->material_of || !reader->coordinates_of || !reader->texture_of ||
        !model->materials || !model->textures || !model->pictures) {
        return dip_gltf_no_room(reader);
    }
    for (size_t i = 0; i <= materials; ++i) {
        reader->material_of[i] = MATERIAL_UNREAD;
    }
    for (size_t i = 0; i < textures; ++i) {
        reader->texture_of[i] = TEXTURE_UNREAD;
    }
    return true;
}

// --- textures ------------------------------------------------------------------------------------

static bool decode_bytes(DipGltfReader *reader, const char *name, const uint8_t *bytes,
                         size_t size_bytes, int *texture) {
    return dip_animated_add_picture(reader->model, bytes, size_bytes, name, texture,
                                    reader->gltf.err);
}

static bool read_image(DipGltfReader *reader, int index, int *texture) {
    DipGltf *gltf = &reader->gltf;
    const cJSON *image = dip_gltf_item(gltf, DIP_GLTF_images, index);
    const cJSON *uri = cJSON_GetObjectItemCaseSensitive(image, "uri");
    const char *name = image ? dip_gltf_name(reader, image, "image", index) : NULL;
    if (!name) {
        return image && dip_gltf_no_room(reader);
    }
    if (cJSON_IsString(uri) && strncmp(uri->valuestring, "data:", 5) != 0) {
        return dip_animated_add_picture_file(reader->model, uri->valuestring, texture, gltf->err);
    }
    size_t size_bytes = 0;
    if (cJSON_IsString(uri)) {
        uint8_t *decoded = dip_gltf_decode_data(gltf, uri->valuestring, &size_bytes);
        const bool ok = decoded && decode_bytes(reader, name, decoded, size_bytes, texture);
        free(decoded);
        return ok;
    }
    const uint8_t *bytes;
    int view;
    int stride;
    return dip_gltf_integer(gltf, image, "bufferView", -1, &view) &&
           dip_gltf_view(gltf, view, &bytes, &size_bytes, &stride) &&
           decode_bytes(reader, name, bytes, size_bytes, texture);
}

static bool read_wrap(DipGltfReader *reader, const cJSON *sampler, const char *name,
                      DipWrap *wrap) {
    int mode;
    if (!dip_gltf_integer(&reader->gltf, sampler, name, 0, &mode)) {
        return false;
    }
    if (mode == WRAP_MIRROR) {
        dip_model_warn(reader->model->store, reader->model->path, name,
                       "the texture repeats mirrored, but is drawn repeating without mirroring");
    }
    *wrap = mode == WRAP_CLAMP ? DIP_WRAP_CLAMP : DIP_WRAP_REPEAT;
    return true;
}

static bool read_sampler(DipGltfReader *reader, const cJSON *json, DipTextureDef *texture) {
    int index;
    if (!dip_gltf_integer(&reader->gltf, json, "sampler", -1, &index)) {
        return false;
    }
    const cJSON *sampler =
        index >= 0 ? dip_gltf_item(&reader->gltf, DIP_GLTF_samplers, index) : NULL;
    return index < 0 || (sampler && read_wrap(reader, sampler, "wrapS", &texture->wrap_u) &&
                         read_wrap(reader, sampler, "wrapT", &texture->wrap_v));
}

static bool read_texture(DipGltfReader *reader, int index, int *texture) {
    DipGltf *gltf = &reader->gltf;
    const cJSON *json = dip_gltf_item(gltf, DIP_GLTF_textures, index);
    int image;
    if (!json || !dip_gltf_integer(gltf, json, "source", -1, &image)) {
        return false;
    }
    if (reader->texture_of[index] == TEXTURE_UNREAD) {
        int *read = &reader->texture_of[index];
        *read = DIP_NO_TEXTURE;
        if ((image >= 0 && !read_image(reader, image, read)) ||
            (*read >= 0 && !read_sampler(reader, json, &reader->model->textures[*read]))) {
            return false;
        }
    }
    *texture = reader->texture_of[index];
    return true;
}

// --- materials -----------------------------------------------------------------------------------

static bool read_base_colour(DipGltfReader *reader, const cJSON *json, DipMaterialDef *material,
                             double *alpha, int *coordinates) {
    const cJSON *shading = cJSON_GetObjectItemCaseSensitive(json, "pbrMetallicRoughness");
    const cJSON *texture = cJSON_GetObjectItemCaseSensitive(shading, "baseColorTexture");
    double factor[4] = {1.0, 1.0, 1.0, 1.0};
    const cJSON *roughness = cJSON_GetObjectItemCaseSensitive(shading, "roughnessFactor");
    int index = -1;
    if (!dip_gltf_numbers(&reader->gltf, shading, "baseColorFactor", 4, factor) ||
        !dip_gltf_integer(&reader->gltf, texture, "index", -1, &index) ||
        !dip_gltf_integer(&reader->gltf, texture, "texCoord", 0, coordinates)) {
        return false;
    }
    for (int i = 0; i < 3; ++i) {
        material->base_colour_lin[i] = (float)fmin(fmax(factor[i], 0.0), 1.0);
    }
    const double rough = cJSON_IsNumber(roughness) ? roughness->valuedouble : 1.0;
    material->roughness = (float)fmin(fmax(rough, 0.0), 1.0);
    *alpha = factor[3];
    return index < 0 || read_texture(reader, index, &material->colour_texture);
}

// Decides whether the surface is clipped, as the loader of scenes does (material.c).
static void read_alpha(DipGltfReader *reader, const cJSON *json, double alpha,
                       DipMaterialDef *material) {
    const cJSON *mode = cJSON_GetObjectItemCaseSensitive(json, "alphaMode");
    const cJSON *cutoff = cJSON_GetObjectItemCaseSensitive(json, "alphaCutoff");
    const char *name = cJSON_IsString(mode) ? mode->valuestring : "OPAQUE";
    const int texture = material->colour_texture;
    if (strcmp(name, "BLEND") == 0) {
        dip_model_warn(reader->model->store, reader->model->path, material->name,
                       "blending is not kept: the surface is clipped at an alpha of 0.5");
    } else if (strcmp(name, "MASK") != 0) {
        return;
    } else if (cJSON_IsNumber(cutoff) && alpha > 0.0) {
        material->alpha_cutoff = (float)fmin(fmax(cutoff->valuedouble / alpha, 0.0), 1.0);
    }
    if (texture >= 0 && reader->model->pictures[texture].has_alpha) {
        material->surface = DIP_SURFACE_CLIPPED;
    }
}

bool dip_gltf_material(DipGltfReader *reader, int index, int *material) {
    const int count = reader->gltf.tables[DIP_GLTF_materials].count;
    static const cJSON nothing = {.type = cJSON_Object};
    const cJSON *json =
        index < 0 ? &nothing : dip_gltf_item(&reader->gltf, DIP_GLTF_materials, index);
    if (!json) {
        return false;
    }
    int *known = &reader->material_of[index < 0 ? count : index];
    if (*known == MATERIAL_UNREAD) {
        const int next = reader->model->def.material_count;
        const char *name = dip_gltf_name(reader, json, "material", index);
        DipMaterialDef def = dip_animated_material(name);
        double alpha = 1.0;
        if (!name) {
            return dip_gltf_no_room(reader);
        }
        def.double_sided = cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(json, "doubleSided"));
        if (!read_base_colour(reader, json, &def, &alpha, &reader->coordinates_of[next])) {
            return false;
        }
        read_alpha(reader, json, alpha, &def);
        reader->model->materials[next] = def;
        *known = reader->model->def.material_count++;
    }
    *material = *known;
    return true;
}
