// A ray caster in 128-bit floating point: the truth about which triangle a position of the picture
// shows. It neither projects, cuts nor rounds anything, and shares no code with the renderers.
#ifndef DIP_RENDERER_CATALOGUE_RAYCAST_H
#define DIP_RENDERER_CATALOGUE_RAYCAST_H

#include "renderer/scene/pose.h"
#include "renderer/scene/scene.h"

#include <stdbool.h>
#include <stdint.h>

// A type with 113 bits of precision.
#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 DipQuad;
#else
typedef long double DipQuad;
#endif

// A value that is linear over the picture: at + x * per_x + y * per_y, with x and y in pixels.
// `terms` bounds the magnitude of the terms whose sum it is.
typedef struct DipQuadPlane {
    DipQuad at, per_x, per_y;
    DipQuad terms;
} DipQuadPlane;

// A triangle as the camera sees it.
typedef struct DipRayTriangle {
    DipQuadPlane edges[3];   // times the sign of the determinant; >= 0 within the triangle
    DipQuad size;            // magnitude of the determinant; the edges' sum divided by it is 1 / w
    const DipMeshDef *mesh;  // borrowed
    const uint32_t *corners; // borrowed
    bool visible;            // false for a back face of a single-sided surface
} DipRayTriangle;

typedef struct DipRaycast {
    DipRayTriangle *triangles;
    int count;
    DipQuad near_m;
} DipRaycast;

typedef enum DipRaySight {
    DIP_RAY_NOTHING, // no triangle is visible
    DIP_RAY_TRIANGLE,
    DIP_RAY_UNSURE // the position is too close to an edge, or two triangles are equally far away
} DipRaySight;

typedef struct DipRayHit {
    int triangle;
    // Each of these is a value and its derivatives per pixel along x and y.
    double inv_w[3];
    double u[3]; // first texture coordinates
    double v[3];
} DipRayHit;

// Prepares a scene. The scene is borrowed until free. The aspect is width / height.
bool dip_raycast_init(DipRaycast *raycast, const DipSceneDef *def, const DipPose *pose, int width,
                      int height);
void dip_raycast_free(DipRaycast *raycast);

// Finds the triangle that is visible at a position, in pixels. margin_px is the distance along each
// axis by which the renderer under test may move a point of a triangle.
DipRaySight dip_raycast_look(const DipRaycast *raycast, double x, double y, double margin_px,
                             DipRayHit *hit);

#endif
