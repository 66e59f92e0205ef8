// Tests camera path files that must be refused. The error must name the line or byte and the
// reason. Mutated copies of good files may be refused but must not crash the program.
#include "campaths/campath.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct BadText {
    const char *promise;
    const char *text;
    DipErrorCode code;
    int line;
    const char *key;
    const char *said; // text that the message contains
} BadText;

#define HEAD "diptych-path 1\nperiod 1\n"
#define KEY  "0 0 0 0 0 0 1\n"

static const BadText bad_texts[] = {
    {"comments alone are no path", "# nothing\n\n# here\n", DIP_ERROR_MISSING, 3, "diptych-path",
     "diptych-path 1"},
    {"another text file", "hello world\n", DIP_ERROR_FORMAT, 1, "diptych-path",
     "the file begins with 'hello', so it is not a camera path, accepted .pth text"},
    {"keys without a header", "# path\n" KEY, DIP_ERROR_FORMAT, 2, "diptych-path", "'0'"},
    {"a later version", "diptych-path 2\nperiod 1\n" KEY, DIP_ERROR_FORMAT, 1, "diptych-path",
     "the version is '2', accepted 1"},
    {"no version", "diptych-path\nperiod 1\n" KEY, DIP_ERROR_FORMAT, 1, "diptych-path",
     "accepted 1"},
    {"two versions", "diptych-path 1 2\n", DIP_ERROR_FORMAT, 1, "diptych-path",
     "the version is '2'"},
    {"no period", "diptych-path 1\n", DIP_ERROR_MISSING, 1, "period", "seconds"},
    {"keys before the period", "diptych-path 1\n" KEY "period 1\n", DIP_ERROR_MISSING, 2, "period",
     "before the keys"},
    {"a second period", HEAD "\nperiod 2\n" KEY, DIP_ERROR_CONFLICT, 4, "period", "accepted one"},
    {"period without a value", "diptych-path 1\nperiod\n", DIP_ERROR_FORMAT, 2, "period",
     "exactly one value"},
    {"period with a unit", "diptych-path 1\nperiod 1 s\n", DIP_ERROR_FORMAT, 2, "period",
     "exactly one value"},
    {"period of no number", "diptych-path 1\nperiod 1s\n", DIP_ERROR_TYPE, 2, "period", "'1s'"},
    {"period zero", "diptych-path 1\nperiod 0\n", DIP_ERROR_RANGE, 2, "period", "1e-06..3600"},
    {"period negative", "diptych-path 1\nperiod -1\n", DIP_ERROR_RANGE, 2, "period", "-1 s"},
    {"period huge", "diptych-path 1\nperiod 1e300\n", DIP_ERROR_RANGE, 2, "period", "1e+300 s"},
    {"period just too long", "diptych-path 1\nperiod 3600.000001\n", DIP_ERROR_RANGE, 2, "period",
     "3600"},
    {"period not finite", "diptych-path 1\nperiod inf\n", DIP_ERROR_TYPE, 2, "period", "'inf'"},
    {"no keys", HEAD "# none\n", DIP_ERROR_MISSING, 3, "keys", "x y z qx qy qz qw"},
    {"a key of six values", HEAD KEY "0 0 0 0 0 1\n", DIP_ERROR_FORMAT, 4, "keys", "6 values"},
    {"a key of eight values", HEAD KEY "0 0 0 0 0 0 1 50\n", DIP_ERROR_FORMAT, 4, "keys",
     "the line has more than 7 values, accepted 7"},
    {"a key cut by the file's end", HEAD KEY "0 0 0 0", DIP_ERROR_FORMAT, 4, "keys", "4 values"},
    {"a word among the numbers", HEAD "0 0 x 0 0 0 1\n", DIP_ERROR_TYPE, 3, "z",
     "'x' is not a number"},
    {"nan", HEAD "nan 0 0 0 0 0 1\n", DIP_ERROR_TYPE, 3, "x", "'nan'"},
    {"infinity", HEAD "0 -Infinity 0 0 0 0 1\n", DIP_ERROR_TYPE, 3, "y", "'-Infinity'"},
    {"a number beyond double", HEAD "0 0 1e999 0 0 0 1\n", DIP_ERROR_TYPE, 3, "z", "'1e999'"},
    {"a hexadecimal number", HEAD "0x10 0 0 0 0 0 1\n", DIP_ERROR_TYPE, 3, "x", "'0x10'"},
    {"a decimal comma", HEAD "0,5 0 0 0 0 0 1\n", DIP_ERROR_TYPE, 3, "x", "'0,5'"},
    {"garbage after a number", HEAD "0 0 0 0.5f 0 0 1\n", DIP_ERROR_TYPE, 3, "qx", "'0.5f'"},
    {"a sign without digits", HEAD "0 0 0 0 - 0 1\n", DIP_ERROR_TYPE, 3, "qy", "'-'"},
    {"a decimal point without digits", HEAD "0 0 0 0 0 . 1\n", DIP_ERROR_TYPE, 3, "qz", "'.'"},
    {"an exponent without digits", HEAD "0 0 0 0 0 0 1e+\n", DIP_ERROR_TYPE, 3, "qw", "'1e+'"},
    {"a number of 64 digits",
     HEAD "0 0000000000000000000000000000000000000000000000000000000000000000 0 0 0 0 1\n",
     DIP_ERROR_TYPE, 3, "y", "is not a number"},
    {"a position out of the world", HEAD "0 0 -1.1e9 0 0 0 1\n", DIP_ERROR_RANGE, 3, "z",
     "-1e+09..1e+09"},
    {"a zero quaternion", HEAD KEY "# still\n0 0 0 0 0 0 0\n", DIP_ERROR_RANGE, 5, "qx qy qz qw",
     "has length 0, accepted"},
    {"a vanishing quaternion", HEAD "0 0 0 0 0 0 9e-7\n", DIP_ERROR_RANGE, 3, "qx qy qz qw",
     "length 9e-07"},
    {"a quaternion beyond all bounds", HEAD "0 0 0 0 0 0 1e200\n", DIP_ERROR_RANGE, 3, "qw",
     "1e+200"},
    {"escape codes are not echoed", HEAD "\x1b[2J 0 0 0 0 0 1\n", DIP_ERROR_TYPE, 3, "x", "'?[2J'"},
    {"carriage returns without line feeds", "diptych-path 1\rperiod 1\r" KEY, DIP_ERROR_FORMAT, 1,
     "diptych-path", "version"},
    {"another encoding",
     "\xff\xfe"
     "d",
     DIP_ERROR_FORMAT, 1, "diptych-path", "'??d'"},
};

static void check_error(const char *promise, const DipError *err, DipErrorCode code, int line,
                        const char *key, const char *said) {
    char text[800];
    dip_error_format(err, text, sizeof text);
    if (err->code != code || err->line != line || strcmp(err->key, key) != 0 ||
        !strstr(err->message, said) || !strstr(err->message, "accepted")) {
        fail_msg("%s: found %s %s", promise, dip_error_code_name(err->code), text);
    }
    assert_null(strchr(text, '\n'));
}

static void check_refused(const char *promise, const void *bytes, size_t size_bytes,
                          DipErrorCode code, int line, const char *key, const char *said) {
    // The copy has exactly the size of the file, so the address sanitizer finds a read past the
    // end.
    void *exact = malloc(size_bytes ? size_bytes : 1);
    memcpy(exact, bytes, size_bytes);
    DipCamPath *path = (DipCamPath *)exact;
    DipError err = {0};
    if (dip_campath_parse(exact, size_bytes, "bad.path", &path, &err)) {
        fail_msg("%s: accepted", promise);
    }
    assert_null(path);
    assert_string_equal(err.file, "bad.path");
    check_error(promise, &err, code, line, key, said);
    free(exact);
}

static void bad_texts_are_refused(void **context) {
    (void)context;
    for (size_t i = 0; i < sizeof bad_texts / sizeof *bad_texts; i++) {
        const BadText *bad = &bad_texts[i];
        check_refused(bad->promise, bad->text, strlen(bad->text), bad->code, bad->line, bad->key,
                      bad->said);
    }
}

static void an_empty_file_is_refused(void **context) {
    (void)context;
    check_refused("an empty file", "", 0, DIP_ERROR_TRUNCATED, 0, "", "is empty");
}

static void a_nul_byte_is_refused(void **context) {
    (void)context;
    static const char text[] = HEAD "0 0 0\0 0 0 0 1\n";
    check_refused("a NUL byte", text, sizeof text - 1, DIP_ERROR_FORMAT, 3, "",
                  "contains a NUL byte");
}

static void an_over_long_line_is_refused(void **context) {
    (void)context;
    char text[DIP_CAMPATH_MAX_LINE + 100];
    const int head = snprintf(text, sizeof text, HEAD);
    memset(text + head, '#', DIP_CAMPATH_MAX_LINE + 1);
    check_refused("an over-long line", text, (size_t)head + DIP_CAMPATH_MAX_LINE + 1,
                  DIP_ERROR_OVERSIZED, 3, "", "the line has 1001 bytes, accepted up to 1000");
    // One byte less is accepted, so what is missing then are the keys.
    check_refused("a line of the greatest length", text, (size_t)head + DIP_CAMPATH_MAX_LINE,
                  DIP_ERROR_MISSING, 3, "keys", "x y z qx qy qz qw");
}

static void check_not_a_path(const char *name, const char *bytes, size_t size_bytes,
                             const char *found, bool hints_at_models) {
    DipCamPath *path;
    DipError err = {0};
    assert_false(dip_campath_parse(bytes, size_bytes, name, &path, &err));
    check_error(name, &err, DIP_ERROR_FORMAT, 1, "diptych-path", found);
    assert_non_null(strstr(err.message, "it is not a camera path"));
    assert_int_equal(strstr(err.message, "load a model with --model") != NULL, hints_at_models);
}

static void other_files_are_said_to_be_no_camera_path(void **context) {
    (void)context;
    char binary[3000];
    memset(binary, 0xAA, sizeof binary);
    check_not_a_path("my.glb", binary, sizeof binary, "has a line of over 1000 bytes", true);
    check_not_a_path("my.pth", binary, sizeof binary, "has a line of over 1000 bytes", false);
    static const char glb[] = "glTF\2\0\0\0";
    check_not_a_path("My.GLB", glb, sizeof glb - 1, "contains NUL bytes", true);
    static const char obj[] = "v 0 0 0\n";
    check_not_a_path("my.obj", obj, sizeof obj - 1, "begins with 'v'", true);
    check_not_a_path("my", obj, sizeof obj - 1, "begins with 'v'", false);
}

static void too_many_keys_are_refused(void **context) {
    (void)context;
    const size_t head = strlen(HEAD);
    const size_t each = strlen(KEY);
    const size_t size_bytes = head + each * (DIP_CAMPATH_MAX_KEYS + 1);
    char *text = malloc(size_bytes);
    memcpy(text, HEAD, head);
    for (size_t k = 0; k <= DIP_CAMPATH_MAX_KEYS; k++) {
        memcpy(text + head + k * each, KEY, each);
    }
    check_refused("too many keys", text, size_bytes, DIP_ERROR_OVERSIZED, DIP_CAMPATH_MAX_KEYS + 3,
                  "keys", "1000000");
    DipCamPath *path;
    assert_true(dip_campath_parse(text, size_bytes - each, "most", &path, NULL));
    assert_int_equal(dip_campath_info(path).key_count, DIP_CAMPATH_MAX_KEYS);
    dip_campath_destroy(&path);
    DipCamKey *keys = calloc(DIP_CAMPATH_MAX_KEYS + 1, sizeof *keys);
    for (size_t k = 0; k <= DIP_CAMPATH_MAX_KEYS; k++) {
        keys[k].orientation[3] = 1.0;
    }
    DipError err = {0};
    assert_true(dip_campath_create(keys, DIP_CAMPATH_MAX_KEYS, 1000000, &path, NULL));
    dip_campath_destroy(&path);
    assert_false(dip_campath_create(keys, DIP_CAMPATH_MAX_KEYS + 1, 1000000, &path, &err));
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    free(keys);
    free(text);
}

// ---- Binary: a good file of two keys with some bytes changed ----

enum { GOOD_BYTES = 24 + 2 * 56 };

typedef struct BadBinary {
    const char *promise;
    size_t size_bytes; // size of the file; less than GOOD_BYTES cuts the file, more adds zeros
    size_t offset;     // first byte that is changed
    size_t count;
    unsigned char bytes[8];
    DipErrorCode code;
    const char *key;
    const char *said;
} BadBinary;

static const BadBinary bad_binaries[] = {
    {"a wrong magic", GOOD_BYTES, 4, 1, {'X'}, DIP_ERROR_FORMAT, "magic", "at byte 0"},
    {"line ends converted on the way",
     GOOD_BYTES,
     7,
     1,
     {'\r'},
     DIP_ERROR_FORMAT,
     "magic",
     "byte 0"},
    {"one byte", 1, 0, 0, {0}, DIP_ERROR_TRUNCATED, "header", "at byte 1"},
    {"the magic alone", 8, 0, 0, {0}, DIP_ERROR_TRUNCATED, "header", "at byte 8"},
    {"half a header", 23, 0, 0, {0}, DIP_ERROR_TRUNCATED, "header", "at byte 23"},
    {"version 0", GOOD_BYTES, 8, 1, {0}, DIP_ERROR_FORMAT, "version", "at byte 8: version 0"},
    {"version 2", GOOD_BYTES, 8, 1, {2}, DIP_ERROR_FORMAT, "version", "version 2, accepted 1"},
    {"version big-endian", GOOD_BYTES, 8, 4, {0, 0, 0, 1}, DIP_ERROR_FORMAT, "version", "16777216"},
    {"no keys", 24, 12, 4, {0}, DIP_ERROR_RANGE, "keys", "at byte 12: 0 keys"},
    {"more keys than are accepted",
     GOOD_BYTES,
     12,
     4,
     {0x41, 0x42, 0x0F, 0},
     DIP_ERROR_RANGE,
     "keys",
     "1000001 keys, accepted 1..1000000"},
    {"a key count that would wrap",
     GOOD_BYTES,
     12,
     4,
     {0xFF, 0xFF, 0xFF, 0xFF},
     DIP_ERROR_RANGE,
     "keys",
     "4294967295 keys"},
    {"period zero", GOOD_BYTES, 16, 8, {0}, DIP_ERROR_RANGE, "period", "at byte 16: 0 ns"},
    {"period negative",
     GOOD_BYTES,
     16,
     8,
     {255, 255, 255, 255, 255, 255, 255, 255},
     DIP_ERROR_RANGE,
     "period",
     "-1 ns"},
    {"period huge",
     GOOD_BYTES,
     16,
     8,
     {0, 0, 0, 0, 0, 0, 0, 0x7F},
     DIP_ERROR_RANGE,
     "period",
     "accepted 1000..3600000000000"},
    {"a key too few",
     24 + 56,
     0,
     0,
     {0},
     DIP_ERROR_TRUNCATED,
     "keys",
     "at byte 80: the file ends too early"},
    {"half a key", 24 + 56 + 20, 0, 0, {0}, DIP_ERROR_TRUNCATED, "keys", "at byte 100"},
    {"the last byte missing", GOOD_BYTES - 1, 0, 0, {0}, DIP_ERROR_TRUNCATED, "keys", "byte 135"},
    {"a byte after the keys",
     GOOD_BYTES + 1,
     0,
     0,
     {0},
     DIP_ERROR_OVERSIZED,
     "keys",
     "at byte 136: the file goes on"},
    {"NaN in a position",
     GOOD_BYTES,
     24 + 8,
     8,
     {0, 0, 0, 0, 0, 0, 0xF8, 0x7F},
     DIP_ERROR_RANGE,
     "y",
     "at byte 32: nan"},
    {"infinity in a position",
     GOOD_BYTES,
     80,
     8,
     {0, 0, 0, 0, 0, 0, 0xF0, 0xFF},
     DIP_ERROR_RANGE,
     "x",
     "at byte 80: -inf"},
    {"a position out of the world",
     GOOD_BYTES,
     96,
     8,
     {0, 0, 0, 0, 0, 0, 0xF0, 0x42},
     DIP_ERROR_RANGE,
     "z",
     "at byte 96"},
    {"NaN in a quaternion",
     GOOD_BYTES,
     24 + 48,
     8,
     {1, 0, 0, 0, 0, 0, 0xF0, 0x7F},
     DIP_ERROR_RANGE,
     "qw",
     "at byte 72: nan"},
    {"a zero quaternion",
     GOOD_BYTES,
     24 + 48,
     8,
     {0},
     DIP_ERROR_RANGE,
     "qx qy qz qw",
     "at byte 48: the quaternion is not of unit length"},
    {"a quaternion not normalised",
     GOOD_BYTES,
     80 + 48,
     8,
     {0, 0, 0, 0, 0, 0, 0xE0, 0x3F},
     DIP_ERROR_RANGE,
     "qx qy qz qw",
     "at byte 104"},
    {"a quaternion on the other hemisphere",
     GOOD_BYTES,
     80 + 48,
     8,
     {0, 0, 0, 0, 0, 0, 0xF0, 0xBF},
     DIP_ERROR_RANGE,
     "qx qy qz qw",
     "at byte 104: the quaternion is on the other"},
};

static void make_good_binary(unsigned char *bytes) {
    static const char text[] = HEAD KEY "1 2 3 0 0 0 1\n";
    DipCamPath *path;
    assert_true(dip_campath_parse(text, strlen(text), "good", &path, NULL));
    assert_true(dip_campath_save_bth(path, "good.bth", NULL));
    dip_campath_destroy(&path);
    FILE *stream = fopen("good.bth", "rb");
    assert_non_null(stream);
    assert_int_equal(fread(bytes, 1, GOOD_BYTES + 1, stream), GOOD_BYTES);
    fclose(stream);
    remove("good.bth");
}

static void bad_binaries_are_refused(void **context) {
    (void)context;
    for (size_t i = 0; i < sizeof bad_binaries / sizeof *bad_binaries; i++) {
        const BadBinary *bad = &bad_binaries[i];
        unsigned char bytes[GOOD_BYTES + 1] = {0};
        make_good_binary(bytes);
        memcpy(bytes + bad->offset, bad->bytes, bad->count);
        check_refused(bad->promise, bytes, bad->size_bytes, bad->code, 0, bad->key, bad->said);
    }
}

// ---- Mutations ----

static uint64_t state = 99;

static size_t below(size_t count) {
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return (size_t)((state * UINT64_C(2685821657736338717)) >> 33) % count;
}

// Changes, cuts or doubles a few bytes. Text files get characters that have a meaning in the
// format.
static size_t mutate(unsigned char *bytes, size_t size_bytes, size_t room) {
    static const char meaningful[] = "0123456789.-+eE \t\r\n#xpd\0\x89\xff";
    for (size_t n = 1 + below(4); n > 0; n--) {
        const size_t at = below(size_bytes);
        switch (below(4)) {
        case 0:
            bytes[at] = (unsigned char)below(256);
            break;
        case 1:
            bytes[at] = (unsigned char)meaningful[below(sizeof meaningful)];
            break;
        case 2:
            size_bytes = at + 1;
            break;
        default:
            if (size_bytes + (size_bytes - at) <= room) {
                memmove(bytes + size_bytes, bytes + at, size_bytes - at);
                size_bytes += size_bytes - at;
            }
        }
    }
    return size_bytes;
}

// An accepted path must have finite poses; a refused path must have a message.
static int parse_mutation(const unsigned char *bytes, size_t size_bytes) {
    unsigned char *exact = malloc(size_bytes);
    memcpy(exact, bytes, size_bytes);
    DipCamPath *path;
    DipError err = {0};
    const bool accepted = dip_campath_parse(exact, size_bytes, "fuzz", &path, &err);
    if (accepted) {
        DipPose pose;
        dip_campath_sample(path, (int64_t)below((size_t)1 << 31) * 1000003, &pose);
        for (int i = 0; i < 4; i++) {
            assert_true(isfinite(pose.position_world[i % 3]) && isfinite(pose.orientation[i]));
        }
    } else {
        assert_true(err.code != DIP_ERROR_NONE && err.message[0] && !path);
    }
    dip_campath_destroy(&path);
    free(exact);
    return accepted;
}

static void mutations_never_crash(void **context) {
    (void)context;
    enum { RUNS = 5000, ROOM = 2048 };
    static const char text[] = "# a path\n" HEAD "1.5 -2 3e0 0.1 0.2 0.3 0.9\n"
                               "0 1 2 -0.5 0.5 0.5 0.5\n7 8 9 0 1 0 0 # last\n";
    int accepted = 0;
    for (int run = 0; run < 2 * RUNS; run++) {
        unsigned char bytes[ROOM];
        size_t size_bytes = sizeof text - 1;
        memcpy(bytes, text, size_bytes);
        if (run >= RUNS) {
            static unsigned char good[GOOD_BYTES + 1];
            if (run == RUNS) {
                make_good_binary(good);
            }
            size_bytes = GOOD_BYTES;
            memcpy(bytes, good, size_bytes);
        }
        accepted += parse_mutation(bytes, mutate(bytes, size_bytes, ROOM));
    }
    // At least a few of the mutations must be accepted, and at least a few refused. Otherwise, only
    // one of the two cases is tested.
    assert_in_range(accepted, RUNS / 20, 2 * RUNS - RUNS / 20);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bad_texts_are_refused),
        cmocka_unit_test(an_empty_file_is_refused),
        cmocka_unit_test(a_nul_byte_is_refused),
        cmocka_unit_test(an_over_long_line_is_refused),
        cmocka_unit_test(other_files_are_said_to_be_no_camera_path),
        cmocka_unit_test(too_many_keys_are_refused),
        cmocka_unit_test(bad_binaries_are_refused),
        cmocka_unit_test(mutations_never_crash),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
