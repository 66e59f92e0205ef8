// Tests settings that change how a picture of the courtyard is computed. Without instancing, the
// picture must have the same bits and take more memory. With optimised textures, the picture must
// take less work.
#include "assets/model.h"
#include "campaths/campath.h"
#include "renderer/scene/renderer.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { FRAMES = 3, TRIANGLE_BYTES = 3 }; // a triangle has three indices of one byte

static DipPool *pool;
static DipScene *scene;
static DipRenderer *renderer;
static DipCamPath *path;

static int open_court(void **state) {
    (void)state;
    const char *file = DIP_SOURCE_DIR "/assets/courtyard/court.gltf";
    DipError err = {0};
    pool = dip_pool_create(2, &err);
    DipModel *model = dip_model_load_with_normals(&file, 1, pool, NULL, &err);
    scene = model ? dip_scene_create(dip_model_scene_def(model), pool, &err) : NULL;
    dip_model_destroy(&model);
    DipRendererDef def = dip_renderer_default_def();
    def.pool = pool;
    def.width = 320;
    def.height = 240;
    renderer = dip_renderer_create(&def, &err);
    const bool loaded = dip_campath_load(DIP_SOURCE_DIR "/campaths/ambient.pth", &path, &err);
    return scene && renderer && loaded ? 0 : -1;
}

static int close_court(void **state) {
    (void)state;
    dip_scene_destroy(&scene); // destroyed while the renderer may still hold copies of its meshes
    dip_renderer_destroy(&renderer);
    dip_campath_destroy(&path);
    dip_pool_destroy(&pool);
    return 0;
}

static DipFrame draw(const char *settings, int frame_index) {
    DipError err = {0};
    DipQuality quality;
    DipFrame frame;
    DipPose pose = {.fov_y_deg = 45.0};
    dip_campath_sample(path, dip_campath_info(path).duration_ns / FRAMES * frame_index, &pose);
    assert_true(dip_quality_parse(settings, &quality, &err));
    assert_true(dip_renderer_set_quality(renderer, &quality, &err));
    assert_true(dip_renderer_draw(renderer, scene, &pose, 0, &frame, &err));
    return frame;
}

static void pictures_do_not_depend_on_instancing(void **state) {
    (void)state;
    static const char *const settings[] = {"aa=none", "aa=4,af=16",
                                           "aa=8,aaa=on,asd=2,opt=advanced", "mipdebug=on"};
    for (size_t s = 0; s < sizeof settings / sizeof *settings; s++) {
        for (int f = 0; f < FRAMES; f++) {
            char off[64];
            char hashes[3][33];
            snprintf(off, sizeof off, "%s,gi=off", settings[s]);
            const DipFrame shared = draw(settings[s], f);
            dip_frame_hash(&shared, hashes[0]);
            const DipFrame own = draw(off, f);
            dip_frame_hash(&own, hashes[1]);
            const DipFrame again = draw(settings[s], f);
            dip_frame_hash(&again, hashes[2]);
            assert_string_equal(hashes[0], hashes[1]);
            assert_string_equal(hashes[0], hashes[2]);
            assert_int_equal(shared.counters.triangles_in, own.counters.triangles_in);
        }
    }
}

static void counters_show_what_instancing_saves(void **state) {
    (void)state;
    const DipCounters shared = draw("gi=on", 0).counters;
    const DipCounters own = draw("gi=off", 0).counters;
    const DipCounters again = draw("gi=on", 0).counters;
    assert_true(own.meshes > shared.meshes);
    assert_true(own.geometry_bytes > shared.geometry_bytes);
    assert_true(own.geometry_bytes > dip_scene_triangle_count(scene) * TRIANGLE_BYTES);
    assert_int_equal(again.meshes, shared.meshes);
    assert_int_equal(again.geometry_bytes, shared.geometry_bytes);
}

static void advanced_texture_optimisation_saves_work(void **state) {
    (void)state;
    static const char *const filters[] = {"af=none", "af=4", "af=16", "af=16,aaf=on"};
    for (size_t i = 0; i < sizeof filters / sizeof *filters; i++) {
        uint64_t texels[3] = {0};
        uint64_t probes[3] = {0};
        for (int o = 0; o < 3; o++) {
            for (int f = 0; f < FRAMES; f++) {
                char settings[64];
                snprintf(settings, sizeof settings, "%s,opt=%s", filters[i],
                         dip_setting_info(DIP_SETTING_OPT)->steps[o]);
                const DipCounters counters = draw(settings, f).counters;
                texels[o] += counters.texels_fetched;
                probes[o] += counters.texture_probes;
            }
        }
        printf("%-14s texels %.3f, probes %.3f of opt=off\n", filters[i],
               (double)texels[2] / (double)texels[0], (double)probes[2] / (double)probes[0]);
        assert_int_equal(texels[1], texels[0]);
        assert_int_equal(probes[1], probes[0]);
        assert_true((double)texels[2] < 0.9 * (double)texels[0]);
        // Trilinear filtering takes one probe per read. Optimised textures read alpha from other
        // levels, which clips slightly different fragments, so the sums may differ a little.
        const double share = (double)probes[2] / (double)probes[0];
        assert_true(i == 0 ? share > 0.99 && share < 1.01 : share < 0.9);
    }
}

static void compressed_textures_cost_nothing_unless_shown(void **state) {
    (void)state;
    DipError err = {0};
    const uint64_t before = dip_scene_texture_bytes(scene);
    draw("aa=2", 0);
    draw("opt=standard,mipdebug=on", 0);
    assert_int_equal(dip_scene_texture_bytes(scene), before);
    assert_true(dip_scene_compress_textures(scene, NULL, &err));
    const uint64_t compressed = dip_scene_texture_bytes(scene);
    assert_true(compressed > before && compressed < 2 * before);
    draw("opt=advanced", 0);
    assert_int_equal(dip_scene_texture_bytes(scene), compressed);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(compressed_textures_cost_nothing_unless_shown), // must be the first test
        cmocka_unit_test(pictures_do_not_depend_on_instancing),
        cmocka_unit_test(counters_show_what_instancing_saves),
        cmocka_unit_test(advanced_texture_optimisation_saves_work),
    };
    return cmocka_run_group_tests(tests, open_court, close_court);
}
