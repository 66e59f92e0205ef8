// The command `diptych cost advise`: one choice of settings for several reports, and a choice for
// each segment of the path of one report.
#include "app/cost/advise/advise_options.h"
#include "app/cost/advise/advise_output.h"
#include "app/cost/command.h"
#include "renderer/base/assert.h"

#include <stdlib.h>

// All advice: for the reports together and, if there is one report, for the segments of its path.
typedef struct Advice {
    DipCostCommonAdvice common[DIP_COST_MAX_BUDGETS];
    DipCostSegments segments;
    DipCostSegmentAdvice by_segment[DIP_COST_MAX_BUDGETS];
} Advice;

static bool advise_segments(const DipCostReport *report, int count, const DipCostOptions *budgets,
                            Advice *advice, DipError *err) {
    bool done = dip_cost_segments_make(report, count, &advice->segments, err);
    for (int i = 0; done && i < budgets->budget_count; i++) {
        done = dip_cost_segments_advise(report, &advice->segments, budgets->budgets_ms[i],
                                        &advice->by_segment[i], err);
    }
    return done;
}

static bool advise(const DipCostAdviseArguments *arguments, const DipCostCommon *common,
                   Advice *advice, DipError *err) {
    const DipCostOptions *budgets = &arguments->cost;
    const DipCostReport *report = &common->reports[0];
    for (int i = 0; i < budgets->budget_count; i++) {
        dip_cost_common_advise(common, budgets->budgets_ms[i], &advice->common[i]);
    }
    const int wanted =
        arguments->has_segments ? arguments->segments : dip_cost_default_segments(report);
    const bool divides = common->report_count == 1 && wanted > 1;
    const DipCostSegmentList list = {report, &advice->segments, advice->by_segment,
                                     budgets->budget_count};
    if (divides && !advise_segments(report, wanted, budgets, advice, err)) {
        return false;
    }
    dip_cost_common_print(common, advice->common, budgets->budget_count, stdout);
    if (divides) {
        dip_cost_segments_print(&list, stdout);
    }
    return !arguments->json ||
           dip_cost_common_write_json(common, advice->common, budgets->budget_count,
                                      divides ? &list : NULL, arguments->json, err);
}

static bool run(DipSession *session, const void *all_arguments, DipError *err) {
    (void)session;
    const DipCostAdviseArguments *arguments = all_arguments;
    DipCostCommon common = {.reports = NULL};
    Advice *advice = calloc(1, sizeof *advice);
    const bool done =
        (advice || dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost advise", "out of memory")) &&
        dip_cost_common_read(&common, arguments->reports, arguments->report_count,
                             arguments->cost.budget_of, err) &&
        advise(arguments, &common, advice, err);
    dip_cost_common_free(&common);
    if (advice) {
        dip_cost_segments_free(&advice->segments);
    }
    free(advice);
    return done;
}

static const DipExample examples[] = {
    {"diptych cost advise indoors outdoors --budget-ms 8,16.6",
     "chooses the settings that are within 8 ms, and within 16.6 ms, in both reports"},
    {"diptych cost advise report --budget-ms 16.6 --budget-of mean --segments 4",
     "also chooses settings for each quarter of the path, so that its mean time is within 16.6 ms"},
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
        "With one report, it also divides the camera path into segments and chooses settings for "
        "each, so that time is spent where it lowers the error most.\n\n"
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
