// Uploading textures level by level.
#include "tests/peer/gl_texture.h"

#include "renderer/texture/mip.h"
#include "renderer/texture/srgb.h"

#include <math.h>
#include <stdlib.h>

static void decode(const DipTextureDef *def, float *rgba) {
    DipSrgbDecodeTable srgb;
    dip_srgb_decode_table(&srgb);
    const size_t count = 4 * (size_t)def->width * (size_t)def->height;
    for (size_t i = 0; i < count; i++) {
        const bool linear = def->encoding == DIP_ENCODING_LINEAR || i % 4 == 3;
        rgba[i] = linear ? (float)def->rgba8[i] / 255.0f : (float)srgb.linear[def->rgba8[i]];
    }
}

static void encode(const DipMipLevel *level, DipEncoding encoding, const DipSrgbEncodeTable *srgb,
                   uint8_t *rgba8) {
    const size_t count = 4 * (size_t)level->width * (size_t)level->height;
    for (size_t i = 0; i < count; i++) {
        const bool linear = encoding == DIP_ENCODING_LINEAR || i % 4 == 3;
        rgba8[i] = linear ? (uint8_t)lrintf(level->rgba[i] * 255.0f)
                          : srgb->code[lrintf(level->rgba[i] * DIP_LINEAR16_MAX)];
    }
}

static void upload(const DipGl *gl, int level, DipEncoding encoding, int width, int height,
                   const uint8_t *rgba8) {
    gl->TexImage2D(GL_TEXTURE_2D, level, encoding == DIP_ENCODING_SRGB ? GL_SRGB8_ALPHA8 : GL_RGBA8,
                   width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba8);
}

bool dip_gl_texture_make(const DipGl *gl, const DipTextureDef *def, GLuint *name, DipError *err) {
    const size_t texels = (size_t)def->width * (size_t)def->height;
    DipMipLevel from = {def->width, def->height, malloc(texels * 4 * sizeof(float))};
    DipMipLevel to = {0, 0, malloc((texels / 2 + 1) * 4 * sizeof(float))};
    uint8_t *rgba8 = malloc((texels / 2 + 1) * 4);
    DipSrgbEncodeTable *srgb = malloc(sizeof *srgb);
    const bool allocated = from.rgba && to.rgba && rgba8 && srgb;
    if (allocated) {
        gl->GenTextures(1, name);
        gl->BindTexture(GL_TEXTURE_2D, *name);
        upload(gl, 0, def->encoding, def->width, def->height, def->rgba8);
        dip_srgb_encode_table(srgb);
        decode(def, from.rgba);
    }
    for (int level = 1; allocated && (from.width > 1 || from.height > 1); level++) {
        to.width = dip_mip_next_size(from.width);
        to.height = dip_mip_next_size(from.height);
        dip_mip_halve(&from, &to);
        encode(&to, def->encoding, srgb, rgba8);
        upload(gl, level, def->encoding, to.width, to.height, rgba8);
        const DipMipLevel swap = from;
        from = to;
        to = swap;
    }
    free(from.rgba);
    free(to.rgba);
    free(rgba8);
    free(srgb);
    return allocated
               ? dip_gl_check(gl, def->name, err)
               : dip_error_set(err, DIP_ERROR_MEMORY, def->name, 0, "texture", "out of memory");
}
