// Tests of the controls: which one takes an event, the order of the focus, dragging, the wheel, and
// tips. Two controls overlap, one is disabled.
#include "app/ui/ui.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { COUNT = 5, WIDTH = 400, HEIGHT = 200 };

// The controls in the order of their declaration. BELOW lies under ABOVE.
enum { BELOW, ABOVE, LEFT, MIDDLE, RIGHT };

static DipUi *ui;
static DipFont *font;
static DipDrawList *list;
static DipUiControl controls[COUNT];
static DipUiInput inputs[COUNT]; // What the controls got in the last pass.
static int64_t now_ns;

static int set_up(void **state) {
    (void)state;
    ui = dip_ui_create(NULL);
    font = dip_font_create(NULL);
    list = dip_draw_list_create(font, NULL);
    assert_true(ui && font && list);
    const DipRect rects[COUNT] = {{0, 0, 200, 100},
                                  {50, 20, 60, 30},
                                  {0, 120, 40, 20},
                                  {50, 120, 40, 20},
                                  {100, 120, 40, 20}};
    for (int i = 0; i < COUNT; ++i) {
        controls[i] = (DipUiControl){.id = DIP_UI_ID(DIP_UI_BAR, i + 1),
                                     .rect = rects[i],
                                     .takes_arrows = i == ABOVE,
                                     .takes_wheel = i == ABOVE};
    }
    controls[BELOW].skips_focus = true;
    controls[ABOVE].tip = "The tip of the upper control";
    controls[MIDDLE].disabled = true;
    now_ns = 1000000000;
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    dip_draw_list_destroy(&list);
    dip_font_destroy(&font);
    dip_ui_destroy(&ui);
    return 0;
}

static bool pass(const DipEvent *event, DipDrawList *to) {
    dip_ui_begin(ui, &(DipUiPass){font, 1.0, now_ns, to, event});
    for (int i = 0; i < COUNT; ++i) {
        inputs[i] = dip_ui_control(ui, &controls[i]);
    }
    return dip_ui_end(ui);
}

static bool send(const DipEvent *event) {
    pass(NULL, NULL);
    return pass(event, NULL);
}

static bool mouse(DipEventKind kind, int x, int y) {
    return send(&(DipEvent){.kind = kind, .x = x, .y = y, .button = DIP_MOUSE_LEFT, .clicks = 1});
}

static bool press(DipKeycode key, unsigned modifiers) {
    return send(&(DipEvent){.kind = DIP_EVENT_KEY_DOWN, .key = key, .modifiers = modifiers});
}

static bool is_focus(int control) {
    return dip_ui_focus(ui) == controls[control].id;
}

// The control that was declared last lies above the others and takes the event alone.
static void the_topmost_control_takes_the_mouse(void **state) {
    (void)state;
    assert_true(mouse(DIP_EVENT_MOUSE_DOWN, 60, 30));
    assert_true(inputs[ABOVE].began && inputs[ABOVE].held);
    assert_false(inputs[BELOW].began || inputs[BELOW].hovered);
    assert_true(mouse(DIP_EVENT_MOUSE_UP, 60, 30));
    assert_true(inputs[ABOVE].pressed);
    assert_false(inputs[BELOW].pressed);
    assert_true(mouse(DIP_EVENT_MOUSE_DOWN, 10, 10));
    assert_true(inputs[BELOW].began);
    mouse(DIP_EVENT_MOUSE_UP, 10, 10);
    assert_false(mouse(DIP_EVENT_MOUSE_DOWN, 300, 150));
}

// A release elsewhere presses nothing. Meanwhile the pointer moves the held control only.
static void a_drag_stays_with_its_control(void **state) {
    (void)state;
    mouse(DIP_EVENT_MOUSE_DOWN, 60, 30);
    assert_true(mouse(DIP_EVENT_MOUSE_MOVE, 300, 190));
    assert_true(inputs[ABOVE].moved && inputs[ABOVE].held);
    assert_int_equal(inputs[ABOVE].x, 300);
    mouse(DIP_EVENT_MOUSE_MOVE, 10, 10);
    assert_false(inputs[BELOW].hovered || inputs[BELOW].moved);
    mouse(DIP_EVENT_MOUSE_UP, 10, 10);
    assert_false(inputs[ABOVE].pressed || inputs[BELOW].pressed);
    mouse(DIP_EVENT_MOUSE_MOVE, 10, 10);
    assert_true(inputs[BELOW].hovered);
    assert_false(inputs[ABOVE].held);
}

static void a_disabled_control_takes_nothing(void **state) {
    (void)state;
    assert_true(mouse(DIP_EVENT_MOUSE_DOWN, 60, 130)); // No control beneath gets the press either.
    assert_false(inputs[MIDDLE].began);
    mouse(DIP_EVENT_MOUSE_UP, 60, 130);
    assert_false(inputs[MIDDLE].pressed);
}

// Tab visits the controls in a ring and leaves out those that skip the focus or are disabled.
static void tab_visits_the_controls_in_order(void **state) {
    (void)state;
    static const int order[] = {ABOVE, LEFT, RIGHT, ABOVE};
    for (int i = 0; i < 4; ++i) {
        assert_true(press(DIP_KEYCODE_TAB, 0));
        assert_true(is_focus(order[i]));
    }
    for (int i = 2; i >= 0; --i) {
        assert_true(press(DIP_KEYCODE_TAB, DIP_MODIFIER_SHIFT));
        assert_true(is_focus(order[i]));
    }
    assert_false(press(DIP_KEYCODE_TAB, DIP_MODIFIER_ALT));
    dip_ui_blur(ui);
    assert_true(press(DIP_KEYCODE_TAB, DIP_MODIFIER_SHIFT));
    assert_true(is_focus(RIGHT));
}

// Keys act on a control only while it shows the focus, which a click does not give.
static void keys_act_on_the_visible_focus(void **state) {
    (void)state;
    assert_false(press(DIP_KEYCODE_RIGHT, 0));
    mouse(DIP_EVENT_MOUSE_DOWN, 60, 30);
    mouse(DIP_EVENT_MOUSE_UP, 60, 30);
    assert_int_equal(dip_ui_focus(ui), 0);
    assert_false(press(DIP_KEYCODE_ENTER, 0));
    press(DIP_KEYCODE_TAB, DIP_MODIFIER_SHIFT); // The order goes on from the clicked control.
    assert_true(is_focus(RIGHT));
    press(DIP_KEYCODE_TAB, 0);
    assert_true(is_focus(ABOVE) && inputs[ABOVE].focused == false);
    assert_true(press(DIP_KEYCODE_RIGHT, 0));
    assert_int_equal(inputs[ABOVE].steps, 1);
    assert_true(press(DIP_KEYCODE_LEFT, 0));
    assert_int_equal(inputs[ABOVE].steps, -1);
    assert_true(press(DIP_KEYCODE_END, 0));
    assert_true(inputs[ABOVE].to_last);
    assert_true(press(DIP_KEYCODE_SPACE, 0));
    assert_true(inputs[ABOVE].pressed);
    assert_false(press('x', 0));
    assert_false(press(DIP_KEYCODE_ENTER, DIP_MODIFIER_CTRL));
}

// Arrow keys that the control does not take move the focus to the neighbour in that direction.
static void arrows_move_the_focus(void **state) {
    (void)state;
    press(DIP_KEYCODE_TAB, 0);
    assert_true(press(DIP_KEYCODE_DOWN, 0));
    assert_false(is_focus(ABOVE));
    while (!is_focus(LEFT)) {
        press(DIP_KEYCODE_TAB, 0);
    }
    assert_true(press(DIP_KEYCODE_RIGHT, 0)); // Passes the disabled control over.
    assert_true(is_focus(RIGHT));
    assert_true(press(DIP_KEYCODE_LEFT, 0));
    assert_true(is_focus(LEFT));
    assert_true(press(DIP_KEYCODE_UP, 0));
    assert_true(is_focus(ABOVE));
}

// Parts of a wheel's step add up, as touch pads send them.
static void the_wheel_counts_whole_steps(void **state) {
    (void)state;
    int steps = 0;
    for (int i = 0; i < 10; ++i) {
        assert_true(
            send(&(DipEvent){.kind = DIP_EVENT_MOUSE_WHEEL, .x = 60, .y = 30, .wheel_y = 0.25}));
        steps += inputs[ABOVE].steps;
    }
    assert_int_equal(steps, 2);
    send(&(DipEvent){.kind = DIP_EVENT_MOUSE_WHEEL, .x = 60, .y = 30, .wheel_y = -1.0});
    assert_int_equal(inputs[ABOVE].steps, -1);
    assert_false(send(&(DipEvent){.kind = DIP_EVENT_MOUSE_WHEEL, .x = 10, .y = 10, .wheel_y = 1}));
}

// Draws a control alone while the pointer rests at (40, y), until its tip is there. rows: NULL, or
// what tips stay off. The list is new, so that the whole canvas is painted.
static void draw_tip_of(const DipUiControl *control, int y, const DipRect *rows,
                        DipCanvas *canvas) {
    const DipEvent move = {.kind = DIP_EVENT_MOUSE_MOVE, .x = 40, .y = y};
    DipDamage damage;
    DipDrawList *fresh = dip_draw_list_create(font, NULL);
    assert_non_null(fresh);
    for (int i = 0; i < 3; ++i) {
        now_ns += 400000000;
        dip_draw_list_begin(fresh, WIDTH, HEIGHT);
        dip_draw_list_fill(fresh, (DipRect){0, 0, WIDTH, HEIGHT}, (DipColour){0, 0, 0, 255});
        dip_ui_begin(ui, &(DipUiPass){font, 1.0, now_ns, i ? fresh : NULL, i ? NULL : &move});
        if (rows) {
            dip_ui_keep_tips_off(ui, *rows);
        }
        dip_ui_control(ui, control);
        dip_ui_end(ui);
    }
    assert_true(dip_draw_list_paint(fresh, canvas, &damage, NULL));
    dip_draw_list_destroy(&fresh);
}

// Returns how many pixels of a rectangle are drawn.
static int drawn_in(const DipCanvas *canvas, DipRect rect) {
    int drawn = 0;
    for (int y = rect.y; y < rect.y + rect.height; ++y) {
        for (int x = rect.x; x < rect.x + rect.width; ++x) {
            drawn += canvas->rgba8[4 * (WIDTH * y + x)] != 0;
        }
    }
    return drawn;
}

// Tips of controls among rows stay off these rows; other tips stay off their control.
static void a_tip_covers_no_row(void **state) {
    (void)state;
    for (int row = 0; row < 2; ++row) {
        const DipRect rows = {0, row ? 150 : 120, WIDTH, HEIGHT - (row ? 150 : 120)};
        const DipUiControl aimed = {
            .id = 77, .rect = {20, 160, 60, 20}, .tip = "A tip of one line"};
        DipCanvas canvas = {0};
        draw_tip_of(&aimed, 170, row ? &rows : NULL, &canvas);
        assert_int_equal(drawn_in(&canvas, row ? rows : aimed.rect), 0);
        assert_true(drawn_in(&canvas, (DipRect){0, 0, WIDTH, HEIGHT}) > 100);
        dip_canvas_free(&canvas);
    }
}

// So it covers nothing that stands at the top of what a divider divides.
static void the_tip_of_a_high_control_follows_the_pointer(void **state) {
    (void)state;
    const DipUiControl divider = {
        .id = 78, .rect = {32, 0, 16, HEIGHT}, .tip = "A tip of one line"};
    for (int y = 0; y < HEIGHT; y += HEIGHT / 5) {
        DipCanvas canvas = {0};
        draw_tip_of(&divider, y, NULL, &canvas);
        const int top = dip_max(0, y - 40), bottom = dip_min(HEIGHT, y + 40);
        const DipRect beside = {0, top, WIDTH, bottom - top};
        const int drawn = drawn_in(&canvas, beside);
        assert_true(drawn > 100);
        assert_int_equal(drawn_in(&canvas, (DipRect){0, 0, WIDTH, HEIGHT}), drawn);
        dip_canvas_free(&canvas);
    }
}

// A tip appears 0.4 s after the pointer came, and a click hides it.
static void a_tip_appears_after_a_while(void **state) {
    (void)state;
    DipCanvas canvas = {0};
    DipDamage damage;
    mouse(DIP_EVENT_MOUSE_MOVE, 60, 30);
    assert_int_equal(dip_ui_wakes_ns(ui), now_ns + 400000000);
    for (int i = 0; i < 3; ++i) {
        now_ns += i == 1 ? 400000000 : 0;
        dip_draw_list_begin(list, WIDTH, HEIGHT);
        dip_draw_list_fill(list, (DipRect){0, 0, WIDTH, HEIGHT}, (DipColour){0, 0, 0, 255});
        pass(NULL, list);
        assert_true(dip_draw_list_paint(list, &canvas, &damage, NULL));
        if (i == 1) {
            assert_true(damage.count > 0);
            assert_true(dip_ui_wakes_ns(ui) == INT64_MAX);
        } else if (i == 2) {
            assert_int_equal(damage.count, 0);
        }
    }
    mouse(DIP_EVENT_MOUSE_DOWN, 60, 30);
    mouse(DIP_EVENT_MOUSE_UP, 60, 30);
    dip_draw_list_begin(list, WIDTH, HEIGHT);
    dip_draw_list_fill(list, (DipRect){0, 0, WIDTH, HEIGHT}, (DipColour){0, 0, 0, 255});
    pass(NULL, list);
    assert_true(dip_draw_list_paint(list, &canvas, &damage, NULL));
    assert_true(damage.count > 0);                 // The tip is gone,
    assert_true(dip_ui_wakes_ns(ui) == INT64_MAX); // and stays away.
    dip_canvas_free(&canvas);
}

// A user who clicks a disabled control wants to know why, so its tip shows at once.
static void a_click_on_a_disabled_control_shows_its_tip(void **state) {
    (void)state;
    controls[MIDDLE].tip = "It waits for something";
    mouse(DIP_EVENT_MOUSE_MOVE, 60, 130);
    assert_true(dip_ui_wakes_ns(ui) > now_ns);
    mouse(DIP_EVENT_MOUSE_DOWN, 60, 130);
    assert_true(dip_ui_wakes_ns(ui) <= now_ns);
    mouse(DIP_EVENT_MOUSE_UP, 60, 130);
    assert_true(dip_ui_wakes_ns(ui) <= now_ns);
}

// Wherever the user clicks, the focus that Tab has moved shows no more and takes no keys.
static void any_click_hides_the_focus(void **state) {
    (void)state;
    static const int places[][2] = {{60, 30}, {10, 10}, {10, 130}, {60, 130}, {300, 190}};
    for (size_t i = 0; i < sizeof places / sizeof *places; ++i) {
        press(DIP_KEYCODE_TAB, 0);
        assert_int_not_equal(dip_ui_focus(ui), 0);
        mouse(DIP_EVENT_MOUSE_DOWN, places[i][0], places[i][1]);
        mouse(DIP_EVENT_MOUSE_UP, places[i][0], places[i][1]);
        assert_int_equal(dip_ui_focus(ui), 0);
        pass(NULL, NULL);
        for (int c = 0; c < COUNT; ++c) {
            assert_false(inputs[c].focused);
        }
        assert_false(press(DIP_KEYCODE_RIGHT, 0));
    }
}

// A drawing pass reports no input, and hovers what an event pass hovers.
static void drawing_reports_no_input(void **state) {
    (void)state;
    for (int y = 5; y < HEIGHT; y += 10) {
        for (int x = 5; x < WIDTH; x += 10) {
            bool hovered[COUNT];
            mouse(DIP_EVENT_MOUSE_MOVE, x, y);
            for (int i = 0; i < COUNT; ++i) {
                hovered[i] = inputs[i].hovered;
            }
            dip_draw_list_begin(list, WIDTH, HEIGHT);
            assert_false(pass(NULL, list));
            for (int i = 0; i < COUNT; ++i) {
                assert_int_equal(inputs[i].hovered, hovered[i]);
                assert_false(inputs[i].pressed || inputs[i].began || inputs[i].moved);
                assert_int_equal(inputs[i].steps, 0);
            }
        }
    }
}

// A control that is declared no more loses the focus, so that keys act on the preview again.
static void a_lost_control_takes_no_keys(void **state) {
    (void)state;
    press(DIP_KEYCODE_TAB, 0);
    assert_true(is_focus(ABOVE));
    controls[ABOVE].id = DIP_UI_ID(DIP_UI_HELP, 9);
    pass(NULL, NULL);
    assert_int_equal(dip_ui_focus(ui), 0);
    assert_false(press(DIP_KEYCODE_RIGHT, 0));
}

int main(void) {
#define UI_TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        UI_TEST(the_topmost_control_takes_the_mouse),
        UI_TEST(a_drag_stays_with_its_control),
        UI_TEST(a_disabled_control_takes_nothing),
        UI_TEST(tab_visits_the_controls_in_order),
        UI_TEST(keys_act_on_the_visible_focus),
        UI_TEST(arrows_move_the_focus),
        UI_TEST(the_wheel_counts_whole_steps),
        UI_TEST(a_tip_covers_no_row),
        UI_TEST(the_tip_of_a_high_control_follows_the_pointer),
        UI_TEST(a_tip_appears_after_a_while),
        UI_TEST(any_click_hides_the_focus),
        UI_TEST(drawing_reports_no_input),
        UI_TEST(a_lost_control_takes_no_keys),
        UI_TEST(a_click_on_a_disabled_control_shows_its_tip),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
