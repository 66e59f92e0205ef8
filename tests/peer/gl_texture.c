// Uploads textures level by level.
#include "tests/peer/gl_texture.h"

#include "tests/peer/mips.h"

typedef struct Upload {
    const DipGl *gl;
    GLint format;
} Upload;

static bool upload(void *context, int level, int width, int height, const uint8_t *rgba8,
                   DipError *err) {
    (void)err;
    const Upload *to = context;
    to->gl->TexImage2D(GL_TEXTURE_2D, level, to->format, width, height, 0, GL_RGBA,
                       GL_UNSIGNED_BYTE, rgba8);
    return true;
}

bool dip_gl_texture_make(const DipGl *gl, const DipTextureDef *def, GLuint *name, DipError *err) {
    Upload to = {gl, def->encoding == DIP_ENCODING_SRGB ? GL_SRGB8_ALPHA8 : GL_RGBA8};
    gl->GenTextures(1, name);
    gl->BindTexture(GL_TEXTURE_2D, *name);
    return dip_peer_mips(def, upload, &to, err) && dip_gl_check(gl, def->name, err);
}
