// Tests the rectangle of the picture that boxes and triangles touch. The truth is their points:
// many of them are projected one by one, and every pixel is asked whether the rectangle touches it.
// In the other tests a simple camera and integers make each coordinate exact.
#include "renderer/scene/view/extent.h"
#include "tests/renderer/scene/random_view.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

// Clip x and y are the world's, clip w is the world's z, and the near plane is z = 1.
static const DipView simple_view = {
    .near_m = 1.0, .world_to_clip = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0}};

static void assert_extent(const DipExtent *extent, double min_x, double min_y, double max_x,
                          double max_y) {
    assert_true(extent->min[0] == min_x && extent->min[1] == min_y);
    assert_true(extent->max[0] == max_x && extent->max[1] == max_y);
}

static void assert_empty(const DipExtent *extent) {
    const DipExtent none = dip_extent_none();
    assert_extent(extent, none.min[0], none.min[1], none.max[0], none.max[1]);
}

// Adds a shape of three or eight corners.
static void add_shape(DipExtent *extent, const DipView *view, int count,
                      const double (*corners)[3]) {
    if (count == 8) {
        dip_extent_add_box(extent, view, corners);
    } else {
        dip_extent_add_triangle(extent, view, corners);
    }
}

static DipExtent extent_of(int count, const double (*corners)[3]) {
    DipExtent extent = dip_extent_none();
    add_shape(&extent, &simple_view, count, corners);
    return extent;
}

static void a_point_is_projected_by_the_rows_x_y_and_w(void **state) {
    (void)state;
    DipView view = {.near_m = 1.0};
    for (int i = 0; i < 16; i++) {
        view.world_to_clip[i] = (i * 7 + 3) % 16;
    }
    static const double world[3] = {5.0, -11.0, 13.0};
    double clip[3];
    dip_extent_project(&view, world, clip);
    for (int r = 0; r < 3; r++) {
        const int row = r == 2 ? 3 : r;
        int sum = (4 * row + 3) * 7 + 3;
        sum %= 16;
        for (int k = 0; k < 3; k++) {
            sum += ((4 * row + k) * 7 + 3) % 16 * (int)world[k];
        }
        assert_true(clip[r] == sum);
    }
}

// --- random shapes -------------------------------------------------------------------------------

// Widens `bounds` to a point, given in clip space, and returns whether the picture shows the point.
static bool add_point(const double clip[3], DipExtent *bounds) {
    bool shown = true;
    for (int axis = 0; axis < 2; axis++) {
        const double at = clip[axis] / clip[2];
        bounds->min[axis] = fmin(bounds->min[axis], at);
        bounds->max[axis] = fmax(bounds->max[axis], at);
        shown = shown && fabs(at) <= 1.0;
    }
    return shown;
}

// Finds the rectangle around all that lies beyond the near plane. It is spanned by the corners
// there, and by the points where the straight lines between any two corners cross the plane. These
// are found by bisection.
static DipExtent bounds_of(const DipView *view, int count, const double (*corners)[3]) {
    DipExtent bounds = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (int i = 0; i < count * count; i++) {
        double in[3], out[3]; // the ends that lie beyond the plane and before it
        dip_extent_project(view, corners[i / count], in);
        dip_extent_project(view, corners[i % count], out);
        if (in[2] < view->near_m) {
            continue;
        }
        add_point(in, &bounds);
        for (int step = 0; step < 60 && out[2] < view->near_m; step++) {
            double middle[3];
            for (int c = 0; c < 3; c++) {
                middle[c] = 0.5 * (in[c] + out[c]);
            }
            memcpy(middle[2] < view->near_m ? out : in, middle, sizeof middle);
        }
        add_point(in, &bounds);
    }
    return bounds;
}

// Checks that an extent is the part of a rectangle that lies within the picture.
static void assert_part_in_picture(const DipExtent *extent, const DipExtent *bounds) {
    const bool outside = bounds->min[0] > 1.0 || bounds->max[0] < -1.0 || bounds->min[1] > 1.0 ||
                         bounds->max[1] < -1.0 || bounds->min[0] > bounds->max[0];
    if (outside) {
        assert_empty(extent);
        return;
    }
    for (int axis = 0; axis < 2; axis++) {
        assert_true(fabs(extent->min[axis] - fmax(bounds->min[axis], -1.0)) < 1e-9);
        assert_true(fabs(extent->max[axis] - fmin(bounds->max[axis], 1.0)) < 1e-9);
    }
}

// Projects points of a shape, which may be a triangle or a box of any slant, and checks that those
// that the picture shows lie in the extent. Returns how many it shows.
static int check_points(const DipView *view, int count, const double (*corners)[3],
                        const DipExtent *extent) {
    enum { STEPS = 6 };
    int shown = 0;
    for (int i = 0; i < (STEPS + 1) * (STEPS + 1) * (STEPS + 1); i++) {
        const int along[3] = {i % (STEPS + 1), i / (STEPS + 1) % (STEPS + 1),
                              i / ((STEPS + 1) * (STEPS + 1))};
        if (count == 3 && (along[2] || along[0] + along[1] > STEPS)) {
            continue;
        }
        double world[3], clip[3];
        for (int c = 0; c < 3; c++) {
            world[c] = corners[0][c];
            for (int k = 0; k < (count == 3 ? 2 : 3); k++) {
                const double end = count == 3 ? corners[k + 1][c] : corners[1 << k][c];
                world[c] += (end - corners[0][c]) * along[k] / STEPS;
            }
        }
        dip_extent_project(view, world, clip);
        DipExtent wide = *extent;
        if (clip[2] >= view->near_m && add_point(clip, &wide)) {
            for (int axis = 0; axis < 2; axis++) {
                assert_true(extent->min[axis] - wide.min[axis] < 1e-9);
                assert_true(wide.max[axis] - extent->max[axis] < 1e-9);
            }
            shown++;
        }
    }
    return shown;
}

static void the_extent_is_what_the_shape_spans_in_the_picture(void **state) {
    (void)state;
    enum { SHAPES = 4000 };
    Random random = {61};
    int shown = 0, cut = 0;
    for (int i = 0; i < SHAPES; i++) {
        const DipView view = random_view(&random, 1.5);
        const int count = i % 2 ? 3 : 8;
        const double size = pow(10.0, random_real(&random, -0.5, 2.0));
        double way[4][3], corners[8][3];
        for (int k = 0; k < 12; k++) {
            way[k / 3][k % 3] = k < 9 ? random_real(&random, -size, size)
                                      : view.eye[k % 3] + random_real(&random, -size, size);
        }
        int before = 0;
        for (int k = 0; k < count; k++) {
            double clip[3];
            for (int c = 0; c < 3; c++) {
                corners[k][c] = way[3][c] + (k & 1 ? way[0][c] : 0.0) + (k & 2 ? way[1][c] : 0.0) +
                                (k & 4 ? way[2][c] : 0.0);
            }
            dip_extent_project(&view, corners[k], clip);
            before += clip[2] < view.near_m;
        }
        DipExtent extent = dip_extent_none();
        add_shape(&extent, &view, count, (const double(*)[3])corners);
        const DipExtent bounds = bounds_of(&view, count, (const double(*)[3])corners);
        assert_part_in_picture(&extent, &bounds);
        shown += check_points(&view, count, (const double(*)[3])corners, &extent);
        cut += before > 0 && before < count;
    }
    assert_true(shown > 50 * SHAPES / 10 && cut > SHAPES / 5);
}

// --- exact borders -------------------------------------------------------------------------------

// Corners at the distance of the near plane itself count as visible. Each of the corners 0 and 7 of
// the first two boxes alone spans two sides of the extent.
static void corners_on_the_near_plane_are_in_the_extent(void **state) {
    (void)state;
    const double behind = 0.5;
    const double first_on_plane[8][3] = {{-0.75, -0.5, 1}, {0.5, 0.25, 2}, {0.5, 0.25, 2},
                                         {0.5, 0.25, 2},   {0.5, 0.25, 2}, {0.5, 0.25, 2},
                                         {0.5, 0.25, 2},   {0.5, 0.25, 2}};
    const double last_on_plane[8][3] = {{0.5, 0.25, 2}, {0.5, 0.25, 2},  {0.5, 0.25, 2},
                                        {0.5, 0.25, 2}, {0.5, 0.25, 2},  {0.5, 0.25, 2},
                                        {0.5, 0.25, 2}, {-0.75, -0.5, 1}};
    const double on_plane[3][3] = {{-0.75, -0.5, 1}, {0.5, 0.25, 1}, {0.25, 0.5, 1}};
    const double before[3][3] = {{-0.75, -0.5, behind}, {0.5, 0.25, behind}, {0.25, 0.5, -1}};
    DipExtent extent = extent_of(8, first_on_plane);
    assert_extent(&extent, -0.75, -0.5, 0.25, 0.125);
    extent = extent_of(8, last_on_plane);
    assert_extent(&extent, -0.75, -0.5, 0.25, 0.125);
    extent = extent_of(3, on_plane);
    assert_extent(&extent, -0.75, -0.5, 0.5, 0.5);
    extent = extent_of(3, before);
    assert_empty(&extent);
}

// An edge from z = 0 to z = 4 crosses the plane z = 1 after a quarter of the way, wherever the
// camera is: at the point (0.25, -0.5) here.
static void an_edge_is_cut_where_it_crosses_the_near_plane(void **state) {
    (void)state;
    const double corners[3][3] = {{0, 0, 0}, {1, -2, 4}, {1, -2, 4}};
    for (int first = 0; first < 3; first++) {
        double turned[3][3];
        for (int k = 0; k < 3; k++) {
            memcpy(turned[k], corners[(first + k) % 3], sizeof turned[k]);
        }
        const DipExtent extent = extent_of(3, (const double(*)[3])turned);
        assert_extent(&extent, 0.25, -0.5, 0.25, -0.5);
    }
}

// Moves a triangle of half the picture's width towards each side of the picture. The triangle that
// touches the side from outside has that side in common with the picture, and a further one has
// nothing.
static void a_shape_that_touches_the_border_of_the_picture_is_in_it(void **state) {
    (void)state;
    for (int side = 0; side < 4; side++) {
        const int axis = side / 2;
        const double sign = side % 2 ? 1.0 : -1.0;
        for (int step = 0; step < 3; step++) {
            // The nearer corners are inside the picture, on its border, and outside.
            static const double near_border[3] = {0.75, 1.0, 1.0 + DBL_EPSILON};
            double corners[3][3];
            for (int k = 0; k < 3; k++) {
                corners[k][axis] = sign * (near_border[step] + (k == 2 ? 1.0 : 0.0));
                corners[k][!axis] = 0.25 * k;
                corners[k][2] = 1.0;
            }
            const DipExtent extent = extent_of(3, (const double(*)[3])corners);
            double min[2] = {0.0, 0.0}, max[2] = {0.5, 0.5};
            min[axis] = sign > 0.0 ? near_border[step] : -1.0;
            max[axis] = sign > 0.0 ? 1.0 : -near_border[step];
            if (step < 2) {
                assert_extent(&extent, min[0], min[1], max[0], max[1]);
            } else {
                assert_empty(&extent);
            }
        }
    }
}

static void the_extent_of_two_shapes_holds_both(void **state) {
    (void)state;
    const double shapes[4][3][3] = {{{0.25, 0.5, 1}, {0.5, 0.5, 1}, {0.5, 0.75, 1}},
                                    {{-0.5, -0.25, 1}, {-0.25, -0.25, 1}, {-0.25, 0.0, 1}},
                                    {{-3.0, 0.0, 1}, {-2.0, 0.0, 1}, {-2.0, 0.5, 1}},
                                    {{0.0, 0.0, 1}, {0.0, 0.0, 1}, {0.0, 0.0, 1}}};
    for (int order = 0; order < 2; order++) {
        DipExtent extent = dip_extent_none();
        for (int i = 0; i < 4; i++) {
            add_shape(&extent, &simple_view, 3, shapes[order ? 3 - i : i]);
        }
        assert_extent(&extent, -0.5, -0.25, 0.5, 0.75);
    }
}

// --- pixels --------------------------------------------------------------------------------------

// Returns whether pixel i, the range i <= x < i + 1, is within `margin` of a range of coordinates.
// A range that only touches the border of the picture from outside has no pixel there.
static bool touches(double from, double to, int margin, int i) {
    return to + margin > 0.0 && from - margin < i + 1 && to + margin >= i;
}

// Takes ranges with ends at borders of pixels and between them, in a picture of 16 x 8 pixels. Each
// pixel must be in the region if and only if the range touches it in both directions.
static void a_region_has_the_pixels_that_the_extent_touches(void **state) {
    (void)state;
    enum { W = 16, H = 8, PLACES = 9, RANGES = PLACES * PLACES };
    static const double place_x[PLACES] = {0, 0.5, 1, 1.5, 8, 8.25, 15, 15.5, 16};
    static const double place_y[PLACES] = {0, 0.25, 1, 3.5, 4, 6.5, 7, 7.75, 8};
    for (int i = 0; i < RANGES * RANGES * 3; i++) {
        const int margin = i / (RANGES * RANGES);
        const double x[2] = {place_x[i % PLACES], place_x[i / PLACES % PLACES]};
        const double y[2] = {place_y[i / RANGES % PLACES], place_y[i / RANGES / PLACES % PLACES]};
        const DipExtent extent = {{x[0] / W * 2.0 - 1.0, 1.0 - y[1] / H * 2.0},
                                  {x[1] / W * 2.0 - 1.0, 1.0 - y[0] / H * 2.0}};
        const bool ordered = x[0] <= x[1] && y[0] <= y[1];
        DipTargetRegion region;
        const bool found = dip_extent_region(&extent, W, H, margin, &region);
        if (!found) {
            region = (DipTargetRegion){0, 0, 0, 0};
        }
        assert_true(region.x0 >= 0 && region.y0 >= 0 && region.x1 <= W && region.y1 <= H);
        bool any = false;
        for (int p = 0; p < W * H; p++) {
            const int px = p % W, py = p / W;
            const bool in = px >= region.x0 && px < region.x1 && py >= region.y0 && py < region.y1;
            assert_int_equal(in, ordered && touches(x[0], x[1], margin, px) &&
                                     touches(y[0], y[1], margin, py));
            any = any || in;
        }
        assert_int_equal(found, any);
    }
}

static void the_empty_extent_has_no_pixel(void **state) {
    (void)state;
    const DipExtent none = dip_extent_none();
    DipTargetRegion region;
    assert_false(dip_extent_region(&none, 16, 8, 0, &region));
    assert_false(dip_extent_region(&none, 16, 8, 100, &region));
}

// A transform with a shear, a mirrored axis and a shift, of a box whose centre is not 0.
static void a_box_has_the_corners_of_its_axes(void **state) {
    (void)state;
    static const float transform[12] = {2, 3, -5, 7, 11, -13, 17, 19, 23, 29, 31, -37};
    const DipBox box = {.centre = {41, -43, 47}, .extent = {3, 5, 2}};
    double corners[9][3] = {[8] = {1, 2, 3}};
    dip_extent_box_corners(transform, &box, corners);
    assert_true(corners[8][0] == 1 && corners[8][1] == 2 && corners[8][2] == 3);
    for (int corner = 0; corner < 8; corner++) {
        const int at[3] = {corner & 1 ? 44 : 38, corner & 2 ? -38 : -48, corner & 4 ? 49 : 45};
        const int world[3] = {2 * at[0] + 3 * at[1] - 5 * at[2] + 7,
                              11 * at[0] - 13 * at[1] + 17 * at[2] + 19,
                              23 * at[0] + 29 * at[1] + 31 * at[2] - 37};
        for (int axis = 0; axis < 3; axis++) {
            assert_true(corners[corner][axis] == world[axis]);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_point_is_projected_by_the_rows_x_y_and_w),
        cmocka_unit_test(the_extent_is_what_the_shape_spans_in_the_picture),
        cmocka_unit_test(corners_on_the_near_plane_are_in_the_extent),
        cmocka_unit_test(an_edge_is_cut_where_it_crosses_the_near_plane),
        cmocka_unit_test(a_shape_that_touches_the_border_of_the_picture_is_in_it),
        cmocka_unit_test(the_extent_of_two_shapes_holds_both),
        cmocka_unit_test(a_region_has_the_pixels_that_the_extent_touches),
        cmocka_unit_test(the_empty_extent_has_no_pixel),
        cmocka_unit_test(a_box_has_the_corners_of_its_axes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
