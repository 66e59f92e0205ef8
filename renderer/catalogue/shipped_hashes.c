// Draws the test scenes and compares their pictures with the shipped hashes.
#include "renderer/catalogue/shipped_hashes.h"

#include "renderer/catalogue/pictures.h"

#include <stdio.h>
#include <string.h>

// Together, these settings use every step of sampling, filtering and effects, and every filter of
// the finished picture. Their number and the step of a short run have no common divisor.
static const char *const all_settings[] = {
    "aa=none,af=none",
    "aa=8,aaa=on,asd=2,af=16,aaf=on",
    "aa=6,taa=on,af=2,miplod=performance,opt=advanced",
    "aa=4,gi=off,mipdebug=on,opt=standard,af=8",
    "aa=4,aaa=coverage,miplod=sharp,scale=1/1.5,upscale=easu,post=smaa,sharpen=high",
    "aa=2,aaa=all,taa=history,miplod=sharper,scale=1.25,post=fxaa,sharpen=low",
    "taa=history,af=4,scale=1/2,upscale=bicubic,sharpen=medium",
    "aa=8,aaa=coverage,scale=2,post=smaa",
    "aa=6,scale=1/1.3,upscale=bilinear,post=fxaa",
};

// Frames that a history has before the picture.
enum { FRAMES_BEFORE = 3 };

static bool draw_hash(StabilityRun *run, DipTestScene *scene, const char *settings, char hash[33]) {
    const int before = strstr(settings, "taa=history") ? FRAMES_BEFORE : 0;
    const StabilityShot shot = {.def = &scene->def,
                                .pose = &scene->pose,
                                .reflection = scene->reflection.width ? &scene->reflection : NULL,
                                .settings = settings,
                                .width = 97,
                                .height = 61,
                                .time_ns = INT64_C(123456789012),
                                .frame_index = 1 + (uint64_t)before,
                                .frames_before = before};
    StabilityPicture picture;
    if (!stability_draw(run, &shot, &picture)) {
        return false;
    }
    memcpy(hash, picture.hash, sizeof picture.hash);
    stability_picture_free(&picture);
    return true;
}

void stability_compare_hashes(StabilityRun *run, void (*progress)(void *context), void *context) {
    static DipTestScene scene;
    const size_t step = (size_t)stability_count(run, 7, 1, 1);
    for (size_t i = 0; i < stability_hash_count && !run->broken; i += step) {
        const StabilityHash *expected = &stability_hashes[i];
        char hash[33];
        dip_test_scene_make(&scene, expected->scene);
        if (draw_hash(run, &scene, expected->settings, hash)) {
            stability_expect(run, strcmp(hash, expected->hash) == 0, "%s with %s",
                             dip_test_scene_name(expected->scene), expected->settings);
        }
        dip_test_scene_free(&scene);
        if (progress) {
            progress(context);
        }
    }
}

bool stability_print_hashes(DipPool *pool) {
    static DipTestScene scene;
    StabilityRun run = {.isa = DIP_ISA_SCALAR, .pool = pool};
    for (int kind = 0; kind < DIP_TEST_SCENE_COUNT; kind++) {
        for (size_t s = 0; s < sizeof all_settings / sizeof *all_settings; s++) {
            char hash[33];
            dip_test_scene_make(&scene, (DipTestSceneKind)kind);
            if (draw_hash(&run, &scene, all_settings[s], hash)) {
                printf("    {DIP_TEST_SCENE_%s, \"%s\", \"%s\"},\n",
                       dip_test_scene_name((DipTestSceneKind)kind), all_settings[s], hash);
            }
            dip_test_scene_free(&scene);
        }
    }
    if (run.broken) {
        fprintf(stderr, "%s\n", run.broken_why);
    }
    return !run.broken;
}
