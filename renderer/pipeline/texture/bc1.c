// BC1 blocks: encodes them with stb_dxt and decodes them to packed texels.
#include "renderer/pipeline/bc1.h"

#include "renderer/base/fp_mode.h"
#include "renderer/base/srgb.h"
#include "renderer/pipeline/texture/texture_layout.h"

#define STB_DXT_STATIC
#define STB_DXT_IMPLEMENTATION
#include <stb/stb_dxt.h>

void dip_bc1_encode(const uint8_t rgba8[64], uint8_t block[DIP_BC1_BYTES]) {
    DIP_FP_MODE_SCOPE();
    stb_compress_dxt_block(block, rgba8, 0, STB_DXT_NORMAL);
}

// Fills codes[0..last], whose index is a square root of linear light. sRGB code c begins at the
// first root whose square is at least the light of the sRGB value (c - 1/2) / 255.
static void fill_codes(uint8_t *codes, int last) {
    int code = 0;
    double end = dip_srgb_decode(0.5 / 255.0);
    for (int i = 0; i <= last; i++) {
        const double root = i / (double)last;
        while (code < 255 && root * root >= end) {
            code++;
            end = dip_srgb_decode((code + 0.5) / 255.0);
        }
        codes[i] = (uint8_t)code;
    }
}

void dip_root_codes_fill(DipRootCodes *codes) {
    DIP_FP_MODE_SCOPE();
    fill_codes(codes->of16, 65535);
    fill_codes(codes->of10, 1023);
}

void dip_bc1_light_fill(DipBc1Light *light) {
    DIP_FP_MODE_SCOPE();
    for (int i = 0; i <= 6 * 31; i++) {
        light->of5[i] = dip_srgb_decode(i / (6.0 * 31.0));
    }
    for (int i = 0; i <= 6 * 63; i++) {
        light->of6[i] = dip_srgb_decode(i / (6.0 * 63.0));
    }
}

void dip_bc1_palette(const DipBc1Light *light, const uint8_t block[DIP_BC1_BYTES],
                     uint32_t texels[4]) {
    // The number of sixths of each colour that come from the first stored colour; the others come
    // from the second. Row 1 applies if the first stored colour is the greater number, row 0
    // otherwise. In row 0, the third colour is half way between the two stored ones, and the fourth
    // is black.
    static const int shares[2][4] = {{6, 0, 3, 0}, {6, 0, 4, 2}};
    const int a = block[0] | block[1] << 8;
    const int b = block[2] | block[3] << 8;
    for (int i = 0; i < 4; i++) {
        const int s = shares[a > b][i];
        const int t = 6 - s;
        const double rgb[3] = {light->of5[s * (a >> 11) + t * (b >> 11)],
                               light->of6[s * (a >> 5 & 63) + t * (b >> 5 & 63)],
                               light->of5[s * (a & 31) + t * (b & 31)]};
        texels[i] = a <= b && i == 3 ? 0 : dip_texel_pack(rgb);
    }
}
