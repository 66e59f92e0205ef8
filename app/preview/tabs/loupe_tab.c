// Declares the loupe's tab: an enlarged crop of each pane, and figures of the pixel in its middle.
#include "app/files/put.h"
#include "app/preview/tabs/tabs.h"
#include "app/preview/tools/loupe.h"
#include "app/ui/layout.h"
#include "app/ui/style.h"

#include <stdio.h>
#include <stdlib.h>

// TEXT, SMALL and TINY are letter sizes. All sizes and lengths are at scale 1.
enum {
    TEXT = 12,
    SMALL = 11,
    TINY = 10,
    BOX_SIDE = 120,
    HEAD_HEIGHT = 28,    // Height of the row with buttons.
    DETAILS_WIDTH = 264, // Width of a pixel's box and figures beside a crop.
    FIGURES_WIDTH = 128, // Width of the figures without the box.
    LEAST_CROP = 64,     // Least width of a crop that has text beside it.
};

enum { ID_ZOOM, ID_PIN = 8, ID_CROP };

// One pane's part of the tab.
typedef struct Part {
    DipUi *ui;
    DipWindow *window;
    DipLoupe *loupe;
    int pane;
    const DipSamplePattern *pattern;
    const DipSampleValue *samples; // NULL if the pixel's samples are not known.
    DipColour pixel;
    DipColour own; // The colour that stands for the pane.
    DipRect rest;  // The room below the lines of text so far.
} Part;

// --- figures -------------------------------------------------------------------------------------

// Returns the colour of a pixel, which must lie inside the picture.
static DipColour pixel_of(const DipPixels *picture, int x, int y) {
    const uint8_t *rgba8 = picture->rgba8 + (size_t)y * picture->stride_bytes + 4 * (size_t)x;
    return (DipColour){rgba8[0], rgba8[1], rgba8[2], 255};
}

// Writes the pixel's linear light, from 0 to 1: ".761 .102 .000".
static void format_linear(const Part *part, char text[32]) {
    const uint8_t codes[3] = {part->pixel.red, part->pixel.green, part->pixel.blue};
    text[0] = '\0';
    for (int c = 0; c < 3; ++c) {
        char number[16];
        snprintf(number, sizeof number, "%.3f", dip_loupe_linear(part->loupe, codes[c]));
        dip_put_append(text, 32, "%s%s", c ? " " : "", number + (number[0] == '0'));
    }
}

// Writes the pixel's colour in sRGB codes and in linear light.
static void say_levels(Part *part) {
    const DipColour *c = &part->pixel;
    char linear[32];
    format_linear(part, linear);
    dip_ui_line(part->ui, SMALL, dip_style_white, &part->rest, "%d %d %d", c->red, c->green,
                c->blue);
    dip_ui_line(part->ui, TINY, dip_style_dim, &part->rest, "linear");
    dip_ui_line(part->ui, SMALL, dip_style_white, &part->rest, "%s", linear);
}

// Lists the samples' colours in two columns, if there is room.
static void say_samples(Part *part) {
    const int count = part->samples ? part->pattern->count : 0;
    const int line = dip_ui_line_height(part->ui, TINY), half = dip_ui_px(part->ui, 60);
    const int rows = (count + 1) / 2;
    if (count < 2 || line * (rows + 1) > part->rest.height) {
        return;
    }
    dip_ui_line(part->ui, TINY, dip_style_dim, &part->rest, "samples");
    const DipRect list = dip_cut_top(&part->rest, rows * line);
    for (int s = 0; s < count; ++s) {
        const DipColour colour = dip_loupe_colour(part->loupe, &part->samples[s]);
        DipRect row = {list.x + s / rows * half, list.y + s % rows * line, half, 0};
        dip_ui_line(part->ui, TINY, dip_style_white, &row, "%d  %02X%02X%02X", s, colour.red,
                    colour.green, colour.blue);
    }
}

// Shows the first of several texts that fits or, if none fits, the last one.
static void say_fitting(Part *part, const char *const *texts, int count) {
    int i = 0;
    while (i < count - 1 && dip_ui_text_width(part->ui, SMALL, texts[i]) > part->rest.width) {
        ++i;
    }
    dip_ui_line(part->ui, SMALL, dip_style_soft, &part->rest, "%s", texts[i]);
}

// Writes how many samples the pixel has and what they show.
static void say_count(Part *part) {
    const int count = part->pattern->count;
    const bool temporal = dip_quality_alternates(&part->window->state->quality[part->pane]);
    char longest[96];
    char text[64] = "1 sample, at the centre";
    char brief[64] = "1 sample";
    if (count > 1 && part->samples) {
        const DipSampleCount found = dip_loupe_count(part->samples, count);
        if (found.patches == 1 && found.colours > 1) {
            snprintf(text, sizeof text, "%d samples on one surface, in %d colours", count,
                     found.colours);
            snprintf(brief, sizeof brief, "%d on one surface, %d colours", count, found.colours);
        } else if (found.patches == 1) {
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
    const int green_blue = dip_max(abs(a.green - b.green), abs(a.blue - b.blue));
    return dip_max(abs(a.red - b.red), green_blue);
}

// Compares the pixel with the converged picture if that picture is known.
static void say_truth(Part *part) {
    const DipWindow *window = part->window;
    const DipToolState *tools = &window->state->tools;
    const DipPixels *truth = window->truth;
    if (!truth || tools->x >= truth->width || tools->y >= truth->height) {
        return;
    }
    const DipColour true_pixel = pixel_of(truth, tools->x, tools->y);
    const DipColour other = pixel_of(&window->frames[1 - part->pane], tools->x, tools->y);
    const int off = distance(part->pixel, true_pixel), other_off = distance(other, true_pixel);
    const DipColour verdict = off < other_off   ? dip_style_gain
                              : off > other_off ? dip_style_worse
                                                : dip_style_soft;
    DipRect line = dip_cut_top(&part->rest, dip_ui_line_height(part->ui, SMALL));
    char text[64];
    snprintf(text, sizeof text, "truth %d %d %d  ", true_pixel.red, true_pixel.green,
             true_pixel.blue);
    dip_ui_word(part->ui, SMALL, dip_style_white, &line, 0, text);
    dip_ui_line(part->ui, SMALL, verdict, &line, "off by %d", off);
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

// Shows the pixel's figures beside or beneath a crop. If there is room, also shows the box
// (loupe.h), a picture of the pixel with its samples.
static void show_details(Part *part, DipRect rect) {
    DipUi *ui = part->ui;
    const DipToolState *tools = &part->window->state->tools;
    const DipColour *c = &part->pixel;
    const int gap = dip_ui_px(ui, 8), side = dip_ui_px(ui, BOX_SIDE);
    const int small = dip_ui_line_height(ui, SMALL);
    dip_cut_left(&rect, gap);
    dip_ui_line(ui, TEXT, part->own, &rect, "pixel %d, %d", tools->x, tools->y);
    dip_cut_top(&rect, dip_ui_px(ui, 2));
    part->rest = rect;
    const bool box =
        rect.width >= side + gap + dip_ui_px(ui, 80) && side + 2 * small <= rect.height;
    if (box) {
        const DipRect left = dip_cut_left(&part->rest, side);
        draw_box(part, (DipRect){left.x, left.y, side, side});
        dip_cut_left(&part->rest, gap);
    }
    if (small <= rect.height) {
        dip_ui_line(ui, SMALL, dip_style_white, &part->rest, "#%02X%02X%02X", c->red, c->green,
                    c->blue);
    }
    if (4 * small <= rect.height) {
        say_levels(part);
        say_samples(part);
    }
    if (box) {
        part->rest = rect;
        dip_cut_top(&part->rest, side + dip_ui_px(ui, 3));
    }
    if (small <= part->rest.height) {
        say_count(part);
    }
    if (small <= part->rest.height) {
        say_truth(part);
    }
}

// Shows the pixel's figures beneath a crop in a narrow tab: three lines, and the samples' colours
// if there is room for them.
static void show_brief(Part *part, DipRect rect) {
    DipUi *ui = part->ui;
    const DipToolState *tools = &part->window->state->tools;
    const DipColour *c = &part->pixel;
    const int gap = dip_ui_px(ui, 4);
    char pixel[48], rgb[48], linear[32];
    dip_cut_left(&rect, gap);
    part->rest = rect;
    snprintf(pixel, sizeof pixel, "%d, %d", tools->x, tools->y);
    snprintf(rgb, sizeof rgb, "#%02X%02X%02X  %d %d %d", c->red, c->green, c->blue, c->red,
             c->green, c->blue);
    if (dip_ui_text_width(ui, SMALL, pixel) + dip_ui_text_width(ui, SMALL, rgb) + 2 * gap >
        rect.width) {
        rgb[7] = '\0'; // Keeps only the hexadecimal colour.
    }
    dip_ui_text(ui, SMALL, dip_style_white, DIP_ALIGN_RIGHT, dip_rect_right(rect) - gap, rect.y,
                rect.width, rgb);
    dip_ui_line(ui, SMALL, part->own, &part->rest, "%s", pixel);
    format_linear(part, linear);
    dip_ui_line(ui, SMALL, dip_style_white, &part->rest, "linear %s", linear);
    say_count(part);
    say_samples(part);
}

// Returns the height that show_brief needs in a part of the tab with this rectangle: three lines,
// and the samples' colours if the crop above stays tall enough. Both panes get the same height, so
// that their crops have one size.
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

// --- crops ---------------------------------------------------------------------------------------

// Declares the crop as a control. A click moves the loupe to the pixel under the pointer, and the
// wheel zooms. The crop never gets the focus: arrow keys move the loupe while no control has the
// focus (dip_loupe_press).
static void handle_crop(Part *part, const DipLoupeCrop *crop) {
    DipToolState *tools = &part->window->state->tools;
    const DipPixels *frame = &part->window->frames[part->pane];
    const DipUiInput input = dip_ui_control(
        part->ui, &(DipUiControl){.id = DIP_UI_ID(DIP_UI_LOUPE, ID_CROP + part->pane),
                                  .rect = crop->frame,
                                  .tip = "Click: look at this pixel. Wheel: zoom.\n"
                                         "Arrow keys: move by one pixel; with Shift by eight.",
                                  .skips_focus = true,
                                  .takes_wheel = true});
    int x, y;
    if (input.began && dip_loupe_pixel_at(crop->shown, crop->source.width, crop->source.height,
                                          input.x, input.y, &x, &y)) {
        dip_loupe_move(tools, crop->source.x + x - tools->x, crop->source.y + y - tools->y,
                       frame->width, frame->height);
    } else if (input.steps) {
        dip_tool_state_zoom(tools, input.steps);
    }
}

// Tells the loupe which samples the crops need: those of all pixels if the crops mark them,
// otherwise those of the looked-at pixel.
static void want_samples(const Part *part, const DipLoupeCrop *crop) {
    const DipToolState *tools = &part->window->state->tools;
    const DipRect *source = &crop->source;
    DipTargetRegion region = {tools->x, tools->y, tools->x + 1, tools->y + 1};
    if (crop->zoom >= DIP_LOUPE_MARKS_ZOOM && !dip_rect_is_empty(*source)) {
        region = (DipTargetRegion){source->x, source->y, dip_rect_right(*source),
                                   dip_rect_bottom(*source)};
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
        dip_ui_mark(part->ui, content.crop.pixel, part->own);
    }
    handle_crop(part, &content.crop);
}

// Divides a pane's part of the tab between the crop and the figures. Leaves out figures that do not
// fit.
static void declare_part(DipUi *ui, DipWindow *window, int pane, DipRect rect) {
    const DipToolState *tools = &window->state->tools;
    Part part = {.ui = ui,
                 .window = window,
                 .loupe = &window->tools->loupe,
                 .pane = pane,
                 .pixel = pixel_of(&window->frames[pane], tools->x, tools->y),
                 .own = dip_style_of_pane(pane)};
    part.pattern = dip_loupe_pattern(part.loupe, &window->state->quality[pane]);
    part.samples = dip_loupe_samples(part.loupe, pane, window->versions[pane], tools->x, tools->y,
                                     &part.pattern);
    const int least = dip_ui_px(ui, LEAST_CROP), brief = brief_height(&part, rect);
    int details = dip_ui_px(ui, DETAILS_WIDTH);
    details = rect.width - details >= least ? details : dip_ui_px(ui, FIGURES_WIDTH);
    void (*show)(Part *, DipRect) = show_details;
    DipRect crop = rect, text = {0};
    if (rect.width - details < 2 * least && rect.height >= least + brief) {
        text = dip_cut_bottom(&crop, brief);
        show = show_brief;
    } else if (rect.width - details >= least) {
        text = dip_cut_right(&crop, details);
    } else if (rect.height >= 2 * least) {
        text = dip_cut_bottom(&crop, rect.height - rect.height / 2);
        dip_cut_top(&text, dip_ui_px(ui, 4));
    }
    draw_crop(&part, crop);
    if (text.width > 0) {
        show(&part, text);
    }
}

// --- the tab -------------------------------------------------------------------------------------

// Declares a button at the left end of *row, and cuts the button off *row. Leaves out a button that
// does not fit. Returns whether it was pressed.
static bool row_button(DipUi *ui, int id, DipRect *row, int padding, const char *text, bool chosen,
                       const char *tip) {
    const int width = dip_ui_text_width(ui, TEXT, text) + 2 * padding;
    if (width > row->width) {
        return false;
    }
    const DipRect rect = dip_cut_left(row, width);
    dip_cut_left(row, dip_ui_px(ui, 4));
    return dip_ui_button(ui, DIP_UI_ID(DIP_UI_LOUPE, id), rect, text,
                         chosen ? DIP_UI_CHOSEN : DIP_UI_PLAIN, tip);
}

static void declare_head(DipUi *ui, DipWindow *window, DipRect row) {
    DipToolState *tools = &window->state->tools;
    const int padding = dip_ui_px(ui, row.width < dip_ui_px(ui, 300) ? 4 : 8);
    int id = ID_ZOOM;
    for (int zoom = DIP_LOUPE_MIN_ZOOM; zoom <= DIP_LOUPE_MAX_ZOOM; zoom *= 2) {
        char text[16];
        snprintf(text, sizeof text, "%dx", zoom);
        if (row_button(ui, id++, &row, padding, text, tools->zoom == zoom,
                       "Shows each pixel of the panes this many times as large.")) {
            tools->zoom = zoom;
        }
    }
    dip_cut_left(&row, dip_ui_px(ui, 8));
    if (row_button(ui, ID_PIN, &row, padding, tools->pinned ? "Pinned" : "Follows the pointer",
                   tools->pinned,
                   "A pinned loupe keeps its pixel. A right click on a pane pins a pixel.")) {
        tools->pinned = !tools->pinned;
    }
    const char *note = tools->pinned ? "arrow keys: one pixel" : "right click: pin a pixel";
    dip_cut_left(&row, dip_ui_px(ui, 8));
    if (row.width >= dip_ui_text_width(ui, SMALL, note)) {
        dip_ui_label(ui, SMALL, dip_style_dim, DIP_ALIGN_RIGHT, row, note);
    }
}

// Returns the part of the tab that lies beneath a pane, or a half of the tab if the dock is a
// drawer (tools/layout.h).
static DipRect half_of(const DipLayout *layout, DipRect body, int pane) {
    DipRect half = body;
    if (layout->side == DIP_DOCK_BELOW) {
        const DipRect *under = &layout->panes[pane];
        half.x = dip_max(under->x, body.x);
        half.width = dip_min(dip_rect_right(*under), dip_rect_right(body)) - half.x;
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
        DipRect row = dip_rect_inset(dip_cut_top(&body, head + gap), 2 * gap, gap);
        declare_head(ui, window, row);
    }
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        declare_part(ui, window, p, half_of(window->layout, body, p));
    }
}
