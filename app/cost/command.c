// The cost commands: their help and their sessions.
#include "app/cost/command.h"

#include "app/cost/cost.h"
#include "app/cost/options.h"
#include "renderer/base/assert.h"

static bool run_cost(DipSession *session, const void *arguments, DipError *err) {
    return dip_cost_run(session, arguments, err);
}

static bool run_assets(DipSession *session, const void *arguments, DipError *err) {
    (void)arguments;
    if (session->shows_gallery) {
        return dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, "--scene",
                             "cost assets measures the files of models, and a scene of the gallery "
                             "has none");
    }
    return dip_cost_assets_run(session, err);
}

static void describe_cost(const void *arguments, DipSessionDef *def) {
    def->options = &((const DipCostArguments *)arguments)->session;
    def->scene = true;
    def->keep_model = true; // The reference renderer draws the converged pictures from the model.
}

static void describe_assets(const void *arguments, DipSessionDef *def) {
    def->options = &((const DipCostAssetsArguments *)arguments)->session;
    def->scene = true;
    def->keep_model = true; // The model's pictures are written in other formats.
}

static const DipExample cost_examples[] = {
    {"diptych cost --out report", "measures the courtyard in about eight minutes"},
    {"diptych cost --out report --budget-ms 8,16.6",
     "also finds the best settings within 8 ms and within 16.6 ms per frame"},
    {"diptych cost --out report --predict --budget-ms 4,8,16,33",
     "ranks 1512 combinations of settings and measures only the best of them"},
    {"diptych cost --out report --model scene.glb --size 1280x720", "measures your own model"},
    {"diptych cost --out part0 --places 8 --part 0:4",
     "measures the errors at half of the viewpoints"},
    {"diptych cost --out part1 --places 8 --part 4:8 --errors-only",
     "measures the errors at the other half, on another machine"},
    {"diptych cost merge --out report part0/cost.json part1/cost.json", "joins the two parts"},
};

static const DipExample assets_examples[] = {
    {"diptych cost assets", "prints the sizes and load times of the courtyard's files"},
    {"diptych cost assets --model scene.glb",
     "prints the sizes and load times of your own model's files"},
};

const DipCommand dip_cost_command = {
    .name = "cost",
    .summary = "report what each setting costs in time and buys in accuracy",
    .usage = "--out DIR [OPTION]...",
    .text = "Cost changes one setting at a time. It measures how much longer a frame takes, and "
            "how much closer the picture comes to the converged picture, which has very many "
            "samples per pixel. It writes a report with tables, plots and pictures.\n\n"
            "A run takes minutes. To continue an interrupted run, give the same command again. "
            "docs/cost.md defines every number in the report.",
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

const DipCommand dip_cost_assets_command = {
    .name = "cost assets",
    .summary = "print the size and load time of the assets in several formats",
    .usage = "[OPTION]...",
    .text =
        "Cost assets writes the scene's meshes, pictures and camera paths in several formats to a "
        "temporary folder and prints for each format its size, its zipped size and its load time.",
    .examples = assets_examples,
    .example_count = DIP_ARRAY_COUNT(assets_examples),
    .parts = &dip_cost_assets_option_parts,
    .options_size = sizeof(DipCostAssetsArguments),
    .check = dip_cost_assets_options_check,
    .describe_session = describe_assets,
    .run = run_assets,
};
