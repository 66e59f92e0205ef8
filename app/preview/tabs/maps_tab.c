// The dock's tab of maps: its buttons, where its parts lie, and what the maps show over the panes.
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
    [DIP_MAP_SAMPLES] = "The pixels whose samples show more than one surface.\n"
                        "Only these gain from antialiasing.",
    [DIP_MAP_MIPS] = "Which mip level each surface reads.",
};

static const DipMap map_order[] = {DIP_MAP_TIME,    DIP_MAP_FRAGMENTS, DIP_MAP_PROBES,
                                   DIP_MAP_SAMPLES, DIP_MAP_MIPS,      DIP_MAP_FLIP};
enum { MAP_BUTTONS = sizeof map_order / sizeof *map_order };

const char *dip_map_name(DipMap map) {
    return map_names[map];
}

static void map_button(const Tab *tab, int index, DipRect rect) {
    const DipMap map = map_order[index];
    const bool chosen = tab->tools->map == map;
    if (dip_ui_button(tab->ui, DIP_UI_ID(DIP_UI_MAPS, ID_MAP + index), rect, map_names[map],
                      chosen ? DIP_UI_CHOSEN : DIP_UI_PLAIN, map_tips[map])) {
        dip_maps_choose(tab->tools, chosen ? DIP_MAP_NONE : map);
    }
}

// Declares the choice of panes at x, y.
static void over_buttons(const Tab *tab, int x, int y, int right) {
    static const char *const long_names[] = {"both", "current", "requested"};
    static const char *const short_names[] = {"both", "left", "right"};
    DipMapView *view = &tab->maps->view;
    const bool narrow = right - x < px(tab, 220);
    const char *const *names = narrow ? short_names : long_names;
    x += put(tab, TEXT, dip_style_soft, x, y + px(tab, 4), right - x, "over") + px(tab, BUTTON_GAP);
    for (int i = 0; i < 3; i++) {
        const int width = dip_ui_text_width(tab->ui, TEXT, names[i]) + px(tab, 16);
        if (x + width > right) {
            return;
        }
        const DipRect rect = {x, y, width, px(tab, SMALL_BUTTON)};
        if (dip_ui_button(tab->ui, DIP_UI_ID(DIP_UI_MAPS, ID_OVER + i), rect, names[i],
                          (int)view->over == i ? DIP_UI_CHOSEN : DIP_UI_PLAIN,
                          "Which panes show the map.")) {
            view->over = (DipMapOver)i;
        }
        x += width + px(tab, BUTTON_GAP);
    }
}

static void buttons_block(const Tab *tab, DipRect area) {
    const int pitch = px(tab, BUTTON + BUTTON_GAP), gap = px(tab, BUTTON_GAP);
    // Two columns, or more if the dock is low.
    int columns = 2;
    while (columns < MAP_BUTTONS && MAP_BUTTONS / columns * pitch > area.height + gap) {
        columns++;
    }
    const int width = (area.width - (columns - 1) * gap) / columns;
    int y = area.y;
    for (int i = 0; i < MAP_BUTTONS; i++) {
        y = area.y + i / columns * pitch;
        map_button(tab, i,
                   (DipRect){area.x + i % columns * (width + gap), y, width, px(tab, BUTTON)});
    }
    y += pitch + px(tab, 4);
    if (y + px(tab, SMALL_BUTTON) <= area.y + area.height) {
        over_buttons(tab, area.x, y, area.x + area.width);
    }
    y += px(tab, SMALL_BUTTON + BUTTON_GAP);
    if (y + px(tab, 2 * NOTE_ROW) <= area.y + area.height) {
        dip_ui_text_block(tab->ui, NOTE, dip_style_soft,
                          (DipRect){area.x, y, area.width, area.y + area.height - y},
                          "Both panes have one scale, so that colours compare. N shows the next "
                          "map.");
    }
}

// Takes room for blocks from left to right and, where there is height, in several rows.
typedef struct Flow {
    DipRect left;   // Room that is left.
    int row_height; // Height of the blocks of this row.
    int x;          // Where the next block of the row begins.
} Flow;

// Returns whether a block fits, and where. Lengths are pixels.
static bool take(const Tab *tab, Flow *flow, int width, int height, DipRect *area) {
    if (flow->x + width > flow->left.x + flow->left.width && flow->row_height) {
        const int used = flow->row_height + px(tab, MARGIN);
        flow->left.y += used;
        flow->left.height -= used;
        flow->x = flow->left.x;
        flow->row_height = 0;
    }
    if (flow->x + width > flow->left.x + flow->left.width || height > flow->left.height) {
        return false;
    }
    *area = (DipRect){flow->x, flow->left.y, width, height};
    flow->x += width + px(tab, GAP);
    flow->row_height = height > flow->row_height ? height : flow->row_height;
    return true;
}

void dip_tab_maps(DipUi *ui, DipWindow *window, DipRect body) {
    const Tab tab = {ui, window, window->tools->maps, &window->state->tools};
    const int margin = px(&tab, MARGIN);
    Flow flow = {
        .left = {body.x + margin, body.y + margin, body.width - 2 * margin, body.height - margin}};
    flow.x = flow.left.x;
    DipRect area;
    const int buttons = dip_min(px(&tab, BUTTONS_WIDTH), flow.left.width);
    if (take(&tab, &flow, buttons, dip_min(px(&tab, 190), flow.left.height), &area)) {
        buttons_block(&tab, area);
    }
    const int legend = dip_min(px(&tab, LEGEND_WIDTH), flow.left.width);
    if (take(&tab, &flow, legend, px(&tab, 172), &area)) {
        dip_maps_legend_block(&tab, area);
    }
    const int table = dip_min(px(&tab, TABLE_WIDTH), flow.left.width);
    if (take(&tab, &flow, table, px(&tab, 130), &area)) {
        dip_maps_mouse_block(&tab, area);
    }
    if (take(&tab, &flow, table, px(&tab, 152), &area)) {
        dip_maps_frame_block(&tab, area);
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
    const DipErrorPictures *errors = tab->maps->errors;
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
    if (!shows_over(&tab->maps->view, pane)) {
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
    DipMaps *maps = window->tools->maps;
    const Tab tab = {ui, window, maps, &window->state->tools};
    const bool shows = tab.tools->comparison == DIP_COMPARE_SIDE_BY_SIDE && !tab.tools->bare;
    if (!dip_ui_is_drawing(ui)) {
        follow_pointer(&tab, panes);
        return;
    }
    maps->wanted = shows ? tab.tools->map : DIP_MAP_NONE;
    if (!shows || tab.tools->map == DIP_MAP_NONE) {
        return;
    }
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        draw_pane(&tab, p);
    }
}
