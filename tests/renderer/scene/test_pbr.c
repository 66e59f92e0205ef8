// Tests metallic-roughness surfaces: balls against the BRDF itself, which this file samples with
// hundreds of directions per pixel; every part against the reference renderer; that absent parts
// cost nothing, that the plan names the parts, and that the tables are the same on every machine.
#include "author_scenes.h"
#include "stage.h"
#include "vec.h"

#include "renderer/scene/materials/pbr.h"
#include "tests/support/srgb.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 320, HEIGHT = 240 };

static AuthorScene scene;

static Stage open_stage_with(DipIsa isa, int threads, bool plain, const char *settings) {
    DipRendererDef def = stage_def(WIDTH, HEIGHT, settings);
    def.isa = isa;
    def.plain_surfaces = plain;
    return stage_open(&scene.def, def, threads);
}

static Stage open_stage(const char *settings) {
    return open_stage_with(dip_isa_best(), 1, false, settings);
}

static DipFrame draw(const Stage *stage) {
    return stage_draw(stage, &scene.pose, 0);
}

// --- the BRDF, sampled ---------------------------------------------------------------------------

enum { SAMPLES = 256 };

static double clamp01(double x) {
    return fmin(fmax(x, 0.0), 1.0);
}

// A point of a Hammersley set, as a radius and an angle.
typedef struct Point {
    double u;
    double root; // of u
    double cosine, sine;
} Point;

static Point points[SAMPLES];

static void make_points(void) {
    for (int i = 0; i < SAMPLES; i++) {
        double w = 0.5 / SAMPLES;
        for (int bit = 0; bit < 8; bit++) {
            w += (i >> bit & 1) * pow(0.5, bit + 1);
        }
        const double u = (i + 0.5) / SAMPLES, phi = 2.0 * acos(-1.0) * w;
        points[i] = (Point){u, sqrt(u), cos(phi), sin(phi)};
    }
}

static void make_basis(const Vec n, Vec t, Vec b) {
    const Vec up = {fabs(n[0]) < 0.7 ? 1.0 : 0.0, fabs(n[0]) < 0.7 ? 0.0 : 1.0, 0.0};
    for (int i = 0; i < 3; i++) {
        t[i] = up[i] - dot(up, n) * n[i];
    }
    unit(t);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        b[i] = n[j] * t[k] - n[k] * t[j];
    }
}

static double lambda(double cosine, double alpha) {
    const double tangent2 = (1.0 - cosine * cosine) / fmax(cosine * cosine, 1e-12);
    return (sqrt(1.0 + alpha * alpha * tangent2) - 1.0) / 2.0;
}

// A visible half vector in tangent space, by projected hemispheres (Heitz 2018).
static void sample_half(const Vec v, double alpha, const Point *point, Vec h) {
    Vec s = {alpha * v[0], alpha * v[1], v[2]};
    unit(s);
    Vec t1 = {1.0, 0.0, 0.0};
    if (s[0] * s[0] + s[1] * s[1] > 1e-12) {
        t1[0] = -s[1] / sqrt(s[0] * s[0] + s[1] * s[1]);
        t1[1] = s[0] / sqrt(s[0] * s[0] + s[1] * s[1]);
    }
    const Vec t2 = {-s[2] * t1[1], s[2] * t1[0], s[0] * t1[1] - s[1] * t1[0]};
    const double p1 = point->root * point->cosine, lift = 0.5 * (1.0 + s[2]);
    const double p2 =
        (1.0 - lift) * sqrt(clamp01(1.0 - p1 * p1)) + lift * point->root * point->sine;
    const double p3 = sqrt(clamp01(1.0 - p1 * p1 - p2 * p2));
    for (int i = 0; i < 3; i++) {
        h[i] = (i < 2 ? alpha : 1.0) * (p1 * t1[i] + p2 * t2[i] + p3 * s[i]);
    }
    unit(h);
}

static double radiance(double height) {
    return 0.35 + 0.225 * height;
}

// A ball's material at a point, with its normal and the direction to the eye.
typedef struct Spot {
    Vec n, v;
    float metallic, roughness;
} Spot;

static double schlick(double f0, double v_h) {
    const double x = 1.0 - clamp01(v_h);
    return f0 + (1.0 - f0) * (x * x * x * x * x);
}

// Returns the share that a white lobe keeps, by the same samples.
static double white_share(const Vec view, double alpha) {
    double sum = 0.0;
    for (int i = 0; i < SAMPLES; i++) {
        Vec h;
        sample_half(view, alpha, &points[i], h);
        const double light = 2.0 * dot(view, h) * h[2] - view[2];
        const double seen = 1.0 + lambda(view[2], alpha);
        sum += light > 0.0 ? seen / (seen + lambda(light, alpha)) : 0.0;
    }
    return sum / SAMPLES;
}

// Adds the light of the surroundings: the lobe by visible normals, the diffuse light by cosines.
static void add_surroundings(const Spot *spot, double share, Vec rgb) {
    const double alpha = fmax(1e-4, (double)spot->roughness * spot->roughness);
    Vec t, b;
    make_basis(spot->n, t, b);
    const Vec view = {dot(spot->v, t), dot(spot->v, b), dot(spot->v, spot->n)};
    for (int i = 0; i < SAMPLES; i++) {
        Vec h;
        sample_half(view, alpha, &points[i], h);
        const double v_h = dot(view, h);
        const Vec l = {2.0 * v_h * h[0] - view[0], 2.0 * v_h * h[1] - view[1],
                       2.0 * v_h * h[2] - view[2]};
        const double seen = 1.0 + lambda(view[2], alpha);
        const double g = l[2] > 0.0 ? seen / (seen + lambda(l[2], alpha)) : 0.0;
        const double mirrored = g * radiance(l[0] * t[1] + l[1] * b[1] + l[2] * spot->n[1]);
        const Vec d = {points[i].root * points[i].cosine, points[i].root * points[i].sine,
                       sqrt(1.0 - points[i].u)};
        const double half = sqrt((1.0 + dot(view, d)) / 2.0);
        const double soft =
            (1.0 - schlick(0.04, half)) * radiance(d[0] * t[1] + d[1] * b[1] + d[2] * spot->n[1]);
        for (int c = 0; c < 3; c++) {
            const double base = author_gold_lin[c], m = spot->metallic;
            const double f0 = 0.04 * (1.0 - m) + base * m;
            const double gain = 1.0 + f0 * (1.0 / share - 1.0);
            rgb[c] += (schlick(f0, v_h) * gain * mirrored + base * (1.0 - m) * soft) / SAMPLES;
        }
    }
}

// Adds the sun of the fixed light, whose lobe is at least 0.1 wide.
static void add_sun(const Spot *spot, double share, Vec rgb) {
    Vec sun = {-0.42, 0.67, 0.61};
    unit(sun);
    const double n_l = dot(spot->n, sun);
    if (n_l <= 0.0) {
        return;
    }
    Vec h = {spot->v[0] + sun[0], spot->v[1] + sun[1], spot->v[2] + sun[2]};
    unit(h);
    const double pi = acos(-1.0);
    const double a = fmax(0.1, (double)spot->roughness * spot->roughness);
    const double n_v = dot(spot->n, spot->v), n_h = dot(spot->n, h), v_h = dot(spot->v, h);
    const double d = a * a / (pi * pow(n_h * n_h * (a * a - 1.0) + 1.0, 2.0));
    const double g2 = 1.0 / (1.0 + lambda(n_l, a) + lambda(n_v, a));
    for (int c = 0; c < 3; c++) {
        const double base = author_gold_lin[c], m = spot->metallic;
        const double f0 = 0.04 * (1.0 - m) + base * m;
        const double gain = 1.0 + f0 * (1.0 / share - 1.0);
        const double specular = schlick(f0, v_h) * gain * d * g2 / (4.0 * n_l * n_v);
        const double diffuse = (1.0 - schlick(0.04, v_h)) * base * (1.0 - m) / pi;
        rgb[c] += pi * 0.65 * n_l * (specular + diffuse);
    }
}

// Finds the ball that the centre of a pixel shows. Returns its number, or -1 if it shows none or
// shows it nearly from the side.
static int find_ball(int x, int y, Spot *spot) {
    const double slope = tan(18.0 * acos(-1.0) / 180.0);
    Vec ray = {((x + 0.5) / WIDTH * 2.0 - 1.0) * slope * WIDTH / HEIGHT,
               (1.0 - (y + 0.5) / HEIGHT * 2.0) * slope, -1.0};
    unit(ray);
    for (int i = 0; i < AUTHOR_BALL_ROWS * AUTHOR_BALL_COLUMNS; i++) {
        Vec centre;
        author_ball(i / AUTHOR_BALL_COLUMNS, i % AUTHOR_BALL_COLUMNS, centre, &spot->metallic,
                    &spot->roughness);
        const Vec from = {-centre[0], -centre[1], 8.0 - centre[2]};
        const double along = dot(ray, from);
        const double root2 = along * along - dot(from, from) + 0.45 * 0.45;
        if (root2 <= 0.0) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            spot->n[k] = (from[k] + ray[k] * (-along - sqrt(root2))) / 0.45;
            spot->v[k] = -ray[k];
        }
        return dot(spot->n, spot->v) > 0.15 ? i : -1;
    }
    return -1;
}

static double encode(double x) {
    return floor(255.0 * srgb_encode(clamp01(x)) + 0.5);
}

typedef struct Errors {
    double squares;
    int count;
} Errors;

static double psnr_db(const Errors *errors) {
    return 10.0 * log10(255.0 * 255.0 * errors->count / fmax(errors->squares, 1e-9));
}

// What a pixel shows, and the light of the surroundings there.
typedef struct Pixel {
    int ball; // or -1
    Spot spot;
    double share;
    Vec surroundings;
} Pixel;

static Pixel pixels[WIDTH * HEIGHT];

// The tests with and without the sun have the same surroundings.
static int sum_surroundings(void **state) {
    (void)state;
    make_points();
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        Pixel *pixel = &pixels[i];
        const Spot *spot = &pixel->spot;
        pixel->ball = find_ball(i % WIDTH, i / WIDTH, &pixel->spot);
        if (pixel->ball >= 0) {
            Vec t, b;
            make_basis(spot->n, t, b);
            const Vec view = {dot(spot->v, t), dot(spot->v, b), dot(spot->v, spot->n)};
            pixel->share = white_share(view, fmax(1e-4, (double)spot->roughness * spot->roughness));
            add_surroundings(spot, pixel->share, pixel->surroundings);
        }
    }
    return 0;
}

static void add_pixel(const DipFrame *frame, int x, int y, bool sun, Errors *all, Errors *balls) {
    const Pixel *pixel = &pixels[y * WIDTH + x];
    if (pixel->ball < 0) {
        return;
    }
    Vec rgb;
    memcpy(rgb, pixel->surroundings, sizeof rgb);
    if (sun) {
        add_sun(&pixel->spot, pixel->share, rgb);
    }
    const uint8_t *codes = dip_image_pixel(frame, x, y);
    for (int c = 0; c < 3; c++) {
        const double error = encode(rgb[c]) - codes[c];
        all->squares += error * error;
        all->count++;
        balls[pixel->ball].squares += error * error;
        balls[pixel->ball].count++;
    }
}

static void check_balls(bool sun) {
    author_make_balls(&scene);
    scene.lighting.ambient_lin[0] = scene.lighting.ambient_lin[1] = 0.35f;
    scene.lighting.ambient_lin[2] = 0.35f;
    scene.lighting.sky_lin[0] = scene.lighting.sky_lin[1] = scene.lighting.sky_lin[2] = 0.15f;
    scene.def.lighting = sun ? NULL : &scene.lighting;
    Stage stage = open_stage("aa=none");
    const DipFrame frame = draw(&stage);
    Errors all = {0};
    Errors balls[AUTHOR_BALL_ROWS * AUTHOR_BALL_COLUMNS] = {{0}};
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        add_pixel(&frame, i % WIDTH, i / WIDTH, sun, &all, balls);
    }
    printf("%s: %.1f dB in all\n", sun ? "fixed light" : "surroundings", psnr_db(&all));
    for (int i = 0; i < AUTHOR_BALL_ROWS * AUTHOR_BALL_COLUMNS; i++) {
        printf("%5.1f%s", psnr_db(&balls[i]), i % AUTHOR_BALL_COLUMNS == 5 ? "\n" : " ");
        assert_true(balls[i].count > 1000);
        assert_true(psnr_db(&balls[i]) >= 36.0);
    }
    assert_true(psnr_db(&all) >= 42.0);
    stage_close(&stage);
    author_free(&scene);
}

static void balls_reflect_their_surroundings_as_the_sampled_brdf_does(void **state) {
    (void)state;
    check_balls(false);
}

static void balls_reflect_the_fixed_light_as_the_sampled_brdf_does(void **state) {
    (void)state;
    check_balls(true);
}

// --- the tables ----------------------------------------------------------------------------------

// A golden value: gcc and clang, with and without optimisation, and every machine must make it.
static void tables_have_the_same_bits_everywhere(void **state) {
    (void)state;
    const DipPbrTables *tables = dip_pbr_tables();
    uint64_t hash = 1469598103934665603u;
    for (size_t i = 0; i < sizeof *tables / sizeof(int32_t); i++) {
        int32_t entry;
        memcpy(&entry, (const char *)tables + i * sizeof entry, sizeof entry);
        hash = (hash ^ (uint32_t)entry) * 1099511628211u;
    }
    assert_int_equal(hash, UINT64_C(0x2112777be475de83));
}

// --- against the reference -----------------------------------------------------------------------

static void compare_with_reference(const char *name, const char *settings) {
    static const DipImageBounds bounds = {
        .rms_lin = 0.004, .pixel_lin = 0.02, .over_share = 0.002, .over_max_lin = 0.5};
    Stage stage = open_stage(settings);
    stage_compare(&stage, &scene.pose, name, settings, &bounds);
    stage_close(&stage);
}

static void all_parts_equal_the_reference(void **state) {
    (void)state;
    author_make_parts(&scene);
    compare_with_reference("pbr_parts", "aa=none");
    compare_with_reference("pbr_parts", "aa=4,af=8");
    scene.def.lighting = NULL;
    compare_with_reference("pbr_parts_fixed_light", "aa=2");
    author_free(&scene);
}

static void balls_equal_the_reference(void **state) {
    (void)state;
    author_make_balls(&scene);
    compare_with_reference("pbr_balls", "aa=4");
    author_free(&scene);
}

// Four balls whose normal maps have normals that lean by 60 degrees to all sides, so that their
// means are short: the lobe becomes as wide as it can, however rough the surface is by itself.
static void lobes_widen_up_to_a_limit_as_the_reference_does(void **state) {
    (void)state;
    enum { SIZE = 256 };
    author_begin(&scene);
    const int bumps = author_add_texture(&scene, SIZE, DIP_ENCODING_LINEAR);
    uint8_t *texels = author_texels(&scene, bumps);
    for (int i = 0; i < SIZE * SIZE; i++) {
        const int side = (i % 2) + 2 * (i / SIZE % 2);
        texels[4 * i] = (uint8_t)(side == 0 ? 238 : side == 3 ? 17 : 128);
        texels[4 * i + 1] = (uint8_t)(side == 1 ? 238 : side == 2 ? 17 : 128);
        texels[4 * i + 2] = 191;
    }
    for (int i = 0; i < 4; i++) {
        const int material = author_add_pbr(&scene, 1.0f, 0.3f * (float)i + 0.1f);
        scene.materials[material].normal_map = bumps;
        scene.pbrs[material].normal_scale = 1.0f;
        author_add_sphere(&scene, material, (float[3]){1.4f * (float)i - 2.1f, 0.0f, 0.0f}, 0.65f);
    }
    compare_with_reference("pbr_spread", "aa=none");
    author_free(&scene);
}

// Filtered texels of 1 can be an ulp above 1. A rough ball must not darken there.
static void a_white_map_leaves_the_roughness_as_it_is(void **state) {
    (void)state;
    author_make_balls(&scene);
    Stage stage = open_stage("aa=none");
    const DipFrame frame = draw(&stage);
    uint8_t *expected = malloc(frame.stride_bytes * (size_t)HEIGHT);
    assert_non_null(expected);
    memcpy(expected, frame.rgba8, frame.stride_bytes * (size_t)HEIGHT);
    stage_close(&stage);

    const int white = author_add_texture(&scene, 64, DIP_ENCODING_LINEAR);
    memset(author_texels(&scene, white), 255, (size_t)64 * 64 * 4);
    for (int i = 0; i < scene.def.material_count; i++) {
        scene.pbrs[i].metal_rough_map = white;
    }
    stage = open_stage("aa=none");
    const DipFrame mapped = draw(&stage);
    int greatest = 0;
    for (size_t i = 0; i < mapped.stride_bytes * (size_t)HEIGHT; i++) {
        const int difference = abs(mapped.rgba8[i] - expected[i]);
        greatest = difference > greatest ? difference : greatest;
    }
    assert_true(greatest <= 1);
    free(expected);
    stage_close(&stage);
    author_free(&scene);
}

// --- what is there and what is not ---------------------------------------------------------------

static void every_machine_and_thread_count_draws_the_same_bits(void **state) {
    (void)state;
    author_make_parts(&scene);
    char expected[33] = "";
    for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
        for (int threads = 1; threads <= 2 && dip_isa_available((DipIsa)isa); threads++) {
            Stage stage = open_stage_with((DipIsa)isa, threads, false, "aa=4");
            const DipFrame frame = draw(&stage);
            char hash[33];
            dip_frame_hash(&frame, hash);
            if (expected[0]) {
                assert_string_equal(hash, expected);
            }
            memcpy(expected, hash, sizeof expected);
            stage_close(&stage);
        }
    }
    author_free(&scene);
}

static void the_plan_names_the_parts_that_run(void **state) {
    (void)state;
    author_make_parts(&scene);
    Stage stage = open_stage("aa=none");
    const DipFrame frame = draw(&stage);
    assert_true(frame.effects.pbr.run && frame.effects.occlusion.run);
    assert_true(frame.effects.emission.run && frame.effects.coat.run);
    assert_true(frame.effects.normal_map.run && frame.effects.lights.run);
    assert_false(frame.effects.blend.run);
    assert_string_equal(frame.effects.blend.why, "the scene has no blended surface");
    assert_true(frame.counters.fragments_pbr > frame.counters.fragments_coated);
    assert_true(frame.counters.fragments_coated > 0);
    assert_true(frame.counters.fragments_emitting > 0);
    assert_true(frame.counters.fragments_occluded > 0);
    assert_true(frame.effects.sheen.run);
    assert_true(frame.counters.fragments_sheen > 0);
    assert_true(frame.counters.fragments_sheen < frame.counters.fragments_pbr);
    stage_close(&stage);
    author_free(&scene);
}

static void absent_parts_do_not_run(void **state) {
    (void)state;
    author_make_balls(&scene);
    Stage stage = open_stage("aa=none");
    const DipFrame frame = draw(&stage);
    assert_true(frame.effects.pbr.run);
    assert_false(frame.effects.occlusion.run || frame.effects.emission.run);
    assert_false(frame.effects.coat.run || frame.effects.normal_map.run);
    assert_string_equal(frame.effects.coat.why, "no metallic-roughness surface has a clear coat");
    assert_false(frame.effects.sheen.run);
    assert_string_equal(frame.effects.sheen.why, "no metallic-roughness surface has a sheen");
    assert_int_equal(frame.counters.fragments_pbr, frame.counters.fragments_shaded);
    assert_int_equal(frame.counters.texture_probes, 0);
    stage_close(&stage);
    author_free(&scene);
}

static void plain_surfaces_leave_the_reflection_out(void **state) {
    (void)state;
    author_make_balls(&scene);
    Stage plain = open_stage_with(dip_isa_best(), 1, true, "aa=none");
    char hashes[2][33];
    DipFrame frame = draw(&plain);
    assert_false(frame.effects.pbr.run);
    assert_int_equal(frame.counters.fragments_pbr, 0);
    dip_frame_hash(&frame, hashes[0]);
    stage_close(&plain);
    for (int i = 0; i < scene.def.material_count; i++) {
        scene.materials[i].pbr = NULL;
    }
    Stage without = open_stage("aa=none");
    frame = draw(&without);
    dip_frame_hash(&frame, hashes[1]);
    assert_string_equal(hashes[0], hashes[1]);
    stage_close(&without);
    author_free(&scene);
}

// An unlit surface shows its own colour, whatever its metallic-roughness description says.
static void unlit_surfaces_show_their_own_colour(void **state) {
    (void)state;
    author_begin(&scene);
    const int material = author_add_pbr(&scene, 1.0f, 0.1f);
    scene.materials[material].lit = false;
    author_add_quad(&scene, material, (const float[]){-9, -9, 0}, (const float[]){18, 0, 0},
                    (const float[]){0, 18, 0});
    Stage stage = open_stage("aa=none");
    const DipFrame frame = draw(&stage);
    assert_int_equal(dip_image_centre(&frame)[0], 255);
    assert_false(frame.effects.pbr.run);
    stage_close(&stage);
    author_free(&scene);
}

// Both sides of a double-sided sheet look alike where their surroundings are alike.
static void the_normal_turns_where_a_sheet_is_seen_from_behind(void **state) {
    (void)state;
    uint8_t seen[2];
    for (int side = 0; side < 2; side++) {
        author_begin(&scene);
        scene.lights[0] = (DipLightDef){.kind = DIP_LIGHT_DIRECTIONAL,
                                        .colour_lin = {0.5f, 0.5f, 0.5f},
                                        .direction_world = {0.0f, 0.0f, -1.0f}};
        scene.lighting.light_count = 1;
        scene.def.lighting = &scene.lighting;
        const int material = author_add_pbr(&scene, 0.0f, 0.5f);
        scene.materials[material].double_sided = true;
        const float width = side ? -18.0f : 18.0f;
        author_add_quad(&scene, material, (const float[]){-width / 2, -9, 0},
                        (const float[]){width, 0, 0}, (const float[]){0, 18, 0});
        Stage stage = open_stage("aa=none");
        const DipFrame frame = draw(&stage);
        seen[side] = dip_image_centre(&frame)[0];
        stage_close(&stage);
        author_free(&scene);
    }
    assert_true(seen[0] > 100);
    assert_int_equal(seen[0], seen[1]);
}

static void wrong_numbers_are_refused(void **state) {
    (void)state;
    static const struct {
        size_t offset;
        const char *key;
    } rows[] = {{offsetof(DipPbrDef, metallic), "metallic"},
                {offsetof(DipPbrDef, roughness), "roughness"},
                {offsetof(DipPbrDef, f0_lin), "f0_lin"},
                {offsetof(DipPbrDef, f90), "f90"},
                {offsetof(DipPbrDef, occlusion_strength), "occlusion_strength"},
                {offsetof(DipPbrDef, emission_lin), "emission_lin"},
                {offsetof(DipPbrDef, normal_scale), "normal_scale"},
                {offsetof(DipPbrDef, coat), "coat"},
                {offsetof(DipPbrDef, coat_roughness), "coat_roughness"},
                {offsetof(DipPbrDef, transmission), "pbr.transmission"},
                {offsetof(DipPbrDef, scattering), "scattering"},
                {offsetof(DipPbrDef, sheen_lin), "sheen_lin"},
                {offsetof(DipPbrDef, sheen_roughness), "sheen_roughness"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        DipError err = {0};
        author_make_balls(&scene);
        const float wrong = NAN;
        memcpy((char *)&scene.pbrs[3] + rows[i].offset, &wrong, sizeof wrong);
        assert_null(dip_scene_create(&scene.def, NULL, &err));
        assert_int_equal(err.code, DIP_ERROR_RANGE);
        assert_string_equal(err.key, rows[i].key);
        author_free(&scene);
    }
    DipError err = {0};
    author_make_balls(&scene);
    scene.pbrs[3].emission_map = 0;
    assert_null(dip_scene_create(&scene.def, NULL, &err));
    assert_string_equal(err.key, "emission_map");
    scene.pbrs[3].emission_map = DIP_NO_TEXTURE;
    scene.materials[3].opacity = 1.5f;
    assert_null(dip_scene_create(&scene.def, NULL, &err));
    assert_string_equal(err.key, "opacity");
    author_free(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(balls_reflect_their_surroundings_as_the_sampled_brdf_does),
        cmocka_unit_test(balls_reflect_the_fixed_light_as_the_sampled_brdf_does),
        cmocka_unit_test(tables_have_the_same_bits_everywhere),
        cmocka_unit_test(balls_equal_the_reference),
        cmocka_unit_test(a_white_map_leaves_the_roughness_as_it_is),
        cmocka_unit_test(all_parts_equal_the_reference),
        cmocka_unit_test(lobes_widen_up_to_a_limit_as_the_reference_does),
        cmocka_unit_test(every_machine_and_thread_count_draws_the_same_bits),
        cmocka_unit_test(the_plan_names_the_parts_that_run),
        cmocka_unit_test(absent_parts_do_not_run),
        cmocka_unit_test(plain_surfaces_leave_the_reflection_out),
        cmocka_unit_test(unlit_surfaces_show_their_own_colour),
        cmocka_unit_test(the_normal_turns_where_a_sheet_is_seen_from_behind),
        cmocka_unit_test(wrong_numbers_are_refused),
    };
    return cmocka_run_group_tests(tests, sum_surroundings, NULL);
}
