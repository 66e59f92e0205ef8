// Helpers for shaders: what most vertex and fragment shaders do with every element of a batch.
//
// The functions use only + - * /, in the order that their comments give. They are compiled with the
// library, so a picture has the same bits on every machine, whatever options the caller's compiler
// has. They may run on any thread.
#ifndef DIP_RENDERER_PIPELINE_BATCH_H
#define DIP_RENDERER_PIPELINE_BATCH_H

#include "renderer/base/api.h"
#include "renderer/pipeline/shader.h"

#ifdef __cplusplus
extern "C" {
#endif

// --- vertex shaders ------------------------------------------------------------------------------

// Multiplies the vertices' positions, attributes 0..2, by a row-major 4x4 matrix m: for each row r
// below `rows` (1..4),
//     out[r][i] = ((m[4 r] x + m[4 r + 1] y) + m[4 r + 2] z) + m[4 r + 3].
// out: batch->clip for clip positions (4 rows), batch->varying + s for varyings s, s + 1, ...
DIP_API void dip_vertices_transform(const DipVertexBatch *batch, const float matrix[16], int rows,
                                    float *const *out);

// Multiplies attributes `attribute` to attribute + 2, usually normals, by a row-major 3x3 matrix:
//     out[r][i] = (m[3 r] x + m[3 r + 1] y) + m[3 r + 2] z.
// dip_matrix_normals (renderer/shapes/camera.h) makes the matrix for normals. They are not of unit
// length afterwards.
DIP_API void dip_vertices_turn(const DipVertexBatch *batch, int attribute, const float matrix[9],
                               float *const *out);

// Copies attributes attribute .. attribute + count - 1 to the varyings from `varying` on.
DIP_API void dip_vertices_copy(const DipVertexBatch *batch, int attribute, int varying, int count);

// --- fragment shaders ----------------------------------------------------------------------------

// Projects each fragment's position, varyings `position` to position + 2, and writes coordinates at
// which the shader can then read a texture: varyings `coordinates` and coordinates + 1 become x / w
// and y / w of m * (position, 1), and their derivatives follow by the quotient rule. The draw
// declares the coordinates as its last computed varyings (DipDraw.computed_varying_count), and the
// position with derivatives. dip_matrix_to_map (renderer/shapes/camera.h) turns a projector's
// matrix to clip space into m. Where w is not above 0, behind the projector, the function writes 0.
DIP_API void dip_fragments_project(DipFragmentBatch *batch, const float matrix[16], int position,
                                   int coordinates);

#ifdef __cplusplus
}
#endif

#endif
