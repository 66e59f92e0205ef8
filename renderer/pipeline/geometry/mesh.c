// Makes a mesh: splits its triangles into chunks, computes the chunks' boxes and finds the patches.
#include "renderer/pipeline/geometry/mesh_layout.h"

#include "renderer/base/fp_mode.h"
#include "renderer/base/assert.h"
#include "renderer/base/pages.h"
#include "renderer/pipeline/patch.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_INDICES = 1 << 30 }; // so that 32 bits can count the chunks' vertices and corners

// The index of a source vertex within a chunk.
typedef struct LocalIndex {
    uint32_t chunk; // index + 1 of the last chunk that has this source vertex
    uint8_t index;
} LocalIndex;

// The state of splitting a mesh into chunks.
typedef struct Splitter {
    const DipMeshData *data;
    DipMesh *mesh;
    LocalIndex *local;    // one per source vertex
    uint32_t *source;     // the source vertex of each of the vertex_total chunk vertices
    uint32_t index_total; // number of indices in the chunks that are complete
    uint8_t corner[3][DIP_CHUNK_TRIANGLES]; // corners of the current chunk
} Splitter;

static bool check_positions(const char *name, const float *attributes, size_t attribute_count,
                            uint32_t vertex_count, DipError *err) {
    for (uint32_t v = 0; v < vertex_count; v++) {
        const float *position = attributes + v * attribute_count;
        if (!isfinite(position[0]) || !isfinite(position[1]) || !isfinite(position[2])) {
            return dip_error_set(err, DIP_ERROR_RANGE, name, 0, "vertices",
                                 "the position of vertex %u is not finite", v);
        }
    }
    return true;
}

static bool check_data(const DipMeshData *data, DipError *err) {
    if (!data || (data->vertex_count && !data->attributes) ||
        (data->index_count && !data->indices)) {
        return dip_error_set(err, DIP_ERROR_MISSING, data ? data->name : NULL, 0, "mesh",
                             "NULL, accepted vertices and indices");
    }
    if (data->attribute_count < 3 || data->attribute_count > DIP_MAX_ATTRIBUTES) {
        return dip_error_set(err, DIP_ERROR_RANGE, data->name, 0, "attributes",
                             "%d floats per vertex, accepted 3..%d", data->attribute_count,
                             DIP_MAX_ATTRIBUTES);
    }
    if (data->index_count > MAX_INDICES) {
        return dip_error_set(err, DIP_ERROR_OVERSIZED, data->name, 0, "indices",
                             "%u indices, accepted at most %d", data->index_count, MAX_INDICES);
    }
    if (data->index_count % 3 != 0) {
        return dip_error_set(err, DIP_ERROR_FORMAT, data->name, 0, "indices",
                             "%u indices, accepted a multiple of 3", data->index_count);
    }
    for (uint32_t i = 0; i < data->index_count; i++) {
        if (data->indices[i] >= data->vertex_count) {
            char key[32];
            snprintf(key, sizeof key, "indices[%u]", i);
            return dip_error_set(err, DIP_ERROR_RANGE, data->name, 0, key,
                                 "%u, accepted 0..%u: the mesh has %u vertices", data->indices[i],
                                 data->vertex_count - 1, data->vertex_count);
        }
    }
    return check_positions(data->name, data->attributes, (size_t)data->attribute_count,
                           data->vertex_count, err);
}

// Starts a chunk at the next free index and the next free, aligned vertex.
static DipChunk *begin_chunk(Splitter *splitter, uint32_t triangle) {
    DipMesh *mesh = splitter->mesh;
    DipChunk *chunk = &mesh->chunks[mesh->chunk_count++];
    *chunk = (DipChunk){.first_vertex = mesh->vertex_total,
                        .first_index = splitter->index_total,
                        .first_triangle = triangle};
    return chunk;
}

// Returns how many of a triangle's vertices the current chunk does not have yet.
static uint32_t missing_vertices(const Splitter *splitter, const uint32_t *corner) {
    uint32_t missing = 0;
    for (int i = 0; i < 3; i++) {
        missing += splitter->local[corner[i]].chunk != splitter->mesh->chunk_count;
    }
    return missing;
}

static void add_triangle(Splitter *splitter, DipChunk *chunk, const uint32_t *corner) {
    DipMesh *mesh = splitter->mesh;
    for (int i = 0; i < 3; i++) {
        LocalIndex *local = &splitter->local[corner[i]];
        if (local->chunk != mesh->chunk_count) {
            local->chunk = mesh->chunk_count;
            local->index = (uint8_t)chunk->vertex_count;
            splitter->source[chunk->first_vertex + chunk->vertex_count++] = corner[i];
        }
        splitter->corner[i][chunk->triangle_count] = local->index;
    }
    chunk->triangle_count++;
}

// Pads the chunk's vertices and corners to a multiple of DIP_BATCH_ALIGN, so that vectorised loops
// need no tail.
static void end_chunk(Splitter *splitter, const DipChunk *chunk) {
    const uint32_t stride = dip_corner_stride(chunk);
    for (uint32_t k = 0; k < 3; k++) {
        uint8_t *row = splitter->mesh->indices + chunk->first_index + k * stride;
        memset(row, 0, stride);
        memcpy(row, splitter->corner[k], chunk->triangle_count);
    }
    splitter->index_total += 3 * stride;
    uint32_t end = chunk->first_vertex + chunk->vertex_count;
    const uint32_t last = splitter->source[end - 1];
    while (end % DIP_BATCH_ALIGN) {
        splitter->source[end++] = last;
    }
    splitter->mesh->vertex_total = end;
}

// Splits the triangles into chunks and keeps their order.
static void split(Splitter *splitter) {
    const DipMeshData *data = splitter->data;
    DipChunk *chunk = NULL;
    for (uint32_t t = 0; t < data->index_count / 3; t++) {
        const uint32_t *corner = data->indices + 3 * (size_t)t;
        if (chunk &&
            (chunk->triangle_count == DIP_CHUNK_TRIANGLES ||
             chunk->vertex_count + missing_vertices(splitter, corner) > DIP_VERTEX_BATCH)) {
            end_chunk(splitter, chunk);
            chunk = NULL;
        }
        if (!chunk) {
            chunk = begin_chunk(splitter, t);
        }
        add_triangle(splitter, chunk, corner);
    }
    if (chunk) {
        end_chunk(splitter, chunk);
    }
}

// Copies the caller's attributes to the chunks. source: the caller's vertex of each chunk vertex.
static void fill_attributes(DipMesh *mesh, const uint32_t *source, const float *attributes) {
    const size_t stride = (size_t)mesh->attribute_count;
    for (uint32_t v = 0; v < mesh->vertex_total; v++) {
        const float *row = attributes + stride * source[v];
        for (size_t a = 0; a < stride; a++) {
            mesh->attributes[a * mesh->vertex_total + v] = row[a];
        }
    }
}

typedef struct Range {
    float low[3];
    float high[3];
} Range;

static const Range empty_range = {{INFINITY, INFINITY, INFINITY},
                                  {-INFINITY, -INFINITY, -INFINITY}};

static void add_range(Range *range, const Range *other) {
    for (int axis = 0; axis < 3; axis++) {
        range->low[axis] = fminf(range->low[axis], other->low[axis]);
        range->high[axis] = fmaxf(range->high[axis], other->high[axis]);
    }
}

static DipBox box_of(const Range *range) {
    DipBox box;
    for (int axis = 0; axis < 3; axis++) {
        const float low = range->low[axis];
        const float high = range->high[axis];
        box.centre[axis] = low * 0.5f + high * 0.5f;
        // The extent is rounded up, so that the box contains all vertices.
        box.extent[axis] = fmaxf(high - box.centre[axis], box.centre[axis] - low) * 1.000001f;
    }
    return box;
}

static Range chunk_range(const DipMesh *mesh, const DipChunk *chunk) {
    Range range = empty_range;
    for (int axis = 0; axis < 3; axis++) {
        const float *values =
            mesh->attributes + (size_t)axis * mesh->vertex_total + chunk->first_vertex;
        for (uint32_t v = 0; v < chunk->vertex_count; v++) {
            range.low[axis] = fminf(range.low[axis], values[v]);
            range.high[axis] = fmaxf(range.high[axis], values[v]);
        }
    }
    return range;
}

static void bound_chunks(DipMesh *mesh) {
    Range all = empty_range;
    for (uint32_t first = 0; first < mesh->chunk_count; first += DIP_GROUP_CHUNKS) {
        Range group = empty_range;
        for (uint32_t c = first; c < first + DIP_GROUP_CHUNKS && c < mesh->chunk_count; c++) {
            const Range range = chunk_range(mesh, &mesh->chunks[c]);
            mesh->chunks[c].box = box_of(&range);
            add_range(&group, &range);
        }
        mesh->groups[first / DIP_GROUP_CHUNKS] = box_of(&group);
        add_range(&all, &group);
    }
    if (mesh->chunk_count) {
        mesh->box = box_of(&all);
        memcpy(mesh->min, all.low, sizeof mesh->min);
        memcpy(mesh->max, all.high, sizeof mesh->max);
    }
}

static void *copy_array(const void *from, size_t size_bytes) {
    void *copy = dip_lines_alloc(size_bytes + 1);
    if (copy) {
        memcpy(copy, from, size_bytes);
    }
    return copy;
}

// Finds the patches of triangles that join smoothly. In a mesh that can be updated, each triangle
// is a patch.
static bool find_patches(DipMesh *mesh, const DipMeshData *data, bool updatable) {
    const size_t room_bytes =
        ((size_t)mesh->triangle_count + DIP_BATCH_ALIGN) * sizeof *mesh->patches;
    mesh->patches = dip_lines_alloc(room_bytes);
    if (mesh->patches) {
        memset(mesh->patches, 0, room_bytes);
    }
    if (mesh->patches && updatable) {
        mesh->patch_count = mesh->triangle_count;
        for (uint32_t t = 0; t < mesh->triangle_count; t++) {
            mesh->patches[t] = t;
        }
        return true;
    }
    return mesh->patches &&
           dip_patches_find(data->attributes, (size_t)data->attribute_count, data->vertex_count,
                            data->indices, data->index_count, mesh->patches, &mesh->patch_count);
}

// Keeps the source of each vertex, so that the mesh can be updated.
static bool keep_source(DipMesh *mesh, const Splitter *splitter) {
    mesh->source_count = splitter->data->vertex_count;
    mesh->source = copy_array(splitter->source, mesh->vertex_total * sizeof *mesh->source);
    return mesh->source != NULL;
}

// Allocates arrays for the worst split, in which no two triangles share a vertex.
static bool allocate_split(Splitter *splitter) {
    const size_t triangles = splitter->data->index_count / 3;
    const size_t chunks = triangles / (DIP_VERTEX_BATCH / 3) + 1;
    const size_t vertices = 3 * triangles + chunks * DIP_BATCH_ALIGN;
    splitter->local = calloc((size_t)splitter->data->vertex_count + 1, sizeof *splitter->local);
    splitter->source = malloc((vertices + 1) * sizeof *splitter->source);
    splitter->mesh->chunks = dip_lines_alloc(chunks * sizeof *splitter->mesh->chunks);
    splitter->mesh->indices = dip_lines_alloc(3 * (triangles + chunks * DIP_BATCH_ALIGN));
    return splitter->local && splitter->source && splitter->mesh->chunks && splitter->mesh->indices;
}

static DipMesh *create(const DipMeshData *data, bool updatable, DipError *err) {
    if (!check_data(data, err)) {
        return NULL;
    }
    DipMesh *mesh = calloc(1, sizeof *mesh);
    Splitter splitter = {.data = data, .mesh = mesh};
    bool made = mesh && allocate_split(&splitter);
    if (made) {
        mesh->attribute_count = data->attribute_count;
        mesh->triangle_count = data->index_count / 3;
        split(&splitter);
        const size_t floats = (size_t)mesh->vertex_total * (size_t)mesh->attribute_count;
        mesh->attributes = dip_lines_alloc((floats + 1) * sizeof *mesh->attributes);
        mesh->groups =
            dip_lines_alloc((mesh->chunk_count / DIP_GROUP_CHUNKS + 1) * sizeof *mesh->groups);
        made = mesh->attributes && mesh->groups && find_patches(mesh, data, updatable) &&
               (!updatable || keep_source(mesh, &splitter));
    }
    if (made) {
        fill_attributes(mesh, splitter.source, data->attributes);
        bound_chunks(mesh);
    } else {
        dip_mesh_destroy(&mesh);
        dip_error_set(err, DIP_ERROR_MEMORY, data->name, 0, "mesh", "out of memory");
    }
    free(splitter.local);
    free(splitter.source);
    return mesh;
}

DipMesh *dip_mesh_create(const DipMeshData *data, DipError *err) {
    DIP_FP_MODE_SCOPE();
    return create(data, false, err);
}

DipMesh *dip_mesh_create_updatable(const DipMeshData *data, DipError *err) {
    DIP_FP_MODE_SCOPE();
    return create(data, true, err);
}

bool dip_mesh_update(DipMesh *mesh, const float *attributes, DipError *err) {
    DIP_FP_MODE_SCOPE();
    if (!mesh->source) {
        return dip_error_set(
            err, DIP_ERROR_CONFLICT, NULL, 0, "mesh",
            "the mesh cannot be updated, accepted one of dip_mesh_create_updatable");
    }
    if (!check_positions(NULL, attributes, (size_t)mesh->attribute_count, mesh->source_count,
                         err)) {
        return false;
    }
    fill_attributes(mesh, mesh->source, attributes);
    bound_chunks(mesh);
    return true;
}

// The sizes of a mesh's arrays in bytes.
typedef struct MeshSizes {
    size_t chunks;
    size_t groups;
    size_t attributes;
    size_t indices;
    size_t patches;
    size_t source;
} MeshSizes;

static MeshSizes sizes_of(const DipMesh *mesh) {
    const size_t groups = (mesh->chunk_count + DIP_GROUP_CHUNKS - 1) / DIP_GROUP_CHUNKS;
    size_t indices = 0;
    if (mesh->chunk_count) {
        const DipChunk *last = &mesh->chunks[mesh->chunk_count - 1];
        indices = last->first_index + 3 * (size_t)dip_corner_stride(last);
    }
    return (MeshSizes){mesh->chunk_count * sizeof *mesh->chunks,
                       groups * sizeof *mesh->groups,
                       (size_t)mesh->vertex_total * (size_t)mesh->attribute_count *
                           sizeof *mesh->attributes,
                       indices * sizeof *mesh->indices,
                       ((size_t)mesh->triangle_count + DIP_BATCH_ALIGN) * sizeof *mesh->patches,
                       mesh->source ? mesh->vertex_total * sizeof *mesh->source : 0};
}

DipMesh *dip_mesh_copy(const DipMesh *mesh) {
    DipMesh *copy = copy_array(mesh, sizeof *mesh);
    if (!copy) {
        return NULL;
    }
    const MeshSizes sizes = sizes_of(mesh);
    copy->chunks = copy_array(mesh->chunks, sizes.chunks);
    copy->groups = copy_array(mesh->groups, sizes.groups);
    copy->attributes = copy_array(mesh->attributes, sizes.attributes);
    copy->indices = copy_array(mesh->indices, sizes.indices);
    copy->patches = copy_array(mesh->patches, sizes.patches);
    copy->source = mesh->source ? copy_array(mesh->source, sizes.source) : NULL;
    if (!copy->chunks || !copy->groups || !copy->attributes || !copy->indices || !copy->patches ||
        (mesh->source && !copy->source)) {
        dip_mesh_destroy(&copy);
    }
    return copy;
}

size_t dip_mesh_bytes(const DipMesh *mesh) {
    const MeshSizes sizes = sizes_of(mesh);
    return sizeof *mesh + sizes.chunks + sizes.groups + sizes.attributes + sizes.indices +
           sizes.patches + sizes.source;
}

void dip_mesh_destroy(DipMesh **mesh) {
    if (*mesh) {
        dip_lines_free((*mesh)->chunks);
        dip_lines_free((*mesh)->groups);
        dip_lines_free((*mesh)->attributes);
        dip_lines_free((*mesh)->indices);
        dip_lines_free((*mesh)->patches);
        dip_lines_free((*mesh)->source);
        free(*mesh);
        *mesh = NULL;
    }
}

uint32_t dip_mesh_triangle_count(const DipMesh *mesh) {
    return mesh->triangle_count;
}

void dip_mesh_bounds(const DipMesh *mesh, float min[3], float max[3]) {
    memcpy(min, mesh->min, sizeof mesh->min);
    memcpy(max, mesh->max, sizeof mesh->max);
}

DipBox dip_mesh_box(const DipMesh *mesh) {
    return mesh->box;
}

uint32_t dip_mesh_chunk_count(const DipMesh *mesh) {
    return mesh->chunk_count;
}

DipBox dip_mesh_chunk_box(const DipMesh *mesh, uint32_t chunk) {
    return mesh->chunks[chunk].box;
}

uint32_t dip_mesh_chunk_triangle_count(const DipMesh *mesh, uint32_t chunk) {
    return mesh->chunks[chunk].triangle_count;
}

void dip_mesh_chunk_triangle(const DipMesh *mesh, uint32_t chunk, uint32_t triangle,
                             float corners[3][3]) {
    const DipChunk *from = &mesh->chunks[chunk];
    const uint8_t *index = mesh->indices + from->first_index + triangle;
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t vertex = from->first_vertex + index[k * dip_corner_stride(from)];
        for (uint32_t axis = 0; axis < 3; axis++) {
            corners[k][axis] = mesh->attributes[axis * mesh->vertex_total + vertex];
        }
    }
}
