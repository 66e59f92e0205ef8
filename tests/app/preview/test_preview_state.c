// Tests of the actions that change the preview's state, of the free camera, and of the median of
// frame times.
#include "app/preview/state/camera.h"
#include "app/preview/live/figures.h"
#include "app/preview/state/keys.h"
#include "app/preview/state/state.h"
#include "config/config.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

typedef struct Fixture {
    DipCamPath *paths[2];
    DipCamTrack track;
    DipPreviewState state;
} Fixture;

static DipQuality parse(const char *text) {
    DipQuality quality;
    assert_true(dip_quality_parse(text, &quality, NULL));
    return quality;
}

// Makes two paths of 10 s for the categories DEFAULT and AF. The category AA has no path.
static int set_up(void **state) {
    static Fixture fixture;
    fixture = (Fixture){.track = dip_camtrack_make(true)};
    for (int i = 0; i < 2; ++i) {
        const DipCamKey keys[2] = {{{i, 0, 0}, {0, 0, 0, 1}}, {{i, 1, 0}, {0, 0, 0, 1}}};
        assert_true(dip_campath_create(keys, 2, INT64_C(5000000000), &fixture.paths[i], NULL));
    }
    dip_camtrack_set(&fixture.track, DIP_CATEGORY_DEFAULT, fixture.paths[0], 50.0);
    dip_camtrack_set(&fixture.track, DIP_CATEGORY_AF, fixture.paths[1], 60.0);
    const DipQuality quality[2] = {parse("aa=2"), parse("aa=none")};
    fixture.state = dip_preview_state_make(quality, &fixture.track);
    *state = &fixture;
    return 0;
}

static int tear_down(void **state) {
    Fixture *fixture = *state;
    dip_campath_destroy(&fixture->paths[0]);
    dip_campath_destroy(&fixture->paths[1]);
    return 0;
}

static void press(Fixture *fixture, DipAction action, int argument, bool shift) {
    dip_preview_act(&fixture->state, action, argument, shift, 0);
}

static int step_of(const Fixture *fixture, int pane, DipSetting setting) {
    return fixture->state.quality[pane].step[setting];
}

// Antialiasing goes through none 2 4 6 8 none, on the requested pane alone. With Shift, it goes
// through the steps in reverse.
static void a_setting_cycles_through_its_steps(void **state) {
    Fixture *f = *state;
    for (int i = 1; i <= 5; ++i) {
        press(f, DIP_ACTION_SETTING, DIP_SETTING_AA, false);
        assert_int_equal(step_of(f, DIP_PANE_REQUESTED, DIP_SETTING_AA), i % 5);
        assert_int_equal(step_of(f, DIP_PANE_CURRENT, DIP_SETTING_AA), 1);
    }
    press(f, DIP_ACTION_SETTING, DIP_SETTING_AA, true);
    assert_int_equal(step_of(f, DIP_PANE_REQUESTED, DIP_SETTING_AA), 4);
    assert_int_equal(f->state.scene_changes, 6);
}

// A group size of 4 is valid with 8 samples only. With another number of samples, the group size is
// reset to its default.
static void changing_samples_resets_an_invalid_group_size(void **state) {
    Fixture *f = *state;
    f->state.quality[DIP_PANE_REQUESTED] = parse("aa=8,aaa=on,asd=2");
    press(f, DIP_ACTION_SETTING, DIP_SETTING_ASD, false);
    // Group size 3 is not valid and is skipped.
    assert_int_equal(step_of(f, DIP_PANE_REQUESTED, DIP_SETTING_ASD), 3);
    press(f, DIP_ACTION_SETTING, DIP_SETTING_AA, true);
    assert_int_equal(step_of(f, DIP_PANE_REQUESTED, DIP_SETTING_AA), 3);
    assert_int_equal(step_of(f, DIP_PANE_REQUESTED, DIP_SETTING_ASD), 0);
    press(f, DIP_ACTION_SETTING, DIP_SETTING_ASD, false);
    press(f, DIP_ACTION_SETTING, DIP_SETTING_AA, false);
    // Group size 2 is valid with 8 samples, too.
    assert_int_equal(step_of(f, DIP_PANE_REQUESTED, DIP_SETTING_ASD), 1);
}

// Every setting returns to its first step, and all settings on the way are valid.
static void every_setting_returns_to_its_first_step(void **state) {
    Fixture *f = *state;
    for (int s = 0; s < DIP_SETTING_COUNT; ++s) {
        const DipQuality before = f->state.quality[DIP_PANE_REQUESTED];
        int presses = 0;
        do {
            press(f, DIP_ACTION_SETTING, s, false);
            assert_true(dip_quality_check(&f->state.quality[DIP_PANE_REQUESTED], NULL));
            assert_true(++presses <= DIP_MAX_STEPS);
        } while (memcmp(&before, &f->state.quality[DIP_PANE_REQUESTED], sizeof before) != 0);
    }
}

static void keys_change_the_chosen_panes_and_apply_copies(void **state) {
    Fixture *f = *state;
    press(f, DIP_ACTION_NEXT_PANE, 0, false); // now the current pane
    press(f, DIP_ACTION_SETTING, DIP_SETTING_AF, false);
    assert_int_equal(step_of(f, DIP_PANE_CURRENT, DIP_SETTING_AF), 1);
    assert_int_equal(step_of(f, DIP_PANE_REQUESTED, DIP_SETTING_AF), 0);
    press(f, DIP_ACTION_NEXT_PANE, 0, false); // now both panes
    press(f, DIP_ACTION_SETTING, DIP_SETTING_MIPDEBUG, false);
    assert_int_equal(step_of(f, DIP_PANE_CURRENT, DIP_SETTING_MIPDEBUG), 1);
    assert_int_equal(step_of(f, DIP_PANE_REQUESTED, DIP_SETTING_MIPDEBUG), 1);
    press(f, DIP_ACTION_NEXT_PANE, 0, false); // now the requested pane again
    assert_true(f->state.edited[DIP_PANE_REQUESTED] && !f->state.edited[DIP_PANE_CURRENT]);
    press(f, DIP_ACTION_APPLY, 0, false);
    assert_memory_equal(&f->state.quality[0], &f->state.quality[1], sizeof f->state.quality[0]);
    assert_int_equal(step_of(f, DIP_PANE_CURRENT, DIP_SETTING_AA), 0);
}

static void a_setting_chooses_its_path(void **state) {
    Fixture *f = *state;
    dip_preview_advance(&f->state, 3000000000, 0);
    press(f, DIP_ACTION_SETTING, DIP_SETTING_AF, false);
    assert_int_equal(f->track.active, DIP_CATEGORY_AF);
    assert_int_equal(dip_camtrack_time(&f->track, f->state.play_ns),
                     0); // a new path starts at its beginning
    press(f, DIP_ACTION_SETTING, DIP_SETTING_MIPDEBUG, false);
    assert_int_equal(f->track.active, DIP_CATEGORY_AF);
    press(f, DIP_ACTION_NEXT_PATH, 0, false);
    assert_int_equal(f->track.active, DIP_CATEGORY_DEFAULT);
    press(f, DIP_ACTION_NEXT_PATH, 0, true);
    assert_int_equal(f->track.active, DIP_CATEGORY_AF);
    press(f, DIP_ACTION_PATH, DIP_CATEGORY_DEFAULT, false);
    assert_int_equal(f->track.active, DIP_CATEGORY_DEFAULT);
    press(f, DIP_ACTION_PATH, DIP_CATEGORY_WATER, false); // the scene has no such path
    assert_int_equal(f->track.active, DIP_CATEGORY_DEFAULT);
    assert_non_null(strstr(f->state.notice, "WATER"));
}

// The camera that the user flies holds no model still: time stops only while paused.
static void the_free_camera_does_not_stop_the_scene(void **state) {
    Fixture *f = *state;
    f->state.scene_moves = true;
    press(f, DIP_ACTION_CAMERA, 0, false);
    assert_true(f->state.manual);
    const unsigned changes = f->state.scene_changes;
    dip_preview_advance(&f->state, 1000, 0);
    assert_int_equal(f->state.play_ns, 1000);
    assert_int_equal(f->state.scene_changes, changes + 1);
    assert_false(dip_preview_rests(&f->state, false));
    press(f, DIP_ACTION_PAUSE, 0, false);
    dip_preview_advance(&f->state, 1000, 0);
    assert_int_equal(f->state.play_ns, 1000);
    assert_true(dip_preview_rests(&f->state, false));
}

// Every action has a function, and only those that need no window act in a terminal.
static void every_action_is_carried_out(void **state) {
    Fixture *f = *state;
    f->state.tools.comparison = DIP_COMPARE_WIPE; // Has a divider to adjust.
    const DipPreviewState before = f->state;
    for (int in_terminal = 0; in_terminal < 2; ++in_terminal) {
        for (int a = 0; a < DIP_ACTION_COUNT; ++a) {
            f->state = before;
            f->state.in_terminal = in_terminal;
            press(f, (DipAction)a, a == DIP_ACTION_SPEED || a == DIP_ACTION_PATH_END, false);
            const bool refused = strstr(f->state.notice, "not in a terminal") != NULL;
            assert_int_equal(refused, in_terminal && dip_preview_needs_window((DipAction)a));
            const bool edits = a == DIP_ACTION_PATH_EDIT; // Does nothing without an editor.
            f->state.in_terminal = false;
            assert_true(edits || memcmp(&f->state, &before, sizeof before) != 0);
        }
    }
}

static void time_stops_while_paused_or_flying(void **state) {
    Fixture *f = *state;
    dip_preview_advance(&f->state, 1000, 0);
    assert_int_equal(f->state.play_ns, 1000);
    press(f, DIP_ACTION_STEP, -1, false);
    assert_true(f->state.paused);
    assert_int_equal(f->state.play_ns, 0); // time does not go below 0
    press(f, DIP_ACTION_STEP, 1, false);
    assert_int_equal(f->state.play_ns, 33333333);
    dip_preview_advance(&f->state, 1000, 0);
    assert_int_equal(f->state.play_ns, 33333333);
    press(f, DIP_ACTION_PAUSE, 0, false);
    press(f, DIP_ACTION_CAMERA, 0, false);
    dip_preview_advance(&f->state, 1000, 0);
    assert_int_equal(f->state.play_ns, 33333333);
    press(f, DIP_ACTION_CAMERA, 0, false);
    dip_preview_advance(&f->state, 1000, 0);
    assert_int_equal(f->state.play_ns, 33334333);
}

static void notices_disappear(void **state) {
    Fixture *f = *state;
    dip_preview_notice(&f->state, 1000, "hello %d", 3);
    dip_preview_advance(&f->state, 0, 1000);
    assert_string_equal(f->state.notice, "hello 3");
    dip_preview_advance(&f->state, 0, INT64_C(10000000000));
    assert_string_equal(f->state.notice, "");
}

static void settings_are_described_in_words(void **state) {
    (void)state;
    char text[64];
    DipQuality quality = dip_quality_default();
    dip_preview_describe(&quality, false, text, sizeof text);
    assert_string_equal(text, "Default settings");
    quality = parse("aa=4,af=16,aaf=on,miplod=quality");
    dip_preview_describe(&quality, true, text, sizeof text);
    assert_string_equal(text, "AA 4x, AF 16x, advanced AF, mip detail quality");
    quality = parse("aaa=on,asd=2,aa=4,gi=off");
    dip_preview_describe(&quality, true, text, sizeof text);
    assert_string_equal(text, "AA 4x, adaptive AA, groups of 2, no instancing");
    char longer[128];
    dip_preview_describe(&quality, false, longer, sizeof longer);
    assert_string_equal(longer, "Antialiasing 4x, Adaptive AA, Adaptive AA group size 2, "
                                "Geometry instancing off");
    char small[10];
    dip_preview_describe(&quality, false, small, sizeof small);
    assert_int_equal(strlen(small), 9);
}

static void assert_at(const DipPose *pose, double x, double y, double z) {
    assert_true(fabs(pose->position_world[0] - x) < 1e-9);
    assert_true(fabs(pose->position_world[1] - y) < 1e-9);
    assert_true(fabs(pose->position_world[2] - z) < 1e-9);
}

static void the_camera_moves_and_turns(void **state) {
    (void)state;
    DipPose pose = {.orientation = {0, 0, 0, 1}, .fov_y_deg = 50};
    const DipCameraKeys still = {0};
    assert_false(dip_camera_move(&pose, &still, 2.0, 1.0));
    const DipCameraKeys forward = {.forward = 1};
    assert_true(dip_camera_move(&pose, &forward, 2.0, 1.5)); // the camera looks along -Z
    assert_at(&pose, 0, 0, -3);
    const DipCameraKeys up = {.up = 1};
    dip_camera_move(&pose, &up, 2.0, 0.5);
    assert_at(&pose, 0, 1, -3);
    // The camera turns right by 90 degrees at 50 degrees per second, so it looks along +X.
    const DipCameraKeys turn_right = {.right = 1, .turn = true};
    dip_camera_move(&pose, &turn_right, 2.0, 90.0 / 50.0);
    dip_camera_move(&pose, &forward, 2.0, 1.0);
    assert_at(&pose, 2, 1, -3);
    // Then it turns up by 90 degrees and looks at the zenith.
    const DipCameraKeys turn_up = {.forward = 1, .turn = true};
    dip_camera_move(&pose, &turn_up, 2.0, 90.0 / 50.0);
    dip_camera_move(&pose, &forward, 2.0, 1.0);
    assert_at(&pose, 2, 3, -3);
}

static void the_median_covers_the_last_second(void **state) {
    (void)state;
    DipTiming timing = {0};
    assert_true(dip_timing_median_ms(&timing, 0) == 0.0);
    dip_timing_add(&timing, 0, 100.0);
    dip_timing_add(&timing, 500000000, 3.0);
    dip_timing_add(&timing, 600000000, 1.0);
    assert_true(dip_timing_median_ms(&timing, 700000000) == 3.0);
    dip_timing_add(&timing, 700000000, 2.0);
    assert_true(dip_timing_median_ms(&timing, 1100000000) == 2.0); // the frame of 100 ms is too old
    assert_int_equal(dip_timing_per_second(&timing, 1100000000), 3);
    assert_true(dip_timing_median_ms(&timing, 1550000000) == 1.5); // the median of two frames
    assert_true(dip_timing_median_ms(&timing, 9000000000) == 2.0); // only the last frame
    for (int i = 0; i < 1000; ++i) {
        dip_timing_add(&timing, 9000000000 + i, i);
    }
    assert_int_equal(dip_timing_per_second(&timing, 9000001000), DIP_TIMING_SAMPLES);
    dip_timing_clear(&timing);
    assert_int_equal(dip_timing_per_second(&timing, 9000001000), 0);
}

// The display refreshes every 10 ms. A picture that comes 30 ms after the one before it leaves two
// refreshes without a picture.
static void refreshes_without_a_picture_count_for_five_seconds(void **state) {
    (void)state;
    const int64_t ms = 1000000, refresh_ns = 10 * ms;
    const int64_t start_ns = 1000 * ms;
    static DipFigures figures;
    memset(&figures, 0, sizeof figures);
    dip_figures_count_presented(&figures, true, refresh_ns, start_ns);
    dip_figures_count_presented(&figures, true, refresh_ns, start_ns + 10 * ms);
    dip_figures_count_presented(&figures, true, refresh_ns, start_ns + 40 * ms); // 2 dropped
    dip_figures_count_presented(&figures, true, refresh_ns, start_ns + 54 * ms); // in time
    dip_figures_count_presented(&figures, true, refresh_ns, start_ns + 74 * ms); // 1 dropped
    dip_figures_update(&figures, true, start_ns + 300 * ms);
    assert_int_equal(figures.shown[0].dropped, 3);
    dip_figures_update(&figures, true, start_ns + 5050 * ms); // the first two are 5010 ms old
    assert_int_equal(figures.shown[0].dropped, 1);
    dip_figures_count_presented(&figures, false, refresh_ns, start_ns + 6000 * ms); // a rest
    dip_figures_count_presented(&figures, true, refresh_ns, start_ns + 9000 * ms);
    dip_figures_update(&figures, true, start_ns + 9300 * ms);
    assert_int_equal(figures.shown[0].dropped, 0);
}

// Presents a frame every `step_ms` from 0 ms to `end_ms` and returns the last frame's verdict.
static DipTaaSpeed speed_at(DipTaaPace *pace, int step_ms, int end_ms) {
    static DipTiming presented;
    DipTaaSpeed speed = {0};
    const int64_t ms = 1000000;
    dip_timing_clear(&presented);
    for (int now = 0; now <= end_ms; now += step_ms) {
        speed = dip_taa_pace_update(pace, true, &presented, 20 * ms, now * ms);
        dip_timing_add(&presented, now * ms, 0.0);
    }
    return speed;
}

// At 50 Hz, 45 frames in the last second are nine tenths of the refreshes.
static void slow_temporal_antialiasing_is_named(void **state) {
    (void)state;
    DipTaaPace pace = {0};
    const DipTaaSpeed slow = speed_at(&pace, 40, 2000); // 24 frames: those of 1040 to 1960 ms
    assert_true(slow.too_slow);
    assert_int_equal(slow.shown, 24);
    assert_int_equal(slow.wanted, 50);
    pace = (DipTaaPace){0};
    assert_false(speed_at(&pace, 20, 2000).too_slow);
    pace = (DipTaaPace){0};
    assert_false(speed_at(&pace, 40, 960).too_slow); // not on for a second yet
    assert_true(speed_at(&pace, 23, 2300).too_slow); // 43 frames
    DipTiming none = {0};
    assert_false(dip_taa_pace_update(&pace, false, &none, 20000000, 5000000000).too_slow);
    assert_false(dip_taa_pace_update(&pace, true, &none, 20000000, 6000000000).too_slow);
    assert_true(dip_taa_pace_update(&pace, true, &none, 20000000, 7000000000).too_slow);
}

// The grid of refreshes does not drift with the moments at which turns begin.
static void frames_are_due_in_steps_of_the_refresh(void **state) {
    (void)state;
    assert_int_equal(dip_taa_pace_next_ns(100, 99, 10, 104), 110);  // the turn began early
    assert_int_equal(dip_taa_pace_next_ns(110, 109, 10, 119), 120); // just in time
    assert_int_equal(dip_taa_pace_next_ns(120, 119, 10, 135), 129); // late: a new grid
    assert_int_equal(dip_taa_pace_next_ns(0, 500, 10, 503), 510);   // after a rest
    assert_int_equal(dip_taa_pace_next_ns(120, 105, 10, 106), 115); // the refresh became shorter
}

// A key that only a window can follow changes nothing in a terminal, and a notice says so.
static void a_terminal_names_what_needs_a_window(void **state) {
    static const DipAction actions[] = {
        DIP_ACTION_LOUPE, DIP_ACTION_COMPARISON, DIP_ACTION_MAP,   DIP_ACTION_BARE,
        DIP_ACTION_DOCK,  DIP_ACTION_PATH_EDIT,  DIP_ACTION_BLINK, DIP_ACTION_FULL_SCREEN};
    Fixture *f = *state;
    const DipToolState tools = f->state.tools;
    f->state.in_terminal = true;
    for (size_t i = 0; i < sizeof actions / sizeof *actions; ++i) {
        f->state.notice[0] = '\0';
        press(f, actions[i], 0, false);
        assert_non_null(strstr(f->state.notice, "window"));
        assert_false(f->state.full_screen);
        assert_memory_equal(&f->state.tools, &tools, sizeof tools);
    }
    press(f, DIP_ACTION_PANEL, 0, false);
    assert_true(dip_preview_shows_times(&f->state));
    f->state.in_terminal = false;
    press(f, DIP_ACTION_LOUPE, 0, false);
    assert_true(f->state.tools.loupe);
}

static void panes_only_show_no_times(void **state) {
    Fixture *f = *state;
    press(f, DIP_ACTION_PANEL, 0, false);
    assert_true(dip_preview_shows_times(&f->state));
    press(f, DIP_ACTION_BARE, 0, false);
    assert_false(dip_preview_shows_times(&f->state));
    press(f, DIP_ACTION_BARE, 0, false);
    assert_true(dip_preview_shows_times(&f->state));
}

// Each measured preset gives the requested pane the settings of its candidate. While nothing is
// measured it changes nothing and says so. This test also runs on objects that are built as users
// get them, without assertions.
static void each_preset_has_its_own_settings(void **state) {
    static const char *const settings[] = {"aa=none", "aa=2", "aa=4", "aa=8", "aa=8,af=16"};
    Fixture *f = *state;
    DipCandidate list[5];
    DipPreviewChoice choice = {.is_made = true, .known = DIP_PRICES_KNOWN};
    for (int i = 0; i < 5; ++i) {
        list[i] = (DipCandidate){.quality = parse(settings[i])};
    }
    choice.candidates = (DipCandidates){.list = list, .count = 5};
    const DipQuality before = f->state.quality[DIP_PANE_REQUESTED];
    for (int preset = 0; preset <= DIP_PRESET_BEST; ++preset) {
        press(f, DIP_ACTION_PRESET, preset, false);
        assert_memory_equal(&f->state.quality[DIP_PANE_REQUESTED], &before, sizeof before);
        assert_non_null(strstr(f->state.notice, "Times are measured while the view rests."));
    }
    f->state.choice = &choice;
    for (int preset = 0; preset <= DIP_PRESET_BEST; ++preset) {
        choice.advice.chosen = 4;
        choice.presets[preset] = preset + 1;
        press(f, DIP_ACTION_PRESET, preset, false);
        assert_memory_equal(&f->state.quality[DIP_PANE_REQUESTED], &list[preset + 1].quality,
                            sizeof(DipQuality));
    }
    f->state.choice = NULL;
    const DipQuality other = parse("aa=6");
    f->state.begun_quality[DIP_PANE_REQUESTED] = other;
    press(f, DIP_ACTION_PRESET, DIP_PRESET_INI, false);
    assert_memory_equal(&f->state.quality[DIP_PANE_REQUESTED], &other, sizeof other);
    press(f, DIP_ACTION_PRESET, DIP_PRESET_CURRENT, false);
    assert_memory_equal(&f->state.quality[DIP_PANE_REQUESTED], &f->state.quality[DIP_PANE_CURRENT],
                        sizeof other);
}

// What is typed while the help shows is searched there and changes nothing else.
static void words_are_searched_in_the_help(void **unused) {
    (void)unused;
    DipCamTrack track = dip_camtrack_make(false);
    const DipQuality quality[DIP_PANE_COUNT] = {dip_quality_default(), dip_quality_default()};
    DipPreviewState state = dip_preview_state_make(quality, &track);
    static const int keys[] = {'h', 'a', 'n', 'x', DIP_KEYCODE_BACKSPACE};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; ++i) {
        dip_keys_press(&state, &(DipEvent){.kind = DIP_EVENT_KEY_DOWN, .key = (DipKeycode)keys[i]},
                       0);
    }
    assert_true(state.help);
    assert_string_equal(state.help_words, "an");
    assert_memory_equal(state.quality, quality, sizeof quality);
    const DipEvent escape = {.kind = DIP_EVENT_KEY_DOWN, .key = DIP_KEYCODE_ESCAPE};
    dip_keys_press(&state, &escape, 0);
    assert_true(state.help && !state.help_words[0]);
    dip_keys_press(&state, &escape, 0);
    assert_true(!state.help && !state.quit);
}

// The command lines that the window shows must lead to the scene that it shows.
static void the_words_of_a_scene_name_all_that_changes_it(void **state) {
    (void)state;
    char text[DIP_SCENE_WORDS_BYTES];
    dip_scene_words(NULL, 0, text);
    assert_string_equal(text, "");
    dip_scene_words(&(DipSessionOptions){.config = NULL}, 0, text);
    assert_string_equal(text, "");
    const DipSessionOptions models = {.models = {"my car.glb", "b.obj"},
                                      .model_count = 2,
                                      .up = DIP_UP_z,
                                      .no_ground = true,
                                      .has_shading = true,
                                      .shading = DIP_MODEL_SHADING_flat,
                                      .animation = "it's on",
                                      .has_animation_time = true,
                                      .animation_time_s = 0.25,
                                      .path = "a.pth",
                                      .has_size = true,
                                      .size = {640, 480}};
    dip_scene_words(&models, 0, text);
    assert_string_equal(text, " --model 'my car.glb' --model b.obj --up z --shading flat "
                              "--no-ground --animation 'it'\\''s on' --animation-time 0.25 "
                              "--path a.pth --size 640x480");
    dip_scene_words(&(DipSessionOptions){.config = "a.ini", .scene = "blend"}, 2, text);
    assert_string_equal(text, " --config a.ini --scene blend --look 3");
    char longest[DIP_SCENE_WORDS_BYTES];
    memset(longest, 'a', sizeof longest - 1);
    longest[sizeof longest - 1] = '\0';
    dip_scene_words(&(DipSessionOptions){.config = "a.ini", .scene = longest}, 0, text);
    assert_string_equal(text, " --config a.ini ...");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(words_are_searched_in_the_help),
        cmocka_unit_test(the_words_of_a_scene_name_all_that_changes_it),
        cmocka_unit_test(slow_temporal_antialiasing_is_named),
        cmocka_unit_test(frames_are_due_in_steps_of_the_refresh),
        cmocka_unit_test(refreshes_without_a_picture_count_for_five_seconds),
        cmocka_unit_test_setup_teardown(a_setting_cycles_through_its_steps, set_up, tear_down),
        cmocka_unit_test_setup_teardown(changing_samples_resets_an_invalid_group_size, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(every_setting_returns_to_its_first_step, set_up, tear_down),
        cmocka_unit_test_setup_teardown(keys_change_the_chosen_panes_and_apply_copies, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(a_setting_chooses_its_path, set_up, tear_down),
        cmocka_unit_test_setup_teardown(the_free_camera_does_not_stop_the_scene, set_up, tear_down),
        cmocka_unit_test_setup_teardown(every_action_is_carried_out, set_up, tear_down),
        cmocka_unit_test_setup_teardown(time_stops_while_paused_or_flying, set_up, tear_down),
        cmocka_unit_test_setup_teardown(notices_disappear, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_terminal_names_what_needs_a_window, set_up, tear_down),
        cmocka_unit_test_setup_teardown(panes_only_show_no_times, set_up, tear_down),
        cmocka_unit_test_setup_teardown(each_preset_has_its_own_settings, set_up, tear_down),
        cmocka_unit_test(settings_are_described_in_words),
        cmocka_unit_test(the_camera_moves_and_turns),
        cmocka_unit_test(the_median_covers_the_last_second),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
