// Moeller and Trumbore's intersection, written with one cross product per edge.
//
// Let a, b and c be the corners of a triangle relative to the eye, and r the ray with w = 1 through
// a position of the picture. The point w r = i a + j b + k c of the triangle's plane has i = w
// (b x c) . r / det, with det = a . (b x c), and so on for j and k. So the three triple products
// are edge functions, and their sum is det / w.
#include "renderer/catalogue/raycast.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#ifndef __SIZEOF_FLOAT128__
_Static_assert(LDBL_MANT_DIG == 113, "the long double that stands in for __float128 is wide");
#endif

static const double pi = 3.14159265358979323846;

static DipQuad magnitude(DipQuad a) {
    return a < 0 ? -a : a;
}

typedef struct View {
    DipQuad position[3];
    DipQuad rows[3][3];  // rows of the rotation from world to camera space
    DipQuad x_per_pixel; // ray.x = x * x_per_pixel - x_at_left
    DipQuad x_at_left;
    DipQuad y_per_pixel;
    DipQuad y_at_top;
} View;

static View make_view(const DipPose *pose, int width, int height) {
    View view;
    const DipQuad q[4] = {pose->orientation[0], pose->orientation[1], pose->orientation[2],
                          pose->orientation[3]};
    const DipQuad s = 2 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        view.position[i] = pose->position_world[i];
        view.rows[i][i] = 1 - s * (q[j] * q[j] + q[k] * q[k]);
        view.rows[i][j] = s * (q[i] * q[j] + q[k] * q[3]);
        view.rows[i][k] = s * (q[i] * q[k] - q[j] * q[3]);
    }
    const double half = tan(pose->fov_y_deg * (pi / 360.0));
    view.y_at_top = half;
    view.y_per_pixel = 2 * (DipQuad)half / height;
    view.x_at_left = (DipQuad)half * width / height;
    view.x_per_pixel = 2 * (DipQuad)half / height;
    return view;
}

// Computes a vertex relative to the eye, in camera space.
static void find_corner(const View *view, const DipObjectDef *object, const float *p,
                        DipQuad corner[3]) {
    const float *m = object->transform;
    DipQuad world[3];
    for (int i = 0; i < 3; i++) {
        world[i] = (DipQuad)m[4 * i] * p[0] + (DipQuad)m[4 * i + 1] * p[1] +
                   (DipQuad)m[4 * i + 2] * p[2] + m[4 * i + 3] - view->position[i];
    }
    for (int i = 0; i < 3; i++) {
        corner[i] =
            view->rows[i][0] * world[0] + view->rows[i][1] * world[1] + view->rows[i][2] * world[2];
    }
}

// Returns (a x b) . ray as a plane over the picture, and in cross the product itself.
static DipQuadPlane find_edge(const View *view, const DipQuad a[3], const DipQuad b[3],
                              DipQuad cross[3]) {
    DipQuad terms[3];
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        cross[i] = a[j] * b[k] - a[k] * b[j];
        terms[i] = magnitude(a[j] * b[k]) + magnitude(a[k] * b[j]);
    }
    return (DipQuadPlane){
        .at = cross[1] * view->y_at_top - cross[0] * view->x_at_left - cross[2],
        .per_x = cross[0] * view->x_per_pixel,
        .per_y = -cross[1] * view->y_per_pixel,
        .terms = terms[0] * view->x_at_left + terms[1] * view->y_at_top + terms[2],
    };
}

static DipRayTriangle make_triangle(const View *view, const DipSceneDef *def,
                                    const DipObjectDef *object, const uint32_t *corners) {
    const DipMeshDef *mesh = &def->meshes[object->mesh];
    DipRayTriangle triangle = {.mesh = mesh, .corners = corners};
    DipQuad corner[3][3], cross[3];
    for (int i = 0; i < 3; i++) {
        find_corner(view, object, mesh->positions + 3 * (size_t)corners[i], corner[i]);
    }
    for (int i = 2; i >= 0; i--) {
        triangle.edges[i] = find_edge(view, corner[(i + 1) % 3], corner[(i + 2) % 3], cross);
    }
    const DipQuad det = corner[0][0] * cross[0] + corner[0][1] * cross[1] + corner[0][2] * cross[2];
    const DipQuad sign = det < 0 ? -1 : 1;
    for (int i = 0; i < 3; i++) {
        triangle.edges[i].at *= sign;
        triangle.edges[i].per_x *= sign;
        triangle.edges[i].per_y *= sign;
    }
    const float *m = object->transform;
    const double turn = (double)m[0] * ((double)m[5] * m[10] - (double)m[6] * m[9]) -
                        (double)m[1] * ((double)m[4] * m[10] - (double)m[6] * m[8]) +
                        (double)m[2] * ((double)m[4] * m[9] - (double)m[5] * m[8]);
    triangle.size = magnitude(det);
    // Seen from the front, the corners are counter-clockwise: the determinant is negative.
    triangle.visible =
        det != 0 && (def->materials[mesh->material].double_sided || (det < 0) == (turn >= 0.0));
    return triangle;
}

bool dip_raycast_init(DipRaycast *raycast, const DipSceneDef *def, const DipPose *pose, int width,
                      int height) {
    const View view = make_view(pose, width, height);
    uint32_t count = 0;
    for (int o = 0; o < def->object_count; o++) {
        count += def->meshes[def->objects[o].mesh].index_count / 3;
    }
    *raycast = (DipRaycast){.near_m = def->near_m};
    raycast->triangles = malloc((count + 1) * sizeof *raycast->triangles);
    for (int o = 0; raycast->triangles && o < def->object_count; o++) {
        const DipMeshDef *mesh = &def->meshes[def->objects[o].mesh];
        for (uint32_t i = 0; i < mesh->index_count; i += 3) {
            raycast->triangles[raycast->count++] =
                make_triangle(&view, def, &def->objects[o], mesh->indices + i);
        }
    }
    return raycast->triangles != NULL;
}

void dip_raycast_free(DipRaycast *raycast) {
    free(raycast->triangles);
    *raycast = (DipRaycast){0};
}

static DipQuad value_at(const DipQuadPlane *plane, double x, double y) {
    return plane->at + plane->per_x * x + plane->per_y * y;
}

// Returns the sum of a triangle's edges, each multiplied by the value of a vertex.
static DipQuadPlane blend(const DipRayTriangle *triangle, const DipQuad values[3]) {
    DipQuadPlane sum = {0};
    for (int i = 0; i < 3; i++) {
        const DipQuad value = values[i] / triangle->size;
        sum.at += triangle->edges[i].at * value;
        sum.per_x += triangle->edges[i].per_x * value;
        sum.per_y += triangle->edges[i].per_y * value;
        sum.terms += triangle->edges[i].terms * magnitude(value);
    }
    return sum;
}

static DipQuadPlane inverse_depth(const DipRayTriangle *triangle) {
    const DipQuad ones[3] = {1, 1, 1};
    return blend(triangle, ones);
}

// Returns 1 if a plane is positive at a position, -1 if it is negative, and 0 if a shift of the
// position by the margin or rounding in this file may change the sign.
static int sign_at(const DipQuadPlane *plane, double x, double y, double margin_px) {
    const DipQuad value = value_at(plane, x, y);
    const DipQuad margin =
        (magnitude(plane->per_x) + magnitude(plane->per_y)) * margin_px + plane->terms * 0x1p-96;
    return value > margin ? 1 : value < -margin ? -1 : 0;
}

// Returns 1 if a position lies in a triangle beyond the near plane, -1 if it does not, and 0 if
// that is not sure.
static int is_in(const DipRaycast *raycast, const DipRayTriangle *triangle, double x, double y,
                 double margin_px) {
    const DipQuadPlane depth = inverse_depth(triangle);
    const DipQuadPlane beyond = {1 - depth.at * raycast->near_m, -depth.per_x * raycast->near_m,
                                 -depth.per_y * raycast->near_m, 1 + depth.terms * raycast->near_m};
    int least = sign_at(&beyond, x, y, margin_px);
    for (int i = 0; i < 3; i++) {
        const int sign = sign_at(&triangle->edges[i], x, y, margin_px);
        least = sign < least ? sign : least;
    }
    return least;
}

// Computes a coordinate u = U / Q with its derivatives. U and Q are linear over the picture.
static void divide(const DipQuadPlane *over, const DipQuadPlane *under, double x, double y,
                   double out[3]) {
    const DipQuad q = value_at(under, x, y);
    const DipQuad value = value_at(over, x, y) / q;
    out[0] = (double)value;
    out[1] = (double)((over->per_x - value * under->per_x) / q);
    out[2] = (double)((over->per_y - value * under->per_y) / q);
}

static void describe(const DipRaycast *raycast, double x, double y, DipRayHit *hit) {
    const DipRayTriangle *triangle = &raycast->triangles[hit->triangle];
    const DipQuadPlane depth = inverse_depth(triangle);
    hit->inv_w[0] = (double)value_at(&depth, x, y);
    hit->inv_w[1] = (double)depth.per_x;
    hit->inv_w[2] = (double)depth.per_y;
    for (int c = 0; c < 2 && triangle->mesh->uv0; c++) {
        DipQuad values[3];
        for (int i = 0; i < 3; i++) {
            values[i] = triangle->mesh->uv0[2 * (size_t)triangle->corners[i] + (size_t)c];
        }
        const DipQuadPlane plane = blend(triangle, values);
        divide(&plane, &depth, x, y, c == 0 ? hit->u : hit->v);
    }
}

DipRaySight dip_raycast_look(const DipRaycast *raycast, double x, double y, double margin_px,
                             DipRayHit *hit) {
    DipQuad nearest = 0, nearest_slack = 0;
    *hit = (DipRayHit){.triangle = -1};
    bool sure = true;
    for (int t = 0; t < raycast->count; t++) {
        const DipRayTriangle *triangle = &raycast->triangles[t];
        const int in = is_in(raycast, triangle, x, y, margin_px);
        if (in == 0) { // the shift may also turn over a thin back face
            return DIP_RAY_UNSURE;
        }
        if (in < 0 || !triangle->visible) {
            continue;
        }
        const DipQuadPlane depth = inverse_depth(triangle);
        const DipQuad value = value_at(&depth, x, y);
        const DipQuad slack =
            (magnitude(depth.per_x) + magnitude(depth.per_y)) * margin_px + value * 0x1p-40;
        if (hit->triangle < 0 || value - slack > nearest + nearest_slack) {
            sure = true;
        } else if (value + slack >= nearest - nearest_slack) {
            sure = false;
        }
        if (hit->triangle < 0 || value > nearest) {
            hit->triangle = t;
            nearest = value;
            nearest_slack = slack;
        }
    }
    if (hit->triangle < 0) {
        return DIP_RAY_NOTHING;
    }
    describe(raycast, x, y, hit);
    return sure ? DIP_RAY_TRIANGLE : DIP_RAY_UNSURE;
}
