// Tests of drawing into memory: exact blends, clipping, scaling and lines of text.
#include "app/ui/canvas.h"
#include "app/ui/font.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 37, HEIGHT = 23 };

static DipCanvas canvas;
static DipFont *font;

static const uint8_t *pixel(int x, int y) {
    return canvas.rgba8 + 4 * (y * canvas.width + x);
}

static void clear(int width, int height, uint8_t code) {
    assert_true(dip_canvas_resize(&canvas, width, height, NULL));
    dip_canvas_fill(&canvas, canvas.clip, (DipColour){code, code, code, 255});
}

// For every background and alpha, and for some colours, a blend gives the 8-bit value that is
// nearest to the exact result.
static void a_fill_blends_exactly(void **state) {
    (void)state;
    for (int alpha = 0; alpha < 256; ++alpha) {
        for (int code = 0; code < 256; ++code) {
            clear(3, 1, (uint8_t)code);
            const DipColour colour = {7, 128, 255, (uint8_t)alpha};
            dip_canvas_fill(&canvas, (DipRect){0, 0, 3, 1}, colour);
            const double share = alpha / 255.0;
            const int expected[3] = {(int)floor(7 * share + code * (1 - share) + .5),
                                     (int)floor(128 * share + code * (1 - share) + .5),
                                     (int)floor(255 * share + code * (1 - share) + .5)};
            for (int c = 0; c < 3; ++c) {
                assert_int_equal(pixel(1, 0)[c], expected[c]);
            }
            assert_int_equal(pixel(1, 0)[3], 255);
        }
    }
}

static void a_mask_multiplies_alpha_by_coverage(void **state) {
    (void)state;
    const uint8_t mask[4] = {0, 255, 128, 64};
    clear(4, 1, 10);
    dip_canvas_mask(&canvas, 0, 0, 4, 1, mask, (DipColour){200, 100, 50, 255});
    assert_memory_equal(pixel(0, 0), ((uint8_t[4]){10, 10, 10, 255}), 4);
    assert_memory_equal(pixel(1, 0), ((uint8_t[4]){200, 100, 50, 255}), 4);
    assert_int_equal(pixel(2, 0)[0], 105); // 10 * 127 / 255 + 200 * 128 / 255 = 105.4
    assert_int_equal(pixel(3, 0)[1], 33);  // 10 * 191 / 255 + 100 * 64 / 255 = 32.6
}

// Returns how many pixels differ from the given 8-bit grey value.
static int changed_pixels(uint8_t code) {
    int count = 0;
    for (int i = 0; i < canvas.width * canvas.height; ++i) {
        count += canvas.rgba8[4 * i] != code;
    }
    return count;
}

// The rectangles reach beyond the canvas and its clip rectangle on each side.
static void nothing_is_drawn_outside_the_clip(void **state) {
    (void)state;
    static uint8_t source[4 * 100 * 100];
    static uint8_t mask[100 * 100];
    const DipPixels picture = {source, 400, 100, 100};
    memset(mask, 255, sizeof mask);
    for (int i = 0; i < 3; ++i) {
        clear(WIDTH, HEIGHT, 99);
        dip_canvas_set_clip(&canvas, (DipRect){5, 6, 100, 7});
        const DipRect large = {-20, -30, 100, 100};
        if (i == 0) {
            dip_canvas_fill(&canvas, large, (DipColour){0, 0, 0, 255});
        } else if (i == 1) {
            dip_canvas_copy(&canvas, large, &picture);
        } else {
            dip_canvas_mask(&canvas, -20, -30, 100, 100, mask, (DipColour){0, 0, 0, 255});
        }
        assert_int_equal(changed_pixels(99), (WIDTH - 5) * 7);
        dip_canvas_set_clip(&canvas, (DipRect){50, 50, 5, 5});
        dip_canvas_fill(&canvas, large, (DipColour){1, 1, 1, 255});
        assert_int_equal(changed_pixels(99), (WIDTH - 5) * 7);
    }
}

// The rectangle is twice as wide and half as high as the picture, so each pixel is repeated and
// every second row is left out.
static void a_picture_is_scaled_to_its_rectangle(void **state) {
    (void)state;
    uint8_t source[4 * 3 * 4];
    for (int i = 0; i < 12; ++i) {
        memset(source + 4 * i, 10 * i, 4);
    }
    const DipPixels picture = {source, 12, 3, 4};
    clear(6, 2, 255);
    dip_canvas_copy(&canvas, (DipRect){0, 0, 6, 2}, &picture);
    for (int x = 0; x < 6; ++x) {
        assert_int_equal(pixel(x, 0)[0], 10 * (3 + x / 2));
        assert_int_equal(pixel(x, 1)[0], 10 * (9 + x / 2));
    }
}

// Returns the box around all pixels that are not white. *sum receives the sum of their darkness
// (255 - red).
static DipRect ink(int *sum) {
    DipRect box = {0};
    *sum = 0;
    for (int y = 0; y < canvas.height; ++y) {
        for (int x = 0; x < canvas.width; ++x) {
            const int dark = 255 - pixel(x, y)[0];
            *sum += dark;
            box = dark ? dip_rect_unite(box, (DipRect){x, y, 1, 1}) : box;
        }
    }
    return box;
}

static DipRect draw_black(int size, const char *line, int *sum) {
    clear(200, 40, 255);
    dip_font_draw(font, &canvas, size, (DipColour){0, 0, 0, 255}, 10, 5, line);
    return ink(sum);
}

static void text_fits_its_width_and_line_height(void **state) {
    (void)state;
    int sum = 0, ink_sum = 0;
    const DipRect box = draw_black(16, "Hxgj", &sum);
    const int width = dip_font_width(font, 16, "Hxgj");
    assert_true(box.width > width * 3 / 4 && box.width <= width + 2);
    assert_in_range(box.x, 9, 13);
    for (int size = DIP_FONT_MIN_SIZE; size <= 20; ++size) {
        const DipRect letters = draw_black(size, "gjpqy(|\u00c4", &ink_sum);
        assert_true(letters.y >= 5);
        assert_true(letters.y + letters.height <= 5 + dip_font_line_height(font, size));
    }
    assert_true(dip_font_width(font, 32, "Hxgj") > width * 3 / 2);
    int bigger = 0;
    draw_black(24, "Hxgj", &bigger);
    assert_true(bigger > sum * 3 / 2);
}

static void letters_are_antialiased(void **state) {
    (void)state;
    int sum = 0, grey = 0;
    draw_black(16, "O", &sum);
    for (int i = 0; i < canvas.width * canvas.height; ++i) {
        grey += canvas.rgba8[4 * i] > 20 && canvas.rgba8[4 * i] < 235;
    }
    assert_true(sum > 0 && grey > 10);
}

static void a_long_line_ends_in_an_ellipsis(void **state) {
    (void)state;
    char line[64] = "Anisotropic filtering \xc3\xa9\xc3\xa9\xc3\xa9 and more";
    const int whole = dip_font_width(font, 12, line);
    for (int room = whole + 1; room >= 0; --room) {
        char cut[64];
        strcpy(cut, line);
        dip_font_fit(font, 12, room, cut, sizeof cut);
        assert_true(dip_font_width(font, 12, cut) <= room);
        const size_t length = strlen(cut);
        if (room >= whole) {
            assert_string_equal(cut, line);
        } else if (length > 0) {
            assert_memory_equal(cut + length - 3, "\xe2\x80\xa6", 3);
            assert_memory_equal(cut, line, length - 3);
            assert_true((unsigned char)line[length - 3] >> 6 !=
                        2); // The cut is between two characters.
        }
    }
}

// An invalid byte shows as one replacement character, and the characters after it show correctly.
static void bytes_that_are_not_utf8_show_too(void **state) {
    (void)state;
    const int mark = dip_font_width(font, 12, "\xef\xbf\xbd");
    assert_int_equal(dip_font_width(font, 12,
                                    "a\xff"
                                    "b"),
                     mark + dip_font_width(font, 12, "ab"));
    assert_int_equal(dip_font_width(font, 12, "\xe2\x80"), 2 * mark);
    assert_int_equal(dip_font_width(font, 12, "\xc3"), mark);
}

// Draws a line, then more glyphs of many sizes than fit into the cache, then the line again. Both
// pictures of the line are equal.
static void a_full_cache_changes_no_picture(void **state) {
    (void)state;
    int before = 0, after = 0;
    const DipRect box = draw_black(14, "cache", &before);
    for (int size = DIP_FONT_MIN_SIZE; size <= DIP_FONT_MAX_SIZE; ++size) {
        for (char c = ' '; c < 127; ++c) {
            dip_font_width(font, size, (const char[2]){c, '\0'});
        }
    }
    const DipRect again = draw_black(14, "cache", &after);
    assert_true(dip_rect_equals(box, again));
    assert_int_equal(before, after);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_fill_blends_exactly),
        cmocka_unit_test(a_mask_multiplies_alpha_by_coverage),
        cmocka_unit_test(nothing_is_drawn_outside_the_clip),
        cmocka_unit_test(a_picture_is_scaled_to_its_rectangle),
        cmocka_unit_test(text_fits_its_width_and_line_height),
        cmocka_unit_test(letters_are_antialiased),
        cmocka_unit_test(a_long_line_ends_in_an_ellipsis),
        cmocka_unit_test(bytes_that_are_not_utf8_show_too),
        cmocka_unit_test(a_full_cache_changes_no_picture),
    };
    font = dip_font_create(NULL);
    if (!font) {
        return 1;
    }
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    dip_font_destroy(&font);
    dip_canvas_free(&canvas);
    return failed;
}
