// Converts assimp's meshes to the packed arrays of the scene, and keeps each mesh once.
#include "assets/model_parts.h"

#include <assimp/mesh.h>
#include <assimp/scene.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool dip_mesh_is_triangles(const struct aiMesh *mesh) {
    const unsigned kinds =
        aiPrimitiveType_POINT | aiPrimitiveType_LINE | aiPrimitiveType_TRIANGLE |
        aiPrimitiveType_POLYGON; // Other bits tell what the triangles were made from.
    return (mesh->mPrimitiveTypes & kinds) == aiPrimitiveType_TRIANGLE;
}

// True if a vector has a direction.
static bool is_normal(struct aiVector3D n) {
    return isfinite(n.x) && isfinite(n.y) && isfinite(n.z) &&
           (n.x != 0.0f || n.y != 0.0f || n.z != 0.0f);
}

// True if normals must be made: the mesh has none, or some that are zero, as many STL files do.
static bool lacks_normals(const struct aiMesh *mesh) {
    for (unsigned i = 0; mesh->mNormals && i < mesh->mNumVertices; ++i) {
        if (!is_normal(mesh->mNormals[i])) {
            return true;
        }
    }
    return !mesh->mNormals;
}

// Decides which vertices of the file become vertices of the mesh, and in which order. If normals
// must be made, each corner of a face becomes a vertex; otherwise each vertex is used once.
typedef struct VertexSource {
    const struct aiMesh *mesh;
    bool by_corner;
    uint32_t count;
} VertexSource;

static VertexSource vertex_source(const struct aiMesh *mesh) {
    const bool by_corner = lacks_normals(mesh);
    return (VertexSource){mesh, by_corner, by_corner ? 3 * mesh->mNumFaces : mesh->mNumVertices};
}

static unsigned source_vertex(const VertexSource *source, uint32_t i) {
    return source->by_corner ? source->mesh->mFaces[i / 3].mIndices[i % 3] : i;
}

static float *pack_positions(DipModel *model, const VertexSource *source) {
    float *to = dip_model_alloc(model, source->count, 3 * sizeof *to);
    for (uint32_t i = 0; to && i < source->count; ++i) {
        const struct aiVector3D p = source->mesh->mVertices[source_vertex(source, i)];
        to[3 * (size_t)i + 0] = p.x;
        to[3 * (size_t)i + 1] = p.y;
        to[3 * (size_t)i + 2] = p.z;
    }
    return to;
}

void dip_model_unit_normal(const double n[3], float to[3]) {
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    const bool usable = isfinite(length) && length > 0.0;
    to[0] = usable ? (float)(n[0] / length) : 0.0f;
    to[1] = usable ? (float)(n[1] / length) : 1.0f;
    to[2] = usable ? (float)(n[2] / length) : 0.0f;
}

static float *pack_normals(DipModel *model, const VertexSource *source) {
    const struct aiVector3D *from = source->mesh->mNormals;
    float *to = source->by_corner ? dip_model_make_normals(model, source->mesh)
                                  : dip_model_alloc(model, source->count, 3 * sizeof *to);
    for (uint32_t i = 0; to && from && i < source->count; ++i) {
        const struct aiVector3D n = from[source_vertex(source, i)];
        const double normal[3] = {n.x, n.y, n.z};
        if (is_normal(n)) { // Otherwise the one that has been made stays.
            dip_model_unit_normal(normal, to + 3 * (size_t)i);
        }
    }
    return to;
}

static float *pack_uv(DipModel *model, const VertexSource *source, int channel) {
    const struct aiVector3D *from = source->mesh->mTextureCoords[channel];
    float *to = dip_model_alloc(model, source->count, 2 * sizeof *to);
    for (uint32_t i = 0; to && i < source->count; ++i) {
        const struct aiVector3D uv = from[source_vertex(source, i)];
        to[2 * (size_t)i + 0] = isfinite(uv.x) ? uv.x : 0.0f;
        to[2 * (size_t)i + 1] = isfinite(uv.y) ? uv.y : 0.0f;
    }
    return to;
}

static float *pack_colours(DipModel *model, const VertexSource *source, bool linear) {
    DipColourReader reader;
    dip_mesh_colours(source->mesh, linear, &reader);
    float *to = dip_model_alloc(model, source->count, 3 * sizeof *to);
    for (uint32_t i = 0; to && i < source->count; ++i) {
        dip_read_colour(&reader, source_vertex(source, i), to + 3 * (size_t)i);
    }
    return to;
}

static const size_t attribute_width[DIP_ATTRIBUTE_COUNT] = {3, 3, 2, 2, 3, 1};

// Hashes the bits of a vertex's values with FNV-1a.
static uint32_t hash_vertex(const DipVertexArrays *arrays, size_t vertex) {
    uint32_t hash = 2166136261u;
    for (int a = 0; a < DIP_ATTRIBUTE_COUNT; ++a) {
        for (size_t k = 0; arrays->values[a] && k < attribute_width[a]; ++k) {
            uint32_t bits = 0;
            memcpy(&bits, &arrays->values[a][attribute_width[a] * vertex + k], sizeof bits);
            hash = (hash ^ bits) * 16777619u;
            hash ^= hash >> 15;
        }
    }
    return hash;
}

static bool same_vertex(const DipVertexArrays *arrays, size_t one, size_t other) {
    for (int a = 0; a < DIP_ATTRIBUTE_COUNT; ++a) {
        const size_t width = attribute_width[a];
        const float *values = arrays->values[a];
        if (values &&
            memcmp(values + width * one, values + width * other, width * sizeof *values) != 0) {
            return false;
        }
    }
    return true;
}

static void move_vertex(const DipVertexArrays *arrays, size_t to, size_t from) {
    for (int a = 0; a < DIP_ATTRIBUTE_COUNT; ++a) {
        const size_t width = attribute_width[a];
        float *values = arrays->values[a];
        if (values) {
            memmove(values + width * to, values + width * from, width * sizeof *values);
        }
    }
}

// Merges vertices that are equal in every bit of every attribute and packs the rest. Fills remap
// (from old index to new) and returns the new number of vertices, or 0 when memory runs out.
static uint32_t join_vertices(const DipVertexArrays *arrays, uint32_t count, uint32_t *remap) {
    size_t slots = 16;
    while (slots < 2 * (size_t)count) {
        slots *= 2;
    }
    uint32_t *table = malloc(slots * sizeof *table);
    if (!table) {
        return 0;
    }
    memset(table, 0xff, slots * sizeof *table); // UINT32_MAX marks a free slot.
    uint32_t kept = 0;
    for (uint32_t vertex = 0; vertex < count; ++vertex) {
        size_t slot = hash_vertex(arrays, vertex) & (slots - 1);
        while (table[slot] != UINT32_MAX && !same_vertex(arrays, table[slot], vertex)) {
            slot = (slot + 1) & (slots - 1);
        }
        if (table[slot] == UINT32_MAX) {
            move_vertex(arrays, kept, vertex);
            table[slot] = kept++;
        }
        remap[vertex] = table[slot];
    }
    free(table);
    return kept;
}

bool dip_model_join(DipModel *model, const DipVertexArrays *arrays, uint32_t count, DipMeshDef *def,
                    uint32_t **remap) {
    *remap = dip_model_alloc(model, count, sizeof **remap);
    def->vertex_count = *remap ? join_vertices(arrays, count, *remap) : 0;
    def->positions = arrays->values[0];
    def->normals = arrays->values[1];
    def->uv0 = arrays->values[2];
    def->uv1 = arrays->values[3];
    def->colours_lin = arrays->values[4];
    def->alphas = arrays->values[5];
    return def->vertex_count > 0;
}

static uint32_t *pack_indices(DipModel *model, const VertexSource *source, const uint32_t *remap) {
    const struct aiMesh *mesh = source->mesh;
    uint32_t *to = dip_model_alloc(model, mesh->mNumFaces, 3 * sizeof *to);
    for (unsigned f = 0; to && f < mesh->mNumFaces; ++f) {
        for (unsigned k = 0; k < 3; ++k) {
            to[3 * (size_t)f + k] =
                remap[source->by_corner ? 3 * f + k : mesh->mFaces[f].mIndices[k]];
        }
    }
    return to;
}

int dip_model_find_mesh(const DipModel *model, const DipMeshKey *key) {
    for (int i = 0; i < model->def.mesh_count; ++i) {
        const DipMeshKey *other = &model->mesh_keys[i];
        if (other->file == key->file && other->source == key->source &&
            other->material == key->material && other->object == key->object) {
            return i;
        }
    }
    return DIP_NOT_FOUND;
}

static bool fill_arrays(DipModel *model, const struct aiMesh *mesh, const DipMeshKey *key,
                        DipMeshDef *def) {
    const DipMaterialPlan *plan = &model->plans[key->material];
    const bool linear = model->files[key->file].linear_colours;
    const int uv0 = plan->colour.picture >= 0    ? plan->colour.uv_channel
                    : plan->opacity.picture >= 0 ? plan->opacity.uv_channel
                                                 : plan->normal.uv_channel;
    const VertexSource source = vertex_source(mesh);
    float *positions = pack_positions(model, &source);
    float *normals = pack_normals(model, &source);
    float *uvs0 = plan->has_uv0 ? pack_uv(model, &source, uv0) : NULL;
    float *uvs1 = plan->has_uv1 ? pack_uv(model, &source, plan->light.uv_channel) : NULL;
    const bool has_colours = dip_mesh_has_colours(mesh, linear);
    float *colours = has_colours ? pack_colours(model, &source, linear) : NULL;
    if (!positions || !normals || (plan->has_uv0 && !uvs0) || (plan->has_uv1 && !uvs1) ||
        (has_colours && !colours)) {
        return false;
    }
    const DipVertexArrays arrays = {{positions, normals, uvs0, uvs1, colours}};
    uint32_t *remap;
    if (!dip_model_join(model, &arrays, source.count, def, &remap)) {
        return false;
    }
    def->indices = pack_indices(model, &source, remap);
    return def->indices;
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

int dip_model_add_mesh(DipModel *model, const DipMeshDef *def, const DipMeshKey *key) {
    if (!add_room(model)) {
        return DIP_NOT_FOUND;
    }
    model->meshes[model->def.mesh_count] = *def;
    model->mesh_keys[model->def.mesh_count] = *key;
    return model->def.mesh_count++;
}

int dip_model_mesh(DipModel *model, int file, unsigned source, int material, DipError *err) {
    const DipMeshKey key = {file, source, material, DIP_NOT_FOUND};
    const int known = dip_model_find_mesh(model, &key);
    if (known >= 0) {
        return known;
    }
    const struct aiMesh *mesh = model->files[file].scene->mMeshes[source];
    const char *path = model->files[file].path;
    if (mesh->mNumFaces > UINT32_MAX / 3) {
        dip_error_set(err, DIP_ERROR_RANGE, path, 0, mesh->mName.data,
                      "the mesh has too many triangles: %u", mesh->mNumFaces);
        return DIP_NOT_FOUND;
    }
    DipMeshDef def = {
        .name = dip_model_copy_text(model, mesh->mName.data),
        .index_count = 3 * mesh->mNumFaces,
        .material = material,
    };
    const bool ok = def.name && fill_arrays(model, mesh, &key, &def);
    const int index = ok ? dip_model_add_mesh(model, &def, &key) : DIP_NOT_FOUND;
    if (index < 0) {
        dip_model_out_of_memory(err, path);
    }
    return index;
}
