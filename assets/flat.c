// Flat shading: gives every triangle of the lit meshes vertices of its own, with the normal of its
// face.
#include "assets/model_parts.h"

#include <string.h>

// Copies the values of the mesh's corners, `width` floats each. An attribute that the mesh lacks
// stays NULL.
static bool unshare(DipModel *model, const DipMeshDef *mesh, const float **values, size_t width) {
    const float *from = *values;
    if (!from) {
        return true;
    }
    float *to = dip_model_alloc(model, mesh->index_count, width * sizeof *to);
    for (size_t i = 0; to && i < mesh->index_count; ++i) {
        memcpy(to + width * i, from + width * mesh->indices[i], width * sizeof *to);
    }
    *values = to;
    return to != NULL;
}

// Writes the normal of a face to its three corners. It points to the side of the vertices' normals,
// because the winding of double-sided surfaces may be either way round. A face without area takes
// the sum of the vertices' normals.
static void flatten_face(const float *positions, float *normals) {
    double u[3], v[3], face[3], sum[3];
    for (int i = 0; i < 3; ++i) {
        u[i] = (double)positions[3 + i] - (double)positions[i];
        v[i] = (double)positions[6 + i] - (double)positions[i];
        sum[i] = (double)normals[i] + (double)normals[3 + i] + (double)normals[6 + i];
    }
    double along = 0.0;
    double square = 0.0;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        face[i] = u[j] * v[k] - u[k] * v[j];
        along += face[i] * sum[i];
        square += face[i] * face[i];
    }
    for (int i = 0; i < 3; ++i) {
        face[i] = along < 0.0 ? -face[i] : face[i];
    }
    dip_model_unit_normal(square > 0.0 ? face : sum, normals);
    memcpy(normals + 3, normals, 3 * sizeof *normals);
    memcpy(normals + 6, normals, 3 * sizeof *normals);
}

static bool flatten_mesh(DipModel *model, DipMeshDef *mesh) {
    uint32_t *indices = dip_model_alloc(model, mesh->index_count, sizeof *indices);
    if (!indices || !unshare(model, mesh, &mesh->positions, 3) ||
        !unshare(model, mesh, &mesh->normals, 3) || !unshare(model, mesh, &mesh->uv0, 2) ||
        !unshare(model, mesh, &mesh->uv1, 2) || !unshare(model, mesh, &mesh->colours_lin, 3) ||
        !unshare(model, mesh, &mesh->alphas, 1)) {
        return false;
    }
    float *normals = (float *)mesh->normals; // unshare has just allocated them.
    for (uint32_t i = 0; i < mesh->index_count; ++i) {
        indices[i] = i;
        if (i % 3 == 0) {
            flatten_face(mesh->positions + 3 * (size_t)i, normals + 3 * (size_t)i);
        }
    }
    const bool ok = dip_model_flatten_motion(model, (int)(mesh - model->meshes), mesh->indices,
                                             mesh->index_count);
    mesh->vertex_count = mesh->index_count;
    mesh->indices = indices;
    return ok;
}

bool dip_model_flatten(DipModel *model, DipError *err) {
    for (int i = 0; i < model->def.mesh_count; ++i) {
        DipMeshDef *mesh = &model->meshes[i];
        if (model->materials[mesh->material].lit && !flatten_mesh(model, mesh)) {
            return dip_model_out_of_memory(err, model->files[model->mesh_keys[i].file].path);
        }
    }
    return true;
}
