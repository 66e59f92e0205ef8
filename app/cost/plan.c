// Makes the rows and the sweeps of a report. A row is one combination of settings on a camera
// path; a sweep is the rows of all steps of one setting.
#include "app/cost/plan.h"

#include "app/report/combinations.h"
#include "app/cli/machine.h"
#include "app/files/whole_file.h"
#include "renderer/base/hash.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The category of the camera path that was made for each setting. Settings that are not listed here
// have the category DIP_CATEGORY_DEFAULT.
static const DipCategory categories[DIP_SETTING_COUNT] = {
    [DIP_SETTING_AA] = DIP_CATEGORY_AA,   [DIP_SETTING_TAA] = DIP_CATEGORY_TAA,
    [DIP_SETTING_AAA] = DIP_CATEGORY_AAA, [DIP_SETTING_AF] = DIP_CATEGORY_AF,
    [DIP_SETTING_AAF] = DIP_CATEGORY_AAF, [DIP_SETTING_OPT] = DIP_CATEGORY_CAI,
    [DIP_SETTING_GI] = DIP_CATEGORY_GI,   [DIP_SETTING_MIPLOD] = DIP_CATEGORY_MIPLOD,
    [DIP_SETTING_POST] = DIP_CATEGORY_AA,
};

// --- paths ---------------------------------------------------------------------------------------

static const DipCamCategory *slot_of_path(const DipCostReport *report, const DipSession *session,
                                          int path) {
    for (int c = 0; c < DIP_CATEGORY_COUNT; c++) {
        const DipCamCategory *slot = &session->track.categories[c];
        if (slot->path && strcmp(dip_session_category(c), report->paths[path]) == 0) {
            return slot;
        }
    }
    return &session->track.categories[0];
}

// Names the path of a category as the user names it. The path that the user gives with --path has
// the name of its camera, or of its file without folder and ending. Every other path has the name
// of its category. A report's names have only letters, digits, '_' and '-'; other characters become
// '_'.
static void name_path(const DipSession *session, int category, char name[DIP_COST_PATH_NAME]) {
    const char *own = session->options->path;
    if (category != 0 || !own) {
        snprintf(name, DIP_COST_PATH_NAME, "%s", dip_session_category(category));
        return;
    }
    const bool is_camera = session->track.categories[0].name != NULL;
    snprintf(name, DIP_COST_PATH_NAME, "%s", is_camera ? own : dip_base_name(own));
    char *ending = is_camera ? NULL : strrchr(name, '.');
    if (ending && ending > name) {
        *ending = '\0';
    }
    for (char *c = name; *c; c++) {
        *c = isalnum((unsigned char)*c) || *c == '-' ? *c : '_';
    }
    if (!name[0]) {
        snprintf(name, DIP_COST_PATH_NAME, "%s", dip_session_category(0));
    }
}

// Adds the camera path of a category to the report, and returns its index there. A category without
// a path has the path of the first category. Categories with the same path and field of view share
// one entry, which has the name of the category that was added first.
static int add_path(DipCostReport *report, const DipSession *session, int category) {
    const int own = session->track.categories[category].path ? category : 0;
    const DipCamCategory *slot = &session->track.categories[own];
    for (int p = 0; p < report->path_count; p++) {
        const DipCamCategory *known = slot_of_path(report, session, p);
        if (known->path == slot->path && known->fov_y_deg == slot->fov_y_deg) {
            return p;
        }
    }
    name_path(session, own, report->paths[report->path_count]);
    return report->path_count++;
}

int64_t dip_cost_path_duration_ns(const DipCostReport *report, const DipSession *session,
                                  int path) {
    return dip_campath_info(slot_of_path(report, session, path)->path).duration_ns;
}

DipPose dip_cost_pose(const DipCostReport *report, const DipSession *session, int path,
                      int64_t time_ns) {
    const DipCamCategory *slot = slot_of_path(report, session, path);
    DipPose pose = {.fov_y_deg = slot->fov_y_deg};
    dip_campath_sample(slot->path, time_ns, &pose);
    return pose;
}

int64_t dip_cost_viewpoint_time_ns(const DipCostReport *report, const DipSession *session, int path,
                                   int viewpoint, int frame) {
    const int64_t duration_ns = dip_cost_path_duration_ns(report, session, path);
    return duration_ns / (2 * report->options.places) * (2 * viewpoint + 1) +
           frame * INT64_C(1000000000) / 30;
}

// --- rows ----------------------------------------------------------------------------------------

// Finds the row of these settings on this path, or adds it. Looks only at the rows from
// combined_first on. If the run predicts (plan.h), these are all rows but the A/A row: the rows of
// the sweeps are combinations, too. Otherwise, these are all rows: combined_first is still 0. There
// is always room, because the sweeps need far fewer rows than DIP_COST_MAX_ROWS.
static int add_row(DipCostReport *report, const DipQuality *quality, int path) {
    const int known = dip_report_find(report, quality, path, report->combined_first);
    if (known >= 0) {
        return known;
    }
    report->rows[report->row_count] = (DipCostRow){.quality = *quality, .path = path};
    return report->row_count++;
}

static DipCostSweep *begin_sweep(DipCostReport *report, DipSetting setting, int path, int base) {
    DipCostSweep *sweep = &report->sweeps[report->sweep_count++];
    *sweep = (DipCostSweep){.setting = setting, .path = path, .base = base};
    return sweep;
}

static void add_to_sweep(DipCostSweep *sweep, int row) {
    if (sweep->row_count < DIP_COST_MAX_SWEEP_ROWS) {
        sweep->rows[sweep->row_count++] = row;
    }
}

// Returns the path for the sweep of a setting. If the run predicts, it is path 0, on which all
// combinations are measured.
static int sweep_path(DipCostReport *report, const DipSession *session, DipSetting setting) {
    return report->options.predict ? 0 : add_path(report, session, categories[setting]);
}

// Returns whether a sweep of a setting from this base is wanted. If the run predicts, it is wanted
// only if the setting is a combined one, and so are all settings in which the base differs from the
// baseline.
static bool is_swept(const DipCostReport *report, DipSetting setting, const DipQuality *base) {
    const unsigned combined = report->options.combined;
    const DipQuality of_combined =
        dip_cost_take_settings(&report->options.baseline, base, combined);
    return !report->options.predict ||
           (combined >> setting & 1 && dip_quality_equal(&of_combined, base));
}

// Adds a sweep of a setting, with the steps that the renderer accepts. Lists the refused steps with
// the reason.
static void plan_setting(DipCostReport *report, const DipSession *session, DipSetting setting) {
    const DipSettingInfo *info = dip_setting_info(setting);
    DipQuality base = report->options.baseline;
    if (setting == DIP_SETTING_TAA && base.step[DIP_SETTING_AA] == 0) {
        base.step[DIP_SETTING_AA] = DIP_COST_COMPANY_AA;
    }
    if (setting == DIP_SETTING_AAF && base.step[DIP_SETTING_AF] == 0) {
        base.step[DIP_SETTING_AF] = DIP_COST_COMPANY_AF;
    }
    if (setting == DIP_SETTING_UPSCALE && !dip_quality_upscales(&base)) {
        base.step[DIP_SETTING_SCALE] = DIP_COST_COMPANY_SCALE;
    }
    DipQuality steps[DIP_MAX_STEPS];
    int count = 0;
    for (int step = 0; step < info->step_count; step++) {
        DipError err = {0};
        steps[count] = base;
        steps[count].step[setting] = (uint8_t)step;
        if (dip_quality_check(&steps[count], &err)) {
            count++;
        } else if (report->refused_count < DIP_COST_MAX_REFUSED) {
            snprintf(report->refused[report->refused_count++], DIP_COST_REASON,
                     "%.50s=%.49s: %.380s", info->key, info->steps[step], err.message);
        }
    }
    if (count < 2 || !is_swept(report, setting, &base)) {
        return;
    }
    const int path = sweep_path(report, session, setting);
    DipCostSweep *sweep = begin_sweep(report, setting, path, add_row(report, &base, path));
    for (int i = 0; i < count; i++) {
        add_to_sweep(sweep, add_row(report, &steps[i], path));
    }
}

static void add_if_valid(DipCostReport *report, DipCostSweep *sweep, const DipQuality *quality,
                         int path) {
    const DipQuality effective = dip_quality_effective(quality);
    if (dip_quality_check(quality, NULL) && effective.step[DIP_SETTING_AAA]) {
        add_to_sweep(sweep, add_row(report, quality, path));
    }
}

// Adds a sweep of adaptive AA for each number of samples, because the possible group sizes depend
// on the number of samples. The steps go from few sample groups to many. aaa=all is combined with
// only one group size, one sample (asd=1), since frames with aaa=all take long. If the run
// predicts, adds the sweep for only one number of samples.
static void plan_adaptive(DipCostReport *report, const DipSession *session) {
    const DipSettingInfo *group_size = dip_setting_info(DIP_SETTING_ASD);
    for (int aa = 1; aa < dip_setting_info(DIP_SETTING_AA)->step_count; aa++) {
        DipQuality base = report->options.baseline;
        base.step[DIP_SETTING_AA] = (uint8_t)aa;
        base.step[DIP_SETTING_AAA] = DIP_AAA_OFF;
        base.step[DIP_SETTING_ASD] = 0;
        if (!dip_quality_check(&base, NULL) || !is_swept(report, DIP_SETTING_AAA, &base) ||
            (report->options.predict && aa != DIP_COST_COMPANY_AA)) {
            continue;
        }
        const int path = sweep_path(report, session, DIP_SETTING_AAA);
        const int base_row = add_row(report, &base, path);
        DipCostSweep *sweep = begin_sweep(report, DIP_SETTING_AAA, path, base_row);
        add_to_sweep(sweep, base_row);
        DipQuality step = base;
        step.step[DIP_SETTING_AAA] = DIP_AAA_COVERAGE;
        add_if_valid(report, sweep, &step, path);
        step.step[DIP_SETTING_AAA] = DIP_AAA_ON;
        for (int asd = group_size->step_count - 1; asd >= 0; asd--) {
            step.step[DIP_SETTING_ASD] = (uint8_t)asd;
            add_if_valid(report, sweep, &step, path);
        }
        step.step[DIP_SETTING_AAA] = DIP_AAA_ALL;
        add_if_valid(report, sweep, &step, path);
    }
}

// Adds two rows with the baseline's settings on each path. All other rows of the path are timed
// beside the first, which a sweep may have added already. The second is the A/A row: it is timed as
// if it had other settings, and so shows how far equal settings seem to differ.
static void add_base_rows(DipCostReport *report) {
    for (int path = 0; path < report->path_count; path++) {
        report->base_rows[path] = add_row(report, &report->options.baseline, path);
        report->same_rows[path] = report->row_count;
        report->rows[report->row_count++] = report->rows[report->base_rows[path]];
    }
}

// --- combinations --------------------------------------------------------------------------------

// Returns the new index of a row when the row `moved` becomes the last one.
static int moved_row(int row, int moved, int last) {
    return row == moved ? last : row - (row > moved);
}

// Makes the base row of path 0 the last row and the first combination. So the combination with the
// baseline's settings takes its time from the row that all others are timed beside.
static void begin_combinations(DipCostReport *report) {
    const int last = report->row_count - 1, moved = report->base_rows[0];
    const DipCostRow base = report->rows[moved];
    memmove(&report->rows[moved], &report->rows[moved + 1],
            (size_t)(last - moved) * sizeof *report->rows);
    report->rows[last] = base;
    for (int path = 0; path < report->path_count; path++) {
        report->base_rows[path] = moved_row(report->base_rows[path], moved, last);
        report->same_rows[path] = moved_row(report->same_rows[path], moved, last);
    }
    for (int s = 0; s < report->sweep_count; s++) {
        DipCostSweep *sweep = &report->sweeps[s];
        sweep->base = moved_row(sweep->base, moved, last);
        for (int i = 0; i < sweep->row_count; i++) {
            sweep->rows[i] = moved_row(sweep->rows[i], moved, last);
        }
    }
    report->combined_first = last;
}

// Adds a row for each combination of the combined settings but the baseline, which has one.
static bool plan_combinations(DipCostReport *report, DipError *err) {
    const DipCostOptions *options = &report->options;
    DipQuality *list = malloc(DIP_COST_MAX_ROWS * sizeof *list);
    if (!list) {
        return dip_cost_out_of_memory(err);
    }
    int count = options->combined
                    ? dip_cost_list_combinations(&options->baseline, options->combined, list,
                                                 DIP_COST_MAX_ROWS)
                    : 0;
    const bool fit = count + report->row_count <= DIP_COST_MAX_ROWS;
    if (fit && count > 0) {
        begin_combinations(report);
    } else {
        report->combined_first = report->row_count;
    }
    for (int i = 0; fit && i < count; i++) {
        if (!dip_quality_equal(&list[i], &options->baseline)) {
            report->rows[report->row_count++] = (DipCostRow){.quality = list[i], .path = 0};
        }
    }
    free(list);
    return fit || dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "--combine",
                                "these settings make more than %d combinations; give fewer "
                                "settings, or --predict, which measures only a few of them",
                                DIP_COST_MAX_ROWS);
}

// --- the whole -----------------------------------------------------------------------------------

void dip_cost_scene_name(const DipSession *session, char name[DIP_COST_TEXT]) {
    const char *file = dip_session_scene_file(session);
    if (session->shows_gallery) {
        snprintf(name, DIP_COST_TEXT, "gallery %s, %s (truth: same pipeline, larger picture)", file,
                 dip_session_scene_look(session, session->options->look, 0));
        return;
    }
    snprintf(name, DIP_COST_TEXT, "%s", dip_base_name(file));
}

void dip_cost_describe(DipCostReport *report, const DipSession *session) {
    dip_cost_scene_name(session, report->scene);
    dip_machine_build(report->build);
    if (session->shows_gallery) { // A gallery scene is code, so the build's hash identifies it.
        DipHash hash = dip_hash_begin(0);
        dip_hash_text(&hash, report->scene);
        dip_hash_text(&hash, report->build);
        dip_hash_hex(&hash, report->scene_hash);
    } else {
        dip_cost_scene_hash(&session->scene_def, &session->reflection, report->scene_hash);
    }
    dip_machine_processor(report->processor, sizeof report->processor);
    snprintf(report->isa, sizeof report->isa, "%s", dip_isa_name(session->isa));
    snprintf(report->version, sizeof report->version, "%s", DIP_VERSION);
    report->threads = dip_pool_thread_count(session->pool);
    report->width = session->pane_size.width;
    report->height = session->pane_size.height;
}

// Returns whether the run chooses among predicted combinations. It does with --predict. With
// budgets it also does, unless the user names the settings to combine or shares the work among
// machines.
static bool predicts(const DipCostOptions *options) {
    return options->predict || (options->budget_count > 0 && !options->has_combined &&
                                options->end_place == 0 && !options->errors_only);
}

// Returns the settings that are combined by default. A prediction combines all settings except mip
// colours, whose picture is not meant to be accurate. Without a prediction, AA and AF are combined,
// because the plot of the Pareto front needs at least two settings.
static unsigned default_combined(const DipCostOptions *options) {
    return options->predict ? ((1u << DIP_SETTING_COUNT) - 1) & ~(1u << DIP_SETTING_MIPDEBUG)
                            : 1u << DIP_SETTING_AA | 1u << DIP_SETTING_AF;
}

static void hash_pose(DipHash *hash, const DipCostReport *report, const DipSession *session,
                      int path, int64_t time_ns) {
    const DipPose pose = dip_cost_pose(report, session, path, time_ns);
    dip_hash_integer(hash, time_ns);
    for (int i = 0; i < 3; i++) {
        dip_hash_number(hash, pose.position_world[i]);
    }
    for (int i = 0; i < 4; i++) {
        dip_hash_number(hash, pose.orientation[i]);
    }
    dip_hash_number(hash, pose.fov_y_deg);
}

void dip_cost_hash_path(DipCostReport *report, const DipSession *session, int path) {
    const DipCostOptions *options = &report->options;
    DipHash hash = dip_hash_begin(0);
    for (int i = 0; i < options->places * options->burst; i++) {
        hash_pose(&hash, report, session, path,
                  dip_cost_viewpoint_time_ns(report, session, path, i / options->burst,
                                             i % options->burst));
    }
    dip_hash_hex(&hash, report->path_hashes[path]);
}

bool dip_cost_plan(DipCostReport *report, const DipSession *session, const DipCostOptions *options,
                   DipError *err) {
    *report = (DipCostReport){.options = *options};
    report->rows = calloc(DIP_COST_MAX_ROWS, sizeof *report->rows);
    if (!report->rows) {
        return dip_cost_out_of_memory(err);
    }
    report->options.predict = predicts(options);
    if (!report->options.has_combined) {
        report->options.combined = default_combined(&report->options);
    }
    if (!options->errors_only) {
        dip_cost_default_budgets(&report->options);
    }
    if (!report->options.end_place) {
        report->options.end_place = report->options.places;
    }
    dip_cost_describe(report, session);
    add_row(report, &report->options.baseline, add_path(report, session, DIP_CATEGORY_DEFAULT));
    if (report->options.predict) {
        add_base_rows(report);
        begin_combinations(report);
    }
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        if (s == DIP_SETTING_AAA) {
            plan_adaptive(report, session);
        } else if (s != DIP_SETTING_ASD && s != DIP_SETTING_MIPDEBUG) {
            plan_setting(report, session, (DipSetting)s);
        }
    }
    if (!report->options.predict) {
        add_base_rows(report);
        if (!plan_combinations(report, err)) {
            return false;
        }
    }
    for (int path = 0; path < report->path_count; path++) {
        dip_cost_hash_path(report, session, path);
    }
    report->warnings_left_out = session->warnings_left_out;
    return dip_cost_report_add_warnings(report, session->warnings.items,
                                        (int)session->warnings.count, err) &&
           dip_cost_report_alloc(report, err);
}

void dip_cost_plan_hash(const DipCostReport *report, const DipSession *session, char hex[33]) {
    DipHash hash = dip_hash_begin(0);
    dip_hash_text(&hash, report->version);
    dip_hash_text(&hash, report->build);
    dip_hash_text(&hash, report->scene_hash);
    dip_hash_text(&hash, report->processor);
    dip_hash_text(&hash, report->isa);
    const int values[] = {
        report->threads,           report->width,          report->height,
        report->options.places,    report->options.burst,  report->options.samples,
        report->options.rounds,    report->options.starts, report->options.timed_frames,
        session->force_all_effects};
    dip_hash_bytes(&hash, values, sizeof values);
    for (int path = 0; path < report->path_count; path++) {
        const int frames = dip_cost_frame_count(report);
        const int64_t duration_ns = dip_cost_path_duration_ns(report, session, path);
        dip_hash_text(&hash, report->path_hashes[path]);
        for (int f = 0; f < frames; f++) {
            hash_pose(&hash, report, session, path, duration_ns / frames * f);
        }
    }
    for (int r = 0; r < report->row_count; r++) {
        dip_hash_bytes(&hash, &report->rows[r].path, sizeof report->rows[r].path);
        dip_hash_bytes(&hash, &report->rows[r].quality, sizeof report->rows[r].quality);
    }
    const int choice[] = {report->options.predict, (int)report->options.combined};
    dip_hash_bytes(&hash, choice, sizeof choice);
    dip_hash_hex(&hash, hex);
}
