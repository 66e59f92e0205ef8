// The filters against plain models in double precision, against each other over instruction sets
// and threads, and on pictures whose result is known.
#include "renderer/post/filters/filter.h"
#include "renderer/post/post.h"
#include "tests/renderer/post/post_model.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static uint32_t random_state = 1;

static uint32_t random_number(uint32_t limit) {
    random_state = random_state * 1664525u + 1013904223u;
    return (random_state >> 8) % limit;
}

typedef struct Picture {
    uint8_t *rgba8;
    int width;
    int height;
} Picture;

static Picture new_picture(int width, int height) {
    return (Picture){calloc((size_t)width * (size_t)height, 4), width, height};
}

// Edges at many angles, thin lines, noise and flat parts.
static Picture drawn_picture(int width, int height) {
    Picture p = new_picture(width, height);
    for (int i = 0; i < width * height * 4; i++) {
        p.rgba8[i] = 90;
    }
    for (int shape = 0; shape < 12; shape++) {
        const double a = random_number(1000) / 500.0 - 1, b = random_number(1000) / 500.0 - 1;
        const double x0 = random_number((uint32_t)width), y0 = random_number((uint32_t)height);
        const double thin = shape % 3 == 0 ? 0.8 : 1e9;
        uint8_t rgb[4];
        for (int c = 0; c < 4; c++) {
            rgb[c] = (uint8_t)random_number(256);
        }
        for (int y = 0; y < height; y++) {
            for (int x = 0; x < width; x++) {
                const double side = a * (x - x0) + b * (y - y0);
                if (side >= 0 && side < thin * hypot(a, b) &&
                    (x * 7 + y * 3 + shape) % 5 < 4 + (shape & 1)) {
                    memcpy(p.rgba8 + 4 * (y * width + x), rgb, 4);
                }
            }
        }
    }
    for (int i = 0; i < width * height / 20; i++) {
        p.rgba8[random_number((uint32_t)(width * height * 4))] = (uint8_t)random_number(256);
    }
    return p;
}

static Picture filtered(const Picture *from, DipPostFilter filter, int width, int height,
                        float sharpness, DipIsa isa, DipPool *pool, DipPostWork *work) {
    const DipPostDef def = {.filter = filter,
                            .from_width = from->width,
                            .from_height = from->height,
                            .to_width = width,
                            .to_height = height,
                            .sharpness = sharpness,
                            .isa = isa,
                            .pool = pool};
    DipError err = {0};
    DipPost *post = dip_post_create(&def, &err);
    assert_non_null(post);
    Picture to = new_picture(width, height);
    const DipPostWork done =
        dip_post_run(post, from->rgba8, (size_t)from->width * 4, to.rgba8, (size_t)width * 4);
    if (work) {
        *work = done;
    }
    dip_post_destroy(&post);
    assert_null(post);
    return to;
}

// --- models --------------------------------------------------------------------------------------

static ModelColour colour_of(const Picture *from, DipPostFilter filter, int width, int height,
                             float sharpness, int ties, int x, int y) {
    const ModelPicture p = {from->rgba8, from->width, from->height};
    switch (filter) {
    case DIP_POST_FXAA:
        return model_fxaa(&p, ties, x, y);
    case DIP_POST_SHARPEN:
        return model_sharpen(&p, (double)sharpness, x, y);
    case DIP_POST_BILINEAR:
        return model_bilinear(&p, width, height, x, y);
    case DIP_POST_BICUBIC:
        return model_bicubic(&p, width, height, x, y);
    default:
        return model_easu(&p, width, height, x, y);
    }
}

// A code may differ from the model's colour by its rounding.
static bool is_colour(const uint8_t *found, ModelColour wanted) {
    double worst = 0;
    for (int c = 0; c < 3; c++) {
        worst = fmax(worst, fabs(found[c] - wanted.rgb[c]));
    }
    return worst <= 0.53;
}

// Where a decision of the model hangs by a rounding error, such as the direction of an edge, a
// pixel may be another one. At most the share `undecided` of the pixels may.
static void expect_model(DipPostFilter filter, int width, int height, int to_width, int to_height,
                         float sharpness, double undecided) {
    Picture from = drawn_picture(width, height);
    Picture to =
        filtered(&from, filter, to_width, to_height, sharpness, dip_isa_best(), NULL, NULL);
    int others = 0;
    for (int y = 0; y < to_height; y++) {
        for (int x = 0; x < to_width; x++) {
            const uint8_t *found = to.rgba8 + 4 * (y * to_width + x);
            bool is_model = false;
            for (int ties = 0; ties < 16 && !is_model; ties++) {
                is_model |= is_colour(
                    found, colour_of(&from, filter, to_width, to_height, sharpness, ties, x, y));
            }
            others += !is_model;
            const bool keeps = !dip_post_enlarges(filter);
            assert_int_equal(found[3], keeps ? from.rgba8[4 * (y * width + x) + 3] : 255);
        }
    }
    if (others > undecided * to_width * to_height) {
        fail_msg("%s: %d of %d pixels differ from the model", dip_post_name(filter), others,
                 to_width * to_height);
    }
    free(from.rgba8);
    free(to.rgba8);
}

static void fxaa_is_its_model(void **state) {
    (void)state;
    for (int i = 0; i < 6; i++) {
        expect_model(DIP_POST_FXAA, 131 + i, 70 + i, 131 + i, 70 + i, 0.0f, 0.001);
    }
}

static void sharpening_is_its_model(void **state) {
    (void)state;
    for (int i = 0; i < 6; i++) {
        expect_model(DIP_POST_SHARPEN, 97 + i, 61, 97 + i, 61, (float)i / 5, 0.0);
    }
}

static void enlarging_is_its_model(void **state) {
    (void)state;
    static const int sizes[][4] = {{64, 48, 96, 72}, {57, 43, 64, 48},    {33, 21, 66, 42},
                                   {40, 30, 40, 45}, {17, 120, 113, 121}, {1, 1, 5, 3}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        const int *s = sizes[i];
        expect_model(DIP_POST_BILINEAR, s[0], s[1], s[2], s[3], 0.0f, 0.0);
        expect_model(DIP_POST_BICUBIC, s[0], s[1], s[2], s[3], 0.0f, 0.0);
        expect_model(DIP_POST_EASU, s[0], s[1], s[2], s[3], 0.0f, 0.001);
    }
}

// --- known pictures ------------------------------------------------------------------------------

// A dark and a bright half with a border of this slope, sampled at the pixels' centres.
static double coverage_of(double slope, int x, int y) {
    double sum = 0;
    for (int i = 0; i < 256; i++) {
        const double px = x + (i % 16 + 0.5) / 16, py = y + (i / 16 + 0.5) / 16;
        sum += py > 20 + slope * px ? 1.0 / 256 : 0;
    }
    return sum;
}

// The mean distance of a picture from exact coverage, along a border.
static double distance_from_coverage(const Picture *p, double slope) {
    double sum = 0;
    for (int y = 0; y < p->height; y++) {
        for (int x = 40; x < p->width - 40; x++) {
            sum += fabs(p->rgba8[4 * (y * p->width + x)] / 255.0 - coverage_of(slope, x, y));
        }
    }
    return sum / (p->width - 80);
}

// Counts the pixels whose left or upper neighbour is another colour.
static int pixels_at_edges(const Picture *p) {
    int count = 0;
    for (int y = 0; y < p->height; y++) {
        for (int x = 0; x < p->width; x++) {
            const uint8_t *pixel = p->rgba8 + 4 * (y * p->width + x);
            count +=
                (x > 0 && pixel[0] != pixel[-4]) || (y > 0 && pixel[0] != pixel[-4 * p->width]);
        }
    }
    return count;
}

// Counts the pixels one of whose four neighbours is another colour.
static int pixels_beside_others(const Picture *p) {
    int count = 0;
    for (int i = 0; i < p->width * p->height; i++) {
        const int x = i % p->width, y = i / p->width;
        const uint8_t *pixel = p->rgba8 + 4 * i;
        count += (x > 0 && pixel[0] != pixel[-4]) || (x < p->width - 1 && pixel[0] != pixel[4]) ||
                 (y > 0 && pixel[0] != pixel[-4 * p->width]) ||
                 (y < p->height - 1 && pixel[0] != pixel[4 * p->width]);
    }
    return count;
}

// Antialiasing brings a straight border near to its exact coverage.
static void borders_come_near_to_coverage(void **state) {
    (void)state;
    static const double slopes[] = {1.0 / 3, 1.0 / 7, 1.0 / 11, 0.93};
    for (size_t i = 0; i < 4; i++) {
        Picture p = new_picture(200, 240);
        for (int y = 0; y < p.height; y++) {
            for (int x = 0; x < p.width; x++) {
                const int bright = y + 0.5 > 20 + slopes[i] * (x + 0.5);
                memset(p.rgba8 + 4 * (y * p.width + x), bright ? 255 : 0, 3);
            }
        }
        DipPostWork work, fxaa_work;
        Picture smaa = filtered(&p, DIP_POST_SMAA, 200, 240, 0.0f, dip_isa_best(), NULL, &work);
        Picture fxaa =
            filtered(&p, DIP_POST_FXAA, 200, 240, 0.0f, dip_isa_best(), NULL, &fxaa_work);
        const double before = distance_from_coverage(&p, slopes[i]);
        const double with_smaa = distance_from_coverage(&smaa, slopes[i]);
        const double with_fxaa = distance_from_coverage(&fxaa, slopes[i]);
        assert_true(with_smaa < 0.65 * before);
        assert_true(with_fxaa < 0.75 * before);
        assert_int_equal(work.edges_found, pixels_at_edges(&p));
        assert_int_equal(fxaa_work.edges_found, pixels_beside_others(&p));
        assert_int_equal(work.pixels_filtered, 200 * 240);
        assert_int_equal(fxaa_work.pixels_filtered, 200 * 240);
        free(p.rgba8);
        free(smaa.rgba8);
        free(fxaa.rgba8);
    }
}

// A picture without edges stays as it is, whichever filter is applied at its own size.
static void flat_pictures_stay(void **state) {
    (void)state;
    for (int filter = 0; filter < DIP_POST_COUNT; filter++) {
        Picture p = new_picture(37, 19);
        for (int i = 0; i < 37 * 19; i++) {
            memcpy(p.rgba8 + 4 * i, (const uint8_t[]){12, 130, 255, 255}, 4);
        }
        Picture to = filtered(&p, (DipPostFilter)filter, 37, 19, 1.0f, dip_isa_best(), NULL, NULL);
        assert_memory_equal(p.rgba8, to.rgba8, 37 * 19 * 4);
        free(p.rgba8);
        free(to.rgba8);
    }
}

// At its own size, enlarging changes nothing.
static void the_same_size_is_the_same_picture(void **state) {
    (void)state;
    Picture p = drawn_picture(77, 41);
    for (int i = 0; i < 77 * 41; i++) {
        p.rgba8[4 * i + 3] = 255;
    }
    for (int filter = DIP_POST_BILINEAR; filter <= DIP_POST_BICUBIC; filter++) {
        Picture to = filtered(&p, (DipPostFilter)filter, 77, 41, 0.0f, dip_isa_best(), NULL, NULL);
        assert_memory_equal(p.rgba8, to.rgba8, 77 * 41 * 4);
        free(to.rgba8);
    }
    free(p.rgba8);
}

// --- bits ----------------------------------------------------------------------------------------

static void all_machines_filter_the_same_bits(void **state) {
    (void)state;
    DipPool *pool = dip_pool_create(3, NULL);
    assert_non_null(pool);
    static const int sizes[][2] = {{1, 1}, {2, 40}, {63, 17}, {64, 33}, {65, 2}, {150, 90}};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        for (int f = 0; f < DIP_POST_COUNT; f++) {
            const DipPostFilter filter = (DipPostFilter)f;
            const int width = sizes[s][0], height = sizes[s][1];
            const int to_width = dip_post_enlarges(filter) ? width * 3 / 2 + 1 : width;
            const int to_height = dip_post_enlarges(filter) ? height * 5 / 4 + 1 : height;
            Picture from = drawn_picture(width, height);
            DipPostWork first_work;
            Picture first = filtered(&from, filter, to_width, to_height, 0.7f, DIP_ISA_SCALAR, NULL,
                                     &first_work);
            for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
                for (int threads = 0; threads < 2 && dip_isa_available((DipIsa)isa); threads++) {
                    DipPostWork work;
                    Picture to = filtered(&from, filter, to_width, to_height, 0.7f, (DipIsa)isa,
                                          threads ? pool : NULL, &work);
                    assert_memory_equal(first.rgba8, to.rgba8,
                                        (size_t)to_width * (size_t)to_height * 4);
                    assert_int_equal(work.edges_found, first_work.edges_found);
                    free(to.rgba8);
                }
            }
            free(first.rgba8);
            free(from.rgba8);
        }
    }
    dip_pool_destroy(&pool);
}

// A filter may run again and again, with other pictures and strides; what it held before leaves no
// trace, and it writes nothing between the rows.
static void runs_leave_no_trace(void **state) {
    (void)state;
    for (int f = 0; f < DIP_POST_COUNT; f++) {
        const DipPostDef def = {.filter = (DipPostFilter)f,
                                .from_width = 70,
                                .from_height = 50,
                                .to_width = dip_post_enlarges((DipPostFilter)f) ? 90 : 70,
                                .to_height = 50,
                                .sharpness = 0.5f,
                                .isa = dip_isa_best()};
        DipPost *post = dip_post_create(&def, NULL);
        assert_non_null(post);
        assert_true(dip_post_bytes(post) > 0);
        Picture a = drawn_picture(70, 50), b = drawn_picture(70, 50);
        Picture fresh = filtered(&b, def.filter, def.to_width, 50, 0.5f, def.isa, NULL, NULL);
        const size_t row = (size_t)def.to_width * 4, stride = row + 12;
        uint8_t *to = malloc(stride * 50);
        dip_post_run(post, a.rgba8, 70 * 4, to, stride);
        memset(to, 0xaa, stride * 50);
        dip_post_run(post, b.rgba8, 70 * 4, to, stride);
        for (size_t y = 0; y < 50; y++) {
            assert_memory_equal(to + y * stride, fresh.rgba8 + y * row, row);
            for (size_t i = row; i < stride; i++) {
                assert_int_equal(to[y * stride + i], 0xaa);
            }
        }
        free(to);
        free(a.rgba8);
        free(b.rgba8);
        free(fresh.rgba8);
        dip_post_destroy(&post);
    }
}

// --- refusals ------------------------------------------------------------------------------------

static void expect_refusal(DipPostDef def, DipErrorCode code, const char *part) {
    DipError err = {0};
    assert_null(dip_post_create(&def, &err));
    assert_int_equal(err.code, code);
    if (!strstr(err.message, part)) {
        fail_msg("\"%s\" does not say \"%s\"", err.message, part);
    }
}

static void what_cannot_be_filtered_is_refused(void **state) {
    (void)state;
    const DipPostDef good = {DIP_POST_FXAA, 8, 8, 8, 8, 0.0f, dip_isa_best(), NULL};
    DipPostDef def = good;
    def.to_width = 9;
    expect_refusal(def, DIP_ERROR_RANGE, "the same size");
    def = good;
    def.from_width = 0;
    expect_refusal(def, DIP_ERROR_RANGE, "sizes of 1 to");
    def = good;
    def.filter = DIP_POST_EASU;
    def.to_height = 7;
    expect_refusal(def, DIP_ERROR_RANGE, "do not shrink");
    def = good;
    def.to_width = def.from_width = DIP_MAX_POST_SIZE + 1;
    expect_refusal(def, DIP_ERROR_RANGE, "sizes of 1 to");
    def = good;
    def.sharpness = NAN;
    expect_refusal(def, DIP_ERROR_RANGE, "0 to 1");
    def = good;
    def.filter = DIP_POST_COUNT;
    expect_refusal(def, DIP_ERROR_UNKNOWN, "accepted");
    assert_string_equal(dip_post_name(DIP_POST_COUNT), "?");
    def = good;
    def.isa = DIP_ISA_COUNT;
    expect_refusal(def, DIP_ERROR_UNSUPPORTED, "the instruction set ?");
    DipPostFilter filter;
    assert_true(dip_post_parse("smaa", &filter));
    assert_int_equal(filter, DIP_POST_SMAA);
    assert_false(dip_post_parse("SMAA", &filter));
}

// With 32 bits, the parts of a history of 16384x16384 pixels are more than size_t can count.
static void sums_of_parts_do_not_wrap(void **state) {
    (void)state;
    DipPostArena arena = {0};
    dip_post_take(&arena, 3, 5);
    assert_int_equal(arena.used, 64);
    for (int i = 0; i < 3; i++) {
        const size_t before = arena.used;
        dip_post_take(&arena, SIZE_MAX / 10, 4);
        assert_true(arena.used > before);
    }
    assert_true(arena.used == SIZE_MAX);
    dip_post_take(&arena, 1, 1);
    assert_true(arena.used == SIZE_MAX);
    arena.used = 0;
    dip_post_take(&arena, SIZE_MAX / 2, 4);
    assert_true(arena.used == SIZE_MAX);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fxaa_is_its_model),
        cmocka_unit_test(sharpening_is_its_model),
        cmocka_unit_test(enlarging_is_its_model),
        cmocka_unit_test(borders_come_near_to_coverage),
        cmocka_unit_test(flat_pictures_stay),
        cmocka_unit_test(the_same_size_is_the_same_picture),
        cmocka_unit_test(all_machines_filter_the_same_bits),
        cmocka_unit_test(runs_leave_no_trace),
        cmocka_unit_test(what_cannot_be_filtered_is_refused),
        cmocka_unit_test(sums_of_parts_do_not_wrap),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
