// The part of the picture that boxes and triangles in the world can touch.
#ifndef DIP_RENDERER_SCENE_PLAN_EXTENT_H
#define DIP_RENDERER_SCENE_PLAN_EXTENT_H

#include "renderer/pipeline/mesh.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/draw/view.h"

#include <stdbool.h>

// In x / w and y / w, up positive, within -1..1; empty where min > max.
typedef struct DipExtent {
    double min[2];
    double max[2];
} DipExtent;

DipExtent dip_extent_none(void);

// A point of the world in clip space: x, y and w.
void dip_extent_project(const DipView *view, const double world[3], double clip[3]);

// Each takes in what of a shape lies beyond the near plane and in the picture's rectangle.
void dip_extent_add_box(DipExtent *extent, const DipView *view, const double corners[8][3]);
void dip_extent_add_triangle(DipExtent *extent, const DipView *view, const double corners[3][3]);

// A placed box' corners in the world; corner bit k: the far end of axis k.
void dip_extent_box_corners(const float transform[12], const DipBox *box, double corners[8][3]);

// The pixels of a picture of that size which the extent touches, and `margin` more to each side.
// False where there are none.
bool dip_extent_region(const DipExtent *extent, int width, int height, int margin,
                       DipTargetRegion *region);

#endif
