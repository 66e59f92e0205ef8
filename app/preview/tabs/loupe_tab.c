// The loupe's tab: crops of both panes, and the figures of the pixel in their middle.
#include "app/preview/tabs/tabs.h"
#include "app/preview/tools/loupe.h"
#include "app/ui/style.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

enum { TEXT = 12, SMALL = 11, TINY = 10 }; // Sizes of letters.

// One pane's part of the tab.
typedef struct Part {
    DipUi *ui;
    DipWindow *window;
    DipLoupe *loupe;
    int pane;
    const DipSamplePattern *pattern;
    const DipSampleValue *samples; // NULL if the pixel's samples are not known.
    DipColour pixel;
    int x; // Where the next line of text begins.
    int y;
    int width;
} Part;

// --- figures -------------------------------------------------------------------------------------

enum { BOX_SIDE = 120 };

// Returns the colour of a pixel, which must lie inside the picture.
static DipColour pixel_of(const DipPixels *picture, int x, int y) {
    const uint8_t *rgba8 = picture->rgba8 + (size_t)y * picture->stride_bytes + 4 * (size_t)x;
    return (DipColour){rgba8[0], rgba8[1], rgba8[2], 255};
}

// Shows a line of text, and moves on to the next line.
static void say(Part *part, int size, DipColour colour, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

static void say(Part *part, int size, DipColour colour, const char *format, ...) {
    char line[160];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    dip_ui_text(part->ui, size, colour, DIP_ALIGN_LEFT, part->x, part->y, part->width, line);
    part->y += dip_ui_line_height(part->ui, size);
}

// Writes a number from 0 to 1 without its leading zero: ".761".
static const char *without_zero(double value, char text[16]) {
    snprintf(text, 16, "%.3f", value);
    return text[0] == '0' ? text + 1 : text;
}

static void say_linear(Part *part, int size) {
    char red[16], green[16], blue[16];
    say(part, size, dip_style_white, "%s %s %s",
        without_zero(dip_loupe_linear(part->loupe, part->pixel.red), red),
        without_zero(dip_loupe_linear(part->loupe, part->pixel.green), green),
        without_zero(dip_loupe_linear(part->loupe, part->pixel.blue), blue));
}

static void say_pixel(Part *part) {
    const DipColour *c = &part->pixel;
    say(part, SMALL, dip_style_white, "#%02X%02X%02X", c->red, c->green, c->blue);
    say(part, SMALL, dip_style_white, "%d %d %d", c->red, c->green, c->blue);
    say(part, TINY, dip_style_dim, "linear");
    say_linear(part, SMALL);
}

// Lists the samples' colours in two columns, if there is room down to `bottom`.
static void say_samples(Part *part, int bottom) {
    const int count = part->samples ? part->pattern->count : 0;
    const int line = dip_ui_line_height(part->ui, TINY);
    const int rows = (count + 1) / 2;
    if (count < 2 || part->y + line * (rows + 1) > bottom) {
        return;
    }
    say(part, TINY, dip_style_dim, "samples");
    const int top = part->y;
    const int half = dip_ui_px(part->ui, 60);
    for (int s = 0; s < count; ++s) {
        const DipColour colour = dip_loupe_colour(part->loupe, &part->samples[s]);
        char text[32];
        snprintf(text, sizeof text, "%d  %02X%02X%02X", s, colour.red, colour.green, colour.blue);
        dip_ui_text(part->ui, TINY, dip_style_white, DIP_ALIGN_LEFT, part->x + s / rows * half,
                    top + s % rows * line, half, text);
    }
    part->y = top + rows * line;
}

// Shows the first of several texts that fits, or the last one.
static void say_fitting(Part *part, const char *const *texts, int count) {
    int i = 0;
    while (i < count - 1 && dip_ui_text_width(part->ui, SMALL, texts[i]) > part->width) {
        ++i;
    }
    say(part, SMALL, dip_style_soft, "%s", texts[i]);
}

// Says how many samples the pixel has and what they show.
static void say_count(Part *part) {
    const int count = part->pattern->count;
    const bool temporal = part->window->state->quality[part->pane].step[DIP_SETTING_TAA] != 0;
    char longest[96];
    char text[64] = "1 sample, at the centre";
    char brief[32] = "1 sample";
    if (count > 1 && part->samples) {
        const DipSampleCount found = dip_loupe_count(part->samples, count);
        if (found.patches == 1) {
            snprintf(text, sizeof text, "%d samples, all on one surface", count);
            snprintf(brief, sizeof brief, "%d on one surface", count);
        } else {
            snprintf(text, sizeof text, "%d samples: %d in front, %d behind (dashed)", count,
                     found.front, count - found.front);
            snprintf(brief, sizeof brief, "%d samples, %d in front", count, found.front);
        }
    } else if (count > 1) {
        snprintf(text, sizeof text, "%d samples%s", count,
                 part->window->still ? "" : "; colours at rest");
        snprintf(brief, sizeof brief, "%d samples", count);
    }
    snprintf(longest, sizeof longest, "%s%s", text,
             temporal && count > 1 ? ", this frame's pattern" : "");
    const char *const texts[] = {longest, text, brief};
    say_fitting(part, texts, 3);
}

// Returns how far a colour is from another: the greatest difference of a channel.
static int distance(DipColour a, DipColour b) {
    const int red = abs(a.red - b.red);
    const int green = abs(a.green - b.green);
    const int blue = abs(a.blue - b.blue);
    return dip_max(red, dip_max(green, blue));
}

// Compares the pixel with the converged picture, if that is known.
static void say_truth(Part *part) {
    const DipWindow *window = part->window;
    const DipToolState *tools = &window->state->tools;
    const DipPixels *truth = window->truth;
    if (!truth || tools->x >= truth->width || tools->y >= truth->height) {
        return;
    }
    const DipColour true_pixel = pixel_of(truth, tools->x, tools->y);
    const DipColour other = pixel_of(&window->frames[1 - part->pane], tools->x, tools->y);
    const int off = distance(part->pixel, true_pixel);
    const int other_off = distance(other, true_pixel);
    char text[64];
    snprintf(text, sizeof text, "truth %d %d %d  ", true_pixel.red, true_pixel.green,
             true_pixel.blue);
    const int width = dip_ui_text_width(part->ui, SMALL, text);
    dip_ui_text(part->ui, SMALL, dip_style_white, DIP_ALIGN_LEFT, part->x, part->y, part->width,
                text);
    part->x += width;
    part->width -= width;
    say(part, SMALL,
        off < other_off   ? dip_style_gain
        : off > other_off ? dip_style_worse
                          : dip_style_soft,
        "off by %d", off);
    part->x -= width;
    part->width += width;
}

static void draw_box(Part *part, DipRect rect) {
    const DipBoxContent content = {part->pixel, part->pattern, part->samples, rect.width};
    DipPixels picture;
    uint64_t version;
    if (!dip_loupe_box_picture(part->loupe, part->pane, &content, &picture, &version)) {
        return;
    }
    dip_ui_picture(part->ui, rect, &picture, version);
    const int height = dip_ui_line_height(part->ui, TINY);
    for (int s = 0; s < part->pattern->count; ++s) {
        const DipColour ground =
            part->samples ? dip_loupe_colour(part->loupe, &part->samples[s]) : part->pixel;
        int x, y;
        char number[16];
        dip_loupe_box_position(part->pattern, rect.width, s, &x, &y);
        snprintf(number, sizeof number, "%d", s);
        dip_ui_text(part->ui, TINY, dip_style_contrast(ground), DIP_ALIGN_CENTRE, rect.x + x,
                    rect.y + y - height / 2, rect.width, number);
    }
}

// Shows the figures beside a crop, with the pixel's box if there is room for it.
static void show_details(Part *part, DipRect rect) {
    DipUi *ui = part->ui;
    const DipToolState *tools = &part->window->state->tools;
    const int gap = dip_ui_px(ui, 8);
    const int small = dip_ui_line_height(ui, SMALL);
    const int side = dip_ui_px(ui, BOX_SIDE);
    const DipColour name = part->pane == DIP_PANE_REQUESTED ? dip_style_accent : dip_style_white;
    const int bottom = rect.y + rect.height;
    part->x = rect.x + gap;
    part->y = rect.y;
    part->width = rect.width - gap;
    say(part, TEXT, name, "pixel %d, %d", tools->x, tools->y);
    const int top = part->y + dip_ui_px(ui, 2);
    const bool box =
        rect.width >= side + 2 * gap + dip_ui_px(ui, 80) && top + side + 2 * small <= bottom;
    if (box) {
        draw_box(part, (DipRect){rect.x + gap, top, side, side});
        part->x += side + gap;
        part->width -= side + gap;
    }
    part->y = top;
    if (top + 4 * small <= bottom) {
        say_pixel(part);
        say_samples(part, bottom);
    } else if (top + small <= bottom) {
        const DipColour *c = &part->pixel;
        say(part, SMALL, dip_style_white, "#%02X%02X%02X", c->red, c->green, c->blue);
    }
    if (box) {
        part->x = rect.x + gap;
        part->y = top + side + dip_ui_px(ui, 3);
        part->width = rect.width - gap;
    }
    if (part->y + small <= bottom) {
        say_count(part);
    }
    if (part->y + small <= bottom) {
        say_truth(part);
    }
}

// Shows the figures beneath a crop in a narrow tab: three lines, and the samples' colours if there
// is room for them.
static void show_brief(Part *part, DipRect rect) {
    const DipToolState *tools = &part->window->state->tools;
    const DipColour *c = &part->pixel;
    const DipColour name = part->pane == DIP_PANE_REQUESTED ? dip_style_accent : dip_style_white;
    const int gap = dip_ui_px(part->ui, 4);
    char pixel[48], rgb[48];
    part->x = rect.x + gap;
    part->y = rect.y;
    part->width = rect.width - gap;
    snprintf(pixel, sizeof pixel, "%d, %d", tools->x, tools->y);
    snprintf(rgb, sizeof rgb, "#%02X%02X%02X  %d %d %d", c->red, c->green, c->blue, c->red,
             c->green, c->blue);
    if (dip_ui_text_width(part->ui, SMALL, pixel) + dip_ui_text_width(part->ui, SMALL, rgb) +
            2 * gap >
        part->width) {
        rgb[7] = '\0'; // The hexadecimal code alone.
    }
    dip_ui_text(part->ui, SMALL, dip_style_white, DIP_ALIGN_RIGHT, rect.x + rect.width - gap,
                part->y, part->width, rgb);
    say(part, SMALL, name, "%s", pixel);
    char red[16], green[16], blue[16];
    say(part, SMALL, dip_style_white, "linear %s %s %s",
        without_zero(dip_loupe_linear(part->loupe, c->red), red),
        without_zero(dip_loupe_linear(part->loupe, c->green), green),
        without_zero(dip_loupe_linear(part->loupe, c->blue), blue));
    say_count(part);
    say_samples(part, rect.y + rect.height);
}

// Returns the height of the brief figures of a part with this rectangle: that of the three lines,
// and of the samples' colours if the crop above stays tall enough. Both panes get the same, so that
// their crops are alike.
static int brief_height(const Part *part, DipRect rect) {
    int most = 0;
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const DipQuality *quality = &part->window->state->quality[p];
        most = dip_max(most, dip_loupe_pattern(part->loupe, quality)->count);
    }
    const int lines = 3 * dip_ui_line_height(part->ui, SMALL);
    const int samples = most > 1 ? ((most + 1) / 2 + 1) * dip_ui_line_height(part->ui, TINY) : 0;
    return rect.height - lines - samples >= 2 * rect.width / 3 ? lines + samples : lines;
}

enum {
    HEAD_HEIGHT = 28,    // Of the row with buttons.
    DETAILS_WIDTH = 264, // Of a pixel's box and figures beside a crop.
    FIGURES_WIDTH = 128, // Of the figures alone.
    LEAST_CROP = 64,     // Width below which a crop has no text beside it.
    SAMPLES_ZOOM = 16,   // Zooms from which the crop marks samples.
};

enum { ID_ZOOM, ID_PIN = 8, ID_CROP };

static const int zooms[] = {2, 4, 8, 16, 32};

// --- crops ---------------------------------------------------------------------------------------

// The crop is a control: a click looks at the pixel under the pointer, the wheel zooms, and arrow
// keys move by one pixel.
static void handle_crop(Part *part, const DipLoupeCrop *crop) {
    DipToolState *tools = &part->window->state->tools;
    const DipPixels *frame = &part->window->frames[part->pane];
    const DipUiControl control = {
        .id = DIP_UI_ID(DIP_UI_LOUPE, ID_CROP + part->pane),
        .rect = crop->frame,
        .tip = "Click: look at this pixel. Wheel: zoom. Arrow keys: move by one pixel.",
        .takes_arrows = true,
        .takes_wheel = true};
    const DipUiInput input = dip_ui_control(part->ui, &control);
    if (dip_ui_is_drawing(part->ui)) {
        if (input.focused) {
            dip_ui_outline(part->ui, crop->frame, 0, dip_ui_px(part->ui, 2), dip_style_soft);
        }
        return;
    }
    int x, y;
    if (input.began && dip_loupe_pixel_at(crop->shown, crop->source.width, crop->source.height,
                                          input.x, input.y, &x, &y)) {
        dip_loupe_move(tools, crop->source.x + x - tools->x, crop->source.y + y - tools->y,
                       frame->width, frame->height);
    } else if (input.steps && input.hovered) {
        dip_loupe_zoom(tools, input.steps);
    } else if (input.steps) {
        dip_loupe_move(tools, input.steps, 0, frame->width, frame->height);
    }
}

// Tells the loupe which samples the crops need: those of all pixels if the crops mark them,
// otherwise those of the one pixel.
static void want_samples(const Part *part, const DipLoupeCrop *crop) {
    const DipToolState *tools = &part->window->state->tools;
    const DipRect *source = &crop->source;
    DipTargetRegion region = {tools->x, tools->y, tools->x + 1, tools->y + 1};
    if (crop->zoom >= SAMPLES_ZOOM && !dip_rect_is_empty(*source)) {
        region = (DipTargetRegion){source->x, source->y, source->x + source->width,
                                   source->y + source->height};
    }
    dip_loupe_want(part->loupe, region);
}

static void draw_crop(Part *part, DipRect area) {
    const DipToolState *tools = &part->window->state->tools;
    const DipPixels *frame = &part->window->frames[part->pane];
    DipCropContent content = {.frame = *frame, .version = part->window->versions[part->pane]};
    content.crop =
        dip_loupe_crop(frame->width, frame->height, tools->x, tools->y, tools->zoom, area);
    if (dip_rect_is_empty(content.crop.frame)) {
        return;
    }
    DipPixels picture;
    uint64_t version;
    if (dip_ui_is_drawing(part->ui)) {
        want_samples(part, &content.crop);
        if (dip_loupe_crop_picture(part->loupe, part->pane, &content, &picture, &version)) {
            dip_ui_picture(part->ui, content.crop.frame, &picture, version);
        }
        dip_ui_mark(part->ui, content.crop.pixel,
                    part->pane == DIP_PANE_REQUESTED ? dip_style_accent : dip_style_white);
    }
    handle_crop(part, &content.crop);
}

// Divides a pane's part of the tab into the crop and the details, whichever fit.
static void declare_part(DipUi *ui, DipWindow *window, int pane, DipRect rect) {
    const DipToolState *tools = &window->state->tools;
    Part part = {.ui = ui, .window = window, .loupe = window->tools->loupe, .pane = pane};
    part.pattern = dip_loupe_pattern(part.loupe, &window->state->quality[pane]);
    const DipSamplePattern *pattern = part.pattern;
    part.samples =
        dip_loupe_samples(part.loupe, pane, window->versions[pane], tools->x, tools->y, &pattern);
    part.pattern = part.samples ? pattern : part.pattern;
    part.pixel = pixel_of(&window->frames[pane], tools->x, tools->y);
    const int least = dip_ui_px(ui, LEAST_CROP);
    const int details = rect.width - dip_ui_px(ui, DETAILS_WIDTH) >= least
                            ? dip_ui_px(ui, DETAILS_WIDTH)
                            : dip_ui_px(ui, FIGURES_WIDTH);
    const int brief = brief_height(&part, rect);
    DipRect crop = rect;
    DipRect text = rect;
    if (rect.width - details < 2 * least && rect.height >= least + brief) {
        crop.height -= brief;
        text.y += crop.height;
        text.height = brief;
        draw_crop(&part, crop);
        show_brief(&part, text);
    } else if (rect.width - details >= least) {
        crop.width -= details;
        text.x += crop.width;
        text.width = details;
        draw_crop(&part, crop);
        show_details(&part, text);
    } else if (rect.height >= 2 * least) {
        crop.height = rect.height / 2;
        text.y += crop.height + dip_ui_px(ui, 4);
        text.height -= crop.height + dip_ui_px(ui, 4);
        draw_crop(&part, crop);
        show_details(&part, text);
    } else {
        draw_crop(&part, crop);
    }
}

// --- the tab -------------------------------------------------------------------------------------

// Declares a button at *x and moves *x behind it. Returns whether it was pressed, or false if it
// does not fit.
static bool row_button(DipUi *ui, unsigned id, int *x, DipRect row, const char *text,
                       DipUiLook look, const char *tip) {
    const int padding = dip_ui_px(ui, row.width < dip_ui_px(ui, 300) ? 4 : 8);
    const int width = dip_ui_text_width(ui, TEXT, text) + 2 * padding;
    const DipRect rect = {*x, row.y, width, row.height};
    if (rect.x + rect.width > row.x + row.width) {
        return false;
    }
    *x += width + dip_ui_px(ui, 4);
    return dip_ui_button(ui, DIP_UI_ID(DIP_UI_LOUPE, id), rect, text, look, tip);
}

static void declare_head(DipUi *ui, DipWindow *window, DipRect row) {
    DipToolState *tools = &window->state->tools;
    int x = row.x;
    for (int i = 0; i < (int)(sizeof zooms / sizeof *zooms); ++i) {
        char text[8];
        snprintf(text, sizeof text, "%dx", zooms[i]);
        if (row_button(ui, (unsigned)(ID_ZOOM + i), &x, row, text,
                       tools->zoom == zooms[i] ? DIP_UI_CHOSEN : DIP_UI_PLAIN,
                       "Shows each pixel of the panes this many times as large.")) {
            tools->zoom = zooms[i];
        }
    }
    x += dip_ui_px(ui, 8);
    if (row_button(ui, ID_PIN, &x, row, tools->pinned ? "Pinned" : "Follows the pointer",
                   tools->pinned ? DIP_UI_CHOSEN : DIP_UI_PLAIN,
                   "A pinned loupe keeps its pixel. A right click on a pane pins a pixel.")) {
        tools->pinned = !tools->pinned;
    }
    const char *note = tools->pinned ? "arrow keys: one pixel" : "right click: pin a pixel";
    const int room = row.x + row.width - x - dip_ui_px(ui, 8);
    if (room >= dip_ui_text_width(ui, SMALL, note)) {
        const int height = dip_ui_line_height(ui, SMALL);
        dip_ui_text(ui, SMALL, dip_style_dim, DIP_ALIGN_RIGHT, row.x + row.width,
                    row.y + (row.height - height) / 2, room, note);
    }
}

// Returns the part of the tab that lies beneath a pane, or a half of the tab if the tab lies beside
// the panes.
static DipRect half_of(const DipLayout *layout, DipRect body, int pane) {
    DipRect half = body;
    if (layout->side == DIP_DOCK_BELOW) {
        const DipRect *under = &layout->panes[pane];
        half.x = under->x > body.x ? under->x : body.x;
        half.width = dip_min(under->x + under->width, body.x + body.width) - half.x;
    } else if (body.height >= body.width / 2) {
        half.height = body.height / 2 - 2;
        half.y += pane == DIP_PANE_REQUESTED ? body.height - half.height : 0;
    } else {
        half.width = body.width / 2 - 2;
        half.x += pane == DIP_PANE_REQUESTED ? body.width - half.width : 0;
    }
    return half;
}

void dip_tab_loupe(DipUi *ui, DipWindow *window, DipRect body) {
    const int head = dip_ui_px(ui, HEAD_HEIGHT);
    const int gap = dip_ui_px(ui, 4);
    if (window->frames[0].width < 1 || window->frames[1].width < 1) {
        return;
    }
    dip_loupe_keep_inside(&window->state->tools, window->frames[DIP_PANE_CURRENT].width,
                          window->frames[DIP_PANE_CURRENT].height);
    if (body.height >= 3 * head) {
        declare_head(ui, window,
                     (DipRect){body.x + 2 * gap, body.y + gap, body.width - 4 * gap, head - gap});
        body.y += head + gap;
        body.height -= head + gap;
    }
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        declare_part(ui, window, p, half_of(window->layout, body, p));
    }
}
