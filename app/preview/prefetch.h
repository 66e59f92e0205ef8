// Prepares on a thread of its own what a change of a setting would otherwise have to wait for.
//
// The next key may ask for any setting. Once the first picture shows, this thread makes the
// compressed textures of opt=standard and opt=advanced beside the frames, so that the change costs
// no frame. A frame that needs them earlier waits for them.
#ifndef DIP_APP_PREVIEW_PREFETCH_H
#define DIP_APP_PREVIEW_PREFETCH_H

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
