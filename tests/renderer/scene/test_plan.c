// Tests the plan, which decides per frame which effects are necessary. Draws the courtyard along
// its paths, once with only these effects, and once with all effects forced. The pictures must be
// the same, and the planned frames must take less work.
#include "assets/model.h"
#include "campaths/campath.h"
#include "renderer/scene/renderer.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

enum { FRAMES = 40, PLANNED = 0, FORCED = 1 };

static const char *const paths[] = {"aa", "aaa", "af", "ambient", "miplod", "water"};
enum { PATHS = sizeof paths / sizeof *paths };

typedef struct Court {
    DipPool *pool;
    DipScene *scene;
    DipCamPath *paths[PATHS];
    DipRenderer *renderers[2]; // indexed by PLANNED or FORCED
} Court;

static Court court;

static int open_court(void **state) {
    const char *file = DIP_SOURCE_DIR "/assets/courtyard/court.gltf";
    *state = &court;
    court.pool = dip_pool_create(0, NULL);
    DipModel *model = dip_model_load_with_normals(&file, 1, court.pool, NULL, NULL);
    court.scene = model ? dip_scene_create(dip_model_scene_def(model), court.pool, NULL) : NULL;
    dip_model_destroy(&model);
    bool opened = court.scene != NULL;
    for (int i = 0; i < PATHS; i++) {
        char name[512];
        snprintf(name, sizeof name, "%s/campaths/%s.pth", DIP_SOURCE_DIR, paths[i]);
        opened = opened && dip_campath_load(name, &court.paths[i], NULL);
    }
    DipRendererDef def = dip_renderer_default_def();
    def.pool = court.pool;
    def.width = 160;
    def.height = 120;
    def.reflection = (DipReflectionDef){.width = 200, .height = 150, .level_m = 0.66};
    for (int i = 0; opened && i < 2; i++) {
        def.force_all_effects = i == FORCED;
        court.renderers[i] = dip_renderer_create(&def, NULL);
        opened = court.renderers[i] != NULL;
    }
    return opened ? 0 : -1;
}

static int close_court(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        dip_renderer_destroy(&court.renderers[i]);
    }
    for (int i = 0; i < PATHS; i++) {
        dip_campath_destroy(&court.paths[i]);
    }
    dip_scene_destroy(&court.scene);
    dip_pool_destroy(&court.pool);
    return 0;
}

// The work that the frames of a path take, with planned and with forced effects.
typedef struct Sums {
    uint64_t fragments[2];
    uint64_t spared[2];
    int reflections[2];
} Sums;

static void add_frame(int path, int index, Sums *sums) {
    const DipCamPathInfo info = dip_campath_info(court.paths[path]);
    const int64_t time_ns = info.duration_ns / FRAMES * index;
    DipPose pose = {.fov_y_deg = 50.0};
    dip_campath_sample(court.paths[path], time_ns, &pose);
    char hashes[2][33];
    for (int i = 0; i < 2; i++) {
        DipFrame frame;
        dip_renderer_set_frame_index(court.renderers[i], (uint64_t)index);
        assert_true(
            dip_renderer_draw(court.renderers[i], court.scene, &pose, time_ns, &frame, NULL));
        dip_frame_hash(&frame, hashes[i]);
        sums->fragments[i] += frame.counters.fragments_shaded;
        sums->spared[i] += frame.counters.tiles_spared;
        sums->reflections[i] += frame.effects.reflection.run;
    }
    assert_string_equal(hashes[PLANNED], hashes[FORCED]);
}

static Sums follow(int path, const char *settings) {
    Sums sums = {{0}, {0}, {0}};
    DipQuality quality;
    assert_true(dip_quality_parse(settings, &quality, NULL));
    for (int i = 0; i < 2; i++) {
        assert_true(dip_renderer_set_quality(court.renderers[i], &quality, NULL));
    }
    for (int f = 0; f < FRAMES; f++) {
        add_frame(path, f, &sums);
    }
    return sums;
}

static void planned_frames_equal_forced_frames_and_take_less_work(void **state) {
    (void)state;
    static const char *const settings[] = {"aa=none", "aa=4,taa=on,aaa=on,asd=2,af=8"};
    for (int p = 0; p < PATHS; p++) {
        for (size_t s = 0; s < sizeof settings / sizeof *settings; s++) {
            const Sums sums = follow(p, settings[s]);
            printf("%-8s %-30s fragments %8ju of %8ju  tiles spared %4ju  reflections %2d of %2d\n",
                   paths[p], settings[s], (uintmax_t)sums.fragments[PLANNED],
                   (uintmax_t)sums.fragments[FORCED], (uintmax_t)sums.spared[PLANNED],
                   sums.reflections[PLANNED], sums.reflections[FORCED]);
            assert_true(sums.fragments[PLANNED] < sums.fragments[FORCED]);
            assert_true(sums.spared[PLANNED] > sums.spared[FORCED]);
            assert_true(sums.reflections[PLANNED] <= sums.reflections[FORCED]);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planned_frames_equal_forced_frames_and_take_less_work)};
    return cmocka_run_group_tests(tests, open_court, close_court);
}
