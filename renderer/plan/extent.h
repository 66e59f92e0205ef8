// The part of the picture that boxes in the world can touch.
#ifndef DIP_RENDERER_PLAN_EXTENT_H
#define DIP_RENDERER_PLAN_EXTENT_H

#include "renderer/geometry/mesh.h"
#include "renderer/geometry/view.h"
#include "renderer/pipeline.h"

#include <stdbool.h>

// In x / w and y / w, up positive; empty where min > max.
typedef struct DipExtent {
    double min[2];
    double max[2];
} DipExtent;

DipExtent dip_extent_none(void);

// Takes in the part of a placed box that lies beyond the near plane.
void dip_extent_add(DipExtent *extent, const DipView *view, const float transform[12],
                    const DipBox *box);

// World y of a placed box' lowest corner.
double dip_extent_lowest(const float transform[12], const DipBox *box);

// The pixels of a picture of that size which the extent touches, and `margin` more to each side.
// False where there are none.
bool dip_extent_region(const DipExtent *extent, int width, int height, int margin,
                       DipRegion *region);

#endif
