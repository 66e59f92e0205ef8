// Triangles in one tile of a target whose last tiles are cut, for tests of the coverage kernels.
#ifndef DIP_TESTS_RENDERER_PIPELINE_COVER_TILE_H
#define DIP_TESTS_RENDERER_PIPELINE_COVER_TILE_H

#include "renderer/catalogue/oracle.h"
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/raster/tile.h"
#include "renderer/pipeline/raster/triangle.h"

// Returns the pixels of a random tile that lie in the target.
DipOracleRegion cover_random_tile(Random *random);

// Returns an empty tile. All tiles share their arrays, so only the last one may be used.
DipTile cover_tile(const DipSamplePattern *pattern, const DipOracleRegion *region);

// Sets up a triangle that has the depth z everywhere. Returns false if it is dropped or does not
// reach the tile whose pixels are `region`.
bool cover_set_up(const DipKernels *kernels, const DipSamplePattern *pattern,
                  const DipOracleTriangle *corners, float z, const DipOracleRegion *region,
                  DipTriangle *triangle);

#endif
