// Draws the test scenes and compares their pictures with the shipped hashes.
#include "renderer/catalogue/shipped_hashes.h"

#include "renderer/catalogue/pictures.h"

#include <stdio.h>
#include <string.h>

// Frames that a history has before the picture: as many as let the new picture's share be its
// least one.
enum { FRAMES_BEFORE = 6 };

bool stability_draw_hash(StabilityRun *run, DipTestSceneKind kind, const char *settings,
                         bool force_all, char hash[33]) {
    static DipTestScene scene;
    dip_test_scene_make(&scene, kind);
    const int before = strstr(settings, "taa=history") ? FRAMES_BEFORE : 0;
    const StabilityShot shot = {.def = &scene.def,
                                .pose = &scene.pose,
                                .reflection = scene.reflection.width ? &scene.reflection : NULL,
                                .settings = settings,
                                .width = 97,
                                .height = 61,
                                .time_ns = INT64_C(123456789012),
                                .frame_index = 1 + (uint64_t)before,
                                .frames_before = before,
                                .force_all = force_all};
    StabilityPicture picture;
    const bool drawn = stability_draw(run, &shot, &picture);
    if (drawn) {
        memcpy(hash, picture.hash, sizeof picture.hash);
        stability_picture_free(&picture);
    }
    dip_test_scene_free(&scene);
    return drawn;
}

void stability_compare_hashes(StabilityRun *run, void (*progress)(void *context), void *context) {
    const size_t step = (size_t)stability_count(run, 7, 1, 1);
    for (size_t i = 0; i < stability_hash_count && !run->broken; i += step) {
        const StabilityHash *expected = &stability_hashes[i];
        char hash[33];
        if (stability_draw_hash(run, expected->scene, expected->settings, false, hash)) {
            stability_expect(run, strcmp(hash, expected->hash) == 0, "%s with %s",
                             dip_test_scene_name(expected->scene), expected->settings);
        }
        if (progress) {
            progress(context);
        }
    }
}

bool stability_print_hashes(DipPool *pool) {
    StabilityRun run = {.isa = DIP_ISA_SCALAR, .pool = pool};
    for (size_t i = 0; i < stability_hash_count && !run.broken; i++) {
        const StabilityHash *row = &stability_hashes[i];
        char hash[33];
        if (stability_draw_hash(&run, row->scene, row->settings, false, hash)) {
            printf("    {DIP_TEST_SCENE_%s, \"%s\", \"%s\"},\n", dip_test_scene_name(row->scene),
                   row->settings, hash);
        }
    }
    if (run.broken) {
        fprintf(stderr, "%s\n", run.broken_why);
    }
    return !run.broken;
}
