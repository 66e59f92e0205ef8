// Animated models while they are loaded: owns what the readers make.
#include "assets/animation.h"

#include "assets/animation/animation_parts.h"
#include "assets/importer.h"
#include "assets/picture.h"

#include <stdlib.h>
#include <string.h>

// Most memory of a model without its pictures. A small glTF file can ask for much, because its
// meshes may share the bytes of the file.
static const size_t max_model_bytes = (size_t)1 << 30;

// --- memory --------------------------------------------------------------------------------------

void *dip_animated_alloc(DipAnimatedModel *model, size_t count, size_t item_bytes) {
    const size_t left = model->most_bytes - model->allocated_bytes;
    if (item_bytes > 0 && count > left / item_bytes) {
        model->too_large = true;
        return NULL;
    }
    model->allocated_bytes += count * item_bytes;
    return dip_model_alloc(model->store, count, item_bytes);
}

bool dip_animated_no_room(const DipAnimatedModel *model, DipError *err) {
    if (!model->too_large) {
        return dip_model_out_of_memory(err, model->path);
    }
    return dip_error_set(err, DIP_ERROR_OVERSIZED, model->path, 0, NULL,
                         "the model needs more memory than is accepted: %zu MiB",
                         model->most_bytes >> 20);
}

const char *dip_animated_text(DipAnimatedModel *model, const char *text, size_t length) {
    const size_t size_bytes = strnlen(text, length);
    char *copy = dip_animated_alloc(model, size_bytes + 1, 1);
    for (size_t i = 0; copy && i < size_bytes; ++i) {
        copy[i] = (unsigned char)text[i] < ' ' ? '?' : text[i];
    }
    return copy;
}

// --- materials and textures ----------------------------------------------------------------------

DipMaterialDef dip_animated_material(const char *name) {
    return (DipMaterialDef){
        .name = name,
        .surface = DIP_SURFACE_OPAQUE,
        .base_colour_lin = {1.0f, 1.0f, 1.0f},
        .colour_texture = DIP_NO_TEXTURE,
        .light_map = DIP_NO_TEXTURE,
        .normal_map = DIP_NO_TEXTURE,
        .light_map_scale = 1.0f,
        .roughness = 0.6f,
        .alpha_cutoff = 0.5f,
        .double_sided = true,
        .lit = true,
        .opacity = 1.0f,
    };
}

// Takes over a decoded picture as the next texture, or warns that it could not be decoded.
static bool add_texture(DipAnimatedModel *model, bool decoded, const DipPicture *picture,
                        const char *name, const DipError *why, int *texture, DipError *err) {
    *texture = DIP_NO_TEXTURE;
    if (!decoded && why->origin == DIP_ORIGIN_RUNTIME) {
        if (err) {
            *err = *why;
        }
        return false;
    }
    if (!decoded) {
        dip_model_warn(model->store, model->path, NULL,
                       "its surfaces are drawn in their base colour, because the picture %s cannot "
                       "be used: %s",
                       name, why->message);
        return true;
    }
    const int index = model->def.texture_count++;
    model->pictures[index] = *picture;
    model->textures[index] = (DipTextureDef){.name = name,
                                             .width = picture->width,
                                             .height = picture->height,
                                             .rgba8 = picture->rgba8,
                                             .encoding = DIP_ENCODING_SRGB};
    *texture = index;
    return true;
}

bool dip_animated_add_picture(DipAnimatedModel *model, const uint8_t *bytes, size_t size_bytes,
                              const char *name, int *texture, DipError *err) {
    DipPicture picture;
    DipError why = {0};
    if (model->shapes_only) {
        *texture = DIP_NO_TEXTURE;
        return true;
    }
    const bool decoded = dip_picture_decode(bytes, size_bytes, name, &picture, &why);
    return add_texture(model, decoded, &picture, name, &why, texture, err);
}

bool dip_animated_add_picture_file(DipAnimatedModel *model, const char *picture_path, int *texture,
                                   DipError *err) {
    DipPicture picture;
    DipError why = {0};
    if (model->shapes_only) {
        *texture = DIP_NO_TEXTURE;
        return true;
    }
    char *found = dip_model_find_file(model->path, picture_path);
    const char *name = found ? dip_animated_text(model, found, strlen(found)) : NULL;
    if (!name) {
        free(found);
        return dip_animated_no_room(model, err);
    }
    const bool decoded = dip_picture_import(found, model->importer, &picture, &why);
    free(found);
    return add_texture(model, decoded, &picture, name, &why, texture, err);
}

// --- the model -----------------------------------------------------------------------------------

DipAnimatedModel *dip_animated_model_make(const char *path) {
    DipAnimatedModel *model = calloc(1, sizeof *model);
    if (model) {
        model->most_bytes = max_model_bytes;
        model->store = calloc(1, sizeof *model->store);
        model->path = model->store ? dip_model_copy_text(model->store, path) : NULL;
        if (!model->path) {
            dip_animated_model_destroy(&model);
        }
    }
    return model;
}

DipRig dip_animated_rig(const DipAnimatedModel *model) {
    return (DipRig){.nodes = model->nodes,
                    .node_count = model->node_count,
                    .rest_weights = model->rest_weights,
                    .weight_count = model->weight_count};
}

void dip_animated_model_destroy(DipAnimatedModel **model_pointer) {
    DipAnimatedModel *model = *model_pointer;
    if (!model) {
        return;
    }
    *model_pointer = NULL;
    for (int i = 0; i < model->def.texture_count; ++i) {
        dip_picture_free(&model->pictures[i]);
    }
    dip_model_destroy(&model->store);
    free(model);
}

const DipAnimatedDef *dip_animated_model_def(const DipAnimatedModel *model) {
    return &model->def;
}

int dip_animated_model_find(const DipAnimatedModel *model, const char *animation_name) {
    for (int i = 0; i < model->def.animation_count; ++i) {
        if (strcmp(model->animations[i].name, animation_name) == 0) {
            return i;
        }
    }
    return -1;
}
