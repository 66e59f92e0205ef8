// A plain model of merged passes (renderer/pipeline/state.h): it draws one sample at a time, in
// submission order, in double precision and with exact coverage. It shares no code with the
// pipeline.
#ifndef DIP_TESTS_RENDERER_PIPELINE_MERGE_MODEL_H
#define DIP_TESTS_RENDERER_PIPELINE_MERGE_MODEL_H

#include "renderer/pipeline/pipeline.h"
#include "renderer/catalogue/oracle.h"

enum { MODEL_WIDTH = 72, MODEL_HEIGHT = 40, MODEL_TRIANGLES = 3 };

// A draw of triangles that are parallel to the screen. Depths are dyadic, so that they are exact.
typedef struct ModelDraw {
    DipOracleTriangle triangle[MODEL_TRIANGLES];
    float depth[MODEL_TRIANGLES];
    float colour[4];
    bool clips;
    DipCull cull;
    DipDrawState state;
} ModelDraw;

// A number, and a bound of how far a computation with floats may lie from it.
typedef struct ModelValue {
    double value;
    double error;
} ModelValue;

// A picture in progress: colours, depths and stencil values of all samples.
typedef struct Model {
    int sample_count;
    bool clamps;
    DipTargetRegion stored;
    ModelValue colour[MODEL_HEIGHT][MODEL_WIDTH][DIP_MAX_SAMPLES][4];
    double depth[MODEL_HEIGHT][MODEL_WIDTH][DIP_MAX_SAMPLES];
    uint8_t stencil[MODEL_HEIGHT][MODEL_WIDTH][DIP_MAX_SAMPLES];
} Model;

// The colour that a draw's fragment shader writes in a pixel, and whether its clip shader keeps the
// pixel. front: the draw's state reads which faces are front faces, and the triangle is one.
double model_shade(const ModelDraw *draw, bool front, int x, int y, int channel);
bool model_keeps(bool front, int x, int y);

void model_clear(Model *model, const float clear[4], float depth, uint8_t stencil);
void model_draw(Model *model, const ModelDraw *draw);

// Ends a pass: replaces the colours of all samples by their mean.
void model_resolve(Model *model);

#endif
