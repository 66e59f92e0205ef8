// Two scenes that are computed by formulas. The renderer was not optimised for them. The room has a
// few large triangles, the relief has very many small triangles.
#ifndef DIP_APP_BENCH_SYNTHETIC_H
#define DIP_APP_BENCH_SYNTHETIC_H

#include "campaths/campath.h"
#include "renderer/scene/scene.h"

#include <stdbool.h>

enum { DIP_SYNTHETIC_MAX_TRIANGLES = 20000000 };

// A scene description and its camera path. Owns both.
typedef struct DipSynthetic DipSynthetic;

// Makes a room of 12 large triangles with two free-standing screens of 2 triangles each, all
// textured. The camera stands inside and turns once about itself; the room covers every pixel.
DipSynthetic *dip_synthetic_room(DipError *err);

// Makes a relief: a wavy surface under the fixed light. It has about triangle_count
// (2..DIP_SYNTHETIC_MAX_TRIANGLES) triangles of equal size. It nearly fills the picture and stays
// wholly in view while the camera sways a little. It has a colour texture if `textured`, and vertex
// colours if not. turn_deg turns the camera to the left about the vertical, so that less of the
// relief is in view.
DipSynthetic *dip_synthetic_relief(int triangle_count, bool textured, double fov_y_deg,
                                   double aspect, double turn_deg, DipError *err);

void dip_synthetic_destroy(DipSynthetic **synthetic);

const DipSceneDef *dip_synthetic_scene_def(const DipSynthetic *synthetic);

// Passes ownership of the path to the caller.
DipCamPath *dip_synthetic_take_path(DipSynthetic *synthetic);

#endif
