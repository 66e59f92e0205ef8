// Tests good ini files. Two files must load with all their values: the ini file printed in the 2006
// ATI Catalyst Control Preview report (Figure 12) and the shipped ini file. Missing keys must get
// their defaults. docs/config.md must describe every key.
#include "config/config.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifndef DIP_SOURCE_DIR
#error "DIP_SOURCE_DIR must name the top folder"
#endif

static const char figure12[] = DIP_SOURCE_DIR "/tests/config/figure12.ini";

static void check_fault(const DipErrorList *faults, size_t index, DipErrorCode code,
                        DipSeverity severity, int line, const char *key, const char *said) {
    assert_true(index < faults->count);
    const DipError *err = &faults->items[index];
    assert_int_equal(err->code, code);
    assert_int_equal(err->severity, severity);
    assert_int_equal(err->line, line);
    assert_string_equal(err->key, key);
    assert_non_null(strstr(err->message, said));
}

static void load(const char *file, DipConfig *config, DipErrorList *faults) {
    *faults = (DipErrorList){0};
    if (!dip_config_load(file, config, faults)) {
        char text[700];
        dip_error_format(&faults->items[0], text, sizeof text);
        fail_msg("%s", text);
    }
}

static void load_text(const char *file, const char *text, DipConfig *config, DipErrorList *faults) {
    FILE *stream = fopen(file, "wb");
    assert_non_null(stream);
    fputs(text, stream);
    fclose(stream);
    load(file, config, faults);
    remove(file);
}

// An ini of 17 lines with one key per line. All values are as short as possible.
#define SHORT                                                                                      \
    "RES:1x2\nREFLECTION_RES=3x4\nFOUNTAIN_WATER_LEVEL:-.5\nDEBUG_SHOW_REFLECTION=true\n"          \
    "XFILE:a.x\nCAMPATH_RESET_ON_SWITCH:false\nCAMPATH_DEFAULT:p\nCAMPATH_AA:p\nCAMPATH_AF:p\n"    \
    "CAMPATH_TAA:p\nCAMPATH_AAF:p\nCAMPATH_AAA:p\nCAMPATH_CAI:p\nCAMPATH_MIPLOD:p\nCAMPATH_GI:p\n" \
    "CAMPATH_DEFAULT_FOV:60\nMIPDEBUG:true\n"

static void the_ini_of_figure_12_loads_as_printed(void **context) {
    (void)context;
    DipConfig config;
    DipErrorList faults;
    load(figure12, &config, &faults);
    assert_int_equal(config.res.width, 640);
    assert_int_equal(config.res.height, 480);
    assert_int_equal(config.reflection_res.width, 320);
    assert_int_equal(config.reflection_res.height, 240);
    assert_true(config.fountain_water_level == 65.619);
    assert_false(config.debug_show_reflection);
    assert_int_equal(config.xfile.count, 1);
    assert_string_equal(config.xfile.items[0].text, "./Meshes/final_mesh.x");
    assert_string_equal(config.xfile.items[0].path,
                        DIP_SOURCE_DIR "/tests/config/./Meshes/final_mesh.x");
    assert_true(config.campath_reset_on_switch);
    static const char *const paths[] = {
        [DIP_CATEGORY_DEFAULT] = "AmbCamera.bth", [DIP_CATEGORY_AA] = "AntiAliasCam.bth",
        [DIP_CATEGORY_AF] = "AnisoCam.bth",       [DIP_CATEGORY_TAA] = "AntiAliasCam.bth",
        [DIP_CATEGORY_AAF] = "AnisoCam.bth",      [DIP_CATEGORY_AAA] = "AdaptiveAACam.bth",
        [DIP_CATEGORY_CAI] = "AmbCamera.bth",     [DIP_CATEGORY_MIPLOD] = "MipMapCam.bth",
        [DIP_CATEGORY_GI] = "AmbCamera.bth",
    };
    for (size_t c = 0; c < sizeof paths / sizeof *paths; c++) {
        assert_string_equal(config.camera[c].file.text, paths[c]);
        assert_true(config.camera[c].fov_y_deg == 55.0); // The category AAF takes the value of AF.
    }
    assert_null(config.camera[DIP_CATEGORY_WATER].file.path);
    assert_false(config.mipdebug);
    // The key MIPDEBUG32 occurs twice; its later value, tex16.bmp, counts.
    static const char *const pictures[] = {
        "./Mipdebug_textures/texbase1024.bmp", "./Mipdebug_textures/tex512.bmp",
        "./Mipdebug_textures/tex256.bmp",      "./Mipdebug_textures/tex128.bmp",
        "./Mipdebug_textures/tex64.bmp",       "./Mipdebug_textures/tex16.bmp",
        "./Mipdebug_textures/tex8.bmp",
    };
    for (int l = 0; l < 7; l++) {
        assert_string_equal(config.mip_picture[l].text, pictures[l]);
    }
    assert_null(config.mip_picture[DIP_MIP_LEVEL_8].path);
    assert_int_equal(faults.count, 2);
    check_fault(&faults, 0, DIP_ERROR_CONFLICT, DIP_SEVERITY_WARNING, 37, "CAMPATH_AAA_FOV",
                "line 36");
    check_fault(&faults, 1, DIP_ERROR_CONFLICT, DIP_SEVERITY_WARNING, 52, "MIPDEBUG32", "line 51");
    dip_error_list_free(&faults);
    dip_config_free(&config);
}

static void the_shipped_ini_loads_without_a_fault(void **context) {
    (void)context;
    DipConfig config;
    DipErrorList faults;
    load(DIP_SOURCE_DIR "/config/courtyard.ini", &config, &faults);
    assert_int_equal(faults.count, 0);
    assert_int_equal(config.res.width, 640);
    assert_true(config.fountain_water_level == 0.66);
    assert_string_equal(config.xfile.items[0].path,
                        DIP_SOURCE_DIR "/config/../assets/courtyard/court.gltf");
    FILE *model = fopen(config.xfile.items[0].path, "rb");
    assert_non_null(model);
    fclose(model);
    assert_true(dip_config_same_file(&config.camera[DIP_CATEGORY_AA].file,
                                     &config.camera[DIP_CATEGORY_TAA].file));
    assert_string_equal(config.camera[DIP_CATEGORY_WATER].file.text, "../campaths/water.pth");
    assert_int_equal(dip_quality_sample_count(&config.current), 1);
    assert_int_equal(dip_quality_sample_count(&config.requested), 4);
    assert_int_equal(dip_quality_max_anisotropy(&config.requested), 16);
    dip_config_free(&config);
    dip_config_free(&config); // A zeroed config may be freed again.
}

static void keys_that_are_left_out_have_their_defaults(void **context) {
    (void)context;
    DipConfig config;
    DipErrorList faults;
    load_text("test.ini", SHORT, &config, &faults);
    assert_int_equal(faults.count, 0);
    assert_int_equal(config.res.height, 2);
    assert_int_equal(config.reflection_res.width, 3);
    assert_true(config.fountain_water_level == -0.5);
    assert_true(config.debug_show_reflection && config.mipdebug);
    assert_false(config.campath_reset_on_switch);
    assert_string_equal(config.xfile.items[0].path, "a.x"); // The ini is in the working folder.
    assert_true(config.camera[DIP_CATEGORY_GI].fov_y_deg == 60.0);
    const DipQuality quality = dip_quality_default();
    assert_memory_equal(&config.current, &quality, sizeof quality);
    assert_memory_equal(&config.requested, &quality, sizeof quality);
    assert_int_equal(config.threads, 0);
    assert_int_equal(config.isa, DIP_CONFIG_ISA_AUTO);
    assert_true(config.near_m == 0.1);
    assert_int_equal(config.background.rgb[1], 64);
    assert_null(config.log.path);
    assert_int_equal(config.shading, DIP_CONFIG_SHADING_auto);
    assert_int_equal(config.light.count, 0);
    assert_int_equal(config.ambient.rgb[0], 89);
    assert_true(config.light_scale.automatic);
    assert_int_equal(config.line[DIP_KEY_THREADS], 0);
    assert_int_equal(config.line[DIP_KEY_MIPDEBUG], 17);
    dip_config_free(&config);
}

static void a_model_and_a_resolution_are_enough(void **context) {
    (void)context;
    DipConfig config;
    DipErrorList faults;
    load_text("test.ini", "XFILE: a.gltf\nRES: 64x48\n", &config, &faults);
    assert_int_equal(faults.count, 0);
    assert_int_equal(config.res.width, 64);
    assert_int_equal(config.reflection_res.width, 320);
    assert_int_equal(config.reflection_res.height, 240);
    assert_true(config.fountain_water_level == 0.0);
    assert_int_equal(config.line[DIP_KEY_FOUNTAIN_WATER_LEVEL], 0);
    assert_false(config.debug_show_reflection || config.mipdebug);
    assert_true(config.campath_reset_on_switch);
    for (int c = 0; c < DIP_CATEGORY_COUNT; c++) {
        assert_null(config.camera[c].file.path);
    }
    assert_true(config.camera[DIP_CATEGORY_DEFAULT].fov_y_deg == 55.0);
    dip_config_free(&config);
}

static void a_path_without_a_field_of_view_gets_the_default(void **context) {
    (void)context;
    DipConfig config;
    DipErrorList faults;
    load_text("test.ini",
              "XFILE: a.gltf\nRES: 64x48\nCAMPATH_AA: a.pth\nCAMPATH_AF: b.pth\n"
              "CAMPATH_AAF: ./b.pth\nCAMPATH_AAF_FOV: 40\nCAMPATH_DEFAULT_FOV: 30\n",
              &config, &faults);
    assert_int_equal(faults.count, 0);
    assert_true(config.camera[DIP_CATEGORY_AA].fov_y_deg == 55.0);
    assert_true(config.camera[DIP_CATEGORY_AF].fov_y_deg == 40.0); // AAF has the same file.
    assert_true(config.camera[DIP_CATEGORY_DEFAULT].fov_y_deg == 30.0);
    assert_null(config.camera[DIP_CATEGORY_DEFAULT].file.path);
    dip_config_free(&config);
}

static void settings_and_optional_keys_are_read(void **context) {
    (void)context;
    DipConfig config;
    DipErrorList faults;
    load_text("./test.ini",
              SHORT "CURRENT: aa=2\nREQUESTED = aa=8,aaf=on,miplod=performance ; text\n"
                    "THREADS: 256\nISA: sse2\nNEAR: 1e-2\nBACKGROUND: 0,255,7\n"
                    "LOG: /var/log/diptych.log\nCAMPATH_WATER: w\nCAMPATH_WATER_FOV: 44.5\n"
                    "MIPDEBUG8: eight.png\nXFILE: sub/b.gltf\n",
              &config, &faults);
    assert_int_equal(faults.count, 0);
    assert_int_equal(dip_quality_sample_count(&config.current), 2);
    assert_int_equal(dip_quality_sample_count(&config.requested), 8);
    assert_int_equal(config.requested.step[DIP_SETTING_MIPLOD], DIP_MIPLOD_PERFORMANCE);
    assert_int_equal(config.threads, 256);
    assert_int_equal(config.isa, DIP_ISA_SSE2);
    assert_true(config.near_m == 0.01);
    assert_int_equal(config.background.rgb[0], 0);
    assert_int_equal(config.background.rgb[1], 255);
    assert_int_equal(config.background.rgb[2], 7);
    assert_string_equal(config.log.path, "/var/log/diptych.log");
    assert_true(config.camera[DIP_CATEGORY_WATER].fov_y_deg == 44.5);
    assert_string_equal(config.mip_picture[DIP_MIP_LEVEL_8].path, "./eight.png");
    assert_int_equal(config.xfile.count, 2);
    assert_string_equal(config.xfile.items[1].path, "./sub/b.gltf");
    assert_int_equal(config.xfile.items[1].line, 28);
    DipError err;
    assert_false(dip_config_file_fault(&config, &config.xfile.items[1], DIP_ERROR_IO, &err,
                                       "cannot be opened, accepted a %s", "model"));
    char text[400];
    dip_error_format(&err, text, sizeof text);
    assert_string_equal(text, "./test.ini:28: [XFILE] cannot be opened, accepted a model");
    dip_config_free(&config);
}

// inih alone would misread or ignore most of these lines.
static void check_material(const DipConfigMaterials *materials, size_t index, const char *pattern,
                           const char *path, int line) {
    const DipConfigMaterial *material = &materials->items[index];
    assert_string_equal(material->pattern, pattern);
    assert_int_equal(material->line, line);
    assert_int_equal(material->light_map.path != NULL, path != NULL);
    if (path) {
        assert_string_equal(material->light_map.path, path);
    }
}

static void materials_keep_their_names_and_light_maps(void **context) {
    (void)context;
    DipConfig config;
    DipErrorList faults = {0};
    load_text("./test.ini",
              "XFILE: a.x\nRES: 64x48\nMATERIAL_WATER: Pool *\nMATERIAL_WATER = a=b = c\n"
              "MATERIAL_LIGHTMAP: Wall\nMATERIAL_LIGHTMAP: A = B=C = sub/l=1.png ; comment\n"
              "MATERIAL_LIGHTMAP = D:E\t=\t/abs.png\nMATERIAL_LIGHTMAP: F=G.png\n"
              "MATERIAL_LIGHTMAP: H= I.png\nMATERIAL_LIGHTMAP: J =K.png\n"
              "MATERIAL_LIGHTMAP: L =\n",
              &config, &faults);
    assert_int_equal(faults.count, 0);
    assert_int_equal(config.material_water.count, 2);
    check_material(&config.material_water, 0, "Pool *", NULL, 3);
    check_material(&config.material_water, 1, "a=b = c", NULL, 4);
    assert_int_equal(config.material_lightmap.count, 7);
    check_material(&config.material_lightmap, 0, "Wall", NULL, 5);
    check_material(&config.material_lightmap, 1, "A = B=C", "./sub/l=1.png", 6);
    check_material(&config.material_lightmap, 2, "D:E", "/abs.png", 7);
    check_material(&config.material_lightmap, 3, "F=G.png", NULL, 8);
    check_material(&config.material_lightmap, 4, "H= I.png", NULL, 9);
    check_material(&config.material_lightmap, 5, "J =K.png", NULL, 10);
    check_material(&config.material_lightmap, 6, "L =", NULL, 11);
    assert_int_equal(config.material_sky.count, 0);
    dip_config_free(&config);
}

static void assert_near(const float *found, double x, double y, double z) {
    const double expected[3] = {x, y, z};
    for (int i = 0; i < 3; i++) {
        if (!(found[i] >= expected[i] - 1e-5 && found[i] <= expected[i] + 1e-5)) {
            fail_msg("component %d is %g, not %g", i, (double)found[i], expected[i]);
        }
    }
}

// The sRGB code 188 stands for the light 0.502886 (IEC 61966-2-1).
static void lights_are_read(void **context) {
    (void)context;
    DipConfig config;
    DipErrorList faults;
    load_text("lights.ini",
              SHORT "LIGHT: directional to=0,-3,4 colour=255,188,0 strength=2 ; the sun\n"
                    "LIGHT = point\tat=1,2,-3.5  range=12 attenuation=1,0.5,0\n"
                    "LIGHT: spot to=0,0,0 at=0,3,0 inner=15 outer=30 strength=9\n"
                    "SHADING: gouraud\nLIGHT_SCALE: 0.25\nAMBIENT: 1,2,3\n",
              &config, &faults);
    assert_int_equal(faults.count, 0);
    assert_int_equal(config.light.count, 3);
    const DipLightDef *sun = &config.light.items[0];
    assert_int_equal(sun->kind, DIP_LIGHT_DIRECTIONAL);
    assert_near(sun->colour_lin, 2.0, 1.005773, 0.0);
    assert_near(sun->direction_world, 0.0, -0.6, 0.8);
    const DipLightDef *point = &config.light.items[1];
    assert_int_equal(point->kind, DIP_LIGHT_POINT);
    assert_near(point->colour_lin, 1.0, 1.0, 1.0);
    assert_near(point->position_world, 1.0, 2.0, -3.5);
    assert_near(point->attenuation, 1.0, 0.5, 0.0);
    assert_true(point->range_m == 12.0f);
    const DipLightDef *spot = &config.light.items[2];
    assert_int_equal(spot->kind, DIP_LIGHT_SPOT);
    assert_near(spot->position_world, 0.0, 3.0, 0.0);
    assert_near(spot->direction_world, 0.0, -1.0, 0.0);
    assert_near(spot->attenuation, 0.0, 0.0, 1.0);
    assert_true(spot->inner_deg == 15.0f && spot->outer_deg == 30.0f && spot->range_m == 0.0f);
    assert_int_equal(config.shading, DIP_CONFIG_SHADING_gouraud);
    assert_false(config.light_scale.automatic);
    assert_true(config.light_scale.factor == 0.25);
    assert_int_equal(config.ambient.rgb[2], 3);
    dip_config_free(&config);
}

// Light falls off if any one of the three numbers of attenuation is above 0.
static void each_number_of_attenuation_may_be_the_only_one(void **context) {
    (void)context;
    DipConfig config;
    DipErrorList faults;
    load_text("lights.ini",
              SHORT "LIGHT: point at=1,2,3 attenuation=2,0,0\n"
                    "LIGHT: point at=1,2,3 attenuation=0,3,0\n"
                    "LIGHT: point at=1,2,3 attenuation=0,0,4\n",
              &config, &faults);
    assert_int_equal(config.light.count, 3);
    for (int i = 0; i < 3; i++) {
        assert_near(config.light.items[i].attenuation, i == 0 ? 2.0 : 0.0, i == 1 ? 3.0 : 0.0,
                    i == 2 ? 4.0 : 0.0);
    }
    dip_config_free(&config);
}

static void there_are_at_most_64_lights(void **context) {
    (void)context;
    static char text[8192] = SHORT;
    DipConfig config;
    DipErrorList faults;
    for (int i = 0; i < DIP_MAX_LIGHTS; i++) {
        strcat(text, "LIGHT: point at=1,2,3\n");
    }
    load_text("many_lights.ini", text, &config, &faults);
    assert_int_equal(config.light.count, DIP_MAX_LIGHTS);
    dip_config_free(&config);
    FILE *stream = fopen("many_lights.ini", "wb");
    assert_non_null(stream);
    fprintf(stream, "%sLIGHT: point at=1,2,3\n", text);
    fclose(stream);
    assert_false(dip_config_load("many_lights.ini", &config, &faults));
    check_fault(&faults, 0, DIP_ERROR_OVERSIZED, DIP_SEVERITY_ERROR, 17 + DIP_MAX_LIGHTS + 1,
                "LIGHT", "is given more than 64 times, accepted up to 64 lights");
    dip_error_list_free(&faults);
    remove("many_lights.ini");
}

static void there_are_at_most_32_names_of_each_kind_of_material(void **context) {
    (void)context;
    static char text[8192] = SHORT;
    DipConfig config;
    DipErrorList faults;
    for (int i = 0; i < DIP_CONFIG_MAX_MATERIALS; i++) {
        strcat(text, "MATERIAL_LIGHTMAP: Wall = wall.png\nMATERIAL_SKY: Sky *\n");
    }
    load_text("names.ini", text, &config, &faults);
    assert_int_equal(faults.count, 0);
    assert_int_equal(config.material_lightmap.count, 32);
    assert_int_equal(config.material_sky.count, 32);
    dip_config_free(&config);
    FILE *stream = fopen("names.ini", "wb");
    assert_non_null(stream);
    fprintf(stream, "%sMATERIAL_LIGHTMAP: Wall = wall.png\n", text);
    fclose(stream);
    assert_false(dip_config_load("names.ini", &config, &faults));
    assert_int_equal(faults.count, 1);
    check_fault(&faults, 0, DIP_ERROR_OVERSIZED, DIP_SEVERITY_ERROR, 17 + 64 + 1,
                "MATERIAL_LIGHTMAP", "is given more than 32 times, accepted up to 32 names");
    dip_error_list_free(&faults);
    remove("names.ini");
}

// A letter may take more than one byte, and the limit is one of bytes.
static void a_name_has_at_most_63_bytes(void **context) {
    (void)context;
    static const char *const letters[] = {"a", "\xc3\xa9"};
    for (int i = 0; i < 2; i++) {
        char name[80] = "x";
        char text[4096];
        DipConfig config;
        DipErrorList faults;
        while (strlen(name) < 63) {
            strcat(name, letters[i]);
        }
        assert_int_equal(strlen(name), 63);
        snprintf(text, sizeof text, SHORT "ANIMATION: %s\n", name);
        load_text("name.ini", text, &config, &faults);
        assert_int_equal(faults.count, 0);
        assert_string_equal(config.animation.text, name);
        dip_config_free(&config);
        FILE *stream = fopen("name.ini", "wb");
        assert_non_null(stream);
        fprintf(stream, SHORT "ANIMATION: %sb\n", name);
        fclose(stream);
        assert_false(dip_config_load("name.ini", &config, &faults));
        assert_int_equal(faults.count, 1);
        char said[100];
        snprintf(said, sizeof said, "'%.40s...' is too long, accepted at most 63 bytes", name);
        check_fault(&faults, 0, DIP_ERROR_OVERSIZED, DIP_SEVERITY_ERROR, 18, "ANIMATION", said);
        dip_error_list_free(&faults);
        remove("name.ini");
    }
}

static void comments_and_white_space_are_ignored(void **context) {
    (void)context;
    DipConfig config;
    DipErrorList faults;
    char comment[400];
    memset(comment, 'x', sizeof comment);
    comment[0] = ';';
    comment[sizeof comment - 1] = '\0';
    char text[4096];
    snprintf(text, sizeof text,
             "\xef\xbb\xbf" SHORT "%s\r\n# a comment: too\r\n\r\n"
             "   THREADS :\t3 ; three  \r\n\tISA\t=  scalar%s\r\n"
             "LOG: a;b c.log\t;comment",
             comment, "    ");
    load_text("test.ini", text, &config, &faults);
    assert_int_equal(faults.count, 0);
    assert_int_equal(config.res.width, 1);
    assert_int_equal(config.threads, 3); // An indented line does not continue a value.
    assert_int_equal(config.line[DIP_KEY_THREADS], 21);
    assert_int_equal(config.isa, DIP_ISA_SCALAR);
    assert_string_equal(config.log.text, "a;b c.log");
    dip_config_free(&config);

    char longest[DIP_CONFIG_MAX_LINE + 1];
    memset(longest, 'y', sizeof longest);
    memcpy(longest, "LOG:", 4);
    longest[DIP_CONFIG_MAX_LINE] = '\0';
    snprintf(text, sizeof text, SHORT "%s %s\n", longest, comment);
    load_text("test.ini", text, &config, &faults);
    assert_int_equal(strlen(config.log.text), DIP_CONFIG_MAX_LINE - 4);
    dip_config_free(&config);
}

static void two_names_of_one_file_are_recognised(void **context) {
    (void)context;
    static const struct {
        char *a, *b;
        bool same;
    } cases[] = {
        {"a.pth", "./a.pth", true},
        {"x/./a.pth", "x//a.pth", true},
        {"x/.//./a.pth", "./x/a.pth", true},
        {"/x/a.pth", "/x/./a.pth", true},
        {"x/a.pth", "/x/a.pth", false},
        {"a.pth", "A.pth", false},
        {"a.pth", "a.pth2", false},
        {"x/a", "xa", false},
        {"../a", "a", false},
        {".a", "a", false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const DipConfigFile a = {.path = cases[i].a};
        const DipConfigFile b = {.path = cases[i].b};
        if (dip_config_same_file(&a, &b) != cases[i].same ||
            dip_config_same_file(&b, &a) != cases[i].same) {
            fail_msg("%s and %s", cases[i].a, cases[i].b);
        }
    }
    const DipConfigFile none = {0};
    assert_false(dip_config_same_file(&none, &none));
}

static void the_documentation_has_a_row_for_every_key(void **context) {
    (void)context;
    static char document[1 << 16];
    FILE *stream = fopen(DIP_SOURCE_DIR "/docs/config.md", "rb");
    assert_non_null(stream);
    document[fread(document, 1, sizeof document - 1, stream)] = '\0';
    fclose(stream);
    int missing = 0;
    for (int k = 0; k < DIP_KEY_COUNT; k++) {
        char row[512];
        dip_config_document_key((DipConfigKey)k, row, sizeof row);
        if (!strstr(document, row)) {
            missing++;
            print_message("%s\n", row);
        }
    }
    int rows = 0;
    for (const char *at = document; (at = strstr(at, "\n| `")) != NULL; at++) {
        rows++;
    }
    assert_int_equal(rows, DIP_KEY_COUNT - missing); // No row is repeated or obsolete.
    if (missing) {
        fail_msg("docs/config.md lacks the %d rows above", missing);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_ini_of_figure_12_loads_as_printed),
        cmocka_unit_test(the_shipped_ini_loads_without_a_fault),
        cmocka_unit_test(keys_that_are_left_out_have_their_defaults),
        cmocka_unit_test(a_model_and_a_resolution_are_enough),
        cmocka_unit_test(a_path_without_a_field_of_view_gets_the_default),
        cmocka_unit_test(settings_and_optional_keys_are_read),
        cmocka_unit_test(materials_keep_their_names_and_light_maps),
        cmocka_unit_test(lights_are_read),
        cmocka_unit_test(each_number_of_attenuation_may_be_the_only_one),
        cmocka_unit_test(there_are_at_most_64_lights),
        cmocka_unit_test(there_are_at_most_32_names_of_each_kind_of_material),
        cmocka_unit_test(a_name_has_at_most_63_bytes),
        cmocka_unit_test(comments_and_white_space_are_ignored),
        cmocka_unit_test(two_names_of_one_file_are_recognised),
        cmocka_unit_test(the_documentation_has_a_row_for_every_key),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
