// Views and projections in double precision, from operations that IEEE 754 rounds in exactly one
// way.
#include "renderer/shapes/camera.h"

#include "renderer/base/fp_mode.h"
#include "renderer/base/trig.h"

#include <float.h>
#include <math.h>
#include <string.h>

// --- vectors -------------------------------------------------------------------------------------

static bool are_finite(const double *values, int count) {
    for (int i = 0; i < count; i++) {
        if (!isfinite(values[i])) {
            return false;
        }
    }
    return true;
}

static double dot3(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross3(const double a[3], const double b[3], double out[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

// Scales a vector to unit length. It is divided by its largest component first, so that squares
// neither overflow nor vanish. Returns false if the vector is zero.
static bool normalise3(double v[3]) {
    const double largest = fmax(fmax(fabs(v[0]), fabs(v[1])), fabs(v[2]));
    if (largest == 0.0) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        v[i] /= largest;
    }
    const double length = sqrt(dot3(v, v));
    for (int i = 0; i < 3; i++) {
        v[i] /= length;
    }
    return true;
}

// --- cameras -------------------------------------------------------------------------------------

// Sine of the smallest angle between the view and `up` at which rounding does not decide the
// picture's orientation.
static const double least_sine = 0x1p-40;

// Computes the camera's axes in world space: x to the right, y up, z backwards.
static bool find_axes(double axes[3][3], const double eye[3], const double target[3],
                      const double up[3], DipError *err) {
    double upwards[3];
    for (int i = 0; i < 3; i++) {
        axes[2][i] = eye[i] - target[i];
        upwards[i] = up[i];
    }
    if (!are_finite(axes[2], 3) || !normalise3(axes[2])) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "target",
                             "eye and target coincide, or lie too far apart");
    }
    if (!normalise3(upwards)) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "up", "a direction of length 0");
    }
    cross3(upwards, axes[2], axes[0]);
    if (!(dot3(axes[0], axes[0]) >= least_sine * least_sine)) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "up",
                             "parallel to the view, accepted any other direction");
    }
    normalise3(axes[0]);
    cross3(axes[2], axes[0], axes[1]);
    normalise3(axes[1]);
    return true;
}

bool dip_camera_look_at(DipMatrix *view, const double eye[3], const double target[3],
                        const double up[3], DipError *err) {
    DIP_FP_MODE_SCOPE();
    const struct {
        const char *key;
        const double *point;
    } inputs[3] = {{"eye", eye}, {"target", target}, {"up", up}};
    for (int i = 0; i < 3; i++) {
        if (!are_finite(inputs[i].point, 3)) {
            return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, inputs[i].key,
                                 "(%g, %g, %g), accepted finite numbers", inputs[i].point[0],
                                 inputs[i].point[1], inputs[i].point[2]);
        }
    }
    double axes[3][3];
    if (!find_axes(axes, eye, target, up, err)) {
        return false;
    }
    DipMatrix made = dip_matrix_identity();
    for (int r = 0; r < 3; r++) {
        memcpy(&made.m[4 * r], axes[r], sizeof axes[r]);
        made.m[4 * r + 3] = -dot3(axes[r], eye);
    }
    *view = made;
    return true;
}

static bool refuse(DipError *err, const char *key, double found, const char *accepted) {
    return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, key, "%g, accepted %s", found, accepted);
}

bool dip_camera_perspective(DipMatrix *projection, const DipPerspective *lens, DipError *err) {
    DIP_FP_MODE_SCOPE();
    const double near = lens->near_distance;
    const double far = lens->far_distance;
    if (!(lens->fov_deg > 0.0 && lens->fov_deg < 180.0)) {
        return refuse(err, "fov_deg", lens->fov_deg, "degrees above 0 and below 180");
    }
    if (!(lens->aspect > 0.0 && isfinite(lens->aspect))) {
        return refuse(err, "aspect", lens->aspect, "numbers above 0");
    }
    if (!(near >= (double)FLT_MIN && near <= (double)FLT_MAX)) {
        return refuse(err, "near_distance", near, "1.2e-38 to 3.4e38, as floats hold it");
    }
    if (far != 0.0 && !(far > near && isfinite(far))) {
        return refuse(err, "far_distance", far, "numbers above near_distance, or 0");
    }
    // Near 180 degrees, the difference from 180 keeps the precision that the angle has not.
    const double focal = lens->fov_deg > 90.0 ? dip_tan((180.0 - lens->fov_deg) * (DIP_PI / 360.0))
                                              : 1.0 / dip_tan(lens->fov_deg * (DIP_PI / 360.0));
    DipMatrix made = {{0.0}};
    made.m[0] = focal / lens->aspect;
    made.m[5] = focal;
    made.m[10] = far != 0.0 ? near / (far - near) : 0.0;
    made.m[11] = far != 0.0 ? far * (near / (far - near)) : near;
    made.m[14] = -1.0;
    if (!are_finite(made.m, 16)) {
        return refuse(err, "fov_deg", lens->fov_deg, "a field of view with a finite projection");
    }
    *projection = made;
    return true;
}

bool dip_camera_orthographic(DipMatrix *projection, const DipOrthographic *box, DipError *err) {
    DIP_FP_MODE_SCOPE();
    const double width = box->right - box->left;
    const double height = box->top - box->bottom;
    const double depth = box->far_distance - box->near_distance;
    if (!(width > 0.0 && isfinite(width))) {
        return refuse(err, "right", box->right, "finite numbers greater than left");
    }
    if (!(height > 0.0 && isfinite(height))) {
        return refuse(err, "top", box->top, "finite numbers greater than bottom");
    }
    if (!(depth > 0.0 && isfinite(depth))) {
        return refuse(err, "far_distance", box->far_distance,
                      "finite numbers greater than near_distance");
    }
    DipMatrix made = dip_matrix_identity();
    made.m[0] = 2.0 / width;
    made.m[3] = -((box->left + box->right) / width);
    made.m[5] = 2.0 / height;
    made.m[7] = -((box->bottom + box->top) / height);
    made.m[10] = 1.0 / depth;
    made.m[11] = box->far_distance / depth;
    if (!are_finite(made.m, 16)) {
        return refuse(err, "right", box->right, "a box with a finite projection");
    }
    *projection = made;
    return true;
}
