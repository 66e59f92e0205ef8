// Compares the reference with a ray cast in 128-bit floating point, on triangles whose coordinates
// differ by many orders of magnitude.
#include "renderer/reference/internal/internal.h"
#include "renderer/reference/internal/wide.h"
#include "tests/renderer/pipeline/screen.h"
#include "tests/renderer/random.h"
#include "tests/renderer/reference/raycast.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/renderer/pipeline/near.h"

enum { WIDTH = 64, HEIGHT = 48 };

// How far the reference may move a point of a triangle along each axis: by the errors of its
// doubles, and by rounding to 1/256 pixel.
#define EXACT_PX   0x1p-20
#define ROUNDED_PX (1.0 / 512.0 + 0x1p-20)

// A scene as the reference draws it and as the ray caster sees it.
typedef struct Pair {
    const DipTestScene *scene;
    DipReference *reference;
    DipRefTriangles triangles;
    DipRaycast raycast;
    double margin_px;
    int judged;  // positions that the ray caster was sure about
    int covered; // of these, positions on a triangle
    int wrong;   // of these, positions that the reference shows wrongly
} Pair;

static void open_pair(Pair *pair, const DipTestScene *scene, bool rounded) {
    DipError err = {0};
    pair->scene = scene;
    pair->margin_px = rounded ? ROUNDED_PX : EXACT_PX;
    pair->reference = dip_reference_create(&scene->def, &err);
    assert_non_null(pair->reference);
    const DipRefShot shot = {&scene->pose, WIDTH, HEIGHT, (double)WIDTH / HEIGHT,
                             .rounded = rounded};
    assert_true(dip_reference_build_triangles(pair->reference, &shot, &pair->triangles, &err));
    assert_true(dip_raycast_init(&pair->raycast, &scene->def, &scene->pose, WIDTH, HEIGHT));
}

static void close_pair(Pair *pair) {
    dip_raycast_free(&pair->raycast);
    dip_reference_triangles_free(&pair->triangles);
    dip_reference_destroy(&pair->reference);
}

// Places a position (in pixels) on a triangle. Returns false if the triangle does not cover it.
static bool place_on(const DipRefTriangle *triangle, double x, double y, DipRefPosition *place) {
    *place = (DipRefPosition){triangle, {0.0}, 256.0 * x, 256.0 * y};
    for (int i = 0; i < 3; i++) {
        const DipRefVertex *from = &triangle->vertices[(i + 1) % 3];
        const DipRefVertex *to = &triangle->vertices[(i + 2) % 3];
        place->edges[i] =
            (to->x - from->x) * (place->y - from->y) - (to->y - from->y) * (place->x - from->x);
        if (place->edges[i] < 0.0) {
            return false;
        }
    }
    return true;
}

// Finds the reference's nearest triangle. Returns its depth, or 0.
static double find_nearest(const Pair *pair, double x, double y, DipRefPosition *nearest) {
    double depth = 0.0;
    for (size_t t = 0; t < pair->triangles.count; t++) {
        DipRefPosition place;
        if (place_on(&pair->triangles.items[t], x, y, &place)) {
            const double here = dip_reference_depth(&place, pair->scene->def.near_m);
            if (here > depth) {
                depth = here;
                *nearest = place;
            }
        }
    }
    return depth;
}

// Returns how much a coordinate u = U / Q may differ if its position may differ by the margin.
// `value` is u and its derivatives, `inv_w` is Q and its derivatives.
static double tolerance_of(const double value[3], const double inv_w[3], double margin_px) {
    const double change = (fabs(inv_w[1]) + fabs(inv_w[2])) * margin_px;
    const double least = inv_w[0] - change;
    return least > 0.0 ? (fabs(value[1]) + fabs(value[2])) * margin_px * inv_w[0] / least
                       : INFINITY;
}

// Returns the sum of |u| over a triangle's corners, times the corners' weights at a position.
static double terms_of(const DipRefPosition *place, int varying) {
    double sum = 0.0, weights = 0.0;
    for (int i = 0; i < 3; i++) {
        const DipRefVertex *vertex = &place->triangle->vertices[i];
        sum += place->edges[i] * vertex->inv_w * fabs(vertex->varyings[varying]);
        weights += place->edges[i] * vertex->inv_w;
    }
    return sum / weights;
}

// Returns the greatest error of a derivative. Moving the corners of a triangle of the height h by d
// changes the gradients of U and Q by d / h of their lengths. The sum that the reference computes
// may have terms that are much greater than the sum.
static double gradient_tolerance(const DipRefPosition *place, int varying, const double value[3],
                                 const double inv_w[3]) {
    const DipRefVertex *v = place->triangle->vertices;
    double longest = 0.0, terms = 0.0, weights = 0.0;
    for (int i = 0; i < 3; i++) {
        const DipRefVertex *from = &v[(i + 1) % 3], *to = &v[(i + 2) % 3];
        const double length = hypot(to->x - from->x, to->y - from->y);
        longest = fmax(longest, length);
        terms += length * v[i].inv_w * (fabs(v[i].varyings[varying]) + fabs(value[0]));
        weights += place->edges[i] * v[i].inv_w;
    }
    const double height_px = place->triangle->area / longest / 256.0;
    const double steepness = (fabs(inv_w[1]) + fabs(inv_w[2])) / inv_w[0];
    return 0x1p-26 * (1.0 + 1.0 / height_px + steepness) *
               (fabs(value[1]) + fabs(value[2]) + 2.0 * fabs(value[0]) * steepness) +
           0x1p-47 * 256.0 * terms / weights;
}

static bool is_near(double value, double expected, double tolerance) {
    return fabs(value - expected) <= tolerance; // false for a NaN
}

static bool shows_hit(const Pair *pair, const DipRefPosition *place, double depth,
                      const DipRayHit *hit) {
    const double near_m = pair->scene->def.near_m;
    const double slack = (fabs(hit->inv_w[1]) + fabs(hit->inv_w[2])) * pair->margin_px;
    bool right = is_near(depth, near_m * hit->inv_w[0], near_m * (slack + 0x1p-44 * hit->inv_w[0]));
    DipRefVaryings varyings;
    dip_reference_interpolate(place, DIP_REF_U0, 2, true, &varyings);
    for (int c = 0; c < 2; c++) {
        const double *value = c == 0 ? hit->u : hit->v;
        const double tolerance = tolerance_of(value, hit->inv_w, pair->margin_px) +
                                 0x1p-44 * terms_of(place, DIP_REF_U0 + c);
        right = right && is_near(varyings.value[c], value[0], tolerance);
        if (pair->margin_px == EXACT_PX) {
            const double gradient = gradient_tolerance(place, DIP_REF_U0 + c, value, hit->inv_w);
            right = right && is_near(varyings.ddx[c], value[1], gradient) &&
                    is_near(varyings.ddy[c], value[2], gradient);
        }
    }
    return right;
}

static void judge(Pair *pair, double x, double y) {
    DipRayHit hit;
    DipRefPosition place;
    const DipRaySight sight = dip_raycast_look(&pair->raycast, x, y, pair->margin_px, &hit);
    if (sight == DIP_RAY_UNSURE) {
        return;
    }
    const double depth = find_nearest(pair, x, y, &place);
    pair->judged++;
    pair->covered += sight == DIP_RAY_TRIANGLE;
    pair->wrong += sight == DIP_RAY_TRIANGLE ? depth == 0.0 || !shows_hit(pair, &place, depth, &hit)
                                             : depth != 0.0;
}

// --- scenes --------------------------------------------------------------------------------------

static double random_sign(Random *random) {
    return random_int(random, 0, 1) ? 1.0 : -1.0;
}

// Returns a number of either sign whose binary exponent lies in low..high.
static double random_magnitude(Random *random, int low, int high) {
    return random_sign(random) *
           ldexp(random_real(random, 1.0, 2.0), random_int(random, low, high));
}

enum {
    TRIANGLES = 10000,
    POSITIONS = 48, // positions that are compared, per triangle
    KINDS = 12      // kinds of triangles: six, with exponents in -20..30 or in -60..60
};

// Makes the corners of a triangle relative to the eye, looking along -Z.
static void make_corners(Random *random, int kind, double corners[3][3]) {
    const bool wider = kind >= KINDS / 2;
    const int low = wider ? -60 : -20, high = wider ? 60 : 30;
    const double middle = ldexp(random_real(random, 1.0, 2.0), random_int(random, low, high));
    const double seen[3] = {random_real(random, -0.6, 0.6) * middle,
                            random_real(random, -0.5, 0.5) * middle, -middle};
    for (int v = 0; v < 3; v++) {
        const double size = random_magnitude(random, low, high);
        for (int i = 0; i < 3; i++) {
            switch (kind % (KINDS / 2)) {
            case 0: // every coordinate has a magnitude of its own
                corners[v][i] = random_magnitude(random, low, high);
                break;
            case 1: // every corner has a distance of its own
                corners[v][i] = random_real(random, -1.0, 1.0) * size;
                break;
            case 2: // around a visible point, so that most triangles are seen
                corners[v][i] = v < 2 ? seen[i] + random_real(random, -1.0, 1.0) * size
                                      : seen[i] - (corners[0][i] - seen[i]) * 0.75 -
                                            (corners[1][i] - seen[i]) * 0.5;
                break;
            case 3: // a sliver: two corners lie close together
                corners[v][i] =
                    v == 1 ? corners[0][i] * (1.0 + random_real(random, -1.0, 1.0) * 0x1p-12)
                           : random_real(random, -1.0, 1.0) * size;
                break;
            case 4: // through the eye's plane: one corner in front of the eye, two beside or behind
                corners[v][i] = v == 0 ? seen[i] : random_real(random, -1.0, 1.0) * size;
                break;
            default: // a floor or a ceiling close to the eye
                corners[v][i] = i == 1 ? (v == 0 ? size * 0x1p-10 : corners[0][1])
                                       : random_real(random, -1.0, 1.0) * ldexp(1.0, high);
                break;
            }
        }
    }
}

// Sets a random rotation and position of the camera.
static void turn_camera(Random *random, DipPose *pose, double corners[3][3]) {
    double *q = pose->orientation;
    double length2 = 0.0;
    for (int i = 0; i < 4; i++) {
        q[i] = random_real(random, -1.0, 1.0);
        length2 += q[i] * q[i];
    }
    for (int i = 0; i < 4; i++) {
        q[i] /= sqrt(length2);
    }
    for (int v = 0; v < 3; v++) {
        const double *p = corners[v];
        // p + 2 q x (q x p + w p)
        const double a[3] = {q[1] * p[2] - q[2] * p[1] + q[3] * p[0],
                             q[2] * p[0] - q[0] * p[2] + q[3] * p[1],
                             q[0] * p[1] - q[1] * p[0] + q[3] * p[2]};
        const double turned[3] = {p[0] + 2.0 * (q[1] * a[2] - q[2] * a[1]),
                                  p[1] + 2.0 * (q[2] * a[0] - q[0] * a[2]),
                                  p[2] + 2.0 * (q[0] * a[1] - q[1] * a[0])};
        memcpy(corners[v], turned, sizeof turned);
    }
}

// Makes a scene of one triangle. corners receives the triangle's corners in camera space.
static void make_triangle(DipTestScene *scene, Random *random, int kind, double corners[3][3]) {
    static const float nears[] = {0.1f, 1e-2f, 1e-4f, 1e-6f};
    double world[3][3];
    dip_screen_begin(scene);
    scene->def.near_m = nears[random_int(random, 0, 3)];
    scene->pose.fov_y_deg = random_real(random, 20.0, 120.0);
    make_corners(random, kind, corners);
    memcpy(world, corners, sizeof world);
    if (random_int(random, 0, 1)) {
        turn_camera(random, &scene->pose, world);
    }
    const double offset = random_int(random, 0, 2) ? 0.0 : random_magnitude(random, -10, 20);
    const int material = dip_screen_add_white(scene);
    scene->materials[material].double_sided = random_int(random, 0, 3) > 0;
    const DipTestMesh mesh = dip_test_scene_add_mesh(scene, 3, 3, DIP_TEST_UV0, material);
    for (int v = 0; v < 3; v++) {
        mesh.indices[v] = (uint32_t)v;
        for (int i = 0; i < 3; i++) {
            mesh.positions[3 * v + i] = (float)(world[v][i] * 0.5);
        }
        // One coordinate is independent of the position, the other one proportional to it.
        mesh.uv0[2 * v] = (float)random_real(random, 0.0, 1.0);
        mesh.uv0[2 * v + 1] = mesh.positions[3 * v];
    }
    for (int i = 0; i < 3; i++) {
        scene->objects[0].transform[5 * i] = 2.0f;
        scene->objects[0].transform[4 * i + 3] = (float)offset;
        scene->pose.position_world[i] = (float)offset;
    }
}

// Finds the position of a random point of a triangle. Returns false if it is not in the picture.
static bool find_position(Random *random, const DipPose *pose, double corners[3][3],
                          double position[2]) {
    double p[3] = {0.0};
    for (int v = 0; v < 3; v++) {
        const double weight = ldexp(random_real(random, 0.5, 1.0), random_int(random, -20, 0));
        for (int i = 0; i < 3; i++) {
            p[i] += weight * corners[v][i];
        }
    }
    const double half_height = tan(pose->fov_y_deg * (3.14159265358979323846 / 360.0));
    position[0] = WIDTH * 0.5 + p[0] / -p[2] / half_height * (HEIGHT * 0.5);
    position[1] = HEIGHT * 0.5 - p[1] / -p[2] / half_height * (HEIGHT * 0.5);
    return p[2] < 0.0 && fabs(position[0] - WIDTH * 0.5) <= WIDTH * 0.5 &&
           fabs(position[1] - HEIGHT * 0.5) <= HEIGHT * 0.5;
}

// Compares one triangle at random positions of the picture and at random points of the triangle.
static void compare_triangle(Pair *pair, Random *random, double corners[3][3]) {
    for (int i = 0; i < POSITIONS; i++) {
        double position[2] = {random_real(random, 0.0, WIDTH), random_real(random, 0.0, HEIGHT)};
        if (i % 2 == 0 || find_position(random, &pair->scene->pose, corners, position)) {
            judge(pair, position[0], position[1]);
        }
    }
}

static void compare_random_triangles(bool rounded) {
    int covered[KINDS] = {0}, wrong[KINDS] = {0};
    int wrong_count = 0;
    Random random = {2026};
    for (int t = 0; t < TRIANGLES; t++) {
        DipTestScene scene;
        Pair pair = {0};
        double corners[3][3];
        make_triangle(&scene, &random, t % KINDS, corners);
        open_pair(&pair, &scene, rounded);
        compare_triangle(&pair, &random, corners);
        covered[t % KINDS] += pair.covered;
        wrong[t % KINDS] += pair.wrong;
        close_pair(&pair);
        dip_test_scene_free(&scene);
    }
    for (int k = 0; k < KINDS; k++) {
        print_message("kind %d: %d positions covered, %d wrong\n", k, covered[k], wrong[k]);
        wrong_count += wrong[k];
        // The narrow slivers are too thin for rounded positions.
        assert_true(covered[k] >= (rounded && k % (KINDS / 2) == 3 ? 0 : 100));
    }
    assert_int_equal(wrong_count, 0);
}

static void random_triangles_appear_where_rays_meet_them(void **state) {
    (void)state;
    compare_random_triangles(false);
}

static void rounding_moves_triangles_by_at_most_half_a_step(void **state) {
    (void)state;
    compare_random_triangles(true);
}

// Compares a scene at every pixel's centre.
static void compare_picture(const DipTestScene *scene, bool rounded) {
    Pair pair = {0};
    open_pair(&pair, scene, rounded);
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            judge(&pair, x + 0.5, y + 0.5);
        }
    }
    assert_int_equal(pair.wrong, 0);
    assert_true(pair.judged > WIDTH * HEIGHT * 9 / 10);
    close_pair(&pair);
}

static void huge_triangles_close_to_the_eye_are_not_bent(void **state) {
    (void)state;
    static const float scales[] = {1.0f, 1e5f, 1e9f};
    for (int k = 0; k < 3; k++) {
        DipTestScene scene;
        dip_test_scene_make(&scene, DIP_TEST_SCENE_cube_on_plane);
        scene.objects[1] = scene.objects[--scene.def.object_count]; // leaves out the decal
        for (int o = 0; o < scene.def.object_count; o++) {
            for (int i = 0; i < 12; i++) {
                scene.objects[o].transform[i] *= scales[k];
            }
        }
        compare_picture(&scene, false);
        compare_picture(&scene, true);
        dip_test_scene_free(&scene);
    }
}

static void a_floor_keeps_its_shape_however_near_the_near_plane_is(void **state) {
    (void)state;
    static const float nears[] = {0.1f, 1e-3f, 1e-6f, 1e-12f};
    for (int k = 0; k < 4; k++) {
        DipTestScene scene;
        dip_screen_begin(&scene);
        scene.def.near_m = nears[k];
        scene.pose.orientation[2] = sin(0.1);
        scene.pose.orientation[3] = cos(0.1);
        const float corner[3] = {-25.0f, -1.0f, 25.0f};
        const float right[3] = {50.0f, 0.0f, 0.0f};
        const float back[3] = {0.0f, 0.0f, -50.0f};
        dip_test_scene_add_quad(&scene, dip_screen_add_white(&scene), corner, right, back, 50.0f,
                                50.0f);
        compare_picture(&scene, false);
        compare_picture(&scene, true);
        dip_test_scene_free(&scene);
    }
}

// --- wide numbers --------------------------------------------------------------------------------

static DipQuad quad_of(DipWide a) {
    return (DipQuad)a.high + a.low;
}

static void assert_wide(DipWide value, DipQuad expected, DipQuad terms) {
    const DipQuad error = quad_of(value) - expected;
    assert_true((error < 0 ? -error : error) <= terms * 0x1p-102);
    assert_true(value.high + value.low == value.high);
}

static void wide_numbers_have_a_hundred_bits(void **state) {
    (void)state;
    Random random = {7};
    for (int i = 0; i < 100000; i++) {
        const DipWide a =
            dip_wide_sum(random_magnitude(&random, -100, 100), random_magnitude(&random, -160, 40));
        DipWide b =
            dip_wide_sum(random_magnitude(&random, -100, 100), random_magnitude(&random, -160, 40));
        if (i % 2) { // nearly cancels a
            b = dip_wide_add_double(dip_wide_negate(a), random_magnitude(&random, -180, 0));
        }
        const DipQuad x = quad_of(a), y = quad_of(b);
        const DipQuad sum = (x < 0 ? -x : x) + (y < 0 ? -y : y);
        assert_wide(dip_wide_add(a, b), x + y, sum);
        assert_wide(dip_wide_subtract(a, b), x - y, sum);
        assert_wide(dip_wide_add_double(a, b.high), x + b.high, sum);
        assert_wide(dip_wide_scale(a, b.high), x * b.high,
                    x * b.high < 0 ? -x * b.high : x * b.high);
        assert_wide(dip_wide_multiply(a, b), x * y, x * y < 0 ? -x * y : x * y);
        assert_wide(dip_wide_divide(a, b), x / y, x / y < 0 ? -x / y : x / y);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wide_numbers_have_a_hundred_bits),
        cmocka_unit_test(random_triangles_appear_where_rays_meet_them),
        cmocka_unit_test(rounding_moves_triangles_by_at_most_half_a_step),
        cmocka_unit_test(huge_triangles_close_to_the_eye_are_not_bent),
        cmocka_unit_test(a_floor_keeps_its_shape_however_near_the_near_plane_is),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
