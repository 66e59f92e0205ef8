// Matrices in double precision, from operations that IEEE 754 rounds in exactly one way.
#include "renderer/shapes/camera.h"

#include "renderer/base/fp_mode.h"
#include "renderer/base/trig.h"

#include <math.h>
#include <string.h>

DipMatrix dip_matrix_identity(void) {
    return dip_matrix_scaling(1.0, 1.0, 1.0);
}

DipMatrix dip_matrix_scaling(double x, double y, double z) {
    return (DipMatrix){{x, 0.0, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, 0.0, z, 0.0, 0.0, 0.0, 0.0, 1.0}};
}

DipMatrix dip_matrix_to_map(void) {
    return (DipMatrix){
        {0.5, 0.0, 0.0, 0.5, 0.0, -0.5, 0.0, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0}};
}

DipMatrix dip_matrix_translation(double x, double y, double z) {
    DipMatrix made = dip_matrix_identity();
    made.m[3] = x;
    made.m[7] = y;
    made.m[11] = z;
    return made;
}

DipMatrix dip_matrix_rotation(int axis, double angle_rad) {
    DipMatrix made = dip_matrix_identity();
    if (axis < 0 || axis > 2) {
        return made;
    }
    const double sine = dip_sin(angle_rad);
    const double cosine = dip_cos(angle_rad);
    const int a = (axis + 1) % 3; // turns towards b
    const int b = (axis + 2) % 3;
    made.m[4 * a + a] = cosine;
    made.m[4 * b + b] = cosine;
    made.m[4 * a + b] = -sine;
    made.m[4 * b + a] = sine;
    return made;
}

DipMatrix dip_matrix_reflection(const double normal[3], double distance) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(distance);
    DipMatrix made = dip_matrix_identity();
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            made.m[4 * r + c] -= 2.0 * (normal[r] * normal[c]);
        }
        made.m[4 * r + 3] = 2.0 * (normal[r] * distance);
    }
    DIP_FP_PIN_STRUCT(made);
    return made;
}

static void multiply(DipMatrix *out, const DipMatrix *a, const DipMatrix *b) {
    for (int r = 0; r < 4; r++) {
        const double *row = &a->m[4 * r];
        for (int c = 0; c < 4; c++) {
            out->m[4 * r + c] = row[0] * b->m[c] + row[1] * b->m[4 + c] + row[2] * b->m[8 + c] +
                                row[3] * b->m[12 + c];
        }
    }
}

DipMatrix dip_matrix_multiply(const DipMatrix *a, const DipMatrix *b) {
    DIP_FP_MODE_SCOPE();
    DipMatrix made;
    multiply(&made, a, b);
    DIP_FP_PIN_STRUCT(made);
    return made;
}

DipMatrix dip_matrix_multiply3(const DipMatrix *a, const DipMatrix *b, const DipMatrix *c) {
    const DipMatrix ab = dip_matrix_multiply(a, b);
    return dip_matrix_multiply(&ab, c);
}

// --- inverses ------------------------------------------------------------------------------------

// Smallest pivot of a matrix whose rows and columns have been scaled to about 1. Smaller ones are
// what rounding leaves of a zero.
static const double least_pivot = 0x1p-48;

// A matrix A that is being inverted. Row operations turn `left` into the identity and `right` into
// the inverse of the scaled matrix R A C P, with R and C diagonal matrices of powers of two and P a
// permutation of columns.
typedef struct Elimination {
    double left[4][4];
    double right[4][4];
    int row_exponent[4]; // R has 2^-row_exponent
    int column_exponent[4];
    int column[4]; // the column of A that stands in each column of `left`
} Elimination;

// Returns the binary exponent of the largest of four numbers that lie `step` apart; 0 if all are 0.
static int exponent_of(const double *first, int step) {
    double largest = 0.0;
    for (int i = 0; i < 4; i++) {
        largest = fmax(largest, fabs(first[i * step]));
    }
    int exponent = 0;
    frexp(largest, &exponent);
    return exponent;
}

static void scale(Elimination *e) {
    for (int r = 0; r < 4; r++) {
        e->row_exponent[r] = exponent_of(e->left[r], 1);
        for (int c = 0; c < 4; c++) {
            e->left[r][c] = ldexp(e->left[r][c], -e->row_exponent[r]);
        }
    }
    for (int c = 0; c < 4; c++) {
        e->column_exponent[c] = exponent_of(&e->left[0][c], 4);
        for (int r = 0; r < 4; r++) {
            e->left[r][c] = ldexp(e->left[r][c], -e->column_exponent[c]);
        }
    }
}

static void swap_rows(double rows[4][4], int a, int b) {
    double kept[4];
    memcpy(kept, rows[a], sizeof kept);
    memmove(rows[a], rows[b], sizeof kept);
    memcpy(rows[b], kept, sizeof kept);
}

static void swap_columns(Elimination *e, int a, int b) {
    for (int r = 0; r < 4; r++) {
        const double kept = e->left[r][a];
        e->left[r][a] = e->left[r][b];
        e->left[r][b] = kept;
    }
    const int column = e->column[a];
    e->column[a] = e->column[b];
    e->column[b] = column;
}

// Brings the largest of the elements that are left to row and column c, so that rounding errors do
// not grow. Returns false if they are all 0.
static bool choose_pivot(Elimination *e, int c) {
    int row = c;
    int column = c;
    for (int r = c; r < 4; r++) {
        for (int k = c; k < 4; k++) {
            if (fabs(e->left[r][k]) > fabs(e->left[row][column])) {
                row = r;
                column = k;
            }
        }
    }
    swap_rows(e->left, c, row);
    swap_rows(e->right, c, row);
    swap_columns(e, c, column);
    return fabs(e->left[c][c]) >= least_pivot;
}

// Makes column c of `left` that of the identity.
static void eliminate(Elimination *e, int c) {
    const double divisor = e->left[c][c];
    for (int k = 0; k < 4; k++) {
        e->left[c][k] /= divisor;
        e->right[c][k] /= divisor;
    }
    for (int r = 0; r < 4; r++) {
        const double factor = e->left[r][c];
        for (int k = 0; k < 4 && r != c; k++) {
            e->left[r][k] -= factor * e->left[c][k];
            e->right[r][k] -= factor * e->right[c][k];
        }
    }
}

static bool are_finite(const double *values, int count) {
    for (int i = 0; i < count; i++) {
        if (!isfinite(values[i])) {
            return false;
        }
    }
    return true;
}

static bool invert(double out[16], const double matrix[16]) {
    if (!are_finite(matrix, 16)) {
        return false;
    }
    Elimination e = {.right = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}},
                     .column = {0, 1, 2, 3}};
    memcpy(e.left, matrix, sizeof e.left);
    scale(&e);
    for (int c = 0; c < 4; c++) {
        if (!choose_pivot(&e, c)) {
            return false;
        }
        eliminate(&e, c);
    }
    // The inverse of A is C P times the inverse of R A C P times R.
    for (int r = 0; r < 4; r++) {
        for (int c = 0; c < 4; c++) {
            const int to = e.column[r];
            out[4 * to + c] = ldexp(e.right[r][c], -e.column_exponent[to] - e.row_exponent[c]);
        }
    }
    return are_finite(out, 16);
}

bool dip_matrix_invert(DipMatrix *inverse, const DipMatrix *matrix, DipError *err) {
    DIP_FP_MODE_SCOPE();
    double made[16];
    if (!invert(made, matrix->m)) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "matrix",
                             "a matrix that has no inverse or is not finite");
    }
    memcpy(inverse->m, made, sizeof made);
    return true;
}

// Returns e for which the largest of the upper left 3x3 elements has a magnitude of 2^e to 2^(e+1).
static int largest_exponent(const double matrix[16]) {
    double largest = 0.0;
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            largest = fmax(largest, fabs(matrix[4 * r + c]));
        }
    }
    int exponent = 0;
    frexp(largest, &exponent);
    return exponent - 1;
}

bool dip_matrix_normals(float normals[9], const DipMatrix *model, DipError *err) {
    DIP_FP_MODE_SCOPE();
    const double *m = model->m;
    const double turn[16] = {m[0], m[1], m[2],  0.0, m[4], m[5], m[6], 0.0,
                             m[8], m[9], m[10], 0.0, 0.0,  0.0,  0.0,  1.0};
    double made[16];
    if (!invert(made, turn)) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "model",
                             "a matrix whose 3x3 part has no inverse or is not finite");
    }
    const int exponent = largest_exponent(made);
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            normals[3 * r + c] = (float)ldexp(made[4 * c + r], -exponent);
        }
    }
    return true;
}

// Takes a plane to clip space: the plane, as a row, times the inverse of to_clip.
static bool take_to_clip(double out[4], const DipMatrix *to_clip, const double plane[4]) {
    double from_clip[16];
    if (!invert(from_clip, to_clip->m)) {
        return false;
    }
    const int exponent = exponent_of(plane, 1);
    for (int c = 0; c < 4; c++) {
        out[c] = 0.0;
        for (int r = 0; r < 4; r++) {
            out[c] += ldexp(plane[r], -exponent) * from_clip[4 * r + c];
        }
    }
    return are_finite(out, 4);
}

bool dip_matrix_clip_plane(const DipMatrix *to_clip, const double plane[4], float out[4],
                           DipError *err) {
    DIP_FP_MODE_SCOPE();
    if (!are_finite(plane, 4) || (plane[0] == 0.0 && plane[1] == 0.0 && plane[2] == 0.0)) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "plane",
                             "(%g, %g, %g, %g), accepted finite numbers, not all of the first "
                             "three 0",
                             plane[0], plane[1], plane[2], plane[3]);
    }
    double made[4];
    if (!take_to_clip(made, to_clip, plane)) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "to_clip",
                             "a matrix that has no inverse or is not finite");
    }
    const int exponent = exponent_of(made, 1) - 1;
    for (int c = 0; c < 4; c++) {
        out[c] = (float)ldexp(made[c], -exponent);
    }
    return true;
}

void dip_matrix_apply(const DipMatrix *matrix, const double point[4], double out[4]) {
    DIP_FP_MODE_SCOPE();
    double made[4];
    for (int r = 0; r < 4; r++) {
        const double *row = &matrix->m[4 * r];
        made[r] = row[0] * point[0] + row[1] * point[1] + row[2] * point[2] + row[3] * point[3];
    }
    memcpy(out, made, sizeof made);
}

void dip_matrix_floats(const DipMatrix *matrix, float out[16]) {
    DIP_FP_MODE_SCOPE();
    for (int i = 0; i < 16; i++) {
        out[i] = (float)matrix->m[i];
    }
}
