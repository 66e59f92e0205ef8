// Meshes: assimp's arrays of structures to the scene's packed arrays.
#include "assets/model_parts.h"

#include <assimp/mesh.h>
#include <assimp/scene.h>

#include <math.h>
#include <string.h>

bool dip_mesh_is_triangles(const struct aiMesh *mesh) {
    const unsigned kinds = aiPrimitiveType_POINT | aiPrimitiveType_LINE | aiPrimitiveType_TRIANGLE |
                           aiPrimitiveType_POLYGON; // the other bits say where triangles come from
    return (mesh->mPrimitiveTypes & kinds) == aiPrimitiveType_TRIANGLE;
}

static float *pack_positions(DipModel *model, const struct aiMesh *mesh) {
    float *to = dip_model_alloc(model, mesh->mNumVertices, 3 * sizeof *to);
    for (unsigned i = 0; to && i < mesh->mNumVertices; ++i) {
        to[3 * i + 0] = mesh->mVertices[i].x;
        to[3 * i + 1] = mesh->mVertices[i].y;
        to[3 * i + 2] = mesh->mVertices[i].z;
    }
    return to;
}

// Normals come out unit; one that is zero or not finite (of a face without area) points up.
static float *pack_normals(DipModel *model, const struct aiMesh *mesh) {
    float *to = dip_model_alloc(model, mesh->mNumVertices, 3 * sizeof *to);
    for (unsigned i = 0; to && i < mesh->mNumVertices; ++i) {
        const struct aiVector3D n = mesh->mNormals[i];
        const double length = sqrt((double)n.x * n.x + (double)n.y * n.y + (double)n.z * n.z);
        const bool usable = isfinite(length) && length > 1e-20;
        to[3 * i + 0] = usable ? (float)(n.x / length) : 0.0f;
        to[3 * i + 1] = usable ? (float)(n.y / length) : 1.0f;
        to[3 * i + 2] = usable ? (float)(n.z / length) : 0.0f;
    }
    return to;
}

static float *pack_uv(DipModel *model, const struct aiMesh *mesh, int channel) {
    const struct aiVector3D *from = mesh->mTextureCoords[channel];
    float *to = dip_model_alloc(model, mesh->mNumVertices, 2 * sizeof *to);
    for (unsigned i = 0; to && i < mesh->mNumVertices; ++i) {
        to[2 * i + 0] = isfinite(from[i].x) ? from[i].x : 0.0f;
        to[2 * i + 1] = isfinite(from[i].y) ? from[i].y : 0.0f;
    }
    return to;
}

static float *pack_colours(DipModel *model, const struct aiMesh *mesh, bool linear) {
    float *to = dip_model_alloc(model, mesh->mNumVertices, 3 * sizeof *to);
    for (unsigned i = 0; to && i < mesh->mNumVertices; ++i) {
        to[3 * i + 0] = dip_model_colour_to_linear(mesh->mColors[0][i].r, linear);
        to[3 * i + 1] = dip_model_colour_to_linear(mesh->mColors[0][i].g, linear);
        to[3 * i + 2] = dip_model_colour_to_linear(mesh->mColors[0][i].b, linear);
    }
    return to;
}

// A mirroring transform turns the winding round; reversing it here turns it back.
static uint32_t *pack_indices(DipModel *model, const struct aiMesh *mesh, bool mirrored) {
    uint32_t *to = dip_model_alloc(model, mesh->mNumFaces, 3 * sizeof *to);
    for (unsigned f = 0; to && f < mesh->mNumFaces; ++f) {
        const unsigned *from = mesh->mFaces[f].mIndices;
        to[3 * f + 0] = from[0];
        to[3 * f + 1] = from[mirrored ? 2 : 1];
        to[3 * f + 2] = from[mirrored ? 1 : 2];
    }
    return to;
}

static int find_mesh(const DipModel *model, const DipMeshKey *key, bool any_mirroring) {
    for (int i = 0; i < model->def.mesh_count; ++i) {
        const DipMeshKey *other = &model->mesh_keys[i];
        if (other->file == key->file && other->source == key->source &&
            other->material == key->material &&
            (any_mirroring || other->mirrored == key->mirrored)) {
            return i;
        }
    }
    return DIP_NOT_FOUND;
}

static bool fill_vertices(DipModel *model, const struct aiMesh *mesh, const DipMeshKey *key,
                          DipMeshDef *def) {
    const DipMaterialPlan *plan = &model->plans[key->material];
    const bool linear = model->files[key->file].linear_colours;
    const int uv0 = plan->colour.picture >= 0    ? plan->colour.uv_channel
                    : plan->opacity.picture >= 0 ? plan->opacity.uv_channel
                                                 : plan->normal.uv_channel;
    bool ok = (def->positions = pack_positions(model, mesh)) != NULL;
    ok = ok && (!mesh->mNormals || (def->normals = pack_normals(model, mesh)));
    ok = ok && (!plan->has_uv0 || (def->uv0 = pack_uv(model, mesh, uv0)));
    ok = ok && (!plan->has_uv1 || (def->uv1 = pack_uv(model, mesh, plan->light.uv_channel)));
    ok = ok && (!mesh->mColors[0] || (def->colours_lin = pack_colours(model, mesh, linear)));
    return ok;
}

static bool add_room(DipModel *model) {
    DipMeshDef *meshes =
        dip_array_grow(model->meshes, model->def.mesh_count, sizeof *model->meshes);
    if (!meshes) {
        return false;
    }
    model->meshes = meshes;
    DipMeshKey *keys =
        dip_array_grow(model->mesh_keys, model->def.mesh_count, sizeof *model->mesh_keys);
    if (!keys) {
        return false;
    }
    model->mesh_keys = keys;
    return true;
}

int dip_model_mesh(DipModel *model, int file, unsigned source, int material, bool mirrored,
                   DipError *err) {
    const DipMeshKey key = {file, source, material, mirrored};
    const int known = find_mesh(model, &key, false);
    if (known >= 0) {
        return known;
    }
    const struct aiMesh *mesh = model->files[file].scene->mMeshes[source];
    const char *path = model->files[file].path;
    if (mesh->mNumFaces > UINT32_MAX / 3) {
        dip_error_set(err, DIP_ERROR_RANGE, path, 0, mesh->mName.data, "mesh has %u triangles",
                      mesh->mNumFaces);
        return DIP_NOT_FOUND;
    }
    DipMeshDef def = {0};
    const int twin = find_mesh(model, &key, true);
    bool ok = add_room(model);
    if (twin >= 0) {
        def = model->meshes[twin];
    } else {
        def.name = dip_model_copy_text(model, mesh->mName.data);
        def.vertex_count = mesh->mNumVertices;
        def.index_count = 3 * mesh->mNumFaces;
        def.material = material;
        ok = ok && def.name && fill_vertices(model, mesh, &key, &def);
    }
    ok = ok && (def.indices = pack_indices(model, mesh, mirrored)) != NULL;
    if (!ok) {
        dip_model_out_of_memory(err, path);
        return DIP_NOT_FOUND;
    }
    model->meshes[model->def.mesh_count] = def;
    model->mesh_keys[model->def.mesh_count] = key;
    return model->def.mesh_count++;
}
