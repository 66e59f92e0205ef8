// The cost commands: their help and their sessions.
#include "app/cost/command.h"

#include "app/cost/cost.h"
#include "app/cost/options.h"
#include "renderer/base/assert.h"

static bool run_cost(DipSession *session, const void *arguments, DipError *err) {
    return dip_cost_run(session, arguments, err);
}

static void describe_cost(const void *arguments, DipSessionDef *def) {
    def->options = &((const DipCostArguments *)arguments)->session;
    def->scene = true;
    def->keep_model = true; // The reference renderer draws the converged pictures from the model.
}

static const DipExample cost_examples[] = {
    {"diptych cost --out report", "measures the courtyard in a few minutes"},
    {"diptych cost --out report --fps 60,120",
     "finds the best settings for 60 and for 120 frames a second"},
    {"diptych cost --out report --predict --budget-ms 4,8,16,33",
     "ranks 1512 combinations of settings and measures only the best of them"},
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
    .run = run_cost,
};
