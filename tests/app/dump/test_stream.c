// Tests of the streams of `diptych dump`: the bytes that they hold, and pipes that break.
#include "app/dump/stream.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

// --- colours -------------------------------------------------------------------------------------

// The definition of BT.709 in limited range, with E' in 0..1.
static void expect_colour(const uint8_t rgb[3], const uint8_t planes[3]) {
    const long double r = rgb[0] / 255.0L;
    const long double g = rgb[1] / 255.0L;
    const long double b = rgb[2] / 255.0L;
    const long double luma = 0.2126L * r + 0.7152L * g + 0.0722L * b;
    const long double exact[3] = {16.0L + 219.0L * luma, 128.0L + 224.0L * (b - luma) / 1.8556L,
                                  128.0L + 224.0L * (r - luma) / 1.5748L};
    for (int i = 0; i < 3; i++) {
        // The tolerance is for halves, which rounding may take either way.
        if (fabsl(planes[i] - exact[i]) > 0.5L + 1e-12L) {
            fail_msg("rgb %d %d %d: plane %d is %d, exactly %.15Lf", rgb[0], rgb[1], rgb[2], i,
                     planes[i], exact[i]);
        }
    }
}

// All 2^24 colours: 65536 at a time, with one value of red.
static void every_colour_is_rounded_to_the_nearest(void **state) {
    (void)state;
    enum { COUNT = 65536 };
    uint8_t *rgb = malloc(3 * COUNT);
    uint8_t *planes = malloc(3 * COUNT);
    assert_true(rgb && planes);
    for (int red = 0; red < 256; red++) {
        for (int i = 0; i < COUNT; i++) {
            rgb[3 * i] = (uint8_t)red;
            rgb[3 * i + 1] = (uint8_t)(i >> 8);
            rgb[3 * i + 2] = (uint8_t)i;
        }
        dip_y4m_planes(rgb, COUNT, planes);
        for (int i = 0; i < COUNT; i++) {
            const uint8_t found[3] = {planes[i], planes[COUNT + i], planes[2 * COUNT + i]};
            expect_colour(rgb + 3 * i, found);
        }
    }
    free(rgb);
    free(planes);
}

// Values that BT.709 fixes: black, white, greys, and the ends of both differences of colour.
static void the_ends_of_the_range_are_those_of_the_standard(void **state) {
    (void)state;
    static const uint8_t rgb[] = {0, 0, 0, 255, 255, 255, 0, 0, 255, 255, 0, 0, 119, 119, 119};
    uint8_t planes[15];
    dip_y4m_planes(rgb, 5, planes);
    const uint8_t *blue = planes + 5;
    const uint8_t *red = planes + 10;
    assert_int_equal(planes[0], 16);
    assert_int_equal(planes[1], 235);
    assert_int_equal(blue[2], 240);
    assert_int_equal(red[3], 240);
    for (int i = 0; i < 5; i += i == 1 ? 3 : 1) {
        assert_int_equal(blue[i], 128);
        assert_int_equal(red[i], 128);
    }
}

static void headers_have_the_smallest_ratio(void **state) {
    (void)state;
    char header[DIP_Y4M_HEADER_SIZE];
    const size_t length = dip_y4m_header(640, 48, (DipFrameRate){60000, 2002}, header);
    assert_string_equal(header,
                        "YUV4MPEG2 W640 H48 F30000:1001 Ip A1:1 C444 XCOLORRANGE=LIMITED\n");
    assert_int_equal(length, strlen(header));
}

// --- streams -------------------------------------------------------------------------------------

enum { WIDTH = 5, HEIGHT = 3, STRIDE = 4 * WIDTH + 12, COUNT = WIDTH * HEIGHT };

static uint8_t pixels[2][HEIGHT * STRIDE];
static DipFrame panes[2];
static char file[] = "/tmp/test_stream.XXXXXX";

static int make_panes(void **state) {
    (void)state;
    uint32_t random = 7;
    for (int p = 0; p < 2; p++) {
        for (size_t i = 0; i < sizeof pixels[p]; i++) {
            random = random * 1664525u + 1013904223u;
            pixels[p][i] = (uint8_t)(random >> 24);
        }
        panes[p] = (DipFrame){
            .rgba8 = pixels[p], .stride_bytes = STRIDE, .width = WIDTH, .height = HEIGHT};
    }
    const int descriptor = mkstemp(file);
    return descriptor < 0 ? -1 : close(descriptor);
}

static int remove_file(void **state) {
    (void)state;
    return remove(file);
}

static uint8_t channel(int pane, int x, int y, int c) {
    return pixels[pane][y * STRIDE + 4 * x + c];
}

// Returns the byte that a picture must have.
static uint8_t expected(DipStreamPicture picture, int x, int y, int c) {
    switch (picture) {
    case DIP_STREAM_current:
        return channel(0, x, y, c);
    case DIP_STREAM_requested:
        return channel(1, x, y, c);
    case DIP_STREAM_both:
        return x < WIDTH ? channel(0, x, y, c) : channel(1, x - WIDTH, y, c);
    default:
        return (uint8_t)abs(channel(0, x, y, c) - channel(1, x, y, c));
    }
}

// Writes two frames, and reads the file back. Returns its size.
static size_t write_and_read(const DipStreamDef *def, uint8_t *bytes, size_t room) {
    DipError err = {0};
    DipStream *stream = dip_stream_open(def, &err);
    assert_non_null(stream);
    assert_true(dip_stream_add(stream, panes, &err));
    assert_true(dip_stream_add(stream, panes, &err));
    assert_true(dip_stream_close(&stream, &err));
    assert_null(stream);
    FILE *in = fopen(file, "rb");
    assert_non_null(in);
    const size_t size_bytes = fread(bytes, 1, room, in);
    fclose(in);
    return size_bytes;
}

static void raw_streams_hold_the_panes_pixels(void **state) {
    (void)state;
    for (int picture = 0; picture < DIP_STREAM_PICTURE_COUNT; picture++) {
        const DipStreamDef def = {
            .option = "--raw", .file = file, .picture = (DipStreamPicture)picture, .rate = {30, 1}};
        const int width = picture == DIP_STREAM_both ? 2 * WIDTH : WIDTH;
        const size_t frame_bytes = 3 * (size_t)width * HEIGHT;
        uint8_t bytes[4 * 3 * 2 * COUNT];
        assert_int_equal(write_and_read(&def, bytes, sizeof bytes), 2 * frame_bytes);
        assert_memory_equal(bytes, bytes + frame_bytes, frame_bytes);
        for (int i = 0; i < (int)frame_bytes; i++) {
            const int x = i / 3 % width;
            assert_int_equal(bytes[i],
                             expected((DipStreamPicture)picture, x, i / 3 / width, i % 3));
        }
    }
}

static void y4m_streams_hold_headers_and_planes(void **state) {
    (void)state;
    static const char header[] = "YUV4MPEG2 W10 H3 F25:1 Ip A1:1 C444 XCOLORRANGE=LIMITED\nFRAME\n";
    const DipStreamDef def = {
        .option = "--y4m", .file = file, .y4m = true, .picture = DIP_STREAM_both, .rate = {50, 2}};
    uint8_t bytes[1024];
    uint8_t rgb[3 * 2 * COUNT];
    uint8_t planes[3 * 2 * COUNT];
    const size_t size_bytes = write_and_read(&def, bytes, sizeof bytes);
    const size_t head = strlen(header);
    assert_int_equal(size_bytes, head + 2 * sizeof planes + strlen("FRAME\n"));
    for (int i = 0; i < (int)sizeof rgb; i++) {
        rgb[i] = expected(DIP_STREAM_both, i / 3 % (2 * WIDTH), i / 3 / (2 * WIDTH), i % 3);
    }
    dip_y4m_planes(rgb, 2 * COUNT, planes);
    assert_memory_equal(bytes, header, head);
    assert_memory_equal(bytes + head, planes, sizeof planes);
    assert_memory_equal(bytes + head + sizeof planes, "FRAME\n", 6);
    assert_memory_equal(bytes + head + sizeof planes + 6, planes, sizeof planes);
}

// --- failures ------------------------------------------------------------------------------------

// Adds frames until one fails or there are 1000.
static bool add_many(DipStream *stream, DipError *err) {
    bool added = true;
    for (int i = 0; added && i < 1000; i++) {
        added = dip_stream_add(stream, panes, err);
    }
    return added;
}

static void a_closed_pipe_is_an_error(void **state) {
    (void)state;
    int ends[2];
    char name[64];
    DipError err = {0};
    assert_int_equal(pipe(ends), 0);
    snprintf(name, sizeof name, "/dev/fd/%d", ends[1]);
    const DipStreamDef def = {.option = "--raw", .file = name, .rate = {30, 1}};
    DipStream *stream = dip_stream_open(&def, &err);
    assert_non_null(stream);
    close(ends[0]);
    assert_false(add_many(stream, &err));
    assert_int_equal(err.code, DIP_ERROR_IO);
    assert_int_equal(err.origin, DIP_ORIGIN_RUNTIME);
    assert_non_null(strstr(err.message, "the program that reads the stream has closed it after"));
    dip_stream_close(&stream, NULL);
    close(ends[1]);
}

static void a_full_disk_is_an_error(void **state) {
    (void)state;
    if (access("/dev/full", W_OK) != 0) {
        skip();
    }
    DipError err = {0};
    const DipStreamDef def = {.option = "--y4m", .file = "/dev/full", .y4m = true, .rate = {30, 1}};
    DipStream *stream = dip_stream_open(&def, &err);
    assert_non_null(stream);
    const bool added = dip_stream_add(stream, panes, &err); // The bytes may still be in the buffer.
    assert_false(dip_stream_close(&stream, &err) && added);
    assert_int_equal(err.origin, DIP_ORIGIN_RUNTIME);
    assert_string_equal(err.file, "/dev/full");
    assert_non_null(strstr(err.message, "cannot be written: "));
}

static void a_missing_folder_is_an_error(void **state) {
    (void)state;
    DipError err = {0};
    const DipStreamDef def = {.option = "--raw", .file = "/nowhere/at/all", .rate = {30, 1}};
    assert_null(dip_stream_open(&def, &err));
    assert_int_equal(err.code, DIP_ERROR_IO);
    assert_int_equal(err.origin, DIP_ORIGIN_RUNTIME);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_colour_is_rounded_to_the_nearest),
        cmocka_unit_test(the_ends_of_the_range_are_those_of_the_standard),
        cmocka_unit_test(headers_have_the_smallest_ratio),
        cmocka_unit_test(raw_streams_hold_the_panes_pixels),
        cmocka_unit_test(y4m_streams_hold_headers_and_planes),
        cmocka_unit_test(a_closed_pipe_is_an_error),
        cmocka_unit_test(a_full_disk_is_an_error),
        cmocka_unit_test(a_missing_folder_is_an_error),
    };
    return cmocka_run_group_tests(tests, make_panes, remove_file);
}
