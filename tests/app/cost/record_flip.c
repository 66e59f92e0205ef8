// Records what test_best.c reads: judges the pictures of all combinations of recorded_space.h in
// one scene, and prints their FLIP as recorded_scenes.inc has it.
//
//     record_flip SCENE PATH WIDTHxHEIGHT FOLDER >text
//
// SCENE is an ini or a model file. PATH is a camera of the scene or a file, or "-" for the default
// path. One frame in the middle of the path is judged by a converged picture of 2 x 16 samples per
// pixel. FOLDER keeps the errors, so that a record that was ended goes on. At 160x120, a scene
// takes one to three minutes. Start it in the source folder, since a model gets the courtyard's
// ini.
#include "app/cost/command.h"
#include "app/cost/steps.h"
#include "app/files/whole_file.h"
#include "recorded_space.h"

#include <stdio.h>

enum { CHUNK = 256 }; // Combinations that are judged together.

static void print_flip(const DipCostReport *report, int row, int index) {
    const int at = index % RECORDED_PER_LINE;
    char text[3];
    recorded_write(dip_cost_row_metrics(report, row).flip, text);
    printf("%s%s%s", at == 0 ? "      \"" : "", text, at == RECORDED_PER_LINE - 1 ? "\",\n" : "");
}

static bool record(DipCostContext *cost, DipError *err) {
    DipCostReport *report = cost->report;
    const int rows = report->row_count;
    for (int first = 0; first < recorded_count(); first += CHUNK) {
        for (int i = first; i < recorded_count() && i < first + CHUNK; i++) {
            const DipQuality quality = recorded_settings(i);
            if (dip_cost_report_add_row(report, &quality, 0, err) < 0) {
                return false;
            }
        }
        if (!dip_cost_judge(cost, err)) {
            return false;
        }
        for (int row = rows; row < report->row_count; row++) {
            print_flip(report, row, first + row - rows);
        }
        report->row_count = rows;
    }
    return true;
}

static bool run(const DipSession *session, const char *folder, DipError *err) {
    DipCostReport report;
    DipCostContext cost;
    char cache[PATH_MAX], plan[33];
    DipCostArguments arguments = {0};
    dip_cost_options_default(&arguments);
    DipCostOptions options = arguments.cost;
    options.has_combined = options.predict = true; // No setting is combined, so none is swept.
    options.places = options.burst = 1;
    options.samples = 16;
    options.rounds = options.starts = 1;
    if (!dip_cost_find_cache(NULL, cache, err) || !dip_folder_make(folder, "FOLDER", err) ||
        !dip_cost_plan(&report, session, &options, err) ||
        !dip_scene_compress_textures(session->scene, session->pool, err) ||
        !dip_cost_context_open(&cost, session, &report, true, err)) {
        return false;
    }
    dip_cost_plan_hash(&report, session, plan);
    cost.cache = cache;
    cost.journal = dip_cost_journal_open(folder, plan, err);
    const bool done = cost.journal && dip_cost_make_truths(&cost, err) && record(&cost, err);
    dip_cost_journal_close(&cost.journal, false);
    dip_cost_context_close(&cost);
    dip_cost_report_free(&report);
    return done;
}

int main(int argc, char **argv) {
    DipSession session;
    DipErrorList faults = {0};
    DipError err = {0};
    DipSessionOptions options = {
        .config = "config/courtyard.ini", .has_threads = true, .threads = 1, .has_size = true};
    if (argc != 5 || sscanf(argv[3], "%dx%d", &options.size.width, &options.size.height) != 2) {
        fprintf(stderr, "record_flip SCENE PATH WIDTHxHEIGHT FOLDER\n");
        return 2;
    }
    if (strstr(argv[1], ".ini")) {
        options.config = argv[1];
    } else {
        options.models[options.model_count++] = argv[1];
    }
    options.path = strcmp(argv[2], "-") == 0 ? NULL : argv[2];
    const DipSessionDef def = {.options = &options, .scene = true, .keep_model = true};
    const bool opened = dip_session_open(&session, &def, &faults);
    for (size_t i = 0; i < faults.count; i++) {
        fprintf(stderr, "%s\n", faults.items[i].message);
    }
    dip_error_list_free(&faults);
    const bool done = opened && run(&session, argv[4], &err);
    if (opened && !done) {
        fprintf(stderr, "%s\n", err.message);
    }
    if (opened) {
        dip_session_close(&session);
    }
    return done ? 0 : 2;
}
