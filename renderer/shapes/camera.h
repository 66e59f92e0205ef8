// Matrices for cameras and lights: views, projections, and what is needed to combine them.
//
// A matrix is row-major and multiplies column vectors: `a * b` applies b first, and
//     clip = projection * view * model * (position, 1).
// View space is right-handed: x points right, y up, and the camera looks along -z. In clip space, a
// point is visible if -w <= x <= w, -w <= y <= w and 0 <= z <= w. Depth is reversed: z = w is
// nearest. All functions compute in double precision with the same bits on every machine, so that
// scenes far from the origin lose nothing before the product is rounded to floats
// (dip_matrix_floats). All functions are pure and thread-safe.
#ifndef DIP_RENDERER_SHAPES_CAMERA_H
#define DIP_RENDERER_SHAPES_CAMERA_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct DipMatrix {
    double m[16]; // element of row r and column c: m[4 * r + c]
} DipMatrix;

// --- cameras -------------------------------------------------------------------------------------

// Makes the matrix that takes world space to the view space of a camera at `eye` that looks at
// `target`. up: a direction that is upwards in the picture; it need neither be of unit length nor
// perpendicular to the view. Fails with RANGE if a coordinate is not finite, if eye and target
// coincide, or if up is zero or parallel to the view (within 2^-40). The error's key is the
// parameter.
DIP_API bool dip_camera_look_at(DipMatrix *view, const double eye[3], const double target[3],
                                const double up[3], DipError *err);

// A perspective camera. The field of view is vertical.
typedef struct DipPerspective {
    double fov_deg;       // vertical field of view, in degrees; above 0 and below 180
    double aspect;        // width of the picture divided by its height; above 0
    double near_distance; // distance of the near plane from the eye; FLT_MIN to FLT_MAX
    double far_distance;  // distance of the far plane, above near_distance; 0: no far plane
} DipPerspective;

// Makes the projection of a perspective camera. Depth z / w is near_distance / distance if there is
// no far plane. With a far plane, it falls from 1 at the near plane to 0 at the far plane. Fails
// with RANGE; the error's key is the field.
DIP_API bool dip_camera_perspective(DipMatrix *projection, const DipPerspective *lens,
                                    DipError *err);

// A parallel projection of the box left..right, bottom..top of view space, between two distances
// from the eye.
typedef struct DipOrthographic {
    double left, right; // left is less than right
    double bottom, top; // bottom is less than top
    double near_distance;
    double far_distance; // greater than near_distance; near_distance may be negative
} DipOrthographic;

// Makes a parallel projection: w is 1, and depth z falls linearly from 1 at near_distance to 0 at
// far_distance. Fails with RANGE; the error's key is the field.
DIP_API bool dip_camera_orthographic(DipMatrix *projection, const DipOrthographic *box,
                                     DipError *err);

// --- matrices ------------------------------------------------------------------------------------

DIP_API DipMatrix dip_matrix_identity(void);
DIP_API DipMatrix dip_matrix_translation(double x, double y, double z);
DIP_API DipMatrix dip_matrix_scaling(double x, double y, double z);

// Rotates about an axis, counter-clockwise if the axis points at the viewer. axis: 0 for x, 1 for
// y, 2 for z; any other value gives the identity. |angle_rad| <= 1e6; the elements are NaN for a
// larger angle.
DIP_API DipMatrix dip_matrix_rotation(int axis, double angle_rad);

// Mirrors at the plane of the points p with dot(normal, p) = distance. normal: of unit length.
// Triangles of a mirrored model wind the other way round.
DIP_API DipMatrix dip_matrix_reflection(const double normal[3], double distance);

// Returns a * b, which applies b first.
DIP_API DipMatrix dip_matrix_multiply(const DipMatrix *a, const DipMatrix *b);

// Returns a * b * c, which applies c first: dip_matrix_multiply3(&projection, &view, &model).
DIP_API DipMatrix dip_matrix_multiply3(const DipMatrix *a, const DipMatrix *b, const DipMatrix *c);

// Makes the inverse of a matrix. Fails with RANGE if the matrix has none, apart from rounding,
// or if an element is not finite. inverse and matrix may be the same.
DIP_API bool dip_matrix_invert(DipMatrix *inverse, const DipMatrix *matrix, DipError *err);

// Makes the row-major 3x3 matrix that takes normals of a model to normals of the transformed model:
// the inverse transpose of the upper left 3x3 elements, times a power of two for which the largest
// element has a magnitude of 1 to 2. Transformed normals are not of unit length. Fails with RANGE
// if the 3x3 elements have no inverse or one of them is not finite.
DIP_API bool dip_matrix_normals(float normals[9], const DipMatrix *model, DipError *err);

// Takes clip space to the coordinates of a target or a shadow map, as fractions of its size from
// its top left corner: u = (w + x) / 2 and v = (w - y) / 2; z and w stay. The product of this
// matrix and a light's matrix to clip space takes the world to the coordinates of the light's map.
// With a perspective, u, v and z are then divided by w.
DIP_API DipMatrix dip_matrix_to_map(void);

// Makes a clip plane of a pass (DipPass.clip_planes in pipeline.h) from a plane of the space that
// to_clip takes to clip space. Points p with plane[0..2] . p + plane[3] >= 0 are kept. out is
// scaled by a power of two for which its largest element has a magnitude of 1 to 2. Fails with
// RANGE if the matrix has no inverse or is not finite, or if plane[0..2] is 0 or an element of the
// plane is not finite; the error's key is the parameter.
DIP_API bool dip_matrix_clip_plane(const DipMatrix *to_clip, const double plane[4], float out[4],
                                   DipError *err);

// Writes matrix * point, without dividing by w.
DIP_API void dip_matrix_apply(const DipMatrix *matrix, const double point[4], double out[4]);

// Rounds the elements to floats, for shaders and DipDraw.bounds_to_clip (pipeline.h).
DIP_API void dip_matrix_floats(const DipMatrix *matrix, float out[16]);

#ifdef __cplusplus
}
#endif

#endif
