// The options of `diptych cost advise`.
#include "app/cost/advise/advise_options.h"

#include "renderer/base/assert.h"

static const DipOptionPart parts[] = {
    {&dip_cost_budget_option_table, offsetof(DipCostAdviseArguments, cost)},
    {&dip_json_option_table, offsetof(DipCostAdviseArguments, json)},
    {&dip_program_option_table, offsetof(DipCostAdviseArguments, program)},
};
const DipOptionParts dip_cost_advise_option_parts = {parts, DIP_ARRAY_COUNT(parts)};

bool dip_cost_advise_options_check(const void *arguments, DipError *err) {
    const DipCostAdviseArguments *advise = arguments;
    if (advise->report_count == 0) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "cost advise",
                             "there are no reports; give the cost.json of each: cost advise "
                             "REPORT...");
    }
    return true;
}
