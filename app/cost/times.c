// Timing rows beside the baseline of their paths, here or elsewhere, and counting their work.
// Counters are the same in every run of a frame, so each frame is counted once.
#include "app/cli/drive.h"
#include "app/cli/progress.h"
#include "app/cost/starts.h"
#include "app/cost/steps.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    BASE_COPIES = 3,  // Rounds that draw a frame of the baseline: slow frames or slow moments?
    BLOCK_ROWS = 4,   // Halves the deviation of ratios against one baseline per round, at its cost.
    LEAST_SIDE = 64,  // Pixels; smaller pictures have no half size.
    SEED_SALT = 0x517 // The order elsewhere is another than that of the report's rows.
};

// A start may take this share of the time of its rounds.
static const double most_start = 0.1;

// What is timed: settings on a path of a context's report.
typedef struct Subject {
    DipCostContext *cost;
    const DipQuality *quality;
    int path;
    double *counters; // Sums over the frames, then means; NULL: they are known.
} Subject;

// A measurement. The bases are subjects, too.
typedef struct Timing {
    DipCostContext *cost;
    int count;
    Subject *subjects;
    int *rows;     // Rows of the subjects in the report's log.
    int *base_of;  // [subject]
    bool *counted; // [subject * frames + frame]: the frame's counters are in the sums.
    DipDriverMachine machine;
    DipTimesFit *fit; // Of subjects elsewhere.
    DipChild *child;  // The start that draws; NULL: this process does.
} Timing;

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
}

static void close_timing(Timing *t) {
    dip_times_fit_free(&t->fit);
    free(t->subjects);
    free(t->rows);
    free(t->base_of);
    free(t->counted);
}

// Begins a measurement. All subjects are the baseline of path 0, and subject 0 is their base.
static bool open_timing(Timing *t, DipCostContext *cost, int count, DipError *err) {
    const DipCostReport *report = cost->report;
    const size_t size = (size_t)count, values = size * (size_t)dip_cost_frame_count(report);
    *t = (Timing){.cost = cost, .count = count};
    t->subjects = calloc(size, sizeof *t->subjects);
    t->rows = calloc(size, sizeof *t->rows);
    t->base_of = calloc(size, sizeof *t->base_of);
    t->counted = calloc(values, sizeof *t->counted);
    if (!t->subjects || !t->rows || !t->base_of || !t->counted) {
        close_timing(t);
        return out_of_memory(err);
    }
    for (int s = 0; s < count; s++) {
        t->rows[s] = report->base_rows[0];
        t->subjects[s] = (Subject){cost, &report->rows[t->rows[s]].quality, 0, NULL};
    }
    return true;
}

// Makes the subject a row of the report, whose work is counted unless it is known.
static void set_row(Timing *t, int subject, int row, bool counts) {
    DipCostRow *timed = &t->cost->report->rows[row];
    t->rows[subject] = row;
    t->subjects[subject] =
        (Subject){t->cost, &timed->quality, timed->path, counts ? timed->counters : NULL};
}

// --- drawing -------------------------------------------------------------------------------------

static void count_work(const Timing *t, int subject, int frame, const DipCounters *counters) {
    bool *counted = &t->counted[subject * dip_cost_frame_count(t->cost->report) + frame];
    if (t->subjects[subject].counters && !*counted) {
        dip_counters_add(counters, t->subjects[subject].counters);
        *counted = true;
    }
}

// Makes means of the sums of count_work. Draws the frames of rounds that the journal had, since the
// journal has no counters.
static bool average_work(const Timing *t, DipError *err) {
    const int frames = dip_cost_frame_count(t->cost->report);
    for (int s = 0; s < t->count; s++) {
        const Subject *subject = &t->subjects[s];
        for (int f = 0; subject->counters && f < frames; f++) {
            DipFrame drawn;
            if (t->counted[s * frames + f]) {
                continue;
            }
            if (dip_cost_interrupted(err) || !dip_cost_draw_timed(subject->cost, subject->quality,
                                                                  subject->path, f, &drawn, err)) {
                return false;
            }
            count_work(t, s, f, &drawn.counters);
        }
        for (int c = 0; subject->counters && c < DIP_COUNTER_COUNT; c++) {
            subject->counters[c] /= frames;
        }
    }
    return true;
}

_Static_assert((int)DIP_COST_STAGE_rest == (int)DIP_TIMED_PARTS, "each stage is a part");

static bool draw(void *context, const DipDriverTurn *turn, DipTimed *timed, DipError *err) {
    const Timing *t = context;
    const Subject *s = &t->subjects[turn->subject];
    DipFrame frame;
    if (t->child) {
        if (!dip_cost_start_draw(t->child, s->quality, s->path, turn->frame, &frame.counters, timed,
                                 err)) {
            return false;
        }
    } else {
        if (!dip_cost_draw_timed(s->cost, s->quality, s->path, turn->frame, &frame, err)) {
            return false;
        }
        dip_cost_stage_parts(&frame, timed->parts_ms);
    }
    count_work(t, turn->subject, turn->frame, &frame.counters);
    return true;
}

static bool start(void *context, int index, DipError *err) {
    Timing *t = context;
    (void)index;
    dip_child_stop(&t->child, dip_interrupted());
    t->child = dip_cost_start(t->cost, err);
    return t->child != NULL;
}

static bool keep_round(void *context, const DipTimed *timed, int count, DipError *err) {
    const Timing *t = context;
    return dip_cost_journal_add_round(t->cost->journal, t->cost->report->options.seed, timed, count,
                                      err);
}

// Hands the rounds of the journal to the driver. It skips those that are not the next.
static bool resume(const Timing *t, DipDriver *driver, DipError *err) {
    const DipCostJournal *journal = t->cost->journal;
    const int rounds = dip_cost_journal_round_count(journal);
    const int seed = t->cost->report->options.seed;
    for (int i = 0; i < rounds; i++) {
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

typedef enum Where {
    KEPT,     // In the report's starts; the journal keeps everything.
    HERE,     // In the report's starts.
    ELSEWHERE // In this process; the report's log does not get the times.
} Where;

// Times the subjects.
static bool drive(Timing *t, Where where, int block_rows, uint64_t seed, const char *progress,
                  DipError *err) {
    DipCostReport *report = t->cost->report;
    const bool starts = report->options.starts > 1 && t->cost->start && where != ELSEWHERE;
    const DipDriverCalls calls = {
        .draw = draw,
        .start = starts ? start : NULL,
        .keep = where == KEPT ? keep_round : NULL,
        .context = t,
    };
    const int rounds = report->options.rounds;
    const DipDriverDef def = {
        .subjects = t->count,
        .base_of = t->base_of,
        .block_subjects = block_rows,
        .starts = starts ? report->options.starts : 1,
        .rounds = starts ? rounds / report->options.starts : rounds,
        .frames = dip_cost_frame_count(report),
        .base_copies = rounds < BASE_COPIES ? rounds : BASE_COPIES,
        .warm_frames = 1,
        .seed = seed,
        .settle = where == KEPT,
        .most_wait = DIP_TIMED_MOST_WAIT,
        .most_start = where == KEPT ? most_start : 0.0,
    };
    DipDriver *driver = dip_driver_create(&def, &calls, err);
    bool done = driver && (where != KEPT || resume(t, driver, err)) &&
                dip_drive(driver, progress, "cost", DIP_COST_INTERRUPTED, err);
    if (done) {
        const DipTimes times = dip_driver_times(driver);
        t->machine = dip_driver_machine(driver, report->threads);
        if (where == ELSEWHERE) {
            t->fit = dip_times_fit(&times, err);
            done = t->fit != NULL;
        } else {
            done = dip_cost_log_add(report, &times, t->rows, err);
        }
        if (where == KEPT) {
            report->machine = t->machine;
            report->options.starts = times.starts;
        }
    }
    dip_child_stop(&t->child, dip_interrupted());
    dip_driver_destroy(&driver);
    return done && average_work(t, err);
}

// --- rows ----------------------------------------------------------------------------------------

bool dip_cost_time_rows(DipCostContext *cost, DipError *err) {
    DipCostReport *report = cost->report;
    Timing t;
    if (!open_timing(&t, cost, report->row_count, err)) {
        return false;
    }
    for (int r = 0; r < report->row_count; r++) {
        set_row(&t, r, r, true);
        t.base_of[r] = report->base_rows[report->rows[r].path];
    }
    if (!report->options.has_seed) {
        dip_cost_journal_seed(cost->journal, &report->options.seed);
    }
    dip_cost_log_clear(report);
    bool done = drive(&t, KEPT, BLOCK_ROWS, (uint64_t)report->options.seed, "frames timed", err);
    close_timing(&t);
    if (done) {
        report->rounds = report->options.rounds;
        done = dip_cost_estimate_times(report, err);
    }
    return done;
}

// Times rows of path 0 beside the baseline in as many rounds as dip_cost_time_rows. `counts`: their
// work is not counted yet.
static bool time_some(DipCostContext *cost, const int *rows, int count, int block_rows,
                      uint64_t seed, bool counts, DipError *err) {
    Timing t;
    if (!open_timing(&t, cost, count + 1, err)) {
        return false;
    }
    for (int i = 0; i < count; i++) {
        set_row(&t, i + 1, rows[i], counts);
    }
    const bool done = drive(&t, HERE, block_rows, (uint64_t)cost->report->options.seed + seed,
                            "frames timed for the advice", err);
    close_timing(&t);
    return done;
}

bool dip_cost_time_again(DipCostContext *cost, const int *rows, int count, int times_before,
                         DipError *err) {
    // One row per block: two rows that are compared with a budget get a baseline each.
    return time_some(cost, rows, count, 1, (uint64_t)times_before, false, err);
}

bool dip_cost_time_added(DipCostContext *cost, const int *rows, int count, DipError *err) {
    const uint64_t seed = UINT64_C(0x10000) + (uint64_t)rows[0];
    return time_some(cost, rows, count, BLOCK_ROWS, seed, true, err);
}

// --- elsewhere -----------------------------------------------------------------------------------

void dip_cost_elsewhere_begin(DipCostReport *there, const DipCostReport *report, int width,
                              int height, const char *path) {
    *there = (DipCostReport){
        .options = report->options, .path_count = 1, .width = width, .height = height};
    memcpy(there->scene_hash, report->scene_hash, sizeof there->scene_hash);
    snprintf(there->paths[0], sizeof there->paths[0], "%s", path);
}

bool dip_cost_time_elsewhere(DipCostContext *cost, DipCostContext *there, DipCostElsewhere *rows,
                             int count, const char *progress, DipDriverMachine *machine,
                             DipError *err) {
    Timing t;
    if (!open_timing(&t, cost, count + 1, err)) {
        return false;
    }
    for (int i = 0; i < count; i++) {
        rows[i] = (DipCostElsewhere){.quality = rows[i].quality};
        t.subjects[i + 1] = (Subject){there, &rows[i].quality, 0, rows[i].counters};
    }
    const bool done = drive(&t, ELSEWHERE, BLOCK_ROWS,
                            (uint64_t)cost->report->options.seed ^ SEED_SALT, progress, err);
    for (int i = 0; done && i < count; i++) {
        dip_cost_estimate_elsewhere(cost->report, t.fit, i + 1, &rows[i]);
    }
    *machine = t.machine;
    close_timing(&t);
    return done;
}

// --- half the size -------------------------------------------------------------------------------

// The settings that stand for edges, for textures and for both.
static void list_smaller(DipCostReport *report) {
    static const struct {
        uint8_t aa, aaa, af; // Steps; 0: as in the baseline.
    } steps[DIP_COST_MAX_SMALLER] = {{0, 0, 0}, {2, 0, 0}, {0, 0, 4}, {4, 1, 4}};
    for (int i = 0; i < DIP_COST_MAX_SMALLER; i++) {
        DipQuality quality = report->options.baseline;
        if (steps[i].aa) {
            quality.step[DIP_SETTING_AA] = steps[i].aa;
            quality.step[DIP_SETTING_AAA] = steps[i].aaa;
            quality.step[DIP_SETTING_ASD] = 0;
        }
        if (steps[i].af) {
            quality.step[DIP_SETTING_AF] = steps[i].af;
        }
        if (dip_quality_check(&quality, NULL)) {
            report->smaller[report->smaller_count++].quality = quality;
        }
    }
}

bool dip_cost_time_smaller(DipCostContext *cost, DipError *err) {
    DipCostReport *report = cost->report;
    DipCostReport there;
    DipCostContext context;
    if (report->width < LEAST_SIDE || report->height < LEAST_SIDE) {
        return true;
    }
    report->smaller_width = (report->width + 1) / 2;
    report->smaller_height = (report->height + 1) / 2;
    dip_cost_elsewhere_begin(&there, report, report->smaller_width, report->smaller_height,
                             report->paths[0]);
    if (!dip_cost_context_open(&context, cost->session, &there, NULL, NULL, false, err)) {
        return false;
    }
    list_smaller(report);
    DipDriverMachine machine;
    const bool done =
        dip_cost_time_elsewhere(cost, &context, report->smaller, report->smaller_count,
                                "smaller frames timed", &machine, err);
    dip_cost_context_close(&context);
    return done;
}
