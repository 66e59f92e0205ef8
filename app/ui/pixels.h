// Defines rectangles, colours and read-only pictures, which both the canvas and displays use.
#ifndef DIP_APP_UI_PIXELS_H
#define DIP_APP_UI_PIXELS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// A rectangle in pixels. x grows to the right and y downwards. A width or height below 1 makes the
// rectangle empty.
typedef struct DipRect {
    int x;
    int y;
    int width;
    int height;
} DipRect;

// A colour in 8-bit sRGB. Alpha 255 is opaque; red, green and blue are not multiplied by alpha.
typedef struct DipColour {
    uint8_t red;
    uint8_t green;
    uint8_t blue;
    uint8_t alpha;
} DipColour;

// A borrowed picture: 8-bit sRGB, four bytes per pixel (red, green, blue, alpha), the top row
// first.
typedef struct DipPixels {
    const uint8_t *rgba8;
    size_t stride_bytes; // Bytes from one row to the next.
    int width;
    int height;
} DipPixels;

static inline int dip_min(int a, int b) {
    return a < b ? a : b;
}

static inline int dip_max(int a, int b) {
    return a > b ? a : b;
}

// Returns the part of a picture that lies in a rectangle of its pixels.
static inline DipPixels dip_pixels_part(const DipPixels *picture, DipRect rect) {
    const size_t offset = (size_t)rect.y * picture->stride_bytes + 4 * (size_t)rect.x;
    const DipPixels part = {picture->rgba8 + offset, picture->stride_bytes, rect.width,
                            rect.height};
    return part;
}

// Returns the rectangle of the pixels that lie in both rectangles; it may be empty.
DipRect dip_rect_intersect(DipRect a, DipRect b);

// Returns the smallest rectangle that holds both rectangles. If one is empty, returns the other.
DipRect dip_rect_unite(DipRect a, DipRect b);

bool dip_rect_is_empty(DipRect rect);
bool dip_rect_equals(DipRect a, DipRect b);

// Returns whether a pixel lies in the rectangle.
bool dip_rect_holds(DipRect rect, int x, int y);

#endif
