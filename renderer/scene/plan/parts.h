// Finds each tile's part: the rectangle of the tile that triangles and boxes in the world can
// touch. Only this rectangle must be drawn.
#ifndef DIP_RENDERER_SCENE_PLAN_PARTS_H
#define DIP_RENDERER_SCENE_PLAN_PARTS_H

#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/view/view.h"

typedef struct DipParts {
    DipTileRegion *tiles; // one per tile of the picture, row by row
    int width;            // width of the picture, in pixels
    int height;           // height of the picture, in pixels
    int margin;           // pixels by which each shape is enlarged on every side
} DipParts;

// Makes the parts of all tiles empty.
void dip_parts_clear(const DipParts *parts);

// Each function extends the parts by all blocks of 8x8 pixels that a shape can touch beyond the
// near plane. Each tile's part remains one rectangle. Corners are in world space.
void dip_parts_add_triangle(const DipParts *parts, const DipView *view, const double corners[3][3]);
void dip_parts_add_box(const DipParts *parts, const DipView *view, const double corners[8][3]);

#endif
