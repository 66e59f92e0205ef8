// Timing the rows beside the base, and measuring the energy of their visits.
#include "app/cost/axes/axes_drawing.h"
#include "app/measure/timing/paired_timing.h"
#include "app/cli/progress.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK_ROWS = 4 }; // As in a report (times.c).

// Energy of a row's visits.
typedef struct RowEnergy {
    double uj;
    int64_t frames; // Timed frames in these visits.
} RowEnergy;

typedef struct AxesTiming {
    DipCostAxesDrawing *drawing;
    const DipEnergyMeter *meter;
    DipEnergyReading before; // At the begin of the visit.
    bool has_energy;         // Every reading so far succeeded.
    RowEnergy energy[DIP_COST_AXES_MAX_ROWS];
    double wait_ms, cpu_ms, room_ms; // Sums over all timed runs.
    DipProgress progress;
    int64_t drawn;
} AxesTiming;

static bool draw(void *context, const DipTimingTurn *turn, DipError *err) {
    const AxesTiming *t = context;
    DipFrame frame;
    return dip_cost_axes_draw_timed(t->drawing, turn->subject, turn->frame, &frame, err);
}

// The parts of a time: drawing and enlarging.
static void part_ms(void *context, double ms[DIP_TIME_PARTS]) {
    const AxesTiming *t = context;
    memset(ms, 0, DIP_TIME_PARTS * sizeof *ms);
    ms[0] = t->drawing->draw_ms;
    ms[1] = t->drawing->enlarge_ms;
}

// A visit's energy is that between the end of its untimed frame and the end of its last timed one.
static void count_energy(AxesTiming *t, const DipTimingTurn *turn) {
    const DipCostOptions *options = &t->drawing->axes->report.options;
    if (!t->has_energy) {
        return;
    }
    if (turn->phase == DIP_TIMING_REWARM) {
        t->has_energy = dip_energy_read(t->meter, &t->before);
    } else if (turn->phase == DIP_TIMING_TIMED &&
               turn->frame / options->rounds == options->timed_frames - 1) {
        DipEnergyReading after;
        t->has_energy = dip_energy_read(t->meter, &after);
        if (t->has_energy) {
            RowEnergy *energy = &t->energy[turn->subject];
            energy->uj += (double)dip_energy_between_uj(t->meter, &t->before, &after);
            energy->frames += options->timed_frames;
        }
    }
}

static bool after_draw(void *context, const DipTimingTurn *turn, double ms, DipError *err) {
    (void)ms;
    AxesTiming *t = context;
    count_energy(t, turn);
    t->drawn +=
        turn->phase != DIP_TIMING_SETTLE && turn->round < t->drawing->axes->report.options.rounds;
    dip_progress_show(&t->progress, t->drawn);
    return !dip_cost_axes_interrupted(err);
}

// Adds up how long the threads waited. Rows have different numbers of threads, so the result of
// dip_paired_timing_run, which knows one number only, would be too small or too large.
static bool after_round(void *context, int round, const DipTimePair *pairs, bool known,
                        DipError *err) {
    (void)round;
    (void)known;
    (void)err;
    AxesTiming *t = context;
    const DipCostAxes *axes = t->drawing->axes;
    const int frames = axes->report.options.timed_frames;
    for (int i = frames; i < axes->report.row_count * frames; i++) { // The base's own pairs aside.
        const DipTimePair *pair = &pairs[i];
        if (pair->ms > 0.0) {
            t->wait_ms += pair->wait * pair->ms;
            t->cpu_ms += pair->cpu_ms;
            t->room_ms += pair->ms * axes->rows[i / frames].threads;
        }
    }
    return true;
}

static double wait_share(const AxesTiming *t, bool has_wait) {
    const double waited_ms = has_wait ? t->wait_ms : t->room_ms - t->cpu_ms;
    return t->room_ms > 0.0 ? waited_ms / t->room_ms : 0.0;
}

static void keep_energy(const AxesTiming *t) {
    DipCostAxes *axes = t->drawing->axes;
    if (!t->has_energy) {
        snprintf(axes->energy, sizeof axes->energy, "not told by this machine: %s",
                 t->meter->count > 0 ? "a counter could be read only for a while" : t->meter->text);
        return;
    }
    snprintf(axes->energy, sizeof axes->energy, "%s", t->meter->text);
    for (int r = 0; r < axes->report.row_count; r++) {
        if (t->energy[r].frames > 0) {
            axes->rows[r].frame_mj = 1e-3 * t->energy[r].uj / (double)t->energy[r].frames;
        }
    }
}

// Copies the pairs to the report, and estimates.
static bool keep_times(AxesTiming *t, const DipTimePair *pairs, DipError *err) {
    DipCostReport *report = &t->drawing->axes->report;
    const size_t frames = (size_t)dip_cost_frame_count(report);
    for (int r = 0; r < report->row_count; r++) {
        memcpy(report->rows[r].pairs, pairs + (size_t)r * frames, frames * sizeof *pairs);
    }
    report->rounds = report->options.rounds;
    report->machine.wait = wait_share(t, report->machine.has_wait);
    return dip_cost_estimate_times(report, err) &&
           dip_cost_axes_compare_threads(t->drawing->axes, err);
}

static bool run_timing(AxesTiming *t, DipTimePair *pairs, DipError *err) {
    DipCostReport *report = &t->drawing->axes->report;
    const int base_of[DIP_COST_AXES_MAX_ROWS] = {0}; // Row 0 is the base of all.
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
        .after_round = after_round,
        .part_ms = part_ms,
        .context = t,
    };
    t->progress = dip_progress_begin("frames timed", dip_paired_timing_run_count(&def, 0));
    const bool done =
        dip_paired_timing_run(&def, &calls, report->threads, pairs, &report->machine, err);
    dip_progress_end(&t->progress, t->drawn);
    return done;
}

bool dip_cost_axes_time(DipCostAxesDrawing *drawing, const DipEnergyMeter *meter, DipError *err) {
    const DipCostReport *report = &drawing->axes->report;
    const size_t count = (size_t)report->row_count * (size_t)dip_cost_frame_count(report);
    DipTimePair *pairs = calloc(count, sizeof *pairs);
    AxesTiming *t = calloc(1, sizeof *t);
    bool done =
        (pairs && t) || dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost axes", "out of memory");
    if (done) {
        t->drawing = drawing;
        t->meter = meter;
        t->has_energy = meter->count > 0;
        done = run_timing(t, pairs, err) && keep_times(t, pairs, err);
        keep_energy(t);
    }
    free(pairs);
    free(t);
    return done;
}
