// Computes matrices from a pose and an object's transform.
#include "tests/peer/matrices.h"

#include <math.h>

void dip_peer_world_to_clip(const DipPose *pose, double aspect, double near_m, double m[16]) {
    const double *q = pose->orientation;
    // The camera's right, up and back directions in the world: the axes turned by the quaternion.
    const double right[3] = {1 - 2 * (q[1] * q[1] + q[2] * q[2]), 2 * (q[0] * q[1] + q[3] * q[2]),
                             2 * (q[0] * q[2] - q[3] * q[1])};
    const double up[3] = {2 * (q[0] * q[1] - q[3] * q[2]), 1 - 2 * (q[0] * q[0] + q[2] * q[2]),
                          2 * (q[1] * q[2] + q[3] * q[0])};
    const double back[3] = {2 * (q[0] * q[2] + q[3] * q[1]), 2 * (q[1] * q[2] - q[3] * q[0]),
                            1 - 2 * (q[0] * q[0] + q[1] * q[1])};
    const double f = 1.0 / tan(pose->fov_y_deg * 3.14159265358979323846 / 360.0);
    const double *p = pose->position_world;
    for (int c = 0; c < 3; c++) {
        m[c] = f / aspect * right[c];
        m[4 + c] = f * up[c];
        m[8 + c] = 0.0;
        m[12 + c] = -back[c];
    }
    for (int row = 0; row < 4; row++) {
        m[4 * row + 3] = -(m[4 * row] * p[0] + m[4 * row + 1] * p[1] + m[4 * row + 2] * p[2]);
    }
    m[11] = near_m;
}

void dip_peer_place(const double m[16], const float transform[12], float product[16]) {
    for (int row = 0; row < 4; row++) {
        for (int c = 0; c < 4; c++) {
            double sum = c == 3 ? m[4 * row + 3] : 0.0;
            for (int k = 0; k < 3; k++) {
                sum += m[4 * row + k] * (double)transform[4 * k + c];
            }
            product[4 * row + c] = (float)sum;
        }
    }
}

bool dip_peer_normal_matrix(const float t[12], float normal_to_world[9]) {
    // Cofactors are the determinant times the inverse transpose.
    double cofactor[9];
    double greatest = 0.0;
    for (int r = 0; r < 3; r++) {
        const float *a = t + 4 * ((r + 1) % 3);
        const float *b = t + 4 * ((r + 2) % 3);
        for (int c = 0; c < 3; c++) {
            const int i = (c + 1) % 3;
            const int j = (c + 2) % 3;
            cofactor[3 * r + c] = (double)a[i] * b[j] - (double)a[j] * b[i];
            greatest = fmax(greatest, fabs(cofactor[3 * r + c]));
        }
    }
    const double determinant = t[0] * cofactor[0] + t[1] * cofactor[1] + t[2] * cofactor[2];
    const double scale = greatest > 0.0 ? (determinant < 0.0 ? -1.0 : 1.0) / greatest : 0.0;
    for (int i = 0; i < 9; i++) {
        normal_to_world[i] = (float)(cofactor[i] * scale);
    }
    return determinant < 0.0;
}

bool dip_peer_box_visible(const float to_clip[16], const float min[3], const float max[3]) {
    // Number of corners outside the left, right, lower, upper and near plane.
    int outside[5] = {0};
    for (int corner = 0; corner < 8; corner++) {
        const float p[3] = {corner & 1 ? max[0] : min[0], corner & 2 ? max[1] : min[1],
                            corner & 4 ? max[2] : min[2]};
        float clip[4];
        for (int row = 0; row < 4; row++) {
            const float *m = to_clip + 4 * row;
            clip[row] = m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3];
        }
        outside[0] += clip[0] < -clip[3];
        outside[1] += clip[0] > clip[3];
        outside[2] += clip[1] < -clip[3];
        outside[3] += clip[1] > clip[3];
        outside[4] += clip[2] > clip[3];
    }
    for (int plane = 0; plane < 5; plane++) {
        if (outside[plane] == 8) {
            return false;
        }
    }
    return true;
}
