// Times in rounds whose order is drawn anew; work from the warm-up.
#include "app/cost/rig.h"
#include "app/progress.h"
#include "renderer/base/clock.h"

#include <math.h>
#include <stdlib.h>

typedef struct Timing {
    DipCostRig *rig;
    uint64_t random;
    int *order;
    double *ms; // of one round: [row * frames + frame]
    DipProgress progress;
    int64_t drawn;
} Timing;

static uint32_t next_random(uint64_t *state) {
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (uint32_t)(*state >> 33);
}

static void shuffle(Timing *t, int count) {
    for (int i = count - 1; i > 0; i--) {
        const int other = (int)(next_random(&t->random) % (uint32_t)(i + 1));
        const int swap = t->order[i];
        t->order[i] = t->order[other];
        t->order[other] = swap;
    }
}

static bool draw(Timing *t, int row, int index, double *ms, DipFrame *frame, DipError *err) {
    const int64_t begin_ns = dip_clock_ns();
    const bool drawn = dip_cost_draw_timed(t->rig, row, index, frame, err);
    *ms = 1e-6 * (double)(dip_clock_ns() - begin_ns);
    dip_progress_show(&t->progress, t->drawn++);
    return drawn && !dip_cost_interrupted(t->rig, err);
}

static void add_counters(DipCostRow *row, const DipCounters *counters, double share) {
    double *value = row->counters;
#define ADD_COUNTER(name, text) *value++ += share * (double)counters->name;
    DIP_COUNTER_LIST(ADD_COUNTER)
#undef ADD_COUNTER
}

// Every row once, for its work; then the first until two medians in a row agree within 2 %.
static bool warm_up(Timing *t, DipError *err) {
    DipCostReport *report = t->rig->report;
    const int frames = report->options.timed_frames;
    double last = INFINITY;
    double ms[5];
    DipFrame frame;
    for (int row = 0; row < report->row_count; row++) {
        for (int f = 0; f < frames; f++) {
            if (!draw(t, row, f, ms, &frame, err)) {
                return false;
            }
            add_counters(&report->rows[row], &frame.counters, 1.0 / frames);
        }
    }
    for (int tries = 0; tries < 20; tries++) {
        for (int i = 0; i < 5; i++) {
            if (!draw(t, 0, 0, &ms[i], &frame, err)) {
                return false;
            }
        }
        for (int i = 1; i < 5; i++) {
            for (int k = i; k > 0 && ms[k] < ms[k - 1]; k--) {
                const double swap = ms[k];
                ms[k] = ms[k - 1];
                ms[k - 1] = swap;
            }
        }
        t->drawn -= 5; // no part of the progress
        if (fabs(ms[2] - last) <= 0.02 * last) {
            break;
        }
        last = ms[2];
    }
    return true;
}

// A visit's first frame is drawn once more before, since others have used the caches.
static bool visit(Timing *t, int row, DipError *err) {
    const int frames = t->rig->report->options.timed_frames;
    DipFrame frame;
    double untimed;
    if (!draw(t, row, 0, &untimed, &frame, err)) {
        return false;
    }
    for (int f = 0; f < frames; f++) {
        if (!draw(t, row, f, &t->ms[row * frames + f], &frame, err)) {
            return false;
        }
    }
    return true;
}

static void keep_round(DipCostReport *report, const double *ms) {
    const int frames = report->options.timed_frames;
    for (int row = 0; row < report->row_count; row++) {
        for (int f = 0; f < frames; f++) {
            report->rows[row].ms[report->rounds * frames + f] = ms[row * frames + f];
        }
    }
    report->rounds++;
}

static bool time_rounds(Timing *t, DipError *err) {
    DipCostReport *report = t->rig->report;
    const int values = report->row_count * report->options.timed_frames;
    for (int round = 0; round < report->options.rounds; round++) {
        const double *kept = dip_cost_state_round(t->rig->state, round, values);
        shuffle(t, report->row_count);
        for (int i = 0; !kept && i < report->row_count; i++) {
            if (!visit(t, t->order[i], err)) {
                return false;
            }
        }
        if (!kept && !dip_cost_state_add_round(t->rig->state, t->ms, values, err)) {
            return false;
        }
        keep_round(report, kept ? kept : t->ms);
    }
    return true;
}

bool dip_cost_take_times(DipCostRig *rig, DipError *err) {
    DipCostReport *report = rig->report;
    const DipCostOptions *options = &report->options;
    const size_t rows = (size_t)report->row_count;
    int left = 0;
    for (int r = 0; r < options->rounds; r++) {
        left += !dip_cost_state_round(rig->state, r, report->row_count * options->timed_frames);
    }
    Timing t = {
        .rig = rig,
        .random = (uint64_t)options->seed,
        .order = malloc(rows * sizeof(int)),
        .ms = malloc(rows * (size_t)options->timed_frames * sizeof(double)),
        .progress =
            dip_progress_begin("frames timed", (int64_t)report->row_count *
                                                   (options->timed_frames +
                                                    (int64_t)left * (options->timed_frames + 1))),
    };
    bool timed = t.order && t.ms;
    if (!timed) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
    }
    for (int i = 0; timed && i < report->row_count; i++) {
        t.order[i] = i;
    }
    timed = timed && warm_up(&t, err) && time_rounds(&t, err);
    dip_progress_end(&t.progress, t.drawn);
    free(t.order);
    free(t.ms);
    return timed;
}
