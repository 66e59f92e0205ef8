// `diptych cost merge`: joins the viewpoints that several machines have judged into one report.
#include "app/cost/cost.h"

#include "app/report/format/formats.h"
#include "app/report/page/html.h"
#include "app/cost/merge/merge_frames.h"
#include "app/cost/merge/merge_machines.h"
#include "app/report/same_pictures.h"
#include "app/files/folder.h"

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

// Adds a part's machine and takes its frames.
static bool take_part(DipCostReport *part, const char *file, DipCostMachines *machines,
                      DipCostMergeFrames *frames, DipError *err) {
    dip_cost_machines_add(machines, part);
    return dip_cost_merge_frames_add(frames, part, file, err);
}

// Reads all parts and joins them in one report. The report's times, budgets and machine come from
// the first part that has times, because times of several machines cannot be mixed.
static bool read_parts(const DipCostMergeArguments *arguments, DipCostReport *report,
                       DipCostMachines *machines, DipCostMergeFrames *frames, DipError *err) {
    if (!dip_cost_read_json(report, arguments->parts[0], err) ||
        !take_part(report, arguments->parts[0], machines, frames, err)) {
        return false;
    }
    for (int i = 1; i < arguments->part_count; i++) {
        DipCostReport part;
        if (!dip_cost_read_json(&part, arguments->parts[i], err)) {
            return false;
        }
        if (!belong(report, &part)) {
            dip_cost_report_free(&part);
            return dip_error_set(err, DIP_ERROR_CONFLICT, arguments->parts[i], 0, NULL,
                                 "is not a part of the same report as %s (scene, size, settings, "
                                 "camera paths, viewpoints or samples differ)",
                                 arguments->parts[0]);
        }
        if (!take_part(&part, arguments->parts[i], machines, frames, err)) {
            dip_cost_report_free(&part);
            return false;
        }
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

// Says on standard output what the pictures of the page lack.
static void print_missing(const DipCostMergeFrames *frames, const DipCostPictures *pictures) {
    int count = pictures->front.missing_count;
    for (int s = 0; s < DIP_COST_MAX_SWEEPS; s++) {
        count += pictures->sweeps[s].missing_count;
    }
    if (frames->part_count == 0) {
        printf("the page has no pictures: no part keeps any\n");
    } else if (count > 0) {
        printf("the page lacks %d picture%s that no part has; it names them\n", count,
               dip_cost_plural(count));
    }
}

static bool write_page(DipCostReport *report, DipCostMergeFrames *frames, const char *file,
                       DipError *err) {
    DipCostPictures pictures;
    frames->report = report;
    const DipCostFrameSource source = dip_cost_merge_frames_source(frames);
    if (!dip_cost_pictures_make(&pictures, report, &source, err)) {
        return false;
    }
    pictures.from_parts = true;
    const bool shows = report->options.pictures != DIP_COST_PICTURES_NONE;
    if (shows) {
        print_missing(frames, &pictures);
    }
    const bool written =
        dip_cost_write_html(report, shows && frames->part_count > 0 ? &pictures : NULL, file, err);
    dip_cost_pictures_free(&pictures);
    return written;
}

static bool write_report(DipCostReport *report, DipCostMergeFrames *frames, const char *folder,
                         DipError *err) {
    char file[PATH_MAX];
    if (strlen(folder) + 16 > sizeof file) {
        return dip_error_set_runtime(err, DIP_ERROR_OVERSIZED, folder, 0, "--out",
                                     "the name is too long");
    }
    snprintf(file, sizeof file, "%.*s/cost.json", PATH_MAX - 16, folder);
    if (!dip_cost_write_json(report, file, err)) {
        return false;
    }
    snprintf(file, sizeof file, "%.*s/cost.csv", PATH_MAX - 16, folder);
    if (!dip_cost_write_csv(report, file, err)) {
        return false;
    }
    snprintf(file, sizeof file, "%.*s/cost.html", PATH_MAX - 16, folder);
    return write_page(report, frames, file, err);
}

bool dip_cost_merge_run(const DipCostMergeArguments *arguments, DipError *err) {
    DipCostReport report = {0};
    DipCostMachines machines = {0};
    DipCostMergeFrames frames = {0};
    const char *const folder = arguments->out;
    bool done = dip_folder_make(folder, "--out", err) &&
                read_parts(arguments, &report, &machines, &frames, err) &&
                dip_cost_merge_frames_check(&frames, err);
    if (done && count_missing(&report) > 0) {
        printf("%d of %d viewpoints are missing: no part has them\n", count_missing(&report),
               report.options.places);
    }
    report.options.pictures = arguments->pictures;
    done = done && dip_cost_join_same_pictures(&report, err) &&
           dip_cost_choose_again(&report, err) && write_report(&report, &frames, folder, err);
    if (done) {
        dip_cost_machines_print(&machines, stdout);
        dip_cost_print(&report, stdout);
    }
    dip_cost_merge_frames_free(&frames);
    dip_cost_report_free(&report);
    return done;
}
