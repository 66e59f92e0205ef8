// Times rows, each beside the baseline of its path. Times combinations at another size, on another
// path or with other threads. Counts the work of both. The counters are the same whenever a frame
// is drawn, so the work of each frame is counted once.
//
// To time rows, unless --starts is 1, the program starts itself several times with --serve, one
// process after another, and asks each for the frames to time. Times differ from process to
// process, since chance decides where a process has its memory and which cores its threads get.
#include "app/cli/program_file.h"
#include "app/cli/progress.h"
#include "app/cost/steps.h"
#include "app/measure/timing/child.h"
#include "app/measure/timing/processors.h"
#include "renderer/base/clock.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    BASE_COPIES = 3, // Number of rounds in which each frame of the baseline is timed. More than one
                     // round tells slow frames from slow moments.
    BLOCK_ROWS = 4,  // Greatest number of rows that share one drawing of the baseline. If all rows
                     // of a round shared one drawing, ratios would deviate twice as much.
    LEAST_SIDE = 64, // If the pictures' width or height is below this number of pixels, nothing is
                     // timed at half their size.
    REQUEST_SIZE = 512,
    SEED_SALT = 0x517 // Mixed into the seed of dip_cost_time_elsewhere, for another order of
                      // frames than that of the report's rows.
};

// If the start of the first process takes longer than this share of the time of its rounds, only
// two processes are started (if the number of all rounds is even, driver.h).
static const double most_start = 0.1;

// A subject of the driver (driver.h): settings on a camera path of a context's report.
typedef struct Subject {
    DipCostContext *cost;
    const DipQuality *quality;
    int path;
    double *counters; // Sums over the frames, and means at the end. NULL if the work need not be
                      // counted, because it is known already.
} Subject;

// A measurement. Each subject is timed beside another subject, its base.
typedef struct Timing {
    DipCostContext *cost;
    int count;
    Subject *subjects;
    int *rows;     // [subject]: index of its row in the report. dip_cost_time_elsewhere ignores it.
    int *base_of;  // [subject]: index of the subject that is its base.
    bool *counted; // [subject * frames + frame]: whether the frame's counters are in the sums.
    DipDriverMachine machine;
    DipTimesFit *fit; // Times of the subjects of dip_cost_time_elsewhere, otherwise NULL.
    DipChild *child;  // The process that draws; NULL if this process draws.
    bool kept;        // True if the times are stored in the journal.
} Timing;

static void close_timing(Timing *t) {
    dip_times_fit_free(&t->fit);
    free(t->subjects);
    free(t->rows);
    free(t->base_of);
    free(t->counted);
}

// Begins a measurement. All subjects are the baseline of path 0 until the caller changes them, and
// subject 0 is the base of all.
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
        return dip_cost_out_of_memory(err);
    }
    for (int s = 0; s < count; s++) {
        t->rows[s] = report->base_rows[0];
        t->subjects[s] = (Subject){cost, &report->rows[t->rows[s]].quality, 0, NULL};
    }
    return true;
}

// Makes the subject a row of the report. `counts` is true if the row's work must be counted.
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

// First draws the frames whose times came from the journal and counts their work, since the journal
// has no counters. Then turns the sums of count_work into means over the frames.
static bool average_work(const Timing *t, DipError *err) {
    const int frames = dip_cost_frame_count(t->cost->report);
    for (int s = 0; s < t->count; s++) {
        const Subject *subject = &t->subjects[s];
        for (int f = 0; subject->counters && f < frames; f++) {
            DipFrame drawn;
            if (t->counted[s * frames + f]) {
                continue;
            }
            if (dip_cost_interrupted(subject->cost, err) ||
                !dip_cost_prepare_timed(subject->cost, subject->quality, subject->path, f, err) ||
                !dip_cost_draw_timed(subject->cost, subject->quality, subject->path, f, &drawn,
                                     err)) {
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

// Asks the process t->child for a timed frame of a path, by a request of the form
// "draw PATH FRAME SETTINGS". Writes the frame's counters and its times.
static bool draw_in_child(const Timing *t, const Subject *s, int frame, DipCounters *counters,
                          DipTimed *timed, DipError *err) {
    char settings[REQUEST_SIZE - 64], request[REQUEST_SIZE];
    DipBenchSample sample;
    dip_quality_format(s->quality, settings, sizeof settings);
    snprintf(request, sizeof request, "draw %d %d %s", s->path, frame, settings);
    if (!dip_child_draw(t->child, request, &sample, timed, err)) {
        return false;
    }
    *counters = sample.counters;
    return true;
}

// Prepares a frame if this process draws it. Another process prepares its frames itself.
static bool prepare(void *context, const DipDriverTurn *turn, DipError *err) {
    const Timing *t = context;
    const Subject *s = &t->subjects[turn->subject];
    return t->child || dip_cost_prepare_timed(s->cost, s->quality, s->path, turn->frame, err);
}

static bool draw(void *context, const DipDriverTurn *turn, DipTimed *timed, DipError *err) {
    const Timing *t = context;
    const Subject *s = &t->subjects[turn->subject];
    DipFrame frame;
    if (t->child) {
        if (!draw_in_child(t, s, turn->frame, &frame.counters, timed, err)) {
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

// Ends the process that draws, if there is one, and starts another one with the command line of
// this process.
static bool start(void *context, int index, DipError *err) {
    Timing *t = context;
    const DipChildDef def = {
        .program = dip_program_file(),
        .argv = t->cost->start->argv,
        .argc = t->cost->start->argc,
        .what = "cost",
        .count = t->cost->report->path_count,
        .frames = dip_cost_frame_count(t->cost->report),
        .key = "--starts",
    };
    (void)index;
    dip_child_stop(&t->child, dip_interrupted());
    t->child = dip_child_start(&def, err);
    if (t->child) {
        dip_child_confine(t->child, t->cost->report->threads);
    }
    return t->child != NULL;
}

static bool keep_round(void *context, const DipTimed *timed, int count, DipError *err) {
    const Timing *t = context;
    dip_cost_look_at_times(t->cost, timed, count);
    return !t->kept || dip_cost_journal_add_round(t->cost->journal, t->cost->report->options.seed,
                                                  timed, count, err);
}

// Gives the rounds of the journal to the driver. The driver refuses a round that is not complete or
// does not follow the one before.
static bool resume(const Timing *t, DipDriver *driver, DipError *err) {
    const DipCostJournal *journal = t->cost->journal;
    const int rounds = dip_cost_journal_round_count(journal, NULL);
    const int seed = t->cost->report->options.seed;
    for (int i = 0; i < rounds; i++) {
        int count;
        DipTimed *timed = dip_cost_journal_round(journal, i, seed, &count);
        if (!timed) {
            return dip_cost_out_of_memory(err);
        }
        dip_driver_resume(driver, timed, count);
        free(timed);
    }
    return true;
}

// Which processes draw the frames, and where the times are stored. The processes that --starts asks
// for are started by this one; with --starts 1, this process draws.
typedef enum Where {
    KEPT,     // The processes of --starts draw. Times go to the journal and to the report's log.
    HERE,     // The processes of --starts draw. Times go to the report's log only.
    ELSEWHERE // This process draws. Times go to t->fit only.
} Where;

// Times the subjects and counts their work.
static bool drive(Timing *t, Where where, int block_rows, uint64_t seed, const char *progress,
                  DipError *err) {
    DipCostReport *report = t->cost->report;
    t->kept = where == KEPT;
    const bool starts = report->options.starts > 1 && t->cost->start && where != ELSEWHERE;
    const DipDriverCalls calls = {
        .prepare = prepare,
        .draw = draw,
        .start = starts ? start : NULL,
        .keep = where == ELSEWHERE ? NULL : keep_round,
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
    dip_processors_confine((long)getpid(), starts ? 0 : report->threads);
    DipDriver *driver = dip_driver_create(&def, &calls, err);
    bool done = driver && (where != KEPT || resume(t, driver, err)) &&
                dip_drive(driver, progress, "cost", dip_cost_interrupted_text(t->cost), err);
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
    dip_processors_confine((long)getpid(), 0);
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
        dip_cost_journal_round_count(cost->journal, &report->options.seed);
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

bool dip_cost_time_more(DipCostContext *cost, const int *rows, int count, int times_before,
                        DipError *err) {
    const bool is_new = times_before == 0;
    const uint64_t seed = is_new ? UINT64_C(0x10000) + (uint64_t)rows[0] : (uint64_t)times_before;
    Timing t;
    if (!open_timing(&t, cost, count + 1, err)) {
        return false;
    }
    for (int i = 0; i < count; i++) {
        set_row(&t, i + 1, rows[i], is_new);
    }
    // A row that is timed again is compared with a budget. For more exact times, each such row has
    // a block of its own, and so a drawing of the baseline of its own.
    const bool done =
        drive(&t, HERE, is_new ? BLOCK_ROWS : 1, (uint64_t)cost->report->options.seed + seed,
              "frames timed of combinations that may be best", err);
    close_timing(&t);
    return done;
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
                             int count, const char *progress, double *wait, DipError *err) {
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
    *wait = t.machine.wait;
    close_timing(&t);
    return done;
}

// --- half the size -------------------------------------------------------------------------------

// Fills report->smaller with the baseline and with up to three variants of it: with AA 4x, with AF
// 16x, and with AA 8x, adaptive AA and AF 16x. Compared with the default settings, the first has
// more work at edges, the second in textures, and the third in both. Variants that the renderer
// refuses are left out.
static void list_smaller(DipCostReport *report) {
    static const struct {
        // Steps of the settings. If `aa` is 0, the settings aa, aaa and asd are those of the
        // baseline. If `af` is 0, the setting af is that of the baseline.
        uint8_t aa, aaa, af;
    } steps[DIP_COST_MAX_SMALLER] = {{0, 0, 0}, {2, 0, 0}, {0, 0, 4}, {4, DIP_AAA_ON, 4}};
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
    if (!dip_cost_context_open(&context, cost->session, &there, false, err)) {
        return false;
    }
    list_smaller(report);
    double wait;
    const bool done = dip_cost_time_elsewhere(
        cost, &context, report->smaller, report->smaller_count, "smaller frames timed", &wait, err);
    dip_cost_context_close(&context);
    return done;
}
