// Tests environments: the blurred map and the reference's sums against a sum over all texels,
// closed forms, and pictures of balls against the reference renderer.
#include "author_scenes.h"
#include "stage.h"

#include "renderer/base/isa.h"
#include "renderer/reference/internal/internal.h"
#include "renderer/reference/reference.h"
#include "renderer/scene/resources/environment.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 144, HEIGHT = 108, COLUMNS = 128, ROWS = 64 };

static const double pi = 3.14159265358979323846;

static AuthorScene scene;
static float texels[3 * COLUMNS * ROWS];
static const DipEnvironmentDef environment = {texels, COLUMNS, ROWS};

// Returns the direction of a point of the picture, in columns and rows.
static void direction_of(double column, double row, double direction[3]) {
    const double azimuth = 2.0 * pi * column / COLUMNS - pi;
    const double polar = pi * row / ROWS;
    direction[0] = sin(polar) * cos(azimuth);
    direction[1] = cos(polar);
    direction[2] = sin(polar) * sin(azimuth);
}

typedef void Light(const double direction[3], double rgb[3]);

static void fill(Light *light) {
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        double direction[3];
        double rgb[3];
        direction_of(i % COLUMNS + 0.5, i / COLUMNS + 0.5, direction);
        light(direction, rgb);
        for (int c = 0; c < 3; c++) {
            texels[3 * i + c] = (float)rgb[c];
        }
    }
}

// A room with a dark floor, a bright window towards +x and -z, and a red wall behind the eye.
static void room(const double d[3], double rgb[3]) {
    const double up = 0.5 + 0.5 * d[1];
    const double window = exp(
        -12.0 * ((d[0] - 0.7) * (d[0] - 0.7) + d[1] * d[1] * 0.5 + (d[2] + 0.7) * (d[2] + 0.7)));
    rgb[0] = 0.1 + 0.2 * up + 3.0 * window + 0.4 * fmax(0.0, d[2]);
    rgb[1] = 0.1 + 0.3 * up + 3.0 * window;
    rgb[2] = 0.1 + 0.5 * up + 2.5 * window;
}

static void even(const double d[3], double rgb[3]) {
    (void)d;
    rgb[0] = 0.2;
    rgb[1] = 0.4;
    rgb[2] = 0.6;
}

static void rising(const double d[3], double rgb[3]) {
    rgb[0] = rgb[1] = rgb[2] = 0.35 + 0.225 * d[1];
}

// --- a sum over all texels -----------------------------------------------------------------------

// Reads the picture bilinearly at a point in columns and rows.
static double read_light(double column, double row, int c) {
    const double u = column - 0.5;
    const double v = fmin(fmax(row - 0.5, 0.0), ROWS - 1.0);
    const int x = (int)floor(u), y = (int)v;
    double sum = 0.0;
    for (int i = 0; i < 4; i++) {
        const int at_x = (x + (i & 1) + COLUMNS) % COLUMNS;
        const int at_y = i & 2 && y + 1 < ROWS ? y + 1 : y;
        sum += (i & 1 ? u - x : 1.0 - u + x) * (i & 2 ? v - y : 1.0 - v + y) *
               (double)texels[3 * (at_y * COLUMNS + at_x) + c];
    }
    return sum;
}

// The points of a sum over all texels: FINE x FINE in each.
enum { FINE = 3, POINTS = COLUMNS * FINE * ROWS * FINE };

typedef struct Point {
    double at[3];
    double light[3];
    double size; // its part of the sphere
} Point;

static Point points[POINTS];

static void make_points(void) {
    for (int i = 0; i < POINTS; i++) {
        const double column = (i % (COLUMNS * FINE) + 0.5) / FINE;
        const double row = (i / (COLUMNS * FINE) + 0.5) / FINE;
        direction_of(column, row, points[i].at);
        points[i].size = sin(pi * row / ROWS);
        for (int c = 0; c < 3; c++) {
            points[i].light[c] = read_light(column, row, c);
        }
    }
}

// The mean light around a direction, weighted by the cosine and, unless alpha is 0, by GGX's
// distribution of half vectors.
static void sum_all(const double n[3], double alpha, double rgb[3]) {
    double total = 0.0;
    rgb[0] = rgb[1] = rgb[2] = 0.0;
    for (int i = 0; i < POINTS; i++) {
        const double *l = points[i].at;
        const double cosine = n[0] * l[0] + n[1] * l[1] + n[2] * l[2];
        if (cosine <= 0.0) {
            continue;
        }
        const double spread = (1.0 + cosine) / 2.0 * (alpha * alpha - 1.0) + 1.0;
        const double lobe = alpha > 0.0 ? alpha * alpha / (spread * spread) : 1.0;
        const double weight = cosine * lobe * points[i].size;
        total += weight;
        for (int c = 0; c < 3; c++) {
            rgb[c] += weight * points[i].light[c];
        }
    }
    for (int c = 0; c < 3; c++) {
        rgb[c] /= total;
    }
}

// Decodes a texel of a map.
static double decode(const DipEnvironmentMap *map, int level, int column, int row, int c) {
    const uint32_t texel =
        (uint32_t)map->texels[map->first[level] + row * (map->cells[level] + 1) + column];
    return ldexp((double)(texel >> (9 * c) & 511), (int)(texel >> 27) - 24);
}

// Returns the direction of a texel of a map.
static void unfold(const DipEnvironmentMap *map, int level, int column, int row, double d[3]) {
    d[0] = 2.0 * column / map->cells[level] - 1.0;
    d[2] = 2.0 * row / map->cells[level] - 1.0;
    d[1] = 1.0 - fabs(d[0]) - fabs(d[2]);
    if (d[1] < 0.0) {
        const double x = (1.0 - fabs(d[2])) * (d[0] < 0.0 ? -1.0 : 1.0);
        d[2] = (1.0 - fabs(d[0])) * (d[2] < 0.0 ? -1.0 : 1.0);
        d[0] = x;
    }
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int i = 0; i < 3; i++) {
        d[i] /= length;
    }
}

static double soft_light(const DipEnvironmentMap *map, const double d[3], int c) {
    const double terms[9] = {1.0,
                             d[0],
                             d[1],
                             d[2],
                             d[0] * d[1],
                             d[1] * d[2],
                             d[0] * d[2],
                             d[0] * d[0] - d[1] * d[1],
                             3.0 * d[2] * d[2] - 1.0};
    double sum = 0.0;
    for (int t = 0; t < 9; t++) {
        sum += terms[t] * (double)map->soft_lin[t][c];
    }
    return sum;
}

// Reads the picture in a direction.
static void mirror(const double d[3], double rgb[3]) {
    const double column = (atan2(d[2], d[0]) / (2.0 * pi) + 0.5) * COLUMNS;
    for (int c = 0; c < 3; c++) {
        rgb[c] = read_light(column, acos(d[1]) / pi * ROWS, c);
    }
}

// Texels of each level, and the light on matt surfaces, in some directions.
static void the_map_equals_a_sum_over_all_texels(void **state) {
    (void)state;
    fill(room);
    DipEnvironmentMap *map = dip_environment_map_create(&environment, NULL);
    DipRefEnvironment *summed = dip_reference_environment_create(&environment);
    assert_true(map && summed);
    make_points();
    double worst_soft = 0.0;
    for (int level = 0; level < DIP_ENVIRONMENT_LEVELS; level++) {
        double worst = 0.0;
        const int cells = map->cells[level];
        for (int i = 0; i < 25; i++) {
            const int column = i % 5 * cells / 4, row = i / 5 * cells / 4;
            double d[3];
            double expected[3];
            unfold(map, level, column, row, d);
            if (level == 0) {
                mirror(d, expected);
            } else if (level == 1) {
                // The points stand too far apart for this lobe.
                dip_reference_environment_see(summed, 0.125, d, expected);
            } else {
                sum_all(d, level * level / 64.0, expected);
            }
            for (int c = 0; c < 3; c++) {
                worst = fmax(worst, fabs(decode(map, level, column, row, c) - expected[c]));
            }
            if (level == 0) {
                sum_all(d, 0.0, expected);
                for (int c = 0; c < 3; c++) {
                    worst_soft = fmax(worst_soft, fabs(soft_light(map, d, c) - expected[c]));
                }
            }
        }
        printf("level %d: greatest error %.4f\n", level, worst);
        assert_true(worst < 0.025); // less than a hundredth of the brightest light
    }
    printf("soft light: greatest error %.4f\n", worst_soft);
    assert_true(worst_soft < 0.02);
    dip_reference_environment_destroy(&summed);
    free(map);
}

static void the_reference_equals_a_sum_over_all_texels(void **state) {
    (void)state;
    fill(room);
    DipRefEnvironment *summed = dip_reference_environment_create(&environment);
    assert_non_null(summed);
    make_points();
    double worst = 0.0;
    for (int i = 0; i < 40; i++) {
        double d[3];
        double expected[3];
        double got[3];
        direction_of(fmod(i * 37.7, COLUMNS), fmod(3.0 + i * 23.3, ROWS), d);
        const double roughness = (i % 8 + 2) / 10.0;
        sum_all(d, roughness * roughness, expected);
        dip_reference_environment_see(summed, roughness, d, got);
        for (int c = 0; c < 3; c++) {
            worst = fmax(worst, fabs(got[c] - expected[c]));
        }
        sum_all(d, 0.0, expected);
        dip_reference_environment_soften(summed, d, got);
        for (int c = 0; c < 3; c++) {
            worst = fmax(worst, fabs(got[c] - expected[c]));
        }
        direction_of(i * 3 + 0.5, i + 0.5, d);
        dip_reference_environment_see(summed, 0.0, d, got);
        for (int c = 0; c < 3; c++) {
            const double texel = (double)texels[3 * (i * COLUMNS + i * 3) + c];
            assert_true(fabs(got[c] - texel) < 1e-6);
        }
    }
    printf("reference: greatest error %.4f\n", worst);
    assert_true(worst < 0.005);
    dip_reference_environment_destroy(&summed);
}

// A golden value: every compiler, every machine and every number of threads must make this map. The
// light is made of exact numbers, since the C library's sines may differ.
static void the_map_has_the_same_bits_everywhere(void **state) {
    (void)state;
    for (int i = 0; i < 3 * COLUMNS * ROWS; i++) {
        texels[i] = (float)(i / 7 % 61) * 0.03125f;
    }
    DipEnvironmentMap *one = dip_environment_map_create(&environment, NULL);
    DipPool *pool = dip_pool_create(3, NULL);
    DipEnvironmentMap *three = dip_environment_map_create(&environment, pool);
    assert_true(one && three);
    const int last = DIP_ENVIRONMENT_LEVELS - 1;
    const size_t count =
        (size_t)(one->first[last] + (one->cells[last] + 1) * (one->cells[last] + 1));
    assert_memory_equal(one, three, sizeof *one + count * sizeof *one->texels);
    uint64_t hash = 1469598103934665603u; // FNV-1a
    for (size_t i = 0; i < sizeof *one / sizeof(int32_t) + count; i++) {
        int32_t entry;
        memcpy(&entry, (const char *)one + i * sizeof entry, sizeof entry);
        hash = (hash ^ (uint32_t)entry) * 1099511628211u;
    }
    assert_int_equal(hash, UINT64_C(0xf95a03549fa937d8));
    free(one);
    free(three);
    dip_pool_destroy(&pool);
}

// --- pictures ------------------------------------------------------------------------------------

// Draws the scene. The caller frees the pixels, which have no gaps.
static uint8_t *draw(const char *settings, DipIsa isa, DipFrame *frame) {
    DipRendererDef def = stage_def(WIDTH, HEIGHT, settings);
    def.isa = isa;
    Stage stage = stage_open(&scene.def, def, 2);
    *frame = stage_draw(&stage, &scene.pose, 0);
    uint8_t *pixels = malloc((size_t)4 * WIDTH * HEIGHT);
    assert_non_null(pixels);
    dip_image_copy(frame, pixels);
    frame->rgba8 = pixels;
    frame->stride_bytes = (size_t)4 * WIDTH;
    stage_close(&stage);
    return pixels;
}

static void compare(const char *name, const char *settings, double least_db) {
    Stage stage = stage_open(&scene.def, stage_def(WIDTH, HEIGHT, settings), 2);
    const DipFrame frame = stage_draw(&stage, &scene.pose, 0);
    double *rgb_lin = stage_draw_reference(&stage, &scene.pose);
    const DipImageError error = dip_image_compare(rgb_lin, &frame, 0.02);
    printf("%s %s: rms %.5f, max %.3f, %zu over 0.02, %.1f dB\n", name, settings, error.rms_lin,
           error.max_lin, error.over_count, error.psnr_db);
    if (error.psnr_db < least_db || error.over_count > 5) {
        const DipImageBounds bounds = {.pixel_lin = 0.02};
        dip_image_check(name, rgb_lin, &frame, &bounds); // writes pictures
        fail_msg("%.1f dB, accepted at least %.1f; %zu pixels over 0.02, accepted at most 5",
                 error.psnr_db, least_db, error.over_count);
    }
    free(rgb_lin);
    stage_close(&stage);
}

static void balls_equal_the_reference(void **state) {
    (void)state;
    fill(room);
    author_make_balls(&scene);
    scene.def.environment = &environment;
    compare("environment_balls", "aa=none", 42.0);
    author_free(&scene);
}

static void all_parts_and_lights_equal_the_reference(void **state) {
    (void)state;
    fill(room);
    author_make_parts(&scene);
    scene.def.environment = &environment;
    compare("environment_parts", "aa=2", 38.0);
    author_free(&scene);
}

// Counts the codes between two pictures, at most.
static int greatest_difference(const uint8_t *a, const uint8_t *b) {
    int greatest = 0;
    for (int i = 0; i < 4 * WIDTH * HEIGHT; i++) {
        greatest = abs(a[i] - b[i]) > greatest ? abs(a[i] - b[i]) : greatest;
    }
    return greatest;
}

// Even light, and light that rises with height, are surroundings that a lighting can describe.
static void simple_environments_equal_the_lighting(void **state) {
    (void)state;
    static Light *const lights[2] = {even, rising};
    static const DipLightingDef lightings[2] = {
        {.ambient_lin = {0.2f, 0.4f, 0.6f}},
        {.ambient_lin = {0.35f, 0.35f, 0.35f}, .sky_lin = {0.15f, 0.15f, 0.15f}}};
    for (int i = 0; i < 2; i++) {
        DipFrame frame;
        fill(lights[i]);
        author_make_balls(&scene);
        scene.def.environment = &environment;
        uint8_t *seen = draw("aa=none", dip_isa_best(), &frame);
        scene.def.environment = NULL;
        scene.def.lighting = &lightings[i];
        uint8_t *described = draw("aa=none", dip_isa_best(), &frame);
        const int difference = greatest_difference(seen, described);
        printf("environment %d: at most %d codes apart\n", i, difference);
        assert_true(difference <= 2);
        free(seen);
        free(described);
        author_free(&scene);
    }
}

static void all_instruction_sets_draw_the_same(void **state) {
    (void)state;
    fill(room);
    author_make_parts(&scene);
    scene.def.environment = &environment;
    DipFrame frame;
    uint8_t *scalar = draw("aa=2", DIP_ISA_SCALAR, &frame);
    for (int isa = 1; isa < DIP_ISA_COUNT; isa++) {
        if (dip_isa_available((DipIsa)isa)) {
            uint8_t *other = draw("aa=2", (DipIsa)isa, &frame);
            assert_memory_equal(scalar, other, (size_t)4 * WIDTH * HEIGHT);
            free(other);
        }
    }
    free(scalar);
    author_free(&scene);
}

// A surface with a light map keeps its bits.
static void what_does_not_reflect_does_not_see_an_environment(void **state) {
    (void)state;
    fill(room);
    DipFrame frame;
    uint8_t *pixels[2];
    for (int i = 0; i < 2; i++) {
        author_make_balls(&scene);
        const int map = author_add_texture(&scene, 4, DIP_ENCODING_LINEAR);
        for (int m = 0; m < scene.def.material_count; m++) {
            if (m % 2) {
                scene.materials[m].light_map = map;
            } else {
                scene.materials[m].pbr = NULL;
            }
        }
        scene.def.environment = i ? &environment : NULL;
        pixels[i] = draw("aa=none", dip_isa_best(), &frame);
        author_free(&scene);
    }
    assert_memory_equal(pixels[0], pixels[1], (size_t)4 * WIDTH * HEIGHT);
    free(pixels[0]);
    free(pixels[1]);
}

static void bad_environments_are_refused(void **state) {
    (void)state;
    DipEnvironmentDef bad[3] = {environment, environment, environment};
    fill(even);
    bad[0].height = COLUMNS;
    bad[1].width = 2 * DIP_MAX_ENVIRONMENT_WIDTH;
    bad[1].height = DIP_MAX_ENVIRONMENT_WIDTH;
    texels[7] = NAN;
    for (int i = 0; i < 3; i++) {
        DipError err = {0};
        author_make_balls(&scene);
        scene.def.environment = &bad[i];
        assert_null(dip_scene_create(&scene.def, NULL, &err));
        assert_int_equal(err.code, DIP_ERROR_RANGE);
        assert_string_equal(err.key, "environment");
        author_free(&scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_map_equals_a_sum_over_all_texels),
        cmocka_unit_test(the_reference_equals_a_sum_over_all_texels),
        cmocka_unit_test(the_map_has_the_same_bits_everywhere),
        cmocka_unit_test(balls_equal_the_reference),
        cmocka_unit_test(all_parts_and_lights_equal_the_reference),
        cmocka_unit_test(simple_environments_equal_the_lighting),
        cmocka_unit_test(all_instruction_sets_draw_the_same),
        cmocka_unit_test(what_does_not_reflect_does_not_see_an_environment),
        cmocka_unit_test(bad_environments_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
