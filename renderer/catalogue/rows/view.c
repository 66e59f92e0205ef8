// Rows about the camera, the near plane and transforms.
#include "renderer/catalogue/random.h"
#include "renderer/catalogue/scenes.h"
#include "renderer/catalogue/pictures.h"

#include <math.h>
#include <string.h>

enum { WIDTH = 96, HEIGHT = 72 };

static const char *const settings[] = {"aa=none", "aa=8,af=16"};

// --- a scene in front of the camera -----------------------------------------------------------

// Makes textured, lit and alpha-clipped quads 1 m to 60 m in front of the camera. Nothing is nearer
// than 1 m, so the scene looks the same with any near plane up to 1 m. All coordinates are
// multiples of 1/16 m, so that moved and scaled copies of them are exact.
static void make_quads(DipTestScene *scene, uint64_t seed) {
    Random random = {seed};
    dip_test_scene_begin(scene);
    const int checker = dip_test_scene_add_texture(scene, DIP_TEST_CHECKER, 64, 64);
    const int noise = dip_test_scene_add_texture(scene, DIP_TEST_NOISE, 128, 32);
    for (int i = 0; i < DIP_TEST_SCENE_PARTS; i++) {
        const int material = dip_test_scene_add_material(scene, i % 2 ? checker : noise);
        const float distance = (float)(1 << i % 6);
        float corner[3] = {0.0f, 0.0f, -distance - 0.0625f * (float)i};
        float right[3] = {0.0f, 0.0f, 0.0f};
        float up[3] = {0.0f, 0.0f, 0.0f};
        for (int c = 0; c < 2; c++) {
            corner[c] = (float)random_int(&random, -12, 4) / 16.0f * distance;
            right[c] = (float)random_int(&random, c ? -2 : 2, c ? 2 : 12) / 16.0f * distance;
            up[c] = (float)random_int(&random, c ? 2 : -2, c ? 12 : 2) / 16.0f * distance;
        }
        right[2] = -(float)random_int(&random, 0, 8) / 16.0f * distance;
        scene->materials[material].double_sided = true;
        scene->materials[material].surface = i == 3 ? DIP_SURFACE_CLIPPED : DIP_SURFACE_OPAQUE;
        dip_test_scene_add_quad(scene, material, corner, right, up, 3.0f, 2.0f);
    }
}

static StabilityShot shot_of(const DipTestScene *scene, const char *text) {
    return (StabilityShot){.def = &scene->def,
                           .pose = &scene->pose,
                           .reflection = scene->reflection.width ? &scene->reflection : NULL,
                           .settings = text,
                           .width = WIDTH,
                           .height = HEIGHT};
}

// Draws a scene that should look like *expected, and counts the pixels that differ.
static void compare_with(StabilityRun *run, const StabilityPicture *expected,
                         const DipTestScene *scene, const char *text, const char *what,
                         double value) {
    StabilityPicture found;
    const StabilityShot shot = shot_of(scene, text);
    if (stability_draw(run, &shot, &found)) {
        stability_error(run, stability_differing(expected, &found, 0.0), "%s %g with %s", what,
                        value, text);
        stability_picture_free(&found);
    }
}

// Changes a scene in a way that must not change its picture.
typedef void Change(DipTestScene *scene, double value);

// Draws scenes before and after a change with each of the values.
static void compare_changes(StabilityRun *run, Change *change, const double *values, int count,
                            const char *what) {
    static DipTestScene scene;
    const int scenes = stability_count(run, 1, 10, 200);
    for (int s = 0; s < scenes; s++) {
        for (int i = 0; i < 2; i++) {
            make_quads(&scene, run->seed + (uint64_t)s);
            StabilityPicture expected;
            const StabilityShot shot = shot_of(&scene, settings[i]);
            const bool drawn = stability_draw(run, &shot, &expected);
            dip_test_scene_free(&scene);
            if (drawn) {
                stability_shows(run, &expected, 500);
            }
            for (int v = 0; drawn && v < count; v++) {
                make_quads(&scene, run->seed + (uint64_t)s);
                change(&scene, values[v]);
                compare_with(run, &expected, &scene, settings[i], what, values[v]);
                dip_test_scene_free(&scene);
            }
            if (drawn) {
                stability_picture_free(&expected);
            }
        }
    }
}

// --- near plane -------------------------------------------------------------------------------

static void set_near(DipTestScene *scene, double near_m) {
    scene->def.near_m = (float)near_m;
}

static void measure_near(StabilityRun *run) {
    static const double distances[] = {1.0,  0.5,     0x1p-4, 0.01,    1e-3,  1e-4,
                                       1e-6, 0x1p-24, 1e-9,   0x1p-32, 1e-11, 1e-12};
    compare_changes(run, set_near, distances, sizeof distances / sizeof *distances, "near plane");
}

// --- scale ------------------------------------------------------------------------------------

static void scale_world(DipTestScene *scene, double exponent) {
    const float factor = (float)ldexp(1.0, (int)exponent);
    for (int m = 0; m < scene->def.mesh_count; m++) {
        float *positions = (float *)(uintptr_t)scene->meshes[m].positions;
        for (uint32_t i = 0; i < 3 * scene->meshes[m].vertex_count; i++) {
            positions[i] *= factor;
        }
    }
    for (int i = 0; i < 3; i++) {
        scene->pose.position_world[i] *= (double)factor;
    }
    scene->def.near_m *= factor;
}

static void measure_scale(StabilityRun *run) {
    static const double exponents[] = {-30, -24, -10, -1, 1, 3};
    compare_changes(run, scale_world, exponents, sizeof exponents / sizeof *exponents,
                    "power of two");
}

// --- position ---------------------------------------------------------------------------------

// All coordinates are multiples of 1/16 m, which floats hold up to 1000 km from the origin.
static void move_world(DipTestScene *scene, double distance_m) {
    const double offset[3] = {distance_m, -0.5 * distance_m, 0.25 * distance_m};
    for (int m = 0; m < scene->def.mesh_count; m++) {
        float *positions = (float *)(uintptr_t)scene->meshes[m].positions;
        for (uint32_t i = 0; i < 3 * scene->meshes[m].vertex_count; i++) {
            positions[i] = (float)((double)positions[i] + offset[i % 3]);
        }
    }
    for (int i = 0; i < 3; i++) {
        scene->pose.position_world[i] += offset[i];
    }
}

static void measure_position(StabilityRun *run) {
    static const double distances[] = {4096.0, -65536.0, 131072.0, 524288.0, 1044480.0};
    compare_changes(run, move_world, distances, sizeof distances / sizeof *distances, "moved by");
}

// --- texture coordinates ----------------------------------------------------------------------

static void move_coordinates(DipTestScene *scene, double whole) {
    for (int m = 0; m < scene->def.mesh_count; m++) {
        float *uv0 = (float *)(uintptr_t)scene->meshes[m].uv0;
        for (uint32_t i = 0; i < 2 * scene->meshes[m].vertex_count; i++) {
            uv0[i] += (float)(i % 2 ? whole : -2.0 * whole);
        }
    }
}

static void measure_coordinates(StabilityRun *run) {
    static const double numbers[] = {4096.0, -65536.0, 524288.0};
    compare_changes(run, move_coordinates, numbers, sizeof numbers / sizeof *numbers,
                    "coordinates plus");
}

// --- transforms -------------------------------------------------------------------------------

// Fills a matrix with multiples of 1/4 such that it shears, stretches and often mirrors.
static void fill_transform(Random *random, float transform[12]) {
    for (int i = 0; i < 12; i++) {
        transform[i] = (float)random_int(random, -2, 2) / 4.0f + (i % 5 == 0 ? 1.0f : 0.0f);
    }
}

// Applies a matrix to an object by its transform or, exactly, to the positions of its mesh.
static void apply_transform(DipTestScene *scene, int object, const float t[12], bool by_hand) {
    if (!by_hand) {
        memcpy(scene->objects[object].transform, t, 12 * sizeof *t);
        return;
    }
    float *p = (float *)(uintptr_t)scene->meshes[object].positions;
    for (uint32_t v = 0; v < scene->meshes[object].vertex_count; v++, p += 3) {
        const float from[3] = {p[0], p[1], p[2]};
        for (int i = 0; i < 3; i++) {
            p[i] =
                t[4 * i] * from[0] + t[4 * i + 1] * from[1] + t[4 * i + 2] * from[2] + t[4 * i + 3];
        }
    }
}

static void measure_transforms(StabilityRun *run) {
    static DipTestScene scene;
    const int count = stability_count(run, 3, 40, 2000);
    for (int i = 0; i < count; i++) {
        StabilityPicture pictures[2] = {{0}, {0}};
        for (int by_hand = 0; by_hand < 2; by_hand++) {
            Random random = {run->seed + 1000 + (uint64_t)i};
            make_quads(&scene, run->seed + (uint64_t)i);
            for (int object = 0; object < scene.def.object_count; object++) {
                float transform[12];
                fill_transform(&random, transform);
                apply_transform(&scene, object, transform, by_hand);
            }
            const StabilityShot shot = shot_of(&scene, settings[1]);
            if (stability_draw(run, &shot, &pictures[by_hand])) {
                stability_shows(run, &pictures[by_hand], 100);
            }
            dip_test_scene_free(&scene);
        }
        if (pictures[0].rgb_lin && pictures[1].rgb_lin) {
            stability_error(run, stability_rms(&pictures[0], &pictures[1]), "transforms %d", i);
        }
        stability_picture_free(&pictures[0]);
        stability_picture_free(&pictures[1]);
    }
}

// --- orientation ------------------------------------------------------------------------------

static void turn_camera(DipTestScene *scene) {
    static const double turned[4] = {0.03, -0.05, 0.02, 0.9978};
    memcpy(scene->pose.orientation, turned, sizeof turned);
}

static void set_turned_length(DipTestScene *scene, double length) {
    turn_camera(scene);
    for (int i = 0; i < 4; i++) {
        scene->pose.orientation[i] *= length;
    }
}

static void measure_orientation_length(StabilityRun *run) {
    static const double lengths[] = {1.0,     -1.0,      3.0,    0x1p-1,   1e10,  0x1p-400,
                                     0x1p900, 0x1p-1040, -0x1p3, 0x1p1022, 1e-300};
    static DipTestScene scene;
    make_quads(&scene, run->seed);
    turn_camera(&scene);
    StabilityPicture expected;
    const StabilityShot shot = shot_of(&scene, "aa=8,af=4");
    if (stability_draw_reference(run, &shot, &expected)) {
        for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
            StabilityPicture found;
            set_turned_length(&scene, lengths[i]);
            if (stability_draw(run, &shot, &found)) {
                stability_error(run, stability_rms(&expected, &found), "length %g", lengths[i]);
                stability_picture_free(&found);
            }
        }
        stability_picture_free(&expected);
    }
    dip_test_scene_free(&scene);
}

// --- refused input ----------------------------------------------------------------------------

typedef struct BadScene {
    const char *what;
    const char *key; // the key of the error
    void (*spoil)(DipTestScene *scene);
} BadScene;

static void zero_near(DipTestScene *scene) {
    scene->def.near_m = 0.0f;
}
static void tiny_near(DipTestScene *scene) {
    scene->def.near_m = 1e-20f;
}
static void nan_near(DipTestScene *scene) {
    scene->def.near_m = NAN;
}
static void infinite_colour(DipTestScene *scene) {
    scene->materials[0].base_colour_lin[1] = INFINITY;
}
static void nan_cutoff(DipTestScene *scene) {
    scene->materials[0].alpha_cutoff = NAN;
}
static void nan_background(DipTestScene *scene) {
    scene->def.background_lin[2] = NAN;
}
static void infinite_transform(DipTestScene *scene) {
    scene->objects[1].transform[7] = -INFINITY;
}
static void nan_coordinate(DipTestScene *scene) {
    float *uv0 = (float *)(uintptr_t)scene->meshes[2].uv0;
    uv0[3] = NAN;
}
static void infinite_vertex_colour(DipTestScene *scene) {
    float *colours = dip_test_scene_alloc(scene, 12, sizeof *colours);
    colours[5] = INFINITY;
    scene->meshes[0].colours_lin = colours;
}
static void nan_normal(DipTestScene *scene) {
    float *normals = dip_test_scene_alloc(scene, 12, sizeof *normals);
    normals[11] = NAN;
    scene->meshes[0].normals = normals;
}
static void far_index(DipTestScene *scene) {
    uint32_t *indices = (uint32_t *)(uintptr_t)scene->meshes[0].indices;
    indices[2] = 4;
}
static void missing_texture(DipTestScene *scene) {
    scene->materials[0].colour_texture = 77;
}

static const BadScene bad_scenes[] = {
    {"a near plane at 0", "near_m", zero_near},
    {"a near plane at 1e-20 m", "near_m", tiny_near},
    {"a near plane that is not a number", "near_m", nan_near},
    {"an infinite base colour", "base_colour_lin", infinite_colour},
    {"an alpha cutoff that is not a number", "alpha_cutoff", nan_cutoff},
    {"a background that is not a number", "background_lin", nan_background},
    {"an infinite transform", "transform", infinite_transform},
    {"a texture coordinate that is not a number", "uv0", nan_coordinate},
    {"an infinite vertex colour", "colours_lin", infinite_vertex_colour},
    {"a normal that is not a number", "normals", nan_normal},
    {"an index beyond the vertices", "indices[2]", far_index},
    {"a texture that does not exist", "colour_texture", missing_texture},
};

static void measure_bad_scenes(StabilityRun *run) {
    static DipTestScene scene;
    for (size_t i = 0; i < sizeof bad_scenes / sizeof *bad_scenes; i++) {
        make_quads(&scene, run->seed);
        bad_scenes[i].spoil(&scene);
        DipError err = {0};
        DipScene *made = dip_scene_create(&scene.def, run->pool, &err);
        stability_expect(run, !made && strcmp(err.key, bad_scenes[i].key) == 0, "%s: %s",
                         bad_scenes[i].what, made ? "accepted" : err.key);
        dip_scene_destroy(&made);
        dip_test_scene_free(&scene);
    }
}

// Draws from a pose that must be refused.
static void expect_refused_pose(StabilityRun *run, DipRenderer *renderer, const DipScene *scene,
                                const DipPose *pose, const char *what, double number) {
    DipError err = {0};
    DipFrame frame;
    const bool drawn = dip_renderer_draw(renderer, scene, pose, 0, &frame, &err);
    stability_expect(run, !drawn && err.code == DIP_ERROR_RANGE, "%s %g: %s", what, number,
                     drawn ? "accepted" : err.message);
}

static void measure_bad_poses(StabilityRun *run) {
    static DipTestScene test_scene;
    make_quads(&test_scene, run->seed);
    DipError err = {0};
    DipRendererDef def = dip_renderer_default_def();
    def.pool = run->pool;
    def.width = WIDTH;
    def.height = HEIGHT;
    DipScene *scene = dip_scene_create(&test_scene.def, run->pool, &err);
    DipRenderer *renderer = scene ? dip_renderer_create(&def, &err) : NULL;
    if (renderer) {
        static const double not_finite[] = {NAN, INFINITY, -INFINITY};
        static const double fields_deg[] = {-60.0, 0.0, 0.999, 170.001, 360.0};
        DipPose bad = test_scene.pose;
        memset(bad.orientation, 0, sizeof bad.orientation);
        expect_refused_pose(run, renderer, scene, &bad, "an orientation of length", 0.0);
        for (int i = 0; i < 8 * 3; i++) {
            bad = test_scene.pose;
            double *number = i % 8 < 3   ? &bad.position_world[i % 8]
                             : i % 8 < 7 ? &bad.orientation[i % 8 - 3]
                                         : &bad.fov_y_deg;
            *number = not_finite[i / 8];
            expect_refused_pose(run, renderer, scene, &bad, "a number", *number);
        }
        for (size_t i = 0; i < sizeof fields_deg / sizeof *fields_deg; i++) {
            bad = test_scene.pose;
            bad.fov_y_deg = fields_deg[i];
            expect_refused_pose(run, renderer, scene, &bad, "a field of view", bad.fov_y_deg);
        }
    } else {
        stability_break(run, "%s", err.message);
    }
    dip_renderer_destroy(&renderer);
    dip_scene_destroy(&scene);
    dip_test_scene_free(&test_scene);
}

static const StabilityRow rows[] = {
    {.id = "A3",
     .promise = "The distance of the near plane, from 1e-12 m to 1 m, changes no pixel of a scene "
                "that lies behind it.",
     .truth = "the picture with the near plane at 0.1 m",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_near},
    {.id = "A4",
     .promise = "A world, camera and near plane scaled by a power of two give the same picture.",
     .truth = "the picture of the unscaled world",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_scale},
    {.id = "A8",
     .promise = "A scene and a camera moved together by multiples of 1024 m, up to 1000 km, give "
                "the same picture.",
     .truth = "the picture at the origin",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_position},
    {.id = "A9",
     .promise = "Repeating texture coordinates plus whole multiples of 64, up to a million, give "
                "the same picture.",
     .truth = "the picture without the multiples",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_coordinates},
    {.id = "A10",
     .promise = "Transforms may shear, stretch and mirror.",
     .truth = "meshes whose positions are transformed exactly",
     .unit = "of light, RMS",
     .bound = 0.005,
     .per_isa = true,
     .measure = measure_transforms},
    {.id = "N38",
     .promise = "A pose's quaternion may have any length from 2^-1040 to 2^1022.",
     .truth = "the reference's picture with a quaternion of length 1",
     .unit = "of light, RMS",
     .bound = 0.0016,
     .measure = measure_orientation_length},
    {.id = "A5",
     .promise = "A scene with a number or an index that cannot be drawn is refused, and the error "
                "names it.",
     .truth = "a list of such scenes",
     .unit = "scenes",
     .measure = measure_bad_scenes},
    {.id = "A6",
     .promise = "A pose that cannot be drawn is refused.",
     .truth = "a list of such poses",
     .unit = "poses",
     .measure = measure_bad_poses},
};

const StabilityTopic stability_view = {"view", "Camera, near plane and input", rows,
                                       sizeof rows / sizeof *rows};
