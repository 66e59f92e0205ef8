// Walks the bins of a tile.
#include "renderer/pipeline/geometry/visit.h"

// A walk prefetches this many triangles ahead, at most DIP_BIN_BLOCK. Drawing this many takes about
// as long as a read from memory.
enum { PREFETCH_AHEAD = 6 };

// The state of a walk along a bin's triangles.
typedef struct BinWalk {
    const DipBinBlock *block;
    const DipBinBlock *last;
    uint32_t entry;
    uint32_t count; // number of triangles in the current block
    uint32_t last_count;
} BinWalk;

static BinWalk walk_bin(const DipGeometry *geometry, const DipTileBin *bin) {
    if (!bin) {
        return (BinWalk){0};
    }
    BinWalk walk = {.block = geometry->blocks + bin->first,
                    .last = geometry->blocks + bin->last,
                    .last_count = bin->last_count};
    walk.count = walk.block == walk.last ? walk.last_count : DIP_BIN_BLOCK;
    return walk;
}

static void prefetch(const DipTriangle *triangle) {
    __builtin_prefetch(triangle);
    __builtin_prefetch((const char *)(triangle + 1) - 1);
}

// Returns the next triangle's index and advances the walk. Returns DIP_NO_TRIANGLE at the end.
static uint32_t next_of(const DipGeometry *geometry, BinWalk *walk) {
    if (walk->entry == walk->count) {
        if (walk->block == walk->last) {
            return DIP_NO_TRIANGLE;
        }
        walk->block = geometry->blocks + walk->block->next;
        walk->entry = 0;
        walk->count = walk->block == walk->last ? walk->last_count : DIP_BIN_BLOCK;
        if (walk->block != walk->last) {
            __builtin_prefetch(&geometry->blocks[walk->block->next]);
        }
    }
    // The triangle to prefetch may be in the next block.
    const uint32_t ahead = walk->entry + PREFETCH_AHEAD;
    if (ahead < walk->count) {
        prefetch(&geometry->triangles[walk->block->triangle[ahead]]);
    } else if (walk->block != walk->last) {
        const DipBinBlock *next = &geometry->blocks[walk->block->next];
        if (next != walk->last || ahead - DIP_BIN_BLOCK < walk->last_count) {
            prefetch(&geometry->triangles[next->triangle[ahead - DIP_BIN_BLOCK]]);
        }
    }
    return walk->block->triangle[walk->entry++];
}

// Walks along the triangles of one job that may lie in the tile: the tile's bin and the wide
// triangles (triangles that touch more than DIP_MAX_BIN_TILES tiles).
typedef struct JobWalks {
    BinWalk bin;
    BinWalk wide;
} JobWalks;

// Finds the jobs that have triangles in the tile's bin or wide triangles. Keeps the order of the
// jobs and returns their number. It prefetches the bins of all jobs and then their first blocks, so
// that the reads from other cores' caches overlap.
static int find_jobs(const DipGeometry *geometry, size_t tile, JobWalks *found) {
    const DipTileBin *bins[DIP_MAX_JOBS][2];
    int count = 0;
    for (int j = 0; j < geometry->job_count; j++) {
        bins[count][0] = dip_geometry_bin(geometry, j, tile);
        bins[count][1] = dip_geometry_bin(geometry, j, dip_geometry_tiles(geometry));
        for (int i = 0; i < 2 && bins[count][i]; i++) {
            __builtin_prefetch(bins[count][i]);
        }
        count += bins[count][0] || bins[count][1];
    }
    for (int i = 0; i < count; i++) {
        found[i] = (JobWalks){walk_bin(geometry, bins[i][0]), walk_bin(geometry, bins[i][1])};
        __builtin_prefetch(found[i].bin.block);
    }
    return count;
}

static void prefetch_first(const DipGeometry *geometry, const BinWalk *walk) {
    for (uint32_t i = 0; i < PREFETCH_AHEAD && i < walk->count; i++) {
        prefetch(&geometry->triangles[walk->block->triangle[i]]);
    }
}

// A tile, and the function to call for its triangles.
typedef struct Visit {
    const DipGeometry *geometry;
    int x0, y0; // column and row, in the target, of the tile's first pixel
    DipVisitTriangle *triangle;
    void *context;
} Visit;

static bool in_tile(const Visit *visit, const DipTriangle *triangle) {
    return triangle->x0 < visit->x0 + DIP_TILE && triangle->x1 >= visit->x0 &&
           triangle->y0 < visit->y0 + DIP_TILE && triangle->y1 >= visit->y0;
}

// Visits one job's triangles in the tile. The function merges the tile's bin and the wide triangles
// by index. The triangles are therefore visited in drawing order.
static void visit_job(const Visit *visit, JobWalks *job) {
    const DipGeometry *geometry = visit->geometry;
    uint32_t next = next_of(geometry, &job->bin);
    uint32_t wide = next_of(geometry, &job->wide);
    while (next != DIP_NO_TRIANGLE || wide != DIP_NO_TRIANGLE) {
        if (next < wide) {
            visit->triangle(visit->context, next);
            next = next_of(geometry, &job->bin);
        } else {
            if (in_tile(visit, &geometry->triangles[wide])) {
                visit->triangle(visit->context, wide);
            }
            wide = next_of(geometry, &job->wide);
        }
    }
}

void dip_geometry_visit(const DipGeometry *geometry, int tile, DipVisitTriangle *triangle,
                        void *context) {
    const Visit visit = {geometry, tile % geometry->tiles_x * DIP_TILE,
                         tile / geometry->tiles_x * DIP_TILE, triangle, context};
    JobWalks jobs[DIP_MAX_JOBS];
    const int count = find_jobs(geometry, (size_t)tile, jobs);
    for (int i = 0; i < count; i++) {
        if (i + 1 < count) {
            prefetch_first(geometry, &jobs[i + 1].bin);
        }
        visit_job(&visit, &jobs[i]);
    }
}
