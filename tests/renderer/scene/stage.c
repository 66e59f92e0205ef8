// Draws scenes for tests, with the fast renderer and with the reference.
#include "tests/renderer/scene/stage.h"

#include "renderer/reference/reference.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

// Fails the test with the error unless `done`.
static void require(bool done, const DipError *err) {
    if (!done) {
        fail_msg("%s: %s", err->key, err->message);
    }
}

DipRendererDef stage_def(int width, int height, const char *settings) {
    DipError err = {0};
    DipRendererDef def = dip_renderer_default_def();
    def.width = width;
    def.height = height;
    require(dip_quality_parse(settings, &def.quality, &err), &err);
    return def;
}

DipRenderer *stage_make_renderer(const DipRendererDef *def) {
    DipError err = {0};
    DipRenderer *renderer = dip_renderer_create(def, &err);
    require(renderer != NULL, &err);
    return renderer;
}

Stage stage_open(const DipSceneDef *source, DipRendererDef def, int threads) {
    DipError err = {0};
    Stage stage = {.pool = dip_pool_create(threads, &err), .def = def, .source = source};
    require(stage.pool != NULL, &err);
    stage.def.pool = stage.pool;
    stage.scene = dip_scene_create(source, stage.pool, &err);
    require(stage.scene != NULL, &err);
    stage.renderer = stage_make_renderer(&stage.def);
    return stage;
}

Stage stage_open_kind(DipTestSceneKind kind, DipRendererDef def, int threads) {
    DipTestScene *made = malloc(sizeof *made);
    assert_non_null(made);
    dip_test_scene_make(made, kind);
    def.reflection = made->reflection;
    Stage stage = stage_open(&made->def, def, threads);
    stage.made = made;
    return stage;
}

void stage_close(Stage *stage) {
    dip_renderer_destroy(&stage->renderer);
    dip_scene_destroy(&stage->scene);
    dip_pool_destroy(&stage->pool);
    if (stage->made) {
        dip_test_scene_free(stage->made);
    }
    free(stage->made);
    stage->made = NULL;
}

DipFrame stage_draw(const Stage *stage, const DipPose *pose, int64_t time_ns) {
    DipError err = {0};
    DipFrame frame;
    require(dip_renderer_draw(stage->renderer, stage->scene, pose, time_ns, &frame, &err), &err);
    return frame;
}

DipFrame stage_draw_kind(const Stage *stage, const char *settings) {
    DipError err = {0};
    DipQuality quality;
    require(dip_quality_parse(settings, &quality, &err) &&
                dip_renderer_set_quality(stage->renderer, &quality, &err),
            &err);
    return stage_draw(stage, &stage->made->pose, 0);
}

void stage_draw_scene(const DipTestScene *scene, int width, int height, const char *settings,
                      uint32_t *pixels) {
    DipRendererDef def = stage_def(width, height, settings);
    def.reflection = scene->reflection;
    Stage stage = stage_open(&scene->def, def, 1);
    const DipFrame frame = stage_draw(&stage, &scene->pose, 0);
    dip_image_copy(&frame, pixels);
    stage_close(&stage);
}

double *stage_draw_reference(const Stage *stage, const DipPose *pose) {
    const int width = stage->def.width, height = stage->def.height;
    const DipQuality quality = dip_renderer_quality(stage->renderer);
    DipError err = {0};
    DipReference *reference = dip_reference_create(stage->source, &err);
    require(reference != NULL, &err);
    dip_reference_set_reflection(reference, &stage->def.reflection);
    double *rgb_lin = malloc((size_t)width * (size_t)height * 3 * sizeof *rgb_lin);
    assert_non_null(rgb_lin);
    require(dip_reference_draw(reference, &quality, pose, width, height, rgb_lin, &err), &err);
    dip_reference_destroy(&reference);
    return rgb_lin;
}

DipFrame stage_compare(const Stage *stage, const DipPose *pose, const char *name,
                       const char *settings, const DipImageBounds *bounds) {
    const DipFrame frame = stage_draw(stage, pose, 0);
    double *rgb_lin = stage_draw_reference(stage, pose);
    const DipImageError error = dip_image_compare(rgb_lin, &frame, bounds->pixel_lin);
    printf("%s %s: rms %.5f, max %.3f, %zu over %g, %.1f dB\n", name, settings, error.rms_lin,
           error.max_lin, error.over_count, bounds->pixel_lin, error.psnr_db);
    assert_true(dip_image_check(name, rgb_lin, &frame, bounds));
    free(rgb_lin);
    return frame;
}
