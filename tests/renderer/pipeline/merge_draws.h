// Draws the draws of the plain model (merge_model.h) by the pipeline, and compares colours with the
// model's.
#ifndef DIP_TESTS_RENDERER_PIPELINE_MERGE_DRAWS_H
#define DIP_TESTS_RENDERER_PIPELINE_MERGE_DRAWS_H

#include "tests/renderer/pipeline/merge_model.h"

// Fills in draws that draw the same as `models`, which they borrow, and makes their meshes.
void model_make_draws(const ModelDraw *models, int count, DipDraw *draws, DipMesh **meshes);
void model_free_meshes(DipMesh **meshes, int count);

// Fail the test if a colour of pixel (x, y), a float or a byte of an sRGB target, is not what the
// model expects, within the rounding of the pipeline's floats. channel: 0..3.
void model_assert_float(double found, ModelValue expected, int x, int y, int channel);
void model_assert_code(int found, ModelValue expected, int x, int y, int channel);

#endif
