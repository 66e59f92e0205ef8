// Draws frames for the live report, and compares them with the truth (the converged picture).
#include "app/preview/live/live_prices.h"

#include "app/cost/plan.h"
#include "app/cli/machine.h"
#include "app/files/put.h"
#include "app/measure/metrics/meter.h"
#include "app/preview/live/processor_share.h"
#include "renderer/base/clock.h"
#include "renderer/base/trig.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const int64_t progress_period_ns = 250000000;

struct DipLivePrices {
    DipSession *session;
    DipPrices *prices;
    DipPriceJob *job;
    // The painters for gi=off and gi=on. With gi=off, a painter keeps a copy of the mesh of each
    // repeated object. A single painter would make these copies again after every change of gi.
    DipPainter *painters[2];
    DipLivePicture picture;
    bool has_picture;
    bool continues; // The next frame follows the one that `prepare` has drawn.
    char scene[DIP_COST_TEXT];
    char processor[DIP_COST_TEXT];

    DipMeter meter;
    uint8_t *rgba8; // The picture to compare with the truth, rows packed. Owned; NULL until it is
                    // needed.
    bool measures_errors; // A picture is being compared with the truth.
    bool errors_failed;
    int judged; // The report's row whose picture is compared.
    // Errors of each row of the report against the finest truth with which the row was compared.
    DipMetricSums sums[DIP_PRICES_LIVE_ROWS];
    int samples[DIP_PRICES_LIVE_ROWS]; // Samples per pixel of that truth; 0 if the row has no
                                       // errors yet.
    DipLiveTruth truth;                // The truth that dip_live_prices_step got last.
    int errors_left;         // Rows without errors against the truth; 0 if there is no truth.
    DipProcessorShare share; // Tells whether measuring errors waits for a processor.
    int64_t progress_ns;     // When the text of the progress was written last.
};

// --- painters ------------------------------------------------------------------------------------

static DipPainter *painter_for(DipLivePrices *live, const DipQuality *quality, DipError *err) {
    DipPainter **painter = &live->painters[quality->step[DIP_SETTING_GI] != 0];
    if (!*painter) {
        *painter = dip_session_make_painter(live->session, live->session->gallery, quality,
                                            live->picture.width, live->picture.height, err);
    }
    return *painter;
}

// Draws a frame. With `cut`, it begins a new history.
static bool draw_pose(DipLivePrices *live, const DipQuality *quality, uint64_t frame_index,
                      bool cut, const DipPose *pose, DipFrame *frame, DipError *err) {
    DipPainter *painter = painter_for(live, quality, err);
    if (!painter) {
        return false;
    }
    dip_painter_set_frame_index(painter, frame_index);
    if (cut) {
        dip_painter_cut(painter);
    }
    return dip_painter_set_quality(painter, quality, err) &&
           dip_painter_draw(painter, live->session->scene, pose, live->picture.time_ns, frame, err);
}

static bool draw(void *context, const DipQuality *quality, uint64_t frame_index, DipFrame *frame,
                 DipError *err) {
    DipLivePrices *live = context;
    const bool cut = !live->continues;
    live->continues = false;
    return draw_pose(live, quality, frame_index, cut, &live->picture.pose, frame, err);
}

// The picture's camera, turned to the left by about a pixel.
static DipPose turned(const DipLivePicture *picture) {
    DipPose pose = picture->pose;
    const double *q = picture->pose.orientation;
    const double half = picture->pose.fov_y_deg / picture->height * (DIP_PI / 360.0);
    const double s = dip_sin(half), c = dip_cos(half);
    const double product[4] = {q[0] * c - q[2] * s, q[1] * c + q[3] * s, q[2] * c + q[0] * s,
                               q[3] * c - q[1] * s};
    memcpy(pose.orientation, product, sizeof product);
    return pose;
}

// A pane at rest spends less on its history than one whose camera moves. Prices are those of a
// moving camera, as in a report.
static bool prepare(void *context, const DipQuality *quality, uint64_t frame_index, DipError *err) {
    DipLivePrices *live = context;
    const DipPose pose = turned(&live->picture);
    DipFrame before;
    live->continues = draw_pose(live, quality, frame_index, true, &pose, &before, err);
    return live->continues;
}

static void forget(DipLivePrices *live) {
    dip_price_job_forget(live->job);
    dip_meter_free(&live->meter);
    free(live->rgba8);
    live->rgba8 = NULL;
    live->measures_errors = live->errors_failed = false;
    live->errors_left = 0;
    memset(live->samples, 0, sizeof live->samples);
    live->has_picture = false;
    live->progress_ns = -progress_period_ns; // The next progress text shows at once.
}

static void destroy_painters(DipLivePrices *live) {
    dip_painter_destroy(&live->painters[0]);
    dip_painter_destroy(&live->painters[1]);
}

void dip_live_prices_leave_scene(DipLivePrices *live) {
    forget(live);
    destroy_painters(live);
}

void dip_live_prices_enter_scene(DipLivePrices *live) {
    const DipSession *session = live->session;
    dip_cost_scene_name(session, live->scene);
    dip_machine_processor(live->processor, sizeof live->processor);
    const DipPriceConditions conditions = {
        .scene = live->scene,
        .processor = live->processor,
        .isa = dip_isa_name(session->isa),
        .threads = dip_pool_thread_count(session->pool),
    };
    dip_prices_set_conditions(live->prices, &conditions);
    dip_prices_prefer_rough(live->prices, dip_prices_are_of_other_scene(live->prices));
}

DipLivePrices *dip_live_prices_create(DipSession *session, DipPrices *prices, DipError *err) {
    DipLivePrices *live = calloc(1, sizeof *live);
    if (!live) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "prices", "out of memory");
        return NULL;
    }
    live->session = session;
    live->prices = prices;
    const DipPriceJobCalls calls = {
        .draw = draw,
        .prepare = prepare,
        .threads = dip_pool_thread_count(session->pool),
        .context = live,
    };
    live->job = dip_price_job_create(&calls, prices, err);
    if (!live->job) {
        dip_live_prices_destroy(&live);
    }
    return live;
}

void dip_live_prices_destroy(DipLivePrices **live) {
    if (*live) {
        destroy_painters(*live);
        dip_meter_free(&(*live)->meter);
        free((*live)->rgba8);
        dip_price_job_destroy(&(*live)->job);
        free(*live);
        *live = NULL;
    }
}

// --- following the picture -----------------------------------------------------------------------

static bool is_same_picture(const DipLivePicture *a, const DipLivePicture *b) {
    return memcmp(&a->pose, &b->pose, sizeof a->pose) == 0 && a->time_ns == b->time_ns &&
           a->width == b->width && a->height == b->height && a->look == b->look &&
           a->pixels_per_degree == b->pixels_per_degree;
}

// Returns whether the live report still has the right baseline. A cost report that was opened in
// the meantime may have another baseline.
static bool has_same_base(const DipLivePrices *live) {
    const DipQuality base = dip_prices_base(live->prices);
    return dip_quality_equal(&base, &dip_prices_live(live->prices)->options.baseline);
}

// Forgets the prices if the picture or the base of the prices has changed. Destroys a painter that
// cannot be resized; the next frame then makes a new one or fails with the reason.
static void follow_picture(DipLivePrices *live, const DipLivePicture *picture) {
    if (live->has_picture && is_same_picture(&live->picture, picture) && has_same_base(live)) {
        return;
    }
    forget(live);
    live->picture = *picture;
    live->has_picture = true;
    for (int i = 0; i < 2; i++) {
        if (live->painters[i] &&
            !dip_painter_resize(live->painters[i], picture->width, picture->height, NULL)) {
            dip_painter_destroy(&live->painters[i]);
        }
    }
}

// --- errors --------------------------------------------------------------------------------------

// Begins to compare a frame with the truth. Copies the frame, because the painter's next frame
// overwrites it.
static bool begin_judging(DipLivePrices *live, const DipFrame *frame, const DipSrgbPicture *truth) {
    const DipLivePicture *picture = &live->picture;
    const size_t row_bytes = 4 * (size_t)picture->width;
    if (!live->rgba8) {
        live->rgba8 = malloc(row_bytes * (size_t)picture->height);
        if (!live->rgba8 || !dip_meter_init(&live->meter, DIP_METER_FLIP, picture->width,
                                            picture->height, picture->pixels_per_degree)) {
            free(live->rgba8);
            live->rgba8 = NULL;
            return false;
        }
    }
    if (live->meter.standard.picture.rgba8 != truth->rgba8) {
        dip_meter_set_standard(&live->meter, &(DipMeterStandard){.picture = *truth});
    }
    for (size_t y = 0; y < (size_t)picture->height; y++) {
        memcpy(live->rgba8 + y * row_bytes, frame->rgba8 + y * frame->stride_bytes, row_bytes);
    }
    const DipSrgbPicture copy = {live->rgba8, row_bytes, picture->width, picture->height};
    dip_meter_begin(&live->meter, &copy, NULL);
    return true;
}

// Returns the first row whose errors against the truth are not known, or -1 if there is none.
static int find_unjudged(const DipLivePrices *live) {
    for (int r = 0; r < dip_prices_live(live->prices)->row_count; r++) {
        if (live->samples[r] < live->truth.samples) {
            return r;
        }
    }
    return -1;
}

// Draws the picture that a pane with these settings shows at rest.
static bool draw_at_rest(DipLivePrices *live, const DipQuality *quality, DipFrame *frame) {
    const bool has_history = dip_quality_has_history(quality) && live->session->scene;
    live->continues = false;
    bool drawn = draw(live, quality, 0, frame, NULL);
    for (int i = 1; drawn && has_history && i < DIP_FRAMES_BEFORE; i++) {
        DipPainter *painter = painter_for(live, quality, NULL);
        dip_painter_set_frame_index(painter, (uint64_t)i);
        drawn = dip_painter_draw(painter, live->session->scene, &live->picture.pose,
                                 live->picture.time_ns, frame, NULL);
    }
    return drawn;
}

static void begin_errors(DipLivePrices *live) {
    DipFrame frame;
    live->judged = find_unjudged(live);
    live->measures_errors =
        draw_at_rest(live, &dip_prices_live(live->prices)->rows[live->judged].quality, &frame) &&
        begin_judging(live, &frame, &live->truth.picture);
    live->errors_failed = !live->measures_errors;
    live->errors_left = live->errors_failed ? 0 : live->errors_left;
}

// Shows the errors against the newest truth, but only when every row that shows an error has one
// against this truth: errors against two truths must not be compared. Returns whether the
// errors show now.
static bool show_errors(const DipLivePrices *live) {
    const DipCostReport *report = dip_prices_live(live->prices);
    for (int r = 0; r < report->row_count; r++) {
        if (report->rows[r].judged[0] && live->samples[r] < live->truth.samples) {
            return false;
        }
    }
    for (int r = 0; r < report->row_count; r++) {
        if (live->samples[r] == live->truth.samples) {
            report->rows[r].viewpoints[0] = live->sums[r];
            report->rows[r].judged[0] = true;
        }
    }
    return dip_prices_update_live(live->prices, false, NULL);
}

// Draws the picture of a row whose error is not known, or goes on comparing the drawn picture with
// the truth. Returns whether new errors show (show_errors).
static bool step_errors(DipLivePrices *live) {
    if (!live->measures_errors) {
        begin_errors(live);
        return false;
    }
    const DipStep step = dip_meter_step(&live->meter);
    if (step == DIP_STEP_WORKING) {
        return false;
    }
    live->measures_errors = false;
    live->errors_failed = step == DIP_STEP_FAILED;
    if (live->errors_failed) {
        live->errors_left = 0;
        return false;
    }
    live->sums[live->judged] = live->meter.sums;
    live->samples[live->judged] = live->truth.samples;
    live->errors_left--;
    return show_errors(live);
}

static bool measure_errors(DipLivePrices *live, int64_t end_ns) {
    bool news = false;
    dip_processor_share_begin(&live->share, pthread_self());
    do {
        news |= step_errors(live);
    } while (live->errors_left > 0 && dip_clock_ns() < end_ns);
    dip_processor_share_end(&live->share, pthread_self());
    return news;
}

static bool has_truth(const DipLivePrices *live) {
    const DipSrgbPicture *truth = &live->truth.picture;
    return truth->rgba8 && truth->width == live->picture.width &&
           truth->height == live->picture.height;
}

// Takes the newest truth. If the truth has changed or has moved in memory, a comparison that has
// begun starts again.
static void follow_truth(DipLivePrices *live, const DipLiveTruth *truth) {
    if (live->meter.standard.picture.rgba8 != truth->picture.rgba8) {
        live->measures_errors = false;
    }
    if (live->truth.samples != truth->samples) {
        live->meter.standard.picture.rgba8 = NULL; // The same memory may hold another picture now.
        live->measures_errors = live->errors_failed = false;
    }
    live->truth = *truth;
}

static void count_errors_left(DipLivePrices *live) {
    const int rows = dip_prices_live(live->prices)->row_count;
    live->errors_left = 0;
    for (int r = 0; has_truth(live) && !live->errors_failed && r < rows; r++) {
        live->errors_left += live->samples[r] < live->truth.samples;
    }
}

// --- progress ------------------------------------------------------------------------------------

// Returns whether the error thread draws the next truth now, or is about to.
static bool truth_draws(const DipLivePrices *live) {
    return live->truth.next_samples > 0 || live->truth.comes_first;
}

// Writes "times: 12 steps left, 4 s", "errors: the converged picture is 40 % drawn", "errors: 3 of
// 24", why prices cannot be measured, or "" if nothing is left. Adds that the work waits for a free
// processor.
static void describe(const DipLivePrices *live, char *text, size_t size_bytes) {
    const int count = dip_prices_live(live->prices)->row_count;
    bool waits = false;
    dip_price_job_describe(live->job, text, size_bytes);
    if (truth_draws(live)) {
        waits = live->truth.waits;
        snprintf(text, size_bytes, "errors: the %s picture is %.0f %% drawn",
                 has_truth(live) ? "next, finer converged" : "converged",
                 100.0 * live->truth.drawn);
    } else if (live->errors_left > 0 && !dip_price_job_progress(live->job).first) {
        waits = live->share.low;
        snprintf(text, size_bytes, "errors: %d of %d", count - live->errors_left, count);
    }
    if (waits) {
        dip_put_append(text, size_bytes, ", waiting for a free processor");
    }
}

// Tells the panel what is being measured, at most four times a second. Returns whether the text is
// new.
static bool show_progress(DipLivePrices *live) {
    const int64_t now_ns = dip_clock_ns();
    char text[DIP_PRICE_PROGRESS];
    if ((dip_live_prices_are_working(live) || truth_draws(live)) &&
        now_ns - live->progress_ns < progress_period_ns) {
        return false;
    }
    live->progress_ns = now_ns;
    describe(live, text, sizeof text);
    return dip_prices_set_progress(live->prices, text);
}

// --- the whole -----------------------------------------------------------------------------------

static bool measure(DipLivePrices *live, double budget_ms) {
    const int64_t end_ns = dip_clock_ns() + (int64_t)(1e6 * budget_ms);
    const DipPriceProgress times = dip_price_job_progress(live->job);
    count_errors_left(live);
    if (live->errors_left > 0 && !times.first) {
        return measure_errors(live, end_ns);
    }
    return times.working && !truth_draws(live) && dip_price_job_step(live->job, budget_ms);
}

bool dip_live_prices_step(DipLivePrices *live, const DipLivePicture *picture,
                          const DipQuality quality[DIP_PANE_COUNT], const DipLiveTruth *truth,
                          double budget_ms) {
    follow_picture(live, picture);
    dip_price_job_follow(live->job, &quality[DIP_PANE_CURRENT], &quality[DIP_PANE_REQUESTED]);
    follow_truth(live, truth);
    const bool news = measure(live, budget_ms);
    return show_progress(live) || news;
}

void dip_live_prices_pause(DipLivePrices *live) {
    dip_price_job_interrupt(live->job);
    live->measures_errors = false;
    dip_prices_set_progress(live->prices, "");
}

bool dip_live_prices_have_times(const DipLivePrices *live) {
    return live->has_picture && !dip_price_job_progress(live->job).first;
}

bool dip_live_prices_have_final_times(const DipLivePrices *live) {
    return live->has_picture && !dip_price_job_progress(live->job).working;
}

bool dip_live_prices_lack_errors(const DipLivePrices *live) {
    return live->has_picture && live->errors_left > 0;
}

bool dip_live_prices_are_working(const DipLivePrices *live) {
    const DipPriceProgress times = dip_price_job_progress(live->job);
    return live->has_picture &&
           ((live->errors_left > 0 && !times.first) || (times.working && !truth_draws(live)));
}
