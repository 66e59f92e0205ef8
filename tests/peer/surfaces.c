// Finds the features, attributes and bounds of meshes.
#include "tests/peer/surfaces.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int dip_peer_features(const DipMeshDef *mesh, const DipMaterialDef *material) {
    int features = 0;
    if (material->colour_texture != DIP_NO_TEXTURE && mesh->uv0) {
        features |= DIP_PEER_TEXTURED;
        features |= material->surface == DIP_SURFACE_CLIPPED ? DIP_PEER_CLIPPED : 0;
    }
    if (material->light_map != DIP_NO_TEXTURE && mesh->uv1) {
        features |= DIP_PEER_LIGHT_MAPPED;
    } else if (material->lit && mesh->normals) {
        features |= DIP_PEER_LIT;
    }
    return features | (mesh->colours_lin ? DIP_PEER_COLOURED : 0);
}

DipPeerLayout dip_peer_layout(const DipMeshDef *mesh, int features) {
    const struct {
        int feature;
        DipPeerAttribute attribute;
    } rows[] = {
        {DIP_PEER_TEXTURED, {DIP_PEER_UV0, 2, mesh->uv0}},
        {DIP_PEER_LIGHT_MAPPED, {DIP_PEER_UV1, 2, mesh->uv1}},
        {DIP_PEER_LIT, {DIP_PEER_NORMAL, 3, mesh->normals}},
        {DIP_PEER_COLOURED, {DIP_PEER_COLOUR, 3, mesh->colours_lin}},
    };
    DipPeerLayout layout = {{{DIP_PEER_POSITION, 3, mesh->positions}}, 1, 3};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (features & rows[i].feature) {
            layout.attributes[layout.count++] = rows[i].attribute;
            layout.stride += rows[i].attribute.size;
        }
    }
    return layout;
}

float *dip_peer_interleave(const DipMeshDef *mesh, const DipPeerLayout *layout, DipError *err) {
    const size_t stride = (size_t)layout->stride;
    float *rows = malloc((stride * mesh->vertex_count + 1) * sizeof *rows);
    if (!rows) {
        dip_error_set(err, DIP_ERROR_MEMORY, mesh->name, 0, "mesh", "out of memory");
    }
    for (uint32_t v = 0; rows && v < mesh->vertex_count; v++) {
        float *row = rows + stride * v;
        for (int i = 0; i < layout->count; i++) {
            const size_t size = (size_t)layout->attributes[i].size;
            memcpy(row, layout->attributes[i].source + size * v, size * sizeof *row);
            row += size;
        }
    }
    return rows;
}

void dip_peer_bounds(const DipMeshDef *mesh, float min[3], float max[3]) {
    for (int axis = 0; axis < 3; axis++) {
        min[axis] = INFINITY;
        max[axis] = -INFINITY;
    }
    for (size_t i = 0; i < 3 * (size_t)mesh->vertex_count; i++) {
        min[i % 3] = fminf(min[i % 3], mesh->positions[i]);
        max[i % 3] = fmaxf(max[i % 3], mesh->positions[i]);
    }
}
