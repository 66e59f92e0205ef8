// Rows about triangles that are cut: by the near plane, in the eye's plane, and at the guard band.
#include "renderer/base/trig.h"
#include "renderer/catalogue/random.h"
#include "renderer/catalogue/scenes.h"
#include "renderer/catalogue/pictures.h"

#include <math.h>
#include <string.h>

// The field of view is 90 degrees, so the ray through a position (x, y) in pixels is
// (x / (SIZE / 2) - 1, 1 - y / (SIZE / 2), -1).
enum { SIZE = 64, GUARD_PX = 16000 };

#define NEAR_M 0.1f

// Begins a scene of white triangles, both sides visible, in front of black.
static int begin_scene(DipTestScene *scene) {
    dip_test_scene_begin(scene);
    memset(scene->def.background_lin, 0, sizeof scene->def.background_lin);
    scene->def.near_m = NEAR_M;
    scene->pose.fov_y_deg = 90.0;
    const int white = dip_test_scene_add_material(scene, DIP_NO_TEXTURE);
    scene->materials[white].double_sided = true;
    return white;
}

static bool draw(StabilityRun *run, const DipTestScene *scene, const char *settings,
                 StabilityPicture *picture) {
    const StabilityShot shot = {.def = &scene->def,
                                .pose = &scene->pose,
                                .settings = settings,
                                .width = SIZE,
                                .height = SIZE};
    return stability_draw(run, &shot, picture);
}

// --- one triangle against rays -------------------------------------------------------------------

// A linear function over the picture, with its sign certain or not.
typedef struct Side {
    long double value;    // at the pixel
    long double distance; // from the pixel to the line where the function is 0, in pixels
    bool certain;
} Side;

// Sums value[k] * ray[k]. doubt[k] is the sum of magnitudes from which value[k] was computed.
static Side side_of(const long double value[3], const long double doubt[3],
                    const long double ray[3]) {
    long double sum = 0.0L;
    long double sum_doubt = 0.0L;
    for (int k = 0; k < 3; k++) {
        sum += value[k] * ray[k];
        sum_doubt += doubt[k] * fabsl(ray[k]);
    }
    const long double slope = hypotl(value[0], value[1]) * (2.0L / SIZE);
    return (Side){sum, slope > 0.0L ? fabsl(sum) / slope : INFINITY,
                  fabsl(sum) > 0x1p-40L * sum_doubt};
}

// A triangle as its four borders in the picture: three edges and the near plane.
typedef struct Borders {
    long double value[4][3];
    long double doubt[4][3];
    bool edge_on; // the eye may lie in the triangle's plane
} Borders;

// Edge i is the plane through the eye and the corners i and i + 1. The ray's direction d hits the
// triangle at t = volume / (sum of the edges' values), so t is at least `near` where volume -
// near * sum has the volume's sign. The ray's z is -1, so the constant becomes a factor of z.
static Borders find_borders(const float p[9]) {
    Borders borders = {.edge_on = false};
    long double volume = 0.0L;
    long double doubt = 0.0L;
    for (int i = 0; i < 3; i++) {
        const float *a = p + 3 * i;
        const float *b = p + 3 * ((i + 1) % 3);
        for (int k = 0; k < 3; k++) {
            const int l = (k + 1) % 3;
            const int m = (k + 2) % 3;
            const long double one = (long double)a[l] * b[m];
            const long double two = (long double)a[m] * b[l];
            borders.value[i][k] = one - two;
            borders.doubt[i][k] = fabsl(one) + fabsl(two);
        }
    }
    for (int k = 0; k < 3; k++) {
        volume += borders.value[0][k] * p[6 + k];
        doubt += borders.doubt[0][k] * fabsl(p[6 + k]);
    }
    borders.edge_on = !(fabsl(volume) > 0x1p-40L * doubt);
    const long double sign = volume < 0.0L ? -1.0L : 1.0L;
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 3; i++) {
            borders.value[i][k] *= sign;
            borders.value[3][k] -= (long double)NEAR_M * borders.value[i][k];
            borders.doubt[3][k] += (long double)NEAR_M * borders.doubt[i][k];
        }
    }
    borders.value[3][2] -= sign * volume;
    borders.doubt[3][2] += doubt;
    return borders;
}

// Returns how far, in pixels, a pixel that is wrongly covered or wrongly not covered lies from the
// triangle's border. Returns 0 if the pixel is right or cannot be judged.
static double misplaced(const Borders *borders, int x, int y, bool covered) {
    const long double ray[3] = {(2 * x + 1) / (long double)SIZE - 1.0L,
                                1.0L - (2 * y + 1) / (long double)SIZE, -1.0L};
    long double nearest = INFINITY;
    long double outside = 0.0L;
    for (int i = 0; i < 4; i++) {
        const Side side = side_of(borders->value[i], borders->doubt[i], ray);
        if (!side.certain) {
            return 0.0;
        }
        if (side.value < 0.0L) {
            outside = fmaxl(outside, side.distance);
        }
        nearest = fminl(nearest, side.distance);
    }
    const bool inside = outside == 0.0L;
    return inside == covered ? 0.0 : (double)(inside ? nearest : outside);
}

// Draws a triangle and compares its pixels with rays through their centres.
static void check_triangle(StabilityRun *run, const float positions[9], const char *what) {
    DipTestScene scene;
    const int white = begin_scene(&scene);
    const DipTestMesh mesh = dip_test_scene_add_mesh(&scene, 3, 3, 0, white);
    memcpy(mesh.positions, positions, 9 * sizeof *positions);
    for (uint32_t i = 0; i < 3; i++) {
        mesh.indices[i] = i;
    }
    const Borders borders = find_borders(positions);
    StabilityPicture picture;
    if (!borders.edge_on && draw(run, &scene, "aa=none", &picture)) {
        double worst = 0.0;
        for (int y = 0; y < SIZE; y++) {
            for (int x = 0; x < SIZE; x++) {
                const bool covered = picture.rgb_lin[3 * (y * SIZE + x)] > 0.5;
                worst = fmax(worst, misplaced(&borders, x, y, covered));
            }
        }
        const float *p = positions;
        stability_error(run, worst, "%s (%g,%g,%g) (%g,%g,%g) (%g,%g,%g)", what, (double)p[0],
                        (double)p[1], (double)p[2], (double)p[3], (double)p[4], (double)p[5],
                        (double)p[6], (double)p[7], (double)p[8]);
        stability_picture_free(&picture);
    }
    dip_test_scene_free(&scene);
}

static void measure_near_plane(StabilityRun *run) {
    Random random = {run->seed};
    const int count = stability_count(run, 4, 400, 60000);
    for (int n = 0; n < count; n++) {
        float positions[9];
        for (int i = 0; i < 9; i++) {
            positions[i] = (float)random_real(&random, -4.0, i % 3 == 2 ? 1.5 : 4.0);
        }
        check_triangle(run, positions, "across the near plane");
    }
}

static void measure_eye_plane(StabilityRun *run) {
    const float depths[] = {NEAR_M,
                            nextafterf(NEAR_M, 0.0f),
                            nextafterf(NEAR_M, 1.0f),
                            0.0f,
                            -0.0f,
                            1e-38f,
                            -1e-38f,
                            1e-6f,
                            -1e-6f,
                            0x1p-20f,
                            0.2f,
                            3.0f,
                            -3.0f};
    enum { DEPTHS = sizeof depths / sizeof *depths };
    Random random = {run->seed + 1};
    const int count = stability_count(run, 4, 400, 60000);
    for (int n = 0; n < count; n++) {
        float positions[9];
        for (int i = 0; i < 3; i++) {
            const double size = random_magnitude(&random, -10, 33);
            positions[3 * i] = (float)random_real(&random, -size, size);
            positions[3 * i + 1] = (float)random_real(&random, -size, size);
            positions[3 * i + 2] = -depths[random_int(&random, 0, DEPTHS - 1)];
        }
        check_triangle(run, positions, "at the near plane or the eye");
    }
}

static void measure_magnitudes(StabilityRun *run) {
    Random random = {run->seed + 2};
    const int count = stability_count(run, 4, 400, 60000);
    for (int n = 0; n < count; n++) {
        float positions[9];
        for (int i = 0; i < 3; i++) {
            const double size = random_magnitude(&random, -10, 33);
            for (int k = 0; k < 3; k++) {
                positions[3 * i + k] = (float)random_real(&random, -size, size);
            }
        }
        check_triangle(run, positions, "of mixed magnitudes");
    }
}

// --- surfaces without gaps -----------------------------------------------------------------------

// Adds the triangles to two meshes in turn, so that every edge between them joins two meshes.
static void add_alternately(DipTestScene *scene, int material, const float *positions,
                            uint32_t vertex_count, const uint32_t *indices, uint32_t index_count) {
    for (uint32_t half = 0; half < 2; half++) {
        const uint32_t triangles = (index_count / 3 + 1 - half) / 2;
        const DipTestMesh mesh =
            dip_test_scene_add_mesh(scene, vertex_count, 3 * triangles, 0, material);
        memcpy(mesh.positions, positions, 3 * vertex_count * sizeof *positions);
        for (uint32_t t = 0; t < triangles; t++) {
            memcpy(mesh.indices + 3 * t, indices + 3 * (2 * t + half), 3 * sizeof *indices);
        }
    }
}

// Counts the pixels that are not wholly covered.
static void check_covered(StabilityRun *run, const DipTestScene *scene, const char *what,
                          double size) {
    StabilityPicture picture;
    if (draw(run, scene, "aa=8", &picture)) {
        int gaps = 0;
        for (int i = 0; i < SIZE * SIZE; i++) {
            gaps += picture.rgb_lin[3 * i] < 1.0;
        }
        stability_error(run, gaps, "%s %g", what, size);
        stability_picture_free(&picture);
    }
}

// Places a point at a position in pixels and at a distance along the view axis.
static void place(double x_px, double y_px, double w, float position[3]) {
    position[0] = (float)((x_px / (SIZE / 2) - 1.0) * w);
    position[1] = (float)((1.0 - y_px / (SIZE / 2)) * w);
    position[2] = (float)-w;
}

// A fan around a point. Its other corners lie exactly on the guard band's borders, or one float
// beside them.
static void measure_guard_band(StabilityRun *run) {
    enum { RING = 8 };
    static const int side[RING][2] = {{-1, -1}, {0, -1}, {1, -1}, {1, 0},
                                      {1, 1},   {0, 1},  {-1, 1}, {-1, 0}};
    Random random = {run->seed + 3};
    const int count = stability_count(run, 4, 300, 20000);
    for (int n = 0; n < count; n++) {
        DipTestScene scene;
        const int white = begin_scene(&scene);
        float positions[3 * (RING + 1)];
        uint32_t indices[3 * RING];
        for (int i = 0; i < RING; i++) {
            float *p = positions + 3 * i;
            place(GUARD_PX * side[i][0], GUARD_PX * side[i][1],
                  ldexp(1.0, random_int(&random, -3, 1)), p);
            const int axis = random_int(&random, 0, 1);
            const int step = random_int(&random, -1, 1);
            p[axis] = step ? nextafterf(p[axis], (float)step * INFINITY) : p[axis];
            indices[3 * i] = RING;
            indices[3 * i + 1] = (uint32_t)i;
            indices[3 * i + 2] = (uint32_t)((i + 1) % RING);
        }
        // The hub lies such that one of its edges crosses the picture.
        const int *ring = side[random_int(&random, 0, RING - 1)];
        const double far = random_real(&random, 0.0, 0.95);
        double hub[2];
        for (int k = 0; k < 2; k++) {
            const double crossed = random_real(&random, 0.0, SIZE);
            hub[k] = crossed + far * (crossed - GUARD_PX * ring[k]);
        }
        place(hub[0], hub[1], random_real(&random, 0.125, 2.0), positions + 3 * RING);
        add_alternately(&scene, white, positions, RING + 1, indices, 3 * RING);
        check_covered(run, &scene, "fan", n);
        dip_test_scene_free(&scene);
    }
}

enum { RINGS = 2, SECTORS = 3, STAR = RINGS * SECTORS + 2 };

// Makes a closed surface around the point `eye`: two poles and rings of vertices between them, each
// at a random distance from 1 m to 2^(reach + 1) m.
static uint32_t make_star(Random *random, int reach, const double eye[3], float positions[3 * STAR],
                          uint32_t indices[6 * RINGS * SECTORS]) {
    static const double pi = 3.14159265358979323846;
    for (int v = 0; v < STAR; v++) {
        const int ring = v < STAR - 2 ? v / SECTORS + 1 : (v - STAR + 2) * (RINGS + 1);
        const double polar = pi * ring / (RINGS + 1);
        const double angle = 2.0 * pi * (v % SECTORS) / SECTORS;
        const double direction[3] = {dip_sin(polar) * dip_cos(angle), dip_cos(polar),
                                     dip_sin(polar) * dip_sin(angle)};
        const double distance = random_magnitude(random, 0, reach);
        for (int k = 0; k < 3; k++) {
            positions[3 * v + k] = (float)(eye[k] + distance * direction[k]);
        }
    }
    uint32_t count = 0;
    for (uint32_t ring = 0; ring <= RINGS; ring++) {
        for (uint32_t s = 0; s < SECTORS; s++) {
            const uint32_t next = (s + 1) % SECTORS;
            const uint32_t above = ring ? (ring - 1) * SECTORS : 0;
            const uint32_t corner[4] = {ring ? above + s : STAR - 2, ring ? above + next : STAR - 2,
                                        ring < RINGS ? ring * SECTORS + s : STAR - 1,
                                        ring < RINGS ? ring * SECTORS + next : STAR - 1};
            if (ring < RINGS) {
                const uint32_t below[3] = {corner[0], corner[2], corner[3]};
                memcpy(indices + count, below, sizeof below);
                count += 3;
            }
            if (ring) {
                const uint32_t over[3] = {corner[0], corner[3], corner[1]};
                memcpy(indices + count, over, sizeof over);
                count += 3;
            }
        }
    }
    return count;
}

static void measure_closed(StabilityRun *run) {
    Random random = {run->seed + 4};
    const int count = stability_count(run, 4, 300, 20000);
    for (int n = 0; n < count; n++) {
        DipTestScene scene;
        const int white = begin_scene(&scene);
        const int reach = random_int(&random, 0, 39);
        float positions[3 * STAR];
        uint32_t indices[6 * RINGS * SECTORS];
        double length2 = 0.0;
        for (int k = 0; k < 3; k++) {
            scene.pose.position_world[k] = n % 2 ? random_real(&random, -1e5, 1e5) : 0.0;
        }
        for (int k = 0; k < 4; k++) {
            scene.pose.orientation[k] = random_real(&random, -1.0, 1.0);
            length2 += scene.pose.orientation[k] * scene.pose.orientation[k];
        }
        for (int k = 0; k < 4; k++) {
            scene.pose.orientation[k] /= sqrt(length2);
        }
        const uint32_t index_count =
            make_star(&random, reach, scene.pose.position_world, positions, indices);
        add_alternately(&scene, white, positions, STAR, indices, index_count);
        check_covered(run, &scene, "closed surface that reaches", reach);
        dip_test_scene_free(&scene);
    }
}

static const StabilityRow rows[] = {
    {.id = "N1",
     .promise = "A triangle that crosses the near plane covers the pixels that its part beyond the "
                "plane covers.",
     .truth = "rays through the pixels, in `long double`",
     .unit = "pixels from the border",
     .bound = 0.01,
     .per_isa = true,
     .measure = measure_near_plane},
    {.id = "N2",
     .promise = "A triangle with corners exactly on the near plane, in the eye's plane, or one "
                "float beside them covers the right pixels.",
     .truth = "rays through the pixels, in `long double`",
     .unit = "pixels from the border",
     .bound = 0.01,
     .per_isa = true,
     .measure = measure_eye_plane},
    {.id = "N5",
     .promise =
         "A triangle whose corners mix magnitudes from 1e-3 m to 1e10 m covers the right pixels.",
     .truth = "rays through the pixels, in `long double`",
     .unit = "pixels from the border",
     .bound = 0.02,
     .per_isa = true,
     .measure = measure_magnitudes},
    {.id = "N6",
     .promise = "A fan of two meshes whose corners lie exactly on the guard band's borders, or one "
                "float beside them, has no gap.",
     .truth = "a fan that surrounds the picture leaves no background",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_guard_band},
    {.id = "N11",
     .promise = "A closed surface around the eye, of two meshes with edges of 1 m to 1e12 m, has "
                "no gap where it is cut or where the meshes join, up to 100 km from the origin.",
     .truth = "a closed surface leaves no background",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_closed},
};

const StabilityTopic stability_clipping = {"clipping", "Triangles that are cut", rows,
                                           sizeof rows / sizeof *rows};
