// Opening a session: ini, models, scene, paths, renderers; every fault is reported.
#include "app/session.h"

#include "app/log.h"
#include "app/mip_pictures.h"
#include "assets/model.h"
#include "renderer/base/clock.h"
#include "renderer/base/srgb.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

const char *const dip_pane_names[DIP_PANE_COUNT] = {"current", "requested"};

static bool add_fault(DipErrorList *faults, const DipError *err) {
    dip_error_list_add(faults, err);
    return false;
}

// --- the ini -----------------------------------------------------------------------------------

// The shipped ini: beside the build's folders, or in the share folder of an installed program.
static bool find_shipped_config(char *file, size_t size_bytes) {
    static const char *const places[] = {"../../config/courtyard.ini",
                                         "../share/diptych/config/courtyard.ini"};
    char program[PATH_MAX];
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (length < 0) {
        return false;
    }
    program[length] = '\0';
    *strrchr(program, '/') = '\0';
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const int needed = snprintf(file, size_bytes, "%s/%s", program, places[i]);
        if (needed > 0 && (size_t)needed < size_bytes && access(file, R_OK) == 0) {
            return true;
        }
    }
    return false;
}

// The ini's log file, unless the command line named one.
static bool use_log(const DipSession *session, const DipOptions *options, DipErrorList *faults) {
    const DipConfigFile *log = &session->config.log;
    DipError err;
    if (options->log || !log->path || dip_log_open(log->path, &err)) {
        return true;
    }
    DipError placed;
    dip_config_file_fault(&session->config, log, err.code, &placed, "%s: %s", err.file,
                          err.message);
    return add_fault(faults, &placed);
}

static bool check_isa(const DipSession *session, DipErrorList *faults) {
    const DipConfig *config = &session->config;
    if (config->isa == DIP_CONFIG_ISA_AUTO || dip_isa_available((DipIsa)config->isa)) {
        return true;
    }
    DipError err;
    dip_error_set(&err, DIP_ERROR_UNSUPPORTED, config->file, config->line[DIP_KEY_ISA], "ISA",
                  "'%s' is not available on this machine, accepted auto|..|%s",
                  dip_isa_name((DipIsa)config->isa), dip_isa_name(dip_isa_best()));
    return add_fault(faults, &err);
}

static bool load_config(DipSession *session, const DipOptions *options, DipErrorList *faults) {
    char shipped[PATH_MAX];
    const char *file = options->config;
    if (!file) {
        if (!find_shipped_config(shipped, sizeof shipped)) {
            DipError err;
            dip_error_set(&err, DIP_ERROR_MISSING, NULL, 0, "--config",
                          "the shipped config/courtyard.ini is not where the program was "
                          "installed, accepted --config FILE");
            return add_fault(faults, &err);
        }
        file = shipped;
    }
    if (!dip_config_load(file, &session->config, faults)) {
        return false;
    }
    return use_log(session, options, faults) && check_isa(session, faults);
}

// --- models ------------------------------------------------------------------------------------

// Errors of a model that the ini names are placed in the ini.
static bool place_in_config(DipSession *session, const DipConfigFile *file, DipErrorList *faults,
                            const DipError *err) {
    DipError placed;
    dip_config_file_fault(&session->config, file, err->code, &placed, "%s: %s", err->file,
                          err->message);
    placed.severity = err->severity;
    return add_fault(faults, &placed);
}

static void set_colour(const DipConfigColor *colour, double scale, float lin[3]) {
    for (int c = 0; c < 3; c++) {
        lin[c] = (float)(scale * dip_srgb_decode(colour->rgb[c] / 255.0));
    }
}

static DipSkyDef sky_of(const DipConfig *config) {
    DipSkyDef sky = {
        .layers = {{(float)config->sky_layer1_scale, config->sky_layer1_speed,
                    (float)config->sky_layer1_perturbation},
                   {(float)config->sky_layer2_scale, config->sky_layer2_speed,
                    (float)config->sky_layer2_perturbation}},
        .perturbation_scale = (float)config->sky_perturbation_scale,
        .blend = (float)config->sky_blend,
        .clear = (float)config->sky_clear,
        .dense = (float)config->sky_dense,
        .overcast = (float)config->sky_overcast,
    };
    set_colour(&config->sky_color, 1.0, sky.zenith_lin);
    set_colour(&config->sky_horizon_color, 1.0, sky.horizon_lin);
    set_colour(&config->sky_cloud_color, 1.0, sky.cloud_lin);
    set_colour(&config->sky_glare_color, config->sky_glare, sky.glare_lin);
    set_colour(&config->sky_tint, config->sky_brightness, sky.tint_lin);
    return sky;
}

static bool has_sky(const DipSceneDef *def) {
    bool found = false;
    for (int i = 0; i < def->object_count; i++) {
        const int material = def->meshes[def->objects[i].mesh].material;
        found |= def->materials[material].surface == DIP_SURFACE_SKY;
    }
    return found;
}

static void set_surroundings(const DipSession *session, const DipOptions *options,
                             DipSceneDef *def) {
    if (options->model_count) { // a model of the user's own brings its own; beside a sky is haze
        if (has_sky(def)) {
            memcpy(def->background_lin, def->sky.horizon_lin, sizeof def->background_lin);
        }
        return;
    }
    set_colour(&session->config.background, 1.0, def->background_lin);
    def->near_m = (float)session->config.near_m;
    def->sky = sky_of(&session->config);
}

static bool keeps_model(const DipOptions *options) {
    return options->command == DIP_COMMAND_COST || options->command == DIP_COMMAND_COST_ASSETS;
}

static DipModel *load_model(const DipSession *session, const DipOptions *options,
                            DipErrorList *faults, DipSceneDef *def, DipError *err) {
    const char *files[DIP_MAX_OPTION_MODELS];
    int count = options->model_count;
    for (int i = 0; i < count; i++) {
        files[i] = options->models[i];
    }
    const DipConfigFiles *named = &session->config.xfile;
    for (size_t i = 0; !options->model_count && i < named->count; i++) {
        files[count++] = named->items[i].path;
    }
    DipModel *model = dip_model_load_with_normals(files, count, session->pool, faults, err);
    if (model) {
        *def = *dip_model_scene_def(model);
        set_surroundings(session, options, def);
    }
    return model;
}

bool dip_session_keep_model(DipSession *session, const DipOptions *options, DipError *err) {
    if (!session->model) {
        DipErrorList warnings = {0}; // told when it was loaded first
        session->model = load_model(session, options, &warnings, &session->scene_def, err);
        dip_error_list_free(&warnings);
    }
    return session->model != NULL;
}

static bool load_scene(DipSession *session, const DipOptions *options, DipErrorList *faults) {
    DipError err = {0};
    DipSceneDef def;
    DipModel *model = load_model(session, options, faults, &def, &err);
    if (model) {
        session->scene = dip_scene_create(&def, session->pool, &err);
        session->times.import_ms = dip_model_times(model).import_ms;
        session->times.pictures_ms = dip_model_times(model).pictures_ms;
        if (session->scene && keeps_model(options)) {
            session->model = model;
            session->scene_def = def;
        } else {
            dip_model_destroy(&model);
        }
    }
    if (session->scene) {
        session->times.textures_ms = dip_scene_times(session->scene).textures_ms;
        session->times.meshes_ms = dip_scene_times(session->scene).meshes_ms;
        return true;
    }
    const DipConfigFiles *named = &session->config.xfile;
    for (size_t i = 0; !options->model_count && i < named->count; i++) {
        if (strcmp(err.file, named->items[i].path) == 0) {
            return place_in_config(session, &named->items[i], faults, &err);
        }
    }
    return add_fault(faults, &err);
}

static DipConfigSize pane_size(const DipSession *session, const DipOptions *options) {
    return options->has_size ? (DipConfigSize){options->width, options->height}
                             : session->config.res;
}

static DipQuality pane_quality(const DipSession *session, const DipOptions *options, int pane) {
    DipQuality quality;
    if (pane == DIP_PANE_CURRENT) {
        quality = options->has_current ? options->current : session->config.current;
    } else {
        quality = options->has_requested ? options->requested : session->config.requested;
    }
    const bool given = pane == DIP_PANE_CURRENT ? options->has_current : options->has_requested;
    if (session->config.mipdebug && !given) {
        quality.step[DIP_SETTING_MIPDEBUG] = 1;
    }
    return quality;
}

// What the panes' settings need is made before the first frame rather than in it.
static bool prepare_scene(DipSession *session, const DipOptions *options, DipErrorList *faults) {
    bool compresses = false;
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        const DipQuality quality = pane_quality(session, options, p);
        compresses |= dip_quality_compresses(&quality);
    }
    DipError err;
    return !compresses || dip_scene_compress_textures(session->scene, session->pool, &err) ||
           add_fault(faults, &err);
}

// --- camera paths ------------------------------------------------------------------------------

// Takes a path over and plays it in a slot.
static void keep_path(DipSession *session, DipCamPath *path, int slot, double fov_y_deg) {
    session->paths[session->path_count++] = path;
    dip_camtrack_set(&session->track, slot, path, fov_y_deg);
}

// One of the ini's paths; a file that another category named is not loaded again.
static bool load_category(DipSession *session, int category, DipErrorList *faults) {
    const DipConfigCamera *camera = &session->config.camera[category];
    if (!camera->file.path) {
        return true;
    }
    for (int other = 0; other < category; other++) {
        const DipConfigFile *file = &session->config.camera[other].file;
        if (file->path && dip_config_same_file(file, &camera->file) &&
            session->track.categories[other].path) {
            dip_camtrack_set(&session->track, category, session->track.categories[other].path,
                             camera->fov_y_deg);
            return true;
        }
    }
    DipCamPath *path;
    DipError err;
    if (!dip_campath_load(camera->file.path, &path, &err)) {
        if (err.line) {
            return add_fault(faults, &err); // a place in the path file says more
        }
        return place_in_config(session, &camera->file, faults, &err);
    }
    keep_path(session, path, category, camera->fov_y_deg);
    return true;
}

static bool load_own_path(DipSession *session, const DipOptions *options, DipErrorList *faults) {
    DipCamPath *path;
    DipError err;
    if (!dip_campath_load(options->path, &path, &err)) {
        return add_fault(faults, &err);
    }
    keep_path(session, path, 0, session->config.camera[DIP_CATEGORY_DEFAULT].fov_y_deg);
    return true;
}

// Nothing nearer than DIP_MIN_W (renderer/pipeline/geometry/project.h) is drawn: smaller models
// would be invisible. A single point is framed all the same.
static bool check_extent(const float low[3], const float high[3], const char *file,
                         DipErrorList *faults) {
    const double least = 5e-6;
    double extent = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        extent = fmax(extent, (double)high[axis] - low[axis]);
    }
    if (extent == 0.0 || extent >= least) {
        return true;
    }
    DipError err;
    dip_error_set(&err, DIP_ERROR_RANGE, file, 0, "box",
                  "the model is %.3g large, accepted at least %g; give it a larger unit", extent,
                  least);
    return add_fault(faults, &err);
}

static bool make_orbit(DipSession *session, const DipOptions *options, DipErrorList *faults) {
    float low[3];
    float high[3];
    dip_scene_bounds(session->scene, low, high);
    DipCamOrbitDef def = dip_campath_default_orbit();
    const DipConfigSize size = pane_size(session, options);
    def.aspect = fmin(fmax((double)size.width / size.height, 0.01), 100.0);
    for (int axis = 0; axis < 3; axis++) {
        def.min_world[axis] = low[axis];
        def.max_world[axis] = high[axis];
    }
    const char *file = session->config.file;
    if (options->model_count) {
        file = options->models[0];
    } else {
        def.fov_y_deg = session->config.camera[DIP_CATEGORY_DEFAULT].fov_y_deg;
    }
    DipCamPath *path;
    DipError err;
    if (!check_extent(low, high, file, faults)) {
        return false;
    }
    if (!dip_campath_orbit(&def, &path, &err)) {
        DipError named;
        dip_error_set(&named, err.code, file, 0, err.key, "%s", err.message);
        return add_fault(faults, &named);
    }
    keep_path(session, path, 0, def.fov_y_deg);
    session->orbiting = true;
    return true;
}

// The key less its "CAMPATH_".
const char *dip_session_category(int category) {
    return dip_config_key_name((DipConfigKey)(DIP_KEY_CAMPATH_DEFAULT + 2 * category)) +
           strlen("CAMPATH_");
}

static bool choose_category(DipSession *session, const DipOptions *options, DipErrorList *faults) {
    if (!options->category) {
        return true;
    }
    char known[160] = "";
    for (int c = 0; c < DIP_CATEGORY_COUNT; c++) {
        const char *name = dip_session_category(c);
        if (strcasecmp(name, options->category) == 0) {
            session->track.active = c;
            return true;
        }
        strcat(strcat(known, c ? "|" : ""), name);
    }
    DipError err;
    dip_error_set(&err, DIP_ERROR_UNKNOWN, NULL, 0, "--category", "'%s', accepted %s",
                  options->category, known);
    return add_fault(faults, &err);
}

static bool load_paths(DipSession *session, const DipOptions *options, DipErrorList *faults) {
    session->track = dip_camtrack_make(session->config.campath_reset_on_switch);
    session->paths = calloc(DIP_CATEGORY_COUNT, sizeof(DipCamPath *));
    if (!session->paths) {
        DipError err;
        dip_error_set(&err, DIP_ERROR_MEMORY, NULL, 0, "paths", "out of memory");
        return add_fault(faults, &err);
    }
    if (options->path) {
        return load_own_path(session, options, faults);
    }
    if (options->model_count) {
        return !session->scene || make_orbit(session, options, faults);
    }
    bool loaded = true;
    for (int c = 0; c < DIP_CATEGORY_COUNT; c++) {
        loaded = load_category(session, c, faults) && loaded;
    }
    if (!session->config.camera[DIP_CATEGORY_DEFAULT].file.path && session->scene) {
        loaded = make_orbit(session, options, faults) && loaded;
    }
    return choose_category(session, options, faults) && loaded;
}

// --- renderers ---------------------------------------------------------------------------------

static void set_reflection(DipSession *session, const DipOptions *options) {
    const DipConfig *config = &session->config;
    session->force_all_effects = options->force_all_effects;
    session->reflection = (DipReflectionDef){
        .width = config->reflection_res.width,
        .height = config->reflection_res.height,
        .level_m = config->fountain_water_level,
        .schlick = config->water_schlick,
        .show = config->debug_show_reflection,
    };
    const bool has_level = config->line[DIP_KEY_FOUNTAIN_WATER_LEVEL] > 0;
    if ((options->model_count || !has_level) && session->scene) {
        dip_scene_water_level(session->scene, &session->reflection.level_m);
    }
}

static bool make_renderers(DipSession *session, const DipOptions *options, DipErrorList *faults) {
    DipError err;
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        const DipRendererDef def = {
            .pool = session->pool,
            .isa = session->isa,
            .width = pane_size(session, options).width,
            .height = pane_size(session, options).height,
            .quality = pane_quality(session, options, p),
            .reflection = session->reflection,
            .force_all_effects = session->force_all_effects,
        };
        session->renderers[p] = dip_renderer_create(&def, &err);
        if (!session->renderers[p]) {
            return add_fault(faults, &err);
        }
    }
    return dip_mip_pictures_load(session, faults);
}

static bool make_pool(DipSession *session, const DipOptions *options, DipErrorList *faults) {
    DipError err;
    session->isa = options->has_isa                             ? options->isa
                   : session->config.isa == DIP_CONFIG_ISA_AUTO ? dip_isa_best()
                                                                : (DipIsa)session->config.isa;
    session->pool =
        dip_pool_create(options->has_threads ? options->threads : session->config.threads, &err);
    return session->pool || add_fault(faults, &err);
}

// The bench makes renderers of its own, and it may have no use for the scene.
static bool draws_scene(const DipOptions *options) {
    return options->command != DIP_COMMAND_BENCH ||
           (!options->bench.grid_count && (!options->bench.vs || options->bench.serve));
}

// Scene and paths both, so that one run shows the faults of all.
static bool load_what_is_drawn(DipSession *session, const DipOptions *options,
                               DipErrorList *faults) {
    if (!draws_scene(options)) {
        return true;
    }
    const bool scene = load_scene(session, options, faults);
    const int64_t begin_ns = dip_clock_ns();
    const bool paths = load_paths(session, options, faults);
    session->times.paths_ms = dip_start_times_since_ms(begin_ns);
    return scene && paths;
}

static bool has_panes(const DipOptions *options) {
    return options->command == DIP_COMMAND_PREVIEW || options->command == DIP_COMMAND_DUMP;
}

bool dip_session_open(DipSession *session, const DipOptions *options, DipErrorList *faults) {
    *session = (DipSession){.isa = DIP_ISA_SCALAR};
    session->times.begin_ns = options->begin_ns;
    bool opened = load_config(session, options, faults) && make_pool(session, options, faults);
    session->times.ini_ms = dip_start_times_since_ms(options->begin_ns);
    opened = opened && load_what_is_drawn(session, options, faults);
    if (opened) {
        set_reflection(session, options);
    }
    if (opened && has_panes(options)) {
        const int64_t begin_ns = dip_clock_ns();
        opened = prepare_scene(session, options, faults);
        const int64_t prepared_ns = dip_clock_ns();
        opened = opened && make_renderers(session, options, faults);
        session->times.textures_ms += 1e-6 * (double)(prepared_ns - begin_ns);
        session->times.renderers_ms = dip_start_times_since_ms(prepared_ns);
    }
    session->times.opened_ns = dip_clock_ns();
    if (!opened) {
        dip_session_close(session);
    }
    return opened;
}

void dip_session_close(DipSession *session) {
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        dip_renderer_destroy(&session->renderers[p]);
    }
    for (int i = 0; i < session->path_count; i++) {
        dip_campath_destroy(&session->paths[i]);
    }
    free(session->paths);
    dip_scene_destroy(&session->scene);
    dip_model_destroy(&session->model);
    dip_pool_destroy(&session->pool);
    dip_config_free(&session->config);
    *session = (DipSession){.isa = DIP_ISA_SCALAR};
}

static DipFrame copy_of(const DipFrame *frame) {
    DipFrame copy = *frame;
    copy.counters = (DipCounters){0};
    copy.stages = (DipStageTimes){0};
    return copy;
}

// One pane, shown twice.
static bool draw_copied(DipSession *session, const DipPose *pose, int64_t play_ns,
                        DipSessionFrame *frame, DipError *err) {
    DipFrame *pane = &frame->panes[DIP_PANE_CURRENT];
    if (!dip_renderer_draw(session->renderers[DIP_PANE_CURRENT], session->scene, pose, play_ns,
                           pane, err)) {
        return false;
    }
    frame->panes[DIP_PANE_REQUESTED] = copy_of(pane);
    return true;
}

bool dip_session_draw_pose(DipSession *session, const DipPose *pose, int64_t play_ns,
                           uint64_t frame_index, DipSessionFrame *frame, DipError *err) {
    const DipQuality current = dip_renderer_quality(session->renderers[DIP_PANE_CURRENT]);
    const DipQuality requested = dip_renderer_quality(session->renderers[DIP_PANE_REQUESTED]);
    frame->copied =
        !session->force_all_effects && memcmp(&current, &requested, sizeof current) == 0;
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        dip_renderer_set_frame_index(session->renderers[p], frame_index);
    }
    DipFrame *const panes[DIP_PANE_COUNT] = {&frame->panes[0], &frame->panes[1]};
    const int64_t begin_ns = dip_clock_ns();
    const bool drawn = frame->copied
                           ? draw_copied(session, pose, play_ns, frame, err)
                           : dip_renderer_draw_frames(session->renderers, DIP_PANE_COUNT,
                                                      session->scene, pose, play_ns, panes, err);
    frame->ms = 1e-6 * (double)(dip_clock_ns() - begin_ns);
    return drawn;
}

bool dip_session_draw(DipSession *session, int64_t play_ns, uint64_t frame_index, DipPose *pose,
                      DipSessionFrame *frame, DipError *err) {
    if (!dip_camtrack_pose(&session->track, play_ns, pose)) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "path", "there is no camera path");
    }
    if (!dip_session_draw_pose(session, pose, play_ns, frame_index, frame, err)) {
        return false;
    }
    dip_start_times_frame(&session->times);
    return true;
}
