// Writes the options that name a scene, for the command lines that the window shows.
#ifndef DIP_APP_PREVIEW_STATE_SCENE_WORDS_H
#define DIP_APP_PREVIEW_STATE_SCENE_WORDS_H

#include "app/session/session.h"

enum { DIP_SCENE_WORDS_BYTES = 1024 };

// Writes the options that choose the ini, the models and how they show, the scene of the gallery,
// the camera path and the size of a pane, as the command line gave them. A blank precedes each
// option, as in " --model a.glb --size 640x480". `look` is the variant of the gallery's scene that
// shows, counted from 0; the option --look is written if `look` is above 0. Values that a shell
// would split or change stand in quotes. `text` is empty if there is nothing to write or `options`
// is NULL. " ..." stands for options that do not fit.
void dip_scene_words(const DipSessionOptions *options, int look, char text[DIP_SCENE_WORDS_BYTES]);

#endif
