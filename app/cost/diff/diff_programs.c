// Compares two programs that took turns at every frame, and measures the rows of a report again.
#include "app/cost/diff/diff.h"

#include "app/cli/machine.h"
#include "app/cost/diff/diff_cause.h"
#include "app/cost/diff/diff_duel.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- two programs --------------------------------------------------------------------------------

static void compare_work(const DipCostDuel *duel, int pair, DipCostDiffRow *row) {
    for (int side = 0; side < 2; side++) {
        for (int q = 0; q < DIP_COST_DIFF_QUANTITY_COUNT; q++) {
            row->values[side][q] = q < DIP_COST_DIFF_ERROR_COUNT ? NAN : 0.0;
        }
        dip_cost_duel_count(duel, 2 * pair + side, row->values[side] + DIP_COST_DIFF_FIRST_COUNTER);
    }
    const DipBenchSample *a = duel->first + 2 * pair * duel->frames, *b = a + duel->frames;
    for (int f = 0; f < duel->frames; f++) {
        row->values[1][DIP_COST_DIFF_pictures] += strcmp(a[f].hash, b[f].hash) != 0;
    }
}

static void compare_pair(const DipCostDuel *duel, const DipCostDiffArguments *arguments, int pair,
                         DipCostDiffRow *row) {
    const DipSessionOptions *session = &arguments->session;
    *row = (DipCostDiffRow){.quality = arguments->sets[pair].quality, .timed = true};
    snprintf(row->path, sizeof row->path, "%s",
             session->category ? session->category
             : session->path   ? "PATH"
                               : "DEFAULT");
    compare_work(duel, pair, row);
    for (int side = 0; side < 2; side++) {
        row->ms[side] = dip_times_along(duel->fit, 2 * pair + side).mean_ms.value;
    }
    row->change = dip_times_ratio(duel->fit, 2 * pair + 1);
    row->surely_above = row->change.low;
    row->surely_below = row->change.high;
}

// Estimates the changes of all rows, as if only one stage differed.
static bool compare_stages(const DipCostDuel *duel, DipCostDiff *diff, DipError *err) {
    const DipTimes times = dip_driver_times(duel->driver);
    for (int stage = 0; stage < DIP_COST_DIFF_STAGES; stage++) {
        DipTimesFit *fit = dip_times_fit_part(&times, stage, err);
        if (!fit) {
            return false;
        }
        for (int r = 0; r < diff->row_count; r++) {
            diff->rows[r].stages[stage] = dip_times_ratio(fit, 2 * r + 1);
        }
        dip_times_fit_free(&fit);
    }
    return true;
}

static void judge_machine(const DipCostDuel *duel, DipCostDiff *diff) {
    char processor[DIP_COST_TEXT];
    dip_machine_processor(processor, sizeof processor);
    for (int side = 0; side < 2; side++) {
        diff->verdicts[side] = dip_cost_duel_verdict(duel, diff->reasons[side]);
        snprintf(diff->machines[side], sizeof diff->machines[side], "%s, %d thread%s", processor,
                 duel->threads, dip_cost_plural(duel->threads));
    }
    if (!dip_driver_machine(duel->driver, duel->threads).has_wait) {
        dip_cost_diff_note(diff, "this system does not tell how long threads wait for a core, so "
                                 "only the A/A times show whether the machine was quiet");
    }
}

// --- the likely cause ----------------------------------------------------------------------------

// Returns the stage that takes most of the additional time of the slower rows. Writes the share of
// the additional time that this stage takes.
static DipBenchStage slowest_stage(const DipCostDiff *diff, double *share) {
    double most = 0.0, total = 0.0;
    DipBenchStage found = (DipBenchStage)0;
    for (int stage = 0; stage < DIP_COST_DIFF_STAGES; stage++) {
        double ms = 0.0;
        for (int r = 0; r < diff->row_count; r++) {
            const DipCostDiffRow *row = &diff->rows[r];
            ms += row->mark == DIP_COST_DIFF_SLOWER ? row->ms[0] * (row->stages[stage].value - 1.0)
                                                    : 0.0;
        }
        total += fmax(ms, 0.0);
        if (ms > most) {
            most = ms;
            found = (DipBenchStage)stage;
        }
    }
    *share = total > 0.0 ? most / total : 0.0;
    return found;
}

// Kinds of work that may explain additional time: one unit per frame, A's time of the stage, and
// the counters.
enum { PER_FRAME, STAGE_TIME, FIRST_COUNTER };

static void list_work(const DipCostDuel *duel, const DipCostDiff *diff, DipBenchStage stage,
                      double *work) {
    const int rows = diff->row_count;
    for (int r = 0; r < rows; r++) {
        work[PER_FRAME * rows + r] = 1.0;
        work[STAGE_TIME * rows + r] =
            diff->rows[r].ms[0] * dip_times_shares(duel->fit, 2 * r)[stage];
        for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
            const double value = diff->rows[r].values[0][DIP_COST_DIFF_FIRST_COUNTER + c];
            work[(FIRST_COUNTER + c) * rows + r] = isnan(value) ? 0.0 : value;
        }
    }
}

static void write_cause(DipCostDiff *diff, const DipCauseData *data, const DipCause *cause,
                        const char *stage) {
    const size_t used = strlen(diff->cause);
    char *text = diff->cause + used;
    const size_t size = sizeof diff->cause - used;
    if (cause->kind == PER_FRAME) {
        snprintf(text, size,
                 " It is about the same with all settings, %.3f ms per frame, so its cause does "
                 "not grow with their work.",
                 cause->price);
    } else if (cause->kind == STAGE_TIME) {
        snprintf(text, size, " It is about the same share of %s with all settings, %.1f %%.", stage,
                 100.0 * cause->price);
    } else if (cause->kind >= FIRST_COUNTER) {
        const int counter = cause->kind - FIRST_COUNTER;
        int written = snprintf(text, size,
                               " It grows with %s, by %.3g ns each: this work is the likely cause.",
                               dip_cost_counter_names[counter], 1e6 * cause->price);
        for (int k = cause->kind + 1; k < data->kinds; k++) {
            if (dip_cause_is_same_work(data, cause->kind, k) && written >= 0 &&
                (size_t)written < size) {
                written +=
                    snprintf(text + written, size - (size_t)written, " (%s grows in proportion.)",
                             dip_cost_counter_names[k - FIRST_COUNTER]);
            }
        }
    }
}

static bool find_cause(const DipCostDuel *duel, DipCostDiff *diff, DipError *err) {
    const int rows = diff->row_count, starts = duel->starts;
    const int kinds = FIRST_COUNTER + DIP_COST_COUNTER_COUNT;
    double share;
    const DipBenchStage stage = slowest_stage(diff, &share);
    const char *name = dip_bench_stage_names[stage];
    snprintf(diff->cause, sizeof diff->cause, "%.0f %% of the additional time is in the stage %s.",
             100.0 * share, name);
    if (rows < 4) {
        return true;
    }
    double *per_start = malloc((size_t)(rows * (starts + kinds)) * sizeof *per_start);
    if (!per_start) {
        return dip_cost_diff_no_memory(err);
    }
    DipCause cause;
    const DipCauseData data = {rows, starts, kinds, per_start, per_start + rows * starts};
    list_work(duel, diff, stage, per_start + rows * starts);
    const bool done =
        dip_cost_duel_per_start(duel, stage, per_start, err) && dip_cause_find(&data, &cause, err);
    if (done) {
        write_cause(diff, &data, &cause, name);
    }
    free(per_start);
    return done;
}

static bool compare_pairs(const DipCostDuel *duel, const DipCostDiffArguments *arguments,
                          DipCostDiff *diff, DipError *err) {
    diff->rows = calloc((size_t)arguments->set_count, sizeof *diff->rows);
    if (!diff->rows) {
        return dip_cost_diff_no_memory(err);
    }
    diff->kind = DIP_COST_DIFF_PROGRAMS;
    diff->same_machine = true;
    diff->has_times = true;
    while (diff->row_count < arguments->set_count) {
        compare_pair(duel, arguments, diff->row_count, &diff->rows[diff->row_count]);
        diff->row_count++;
    }
    judge_machine(duel, diff);
    dip_cost_diff_leave_out_uncounted(diff);
    dip_cost_diff_mark(diff);
    return compare_stages(duel, diff, err) && (diff->slower == 0 || find_cause(duel, diff, err));
}

bool dip_cost_diff_programs(const DipCostDiffArguments *arguments, const char *const programs[2],
                            DipCostDiff *diff, DipError *err) {
    DipCostDuel duel = {.programs = {programs[0], programs[1]}};
    for (int s = 0; s <= arguments->set_count; s++) { // The last one is the A/A pair's.
        dip_cost_duel_add_set(&duel, arguments->sets[s % arguments->set_count].text);
    }
    const bool done =
        dip_cost_duel_run(
            &duel, arguments, arguments->frames ? arguments->frames : DIP_COST_DIFF_FRAMES,
            arguments->measure.rounds ? arguments->measure.rounds : DIP_COST_DIFF_ROUNDS, err) &&
        compare_pairs(&duel, arguments, diff, err);
    dip_cost_duel_free(&duel);
    if (!done) {
        dip_cost_diff_free(diff);
    }
    return done;
}

// --- a report and a program ----------------------------------------------------------------------

// Lists the rows to measure: the baseline is combination 0 and has no pair of its own.
static int list_rows(const DipCostDiffArguments *arguments, const DipCostReport *report,
                     int rows[DIP_COST_DIFF_MAX_SETS]) {
    int count = 0;
    for (int s = 0; s < arguments->set_count; s++) {
        const DipQuality *quality = &arguments->sets[s].quality;
        const int row = dip_report_find(report, quality, 0, 0);
        if (row >= 0 && memcmp(quality, &report->options.baseline, sizeof *quality) != 0) {
            rows[count++] = row;
        }
    }
    return count;
}

// Another build may not know every setting, so those with their defaults are left out.
static void add_quality(DipCostDuel *duel, const DipQuality *quality) {
    const DipQuality standard = dip_quality_default();
    char text[DIP_COST_TEXT] = "aa=none";
    if (memcmp(quality, &standard, sizeof standard) != 0) {
        dip_cost_settings_text(quality, text);
    }
    dip_cost_duel_add_set(duel, text);
}

// Completes the options with what the report was measured with.
static DipCostDiffArguments options_of_report(const DipCostDiffArguments *arguments,
                                              const DipCostReport *report) {
    DipCostDiffArguments all = *arguments;
    DipSessionOptions *session = &all.session;
    DipIsa isa;
    if (!session->has_size) {
        session->has_size = true;
        session->size = (DipOptionSize){report->width, report->height};
    }
    if (!session->has_threads) {
        session->has_threads = true;
        session->threads = report->threads;
    }
    if (!session->has_isa) {
        const bool known = dip_isa_parse(report->isa, &isa) && dip_isa_available(isa);
        session->has_isa = true;
        session->isa = known ? isa : dip_isa_best();
    }
    if (!session->path && !session->model_count && !session->category) {
        session->category = report->paths[0];
    }
    return all;
}

// Fills in a report that has the report's first path and `count` rows besides the baseline.
static bool make_report(const DipCostReport *report, const DipCostDuel *duel, const int *rows,
                        int count, const DipSessionOptions *session, DipCostReport *measured,
                        DipError *err) {
    *measured = (DipCostReport){
        .threads = duel->threads,
        .width = session->size.width,
        .height = session->size.height,
        .options = report->options,
        .path_count = 1,
        .combined_first = count + 1,
        .rounds = report->rounds,
        .starts = duel->starts,
    };
    memcpy(measured->paths[0], report->paths[0], sizeof measured->paths[0]);
    snprintf(measured->scene, sizeof measured->scene, "%s", report->scene);
    snprintf(measured->isa, sizeof measured->isa, "%s", dip_isa_name(session->isa));
    dip_machine_processor(measured->processor, sizeof measured->processor);
    measured->rows = calloc((size_t)count + 1, sizeof *measured->rows);
    measured->row_count = measured->rows ? count + 1 : 0;
    if (!measured->rows || !dip_cost_report_alloc(measured, NULL)) {
        return dip_cost_diff_no_memory(err);
    }
    for (int i = 0; i <= count; i++) {
        // Row 0 is the baseline, which is side 0 of every pair.
        const int subject = i ? 2 * i - 1 : 0;
        DipCostRow *row = &measured->rows[i];
        row->quality = i ? report->rows[rows[i - 1]].quality : report->options.baseline;
        dip_cost_duel_count(duel, subject, row->counters);
        row->time.mean_ms.value = dip_times_along(duel->fit, subject).mean_ms.value;
        row->time.ratio = i ? dip_times_ratio(duel->fit, subject) : dip_estimate_unknown(1.0);
    }
    measured->verdict = dip_cost_duel_verdict(duel, measured->verdict_reason);
    return true;
}

bool dip_cost_diff_measure_report(const DipCostDiffArguments *arguments, const char *program,
                                  const DipCostReport *report, DipCostReport *measured,
                                  DipError *err) {
    int rows[DIP_COST_DIFF_MAX_SETS];
    const int count = list_rows(arguments, report, rows);
    *measured = (DipCostReport){.rows = NULL};
    if (report->rounds == 0 || count == 0) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "cost diff",
                             "the report has %s; name settings of its first path with --sets",
                             report->rounds == 0 ? "no times to compare with"
                                                 : "none of the settings to time");
    }
    const DipCostDiffArguments all = options_of_report(arguments, report);
    DipCostDuel duel = {.programs = {program}};
    for (int i = 0; i < count + 2; i++) { // The last one is the A/A pair's.
        const bool is_row = i > 0 && i <= count;
        add_quality(&duel, is_row ? &report->rows[rows[i - 1]].quality : &report->options.baseline);
    }
    const bool done =
        dip_cost_duel_run(&duel, &all, dip_cost_frame_count(report),
                          arguments->measure.rounds ? arguments->measure.rounds : 1, err) &&
        make_report(report, &duel, rows, count, &all.session, measured, err);
    dip_cost_duel_free(&duel);
    if (!done) {
        dip_cost_report_free(measured);
    }
    return done;
}
