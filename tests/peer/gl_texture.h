// The scene's textures in OpenGL: our own mip chains, 8 bits per channel.
#ifndef DIP_TESTS_PEER_GL_TEXTURE_H
#define DIP_TESTS_PEER_GL_TEXTURE_H

#include "renderer/scene/scene.h"
#include "tests/peer/gl.h"

// Makes a texture of def's texels and of smaller levels that our own box filter computes in linear
// light, rounded to def's encoding. Leaves it bound to the active unit.
bool dip_gl_texture_make(const DipGl *gl, const DipTextureDef *def, GLuint *name, DipError *err);

#endif
