// Rows about continuity: a camera that moves by a fraction of a pixel changes the picture little.
// The rows draw the small scenes that the library has; tests/renderer/scene/test_motion.c measures
// the same along the courtyard's paths.
#include "renderer/catalogue/scenes.h"
#include "renderer/catalogue/motion.h"

#include <stdio.h>

enum { WIDTH = 160, HEIGHT = 120 };

static const double step_px = 1.0 / 256.0;

// Returns the distance from the camera at which a step to the side moves the picture by step_px.
static double distance_of(DipTestSceneKind kind) {
    return kind == DIP_TEST_SCENE_lit_sphere ? 0.004 : 1.0; // The nearest sphere is 4 mm away.
}

// Settings without and with anisotropic filtering. Mip colours are left out, because their flat
// colours are meant to show borders.
static const char *const trilinear[] = {
    "aa=none",
    "aa=8,aaa=on,asd=1",
    "aa=4,taa=on,aaa=on,asd=2,opt=standard,miplod=quality",
    "aa=2,opt=advanced,miplod=performance",
    "aa=6,aaa=on,asd=3,gi=off",
    "aa=none,miplod=high-performance",
};
static const char *const anisotropic[] = {
    "aa=4,af=16",
    "aa=8,aaa=on,asd=1,af=16,aaf=on",
    "aa=2,af=2,opt=advanced,miplod=performance",
    "aa=6,taa=on,aaa=on,asd=3,af=8,aaf=on,opt=standard",
    "aa=4,aaa=on,asd=2,af=4,miplod=quality",
    "aa=8,aaa=on,asd=4,af=16,opt=advanced",
};
enum { SETTINGS = sizeof trilinear / sizeof *trilinear };

static StabilityShot shot_of(const DipTestScene *scene, const DipPose *pose, const char *text) {
    return (StabilityShot){.def = &scene->def,
                           .pose = pose,
                           .reflection = scene->reflection.width ? &scene->reflection : NULL,
                           .settings = text,
                           .width = WIDTH,
                           .height = HEIGHT};
}

// One measurement of a row: a scene, settings and the direction of the camera's motion.
typedef struct MotionCase {
    StabilityRun *run;
    const DipTestScene *scene;
    const char *settings;
    MotionStep step;
    char where[120]; // names the scene, the direction and the settings
} MotionCase;

typedef void Measure(const MotionCase *test);

// --- single steps -----------------------------------------------------------------------------

// Draws the scene before and after a step of 1/256 pixel.
static bool draw_step(const MotionCase *test, MotionChange *change) {
    const DipPose moved = motion_move(&test->scene->pose, &test->step);
    const StabilityShot first = shot_of(test->scene, &test->scene->pose, test->settings);
    const StabilityShot second = shot_of(test->scene, &moved, test->settings);
    StabilityPicture before = {0};
    StabilityPicture after = {0};
    const bool drawn = stability_draw(test->run, &first, &before) &&
                       stability_draw(test->run, &second, &after) &&
                       stability_shows(test->run, &before, 3); // Far checkers are nearly grey.
    if (drawn) {
        *change = motion_compare(&before, &after);
    }
    stability_picture_free(&before);
    stability_picture_free(&after);
    return drawn;
}

static void measure_block(const MotionCase *test) {
    MotionChange change;
    if (draw_step(test, &change)) {
        stability_error(test->run, change.mean.value, "%s, block at %d,%d", test->where,
                        change.mean.x, change.mean.y);
    }
}

static void measure_picture(const MotionCase *test) {
    MotionChange change;
    if (draw_step(test, &change)) {
        stability_error(test->run, change.picture / (step_px * change.gradient), "%s", test->where);
    }
}

// --- searches ---------------------------------------------------------------------------------

static bool draw_pose(void *context, const DipPose *pose, StabilityPicture *picture) {
    const MotionCase *test = context;
    const StabilityShot shot = shot_of(test->scene, pose, test->settings);
    stability_picture_free(picture);
    return stability_draw(test->run, &shot, picture);
}

// Searches for the step that makes the picture pop. The short form measures a single step. The
// camera is rolled by 0.3 rad, so that no edge is parallel to the columns of pixels: an edge that
// passes over the samples of a whole column at once is no pop, but looks like one.
static void measure_broad(const MotionCase *test) {
    const MotionStep roll = {MOTION_ROLL, 0.3 * 0.5 * HEIGHT, HEIGHT, 1.0};
    MotionCase copy = *test;
    MotionSearch search = {.draw = draw_pose,
                           .context = &copy,
                           .pose = motion_move(&test->scene->pose, &roll),
                           .step = test->step};
    MotionChange change;
    double at_px = 0.0;
    if (test->run->depth == STABILITY_SHORT ? draw_step(test, &change)
                                            : motion_search(&search, &change, &at_px)) {
        stability_error(test->run, change.broad.value, "%s, after %.4f pixels, block at %d,%d",
                        test->where, at_px, change.broad.x, change.broad.y);
    }
    for (int i = 0; i < 3; i++) {
        stability_picture_free(&search.pictures[i]);
    }
}

// --- rows -------------------------------------------------------------------------------------

static void measure_scenes(StabilityRun *run, const char *const settings[SETTINGS],
                           Measure *measure) {
    static DipTestScene scene;
    const int setting_count = stability_count(run, 1, 2, SETTINGS);
    const int scene_stride = stability_count(run, 8, 1, 1);
    const int kind_stride = stability_count(run, 6, 6, 1);
    for (int i = 0; i < DIP_TEST_SCENE_COUNT; i += scene_stride) {
        const DipTestSceneKind kind = (DipTestSceneKind)i;
        dip_test_scene_make(&scene, kind);
        for (int s = 0; s < setting_count; s++) {
            for (int k = (i + s) % kind_stride; k < MOTION_KINDS; k += kind_stride) {
                const MotionStep step = {(MotionKind)k, step_px, HEIGHT, distance_of(kind)};
                MotionCase test = {
                    .run = run, .scene = &scene, .settings = settings[s], .step = step};
                snprintf(test.where, sizeof test.where, "%s, %s with %s", dip_test_scene_name(kind),
                         motion_names[k], settings[s]);
                measure(&test);
            }
        }
        dip_test_scene_free(&scene);
    }
}

static void measure_blocks(StabilityRun *run) {
    measure_scenes(run, trilinear, measure_block);
    measure_scenes(run, anisotropic, measure_block);
}

static void measure_trilinear(StabilityRun *run) {
    measure_scenes(run, trilinear, measure_broad);
}

static void measure_anisotropic(StabilityRun *run) {
    measure_scenes(run, anisotropic, measure_broad);
}

static void measure_pictures(StabilityRun *run) {
    measure_scenes(run, trilinear, measure_picture);
    measure_scenes(run, anisotropic, measure_picture);
}

static const StabilityRow rows[] = {
    {.id = "A61",
     .promise = "A camera that turns or moves by 1/256 of a pixel changes no 8x8 block more than "
                "an edge that passes over the samples of one column.",
     .truth = "continuity: a column of 8 pixels that changes from black to white",
     .unit = "of light, mean of a block",
     .bound = 0.125,
     .measure = measure_blocks},
    {.id = "A62",
     .promise = "With af=none, a camera that turns or moves by 1/256 of a pixel changes at most a "
                "quarter of a block's pixels by more than about one 8-bit code: nothing pops.",
     .truth = "continuity: only edges may change a pixel by more",
     .unit = "of light",
     .bound = 0.01,
     .measure = measure_trilinear},
    {.id = "A63",
     .promise = "With anisotropic filtering, at most a quarter of a block's pixels change by more "
                "than what one texture probe more or less changes.",
     .truth = "continuity, except where the number of probes of a whole surface changes",
     .unit = "of light",
     .bound = 0.04,
     .measure = measure_anisotropic},
    {.id = "A64",
     .promise = "A camera that turns or moves by a step h of 1/256 pixel changes the picture in "
                "proportion to h.",
     .truth = "the mean difference of neighbouring pixels",
     .unit = "times h times this difference",
     .bound = 8.0,
     .measure = measure_pictures},
};

const StabilityTopic stability_motion = {"motion", "Small motions of the camera", rows,
                                         sizeof rows / sizeof *rows};
