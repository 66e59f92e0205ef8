// Tests that the shipped hashes (diptych verify) can notice a change of every setting and of every
// kind of scene.
#include "renderer/catalogue/shipped_hashes.h"
#include "renderer/scene/quality.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static void hash_of(StabilityRun *run, DipTestSceneKind kind, const DipQuality *quality,
                    char hash[33]) {
    char settings[320];
    dip_quality_format(quality, settings, sizeof settings);
    if (!stability_draw_hash(run, kind, settings, false, hash)) {
        fail_msg("%s", run->broken_why);
    }
}

// Returns whether a picture of the list would have another hash if this setting had its default.
static bool shows(StabilityRun *run, const StabilityHash *row, DipSetting setting) {
    char hash[33];
    DipQuality quality;
    assert_true(dip_quality_parse(row->settings, &quality, NULL));
    quality.step[setting] = (uint8_t)dip_setting_info(setting)->default_step;
    if (!dip_quality_check(&quality, NULL)) {
        quality.step[DIP_SETTING_ASD] = 0; // One sample is a group for any number of samples.
    }
    hash_of(run, row->scene, &quality, hash);
    return strcmp(hash, row->hash) != 0;
}

static bool is_shown(StabilityRun *run, DipSetting setting, int step) {
    for (size_t i = 0; i < stability_hash_count; i++) {
        DipQuality quality;
        assert_true(dip_quality_parse(stability_hashes[i].settings, &quality, NULL));
        if (quality.step[setting] == step && shows(run, &stability_hashes[i], setting)) {
            return true;
        }
    }
    return false;
}

// The picture with a step is another than with the default, so a step that did nothing would be
// noticed. Instancing alone changes no picture.
static void every_step_changes_a_shipped_picture(void **state) {
    (void)state;
    DipPool *pool = dip_pool_create(2, NULL);
    StabilityRun run = {.isa = dip_isa_best(), .pool = pool};
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        const DipSettingInfo *info = dip_setting_info((DipSetting)s);
        for (int step = 0; step < info->step_count && s != DIP_SETTING_GI; step++) {
            if (step != info->default_step && !is_shown(&run, (DipSetting)s, step)) {
                fail_msg("no shipped picture shows %s=%s", info->key, info->steps[step]);
            }
        }
    }
    dip_pool_destroy(&pool);
}

static void every_kind_of_scene_has_shipped_pictures(void **state) {
    (void)state;
    for (int kind = 0; kind < DIP_TEST_SCENE_COUNT; kind++) {
        size_t i = 0;
        while (i < stability_hash_count && (int)stability_hashes[i].scene != kind) {
            i++;
        }
        if (i == stability_hash_count) {
            fail_msg("no shipped picture shows %s", dip_test_scene_name((DipTestSceneKind)kind));
        }
    }
}

// The plan leaves out only what no pixel shows, whatever the settings are.
static void planned_and_forced_effects_draw_the_shipped_pictures(void **state) {
    (void)state;
    StabilityRun run = {.isa = dip_isa_best()};
    for (size_t i = 0; i < 2 * stability_hash_count; i++) {
        const StabilityHash *row = &stability_hashes[i / 2];
        const bool forced = i % 2 == 1;
        char hash[33];
        if (!stability_draw_hash(&run, row->scene, row->settings, forced, hash)) {
            fail_msg("%s", run.broken_why);
        }
        if (strcmp(hash, row->hash) != 0) {
            fail_msg("%s with %s, %s: another picture than the shipped one",
                     dip_test_scene_name(row->scene), row->settings, forced ? "forced" : "planned");
        }
    }
}

// Two rows with the same scene and settings would be one picture drawn twice.
static void no_picture_is_shipped_twice(void **state) {
    (void)state;
    for (size_t i = 0; i < stability_hash_count; i++) {
        for (size_t k = 0; k < i; k++) {
            if (strcmp(stability_hashes[i].hash, stability_hashes[k].hash) == 0) {
                fail_msg("%s with %s has the hash of another row",
                         dip_test_scene_name(stability_hashes[i].scene),
                         stability_hashes[i].settings);
            }
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_step_changes_a_shipped_picture),
        cmocka_unit_test(every_kind_of_scene_has_shipped_pictures),
        cmocka_unit_test(planned_and_forced_effects_draw_the_shipped_pictures),
        cmocka_unit_test(no_picture_is_shipped_twice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
