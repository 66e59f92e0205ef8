// Makes shapes from sines and cosines that have the same bits on every machine.
#include "renderer/shapes/shapes.h"

#include "renderer/base/assert.h"
#include "renderer/base/fp_mode.h"
#include "renderer/base/trig.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- building ------------------------------------------------------------------------------------

static bool check_length(const char *key, float length, DipError *err) {
    return (length > 0.0f && isfinite(length)) ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, key, "%g, accepted finite numbers above 0",
                         (double)length);
}

static bool check_steps(const char *key, int steps, int least, DipError *err) {
    return (steps >= least && steps <= DIP_MAX_SHAPE_STEPS) ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, key, "%d, accepted %d..%d", steps, least,
                         DIP_MAX_SHAPE_STEPS);
}

// Allocates the arrays of a shape whose counts are 0. add_vertex and add_triangle fill them.
static bool begin_shape(DipShape *shape, size_t vertices, size_t indices, DipError *err) {
    shape->attribute_count = DIP_SHAPE_ATTRIBUTES;
    shape->attributes = malloc(vertices * DIP_SHAPE_ATTRIBUTES * sizeof *shape->attributes);
    shape->indices = malloc(indices * sizeof *shape->indices);
    if (!shape->attributes || !shape->indices) {
        dip_shape_free(shape);
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "shape", "out of memory");
    }
    return true;
}

typedef struct Vertex {
    double position[3];
    double normal[3];
    double texture[2];
} Vertex;

// Appends a vertex and returns its index.
static uint32_t add_vertex(DipShape *shape, const Vertex *vertex) {
    float *row = shape->attributes + (size_t)shape->vertex_count * DIP_SHAPE_ATTRIBUTES;
    for (int i = 0; i < 3; i++) {
        row[DIP_SHAPE_POSITION + i] = (float)vertex->position[i];
        row[DIP_SHAPE_NORMAL + i] = (float)vertex->normal[i];
    }
    for (int i = 0; i < 2; i++) {
        row[DIP_SHAPE_TEXTURE + i] = (float)vertex->texture[i];
    }
    return shape->vertex_count++;
}

static void add_triangle(DipShape *shape, uint32_t a, uint32_t b, uint32_t c) {
    uint32_t *corner = shape->indices + shape->index_count;
    corner[0] = a;
    corner[1] = b;
    corner[2] = c;
    shape->index_count += 3;
}

// Appends a quadrilateral whose corners wind counter-clockwise.
static void add_quad(DipShape *shape, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    add_triangle(shape, a, b, c);
    add_triangle(shape, a, c, d);
}

// Appends `columns` quadrilaterals between two rows of columns + 1 vertices each. upper, lower: the
// rows' first vertices, at the left as seen from outside.
static void add_strip(DipShape *shape, uint32_t upper, uint32_t lower, int columns) {
    for (uint32_t j = 0; j < (uint32_t)columns; j++) {
        add_quad(shape, lower + j, lower + j + 1, upper + j + 1, upper + j);
    }
}

// Computes the unit vector at k / n of a full turn, for 0 <= k <= n. The angle is reduced to an
// eighth of a turn in integers, so the vector is exact at quarter turns and symmetric elsewhere.
static void turn(int k, int n, double *cosine, double *sine) {
    const int quarter = 4 * k / n;
    const int rest = 4 * k - quarter * n; // in units of 1 / (4 n) turn, 0..n - 1
    const bool second = 2 * rest > n;     // in the second eighth of its quarter
    const double angle_rad = (second ? n - rest : rest) * (0.5 * DIP_PI) / n;
    const double along = dip_cos(angle_rad);
    const double across = dip_sin(angle_rad);
    const double x = second ? across : along;
    const double y = second ? along : across;
    // The results are never -0.
    switch (quarter & 3) {
    case 0:
        *cosine = x;
        *sine = y;
        break;
    case 1:
        *cosine = 0.0 - y;
        *sine = x;
        break;
    case 2:
        *cosine = 0.0 - x;
        *sine = 0.0 - y;
        break;
    default:
        *cosine = y;
        *sine = 0.0 - x;
        break;
    }
}

void dip_shape_free(DipShape *shape) {
    free(shape->attributes);
    free(shape->indices);
    *shape = (DipShape){0};
}

// --- sphere --------------------------------------------------------------------------------------

// Appends the vertex of a sphere whose direction is at `stack` / stacks of the way from the upper
// pole to the lower one and at `slice` / slices around the axis. u may differ from slice / slices.
static void add_sphere_vertex(DipShape *shape, double radius, int stack, int stacks, int slice,
                              int slices, double u) {
    double y, ring, x, z;
    turn(stack, 2 * stacks, &y, &ring);
    turn(slice, slices, &x, &z);
    // 0.0 +- keeps zeros positive.
    const double direction[3] = {0.0 + ring * x, y, 0.0 - ring * z};
    Vertex vertex = {.texture = {u, (double)stack / stacks}};
    for (int i = 0; i < 3; i++) {
        vertex.normal[i] = direction[i];
        vertex.position[i] = radius * direction[i];
    }
    add_vertex(shape, &vertex);
}

// Each pole has a vertex for each of its triangles, with u in the triangle's middle.
static void add_poles(DipShape *shape, double radius, int stack, int stacks, int slices) {
    for (int slice = 0; slice < slices; slice++) {
        add_sphere_vertex(shape, radius, stack, stacks, slice, slices, (slice + 0.5) / slices);
    }
}

bool dip_shape_sphere(DipShape *shape, float radius, int slices, int stacks, DipError *err) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(radius);
    *shape = (DipShape){0};
    const size_t columns = (size_t)slices;
    if (!check_length("radius", radius, err) || !check_steps("slices", slices, 3, err) ||
        !check_steps("stacks", stacks, 2, err) ||
        !begin_shape(shape, 2 * columns + (columns + 1) * ((size_t)stacks - 1),
                     6 * columns * ((size_t)stacks - 1), err)) {
        return false;
    }
    add_poles(shape, radius, 0, stacks, slices);
    for (int stack = 1; stack < stacks; stack++) {
        for (int slice = 0; slice <= slices; slice++) {
            add_sphere_vertex(shape, radius, stack, stacks, slice % slices, slices,
                              (double)slice / slices);
        }
    }
    add_poles(shape, radius, stacks, stacks, slices);
    const uint32_t stride = (uint32_t)slices + 1;
    const uint32_t first_ring = (uint32_t)slices;
    const uint32_t last_ring = first_ring + stride * (uint32_t)(stacks - 2);
    for (uint32_t j = 0; j < (uint32_t)slices; j++) {
        add_triangle(shape, first_ring + j, first_ring + j + 1, j);
    }
    for (uint32_t ring = first_ring; ring < last_ring; ring += stride) {
        add_strip(shape, ring, ring + stride, slices);
    }
    for (uint32_t j = 0; j < (uint32_t)slices; j++) {
        add_triangle(shape, last_ring + stride + j, last_ring + j + 1, last_ring + j);
    }
    return true;
}

// --- flat shapes ---------------------------------------------------------------------------------

// A rectangle about a point: its corners are centre +- right +- up, and its normal is a unit
// vector.
typedef struct Rectangle {
    double centre[3];
    double right[3];
    double up[3];
    double normal[3];
} Rectangle;

// Appends the lower left, lower right, upper right and upper left corner of a rectangle, and its
// two triangles.
static void add_rectangle(DipShape *shape, const Rectangle *rectangle) {
    static const int corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const uint32_t first = shape->vertex_count;
    for (int k = 0; k < 4; k++) {
        Vertex vertex = {.texture = {corners[k][0], 1 - corners[k][1]}};
        for (int i = 0; i < 3; i++) {
            vertex.position[i] = rectangle->centre[i] +
                                 (2 * corners[k][0] - 1) * rectangle->right[i] +
                                 (2 * corners[k][1] - 1) * rectangle->up[i];
            vertex.normal[i] = rectangle->normal[i];
        }
        add_vertex(shape, &vertex);
    }
    add_quad(shape, first, first + 1, first + 2, first + 3);
}

// The faces of a box: axes of the normal, of the direction to the right and of the direction up,
// each with its sign.
static const struct {
    int axis[3];
    int sign[3];
} box_faces[6] = {
    {{0, 2, 1}, {1, -1, 1}}, {{0, 2, 1}, {-1, 1, 1}}, {{1, 0, 2}, {1, 1, -1}},
    {{1, 0, 2}, {-1, 1, 1}}, {{2, 0, 1}, {1, 1, 1}},  {{2, 0, 1}, {-1, -1, 1}},
};

bool dip_shape_box(DipShape *shape, const float size[3], DipError *err) {
    DIP_FP_MODE_SCOPE();
    *shape = (DipShape){0};
    for (int i = 0; i < 3; i++) {
        if (!check_length("size", size[i], err)) {
            return false;
        }
    }
    if (!begin_shape(shape, 24, 36, err)) {
        return false;
    }
    for (size_t f = 0; f < DIP_ARRAY_COUNT(box_faces); f++) {
        const int *axis = box_faces[f].axis;
        const int *sign = box_faces[f].sign;
        Rectangle face = {.normal = {0.0}};
        face.normal[axis[0]] = sign[0];
        face.centre[axis[0]] = 0.5 * sign[0] * (double)size[axis[0]];
        face.right[axis[1]] = 0.5 * sign[1] * (double)size[axis[1]];
        face.up[axis[2]] = 0.5 * sign[2] * (double)size[axis[2]];
        add_rectangle(shape, &face);
    }
    return true;
}

bool dip_shape_quad(DipShape *shape, float width, float height, DipError *err) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(width);
    DIP_FP_PIN(height);
    *shape = (DipShape){0};
    if (!check_length("width", width, err) || !check_length("height", height, err) ||
        !begin_shape(shape, 4, 6, err)) {
        return false;
    }
    const Rectangle quad = {.right = {0.5 * (double)width, 0.0, 0.0},
                            .up = {0.0, 0.5 * (double)height, 0.0},
                            .normal = {0.0, 0.0, 1.0}};
    add_rectangle(shape, &quad);
    return true;
}

bool dip_shape_plane(DipShape *shape, float size_x, float size_z, int columns, int rows,
                     DipError *err) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(size_x);
    DIP_FP_PIN(size_z);
    *shape = (DipShape){0};
    if (!check_length("size_x", size_x, err) || !check_length("size_z", size_z, err) ||
        !check_steps("columns", columns, 1, err) || !check_steps("rows", rows, 1, err) ||
        !begin_shape(shape, ((size_t)columns + 1) * ((size_t)rows + 1),
                     6 * (size_t)columns * (size_t)rows, err)) {
        return false;
    }
    for (int row = 0; row <= rows; row++) {
        for (int column = 0; column <= columns; column++) {
            const Vertex vertex = {
                .position = {(double)size_x * (2 * column - columns) / (2.0 * columns), 0.0,
                             (double)size_z * (2 * row - rows) / (2.0 * rows)},
                .normal = {0.0, 1.0, 0.0},
                .texture = {(double)column / columns, (double)row / rows},
            };
            add_vertex(shape, &vertex);
        }
    }
    const uint32_t stride = (uint32_t)columns + 1;
    for (uint32_t row = 0; row < (uint32_t)rows; row++) {
        add_strip(shape, row * stride, (row + 1) * stride, columns);
    }
    return true;
}

// --- prism ---------------------------------------------------------------------------------------

typedef struct Prism {
    double radius;
    double half_height;
    int sides;
    bool smooth;
} Prism;

// Appends a vertex of side `side`. offset: 0 or 1 for the corner `side` or `side` + 1.
static void add_side_vertex(DipShape *shape, const Prism *prism, int side, int offset, bool upper) {
    const int sides = prism->sides;
    double x, z, normal_x, normal_z;
    turn((side + offset) % sides, sides, &x, &z);
    if (prism->smooth) {
        normal_x = x;
        normal_z = z;
    } else {
        turn(2 * side + 1, 2 * sides, &normal_x, &normal_z);
    }
    const Vertex vertex = {
        .position = {prism->radius * x, upper ? prism->half_height : -prism->half_height,
                     prism->radius * z},
        .normal = {normal_x, 0.0, normal_z},
        .texture = {(double)(sides - side - offset) / sides, upper ? 0.0 : 1.0},
    };
    add_vertex(shape, &vertex);
}

// Appends a base: its centre, its corners, and a fan of triangles.
static void add_base(DipShape *shape, const Prism *prism, bool upper) {
    const double sign = upper ? 1.0 : -1.0;
    Vertex vertex = {.position = {0.0, sign * prism->half_height, 0.0},
                     .normal = {0.0, sign, 0.0},
                     .texture = {0.5, 0.5}};
    const uint32_t centre = add_vertex(shape, &vertex);
    for (int k = 0; k < prism->sides; k++) {
        double x, z;
        turn(k, prism->sides, &x, &z);
        vertex.position[0] = prism->radius * x;
        vertex.position[2] = prism->radius * z;
        vertex.texture[0] = 0.5 + 0.5 * x;
        vertex.texture[1] = 0.5 + sign * 0.5 * z;
        add_vertex(shape, &vertex);
    }
    for (uint32_t k = 0; k < (uint32_t)prism->sides; k++) {
        const uint32_t here = centre + 1 + k;
        const uint32_t next = centre + 1 + (k + 1) % (uint32_t)prism->sides;
        // Seen from above, the corners run clockwise.
        add_triangle(shape, centre, upper ? next : here, upper ? here : next);
    }
}

bool dip_shape_prism(DipShape *shape, float radius, float height, int sides, bool smooth,
                     DipError *err) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(radius);
    DIP_FP_PIN(height);
    *shape = (DipShape){0};
    if (!check_length("radius", radius, err) || !check_length("height", height, err) ||
        !check_steps("sides", sides, 3, err) ||
        !begin_shape(shape, 6 * (size_t)sides + 2, 12 * (size_t)sides, err)) {
        return false;
    }
    const Prism prism = {radius, 0.5 * (double)height, sides, smooth};
    for (int side = 0; side < sides; side++) {
        const uint32_t first = shape->vertex_count;
        add_side_vertex(shape, &prism, side, 1, false);
        add_side_vertex(shape, &prism, side, 0, false);
        add_side_vertex(shape, &prism, side, 0, true);
        add_side_vertex(shape, &prism, side, 1, true);
        add_quad(shape, first, first + 1, first + 2, first + 3);
    }
    add_base(shape, &prism, true);
    add_base(shape, &prism, false);
    return true;
}
