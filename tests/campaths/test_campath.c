// Tests camera paths. Compares sampled poses with closed forms. Also tests both file formats, the
// orbit around a model, and the track, which switches between the paths of the categories.
#include "campaths/campath.h"
#include "campaths/camtrack.h"
#include "renderer/base/hash.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <locale.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

static const double PI = 3.14159265358979323846;
static const int64_t SECOND = INT64_C(1000000000);

static DipCamPath *parse(const char *text) {
    DipCamPath *path = NULL;
    DipError err = {0};
    if (!dip_campath_parse(text, strlen(text), "test.pth", &path, &err)) {
        fail_msg("%s:%d: [%s] %s", err.file, err.line, err.key, err.message);
    }
    return path;
}

static DipPose sample(const DipCamPath *path, int64_t time_ns) {
    DipPose pose = {.fov_y_deg = 33.0};
    dip_campath_sample(path, time_ns, &pose);
    return pose;
}

// Compares rotations. The quaternions q and -q count as equal because they are the same rotation.
static void check_orientation(const double q[4], double x, double y, double z, double w,
                              double bound) {
    const double sign = q[0] * x + q[1] * y + q[2] * z + q[3] * w < 0.0 ? -1.0 : 1.0;
    const double expected[4] = {x, y, z, w};
    for (int i = 0; i < 4; i++) {
        if (!(fabs(q[i] - sign * expected[i]) <= bound)) {
            fail_msg("component %d: found %.17g, expected %.17g", i, q[i], sign * expected[i]);
        }
    }
}

static void check_turn_about_y(const DipPose *pose, double angle_deg, double bound) {
    const double half = angle_deg * PI / 360.0;
    check_orientation(pose->orientation, 0.0, sin(half), 0.0, cos(half), bound);
}

static void read_file(const char *file, unsigned char *bytes, size_t room, size_t *size_bytes) {
    FILE *stream = fopen(file, "rb");
    assert_non_null(stream);
    *size_bytes = fread(bytes, 1, room, stream);
    assert_true(*size_bytes < room);
    fclose(stream);
}

// ---- Sampling ----

static void positions_move_linearly_and_the_loop_closes(void **context) {
    (void)context;
    DipCamPath *path = parse("diptych-path 1\nperiod 2\n"
                             "0 0 0 0 0 0 1\n10 4 -2 0 0 0 1\n10 8 0 0 0 0 1\n");
    const struct {
        int64_t time_ns;
        double position[3];
    } cases[] = {
        {0, {0, 0, 0}},
        {SECOND, {5, 2, -1}},
        {2 * SECOND, {10, 4, -2}},
        {3 * SECOND, {10, 6, -1}},
        {4 * SECOND, {10, 8, 0}},
        {5 * SECOND, {5, 4, 0}}, // the closing step leads back to the first key
        {6 * SECOND, {0, 0, 0}},
        {-SECOND, {5, 4, 0}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const DipPose pose = sample(path, cases[i].time_ns);
        for (int a = 0; a < 3; a++) {
            assert_true(pose.position_world[a] == cases[i].position[a]);
        }
        assert_true(pose.fov_y_deg == 33.0); // a path does not change the field of view
    }
    dip_campath_destroy(&path);
    assert_null(path);
    dip_campath_destroy(&path);
    dip_campath_destroy(NULL);
}

// In a step between two keys that turns by `angle` about +Y, the camera has turned by u * angle
// after the fraction u of the step.
static void orientations_turn_at_constant_speed(void **context) {
    (void)context;
    static const double angles_deg[] = {1e-7, 1e-4, 1.1e-4, 1.2e-4, 0.0115, 0.5, 1.62, 30, 90, 179};
    for (size_t a = 0; a < sizeof angles_deg / sizeof *angles_deg; a++) {
        const double half = angles_deg[a] * PI / 360.0;
        const DipCamKey keys[2] = {{{0, 0, 0}, {0, 0, 0, 1}},
                                   {{0, 0, 0}, {0, sin(half), 0, cos(half)}}};
        DipCamPath *path;
        assert_true(dip_campath_create(keys, 2, SECOND, &path, NULL));
        for (int i = 0; i <= 100; i++) {
            const DipPose pose = sample(path, i * SECOND / 100);
            check_turn_about_y(&pose, angles_deg[a] * i / 100.0, 4e-16);
        }
        dip_campath_destroy(&path);
    }
}

static void the_sign_of_a_quaternion_does_not_matter(void **context) {
    (void)context;
    DipCamPath *path = parse("diptych-path 1\nperiod 1\n"
                             "0 0 0 0 0 0 1\n"
                             "0 0 0 0 -0.38268343236508977 0 -0.92387953251128674\n");
    const DipPose pose = sample(path, SECOND / 2);
    check_turn_about_y(&pose, 22.5, 1e-15); // The long way round would give 202.5.
    const DipCamKey key = dip_campath_key(path, 1);
    assert_true(key.orientation[3] > 0.0);
    dip_campath_destroy(&path);
}

// Four quarter turns end at the first orientation with the opposite sign. The closing step must
// still be a quarter turn.
static void the_closing_step_of_a_full_turn_is_short(void **context) {
    (void)context;
    DipCamKey keys[4];
    for (int k = 0; k < 4; k++) {
        const double half = k * PI / 4.0;
        keys[k] = (DipCamKey){{0, 0, 0}, {0, sin(half), 0, cos(half)}};
    }
    DipCamPath *path;
    assert_true(dip_campath_create(keys, 4, SECOND, &path, NULL));
    for (int i = 0; i < 80; i++) {
        const DipPose pose = sample(path, i * SECOND / 20);
        check_turn_about_y(&pose, 360.0 * i / 80.0, 4e-16);
    }
    assert_true(fabs(dip_campath_info(path).max_turn_deg_per_s - 90.0) < 1e-12);
    dip_campath_destroy(&path);
}

static void a_half_turn_is_interpolated(void **context) {
    (void)context;
    DipCamPath *path = parse("diptych-path 1\nperiod 1\n0 0 0 0 0 0 1\n0 0 0 0 1 0 0\n");
    const DipPose there = sample(path, SECOND / 3);
    const DipPose back = sample(path, SECOND + SECOND / 3);
    check_turn_about_y(&there, 60.0, 1e-8);
    check_turn_about_y(&back, 120.0, 1e-8);
    dip_campath_destroy(&path);
}

static void a_path_repeats_exactly_after_its_duration(void **context) {
    (void)context;
    DipCamPath *path = parse("diptych-path 1\nperiod 0.333333333\n"
                             "1 2 3 0.1 0.2 0.3 0.9\n4 -5 6 0.3 -0.2 0.1 0.8\n"
                             "-7 8 9 -0.5 0.5 0.5 -0.5\n0.1 0.2 0.3 0 1 0 0\n"
                             "5 5 5 0 0 1 0.01\n");
    const int64_t duration_ns = dip_campath_info(path).duration_ns;
    assert_true(duration_ns == INT64_C(1666666665));
    for (int64_t t = 0; t < duration_ns; t += 12345677) {
        const DipPose expected = sample(path, t);
        const int64_t loops[] = {1, -1, 600000000, -600000000}; // the last two go beyond 1e9 s
        for (int i = 0; i < 4; i++) {
            const DipPose pose = sample(path, t + loops[i] * duration_ns);
            assert_memory_equal(&pose, &expected, sizeof pose);
        }
        const double *q = expected.orientation;
        const double length = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
        assert_true(fabs(length - 1.0) < 1e-15);
    }
    sample(path, INT64_MIN);
    sample(path, INT64_MAX);
    dip_campath_destroy(&path);
}

static void a_path_of_one_key_is_a_still_camera(void **context) {
    (void)context;
    DipCamPath *path = parse("diptych-path 1\nperiod 1\n1 2 3 0 0 0 2\n");
    static const int64_t times_ns[] = {0, 1, 500000000, -7, INT64_MAX};
    for (int i = 0; i < 5; i++) {
        const DipPose pose = sample(path, times_ns[i]);
        assert_true(pose.position_world[0] == 1.0 && pose.position_world[2] == 3.0);
        check_orientation(pose.orientation, 0, 0, 0, 1, 0.0);
    }
    dip_campath_destroy(&path);
}

static void path_info_has_length_speed_and_bounding_box(void **context) {
    (void)context;
    DipCamPath *path = parse("diptych-path 1\nperiod 0.5\n"
                             "0 0 0 0 0 0 1\n3 4 0 0 0 0 1\n3 4 12 0 0 0 1\n");
    const DipCamPathInfo info = dip_campath_info(path);
    assert_int_equal(info.key_count, 3);
    assert_true(info.period_ns == SECOND / 2 && info.duration_ns == 3 * SECOND / 2);
    assert_true(info.length_m == 5.0 + 12.0 + 13.0);
    assert_true(info.max_speed_m_per_s == 26.0);
    assert_true(info.max_turn_deg_per_s == 0.0);
    assert_true(info.min_world[0] == 0.0 && info.max_world[1] == 4.0 && info.max_world[2] == 12.0);
    dip_campath_destroy(&path);
}

// ---- Files ----

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

// ---- Orbit ----

// Transforms v into camera space with the matrix of the inverse rotation, which is independent of
// the orbit's own formulas.
static void to_camera(const DipPose *pose, const double v_world[3], double v[3]) {
    const double x = pose->orientation[0];
    const double y = pose->orientation[1];
    const double z = pose->orientation[2];
    const double w = pose->orientation[3];
    const double columns[3][3] = {
        {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
        {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
        {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)},
    };
    for (int i = 0; i < 3; i++) {
        v[i] = 0.0;
        for (int a = 0; a < 3; a++) {
            v[i] += columns[i][a] * (v_world[a] - pose->position_world[a]);
        }
    }
}

// Projects the box's corners and returns the greatest |x| or |y| among them. The edges of the
// picture lie at 1.
static double reach_of_box(const DipCamOrbitDef *def, const DipPose *pose) {
    const double tan_y = tan(def->fov_y_deg * PI / 360.0);
    double reach = 0.0;
    for (int corner = 0; corner < 8; corner++) {
        double p[3];
        double v[3];
        for (int i = 0; i < 3; i++) {
            p[i] = corner >> i & 1 ? def->max_world[i] : def->min_world[i];
        }
        to_camera(pose, p, v);
        assert_true(v[2] < 0.0); // the corner is in front of the camera
        reach = fmax(reach, fabs(v[1]) / (-v[2] * tan_y));
        reach = fmax(reach, fabs(v[0]) / (-v[2] * tan_y * def->aspect));
    }
    return reach;
}

static void the_orbit_shows_the_whole_box(void **context) {
    (void)context;
    static const struct {
        double min[3], max[3], fov_y_deg, aspect;
    } cases[] = {
        {{-1, -1, -1}, {1, 1, 1}, 50, 4.0 / 3.0},    {{0, 0, 0}, {10, 0.1, 3}, 50, 4.0 / 3.0},
        {{5, -3, 2}, {5.1, 40, 2.1}, 30, 0.5},       {{-1e6, 0, 0}, {1e6, 1, 1}, 90, 2.0},
        {{1e-4, 1e-4, 0}, {2e-4, 3e-4, 0}, 50, 1.5}, {{-1, -1, -1}, {1, 1, 1}, 150, 0.2},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        DipCamOrbitDef def = dip_campath_default_orbit();
        memcpy(def.min_world, cases[c].min, sizeof def.min_world);
        memcpy(def.max_world, cases[c].max, sizeof def.max_world);
        def.fov_y_deg = cases[c].fov_y_deg;
        def.aspect = cases[c].aspect;
        DipCamPath *path;
        assert_true(dip_campath_orbit(&def, &path, NULL));
        assert_true(dip_campath_info(path).duration_ns == 20 * SECOND);
        double widest = 0.0;
        double middle[3];
        for (int i = 0; i < 3; i++) {
            middle[i] = 0.5 * (def.min_world[i] + def.max_world[i]);
        }
        for (int t = 0; t < 1000; t++) {
            const DipPose pose = sample(path, t * SECOND / 50);
            widest = fmax(widest, reach_of_box(&def, &pose));
            double v[3];
            to_camera(&pose, middle, v);
            // Between keys, the camera moves on a chord of the circle and is up to 0.05 % nearer.
            assert_true(fabs(v[0]) < 2e-4 * -v[2] && fabs(v[1]) < 2e-4 * -v[2]);
            assert_true(pose.position_world[1] > middle[1]);
        }
        // A long box must fit into the picture even when one of its ends is near the camera. In the
        // rest of the orbit, the border around the box is wider.
        if (!(widest < 1.0 && widest > 0.75)) {
            fail_msg("case %zu: the box reaches to %.3f of the picture", c, widest);
        }
        dip_campath_destroy(&path);
    }
}

// The greatest |x| or |y| of a circle of the silhouette, seen from a pose.
static double reach_of_circle(const DipCamOrbitDef *def, const DipPose *pose, double radius,
                              double y) {
    const double tan_y = tan(def->fov_y_deg * PI / 360.0);
    double reach = 0.0;
    for (int i = 0; i < 360; i++) {
        const double p[3] = {
            0.5 * (def->min_world[0] + def->max_world[0]) + radius * sin(i * PI / 180.0), y,
            0.5 * (def->min_world[2] + def->max_world[2]) + radius * cos(i * PI / 180.0)};
        double v[3];
        to_camera(pose, p, v);
        assert_true(v[2] < 0.0);
        reach = fmax(reach, fabs(v[1]) / (-v[2] * tan_y));
        reach = fmax(reach, fabs(v[0]) / (-v[2] * tan_y * def->aspect));
    }
    return reach;
}

// With a silhouette, the picture is filled by what is there and not by the corners of its box.
static void the_orbit_shows_the_whole_silhouette(void **context) {
    (void)context;
    static const struct {
        double radii[4]; // From below; a negative number is an empty slice.
        double fov_y_deg, aspect;
    } cases[] = {
        {{1, 1, 1, 1}, 50, 4.0 / 3.0}, {{-1, 0.2, 3, 0.1}, 50, 4.0 / 3.0}, {{0, 0, 0, 5}, 30, 0.5},
        {{8, -1, -1, 0}, 90, 2.0},     {{0.1, 0.1, 0.1, 0.1}, 50, 1.5},    {{1, 2, 3, 4}, 150, 0.2},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        DipCamOrbitDef def = dip_campath_default_orbit();
        const double size[3] = {9, 2, 9};
        for (int i = 0; i < 3; i++) {
            def.min_world[i] = 3 - size[i];
            def.max_world[i] = 3 + size[i];
        }
        def.fov_y_deg = cases[c].fov_y_deg;
        def.aspect = cases[c].aspect;
        def.radii = cases[c].radii;
        def.radius_count = 4;
        DipCamPath *path;
        assert_true(dip_campath_orbit(&def, &path, NULL));
        const DipPose pose = sample(path, 7 * SECOND);
        double widest = 0.0;
        for (int slice = 0; slice < 4; slice++) {
            for (int end = 0; end < 2 && def.radii[slice] >= 0; end++) {
                const double y = def.min_world[1] + (slice + end) * 1.0;
                widest = fmax(widest, reach_of_circle(&def, &pose, def.radii[slice], y));
            }
        }
        // The border is 5 % of the distance, so less than that of the picture near the camera.
        if (!(widest < 1.0 && widest > 0.83)) {
            fail_msg("case %zu: the silhouette reaches to %.3f of the picture", c, widest);
        }
        dip_campath_destroy(&path);
    }
}

static void the_orbit_begins_in_front_and_turns_over_plus_x(void **context) {
    (void)context;
    const DipCamOrbitDef def = dip_campath_default_orbit();
    DipCamPath *path;
    assert_true(dip_campath_orbit(&def, &path, NULL));
    const DipPose start = sample(path, 0);
    const DipPose quarter = sample(path, 5 * SECOND);
    assert_true(start.position_world[2] > 1.0 && fabs(start.position_world[0]) < 1e-12);
    assert_true(quarter.position_world[0] > 1.0 && fabs(quarter.position_world[2]) < 1e-12);
    dip_campath_destroy(&path);
}

// A model of a single point is framed as a box of one metre about it.
static void the_orbit_of_a_point_is_that_of_a_box_of_one_metre(void **context) {
    (void)context;
    DipCamOrbitDef point = dip_campath_default_orbit();
    DipCamOrbitDef box = point;
    for (int i = 0; i < 3; i++) {
        point.min_world[i] = point.max_world[i] = 2.0 * i;
        box.min_world[i] = 2.0 * i - 0.5;
        box.max_world[i] = 2.0 * i + 0.5;
    }
    DipCamPath *paths[2];
    assert_true(dip_campath_orbit(&point, &paths[0], NULL));
    assert_true(dip_campath_orbit(&box, &paths[1], NULL));
    for (int t = 0; t < 20; t++) {
        const DipPose a = sample(paths[0], t * SECOND);
        const DipPose b = sample(paths[1], t * SECOND);
        assert_memory_equal(&a, &b, sizeof a);
    }
    dip_campath_destroy(&paths[0]);
    dip_campath_destroy(&paths[1]);
}

static void bad_orbits_and_keys_are_refused(void **context) {
    (void)context;
    DipCamPath *path;
    DipError err;
    DipCamOrbitDef def = dip_campath_default_orbit();
    def.max_world[1] = -2.0;
    assert_false(dip_campath_orbit(&def, &path, &err));
    assert_string_equal(err.key, "box");
    def = dip_campath_default_orbit();
    def.min_world[0] = NAN;
    assert_false(dip_campath_orbit(&def, &path, &err));
    assert_string_equal(err.key, "box");
    def = dip_campath_default_orbit();
    def.fov_y_deg = 0.0;
    assert_false(dip_campath_orbit(&def, &path, &err));
    assert_string_equal(err.key, "fov");
    def = dip_campath_default_orbit();
    def.aspect = NAN;
    assert_false(dip_campath_orbit(&def, &path, &err));
    assert_string_equal(err.key, "aspect");
    def = dip_campath_default_orbit();
    def.duration_ns = 0;
    assert_false(dip_campath_orbit(&def, &path, &err));
    assert_string_equal(err.key, "period");
    const DipCamKey key = {{0, 0, 0}, {0, 0, 0, 1}};
    assert_false(dip_campath_create(&key, 0, SECOND, &path, &err));
    assert_string_equal(err.key, "keys");
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    assert_null(path);
    static const char *const names[7] = {"x", "y", "z", "qx", "qy", "qz", "qw"};
    for (int i = 0; i < 7; i++) {
        DipCamKey undefined = key;
        *(i < 3 ? &undefined.position_world[i] : &undefined.orientation[i - 3]) = NAN;
        assert_false(dip_campath_create(&undefined, 1, SECOND, &path, &err));
        assert_string_equal(err.key, names[i]);
        assert_int_equal(err.code, DIP_ERROR_RANGE);
    }
}

// The ends of each range are accepted; the next numbers beyond them are not.
static void orbits_accept_their_ranges_and_no_more(void **context) {
    (void)context;
    const double aspects[2] = {0.01, 100.0};
    const double fovs_deg[2] = {1.0, 170.0};
    for (int end = 0; end < 2; end++) {
        DipCamPath *path;
        DipCamOrbitDef def = dip_campath_default_orbit();
        def.aspect = aspects[end];
        def.fov_y_deg = fovs_deg[end];
        assert_true(dip_campath_orbit(&def, &path, NULL));
        dip_campath_destroy(&path);
        const double beyond = end == 0 ? 0.0 : INFINITY;
        def.aspect = nextafter(aspects[end], beyond);
        assert_false(dip_campath_orbit(&def, &path, NULL));
        def.aspect = aspects[end];
        def.fov_y_deg = nextafter(fovs_deg[end], beyond);
        assert_false(dip_campath_orbit(&def, &path, NULL));
    }
}

// Hashes the bits of 5000 poses. The hash shows that all compilers and processors compute the same
// poses. Other tests show that the poses are right.
static void poses_have_the_same_bits_on_every_machine(void **context) {
    (void)context;
    const DipCamOrbitDef def = dip_campath_default_orbit();
    DipCamPath *path;
    assert_true(dip_campath_orbit(&def, &path, NULL));
    DipHash hash = dip_hash_begin(0);
    for (int t = 0; t < 5000; t++) {
        const DipPose pose = sample(path, t * INT64_C(7654321));
        dip_hash_bytes(&hash, &pose, sizeof pose);
    }
    dip_campath_destroy(&path);
    assert_int_equal(hash.lanes[0], UINT64_C(0x3136025b8ca999f2));
}

// ---- Track ----

// Steps through time one nanosecond after the other, turning around as the path says. The path's
// times are small, so that the model can be this simple.
static void paths_end_as_they_are_told(void **context) {
    (void)context;
    DipCamPath *path = parse("diptych-path 1\nperiod 0.000001\n"
                             "0 0 0 0 0 0 1\n1 0 0 0 0 0 1\n5 0 0 0 0 0 1\n");
    const int64_t last_ns = 2000;
    int64_t back_ns = 0;
    int step = 1;
    for (int64_t t = 0; t < 20000; t++) {
        assert_int_equal(dip_campath_time_at_end(path, DIP_CAMPATH_END_loop, t), t % 3000);
        assert_int_equal(dip_campath_time_at_end(path, DIP_CAMPATH_END_once, t),
                         t < last_ns ? t : last_ns);
        assert_int_equal(dip_campath_time_at_end(path, DIP_CAMPATH_END_back, t), back_ns);
        assert_int_equal(dip_campath_time_at_end(path, DIP_CAMPATH_END_back, -t), back_ns);
        assert_int_equal(dip_campath_time_at_end(path, DIP_CAMPATH_END_once, -t), 0);
        back_ns += step;
        step = back_ns == last_ns ? -1 : back_ns == 0 ? 1 : step;
    }
    assert_int_equal(dip_campath_span_ns(path, DIP_CAMPATH_END_loop), 3000);
    assert_int_equal(dip_campath_span_ns(path, DIP_CAMPATH_END_once), 2000);
    assert_int_equal(dip_campath_span_ns(path, DIP_CAMPATH_END_back), 4000);
    for (int end = 0; end < DIP_CAMPATH_END_COUNT; end++) {
        for (int i = 0; i < 2; i++) {
            const int64_t t =
                dip_campath_time_at_end(path, (DipCamPathEnd)end, i ? INT64_MAX : INT64_MIN);
            assert_in_range(t, 0, 3000);
        }
    }
    dip_campath_destroy(&path);
}

static void a_single_key_ends_where_it_begins(void **context) {
    (void)context;
    DipCamPath *path = parse("diptych-path 1\nperiod 3600\n1 2 3 0 0 0 1\n");
    for (int end = 0; end < DIP_CAMPATH_END_COUNT; end++) {
        DipCamTrack track = dip_camtrack_make(true);
        DipPose pose = {.fov_y_deg = 0.0};
        dip_camtrack_set(&track, 0, path, 55.0);
        dip_camtrack_set_end(&track, (DipCamPathEnd)end);
        assert_true(dip_camtrack_pose(&track, 7 * SECOND, &pose));
        assert_true(pose.position_world[0] == 1.0 && pose.position_world[2] == 3.0);
    }
    dip_campath_destroy(&path);
}

// The track applies the end to the time since the path began.
static void a_track_stops_or_turns_at_the_end(void **context) {
    (void)context;
    DipCamPath *path = parse("diptych-path 1\nperiod 1\n0 0 0 0 0 0 1\n8 0 0 0 0 0 1\n");
    DipCamTrack track = dip_camtrack_make(true);
    DipPose pose;
    assert_int_equal(dip_camtrack_path_time(&track, SECOND), 0);
    dip_camtrack_set(&track, 0, path, 55.0);
    dip_camtrack_restart(&track, 100 * SECOND);
    static const struct {
        DipCamPathEnd end;
        double at_one_half, at_one_and_a_half, at_seven;
    } expected[] = {{DIP_CAMPATH_END_loop, 4.0, 4.0, 8.0},
                    {DIP_CAMPATH_END_once, 4.0, 8.0, 8.0},
                    {DIP_CAMPATH_END_back, 4.0, 4.0, 8.0}};
    for (int i = 0; i < 3; i++) {
        dip_camtrack_set_end(&track, expected[i].end);
        assert_true(dip_camtrack_pose(&track, 100 * SECOND + SECOND / 2, &pose));
        assert_true(pose.position_world[0] == expected[i].at_one_half);
        assert_true(dip_camtrack_pose(&track, 101 * SECOND + SECOND / 2, &pose));
        assert_true(pose.position_world[0] == expected[i].at_one_and_a_half);
        assert_true(dip_camtrack_pose(&track, 107 * SECOND, &pose));
        assert_true(pose.position_world[0] == expected[i].at_seven);
    }
    assert_int_equal(dip_camtrack_path_time(&track, 107 * SECOND), SECOND);
    dip_campath_destroy(&path);
}

static void switching_paths_restarts_or_keeps_the_time(void **context) {
    (void)context;
    DipCamPath *a = parse("diptych-path 1\nperiod 1\n0 0 0 0 0 0 1\n10 0 0 0 0 0 1\n");
    DipCamPath *b = parse("diptych-path 1\nperiod 4\n0 5 0 0 0 0 1\n40 5 0 0 0 0 1\n");
    for (int reset = 0; reset < 2; reset++) {
        DipCamTrack track = dip_camtrack_make(reset);
        DipPose pose = {.fov_y_deg = 1.0};
        assert_false(dip_camtrack_pose(&track, 0, &pose));
        assert_true(pose.fov_y_deg == 1.0);
        dip_camtrack_set(&track, 0, a, 55.0);
        dip_camtrack_set(&track, 2, a, 50.0); // The same path in another category.
        dip_camtrack_set(&track, 3, b, 45.0);
        assert_true(dip_camtrack_pose(&track, SECOND / 2, &pose));
        assert_true(pose.position_world[0] == 5.0 && pose.fov_y_deg == 55.0);
        dip_camtrack_switch(&track, 2, SECOND / 2); // The path is the same, so it continues.
        assert_true(dip_camtrack_pose(&track, SECOND / 2, &pose));
        assert_true(pose.position_world[0] == 5.0 && pose.fov_y_deg == 50.0);
        dip_camtrack_switch(&track, 3, SECOND);
        assert_true(dip_camtrack_pose(&track, SECOND, &pose));
        assert_true(pose.position_world[0] == (reset ? 0.0 : 10.0));
        assert_true(pose.position_world[1] == 5.0 && pose.fov_y_deg == 45.0);
        // Category 7 has no path, so the path of category 0 plays.
        dip_camtrack_switch(&track, 7, 5 * SECOND / 2);
        assert_true(dip_camtrack_pose(&track, 5 * SECOND / 2, &pose));
        assert_true(pose.position_world[0] == (reset ? 0.0 : 5.0) && pose.fov_y_deg == 55.0);
        dip_camtrack_restart(&track, 3 * SECOND);
        assert_true(dip_camtrack_time(&track, 4 * SECOND) == SECOND);
    }
    dip_campath_destroy(&a);
    dip_campath_destroy(&b);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(positions_move_linearly_and_the_loop_closes),
        cmocka_unit_test(orientations_turn_at_constant_speed),
        cmocka_unit_test(the_sign_of_a_quaternion_does_not_matter),
        cmocka_unit_test(the_closing_step_of_a_full_turn_is_short),
        cmocka_unit_test(a_half_turn_is_interpolated),
        cmocka_unit_test(a_path_repeats_exactly_after_its_duration),
        cmocka_unit_test(a_path_of_one_key_is_a_still_camera),
        cmocka_unit_test(path_info_has_length_speed_and_bounding_box),
        cmocka_unit_test(the_binary_layout_is_as_documented),
        cmocka_unit_test(the_text_format_is_as_documented),
        cmocka_unit_test(converting_between_the_formats_keeps_every_bit),
        cmocka_unit_test(loading_a_period_keeps_every_nanosecond),
        cmocka_unit_test(a_comma_locale_changes_nothing),
        cmocka_unit_test(errors_name_files_that_cannot_be_read_or_written),
        cmocka_unit_test(the_orbit_shows_the_whole_box),
        cmocka_unit_test(the_orbit_shows_the_whole_silhouette),
        cmocka_unit_test(the_orbit_begins_in_front_and_turns_over_plus_x),
        cmocka_unit_test(the_orbit_of_a_point_is_that_of_a_box_of_one_metre),
        cmocka_unit_test(bad_orbits_and_keys_are_refused),
        cmocka_unit_test(orbits_accept_their_ranges_and_no_more),
        cmocka_unit_test(poses_have_the_same_bits_on_every_machine),
        cmocka_unit_test(paths_end_as_they_are_told),
        cmocka_unit_test(a_single_key_ends_where_it_begins),
        cmocka_unit_test(a_track_stops_or_turns_at_the_end),
        cmocka_unit_test(switching_paths_restarts_or_keeps_the_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
