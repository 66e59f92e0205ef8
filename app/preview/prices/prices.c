// Holds the report that was read and the report that is measured here, and says which one is used.
#include "app/preview/prices/prices.h"

#include "app/files/put.h"
#include "app/measure/metrics/flip.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct DipPrices {
    DipPriceView *read;     // View of the report that was read from a file; NULL if there is none.
    DipCostReport measured; // The live report.
    DipPriceView *live;     // View of `measured`.
    bool prefers_live;
    DipPriceConditions conditions;
    unsigned changes;
    double pixels_per_degree; // 0 if none was set.
    char progress[DIP_PRICE_PROGRESS];
};

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "prices", "out of memory");
}

DipPrices *dip_prices_create(DipError *err) {
    DipPrices *prices = calloc(1, sizeof *prices);
    if (!prices) {
        out_of_memory(err);
        return NULL;
    }
    prices->measured.options.baseline = dip_quality_default();
    prices->live = dip_price_view_create(&prices->measured, err);
    if (!prices->live) {
        dip_prices_destroy(&prices);
    }
    return prices;
}

void dip_prices_destroy(DipPrices **prices) {
    if (*prices) {
        dip_price_view_destroy(&(*prices)->read);
        dip_price_view_destroy(&(*prices)->live);
        dip_cost_report_free(&(*prices)->measured);
        free(*prices);
        *prices = NULL;
    }
}

void dip_prices_set_conditions(DipPrices *prices, const DipPriceConditions *conditions) {
    prices->conditions = *conditions;
}

void dip_prices_set_viewing(DipPrices *prices, double pixels_per_degree) {
    prices->pixels_per_degree = pixels_per_degree;
}

double dip_prices_viewing(const DipPrices *prices) {
    return prices->pixels_per_degree > 0.0 ? prices->pixels_per_degree
           : prices->read ? dip_price_view_report(prices->read)->options.pixels_per_degree
                          : DIP_FLIP_PIXELS_PER_DEGREE;
}

// --- the report that was read --------------------------------------------------------------------

bool dip_prices_set_report(DipPrices *prices, const DipCostReport *report, DipError *err) {
    ++prices->changes;
    dip_price_view_destroy(&prices->read);
    prices->read = dip_price_view_create(report, err);
    return prices->read != NULL;
}

bool dip_prices_has_report(const DipPrices *prices) {
    return prices->read != NULL;
}

void dip_prices_prefer_rough(DipPrices *prices, bool prefer) {
    prices->changes += prices->prefers_live != prefer;
    prices->prefers_live = prefer;
}

bool dip_prices_are_rough(const DipPrices *prices) {
    return !prices->read || prices->prefers_live;
}

// --- the report that is measured here ------------------------------------------------------------

DipCostReport *dip_prices_live(DipPrices *prices) {
    return &prices->measured;
}

// Begins a report of one picture, in which each row has room for one frame and one viewpoint.
static bool begin_live(DipPrices *prices, DipError *err) {
    DipCostReport *report = &prices->measured;
    report->options.baseline = dip_prices_base(prices);
    report->options.places = 1;
    report->options.budget_of = DIP_TIME_MEAN;
    report->machine.settled = true;
    report->path_count = 1;
    // A report with 0 rounds counts as one without times. Logging times raises the number.
    report->rounds = report->options.rounds = 1;
    report->rows = calloc(DIP_PRICES_LIVE_ROWS, sizeof *report->rows);
    return (report->rows || out_of_memory(err)) && dip_cost_report_alloc(report, err);
}

int dip_prices_find_live(const DipPrices *prices, const DipQuality *quality) {
    return dip_price_row(prices->live, quality);
}

int dip_prices_live_row(DipPrices *prices, const DipQuality *quality, DipError *err) {
    DipCostReport *report = &prices->measured;
    if (!report->rows && !begin_live(prices, err)) {
        dip_prices_forget_live(prices);
        return -1;
    }
    const int row = dip_price_row(prices->live, quality);
    if (row >= 0) {
        return row;
    }
    if (report->row_count == DIP_PRICES_LIVE_ROWS) {
        out_of_memory(err);
        return -1;
    }
    const int added = dip_cost_report_add_row(report, quality, 0, err);
    return added >= 0 && dip_price_view_update(prices->live, err) ? added : -1;
}

bool dip_prices_update_live(DipPrices *prices, bool timed, DipError *err) {
    ++prices->changes;
    return (!timed || dip_cost_estimate_times(&prices->measured, err)) &&
           dip_price_view_update(prices->live, err);
}

void dip_prices_forget_live(DipPrices *prices) {
    const DipQuality base = dip_prices_base(prices);
    ++prices->changes;
    dip_cost_report_free(&prices->measured);
    prices->measured.options.baseline = base;
    // A failure does no harm, since the report has no rows now.
    dip_price_view_update(prices->live, NULL);
}

// --- what is used --------------------------------------------------------------------------------

const DipPriceView *dip_prices_view(const DipPrices *prices) {
    return dip_prices_are_rough(prices) ? prices->live : prices->read;
}

DipQuality dip_prices_base(const DipPrices *prices) {
    return dip_price_base(prices->read ? prices->read : prices->live);
}

unsigned dip_prices_changes(const DipPrices *prices) {
    return prices->changes;
}

DipPrice dip_prices_step(const DipPrices *prices, DipSetting setting, int step,
                         const DipQuality *quality) {
    return dip_price_step(dip_prices_view(prices), setting, step, quality);
}

DipPriceSum dip_prices_sum(const DipPrices *prices, const DipQuality *quality) {
    return dip_price_sum(dip_prices_view(prices), quality);
}

bool dip_prices_are_doubtful(const DipPrices *prices) {
    return dip_price_is_doubtful(dip_prices_view(prices));
}

bool dip_prices_set_progress(DipPrices *prices, const char *text) {
    char before[DIP_PRICE_PROGRESS];
    memcpy(before, prices->progress, sizeof before);
    snprintf(prices->progress, sizeof prices->progress, "%s", text);
    return strcmp(before, prices->progress) != 0;
}

const char *dip_prices_progress(const DipPrices *prices) {
    return prices->progress;
}

// --- the source ----------------------------------------------------------------------------------

static bool differs(const char *now, const char *then) {
    return now && strcmp(now, then) != 0;
}

// Says what differs between the report and the panes. Returns whether anything does.
static bool say_differences(const DipPrices *prices, int width, int height, char *text,
                            size_t size_bytes) {
    const DipCostReport *report = dip_price_view_report(prices->read);
    const DipPriceConditions *now = &prices->conditions;
    bool stale = false;
    if (differs(now->scene, report->scene)) {
        dip_put_append(text, size_bytes, " The panes show %s.", now->scene);
        stale = true;
    }
    if (width != report->width || height != report->height) {
        dip_put_append(text, size_bytes, " The panes are %dx%d.", width, height);
        stale = true;
    }
    if (dip_prices_viewing(prices) != report->options.pixels_per_degree) {
        dip_put_append(
            text, size_bytes,
            " FLIP of the panes is for %.1f pixels per degree, that of the report for %.1f.",
            dip_prices_viewing(prices), report->options.pixels_per_degree);
        stale = true;
    }
    if (now->threads != 0 && now->threads != report->threads) {
        dip_put_append(text, size_bytes, " The panes have %d thread%s.", now->threads,
                       now->threads == 1 ? "" : "s");
        stale = true;
    }
    if (differs(now->processor, report->processor)) {
        dip_put_append(text, size_bytes, " The report is from another machine.");
        stale = true;
    } else if (differs(now->isa, report->isa)) {
        dip_put_append(text, size_bytes, " The report is for %s, the panes use %s.", report->isa,
                       now->isa);
        stale = true;
    }
    return stale;
}

bool dip_prices_are_of_other_scene(const DipPrices *prices) {
    return prices->read &&
           differs(prices->conditions.scene, dip_price_view_report(prices->read)->scene);
}

static bool has_errors(const DipCostReport *report) {
    int viewpoints = 0;
    for (int r = 0; r < report->row_count && viewpoints == 0; r++) {
        dip_cost_row_sums(report, r, &viewpoints);
    }
    return viewpoints > 0;
}

bool dip_prices_source(const DipPrices *prices, int width, int height, char *text,
                       size_t size_bytes) {
    if (dip_prices_are_rough(prices)) {
        snprintf(
            text, size_bytes, "%s",
            prices->measured.row_count == 0
                ? "Prices: not measured yet. They are measured while the camera rests."
            : dip_prices_are_doubtful(prices)
                ? "Prices: measured here while the machine was too busy, so times are doubtful."
                : "Prices: measured here, a few frames each (rough).");
        return false;
    }
    const DipCostReport *report = dip_price_view_report(prices->read);
    snprintf(text, size_bytes, "Prices: report of %.80s, path %s, %dx%d, %d thread%s.",
             differs(prices->conditions.scene, report->scene) ? report->scene : "this scene",
             report->paths[0], report->width, report->height, report->threads,
             report->threads == 1 ? "" : "s");
    const bool stale = say_differences(prices, width, height, text, size_bytes);
    if (dip_price_is_doubtful(prices->read)) {
        dip_put_append(text, size_bytes, " The machine was too busy, so the times are wrong.");
    }
    if (report->rounds == 0) {
        dip_put_append(text, size_bytes, " The report has no times.");
    }
    if (!has_errors(report)) {
        dip_put_append(text, size_bytes, " The report has no errors.");
    }
    return stale;
}
