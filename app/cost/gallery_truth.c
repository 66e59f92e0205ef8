// Makes the truth of a gallery scene: draws it k times larger and averages k x k pixels.
#include "app/cost/gallery_truth.h"

#include <string.h>

enum { SAMPLES = 8 };

// Returns how many times wider and higher the picture is drawn.
static int scale_of(const DipTruthDef *def) {
    const int longer = def->width > def->height ? def->width : def->height;
    int scale = 2;
    while (scale * scale * SAMPLES < def->samples && (scale + 1) * longer <= DIP_MAX_FRAME_SIZE) {
        scale++;
    }
    return scale * longer <= DIP_MAX_FRAME_SIZE ? scale : 1;
}

// Averages blocks of scale x scale pixels.
static void average(const DipFrame *frame, int scale, int width, int height, double *rgb_lin) {
    DipSrgbDecodeTable table;
    dip_srgb_decode_table(&table);
    const double share = 1.0 / (scale * scale);
    for (int y = 0; y < height * scale; y++) {
        const uint8_t *row = frame->rgba8 + (size_t)y * frame->stride_bytes;
        double *out = rgb_lin + (size_t)(y / scale) * (size_t)width * 3;
        for (int x = 0; x < width * scale; x++) {
            for (int c = 0; c < 3; c++) {
                out[3 * (x / scale) + c] += share * table.linear[row[4 * x + c]];
            }
        }
    }
}

bool dip_gallery_truth_draw(const DipTruthDef *def, int half, double *rgb_lin, DipError *err) {
    const DipGalleryTruth *truth = def->context;
    const int scale = scale_of(def);
    DipGalleryPaneDef pane_def = {.gallery = truth->gallery,
                                  .isa = truth->isa,
                                  .width = def->width * scale,
                                  .height = def->height * scale};
    DipFrame frame;
    if (!dip_quality_parse("aa=8,taa=on,af=16,aaf=on", &pane_def.quality, err)) {
        return false;
    }
    DipGalleryPane *pane = dip_gallery_pane_create(&pane_def, err);
    if (!pane) {
        return false;
    }
    dip_gallery_pane_set_frame_index(pane, (uint64_t)half);
    const bool drawn = dip_gallery_pane_draw(pane, &def->pose, def->time_ns, &frame, err);
    if (drawn) {
        average(&frame, scale, def->width, def->height, rgb_lin);
    }
    dip_gallery_pane_destroy(&pane);
    return drawn;
}
