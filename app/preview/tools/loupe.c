// Finds the pixels that the loupe shows, and reads their samples.
#include "app/preview/tools/loupe.h"

#include <stdlib.h>
#include <string.h>

// --- arithmetic --------------------------------------------------------------------------------

// Returns the largest odd number of squares, `zoom` pixels wide, that fit into `length` pixels;
// below 1 if none fits.
static int odd_count(int length, int zoom) {
    const int count = length / zoom;
    return count % 2 ? count : count - 1;
}

DipLoupeCrop dip_loupe_crop(int width, int height, int x, int y, int zoom, DipRect area) {
    const int columns = odd_count(area.width, zoom);
    const int rows = odd_count(area.height, zoom);
    DipLoupeCrop crop = {.zoom = zoom};
    if (columns < 1 || rows < 1) {
        return crop;
    }
    const int x0 = x - columns / 2;
    const int y0 = y - rows / 2;
    crop.source =
        dip_rect_intersect((DipRect){x0, y0, columns, rows}, (DipRect){0, 0, width, height});
    crop.frame = (DipRect){area.x, area.y, columns * zoom, rows * zoom};
    crop.shown =
        (DipRect){area.x + (crop.source.x - x0) * zoom, area.y + (crop.source.y - y0) * zoom,
                  crop.source.width * zoom, crop.source.height * zoom};
    crop.pixel = (DipRect){area.x + columns / 2 * zoom, area.y + rows / 2 * zoom, zoom, zoom};
    return crop;
}

// A row of `from` pixels is scaled to `to` pixels as by dip_canvas_copy. Returns the index of the
// original pixel that the scaled row's pixel i shows.
static int scaled(int i, int from, int to) {
    return (int)((2 * (int64_t)i + 1) * from / (2 * (int64_t)to));
}

bool dip_loupe_pixel_at(DipRect shown, int width, int height, int window_x, int window_y, int *x,
                        int *y) {
    if (!dip_rect_holds(shown, window_x, window_y) || width < 1 || height < 1) {
        return false;
    }
    *x = scaled(window_x - shown.x, width, shown.width);
    *y = scaled(window_y - shown.y, height, shown.height);
    return true;
}

// The inverse of scaled(): returns the least k such that pixel k of the scaled row shows the
// original pixel i or a later one.
static int first_showing(int i, int from, int to) {
    const int64_t twice = 2 * (int64_t)to * i - from; // (2 * k + 1) * from >= 2 * to * i
    return twice <= 0 ? 0 : (int)((twice + 2 * (int64_t)from - 1) / (2 * (int64_t)from));
}

DipRect dip_loupe_mark(DipRect shown, int width, int height, DipRect source) {
    const int x0 = first_showing(source.x, width, shown.width);
    const int y0 = first_showing(source.y, height, shown.height);
    const int x1 = first_showing(source.x + source.width, width, shown.width);
    const int y1 = first_showing(source.y + source.height, height, shown.height);
    return (DipRect){shown.x + x0, shown.y + y0, x1 - x0, y1 - y0};
}

static int clamped(int value, int count) {
    return dip_max(0, dip_min(value, count - 1));
}

void dip_loupe_move(DipToolState *tools, int dx, int dy, int width, int height) {
    tools->pinned = true;
    tools->x = clamped(tools->x + dx, width);
    tools->y = clamped(tools->y + dy, height);
}

void dip_loupe_keep_inside(DipToolState *tools, int width, int height) {
    const bool nowhere = tools->x < 0 || tools->y < 0;
    tools->x = nowhere ? width / 2 : clamped(tools->x, width);
    tools->y = nowhere ? height / 2 : clamped(tools->y, height);
}

bool dip_loupe_is_on(const DipToolState *tools) {
    return tools->loupe || (tools->open && tools->tab == DIP_TAB_LOUPE);
}

static int nearest_sample(const DipSampleValue *samples, int count) {
    int nearest = 0;
    for (int s = 1; s < count; ++s) {
        nearest = samples[s].depth > samples[nearest].depth ? s : nearest;
    }
    return nearest;
}

bool dip_loupe_is_front(const DipSampleValue *samples, int count, int sample) {
    return samples[sample].patch == samples[nearest_sample(samples, count)].patch;
}

DipSampleCount dip_loupe_count(const DipSampleValue *samples, int count) {
    DipSampleCount result = {.front = 0};
    const uint32_t front = samples[nearest_sample(samples, count)].patch;
    for (int s = 0; s < count; ++s) {
        bool seen = false, coloured = false;
        for (int before = 0; before < s; ++before) {
            seen = seen || samples[before].patch == samples[s].patch;
            coloured = coloured || memcmp(samples[before].linear16, samples[s].linear16,
                                          sizeof samples[s].linear16) == 0;
        }
        result.patches += !seen;
        result.colours += !coloured;
        result.front += samples[s].patch == front;
    }
    return result;
}

// --- memory ------------------------------------------------------------------------------------

void dip_loupe_free(DipLoupe *loupe) {
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        free(loupe->panes[p].samples);
        dip_canvas_free(&loupe->panes[p].crop.canvas);
        dip_canvas_free(&loupe->panes[p].box.canvas);
    }
}

void dip_loupe_want(DipLoupe *loupe, DipTargetRegion region) {
    loupe->wanted = region;
}

// Returns whether reading a pane's samples has been tried already for this picture and region.
static bool is_current(const DipPaneSamples *held, uint64_t version,
                       const DipTargetRegion *region) {
    return held->tried && held->version == version &&
           memcmp(&held->region, region, sizeof *region) == 0;
}

static bool make_room(DipPaneSamples *held, size_t count) {
    if (count <= held->capacity) {
        return true;
    }
    DipSampleValue *grown = realloc(held->samples, count * sizeof *grown);
    if (grown) {
        held->samples = grown;
        held->capacity = count;
    }
    return grown != NULL;
}

static bool read_pane(DipLoupe *loupe, int pane, const DipToolsInput *input) {
    DipPaneSamples *held = &loupe->panes[pane];
    const size_t count = dip_sample_room(&loupe->wanted);
    held->tried = true;
    held->version = input->versions[pane];
    held->region = loupe->wanted;
    held->known = false;
    if (!make_room(held, count)) {
        return false;
    }
    const DipPaneSamples *current = &loupe->panes[DIP_PANE_CURRENT];
    if (pane == DIP_PANE_REQUESTED && input->copied && current->known) {
        memcpy(held->samples, current->samples, count * sizeof *held->samples);
        held->known = true;
        return true;
    }
    const DipSampleReadback readback = {loupe->wanted, held->samples};
    held->known = dip_painter_read_samples(input->session->renderers[pane], input->session->scene,
                                           input->pose, input->play_ns, &readback, NULL);
    return held->known;
}

bool dip_loupe_update(DipLoupe *loupe, const DipToolsInput *input) {
    loupe->frame_index = input->frame_index;
    const DipTargetRegion *wanted = &loupe->wanted;
    const bool is_wanted = wanted->x0 < wanted->x1 && wanted->y0 < wanted->y1;
    if (!is_wanted || !input->loupe || !input->still || wanted->x0 < 0 || wanted->y0 < 0 ||
        wanted->x1 > input->width || wanted->y1 > input->height) {
        return false;
    }
    bool read = false;
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        if (!is_current(&loupe->panes[p], input->versions[p], wanted)) {
            const DipQuality quality = dip_painter_quality(input->session->renderers[p]);
            loupe->panes[p].pattern = dip_loupe_pattern(loupe, &quality);
            read = read_pane(loupe, p, input) || read;
            ++loupe->generation;
        }
    }
    return read;
}

const DipSampleValue *dip_loupe_samples(const DipLoupe *loupe, int pane, uint64_t version, int x,
                                        int y, const DipSamplePattern **pattern) {
    const DipPaneSamples *held = &loupe->panes[pane];
    const DipTargetRegion *region = &held->region;
    if (!held->known || held->version != version || x < region->x0 || x >= region->x1 ||
        y < region->y0 || y >= region->y1) {
        return NULL;
    }
    *pattern = held->pattern;
    return held->samples + dip_sample_index(region, x, y);
}

const DipSamplePattern *dip_loupe_pattern(const DipLoupe *loupe, const DipQuality *quality) {
    const bool temporal = dip_quality_alternates(quality);
    return dip_sample_pattern_of(dip_quality_sample_count(quality),
                                 dip_pattern_kind(temporal, loupe->frame_index));
}

DipColour dip_loupe_colour(const DipLoupe *loupe, const DipSampleValue *sample) {
    const DipSrgbEncodeTable *encode = &loupe->encode;
    const uint16_t *light = sample->linear16;
    return (DipColour){dip_srgb_code(encode, light[0]), dip_srgb_code(encode, light[1]),
                       dip_srgb_code(encode, light[2]), 255};
}

double dip_loupe_linear(const DipLoupe *loupe, uint8_t code) {
    return loupe->decode.linear[code];
}
