// Visits a tile's triangles in drawing order (geometry.h), from the bins of all jobs.
#ifndef DIP_RENDERER_PIPELINE_GEOMETRY_VISIT_H
#define DIP_RENDERER_PIPELINE_GEOMETRY_VISIT_H

#include "renderer/pipeline/geometry/geometry.h"

typedef void DipVisitTriangle(void *context, uint32_t triangle);

// Calls triangle(context, index) for each triangle that may cover samples of a tile. tile:
// 0..dip_geometry_tiles - 1. All jobs must have run. Any number of threads may visit tiles at once.
void dip_geometry_visit(const DipGeometry *geometry, int tile, DipVisitTriangle *triangle,
                        void *context);

#endif
