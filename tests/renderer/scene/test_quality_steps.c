// Tests what the steps of the settings stand for, in numbers: sizes, counts and biases. The truth
// is the text of each step, such as "1/1.7", and the tables and formulas of docs/picture.md. Also
// tests the whole messages about settings that do not exist.
#include "renderer/scene/quality.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char *text_of(DipSetting setting, int step) {
    return dip_setting_info(setting)->steps[step];
}

// Returns the number that a step's text is, or `other` if it is a word.
static int number_of(DipSetting setting, int step, int other) {
    const int number = atoi(text_of(setting, step));
    return number ? number : other;
}

static DipQuality with_step(DipSetting setting, int step) {
    DipQuality quality = dip_quality_default();
    quality.step[setting] = (uint8_t)step;
    return quality;
}

static void numbers_are_those_of_the_texts(void **state) {
    (void)state;
    for (int step = 0; step < dip_setting_info(DIP_SETTING_AA)->step_count; step++) {
        const DipQuality quality = with_step(DIP_SETTING_AA, step);
        assert_int_equal(dip_quality_sample_count(&quality), number_of(DIP_SETTING_AA, step, 1));
    }
    for (int step = 0; step < dip_setting_info(DIP_SETTING_AF)->step_count; step++) {
        const DipQuality quality = with_step(DIP_SETTING_AF, step);
        assert_int_equal(dip_quality_max_anisotropy(&quality), number_of(DIP_SETTING_AF, step, 1));
    }
    for (int step = 0; step < dip_setting_info(DIP_SETTING_SHADOWS)->step_count; step++) {
        const DipQuality quality = with_step(DIP_SETTING_SHADOWS, step);
        assert_int_equal(dip_quality_shadow_size(&quality),
                         number_of(DIP_SETTING_SHADOWS, step, 0));
    }
    for (int step = 0; step < dip_setting_info(DIP_SETTING_TAA)->step_count; step++) {
        const DipQuality quality = with_step(DIP_SETTING_TAA, step);
        const char *text = text_of(DIP_SETTING_TAA, step);
        assert_int_equal(dip_quality_alternates(&quality), strcmp(text, "alternate") == 0);
        assert_int_equal(dip_quality_has_history(&quality), strcmp(text, "history") == 0);
    }
    for (int i = 0; i < 6; i++) {
        DipQuality quality = with_step(DIP_SETTING_OPT, i / 2);
        quality.step[DIP_SETTING_MIPDEBUG] = i % 2;
        assert_int_equal(dip_quality_compresses(&quality), i == 2 || i == 4);
    }
}

// A scale s is a fraction of whole hundredths, and the drawn size is floor(s size + 1/2).
static void a_scale_is_the_fraction_of_its_text(void **state) {
    (void)state;
    for (int step = 0; step < dip_setting_info(DIP_SETTING_SCALE)->step_count; step++) {
        const char *text = text_of(DIP_SETTING_SCALE, step);
        const char *slash = strchr(text, '/');
        const int64_t over = lround(100.0 * atof(text));
        const int64_t under = slash ? lround(100.0 * atof(slash + 1)) : 100;
        const DipQuality quality = with_step(DIP_SETTING_SCALE, step);
        assert_true(dip_quality_scale(&quality) == (double)over / (double)under);
        assert_int_equal(dip_quality_upscales(&quality), over < under);
        for (int size = 1; size < 4097; size++) {
            const int64_t drawn = dip_quality_drawn_size(&quality, size);
            const int64_t twice = 2 * over * size + under;
            assert_true(2 * under * drawn <= twice && twice < 2 * under * (drawn + 1));
        }
    }
}

// For all settings of the samples and their groups. A setting of aaa that has no groups has one
// group of all samples, and its bias is 0.
static void sample_groups_are_those_of_the_texts(void **state) {
    (void)state;
    int several = 0;
    for (int i = 0; i < 5 * 4 * 4; i++) {
        DipQuality quality = with_step(DIP_SETTING_AA, i % 5);
        quality.step[DIP_SETTING_AAA] = (uint8_t)(i / 5 % 4);
        quality.step[DIP_SETTING_ASD] = (uint8_t)(i / 20);
        if (!dip_quality_check(&quality, NULL)) {
            continue;
        }
        const char *aaa = text_of(DIP_SETTING_AAA, i / 5 % 4);
        const int samples = number_of(DIP_SETTING_AA, i % 5, 1);
        const bool divided = strcmp(aaa, "on") == 0 || strcmp(aaa, "all") == 0;
        const int group = divided ? number_of(DIP_SETTING_ASD, i / 20, 0) : samples;
        assert_int_equal(dip_quality_samples_per_group(&quality), group);
        assert_int_equal(dip_quality_groups_shade_all(&quality),
                         strcmp(aaa, "all") == 0 && samples > group);
        assert_int_equal(dip_quality_covers_by_alpha(&quality),
                         strcmp(aaa, "coverage") == 0 && samples > 1);
        assert_int_equal(dip_quality_groups_bias_lod8(&quality),
                         lround(-256.0 * log2(sqrt((double)samples / group))));
        several += samples > group;
    }
    assert_true(several > 10);
}

// The mean of a history's frames is smoother than each of them, so each is read a level finer.
static void a_history_has_the_bias_of_a_level_and_no_mirror_image(void **state) {
    (void)state;
    static const struct {
        const char *settings;
        int bias_lod8;
        const char *mirrored;
    } rows[] = {
        {"taa=history", -256, "defaults"},
        {"taa=history,miplod=performance", 0, "miplod=performance"},
        {"taa=history,scale=1/2", -512, "defaults"},
        {"taa=history,mipdebug=on", 0, "mipdebug=on"},
        {"aa=2,taa=alternate", 0, "aa=2,taa=alternate"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        DipQuality quality;
        char text[DIP_SETTINGS_BYTES];
        assert_true(dip_quality_parse(rows[i].settings, &quality, NULL));
        assert_int_equal(dip_quality_bias_lod8(&quality), rows[i].bias_lod8);
        const DipQuality mirrored = dip_quality_mirrored(&quality);
        dip_quality_format_changes(&mirrored, text, sizeof text);
        assert_string_equal(text, rows[i].mirrored);
    }
}

// --- refusals ------------------------------------------------------------------------------------

static void steps_out_of_range_are_refused(void **state) {
    (void)state;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        const DipSettingInfo *info = dip_setting_info((DipSetting)s);
        const int bad[2] = {info->step_count, UINT8_MAX};
        for (int i = 0; i < 2; i++) {
            const DipQuality quality = with_step((DipSetting)s, bad[i]);
            char expected[128];
            DipError err = {.line = 7};
            snprintf(expected, sizeof expected, "step %d is out of range, accepted 0..%d", bad[i],
                     info->step_count - 1);
            assert_false(dip_quality_check(&quality, &err));
            assert_int_equal(err.code, DIP_ERROR_RANGE);
            assert_int_equal(err.line, 0);
            assert_string_equal(err.key, info->key);
            assert_non_null(strstr(err.message, expected));
        }
    }
}

// The message names all groups that aa has, and all numbers of samples that have the group.
static void a_group_that_does_not_fit_is_told_what_fits(void **state) {
    (void)state;
    static const char *const aa_of[4] = {"none|2|4|6|8", "2|4|6|8", "6", "8"};
    static const char *const asd_of[5] = {"1", "1|2", "1|2", "1|2|3", "1|2|4"};
    int refused = 0;
    for (int i = 0; i < 5 * 4; i++) {
        const char *aa = text_of(DIP_SETTING_AA, i % 5);
        const char *asd = text_of(DIP_SETTING_ASD, i / 5);
        char text[64], expected[128];
        DipQuality quality;
        DipError err = {.line = 7};
        snprintf(text, sizeof text, "aa=%s,asd=%s", aa, asd);
        snprintf(expected, sizeof expected, "asd=%s needs aa=%s; with aa=%s, give asd=%s", asd,
                 aa_of[i / 5], aa, asd_of[i % 5]);
        const bool fits = strstr(asd_of[i % 5], asd) != NULL;
        assert_int_equal(dip_quality_parse(text, &quality, &err), fits);
        if (!fits) {
            const size_t length = strlen(err.message);
            assert_true(length >= strlen(expected) && err.line == 0);
            assert_string_equal(err.message + length - strlen(expected), expected);
            refused++;
        }
    }
    assert_int_equal(refused, 9);
}

static void messages_quote_the_bad_part(void **state) {
    (void)state;
    DipQuality quality;
    DipError err = {.line = 7};
    assert_false(dip_quality_parse("af=2,opt=basic", &quality, &err));
    assert_non_null(strstr(err.message, "'basic' is no step, accepted off|standard|advanced"));
    err = (DipError){.line = 7};
    assert_false(dip_quality_parse("af=2,aa=4,af=4", &quality, &err));
    assert_non_null(strstr(err.message, "is set twice, accepted once"));
    assert_string_equal(err.key, "af");
    assert_int_equal(err.line, 0);
}

// A part of 127 characters is read, though no setting has this name. A longer part is refused.
static void parts_are_read_up_to_a_length(void **state) {
    (void)state;
    char text[160];
    for (size_t length = 120; length < 135; length++) {
        DipQuality quality;
        DipError err = {0};
        memset(text, 'a', sizeof text);
        memcpy(text, "af=2,", 5);
        memcpy(text + 5 + length, ",aa=2", 6);
        assert_false(dip_quality_parse(text, &quality, &err));
        assert_int_equal(err.code, length < 128 ? DIP_ERROR_UNKNOWN : DIP_ERROR_OVERSIZED);
    }
}

static void texts_are_cut_to_any_buffer(void **state) {
    (void)state;
    typedef size_t Format(const DipQuality *quality, char *buffer, size_t size_bytes);
    static Format *const formats[2] = {dip_quality_format, dip_quality_format_changes};
    DipQuality quality;
    assert_true(dip_quality_parse("aa=4,af=16,gi=off", &quality, NULL));
    for (int f = 0; f < 2; f++) {
        char whole[DIP_SETTINGS_BYTES];
        const size_t length = formats[f](&quality, whole, sizeof whole);
        assert_int_equal(formats[f](&quality, NULL, 0), length);
        for (size_t size = 0; size <= length + 2; size++) {
            char cut[DIP_SETTINGS_BYTES + 2];
            memset(cut, '#', sizeof cut);
            assert_int_equal(formats[f](&quality, cut, size), length);
            const size_t kept = size > length ? length : size ? size - 1 : 0;
            assert_memory_equal(cut, whole, kept);
            assert_true(!size || cut[kept] == '\0');
            assert_true(cut[size] == '#' && cut[size + 1] == '#');
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_those_of_the_texts),
        cmocka_unit_test(a_scale_is_the_fraction_of_its_text),
        cmocka_unit_test(sample_groups_are_those_of_the_texts),
        cmocka_unit_test(a_history_has_the_bias_of_a_level_and_no_mirror_image),
        cmocka_unit_test(steps_out_of_range_are_refused),
        cmocka_unit_test(a_group_that_does_not_fit_is_told_what_fits),
        cmocka_unit_test(messages_quote_the_bad_part),
        cmocka_unit_test(parts_are_read_up_to_a_length),
        cmocka_unit_test(texts_are_cut_to_any_buffer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
