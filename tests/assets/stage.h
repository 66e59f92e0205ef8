// Draws moments of loaded models with both renderers, in small pictures.
#ifndef DIP_TESTS_ASSETS_STAGE_H
#define DIP_TESTS_ASSETS_STAGE_H

#include "renderer/base/pool.h"
#include "renderer/scene/renderer.h"

#include <stdint.h>

enum {
    STAGE_WIDTH = 160,
    STAGE_HEIGHT = 120,
    STAGE_PIXELS = STAGE_WIDTH * STAGE_HEIGHT,
    STAGE_BYTES = 4 * STAGE_PIXELS
};

// A scene, and a renderer for pictures of STAGE_WIDTH x STAGE_HEIGHT pixels.
typedef struct Stage {
    DipPool *pool;
    DipScene *scene;
    DipRenderer *renderer;
} Stage;

// Fails the running test if the scene or the renderer cannot be made.
Stage stage_open(const DipSceneDef *def, int threads, const char *settings);
void stage_close(Stage *stage);

// Returns the time of a frame at 30 frames a second.
int64_t stage_time_ns(int frame);

// Draws a frame and copies its picture, STAGE_BYTES bytes.
DipFrame stage_draw(const Stage *stage, const DipPose *pose, int frame, uint8_t *rgba8);

// Checks that the fast renderer draws frames first, first + step, ... below end with a PSNR above
// 42 dB to the reference.
void stage_check_moments(const DipSceneDef *def, const DipPose *pose, int first, int end, int step);

#endif
