// Declares the functions that open a session and are private to session*.c. Functions that make,
// load or choose something return false on failure. The list `faults` collects errors and warnings.
#ifndef DIP_APP_SESSION_SESSION_PRIVATE_H
#define DIP_APP_SESSION_SESSION_PRIVATE_H

#include "app/session/session.h"

// Adds a copy of the error to the list. Returns false.
bool dip_session_add_fault(DipErrorList *faults, const DipError *err);

// Makes an error of these parts, as dip_error_set does, and adds it to the list. Returns false.
bool dip_session_refuse(DipErrorList *faults, DipErrorCode code, const char *file, int line,
                        const char *key, const char *format, ...) DIP_PRINTF(6, 7);

// Adds the error with the line of the ini that names the file at fault. Returns false.
bool dip_session_place_fault(const DipSession *session, const DipConfigFile *file,
                             DipErrorList *faults, const DipError *err);

// Finds the file or folder `name` that comes with Diptych, and writes its path to `file`. Looks in
// the source tree if the program runs from a build folder, and in the share folder if the program
// is installed. Returns false if `name` cannot be read there.
bool dip_session_find_shipped(const char *name, char *file, size_t size_bytes);

// Creates the painters of both panes, which draw the gallery, or models if `gallery` is NULL. Even
// after a failure, the caller must destroy the painters that were created.
bool dip_session_make_painters(const DipSession *session, DipGallery *gallery,
                               const DipQuality qualities[DIP_PANE_COUNT],
                               DipPainter *painters[DIP_PANE_COUNT], DipError *err);

// Reads the pictures that stand for mip levels in mip debugging, and gives them to the painters.
// The ini's keys MIPDEBUGBASE1024, MIPDEBUG512, ... name the files of these pictures. A level
// without a picture keeps its debug colour. If a picture cannot be read, the error has the line of
// the ini that names this picture. In session.c.
bool dip_session_load_mip_pictures(DipSession *session, DipPainter *const painters[DIP_PANE_COUNT],
                                   DipErrorList *faults);

// Lists the models' files, from the command line or the ini, and returns their number. In
// session_scene.c.
int dip_session_model_files(const DipSession *session, const char *files[DIP_MAX_MODELS]);

// Loads the models and makes the scene. If keep_model is true, keeps the models' data. In
// session_scene.c.
bool dip_session_load_scene(DipSession *session, bool keep_model, DipErrorList *faults);
void dip_session_free_animations(DipSession *session);

// Returns whether the camera will orbit the models, because neither a path nor a pose is given. In
// session_paths.c.
bool dip_session_orbits(const DipSession *session);

// Loads the camera paths and the cameras of the models, or makes an orbit around the model. In
// session_paths.c.
bool dip_session_load_paths(DipSession *session, DipErrorList *faults);
void dip_session_free_paths(DipSession *session);

// Finds out whether the session shows a scene of the gallery, and which one. Also finds the folder
// of the shipped assets. In session_gallery.c.
bool dip_session_choose_gallery(DipSession *session, DipErrorList *faults);

// Makes the camera path of the gallery's scene and a track that plays it. If the user has given a
// path or a pose, loads that path or makes a path of that pose instead. In session_gallery.c.
bool dip_session_load_gallery_path(DipSession *session, DipErrorList *faults);

#endif
