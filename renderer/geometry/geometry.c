// The geometry phase: culling chunks, transforming, clipping, set-up and binning, by jobs.
#include "renderer/geometry/geometry.h"

#include "renderer/geometry/clip.h"
#include "renderer/geometry/mesh.h"
#include "renderer/geometry/setup.h"
#include "renderer/raster/kernels.h"

#include <stdlib.h>
#include <string.h>

DipScreenMapping dip_screen_mapping(const DipPass *pass) {
    DipScreenMapping map = {
        .half_width = 0.5f * (float)pass->target.width,
        .half_height = 0.5f * (float)pass->target.height,
        .clip_plane_count = pass->clip_plane_count,
    };
    const float guard_x = DIP_GUARD_BAND_PX / map.half_width;
    const float guard_y = DIP_GUARD_BAND_PX / map.half_height;
    map.guard_left = guard_x + 1.0f;
    map.guard_right = guard_x - 1.0f;
    map.guard_top = guard_y + 1.0f;
    map.guard_bottom = guard_y - 1.0f;
    memcpy(map.clip_planes, pass->clip_planes, sizeof map.clip_planes);
    return map;
}

static size_t tile_count(const DipGeometry *geometry) {
    return (size_t)geometry->tiles_x * (size_t)geometry->tiles_y;
}

// Reallocates without keeping the content.
static bool replace(void *pointer_to_array, size_t count, size_t size) {
    void **array = pointer_to_array;
    free(*array);
    *array = malloc((count ? count : 1) * size);
    return *array != NULL;
}

static bool make_room(DipGeometry *geometry, uint32_t room, size_t surface_room) {
    if (room > geometry->room) {
        geometry->room = 0;
        if (!replace(&geometry->triangles, room, sizeof *geometry->triangles) ||
            !replace(&geometry->wide, room, sizeof *geometry->wide) ||
            !replace(&geometry->entries, (size_t)room * DIP_MAX_BIN_TILES,
                     sizeof *geometry->entries)) {
            return false;
        }
        geometry->room = room;
    }
    if (surface_room > geometry->surface_room) {
        geometry->surface_room = 0;
        if (!replace(&geometry->surfaces, surface_room, sizeof *geometry->surfaces)) {
            return false;
        }
        geometry->surface_room = surface_room;
    }
    if (!geometry->bins) {
        return replace(&geometry->bins, DIP_MAX_JOBS * tile_count(geometry),
                       sizeof *geometry->bins);
    }
    return true;
}

// What a pass may need of the arrays that 32 bits index: `triangles` of `floats` each. Kernels
// gather surfaces with signed indices.
static bool fits_indices(uint64_t triangles, int floats) {
    return triangles * (uint64_t)floats <= INT32_MAX && triangles * DIP_MAX_BIN_TILES < DIP_BIN_END;
}

// Lays the chunks of all draws one after another and finds the largest slot count. False when
// memory runs out.
static bool list_chunks(DipGeometry *geometry, const DipPass *pass) {
    if (pass->draw_count + 1 > geometry->draw_room) {
        geometry->draw_room = 0;
        if (!replace(&geometry->draw_first_chunk, (size_t)pass->draw_count + 1,
                     sizeof *geometry->draw_first_chunk)) {
            return false;
        }
        geometry->draw_room = pass->draw_count + 1;
    }
    uint32_t chunks = 0; // few enough, check_size has seen
    int slots = 0;
    for (int d = 0; d < pass->draw_count; d++) {
        geometry->draw_first_chunk[d] = chunks;
        chunks += pass->draws[d].mesh->chunk_count;
        slots = pass->draws[d].slot_count > slots ? pass->draws[d].slot_count : slots;
    }
    geometry->draw_first_chunk[pass->draw_count] = chunks;
    geometry->surface_stride = dip_surface_floats(slots);
    return true;
}

static void cut_jobs(DipGeometry *geometry, uint32_t chunks) {
    geometry->job_count = chunks < DIP_MAX_JOBS ? (int)chunks : DIP_MAX_JOBS;
    uint32_t first_triangle = 0;
    for (int j = 0; j < geometry->job_count; j++) {
        const uint32_t first = (uint32_t)((uint64_t)chunks * (uint64_t)j / DIP_MAX_JOBS);
        DipGeometryJob *job = &geometry->jobs[j];
        *job = (DipGeometryJob){.first_triangle = first_triangle};
        if (geometry->job_count < DIP_MAX_JOBS) {
            job->first_chunk = (uint32_t)j;
            job->chunk_count = 1;
        } else {
            job->first_chunk = first;
            job->chunk_count =
                (uint32_t)((uint64_t)chunks * (uint64_t)(j + 1) / DIP_MAX_JOBS) - first;
        }
        job->triangle_room = job->chunk_count * DIP_CHUNK_TRIANGLES + geometry->clip_slack;
        first_triangle += job->triangle_room;
    }
}

// Refuses a pass whose triangles cannot be counted, before any array is made for it.
static bool check_size(const DipGeometry *geometry, const DipPass *pass, DipError *err) {
    uint64_t chunks = 0;
    int slots = 0;
    for (int d = 0; d < pass->draw_count; d++) {
        chunks += pass->draws[d].mesh->chunk_count;
        slots = pass->draws[d].slot_count > slots ? pass->draws[d].slot_count : slots;
    }
    const uint64_t room =
        chunks * DIP_CHUNK_TRIANGLES + DIP_MAX_JOBS * (uint64_t)geometry->clip_slack;
    return fits_indices(room, dip_surface_floats(slots)) ||
           dip_error_set(err, DIP_ERROR_OVERSIZED, NULL, 0, "pass",
                         "%d draws of %llu chunks of up to %d triangles, accepted %u chunks",
                         pass->draw_count, (unsigned long long)chunks, DIP_CHUNK_TRIANGLES,
                         INT32_MAX / dip_surface_floats(slots) / DIP_CHUNK_TRIANGLES);
}

bool dip_geometry_begin(DipGeometry *geometry, const DipPass *pass, DipError *err) {
    geometry->pass = pass;
    geometry->mapping = dip_screen_mapping(pass);
    geometry->pattern = dip_sample_pattern(pass->sample_count);
    if (!geometry->clip_slack) {
        geometry->clip_slack = 256;
    }
    if (!check_size(geometry, pass, err)) {
        return false;
    }
    bool made = list_chunks(geometry, pass);
    if (made) {
        cut_jobs(geometry, geometry->draw_first_chunk[pass->draw_count]);
        uint32_t room = 0;
        for (int j = 0; j < geometry->job_count; j++) {
            room += geometry->jobs[j].triangle_room;
        }
        made = make_room(geometry, room, (size_t)room * (size_t)geometry->surface_stride);
    }
    return made || dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "pass",
                                 "no memory for the triangles of %d draws", pass->draw_count);
}

bool dip_geometry_grow_after_overflow(DipGeometry *geometry) {
    bool overflowed = false;
    for (int j = 0; j < geometry->job_count; j++) {
        overflowed |= geometry->jobs[j].overflowed;
    }
    geometry->clip_slack *= overflowed ? 4 : 1;
    return overflowed;
}

void dip_geometry_free(DipGeometry *geometry) {
    free(geometry->triangles);
    free(geometry->surfaces);
    free(geometry->wide);
    free(geometry->entries);
    free(geometry->bins);
    free(geometry->draw_first_chunk);
    *geometry = (DipGeometry){0};
}

// --- one job -----------------------------------------------------------------------------------

typedef struct JobRun {
    DipGeometry *geometry;
    const DipKernels *kernels;
    DipGeometryJob *job;
    DipGeometryScratch *scratch;
    DipTileBin *bins;
    const DipDraw *draw;
    uint32_t draw_index;
    DipSetupTarget target;
} JobRun;

// Whether a chunk's box lies outside one plane of the view volume. Row r of the matrix gives clip
// coordinate r; the plane is the row's combination, so one dot product per box and plane.
static bool outside_view(const DipChunk *chunk, const float *m) {
    static const float planes[6][4] = {{1, 0, 0, 1},  {-1, 0, 0, 1}, {0, 1, 0, 1},
                                       {0, -1, 0, 1}, {0, 0, 1, 0},  {0, 0, -1, 1}};
    for (int p = 0; p < 6; p++) {
        double normal[4];
        for (int c = 0; c < 4; c++) {
            normal[c] = (double)planes[p][0] * m[c] + (double)planes[p][1] * m[4 + c] +
                        (double)planes[p][2] * m[8 + c] + (double)planes[p][3] * m[12 + c];
        }
        double reach = normal[3];
        double size = normal[3] < 0.0 ? -normal[3] : normal[3];
        for (int c = 0; c < 3; c++) {
            const double length = normal[c] < 0.0 ? -normal[c] : normal[c];
            const double centre = chunk->centre[c];
            reach += normal[c] * centre + length * chunk->extent[c];
            size += length * ((centre < 0.0 ? -centre : centre) + chunk->extent[c]);
        }
        // The margin covers the rounding of the matrix and of the shader's own arithmetic.
        if (reach < -1e-5 * size) {
            return true;
        }
    }
    return false;
}

static void bin_to_tile(JobRun *run, uint32_t triangle, size_t tile) {
    DipGeometryJob *job = run->job;
    DipBinEntry *entries = run->geometry->entries + (size_t)job->first_triangle * DIP_MAX_BIN_TILES;
    const uint32_t index = job->entry_count++;
    entries[index] = (DipBinEntry){triangle, DIP_BIN_END};
    DipTileBin *bin = &run->bins[tile];
    if (bin->first == DIP_BIN_END) {
        bin->first = index;
    } else {
        entries[bin->last].next = index;
    }
    bin->last = index;
}

static void bin_triangle(JobRun *run, uint32_t index) {
    const DipTriangle *triangle = &run->geometry->triangles[index];
    const int x0 = triangle->x0 / DIP_TILE;
    const int y0 = triangle->y0 / DIP_TILE;
    const int x1 = triangle->x1 / DIP_TILE;
    const int y1 = triangle->y1 / DIP_TILE;
    const int tiles = (x1 - x0 + 1) * (y1 - y0 + 1);
    run->job->tile_triangles += (uint64_t)tiles;
    if (tiles > DIP_MAX_BIN_TILES) {
        run->geometry->wide[run->job->first_triangle + run->job->wide_count++] = index;
        return;
    }
    for (int y = y0; y <= y1; y++) {
        for (int x = x0; x <= x1; x++) {
            bin_to_tile(run, index, (size_t)y * (size_t)run->geometry->tiles_x + (size_t)x);
        }
    }
}

static void add_triangle(JobRun *run, const DipScreenVertex vertex[3]) {
    DipGeometry *geometry = run->geometry;
    DipGeometryJob *job = run->job;
    if (job->triangle_count == job->triangle_room) {
        job->overflowed = true;
        return;
    }
    const uint32_t index = job->first_triangle + job->triangle_count;
    DipTriangle *triangle = &geometry->triangles[index];
    triangle->draw = run->draw_index;
    triangle->surface = index * (uint32_t)geometry->surface_stride;
    if (dip_setup_triangle(&run->target, vertex, triangle,
                           geometry->surfaces + triangle->surface)) {
        job->triangle_count++;
        bin_triangle(run, index);
    }
}

// Clips a triangle and sets up the fan of what remains.
static void add_clipped(JobRun *run, const uint8_t *corner, int32_t codes) {
    DipGeometryScratch *scratch = run->scratch;
    const int slot_count = run->draw->slot_count;
    DipClipPolygon polygon = {.count = 3};
    for (int i = 0; i < 3; i++) {
        for (int c = 0; c < 4; c++) {
            polygon.vertex[i].position[c] = scratch->clip[c][corner[i]];
        }
        for (int s = 0; s < slot_count; s++) {
            polygon.vertex[i].slot[s] = scratch->slot[s][corner[i]];
        }
    }
    dip_clip_polygon(&polygon, codes, &run->geometry->mapping, slot_count);
    if (!polygon.count) {
        return;
    }
    float clip[4][DIP_MAX_CLIP_VERTICES + DIP_BATCH_ALIGN] = {{0}};
    float *const clip_rows[4] = {clip[0], clip[1], clip[2], clip[3]};
    for (int i = 0; i < polygon.count; i++) {
        for (int c = 0; c < 4; c++) {
            clip[c][i] = polygon.vertex[i].position[c];
        }
    }
    DipScreenBatch screen;
    run->kernels->dip_kernel_project(&run->geometry->mapping, polygon.count, clip_rows, &screen);
    DipSetupTarget packed = run->target;
    packed.slot_stride = 1;
    const DipSetupTarget strided = run->target;
    run->target = packed;
    for (int i = 1; i + 1 < polygon.count; i++) {
        const int fan[3] = {0, i, i + 1};
        DipScreenVertex vertex[3];
        for (int k = 0; k < 3; k++) {
            const int v = fan[k];
            vertex[k] = (DipScreenVertex){screen.x[v], screen.y[v], screen.z[v], screen.rw[v],
                                          polygon.vertex[v].slot};
        }
        add_triangle(run, vertex);
    }
    run->target = strided;
}

static void add_chunk_triangles(JobRun *run, const DipChunk *chunk) {
    const DipScreenBatch *screen = &run->scratch->screen;
    const uint8_t *corner = run->draw->mesh->indices + 3 * (size_t)chunk->first_triangle;
    const int32_t reject =
        DIP_CLIP_PICTURE | DIP_CLIP_NEAR | DIP_CLIP_FAR | DIP_CLIP_W | DIP_CLIP_ALL_USER;
    for (uint32_t t = 0; t < chunk->triangle_count; t++, corner += 3) {
        const int32_t c0 = screen->code[corner[0]];
        const int32_t c1 = screen->code[corner[1]];
        const int32_t c2 = screen->code[corner[2]];
        const int32_t any = c0 | c1 | c2;
        if ((c0 & c1 & c2 & reject) || (any & DIP_CLIP_INVALID)) {
            continue;
        }
        if (any & DIP_CLIP_NEEDED) {
            add_clipped(run, corner, any);
            continue;
        }
        DipScreenVertex vertex[3];
        for (int k = 0; k < 3; k++) {
            const int v = corner[k];
            vertex[k] = (DipScreenVertex){screen->x[v], screen->y[v], screen->z[v], screen->rw[v],
                                          run->scratch->slot[0] + v};
        }
        add_triangle(run, vertex);
    }
}

static void run_chunk(JobRun *run, const DipChunk *chunk) {
    const DipMesh *mesh = run->draw->mesh;
    DipGeometryScratch *scratch = run->scratch;
    const float *in[DIP_MAX_ATTRIBUTES];
    for (int a = 0; a < mesh->attribute_count; a++) {
        in[a] = mesh->attributes + (size_t)a * mesh->vertex_total + chunk->first_vertex;
    }
    float *clip[4];
    float *slot[DIP_MAX_SLOTS];
    for (int c = 0; c < 4; c++) {
        clip[c] = scratch->clip[c];
    }
    for (int s = 0; s < DIP_MAX_SLOTS; s++) {
        slot[s] = scratch->slot[s];
    }
    const DipVertexBatch batch = {(int)chunk->vertex_count, in, clip, slot, run->draw->uniforms};
    run->draw->vertex_shader(&batch);
    run->kernels->dip_kernel_project(&run->geometry->mapping, (int)chunk->vertex_count, clip,
                                     &scratch->screen);
    add_chunk_triangles(run, chunk);
}

static DipSetupTarget setup_target(const DipGeometry *geometry) {
    DipSetupTarget target = {
        .width = geometry->pass->target.width,
        .height = geometry->pass->target.height,
        .slot_stride = DIP_VERTEX_BATCH,
        .sample_min = {255, 255},
    };
    for (int s = 0; s < geometry->pattern->count; s++) {
        const uint8_t at[2] = {geometry->pattern->x[s], geometry->pattern->y[s]};
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

// The draw that holds a chunk: the last whose first chunk is not beyond it.
static uint32_t draw_of_chunk(const DipGeometry *geometry, uint32_t chunk) {
    uint32_t low = 0;
    uint32_t high = (uint32_t)geometry->pass->draw_count;
    while (high - low > 1) {
        const uint32_t middle = (low + high) / 2;
        if (geometry->draw_first_chunk[middle] <= chunk) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

void dip_geometry_run_job(DipGeometry *geometry, const DipKernels *kernels, int job_index,
                          DipGeometryScratch *scratch) {
    DipGeometryJob *job = &geometry->jobs[job_index];
    JobRun run = {
        .geometry = geometry,
        .kernels = kernels,
        .job = job,
        .scratch = scratch,
        .bins = geometry->bins + (size_t)job_index * tile_count(geometry),
        .target = setup_target(geometry),
    };
    memset(run.bins, 0xff, tile_count(geometry) * sizeof *run.bins);
    for (uint32_t c = job->first_chunk; c < job->first_chunk + job->chunk_count; c++) {
        run.draw_index = draw_of_chunk(geometry, c);
        run.draw = &geometry->pass->draws[run.draw_index];
        run.target.cull = run.draw->cull;
        run.target.slot_count = run.draw->slot_count;
        const DipChunk *chunk =
            &run.draw->mesh->chunks[c - geometry->draw_first_chunk[run.draw_index]];
        if (run.draw->bounds_to_clip && outside_view(chunk, run.draw->bounds_to_clip)) {
            continue;
        }
        job->triangles_in += chunk->triangle_count;
        run_chunk(&run, chunk);
    }
}
