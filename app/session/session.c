// Opens a session: reads the ini, starts the threads and makes the renderers. Draws both panes with
// the renderers. Measures how long the parts of the start take.
#include "app/session/session_private.h"

#include "app/cli/log.h"
#include "app/cli/program_file.h"
#include "app/files/put.h"
#include "renderer/base/clock.h"

#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char *const dip_pane_names[DIP_PANE_COUNT] = {"current", "requested"};

bool dip_session_add_fault(DipErrorList *faults, const DipError *err) {
    dip_error_list_add(faults, err);
    return false;
}

bool dip_session_refuse(DipErrorList *faults, DipErrorCode code, const char *file, int line,
                        const char *key, const char *format, ...) {
    char message[sizeof((DipError *)NULL)->message];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    DipError err;
    dip_error_set(&err, code, file, line, key, "%s", message);
    return dip_session_add_fault(faults, &err);
}

bool dip_session_place_fault(const DipSession *session, const DipConfigFile *file,
                             DipErrorList *faults, const DipError *err) {
    DipError placed;
    dip_config_file_fault(&session->config, file, err->code, &placed, "%s: %s", err->file,
                          err->message);
    placed.severity = err->severity;
    placed.origin = err->origin;
    return dip_session_add_fault(faults, &placed);
}

// --- the ini -----------------------------------------------------------------------------------

bool dip_session_find_shipped(const char *name, char *file, size_t size_bytes) {
    static const char *const places[] = {"../..", "../share/diptych"};
    const char *program = dip_program_path();
    if (!program) {
        return false;
    }
    const int folder_length = (int)(strrchr(program, '/') - program);
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const int needed =
            snprintf(file, size_bytes, "%.*s/%s/%s", folder_length, program, places[i], name);
        if (needed > 0 && (size_t)needed < size_bytes && access(file, R_OK) == 0) {
            return true;
        }
    }
    return false;
}

// Opens the log file that the ini names. Does nothing if `given`, the log file of the command line,
// is not NULL, or if the ini names none.
static bool use_log(const DipSession *session, const char *given, DipErrorList *faults) {
    const DipConfigFile *log = &session->config.log;
    DipError err;
    if (given || !log->path || dip_log_open(log->path, &err)) {
        return true;
    }
    return dip_session_place_fault(session, log, faults, &err);
}

static bool check_isa(const DipSession *session, DipErrorList *faults) {
    const DipConfig *config = &session->config;
    if (config->isa == DIP_CONFIG_ISA_AUTO || dip_isa_available((DipIsa)config->isa)) {
        return true;
    }
    return dip_session_refuse(faults, DIP_ERROR_UNSUPPORTED, config->file,
                              config->line[DIP_KEY_ISA], "ISA",
                              "this machine cannot run '%s'; give auto, or at most %s",
                              dip_isa_name((DipIsa)config->isa), dip_isa_name(dip_isa_best()));
}

static bool load_config(DipSession *session, const char *log, DipErrorList *faults) {
    char shipped[PATH_MAX];
    const char *given = session->options->config;
    const char *named = dip_session_shipped_ini(session->options);
    const char *ini = named ? named : "config/courtyard.ini";
    if (!given && !dip_program_path()) {
        return dip_session_refuse(faults, DIP_ERROR_MISSING, NULL, 0, "--config",
                                  "the system does not tell where this program lies, so %s is not "
                                  "found; give an ini with --config FILE",
                                  ini);
    }
    if (!given && !dip_session_find_shipped(ini, shipped, sizeof shipped)) {
        return dip_session_refuse(faults, DIP_ERROR_MISSING, NULL, 0, "--config",
                                  "%s is not where Diptych was installed; give an ini with "
                                  "--config FILE",
                                  ini);
    }
    return dip_config_load(given ? given : shipped, &session->config, faults) &&
           use_log(session, log, faults) && check_isa(session, faults);
}

// --- panes --------------------------------------------------------------------------------------

static DipQuality pane_quality(const DipSession *session, int pane) {
    const DipSessionOptions *options = session->options;
    const bool is_current = pane == DIP_PANE_CURRENT;
    const bool given = is_current ? options->has_current : options->has_requested;
    if (given) {
        return is_current ? options->current : options->requested;
    }
    DipQuality quality = is_current ? session->config.current : session->config.requested;
    if (session->config.mipdebug) {
        quality.step[DIP_SETTING_MIPDEBUG] = 1;
    }
    return quality;
}

// Compresses the textures if a pane's settings need it. This is done before the first frame, so
// that the first frame takes no longer than the later ones.
static bool prepare_scene(DipSession *session, DipErrorList *faults) {
    bool compresses = false;
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        const DipQuality quality = pane_quality(session, p);
        compresses |= dip_quality_compresses(&quality);
    }
    DipError err;
    return !compresses || !session->scene ||
           dip_scene_compress_textures(session->scene, session->pool, &err) ||
           dip_session_add_fault(faults, &err);
}

static void set_reflection(DipSession *session) {
    const DipConfig *config = &session->config;
    session->force_all_effects = session->options->force_all_effects;
    session->reflection = (DipReflectionDef){
        .width = config->reflection_res.width,
        .height = config->reflection_res.height,
        .level_m = config->fountain_water_level,
        .schlick = config->water_schlick,
        .show = config->debug_show_reflection,
    };
    const bool has_level = config->line[DIP_KEY_FOUNTAIN_WATER_LEVEL] > 0;
    if ((session->options->model_count || !has_level) && session->scene) {
        dip_scene_water_level(session->scene, &session->reflection.level_m);
    }
}

DipPainter *dip_session_make_painter(const DipSession *session, DipGallery *gallery,
                                     const DipQuality *quality, int width, int height,
                                     DipError *err) {
    const DipRendererDef def = {
        .pool = session->pool,
        .isa = session->isa,
        .width = width,
        .height = height,
        .quality = *quality,
        .reflection = session->reflection,
        .force_all_effects = session->force_all_effects,
    };
    return dip_painter_create(&def, gallery, err);
}

bool dip_session_make_painters(const DipSession *session, DipGallery *gallery,
                               const DipQuality qualities[DIP_PANE_COUNT],
                               DipPainter *painters[DIP_PANE_COUNT], DipError *err) {
    const DipConfigSize size = session->pane_size;
    bool made = true;
    for (int p = 0; made && p < DIP_PANE_COUNT; p++) {
        painters[p] =
            dip_session_make_painter(session, gallery, &qualities[p], size.width, size.height, err);
        made = painters[p] != NULL;
    }
    return made;
}

bool dip_session_load_mip_pictures(DipSession *session, DipPainter *const painters[DIP_PANE_COUNT],
                                   DipErrorList *faults) {
    DipPicture pictures[DIP_MIP_LEVEL_COUNT] = {{0}};
    DipTextureDef defs[DIP_MIP_LEVEL_COUNT];
    const DipTextureDef *given[DIP_MIP_LEVEL_COUNT] = {NULL};
    bool any = false;
    bool loaded = true;
    DipError err;
    for (int level = 0; level < DIP_MIP_LEVEL_COUNT; level++) {
        const DipConfigFile *file = &session->config.mip_picture[level];
        DipPicture *picture = &pictures[level];
        if (file->path && !dip_picture_import(file->path, session->importer, picture, &err)) {
            loaded = dip_session_place_fault(session, file, faults, &err);
        } else if (file->path) {
            defs[level] = (DipTextureDef){.name = file->path,
                                          .width = picture->width,
                                          .height = picture->height,
                                          .rgba8 = picture->rgba8,
                                          .encoding = DIP_ENCODING_SRGB};
            given[level] = &defs[level];
            any = true;
        }
    }
    for (int p = 0; loaded && any && p < DIP_PANE_COUNT; p++) {
        loaded = dip_painter_set_mip_pictures(painters[p], given, &err) ||
                 dip_session_add_fault(faults, &err);
    }
    for (int level = 0; level < DIP_MIP_LEVEL_COUNT; level++) {
        dip_picture_free(&pictures[level]);
    }
    return loaded;
}

static bool make_renderers(DipSession *session, DipErrorList *faults) {
    const DipQuality qualities[DIP_PANE_COUNT] = {pane_quality(session, 0),
                                                  pane_quality(session, 1)};
    DipError err;
    if (session->shows_gallery) {
        session->gallery = dip_session_open_gallery(session, session->pool, session->isa, &err);
    }
    if ((session->shows_gallery && !session->gallery) ||
        !dip_session_make_painters(session, session->gallery, qualities, session->renderers,
                                   &err)) {
        return dip_session_add_fault(faults, &err);
    }
    return dip_session_load_mip_pictures(session, session->renderers, faults);
}

static bool make_pool(DipSession *session, DipErrorList *faults) {
    const DipSessionOptions *options = session->options;
    const DipConfig *config = &session->config;
    DipError err;
    session->isa = config->isa == DIP_CONFIG_ISA_AUTO ? dip_isa_best() : (DipIsa)config->isa;
    if (options->has_isa) {
        session->isa = options->isa;
    }
    session->pool =
        dip_pool_create(options->has_threads ? options->threads : config->threads, &err);
    return session->pool || dip_session_add_fault(faults, &err);
}

// --- opening and closing -------------------------------------------------------------------------

// Loads the scene and the camera paths. Loads the paths even if the scene fails, so that one run
// shows the faults of both.
static bool load_what_is_drawn(DipSession *session, bool keep_model, DipErrorList *faults) {
    const bool scene =
        session->shows_gallery || dip_session_load_scene(session, keep_model, faults);
    const int64_t begin_ns = dip_clock_ns();
    const bool paths = session->shows_gallery ? dip_session_load_gallery_path(session, faults)
                                              : dip_session_load_paths(session, faults);
    session->times.paths_ms = dip_start_times_since_ms(begin_ns);
    return scene && paths;
}

static bool prepare_panes(DipSession *session, DipErrorList *faults) {
    const int64_t begin_ns = dip_clock_ns();
    bool prepared = prepare_scene(session, faults);
    const int64_t prepared_ns = dip_clock_ns();
    prepared = prepared && make_renderers(session, faults);
    session->times.textures_ms += 1e-6 * (double)(prepared_ns - begin_ns);
    session->times.renderers_ms = dip_start_times_since_ms(prepared_ns);
    return prepared;
}

// Keeps the warnings of the list from the index `first` on.
static bool keep_warnings(DipSession *session, DipErrorList *faults, size_t first) {
    size_t wanted = 0;
    for (size_t i = first; i < faults->count; i++) {
        if (faults->items[i].severity != DIP_SEVERITY_WARNING) {
            continue;
        }
        if (wanted < DIP_SESSION_MAX_WARNINGS) {
            dip_error_list_add(&session->warnings, &faults->items[i]);
            wanted++;
        } else {
            session->warnings_left_out++;
        }
    }
    return session->warnings.count == wanted ||
           dip_session_refuse(faults, DIP_ERROR_MEMORY, NULL, 0, "warnings", "out of memory");
}

bool dip_session_open(DipSession *session, const DipSessionDef *def, DipErrorList *faults) {
    const size_t faults_before = faults->count;
    *session =
        (DipSession){.options = def->options, .importer = def->importer, .isa = DIP_ISA_SCALAR};
    session->times.begin_ns = def->begin_ns;
    bool opened = load_config(session, def->log, faults) &&
                  dip_session_choose_gallery(session, faults) && make_pool(session, faults);
    session->times.ini_ms = dip_start_times_since_ms(def->begin_ns);
    const DipOptionSize *size = &def->options->size;
    session->pane_size =
        def->options->has_size ? (DipConfigSize){size->width, size->height} : session->config.res;
    opened = opened && (!def->scene || load_what_is_drawn(session, def->keep_model, faults));
    if (opened) {
        set_reflection(session);
    }
    opened = opened && (!def->renderers || prepare_panes(session, faults)) &&
             keep_warnings(session, faults, faults_before);
    session->times.opened_ns = dip_clock_ns();
    if (!opened) {
        dip_session_close(session);
    }
    return opened;
}

void dip_session_close(DipSession *session) {
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        dip_painter_destroy(&session->renderers[p]);
    }
    dip_gallery_destroy(&session->gallery);
    dip_campath_destroy(&session->gallery_path);
    free(session->assets);
    dip_session_free_paths(session);
    dip_session_free_animations(session);
    dip_scene_destroy(&session->scene);
    dip_added_surface_destroy(&session->added);
    dip_model_destroy(&session->model);
    free(session->environment);
    dip_pool_destroy(&session->pool);
    dip_config_free(&session->config);
    dip_error_list_free(&session->warnings);
    *session = (DipSession){.isa = DIP_ISA_SCALAR};
}

// --- drawing -------------------------------------------------------------------------------------

// Draws the current pane. The requested pane gets the same pixels, and counters and times of 0.
static bool draw_copied(DipSession *session, const DipPose *pose, int64_t play_ns,
                        DipSessionFrame *frame, DipError *err) {
    DipFrame *copy = &frame->panes[DIP_PANE_REQUESTED];
    const bool drawn = dip_painter_draw(session->renderers[DIP_PANE_CURRENT], session->scene, pose,
                                        play_ns, &frame->panes[DIP_PANE_CURRENT], err);
    *copy = frame->panes[DIP_PANE_CURRENT];
    copy->counters = (DipCounters){0};
    copy->stages = (DipStageTimes){0};
    return drawn;
}

// Chooses the pane that copies shaded pixels from the other one in the next frame
// (dip_renderer_copy_shading). The panes take turns, so that each pane is often drawn without
// copying and its own time can be measured then. A turn lasts two frames, since temporal
// antialiasing alternates between two sample patterns.
static void choose_copying_pane(DipSession *session) {
    const int turn = (int)(session->shared_frames / 2 % DIP_PANE_COUNT);
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        dip_painter_copy_shading(session->renderers[p], session->shares_shading && p == turn);
    }
    session->shared_frames += session->shares_shading;
}

bool dip_session_draw_pose(DipSession *session, const DipPose *pose, int64_t play_ns,
                           uint64_t frame_index, DipSessionFrame *frame, DipError *err) {
    const DipQuality current = dip_painter_quality(session->renderers[DIP_PANE_CURRENT]);
    const DipQuality requested = dip_painter_quality(session->renderers[DIP_PANE_REQUESTED]);
    frame->copied = !session->force_all_effects && dip_quality_equal(&current, &requested);
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        dip_painter_set_frame_index(session->renderers[p], frame_index);
    }
    choose_copying_pane(session);
    DipFrame *const panes[DIP_PANE_COUNT] = {&frame->panes[0], &frame->panes[1]};
    const int64_t begin_ns = dip_clock_ns();
    const bool drawn = frame->copied
                           ? draw_copied(session, pose, play_ns, frame, err)
                           : dip_painter_draw_frames(session->renderers, DIP_PANE_COUNT,
                                                     session->scene, pose, play_ns, panes, err);
    frame->ms = 1e-6 * (double)(dip_clock_ns() - begin_ns);
    return drawn;
}

bool dip_session_draw(DipSession *session, int64_t play_ns, uint64_t frame_index, DipPose *pose,
                      DipSessionFrame *frame, DipError *err) {
    if (!dip_camtrack_pose(&session->track, play_ns, pose)) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "path",
                             "the ini names no camera path; give one with --path FILE");
    }
    if (!dip_session_draw_pose(session, pose, play_ns, frame_index, frame, err)) {
        return false;
    }
    dip_start_times_frame(&session->times);
    return true;
}

// --- the times of the start ----------------------------------------------------------------------

double dip_start_times_since_ms(int64_t begin_ns) {
    return 1e-6 * (double)(dip_clock_ns() - begin_ns);
}

void dip_start_times_frame(DipStartTimes *times) {
    if (times->total_ms == 0.0) {
        times->first_frame_ms = dip_start_times_since_ms(times->opened_ns);
        times->total_ms = dip_start_times_since_ms(times->begin_ns);
    }
}

void dip_start_times_format(const DipStartTimes *times, char *text, size_t size_bytes) {
    snprintf(text, size_bytes, "start, ms:");
#define ADD_PART(name, what) dip_put_append(text, size_bytes, " %s %.1f", #name, times->name##_ms);
    DIP_START_TIME_LIST(ADD_PART)
#undef ADD_PART
}
