// Predicts the time and the error of a combination from its composed work (combinations.h).
#include "app/report/prices/view.h"

#include "app/report/combinations.h"

#include <math.h>

enum {
    MOST_MISSES = 32,  // Greatest number of rows that are predicted from composed work as a test.
    LEAST_JUDGED = 16, // Least number of rows with a known error from which errors are predicted.
    MOST_JUDGED = 256  // Greatest number of these rows. Of more, some are left out, spread evenly,
                       // so that making the model takes milliseconds.
};

// The 90th percentile of the absolute value of a standard normal variable.
static const double normal_p90 = 1.6449;

// The least standard error of a predicted time's logarithm. It is needed because the misses of a
// few rows may all happen to be tiny.
static const double least_error = 0.002;

DipEstimate dip_price_predicted_time(double ms, const DipCostMisses *misses) {
    return dip_estimate_make(ms, fmax(log1p(misses->p90) / normal_p90, least_error), misses->rows);
}

// Returns the counters of the row with these settings on path 0, for dip_work_compose. Returns NULL
// if there is none. Also returns NULL if the settings differ from the base in two groups or more:
// the row may be the one that is to be composed, and no row may be composed from itself.
static const double *find_counters(const void *context, const DipQuality *quality) {
    const DipPriceView *view = context;
    const bool plain = dip_work_count_groups(&view->base, quality) <= 1;
    const int row = plain ? dip_price_row(view, quality) : -1;
    return row >= 0 ? view->report->rows[row].counters : NULL;
}

static bool compose(const DipPriceView *view, const DipQuality *normal,
                    double counters[DIP_COUNTER_COUNT]) {
    return dip_work_compose(find_counters, view, &view->base, normal, counters);
}

// Returns whether two combinations have the same antialiasing and filtering, which decide how well
// a combination is predicted.
static bool are_alike(const DipQuality *a, const DipQuality *b) {
    const unsigned mask = dip_work_group(0) | 1u << DIP_SETTING_AF | 1u << DIP_SETTING_AAF;
    const DipQuality other = dip_cost_take_settings(b, a, mask);
    return dip_quality_equal(&other, b);
}

// Predicts a row as if its combination had never been run, from the rows that are not like it
// (are_alike). Returns the miss, or a negative value if the row's work cannot be composed from the
// work of other rows, if the row lies on another path than path 0, or if it differs from the base
// in fewer than two groups of settings.
static double miss_of(const DipPriceView *view, const int *rows, int count, int row) {
    const DipCostRow *left_out = &view->report->rows[row];
    const DipQuality normal = dip_price_normal(&view->base, &left_out->quality);
    double counters[DIP_COUNTER_COUNT];
    int others[DIP_COST_MAX_ROWS];
    int other_count = 0;
    if (left_out->path != 0 || dip_work_count_groups(&view->base, &normal) < 2 ||
        !compose(view, &normal, counters)) {
        return -1.0;
    }
    for (int i = 0; i < count; i++) {
        if (!are_alike(&view->report->rows[rows[i]].quality, &left_out->quality)) {
            others[other_count++] = rows[i];
        }
    }
    const DipCostModel times = dip_cost_model_fit(view->report, others, other_count);
    return fabs(dip_cost_model_value(&times, counters, &normal) / left_out->time.mean_ms.value -
                1.0);
}

// Predicts up to MOST_MISSES rows that differ from the base in two groups of settings or more
// (combinations.h), and summarises the misses. If there are no such rows, predicts every row from
// its own counters, by the prices that fit all other rows.
static DipCostMisses find_misses(const DipPriceView *view, const int *rows, int count) {
    double misses[MOST_MISSES];
    int known = 0;
    const int stride = count / MOST_MISSES + 1;
    for (int i = 0; i < count && known < MOST_MISSES; i += stride) {
        const double miss = miss_of(view, rows, count, rows[i]);
        if (miss >= 0.0) {
            misses[known++] = miss;
        }
    }
    return known > 0 ? dip_cost_misses_of(misses, known)
                     : dip_cost_model_leave_one_out(view->report, rows, count);
}

// Lists the rows from which errors are predicted. Returns their number.
static int list_judged(const DipCostReport *report, int rows[DIP_COST_MAX_ROWS]) {
    int count = 0;
    for (int r = 0; r < report->row_count; r++) {
        if (report->rows[r].path == 0 && dip_cost_is_judged(report, r)) {
            rows[count++] = r;
        }
    }
    const int used = count < MOST_JUDGED ? count : MOST_JUDGED;
    for (int i = 0; i < used; i++) {
        rows[i] = rows[i * count / used];
    }
    return used;
}

static void make(const DipPriceView *view) {
    DipPriceKept *model = view->kept;
    const DipCostReport *report = view->report;
    int rows[DIP_COST_MAX_ROWS];
    model->has_models = true;
    int count = dip_cost_fit_rows(report, rows);
    if (count == 0) {
        return;
    }
    model->misses = find_misses(view, rows, count);
    model->times = dip_cost_model_fit(report, rows, count);
    count = list_judged(report, rows);
    if (count >= LEAST_JUDGED && !dip_flip_model_fit(report, rows, count, 0, &model->errors)) {
        dip_flip_model_free(&model->errors);
    }
}

bool dip_price_predict(const DipPriceView *view, const DipQuality *normal, DipPriceWhole *whole) {
    const DipPriceKept *model = view->kept;
    double counters[DIP_COUNTER_COUNT];
    if (!model->has_models) {
        make(view);
    }
    if (model->times.rows == 0 || !compose(view, normal, counters)) {
        return false;
    }
    const double ms = dip_cost_model_value(&model->times, counters, normal);
    *whole = (DipPriceWhole){
        .state = DIP_PRICE_PREDICTED,
        .time = dip_price_predicted_time(ms, &model->misses),
        .has_flip = model->errors.count > 0,
    };
    if (whole->has_flip) {
        int distances[MOST_JUDGED];
        dip_flip_model_distances(&model->errors, normal, distances);
        whole->flip = dip_flip_model_value(&model->errors, distances);
    }
    return true;
}
