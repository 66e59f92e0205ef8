// Sets up single triangles for the tiles of a target of 171x122 pixels.
#include "tests/renderer/pipeline/cover_tile.h"

#include "renderer/pipeline/geometry/setup.h"

enum {
    TARGET_WIDTH = 3 * DIP_TILE - 21, // not a multiple of the tile size
    TARGET_HEIGHT = 2 * DIP_TILE - 6,
};

DipOracleRegion cover_random_tile(Random *random) {
    DipOracleRegion region = {random_int(random, 0, 2) * DIP_TILE,
                              random_int(random, 0, 1) * DIP_TILE, DIP_TILE, DIP_TILE};
    if (region.x0 + region.width > TARGET_WIDTH) {
        region.width = TARGET_WIDTH - region.x0;
    }
    if (region.y0 + region.height > TARGET_HEIGHT) {
        region.height = TARGET_HEIGHT - region.y0;
    }
    return region;
}

DipTile cover_tile(const DipSamplePattern *pattern, const DipOracleRegion *region) {
    // Laid out as the pipeline does.
    static _Alignas(64) float depth[DIP_BLOCKS * DIP_BLOCK_PIXELS * DIP_MAX_SAMPLES];
    static _Alignas(64) uint32_t ids[DIP_BLOCKS * DIP_BLOCK_PIXELS * DIP_MAX_SAMPLES];
    return (DipTile){
        .x0 = region->x0, .y0 = region->y0, .pattern = pattern, .depth = depth, .id = ids};
}

// Makes the target for set-up. Fills `samples` with the pattern's sample positions; the target
// points to them.
static DipSetupTarget target_of(const DipSamplePattern *pattern, DipSamplePositions *samples) {
    samples->count = 0;
    dip_sample_positions_add(samples, pattern);
    DipSetupTarget target = {.width = TARGET_WIDTH,
                             .height = TARGET_HEIGHT,
                             .region_last = {TARGET_WIDTH - 1, TARGET_HEIGHT - 1},
                             .plane_stride = DIP_PLANES_ALIGN,
                             .samples = samples,
                             .cull = DIP_CULL_NONE,
                             .sample_min = {255, 255}};
    for (int s = 0; s < pattern->count; s++) {
        const uint8_t at[2] = {pattern->x[s], pattern->y[s]};
        for (int i = 0; i < 2; i++) {
            target.sample_min[i] = at[i] < target.sample_min[i] ? at[i] : target.sample_min[i];
            target.sample_max[i] = at[i] > target.sample_max[i] ? at[i] : target.sample_max[i];
        }
    }
    return target;
}

// Returns true if the triangle's box of pixels overlaps the tile. The pipeline gives a tile only
// such triangles.
static bool meets(const DipTriangle *triangle, const DipOracleRegion *region) {
    return triangle->x0 < region->x0 + region->width && triangle->x1 >= region->x0 &&
           triangle->y0 < region->y0 + region->height && triangle->y1 >= region->y0;
}

bool cover_set_up(const DipKernels *kernels, const DipSamplePattern *pattern,
                  const DipOracleTriangle *corners, float z, const DipOracleRegion *region,
                  DipTriangle *triangle) {
    static DipScreenBatch screen;
    static uint8_t corner[3][DIP_BATCH_ALIGN];
    for (int i = 0; i < 3; i++) {
        screen.x[i] = corners->x[i];
        screen.y[i] = corners->y[i];
        screen.z[i] = z;
        screen.rw[i] = 1.0f;
        corner[i][0] = (uint8_t)i;
    }
    const uint32_t patch[DIP_BATCH_ALIGN] = {0};
    const DipSetupBatch batch = {
        .count = 1, .corner = {corner[0], corner[1], corner[2]}, .patch = patch, .screen = &screen};
    DipSamplePositions samples;
    const DipSetupTarget target = target_of(pattern, &samples);
    DipTriangle kept[1 + DIP_SETUP_EXCESS];
    float planes[(1 + DIP_SETUP_EXCESS) * DIP_PLANES_ALIGN];
    if (!kernels->dip_kernel_setup(&target, &batch, kept, planes)) {
        return false;
    }
    *triangle = kept[0];
    return meets(triangle, region);
}
