// Draws the tables of the maps' tab: one of the whole frame, and one of the pixel or the tile under
// the mouse or at the pinned pixel.
#include "app/preview/prices/price_text.h"
#include "app/preview/tabs/maps_tab_private.h"

#include <math.h>
#include <stdio.h>

// --- tables --------------------------------------------------------------------------------------

typedef enum Comparison { NOT_COMPARED, BY_FACTOR, IN_PER_CENT } Comparison;

// The rows of the two tables of work. `name` and `format` are for the table of the whole frame;
// `tile_name` and `tile_format` are for the table of one tile.
static const struct {
    DipMap map;
    const char *name;
    const char *format;
    const char *tile_name;
    const char *tile_format;
} work_rows[] = {{DIP_MAP_TIME, "tiles, 1 core", "%.1f ms", "time", "%.2f ms"},
                 {DIP_MAP_FRAGMENTS, "fragments", "%.0f", "fragments/px", "%.2f"},
                 {DIP_MAP_PROBES, "probes", "%.0f", "probes/px", "%.2f"},
                 {DIP_MAP_SAMPLES, "mixed pixels", "%.0f", "mixed pixels", "%.0f"}};
enum { WORK_ROWS = sizeof work_rows / sizeof *work_rows };

// Returns whether a pane's unknown values will be known once pictures rest.
static bool waits(const Tab *tab, int pane) {
    return dip_maps_can_measure(tab->maps, tab->tools->map, pane, tab->window->state->shows_gallery,
                                tab->window->still);
}

// Writes a row of a table: a name, both panes' values and their comparison. A value below 0 is not
// known: a mark stands in its place if the value waits, otherwise nothing. With IN_PER_CENT, the
// colour says whether the change is better or worse; a smaller value is better.
static void put_row(const Tab *tab, DipRect area, int index, const char *name, const char *format,
                    const double values[DIP_PANE_COUNT], Comparison comparison) {
    const int ends[DIP_PANE_COUNT] = {px(tab, 152), px(tab, 216)};
    char text[32];
    area.y += px(tab, ROW * (index + 1));
    dip_ui_text(tab->ui, TEXT, dip_style_soft, DIP_ALIGN_LEFT, area.x, area.y, px(tab, 90), name);
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        const bool known = values[p] >= 0.0;
        snprintf(text, sizeof text, format, values[p]);
        if (known || waits(tab, p)) {
            dip_ui_text(tab->ui, TEXT, known ? dip_style_of_pane(p) : dip_style_dim,
                        DIP_ALIGN_RIGHT, area.x + ends[p], area.y, px(tab, LEGEND_WIDTH),
                        known ? text : DIP_WAITING_MARK);
        }
    }
    if (comparison == NOT_COMPARED || values[0] <= 0.0 || values[1] < 0.0) {
        return;
    }
    const double change = 100.0 * (values[1] / values[0] - 1.0);
    DipColour colour = dip_style_soft;
    if (comparison == BY_FACTOR) {
        snprintf(text, sizeof text, "x %.1f", values[1] / values[0]);
    } else if (fabs(change) <= 0.5) {
        snprintf(text, sizeof text, "%.0f %%", fabs(change));
    } else {
        char digits[DIP_STEP_NAME_BYTES];
        dip_panel_number(change, 0, true, digits);
        snprintf(text, sizeof text, "%s %%", digits);
        colour = change < 0.0 ? dip_style_gain : dip_style_worse;
    }
    dip_cut_left(&area, px(tab, 226));
    put(tab, TEXT, colour, area, 0, text);
}

static void flip_table(const Tab *tab, DipRect area) {
    static const char *const names[] = {"FLIP, mean", "95 % below", "99 % below", "worst block",
                                        "RMSE"};
    enum { ROWS = sizeof names / sizeof *names };
    const DipErrorPictures *errors = tab->maps->errors;
    double values[ROWS][DIP_PANE_COUNT];
    put(tab, TEXT, dip_style_white, area, 0, "This frame, all pixels");
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        const bool known = errors && errors->flip[p];
        const DipPaneError error = known ? errors->result.panes[p] : (DipPaneError){0};
        const DipFlipTail tail = known ? errors->spread[p].tail : (DipFlipTail){0};
        const double found[ROWS] = {error.flip, tail.p95, tail.p99, tail.worst, error.rmse_lin};
        for (int i = 0; i < ROWS; i++) {
            values[i][p] = known ? found[i] : -1.0;
        }
    }
    for (int i = 0; i < ROWS; i++) {
        put_row(tab, area, i, names[i], "%.4f", values[i], IN_PER_CENT);
    }
    if (errors) {
        char text[80];
        snprintf(text, sizeof text, "Truth: 2 x %d samples, noise %.4f", errors->result.samples / 2,
                 errors->result.floor_rmse);
        put(tab, NOTE, dip_style_dim, area, 6 * ROW + 4, text);
    }
}

// Returns the sum of a map's values over a frame, in milliseconds or as a count; -1 if `work` is
// NULL.
static double sum_of(const DipMapWork *work, DipMap map) {
    double sum = 0.0;
    for (int t = 0; work && t < work->across * work->down; t++) {
        const double pixels = map == DIP_MAP_TIME ? 1.0 : dip_map_tile_pixels(work, t);
        sum += pixels * dip_map_value(work, map, t);
    }
    return work ? sum : -1.0;
}

static void work_table(const Tab *tab, DipRect area) {
    double values[DIP_PANE_COUNT], geometry_ms[DIP_PANE_COUNT], mirrored_ms = 0.0;
    put(tab, TEXT, dip_style_white, area, 0, "Whole frame");
    for (int i = 0; i < WORK_ROWS; i++) {
        for (int p = 0; p < DIP_PANE_COUNT; p++) {
            values[p] = sum_of(known_work(tab, p), work_rows[i].map);
        }
        put_row(tab, area, i, work_rows[i].name, work_rows[i].format, values, BY_FACTOR);
    }
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        const DipMapWork *work = known_work(tab, p);
        geometry_ms[p] = work ? work->geometry_ms : -1.0;
        mirrored_ms = work ? fmax(mirrored_ms, work->mirrored_ms) : mirrored_ms;
    }
    put_row(tab, area, WORK_ROWS, "before tiles", "%.2f ms", geometry_ms, BY_FACTOR);
    char text[96];
    snprintf(text, sizeof text,
             mirrored_ms > 0.0 ? "Not in tiles: geometry, other passes %.1f ms"
                               : "Not in the tiles: geometry.",
             mirrored_ms);
    put(tab, NOTE, dip_style_dim, area, 6 * ROW + 4, text);
}

void dip_maps_frame_block(const Tab *tab, DipRect area) {
    if (tab->tools->map == DIP_MAP_FLIP) {
        flip_table(tab, area);
    } else if (is_work_map(tab->tools->map) || tab->tools->map == DIP_MAP_SAMPLES) {
        work_table(tab, area);
    }
}

// --- under the mouse -----------------------------------------------------------------------------

// Writes a pane's value at a pixel, beside a square that has the value's colour and a border in the
// pane's colour.
static void put_swatch(const Tab *tab, int pane, DipRect area, DipColour colour,
                       const char *value) {
    const int side = px(tab, 22), gap = px(tab, 8);
    const DipColour own = dip_style_of_pane(pane);
    area.y += px(tab, ROW + 18 + 30 * pane);
    area.height = side;
    const DipRect square = dip_cut_left(&area, side);
    dip_ui_fill(tab->ui, square, own);
    const int edge = px(tab, 1), inner = side - px(tab, 2);
    dip_ui_fill(tab->ui, (DipRect){square.x + edge, square.y + edge, inner, inner}, colour);
    dip_cut_left(&area, gap);
    area.width = px(tab, 160);
    area.x += put(tab, 15, own, area, 2, value) + gap;
    area.width = px(tab, 100);
    put(tab, NOTE, dip_style_soft, area, 5, pane ? "requested" : "current");
}

static void pixel_values(const Tab *tab, DipRect area, int x, int y) {
    const DipMap map = tab->tools->map;
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        const DipMapWork *work = known_work(tab, p);
        const bool inside = work && x < work->width && y < work->height;
        const int mip = dip_maps_mip_index(tab->maps, p, x, y);
        const double flip = map == DIP_MAP_FLIP ? dip_maps_value_at(tab, p, x, y) : -1.0;
        char text[40] = "";
        if (map == DIP_MAP_MIPS && inside && mip >= 0) {
            char size[DIP_MIP_TEXT_BYTES];
            dip_map_mip_text(mip, size);
            snprintf(text, sizeof text, "%s texels", size);
            put_swatch(tab, p, area, dip_map_mip_colour(mip), text);
        } else if (map == DIP_MAP_MIPS && inside) {
            put_swatch(tab, p, area, dip_style_well, "no mip colour");
        } else if (map == DIP_MAP_SAMPLES && inside) {
            const bool mixed = work->mixed[(size_t)y * (size_t)work->width + (size_t)x];
            put_swatch(tab, p, area, map_colour(map, mixed),
                       mixed ? "they differ" : "all the same");
        } else if (flip >= 0.0) {
            dip_map_format(flip, text, sizeof text);
            put_swatch(tab, p, area,
                       map_colour(map, (float)(flip / dip_maps_end(tab->maps, tab->tools))), text);
        } else if (waits(tab, p)) {
            put_swatch(tab, p, area, dip_style_well, DIP_WAITING_MARK);
        }
    }
}

static void tile_values(const Tab *tab, DipRect area, int x, int y) {
    double values[DIP_PANE_COUNT], shares[DIP_PANE_COUNT];
    for (int i = 0; i < WORK_ROWS; i++) {
        const DipMap map = work_rows[i].map;
        for (int p = 0; p < DIP_PANE_COUNT; p++) {
            const DipMapWork *work = known_work(tab, p);
            const bool known = work && x < work->width && y < work->height;
            const int tile = known ? dip_map_tile(work, x, y) : 0;
            values[p] = known ? dip_map_value(work, map, tile) : -1.0;
            shares[p] = known ? values[p] * (100.0 / sum_of(work, map)) : -1.0;
            values[p] *= known && map == DIP_MAP_SAMPLES ? dip_map_tile_pixels(work, tile) : 1;
        }
        put_row(tab, area, i ? i + 1 : 0, work_rows[i].tile_name, work_rows[i].tile_format, values,
                BY_FACTOR);
        if (map == DIP_MAP_TIME) {
            put_row(tab, area, 1, "of the frame", "%.1f %%", shares, NOT_COMPARED);
        }
    }
}

void dip_maps_mouse_block(const Tab *tab, DipRect area) {
    const char *title =
        tab->maps->view.pointed || !tab->tools->pinned ? "Under the mouse" : "At the pinned pixel";
    const bool tiles = is_work_map(tab->tools->map);
    int x, y;
    char text[64];
    if (tab->tools->map == DIP_MAP_NONE) {
        return;
    }
    const bool known = described_pixel(tab, &x, &y);
    if (known && tiles) {
        snprintf(text, sizeof text, "%s: tile %d, %d", title, x / DIP_TARGET_TILE,
                 y / DIP_TARGET_TILE);
        put(tab, TEXT, dip_style_white, area, 0, text);
        tile_values(tab, area, x, y);
        return;
    }
    snprintf(text, sizeof text, known ? "pixel %d, %d" : "Point at a pane.", x, y);
    put(tab, TEXT, dip_style_white, area, 0, title);
    put(tab, NOTE, dip_style_soft, area, ROW, text);
    if (known) {
        pixel_values(tab, area, x, y);
    }
}
