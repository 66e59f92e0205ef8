// The options of `diptych cost advise`.
#include "app/cost/advise/advise_options.h"

#include "app/report/segments.h"
#include "renderer/base/assert.h"

static const DipOptionRow budget_rows[] = {
    {.name = "--budget-ms",
     .argument = "LIST",
     .text = "Choose settings for each of these time budgets. A budget is in milliseconds per "
             "frame, such as 8,16.6. Four budgets are also printed as the tiers low, medium, high "
             "and ultra.",
     .kind = DIP_OPTION_LIST,
     .count = offsetof(DipCostOptions, budget_count),
     .most = DIP_COST_MAX_BUDGETS,
     .separator = ',',
     .read = dip_cost_read_budget},
    {.name = "--budget-of",
     .argument = "TIME",
     .text = "The time that must be within the budget in every report: p95 (the 95th percentile of "
             "the frames along the path), mean or worst. The default is p95.",
     .kind = DIP_OPTION_CUSTOM,
     .read = dip_cost_read_budget_of},
};

static const DipOptionRow output_rows[] = {
    {.name = "--segments",
     .argument = "N",
     .text = "With one report: also choose settings for each of N segments of the camera path. The "
             "default is the number of viewpoints of the report, but at most 8. With 1, the path "
             "is not divided.",
     .kind = DIP_OPTION_INTEGER,
     .field = offsetof(DipCostAdviseArguments, segments),
     .given = offsetof(DipCostAdviseArguments, has_segments),
     .least = 1,
     .most = DIP_COST_MAX_SEGMENTS},
    {.name = "--json",
     .argument = "FILE",
     .text = "Also write the advice to this file.",
     .kind = DIP_OPTION_TEXT,
     .field = offsetof(DipCostAdviseArguments, json)},
};

static const DipOptionTable budget_table = {"Budgets", budget_rows, DIP_ARRAY_COUNT(budget_rows)};
static const DipOptionTable output_table = {"Segments and output", output_rows,
                                            DIP_ARRAY_COUNT(output_rows)};

static const DipOptionPart parts[] = {
    {&budget_table, offsetof(DipCostAdviseArguments, cost)},
    {&output_table, 0},
    {&dip_program_option_table, offsetof(DipCostAdviseArguments, program)},
};
const DipOptionParts dip_cost_advise_option_parts = {parts, DIP_ARRAY_COUNT(parts)};

bool dip_cost_advise_options_check(const void *arguments, DipError *err) {
    const DipCostAdviseArguments *advise = arguments;
    if (advise->report_count == 0) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "cost advise",
                             "there are no reports; give the cost.json of each: cost advise "
                             "REPORT... --budget-ms LIST");
    }
    if (advise->segments > 1 && advise->report_count > 1) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "--segments",
                             "only the path of a single report is divided; give one report, or "
                             "leave out --segments");
    }
    return advise->cost.budget_count > 0 ||
           dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "--budget-ms",
                         "there is no budget; give one or more, such as --budget-ms 8,16.6");
}
