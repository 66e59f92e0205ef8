// Timing every row beside the baseline of its path, and counting its work. Counters are the same
// in every run of a frame, so each frame is counted once.
#include "app/cost/steps.h"
#include "app/measure/timing/paired_timing.h"
#include "app/cli/progress.h"

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
    bool again; // Rounds with disturbed frames are being timed again.
} RowTiming;

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
}

// --- counters ----------------------------------------------------------------------------------

// Adds a frame's counters to the row's sums. The sums are whole numbers, so that they do not depend
// on the order of the frames: an interrupted run has another order.
static void count_work(RowTiming *t, int row, int frame) {
    DipCostReport *report = t->cost->report;
    const int frames = dip_cost_frame_count(report);
    bool *counted = &t->counted[(size_t)row * (size_t)frames + (size_t)frame];
    double *value = report->rows[row].counters;
    if (!*counted) {
#define ADD_COUNTER(name, text) *value++ += (double)t->frame.counters.name;
        DIP_COUNTER_LIST(ADD_COUNTER)
#undef ADD_COUNTER
        *counted = true;
    }
}

// Makes means over the timed frames of the sums of count_work.
static void average_work(DipCostReport *report, int row) {
    for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
        report->rows[row].counters[c] /= dip_cost_frame_count(report);
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

// The frames until times are steady are not known in advance, so the progress does not include
// them. Of the rounds that have disturbed frames, these are timed again, with a progress of their
// own.
static void show_round(RowTiming *t, const DipTimingTurn *turn) {
    const int rounds = t->cost->report->options.rounds;
    if (turn->round < rounds) {
        t->drawn += turn->phase != DIP_TIMING_SETTLE;
        return;
    }
    if (!t->again) {
        t->again = true;
        dip_progress_end(&t->progress, t->drawn);
        t->progress =
            dip_progress_begin("rounds searched for disturbed frames to time again", rounds);
    }
    t->drawn = turn->round - rounds;
}

static bool after_draw(void *context, const DipTimingTurn *turn, double ms, DipError *err) {
    (void)ms;
    RowTiming *t = context;
    count_work(t, turn->subject, turn->frame);
    show_round(t, turn);
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
        average_work(report, r);
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

// --- some rows of path 0 -------------------------------------------------------------------------

// Subject 0 is the baseline; subject i is rows[i - 1].
typedef struct SomeTiming {
    RowTiming rows_timing; // Its counted rows and its frame.
    const int *rows;
    DipTimePair *pairs;
    bool counts; // The runs count the rows' work.
} SomeTiming;

static int row_of(const SomeTiming *t, int subject) {
    return subject == 0 ? t->rows_timing.cost->report->base_rows[0] : t->rows[subject - 1];
}

static bool draw_some(void *context, const DipTimingTurn *turn, DipError *err) {
    SomeTiming *t = context;
    return dip_cost_draw_timed(t->rows_timing.cost, row_of(t, turn->subject), turn->frame,
                               &t->rows_timing.frame, err);
}

static bool after_draw_some(void *context, const DipTimingTurn *turn, double ms, DipError *err) {
    (void)ms;
    SomeTiming *t = context;
    if (t->counts && turn->subject > 0) {
        count_work(&t->rows_timing, row_of(t, turn->subject), turn->frame);
    }
    return !dip_cost_interrupted(t->rows_timing.cost, err);
}

static void some_stage_ms(void *context, double ms[DIP_TIME_PARTS]) {
    const SomeTiming *t = context;
    write_stage_ms(&t->rows_timing.frame, ms);
}

// Times the rows beside the baseline in as many rounds as dip_cost_time_rows. The pairs of row i
// begin at pairs[(i + 1) * frames].
static bool time_some(SomeTiming *t, int count, int block_rows, uint64_t seed, DipError *err) {
    const DipCostReport *report = t->rows_timing.cost->report;
    int *base_of = calloc((size_t)count + 1, sizeof *base_of); // The baseline is subject 0.
    const DipPairedTimingDef def = {
        .subject_count = count + 1,
        .base_of = base_of,
        .block_subjects = block_rows,
        .rounds = report->options.rounds,
        .frames_per_round = report->options.timed_frames,
        .seed = seed,
    };
    const DipPairedTimingCalls calls = {
        .run = draw_some,
        .after_run = after_draw_some,
        .part_ms = some_stage_ms,
        .context = t,
    };
    DipPairedTimingResult result;
    const bool done =
        base_of ? dip_paired_timing_run(&def, &calls, report->threads, t->pairs, &result, err)
                : out_of_memory(err);
    free(base_of);
    return done;
}

static bool open_some(SomeTiming *t, DipCostContext *cost, const int *rows, int count, bool counts,
                      DipError *err) {
    const size_t frames = (size_t)dip_cost_frame_count(cost->report);
    *t = (SomeTiming){.rows_timing = {.cost = cost}, .rows = rows, .counts = counts};
    t->pairs = calloc(((size_t)count + 1) * frames, sizeof *t->pairs);
    t->rows_timing.counted =
        calloc((size_t)cost->report->row_count * frames, sizeof *t->rows_timing.counted);
    return (t->pairs && t->rows_timing.counted) || out_of_memory(err);
}

static void close_some(SomeTiming *t) {
    free(t->pairs);
    free(t->rows_timing.counted);
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
    SomeTiming t;
    const uint64_t seed = (uint64_t)report->options.seed + (uint64_t)times_before;
    // One row per block: two rows that are compared with a budget get a baseline each.
    const bool done =
        open_some(&t, cost, rows, count, false, err) && time_some(&t, count, 1, seed, err);
    for (int i = 0; done && i < count; i++) {
        for (size_t f = 0; f < frames; f++) {
            join_pair(&report->rows[rows[i]].pairs[f], &t.pairs[(size_t)(i + 1) * frames + f],
                      times_before);
        }
    }
    close_some(&t);
    return done;
}

bool dip_cost_time_added(DipCostContext *cost, const int *rows, int count, DipError *err) {
    DipCostReport *report = cost->report;
    const size_t frames = (size_t)dip_cost_frame_count(report);
    SomeTiming t;
    const uint64_t seed = (uint64_t)report->options.seed + UINT64_C(0x10000) + (uint64_t)rows[0];
    const bool done =
        open_some(&t, cost, rows, count, true, err) && time_some(&t, count, BLOCK_ROWS, seed, err);
    for (int i = 0; done && i < count; i++) {
        memcpy(report->rows[rows[i]].pairs, t.pairs + (size_t)(i + 1) * frames,
               frames * sizeof *t.pairs);
        average_work(report, rows[i]);
    }
    close_some(&t);
    return done;
}
