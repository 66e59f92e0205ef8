// Tests the order in which blended objects are drawn, beside a sort that looks for the next object
// again and again, and the depths and layers that decide it, beside the sentences of blend_order.h.
#include "renderer/catalogue/random.h"
#include "renderer/scene/draw/blend_order.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

// Returns whether a must be drawn before b.
static bool comes_first(const DipBlendedObject *a, const DipBlendedObject *b) {
    if (a->layer != b->layer) {
        return a->layer > b->layer;
    }
    if (a->depth != b->depth) {
        return a->depth > b->depth;
    }
    return a->object < b->object;
}

static void objects_are_sorted_by_layer_depth_and_index(void **state) {
    (void)state;
    enum { MOST = 40, CASES = 3000 };
    Random random = {3};
    for (int i = 0; i < CASES; i++) {
        const int count = i % (MOST + 1);
        DipBlendedObject objects[MOST + 1], left[MOST];
        for (int k = 0; k < count; k++) {
            left[k] = (DipBlendedObject){.layer = random_int(&random, 0, i % 4),
                                         .depth = random_int(&random, -3, 3),
                                         .object = 7 * k % 41};
            objects[k] = left[k];
        }
        objects[count] = (DipBlendedObject){.layer = 99, .depth = 99, .object = 99};
        dip_blend_sort(objects, count);
        for (int place = 0, rest = count; place < count; place++, rest--) {
            int next = 0;
            for (int k = 1; k < rest; k++) {
                next = comes_first(&left[k], &left[next]) ? k : next;
            }
            assert_int_equal(objects[place].object, left[next].object);
            assert_int_equal(objects[place].layer, left[next].layer);
            assert_int_equal(objects[place].depth, left[next].depth);
            left[next] = left[rest - 1];
        }
        assert_int_equal(objects[count].object, 99);
    }
}

// A ray from one height to another passes the surfaces between them. Water itself lies on one of
// the surfaces: it passes one less, and is drawn between what lies before and behind it.
static void layers_count_the_water_between_the_eye_and_an_object(void **state) {
    (void)state;
    static const float levels[3] = {1.0f, -2.0f, 5.0f};
    static const double heights[] = {-3.0, -2.0, -1.0, 0.0, 1.0, 3.0, 5.0, 6.0};
    enum { HEIGHTS = sizeof heights / sizeof *heights };
    for (int i = 0; i < HEIGHTS * HEIGHTS; i++) {
        const double eye = heights[i / HEIGHTS], centre = heights[i % HEIGHTS];
        const double low = fmin(eye, centre), high = fmax(eye, centre);
        for (int count = 0; count <= 3; count++) {
            int between = 0, own = 0;
            for (int k = 0; k < count; k++) {
                // What lies on a surface belongs to what is below it.
                between += low <= (double)levels[k] && high > (double)levels[k];
                own += (double)levels[k] == centre;
            }
            assert_int_equal(dip_blend_layer(levels, count, eye, centre, false), 2 * between);
            if (own) {
                const int others = between - (eye > centre);
                assert_int_equal(dip_blend_layer(levels, count, eye, centre, true), 2 * others + 1);
            }
        }
    }
}

// The camera looks along (2, 3, -6) / 7, and its near plane is 0.5 m away.
static void depths_are_whole_parts_of_the_near_planes_distance(void **state) {
    (void)state;
    const DipView view = {
        .eye = {1.0, 2.0, 3.0}, .axis = {[2] = {-2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0}}, .near_m = 0.5};
    Random random = {4};
    for (int i = 0; i < 1000; i++) {
        DipBox box = {.extent = {9.0f, 9.0f, 9.0f}};
        for (int k = 0; k < 3; k++) {
            box.centre[k] = (float)random_real(&random, -50.0, 50.0);
        }
        const double depth =
            (2.0 * ((double)box.centre[0] - 1.0) + 3.0 * ((double)box.centre[1] - 2.0) -
             6.0 * ((double)box.centre[2] - 3.0)) /
            7.0;
        const int64_t steps = dip_blend_depth(&view, &box);
        assert_true(fabs((double)steps - depth * 65536.0 / 0.5) <= 1.0 + 1e-6);
    }
}

static void depths_end_at_two_to_the_62(void **state) {
    (void)state;
    const int64_t most = INT64_C(1) << 62;
    const DipView view = {.axis = {[2] = {0.0, 0.0, 1.0}}, .near_m = 1.0};
    const struct {
        float z;
        int64_t steps;
    } rows[] = {{-0x1p45f, INT64_C(1) << 61},
                {0x1p45f, -(INT64_C(1) << 61)},
                {-0x1p46f, most},
                {0x1p46f, -most},
                {-0x1p47f, most},
                {0x1p47f, -most},
                {-1e38f, most},
                {1e38f, -most},
                {-1.0f, 65536},
                {1.0f, -65536}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const DipBox box = {.centre = {0.0f, 0.0f, rows[i].z}};
        assert_true(dip_blend_depth(&view, &box) == rows[i].steps);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(objects_are_sorted_by_layer_depth_and_index),
        cmocka_unit_test(layers_count_the_water_between_the_eye_and_an_object),
        cmocka_unit_test(depths_are_whole_parts_of_the_near_planes_distance),
        cmocka_unit_test(depths_end_at_two_to_the_62),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
