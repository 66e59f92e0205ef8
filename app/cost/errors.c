// Truths, and the pictures of every row held against them.
#include "app/cost/rig.h"
#include "app/interrupt.h"
#include "app/measure/meter.h"
#include "app/progress.h"
#include "renderer/base/hash.h"

#include <stdlib.h>
#include <string.h>

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
}

// --- truths ------------------------------------------------------------------------------------

enum { PER_TRUTH = 1000 }; // progress

typedef struct TruthProgress {
    DipProgress progress;
    int64_t before; // of the truths that are done
} TruthProgress;

static bool show_truth(void *context, double done) {
    TruthProgress *at = context;
    dip_progress_show(&at->progress, at->before + (int64_t)(done * PER_TRUTH));
    return !dip_interrupted();
}

static bool make_path_truths(DipCostRig *rig, int path, TruthProgress *at, DipError *err) {
    DipCostReport *report = rig->report;
    const DipCostOptions *options = &report->options;
    for (int place = options->first_place; place < options->end_place; place++) {
        for (int frame = 0; frame < options->burst; frame++) {
            DipTruth truth;
            const bool got =
                dip_cost_rig_truth(rig, path, place, frame, show_truth, at, &truth, err);
            if (!got) {
                dip_cost_interrupted(rig, err);
                return false;
            }
            const int index = path * options->places + place;
            dip_metric_sums_add(&report->floors[index], &truth.floor);
            report->has_floor[index] = true;
            dip_truth_free(&truth);
            at->before += PER_TRUTH;
        }
    }
    return true;
}

bool dip_cost_make_truths(DipCostRig *rig, DipError *err) {
    const DipCostOptions *options = &rig->report->options;
    const int truths =
        rig->report->path_count * (options->end_place - options->first_place) * options->burst;
    TruthProgress at = {dip_progress_begin("steps to the truth", (int64_t)truths * PER_TRUTH), 0};
    bool made = true;
    for (int path = 0; made && path < rig->report->path_count; path++) {
        made = make_path_truths(rig, path, &at, err);
    }
    dip_progress_end(&at.progress, at.before);
    return made;
}

// --- judging -----------------------------------------------------------------------------------

// A row's pictures of a burst.
typedef struct Shot {
    uint8_t *rgba8; // frame after frame, rows packed
    int row;
    char key[33];
    DipMetricSums sums;
    bool failed;
} Shot;

typedef struct Judging {
    DipCostRig *rig;
    int path;
    int place;
    DipFlip flip; // to take truths in
    DipTruth truths[DIP_COST_MAX_BURST];
    DipFlipAnalysis sides[DIP_COST_MAX_BURST];
    DipMeter *meters; // per thread
    int meter_count;
    Shot *shots; // that are judged at a time, a few per thread
    int shot_room;
    int shot_count;
    DipProgress progress;
    int64_t done;
} Judging;

static size_t picture_bytes(const Judging *j) {
    return (size_t)j->rig->report->width * (size_t)j->rig->report->height * 4;
}

static void close_judging(Judging *j) {
    for (int i = 0; j->meters && i < j->meter_count; i++) {
        dip_meter_free(&j->meters[i]);
    }
    for (int i = 0; j->shots && i < j->shot_room; i++) {
        free(j->shots[i].rgba8);
    }
    for (int i = 0; i < DIP_COST_MAX_BURST; i++) {
        dip_flip_analysis_free(&j->sides[i]);
    }
    dip_flip_free(&j->flip);
    free(j->meters);
    free(j->shots);
}

static bool open_judging(Judging *j, DipCostRig *rig, DipError *err) {
    const DipCostReport *report = rig->report;
    const double ppd = report->options.pixels_per_degree;
    *j = (Judging){.rig = rig, .meter_count = report->threads, .shot_room = 2 * report->threads};
    j->meters = calloc((size_t)j->meter_count, sizeof *j->meters);
    j->shots = calloc((size_t)j->shot_room, sizeof *j->shots);
    bool made =
        j->meters && j->shots && dip_flip_init(&j->flip, report->width, report->height, ppd);
    for (int i = 0; made && i < j->meter_count; i++) {
        made = dip_meter_init(&j->meters[i], report->width, report->height, ppd);
    }
    for (int i = 0; made && i < j->shot_room; i++) {
        j->shots[i].rgba8 = malloc(picture_bytes(j) * (size_t)report->options.burst);
        made = j->shots[i].rgba8 != NULL;
    }
    for (int i = 0; made && i < report->options.burst; i++) {
        made = dip_flip_analysis_init(&j->flip, &j->sides[i]);
    }
    if (!made) {
        close_judging(j);
        return out_of_memory(err);
    }
    return true;
}

static DipSrgbPicture picture_of(const Judging *j, const uint8_t *rgba8) {
    const DipCostReport *report = j->rig->report;
    return (DipSrgbPicture){rgba8, (size_t)report->width * 4, report->width, report->height};
}

static void judge_shot(void *context, int index, int worker) {
    Judging *j = context;
    Shot *shot = &j->shots[index];
    DipMeter *meter = &j->meters[worker];
    shot->sums = (DipMetricSums){0};
    shot->failed = false;
    dip_flicker_restart(&meter->flicker);
    for (int f = 0; f < j->rig->report->options.burst; f++) {
        const DipSrgbPicture test = picture_of(j, shot->rgba8 + (size_t)f * picture_bytes(j));
        const DipMeterStandard standard = {picture_of(j, j->truths[f].rgba8), j->truths[f].rgb_lin,
                                           &j->sides[f], j->truths[f].classes};
        if (!dip_meter_add(meter, &test, NULL, &standard, &shot->sums)) {
            shot->failed = true;
        }
    }
    dip_meter_end_burst(meter, &shot->sums);
}

static bool judge_shots(Judging *j, DipError *err) {
    dip_pool_run(j->rig->session->pool, j->shot_count, judge_shot, j);
    for (int i = 0; i < j->shot_count; i++) {
        const Shot *shot = &j->shots[i];
        if (shot->failed) {
            return out_of_memory(err);
        }
        j->rig->report->rows[shot->row].places[j->place] = shot->sums;
        j->rig->report->rows[shot->row].judged[j->place] = true;
        if (!dip_cost_state_add(j->rig->state, shot->key, &shot->sums, err)) {
            return false;
        }
    }
    j->shot_count = 0;
    return true;
}

// Draws a row's burst; its key is that of the pictures and of what they are held against.
static bool take_shot(Judging *j, int row, Shot *shot, DipError *err) {
    const DipCostReport *report = j->rig->report;
    const size_t row_bytes = (size_t)report->width * 4;
    DipHash hash = dip_hash_begin(0);
    dip_hash_text(&hash, "diptych errors 1");
    dip_hash_number(&hash, report->options.pixels_per_degree);
    shot->row = row;
    for (int f = 0; f < report->options.burst; f++) {
        const int64_t time_ns =
            dip_cost_place_time_ns(report, j->rig->session, j->path, j->place, f);
        uint8_t *to = shot->rgba8 + (size_t)f * picture_bytes(j);
        DipFrame frame;
        char hex[33];
        if (!dip_cost_draw(j->rig, row, time_ns, f, &frame, err)) {
            return false;
        }
        for (int y = 0; y < report->height; y++) {
            memcpy(to + (size_t)y * row_bytes, frame.rgba8 + (size_t)y * frame.stride_bytes,
                   row_bytes);
        }
        dip_frame_hash(&frame, hex);
        dip_hash_text(&hash, hex);
        dip_hash_text(&hash, j->truths[f].key);
    }
    dip_hash_hex(&hash, shot->key);
    return true;
}

static bool judge_rows(Judging *j, DipError *err) {
    DipCostReport *report = j->rig->report;
    bool judged = true;
    for (int row = 0; judged && row < report->row_count; row++) {
        if (report->rows[row].path != j->path) {
            continue;
        }
        Shot *shot = &j->shots[j->shot_count];
        judged = take_shot(j, row, shot, err);
        if (judged && dip_cost_state_find(j->rig->state, shot->key, &shot->sums)) {
            report->rows[row].places[j->place] = shot->sums;
            report->rows[row].judged[j->place] = true;
        } else if (judged && ++j->shot_count == j->shot_room) {
            judged = judge_shots(j, err);
        }
        dip_progress_show(&j->progress, ++j->done);
        judged = judged && !dip_cost_interrupted(j->rig, err);
    }
    return judged && judge_shots(j, err);
}

static bool no_progress(void *context, double done) {
    (void)context;
    (void)done;
    return true;
}

static bool judge_place(Judging *j, DipError *err) {
    const int burst = j->rig->report->options.burst;
    int got = 0;
    while (got < burst && dip_cost_rig_truth(j->rig, j->path, j->place, got, no_progress, NULL,
                                             &j->truths[got], err)) {
        const DipSrgbPicture picture = picture_of(j, j->truths[got].rgba8);
        dip_flip_analyse(&j->flip, &picture, &j->sides[got]);
        got++;
    }
    const bool judged = got == burst && judge_rows(j, err);
    while (got > 0) {
        dip_truth_free(&j->truths[--got]);
    }
    return judged;
}

bool dip_cost_judge(DipCostRig *rig, DipError *err) {
    const DipCostReport *report = rig->report;
    const DipCostOptions *options = &report->options;
    Judging j;
    if (!open_judging(&j, rig, err)) {
        return false;
    }
    const int64_t total = (int64_t)report->row_count * (options->end_place - options->first_place);
    j.progress = dip_progress_begin("bursts judged", total);
    bool judged = true;
    for (j.path = 0; judged && j.path < report->path_count; j.path++) {
        for (j.place = options->first_place; judged && j.place < options->end_place; j.place++) {
            judged = judge_place(&j, err);
        }
    }
    dip_progress_end(&j.progress, j.done);
    close_judging(&j);
    return judged;
}
