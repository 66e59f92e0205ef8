// Sharpening: each row with the rows above and below it, as codes.
#include "renderer/post/filters/filter.h"

static void take(DipPost *post, DipPostArena *arena) {
    dip_post_take_channels(post, arena, DIP_POST_BAND + 2);
}

static void prepare(DipPost *post) {
    (void)post;
}

static void filter_band(void *context, int band, int worker) {
    DipPost *post = context;
    const int begin = band * DIP_POST_BAND;
    const int height = post->def.to_height;
    const int end = begin + DIP_POST_BAND < height ? begin + DIP_POST_BAND : height;
    for (int y = begin - 1; y <= end; y++) {
        dip_post_unpack(post, worker, y - begin + 1, y, false);
    }
    for (int y = begin; y < end; y++) {
        DipSharpenRow row = {
            .from = dip_post_row(post, y),
            .to = post->to + (size_t)y * post->to_stride_bytes,
            .width = post->def.to_width,
            .sharpness = post->def.sharpness,
        };
        for (int c = 0; c < 3; c++) {
            const DipPostWindow *window = &post->channels[c][worker];
            row.above[c] = dip_post_window_row(window, y - begin);
            row.row[c] = dip_post_window_row(window, y - begin + 1);
            row.below[c] = dip_post_window_row(window, y - begin + 2);
        }
        post->kernels->dip_kernel_sharpen_row(&row);
    }
}

static void run(DipPost *post) {
    dip_post_run_bands(post, post->def.to_height, filter_band);
}

const DipPostKind dip_post_sharpen = {take, prepare, run};
