// Makes the view of a report, which finds combinations by their settings.
#include "app/report/prices/view.h"

#include <stdlib.h>
#include <string.h>

// Empties what is kept. `kept` may be NULL.
static void forget(DipPriceKept *kept) {
    if (kept) {
        dip_flip_model_free(&kept->errors);
        memset(kept, 0, sizeof *kept);
    }
}

DipPriceView *dip_price_view_create(const DipCostReport *report, DipError *err) {
    DipPriceView *view = calloc(1, sizeof *view);
    if (view) {
        view->report = report;
        view->kept = calloc(1, sizeof *view->kept);
    }
    if (!view || !view->kept || !dip_price_view_update(view, NULL)) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "prices", "out of memory");
        dip_price_view_destroy(&view);
    }
    return view;
}

void dip_price_view_destroy(DipPriceView **view) {
    if (*view) {
        free((*view)->entries);
        forget((*view)->kept);
        free((*view)->kept);
        free(*view);
        *view = NULL;
    }
}

// --- the list ------------------------------------------------------------------------------------

static uint64_t number_of(const DipQuality *normal) {
    uint64_t number = 0;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        number = number * DIP_MAX_STEPS + normal->step[s];
    }
    return number;
}

static int compare(const void *a, const void *b) {
    const DipPriceEntry *x = a, *y = b;
    if (x->settings != y->settings) {
        return x->settings < y->settings ? -1 : 1;
    }
    return x->path != y->path ? x->path - y->path : x->rank - y->rank;
}

static void add(DipPriceView *view, const DipQuality *quality, int path, int row, int prediction) {
    const DipQuality normal = dip_price_normal(&view->base, quality);
    view->entries[view->count] =
        (DipPriceEntry){number_of(&normal), path, row, prediction, view->count};
    view->count++;
}

// Returns whether the report's tables show another row of the same settings instead of this one.
// The baseline's settings are timed once more as a combination; where no sweep has the baseline's
// row, the tables show only this combination. The A/A row is in no table of settings.
static bool has_stand_in(const DipCostReport *report, int row) {
    const int first = report->combined_first;
    bool is_shown = row >= first || (row != report->base_rows[0] && row != report->same_rows[0]);
    for (int s = 0; s < report->sweep_count && !is_shown; s++) {
        is_shown = report->sweeps[s].base == row;
    }
    return !is_shown && dip_report_find(report, &report->rows[row].quality, 0, first) >= 0;
}

bool dip_price_view_update(DipPriceView *view, DipError *err) {
    const DipCostReport *report = view->report;
    const DipCostPredictions *predicted = &report->predicted;
    const int most = report->row_count + report->same_count + predicted->count;
    view->base = dip_price_normal(&report->options.baseline, &report->options.baseline);
    view->count = 0;
    forget(view->kept);
    free(view->entries);
    view->entries = malloc((size_t)(most + 1) * sizeof *view->entries);
    if (!view->entries) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "prices", "out of memory");
    }
    for (int r = 0; r < report->row_count; r++) {
        if (!has_stand_in(report, r)) {
            add(view, &report->rows[r].quality, report->rows[r].path, r, -1);
        }
    }
    for (int i = 0; i < report->same_count; i++) {
        add(view, &report->same[i].quality, 0, report->same[i].row, -1);
    }
    for (int i = 0; i < predicted->count; i++) {
        if (predicted->list[i].row < 0) {
            add(view, &predicted->list[i].quality, 0, -1, i);
        }
    }
    qsort(view->entries, (size_t)view->count, sizeof *view->entries, compare);
    return true;
}

const DipPriceEntry *dip_price_find(const DipPriceView *view, int path, const DipQuality *normal) {
    const DipPriceEntry wanted = {.settings = number_of(normal), .path = path, .rank = -1};
    int low = 0, high = view->count;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (compare(&view->entries[middle], &wanted) < 0) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    const DipPriceEntry *entry = &view->entries[low];
    const bool found =
        low < view->count && entry->settings == wanted.settings && entry->path == path;
    return found ? entry : NULL;
}

// --- what is known -------------------------------------------------------------------------------

const DipCostReport *dip_price_view_report(const DipPriceView *view) {
    return view->report;
}

DipQuality dip_price_base(const DipPriceView *view) {
    return view->base;
}

int dip_price_row(const DipPriceView *view, const DipQuality *quality) {
    const DipQuality normal = dip_price_normal(&view->base, quality);
    const DipPriceEntry *entry = dip_price_find(view, 0, &normal);
    return entry ? entry->row : -1;
}

bool dip_price_is_doubtful(const DipPriceView *view) {
    return view->report->rounds > 0 && view->report->verdict == DIP_COST_RED;
}

static DipPriceWhole whole_of_row(const DipCostReport *report, int row) {
    DipPriceWhole whole = {.has_flip = dip_cost_is_judged(report, row)};
    if (dip_cost_is_timed(report, row)) {
        whole.state = dip_cost_is_view(report) ? DIP_PRICE_ROUGH : DIP_PRICE_MEASURED;
        whole.time = report->rows[row].time.mean_ms;
    }
    if (whole.has_flip) {
        whole.flip = dip_cost_row_metrics(report, row).flip;
        whole.flip_at_floor = dip_cost_at_floor(report, row);
    }
    return whole;
}

DipPriceWhole dip_price_known(const DipPriceView *view, const DipPriceEntry *entry) {
    const DipCostPredictions *predicted = &view->report->predicted;
    if (!entry) {
        return (DipPriceWhole){.state = DIP_PRICE_UNKNOWN};
    }
    if (entry->row >= 0) {
        return whole_of_row(view->report, entry->row);
    }
    // Some misses are of rows that were each predicted from the others, and some are of rows that
    // were measured after they had been predicted. The error follows from the greater misses.
    const DipCostMisses *before = &predicted->times_left_out, *later = &predicted->times;
    const bool worse = before->rows == 0 || (later->rows > 0 && later->p90 > before->p90);
    const DipCostPrediction *prediction = &predicted->list[entry->prediction];
    return (DipPriceWhole){
        .state = DIP_PRICE_PREDICTED,
        .time = dip_price_predicted_time(prediction->ms, worse ? later : before),
        .has_flip = prediction->flip > 0.0,
        .flip = prediction->flip,
    };
}
