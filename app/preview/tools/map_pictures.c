// Draws the pictures of the maps of error and work that lie over the panes (maps.h). Says why a map
// is missing or not yet final, and finds sizes of mip levels in the map of mip colours.
#include "app/measure/metrics/flip.h"
#include "app/preview/tools/maps.h"
#include "renderer/scene/mip_debug.h"

#include <stdio.h>
#include <string.h>

// Share of the scale's colour, in 1/256, where a map blends it with the pane's picture in grey.
enum { COLOUR_SHARE = 174 };

static void put(uint8_t *to, const uint8_t rgb[3]) {
    memcpy(to, rgb, 3);
    to[3] = 255;
}

static uint8_t grey_of(const uint8_t *rgba8) {
    return (uint8_t)((54 * rgba8[0] + 183 * rgba8[1] + 19 * rgba8[2]) >> 8);
}

static void blend(uint8_t *to, const uint8_t *rgba8, const uint8_t rgb[3], int share) {
    const int grey = grey_of(rgba8);
    for (int c = 0; c < 3; c++) {
        to[c] = (uint8_t)((rgb[c] * share + grey * (256 - share)) >> 8);
    }
    to[3] = 255;
}

// --- a function for each map ---------------------------------------------------------------------

static void draw_flip(DipCanvas *canvas, const float *flip, double end) {
    uint8_t table[DIP_MAP_COLOURS][3];
    for (int i = 0; i < DIP_MAP_COLOURS; i++) {
        dip_magma((float)i / (DIP_MAP_COLOURS - 1), table[i]);
    }
    const size_t pixels = (size_t)canvas->width * (size_t)canvas->height;
    for (size_t i = 0; i < pixels; i++) {
        put(canvas->rgba8 + 4 * i, table[dip_map_colour_index(flip[i], (float)end)]);
    }
}

// Finds the colour of each tile in row `row` of the tiles.
static void colour_row(const DipMapWork *work, DipMap map, double end, int row,
                       uint8_t (*colours)[3]) {
    for (int column = 0; column < work->across; column++) {
        const double value = dip_map_value(work, map, row * work->across + column);
        dip_cividis((float)(value / end), colours[column]);
    }
}

// Colours each tile over the grey picture, with a dark line at the tile's left and upper edge.
static void draw_tiles(DipCanvas *canvas, const DipMapWork *work, DipMap map, double end,
                       const DipPixels *frame) {
    uint8_t colours[DIP_MAX_TARGET_SIZE / DIP_TARGET_TILE][3];
    for (int y = 0; y < canvas->height; y++) {
        const uint8_t *from = frame->rgba8 + (size_t)y * frame->stride_bytes;
        uint8_t *to = canvas->rgba8 + 4 * (size_t)y * (size_t)canvas->width;
        if (y % DIP_TARGET_TILE == 0) {
            colour_row(work, map, end, y / DIP_TARGET_TILE, colours);
        }
        for (int x = 0; x < canvas->width; x++, from += 4, to += 4) {
            blend(to, from, colours[x / DIP_TARGET_TILE], COLOUR_SHARE);
            const bool edge = x % DIP_TARGET_TILE == 0 || y % DIP_TARGET_TILE == 0;
            for (int c = 0; c < 3 && edge; c++) {
                to[c] = (uint8_t)(to[c] * 5 / 8);
            }
        }
    }
}

// Draws every pixel with differing samples in the scale's last colour. All other pixels show the
// grey picture, tinted with the scale's first colour.
static void draw_mixed(DipCanvas *canvas, const DipMapWork *work, const DipPixels *frame) {
    uint8_t first[3], last[3];
    dip_cividis(0.0f, first);
    dip_cividis(1.0f, last);
    for (int y = 0; y < canvas->height; y++) {
        const uint8_t *from = frame->rgba8 + (size_t)y * frame->stride_bytes;
        const size_t row = (size_t)y * (size_t)canvas->width;
        for (int x = 0; x < canvas->width; x++) {
            uint8_t *to = canvas->rgba8 + 4 * (row + (size_t)x);
            if (work->mixed[row + (size_t)x]) {
                put(to, last);
            } else {
                blend(to, from + 4 * x, first, COLOUR_SHARE);
            }
        }
    }
}

// --- any map -------------------------------------------------------------------------------------

// Returns whether the values of a pane's map are known for a frame of this size. Sets *source to
// the version of these values.
static bool find_source(const DipMaps *maps, DipMap map, int pane, const DipPixels *frame,
                        uint64_t *source) {
    const DipMapWork *work = dip_maps_work(maps, pane);
    const DipErrorPictures *errors = maps->errors;
    if (map == DIP_MAP_FLIP) {
        *source = errors ? errors->version : 0;
        return errors && errors->flip[pane] && errors->width == frame->width &&
               errors->height == frame->height;
    }
    *source = maps->generation;
    return map != DIP_MAP_NONE && (map == DIP_MAP_MIPS ? work->mips != NULL : work->draws > 0) &&
           work->width == frame->width && work->height == frame->height;
}

static void draw(const DipMaps *maps, DipMap map, double end, int pane, const DipPixels *frame,
                 DipCanvas *canvas) {
    const DipMapWork *work = dip_maps_work(maps, pane);
    if (map == DIP_MAP_FLIP) {
        draw_flip(canvas, maps->errors->flip[pane], end);
    } else if (map == DIP_MAP_MIPS) {
        memcpy(canvas->rgba8, work->mips, 4 * (size_t)frame->width * (size_t)frame->height);
    } else if (map == DIP_MAP_SAMPLES) {
        draw_mixed(canvas, work, frame);
    } else {
        draw_tiles(canvas, work, map, end, frame);
    }
}

bool dip_maps_picture(DipMaps *maps, const DipToolState *tools, int pane, const DipPixels *frame,
                      uint64_t frame_version, DipPixels *out, uint64_t *version) {
    DipKeptPicture *picture = &maps->pictures[pane];
    const double end = dip_maps_end(maps, tools);
    uint64_t source;
    if (!find_source(maps, tools->map, pane, frame, &source)) {
        return false;
    }
    DipHash hash = dip_hash_begin(0);
    dip_hash_text(&hash, "map");
    dip_hash_integer(&hash, pane);
    dip_hash_integer(&hash, (int64_t)tools->map);
    dip_hash_number(&hash, end);
    dip_hash_integer(&hash, (int64_t)source);
    dip_hash_integer(&hash, (int64_t)frame_version);
    dip_hash_integer(&hash, frame->width);
    dip_hash_integer(&hash, frame->height);
    if (dip_kept_begin(picture, &hash)) {
        picture->known = dip_canvas_resize(&picture->canvas, frame->width, frame->height, NULL);
        if (picture->known) {
            draw(maps, tools->map, end, pane, frame, &picture->canvas);
        }
    }
    return dip_kept_show(picture, out, version);
}

// --- words ---------------------------------------------------------------------------------------

// Returns why the values of a map are not measured, or NULL if they are or will be. While pictures
// move, nobody knows what will rest.
static const char *why_never(const DipMaps *maps, DipMap map, int pane, bool gallery, bool still) {
    if (gallery && map != DIP_MAP_MIPS) {
        return map == DIP_MAP_FLIP ? "Gallery scenes have no converged picture, so no error."
                                   : "Gallery scenes do not record the work of their tiles.";
    }
    if (!still) {
        return NULL;
    }
    if (map == DIP_MAP_FLIP) {
        const DipErrorReading *reading = &maps->reading;
        return reading->status == DIP_ERROR_STATUS_FAILED
                   ? "There is not enough memory to measure the error."
               : reading->result.samples > 0 && reading->result.panes[pane].unjudged
                   ? "Mip colours are no picture of the scene, so they have no error."
                   : NULL;
    }
    if (map != DIP_MAP_MIPS && maps->key.quality[pane].step[DIP_SETTING_SCALE] != DIP_SCALE_1) {
        return "A render scale draws another picture: choose scale 1x.";
    }
    return maps->failed ? "The frame could not be measured: memory ran out." : NULL;
}

bool dip_maps_can_measure(const DipMaps *maps, DipMap map, int pane, bool gallery, bool still) {
    return !why_never(maps, map, pane, gallery, still);
}

static const char *flip_status(const DipMaps *maps, char *text, size_t size_bytes) {
    const DipErrorReading *reading = &maps->reading;
    if (reading->result.samples == 0) {
        return "Measuring: the converged picture is being drawn.";
    }
    if (reading->result.last) {
        return "";
    }
    // The finest truth is the mean of two halves with DIP_TRUTH_SAMPLES samples each.
    snprintf(text, size_bytes, "Measuring: %d of %d samples per pixel.", reading->result.samples,
             2 * DIP_TRUTH_SAMPLES);
    return text;
}

static const char *work_status(const DipMaps *maps, DipMap map, int pane, char *text,
                               size_t size_bytes) {
    const DipMapWork *work = dip_maps_work(maps, pane);
    const int draws = work->draws;
    if (map == DIP_MAP_MIPS ? !work->mips : draws == 0) {
        return "Measuring.";
    }
    if (map != DIP_MAP_TIME || draws == DIP_MAP_DRAWS) {
        return "";
    }
    snprintf(text, size_bytes, "Measuring: %d of %d draws.", draws, DIP_MAP_DRAWS);
    return text;
}

const char *dip_maps_status(const DipMaps *maps, DipMap map, int pane, bool gallery, bool still,
                            char *text, size_t size_bytes) {
    if (map == DIP_MAP_NONE) {
        return "";
    }
    const char *never = why_never(maps, map, pane, gallery, still);
    return never                 ? never
           : !still              ? "Measured while the camera rests."
           : map == DIP_MAP_FLIP ? flip_status(maps, text, size_bytes)
                                 : work_status(maps, map, pane, text, size_bytes);
}

// --- mip levels ----------------------------------------------------------------------------------

DipColour dip_map_mip_colour(int index) {
    const uint8_t *rgba8 = dip_mip_debug_colour(index);
    return (DipColour){rgba8[0], rgba8[1], rgba8[2], rgba8[3]};
}

void dip_map_mip_text(int index, char text[DIP_MIP_TEXT_BYTES]) {
    snprintf(text, DIP_MIP_TEXT_BYTES, "%s%d",
             index == 0                          ? "\u2265"
             : index == DIP_MIP_DEBUG_LEVELS - 1 ? "\u2264"
                                                 : "",
             1024 >> index);
}

// Returns the squared distance of a pixel from a colour. Light may have dimmed the pixel, so the
// function takes the brightness of the colour, from 0.3 to 1, that fits the pixel best.
static double distance_from(const uint8_t *pixel, const double colour[3]) {
    double product = 0.0, square = 1e-9, distance = 0.0;
    for (int c = 0; c < 3; c++) {
        product += pixel[c] * colour[c];
        square += colour[c] * colour[c];
    }
    const double wanted = product / square;
    const double light = wanted < 0.3 ? 0.3 : wanted > 1.0 ? 1.0 : wanted;
    for (int c = 0; c < 3; c++) {
        distance += (pixel[c] - light * colour[c]) * (pixel[c] - light * colour[c]);
    }
    return distance;
}

int dip_maps_mip_index(const DipMaps *maps, int pane, int x, int y) {
    enum { BLENDS = 4, FARTHEST = 60 };
    const DipMapWork *work = dip_maps_work(maps, pane);
    if (!work->mips || x < 0 || y < 0 || x >= work->width || y >= work->height) {
        return -1;
    }
    const uint8_t *pixel = work->mips + 4 * ((size_t)y * (size_t)work->width + (size_t)x);
    double least = FARTHEST * FARTHEST;
    int index = -1;
    for (int i = 0; i < BLENDS * (DIP_MIP_DEBUG_LEVELS - 1) + 1; i++) {
        const int level = dip_min(i / BLENDS, DIP_MIP_DEBUG_LEVELS - 2);
        const double part = (double)(i - level * BLENDS) / BLENDS;
        const uint8_t *a = dip_mip_debug_colour(level), *b = dip_mip_debug_colour(level + 1);
        const double colour[3] = {a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]),
                                  a[2] + part * (b[2] - a[2])};
        // A pixel may have a colour itself, or a brighter one that light has dimmed. The darker
        // colour comes first, and rounding must not prefer the brighter one.
        const double distance = distance_from(pixel, colour);
        if (distance < least - 1e-6) {
            least = distance;
            index = part < 0.5 ? level : level + 1;
        }
    }
    return index;
}
