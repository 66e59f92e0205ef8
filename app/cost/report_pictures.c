// Drawing the steps of each sweep once more, finding the crop (the part of the picture) in which
// the steps differ most, and cutting this crop out.
#include "app/cost/report_pictures.h"

#include "app/files/png.h"
#include "app/measure/flip.h"
#include "app/measure/magma.h"
#include "app/progress.h"

#include <stdlib.h>
#include <string.h>

typedef struct Cropper {
    DipCostContext *cost;
    DipFlip flip;
    DipFlipAnalysis truth_side;
    DipFlipAnalysis side;
    float *maps;       // FLIP maps, [step][pixel]
    uint8_t *pictures; // frames, [step][pixel], rgba8
    uint8_t *colours;  // crop of a FLIP map in colours, rgba8
    DipProgress progress;
    int64_t done;
} Cropper;

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
}

static size_t pixel_count(const Cropper *c) {
    return (size_t)c->cost->report->width * (size_t)c->cost->report->height;
}

static void close_cropper(Cropper *c) {
    dip_flip_analysis_free(&c->truth_side);
    dip_flip_analysis_free(&c->side);
    dip_flip_free(&c->flip);
    free(c->maps);
    free(c->pictures);
    free(c->colours);
}

static bool open_cropper(Cropper *c, DipCostContext *cost, DipError *err) {
    const DipCostReport *report = cost->report;
    *c = (Cropper){.cost = cost};
    const size_t pixels = pixel_count(c) * DIP_COST_MAX_SWEEP_ROWS;
    c->maps = malloc(pixels * sizeof *c->maps);
    c->pictures = malloc(pixels * 4);
    c->colours = malloc((size_t)DIP_COST_CROP_WIDTH * DIP_COST_CROP_HEIGHT * 4);
    const bool made =
        c->maps && c->pictures && c->colours &&
        dip_flip_init(&c->flip, report->width, report->height, report->options.pixels_per_degree) &&
        dip_flip_analysis_init(&c->flip, &c->truth_side) &&
        dip_flip_analysis_init(&c->flip, &c->side);
    if (!made) {
        close_cropper(c);
        return out_of_memory(err);
    }
    return true;
}

static char *base64(const unsigned char *bytes, size_t size) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    char *text = malloc((size + 2) / 3 * 4 + 1);
    char *to = text;
    for (size_t i = 0; text && i < size; i += 3) {
        const unsigned left = (unsigned)(size - i);
        const unsigned word = (unsigned)bytes[i] << 16 |
                              (left > 1 ? (unsigned)bytes[i + 1] << 8 : 0) |
                              (left > 2 ? bytes[i + 2] : 0u);
        *to++ = digits[word >> 18 & 63];
        *to++ = digits[word >> 12 & 63];
        *to++ = left > 1 ? digits[word >> 6 & 63] : '=';
        *to++ = left > 2 ? digits[word & 63] : '=';
    }
    if (text) {
        *to = '\0';
    }
    return text;
}

static char *png_text(const uint8_t *rgba8, size_t stride_bytes, int width, int height) {
    unsigned char *bytes;
    size_t size;
    if (!dip_png_encode(rgba8, stride_bytes, width, height, &bytes, &size)) {
        return NULL;
    }
    char *text = base64(bytes, size);
    free(bytes);
    return text;
}

static int crop_width(const Cropper *c) {
    const int width = c->cost->report->width;
    return width < DIP_COST_CROP_WIDTH ? width : DIP_COST_CROP_WIDTH;
}

static int crop_height(const Cropper *c) {
    const int height = c->cost->report->height;
    return height < DIP_COST_CROP_HEIGHT ? height : DIP_COST_CROP_HEIGHT;
}

// Finds the crop in which the steps' errors differ most. The difference at a pixel is the greatest
// error of any step minus the least error of any step. Among the crops at a grid of positions,
// takes the crop with the greatest sum of the differences of its pixels.
static void find_crop(const Cropper *c, int steps, DipCostCrops *crops) {
    const int width = c->cost->report->width, height = c->cost->report->height;
    double most = -1.0;
    for (int y0 = 0; y0 + crop_height(c) <= height; y0 += 16) {
        for (int x0 = 0; x0 + crop_width(c) <= width; x0 += 16) {
            double sum = 0.0;
            for (int y = y0; y < y0 + crop_height(c); y += 2) {
                for (int x = x0; x < x0 + crop_width(c); x += 2) {
                    float low = 1.0f, high = 0.0f;
                    for (int s = 0; s < steps; s++) {
                        const float e = c->maps[(size_t)s * pixel_count(c) +
                                                (size_t)y * (size_t)width + (size_t)x];
                        low = e < low ? e : low;
                        high = e > high ? e : high;
                    }
                    sum += (double)(high - low);
                }
            }
            if (sum > most) {
                most = sum;
                crops->x = x0;
                crops->y = y0;
            }
        }
    }
}

static char *cut_picture(const Cropper *c, const uint8_t *rgba8, const DipCostCrops *crops) {
    const size_t stride = (size_t)c->cost->report->width * 4;
    return png_text(rgba8 + (size_t)crops->y * stride + (size_t)crops->x * 4, stride, crop_width(c),
                    crop_height(c));
}

static char *cut_map(const Cropper *c, const float *map, const DipCostCrops *crops) {
    const int width = crop_width(c), height = crop_height(c);
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            const size_t from =
                (size_t)(crops->y + y) * (size_t)c->cost->report->width + (size_t)(crops->x + x);
            dip_magma(map[from], c->colours + 4 * (y * width + x));
        }
    }
    return png_text(c->colours, (size_t)width * 4, width, height);
}

static bool draw_step(Cropper *c, int row, int index, int64_t time_ns, DipError *err) {
    const DipCostReport *report = c->cost->report;
    uint8_t *to = c->pictures + (size_t)index * pixel_count(c) * 4;
    const size_t row_bytes = (size_t)report->width * 4;
    DipFrame frame;
    if (!dip_cost_draw(c->cost, row, time_ns, 0, &frame, err)) {
        return false;
    }
    for (int y = 0; y < report->height; y++) {
        memcpy(to + (size_t)y * row_bytes, frame.rgba8 + (size_t)y * frame.stride_bytes, row_bytes);
    }
    const DipSrgbPicture picture = {to, row_bytes, report->width, report->height};
    dip_flip_analyse(&c->flip, &picture, &c->side);
    dip_flip_compare(&c->flip, &c->truth_side, &c->side, c->maps + (size_t)index * pixel_count(c));
    return true;
}

static bool go_on(void *context, double done) {
    (void)context;
    (void)done;
    return true;
}

static bool cut_sweep(Cropper *c, const DipCostSweep *sweep, DipCostCrops *crops, DipError *err) {
    const DipCostReport *report = c->cost->report;
    // Use the middle one of the viewpoints whose errors are known.
    crops->viewpoint = (report->options.first_place + report->options.end_place - 1) / 2;
    const int64_t time_ns =
        dip_cost_viewpoint_time_ns(report, c->cost->session, sweep->path, crops->viewpoint, 0);
    DipTruth truth;
    if (!dip_cost_context_truth(c->cost, sweep->path, crops->viewpoint, 0, go_on, NULL, &truth,
                                err)) {
        return false;
    }
    const DipSrgbPicture picture = {truth.rgba8, (size_t)report->width * 4, report->width,
                                    report->height};
    dip_flip_analyse(&c->flip, &picture, &c->truth_side);
    bool drawn = true;
    for (int i = 0; drawn && i < sweep->row_count; i++) {
        drawn = draw_step(c, sweep->rows[i], i, time_ns, err);
        dip_progress_show(&c->progress, ++c->done);
    }
    if (drawn) {
        find_crop(c, sweep->row_count, crops);
        crops->truth = cut_picture(c, truth.rgba8, crops);
    }
    for (int i = 0; drawn && i < sweep->row_count; i++) {
        crops->steps[i] = cut_picture(c, c->pictures + (size_t)i * pixel_count(c) * 4, crops);
        crops->maps[i] = cut_map(c, c->maps + (size_t)i * pixel_count(c), crops);
    }
    dip_truth_free(&truth);
    return drawn;
}

bool dip_cost_pictures_make(DipCostPictures *pictures, DipCostContext *cost, DipError *err) {
    const DipCostReport *report = cost->report;
    Cropper c;
    memset(pictures, 0, sizeof *pictures);
    if (!open_cropper(&c, cost, err)) {
        return false;
    }
    int64_t total = 0;
    for (int s = 0; s < report->sweep_count; s++) {
        total += report->sweeps[s].row_count;
    }
    c.progress = dip_progress_begin("pictures cut out", total);
    bool made = true;
    for (int s = 0; made && s < report->sweep_count; s++) {
        made = !dip_cost_interrupted(cost, err) &&
               cut_sweep(&c, &report->sweeps[s], &pictures->sweeps[s], err);
    }
    dip_progress_end(&c.progress, c.done);
    close_cropper(&c);
    if (!made) {
        dip_cost_pictures_free(pictures);
    }
    return made;
}

void dip_cost_pictures_free(DipCostPictures *pictures) {
    for (int s = 0; s < DIP_COST_MAX_SWEEPS; s++) {
        DipCostCrops *crops = &pictures->sweeps[s];
        free(crops->truth);
        for (int i = 0; i < DIP_COST_MAX_SWEEP_ROWS; i++) {
            free(crops->steps[i]);
            free(crops->maps[i]);
        }
    }
    memset(pictures, 0, sizeof *pictures);
}
