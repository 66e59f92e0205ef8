// Timing every row beside the baseline of its path, and counting its work. Counters are the same
// in every run of a frame, so each frame is counted once.
#include "app/cost/steps.h"
#include "app/measure/paired_timing.h"
#include "app/progress.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Rows per block besides the baseline. Blocks of 4 halve the deviation of ratios against one
// baseline per round, at the same cost.
enum { BLOCK_ROWS = 4 };

typedef struct RowTiming {
    DipCostContext *cost;
    bool *counted;  // [row * frames + frame]: the frame's counters are in the row's sums.
    DipFrame frame; // The frame of the latest run.
    DipProgress progress;
    int64_t drawn;
} RowTiming;

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
}

// --- counters ----------------------------------------------------------------------------------

static void count_work(RowTiming *t, int row, int frame) {
    DipCostReport *report = t->cost->report;
    const int frames = dip_cost_frame_count(report);
    bool *counted = &t->counted[(size_t)row * (size_t)frames + (size_t)frame];
    double *value = report->rows[row].counters;
    if (!*counted) {
#define ADD_COUNTER(name, text) *value++ += (double)t->frame.counters.name / frames;
        DIP_COUNTER_LIST(ADD_COUNTER)
#undef ADD_COUNTER
        *counted = true;
    }
}

// Draws the frames of rounds that the journal had, since the journal has no counters.
static bool count_known_rounds(RowTiming *t, DipError *err) {
    const DipCostReport *report = t->cost->report;
    const int frames = dip_cost_frame_count(report);
    for (int row = 0; row < report->row_count; row++) {
        for (int f = 0; f < frames; f++) {
            if (t->counted[row * frames + f]) {
                continue;
            }
            if (dip_cost_interrupted(t->cost, err) ||
                !dip_cost_draw_timed(t->cost, row, f, &t->frame, err)) {
                return false;
            }
            count_work(t, row, f);
        }
    }
    return true;
}

// --- runs and rounds ---------------------------------------------------------------------------

static bool draw(void *context, const DipTimingTurn *turn, DipError *err) {
    RowTiming *t = context;
    return dip_cost_draw_timed(t->cost, turn->subject, turn->frame, &t->frame, err);
}

static void write_stage_ms(const DipFrame *frame, double ms[DIP_TIME_PARTS]) {
    _Static_assert((int)DIP_COST_STAGE_rest == (int)DIP_TIME_PARTS, "each stage is a part");
#define WRITE_STAGE(name, text) *ms++ = frame->stages.name##_ms;
    DIP_STAGE_LIST(WRITE_STAGE)
#undef WRITE_STAGE
}

static void stage_ms(void *context, double ms[DIP_TIME_PARTS]) {
    const RowTiming *t = context;
    write_stage_ms(&t->frame, ms);
}

static bool after_draw(void *context, const DipTimingTurn *turn, double ms, DipError *err) {
    (void)ms;
    RowTiming *t = context;
    count_work(t, turn->subject, turn->frame);
    // The frames until times are steady, and those that are timed again, are not known in advance,
    // so the progress does not include them.
    t->drawn += turn->phase != DIP_TIMING_SETTLE && turn->round < t->cost->report->options.rounds;
    dip_progress_show(&t->progress, t->drawn);
    return !dip_cost_interrupted(t->cost, err);
}

static int round_value_count(const DipCostReport *report) {
    return report->row_count * report->options.timed_frames * DIP_TIME_PAIR_VALUES;
}

static const DipTimePair *known_round(void *context, int round) {
    const RowTiming *t = context;
    return (const DipTimePair *)dip_cost_journal_round(t->cost->journal, round,
                                                       round_value_count(t->cost->report));
}

static bool keep_round(void *context, int round, const DipTimePair *pairs, bool known,
                       DipError *err) {
    const RowTiming *t = context;
    return known || dip_cost_journal_add_round(t->cost->journal, round, (const double *)pairs,
                                               round_value_count(t->cost->report), err);
}

// --- the whole ---------------------------------------------------------------------------------

// Lists the baseline of every row's path.
static int *list_bases(const DipCostReport *report) {
    int *base_of = malloc((size_t)report->row_count * sizeof *base_of);
    for (int r = 0; base_of && r < report->row_count; r++) {
        base_of[r] = report->base_rows[report->rows[r].path];
    }
    return base_of;
}

static bool run_timing(DipCostContext *cost, RowTiming *t, const int *base_of, DipTimePair *pairs,
                       DipError *err) {
    DipCostReport *report = cost->report;
    const DipPairedTimingDef def = {
        .subject_count = report->row_count,
        .base_of = base_of,
        .block_subjects = BLOCK_ROWS,
        .rounds = report->options.rounds,
        .frames_per_round = report->options.timed_frames,
        .seed = (uint64_t)report->options.seed,
        .settle = true,
    };
    const DipPairedTimingCalls calls = {
        .run = draw,
        .after_run = after_draw,
        .known_round = known_round,
        .after_round = keep_round,
        .part_ms = stage_ms,
        .context = t,
    };
    int known = 0;
    while (known < def.rounds && known_round(t, known)) {
        known++;
    }
    t->progress = dip_progress_begin("frames timed", dip_paired_timing_run_count(&def, known));
    const bool timed =
        dip_paired_timing_run(&def, &calls, report->threads, pairs, &report->machine, err);
    dip_progress_end(&t->progress, t->drawn);
    return timed && count_known_rounds(t, err);
}

bool dip_cost_time_rows(DipCostContext *cost, DipError *err) {
    DipCostReport *report = cost->report;
    const size_t frames = (size_t)dip_cost_frame_count(report);
    const size_t values = (size_t)report->row_count * frames;
    RowTiming t = {.cost = cost, .counted = calloc(values, sizeof *t.counted)};
    int *base_of = list_bases(report);
    DipTimePair *pairs = calloc(values, sizeof *pairs);
    bool done = (t.counted && base_of && pairs) || out_of_memory(err);
    done = done && run_timing(cost, &t, base_of, pairs, err);
    for (int r = 0; done && r < report->row_count; r++) {
        memcpy(report->rows[r].pairs, pairs + (size_t)r * frames, frames * sizeof *pairs);
    }
    if (done) {
        report->rounds = report->options.rounds;
        done = dip_cost_estimate_times(report, err);
    }
    free(t.counted);
    free(base_of);
    free(pairs);
    return done;
}

// --- some rows again ---------------------------------------------------------------------------

typedef struct AgainTiming {
    DipCostContext *cost;
    const int *rows; // [subject]
    DipFrame frame;  // The frame of the latest run.
} AgainTiming;

static bool draw_again(void *context, const DipTimingTurn *turn, DipError *err) {
    AgainTiming *t = context;
    return dip_cost_draw_timed(t->cost, t->rows[turn->subject], turn->frame, &t->frame, err);
}

static void stage_ms_again(void *context, double ms[DIP_TIME_PARTS]) {
    const AgainTiming *t = context;
    write_stage_ms(&t->frame, ms);
}

static bool after_draw_again(void *context, const DipTimingTurn *turn, double ms, DipError *err) {
    (void)turn;
    (void)ms;
    const AgainTiming *t = context;
    return !dip_cost_interrupted(t->cost, err);
}

// Joins a new pair to the one before. If both are good, their ratios' geometric mean is kept: the
// row's and the baseline's times are each the geometric mean of two.
static void join_pair(DipTimePair *pair, const DipTimePair *again, int before) {
    if (dip_time_pair_is_disturbed(again)) {
        return;
    }
    if (dip_time_pair_is_disturbed(pair)) {
        *pair = *again;
        return;
    }
    const double share = 1.0 / (before + 1.0);
    pair->ms = pow(pair->ms, 1.0 - share) * pow(again->ms, share);
    pair->base_ms = pow(pair->base_ms, 1.0 - share) * pow(again->base_ms, share);
}

bool dip_cost_time_again(DipCostContext *cost, const int *rows, int count, int times_before,
                         DipError *err) {
    DipCostReport *report = cost->report;
    const size_t frames = (size_t)dip_cost_frame_count(report);
    int *subjects = malloc(2 * ((size_t)count + 1) * sizeof *subjects);
    DipTimePair *pairs = calloc(((size_t)count + 1) * frames, sizeof *pairs);
    bool done = (subjects && pairs) || out_of_memory(err);
    if (done) {
        int *base_of = subjects + count + 1; // All 0: the baseline is subject 0.
        memset(base_of, 0, ((size_t)count + 1) * sizeof *base_of);
        subjects[0] = report->base_rows[0];
        memcpy(subjects + 1, rows, (size_t)count * sizeof *rows);
        const DipPairedTimingDef def = {
            .subject_count = count + 1,
            .base_of = base_of,
            .block_subjects = 1,
            .rounds = report->options.rounds,
            .frames_per_round = report->options.timed_frames,
            .seed = (uint64_t)report->options.seed + (uint64_t)times_before,
        };
        AgainTiming t = {.cost = cost, .rows = subjects};
        const DipPairedTimingCalls calls = {
            .run = draw_again,
            .after_run = after_draw_again,
            .part_ms = stage_ms_again,
            .context = &t,
        };
        DipPairedTimingResult result;
        done = dip_paired_timing_run(&def, &calls, report->threads, pairs, &result, err);
    }
    for (int i = 0; done && i < count; i++) {
        for (size_t f = 0; f < frames; f++) {
            join_pair(&report->rows[rows[i]].pairs[f], &pairs[(size_t)(i + 1) * frames + f],
                      times_before);
        }
    }
    free(subjects);
    free(pairs);
    return done;
}
