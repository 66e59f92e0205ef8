// The geometry phase: meshes to set-up triangles, binned to tiles.
//
// The chunks of a pass are cut into a fixed number of jobs, whatever the number of threads. Each
// job owns a run of the triangle, surface and bin arrays, so jobs never wait for each other, and
// tiles read the jobs in order, which is submission order.
#ifndef DIP_RENDERER_GEOMETRY_GEOMETRY_H
#define DIP_RENDERER_GEOMETRY_GEOMETRY_H

#include "renderer/geometry/project.h"
#include "renderer/geometry/triangle.h"
#include "renderer/pipeline.h"
#include "renderer/raster/pattern.h"

#include <stdbool.h>
#include <stdint.h>

enum {
    DIP_MAX_JOBS = 64,
    DIP_MAX_BIN_TILES = 16, // a triangle in more tiles goes to its job's list of wide ones
};

#define DIP_BIN_END 0xffffffffu // no entry

// One triangle in one tile's list.
typedef struct DipBinEntry {
    uint32_t triangle;
    uint32_t next; // index of the next entry of the tile, or DIP_BIN_END
} DipBinEntry;

typedef struct DipTileBin {
    uint32_t first;
    uint32_t last;
} DipTileBin;

typedef struct DipGeometryJob {
    uint32_t first_chunk; // of the pass' chunks
    uint32_t chunk_count;
    uint32_t first_triangle; // of the geometry's arrays
    uint32_t triangle_count;
    uint32_t triangle_room;
    uint32_t entry_count; // entries start at first_triangle * DIP_MAX_BIN_TILES
    uint32_t wide_count;  // wide triangles start at first_triangle
    bool overflowed;      // clipping made more triangles than there was room for
    uint64_t triangles_in;
    uint64_t tile_triangles;
} DipGeometryJob;

// All arrays grow when a pass needs more than any before it, never within a frame otherwise.
typedef struct DipGeometry {
    const DipPass *pass;
    DipScreenMapping mapping;
    const DipSamplePattern *pattern;
    int tiles_x;
    int tiles_y;
    int surface_stride; // floats per triangle: that of the pass' largest slot count
    int job_count;
    DipGeometryJob jobs[DIP_MAX_JOBS];
    uint32_t room;       // triangles
    size_t surface_room; // floats
    uint32_t clip_slack; // triangles a job may make beyond those it reads
    DipTriangle *triangles;
    float *surfaces;
    uint32_t *wide;
    DipBinEntry *entries;
    DipTileBin *bins;           // [job][tile]
    uint32_t *draw_first_chunk; // per draw, and one past the last
    int draw_room;
} DipGeometry;

typedef struct DipKernels DipKernels;

// What one worker needs to run a job.
typedef struct DipGeometryScratch {
    float clip[4][DIP_VERTEX_BATCH];
    float slot[DIP_MAX_SLOTS][DIP_VERTEX_BATCH];
    DipScreenBatch screen;
} DipGeometryScratch;

// Cuts the pass into jobs and makes room for it.
bool dip_geometry_begin(DipGeometry *geometry, const DipPass *pass, DipError *err);

// Runs one job; any thread.
void dip_geometry_run_job(DipGeometry *geometry, const DipKernels *kernels, int job,
                          DipGeometryScratch *scratch);

// After all jobs: true when some overflowed; then the slack has grown and the pass must begin
// again.
bool dip_geometry_grow_after_overflow(DipGeometry *geometry);

void dip_geometry_free(DipGeometry *geometry);

#endif
