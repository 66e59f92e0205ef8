// Runs the command `diptych cost`: draws the truths (converged pictures), measures errors and
// times, and writes the report.
#include "app/report/analysis.h"
#include "app/report/format/formats.h"
#include "app/report/page/html.h"
#include "app/report/page/report_pictures.h"
#include "app/cost/command.h"
#include "app/cost/steps.h"
#include "app/files/whole_file.h"
#include "app/cli/progress.h"
#include "renderer/base/assert.h"

#include <stdio.h>
#include <time.h>

bool dip_cost_write_report(const DipCostReport *report, const DipCostFrameSource *source,
                           const char *folder, DipError *err) {
    char html[PATH_MAX], csv[PATH_MAX], json[PATH_MAX];
    DipCostPictures pictures;
    snprintf(html, sizeof html, "%s/cost.html", folder);
    snprintf(csv, sizeof csv, "%s/cost.csv", folder);
    if (snprintf(json, sizeof json, "%s/cost.json", folder) >= (int)sizeof json) {
        return dip_error_set_runtime(err, DIP_ERROR_OVERSIZED, folder, 0, "--out",
                                     "the name is too long");
    }
    if (!dip_cost_pictures_make(&pictures, report, source, err)) {
        return false;
    }
    const bool written = dip_cost_write_html(report, &pictures, html, err) &&
                         dip_cost_write_csv(report, csv, err) &&
                         dip_cost_write_json(report, json, err);
    dip_cost_pictures_free(&pictures);
    return written;
}

bool dip_cost_find_cache(const char *given, char folder[PATH_MAX], DipError *err) {
    if (given) {
        snprintf(folder, PATH_MAX, "%s", given);
    } else if (!dip_truth_default_folder(folder, PATH_MAX)) {
        folder[0] = '\0';
    }
    return !folder[0] || dip_folder_make(folder, "--cache", err);
}

// Measures the planned rows (plan.h), in a run without predictions.
static bool measure_rows(DipCostContext *cost, DipError *err) {
    dip_cost_begin_phase(cost, DIP_COST_PHASE_SWEEPS);
    if (!dip_cost_judge(cost, err) || !dip_cost_join_same_pictures(cost->report, err)) {
        return false;
    }
    dip_cost_begin_phase(cost, DIP_COST_PHASE_TIMES);
    return cost->report->options.errors_only ||
           (dip_cost_time_rows(cost, err) && dip_cost_time_smaller(cost, err));
}

static bool measure(DipCostContext *cost, DipError *err) {
    const DipCostOptions *options = &cost->report->options;
    if (!options->errors_only && !dip_cost_look_at_machine(cost, err)) {
        return false;
    }
    dip_cost_forecast_begin(cost);
    dip_cost_begin_phase(cost, DIP_COST_PHASE_TRUTHS);
    if (!dip_cost_make_truths(cost, err) ||
        !(options->predict ? dip_cost_predict(cost, err) : measure_rows(cost, err))) {
        return false;
    }
    dip_cost_begin_phase(cost, DIP_COST_PHASE_ADVICE);
    const bool advised = options->errors_only || dip_cost_advise(cost, err);
    dip_cost_begin_phase(cost, DIP_COST_PHASE_PAGE);
    return advised;
}

// Writes the current date and time into the report.
static void set_date(DipCostReport *report) {
    const time_t now = time(NULL);
    struct tm utc;
    if (gmtime_r(&now, &utc)) {
        strftime(report->date, sizeof report->date, "%Y-%m-%dT%H:%M:%SZ", &utc);
    }
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
    if (!journal || !dip_cost_context_open(&cost, session, report, true, err)) {
        dip_cost_journal_close(&journal, false);
        return false;
    }
    cost.journal = journal;
    cost.cache = cache;
    cost.start = &arguments->program;
    bool done = measure(&cost, err);
    if (done) {
        set_date(report);
        const DipCostFrameSource source = dip_cost_drawn_frames(&cost);
        done = dip_cost_analyse(report, err) &&
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
    if (!dip_cost_context_open(&cost, session, report, false, err)) {
        return false;
    }
    const bool done = dip_cost_serve(&cost, err);
    dip_cost_context_close(&cost);
    return done;
}

static bool run_command(DipSession *session, const void *options_given, DipError *err) {
    const DipCostArguments *arguments = options_given;
    DipCostReport report;
    DipCostOptions options = arguments->cost;
    options.rounds = arguments->measure.rounds * arguments->measure.starts;
    options.starts = arguments->measure.starts;
    options.has_seed = arguments->measure.has_seed;
    options.seed = dip_measure_seed(&arguments->measure);
    if (!arguments->serve) {
        dip_interrupt_watch(); // A process that serves is ended by the one that started it.
    }
    const bool done =
        dip_cost_plan(&report, session, &options, err) &&
        (arguments->serve ? serve(session, &report, err) : run(session, arguments, &report, err));
    dip_cost_report_free(&report);
    return done;
}

static void describe_cost(const void *all_arguments, DipSessionDef *def) {
    const DipCostArguments *arguments = all_arguments;
    def->options = &arguments->session;
    def->scene = true;
    def->warnings_are_known = arguments->serve;
    def->keep_model = true; // The reference renderer draws the truths from the model.
}

static const DipExample cost_examples[] = {
    {"diptych cost --out report", "measures the courtyard in a few minutes"},
    {"diptych cost --out report --quick", "answers in a minute or two, less surely"},
    {"diptych cost --out report --fps 60,120",
     "finds the best of all combinations of settings for 60 and for 120 frames a second"},
    {"diptych cost --out report --combine aa,af --budget-ms 4,8,16,33",
     "measures every combination of two settings and chooses for four budgets"},
    {"diptych cost --out report --model scene.glb --size 1280x720", "measures your own model"},
    {"diptych cost --out part0 --places 8 --part 0:4",
     "measures the errors at half of the viewpoints"},
    {"diptych cost --out part1 --places 8 --part 4:8 --errors-only",
     "measures the errors at the other half, on another machine"},
    {"diptych cost merge --out report part0/cost.json part1/cost.json", "joins the two parts"},
};

const DipCommand dip_cost_command = {
    .name = "cost",
    .summary = "report what each setting costs in time and buys in accuracy",
    .usage = "--out DIR [OPTION]...",
    .text = "Cost changes one setting at a time. It measures how much longer a frame takes, and "
            "how much closer the picture comes to the converged picture, which has very many "
            "samples per pixel. It writes a report with tables, plots and pictures.\n\n"
            "A run takes minutes. To continue an interrupted run, give the same command again. "
            "docs/cost-methods.md defines every number in the report.",
    .examples = cost_examples,
    .example_count = DIP_ARRAY_COUNT(cost_examples),
    .lists_settings = true,
    .parts = &dip_cost_option_parts,
    .options_size = sizeof(DipCostArguments),
    .set_defaults = dip_cost_options_default,
    .check = dip_cost_options_check,
    .describe_session = describe_cost,
    .run = run_command,
};
