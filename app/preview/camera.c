// Moves and turns the pose of the camera that the user flies.
#include "app/preview/camera.h"

#include <math.h>

static const double turn_deg_per_s = 50.0;

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
