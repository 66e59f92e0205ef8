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

// Makes all arrays. Returns false when memory runs out.
static bool make_arrays(DipAddedSurface *added, const DipTextureDef *texture,
                        const DipMeshDef *mesh) {
    DipSceneDef *def = &added->def;
    added->rgba8 = malloc((size_t)texture->width * (size_t)texture->height * 4);
    added->positions = malloc((size_t)mesh->vertex_count * 3 * sizeof *added->positions);
    added->uv = malloc((size_t)mesh->vertex_count * 2 * sizeof *added->uv);
    added->indices = malloc((size_t)mesh->index_count * sizeof *added->indices);
    def->textures = longer(def->textures, def->texture_count, sizeof *def->textures);
    def->materials = longer(def->materials, def->material_count, sizeof *def->materials);
    def->meshes = longer(def->meshes, def->mesh_count, sizeof *def->meshes);
    def->objects = longer(def->objects, def->object_count, sizeof *def->objects);
    return added->rgba8 && added->positions && added->uv && added->indices && def->textures &&
           def->materials && def->meshes && def->objects;
}

static void append(DipAddedSurface *added, const DipTextureDef *texture, const float colour_lin[3],
                   const DipMeshDef *mesh) {
    DipSceneDef *def = &added->def;
    DipTextureDef *last_texture = (DipTextureDef *)def->textures + def->texture_count;
    DipMeshDef *last_mesh = (DipMeshDef *)def->meshes + def->mesh_count;
    DipMaterialDef material = {.name = mesh->name,
                               .surface = DIP_SURFACE_OPAQUE,
                               .colour_texture = def->texture_count++,
                               .light_map = DIP_NO_TEXTURE,
                               .normal_map = DIP_NO_TEXTURE};
    memcpy(material.base_colour_lin, colour_lin, sizeof material.base_colour_lin);
    *last_texture = *texture;
    last_texture->rgba8 = added->rgba8;
    *last_mesh = *mesh;
    last_mesh->positions = added->positions;
    last_mesh->uv0 = added->uv;
    last_mesh->indices = added->indices;
    last_mesh->material = def->material_count;
    ((DipMaterialDef *)def->materials)[def->material_count++] = material;
    ((DipObjectDef *)def->objects)[def->object_count++] =
        (DipObjectDef){.name = mesh->name,
                       .mesh = def->mesh_count++,
                       .transform = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
}

DipAddedSurface *dip_added_surface_create(const DipSceneDef *def, const DipTextureDef *texture,
                                          const float colour_lin[3], const DipMeshDef *mesh,
                                          DipError *err) {
    DipAddedSurface *added = calloc(1, sizeof *added);
    if (added) {
        added->def = *def;
    }
    if (added && make_arrays(added, texture, mesh)) {
        append(added, texture, colour_lin, mesh);
        return added;
    }
    dip_added_surface_destroy(&added);
    dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, mesh->name, "out of memory");
    return NULL;
}

void dip_added_surface_destroy(DipAddedSurface **surface) {
    DipAddedSurface *added = *surface;
    if (added) {
        free((void *)added->def.textures);
        free((void *)added->def.materials);
        free((void *)added->def.meshes);
        free((void *)added->def.objects);
        free(added->rgba8);
        free(added->positions);
        free(added->uv);
        free(added->indices);
        free(added);
        *surface = NULL;
    }
}
