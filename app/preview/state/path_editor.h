// Edits the camera path that the user makes in the window from poses of the camera.
//
// The path has keys: poses that the camera passes one after the other. One of them is the chosen
// key. New keys are inserted after the chosen key, which can also be replaced or deleted. The path
// is saved in the text format (campaths/campath.h) under a name that no file has yet.
#ifndef DIP_APP_PREVIEW_STATE_PATH_EDITOR_H
#define DIP_APP_PREVIEW_STATE_PATH_EDITOR_H

#include "campaths/campath.h"
#include "renderer/base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { DIP_PATH_EDITOR_MAX_KEYS = 10000, DIP_PATH_EDITOR_FILE_BYTES = 32 };

// Only the functions that this file declares change the members.
typedef struct DipPathEditor {
    DipCamKey *keys;
    size_t count;
    size_t capacity;
    size_t chosen;     // Index of the chosen key; 0 if there are no keys.
    int64_t period_ns; // Time from key to key.
    DipCamKey seen;    // The camera's pose, as dip_path_editor_see set it last.
    bool has_seen;     // The camera's pose is known.
    bool jumps;        // The camera moves to the chosen key in the next turn of the loop.
    DipCamPath *fly;   // The path while it is flown; otherwise NULL.
    DipCamPathEnd end; // What the flown path does at its end.
    int64_t at_ns;     // Time since the path's beginning, while the path is flown.
    bool unsaved;      // There are changes that have not been saved.
    char file[DIP_PATH_EDITOR_FILE_BYTES]; // The file that was saved last, or "".
    char said[160];                        // What the last edit did, for a notice.
} DipPathEditor;

typedef enum DipPathEdit {
    DIP_PATH_EDIT_ADD,     // Inserts the camera's pose after the chosen key. The new key is chosen.
    DIP_PATH_EDIT_REPLACE, // Gives the chosen key the camera's pose.
    DIP_PATH_EDIT_DELETE,  // Deletes the chosen key. Chooses the key before it, or else the new
                           // first key.
    DIP_PATH_EDIT_NEXT,    // Chooses the next key and moves the camera there.
    DIP_PATH_EDIT_BEFORE,  // Chooses the key before and moves the camera there.
    DIP_PATH_EDIT_FLY, // Flies the path from the chosen key on, or stops flying. From the last key,
                       // flies the whole path.
    DIP_PATH_EDIT_SAVE,
    DIP_PATH_EDIT_TAKE,   // Replaces the edited path by the path that plays.
    DIP_PATH_EDIT_SLOWER, // Sets the next longer time from key to key.
    DIP_PATH_EDIT_FASTER, // Sets the next shorter time from key to key.
    DIP_PATH_EDIT_COUNT
} DipPathEdit;

DipPathEditor *dip_path_editor_create(DipError *err);
void dip_path_editor_destroy(DipPathEditor **editor);

// Tells the editor the pose of the camera. New and replaced keys get this pose.
void dip_path_editor_see(DipPathEditor *editor, const DipPose *pose);

// Carries out an edit. `playing` is the path that the preview plays, or NULL if there is none.
// `end` says what paths do at their end. Returns false if the edit failed. editor->said tells what
// happened, or why the edit failed.
bool dip_path_editor_edit(DipPathEditor *editor, DipPathEdit edit, const DipCamPath *playing,
                          DipCamPathEnd end);

// Chooses a key, and lets the next turn move the camera there. `index` must be below the number of
// keys.
void dip_path_editor_choose(DipPathEditor *editor, size_t index);

// Lets time pass. If the editor moves the camera, sets the pose's position and orientation and
// returns true.
bool dip_path_editor_turn(DipPathEditor *editor, int64_t elapsed_ns, DipPose *pose);

// Stops flying the path, and drops a move to the chosen key that has not been made yet.
void dip_path_editor_stop(DipPathEditor *editor);

#endif
