// Tests of the maps: their colours, their scale, the pixel under the pointer, the pictures, the
// work that they measure, and how they lie over the panes.
#include "app/ui/canvas.h"
#include "app/measure/metrics/flip.h"
#include "app/preview/tools/loupe.h"
#include "app/preview/tools/map_colours.h"
#include "app/preview/tools/maps.h"
#include "tests/app/preview/tool_window.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 200, HEIGHT = 150, PIXELS = WIDTH * HEIGHT, TILES = 12 };

// --- colours -------------------------------------------------------------------------------------

static void check_colour(const uint8_t rgb[3], int red, int green, int blue, int tolerance) {
    assert_in_range(rgb[0] + 256, 256 + red - tolerance, 256 + red + tolerance);
    assert_in_range(rgb[1] + 256, 256 + green - tolerance, 256 + green + tolerance);
    assert_in_range(rgb[2] + 256, 256 + blue - tolerance, 256 + blue + tolerance);
}

// Entries of Matplotlib's tables, of which cividis has every 17th and not those of this list.
static void the_palettes_are_the_published_ones(void **state) {
    (void)state;
    static const struct {
        int index;
        uint8_t rgb[3];
    } cividis[] = {{0, {0, 34, 78}},
                   {63, {66, 78, 108}},
                   {1, {0, 35, 79}},
                   {191, {187, 173, 109}},
                   {255, {254, 232, 56}}};
    uint8_t rgb[3];
    for (size_t i = 0; i < sizeof cividis / sizeof *cividis; i++) {
        const uint8_t *expected = cividis[i].rgb;
        dip_cividis((float)cividis[i].index / 255.0f, rgb);
        check_colour(rgb, expected[0], expected[1], expected[2], 2);
    }
    dip_magma(0.0f, rgb);
    check_colour(rgb, 0, 0, 4, 4);
    dip_magma(128.0f / 255.0f, rgb);
    check_colour(rgb, 183, 55, 121, 4);
    dip_magma(1.0f, rgb);
    check_colour(rgb, 252, 253, 191, 5);
    dip_cividis(-1.0f, rgb);
    check_colour(rgb, 0, 34, 78, 0);
    dip_cividis(2.0f, rgb);
    check_colour(rgb, 254, 232, 56, 0);
    dip_cividis(NAN, rgb);
    check_colour(rgb, 0, 34, 78, 0);
}

// The luminance of cividis rises all along, so that it reads in grey, too.
static void cividis_gets_lighter_all_along(void **state) {
    (void)state;
    double before = -1.0;
    for (int i = 0; i < DIP_MAP_COLOURS; i += 5) {
        uint8_t rgb[3];
        dip_cividis((float)i / 255.0f, rgb);
        double luminance = 0.0;
        static const double weights[3] = {0.2126, 0.7152, 0.0722};
        for (int c = 0; c < 3; c++) {
            luminance += weights[c] * pow(rgb[c] / 255.0, 2.2);
        }
        assert_true(luminance > before);
        before = luminance;
    }
}

static void the_scale_ends_at_a_round_number(void **state) {
    (void)state;
    static const double cases[][2] = {{0.0, 1.0},  {-1.0, 1.0},     {0.58, 0.6},
                                      {1.0, 1.0},  {1.01, 1.5},     {2.3, 3.0},
                                      {9.0, 10.0}, {0.0031, 0.004}, {61.0, 80.0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_true(fabs(dip_map_round_up(cases[i][0]) - cases[i][1]) < 1e-9);
    }
    assert_int_equal(dip_map_colour_index(0.0f, 0.5f), 0);
    assert_int_equal(dip_map_colour_index(0.5f, 0.5f), 255);
    assert_int_equal(dip_map_colour_index(9.0f, 0.5f), 255);
    assert_int_equal(dip_map_colour_index(0.25f, 0.5f), 128);
}

static void values_are_short(void **state) {
    (void)state;
    static const struct {
        double value;
        const char *text;
    } cases[] = {{0.0, "0"},      {0.43, ".43"}, {0.034, ".034"}, {0.996, "1.00"},
                 {2.345, "2.35"}, {9.97, "10"},  {43.2, "43"}};
    char text[16];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        dip_map_format(cases[i].value, text, sizeof text);
        assert_string_equal(text, cases[i].text);
    }
}

// --- the pixel under the pointer -----------------------------------------------------------------

// A picture whose pixels hold their own positions is scaled by the canvas. Each pixel of the window
// must be traced back to the pixel that it shows.
static void the_pointer_finds_the_pixel_that_shows(void **state) {
    (void)state;
    static const int sizes[][4] = {
        {20, 15, 20, 15}, {20, 15, 47, 31}, {20, 15, 9, 7}, {1, 1, 8, 3}};
    uint8_t pixels[20 * 15 * 4];
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        const int *size = sizes[i];
        const DipPixels picture = {pixels, 4 * (size_t)size[0], size[0], size[1]};
        const DipRect shown = {3, 2, size[2], size[3]};
        DipCanvas canvas = {.rgba8 = NULL};
        int x, y;
        for (int p = 0; p < size[0] * size[1]; p++) {
            pixels[4 * p] = (uint8_t)(p % size[0]);
            pixels[4 * p + 1] = (uint8_t)(p / size[0]);
        }
        assert_true(dip_canvas_resize(&canvas, 60, 40, NULL));
        dip_canvas_copy(&canvas, shown, &picture);
        for (int wy = 2; wy < 2 + size[3]; wy++) {
            for (int wx = 3; wx < 3 + size[2]; wx++) {
                const uint8_t *pixel = canvas.rgba8 + 4 * (wy * 60 + wx);
                assert_true(dip_loupe_pixel_at(shown, size[0], size[1], wx, wy, &x, &y));
                assert_int_equal(x, pixel[0]);
                assert_int_equal(y, pixel[1]);
            }
        }
        assert_false(dip_loupe_pixel_at(shown, size[0], size[1], 2, 2, &x, &y));
        assert_false(dip_loupe_pixel_at(shown, size[0], size[1], 3 + size[2], 2, &x, &y));
        dip_canvas_free(&canvas);
    }
}

// --- the error map -------------------------------------------------------------------------------

static void the_error_map_has_the_colours_of_its_values(void **state) {
    (void)state;
    static uint8_t truth[4 * PIXELS], frame[4 * PIXELS];
    static float flip[PIXELS];
    DipMaps *maps = calloc(1, sizeof *maps);
    DipToolState tools = {.map = DIP_MAP_FLIP, .brightness = 2};
    DipErrorReading reading = {.status = DIP_ERROR_STATUS_WORKING};
    DipErrorPictures errors = {
        .version = 1, .width = WIDTH, .height = HEIGHT, .truth_rgba8 = truth, .flip = {flip, NULL}};
    const DipPixels shown = {frame, 4 * WIDTH, WIDTH, HEIGHT};
    DipPixels picture;
    uint64_t version, next;
    char room[80];
    for (int i = 0; i < PIXELS; i++) {
        flip[i] = (float)(i % 1001) / 1000.0f;
    }
    assert_false(dip_maps_picture(maps, &tools, 0, &shown, 1, &picture, &version));
    assert_string_equal(dip_maps_status(maps, tools.map, 0, true, true, room, sizeof room),
                        "Gallery scenes have no converged picture, so no error.");
    assert_string_equal(dip_maps_status(maps, tools.map, 0, false, false, room, sizeof room),
                        "Measured while the camera rests.");
    dip_maps_set_errors(maps, &reading, NULL);
    assert_string_equal(dip_maps_status(maps, tools.map, 0, false, true, room, sizeof room),
                        "Measuring: the converged picture is being drawn.");
    reading.result.samples = 32;
    dip_maps_set_errors(maps, &reading, &errors);
    assert_string_equal(dip_maps_status(maps, tools.map, 0, false, true, room, sizeof room),
                        "Measuring: 32 of 128 samples per pixel.");
    assert_true(dip_maps_picture(maps, &tools, 0, &shown, 1, &picture, &version));
    assert_false(dip_maps_picture(maps, &tools, 1, &shown, 1, &picture, &next));
    assert_true(dip_maps_picture(maps, &tools, 0, &shown, 1, &picture, &next));
    assert_true(next == version);
    for (int i = 0; i < PIXELS; i++) {
        uint8_t rgb[3];
        dip_magma(2.0f * flip[i], rgb);
        check_colour(picture.rgba8 + 4 * i, rgb[0], rgb[1], rgb[2], 3);
    }
    tools.brightness = 4;
    assert_true(dip_maps_picture(maps, &tools, 0, &shown, 1, &picture, &next));
    assert_true(next != version);
    tools.brightness = 1;
    assert_true(dip_maps_end(maps, &tools) == 1.0);
    assert_true(dip_maps_truth(maps, &version)->rgba8 == truth);
    dip_maps_free(maps);
    free(maps);
}

// --- maps of work --------------------------------------------------------------------------------

typedef struct Stage {
    DipTestScene scene;
    DipSession session;
    DipSessionFrame frame;
    DipToolsInput input;
    DipMaps *maps;
} Stage;

static Stage stage;

static int open_stage(void **state) {
    (void)state;
    static const char *const settings[] = {"aa=none", "aa=8,af=16"};
    memset(&stage, 0, sizeof stage);
    dip_test_scene_make(&stage.scene, DIP_TEST_SCENE_fence);
    stage.session = (DipSession){.pool = dip_pool_create(2, NULL), .isa = dip_isa_best()};
    stage.session.scene = dip_scene_create(&stage.scene.def, NULL, NULL);
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        DipRendererDef def = dip_renderer_default_def();
        def.pool = stage.session.pool;
        def.width = WIDTH;
        def.height = HEIGHT;
        assert_true(dip_quality_parse(settings[p], &def.quality, NULL));
        stage.session.renderers[p] = dip_painter_create(&def, NULL, NULL);
        assert_non_null(stage.session.renderers[p]);
    }
    assert_true(dip_session_draw_pose(&stage.session, &stage.scene.pose, 0, 0, &stage.frame, NULL));
    stage.maps = calloc(1, sizeof *stage.maps);
    stage.input = (DipToolsInput){.session = &stage.session,
                                  .pose = &stage.scene.pose,
                                  .width = WIDTH,
                                  .height = HEIGHT,
                                  .still = true};
    return 0;
}

static int close_stage(void **state) {
    (void)state;
    dip_maps_free(stage.maps);
    free(stage.maps);
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        dip_painter_destroy(&stage.session.renderers[p]);
    }
    dip_scene_destroy(&stage.session.scene);
    dip_pool_destroy(&stage.session.pool);
    dip_test_scene_free(&stage.scene);
    return 0;
}

// Lets the maps draw until they have nothing left to do. Returns the number of draws.
static int update(DipMap map) {
    int draws = 0;
    stage.maps->wanted = map;
    while (dip_maps_update(stage.maps, &stage.input)) {
        draws++;
        assert_true(draws < 100);
    }
    return draws;
}

static void tiles_add_up_to_what_the_panes_counted(void **state) {
    (void)state;
    char hash[2][33];
    dip_frame_hash(&stage.frame.panes[1], hash[0]);
    assert_int_equal(update(DIP_MAP_FRAGMENTS), 2);
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        const DipMapWork *work = dip_maps_work(stage.maps, p);
        const DipCounters *counters = &stage.frame.panes[p].counters;
        double fragments = 0.0, probes = 0.0, mixed = 0.0;
        uint64_t pixels = 0;
        assert_int_equal(work->across * work->down, TILES);
        for (int t = 0; t < TILES; t++) {
            const double all = dip_map_tile_pixels(work, t);
            fragments += all * dip_map_value(work, DIP_MAP_FRAGMENTS, t);
            probes += all * dip_map_value(work, DIP_MAP_PROBES, t);
            mixed += all * dip_map_value(work, DIP_MAP_SAMPLES, t);
        }
        for (int i = 0; i < PIXELS; i++) {
            pixels += work->mixed[i];
        }
        assert_true(fabs(fragments - (double)counters->fragments_shaded) < 1e-3);
        assert_true(fabs(probes - (double)counters->texture_probes) < 1e-3);
        assert_true(fabs(mixed - (double)counters->pixels_resolved) < 1e-3);
        assert_int_equal(pixels, counters->pixels_resolved);
    }
    dip_frame_hash(&stage.frame.panes[1], hash[1]);
    assert_string_equal(hash[0], hash[1]); // The panes' own pictures stay as they are.
    assert_true(dip_maps_work(stage.maps, 1)->records[0].counters.samples_shown >
                dip_maps_work(stage.maps, 0)->records[0].counters.samples_shown);
}

static void times_are_medians_of_several_draws(void **state) {
    (void)state;
    char room[80];
    assert_int_equal(update(DIP_MAP_TIME), 2 * DIP_MAP_DRAWS);
    assert_int_equal(update(DIP_MAP_TIME), 0);
    assert_string_equal(
        dip_maps_status(stage.maps, DIP_MAP_TIME, 0, false, true, room, sizeof room), "");
    for (int p = 0; p < DIP_PANE_COUNT; p++) {
        const DipMapWork *work = dip_maps_work(stage.maps, p);
        assert_int_equal(work->draws, DIP_MAP_DRAWS);
        for (int t = 0; t < TILES; t++) {
            assert_true(work->ms[t] > 0.0);
        }
    }
    // Other pixels need new measurements; a moving camera gets none.
    stage.input.versions[0] = 7;
    stage.input.still = false;
    assert_int_equal(update(DIP_MAP_TIME), 0);
    stage.input.still = true;
    stage.input.copied = true;
    assert_int_equal(update(DIP_MAP_PROBES), 1);
    assert_ptr_equal(dip_maps_work(stage.maps, 0), dip_maps_work(stage.maps, 1));
}

static void the_pictures_show_the_work(void **state) {
    (void)state;
    DipToolState tools = {.map = DIP_MAP_SAMPLES, .brightness = 1};
    const DipFrame *frame = &stage.frame.panes[1];
    const DipPixels shown = {frame->rgba8, frame->stride_bytes, WIDTH, HEIGHT};
    DipPixels picture;
    uint64_t version;
    assert_false(dip_maps_picture(stage.maps, &tools, 1, &shown, 1, &picture, &version));
    update(DIP_MAP_SAMPLES);
    assert_true(dip_maps_picture(stage.maps, &tools, 1, &shown, 1, &picture, &version));
    const DipMapWork *work = dip_maps_work(stage.maps, 1);
    for (int i = 0; i < PIXELS; i++) {
        const uint8_t *pixel = picture.rgba8 + 4 * i;
        const bool bright = pixel[0] == 254 && pixel[1] == 232 && pixel[2] == 56;
        assert_true(bright == (work->mixed[i] != 0));
    }
    tools.map = DIP_MAP_FRAGMENTS;
    assert_true(dip_maps_picture(stage.maps, &tools, 1, &shown, 1, &picture, &version));
    assert_true(dip_maps_end(stage.maps, &tools) >= 1.0);
    update(DIP_MAP_MIPS);
    tools.map = DIP_MAP_MIPS;
    assert_true(dip_maps_picture(stage.maps, &tools, 1, &shown, 1, &picture, &version));
    int known = 0;
    for (int i = 0; i < PIXELS; i++) {
        const int index = dip_maps_mip_index(stage.maps, 1, i % WIDTH, i / WIDTH);
        assert_in_range(index + 1, 0, DIP_MIP_DEBUG_LEVELS);
        known += index >= 0;
    }
    assert_true(known > PIXELS / 10); // The background has no mip colour.
    assert_int_equal(dip_maps_mip_index(stage.maps, 1, WIDTH, 5), -1);
}

// The first and the last colour also stand for all larger and all smaller levels, and say so
// wherever they are explained: in the legends and at the pixel under the pointer.
static void the_ends_of_the_mip_colours_say_that_they_are_open(void **state) {
    (void)state;
    static const char *const expected[DIP_MIP_DEBUG_LEVELS] = {
        "\u22651024", "512", "256", "128", "64", "32", "16", "\u22648"};
    for (int i = 0; i < DIP_MIP_DEBUG_LEVELS; i++) {
        char text[DIP_MIP_TEXT_BYTES];
        const DipColour colour = dip_map_mip_colour(i);
        uint8_t pixel[4] = {colour.red, colour.green, colour.blue, 255};
        DipMaps maps = {.panes = {{.width = 1, .height = 1, .mips = pixel}}};
        assert_int_equal(dip_maps_mip_index(&maps, 0, 0, 0), i);
        dip_map_mip_text(i, text);
        assert_string_equal(text, expected[i]);
    }
}

// --- over the panes ------------------------------------------------------------------------------

// Counts the pixels in the middle half of a pane that have the bright colour of the map of samples.
static int bright_pixels(const DipToolWindow *tw, int pane) {
    const DipRect *rect = &tw->layout.panes[pane];
    int count = 0;
    for (int y = rect->height / 4; y < rect->height * 3 / 4; y++) {
        for (int x = rect->width / 4; x < rect->width * 3 / 4; x++) {
            const uint8_t *pixel = dip_tool_window_pixel(tw, rect->x + x, rect->y + y);
            count += pixel[0] == 254 && pixel[1] == 232 && pixel[2] == 56;
        }
    }
    return count;
}

// A chosen map lies over the panes once it is measured. The map of samples shows edges where the
// settings have several samples per pixel.
static void a_chosen_map_lies_over_the_panes(void **state) {
    static DipToolWindow tw;
    (void)state;
    dip_tool_window_open(&tw, DIP_TEST_SCENE_fence, WIDTH, HEIGHT, 180);
    tw.state.tools.tab = DIP_TAB_COMPARE;
    tw.state.tools.brightness = 1;
    dip_tool_window_draw(&tw);
    assert_int_equal(bright_pixels(&tw, DIP_PANE_REQUESTED), 0);
    tw.state.tools.map = DIP_MAP_SAMPLES;
    for (int i = 0; i < 10; i++) {
        dip_tool_window_draw(&tw);
        dip_tool_window_update(&tw);
    }
    dip_tool_window_draw(&tw);
    assert_int_equal(bright_pixels(&tw, DIP_PANE_CURRENT), 0); // One sample per pixel.
    assert_true(bright_pixels(&tw, DIP_PANE_REQUESTED) > 100);
    tw.state.tools.map = DIP_MAP_NONE;
    dip_tool_window_draw(&tw);
    assert_int_equal(bright_pixels(&tw, DIP_PANE_REQUESTED), 0);
    dip_tool_window_close(&tw);
}

// While another comparison hides the maps, the tables of the open tab still follow the panes.
static void the_open_tab_is_measured_without_maps(void **state) {
    static DipToolWindow tw;
    (void)state;
    dip_tool_window_open(&tw, DIP_TEST_SCENE_fence, WIDTH, HEIGHT, 180);
    const DipMaps *maps = &tw.tools->maps;
    tw.state.tools.comparison = DIP_COMPARE_WIPE;
    tw.state.tools.map = DIP_MAP_SAMPLES;
    for (int i = 0; i < 3; i++) {
        tw.state.tools.tab = i == 0 ? DIP_TAB_LOUPE : DIP_TAB_MAPS;
        tw.pose.position_world[0] += 0.25;
        dip_tool_window_draw_frames(&tw, "aa=none", "aa=4", 1);
        dip_tool_window_draw(&tw);
        dip_tool_window_update(&tw);
        dip_tool_window_update(&tw);
        assert_int_equal(dip_maps_work(maps, DIP_PANE_REQUESTED)->draws, i > 0);
        assert_int_equal(maps->key.pose.position_world[0] == tw.pose.position_world[0], i > 0);
    }
    dip_tool_window_close(&tw);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_palettes_are_the_published_ones),
        cmocka_unit_test(cividis_gets_lighter_all_along),
        cmocka_unit_test(the_scale_ends_at_a_round_number),
        cmocka_unit_test(values_are_short),
        cmocka_unit_test(the_pointer_finds_the_pixel_that_shows),
        cmocka_unit_test(the_error_map_has_the_colours_of_its_values),
        cmocka_unit_test_setup_teardown(tiles_add_up_to_what_the_panes_counted, open_stage,
                                        close_stage),
        cmocka_unit_test_setup_teardown(times_are_medians_of_several_draws, open_stage,
                                        close_stage),
        cmocka_unit_test_setup_teardown(the_pictures_show_the_work, open_stage, close_stage),
        cmocka_unit_test(the_ends_of_the_mip_colours_say_that_they_are_open),
        cmocka_unit_test(a_chosen_map_lies_over_the_panes),
        cmocka_unit_test(the_open_tab_is_measured_without_maps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
