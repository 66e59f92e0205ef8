// The geometry stage: turns meshes into set-up triangles and sorts them into bins, which are
// lists per tile.
//
// The chunks of a pass that may be in view are divided into jobs. The number of jobs does not
// depend on the number of threads. A job takes space for its triangles from shared arrays without
// locks, in runs of many triangles at a time. Within a job, the indices of triangles increase in
// drawing order, which is submission order or near to far (order.h). Each tile reads the jobs in
// order, so it gets all triangles in drawing order.
#ifndef DIP_RENDERER_PIPELINE_GEOMETRY_GEOMETRY_H
#define DIP_RENDERER_PIPELINE_GEOMETRY_GEOMETRY_H

#include "renderer/pipeline/geometry/project.h"
#include "renderer/pipeline/geometry/setup.h"
#include "renderer/pipeline/raster/triangle.h"
#include "renderer/pipeline/pattern.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/pipeline/raster/tile.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

enum {
    DIP_MAX_JOBS = 64,
    // Most tiles that a binned triangle may touch. A triangle that touches more tiles goes to its
    // job's bin of wide triangles.
    DIP_MAX_BIN_TILES = 16,
    DIP_BIN_BLOCK = 15,      // number of triangles in a block
    DIP_TRIANGLE_RUN = 1024, // number of triangles for which a job takes space at a time
    DIP_BLOCK_RUN = 32,      // number of bin blocks that a job takes at a time
    // Number of bins of a job: one for each tile of the largest target, and one for wide triangles.
    DIP_MAX_BINS = DIP_MAX_TARGET_SIZE / DIP_TILE * (DIP_MAX_TARGET_SIZE / DIP_TILE) + 1,
    DIP_BIN_WORDS = (DIP_MAX_BINS + 63) / 64, // number of 64-bit words that hold one bit per bin
};

#define DIP_NO_TRIANGLE 0xffffffffu // greater than any triangle's index

// A block of a bin's list. It fills one cache line.
typedef struct DipBinBlock {
    uint32_t triangle[DIP_BIN_BLOCK]; // indices of triangles, in increasing order
    uint32_t next;                    // index of the list's next block; undefined in the last block
} DipBinBlock;

// The triangles of one job in one tile, as a list of blocks.
typedef struct DipTileBin {
    uint32_t first;      // index of the first block
    uint32_t last;       // index of the last block
    uint32_t last_count; // triangles in the last block; the other blocks are full
} DipTileBin;

// A chunk that may be in view.
typedef struct DipVisibleChunk {
    uint32_t draw;  // index into the pass's draws
    uint32_t chunk; // index into the chunks of the draw's mesh
} DipVisibleChunk;

// A job: the visible chunks that it draws, and its result. The job writes its result once, at its
// end.
typedef struct DipGeometryJob {
    uint32_t first_chunk; // index into the visible chunks
    uint32_t chunk_count;
    bool overflowed; // a shared array did not have enough space
    uint64_t triangles_in;
    uint64_t triangles_drawn;
    uint64_t tile_triangles;
} DipGeometryJob;

// What the geometry stage of a pass produces. The arrays grow if a pass needs more than any pass
// before; otherwise drawing allocates nothing. The arrays have space for all triangles of the pass.
// Only the triangles in view are written, so pages for the others cost no memory.
typedef struct DipGeometry {
    const DipPass *pass;
    DipScreenMapping mapping;
    DipSamplePositions samples; // samples of all passes that are drawn from this geometry
    int tiles_x;
    int tiles_y;
    DipTargetRegion region;       // the pixels to draw, see dip_drawn_region
    DipTargetRegion tile_region;  // the tiles that hold these pixels, counted in tiles
    int tile_count;               // number of tiles to draw
    uint16_t tiles[DIP_MAX_BINS]; // tiles to draw, in drawing order: y * tiles_x + x
    uint64_t draws_in_view;
    uint64_t draws_culled;
    int plane_stride; // floats per triangle, for the pass's largest varying_count
    int job_count;
    DipGeometryJob jobs[DIP_MAX_JOBS];
    // Number of visible chunks, and the lengths of the arrays below.
    uint32_t visible_count;
    uint32_t visible_room;
    uint32_t triangle_room;
    uint32_t block_room;
    size_t plane_room; // number of floats
    uint32_t draw_room;
    // Number of triangles for which the arrays have space beyond the triangles of the meshes,
    // because clipping adds triangles. The slack becomes larger after an overflow. The space for
    // bin blocks grows with the slack.
    uint32_t slack;
    // For each draw: the number of its mesh's patch 0 among the patches of all draws.
    uint32_t *first_patch;
    bool near_to_far;     // the draws go through the pipeline in `draw_order` (order.h)
    uint32_t *draw_order; // one per draw
    uint16_t *draw_keys;  // one per draw, used while sorting
    DipVisibleChunk *visible;
    DipTriangle *triangles;
    float *planes;
    DipBinBlock *blocks;
    DipTileBin *bins;   // [job][tile]; each job's bin of wide triangles is its last
    uint64_t *occupied; // [bin / 64][job]: bit bin % 64 is set if the job's bin is not empty
    atomic_uint triangles_taken; // number of triangles for which jobs have taken space
    atomic_uint blocks_taken;    // number of blocks that jobs have taken
} DipGeometry;

typedef struct DipKernels DipKernels;

// Working memory that a worker needs to run jobs.
typedef struct DipGeometryScratch {
    float clip[4][DIP_VERTEX_BATCH];
    float varying[DIP_MAX_VARYINGS][DIP_VERTEX_BATCH];
    DipScreenBatch screen;
    uint64_t occupied[DIP_BIN_WORDS];
    // The space for triangles that the worker's jobs of this pass have taken and not used. Both
    // must be 0 before its first job.
    uint32_t next_triangle;
    uint32_t triangle_end;
} DipGeometryScratch;

// Returns the number of tiles of the target.
static inline size_t dip_geometry_tiles(const DipGeometry *geometry) {
    return (size_t)geometry->tiles_x * (size_t)geometry->tiles_y;
}

// Whether the pass draws anything of a tile: y * tiles_x + x.
static inline bool dip_geometry_needs_tile(const DipGeometry *geometry, size_t tile) {
    const DipTileRegion *parts = geometry->pass->tile_regions;
    return !parts || parts[tile].x1;
}

// Returns one of a job's bins, or NULL if it is empty. Bins 0..dip_geometry_tiles - 1 belong to the
// tiles; bin dip_geometry_tiles holds the wide triangles.
static inline const DipTileBin *dip_geometry_bin(const DipGeometry *geometry, int job, size_t bin) {
    const uint64_t word = geometry->occupied[bin / 64 * DIP_MAX_JOBS + (size_t)job];
    return word >> bin % 64 & 1
               ? &geometry->bins[(size_t)job * (dip_geometry_tiles(geometry) + 1) + bin]
               : NULL;
}

// Makes the arrays large enough for a pass. Fails with OVERSIZED or MEMORY.
bool dip_geometry_reserve(DipGeometry *geometry, const DipPass *pass, DipError *err);

// Finds the chunks in view of the first pass, on the threads of a pool (NULL: the caller's thread),
// divides them into jobs, and makes the arrays large enough. The other passes are drawn from the
// same geometry, so they may differ from the first pass only in samples and shading.
// pass_count: 1..DIP_MAX_PASSES_AT_ONCE. Fails with OVERSIZED or MEMORY.
bool dip_geometry_begin(DipGeometry *geometry, const DipPass *const *passes, int pass_count,
                        DipPool *pool, DipError *err);

// Runs one job. Threads may run different jobs at the same time.
void dip_geometry_run_job(DipGeometry *geometry, const DipKernels *kernels, int job,
                          DipGeometryScratch *scratch);

// Call this after all jobs have run. Returns true if a job ran out of space. The slack has then
// grown, and the caller must start the stage again with dip_geometry_begin.
bool dip_geometry_grow_after_overflow(DipGeometry *geometry);

// Frees all arrays and sets *geometry to zero.
void dip_geometry_free(DipGeometry *geometry);

#endif
