// Runs the command `diptych cost merge`: joins several reports into one. Each of these reports,
// which are called parts, has the errors at some of the viewpoints.
#include "app/cost/command.h"
#include "app/cost/context.h"
#include "app/cost/options.h"
#include "app/report/analysis.h"
#include "app/report/format/formats.h"
#include "app/report/page/html.h"
#include "app/cost/merge/merge_machines.h"
#include "app/files/whole_file.h"
#include "renderer/base/assert.h"

#include <stdio.h>
#include <string.h>

// The whole command line. Texts are borrowed from argv.
typedef struct Arguments {
    DipProgramOptions program;
    DipSessionOptions session; // The scene, from which the pictures of the page are drawn.
    const char *out;
    DipCostOptions cost; // Only the kind of pictures and the cache are used.
    const char *parts[DIP_COST_MAX_PARTS];
    int part_count;
} Arguments;

// --- joining -------------------------------------------------------------------------------------

// Returns whether two reports are parts of the same report: whether they have the same scene, size,
// paths and rows, and measure errors in the same way (the options places, burst, samples and
// pixels_per_degree). Their machines and times may differ.
static bool belong(const DipCostReport *a, const DipCostReport *b) {
    bool same = strcmp(a->scene_hash, b->scene_hash) == 0 && a->width == b->width &&
                a->height == b->height && a->row_count == b->row_count &&
                a->path_count == b->path_count && a->options.places == b->options.places &&
                a->options.burst == b->options.burst && a->options.samples == b->options.samples &&
                a->options.pixels_per_degree == b->options.pixels_per_degree;
    for (int p = 0; same && p < a->path_count; p++) {
        same = strcmp(a->path_hashes[p], b->path_hashes[p]) == 0;
    }
    for (int r = 0; same && r < a->row_count; r++) {
        same = a->rows[r].path == b->rows[r].path &&
               memcmp(&a->rows[r].quality, &b->rows[r].quality, sizeof a->rows[r].quality) == 0;
    }
    return same;
}

static void copy_viewpoints(DipCostReport *to, const DipCostReport *from) {
    const int places = to->options.places;
    for (int r = 0; r < to->row_count; r++) {
        for (int p = 0; p < places; p++) {
            if (!to->rows[r].judged[p] && from->rows[r].judged[p]) {
                to->rows[r].viewpoints[p] = from->rows[r].viewpoints[p];
                to->rows[r].tails[p] = from->rows[r].tails[p];
                to->rows[r].judged[p] = true;
                memcpy(to->rows[r].pictures[p], from->rows[r].pictures[p],
                       sizeof to->rows[r].pictures[p]);
            }
        }
    }
    for (int i = 0; i < to->path_count * places; i++) {
        if (!to->has_floor[i] && from->has_floor[i]) {
            to->floors[i] = from->floors[i];
            to->has_floor[i] = true;
        }
    }
}

// Adds the warnings that only the part has. The same scene gives all parts the same warnings,
// unless different versions of Diptych or of its libraries measured them.
static bool add_warnings(DipCostReport *report, const DipCostReport *part, DipError *err) {
    if (report->warnings_left_out < part->warnings_left_out) {
        report->warnings_left_out = part->warnings_left_out;
    }
    return dip_cost_report_add_warnings(report, part->warnings, part->warning_count, err);
}

// Returns whether two reports surely come from different builds. The build may be unknown ("").
static bool are_other_builds(const DipCostReport *a, const DipCostReport *b) {
    return a->build[0] && b->build[0] && strcmp(a->build, b->build) != 0;
}

// Reads all parts and joins them into one report. The report's times, budgets and machine come from
// the first part that has times, or from the first part if none has times. Times of several
// machines cannot be mixed.
static bool read_parts(const Arguments *arguments, DipCostReport *report, DipCostMachines *machines,
                       DipError *err) {
    if (!dip_cost_read_report(arguments->parts[0], report, err)) {
        return false;
    }
    dip_cost_machines_add(machines, report);
    for (int i = 1; i < arguments->part_count; i++) {
        DipCostReport part;
        if (!dip_cost_read_report(arguments->parts[i], &part, err)) {
            return false;
        }
        if (!belong(report, &part)) {
            dip_cost_report_free(&part);
            return dip_error_set(err, DIP_ERROR_CONFLICT, arguments->parts[i], 0, NULL,
                                 "is not a part of the same report as %s (scene, size, settings, "
                                 "camera paths, viewpoints or samples differ)",
                                 arguments->parts[0]);
        }
        dip_cost_machines_add(machines, &part);
        report->several_builds |= part.several_builds || are_other_builds(report, &part);
        part.several_builds = report->several_builds;
        if (report->rounds == 0 && part.rounds > 0) {
            const DipCostReport swap = *report;
            *report = part;
            part = swap;
        }
        copy_viewpoints(report, &part);
        const bool added = add_warnings(report, &part, err);
        dip_cost_report_free(&part);
        if (!added) {
            return false;
        }
    }
    return true;
}

// --- writing -------------------------------------------------------------------------------------

// Fails if the session shows another scene than the parts.
static bool check_scene(const DipCostReport *report, const DipSession *session, DipError *err) {
    DipCostReport here = {0};
    dip_cost_describe(&here, session);
    return strcmp(here.scene_hash, report->scene_hash) == 0 ||
           dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "cost merge",
                         "the parts show \"%.60s\", and the pictures of the page would be drawn "
                         "from \"%.60s\"; name the scene as for cost (--config, --model, "
                         "--scene), or give --pictures none",
                         report->scene, here.scene);
}

// Writes the report. This process draws the pictures of the page, which are the same to the bit on
// every machine.
static bool write_with_pictures(DipCostReport *report, DipSession *session,
                                const Arguments *arguments, DipError *err) {
    char cache[PATH_MAX];
    DipCostContext cost;
    if (!check_scene(report, session, err) ||
        !dip_cost_find_cache(arguments->cost.cache, cache, err) ||
        !dip_cost_context_open(&cost, session, report, true, err)) {
        return false;
    }
    cost.cache = cache;
    const DipCostFrameSource source = dip_cost_drawn_frames(&cost);
    const bool written = dip_cost_write_report(report, &source, arguments->out, err);
    dip_cost_context_close(&cost);
    return written;
}

static bool run(DipSession *session, const void *all, DipError *err) {
    const Arguments *arguments = all;
    DipCostReport report = {0};
    DipCostMachines machines = {0};
    bool done = dip_folder_make(arguments->out, "--out", err) &&
                read_parts(arguments, &report, &machines, err);
    int missing = 0;
    for (int p = 0; done && p < report.options.places; p++) {
        missing += !report.rows[report.base_rows[0]].judged[p];
    }
    if (missing > 0) {
        printf("%d of %d viewpoints are missing: no part has them\n", missing,
               report.options.places);
    }
    report.options.pictures = arguments->cost.pictures;
    done = done && dip_cost_join_same_pictures(&report, err) &&
           (report.rounds == 0 || dip_cost_estimate_times(&report, err)) &&
           dip_cost_analyse(&report, err);
    done = done && (report.options.pictures == DIP_COST_PICTURES_NONE
                        ? dip_cost_write_report(&report, NULL, arguments->out, err)
                        : write_with_pictures(&report, session, arguments, err));
    if (done) {
        dip_cost_machines_print(&machines, stdout);
        dip_cost_print(&report, stdout);
    }
    dip_cost_report_free(&report);
    return done;
}

// --- the command ---------------------------------------------------------------------------------

static const DipOptionPart parts[] = {
    {&dip_out_option_table, offsetof(Arguments, out)},
    {&dip_picture_option_table, offsetof(Arguments, cost)},
    {&dip_cache_option_table, offsetof(Arguments, cost.cache)},
    {&dip_scene_option_table, offsetof(Arguments, session)},
    {&dip_threads_option_table, offsetof(Arguments, session)},
    {&dip_program_option_table, offsetof(Arguments, program)},
};
static const DipOptionParts option_parts = {parts, DIP_ARRAY_COUNT(parts)};

static bool check(const void *arguments, DipError *err) {
    const Arguments *all = arguments;
    return dip_cost_check_out(all->out, err) &&
           (all->part_count > 0 ||
            dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "cost merge",
                          "there are no parts to join; give the cost.json of each: cost merge "
                          "--out DIR PART/cost.json...")) &&
           dip_session_options_check(&all->session, err);
}

static void describe(const void *arguments, DipSessionDef *def) {
    const Arguments *merge = arguments;
    def->options = &merge->session;
    def->scene = merge->cost.pictures != DIP_COST_PICTURES_NONE;
    def->keep_model = def->scene; // The reference renderer draws the converged pictures.
}

static const DipExample examples[] = {
    {"diptych cost merge --out report part0/cost.json part1/cost.json",
     "joins the parts that two machines measured"},
};

const DipCommand dip_cost_merge_command = {
    .name = "cost merge",
    .summary = "join the parts of a report that several machines measured",
    .usage = "--out DIR PART/cost.json...",
    .text = "Cost merge joins reports (each a cost.json, or a folder that has one) that have the "
            "same scene, size, settings, number of viewpoints (--places) and samples. Each report "
            "has the errors of some of the viewpoints (--part). The times come from the first "
            "report that has times, because times of different machines cannot be mixed. If "
            "several reports have times, a table compares their machines. The pictures of the page "
            "are drawn from the scene, which you name as for `cost`; with --pictures none no scene "
            "is needed.",
    .examples = examples,
    .example_count = DIP_ARRAY_COUNT(examples),
    .parts = &option_parts,
    .operands = {offsetof(Arguments, parts), offsetof(Arguments, part_count), DIP_COST_MAX_PARTS},
    .options_size = sizeof(Arguments),
    .check = check,
    .describe_session = describe,
    .run = run,
};
