// FXAA: luma of the whole picture, then edges and the pixels at them, row by row.
#include "renderer/post/filters/filter.h"

static const float luma_weights[3] = {0.299f, 0.587f, 0.114f};

static void take(DipPost *post, DipPostArena *arena) {
    const size_t workers = (size_t)post->worker_count;
    post->luma = dip_post_take_plane(arena, post->def.from_width, post->def.from_height);
    post->edges_found = dip_post_take(arena, workers, sizeof *post->edges_found);
    post->edge_lists = dip_post_take(arena, workers, sizeof *post->edge_lists);
    for (size_t i = 0; i < workers; i++) {
        // A vector may be written beyond the last place.
        uint32_t *list = dip_post_take(arena, (size_t)post->def.from_width + 16, sizeof(uint32_t));
        if (post->edge_lists) {
            post->edge_lists[i] = list;
        }
    }
}

static void prepare(DipPost *post) {
    (void)post;
}

static void filter_band(void *context, int band, int worker) {
    DipPost *post = context;
    const int end = (band + 1) * DIP_POST_BAND;
    for (int y = band * DIP_POST_BAND; y < end && y < post->def.to_height; y++) {
        const DipFxaaRow row = {
            .luma = post->luma.at + (ptrdiff_t)y * post->luma.stride,
            .luma_stride = post->luma.stride,
            .above = dip_post_row(post, y - 1),
            .row = dip_post_row(post, y),
            .below = dip_post_row(post, y + 1),
            .to = post->to + (size_t)y * post->to_stride_bytes,
            .width = post->def.to_width,
            .edges = post->edge_lists[worker],
        };
        post->edges_found[worker] += (uint64_t)post->kernels->dip_kernel_fxaa_row(&row);
    }
}

static void run(DipPost *post) {
    dip_post_fill_luma(post, luma_weights);
    dip_post_run_bands(post, post->def.to_height, filter_band);
}

const DipPostKind dip_post_fxaa = {take, prepare, run};
