// Draws into memory. Blending works on 8-bit sRGB values, as desktops blend their windows.
#include "app/ui/canvas.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- rectangles and colours ----------------------------------------------------------------------

bool dip_rect_is_empty(DipRect rect) {
    return rect.width < 1 || rect.height < 1;
}

bool dip_rect_equals(DipRect a, DipRect b) {
    return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
}

bool dip_rect_holds(DipRect rect, int x, int y) {
    return x >= rect.x && x < rect.x + rect.width && y >= rect.y && y < rect.y + rect.height;
}

static DipRect from_corners(int left, int top, int right, int bottom) {
    return (DipRect){left, top, right - left, bottom - top};
}

DipRect dip_rect_intersect(DipRect a, DipRect b) {
    return from_corners(dip_max(a.x, b.x), dip_max(a.y, b.y), dip_min(a.x + a.width, b.x + b.width),
                        dip_min(a.y + a.height, b.y + b.height));
}

DipRect dip_rect_unite(DipRect a, DipRect b) {
    if (dip_rect_is_empty(a)) {
        return b;
    }
    if (dip_rect_is_empty(b)) {
        return a;
    }
    return from_corners(dip_min(a.x, b.x), dip_min(a.y, b.y), dip_max(a.x + a.width, b.x + b.width),
                        dip_max(a.y + a.height, b.y + b.height));
}

// --- the canvas ----------------------------------------------------------------------------------

bool dip_canvas_resize(DipCanvas *canvas, int width, int height, DipError *err) {
    if (!canvas->rgba8 || canvas->width != width || canvas->height != height) {
        dip_canvas_free(canvas);
        canvas->rgba8 = malloc(4 * (size_t)width * (size_t)height);
        if (!canvas->rgba8) {
            return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "canvas", "out of memory");
        }
        canvas->width = width;
        canvas->height = height;
    }
    canvas->clip = (DipRect){0, 0, width, height};
    return true;
}

void dip_canvas_free(DipCanvas *canvas) {
    free(canvas->rgba8);
    *canvas = (DipCanvas){0};
}

void dip_canvas_set_clip(DipCanvas *canvas, DipRect clip) {
    canvas->clip = dip_rect_intersect(clip, (DipRect){0, 0, canvas->width, canvas->height});
}

DipPixels dip_canvas_pixels(const DipCanvas *canvas) {
    return (DipPixels){canvas->rgba8, 4 * (size_t)canvas->width, canvas->width, canvas->height};
}

static uint8_t *pixel_at(const DipCanvas *canvas, int x, int y) {
    return canvas->rgba8 + 4 * ((size_t)y * (size_t)canvas->width + (size_t)x);
}

// Returns value / 255, rounded exactly, for a value of at most 255 * 255.
static unsigned divide_by_255(unsigned value) {
    return (value + 128 + ((value + 128) >> 8)) >> 8;
}

static void blend_pixel(uint8_t *pixel, DipColour colour, unsigned alpha) {
    pixel[0] = (uint8_t)divide_by_255(pixel[0] * (255 - alpha) + colour.red * alpha);
    pixel[1] = (uint8_t)divide_by_255(pixel[1] * (255 - alpha) + colour.green * alpha);
    pixel[2] = (uint8_t)divide_by_255(pixel[2] * (255 - alpha) + colour.blue * alpha);
    pixel[3] = 255;
}

enum { BLOCK_BYTES = 16 };

// Blends blocks of four pixels. Each byte becomes (byte * rest + colour * alpha) / 255, rounded
// exactly, where `rest` is 255 - alpha. `share` is colour * alpha + 128; divide_by_255 adds
// the same 128. No sum is greater than 65407, so compilers can turn the loop into 16-bit vector
// code.
static void blend_blocks(uint8_t *restrict bytes, size_t block_count,
                         const uint16_t share[BLOCK_BYTES], uint16_t rest) {
    for (size_t i = 0; i < block_count; ++i) {
        uint8_t *block = bytes + BLOCK_BYTES * i;
        for (int j = 0; j < BLOCK_BYTES; ++j) {
            const uint16_t sum = (uint16_t)(block[j] * rest + share[j]);
            block[j] = (uint8_t)((uint16_t)(sum + (sum >> 8)) >> 8);
        }
    }
}

// Blends a colour over a row of pixels. The pixels' alpha is blended with 255, so it stays 255.
static void blend_row(uint8_t *row, int count, DipColour colour) {
    const unsigned bytes[4] = {colour.red, colour.green, colour.blue, 255};
    const size_t block_count = (size_t)count / (BLOCK_BYTES / 4);
    uint16_t share[BLOCK_BYTES];
    for (int j = 0; j < BLOCK_BYTES; ++j) {
        share[j] = (uint16_t)(bytes[j % 4] * colour.alpha + 128);
    }
    blend_blocks(row, block_count, share, (uint16_t)(255 - colour.alpha));
    for (int i = (int)block_count * (BLOCK_BYTES / 4); i < count; ++i) {
        blend_pixel(row + 4 * i, colour, colour.alpha);
    }
}

void dip_canvas_fill(DipCanvas *canvas, DipRect rect, DipColour colour) {
    const DipRect inside = dip_rect_intersect(rect, canvas->clip);
    if (dip_rect_is_empty(inside)) {
        return;
    }
    for (int y = inside.y; y < inside.y + inside.height; ++y) {
        blend_row(pixel_at(canvas, inside.x, y), inside.width, colour);
    }
}

// Returns how much of the pixel x, y lies in a rectangle of the given size with rounded corners, 0
// to 1. The edge of a corner is smoothed by the distance of the pixel's centre from the edge.
static double round_coverage(int x, int y, int width, int height, int radius) {
    if (x < 0 || y < 0 || x >= width || y >= height) {
        return 0.0;
    }
    const double dx = fmax(fmax(radius - (x + 0.5), x + 0.5 - (width - radius)), 0.0);
    const double dy = fmax(fmax(radius - (y + 0.5), y + 0.5 - (height - radius)), 0.0);
    if (dx == 0.0 || dy == 0.0) {
        return 1.0;
    }
    return fmin(fmax(radius + 0.5 - sqrt(dx * dx + dy * dy), 0.0), 1.0);
}

// A rectangle with rounded corners, filled (ring = 0) or as an outline of `ring` pixels.
typedef struct RoundRect {
    DipRect rect;
    int radius;
    int ring;
    DipColour colour;
} RoundRect;

// Blends the pixels [from, to) of the row y by their coverage.
static void blend_edge(DipCanvas *canvas, const RoundRect *shape, int y, int from, int to) {
    const DipRect *rect = &shape->rect;
    const int ring = shape->ring;
    for (int x = from; x < to; ++x) {
        const int px = x - rect->x, py = y - rect->y;
        double coverage = round_coverage(px, py, rect->width, rect->height, shape->radius);
        if (ring > 0) {
            coverage -= round_coverage(px - ring, py - ring, rect->width - 2 * ring,
                                       rect->height - 2 * ring, dip_max(shape->radius - ring, 0));
        }
        if (coverage > 0.0) {
            blend_pixel(pixel_at(canvas, x, y), shape->colour,
                        (unsigned)(coverage * shape->colour.alpha + 0.5));
        }
    }
}

// Blends the row y between the corners, where pixels are covered wholly or not at all.
static void blend_middle(DipCanvas *canvas, const RoundRect *shape, int y, int from, int to) {
    const int py = y - shape->rect.y;
    const bool covered =
        shape->ring == 0 || py < shape->ring || py >= shape->rect.height - shape->ring;
    if (covered && to > from) {
        blend_row(pixel_at(canvas, from, y), to - from, shape->colour);
    }
}

void dip_canvas_round(DipCanvas *canvas, DipRect rect, int radius, int ring, DipColour colour) {
    const DipRect inside = dip_rect_intersect(rect, canvas->clip);
    if (dip_rect_is_empty(inside)) {
        return;
    }
    radius = dip_min(dip_max(radius, 0), dip_min(rect.width, rect.height) / 2);
    const RoundRect shape = {rect, radius, ring, colour};
    const int right = inside.x + inside.width;
    const int edge = dip_max(radius, ring); // Columns at each side in which coverage may vary.
    const int middle = dip_min(dip_max(rect.x + edge, inside.x), right);
    const int middle_end = dip_max(dip_min(rect.x + rect.width - edge, right), middle);
    for (int y = inside.y; y < inside.y + inside.height; ++y) {
        blend_edge(canvas, &shape, y, inside.x, middle);
        blend_middle(canvas, &shape, y, middle, middle_end);
        blend_edge(canvas, &shape, y, middle_end, right);
    }
}

// Scales a row by repeating or leaving out whole pixels.
static void copy_scaled_row(uint8_t *to, const uint8_t *from, int first, int count, int to_width,
                            int from_width) {
    for (int i = 0; i < count; ++i) {
        const int64_t x = (2 * (int64_t)(first + i) + 1) * from_width / (2 * (int64_t)to_width);
        memcpy(to + 4 * i, from + 4 * x, 4);
    }
}

void dip_canvas_copy(DipCanvas *canvas, DipRect rect, const DipPixels *picture) {
    const DipRect inside = dip_rect_intersect(rect, canvas->clip);
    if (dip_rect_is_empty(inside) || picture->width < 1 || picture->height < 1) {
        return;
    }
    const int first = inside.x - rect.x;
    for (int y = inside.y; y < inside.y + inside.height; ++y) {
        const int64_t from_y =
            (2 * (int64_t)(y - rect.y) + 1) * picture->height / (2 * (int64_t)rect.height);
        const uint8_t *from = picture->rgba8 + (size_t)from_y * picture->stride_bytes;
        uint8_t *to = pixel_at(canvas, inside.x, y);
        if (picture->width == rect.width) {
            memcpy(to, from + 4 * (size_t)first, 4 * (size_t)inside.width);
        } else {
            copy_scaled_row(to, from, first, inside.width, rect.width, picture->width);
        }
    }
}

void dip_canvas_mask(DipCanvas *canvas, int x, int y, int width, int height, const uint8_t *mask,
                     DipColour colour) {
    const DipRect inside = dip_rect_intersect((DipRect){x, y, width, height}, canvas->clip);
    for (int row = 0; row < inside.height && inside.width > 0; ++row) {
        const uint8_t *from = mask + (size_t)(inside.y + row - y) * (size_t)width + (inside.x - x);
        uint8_t *to = pixel_at(canvas, inside.x, inside.y + row);
        for (int i = 0; i < inside.width; ++i) {
            if (from[i]) {
                blend_pixel(to + 4 * i, colour, divide_by_255(from[i] * (unsigned)colour.alpha));
            }
        }
    }
}
