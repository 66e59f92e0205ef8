// Averages a picture to a smaller one with whole numbers as weights.
//
// Along an axis, let the sizes be `from` and `to`, divided by their greatest common divisor. In
// units of 1/to of a pixel of the larger picture, pixel x of the smaller picture reaches from x *
// from to (x + 1) * from, and pixel i of the larger one from i * to to (i + 1) * to. Their overlap
// is a whole number, and the overlaps of a pixel of the smaller picture add up to `from`.
#include "renderer/scene/draw/box.h"

#include "renderer/base/srgb.h"

#include <stdbool.h>

enum {
    CHUNK = 64,   // pixels of a row of the smaller picture that are computed at once
    ROWS = 8,     // rows of the smaller picture in a job of the pool
    CHANNELS = 4, // numbers per pixel of the larger picture
    CHUNK_FROM = CHUNK * DIP_BOX_MAX_RATIO + 2 // pixels of the larger picture that a chunk reads
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

static void store(const DipBoxFilter *box, uint8_t *pixel, const uint32_t light16[3]) {
    for (int c = 0; c < 3; c++) {
        pixel[c] = box->srgb_code[light16[c]];
    }
    pixel[3] = 255;
}

// --- light of codes ------------------------------------------------------------------------------

typedef struct Decoding {
    const DipTarget *picture;
    uint16_t *light16;
    uint16_t light16_of[256];
} Decoding;

static void decode_rows(void *context, int job, int worker) {
    (void)worker;
    const Decoding *decoding = context;
    const DipTarget *picture = decoding->picture;
    const int end = (job + 1) * ROWS < picture->height ? (job + 1) * ROWS : picture->height;
    for (int y = job * ROWS; y < end; y++) {
        const uint8_t *from = picture->rgba8 + (size_t)y * picture->stride_bytes;
        uint16_t *to = decoding->light16 + (size_t)y * (size_t)picture->width * CHANNELS;
        for (int i = 0; i < picture->width * CHANNELS; i++) {
            to[i] = decoding->light16_of[from[i]];
        }
    }
}

void dip_box_decode(const DipTarget *picture, uint16_t *light16, DipPool *pool) {
    Decoding decoding = {.picture = picture, .light16 = light16};
    DipSrgbDecodeTable table;
    dip_srgb_decode_table(&table);
    for (int code = 0; code < 256; code++) {
        decoding.light16_of[code] = (uint16_t)(DIP_LINEAR16_MAX * table.linear[code] + 0.5);
    }
    dip_pool_run(pool, (picture->height + ROWS - 1) / ROWS, decode_rows, &decoding);
}

// --- any ratio -----------------------------------------------------------------------------------

// Sums the rows that row y overlaps, in the columns x0 to x1 - 1 of the larger picture. Sums are
// below 2^29, since sizes are at most 2^13 and lights 2^16.
static void sum_rows(const DipBoxFilter *box, Axis axis, int y, int x0, int x1,
                     uint32_t sums[CHUNK_FROM * CHANNELS]) {
    const int count = (x1 - x0) * CHANNELS;
    for (int i = 0; i < count; i++) {
        sums[i] = 0;
    }
    for (int row = first_of(axis, y); row < end_of(axis, y); row++) {
        const uint32_t weight = (uint32_t)overlap_of(axis, y, row);
        const uint16_t *light = box->light16 + (size_t)row * box->stride + (size_t)x0 * CHANNELS;
        for (int i = 0; i < count; i++) {
            sums[i] += weight * light[i];
        }
    }
}

// The pixels of a row of the larger picture that a pixel of the smaller one overlaps.
typedef struct Taps {
    int first;
    int count;
    double overlap[DIP_BOX_MAX_RATIO + 1];
} Taps;

static void find_taps(Axis axis, int x0, int x1, Taps taps[CHUNK]) {
    for (int x = x0; x < x1; x++) {
        Taps *own = &taps[x - x0];
        own->first = first_of(axis, x);
        own->count = end_of(axis, x) - own->first;
        for (int i = 0; i < own->count; i++) {
            own->overlap[i] = overlap_of(axis, x, own->first + i);
        }
    }
}

// Computes the pixels x0 to x1 - 1 of row y. All sums are whole numbers below 2^43, which doubles
// hold exactly. A quotient, with the half that rounds it, is a whole number below 2^16 or at least
// 2^-27 away from one. The product with the inverse is off by at most 2^-35, so 2^-29 more takes
// whole quotients to their number and no other quotient to the next.
static void average_any(const DipBoxFilter *box, const Taps taps[CHUNK], Axis across, Axis down,
                        int y, int x0, int x1) {
    uint32_t sums[CHUNK_FROM * CHANNELS];
    const int first = taps[0].first;
    const double whole = (double)across.from * down.from;
    const double inverse = 1.0 / whole;
    uint8_t *pixel = box->rgba8 + (size_t)y * box->stride_bytes + (size_t)x0 * 4;
    sum_rows(box, down, y, first, end_of(across, x1 - 1), sums);
    for (int x = x0; x < x1; x++, pixel += 4) {
        const Taps *own = &taps[x - x0];
        double mean[3] = {0.0, 0.0, 0.0};
        uint32_t light16[3];
        for (int i = 0; i < own->count; i++) {
            const uint32_t *sum = sums + (own->first - first + i) * CHANNELS;
            for (int c = 0; c < 3; c++) {
                mean[c] += own->overlap[i] * (double)sum[c];
            }
        }
        for (int c = 0; c < 3; c++) {
            light16[c] = (uint32_t)((mean[c] + 0.5 * whole) * inverse + 0x1p-29);
        }
        store(box, pixel, light16);
    }
}

// --- the ratio 2 ---------------------------------------------------------------------------------

static void average_four(const DipBoxFilter *box, int y, int x0, int x1) {
    const uint16_t *upper =
        box->light16 + (size_t)(2 * y) * box->stride + (size_t)(2 * x0) * CHANNELS;
    const uint16_t *lower = upper + box->stride;
    uint8_t *pixel = box->rgba8 + (size_t)y * box->stride_bytes + (size_t)x0 * 4;
    for (int x = x0; x < x1; x++, pixel += 4, upper += 2 * CHANNELS, lower += 2 * CHANNELS) {
        uint32_t light16[3];
        for (int c = 0; c < 3; c++) {
            light16[c] =
                ((uint32_t)upper[c] + upper[CHANNELS + c] + lower[c] + lower[CHANNELS + c] + 2) >>
                2;
        }
        store(box, pixel, light16);
    }
}

// --- rows ----------------------------------------------------------------------------------------

static void average_rows(void *context, int job, int worker) {
    (void)worker;
    const DipBoxFilter *box = context;
    const Axis across = axis_of(box->from_width, box->width);
    const Axis down = axis_of(box->from_height, box->height);
    const bool doubled = across.from == 2 && across.to == 1 && down.from == 2 && down.to == 1;
    const int end = (job + 1) * ROWS < box->height ? (job + 1) * ROWS : box->height;
    for (int x = 0; x < box->width; x += CHUNK) {
        const int x1 = x + CHUNK < box->width ? x + CHUNK : box->width;
        Taps taps[CHUNK];
        find_taps(across, x, x1, taps);
        for (int y = job * ROWS; y < end; y++) {
            if (doubled) {
                average_four(box, y, x, x1);
            } else {
                average_any(box, taps, across, down, y, x, x1);
            }
        }
    }
}

void dip_box_filter(const DipBoxFilter *box, DipPool *pool) {
    DipBoxFilter copy = *box;
    const int jobs = (box->height + ROWS - 1) / ROWS;
    dip_pool_run(pool, jobs, average_rows, &copy);
}
