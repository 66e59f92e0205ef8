// Rows about large coordinates: scenes far from the origin, large triangles, and texture
// coordinates with large whole parts.
#include "renderer/base/trig.h"
#include "renderer/scene/draw/draws.h"
#include "renderer/catalogue/random.h"
#include "renderer/catalogue/scenes.h"
#include "renderer/catalogue/pictures.h"

#include <math.h>
#include <string.h>

enum { WIDTH = 96, HEIGHT = 72 };

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

static const char *const settings[] = {"aa=none", "aa=4,af=16", "aa=8,aaa=on,asd=2,af=4,aaf=on"};
enum { SETTINGS = sizeof settings / sizeof *settings };

// Changes a scene of a kind in a way that must not change its picture. Change 0 is the scene that
// the others are compared with.
typedef void Change(DipTestScene *scene, int change);

// Compares each change with change 0, for all kinds of scenes.
static void compare_changes(StabilityRun *run, Change *change, int change_count, const char *what) {
    const int step = stability_count(run, 16, 1, 1);
    for (int kind = 0; kind < DIP_TEST_SCENE_COUNT; kind += step) {
        const char *text = settings[kind / step % SETTINGS];
        StabilityPicture first = {0};
        for (int i = 0; i < change_count && !run->broken; i++) {
            static DipTestScene scene;
            StabilityPicture picture;
            dip_test_scene_make(&scene, (DipTestSceneKind)kind);
            change(&scene, i);
            if (draw(run, &scene, text, i ? &picture : &first) && i) {
                stability_error(run, stability_differing(&first, &picture, 0.0), "%s, %s %d, %s",
                                dip_test_scene_name((DipTestSceneKind)kind), what, i, text);
                stability_picture_free(&picture);
            }
            dip_test_scene_free(&scene);
        }
        stability_picture_free(&first);
    }
}

// --- scenes that move together with the camera ---------------------------------------------------

// Floats hold the positions of scenes that are enlarged by this factor even 10,000 km from the
// origin.
#define ENLARGED 64.0f

static void enlarge_and_move(DipTestScene *scene, int change) {
    static const double moves[][3] = {
        {0.0, 0.0, 0.0},
        {1024.0, 0.0, 0.0},
        {-65536.0, 1024.0, 65536.0},
        {131072.0, -131072.0, 2048.0},
        {0.0, 1000448.0, -1000448.0},
        {10000384.0, 0.0, 10000384},
    };
    dip_test_scene_enlarge(scene, ENLARGED);
    dip_test_scene_move(scene, moves[change]);
}

static void measure_moved(StabilityRun *run) {
    compare_changes(run, enlarge_and_move, 6, "move");
}

// --- whole numbers added to texture coordinates --------------------------------------------------

static void shift_by(DipTestScene *scene, int change) {
    static const float shifts[][2] = {
        {0.0f, 0.0f}, {4096.0f, 0.0f}, {-65536.0f, 4096.0f}, {1048576.0f, -1048576.0f}};
    dip_test_scene_shift_uv(scene, shifts[change]);
}

static void measure_whole_numbers(StabilityRun *run) {
    compare_changes(run, shift_by, 4, "shift");
}

// Mirrors the textures that repeat: along both axes, or only along u in every second texture, whose
// v still repeats.
static void mirror_and_shift_by(DipTestScene *scene, int change) {
    for (int t = 0; t < scene->def.texture_count; t++) {
        DipTextureDef *texture = &scene->textures[t];
        if (texture->wrap_u == DIP_WRAP_REPEAT) {
            texture->wrap_u = DIP_WRAP_MIRROR;
        }
        if (texture->wrap_v == DIP_WRAP_REPEAT && t % 2 == 0) {
            texture->wrap_v = DIP_WRAP_MIRROR;
        }
    }
    shift_by(scene, change);
}

static void measure_mirrored(StabilityRun *run) {
    compare_changes(run, mirror_and_shift_by, 4, "shift");
}

// A quad that faces the camera has the same level of detail everywhere, also where its coordinates
// pass whole numbers.
static void measure_seams(StabilityRun *run) {
    static const float offsets[] = {0.0f, -0.5f, 31.5f, 64.0f, 100000.0f};
    Random random = {run->seed};
    const int count = stability_count(run, 5, 250, 10000);
    for (int n = 0; n < count; n++) {
        static DipTestScene scene;
        dip_test_scene_begin(&scene);
        const int size = 32 << n % 4;
        const int material = dip_test_scene_add_material(
            &scene, dip_test_scene_add_texture(&scene, DIP_TEST_CHECKER, size, size));
        const float turn = (float)random_real(&random, 0.0, 1.5);
        const float a[3] = {8.0f * (float)dip_cos(turn), 8.0f * (float)dip_sin(turn), 0.0f};
        const float b[3] = {-a[1], a[0], 0.0f};
        const float corner[3] = {-0.5f * (a[0] + b[0]), -0.5f * (a[1] + b[1]), -2.0f};
        const float repeats = (float)random_real(&random, 2.0, 9.0);
        dip_test_scene_add_quad(&scene, material, corner, a, b, repeats, repeats);
        for (int i = 0; i < 8; i++) {
            ((float *)(uintptr_t)scene.meshes[0].uv0)[i] += offsets[n % 5];
        }
        StabilityPicture picture;
        const char *text = n % 2 ? "mipdebug=on" : "mipdebug=on,af=16";
        if (draw(run, &scene, text, &picture)) {
            double worst = 0.0;
            for (int i = 3; i < 3 * WIDTH * HEIGHT; i++) {
                worst = fmax(worst, fabs(picture.rgb_lin[i] - picture.rgb_lin[i % 3]));
            }
            stability_error(run, worst, "%g repeats from %g, %s", (double)repeats,
                            (double)offsets[n % 5], text);
            stability_picture_free(&picture);
        }
        dip_test_scene_free(&scene);
    }
}

// --- a large floor -------------------------------------------------------------------------------

// The coordinates that the fragment shader gets at each pixel.
typedef struct Seen {
    bool there;
    double u;
    double v;
} Seen;

static Seen seen[HEIGHT][WIDTH];

static void record(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        seen[(int)batch->y[i]][(int)batch->x[i]] =
            (Seen){true, (double)batch->varying[0][i], (double)batch->varying[1][i]};
        for (int c = 0; c < 3; c++) {
            batch->colour[c][i] = 0.0f;
        }
    }
}

// Makes a floor at y = 0 with one repeat of its texture per metre. Its texture coordinates are its
// x and -z, plus a whole number.
static void make_floor(DipTestScene *scene, float half, float whole) {
    dip_test_scene_begin(scene);
    const int material = dip_test_scene_add_material(
        scene, dip_test_scene_add_texture(scene, DIP_TEST_NOISE, 16, 16));
    dip_test_scene_add_quad(scene, material, (const float[]){-half, 0, half},
                            (const float[]){2 * half, 0, 0}, (const float[]){0, 0, -2 * half},
                            2 * half, 2 * half);
    for (int i = 0; i < 8; i++) {
        ((float *)(uintptr_t)scene->meshes[0].uv0)[i] += whole - half;
    }
}

// Draws the floor and fills in `seen`.
static bool draw_floor(StabilityRun *run, const DipTestScene *scene) {
    DipError err = {0};
    DipScene *made = dip_scene_create(&scene->def, run->pool, &err);
    DipPipeline *pipeline =
        made ? dip_pipeline_create(run->pool, run->isa, WIDTH, HEIGHT, &err) : NULL;
    DipDrawSet set = {.count = 0};
    bool drawn = pipeline && dip_draw_set_make(&set, made, false, &err);
    if (drawn) {
        const DipQuality quality = dip_quality_default();
        const DipView view =
            dip_view_make(&scene->pose, (double)scene->def.near_m, (double)WIDTH / HEIGHT);
        static const DipMaterialSamplers samplers[1];
        const DipDrawInput input = {.scene = made,
                                    .kernels = dip_material_kernels(run->isa),
                                    .quality = &quality,
                                    .samplers = samplers};
        const DipDrawView pass_view = {.view = &view, .width = WIDTH, .height = HEIGHT};
        dip_draw_set_fill(&set, &input, &pass_view);
        set.draws[0].fragment_shader = record;
        static uint32_t pixels[WIDTH * HEIGHT];
        const DipPass pass = {.draws = set.draws,
                              .draw_count = 1,
                              .sample_count = 1,
                              .target = {.rgba8 = (uint8_t *)pixels,
                                         .stride_bytes = 4 * WIDTH,
                                         .width = WIDTH,
                                         .height = HEIGHT}};
        DipPipelineCounters counters = {0};
        DipStageTimes times = {0};
        memset(seen, 0, sizeof seen);
        drawn = dip_pipeline_draw(pipeline, &pass, &counters, &times, &err);
    }
    if (!drawn) {
        stability_break(run, "the floor cannot be drawn: %s", err.message);
    }
    dip_draw_set_free(&set);
    dip_pipeline_destroy(&pipeline);
    dip_scene_destroy(&made);
    return drawn;
}

// Computes the exact coordinates of the floor at a position in pixels, but for the whole number.
static void exact_coordinates(const DipPose *pose, long double x, long double y,
                              long double uv[2]) {
    const long double slope = 1.0L / sqrtl(3.0L); // the field of view is 60 degrees
    const long double ray[3] = {(2.0L * x / WIDTH - 1.0L) * slope * WIDTH / HEIGHT,
                                (1.0L - 2.0L * y / HEIGHT) * slope, -1.0L};
    const long double a = pose->orientation[0], b = pose->orientation[1], c = pose->orientation[2],
                      d = pose->orientation[3];
    const long double rows[3][3] = {
        {1 - 2 * (b * b + c * c), 2 * (a * b - d * c), 2 * (a * c + d * b)},
        {2 * (a * b + d * c), 1 - 2 * (a * a + c * c), 2 * (b * c - d * a)},
        {2 * (a * c - d * b), 2 * (b * c + d * a), 1 - 2 * (a * a + b * b)}};
    long double world[3];
    for (int i = 0; i < 3; i++) {
        world[i] = rows[i][0] * ray[0] + rows[i][1] * ray[1] + rows[i][2] * ray[2];
    }
    const long double distance = -pose->position_world[1] / world[1];
    uv[0] = pose->position_world[0] + world[0] * distance;
    uv[1] = -pose->position_world[2] - world[2] * distance;
}

// Returns the difference of two repeating coordinates, within +-1/2.
static double wrapped(long double difference) {
    return (double)(difference - floorl(difference + 0.5L));
}

// Returns by how many pixels the texture is out of place at pixel (x, y). Returns 0 where a pixel
// covers so much of the texture that repeats could be confused.
static double displacement(const DipPose *pose, int x, int y) {
    long double at[2], right[2], below[2];
    const long double step = 0.001L;
    exact_coordinates(pose, x + 0.5L, y + 0.5L, at);
    exact_coordinates(pose, x + 0.5L + step, y + 0.5L, right);
    exact_coordinates(pose, x + 0.5L, y + 0.5L + step, below);
    double j[4];
    for (int i = 0; i < 2; i++) {
        j[i] = (double)((right[i] - at[i]) / step);
        j[2 + i] = (double)((below[i] - at[i]) / step);
    }
    if (fabs(j[0]) + fabs(j[1]) + fabs(j[2]) + fabs(j[3]) > 0.25) {
        return 0.0;
    }
    const double u = wrapped(seen[y][x].u - at[0]);
    const double v = wrapped(seen[y][x].v - at[1]);
    const double area = j[0] * j[3] - j[1] * j[2];
    return hypot((u * j[3] - v * j[2]) / area, (v * j[0] - u * j[1]) / area);
}

// Turns a camera by yaw, then pitch, then roll, in radians.
static void turn(double yaw, double pitch, double roll, double q[4]) {
    const double a[4] = {
        dip_cos(yaw / 2) * dip_sin(-pitch / 2), dip_sin(yaw / 2) * dip_cos(pitch / 2),
        dip_sin(yaw / 2) * dip_sin(pitch / 2), dip_cos(yaw / 2) * dip_cos(pitch / 2)};
    const double c = dip_cos(roll / 2);
    const double s = dip_sin(roll / 2);
    q[0] = a[0] * c + a[1] * s;
    q[1] = a[1] * c - a[0] * s;
    q[2] = a[2] * c + a[3] * s;
    q[3] = a[3] * c - a[2] * s;
}

static void measure_floor(StabilityRun *run) {
    Random random = {run->seed + 1};
    const int count = stability_count(run, 12, 300, 20000);
    for (int n = 0; n < count; n++) {
        static DipTestScene scene;
        const double half = round(random_magnitude(&random, 3, 16));
        const double above = 0.1 * random_magnitude(&random, 0, 4);
        const double whole = n % 2 ? 65536.0 : 0.0;
        make_floor(&scene, (float)half, (float)whole);
        const double yaw = random_real(&random, -3.1, 3.1);
        const double pitch = random_real(&random, 0.0, 0.6);
        turn(yaw, pitch, random_real(&random, -0.3, 0.3), scene.pose.orientation);
        scene.pose.position_world[0] = random_real(&random, -0.9, 0.9) * half;
        scene.pose.position_world[1] = above;
        scene.pose.position_world[2] = random_real(&random, -0.9, 0.9) * half;
        double worst = 0.0;
        int shown = 0;
        for (int i = 0; i < WIDTH * HEIGHT && (i || draw_floor(run, &scene)); i++) {
            if (seen[i / WIDTH][i % WIDTH].there) {
                const double uv[2] = {seen[i / WIDTH][i % WIDTH].u, seen[i / WIDTH][i % WIDTH].v};
                stability_keep(run, uv, 2);
                worst = fmax(worst, displacement(&scene.pose, i % WIDTH, i / WIDTH));
                shown++;
            }
        }
        if (shown) {
            stability_error(run, worst, "floor of %g m, eye %g m above it, %g added", 2.0 * half,
                            above, whole);
        }
        dip_test_scene_free(&scene);
    }
}

static const StabilityRow rows[] = {
    {.id = "A20",
     .promise = "A scene and camera moved together by multiples of 1024 m, up to 10,000 km, give "
                "the same picture, if floats hold the moved positions.",
     .truth = "the picture at the origin",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_moved},
    {.id = "N13",
     .promise =
         "A floor of 16 m to 262 km, seen from 0.1 m to 3.2 m above it, shows its texture in "
         "place, also where 65,536 is added to its coordinates.",
     .truth = "rays through the pixels, in `long double`",
     .unit = "pixels",
     .bound = 0.05,
     .per_isa = true,
     .measure = measure_floor},
    {.id = "N26",
     .promise = "Multiples of 128 added to the coordinates of repeating textures, up to 2^20, "
                "change no pixel, if floats hold the sums.",
     .truth = "the picture with the smaller coordinates",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_whole_numbers},
    {.id = "A65",
     .promise = "Multiples of 128 added to the coordinates of mirrored textures, up to 2^20, "
                "change no pixel, if floats hold the sums.",
     .truth = "the picture with the smaller coordinates",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_mirrored},
    {.id = "N29",
     .promise = "The level of detail is the same on both sides of the seam where a coordinate "
                "passes a whole number.",
     .truth = "one mip colour over a quad that faces the camera",
     .unit = "of light",
     .bound = 0.01,
     .per_isa = true,
     .measure = measure_seams},
};

const StabilityTopic stability_distance = {"distance", "Large coordinates", rows,
                                           sizeof rows / sizeof *rows};
