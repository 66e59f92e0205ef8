// The scene's textures in OpenGL: mip chains that our own code computes, with 8 bits per channel.
#ifndef DIP_TESTS_PEER_GL_TEXTURE_H
#define DIP_TESTS_PEER_GL_TEXTURE_H

#include "renderer/scene/scene.h"
#include "tests/peer/gl.h"

// Creates a texture from def's texels. Our own box filter computes the smaller levels in linear
// light and rounds them to def's encoding. The texture stays bound to the active unit.
bool dip_gl_texture_make(const DipGl *gl, const DipTextureDef *def, GLuint *name, DipError *err);

#endif
