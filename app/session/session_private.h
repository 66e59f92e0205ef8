// Declares the parts of opening a session. Private to session*.c.
#ifndef DIP_APP_SESSION_SESSION_PRIVATE_H
#define DIP_APP_SESSION_SESSION_PRIVATE_H

#include "app/session/session.h"

// Adds a copy of the error to the list; returns false.
bool dip_session_add_fault(DipErrorList *faults, const DipError *err);

// Adds an error with these parts (dip_error_set); returns false.
bool dip_session_refuse(DipErrorList *faults, DipErrorCode code, const char *file, int line,
                        const char *key, const char *format, ...) DIP_PRINTF(6, 7);

// Adds the error with the line of the ini that names the file at fault; returns false.
bool dip_session_place_fault(const DipSession *session, const DipConfigFile *file,
                             DipErrorList *faults, const DipError *err);

// Finds a file or folder that comes with Diptych. For a program in a build folder, it is in the
// source tree, and for an installed program in the installation's share folder. Returns whether it
// can be read there.
bool dip_session_find_shipped(const char *name, char *file, size_t size_bytes);

// Creates the painters of both panes for the gallery, or for models if it is NULL. On failure, some
// of them may exist.
bool dip_session_make_painters(const DipSession *session, DipGallery *gallery,
                               const DipQuality qualities[DIP_PANE_COUNT],
                               DipPainter *painters[DIP_PANE_COUNT], DipError *err);

// session_scene.c: lists the models' files, from the command line or the ini, and returns their
// number.
int dip_session_model_files(const DipSession *session, const char *files[DIP_MAX_MODELS]);

// session_scene.c: loads the models and makes the scene.
bool dip_session_load_scene(DipSession *session, bool keep_model, DipErrorList *faults);

// session_paths.c: loads the camera paths and the cameras of the models, or makes an orbit around
// the model.
bool dip_session_load_paths(DipSession *session, DipErrorList *faults);
void dip_session_free_paths(DipSession *session);

// session_gallery.c: finds out whether the session shows a scene of the gallery, and which one.
bool dip_session_choose_gallery(DipSession *session, DipErrorList *faults);

// session_gallery.c: makes the camera path of the gallery's scene and a track that plays it, unless
// the user has given a path.
bool dip_session_load_gallery_path(DipSession *session, DipErrorList *faults);

#endif
