// What the tests of passes share: pipelines of one pool, a mesh with one large triangle and many
// small ones, and pictures to draw into.
#ifndef DIP_TESTS_RENDERER_PIPELINE_PASS_STAGE_H
#define DIP_TESTS_RENDERER_PIPELINE_PASS_STAGE_H

#include "renderer/pipeline/pipeline.h"

enum { WIDTH = 100, HEIGHT = 70, PASSES = DIP_MAX_PASSES_AT_ONCE, SMALL = 2000 };

// pictures[0] are the targets of good_pass, pictures[1] are free.
extern uint8_t pictures[2][PASSES][WIDTH * HEIGHT * 4];

typedef struct Stage {
    DipPool *pool;
    DipMesh *mesh;
    DipPipeline *pipelines[PASSES];
    DipDraw draw; // a good draw of the mesh
} Stage;

// The set-up and the end of a group of tests: *state is a Stage.
int open_stage(void **state);
int close_stage(void **state);

// A pass with the stage's draw into pictures[0][index].
DipPass good_pass(const Stage *stage, int index);

// Shaders of the stage's draw: positions as they are, x as varying 0, shown as grey.
void copy_vertices(const DipVertexBatch *batch);
void show_varying(DipFragmentBatch *batch);

#endif
