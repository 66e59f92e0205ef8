// Tests which planned effects count as skipped after a frame: those of which neither the frame nor
// the frame whose pixels it has copied shows a fragment.
#include "renderer/scene/plan/plan.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

// An effect, the counter of its work, and whether the work of the copied frame counts.
typedef struct Counted {
    const char *name;
    size_t effect;
    size_t counter;
    bool copied_counts;
} Counted;

#define COUNTED(effect, counter, copied)                                                           \
    { #effect, offsetof(DipEffects, effect), offsetof(DipCounters, counter), copied }

static const Counted all[] = {
    COUNTED(alpha_clip, fragments_clip_tested, false),
    COUNTED(adaptive_aa, clip_sample_groups, false),
    COUNTED(lights, fragments_lit, true),
    COUNTED(shadows, fragments_shadowed, true),
    COUNTED(normal_map, fragments_normal_mapped, true),
    COUNTED(pbr, fragments_pbr, true),
    COUNTED(occlusion, fragments_occluded, true),
    COUNTED(emission, fragments_emitting, true),
    COUNTED(coat, fragments_coated, true),
    COUNTED(sheen, fragments_sheen, true),
    COUNTED(transmission, fragments_transmitting, true),
    COUNTED(scattering, fragments_scattering, true),
    COUNTED(environment, fragments_surrounded, true),
    COUNTED(sky, fragments_sky, true),
    COUNTED(blend, fragments_blended, false),
};

// Settles a plan in which all effects run. own, copied: the work of one effect in the two frames.
// Returns whether that effect still runs. No other effect has work, so they must be skipped.
static bool runs(const Counted *effect, uint64_t own, uint64_t copied, bool forced) {
    const DipQuality quality = dip_quality_default();
    const DipPlanInput input = {.quality = &quality, .force_all = forced};
    DipCounters counters[2] = {{0}, {0}};
    DipEffects effects = {0};
    *(uint64_t *)((char *)&counters[0] + effect->counter) = own;
    *(uint64_t *)((char *)&counters[1] + effect->counter) = copied;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        ((DipEffect *)((char *)&effects + all[i].effect))->run = true;
    }
    dip_plan_settle(&input, &counters[0], &counters[1], &effects);
    bool found = false;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        const DipEffect *settled = (DipEffect *)((char *)&effects + all[i].effect);
        if (&all[i] == effect) {
            found = settled->run;
        } else {
            assert_int_equal(settled->run, forced);
        }
        assert_true(settled->run || strstr(settled->why, "visible"));
    }
    return found;
}

static void an_effect_without_visible_fragments_is_skipped(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        const bool found[4] = {runs(&all[i], 0, 0, false), runs(&all[i], 7, 0, false),
                               runs(&all[i], 0, 7, false), runs(&all[i], 7, 7, false)};
        if (found[0] || !found[1] || found[2] != all[i].copied_counts || !found[3]) {
            fail_msg("%s: %d%d%d%d", all[i].name, found[0], found[1], found[2], found[3]);
        }
        assert_true(runs(&all[i], 0, 0, true));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_effect_without_visible_fragments_is_skipped)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
