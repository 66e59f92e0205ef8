// The die of seed 001: a box whose faces show parts of one texture.
#ifndef DIP_APP_GALLERY_KIT_DIE_H
#define DIP_APP_GALLERY_KIT_DIE_H

#include "app/gallery/kit/kit.h"

// Makes a cube with edges of length 1. Face i shows the sixth number i of the texture's width, as
// the seed computes it. Opposite faces add up to seven.
bool dip_kit_die(DipMesh **mesh, DipError *err);

// Makes the texture: six squares side by side, with one to six pips.
bool dip_kit_die_texture(DipKitTexture *texture, DipError *err);

#endif
