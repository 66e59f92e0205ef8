// Reads the meshes of animated glTF models, with their morph targets and joints.
#include "assets/animation/animation_gltf.h"

#include <cjson/cJSON.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MODE_TRIANGLES = 4, JOINTS_PER_VERTEX = 4 };

// A primitive while it is read.
typedef struct Primitive {
    DipGltfReader *reader;
    const cJSON *attributes;
    DipGltfItems targets;
    DipAnimatedMesh *mesh;
    float *positions;
    float *normals;
    bool has_normals;
} Primitive;

// --- attributes ----------------------------------------------------------------------------------

// Finds the accessor of an attribute. *found becomes false if the primitive lacks it.
static bool find_attribute(const Primitive *p, const cJSON *attributes, const char *name, int width,
                           DipGltfAccessor *accessor, bool *found) {
    DipGltf *gltf = &p->reader->gltf;
    int index;
    if (!dip_gltf_integer(gltf, attributes, name, -1, &index)) {
        return false;
    }
    *found = index >= 0;
    if (!*found) {
        return true;
    }
    if (!dip_gltf_accessor(gltf, index, width, name, accessor)) {
        return false;
    }
    const uint32_t expected = p->mesh->vertex_count;
    return expected == 0 || accessor->count == expected ||
           dip_gltf_refuse(gltf, DIP_ERROR_RANGE, name,
                           "the attribute has %u values, expected one for each of %u vertices",
                           accessor->count, expected);
}

// Reads an attribute of 3 floats, if the primitive has it.
static bool read_vectors(const Primitive *p, const cJSON *attributes, const char *name, float *to,
                         bool *found) {
    DipGltfAccessor accessor;
    return find_attribute(p, attributes, name, 3, &accessor, found) &&
           (!*found || dip_gltf_floats(&p->reader->gltf, &accessor, name, to));
}

// Finds out the number of vertices, and allocates the shapes.
static bool prepare_shapes(Primitive *p) {
    DipGltfAccessor accessor;
    bool found;
    if (!find_attribute(p, p->attributes, "POSITION", 3, &accessor, &found)) {
        return false;
    }
    if (!found) {
        return dip_gltf_refuse(&p->reader->gltf, DIP_ERROR_FORMAT, "meshes",
                               "the mesh \"%s\" has no positions", p->mesh->name);
    }
    p->mesh->vertex_count = accessor.count;
    p->mesh->shape_count = 1 + p->targets.count;
    const size_t rows = (size_t)p->mesh->shape_count * accessor.count;
    p->positions = dip_gltf_alloc(p->reader, rows, 3 * sizeof *p->positions);
    p->normals = dip_gltf_alloc(p->reader, rows, 3 * sizeof *p->normals);
    p->mesh->positions = p->positions;
    p->mesh->normals = p->normals;
    return (p->positions && p->normals) || dip_gltf_no_room(p->reader);
}

// Reads shape 0 and what the morph targets add to it. A target without normals adds nothing to
// them.
static bool read_shapes(Primitive *p) {
    bool found;
    if (!prepare_shapes(p)) {
        return false;
    }
    const size_t count = 3 * (size_t)p->mesh->vertex_count;
    if (!read_vectors(p, p->attributes, "POSITION", p->positions, &found) ||
        !read_vectors(p, p->attributes, "NORMAL", p->normals, &p->has_normals)) {
        return false;
    }
    for (int t = 0; t < p->targets.count; ++t) {
        const cJSON *target = dip_gltf_list_item(&p->reader->gltf, &p->targets, t, "targets");
        const size_t at = (size_t)(t + 1) * count;
        if (!target || !read_vectors(p, target, "POSITION", p->positions + at, &found) ||
            !read_vectors(p, target, "NORMAL", p->normals + at, &found)) {
            return false;
        }
    }
    return true;
}

static bool read_coordinates(Primitive *p) {
    DipGltfAccessor accessor;
    char name[32];
    bool found;
    snprintf(name, sizeof name, "TEXCOORD_%d", p->reader->coordinates_of[p->mesh->material]);
    if (!find_attribute(p, p->attributes, name, 2, &accessor, &found)) {
        return false;
    }
    if (!found) {
        return true;
    }
    float *uv = dip_gltf_alloc(p->reader, accessor.count, 2 * sizeof *uv);
    p->mesh->uv0 = uv;
    return uv ? dip_gltf_floats(&p->reader->gltf, &accessor, name, uv)
              : dip_gltf_no_room(p->reader);
}

// --- joints --------------------------------------------------------------------------------------

// Makes the weights of a vertex sum up to 1.
static bool normalise_weights(const Primitive *p, float weights[JOINTS_PER_VERTEX]) {
    double sum = 0.0;
    for (int i = 0; i < JOINTS_PER_VERTEX; ++i) {
        if (weights[i] < 0.0f) {
            return dip_gltf_refuse(&p->reader->gltf, DIP_ERROR_RANGE, "WEIGHTS_0",
                                   "a weight is negative");
        }
        sum += weights[i];
    }
    for (int i = 0; i < JOINTS_PER_VERTEX; ++i) {
        weights[i] = sum > 0.0 ? (float)(weights[i] / sum) : i == 0;
    }
    return true;
}

static void fill_joints(Primitive *p, const DipGltfAccessor *from, const float *weights,
                        uint16_t *joints) {
    int *max_joint = &p->reader->max_joints[p->reader->model->def.mesh_count];
    for (uint32_t i = 0; i < p->mesh->vertex_count; ++i) {
        for (int k = 0; k < JOINTS_PER_VERTEX; ++k) {
            const size_t at = JOINTS_PER_VERTEX * (size_t)i + (size_t)k;
            const uint32_t joint = dip_gltf_unsigned(from, i, k);
            joints[at] = weights[at] > 0.0f ? (uint16_t)joint : 0;
            *max_joint = joints[at] > *max_joint ? joints[at] : *max_joint;
        }
    }
    p->mesh->joints = joints;
    p->mesh->joint_weights = weights;
}

static bool read_joints(Primitive *p) {
    DipGltf *gltf = &p->reader->gltf;
    DipGltfAccessor joint_accessor;
    DipGltfAccessor weight_accessor;
    bool has_joints;
    bool has_weights;
    if (!find_attribute(p, p->attributes, "JOINTS_0", 4, &joint_accessor, &has_joints) ||
        !find_attribute(p, p->attributes, "WEIGHTS_0", 4, &weight_accessor, &has_weights)) {
        return false;
    }
    if (!has_joints || !has_weights) {
        return true;
    }
    if (joint_accessor.component != DIP_GLTF_UNSIGNED_BYTE &&
        joint_accessor.component != DIP_GLTF_UNSIGNED_SHORT) {
        return dip_gltf_refuse(gltf, DIP_ERROR_FORMAT, "JOINTS_0",
                               "the joints are not unsigned integers of 8 or 16 bits");
    }
    const size_t count = JOINTS_PER_VERTEX * (size_t)p->mesh->vertex_count;
    uint16_t *joints = dip_gltf_alloc(p->reader, count, sizeof *joints);
    float *weights = dip_gltf_alloc(p->reader, count, sizeof *weights);
    if (!joints || !weights) {
        return dip_gltf_no_room(p->reader);
    }
    if (!dip_gltf_floats(gltf, &weight_accessor, "WEIGHTS_0", weights)) {
        return false;
    }
    for (size_t i = 0; i < count; i += JOINTS_PER_VERTEX) {
        if (!normalise_weights(p, weights + i)) {
            return false;
        }
    }
    fill_joints(p, &joint_accessor, weights, joints);
    return true;
}

// --- indices and normals -------------------------------------------------------------------------

// Without indices, each three vertices are a triangle.
static bool read_indices(Primitive *p, const cJSON *json) {
    DipGltf *gltf = &p->reader->gltf;
    DipGltfAccessor accessor = {.count = p->mesh->vertex_count};
    int index;
    if (!dip_gltf_integer(gltf, json, "indices", -1, &index) ||
        (index >= 0 && !dip_gltf_accessor(gltf, index, 1, "indices", &accessor))) {
        return false;
    }
    if (index >= 0 && (accessor.component == DIP_GLTF_FLOAT || accessor.count % 3 != 0)) {
        return dip_gltf_refuse(gltf, DIP_ERROR_FORMAT, "indices",
                               "there are %u indices, accepted a multiple of 3 integers",
                               accessor.count);
    }
    const uint32_t count = accessor.count - accessor.count % 3;
    uint32_t *indices = dip_gltf_alloc(p->reader, count, sizeof *indices);
    if (!indices) {
        return dip_gltf_no_room(p->reader);
    }
    for (uint32_t i = 0; i < count; ++i) {
        indices[i] = index >= 0 ? dip_gltf_unsigned(&accessor, i, 0) : i;
        if (indices[i] >= p->mesh->vertex_count) {
            return dip_gltf_refuse(gltf, DIP_ERROR_RANGE, "indices",
                                   "an index is %u, but there are %u vertices", indices[i],
                                   p->mesh->vertex_count);
        }
    }
    p->mesh->indices = indices;
    p->mesh->index_count = count;
    return true;
}

// Adds twice the triangle's area times its normal to the normals of its corners.
static void add_face_normal(const float *positions, const uint32_t corners[3], float *normals) {
    const float *a = positions + 3 * (size_t)corners[0];
    const float *b = positions + 3 * (size_t)corners[1];
    const float *c = positions + 3 * (size_t)corners[2];
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        const double n = ((double)b[j] - a[j]) * ((double)c[k] - a[k]) -
                         ((double)b[k] - a[k]) * ((double)c[j] - a[j]);
        for (int corner = 0; corner < 3; ++corner) {
            normals[3 * (size_t)corners[corner] + (size_t)i] += (float)n;
        }
    }
}

// Makes the normals of shape 0 unit vectors. If the file has none, a vertex gets the mean of its
// triangles' normals, weighted by area.
static void finish_normals(Primitive *p) {
    const DipAnimatedMesh *mesh = p->mesh;
    for (uint32_t i = 0; !p->has_normals && i < mesh->index_count; i += 3) {
        add_face_normal(p->positions, mesh->indices + i, p->normals);
    }
    for (uint32_t i = 0; i < mesh->vertex_count; ++i) {
        float *n = p->normals + 3 * (size_t)i;
        const double normal[3] = {n[0], n[1], n[2]};
        dip_model_unit_normal(normal, n);
    }
}

// --- meshes --------------------------------------------------------------------------------------

static bool read_primitive_parts(Primitive *p, const cJSON *json) {
    int material;
    if (!dip_gltf_integer(&p->reader->gltf, json, "material", -1, &material) ||
        !dip_gltf_material(p->reader, material, &p->mesh->material) ||
        !dip_gltf_list(&p->reader->gltf, json, "targets", &p->targets) || !read_shapes(p) ||
        !read_coordinates(p) || !read_joints(p) || !read_indices(p, json)) {
        return false;
    }
    finish_normals(p);
    return true;
}

static bool check_targets(DipGltfReader *reader, const DipGltfMesh *mesh, int targets) {
    return mesh->count == 0 || mesh->target_count == targets ||
           dip_gltf_refuse(&reader->gltf, DIP_ERROR_FORMAT, "targets",
                           "the parts of a mesh have %d and %d morph targets", mesh->target_count,
                           targets);
}

static bool read_primitive(DipGltfReader *reader, const cJSON *json, const char *name,
                           DipGltfMesh *mesh) {
    DipAnimatedModel *model = reader->model;
    int mode;
    if (!json || !dip_gltf_integer(&reader->gltf, json, "mode", MODE_TRIANGLES, &mode)) {
        return false;
    }
    if (mode != MODE_TRIANGLES) {
        dip_model_warn(model->store, model->path, name,
                       "a part of the mesh is left out: it has the mode %d, accepted triangles (4)",
                       mode);
        return true;
    }
    Primitive p = {
        .reader = reader,
        .attributes = cJSON_GetObjectItemCaseSensitive(json, "attributes"),
        .mesh = &model->meshes[model->def.mesh_count],
    };
    p.mesh->name = name;
    reader->max_joints[model->def.mesh_count] = -1;
    const bool ok = read_primitive_parts(&p, json) && check_targets(reader, mesh, p.targets.count);
    const int target_count = p.targets.count;
    dip_gltf_free_list(&p.targets);
    if (ok && p.mesh->index_count > 0) {
        mesh->target_count = target_count;
        mesh->count++;
        model->def.mesh_count++;
    } else {
        *p.mesh = (DipAnimatedMesh){0};
    }
    return ok;
}

static bool read_mesh(DipGltfReader *reader, int index) {
    const cJSON *json = dip_gltf_item(&reader->gltf, DIP_GLTF_meshes, index);
    const char *name = json ? dip_gltf_name(reader, json, "mesh", index) : NULL;
    DipGltfItems primitives = {0};
    if (!name) {
        return json && dip_gltf_no_room(reader);
    }
    bool ok = dip_gltf_list(&reader->gltf, json, "primitives", &primitives);
    reader->meshes[index].first = reader->model->def.mesh_count;
    for (int i = 0; ok && i < primitives.count; ++i) {
        const cJSON *primitive = dip_gltf_list_item(&reader->gltf, &primitives, i, "primitives");
        ok = read_primitive(reader, primitive, name, &reader->meshes[index]);
    }
    dip_gltf_free_list(&primitives);
    return ok;
}

bool dip_gltf_read_meshes(DipGltfReader *reader) {
    const DipGltfItems *meshes = &reader->gltf.tables[DIP_GLTF_meshes];
    size_t primitives = 0;
    for (int i = 0; i < meshes->count; ++i) {
        const cJSON *list = cJSON_GetObjectItemCaseSensitive(meshes->items[i], "primitives");
        primitives += (size_t)cJSON_GetArraySize(list);
    }
    DipAnimatedModel *model = reader->model;
    reader->meshes = dip_gltf_alloc(reader, (size_t)meshes->count, sizeof *reader->meshes);
    reader->max_joints = dip_gltf_alloc(reader, primitives, sizeof *reader->max_joints);
    model->meshes = dip_gltf_alloc(reader, primitives, sizeof *model->meshes);
    if (!reader->meshes || !reader->max_joints || !model->meshes) {
        return dip_gltf_no_room(reader);
    }
    for (int i = 0; i < meshes->count; ++i) {
        if (!read_mesh(reader, i)) {
            return false;
        }
    }
    return true;
}
