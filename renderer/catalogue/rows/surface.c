// Rows about surfaces: normal maps, vertex normals, alpha clipping and the sky.
#include "renderer/base/trig.h"
#include "renderer/catalogue/scenes.h"
#include "renderer/catalogue/pictures.h"

#include <math.h>
#include <string.h>

enum { WIDTH = 64, HEIGHT = 48 };

static const double pi = 3.14159265358979323846;

// --- vectors ----------------------------------------------------------------------------------

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void normalise(double a[3]) {
    const double length = sqrt(dot(a, a));
    for (int i = 0; i < 3; i++) {
        a[i] /= length;
    }
}

// --- the scene --------------------------------------------------------------------------------

// Texture coordinates on a plane: u = u[0] + u[1] s + u[2] t, where s and t are the position on the
// plane in metres; v likewise.
typedef struct Mapping {
    const char *name;
    double u[3];
    double v[3];
    bool has_area; // false: u and v are collinear
} Mapping;

static const Mapping mappings[] = {
    {"v constant", {0.1, 0.7, 0.2}, {0.3, 0.0, 0.0}, false},
    {"u constant", {0.3, 0.0, 0.0}, {0.1, 0.7, 0.2}, false},
    {"v = .7 u", {0.1, 0.6, 0.3}, {0.07, 0.42, 0.21}, false},
    {"v = .4 - 3 u", {0.1, 0.7, 0.2}, {0.1, -2.1, -0.6}, false},
    {"u and v constant", {0.3, 0.0, 0.0}, {0.7, 0.0, 0.0}, false},
    {"v constant, u far away", {50.1, 0.7, 0.2}, {0.3, 0.0, 0.0}, false},
    {"v constant and far away", {0.1, 0.7, 0.2}, {60.3, 0.0, 0.0}, false},
    {"plain", {0.0, 1.0, 0.0}, {0.0, 0.0, -1.0}, true},
    {"turned", {0.3, 0.8, -0.6}, {0.7, -0.6, -0.8}, true},
    {"mirrored", {0.3, -0.8, 0.6}, {0.7, -0.6, -0.8}, true},
    {"sheared", {0.3, 1.0, 0.0}, {0.2, 1.0, 0.03125}, true},
    {"stretched", {0.0, 16.0, 0.0}, {0.5, 0.0, 0.0625}, true},
    {"far away", {30.0, 0.8, -0.6}, {-50.0, -0.6, -0.8}, true},
};

enum { MAPPING_COUNT = sizeof mappings / sizeof *mappings };

// A plane, and the direction in which the camera sees it.
typedef struct View {
    const char *name;
    double turn_x_deg; // rotation of the camera about its x axis, then about its z axis
    double turn_z_deg;
    double distance_m; // from the camera to the plane; the plane faces +Z
} View;

static const View views[] = {
    {"straight", 0.0, 0.0, 2.0},
    {"oblique", 40.0, 0.0, 2.0},
    {"grazing and rolled", 48.0, 20.0, 1.0},
};

enum { VIEW_COUNT = sizeof views / sizeof *views };

// One case: a plane with a normal map.
typedef struct Case {
    const Mapping *mapping;
    const View *view;
    int coordinate_exponent; // texture coordinates are multiplied by 2^this
    int normal_exponent;     // normals are multiplied by 2^this
    uint8_t texel[3];        // the normal map's only value
} Case;

static void turn_camera(const View *view, DipPose *pose) {
    const double x = view->turn_x_deg * pi / 360.0, z = view->turn_z_deg * pi / 360.0;
    pose->orientation[0] = dip_sin(x) * dip_cos(z);
    pose->orientation[1] = -dip_sin(x) * dip_sin(z);
    pose->orientation[2] = dip_cos(x) * dip_sin(z);
    pose->orientation[3] = dip_cos(x) * dip_cos(z);
    pose->position_world[2] = view->distance_m;
}

static int add_flat_texture(DipTestScene *scene, const uint8_t texel[3]) {
    const int texture = dip_test_scene_add_bumps(scene, 4);
    uint8_t *texels = dip_test_scene_texels(scene, texture);
    for (int i = 0; i < 16; i++) {
        memcpy(texels + 4 * i, texel, 3);
    }
    return texture;
}

// Makes a wall that fills the picture.
static void make_wall(DipTestScene *scene, const Case *c) {
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    dip_test_scene_begin(scene);
    const int material = dip_test_scene_add_material(scene, DIP_NO_TEXTURE);
    scene->materials[material].normal_map = add_flat_texture(scene, c->texel);
    scene->materials[material].lit = true;
    scene->materials[material].roughness = 0.5f;
    for (int i = 0; i < 3; i++) {
        scene->materials[material].base_colour_lin[i] = 0.5f;
    }
    const DipTestMesh mesh =
        dip_test_scene_add_mesh(scene, 4, 6, DIP_TEST_NORMALS | DIP_TEST_UV0, material);
    memcpy(mesh.indices, indices, sizeof indices);
    for (int i = 0; i < 4; i++) {
        const double s = i == 1 || i == 2 ? 40.0 : -40.0;
        const double t = i >= 2 ? 60.0 : -40.0;
        const double *u = c->mapping->u, *v = c->mapping->v;
        mesh.positions[3 * i] = (float)s;
        mesh.positions[3 * i + 1] = (float)t;
        mesh.normals[3 * i + 2] = (float)ldexp(1.0, c->normal_exponent);
        mesh.uv0[2 * i] = (float)ldexp(u[0] + u[1] * s + u[2] * t, c->coordinate_exponent);
        mesh.uv0[2 * i + 1] = (float)ldexp(v[0] + v[1] * s + v[2] * t, c->coordinate_exponent);
    }
    turn_camera(c->view, &scene->pose);
}

// --- the truth --------------------------------------------------------------------------------

// Computes the normal that the map gives the wall. u grows along the first tangent while v stays
// constant. v falls along the second one.
static void find_normal(const Case *c, double normal[3]) {
    const Mapping *m = c->mapping;
    const double area = m->u[1] * m->v[2] - m->u[2] * m->v[1];
    const double length = hypot(m->v[1], m->v[2]);
    const double sign = area < 0.0 ? -1.0 : 1.0;
    double bump[3];
    for (int i = 0; i < 3; i++) {
        bump[i] = (c->texel[i] - 128.0) / 127.0;
        normal[i] = i == 2 ? 1.0 : 0.0;
    }
    if (!m->has_area) {
        return;
    }
    const double along[2] = {sign * m->v[2] / length, -sign * m->v[1] / length};
    const double against[2] = {-m->v[1] / length, -m->v[2] / length};
    for (int i = 0; i < 2; i++) {
        normal[i] = bump[0] * along[i] + bump[1] * against[i];
    }
    normal[2] = fmax(bump[2], 0.125);
    normalise(normal);
}

// Returns the light that the wall sends along -ray: docs/picture.md, "Normal maps". texel is the
// value of the normal map; a short vector widens the highlight.
static double find_light(const uint8_t texel[3], const double normal[3], const double ray[3]) {
    double sun[3] = {-0.42, 0.67, 0.61};
    double half[3] = {-ray[0], -ray[1], -ray[2]};
    normalise(sun);
    normalise(half);
    for (int i = 0; i < 3; i++) {
        half[i] += sun[i];
    }
    normalise(half);
    const double met = fmax(0.0, dot(normal, sun));
    const double n_h = fmax(0.0, dot(normal, half)), l_h = dot(sun, half);
    const double bump[3] = {(texel[0] - 128.0) / 127.0, (texel[1] - 128.0) / 127.0,
                            fmax((texel[2] - 128.0) / 127.0, 0.125)};
    const double spread = 2.0 * fmax(0.0, 1.0 / fmax(0.1, sqrt(dot(bump, bump))) - 1.0);
    const double alpha2 = fmin(1.0, 0.25 * 0.25 + spread);
    const double d = n_h * n_h * (alpha2 - 1.0) + 1.0;
    const double lobe = alpha2 / (d * d * fmax(0.1, l_h * l_h) * (4.0 * sqrt(alpha2) + 2.0));
    const double light = 0.35 + 0.15 * normal[1] + 0.65 * met;
    return fmin(fmax(0.5 * light + 0.04 * 0.65 * met * lobe, 0.0), 1.0);
}

// Computes the world-space ray through the centre of a pixel.
static void find_ray(const View *view, double fov_y_deg, int x, int y, double ray[3]) {
    const double half = tan(fov_y_deg * pi / 360.0);
    const double a = view->turn_x_deg * pi / 180.0, b = view->turn_z_deg * pi / 180.0;
    const double px = ((x + 0.5) / WIDTH * 2.0 - 1.0) * half * WIDTH / HEIGHT;
    const double py = (1.0 - (y + 0.5) / HEIGHT * 2.0) * half;
    const double qx = px * cos(b) - py * sin(b);
    const double qy = px * sin(b) + py * cos(b);
    ray[0] = qx;
    ray[1] = qy * cos(a) + sin(a);
    ray[2] = qy * sin(a) - cos(a);
}

// --- measuring --------------------------------------------------------------------------------

typedef bool Draw(StabilityRun *run, const StabilityShot *shot, StabilityPicture *picture);

// Draws a case, and keeps the greatest difference from the truth.
static void measure_case(StabilityRun *run, const Case *c, Draw *draw) {
    static DipTestScene scene;
    make_wall(&scene, c);
    const StabilityShot shot = {.def = &scene.def,
                                .pose = &scene.pose,
                                .settings = "aa=none",
                                .width = WIDTH,
                                .height = HEIGHT};
    StabilityPicture picture;
    if (draw(run, &shot, &picture)) {
        double normal[3], ray[3], worst = 0.0;
        find_normal(c, normal);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            find_ray(c->view, scene.pose.fov_y_deg, i % WIDTH, i / WIDTH, ray);
            const double error = fabs(picture.rgb_lin[3 * i] - find_light(c->texel, normal, ray));
            worst = error <= worst ? worst : error; // keeps a NaN
        }
        stability_error(run, worst, "%s, %s, coordinates times 2^%d, normals times 2^%d",
                        c->mapping->name, c->view->name, c->coordinate_exponent,
                        c->normal_exponent);
        stability_picture_free(&picture);
    }
    dip_test_scene_free(&scene);
}

// A unit normal that leans by 40 degrees. As 8-bit values it is longer than 1, so it does not widen
// the highlight.
static const uint8_t leaning[3] = {200, 90, 255};

static void measure_mappings(StabilityRun *run, bool has_area, Draw *draw) {
    static const int exponents[] = {0, -40, 2, -20};
    const int exponent_count = stability_count(run, 2, 4, 4);
    for (int m = 0; m < MAPPING_COUNT; m++) {
        for (int v = 0; v < VIEW_COUNT && mappings[m].has_area == has_area; v++) {
            if (run->depth == STABILITY_SHORT && v != m % VIEW_COUNT) {
                continue;
            }
            for (int e = 0; e < exponent_count; e++) {
                Case c = {&mappings[m], &views[v], exponents[e], 0, {0}};
                memcpy(c.texel, leaning, sizeof leaning);
                measure_case(run, &c, draw);
            }
        }
    }
}

static void measure_no_area(StabilityRun *run) {
    measure_mappings(run, false, stability_draw);
}

static void measure_no_area_of_reference(StabilityRun *run) {
    measure_mappings(run, false, stability_draw_reference);
}

static void measure_tangents(StabilityRun *run) {
    measure_mappings(run, true, stability_draw);
}

static void measure_tangents_of_reference(StabilityRun *run) {
    measure_mappings(run, true, stability_draw_reference);
}

// The values stand for the plain normal, for no direction and for a direction into the wall.
static void measure_flat_values(StabilityRun *run) {
    static const uint8_t texels[][3] = {{128, 128, 255}, {128, 128, 128}, {128, 128, 0}};
    const int texel_count = stability_count(run, 1, 3, 3);
    for (int i = 0; i < texel_count; i++) {
        for (int m = 0; m < MAPPING_COUNT; m++) {
            Case c = {&mappings[m], &views[m % VIEW_COUNT], 0, 0, {0}};
            memcpy(c.texel, texels[i], sizeof c.texel);
            measure_case(run, &c, stability_draw);
        }
    }
}

static void measure_normal_lengths(StabilityRun *run) {
    static const int exponents[] = {-60, 66, -100, 100, -20, 30};
    const int count = stability_count(run, 2, 6, 6);
    for (int e = 0; e < count; e++) {
        Case c = {&mappings[7], &views[1], 0, exponents[e], {0}};
        memcpy(c.texel, leaning, sizeof leaning);
        measure_case(run, &c, stability_draw);
        measure_case(run, &c, stability_draw_reference);
    }
}

// --- alpha ------------------------------------------------------------------------------------

// Makes a wall whose texture has the same alpha everywhere.
static void make_clipped_wall(DipTestScene *scene, const View *view, uint8_t alpha, int width,
                              int height) {
    dip_test_scene_begin(scene);
    memset(scene->def.background_lin, 0, sizeof scene->def.background_lin);
    const int texture = dip_test_scene_add_texture(scene, DIP_TEST_NOISE, width, height);
    uint8_t *texels = dip_test_scene_texels(scene, texture);
    for (int i = 0; i < width * height; i++) {
        memset(texels + 4 * i, 255, 3);
        texels[4 * i + 3] = alpha;
    }
    const int material = dip_test_scene_add_material(scene, texture);
    scene->materials[material].surface = DIP_SURFACE_CLIPPED;
    dip_test_scene_add_quad(scene, material, (const float[]){-40.0f, -40.0f, 0.0f},
                            (const float[]){80.0f, 0.0f, 0.0f}, (const float[]){0.0f, 100.0f, 0.0f},
                            37.3f, 61.7f);
    turn_camera(view, &scene->pose);
}

// Draws the wall with a cutoff. Returns the number of pixels that are wrong.
static void measure_cutoff(StabilityRun *run, DipTestScene *scene, float cutoff, bool kept,
                           const char *settings, Draw *draw) {
    scene->materials[0].alpha_cutoff = cutoff;
    const StabilityShot shot = {.def = &scene->def,
                                .pose = &scene->pose,
                                .settings = settings,
                                .width = WIDTH,
                                .height = HEIGHT};
    StabilityPicture picture;
    if (draw(run, &shot, &picture)) {
        int wrong = 0;
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            wrong += (picture.rgb_lin[3 * i] > 0.5) != kept;
        }
        stability_error(run, wrong, "alpha of %d texels, cutoff %a, %s",
                        scene->textures[0].width * scene->textures[0].height, (double)cutoff,
                        settings);
        stability_picture_free(&picture);
    }
}

static void measure_equal_alpha(StabilityRun *run) {
    static const uint8_t alphas[] = {255, 1, 254, 128, 77, 3, 171, 85};
    static const char *const settings[] = {"aa=none,af=none", "aa=4,af=16",
                                           "aa=8,aaa=on,asd=1,af=8,opt=advanced",
                                           "aa=2,af=16,aaf=on,miplod=high-performance"};
    static DipTestScene scene;
    const int count = stability_count(run, 2, 32, 32);
    for (int i = 0; i < count; i++) {
        const uint8_t alpha = alphas[i / 4];
        const float equal = (float)(alpha / 255.0);
        make_clipped_wall(&scene, &views[i % VIEW_COUNT], alpha, i % 2 ? 13 : 64, i % 2 ? 7 : 32);
        for (int d = 0; d < 2; d++) {
            Draw *const draw = d ? stability_draw_reference : stability_draw;
            measure_cutoff(run, &scene, equal, true, settings[i % 4], draw);
            measure_cutoff(run, &scene, nextafterf(equal, 2.0f), false, settings[i % 4], draw);
        }
        dip_test_scene_free(&scene);
    }
}

// --- the sky ----------------------------------------------------------------------------------

#define SECOND_NS INT64_C(1000000000)

static bool draw_sky(StabilityRun *run, const DipTestScene *scene, int64_t time_ns, Draw *draw,
                     StabilityPicture *picture) {
    const StabilityShot shot = {.def = &scene->def,
                                .pose = &scene->pose,
                                .settings = "aa=none,af=2",
                                .width = WIDTH,
                                .height = HEIGHT,
                                .time_ns = time_ns};
    return draw(run, &shot, picture);
}

// The default sky's layers repeat after 200 s and 300 s, so the sky repeats after 600 s. Compares
// the picture at a time with pictures whole repetitions earlier and later, up to 9e9 s away.
static void measure_repetition(StabilityRun *run, Draw *draw) {
    static DipTestScene scene;
    static const int64_t times_ns[] = {123456789012, 1, 0, 199999999999, 300000000001};
    static const int64_t repetitions[] = {-1, -1666667, 1666667, 15000000, -15000000};
    dip_test_scene_make(&scene, DIP_TEST_SCENE_sky);
    const int count = stability_count(run, 2, 5, 5);
    for (int t = 0; t < count; t++) {
        StabilityPicture expected, found;
        if (!draw_sky(run, &scene, times_ns[t], draw, &expected)) {
            break;
        }
        for (int r = 0; r < 5; r++) {
            const int64_t time_ns = times_ns[t] + repetitions[r] * 600 * SECOND_NS;
            if (draw_sky(run, &scene, time_ns, draw, &found)) {
                stability_error(run, stability_differing(&expected, &found, 0.0), "%g s",
                                (double)time_ns * 1e-9);
                stability_picture_free(&found);
            }
        }
        stability_picture_free(&expected);
    }
    dip_test_scene_free(&scene);
}

static void measure_sky(StabilityRun *run) {
    measure_repetition(run, stability_draw);
}

static void measure_sky_of_reference(StabilityRun *run) {
    measure_repetition(run, stability_draw_reference);
}

static const StabilityRow rows[] = {
    {.id = "A40",
     .promise = "A normal map has no effect where the texture coordinates have no area: where they "
                "are constant or collinear.",
     .truth = "the closed form of the light on the plain normal",
     .unit = "of light",
     .bound = 0.005,
     .per_isa = true,
     .measure = measure_no_area},
    {.id = "A41",
     .promise = "In the reference, too, a normal map has no effect where the texture coordinates "
                "have no area.",
     .truth = "the closed form of the light on the plain normal",
     .unit = "of light",
     .bound = 1e-4,
     .measure = measure_no_area_of_reference},
    {.id = "A42",
     .promise = "A normal map's tangents follow texture coordinates that are turned, mirrored, "
                "sheared, stretched, or multiplied by 2^-40 to 2^2.",
     .truth = "the closed form of the light on the mapped normal",
     .unit = "of light",
     .bound = 0.006,
     .per_isa = true,
     .measure = measure_tangents},
    {.id = "A43",
     .promise = "In the reference, too, a normal map's tangents follow such texture coordinates.",
     .truth = "the closed form of the light on the mapped normal",
     .unit = "of light",
     .bound = 1e-4,
     .measure = measure_tangents_of_reference},
    {.id = "N45",
     .promise = "The values (128, 128, 255), (128, 128, 128) and (128, 128, 0) of a normal map "
                "leave the surface's normal unchanged.",
     .truth = "the closed form of the light on the plain normal",
     .unit = "of light",
     .bound = 0.006,
     .per_isa = true,
     .measure = measure_flat_values},
    {.id = "A44",
     .promise = "Normals of a mesh may have any length from 2^-100 to 2^100.",
     .truth = "the closed form of the light on the normal of length 1",
     .unit = "of light",
     .bound = 0.006,
     .per_isa = true,
     .measure = measure_normal_lengths},
    {.id = "A53",
     .promise = "In both renderers, where all texels have the same alpha, a surface is kept if the "
                "cutoff equals it, "
                "also at 1, and clipped if the cutoff is the next greater float.",
     .truth = "all pixels or none",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_equal_alpha},
    {.id = "A45",
     .promise = "The sky repeats to the bit, from -9e9 s to 9e9 s.",
     .truth = "the picture at a time within the first repetition",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_sky},
    {.id = "A46",
     .promise = "The reference's sky repeats to the bit, from -9e9 s to 9e9 s.",
     .truth = "the picture at a time within the first repetition",
     .unit = "pixels",
     .measure = measure_sky_of_reference},
};

const StabilityTopic stability_surface = {"surface", "Normal maps, alpha and sky", rows,
                                          sizeof rows / sizeof *rows};
