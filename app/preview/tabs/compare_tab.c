// Declares the comparisons' tab: the choice of how the two pictures are compared, the options of
// that comparison, and a strip of thumbnails of the camera path.
#include "app/preview/prices/price_text.h"
#include "app/preview/tabs/tabs.h"
#include "app/preview/tools/compare.h"
#include "app/preview/tools/strip.h"
#include "app/ui/layout.h"
#include "app/ui/style.h"

#include <stdio.h>

// SMALL and TINY are letter sizes. All sizes and lengths are at scale 1.
enum {
    SMALL = 11,
    TINY = 10,
    STRIP_LEAST = 44, // Least height of the room below the buttons that shows thumbnails.
    STRIP_MOST = 96,  // Greatest height of a thumbnail.
};

enum { ID_COMPARISON, ID_LEFT = 10, ID_OPTION = 16, ID_DIVIDER = 32, ID_THUMBNAIL = 40 };

// Declares the choice of the picture with which the requested pane is compared.
static void declare_left(DipFlow *flow) {
    DipToolState *tools = &flow->window->state->tools;
    const DipErrorReading *errors = &flow->window->figures[DIP_PANE_CURRENT].errors;
    char text[80];
    if (dip_flow_choice(flow, ID_LEFT, "Current", !tools->against_truth,
                        "Compares the requested pane with the current pane.")) {
        tools->against_truth = false;
    }
    if (dip_flow_choice(flow, ID_LEFT + 1, "Truth", tools->against_truth,
                        "Compares the requested pane with the converged picture.")) {
        tools->against_truth = true;
    }
    if (!tools->against_truth || flow->window->truth) {
        return;
    }
    snprintf(text, sizeof text, "The converged picture comes at rest.");
    if (errors->next_samples > 0) {
        snprintf(text, sizeof text, "The converged picture is %.0f %% drawn%s.",
                 100.0 * errors->drawn, errors->waits ? ", waiting for a free processor" : "");
    }
    dip_flow_text(flow, dip_style_soft, text);
}

// Declares a slider that moves the wipe's divider.
static void declare_divider(DipUi *ui, DipToolState *tools, DipRect rect) {
    const DipUiInput input =
        dip_ui_stepper(ui, DIP_UI_ID(DIP_UI_COMPARE, ID_DIVIDER), rect,
                       "Moves the line between both pictures. [ and ] move it as well.");
    const int radius = dip_ui_px(ui, 7), track = rect.width - 2 * radius;
    if (input.began || (input.held && input.moved)) {
        dip_tool_state_divide(tools, (double)(input.x - rect.x - radius) / dip_max(1, track));
    }
    dip_tool_state_adjust(tools, input.steps);
    const int x = rect.x + (int)(tools->divider * track + 0.5), y = rect.y + rect.height / 2;
    dip_ui_fill_round(ui, (DipRect){rect.x, y - 2, rect.width, 4}, 2, dip_style_line);
    dip_ui_fill_round(ui, (DipRect){x, y - radius, 2 * radius, 2 * radius}, radius,
                      dip_style_accent);
    if (input.focused) {
        dip_ui_outline(ui, rect, dip_ui_px(ui, 4), dip_ui_px(ui, 2), dip_style_soft);
    }
}

static void declare_wipe(DipFlow *flow) {
    DipToolState *tools = &flow->window->state->tools;
    const DipRect rect = dip_flow_next(flow, dip_ui_px(flow->ui, 180));
    if (!dip_rect_is_empty(rect)) {
        declare_divider(flow->ui, tools, rect);
    }
    if (dip_flow_choice(flow, ID_OPTION, "Middle", false, "Puts the line in the middle.")) {
        dip_tool_state_divide(tools, 0.5);
    }
    dip_flow_text(flow, dip_style_dim,
                  tools->against_truth
                      ? "Left of the line: truth. Right of it: requested. Drag it."
                      : "Left of the line: current. Right of it: requested. Drag it.");
}

static void declare_blink(DipFlow *flow) {
    DipToolState *tools = &flow->window->state->tools;
    if (dip_flow_choice(flow, ID_OPTION, "By itself", tools->blinks,
                        "Changes between both pictures twice a second.")) {
        tools->blinks = !tools->blinks;
    }
    if (dip_flow_choice(flow, ID_OPTION + 1, "Change", false,
                        "Shows the other picture. The key ; does so while you hold it.")) {
        tools->blinked = !tools->blinked;
    }
    dip_flow_text(flow, dip_style_dim, "Hold ; to see the other picture.");
}

static void say_difference(DipFlow *flow) {
    DipPixels picture;
    uint64_t version;
    const DipDifference *found = dip_compare_make_difference(&flow->window->tools->compare,
                                                             flow->window, &picture, &version);
    char text[160];
    if (!found) {
        return;
    }
    if (!found->differing) {
        dip_flow_text(flow, dip_style_soft, "Both pictures are the same to the bit.");
        return;
    }
    snprintf(text, sizeof text, "%lld of %lld pixels differ (%.1f %%), at most by %d of 255",
             (long long)found->differing, (long long)found->pixels,
             100.0 * (double)found->differing / (double)found->pixels, found->greatest);
    dip_flow_text(flow, dip_style_white, text);
    snprintf(text, sizeof text, "at pixel %d, %d", found->x, found->y);
    dip_flow_text(flow, dip_style_dim, text);
}

static void declare_difference(DipFlow *flow) {
    DipToolState *tools = &flow->window->state->tools;
    unsigned id = ID_OPTION;
    for (int gain = 1; gain <= DIP_COMPARE_MAX_GAIN; gain *= 2) {
        char text[16];
        snprintf(text, sizeof text, "x%d", gain);
        if (dip_flow_choice(flow, id++, text, dip_max(1, tools->gain) == gain,
                            "Multiplies the difference. [ and ] change it as well.")) {
            tools->gain = gain;
        }
    }
    if (dip_ui_is_drawing(flow->ui)) {
        say_difference(flow);
    }
}

static void declare_alone(DipFlow *flow) {
    DipPreviewState *state = flow->window->state;
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        if (dip_flow_choice(flow, ID_OPTION + (unsigned)p, dip_pane_titles[p],
                            dip_compare_pane(state, flow->window->now_ns) == p,
                            "Shows this pane alone and lets the keys change its settings.")) {
            dip_preview_edit_only(state, p);
        }
    }
}

// Declares the options of the chosen comparison, or writes what the comparison shows.
static void declare_options(DipFlow *flow) {
    const bool known = flow->window->truth != NULL;
    switch (flow->window->state->tools.comparison) {
    case DIP_COMPARE_WIPE:
        declare_left(flow);
        declare_wipe(flow);
        break;
    case DIP_COMPARE_BLINK:
        declare_left(flow);
        declare_blink(flow);
        break;
    case DIP_COMPARE_DIFFERENCE:
        declare_left(flow);
        declare_difference(flow);
        break;
    case DIP_COMPARE_ALONE:
        declare_alone(flow);
        break;
    case DIP_COMPARE_TRUTH:
        dip_flow_text(flow, known ? dip_style_soft : dip_style_dim,
                      known ? "Left: the converged picture. Right: the requested pane."
                            : "The converged picture is drawn while errors are measured at rest.");
        break;
    default:
        dip_flow_text(flow, dip_style_dim, "Current on the left, requested on the right.");
        break;
    }
}

// --- the strip -----------------------------------------------------------------------------------

// Declares one thumbnail with its time. A click moves the preview to that time.
static void declare_thumbnail(DipUi *ui, DipWindow *window, int index, DipRect rect) {
    const DipStrip *strip = &window->tools->strip;
    const DipThumbnail thumbnail = dip_strip_thumbnail(strip, index);
    const DipUiInput input =
        dip_ui_control(ui, &(DipUiControl){.id = DIP_UI_ID(DIP_UI_COMPARE, ID_THUMBNAIL + index),
                                           .rect = rect,
                                           .tip = "Click: go to this time on the path."});
    char text[32];
    if (input.pressed && strip->duration_ns > 0) {
        dip_preview_seek_path(window->state, thumbnail.time_ns);
        window->state->manual = false;
    }
    const DipRect line = dip_cut_bottom(&rect, dip_ui_line_height(ui, TINY));
    dip_ui_fill(ui, rect, dip_style_well);
    if (thumbnail.picture.width) {
        dip_ui_picture(ui, rect, &thumbnail.picture, thumbnail.version);
    } else if (!strip->failed) {
        dip_ui_fill(ui, rect, dip_style_raised);
        dip_ui_label(ui, TINY, dip_style_soft, DIP_ALIGN_CENTRE, rect, DIP_WAITING_MARK);
    }
    if (input.hovered || input.focused) {
        dip_ui_outline(ui, rect, 0, dip_ui_px(ui, 2), dip_style_soft);
    }
    snprintf(text, sizeof text, "%.1f s", 1e-9 * (double)thumbnail.time_ns);
    dip_ui_label(ui, TINY, dip_style_dim, DIP_ALIGN_CENTRE, line, text);
}

// Shows as many thumbnails as fit into one row: all of them, or every second, fifth or tenth.
static void declare_strip(DipUi *ui, DipWindow *window, DipRect rest) {
    const DipRect *pane = &window->layout->panes[DIP_PANE_CURRENT];
    const int line = dip_ui_line_height(ui, TINY);
    const int gap = dip_ui_px(ui, 4);
    int height = dip_min(rest.height - line, dip_ui_px(ui, STRIP_MOST));
    if (rest.height < dip_ui_px(ui, STRIP_LEAST) || pane->height < 1 ||
        window->state->shows_gallery) {
        return;
    }
    int width = (int)((int64_t)height * pane->width / pane->height);
    const int all = (rest.width - (DIP_STRIP_COUNT - 1) * gap) / DIP_STRIP_COUNT;
    if (all >= dip_ui_px(ui, 40) && width > all) {
        width = all;
        height = (int)((int64_t)width * pane->height / pane->width);
    }
    const int fit = (rest.width + gap) / (dip_max(1, width) + gap);
    const int step = fit >= DIP_STRIP_COUNT ? 1 : fit >= 5 ? 2 : fit >= 2 ? 5 : DIP_STRIP_COUNT;
    if (width < 1 || height < 1 || width > rest.width) {
        return;
    }
    if (dip_ui_is_drawing(ui)) {
        dip_strip_want(&window->tools->strip, width, height);
    }
    rest.height = height + line;
    for (int i = 0; i < DIP_STRIP_COUNT; i += step) {
        declare_thumbnail(ui, window, i, dip_cut_left(&rest, width));
        dip_cut_left(&rest, gap);
    }
}

void dip_tab_compare(DipUi *ui, DipWindow *window, DipRect body) {
    static const char *const names[DIP_COMPARISON_COUNT][2] = {
        // Names and tips.
        [DIP_COMPARE_SIDE_BY_SIDE] = {"Side by side", "Shows both panes beside each other."},
        [DIP_COMPARE_WIPE] = {"Wipe", "Shows one picture: current left of a line, requested right "
                                      "of it."},
        [DIP_COMPARE_BLINK] = {"Blink",
                               "Shows both pictures at one position, one after the other."},
        [DIP_COMPARE_DIFFERENCE] = {"Difference",
                                    "Shows how far each channel of each pixel differs."},
        [DIP_COMPARE_ALONE] = {"One pane", "Shows one pane alone in the room of both."},
        [DIP_COMPARE_TRUTH] = {"Truth",
                               "Shows the converged picture in place of the current pane."},
    };
    DipFlow flow = dip_flow_make(ui, window, DIP_UI_COMPARE, body, SMALL, false);
    for (int c = 0; c < DIP_COMPARISON_COUNT; ++c) {
        if (dip_flow_choice(&flow, ID_COMPARISON + (unsigned)c, names[c][0],
                            window->state->tools.comparison == (DipComparison)c, names[c][1])) {
            window->state->tools.comparison = (DipComparison)c;
        }
    }
    dip_flow_next_row(&flow);
    declare_options(&flow);
    dip_flow_next_row(&flow);
    dip_cut_top(&flow.body, flow.y - flow.body.y);
    declare_strip(ui, window, flow.body);
}
