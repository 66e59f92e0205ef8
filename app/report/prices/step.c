// Finds the price of a step from the difference of two rows of one path, or of two whole times.
#include "app/report/prices/prices.h"

#include "app/report/combinations.h"
#include "app/report/prices/view.h"

#include <math.h>
#include <stdio.h>

// --- trust ---------------------------------------------------------------------------------------

// The widest interval that holds 0 and stands for a price of 0, as a share of the time without the
// step. A wider interval comes from a busy machine or from a prediction, and tells nothing.
static const double widest_zero = 0.2;
// The widest interval of a time that is not doubtful, as a share of the time. An interval of
// narrow_ms is always narrow enough, because the panel shows times to a tenth of a millisecond.
static const double widest_share = 0.5;
static const double narrow_ms = 0.2;
static const double least_shown_ms = 0.05; // Smaller times would be shown as 0.0.

static bool is_wide(double ms, double low, double high) {
    return !(high - low <= fmax(widest_share * fabs(ms), narrow_ms));
}

DipPriceTrust dip_price_trust(const DipPrice *price) {
    const double width = price->ms_high - price->ms_low;
    if (price->state == DIP_PRICE_UNKNOWN) {
        return DIP_PRICE_TRUST_UNKNOWN;
    }
    if (price->doubtful) {
        return DIP_PRICE_TRUST_DOUBTFUL;
    }
    if (price->state != DIP_PRICE_BASE && price->ms_low <= 0.0 && price->ms_high >= 0.0) {
        return width <= widest_zero * price->without_ms ? DIP_PRICE_TRUST_ZERO
                                                        : DIP_PRICE_TRUST_DOUBTFUL;
    }
    return is_wide(price->ms, price->ms_low, price->ms_high) ? DIP_PRICE_TRUST_DOUBTFUL
           : fabs(price->ms) < least_shown_ms                ? DIP_PRICE_TRUST_ZERO
                                                             : DIP_PRICE_TRUST_KNOWN;
}

DipPriceTrust dip_price_sum_trust(const DipPriceSum *sum) {
    return sum->state == DIP_PRICE_UNKNOWN                                ? DIP_PRICE_TRUST_UNKNOWN
           : sum->doubtful || is_wide(sum->ms, sum->ms_low, sum->ms_high) ? DIP_PRICE_TRUST_DOUBTFUL
                                                                          : DIP_PRICE_TRUST_KNOWN;
}

// --- where a price was measured ------------------------------------------------------------------

// Finds the path on which a price was measured: the first path that has rows of both combinations
// of the question. Returns -1 if there is none.
static int find_path(const DipPriceView *view, const DipPriceQuestion *question) {
    for (int path = 0; path < view->report->path_count; path++) {
        const DipPriceEntry *with = dip_price_find(view, path, &question->with);
        const DipPriceEntry *without = dip_price_find(view, path, &question->without);
        if (with && with->row >= 0 && without && without->row >= 0) {
            return path;
        }
    }
    return -1;
}

// Finds the path for the step with which the other steps are compared: the path on which the price
// of another step was measured, or path 0 if there is none.
static int find_base_path(const DipPriceView *view, DipSetting setting, const DipQuality *pane) {
    for (int step = 0; step < dip_setting_info(setting)->step_count; step++) {
        const DipPriceQuestion question = dip_price_question(&view->base, setting, step, pane);
        const int path = question.is_base ? -1 : find_path(view, &question);
        if (path >= 0) {
            return path;
        }
    }
    return 0;
}

// --- prices --------------------------------------------------------------------------------------

static void fill_base(DipPrice *price, const DipPriceWhole *whole) {
    if (whole->state != DIP_PRICE_UNKNOWN) {
        price->state = DIP_PRICE_BASE;
        price->ms = whole->time.value;
        price->ms_low = whole->time.low;
        price->ms_high = whole->time.high;
    }
    price->has_flip = whole->has_flip;
    price->flip = whole->flip;
    price->flip_at_floor = whole->flip_at_floor;
}

// Makes a price from two rows of one path. Its time is the difference of the rows' times. The
// interval comes from the ratio of the two rows, because both share the machine's speed in this
// run.
static void fill_step(DipPrice *price, const DipCostReport *report, int row, int without) {
    const DipEstimate change = dip_cost_metric_change(report, row, without, DIP_COST_FLIP);
    if (dip_cost_is_timed(report, row) && dip_cost_is_timed(report, without)) {
        const DipEstimate ratio = dip_cost_ratio(report, row, without);
        const double base_ms = dip_cost_ms(report, without);
        price->state = dip_cost_is_view(report) ? DIP_PRICE_ROUGH : DIP_PRICE_MEASURED;
        price->ms = dip_cost_ms(report, row) - base_ms;
        if (row != without) { // If one row stands for both, low and high stay 0.
            price->ms_low = price->ms - (ratio.value - ratio.low) * base_ms;
            price->ms_high = price->ms + (ratio.high - ratio.value) * base_ms;
        }
        price->without_ms = base_ms;
    }
    price->has_flip = !isnan(change.value);
    if (price->has_flip) {
        price->flip = change.value;
        price->flip_at_floor = dip_cost_at_floor(report, row);
    }
}

// Returns the price that fill_step makes from two rows. Computes it only if the view does not
// remember it.
static const DipPrice *price_of_rows(const DipPriceView *view, int row, int without) {
    DipPriceMemory *memory =
        &view->kept->memories[(row * DIP_COST_MAX_ROWS + without) % DIP_PRICE_MEMORIES];
    if (!memory->is_known || memory->row != row || memory->without != without) {
        *memory = (DipPriceMemory){.is_known = true, .row = row, .without = without};
        fill_step(&memory->price, view->report, row, without);
    }
    return &memory->price;
}

// Makes a price from two whole times, at least one of which is predicted. Their errors count as
// independent.
static void fill_difference(DipPrice *price, const DipPriceWhole *with,
                            const DipPriceWhole *without) {
    const DipEstimate *a = &with->time, *b = &without->time;
    if (with->state != DIP_PRICE_UNKNOWN && without->state != DIP_PRICE_UNKNOWN) {
        price->state = DIP_PRICE_PREDICTED;
        price->ms = a->value - b->value;
        price->ms_low = price->ms - hypot(a->value - a->low, b->high - b->value);
        price->ms_high = price->ms + hypot(a->high - a->value, b->value - b->low);
        price->without_ms = b->value;
    }
    price->has_flip = with->has_flip && without->has_flip;
    if (price->has_flip) {
        price->flip = with->flip - without->flip;
        price->flip_at_floor = with->flip_at_floor;
    }
}

static DipPrice answer(const DipPriceView *view, DipSetting setting, const DipQuality *pane,
                       const DipPriceQuestion *question) {
    const int path =
        question->is_base ? find_base_path(view, setting, pane) : find_path(view, question);
    DipPrice price = {.state = DIP_PRICE_UNKNOWN};
    const DipPriceEntry *with = dip_price_find(view, path > 0 ? path : 0, &question->with);
    const DipPriceEntry *without = dip_price_find(view, path > 0 ? path : 0, &question->without);
    if (!with || !without) {
        return price;
    }
    const DipPriceWhole whole = dip_price_known(view, with);
    if (question->is_base) {
        fill_base(&price, &whole);
    } else if (path >= 0) {
        price = *price_of_rows(view, with->row, without->row);
    } else {
        const DipPriceWhole less = dip_price_known(view, without);
        fill_difference(&price, &whole, &less);
    }
    price.doubtful = dip_price_is_doubtful(view);
    if (!dip_cost_is_view(view->report)) {
        snprintf(price.path, sizeof price.path, "%s", view->report->paths[path > 0 ? path : 0]);
    }
    return price;
}

// --- companies -----------------------------------------------------------------------------------

// The settings that are left out of the company, so they have the base's steps. AF and advanced AF
// are priced with up to three companies in turn: the pane's antialiasing, its AA with the base's
// adaptive AA, and the base's antialiasing.
static const unsigned left_out[] = {0, 1u << DIP_SETTING_AAA | 1u << DIP_SETTING_ASD,
                                    DIP_PRICE_ANTIALIASING};
enum { COMPANIES = sizeof left_out / sizeof *left_out };

// How much is known of a price (the results of knowledge). 0 means that nothing is known, and 1
// that only the error is.
enum { PREDICTED = 2, MEASURED };

static int knowledge(const DipPrice *price) {
    return price->state == DIP_PRICE_UNKNOWN     ? price->has_flip
           : price->state == DIP_PRICE_PREDICTED ? PREDICTED
                                                 : MEASURED;
}

static void name_company(DipPrice *price, const DipQuality *base, const DipQuality *without) {
    size_t length = 0;
    for (int s = 0; s < DIP_SETTING_COUNT && length < sizeof price->beside; s++) {
        const DipSettingInfo *info = dip_setting_info((DipSetting)s);
        if (without->step[s] != base->step[s]) {
            length +=
                (size_t)snprintf(price->beside + length, sizeof price->beside - length, "%s%s=%s",
                                 length > 0 ? "," : "", info->key, info->steps[without->step[s]]);
        }
    }
}

DipPrice dip_price_step(const DipPriceView *view, DipSetting setting, int step,
                        const DipQuality *quality) {
    const DipQuality *base = &view->base;
    const DipPriceQuestion question = dip_price_question(base, setting, step, quality);
    DipPrice price = answer(view, setting, quality, &question);
    const int companies = dip_price_filters(setting) ? COMPANIES : 1;
    DipQuality without = question.without;
    for (int i = 1; i < companies && knowledge(&price) < MEASURED; i++) {
        const DipQuality pane = dip_cost_take_settings(quality, base, left_out[i]);
        const DipPriceQuestion other = dip_price_question(base, setting, step, &pane);
        const DipPrice otherwise = answer(view, setting, &pane, &other);
        if (knowledge(&otherwise) > knowledge(&price)) {
            price = otherwise;
            without = other.without;
        }
    }
    if (price.state != DIP_PRICE_BASE) {
        name_company(&price, base, &without);
    }
    price.needs_company = question.needs[0] != '\0';
    snprintf(price.needs, sizeof price.needs, "%s", question.needs);
    return price;
}
