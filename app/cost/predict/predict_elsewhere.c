// Counts the work of a report's combinations "there" (predict_elsewhere.h): at another size, on
// another camera path, or with other threads or another instruction set. Times a few of them there,
// and predicts the times of all from the price of each kind of work.
#include "app/cost/predict/predict_elsewhere.h"

#include "app/report/format/formats.h"
#include "app/cost/steps.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- the report ----------------------------------------------------------------------------------

// Checks that the report has times, and that its scene and its path 0 are those of the session.
static bool check_report(const DipCostReport *report, const DipSession *session, const char *name,
                         DipError *err) {
    DipCostReport now = {.options = report->options, .path_count = 1};
    memcpy(now.paths[0], report->paths[0], sizeof now.paths[0]);
    dip_cost_describe(&now, session);
    if (strcmp(now.scene_hash, report->scene_hash) != 0) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, name, 0, NULL,
                             "is of another scene (%.100s) or of other files of it than %.100s; "
                             "give its --config, --model or --scene",
                             report->scene, now.scene);
    }
    if (report->rounds == 0) {
        return dip_error_set(err, DIP_ERROR_MISSING, name, 0, NULL,
                             "has no times; measure the report without --errors-only");
    }
    dip_cost_hash_path(&now, session, 0);
    return strcmp(now.path_hashes[0], report->path_hashes[0]) == 0 ||
           dip_error_set(
               err, DIP_ERROR_CONFLICT, name, 0, NULL,
               "has another camera path %.15s than the scene has now; give its --path, or "
               "measure the report again",
               report->paths[0]);
}

static void add_combination(DipCostElsewherePrediction *p, const DipQuality *quality, double ms) {
    p->list[p->count++] =
        (DipCostPredictedThere){.quality = *quality, .report_ms = ms, .timed = -1};
    p->there.predicted.list[p->there.predicted.count++] =
        (DipCostPrediction){.quality = *quality, .row = -1};
}

// Lists the report's combinations on path 0: first the measured combinations, then the combinations
// that were only predicted.
static bool list_combinations(DipCostElsewherePrediction *p, const char *name, DipError *err) {
    const DipCostReport *report = &p->report;
    const size_t most = (size_t)report->row_count + (size_t)report->predicted.count + 1;
    p->list = calloc(most, sizeof *p->list);
    p->there.predicted.list = calloc(most, sizeof *p->there.predicted.list);
    if (!p->list || !p->there.predicted.list) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost predict", "out of memory");
    }
    for (int r = report->combined_first; r < report->row_count; r++) {
        if (report->rows[r].path == 0) {
            add_combination(p, &report->rows[r].quality, dip_cost_ms(report, r));
        }
    }
    for (int i = 0; i < report->predicted.count; i++) {
        const DipCostPrediction *prediction = &report->predicted.list[i];
        if (prediction->row < 0) {
            add_combination(p, &prediction->quality, prediction->ms);
        }
    }
    return p->count > 0 ||
           dip_error_set(err, DIP_ERROR_MISSING, name, 0, NULL,
                         "has no combinations of settings; measure the report with --combine or "
                         "--predict");
}

// --- counting ------------------------------------------------------------------------------------

// Mends the counters, which come from only a few of the timed frames. Counts the work of one
// combination in all timed frames: of the baseline, or of the first combination if the baseline is
// not listed. Then scales the counters of all combinations by the ratio of this combination's work
// in all frames to its work in the few frames.
static bool scale_counters(DipCostContext *there, DipError *err) {
    DipCostReport *report = there->report;
    const int found = dip_report_find_predicted(&report->predicted, &report->options.baseline);
    const DipCostPrediction few = report->predicted.list[found >= 0 ? found : 0];
    double all[DIP_COUNTER_COUNT];
    if (!dip_cost_count(there, &few.quality, dip_cost_frame_count(report), all, err)) {
        return false;
    }
    for (int c = 0; c < DIP_COUNTER_COUNT; c++) {
        const double scale = few.counters[c] > 0.0 ? all[c] / few.counters[c] : 1.0;
        for (int i = 0; i < report->predicted.count; i++) {
            report->predicted.list[i].counters[c] *= scale;
        }
    }
    return true;
}

// --- timing --------------------------------------------------------------------------------------

static void add_timed(DipCostElsewherePrediction *p, int index) {
    p->list[index].timed = p->timed_count + p->checked_count;
    p->timed[p->list[index].timed].quality = p->list[index].quality;
}

// Chooses the combinations to time there: first the combinations to which prices are fitted, which
// tell most about all others, and then combinations to check, spread evenly over the rest of the
// list.
static bool choose_timed(DipCostElsewherePrediction *p, int timed, int checked, DipError *err) {
    int chosen[DIP_COST_MAX_ROWS];
    const int most = timed < p->count ? timed : p->count;
    if (most > 0 && !dip_cost_choose_timed(&p->there, most, chosen, err)) {
        return false;
    }
    for (int i = 0; i < most; i++) {
        add_timed(p, chosen[i]);
        p->timed_count++;
    }
    const int left = p->count - most;
    const int wanted = checked < left ? checked : left;
    int seen = 0;
    for (int i = 0; i < p->count; i++) {
        if (p->list[i].timed < 0) {
            // The rest is divided into `wanted` equal parts, and the first of each is taken.
            if (p->checked_count < wanted &&
                (int64_t)seen * wanted >= (int64_t)p->checked_count * left) {
                add_timed(p, i);
                p->checked_count++;
            }
            seen++;
        }
    }
    return true;
}

static bool time_there(DipCostElsewherePrediction *p, DipCostContext *here, DipCostContext *there,
                       const DipCostPredictArguments *arguments, DipError *err) {
    if (!choose_timed(p, arguments->timed, arguments->checked, err)) {
        return false;
    }
    const int count = p->timed_count + p->checked_count;
    return count == 0 ||
           dip_cost_time_elsewhere(here, there, p->timed, count, "frames timed", &p->wait, err);
}

// --- predicting and judging ----------------------------------------------------------------------

// Whether "there" has the size, camera path, threads and instruction set of the report.
static bool is_same_place(const DipCostReport *report, const DipCostReport *there) {
    return report->width == there->width && report->height == there->height &&
           report->threads == there->threads && strcmp(report->isa, there->isa) == 0 &&
           strcmp(report->paths[0], there->paths[0]) == 0;
}

// Fits prices to all rows of the report on all of its paths, to the combinations that the report
// timed at half its width and height (report->smaller), and to `count` combinations that were timed
// there.
static DipCostModel fit(const DipCostElsewherePrediction *p, const DipCostElsewhere *timed,
                        int count) {
    return dip_cost_model_fit_there(&p->report, NULL, p->report.row_count, timed, count,
                                    is_same_place(&p->report, &p->there));
}

static double predict(const DipCostElsewherePrediction *p, const DipCostModel *model, int index) {
    return dip_cost_model_value(model, p->there.predicted.list[index].counters,
                                &p->list[index].quality);
}

// Predicts one of the combinations to which prices are fitted as if it had not been timed: from the
// report and the others.
static double predict_left_out(const DipCostElsewherePrediction *p, int index) {
    DipCostElsewhere others[DIP_COST_MOST_TIMED];
    int count = 0;
    for (int i = 0; i < p->timed_count; i++) {
        if (i != p->list[index].timed) {
            others[count++] = p->timed[i];
        }
    }
    const DipCostModel model = fit(p, others, count);
    return predict(p, &model, index);
}

void dip_cost_predict_and_judge_there(DipCostElsewherePrediction *p) {
    const DipCostModel as_is_model = fit(p, NULL, 0);
    const DipCostModel fitted_model = fit(p, p->timed, p->timed_count);
    double as_is[2][DIP_COST_MOST_TIMED], fitted[2][DIP_COST_MOST_TIMED], logs[DIP_COST_MOST_TIMED];
    int count[2] = {0, 0}; // [0]: combinations to which prices are fitted; [1]: checked ones.
    for (int i = 0; i < p->count; i++) {
        DipCostPredictedThere *c = &p->list[i];
        c->as_is_ms = predict(p, &as_is_model, i);
        c->ms = predict(p, &fitted_model, i);
        if (c->timed >= 0) {
            const double ms = p->timed[c->timed].ms.value;
            const bool checked = c->timed >= p->timed_count;
            const int k = count[checked]++;
            if (!checked) {
                logs[k] = log(ms / c->as_is_ms);
            }
            as_is[checked][k] = fabs(c->as_is_ms / ms - 1.0);
            fitted[checked][k] = fabs((checked ? c->ms : predict_left_out(p, i)) / ms - 1.0);
        }
    }
    p->factor = count[0] > 0 ? exp(dip_median(logs, count[0])) : 1.0;
    p->timed_as_is = dip_cost_misses_of(as_is[0], count[0]);
    p->timed_left_out = dip_cost_misses_of(fitted[0], count[0]);
    p->checked_as_is = dip_cost_misses_of(as_is[1], count[1]);
    p->from_report = count[0] == 0 || p->timed_left_out.median > p->timed_as_is.median;
    p->checked_fitted = p->from_report ? p->checked_as_is : dip_cost_misses_of(fitted[1], count[1]);
    for (int i = 0; p->from_report && i < p->count; i++) {
        p->list[i].ms = p->list[i].as_is_ms;
    }
}

// --- the whole -----------------------------------------------------------------------------------

// A copy of the command's session for one of two places: "here", where the report was measured, or
// "there". It has the same scene, but the number of threads and the instruction set of its place.
typedef struct Place {
    DipSession session;
    DipPool *pool; // Owned; NULL if the pool of the command's session has the right number of
                   // threads.
} Place;

static bool open_place(Place *place, const DipSession *session, int threads, DipIsa isa,
                       DipError *err) {
    *place = (Place){.session = *session};
    place->session.isa = isa;
    if (threads != dip_pool_thread_count(session->pool)) {
        place->pool = dip_pool_create(threads, err);
        place->session.pool = place->pool;
    }
    return place->session.pool != NULL;
}

static bool find_isa(const DipCostReport *report, DipIsa *isa, const char *name, DipError *err) {
    return (dip_isa_parse(report->isa, isa) && dip_isa_available(*isa)) ||
           dip_error_set(err, DIP_ERROR_UNSUPPORTED, name, 0, "isa",
                         "'%.15s' is an instruction set that this machine does not have; measure "
                         "the report on this machine",
                         report->isa);
}

// Fills in the size, path, threads and instruction set of p->there. Each comes from the command
// line if the user gives it, otherwise from the report (`isa` is the report's instruction set).
static void describe_there(DipCostElsewherePrediction *p, const DipSession *session,
                           const DipSessionOptions *options, DipIsa isa) {
    const DipCostReport *report = &p->report;
    const bool sized = options->has_size;
    dip_cost_elsewhere_begin(&p->there, report, sized ? options->size.width : report->width,
                             sized ? options->size.height : report->height,
                             options->category ? dip_session_category(session->track.active)
                                               : report->paths[0]);
    p->there.threads =
        options->has_threads ? dip_pool_thread_count(session->pool) : report->threads;
    snprintf(p->there.isa, sizeof p->there.isa, "%s",
             dip_isa_name(options->has_isa ? session->isa : isa));
}

static bool measure(DipCostElsewherePrediction *p, Place *here, Place *there,
                    const DipCostPredictArguments *arguments, DipError *err) {
    DipCostContext base = {.session = NULL}, context = {.session = NULL};
    const bool done = dip_cost_context_open(&base, &here->session, &p->report, false, err) &&
                      dip_cost_context_open(&context, &there->session, &p->there, false, err) &&
                      dip_cost_count_combinations(&context, err) && scale_counters(&context, err) &&
                      time_there(p, &base, &context, arguments, err);
    dip_cost_context_close(&context);
    dip_cost_context_close(&base);
    return done;
}

bool dip_cost_predict_there(DipCostElsewherePrediction *p, const DipSession *session,
                            const DipCostPredictArguments *arguments, DipError *err) {
    DipIsa isa = session->isa;
    Place here = {.pool = NULL}, there = {.pool = NULL};
    *p = (DipCostElsewherePrediction){.factor = 1.0};
    if (!dip_cost_read_report(arguments->report, &p->report, err) ||
        !check_report(&p->report, session, arguments->report, err) ||
        !find_isa(&p->report, &isa, arguments->report, err)) {
        return false;
    }
    describe_there(p, session, &arguments->session, isa);
    bool done = list_combinations(p, arguments->report, err) &&
                open_place(&here, session, p->report.threads, isa, err) &&
                open_place(&there, session, p->there.threads,
                           arguments->session.has_isa ? session->isa : isa, err) &&
                measure(p, &here, &there, arguments, err);
    if (done) {
        p->fit = dip_cost_model_leave_one_out(&p->report, NULL, p->report.row_count);
        dip_cost_predict_and_judge_there(p);
    }
    dip_pool_destroy(&here.pool);
    dip_pool_destroy(&there.pool);
    return done;
}

void dip_cost_predict_there_free(DipCostElsewherePrediction *p) {
    dip_cost_report_free(&p->report);
    dip_cost_report_free(&p->there);
    free(p->list);
}
