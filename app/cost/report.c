// The report's memory, and figures from what was measured.
#include "app/cost/report.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const dip_cost_counter_names[DIP_COST_COUNTER_COUNT] = {
#define COUNTER_NAME(name, text) #name,
    DIP_COUNTER_LIST(COUNTER_NAME)
#undef COUNTER_NAME
};

bool dip_cost_report_alloc(DipCostReport *report, DipError *err) {
    const size_t places = (size_t)report->options.places;
    const size_t times = (size_t)report->options.rounds * (size_t)report->options.timed_frames;
    report->floors = calloc((size_t)report->path_count * places, sizeof *report->floors);
    report->has_floor = calloc((size_t)report->path_count * places, sizeof *report->has_floor);
    bool made = report->floors && report->has_floor;
    for (int r = 0; r < report->row_count; r++) {
        DipCostRow *row = &report->rows[r];
        row->places = calloc(places, sizeof *row->places);
        row->judged = calloc(places, sizeof *row->judged);
        row->ms = calloc(times, sizeof *row->ms);
        made = made && row->places && row->judged && row->ms;
    }
    return made || dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
}

void dip_cost_report_free(DipCostReport *report) {
    for (int r = 0; r < report->row_count; r++) {
        free(report->rows[r].places);
        free(report->rows[r].judged);
        free(report->rows[r].ms);
    }
    free(report->rows);
    free(report->floors);
    free(report->has_floor);
    *report = (DipCostReport){0};
}

void dip_cost_settings_text(const DipQuality *quality, char text[DIP_COST_TEXT]) {
    size_t length = 0;
    text[0] = '\0';
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        const DipSettingInfo *info = dip_setting_info((DipSetting)s);
        if (quality->step[s] != info->default_step && length < DIP_COST_TEXT) {
            length += (size_t)snprintf(text + length, DIP_COST_TEXT - length, "%s%s=%s",
                                       length ? "," : "", info->key, info->steps[quality->step[s]]);
        }
    }
    if (length == 0) {
        snprintf(text, DIP_COST_TEXT, "defaults");
    }
}

// --- errors ------------------------------------------------------------------------------------

DipCostSums dip_cost_row_sums(const DipCostReport *report, int row, int *places) {
    DipCostSums sums = {0};
    *places = 0;
    for (int p = 0; p < report->options.places; p++) {
        if (report->rows[row].judged[p]) {
            dip_cost_sums_add(&sums, &report->rows[row].places[p]);
            ++*places;
        }
    }
    return sums;
}

DipCostSums dip_cost_floor(const DipCostReport *report, int path) {
    DipCostSums sums = {0};
    for (int p = 0; p < report->options.places; p++) {
        if (report->has_floor[path * report->options.places + p]) {
            dip_cost_sums_add(&sums, &report->floors[path * report->options.places + p]);
        }
    }
    return sums;
}

double dip_cost_floor_rmse(const DipCostReport *report, int path, int region) {
    // The mean of two independent halves errs by half of their difference.
    const DipCostSums sums = dip_cost_floor(report, path);
    return dip_cost_figures(&sums, region).rmse_lin / 2.0;
}

bool dip_cost_at_floor(const DipCostReport *report, int row) {
    int places;
    const DipCostSums sums = dip_cost_row_sums(report, row, &places);
    return dip_cost_figures(&sums, 0).rmse_lin <
           3.0 * dip_cost_floor_rmse(report, report->rows[row].path, 0);
}

// --- times -------------------------------------------------------------------------------------

bool dip_cost_is_timed(const DipCostReport *report, int row) {
    return report->rounds > 0 && report->rows[row].ms;
}

enum { RESAMPLES = 2000 };

static uint32_t next_random(uint64_t *state) {
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (uint32_t)(*state >> 33);
}

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

// A figure of some of the rounds.
typedef double Figure(const DipCostReport *report, int row, int base, const int *rounds,
                      double *scratch);

// The value that would stand at a place if they were sorted, by Hoare's selection: the bootstrap
// asks for it thousands of times. Orders the values in part.
static double select_value(double *values, int count, int place) {
    int low = 0, high = count - 1;
    while (low < high) {
        const double pivot = values[(low + high) / 2];
        int i = low, j = high;
        while (i <= j) {
            while (values[i] < pivot) {
                i++;
            }
            while (values[j] > pivot) {
                j--;
            }
            if (i <= j) {
                const double swap = values[i];
                values[i++] = values[j];
                values[j--] = swap;
            }
        }
        if (place <= j) {
            high = j;
        } else if (place >= i) {
            low = i;
        } else {
            break;
        }
    }
    return values[place];
}

static double median(double *values, int count) {
    const double below = select_value(values, count, (count - 1) / 2);
    return count % 2 ? below : 0.5 * (below + select_value(values, count, count / 2));
}

static double mean_of_medians(const DipCostReport *report, int row, int base, const int *rounds,
                              double *scratch) {
    (void)base;
    const int frames = report->options.timed_frames;
    double sum = 0.0;
    for (int f = 0; f < frames; f++) {
        for (int r = 0; r < report->rounds; r++) {
            scratch[r] = report->rows[row].ms[rounds[r] * frames + f];
        }
        sum += median(scratch, report->rounds) / frames;
    }
    return sum;
}

static double median_ratio(const DipCostReport *report, int row, int base, const int *rounds,
                           double *scratch) {
    const int frames = report->options.timed_frames;
    int count = 0;
    for (int r = 0; r < report->rounds; r++) {
        for (int f = 0; f < frames; f++) {
            const int i = rounds[r] * frames + f;
            scratch[count++] = report->rows[row].ms[i] / report->rows[base].ms[i];
        }
    }
    return median(scratch, count);
}

// The figure, and its interval by drawing whole rounds again, with replacement; without resamples
// the figure alone.
static DipCostTime bootstrap(const DipCostReport *report, int row, int base, Figure *figure,
                             int resamples) {
    const int count = report->rounds;
    double *scratch =
        malloc((size_t)count * (size_t)report->options.timed_frames * sizeof *scratch);
    int *rounds = malloc((size_t)count * sizeof *rounds);
    DipCostTime time = {0};
    double *figures = malloc(((size_t)resamples + 1) * sizeof *figures);
    if (scratch && rounds && figures) {
        uint64_t random = 1;
        for (int r = 0; r < count; r++) {
            rounds[r] = r;
        }
        time.ms = figure(report, row, base, rounds, scratch);
        for (int i = 0; i < resamples; i++) {
            for (int r = 0; r < count; r++) {
                rounds[r] = (int)(next_random(&random) % (uint32_t)count);
            }
            figures[i] = figure(report, row, base, rounds, scratch);
        }
        if (resamples > 0) {
            qsort(figures, (size_t)resamples, sizeof *figures, compare);
            time.low = figures[resamples / 40];
            time.high = figures[resamples - 1 - resamples / 40];
        }
    }
    free(scratch);
    free(rounds);
    free(figures);
    return time;
}

DipCostTime dip_cost_time(const DipCostReport *report, int row) {
    return bootstrap(report, row, row, mean_of_medians, RESAMPLES);
}

double dip_cost_ms(const DipCostReport *report, int row) {
    return bootstrap(report, row, row, mean_of_medians, 0).ms;
}

DipCostTime dip_cost_ratio(const DipCostReport *report, int row, int base) {
    return bootstrap(report, row, base, median_ratio, RESAMPLES);
}

double dip_cost_median_ratio(const DipCostReport *report, int row, int base) {
    return bootstrap(report, row, base, median_ratio, 0).ms;
}

// --- the front ---------------------------------------------------------------------------------

typedef struct Candidate {
    int row;
    double ms;
    double error;
} Candidate;

static int compare_candidates(const void *a, const void *b) {
    const Candidate *x = a;
    const Candidate *y = b;
    const int by_time = (x->ms > y->ms) - (x->ms < y->ms);
    return by_time ? by_time : (x->error > y->error) - (x->error < y->error);
}

int dip_cost_front(const DipCostReport *report, const int *rows, int count, int *front) {
    Candidate *candidates = malloc(((size_t)count + 1) * sizeof *candidates);
    int found = 0, kept = 0;
    for (int i = 0; candidates && i < count; i++) {
        int places;
        const DipCostSums sums = dip_cost_row_sums(report, rows[i], &places);
        if (places > 0 && dip_cost_is_timed(report, rows[i])) {
            candidates[found++] =
                (Candidate){rows[i], dip_cost_ms(report, rows[i]), dip_cost_figures(&sums, 0).flip};
        }
    }
    if (candidates) {
        qsort(candidates, (size_t)found, sizeof *candidates, compare_candidates);
    }
    double least = INFINITY;
    for (int i = 0; i < found; i++) {
        if (candidates[i].error < least) {
            least = candidates[i].error;
            front[kept++] = candidates[i].row;
        }
    }
    free(candidates);
    return kept;
}

static double flip_of(const DipCostReport *report, int row) {
    int places;
    const DipCostSums sums = dip_cost_row_sums(report, row, &places);
    return dip_cost_figures(&sums, 0).flip;
}

int dip_cost_front_steps(const DipCostReport *report, int *front, int count) {
    int kept = 0;
    for (int i = 0; i < count; i++) {
        if (i == 0 || flip_of(report, front[i]) <= 0.99 * flip_of(report, front[kept - 1])) {
            front[kept++] = front[i];
        }
    }
    return kept;
}

int dip_cost_next(const DipCostReport *report, int row) {
    const double enough = 0.99 * flip_of(report, row);
    int next = -1;
    double least_ms = INFINITY;
    for (int r = report->combined_first; r < report->row_count; r++) {
        int places;
        const DipCostSums sums = dip_cost_row_sums(report, r, &places);
        const double ms = places > 0 ? dip_cost_ms(report, r) : INFINITY;
        if (ms < least_ms && dip_cost_figures(&sums, 0).flip <= enough) {
            least_ms = ms;
            next = r;
        }
    }
    return next;
}

int dip_cost_choose(const DipCostReport *report, const double *latest_ms, double budget_ms) {
    int best = -1;
    double least = INFINITY;
    for (int r = report->combined_first; r < report->row_count; r++) {
        int places;
        const DipCostSums sums = dip_cost_row_sums(report, r, &places);
        const double flip = dip_cost_figures(&sums, 0).flip;
        if (places > 0 && latest_ms[r] <= budget_ms && flip < least) {
            least = flip;
            best = r;
        }
    }
    return best;
}
