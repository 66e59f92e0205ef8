// Memory of the filters, and rows of values read from the source.
#include "renderer/base/pages.h"
#include "renderer/post/filters/filter.h"

#include <stdint.h>
#include <string.h>

void *dip_post_take(DipPostArena *arena, size_t count, size_t item_bytes) {
    void *part = arena->memory ? arena->memory + arena->used : NULL;
    const size_t left = SIZE_MAX - arena->used;
    if (left < DIP_CACHE_LINE || count > (left - DIP_CACHE_LINE) / item_bytes) {
        arena->used = SIZE_MAX; // no allocation is as large
        return NULL;
    }
    const size_t bytes = count * item_bytes;
    arena->used += (bytes + DIP_CACHE_LINE - 1) / DIP_CACHE_LINE * DIP_CACHE_LINE;
    return part;
}

static int bordered(int width) {
    return (width + 2 * DIP_POST_BORDER + 15) / 16 * 16;
}

DipPostPlane dip_post_take_plane(DipPostArena *arena, int width, int height) {
    DipPostPlane plane = {.stride = bordered(width)};
    const size_t rows = (size_t)height + 2 * DIP_POST_BORDER;
    float *memory = dip_post_take(arena, rows * (size_t)plane.stride, sizeof(float));
    if (memory) {
        plane.at = memory + (size_t)DIP_POST_BORDER * (size_t)plane.stride + DIP_POST_BORDER;
    }
    return plane;
}

DipPostWindow dip_post_take_window(DipPostArena *arena, int width, int row_count) {
    DipPostWindow window = {.stride = bordered(width), .row_count = row_count};
    float *memory = dip_post_take(arena, (size_t)row_count * (size_t)window.stride, sizeof(float));
    window.at = memory ? memory + DIP_POST_BORDER : NULL;
    return window;
}

void dip_post_run_bands(DipPost *post, int rows, DipTask task) {
    dip_pool_run(post->def.pool, (rows + DIP_POST_BAND - 1) / DIP_POST_BAND, task, post);
}

const uint8_t *dip_post_row(const DipPost *post, int y) {
    const int last = post->def.from_height - 1;
    const int row = y < 0 ? 0 : y > last ? last : y;
    return post->from + (size_t)row * post->from_stride_bytes;
}

void dip_post_extend_row(float *row, int width) {
    for (int i = 1; i <= DIP_POST_BORDER; i++) {
        row[-i] = row[0];
        row[width - 1 + i] = row[width - 1];
    }
}

// --- luma ----------------------------------------------------------------------------------------

typedef struct LumaJob {
    DipPost *post;
    const float *weights;
} LumaJob;

static void fill_band(void *context, int band, int worker) {
    (void)worker;
    const LumaJob *job = context;
    DipPost *post = job->post;
    const int end = (band + 1) * DIP_POST_BAND;
    for (int y = band * DIP_POST_BAND; y < end && y < post->def.from_height; y++) {
        float *row = post->luma.at + (ptrdiff_t)y * post->luma.stride;
        post->kernels->dip_kernel_post_luma(dip_post_row(post, y), post->def.from_width,
                                            job->weights, row);
        dip_post_extend_row(row, post->def.from_width);
    }
}

void dip_post_fill_luma(DipPost *post, const float weights[3]) {
    LumaJob job = {post, weights};
    const int height = post->def.from_height;
    dip_pool_run(post->def.pool, (height + DIP_POST_BAND - 1) / DIP_POST_BAND, fill_band, &job);
    float *first = post->luma.at - DIP_POST_BORDER;
    float *last = first + (ptrdiff_t)(height - 1) * post->luma.stride;
    const size_t bytes = (size_t)(post->def.from_width + 2 * DIP_POST_BORDER) * sizeof(float);
    for (int i = 1; i <= DIP_POST_BORDER; i++) {
        memcpy(first - (ptrdiff_t)i * post->luma.stride, first, bytes);
        memcpy(last + (ptrdiff_t)i * post->luma.stride, last, bytes);
    }
}

// --- channels ------------------------------------------------------------------------------------

void dip_post_take_channels(DipPost *post, DipPostArena *arena, int row_count) {
    for (int c = 0; c < 3; c++) {
        DipPostWindow *windows = dip_post_take(arena, (size_t)post->worker_count, sizeof *windows);
        for (int w = 0; w < post->worker_count; w++) {
            const DipPostWindow window =
                dip_post_take_window(arena, post->def.from_width, row_count);
            if (windows) {
                windows[w] = window;
            }
        }
        post->channels[c] = windows;
    }
}

void dip_post_unpack(DipPost *post, int worker, int slot, int y, bool linear) {
    float *rows[3];
    for (int c = 0; c < 3; c++) {
        rows[c] = dip_post_window_row(&post->channels[c][worker], slot);
    }
    const uint8_t *pixels = dip_post_row(post, y);
    if (linear) {
        post->kernels->dip_kernel_post_decode(pixels, post->def.from_width, post->light, rows);
    } else {
        post->kernels->dip_kernel_post_codes(pixels, post->def.from_width, rows);
    }
    for (int c = 0; c < 3; c++) {
        dip_post_extend_row(rows[c], post->def.from_width);
    }
}
