// The options of `diptych cost predict`.
#include "app/cost/predict/predict_options.h"

#include "renderer/base/assert.h"

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
const DipOptionParts dip_cost_predict_option_parts = {parts, DIP_ARRAY_COUNT(parts)};

void dip_cost_predict_options_default(void *arguments, int argc, char *const *argv) {
    (void)argc;
    (void)argv;
    ((DipCostPredictArguments *)arguments)->timed = 6;
}

bool dip_cost_predict_options_check(const void *arguments, DipError *err) {
    const DipCostPredictArguments *all = arguments;
    if (all->report_count == 0) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "cost predict",
                             "there is no report; give the cost.json of one: cost predict REPORT "
                             "--size WxH");
    }
    return dip_session_options_check(&all->session, err);
}
