// Reads animated glTF models: calls the readers of the parts in order, and makes the materials and
// textures.
#include "assets/gltf/materials.h"
#include "assets/gltf/reader.h"

#include <cjson/cJSON.h>

#include <string.h>

enum { TEXTURE_UNREAD = -2, MATERIAL_UNREAD = -1 };

static bool prepare_materials(DipGltfReader *reader) {
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

static bool read_image(DipGltfReader *reader, int index, int *texture) {
    DipGltf *gltf = &reader->gltf;
    const char *uri;
    const uint8_t *bytes;
    size_t size_bytes;
    if (!dip_gltf_image(gltf, index, &uri, &bytes, &size_bytes)) {
        return false;
    }
    if (uri) {
        return dip_animated_add_picture_file(reader->model, uri, texture, gltf->err);
    }
    const cJSON *image = dip_gltf_item(gltf, DIP_GLTF_images, index);
    const char *name = dip_gltf_name(reader, image, "image", index);
    return name ? dip_animated_add_picture(reader->model, bytes, size_bytes, name, texture,
                                           gltf->err)
                : dip_gltf_no_room(reader);
}

// Finds the texture of the model for one of the file.
static bool read_texture(DipGltfReader *reader, int index, int *texture) {
    int *read = &reader->texture_of[index];
    if (*read == TEXTURE_UNREAD) {
        DipGltfTextureSource source;
        *read = DIP_NO_TEXTURE;
        if (!dip_gltf_describe_texture(&reader->gltf, index, &source) ||
            (source.image >= 0 && !read_image(reader, source.image, read))) {
            return false;
        }
        if (*read >= 0) {
            reader->model->textures[*read].wrap_u = source.wrap_u;
            reader->model->textures[*read].wrap_v = source.wrap_v;
        }
    }
    *texture = *read;
    return true;
}

// --- materials -----------------------------------------------------------------------------------

// Decides whether the surface is clipped.
static void set_alpha(DipGltfReader *reader, const DipGltfMaterial *from,
                      DipMaterialDef *material) {
    const float alpha = (float)from->base[3];
    const float cutoff = (float)from->cutoff;
    const int texture = material->colour_texture;
    if (from->alpha == DIP_GLTF_OPAQUE) {
        return;
    }
    if (from->alpha == DIP_GLTF_BLEND) {
        dip_model_warn(reader->model->store, reader->model->path, material->name,
                       "blending is not kept: the surface is clipped at an alpha of 0.5");
    } else {
        material->alpha_cutoff = dip_texel_cutoff(cutoff, alpha);
        if (alpha < cutoff) {
            dip_model_warn(reader->model->store, reader->model->path, material->name,
                           "the surface is drawn, although its base alpha of %g is below its "
                           "cutoff of %g",
                           (double)alpha, (double)cutoff);
        }
    }
    if (texture >= 0 && reader->model->pictures[texture].has_alpha) {
        material->surface = DIP_SURFACE_CLIPPED;
    }
}

static bool make_material(DipGltfReader *reader, int index, DipMaterialDef *def) {
    DipGltfMaterial from;
    if (!dip_gltf_describe_material(&reader->gltf, index, &from)) {
        return false;
    }
    const cJSON *json = index < 0 ? NULL : dip_gltf_item(&reader->gltf, DIP_GLTF_materials, index);
    const char *name = dip_gltf_name(reader, json, "material", index);
    if (!name) {
        return dip_gltf_no_room(reader);
    }
    *def = dip_animated_material(name);
    def->double_sided = from.double_sided;
    def->roughness = (float)from.roughness;
    for (int i = 0; i < 3; ++i) {
        def->base_colour_lin[i] = (float)from.base[i];
    }
    reader->coordinates_of[reader->model->def.material_count] = from.colour.placement.set;
    if (from.colour.index >= 0 && !read_texture(reader, from.colour.index, &def->colour_texture)) {
        return false;
    }
    set_alpha(reader, &from, def);
    return true;
}

bool dip_gltf_material(DipGltfReader *reader, int index, int *material) {
    const int count = reader->gltf.tables[DIP_GLTF_materials].count;
    int *known = &reader->material_of[index < 0 ? count : index];
    if (*known == MATERIAL_UNREAD) {
        DipMaterialDef def;
        if (!make_material(reader, index, &def)) {
            return false;
        }
        reader->model->materials[reader->model->def.material_count] = def;
        *known = reader->model->def.material_count++;
    }
    *material = *known;
    return true;
}

// --- the model -----------------------------------------------------------------------------------

static bool read_parts(DipGltfReader *reader) {
    const DipAnimatedDef *def = &reader->model->def;
    if (!dip_gltf_check_extensions(&reader->gltf, NULL) || !prepare_materials(reader) ||
        !dip_gltf_read_meshes(reader) || !dip_gltf_read_nodes(reader)) {
        return false;
    }
    if (def->object_count == 0) {
        return dip_gltf_refuse(&reader->gltf, DIP_ERROR_MISSING, NULL,
                               "the model has no triangles");
    }
    return dip_gltf_read_animations(reader);
}

bool dip_animated_read_gltf(DipAnimatedModel *model, DipError *err) {
    DipGltfReader reader = {.model = model};
    const bool ok = dip_gltf_open(&reader.gltf, model->path, err) && read_parts(&reader);
    dip_gltf_close(&reader.gltf);
    return ok;
}
