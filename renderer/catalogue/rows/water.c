// Rows about water that reflects: the eye close to its surface, below it, and mirrored pictures of
// extreme sizes.
#include "renderer/base/trig.h"
#include "renderer/catalogue/random.h"
#include "renderer/catalogue/scenes.h"
#include "renderer/catalogue/pictures.h"

#include <math.h>
#include <string.h>

enum { WIDTH = 96, HEIGHT = 72 };

static const double level = 0.3;

// Adds a lake of 8 m x 8 m at the level.
static int add_water(DipTestScene *scene) {
    const int water = dip_test_scene_add_material(scene, DIP_NO_TEXTURE);
    scene->materials[water].surface = DIP_SURFACE_WATER;
    scene->materials[water].double_sided = true;
    dip_test_scene_add_quad(scene, water, (const float[]){-4, (float)level, 4},
                            (const float[]){8, 0, 0}, (const float[]){0, 0, -8}, 1, 1);
    return water;
}

// Makes a closed room of 8 m x 4 m x 8 m around the lake. All its walls have one material.
static void make_room(DipTestScene *scene, int texture) {
    static const float sides[6][9] = {
        {-4, -1, -4, 8, 0, 0, 0, 4, 0}, {4, -1, 4, -8, 0, 0, 0, 4, 0},
        {-4, -1, 4, 0, 0, -8, 0, 4, 0}, {4, -1, -4, 0, 0, 8, 0, 4, 0},
        {-4, 3, -4, 8, 0, 0, 0, 0, 8},  {-4, -1, 4, 8, 0, 0, 0, 0, -8},
    };
    const int walls = dip_test_scene_add_material(scene, texture);
    for (int i = 0; i < 6; i++) {
        dip_test_scene_add_quad(scene, walls, sides[i], sides[i] + 3, sides[i] + 6, 8, 4);
    }
    scene->reflection = (DipReflectionDef){.width = 61, .height = 47, .level_m = level};
}

// Places the camera in the room, away from the walls, `above` metres above the water.
static void place_camera(DipTestScene *scene, Random *random, double above) {
    const double yaw = random_real(random, -1.6, 1.6); // half angles, in radians
    const double pitch = random_real(random, -0.4, 0.25);
    const double turned[4] = {dip_cos(yaw) * dip_sin(pitch), dip_sin(yaw) * dip_cos(pitch),
                              -dip_sin(yaw) * dip_sin(pitch), dip_cos(yaw) * dip_cos(pitch)};
    memcpy(scene->pose.orientation, turned, sizeof turned);
    scene->pose.position_world[0] = random_real(random, -2.5, 2.5);
    scene->pose.position_world[1] = level + above;
    scene->pose.position_world[2] = random_real(random, -2.5, 2.5);
}

static bool draw(StabilityRun *run, const DipTestScene *scene, const char *settings,
                 StabilityPicture *picture) {
    const StabilityShot shot = {.def = &scene->def,
                                .pose = &scene->pose,
                                .reflection = scene->reflection.width ? &scene->reflection : NULL,
                                .settings = settings,
                                .width = WIDTH,
                                .height = HEIGHT};
    return stability_draw(run, &shot, picture);
}

// Draws two scenes that should look the same, and counts the pixels that differ by more than
// `least`.
static void compare(StabilityRun *run, const DipTestScene *expected, const DipTestScene *found,
                    const char *settings, double least, double above) {
    StabilityPicture pictures[2];
    if (!draw(run, expected, settings, &pictures[0])) {
        return;
    }
    if (draw(run, found, settings, &pictures[1])) {
        if (stability_shows(run, &pictures[0], 50)) {
            stability_error(run, stability_differing(&pictures[0], &pictures[1], least),
                            "eye %g m above the water with %s", above, settings);
        }
        stability_picture_free(&pictures[1]);
    }
    stability_picture_free(&pictures[0]);
}

// Water that is seen from its own plane covers nothing.
static void measure_in_plane(StabilityRun *run) {
    static const double heights[] = {0.0, 1e-9, -1e-9, 1e-7, -1e-7, 1e-12, 1e-300, -1e-14};
    enum { HEIGHTS = sizeof heights / sizeof *heights };
    Random random = {run->seed};
    const int count = stability_count(run, 4, 240, 8000);
    for (int n = 0; n < count; n++) {
        static DipTestScene wet, dry;
        dip_test_scene_begin(&wet);
        make_room(&wet, dip_test_scene_add_texture(&wet, DIP_TEST_CHECKER, 64, 64));
        add_water(&wet);
        place_camera(&wet, &random, heights[n % HEIGHTS]);
        dip_test_scene_begin(&dry);
        make_room(&dry, dip_test_scene_add_texture(&dry, DIP_TEST_CHECKER, 64, 64));
        dry.pose = wet.pose;
        dry.reflection.width = 0;
        compare(run, &dry, &wet, n / HEIGHTS % 2 ? "aa=4,af=16" : "aa=none", 0.0,
                heights[n % HEIGHTS]);
        dip_test_scene_free(&wet);
        dip_test_scene_free(&dry);
    }
}

static void measure_below(StabilityRun *run) {
    Random random = {run->seed + 1};
    const int count = stability_count(run, 4, 240, 8000);
    for (int n = 0; n < count; n++) {
        static DipTestScene water, plain;
        const double below = random_magnitude(&random, -40, -1);
        dip_test_scene_begin(&water);
        make_room(&water, dip_test_scene_add_texture(&water, DIP_TEST_CHECKER, 64, 64));
        add_water(&water);
        place_camera(&water, &random, -below);
        dip_test_scene_begin(&plain);
        make_room(&plain, dip_test_scene_add_texture(&plain, DIP_TEST_CHECKER, 64, 64));
        plain.materials[add_water(&plain)].surface = DIP_SURFACE_OPAQUE;
        plain.pose = water.pose;
        compare(run, &plain, &water, n % 2 ? "aa=4,af=16" : "aa=none", 0.0, -below);
        dip_test_scene_free(&water);
        dip_test_scene_free(&plain);
    }
}

// Every surface of the room and the water itself are grey, and the background is magenta, so every
// pixel is grey unless a read of the mirrored picture leaves what was drawn.
static void measure_border(StabilityRun *run) {
    static const int sizes[][2] = {{32, 24}, {33, 25}, {61, 47},  {64, 64},  {65, 63},
                                   {96, 72}, {47, 61}, {333, 25}, {257, 300}};
    enum { SIZES = sizeof sizes / sizeof *sizes };
    static const double heights[] = {2.0, 0.5, 0.1, 1e-2, 1e-4, 1e-6, 1e-12};
    Random random = {run->seed + 2};
    const int count = stability_count(run, 4, 300, 10000);
    for (int n = 0; n < count; n++) {
        static DipTestScene scene;
        const double above = heights[n / SIZES % 7];
        dip_test_scene_begin(&scene);
        make_room(&scene, DIP_NO_TEXTURE);
        const int water = add_water(&scene);
        for (int c = 0; c < 3; c++) {
            scene.materials[0].base_colour_lin[c] = 0.5f;
            scene.materials[water].base_colour_lin[c] = 0.5f;
            scene.def.background_lin[c] = c == 1 ? 0.0f : 1.0f;
        }
        scene.reflection.width = sizes[n % SIZES][0];
        scene.reflection.height = sizes[n % SIZES][1];
        place_camera(&scene, &random, above);
        StabilityPicture picture;
        if (draw(run, &scene, n % 3 ? "aa=none" : "aa=6,af=4", &picture)) {
            double worst = 0.0;
            for (int i = 0; i < 3 * WIDTH * HEIGHT; i++) {
                worst = fmax(worst, fabs(picture.rgb_lin[i] - 0.5));
            }
            stability_error(run, worst, "mirrored picture of %dx%d, eye %g m above the water",
                            scene.reflection.width, scene.reflection.height, above);
            stability_picture_free(&picture);
        }
        dip_test_scene_free(&scene);
    }
}

static const StabilityRow rows[] = {
    {.id = "N19",
     .promise = "An eye in the water's plane, or up to 1e-7 m beside it, sees no water.",
     .truth = "the picture of the scene without water",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_in_plane},
    {.id = "N20",
     .promise = "From 1e-12 m to 1 m below its surface, water does not reflect and shows its own "
                "colour.",
     .truth = "the picture with an opaque surface in place of the water",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_below},
    {.id = "N23",
     .promise =
         "Water in a closed room reflects nothing but the room, with mirrored pictures from a "
         "third to five times the size of the frame: no read leaves what was drawn.",
     .truth = "the colour of the room and of the water, which are the same",
     .unit = "of light",
     .bound = 0.005,
     .per_isa = true,
     .measure = measure_border},
};

const StabilityTopic stability_water = {"water", "Water", rows, sizeof rows / sizeof *rows};
