// Compares the frames of a set's rows at one viewpoint (report_pictures.h), finds the crop (the
// part of the picture) in which the rows differ most, and cuts this crop out. Chooses the rows of
// each set, and fits their pictures into the page.
#include "app/report/page/report_pictures.h"

#include "app/cli/progress.h"
#include "app/files/pictures.h"
#include "app/measure/metrics/flip.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Scratch memory for making sets of pictures, and the source of their frames.
typedef struct Cutter {
    const DipCostReport *report;      // Borrowed.
    const DipCostFrameSource *source; // Borrowed.
    DipFlip flip;
    DipFlipAnalysis truth_side; // What FLIP computes from the truth alone.
    uint8_t *truth;             // The truth's pixels, rgba8.
    uint8_t *frames;            // Frames, [picture of the set][pixel], rgba8.
    uint8_t *maps;              // FLIP maps in units of 1/255, [picture of the set][pixel].
    float *map;                 // FLIP map of one frame.
    uint8_t crop[DIP_COST_CROP_WIDTH * DIP_COST_CROP_HEIGHT]; // Crop of a FLIP map.
} Cutter;

enum {
    GRID = 16, // Distance between the positions where crops are tried, in pixels.
    SKIP = 2,  // Every second pixel of a column and of a row is read to judge a crop.
    SET_COUNT = DIP_COST_MAX_SWEEPS + 1,
    TEXT_BYTES = 400000,  // Room for the style, the scripts and the texts of a page.
    ROW_TEXT_BYTES = 1500 // Room for the texts about one row in the tables and plots.
};

static size_t pixel_count(const Cutter *c) {
    return (size_t)c->report->width * (size_t)c->report->height;
}

static size_t row_bytes(const Cutter *c) {
    return (size_t)c->report->width * 4;
}

static void close_cutter(Cutter *cutter) {
    dip_flip_analysis_free(&cutter->truth_side);
    dip_flip_free(&cutter->flip);
    free(cutter->truth);
    free(cutter->frames);
    free(cutter->maps);
    free(cutter->map);
}

// Allocates the memory of a cutter. `most_rows` is the greatest number of rows in a set. On failure
// the cutter is closed.
static bool open_cutter(Cutter *c, const DipCostReport *report, const DipCostFrameSource *source,
                        int most_rows, DipError *err) {
    *c = (Cutter){.report = report, .source = source};
    const size_t pixels = pixel_count(c) * (size_t)most_rows;
    c->truth = malloc(pixel_count(c) * 4);
    c->frames = malloc(pixels * 4);
    c->maps = malloc(pixels);
    c->map = malloc(pixel_count(c) * sizeof *c->map);
    const bool made =
        c->truth && c->frames && c->maps && c->map &&
        dip_flip_init(&c->flip, report->width, report->height, report->options.pixels_per_degree) &&
        dip_flip_analysis_init(&c->flip, &c->truth_side);
    if (!made) {
        close_cutter(c);
        return dip_cost_out_of_memory(err);
    }
    return true;
}

// --- comparing -----------------------------------------------------------------------------------

static DipSrgbPicture picture_of(const Cutter *c, const uint8_t *rgba8) {
    return (DipSrgbPicture){rgba8, row_bytes(c), c->report->width, c->report->height};
}

static bool read_truth(Cutter *c, const DipCostPictureSet *set, DipError *err) {
    if (!c->source->read(c->source->context, set, -1, c->truth, err)) {
        return false;
    }
    const DipSrgbPicture picture = picture_of(c, c->truth);
    dip_flip_analyse(&c->flip, &picture, &c->truth_side);
    return true;
}

// Gets a row's frame and computes its FLIP map.
static bool read_frame(Cutter *c, const DipCostPictureSet *set, int index, DipError *err) {
    uint8_t *to = c->frames + (size_t)index * pixel_count(c) * 4;
    uint8_t *map = c->maps + (size_t)index * pixel_count(c);
    if (!c->source->read(c->source->context, set, set->pictures[index].row, to, err)) {
        return false;
    }
    const DipSrgbPicture picture = picture_of(c, to);
    dip_flip_compare(&c->flip, &picture, &c->truth_side, c->map);
    for (size_t i = 0; i < pixel_count(c); i++) {
        map[i] = (uint8_t)(255.0f * c->map[i] + 0.5f);
    }
    return true;
}

// --- choosing the crop ---------------------------------------------------------------------------

// Returns how much the rows differ in a crop: the sum, over some of its pixels (SKIP), of the
// greatest error of any row minus the least.
static int64_t judge_crop(const Cutter *c, const DipCostPictureSet *set, int x0, int y0) {
    const size_t width = (size_t)c->report->width;
    int64_t sum = 0;
    for (int y = y0; y < y0 + set->crop_height; y += SKIP) {
        for (int x = x0; x < x0 + set->crop_width; x += SKIP) {
            int low = 255, high = 0;
            for (int s = 0; s < set->count; s++) {
                const int e = c->maps[(size_t)s * pixel_count(c) + (size_t)y * width + (size_t)x];
                low = e < low ? e : low;
                high = e > high ? e : high;
            }
            sum += high - low;
        }
    }
    return sum;
}

// Finds the crop in which the errors of the rows differ most. Tries crops at a grid of positions.
static void find_crop(const Cutter *c, DipCostPictureSet *set) {
    const int width = c->report->width, height = c->report->height;
    int64_t most = -1;
    set->crop_width = width < DIP_COST_CROP_WIDTH ? width : DIP_COST_CROP_WIDTH;
    set->crop_height = height < DIP_COST_CROP_HEIGHT ? height : DIP_COST_CROP_HEIGHT;
    for (int y = 0; y + set->crop_height <= height; y += GRID) {
        for (int x = 0; x + set->crop_width <= width; x += GRID) {
            const int64_t sum = judge_crop(c, set, x, y);
            if (sum > most) {
                most = sum;
                set->x = x;
                set->y = y;
            }
        }
    }
}

// --- data URIs ----------------------------------------------------------------------------------

static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

// Writes up to three bytes as four digits of base64.
static void write_group(const unsigned char *bytes, size_t left, char *to) {
    const unsigned word = (unsigned)bytes[0] << 16 | (left > 1 ? (unsigned)bytes[1] << 8 : 0u) |
                          (left > 2 ? bytes[2] : 0u);
    to[0] = digits[word >> 18 & 63];
    to[1] = digits[word >> 12 & 63];
    to[2] = left > 1 ? digits[word >> 6 & 63] : '=';
    to[3] = left > 2 ? digits[word & 63] : '=';
}

char *dip_cost_data_uri(const char *type, const unsigned char *bytes, size_t size_bytes) {
    const size_t room = strlen(type) + 16 + (size_bytes + 2) / 3 * 4 + 1;
    char *uri = malloc(room);
    if (!uri) {
        return NULL;
    }
    char *to = uri + snprintf(uri, room, "data:%s;base64,", type);
    for (size_t i = 0; i < size_bytes; i += 3, to += 4) {
        write_group(bytes + i, size_bytes - i, to);
    }
    *to = '\0';
    return uri;
}

// --- encoding ------------------------------------------------------------------------------------

// Returns an encoded picture as a data URI, and frees the encoded picture. Returns NULL when memory
// runs out. `made` is false if memory ran out before, and the picture was not made.
static char *take_uri(bool made, const char *type, unsigned char *bytes, size_t size_bytes) {
    char *uri = made ? dip_cost_data_uri(type, bytes, size_bytes) : NULL;
    if (made) {
        free(bytes);
    }
    return uri;
}

static char *cut_crop(const Cutter *c, const DipCostPictureSet *set, const uint8_t *rgba8) {
    const uint8_t *corner = rgba8 + (size_t)set->y * row_bytes(c) + (size_t)set->x * 4;
    unsigned char *bytes;
    size_t size_bytes;
    const bool made = dip_png_encode(corner, row_bytes(c), set->crop_width, set->crop_height,
                                     &bytes, &size_bytes);
    return take_uri(made, "image/png", bytes, size_bytes);
}

static char *cut_frame(const Cutter *c, const uint8_t *rgba8) {
    unsigned char *bytes;
    size_t size_bytes;
    const bool made = dip_jpeg_encode(rgba8, row_bytes(c), c->report->width, c->report->height,
                                      DIP_COST_FRAME_QUALITY, &bytes, &size_bytes);
    return take_uri(made, "image/jpeg", bytes, size_bytes);
}

static char *cut_map(Cutter *c, const DipCostPictureSet *set, const uint8_t *map) {
    uint8_t palette[3 * 256];
    const size_t width = (size_t)c->report->width;
    for (int i = 0; i < 256; i++) {
        dip_magma((float)i / 255.0f, palette + 3 * i);
    }
    for (int y = 0; y < set->crop_height; y++) {
        memcpy(c->crop + (size_t)y * (size_t)set->crop_width,
               map + (size_t)(set->y + y) * width + (size_t)set->x, (size_t)set->crop_width);
    }
    unsigned char *bytes;
    size_t size_bytes;
    const bool made = dip_png_encode_indexed(c->crop, palette, set->crop_width, set->crop_height,
                                             &bytes, &size_bytes);
    return take_uri(made, "image/png", bytes, size_bytes);
}

// Encodes the crop of a frame and, if `whole` is true, the whole frame. Returns false when memory
// runs out.
static bool cut_picture(const Cutter *c, const DipCostPictureSet *set, const uint8_t *rgba8,
                        bool whole, DipCostPicture *picture) {
    picture->crop = cut_crop(c, set, rgba8);
    picture->frame = whole ? cut_frame(c, rgba8) : NULL;
    return picture->crop && (!whole || picture->frame);
}

static bool cut_all(Cutter *c, DipCostPictureSet *set, bool whole) {
    bool cut = cut_picture(c, set, c->truth, whole, &set->truth);
    for (int i = 0; cut && i < set->count; i++) {
        DipCostPicture *picture = &set->pictures[i];
        picture->map = cut_map(c, set, c->maps + (size_t)i * pixel_count(c));
        cut = cut_picture(c, set, c->frames + (size_t)i * pixel_count(c) * 4, whole, picture) &&
              picture->map;
    }
    return cut;
}

// --- sets ----------------------------------------------------------------------------------------

static void free_picture(DipCostPicture *picture) {
    free(picture->crop);
    free(picture->map);
    free(picture->frame);
}

static void free_set(DipCostPictureSet *set) {
    free_picture(&set->truth);
    for (int i = 0; i < DIP_COST_SET_ROWS; i++) {
        free_picture(&set->pictures[i]);
    }
    *set = (DipCostPictureSet){0};
}

// Gets the rows' frames from the source and makes the pictures. The caller fills in set->path,
// set->viewpoint, set->count and the rows of set->pictures before. If `whole` is true, keeps whole
// frames, too. On failure the set is empty.
static bool make_set(DipCostPictureSet *set, Cutter *cutter, bool whole, DipError *err) {
    set->truth.row = -1;
    bool made = read_truth(cutter, set, err);
    for (int i = 0; made && i < set->count; i++) {
        made = read_frame(cutter, set, i, err);
    }
    if (made) {
        find_crop(cutter, set);
        made = cut_all(cutter, set, whole) || dip_cost_out_of_memory(err);
    }
    if (!made) {
        free_set(set);
    }
    return made;
}

// --- fitting -------------------------------------------------------------------------------------

static double size_of(const char *uri) {
    return uri ? (double)strlen(uri) : 0.0;
}

static void drop(char **uri) {
    free(*uri);
    *uri = NULL;
}

// Returns whether a row of the set has a crop.
static bool has_crops(const DipCostPictureSet *set) {
    for (int i = 0; i < set->count; i++) {
        if (set->pictures[i].crop) {
            return true;
        }
    }
    return false;
}

// Frees the pictures of a set that do not fit in `room` bytes, and adds the number of their rows to
// *left_out. If `frames` is false, frees the crops that do not fit. If `frames` is true, whole
// frames that fit take the place of crops, and the other frames are freed. The first row that fits
// also needs room for the truth's picture. Returns the bytes that are left.
static double fit_set(DipCostPictureSet *set, bool frames, double room, int *left_out) {
    char **truth = frames ? &set->truth.frame : &set->truth.crop;
    double with_first = size_of(*truth);
    bool any = false;
    for (int i = 0; i < set->count; i++) {
        DipCostPicture *picture = &set->pictures[i];
        const double small = size_of(picture->crop) + size_of(picture->map);
        const double need = with_first + (frames ? size_of(picture->frame) - small : small);
        const bool fits = need <= room;
        if (fits) {
            room -= need;
            with_first = 0.0;
            any = true;
        } else {
            ++*left_out;
        }
        // The crop goes in two cases: a whole frame that fits takes its place, or the crop itself
        // does not fit.
        if (fits == frames) {
            drop(&picture->crop);
            drop(&picture->map);
        } else if (frames) {
            drop(&picture->frame);
        }
    }
    if (frames ? !any : !has_crops(set)) {
        drop(truth);
    } else if (frames && !has_crops(set)) {
        drop(&set->truth.crop);
    }
    return room;
}

void dip_cost_pictures_fit(DipCostPictures *pictures, double room) {
    bool whole = pictures->front.truth.frame != NULL;
    for (int s = 0; s < DIP_COST_MAX_SWEEPS; s++) {
        whole = whole || pictures->sweeps[s].truth.frame;
        room = fit_set(&pictures->sweeps[s], false, room, &pictures->crops_left_out);
    }
    room = fit_set(&pictures->front, false, room, &pictures->crops_left_out);
    if (!whole) {
        return;
    }
    room = fit_set(&pictures->front, true, room, &pictures->frames_left_out);
    for (int s = 0; s < DIP_COST_MAX_SWEEPS; s++) {
        room = fit_set(&pictures->sweeps[s], true, room, &pictures->frames_left_out);
    }
}

// --- making --------------------------------------------------------------------------------------

static void add_row(DipCostPictureSet *set, int row) {
    for (int i = 0; i < set->count; i++) {
        if (set->pictures[i].row == row) {
            return;
        }
    }
    if (set->count < DIP_COST_SET_ROWS) {
        set->pictures[set->count++].row = row;
    }
}

static void sort_by_time(const DipCostReport *report, DipCostPictureSet *set) {
    for (int i = 1; i < set->count; i++) {
        const int row = set->pictures[i].row;
        int to = i;
        for (; to > 0 && dip_cost_ms(report, set->pictures[to - 1].row) > dip_cost_ms(report, row);
             to--) {
            set->pictures[to].row = set->pictures[to - 1].row;
        }
        set->pictures[to].row = row;
    }
}

// Chooses the rows of the set of the Pareto front, and sorts them by time. Advised rows are chosen
// first, since a set has room for DIP_COST_SET_ROWS rows only.
static void plan_front(const DipCostReport *report, DipCostPictureSet *set) {
    const DipCostChoice *choice = &report->choice;
    for (int i = 0; i < choice->advice_count; i++) {
        const DipCandidate *chosen = dip_cost_chosen(report, i);
        if (chosen) {
            add_row(set, chosen->row);
        }
    }
    for (int i = 0; i < choice->front_count; i++) {
        add_row(set, choice->candidates.list[choice->front[i]].row);
    }
    sort_by_time(report, set);
}

static void plan_sweep(const DipCostSweep *sweep, DipCostPictureSet *set) {
    set->path = sweep->path;
    for (int i = 0; i < sweep->row_count; i++) {
        add_row(set, sweep->rows[i]);
    }
}

// Makes all sets that have rows.
static bool make_sets(DipCostPictures *pictures, const DipCostReport *report,
                      const DipCostFrameSource *source, DipError *err) {
    DipCostPictureSet *sets[SET_COUNT];
    int total = 0, most = 1, done = 0;
    for (int s = 0; s < SET_COUNT; s++) {
        sets[s] = s < DIP_COST_MAX_SWEEPS ? &pictures->sweeps[s] : &pictures->front;
        sets[s]->viewpoint = (report->options.first_place + report->options.end_place - 1) / 2;
        total += sets[s]->count;
        most = sets[s]->count > most ? sets[s]->count : most;
    }
    Cutter cutter;
    if (!open_cutter(&cutter, report, source, most, err)) {
        return false;
    }
    const bool whole = report->options.pictures == DIP_COST_PICTURES_FULL;
    DipProgress progress = dip_progress_begin("pictures cut out", total);
    bool made = true;
    for (int s = 0; made && s < SET_COUNT; s++) {
        const int count = sets[s]->count;
        made = count == 0 || make_set(sets[s], &cutter, whole, err);
        dip_progress_show(&progress, done += count);
    }
    dip_progress_end(&progress, done);
    close_cutter(&cutter);
    return made;
}

bool dip_cost_pictures_make(DipCostPictures *pictures, const DipCostReport *report,
                            const DipCostFrameSource *source, DipError *err) {
    memset(pictures, 0, sizeof *pictures);
    if (report->options.pictures == DIP_COST_PICTURES_NONE) {
        return true;
    }
    for (int s = 0; s < report->sweep_count; s++) {
        plan_sweep(&report->sweeps[s], &pictures->sweeps[s]);
    }
    plan_front(report, &pictures->front);
    if (!make_sets(pictures, report, source, err)) {
        dip_cost_pictures_free(pictures);
        return false;
    }
    dip_cost_pictures_fit(pictures, DIP_COST_PAGE_BYTES - TEXT_BYTES -
                                        (double)ROW_TEXT_BYTES * report->row_count);
    return true;
}

void dip_cost_pictures_free(DipCostPictures *pictures) {
    for (int s = 0; s < DIP_COST_MAX_SWEEPS; s++) {
        free_set(&pictures->sweeps[s]);
    }
    free_set(&pictures->front);
    memset(pictures, 0, sizeof *pictures);
}
