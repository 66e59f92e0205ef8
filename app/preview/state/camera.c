// Moves and turns the pose of the camera that the user flies.
#include "app/preview/state/camera.h"

#include <math.h>

static const double turn_deg_per_s = 50.0;
static const double degrees_per_rad = 57.295779513082321;
static const double steepest_deg = 89.0;
static const double least_distance_m = 1e-4;
// Cosine of the greatest angle between the horizon and the right axis of a camera that does not lie
// on its side.
static const double level_axis = 0.70710678118654752;

// Writes the normalised product of two quaternions (x, y, z, w). The product turns by b first, then
// by a.
static void multiply(const double a[4], const double b[4], double to[4]) {
    const double product[4] = {
        a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
        a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
        a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
        a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2],
    };
    double length = 0.0;
    for (int i = 0; i < 4; ++i) {
        length += product[i] * product[i];
    }
    for (int i = 0; i < 4; ++i) {
        to[i] = product[i] / sqrt(length);
    }
}

// Turns a vector by a quaternion: v + 2 q x (q x v + w v).
static void rotate(const double q[4], const double v[3], double to[3]) {
    const double t[3] = {q[1] * v[2] - q[2] * v[1] + q[3] * v[0],
                         q[2] * v[0] - q[0] * v[2] + q[3] * v[1],
                         q[0] * v[1] - q[1] * v[0] + q[3] * v[2]};
    to[0] = v[0] + 2.0 * (q[1] * t[2] - q[2] * t[1]);
    to[1] = v[1] + 2.0 * (q[2] * t[0] - q[0] * t[2]);
    to[2] = v[2] + 2.0 * (q[0] * t[1] - q[1] * t[0]);
}

static void axis_turn(int axis, double angle_deg, double q[4]) {
    const double half_rad = angle_deg * 0.5 * 0.017453292519943295;
    q[0] = q[1] = q[2] = 0.0;
    q[axis] = sin(half_rad);
    q[3] = cos(half_rad);
}

bool dip_camera_move(DipPose *pose, const DipCameraKeys *keys, double speed_m_per_s,
                     double seconds) {
    if (keys->right == 0.0 && keys->up == 0.0 && keys->forward == 0.0) {
        return false;
    }
    if (!keys->turn) {
        const double along[3] = {keys->right, keys->up, -keys->forward};
        double world[3];
        rotate(pose->orientation, along, world);
        for (int i = 0; i < 3; ++i) {
            pose->position_world[i] += world[i] * speed_m_per_s * seconds;
        }
        return true;
    }
    const double angle_deg = turn_deg_per_s * seconds;
    double turn[4];
    axis_turn(1, -angle_deg * keys->right, turn);
    multiply(turn, pose->orientation, pose->orientation);
    axis_turn(0, angle_deg * keys->forward, turn);
    multiply(pose->orientation, turn, pose->orientation);
    axis_turn(2, angle_deg * keys->up, turn);
    multiply(pose->orientation, turn, pose->orientation);
    return true;
}

// --- mouse ---------------------------------------------------------------------------------------

// Limits a turn up or down about the camera's right axis, so that the camera does not tip over. A
// camera that is at or beyond the limit can only turn back. If the axis is more than 45 degrees
// above or below the horizon, the camera lies on its side: its line of sight stays within 45
// degrees of the horizon, so nothing can tip over, and it turns freely.
static double limit_up_deg(const DipPose *pose, double up_deg) {
    static const double ahead[3] = {0.0, 0.0, -1.0};
    static const double up[3] = {0.0, 1.0, 0.0};
    double ahead_world[3], up_world[3];
    rotate(pose->orientation, ahead, ahead_world);
    rotate(pose->orientation, up, up_world);
    if (hypot(ahead_world[1], up_world[1]) < level_axis) {
        return up_deg;
    }
    // The angle by which the camera has turned about its axis since it looked level and was
    // upright. If the axis is level, this is the angle of the line of sight above the horizon.
    const double from_deg = degrees_per_rad * atan2(ahead_world[1], up_world[1]);
    const double to_deg = from_deg + up_deg;
    if (fabs(to_deg) <= steepest_deg || fabs(to_deg) < fabs(from_deg)) {
        return up_deg;
    }
    return fabs(from_deg) < steepest_deg ? copysign(steepest_deg, to_deg) - from_deg : 0.0;
}

void dip_camera_look(DipPose *pose, double right_deg, double up_deg) {
    double turn[4];
    axis_turn(0, limit_up_deg(pose, up_deg), turn);
    multiply(pose->orientation, turn, pose->orientation);
    axis_turn(1, -right_deg, turn);
    multiply(turn, pose->orientation, pose->orientation);
}

void dip_camera_orbit(DipPose *pose, const double centre_world[3], double right_deg,
                      double up_deg) {
    const double *q = pose->orientation;
    double offset[3], seen[3];
    multiply(q, (const double[4]){0, 0, 0, 1}, pose->orientation); // Normalises the orientation.
    const double inverse[4] = {-q[0], -q[1], -q[2], q[3]};
    for (int i = 0; i < 3; ++i) {
        offset[i] = centre_world[i] - pose->position_world[i];
    }
    rotate(inverse, offset, seen); // The turn must keep the centre's place in camera space.
    dip_camera_look(pose, right_deg, up_deg);
    rotate(pose->orientation, seen, offset);
    for (int i = 0; i < 3; ++i) {
        pose->position_world[i] = centre_world[i] - offset[i];
    }
}

void dip_camera_zoom(DipPose *pose, const double centre_world[3], double factor) {
    double offset[3], squared = 0.0;
    for (int i = 0; i < 3; ++i) {
        offset[i] = pose->position_world[i] - centre_world[i];
        squared += offset[i] * offset[i];
    }
    if (factor < 1.0 && sqrt(squared) * factor < least_distance_m) {
        return;
    }
    for (int i = 0; i < 3; ++i) {
        pose->position_world[i] = centre_world[i] + factor * offset[i];
    }
}

void dip_camera_point_ahead(const DipPose *pose, const double near_world[3], double least_m,
                            double ahead_world[3]) {
    static const double ahead[3] = {0.0, 0.0, -1.0};
    double sight[3], distance_m = 0.0;
    rotate(pose->orientation, ahead, sight);
    for (int i = 0; i < 3; ++i) {
        distance_m += sight[i] * (near_world[i] - pose->position_world[i]);
    }
    distance_m = fmax(distance_m, least_m);
    for (int i = 0; i < 3; ++i) {
        ahead_world[i] = pose->position_world[i] + distance_m * sight[i];
    }
}
