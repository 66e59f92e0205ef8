// Predicts the time and the error of a combination from its composed work.
#include "app/preview/prices/price_model.h"

#include "app/report/fit.h"
#include "app/report/work.h"
#include "app/preview/prices/price_question.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST_MISSES = 32, // Number of rows that are predicted to see how far predictions miss.
    LEAST_JUDGED = 16 // Number of rows with errors that a model of errors needs.
};

// A row of path 0 that differs from the base in one group of settings at most.
typedef struct PlainRow {
    DipQuality quality;
    double counters[DIP_COST_COUNTER_COUNT];
} PlainRow;

struct DipPriceModel {
    DipQuality base;
    DipCostModel times;
    DipCostErrorModel errors;
    double miss;
    PlainRow *plain;
    int plain_count;
};

// The counters of a row of path 0 that differs from the base in one group at most; see DipWorkFind.
static const double *find_plain(const void *context, const DipQuality *quality) {
    const DipPriceModel *model = context;
    for (int i = 0; i < model->plain_count; i++) {
        if (dip_quality_equal(&model->plain[i].quality, quality)) {
            return model->plain[i].counters;
        }
    }
    return NULL;
}

static bool compose(const DipPriceModel *model, const DipQuality *quality,
                    double counters[DIP_COST_COUNTER_COUNT]) {
    return dip_work_compose(find_plain, model, &model->base, quality, counters);
}

// --- making the model ----------------------------------------------------------------------------

static void keep_plain_rows(DipPriceModel *model, const DipCostReport *report) {
    for (int r = 0; r < report->row_count; r++) {
        const DipCostRow *row = &report->rows[r];
        const DipQuality normal = dip_price_normal(&model->base, &row->quality);
        const int groups = dip_work_count_groups(&model->base, &normal);
        if (row->path == 0 && groups >= 0 && groups <= 1 && !find_plain(model, &normal)) {
            PlainRow *plain = &model->plain[model->plain_count++];
            plain->quality = normal;
            memcpy(plain->counters, row->counters, sizeof plain->counters);
        }
    }
}

// Predicts a row from all other rows, as a combination that was never run. Returns the miss, or a
// negative value if the row's work cannot be composed.
static double miss_of(const DipPriceModel *model, const DipCostReport *report, const int *rows,
                      int count, int row) {
    const DipCostRow *left_out = &report->rows[row];
    const DipQuality normal = dip_price_normal(&model->base, &left_out->quality);
    double counters[DIP_COST_COUNTER_COUNT];
    int others[DIP_COST_MAX_ROWS];
    int other_count = 0;
    if (left_out->path != 0 || dip_work_count_groups(&model->base, &normal) < 2 ||
        !compose(model, &normal, counters)) {
        return -1.0;
    }
    for (int i = 0; i < count; i++) {
        if (rows[i] != row) {
            others[other_count++] = rows[i];
        }
    }
    const DipCostModel times = dip_cost_model_fit(report, others, other_count);
    return fabs(dip_cost_model_ms(&times, counters, &normal) / left_out->time.mean_ms.value - 1.0);
}

// Returns the share by which 90 % of predictions miss. Predicts up to MOST_MISSES rows that differ
// from the base in two groups or more. Without such rows, predicts each row from its own counters.
static double usual_miss(const DipPriceModel *model, const DipCostReport *report, const int *rows,
                         int count) {
    double misses[MOST_MISSES];
    int known = 0;
    const int stride = count / MOST_MISSES + 1;
    for (int i = 0; i < count && known < MOST_MISSES; i += stride) {
        const double miss = miss_of(model, report, rows, count, rows[i]);
        if (miss >= 0.0) {
            misses[known++] = miss;
        }
    }
    return known > 0 ? dip_cost_misses_of(misses, known).p90
                     : dip_cost_model_leave_one_out(report, rows, count).p90;
}

static int list_timed(const DipCostReport *report, int rows[DIP_COST_MAX_ROWS]) {
    int count = 0;
    for (int r = 0; report->rounds > 0 && r < report->row_count; r++) {
        double staged_ms = 0.0;
        for (int s = 0; s < DIP_COST_STAGE_COUNT; s++) {
            staged_ms += report->rows[r].stage_ms[s];
        }
        if (staged_ms > 0.0) {
            rows[count++] = r;
        }
    }
    return count;
}

static void fit_errors(DipPriceModel *model, const DipCostReport *report) {
    int rows[DIP_COST_MAX_ROWS];
    int count = 0;
    for (int r = 0; r < report->row_count; r++) {
        int viewpoints = 0;
        dip_cost_row_sums(report, r, &viewpoints);
        if (report->rows[r].path == 0 && viewpoints > 0) {
            rows[count++] = r;
        }
    }
    if (count >= LEAST_JUDGED) {
        model->errors = dip_cost_error_model_fit(report, rows, count);
    }
}

bool dip_price_model_create(const DipCostReport *report, const DipQuality *base,
                            DipPriceModel **made, DipError *err) {
    int rows[DIP_COST_MAX_ROWS];
    const int count = list_timed(report, rows);
    *made = NULL;
    if (count < 2 * dip_cost_term_count(DIP_COST_STAGE_raster)) {
        return true;
    }
    DipPriceModel *model = calloc(1, sizeof *model);
    if (model) {
        model->plain = malloc((size_t)report->row_count * sizeof *model->plain);
    }
    if (!model || !model->plain) {
        dip_price_model_destroy(&model);
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "prices", "out of memory");
    }
    model->base = *base;
    keep_plain_rows(model, report);
    model->times = dip_cost_model_fit(report, rows, count);
    model->miss = usual_miss(model, report, rows, count);
    fit_errors(model, report);
    *made = model;
    return true;
}

void dip_price_model_destroy(DipPriceModel **model) {
    if (*model) {
        free((*model)->plain);
        free(*model);
        *model = NULL;
    }
}

bool dip_price_model_predict(const DipPriceModel *model, const DipQuality *quality,
                             DipPricePrediction *prediction) {
    double counters[DIP_COST_COUNTER_COUNT];
    if (!compose(model, quality, counters)) {
        return false;
    }
    *prediction = (DipPricePrediction){
        .ms = dip_cost_model_ms(&model->times, counters, quality),
        .miss = model->miss,
        .has_flip = model->errors.rows > 0,
    };
    if (prediction->has_flip) {
        prediction->flip = dip_cost_error_model_flip(&model->errors, quality);
    }
    return true;
}
