// `diptych cost merge`: joins the viewpoints that several machines have judged into one report.
#include "app/cost/cost.h"

#include "app/cost/command.h"
#include "app/cost/context.h"
#include "app/report/analysis.h"
#include "app/report/format/formats.h"
#include "app/report/page/html.h"
#include "app/cost/merge/merge_machines.h"
#include "app/report/same_pictures.h"
#include "app/files/whole_file.h"
#include "renderer/base/assert.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

// True if two reports are parts of the same report: if they have the same scene, size, paths, rows
// and truths (converged pictures). Their machines and times may differ.
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

// Reads all parts and joins them in one report. The report's times, budgets and machine come from
// the first part that has times, because times of several machines cannot be mixed.
static bool read_parts(const DipCostMergeArguments *arguments, DipCostReport *report,
                       DipCostMachines *machines, DipError *err) {
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
        if (report->rounds == 0 && part.rounds > 0) {
            const DipCostReport swap = *report;
            *report = part;
            part = swap;
        }
        copy_viewpoints(report, &part);
        dip_cost_report_free(&part);
    }
    return true;
}

static int count_missing(const DipCostReport *report) {
    int count = 0;
    for (int p = 0; p < report->options.places; p++) {
        count += !report->rows[0].judged[p];
    }
    return count;
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

// Writes the report, with pictures that are drawn here: pictures have the same bits everywhere.
static bool write_with_pictures(DipCostReport *report, DipSession *session,
                                const DipCostMergeArguments *arguments, DipError *err) {
    char cache[PATH_MAX];
    DipCostContext cost;
    if (!check_scene(report, session, err) ||
        !dip_cost_find_cache(arguments->cost.cache, cache, err) ||
        !dip_cost_context_open(&cost, session, report, NULL, cache[0] ? cache : NULL, true, err)) {
        return false;
    }
    const DipCostFrameSource source = dip_cost_drawn_frames(&cost);
    const bool written = dip_cost_write_report(report, &source, arguments->out, err);
    dip_cost_context_close(&cost);
    return written;
}

static bool run_merge(DipSession *session, const void *all, DipError *err) {
    const DipCostMergeArguments *arguments = all;
    DipCostReport report = {0};
    DipCostMachines machines = {0};
    bool done = dip_folder_make(arguments->out, "--out", err) &&
                read_parts(arguments, &report, &machines, err);
    if (done && count_missing(&report) > 0) {
        printf("%d of %d viewpoints are missing: no part has them\n", count_missing(&report),
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
