// Rows about what must not change a picture: threads, panes drawn together, copies of meshes.
#include "renderer/catalogue/scenes.h"
#include "renderer/catalogue/pictures.h"

#include <string.h>

enum { WIDTH = 150, HEIGHT = 90, PANES = 2 };

static const char *const pane_settings[][PANES] = {
    {"aa=none", "aa=8,af=16"},
    {"aa=4,aaa=on", "aa=6,taa=on,opt=advanced"},
    {"aa=2,mipdebug=on", "aa=2,gi=off,miplod=performance"},
};

static StabilityShot shot_of(const DipTestScene *scene, const char *settings) {
    return (StabilityShot){.def = &scene->def,
                           .pose = &scene->pose,
                           .reflection = scene->reflection.width ? &scene->reflection : NULL,
                           .settings = settings,
                           .width = WIDTH,
                           .height = HEIGHT,
                           .time_ns = 987654321,
                           .frame_index = 0};
}

static int scene_count(const StabilityRun *run) {
    return stability_count(run, 2, DIP_TEST_SCENE_COUNT, DIP_TEST_SCENE_COUNT);
}

// The scenes from the last kind on, which has all effects.
static DipTestSceneKind scene_kind(int index) {
    return (DipTestSceneKind)((DIP_TEST_SCENE_water_effects + index) % DIP_TEST_SCENE_COUNT);
}

// --- threads ----------------------------------------------------------------------------------

static void compare_threads(StabilityRun *run, const DipTestScene *scene, DipTestSceneKind kind) {
    static const int thread_counts[] = {1, 2, 3, 7, 16};
    const StabilityShot shot = shot_of(scene, "aa=4,af=4");
    char expected[33] = "";
    for (size_t t = 0; t < sizeof thread_counts / sizeof *thread_counts; t++) {
        DipError err = {0};
        StabilityPicture picture;
        StabilityRun own = *run;
        own.pool = dip_pool_create(thread_counts[t], &err);
        if (!own.pool) {
            stability_break(run, "%s", err.message);
            return;
        }
        if (stability_draw(&own, &shot, &picture)) {
            run->hash = own.hash;
            if (t == 0) {
                memcpy(expected, picture.hash, sizeof expected);
            }
            stability_expect(run, strcmp(picture.hash, expected) == 0, "%s with %d threads",
                             dip_test_scene_name(kind), thread_counts[t]);
            stability_picture_free(&picture);
        } else {
            stability_break(run, "%s", own.broken_why);
        }
        dip_pool_destroy(&own.pool);
    }
}

static void measure_threads(StabilityRun *run) {
    static DipTestScene scene;
    for (int i = 0; i < scene_count(run); i++) {
        dip_test_scene_make(&scene, scene_kind(i));
        compare_threads(run, &scene, scene_kind(i));
        dip_test_scene_free(&scene);
    }
}

// --- panes ------------------------------------------------------------------------------------

// Draws both panes together and compares each with its frame drawn alone.
static void compare_panes(StabilityRun *run, const DipTestScene *scene,
                          const char *const settings[PANES]) {
    DipError err = {0};
    DipScene *made = dip_scene_create(&scene->def, run->pool, &err);
    DipRenderer *renderers[PANES] = {NULL, NULL};
    DipFrame frames[PANES];
    DipFrame *const pointers[PANES] = {&frames[0], &frames[1]};
    bool ready = made != NULL;
    for (int p = 0; p < PANES && ready; p++) {
        DipRendererDef def = dip_renderer_default_def();
        def.pool = run->pool;
        def.isa = run->isa;
        def.width = WIDTH;
        def.height = HEIGHT;
        def.reflection = scene->reflection;
        ready = dip_quality_parse(settings[p], &def.quality, &err);
        renderers[p] = ready ? dip_renderer_create(&def, &err) : NULL;
        ready = renderers[p] != NULL;
    }
    ready = ready && dip_renderer_draw_frames(renderers, PANES, made, &scene->pose, 987654321,
                                              pointers, &err);
    for (int p = 0; p < PANES && ready; p++) {
        const StabilityShot shot = shot_of(scene, settings[p]);
        StabilityPicture alone;
        char hash[33];
        dip_frame_hash(&frames[p], hash);
        if (stability_draw(run, &shot, &alone)) {
            stability_expect(run, strcmp(hash, alone.hash) == 0, "%s beside %s", settings[p],
                             settings[!p]);
            stability_picture_free(&alone);
        }
    }
    if (!ready) {
        stability_break(run, "%s", err.message);
    }
    dip_renderer_destroy(&renderers[0]);
    dip_renderer_destroy(&renderers[1]);
    dip_scene_destroy(&made);
}

static void measure_panes(StabilityRun *run) {
    static DipTestScene scene;
    for (int i = 0; i < scene_count(run); i++) {
        for (int s = 0; s < 3; s++) {
            dip_test_scene_make(&scene, scene_kind(i));
            compare_panes(run, &scene, pane_settings[s]);
            dip_test_scene_free(&scene);
        }
    }
}

// --- settings that change no pixel ------------------------------------------------------------

static void compare_settings(StabilityRun *run, const char *first, const char *second) {
    static DipTestScene scene;
    for (int i = 0; i < scene_count(run); i++) {
        dip_test_scene_make(&scene, scene_kind(i));
        StabilityPicture a;
        StabilityPicture b;
        const StabilityShot shots[2] = {shot_of(&scene, first), shot_of(&scene, second)};
        if (stability_draw(run, &shots[0], &a)) {
            if (stability_draw(run, &shots[1], &b)) {
                stability_error(run, stability_differing(&a, &b, 0.0), "%s",
                                dip_test_scene_name(scene_kind(i)));
                stability_picture_free(&b);
            }
            stability_picture_free(&a);
        }
        dip_test_scene_free(&scene);
    }
}

static void measure_instancing(StabilityRun *run) {
    compare_settings(run, "aa=4,af=2,gi=on", "aa=4,af=2,gi=off");
}

static const StabilityRow rows[] = {
    {.id = "N52",
     .promise = "1, 2, 3, 7 and 16 threads draw the same bits.",
     .truth = "the picture of one thread",
     .unit = "pictures",
     .per_isa = true,
     .measure = measure_threads},
    {.id = "N54",
     .promise = "Two panes drawn together do not touch each other.",
     .truth = "each pane drawn alone",
     .unit = "pictures",
     .per_isa = true,
     .measure = measure_panes},
    {.id = "N55",
     .promise = "Geometry instancing changes no pixel.",
     .truth = "the picture without instancing",
     .unit = "pixels",
     .per_isa = true,
     .measure = measure_instancing},
};

const StabilityTopic stability_parallel = {"parallel", "Threads, panes and copies", rows,
                                           sizeof rows / sizeof *rows};
