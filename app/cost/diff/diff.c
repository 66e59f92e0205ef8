// Holds what comparisons of reports and comparisons of programs both need: computes how much each
// quantity has grown, marks rows as slower or faster, and adds notes.
#include "app/cost/diff/diff.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const error_titles[DIP_COST_DIFF_ERROR_COUNT] = {
    "RMSE", "PSNR", "SSIM", "FLIP", "flicker", "two-frame mean"};

bool dip_cost_diff_no_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost diff", "out of memory");
}

void dip_cost_diff_note(DipCostDiff *diff, const char *format, ...) {
    if (diff->note_count == DIP_COST_DIFF_MAX_NOTES) {
        return;
    }
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(diff->notes[diff->note_count++], DIP_COST_DIFF_NOTE, format, arguments);
    va_end(arguments);
}

void dip_cost_diff_free(DipCostDiff *diff) {
    free(diff->rows);
    diff->rows = NULL;
    diff->row_count = 0;
}

const char *dip_cost_diff_title(int quantity) {
    return quantity < DIP_COST_DIFF_ERROR_COUNT ? error_titles[quantity]
           : quantity == DIP_COST_DIFF_pictures
               ? "pictures"
               : dip_counter_names[quantity - DIP_COST_DIFF_FIRST_COUNTER];
}

bool dip_cost_diff_differs(const DipCostDiffRow *row, int quantity) {
    const double a = row->values[0][quantity], b = row->values[1][quantity];
    return !isnan(a) && !isnan(b) && a != b;
}

double dip_cost_diff_growth(const DipCostDiffRow *row, int quantity) {
    double a = row->values[0][quantity], b = row->values[1][quantity];
    if (!dip_cost_diff_differs(row, quantity)) {
        return 0.0;
    }
    if (quantity == DIP_COST_DIFF_psnr) {
        return pow(10.0, (a - b) / 20.0) - 1.0;
    }
    if (quantity == DIP_COST_DIFF_ssim) {
        a = 1.0 - a;
        b = 1.0 - b;
    }
    return a > 0.0 ? b / a - 1.0 : INFINITY;
}

bool dip_cost_diff_is_busy(const DipCostDiff *diff) {
    return diff->has_times &&
           (diff->verdicts[0] == DIP_COST_RED || diff->verdicts[1] == DIP_COST_RED);
}

// Counts the rows in which a side's quantity is known, and the rows in which it is known and not 0.
static void count_rows(const DipCostDiff *diff, int side, int quantity, int *known, int *used) {
    *known = *used = 0;
    for (int r = 0; r < diff->row_count; r++) {
        const double value = diff->rows[r].values[side][quantity];
        *known += !isnan(value);
        *used += !isnan(value) && value != 0.0;
    }
}

void dip_cost_diff_leave_out_uncounted(DipCostDiff *diff) {
    char names[2][DIP_COST_DIFF_NOTE / 2] = {"", ""};
    for (int q = DIP_COST_DIFF_FIRST_COUNTER; q < DIP_COST_DIFF_QUANTITY_COUNT; q++) {
        int known[2], used[2];
        count_rows(diff, 0, q, &known[0], &used[0]);
        count_rows(diff, 1, q, &known[1], &used[1]);
        const int side = used[0] == 0 ? 0 : 1; // The side that perhaps does not count `q`.
        if (used[side] > 0 || used[1 - side] == 0 || used[1 - side] < known[1 - side]) {
            continue;
        }
        const size_t length = strlen(names[side]);
        snprintf(names[side] + length, sizeof names[side] - length, "%s%s", length ? ", " : "",
                 dip_cost_diff_title(q));
        for (int r = 0; r < diff->row_count; r++) {
            diff->rows[r].values[0][q] = diff->rows[r].values[1][q] = NAN;
        }
    }
    for (int side = 0; side < 2; side++) {
        if (*names[side]) {
            dip_cost_diff_note(diff,
                               "counters that are 0 in all rows of %s only, which perhaps "
                               "does not count them: %s",
                               side ? "B" : "A", names[side]);
        }
    }
}

static bool has_failed_error(const DipCostDiffRow *row, double limit) {
    for (int q = 0; q < DIP_COST_DIFF_ERROR_COUNT; q++) {
        if (dip_cost_diff_growth(row, q) > limit - 1.0) {
            return true;
        }
    }
    return false;
}

void dip_cost_diff_mark(DipCostDiff *diff) {
    const bool judges = diff->has_times && !dip_cost_diff_is_busy(diff) &&
                        (diff->kind == DIP_COST_DIFF_PROGRAMS || diff->same_machine);
    diff->slower = diff->faster = diff->failed_times = diff->failed_errors = 0;
    for (int r = 0; r < diff->row_count; r++) {
        DipCostDiffRow *row = &diff->rows[r];
        const bool judged = judges && row->timed && !row->is_base;
        row->mark = judged && row->surely_above > diff->limit         ? DIP_COST_DIFF_SLOWER
                    : judged && row->surely_below < 1.0 / diff->limit ? DIP_COST_DIFF_FASTER
                                                                      : DIP_COST_DIFF_SAME;
        diff->slower += row->mark == DIP_COST_DIFF_SLOWER;
        diff->faster += row->mark == DIP_COST_DIFF_FASTER;
        if (diff->fail_over > 0.0) {
            diff->failed_times += judged && row->surely_above > diff->fail_over;
            diff->failed_errors += has_failed_error(row, diff->fail_over);
        }
    }
}
