// The command `diptych cost advise`: one choice of settings for several reports.
#include "app/cost/advise_options.h"
#include "app/cost/advise_output.h"
#include "app/cost/command.h"
#include "renderer/base/assert.h"

#include <stdlib.h>

static bool advise(const DipCostAdviseArguments *arguments, const DipCostCommon *common,
                   DipError *err) {
    const int count = arguments->cost.budget_count;
    DipCostCommonAdvice *advice = malloc((size_t)count * sizeof *advice);
    if (!advice) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost advise", "out of memory");
    }
    for (int i = 0; i < count; i++) {
        dip_cost_common_advise(common, arguments->cost.budgets_ms[i], &advice[i]);
    }
    dip_cost_common_print(common, advice, count, stdout);
    const bool done = !arguments->json || dip_cost_common_write_json(common, advice, count,
                                                                     arguments->json, err);
    free(advice);
    return done;
}

static bool run(DipSession *session, const void *all_arguments, DipError *err) {
    (void)session;
    const DipCostAdviseArguments *arguments = all_arguments;
    DipCostCommon common;
    const bool done =
        dip_cost_common_read(&common, arguments->reports, arguments->report_count,
                             arguments->cost.budget_of, err) &&
        advise(arguments, &common, err);
    dip_cost_common_free(&common);
    return done;
}

static const DipExample examples[] = {
    {"diptych cost advise indoors outdoors --budget-ms 8,16.6",
     "chooses the settings that are within 8 ms, and within 16.6 ms, in both reports"},
    {"diptych cost advise */cost.json --budget-ms 4,8,16,33 --json tiers.json",
     "makes the tiers low, medium, high and ultra for all scenes of a product"},
};

const DipCommand dip_cost_advise_command = {
    .name = "cost advise",
    .summary = "choose one set of settings for several scenes, paths or sizes",
    .usage = "REPORT... --budget-ms LIST [OPTION]...",
    .text =
        "Cost advise reads reports (each a cost.json, or a folder that has one), each with its own "
        "scene, camera path, size or machine. For each time budget, it chooses the combination of "
        "settings with the least FLIP, as a mean over the reports, that is surely within the "
        "budget in every report.\n\n"
        "It also prints the settings that each report alone would choose, how much error the "
        "common choice costs there, and which report stands in the way of better settings. Only "
        "combinations that every report has measured can be chosen, so measure all reports with "
        "the same --combine.\n\n"
        "The exit code is 2 if a report cannot be used, and 3 if a report comes from a machine "
        "that was too busy.",
    .examples = examples,
    .example_count = DIP_ARRAY_COUNT(examples),
    .parts = &dip_cost_advise_option_parts,
    .operands = {offsetof(DipCostAdviseArguments, reports),
                 offsetof(DipCostAdviseArguments, report_count), DIP_COST_MAX_COMMON_REPORTS},
    .options_size = sizeof(DipCostAdviseArguments),
    .check = dip_cost_advise_options_check,
    .run = run,
};
