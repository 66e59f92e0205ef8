// Loads the camera paths of a session: the paths of the ini, the path of --path, the fixed pose of
// --pose, or an orbit around the model. Also makes a path of each camera of the models.
#include "app/session/session_private.h"

#include "assets/cameras.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

static const int64_t pose_period_ns = 1000000000; // Duration of the path of --pose.

double dip_session_fov(const DipSession *session, double fov_y_deg) {
    return session->options->fov_y_deg > 0.0 ? session->options->fov_y_deg : fov_y_deg;
}

// Returns the field of view of the ini's default path.
static double default_fov(const DipSession *session) {
    return session->config.camera[DIP_CATEGORY_DEFAULT].fov_y_deg;
}

// --- the cameras of the models -------------------------------------------------------------------

static bool out_of_memory(DipErrorList *faults) {
    return dip_session_refuse(faults, DIP_ERROR_MEMORY, NULL, 0, "cameras", "out of memory");
}

// Makes the path of a model's camera by copying its keys. A key of the camera has the numbers of a
// key of a path, in the same order.
static bool make_camera_path(const DipModelCamera *camera, DipSessionCamera *to,
                             DipErrorList *faults) {
    DipCamKey *keys = malloc(camera->key_count * sizeof *keys);
    *to = (DipSessionCamera){.name = strdup(camera->name), .fov_y_deg = camera->fov_y_deg};
    if (!keys || !to->name) {
        free(keys);
        return out_of_memory(faults);
    }
    for (size_t i = 0; i < camera->key_count; i++) {
        memcpy(keys[i].position_world, camera->keys[i], sizeof keys[i].position_world);
        memcpy(keys[i].orientation, camera->keys[i] + 3, sizeof keys[i].orientation);
    }
    DipError err;
    const bool made =
        dip_campath_create(keys, camera->key_count, camera->period_ns, &to->path, &err);
    free(keys);
    return made || dip_session_add_fault(faults, &err);
}

static bool add_cameras(DipSession *session, const DipModelCameras *found, DipErrorList *faults) {
    int count;
    const DipModelCamera *list = dip_model_cameras_list(found, &count);
    if (count == 0) {
        return true;
    }
    DipSessionCamera *cameras =
        realloc(session->cameras, (size_t)(session->camera_count + count) * sizeof *cameras);
    if (!cameras) {
        return out_of_memory(faults);
    }
    session->cameras = cameras;
    bool made = true;
    for (int i = 0; made && i < count; i++) {
        made = make_camera_path(&list[i], &cameras[session->camera_count++], faults);
    }
    return made;
}

// Reads the cameras of a model that has been loaded. If they cannot be read, adds only a warning,
// because the model can be drawn without them. A fault that is not the file's, such as memory that
// runs out, is an error.
static bool load_cameras_of(DipSession *session, const char *file, DipErrorList *faults) {
    DipError err = {0};
    DipModelCameras *found = dip_model_cameras_load(file, session->options->up, faults, &err);
    if (!found && err.origin == DIP_ORIGIN_RUNTIME) {
        return dip_session_add_fault(faults, &err);
    }
    if (!found) {
        DipError warning;
        dip_error_set(&warning, err.code, err.file, err.line, err.key,
                      "the cameras are not read: %s", err.message);
        warning.severity = DIP_SEVERITY_WARNING;
        dip_error_list_add(faults, &warning);
        return true;
    }
    const bool added = add_cameras(session, found, faults);
    dip_model_cameras_destroy(&found);
    return added;
}

static bool load_cameras(DipSession *session, DipErrorList *faults) {
    const char *files[DIP_MAX_MODELS];
    const int count = dip_session_model_files(session, files);
    bool loaded = true;
    for (int i = 0; loaded && i < count; i++) {
        loaded = load_cameras_of(session, files[i], faults);
    }
    return loaded;
}

// Returns whether something with this name exists and is not a folder.
static bool is_there(const char *file) {
    struct stat status;
    return stat(file, &status) == 0 && !S_ISDIR(status.st_mode);
}

// Returns the camera with this name, or NULL if there is none or if `file` exists. The value of
// --path or of an ini key may name a file or a camera, and a file has precedence.
static const DipSessionCamera *camera_of(const DipSession *session, const char *file,
                                         const char *name) {
    for (int i = 0; !is_there(file) && i < session->camera_count; i++) {
        if (strcmp(session->cameras[i].name, name) == 0) {
            return &session->cameras[i];
        }
    }
    return NULL;
}

// Adds as many cameras of the models to the track as the track has room for.
static void track_cameras(DipSession *session) {
    const int room = DIP_CAMTRACK_CATEGORIES - DIP_CATEGORY_COUNT;
    for (int i = 0; i < session->camera_count && i < room; i++) {
        const DipSessionCamera *camera = &session->cameras[i];
        dip_camtrack_set_named(&session->track, DIP_CATEGORY_COUNT + i, camera->path,
                               dip_session_fov(session, camera->fov_y_deg), camera->name);
    }
}

// Fails because --path names neither a file nor a camera. The message lists the cameras.
static bool refuse_path(const DipSession *session, DipErrorList *faults) {
    DipNameList list = {.text = "a file"};
    for (int i = 0; i < session->camera_count; i++) {
        dip_name_list_add(&list, session->cameras[i].name);
    }
    return dip_session_refuse(faults, DIP_ERROR_MISSING, NULL, 0, "--path",
                              "'%.60s' is neither a file nor a camera of the models, accepted %s",
                              session->options->path, dip_name_list_end(&list));
}

// --- paths ---------------------------------------------------------------------------------------

// Sets the path of a category of the track. If the path is that of a model's camera, `name` is the
// camera's name, otherwise NULL. Returns true.
static bool play(DipSession *session, int category, const DipCamPath *path, double fov_y_deg,
                 const char *name) {
    dip_camtrack_set_named(&session->track, category, path, dip_session_fov(session, fov_y_deg),
                           name);
    return true;
}

// Takes ownership of a path and gives it to a category of the track. Returns true.
static bool keep_path(DipSession *session, DipCamPath *path, int category, double fov_y_deg) {
    session->paths[session->path_count++] = path;
    return play(session, category, path, fov_y_deg, NULL);
}

// Loads the path of one of the ini's categories. A file that an earlier category names is not
// loaded again.
static bool load_category(DipSession *session, int category, DipErrorList *faults) {
    const DipConfigCamera *camera = &session->config.camera[category];
    if (!camera->file.path) {
        return true;
    }
    const DipSessionCamera *own = camera_of(session, camera->file.path, camera->file.text);
    if (own) {
        const bool given = session->config.line[DIP_KEY_CAMPATH_DEFAULT + 2 * category + 1] > 0;
        return play(session, category, own->path, given ? camera->fov_y_deg : own->fov_y_deg,
                    own->name);
    }
    for (int other = 0; other < category; other++) {
        const DipConfigFile *file = &session->config.camera[other].file;
        if (file->path && dip_config_same_file(file, &camera->file) &&
            session->track.categories[other].path) {
            return play(session, category, session->track.categories[other].path, camera->fov_y_deg,
                        NULL);
        }
    }
    DipCamPath *path;
    DipError err;
    if (dip_campath_load(camera->file.path, &path, &err)) {
        return keep_path(session, path, category, camera->fov_y_deg);
    }
    // An error that names a line of the path file is more useful than the line of the ini.
    return err.line ? dip_session_add_fault(faults, &err)
                    : dip_session_place_fault(session, &camera->file, faults, &err);
}

// Loads the file that --path names, or takes the path of the camera that --path names.
static bool load_own_path(DipSession *session, DipErrorList *faults) {
    const char *name = session->options->path;
    const DipSessionCamera *camera = camera_of(session, name, name);
    if (camera) {
        return play(session, 0, camera->path, camera->fov_y_deg, camera->name);
    }
    if (session->camera_count > 0 && access(name, F_OK) != 0) {
        return refuse_path(session, faults);
    }
    DipCamPath *path;
    DipError err;
    return dip_campath_load(name, &path, &err) ? keep_path(session, path, 0, default_fov(session))
                                               : dip_session_add_fault(faults, &err);
}

// Makes a path of one key, at which the camera stands still.
static bool make_pose(DipSession *session, DipErrorList *faults) {
    DipCamPath *path;
    DipError err;
    return dip_campath_create(&session->options->pose, 1, pose_period_ns, &path, &err)
               ? keep_path(session, path, 0, default_fov(session))
               : dip_session_add_fault(faults, &err);
}

// Refuses a model that is too small to be drawn. The orbit fills the picture with the model, so the
// camera would come nearer to the model than the least distance of a near plane (DIP_MIN_NEAR_M).
// Accepts a model that is a single point, because the orbit treats it as if it had a size.
static bool check_extent(const DipExtent *extent, const char *file, DipErrorList *faults) {
    const double least = 5e-9;
    double size = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        size = fmax(size, extent->high[axis] - extent->low[axis]);
    }
    if (size == 0.0 || size >= least) {
        return true;
    }
    return dip_session_refuse(
        faults, DIP_ERROR_RANGE, file, 0, "box",
        "the model's size is %.3g, but Diptych needs at least %g; scale the model up", size, least);
}

static bool make_orbit(DipSession *session, DipErrorList *faults) {
    const DipExtent *extent = &session->extent;
    DipCamOrbitDef def = dip_campath_default_orbit();
    const DipConfigSize size = session->pane_size;
    def.aspect = fmin(fmax((double)size.width / size.height, 0.01), 100.0);
    for (int axis = 0; axis < 3; axis++) {
        def.min_world[axis] = extent->low[axis];
        def.max_world[axis] = extent->high[axis];
    }
    def.radii = session->silhouette.radius;
    def.radius_count = DIP_SILHOUETTE_SLICES;
    const char *file = session->config.file;
    if (session->options->model_count) {
        file = session->options->models[0];
    } else {
        def.fov_y_deg = default_fov(session);
    }
    def.fov_y_deg = dip_session_fov(session, def.fov_y_deg);
    DipCamPath *path;
    DipError err;
    if (!check_extent(extent, file, faults)) {
        return false;
    }
    if (!dip_campath_orbit(&def, &path, &err)) {
        return dip_session_refuse(faults, err.code, file, 0, err.key, "%s", err.message);
    }
    session->orbiting = true;
    return keep_path(session, path, 0, def.fov_y_deg);
}

// The ini's key for a category is "CAMPATH_" and the category's name.
const char *dip_session_category(int category) {
    if (category < 0 || category >= DIP_CATEGORY_COUNT) {
        return "?";
    }
    return dip_config_key_name((DipConfigKey)(DIP_KEY_CAMPATH_DEFAULT + 2 * category)) +
           strlen("CAMPATH_");
}

const char *dip_session_path_name(const DipCamTrack *track, int category) {
    const bool is_camera = category >= DIP_CATEGORY_COUNT && category < DIP_CAMTRACK_CATEGORIES;
    const char *name = is_camera ? track->categories[category].name : NULL;
    return name ? name : dip_session_category(category);
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

bool dip_session_orbits(const DipSession *session) {
    const DipSessionOptions *options = session->options;
    return !options->path && !options->has_pose &&
           (options->model_count || !session->config.camera[DIP_CATEGORY_DEFAULT].file.path);
}

static bool load_all(DipSession *session, DipErrorList *faults) {
    if (session->options->path) {
        return load_own_path(session, faults);
    }
    if (session->options->has_pose) {
        return make_pose(session, faults);
    }
    bool loaded = true;
    for (int c = 0; !session->options->model_count && c < DIP_CATEGORY_COUNT; c++) {
        loaded = load_category(session, c, faults) && loaded;
    }
    if (dip_session_orbits(session) && session->scene) {
        loaded = make_orbit(session, faults) && loaded;
    }
    if (session->options->model_count) {
        return loaded;
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
    if (session->scene && !load_cameras(session, faults)) {
        return false;
    }
    const bool loaded = load_all(session, faults);
    track_cameras(session);
    return loaded;
}

void dip_session_free_paths(DipSession *session) {
    for (int i = 0; i < session->path_count; i++) {
        dip_campath_destroy(&session->paths[i]);
    }
    free(session->paths);
    for (int i = 0; i < session->camera_count; i++) {
        free(session->cameras[i].name);
        dip_campath_destroy(&session->cameras[i].path);
    }
    free(session->cameras);
}
