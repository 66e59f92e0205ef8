// Tests the views of glTF files that EXT_meshopt_compression packs. The tests pack values as the
// specification of the extension says, in its simplest form: each byte of a delta stands as it is.
// What Diptych unpacks is compared with the values that were packed.
#include "assets/gltf/document.h"
#include "tests/assets/fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#ifdef DIP_HAS_MESHOPTIMIZER

enum { MOST_BYTES = 1 << 16, MOST_STRIDE = 256, GROUP = 16 };

// A packed view: its bytes, and what the file says about them.
typedef struct Packed {
    uint8_t bytes[MOST_BYTES];
    size_t size_bytes;
    int count, stride;
    const char *mode, *filter;
    int length;        // of the unpacked view
    const char *extra; // members of the view itself
} Packed;

static void put(Packed *packed, uint32_t byte) {
    assert_true(packed->size_bytes < MOST_BYTES);
    packed->bytes[packed->size_bytes++] = (uint8_t)byte;
}

// Mode ATTRIBUTES: a header; blocks, which have for each byte of a value two bits for each group
// of 16 deltas and then the deltas; a tail of at least 32 bytes with the first value at its end.
static void pack_attributes(Packed *packed, const void *values, int count, int stride,
                            const char *filter) {
    const uint8_t *from = values;
    const int room = 8192 / stride / GROUP * GROUP;
    const int block = room < 256 ? room : 256;
    *packed = (Packed){.count = count,
                       .stride = stride,
                       .mode = "ATTRIBUTES",
                       .filter = filter,
                       .length = count * stride,
                       .extra = ""};
    put(packed, 0xa0);
    for (int first = 0; first < count; first += block) {
        const int end = first + block < count ? first + block : count;
        const int groups = (end - first + GROUP - 1) / GROUP;
        for (int k = 0; k < stride; ++k) {
            for (int i = 0; i < (groups + 3) / 4; ++i) {
                put(packed, 0xff); // All groups have whole bytes.
            }
            for (int i = first; i < first + groups * GROUP; ++i) {
                const size_t at = (size_t)i * (size_t)stride + (size_t)k;
                const int before = i > 0 && i < end ? from[at - (size_t)stride] : from[k];
                const int value = i < end ? from[at] : before;
                const int delta = (int8_t)(uint8_t)(value - before);
                put(packed, (uint32_t)(delta < 0 ? -2 * delta - 1 : 2 * delta));
            }
        }
    }
    for (int i = stride; i < 32; ++i) {
        put(packed, 0);
    }
    for (int k = 0; k < stride; ++k) {
        put(packed, from[k]);
    }
}

// Mode INDICES: a header; for each index the difference from one of two earlier ones, whose number
// is the lowest bit, in groups of 7 bits; 4 bytes of zeros. The test takes them in turn. All 32
// bits together hold differences of up to 2^30.
static void pack_sequence(Packed *packed, const uint32_t *indices, int count, int stride) {
    uint32_t before[2] = {0, 0};
    *packed = (Packed){.count = count,
                       .stride = stride,
                       .mode = "INDICES",
                       .filter = "NONE",
                       .length = count * stride,
                       .extra = ""};
    put(packed, 0xd1);
    for (int i = 0; i < count; ++i) {
        const int64_t delta = (int64_t)indices[i] - (int64_t)before[i % 2];
        uint64_t bits = (uint64_t)(delta < 0 ? -2 * delta - 1 : 2 * delta) << 1 | (i & 1);
        before[i % 2] = indices[i];
        for (; bits > 127; bits >>= 7) {
            put(packed, (uint32_t)(bits & 127) | 128);
        }
        put(packed, (uint32_t)bits);
    }
    for (int i = 0; i < 4; ++i) {
        put(packed, 0);
    }
}

// Opens a file whose accessor 0 reads the view. The caller closes it.
static void open_packed(DipGltf *gltf, const Packed *packed, const char *accessor, DipError *err) {
    char text[1000];
    fixture_write("packed.bin", packed->bytes, packed->size_bytes);
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"2.0\"},"
             "\"buffers\":[{\"uri\":\"packed.bin\",\"byteLength\":%zu}],"
             "\"bufferViews\":[{%s\"buffer\":0,\"byteLength\":%d,\"extensions\":{"
             "\"EXT_meshopt_compression\":{\"buffer\":0,\"byteLength\":%zu,\"byteStride\":%d,"
             "\"count\":%d,\"mode\":\"%s\",\"filter\":\"%s\"}}}],"
             "\"accessors\":[{\"bufferView\":0,%s}]}",
             packed->size_bytes, packed->extra, packed->length, packed->size_bytes, packed->stride,
             packed->count, packed->mode, packed->filter, accessor);
    fixture_write_text("packed.gltf", text);
    if (!dip_gltf_open(gltf, fixture_path("packed.gltf"), err)) {
        fail_msg("%s", err->message);
    }
}

static void find_values(DipGltf *gltf, DipGltfAccessor *accessor, const DipError *err) {
    if (!dip_gltf_accessor(gltf, 0, 0, "test", accessor)) {
        fail_msg("%s", err->message);
    }
}

// --- modes ---------------------------------------------------------------------------------------

// 700 values of 12 bytes take three blocks of 256, and the last group of 16 is not full.
static void attributes_are_unpacked_over_blocks(void **state) {
    (void)state;
    enum { COUNT = 700 };
    float values[COUNT][3];
    for (int i = 0; i < COUNT; ++i) {
        for (int k = 0; k < 3; ++k) {
            values[i][k] = (float)(k + 1) * sinf((float)i * 0.37f + (float)k);
        }
    }
    Packed *packed = malloc(sizeof *packed);
    assert_non_null(packed);
    pack_attributes(packed, values, COUNT, 12, "NONE");
    DipGltf gltf;
    DipError err = {0};
    DipGltfAccessor accessor;
    open_packed(&gltf, packed, "\"componentType\":5126,\"type\":\"VEC3\",\"count\":700", &err);
    find_values(&gltf, &accessor, &err);
    for (uint32_t i = 0; i < COUNT; ++i) {
        for (int k = 0; k < 3; ++k) {
            assert_true(dip_gltf_number(&accessor, i, k) == (double)values[i][k]);
        }
    }
    dip_gltf_close(&gltf);
    free(packed);
}

static void index_sequences_are_unpacked(void **state) {
    (void)state;
    static const uint32_t small[] = {0, 1, 2, 2, 1, 65535, 0, 40000, 3, 3, 127, 128};
    static const uint32_t large[] = {1073741823, 0,          7,         1000000000,
                                     1073741830, 2000000000, 2147483653};
    static const struct {
        const uint32_t *indices;
        int count, stride;
        const char *accessor;
    } cases[] = {
        {small, 12, 2, "\"componentType\":5123,\"type\":\"SCALAR\",\"count\":12"},
        {small, 12, 4, "\"componentType\":5125,\"type\":\"SCALAR\",\"count\":12"},
        {large, 7, 4, "\"componentType\":5125,\"type\":\"SCALAR\",\"count\":7"},
    };
    Packed *packed = malloc(sizeof *packed);
    assert_non_null(packed);
    for (size_t c = 0; c < sizeof cases / sizeof *cases; ++c) {
        DipGltf gltf;
        DipError err = {0};
        DipGltfAccessor accessor;
        pack_sequence(packed, cases[c].indices, cases[c].count, cases[c].stride);
        open_packed(&gltf, packed, cases[c].accessor, &err);
        find_values(&gltf, &accessor, &err);
        for (int i = 0; i < cases[c].count; ++i) {
            const uint32_t found = dip_gltf_unsigned(&accessor, (uint32_t)i, 0);
            if (found != cases[c].indices[i]) {
                fail_msg("case %zu, index %d is %u, expected %u", c, i, found, cases[c].indices[i]);
            }
        }
        dip_gltf_close(&gltf);
    }
    free(packed);
}

// --- filters -------------------------------------------------------------------------------------

static const double directions[][3] = {
    {1, 0, 0},  {0, 1, 0},  {0, 0, 1},  {-1, 0, 0},  {0, -1, 0},  {0, 0, -1},   {1, 2, 3},
    {-1, 2, 3}, {1, -2, 3}, {1, 2, -3}, {-3, 1, -2}, {2, -3, -1}, {-1, -1, -1}, {5, 1, -0.5}};

enum { DIRECTIONS = sizeof directions / sizeof *directions };

static double sign_of(double value) {
    return value < 0 ? -1 : 1;
}

// Places a direction on the octahedron |x| + |y| + |z| = 1, and folds its lower half outwards.
static void fold(const double n[3], double *u, double *v) {
    const double sum = fabs(n[0]) + fabs(n[1]) + fabs(n[2]);
    *u = n[0] / sum;
    *v = n[1] / sum;
    if (n[2] < 0) {
        const double x = *u;
        *u = (1 - fabs(*v)) * sign_of(n[0]);
        *v = (1 - fabs(x)) * sign_of(n[1]);
    }
}

// bits: of the packed components, whose 1.0 is `one`. The fourth component is kept as it is.
static void check_octahedral(int component_bytes, int bits) {
    const int one = (1 << (bits - 1)) - 1;
    int8_t narrow[DIRECTIONS][4];
    int16_t wide[DIRECTIONS][4];
    for (int i = 0; i < DIRECTIONS; ++i) {
        double u;
        double v;
        fold(directions[i], &u, &v);
        const int values[4] = {(int)lround(u * one), (int)lround(v * one), one, 3 * i - 20};
        for (int k = 0; k < 4; ++k) {
            narrow[i][k] = (int8_t)values[k];
            wide[i][k] = (int16_t)values[k];
        }
    }
    Packed *packed = malloc(sizeof *packed);
    assert_non_null(packed);
    pack_attributes(packed, component_bytes == 1 ? (const void *)narrow : wide, DIRECTIONS,
                    4 * component_bytes, "OCTAHEDRAL");
    char type[100];
    snprintf(type, sizeof type,
             "\"componentType\":%d,\"type\":\"VEC4\",\"normalized\":true,\"count\":%d",
             component_bytes == 1 ? 5120 : 5122, DIRECTIONS);
    DipGltf gltf;
    DipError err = {0};
    DipGltfAccessor accessor;
    open_packed(&gltf, packed, type, &err);
    find_values(&gltf, &accessor, &err);
    const int greatest = component_bytes == 1 ? 127 : 32767;
    const double tolerance = 2.0 / one + 1.0 / greatest;
    for (uint32_t i = 0; i < DIRECTIONS; ++i) {
        const double *n = directions[i];
        const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int k = 0; k < 3; ++k) {
            const double found = dip_gltf_number(&accessor, i, k);
            if (!(fabs(found - n[k] / length) < tolerance)) {
                fail_msg("%d bits, direction %u, %c is %.6f, expected %.6f", bits, i, "xyz"[k],
                         found, n[k] / length);
            }
        }
        assert_true(fabs(dip_gltf_number(&accessor, i, 3) * greatest - (3.0 * (double)i - 20)) <
                    1e-9);
    }
    dip_gltf_close(&gltf);
    free(packed);
}

static void the_octahedral_filter_makes_unit_vectors(void **state) {
    (void)state;
    check_octahedral(1, 8);
    check_octahedral(1, 6);
    check_octahedral(2, 16);
    check_octahedral(2, 10);
}

// The filter stores three components of a quaternion, from the one after the greatest on. They are
// at most the root of 1/2. The two lowest bits of the fourth number say which one is left out.
static void check_quaternions(int bits) {
    static const double quaternions[][4] = {
        {0, 0, 0, 1}, {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0},  {1, 2, 3, 4},
        {4, 1, 2, 3}, {3, 4, 1, 2}, {2, 3, 4, 1}, {1, -2, 3, 4}, {-4, 1, 2, -3},
        {1, 1, 0, 0}, {0, 0, 1, 1}, {1, 1, 1, 1}, {2, -3, 4, 1}, {-1, -2, -3, 5}};
    enum { COUNT = sizeof quaternions / sizeof *quaternions };
    const int one = (1 << (bits - 1)) - 1;
    int16_t values[COUNT][4];
    for (int i = 0; i < COUNT; ++i) {
        const double *q = quaternions[i];
        const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
        int most = 0;
        for (int k = 1; k < 4; ++k) {
            most = fabs(q[k]) > fabs(q[most]) ? k : most;
        }
        for (int k = 0; k < 3; ++k) { // The one that is left out must be positive.
            const double part = q[(most + 1 + k) % 4] * sign_of(q[most]) / length;
            values[i][k] = (int16_t)lround(part * sqrt(2.0) * one);
        }
        values[i][3] = (int16_t)((one & ~3) | most);
    }
    Packed *packed = malloc(sizeof *packed);
    assert_non_null(packed);
    pack_attributes(packed, values, COUNT, 8, "QUATERNION");
    DipGltf gltf;
    DipError err = {0};
    DipGltfAccessor accessor;
    open_packed(&gltf, packed,
                "\"componentType\":5122,\"type\":\"VEC4\",\"normalized\":true,\"count\":15", &err);
    find_values(&gltf, &accessor, &err);
    for (uint32_t i = 0; i < COUNT; ++i) {
        const double *q = quaternions[i];
        const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
        double along = 0.0; // That of a rotation and itself is 1, or -1 for the negative.
        for (int k = 0; k < 4; ++k) {
            along += q[k] / length * dip_gltf_number(&accessor, i, k);
        }
        if (!(fabs(fabs(along) - 1.0) < 3.0 / one)) {
            fail_msg("%d bits, quaternion %u differs: %.6f", bits, i, along);
        }
    }
    dip_gltf_close(&gltf);
    free(packed);
}

static void the_quaternion_filter_makes_unit_quaternions(void **state) {
    (void)state;
    check_quaternions(16);
    check_quaternions(12);
    check_quaternions(8);
}

// 8 bits of an exponent E above 24 bits of a mantissa M, both signed, are M times 2 to the E.
// The specification accepts E of -100 to 100.
static void the_exponential_filter_makes_floats(void **state) {
    (void)state;
    static const struct {
        int exponent, mantissa;
    } parts[] = {{0, 0},        {0, 1},          {0, -1},         {-1, 3},   {-23, 8388607},
                 {5, -8388608}, {-100, 1234567}, {100, -1234567}, {-100, 1}, {10, 5}};
    enum { COUNT = sizeof parts / sizeof *parts };
    uint32_t values[COUNT];
    for (int i = 0; i < COUNT; ++i) {
        values[i] =
            (uint32_t)(parts[i].exponent & 255) << 24 | ((uint32_t)parts[i].mantissa & 0xffffff);
    }
    Packed *packed = malloc(sizeof *packed);
    assert_non_null(packed);
    for (int wide = 0; wide < 2; ++wide) { // as 10 values of 4 bytes and as 5 of 8
        pack_attributes(packed, values, wide ? COUNT / 2 : COUNT, wide ? 8 : 4, "EXPONENTIAL");
        DipGltf gltf;
        DipError err = {0};
        DipGltfAccessor accessor;
        open_packed(&gltf, packed,
                    wide ? "\"componentType\":5126,\"type\":\"VEC2\",\"count\":5"
                         : "\"componentType\":5126,\"type\":\"SCALAR\",\"count\":10",
                    &err);
        find_values(&gltf, &accessor, &err);
        for (int i = 0; i < COUNT; ++i) {
            const double found =
                dip_gltf_number(&accessor, (uint32_t)(wide ? i / 2 : i), wide ? i % 2 : 0);
            const double expected = ldexp(parts[i].mantissa, parts[i].exponent);
            if (found != expected) {
                fail_msg("value %d is %.9g, expected %.9g", i, found, expected);
            }
        }
        dip_gltf_close(&gltf);
    }
    free(packed);
}

// --- refusals ------------------------------------------------------------------------------------

// Says whether the view can be unpacked. If not, the error must be that of the extension.
static bool unpacks(const Packed *packed) {
    DipGltf gltf;
    DipError err = {0};
    const uint8_t *bytes;
    size_t size_bytes;
    int stride;
    open_packed(&gltf, packed, "\"componentType\":5126,\"type\":\"SCALAR\",\"count\":1", &err);
    const bool ok = dip_gltf_view(&gltf, 0, &bytes, &size_bytes, &stride);
    if (!ok) {
        assert_int_equal(err.code, DIP_ERROR_FORMAT);
        assert_string_equal(err.key, "EXT_meshopt_compression");
        assert_string_equal(err.message, "the packed content of view 0 is malformed");
    }
    dip_gltf_close(&gltf);
    return ok;
}

// What the specification says about strides, filters and counts, on both sides of each limit.
static void packed_views_follow_the_rules_of_the_extension(void **state) {
    (void)state;
    static const struct {
        int stride;
        const char *filter;
        bool ok;
    } cases[] = {
        {4, "NONE", true},        {8, "NONE", true},         {256, "NONE", true},
        {260, "NONE", false},     {6, "NONE", false},        {2, "NONE", false},
        {4, "OCTAHEDRAL", true},  {8, "OCTAHEDRAL", true},   {12, "OCTAHEDRAL", false},
        {8, "QUATERNION", true},  {4, "QUATERNION", false},  {16, "QUATERNION", false},
        {4, "EXPONENTIAL", true}, {12, "EXPONENTIAL", true}, {4, "COLOR", false},
    };
    static const uint8_t values[3 * (MOST_STRIDE + 4)] = {1, 2, 1, 1, 5, 6, 7, 8};
    Packed *packed = malloc(sizeof *packed);
    assert_non_null(packed);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        pack_attributes(packed, values, 3, cases[i].stride, cases[i].filter);
        if (unpacks(packed) != cases[i].ok) {
            fail_msg("stride %d and filter %s", cases[i].stride, cases[i].filter);
        }
    }
    static const uint32_t indices[] = {0, 1, 2, 3};
    static const struct {
        int stride, count;
        const char *filter;
        bool ok;
    } sequences[] = {{2, 4, "NONE", true},  {4, 4, "NONE", true},
                     {1, 4, "NONE", false}, {3, 4, "NONE", false},
                     {8, 4, "NONE", false}, {4, 4, "OCTAHEDRAL", false},
                     {4, 3, "NONE", true},  {4, 1, "EXPONENTIAL", false}};
    for (size_t i = 0; i < sizeof sequences / sizeof *sequences; ++i) {
        pack_sequence(packed, indices, sequences[i].count, sequences[i].stride);
        packed->filter = sequences[i].filter;
        if (unpacks(packed) != sequences[i].ok) {
            fail_msg("sequence %zu", i);
        }
    }
    free(packed);
}

static void views_that_contradict_their_content_are_refused(void **state) {
    (void)state;
    static const uint8_t values[48] = {1, 2, 3, 4, 5, 6, 7, 8};
    static const uint32_t indices[] = {0, 1, 2};
    Packed *packed = malloc(sizeof *packed);
    assert_non_null(packed);
    for (int i = 0; i < 10; ++i) {
        pack_attributes(packed, values, 6, 8, "NONE");
        assert_true(unpacks(packed));
        packed->extra = i == 0 ? "\"byteStride\":8," : i == 1 ? "\"byteStride\":4," : "";
        packed->length += (i == 2) - (i == 3);
        packed->count = i == 4 ? 7 : i == 5 ? 0 : 6;
        packed->length = i == 5 ? 0 : packed->length;
        packed->mode = i == 6 ? "TRIANGLES" : i == 7 ? "VERTICES" : "ATTRIBUTES";
        packed->size_bytes -= i == 8;
        packed->bytes[0] ^= i == 9; // another version
        if (unpacks(packed) != (i == 0)) {
            fail_msg("change %d", i);
        }
    }
    pack_attributes(packed, values, 0, 8, "NONE"); // The specification wants one value or more.
    assert_false(unpacks(packed));
    pack_sequence(packed, indices, 0, 4);
    assert_false(unpacks(packed));
    for (int i = 0; i < 4; ++i) { // A sequence whose bytes are too few, too many or another kind.
        pack_sequence(packed, indices, 3, 4);
        packed->size_bytes -= i == 1;
        packed->size_bytes += i == 2;
        packed->bytes[0] = i == 3 ? 0xa0 : 0xd1;
        if (unpacks(packed) != (i == 0)) {
            fail_msg("change %d of a sequence", i);
        }
    }
    free(packed);
}

// Four triangles' indices in mode TRIANGLES have a header of one byte, one code for each and
// 16 bytes at the end. A list of another length than a multiple of 3 is none of triangles.
static void triangles_have_three_corners(void **state) {
    (void)state;
    static const uint8_t table[16] = {0x00, 0x76, 0x87, 0x56, 0x67, 0x78, 0xa9, 0x86,
                                      0x65, 0x89, 0x68, 0x98, 0x01, 0x69, 0x00, 0x00};
    Packed *packed = malloc(sizeof *packed);
    assert_non_null(packed);
    for (int count = 3; count < 6; ++count) {
        *packed = (Packed){.count = count,
                           .stride = 4,
                           .mode = "TRIANGLES",
                           .filter = "NONE",
                           .length = 4 * count,
                           .extra = ""};
        put(packed, 0xe1);
        put(packed, 0xf0); // A triangle of three new vertices: 0, 1 and 2.
        for (int i = 0; i < 16; ++i) {
            put(packed, table[i]);
        }
        assert_int_equal(unpacks(packed), count == 3);
    }
    packed->count = 3;
    packed->length = 12;
    DipGltf gltf;
    DipError err = {0};
    DipGltfAccessor accessor;
    open_packed(&gltf, packed, "\"componentType\":5125,\"type\":\"SCALAR\",\"count\":3", &err);
    find_values(&gltf, &accessor, &err);
    for (uint32_t i = 0; i < 3; ++i) {
        assert_int_equal(dip_gltf_unsigned(&accessor, i, 0), i);
    }
    dip_gltf_close(&gltf);
    free(packed);
}

#endif

int main(void) {
#ifdef DIP_HAS_MESHOPTIMIZER
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(attributes_are_unpacked_over_blocks),
        cmocka_unit_test(index_sequences_are_unpacked),
        cmocka_unit_test(the_octahedral_filter_makes_unit_vectors),
        cmocka_unit_test(the_quaternion_filter_makes_unit_quaternions),
        cmocka_unit_test(the_exponential_filter_makes_floats),
        cmocka_unit_test(packed_views_follow_the_rules_of_the_extension),
        cmocka_unit_test(views_that_contradict_their_content_are_refused),
        cmocka_unit_test(triangles_have_three_corners),
    };
    return cmocka_run_group_tests(tests, fixture_open, fixture_close);
#else
    return 0; // test_gltf.c checks that such a build names the package.
#endif
}
