// Draws the parts of a sum of prices, as a bar beside the time budget and as a legend.
#include "app/preview/tabs/sum_parts.h"

#include "app/preview/prices/price_text.h"
#include "app/ui/layout.h"
#include "app/ui/style.h"

#include <math.h>
#include <stdio.h>

enum { NOTE_SIZE = 11, SWATCH = 8, HATCH_STEP = 6 };

enum { PART_BASE, PART_AA, PART_ADAPTIVE, PART_AF, PART_OTHER, PART_COUNT };

static const char *const part_names[PART_COUNT] = {"base", "AA", "adaptive", "AF", "other"};
static const DipColour part_colours[PART_COUNT] = {{139, 149, 162, 255},
                                                   {255, 190, 92, 255},
                                                   {240, 140, 58, 255},
                                                   {255, 226, 143, 255},
                                                   {196, 202, 210, 255}};

// A sum of prices, divided into the parts that the bar and the legend show.
typedef struct Parts {
    double ms[PART_COUNT]; // Time of each part. Doubtful prices are left out.
    double rest_ms;        // The rest of the sum: doubtful prices, and DipPriceSum.together_ms.
    bool doubt;            // rest_ms includes a doubtful price.
} Parts;

static Parts parts_of(const DipPriceSum *sum) {
    // 0 stands for PART_OTHER, since no setting belongs to PART_BASE.
    static const int part_of[DIP_SETTING_COUNT] = {
        [DIP_SETTING_AA] = PART_AA,        [DIP_SETTING_TAA] = PART_AA,
        [DIP_SETTING_AAA] = PART_ADAPTIVE, [DIP_SETTING_ASD] = PART_ADAPTIVE,
        [DIP_SETTING_AF] = PART_AF,        [DIP_SETTING_AAF] = PART_AF,
    };
    Parts parts = {.ms = {[PART_BASE] = sum->base_ms}, .rest_ms = sum->together_ms};
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        if (sum->parts_trust[s] == DIP_PRICE_TRUST_DOUBTFUL) {
            parts.rest_ms += sum->parts_ms[s];
            parts.doubt = true;
        } else {
            parts.ms[part_of[s] ? part_of[s] : PART_OTHER] += sum->parts_ms[s];
        }
    }
    return parts;
}

// Fills a rectangle with slanting stripes.
static void fill_hatched(DipUi *ui, DipRect rect, DipColour colour) {
    const int step = dip_ui_px(ui, HATCH_STEP);
    for (int y = 0; y < rect.height; ++y) {
        for (int x = -(y % step); x < rect.width; x += step) {
            const DipRect stripe = {rect.x + x, rect.y + rect.height - 1 - y, step / 2, 1};
            const DipRect row = {rect.x, stripe.y, rect.width, 1};
            dip_ui_fill(ui, dip_rect_intersect(stripe, row), colour);
        }
    }
}

// Returns the time at the end of the bar's scale: 1.2 budgets, doubled until `ms` fits. Since the
// end only doubles, the scale seldom changes while frame times vary.
static double end_of_scale(double ms, double budget_ms) {
    double end_ms = budget_ms * 1.2;
    while (end_ms < ms * 1.02 && end_ms < 1e6) {
        end_ms *= 2.0;
    }
    return end_ms;
}

void dip_sum_bar_draw(DipUi *ui, const DipPriceSum *sum, double budget_ms, DipRect rect) {
    const Parts parts = parts_of(sum);
    const double rest_ms = parts.rest_ms, sum_ms = sum->ms;
    const double per_ms = rect.width / end_of_scale(sum_ms - fmin(rest_ms, 0.0), budget_ms);
    const int over_budget = (int)(budget_ms * per_ms), end = (int)(sum_ms * per_ms);
    const int overhang = dip_ui_px(ui, 4);
    DipRect over = rect, bar = rect;
    double at_ms = 0.0;
    dip_ui_fill(ui, rect, dip_style_well);
    dip_cut_left(&over, over_budget);
    dip_ui_fill(ui, over, dip_style_over);
    for (int i = 0; i < PART_COUNT; ++i) {
        bar.x = rect.x + (int)(at_ms * per_ms);
        at_ms += fmax(parts.ms[i], 0.0);
        bar.width = rect.x + (int)(at_ms * per_ms) - bar.x - 1;
        dip_ui_fill(ui, bar, part_colours[i]);
    }
    const int parts_end = (int)(at_ms * per_ms);
    if (rest_ms > 0.0) {
        const int width = dip_max(1, (int)(rest_ms * per_ms));
        fill_hatched(ui, (DipRect){rect.x + parts_end, rect.y, width, rect.height},
                     dip_style_accent);
    }
    if (rest_ms < 0.0) { // The sum is less than its parts together. Stripes cover the difference.
        fill_hatched(ui, (DipRect){rect.x + end, rect.y, parts_end - end - 1, rect.height},
                     dip_style_well);
    }
    if (sum_ms > budget_ms) {
        over.width = end - over_budget;
        fill_hatched(ui, over, dip_style_worse);
    }
    over.width = dip_ui_px(ui, 2);
    dip_ui_fill(ui, dip_rect_inset(over, 0, -overhang), dip_style_white);
}

// Draws an entry of the legend at the left side of *rest, or in the row below if it does not fit.
// Draws nothing if the time rounds to 0.0. room: the legend's first row.
static void draw_entry(DipUi *ui, DipRect room, DipRect *rest, const char *name, double ms,
                       DipPriceTrust trust, DipColour colour, bool rest_of_sum) {
    const int swatch = dip_ui_px(ui, SWATCH), gap = dip_ui_px(ui, 4);
    char text[64], digits[DIP_STEP_NAME_BYTES];
    if (fabs(ms) < 0.05) {
        return;
    }
    if (rest_of_sum) {
        dip_panel_number(ms, 1, true, digits);
    } else {
        dip_ms_text(ms, trust, INFINITY, digits);
    }
    snprintf(text, sizeof text, "%s %s", name, digits);
    const int width = swatch + gap + dip_ui_text_width(ui, NOTE_SIZE, text);
    if (width > rest->width && rest->x > room.x) {
        const int y = rest->y + dip_ui_px(ui, DIP_SUM_LEGEND_HEIGHT);
        *rest = room;
        rest->y = y;
    }
    const DipRect box = dip_rect_middle(dip_cut_left(rest, swatch), swatch, swatch);
    (rest_of_sum ? fill_hatched : dip_ui_fill)(ui, box, colour);
    dip_cut_left(rest, gap);
    dip_ui_word(ui, NOTE_SIZE, dip_style_soft, rest, dip_ui_px(ui, 9), text);
}

void dip_sum_legend_draw(DipUi *ui, const DipPriceSum *sum, DipRect row) {
    const Parts parts = parts_of(sum);
    DipRect rest = row;
    for (int i = 0; i < PART_COUNT; ++i) {
        const bool frame = i == PART_BASE && sum->state == DIP_PRICE_UNKNOWN;
        draw_entry(ui, row, &rest, frame ? "a frame" : part_names[i], parts.ms[i],
                   i == PART_BASE ? sum->base_trust : DIP_PRICE_TRUST_KNOWN, part_colours[i],
                   false);
    }
    draw_entry(ui, row, &rest, parts.doubt ? "doubtful parts" : "together", parts.rest_ms,
               DIP_PRICE_TRUST_KNOWN, dip_style_accent, true);
}
