// Rows about light and water.
#include "renderer/base/trig.h"
#include "renderer/catalogue/random.h"
#include "renderer/catalogue/scenes.h"
#include "renderer/catalogue/pictures.h"

#include <math.h>
#include <string.h>

enum { WIDTH = 64, HEIGHT = 48 };

static const double fov_y_deg = 60.0;

static StabilityShot shot_of(const DipTestScene *scene, const char *settings) {
    return (StabilityShot){.def = &scene->def,
                           .pose = &scene->pose,
                           .reflection = scene->reflection.width ? &scene->reflection : NULL,
                           .settings = settings,
                           .width = WIDTH,
                           .height = HEIGHT};
}

static int add_colour(DipTestScene *scene, const float rgb[3]) {
    const int material = dip_test_scene_add_material(scene, DIP_NO_TEXTURE);
    memcpy(scene->materials[material].base_colour_lin, rgb, 3 * sizeof *rgb);
    scene->materials[material].double_sided = true;
    return material;
}

// Turns the camera about its x axis: a negative pitch looks down.
static void set_pitch(DipTestScene *scene, double pitch) {
    scene->pose.fov_y_deg = fov_y_deg;
    scene->pose.orientation[0] = dip_sin(0.5 * pitch);
    scene->pose.orientation[1] = 0.0;
    scene->pose.orientation[2] = 0.0;
    scene->pose.orientation[3] = dip_cos(0.5 * pitch);
}

// --- Fresnel term -----------------------------------------------------------------------------

// Returns the share of light that a dielectric reflects: the mean of the two polarisations, from
// Snell's law. c is the cosine of the angle of incidence.
static long double fresnel(long double c) {
    const long double n = 1.333L;
    const long double t = sqrtl(1.0L - (1.0L - c * c) / (n * n)); // cosine of the refracted ray
    const long double s_wave = (c - n * t) / (c + n * t);
    const long double p_wave = (t - n * c) / (t + n * c);
    return 0.5L * (s_wave * s_wave + p_wave * p_wave);
}

static long double schlick(long double c) {
    const long double r = (1.333L - 1.0L) / (1.333L + 1.0L);
    return r * r + (1.0L - r * r) * powl(1.0L - c, 5.0L);
}

// Compares a channel of each pixel of black water, under a sky that is 1 in this channel, with the
// share of light that it reflects.
static void compare_water(StabilityRun *run, const DipTestScene *scene, double pitch, int channel) {
    const StabilityShot shot = shot_of(scene, "aa=none");
    const double slope = dip_tan(fov_y_deg * DIP_PI / 360.0);
    StabilityPicture picture;
    if (!stability_draw(run, &shot, &picture)) {
        return;
    }
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const double x = ((i % WIDTH + 0.5) * 2.0 / WIDTH - 1.0) * slope * WIDTH / HEIGHT;
        const double y = (1.0 - (i / WIDTH + 0.5) * 2.0 / HEIGHT) * slope;
        const double down = -(y * dip_cos(pitch) + dip_sin(pitch));
        const long double c = (long double)down / sqrtl((long double)(x * x + y * y + 1.0));
        if (c > 0.002L) { // nearer to the horizon, the water ends
            const long double share = scene->reflection.schlick ? schlick(c) : fresnel(c);
            stability_error(run, picture.rgb_lin[3 * i + channel] - (double)share, "cosine %.4Lf",
                            c);
        }
    }
    stability_picture_free(&picture);
}

static void measure_fresnel(StabilityRun *run) {
    static const float black[3] = {0.0f, 0.0f, 0.0f};
    static const float white[3] = {1.0f, 1.0f, 1.0f};
    static DipTestScene scene;
    const int count = stability_count(run, 2, 24, 1000);
    for (int i = 0; i < count; i++) {
        const double pitch = -0.5 * DIP_PI * i / (count - 1);
        dip_test_scene_begin(&scene);
        memcpy(scene.def.background_lin, white, sizeof white);
        const int water = add_colour(&scene, black);
        scene.materials[water].surface = DIP_SURFACE_WATER;
        dip_test_scene_add_quad(&scene, water, (const float[]){-8000, 0, 8000},
                                (const float[]){16000, 0, 0}, (const float[]){0, 0, -16000}, 1, 1);
        scene.reflection = (DipReflectionDef){.width = 16, .height = 12, .schlick = i % 2};
        scene.pose.position_world[1] = 1.0;
        set_pitch(&scene, pitch);
        compare_water(run, &scene, pitch, 0);
        dip_test_scene_free(&scene);
    }
}

// --- the shore --------------------------------------------------------------------------------

// Adds the inside of a box as six quads.
static void add_room(DipTestScene *scene, int material) {
    static const float low[3] = {-3.0f, -2.0f, -3.0f};
    static const float size[3] = {6.0f, 5.0f, 6.0f};
    for (int face = 0; face < 6; face++) {
        const int axis = face / 2;
        float corner[3] = {low[0], low[1], low[2]};
        float a[3] = {0.0f, 0.0f, 0.0f};
        float b[3] = {0.0f, 0.0f, 0.0f};
        corner[axis] += face % 2 ? size[axis] : 0.0f;
        a[(axis + 1) % 3] = size[(axis + 1) % 3];
        b[(axis + 2) % 3] = size[(axis + 2) % 3];
        dip_test_scene_add_quad(scene, material, corner, a, b, 1.0f, 1.0f);
    }
}

// A green room with a floor of water and a red background, which nothing may let through: not the
// gap between a wall and its mirror image, nor the edge of the mirrored picture.
static void measure_shore(StabilityRun *run) {
    static const float red[3] = {1.0f, 0.0f, 0.0f};
    static const float green[3] = {0.0f, 0.7f, 0.0f};
    static const char *const settings[] = {"aa=none", "aa=8", "aa=4,taa=on"};
    static DipTestScene scene;
    Random random = {run->seed};
    const int count = stability_count(run, 6, 150, 8000);
    for (int i = 0; i < count; i++) {
        dip_test_scene_begin(&scene);
        memcpy(scene.def.background_lin, red, sizeof red);
        scene.def.near_m = 0.01f;
        add_room(&scene, add_colour(&scene, green));
        const int water = add_colour(&scene, green);
        scene.materials[water].surface = DIP_SURFACE_WATER;
        const float level = (float)random_real(&random, -0.5, 0.5);
        dip_test_scene_add_quad(&scene, water, (const float[]){-3.1f, level, 3.1f},
                                (const float[]){6.2f, 0, 0}, (const float[]){0, 0, -6.2f}, 1, 1);
        const int rows_px = random_int(&random, 2, 16);
        scene.reflection = (DipReflectionDef){
            .width = 4 * rows_px, .height = 3 * rows_px, .level_m = (double)level};
        for (int c = 0; c < 3; c++) {
            scene.pose.position_world[c] = random_real(&random, -2.0, 2.0);
        }
        // The eye is at least twice as far from every wall as from the water.
        scene.pose.position_world[1] = (double)level + random_real(&random, 0.1, 0.5);
        set_pitch(&scene, random_real(&random, -0.6, 0.5));
        StabilityPicture picture;
        const StabilityShot shot = shot_of(&scene, settings[i % 3]);
        if (stability_draw(run, &shot, &picture)) {
            double leaks = 0.0;
            for (int p = 0; p < WIDTH * HEIGHT; p++) {
                leaks += picture.rgb_lin[3 * p] > 0.0;
            }
            stability_error(run, leaks, "room %d", i);
            stability_picture_free(&picture);
        }
        dip_test_scene_free(&scene);
    }
}

// Looks down on a wide pool under a green sky. Every pixel of the frame reads the mirrored picture,
// the outermost ones close to its edges.
static void measure_mirrored_edges(StabilityRun *run) {
    static const float green[3] = {0.0f, 1.0f, 0.0f};
    static const float black[3] = {0.0f, 0.0f, 0.0f};
    static DipTestScene scene;
    Random random = {run->seed};
    const int count = stability_count(run, 6, 100, 5000);
    for (int i = 0; i < count; i++) {
        const double pitch = random_real(&random, -1.5, -0.7);
        dip_test_scene_begin(&scene);
        memcpy(scene.def.background_lin, green, sizeof green);
        const int water = add_colour(&scene, black);
        scene.materials[water].surface = DIP_SURFACE_WATER;
        dip_test_scene_add_quad(&scene, water, (const float[]){-500, 0, 500},
                                (const float[]){1000, 0, 0}, (const float[]){0, 0, -1000}, 1, 1);
        scene.reflection = (DipReflectionDef){.width = random_int(&random, 1, 9)};
        scene.reflection.height = random_int(&random, 1, 9);
        scene.pose.position_world[1] = 2.0;
        set_pitch(&scene, pitch);
        compare_water(run, &scene, pitch, 1);
        dip_test_scene_free(&scene);
    }
}

// --- products of light ------------------------------------------------------------------------

// Fills the picture with a quad of one colour.
static DipTestMesh make_flat(DipTestScene *scene, const float base[3], int arrays) {
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    static const float corners[4][2] = {{-3, 3}, {-3, -3}, {3, -3}, {3, 3}};
    dip_test_scene_begin(scene);
    const DipTestMesh mesh = dip_test_scene_add_mesh(scene, 4, 6, arrays, add_colour(scene, base));
    memcpy(mesh.indices, indices, sizeof indices);
    for (int i = 0; i < 4; i++) {
        mesh.positions[3 * i] = corners[i][0];
        mesh.positions[3 * i + 1] = corners[i][1];
        mesh.positions[3 * i + 2] = -1.0f;
    }
    return mesh;
}

static void compare_flat(StabilityRun *run, const DipTestScene *scene, const double expected[3],
                         int index) {
    StabilityPicture picture;
    const StabilityShot shot = shot_of(scene, "aa=4");
    if (stability_draw(run, &shot, &picture)) {
        for (int p = 0; p < 3 * WIDTH * HEIGHT; p++) {
            stability_error(run, picture.rgb_lin[p] - expected[p % 3], "product %d", index);
        }
        stability_picture_free(&picture);
    }
}

// base colour * light map * 2, clamped once, at the end.
static void measure_light_map(StabilityRun *run) {
    static DipTestScene scene;
    Random random = {run->seed};
    const int count = stability_count(run, 4, 60, 3000);
    for (int i = 0; i < count; i++) {
        float base[3];
        double expected[3];
        for (int c = 0; c < 3; c++) {
            base[c] = (float)random_real(&random, 0.0, 1.0);
        }
        const DipTestMesh mesh = make_flat(&scene, base, DIP_TEST_UV1);
        memset(mesh.uv1, 0, 8 * sizeof *mesh.uv1);
        const int map = dip_test_scene_add_texture(&scene, DIP_TEST_NOISE, 4, 4);
        scene.textures[map].encoding = DIP_ENCODING_LINEAR;
        scene.materials[0].light_map = map;
        scene.materials[0].light_map_scale = 2.0f;
        for (int c = 0; c < 3; c++) {
            const int code = random_int(&random, 0, 255);
            for (int t = 0; t < 16; t++) {
                dip_test_scene_texels(&scene, map)[4 * t + c] = (uint8_t)code;
            }
            expected[c] = fmin(1.0, (double)base[c] * 2.0 * code / 255.0);
        }
        compare_flat(run, &scene, expected, i);
        dip_test_scene_free(&scene);
    }
}

// Vertex colours of any size and sign: the product is clamped before it becomes an integer.
static void measure_clamp(StabilityRun *run) {
    static const float white[3] = {1.0f, 1.0f, 1.0f};
    static DipTestScene scene;
    Random random = {run->seed};
    const int count = stability_count(run, 6, 120, 6000);
    for (int i = 0; i < count; i++) {
        double expected[3];
        const DipTestMesh mesh = make_flat(&scene, white, DIP_TEST_COLOURS);
        for (int c = 0; c < 3; c++) {
            const double size = ldexp(1.0, random_int(&random, -20, 120));
            const float colour = (float)random_real(&random, -size, size);
            for (int v = 0; v < 4; v++) {
                mesh.colours_lin[3 * v + c] = colour;
            }
            expected[c] = fmin(fmax((double)colour, 0.0), 1.0);
        }
        compare_flat(run, &scene, expected, i);
        dip_test_scene_free(&scene);
    }
}

static const StabilityRow rows[] = {
    {.id = "N44",
     .promise = "Water reflects the share of light that optics says, from straight down to within "
                "0.1 degrees of the horizon, and Schlick's share where it is asked for.",
     .truth = "Snell's law and Fresnel's formulas in `long double`",
     .unit = "of light",
     .bound = 0.005,
     .per_isa = true,
     .measure = measure_fresnel},
    {.id = "N21",
     .promise = "No background shows between a wall and its reflection, and none at the edge of "
                "the mirrored picture, if the eye is at least twice as far from a wall as from "
                "the water.",
     .truth = "a closed room without the background's colour",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_shore},
    {.id = "N22",
     .promise = "Every pixel of the frame reads the mirrored picture inside its edges, also if it "
                "has only 1x1 pixel.",
     .truth = "Fresnel's formulas for a sky of one colour",
     .unit = "of light",
     .bound = 0.005,
     .per_isa = true,
     .measure = measure_mirrored_edges},
    {.id = "N46",
     .promise = "Base colour, light map and its factor of 2 are clamped once, at the end.",
     .truth = "the product in double precision",
     .unit = "of light",
     // Half a code of sRGB near 1 is 0.0045. A texel is the square of 10 or 11 bits: at most 0.0014
     // after the factor.
     .bound = 0.006,
     .per_isa = true,
     .measure = measure_light_map},
    {.id = "N51",
     .promise = "Colours of any size and sign are clamped before they become integers.",
     .truth = "the clamped colour",
     .unit = "of light",
     .bound = 0.005,
     .per_isa = true,
     .measure = measure_clamp},
};

const StabilityTopic stability_effects = {"effects", "Light and water", rows,
                                          sizeof rows / sizeof *rows};
