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

extern const StabilityHash stability_hashes[];
extern const size_t stability_hash_count;

// Draws the pictures with the run's instruction set and pool and compares their hashes: each
// picture is one case of the run. A short run draws every seventh picture. Calls progress, if it is
// not NULL, after each picture.
void stability_compare_hashes(StabilityRun *run, void (*progress)(void *context), void *context);

// Draws all pictures with the scalar kernels on the pool, and prints the rows of the table
// stability_hashes. Returns false if a picture cannot be drawn.
bool stability_print_hashes(DipPool *pool);

#endif
