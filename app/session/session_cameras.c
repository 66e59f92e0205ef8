// The cameras of a session's models as camera paths.
#include "app/session/session_private.h"

#include "assets/cameras.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool out_of_memory(DipErrorList *faults) {
    return dip_session_refuse(faults, DIP_ERROR_MEMORY, NULL, 0, "cameras", "out of memory");
}

// Makes the path of a camera. A key of both has the same numbers in the same order.
static bool make_path(const DipModelCamera *camera, DipSessionCamera *to, DipErrorList *faults) {
    DipCamKey *keys = malloc(camera->key_count * sizeof *keys);
    to->name = malloc(strlen(camera->name) + 1);
    if (!keys || !to->name) {
        free(keys);
        return out_of_memory(faults);
    }
    strcpy(to->name, camera->name);
    to->fov_y_deg = camera->fov_y_deg;
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
    for (int i = 0; i < count; i++) {
        DipSessionCamera *camera = &cameras[session->camera_count++];
        *camera = (DipSessionCamera){.fov_y_deg = 0.0};
        if (!make_path(&list[i], camera, faults)) {
            return false;
        }
    }
    return true;
}

// Reads the cameras of a model that has been loaded. If they cannot be read, that is a warning,
// because the model can be drawn without them.
static bool load_file(DipSession *session, const char *file, DipErrorList *faults) {
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

bool dip_session_load_cameras(DipSession *session, DipErrorList *faults) {
    const char *files[DIP_MAX_MODELS];
    const int count = dip_session_model_files(session, files);
    bool loaded = true;
    for (int i = 0; loaded && i < count; i++) {
        loaded = load_file(session, files[i], faults);
    }
    return loaded;
}

void dip_session_free_cameras(DipSession *session) {
    for (int i = 0; i < session->camera_count; i++) {
        free(session->cameras[i].name);
        dip_campath_destroy(&session->cameras[i].path);
    }
    free(session->cameras);
    session->cameras = NULL;
    session->camera_count = 0;
}

const DipSessionCamera *dip_session_find_camera(const DipSession *session, const char *name) {
    for (int i = 0; i < session->camera_count; i++) {
        if (strcmp(session->cameras[i].name, name) == 0) {
            return &session->cameras[i];
        }
    }
    return NULL;
}

void dip_session_track_cameras(DipSession *session) {
    const int room = DIP_CAMTRACK_CATEGORIES - DIP_CATEGORY_COUNT;
    for (int i = 0; i < session->camera_count && i < room; i++) {
        const DipSessionCamera *camera = &session->cameras[i];
        dip_camtrack_set_named(&session->track, DIP_CATEGORY_COUNT + i, camera->path,
                               dip_session_fov(session, camera->fov_y_deg), camera->name);
    }
}

bool dip_session_refuse_path(const DipSession *session, DipErrorList *faults) {
    char list[200] = "";
    size_t length = 0;
    int left_out = 0;
    for (int i = 0; i < session->camera_count; i++) {
        const char *name = session->cameras[i].name;
        if (length + strlen(name) + 5 > sizeof list) {
            left_out++;
            continue;
        }
        length += (size_t)snprintf(list + length, sizeof list - length, ", \"%s\"", name);
    }
    char more[24] = "";
    if (left_out > 0) {
        snprintf(more, sizeof more, " and %d more", left_out);
    }
    return dip_session_refuse(
        faults, DIP_ERROR_MISSING, NULL, 0, "--path",
        "'%.60s' is neither a file nor a camera of the models, accepted a file%s%s",
        session->options->path, list, more);
}
