// Draws fills, pictures and masks into a picture in memory.
//
// Displays (app/display/) show finished pixels and draw nothing. The preview draws the same pixels
// for every display, for a screenshot and for a test.
#ifndef DIP_APP_UI_CANVAS_H
#define DIP_APP_UI_CANVAS_H

#include "app/ui/pixels.h"
#include "renderer/base/error.h"

// Rows are packed. Every pixel is opaque. Zero-initialise a canvas; dip_canvas_resize allocates its
// memory.
typedef struct DipCanvas {
    uint8_t *rgba8; // Owned.
    int width;
    int height;
    DipRect clip; // Drawing leaves pixels outside this rectangle as they are.
} DipCanvas;

// Changes the size and sets the clip rectangle to the whole canvas. The pixels are undefined
// afterwards unless the size stays the same. On failure (MEMORY) the canvas is empty.
bool dip_canvas_resize(DipCanvas *canvas, int width, int height, DipError *err);
void dip_canvas_free(DipCanvas *canvas);

// Limits drawing to the part of a rectangle that lies within the canvas.
void dip_canvas_set_clip(DipCanvas *canvas, DipRect clip);

// Returns the canvas as a picture, which is valid until the canvas is resized or freed.
DipPixels dip_canvas_pixels(const DipCanvas *canvas);

// Blends a colour over a rectangle by the colour's alpha.
void dip_canvas_fill(DipCanvas *canvas, DipRect rect, DipColour colour);

// Blends a colour over a rectangle with rounded corners and a smoothed edge. `radius` is in pixels
// and is limited to half of the shorter side. `ring` is the width of an outline inside the
// rectangle, or 0 to fill it.
void dip_canvas_round(DipCanvas *canvas, DipRect rect, int radius, int ring, DipColour colour);

// Copies an opaque picture into a rectangle, without blending. If the sizes differ, the
// picture is scaled to the rectangle: each pixel shows the nearest pixel of the picture.
void dip_canvas_copy(DipCanvas *canvas, DipRect rect, const DipPixels *picture);

// Blends a colour through a mask whose top left pixel lies at x, y. Each byte of the mask is a
// coverage from 0 to 255, which multiplies the colour's alpha.
void dip_canvas_mask(DipCanvas *canvas, int x, int y, int width, int height, const uint8_t *mask,
                     DipColour colour);

#endif
