// Tests which settings shade pixels alike, for every pair of steps of every setting, by what
// renderer.h says about copied shading (dip_renderer_copy_shading).
#include "renderer/scene/plan/plan.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

// Returns whether frames that differ only in the steps a and b of one setting shade alike.
static bool is_alike(DipSetting setting, int a, int b) {
    switch (setting) {
    case DIP_SETTING_AA:
    case DIP_SETTING_ASD:
        return true;
    case DIP_SETTING_TAA: // Each frame of a history is shifted.
        return a != DIP_TAA_HISTORY && b != DIP_TAA_HISTORY;
    case DIP_SETTING_AAA: // Coverage by alpha and supersampling shade at other places.
        return (a == DIP_AAA_OFF || a == DIP_AAA_ON) && (b == DIP_AAA_OFF || b == DIP_AAA_ON);
    case DIP_SETTING_SCALE: // A larger picture needs light that is not in the pixels.
        return a == b && a <= DIP_SCALE_1;
    case DIP_SETTING_MIPDEBUG:
        return a == 0 && b == 0;
    default:
        return a == b;
    }
}

static void frames_that_differ_in_samples_alone_shade_alike(void **state) {
    (void)state;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        const int count = dip_setting_info((DipSetting)s)->step_count;
        for (int i = 0; i < count * count; i++) {
            DipQuality a = dip_quality_default(), b = dip_quality_default();
            a.step[s] = (uint8_t)(i % count);
            b.step[s] = (uint8_t)(i / count);
            if (dip_plan_shades_alike(&a, &b) != is_alike((DipSetting)s, i % count, i / count)) {
                fail_msg("%s: steps %d and %d", dip_setting_info((DipSetting)s)->key, i % count,
                         i / count);
            }
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_that_differ_in_samples_alone_shade_alike)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
