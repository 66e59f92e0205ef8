// Timing every row beside the baseline of its path, and counting its work. Counters are the same
// in every run of a frame, so each frame is counted once.
#include "app/cli/drive.h"
#include "app/cli/interrupt.h"
#include "app/cost/starts.h"
#include "app/cost/steps.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Rows per block besides the baseline. Blocks of 4 halve the deviation of ratios against one
// baseline per round, at the same cost.
enum { BLOCK_ROWS = 4 };

// A start may take this share of the time of its rounds.
static const double most_start = 0.1;

// A measurement of some rows of the report.
typedef struct RowTiming {
    DipCostContext *cost;
    const int *rows;    // [subject]
    const int *base_of; // [subject]
    int count;          // Subjects.
    bool *counted;      // [subject * frames + frame]: the frame's counters are in the row's sums.
    DipChild *child;    // The start that draws; NULL: this process does.
} RowTiming;

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
}

// --- counters ----------------------------------------------------------------------------------

// Adds a frame's counters to the row's sums. The sums are whole numbers, so that they do not depend
// on the order of the frames: an interrupted run has another order.
static void count_work(const RowTiming *t, int subject, int frame, const DipCounters *counters) {
    DipCostReport *report = t->cost->report;
    bool *counted = &t->counted[subject * dip_cost_frame_count(report) + frame];
    double *value = report->rows[t->rows[subject]].counters;
    if (!*counted) {
#define ADD_COUNTER(name, text) *value++ += (double)counters->name;
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
static bool count_known_rounds(const RowTiming *t, DipError *err) {
    const int frames = dip_cost_frame_count(t->cost->report);
    DipFrame drawn;
    for (int i = 0; i < t->count * frames; i++) {
        if (t->counted[i]) {
            continue;
        }
        if (dip_cost_interrupted(t->cost, err) ||
            !dip_cost_draw_timed(t->cost, t->rows[i / frames], i % frames, &drawn, err)) {
            return false;
        }
        count_work(t, i / frames, i % frames, &drawn.counters);
    }
    return true;
}

// --- drawing -------------------------------------------------------------------------------------

static bool draw(void *context, const DipDriverTurn *turn, DipTimed *timed, DipError *err) {
    const RowTiming *t = context;
    const int row = t->rows[turn->subject];
    DipFrame frame;
    if (t->child) {
        if (!dip_cost_start_draw(t->child, &t->cost->report->rows[row], turn->frame,
                                 &frame.counters, timed, err)) {
            return false;
        }
    } else {
        if (!dip_cost_draw_timed(t->cost, row, turn->frame, &frame, err)) {
            return false;
        }
        dip_cost_stage_parts(&frame, timed->parts_ms);
    }
    count_work(t, turn->subject, turn->frame, &frame.counters);
    return true;
}

static bool start(void *context, int index, DipError *err) {
    RowTiming *t = context;
    (void)index;
    dip_child_stop(&t->child, dip_interrupted());
    t->child = dip_cost_start(t->cost, err);
    return t->child != NULL;
}

static bool keep_round(void *context, const DipTimed *timed, int count, DipError *err) {
    const RowTiming *t = context;
    return dip_cost_journal_add_round(t->cost->journal, t->cost->report->options.seed, timed, count,
                                      err);
}

// Hands the rounds of the journal to the driver. It skips those that are not the next.
static bool resume(const RowTiming *t, DipDriver *driver, DipError *err) {
    const DipCostJournal *journal = t->cost->journal;
    const int seed = t->cost->report->options.seed;
    for (int i = 0; i < dip_cost_journal_round_count(journal); i++) {
        int count;
        DipTimed *timed = dip_cost_journal_round(journal, i, seed, &count);
        if (!timed) {
            return out_of_memory(err);
        }
        dip_driver_resume(driver, timed, count);
        free(timed);
    }
    return true;
}

// Times the subjects in the report's starts. With `keep`, the journal and the report get
// everything.
static bool drive(RowTiming *t, DipDriverDef *def, bool keep, const char *progress, DipError *err) {
    DipCostReport *report = t->cost->report;
    const bool starts = report->options.starts > 1 && t->cost->argv;
    const DipDriverCalls calls = {
        .draw = draw,
        .start = starts ? start : NULL,
        .keep = keep ? keep_round : NULL,
        .context = t,
    };
    def->starts = starts ? report->options.starts : 1;
    def->rounds = report->options.rounds / def->starts;
    def->most_start = keep ? most_start : 0.0;
    DipDriver *driver = dip_driver_create(def, &calls, err);
    bool done = driver && (!keep || resume(t, driver, err)) &&
                dip_drive(driver, progress, "cost", DIP_COST_INTERRUPTED, err);
    if (done) {
        const DipTimes times = dip_driver_times(driver);
        done = dip_cost_log_add(report, &times, t->rows, err);
        if (keep) {
            report->machine = dip_driver_machine(driver, report->threads);
            report->options.starts = times.starts;
        }
    }
    dip_child_stop(&t->child, dip_interrupted());
    dip_driver_destroy(&driver);
    return done && count_known_rounds(t, err);
}

static bool open_timing(RowTiming *t, DipError *err) {
    const size_t values = (size_t)t->count * (size_t)dip_cost_frame_count(t->cost->report);
    t->counted = calloc(values, sizeof *t->counted);
    return t->counted || out_of_memory(err);
}

// --- all rows ------------------------------------------------------------------------------------

bool dip_cost_time_rows(DipCostContext *cost, DipError *err) {
    DipCostReport *report = cost->report;
    int *rows = malloc(2 * (size_t)report->row_count * sizeof *rows);
    RowTiming t = {.cost = cost, .rows = rows, .count = report->row_count};
    for (int r = 0; rows && r < report->row_count; r++) {
        rows[r] = r;
        rows[report->row_count + r] = report->base_rows[report->rows[r].path];
    }
    if (!report->options.has_seed) {
        dip_cost_journal_seed(cost->journal, &report->options.seed);
    }
    DipDriverDef def = dip_cost_driver_def(report, report->row_count, BLOCK_ROWS);
    def.base_of = rows ? rows + report->row_count : NULL;
    def.settle = true;
    dip_cost_log_clear(report);
    bool done = (rows || out_of_memory(err)) && open_timing(&t, err) &&
                drive(&t, &def, true, "frames timed", err);
    for (int r = 0; done && r < report->row_count; r++) {
        average_work(report, r);
    }
    if (done) {
        report->rounds = report->options.rounds;
        done = dip_cost_estimate_times(report, err);
    }
    free(t.counted);
    free(rows);
    return done;
}

// --- some rows of path 0 -------------------------------------------------------------------------

// Times the rows beside the baseline in as many rounds as dip_cost_time_rows. Subject 0 is the
// baseline; subject i is rows[i - 1]. `counts`: the rows' work is not counted yet.
static bool time_some(RowTiming *t, DipCostContext *cost, const int *rows, int count,
                      int block_rows, uint64_t seed, bool counts, DipError *err) {
    const DipCostReport *report = cost->report;
    const size_t frames = (size_t)dip_cost_frame_count(report);
    int *subjects = malloc(((size_t)count + 1) * sizeof *subjects);
    int *base_of = calloc((size_t)count + 1, sizeof *base_of);
    *t = (RowTiming){.cost = cost, .rows = subjects, .count = count + 1};
    bool done = ((subjects && base_of) || out_of_memory(err)) && open_timing(t, err);
    if (done) {
        subjects[0] = report->base_rows[0];
        memcpy(subjects + 1, rows, (size_t)count * sizeof *rows);
        memset(t->counted, true, counts ? frames : (size_t)t->count * frames);
        DipDriverDef def = dip_cost_driver_def(report, t->count, block_rows);
        def.base_of = base_of;
        def.seed = seed;
        done = drive(t, &def, false, "frames timed for the advice", err);
    }
    free(subjects);
    free(base_of);
    return done;
}

bool dip_cost_time_again(DipCostContext *cost, const int *rows, int count, int times_before,
                         DipError *err) {
    RowTiming t;
    const uint64_t seed = (uint64_t)cost->report->options.seed + (uint64_t)times_before;
    // One row per block: two rows that are compared with a budget get a baseline each.
    const bool done = time_some(&t, cost, rows, count, 1, seed, false, err);
    free(t.counted);
    return done;
}

bool dip_cost_time_added(DipCostContext *cost, const int *rows, int count, DipError *err) {
    DipCostReport *report = cost->report;
    RowTiming t;
    const uint64_t seed = (uint64_t)report->options.seed + UINT64_C(0x10000) + (uint64_t)rows[0];
    const bool done = time_some(&t, cost, rows, count, BLOCK_ROWS, seed, true, err);
    for (int i = 0; done && i < count; i++) {
        average_work(report, rows[i]);
    }
    free(t.counted);
    return done;
}
