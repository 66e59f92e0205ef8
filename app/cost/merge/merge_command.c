// The command cost merge: its help.
#include "app/cost/command.h"
#include "app/cost/cost.h"
#include "app/cost/options.h"
#include "app/session/session.h"
#include "renderer/base/assert.h"

static bool run_merge(DipSession *session, const void *arguments, DipError *err) {
    return dip_cost_merge_run(session, arguments, err);
}

static void describe_merge(const void *arguments, DipSessionDef *def) {
    const DipCostMergeArguments *merge = arguments;
    def->options = &merge->session;
    def->scene = merge->cost.pictures != DIP_COST_PICTURES_NONE;
    def->keep_model = def->scene; // The reference renderer draws the converged pictures.
}

static const DipExample merge_examples[] = {
    {"diptych cost merge --out report part0/cost.json part1/cost.json",
     "joins the parts that two machines measured"},
};

const DipCommand dip_cost_merge_command = {
    .name = "cost merge",
    .summary = "join the parts of a report that several machines measured",
    .usage = "--out DIR PART/cost.json...",
    .text = "Cost merge joins reports that have the same scene, size, settings, number of "
            "viewpoints (--places) and samples. Each report has the errors of some of the "
            "viewpoints (--part). The times come from the first report that has times, because "
            "times of different machines cannot be mixed. If several reports have times, a table "
            "compares their machines. The pictures of the page are drawn from the scene, which you "
            "name as for `cost`; with --pictures none no scene is needed.",
    .examples = merge_examples,
    .example_count = DIP_ARRAY_COUNT(merge_examples),
    .parts = &dip_cost_merge_option_parts,
    .operands = {offsetof(DipCostMergeArguments, parts),
                 offsetof(DipCostMergeArguments, part_count), DIP_COST_MAX_PARTS},
    .options_size = sizeof(DipCostMergeArguments),
    .check = dip_cost_merge_options_check,
    .describe_session = describe_merge,
    .run = run_merge,
};
