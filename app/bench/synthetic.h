// Scenes made by formula, for which nothing was tuned: a few large triangles, or very many small
// ones.
#ifndef DIP_APP_BENCH_SYNTHETIC_H
#define DIP_APP_BENCH_SYNTHETIC_H

#include "campaths/campath.h"
#include "renderer/scene/scene.h"

#include <stdbool.h>

enum { DIP_SYNTHETIC_MAX_TRIANGLES = 20000000 };

// A scene description and its camera path. Owns both.
typedef struct DipSynthetic DipSynthetic;

// Makes a room of 12 large triangles with two free-standing screens of 2 triangles each, all
// textured. The camera inside turns once about itself, and every pixel is covered.
DipSynthetic *dip_synthetic_room(DipError *err);

// Makes a relief of about triangle_count (2..DIP_SYNTHETIC_MAX_TRIANGLES) triangles of equal size
// under the fixed light. It fills the picture and stays wholly inside while the camera sways a
// little. It has a colour texture if `textured`, else vertex colours. turn_deg turns the camera to
// the left about the vertical, so that less of the relief is in view.
DipSynthetic *dip_synthetic_relief(int triangle_count, bool textured, double fov_y_deg,
                                   double aspect, double turn_deg, DipError *err);

void dip_synthetic_destroy(DipSynthetic **synthetic);

const DipSceneDef *dip_synthetic_scene_def(const DipSynthetic *synthetic);

// Passes ownership of the path to the caller.
DipCamPath *dip_synthetic_take_path(DipSynthetic *synthetic);

#endif
