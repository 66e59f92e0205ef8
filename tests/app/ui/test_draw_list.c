// Tests of lists of drawing commands. Only what has changed is painted again, and the result is the
// same picture as if the list were painted on an empty canvas.
#include "app/ui/draw_list.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 160, HEIGHT = 100 };

static DipFont *font;
static uint32_t random_state = 1;

static int random_below(int limit) {
    random_state = random_state * 1664525u + 1013904223u;
    return (int)((random_state >> 8) % (uint32_t)limit);
}

static DipColour random_colour(void) {
    return (DipColour){(uint8_t)random_below(256), (uint8_t)random_below(256),
                       (uint8_t)random_below(256), (uint8_t)random_below(256)};
}

static const DipRect whole = {0, 0, WIDTH, HEIGHT};
static const DipColour opaque_black = {0, 0, 0, 255};

// Records a fill that covers the canvas, and random commands that depend only on `seed`.
static void record(DipDrawList *list, uint32_t seed, int width, int height) {
    static uint8_t texels[4 * 16 * 16];
    random_state = seed;
    dip_draw_list_begin(list, width, height);
    dip_draw_list_fill(list, (DipRect){0, 0, width, height}, opaque_black);
    const int count = 1 + random_below(12);
    for (int i = 0; i < count; ++i) {
        const DipRect box = {random_below(width), random_below(height), random_below(60),
                             random_below(40)};
        char line[32];
        snprintf(line, sizeof line, "%d letters", random_below(1000));
        switch (random_below(3)) {
        case 0:
            dip_draw_list_fill(list, box, random_colour());
            break;
        case 1:
            memset(texels, 77, sizeof texels);
            dip_draw_list_picture(list, box, &(DipPixels){texels, 64, 16, 16}, 1);
            break;
        default:
            dip_draw_list_text(list, 8 + random_below(20), random_colour(),
                               (DipAlign)random_below(3), box.x, box.y, 20 + random_below(100),
                               line);
        }
    }
}

static void paint(DipDrawList *list, DipCanvas *canvas, DipDamage *damage) {
    assert_true(dip_draw_list_paint(list, canvas, damage, NULL));
}

// Draws frames of random commands at several sizes. Painting over the previous frame gives the same
// picture as painting on an empty canvas, and no pixel outside the damage changes.
static void painting_over_equals_painting_anew(void **state) {
    (void)state;
    DipDrawList *list = dip_draw_list_create(font, NULL);
    DipCanvas canvas = {0};
    for (uint32_t seed = 1; seed <= 400; ++seed) {
        const int width = seed % 50 == 0 ? WIDTH + 7 : WIDTH;
        DipDrawList *fresh_list = dip_draw_list_create(font, NULL);
        DipCanvas fresh = {0};
        DipDamage damage;
        record(list, seed % 7 == 0 ? seed - 1 : seed, width, HEIGHT);
        paint(list, &canvas, &damage);
        assert_true(damage.count <= DIP_MAX_DAMAGE);
        record(fresh_list, seed % 7 == 0 ? seed - 1 : seed, width, HEIGHT);
        paint(fresh_list, &fresh, &damage);
        assert_memory_equal(canvas.rgba8, fresh.rgba8, 4 * (size_t)width * HEIGHT);
        dip_canvas_free(&fresh);
        dip_draw_list_destroy(&fresh_list);
    }
    dip_canvas_free(&canvas);
    dip_draw_list_destroy(&list);
}

static void record_label(DipDrawList *list, const char *figure, uint64_t version) {
    static uint8_t texels[4 * 64 * 64];
    dip_draw_list_begin(list, WIDTH, HEIGHT);
    dip_draw_list_picture(list, whole, &(DipPixels){texels, 256, 64, 64}, version);
    dip_draw_list_fill(list, (DipRect){0, 0, WIDTH, 20}, (DipColour){0, 0, 0, 128});
    dip_draw_list_text(list, 12, (DipColour){255, 255, 255, 255}, DIP_ALIGN_LEFT, 4, 2, 100,
                       figure);
}

static void only_changed_commands_are_damaged(void **state) {
    (void)state;
    DipDrawList *list = dip_draw_list_create(font, NULL);
    DipCanvas canvas = {0};
    DipDamage damage;
    record_label(list, "9.0 ms", 1);
    paint(list, &canvas, &damage);
    assert_int_equal(damage.count, 1);
    assert_true(dip_rect_equals(damage.rects[0], whole));
    record_label(list, "9.0 ms", 1);
    paint(list, &canvas, &damage);
    assert_int_equal(damage.count, 0);
    record_label(list, "9.1 ms", 1);
    paint(list, &canvas, &damage);
    assert_int_equal(damage.count, 1);
    assert_true(damage.rects[0].width < WIDTH / 2 && damage.rects[0].height <= 20);
    record_label(list, "9.1 ms", 2);
    paint(list, &canvas, &damage);
    assert_int_equal(damage.count, 1);
    assert_true(dip_rect_equals(damage.rects[0], whole));
    dip_canvas_free(&canvas);
    dip_draw_list_destroy(&list);
}

// Every rectangle that was added lies inside the damage, even if many rectangles were added.
static void damage_covers_what_was_added(void **state) {
    (void)state;
    for (int round = 0; round < 100; ++round) {
        DipDamage damage = {.count = 0};
        DipRect added[40];
        for (int i = 0; i < 40; ++i) {
            added[i] = (DipRect){random_below(1000), random_below(1000), 1 + random_below(50),
                                 1 + random_below(50)};
            dip_damage_add(&damage, added[i]);
            assert_in_range(damage.count, 1, DIP_MAX_DAMAGE);
        }
        for (int i = 0; i < 40; ++i) {
            bool inside = false;
            for (int d = 0; d < damage.count; ++d) {
                inside |= dip_rect_equals(dip_rect_intersect(added[i], damage.rects[d]), added[i]);
            }
            assert_true(inside);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(painting_over_equals_painting_anew),
        cmocka_unit_test(only_changed_commands_are_damaged),
        cmocka_unit_test(damage_covers_what_was_added),
    };
    font = dip_font_create(NULL);
    if (!font) {
        return 1;
    }
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    dip_font_destroy(&font);
    return failed;
}
