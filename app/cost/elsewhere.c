// Timing combinations in a second context, beside the baseline in the report's own.
#include "app/cost/elsewhere.h"

#include "app/cost/steps.h"
#include "app/measure/timing/paired_timing.h"
#include "app/cli/progress.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    BLOCK_ROWS = 4,   // As in a report (times.c).
    LEAST_SIDE = 64,  // Pixels; smaller pictures have no half size.
    SEED_SALT = 0x517 // The order is another than that of the report's rows.
};

void dip_cost_elsewhere_begin(DipCostReport *there, const DipCostReport *report, int width,
                              int height, const char *path) {
    *there = (DipCostReport){
        .options = report->options, .path_count = 1, .width = width, .height = height};
    memcpy(there->scene_hash, report->scene_hash, sizeof there->scene_hash);
    snprintf(there->paths[0], sizeof there->paths[0], "%s", path);
}

// --- timing --------------------------------------------------------------------------------------

// Subject 0 is the baseline; subject i is rows[i - 1].
typedef struct Elsewhere {
    DipCostContext *cost;
    DipCostContext *there;
    DipCostElsewhere *rows;
    bool *counted; // [row * frames + frame]: the frame's counters are in the row's sums.
    DipFrame frame;
    DipProgress progress;
    int64_t drawn;
} Elsewhere;

static bool draw(void *context, const DipTimingTurn *turn, DipError *err) {
    Elsewhere *e = context;
    return turn->subject == 0
               ? dip_cost_draw_timed(e->cost, e->cost->report->base_rows[0], turn->frame, &e->frame,
                                     err)
               : dip_cost_draw_settings(e->there, &e->rows[turn->subject - 1].quality, turn->frame,
                                        &e->frame, err);
}

static void stage_ms(void *context, double ms[DIP_TIME_PARTS]) {
    const Elsewhere *e = context;
#define WRITE_STAGE(name, text) *ms++ = e->frame.stages.name##_ms;
    DIP_STAGE_LIST(WRITE_STAGE)
#undef WRITE_STAGE
}

static void count_work(Elsewhere *e, int row, int frame) {
    bool *counted = &e->counted[row * dip_cost_frame_count(e->cost->report) + frame];
    double *value = e->rows[row].counters;
    if (!*counted) {
#define ADD_COUNTER(name, text) *value++ += (double)e->frame.counters.name;
        DIP_COUNTER_LIST(ADD_COUNTER)
#undef ADD_COUNTER
        *counted = true;
    }
}

static bool after_draw(void *context, const DipTimingTurn *turn, double ms, DipError *err) {
    (void)ms;
    Elsewhere *e = context;
    if (turn->subject > 0) {
        count_work(e, turn->subject - 1, turn->frame);
    }
    e->drawn += turn->round < e->cost->report->options.rounds;
    dip_progress_show(&e->progress, e->drawn);
    return !dip_cost_interrupted(e->cost, err);
}

static bool run(Elsewhere *e, int count, const int *base_of, DipTimePair *pairs,
                const char *progress, DipPairedTimingResult *machine, DipError *err) {
    const DipCostReport *report = e->cost->report;
    const DipPairedTimingDef def = {
        .subject_count = count + 1,
        .base_of = base_of,
        .block_subjects = BLOCK_ROWS,
        .rounds = report->options.rounds,
        .frames_per_round = report->options.timed_frames,
        .seed = (uint64_t)report->options.seed ^ SEED_SALT,
    };
    const DipPairedTimingCalls calls = {
        .run = draw, .after_run = after_draw, .part_ms = stage_ms, .context = e};
    e->progress = dip_progress_begin(progress, dip_paired_timing_run_count(&def, 0));
    const bool done = dip_paired_timing_run(&def, &calls, report->threads, pairs, machine, err);
    dip_progress_end(&e->progress, e->drawn);
    return done;
}

static bool estimate(Elsewhere *e, int count, const DipTimePair *pairs, DipError *err) {
    const DipCostReport *report = e->cost->report;
    const int frames = dip_cost_frame_count(report);
    bool done = true;
    for (int i = 0; done && i < count; i++) {
        DipCostElsewhere *row = &e->rows[i];
        for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
            row->counters[c] /= frames;
        }
        done =
            dip_cost_estimate_elsewhere(report, pairs + (size_t)(i + 1) * (size_t)frames, row, err);
    }
    return done;
}

bool dip_cost_time_elsewhere(DipCostContext *cost, DipCostContext *there, DipCostElsewhere *rows,
                             int count, const char *progress, DipPairedTimingResult *machine,
                             DipError *err) {
    const size_t frames = (size_t)dip_cost_frame_count(cost->report);
    const size_t values = ((size_t)count + 1) * frames;
    Elsewhere e = {.cost = cost, .there = there, .rows = rows};
    int *base_of = calloc((size_t)count + 1, sizeof *base_of); // The baseline is subject 0.
    DipTimePair *pairs = calloc(values, sizeof *pairs);
    e.counted = calloc(values, sizeof *e.counted);
    for (int i = 0; i < count; i++) {
        rows[i] = (DipCostElsewhere){.quality = rows[i].quality};
    }
    const bool made = (base_of && pairs && e.counted) ||
                      dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
    const bool done = made && run(&e, count, base_of, pairs, progress, machine, err) &&
                      estimate(&e, count, pairs, err);
    free(base_of);
    free(pairs);
    free(e.counted);
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
    DipPairedTimingResult machine;
    const bool done =
        dip_cost_time_elsewhere(cost, &context, report->smaller, report->smaller_count,
                                "smaller frames timed", &machine, err);
    dip_cost_context_close(&context);
    return done;
}
