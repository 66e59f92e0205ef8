// Turns the parts of a glTF file into meshes of a scene.
#include "assets/gltf/scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A part while it becomes a mesh.
typedef struct Shape {
    const DipAnimatedMesh *mesh;
    const DipGltfPart *part;
    const float *positions;
    const float *normals; // NULL: every triangle gets the normal of its face
    uint32_t count;       // Number of vertices before equal ones are joined.
    bool moves;           // The vertices move, so that equal ones are not joined.
} Shape;

// Without normals, each corner of a triangle becomes a vertex.
static uint32_t vertex_of(const Shape *shape, uint32_t i) {
    return shape->normals ? i : shape->mesh->indices[i];
}

static float *copy(DipModel *model, const Shape *shape, const float *from, size_t stride,
                   size_t width) {
    float *to = dip_model_alloc(model, shape->count, width * sizeof *to);
    for (uint32_t i = 0; to && i < shape->count; ++i) {
        memcpy(to + width * i, from + stride * vertex_of(shape, i), width * sizeof *to);
    }
    return to;
}

// Computes the normals of the triangles, which are flat if the file gives no others.
static float *make_normals(DipModel *model, const Shape *shape) {
    float *to = dip_model_alloc(model, shape->count, 3 * sizeof *to);
    for (uint32_t i = 0; to && i < shape->count; i += 3) {
        const float *a = shape->positions + 3 * (size_t)vertex_of(shape, i);
        const float *b = shape->positions + 3 * (size_t)vertex_of(shape, i + 1);
        const float *c = shape->positions + 3 * (size_t)vertex_of(shape, i + 2);
        double normal[3];
        for (int k = 0; k < 3; ++k) {
            const int u = (k + 1) % 3;
            const int v = (k + 2) % 3;
            normal[k] = ((double)b[u] - a[u]) * ((double)c[v] - a[v]) -
                        ((double)b[v] - a[v]) * ((double)c[u] - a[u]);
        }
        for (size_t corner = i; corner < (size_t)i + 3; ++corner) {
            dip_model_unit_normal(normal, to + 3 * corner);
        }
    }
    return to;
}

// Moves the coordinates as the pictures that they place ask for.
static float *make_uv(DipModel *model, const Shape *shape, const DipCoordinates *coordinates) {
    static const double identity[6] = {1, 0, 0, 0, 1, 0};
    const double *m = coordinates->matrix;
    float *to = copy(model, shape, shape->part->sets[coordinates->set], 2, 2);
    if (!to || memcmp(m, identity, sizeof identity) == 0) {
        return to;
    }
    for (uint32_t i = 0; i < shape->count; ++i) {
        float *uv = to + 2 * (size_t)i;
        const double u = uv[0];
        const double v = uv[1];
        for (int k = 0; k < 2; ++k) {
            const float moved = (float)(m[3 * k] * u + m[3 * k + 1] * v + m[3 * k + 2]);
            uv[k] = isfinite(moved) ? moved : 0.0f;
        }
    }
    return to;
}

static uint32_t *make_indices(DipModel *model, const Shape *shape, const uint32_t *remap) {
    const uint32_t count = shape->mesh->index_count;
    uint32_t *to = dip_model_alloc(model, count, sizeof *to);
    for (uint32_t i = 0; to && i < count; ++i) {
        const uint32_t vertex = shape->normals ? shape->mesh->indices[i] : i;
        to[i] = remap ? remap[vertex] : vertex;
    }
    return to;
}

// Gives a mesh its arrays as they are.
static void set_arrays(const DipVertexArrays *arrays, uint32_t count, DipMeshDef *def) {
    def->vertex_count = count;
    def->positions = arrays->values[0];
    def->normals = arrays->values[1];
    def->uv0 = arrays->values[2];
    def->uv1 = arrays->values[3];
    def->colours_lin = arrays->values[4];
    def->alphas = arrays->values[5];
}

static bool fill(DipModel *model, const Shape *shape, const DipMaterialPlan *plan,
                 DipMeshDef *def) {
    float *positions = copy(model, shape, shape->positions, 3, 3);
    float *normals =
        shape->normals ? copy(model, shape, shape->normals, 3, 3) : make_normals(model, shape);
    float *uv0 = plan->has_uv0 ? make_uv(model, shape, &plan->uv0) : NULL;
    float *uv1 = plan->has_uv1 ? make_uv(model, shape, &plan->uv1) : NULL;
    const float *rgba = shape->part->colours;
    float *colours = rgba ? copy(model, shape, rgba, 4, 3) : NULL;
    float *alphas = plan->vertex_alpha ? copy(model, shape, rgba + 3, 4, 1) : NULL;
    if (!positions || !normals || (plan->has_uv0 && !uv0) || (plan->has_uv1 && !uv1) ||
        (rgba && !colours) || (plan->vertex_alpha && !alphas)) {
        return false;
    }
    const DipVertexArrays arrays = {{positions, normals, uv0, uv1, colours, alphas}};
    uint32_t *remap = NULL;
    if (shape->moves) {
        set_arrays(&arrays, shape->count, def);
    } else if (!dip_model_join(model, &arrays, shape->count, def, &remap)) {
        return false;
    }
    def->indices = make_indices(model, shape, remap);
    def->index_count = shape->mesh->index_count;
    return def->indices;
}

// Names a mesh. The parts of a mesh of several primitives have its name and their numbers.
static const char *name_of(DipGltfScene *scene, int part) {
    const char *name = scene->reader.model->meshes[part].name;
    if (scene->reader.parts[part].is_only) {
        return dip_model_copy_text(scene->model, name);
    }
    char text[512]; // A longer name is cut.
    snprintf(text, sizeof text, "%.480s-%d", name, scene->reader.parts[part].number);
    return dip_model_copy_text(scene->model, text);
}

static int add_mesh(DipGltfScene *scene, const Shape *shape, const DipMeshKey *key) {
    const int part = (int)key->source;
    DipMeshDef def = {.material = key->material, .name = name_of(scene, part)};
    int index = DIP_NOT_FOUND;
    if (def.name && fill(scene->model, shape, &scene->model->plans[key->material], &def)) {
        index = dip_model_add_mesh(scene->model, &def, key);
    }
    if (index < 0) {
        dip_model_out_of_memory(scene->reader.gltf.err, scene->reader.gltf.path);
    }
    return index;
}

static bool are_finite(const DipGltfScene *scene, const Shape *shape) {
    for (size_t i = 0; i < 3 * (size_t)shape->mesh->vertex_count; ++i) {
        if (!isfinite(shape->positions[i])) {
            return dip_gltf_refuse(&scene->reader.gltf, DIP_ERROR_RANGE, shape->mesh->name,
                                   "the position of vertex %zu in its pose is not finite", i / 3);
        }
    }
    return true;
}

// Adds a mesh in the shape that an object has at rest.
static int add_posed_mesh(DipGltfScene *scene, Shape *shape, const DipMeshKey *key) {
    const size_t count = 3 * (size_t)shape->mesh->vertex_count;
    float *positions = malloc(count * sizeof *positions);
    float *normals = malloc(count * sizeof *normals);
    int index = DIP_NOT_FOUND;
    if (!positions || !normals) {
        dip_model_out_of_memory(scene->reader.gltf.err, scene->reader.gltf.path);
    } else {
        dip_animated_pose_vertices(scene->pose, key->object, positions, normals);
        shape->positions = positions;
        shape->normals = shape->part->has_normals ? normals : NULL;
        index = are_finite(scene, shape) ? add_mesh(scene, shape, key) : DIP_NOT_FOUND;
    }
    if (index >= 0 && shape->moves &&
        !dip_gltf_scene_move_mesh(scene, key->object, index, shape->count,
                                  shape->normals ? NULL : shape->mesh->indices)) {
        index = DIP_NOT_FOUND;
    }
    free(positions);
    free(normals);
    return index;
}

int dip_gltf_scene_mesh(DipGltfScene *scene, int part, int object, int material) {
    const DipMeshKey key = {scene->file, (unsigned)part, material, object};
    const int known = object < 0 ? dip_model_find_mesh(scene->model, &key) : DIP_NOT_FOUND;
    if (known >= 0) {
        return known;
    }
    const DipGltfPart *source = &scene->reader.parts[part];
    const DipAnimatedMesh *mesh = &scene->reader.model->meshes[part];
    Shape shape = {.mesh = mesh,
                   .part = source,
                   .positions = mesh->positions,
                   .normals = source->has_normals ? mesh->normals : NULL};
    shape.moves = object >= 0 && dip_gltf_scene_deforms(scene, object);
    shape.count = source->has_normals ? mesh->vertex_count : mesh->index_count;
    return object >= 0 ? add_posed_mesh(scene, &shape, &key) : add_mesh(scene, &shape, &key);
}
