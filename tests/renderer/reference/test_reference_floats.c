// Tests the difference that float planes make (internal/differences.h): none to speak of on
// triangles that are seen from the front, and garbage on slivers that are seen edge-on.
#include "renderer/reference/internal/differences.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

// Makes a triangle in a picture of 256 x 256 pixels. x, y: in pixels.
static DipRefTriangle make_triangle(const double x[3], const double y[3], const double w[3],
                                    const double u[3]) {
    DipRefTriangle triangle = {.max_x = 255, .max_y = 255};
    for (int i = 0; i < 3; i++) {
        triangle.vertices[i] =
            (DipRefVertex){.x = 256.0 * x[i], .y = 256.0 * y[i], .inv_w = 1.0 / w[i]};
        triangle.vertices[i].varyings[DIP_REF_U0] = u[i];
    }
    const DipRefVertex *v = triangle.vertices;
    triangle.area = (v[1].x - v[0].x) * (v[2].y - v[0].y) - (v[1].y - v[0].y) * (v[2].x - v[0].x);
    return triangle;
}

// Interpolates u at the middle of a triangle.
static DipRefVaryings interpolate(const DipRefTriangle *triangle, bool in_floats) {
    DipRefTriangle copy = *triangle;
    copy.in_floats = in_floats;
    const DipRefVertex *v = copy.vertices;
    const double third = copy.area / 3.0;
    const DipRefPosition place = {&copy,
                                  {third, third, third},
                                  (v[0].x + v[1].x + v[2].x) / 3.0,
                                  (v[0].y + v[1].y + v[2].y) / 3.0};
    DipRefVaryings varyings = {.depth_change = 0.0};
    dip_reference_interpolate(&place, DIP_REF_U0, 1, true, &varyings);
    return varyings;
}

static void a_triangle_seen_from_the_front_stays_as_it_is(void **state) {
    (void)state;
    const DipRefTriangle triangle =
        make_triangle((const double[3]){10.0, 200.0, 40.0}, (const double[3]){20.0, 60.0, 230.0},
                      (const double[3]){1.0, 3.0, 2.0}, (const double[3]){1000.25, 1001.5, 999.0});
    const DipRefVaryings exact = interpolate(&triangle, false);
    const DipRefVaryings floats = interpolate(&triangle, true);
    assert_true(fabs(floats.value[DIP_REF_U0] - exact.value[DIP_REF_U0]) < 1e-5);
    assert_true(fabs(floats.ddx[DIP_REF_U0] - exact.ddx[DIP_REF_U0]) < 1e-6);
    assert_true(fabs(floats.ddy[DIP_REF_U0] - exact.ddy[DIP_REF_U0]) < 1e-6);
    assert_true(floats.value[DIP_REF_U0] != exact.value[DIP_REF_U0]);
}

// 1/w changes by more than 1000 per pixel across the sliver. Its coordinate is constant.
static void a_sliver_seen_edge_on_gets_derivatives(void **state) {
    (void)state;
    const DipRefTriangle triangle =
        make_triangle((const double[3]){105.59765625, 127.484375, 120.25},
                      (const double[3]){49.6875, 125.57421875, 100.5078125},
                      (const double[3]){0.125, 0.125, 7.75}, (const double[3]){0.6, 0.6, 0.6});
    const DipRefVaryings exact = interpolate(&triangle, false);
    const DipRefVaryings floats = interpolate(&triangle, true);
    assert_true(fabs(exact.value[DIP_REF_U0] - 0.6) < 1e-9);
    assert_true(fabs(exact.ddx[DIP_REF_U0]) < 1e-9);
    assert_true(fabs(floats.value[DIP_REF_U0] - 0.6) < 0.01);
    assert_true(fabs(floats.ddx[DIP_REF_U0]) > 0.001);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_triangle_seen_from_the_front_stays_as_it_is),
        cmocka_unit_test(a_sliver_seen_edge_on_gets_derivatives),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
