// Runs the command `diptych cost predict`: reads its options, predicts times
// (predict_elsewhere.h), prints them and writes them to files.
#include "app/cost/command.h"
#include "app/cost/predict/predict_elsewhere.h"
#include "app/cli/progress.h"
#include "renderer/base/assert.h"

#include <stdlib.h>

// --- options -------------------------------------------------------------------------------------

#define FIELD(name) offsetof(DipCostPredictArguments, name)

static const DipOptionRow prediction_rows[] = {
    {"--time", "N", DIP_OPTION_INTEGER, FIELD(timed), .most = DIP_COST_MOST_TIMED,
     .text =
         "Time this many combinations there, those that tell most about all others, and predict "
         "the others from these and from the report. With 0, nothing is timed and the predictions "
         "come from the report alone. The default is 6."},
    {"--check", "N", DIP_OPTION_INTEGER, FIELD(checked), .most = DIP_COST_MOST_TIMED,
     .text =
         "Then time this many other combinations, spread evenly over the list, and tell how far "
         "their predictions lie from them. The default is 0."},
    {"--csv", "FILE", DIP_OPTION_TEXT, FIELD(csv),
     .text = "Also write a line per combination to this file."},
};

static const DipOptionTable prediction_table = DIP_OPTION_TABLE("Predicting", prediction_rows);

static const DipOptionPart parts[] = {
    {&prediction_table, 0},
    {&dip_json_option_table, FIELD(json)},
    {&dip_scene_option_table, FIELD(session)},
    {&dip_path_option_table, FIELD(session)},
    {&dip_category_option_table, FIELD(session)},
    {&dip_size_option_table, FIELD(session)},
    {&dip_threads_option_table, FIELD(session)},
    {&dip_program_option_table, FIELD(program)},
};
static const DipOptionParts option_parts = {parts, DIP_ARRAY_COUNT(parts)};

static void set_defaults(void *arguments) {
    ((DipCostPredictArguments *)arguments)->timed = 6;
}

static bool check(const void *arguments, DipError *err) {
    const DipCostPredictArguments *all = arguments;
    if (all->report_count == 0) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "cost predict",
                             "there is no report; give the cost.json of one: cost predict REPORT "
                             "--size WxH");
    }
    return dip_session_options_check(&all->session, err);
}

// --- the command ---------------------------------------------------------------------------------

static bool run(DipSession *session, const void *all_arguments, DipError *err) {
    const DipCostPredictArguments *arguments = all_arguments;
    DipCostElsewherePrediction *prediction = calloc(1, sizeof *prediction);
    if (!prediction) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost predict", "out of memory");
    }
    dip_interrupt_watch();
    bool done = dip_cost_predict_there(prediction, session, arguments, err);
    if (done) {
        dip_cost_predict_there_print(prediction, stdout);
        done =
            (!arguments->json ||
             dip_cost_predict_there_write_json(prediction, arguments->json, err)) &&
            (!arguments->csv || dip_cost_predict_there_write_csv(prediction, arguments->csv, err));
    }
    dip_cost_predict_there_free(prediction);
    free(prediction);
    return done;
}

static void describe(const void *arguments, DipSessionDef *def) {
    def->options = &((const DipCostPredictArguments *)arguments)->session;
    def->scene = true;
    def->keep_model = true; // The hash of the scene comes from the model.
}

static const DipExample examples[] = {
    {"diptych cost predict report --size 1920x1080",
     "predicts all combinations of the report in full HD, and times six of them there"},
    {"diptych cost predict report --size 1920x1080 --time 0",
     "predicts them from the report alone, without timing anything"},
    {"diptych cost predict report --category AAA --csv aaa.csv",
     "predicts them on the camera path AAA, and writes a table for other programs"},
    {"diptych cost predict report --size 320x240 --check 20",
     "also times twenty combinations to tell how far the predictions lie from them"},
};

const DipCommand dip_cost_predict_command = {
    .name = "cost predict",
    .summary = "predict a report's times at another size, path or thread count",
    .usage = "REPORT [--size WxH] [OPTION]...",
    .text =
        "Cost predict reads a report (a cost.json, or a folder that has one) of the same scene. It "
        "counts the work of all its combinations of settings at another size, on another camera "
        "path or with another number of threads, and predicts their times from the report's prices "
        "of work.\n\n"
        "Then it times six of them there (--time), each beside the report's baseline, so that all "
        "times are milliseconds of the report's run, however fast the machine is today. Prices are "
        "fitted anew to the report and to these six, and predict all others. How far the six are "
        "missed, each predicted from the report and the five others, tells how good the "
        "predictions are. docs/cost-methods.md tells what was measured.\n\n"
        "Errors are not predicted.",
    .examples = examples,
    .example_count = DIP_ARRAY_COUNT(examples),
    .parts = &option_parts,
    .operands = {FIELD(report), FIELD(report_count), 1},
    .options_size = sizeof(DipCostPredictArguments),
    .set_defaults = set_defaults,
    .check = check,
    .describe_session = describe,
    .run = run,
};
