// What the maps' tab says of the values: colour scales with their distribution, keys, and tables
// of the whole frame and of the pixel under the mouse.
#include "app/measure/metrics/flip.h"
#include "app/preview/tabs/maps_tab_private.h"
#include "app/preview/tools/map_colours.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// Counts the values of a pane in CHART_BINS bins up to `end`. Values beyond it are in the last bin.
static bool count_values(const Tab *tab, int pane, double end, double counts[CHART_BINS]) {
    const DipMapWork *work = dip_maps_work(tab->maps, pane);
    const DipErrorPictures *errors = tab->maps->errors;
    memset(counts, 0, CHART_BINS * sizeof *counts);
    if (tab->tools->map == DIP_MAP_FLIP) {
        for (int i = 0; errors && errors->flip[pane] && i < DIP_ERROR_BINS; i++) {
            const int bin = (int)((i + 0.5) / DIP_ERROR_BINS / end * CHART_BINS);
            counts[dip_min(bin, CHART_BINS - 1)] += errors->spread[pane].bins[i];
        }
        return errors && errors->flip[pane];
    }
    for (int t = 0; work->draws && t < work->across * work->down; t++) {
        const int bin = (int)(dip_map_value(work, tab->tools->map, t) / end * CHART_BINS);
        counts[dip_min(bin, CHART_BINS - 1)] += 1.0;
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
        const int top = dip_min(y, before), height = (y > before ? y : before) - top;
        dip_ui_fill(tab->ui, (DipRect){left, top, thick, height}, dip_style_of_pane(pane));
        const int step = pane == DIP_PANE_CURRENT ? right - left + 1 : dash + hole;
        for (int x = left; x < right + (pane == DIP_PANE_CURRENT); x += step) {
            const int end = pane == DIP_PANE_CURRENT ? right + thick : dip_min(x + dash, right);
            dip_ui_fill(tab->ui, (DipRect){x, y, end - x, thick}, dip_style_of_pane(pane));
        }
        before = y;
    }
}

static void draw_chart(const Tab *tab, DipRect area, double end) {
    double counts[DIP_PANE_COUNT][CHART_BINS];
    bool known[DIP_PANE_COUNT];
    double most = 1.0;
    dip_ui_fill(tab->ui, area, dip_style_well);
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

double dip_maps_value_at(const Tab *tab, int pane, int x, int y) {
    const DipErrorPictures *errors = tab->maps->errors;
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
        const double value = dip_maps_value_at(tab, p, x, y);
        const double share = value < end ? value / end : 1.0;
        if (value >= 0.0) {
            dip_ui_fill(tab->ui,
                        (DipRect){area.x + (int)(share * area.width) - px(tab, 1),
                                  area.y - px(tab, 3), px(tab, 2), area.height + px(tab, 6)},
                        dip_style_of_pane(p));
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
        dip_ui_text(tab->ui, NOTE, dip_style_soft,
                    i == 0       ? DIP_ALIGN_LEFT
                    : i == TICKS ? DIP_ALIGN_RIGHT
                                 : DIP_ALIGN_CENTRE,
                    area.x + area.width * i / TICKS, area.y, area.width / TICKS, text);
    }
}

static void brightness_buttons(const Tab *tab, int x, int y) {
    static const int steps[BRIGHTNESS_COUNT] = {1, 2, 4, 8};
    const int width = px(tab, 30), gap = px(tab, 4);
    x += put(tab, NOTE, dip_style_soft, x, y + px(tab, 4), px(tab, 100), "Brightness") + px(tab, 8);
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
        return dip_map_name(map);
    }
}

static void scale_legend(const Tab *tab, DipRect area) {
    const bool flip = tab->tools->map == DIP_MAP_FLIP;
    const double end = dip_maps_end(tab->maps, tab->tools);
    const int width = dip_min(area.width, px(tab, 320));
    int y = area.y;
    put(tab, TEXT, dip_style_white, area.x, y, width, legend_title(tab->tools->map));
    put_right(tab, NOTE, dip_style_soft, area.x + width, y + px(tab, 2),
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
    const int named = put(tab, NOTE, dip_style_white, area.x, y, width, "— Current");
    put(tab, NOTE, dip_style_accent, area.x + named + px(tab, 14), y, width, "- - Requested");
    brightness_buttons(tab, area.x, y + px(tab, 20));
}

// A square of a colour with words beside it.
static void draw_key(const Tab *tab, int x, int y, int room, DipColour colour, const char *text) {
    const int side = px(tab, 14);
    const DipRect square = {x, y + px(tab, 2), side, side};
    dip_ui_fill(tab->ui, square, colour);
    dip_ui_outline(tab->ui, square, 0, px(tab, 1), dip_style_line);
    put(tab, NOTE, dip_style_soft, x + side + px(tab, 8), y + px(tab, 2), room - side - px(tab, 8),
        text);
}

static void mip_legend(const Tab *tab, DipRect area) {
    put(tab, TEXT, dip_style_white, area.x, area.y, area.width, "Mip level, by its size in texels");
    for (int i = 0; i < DIP_MIP_DEBUG_LEVELS; i++) {
        char text[32];
        snprintf(text, sizeof text, "%d%s", 1024 >> i,
                 i == 0                          ? " and more"
                 : i == DIP_MIP_DEBUG_LEVELS - 1 ? " and fewer"
                                                 : "");
        draw_key(tab, area.x + i / 4 * area.width / 2, area.y + px(tab, ROW * (i % 4 + 1)),
                 area.width / 2, dip_map_mip_colour(i), text);
    }
    put(tab, NOTE, dip_style_soft, area.x, area.y + px(tab, 5 * ROW + 4), area.width,
        "Where levels are blended, their colours mix.");
    put(tab, NOTE, dip_style_soft, area.x, area.y + px(tab, 5 * ROW + 4 + NOTE_ROW), area.width,
        "Blurred: the level is too small. Shimmering: too large.");
}

static void samples_legend(const Tab *tab, DipRect area) {
    uint8_t first[3], last[3];
    dip_cividis(0.0f, first);
    dip_cividis(1.0f, last);
    put(tab, TEXT, dip_style_white, area.x, area.y, area.width, "Samples of a pixel, per pixel");
    draw_key(tab, area.x, area.y + px(tab, ROW), area.width,
             (DipColour){last[0], last[1], last[2], 255}, "They show more than one surface.");
    draw_key(tab, area.x, area.y + px(tab, 2 * ROW), area.width,
             (DipColour){first[0], first[1], first[2], 255}, "They all show one.");
    put(tab, NOTE, dip_style_soft, area.x, area.y + px(tab, 3 * ROW + 4), area.width,
        "Without antialiasing a pixel has one sample, so none differ.");
}

void dip_maps_legend_block(const Tab *tab, DipRect area) {
    switch (tab->tools->map) {
    case DIP_MAP_NONE:
        put(tab, TEXT, dip_style_white, area.x, area.y, area.width, "Where does it go?");
        put(tab, NOTE, dip_style_soft, area.x, area.y + px(tab, ROW), area.width,
            "A map shows over each pane where its error lies");
        put(tab, NOTE, dip_style_soft, area.x, area.y + px(tab, ROW + NOTE_ROW), area.width,
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
    const DipErrorPictures *errors = tab->maps->errors;
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
    const char *title =
        tab->maps->view.pointed || !tab->tools->pinned ? "Under the mouse" : "At the pinned pixel";
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
