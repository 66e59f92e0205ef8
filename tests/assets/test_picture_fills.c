// Tests that decoding reads no undefined memory: pictures, also broken ones, decode to the same
// texels whatever the heap and the stack held before.
#include "assets/picture.h"
#include "renderer/base/hash.h"
#include "tests/assets/fixture.h"
#include "tests/support/filled_memory.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

// Hashes all that a caller sees of a picture, or of the reason why there is none.
static DipHash hash_of_picture(const DipPicture *picture, bool decoded, const DipError *err) {
    DipHash hash = dip_hash_begin(decoded);
    if (!decoded) {
        dip_hash_text(&hash, err->message);
        return hash;
    }
    const int numbers[4] = {picture->width, picture->height, picture->level_count,
                            picture->has_alpha};
    dip_hash_bytes(&hash, numbers, sizeof numbers);
    for (int level = 0; level < picture->level_count; ++level) {
        int width;
        int height;
        const uint8_t *rgba8 = dip_picture_level(picture, level, &width, &height);
        dip_hash_bytes(&hash, rgba8, 4 * (size_t)width * (size_t)height);
    }
    return hash;
}

static void decode_with_fill(const char *path, uint8_t fill, char hex[DIP_HASH_HEX_SIZE]) {
    size_t size_bytes = 0;
    uint8_t *bytes = fixture_read(path, &size_bytes);
    DipPicture picture;
    DipError err = {0};
    filled_memory_heap(fill);
    filled_memory_stack(fill);
    const bool decoded = dip_picture_decode(bytes, size_bytes, "filled", &picture, &err);
    const DipHash hash = hash_of_picture(&picture, decoded, &err);
    dip_hash_hex(&hash, hex);
    dip_picture_free(&picture);
    free(bytes);
}

// Returns the number of files in a folder that were compared. Adds those that differ to *differing.
static int compare_folder(const char *folder, int *differing) {
    int count = 0;
    DIR *listing = opendir(folder);
    assert_non_null(listing);
    for (struct dirent *entry = readdir(listing); entry; entry = readdir(listing)) {
        char path[1024];
        char hex[2][DIP_HASH_HEX_SIZE];
        if (entry->d_name[0] == '.') {
            continue;
        }
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        decode_with_fill(path, 0x00, hex[0]);
        decode_with_fill(path, 0xa5, hex[1]);
        if (strcmp(hex[0], hex[1]) != 0) {
            print_error("%s depends on undefined memory\n", path);
            ++*differing;
        }
        ++count;
    }
    closedir(listing);
    return count;
}

static void pictures_do_not_depend_on_undefined_memory(void **state) {
    (void)state;
    int differing = 0;
    assert_true(compare_folder(DIP_TEST_DATA "/pictures", &differing) >= 40);
    assert_true(compare_folder(DIP_FUZZ_CORPUS "/picture", &differing) >= 110);
    assert_int_equal(differing, 0);
}

// Decodes a file of the corpus with 8x8 pixels and a palette of two colours, and compares the first
// two pixels of a row. The first has colour 0, and the second has a colour beyond the palette.
static void expect_pixels(const char *name, int row, const uint8_t expected[8]) {
    char path[1024];
    snprintf(path, sizeof path, "%s/picture/%s", DIP_FUZZ_CORPUS, name);
    DipPicture picture;
    DipError err = {0};
    if (!dip_picture_read_file(path, &picture, &err)) {
        fail_msg("%s: %s", name, err.message);
    }
    assert_int_equal(picture.width, 8);
    assert_memory_equal(picture.rgba8 + (size_t)row * 32, expected, 8);
    assert_int_equal(picture.has_alpha, expected[7] < 255);
    dip_picture_free(&picture);
}

static void a_colour_beyond_the_palette_is_black(void **state) {
    (void)state;
    expect_pixels("found_png_index_beyond_palette", 0,
                  (const uint8_t[8]){200, 100, 50, 255, 0, 0, 0, 255});
    expect_pixels("found_png_index_beyond_alpha", 0,
                  (const uint8_t[8]){200, 100, 50, 77, 0, 0, 0, 0});
    expect_pixels("found_bmp_index_beyond_palette_4", 7,
                  (const uint8_t[8]){30, 20, 10, 255, 30, 20, 10, 255});
    expect_pixels("found_bmp_index_beyond_palette_4", 6,
                  (const uint8_t[8]){0, 0, 0, 255, 0, 0, 0, 255});
}

static void a_jpeg_without_picture_data_is_refused(void **state) {
    (void)state;
    static const char *const names[] = {"found_jpeg_without_scan",
                                        "found_jpeg_progressive_without_scan"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
        char path[1024];
        snprintf(path, sizeof path, "%s/picture/%s", DIP_FUZZ_CORPUS, names[i]);
        DipPicture picture;
        DipError err = {0};
        assert_false(dip_picture_read_file(path, &picture, &err));
        assert_int_equal(err.code, DIP_ERROR_TRUNCATED);
        assert_non_null(strstr(err.message, "headers but no picture data"));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_do_not_depend_on_undefined_memory),
        cmocka_unit_test(a_colour_beyond_the_palette_is_black),
        cmocka_unit_test(a_jpeg_without_picture_data_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
