// Cuts blocks out of two pictures and compares them.
#include "app/preview/live/error_blocks.h"

#include "app/measure/metrics/flip.h"

#include <string.h>

enum { BLOCK = 96 }; // Side of a block without its margin, pixels.

typedef struct Rect {
    int x;
    int y;
    int width;
    int height;
} Rect;

static int larger(int a, int b) {
    return a > b ? a : b;
}

static int smaller(int a, int b) {
    return a < b ? a : b;
}

static int margin_px(void) {
    return dip_flip_reach_px(DIP_FLIP_PIXELS_PER_DEGREE);
}

static int across(int size) {
    return (size + BLOCK - 1) / BLOCK;
}

int dip_error_block_count(int width, int height) {
    return across(width) * across(height);
}

size_t dip_error_block_values(void) {
    const size_t side = (size_t)(BLOCK + 2 * margin_px());
    return side * side;
}

static Rect block_of(const DipSrgbPicture *picture, int block) {
    const int x = block % across(picture->width) * BLOCK;
    const int y = block / across(picture->width) * BLOCK;
    return (Rect){x, y, smaller(BLOCK, picture->width - x), smaller(BLOCK, picture->height - y)};
}

static Rect with_margin(const DipSrgbPicture *picture, const Rect *block) {
    const int margin = margin_px();
    const int left = larger(0, block->x - margin), top = larger(0, block->y - margin);
    return (Rect){left, top, smaller(picture->width, block->x + block->width + margin) - left,
                  smaller(picture->height, block->y + block->height + margin) - top};
}

static DipSrgbPicture cut_out(const DipSrgbPicture *picture, const Rect *rect) {
    const size_t offset = (size_t)rect->y * picture->stride_bytes + 4 * (size_t)rect->x;
    return (DipSrgbPicture){picture->rgba8 + offset, picture->stride_bytes, rect->width,
                            rect->height};
}

// Adds the values of the block's own pixels, without its margin.
static void add_values(const float *map, const Rect *whole, const Rect *block, DipMapSum *sum) {
    for (int y = block->y; y < block->y + block->height; y++) {
        const float *from =
            map + (size_t)(y - whole->y) * (size_t)whole->width + (block->x - whole->x);
        const DipMapSum row = dip_map_sum(from, (size_t)block->width, (DipPixelMask){0});
        sum->sum += row.sum;
        sum->pixel_count += row.pixel_count;
    }
}

// Copies the values of the block's own pixels into a map of the whole picture, `width` pixels wide.
static void store_values(const float *from, const Rect *whole, const Rect *block, int width,
                         float *map) {
    for (int y = block->y; y < block->y + block->height; y++) {
        memcpy(map + (size_t)y * (size_t)width + (size_t)block->x,
               from + (size_t)(y - whole->y) * (size_t)whole->width + (block->x - whole->x),
               (size_t)block->width * sizeof *map);
    }
}

bool dip_error_block_add(const DipSrgbPicture *test, const DipSrgbPicture *truth, int block,
                         float *scratch, float *map, DipMapSum *sum) {
    const Rect own = block_of(test, block);
    const Rect whole = with_margin(test, &own);
    const DipSrgbPicture test_part = cut_out(test, &whole), truth_part = cut_out(truth, &whole);
    DipFlip flip = {0};
    DipFlipAnalysis sides[2] = {0};
    const bool made = dip_flip_init(&flip, whole.width, whole.height, DIP_FLIP_PIXELS_PER_DEGREE) &&
                      dip_flip_analysis_init(&flip, &sides[0]) &&
                      dip_flip_analysis_init(&flip, &sides[1]);
    if (made) {
        dip_flip_analyse(&flip, &test_part, &sides[0]);
        dip_flip_analyse(&flip, &truth_part, &sides[1]);
        dip_flip_compare(&flip, &sides[0], &sides[1], scratch);
        add_values(scratch, &whole, &own, sum);
        if (map) {
            store_values(scratch, &whole, &own, test->width, map);
        }
    }
    dip_flip_analysis_free(&sides[0]);
    dip_flip_analysis_free(&sides[1]);
    dip_flip_free(&flip);
    return made;
}
