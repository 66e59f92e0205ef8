// Lays out the maps' tab and declares its buttons. Draws the maps over the panes.
#include "app/preview/tabs/maps_tab_private.h"
#include "app/preview/tools/loupe.h"

#include <stdio.h>

static const char *const map_names[DIP_MAP_COUNT] = {
    [DIP_MAP_NONE] = "No map",           [DIP_MAP_FLIP] = "Error (FLIP)",
    [DIP_MAP_TIME] = "Time per tile",    [DIP_MAP_FRAGMENTS] = "Fragments",
    [DIP_MAP_PROBES] = "Texture probes", [DIP_MAP_SAMPLES] = "Samples differ",
    [DIP_MAP_MIPS] = "Mip level",
};

static const char *const map_tips[DIP_MAP_COUNT] = {
    [DIP_MAP_NONE] = "Shows the pictures.",
    [DIP_MAP_FLIP] = "How different each pixel looks from the converged picture.\n"
                     "Black: nobody sees a difference.",
    [DIP_MAP_TIME] = "How long one core works on each tile of 64x64 pixels.",
    [DIP_MAP_FRAGMENTS] = "How often a pixel is shaded, as a mean of each tile of 64x64 pixels.",
    [DIP_MAP_PROBES] = "How many bilinear texture reads a pixel takes,\n"
                       "as a mean of each tile of 64x64 pixels.",
    [DIP_MAP_SAMPLES] = "The pixels whose samples show several surfaces,\n"
                        "or one surface that is shaded several times.\n"
                        "Only these gain from antialiasing.",
    [DIP_MAP_MIPS] = "Which mip level each surface reads.",
};

static const DipMap map_order[] = {DIP_MAP_TIME,    DIP_MAP_FRAGMENTS, DIP_MAP_PROBES,
                                   DIP_MAP_SAMPLES, DIP_MAP_MIPS,      DIP_MAP_FLIP};
enum { MAP_BUTTONS = sizeof map_order / sizeof *map_order };

// Declares a button for each map, in two columns, or in more columns if the dock is low. Returns
// the room below the buttons.
static DipRect map_buttons(const Tab *tab, DipRect area) {
    const int gap = px(tab, BUTTON_GAP), pitch = px(tab, BUTTON + BUTTON_GAP);
    int columns = 2;
    while (columns < MAP_BUTTONS && MAP_BUTTONS / columns * pitch > area.height + gap) {
        columns++;
    }
    for (int i = 0; i < MAP_BUTTONS; i++) {
        const DipMap map = map_order[i];
        const bool chosen = tab->tools->map == map;
        DipRect cell = dip_rect_cell(area, columns, pitch, gap, 0, i);
        cell.height = px(tab, BUTTON);
        if (dip_ui_button(tab->ui, DIP_UI_ID(DIP_UI_MAPS, ID_MAP + i), cell, map_names[map],
                          chosen ? DIP_UI_CHOSEN : DIP_UI_PLAIN, map_tips[map])) {
            dip_tool_state_choose_map(tab->tools, chosen ? DIP_MAP_NONE : map);
        }
    }
    dip_cut_top(&area, (MAP_BUTTONS - 1) / columns * pitch + pitch + px(tab, 4));
    return area;
}

// Declares buttons in a row that choose which panes show the map. Leaves out buttons that do not
// fit.
static void over_buttons(const Tab *tab, DipRect row) {
    static const char *const names[2][3] = {{"both", "current", "requested"},
                                            {"both", "left", "right"}};
    DipMapView *view = &tab->maps->view;
    const bool narrow = row.width < px(tab, 220);
    const int gap = px(tab, BUTTON_GAP);
    dip_ui_text(tab->ui, TEXT, dip_style_soft, DIP_ALIGN_LEFT, row.x, row.y + px(tab, 4), row.width,
                "over");
    dip_cut_left(&row, dip_ui_text_width(tab->ui, TEXT, "over") + gap);
    for (int i = 0; i < 3; i++) {
        const char *name = names[narrow][i];
        const int width = dip_ui_text_width(tab->ui, TEXT, name) + px(tab, 16);
        if (width > row.width) {
            return;
        }
        if (dip_ui_button(tab->ui, DIP_UI_ID(DIP_UI_MAPS, ID_OVER + i), dip_cut_left(&row, width),
                          name, (int)view->over == i ? DIP_UI_CHOSEN : DIP_UI_PLAIN,
                          "Which panes show the map.")) {
            view->over = (DipMapOver)i;
        }
        dip_cut_left(&row, gap);
    }
}

static void buttons_block(const Tab *tab, DipRect area) {
    DipRect rest = map_buttons(tab, area);
    if (px(tab, SMALL_BUTTON) <= rest.height) {
        DipRect row = rest;
        row.height = px(tab, SMALL_BUTTON);
        over_buttons(tab, row);
    }
    dip_cut_top(&rest, px(tab, SMALL_BUTTON + BUTTON_GAP));
    if (px(tab, 2 * NOTE_ROW) <= rest.height) {
        dip_ui_text_block(tab->ui, NOTE, dip_style_soft, rest,
                          "Both panes have one scale, so that colours compare. N shows the next "
                          "map.");
    }
}

void dip_tab_maps(DipUi *ui, DipWindow *window, DipRect body) {
    static const struct {
        int width, height;
        void (*draw)(const Tab *tab, DipRect area);
    } blocks[] = {{BUTTONS_WIDTH, 190, buttons_block},
                  {LEGEND_WIDTH, 172, dip_maps_legend_block},
                  {TABLE_WIDTH, 130, dip_maps_mouse_block},
                  {TABLE_WIDTH, 152, dip_maps_frame_block}};
    const Tab tab = {ui, window, &window->tools->maps, &window->state->tools};
    const int margin = px(&tab, MARGIN);
    // The room from the present row of blocks downwards.
    DipRect rest = dip_rect_inset(body, margin, margin);
    rest.height += margin;
    DipRect row = rest;
    int row_height = 0;
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) {
        const int width = dip_min(px(&tab, blocks[i].width), rest.width);
        int height = px(&tab, blocks[i].height);
        // The block of buttons shows in any height.
        height = i == 0 ? dip_min(height, rest.height) : height;
        if (width > row.width && row_height > 0) {
            dip_cut_top(&rest, row_height + margin);
            row = rest;
            row_height = 0;
        }
        if (width <= row.width && height <= rest.height) {
            DipRect area = dip_cut_left(&row, width);
            area.height = height;
            dip_cut_left(&row, px(&tab, GAP));
            row_height = dip_max(row_height, height);
            blocks[i].draw(&tab, area);
        }
    }
}

// --- over the panes ------------------------------------------------------------------------------

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
    const int x1 = shown->x + dip_rect_right(rect) * shown->width / frame->width;
    const int y1 = shown->y + dip_rect_bottom(rect) * shown->height / frame->height;
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
    const int height = dip_ui_line_height(tab->ui, NOTE);
    // Offsets of two shadows and of the text, which is drawn last.
    const int shifts[] = {px(tab, 1), -px(tab, 1), 0};
    for (int t = 0; t < work->across * work->down; t++) {
        const DipRect rect = tile_rect(tab, pane, work, t);
        char text[16];
        dip_map_format(dip_map_value(work, tab->tools->map, t), text, sizeof text);
        if (dip_ui_text_width(tab->ui, NOTE, text) + px(tab, 10) > rect.width ||
            height + px(tab, 4) > rect.height) {
            continue;
        }
        for (int i = 0; i < 3; i++) {
            dip_ui_text(tab->ui, NOTE, i < 2 ? dip_style_shadow : dip_style_white, DIP_ALIGN_RIGHT,
                        dip_rect_right(rect) - px(tab, 4) + shifts[i],
                        dip_rect_bottom(rect) - height - px(tab, 3) + shifts[i], rect.width, text);
        }
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

// Draws a frame around the block of pixels with the greatest mean FLIP, and writes this FLIP beside
// the frame.
static void draw_worst_block(const Tab *tab, int pane) {
    const DipErrorPictures *errors = tab->maps->errors;
    if (!errors || !errors->flip[pane] || errors->spread[pane].tail.worst <= 0.0) {
        return;
    }
    const DipFlipTail *tail = &errors->spread[pane].tail;
    const DipRect rect = shown_rect(tab, pane,
                                    (DipRect){(int)tail->worst_x, (int)tail->worst_y,
                                              dip_min(DIP_FLIP_TAIL_BLOCK, errors->width),
                                              dip_min(DIP_FLIP_TAIL_BLOCK, errors->height)});
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
    const DipRect strip = {dip_min(rect.x, dip_rect_right(*shown) - width),
                           above ? rect.y - height : dip_rect_bottom(rect), width, height};
    dip_ui_fill(tab->ui, strip, dip_style_glass);
    dip_ui_text(tab->ui, NOTE, dip_style_white, DIP_ALIGN_LEFT, strip.x + px(tab, 4),
                strip.y + edge, width, text);
}

// Marks the pixel that the tab describes or, in a map of work, the pixel's tile.
static void draw_described(const Tab *tab, int pane) {
    const DipMapWork *work = dip_maps_work(tab->maps, pane);
    int x, y;
    if (!described_pixel(tab, &x, &y)) {
        return;
    }
    if (!is_work_map(tab->tools->map)) {
        draw_cross(tab, pane, x, y);
        return;
    }
    const DipRect rect = tile_rect(tab, pane, work, dip_map_tile(work, x, y));
    dip_ui_outline(tab->ui, rect, 0, px(tab, 5), dip_style_shadow);
    const int edge = px(tab, 1), less = px(tab, 2);
    const DipRect inner = {rect.x + edge, rect.y + edge, rect.width - less, rect.height - less};
    dip_ui_outline(tab->ui, inner, 0, px(tab, 3), dip_style_of_pane(pane));
}

// If a map is missing or not final, writes at the foot of the pane which map was chosen, and why it
// is missing or what it waits for.
static void draw_words(const Tab *tab, int pane) {
    const DipRect *rect = &tab->window->layout->panes[pane];
    char room[80], text[120];
    const char *status =
        dip_maps_status(tab->maps, tab->tools->map, pane, tab->window->state->shows_gallery,
                        tab->window->still, room, sizeof room);
    if (!status[0]) {
        return;
    }
    snprintf(text, sizeof text, "%s: %s", map_names[tab->tools->map], status);
    const int most = rect->width - px(tab, 34);
    const char *shown = dip_ui_text_width(tab->ui, TEXT, text) > most ? status : text;
    const int width = dip_min(dip_ui_text_width(tab->ui, TEXT, shown), most);
    const DipRect strip = {rect->x + px(tab, 8), rect->y + rect->height - px(tab, 32),
                           width + px(tab, 18), px(tab, 24)};
    dip_ui_fill_round(tab->ui, strip, px(tab, 4), dip_style_glass);
    dip_ui_text(tab->ui, TEXT, dip_style_soft, DIP_ALIGN_LEFT, strip.x + px(tab, 9),
                strip.y + px(tab, 4), most, shown);
}

static void draw_pane(const Tab *tab, int pane) {
    DipPixels picture;
    uint64_t version;
    if (!shows_over(&tab->maps->view, pane)) {
        return;
    }
    if (knows_values(tab, pane) && tab->window->frames[pane].width > 0 &&
        dip_maps_picture(tab->maps, tab->tools, pane, &tab->window->frames[pane],
                         tab->window->versions[pane], &picture, &version)) {
        dip_ui_picture(tab->ui, tab->window->layout->panes[pane], &picture, version);
        if (is_work_map(tab->tools->map)) {
            draw_numbers(tab, pane);
        }
        if (tab->tools->map == DIP_MAP_FLIP) {
            draw_worst_block(tab, pane);
        }
        draw_described(tab, pane);
    }
    draw_words(tab, pane);
}

// Notes which pixel of the panes' pictures the pointer is over, if any.
static void follow_pointer(const Tab *tab, const DipUiInput panes[DIP_PANE_COUNT]) {
    DipMapView *view = &tab->maps->view;
    view->pointed = false;
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        const DipPixels *frame = &tab->window->frames[p];
        if (panes[p].hovered && !view->pointed) {
            view->pointed =
                dip_loupe_pixel_at(tab->window->layout->panes[p], frame->width, frame->height,
                                   panes[p].x, panes[p].y, &view->x, &view->y);
        }
    }
}

void dip_maps_over_panes(DipUi *ui, DipWindow *window, const DipUiInput panes[DIP_PANE_COUNT]) {
    DipMaps *maps = &window->tools->maps;
    const Tab tab = {ui, window, maps, &window->state->tools};
    const bool shows = tab.tools->comparison == DIP_COMPARE_SIDE_BY_SIDE && !tab.tools->bare;
    const bool is_open = tab.tools->open && tab.tools->tab == DIP_TAB_MAPS && !tab.tools->bare;
    if (!dip_ui_is_drawing(ui)) {
        follow_pointer(&tab, panes);
        return;
    }
    maps->wanted = shows || is_open ? tab.tools->map : DIP_MAP_NONE;
    if (!shows || tab.tools->map == DIP_MAP_NONE) {
        return;
    }
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        draw_pane(&tab, p);
    }
}
