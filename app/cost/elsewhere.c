// Timing combinations in a second context, beside the baseline in the report's own.
#include "app/cost/elsewhere.h"

#include "app/cost/steps.h"
#include "app/cli/drive.h"

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
} Elsewhere;

static void count_work(const Elsewhere *e, int row, int frame, const DipFrame *drawn) {
    bool *counted = &e->counted[row * dip_cost_frame_count(e->cost->report) + frame];
    double *value = e->rows[row].counters;
    if (!*counted) {
#define ADD_COUNTER(name, text) *value++ += (double)drawn->counters.name;
        DIP_COUNTER_LIST(ADD_COUNTER)
#undef ADD_COUNTER
        *counted = true;
    }
}

static bool draw(void *context, const DipDriverTurn *turn, DipTimed *timed, DipError *err) {
    const Elsewhere *e = context;
    const int row = turn->subject - 1;
    DipFrame frame;
    if (row < 0) {
        return dip_cost_draw_timed(e->cost, e->cost->report->base_rows[0], turn->frame, &frame,
                                   err);
    }
    if (!dip_cost_draw_settings(e->there, &e->rows[row].quality, 0, turn->frame, &frame, err)) {
        return false;
    }
    dip_cost_stage_parts(&frame, timed->parts_ms);
    count_work(e, row, turn->frame, &frame);
    return true;
}

// Times the rows, and estimates their ratios to the baseline.
static bool run(Elsewhere *e, int count, const int *base_of, DipTimesFit **fit,
                const char *progress, DipDriverMachine *machine, DipError *err) {
    const DipCostReport *report = e->cost->report;
    DipDriverDef def = dip_cost_driver_def(report, count + 1, BLOCK_ROWS);
    def.base_of = base_of;
    def.seed ^= SEED_SALT;
    const DipDriverCalls calls = {.draw = draw, .context = e};
    DipDriver *driver = dip_driver_create(&def, &calls, err);
    bool done = driver && dip_drive(driver, progress, "cost", DIP_COST_INTERRUPTED, err);
    if (done) {
        const DipTimes times = dip_driver_times(driver);
        *machine = dip_driver_machine(driver, report->threads);
        *fit = dip_times_fit(&times, err);
        done = *fit != NULL;
    }
    dip_driver_destroy(&driver);
    return done;
}

static void estimate(Elsewhere *e, int count, const DipTimesFit *fit) {
    const DipCostReport *report = e->cost->report;
    const int frames = dip_cost_frame_count(report);
    for (int i = 0; i < count; i++) {
        DipCostElsewhere *row = &e->rows[i];
        for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
            row->counters[c] /= frames;
        }
        dip_cost_estimate_elsewhere(report, fit, i + 1, row);
    }
}

bool dip_cost_time_elsewhere(DipCostContext *cost, DipCostContext *there, DipCostElsewhere *rows,
                             int count, const char *progress, DipDriverMachine *machine,
                             DipError *err) {
    const size_t frames = (size_t)dip_cost_frame_count(cost->report);
    const size_t values = ((size_t)count + 1) * frames;
    Elsewhere e = {.cost = cost, .there = there, .rows = rows};
    int *base_of = calloc((size_t)count + 1, sizeof *base_of); // The baseline is subject 0.
    e.counted = calloc(values, sizeof *e.counted);
    for (int i = 0; i < count; i++) {
        rows[i] = (DipCostElsewhere){.quality = rows[i].quality};
    }
    const bool made = (base_of && e.counted) ||
                      dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
    DipTimesFit *fit = NULL;
    const bool done = made && run(&e, count, base_of, &fit, progress, machine, err);
    if (done) {
        estimate(&e, count, fit);
    }
    dip_times_fit_free(&fit);
    free(base_of);
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
    DipDriverMachine machine;
    const bool done =
        dip_cost_time_elsewhere(cost, &context, report->smaller, report->smaller_count,
                                "smaller frames timed", &machine, err);
    dip_cost_context_close(&context);
    return done;
}
