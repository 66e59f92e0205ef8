// Private to the reference renderer and to judges that search for faults: differences from
// docs/picture.md that the fast renderer is allowed ("Where the fast path may differ") and that a
// reference can share. The judge then needs no tolerance for them.
#ifndef DIP_RENDERER_REFERENCE_INTERNAL_DIFFERENCES_H
#define DIP_RENDERER_REFERENCE_INTERNAL_DIFFERENCES_H

#include "renderer/reference/internal/internal.h"
#include "renderer/reference/internal/texture.h"
#include "renderer/reference/reference.h"

// Distance of the fast renderer's guard band from the picture's top left corner, in pixels.
#define DIP_REF_FAST_GUARD_PX 16000.0

// Makes a reference share these differences:
// - Texels, also those of compressed textures, are square roots of linear light with 11 bits for
//   red and green and 10 bits for blue. Alpha has 8 bits in every level.
// - The mirrored picture has 8-bit sRGB codes.
// - The tables of metallic-roughness surfaces have 32 entries along each axis instead of 64, and so
//   end at a less grazing angle.
// - The guard band lies DIP_REF_FAST_GUARD_PX from the picture's top left corner.
// Fails with MEMORY.
bool dip_reference_share_differences(DipReference *reference, DipError *err);

// Adds a number to each channel of every colour that is read from a texture. The fast renderer's
// filter, whose weights and light have 16 bits, may add numbers within DIP_REF_MOST_SHIFT: it
// rounds down up to 8 products of a texel and a weight, and before that the squares and the
// weights, and divides by slightly less than 65536 to make up for half of it.
#define DIP_REF_MOST_SHIFT (10.0 / 65536.0)
void dip_reference_shift_readings(DipReference *reference, const double shift[3]);

// Lets a reference interpolate texture coordinates, alphas, normals and colours of vertices from
// planes whose numbers are floats, in floats. On triangles that are seen edge-on, 1/w may change by
// thousands per pixel. Floats then lose what little changes along the triangle, and coordinates
// that are constant get derivatives of texels per pixel.
void dip_reference_interpolate_in_floats(DipReference *reference, bool in_floats);

// Interpolates `count` varyings from `first` on in floats, except the position. *out has everything
// else.
void dip_reference_interpolate_floats(const DipRefPosition *place, int first, int count,
                                      bool derive, DipRefVaryings *out);

// Rounds the texels of a texture, as above. Fails with MEMORY.
bool dip_reference_round_texture(DipRefTexture *texture, DipError *err);

// Rounds a colour in linear light, 0 to 1, as a texel's colour is rounded.
void dip_reference_round_colour(double rgb_lin[3]);

// Rounds the pixels of a picture in linear light to 8-bit sRGB codes.
void dip_reference_round_picture(double *rgb_lin, int pixel_count);

#endif
