// Tests decoding pictures: hand-made files decode to exactly the expected texels, and broken files
// are refused.
#include "assets/picture.h"
#include "tests/assets/fixture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

static const uint8_t png_texels[16] = {255, 0, 0,   255, 0,   255, 0,   255,
                                       0,   0, 255, 255, 255, 255, 255, 0};

static void a_png_has_its_texels(void **state) {
    (void)state;
    DipPicture picture;
    DipError err;
    assert_true(dip_picture_decode(fixture_png, sizeof fixture_png, "p", &picture, &err));
    assert_int_equal(picture.width, 2);
    assert_int_equal(picture.height, 2);
    assert_true(picture.has_alpha);
    assert_memory_equal(picture.rgba8, png_texels, sizeof png_texels);
    dip_picture_free(&picture);
}

// Every file that is cut short must be refused.
static void every_cut_is_refused(const uint8_t *bytes, size_t size_bytes) {
    for (size_t cut = 0; cut < size_bytes; ++cut) {
        DipPicture picture;
        DipError err = {0};
        if (dip_picture_decode(bytes, cut, "cut", &picture, &err)) {
            fail_msg("accepted with %zu of %zu bytes", cut, size_bytes);
        }
        assert_string_equal(err.file, "cut");
        assert_true(err.code == DIP_ERROR_TRUNCATED || err.code == DIP_ERROR_FORMAT);
        assert_null(picture.rgba8);
    }
}

static void a_cut_png_is_refused(void **state) {
    (void)state;
    every_cut_is_refused(fixture_png, sizeof fixture_png);
}

static void a_cut_tga_is_refused(void **state) {
    (void)state;
    fixture_write_tga("grey.tga", 16, 16, 99);
    size_t size_bytes = 0;
    uint8_t *bytes = fixture_read(fixture_path("grey.tga"), &size_bytes);
    every_cut_is_refused(bytes, size_bytes);
    DipPicture picture;
    assert_true(dip_picture_decode(bytes, size_bytes, "whole", &picture, NULL));
    assert_int_equal(picture.rgba8[4 * 255], 99);
    assert_false(picture.has_alpha);
    dip_picture_free(&picture);
    free(bytes);
}

static void a_cut_bmp_is_refused(void **state) {
    (void)state;
    uint8_t bmp[54 + 3 * 4 * 4] = {'B', 'M', sizeof bmp, 0, 0, 0, 0, 0, 0, 0, 54, 0, 0, 0, 40};
    bmp[18] = 4;
    bmp[22] = 4;
    bmp[26] = 1;
    bmp[28] = 24;
    memset(bmp + 54, 7, sizeof bmp - 54);
    every_cut_is_refused(bmp, sizeof bmp);
    DipPicture picture;
    assert_true(dip_picture_decode(bmp, sizeof bmp, "whole", &picture, NULL));
    assert_int_equal(picture.rgba8[4 * 15 + 2], 7);
    dip_picture_free(&picture);
}

// Two JPEG files, baseline and progressive. Each has 12 x 10 pixels of the colour (200, 100, 50).
static const uint8_t baseline_jpeg[] = {
    255, 216, 255, 224, 0,   16,  74,  70,  73, 70,  0,   1,  1,  0,  0,  1,  0,  1,   0,   0,
    255, 219, 0,   67,  0,   5,   3,   4,   4,  4,   3,   5,  4,  4,  4,  5,  5,  5,   6,   7,
    12,  8,   7,   7,   7,   7,   15,  11,  11, 9,   12,  17, 15, 18, 18, 17, 15, 17,  17,  19,
    22,  28,  23,  19,  20,  26,  21,  17,  17, 24,  33,  24, 26, 29, 29, 31, 31, 31,  19,  23,
    34,  36,  34,  30,  36,  28,  30,  31,  30, 255, 219, 0,  67, 1,  5,  5,  5,  7,   6,   7,
    14,  8,   8,   14,  30,  20,  17,  20,  30, 30,  30,  30, 30, 30, 30, 30, 30, 30,  30,  30,
    30,  30,  30,  30,  30,  30,  30,  30,  30, 30,  30,  30, 30, 30, 30, 30, 30, 30,  30,  30,
    30,  30,  30,  30,  30,  30,  30,  30,  30, 30,  30,  30, 30, 30, 30, 30, 30, 30,  255, 192,
    0,   17,  8,   0,   10,  0,   12,  3,   1,  34,  0,   2,  17, 1,  3,  17, 1,  255, 196, 0,
    21,  0,   1,   1,   0,   0,   0,   0,   0,  0,   0,   0,  0,  0,  0,  0,  0,  0,   0,   3,
    255, 196, 0,   20,  16,  1,   0,   0,   0,  0,   0,   0,  0,  0,  0,  0,  0,  0,   0,   0,
    0,   0,   255, 196, 0,   20,  1,   1,   0,  0,   0,   0,  0,  0,  0,  0,  0,  0,   0,   0,
    0,   0,   0,   7,   255, 196, 0,   20,  17, 1,   0,   0,  0,  0,  0,  0,  0,  0,   0,   0,
    0,   0,   0,   0,   0,   0,   255, 218, 0,  12,  3,   1,  0,  2,  17, 3,  17, 0,   63,  0,
    136, 3,   194, 179, 255, 217};

static const uint8_t progressive_jpeg[] = {
    255, 216, 255, 224, 0,   16,  74,  70,  73,  70,  0,   1,   1,   0,   0,   1,   0,   1,  0,
    0,   255, 219, 0,   67,  0,   5,   3,   4,   4,   4,   3,   5,   4,   4,   4,   5,   5,  5,
    6,   7,   12,  8,   7,   7,   7,   7,   15,  11,  11,  9,   12,  17,  15,  18,  18,  17, 15,
    17,  17,  19,  22,  28,  23,  19,  20,  26,  21,  17,  17,  24,  33,  24,  26,  29,  29, 31,
    31,  31,  19,  23,  34,  36,  34,  30,  36,  28,  30,  31,  30,  255, 219, 0,   67,  1,  5,
    5,   5,   7,   6,   7,   14,  8,   8,   14,  30,  20,  17,  20,  30,  30,  30,  30,  30, 30,
    30,  30,  30,  30,  30,  30,  30,  30,  30,  30,  30,  30,  30,  30,  30,  30,  30,  30, 30,
    30,  30,  30,  30,  30,  30,  30,  30,  30,  30,  30,  30,  30,  30,  30,  30,  30,  30, 30,
    30,  30,  30,  30,  30,  30,  255, 194, 0,   17,  8,   0,   10,  0,   12,  3,   1,   34, 0,
    2,   17,  1,   3,   17,  1,   255, 196, 0,   21,  0,   1,   1,   0,   0,   0,   0,   0,  0,
    0,   0,   0,   0,   0,   0,   0,   0,   0,   2,   255, 196, 0,   20,  1,   1,   0,   0,  0,
    0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   6,   255, 218, 0,   12,  3,  1,
    0,   2,   16,  3,   16,  0,   0,   1,   128, 117, 95,  255, 196, 0,   20,  16,  1,   0,  0,
    0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   32,  255, 218, 0,   8,  1,
    1,   0,   1,   5,   2,   31,  255, 196, 0,   20,  17,  1,   0,   0,   0,   0,   0,   0,  0,
    0,   0,   0,   0,   0,   0,   0,   0,   0,   255, 218, 0,   8,   1,   3,   1,   1,   63, 1,
    127, 255, 196, 0,   20,  17,  1,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,  0,
    0,   0,   0,   0,   255, 218, 0,   8,   1,   2,   1,   1,   63,  1,   127, 255, 196, 0,  20,
    16,  1,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   32, 255,
    218, 0,   8,   1,   1,   0,   6,   63,  2,   31,  255, 196, 0,   20,  16,  1,   0,   0,  0,
    0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   32,  255, 218, 0,   8,   1,  1,
    0,   1,   63,  33,  31,  255, 218, 0,   12,  3,   1,   0,   2,   0,   3,   0,   0,   0,  16,
    11,  255, 196, 0,   20,  17,  1,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,  0,
    0,   0,   0,   0,   255, 218, 0,   8,   1,   3,   1,   1,   63,  16,  127, 255, 196, 0,  20,
    17,  1,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,  255,
    218, 0,   8,   1,   2,   1,   1,   63,  16,  127, 255, 196, 0,   20,  16,  1,   0,   0,  0,
    0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   0,   32,  255, 218, 0,   8,   1,  1,
    0,   1,   63,  16,  31,  255, 217};

static void check_jpeg(const uint8_t *bytes, size_t size_bytes) {
    DipPicture picture;
    assert_true(dip_picture_decode(bytes, size_bytes, "whole", &picture, NULL));
    assert_int_equal(picture.width, 12);
    assert_int_equal(picture.height, 10);
    assert_false(picture.has_alpha);
    for (int i = 0; i < 120; ++i) {
        const uint8_t *texel = picture.rgba8 + 4 * i;
        assert_in_range(texel[0], 198, 202);
        assert_in_range(texel[1], 98, 102);
        assert_in_range(texel[2], 48, 52);
        assert_int_equal(texel[3], 255);
    }
    dip_picture_free(&picture);
}

static void a_jpeg_has_its_texels(void **state) {
    (void)state;
    check_jpeg(baseline_jpeg, sizeof baseline_jpeg);
    check_jpeg(progressive_jpeg, sizeof progressive_jpeg);
}

static void a_cut_jpeg_is_refused(void **state) {
    (void)state;
    every_cut_is_refused(baseline_jpeg, sizeof baseline_jpeg);
    every_cut_is_refused(progressive_jpeg, sizeof progressive_jpeg);
}

static size_t find_huffman_table(void) {
    size_t at = 0;
    while (baseline_jpeg[at] != 0xff || baseline_jpeg[at + 1] != 0xc4) {
        ++at;
    }
    return at;
}

static void expect_bad_tables(const uint8_t *bytes, size_t size_bytes) {
    DipPicture picture;
    DipError err = {0};
    assert_false(dip_picture_decode(bytes, size_bytes, "jpeg", &picture, &err));
    assert_int_equal(err.code, DIP_ERROR_FORMAT);
    assert_non_null(strstr(err.message, "table of the JPEG file is malformed or missing"));
}

// Changes a byte of the JPEG file's first Huffman table. `offset` counts from the table's marker,
// which is followed by two bytes of length, one byte that names the table, and the numbers of codes
// of 1 to 16 bits.
static void expect_bad_table(int offset, uint8_t value) {
    uint8_t bytes[sizeof baseline_jpeg];
    memcpy(bytes, baseline_jpeg, sizeof bytes);
    bytes[find_huffman_table() + (size_t)offset] = value;
    expect_bad_tables(bytes, sizeof bytes);
}

// Inserts an empty Huffman table before the first one. There are four tables of each of the classes
// 0 and 1. The class stands in the upper half of the byte `name`, and the table in its lower half.
static void expect_bad_name(uint8_t name) {
    enum { TABLE_BYTES = 2 + 2 + 1 + 16 };
    uint8_t bytes[sizeof baseline_jpeg + TABLE_BYTES] = {0};
    const size_t at = find_huffman_table();
    memcpy(bytes, baseline_jpeg, at);
    memcpy(bytes + at, (const uint8_t[]){0xff, 0xc4, 0, TABLE_BYTES - 2, name}, 5);
    memcpy(bytes + at + TABLE_BYTES, baseline_jpeg + at, sizeof baseline_jpeg - at);
    expect_bad_tables(bytes, sizeof bytes);
}

// stb_image writes beyond a table of more than 256 codes, and uses undefined tables.
static void bad_tables_of_a_jpeg_are_refused(void **state) {
    (void)state;
    expect_bad_table(4, 0x03);    // names the table 3, so that the table 0 is missing
    expect_bad_table(4, 0x05);    // names a table that does not exist
    expect_bad_table(4 + 8, 255); // more codes than the segment holds
    expect_bad_table(3, 0xff);    // a segment that ends within a table
    expect_bad_name(0x04);
    expect_bad_name(0x14);
    expect_bad_name(0x20);
    expect_bad_name(0xf0);
}

static void sizes_out_of_range_are_refused(void **state) {
    (void)state;
    uint8_t tga[18 + 64] = {[2] = 2, [12] = 1, [13] = 0x20, [14] = 1, [16] = 24, [17] = 0x20};
    DipPicture picture;
    DipError err = {0};
    assert_false(dip_picture_decode(tga, sizeof tga, "wide", &picture, &err)); // 8193 x 1
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    assert_non_null(strstr(err.message, "8193 x 1"));
    uint8_t bgra[4] = {0};
    assert_false(dip_picture_from_bgra(bgra, 0, 1, "none", &picture, &err));
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    assert_false(dip_picture_from_bgra(bgra, UINT32_MAX, 1, "huge", &picture, &err));
    assert_int_equal(err.code, DIP_ERROR_RANGE);
}

static void bgra_texels_are_reordered(void **state) {
    (void)state;
    const uint8_t bgra[8] = {1, 2, 3, 4, 5, 6, 7, 255};
    const uint8_t rgba[8] = {3, 2, 1, 4, 7, 6, 5, 255};
    DipPicture picture;
    assert_true(dip_picture_from_bgra(bgra, 2, 1, "raw", &picture, NULL));
    assert_memory_equal(picture.rgba8, rgba, sizeof rgba);
    dip_picture_free(&picture);
}

// The data of this PNG of 8x8 pixels is cut off. stb_image 2.27 reads zeros beyond its end, which
// its code makes bytes of, and would unpack 2 GB. Version 2.30 notices the end by itself.
static void endless_data_of_a_png_is_refused(void **state) {
    (void)state;
    static const uint8_t file[] = {
        0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44,
        0x52, 0x00, 0x00, 0x00, 0x08, 0x00, 0x00, 0x00, 0x08, 0x08, 0x00, 0x00, 0x00, 0x00, 0xe1,
        0x64, 0xe1, 0x57, 0x40, 0x00, 0x00, 0x74, 0x49, 0x44, 0x41, 0x54, 0x78, 0x01, 0x63, 0x48,
        0x49, 0x4d, 0x4b, 0xcf, 0xc8, 0xcc, 0xca, 0xce, 0x01, 0x3e, 0xe0, 0x03, 0x3e, 0xe0, 0x03,
        0x3e, 0xe0, 0x03, 0x3e, 0xe0, 0x03, 0x3e, 0xeb, 0x03, 0x3e, 0xe0, 0x03, 0x3e, 0xe0, 0x03,
        0x3e, 0xe0, 0x03, 0x3e, 0xe0, 0x03, 0x3e, 0xe0, 0x03, 0x3e, 0xe0, 0x03, 0x3e, 0xe0, 0x03,
        0x3e, 0xe0, 0x3e, 0x03, 0xe0, 0x3e, 0x03, 0xe0, 0x03, 0x3e, 0xe0, 0x03, 0x3e, 0xe0, 0x03,
        0x3e, 0xe0, 0x03, 0x3e, 0xe0, 0x03, 0x3e, 0xe0, 0x03, 0x3e, 0x7a, 0x03, 0x3e, 0xe0, 0x03,
        0x3e, 0xe0, 0x03, 0x3e, 0xe0, 0x03, 0x3e, 0xe0, 0x03, 0x3e, 0xe0, 0x03, 0x3e, 0xe0, 0x03,
        0x3e, 0xe0, 0x03, 0x3e, 0xe0, 0x03, 0x3e, 0xe0, 0x03, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
        0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xc0, 0x4d, 0x16, 0xc1, 0x00, 0x00, 0x00, 0x00,
        0x49, 0x45, 0x4e, 0x44, 0xae, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
        0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x42, 0x60, 0x82,
    };
    DipPicture picture;
    DipError err = {0};
    assert_false(dip_picture_decode(file, sizeof file, "endless", &picture, &err));
    const bool noticed_here = strstr(err.message, "longer than its pixels") != NULL;
    assert_int_equal(err.code, noticed_here ? DIP_ERROR_TRUNCATED : DIP_ERROR_FORMAT);
    assert_true(noticed_here || strstr(err.message, "cannot be read: "));
}

static void errors_say_what_is_wrong_with_a_file(void **state) {
    (void)state;
    DipPicture picture;
    DipError err = {0};
    assert_false(dip_picture_read_file(fixture_path("none.png"), &picture, &err));
    assert_int_equal(err.code, DIP_ERROR_MISSING);
    fixture_write("empty.png", "", 0);
    assert_false(dip_picture_read_file(fixture_path("empty.png"), &picture, &err));
    assert_int_equal(err.code, DIP_ERROR_TRUNCATED);
    fixture_write_text("text.png", "not a picture at all, whatever its name says");
    assert_false(dip_picture_read_file(fixture_path("text.png"), &picture, &err));
    assert_int_equal(err.code, DIP_ERROR_FORMAT);
    assert_non_null(strstr(err.file, "text.png"));
    assert_false(dip_picture_read_file(fixture_path("."), &picture, &err));
    assert_int_equal(err.code, DIP_ERROR_IO);
}

static void an_opacity_picture_becomes_the_alpha(void **state) {
    (void)state;
    uint8_t colours[16] = {10, 20, 30, 255, 40, 50, 60, 255, 70, 80, 90, 255, 1, 2, 3, 255};
    uint8_t greys[8] = {0, 0, 0, 255, 255, 255, 255, 255};
    const DipPicture colour = {.rgba8 = colours, .width = 2, .height = 2, .level_count = 1};
    const DipPicture opacity = {.rgba8 = greys, .width = 2, .height = 1, .level_count = 1};
    const uint8_t expected[16] = {10, 20, 30, 0, 40, 50, 60, 255, 70, 80, 90, 0, 1, 2, 3, 255};
    DipPicture merged;
    assert_true(dip_picture_with_opacity(&colour, &opacity, &merged));
    assert_memory_equal(merged.rgba8, expected, sizeof expected);
    assert_true(merged.has_alpha);
    dip_picture_free(&merged);
    assert_true(dip_picture_with_opacity(NULL, &opacity, &merged));
    const uint8_t white[8] = {255, 255, 255, 0, 255, 255, 255, 255};
    assert_memory_equal(merged.rgba8, white, sizeof white);
    dip_picture_free(&merged);
}

static void an_enlarged_picture_repeats_its_texels(void **state) {
    (void)state;
    uint8_t texels[16] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
    const DipPicture small = {
        .rgba8 = texels, .width = 2, .height = 2, .has_alpha = true, .level_count = 1};
    DipPicture large;
    assert_true(dip_picture_enlarge(&small, 3, &large));
    assert_int_equal(large.width, 6);
    assert_int_equal(large.height, 6);
    assert_true(large.has_alpha);
    for (int i = 0; i < 36; i++) {
        const int from = i / 6 / 3 * 2 + i % 6 / 3;
        assert_memory_equal(large.rgba8 + 4 * i, texels + 4 * from, 4);
    }
    dip_picture_free(&large);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_png_has_its_texels),
        cmocka_unit_test(a_cut_png_is_refused),
        cmocka_unit_test(endless_data_of_a_png_is_refused),
        cmocka_unit_test(a_cut_tga_is_refused),
        cmocka_unit_test(a_cut_bmp_is_refused),
        cmocka_unit_test(a_jpeg_has_its_texels),
        cmocka_unit_test(a_cut_jpeg_is_refused),
        cmocka_unit_test(bad_tables_of_a_jpeg_are_refused),
        cmocka_unit_test(sizes_out_of_range_are_refused),
        cmocka_unit_test(bgra_texels_are_reordered),
        cmocka_unit_test(errors_say_what_is_wrong_with_a_file),
        cmocka_unit_test(an_opacity_picture_becomes_the_alpha),
        cmocka_unit_test(an_enlarged_picture_repeats_its_texels),
    };
    return cmocka_run_group_tests(tests, fixture_open, fixture_close);
}
