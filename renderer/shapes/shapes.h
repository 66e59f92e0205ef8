// Shapes made to order: spheres, boxes, prisms, planes and quads as vertices and indices.
//
// Shapes stand upright: +y is up and the origin is their centre. Triangles wind counter-clockwise
// as seen from outside. Texture coordinates lie in 0..1, and v = 0 is the upper edge of a picture.
// The numbers are the same to the bit on every machine. All functions are thread-safe.
#ifndef DIP_RENDERER_SHAPES_SHAPES_H
#define DIP_RENDERER_SHAPES_SHAPES_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"
#include "renderer/pipeline/mesh.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Most slices, stacks, sides, columns and rows of a shape.
enum { DIP_MAX_SHAPE_STEPS = 4096 };

// What the floats of a shape's vertex mean. A tessellation (tessellate.h) has the attributes that
// its caller chooses instead.
enum {
    DIP_SHAPE_POSITION = 0, // x, y, z
    DIP_SHAPE_NORMAL = 3,   // x, y, z of the unit vector that points outwards
    DIP_SHAPE_TEXTURE = 6,  // u, v
    DIP_SHAPE_ATTRIBUTES = 8
};

// Vertices and indices. The shape owns its arrays, and its owner may change the attributes. Free it
// with dip_shape_free.
typedef struct DipShape {
    float *attributes;   // vertex_count rows of attribute_count floats
    int attribute_count; // DIP_SHAPE_ATTRIBUTES, except in a tessellation
    uint32_t vertex_count;
    uint32_t *indices; // three for each triangle
    uint32_t index_count;
} DipShape;

// The functions below make a shape from scratch. *shape is overwritten, so it must not own arrays.
// They fail with RANGE, where the error's key is the parameter that is out of range, or with
// MEMORY. Then *shape is all 0.

// A sphere of `slices` parts around the y axis (3..DIP_MAX_SHAPE_STEPS) and `stacks` parts from
// pole to pole (2..DIP_MAX_SHAPE_STEPS). radius: greater than 0 and finite. u grows from 0 at the
// direction +x through -z, -x and +z to 1 at +x again; v grows from the upper pole to the lower
// one. The vertices of the seam exist twice, with the same position and with u = 0 and u = 1.
DIP_API bool dip_shape_sphere(DipShape *shape, float radius, int slices, int stacks, DipError *err);

// A box with the given lengths of its edges along x, y and z, each greater than 0 and finite. It
// has four vertices for each face. The faces come in the order +x, -x, +y, -y, +z, -z, and the
// vertices of face f are 4 f .. 4 f + 3. Seen from outside, they are the lower left, lower right,
// upper right and upper left corner of the face, and of a picture that fills the face. The upper
// edge of the face +y is its edge towards -z, and the upper edge of the face -y is the one towards
// +z.
DIP_API bool dip_shape_box(DipShape *shape, const float size[3], DipError *err);

// A prism whose bases are regular polygons of `sides` corners (3..DIP_MAX_SHAPE_STEPS), `height`
// apart. radius: distance of the corners from the y axis. Both are greater than 0 and finite. With
// a = 2 pi k / sides, corner k stands at x = radius cos a and z = radius sin a. Each side consists
// of two triangles, and each base of `sides` triangles around its centre. smooth: the normals of
// the sides turn smoothly from corner to corner, as on a cylinder, instead of being constant on
// each side. The sides come first: side k, between the corners k and k + 1, has the vertices 4 k ..
// 4 k + 3, which are, seen from outside, its lower left, lower right, upper right and upper left
// corner. On the sides, u is 1 - k / sides at corner k and grows to the right. Each base shows the
// disc in the middle of a picture, whose upper edge lies towards -z on the upper base and towards
// +z on the lower base.
DIP_API bool dip_shape_prism(DipShape *shape, float radius, float height, int sides, bool smooth,
                             DipError *err);

// A rectangle in the plane y = 0 that faces +y. It is size_x long along x and size_z along z, both
// greater than 0 and finite, and is divided into `columns` along x and `rows` along z, each
// 1..DIP_MAX_SHAPE_STEPS. Vertex row * (columns + 1) + column has u = column / columns and
// v = row / rows; the vertex with u = v = 0 has the least x and the least z.
DIP_API bool dip_shape_plane(DipShape *shape, float size_x, float size_z, int columns, int rows,
                             DipError *err);

// A rectangle in the plane z = 0 that faces +z, with four vertices: its lower left, lower right,
// upper right and upper left corner. width, height: greater than 0 and finite.
DIP_API bool dip_shape_quad(DipShape *shape, float width, float height, DipError *err);

// Frees the arrays of a shape and sets it to all 0. A shape that is all 0 is accepted.
DIP_API void dip_shape_free(DipShape *shape);

// Returns the shape as the data of a mesh. The data refers to the shape's arrays.
static inline DipMeshData dip_shape_data(const DipShape *shape, const char *name) {
    DipMeshData data;
    data.name = name;
    data.attributes = shape->attributes;
    data.attribute_count = shape->attribute_count;
    data.vertex_count = shape->vertex_count;
    data.indices = shape->indices;
    data.index_count = shape->index_count;
    return data;
}

#ifdef __cplusplus
}
#endif

#endif
