// The dock's tab of maps, and what the maps show over the panes.
#include "app/measure/magma.h"
#include "app/preview/map_colours.h"
#include "app/preview/maps.h"
#include "app/preview/maps_tab.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const DipColour white = {255, 255, 255, 255}; // The current pane, and values.
static const DipColour soft = {196, 202, 210, 255};  // Words.
static const DipColour dim = {152, 162, 174, 255};   // Notes.
static const DipColour amber = {255, 190, 92, 255};  // The requested pane.
static const DipColour gain = {95, 214, 189, 255};   // Less error.
static const DipColour worse = {255, 154, 139, 255}; // More error.
static const DipColour line = {51, 58, 68, 255};
static const DipColour well = {12, 14, 17, 255};   // Ground of the chart.
static const DipColour glass = {10, 12, 15, 199};  // Ground of words over a picture.
static const DipColour shadow = {10, 12, 15, 255}; // Edges of marks over a picture.

// Lengths at scale 1.
enum {
    MARGIN = 10,
    GAP = 22, // Between the tab's blocks.
    TEXT = 13,
    NOTE = 11,
    ROW = 21,
    NOTE_ROW = 14,
    BUTTON = 28,
    SMALL_BUTTON = 24,
    BUTTON_GAP = 6,
    CHART = 64,
    BAR = 16,
    BUTTONS_WIDTH = 282,
    LEGEND_WIDTH = 346,
    TABLE_WIDTH = 282,
};

enum { ID_MAP = 1, ID_OVER = 20, ID_BRIGHTNESS = 30 };

// The side of a worst block is that of dip_flip_tail_add.
enum { CHART_BINS = 25, BRIGHTNESS_COUNT = 4, WORST_BLOCK = 32 };

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

// What the blocks of the tab are drawn from.
typedef struct Tab {
    DipUi *ui;
    DipWindow *window;
    DipMaps *maps;
    DipToolState *tools;
} Tab;

static int px(const Tab *tab, int length) {
    return dip_ui_px(tab->ui, length);
}

static int smaller(int a, int b) {
    return a < b ? a : b;
}

static DipColour pane_colour(int pane) {
    return pane == DIP_PANE_CURRENT ? white : amber;
}

// Writes a line of text at scale-independent size, and returns its width.
static int put(const Tab *tab, int size, DipColour colour, int x, int y, int room,
               const char *text) {
    dip_ui_text(tab->ui, size, colour, DIP_ALIGN_LEFT, x, y, room, text);
    return dip_ui_text_width(tab->ui, size, text);
}

static void put_right(const Tab *tab, int size, DipColour colour, int x, int y, const char *text) {
    dip_ui_text(tab->ui, size, colour, DIP_ALIGN_RIGHT, x, y, px(tab, LEGEND_WIDTH), text);
}

static bool is_work_map(DipMap map) {
    return map == DIP_MAP_TIME || map == DIP_MAP_FRAGMENTS || map == DIP_MAP_PROBES;
}

// Returns the pixel that the tab describes: the one under the pointer, or else the pinned one.
static bool pointed_pixel(const Tab *tab, int *x, int *y) {
    const DipMapView *view = dip_maps_view(tab->maps);
    const DipPixels *frame = &tab->window->frames[DIP_PANE_CURRENT];
    *x = view->pointed ? view->x : tab->tools->x;
    *y = view->pointed ? view->y : tab->tools->y;
    return (view->pointed || tab->tools->pinned) && *x >= 0 && *y >= 0 && *x < frame->width &&
           *y < frame->height;
}

// --- buttons -------------------------------------------------------------------------------------

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
    x += put(tab, TEXT, soft, x, y + px(tab, 4), right - x, "over") + px(tab, BUTTON_GAP);
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
        dip_ui_text_block(tab->ui, NOTE, soft,
                          (DipRect){area.x, y, area.width, area.y + area.height - y},
                          "Both panes have one scale, so that colours compare. N shows the next "
                          "map.");
    }
}

// --- legend --------------------------------------------------------------------------------------

// Counts the values of a pane in CHART_BINS bins up to `end`. Values beyond it are in the last bin.
static bool count_values(const Tab *tab, int pane, double end, double counts[CHART_BINS]) {
    const DipMapWork *work = dip_maps_work(tab->maps, pane);
    const DipErrorPictures *errors = dip_maps_errors(tab->maps);
    memset(counts, 0, CHART_BINS * sizeof *counts);
    if (tab->tools->map == DIP_MAP_FLIP) {
        for (int i = 0; errors && errors->flip[pane] && i < DIP_ERROR_BINS; i++) {
            const int bin = (int)((i + 0.5) / DIP_ERROR_BINS / end * CHART_BINS);
            counts[smaller(bin, CHART_BINS - 1)] += errors->spread[pane].bins[i];
        }
        return errors && errors->flip[pane];
    }
    for (int t = 0; work->draws && t < work->across * work->down; t++) {
        const int bin = (int)(dip_map_value(work, tab->tools->map, t) / end * CHART_BINS);
        counts[smaller(bin, CHART_BINS - 1)] += 1.0;
    }
    return work->draws > 0;
}

// Height of a count in the chart, 0..1. Pixels are shown on a logarithmic scale.
static double chart_height(const Tab *tab, double count, double most) {
    return tab->tools->map == DIP_MAP_FLIP ? log(count + 1.0) / log(most + 1.0) : count / most;
}

// Draws the outline of one pane's distribution; the requested pane's is dashed.
static void draw_outline(const Tab *tab, DipRect area, int pane, const double counts[CHART_BINS],
                         double most) {
    const int thick = px(tab, 2), dash = px(tab, 5), hole = px(tab, 3);
    int before = area.y + area.height - thick;
    for (int i = 0; i < CHART_BINS; i++) {
        const int left = area.x + area.width * i / CHART_BINS;
        const int right = area.x + area.width * (i + 1) / CHART_BINS;
        const int rise = (int)(chart_height(tab, counts[i], most) * (area.height - 2 * thick));
        const int y = area.y + area.height - thick - rise;
        const int top = smaller(y, before), height = (y > before ? y : before) - top;
        dip_ui_fill(tab->ui, (DipRect){left, top, thick, height}, pane_colour(pane));
        const int step = pane == DIP_PANE_CURRENT ? right - left + 1 : dash + hole;
        for (int x = left; x < right + (pane == DIP_PANE_CURRENT); x += step) {
            const int end = pane == DIP_PANE_CURRENT ? right + thick : smaller(x + dash, right);
            dip_ui_fill(tab->ui, (DipRect){x, y, end - x, thick}, pane_colour(pane));
        }
        before = y;
    }
}

static void draw_chart(const Tab *tab, DipRect area, double end) {
    double counts[DIP_PANE_COUNT][CHART_BINS];
    bool known[DIP_PANE_COUNT];
    double most = 1.0;
    dip_ui_fill(tab->ui, area, well);
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        known[p] = count_values(tab, p, end, counts[p]);
        for (int i = 0; i < CHART_BINS; i++) {
            most = counts[p][i] > most ? counts[p][i] : most;
        }
    }
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        if (known[p]) {
            draw_outline(tab, area, p, counts[p], most);
        }
    }
}

// Draws the colour scale as 64 steps.
static void draw_scale(const Tab *tab, DipRect area) {
    enum { STEPS = 64 };
    for (int i = 0; i < STEPS; i++) {
        uint8_t rgb[3];
        const int left = area.x + area.width * i / STEPS;
        const int right = area.x + area.width * (i + 1) / STEPS;
        (tab->tools->map == DIP_MAP_FLIP ? dip_magma : dip_cividis)((float)i / (STEPS - 1), rgb);
        dip_ui_fill(tab->ui, (DipRect){left, area.y, right - left, area.height},
                    (DipColour){rgb[0], rgb[1], rgb[2], 255});
    }
}

// Returns a pane's value at a pixel, or a number below 0 if it is not known.
static double value_at(const Tab *tab, int pane, int x, int y) {
    const DipErrorPictures *errors = dip_maps_errors(tab->maps);
    const DipMapWork *work = dip_maps_work(tab->maps, pane);
    if (tab->tools->map == DIP_MAP_FLIP) {
        const bool known = errors && errors->flip[pane] && x < errors->width && y < errors->height;
        return known ? (double)errors->flip[pane][(size_t)y * (size_t)errors->width + (size_t)x]
                     : -1.0;
    }
    return work->draws && x < work->width && y < work->height
               ? dip_map_value(work, tab->tools->map, dip_map_tile(work, x, y))
               : -1.0;
}

// Marks the values of the pixel under the pointer on the scale.
static void draw_scale_marks(const Tab *tab, DipRect area, double end) {
    int x, y;
    for (int p = 0; pointed_pixel(tab, &x, &y) && p < DIP_PANE_COUNT; p++) {
        const double value = value_at(tab, p, x, y);
        const double share = value < end ? value / end : 1.0;
        if (value >= 0.0) {
            dip_ui_fill(tab->ui,
                        (DipRect){area.x + (int)(share * area.width) - px(tab, 1),
                                  area.y - px(tab, 3), px(tab, 2), area.height + px(tab, 6)},
                        pane_colour(p));
        }
    }
}

static void draw_ticks(const Tab *tab, DipRect area, double end) {
    enum { TICKS = 5 };
    for (int i = 0; i <= TICKS; i++) {
        char text[16];
        dip_map_format(end * i / TICKS, text, sizeof text - 2);
        if (i == TICKS && tab->tools->brightness > 1.0) {
            strcat(text, " +");
        }
        dip_ui_text(tab->ui, NOTE, soft,
                    i == 0       ? DIP_ALIGN_LEFT
                    : i == TICKS ? DIP_ALIGN_RIGHT
                                 : DIP_ALIGN_CENTRE,
                    area.x + area.width * i / TICKS, area.y, area.width / TICKS, text);
    }
}

static void brightness_buttons(const Tab *tab, int x, int y) {
    static const int steps[BRIGHTNESS_COUNT] = {1, 2, 4, 8};
    const int width = px(tab, 30), gap = px(tab, 4);
    x += put(tab, NOTE, soft, x, y + px(tab, 4), px(tab, 100), "Brightness") + px(tab, 8);
    for (int i = 0; i < BRIGHTNESS_COUNT; i++, x += width + gap) {
        char text[8];
        snprintf(text, sizeof text, "%dx", steps[i]);
        const double brightness = tab->tools->brightness >= 1.0 ? tab->tools->brightness : 1.0;
        if (dip_ui_button(tab->ui, DIP_UI_ID(DIP_UI_MAPS, ID_BRIGHTNESS + i),
                          (DipRect){x, y, width, px(tab, 20)}, text,
                          brightness == steps[i] ? DIP_UI_CHOSEN : DIP_UI_PLAIN,
                          "Ends the scale at this fraction of its full range.\nKeys: [ and ]")) {
            tab->tools->brightness = steps[i];
        }
    }
}

static const char *legend_title(DipMap map) {
    switch (map) {
    case DIP_MAP_FLIP:
        return "FLIP error per pixel";
    case DIP_MAP_TIME:
        return "ms per tile of 64x64";
    case DIP_MAP_FRAGMENTS:
        return "Fragments per pixel, per tile of 64x64";
    case DIP_MAP_PROBES:
        return "Probes per pixel, per tile of 64x64";
    default:
        return map_names[map];
    }
}

static void scale_legend(const Tab *tab, DipRect area) {
    const bool flip = tab->tools->map == DIP_MAP_FLIP;
    const double end = dip_maps_end(tab->maps, tab->tools);
    const int width = smaller(area.width, px(tab, 320));
    int y = area.y;
    put(tab, TEXT, white, area.x, y, width, legend_title(tab->tools->map));
    put_right(tab, NOTE, soft, area.x + width, y + px(tab, 2),
              flip ? "pixels, log scale" : "tiles");
    y += px(tab, ROW);
    draw_chart(tab, (DipRect){area.x, y, width, px(tab, CHART)}, end);
    y += px(tab, CHART + 4);
    const DipRect scale = {area.x, y, width, px(tab, BAR)};
    draw_scale(tab, scale);
    draw_scale_marks(tab, scale, end);
    y += px(tab, BAR + 4);
    draw_ticks(tab, (DipRect){area.x, y, width, px(tab, NOTE_ROW)}, end);
    y += px(tab, 20);
    const int named = put(tab, NOTE, white, area.x, y, width, "— Current");
    put(tab, NOTE, amber, area.x + named + px(tab, 14), y, width, "- - Requested");
    brightness_buttons(tab, area.x, y + px(tab, 20));
}

// A square of a colour with words beside it.
static void draw_key(const Tab *tab, int x, int y, int room, DipColour colour, const char *text) {
    const int side = px(tab, 14);
    const DipRect square = {x, y + px(tab, 2), side, side};
    dip_ui_fill(tab->ui, square, colour);
    dip_ui_outline(tab->ui, square, 0, px(tab, 1), line);
    put(tab, NOTE, soft, x + side + px(tab, 8), y + px(tab, 2), room - side - px(tab, 8), text);
}

static void mip_legend(const Tab *tab, DipRect area) {
    put(tab, TEXT, white, area.x, area.y, area.width, "Mip level, by its size in texels");
    for (int i = 0; i < DIP_MIP_DEBUG_LEVELS; i++) {
        char text[32];
        snprintf(text, sizeof text, "%d%s", 1024 >> i,
                 i == 0                          ? " and more"
                 : i == DIP_MIP_DEBUG_LEVELS - 1 ? " and fewer"
                                                 : "");
        draw_key(tab, area.x + i / 4 * area.width / 2, area.y + px(tab, ROW * (i % 4 + 1)),
                 area.width / 2, dip_map_mip_colour(i), text);
    }
    put(tab, NOTE, soft, area.x, area.y + px(tab, 5 * ROW + 4), area.width,
        "Where levels are blended, their colours mix.");
    put(tab, NOTE, soft, area.x, area.y + px(tab, 5 * ROW + 4 + NOTE_ROW), area.width,
        "Blurred: the level is too small. Shimmering: too large.");
}

static void samples_legend(const Tab *tab, DipRect area) {
    uint8_t first[3], last[3];
    dip_cividis(0.0f, first);
    dip_cividis(1.0f, last);
    put(tab, TEXT, white, area.x, area.y, area.width, "Samples of a pixel, per pixel");
    draw_key(tab, area.x, area.y + px(tab, ROW), area.width,
             (DipColour){last[0], last[1], last[2], 255}, "They show more than one surface.");
    draw_key(tab, area.x, area.y + px(tab, 2 * ROW), area.width,
             (DipColour){first[0], first[1], first[2], 255}, "They all show one.");
    put(tab, NOTE, soft, area.x, area.y + px(tab, 3 * ROW + 4), area.width,
        "Without antialiasing a pixel has one sample, so none differ.");
}

static void legend_block(const Tab *tab, DipRect area) {
    switch (tab->tools->map) {
    case DIP_MAP_NONE:
        put(tab, TEXT, white, area.x, area.y, area.width, "Where does it go?");
        put(tab, NOTE, soft, area.x, area.y + px(tab, ROW), area.width,
            "A map shows over each pane where its error lies");
        put(tab, NOTE, soft, area.x, area.y + px(tab, ROW + NOTE_ROW), area.width,
            "and where its work is done.");
        return;
    case DIP_MAP_MIPS:
        mip_legend(tab, area);
        return;
    case DIP_MAP_SAMPLES:
        samples_legend(tab, area);
        return;
    default:
        scale_legend(tab, area);
    }
}

// --- tables --------------------------------------------------------------------------------------

// A row of a table: a name, both panes' values and a comparison, which may be NULL.
typedef struct Row {
    const char *name;
    char values[DIP_PANE_COUNT][24];
    char compared[24];
    DipColour colour; // Of the comparison.
} Row;

static void put_row(const Tab *tab, DipRect area, int index, const Row *row) {
    const int y = area.y + px(tab, ROW * (index + 1));
    put(tab, TEXT, soft, area.x, y, px(tab, 90), row->name);
    put_right(tab, TEXT, white, area.x + px(tab, 152), y, row->values[DIP_PANE_CURRENT]);
    put_right(tab, TEXT, amber, area.x + px(tab, 216), y, row->values[DIP_PANE_REQUESTED]);
    put(tab, TEXT, row->colour, area.x + px(tab, 226), y, area.width - px(tab, 226), row->compared);
}

// Compares two numbers as a factor.
static Row factor_row(const char *name, const char *format, const double values[DIP_PANE_COUNT]) {
    Row row = {.name = name, .colour = soft};
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        if (values[p] >= 0.0) {
            snprintf(row.values[p], sizeof row.values[p], format, values[p]);
        }
    }
    if (values[0] > 0.0 && values[1] >= 0.0) {
        snprintf(row.compared, sizeof row.compared, "x %.1f", values[1] / values[0]);
    }
    return row;
}

// Compares two errors in per cent.
static Row error_row(const char *name, const double values[DIP_PANE_COUNT]) {
    Row row = {.name = name, .colour = soft};
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        if (values[p] >= 0.0) {
            snprintf(row.values[p], sizeof row.values[p], "%.4f", values[p]);
        }
    }
    if (values[0] > 0.0 && values[1] >= 0.0) {
        const double change = 100.0 * (values[1] / values[0] - 1.0);
        row.colour = change < -0.5 ? gain : change > 0.5 ? worse : soft;
        snprintf(row.compared, sizeof row.compared, "%s%.0f %%",
                 change < -0.5  ? "\u2212"
                 : change > 0.5 ? "+"
                                : "",
                 fabs(change));
    }
    return row;
}

static void flip_table(const Tab *tab, DipRect area) {
    const DipErrorPictures *errors = dip_maps_errors(tab->maps);
    double values[5][DIP_PANE_COUNT];
    static const char *const names[5] = {"FLIP, mean", "95 % below", "99 % below", "worst block",
                                         "RMSE"};
    put(tab, TEXT, white, area.x, area.y, area.width, "This frame, all pixels");
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        const bool known = errors && errors->flip[p];
        values[0][p] = known ? errors->result.panes[p].flip : -1.0;
        values[1][p] = known ? errors->spread[p].tail.p95 : -1.0;
        values[2][p] = known ? errors->spread[p].tail.p99 : -1.0;
        values[3][p] = known ? errors->spread[p].tail.worst : -1.0;
        values[4][p] = known ? errors->result.panes[p].rmse_lin : -1.0;
    }
    for (int i = 0; i < 5; i++) {
        const Row row = error_row(names[i], values[i]);
        put_row(tab, area, i, &row);
    }
    if (errors) {
        char text[80];
        snprintf(text, sizeof text, "Truth: 2 x %d samples, noise %.4f", errors->result.samples / 2,
                 errors->result.floor_rmse);
        put(tab, NOTE, dim, area.x, area.y + px(tab, 6 * ROW + 4), area.width, text);
    }
}

// Sums a map's values over a frame: milliseconds, or counts.
static double sum_of(const DipMapWork *work, DipMap map) {
    double sum = 0.0;
    for (int t = 0; work->draws && t < work->across * work->down; t++) {
        const double pixels = map == DIP_MAP_TIME ? 1.0 : dip_map_tile_pixels(work, t);
        sum += pixels * dip_map_value(work, map, t);
    }
    return work->draws ? sum : -1.0;
}

static void work_table(const Tab *tab, DipRect area) {
    static const DipMap maps[] = {DIP_MAP_TIME, DIP_MAP_FRAGMENTS, DIP_MAP_PROBES, DIP_MAP_SAMPLES};
    static const char *const names[] = {"tiles, 1 core", "fragments", "probes", "mixed pixels"};
    static const char *const formats[] = {"%.1f ms", "%.0f", "%.0f", "%.0f"};
    double geometry_ms[DIP_PANE_COUNT], mirrored_ms = 0.0;
    put(tab, TEXT, white, area.x, area.y, area.width, "Whole frame");
    for (int i = 0; i < 4; i++) {
        double values[DIP_PANE_COUNT];
        for (int p = 0; p < DIP_PANE_COUNT; p++) {
            const DipMapWork *work = dip_maps_work(tab->maps, p);
            values[p] = sum_of(work, maps[i]);
            geometry_ms[p] = work->draws ? work->geometry_ms : -1.0;
            mirrored_ms =
                work->draws && work->mirrored_ms > mirrored_ms ? work->mirrored_ms : mirrored_ms;
        }
        const Row row = factor_row(names[i], formats[i], values);
        put_row(tab, area, i, &row);
    }
    const Row row = factor_row("before tiles", "%.2f ms", geometry_ms);
    put_row(tab, area, 4, &row);
    char text[96];
    snprintf(text, sizeof text,
             mirrored_ms > 0.0 ? "Not in tiles: geometry, %.1f ms of reflection"
                               : "Not in the tiles: geometry.",
             mirrored_ms);
    put(tab, NOTE, dim, area.x, area.y + px(tab, 6 * ROW + 4), area.width, text);
}

static void frame_block(const Tab *tab, DipRect area) {
    if (tab->tools->map == DIP_MAP_FLIP) {
        flip_table(tab, area);
    } else if (is_work_map(tab->tools->map) || tab->tools->map == DIP_MAP_SAMPLES) {
        work_table(tab, area);
    }
}

// --- under the mouse -----------------------------------------------------------------------------

// The map's colour of a value, or the mip map's colour of a level.
static DipColour colour_of(const Tab *tab, double value) {
    const double end = dip_maps_end(tab->maps, tab->tools);
    uint8_t rgb[3];
    (tab->tools->map == DIP_MAP_FLIP ? dip_magma : dip_cividis)((float)(value / end), rgb);
    return (DipColour){rgb[0], rgb[1], rgb[2], 255};
}

static void put_swatch(const Tab *tab, int pane, int x, int y, DipColour colour,
                       const char *value) {
    static const char *const names[DIP_PANE_COUNT] = {"current", "requested"};
    const int side = px(tab, 22);
    dip_ui_fill(tab->ui, (DipRect){x, y, side, side}, pane_colour(pane));
    dip_ui_fill(tab->ui,
                (DipRect){x + px(tab, 1), y + px(tab, 1), side - px(tab, 2), side - px(tab, 2)},
                colour);
    x += side + px(tab, 8);
    x += put(tab, 15, pane_colour(pane), x, y + px(tab, 2), px(tab, 120), value) + px(tab, 8);
    put(tab, NOTE, soft, x, y + px(tab, 5), px(tab, 100), names[pane]);
}

static void pixel_values(const Tab *tab, DipRect area, int x, int y) {
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        const int top = area.y + px(tab, ROW + 18 + 30 * p);
        const int mip = dip_maps_mip_size(tab->maps, p, x, y);
        const DipMapWork *work = dip_maps_work(tab->maps, p);
        char text[40] = "";
        if (tab->tools->map == DIP_MAP_MIPS && mip) {
            int index = 0;
            while (1024 >> index > mip) {
                index++;
            }
            snprintf(text, sizeof text, "about %d texels", mip);
            put_swatch(tab, p, area.x, top, dip_map_mip_colour(index), text);
        } else if (tab->tools->map == DIP_MAP_MIPS) {
            put_swatch(tab, p, area.x, top, well, "no mip colour");
        } else if (tab->tools->map == DIP_MAP_SAMPLES && work->draws && x < work->width &&
                   y < work->height) {
            const bool mixed = work->mixed[(size_t)y * (size_t)work->width + (size_t)x];
            uint8_t rgb[3];
            dip_cividis(mixed, rgb);
            put_swatch(tab, p, area.x, top, (DipColour){rgb[0], rgb[1], rgb[2], 255},
                       mixed ? "they differ" : "all the same");
        } else if (tab->tools->map == DIP_MAP_FLIP && value_at(tab, p, x, y) >= 0.0) {
            const double value = value_at(tab, p, x, y);
            dip_map_format(value, text, sizeof text);
            put_swatch(tab, p, area.x, top, colour_of(tab, value), text);
        }
    }
}

static void tile_values(const Tab *tab, DipRect area, int x, int y) {
    static const DipMap maps[] = {DIP_MAP_TIME, DIP_MAP_FRAGMENTS, DIP_MAP_PROBES, DIP_MAP_SAMPLES};
    static const char *const names[] = {"time", "fragments/px", "probes/px", "mixed pixels"};
    static const char *const formats[] = {"%.2f ms", "%.2f", "%.2f", "%.0f"};
    for (int i = 0; i < 5; i++) {
        double values[DIP_PANE_COUNT];
        for (int p = 0; p < DIP_PANE_COUNT; p++) {
            const DipMapWork *work = dip_maps_work(tab->maps, p);
            const bool known = work->draws && x < work->width && y < work->height;
            const int tile = known ? dip_map_tile(work, x, y) : 0;
            values[p] = known ? dip_map_value(work, maps[i ? i - 1 : 0], tile) : -1.0;
            if (known && i == 1) {
                values[p] *= 100.0 / sum_of(work, DIP_MAP_TIME);
            } else if (known && i == 4) {
                values[p] *= dip_map_tile_pixels(work, tile);
            }
        }
        Row row = i == 1 ? factor_row("of the frame", "%.1f %%", values)
                         : factor_row(names[i ? i - 1 : 0], formats[i ? i - 1 : 0], values);
        if (i == 1) {
            row.compared[0] = '\0';
        }
        put_row(tab, area, i, &row);
    }
}

static void mouse_block(const Tab *tab, DipRect area) {
    int x, y;
    char text[64];
    const bool tiles = is_work_map(tab->tools->map);
    if (tab->tools->map == DIP_MAP_NONE) {
        return;
    }
    const char *title = dip_maps_view(tab->maps)->pointed || !tab->tools->pinned
                            ? "Under the mouse"
                            : "At the pinned pixel";
    if (!pointed_pixel(tab, &x, &y)) {
        put(tab, TEXT, white, area.x, area.y, area.width, title);
        put(tab, NOTE, soft, area.x, area.y + px(tab, ROW), area.width, "Point at a pane.");
        return;
    }
    if (tiles) {
        snprintf(text, sizeof text, "%s: tile %d, %d", title, x / DIP_TARGET_TILE,
                 y / DIP_TARGET_TILE);
        put(tab, TEXT, white, area.x, area.y, area.width, text);
        tile_values(tab, area, x, y);
        return;
    }
    put(tab, TEXT, white, area.x, area.y, area.width, title);
    snprintf(text, sizeof text, "pixel %d, %d", x, y);
    put(tab, NOTE, soft, area.x, area.y + px(tab, ROW), area.width, text);
    pixel_values(tab, area, x, y);
}

// --- the tab -------------------------------------------------------------------------------------

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
    const int buttons = smaller(px(&tab, BUTTONS_WIDTH), flow.left.width);
    if (take(&tab, &flow, buttons, smaller(px(&tab, 190), flow.left.height), &area)) {
        buttons_block(&tab, area);
    }
    const int legend = smaller(px(&tab, LEGEND_WIDTH), flow.left.width);
    if (take(&tab, &flow, legend, px(&tab, 172), &area)) {
        legend_block(&tab, area);
    }
    const int table = smaller(px(&tab, TABLE_WIDTH), flow.left.width);
    if (take(&tab, &flow, table, px(&tab, 130), &area)) {
        mouse_block(&tab, area);
    }
    if (take(&tab, &flow, table, px(&tab, 152), &area)) {
        frame_block(&tab, area);
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
                      (DipRect){x, y, smaller(DIP_TARGET_TILE, work->width - x),
                                smaller(DIP_TARGET_TILE, work->height - y)});
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
        dip_ui_text(tab->ui, NOTE, shadow, DIP_ALIGN_RIGHT, x + one, y + one, rect.width, text);
        dip_ui_text(tab->ui, NOTE, shadow, DIP_ALIGN_RIGHT, x - one, y - one, rect.width, text);
        dip_ui_text(tab->ui, NOTE, white, DIP_ALIGN_RIGHT, x, y, rect.width, text);
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
        const DipColour colour = pass ? pane_colour(pane) : shadow;
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
                                              smaller(WORST_BLOCK, errors->width),
                                              smaller(WORST_BLOCK, errors->height)});
    const int edge = px(tab, 1);
    char value[16], text[32];
    dip_map_format(tail->worst, value, sizeof value);
    snprintf(text, sizeof text, "worst block: %s", value);
    dip_ui_outline(tab->ui, rect, 0, 3 * edge, shadow);
    dip_ui_outline(tab->ui, rect, 0, edge, pane_colour(pane));
    const DipRect *shown = &tab->window->layout->panes[pane];
    const int width = dip_ui_text_width(tab->ui, NOTE, text) + px(tab, 8);
    const int height = dip_ui_line_height(tab->ui, NOTE) + px(tab, 2);
    const bool above = rect.y - height >= shown->y;
    const DipRect strip = {smaller(rect.x, shown->x + shown->width - width),
                           above ? rect.y - height : rect.y + rect.height, width, height};
    dip_ui_fill(tab->ui, strip, glass);
    put(tab, NOTE, white, strip.x + px(tab, 4), strip.y + edge, width, text);
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
    dip_ui_outline(tab->ui, rect, 0, px(tab, 5), shadow);
    dip_ui_outline(tab->ui,
                   (DipRect){rect.x + px(tab, 1), rect.y + px(tab, 1), rect.width - px(tab, 2),
                             rect.height - px(tab, 2)},
                   0, px(tab, 3), pane_colour(pane));
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
    snprintf(text, sizeof text, "%s: %s", map_names[tab->tools->map], status);
    const char *shown = text;
    const int most = rect->width - px(tab, 34);
    if (dip_ui_text_width(tab->ui, TEXT, text) > most) {
        shown = status;
    }
    const int width = smaller(dip_ui_text_width(tab->ui, TEXT, shown), most);
    const DipRect strip = {rect->x + px(tab, 8), rect->y + rect->height - px(tab, 32),
                           width + px(tab, 18), px(tab, 24)};
    dip_ui_fill_round(tab->ui, strip, px(tab, 4), glass);
    put(tab, TEXT, soft, strip.x + px(tab, 9), strip.y + px(tab, 4), most, shown);
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
