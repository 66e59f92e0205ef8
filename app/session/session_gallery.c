// Chooses the scene of the gallery that a session shows, makes the scene's camera path, and goes to
// another scene.
#include "app/session/session_private.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Finds the folder of the shipped assets. If there is none near the program, takes the folder
// `assets` beside the folder of the ini.
static bool find_assets(DipSession *session, DipErrorList *faults) {
    char folder[PATH_MAX + 16];
    if (dip_session_find_shipped("assets/gallery", folder, sizeof folder)) {
        *strrchr(folder, '/') = '\0';
    } else {
        const char *ini = session->config.file;
        const char *slash = strrchr(ini, '/');
        snprintf(folder, sizeof folder, "%.*s/../assets", slash ? (int)(slash - ini) : 1,
                 slash ? ini : ".");
    }
    session->assets = strdup(folder);
    return session->assets ||
           dip_session_refuse(faults, DIP_ERROR_MEMORY, NULL, 0, "assets", "out of memory");
}

bool dip_session_choose_gallery(DipSession *session, DipErrorList *faults) {
    const DipSessionOptions *options = session->options;
    const char *name = options->scene ? options->scene : session->config.scene.text;
    DipError err;
    const bool models = options->model_count || !name[0] || strcmp(name, "models") == 0 ||
                        dip_session_shipped_ini(options);
    session->shows_gallery = !models;
    if (!models && !dip_gallery_find(name, &session->gallery_scene, &err)) {
#define OR_NAME(name) "|" #name
        return options->scene
                   ? dip_session_refuse(faults, err.code, NULL, 0, err.key,
                                        "%s|models" DIP_SHIPPED_SCENE_LIST(OR_NAME), err.message)
                   : dip_session_refuse(faults, err.code, session->config.file,
                                        session->config.line[DIP_KEY_SCENE], "SCENE", "%s",
                                        err.message);
#undef OR_NAME
    }
    return find_assets(session, faults);
}

DipGallery *dip_session_open_gallery(const DipSession *session, DipPool *pool, DipIsa isa,
                                     DipError *err) {
    const DipGalleryDef def = {session->gallery_scene, pool, isa, session->assets};
    DipGallery *gallery = dip_gallery_create(&def, err);
    if (gallery) {
        dip_gallery_set_look(gallery, session->options->look);
    }
    return gallery;
}

// --- camera paths --------------------------------------------------------------------------------

// Makes the camera path of a scene of the gallery, with 64 keys per second. The tour (all scenes,
// one after another) flies to the next scene in the last 1/64 s of each scene. Scenes end at whole
// seconds, so no frame at 30 or 60 frames per second lies within this time and shows the flight.
static DipCamPath *make_path(int scene, DipError *err) {
    static const int64_t period_ns = 15625000;
    const size_t count = (size_t)(dip_gallery_duration_ns(scene) / period_ns);
    DipCamKey *keys = malloc(count * sizeof *keys);
    DipCamPath *path;
    if (!keys) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "paths", "out of memory");
        return NULL;
    }
    for (size_t i = 0; i < count; i++) {
        DipPose pose;
        dip_gallery_pose(scene, (int64_t)i * period_ns, &pose);
        memcpy(keys[i].position_world, pose.position_world, sizeof keys[i].position_world);
        memcpy(keys[i].orientation, pose.orientation, sizeof keys[i].orientation);
    }
    (void)dip_campath_create(keys, count, period_ns, &path, err); // `path` is NULL on failure.
    free(keys);
    return path;
}

static void play_path(DipSession *session, DipCamPath *path) {
    dip_campath_destroy(&session->gallery_path);
    session->gallery_path = path;
    session->track = dip_camtrack_make(session->config.campath_reset_on_switch);
    dip_camtrack_set(&session->track, 0, path, dip_session_fov(session, DIP_GALLERY_FOV_Y_DEG));
}

bool dip_session_load_gallery_path(DipSession *session, DipErrorList *faults) {
    DipError err;
    if (session->options->path || session->options->has_pose) {
        return dip_session_load_paths(session, faults);
    }
    DipCamPath *path = make_path(session->gallery_scene, &err);
    if (!path) {
        return dip_session_add_fault(faults, &err);
    }
    play_path(session, path);
    return true;
}

// --- going to another scene ----------------------------------------------------------------------

// Gives the painters the ini's pictures of mip levels. On failure, *err is the first fault.
static bool load_mip_pictures(DipSession *session, DipPainter *const painters[DIP_PANE_COUNT],
                              DipError *err) {
    DipErrorList faults = {0};
    const bool loaded = dip_session_load_mip_pictures(session, painters, &faults);
    if (!loaded && err) {
        *err = faults.items[0];
    }
    dip_error_list_free(&faults);
    return loaded;
}

// Shows a scene of the gallery, or the models if scene is the number of scenes.
static bool show_scene(DipSession *session, int scene, DipError *err) {
    const bool models = scene == dip_gallery_scene_count();
    const DipQuality qualities[DIP_PANE_COUNT] = {dip_painter_quality(session->renderers[0]),
                                                  dip_painter_quality(session->renderers[1])};
    DipPainter *painters[DIP_PANE_COUNT] = {NULL, NULL};
    DipGallery *gallery = NULL;
    DipCamPath *path = NULL;
    if (!models) { // --look is for the first scene only, so this one has its first look.
        const DipGalleryDef def = {scene, session->pool, session->isa, session->assets};
        gallery = dip_gallery_create(&def, err);
        path = gallery ? make_path(scene, err) : NULL;
    }
    if ((!models && !path) ||
        !dip_session_make_painters(session, gallery, qualities, painters, err) ||
        (models && !load_mip_pictures(session, painters, err))) {
        dip_painter_destroy(&painters[0]);
        dip_painter_destroy(&painters[1]);
        dip_campath_destroy(&path);
        dip_gallery_destroy(&gallery);
        return false;
    }
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        dip_painter_destroy(&session->renderers[p]);
        session->renderers[p] = painters[p];
    }
    dip_gallery_destroy(&session->gallery);
    session->gallery = gallery;
    if (!session->shows_gallery) {
        session->models_track = session->track;
    }
    session->shows_gallery = !models;
    session->gallery_scene = scene;
    if (models) {
        dip_campath_destroy(&session->gallery_path);
        session->track = session->models_track;
    } else {
        play_path(session, path);
    }
    return true;
}

bool dip_session_step_scene(DipSession *session, int step, DipError *err) {
    const int ring = dip_gallery_scene_count() + (session->scene ? 1 : 0);
    const int now = session->shows_gallery ? session->gallery_scene : dip_gallery_scene_count();
    // After the tour comes the first scene, and before the tour the last scene of the ring.
    const int from = now == DIP_GALLERY_TOUR ? (step > 0 ? -1 : 0) : now;
    return show_scene(session, (from + step + ring) % ring, err);
}

const char *dip_session_scene_title(const DipSession *session, int64_t play_ns) {
    if (!session->shows_gallery) {
        return "Models";
    }
    return dip_gallery_info(dip_gallery_scene_at(session->gallery_scene, play_ns))->title;
}

const char *dip_session_scene_look(const DipSession *session, int look, int64_t play_ns) {
    const DipGalleryInfo *info =
        dip_gallery_info(dip_gallery_scene_at(session->gallery_scene, play_ns));
    return info->looks[(look % info->look_count + info->look_count) % info->look_count];
}
