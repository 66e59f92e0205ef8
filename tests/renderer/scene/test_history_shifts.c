// taa=history: the shifts of its frames. Frames that show the same from the same camera, each of
// which begins a history, show what the samples of the patterns of taa=alternate see.
#include "tests/renderer/scene/stage.h"
#include "tests/support/srgb.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 83, HEIGHT = 61, PIXELS = WIDTH * HEIGHT };

static DipRenderer *renderer_with(const char *settings) {
    const DipRendererDef def = stage_def(WIDTH, HEIGHT, settings);
    return stage_make_renderer(&def);
}

// White slats before black, at many angles.
static DipScene *make_slats(DipTestScene *slats) {
    dip_test_scene_begin(slats);
    memset(slats->def.background_lin, 0, sizeof slats->def.background_lin);
    const int white = dip_test_scene_add_material(slats, DIP_NO_TEXTURE);
    slats->materials[white].double_sided = true;
    for (int i = 0; i < DIP_TEST_SCENE_PARTS; i++) {
        const float x = (float)(i % 4) - 2.0f, y = (float)(i / 4) * 1.3f - 1.2f;
        const float lean = 0.13f * (float)i;
        dip_test_scene_add_quad(slats, white, (const float[]){x, y, -3.0f - 0.2f * (float)i},
                                (const float[]){0.7f, lean, 0.3f},
                                (const float[]){-0.5f * lean, 0.8f, 0.1f}, 1, 1);
    }
    return dip_scene_create(&slats->def, NULL, NULL);
}

// Adds to each pixel how many of eight samples are white. White and black have exact codes.
static void add_white(DipRenderer *renderer, const DipScene *slats, const DipPose *pose, int index,
                      int samples, int counts[PIXELS]) {
    DipFrame frame;
    dip_renderer_cut(renderer);
    dip_renderer_set_frame_index(renderer, (uint64_t)index);
    assert_true(dip_renderer_draw(renderer, slats, pose, 0, &frame, NULL));
    for (int i = 0; i < PIXELS; i++) {
        const uint8_t *rgb =
            frame.rgba8 + (size_t)(i / WIDTH) * frame.stride_bytes + 4 * (i % WIDTH);
        int white = 0;
        while (white < samples && srgb_light(rgb[0]) > (white + 0.5) / samples) {
            white++;
        }
        counts[i] += white;
    }
}

// Eight shifted frames show what the eight samples of a frame of an alternating pattern see. Moved
// corners may be rounded to another 1/256 pixel, which changes few samples.
static void shifted_frames_show_the_samples_of_both_patterns(void **state) {
    (void)state;
    static DipTestScene slats;
    static int shifted[PIXELS], sampled[PIXELS];
    DipScene *made = make_slats(&slats);
    DipRenderer *history = renderer_with("taa=history");
    DipRenderer *alternate = renderer_with("aa=8,taa=alternate");
    for (int turn = 0; turn < 2; turn++) {
        int partly = 0, others = 0;
        memset(shifted, 0, sizeof shifted);
        memset(sampled, 0, sizeof sampled);
        for (int i = 0; i < 8; i++) {
            add_white(history, made, &slats.pose, 8 * turn + i, 1, shifted);
        }
        add_white(alternate, made, &slats.pose, turn, 8, sampled);
        for (int i = 0; i < PIXELS; i++) {
            partly += sampled[i] > 0 && sampled[i] < 8;
            others += abs(shifted[i] - sampled[i]);
        }
        if (partly < 200 || others > partly / 20) {
            fail_msg("%d samples of %d pixels at edges differ", others, partly);
        }
    }
    dip_renderer_destroy(&history);
    dip_renderer_destroy(&alternate);
    dip_scene_destroy(&made);
    dip_test_scene_free(&slats);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shifted_frames_show_the_samples_of_both_patterns),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
