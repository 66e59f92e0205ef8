// Tests the small steps of the camera that the catalogue measures pictures by: a point that the
// camera sees moves on the screen by as many pixels, and in the direction, that motion.h states.
#include "renderer/catalogue/motion.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "rotate.h"

static const double pi = 3.14159265358979323846;
enum { HEIGHT = 480 };
static const double distance_m = 7.0;

static const DipPose poses[] = {
    {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}, 60.0},
    {{3.0, -2.0, 9.0}, {0.5, 0.5, 0.5, 0.5}, 40.0},
    {{-100.0, 1.7, 4.0}, {0.36, 0.48, -0.48, 0.64}, 90.0}, // Of length 1.
};

// Sets `world` to the point that a pose sees at (x, y), in pixels right of and above the picture's
// middle, and at distance_m along the direction that it looks in.
static void point_of(const DipPose *pose, double x, double y, double world[3]) {
    const double pixel = 2.0 * tan(pose->fov_y_deg * pi / 360.0) / HEIGHT;
    const double seen[3] = {x * pixel * distance_m, y * pixel * distance_m, -distance_m};
    rotate(pose->orientation, seen, world);
    for (int i = 0; i < 3; i++) {
        world[i] += pose->position_world[i];
    }
}

// Sets `seen` to the place of a point on the screen, in pixels right of and above the picture's
// middle, and to how far it lies ahead of the camera, in metres.
static void see(const DipPose *pose, const double world[3], double seen[3]) {
    const double *q = pose->orientation;
    const double back[4] = {-q[0], -q[1], -q[2], q[3]};
    const double from[3] = {world[0] - pose->position_world[0], world[1] - pose->position_world[1],
                            world[2] - pose->position_world[2]};
    double camera[3];
    rotate(back, from, camera);
    const double pixel = 2.0 * tan(pose->fov_y_deg * pi / 360.0) / HEIGHT;
    seen[0] = camera[0] / -camera[2] / pixel;
    seen[1] = camera[1] / -camera[2] / pixel;
    seen[2] = -camera[2];
}

static void points_move_as_far_as_stated(void **state) {
    (void)state;
    // Where the point lies before the step, and by how many steps it moves. Turning the camera to
    // the left or up moves the point to the right or down; so does moving it to the left or down.
    static const struct {
        double at[2];
        double moves[2];
    } points[MOTION_KINDS] = {
        [MOTION_YAW] = {{0.0, 0.0}, {1.0, 0.0}},
        [MOTION_PITCH] = {{0.0, 0.0}, {0.0, -1.0}},
        [MOTION_ROLL] = {{HEIGHT / 2.0, 0.0}, {0.0, -1.0}},
        [MOTION_SIDEWAYS] = {{0.0, 0.0}, {-1.0, 0.0}},
        [MOTION_UP] = {{0.0, 0.0}, {0.0, -1.0}},
        [MOTION_FORWARD] = {{0.0, 0.0}, {0.0, 0.0}},
    };
    for (size_t p = 0; p < sizeof poses / sizeof *poses; p++) {
        const double pixel = 2.0 * tan(poses[p].fov_y_deg * pi / 360.0) / HEIGHT;
        for (int k = 0; k < MOTION_KINDS; k++) {
            const MotionStep step = {(MotionKind)k, 0.25, HEIGHT, distance_m};
            const DipPose moved = motion_move(&poses[p], &step);
            double world[3], seen[3], length = 0.0;
            point_of(&poses[p], points[k].at[0], points[k].at[1], world);
            see(&moved, world, seen);
            for (int i = 0; i < 4; i++) {
                length += moved.orientation[i] * moved.orientation[i];
            }
            // Angles are small, so that their tangents and sines differ from them by 1e-6 or less.
            for (int i = 0; i < 2; i++) {
                const double wanted = points[k].at[i] + points[k].moves[i] * step.step_px;
                assert_true(fabs(seen[i] - wanted) < 5e-4);
            }
            const double ahead = k == MOTION_FORWARD ? step.step_px * pixel * distance_m : 0.0;
            assert_true(fabs(distance_m - ahead - seen[2]) < 1e-4);
            assert_true(fabs(length - 1.0) < 1e-12);
            assert_true(moved.fov_y_deg == poses[p].fov_y_deg); // NOLINT: it is copied.
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(points_move_as_far_as_stated)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
