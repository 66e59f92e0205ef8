// Scenes made of numbers, which nobody tuned for: a few large triangles, or very many small ones.
#ifndef DIP_APP_BENCH_SYNTHETIC_H
#define DIP_APP_BENCH_SYNTHETIC_H

#include "campaths/campath.h"
#include "renderer/scene/scene.h"

#include <stdbool.h>

enum { DIP_SYNTHETIC_MAX_TRIANGLES = 20000000 };

// A description and its camera path; owns both.
typedef struct DipSynthetic DipSynthetic;

// A room of 12 large triangles and two free-standing screens of 2, all textured, around a camera
// that turns once about itself; some triangle covers every pixel.
DipSynthetic *dip_synthetic_room(DipError *err);

// A relief of about triangle_count (2..DIP_SYNTHETIC_MAX_TRIANGLES) triangles of equal size under
// the fixed light, which fills the picture and stays in it whole while the camera sways a little.
// textured: with a colour texture, else with vertex colours. turn_deg: of the camera about the
// vertical, to the left, so that less of the relief is in view.
DipSynthetic *dip_synthetic_relief(int triangle_count, bool textured, double fov_y_deg,
                                   double aspect, double turn_deg, DipError *err);

void dip_synthetic_destroy(DipSynthetic **synthetic);

const DipSceneDef *dip_synthetic_scene_def(const DipSynthetic *synthetic);

// Hands the path over to the caller.
DipCamPath *dip_synthetic_take_path(DipSynthetic *synthetic);

#endif
