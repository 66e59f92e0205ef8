// The geometry phase: meshes to set-up triangles, binned to tiles.
//
// The chunks of a pass that may be in view are cut into a fixed number of jobs, whatever the number
// of threads. Jobs take room for their triangles from shared arrays by runs, without locks; within
// a job, a triangle's index rises with submission order. Tiles read the jobs in order, which is
// submission order too.
#ifndef DIP_RENDERER_PIPELINE_GEOMETRY_GEOMETRY_H
#define DIP_RENDERER_PIPELINE_GEOMETRY_GEOMETRY_H

#include "renderer/pipeline/geometry/project.h"
#include "renderer/pipeline/geometry/setup.h"
#include "renderer/pipeline/geometry/triangle.h"
#include "renderer/pipeline/pattern.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/pipeline/raster/tile.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

enum {
    DIP_MAX_JOBS = 64,
    DIP_MAX_BIN_TILES = 16, // a triangle in more tiles goes to its job's list of wide ones
    DIP_BIN_BLOCK = 15,     // entries
    DIP_MAX_BINS = DIP_MAX_TARGET_SIZE / DIP_TILE * (DIP_MAX_TARGET_SIZE / DIP_TILE) + 1,
    DIP_BIN_WORDS = (DIP_MAX_BINS + 63) / 64,
};

#define DIP_NO_TRIANGLE 0xffffffffu // beyond every index

// A cache line of a bin's list.
typedef struct DipBinBlock {
    uint32_t triangle[DIP_BIN_BLOCK]; // in rising order
    uint32_t next;                    // index of the next block, unless this is the last
} DipBinBlock;

// One job's triangles in one tile.
typedef struct DipTileBin {
    uint32_t first; // block
    uint32_t last;
    uint32_t last_count; // entries of the last block; the others are full
} DipTileBin;

typedef struct DipVisibleChunk {
    uint32_t draw;
    uint32_t chunk; // of the draw's mesh
} DipVisibleChunk;

// Written once, at the end of a job.
typedef struct DipGeometryJob {
    uint32_t first_chunk; // of the visible ones
    uint32_t chunk_count;
    bool overflowed; // there was not enough room
    uint64_t triangles_in;
    uint64_t triangles_drawn;
    uint64_t tile_triangles;
} DipGeometryJob;

// All arrays grow when a pass needs more than any before it, never within a frame otherwise. They
// have room for all triangles of the pass, but what is not in view is not written, so its pages
// cost no memory.
typedef struct DipGeometry {
    const DipPass *pass;
    DipScreenMapping mapping;
    DipSamplePositions samples; // those of all passes that are drawn from this geometry
    int tiles_x;
    int tiles_y;
    DipTargetRegion region;       // pixels that are drawn, see dip_drawn_region
    DipTargetRegion tile_region;  // tiles that these lie in
    int tile_count;               // to be drawn
    uint16_t tiles[DIP_MAX_BINS]; // which, in the order of drawing: y * tiles_x + x
    int plane_stride;             // floats per triangle: that of the pass' largest varying count
    int job_count;
    DipGeometryJob jobs[DIP_MAX_JOBS];
    uint32_t visible_count;
    uint32_t visible_room;
    uint32_t triangle_room;
    uint32_t block_room;
    size_t plane_room; // floats
    uint32_t draw_room;
    uint32_t slack;        // triangles beyond those of the meshes, and blocks; grows with overflows
    uint32_t *first_patch; // of each draw: the number of its mesh's patch 0
    DipVisibleChunk *visible;
    DipTriangle *triangles;
    float *planes;
    DipBinBlock *blocks;
    DipTileBin *bins;   // [job][tile], the job's wide triangles last
    uint64_t *occupied; // [tile / 64][job]: bit tile % 64 is set where the bin is not empty
    atomic_uint triangles_taken;
    atomic_uint blocks_taken;
} DipGeometry;

typedef struct DipKernels DipKernels;

// What one worker needs to run a job.
typedef struct DipGeometryScratch {
    float clip[4][DIP_VERTEX_BATCH];
    float varying[DIP_MAX_VARYINGS][DIP_VERTEX_BATCH];
    DipScreenBatch screen;
    uint64_t occupied[DIP_BIN_WORDS];
} DipGeometryScratch;

static inline size_t dip_geometry_tiles(const DipGeometry *geometry) {
    return (size_t)geometry->tiles_x * (size_t)geometry->tiles_y;
}

// The job's triangles of a bin, NULL where there is none. Bin dip_geometry_tiles: the wide ones.
static inline const DipTileBin *dip_geometry_bin(const DipGeometry *geometry, int job, size_t bin) {
    const uint64_t word = geometry->occupied[bin / 64 * DIP_MAX_JOBS + (size_t)job];
    return word >> bin % 64 & 1
               ? &geometry->bins[(size_t)job * (dip_geometry_tiles(geometry) + 1) + bin]
               : NULL;
}

// Makes room for the pass.
bool dip_geometry_reserve(DipGeometry *geometry, const DipPass *pass, DipError *err);

// Finds the chunks in view of the first pass, cuts them into jobs and makes room for its triangles.
// The other passes are drawn from the same geometry: they differ in samples and shading alone.
// pass_count: 1..DIP_MAX_PASSES_AT_ONCE.
bool dip_geometry_begin(DipGeometry *geometry, const DipPass *const *passes, int pass_count,
                        DipError *err);

// Runs one job; any thread.
void dip_geometry_run_job(DipGeometry *geometry, const DipKernels *kernels, int job,
                          DipGeometryScratch *scratch);

// After all jobs: true when some overflowed; then the slack has grown and the pass must begin
// again.
bool dip_geometry_grow_after_overflow(DipGeometry *geometry);

void dip_geometry_free(DipGeometry *geometry);

#endif
