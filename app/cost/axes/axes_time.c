// Timing the rows beside the base, and measuring the energy of their visits.
#include "app/cost/axes/axes_drawing.h"
#include "app/cli/drive.h"
#include "app/cost/context.h"

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
    DipEnergyReading before; // After the latest frame.
    bool has_energy;         // Every reading so far succeeded.
    RowEnergy energy[DIP_COST_AXES_MAX_ROWS];
} AxesTiming;

// A visit's energy is that between the end of its untimed frame and the end of its last timed one.
static void count_energy(AxesTiming *t, const DipDriverTurn *turn) {
    if (!t->has_energy || turn->phase < DIP_DRIVER_UNTIMED) {
        return;
    }
    const DipEnergyReading before = t->before;
    t->has_energy = dip_energy_read(t->meter, &t->before);
    if (t->has_energy && turn->phase == DIP_DRIVER_TIMED) {
        RowEnergy *energy = &t->energy[turn->subject];
        energy->uj += (double)dip_energy_between_uj(t->meter, &before, &t->before);
        energy->frames++;
    }
}

// The parts of a time are drawing and enlarging.
static bool draw(void *context, const DipDriverTurn *turn, DipTimed *timed, DipError *err) {
    AxesTiming *t = context;
    DipFrame frame;
    if (!dip_cost_axes_draw_timed(t->drawing, turn->subject, turn->frame, &frame, err)) {
        return false;
    }
    timed->parts_ms[0] = t->drawing->draw_ms;
    timed->parts_ms[1] = t->drawing->enlarge_ms;
    count_energy(t, turn);
    return true;
}

// Returns how long the threads waited. Rows have different numbers of threads, so the result of
// dip_driver_machine, which knows one number only, would be too small or too large.
static double wait_share(const DipCostAxes *axes, const DipTimes *times, bool has_wait) {
    double wait_ms = 0.0, cpu_ms = 0.0, room_ms = 0.0;
    for (int i = 0; i < times->count; i++) {
        const DipTimed *timed = &times->list[i];
        wait_ms += timed->wait * timed->ms;
        cpu_ms += timed->cpu_ms;
        room_ms += timed->ms * axes->rows[timed->subject].threads;
    }
    const double waited_ms = has_wait ? wait_ms : room_ms - cpu_ms;
    return room_ms > 0.0 ? waited_ms / room_ms : 0.0;
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
static bool keep_times(AxesTiming *t, const DipDriver *driver, DipTimePair *pairs, DipError *err) {
    DipCostReport *report = &t->drawing->axes->report;
    const size_t frames = (size_t)dip_cost_frame_count(report);
    const DipTimes times = dip_driver_times(driver);
    int rows[DIP_COST_AXES_MAX_ROWS];
    for (int r = 0; r < report->row_count; r++) {
        rows[r] = r;
    }
    dip_cost_log_clear(report);
    if (!dip_times_pairs(&times, pairs, err) || !dip_cost_log_add(report, &times, rows, err)) {
        return false;
    }
    for (int r = 0; r < report->row_count; r++) {
        memcpy(report->rows[r].pairs, pairs + (size_t)r * frames, frames * sizeof *pairs);
    }
    report->rounds = report->options.rounds;
    report->machine = dip_driver_machine(driver, report->threads);
    report->machine.wait = wait_share(t->drawing->axes, &times, report->machine.has_wait);
    if (!dip_cost_estimate_times(report, err)) {
        return false;
    }
    dip_cost_axes_compare_threads(t->drawing->axes);
    return true;
}

bool dip_cost_axes_time(DipCostAxesDrawing *drawing, const DipEnergyMeter *meter, DipError *err) {
    const DipCostReport *report = &drawing->axes->report;
    const size_t count = (size_t)report->row_count * (size_t)dip_cost_frame_count(report);
    const int base_of[DIP_COST_AXES_MAX_ROWS] = {0}; // Row 0 is the base of all.
    AxesTiming t = {.drawing = drawing, .meter = meter, .has_energy = meter->count > 0};
    DipDriverDef def = dip_cost_driver_def(report, report->row_count, BLOCK_ROWS);
    def.base_of = base_of;
    def.settle = true;
    DipDriver *driver =
        dip_driver_create(&def, &(DipDriverCalls){.draw = draw, .context = &t}, err);
    DipTimePair *pairs = calloc(count, sizeof *pairs);
    const bool made = driver && (pairs || dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost axes",
                                                        "out of memory"));
    const bool done = made && dip_drive(driver, "frames timed", "cost axes", "interrupted", err) &&
                      keep_times(&t, driver, pairs, err);
    keep_energy(&t);
    dip_driver_destroy(&driver);
    free(pairs);
    return done;
}
