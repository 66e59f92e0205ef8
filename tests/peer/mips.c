// Computes mip levels with 8 bits per channel.
#include "tests/peer/mips.h"

#include "renderer/base/srgb.h"
#include "renderer/pipeline/texture/mip.h"

#include <math.h>
#include <stdlib.h>

// Converts interleaved 8-bit values to the rows of a level. renderer/pipeline/texture/mip.h
// describes the layout of rows.
static void decode(const DipTextureDef *def, float *rows) {
    DipSrgbDecodeTable srgb;
    dip_srgb_decode_table(&srgb);
    const size_t width = (size_t)def->width;
    for (size_t i = 0; i < width * (size_t)def->height; i++) {
        for (size_t c = 0; c < 4; c++) {
            const uint8_t code = def->rgba8[4 * i + c];
            const bool linear = def->encoding == DIP_ENCODING_LINEAR || c == 3;
            rows[(4 * (i / width) + c) * width + i % width] =
                linear ? (float)code / 255.0f : (float)srgb.linear[code];
        }
    }
}

static void encode(const DipMipLevel *level, DipEncoding encoding, const DipSrgbEncodeTable *srgb,
                   uint8_t *rgba8) {
    const size_t width = (size_t)level->width;
    for (size_t i = 0; i < width * (size_t)level->height; i++) {
        for (size_t c = 0; c < 4; c++) {
            const float light = level->rows[(4 * (i / width) + c) * width + i % width];
            const bool linear = encoding == DIP_ENCODING_LINEAR || c == 3;
            rgba8[4 * i + c] = linear
                                   ? (uint8_t)lrintf(light * 255.0f)
                                   : dip_srgb_code(srgb, (int32_t)lrintf(light * DIP_LINEAR16_MAX));
        }
    }
}

int dip_peer_mip_count(const DipTextureDef *def) {
    int count = 1;
    int width = def->width;
    int height = def->height;
    while (width > 1 || height > 1) {
        width = dip_mip_next_size(width);
        height = dip_mip_next_size(height);
        count++;
    }
    return count;
}

bool dip_peer_mips(const DipTextureDef *def, DipPeerMipSink *sink, void *context, DipError *err) {
    const size_t texels = (size_t)def->width * (size_t)def->height;
    DipMipLevel from = {def->width, def->height, malloc(texels * 4 * sizeof(float))};
    DipMipLevel to = {0, 0, malloc((texels / 2 + 1) * 4 * sizeof(float))};
    uint8_t *rgba8 = malloc((texels / 2 + 1) * 4);
    DipSrgbEncodeTable *srgb = malloc(sizeof *srgb);
    bool done = (from.rows && to.rows && rgba8 && srgb) ||
                dip_error_set(err, DIP_ERROR_MEMORY, def->name, 0, "texture", "out of memory");
    if (done) {
        dip_srgb_encode_table(srgb);
        decode(def, from.rows);
        done = sink(context, 0, def->width, def->height, def->rgba8, err);
    }
    for (int level = 1; done && (from.width > 1 || from.height > 1); level++) {
        to.width = dip_mip_next_size(from.width);
        to.height = dip_mip_next_size(from.height);
        dip_mip_halve(&from, &to);
        encode(&to, def->encoding, srgb, rgba8);
        done = sink(context, level, to.width, to.height, rgba8, err);
        const DipMipLevel swap = from;
        from = to;
        to = swap;
    }
    free(from.rows);
    free(to.rows);
    free(rgba8);
    free(srgb);
    return done;
}
