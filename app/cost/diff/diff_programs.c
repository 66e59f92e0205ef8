// Comparing two programs that took turns at every frame.
#include "app/cost/diff/diff_programs.h"

#include "app/cost/diff/diff_cause.h"
#include "app/cost/diff/diff_setup.h"
#include "app/cli/machine.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost diff", "out of memory");
}

static DipCostSetup *setup_programs(const DipCostDiffArguments *arguments,
                                    const char *const programs[2]) {
    DipCostSetup *setup = calloc(1, sizeof *setup);
    if (!setup) {
        return NULL;
    }
    for (int s = 0; s < arguments->set_count; s++) {
        dip_cost_setup_add_set(setup, arguments->sets[s].text);
        memcpy(setup->def.program_of[s], (const int[2]){0, 1}, 2 * sizeof(int));
        memcpy(setup->def.combination_of[s], (const int[2]){s, s}, 2 * sizeof(int));
    }
    const int same = arguments->set_count;
    dip_cost_setup_add_set(setup, arguments->sets[0].text);
    memcpy(setup->def.combination_of[same], (const int[2]){0, same}, 2 * sizeof(int));
    setup->def.pair_count = same + 1;
    setup->def.program_count = 2;
    memcpy(setup->def.programs, programs, sizeof setup->def.programs);
    dip_cost_setup_finish(
        setup, arguments, arguments->frames ? arguments->frames : DIP_COST_DIFF_FRAMES,
        arguments->measure.rounds ? arguments->measure.rounds : DIP_COST_DIFF_ROUNDS);
    return setup;
}

static void compare_work(const DipCostSetup *setup, int pair, DipCostDiffRow *row) {
    for (int side = 0; side < 2; side++) {
        for (int q = 0; q < DIP_COST_DIFF_QUANTITY_COUNT; q++) {
            row->values[side][q] = q < DIP_COST_DIFF_ERROR_COUNT ? NAN : 0.0;
        }
        dip_cost_setup_count(setup, side, pair, row->values[side] + DIP_COST_DIFF_FIRST_COUNTER);
    }
    for (int f = 0; f < setup->plan.options.frames; f++) {
        row->values[1][DIP_COST_DIFF_pictures] +=
            strcmp(dip_cost_setup_sample(setup, 0, pair, f)->hash,
                   dip_cost_setup_sample(setup, 1, pair, f)->hash) != 0;
    }
}

static bool compare_pair(const DipCostSetup *setup, const DipCostDiffArguments *arguments, int pair,
                         DipCostDiffRow *row, DipError *err) {
    const DipSessionOptions *session = &arguments->session;
    *row = (DipCostDiffRow){.quality = arguments->sets[pair].quality, .timed = true};
    snprintf(row->path, sizeof row->path, "%s",
             session->category ? session->category
             : session->path   ? "PATH"
                               : "DEFAULT");
    compare_work(setup, pair, row);
    for (int side = 0; side < 2; side++) {
        row->ms[side] = dip_cost_duel_mean_ms(&setup->duel, side, pair);
    }
    bool done = (!isnan(row->ms[0]) && !isnan(row->ms[1])) || out_of_memory(err);
    for (int stage = 0; done && stage < DIP_COST_DIFF_STAGES; stage++) {
        done = dip_cost_duel_change(&setup->duel, pair, (DipBenchStage)stage, &row->stages[stage],
                                    err);
    }
    done =
        done && dip_cost_duel_change(&setup->duel, pair, DIP_BENCH_STAGE_total, &row->change, err);
    row->surely_above = row->change.low;
    row->surely_below = row->change.high;
    return done;
}

static bool judge_machine(const DipCostSetup *setup, DipCostDiff *diff, DipError *err) {
    DipCostSigns signs;
    if (!dip_cost_duel_signs(&setup->duel, &signs, err)) {
        return false;
    }
    char processor[DIP_COST_TEXT];
    dip_machine_processor(processor, sizeof processor);
    for (int side = 0; side < 2; side++) {
        diff->verdicts[side] = dip_cost_verdict_of(&signs, diff->reasons[side]);
        snprintf(diff->machines[side], sizeof diff->machines[side], "%s, %d thread%s", processor,
                 setup->duel.threads, dip_cost_plural(setup->duel.threads));
    }
    if (!setup->duel.has_wait) {
        dip_cost_diff_note(diff, "this system does not tell how long threads wait for a core, so "
                                 "only the A/A times show whether the machine was quiet");
    }
    return true;
}

// --- the likely cause ----------------------------------------------------------------------------

// The stage that takes most of the additional time of the slower rows. Writes its share of it.
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

// Kinds of work that may explain additional time: 0 is one per frame, 1 is A's time of the stage,
// and then the counters.
enum { PER_FRAME, STAGE_TIME, FIRST_COUNTER };

static double stage_ms(const DipCostSetup *setup, int pair, DipBenchStage stage) {
    const double *ms = dip_cost_duel_ms(&setup->duel, 0, pair, stage);
    const int count = setup->def.starts * setup->def.rounds * setup->plan.options.frames;
    double sum = 0.0;
    for (int i = 0; i < count; i++) {
        sum += ms[i];
    }
    return sum / count;
}

static void list_work(const DipCostSetup *setup, const DipCostDiff *diff, DipBenchStage stage,
                      double *work) {
    const int rows = diff->row_count;
    for (int r = 0; r < rows; r++) {
        work[PER_FRAME * rows + r] = 1.0;
        work[STAGE_TIME * rows + r] = stage_ms(setup, r, stage);
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

static bool find_cause(const DipCostSetup *setup, DipCostDiff *diff, DipError *err) {
    const int rows = diff->row_count, starts = setup->def.starts;
    const int kinds = FIRST_COUNTER + DIP_COST_COUNTER_COUNT;
    double share;
    const DipBenchStage stage = slowest_stage(diff, &share);
    double *per_start = malloc((size_t)(rows * (starts + kinds)) * sizeof *per_start);
    if (!per_start) {
        return out_of_memory(err);
    }
    double *work = per_start + rows * starts;
    bool done = true;
    for (int r = 0; done && r < rows; r++) {
        DipStartDifference difference;
        done = dip_cost_duel_difference(&setup->duel, r, stage, per_start + r * starts, &difference,
                                        err);
    }
    if (done) {
        DipCause cause;
        const DipCauseData data = {rows, starts, kinds, per_start, work};
        list_work(setup, diff, stage, work);
        snprintf(diff->cause, sizeof diff->cause,
                 "%.0f %% of the additional time is in the stage %s.", 100.0 * share,
                 dip_bench_stage_names[stage]);
        done = rows < 4 || dip_cause_find(&data, &cause, err);
        if (done && rows >= 4) {
            write_cause(diff, &data, &cause, dip_bench_stage_names[stage]);
        }
    }
    free(per_start);
    return done;
}

static bool compare_pairs(const DipCostSetup *setup, const DipCostDiffArguments *arguments,
                          DipCostDiff *diff, DipError *err) {
    diff->rows = calloc((size_t)arguments->set_count, sizeof *diff->rows);
    bool done = diff->rows || out_of_memory(err);
    for (int r = 0; done && r < arguments->set_count; r++) {
        done = compare_pair(setup, arguments, r, &diff->rows[diff->row_count++], err);
    }
    done = done && judge_machine(setup, diff, err);
    diff->kind = DIP_COST_DIFF_PROGRAMS;
    diff->same_machine = true;
    diff->has_times = true;
    if (done) {
        dip_cost_diff_leave_out_uncounted(diff);
        dip_cost_diff_mark(diff);
        done = diff->slower == 0 || find_cause(setup, diff, err);
    }
    return done;
}

bool dip_cost_diff_programs(const DipCostDiffArguments *arguments, const char *const programs[2],
                            DipCostDiff *diff, DipError *err) {
    DipCostSetup *setup = setup_programs(arguments, programs);
    bool done = setup || out_of_memory(err);
    done = done && dip_cost_duel_run(&setup->def, &setup->duel, err) &&
           compare_pairs(setup, arguments, diff, err);
    dip_cost_setup_free(setup);
    if (!done) {
        dip_cost_diff_free(diff);
    }
    return done;
}
