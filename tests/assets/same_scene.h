// Compares scene descriptions value by value, and reads every byte that a description points to.
#ifndef DIP_TESTS_ASSETS_SAME_SCENE_H
#define DIP_TESTS_ASSETS_SAME_SCENE_H

#include "renderer/scene/scene.h"

// Fails the running cmocka test unless both descriptions are the same in every bit.
void assert_same_scene(const DipSceneDef *one, const DipSceneDef *other);

// Reads all texts and arrays, so that a memory checker finds those that lie outside. Fails the test
// if an index is out of range. Returns the sum of all bytes.
uint64_t read_whole_scene(const DipSceneDef *scene);

#endif
