// The loupe's tab.
#include "app/preview/tabs/loupe_tab_private.h"
#include "app/ui/style.h"

#include <stdio.h>

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
static void handle_crop(DipLoupePart *part, const DipLoupeCrop *crop) {
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
static void want_samples(const DipLoupePart *part, const DipLoupeCrop *crop) {
    const DipToolState *tools = &part->window->state->tools;
    const DipRect *source = &crop->source;
    DipTargetRegion region = {tools->x, tools->y, tools->x + 1, tools->y + 1};
    if (crop->zoom >= SAMPLES_ZOOM && !dip_rect_is_empty(*source)) {
        region = (DipTargetRegion){source->x, source->y, source->x + source->width,
                                   source->y + source->height};
    }
    dip_loupe_want(part->loupe, region);
}

static void draw_crop(DipLoupePart *part, DipRect area) {
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
    DipLoupePart part = {
        .ui = ui, .window = window, .loupe = dip_tools_loupe(window->tools), .pane = pane};
    part.pattern = dip_loupe_pattern(part.loupe, &window->state->quality[pane]);
    const DipSamplePattern *pattern = part.pattern;
    part.samples =
        dip_loupe_samples(part.loupe, pane, window->versions[pane], tools->x, tools->y, &pattern);
    part.pattern = part.samples ? pattern : part.pattern;
    part.pixel = dip_loupe_pixel(&window->frames[pane], tools->x, tools->y);
    const int least = dip_ui_px(ui, LEAST_CROP);
    const int details = rect.width - dip_ui_px(ui, DETAILS_WIDTH) >= least
                            ? dip_ui_px(ui, DETAILS_WIDTH)
                            : dip_ui_px(ui, FIGURES_WIDTH);
    const int brief = dip_loupe_brief_height(&part, rect);
    DipRect crop = rect;
    DipRect text = rect;
    if (rect.width - details < 2 * least && rect.height >= least + brief) {
        crop.height -= brief;
        text.y += crop.height;
        text.height = brief;
        draw_crop(&part, crop);
        dip_loupe_show_brief(&part, text);
    } else if (rect.width - details >= least) {
        crop.width -= details;
        text.x += crop.width;
        text.width = details;
        draw_crop(&part, crop);
        dip_loupe_show_details(&part, text);
    } else if (rect.height >= 2 * least) {
        crop.height = rect.height / 2;
        text.y += crop.height + dip_ui_px(ui, 4);
        text.height -= crop.height + dip_ui_px(ui, 4);
        draw_crop(&part, crop);
        dip_loupe_show_details(&part, text);
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
    const int width = dip_ui_text_width(ui, DIP_LOUPE_TEXT, text) + 2 * padding;
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
    if (room >= dip_ui_text_width(ui, DIP_LOUPE_SMALL, note)) {
        const int height = dip_ui_line_height(ui, DIP_LOUPE_SMALL);
        dip_ui_text(ui, DIP_LOUPE_SMALL, dip_style_dim, DIP_ALIGN_RIGHT, row.x + row.width,
                    row.y + (row.height - height) / 2, room, note);
    }
}

// Returns the part of the tab that lies beneath a pane, or one half of it if it lies elsewhere.
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
