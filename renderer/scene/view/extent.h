// The part of the picture that boxes and triangles in the world can touch.
#ifndef DIP_RENDERER_SCENE_VIEW_EXTENT_H
#define DIP_RENDERER_SCENE_VIEW_EXTENT_H

#include "renderer/pipeline/mesh.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/view/view.h"

#include <stdbool.h>

// A rectangle in normalised device coordinates: x / w and y / w, +y up, within -1..1. It is empty
// if min > max.
typedef struct DipExtent {
    double min[2];
    double max[2];
} DipExtent;

DipExtent dip_extent_none(void); // the empty extent

// Projects a world point to clip space: x, y and w.
void dip_extent_project(const DipView *view, const double world[3], double clip[3]);

// Each function extends the rectangle until it contains the part of a shape that lies beyond the
// near plane and within the picture. Corners are in world space. The corners of a box have the
// order of dip_extent_box_corners.
void dip_extent_add_box(DipExtent *extent, const DipView *view, const double corners[8][3]);
void dip_extent_add_triangle(DipExtent *extent, const DipView *view, const double corners[3][3]);

// Computes the corners of an object's box in world space. Bit k of a corner's index tells at which
// end of axis k the corner lies: 0 the low end, 1 the high end.
void dip_extent_box_corners(const float transform[12], const DipBox *box, double corners[8][3]);

// Finds the pixels that an extent touches in a picture of width x height pixels, and `margin` more
// pixels on each side. Returns false if there are none in the picture.
bool dip_extent_region(const DipExtent *extent, int width, int height, int margin,
                       DipTargetRegion *region);

#endif
