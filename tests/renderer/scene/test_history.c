// taa=history: the result of every picture against a plain model in double precision that finds the
// past of a pixel by intersecting its view ray with a plane; and what resets a history, what it
// takes, and that its frames do not depend on threads, instruction sets or the frames before.
#include "renderer/post/history.h"
#include "renderer/scene/view/view.h"
#include "tests/renderer/scene/stage.h"
#include "tests/support/srgb.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// --- the model -----------------------------------------------------------------------------------

enum { WIDTH = 83, HEIGHT = 61, PIXELS = WIDTH * HEIGHT };

typedef uint8_t Picture[PIXELS * 4];

static uint32_t random_state = 1;

static uint32_t random_number(uint32_t limit) {
    random_state = random_state * 1664525u + 1013904223u;
    return (random_state >> 8) % limit;
}

static void fill(Picture picture) {
    for (int i = 0; i < PIXELS * 4; i++) {
        picture[i] = (uint8_t)random_number(256);
    }
}

// 16-bit linear light of a code, and the code of 16-bit linear light.
static double light_of(int code) {
    return floor(65535.0 * srgb_light(code) + 0.5);
}

static int code_of(double light) {
    return srgb_code(floor(light + 0.5) / 65535.0);
}

static DipHistory *make(DipIsa isa, DipPool *pool) {
    const DipHistoryDef def = {WIDTH, HEIGHT, isa, pool};
    DipHistory *history = dip_history_create(&def, NULL);
    assert_non_null(history);
    return history;
}

static float depths[PIXELS];

static DipHistoryWork add(DipHistory *history, const Picture from, DipHistoryStep step,
                          const float to_before[12], Picture to) {
    DipHistoryPicture picture = {.rgba8 = from,
                                 .stride_bytes = (size_t)WIDTH * 4,
                                 .depths = depths,
                                 .depths_width = WIDTH,
                                 .depths_height = HEIGHT,
                                 .step = step};
    if (to_before) {
        memcpy(picture.to_before, to_before, sizeof picture.to_before);
    }
    return dip_history_add(history, &picture, to, (size_t)WIDTH * 4);
}

// --- at rest -------------------------------------------------------------------------------------

static void at_rest_the_result_is_the_mean_of_all_pictures(void **state) {
    (void)state;
    static double sums[PIXELS * 4];
    static Picture from, to, before;
    DipHistory *history = make(dip_isa_best(), NULL);
    for (int n = 1; n <= DIP_HISTORY_PICTURES + 3; n++) {
        fill(from);
        memcpy(before, to, sizeof to);
        const DipHistoryWork work =
            add(history, from, n == 1 ? DIP_HISTORY_BEGIN : DIP_HISTORY_REST, NULL, to);
        if (n > DIP_HISTORY_PICTURES) {
            assert_int_equal(0, work.pixels_filtered);
            assert_memory_equal(before, to, sizeof to);
            continue;
        }
        assert_int_equal(PIXELS, work.pixels_filtered);
        for (int i = 0; i < PIXELS * 4; i++) {
            sums[i] += light_of(from[i]);
            if (i % 4 == 3) {
                assert_int_equal(from[i], to[i]);
            } else {
                assert_int_equal(code_of(sums[i] / n), to[i]);
            }
        }
    }
    dip_history_destroy(&history);
}

static void a_blended_picture_stays_until_the_mean_is_better(void **state) {
    (void)state;
    static const float still[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    static double sums[PIXELS * 4];
    static Picture from, to, before;
    memset(sums, 0, sizeof sums);
    DipHistory *history = make(dip_isa_best(), NULL);
    fill(from);
    add(history, from, DIP_HISTORY_BEGIN, NULL, to);
    fill(from);
    assert_int_equal(PIXELS, add(history, from, DIP_HISTORY_MOVE, still, to).pixels_reprojected);
    memcpy(before, to, sizeof to);
    for (int n = 1; n <= DIP_HISTORY_HELD; n++) {
        fill(from);
        for (int i = 0; i < PIXELS * 4; i++) {
            sums[i] += light_of(from[i]);
        }
        add(history, from, DIP_HISTORY_REST, NULL, to);
        assert_true((memcmp(before, to, sizeof to) == 0) == (n < DIP_HISTORY_HELD));
    }
    for (int i = 0; i < PIXELS * 4; i++) {
        if (i % 4 != 3) {
            assert_int_equal(code_of(sums[i] / DIP_HISTORY_HELD), to[i]);
        }
    }
    dip_history_destroy(&history);
}

// --- while the camera moves ----------------------------------------------------------------------

static const double near_m = 0.1;

static DipView view_of(double x, double y, double turn) {
    const DipPose pose = {.position_world = {x, y, 0.0},
                          .orientation = {0.3 * turn, turn, 0.1 * turn, 1.0},
                          .fov_y_deg = 55.0};
    return dip_view_make(&pose, near_m, (double)WIDTH / HEIGHT);
}

// Intersects the ray through the centre of a pixel with the plane z + x / 4 = -5. Returns w, the
// distance along the view, and the point.
static double hit(const DipView *view, int x, int y, double point[3]) {
    const double across = ((2 * x + 1) / (double)WIDTH - 1.0) / view->scale[0];
    const double up = (1.0 - (2 * y + 1) / (double)HEIGHT) / view->scale[1];
    double ray[3];
    for (int i = 0; i < 3; i++) {
        ray[i] = across * view->axis[0][i] + up * view->axis[1][i] - view->axis[2][i];
    }
    const double w = (-5.0 - view->eye[2] - view->eye[0] / 4) / (ray[2] + ray[0] / 4);
    for (int i = 0; i < 3; i++) {
        point[i] = view->eye[i] + w * ray[i];
    }
    return w;
}

// Returns where a view shows a point, in pixels from the centre of the first pixel.
static void project(const DipView *view, const double point[3], double at[2]) {
    double camera[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            camera[i] += view->axis[i][k] * (point[k] - view->eye[k]);
        }
    }
    at[0] = (view->scale[0] * camera[0] / -camera[2] + 1.0) * 0.5 * WIDTH - 0.5;
    at[1] = (1.0 - view->scale[1] * camera[1] / -camera[2]) * 0.5 * HEIGHT - 0.5;
}

static int clamp(int v, int count) {
    return v < 0 ? 0 : v >= count ? count - 1 : v;
}

typedef struct Colour {
    double c[3]; // y, co, cg
} Colour;

static Colour ycocg_at(const Picture p, int x, int y) {
    const uint8_t *rgb = p + 4 * (clamp(y, HEIGHT) * WIDTH + clamp(x, WIDTH));
    const double r = light_of(rgb[0]), g = light_of(rgb[1]), b = light_of(rgb[2]);
    return (Colour){{r / 4 + g / 2 + b / 4, (r - b) / 2, g / 2 - (r + b) / 4}};
}

// Catmull-Rom by its definition as a cubic Hermite spline.
static double spline(double a, double b, double c, double d, double t) {
    const double t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * b + (t3 - 2 * t2 + t) * (c - a) / 2 + (3 * t2 - 2 * t3) * c +
           (t3 - t2) * (d - b) / 2;
}

static Colour sample(const Picture p, const double at[2]) {
    const int x = (int)floor(at[0]), y = (int)floor(at[1]);
    Colour out;
    for (int c = 0; c < 3; c++) {
        double lines[4];
        for (int j = 0; j < 4; j++) {
            double v[4];
            for (int i = 0; i < 4; i++) {
                v[i] = ycocg_at(p, x - 1 + i, y - 1 + j).c[c];
            }
            lines[j] = spline(v[0], v[1], v[2], v[3], at[0] - x);
        }
        out.c[c] = spline(lines[0], lines[1], lines[2], lines[3], at[1] - y);
    }
    return out;
}

// Limits a past to the nine new pixels around pixel (x, y), and blends the new pixel with it.
static Colour blended(const Picture fresh, int x, int y, Colour past, double share) {
    Colour out = ycocg_at(fresh, x, y);
    double sums[3] = {0}, squares[3] = {0}, farthest = 1.0;
    for (int i = 0; i < 9; i++) {
        const Colour v = ycocg_at(fresh, x + i % 3 - 1, y + i / 3 - 1);
        for (int c = 0; c < 3; c++) {
            sums[c] += v.c[c];
            squares[c] += v.c[c] * v.c[c];
        }
    }
    for (int c = 0; c < 3; c++) {
        const double mean = sums[c] / 9;
        const double deviation = sqrt(fmax(squares[c] / 9 - mean * mean, 0.0));
        farthest = fmax(farthest, fabs(past.c[c] - mean) / fmax(deviation, 0.0625));
    }
    for (int c = 0; c < 3; c++) {
        const double limited = sums[c] / 9 + (past.c[c] - sums[c] / 9) / farthest;
        out.c[c] = limited + (out.c[c] - limited) * share;
    }
    return out;
}

static void to_rgb(Colour v, double rgb[3]) {
    rgb[0] = v.c[0] + v.c[1] - v.c[2];
    rgb[1] = v.c[0] + v.c[2];
    rgb[2] = v.c[0] - v.c[1] - v.c[2];
}

// Blends pixel (x, y) of the new picture with the old one, which is the whole history.
static void model(const Picture fresh, const Picture old, const DipView *now, const DipView *before,
                  int x, int y, double rgb[3], bool *has_past) {
    int nx = x, ny = y;
    for (int i = 0; i < 9; i++) {
        const int ox = clamp(x + i % 3 - 1, WIDTH), oy = clamp(y + i / 3 - 1, HEIGHT);
        if (depths[oy * WIDTH + ox] > depths[ny * WIDTH + nx]) {
            nx = ox;
            ny = oy;
        }
    }
    double point[3], at[2];
    hit(now, nx, ny, point);
    project(before, point, at);
    at[0] += x - nx;
    at[1] += y - ny;
    *has_past = at[0] > -0.5 && at[1] > -0.5 && at[0] < WIDTH - 0.5 && at[1] < HEIGHT - 0.5;
    to_rgb(*has_past ? blended(fresh, x, y, sample(old, at), 0.5) : ycocg_at(fresh, x, y), rgb);
}

static bool is_outer(int x, int y) {
    return x == 0 || y == 0 || x == WIDTH - 1 || y == HEIGHT - 1;
}

// At the border, the nearest depth may belong to a pixel that is repeated outside, so the model
// leaves it out.
static void check_move(DipView now, DipView before) {
    static Picture old, fresh, to;
    float to_before[12];
    uint64_t with_past = 0;
    DipHistory *history = make(dip_isa_best(), NULL);
    fill(old);
    fill(fresh);
    for (int i = 0; i < PIXELS; i++) {
        double point[3];
        depths[i] = (float)(near_m / hit(&now, i % WIDTH, i / WIDTH, point));
    }
    dip_view_motion(&now, &before, to_before);
    add(history, old, DIP_HISTORY_BEGIN, NULL, to);
    assert_memory_equal(old, to, sizeof to);
    const DipHistoryWork work = add(history, fresh, DIP_HISTORY_MOVE, to_before, to);
    for (int i = 0; i < PIXELS; i++) {
        double rgb[3];
        bool has_past;
        model(fresh, old, &now, &before, i % WIDTH, i / WIDTH, rgb, &has_past);
        with_past += has_past;
        for (int c = 0; c < 3 && !is_outer(i % WIDTH, i / WIDTH); c++) {
            // Rounding the place in floats moves noise by some units of 65535.
            const double light = fmin(fmax(rgb[c], 0.0), 65535.0);
            assert_in_range(to[4 * i + c], code_of(fmax(light - 40, 0)),
                            code_of(fmin(light + 40, 65535)));
        }
    }
    assert_true(llabs((long long)with_past - (long long)work.pixels_reprojected) < 40);
    assert_true(with_past > PIXELS / 2);
    dip_history_destroy(&history);
}

static void the_past_lies_where_the_cameras_saw_it(void **state) {
    (void)state;
    check_move(view_of(0.0, 0.0, 0.0), view_of(0.0, 0.0, 0.0));
    check_move(view_of(0.3, 0.0, 0.0), view_of(0.0, 0.0, 0.0));
    check_move(view_of(-0.2, 0.4, 0.03), view_of(0.0, 0.1, -0.02));
    check_move(view_of(0.0, 0.0, 0.1), view_of(0.5, 0.0, 0.08));
}

// The n-th picture of a history has the share 1/n, and at least a fifth. The camera stands still,
// so that the past of a pixel lies at the pixel; the scene moves.
static void a_new_picture_has_at_least_a_fifth(void **state) {
    (void)state;
    static const float still[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    static Colour past[PIXELS];
    static Picture fresh, to;
    DipHistory *history = make(dip_isa_best(), NULL);
    for (int n = 1; n <= 9; n++) {
        fill(fresh);
        add(history, fresh, n == 1 ? DIP_HISTORY_BEGIN : DIP_HISTORY_MOVE, still, to);
        for (int i = 0; i < PIXELS; i++) {
            const int x = i % WIDTH, y = i / WIDTH;
            double rgb[3];
            past[i] =
                n == 1 ? ycocg_at(fresh, x, y) : blended(fresh, x, y, past[i], fmax(1.0 / n, 0.2));
            to_rgb(past[i], rgb);
            for (int c = 0; c < 3; c++) {
                const double light = fmin(fmax(rgb[c], 0.0), 65535.0);
                assert_in_range(to[4 * i + c], code_of(fmax(light - 40, 0)),
                                code_of(fmin(light + 40, 65535)));
            }
        }
    }
    dip_history_destroy(&history);
}

static void the_result_does_not_depend_on_threads_and_instruction_sets(void **state) {
    (void)state;
    static Picture from[6], first[6], to;
    for (int i = 0; i < 6; i++) {
        fill(from[i]);
    }
    DipPool *pools[2] = {NULL, dip_pool_create(3, NULL)};
    bool has_first = false;
    for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
        for (int p = 0; p < 2 && dip_isa_available((DipIsa)isa); p++) {
            DipHistory *history = make((DipIsa)isa, pools[p]);
            for (int i = 0; i < 6; i++) {
                const DipView now = view_of(0.05 * i, 0.0, 0.01 * i);
                const DipView before = view_of(0.05 * i - 0.05, 0.0, 0.01 * i - 0.01);
                float to_before[12];
                dip_view_motion(&now, &before, to_before);
                add(history, from[i],
                    i == 0   ? DIP_HISTORY_BEGIN
                    : i == 4 ? DIP_HISTORY_REST
                             : DIP_HISTORY_MOVE,
                    to_before, to);
                if (!has_first) {
                    memcpy(first[i], to, sizeof to);
                }
                assert_memory_equal(first[i], to, sizeof to);
            }
            has_first = true;
            dip_history_destroy(&history);
        }
    }
    dip_pool_destroy(&pools[1]);
}

static void what_no_history_can_have_is_refused(void **state) {
    (void)state;
    DipError err;
    const DipHistoryDef none = {0, 10, dip_isa_best(), NULL};
    assert_null(dip_history_create(&none, &err));
    assert_int_equal(DIP_ERROR_RANGE, err.code);
    const DipHistoryDef unknown = {10, 10, DIP_ISA_COUNT, NULL};
    assert_null(dip_history_create(&unknown, &err));
    assert_int_equal(DIP_ERROR_UNSUPPORTED, err.code);
}

// --- frames --------------------------------------------------------------------------------------

static DipTestScene test_scene;
static DipScene *scene;

static int set_up(void **state) {
    (void)state;
    dip_test_scene_make(&test_scene, DIP_TEST_SCENE_fence);
    scene = dip_scene_create(&test_scene.def, NULL, NULL);
    return scene ? 0 : 1;
}

static int tear_down(void **state) {
    (void)state;
    dip_scene_destroy(&scene);
    dip_test_scene_free(&test_scene);
    return 0;
}

static DipRenderer *renderer_with(const char *settings, DipPool *pool, DipIsa isa) {
    DipRendererDef def = stage_def(WIDTH, HEIGHT, settings);
    def.pool = pool;
    def.isa = isa;
    return stage_make_renderer(&def);
}

// Draws a frame of a camera that moves with `index` unless it is at rest.
static DipFrame draw(DipRenderer *renderer, int index, bool rests, char hash[33]) {
    DipPose pose = test_scene.pose;
    DipFrame frame;
    pose.position_world[0] += rests ? 0.0 : 0.02 * index;
    dip_renderer_set_frame_index(renderer, (uint64_t)index);
    assert_true(dip_renderer_draw(renderer, scene, &pose, index, &frame, NULL));
    if (hash) {
        dip_frame_hash(&frame, hash);
    }
    return frame;
}

// The hash of a frame that begins a history.
static void first_hash(int index, const char *settings, char hash[33]) {
    DipRenderer *renderer = renderer_with(settings, NULL, dip_isa_best());
    const DipFrame frame = draw(renderer, index, false, hash);
    assert_int_equal(0, frame.counters.pixels_reprojected);
    dip_renderer_destroy(&renderer);
}

static void histories_begin_anew_where_frames_do_not_follow(void **state) {
    (void)state;
    char hash[33], expected[33];
    DipQuality quality;
    DipRenderer *renderer = renderer_with("taa=history", NULL, dip_isa_best());
    draw(renderer, 3, false, NULL);
    assert_true(draw(renderer, 4, false, hash).counters.pixels_reprojected > PIXELS / 2);
    first_hash(4, "taa=history", expected);
    assert_string_not_equal(expected, hash);
    dip_renderer_cut(renderer); // a cut
    draw(renderer, 5, false, hash);
    first_hash(5, "taa=history", expected);
    assert_string_equal(expected, hash);
    draw(renderer, 7, false, hash); // a gap
    first_hash(7, "taa=history", expected);
    assert_string_equal(expected, hash);
    draw(renderer, 7, false, hash); // the same frame once more
    assert_string_equal(expected, hash);
    assert_true(dip_quality_parse("taa=history,af=8", &quality, NULL));
    assert_true(dip_renderer_set_quality(renderer, &quality, NULL));
    draw(renderer, 8, false, hash); // other settings
    first_hash(8, "taa=history,af=8", expected);
    assert_string_equal(expected, hash);
    assert_true(dip_renderer_resize(renderer, 40, 30, NULL));
    assert_int_equal(0, draw(renderer, 9, false, NULL).counters.pixels_reprojected);
    dip_renderer_destroy(&renderer);
}

static void a_frame_alone_is_the_frame_after_others(void **state) {
    (void)state;
    char hash[33], alone[33];
    DipRenderer *renderer = renderer_with("taa=history,scale=1.5,post=smaa", NULL, dip_isa_best());
    for (int i = 0; i < 30; i++) {
        draw(renderer, i, false, NULL);
    }
    dip_renderer_cut(renderer);
    for (int i = 30 - DIP_FRAMES_BEFORE; i <= 30; i++) {
        draw(renderer, i, false, hash);
    }
    dip_renderer_destroy(&renderer);
    renderer = renderer_with("taa=history,scale=1.5,post=smaa", NULL, dip_isa_best());
    for (int i = 30 - DIP_FRAMES_BEFORE; i <= 30; i++) {
        draw(renderer, i, false, alone);
    }
    assert_string_equal(alone, hash);
    dip_renderer_destroy(&renderer);
}

// Each frame of a history is shifted, so a pane beside it cannot share its geometry.
static void a_history_beside_another_pane_is_the_frame_alone(void **state) {
    (void)state;
    static const char *const settings[2] = {"taa=history", "aa=none"};
    DipRenderer *alone[2], *together[2];
    DipFrame frames[2];
    DipFrame *const panes[2] = {&frames[0], &frames[1]};
    for (int order = 0; order < 2; order++) {
        for (int p = 0; p < 2; p++) {
            alone[p] = renderer_with(settings[p ^ order], NULL, dip_isa_best());
            together[p] = renderer_with(settings[p ^ order], NULL, dip_isa_best());
        }
        for (int i = 0; i < 4; i++) {
            DipPose pose = test_scene.pose;
            pose.position_world[0] += 0.02 * i;
            for (int p = 0; p < 2; p++) {
                dip_renderer_set_frame_index(together[p], (uint64_t)i);
            }
            assert_true(dip_renderer_draw_frames(together, 2, scene, &pose, i, panes, NULL));
            for (int p = 0; p < 2; p++) {
                char expected[33], hash[33];
                draw(alone[p], i, false, expected);
                dip_frame_hash(&frames[p], hash);
                assert_string_equal(hash, expected);
            }
        }
        for (int p = 0; p < 2; p++) {
            dip_renderer_destroy(&alone[p]);
            dip_renderer_destroy(&together[p]);
        }
    }
}

static void frames_at_rest_are_the_mean_of_the_shifted_frames(void **state) {
    (void)state;
    static double sums[PIXELS * 3];
    memset(sums, 0, sizeof sums);
    DipRenderer *renderer = renderer_with("taa=history", NULL, dip_isa_best());
    for (int n = 0; n < DIP_HISTORY_PICTURES; n++) {
        dip_renderer_cut(renderer);
        const DipFrame frame = draw(renderer, n, true, NULL);
        for (int i = 0; i < PIXELS; i++) {
            const uint8_t *rgb =
                frame.rgba8 + (size_t)(i / WIDTH) * frame.stride_bytes + 4 * (i % WIDTH);
            for (int c = 0; c < 3; c++) {
                sums[3 * i + c] += light_of(rgb[c]);
            }
        }
    }
    dip_renderer_cut(renderer);
    DipFrame frame = {0};
    for (int n = 0; n < DIP_HISTORY_PICTURES + 2; n++) {
        frame = draw(renderer, n, true, NULL);
    }
    for (int i = 0; i < PIXELS; i++) {
        const uint8_t *rgb =
            frame.rgba8 + (size_t)(i / WIDTH) * frame.stride_bytes + 4 * (i % WIDTH);
        for (int c = 0; c < 3; c++) {
            assert_int_equal(code_of(sums[3 * i + c] / DIP_HISTORY_PICTURES), rgb[c]);
        }
    }
    dip_renderer_destroy(&renderer);
}

static void settings_without_a_history_take_no_memory_for_it(void **state) {
    (void)state;
    DipQuality quality;
    DipRenderer *renderer = renderer_with("taa=alternate,aa=4", NULL, dip_isa_best());
    DipFrame frame = draw(renderer, 0, false, NULL);
    assert_int_equal(0, frame.counters.history_bytes);
    assert_false(frame.effects.history.run);
    assert_true(dip_quality_parse("taa=history", &quality, NULL));
    assert_true(dip_renderer_set_quality(renderer, &quality, NULL));
    frame = draw(renderer, 1, false, NULL);
    assert_true(frame.counters.history_bytes > PIXELS * (6 * 4 + 4 + 4));
    assert_true(frame.effects.history.run);
    assert_int_equal(PIXELS, frame.counters.pixels_filtered);
    quality = dip_quality_default();
    assert_true(dip_renderer_set_quality(renderer, &quality, NULL));
    frame = draw(renderer, 2, false, NULL);
    assert_int_equal(0, frame.counters.history_bytes);
    assert_int_equal(0, frame.counters.pixels_filtered);
    dip_renderer_destroy(&renderer);
}

static void frames_do_not_depend_on_threads_and_instruction_sets(void **state) {
    (void)state;
    char first[33] = "";
    DipPool *pools[2] = {NULL, dip_pool_create(3, NULL)};
    for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
        for (int p = 0; p < 2 && dip_isa_available((DipIsa)isa); p++) {
            char hash[33];
            DipRenderer *renderer = renderer_with("taa=history,scale=1/1.5", pools[p], (DipIsa)isa);
            for (int i = 0; i < 5; i++) {
                draw(renderer, i, false, hash);
            }
            memcpy(first, first[0] ? first : hash, sizeof first);
            assert_string_equal(first, hash);
            dip_renderer_destroy(&renderer);
        }
    }
    dip_pool_destroy(&pools[1]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(at_rest_the_result_is_the_mean_of_all_pictures),
        cmocka_unit_test(a_blended_picture_stays_until_the_mean_is_better),
        cmocka_unit_test(the_past_lies_where_the_cameras_saw_it),
        cmocka_unit_test(a_new_picture_has_at_least_a_fifth),
        cmocka_unit_test(the_result_does_not_depend_on_threads_and_instruction_sets),
        cmocka_unit_test(what_no_history_can_have_is_refused),
        cmocka_unit_test(histories_begin_anew_where_frames_do_not_follow),
        cmocka_unit_test(a_frame_alone_is_the_frame_after_others),
        cmocka_unit_test(a_history_beside_another_pane_is_the_frame_alone),
        cmocka_unit_test(frames_at_rest_are_the_mean_of_the_shifted_frames),
        cmocka_unit_test(settings_without_a_history_take_no_memory_for_it),
        cmocka_unit_test(frames_do_not_depend_on_threads_and_instruction_sets),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
