// `diptych cost`: drawing the truths (converged pictures), measuring errors and times, writing the
// report.
#include "app/cost/cost.h"

#include "app/cost/drawn_frames.h"
#include "app/report/analysis.h"
#include "app/report/format/formats.h"
#include "app/report/page/html.h"
#include "app/report/page/report_pictures.h"
#include "app/report/same_pictures.h"
#include "app/cost/starts.h"
#include "app/cost/steps.h"
#include "app/cost/truth_files.h"
#include "app/files/folder.h"
#include "app/cli/interrupt.h"

#include <limits.h>
#include <stdio.h>
#include <time.h>

static bool write_file(const DipCostReport *report, const char *folder, const char *name,
                       bool (*write)(const DipCostReport *, const char *, DipError *),
                       DipError *err) {
    char file[PATH_MAX];
    const int length = snprintf(file, sizeof file, "%s/%s", folder, name);
    if (length < 0 || (size_t)length >= sizeof file) {
        return dip_error_set_runtime(err, DIP_ERROR_OVERSIZED, folder, 0, "--out",
                                     "the name is too long");
    }
    return write(report, file, err);
}

static bool write_page(const DipCostReport *report, const DipCostFrameSource *source,
                       const char *folder, DipError *err) {
    char file[PATH_MAX];
    DipCostPictures pictures;
    if (snprintf(file, sizeof file, "%s/cost.html", folder) >= (int)sizeof file) {
        return dip_error_set_runtime(err, DIP_ERROR_OVERSIZED, folder, 0, "--out",
                                     "the name is too long");
    }
    if (!dip_cost_pictures_make(&pictures, report, source, err)) {
        return false;
    }
    const bool written = dip_cost_write_html(report, &pictures, file, err);
    dip_cost_pictures_free(&pictures);
    return written;
}

bool dip_cost_write_report(const DipCostReport *report, const DipCostFrameSource *source,
                           const char *folder, DipError *err) {
    return write_page(report, source, folder, err) &&
           write_file(report, folder, "cost.csv", dip_cost_write_csv, err) &&
           write_file(report, folder, "cost.json", dip_cost_write_json, err);
}

bool dip_cost_find_cache(const char *given, char folder[PATH_MAX], DipError *err) {
    if (given) {
        snprintf(folder, PATH_MAX, "%s", given);
    } else if (!dip_truth_default_folder(folder, PATH_MAX)) {
        folder[0] = '\0';
    }
    return !folder[0] || dip_folder_make(folder, "--cache", err);
}

static bool measure(DipCostContext *cost, DipError *err) {
    const DipCostOptions *options = &cost->report->options;
    if (!dip_cost_make_truths(cost, err)) {
        return false;
    }
    if (options->predict) {
        return dip_cost_predict(cost, err) && dip_cost_advise(cost, err);
    }
    return dip_cost_judge(cost, err) && dip_cost_join_same_pictures(cost->report, err) &&
           (options->errors_only ||
            (dip_cost_time_rows(cost, err) && dip_cost_time_smaller(cost, err) &&
             dip_cost_advise(cost, err)));
}

// Writes the time of day into the report.
static void set_date(DipCostReport *report) {
    const time_t now = time(NULL);
    struct tm utc;
    if (gmtime_r(&now, &utc)) {
        strftime(report->date, sizeof report->date, "%Y-%m-%dT%H:%M:%SZ", &utc);
    }
}

// Writes the truths if --save-truths asks for them.
static bool save_truths(DipCostContext *cost, DipError *err) {
    const char *folder = cost->report->options.truths;
    return !folder || dip_cost_save_truths(cost, folder, err);
}

static bool run(DipSession *session, const DipCostArguments *arguments, DipCostReport *report,
                DipError *err) {
    char plan[33];
    char cache[PATH_MAX];
    DipCostContext cost;
    if (!dip_cost_find_cache(arguments->cost.cache, cache, err) ||
        !dip_folder_make(arguments->out, "--out", err)) {
        return false;
    }
    dip_cost_plan_hash(report, session, plan);
    DipCostJournal *journal = dip_cost_journal_open(arguments->out, plan, err);
    if (!journal || !dip_cost_context_open(&cost, session, report, journal, cache[0] ? cache : NULL,
                                           true, err)) {
        dip_cost_journal_close(&journal, false);
        return false;
    }
    cost.argv = arguments->argv;
    cost.argc = arguments->argc;
    bool done = measure(&cost, err);
    if (done) {
        set_date(report);
        const DipCostFrameSource source = dip_cost_drawn_frames(&cost);
        done = save_truths(&cost, err) && dip_cost_analyse(report, err) &&
               dip_cost_write_report(report, &source, arguments->out, err);
    }
    dip_cost_context_close(&cost);
    dip_cost_journal_close(&journal, done);
    if (done) {
        dip_cost_print(report, stdout);
        printf("\nWritten: %s/cost.html, cost.csv, cost.json\n", arguments->out);
    }
    const bool wrong = report->rounds > 0 && report->verdict == DIP_COST_RED;
    if (done && wrong && report->options.require_quiet) {
        return dip_error_set_runtime(err, DIP_ERROR_RUNTIME, NULL, 0, "--require-quiet",
                                     "the times are wrong. %s", report->verdict_reason);
    }
    return done;
}

// Times frames for the process that started this one.
static bool serve(DipSession *session, DipCostReport *report, DipError *err) {
    DipCostContext cost;
    if (!dip_cost_context_open(&cost, session, report, NULL, NULL, false, err)) {
        return false;
    }
    const bool done = dip_cost_serve(&cost, err);
    dip_cost_context_close(&cost);
    return done;
}

bool dip_cost_run(DipSession *session, const DipCostArguments *arguments, DipError *err) {
    DipCostReport report;
    DipCostOptions options = arguments->cost;
    dip_cost_set_measure(&options, &arguments->measure);
    if (!arguments->serve) {
        dip_interrupt_watch(); // A start ends with the process that started it.
    }
    const bool done =
        dip_cost_plan(&report, session, &options, err) &&
        (arguments->serve ? serve(session, &report, err) : run(session, arguments, &report, err));
    dip_cost_report_free(&report);
    return done;
}
