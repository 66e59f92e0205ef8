// Prints a comparison of reports or programs (diff.h) for a terminal.
#include "app/cost/diff/diff.h"
#include "app/files/put.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// If both sides come from one machine and more rows than this have times, only the times of rows
// that are slower or faster are printed.
enum { MOST_ROWS = 24 };

// --- headings ------------------------------------------------------------------------------------

static void print_side(const DipCostDiff *diff, int side, FILE *out) {
    dip_put_text(out, "%s        %s", side ? "B" : "A", diff->names[side]);
    if (*diff->builds[side]) {
        dip_put_text(out, ", build %.12s", diff->builds[side]);
    }
    dip_put_text(out, "\n");
}

static void print_heading(const DipCostDiff *diff, FILE *out) {
    static const char *const names[] = {" A", " B"};
    const bool is_program = diff->kind == DIP_COST_DIFF_PROGRAMS;
    print_side(diff, 0, out);
    print_side(diff, 1, out);
    if (*diff->scene) {
        dip_put_text(out, "scene    %s\n", diff->scene);
    }
    for (int side = 0; side < (diff->same_machine ? 1 : 2); side++) {
        if (*diff->machines[side]) {
            dip_put_text(out, "machine%s %s\n", diff->same_machine ? " " : names[side],
                         diff->machines[side]);
        }
    }
    for (int side = 0; diff->has_times && side < (is_program ? 1 : 2); side++) {
        dip_put_text(out, "verdict%s %s: %s\n", is_program ? " " : names[side],
                     dip_cost_verdict_names[diff->verdicts[side]], diff->reasons[side]);
    }
    for (int i = 0; i < diff->note_count; i++) {
        dip_put_text(out, "note     %s\n", diff->notes[i]);
    }
}

// --- exact differences ---------------------------------------------------------------------------

static void print_growth(double growth, char *text, size_t size) {
    if (isinf(growth)) {
        snprintf(text, size, "new");
    } else {
        snprintf(text, size, "%+.*f %%", fabs(growth) < 0.01 ? 3 : 1, 100.0 * growth);
    }
}

static void print_change(const DipCostDiff *diff, const DipCostDiffChange *change, FILE *out) {
    const DipCostDiffRow *row = &diff->rows[change->greatest];
    const double a = row->values[0][change->quantity], b = row->values[1][change->quantity];
    char settings[DIP_COST_TEXT], least[32], most[32];
    dip_cost_settings_text(&row->quality, settings);
    if (change->quantity == DIP_COST_DIFF_pictures) {
        dip_put_text(out, "  %-22s %.0f frames differ with %s\n", "pictures", b, settings);
        return;
    }
    print_growth(change->least, least, sizeof least);
    print_growth(change->most, most, sizeof most);
    const bool is_error = change->quantity < DIP_COST_DIFF_ERROR_COUNT;
    dip_put_text(out, "  %-22s %s", dip_cost_diff_title(change->quantity), least);
    if (strcmp(least, most) != 0) {
        dip_put_text(out, " to %s", most);
    }
    dip_put_text(out, is_error ? "; %.6g in A, %.6g in B" : "; %.10g in A, %.10g in B", a, b);
    dip_put_text(out, " with %s on %s%s\n", settings, row->path,
                 !is_error                                           ? ""
                 : dip_cost_diff_growth(row, change->quantity) > 0.0 ? " (worse)"
                                                                     : " (better)");
}

static bool print_exact(const DipCostDiff *diff, FILE *out, DipError *err) {
    DipCostDiffGroup *groups = calloc(DIP_COST_DIFF_QUANTITY_COUNT, sizeof *groups);
    const int count = groups ? dip_cost_diff_group(diff, groups) : -1;
    if (count < 0) {
        free(groups);
        return dip_cost_diff_no_memory(err);
    }
    if (count > 0) {
        dip_put_text(
            out,
            "\nErrors, pictures and counters are exact: any difference has a cause. The change of "
            "PSNR is that of\nits root mean square difference, the change of SSIM that of 1 - "
            "SSIM.\n");
    } else if (diff->row_count > 0) {
        dip_put_text(out, "\nAll %s are the same.\n",
                     diff->kind == DIP_COST_DIFF_PROGRAMS
                         ? "pictures and counters"
                         : "errors and counters that both sides have");
    }
    for (int g = 0; g < count; g++) {
        dip_put_text(out, "%s:\n", groups[g].which);
        for (int c = 0; c < groups[g].change_count; c++) {
            print_change(diff, &groups[g].changes[c], out);
        }
    }
    free(groups);
    return true;
}

// --- times ---------------------------------------------------------------------------------------

static void print_time_columns(const DipCostDiff *diff, FILE *out) {
    dip_put_text(out, "%-32s %-8s %8s %8s", "", "path", "A ms", "B ms");
    if (diff->kind == DIP_COST_DIFF_REPORTS) {
        dip_put_text(out, " %8s %8s", "A ratio", "B ratio");
    }
    dip_put_text(out, "  %6s  %-16s", "B / A", "95 % interval");
    for (int s = 0; diff->kind == DIP_COST_DIFF_PROGRAMS && s < DIP_COST_DIFF_STAGES; s++) {
        dip_put_text(out, " %8s", dip_bench_stage_names[s]);
    }
    dip_put_text(out, "\n");
}

static void print_time(const DipCostDiff *diff, const DipCostDiffRow *row, FILE *out) {
    static const char *const marks[] = {"", "slower", "faster"};
    const bool is_program = diff->kind == DIP_COST_DIFF_PROGRAMS;
    char settings[DIP_COST_TEXT], change[16] = "", interval[32] = "baseline";
    dip_cost_settings_text(&row->quality, settings);
    dip_put_text(out, "%-32s %-8s %8.2f %8.2f", settings, row->path, row->ms[0], row->ms[1]);
    if (!is_program) {
        dip_put_text(out, " %8.3f %8.3f", row->ratios[0].value, row->ratios[1].value);
    }
    if (!row->is_base) {
        snprintf(change, sizeof change, "%6.3f", row->change.value);
        snprintf(interval, sizeof interval, "%.3f to %.3f", row->change.low, row->change.high);
    }
    dip_put_text(out, "  %6s  %-16s", change, interval);
    for (int stage = 0; is_program && stage < DIP_COST_DIFF_STAGES; stage++) {
        dip_put_text(out, " %+8.1f", 100.0 * (row->stages[stage].value - 1.0));
    }
    dip_put_text(out, "  %s\n", marks[row->mark]);
}

static void print_explanation(const DipCostDiff *diff, FILE *out) {
    if (diff->kind == DIP_COST_DIFF_PROGRAMS) {
        dip_put_text(
            out,
            "\nTimes: mean ms per frame of both programs, which took turns at every frame; how "
            "many times as long B\ntakes; and the change in each stage, in %% of A's frame.\n");
        return;
    }
    dip_put_text(
        out,
        "\nTimes: ratio = time / the baseline's time, and the quotient of the ratios of B and A. "
        "Ms are those of\neach run: on the same quiet machine another run may lie 10 %% off. "
        "Ratios repeat far better.\n");
    if (!diff->same_machine) {
        dip_put_text(
            out,
            "The machines differ, and ratios depend on the machine, so no row is called slower "
            "or faster.\n");
    }
}

static void print_times(const DipCostDiff *diff, FILE *out) {
    int timed = 0;
    for (int r = 0; r < diff->row_count; r++) {
        timed += diff->rows[r].timed;
    }
    if (!diff->has_times || timed == 0) {
        return;
    }
    const bool all = timed <= MOST_ROWS || !diff->same_machine;
    if (!all && diff->slower + diff->faster == 0) {
        return;
    }
    print_explanation(diff, out);
    print_time_columns(diff, out);
    for (int r = 0; r < diff->row_count; r++) {
        const DipCostDiffRow *row = &diff->rows[r];
        if (row->timed && (all || row->mark != DIP_COST_DIFF_SAME)) {
            print_time(diff, row, out);
        }
    }
    if (*diff->cause) {
        dip_put_text(out, "%s\n", diff->cause);
    }
}

static void print_result(const DipCostDiff *diff, FILE *out) {
    if (!diff->has_times) {
        dip_put_text(out, "\nTimes are not compared.\n");
    } else if (dip_cost_diff_is_busy(diff)) {
        dip_put_text(
            out, "\nThe machine was too busy: the times are wrong, so nothing is called slower or "
                 "faster.\n");
    } else if (diff->slower + diff->faster > 0) {
        dip_put_text(out,
                     "\n%d of %d rows are slower in B and %d are faster, by surely more than "
                     "%.3g %%.\n",
                     diff->slower, diff->row_count, diff->faster, 100.0 * (diff->limit - 1.0));
    } else if (diff->same_machine) {
        dip_put_text(out, "\nNo row is surely slower or faster in B by more than %.3g %%.\n",
                     100.0 * (diff->limit - 1.0));
    }
}

bool dip_cost_diff_print(const DipCostDiff *diff, FILE *out, DipError *err) {
    print_heading(diff, out);
    if (!print_exact(diff, out, err)) {
        return false;
    }
    print_times(diff, out);
    print_result(diff, out);
    return true;
}
