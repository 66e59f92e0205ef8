// A job of the geometry stage: transforms chunks, then clips, sets up and bins their triangles.
#include "renderer/pipeline/geometry/geometry.h"

#include "renderer/base/pages.h"
#include "renderer/pipeline/geometry/clip.h"
#include "renderer/pipeline/geometry/mesh_layout.h"
#include "renderer/pipeline/geometry/repeat.h"
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/merge/ordered.h"

#include <math.h>
#include <string.h>

// The state of a job while it runs.
typedef struct JobRun {
    DipGeometry *geometry;
    const DipKernels *kernels;
    DipGeometryScratch *scratch;
    DipTileBin *bins;
    const DipDraw *draw;
    DipSetupTarget target;
    uint32_t all_edges[DIP_CHUNK_TRIANGLES + DIP_BATCH_ALIGN]; // the flags of ordered draws
    const float *position[3]; // x, y and z of the current chunk's vertices
    uint32_t next_triangle;   // index of the next free triangle in the job's current run
    uint32_t triangle_end;
    uint32_t next_block; // index of the next free block in the job's current run
    uint32_t block_end;
    // The job's result. It is copied to the geometry at the end, so that running jobs share no
    // cache lines.
    DipGeometryJob job;
} JobRun;

// --- binning -----------------------------------------------------------------------------------

// Takes a bin block for the job. Returns false if the space for blocks is used up.
static bool take_block(JobRun *run, uint32_t *block) {
    if (run->next_block == run->block_end) {
        DipGeometry *geometry = run->geometry;
        const uint32_t first =
            atomic_fetch_add_explicit(&geometry->blocks_taken, DIP_BLOCK_RUN, memory_order_relaxed);
        if (first + DIP_BLOCK_RUN > geometry->block_room) {
            run->job.overflowed = true;
            return false;
        }
        run->next_block = first;
        run->block_end = first + DIP_BLOCK_RUN;
    }
    *block = run->next_block++;
    return true;
}

// Adds a block to a bin. Returns false if the space for blocks is used up.
static bool lengthen_bin(JobRun *run, DipTileBin *bin, bool empty) {
    uint32_t block;
    if (!take_block(run, &block)) {
        return false;
    }
    if (empty) {
        bin->first = block;
    } else {
        run->geometry->blocks[bin->last].next = block;
    }
    bin->last = block;
    bin->last_count = 0;
    return true;
}

static inline void add_to_bin(JobRun *run, uint32_t triangle, size_t index) {
    DipTileBin *bin = &run->bins[index];
    uint64_t *word = &run->scratch->occupied[index / 64];
    const uint64_t bit = (uint64_t)1 << index % 64;
    const bool empty = !(*word & bit);
    if (empty || bin->last_count == DIP_BIN_BLOCK) {
        if (!lengthen_bin(run, bin, empty)) {
            return;
        }
        *word |= bit;
    }
    run->geometry->blocks[bin->last].triangle[bin->last_count++] = triangle;
}

static size_t least(size_t a, size_t b) {
    return a < b ? a : b;
}

static size_t greatest(size_t a, size_t b) {
    return a > b ? a : b;
}

// Adds a triangle to the bins of all tiles that its pixel box touches, or to the bin of wide
// triangles.
static void bin_across_tiles(JobRun *run, uint32_t index) {
    const DipTriangle *triangle = &run->geometry->triangles[index];
    const DipTargetRegion *region = &run->geometry->tile_region;
    const size_t tiles_x = (size_t)run->geometry->tiles_x;
    const size_t x0 = greatest((size_t)triangle->x0 / DIP_TILE, (size_t)region->x0);
    const size_t y0 = greatest((size_t)triangle->y0 / DIP_TILE, (size_t)region->y0);
    const size_t x1 = least((size_t)triangle->x1 / DIP_TILE, (size_t)region->x1 - 1);
    const size_t y1 = least((size_t)triangle->y1 / DIP_TILE, (size_t)region->y1 - 1);
    const size_t tiles = (x1 - x0 + 1) * (y1 - y0 + 1);
    run->job.tile_triangles += tiles;
    if (tiles > DIP_MAX_BIN_TILES) {
        add_to_bin(run, index, dip_geometry_tiles(run->geometry));
        return;
    }
    for (size_t y = y0; y <= y1; y++) {
        for (size_t x = x0; x <= x1; x++) {
            if (dip_geometry_needs_tile(run->geometry, y * tiles_x + x)) {
                add_to_bin(run, index, y * tiles_x + x);
            }
        }
    }
}

// Sorts the triangles first..end - 1 into the bins. Most triangles of a dense mesh have their pixel
// box in one tile. This tile is in the region, because set-up keeps no triangle outside it.
static void bin_triangles(JobRun *run, uint32_t first, uint32_t end) {
    const DipTriangle *triangles = run->geometry->triangles;
    const DipTileRegion *parts = run->geometry->pass->tile_regions;
    const unsigned tiles_x = (unsigned)run->geometry->tiles_x;
    for (uint32_t index = first; index < end; index++) {
        const DipTriangle *triangle = &triangles[index];
        const unsigned x0 = (unsigned)triangle->x0;
        const unsigned y0 = (unsigned)triangle->y0;
        if (((x0 ^ (unsigned)triangle->x1) | (y0 ^ (unsigned)triangle->y1)) >= DIP_TILE) {
            bin_across_tiles(run, index);
            continue;
        }
        const size_t tile = y0 / DIP_TILE * tiles_x + x0 / DIP_TILE;
        run->job.tile_triangles++;
        if (!parts || parts[tile].x1) {
            add_to_bin(run, index, tile);
        }
    }
}

// --- set-up ------------------------------------------------------------------------------------

// Makes sure that there is space for `count` triangles from next_triangle on. Returns false if the
// space for triangles is used up.
static bool take_triangles(JobRun *run, uint32_t count) {
    if (run->triangle_end - run->next_triangle < count) {
        DipGeometry *geometry = run->geometry;
        const uint32_t first = atomic_fetch_add_explicit(&geometry->triangles_taken,
                                                         DIP_TRIANGLE_RUN, memory_order_relaxed);
        if (first + DIP_TRIANGLE_RUN > geometry->triangle_room) {
            run->job.overflowed = true;
            return false;
        }
        if (first != run->triangle_end) {
            run->next_triangle = first; // otherwise the new run continues the old one
        }
        run->triangle_end = first + DIP_TRIANGLE_RUN;
    }
    return true;
}

static void add_batch(JobRun *run, const DipSetupBatch *batch) {
    if (run->job.overflowed || !take_triangles(run, (uint32_t)batch->count + DIP_SETUP_EXCESS)) {
        return;
    }
    const DipGeometry *geometry = run->geometry;
    const uint32_t first = run->next_triangle;
    const size_t first_plane = (size_t)first * (size_t)geometry->plane_stride;
    const int count = run->kernels->dip_kernel_setup(
        &run->target, batch, geometry->triangles + first, geometry->planes + first_plane);
    bin_triangles(run, first, first + (uint32_t)count);
    run->next_triangle += (uint32_t)count;
    run->job.triangles_drawn += (uint64_t)count;
}

// Reduces the repeating varyings of a polygon by their nearest multiples of DIP_REPEAT_STEP at one
// of its vertices.
static void reduce_repeats(DipClipPolygon *polygon, const DipDraw *draw, int vertex) {
    for (int s = 0; s < draw->varying_count; s++) {
        if (draw->repeating_varyings >> s & 1) {
            const double repeat = dip_nearest_repeat(polygon->vertex[vertex].varying[s]);
            for (int i = 0; i < polygon->count; i++) {
                polygon->vertex[i].varying[s] -= repeat;
            }
        }
    }
}

// Returns the vertex of a polygon with the least w.
static int nearest_vertex(const DipClipPolygon *polygon) {
    int nearest = 0;
    for (int i = 1; i < polygon->count; i++) {
        if (polygon->vertex[i].position[3] < polygon->vertex[nearest].position[3]) {
            nearest = i;
        }
    }
    return nearest;
}

// Sets the clip position of vertex v of the current chunk.
static void load_position(const JobRun *run, uint8_t v, DipClipVertex *vertex) {
    const DipExactTransform *exact = run->draw->exact_to_clip;
    const float near_clip = run->scratch->clip[2][v]; // the same for all vertices
    const float by_near = DIP_FAR_RATIO * near_clip;
    float far_coordinate = by_near < DIP_FAR_COORDINATE ? by_near : DIP_FAR_COORDINATE;
    if (exact && exact->far_coordinate > 0.0f) {
        far_coordinate = exact->far_coordinate;
    }
    vertex->far = false;
    for (int c = 0; c < 4; c++) {
        vertex->projected[c] = run->scratch->clip[c][v];
        vertex->position[c] = vertex->projected[c];
        vertex->far |= exact && fabsf(vertex->projected[c]) > far_coordinate;
    }
    double from_origin[3];
    for (int k = 0; vertex->far && k < 3; k++) {
        from_origin[k] = (double)run->position[k][v] - exact->origin[k];
    }
    for (int c = 0; vertex->far && c < 4; c++) {
        const double *m = exact->to_clip + 4 * c;
        vertex->position[c] =
            ((m[0] * from_origin[0] + m[1] * from_origin[1]) + m[2] * from_origin[2]) + m[3];
    }
}

// Returns the flags of triangle i of a polygon's fan, which an ordered draw has instead of a patch.
static uint32_t fan_edges(const DipClipPolygon *polygon, int i) {
    const bool first = i == 0;
    const bool last = i == polygon->count - 3;
    return (uint32_t)(first && polygon->vertex[0].edge) |
           (uint32_t)polygon->vertex[i + 1].edge << 1 |
           (uint32_t)(last && polygon->vertex[i + 2].edge) << 2;
}

// Clips a triangle and sets up the polygon that remains as a fan of triangles.
static void add_clipped(JobRun *run, const uint8_t corner[3], uint32_t patch, int32_t codes) {
    const DipGeometryScratch *scratch = run->scratch;
    const int varying_count = run->draw->varying_count;
    DipClipPolygon polygon = {.count = 3};
    for (int i = 0; i < 3; i++) {
        load_position(run, corner[i], &polygon.vertex[i]);
        polygon.vertex[i].edge = true;
        for (int s = 0; s < varying_count; s++) {
            polygon.vertex[i].varying[s] = scratch->varying[s][corner[i]];
        }
    }
    // The varyings are reduced before they are interpolated, and again where the polygon is nearest
    // to the eye before they are rounded to floats: a triangle that is cut near the eye may reach
    // far away.
    reduce_repeats(&polygon, run->draw, 0);
    const DipClipVaryings clipped = {varying_count, run->draw->repeating_varyings};
    dip_clip_polygon(&polygon, codes, &run->geometry->mapping, &clipped);
    if (!polygon.count) {
        return;
    }
    reduce_repeats(&polygon, run->draw, nearest_vertex(&polygon));
    enum { ROOM = DIP_MAX_CLIP_VERTICES + DIP_BATCH_ALIGN };
    float clip[4][ROOM] = {{0}};
    float varyings[DIP_MAX_VARYINGS][ROOM];
    uint8_t fan[3][ROOM] = {{0}};
    uint32_t patches[ROOM];
    for (int i = 0; i < ROOM; i++) {
        patches[i] =
            run->target.front_flag && i < polygon.count - 2 ? fan_edges(&polygon, i) : patch;
    }
    float *const clip_rows[4] = {clip[0], clip[1], clip[2], clip[3]};
    for (int i = 0; i < polygon.count; i++) {
        for (int c = 0; c < 4; c++) {
            clip[c][i] = polygon.vertex[i].projected[c];
        }
        for (int s = 0; s < varying_count; s++) {
            varyings[s][i] = run->draw->w_varyings >> s & 1 ? polygon.vertex[i].projected[3]
                                                            : (float)polygon.vertex[i].varying[s];
        }
        fan[1][i] = (uint8_t)(i + 1 < polygon.count ? i + 1 : 0);
        fan[2][i] = (uint8_t)(i + 2 < polygon.count ? i + 2 : 0);
    }
    DipScreenBatch screen;
    run->kernels->dip_kernel_project(&run->geometry->mapping, polygon.count, clip_rows, &screen);
    add_batch(run, &(DipSetupBatch){.count = polygon.count - 2,
                                    .corner = {fan[0], fan[1], fan[2]},
                                    .patch = patches,
                                    .screen = &screen,
                                    .varyings = varyings[0],
                                    .varying_stride = ROOM});
}

// --- one job -----------------------------------------------------------------------------------

// The clip codes that reject triangles. A triangle is invisible if one of these codes is set for
// all its vertices.
enum {
    REJECT = DIP_CLIP_PICTURE | DIP_CLIP_NEAR | DIP_CLIP_FAR | DIP_CLIP_W | DIP_CLIP_ALL_USER,
};

// Adds the triangles of a chunk in which some triangles have to be clipped. The order of the
// triangles is kept. The triangles between two clipped ones are set up as one batch.
static void add_clipped_chunk(JobRun *run, const DipSetupBatch *chunk) {
    uint8_t corner[3][DIP_CHUNK_TRIANGLES + DIP_BATCH_ALIGN] = {{0}};
    uint32_t patch[DIP_CHUNK_TRIANGLES + DIP_BATCH_ALIGN] = {0};
    DipSetupBatch batch = *chunk;
    batch.count = 0;
    batch.patch = patch;
    for (int k = 0; k < 3; k++) {
        batch.corner[k] = corner[k];
    }
    for (int t = 0; t < chunk->count; t++) {
        const uint8_t v[3] = {chunk->corner[0][t], chunk->corner[1][t], chunk->corner[2][t]};
        const int32_t *code = chunk->screen->code;
        const int32_t any = code[v[0]] | code[v[1]] | code[v[2]];
        if ((code[v[0]] & code[v[1]] & code[v[2]] & REJECT) || (any & DIP_CLIP_INVALID)) {
            continue;
        }
        if (!(any & DIP_CLIP_NEEDED)) {
            for (int k = 0; k < 3; k++) {
                corner[k][batch.count] = v[k];
            }
            patch[batch.count] = chunk->patch[t];
            batch.count++;
            continue;
        }
        if (batch.count) {
            add_batch(run, &batch);
            batch.count = 0;
        }
        add_clipped(run, v, chunk->patch[t], any);
    }
    if (batch.count) {
        add_batch(run, &batch);
    }
}

static void add_chunk_triangles(JobRun *run, const DipChunk *chunk) {
    const uint32_t *all_edges = run->all_edges;
    const DipScreenBatch *screen = &run->scratch->screen;
    const uint8_t *corner = run->draw->mesh->indices + chunk->first_index;
    const uint32_t stride = dip_corner_stride(chunk);
    int32_t any = 0;
    int32_t all = -1;
    for (uint32_t v = 0; v < chunk->vertex_count; v++) {
        any |= screen->code[v];
        all &= screen->code[v];
    }
    if (all & REJECT) {
        return;
    }
    const DipSetupBatch batch = {.count = (int)chunk->triangle_count,
                                 .corner = {corner, corner + stride, corner + 2 * stride},
                                 .patch = run->target.front_flag
                                              ? all_edges
                                              : run->draw->mesh->patches + chunk->first_triangle,
                                 .screen = screen,
                                 .varyings = run->scratch->varying[0],
                                 .varying_stride = DIP_VERTEX_BATCH};
    if (any & (DIP_CLIP_NEEDED | DIP_CLIP_INVALID)) {
        add_clipped_chunk(run, &batch);
    } else {
        // Triangles beyond one side of the picture need no test here: they have no pixel in the
        // picture, so set-up drops them.
        add_batch(run, &batch);
    }
}

static inline void prefetch(const void *from, size_t size_bytes) {
    const uintptr_t first = (uintptr_t)from / DIP_CACHE_LINE * DIP_CACHE_LINE;
    for (uintptr_t line = first; line < (uintptr_t)from + size_bytes; line += DIP_CACHE_LINE) {
        __builtin_prefetch((const void *)line);
    }
}

// Prefetches the vertices and triangles of the chunk that is set up after the current one. Its
// arrays are short and lie far from each other, so the processor does not foresee these reads.
static void prefetch_chunk(const JobRun *run, const DipVisibleChunk *next,
                           const DipChunk *current) {
    const DipMesh *mesh = run->geometry->pass->draws[next->draw].mesh;
    const DipChunk *chunk = &mesh->chunks[next->chunk];
    if (chunk == current) {
        return; // two draws of the same object
    }
    for (int a = 0; a < mesh->attribute_count; a++) {
        prefetch(mesh->attributes + (size_t)a * mesh->vertex_total + chunk->first_vertex,
                 chunk->vertex_count * sizeof *mesh->attributes);
    }
    prefetch(mesh->indices + chunk->first_index, 3 * (size_t)dip_corner_stride(chunk));
    prefetch(mesh->patches + chunk->first_triangle, chunk->triangle_count * sizeof *mesh->patches);
}

// Sets up the triangles of a chunk. next: the chunk that comes after it in the job, or NULL.
static void run_chunk(JobRun *run, const DipChunk *chunk, const DipVisibleChunk *next) {
    const DipMesh *mesh = run->draw->mesh;
    DipGeometryScratch *scratch = run->scratch;
    const float *in[DIP_MAX_ATTRIBUTES];
    static const float lacking[DIP_VERTEX_BATCH];
    for (int a = 0; a < DIP_MAX_ATTRIBUTES; a++) {
        in[a] = a < mesh->attribute_count
                    ? mesh->attributes + (size_t)a * mesh->vertex_total + chunk->first_vertex
                    : lacking;
    }
    float *clip[4];
    float *varying[DIP_MAX_VARYINGS];
    // What the vertex shader leaves unset is 0, not what an earlier chunk left there.
    const size_t bytes = chunk->vertex_count * sizeof(float);
    for (int c = 0; c < 4; c++) {
        clip[c] = memset(scratch->clip[c], 0, bytes);
    }
    for (int s = 0; s < DIP_MAX_VARYINGS; s++) {
        varying[s] = scratch->varying[s];
    }
    for (int s = 0; s < run->draw->varying_count; s++) {
        memset(varying[s], 0, bytes);
    }
    memcpy(run->position, in, sizeof run->position);
    const DipVertexBatch batch = {(int)chunk->vertex_count, in, clip, varying, run->draw->uniforms};
    run->draw->vertex_shader(&batch);
    run->kernels->dip_kernel_project(&run->geometry->mapping, (int)chunk->vertex_count, clip,
                                     &scratch->screen);
    if (next) {
        prefetch_chunk(run, next, chunk);
    }
    add_chunk_triangles(run, chunk);
}

static DipSetupTarget setup_target(const DipGeometry *geometry) {
    const DipTargetRegion *region = &geometry->region;
    DipSetupTarget target = {
        .width = geometry->pass->target.width,
        .height = geometry->pass->target.height,
        .region_first = {region->x0, region->y0},
        .region_last = {region->x1 - 1, region->y1 - 1},
        .plane_stride = geometry->plane_stride,
        .samples = &geometry->samples,
        .sample_min = {255, 255},
    };
    for (int s = 0; s < geometry->samples.count; s++) {
        const uint8_t at[2] = {geometry->samples.x[s], geometry->samples.y[s]};
        for (int axis = 0; axis < 2; axis++) {
            if (at[axis] < target.sample_min[axis]) {
                target.sample_min[axis] = at[axis];
            }
            if (at[axis] > target.sample_max[axis]) {
                target.sample_max[axis] = at[axis];
            }
        }
    }
    return target;
}

void dip_geometry_run_job(DipGeometry *geometry, const DipKernels *kernels, int job_index,
                          DipGeometryScratch *scratch) {
    DipGeometryJob *job = &geometry->jobs[job_index];
    const size_t bins = dip_geometry_tiles(geometry) + 1;
    const size_t words = (bins + 63) / 64;
    JobRun run = {
        .geometry = geometry,
        .kernels = kernels,
        .scratch = scratch,
        .bins = geometry->bins + (size_t)job_index * bins,
        .target = setup_target(geometry),
        .next_triangle = scratch->next_triangle,
        .triangle_end = scratch->triangle_end,
        .job = *job,
    };
    memset(scratch->occupied, 0, words * sizeof *scratch->occupied);
    for (int i = 0; i < DIP_CHUNK_TRIANGLES + DIP_BATCH_ALIGN; i++) {
        run.all_edges[i] = DIP_ORDERED_EDGES;
    }
    const uint32_t end = job->first_chunk + job->chunk_count;
    for (uint32_t c = job->first_chunk; c < end; c++) {
        const DipVisibleChunk visible = geometry->visible[c];
        run.draw = &geometry->pass->draws[visible.draw];
        run.target.draw = visible.draw;
        const bool ordered = dip_state_is_ordered(run.draw->state);
        run.target.first_patch = ordered ? 0 : geometry->first_patch[visible.draw];
        run.target.front_flag = ordered ? DIP_ORDERED_FRONT : 0;
        run.target.cull = run.draw->cull;
        run.target.varying_count = run.draw->varying_count;
        run.target.repeating_varyings = run.draw->repeating_varyings;
        const DipChunk *chunk = &run.draw->mesh->chunks[visible.chunk];
        run.job.triangles_in += chunk->triangle_count;
        run_chunk(&run, chunk, c + 1 < end ? &geometry->visible[c + 1] : NULL);
    }
    for (size_t w = 0; w < words; w++) {
        geometry->occupied[w * DIP_MAX_JOBS + (size_t)job_index] = scratch->occupied[w];
    }
    scratch->next_triangle = run.next_triangle;
    scratch->triangle_end = run.triangle_end;
    *job = run.job;
}
