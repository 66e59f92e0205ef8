// Enlarging. The centre of pixel i of the result lies at (i + 1/2) * from / to - 1/2 in the source,
// counted in pixels from the centre of its first pixel; the ratio is exact for each axis.
#include "renderer/base/srgb.h"
#include "renderer/post/filters/filter.h"

#include <string.h>

// Rows of the source that a band of the result needs: the band's own, and those around it.
enum { WINDOW_ROWS = DIP_POST_BAND + 4 };

enum { PADDING = 16 }; // values after an array that vectors read

// --- places --------------------------------------------------------------------------------------

static DipPostPlaces take_places(DipPostArena *arena, int count) {
    DipPostPlaces places;
    places.first = dip_post_take(arena, (size_t)count + PADDING, sizeof *places.first);
    places.part = dip_post_take(arena, (size_t)count + PADDING, sizeof *places.part);
    return places;
}

// Beyond the end, a vector reads the last place again.
static void fill_places(const DipPostPlaces *places, int from, int to) {
    for (int i = 0; i < to + PADDING; i++) {
        // The place is numerator / (2 * to).
        const int64_t pixel = i < to ? i : to - 1;
        const int64_t numerator = (2 * pixel + 1) * from - to;
        const int64_t divisor = 2 * (int64_t)to;
        const int64_t whole = (numerator + divisor) / divisor - 1; // rounds down from -1 on
        places->first[i] = (int32_t)whole;
        places->part[i] = (float)((double)(numerator - whole * divisor) / (double)divisor);
    }
}

// Returns the windows of one kind for all workers.
static DipPostWindow *take_windows(DipPost *post, DipPostArena *arena, int width) {
    DipPostWindow *windows = dip_post_take(arena, (size_t)post->worker_count, sizeof *windows);
    for (int w = 0; w < post->worker_count; w++) {
        const DipPostWindow window = dip_post_take_window(arena, width, WINDOW_ROWS);
        if (windows) {
            windows[w] = window;
        }
    }
    return windows;
}

static void take_common(DipPost *post, DipPostArena *arena) {
    dip_post_take_channels(post, arena, WINDOW_ROWS);
    post->places_x = take_places(arena, post->def.to_width);
    post->places_y = take_places(arena, post->def.to_height);
}

static void prepare_common(DipPost *post) {
    fill_places(&post->places_x, post->def.from_width, post->def.to_width);
    fill_places(&post->places_y, post->def.from_height, post->def.to_height);
}

// The rows of a band of the result, and the rows of the source from which they come.
typedef struct Band {
    int begin;
    int end;
    int source_begin;
    int source_end;
} Band;

static Band band_of(const DipPost *post, int band) {
    Band b = {.begin = band * DIP_POST_BAND, .end = (band + 1) * DIP_POST_BAND};
    b.end = b.end < post->def.to_height ? b.end : post->def.to_height;
    b.source_begin = post->places_y.first[b.begin] - 1;
    b.source_end = post->places_y.first[b.end - 1] + 3;
    return b;
}

// --- separable filters ---------------------------------------------------------------------------

static bool is_bicubic(const DipPost *post) {
    return post->def.filter == DIP_POST_BICUBIC;
}

static void take_separable(DipPost *post, DipPostArena *arena) {
    const int taps = is_bicubic(post) ? 4 : 2;
    take_common(post, arena);
    for (int c = 0; c < 3; c++) {
        post->spread[c] = take_windows(post, arena, post->def.to_width);
    }
    for (int t = 0; t < taps; t++) {
        post->weights_x[t] =
            dip_post_take(arena, (size_t)post->def.to_width + PADDING, sizeof(float));
        post->weights_y[t] = dip_post_take(arena, (size_t)post->def.to_height, sizeof(float));
    }
    post->light = dip_post_take(arena, 256, sizeof *post->light);
    post->srgb = dip_post_take(arena, 1, sizeof(DipSrgbEncodeTable));
}

// Weight of a pixel at a distance of `t` pixels, for a Catmull-Rom spline.
static double cubic(double t) {
    return t < 1.0 ? (1.5 * t - 2.5) * t * t + 1.0 : ((-0.5 * t + 2.5) * t - 4.0) * t + 2.0;
}

static void fill_weights(const DipPost *post, const DipPostPlaces *places, int count,
                         float *const weights[4]) {
    for (int i = 0; i < count; i++) {
        const double part = (double)places->part[i];
        if (is_bicubic(post)) {
            weights[0][i] = (float)cubic(1.0 + part);
            weights[1][i] = (float)cubic(part);
            weights[2][i] = (float)cubic(1.0 - part);
            weights[3][i] = (float)cubic(2.0 - part);
        } else {
            weights[0][i] = (float)(1.0 - part);
            weights[1][i] = (float)part;
        }
    }
}

static void prepare_separable(DipPost *post) {
    DipSrgbDecodeTable decode;
    prepare_common(post);
    fill_weights(post, &post->places_x, post->def.to_width, post->weights_x);
    fill_weights(post, &post->places_y, post->def.to_height, post->weights_y);
    dip_srgb_decode_table(&decode);
    for (int i = 0; i < 256; i++) {
        post->light[i] = (float)decode.linear[i];
    }
    dip_srgb_encode_table(post->srgb);
}

// Unpacks a row of the source and spreads it along x.
static void spread_row(DipPost *post, int worker, int slot, int y) {
    const int taps = is_bicubic(post) ? 4 : 2;
    dip_post_unpack(post, worker, slot, y, true);
    for (int c = 0; c < 3; c++) {
        DipSpreadRow row = {
            // The first of four taps lies one pixel before the place.
            .row = dip_post_window_row(&post->channels[c][worker], slot) - (taps == 4),
            .first = post->places_x.first,
            .taps = taps,
            .to = dip_post_window_row(&post->spread[c][worker], slot),
            .width = post->def.to_width,
        };
        memcpy(row.weights, post->weights_x, sizeof row.weights);
        post->kernels->dip_kernel_spread_row(&row);
    }
}

static void blend_row(DipPost *post, int worker, const Band *band, int y) {
    const int taps = is_bicubic(post) ? 4 : 2;
    const int slot = post->places_y.first[y] - band->source_begin;
    DipBlendRow row = {
        .taps = taps,
        .first = post->places_x.first,
        .srgb = post->srgb,
        .to = post->to + (size_t)y * post->to_stride_bytes,
        .width = post->def.to_width,
    };
    for (int t = 0; t < taps; t++) {
        row.weights[t] = post->weights_y[t][y];
        for (int c = 0; c < 3; c++) {
            const int from = slot + t - (taps == 4);
            row.rows[t][c] = dip_post_window_row(&post->spread[c][worker], from);
        }
    }
    for (int c = 0; c < 3; c++) {
        row.nearest[0][c] = dip_post_window_row(&post->channels[c][worker], slot);
        row.nearest[1][c] = dip_post_window_row(&post->channels[c][worker], slot + 1);
    }
    post->kernels->dip_kernel_blend_row(&row);
}

static void enlarge_band(void *context, int number, int worker) {
    DipPost *post = context;
    const Band band = band_of(post, number);
    for (int y = band.source_begin; y < band.source_end; y++) {
        spread_row(post, worker, y - band.source_begin, y);
    }
    for (int y = band.begin; y < band.end; y++) {
        blend_row(post, worker, &band, y);
    }
}

static void run_separable(DipPost *post) {
    dip_post_run_bands(post, post->def.to_height, enlarge_band);
}

const DipPostKind dip_post_separable = {take_separable, prepare_separable, run_separable};

// --- EASU ----------------------------------------------------------------------------------------

// Twice the luma of FSR 1.
static const float luma_weights[3] = {0.5f, 1.0f, 0.5f};

static void take_easu(DipPost *post, DipPostArena *arena) {
    take_common(post, arena);
    post->lumas = take_windows(post, arena, post->def.from_width);
    for (int i = 0; i < 3; i++) {
        post->shapes[i] = take_windows(post, arena, post->def.from_width);
    }
}

static void unpack_with_luma(DipPost *post, int worker, int slot, int y) {
    float *luma = dip_post_window_row(&post->lumas[worker], slot);
    dip_post_unpack(post, worker, slot, y, false);
    post->kernels->dip_kernel_post_luma(dip_post_row(post, y), post->def.from_width, luma_weights,
                                        luma);
    luma = dip_post_window_row(&post->lumas[worker], slot);
    dip_post_extend_row(luma, post->def.from_width);
}

// Finds the shape of a row, and of one pixel before and after it.
static void find_shape(DipPost *post, int worker, int slot) {
    const DipEasuShape shape = {
        .luma = dip_post_window_row(&post->lumas[worker], slot) - 1,
        .luma_stride = post->lumas[worker].stride,
        .across_x = dip_post_window_row(&post->shapes[0][worker], slot) - 1,
        .across_y = dip_post_window_row(&post->shapes[1][worker], slot) - 1,
        .edge = dip_post_window_row(&post->shapes[2][worker], slot) - 1,
        .width = post->def.from_width + 2,
    };
    post->kernels->dip_kernel_easu_shape(&shape);
}

static void easu_row(DipPost *post, int worker, const Band *band, int y) {
    const int slot = post->places_y.first[y] - band->source_begin;
    DipEasuRow row = {
        .first = post->places_x.first,
        .part = post->places_x.part,
        .part_y = post->places_y.part[y],
        .to = post->to + (size_t)y * post->to_stride_bytes,
        .width = post->def.to_width,
    };
    for (int c = 0; c < 3; c++) {
        for (int r = 0; r < 4; r++) {
            row.rows[r][c] = dip_post_window_row(&post->channels[c][worker], slot - 1 + r);
        }
        for (int r = 0; r < 2; r++) {
            row.shape[r][c] = dip_post_window_row(&post->shapes[c][worker], slot + r);
        }
    }
    post->kernels->dip_kernel_easu_row(&row);
}

static void easu_band(void *context, int number, int worker) {
    DipPost *post = context;
    const Band band = band_of(post, number);
    const int count = band.source_end - band.source_begin;
    for (int i = 0; i < count; i++) {
        unpack_with_luma(post, worker, i, band.source_begin + i);
    }
    for (int i = 1; i < count - 1; i++) {
        find_shape(post, worker, i);
    }
    for (int y = band.begin; y < band.end; y++) {
        easu_row(post, worker, &band, y);
    }
}

static void run_easu(DipPost *post) {
    dip_post_run_bands(post, post->def.to_height, easu_band);
}

const DipPostKind dip_post_easu = {take_easu, prepare_common, run_easu};
