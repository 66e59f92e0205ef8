// Measures how much a picture changes when the camera moves by a fraction of a pixel.
//
// A scene that is drawn with infinitely many samples changes continuously with the camera. A small
// step h, in pixels, changes a smooth area by h times its gradient. With few samples per pixel, an
// edge changes a sample only when it passes over the sample: few samples change, and by any amount.
// If the picture pops, because another level of detail, mesh or effect replaces the old one, many
// pixels of an area change at once, however small the step is. The measurements tell these apart.
#ifndef DIP_RENDERER_CATALOGUE_MOTION_H
#define DIP_RENDERER_CATALOGUE_MOTION_H

#include "renderer/scene/pose.h"
#include "renderer/catalogue/pictures.h"

#include <stdbool.h>

enum { MOTION_BLOCK = 8 }; // Side of the blocks that are compared, in pixels.

typedef enum MotionKind {
    MOTION_YAW,
    MOTION_PITCH,
    MOTION_ROLL,
    MOTION_SIDEWAYS,
    MOTION_UP,
    MOTION_FORWARD,
    MOTION_KINDS
} MotionKind;

// "yaw", "pitch", ...
extern const char *const motion_names[MOTION_KINDS];

// A small step of the camera.
typedef struct MotionStep {
    MotionKind kind;
    // How far the picture moves, in pixels of a picture `height` pixels high: in its middle (yaw,
    // pitch), at a distance of half its height from the middle (roll), or in its middle at a
    // distance of distance_m from the camera (sideways, up). A step forward has the length of a
    // step sideways.
    double step_px;
    int height;
    double distance_m;
} MotionStep;

DipPose motion_move(const DipPose *pose, const MotionStep *step);

// The greatest value of a block, and the top left pixel of this block.
typedef struct MotionPeak {
    double value;
    int x;
    int y;
} MotionPeak;

// How much a picture has changed. The change of a pixel is the mean of its three channels'
// differences, in linear light.
typedef struct MotionChange {
    MotionPeak mean;  // Mean of the changes of a block's pixels.
    MotionPeak broad; // Change that a quarter of a block's pixels reach or exceed.
    double picture;   // Mean of the changes of all pixels.
    // Mean difference between a pixel of the first picture and its neighbour to the right, plus the
    // same for the neighbour below.
    double gradient;
} MotionChange;

// Both pictures have the same size, of at least 1 block.
MotionChange motion_compare(const StabilityPicture *before, const StabilityPicture *after);

// Returns the mean of the changes of the pixels of the block at (x, y).
double motion_block_change(const StabilityPicture *before, const StabilityPicture *after, int x,
                           int y);

// Searches a motion of one pixel for the step of 1/256 pixel that makes a picture pop.
typedef struct MotionSearch {
    // Draws a pose. Returns false if drawing failed.
    bool (*draw)(void *context, const DipPose *pose, StabilityPicture *picture);
    void *context;
    DipPose pose;    // where the motion begins
    MotionStep step; // the motion; step_px is ignored
    // Pictures of the same size that the search overwrites. They hold, at its end, the pictures
    // before and after the step that was found. The third has no meaning then.
    StabilityPicture pictures[3];
} MotionSearch;

// Divides the motion into 8 parts, and takes the part with the greatest change of a quarter of a
// block. Then halves this part and takes the half with the greater change, until the half is 1/256
// of a pixel long. Sets *change to its change and *at_px to its beginning. Returns false if drawing
// failed.
bool motion_search(MotionSearch *search, MotionChange *change, double *at_px);

#endif
