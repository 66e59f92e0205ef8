// Checks poses.
#include "renderer/scene/pose.h"

#include "renderer/base/fp_mode.h"

#include <math.h>

static bool are_finite(const double *values, int count) {
    for (int i = 0; i < count; i++) {
        if (!isfinite(values[i])) {
            return false;
        }
    }
    return true;
}

bool dip_pose_check(const DipPose *pose, DipError *err) {
    DIP_FP_MODE_SCOPE();
    const double *q = pose->orientation;
    if (!are_finite(pose->position_world, 3) || !are_finite(q, 4) || !isfinite(pose->fov_y_deg)) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "pose",
                             "a number is not finite, accepted finite numbers");
    }
    if (q[0] == 0.0 && q[1] == 0.0 && q[2] == 0.0 && q[3] == 0.0) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "pose",
                             "the orientation is 0, accepted a quaternion of any other length");
    }
    return (pose->fov_y_deg >= 1.0 && pose->fov_y_deg <= 170.0) ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "pose",
                         "a field of view of %g degrees is out of range, accepted 1..170",
                         pose->fov_y_deg);
}
