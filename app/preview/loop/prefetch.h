// Makes compressed textures on a thread of its own, before a change of settings needs them.
//
// The settings opt=standard and opt=advanced need compressed textures. This thread makes the
// textures after the first picture shows, while further frames are drawn, so that a change to these
// settings delays no frame. A frame that needs the textures earlier waits for them.
#ifndef DIP_APP_PREVIEW_LOOP_PREFETCH_H
#define DIP_APP_PREVIEW_LOOP_PREFETCH_H

#include "renderer/scene/scene.h"

#include <pthread.h>
#include <stdbool.h>

// Zero-initialise.
typedef struct DipPrefetch {
    const DipScene *scene; // Borrowed; NULL before dip_prefetch_begin.
    pthread_t thread;
    bool running;
} DipPrefetch;

// Starts the thread; a second call does nothing. The scene must outlive dip_prefetch_end.
void dip_prefetch_begin(DipPrefetch *prefetch, const DipScene *scene);

// Waits until the thread has ended.
void dip_prefetch_end(DipPrefetch *prefetch);

#endif
