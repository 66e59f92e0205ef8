// Enlarges pictures bilinearly, in bands of rows on the pool's threads.
#include "app/bench/enlarge.h"

#include "renderer/base/srgb.h"

#include <math.h>
#include <stdlib.h>

enum { BAND_ROWS = 16 };

static int divisor(int a, int b) {
    while (b != 0) {
        const int rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

static int scaled(int size, double scale) {
    const int rounded = (int)(size * scale + 0.5);
    return rounded > 0 ? rounded : 1;
}

void dip_enlarger_source_size(int width, int height, double scale, int *to_width, int *to_height) {
    // The number of sizes up to width x height that have exactly this aspect ratio.
    const int steps = divisor(width, height);
    const int step = scaled(steps, scale);
    *to_width = width / steps * step;
    *to_height = height / steps * step;
    if (fabs(*to_width - scale * width) > 0.02 * scale * width) {
        *to_width = scaled(width, scale);
        *to_height = scaled(height, scale);
    }
}

// Where a pixel of the destination lies between two pixels of the source.
typedef struct Place {
    int first;
    int next;
    float weight; // Weight of pixel `next`, 0..1. Pixel `first` has the rest.
} Place;

struct DipEnlarger {
    DipEnlargerDef def;
    Place *across; // [to_width]
    Place *down;   // [to_height]
    float *rows;   // [worker][2][4 * to_width]: widened rows of the source, in linear light.
    uint8_t *rgba8;
    const uint8_t *from; // The picture that is being enlarged.
    size_t from_stride_bytes;
    float light[256]; // Linear light of each code, 0..DIP_LINEAR16_MAX.
    DipSrgbEncodeTable codes;
};

// Fills in the places of `to` destination pixels in a row or column of `from` source pixels. Pixel
// i of the destination lies at ((2 * i + 1) * from - to) / (2 * to) in the source. All but the last
// division is computed in whole numbers.
static void find_places(int from, int to, Place *places) {
    for (int i = 0; i < to; i++) {
        const int64_t numerator = (2 * (int64_t)i + 1) * from - to;
        const int64_t denominator = 2 * (int64_t)to;
        const int first = numerator < 0 ? 0 : (int)(numerator / denominator);
        places[i] = (Place){
            .first = first,
            .next = first + 1 < from ? first + 1 : first,
            .weight = numerator < 0
                          ? 0.0f
                          : (float)((double)(numerator % denominator) / (double)denominator),
        };
    }
}

DipEnlarger *dip_enlarger_create(const DipEnlargerDef *def, DipError *err) {
    DipEnlarger *e = calloc(1, sizeof *e);
    const size_t width = (size_t)def->to_width, height = (size_t)def->to_height;
    const size_t workers = def->pool ? (size_t)dip_pool_thread_count(def->pool) : 1;
    if (e) {
        e->def = *def;
        e->across = malloc(width * sizeof *e->across);
        e->down = malloc(height * sizeof *e->down);
        e->rows = malloc(workers * 8 * width * sizeof *e->rows);
        e->rgba8 = malloc(4 * width * height);
    }
    if (!e || !e->across || !e->down || !e->rows || !e->rgba8) {
        dip_enlarger_destroy(&e);
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "bench", "out of memory");
        return NULL;
    }
    DipSrgbDecodeTable table;
    dip_srgb_decode_table(&table);
    dip_srgb_encode_table(&e->codes);
    for (int code = 0; code < 256; code++) {
        e->light[code] = (float)(DIP_LINEAR16_MAX * table.linear[code]);
    }
    find_places(def->from_width, def->to_width, e->across);
    find_places(def->from_height, def->to_height, e->down);
    return e;
}

void dip_enlarger_destroy(DipEnlarger **enlarger) {
    DipEnlarger *e = *enlarger;
    if (e) {
        free(e->across);
        free(e->down);
        free(e->rows);
        free(e->rgba8);
        free(e);
        *enlarger = NULL;
    }
}

static void widen_row(const DipEnlarger *e, int row, float *to) {
    const uint8_t *from = e->from + (size_t)row * e->from_stride_bytes;
    for (int x = 0; x < e->def.to_width; x++, to += 4) {
        const Place *place = &e->across[x];
        const uint8_t *first = from + 4 * (size_t)place->first;
        const uint8_t *next = from + 4 * (size_t)place->next;
        for (int c = 0; c < 3; c++) {
            const float light = e->light[first[c]];
            to[c] = light + place->weight * (e->light[next[c]] - light);
        }
        to[3] = first[3] + place->weight * (float)(next[3] - first[3]);
    }
}

static void blend_rows(const DipEnlarger *e, const float *a, const float *b, float weight,
                       uint8_t *to) {
    for (int x = 0; x < e->def.to_width; x++, a += 4, b += 4, to += 4) {
        for (int c = 0; c < 3; c++) {
            to[c] = e->codes.code[(int)(a[c] + weight * (b[c] - a[c]) + 0.5f)];
        }
        to[3] = (uint8_t)(a[3] + weight * (b[3] - a[3]) + 0.5f);
    }
}

// Enlarges BAND_ROWS rows. Neighbouring rows of the destination mostly need the same two rows of
// the source, so the last two widened rows are kept: an even row in slot 0, an odd one in slot 1.
static void enlarge_band(void *context, int band, int worker) {
    DipEnlarger *e = context;
    const size_t width = (size_t)e->def.to_width;
    float *slots = e->rows + (size_t)worker * 8 * width;
    int kept[2] = {-1, -1};
    for (int y = band * BAND_ROWS; y < (band + 1) * BAND_ROWS && y < e->def.to_height; y++) {
        const Place *place = &e->down[y];
        const int needed[2] = {place->first, place->next};
        for (int i = 0; i < 2; i++) {
            const int slot = needed[i] % 2;
            if (kept[slot] != needed[i]) {
                widen_row(e, needed[i], slots + (size_t)slot * 4 * width);
                kept[slot] = needed[i];
            }
        }
        blend_rows(e, slots + (size_t)(needed[0] % 2) * 4 * width,
                   slots + (size_t)(needed[1] % 2) * 4 * width, place->weight,
                   e->rgba8 + (size_t)y * 4 * width);
    }
}

const uint8_t *dip_enlarger_run(DipEnlarger *e, const uint8_t *rgba8, size_t stride_bytes) {
    e->from = rgba8;
    e->from_stride_bytes = stride_bytes;
    dip_pool_run(e->def.pool, (e->def.to_height + BAND_ROWS - 1) / BAND_ROWS, enlarge_band, e);
    return e->rgba8;
}
