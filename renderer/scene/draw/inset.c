// Copies every n-th pixel of every n-th row of a picture to the corner of another picture.
#include "renderer/scene/draw/inset.h"

#include <string.h>

static int step_for(int picture_size, int target_size) {
    const int room = target_size / 2 > 0 ? target_size / 2 : 1;
    return (picture_size + room - 1) / room;
}

void dip_inset_draw(const DipTarget *target, const DipTarget *picture) {
    const int across = step_for(picture->width, target->width);
    const int down = step_for(picture->height, target->height);
    const int step = across > down ? across : down;
    for (int y = step / 2; y < picture->height; y += step) {
        const uint8_t *from = picture->rgba8 + (size_t)y * picture->stride_bytes;
        uint8_t *to = target->rgba8 + (size_t)(y / step) * target->stride_bytes;
        for (int x = step / 2; x < picture->width; x += step) {
            memcpy(to + 4 * (size_t)(x / step), from + 4 * (size_t)x, 4);
        }
    }
}
