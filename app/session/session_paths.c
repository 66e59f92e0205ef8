// The camera paths of a session: the paths of the ini, the path of --path, or an orbit around the
// model.
#include "app/session/session_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

static const int64_t pose_period_ns = 1000000000; // Duration of the path of --pose.

double dip_session_fov(const DipSession *session, double fov_y_deg) {
    return session->options->fov_y_deg > 0.0 ? session->options->fov_y_deg : fov_y_deg;
}

// Plays a path in a category. name: of a camera of the models, or NULL.
static void play(DipSession *session, int category, const DipCamPath *path, double fov_y_deg,
                 const char *name) {
    dip_camtrack_set_named(&session->track, category, path, dip_session_fov(session, fov_y_deg),
                           name);
}

// Takes ownership of a path and plays it in a category.
static void keep_path(DipSession *session, DipCamPath *path, int category, double fov_y_deg) {
    session->paths[session->path_count++] = path;
    play(session, category, path, fov_y_deg, NULL);
}

// Returns the camera that a name of a path means, or NULL. A file of this name comes first.
static const DipSessionCamera *camera_of(const DipSession *session, const char *file,
                                         const char *name) {
    return access(file, F_OK) == 0 ? NULL : dip_session_find_camera(session, name);
}

// Loads the path of one of the ini's categories. A file that an earlier category names is not
// loaded again.
static bool load_category(DipSession *session, int category, DipErrorList *faults) {
    const DipConfigCamera *camera = &session->config.camera[category];
    if (!camera->file.path) {
        return true;
    }
    for (int other = 0; other < category; other++) {
        const DipConfigFile *file = &session->config.camera[other].file;
        if (file->path && dip_config_same_file(file, &camera->file) &&
            session->track.categories[other].path) {
            play(session, category, session->track.categories[other].path, camera->fov_y_deg, NULL);
            return true;
        }
    }
    const DipSessionCamera *own = camera_of(session, camera->file.path, camera->file.text);
    if (own) {
        const bool given = session->config.line[DIP_KEY_CAMPATH_DEFAULT + 2 * category + 1] > 0;
        play(session, category, own->path, given ? camera->fov_y_deg : own->fov_y_deg, own->name);
        return true;
    }
    DipCamPath *path;
    DipError err;
    if (!dip_campath_load(camera->file.path, &path, &err)) {
        if (err.line) {
            // The error already names a line of the path file, which is more useful than the line
            // of the ini.
            return dip_session_add_fault(faults, &err);
        }
        return dip_session_place_fault(session, &camera->file, faults, &err);
    }
    keep_path(session, path, category, camera->fov_y_deg);
    return true;
}

// Loads the file of --path, or plays the camera that --path names.
static bool load_own_path(DipSession *session, DipErrorList *faults) {
    const char *name = session->options->path;
    const DipSessionCamera *camera = camera_of(session, name, name);
    if (camera) {
        play(session, 0, camera->path, camera->fov_y_deg, camera->name);
        return true;
    }
    if (session->camera_count > 0 && access(name, F_OK) != 0) {
        return dip_session_refuse_path(session, faults);
    }
    DipCamPath *path;
    DipError err;
    if (!dip_campath_load(session->options->path, &path, &err)) {
        return dip_session_add_fault(faults, &err);
    }
    keep_path(session, path, 0, session->config.camera[DIP_CATEGORY_DEFAULT].fov_y_deg);
    return true;
}

// Makes a path of one key, at which the camera stands still.
static bool make_pose(DipSession *session, DipErrorList *faults) {
    DipCamPath *path;
    DipError err;
    if (!dip_campath_create(&session->options->pose, 1, pose_period_ns, &path, &err)) {
        return dip_session_add_fault(faults, &err);
    }
    keep_path(session, path, 0, session->config.camera[DIP_CATEGORY_DEFAULT].fov_y_deg);
    return true;
}

// Refuses a model that is too small to be drawn. The orbit fills the picture with the model, so the
// camera would come nearer than the least distance of a near plane (DIP_MIN_NEAR_M). A model that
// is a single point is accepted: the orbit treats it as if it had a size.
static bool check_extent(const float low[3], const float high[3], const char *file,
                         DipErrorList *faults) {
    const double least = 5e-9;
    double extent = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        extent = fmax(extent, (double)high[axis] - low[axis]);
    }
    if (extent == 0.0 || extent >= least) {
        return true;
    }
    return dip_session_refuse(
        faults, DIP_ERROR_RANGE, file, 0, "box",
        "the model's size is %.3g, but Diptych needs at least %g; scale the model up", extent,
        least);
}

static bool make_orbit(DipSession *session, DipErrorList *faults) {
    float low[3];
    float high[3];
    dip_scene_bounds(session->scene, low, high);
    DipCamOrbitDef def = dip_campath_default_orbit();
    const DipConfigSize size = session->pane_size;
    def.aspect = fmin(fmax((double)size.width / size.height, 0.01), 100.0);
    for (int axis = 0; axis < 3; axis++) {
        def.min_world[axis] = low[axis];
        def.max_world[axis] = high[axis];
    }
    const char *file = session->config.file;
    if (session->options->model_count) {
        file = session->options->models[0];
    } else {
        def.fov_y_deg = session->config.camera[DIP_CATEGORY_DEFAULT].fov_y_deg;
    }
    def.fov_y_deg = dip_session_fov(session, def.fov_y_deg);
    DipCamPath *path;
    DipError err;
    if (!check_extent(low, high, file, faults)) {
        return false;
    }
    if (!dip_campath_orbit(&def, &path, &err)) {
        return dip_session_refuse(faults, err.code, file, 0, err.key, "%s", err.message);
    }
    keep_path(session, path, 0, def.fov_y_deg);
    session->orbiting = true;
    return true;
}

// The key of a category is "CAMPATH_" and its name.
const char *dip_session_category(int category) {
    return dip_config_key_name((DipConfigKey)(DIP_KEY_CAMPATH_DEFAULT + 2 * category)) +
           strlen("CAMPATH_");
}

const char *dip_session_path_name(const DipSession *session, int category) {
    return category < DIP_CATEGORY_COUNT ? dip_session_category(category)
                                         : session->track.categories[category].name;
}

static bool choose_category(DipSession *session, DipErrorList *faults) {
    if (!session->options->category) {
        return true;
    }
    char known[160] = "";
    for (int c = 0; c < DIP_CATEGORY_COUNT; c++) {
        const char *name = dip_session_category(c);
        if (strcasecmp(name, session->options->category) == 0) {
            session->track.active = c;
            return true;
        }
        strcat(strcat(known, c ? "|" : ""), name);
    }
    return dip_session_refuse(faults, DIP_ERROR_UNKNOWN, NULL, 0, "--category",
                              "'%.40s' is not a camera path of the ini; give one of %s",
                              session->options->category, known);
}

static bool load_all(DipSession *session, DipErrorList *faults) {
    if (session->options->path) {
        return load_own_path(session, faults);
    }
    if (session->options->has_pose) {
        return make_pose(session, faults);
    }
    if (session->options->model_count) {
        return !session->scene || make_orbit(session, faults);
    }
    bool loaded = true;
    for (int c = 0; c < DIP_CATEGORY_COUNT; c++) {
        loaded = load_category(session, c, faults) && loaded;
    }
    if (!session->config.camera[DIP_CATEGORY_DEFAULT].file.path && session->scene) {
        loaded = make_orbit(session, faults) && loaded;
    }
    return choose_category(session, faults) && loaded;
}

bool dip_session_load_paths(DipSession *session, DipErrorList *faults) {
    session->track = dip_camtrack_make(session->config.campath_reset_on_switch);
    dip_camtrack_set_end(&session->track, session->options->path_end);
    session->paths = calloc(DIP_CATEGORY_COUNT, sizeof(DipCamPath *));
    if (!session->paths) {
        return dip_session_refuse(faults, DIP_ERROR_MEMORY, NULL, 0, "paths", "out of memory");
    }
    if (session->scene && !dip_session_load_cameras(session, faults)) {
        return false;
    }
    const bool loaded = load_all(session, faults);
    dip_session_track_cameras(session);
    return loaded;
}
