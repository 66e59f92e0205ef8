// Reads the meshes of glTF files, with their morph targets and joints.
#include "assets/gltf/draco.h"
#include "assets/gltf/reader.h"

#include <cjson/cJSON.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MODE_POINTS = 0,
    MODE_LINES = 1,
    MODE_LINE_LOOP = 2,
    MODE_LINE_STRIP = 3,
    MODE_TRIANGLES = 4,
    MODE_STRIP = 5,
    MODE_FAN = 6,
    JOINTS_PER_VERTEX = 4
};

// A primitive while it is read.
typedef struct Primitive {
    DipGltfReader *reader;
    const cJSON *attributes;
    const cJSON *draco_ids; // The attributes that Draco has packed, by name.
    DipDracoMesh *draco;    // NULL: the primitive is not packed.
    DipGltfItems targets;
    DipAnimatedMesh *mesh;
    DipGltfPart *part;
    int mode;
    float *positions;
    float *normals;
} Primitive;

// An attribute of a primitive.
typedef struct Attribute {
    bool found;
    DipGltfAccessor accessor; // Its type; also its values, unless they are packed.
    int draco_id;             // Where Draco has packed the values, or -1.
} Attribute;

// --- attributes ----------------------------------------------------------------------------------

// Finds an attribute. width: components that its values must have, or 0 for any number.
static bool find_attribute(const Primitive *p, const cJSON *attributes, const char *name, int width,
                           Attribute *attribute) {
    DipGltf *gltf = &p->reader->gltf;
    *attribute = (Attribute){.draco_id = -1};
    int index;
    if (!dip_gltf_integer(gltf, attributes, name, -1, &index)) {
        return false;
    }
    if (index < 0) {
        return true;
    }
    attribute->found = true;
    if (!dip_gltf_accessor(gltf, index, width, name, &attribute->accessor) ||
        (p->draco && attributes == p->attributes &&
         !dip_gltf_integer(gltf, p->draco_ids, name, -1, &attribute->draco_id))) {
        return false;
    }
    const uint32_t count = attribute->accessor.count;
    const uint32_t expected = p->mesh->vertex_count;
    return expected == 0 || count == expected ||
           dip_gltf_refuse(gltf, DIP_ERROR_RANGE, name,
                           "the attribute has %u values, expected one for each of %u vertices",
                           count, expected);
}

// Writes the values of an attribute that was found.
static bool read_values(const Primitive *p, const Attribute *attribute, const char *name,
                        float *to) {
    const DipGltf *gltf = &p->reader->gltf;
    const DipGltfAccessor *accessor = &attribute->accessor;
    if (attribute->draco_id < 0) {
        return dip_gltf_floats(gltf, accessor, name, to);
    }
    if (!dip_draco_floats(p->draco, (uint32_t)attribute->draco_id, accessor->width,
                          accessor->normalized, to)) {
        return dip_gltf_refuse(gltf, DIP_ERROR_FORMAT, "KHR_draco_mesh_compression",
                               "the packed mesh \"%s\" has no %s of this type", p->mesh->name,
                               name);
    }
    const size_t count = (size_t)accessor->count * (size_t)accessor->width;
    for (size_t i = 0; i < count; ++i) {
        if (!isfinite(to[i])) {
            return dip_gltf_refuse(gltf, DIP_ERROR_RANGE, name, "value %zu is not finite",
                                   i / (size_t)accessor->width);
        }
    }
    return true;
}

// Reads an attribute of 3 floats, if the primitive has it.
static bool read_vectors(const Primitive *p, const cJSON *attributes, const char *name, float *to,
                         bool *found) {
    Attribute attribute;
    const bool ok = find_attribute(p, attributes, name, 3, &attribute);
    *found = attribute.found;
    return ok && (!*found || read_values(p, &attribute, name, to));
}

// Finds out the number of vertices, and allocates the shapes.
static bool prepare_shapes(Primitive *p) {
    Attribute attribute;
    if (!find_attribute(p, p->attributes, "POSITION", 3, &attribute)) {
        return false;
    }
    if (!attribute.found) {
        return dip_gltf_refuse(&p->reader->gltf, DIP_ERROR_FORMAT, "meshes",
                               "the mesh \"%s\" has no positions", p->mesh->name);
    }
    const uint32_t count = attribute.accessor.count;
    if (p->draco && count != dip_draco_vertex_count(p->draco)) {
        return dip_gltf_refuse(&p->reader->gltf, DIP_ERROR_FORMAT, "KHR_draco_mesh_compression",
                               "the packed mesh \"%s\" has %u vertices, expected %u", p->mesh->name,
                               dip_draco_vertex_count(p->draco), count);
    }
    p->mesh->vertex_count = count;
    p->mesh->shape_count = 1 + p->targets.count;
    const size_t rows = (size_t)p->mesh->shape_count * count;
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
        !read_vectors(p, p->attributes, "NORMAL", p->normals, &p->part->has_normals)) {
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

// Reads a set of texture coordinates, or sets *uv to NULL if the primitive lacks it.
static bool read_set(Primitive *p, int set, const float **uv) {
    Attribute attribute;
    char name[32];
    snprintf(name, sizeof name, "TEXCOORD_%d", set);
    *uv = NULL;
    if (!find_attribute(p, p->attributes, name, 2, &attribute)) {
        return false;
    }
    if (!attribute.found) {
        return true;
    }
    float *values = dip_gltf_alloc(p->reader, p->mesh->vertex_count, 2 * sizeof *values);
    *uv = values;
    return values ? read_values(p, &attribute, name, values) : dip_gltf_no_room(p->reader);
}

static bool read_coordinates(Primitive *p) {
    if (!p->reader->for_scene) {
        return read_set(p, p->reader->coordinates_of[p->mesh->material], &p->mesh->uv0);
    }
    for (int set = 0; set < DIP_GLTF_MAX_SETS; ++set) {
        if (!read_set(p, set, &p->part->sets[set])) {
            return false;
        }
    }
    return true;
}

// Reads the colours of the vertices: red, green and blue, with or without alpha.
static bool read_colours(Primitive *p) {
    Attribute attribute;
    if (!find_attribute(p, p->attributes, "COLOR_0", 0, &attribute)) {
        return false;
    }
    if (!attribute.found) {
        return true;
    }
    DipGltfAccessor *accessor = &attribute.accessor;
    if (accessor->width != 3 && accessor->width != 4) {
        return dip_gltf_refuse(&p->reader->gltf, DIP_ERROR_FORMAT, "COLOR_0",
                               "the colours have %d channels, accepted 3 or 4", accessor->width);
    }
    accessor->normalized = true; // The format knows no colours of other integers.
    float *colours = dip_gltf_alloc(p->reader, p->mesh->vertex_count, 4 * sizeof *colours);
    if (!colours) {
        return dip_gltf_no_room(p->reader);
    }
    if (!read_values(p, &attribute, "COLOR_0", colours)) {
        return false;
    }
    for (uint32_t i = p->mesh->vertex_count; accessor->width == 3 && i-- > 0;) {
        memmove(colours + 4 * (size_t)i, colours + 3 * (size_t)i, 3 * sizeof *colours);
        colours[4 * (size_t)i + 3] = 1.0f;
    }
    for (size_t i = 0; i < 4 * (size_t)p->mesh->vertex_count; ++i) {
        colours[i] = fminf(fmaxf(colours[i], 0.0f), 1.0f);
        p->part->has_alpha = p->part->has_alpha || (i % 4 == 3 && colours[i] < 1.0f);
    }
    p->part->colours = colours;
    return true;
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

static void fill_joints(Primitive *p, const float *from, const float *weights, uint16_t *joints) {
    const size_t count = JOINTS_PER_VERTEX * (size_t)p->mesh->vertex_count;
    for (size_t i = 0; i < count; ++i) {
        joints[i] = weights[i] > 0.0f ? (uint16_t)from[i] : 0; // They are 0..65535.
        p->part->max_joint = joints[i] > p->part->max_joint ? joints[i] : p->part->max_joint;
    }
    p->mesh->joints = joints;
    p->mesh->joint_weights = weights;
}

static bool read_joints(Primitive *p) {
    DipGltf *gltf = &p->reader->gltf;
    Attribute joint;
    Attribute weight;
    if (!find_attribute(p, p->attributes, "JOINTS_0", 4, &joint) ||
        !find_attribute(p, p->attributes, "WEIGHTS_0", 4, &weight)) {
        return false;
    }
    if (!joint.found || !weight.found) {
        return true;
    }
    if (joint.accessor.normalized || (joint.accessor.component != DIP_GLTF_UNSIGNED_BYTE &&
                                      joint.accessor.component != DIP_GLTF_UNSIGNED_SHORT)) {
        return dip_gltf_refuse(gltf, DIP_ERROR_FORMAT, "JOINTS_0",
                               "the joints are not unsigned integers of 8 or 16 bits");
    }
    weight.accessor.normalized = true; // The format knows no weights of other integers.
    const size_t count = JOINTS_PER_VERTEX * (size_t)p->mesh->vertex_count;
    uint16_t *joints = dip_gltf_alloc(p->reader, count, sizeof *joints);
    float *weights = dip_gltf_alloc(p->reader, count, sizeof *weights);
    float *numbers = calloc(count, sizeof *numbers);
    if (!joints || !weights || !numbers) {
        free(numbers);
        return dip_gltf_no_room(p->reader);
    }
    bool ok = read_values(p, &weight, "WEIGHTS_0", weights) &&
              read_values(p, &joint, "JOINTS_0", numbers);
    for (size_t i = 0; ok && i < count; i += JOINTS_PER_VERTEX) {
        ok = normalise_weights(p, weights + i);
    }
    if (ok) {
        fill_joints(p, numbers, weights, joints);
    }
    free(numbers);
    return ok;
}

// --- indices and normals -------------------------------------------------------------------------

// The corners of a primitive in the order of the file.
typedef struct Corners {
    uint32_t count;
    uint32_t *vertices; // NULL: corner i is vertex i
} Corners;

// Reads the indices. The caller frees corners->vertices, even after a failure.
static bool read_corners(Primitive *p, const cJSON *json, Corners *corners) {
    DipGltf *gltf = &p->reader->gltf;
    DipGltfAccessor accessor;
    int index;
    *corners = (Corners){.count = p->mesh->vertex_count};
    if (p->draco) {
        corners->count = dip_draco_index_count(p->draco);
        p->mode = MODE_TRIANGLES;
    } else if (!dip_gltf_integer(gltf, json, "indices", -1, &index)) {
        return false;
    } else if (index < 0) {
        return true;
    } else if (!dip_gltf_accessor(gltf, index, 1, "indices", &accessor)) {
        return false;
    } else if (accessor.component == DIP_GLTF_FLOAT) {
        return dip_gltf_refuse(gltf, DIP_ERROR_FORMAT, "indices", "the indices are not integers");
    } else {
        corners->count = accessor.count;
    }
    corners->vertices = malloc(((size_t)corners->count + 1) * sizeof *corners->vertices);
    if (!corners->vertices) {
        return dip_model_out_of_memory(gltf->err, gltf->path);
    }
    if (p->draco) {
        dip_draco_indices(p->draco, corners->vertices);
    }
    for (uint32_t i = 0; i < corners->count; ++i) {
        uint32_t *vertex = &corners->vertices[i];
        *vertex = p->draco ? *vertex : dip_gltf_unsigned(&accessor, i, 0);
        if (*vertex >= p->mesh->vertex_count) {
            return dip_gltf_refuse(gltf, DIP_ERROR_RANGE, "indices",
                                   "an index is %u, but there are %u vertices", *vertex,
                                   p->mesh->vertex_count);
        }
    }
    return true;
}

// Returns which corner of the file is corner k of a triangle. Every second triangle of a strip has
// its corners the other way round, so that all have the same front.
static uint32_t corner_of(int mode, uint32_t triangle, uint32_t k) {
    switch (mode) {
    case MODE_STRIP:
        return k == 0 ? triangle : triangle + (k == 1 ? 1 + triangle % 2 : 2 - triangle % 2);
    case MODE_FAN:
        return k == 2 ? 0 : triangle + 1 + k;
    default:
        return 3 * triangle + k;
    }
}

// Turns the corners into triangles. Without indices, the vertices are the corners.
static bool make_triangles(Primitive *p, const Corners *corners) {
    const bool single = p->mode == MODE_TRIANGLES;
    const uint32_t triangles = single               ? corners->count / 3
                               : corners->count > 2 ? corners->count - 2
                                                    : 0;
    if (triangles > UINT32_MAX / 3) {
        return dip_gltf_refuse(&p->reader->gltf, DIP_ERROR_RANGE, "indices",
                               "the mesh has too many triangles: %u", triangles);
    }
    if (corners->vertices && single && corners->count % 3 != 0) {
        dip_model_warn(p->reader->model->store, p->reader->model->path, p->mesh->name,
                       "the last %u of %u indices are no triangle and are left out",
                       corners->count % 3, corners->count);
    }
    uint32_t *indices = dip_gltf_alloc(p->reader, triangles, 3 * sizeof *indices);
    if (!indices) {
        return dip_gltf_no_room(p->reader);
    }
    for (uint32_t t = 0; t < triangles; ++t) {
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t corner = corner_of(p->mode, t, k);
            indices[3 * (size_t)t + k] = corners->vertices ? corners->vertices[corner] : corner;
        }
    }
    p->mesh->indices = indices;
    p->mesh->index_count = 3 * triangles;
    return true;
}

static bool read_indices(Primitive *p, const cJSON *json) {
    Corners corners;
    const bool ok = read_corners(p, json, &corners) && make_triangles(p, &corners);
    free(corners.vertices);
    return ok;
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
    for (uint32_t i = 0; !p->part->has_normals && i < mesh->index_count; i += 3) {
        add_face_normal(p->positions, mesh->indices + i, p->normals);
    }
    for (uint32_t i = 0; i < mesh->vertex_count; ++i) {
        float *n = p->normals + 3 * (size_t)i;
        const double normal[3] = {n[0], n[1], n[2]};
        dip_model_unit_normal(normal, n);
    }
}

// --- packed primitives ---------------------------------------------------------------------------

static bool unpack(Primitive *p, const cJSON *extension) {
    DipGltf *gltf = &p->reader->gltf;
    const uint8_t *bytes;
    size_t size_bytes;
    int view;
    int stride;
    if (!dip_gltf_integer(gltf, extension, "bufferView", -1, &view) ||
        !dip_gltf_view(gltf, view, &bytes, &size_bytes, &stride)) {
        return false;
    }
    bool out_of_memory = false;
    p->draco_ids = cJSON_GetObjectItemCaseSensitive(extension, "attributes");
    p->draco = dip_draco_decode(bytes, size_bytes, &out_of_memory);
    if (out_of_memory) {
        return dip_model_out_of_memory(gltf->err, gltf->path);
    }
    return p->draco || dip_gltf_refuse(gltf, DIP_ERROR_FORMAT, "KHR_draco_mesh_compression",
                                       "the packed mesh \"%s\" is malformed", p->mesh->name);
}

// Unpacks a primitive that Draco has packed. A file may hold the unpacked values, too.
static bool unpack_draco(Primitive *p, const cJSON *json) {
    const DipGltf *gltf = &p->reader->gltf;
    const cJSON *extension = dip_gltf_extension(json, "KHR_draco_mesh_compression");
    if (!extension) {
        return true;
    }
    if (dip_draco_is_built() && p->reader->unpacks_draco) {
        return unpack(p, extension);
    }
    int position;
    if (!dip_gltf_integer(gltf, p->attributes, "POSITION", -1, &position)) {
        return false;
    }
    const cJSON *accessor = dip_gltf_item(gltf, DIP_GLTF_accessors, position);
    const bool is_plain = accessor && cJSON_GetObjectItemCaseSensitive(accessor, "bufferView") &&
                          !dip_gltf_requires(gltf, "KHR_draco_mesh_compression");
    return is_plain ||
           dip_gltf_refuse(
               gltf, DIP_ERROR_UNSUPPORTED, "meshes",
               "the mesh \"%s\" is packed by Draco (KHR_draco_mesh_compression), %s", p->mesh->name,
               dip_draco_is_built() ? "which animated models may not be"
                                    : "which this build of Diptych lacks: install libdraco-dev "
                                      "and build again");
}

// --- meshes --------------------------------------------------------------------------------------

static bool read_primitive_parts(Primitive *p, const cJSON *json) {
    DipGltfReader *reader = p->reader;
    if (!dip_gltf_integer(&reader->gltf, json, "material", -1, &p->part->material) ||
        (p->part->material >= 0 &&
         !dip_gltf_item(&reader->gltf, DIP_GLTF_materials, p->part->material)) ||
        (!reader->for_scene && !dip_gltf_material(reader, p->part->material, &p->mesh->material)) ||
        !dip_gltf_list(&reader->gltf, json, "targets", &p->targets) || !unpack_draco(p, json) ||
        !read_shapes(p) || !read_coordinates(p) || (reader->for_scene && !read_colours(p)) ||
        !read_joints(p) || !read_indices(p, json)) {
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

// Counts the points or lines of a primitive, which are left out.
static bool count_left_out(DipGltfReader *reader, const cJSON *json, int mode) {
    const cJSON *attributes = cJSON_GetObjectItemCaseSensitive(json, "attributes");
    int accessor;
    int count;
    if (!dip_gltf_integer(&reader->gltf, attributes, "POSITION", -1, &accessor) ||
        !dip_gltf_integer(&reader->gltf, json, "indices", accessor, &accessor)) {
        return false;
    }
    const cJSON *item = dip_gltf_item(&reader->gltf, DIP_GLTF_accessors, accessor);
    if (!item || !dip_gltf_integer(&reader->gltf, item, "count", 0, &count)) {
        return false;
    }
    const int lines = mode == MODE_LINES ? count / 2 : mode == MODE_LINE_STRIP ? count - 1 : count;
    reader->points_and_lines += lines > 0 ? (uint64_t)lines : 0;
    return true;
}

// Reads the primitive `number` of a mesh.
static bool read_primitive(DipGltfReader *reader, const cJSON *json, const char *name, int number,
                           DipGltfMesh *mesh) {
    DipAnimatedModel *model = reader->model;
    int mode;
    if (!json || !dip_gltf_integer(&reader->gltf, json, "mode", MODE_TRIANGLES, &mode)) {
        return false;
    }
    if (mode < MODE_TRIANGLES) {
        return count_left_out(reader, json, mode);
    }
    if (mode > MODE_FAN) {
        return dip_gltf_refuse(&reader->gltf, DIP_ERROR_RANGE, "mode",
                               "a part of the mesh \"%s\" has the mode %d, accepted 0..%d", name,
                               mode, MODE_FAN);
    }
    Primitive p = {
        .reader = reader,
        .attributes = cJSON_GetObjectItemCaseSensitive(json, "attributes"),
        .mesh = &model->meshes[model->def.mesh_count],
        .part = &reader->parts[model->def.mesh_count],
        .mode = mode,
    };
    p.mesh->name = name;
    *p.part = (DipGltfPart){.number = number, .is_only = mesh->is_single, .max_joint = -1};
    const bool ok = read_primitive_parts(&p, json) && check_targets(reader, mesh, p.targets.count);
    const int target_count = p.targets.count;
    dip_gltf_free_list(&p.targets);
    dip_draco_free(p.draco);
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
    reader->meshes[index].is_single = primitives.count == 1;
    for (int i = 0; ok && i < primitives.count; ++i) {
        const cJSON *primitive = dip_gltf_list_item(&reader->gltf, &primitives, i, "primitives");
        ok = read_primitive(reader, primitive, name, i, &reader->meshes[index]);
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
    reader->parts = dip_gltf_alloc(reader, primitives, sizeof *reader->parts);
    model->meshes = dip_gltf_alloc(reader, primitives, sizeof *model->meshes);
    if (!reader->meshes || !reader->parts || !model->meshes) {
        return dip_gltf_no_room(reader);
    }
    for (int i = 0; i < meshes->count; ++i) {
        if (!read_mesh(reader, i)) {
            return false;
        }
    }
    if (reader->points_and_lines > 0) {
        dip_model_warn(model->store, model->path, NULL, "%llu points and lines are not drawn",
                       (unsigned long long)reader->points_and_lines);
    }
    return true;
}
