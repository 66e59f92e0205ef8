// Finds out whether other programs keep the machine busy, before a measurement and after each of
// its rounds, and warns once if they do.
#include "app/cost/steps.h"

#include "app/cli/log.h"
#include "app/cli/progress.h"
#include "app/report/verdict.h"

#include <math.h>

enum {
    LOOK_ROUNDS = 8,
    LOOK_FRAMES = 16, // Number of frames of path 0 that are drawn, spread evenly.
    LOOK_COPIES = 3   // Number of rounds in which each frame of the base subject is drawn.
};

// Returns the index of the timed frame of path 0 that a turn draws. The driver (driver.h) has two
// subjects, which both have the baseline's settings.
static int frame_of(const DipCostContext *cost, const DipDriverTurn *turn) {
    return turn->frame * dip_cost_frame_count(cost->report) / LOOK_FRAMES;
}

static bool prepare(void *context, const DipDriverTurn *turn, DipError *err) {
    DipCostContext *cost = context;
    return dip_cost_prepare_timed(cost, &cost->report->options.baseline, 0, frame_of(cost, turn),
                                  err);
}

static bool draw(void *context, const DipDriverTurn *turn, DipTimed *timed, DipError *err) {
    DipCostContext *cost = context;
    DipFrame frame;
    (void)timed;
    return dip_cost_draw_timed(cost, &cost->report->options.baseline, 0, frame_of(cost, turn),
                               &frame, err);
}

// Warns if the verdict is not green, unless the user was warned before.
static void warn(DipCostContext *cost, DipCostVerdict verdict, const char *reason) {
    if (cost->has_warned || verdict == DIP_COST_GREEN) {
        return;
    }
    cost->has_warned = true;
    dip_progress_clear();
    dip_log_note(
        "the machine is busy, so the times will be %s unless it becomes quiet. %s Close "
        "other programs, or press Ctrl-C and give the same command again later: it "
        "continues where it stopped. With --quick or a smaller --size, the machine must be "
        "quiet for a shorter time. Errors are right on a busy machine, too.",
        verdict == DIP_COST_RED ? "wrong and no settings will be advised" : "less exact", reason);
}

void dip_cost_look_at_times(DipCostContext *cost, const DipTimed *timed, int count) {
    DipCostSigns signs = {.settled = true};
    double ms = 0.0, wait_ms = 0.0;
    char reason[DIP_COST_REASON];
    for (int i = 0; i < count; i++) {
        ms += timed[i].ms;
        wait_ms += timed[i].ms * timed[i].wait;
    }
    signs.wait = ms > 0.0 ? wait_ms / (ms * cost->report->threads) : 0.0;
    warn(cost, dip_cost_verdict_of(&signs, reason), reason);
}

// Judges the machine by how long the threads waited and by how far the times of the two equal
// subjects differ (the A/A times), and warns. Both signs can lead to a red verdict, but only the
// waiting time can lead to an amber verdict: with so few frames, A/A times that are amber cannot be
// told from green ones.
static void judge(DipCostContext *cost, const DipDriver *driver, const DipTimesFit *fit) {
    static const int same[] = {1};
    DipCostSigns signs = dip_cost_signs_of(fit, 2, same, 1);
    signs.wait = dip_driver_machine(driver, cost->report->threads).wait;
    char reason[DIP_COST_REASON];
    if (dip_cost_verdict_of(&signs, reason) != DIP_COST_RED) {
        signs = (DipCostSigns){.wait = signs.wait, .settled = true};
    }
    warn(cost, dip_cost_verdict_of(&signs, reason), reason);
    cost->baseline_ms = dip_times_along(fit, 0).mean_ms.value;
}

bool dip_cost_look_at_machine(DipCostContext *cost, DipError *err) {
    static const int base_of[] = {0, 0};
    const DipDriverCalls calls = {.prepare = prepare, .draw = draw, .context = cost};
    const DipDriverDef def = {
        .subjects = 2,
        .base_of = base_of,
        .block_subjects = 1,
        .starts = 1,
        .rounds = LOOK_ROUNDS,
        .frames = LOOK_FRAMES,
        .base_copies = LOOK_COPIES,
        .warm_frames = 1,
        .seed = 1,
    };
    DipDriver *driver = dip_driver_create(&def, &calls, err);
    bool done = driver && dip_drive(driver, "frames to see whether the machine is quiet", "cost",
                                    dip_cost_interrupted_text(cost), err);
    if (done) {
        const DipTimes times = dip_driver_times(driver);
        DipTimesFit *fit = dip_times_fit(&times, err);
        done = fit != NULL;
        if (fit) {
            judge(cost, driver, fit);
        }
        dip_times_fit_free(&fit);
    }
    dip_driver_destroy(&driver);
    return done;
}
