// The scenes of draw states, drawn by llvmpipe.
#ifndef DIP_TESTS_PEER_STATES_THEIRS_H
#define DIP_TESTS_PEER_STATES_THEIRS_H

#include "tests/peer/gl_target.h"
#include "tests/peer/states_scenes.h"

typedef struct DipStatesTheirs {
    const DipGl *gl;
    const DipStatesData *data;
    DipGlTarget target;
    GLuint program;
    GLuint map_program;
    GLuint map_framebuffer;
    GLuint map_texture;
    GLuint arrays[2];
} DipStatesTheirs;

bool dip_states_theirs_open(DipStatesTheirs *theirs, const DipGl *gl, const DipStatesData *data,
                            int width, int height, int sample_count, DipError *err);
// Draws a frame and waits for it.
void dip_states_theirs_draw(const DipStatesTheirs *theirs);

#endif
