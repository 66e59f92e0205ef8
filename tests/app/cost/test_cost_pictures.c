// Tests of the pictures in the cost report's page, and of the files that truths are saved to.
#include "app/report/page/report_pictures.h"
#include "app/files/pictures.h"
#include "assets/picture.h"

#include <limits.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// --- encoding ------------------------------------------------------------------------------------

// The examples of RFC 4648, section 10, and bytes whose digits are the last two of the alphabet.
static void data_uris_are_base64(void **state) {
    (void)state;
    static const struct {
        const char *bytes;
        const char *uri;
    } rows[] = {
        {"", "data:text/plain;base64,"},
        {"f", "data:text/plain;base64,Zg=="},
        {"fo", "data:text/plain;base64,Zm8="},
        {"foo", "data:text/plain;base64,Zm9v"},
        {"foob", "data:text/plain;base64,Zm9vYg=="},
        {"fooba", "data:text/plain;base64,Zm9vYmE="},
        {"foobar", "data:text/plain;base64,Zm9vYmFy"},
        {"\xfb\xff\xbf", "data:text/plain;base64,+/+/"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char *uri = dip_cost_data_uri("text/plain", (const unsigned char *)rows[i].bytes,
                                      strlen(rows[i].bytes));
        assert_string_equal(uri, rows[i].uri);
        free(uri);
    }
}

static void indexed_pngs_have_the_colours_of_the_palette(void **state) {
    (void)state;
    enum { WIDTH = 37, HEIGHT = 11 };
    uint8_t palette[3 * 256];
    uint8_t indices[WIDTH * HEIGHT];
    unsigned char *bytes;
    size_t size;
    DipPicture picture;
    for (int i = 0; i < 3 * 256; i++) {
        palette[i] = (uint8_t)(i * 7 + i / 256);
    }
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        indices[i] = (uint8_t)(i * 5);
    }
    assert_true(dip_png_encode_indexed(indices, palette, WIDTH, HEIGHT, &bytes, &size));
    assert_true(dip_picture_decode(bytes, size, "made.png", &picture, NULL));
    assert_int_equal(picture.width, WIDTH);
    assert_int_equal(picture.height, HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        assert_memory_equal(picture.rgba8 + 4 * i, palette + 3 * indices[i], 3);
    }
    dip_picture_free(&picture);
    free(bytes);
}

// A smooth picture loses at most a few codes. Rows have padding, which is not in the file.
static void jpegs_are_close_to_the_picture(void **state) {
    (void)state;
    enum { WIDTH = 40, HEIGHT = 24, STRIDE = 4 * WIDTH + 64 };
    static uint8_t rgba8[STRIDE * HEIGHT];
    unsigned char *bytes;
    size_t size;
    DipPicture picture;
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            const uint8_t pixel[4] = {(uint8_t)(5 * x), (uint8_t)(9 * y), (uint8_t)(200 - 3 * x),
                                      255};
            memcpy(rgba8 + y * STRIDE + 4 * x, pixel, 4);
        }
    }
    assert_true(dip_jpeg_encode(rgba8, STRIDE, WIDTH, HEIGHT, 95, &bytes, &size));
    assert_true(dip_picture_decode(bytes, size, "made.jpg", &picture, NULL));
    for (int i = 0; i < WIDTH * HEIGHT * 4; i++) {
        const int found = picture.rgba8[i],
                  drawn = rgba8[i / (4 * WIDTH) * STRIDE + i % (4 * WIDTH)];
        assert_in_range(found - drawn + 5, 0, 10);
    }
    dip_picture_free(&picture);
    free(bytes);
}

// A PNG is written from rows with padding. Pixels that cannot be a picture are refused by name.
static void pngs_are_written_from_pixels(void **state) {
    (void)state;
    enum { WIDTH = 5, HEIGHT = 3, STRIDE = 4 * WIDTH + 8 };
    static const char *const file = "test_cost_pictures.png";
    static const struct {
        bool has_pixels;
        size_t stride_bytes;
        int width, height;
        DipErrorCode code;
        const char *key;
    } bad[] = {
        {false, STRIDE, WIDTH, HEIGHT, DIP_ERROR_MISSING, "rgba8"},
        {true, 0, WIDTH, HEIGHT, DIP_ERROR_RANGE, "stride_bytes"},
        {true, 4 * WIDTH - 1, WIDTH, HEIGHT, DIP_ERROR_RANGE, "stride_bytes"},
        {true, STRIDE, 0, HEIGHT, DIP_ERROR_RANGE, "width"},
        {true, STRIDE, WIDTH, -1, DIP_ERROR_RANGE, "width"},
    };
    uint8_t rgba8[STRIDE * HEIGHT];
    for (int i = 0; i < STRIDE * HEIGHT; i++) {
        rgba8[i] = (uint8_t)(i * 11);
    }
    remove(file); // An earlier run may have left it.
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        DipError err = {.code = DIP_ERROR_NONE};
        assert_false(dip_png_write_rgba8(file, bad[i].has_pixels ? rgba8 : NULL,
                                         bad[i].stride_bytes, bad[i].width, bad[i].height, &err));
        assert_int_equal(err.code, bad[i].code);
        assert_string_equal(err.key, bad[i].key);
        assert_null(fopen(file, "rb"));
    }
    char bytes[1024];
    assert_true(dip_png_write_rgba8(file, rgba8, STRIDE, WIDTH, HEIGHT, NULL));
    FILE *in = fopen(file, "rb");
    assert_non_null(in);
    const size_t size = fread(bytes, 1, sizeof bytes, in);
    fclose(in);
    remove(file);
    DipPicture picture;
    assert_true(dip_picture_decode((const unsigned char *)bytes, size, file, &picture, NULL));
    assert_true(picture.width == WIDTH && picture.height == HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const uint8_t *pixel = rgba8 + i / WIDTH * STRIDE + i % WIDTH * 4;
        assert_memory_equal(picture.rgba8 + 4 * i, pixel, 3);
    }
    dip_picture_free(&picture);
}

// The bytes of IEEE 754 numbers, written out: 1 is 3f800000, -2 is c0000000, 0.5 is 3f000000.
static void pfm_rows_go_from_the_bottom_up(void **state) {
    (void)state;
    const float rgb[] = {1.0f, 1.0f, 1.0f, -2.0f, 0.0f, 0.0f, 0.5f, 0.5f, 0.5f, 0.0f, 0.0f, 1.0f};
    static const char expected[] = "PF\n2 2\n-1.0\n"
                                   "\x00\x00\x00\x3f\x00\x00\x00\x3f\x00\x00\x00\x3f"
                                   "\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x80\x3f"
                                   "\x00\x00\x80\x3f\x00\x00\x80\x3f\x00\x00\x80\x3f"
                                   "\x00\x00\x00\xc0\x00\x00\x00\x00\x00\x00\x00\x00";
    char found[128];
    assert_true(dip_pfm_write("test_cost_pictures.pfm", rgb, 2, 2, NULL));
    FILE *in = fopen("test_cost_pictures.pfm", "rb");
    assert_non_null(in);
    assert_int_equal(fread(found, 1, sizeof found, in), sizeof expected - 1);
    assert_memory_equal(found, expected, sizeof expected - 1);
    fclose(in);
    remove("test_cost_pictures.pfm");
}

// stb_image_write counts bytes with ints, and a JPEG has 16 bits for its width and height.
static void pictures_that_no_file_can_hold_are_refused(void **state) {
    (void)state;
    static const int sizes[][2] = {
        {0, 1},       {1, 0},         {-1, 1},        {1, -1},
        {1 << 30, 1}, {65536, 65536}, {16384, 16385}, {INT_MAX, INT_MAX}};
    static const uint8_t pixel[4];
    static const float light[3];
    unsigned char *bytes;
    size_t size_bytes;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        const int width = sizes[i][0], height = sizes[i][1];
        DipError errors[2] = {{0}};
        assert_false(dip_png_encode(pixel, SIZE_MAX / 2, width, height, &bytes, &size_bytes));
        assert_false(dip_png_encode_indexed(pixel, pixel, width, height, &bytes, &size_bytes));
        assert_false(dip_jpeg_encode(pixel, SIZE_MAX / 2, width, height, 90, &bytes, &size_bytes));
        assert_false(
            dip_png_write_rgba8("none.png", pixel, SIZE_MAX / 2, width, height, &errors[0]));
        assert_false(dip_pfm_write("none.pfm", light, width, height, &errors[1]));
        for (int e = 0; e < 2; e++) {
            assert_int_equal(errors[e].code, DIP_ERROR_RANGE);
            assert_string_equal(errors[e].key, "width");
        }
    }
    DipError err = {0};
    assert_false(dip_pfm_write("none.pfm", NULL, 1, 1, &err));
    assert_int_equal(err.code, DIP_ERROR_MISSING);
    assert_false(dip_jpeg_encode(pixel, SIZE_MAX / 2, 65536, 1, 90, &bytes, &size_bytes));
    assert_false(dip_jpeg_encode(pixel, SIZE_MAX / 2, 1, 65536, 90, &bytes, &size_bytes));
    assert_false(dip_jpeg_encode(pixel, 4, 1, 1, 0, &bytes, &size_bytes));
    assert_false(dip_jpeg_encode(pixel, 4, 1, 1, 101, &bytes, &size_bytes));
}

// --- fitting into a page -------------------------------------------------------------------------

enum { CROP = 100, MAP = 20, FRAME = 300 }; // Bytes.

static char *text_of(size_t size) {
    char *text = calloc(size + 1, 1);
    assert_non_null(text);
    memset(text, 'x', size);
    return text;
}

static void fill_set(DipCostPictureSet *set, int count) {
    set->count = count;
    set->truth = (DipCostPicture){-1, text_of(CROP), NULL, text_of(FRAME)};
    for (int i = 0; i < count; i++) {
        set->pictures[i] = (DipCostPicture){i, text_of(CROP), text_of(MAP), text_of(FRAME)};
    }
}

static double size_of(const DipCostPicture *picture) {
    return (picture->crop ? (double)strlen(picture->crop) : 0.0) +
           (picture->map ? (double)strlen(picture->map) : 0.0) +
           (picture->frame ? (double)strlen(picture->frame) : 0.0);
}

static double size_of_set(const DipCostPictureSet *set) {
    double size = size_of(&set->truth);
    for (int i = 0; i < set->count; i++) {
        size += size_of(&set->pictures[i]);
    }
    return size;
}

// Fits a sweep of three rows and a front of two rows into `room` bytes.
static void fit(DipCostPictures *pictures, double room) {
    *pictures = (DipCostPictures){0};
    fill_set(&pictures->sweeps[0], 3);
    fill_set(&pictures->front, 2);
    dip_cost_pictures_fit(pictures, room);
}

static void what_does_not_fit_is_left_out_and_counted(void **state) {
    (void)state;
    DipCostPictures p;
    const int crops = 7 * CROP + 5 * MAP;
    const int upgrade = FRAME - CROP - MAP; // More bytes of a whole frame than of a crop.
    for (int room = 2 * CROP; room < 3000; room += 7) {
        fit(&p, room);
        assert_true(size_of_set(&p.sweeps[0]) + size_of_set(&p.front) <= room);
        int with_crop = 0, with_frame = 0;
        for (int i = 0; i < 5; i++) {
            const DipCostPicture *picture =
                i < 3 ? &p.sweeps[0].pictures[i] : &p.front.pictures[i - 3];
            assert_true(!picture->crop == !picture->map); // never one without the other
            assert_true(!picture->frame || !picture->crop);
            with_crop += picture->crop != NULL;
            with_frame += picture->frame != NULL;
        }
        assert_int_equal(p.frames_left_out, 5 - with_frame);
        assert_int_equal(with_crop + with_frame, 5 - p.crops_left_out);
        dip_cost_pictures_free(&p);
    }
    fit(&p, crops + FRAME + upgrade - 1); // one byte too few for the first whole frame
    assert_int_equal(p.frames_left_out, 5);
    assert_null(p.front.truth.frame);
    dip_cost_pictures_free(&p);
    fit(&p, crops + FRAME + upgrade); // the front has the first whole frame
    assert_int_equal(p.frames_left_out, 4);
    assert_non_null(p.front.pictures[0].frame);
    assert_non_null(p.front.truth.crop); // its second row has a crop
    dip_cost_pictures_free(&p);
    fit(&p, 1e9);
    assert_int_equal(p.frames_left_out + p.crops_left_out, 0);
    assert_null(p.front.truth.crop); // no row of the front has a crop
    dip_cost_pictures_free(&p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(data_uris_are_base64),
        cmocka_unit_test(indexed_pngs_have_the_colours_of_the_palette),
        cmocka_unit_test(jpegs_are_close_to_the_picture),
        cmocka_unit_test(pngs_are_written_from_pixels),
        cmocka_unit_test(pfm_rows_go_from_the_bottom_up),
        cmocka_unit_test(pictures_that_no_file_can_hold_are_refused),
        cmocka_unit_test(what_does_not_fit_is_left_out_and_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
