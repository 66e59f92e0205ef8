// Prepares the geometry stage of a pass: finds the chunks in view, divides them into jobs (job.c),
// and makes room for their triangles.
#include "renderer/pipeline/geometry/geometry.h"

#include "renderer/base/pages.h"
#include "renderer/pipeline/geometry/chunk_cull.h"
#include "renderer/pipeline/geometry/mesh_layout.h"
#include "renderer/pipeline/geometry/order.h"

#include <stdlib.h>
#include <string.h>

enum {
    // Greatest number of triangles for which space stays unused at the end of a run. A run is the
    // space for DIP_TRIANGLE_RUN triangles that a job takes at a time.
    TRIANGLE_RUN_WASTE = DIP_SETUP_BATCH + DIP_SETUP_EXCESS,
    LEAST_SLACK = 4096, // smallest slack (DipGeometry.slack), in triangles
    // Assumed mean number of bin entries per triangle. It limits the space for entries if the worst
    // case would need more.
    MEAN_BIN_TILES = 2,
};

// Margin around the region, so that rounding in the clipper never rejects a visible triangle.
enum { REJECT_MARGIN_PX = 16 };

static float bounded(float ndc) {
    return ndc < -1.0f ? -1.0f : ndc > 1.0f ? 1.0f : ndc;
}

static void bound_picture(const DipPass *pass, DipScreenMapping *map) {
    const DipTargetRegion region = dip_drawn_region(pass);
    const int x0 = region.x0 - map->first_x;
    const int x1 = region.x1 - map->first_x;
    const int y0 = region.y0 - map->first_y;
    const int y1 = region.y1 - map->first_y;
    map->left = bounded((float)(x0 - REJECT_MARGIN_PX) / map->half_width - 1.0f);
    map->right = bounded((float)(x1 + REJECT_MARGIN_PX) / map->half_width - 1.0f);
    map->top = bounded(1.0f - (float)(y0 - REJECT_MARGIN_PX) / map->half_height);
    map->bottom = bounded(1.0f - (float)(y1 + REJECT_MARGIN_PX) / map->half_height);
}

DipScreenMapping dip_screen_mapping(const DipPass *pass) {
    const DipTargetRegion viewport = dip_viewport(pass);
    DipScreenMapping map = {
        .half_width = 0.5f * (float)(viewport.x1 - viewport.x0),
        .half_height = 0.5f * (float)(viewport.y1 - viewport.y0),
        .first_x = viewport.x0,
        .first_y = viewport.y0,
        .clip_plane_count = pass->clip_plane_count,
    };
    map.guard_left = (float)(DIP_GUARD_BAND_PX + viewport.x0) / map.half_width + 1.0f;
    map.guard_right = (float)(DIP_GUARD_BAND_PX - viewport.x0) / map.half_width - 1.0f;
    map.guard_top = (float)(DIP_GUARD_BAND_PX + viewport.y0) / map.half_height + 1.0f;
    map.guard_bottom = (float)(DIP_GUARD_BAND_PX - viewport.y0) / map.half_height - 1.0f;
    memcpy(map.clip_planes, pass->clip_planes, sizeof map.clip_planes);
    bound_picture(pass, &map);
    return map;
}

// --- memory ------------------------------------------------------------------------------------

// The lengths of the arrays that a pass needs, even if all of it is in view.
typedef struct Needs {
    uint32_t draws;
    uint64_t chunks;
    uint64_t triangles;
    uint64_t blocks;
    int plane_stride;
} Needs;

static uint64_t least(uint64_t a, uint64_t b) {
    return a < b ? a : b;
}

static Needs needs_of(const DipGeometry *geometry, const DipPass *pass) {
    Needs needs = {.draws = (uint32_t)pass->draw_count};
    int varyings = 0;
    for (int d = 0; d < pass->draw_count; d++) {
        needs.chunks += pass->draws[d].mesh->chunk_count;
        needs.triangles += pass->draws[d].mesh->triangle_count;
        varyings =
            pass->draws[d].varying_count > varyings ? pass->draws[d].varying_count : varyings;
    }
    const uint64_t jobs = least(needs.chunks, DIP_MAX_JOBS);
    const uint64_t total = needs.triangles + geometry->slack;
    needs.triangles = total * DIP_TRIANGLE_RUN / (DIP_TRIANGLE_RUN - TRIANGLE_RUN_WASTE) +
                      jobs * DIP_TRIANGLE_RUN + DIP_SETUP_EXCESS;
    // Each bin may end with a block that is not full, which needs space as well.
    const uint64_t entries =
        least(total * DIP_MAX_BIN_TILES, total * MEAN_BIN_TILES + (uint64_t)16 * geometry->slack);
    needs.blocks = entries / DIP_BIN_BLOCK +
                   least(entries, jobs * (dip_geometry_tiles(geometry) + 1)) + jobs * DIP_BLOCK_RUN;
    needs.plane_stride = dip_plane_stride(varyings);
    return needs;
}

// Refuses a pass that has too many triangles, before any array is allocated. The limit exists
// because kernels gather planes with signed 32-bit indices.
static bool check_size(const DipPass *pass, const Needs *needs, DipError *err) {
    return needs->triangles <= INT32_MAX / (uint64_t)needs->plane_stride ||
           dip_error_set(err, DIP_ERROR_OVERSIZED, NULL, 0, "pass",
                         "%d draws need space for %llu triangles, accepted at most %d",
                         pass->draw_count, (unsigned long long)needs->triangles,
                         INT32_MAX / needs->plane_stride);
}

// Arrays of at least this many bytes get huge pages, which save TLB misses. In smaller arrays, the
// part of the last huge page that is not used would be a large share of the memory.
enum { LARGE_ARRAY = 16 << 20 };

// Frees an array and allocates it with a new length. Its content is lost.
static bool replace(void *pointer_to_array, size_t count, size_t size) {
    void **array = pointer_to_array;
    dip_lines_free(*array);
    const size_t size_bytes = count * size;
    *array = size_bytes < LARGE_ARRAY ? dip_lines_alloc(size_bytes) : dip_pages_alloc(size_bytes);
    return *array != NULL;
}

static bool make_room(DipGeometry *geometry, const Needs *needs) {
    const size_t plane_room = (size_t)needs->triangles * (size_t)needs->plane_stride;
    if (needs->draws > geometry->draw_room) {
        geometry->draw_room = 0;
        if (!replace(&geometry->first_patch, needs->draws, sizeof *geometry->first_patch) ||
            !replace(&geometry->draw_order, needs->draws, sizeof *geometry->draw_order) ||
            !replace(&geometry->draw_keys, needs->draws, sizeof *geometry->draw_keys)) {
            return false;
        }
        geometry->draw_room = needs->draws;
    }
    if (needs->chunks > geometry->visible_room) {
        geometry->visible_room = 0;
        if (!replace(&geometry->visible, needs->chunks, sizeof *geometry->visible)) {
            return false;
        }
        geometry->visible_room = (uint32_t)needs->chunks;
    }
    if (needs->triangles > geometry->triangle_room) {
        geometry->triangle_room = 0;
        if (!replace(&geometry->triangles, needs->triangles, sizeof *geometry->triangles)) {
            return false;
        }
        geometry->triangle_room = (uint32_t)needs->triangles;
    }
    if (plane_room > geometry->plane_room) {
        geometry->plane_room = 0;
        if (!replace(&geometry->planes, plane_room, sizeof *geometry->planes)) {
            return false;
        }
        geometry->plane_room = plane_room;
    }
    if (needs->blocks > geometry->block_room) {
        geometry->block_room = 0;
        if (!replace(&geometry->blocks, needs->blocks, sizeof *geometry->blocks)) {
            return false;
        }
        geometry->block_room = (uint32_t)needs->blocks;
    }
    return true;
}

static bool make_bins(DipGeometry *geometry) {
    const size_t bins = dip_geometry_tiles(geometry) + 1;
    return (geometry->bins && geometry->occupied) ||
           (replace(&geometry->bins, DIP_MAX_JOBS * bins, sizeof *geometry->bins) &&
            replace(&geometry->occupied, DIP_MAX_JOBS * ((bins + 63) / 64),
                    sizeof *geometry->occupied));
}

static void cut_jobs(DipGeometry *geometry) {
    const uint32_t chunks = geometry->visible_count;
    geometry->job_count = (int)least(chunks, DIP_MAX_JOBS);
    uint32_t first = 0;
    for (int j = 0; j < geometry->job_count; j++) {
        const uint32_t end =
            (uint32_t)((uint64_t)chunks * (uint64_t)(j + 1) / (uint64_t)geometry->job_count);
        geometry->jobs[j] = (DipGeometryJob){.first_chunk = first, .chunk_count = end - first};
        first = end;
    }
}

bool dip_geometry_reserve(DipGeometry *geometry, const DipPass *pass, DipError *err) {
    if (!geometry->slack) {
        geometry->slack = LEAST_SLACK;
    }
    const Needs needs = needs_of(geometry, pass);
    if (!check_size(pass, &needs, err)) {
        return false;
    }
    if (!make_room(geometry, &needs) || !make_bins(geometry)) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "pass",
                             "no memory for the triangles of %d draws", pass->draw_count);
    }
    geometry->plane_stride = needs.plane_stride;
    return true;
}

// Numbers the patches of all draws consecutively, from 1.
static void number_patches(DipGeometry *geometry) {
    uint32_t next = 1;
    for (int d = 0; d < geometry->pass->draw_count; d++) {
        geometry->first_patch[d] = next;
        next += geometry->pass->draws[d].mesh->patch_count;
    }
}

static DipTargetRegion tiles_of(const DipTargetRegion *region) {
    return (DipTargetRegion){region->x0 / DIP_TILE, region->y0 / DIP_TILE,
                             (region->x1 + DIP_TILE - 1) / DIP_TILE,
                             (region->y1 + DIP_TILE - 1) / DIP_TILE};
}

// Threads take tiles in the order of geometry->tiles: one group of 2x2 tiles after the other.
// Compared with an order along rows, threads work on neighbouring tiles for longer. Neighbouring
// tiles read much the same texels and triangles.
enum { TILE_GROUP = 2 };

static void list_group(DipGeometry *geometry, int x0, int y0) {
    const DipTargetRegion *region = &geometry->tile_region;
    for (int x = x0; x < x0 + TILE_GROUP && x < region->x1; x++) {
        for (int y = y0; y < y0 + TILE_GROUP && y < region->y1; y++) {
            const int tile = y * geometry->tiles_x + x;
            if (dip_geometry_needs_tile(geometry, (size_t)tile)) {
                geometry->tiles[geometry->tile_count++] = (uint16_t)tile;
            }
        }
    }
}

static void list_tiles(DipGeometry *geometry) {
    const DipTargetRegion *region = &geometry->tile_region;
    geometry->tile_count = 0;
    for (int y = region->y0; y < region->y1; y += TILE_GROUP) {
        for (int x = region->x0; x < region->x1; x += TILE_GROUP) {
            list_group(geometry, x, y);
        }
    }
}

// Collects the sample positions of all passes. A pattern that several passes share is added once.
static void set_samples(DipSamplePositions *samples, const DipPass *const *passes, int count) {
    samples->count = 0;
    for (int i = 0; i < count; i++) {
        bool known = false;
        for (int j = 0; j < i && !known; j++) {
            known = passes[j]->sample_count == passes[i]->sample_count &&
                    passes[j]->pattern == passes[i]->pattern;
        }
        if (!known) {
            dip_sample_positions_add(
                samples, dip_sample_pattern_of(passes[i]->sample_count, passes[i]->pattern));
        }
    }
}

bool dip_geometry_begin(DipGeometry *geometry, const DipPass *const *passes, int pass_count,
                        DipPool *pool, DipError *err) {
    const DipPass *pass = passes[0];
    geometry->pass = pass;
    geometry->mapping = dip_screen_mapping(pass);
    set_samples(&geometry->samples, passes, pass_count);
    geometry->region = dip_drawn_region(pass);
    geometry->tile_region = tiles_of(&geometry->region);
    list_tiles(geometry);
    if (!dip_geometry_reserve(geometry, pass, err)) {
        return false;
    }
    number_patches(geometry);
    geometry->draws_in_view = geometry->draws_culled = 0;
    geometry->near_to_far = dip_draws_near_to_far(pass);
    if (geometry->near_to_far) {
        dip_order_draws(pass, geometry->draw_order, geometry->draw_keys);
    }
    geometry->visible_count =
        dip_cull_chunks(pass, geometry->near_to_far ? geometry->draw_order : NULL, pool,
                        geometry->visible, &geometry->draws_in_view, &geometry->draws_culled);
    cut_jobs(geometry);
    atomic_store_explicit(&geometry->triangles_taken, 0, memory_order_relaxed);
    atomic_store_explicit(&geometry->blocks_taken, 0, memory_order_relaxed);
    return true;
}

bool dip_geometry_grow_after_overflow(DipGeometry *geometry) {
    bool overflowed = false;
    for (int j = 0; j < geometry->job_count; j++) {
        overflowed |= geometry->jobs[j].overflowed;
    }
    // The slack grows by at least half of the current space for triangles.
    if (overflowed) {
        geometry->slack = geometry->slack * 2 + geometry->triangle_room / 2;
    }
    return overflowed;
}

void dip_geometry_free(DipGeometry *geometry) {
    dip_lines_free(geometry->first_patch);
    dip_lines_free(geometry->draw_order);
    dip_lines_free(geometry->draw_keys);
    dip_lines_free(geometry->visible);
    dip_lines_free(geometry->triangles);
    dip_lines_free(geometry->planes);
    dip_lines_free(geometry->blocks);
    dip_lines_free(geometry->bins);
    dip_lines_free(geometry->occupied);
    memset(geometry, 0, sizeof *geometry);
}
