// Rows about triangles: which samples they cover, and which surface is in front.
#include "renderer/pipeline/pattern.h"
#include "renderer/catalogue/oracle.h"
#include "renderer/catalogue/random.h"
#include "renderer/catalogue/scenes.h"
#include "renderer/catalogue/pictures.h"

#include <math.h>
#include <string.h>

// The picture is SIDE pixels wide and high, with a field of view of 90 degrees. A vertex at
// ((x / HALF - 1) w, (1 - y / HALF) w, -w) appears at the position (x, y) in pixels. This is exact
// in float if x and y are multiples of 1/256 pixel and w is a power of two.
enum { SIDE = 64, HALF = SIDE / 2, STEPS = 256 };

static const DipOracleRegion whole = {0, 0, SIDE, SIDE};

// --- scenes of exact triangles ----------------------------------------------------------------

static void begin(DipTestScene *scene) {
    dip_test_scene_begin(scene);
    memset(scene->def.background_lin, 0, sizeof scene->def.background_lin);
    scene->def.near_m = 1.0f / 16.0f;
    scene->pose.fov_y_deg = 90.0;
}

static int add_colour(DipTestScene *scene, float red, float green, float blue) {
    const int material = dip_test_scene_add_material(scene, DIP_NO_TEXTURE);
    const float colour[3] = {red, green, blue};
    memcpy(scene->materials[material].base_colour_lin, colour, sizeof colour);
    scene->materials[material].double_sided = true;
    return material;
}

// Puts a vertex at a position in steps of 1/256 pixel, at a distance that is a power of two.
static void put_vertex(const DipTestMesh *mesh, uint32_t index, double x, double y, double w) {
    mesh->positions[3 * index] = (float)((x / (HALF * STEPS) - 1.0) * w);
    mesh->positions[3 * index + 1] = (float)((1.0 - y / (HALF * STEPS)) * w);
    mesh->positions[3 * index + 2] = (float)-w;
}

// Adds triangles, each with vertices of its own. The distances of the three corners are w, 2 w and
// 4 w, so that the triangles are in perspective.
static void add_triangles(DipTestScene *scene, int material, const DipOracleTriangle *triangles,
                          int count, double w) {
    const DipTestMesh mesh =
        dip_test_scene_add_mesh(scene, 3 * (uint32_t)count, 3 * (uint32_t)count, 0, material);
    for (uint32_t i = 0; i < 3 * (uint32_t)count; i++) {
        put_vertex(&mesh, i, triangles[i / 3].x[i % 3], triangles[i / 3].y[i % 3],
                   ldexp(w, (int)(i % 3)));
        mesh.indices[i] = i;
    }
}

static StabilityShot shot_of(const DipTestScene *scene, const char *settings) {
    return (StabilityShot){.def = &scene->def,
                           .pose = &scene->pose,
                           .settings = settings,
                           .width = SIDE,
                           .height = SIDE};
}

static bool draw(StabilityRun *run, const DipTestScene *scene, const char *settings,
                 StabilityPicture *picture) {
    const StabilityShot shot = shot_of(scene, settings);
    return stability_draw(run, &shot, picture);
}

// --- coverage against exact integers ----------------------------------------------------------

static int count_bits(uint8_t mask) {
    int count = 0;
    for (; mask; mask &= (uint8_t)(mask - 1)) {
        count++;
    }
    return count;
}

// Returns the number of pixels in which a white triangle on black is not as bright as the number
// of its samples says. Half a code of sRGB is the tolerance.
static double wrong_pixels(const StabilityPicture *picture, const uint8_t *masks, int samples) {
    double wrong = 0.0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double expected = count_bits(masks[i]) / (double)samples;
        wrong += !(fabs(picture->rgb_lin[3 * i] - expected) <= 0.0046);
    }
    return wrong;
}

static const struct {
    const char *settings;
    int count;
} sampling[] = {{"aa=none", 1}, {"aa=2", 2}, {"aa=4", 4}, {"aa=6", 6}, {"aa=8", 8}};

// Draws one triangle with every sample pattern and compares it with the oracle.
static void compare_triangle(StabilityRun *run, const DipOracleTriangle *triangle,
                             const char *kind) {
    static DipTestScene scene;
    static uint8_t masks[SIDE * SIDE];
    begin(&scene);
    add_triangles(&scene, add_colour(&scene, 1.0f, 1.0f, 1.0f), triangle, 1, 1.0);
    for (size_t s = 0; s < sizeof sampling / sizeof *sampling; s++) {
        StabilityPicture picture;
        const DipSamplePattern *pattern = dip_sample_pattern(sampling[s].count);
        memset(masks, 0, sizeof masks);
        dip_oracle_cover(triangle, pattern, &whole, masks);
        if (draw(run, &scene, sampling[s].settings, &picture)) {
            stability_error(run, wrong_pixels(&picture, masks, pattern->count),
                            "%s (%d %d) (%d %d) (%d %d) with %s", kind, triangle->x[0],
                            triangle->y[0], triangle->x[1], triangle->y[1], triangle->x[2],
                            triangle->y[2], sampling[s].settings);
            stability_picture_free(&picture);
        }
    }
    dip_test_scene_free(&scene);
}

static void compare_kind(StabilityRun *run, DipOracleKind kind) {
    Random random = {run->seed};
    const DipSamplePattern *pattern = dip_sample_pattern(8);
    const int count = stability_count(run, 4, 60, 5000);
    for (int i = 0; i < count; i++) {
        const DipOracleTriangle triangle = dip_oracle_make(kind, &random, pattern, &whole, 1 << 20);
        compare_triangle(run, &triangle, dip_oracle_kind_name(kind));
    }
}

static void measure_slivers(StabilityRun *run) {
    compare_kind(run, DIP_ORACLE_sliver);
    compare_kind(run, DIP_ORACLE_flat);
}

static void measure_edges_on_samples(StabilityRun *run) {
    compare_kind(run, DIP_ORACLE_through_samples);
    compare_kind(run, DIP_ORACLE_axis_aligned);
}

static void measure_sample_boxes(StabilityRun *run) {
    compare_kind(run, DIP_ORACLE_small);
    compare_kind(run, DIP_ORACLE_large);
    compare_kind(run, DIP_ORACLE_on_samples);
}

// Every sample of the picture lies in exactly one triangle of the fan. The triangles are drawn one
// at a time, so that a sample that two of them cover is noticed.
static void measure_fans(StabilityRun *run) {
    static DipTestScene scene;
    static double sum[SIDE * SIDE];
    Random random = {run->seed};
    const int count = stability_count(run, 2, 40, 2000);
    for (int i = 0; i < count; i++) {
        const size_t s = (size_t)i % (sizeof sampling / sizeof *sampling);
        DipOracleTriangle fan[DIP_ORACLE_FAN];
        dip_oracle_make_fan(&random, dip_sample_pattern(sampling[s].count), &whole, fan);
        memset(sum, 0, sizeof sum);
        for (int t = 0; t < DIP_ORACLE_FAN; t++) {
            StabilityPicture picture;
            begin(&scene);
            add_triangles(&scene, add_colour(&scene, 1.0f, 1.0f, 1.0f), &fan[(t + i) % 8], 1, 1.0);
            if (draw(run, &scene, sampling[s].settings, &picture)) {
                for (int p = 0; p < SIDE * SIDE; p++) {
                    sum[p] += rint(picture.rgb_lin[3 * p] * sampling[s].count);
                }
                stability_picture_free(&picture);
            }
            dip_test_scene_free(&scene);
        }
        double wrong = 0.0;
        for (int p = 0; p < SIDE * SIDE; p++) {
            wrong += sum[p] != sampling[s].count;
        }
        stability_error(run, wrong, "fan %d with %s", i, sampling[s].settings);
    }
}

// Positions between the steps of 1/256 pixel decide nothing: only the rounded ones do. The
// positions stay away from halves, where rounding could go either way.
static void measure_rounded_area(StabilityRun *run) {
    static DipTestScene scene;
    static uint8_t masks[SIDE * SIDE];
    Random random = {run->seed};
    const int count = stability_count(run, 20, 400, 20000);
    for (int i = 0; i < count; i++) {
        double x[3];
        double y[3];
        DipOracleTriangle rounded;
        for (int k = 0; k < 3; k++) {
            rounded.x[k] = random_int(&random, -SIDE * STEPS / 8, SIDE * STEPS);
            rounded.y[k] = k ? rounded.y[0] + random_int(&random, -1, 1)
                             : random_int(&random, 0, SIDE * STEPS);
            x[k] = rounded.x[k] + random_real(&random, -0.4, 0.4);
            y[k] = rounded.y[k] + random_real(&random, -0.4, 0.4);
        }
        begin(&scene);
        const DipTestMesh mesh =
            dip_test_scene_add_mesh(&scene, 3, 3, 0, add_colour(&scene, 1.0f, 1.0f, 1.0f));
        for (uint32_t k = 0; k < 3; k++) {
            put_vertex(&mesh, k, x[k], y[k], 1.0);
            mesh.indices[k] = k;
        }
        StabilityPicture picture;
        memset(masks, 0, sizeof masks);
        dip_oracle_cover(&rounded, dip_sample_pattern(8), &whole, masks);
        if (draw(run, &scene, "aa=8", &picture)) {
            stability_error(run, wrong_pixels(&picture, masks, 8), "triangle %d", i);
            stability_picture_free(&picture);
        }
        dip_test_scene_free(&scene);
    }
}

// Draws slivers between two walls of other colours. A depth that is extrapolated beyond the corners
// of a sliver would let it show through the near wall, or let the far wall show through it.
static void measure_sliver_depth(StabilityRun *run) {
    static const DipOracleTriangle cover[2] = {
        {{-STEPS, SIDE * STEPS + STEPS, -STEPS}, {-STEPS, -STEPS, SIDE * STEPS + STEPS}},
        {{SIDE * STEPS + STEPS, SIDE * STEPS + STEPS, -STEPS},
         {-STEPS, SIDE * STEPS + STEPS, SIDE * STEPS + STEPS}}};
    static DipTestScene scene;
    static uint8_t masks[SIDE * SIDE];
    Random random = {run->seed};
    const int count = stability_count(run, 6, 120, 6000);
    for (int i = 0; i < count; i++) {
        const DipOracleTriangle sliver =
            dip_oracle_make(DIP_ORACLE_sliver, &random, dip_sample_pattern(8), &whole, 1 << 20);
        // The sliver's corners are 1 m, 2 m and 4 m away.
        const bool hidden = i % 2;
        const double wall_w = hidden ? 1.0 - 0x1p-10 : 4.0 + 0x1p-8;
        begin(&scene);
        add_triangles(&scene, add_colour(&scene, 1.0f, 1.0f, 1.0f), &sliver, 1, 1.0);
        const DipTestMesh wall =
            dip_test_scene_add_mesh(&scene, 6, 6, 0, add_colour(&scene, 0.0f, 0.0f, 1.0f));
        for (uint32_t v = 0; v < 6; v++) {
            put_vertex(&wall, v, cover[v / 3].x[v % 3], cover[v / 3].y[v % 3], wall_w);
            wall.indices[v] = v;
        }
        memset(masks, 0, sizeof masks);
        if (!hidden) {
            dip_oracle_cover(&sliver, dip_sample_pattern(8), &whole, masks);
        }
        StabilityPicture picture;
        if (draw(run, &scene, "aa=8", &picture)) {
            stability_error(run, wrong_pixels(&picture, masks, 8), "sliver %d", i);
            stability_picture_free(&picture);
        }
        dip_test_scene_free(&scene);
    }
}

// --- triangles that must not be drawn ---------------------------------------------------------

static void measure_behind(StabilityRun *run) {
    static DipTestScene scene;
    Random random = {run->seed};
    const int count = stability_count(run, 20, 400, 20000);
    for (int i = 0; i < count; i++) {
        begin(&scene);
        const DipTestMesh mesh =
            dip_test_scene_add_mesh(&scene, 3, 3, 0, add_colour(&scene, 1.0f, 1.0f, 1.0f));
        for (uint32_t k = 0; k < 9; k++) {
            const double size = ldexp(1.0, random_int(&random, -10, 30));
            mesh.positions[k] = (float)(k % 3 == 2 ? random_real(&random, 0.0, size)
                                                   : random_real(&random, -size, size));
            mesh.indices[k / 3] = k / 3;
        }
        StabilityPicture picture;
        if (draw(run, &scene, "aa=8", &picture)) {
            double bright = 0.0;
            for (int p = 0; p < 3 * SIDE * SIDE; p++) {
                bright += picture.rgb_lin[p] != 0.0;
            }
            stability_error(run, bright, "triangle %d", i);
            stability_picture_free(&picture);
        }
        dip_test_scene_free(&scene);
    }
}

// Makes a scene of red and blue triangles with a green one between them. One coordinate of the
// green triangle is replaced. coordinate: -1 leaves the green triangle out.
static void make_soup_around(DipTestScene *scene, uint64_t seed, int coordinate, float value) {
    static const DipOracleTriangle large = {{0, SIDE * STEPS, 0}, {0, 0, SIDE * STEPS}};
    Random random = {seed};
    DipOracleTriangle soup[6];
    for (int i = 0; i < 6; i++) {
        soup[i] =
            dip_oracle_make(DIP_ORACLE_large, &random, dip_sample_pattern(8), &whole, 1 << 20);
    }
    begin(scene);
    add_triangles(scene, add_colour(scene, 1.0f, 0.2f, 0.1f), soup, 3, 1.0);
    if (coordinate >= 0) {
        add_triangles(scene, add_colour(scene, 0.0f, 1.0f, 0.0f), &large, 1, 0.5);
        float *positions = (float *)(uintptr_t)scene->meshes[1].positions;
        positions[coordinate] = value;
    }
    add_triangles(scene, add_colour(scene, 0.1f, 0.2f, 1.0f), soup + 3, 3, 2.0);
}

// A coordinate of 3e38 overflows in the transform.
static void measure_overflow(StabilityRun *run) {
    static DipTestScene scene;
    StabilityPicture expected;
    make_soup_around(&scene, run->seed, -1, 0.0f);
    const bool drawn = draw(run, &scene, "aa=4", &expected);
    dip_test_scene_free(&scene);
    for (int i = 0; drawn && i < 2 * 9; i++) {
        StabilityPicture found;
        make_soup_around(&scene, run->seed, i % 9, i < 9 ? 3e38f : -3e38f);
        if (draw(run, &scene, "aa=4", &found)) {
            stability_error(run, stability_differing(&expected, &found, 0.0), "coordinate %d",
                            i % 9);
            stability_picture_free(&found);
        }
        dip_test_scene_free(&scene);
    }
    if (drawn) {
        stability_picture_free(&expected);
    }
}

static void measure_not_finite(StabilityRun *run) {
    static const float values[] = {NAN, INFINITY, -INFINITY};
    static DipTestScene scene;
    for (int i = 0; i < 3 * 9; i++) {
        DipError err = {0};
        make_soup_around(&scene, run->seed, i % 9, values[i / 9]);
        DipScene *made = dip_scene_create(&scene.def, run->pool, &err);
        stability_expect(run, !made && err.code == DIP_ERROR_RANGE, "coordinate %d is %g", i % 9,
                         (double)values[i / 9]);
        dip_scene_destroy(&made);
        dip_test_scene_free(&scene);
    }
}

// --- depth ------------------------------------------------------------------------------------

// Two meshes with the same vertices: the one that was submitted first is in front everywhere.
static void measure_same_vertices(StabilityRun *run) {
    static DipTestScene scene;
    Random random = {run->seed};
    const int count = stability_count(run, 4, 60, 3000);
    for (int i = 0; i < count; i++) {
        DipOracleTriangle soup[4];
        for (int t = 0; t < 4; t++) {
            soup[t] = dip_oracle_make(t % 2 ? DIP_ORACLE_sliver : DIP_ORACLE_large, &random,
                                      dip_sample_pattern(8), &whole, 1 << 20);
        }
        begin(&scene);
        add_triangles(&scene, add_colour(&scene, 1.0f, 0.0f, 0.0f), soup, 4, 1.0);
        add_triangles(&scene, add_colour(&scene, 0.0f, 1.0f, 0.0f), soup, 4, 1.0);
        StabilityPicture picture;
        if (draw(run, &scene, i % 2 ? "aa=8" : "aa=none", &picture)) {
            double green = 0.0;
            for (int p = 0; p < SIDE * SIDE; p++) {
                green += picture.rgb_lin[3 * p + 1] != 0.0;
            }
            stability_error(run, green, "soup %d", i);
            stability_picture_free(&picture);
        }
        dip_test_scene_free(&scene);
    }
}

// Fills a square of cells x cells quads on the plane through three points.
static void add_plane(DipTestScene *scene, int material, const double origin[3], const double a[3],
                      const double b[3], int cells) {
    const uint32_t side = (uint32_t)cells + 1;
    const DipTestMesh mesh = dip_test_scene_add_mesh(
        scene, side * side, 6 * (uint32_t)cells * (uint32_t)cells, 0, material);
    for (uint32_t v = 0; v < side * side; v++) {
        for (int c = 0; c < 3; c++) {
            mesh.positions[3 * v + (uint32_t)c] =
                (float)(origin[c] + a[c] * (v % side) / cells + b[c] * (v / side) / cells);
        }
    }
    for (uint32_t i = 0; i < (uint32_t)cells * (uint32_t)cells; i++) {
        const uint32_t at = i / (uint32_t)cells * side + i % (uint32_t)cells;
        const uint32_t corners[6] = {at, at + 1, at + side + 1, at, at + side + 1, at + side};
        memcpy(mesh.indices + 6 * i, corners, sizeof corners);
    }
}

// Returns by what share of its distance a decal on a plane is lifted towards the eye: 1/64 of the
// share by which the plane's distance changes from pixel to pixel, where it changes most, and
// 2^-20. Vertices are rounded to 1/256 pixel, which moves the plane of each triangle by up to 1/512
// of that change. Returns 0 if the plane passes the eye too closely.
static double decal_lift(const double origin[3], const double a[3], const double b[3]) {
    const double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]};
    const double height = fabs(n[0] * origin[0] + n[1] * origin[1] + n[2] * origin[2]);
    double most_w = 0.0;
    double least_w = INFINITY;
    for (int corner = 0; corner < 4; corner++) {
        const double w = -origin[2] - (corner & 1 ? a[2] : 0.0) - (corner & 2 ? b[2] : 0.0);
        most_w = fmax(most_w, w);
        least_w = fmin(least_w, w);
    }
    const double slope = sqrt(n[0] * n[0] + n[1] * n[1]) * most_w / (HALF * height);
    return least_w > 0.25 && slope < 0.25 ? slope / 64.0 + 0x1p-20 : 0.0;
}

// Draws a surface and a decal with other triangles just above it. Returns the number of pixels in
// which the surface shows, or -1 if no picture was drawn.
static double count_shown_surface(StabilityRun *run, Random *random, const double origin[3],
                                  const double a[3], const double b[3], double lift) {
    static DipTestScene scene;
    double lifted[3][3];
    for (int c = 0; c < 3; c++) {
        lifted[0][c] = origin[c] * (1.0 - lift);
        lifted[1][c] = a[c] * (1.0 - lift);
        lifted[2][c] = b[c] * (1.0 - lift);
    }
    begin(&scene);
    add_plane(&scene, add_colour(&scene, 1.0f, 0.0f, 0.0f), origin, a, b, random_int(random, 1, 3));
    add_plane(&scene, add_colour(&scene, 0.0f, 1.0f, 0.0f), lifted[0], lifted[1], lifted[2],
              random_int(random, 4, 11));
    StabilityPicture picture;
    double red = -1.0;
    double green = 0.0;
    if (draw(run, &scene, "aa=none", &picture)) {
        red = 0.0;
        for (int p = 0; p < SIDE * SIDE; p++) {
            red += picture.rgb_lin[3 * p] != 0.0;
            green += picture.rgb_lin[3 * p + 1] != 0.0;
        }
        stability_picture_free(&picture);
    }
    dip_test_scene_free(&scene);
    return green > 0.0 ? red : -1.0;
}

static void measure_decals(StabilityRun *run) {
    Random random = {run->seed};
    const int count = stability_count(run, 12, 200, 10000);
    for (int i = 0; i < count; i++) {
        const double z = -2.0 - random_real(&random, 0.0, 10.0);
        const double origin[3] = {-4.0, -2.0, z};
        double a[3] = {8.0}, b[3] = {0.0, 4.0};
        a[1] = random_real(&random, -1.0, 1.0);
        a[2] = random_real(&random, -8.0, 1.0);
        b[0] = random_real(&random, -1.0, 1.0);
        b[2] = random_real(&random, -8.0, 1.0);
        const double lift = decal_lift(origin, a, b);
        if (lift > 0.0) {
            const double shown = count_shown_surface(run, &random, origin, a, b, lift);
            // The lifted decal may end one sample before the surface does.
            stability_error(run, fmax(0.0, shown - 2.0), "decal %d, lifted by %.2g", i, lift);
        }
    }
}

// --- sample groups, mirrored meshes, sizes ----------------------------------------------------

// Adds a sphere's worth of interpenetrating triangles of flat colours.
static void add_soup(DipTestScene *scene, Random *random, DipSurface surface) {
    for (int i = 0; i < 5; i++) {
        const int material = add_colour(scene, 0.2f * (float)i, i % 2 ? 1.0f : 0.0f, 0.5f);
        scene->materials[material].surface = i % 2 ? surface : DIP_SURFACE_OPAQUE;
        const DipOracleTriangle triangle =
            dip_oracle_make(DIP_ORACLE_large, random, dip_sample_pattern(8), &whole, 1 << 20);
        add_triangles(scene, material, &triangle, 1, i % 3 ? 1.0 : 2.0);
    }
}

// Clipped surfaces of a flat colour, without a texture, keep all samples. Adaptive AA then changes
// nothing, because every sample group has the same depth.
static void measure_sample_groups(StabilityRun *run) {
    static const char *const settings[][2] = {
        {"aa=4", "aa=4,aaa=on"}, {"aa=8", "aa=8,aaa=on,asd=2"}, {"aa=6", "aa=6,aaa=on,asd=3"}};
    static DipTestScene scene;
    Random random = {run->seed};
    const int count = stability_count(run, 3, 60, 3000);
    for (int i = 0; i < count; i++) {
        begin(&scene);
        add_soup(&scene, &random, DIP_SURFACE_CLIPPED);
        StabilityPicture plain;
        StabilityPicture grouped;
        if (draw(run, &scene, settings[i % 3][0], &plain)) {
            if (draw(run, &scene, settings[i % 3][1], &grouped)) {
                stability_error(run, stability_differing(&plain, &grouped, 0.0), "soup %d with %s",
                                i, settings[i % 3][1]);
                stability_picture_free(&grouped);
            }
            stability_picture_free(&plain);
        }
        dip_test_scene_free(&scene);
    }
}

// Mirrors a single-sided mesh by its object's transform, or by hand: x is negated and two corners
// of each triangle are swapped.
static void measure_mirrored_mesh(StabilityRun *run) {
    static DipTestScene scene;
    const int count = stability_count(run, 2, 40, 2000);
    for (int i = 0; i < count; i++) {
        StabilityPicture pictures[2];
        bool drawn[2] = {false, false};
        for (int by_hand = 0; by_hand < 2; by_hand++) {
            Random random = {run->seed + (uint64_t)i};
            begin(&scene);
            add_soup(&scene, &random, DIP_SURFACE_OPAQUE);
            for (int m = 0; m < scene.def.mesh_count; m++) {
                scene.materials[scene.meshes[m].material].double_sided = false;
                float *positions = (float *)(uintptr_t)scene.meshes[m].positions;
                uint32_t *indices = (uint32_t *)(uintptr_t)scene.meshes[m].indices;
                if (by_hand) {
                    positions[0] = -positions[0];
                    positions[3] = -positions[3];
                    positions[6] = -positions[6];
                    indices[1] = 2;
                    indices[2] = 1;
                } else {
                    scene.objects[m].transform[0] = -1.0f;
                }
            }
            drawn[by_hand] = draw(run, &scene, "aa=8", &pictures[by_hand]);
            dip_test_scene_free(&scene);
        }
        if (drawn[0] && drawn[1]) {
            stability_error(run, stability_differing(&pictures[0], &pictures[1], 0.0), "soup %d",
                            i);
        }
        for (int k = 0; k < 2; k++) {
            if (drawn[k]) {
                stability_picture_free(&pictures[k]);
            }
        }
    }
}

// Draws pictures of awkward sizes and compares them with the reference.
static void measure_sizes(StabilityRun *run) {
    static const int sizes[][2] = {{1, 1},   {1, 67},  {67, 1},   {2, 3},    {5, 7},
                                   {63, 65}, {65, 63}, {129, 17}, {16, 130}, {8, 8}};
    static DipTestScene scene;
    const int count = stability_count(run, 4, 10, 10);
    for (int i = 0; i < count; i++) {
        dip_test_scene_make(&scene, DIP_TEST_SCENE_cube_on_plane);
        StabilityShot shot = shot_of(&scene, i % 2 ? "aa=4,af=4" : "aa=8,af=16");
        shot.width = sizes[i][0];
        shot.height = sizes[i][1];
        StabilityPicture expected;
        StabilityPicture found;
        if (stability_draw_reference(run, &shot, &expected)) {
            if (stability_draw(run, &shot, &found)) {
                stability_error(run, stability_rms(&expected, &found), "%dx%d pixels", shot.width,
                                shot.height);
                stability_picture_free(&found);
            }
            stability_picture_free(&expected);
        }
        dip_test_scene_free(&scene);
    }
}

// --- depth on the edges of slivers ------------------------------------------------------------
// ------------------------------------------------------------------

enum { SLIVERS = 64 };

// Adds slivers that are at most 3/256 pixel high. Their upper edges run through samples and have
// the distance `edge` at both ends, so samples have exactly this depth. The lower corners have the
// distance edge times 2^exponent, so the depth changes steeply below the edges.
static void add_slivers(DipTestScene *scene, int material, Random random, double edge,
                        int least_exponent, int greatest_exponent) {
    const DipSamplePattern *pattern = dip_sample_pattern(8);
    const DipTestMesh mesh = dip_test_scene_add_mesh(scene, 3 * SLIVERS, 3 * SLIVERS, 0, material);
    for (uint32_t i = 0; i < SLIVERS; i++) {
        const int row = random_int(&random, 0, SIDE - 1);
        const int sample = random_int(&random, 0, pattern->count - 1);
        const int y = row * STEPS + pattern->y[sample];
        const int left = random_int(&random, -SIDE, SIDE / 2) * STEPS;
        const int right = left + random_int(&random, 1, 2 * SIDE) * STEPS;
        const int lower = random_int(&random, left, right);
        const int exponent = random_int(&random, least_exponent, greatest_exponent);
        put_vertex(&mesh, 3 * i, left, y, edge);
        put_vertex(&mesh, 3 * i + 1, right, y, edge);
        put_vertex(&mesh, 3 * i + 2, lower, y + random_int(&random, 1, 3), ldexp(edge, exponent));
        for (uint32_t k = 0; k < 3; k++) {
            mesh.indices[3 * i + k] = 3 * i + k;
        }
    }
}

static void add_wall(DipTestScene *scene, int material, double distance) {
    const float d = (float)distance;
    dip_test_scene_add_quad(scene, material, (const float[]){-2.0f * d, -2.0f * d, -d},
                            (const float[]){4.0f * d, 0.0f, 0.0f},
                            (const float[]){0.0f, 4.0f * d, 0.0f}, 1.0f, 1.0f);
}

// Draws red slivers behind a blue wall (in_front is false) or in front of it. If wall is false, the
// wall is left out.
static bool draw_slivers(StabilityRun *run, Random random, bool in_front, bool wall,
                         StabilityPicture *picture) {
    static DipTestScene scene;
    begin(&scene);
    const int red = add_colour(&scene, 1.0f, 0.0f, 0.0f);
    const int blue = add_colour(&scene, 0.0f, 0.0f, 1.0f);
    if (in_front && wall) {
        add_wall(&scene, blue, 64.0 * (1.0 + 0x1p-22));
    }
    add_slivers(&scene, red, random, in_front ? 64.0 : 1.0, in_front ? -6 : 1, in_front ? -1 : 6);
    if (!in_front && wall) {
        add_wall(&scene, blue, 1.0 - 0x1p-22);
    }
    const bool drawn = draw(run, &scene, "aa=8", picture);
    dip_test_scene_free(&scene);
    return drawn;
}

// Returns the number of pixels whose red differs. If b is NULL, it counts as black.
static double differing_reds(const StabilityPicture *a, const StabilityPicture *b) {
    double count = 0.0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        count += a->rgb_lin[3 * i] != (b ? b->rgb_lin[3 * i] : 0.0);
    }
    return count;
}

static void measure_edge_depth(StabilityRun *run) {
    Random random = {run->seed};
    const int count = stability_count(run, 4, 100, 4000);
    double covered = 0.0;
    for (int i = 0; i < count; i++) {
        StabilityPicture hidden, alone, shown;
        if (draw_slivers(run, random, false, true, &hidden)) {
            stability_error(run, differing_reds(&hidden, NULL), "slivers %d behind a wall", i);
            stability_picture_free(&hidden);
        }
        if (draw_slivers(run, random, true, false, &alone)) {
            if (draw_slivers(run, random, true, true, &shown)) {
                stability_error(run, differing_reds(&alone, &shown), "slivers %d in front", i);
                stability_picture_free(&shown);
            }
            covered += differing_reds(&alone, NULL);
            stability_picture_free(&alone);
        }
        random_u64(&random);
    }
    stability_expect(run, covered > 10.0 * count, "the slivers cover only %g pixels", covered);
}

static const StabilityRow rows[] = {
    {.id = "N3",
     .promise = "A triangle that lies wholly behind the camera changes no pixel.",
     .truth = "a black picture",
     .unit = "values",
     .per_isa = true,
     .measure = measure_behind},
    {.id = "N4",
     .promise = "A scene with a position that is not finite is refused.",
     .truth = "a list of such scenes",
     .unit = "scenes",
     .measure = measure_not_finite},
    {.id = "A7",
     .promise = "A triangle whose transform overflows is left out, and all others are drawn.",
     .truth = "the picture without this triangle",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_overflow},
    {.id = "N7",
     .promise = "Slivers thinner than 1/256 pixel, and triangles without area, cover exactly the "
                "samples that lie in them.",
     .truth = "edge functions in exact integers",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_slivers},
    {.id = "N8",
     .promise = "A triangle's area and facing are decided by its positions rounded to 1/256 pixel, "
                "not before.",
     .truth = "edge functions of the rounded positions in exact integers",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_rounded_area},
    {.id = "N9",
     .promise = "A sample exactly on an edge belongs to the triangle on one side, by the top-left "
                "rule.",
     .truth = "edge functions in exact integers",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_edges_on_samples},
    {.id = "N10",
     .promise = "The triangles around a vertex, also around one that lies on a sample, cover each "
                "sample exactly once.",
     .truth = "one",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_fans},
    {.id = "N12",
     .promise = "Rejecting and accepting blocks of pixels loses no sample of any pattern.",
     .truth = "edge functions in exact integers at every sample",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_sample_boxes},
    {.id = "N14",
     .promise = "The depth of a sliver stays between the depths of its corners: it neither shows "
                "through a wall before it nor lets one behind it show.",
     .truth = "edge functions in exact integers",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_sliver_depth},
    {.id = "A54",
     .promise = "A sample on the edge of a sliver has the depth of the edge, however steeply the "
                "depth changes across the sliver: walls 2^-22 nearer or farther hide it or not.",
     .truth = "the slivers without a wall, or none of them",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_edge_depth},
    {.id = "N15",
     .promise = "Of two surfaces with the same vertices, the one that was submitted first is in "
                "front everywhere.",
     .truth = "the colour of the first surface",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_same_vertices},
    {.id = "N16",
     .promise =
         "A decal hides the surface below it, whatever its triangles are, if it is nearer to "
         "the eye by 1/64 of what the surface's distance changes from pixel to pixel.",
     .truth = "the colour of the decal",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_decals},
    {.id = "N17",
     .promise = "The sample groups of adaptive AA see the same depths: where no sample is dropped, "
                "they change nothing.",
     .truth = "the picture without adaptive AA",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_sample_groups},
    {.id = "N18",
     .promise = "An object whose transform mirrors it keeps its outside.",
     .truth = "a mesh mirrored by hand",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_mirrored_mesh},
    {.id = "N53",
     .promise = "Pictures may have any size from 1x1 pixel, odd sizes included.",
     .truth = "the reference renderer, which has neither tiles nor vectors",
     .unit = "of light, RMS",
     .bound = 0.004,
     .per_isa = true,
     .measure = measure_sizes},
};

const StabilityTopic stability_raster = {"raster", "Triangles, samples and depth", rows,
                                         sizeof rows / sizeof *rows};
