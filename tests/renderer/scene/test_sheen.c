// Tests the sheen of cloth: balls under the fixed light against the formulas of
// KHR_materials_sheen, which this file computes for each pixel in double precision.
#include "author_scenes.h"
#include "stage.h"
#include "vec.h"

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

enum { WIDTH = 240, HEIGHT = 160, BALLS = 3 };

static AuthorScene scene;

static const float rose[3] = {0.9f, 0.5f, 0.7f};
static const double roughnesses[BALLS] = {0.3, 0.55, 1.0};

// Makes balls that reflect nothing but diffuse light and sheen. Their own colour is grey.
static void make_cloth(float grey) {
    author_begin(&scene);
    for (int i = 0; i < BALLS; i++) {
        const int material = author_add_pbr(&scene, 0.0f, 1.0f);
        DipPbrDef *pbr = &scene.pbrs[material];
        memset(pbr->f0_lin, 0, sizeof pbr->f0_lin);
        pbr->f90 = 0.0f;
        memcpy(pbr->sheen_lin, rose, sizeof rose);
        pbr->sheen_roughness = (float)roughnesses[i];
        for (int c = 0; c < 3; c++) {
            scene.materials[material].base_colour_lin[c] = grey;
        }
        author_add_sphere(&scene, material, (const float[]){2.2f * (float)i - 2.2f, 0.0f, 0.0f},
                          1.0f);
    }
}

// --- the formulas --------------------------------------------------------------------------------

// The share of uniform light that a white sheen sends to the eye: the curve that three.js fits to
// the distribution's integral.
static double albedo(double r, double cosine) {
    const double a = -1.9362 + 1.0678 * r + 0.4573 * r * r - 0.8469 / (r + 0.1);
    const double b = -0.6014 + 0.5538 * r - 0.4670 * r * r - 0.1255 / (r + 0.1);
    return fmin(exp(a * cosine + b), 1.0);
}

// Finds the point of a ball on a ray from the eye at (0, 0, 8). Returns false beside the balls, and
// within a hundredth of the radius of their borders.
static bool find_point(const double ray[3], int *ball, double normal[3]) {
    for (int i = 0; i < BALLS; i++) {
        const double from[3] = {-(2.2 * i - 2.2), 0.0, 8.0};
        const double b = dot(from, ray);
        const double root2 = b * b - dot(from, from) + 1.0;
        if (root2 > 0.02) {
            for (int k = 0; k < 3; k++) {
                normal[k] = from[k] + ray[k] * (-b - sqrt(root2));
            }
            *ball = i;
            return true;
        }
    }
    return false;
}

// Computes the colour of a ball whose own colour is grey. A light of 1 makes a white matt surface
// white that faces it.
static void shade(int ball, double grey, const double n[3], const double to_eye[3], double rgb[3]) {
    const double pi = acos(-1.0);
    const double r = roughnesses[ball];
    const double alpha = r * r;
    double sun[3] = {-0.42, 0.67, 0.61};
    const double length = sqrt(dot(sun, sun));
    double half[3];
    for (int i = 0; i < 3; i++) {
        sun[i] /= length;
        half[i] = sun[i] + to_eye[i];
    }
    const double n_l = fmax(dot(n, sun), 0.0);
    const double n_v = fmax(dot(n, to_eye), 0.0);
    const double n_h = fmax(dot(n, half), 0.0) / sqrt(dot(half, half));
    const double d =
        (2.0 + 1.0 / alpha) * pow(fmax(1.0 - n_h * n_h, 0.0078125), 0.5 / alpha) / (2.0 * pi);
    const double v = fmin(1.0 / (4.0 * (n_l + n_v - n_l * n_v)), 1.0);
    const double greatest = (double)rose[0];
    const double soft = 0.35 + 0.15 * n[1];
    const double direct = 0.65 * n_l;
    for (int c = 0; c < 3; c++) {
        const double colour = (double)rose[c];
        rgb[c] = soft * (grey * (1.0 - greatest * albedo(r, n_v)) + colour * albedo(r, n_v)) +
                 direct * (grey * (1.0 - greatest * fmax(albedo(r, n_v), albedo(r, n_l))) +
                           pi * colour * d * v);
        rgb[c] = fmin(rgb[c], 1.0);
    }
}

static Stage open_stage(void) {
    return stage_open(&scene.def, stage_def(WIDTH, HEIGHT, "aa=none"), 1);
}

static void cloth_has_the_sheen_of_the_formulas(void **state) {
    (void)state;
    static const float greys[] = {0.0f, 0.6f};
    const double half = tan(18.0 * acos(-1.0) / 180.0);
    for (int g = 0; g < 2; g++) {
        make_cloth(greys[g]);
        Stage stage = open_stage();
        const DipFrame frame = stage_draw(&stage, &scene.pose, 0);
        double sum2[BALLS] = {0.0};
        double greatest = 0.0;
        int count[BALLS] = {0};
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            const int x = i % WIDTH, y = i / WIDTH;
            double ray[3] = {(2.0 * (x + 0.5) / WIDTH - 1.0) * half * WIDTH / HEIGHT,
                             (1.0 - 2.0 * (y + 0.5) / HEIGHT) * half, -1.0};
            const double length = sqrt(dot(ray, ray));
            const double to_eye[3] = {-ray[0] / length, -ray[1] / length, -ray[2] / length};
            double normal[3], expected[3];
            int ball;
            for (int k = 0; k < 3; k++) {
                ray[k] /= length;
            }
            if (!find_point(ray, &ball, normal)) {
                continue;
            }
            shade(ball, (double)greys[g], normal, to_eye, expected);
            const uint8_t *pixel = dip_image_pixel(&frame, x, y);
            for (int c = 0; c < 3; c++) {
                const double error = srgb_light(pixel[c]) - expected[c];
                sum2[ball] += error * error;
                greatest = fmax(greatest, fabs(error));
            }
            count[ball] += 3;
        }
        for (int b = 0; b < BALLS; b++) {
            const double psnr = -10.0 * log10(sum2[b] / count[b]);
            printf("grey %.1f, roughness %.2f: %.1f dB\n", (double)greys[g], roughnesses[b], psnr);
            assert_true(count[b] > 1000 && psnr > 48.0);
        }
        printf("greatest error %.4f\n", greatest);
        assert_true(greatest < 0.03);
        assert_true(frame.effects.sheen.run);
        assert_int_equal(frame.counters.fragments_sheen, frame.counters.fragments_pbr);
        stage_close(&stage);
        author_free(&scene);
    }
}

// A surface of the roughness 0 has the sheen of 0.1, which is finite everywhere.
static void a_smooth_sheen_is_that_of_a_tenth(void **state) {
    (void)state;
    char hashes[2][33];
    for (int i = 0; i < 2; i++) {
        make_cloth(0.3f);
        scene.pbrs[0].sheen_roughness = i ? 0.1f : 0.0f;
        Stage stage = open_stage();
        const DipFrame frame = stage_draw(&stage, &scene.pose, 0);
        dip_frame_hash(&frame, hashes[i]);
        stage_close(&stage);
        author_free(&scene);
    }
    assert_string_equal(hashes[0], hashes[1]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cloth_has_the_sheen_of_the_formulas),
        cmocka_unit_test(a_smooth_sheen_is_that_of_a_tenth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
