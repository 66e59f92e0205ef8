// Rows about the reference renderer's geometry. They compare it with a ray cast in 128-bit floating
// point, on triangles whose coordinates differ by many orders of magnitude.
#include "renderer/base/trig.h"
#include "renderer/reference/internal/internal.h"
#include "renderer/reference/internal/wide.h"
#include "renderer/catalogue/random.h"
#include "renderer/catalogue/scenes.h"
#include "renderer/catalogue/raycast.h"
#include "renderer/catalogue/stability.h"

#include <math.h>
#include <string.h>

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

static void close_pair(Pair *pair) {
    dip_raycast_free(&pair->raycast);
    dip_reference_triangles_free(&pair->triangles);
    dip_reference_destroy(&pair->reference);
}

static bool open_pair(StabilityRun *run, Pair *pair, const DipTestScene *scene, bool rounded) {
    DipError err = {0};
    *pair = (Pair){.scene = scene};
    pair->margin_px = rounded ? ROUNDED_PX : EXACT_PX;
    pair->reference = dip_reference_create_for_truth(&scene->def, NULL, &err);
    const DipRefShot shot = {&scene->pose, WIDTH, HEIGHT, (double)WIDTH / HEIGHT,
                             .rounded = rounded};
    if (!pair->reference ||
        !dip_reference_build_triangles(pair->reference, &shot, &pair->triangles, &err) ||
        !dip_raycast_init(&pair->raycast, &scene->def, &scene->pose, WIDTH, HEIGHT)) {
        stability_break(run, "no picture: %s", err.message);
        close_pair(pair);
        return false;
    }
    return true;
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

// Returns the error that rounding in the edge functions may cause in the sum of the corners'
// values, weighted by the edge functions. Each edge function is right within 2^-34 pixel times the
// edge's length. In slivers, this is much compared with the area.
static double sliver_tolerance(const DipRefPosition *place, const double values[3]) {
    const DipRefVertex *v = place->triangle->vertices;
    double sum = 0.0;
    for (int i = 0; i < 3; i++) {
        const DipRefVertex *from = &v[(i + 1) % 3], *to = &v[(i + 2) % 3];
        sum += hypot(to->x - from->x, to->y - from->y) * fabs(values[i]);
    }
    return 256.0 * 0x1p-34 * sum / place->triangle->area;
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
    return 0x1p-24 * (1.0 + 1.0 / height_px + steepness) *
               (fabs(value[1]) + fabs(value[2]) + 2.0 * fabs(value[0]) * steepness) +
           0x1p-47 * 256.0 * terms / weights;
}

static bool is_near(double value, double expected, double tolerance) {
    return fabs(value - expected) <= tolerance; // false for a NaN
}

static bool shows_depth(const Pair *pair, const DipRefPosition *place, double depth,
                        const DipRayHit *hit) {
    const DipRefVertex *v = place->triangle->vertices;
    const double near_m = pair->scene->def.near_m;
    const double values[3] = {v[0].inv_w, v[1].inv_w, v[2].inv_w};
    const double tolerance = (fabs(hit->inv_w[1]) + fabs(hit->inv_w[2])) * pair->margin_px +
                             0x1p-44 * hit->inv_w[0] + sliver_tolerance(place, values);
    return is_near(depth, near_m * hit->inv_w[0], near_m * tolerance);
}

// Compares a texture coordinate. *value is the truth: the coordinate and its derivatives.
static bool shows_coordinate(const Pair *pair, const DipRefPosition *place,
                             const DipRefVaryings *varyings, int k, const double value[3],
                             const double inv_w[3]) {
    double values[3];
    for (int i = 0; i < 3; i++) {
        const DipRefVertex *vertex = &place->triangle->vertices[i];
        values[i] = vertex->inv_w / inv_w[0] * (vertex->varyings[k] - value[0]);
    }
    const double tolerance = tolerance_of(value, inv_w, pair->margin_px) +
                             0x1p-44 * terms_of(place, k) + sliver_tolerance(place, values);
    if (pair->margin_px != EXACT_PX) {
        return is_near(varyings->value[k], value[0], tolerance);
    }
    const double gradient = gradient_tolerance(place, k, value, inv_w);
    return is_near(varyings->value[k], value[0], tolerance) &&
           is_near(varyings->ddx[k], value[1], gradient) &&
           is_near(varyings->ddy[k], value[2], gradient);
}

static bool shows_hit(const Pair *pair, const DipRefPosition *place, double depth,
                      const DipRayHit *hit) {
    DipRefVaryings varyings;
    dip_reference_interpolate(place, DIP_REF_U0, 2, true, &varyings);
    return shows_depth(pair, place, depth, hit) &&
           shows_coordinate(pair, place, &varyings, DIP_REF_U0, hit->u, hit->inv_w) &&
           shows_coordinate(pair, place, &varyings, DIP_REF_V0, hit->v, hit->inv_w);
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

// Returns a number of either sign whose binary exponent lies in low..high.
static double random_signed(Random *random, int low, int high) {
    const double magnitude = random_magnitude(random, low, high);
    return random_int(random, 0, 1) ? magnitude : -magnitude;
}

enum {
    POSITIONS = 48, // positions that are compared, per triangle
    KINDS = 12      // kinds of triangles: six, with exponents in -20..30 or in -60..60
};

// Makes the corners of a triangle relative to the eye, looking along -Z.
static void make_corners(Random *random, int kind, double corners[3][3]) {
    const bool wider = kind >= KINDS / 2;
    const int low = wider ? -60 : -20, high = wider ? 60 : 30;
    const double middle = random_magnitude(random, low, high);
    double seen[3] = {0.0, 0.0, -middle};
    seen[0] = random_real(random, -0.6, 0.6) * middle;
    seen[1] = random_real(random, -0.5, 0.5) * middle;
    for (int v = 0; v < 3; v++) {
        const double size = random_signed(random, low, high);
        for (int i = 0; i < 3; i++) {
            switch (kind % (KINDS / 2)) {
            case 0: // every coordinate has a magnitude of its own
                corners[v][i] = random_signed(random, low, high);
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
    dip_test_scene_begin(scene);
    scene->def.near_m = nears[random_int(random, 0, 3)];
    scene->pose.fov_y_deg = random_real(random, 20.0, 120.0);
    make_corners(random, kind, corners);
    memcpy(world, corners, sizeof world);
    if (random_int(random, 0, 1)) {
        turn_camera(random, &scene->pose, world);
    }
    const double offset = random_int(random, 0, 2) ? 0.0 : random_signed(random, -10, 20);
    const int material = dip_test_scene_add_material(scene, DIP_NO_TEXTURE);
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
        const double weight = random_magnitude(random, -21, -1);
        for (int i = 0; i < 3; i++) {
            p[i] += weight * corners[v][i];
        }
    }
    const double half_height = dip_tan(pose->fov_y_deg * (3.14159265358979323846 / 360.0));
    position[0] = WIDTH * 0.5 + p[0] / -p[2] / half_height * (HEIGHT * 0.5);
    position[1] = HEIGHT * 0.5 - p[1] / -p[2] / half_height * (HEIGHT * 0.5);
    return p[2] < 0.0 && fabs(position[0] - WIDTH * 0.5) <= WIDTH * 0.5 &&
           fabs(position[1] - HEIGHT * 0.5) <= HEIGHT * 0.5;
}

// Compares one triangle at random positions of the picture and at random points of the triangle.
static void compare_triangle(Pair *pair, Random *random, double corners[3][3]) {
    for (int i = 0; i < POSITIONS; i++) {
        double position[2];
        position[0] = random_real(random, 0.0, WIDTH);
        position[1] = random_real(random, 0.0, HEIGHT);
        if (i % 2 == 0 || find_position(random, &pair->scene->pose, corners, position)) {
            judge(pair, position[0], position[1]);
        }
    }
}

static void compare_random_triangles(StabilityRun *run, bool rounded) {
    static DipTestScene scene;
    Random random = {run->seed};
    const int count = stability_count(run, 240, 10000, 300000);
    int covered = 0;
    for (int t = 0; t < count; t++) {
        Pair pair;
        double corners[3][3];
        make_triangle(&scene, &random, t % KINDS, corners);
        if (open_pair(run, &pair, &scene, rounded)) {
            compare_triangle(&pair, &random, corners);
            stability_keep(run, (double[]){pair.judged, pair.covered}, 2);
            stability_error(run, pair.wrong, "triangle %d of seed %llu, kind %d", t,
                            (unsigned long long)run->seed, t % KINDS);
            covered += pair.covered;
            close_pair(&pair);
        }
        dip_test_scene_free(&scene);
    }
    stability_expect(run, covered > count, "only %d positions on triangles", covered);
}

static void measure_random_triangles(StabilityRun *run) {
    compare_random_triangles(run, false);
}

static void measure_rounded_triangles(StabilityRun *run) {
    compare_random_triangles(run, true);
}

// Compares a scene at every pixel's centre.
static void compare_picture(StabilityRun *run, const DipTestScene *scene, const char *what,
                            double value) {
    for (int rounded = 0; rounded < 2; rounded++) {
        Pair pair;
        if (!open_pair(run, &pair, scene, rounded)) {
            return;
        }
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            judge(&pair, i % WIDTH + 0.5, i / WIDTH + 0.5);
        }
        stability_error(run, pair.wrong, "%s %g%s", what, value, rounded ? ", rounded" : "");
        stability_expect(run, pair.judged > WIDTH * HEIGHT * 9 / 10, "%s %g: %d positions judged",
                         what, value, pair.judged);
        close_pair(&pair);
    }
}

static void measure_huge_triangles(StabilityRun *run) {
    static const float scales[] = {1e5f, 1.0f, 1e9f};
    static DipTestScene scene;
    const int count = stability_count(run, 1, 3, 3);
    for (int k = 0; k < count; k++) {
        dip_test_scene_make(&scene, DIP_TEST_SCENE_cube_on_plane);
        scene.objects[1] = scene.objects[--scene.def.object_count]; // leaves out the decal
        for (int o = 0; o < scene.def.object_count; o++) {
            for (int i = 0; i < 12; i++) {
                scene.objects[o].transform[i] *= scales[k];
            }
        }
        compare_picture(run, &scene, "cube on a plane times", scales[k]);
        dip_test_scene_free(&scene);
    }
}

static void measure_floor(StabilityRun *run) {
    static const float nears[] = {1e-6f, 0.1f, 1e-3f, 1e-12f};
    static DipTestScene scene;
    const int count = stability_count(run, 1, 4, 4);
    for (int k = 0; k < count; k++) {
        dip_test_scene_begin(&scene);
        scene.def.near_m = nears[k];
        scene.pose.orientation[2] = dip_sin(0.1);
        scene.pose.orientation[3] = dip_cos(0.1);
        const int material = dip_test_scene_add_material(&scene, DIP_NO_TEXTURE);
        const float corner[3] = {-25.0f, -1.0f, 25.0f};
        const float right[3] = {50.0f, 0.0f, 0.0f};
        const float back[3] = {0.0f, 0.0f, -50.0f};
        dip_test_scene_add_quad(&scene, material, corner, right, back, 50.0f, 50.0f);
        compare_picture(run, &scene, "near plane at", nears[k]);
        dip_test_scene_free(&scene);
    }
}

// --- lengths of orientations ---------------------------------------------------------------------

static bool same_triangles(const DipRefTriangles *a, const DipRefTriangles *b) {
    bool same = a->count == b->count;
    for (size_t t = 0; same && t < a->count; t++) {
        same = memcmp(a->items[t].vertices, b->items[t].vertices, sizeof a->items[t].vertices) == 0;
    }
    return same;
}

static void measure_orientations(StabilityRun *run) {
    static const int exponents[] = {-1000, -600, 600, 1000};
    static DipTestScene scene, scaled;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_cube_on_plane);
    dip_test_scene_make(&scaled, DIP_TEST_SCENE_cube_on_plane);
    Pair pair, other;
    const bool opened = open_pair(run, &pair, &scene, true);
    for (int k = 0; opened && k < 4; k++) {
        for (int i = 0; i < 4; i++) {
            scaled.pose.orientation[i] = ldexp(scene.pose.orientation[i], exponents[k]);
        }
        if (open_pair(run, &other, &scaled, true)) {
            stability_expect(run, same_triangles(&pair.triangles, &other.triangles),
                             "quaternion times 2^%d", exponents[k]);
            close_pair(&other);
        }
    }
    if (opened) {
        close_pair(&pair);
    }
    dip_test_scene_free(&scaled);
    dip_test_scene_free(&scene);
}

// --- wide numbers --------------------------------------------------------------------------------

static DipQuad quad_of(DipWide a) {
    return (DipQuad)a.high + a.low;
}

static DipQuad size_of(DipQuad a) {
    return a < 0 ? -a : a;
}

// Keeps the error of a result, relative to the sum of the magnitudes of its terms.
static void check_wide(StabilityRun *run, DipWide value, DipQuad expected, DipQuad terms,
                       const char *operation) {
    stability_keep(run, (double[]){value.high, value.low}, 2);
    stability_error(run, (double)(size_of(quad_of(value) - expected) / terms), "%s", operation);
    stability_expect(run, value.high + value.low == value.high, "%s is not in lowest terms",
                     operation);
}

static DipWide random_wide(Random *random) {
    const double high = random_signed(random, -100, 100);
    return dip_wide_sum(high, random_signed(random, -160, 40));
}

static void measure_wide_numbers(StabilityRun *run) {
    Random random = {run->seed};
    const int count = stability_count(run, 2000, 100000, 10000000);
    for (int i = 0; i < count; i++) {
        const DipWide a = random_wide(&random);
        DipWide b = random_wide(&random);
        if (i % 2) { // nearly cancels a
            b = dip_wide_add_double(dip_wide_negate(a), random_signed(&random, -180, 0));
        }
        const DipQuad x = quad_of(a), y = quad_of(b), terms = size_of(x) + size_of(y);
        check_wide(run, dip_wide_add(a, b), x + y, terms, "sum");
        check_wide(run, dip_wide_subtract(a, b), x - y, terms, "difference");
        check_wide(run, dip_wide_add_double(a, b.high), x + b.high, terms, "sum with a double");
        check_wide(run, dip_wide_scale(a, b.high), x * b.high, size_of(x * b.high),
                   "product with a double");
        check_wide(run, dip_wide_multiply(a, b), x * y, size_of(x * y), "product");
        check_wide(run, dip_wide_divide(a, b), x / y, size_of(x / y), "quotient");
    }
}

#define RAY_CAST "a ray cast in 128-bit floats, without projection, clipping or rounding"

static const StabilityRow rows[] = {
    {.id = "A47",
     .promise =
         "The reference's converged picture shows random triangles with coordinates from "
         "2^-60 to 2^60 where they are: coverage, depth, coordinates and derivatives are "
         "right within 2^-20 pixel. In slivers, rounding adds an error of 2^-34 pixel divided "
         "by the sliver's height.",
     .truth = RAY_CAST,
     .unit = "positions",
     .measure = measure_random_triangles},
    {.id = "A48",
     .promise = "With positions rounded to 1/256 pixel, the same triangles move by at most 1/512 "
                "pixel along each axis, wherever they are cut.",
     .truth = RAY_CAST,
     .unit = "positions",
     .measure = measure_rounded_triangles},
    {.id = "A49",
     .promise = "The reference does not bend triangles of up to 1e11 m close to the eye.",
     .truth = RAY_CAST,
     .unit = "positions",
     .measure = measure_huge_triangles},
    {.id = "A50",
     .promise = "In the reference, a floor of 50 m keeps its shape with a near plane at 0.1 m to "
                "1e-12 m.",
     .truth = RAY_CAST,
     .unit = "positions",
     .measure = measure_floor},
    {.id = "A51",
     .promise = "A quaternion times a power of two gives the reference the same triangles to the "
                "bit.",
     .truth = "the triangles with a quaternion of length 1",
     .unit = "pictures",
     .measure = measure_orientations},
    {.id = "A52",
     .promise = "The reference's double-double arithmetic is right to 102 bits.",
     .truth = "128-bit floats",
     .unit = "relative",
     .bound = 0x1p-102,
     .measure = measure_wide_numbers},
};

const StabilityTopic stability_reference = {"reference", "Geometry of the reference", rows,
                                            sizeof rows / sizeof *rows};
