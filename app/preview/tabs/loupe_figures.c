// The figures of the loupe's pixel: its colour, its samples and the truth.
#include "app/preview/tabs/loupe_tab_private.h"
#include "app/ui/style.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

enum { BOX_SIDE = 120 };

DipColour dip_loupe_pixel(const DipPixels *picture, int x, int y) {
    const uint8_t *rgba8 = picture->rgba8 + (size_t)y * picture->stride_bytes + 4 * (size_t)x;
    return (DipColour){rgba8[0], rgba8[1], rgba8[2], 255};
}

// Shows a line of text, and moves on to the next line.
static void say(DipLoupePart *part, int size, DipColour colour, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

static void say(DipLoupePart *part, int size, DipColour colour, const char *format, ...) {
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

static void say_linear(DipLoupePart *part, int size) {
    char red[16], green[16], blue[16];
    say(part, size, dip_style_white, "%s %s %s",
        without_zero(dip_loupe_linear(part->loupe, part->pixel.red), red),
        without_zero(dip_loupe_linear(part->loupe, part->pixel.green), green),
        without_zero(dip_loupe_linear(part->loupe, part->pixel.blue), blue));
}

static void say_pixel(DipLoupePart *part) {
    const DipColour *c = &part->pixel;
    say(part, DIP_LOUPE_SMALL, dip_style_white, "#%02X%02X%02X", c->red, c->green, c->blue);
    say(part, DIP_LOUPE_SMALL, dip_style_white, "%d %d %d", c->red, c->green, c->blue);
    say(part, DIP_LOUPE_TINY, dip_style_dim, "linear");
    say_linear(part, DIP_LOUPE_SMALL);
}

// Lists the samples' colours in two columns, if there is room down to `bottom`.
static void say_samples(DipLoupePart *part, int bottom) {
    const int count = part->samples ? part->pattern->count : 0;
    const int line = dip_ui_line_height(part->ui, DIP_LOUPE_TINY);
    const int rows = (count + 1) / 2;
    if (count < 2 || part->y + line * (rows + 1) > bottom) {
        return;
    }
    say(part, DIP_LOUPE_TINY, dip_style_dim, "samples");
    const int top = part->y;
    const int half = dip_ui_px(part->ui, 60);
    for (int s = 0; s < count; ++s) {
        const uint16_t *light = part->samples[s].linear16;
        char text[32];
        snprintf(text, sizeof text, "%d  %02X%02X%02X", s, dip_loupe_code(part->loupe, light[0]),
                 dip_loupe_code(part->loupe, light[1]), dip_loupe_code(part->loupe, light[2]));
        dip_ui_text(part->ui, DIP_LOUPE_TINY, dip_style_white, DIP_ALIGN_LEFT,
                    part->x + s / rows * half, top + s % rows * line, half, text);
    }
    part->y = top + rows * line;
}

// Shows the first of several texts that fits, or the last one.
static void say_fitting(DipLoupePart *part, const char *const *texts, int count) {
    int i = 0;
    while (i < count - 1 && dip_ui_text_width(part->ui, DIP_LOUPE_SMALL, texts[i]) > part->width) {
        ++i;
    }
    say(part, DIP_LOUPE_SMALL, dip_style_soft, "%s", texts[i]);
}

// Says how many samples the pixel has and what they show.
static void say_count(DipLoupePart *part) {
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
static void say_truth(DipLoupePart *part) {
    const DipWindow *window = part->window;
    const DipToolState *tools = &window->state->tools;
    const DipPixels *truth = window->truth;
    if (!truth || tools->x >= truth->width || tools->y >= truth->height) {
        return;
    }
    const DipColour true_pixel = dip_loupe_pixel(truth, tools->x, tools->y);
    const DipColour other = dip_loupe_pixel(&window->frames[1 - part->pane], tools->x, tools->y);
    const int off = distance(part->pixel, true_pixel);
    const int other_off = distance(other, true_pixel);
    char text[64];
    snprintf(text, sizeof text, "truth %d %d %d  ", true_pixel.red, true_pixel.green,
             true_pixel.blue);
    const int width = dip_ui_text_width(part->ui, DIP_LOUPE_SMALL, text);
    dip_ui_text(part->ui, DIP_LOUPE_SMALL, dip_style_white, DIP_ALIGN_LEFT, part->x, part->y,
                part->width, text);
    part->x += width;
    part->width -= width;
    say(part, DIP_LOUPE_SMALL,
        off < other_off   ? dip_style_gain
        : off > other_off ? dip_style_worse
                          : dip_style_soft,
        "off by %d", off);
    part->x -= width;
    part->width += width;
}

static void draw_box(DipLoupePart *part, DipRect rect) {
    const DipBoxContent content = {part->pixel, part->pattern, part->samples, rect.width};
    DipPixels picture;
    uint64_t version;
    if (!dip_loupe_box_picture(part->loupe, part->pane, &content, &picture, &version)) {
        return;
    }
    dip_ui_picture(part->ui, rect, &picture, version);
    const int height = dip_ui_line_height(part->ui, DIP_LOUPE_TINY);
    for (int s = 0; s < part->pattern->count; ++s) {
        const uint16_t *light = part->samples ? part->samples[s].linear16 : NULL;
        const DipColour ground = light ? (DipColour){dip_loupe_code(part->loupe, light[0]),
                                                     dip_loupe_code(part->loupe, light[1]),
                                                     dip_loupe_code(part->loupe, light[2]), 255}
                                       : part->pixel;
        int x, y;
        char number[16];
        dip_loupe_box_position(part->pattern, rect.width, s, &x, &y);
        snprintf(number, sizeof number, "%d", s);
        dip_ui_text(part->ui, DIP_LOUPE_TINY, dip_style_contrast(ground), DIP_ALIGN_CENTRE,
                    rect.x + x, rect.y + y - height / 2, rect.width, number);
    }
}

void dip_loupe_show_details(DipLoupePart *part, DipRect rect) {
    DipUi *ui = part->ui;
    const DipToolState *tools = &part->window->state->tools;
    const int gap = dip_ui_px(ui, 8);
    const int small = dip_ui_line_height(ui, DIP_LOUPE_SMALL);
    const int side = dip_ui_px(ui, BOX_SIDE);
    const DipColour name = part->pane == DIP_PANE_REQUESTED ? dip_style_accent : dip_style_white;
    const int bottom = rect.y + rect.height;
    part->x = rect.x + gap;
    part->y = rect.y;
    part->width = rect.width - gap;
    say(part, DIP_LOUPE_TEXT, name, "pixel %d, %d", tools->x, tools->y);
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
        say(part, DIP_LOUPE_SMALL, dip_style_white, "#%02X%02X%02X", c->red, c->green, c->blue);
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

void dip_loupe_show_brief(DipLoupePart *part, DipRect rect) {
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
    if (dip_ui_text_width(part->ui, DIP_LOUPE_SMALL, pixel) +
            dip_ui_text_width(part->ui, DIP_LOUPE_SMALL, rgb) + 2 * gap >
        part->width) {
        rgb[7] = '\0'; // The hexadecimal code alone.
    }
    dip_ui_text(part->ui, DIP_LOUPE_SMALL, dip_style_white, DIP_ALIGN_RIGHT,
                rect.x + rect.width - gap, part->y, part->width, rgb);
    say(part, DIP_LOUPE_SMALL, name, "%s", pixel);
    char red[16], green[16], blue[16];
    say(part, DIP_LOUPE_SMALL, dip_style_white, "linear %s %s %s",
        without_zero(dip_loupe_linear(part->loupe, c->red), red),
        without_zero(dip_loupe_linear(part->loupe, c->green), green),
        without_zero(dip_loupe_linear(part->loupe, c->blue), blue));
    say_count(part);
    say_samples(part, rect.y + rect.height);
}

int dip_loupe_brief_height(const DipLoupePart *part, DipRect rect) {
    int most = 0;
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const DipQuality *quality = &part->window->state->quality[p];
        most = dip_max(most, dip_loupe_pattern(part->loupe, quality)->count);
    }
    const int lines = 3 * dip_ui_line_height(part->ui, DIP_LOUPE_SMALL);
    const int samples =
        most > 1 ? ((most + 1) / 2 + 1) * dip_ui_line_height(part->ui, DIP_LOUPE_TINY) : 0;
    return rect.height - lines - samples >= 2 * rect.width / 3 ? lines + samples : lines;
}
