// The shaders of the peer (llvmpipe), in GLSL. They follow docs/picture.md, Shading. Each
// combination of surface features has its own program.
#ifndef DIP_TESTS_PEER_GL_PROGRAM_H
#define DIP_TESTS_PEER_GL_PROGRAM_H

#include "tests/peer/gl.h"
#include "tests/peer/surfaces.h"

// Texture units, the same in every program.
enum { DIP_GL_COLOUR_UNIT, DIP_GL_LIGHT_MAP_UNIT };

// Uniform locations. A location is -1 if the program has no such uniform. OpenGL ignores a uniform
// that is set at location -1.
typedef struct DipGlProgram {
    GLuint name; // 0 until the program is created
    GLint to_clip;
    GLint normal_to_world;
    GLint base_colour;
    GLint light_map_scale;
    GLint alpha_cutoff;
} DipGlProgram;

// Creates a program. features is a combination of the bits in surfaces.h. Fails with RUNTIME and
// the compiler's message.
bool dip_gl_program_make(const DipGl *gl, int features, DipGlProgram *program, DipError *err);

#endif
