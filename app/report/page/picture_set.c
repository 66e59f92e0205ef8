// Compares the frames of a set's rows at one viewpoint, finds the crop (the part of the picture)
// in which the rows differ most, and cuts this crop out.
#include "app/report/page/picture_set.h"

#include "app/files/pictures.h"
#include "app/measure/metrics/flip.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    GRID = 16, // Distance between the positions where crops are tried, in pixels.
    SKIP = 2   // Every second pixel of a column and of a row is read to judge a crop.
};

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
}

static size_t pixel_count(const DipCostCutter *c) {
    return (size_t)c->report->width * (size_t)c->report->height;
}

static size_t row_bytes(const DipCostCutter *c) {
    return (size_t)c->report->width * 4;
}

void dip_cost_cutter_close(DipCostCutter *cutter) {
    dip_flip_analysis_free(&cutter->truth_side);
    dip_flip_free(&cutter->flip);
    free(cutter->truth);
    free(cutter->frames);
    free(cutter->maps);
    free(cutter->map);
    free(cutter->crop);
}

bool dip_cost_cutter_open(DipCostCutter *cutter, const DipCostReport *report,
                          const DipCostFrameSource *source, int most_rows, DipError *err) {
    DipCostCutter *c = cutter;
    *c = (DipCostCutter){.report = report, .source = source};
    const size_t pixels = pixel_count(c) * (size_t)most_rows;
    c->truth = malloc(pixel_count(c) * 4);
    c->frames = malloc(pixels * 4);
    c->maps = malloc(pixels);
    c->map = malloc(pixel_count(c) * sizeof *c->map);
    c->crop = malloc((size_t)DIP_COST_CROP_WIDTH * DIP_COST_CROP_HEIGHT);
    const bool made =
        c->truth && c->frames && c->maps && c->map && c->crop &&
        dip_flip_init(&c->flip, report->width, report->height, report->options.pixels_per_degree) &&
        dip_flip_analysis_init(&c->flip, &c->truth_side);
    if (!made) {
        dip_cost_cutter_close(c);
        return out_of_memory(err);
    }
    return true;
}

// --- comparing -----------------------------------------------------------------------------------

static DipSrgbPicture picture_of(const DipCostCutter *c, const uint8_t *rgba8) {
    return (DipSrgbPicture){rgba8, row_bytes(c), c->report->width, c->report->height};
}

static bool read_truth(DipCostCutter *c, const DipCostPictureSet *set, DipError *err) {
    if (!c->source->read(c->source->context, set, -1, c->truth, err)) {
        return false;
    }
    const DipSrgbPicture picture = picture_of(c, c->truth);
    dip_flip_analyse(&c->flip, &picture, &c->truth_side);
    return true;
}

// Gets a row's frame and computes its FLIP map.
static bool read_frame(DipCostCutter *c, const DipCostPictureSet *set, int index, DipError *err) {
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

// Returns the sum over the crop's pixels of the greatest error of any row minus the least.
static int64_t judge_crop(const DipCostCutter *c, const DipCostPictureSet *set, int x0, int y0) {
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

// Finds the crop in which the rows' errors differ most, among crops at a grid of positions.
static void find_crop(const DipCostCutter *c, DipCostPictureSet *set) {
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

// Writes the four digits of up to three bytes.
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

// An encoded picture. `made` is false if memory ran out; the bytes are owned otherwise.
typedef struct Encoded {
    bool made;
    unsigned char *bytes;
    size_t size;
} Encoded;

// Turns an encoded picture into a data URI and frees it.
static char *uri_of(const char *type, const Encoded *encoded) {
    char *uri = encoded->made ? dip_cost_data_uri(type, encoded->bytes, encoded->size) : NULL;
    if (encoded->made) {
        free(encoded->bytes);
    }
    return uri;
}

static char *cut_crop(const DipCostCutter *c, const DipCostPictureSet *set, const uint8_t *rgba8) {
    const uint8_t *corner = rgba8 + (size_t)set->y * row_bytes(c) + (size_t)set->x * 4;
    Encoded png = {0};
    png.made = dip_png_encode(corner, row_bytes(c), set->crop_width, set->crop_height, &png.bytes,
                              &png.size);
    return uri_of("image/png", &png);
}

static char *cut_frame(const DipCostCutter *c, const uint8_t *rgba8) {
    const DipCostReport *report = c->report;
    Encoded jpeg = {0};
    jpeg.made = dip_jpeg_encode(rgba8, row_bytes(c), report->width, report->height,
                                DIP_COST_FRAME_QUALITY, &jpeg.bytes, &jpeg.size);
    return uri_of("image/jpeg", &jpeg);
}

static char *cut_map(const DipCostCutter *c, const DipCostPictureSet *set, const uint8_t *map) {
    uint8_t palette[3 * 256];
    const size_t width = (size_t)c->report->width;
    for (int i = 0; i < 256; i++) {
        dip_magma((float)i / 255.0f, palette + 3 * i);
    }
    for (int y = 0; y < set->crop_height; y++) {
        memcpy(c->crop + (size_t)y * (size_t)set->crop_width,
               map + (size_t)(set->y + y) * width + (size_t)set->x, (size_t)set->crop_width);
    }
    Encoded png = {0};
    png.made = dip_png_encode_indexed(c->crop, palette, set->crop_width, set->crop_height,
                                      &png.bytes, &png.size);
    return uri_of("image/png", &png);
}

// Returns false when memory runs out.
static bool cut_picture(const DipCostCutter *c, const DipCostPictureSet *set, const uint8_t *rgba8,
                        bool whole, DipCostPicture *picture) {
    picture->crop = cut_crop(c, set, rgba8);
    picture->frame = whole ? cut_frame(c, rgba8) : NULL;
    return picture->crop && (!whole || picture->frame);
}

static bool cut_all(const DipCostCutter *c, DipCostPictureSet *set, bool whole) {
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

bool dip_cost_picture_set_make(DipCostPictureSet *set, DipCostCutter *cutter, bool whole,
                               DipError *err) {
    set->truth.row = -1;
    bool made = read_truth(cutter, set, err);
    for (int i = 0; made && i < set->count; i++) {
        made = read_frame(cutter, set, i, err);
    }
    if (made) {
        find_crop(cutter, set);
        made = cut_all(cutter, set, whole) || out_of_memory(err);
    }
    if (!made) {
        dip_cost_picture_set_free(set);
    }
    return made;
}

static void free_picture(DipCostPicture *picture) {
    free(picture->crop);
    free(picture->map);
    free(picture->frame);
}

void dip_cost_picture_set_free(DipCostPictureSet *set) {
    free_picture(&set->truth);
    for (int i = 0; i < DIP_COST_SET_ROWS; i++) {
        free_picture(&set->pictures[i]);
    }
    *set = (DipCostPictureSet){0};
}
