// Tests ini files that must be refused. The error must have the line, the key and the reason. All
// faults of a file must be reported in one run. Mutated copies of good files may be refused but
// must not crash the program.
#include "config/config.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// A good file of 26 lines. Each test case adds lines at its end, blanks out one of its lines, or
// does both.
static const char good[] = "RES: 640x480\n"
                           "REFLECTION_RES: 320x240\n"
                           "FOUNTAIN_WATER_LEVEL: 0.5\n"
                           "DEBUG_SHOW_REFLECTION: false\n"
                           "XFILE: court.gltf\n"
                           "CAMPATH_RESET_ON_SWITCH: true\n"
                           "CAMPATH_DEFAULT: amb.pth\n"
                           "CAMPATH_AA: aa.pth\n"
                           "CAMPATH_AF: af.pth\n"
                           "CAMPATH_TAA: aa.pth\n"
                           "CAMPATH_AAF: af.pth\n"
                           "CAMPATH_AAA: aaa.pth\n"
                           "CAMPATH_CAI: amb.pth\n"
                           "CAMPATH_MIPLOD: mip.pth\n"
                           "CAMPATH_GI: amb.pth\n"
                           "CAMPATH_DEFAULT_FOV: 55\n"
                           "CAMPATH_AA_FOV: 45\n"
                           "CAMPATH_AF_FOV: 50\n"
                           "CAMPATH_TAA_FOV: 45\n"
                           "CAMPATH_AAF_FOV: 50\n"
                           "CAMPATH_AAA_FOV: 40\n"
                           "CAMPATH_CAI_FOV: 55\n"
                           "CAMPATH_MIPLOD_FOV: 50\n"
                           "CAMPATH_GI_FOV: 55\n"
                           "MIPDEBUG: false\n"
                           "; line 26\n";

typedef struct BadIni {
    const char *promise;
    const char *without; // the key whose line is blanked out; NULL keeps all lines
    const char *added;   // lines to add, from line 27 on
    DipErrorCode code;
    int line;
    const char *key;
    const char *said; // text that the message contains
} BadIni;

static const BadIni bad_inis[] = {
    // Materials.
    {"a material without a name", NULL, "MATERIAL_SKY:\n", DIP_ERROR_MISSING, 27, "MATERIAL_SKY",
     "has no value, accepted a name with * and ?, up to 32 times"},
    {"a misspelt mark", NULL, "MATERIAL_LIGHT_MAP: Wall\n", DIP_ERROR_UNKNOWN, 27,
     "MATERIAL_LIGHT_MAP", "did you mean MATERIAL_LIGHTMAP?"},
    // Values of the wrong type.
    {"a resolution of one number", "RES", "RES: 640\n", DIP_ERROR_TYPE, 27, "RES",
     "'640' is not WIDTHxHEIGHT, accepted WIDTHxHEIGHT, 1..8192 each, for example 640x480"},
    {"a resolution of three numbers", "RES", "RES: 640x480x32\n", DIP_ERROR_TYPE, 27, "RES", "32'"},
    {"a resolution with spaces", "RES", "RES: 640 x 480\n", DIP_ERROR_TYPE, 27, "RES", "640 x 480"},
    {"a resolution with a fraction", "RES", "RES: 640.5x480\n", DIP_ERROR_TYPE, 27, "RES", "640.5"},
    {"a resolution with an exponent", "RES", "RES: 6e2x480\n", DIP_ERROR_TYPE, 27, "RES", "6e2"},
    {"a resolution of words", "REFLECTION_RES", "REFLECTION_RES: big\n", DIP_ERROR_TYPE, 27,
     "REFLECTION_RES", "'big'"},
    {"a resolution cut short", "RES", "RES: 640x\n", DIP_ERROR_TYPE, 27, "RES", "'640x'"},
    {"a water level of words", "FOUNTAIN_WATER_LEVEL", "FOUNTAIN_WATER_LEVEL: high\n",
     DIP_ERROR_TYPE, 27, "FOUNTAIN_WATER_LEVEL", "'high'"},
    {"a water level with a unit", "FOUNTAIN_WATER_LEVEL", "FOUNTAIN_WATER_LEVEL: 0.5m\n",
     DIP_ERROR_TYPE, 27, "FOUNTAIN_WATER_LEVEL", "'0.5m'"},
    {"a water level with a comma", "FOUNTAIN_WATER_LEVEL", "FOUNTAIN_WATER_LEVEL: 0,5\n",
     DIP_ERROR_TYPE, 27, "FOUNTAIN_WATER_LEVEL", "'0,5'"},
    {"a water level that is nan", "FOUNTAIN_WATER_LEVEL", "FOUNTAIN_WATER_LEVEL: nan\n",
     DIP_ERROR_TYPE, 27, "FOUNTAIN_WATER_LEVEL", "'nan'"},
    {"a flag in upper case", "MIPDEBUG", "MIPDEBUG: TRUE\n", DIP_ERROR_TYPE, 27, "MIPDEBUG",
     "'TRUE' is neither true nor false, accepted true or false"},
    {"a flag as a number", "DEBUG_SHOW_REFLECTION", "DEBUG_SHOW_REFLECTION: 1\n", DIP_ERROR_TYPE,
     27, "DEBUG_SHOW_REFLECTION", "'1'"},
    {"threads as a fraction", NULL, "THREADS: 2.0\n", DIP_ERROR_TYPE, 27, "THREADS", "whole"},
    {"a colour of two numbers", NULL, "BACKGROUND: 1,2\n", DIP_ERROR_TYPE, 27, "BACKGROUND",
     "R,G,B"},
    {"a colour as in HTML", NULL, "BACKGROUND: #5588cc\n", DIP_ERROR_TYPE, 27, "BACKGROUND",
     "'#5588cc' is not R,G,B, accepted R,G,B, 0..255 each, for example 64,128,255"},
    {"a colour of a name", NULL, "BACKGROUND: blue\n", DIP_ERROR_TYPE, 27, "BACKGROUND", "'blue'"},
    {"a field of view with a unit", "CAMPATH_AAA_FOV", "CAMPATH_AAA_FOV: 40deg\n", DIP_ERROR_TYPE,
     27, "CAMPATH_AAA_FOV", "'40deg'"},
    // Values out of range.
    {"a width of zero", "RES", "RES: 0x480\n", DIP_ERROR_RANGE, 27, "RES", "accepted WIDTHxHEIGHT"},
    {"a negative height", "RES", "RES: 640x-480\n", DIP_ERROR_RANGE, 27, "RES", "1..8192 each"},
    {"a width beyond 8192", "RES", "RES: 8193x1\n", DIP_ERROR_RANGE, 27, "RES", "'8193x1'"},
    {"a width beyond int", "REFLECTION_RES", "REFLECTION_RES: 1x99999999999\n", DIP_ERROR_RANGE, 27,
     "REFLECTION_RES", "out of range"},
    {"a field of view of zero", "CAMPATH_AAA_FOV", "CAMPATH_AAA_FOV: 0\n", DIP_ERROR_RANGE, 27,
     "CAMPATH_AAA_FOV", "1..170"},
    {"a field of view of 180", "CAMPATH_AAA_FOV", "CAMPATH_AAA_FOV: 180\n", DIP_ERROR_RANGE, 27,
     "CAMPATH_AAA_FOV", "1..170"},
    {"a water level out of the world", "FOUNTAIN_WATER_LEVEL", "FOUNTAIN_WATER_LEVEL: 1e10\n",
     DIP_ERROR_RANGE, 27, "FOUNTAIN_WATER_LEVEL", "1e10"},
    {"negative threads", NULL, "THREADS: -1\n", DIP_ERROR_RANGE, 27, "THREADS", "0..256"},
    {"too many threads", NULL, "THREADS: 257\n", DIP_ERROR_RANGE, 27, "THREADS", "0..256"},
    {"a near plane at the eye", NULL, "NEAR: 0\n", DIP_ERROR_RANGE, 27, "NEAR", "0.001..100"},
    {"a colour beyond 255", NULL, "BACKGROUND: 0,256,0\n", DIP_ERROR_RANGE, 27, "BACKGROUND",
     "255"},
    {"an instruction set unheard of", NULL, "ISA: avx1024\n", DIP_ERROR_UNKNOWN, 27, "ISA",
     "accepted auto scalar"},
    {"an overcast above 1", NULL, "SKY_OVERCAST: 1.1\n", DIP_ERROR_RANGE, 27, "SKY_OVERCAST",
     "0..1"},
    {"a cloud speed above 600", NULL, "SKY_LAYER1_SPEED: 1e9\n", DIP_ERROR_RANGE, 27,
     "SKY_LAYER1_SPEED", "-600..600"},
    {"SKY_DENSE not above SKY_CLEAR", NULL, "SKY_DENSE: 0.75\n", DIP_ERROR_CONFLICT, 27,
     "SKY_DENSE", "SKY_CLEAR 0.75"},
    {"SKY_CLEAR not below SKY_DENSE", NULL, "SKY_CLEAR: 1\n", DIP_ERROR_CONFLICT, 27, "SKY_CLEAR",
     "SKY_DENSE is 1"},
    // Lights.
    {"a shading unheard of", NULL, "SHADING: toon\n", DIP_ERROR_UNKNOWN, 27, "SHADING",
     "'toon' is not a shading, accepted auto flat gouraud phong"},
    {"a light scale of words", NULL, "LIGHT_SCALE: half\n", DIP_ERROR_TYPE, 27, "LIGHT_SCALE",
     "'half' is neither auto nor a number, accepted auto or a number 0..1e+06"},
    {"a negative light scale", NULL, "LIGHT_SCALE: -1\n", DIP_ERROR_RANGE, 27, "LIGHT_SCALE",
     "'-1' is out of range, accepted auto or a number 0..1e+06"},
    {"an ambient light of two numbers", NULL, "AMBIENT: 1,2\n", DIP_ERROR_TYPE, 27, "AMBIENT",
     "R,G,B"},
    {"no light", NULL, "LIGHT:\n", DIP_ERROR_MISSING, 27, "LIGHT",
     "has no value, accepted a light such as point at=0,3,0 strength=4, up to 64 times"},
    {"a light of an unknown kind", NULL, "LIGHT: lamp at=0,0,0\n", DIP_ERROR_UNKNOWN, 27, "LIGHT",
     "'lamp' is not a kind of light, accepted directional, point or spot"},
    {"a light with an unknown part", NULL, "LIGHT: point at=0,0,0 power=3\n", DIP_ERROR_UNKNOWN, 27,
     "LIGHT",
     "'power' is no part of a point light, accepted at= colour= strength= range= attenuation="},
    {"a light with a part of another kind", NULL, "LIGHT: directional to=0,-1,0 range=3\n",
     DIP_ERROR_UNKNOWN, 27, "LIGHT",
     "'range' is no part of a directional light, accepted to= colour= strength="},
    {"a part of a light without a value", NULL, "LIGHT: point at\n", DIP_ERROR_TYPE, 27, "LIGHT",
     "at='' is not three numbers, accepted three numbers with commas, -1e+09..1e+09 each"},
    {"a point of two numbers", NULL, "LIGHT: point at=1,2\n", DIP_ERROR_TYPE, 27, "LIGHT",
     "at='1,2' is not three numbers"},
    {"a point of four numbers", NULL, "LIGHT: point at=1,2,3,4\n", DIP_ERROR_TYPE, 27, "LIGHT",
     "at='1,2,3,4' is not three numbers"},
    {"a point that is no number", NULL, "LIGHT: point at=1,nan,3\n", DIP_ERROR_TYPE, 27, "LIGHT",
     "at='1,nan,3'"},
    {"a point out of the world", NULL, "LIGHT: point at=1,1e10,3\n", DIP_ERROR_RANGE, 27, "LIGHT",
     "at='1,1e10,3' is out of range"},
    {"a light with a negative strength", NULL, "LIGHT: point at=1,2,3 strength=-1\n",
     DIP_ERROR_RANGE, 27, "LIGHT", "strength='-1' is out of range, accepted a number 0..1e+06"},
    {"a light with half a colour", NULL, "LIGHT: point at=1,2,3 colour=1,2,0.5\n", DIP_ERROR_TYPE,
     27, "LIGHT", "accepted three whole numbers with commas, 0..255 each"},
    {"a light with too much colour", NULL, "LIGHT: point at=1,2,3 colour=1,2,256\n",
     DIP_ERROR_RANGE, 27, "LIGHT", "colour='1,2,256' is out of range"},
    {"a light with a part twice", NULL, "LIGHT: point at=1,2,3 range=1 range=2\n",
     DIP_ERROR_CONFLICT, 27, "LIGHT", "'range' is given twice, accepted once"},
    {"a point light without a place", NULL, "LIGHT: point strength=1\n", DIP_ERROR_MISSING, 27,
     "LIGHT", "the point light lacks 'at', accepted at=X,Y,Z"},
    {"a spot light without an aim", NULL, "LIGHT: spot at=1,2,3\n", DIP_ERROR_MISSING, 27, "LIGHT",
     "the spot light lacks 'to', accepted to=X,Y,Z"},
    {"a light that goes nowhere", NULL, "LIGHT: directional to=0,0,1e-300\n", DIP_ERROR_RANGE, 27,
     "LIGHT", "'to' has no length"},
    {"a spot light that shines at itself", NULL, "LIGHT: spot at=1,2,3 to=1,2,3\n", DIP_ERROR_RANGE,
     27, "LIGHT", "'at' and 'to' are the same point"},
    {"a light without attenuation", NULL, "LIGHT: point at=1,2,3 attenuation=0,0,1e-300\n",
     DIP_ERROR_RANGE, 27, "LIGHT", "attenuation is 0,0,0"},
    {"an inner cone beyond the outer one", NULL,
     "LIGHT: spot at=1,2,3 to=0,0,0 inner=30 outer=20\n", DIP_ERROR_CONFLICT, 27, "LIGHT",
     "inner is 30 and outer 20, accepted an outer angle above 0 and not below inner"},
    {"a cone without an angle", NULL, "LIGHT: spot at=1,2,3 to=0,0,0 outer=1e-300\n",
     DIP_ERROR_CONFLICT, 27, "LIGHT", "an outer angle above 0"},
    {"a cone beyond 90 degrees", NULL, "LIGHT: spot at=1,2,3 to=0,0,0 outer=91\n", DIP_ERROR_RANGE,
     27, "LIGHT", "outer='91' is out of range, accepted a number 0..90"},
    // Settings as text.
    {"a setting unheard of", NULL, "CURRENT: aa=4,fsaa=2\n", DIP_ERROR_UNKNOWN, 27, "CURRENT",
     "fsaa: no setting of this name"},
    {"a step unheard of", NULL, "REQUESTED: aa=3\n", DIP_ERROR_UNKNOWN, 27, "REQUESTED",
     "aa: '3' is no step, accepted none|2|4|6|8"},
    {"a setting twice", NULL, "REQUESTED: af=2,af=4\n", DIP_ERROR_CONFLICT, 27, "REQUESTED",
     "af: "},
    {"a setting without a step", NULL, "CURRENT: af\n", DIP_ERROR_MISSING, 27, "CURRENT",
     "af: no v"},
    {"a step of another setting", NULL, "REQUESTED: opt=high-quality\n", DIP_ERROR_UNKNOWN, 27,
     "REQUESTED", "opt: 'high-quality' is no step, accepted off|standard|advanced"},
    // Keys.
    {"a key misspelt", NULL, "REFLECTON_RES: 1x1\n", DIP_ERROR_UNKNOWN, 27, "REFLECTON_RES",
     "there is no such key, did you mean REFLECTION_RES?"},
    {"a key in lower case", NULL, "res: 1x1\n", DIP_ERROR_UNKNOWN, 27, "res", "did you mean RES?"},
    {"a key with two letters swapped", NULL, "RSE: 1x1\n", DIP_ERROR_UNKNOWN, 27, "RSE",
     "did you mean RES?"},
    {"a short key unlike any gets no suggestion", NULL, "FOV: 50\n", DIP_ERROR_UNKNOWN, 27, "FOV",
     "accepted are the keys in docs/config.md"},
    {"a key of seven letters with two wrong", NULL, "SHXDXNG: 1\n", DIP_ERROR_UNKNOWN, 27,
     "SHXDXNG", "did you mean SHADING?"},
    {"a key of seven letters with three wrong", NULL, "XHXDXNG: 1\n", DIP_ERROR_UNKNOWN, 27,
     "XHXDXNG", "accepted are the keys in docs/config.md"},
    {"a field of view of no category", NULL, "CAMPATH_AAB_FOV: 50\n", DIP_ERROR_UNKNOWN, 27,
     "CAMPATH_AAB_FOV", "did you mean CAMPATH_AA"},
    {"a key unlike any", NULL, "SHADOW_SOFTNESS: 1\n", DIP_ERROR_UNKNOWN, 27, "SHADOW_SOFTNESS",
     "accepted are the keys in docs/config.md"},
    {"a key of 100 letters", NULL,
     "KKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKK"
     "KKKKKKKKKKKK: 1\n",
     DIP_ERROR_UNKNOWN, 27, "KKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKKK",
     "there is no such key"},
    {"a value without a key", NULL, ": 640x480\n", DIP_ERROR_FORMAT, 27, "",
     "there is no key before the value"},
    {"a key without a value", "XFILE", "XFILE:\n", DIP_ERROR_MISSING, 27, "XFILE",
     "accepted a file"},
    {"a comment for a value", "XFILE", "XFILE: ; court.gltf\n", DIP_ERROR_MISSING, 27, "XFILE",
     "has no value"},
    {"an optional key without a value", NULL, "LOG =\n", DIP_ERROR_MISSING, 27, "LOG",
     "has no value"},
    {"no resolution", "RES", "", DIP_ERROR_MISSING, 0, "RES", "accepted WIDTHxHEIGHT"},
    {"no model", "XFILE", "", DIP_ERROR_MISSING, 0, "XFILE", "missing"},
    {"a field of view without its path", "CAMPATH_GI", "", DIP_ERROR_MISSING, 24, "CAMPATH_GI",
     "is missing, but its field of view is given, accepted a file"},
    // Fields of view.
    {"two fields of view on one path", "CAMPATH_TAA_FOV", "CAMPATH_TAA_FOV: 46\n",
     DIP_ERROR_CONFLICT, 27, "CAMPATH_TAA_FOV",
     "is 46, but CAMPATH_AA_FOV in line 17 is 45 for the same path 'aa.pth', accepted one"},
    {"two fields of view on two names of one path", NULL,
     "CAMPATH_WATER: .//./aaa.pth\nCAMPATH_WATER_FOV: 50\n", DIP_ERROR_CONFLICT, 28,
     "CAMPATH_WATER_FOV", "CAMPATH_AAA_FOV in line 21 is 40"},
    {"a bad field of view on a shared path is one fault", "CAMPATH_TAA_FOV",
     "CAMPATH_TAA_FOV: 999\n", DIP_ERROR_RANGE, 27, "CAMPATH_TAA_FOV", "1..170"},
    {"a field of view without its optional path", NULL, "CAMPATH_WATER_FOV: 50\n",
     DIP_ERROR_MISSING, 27, "CAMPATH_WATER", "is missing, but its field of view is given"},
    // Lines.
    {"a line without a value", NULL, "THREADS 4\n", DIP_ERROR_FORMAT, 27, "THREADS",
     "'THREADS 4' has no value, accepted KEY: value"},
    {"a value alone on an indented line", NULL, "; fine\n   true\n", DIP_ERROR_FORMAT, 28, "true",
     "has no value"},
    {"an indented line is no continuation", NULL, "THREADS: 4\n  5: 6\n", DIP_ERROR_UNKNOWN, 28,
     "5", "no such key"},
    {"a section", NULL, "[panes]\n", DIP_ERROR_FORMAT, 27, "", "'[panes]' begins a section"},
    {"a section left open", NULL, "[panes\n", DIP_ERROR_FORMAT, 27, "",
     "'[panes' begins a section"},
    {"a control character", NULL, "LOG: a\x1b[2J.log\n", DIP_ERROR_FORMAT, 27, "",
     "a control char"},
    {"carriage returns without line feeds", NULL, "THREADS: 4\rISA: auto\n", DIP_ERROR_FORMAT, 27,
     "", "control"},
};

static void write_ini(const void *bytes, size_t size_bytes) {
    FILE *stream = fopen("bad.ini", "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(bytes, 1, size_bytes, stream), size_bytes);
    fclose(stream);
}

static bool says_what_to_type(const char *message) {
    return strstr(message, "accepted") || strstr(message, "did you mean");
}

static void check_fault(const char *promise, const DipError *err, DipErrorCode code, int line,
                        const char *key, const char *said) {
    char text[800];
    dip_error_format(err, text, sizeof text);
    if (err->code != code || err->line != line || strcmp(err->key, key) != 0 ||
        !strstr(err->message, said) || !says_what_to_type(err->message) ||
        strcmp(err->file, "bad.ini") != 0 || err->severity != DIP_SEVERITY_ERROR) {
        fail_msg("%s: found %s %s", promise, dip_error_code_name(err->code), text);
    }
    assert_null(strchr(text, '\n'));
}

// Loads "bad.ini", which must fail with exactly this one fault.
static void check_refused(const char *promise, DipErrorCode code, int line, const char *key,
                          const char *said) {
    DipConfig config;
    DipErrorList faults = {0};
    if (dip_config_load("bad.ini", &config, &faults)) {
        fail_msg("%s: accepted", promise);
    }
    check_fault(promise, &faults.items[0], code, line, key, said);
    if (faults.count != 1) {
        char text[800];
        dip_error_format(&faults.items[1], text, sizeof text);
        fail_msg("%s: %zu faults, the second: %s", promise, faults.count, text);
    }
    assert_null(config.file);
    dip_error_list_free(&faults);
    remove("bad.ini");
}

// Composes the good text with one key's line blanked out and with lines added at the end.
static void compose(const char *without, const char *added, char *text, size_t size_bytes) {
    snprintf(text, size_bytes, "%s%s", good, added);
    if (!without) {
        return;
    }
    const size_t length = strlen(without);
    char *line = text;
    while (strncmp(line, without, length) != 0 || line[length] != ':') {
        line = strchr(line, '\n');
        assert_non_null(line);
        line++;
    }
    memset(line, ' ', strcspn(line, "\n"));
}

static void bad_inis_are_refused(void **context) {
    (void)context;
    for (size_t i = 0; i < sizeof bad_inis / sizeof *bad_inis; i++) {
        const BadIni *bad = &bad_inis[i];
        char text[4096];
        compose(bad->without, bad->added, text, sizeof text);
        write_ini(text, strlen(text));
        check_refused(bad->promise, bad->code, bad->line, bad->key, bad->said);
    }
}

static void the_good_ini_is_accepted(void **context) {
    (void)context;
    write_ini(good, strlen(good));
    DipConfig config;
    DipErrorList faults = {0};
    assert_true(dip_config_load("bad.ini", &config, &faults));
    assert_int_equal(faults.count, 0);
    dip_config_free(&config);
    remove("bad.ini");
}

static void bad_bytes_are_refused(void **context) {
    (void)context;
    static const char nul[] = "RES: 640x480\nREFLEC\0TION_RES: 1x1\n";
    write_ini(nul, sizeof nul - 1);
    check_refused("a NUL byte", DIP_ERROR_FORMAT, 2, "", "a NUL byte");
    static const char utf16[] = "\xff\xfeR\0E\0S\0:\0\n\0";
    write_ini(utf16, sizeof utf16 - 1);
    check_refused("another encoding", DIP_ERROR_FORMAT, 1, "", "a NUL byte");
    write_ini("\xef\xbbRES", 5);
    check_refused("half a byte order mark", DIP_ERROR_FORMAT, 1, "", "stray bytes");
}

static void over_long_lines_are_refused(void **context) {
    (void)context;
    char text[8192];
    char line[2000];
    static const int lengths[] = {DIP_CONFIG_MAX_LINE + 1, 197, 198, 199, 200, 400, 1999};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        memset(line, 'y', sizeof line);
        memcpy(line, "LOG: ", 5);
        line[lengths[i]] = '\0';
        char said[80];
        snprintf(said, sizeof said, "the line has %d bytes, accepted up to %d", lengths[i],
                 DIP_CONFIG_MAX_LINE);
        snprintf(text, sizeof text, "%s%s\n", good, line);
        write_ini(text, strlen(text));
        check_refused("an over-long line", DIP_ERROR_OVERSIZED, 27, "LOG", said);
    }
}

static void files_that_cannot_be_read_are_refused(void **context) {
    (void)context;
    remove("bad.ini");
    check_refused("a file that is not there", DIP_ERROR_IO, 0, "", "cannot be opened");
    assert_int_equal(mkdir("bad.ini", 0700), 0);
    check_refused("a folder", DIP_ERROR_IO, 0, "", "cannot be read");
    FILE *stream = fopen("bad.ini", "wb");
    for (int i = 0; i <= DIP_CONFIG_MAX_FILE_BYTES / 64; i++) {
        fprintf(stream, ";%062d\n", i);
    }
    fclose(stream);
    check_refused("a file beyond 1 MiB", DIP_ERROR_OVERSIZED, DIP_CONFIG_MAX_FILE_BYTES / 64 + 1,
                  "", "up to 1048576 bytes");
}

static void too_many_models_are_refused(void **context) {
    (void)context;
    char text[8192];
    int length = snprintf(text, sizeof text, "%s", good); // This text names one of the models.
    for (int i = 0; i < DIP_CONFIG_MAX_MODELS; i++) {
        length += snprintf(text + length, sizeof text - (size_t)length, "XFILE: %d.x\n", i);
    }
    write_ini(text, strlen(text));
    check_refused("65 models", DIP_ERROR_OVERSIZED, 26 + DIP_CONFIG_MAX_MODELS, "XFILE", "64");
}

static void all_faults_are_reported_in_one_run(void **context) {
    (void)context;
    static const char text[] = "RES: 0x0\n[a]\nnonsense\nTHREADS: x\n\nCAMPATH_AA: a\n"
                               "CAMPATH_AA_FOV: 999\nRSE: 1x1\nRES: 1x1\n";
    static const struct {
        DipErrorCode code;
        int line;
        const char *key;
    } expected[] = {
        {DIP_ERROR_RANGE, 1, "RES"},
        {DIP_ERROR_FORMAT, 2, ""},
        {DIP_ERROR_FORMAT, 3, "nonsense"},
        {DIP_ERROR_TYPE, 4, "THREADS"},
        {DIP_ERROR_RANGE, 7, "CAMPATH_AA_FOV"},
        {DIP_ERROR_UNKNOWN, 8, "RSE"},
        {DIP_ERROR_CONFLICT, 9, "RES"},
        {DIP_ERROR_MISSING, 0, "XFILE"},
    };
    write_ini(text, sizeof text - 1);
    DipConfig config;
    DipErrorList faults = {0};
    assert_false(dip_config_load("bad.ini", &config, &faults));
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        assert_int_equal(faults.items[i].code, expected[i].code);
        assert_int_equal(faults.items[i].line, expected[i].line);
        assert_string_equal(faults.items[i].key, expected[i].key);
    }
    assert_int_equal(faults.items[6].severity, DIP_SEVERITY_WARNING);
    assert_int_equal(faults.count, sizeof expected / sizeof *expected);
    dip_error_list_free(&faults);
    remove("bad.ini");
}

static void at_most_a_hundred_faults_are_reported(void **context) {
    (void)context;
    FILE *stream = fopen("bad.ini", "wb");
    for (int i = 0; i < 5000; i++) {
        fputs("junk\n", stream);
    }
    fclose(stream);
    DipConfig config;
    DipErrorList faults = {0};
    assert_false(dip_config_load("bad.ini", &config, &faults));
    assert_int_equal(faults.count, DIP_CONFIG_MAX_FAULTS + 1);
    assert_int_equal(faults.items[DIP_CONFIG_MAX_FAULTS].code, DIP_ERROR_OVERSIZED);
    dip_error_list_free(&faults);
    remove("bad.ini");
}

// ---- Mutations ----

static uint64_t state = 4711;

static size_t below(size_t count) {
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return (size_t)((state * UINT64_C(2685821657736338717)) >> 33) % count;
}

static size_t mutate(char *bytes, size_t size_bytes, size_t room) {
    static const char meaningful[] = "0123456789.-=: ;#x,\t\r\n[]\0\xef";
    for (size_t n = 1 + below(3); n > 0; n--) {
        const size_t at = below(size_bytes);
        switch (below(8)) {
        case 0:
            bytes[at] = (char)below(256);
            break;
        case 1:
            size_bytes = at + 1;
            break;
        case 2:
            if (size_bytes + (size_bytes - at) <= room) {
                memmove(bytes + size_bytes, bytes + at, size_bytes - at);
                size_bytes += size_bytes - at;
            }
            break;
        default:
            bytes[at] = meaningful[below(sizeof meaningful)];
        }
    }
    return size_bytes;
}

static void mutations_never_crash(void **context) {
    (void)context;
    enum { RUNS = 3000, ROOM = 4096 };
    int accepted = 0;
    for (int run = 0; run < RUNS; run++) {
        char bytes[ROOM];
        size_t size_bytes = (size_t)snprintf(bytes, ROOM,
                                             "%sCURRENT: aa=4,af=16\nTHREADS: 2\nISA: auto\n"
                                             "BACKGROUND: 1,2,3\nCAMPATH_WATER: amb.pth\n",
                                             good);
        size_bytes = mutate(bytes, size_bytes, ROOM);
        write_ini(bytes, size_bytes);
        DipConfig config;
        DipErrorList faults = {0};
        if (dip_config_load("bad.ini", &config, &faults)) {
            accepted++;
            assert_true(config.res.width >= 1 && config.res.width <= 8192);
            for (int c = 0; c < DIP_CATEGORY_COUNT; c++) {
                const bool plays = config.camera[c].file.path || c == DIP_CATEGORY_DEFAULT;
                assert_true(!plays || config.camera[c].fov_y_deg >= 1.0);
            }
            dip_config_free(&config);
        } else {
            assert_true(faults.error_count > 0 && faults.items[0].message[0]);
        }
        dip_error_list_free(&faults);
    }
    remove("bad.ini");
    // At least a few of the mutations must be accepted, and at least a few refused. Otherwise, only
    // one of the two cases is tested.
    assert_in_range(accepted, RUNS / 20, RUNS - RUNS / 20);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_good_ini_is_accepted),
        cmocka_unit_test(bad_inis_are_refused),
        cmocka_unit_test(bad_bytes_are_refused),
        cmocka_unit_test(over_long_lines_are_refused),
        cmocka_unit_test(files_that_cannot_be_read_are_refused),
        cmocka_unit_test(too_many_models_are_refused),
        cmocka_unit_test(all_faults_are_reported_in_one_run),
        cmocka_unit_test(at_most_a_hundred_faults_are_reported),
        cmocka_unit_test(mutations_never_crash),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
