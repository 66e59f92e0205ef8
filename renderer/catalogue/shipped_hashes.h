// Pictures of the test scenes with their hashes: the same on every machine.
#ifndef DIP_RENDERER_CATALOGUE_SHIPPED_HASHES_H
#define DIP_RENDERER_CATALOGUE_SHIPPED_HASHES_H

#include "renderer/catalogue/scenes.h"
#include "renderer/catalogue/stability.h"

typedef struct StabilityHash {
    DipTestSceneKind scene;
    const char *settings;
    const char *hash; // 32 hex digits, see dip_frame_hash
} StabilityHash;

// Together, the pictures use every step of every setting, and every kind of scene.
extern const StabilityHash stability_hashes[];
extern const size_t stability_hash_count;

// Draws a scene of 97x61 pixels, with the frames before it if the settings have a history, with the
// run's instruction set and pool, and writes the hash. force_all: see StabilityShot. Returns false,
// with the reason in the run, if it cannot be drawn. Not thread-safe.
bool stability_draw_hash(StabilityRun *run, DipTestSceneKind kind, const char *settings,
                         bool force_all, char hash[33]);

// Draws the pictures with the run's instruction set and pool and compares their hashes: each
// picture is one case of the run. A short run draws every seventh picture. Calls progress, if it is
// not NULL, after each picture.
void stability_compare_hashes(StabilityRun *run, void (*progress)(void *context), void *context);

// Draws the pictures of the table stability_hashes with the scalar kernels on the pool, and prints
// its rows with the hashes of this build. To add a picture, add a row with any hash and print the
// rows. Returns false if a picture cannot be drawn.
bool stability_print_hashes(DipPool *pool);

#endif
