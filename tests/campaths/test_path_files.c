// Tests both file formats of camera paths, what converting between them keeps, and the errors of
// files.
#include "tests/campaths/paths.h"

#include <locale.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <sys/resource.h>
#include <unistd.h>

static void read_file(const char *file, unsigned char *bytes, size_t room, size_t *size_bytes) {
    FILE *stream = fopen(file, "rb");
    assert_non_null(stream);
    *size_bytes = fread(bytes, 1, room, stream);
    assert_true(*size_bytes < room);
    fclose(stream);
}

// A binary path, written by hand from the table in campath.h: one key at (1, -2, 0.5), looking
// along -Z.
static const unsigned char one_key_bth[80] = {
    0x89, 'D',  'I',  'P',  'B', 'T', 'H',  0x0A,                               // magic
    1,    0,    0,    0,                                                        // version
    1,    0,    0,    0,                                                        // keys
    0x00, 0xCA, 0x9A, 0x3B, 0,   0,   0,    0,                                  // 1000000000 ns
    0,    0,    0,    0,    0,   0,   0xF0, 0x3F,                               // 1
    0,    0,    0,    0,    0,   0,   0x00, 0xC0,                               // -2
    0,    0,    0,    0,    0,   0,   0xE0, 0x3F,                               // 0.5
    0,    0,    0,    0,    0,   0,   0,    0,    0, 0, 0, 0, 0, 0, 0,    0,    // qx qy
    0,    0,    0,    0,    0,   0,   0,    0,    0, 0, 0, 0, 0, 0, 0xF0, 0x3F, // qz qw
};

static void the_binary_layout_is_as_documented(void **context) {
    (void)context;
    DipCamPath *path;
    assert_true(dip_campath_parse(one_key_bth, sizeof one_key_bth, "one.bth", &path, NULL));
    const DipCamKey key = dip_campath_key(path, 0);
    assert_true(key.position_world[0] == 1.0 && key.position_world[1] == -2.0);
    assert_true(key.position_world[2] == 0.5 && key.orientation[3] == 1.0);
    assert_true(dip_campath_info(path).period_ns == SECOND);
    assert_true(dip_campath_save_bth(path, "one_key.bth", NULL));
    unsigned char bytes[200];
    size_t size_bytes;
    read_file("one_key.bth", bytes, sizeof bytes, &size_bytes);
    assert_int_equal(size_bytes, sizeof one_key_bth);
    assert_memory_equal(bytes, one_key_bth, sizeof one_key_bth);
    remove("one_key.bth");
    dip_campath_destroy(&path);
}

static void the_text_format_is_as_documented(void **context) {
    (void)context;
    DipCamPath *path = parse("\xef\xbb\xbf# made by hand\r\n\r\n\tdiptych-path  1 # header\r\n"
                             "period 2.5e-1# seconds\r\n 1 -2.0 +.5e0 0 0 0 3 \r\n");
    const DipCamKey key = dip_campath_key(path, 0);
    assert_true(key.position_world[0] == 1.0 && key.position_world[1] == -2.0);
    assert_true(key.position_world[2] == 0.5 && key.orientation[3] == 1.0);
    assert_true(dip_campath_info(path).period_ns == SECOND / 4);
    assert_true(dip_campath_save_pth(path, "hand.pth", NULL));
    unsigned char bytes[200];
    size_t size_bytes;
    read_file("hand.pth", bytes, sizeof bytes, &size_bytes);
    bytes[size_bytes] = '\0';
    assert_string_equal((char *)bytes, "diptych-path 1\n# seconds from key to key\nperiod 0.25\n"
                                       "# x y z qx qy qz qw\n1 -2 0.5 0 0 0 1\n");
    remove("hand.pth");
    dip_campath_destroy(&path);
}

// Whole seconds have no decimals, and nine decimals keep a nanosecond.
static void a_period_is_written_with_the_decimals_that_it_needs(void **context) {
    (void)context;
    static const char *const periods[] = {"1", "10", "3600", "1.5", "0.000001", "10.000000009"};
    for (size_t i = 0; i < sizeof periods / sizeof *periods; i++) {
        char text[100], expected[100];
        unsigned char bytes[200];
        size_t size_bytes;
        snprintf(text, sizeof text, "diptych-path 1\nperiod %s\n0 0 0 0 0 0 1\n", periods[i]);
        snprintf(expected, sizeof expected, "\nperiod %s\n", periods[i]);
        DipCamPath *path = parse(text);
        assert_true(dip_campath_save_pth(path, "period.pth", NULL));
        read_file("period.pth", bytes, sizeof bytes - 1, &size_bytes);
        bytes[size_bytes] = '\0';
        assert_non_null(strstr((char *)bytes, expected));
        remove("period.pth");
        dip_campath_destroy(&path);
    }
}

static uint64_t state = 7;

static uint64_t next_random(void) {
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return state * UINT64_C(2685821657736338717);
}

static double uniform(void) {
    return (double)(next_random() >> 11) * 0x1p-53;
}

static void check_same_keys(const DipCamPath *a, const DipCamPath *b) {
    const DipCamPathInfo info = dip_campath_info(a);
    assert_int_equal(info.key_count, dip_campath_info(b).key_count);
    assert_true(info.period_ns == dip_campath_info(b).period_ns);
    for (size_t k = 0; k < info.key_count; k++) {
        const DipCamKey key_a = dip_campath_key(a, k);
        const DipCamKey key_b = dip_campath_key(b, k);
        assert_memory_equal(&key_a, &key_b, sizeof key_a);
    }
}

// Loads random quaternions of any length and sign, then converts them to .pth and .bth and back.
// After the first load, no bit may change.
static void converting_between_the_formats_keeps_every_bit(void **context) {
    (void)context;
    enum { KEYS = 2000 };
    static DipCamKey keys[KEYS];
    for (int k = 0; k < KEYS; k++) {
        for (int i = 0; i < 3; i++) {
            keys[k].position_world[i] = (uniform() - 0.5) * exp2(60.0 * uniform() - 30.0);
        }
        for (int i = 0; i < 4; i++) {
            keys[k].orientation[i] = (uniform() - 0.5) * exp2(4.0 * uniform());
        }
    }
    DipCamPath *made;
    DipCamPath *text;
    DipCamPath *binary;
    DipCamPath *again;
    assert_true(dip_campath_create(keys, KEYS, 33333333, &made, NULL));
    assert_true(dip_campath_save_pth(made, "made.pth", NULL));
    assert_true(dip_campath_load("made.pth", &text, NULL));
    check_same_keys(made, text);
    assert_true(dip_campath_save_bth(text, "first.bth", NULL));
    assert_true(dip_campath_load("first.bth", &binary, NULL));
    check_same_keys(text, binary);
    assert_true(dip_campath_save_pth(binary, "second.pth", NULL));
    assert_true(dip_campath_load("second.pth", &again, NULL));
    check_same_keys(text, again);
    assert_true(dip_campath_save_bth(again, "second.bth", NULL));
    static unsigned char first[200000];
    static unsigned char second[200000];
    size_t first_bytes;
    size_t second_bytes;
    read_file("first.bth", first, sizeof first, &first_bytes);
    read_file("second.bth", second, sizeof second, &second_bytes);
    assert_int_equal(first_bytes, 24 + KEYS * 56);
    assert_int_equal(first_bytes, second_bytes);
    assert_memory_equal(first, second, first_bytes);
    DipCamPath **all[] = {&made, &text, &binary, &again};
    static const char *const files[] = {"made.pth", "first.bth", "second.pth", "second.bth"};
    for (int i = 0; i < 4; i++) {
        dip_campath_destroy(all[i]);
        remove(files[i]);
    }
}

static void loading_a_period_keeps_every_nanosecond(void **context) {
    (void)context;
    for (int i = 0; i < 20000; i++) {
        const int64_t span_ns = i & 1 ? DIP_CAMPATH_MAX_PERIOD_NS : INT64_C(1000000000);
        const int64_t period_ns =
            DIP_CAMPATH_MIN_PERIOD_NS + (int64_t)(uniform() * (double)(span_ns - 1000));
        char text[100];
        snprintf(text, sizeof text, "diptych-path 1\nperiod %lld.%09lld\n0 0 0 0 0 0 1\n",
                 (long long)(period_ns / SECOND), (long long)(period_ns % SECOND));
        DipCamPath *path = parse(text);
        assert_true(dip_campath_info(path).period_ns == period_ns);
        dip_campath_destroy(&path);
    }
}

static void a_comma_locale_changes_nothing(void **context) {
    (void)context;
    if (!setlocale(LC_ALL, "de_DE.UTF-8") && !setlocale(LC_ALL, "fr_FR.UTF-8")) {
        print_message("no locale with a decimal comma here: checked in C only\n");
    }
    DipCamPath *path = parse("diptych-path 1\nperiod 0.5\n1.5 2.25 -0.125 0 0 0 1\n");
    assert_true(dip_campath_key(path, 0).position_world[1] == 2.25);
    assert_true(dip_campath_save_pth(path, "locale.pth", NULL));
    unsigned char bytes[200];
    size_t size_bytes;
    read_file("locale.pth", bytes, sizeof bytes, &size_bytes);
    bytes[size_bytes] = '\0';
    assert_non_null(strstr((char *)bytes, "\n1.5 2.25 -0.125 0 0 0 1\n"));
    setlocale(LC_ALL, "C");
    remove("locale.pth");
    dip_campath_destroy(&path);
}

static void errors_name_files_that_cannot_be_read_or_written(void **context) {
    (void)context;
    DipCamPath *path = parse("diptych-path 1\nperiod 1\n0 0 0 0 0 0 1\n");
    DipCamPath *none = path;
    DipError err = {0};
    assert_false(dip_campath_load("no/such.pth", &none, &err));
    assert_null(none);
    assert_int_equal(err.code, DIP_ERROR_MISSING);
    assert_string_equal(err.file, "no/such.pth");
    assert_false(dip_campath_load(".", &none, &err)); // a folder
    assert_int_equal(err.code, DIP_ERROR_IO);
    assert_false(dip_campath_load("/dev/zero", &none, &err)); // endless
    assert_int_equal(err.code, DIP_ERROR_IO);
    assert_false(dip_campath_save_bth(path, "no/such.bth", &err));
    assert_int_equal(err.code, DIP_ERROR_IO);
    assert_string_equal(err.file, "no/such.bth");
    // If the disk is full after ten bytes, saving leaves no file behind.
    const struct rlimit ten = {10, RLIM_INFINITY};
    const struct rlimit unlimited = {RLIM_INFINITY, RLIM_INFINITY};
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &ten), 0);
    const bool saved = dip_campath_save_pth(path, "full.pth", &err);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &unlimited), 0);
    assert_false(saved);
    assert_int_equal(err.code, DIP_ERROR_IO);
    assert_string_equal(err.file, "full.pth");
    assert_int_equal(err.line, 0); // No line of the file is at fault.
    assert_int_equal(access("full.pth", F_OK), -1);
    FILE *stream = fopen("huge.pth", "wb"); // sparse: one byte over the limit
    assert_int_equal(fseek(stream, (long)DIP_CAMPATH_MAX_FILE_BYTES, SEEK_SET), 0);
    fputc('x', stream);
    fclose(stream);
    assert_false(dip_campath_load("huge.pth", &none, &err));
    remove("huge.pth");
    assert_int_equal(err.code, DIP_ERROR_OVERSIZED);
    dip_campath_destroy(&path);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_binary_layout_is_as_documented),
        cmocka_unit_test(the_text_format_is_as_documented),
        cmocka_unit_test(a_period_is_written_with_the_decimals_that_it_needs),
        cmocka_unit_test(converting_between_the_formats_keeps_every_bit),
        cmocka_unit_test(loading_a_period_keeps_every_nanosecond),
        cmocka_unit_test(a_comma_locale_changes_nothing),
        cmocka_unit_test(errors_name_files_that_cannot_be_read_or_written),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
