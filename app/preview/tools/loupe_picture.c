// Draws the loupe's pictures (loupe.h): the crop with enlarged pixels, and the box with the samples
// of one pixel.
#include "app/preview/tools/loupe.h"
#include "app/ui/style.h"

#include <math.h>

// Greatest width and height of a disc, in pixels. Larger discs are cut off.
enum { MASK_SIDE = 64 };

// --- the crop ------------------------------------------------------------------------------------

// Marks a sample of a pixel whose square has its top left corner at x, y. The mark is a square with
// a white border. The square has the sample's colour if it is large enough; otherwise it is dark.
static void mark_sample(const DipLoupe *loupe, DipCanvas *canvas, int x, int y, int zoom,
                        const DipSamplePattern *pattern, int s, const DipSampleValue *sample) {
    const int core = zoom / 8;
    const int left = x + pattern->x[s] * zoom / 256 - core / 2;
    const int top = y + pattern->y[s] * zoom / 256 - core / 2;
    const bool coloured = core >= 4;
    const DipColour own = dip_loupe_colour(loupe, sample);
    dip_canvas_fill(canvas, (DipRect){left - 1, top - 1, core + 2, core + 2}, dip_style_white);
    dip_canvas_fill(canvas, (DipRect){left, top, core, core}, coloured ? own : dip_style_dark);
}

static void mark_samples(const DipLoupe *loupe, int pane, const DipCropContent *content,
                         DipCanvas *canvas) {
    const DipLoupeCrop *crop = &content->crop;
    const DipRect *source = &crop->source;
    for (int y = source->y; y < source->y + source->height; ++y) {
        for (int x = source->x; x < source->x + source->width; ++x) {
            const DipSamplePattern *pattern;
            const DipSampleValue *samples =
                dip_loupe_samples(loupe, pane, content->version, x, y, &pattern);
            if (!samples || dip_loupe_count(samples, pattern->count).patches < 2) {
                continue;
            }
            const int left = crop->shown.x - crop->frame.x + (x - source->x) * crop->zoom;
            const int top = crop->shown.y - crop->frame.y + (y - source->y) * crop->zoom;
            for (int s = 0; s < pattern->count; ++s) {
                mark_sample(loupe, canvas, left, top, crop->zoom, pattern, s, &samples[s]);
            }
        }
    }
}

static bool draw_crop(const DipLoupe *loupe, int pane, const DipCropContent *content,
                      DipCanvas *canvas) {
    const DipLoupeCrop *crop = &content->crop;
    if (!dip_canvas_resize(canvas, crop->frame.width, crop->frame.height, NULL)) {
        return false;
    }
    const DipRect all = {0, 0, crop->frame.width, crop->frame.height};
    dip_canvas_fill(canvas, all, dip_style_well);
    if (!dip_rect_is_empty(crop->source)) {
        const DipPixels part = dip_pixels_part(&content->frame, crop->source);
        const DipRect shown = {crop->shown.x - crop->frame.x, crop->shown.y - crop->frame.y,
                               crop->shown.width, crop->shown.height};
        dip_canvas_copy(canvas, shown, &part);
    }
    if (crop->zoom >= DIP_LOUPE_MARKS_ZOOM) {
        mark_samples(loupe, pane, content, canvas);
    }
    return true;
}

bool dip_loupe_crop_picture(DipLoupe *loupe, int pane, const DipCropContent *content,
                            DipPixels *picture, uint64_t *version) {
    DipPaneSamples *held = &loupe->panes[pane];
    DipHash hash = dip_hash_begin(0);
    dip_hash_text(&hash, "crop");
    dip_hash_integer(&hash, (int64_t)content->version);
    dip_hash_integer(&hash, loupe->generation);
    dip_hash_bytes(&hash, &content->crop, sizeof content->crop);
    if (dip_kept_begin(&held->crop, &hash)) {
        held->crop.known = draw_crop(loupe, pane, content, &held->crop.canvas);
    }
    return dip_kept_show(&held->crop, picture, version);
}

// --- the box -------------------------------------------------------------------------------------

// Returns the width of the margin around the pixel's square. Discs near the square's edges reach
// into the margin.
static int box_margin(int side) {
    return side / 12;
}

// Converts a position in the pixel, in 1/256 of the pixel's width, to a distance from the picture's
// edge.
static int box_position(int side, int position) {
    const int margin = box_margin(side);
    return margin + (position * (side - 2 * margin) + 128) / 256;
}

void dip_loupe_box_position(const DipSamplePattern *pattern, int side, int sample, int *x, int *y) {
    *x = box_position(side, pattern->x[sample]);
    *y = box_position(side, pattern->y[sample]);
}

static double coverage(double edge, double distance) {
    const double inside = edge - distance + 0.5;
    return inside <= 0.0 ? 0.0 : inside >= 1.0 ? 1.0 : inside;
}

// Draws a disc with the radius `outer`, or a ring if the inner radius `inner` is above 0. dashes:
// number of gaps in the ring, or 0.
static void draw_disc(DipCanvas *canvas, int x, int y, double outer, double inner, int dashes,
                      DipColour colour) {
    uint8_t mask[MASK_SIDE * MASK_SIDE];
    const int reach = dip_min((int)outer + 2, MASK_SIDE / 2);
    const int side = 2 * reach;
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            const double dx = j - reach + 0.5;
            const double dy = i - reach + 0.5;
            const double distance = sqrt(dx * dx + dy * dy);
            double covered = coverage(outer, distance);
            if (inner > 0.0) {
                covered -= coverage(inner, distance);
            }
            if (dashes) {
                const double turns = atan2(dy, dx) * dashes / 6.283185307179586;
                covered = turns - floor(turns) < 0.5 ? covered : 0.0;
            }
            mask[i * side + j] = (uint8_t)(255.0 * covered + 0.5);
        }
    }
    dip_canvas_mask(canvas, x - reach, y - reach, side, side, mask, colour);
}

static void draw_grid(DipCanvas *canvas, DipColour ground, int side, int cells) {
    const DipColour edge = dip_style_contrast(ground);
    const DipColour line = {edge.red, edge.green, edge.blue, 60};
    const int first = box_position(side, 0);
    const int last = box_position(side, 256);
    const int length = last - first;
    for (int i = 0; i <= cells; ++i) {
        const bool outer = i == 0 || i == cells;
        const int at = first + (2 * length * i + cells) / (2 * cells) - (i == cells);
        dip_canvas_fill(canvas, (DipRect){at, first, 1, length}, outer ? dip_style_white : line);
        dip_canvas_fill(canvas, (DipRect){first, at, length, 1}, outer ? dip_style_white : line);
    }
}

static void draw_sample(const DipLoupe *loupe, DipCanvas *canvas, const DipBoxContent *content,
                        int s) {
    const int count = content->pattern->count;
    const double radius = content->side / (count <= 4 ? 10.0 : 14.0);
    const double ring = radius > 8.0 ? 2.0 : 1.5;
    const bool front = !content->samples || dip_loupe_is_front(content->samples, count, s);
    int x, y;
    dip_loupe_box_position(content->pattern, content->side, s, &x, &y);
    const DipColour fill =
        content->samples ? dip_loupe_colour(loupe, &content->samples[s]) : content->pixel;
    draw_disc(canvas, x, y, radius + 1.0, 0.0, 0, dip_style_dark);
    draw_disc(canvas, x, y, radius, 0.0, 0, front ? dip_style_white : dip_style_dark);
    draw_disc(canvas, x, y, radius - ring, 0.0, 0, fill);
    if (!front) {
        draw_disc(canvas, x, y, radius, radius - ring, 8, dip_style_white);
    }
}

static bool draw_box(const DipLoupe *loupe, const DipBoxContent *content, DipCanvas *canvas) {
    const int count = content->pattern->count;
    if (!dip_canvas_resize(canvas, content->side, content->side, NULL)) {
        return false;
    }
    const DipRect all = {0, 0, content->side, content->side};
    const int first = box_position(content->side, 0);
    const int length = box_position(content->side, 256) - first;
    dip_canvas_fill(canvas, all, dip_style_dock);
    dip_canvas_fill(canvas, (DipRect){first, first, length, length}, content->pixel);
    draw_grid(canvas, content->pixel, content->side, count <= 4 ? 4 : count);
    for (int s = 0; s < count; ++s) {
        draw_sample(loupe, canvas, content, s);
    }
    return true;
}

bool dip_loupe_box_picture(DipLoupe *loupe, int pane, const DipBoxContent *content,
                           DipPixels *picture, uint64_t *version) {
    DipPaneSamples *held = &loupe->panes[pane];
    DipHash hash = dip_hash_begin(0);
    dip_hash_text(&hash, "box");
    dip_hash_integer(&hash, (intptr_t)content->pattern);
    dip_hash_integer(&hash, content->side);
    dip_hash_bytes(&hash, &content->pixel, sizeof content->pixel);
    for (int s = 0; content->samples && s < content->pattern->count; ++s) {
        const DipSampleValue *sample = &content->samples[s];
        dip_hash_bytes(&hash, sample->linear16, sizeof sample->linear16);
        dip_hash_integer(&hash, sample->patch);
        dip_hash_number(&hash, (double)sample->depth);
    }
    if (dip_kept_begin(&held->box, &hash)) {
        held->box.known = draw_box(loupe, content, &held->box.canvas);
    }
    return dip_kept_show(&held->box, picture, version);
}
