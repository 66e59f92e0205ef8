// The peer's shaders: docs/picture.md, Shading, in GLSL, a program per kind of surface.
#ifndef DIP_TESTS_PEER_GL_PROGRAM_H
#define DIP_TESTS_PEER_GL_PROGRAM_H

#include "tests/peer/gl.h"

// What a surface has, as bits; a program does only what its surface needs, as ours does.
enum {
    DIP_GL_TEXTURED = 1,
    DIP_GL_LIGHT_MAPPED = 2,
    DIP_GL_LIT = 4,      // normals under the fixed light
    DIP_GL_COLOURED = 8, // vertex colours
    DIP_GL_CLIPPED = 16,
    DIP_GL_PROGRAM_COUNT = 32,
};

// Locations of vertex attributes and texture units, the same in every program.
enum { DIP_GL_POSITION, DIP_GL_UV0, DIP_GL_UV1, DIP_GL_NORMAL, DIP_GL_COLOUR };
enum { DIP_GL_COLOUR_UNIT, DIP_GL_LIGHT_MAP_UNIT };

// Locations are -1 where the program has no such uniform, which OpenGL's setters accept.
typedef struct DipGlProgram {
    GLuint name; // 0: not made yet
    GLint to_clip;
    GLint normal_to_world;
    GLint base_colour;
    GLint light_map_scale;
    GLint alpha_cutoff;
} DipGlProgram;

// features: a sum of the bits above. Fails with RUNTIME and the compiler's words.
bool dip_gl_program_make(const DipGl *gl, int features, DipGlProgram *program, DipError *err);

#endif
