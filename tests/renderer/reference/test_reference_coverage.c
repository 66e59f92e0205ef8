// Tests which samples the reference covers. The tests draw half-planes, closed meshes, front and
// back faces, surfaces at several depths, and surfaces at the near plane.
#include "renderer/base/assert.h"
#include "renderer/pipeline/pattern.h"
#include "tests/renderer/pipeline/screen.h"
#include "renderer/catalogue/random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "tests/renderer/pipeline/near.h"

static const double pi = 3.14159265358979323846;
static const int sample_counts[] = {1, 2, 4, 6, 8};
static const char *const aa_settings[] = {"aa=none", "aa=2", "aa=4", "aa=6", "aa=8"};

static DipScreenPicture picture;
static DipScreenPicture other;

// Returns the area of the part of a pixel where n . p >= d. Cuts the unit square along the line and
// computes the area with the shoelace formula.
static double half_plane_area(const double n[2], double d, int x, int y) {
    const double square[4][2] = {{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}};
    double polygon[8][2];
    int count = 0;
    for (int i = 0; i < 4; i++) {
        const double *a = square[i];
        const double *b = square[(i + 1) % 4];
        const double side_a = n[0] * a[0] + n[1] * a[1] - d;
        const double side_b = n[0] * b[0] + n[1] * b[1] - d;
        if (side_a >= 0.0) {
            memcpy(polygon[count++], a, sizeof polygon[0]);
        }
        if ((side_a >= 0.0) != (side_b >= 0.0)) {
            const double t = side_a / (side_a - side_b);
            polygon[count][0] = a[0] + t * (b[0] - a[0]);
            polygon[count++][1] = a[1] + t * (b[1] - a[1]);
        }
    }
    double twice = 0.0;
    for (int i = 0; i < count; i++) {
        const double *a = polygon[i];
        const double *b = polygon[(i + 1) % count];
        twice += a[0] * b[1] - a[1] * b[0];
    }
    return fabs(twice) * 0.5;
}

typedef struct HalfPlane {
    DipTestScene scene;
    double normal[2]; // normal of the half-plane's edge; points to the covered side
    double distance;
} HalfPlane;

// Makes a white quad of which only one edge crosses the picture.
static void make_half_plane(HalfPlane *half, Random *random) {
    const double angle = random_real(random, 0.0, 2.0 * pi);
    const double along[2] = {cos(angle) * 200.0, sin(angle) * 200.0};
    const double middle[2] = {random_real(random, 16.0, 48.0), random_real(random, 16.0, 48.0)};
    DipScreenPoint p[4];
    p[0] = dip_screen_snap(middle[0] - along[0], middle[1] - along[1], 1.0);
    p[1] = dip_screen_snap(middle[0] + along[0], middle[1] + along[1], 1.0);
    p[2] = dip_screen_snap(p[1].x - along[1], p[1].y + along[0], 1.0);
    p[3] = dip_screen_snap(p[0].x - along[1], p[0].y + along[0], 1.0);
    dip_screen_begin(&half->scene);
    dip_screen_add_polygon(&half->scene, dip_screen_add_white(&half->scene), p, 4, 0);
    half->normal[0] = p[0].y - p[1].y;
    half->normal[1] = p[1].x - p[0].x;
    half->distance = half->normal[0] * p[0].x + half->normal[1] * p[0].y;
}

typedef struct Deviation {
    double greatest;
    double squares;
    int count;
} Deviation;

// Collects the deviations of the pixels on the edge from the exact area: the greatest one and the
// sum of squares. Checks that all other pixels are exact.
static void add_deviations(const HalfPlane *half, Deviation *deviation) {
    for (int y = 0; y < DIP_SCREEN; y++) {
        for (int x = 0; x < DIP_SCREEN; x++) {
            const double area = half_plane_area(half->normal, half->distance, x, y);
            const double difference = fabs(picture[y][x][1] - area);
            if (area == 0.0 || area >= 1.0 - 1e-12) {
                assert_near(difference, 0.0, 1e-9);
                continue;
            }
            deviation->greatest = fmax(deviation->greatest, difference);
            deviation->squares += difference * difference;
            deviation->count++;
        }
    }
}

// The bounds depend only on the sample positions of the patterns.
static void coverage_of_half_planes_is_as_exact_as_the_pattern_allows(void **state) {
    (void)state;
    static const double greatest[] = {0.5, 0.497, 0.308, 0.220, 0.226};
    double last_rms = 1.0;
    for (int i = 0; i < 5; i++) {
        Random random = {4};
        Deviation deviation = {0};
        for (int line = 0; line < 60; line++) {
            HalfPlane half;
            make_half_plane(&half, &random);
            dip_screen_draw(&half.scene, aa_settings[i], picture);
            add_deviations(&half, &deviation);
            dip_test_scene_free(&half.scene);
        }
        const double rms = sqrt(deviation.squares / deviation.count);
        assert_true(deviation.greatest <= greatest[i] + 0.002);
        assert_true(deviation.greatest >=
                    0.8 * greatest[i]); // fails if the test does not measure anything
        assert_true(rms < last_rms);
        last_rms = rms;
    }
}

static void the_converged_coverage_of_a_half_plane_is_its_area(void **state) {
    (void)state;
    Random random = {9};
    Deviation deviation = {0};
    for (int line = 0; line < 8; line++) {
        HalfPlane half;
        make_half_plane(&half, &random);
        dip_screen_converge(&half.scene, 256, (uint32_t)line, picture);
        add_deviations(&half, &deviation);
        dip_test_scene_free(&half.scene);
    }
    // A jittered grid of 256 samples deviates by 1.5/255 RMS and by at most 6.3/255.
    assert_true(sqrt(deviation.squares / deviation.count) < 2.0 / 255.0);
    assert_true(deviation.greatest < 9.0 / 255.0);
}

enum { CELLS = 6 };

// Makes a grid of points that reaches beyond the picture's edges. The points are moved at random.
// Every third point lies exactly on a sample position of the pattern.
static void make_grid(DipScreenPoint grid[CELLS + 1][CELLS + 1], const DipSamplePattern *pattern,
                      Random *random) {
    for (int j = 0; j <= CELLS; j++) {
        for (int i = 0; i <= CELLS; i++) {
            const double step = (DIP_SCREEN + 4.0) / CELLS;
            double x = i * step - 2.0;
            double y = j * step - 2.0;
            if (i > 0 && i < CELLS && j > 0 && j < CELLS) {
                x += random_real(random, -0.3, 0.3) * step;
                y += random_real(random, -0.3, 0.3) * step;
                const int s = random_int(random, 0, pattern->count - 1);
                if (random_int(random, 0, 2) == 0) {
                    x = floor(x) + pattern->x[s] / 256.0;
                    y = floor(y) + pattern->y[s] / 256.0;
                }
            }
            grid[j][i] = dip_screen_snap(x, y, 1.0);
        }
    }
}

static void add_picture_of(const DipScreenPoint *triangle, const char *settings) {
    DipTestScene scene;
    dip_screen_begin(&scene);
    dip_screen_add_polygon(&scene, dip_screen_add_white(&scene), triangle, 3, 0);
    dip_screen_draw(&scene, settings, other);
    dip_test_scene_free(&scene);
    for (int i = 0; i < DIP_SCREEN * DIP_SCREEN; i++) {
        picture[i / DIP_SCREEN][i % DIP_SCREEN][0] += other[i / DIP_SCREEN][i % DIP_SCREEN][0];
    }
}

// Draws each triangle of a closed mesh alone. Their coverages must add up to one everywhere.
static void a_closed_mesh_covers_every_sample_once(void **state) {
    (void)state;
    for (int k = 0; k < 5; k++) {
        Random random = {(uint64_t)k};
        DipScreenPoint grid[CELLS + 1][CELLS + 1];
        make_grid(grid, dip_sample_pattern(sample_counts[k]), &random);
        memset(picture, 0, sizeof picture);
        for (int cell = 0; cell < CELLS * CELLS; cell++) {
            const int i = cell % CELLS;
            const int j = cell / CELLS;
            const DipScreenPoint q[4] = {grid[j][i], grid[j + 1][i], grid[j + 1][i + 1],
                                         grid[j][i + 1]};
            const bool split = random_int(&random, 0, 1);
            const DipScreenPoint first[3] = {q[0], q[1], q[split ? 2 : 3]};
            const DipScreenPoint second[3] = {q[2], q[3], q[split ? 0 : 1]};
            add_picture_of(first, aa_settings[k]);
            add_picture_of(second, aa_settings[k]);
        }
        for (int i = 0; i < DIP_SCREEN * DIP_SCREEN; i++) {
            assert_near(picture[i / DIP_SCREEN][i % DIP_SCREEN][0], 1.0, 1e-12);
        }
    }
}

// A triangle around the picture's middle, counter-clockwise to the eye.
static const DipScreenPoint middle_triangle[3] = {{32, 10, 2}, {10, 50, 2}, {54, 50, 2}};

static void set_base_colour(DipTestScene *scene, int material, float r, float g, float b) {
    float *base = scene->materials[material].base_colour_lin;
    base[0] = r;
    base[1] = g;
    base[2] = b;
}

static void only_front_faces_and_double_sided_surfaces_are_visible(void **state) {
    (void)state;
    // Draws counter-clockwise and clockwise triangles, in plain and in mirrored objects.
    for (int kind = 0; kind < 8; kind++) {
        const bool clockwise = kind & 1;
        const bool mirrored = kind & 2;
        const bool double_sided = kind & 4;
        DipTestScene scene;
        dip_screen_begin(&scene);
        const int material = dip_screen_add_white(&scene);
        scene.materials[material].double_sided = double_sided;
        const DipTestMesh mesh = dip_screen_add_polygon(&scene, material, middle_triangle, 3, 0);
        if (clockwise) {
            mesh.indices[1] = 2;
            mesh.indices[2] = 1;
        }
        scene.objects[0].transform[0] = mirrored ? -1.0f : 1.0f;
        dip_screen_draw(&scene, "aa=none", picture);
        // A mesh that faces the eye still faces the eye if its object mirrors the mesh.
        assert_near(picture[32][32][0], double_sided || !clockwise ? 1.0 : 0.0, 0.0);
        dip_test_scene_free(&scene);
    }
}

static void nearer_surfaces_win_and_the_first_of_coplanar_ones_stays(void **state) {
    (void)state;
    static const double distances[][2] = {{2, 2}, {2, 1}, {1, 2}};
    static const int seen[] = {0, 1, 0};
    for (int k = 0; k < 3; k++) {
        DipTestScene scene;
        dip_screen_begin(&scene);
        for (int i = 0; i < 2; i++) {
            const int material = dip_screen_add_white(&scene);
            set_base_colour(&scene, material, i == 0, i == 1, 0);
            DipScreenPoint p[3];
            memcpy(p, middle_triangle, sizeof p);
            p[0].w = p[1].w = p[2].w = distances[k][i];
            dip_screen_add_polygon(&scene, material, p, 3, 0);
        }
        dip_screen_draw(&scene, "aa=8", picture);
        assert_near(picture[32][32][seen[k]], 1.0, 0.0);
        assert_near(picture[32][32][1 - seen[k]], 0.0, 0.0);
        dip_test_scene_free(&scene);
    }
}

// Two quads cross where both have the same depth. 1/w = 1 - x/128 and 1/w = 1/2 + x/128 are equal
// at x = 32, between two columns of pixels. Shifted by half a pixel, the quads cross at x = 32.5,
// inside a column, where depth decides for each sample.
static void depth_is_decided_per_sample(void **state) {
    (void)state;
    DipTestScene scene;
    dip_screen_begin(&scene);
    for (int i = 0; i < 2; i++) {
        const int material = dip_screen_add_white(&scene);
        set_base_colour(&scene, material, i == 0, i == 1, 0);
        const double left = i == 0 ? 1.0 : 2.0;
        const double right = 3.0 - left;
        // The quads cross at x = 32.5.
        const DipScreenPoint p[4] = {
            {0.5, 0, left}, {0.5, 64, left}, {64.5, 64, right}, {64.5, 0, right}};
        dip_screen_add_polygon(&scene, material, p, 4, 0);
    }
    dip_screen_draw(&scene, "aa=8", picture);
    const DipSamplePattern *pattern = dip_sample_pattern(8);
    int left_count = 0;
    for (int s = 0; s < 8; s++) {
        left_count += pattern->x[s] < 128;
    }
    for (int y = 0; y < DIP_SCREEN; y++) {
        assert_near(picture[y][31][0], 1.0, 0.0);
        assert_near(picture[y][33][1], 1.0, 0.0);
        assert_near(picture[y][32][0], left_count / 8.0, 1e-12);
        assert_near(picture[y][32][1], 1.0 - left_count / 8.0, 1e-12);
    }
    dip_test_scene_free(&scene);
}

// A surface at the near plane (1/16 m) is visible; a nearer surface is not. In the third case, the
// lower half of the surface is at the near plane, and the upper half leans from there towards the
// eye.
static void surfaces_nearer_than_the_near_plane_are_cut_off(void **state) {
    (void)state;
    static const double distances[][2] = {{0.0625, 0.0625}, {0.03125, 0.03125}, {0.03125, 0.0625}};
    static const int seen[][2] = {{1, 1}, {0, 0}, {0, 1}}; // visible at y = 12 and at y = 40
    for (int k = 0; k < 3; k++) {
        DipTestScene scene;
        dip_screen_begin(&scene);
        const double top = distances[k][0];
        const double bottom = distances[k][1];
        const DipScreenPoint p[4] = {{0, 0, top}, {0, 32, bottom}, {64, 32, bottom}, {64, 0, top}};
        const DipScreenPoint q[4] = {
            {0, 32, bottom}, {0, 64, bottom}, {64, 64, bottom}, {64, 32, bottom}};
        const int material = dip_screen_add_white(&scene);
        dip_screen_add_polygon(&scene, material, p, 4, 0);
        dip_screen_add_polygon(&scene, material, q, 4, 0);
        dip_screen_draw(&scene, "aa=4", picture);
        assert_near(picture[12][30][0], seen[k][0], 0.0);
        assert_near(picture[40][30][0], seen[k][1], 0.0);
        dip_test_scene_free(&scene);
    }
}

// A floor 1 m below the eye begins behind the eye. One corner lies far behind the eye, and one
// between the eye and the near plane. The floor's colour is its position, so the test computes
// where the rays through the pixels' centres meet the floor.
static void a_floor_that_begins_behind_the_eye_is_cut_at_the_near_plane(void **state) {
    (void)state;
    DipTestScene scene;
    dip_screen_begin(&scene);
    const int material = dip_screen_add_white(&scene);
    const DipTestMesh mesh = dip_test_scene_add_mesh(&scene, 4, 6, DIP_TEST_COLOURS, material);
    static const float positions[12] = {-16, -1, 16, 16, -1, -0.03125f, 16, -1, -16, -16, -1, -16};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    memcpy(mesh.positions, positions, sizeof positions);
    memcpy(mesh.indices, indices, sizeof indices);
    for (int v = 0; v < 4; v++) {
        mesh.colours_lin[3 * v] = positions[3 * v] / 32.0f + 0.5f;
        mesh.colours_lin[3 * v + 1] = positions[3 * v + 2] / 32.0f + 0.5f;
        mesh.colours_lin[3 * v + 2] = 1.0f;
    }
    dip_screen_draw(&scene, "aa=none", picture);
    for (int y = 0; y < DIP_SCREEN; y++) {
        for (int x = 0; x < DIP_SCREEN; x++) {
            const double ray[2] = {(x + 0.5) / 32.0 - 1.0, 1.0 - (y + 0.5) / 32.0};
            const double w = -1.0 / ray[1];
            if (ray[1] > -0.07) { // near and beyond the far edge at w = 16, 1/16 below the horizon
                assert_near(picture[y][x][2], y < 32 || w > 16.0 ? 0.0 : 1.0, 0.0);
                continue;
            }
            // The corners that clipping creates lie a thousand pixels away. They are nevertheless
            // rounded to 1/256 pixel.
            assert_near(picture[y][x][0], ray[0] * w / 32.0 + 0.5, 2e-3);
            assert_near(picture[y][x][1], -w / 32.0 + 0.5, 2e-3);
        }
    }
    dip_test_scene_free(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coverage_of_half_planes_is_as_exact_as_the_pattern_allows),
        cmocka_unit_test(the_converged_coverage_of_a_half_plane_is_its_area),
        cmocka_unit_test(a_closed_mesh_covers_every_sample_once),
        cmocka_unit_test(only_front_faces_and_double_sided_surfaces_are_visible),
        cmocka_unit_test(nearer_surfaces_win_and_the_first_of_coplanar_ones_stays),
        cmocka_unit_test(depth_is_decided_per_sample),
        cmocka_unit_test(surfaces_nearer_than_the_near_plane_are_cut_off),
        cmocka_unit_test(a_floor_that_begins_behind_the_eye_is_cut_at_the_near_plane),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
