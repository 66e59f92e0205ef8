// Random lists of draws with states, for the tests of merged passes.
#ifndef DIP_TESTS_RENDERER_PIPELINE_MERGE_LIST_H
#define DIP_TESTS_RENDERER_PIPELINE_MERGE_LIST_H

#include "tests/renderer/pipeline/merge_model.h"

enum { MODEL_DRAWS = 10, MODEL_PASSES = 2 };

// A random list of draws, and how its passes begin and end.
typedef struct ModelList {
    int sample_count;
    DipFormat format;
    ModelDraw draws[MODEL_PASSES][MODEL_DRAWS];
    bool keeps_colour; // the second pass starts from the colours of the first
    bool keeps_depth;
    DipTargetRegion viewport[MODEL_PASSES];
    DipTargetRegion scissor[MODEL_PASSES];
    float clear[4];
    float clear_depth;
    uint8_t clear_stencil;
} ModelList;

void model_random_list(Random *random, ModelList *list);

#endif
