// Makes an adversarial scene from a sequence of choices (choices.h).
#ifndef DIP_TESTS_STABILITY_SEARCH_SCENE_FROM_CHOICES_H
#define DIP_TESTS_STABILITY_SEARCH_SCENE_FROM_CHOICES_H

#include "renderer/scene/quality.h"
#include "renderer/catalogue/scenes.h"
#include "renderer/catalogue/pictures.h"
#include "tests/stability/search/choices.h"

#include <stdio.h>

// A scene, and how to draw it. It points into itself, so it must not be copied or moved.
typedef struct SearchScene {
    DipTestScene scene;
    DipQuality quality;
    char settings[256]; // the same as `quality`, as text
    int width;          // pixels
    int height;         // pixels
    int64_t time_ns;
    uint64_t frame_index;
    double shift[3]; // what the reference adds to the colours that it reads from textures
    bool in_floats;  // the reference interpolates in floats, as the fast renderer does
    const char *shape_names[DIP_TEST_SCENE_PARTS]; // kinds of the meshes
} SearchScene;

// Makes a scene. The owner frees it with dip_test_scene_free(&scene->scene).
void search_scene_make(SearchScene *scene, Choices *choices);

// Returns what to draw. It points into *scene.
StabilityShot search_scene_shot(const SearchScene *scene);

// Writes the scene in words, one line for each part.
void search_scene_describe(const SearchScene *scene, FILE *out);

#endif
