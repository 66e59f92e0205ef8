// The thread that works ahead.
#include "app/preview/ahead.h"

static void *work_ahead(void *context) {
    const DipAhead *ahead = context;
    // Without memory for them now, the frame that needs them tries again and says so.
    DipError err;
    (void)dip_scene_compress_textures(ahead->scene, NULL, &err);
    return NULL;
}

void dip_ahead_begin(DipAhead *ahead, const DipScene *scene) {
    if (ahead->scene) {
        return;
    }
    ahead->scene = scene;
    ahead->running = pthread_create(&ahead->thread, NULL, work_ahead, ahead) == 0;
}

void dip_ahead_end(DipAhead *ahead) {
    if (ahead->running) {
        pthread_join(ahead->thread, NULL);
        ahead->running = false;
    }
}
