// What the maps show over the panes.
#include "app/preview/tabs/maps_tab_private.h"

#include "app/preview/tools/map_colours.h"

#include <stdio.h>

static bool shows_over(const DipMapView *view, int pane) {
    return view->over == DIP_MAP_OVER_BOTH ||
           (view->over == DIP_MAP_OVER_CURRENT) == (pane == DIP_PANE_CURRENT);
}

// Returns where the window shows a rectangle of a pane's picture.
static DipRect shown_rect(const Tab *tab, int pane, DipRect rect) {
    const DipRect *shown = &tab->window->layout->panes[pane];
    const DipPixels *frame = &tab->window->frames[pane];
    const int x0 = shown->x + rect.x * shown->width / frame->width;
    const int y0 = shown->y + rect.y * shown->height / frame->height;
    const int x1 = shown->x + (rect.x + rect.width) * shown->width / frame->width;
    const int y1 = shown->y + (rect.y + rect.height) * shown->height / frame->height;
    return (DipRect){x0, y0, x1 - x0, y1 - y0};
}

static DipRect tile_rect(const Tab *tab, int pane, const DipMapWork *work, int tile) {
    const int x = tile % work->across * DIP_TARGET_TILE;
    const int y = tile / work->across * DIP_TARGET_TILE;
    return shown_rect(tab, pane,
                      (DipRect){x, y, dip_min(DIP_TARGET_TILE, work->width - x),
                                dip_min(DIP_TARGET_TILE, work->height - y)});
}

// Writes each tile's value into its lower right corner, if it fits.
static void draw_numbers(const Tab *tab, int pane) {
    const DipMapWork *work = dip_maps_work(tab->maps, pane);
    const int height = dip_ui_line_height(tab->ui, NOTE), one = px(tab, 1);
    for (int t = 0; t < work->across * work->down; t++) {
        const DipRect rect = tile_rect(tab, pane, work, t);
        char text[16];
        dip_map_format(dip_map_value(work, tab->tools->map, t), text, sizeof text);
        if (dip_ui_text_width(tab->ui, NOTE, text) + px(tab, 10) > rect.width ||
            height + px(tab, 4) > rect.height) {
            continue;
        }
        const int x = rect.x + rect.width - px(tab, 4);
        const int y = rect.y + rect.height - height - px(tab, 3);
        dip_ui_text(tab->ui, NOTE, dip_style_shadow, DIP_ALIGN_RIGHT, x + one, y + one, rect.width,
                    text);
        dip_ui_text(tab->ui, NOTE, dip_style_shadow, DIP_ALIGN_RIGHT, x - one, y - one, rect.width,
                    text);
        dip_ui_text(tab->ui, NOTE, dip_style_white, DIP_ALIGN_RIGHT, x, y, rect.width, text);
    }
}

// Draws a cross with an open middle at a pixel.
static void draw_cross(const Tab *tab, int pane, int x, int y) {
    const DipRect rect = shown_rect(tab, pane, (DipRect){x, y, 1, 1});
    const int cx = rect.x + rect.width / 2, cy = rect.y + rect.height / 2;
    const int hole = px(tab, 5) + rect.width / 2, arm = px(tab, 9), thick = px(tab, 2);
    for (int pass = 0; pass < 2; pass++) {
        const int edge = pass ? 0 : px(tab, 1);
        const int wide = thick + 2 * edge, half = thick / 2 + edge, tall = arm + 2 * edge;
        const DipColour colour = pass ? dip_style_of_pane(pane) : dip_style_shadow;
        dip_ui_fill(tab->ui, (DipRect){cx - half, cy - hole - arm - edge, wide, tall}, colour);
        dip_ui_fill(tab->ui, (DipRect){cx - half, cy + hole - edge, wide, tall}, colour);
        dip_ui_fill(tab->ui, (DipRect){cx - hole - arm - edge, cy - half, tall, wide}, colour);
        dip_ui_fill(tab->ui, (DipRect){cx + hole - edge, cy - half, tall, wide}, colour);
    }
}

// Frames the block of 32x32 pixels with the greatest mean error.
static void draw_worst_block(const Tab *tab, int pane) {
    const DipErrorPictures *errors = dip_maps_errors(tab->maps);
    if (!errors || !errors->flip[pane] || errors->spread[pane].tail.worst <= 0.0) {
        return;
    }
    const DipFlipTail *tail = &errors->spread[pane].tail;
    const DipRect rect = shown_rect(tab, pane,
                                    (DipRect){(int)tail->worst_x, (int)tail->worst_y,
                                              dip_min(WORST_BLOCK, errors->width),
                                              dip_min(WORST_BLOCK, errors->height)});
    const int edge = px(tab, 1);
    char value[16], text[32];
    dip_map_format(tail->worst, value, sizeof value);
    snprintf(text, sizeof text, "worst block: %s", value);
    dip_ui_outline(tab->ui, rect, 0, 3 * edge, dip_style_shadow);
    dip_ui_outline(tab->ui, rect, 0, edge, dip_style_of_pane(pane));
    const DipRect *shown = &tab->window->layout->panes[pane];
    const int width = dip_ui_text_width(tab->ui, NOTE, text) + px(tab, 8);
    const int height = dip_ui_line_height(tab->ui, NOTE) + px(tab, 2);
    const bool above = rect.y - height >= shown->y;
    const DipRect strip = {dip_min(rect.x, shown->x + shown->width - width),
                           above ? rect.y - height : rect.y + rect.height, width, height};
    dip_ui_fill(tab->ui, strip, dip_style_glass);
    put(tab, NOTE, dip_style_white, strip.x + px(tab, 4), strip.y + edge, width, text);
}

static void draw_pointed(const Tab *tab, int pane) {
    const DipMapWork *work = dip_maps_work(tab->maps, pane);
    int x, y;
    if (!pointed_pixel(tab, &x, &y)) {
        return;
    }
    if (!is_work_map(tab->tools->map)) {
        draw_cross(tab, pane, x, y);
        return;
    }
    const DipRect rect = tile_rect(tab, pane, work, dip_map_tile(work, x, y));
    dip_ui_outline(tab->ui, rect, 0, px(tab, 5), dip_style_shadow);
    dip_ui_outline(tab->ui,
                   (DipRect){rect.x + px(tab, 1), rect.y + px(tab, 1), rect.width - px(tab, 2),
                             rect.height - px(tab, 2)},
                   0, px(tab, 3), dip_style_of_pane(pane));
}

// Says at the foot of a pane which map shows, and what it waits for.
static void draw_words(const Tab *tab, int pane) {
    const DipRect *rect = &tab->window->layout->panes[pane];
    char room[80], text[120];
    const char *status =
        dip_maps_status(tab->maps, tab->tools->map, pane, tab->window->state->shows_gallery,
                        tab->window->still, room, sizeof room);
    if (!status[0]) {
        return;
    }
    snprintf(text, sizeof text, "%s: %s", dip_map_name(tab->tools->map), status);
    const char *shown = text;
    const int most = rect->width - px(tab, 34);
    if (dip_ui_text_width(tab->ui, TEXT, text) > most) {
        shown = status;
    }
    const int width = dip_min(dip_ui_text_width(tab->ui, TEXT, shown), most);
    const DipRect strip = {rect->x + px(tab, 8), rect->y + rect->height - px(tab, 32),
                           width + px(tab, 18), px(tab, 24)};
    dip_ui_fill_round(tab->ui, strip, px(tab, 4), dip_style_glass);
    put(tab, TEXT, dip_style_soft, strip.x + px(tab, 9), strip.y + px(tab, 4), most, shown);
}

static void draw_pane(const Tab *tab, int pane) {
    DipPixels picture;
    uint64_t version;
    if (!shows_over(dip_maps_view(tab->maps), pane)) {
        return;
    }
    const bool usable = tab->window->still || tab->tools->map == DIP_MAP_FLIP;
    if (usable && tab->window->frames[pane].width > 0 &&
        dip_maps_picture(tab->maps, tab->tools, pane, &tab->window->frames[pane],
                         tab->window->versions[pane], &picture, &version)) {
        dip_ui_picture(tab->ui, tab->window->layout->panes[pane], &picture, version);
        if (is_work_map(tab->tools->map)) {
            draw_numbers(tab, pane);
        }
        if (tab->tools->map == DIP_MAP_FLIP) {
            draw_worst_block(tab, pane);
        }
        draw_pointed(tab, pane);
    }
    draw_words(tab, pane);
}

// Notes which pixel the pointer is over, in an event pass.
static void follow_pointer(const Tab *tab, const DipUiInput panes[DIP_PANE_COUNT]) {
    DipMapView *view = dip_maps_view(tab->maps);
    view->pointed = false;
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        const DipPixels *frame = &tab->window->frames[p];
        if (panes[p].hovered && !view->pointed) {
            view->pointed =
                dip_map_pixel_at(tab->window->layout->panes[p], frame->width, frame->height,
                                 panes[p].x, panes[p].y, &view->x, &view->y);
        }
    }
}

void dip_maps_declare_over_panes(DipUi *ui, DipWindow *window, DipMaps *maps,
                                 const DipUiInput panes[DIP_PANE_COUNT]) {
    const Tab tab = {ui, window, maps, &window->state->tools};
    const bool shows = tab.tools->comparison == DIP_COMPARE_SIDE_BY_SIDE && !tab.tools->bare;
    if (!dip_ui_is_drawing(ui)) {
        follow_pointer(&tab, panes);
        return;
    }
    dip_maps_want(maps, shows ? tab.tools->map : DIP_MAP_NONE);
    if (!shows || tab.tools->map == DIP_MAP_NONE) {
        return;
    }
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        draw_pane(&tab, p);
    }
}

void dip_tab_maps(DipUi *ui, DipWindow *window, DipRect body) {
    dip_maps_declare_tab(ui, window, dip_tools_maps(window->tools), body);
}

void dip_maps_over_panes(DipUi *ui, DipWindow *window, const DipUiInput panes[DIP_PANE_COUNT]) {
    dip_maps_declare_over_panes(ui, window, dip_tools_maps(window->tools), panes);
}
