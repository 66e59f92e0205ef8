// Creates scenes whose vertices fall on chosen screen positions, for tests of the reference.
//
// The picture is DIP_SCREEN (64) pixels wide and high, with a field of view of 90 degrees. A point
// that appears at the screen position (x, y) and lies at distance w along the view axis is
// therefore ((x / 32 - 1) w, (1 - y / 32) w, -w). This is exact in float if x and y are multiples
// of 1/256 pixel and w is a power of two.
#ifndef DIP_TESTS_RENDERER_PIPELINE_SCREEN_H
#define DIP_TESTS_RENDERER_PIPELINE_SCREEN_H

#include "renderer/reference/reference.h"
#include "renderer/catalogue/scenes.h"

enum { DIP_SCREEN = 64 };

typedef struct DipScreenPoint {
    double x; // in pixels
    double y;
    double w; // distance along the view axis, in metres
} DipScreenPoint;

// Returns the point with x and y rounded to 1/256 pixel.
DipScreenPoint dip_screen_snap(double x, double y, double w);

// Begins an empty scene with a black background and a near plane at 1/16 m.
void dip_screen_begin(DipTestScene *scene);

// Adds a double-sided white material without textures.
int dip_screen_add_white(DipTestScene *scene);

// Adds a mesh of one triangle (count 3) or one quad (count 4). A quad consists of the triangles
// (0,1,2) and (0,2,3).
DipTestMesh dip_screen_add_polygon(DipTestScene *scene, int material, const DipScreenPoint *points,
                                   int count, int arrays);

// Adds a quad at distance 1 that covers the whole picture and 1 pixel around it. Its uv run from
// (0,0) at the picture's top left corner to (u,v) at its bottom right corner.
void dip_screen_add_cover(DipTestScene *scene, int material, float u, float v);

typedef double DipScreenPicture[DIP_SCREEN][DIP_SCREEN][3]; // [y][x], in linear light

// Draws the scene with the reference renderer. The test fails if drawing fails.
void dip_screen_draw(const DipTestScene *scene, const char *settings, DipScreenPicture picture);
void dip_screen_converge(const DipTestScene *scene, int sample_count, uint32_t seed,
                         DipScreenPicture picture);

#endif
