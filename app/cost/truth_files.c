// Writes truths as PFM files.
#include "app/cost/truth_files.h"

#include "app/files/folder.h"
#include "app/files/pfm.h"
#include "app/cli/interrupt.h"
#include "app/cli/progress.h"

#include <limits.h>
#include <stdio.h>

static bool go_on(void *context, double done) {
    (void)context;
    (void)done;
    return !dip_interrupted();
}

static bool save_truth(DipCostContext *cost, const char *folder, int path, int viewpoint, int frame,
                       DipError *err) {
    char file[PATH_MAX];
    const int length = snprintf(file, sizeof file, "%s/%s-%d-%d.pfm", folder,
                                cost->report->paths[path], viewpoint, frame);
    if (length < 0 || (size_t)length >= sizeof file) {
        return dip_error_set_runtime(err, DIP_ERROR_OVERSIZED, folder, 0, "--save-truths",
                                     "the name is too long");
    }
    DipTruth truth;
    if (!dip_cost_context_truth(cost, path, viewpoint, frame, go_on, NULL, &truth, err)) {
        return false;
    }
    const bool saved = dip_pfm_write(file, truth.rgb_lin, truth.width, truth.height, err);
    dip_truth_free(&truth);
    return saved;
}

bool dip_cost_save_truths(DipCostContext *cost, const char *folder, DipError *err) {
    const DipCostReport *report = cost->report;
    const DipCostOptions *o = &report->options;
    const int per_path = (o->end_place - o->first_place) * o->burst;
    if (!dip_folder_make(folder, "--save-truths", err)) {
        return false;
    }
    DipProgress progress =
        dip_progress_begin("truths saved", (int64_t)report->path_count * per_path);
    bool saved = true;
    for (int i = 0; saved && i < report->path_count * per_path; i++) {
        const int in_path = i % per_path;
        saved = !dip_cost_interrupted(cost, err) &&
                save_truth(cost, folder, i / per_path, o->first_place + in_path / o->burst,
                           in_path % o->burst, err);
        dip_progress_show(&progress, i + 1);
    }
    dip_progress_end(&progress, (int64_t)report->path_count * per_path);
    return saved;
}
