// Adds surfaces that the program itself makes, such as the ground, to scenes of models.
#include "app/session/added_surface.h"

#include <stdlib.h>
#include <string.h>

// Returns a copy of an array with room for one more item.
static void *longer(const void *items, int count, size_t item_bytes) {
    void *copy = malloc(((size_t)count + 1) * item_bytes);
    if (copy && count) {
        memcpy(copy, items, (size_t)count * item_bytes);
    }
    return copy;
}

bool dip_scene_def_begin_surface(const DipSceneDef *def, DipSceneDef *copy) {
    *copy = *def;
    copy->textures = longer(def->textures, def->texture_count, sizeof *def->textures);
    copy->materials = longer(def->materials, def->material_count, sizeof *def->materials);
    copy->meshes = longer(def->meshes, def->mesh_count, sizeof *def->meshes);
    copy->objects = longer(def->objects, def->object_count, sizeof *def->objects);
    return copy->textures && copy->materials && copy->meshes && copy->objects;
}

void dip_scene_def_add_surface(DipSceneDef *copy, const DipTextureDef *texture,
                               const float colour_lin[3], const DipMeshDef *mesh) {
    DipMaterialDef material = {.name = mesh->name,
                               .surface = DIP_SURFACE_OPAQUE,
                               .colour_texture = copy->texture_count,
                               .light_map = DIP_NO_TEXTURE,
                               .normal_map = DIP_NO_TEXTURE};
    memcpy(material.base_colour_lin, colour_lin, sizeof material.base_colour_lin);
    DipMeshDef *added = (DipMeshDef *)copy->meshes + copy->mesh_count;
    *added = *mesh;
    added->material = copy->material_count;
    ((DipTextureDef *)copy->textures)[copy->texture_count++] = *texture;
    ((DipMaterialDef *)copy->materials)[copy->material_count++] = material;
    ((DipObjectDef *)copy->objects)[copy->object_count++] =
        (DipObjectDef){.name = mesh->name,
                       .mesh = copy->mesh_count++,
                       .transform = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
}

void dip_scene_def_free_surface(DipSceneDef *copy) {
    free((void *)copy->textures);
    free((void *)copy->materials);
    free((void *)copy->meshes);
    free((void *)copy->objects);
}
