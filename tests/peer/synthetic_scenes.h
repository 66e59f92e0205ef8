// Scenes that are computed by formulas, besides the grid of `diptych bench`.
#ifndef DIP_TESTS_PEER_SYNTHETIC_SCENES_H
#define DIP_TESTS_PEER_SYNTHETIC_SCENES_H

#include "app/bench/synthetic.h"

// Makes a room of 12 large triangles with two free-standing screens of 2 triangles each, all
// textured. The camera stands inside and turns once about itself; the room covers every pixel.
DipSynthetic *dip_peer_room(DipError *err);

// Makes a relief that has vertex colours instead of a texture. The caller frees *colours_lin after
// the relief.
DipSynthetic *dip_peer_coloured_relief(int triangle_count, double fov_y_deg, double aspect,
                                       double turn_deg, float **colours_lin, DipError *err);

#endif
