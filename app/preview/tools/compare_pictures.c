// Draws the comparisons' pictures, and what lies over them: the divider of a wipe, and the label of
// a difference.
#include "app/preview/tools/tools.h"
#include "app/ui/layout.h"
#include "app/ui/style.h"

#include <stdio.h>
#include <stdlib.h>

enum {
    TEXT = 12,    // Letter size at scale 1.
    HANDLE = 18,  // Radius of the divider's handle at scale 1.
    ID_LINE = 64, // Id of the divider, greater than all ids in the comparisons' tab.
};

// --- pictures ------------------------------------------------------------------------------------

// Returns the version of a picture that a comparison makes from a frame with the given version. A
// comparison may show only a part of a frame, and draw lists compare versions instead of pixels, so
// each comparison has versions of its own.
static uint64_t own_version(uint64_t version, DipComparison comparison) {
    return version ^ ((uint64_t)comparison + 1) << 56;
}

static void draw_wipe(DipUi *ui, const DipWindow *window) {
    const int width = window->frames[DIP_PANE_CURRENT].width;
    const int column = dip_compare_divider_column(window->state->tools.divider, width);
    const int first[DIP_PANE_COUNT] = {0, column};
    const int count[DIP_PANE_COUNT] = {column, width - column};
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const DipRect visible = dip_compare_visible(window, p);
        if (count[p] > 0 && !dip_rect_is_empty(visible)) {
            uint64_t version;
            const DipPixels *picture = dip_compare_picture(window, p, &version);
            const DipPixels part =
                dip_pixels_part(picture, (DipRect){first[p], 0, count[p], picture->height});
            dip_ui_picture(ui, visible, &part, own_version(version, DIP_COMPARE_WIPE));
        }
    }
}

static void draw_one(DipUi *ui, const DipWindow *window, int pane) {
    const DipComparison comparison = window->state->tools.comparison;
    uint64_t version;
    const DipPixels *picture = dip_compare_picture(window, pane, &version);
    dip_ui_picture(ui, dip_compare_shown(window, pane), picture, own_version(version, comparison));
}

static void draw_difference(DipUi *ui, const DipWindow *window) {
    DipPixels picture;
    uint64_t version;
    if (dip_compare_make_difference(&window->tools->compare, window, &picture, &version)) {
        dip_ui_picture(ui, dip_compare_shown(window, DIP_PANE_CURRENT), &picture, version);
    }
}

static void draw_panes(DipUi *ui, const DipWindow *window) {
    const DipRect *panes = window->layout->panes;
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        uint64_t version;
        const DipPixels *picture = dip_compare_picture(window, p, &version);
        dip_ui_picture(ui, panes[p], picture, version);
    }
    dip_ui_fill(ui, dip_layout_gap(window->layout), dip_style_background);
}

void dip_compare_pictures(DipUi *ui, DipWindow *window) {
    const DipComparison comparison = window->state->tools.comparison;
    if (!dip_ui_is_drawing(ui)) {
        return;
    }
    if (!dip_compare_is_one_picture(comparison)) {
        draw_panes(ui, window);
        return;
    }
    const DipRect *panes = window->layout->panes;
    dip_ui_fill(ui, dip_rect_unite(panes[DIP_PANE_CURRENT], panes[DIP_PANE_REQUESTED]),
                dip_style_background);
    if (comparison == DIP_COMPARE_WIPE) {
        draw_wipe(ui, window);
    } else if (comparison == DIP_COMPARE_DIFFERENCE) {
        draw_difference(ui, window);
    } else {
        draw_one(ui, window, dip_compare_pane(window->state, window->now_ns));
    }
}

// --- over the panes ------------------------------------------------------------------------------

// While the user drags with the left button, moves the divider to the pointer, or to the middle if
// Shift is held. A drag may begin anywhere in the picture. While the camera is free
// (state->manual), only a drag that is near the divider moves the divider. Drags with the right
// button fly the camera.
static void drag_divider(DipUi *ui, DipWindow *window, const DipUiInput *input) {
    DipToolState *tools = &window->state->tools;
    const DipRect shown = dip_compare_shown(window, DIP_PANE_CURRENT);
    const DipRect left = dip_compare_visible(window, DIP_PANE_CURRENT);
    const int off = abs(input->x - left.x - left.width);
    if (!input->held || input->button != DIP_MOUSE_LEFT || !input->moved || shown.width < 1 ||
        (window->state->manual && off > 2 * dip_ui_px(ui, HANDLE))) {
        return;
    }
    const bool to_middle = input->modifiers & DIP_MODIFIER_SHIFT;
    dip_tool_state_divide(tools, to_middle ? 0.5 : (input->x - shown.x + 0.5) / shown.width);
}

// Declares the divider as a control of its own. A divider in the middle lies in the gap between the
// panes, where the panes' controls do not reach.
static DipUiInput declare_line(DipUi *ui, const DipWindow *window) {
    const DipRect left = dip_compare_visible(window, DIP_PANE_CURRENT);
    const int reach = dip_ui_px(ui, 8);
    const DipUiControl control = {
        .id = DIP_UI_ID(DIP_UI_COMPARE, ID_LINE),
        .rect = {left.x + left.width - reach, left.y, 2 * reach, left.height},
        .tip = "Drag: move the line. With Shift: to the middle.",
        .skips_focus = true};
    return dip_ui_control(ui, &control);
}

// Draws a chevron that points left (direction -1) or right (1), as rows of pixels.
static void draw_chevron(DipUi *ui, int x, int y, int size, int direction, DipColour colour) {
    const int thick = dip_max(2, size / 3);
    for (int i = 0; i <= size; ++i) {
        const int reach = abs(i - size / 2);
        dip_ui_fill(ui, (DipRect){x + direction * (size / 2 - reach), y + i - size / 2, thick, 1},
                    colour);
    }
}

static void draw_divider(DipUi *ui, const DipWindow *window) {
    const DipRect left = dip_compare_visible(window, DIP_PANE_CURRENT);
    const int unit = dip_max(1, dip_ui_px(ui, 1));
    const int x = left.x + left.width - 2 * unit;
    const int radius = dip_ui_px(ui, HANDLE);
    const int middle = left.y + left.height / 2;
    dip_ui_fill(ui, (DipRect){x, left.y, 4 * unit, left.height}, dip_style_dark);
    dip_ui_fill(ui, (DipRect){x + unit, left.y, unit, left.height}, dip_style_white);
    dip_ui_fill(ui, (DipRect){x + 2 * unit, left.y, unit, left.height}, dip_style_accent);
    if (left.height < 4 * radius) {
        return;
    }
    const DipRect disc = {x + 2 * unit - radius, middle - radius, 2 * radius, 2 * radius};
    dip_ui_fill_round(ui, disc, radius, dip_style_white);
    dip_ui_fill_round(ui, dip_rect_inset(disc, 2 * unit, 2 * unit), radius - 2 * unit,
                      dip_style_well);
    draw_chevron(ui, x + 2 * unit - radius / 2, middle, radius / 2, -1, dip_style_white);
    draw_chevron(ui, x + 2 * unit + radius / 3, middle, radius / 2, 1, dip_style_accent);
}

// Names the two pictures whose difference shows. A text that is wider than the picture is broken
// into lines.
static void label_difference(DipUi *ui, const DipWindow *window) {
    const DipPreviewState *state = window->state;
    const DipRect shown = dip_compare_shown(window, DIP_PANE_CURRENT);
    char left[200] = "converged", right[200], text[480];
    if (!dip_compare_shows_truth(window)) {
        dip_preview_describe(&state->quality[DIP_PANE_CURRENT], true, left, sizeof left);
    }
    dip_preview_describe(&state->quality[DIP_PANE_REQUESTED], true, right, sizeof right);
    snprintf(text, sizeof text, "Difference times %d: %s (%.200s) and requested (%.200s)",
             dip_max(1, state->tools.gain), dip_compare_shows_truth(window) ? "truth" : "current",
             left, right);
    const int pad = dip_ui_px(ui, 10);
    const int width =
        dip_min(dip_ui_text_width(ui, TEXT, text), shown.width - 2 * pad - dip_ui_px(ui, 16));
    const int height = dip_ui_text_block_height(ui, TEXT, width, text);
    if (width <= 0 || 2 * height > shown.height) {
        return;
    }
    const DipRect rect = {shown.x + (shown.width - width) / 2, shown.y + dip_ui_px(ui, 12), width,
                          height};
    dip_ui_fill_round(ui, dip_rect_inset(rect, -pad, -dip_ui_px(ui, 4)), dip_ui_px(ui, 3),
                      dip_style_glass);
    dip_ui_text_block(ui, TEXT, dip_style_white, rect, text);
}

void dip_compare_over_panes(DipUi *ui, DipWindow *window, const DipUiInput panes[DIP_PANE_COUNT]) {
    const DipToolState *tools = &window->state->tools;
    if (tools->comparison == DIP_COMPARE_WIPE) {
        const DipUiInput line = declare_line(ui, window);
        drag_divider(ui, window, &line);
        for (int p = 0; p < DIP_PANE_COUNT; ++p) {
            drag_divider(ui, window, &panes[p]);
        }
    }
    if (!dip_ui_is_drawing(ui) || tools->bare) {
        return;
    }
    if (tools->comparison == DIP_COMPARE_WIPE) {
        draw_divider(ui, window);
    } else if (tools->comparison == DIP_COMPARE_DIFFERENCE) {
        label_difference(ui, window);
    }
}
