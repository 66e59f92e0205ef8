// The thread that prepares textures.
#include "app/preview/loop/prefetch.h"

static void *run_prefetch(void *context) {
    const DipPrefetch *prefetch = context;
    // If memory runs out here, the frame that needs the textures tries again and reports the error.
    DipError err;
    (void)dip_scene_compress_textures(prefetch->scene, NULL, &err);
    return NULL;
}

void dip_prefetch_begin(DipPrefetch *prefetch, const DipScene *scene) {
    if (prefetch->scene) {
        return;
    }
    prefetch->scene = scene;
    prefetch->running = pthread_create(&prefetch->thread, NULL, run_prefetch, prefetch) == 0;
}

void dip_prefetch_end(DipPrefetch *prefetch) {
    if (prefetch->running) {
        pthread_join(prefetch->thread, NULL);
        prefetch->running = false;
    }
}
