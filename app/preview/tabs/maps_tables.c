// The tables of the maps' tab: values of the whole frame, and those under the mouse.
#include "app/preview/tabs/maps_tab_private.h"

#include "app/measure/metrics/magma.h"
#include "app/preview/tools/map_colours.h"

#include <math.h>
#include <stdio.h>

// A row of a table: a name, both panes' values and a comparison, which may be NULL.
typedef struct Row {
    const char *name;
    char values[DIP_PANE_COUNT][24];
    char compared[24];
    DipColour colour; // Of the comparison.
} Row;

static void put_row(const Tab *tab, DipRect area, int index, const Row *row) {
    const int y = area.y + px(tab, ROW * (index + 1));
    put(tab, TEXT, dip_style_soft, area.x, y, px(tab, 90), row->name);
    put_right(tab, TEXT, dip_style_white, area.x + px(tab, 152), y, row->values[DIP_PANE_CURRENT]);
    put_right(tab, TEXT, dip_style_accent, area.x + px(tab, 216), y,
              row->values[DIP_PANE_REQUESTED]);
    put(tab, TEXT, row->colour, area.x + px(tab, 226), y, area.width - px(tab, 226), row->compared);
}

// Compares two numbers as a factor.
static Row factor_row(const char *name, const char *format, const double values[DIP_PANE_COUNT]) {
    Row row = {.name = name, .colour = dip_style_soft};
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
    Row row = {.name = name, .colour = dip_style_soft};
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        if (values[p] >= 0.0) {
            snprintf(row.values[p], sizeof row.values[p], "%.4f", values[p]);
        }
    }
    if (values[0] > 0.0 && values[1] >= 0.0) {
        const double change = 100.0 * (values[1] / values[0] - 1.0);
        row.colour = change < -0.5  ? dip_style_gain
                     : change > 0.5 ? dip_style_worse
                                    : dip_style_soft;
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
    put(tab, TEXT, dip_style_white, area.x, area.y, area.width, "This frame, all pixels");
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
        put(tab, NOTE, dip_style_dim, area.x, area.y + px(tab, 6 * ROW + 4), area.width, text);
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
    put(tab, TEXT, dip_style_white, area.x, area.y, area.width, "Whole frame");
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
    put(tab, NOTE, dip_style_dim, area.x, area.y + px(tab, 6 * ROW + 4), area.width, text);
}

void dip_maps_frame_block(const Tab *tab, DipRect area) {
    if (tab->tools->map == DIP_MAP_FLIP) {
        flip_table(tab, area);
    } else if (is_work_map(tab->tools->map) || tab->tools->map == DIP_MAP_SAMPLES) {
        work_table(tab, area);
    }
}

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
    dip_ui_fill(tab->ui, (DipRect){x, y, side, side}, dip_style_of_pane(pane));
    dip_ui_fill(tab->ui,
                (DipRect){x + px(tab, 1), y + px(tab, 1), side - px(tab, 2), side - px(tab, 2)},
                colour);
    x += side + px(tab, 8);
    x += put(tab, 15, dip_style_of_pane(pane), x, y + px(tab, 2), px(tab, 120), value) + px(tab, 8);
    put(tab, NOTE, dip_style_soft, x, y + px(tab, 5), px(tab, 100), names[pane]);
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
            put_swatch(tab, p, area.x, top, dip_style_well, "no mip colour");
        } else if (tab->tools->map == DIP_MAP_SAMPLES && work->draws && x < work->width &&
                   y < work->height) {
            const bool mixed = work->mixed[(size_t)y * (size_t)work->width + (size_t)x];
            uint8_t rgb[3];
            dip_cividis(mixed, rgb);
            put_swatch(tab, p, area.x, top, (DipColour){rgb[0], rgb[1], rgb[2], 255},
                       mixed ? "they differ" : "all the same");
        } else if (tab->tools->map == DIP_MAP_FLIP && dip_maps_value_at(tab, p, x, y) >= 0.0) {
            const double value = dip_maps_value_at(tab, p, x, y);
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

void dip_maps_mouse_block(const Tab *tab, DipRect area) {
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
        put(tab, TEXT, dip_style_white, area.x, area.y, area.width, title);
        put(tab, NOTE, dip_style_soft, area.x, area.y + px(tab, ROW), area.width,
            "Point at a pane.");
        return;
    }
    if (tiles) {
        snprintf(text, sizeof text, "%s: tile %d, %d", title, x / DIP_TARGET_TILE,
                 y / DIP_TARGET_TILE);
        put(tab, TEXT, dip_style_white, area.x, area.y, area.width, text);
        tile_values(tab, area, x, y);
        return;
    }
    put(tab, TEXT, dip_style_white, area.x, area.y, area.width, title);
    snprintf(text, sizeof text, "pixel %d, %d", x, y);
    put(tab, NOTE, dip_style_soft, area.x, area.y + px(tab, ROW), area.width, text);
    pixel_values(tab, area, x, y);
}
