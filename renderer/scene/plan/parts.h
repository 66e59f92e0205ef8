// The parts of a picture's tiles that triangles and boxes in the world can touch.
#ifndef DIP_RENDERER_SCENE_PLAN_PARTS_H
#define DIP_RENDERER_SCENE_PLAN_PARTS_H

#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/draw/view.h"

// Of a picture; `tiles` has one part per tile, row by row.
typedef struct DipParts {
    DipTileRegion *tiles;
    int width; // pixels
    int height;
    int margin; // pixels to each side of a shape that count too
} DipParts;

// Empties all tiles.
void dip_parts_clear(const DipParts *parts);

// Each takes in the whole blocks of what a shape beyond the near plane can touch. A tile's part is
// one rectangle.
void dip_parts_add_triangle(const DipParts *parts, const DipView *view, const double corners[3][3]);
void dip_parts_add_box(const DipParts *parts, const DipView *view, const double corners[8][3]);

#endif
