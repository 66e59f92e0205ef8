// The parts of opening a session. Private to session*.c.
#ifndef DIP_APP_SESSION_SESSION_PRIVATE_H
#define DIP_APP_SESSION_SESSION_PRIVATE_H

#include "app/session/session.h"

// Adds a copy of the error to the list; returns false.
bool dip_session_add_fault(DipErrorList *faults, const DipError *err);

// Adds the error with the line of the ini that names the file at fault; returns false.
bool dip_session_place_fault(const DipSession *session, const DipConfigFile *file,
                             DipErrorList *faults, const DipError *err);

// session_scene.c: loads the models and makes the scene.
bool dip_session_load_scene(DipSession *session, bool keep_model, DipErrorList *faults);

// session_paths.c: loads the camera paths, or makes an orbit around the model.
bool dip_session_load_paths(DipSession *session, DipErrorList *faults);

// session_cameras.c: reads the cameras of the models that have been loaded.
bool dip_session_load_cameras(DipSession *session, DipErrorList *faults);
void dip_session_free_cameras(DipSession *session);

// session_cameras.c: returns the camera with this name, or NULL.
const DipSessionCamera *dip_session_find_camera(const DipSession *session, const char *name);

// session_cameras.c: adds the cameras to the track.
void dip_session_track_cameras(DipSession *session);

// session_cameras.c: says that --path names neither a file nor a camera. Returns false.
bool dip_session_refuse_path(const DipSession *session, DipErrorList *faults);

// session_gallery.c: finds out whether the session shows a scene of the gallery, and which one.
bool dip_session_choose_gallery(DipSession *session, DipErrorList *faults);

// Makes the camera path of the gallery's scene and a track that plays it, unless the user has given
// a path.
bool dip_session_load_gallery_path(DipSession *session, DipErrorList *faults);

#endif
