// Computes a camera's matrices in double precision.
#include "renderer/scene/view/view.h"

#include "renderer/base/trig.h"

#include <math.h>
#include <stdint.h>

// Computes the rows of world_to_clip from the eye, the axes and the scales.
static void set_matrix(DipView *view) {
    const double scale[4] = {view->scale[0], view->scale[1], 0.0, -1.0};
    const int camera_axis[4] = {0, 1, 0, 2};
    double *m = view->world_to_clip;
    for (int row = 0; row < 4; row++) {
        const double *a = view->axis[camera_axis[row]];
        double shift = 0.0;
        for (int c = 0; c < 3; c++) {
            m[4 * row + c] = scale[row] * a[c];
            shift -= a[c] * view->eye[c];
        }
        m[4 * row + 3] = scale[row] * shift;
    }
    m[11] = view->near_m; // clip z is constant: the distance of the near plane
    for (int i = 0; i < 8; i++) {
        const double shift = view->shift[i / 4];
        m[i] += shift != 0.0 ? shift * m[12 + i % 4] : 0.0;
    }
}

// Copies a quaternion that is not 0, scaled so that its greatest component is between 1 and 2.
// Squares of the components then neither overflow nor vanish. Scaling by a power of two is exact.
static void copy_scaled(const double from[4], double to[4]) {
    const double greatest =
        fmax(fmax(fabs(from[0]), fabs(from[1])), fmax(fabs(from[2]), fabs(from[3])));
    int exponent;
    frexp(greatest, &exponent);
    for (int i = 0; i < 4; i++) {
        to[i] = ldexp(from[i], 1 - exponent);
    }
}

DipView dip_view_make(const DipPose *pose, double near_m, double aspect) {
    double q[4];
    copy_scaled(pose->orientation, q);
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    // A unit quaternion has s = 2.
    const double s = 2.0 / ((x * x + y * y) + (z * z + w * w));
    const double half_fov = pose->fov_y_deg * (3.14159265358979323846 / 360.0);
    const double f = dip_cos(half_fov) / dip_sin(half_fov);
    DipView view = {
        .eye = {pose->position_world[0], pose->position_world[1], pose->position_world[2]},
        // The rows of the world-to-camera rotation are the camera's axes in world space.
        .axis = {{1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)},
                 {s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x)},
                 {s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)}},
        .scale = {f / aspect, f},
        .near_m = near_m,
    };
    set_matrix(&view);
    return view;
}

void dip_view_shift(DipView *view, const double shift[2]) {
    view->shift[0] = shift[0];
    view->shift[1] = shift[1];
    set_matrix(view);
}

static double dot(const double a[3], const double b[3]) {
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

// A point at clip x, y and w lies at eye + w ray, where the ray is x / w / scale[0] along the axis
// x, y / w / scale[1] along the axis y, and -1 along the axis z. The rows of `before` are linear in
// (ray + (eye - its eye) / w), and 1 / w is the depth over the distance of the near plane.
void dip_view_motion(const DipView *now, const DipView *before, float to_before[12]) {
    double moved[3];
    for (int i = 0; i < 3; i++) {
        moved[i] = (now->eye[i] - before->eye[i]) / now->near_m;
    }
    for (int row = 0; row < 3; row++) {
        const double *axis = before->axis[row];
        const double scale = row < 2 ? before->scale[row] : -1.0;
        const double to[4] = {dot(axis, now->axis[0]) / now->scale[0],
                              dot(axis, now->axis[1]) / now->scale[1], -dot(axis, now->axis[2]),
                              dot(axis, moved)};
        for (int i = 0; i < 4; i++) {
            to_before[4 * row + i] = (float)(scale * to[i]);
        }
    }
}

DipView dip_view_mirror(const DipView *view, double level) {
    DipView mirrored = *view;
    mirrored.eye[1] = 2.0 * level - view->eye[1];
    for (int i = 0; i < 3; i++) {
        mirrored.axis[i][1] = -view->axis[i][1];
    }
    set_matrix(&mirrored);
    return mirrored;
}

// Clip x, y and w are multiples of camera x, y and -z, and clip z is constant. So the coefficients
// for x, y and w come from the plane's normal along the camera's axes. The coefficient for z comes
// from the plane's value at the eye.
void dip_view_plane(const DipView *view, const double plane[4], double clip[4]) {
    double along[3];
    double at_eye = plane[3];
    for (int i = 0; i < 3; i++) {
        const double *a = view->axis[i];
        along[i] = (plane[0] * a[0] + plane[1] * a[1]) + plane[2] * a[2];
        at_eye += plane[i] * view->eye[i];
    }
    clip[0] = along[0] / view->scale[0];
    clip[1] = along[1] / view->scale[1];
    clip[2] = at_eye / view->near_m;
    clip[3] = -along[2] - (clip[0] * view->shift[0] + clip[1] * view->shift[1]);
}

// Rounds to a multiple of DIP_ORIGIN_CELL, halves up. Returns 0 if 64 bits cannot hold the factor.
static double round_to_cell(double at) {
    const double cells = at * (1.0 / DIP_ORIGIN_CELL) + 0.5;
    if (!(cells > -9e18 && cells < 9e18)) {
        return 0.0;
    }
    const double towards_zero = (double)(int64_t)cells;
    return DIP_ORIGIN_CELL * (towards_zero > cells ? towards_zero - 1.0 : towards_zero);
}

void dip_view_object_origin(const double eye[3], const float transform[12],
                            const double world_to_object[9], float origin[3]) {
    double from_object[3];
    for (int k = 0; k < 3; k++) {
        from_object[k] = eye[k] - transform[4 * k + 3];
    }
    for (int c = 0; c < 3; c++) {
        const double *row = world_to_object + 3 * c;
        const double in_object =
            (row[0] * from_object[0] + row[1] * from_object[1]) + row[2] * from_object[2];
        origin[c] = (float)round_to_cell(in_object);
    }
}

void dip_view_object_to_clip(const DipView *view, const float transform[12], const float origin[3],
                             double product[16]) {
    const double at_eye[4] = {0.0, 0.0, view->near_m, 0.0};
    dip_object_to_clip(view->world_to_clip, view->eye, at_eye, transform, origin, product);
}

void dip_object_to_clip(const double world_to_clip[16], const double eye[3], const double at_eye[4],
                        const float transform[12], const float origin[3], double product[16]) {
    const double *m = world_to_clip;
    double from_eye[3]; // from the eye to the origin. It is small, and so is its rounding error.
    for (int k = 0; k < 3; k++) {
        const float *t = transform + 4 * k;
        const double moved =
            ((double)t[0] * origin[0] + (double)t[1] * origin[1]) + (double)t[2] * origin[2];
        from_eye[k] = (moved + t[3]) - eye[k];
    }
    for (int row = 0; row < 4; row++) {
        double shift = at_eye[row];
        for (int c = 0; c < 3; c++) {
            double sum = 0.0;
            for (int k = 0; k < 3; k++) {
                sum += m[4 * row + k] * (double)transform[4 * k + c];
            }
            product[4 * row + c] = sum;
            shift += m[4 * row + c] * from_eye[c];
        }
        product[4 * row + 3] = shift;
    }
}
