// Tests of the window's layout and of its settings tab: at every size, nothing leaves the window,
// and the keyboard reaches every setting and Apply; clicks, drags and the wheel change steps.
#include "tests/app/cost/made_report.h"
#include "tests/app/preview/lone_window.h"
#include "tests/app/preview/made_live.h"
#include "app/preview/loop/loop.h"
#include "app/preview/live/figures.h"
#include "app/preview/prices/price_text.h"
#include "app/ui/layout.h"
#include "app/ui/style.h"
#include "config/config.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static void click(int x, int y) {
    dip_lone_mouse(DIP_EVENT_MOUSE_DOWN, DIP_MOUSE_LEFT, x, y);
    dip_lone_mouse(DIP_EVENT_MOUSE_UP, DIP_MOUSE_LEFT, x, y);
}

static int step_of(int pane, DipSetting setting) {
    return lone.state.quality[pane].step[setting];
}

static void assert_inside(DipRect rect, DipRect room) {
    if (!dip_rect_is_empty(rect)) {
        assert_true(dip_rect_equals(dip_rect_intersect(rect, room), rect));
    }
}

static void assert_apart(DipRect a, DipRect b) {
    assert_true(dip_rect_is_empty(dip_rect_intersect(a, b)));
}

// At many sizes and scales, the parts of the window lie inside and apart. Only the drawer may cover
// a pane: the current one.
static void the_parts_of_the_window_lie_apart(void **unused) {
    (void)unused;
    static const double scales[] = {0.75, 1.0, 1.25, 2.0, 4.0};
    for (int width = 3; width < 4000; width += width / 3 + 1) {
        for (int height = 4; height < 2500; height += height / 3 + 1) {
            for (int i = 0; i < 5 * 4; ++i) {
                const DipRect window = {0, 0, width, height};
                const bool open = i & 1, bare = i & 2;
                const DipToolState set = {
                    .open = open, .bare = bare, .ui_scale = scales[i / 4], .fixed_scale = true};
                const DipLayout l = dip_layout_make(width, height, 1.0, &set);
                for (int p = 0; p < DIP_PANE_COUNT; ++p) {
                    assert_inside(l.panes[p], window);
                    assert_apart(l.panes[p], l.bar);
                    assert_int_equal(l.panes[p].width, l.panes[0].width);
                    assert_int_equal(l.panes[p].height, l.panes[0].height);
                }
                assert_inside(l.bar, window);
                assert_inside(l.body, window);
                assert_apart(l.panes[0], l.panes[1]);
                assert_apart(l.bar, l.body);
                assert_apart(l.panes[DIP_PANE_REQUESTED], l.body);
                if (l.side == DIP_DOCK_BELOW) {
                    assert_apart(l.panes[DIP_PANE_CURRENT], l.body);
                }
                assert_true(dip_rect_is_empty(l.body) == (!open || bare));
            }
        }
    }
}

// The line between the panes fills the whole gap, which is three pixels wide in a window of odd
// width.
static void the_line_between_the_panes_fills_the_gap(void **unused) {
    (void)unused;
    for (lone.input.width = 1282; lone.input.width < 1284; ++lone.input.width) {
        const DipLayout layout = dip_view_layout(&lone.input);
        const DipRect left = layout.panes[DIP_PANE_CURRENT];
        assert_true(dip_view_draw(lone.view, &lone.input, NULL));
        const DipPixels picture = dip_view_picture(lone.view);
        int columns = 0;
        for (int x = left.x + left.width; x < layout.panes[DIP_PANE_REQUESTED].x; ++x, ++columns) {
            const uint8_t *pixel =
                picture.rgba8 + (size_t)(left.height / 2) * picture.stride_bytes + 4 * (size_t)x;
            assert_int_equal(pixel[0], dip_style_accent.red);
            assert_int_equal(pixel[1], dip_style_accent.green);
            assert_int_equal(pixel[2], dip_style_accent.blue);
        }
        assert_int_equal(columns, 2 + lone.input.width % 2);
    }
}

// Visits all controls with Tab and collects the settings that it reaches in this state.
static unsigned visit(bool *apply) {
    unsigned settings = 0;
    const DipUiId first_setting = DIP_UI_ID(DIP_UI_SETTINGS, DIP_ID_FIRST_SETTING);
    DipUiId first = 0;
    dip_ui_blur(dip_view_ui(lone.view));
    for (int i = 0; i < 200; ++i) {
        assert_true(dip_lone_press(DIP_KEYCODE_TAB));
        const DipUiId focus = dip_ui_focus(dip_view_ui(lone.view));
        assert_true(focus != 0);
        if (focus == first) {
            return settings;
        }
        first = first ? first : focus;
        if (focus >= first_setting && focus < first_setting + DIP_SETTING_COUNT) {
            settings |= 1u << (focus - first_setting);
        }
        *apply |= focus == DIP_UI_ID(DIP_UI_SETTINGS, DIP_ID_APPLY);
    }
    fail_msg("Tab goes on without end");
    return 0;
}

// From two panes of 192x220 up, Tab reaches every setting and Apply, in the drawer perhaps by way
// of the button that exchanges settings and presets.
static void the_keyboard_reaches_every_setting(void **unused) {
    (void)unused;
    static const int sizes[][2] = {{386, 252},   {386, 480},  {642, 268},  {640, 480},
                                   {900, 500},   {1024, 768}, {1282, 720}, {1920, 1080},
                                   {2560, 1440}, {400, 1200}};
    lone.state.quality[DIP_PANE_REQUESTED].step[DIP_SETTING_AA] = 4;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; ++i) {
        bool apply = false;
        unsigned settings = 0;
        lone.input.width = sizes[i][0];
        lone.input.height = sizes[i][1];
        settings |= visit(&apply);
        assert_int_equal(settings, (1u << DIP_SETTING_COUNT) - 1);
        assert_true(apply);
        assert_true(dip_view_draw(lone.view, &lone.input, NULL));
    }
}

// Where the step of antialiasing at a position is in the window of 1282x720.
static int aa_x(int position) {
    return 612 + 32 + (2 * position + 1) * (356 - 32) / 5 / 2;
}
enum { AA_Y = 558 };

static void clicks_and_drags_choose_a_step(void **unused) {
    (void)unused;
    click(aa_x(2), AA_Y);
    assert_int_equal(step_of(DIP_PANE_REQUESTED, DIP_SETTING_AA), 2);
    assert_int_equal(step_of(DIP_PANE_CURRENT, DIP_SETTING_AA), 0);
    dip_lone_mouse(DIP_EVENT_MOUSE_DOWN, DIP_MOUSE_LEFT, aa_x(0), AA_Y);
    assert_int_equal(step_of(DIP_PANE_REQUESTED, DIP_SETTING_AA), 0);
    for (int i = 0; i < 5; ++i) {
        dip_lone_mouse(DIP_EVENT_MOUSE_MOVE, DIP_MOUSE_LEFT, aa_x(i),
                       AA_Y + 100); // The drag may leave the slider.
        assert_int_equal(step_of(DIP_PANE_REQUESTED, DIP_SETTING_AA), i);
    }
    dip_lone_mouse(DIP_EVENT_MOUSE_UP, DIP_MOUSE_LEFT, aa_x(4), AA_Y + 100);
    dip_lone_mouse(DIP_EVENT_MOUSE_MOVE, DIP_MOUSE_LEFT, aa_x(1), AA_Y);
    assert_int_equal(step_of(DIP_PANE_REQUESTED, DIP_SETTING_AA), 4);
    dip_lone_wheel(-1.0, 0, aa_x(1), AA_Y);
    assert_int_equal(step_of(DIP_PANE_REQUESTED, DIP_SETTING_AA), 3);
}

// Moves the focus to a control.
static void focus_on(DipUiGroup group, unsigned id) {
    dip_ui_blur(dip_view_ui(lone.view));
    while (dip_ui_focus(dip_view_ui(lone.view)) != DIP_UI_ID(group, id)) {
        assert_true(dip_lone_press(DIP_KEYCODE_TAB));
    }
}

// With the focus on antialiasing, arrows, Home and End take steps.
static void keys_change_the_focused_setting(void **unused) {
    (void)unused;
    focus_on(DIP_UI_SETTINGS, DIP_ID_FIRST_SETTING);
    assert_true(dip_lone_press(DIP_KEYCODE_RIGHT));
    assert_true(dip_lone_press(DIP_KEYCODE_RIGHT));
    assert_int_equal(step_of(DIP_PANE_REQUESTED, DIP_SETTING_AA), 2);
    assert_true(dip_lone_press(DIP_KEYCODE_END));
    assert_int_equal(step_of(DIP_PANE_REQUESTED, DIP_SETTING_AA), 4);
    assert_true(dip_lone_press(DIP_KEYCODE_RIGHT)); // There is no further step.
    assert_int_equal(step_of(DIP_PANE_REQUESTED, DIP_SETTING_AA), 4);
    assert_true(dip_lone_press(DIP_KEYCODE_HOME));
    assert_int_equal(step_of(DIP_PANE_REQUESTED, DIP_SETTING_AA), 0);
}

// The editor's head has a button that plays the path made for the open setting, if there is one.
static void the_open_settings_path_has_a_button(void **unused) {
    (void)unused;
    const DipCamKey keys[2] = {{{0, 0, 0}, {0, 0, 0, 1}}, {{2, 2, 0}, {0, 0, 0, 1}}};
    DipCamPath *other;
    assert_true(dip_campath_create(keys, 2, INT64_C(5000000000), &other, NULL));
    lone.state.open_setting = DIP_SETTING_MIPLOD;
    click(945, AA_Y - 26);
    assert_int_equal(lone.track.active, DIP_CATEGORY_DEFAULT);
    dip_camtrack_set(&lone.track, DIP_CATEGORY_MIPLOD, other, 60.0);
    click(945, AA_Y - 26);
    assert_int_equal(lone.track.active, DIP_CATEGORY_MIPLOD);
    lone.track = dip_camtrack_make(true);
    dip_campath_destroy(&other);
}

// In a small window, the drawer lies over the current pane and takes clicks in its place.
static void the_drawer_takes_clicks_over_the_pane(void **unused) {
    (void)unused;
    lone.input.width = 386;
    lone.input.height = 252;
    const DipLayout layout = dip_view_layout(&lone.input);
    assert_int_equal(layout.side, DIP_DOCK_DRAWER);
    click(layout.body.x + 20, layout.body.y + 5);
    assert_int_equal(step_of(DIP_PANE_REQUESTED, DIP_SETTING_AA), 1);
    assert_true(lone.state.edited[DIP_PANE_REQUESTED]);
    click(layout.panes[DIP_PANE_REQUESTED].x + 20, 100);
    assert_int_equal(step_of(DIP_PANE_REQUESTED, DIP_SETTING_AA), 1);
}

// A display of 4K that does not tell its scale has text twice as large, unless the user gave a
// scale.
static void text_grows_with_the_window(void **unused) {
    (void)unused;
    DipToolState set = {.ui_scale = 1.0};
    assert_true(dip_layout_scale(1.0, &set, 720) == 1.0);
    assert_true(dip_layout_scale(1.0, &set, 1080) == 1.0);
    assert_true(dip_layout_scale(1.0, &set, 1440) == 1.25);
    assert_true(dip_layout_scale(1.0, &set, 2160) == 2.0);
    assert_true(dip_layout_scale(3.0, &set, 2160) == 3.0); // The display knows better.
    set.fixed_scale = true;
    assert_true(dip_layout_scale(1.0, &set, 2160) == 1.0);
}

// One figure stands for a pane's time in its label and in the panel. A single frame is called that.
static void a_pane_has_one_time(void **unused) {
    (void)unused;
    char text[DIP_PANE_TIME_BYTES];
    DipWindow window = {
        .state = &lone.state, .figures = lone.figures, .prices = lone.prices, .still = true};
    lone.figures[1].frames = 1;
    dip_pane_time_text(&window, 1, text);
    assert_string_equal(text, "one frame: 5.0 ms");
    assert_true(dip_pane_sum(&window, 1).ms == 5.0);
    lone.figures[1].frames = 30;
    dip_pane_time_text(&window, 1, text);
    assert_string_equal(text, "5.0 ms");
    // What was measured at rest takes the place of the frames' time, in both.
    dip_made_live(lone.prices, "aa=none", 6.7, 0.01, 0.05);
    dip_pane_time_text(&window, 1, text);
    assert_string_equal(text, DIP_ROUGH_MARK "6.7 ms");
    const DipPriceSum sum = dip_pane_sum(&window, 1);
    assert_true(sum.ms > 6.65 && sum.ms < 6.75);
    char scope[DIP_PANE_SCOPE_BYTES];
    dip_pane_time_scope(&window, &sum, scope);
    assert_string_equal(scope, "");
    dip_made_live(lone.prices, "aa=none", 6.7, 0.9, 0.05);
    dip_pane_time_text(&window, 1, text);
    assert_string_equal(text, "7? ms");
    window.still = false; // Moving pictures have their own time.
    dip_pane_time_text(&window, 1, text);
    assert_string_equal(text, "5.0 ms");
    assert_true(dip_pane_sum(&window, 1).ms == 5.0);
}

// With a report, its price is the pane's one time, whether or not pictures move.
static void a_report_gives_the_panes_time(void **unused) {
    (void)unused;
    DipCostReport report;
    char text[DIP_PANE_TIME_BYTES];
    dip_made_report(&report, 16); // Row 0, with the default settings, takes 1 ms.
    assert_true(dip_cost_estimate_times(&report, NULL));
    assert_true(dip_prices_set_report(lone.prices, &report, NULL));
    DipWindow window = {.state = &lone.state, .figures = lone.figures, .prices = lone.prices};
    for (int still = 0; still < 2; ++still) {
        window.still = still;
        const DipPriceSum sum = dip_pane_sum(&window, 0);
        dip_pane_time_text(&window, 0, text);
        assert_string_equal(text, "1.0 ms");
        assert_true(fabs(sum.ms - 1.0) < 1e-9);
        char scope[DIP_PANE_SCOPE_BYTES];
        window.frames[0].width = report.width;
        window.frames[0].height = report.height;
        dip_pane_time_scope(&window, &sum, scope);
        assert_string_equal(scope, " along the path");
        window.frames[0].width *= 2; // A pane of this size takes longer than the report says.
        dip_pane_time_scope(&window, &sum, scope);
        snprintf(text, sizeof text, " at %dx%d", report.width, report.height);
        assert_string_equal(scope, text);
    }
    dip_prices_destroy(&lone.prices);
    dip_cost_report_free(&report);
}

// Returns where a colour begins in the lowest row of the dock's bar, or -1 if it has none.
static int line_of(DipColour colour) {
    assert_true(dip_view_draw(lone.view, &lone.input, NULL));
    const DipPixels shown = dip_view_picture(lone.view);
    const DipRect bar = dip_view_layout(&lone.input).bar;
    const uint8_t *row = shown.rgba8 + (size_t)(dip_rect_bottom(bar) - 1) * shown.stride_bytes;
    for (int x = bar.x; x < dip_rect_right(bar); ++x) {
        const uint8_t *pixel = row + 4 * (size_t)x;
        if (pixel[0] == colour.red && pixel[1] == colour.green && pixel[2] == colour.blue) {
            return x;
        }
    }
    return -1;
}

// A white line stands under the name of the open tab. A line in the accent colour stands under the
// tab of a tool that shows over the panes while another tab is open.
static void lines_mark_the_open_tab_and_the_tools(void **unused) {
    (void)unused;
    int begin[DIP_TAB_COUNT];
    for (int t = 0; t < DIP_TAB_COUNT; ++t) {
        lone.state.tools.tab = (DipTab)t;
        begin[t] = line_of(dip_style_white);
        assert_true(begin[t] > (t > 0 ? begin[t - 1] : -1));
        assert_int_equal(line_of(dip_style_accent), -1);
    }
    lone.state.tools.tab = DIP_TAB_SETTINGS;
    lone.state.tools.loupe = true;
    assert_int_equal(line_of(dip_style_white), begin[DIP_TAB_SETTINGS]);
    assert_int_equal(line_of(dip_style_accent), begin[DIP_TAB_LOUPE]);
    lone.state.tools.tab = DIP_TAB_LOUPE;
    assert_int_equal(line_of(dip_style_white), begin[DIP_TAB_LOUPE]);
    assert_int_equal(line_of(dip_style_accent), -1);
    lone.state.tools.open = false; // The tool shows, and its tab is folded away.
    assert_int_equal(line_of(dip_style_white), -1);
    assert_int_equal(line_of(dip_style_accent), begin[DIP_TAB_LOUPE]);
}

// The time of the last second with frames stays while nothing is drawn, until the settings change.
static void a_time_stays_while_nothing_is_drawn(void **unused) {
    (void)unused;
    static DipFigures shown;
    const int64_t second_ns = 1000000000;
    DipSessionFrame frame = {.copied = false};
    for (int i = 0; i < 30; ++i) {
        frame.panes[0].stages.total_ms = i == 29 ? 44.0 : 6.0; // The last frame was slow.
        dip_figures_add(&shown, &frame, second_ns + (i + 4) * second_ns / 40);
    }
    dip_figures_update(&shown, true, 2 * second_ns);
    assert_true(shown.shown[0].ms == 6.0 && shown.shown[0].frames == 30);
    dip_figures_update(&shown, false, 9 * second_ns);
    assert_true(shown.shown[0].ms == 6.0 && shown.shown[0].frames == 30);
    dip_figures_forget(&shown, 0);
    dip_figures_add(&shown, &frame, 10 * second_ns);
    dip_figures_update(&shown, false, 10 * second_ns);
    assert_true(shown.shown[0].ms == 44.0 && shown.shown[0].frames == 1);
    dip_figures_update(&shown, false, 20 * second_ns);
    assert_true(shown.shown[0].ms == 44.0 && shown.shown[0].frames == 1);
}

// A frame in which a pane copied the other one's pixels says nothing about the pane's settings.
static void frames_that_copied_pixels_do_not_count(void **unused) {
    (void)unused;
    static DipFigures shown;
    const int64_t second_ns = 1000000000;
    DipSessionFrame frame = {.copied = false};
    assert_false(dip_figures_have_times(&shown));
    for (int i = 0; i < 40; ++i) {
        const bool copies = i / 2 % 2 == 1;
        frame.panes[0].stages.total_ms = copies ? 2.0 : 6.0;
        frame.panes[0].counters.fragments_copied = copies ? 1 : 0;
        frame.panes[0].counters.fragments_shaded = copies ? 10 : 70;
        frame.panes[1].stages.total_ms = 3.0;
        dip_figures_add(&shown, &frame, second_ns + (i + 1) * second_ns / 50);
    }
    assert_true(dip_figures_have_times(&shown));
    dip_figures_update(&shown, true, 2 * second_ns);
    assert_true(shown.shown[0].ms == 6.0 && shown.shown[0].frames == 20);
    assert_true(shown.shown[1].ms == 3.0 && shown.shown[1].frames == 40);
    assert_int_equal(shown.shown[0].counters.fragments_shaded, 70);
}

// Presets are chosen by what settings cost and gain, so they wait until that is known.
static void presets_wait_for_prices(void **unused) {
    (void)unused;
    click(270, 530); // Quality.
    assert_int_equal(step_of(DIP_PANE_REQUESTED, DIP_SETTING_AA), 0);
    dip_made_live(lone.prices, "aa=none", 6.7, 0.01, -1.0);
    click(270, 530);
    assert_int_equal(step_of(DIP_PANE_REQUESTED, DIP_SETTING_AA), 0);
}

static void type(const char *digits) {
    for (; *digits; ++digits) {
        assert_true(dip_lone_press((DipKeycode)*digits));
    }
    assert_true(dip_lone_press(DIP_KEYCODE_ENTER));
}

// Asserts that a target holds wherever the window has one: in the state, in what is advised, in
// both fields' number and in the picture of the tab Times.
static void assert_target(DipPreviewChoice *choice, double ms, uint64_t *picture) {
    assert_true(fabs(lone.state.budget_ms - ms) < 1e-6);
    dip_preview_choose(choice, lone.prices, &lone.state.quality[DIP_PANE_REQUESTED],
                       lone.state.budget_ms);
    assert_true(fabs(choice->advice.budget_ms - ms) < 1e-6);
    lone.state.tools.tab = DIP_TAB_TIMES;
    assert_true(dip_view_draw(lone.view, &lone.input, NULL));
    const DipPixels shown = dip_view_picture(lone.view);
    const uint64_t before = *picture;
    *picture = 0;
    for (size_t i = 0; i < shown.stride_bytes * (size_t)shown.height; ++i) {
        *picture = *picture * 31 + shown.rgba8[i];
    }
    assert_true(*picture != before);
    lone.state.tools.tab = DIP_TAB_SETTINGS;
}

// A target that the user types or steps is the one for presets, advice and times.
static void a_target_holds_everywhere(void **unused) {
    (void)unused;
    static const double aa_ms[] = {5.0, 7.0, 9.0, 11.0, 13.0};
    DipPreviewChoice choice = {0};
    static const DipSetting settings[] = {DIP_SETTING_AA, DIP_SETTING_AF, DIP_SETTING_OPT,
                                          DIP_SETTING_MIPLOD};
    DipQuality best;
    uint64_t picture = 0;
    for (int i = 0; i < 4; ++i) { // Only antialiasing gains.
        for (int step = 0; step < dip_setting_info(settings[i])->step_count; ++step) {
            DipQuality quality = dip_quality_default();
            const bool gains = settings[i] == DIP_SETTING_AA || step == quality.step[settings[i]];
            const double ms = i == 0 ? aa_ms[step] : gains ? aa_ms[0] : 6.0;
            const double flip = i == 0 ? 0.09 - 0.01 * step : gains ? 0.09 : 0.1;
            quality.step[settings[i]] = (uint8_t)step;
            char text[DIP_COST_TEXT];
            dip_quality_format(&quality, text, sizeof text);
            dip_made_live(lone.prices, text, ms, 0.001, flip);
        }
    }
    lone.state.choice = &choice;
    assert_target(&choice, 1000.0 / 60.0, &picture);
    assert_true(dip_preview_preset(&lone.state, DIP_PRESET_BEST, &best));
    assert_int_equal(best.step[DIP_SETTING_AA], 4);
    click(1011, 571); // The pointer stays over the field of the frame rate.
    type("125");
    assert_target(&choice, 8.0, &picture);
    assert_true(dip_preview_preset(&lone.state, DIP_PRESET_BEST, &best));
    assert_int_equal(best.step[DIP_SETTING_AA], 1);
    focus_on(DIP_UI_SETTINGS, DIP_ID_FRAME_RATE);   // The tab was left meanwhile.
    assert_true(dip_lone_press(DIP_KEYCODE_RIGHT)); // The next usual rate.
    assert_target(&choice, 1000.0 / 144.0, &picture);
    focus_on(DIP_UI_SETTINGS, DIP_ID_BUDGET);
    assert_true(dip_lone_press((DipKeycode)'9') && dip_lone_press((DipKeycode)'9') &&
                dip_lone_press(DIP_KEYCODE_BACKSPACE));
    type(".5");
    assert_target(&choice, 9.5, &picture);
    assert_true(dip_preview_preset(&lone.state, DIP_PRESET_BEST, &best));
    assert_int_equal(best.step[DIP_SETTING_AA], 2);
    focus_on(DIP_UI_SETTINGS, DIP_ID_BUDGET);
    type("4");
    assert_target(&choice, 4.0, &picture);
    assert_false(dip_preview_preset(&lone.state, DIP_PRESET_BEST, &best)); // Nothing fits.
    dip_preview_follow_refresh(&lone.state, 10.0); // The user's choice stays,
    assert_true(lone.state.budget_ms == 4.0);
    dip_preview_set_budget(&lone.state, 0.0); // until the user takes the display's refresh.
    assert_target(&choice, 10.0, &picture);
    focus_on(DIP_UI_SETTINGS, DIP_ID_BUDGET);
    type("0"); // No frame takes no time.
    assert_true(lone.state.budget_ms == 10.0);
    focus_on(DIP_UI_SETTINGS, DIP_ID_FRAME_RATE);
    assert_true(dip_lone_press((DipKeycode)'3'));
    focus_on(DIP_UI_SETTINGS, DIP_ID_BUDGET); // What was not entered is forgotten.
    type("20");
    assert_target(&choice, 20.0, &picture);
    dip_preview_choice_free(&choice);
}

// A click on a sheet closes it and does nothing to what lies beneath.
static void a_click_closes_a_sheet(void **unused) {
    (void)unused;
    lone.state.help = true;
    click(aa_x(2), AA_Y);
    assert_false(lone.state.help);
    assert_int_equal(step_of(DIP_PANE_REQUESTED, DIP_SETTING_AA), 0);
}

// A click or a drag on the time line moves the time on the path.
static void the_time_line_moves_the_time(void **unused) {
    (void)unused;
    focus_on(DIP_UI_BAR, DIP_TAB_COUNT + 4);
    assert_true(dip_lone_press(DIP_KEYCODE_RIGHT));
    assert_int_equal(dip_preview_path_ns(&lone.state), INT64_C(1000000000));
    assert_true(dip_lone_press(DIP_KEYCODE_HOME));
    assert_int_equal(dip_preview_path_ns(&lone.state), 0);
}

int main(void) {
#define WINDOW_TEST(name) cmocka_unit_test_setup_teardown(name, dip_lone_set_up, dip_lone_tear_down)
    const struct CMUnitTest tests[] = {
        WINDOW_TEST(the_parts_of_the_window_lie_apart),
        WINDOW_TEST(the_line_between_the_panes_fills_the_gap),
        WINDOW_TEST(the_keyboard_reaches_every_setting),
        WINDOW_TEST(clicks_and_drags_choose_a_step),
        WINDOW_TEST(keys_change_the_focused_setting),
        WINDOW_TEST(the_drawer_takes_clicks_over_the_pane),
        WINDOW_TEST(text_grows_with_the_window),
        WINDOW_TEST(a_pane_has_one_time),
        WINDOW_TEST(a_report_gives_the_panes_time),
        WINDOW_TEST(lines_mark_the_open_tab_and_the_tools),
        WINDOW_TEST(the_open_settings_path_has_a_button),
        WINDOW_TEST(a_time_stays_while_nothing_is_drawn),
        WINDOW_TEST(frames_that_copied_pixels_do_not_count),
        WINDOW_TEST(presets_wait_for_prices),
        WINDOW_TEST(a_target_holds_everywhere),
        WINDOW_TEST(a_click_closes_a_sheet),
        WINDOW_TEST(the_time_line_moves_the_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
