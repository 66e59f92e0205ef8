// Averages a picture to a smaller one with whole numbers as weights.
//
// Along an axis, let the sizes be `from` and `to`, divided by their greatest common divisor. In
// units of 1/to of a pixel of the larger picture, pixel x of the smaller picture reaches from x *
// from to (x + 1) * from, and pixel i of the larger one from i * to to (i + 1) * to. Their overlap
// is a whole number, and the overlaps of a pixel of the smaller picture add up to `from`.
#include "renderer/scene/draw/box.h"

#include <stdbool.h>
#include <string.h>

enum {
    CHUNK = 256, // pixels of a row of the smaller picture that are computed at once
    ROWS = 16,   // rows of the smaller picture in a job of the pool
    CHANNELS = 3,
    // Pixels of the larger picture that a chunk may read, and as many more as a pixel overlaps.
    CHUNK_FROM = CHUNK * DIP_BOX_MAX_RATIO + 2 + DIP_BOX_MAX_RATIO,
    TILE = DIP_TARGET_TILE,
    TILE_PIXELS = TILE * TILE
};

// The sizes along an axis, without their common divisor.
typedef struct Axis {
    int from;
    int to;
} Axis;

static Axis axis_of(int from, int to) {
    int a = from, b = to;
    while (b) {
        const int rest = a % b;
        a = b;
        b = rest;
    }
    return (Axis){from / a, to / a};
}

// Returns the first pixel of the larger picture that a pixel of the smaller one overlaps.
static int first_of(Axis axis, int at) {
    return at * axis.from / axis.to;
}

// Returns the pixel after the last one that a pixel of the smaller picture overlaps.
static int end_of(Axis axis, int at) {
    return ((at + 1) * axis.from + axis.to - 1) / axis.to;
}

static int overlap_of(Axis axis, int at, int i) {
    const int begin = at * axis.from > i * axis.to ? at * axis.from : i * axis.to;
    const int end =
        (at + 1) * axis.from < (i + 1) * axis.to ? (at + 1) * axis.from : (i + 1) * axis.to;
    return end - begin;
}

// Stores `count` pixels, whose light in channel c is light16[c][i].
static void store(const DipSrgbEncodeTable *srgb, uint32_t (*light16)[CHUNK], int count,
                  uint8_t *rgba8) {
    for (int i = 0; i < count; i++) {
        for (int c = 0; c < CHANNELS; c++) {
            rgba8[4 * i + c] = dip_srgb_code(srgb, (int32_t)light16[c][i]);
        }
        rgba8[4 * i + 3] = 255;
    }
}

// --- tiles ---------------------------------------------------------------------------------------

size_t dip_box_light_bytes(int from_width, int from_height, int width, int height) {
    const bool doubled = from_width == 2 * width && from_height == 2 * height;
    return doubled ? 0 : (size_t)from_width * (size_t)from_height * CHANNELS * sizeof(uint16_t);
}

// Averages the four pixels of each pixel of a tile of twice the size. Tiles begin at even pixels.
static void halve_tile(const DipBoxFilter *box, const DipTargetRegion *pixels,
                       const uint16_t *light16) {
    const int width = (pixels->x1 - pixels->x0) / 2;
    for (int y = pixels->y0 / 2; y < pixels->y1 / 2; y++) {
        uint32_t means[CHANNELS][CHUNK];
        for (int c = 0; c < CHANNELS; c++) {
            const uint16_t *upper = light16 + c * TILE_PIXELS + (2 * y - pixels->y0) * TILE;
            const uint16_t *lower = upper + TILE;
            for (int x = 0; x < width; x++) {
                const uint32_t sum =
                    (uint32_t)upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1];
                means[c][x] = (sum + 2) >> 2;
            }
        }
        store(box->srgb, means, width,
              box->to.rgba8 + (size_t)y * box->to.stride_bytes + (size_t)pixels->x0 * 2);
    }
}

// Copies the light of a tile to the light of the picture.
static void keep_tile(const DipBoxFilter *box, const DipTargetRegion *pixels,
                      const uint16_t *light16) {
    const size_t width = (size_t)box->from_width;
    const size_t plane = width * (size_t)box->from_height;
    const size_t bytes = (size_t)(pixels->x1 - pixels->x0) * sizeof *light16;
    for (size_t c = 0; c < CHANNELS; c++) {
        uint16_t *to = box->light16 + c * plane + (size_t)pixels->x0;
        const uint16_t *from = light16 + c * TILE_PIXELS;
        for (int y = pixels->y0; y < pixels->y1; y++, from += TILE) {
            memcpy(to + (size_t)y * width, from, bytes);
        }
    }
}

void dip_box_take_tile(void *context, const DipTargetRegion *pixels, const uint16_t *light16) {
    const DipBoxFilter *box = context;
    if (box->light16) {
        keep_tile(box, pixels, light16);
    } else {
        halve_tile(box, pixels, light16);
    }
}

// --- any ratio -----------------------------------------------------------------------------------

// What the pixels of a chunk read of a row of the larger picture.
typedef struct Taps {
    int first;     // the first pixel that the chunk reads
    int count;     // how many pixels it reads
    bool three;    // some pixel of the chunk overlaps three pixels, not only two
    int at[CHUNK]; // the first pixel that each pixel overlaps, relative to `first`
    double overlap[CHUNK][DIP_BOX_MAX_RATIO + 1]; // with each of the pixels from there on
} Taps;

static void find_taps(Axis axis, int x0, int x1, Taps *taps) {
    taps->first = first_of(axis, x0);
    taps->count = end_of(axis, x1 - 1) - taps->first;
    taps->three = false;
    for (int x = x0; x < x1; x++) {
        const int first = first_of(axis, x);
        const int count = end_of(axis, x) - first;
        taps->at[x - x0] = first - taps->first;
        taps->three = taps->three || count == 3;
        for (int i = 0; i <= DIP_BOX_MAX_RATIO; i++) {
            taps->overlap[x - x0][i] = i < count ? overlap_of(axis, x, first + i) : 0.0;
        }
    }
}

// Sums the rows of a channel that row y overlaps. Sums are below 2^29, since sizes are at most 2^13
// and lights 2^16. The pixels after the last one get 0.
static void sum_rows(const uint16_t *plane, size_t width, Axis axis, int y, const Taps *taps,
                     double sums[CHUNK_FROM]) {
    uint32_t whole[CHUNK_FROM];
    memset(whole, 0, (size_t)(taps->count + DIP_BOX_MAX_RATIO) * sizeof *whole);
    for (int row = first_of(axis, y); row < end_of(axis, y); row++) {
        const uint16_t weight = (uint16_t)overlap_of(axis, y, row);
        const uint16_t *light = plane + (size_t)row * width + (size_t)taps->first;
        for (int i = 0; i < taps->count; i++) {
            whole[i] += (uint32_t)weight * light[i];
        }
    }
    for (int i = 0; i < taps->count + DIP_BOX_MAX_RATIO; i++) {
        sums[i] = (int32_t)whole[i];
    }
}

// Computes the pixels x0 to x1 - 1 of row y. All sums are whole numbers below 2^43, which doubles
// hold exactly. A quotient, with the half that rounds it, is a whole number below 2^16 or at least
// 2^-27 away from one. The product with the inverse is off by at most 2^-35, so 2^-29 more takes
// whole quotients to their number and no other quotient to the next.
static void average(const DipBoxFilter *box, const Taps *taps, Axis across, Axis down, int y,
                    int x0, int x1) {
    const size_t width = (size_t)box->from_width;
    const size_t plane = width * (size_t)box->from_height;
    const double whole = (double)across.from * down.from;
    const double inverse = 1.0 / whole;
    uint32_t means[CHANNELS][CHUNK];
    for (size_t c = 0; c < CHANNELS; c++) {
        double sums[CHUNK_FROM];
        sum_rows(box->light16 + c * plane, width, down, y, taps, sums);
        for (int x = 0; x < x1 - x0; x++) {
            const double *sum = sums + taps->at[x];
            double mean = taps->overlap[x][0] * sum[0] + taps->overlap[x][1] * sum[1];
            if (taps->three) {
                mean += taps->overlap[x][2] * sum[2];
            }
            means[c][x] = (uint32_t)(int32_t)((mean + 0.5 * whole) * inverse + 0x1p-29);
        }
    }
    store(box->srgb, means, x1 - x0,
          box->to.rgba8 + (size_t)y * box->to.stride_bytes + (size_t)x0 * 4);
}

static void average_rows(void *context, int job, int worker) {
    (void)worker;
    const DipBoxFilter *box = context;
    const Axis across = axis_of(box->from_width, box->to.width);
    const Axis down = axis_of(box->from_height, box->to.height);
    const int end = (job + 1) * ROWS < box->to.height ? (job + 1) * ROWS : box->to.height;
    for (int x = 0; x < box->to.width; x += CHUNK) {
        const int x1 = x + CHUNK < box->to.width ? x + CHUNK : box->to.width;
        Taps taps;
        find_taps(across, x, x1, &taps);
        for (int y = job * ROWS; y < end; y++) {
            average(box, &taps, across, down, y, x, x1);
        }
    }
}

void dip_box_filter(const DipBoxFilter *box, DipPool *pool) {
    DipBoxFilter copy = *box;
    const int jobs = (box->to.height + ROWS - 1) / ROWS;
    if (box->light16) {
        dip_pool_run(pool, jobs, average_rows, &copy);
    }
}
