// Rotates vectors for tests of cameras, by another formula than the code under test uses.
#ifndef DIP_TESTS_RENDERER_SCENE_ROTATE_H
#define DIP_TESTS_RENDERER_SCENE_ROTATE_H

// Sets `to` to a vector that is rotated by a quaternion x, y, z, w of length 1, by the rows of its
// matrix.
static inline void rotate(const double q[4], const double v[3], double to[3]) {
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double rows[3][3] = {
        {1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
        {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
        {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)},
    };
    for (int i = 0; i < 3; i++) {
        to[i] = rows[i][0] * v[0] + rows[i][1] * v[1] + rows[i][2] * v[2];
    }
}

#endif
