// Explains the chosen map in the maps' tab: draws a scale of the map's colours with the
// distribution of the map's values, or a key of the colours.
#include "app/preview/tabs/maps_tab_private.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// --- the scale -----------------------------------------------------------------------------------

// Counts a pane's values in the map, in CHART_BINS equal bins from 0 to `end`. The last bin also
// counts the values beyond `end`. Returns whether the values are known.
static bool count_values(const Tab *tab, int pane, double end, double counts[CHART_BINS]) {
    const DipMapWork *work = known_work(tab, pane);
    const DipErrorPictures *errors = tab->maps->errors;
    memset(counts, 0, CHART_BINS * sizeof *counts);
    if (!knows_values(tab, pane)) {
        return false;
    }
    if (tab->tools->map == DIP_MAP_FLIP) {
        for (int i = 0; i < DIP_ERROR_BINS; i++) {
            const int bin = (int)((i + 0.5) / DIP_ERROR_BINS / end * CHART_BINS);
            counts[dip_min(bin, CHART_BINS - 1)] += errors->spread[pane].bins[i];
        }
        return true;
    }
    for (int t = 0; t < work->across * work->down; t++) {
        const int bin = (int)(dip_map_value(work, tab->tools->map, t) / end * CHART_BINS);
        counts[dip_min(bin, CHART_BINS - 1)] += 1.0;
    }
    return true;
}

// Returns the height of a bin in the chart, from 0 to 1. For the FLIP map, bins count pixels, and
// the height is logarithmic. For other maps, bins count tiles, and the height is linear.
static double chart_height(const Tab *tab, double count, double most) {
    return tab->tools->map == DIP_MAP_FLIP ? log(count + 1.0) / log(most + 1.0) : count / most;
}

// Draws the outline of one pane's distribution. The outline of the requested pane is dashed.
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
            most = fmax(most, counts[p][i]);
        }
    }
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        if (known[p]) {
            draw_outline(tab, area, p, counts[p], most);
        }
    }
}

double dip_maps_value_at(const Tab *tab, int pane, int x, int y) {
    const DipErrorPictures *errors = tab->maps->errors;
    const DipMapWork *work = known_work(tab, pane);
    if (tab->tools->map == DIP_MAP_FLIP) {
        const bool known = errors && errors->flip[pane] && x < errors->width && y < errors->height;
        return known ? (double)errors->flip[pane][(size_t)y * (size_t)errors->width + (size_t)x]
                     : -1.0;
    }
    return work && x < work->width && y < work->height
               ? dip_map_value(work, tab->tools->map, dip_map_tile(work, x, y))
               : -1.0;
}

// Draws the colour scale as 64 steps, with a mark for each pane's value at the pixel that the tab
// describes.
static void draw_scale(const Tab *tab, DipRect area, double end) {
    enum { STEPS = 64 };
    int x, y;
    for (int i = 0; i < STEPS; i++) {
        const int left = area.x + area.width * i / STEPS;
        const int right = area.x + area.width * (i + 1) / STEPS;
        dip_ui_fill(tab->ui, (DipRect){left, area.y, right - left, area.height},
                    map_colour(tab->tools->map, (float)i / (STEPS - 1)));
    }
    for (int p = 0; described_pixel(tab, &x, &y) && p < DIP_PANE_COUNT; p++) {
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
        if (i == TICKS && tab->tools->brightness > 1) {
            strcat(text, " +");
        }
        dip_ui_text(tab->ui, NOTE, dip_style_soft,
                    i == 0       ? DIP_ALIGN_LEFT
                    : i == TICKS ? DIP_ALIGN_RIGHT
                                 : DIP_ALIGN_CENTRE,
                    area.x + area.width * i / TICKS, area.y, area.width / TICKS, text);
    }
}

static void brightness_buttons(const Tab *tab, DipRect rest) {
    unsigned id = ID_BRIGHTNESS;
    rest.width = px(tab, 100);
    dip_cut_left(&rest, put(tab, NOTE, dip_style_soft, rest, 4, "Brightness") + px(tab, 8));
    for (int brightness = 1; brightness <= DIP_MAP_MAX_BRIGHTNESS; brightness *= 2) {
        char text[8];
        snprintf(text, sizeof text, "%dx", brightness);
        if (dip_ui_button(
                tab->ui, DIP_UI_ID(DIP_UI_MAPS, id++), dip_cut_left(&rest, px(tab, 30)), text,
                dip_max(1, tab->tools->brightness) == brightness ? DIP_UI_CHOSEN : DIP_UI_PLAIN,
                "Ends the scale at this fraction of its full range.\nKeys: [ and ]")) {
            tab->tools->brightness = brightness;
        }
        dip_cut_left(&rest, px(tab, 4));
    }
}

// Draws a scale of the values of both panes or, while none of them is known, why.
static void scale_legend(const Tab *tab, DipRect rest) {
    const char *title = tab->tools->map == DIP_MAP_FLIP        ? "FLIP error per pixel"
                        : tab->tools->map == DIP_MAP_TIME      ? "ms per tile of 64x64"
                        : tab->tools->map == DIP_MAP_FRAGMENTS ? "Fragments per pixel, per tile of "
                                                                 "64x64"
                                                               : "Probes per pixel, per tile of "
                                                                 "64x64";
    const bool flip = tab->tools->map == DIP_MAP_FLIP;
    const double end = dip_maps_end(tab->maps, tab->tools);
    rest.width = dip_min(rest.width, px(tab, 320));
    put(tab, TEXT, dip_style_white, rest, 0, title);
    if (!knows_values(tab, DIP_PANE_CURRENT) && !knows_values(tab, DIP_PANE_REQUESTED)) {
        char room[80];
        dip_cut_top(&rest, px(tab, ROW));
        dip_ui_text_block(tab->ui, NOTE, dip_style_soft, rest,
                          dip_maps_status(tab->maps, tab->tools->map, DIP_PANE_CURRENT,
                                          tab->window->state->shows_gallery, tab->window->still,
                                          room, sizeof room));
        return;
    }
    dip_ui_text(tab->ui, NOTE, dip_style_soft, DIP_ALIGN_RIGHT, dip_rect_right(rest),
                rest.y + px(tab, 2), px(tab, LEGEND_WIDTH), flip ? "pixels, log scale" : "tiles");
    dip_cut_top(&rest, px(tab, ROW));
    DipRect part = dip_cut_top(&rest, px(tab, CHART + 4));
    part.height = px(tab, CHART);
    draw_chart(tab, part, end);
    part = dip_cut_top(&rest, px(tab, BAR + 4));
    part.height = px(tab, BAR);
    draw_scale(tab, part, end);
    draw_ticks(tab, dip_cut_top(&rest, px(tab, 20)), end);
    part = dip_cut_top(&rest, px(tab, 20));
    const int named = put(tab, NOTE, dip_style_white, part, 0, "— Current");
    part.x += named + px(tab, 14);
    put(tab, NOTE, dip_style_accent, part, 0, "- - Requested");
    rest.height = px(tab, 20);
    brightness_buttons(tab, rest);
}

// --- keys ----------------------------------------------------------------------------------------

// Draws a square of a colour with a text beside it. down: distance from the area's top, at scale 1.
static void draw_key(const Tab *tab, DipRect area, int down, DipColour colour, const char *text) {
    const int side = px(tab, 14), thin = px(tab, 2);
    area.y += px(tab, down) + thin;
    const DipRect column = dip_cut_left(&area, side);
    const DipRect square = {column.x, column.y, side, side};
    dip_ui_fill(tab->ui, square, colour);
    dip_ui_outline(tab->ui, square, 0, px(tab, 1), dip_style_line);
    dip_cut_left(&area, px(tab, 8));
    put(tab, NOTE, dip_style_soft, area, 0, text);
}

static void mip_legend(const Tab *tab, DipRect area) {
    put(tab, TEXT, dip_style_white, area, 0, "Mip level, by its size in texels");
    for (int i = 0; i < DIP_MIP_DEBUG_LEVELS; i++) {
        char text[DIP_MIP_TEXT_BYTES];
        dip_map_mip_text(i, text);
        const DipRect half = {area.x + i / 4 * area.width / 2, area.y, area.width / 2, 0};
        draw_key(tab, half, ROW * (i % 4 + 1), dip_map_mip_colour(i), text);
    }
    put(tab, NOTE, dip_style_soft, area, 5 * ROW + 4,
        "Where levels are blended, their colours mix.");
    put(tab, NOTE, dip_style_soft, area, 5 * ROW + 4 + NOTE_ROW,
        "Blurred: the level is too small. Shimmering: too large.");
}

static void samples_legend(const Tab *tab, DipRect area) {
    put(tab, TEXT, dip_style_white, area, 0, "Samples of a pixel, per pixel");
    draw_key(tab, area, ROW, map_colour(DIP_MAP_SAMPLES, 1.0f),
             "Several surfaces, or one that is shaded several times.");
    draw_key(tab, area, 2 * ROW, map_colour(DIP_MAP_SAMPLES, 0.0f),
             "One surface, which is shaded once.");
    put(tab, NOTE, dip_style_soft, area, 3 * ROW + 4,
        "Without antialiasing a pixel has one sample, so none differ.");
}

void dip_maps_legend_block(const Tab *tab, DipRect area) {
    switch (tab->tools->map) {
    case DIP_MAP_NONE:
        put(tab, TEXT, dip_style_white, area, 0, "Where does it go?");
        put(tab, NOTE, dip_style_soft, area, ROW,
            "A map shows over each pane where its error lies");
        put(tab, NOTE, dip_style_soft, area, ROW + NOTE_ROW, "and where its work is done.");
        break;
    case DIP_MAP_MIPS:
        mip_legend(tab, area);
        break;
    case DIP_MAP_SAMPLES:
        samples_legend(tab, area);
        break;
    default:
        scale_legend(tab, area);
        break;
    }
}
