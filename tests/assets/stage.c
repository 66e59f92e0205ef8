// Draws moments of loaded models with both renderers.
#include "tests/assets/stage.h"

#include "renderer/reference/reference.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <cmocka.h>

Stage stage_open(const DipSceneDef *def, int threads, const char *settings) {
    DipError err = {0};
    Stage stage = {.pool = dip_pool_create(threads, NULL)};
    DipRendererDef renderer = dip_renderer_default_def();
    renderer.pool = stage.pool;
    renderer.width = STAGE_WIDTH;
    renderer.height = STAGE_HEIGHT;
    assert_true(dip_quality_parse(settings, &renderer.quality, NULL));
    stage.scene = dip_scene_create(def, stage.pool, &err);
    stage.renderer = stage.scene ? dip_renderer_create(&renderer, &err) : NULL;
    if (!stage.renderer) {
        fail_msg("%s: %s", err.key, err.message);
    }
    return stage;
}

void stage_close(Stage *stage) {
    dip_renderer_destroy(&stage->renderer);
    dip_scene_destroy(&stage->scene);
    dip_pool_destroy(&stage->pool);
}

int64_t stage_time_ns(int frame) {
    return (int64_t)frame * 1000000000 / 30;
}

DipFrame stage_draw(const Stage *stage, const DipPose *pose, int frame, uint8_t *rgba8) {
    const size_t row_bytes = 4 * STAGE_WIDTH;
    DipFrame drawn;
    DipError err = {0};
    if (!dip_renderer_draw(stage->renderer, stage->scene, pose, stage_time_ns(frame), &drawn,
                           &err)) {
        fail_msg("%s: %s", err.key, err.message);
    }
    for (size_t y = 0; y < STAGE_HEIGHT; ++y) {
        memcpy(rgba8 + y * row_bytes, drawn.rgba8 + y * (size_t)drawn.stride_bytes, row_bytes);
    }
    return drawn;
}

static double encode(double x) {
    return 255.0 * (x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055);
}

void stage_check_moments(const DipSceneDef *def, const DipPose *pose, int first, int end,
                         int step) {
    static uint8_t picture[STAGE_BYTES];
    static double rgb_lin[STAGE_PIXELS * 3];
    Stage stage = stage_open(def, 2, "aa=none");
    DipReference *reference = dip_reference_create(def, NULL);
    assert_non_null(reference);
    const DipQuality quality = dip_renderer_quality(stage.renderer);
    for (int frame = first; frame < end; frame += step) {
        stage_draw(&stage, pose, frame, picture);
        dip_reference_set_time(reference, stage_time_ns(frame));
        assert_true(dip_reference_draw(reference, &quality, pose, STAGE_WIDTH, STAGE_HEIGHT,
                                       rgb_lin, NULL));
        double squares = 0.0;
        for (size_t i = 0; i < (size_t)STAGE_PIXELS * 3; ++i) {
            const double difference = encode(rgb_lin[i]) - picture[i / 3 * 4 + i % 3];
            squares += difference * difference;
        }
        const double psnr_db = 10.0 * log10(255.0 * 255.0 * STAGE_PIXELS * 3 / squares);
        if (!(psnr_db > 42.0)) {
            fail_msg("frame %d: %g dB", frame, psnr_db);
        }
    }
    dip_reference_destroy(&reference);
    stage_close(&stage);
}
