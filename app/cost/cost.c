// `diptych cost`: truths, errors, times, report.
#include "app/commands.h"

#include "app/cost/gallery.h"
#include "app/cost/html.h"
#include "app/cost/rig.h"
#include "app/cost/write.h"
#include "app/files/folder.h"
#include "app/interrupt.h"

#include <limits.h>
#include <stdio.h>
#include <time.h>

static bool write_file(const DipCostReport *report, const char *folder, const char *name,
                       bool (*write)(const DipCostReport *, const char *, DipError *),
                       DipError *err) {
    char file[PATH_MAX];
    const int length = snprintf(file, sizeof file, "%s/%s", folder, name);
    if (length < 0 || (size_t)length >= sizeof file) {
        return dip_error_set(err, DIP_ERROR_OVERSIZED, folder, 0, "--out", "the name is too long");
    }
    return write(report, file, err);
}

static bool write_page(DipCostRig *rig, const char *folder, DipError *err) {
    char file[PATH_MAX];
    DipCostGallery gallery;
    if (snprintf(file, sizeof file, "%s/cost.html", folder) >= (int)sizeof file) {
        return dip_error_set(err, DIP_ERROR_OVERSIZED, folder, 0, "--out", "the name is too long");
    }
    if (!dip_cost_gallery_make(&gallery, rig, err)) {
        return false;
    }
    const bool written = dip_cost_write_html(rig->report, &gallery, file, err);
    dip_cost_gallery_free(&gallery);
    return written;
}

static bool write_report(DipCostRig *rig, const char *folder, DipError *err) {
    return write_page(rig, folder, err) &&
           write_file(rig->report, folder, "cost.csv", dip_cost_write_csv, err) &&
           write_file(rig->report, folder, "cost.json", dip_cost_write_json, err);
}

// The folder of the truths: as given, else the user's; "" for none.
static bool find_cache(const DipOptions *options, char folder[PATH_MAX], DipError *err) {
    if (options->cost.cache) {
        snprintf(folder, PATH_MAX, "%s", options->cost.cache);
    } else if (!dip_truth_default_folder(folder, PATH_MAX)) {
        folder[0] = '\0';
    }
    return !folder[0] || dip_folder_make(folder, "--cache", err);
}

static bool measure(DipCostRig *rig, DipError *err) {
    return dip_cost_make_truths(rig, err) && dip_cost_judge(rig, err) &&
           (rig->report->options.errors_only ||
            (dip_cost_time_rows(rig, err) && dip_cost_advise(rig, err)));
}

static bool run(DipSession *session, const DipOptions *options, DipCostReport *report,
                DipError *err) {
    char plan[33];
    char cache[PATH_MAX];
    DipCostRig rig;
    if (!find_cache(options, cache, err) || !dip_folder_make(options->out, "--out", err)) {
        return false;
    }
    dip_cost_plan_hash(report, plan);
    DipCostState *state = dip_cost_state_open(options->out, plan, err);
    if (!state || !dip_cost_rig_open(&rig, session, report, state, cache[0] ? cache : NULL, err)) {
        dip_cost_state_close(&state, false);
        return false;
    }
    const bool done = measure(&rig, err) && write_report(&rig, options->out, err);
    dip_cost_rig_close(&rig);
    dip_cost_state_close(&state, done);
    if (done) {
        dip_cost_print(report, stdout);
        printf("\nWritten: %s/cost.html, cost.csv, cost.json\n", options->out);
    }
    return done;
}

bool dip_cost_run(DipSession *session, const DipOptions *options, DipError *err) {
    DipCostReport report;
    dip_interrupt_watch();
    bool done = dip_cost_plan(&report, session, options, err);
    if (done) {
        if (!report.options.has_seed) {
            report.options.seed = (int)(time(NULL) % 1000000);
        }
        done = run(session, options, &report, err);
    }
    dip_cost_report_free(&report);
    return done;
}
