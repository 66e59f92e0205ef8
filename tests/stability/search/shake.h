// Tiny changes of a scene: so small that the fast renderer, which rounds, may mistake the changed
// scene for the original one.
#ifndef DIP_TESTS_STABILITY_SEARCH_SHAKE_H
#define DIP_TESTS_STABILITY_SEARCH_SHAKE_H

#include "tests/stability/search/check.h"

// What search_shake changes in a scene.
typedef struct SearchOriginal {
    float *positions[DIP_TEST_SCENE_PARTS];
    float cutoffs[DIP_TEST_SCENE_PARTS];
    float transforms[DIP_TEST_SCENE_PARTS][12];
    DipPose pose;
} SearchOriginal;

// Copies what search_shake changes. The owner frees the copy with search_free_original.
void search_keep_original(const SearchScene *made, SearchOriginal *original);
void search_restore_original(SearchScene *made, const SearchOriginal *original);
void search_free_original(SearchOriginal *original);

// Moves the vertices, the camera and the alpha cutoffs a little, moves objects that may be coplanar
// a little towards the eye or away from it, and shifts what is read from textures by as much as
// the fast renderer's filter rounds. Every other scene is interpolated in floats. Each seed gives
// other changes.
void search_shake(SearchScene *made, uint64_t seed);

// Returns true if a vertex is so close to the eye that the error allowed for its position is not
// small beside its distance. Then any picture is right.
bool search_is_beyond_precision(const SearchScene *made);

#endif
