// Fuzzes the decoder of pictures (PNG, JPEG, BMP, TGA, DDS, PCX, PPM, PGM, HDR).
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

// True for DDS, PCX, PPM, PGM and HDR. Their readers compare the picture's size with the file's
// before they allocate memory, so a short file gives no large picture.
static bool is_bounded_by_file(const uint8_t bytes[26]) {
    const bool is_pcx = bytes[0] == 10 && bytes[2] == 1 && bytes[1] <= 5 && bytes[1] != 1;
    const bool is_pnm = bytes[0] == 'P' && bytes[1] >= '2' && bytes[1] <= '6';
    return is_pcx || is_pnm || memcmp(bytes, "DDS ", 4) == 0 ||
           memcmp(bytes, "#?RADIANCE", 10) == 0 || memcmp(bytes, "#?RGBE", 6) == 0;
}

// True if some field of the file that may hold the picture's size holds a large one.
static bool may_be_large(const uint8_t *file, size_t size_bytes) {
    uint8_t bytes[26] = {0}; // The decoder, too, reads zeros beyond the end.
    memcpy(bytes, file, size_bytes < sizeof bytes ? size_bytes : sizeof bytes);
    if (is_bounded_by_file(bytes)) {
        return false;
    }
    if (bytes[0] == 0x89) { // PNG
        return number(bytes + 16, 4, true) * number(bytes + 20, 4, true) > max_pixels;
    }
    if (bytes[0] == 'B' && bytes[14] == 12) { // BMP with a small header
        return number(bytes + 18, 2, false) * number(bytes + 20, 2, false) > max_pixels;
    }
    if (bytes[0] == 'B') { // BMP: a negative height means that the top row is first.
        const uint64_t width = number(bytes + 18, 4, false);
        const uint64_t height = (uint64_t)llabs((int32_t)number(bytes + 22, 4, false));
        return width * height > max_pixels;
    }
    const bool is_jpeg = bytes[0] == 0xff && bytes[1] >= 0xd8;
    for (size_t i = 0; is_jpeg && i + 9 < size_bytes; i++) {
        if (is_jpeg_frame(file + i) &&
            number(file + i + 5, 2, true) * number(file + i + 7, 2, true) > max_pixels) {
            return true;
        }
    }
    return !is_jpeg && // TGA
           number(bytes + 12, 2, false) * number(bytes + 14, 2, false) > max_pixels;
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
    FUZZ_CHECK(picture->level_count >= 1 && picture->level_count <= DIP_MAX_LEVELS);
    DipTextureDef levels[DIP_MAX_LEVELS];
    DipPicture copy;
    dip_picture_levels(picture, "fuzzed", DIP_ENCODING_SRGB, levels);
    FUZZ_CHECK(dip_picture_copy(levels, picture->level_count, &copy, NULL)); // reads all texels
    dip_picture_free(&copy);
}

// The bytes of an HDR file may also be an environment. All its texels are in the range that a scene
// accepts.
static void check_environment(const uint8_t *bytes, size_t size_bytes) {
    DipError err = {0};
    DipEnvironmentDef *environment = dip_environment_decode(bytes, size_bytes, "fuzzed", &err);
    FUZZ_CHECK(environment || (err.code != DIP_ERROR_NONE && err.message[0]));
    const int texels = environment ? environment->width * environment->height : 0;
    for (int i = 0; i < 3 * texels; i++) {
        const float light = environment->rgb_lin[i];
        FUZZ_CHECK(light >= 0.0f && light <= DIP_MAX_ENVIRONMENT_LIN);
    }
    free(environment);
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
    check_environment(copy, size_bytes);
    free(copy);
    return 0;
}
