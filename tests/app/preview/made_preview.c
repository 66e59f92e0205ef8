// Makes a preview of a scene in memory and drives it.
#include "tests/app/preview/made_preview.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

DipMadePreview made;

// --- opening and closing -------------------------------------------------------------------------

static bool load_scene_def(DipSession *session, DipError *err) {
    made.scene_reads++;
    if (made.scene_is_broken) {
        return dip_error_set(err, DIP_ERROR_RUNTIME, "scene.obj", 0, NULL, "the importer crashed");
    }
    session->scene_def = made.scene.def;
    return true;
}

DipCamPath *dip_made_path(int key_count, double step_m) {
    const DipPose *pose = &made.scene.pose;
    DipCamPath *path = NULL;
    DipCamKey keys[2];
    assert_in_range(key_count, 1, 2);
    for (int i = 0; i < key_count; ++i) {
        memcpy(keys[i].position_world, pose->position_world, sizeof keys[i].position_world);
        memcpy(keys[i].orientation, pose->orientation, sizeof keys[i].orientation);
        keys[i].position_world[0] += i * step_m;
    }
    assert_true(dip_campath_create(keys, (size_t)key_count, INT64_C(5000000000), &path, NULL));
    return path;
}

void dip_made_open_session(int threads, int key_count,
                           const DipRendererDef painters[DIP_PANE_COUNT]) {
    memset(&made, 0, sizeof made);
    dip_test_scene_make(&made.scene, DIP_TEST_SCENE_grazing_checker);
    made.session.pool = dip_pool_create(threads, NULL);
    made.session.scene = dip_scene_create(&made.scene.def, NULL, NULL);
    assert_true(made.session.pool && made.session.scene);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        DipRendererDef def = painters ? painters[p] : dip_renderer_default_def();
        def.pool = made.session.pool;
        made.session.renderers[p] = dip_painter_create(&def, NULL, NULL);
        assert_non_null(made.session.renderers[p]);
    }
    made.path = dip_made_path(key_count, 1.0);
    made.session.track = dip_camtrack_make(true);
    dip_camtrack_set(&made.session.track, DIP_CATEGORY_DEFAULT, made.path, 60.0);
}

void dip_made_open_display(int width, int height) {
    made.fake = dip_fake_display_open(&made.display, width, height);
    assert_non_null(made.fake);
}

bool dip_made_create_preview(const DipPreviewDef *def, DipError *err) {
    DipPreviewDef whole = def ? *def : (DipPreviewDef){0};
    whole.session = &made.session;
    whole.display = made.display;
    whole.load_scene_def = load_scene_def;
    made.preview = dip_preview_create(&whole, err);
    return made.preview != NULL;
}

int dip_made_tear_down(void **unused) {
    (void)unused;
    dip_preview_destroy(&made.preview);
    if (made.display.close) {
        made.display.close(made.display.context);
    }
    dip_campath_destroy(&made.path);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        dip_painter_destroy(&made.session.renderers[p]);
    }
    dip_scene_destroy(&made.session.scene);
    dip_pool_destroy(&made.session.pool);
    dip_test_scene_free(&made.scene);
    return 0;
}

// --- driving and looking -------------------------------------------------------------------------

void dip_made_turn(void) {
    DipError err = {0};
    if (!dip_preview_turn(made.preview, &err)) {
        fail_msg("%s", err.message);
    }
}

void dip_made_turn_shown(void) {
    dip_made_turn();
    const DipPixels shown = dip_fake_display_picture(made.fake);
    const DipPixels drawn = dip_preview_picture(made.preview);
    assert_int_equal(shown.width, drawn.width);
    assert_int_equal(shown.height, drawn.height);
    assert_memory_equal(shown.rgba8, drawn.rgba8, 4 * (size_t)shown.width * (size_t)shown.height);
}

void dip_made_press(DipKeycode key) {
    dip_fake_display_press(made.fake, key, 0);
    dip_made_turn_shown();
}
