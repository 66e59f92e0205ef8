// A colour for each size of mip level, from Table 4 of the 2006 ATI Catalyst Control Preview
// report.
#include "renderer/scene/mip_debug.h"

// sRGB colours of levels of 1024, 512, 256, 128, 64, 32, 16 and 8 texels.
static const uint8_t colours[DIP_MIP_DEBUG_LEVELS][4] = {
    {0, 0, 0, 255},     {128, 0, 0, 255}, {255, 0, 0, 255}, {255, 128, 0, 255},
    {255, 255, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {128, 0, 128, 255},
};

const uint8_t *dip_mip_debug_colour(int level) {
    return colours[level];
}

DipTexture *dip_mip_debug_create(const DipTextureDef *pictures[DIP_MIP_DEBUG_LEVELS],
                                 DipError *err) {
    DipTextureDef levels[DIP_MIP_DEBUG_LEVELS];
    for (int i = 0; i < DIP_MIP_DEBUG_LEVELS; i++) {
        levels[i] = pictures && pictures[i] ? *pictures[i]
                                            : (DipTextureDef){.name = "mip colour",
                                                              .width = 1,
                                                              .height = 1,
                                                              .rgba8 = colours[i],
                                                              .encoding = DIP_ENCODING_SRGB};
        levels[i].wrap_u = DIP_WRAP_REPEAT;
        levels[i].wrap_v = DIP_WRAP_REPEAT;
    }
    return dip_texture_create_from_levels(levels, DIP_MIP_DEBUG_LEVELS, err);
}

void dip_mip_debug_levels(const DipTexture *texture, int32_t shown_level[DIP_LEVEL_TABLE]) {
    for (int level = 0; level < DIP_LEVEL_TABLE; level++) {
        const int last = dip_texture_level_count(texture) - 1;
        int width;
        int height;
        dip_texture_level_size(texture, level < last ? level : last, &width, &height);
        const int size = width > height ? width : height;
        int shown = 0;
        while (shown < DIP_MIP_DEBUG_LEVELS - 1 && size < 1024 >> shown) {
            shown++;
        }
        shown_level[level] = shown;
    }
}
