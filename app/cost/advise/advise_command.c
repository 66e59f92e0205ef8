// Runs the command `diptych cost advise`: for each time budget, chooses one combination of settings
// for all given reports.
#include "app/cost/advise/common_advice.h"
#include "app/cost/command.h"
#include "app/cost/options.h"
#include "renderer/base/assert.h"

#include <stdlib.h>

// The whole command line. Texts are borrowed from argv.
typedef struct Arguments {
    DipProgramOptions program;
    DipCostOptions cost; // Only the budgets and budget_of are used.
    const char *reports[DIP_COST_MAX_COMMON_REPORTS];
    int report_count;
    const char *json; // File for the advice, or NULL.
} Arguments;

static const DipOptionPart parts[] = {
    {&dip_cost_budget_option_table, offsetof(Arguments, cost)},
    {&dip_json_option_table, offsetof(Arguments, json)},
    {&dip_program_option_table, offsetof(Arguments, program)},
};
static const DipOptionParts option_parts = {parts, DIP_ARRAY_COUNT(parts)};

static bool check(const void *arguments, DipError *err) {
    return ((const Arguments *)arguments)->report_count > 0 ||
           dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "cost advise",
                         "there are no reports; give the cost.json of each: cost advise "
                         "REPORT...");
}

static bool advise(const Arguments *arguments, const DipCostCommon *common,
                   DipCostCommonAdvice *advice, DipError *err) {
    DipCostOptions budgets = arguments->cost;
    dip_cost_default_budgets(&budgets);
    for (int i = 0; i < budgets.budget_count; i++) {
        dip_cost_common_advise(common, budgets.budgets_ms[i], &advice[i]);
    }
    dip_cost_common_print(common, advice, budgets.budget_count, stdout);
    return !arguments->json ||
           dip_cost_common_write_json(common, advice, budgets.budget_count, arguments->json, err);
}

static bool run(DipSession *session, const void *all_arguments, DipError *err) {
    (void)session;
    const Arguments *arguments = all_arguments;
    DipCostCommon common = {.reports = NULL};
    DipCostCommonAdvice *advice = calloc(DIP_COST_MAX_BUDGETS, sizeof *advice);
    const bool done =
        (advice || dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost advise", "out of memory")) &&
        dip_cost_common_read(&common, arguments->reports, arguments->report_count,
                             arguments->cost.budget_of, err) &&
        advise(arguments, &common, advice, err);
    dip_cost_common_free(&common);
    free(advice);
    return done;
}

static const DipExample examples[] = {
    {"diptych cost advise indoors outdoors --fps 60,120",
     "chooses the settings that keep 60, and 120, frames a second in both reports"},
    {"diptych cost advise report --budget-ms 12 --budget-of mean",
     "chooses settings whose mean time is within 12 ms"},
    {"diptych cost advise */cost.json --budget-ms 4,8,16,33 --json tiers.json",
     "makes the tiers low, medium, high and ultra for all scenes of a product"},
};

const DipCommand dip_cost_advise_command = {
    .name = "cost advise",
    .summary = "choose one set of settings for several scenes, paths or sizes",
    .usage = "REPORT... [OPTION]...",
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
    .parts = &option_parts,
    .operands = {offsetof(Arguments, reports), offsetof(Arguments, report_count),
                 DIP_COST_MAX_COMMON_REPORTS},
    .options_size = sizeof(Arguments),
    .check = check,
    .run = run,
};
