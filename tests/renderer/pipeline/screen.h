// Scenes whose vertices fall on chosen screen positions, for tests of the reference.
//
// The picture is DIP_SCREEN pixels wide and high, seen over 90 degrees, so that the point at
// distance w behind screen position (x, y) is ((x / 32 - 1) w, (1 - y / 32) w, -w): exact in float
// for positions in 1/256 pixel and w a power of two.
#ifndef DIP_TESTS_RENDERER_PIPELINE_SCREEN_H
#define DIP_TESTS_RENDERER_PIPELINE_SCREEN_H

#include "renderer/reference/reference.h"
#include "tests/renderer/scene/scenes.h"

enum { DIP_SCREEN = 64 };

typedef struct DipScreenPoint {
    double x; // pixels
    double y;
    double w; // metres along the view axis
} DipScreenPoint;

// Rounds to 1/256 pixel.
DipScreenPoint dip_screen_snap(double x, double y, double w);

// An empty scene with a black background, near plane at 1/16 m.
void dip_screen_begin(DipTestScene *scene);

// A double-sided white material without textures.
int dip_screen_add_white(DipTestScene *scene);

// A mesh of one triangle or quad (count 3 or 4; a quad is (0,1,2), (0,2,3)).
DipTestMesh dip_screen_add_polygon(DipTestScene *scene, int material, const DipScreenPoint *points,
                                   int count, int arrays);

// A quad over the whole picture and 1 pixel more, at distance 1; uv (0,0)..(u,v) from the picture's
// top left to its bottom right corner.
void dip_screen_add_cover(DipTestScene *scene, int material, float u, float v);

typedef double DipScreenPicture[DIP_SCREEN][DIP_SCREEN][3]; // [y][x], linear light

// Fails the test when it fails.
void dip_screen_draw(const DipTestScene *scene, const char *settings, DipScreenPicture picture);
void dip_screen_converge(const DipTestScene *scene, int sample_count, uint32_t seed,
                         DipScreenPicture picture);

#endif
