// The dock's tab of maps: its buttons, and where its parts lie.
#include "app/preview/tabs/maps_tab_private.h"

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
    DipMapView *view = dip_maps_view(tab->maps);
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

void dip_maps_declare_tab(DipUi *ui, DipWindow *window, DipMaps *maps, DipRect body) {
    const Tab tab = {ui, window, maps, &window->state->tools};
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
