// Divides pictures into blocks and cuts out parts of them.
#include "app/measure/metrics/picture.h"

static int larger(int a, int b) {
    return a > b ? a : b;
}

static int smaller(int a, int b) {
    return a < b ? a : b;
}

static int across(int size) {
    return (size + DIP_PICTURE_BLOCK - 1) / DIP_PICTURE_BLOCK;
}

int dip_picture_block_count(int width, int height) {
    return across(width) * across(height);
}

DipPixelRect dip_picture_block(int width, int height, int block) {
    return dip_picture_block_with_margin(width, height, block, 0);
}

DipPixelRect dip_picture_block_with_margin(int width, int height, int block, int margin_px) {
    const int x = block % across(width) * DIP_PICTURE_BLOCK;
    const int y = block / across(width) * DIP_PICTURE_BLOCK;
    const int left = larger(0, x - margin_px), top = larger(0, y - margin_px);
    return (DipPixelRect){left, top, smaller(width, x + DIP_PICTURE_BLOCK + margin_px) - left,
                          smaller(height, y + DIP_PICTURE_BLOCK + margin_px) - top};
}

DipSrgbPicture dip_picture_part(const DipSrgbPicture *picture, const DipPixelRect *rect) {
    const size_t offset = (size_t)rect->y * picture->stride_bytes + 4 * (size_t)rect->x;
    return (DipSrgbPicture){picture->rgba8 + offset, picture->stride_bytes, rect->width,
                            rect->height};
}
