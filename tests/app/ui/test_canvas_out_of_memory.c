// Tests what texts and draw lists do when memory runs out: a list is painted whole or not at all,
// and afterwards the right picture is painted, with every letter.
#include "app/ui/draw_list.h"
#include "tests/support/out_of_memory.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 320, HEIGHT = 60, SIZE = 16, LINES = 120 };

static DipFont *font;
static DipDrawList *list;
static DipCanvas canvas;
static uint8_t expected[4 * WIDTH * HEIGHT];

static bool create(void *context, DipError *err) {
    (void)context;
    font = dip_font_create(err);
    list = font ? dip_draw_list_create(font, err) : NULL;
    return list != NULL;
}

static void must_create(void *context) {
    assert_true(create(context, NULL));
}

static void destroy(void *context) {
    (void)context;
    dip_draw_list_destroy(&list);
    dip_font_destroy(&font);
    dip_canvas_free(&canvas);
}

// The list has so many commands that it must grow several times.
static bool paint(void *context, DipError *err) {
    (void)context;
    DipDamage damage;
    dip_draw_list_begin(list, WIDTH, HEIGHT);
    dip_draw_list_fill(list, (DipRect){0, 0, WIDTH, HEIGHT}, (DipColour){9, 9, 9, 255});
    for (int i = 0; i < LINES; ++i) {
        dip_draw_list_text(list, SIZE, (DipColour){255, 255, 255, 255}, DIP_ALIGN_LEFT, i, i % 40,
                           WIDTH, "The quick brown fox");
    }
    return dip_draw_list_paint(list, &canvas, &damage, err);
}

// A second turn on a canvas that was forgotten must paint everything.
static void check_paint(void *context, bool succeeded) {
    (void)succeeded;
    DipDrawList *fresh = dip_draw_list_create(font, NULL);
    DipDrawList *used = list;
    assert_true(paint(context, NULL));
    list = fresh;
    assert_true(paint(context, NULL));
    assert_memory_equal(canvas.rgba8, expected, sizeof expected);
    dip_draw_list_destroy(&list);
    list = used;
}

static void check_created(void *context, bool succeeded) {
    assert_int_equal(list != NULL, succeeded);
    destroy(context);
    assert_true(create(context, NULL));
}

static void font_and_list_are_made_whole_or_not_at_all(void **state) {
    (void)state;
    dip_out_of_memory_check(&(DipOutOfMemory){.name = "a font and a draw list",
                                              .run = create,
                                              .check = check_created,
                                              .finish = destroy,
                                              .needs_every_allocation = true});
}

static void every_letter_returns_with_memory(void **state) {
    (void)state;
    must_create(NULL);
    assert_true(paint(NULL, NULL));
    memcpy(expected, canvas.rgba8, sizeof expected);
    destroy(NULL);
    dip_out_of_memory_check(&(DipOutOfMemory){.name = "painting a draw list",
                                              .prepare = must_create,
                                              .run = paint,
                                              .check = check_paint,
                                              .finish = destroy});
}

int main(int argc, char **argv) {
    dip_out_of_memory_read_options(argc, argv);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(font_and_list_are_made_whole_or_not_at_all),
        cmocka_unit_test(every_letter_returns_with_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
