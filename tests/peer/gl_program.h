// The shaders of the peer (llvmpipe), in GLSL. They follow docs/picture.md, Shading. Each
// combination of surface features has its own program.
#ifndef DIP_TESTS_PEER_GL_PROGRAM_H
#define DIP_TESTS_PEER_GL_PROGRAM_H

#include "tests/peer/gl.h"

// The features of a surface, as bits. Like our renderer, a program does only the work that its
// surface needs.
enum {
    DIP_GL_TEXTURED = 1,
    DIP_GL_LIGHT_MAPPED = 2,
    DIP_GL_LIT = 4,      // the surface receives the fixed light, computed from vertex normals
    DIP_GL_COLOURED = 8, // the mesh has vertex colours
    DIP_GL_CLIPPED = 16,
    DIP_GL_PROGRAM_COUNT = 32,
};

// Locations of vertex attributes and texture units, the same in every program.
enum { DIP_GL_POSITION, DIP_GL_UV0, DIP_GL_UV1, DIP_GL_NORMAL, DIP_GL_COLOUR };
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

// Creates a program. features is a combination of the bits above. Fails with RUNTIME and the
// compiler's message.
bool dip_gl_program_make(const DipGl *gl, int features, DipGlProgram *program, DipError *err);

#endif
