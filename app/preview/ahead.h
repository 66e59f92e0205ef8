// What a change of a setting would have to wait for, made ahead on a thread of its own.
//
// In the preview any setting may be asked for with the next key. Once the first picture is there,
// the compressed textures of opt=standard and opt=advanced are made beside the frames, so that the
// change costs no frame. A frame that needs them earlier waits for them.
#ifndef DIP_APP_PREVIEW_AHEAD_H
#define DIP_APP_PREVIEW_AHEAD_H

#include "renderer/scene/scene.h"

#include <pthread.h>
#include <stdbool.h>

typedef struct DipAhead {
    const DipScene *scene; // NULL: not begun
    pthread_t thread;
    bool running;
} DipAhead;

// Begins; does nothing when called again. The scene must outlive dip_ahead_end.
void dip_ahead_begin(DipAhead *ahead, const DipScene *scene);

// Waits until it is done.
void dip_ahead_end(DipAhead *ahead);

#endif
