// Splitting a mesh into chunks.
#include "renderer/geometry/mesh.h"

#include "renderer/base/assert.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_INDICES = 1 << 30 }; // so that 32 bits count the chunks' vertices

// Which vertex of the chunk being built a source vertex is, if it is one.
typedef struct LocalIndex {
    uint32_t chunk; // index + 1 of the chunk that saw it last
    uint8_t index;
} LocalIndex;

typedef struct Splitter {
    const DipMeshData *data;
    DipMesh *mesh;
    LocalIndex *local; // per source vertex
    uint32_t *source;  // per chunk vertex, the source vertex; vertex_total of them
} Splitter;

static bool check_data(const DipMeshData *data, DipError *err) {
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
            return dip_error_set(err, DIP_ERROR_RANGE, data->name, 0, "indices",
                                 "index %u of %u is out of range, accepted 0..%u", data->indices[i],
                                 i, data->vertex_count - 1);
        }
    }
    for (uint32_t v = 0; v < data->vertex_count; v++) {
        const float *position = data->attributes + (size_t)v * (size_t)data->attribute_count;
        if (!isfinite(position[0]) || !isfinite(position[1]) || !isfinite(position[2])) {
            return dip_error_set(err, DIP_ERROR_RANGE, data->name, 0, "vertices",
                                 "the position of vertex %u is not finite", v);
        }
    }
    return true;
}

// Starts a chunk at the next free triangle and aligned vertex.
static DipChunk *begin_chunk(Splitter *splitter, uint32_t triangle) {
    DipMesh *mesh = splitter->mesh;
    DipChunk *chunk = &mesh->chunks[mesh->chunk_count++];
    *chunk = (DipChunk){.first_vertex = mesh->vertex_total, .first_triangle = triangle};
    return chunk;
}

static uint32_t missing_vertices(const Splitter *splitter, const uint32_t *corner) {
    uint32_t missing = 0;
    for (int i = 0; i < 3; i++) {
        missing += splitter->local[corner[i]].chunk != splitter->mesh->chunk_count;
    }
    return missing;
}

static void add_triangle(Splitter *splitter, DipChunk *chunk, const uint32_t *corner) {
    DipMesh *mesh = splitter->mesh;
    uint8_t *out = mesh->indices + 3 * (size_t)(chunk->first_triangle + chunk->triangle_count++);
    for (int i = 0; i < 3; i++) {
        LocalIndex *local = &splitter->local[corner[i]];
        if (local->chunk != mesh->chunk_count) {
            local->chunk = mesh->chunk_count;
            local->index = (uint8_t)chunk->vertex_count;
            splitter->source[chunk->first_vertex + chunk->vertex_count++] = corner[i];
        }
        out[i] = local->index;
    }
}

// Pads the chunk's vertices with copies of its last one, so that batches need no tail.
static void end_chunk(Splitter *splitter, const DipChunk *chunk) {
    uint32_t end = chunk->first_vertex + chunk->vertex_count;
    const uint32_t last = splitter->source[end - 1];
    while (end % DIP_BATCH_ALIGN) {
        splitter->source[end++] = last;
    }
    splitter->mesh->vertex_total = end;
}

// Cuts the triangles, in their order, into chunks.
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

static void fill_attributes(Splitter *splitter) {
    DipMesh *mesh = splitter->mesh;
    const size_t stride = (size_t)mesh->attribute_count;
    for (uint32_t v = 0; v < mesh->vertex_total; v++) {
        const float *row = splitter->data->attributes + stride * splitter->source[v];
        for (size_t a = 0; a < stride; a++) {
            mesh->attributes[a * mesh->vertex_total + v] = row[a];
        }
    }
}

static void bound_chunks(DipMesh *mesh) {
    for (int axis = 0; axis < 3; axis++) {
        mesh->min[axis] = mesh->chunk_count ? INFINITY : 0.0f;
        mesh->max[axis] = mesh->chunk_count ? -INFINITY : 0.0f;
    }
    for (uint32_t c = 0; c < mesh->chunk_count; c++) {
        DipChunk *chunk = &mesh->chunks[c];
        for (int axis = 0; axis < 3; axis++) {
            const float *values =
                mesh->attributes + (size_t)axis * mesh->vertex_total + chunk->first_vertex;
            float low = values[0];
            float high = values[0];
            for (uint32_t v = 1; v < chunk->vertex_count; v++) {
                low = values[v] < low ? values[v] : low;
                high = values[v] > high ? values[v] : high;
            }
            chunk->centre[axis] = low * 0.5f + high * 0.5f;
            // Rounded outwards, so that the box holds its vertices.
            const float half = fmaxf(high - chunk->centre[axis], chunk->centre[axis] - low);
            chunk->extent[axis] = half * 1.000001f;
            mesh->min[axis] = low < mesh->min[axis] ? low : mesh->min[axis];
            mesh->max[axis] = high > mesh->max[axis] ? high : mesh->max[axis];
        }
    }
}

// Room for the worst split: every chunk is full of triangles or of vertices.
static bool allocate_split(Splitter *splitter) {
    const size_t triangles = splitter->data->index_count / 3;
    const size_t chunks = triangles / (DIP_VERTEX_BATCH / 3) + 1;
    const size_t vertices = 3 * triangles + chunks * DIP_BATCH_ALIGN;
    splitter->local = calloc((size_t)splitter->data->vertex_count + 1, sizeof *splitter->local);
    splitter->source = malloc((vertices + 1) * sizeof *splitter->source);
    splitter->mesh->chunks = malloc(chunks * sizeof *splitter->mesh->chunks);
    splitter->mesh->indices = malloc(3 * triangles + 1);
    return splitter->local && splitter->source && splitter->mesh->chunks && splitter->mesh->indices;
}

DipMesh *dip_mesh_create(const DipMeshData *data, DipError *err) {
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
        mesh->attributes = malloc((floats + 1) * sizeof *mesh->attributes);
        made = mesh->attributes != NULL;
    }
    if (made) {
        fill_attributes(&splitter);
        bound_chunks(mesh);
    } else {
        dip_mesh_destroy(&mesh);
        dip_error_set(err, DIP_ERROR_MEMORY, data->name, 0, "mesh", "out of memory");
    }
    free(splitter.local);
    free(splitter.source);
    return mesh;
}

void dip_mesh_destroy(DipMesh **mesh) {
    if (*mesh) {
        free((*mesh)->chunks);
        free((*mesh)->attributes);
        free((*mesh)->indices);
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
