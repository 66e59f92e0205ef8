// Printing a report as tables for a terminal.
#include "app/report/format/formats.h"

#include "app/report/format/analysis.h"
#include "app/report/order.h"
#include "app/report/tiers.h"
#include "app/files/put.h"
#include "app/report/words.h"

#include <math.h>

static void print_heading(const DipCostReport *report, FILE *out) {
    const DipCostOptions *o = &report->options;
    char baseline[DIP_COST_TEXT];
    dip_cost_settings_text(&report->options.baseline, baseline);
    dip_put_text(out, "scene    %s, %dx%d pixels\n", report->scene, report->width, report->height);
    dip_put_text(out, "machine  %s, %d thread%s, %s\n", report->processor, report->threads,
                 dip_cost_plural(report->threads), report->isa);
    dip_put_text(
        out,
        "times    %d frames along each path in %d rounds, each beside the baseline; ratio = time "
        "/ the baseline's time\n",
        dip_cost_frame_count(report), report->rounds);
    if (report->rounds > 0) {
        char level[DIP_COST_REASON];
        dip_cost_level_text(report, level);
        dip_put_text(out, "machine was %s: %s\n         %s\n",
                     dip_cost_verdict_names[report->verdict], report->verdict_reason, level);
    }
    dip_put_text(
        out,
        "errors   %d viewpoint%s on each path, %d frame%s at each, against a converged picture "
        "(truth) of 2 x %d samples per pixel\n",
        o->places, dip_cost_plural(o->places), o->burst, dip_cost_plural(o->burst), o->samples);
    dip_put_text(out, "baseline %s\n", baseline);
}

static void print_times(const DipCostReport *report, int row, const DipEstimate *ratio, FILE *out) {
    if (!dip_cost_is_timed(report, row)) {
        dip_put_text(out, " %8s %8s %6s %-14s", "-", "-", "-", "");
        return;
    }
    char interval[DIP_COST_INTERVAL];
    dip_cost_interval_text(ratio, 3, interval);
    dip_put_text(out, " %8.2f %8.2f %6.3f %-14s", dip_cost_ms(report, row),
                 report->rows[row].time.p95_ms.value, ratio->value, interval);
}

static void print_row(const DipCostReport *report, const char *name, int row,
                      const DipEstimate *ratio, FILE *out) {
    int viewpoints;
    const DipMetricSums sums = dip_cost_row_sums(report, row, &viewpoints);
    dip_put_text(out, "  %-17s", name);
    print_times(report, row, ratio, out);
    if (viewpoints > 0) {
        const DipMetrics f = dip_metrics_of(&sums, 0);
        const DipFlickerMetrics flicker = dip_flicker_metrics_of(&sums);
        dip_put_text(out, " %7.5f %6.2f %7.5f %7.5f %7.5f %7.5f  %s", f.rmse_lin, f.psnr_db, f.ssim,
                     f.flip, flicker.flicker, flicker.two_mean, dip_cost_floor_mark(report, row));
    }
    dip_put_text(out, "\n");
}

static void print_columns(FILE *out) {
    dip_put_text(out, "  %-17s %8s %8s %6s %-14s %7s %6s %7s %7s %7s %7s\n", "", "mean ms",
                 "p95 ms", "ratio", "95 % interval", "RMSE", "PSNR", "SSIM", "FLIP", "flicker",
                 "2-frame");
}

static void print_floors(const DipCostReport *report, FILE *out) {
    dip_put_text(
        out,
        "\nNoise floor of the truth (an RMSE below three times this value is \"at floor\", and "
        "combinations whose FLIP is below that of the noise rank alike):\n");
    for (int p = 0; p < report->path_count; p++) {
        const DipMetricSums sums = dip_cost_floor(report, p);
        const DipMetrics halves = dip_metrics_of(&sums, 0);
        dip_put_text(
            out,
            "  path %-9s RMSE %.5f, FLIP %.5f; between the two halves: PSNR %.2f dB, SSIM %.5f, "
            "FLIP %.5f\n",
            report->paths[p], dip_cost_floor_rmse(report, p, 0), dip_cost_floor_flip(report, p),
            halves.psnr_db, halves.ssim, halves.flip);
    }
}

// The price is the time of each 1 % by which FLIP falls from the row before.
static void print_front_row(const DipCandidate *row, const DipCandidate *before, bool is_knee,
                            FILE *out) {
    char text[DIP_COST_TEXT];
    char price[32] = "", ms[DIP_NUMBER_BYTES];
    if (before) {
        const double steps = 100.0 * log(before->loss / row->loss);
        dip_number_text((row->time.value - before->time.value) / steps, 3, true, "-", ms);
        snprintf(price, sizeof price, "%.12s ms per 1 %%", ms);
    }
    dip_cost_settings_text(&row->quality, text);
    dip_put_text(out, "  %8.2f ms  FLIP %.5f  %-18s %s%s\n", row->time.value, row->flip, price,
                 text, is_knee ? "  <- knee" : "");
}

static void print_same(const DipCostReport *report, FILE *out) {
    if (report->same_count > 0) {
        dip_put_text(out,
                     "\n%d more combinations draw the same pictures as one with fewer settings off "
                     "their defaults; cost.json lists them.\n",
                     report->same_count);
    }
}

static void print_front(const DipCostReport *report, FILE *out) {
    const DipCostChoice *choice = &report->choice;
    const DipCandidate *list = choice->candidates.list;
    if (choice->front_count == 0) {
        return;
    }
    dip_put_text(
        out,
        "\n"
        "Pareto front of %d measured combinations on path %s: no other combination has less "
        "%s time and less FLIP.\n"
        "A combination is listed only if its FLIP is at least 1 %% below the FLIP of the line "
        "above.\n",
        choice->candidates.count, report->paths[0], dip_time_kind_names[choice->candidates.kind]);
    for (int i = 0; i < choice->front_count; i++) {
        print_front_row(&list[choice->front[i]], i > 0 ? &list[choice->front[i - 1]] : NULL,
                        i == choice->knee, out);
    }
    if (choice->front_count > 1) {
        dip_put_text(out,
                     "  (after FLIP: what 1 %% less FLIP cost on the way from the line above%s)\n",
                     choice->knee >= 0 ? "; knee: beyond it, more time buys least" : "");
    }
}

static void print_fit(const DipCostReport *report, FILE *out) {
    const DipCostFit *fit = report->analysis ? &report->analysis->fit : NULL;
    if (!fit || fit->rows == 0) {
        return;
    }
    char smaller[48] = "";
    if (report->smaller_count > 0) {
        snprintf(smaller, sizeof smaller, " and %d at %dx%d", report->smaller_count,
                 report->smaller_width, report->smaller_height);
    }
    dip_put_text(
        out,
        "\n"
        "Linear fit of the time of each stage to its work (%d rows%s, R2 %.3f, median error "
        "%.1f %%).\n"
        "Each row predicted from all others: median error %.1f %%, %.0f %% within 10 %%.\n"
        "Nanoseconds per unit of work:\n",
        fit->rows, smaller, fit->r2, 100.0 * fit->median_miss, 100.0 * fit->others.median,
        100.0 * fit->others.within_10);
    for (int i = 0; i < fit->count; i++) {
        if (fit->ns[i] > 0.0) {
            dip_put_text(out, "  %-9s %10.3g per %s\n", fit->stages[i], fit->ns[i], fit->names[i]);
        }
    }
}

static void print_misses(const char *what, const DipCostMisses *times, const DipCostMisses *errors,
                         FILE *out) {
    if (times->rows > 0) {
        dip_put_text(
            out, "  %-58s time %4.1f %% (90 %% of them within %.1f %%), FLIP %4.1f %% (%.1f %%)\n",
            what, 100.0 * times->median, 100.0 * times->p90, 100.0 * errors->median,
            100.0 * errors->p90);
    }
}

static void print_prediction(const DipCostReport *report, FILE *out) {
    const DipCostPredictions *p = &report->predicted;
    if (p->count == 0) {
        return;
    }
    dip_put_text(
        out,
        "\n"
        "Predicted %d combinations on path %s from %d measured ones, then measured %d that the "
        "prediction found best.\n"
        "Median miss of the predictions:\n",
        p->count, report->paths[0], p->trained, p->times.rows);
    print_misses("combinations measured after they had been predicted", &p->times, &p->errors, out);
    print_misses("each of the first ones, predicted from the others", &p->times_left_out,
                 &p->errors_left_out, out);
    if (p->count > DIP_COST_MOST_COUNTED) {
        dip_put_text(out,
                     "  The work of combinations of antialiasing and filtering was composed from "
                     "the work of either.\n");
    }
}

// --- the answer ----------------------------------------------------------------------------------

static void print_ties(const DipCandidates *candidates, const DipAdvice *advice, FILE *out) {
    char text[DIP_COST_TEXT];
    if (advice->tie_count == 0) {
        return;
    }
    dip_put_text(out, "  as good  %d more within 1 %% of FLIP:", advice->tie_count);
    for (int i = 0; i < advice->tie_count && i < DIP_ADVICE_TIES; i++) {
        dip_cost_settings_text(&candidates->list[advice->ties[i]].quality, text);
        dip_put_text(out, "%s %s", i > 0 ? ";" : "", text);
    }
    dip_put_text(out, "%s\n", advice->tie_count > DIP_ADVICE_TIES ? "; ..." : "");
}

// Says what the next better settings cost, in the kind of time of the budget.
static void print_next(const DipCandidates *candidates, const DipAdvice *advice, FILE *out) {
    char text[DIP_COST_TEXT], ms[DIP_NUMBER_BYTES], flip[DIP_NUMBER_BYTES], fits[DIP_NUMBER_BYTES];
    if (advice->next < 0) {
        dip_put_text(out, "  better   nothing that was measured\n");
        return;
    }
    const DipCandidate *chosen = &candidates->list[advice->chosen];
    const DipCandidate *next = &candidates->list[advice->next];
    dip_cost_settings_text(&next->quality, text);
    dip_number_text(advice->next_ms, 2, true, "-", ms);
    dip_number_text(next->flip - chosen->flip, 5, true, "-", flip);
    dip_fits_text(advice->next_fits, fits);
    dip_put_text(out, "  better   %s: %s ms %s, FLIP %s; fits with %s\n", text, ms,
                 dip_time_kind_names[candidates->kind], flip, fits);
}

static void print_chosen(const DipCostReport *report, const DipAdvice *advice, FILE *out) {
    const DipCandidates *candidates = &report->choice.candidates;
    const DipCandidate *chosen = &candidates->list[advice->chosen];
    const DipEstimate time = dip_estimate_widen(&chosen->time, chosen->common_error);
    char text[256], fits[DIP_NUMBER_BYTES];
    dip_cost_settings_text(&chosen->quality, text);
    dip_fits_text(advice->fits, fits);
    dip_put_text(out, "  %s\n", text);
    dip_put_text(out, "  time     %.2f ms %s along the path (%.2f to %.2f), mean %.2f ms\n",
                 time.value, dip_time_kind_names[candidates->kind], time.low, time.high,
                 dip_cost_ms(report, chosen->row));
    const double base = dip_cost_row_metrics(report, report->base_rows[0], 0).flip;
    dip_put_text(out, "  fits     with %s\n  error    FLIP %.5f", fits, chosen->flip);
    if (base > 0.0) {
        dip_number_text(100.0 * (chosen->flip / base - 1.0), 0, true, "-", fits);
        dip_put_text(out, ", %s %% against the baseline's %.5f", fits, base);
    }
    dip_put_text(out, "\n");
    print_ties(candidates, advice, out);
    print_next(candidates, advice, out);
    dip_quality_format(&chosen->quality, text, sizeof text);
    dip_put_text(out, "  ini      REQUESTED: %s\n", text);
}

static void print_nothing(const DipCandidates *candidates, const DipAdvice *advice, FILE *out) {
    char text[DIP_COST_TEXT], fits[DIP_NUMBER_BYTES];
    const DipCandidate *fastest = &candidates->list[advice->next];
    dip_cost_settings_text(&fastest->quality, text);
    dip_fits_text(advice->next_fits, fits);
    dip_put_text(out,
                 "  nothing that was measured surely fits; the fastest, %s, takes %.2f ms %s and "
                 "fits with %s\n",
                 text, fastest->time.value, dip_time_kind_names[candidates->kind], fits);
}

// What most readers came for: the best settings for their budgets.
static void print_answer(const DipCostReport *report, FILE *out) {
    const DipCostChoice *choice = &report->choice;
    if (choice->candidates.disturbed && choice->candidates.count > 0) {
        dip_put_text(
            out, "The machine was too busy: the times are wrong, so no settings are advised. %s\n",
            report->verdict_reason);
        return;
    }
    for (int i = 0; i < choice->advice_count; i++) {
        const DipAdvice *advice = &choice->advice[i];
        char budget[DIP_BUDGET_BYTES];
        dip_budget_text(advice->budget_ms, budget);
        dip_put_text(out, i > 0 ? "\n%s on this machine:\n" : "%s on this machine:\n", budget);
        if (advice->chosen >= 0) {
            print_chosen(report, advice, out);
        } else {
            print_nothing(&choice->candidates, advice, out);
        }
    }
}

// --- the rest ------------------------------------------------------------------------------------

static void print_interactions(const DipCostReport *report, FILE *out) {
    const DipCostInteraction *list = report->analysis ? report->analysis->interactions : NULL;
    const int count = list ? report->analysis->interaction_count : 0;
    for (int i = 0; i < count; i++) {
        char time[32] = "";
        if (i == 0) {
            dip_put_text(out,
                         "\nTwo settings together, against each alone (last steps; mean over the "
                         "combinations of the others):\n");
        }
        if (list[i].time > 0.0) {
            snprintf(time, sizeof time, "time x %.3f, ", list[i].time);
        }
        dip_put_text(out, "  %s and %s: %sFLIP %+.5f  (%d combination%s)\n",
                     dip_setting_info(list[i].a)->key, dip_setting_info(list[i].b)->key, time,
                     list[i].flip, list[i].contexts, dip_cost_plural(list[i].contexts));
    }
}

// Four budgets make the four tiers of a settings menu.
static void print_tiers(const DipCostReport *report, FILE *out) {
    DipCostTier tiers[DIP_COST_TIER_COUNT];
    if (!report->choice.candidates.disturbed && dip_cost_tiers_of(report, tiers)) {
        dip_cost_tiers_print(tiers, out);
    }
}

void dip_cost_print(const DipCostReport *report, FILE *out) {
    print_answer(report, out);
    print_tiers(report, out);
    print_front(report, out);
    if (report->choice.candidates.count > 0) {
        dip_put_text(out, "\n");
    }
    print_heading(report, out);
    dip_put_text(out, "\n");
    print_columns(out);
    for (int p = 0; p < report->path_count && report->rounds > 0; p++) {
        char name[40];
        snprintf(name, sizeof name, "A/A on %s", report->paths[p]);
        const int row = report->same_rows[p];
        print_row(report, name, row, &report->rows[row].time.ratio, out);
    }
    for (int s = 0; s < report->sweep_count; s++) {
        const DipCostSweep *sweep = &report->sweeps[s];
        char title[DIP_COST_TEXT];
        dip_cost_sweep_title(report, sweep, title);
        dip_put_text(out, "%s, on path %s\n", title, report->paths[sweep->path]);
        for (int i = 0; i < sweep->row_count; i++) {
            char text[DIP_COST_TEXT];
            dip_cost_step_text(report, sweep, sweep->rows[i], text);
            print_row(report, text, sweep->rows[i], &sweep->ratios[i], out);
        }
        char order[2 * DIP_COST_TEXT];
        if (dip_cost_order_text(report, sweep, order, sizeof order)) {
            dip_put_text(out, "  %s\n", order);
        }
    }
    print_floors(report, out);
    if (report->refused_count > 0) {
        dip_put_text(out, "\nSteps left out, with the reason:\n");
    }
    for (int i = 0; i < report->refused_count; i++) {
        dip_put_text(out, "  %s\n", report->refused[i]);
    }
    print_interactions(report, out);
    print_prediction(report, out);
    print_same(report, out);
    print_fit(report, out);
}
