// Tests settings as text: which texts are accepted, which are refused, and with which message.
#include "renderer/scene/quality.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static void settings_have_their_documented_defaults(void **state) {
    (void)state;
    char text[256];
    const DipQuality quality = dip_quality_default();
    dip_quality_format(&quality, text, sizeof text);
    assert_string_equal(text, "aa=none,taa=off,aaa=off,asd=1,af=none,aaf=off,opt=off,"
                              "miplod=high-quality,scale=1,upscale=bilinear,post=off,sharpen=off,"
                              "shadows=off,gi=on,mipdebug=off");
}

static void formatting_gives_the_parsed_text_back(void **state) {
    (void)state;
    static const char text[] = "aa=6,taa=alternate,aaa=on,asd=3,af=16,aaf=on,opt=off,"
                               "miplod=performance,scale=1/1.7,upscale=easu,post=smaa,sharpen=low,"
                               "shadows=2048,gi=on,mipdebug=on";
    DipQuality quality;
    char back[256];
    assert_true(dip_quality_parse(text, &quality, NULL));
    assert_int_equal(dip_quality_format(&quality, back, sizeof back), strlen(text));
    assert_string_equal(back, text);
    assert_int_equal(dip_quality_sample_count(&quality), 6);
    assert_int_equal(dip_quality_max_anisotropy(&quality), 16);
}

static void settings_that_are_left_out_keep_their_defaults(void **state) {
    (void)state;
    DipQuality quality;
    assert_true(dip_quality_parse("af=4", &quality, NULL));
    DipQuality expected = dip_quality_default();
    expected.step[DIP_SETTING_AF] = 2;
    assert_memory_equal(&quality, &expected, sizeof quality);
    assert_true(dip_quality_parse("", &quality, NULL));
}

// Files of earlier versions lack settings, and steps, that came later.
static void texts_of_earlier_versions_stay_valid(void **state) {
    (void)state;
    static const char text[] = "aa=8,taa=on,aaa=on,asd=2,af=16,aaf=on,opt=advanced,"
                               "miplod=high-performance,gi=off,mipdebug=off";
    DipQuality quality;
    char back[256];
    assert_true(dip_quality_parse(text, &quality, NULL));
    assert_int_equal(quality.step[DIP_SETTING_AAA], DIP_AAA_ON);
    assert_int_equal(quality.step[DIP_SETTING_SCALE], DIP_SCALE_1);
    dip_quality_format_changes(&quality, back, sizeof back);
    assert_string_equal(back, "aa=8,taa=alternate,aaa=on,asd=2,af=16,aaf=on,opt=advanced,"
                              "miplod=high-performance,gi=off");
    static const char *const scales[] = {"scale=1.25", "scale=1.5", "scale=2"};
    for (int i = 0; i < 3; i++) { // Their steps had other numbers.
        assert_true(dip_quality_parse(scales[i], &quality, NULL));
        dip_quality_format_changes(&quality, back, sizeof back);
        assert_string_equal(back, scales[i]);
    }
}

static void bad_settings_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *text;
        DipErrorCode code;
        const char *key;
        const char *accepted; // text that the message must contain
    } rows[] = {
        {"aa=3", DIP_ERROR_UNKNOWN, "aa", "none|2|4|6|8"},
        {"aa=", DIP_ERROR_UNKNOWN, "aa", "none|2|4|6|8"},
        {"aa", DIP_ERROR_MISSING, "aa", "aa=none|2|4|6|8"},
        {"=4", DIP_ERROR_UNKNOWN, "", "miplod"},
        {"msaa=4", DIP_ERROR_UNKNOWN, "msaa", "aa taa"},
        {"aa=4,aa=4", DIP_ERROR_CONFLICT, "aa", "twice"},
        {"aa=4,,af=2", DIP_ERROR_UNKNOWN, "", "miplod"},
        {"AA=4", DIP_ERROR_UNKNOWN, "AA", "aa taa"},
        {"aa=4 ", DIP_ERROR_UNKNOWN, "aa", "none|2|4|6|8"},
        {"scale=1/3", DIP_ERROR_UNKNOWN, "scale", "1/2|1/1.7|1/1.5|1/1.3|1|1.25|1.5|2"},
        {"upscale=off", DIP_ERROR_UNKNOWN, "upscale", "bilinear|bicubic|easu"},
        {"opt=on", DIP_ERROR_UNKNOWN, "opt", "off|standard|advanced"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        DipQuality quality = dip_quality_default();
        quality.step[DIP_SETTING_AA] = 4;
        DipError err = {0};
        assert_false(dip_quality_parse(rows[i].text, &quality, &err));
        assert_int_equal(err.code, rows[i].code);
        assert_string_equal(err.key, rows[i].key);
        assert_non_null(strstr(err.message, rows[i].accepted));
        assert_int_equal(quality.step[DIP_SETTING_AA], 4);
    }
    char longest[400];
    memset(longest, 'a', sizeof longest);
    longest[sizeof longest - 1] = '\0';
    DipQuality quality;
    DipError err;
    assert_false(dip_quality_parse(longest, &quality, &err));
    assert_int_equal(err.code, DIP_ERROR_OVERSIZED);
}

// The table in docs/picture.md, Adaptive AA: the number of sample groups, indexed by samples per
// pixel and samples per group. 0 means that the table lacks the pair.
static void only_pairs_of_aa_and_asd_in_the_table_are_accepted(void **state) {
    (void)state;
    static const char *const aa[] = {"none", "2", "4", "6", "8"};
    static const int passes[5][4] = {
        {1, 0, 0, 0}, {2, 1, 0, 0}, {4, 2, 0, 0}, {6, 3, 2, 0}, {8, 4, 0, 2}};
    for (int a = 0; a < 5; a++) {
        for (int d = 0; d < 4; d++) {
            char text[64];
            DipQuality quality;
            DipError err = {0};
            snprintf(text, sizeof text, "aa=%s,aaa=on,asd=%d", aa[a], d + 1);
            const bool parsed = dip_quality_parse(text, &quality, &err);
            assert_int_equal(parsed, passes[a][d] != 0);
            if (parsed) {
                assert_int_equal(dip_quality_sample_count(&quality) /
                                     dip_quality_samples_per_group(&quality),
                                 passes[a][d]);
                quality.step[DIP_SETTING_AAA] = DIP_AAA_OFF;
                assert_int_equal(dip_quality_samples_per_group(&quality),
                                 dip_quality_sample_count(&quality));
                continue;
            }
            assert_int_equal(err.code, DIP_ERROR_CONFLICT);
            assert_string_equal(err.key, "asd");
            snprintf(text, sizeof text, "asd=%d needs aa=", d + 1);
            assert_non_null(strstr(err.message, text));
            snprintf(text, sizeof text, "; with aa=%s, give asd=1", aa[a]);
            assert_non_null(strstr(err.message, text));
            snprintf(text, sizeof text, "aa=%s,asd=%d", aa[a], d + 1);
            assert_false(
                dip_quality_parse(text, &quality, NULL)); // refused even if adaptive AA is off
        }
    }
}

static void formatting_returns_the_length_as_snprintf_does(void **state) {
    (void)state;
    const DipQuality quality = dip_quality_default();
    char whole[256];
    char cut[10];
    const size_t length = dip_quality_format(&quality, whole, sizeof whole);
    assert_int_equal(length, strlen(whole));
    assert_int_equal(dip_quality_format(&quality, NULL, 0), length);
    assert_int_equal(dip_quality_format(&quality, cut, sizeof cut), length);
    assert_memory_equal(cut, whole, sizeof cut - 1);
    assert_int_equal(cut[sizeof cut - 1], '\0');
}

// The longest text that settings can have, valid or not, and its zero fit into DIP_SETTINGS_BYTES.
static void every_text_fits_its_buffers(void **state) {
    (void)state;
    DipQuality longest;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        const DipSettingInfo *info = dip_setting_info((DipSetting)s);
        longest.step[s] = 0;
        for (int i = 1; i < info->step_count; i++) {
            if (strlen(info->steps[i]) > strlen(info->steps[longest.step[s]])) {
                longest.step[s] = (uint8_t)i;
            }
        }
    }
    assert_true(dip_quality_format(&longest, NULL, 0) < DIP_SETTINGS_BYTES);
}

static void short_texts_list_changes_only(void **state) {
    (void)state;
    char text[64];
    DipQuality quality = dip_quality_default();
    assert_int_equal(dip_quality_format_changes(&quality, text, sizeof text), 8);
    assert_string_equal(text, "defaults");
    assert_int_equal(dip_quality_count_changes(&quality), 0);
    assert_true(dip_quality_parse("af=16,gi=off,aa=4", &quality, NULL));
    assert_int_equal(dip_quality_format_changes(&quality, text, sizeof text), 17);
    assert_string_equal(text, "aa=4,af=16,gi=off");
    assert_int_equal(dip_quality_format_changes(&quality, text, 6), 17); // The text is cut.
    assert_string_equal(text, "aa=4,");
    assert_int_equal(dip_quality_count_changes(&quality), 3);
}

static void settings_without_effect_are_turned_off(void **state) {
    (void)state;
    static const char *const rows[][2] = {
        {"taa=on,aaa=on,aaf=on", "defaults"},
        {"taa=history", "taa=history"},
        {"aa=2,asd=2,aaa=on", "aa=2"},
        {"aa=2,asd=2,aaa=all", "aa=2"},
        {"aa=2,asd=2,aaa=coverage", "aa=2,aaa=coverage"},
        {"aa=8,asd=4,aaa=all", "aa=8,aaa=all,asd=4"},
        {"aaa=coverage", "defaults"},
        {"aa=8,asd=4", "aa=8"},
        {"aa=8,asd=4,aaa=on,taa=on", "aa=8,taa=alternate,aaa=on,asd=4"},
        {"af=2,aaf=on", "af=2,aaf=on"},
        {"upscale=easu", "defaults"},
        {"scale=1.5,upscale=bicubic", "scale=1.5"},
        {"scale=1/1.3,upscale=bicubic", "scale=1/1.3,upscale=bicubic"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        DipQuality quality;
        char text[256];
        assert_true(dip_quality_parse(rows[i][0], &quality, NULL));
        const DipQuality effective = dip_quality_effective(&quality);
        dip_quality_format_changes(&effective, text, sizeof text);
        assert_string_equal(text, rows[i][1]);
        const DipQuality again = dip_quality_effective(&effective);
        assert_true(dip_quality_equal(&effective, &again));
    }
}

// A setting needs something exactly if turning it on changes nothing.
static void needs_are_named_where_a_setting_has_no_effect(void **state) {
    (void)state;
    static const struct {
        const char *quality;
        DipSetting setting;
        const char *needs;
    } rows[] = {
        {"", DIP_SETTING_TAA, NULL}, // taa=history needs no samples
        {"taa=on", DIP_SETTING_TAA, "needs AA"},
        {"taa=history", DIP_SETTING_TAA, NULL},
        {"aa=2,taa=alternate", DIP_SETTING_TAA, NULL},
        {"", DIP_SETTING_AAA, "needs AA"},
        {"aa=2,asd=2", DIP_SETTING_AAA, NULL}, // aaa=coverage needs no groups
        {"aa=2,asd=2,aaa=on", DIP_SETTING_AAA, "needs smaller groups"},
        {"aa=4,aaa=coverage", DIP_SETTING_ASD, "needs adaptive AA"},
        {"aa=4,aaa=all", DIP_SETTING_ASD, NULL},
        {"aaa=all", DIP_SETTING_AAA, "needs AA"},
        {"aa=4,asd=2", DIP_SETTING_AAA, NULL},
        {"aa=4", DIP_SETTING_ASD, "needs adaptive AA"},
        {"aa=4,aaa=on", DIP_SETTING_ASD, NULL},
        {"aa=4", DIP_SETTING_AAF, "needs AF"},
        {"af=2", DIP_SETTING_AAF, NULL},
        {"", DIP_SETTING_AF, NULL},
        {"upscale=easu", DIP_SETTING_UPSCALE, "needs a scale below 1"},
        {"scale=2", DIP_SETTING_UPSCALE, "needs a scale below 1"},
        {"scale=1/2", DIP_SETTING_UPSCALE, NULL},
        {"", DIP_SETTING_SCALE, NULL},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        DipQuality quality;
        assert_true(dip_quality_parse(rows[i].quality, &quality, NULL));
        const char *needs = dip_quality_needs(&quality, rows[i].setting);
        assert_true(!needs == !rows[i].needs);
        if (needs) {
            assert_string_equal(needs, rows[i].needs);
        }
    }
}

static void biases_of_miplod_are_those_of_the_document(void **state) {
    (void)state;
    static const struct {
        const char *settings;
        int bias_lod8;
        const char *mirrored; // the settings of the mirrored scene
    } rows[] = {
        {"miplod=high-performance", 384, "miplod=high-performance"},
        {"miplod=performance", 256, "miplod=performance"},
        {"miplod=quality", 128, "miplod=quality"},
        {"miplod=high-quality", 0, "defaults"},
        {"miplod=sharp", -128, "defaults"},
        {"aa=4,miplod=sharper", -256, "aa=4"},
        {"miplod=sharper,mipdebug=on", 0, "mipdebug=on"},
        {"miplod=quality,mipdebug=on", 128, "miplod=quality,mipdebug=on"},
        // A scale below 1 has its logarithm as a bias.
        {"scale=1/2", -256, "defaults"},
        {"scale=1/1.7", -196, "defaults"},
        {"scale=1/1.5", -150, "defaults"},
        {"scale=1/1.3", -97, "defaults"},
        {"scale=2", 0, "scale=2"},
        {"scale=1/2,miplod=sharp", -384, "defaults"},
        {"scale=1/2,miplod=performance", 0, "miplod=performance"},
        {"scale=1/2,miplod=quality,mipdebug=on", 128, "miplod=quality,mipdebug=on"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        DipQuality quality;
        char text[256];
        assert_true(dip_quality_parse(rows[i].settings, &quality, NULL));
        assert_int_equal(dip_quality_bias_lod8(&quality), rows[i].bias_lod8);
        const DipQuality mirrored = dip_quality_mirrored(&quality);
        dip_quality_format_changes(&mirrored, text, sizeof text);
        assert_string_equal(text, rows[i].mirrored);
    }
}

static void labels_fit_where_they_are_shown(void **state) {
    (void)state;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        const DipSettingInfo *info = dip_setting_info((DipSetting)s);
        assert_true(strlen(info->short_title) <= 10);
        for (int step = 0; step < info->step_count; step++) {
            assert_true(info->labels[step] && strlen(info->narrow_labels[step]) <= 6);
            assert_int_equal(
                dip_setting_step_at((DipSetting)s, dip_setting_step_at((DipSetting)s, step)), step);
        }
    }
    assert_int_equal(dip_setting_step_at(DIP_SETTING_OPT, 0), DIP_OPT_ADVANCED);
    assert_int_equal(dip_setting_step_at(DIP_SETTING_AF, 0), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(settings_have_their_documented_defaults),
        cmocka_unit_test(every_text_fits_its_buffers),
        cmocka_unit_test(short_texts_list_changes_only),
        cmocka_unit_test(settings_without_effect_are_turned_off),
        cmocka_unit_test(needs_are_named_where_a_setting_has_no_effect),
        cmocka_unit_test(biases_of_miplod_are_those_of_the_document),
        cmocka_unit_test(labels_fit_where_they_are_shown),
        cmocka_unit_test(formatting_gives_the_parsed_text_back),
        cmocka_unit_test(settings_that_are_left_out_keep_their_defaults),
        cmocka_unit_test(texts_of_earlier_versions_stay_valid),
        cmocka_unit_test(bad_settings_are_refused),
        cmocka_unit_test(only_pairs_of_aa_and_asd_in_the_table_are_accepted),
        cmocka_unit_test(formatting_returns_the_length_as_snprintf_does),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
