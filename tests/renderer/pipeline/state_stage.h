// What the tests of draw states share: a pipeline, a picture, and draws of triangles in pixels.
#ifndef DIP_TESTS_RENDERER_PIPELINE_STATE_STAGE_H
#define DIP_TESTS_RENDERER_PIPELINE_STATE_STAGE_H

#include "renderer/pipeline/pipeline.h"

enum { WIDTH = 96, HEIGHT = 72 };

typedef struct Colour {
    float channel[4];
} Colour;

extern DipPipeline *pipeline;
extern uint8_t picture[HEIGHT][WIDTH][4];

// The set-up and the end of a group of tests.
int open_pipeline(void **state);
int close_pipeline(void **state);

// Shaders. Positions are pixels and a depth; varying 0 is the depth. The uniforms are a Colour.
void in_pixels(const DipVertexBatch *batch);
void one_colour(DipFragmentBatch *batch);

// Returns a mesh of count / 3 triangles, at most 21. The caller destroys it.
DipMesh *triangles(const float *corners, uint32_t count);

// A rectangle of two triangles from (x0, y0) to (x1, y1).
DipMesh *rectangle(float x0, float y0, float x1, float y1, float depth);

// A draw in one colour. All is borrowed; state may be NULL.
DipDraw draw_of(const DipMesh *mesh, const Colour *colour, const DipDrawState *state);

// A pass into `picture`.
DipPass pass_of(const DipDraw *draws, int count, int sample_count);

// Draws a pass, which must be accepted.
void run(const DipPass *pass);

#endif
