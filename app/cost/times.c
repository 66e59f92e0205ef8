// Timing every row in interleaved rounds: each round draws every frame of every row once. The work
// counters of a row come from the warm-up, which draws each frame before any time is taken.
#include "app/cost/steps.h"
#include "app/measure/timing.h"
#include "app/progress.h"

#include <stdlib.h>

typedef struct RowTiming {
    DipCostContext *cost;
    DipFrame frame; // the frame of the latest run
    DipProgress progress;
    int64_t drawn;
} RowTiming;

static bool draw(void *context, const DipTimingTurn *turn, DipError *err) {
    RowTiming *t = context;
    return dip_cost_draw_timed(t->cost, turn->subject, turn->frame, &t->frame, err);
}

static void add_counters(DipCostRow *row, const DipCounters *counters, double share) {
    double *value = row->counters;
#define ADD_COUNTER(name, text) *value++ += share * (double)counters->name;
    DIP_COUNTER_LIST(ADD_COUNTER)
#undef ADD_COUNTER
}

static bool after_draw(void *context, const DipTimingTurn *turn, double ms, DipError *err) {
    (void)ms;
    RowTiming *t = context;
    DipCostReport *report = t->cost->report;
    if (turn->phase == DIP_TIMING_WARM_UP) {
        add_counters(&report->rows[turn->subject], &t->frame.counters,
                     1.0 / report->options.timed_frames);
    }
    // Settling: before the first round, frames are drawn until their time is steady. The number of
    // these frames is not known in advance, so the progress does not include them.
    t->drawn += turn->phase != DIP_TIMING_SETTLE;
    dip_progress_show(&t->progress, t->drawn);
    return !dip_cost_interrupted(t->cost, err);
}

static int round_value_count(const DipCostReport *report) {
    return report->row_count * report->options.timed_frames;
}

static const double *known_round(void *context, int round) {
    const RowTiming *t = context;
    return dip_cost_journal_round(t->cost->journal, round, round_value_count(t->cost->report));
}

static bool keep_round(void *context, int round, const double *ms, bool known, DipError *err) {
    const RowTiming *t = context;
    DipCostReport *report = t->cost->report;
    const int frames = report->options.timed_frames;
    for (int row = 0; row < report->row_count; row++) {
        for (int f = 0; f < frames; f++) {
            report->rows[row].ms[round * frames + f] = ms[row * frames + f];
        }
    }
    report->rounds = round + 1;
    return known ||
           dip_cost_journal_add_round(t->cost->journal, ms, round_value_count(report), err);
}

bool dip_cost_time_rows(DipCostContext *cost, DipError *err) {
    const DipCostReport *report = cost->report;
    const DipTimingDef def = {
        .subject_count = report->row_count,
        .frame_count = report->options.timed_frames,
        .version_count = 1,
        .round_count = report->options.rounds,
        .seed = (uint64_t)report->options.seed,
        .settle = true,
    };
    RowTiming t = {.cost = cost};
    const DipTimingCalls calls = {
        .run = draw,
        .after_run = after_draw,
        .known_round = known_round,
        .after_round = keep_round,
        .context = &t,
    };
    int known = 0;
    while (known < def.round_count && known_round(&t, known)) {
        known++;
    }
    t.progress = dip_progress_begin("frames timed", dip_timing_run_count(&def, known));
    const bool timed = dip_timing_run(&def, &calls, NULL, err);
    dip_progress_end(&t.progress, t.drawn);
    return timed;
}

// --- one row again -----------------------------------------------------------------------------

typedef struct AgainTiming {
    DipCostContext *cost;
    int row;
} AgainTiming;

static bool draw_again(void *context, const DipTimingTurn *turn, DipError *err) {
    const AgainTiming *t = context;
    DipFrame frame;
    return dip_cost_draw_timed(t->cost, t->row, turn->frame, &frame, err);
}

static bool after_draw_again(void *context, const DipTimingTurn *turn, double ms, DipError *err) {
    (void)turn;
    (void)ms;
    const AgainTiming *t = context;
    return !dip_cost_interrupted(t->cost, err);
}

bool dip_cost_time_row_again(DipCostContext *cost, int row, DipStatsEstimate *time, DipError *err) {
    const DipCostOptions *options = &cost->report->options;
    const DipTimingDef def = {
        .subject_count = 1,
        .frame_count = options->timed_frames,
        .version_count = 1,
        .round_count = options->rounds,
    };
    AgainTiming t = {cost, row};
    const DipTimingCalls calls = {
        .run = draw_again,
        .after_run = after_draw_again,
        .context = &t,
    };
    double *ms = malloc((size_t)options->rounds * (size_t)options->timed_frames * sizeof *ms);
    const bool timed =
        (ms || dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory")) &&
        dip_timing_run(&def, &calls, ms, err);
    (void)dip_stats_ran_out();
    if (timed) {
        *time = dip_stats_time_estimate(ms, options->timed_frames, options->rounds);
    }
    free(ms);
    return timed && (!dip_stats_ran_out() ||
                     dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory"));
}
