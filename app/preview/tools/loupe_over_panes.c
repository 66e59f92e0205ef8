// Draws the loupe's marks and the legend of mip colours over the panes, and moves the loupe by
// mouse and keys.
#include "app/preview/tools/compare.h"
#include "app/preview/tools/loupe.h"
#include "app/preview/tools/maps.h"
#include "app/ui/style.h"
#include "app/preview/tools/window.h"

enum { TINY = 10 }; // Letter size at scale 1.

// Outlines the part of a pane that the loupe shows enlarged. Assumes that the crop has its usual
// size, 368 x 176 pixels at scale 1.
static void mark_pane(DipUi *ui, const DipWindow *window, int pane) {
    const DipToolState *tools = &window->state->tools;
    const DipPixels *frame = &window->frames[pane];
    const DipRect shown = dip_compare_shown(window, pane);
    const DipRect area = {0, 0, dip_ui_px(ui, 368), dip_ui_px(ui, 176)};
    const DipLoupeCrop crop =
        dip_loupe_crop(frame->width, frame->height, tools->x, tools->y, tools->zoom, area);
    const DipRect mark = dip_loupe_mark(shown, frame->width, frame->height, crop.source);
    const DipRect inside = dip_rect_intersect(mark, dip_compare_visible(window, pane));
    if (!dip_rect_is_empty(inside)) {
        dip_ui_mark(ui, inside, dip_style_of_pane(pane));
    }
}

static void follow(DipWindow *window, const DipUiInput *input) {
    DipToolState *tools = &window->state->tools;
    int pane, x, y;
    if (!dip_compare_pixel_at(window, input->x, input->y, &pane, &x, &y)) {
        return;
    }
    if (input->right) {
        const bool same = tools->pinned && tools->x == x && tools->y == y;
        tools->pinned = !same;
        tools->open = true;
        tools->tab = DIP_TAB_LOUPE;
    }
    if (input->right || (!tools->pinned && dip_loupe_is_on(tools))) {
        tools->x = x;
        tools->y = y;
    }
}

static void handle_panes(DipWindow *window, const DipUiInput panes[DIP_PANE_COUNT]) {
    DipToolState *tools = &window->state->tools;
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const DipUiInput *input = &panes[p];
        if (input->right || input->moved) {
            follow(window, input);
        }
        if (input->steps && (input->modifiers & DIP_MODIFIER_CTRL)) {
            tools->loupe = true;
            dip_tool_state_zoom(tools, input->steps);
        }
    }
}

// Draws a legend over a pane that shows mip levels. Each colour stands for the side of a mip level
// in texels.
static void draw_mip_legend(DipUi *ui, DipRect shown) {
    enum { COUNT = DIP_MIP_DEBUG_LEVELS };
    const int margin = dip_ui_px(ui, 8);
    const int cell = dip_ui_px(ui, 32);
    const int height = dip_ui_line_height(ui, TINY) + dip_ui_px(ui, 4);
    const int across = shown.width - 2 * margin >= COUNT * cell ? COUNT : COUNT / 2;
    if (shown.width - 2 * margin < across * cell) {
        return;
    }
    const int top = shown.y + shown.height - margin - height * (COUNT / across);
    for (int i = 0; i < COUNT; ++i) {
        const DipColour ground = dip_map_mip_colour(i);
        char name[DIP_MIP_TEXT_BYTES];
        dip_map_mip_text(i, name);
        const DipRect rect = {shown.x + margin + i % across * cell, top + i / across * height, cell,
                              height};
        dip_ui_fill(ui, rect, ground);
        dip_ui_text(ui, TINY, dip_style_contrast(ground), DIP_ALIGN_CENTRE, rect.x + cell / 2,
                    rect.y + dip_ui_px(ui, 2), cell, name);
    }
    if (top - height >= shown.y + dip_ui_px(ui, 40)) {
        const char *title = "Side of the mip level, texels";
        const int width = dip_ui_text_width(ui, TINY, title) + dip_ui_px(ui, 8);
        dip_ui_fill(ui, (DipRect){shown.x + margin, top - height, width, height}, dip_style_glass);
        dip_ui_text(ui, TINY, dip_style_white, DIP_ALIGN_LEFT, shown.x + margin + dip_ui_px(ui, 4),
                    top - height + dip_ui_px(ui, 2), width, title);
    }
}

void dip_loupe_over_panes(DipUi *ui, DipWindow *window, const DipUiInput panes[DIP_PANE_COUNT]) {
    const DipPreviewState *state = window->state;
    if (!dip_ui_is_drawing(ui)) {
        handle_panes(window, panes);
        return;
    }
    if (state->tools.bare || window->frames[0].width < 1 || window->frames[1].width < 1) {
        return;
    }
    dip_loupe_keep_inside(&window->state->tools, window->frames[DIP_PANE_CURRENT].width,
                          window->frames[DIP_PANE_CURRENT].height);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        const DipRect visible = dip_compare_visible(window, p);
        if (state->quality[p].step[DIP_SETTING_MIPDEBUG] && !dip_rect_is_empty(visible)) {
            draw_mip_legend(ui, visible);
        }
        if (dip_loupe_is_on(&state->tools) && !dip_rect_is_empty(visible)) {
            mark_pane(ui, window, p);
        }
    }
}

bool dip_loupe_press(DipPreviewState *state, int width, int height, const DipEvent *event) {
    const int step = event->modifiers & DIP_MODIFIER_SHIFT ? 8 : 1;
    int dx, dy;
    if (!dip_loupe_is_on(&state->tools) || !dip_ui_arrow(event, &dx, &dy)) {
        return false;
    }
    dip_loupe_move(&state->tools, step * dx, step * dy, width, height);
    return true;
}
