// The scene's textures in OpenGL.
#ifndef DIP_TESTS_PEER_GL_TEXTURE_H
#define DIP_TESTS_PEER_GL_TEXTURE_H

#include "renderer/scene/scene.h"
#include "tests/peer/gl.h"

// Creates a texture with def's mip levels (mips.h). The texture stays bound to the active unit.
bool dip_gl_texture_make(const DipGl *gl, const DipTextureDef *def, GLuint *name, DipError *err);

#endif
