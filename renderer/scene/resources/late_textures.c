// Compresses a scene's textures once, when a renderer first asks for them.
#include "renderer/scene/resources/late_textures.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

struct DipLateTextures {
    pthread_mutex_t mutex;
    atomic_bool made;      // true: the members below do not change any more
    DipTexture **textures; // one per texture of the scene; NULL if the texture was not wanted
    int count;
};

DipLateTextures *dip_late_textures_create(void) {
    DipLateTextures *late = calloc(1, sizeof *late);
    if (late) {
        pthread_mutex_init(&late->mutex, NULL);
    }
    return late;
}

void dip_late_textures_destroy(DipLateTextures **late) {
    if (!*late) {
        return;
    }
    for (int i = 0; i < (*late)->count; i++) {
        dip_texture_destroy(&(*late)->textures[i]);
    }
    free((*late)->textures);
    pthread_mutex_destroy(&(*late)->mutex);
    free(*late);
    *late = NULL;
}

static bool make(DipLateTextures *late, DipTexture *const *textures, const bool *wanted, int count,
                 DipPool *pool, DipError *err) {
    DipTexture **made = malloc(((size_t)count + 1) * sizeof(DipTexture *));
    if (!made) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "textures", "out of memory");
    }
    if (!dip_textures_compress(textures, wanted, count, pool, made, err)) {
        free(made);
        return false;
    }
    late->textures = made;
    late->count = count;
    atomic_store_explicit(&late->made, true, memory_order_release);
    return true;
}

bool dip_late_textures_make(DipLateTextures *late, DipTexture *const *textures, const bool *wanted,
                            int count, DipPool *pool, DipError *err) {
    if (atomic_load_explicit(&late->made, memory_order_acquire)) {
        return true;
    }
    pthread_mutex_lock(&late->mutex);
    const bool made = atomic_load_explicit(&late->made, memory_order_relaxed) ||
                      make(late, textures, wanted, count, pool, err);
    pthread_mutex_unlock(&late->mutex);
    return made;
}

const DipTexture *dip_late_texture(const DipLateTextures *late, int index) {
    return atomic_load_explicit(&late->made, memory_order_acquire) ? late->textures[index] : NULL;
}
