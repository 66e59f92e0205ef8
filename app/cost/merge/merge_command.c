// The command cost merge: its help.
#include "app/cost/command.h"
#include "app/cost/cost.h"
#include "app/cost/options.h"
#include "renderer/base/assert.h"

static bool run_merge(DipSession *session, const void *arguments, DipError *err) {
    (void)session;
    return dip_cost_merge_run(arguments, err);
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
            "compares their machines. The pictures of the page are made from the frames that each "
            "part keeps in the folder `frames` beside its cost.json.",
    .examples = merge_examples,
    .example_count = DIP_ARRAY_COUNT(merge_examples),
    .parts = &dip_cost_merge_option_parts,
    .operands = {offsetof(DipCostMergeArguments, parts),
                 offsetof(DipCostMergeArguments, part_count), DIP_COST_MAX_PARTS},
    .options_size = sizeof(DipCostMergeArguments),
    .check = dip_cost_merge_options_check,
    .run = run_merge,
};
