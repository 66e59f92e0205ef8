// Fuzzes the decoder of pictures (PNG, JPEG, BMP, TGA).
#include "assets/picture.h"
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>
#include <string.h>

// More pixels than this make each run slow, but reach no other code.
static const uint64_t max_pixels = 1 << 20;

static uint64_t number(const uint8_t *bytes, int count, bool big_endian) {
    uint64_t value = 0;
    for (int i = 0; i < count; i++) {
        value |= (uint64_t)bytes[i] << (8 * (big_endian ? count - 1 - i : i));
    }
    return value;
}

static bool is_jpeg_frame(const uint8_t *at) {
    return at[0] == 0xff && at[1] >= 0xc0 && at[1] <= 0xc2;
}

// True if some field of the file that may hold the picture's size holds a large one.
static bool may_be_large(const uint8_t *bytes, size_t size_bytes) {
    if (size_bytes < 26) {
        return false;
    }
    bool large = number(bytes + 16, 4, true) * number(bytes + 20, 4, true) > max_pixels;
    if (bytes[0] == 'B') {
        const uint64_t width = (uint32_t)abs((int32_t)(number(bytes + 18, 4, false) & 0xffffff));
        const uint64_t height = number(bytes + 22, 4, false);
        large = width * (height >> 31 ? (uint32_t)-height : height) > max_pixels;
    } else if (bytes[0] == 0xff) {
        large = false;
        for (size_t i = 0; i + 9 < size_bytes && !large; i++) {
            large = is_jpeg_frame(bytes + i) &&
                    number(bytes + i + 5, 2, true) * number(bytes + i + 7, 2, true) > max_pixels;
        }
    } else if (bytes[0] != 0x89) {
        large = number(bytes + 12, 2, false) * number(bytes + 14, 2, false) > max_pixels;
    }
    return large;
}

static void check_accepted(const DipPicture *picture) {
    FUZZ_CHECK(picture->width >= 1 && picture->width <= DIP_MAX_PICTURE_SIZE);
    FUZZ_CHECK(picture->height >= 1 && picture->height <= DIP_MAX_PICTURE_SIZE);
    const size_t count = (size_t)picture->width * (size_t)picture->height;
    bool clear = false;
    for (size_t i = 0; i < count; i++) {
        clear |= picture->rgba8[4 * i + 3] < 255;
    }
    FUZZ_CHECK(picture->has_alpha == clear);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size_bytes) {
    if (may_be_large(bytes, size_bytes)) {
        return -1;
    }
    uint8_t *copy = fuzz_copy(bytes, size_bytes, false);
    DipPicture picture;
    DipError err = {0};
    if (dip_picture_decode(copy, size_bytes, "fuzzed", &picture, &err)) {
        check_accepted(&picture);
    } else {
        FUZZ_CHECK(!picture.rgba8 && err.code != DIP_ERROR_NONE && err.message[0]);
    }
    dip_picture_free(&picture);
    free(copy);
    return 0;
}
