// Computes the matrices that follow from an object's transform.
#include "renderer/scene/resources/placement.h"

#include <string.h>

// Computes the cofactors of the transform's 3x3 part: the inverse transpose times the determinant.
// The cofactors turn a normal to the same direction as the inverse transpose does, but change its
// length. If the transform mirrors, they also reverse the direction.
static void cofactors(const float t[12], double n[9]) {
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            const float *a = t + 4 * ((r + 1) % 3);
            const float *b = t + 4 * ((r + 2) % 3);
            n[3 * r + c] =
                (double)a[(c + 1) % 3] * b[(c + 2) % 3] - (double)a[(c + 2) % 3] * b[(c + 1) % 3];
        }
    }
}

// Computes the matrix that turns normals to world space. The matrix is scaled until its greatest
// element is +-1. This lets the shader normalise turned normals even if the object is very small or
// very large.
static void set_normal_matrix(const double n[9], bool mirrors, float out[9]) {
    double greatest = 0.0;
    for (int i = 0; i < 9; i++) {
        const double size = n[i] < 0.0 ? -n[i] : n[i];
        greatest = size > greatest ? size : greatest;
    }
    const double scale = greatest > 0.0 ? (mirrors ? -1.0 : 1.0) / greatest : 0.0;
    for (int i = 0; i < 9; i++) {
        out[i] = (float)(n[i] * scale);
    }
}

// Inverts the transform's 3x3 part. The product of the lengths of column c of the transform and of
// row c of the inverse is 1 / the sine of the angle between the column and the plane of the other
// two. If it is greater than 4, the inverse is left 0.
static void set_inverse(const float t[12], const double n[9], double determinant,
                        double inverse[9]) {
    for (int c = 0; c < 3; c++) {
        double column2 = 0.0;
        double row2 = 0.0;
        for (int r = 0; r < 3; r++) {
            inverse[3 * c + r] = n[3 * r + c] / determinant;
            row2 += inverse[3 * c + r] * inverse[3 * c + r];
            column2 += (double)t[4 * r + c] * t[4 * r + c];
        }
        // The comparison is written so that NaN counts as too great.
        if (!(row2 * column2 <= 16.0)) {
            memset(inverse, 0, 9 * sizeof *inverse);
            return;
        }
    }
}

void dip_scene_object_place(DipSceneObject *object, const float transform[12]) {
    memcpy(object->transform, transform, sizeof object->transform);
    double n[9];
    cofactors(transform, n);
    const double determinant = (transform[0] * n[0] + transform[1] * n[1]) + transform[2] * n[2];
    object->mirrors = determinant < 0.0;
    set_normal_matrix(n, object->mirrors, object->normal_to_world);
    set_inverse(transform, n, determinant, object->world_to_object);
}
