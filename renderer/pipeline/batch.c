// Helpers for shaders.
#include "renderer/pipeline/batch.h"

#include <string.h>

void dip_vertices_transform(const DipVertexBatch *batch, const float matrix[16], int rows,
                            float *const *out) {
    const float *x = batch->in[0];
    const float *y = batch->in[1];
    const float *z = batch->in[2];
    for (int r = 0; r < rows; r++) {
        const float *m = matrix + 4 * r;
        float *to = out[r];
        for (int i = 0; i < batch->count; i++) {
            to[i] = m[0] * x[i] + m[1] * y[i] + m[2] * z[i] + m[3];
        }
    }
}

void dip_vertices_turn(const DipVertexBatch *batch, int attribute, const float matrix[9],
                       float *const *out) {
    const float *x = batch->in[attribute];
    const float *y = batch->in[attribute + 1];
    const float *z = batch->in[attribute + 2];
    for (int r = 0; r < 3; r++) {
        const float *m = matrix + 3 * r;
        float *to = out[r];
        for (int i = 0; i < batch->count; i++) {
            to[i] = m[0] * x[i] + m[1] * y[i] + m[2] * z[i];
        }
    }
}

void dip_vertices_copy(const DipVertexBatch *batch, int attribute, int varying, int count) {
    for (int i = 0; i < count; i++) {
        memcpy(batch->varying[varying + i], batch->in[attribute + i],
               (size_t)batch->count * sizeof(float));
    }
}

// Returns row . (x, y, z) of fragment i, without the row's last element.
static float row_times(const float *row, float (*position)[DIP_FRAGMENT_BATCH], int i) {
    return row[0] * position[0][i] + row[1] * position[1][i] + row[2] * position[2][i];
}

void dip_fragments_project(DipFragmentBatch *batch, const float matrix[16], int position,
                           int coordinates) {
    const float *last = matrix + 12;
    for (int i = 0; i < batch->count; i++) {
        const float w = row_times(last, batch->varying + position, i) + last[3];
        const float w_dx = row_times(last, batch->varying_dx + position, i);
        const float w_dy = row_times(last, batch->varying_dy + position, i);
        const bool before = w > 0.0f;
        for (int c = 0; c < 2; c++) {
            const float *row = matrix + 4 * c;
            const float value = (row_times(row, batch->varying + position, i) + row[3]) / w;
            const float dx = row_times(row, batch->varying_dx + position, i) - value * w_dx;
            const float dy = row_times(row, batch->varying_dy + position, i) - value * w_dy;
            batch->varying[coordinates + c][i] = before ? value : 0.0f;
            batch->varying_dx[coordinates + c][i] = before ? dx / w : 0.0f;
            batch->varying_dy[coordinates + c][i] = before ? dy / w : 0.0f;
        }
    }
}
