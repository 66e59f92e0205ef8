// Draws scenes for the rows of the catalogue and compares the pictures.
#ifndef DIP_RENDERER_CATALOGUE_PICTURES_H
#define DIP_RENDERER_CATALOGUE_PICTURES_H

#include "renderer/reference/reference.h"
#include "renderer/scene/renderer.h"
#include "renderer/catalogue/stability.h"

// What to draw. def, pose and reflection are borrowed.
typedef struct StabilityShot {
    const DipSceneDef *def;
    const DipPose *pose;
    const DipReflectionDef *reflection; // NULL: water does not reflect
    const char *settings;               // as `--current` takes them, for example "aa=4,af=16"
    int width;                          // pixels
    int height;
    int64_t time_ns;
    uint64_t frame_index;
    // Frames that are drawn before, at most frame_index. Each is taken from 2 cm farther back than
    // the next, so that the picture has a past that moves.
    int frames_before;
    bool force_all; // run all effects, needed or not (DipRendererDef.force_all_effects)
    // Whether the reference shares documented differences of the fast renderer
    // (reference/internal/differences.h), what it then adds to all colours that it reads, and
    // whether it interpolates in floats.
    bool share_differences;
    double shift[3];
    bool in_floats;
} StabilityShot;

// A picture in linear light, width * height * 3 values, top row first. Its owner frees rgb_lin.
typedef struct StabilityPicture {
    int width;
    int height;
    double *rgb_lin;
    char hash[33]; // hash of the 8-bit pixels; empty for pictures of the reference
} StabilityPicture;

// Draws with the fast renderer, with the run's instruction set and pool. On failure, the run is
// broken and the picture is empty.
bool stability_draw(StabilityRun *run, const StabilityShot *shot, StabilityPicture *picture);

// Draws the same with the reference renderer.
bool stability_draw_reference(StabilityRun *run, const StabilityShot *shot,
                              StabilityPicture *picture);

void stability_picture_free(StabilityPicture *picture);

// Decodes a frame's pixels into a picture of the frame's size, whose rgb_lin the caller has
// allocated, and writes the frame's hash.
void stability_decode(const DipFrame *frame, StabilityPicture *picture);

// Both pictures have the same size. Returns the root of the mean squared difference of all values,
// in linear light.
double stability_rms(const StabilityPicture *a, const StabilityPicture *b);

// Returns the number of pixels in which a value differs by more than `least`.
double stability_differing(const StabilityPicture *a, const StabilityPicture *b, double least);

// Breaks the row if a picture shows fewer than `least` changes of colour from one pixel to the
// next; a row that compares empty pictures would prove nothing. Returns whether the picture shows
// enough.
bool stability_shows(StabilityRun *run, const StabilityPicture *picture, int least);

#endif
