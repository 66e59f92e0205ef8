// Tests the helpers for shaders (renderer/pipeline/batch.h) against double precision, and their
// derivatives against differences of it.
#include "renderer/catalogue/random.h"
#include "renderer/pipeline/batch.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { ATTRIBUTES = 7, ARRAYS = 8 };

typedef struct Vertices {
    float in[ATTRIBUTES][DIP_VERTEX_BATCH];
    float out[ARRAYS][DIP_VERTEX_BATCH]; // the clip position and four varyings
    const float *in_rows[ATTRIBUTES];
    float *out_rows[ARRAYS];
    DipVertexBatch batch;
} Vertices;

static const float untouched = -77.0f;

static void make_vertices(Vertices *vertices, Random *random, int count) {
    for (int a = 0; a < ATTRIBUTES; a++) {
        vertices->in_rows[a] = vertices->in[a];
        for (int i = 0; i < DIP_VERTEX_BATCH; i++) {
            vertices->in[a][i] = (float)random_real(random, -50.0, 50.0);
        }
    }
    for (int r = 0; r < ARRAYS; r++) {
        vertices->out_rows[r] = vertices->out[r];
        for (int i = 0; i < DIP_VERTEX_BATCH; i++) {
            vertices->out[r][i] = untouched;
        }
    }
    vertices->batch = (DipVertexBatch){.count = count,
                                       .in = vertices->in_rows,
                                       .clip = vertices->out_rows,
                                       .varying = vertices->out_rows + 4};
}

static void random_matrix(Random *random, float *matrix, int count) {
    for (int i = 0; i < count; i++) {
        matrix[i] = (float)random_real(random, -3.0, 3.0);
    }
}

// Fails unless out[r][i] is row . (attributes from `first` on) + last, for the vertices of the
// batch, and nothing else is written in row r.
static void check_row(const Vertices *vertices, int r, int first, const float *row, float last) {
    for (int i = 0; i < DIP_VERTEX_BATCH; i++) {
        double sum = (double)last;
        for (int k = 0; k < 3; k++) {
            sum += (double)row[k] * (double)vertices->in[first + k][i];
        }
        if (i < vertices->batch.count) {
            assert_true(fabs((double)vertices->out[r][i] - sum) < 1e-4);
        } else {
            assert_true(vertices->out[r][i] == untouched);
        }
    }
}

static void vertices_are_multiplied_and_copied(void **state) {
    (void)state;
    static Vertices vertices;
    Random random = {11};
    for (int rows = 1; rows <= 4; rows++) {
        float m[16];
        random_matrix(&random, m, 16);
        make_vertices(&vertices, &random, 56 + 40 * rows);
        dip_vertices_transform(&vertices.batch, m, rows, vertices.batch.clip);
        for (int r = 0; r < rows; r++) {
            check_row(&vertices, r, 0, m + 4 * r, m[4 * r + 3]);
        }
        assert_true(vertices.out[rows][0] == untouched);
    }
    float turn[9];
    random_matrix(&random, turn, 9);
    make_vertices(&vertices, &random, 200);
    dip_vertices_turn(&vertices.batch, 3, turn, vertices.batch.varying + 1);
    for (int r = 0; r < 3; r++) {
        check_row(&vertices, 5 + r, 3, turn + 3 * r, 0.0f);
    }
    assert_true(vertices.out[4][0] == untouched);

    make_vertices(&vertices, &random, 200);
    dip_vertices_copy(&vertices.batch, 5, 1, 2);
    for (int c = 0; c < 2; c++) {
        assert_memory_equal(vertices.out[5 + c], vertices.in[5 + c], 200 * sizeof(float));
        assert_true(vertices.out[5 + c][200] == untouched);
    }
    assert_true(vertices.out[4][0] == untouched && vertices.out[7][0] == untouched);
}

// Returns coordinate c of the projected point p. w: where not NULL, receives the divisor.
static double project(const float m[16], const double p[3], int c, double *w) {
    double sums[2] = {(double)m[4 * c + 3], (double)m[15]};
    for (int k = 0; k < 3; k++) {
        sums[0] += (double)m[4 * c + k] * p[k];
        sums[1] += (double)m[12 + k] * p[k];
    }
    if (w) {
        *w = sums[1];
    }
    return sums[0] / sums[1];
}

static void check_projection(const DipFragmentBatch *batch, const float m[16], int i, int *before,
                             int *behind) {
    const float *zero[3] = {batch->varying[6], batch->varying_dx[6], batch->varying_dy[6]};
    assert_true(zero[0][i] == 0.0f && zero[1][i] == 0.0f && zero[2][i] == 0.0f);
    double p[3], w;
    for (int k = 0; k < 3; k++) {
        p[k] = (double)batch->varying[2 + k][i];
    }
    project(m, p, 0, &w);
    const float *derivatives[2] = {&batch->varying_dx[0][i], &batch->varying_dy[0][i]};
    for (int c = 0; c < 2; c++) {
        const float found = batch->varying[8 + c][i];
        if (w < -1e-3) {
            assert_true(found == 0.0f && batch->varying_dx[8 + c][i] == 0.0f &&
                        batch->varying_dy[8 + c][i] == 0.0f);
            (*behind)++;
            continue;
        }
        if (w < 0.5) {
            continue; // Near w = 0, floats are coarse and differences large.
        }
        (*before)++;
        assert_true(fabs((double)found - project(m, p, c, NULL)) < 1e-4);
        for (int d = 0; d < 2; d++) {
            double ahead[3], back[3];
            for (int k = 0; k < 3; k++) {
                const double step =
                    1e-4 * (double)derivatives[d][(size_t)(2 + k) * DIP_FRAGMENT_BATCH];
                ahead[k] = p[k] + step;
                back[k] = p[k] - step;
            }
            const double slope = (project(m, ahead, c, NULL) - project(m, back, c, NULL)) / 2e-4;
            const double is = (double)derivatives[d][(size_t)(8 + c) * DIP_FRAGMENT_BATCH];
            assert_true(fabs(is - slope) < 1e-3 * (1.0 + fabs(slope)));
        }
    }
}

static void projected_coordinates_have_their_derivatives(void **state) {
    (void)state;
    static DipFragmentBatch batch;
    Random random = {12};
    int before = 0, behind = 0;
    for (int round = 0; round < 50; round++) {
        float m[16];
        random_matrix(&random, m, 16);
        memset(&batch, 0, sizeof batch);
        batch.count = round == 0 ? 1 : DIP_FRAGMENT_BATCH;
        for (int i = 0; i < DIP_FRAGMENT_BATCH; i++) {
            for (int k = 0; k < 3; k++) {
                batch.varying[2 + k][i] = (float)random_real(&random, -2.0, 2.0);
                batch.varying_dx[2 + k][i] = (float)random_real(&random, -0.2, 0.2);
                batch.varying_dy[2 + k][i] = (float)random_real(&random, -0.2, 0.2);
            }
        }
        dip_fragments_project(&batch, m, 2, 8);
        for (int i = 0; i < batch.count; i++) {
            check_projection(&batch, m, i, &before, &behind);
        }
        assert_true(round > 0 || batch.varying[8][1] == 0.0f);
    }
    assert_true(before > 1000 && behind > 1000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vertices_are_multiplied_and_copied),
        cmocka_unit_test(projected_coordinates_have_their_derivatives),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
