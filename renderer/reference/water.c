// Blends water with the mirrored scene by its reflectance.
#include "renderer/reference/internal/internal.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

bool dip_reference_reflects(const DipReference *reference, const DipPose *pose) {
    return reference->reflection.width > 0 &&
           pose->position_world[1] > reference->reflection.level_m;
}

// Returns the world y of the unit vector from the eye through a position of the frame.
static double look_up(const DipRefShot *shot, const DipRefPosition *place) {
    const double half = tan(shot->pose->fov_y_deg * (pi / 360.0));
    const double ray[3] = {(place->x / (128.0 * shot->width) - 1.0) * half * shot->aspect,
                           (1.0 - place->y / (128.0 * shot->height)) * half, -1.0};
    // The quaternion turns v to v + 2 q x (q x v + w v). This is the y of the result.
    double q[4];
    dip_reference_orientation(shot->pose, q);
    const double cross[3] = {q[1] * ray[2] - q[2] * ray[1] + q[3] * ray[0],
                             q[2] * ray[0] - q[0] * ray[2] + q[3] * ray[1],
                             q[0] * ray[1] - q[1] * ray[0] + q[3] * ray[2]};
    const double norm = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    const double turned = ray[1] + 2.0 * (q[2] * cross[0] - q[0] * cross[2]) / norm;
    return turned / sqrt(ray[0] * ray[0] + ray[1] * ray[1] + ray[2] * ray[2]);
}

// Computes Fresnel's reflectance of unpolarised light from the angles on both sides of the surface.
static double reflectance(double cos_in) {
    const double sin_out = sqrt(1.0 - cos_in * cos_in) / DIP_WATER_INDEX;
    const double cos_out = sqrt(1.0 - sin_out * sin_out);
    const double across =
        (cos_in - DIP_WATER_INDEX * cos_out) / (cos_in + DIP_WATER_INDEX * cos_out);
    const double along =
        (cos_out - DIP_WATER_INDEX * cos_in) / (cos_out + DIP_WATER_INDEX * cos_in);
    return 0.5 * (across * across + along * along);
}

static double schlick(double cos_in) {
    const double straight = pow((DIP_WATER_INDEX - 1.0) / (DIP_WATER_INDEX + 1.0), 2.0);
    return straight + (1.0 - straight) * pow(1.0 - cos_in, 5.0);
}

void dip_reference_blend_water(const DipReference *reference, const DipRefShot *shot,
                               const DipRefPosition *place, const double mirrored[3],
                               double rgba[4]) {
    const double down = -look_up(shot, place);
    if (down <= 0.0) {
        return;
    }
    const double cos_in = fmin(down, 1.0);
    const double share = reference->reflection.schlick ? schlick(cos_in) : reflectance(cos_in);
    // The water reflects `share` of the light from above, and lets the rest of the light from below
    // through as far as its own colour does not cover it.
    const double covered = share + (1.0 - share) * rgba[3];
    for (int c = 0; c < 3; c++) {
        rgba[c] += (mirrored[c] - rgba[c]) * share / covered;
    }
    rgba[3] = covered;
}

void dip_reference_read_mirrored(const double *mirrored, const int size[2], int width, int height,
                                 const DipRefPosition *place, double rgb[3]) {
    const double at[2] = {place->x / (256.0 * width) * size[0] - 0.5,
                          place->y / (256.0 * height) * size[1] - 0.5};
    size_t texel[2][2]; // for each axis, the indices of the two texels around the position
    double share[2];
    for (int axis = 0; axis < 2; axis++) {
        const double within = fmin(fmax(at[axis], 0.0), size[axis] - 1.0);
        texel[axis][0] = (size_t)within;
        texel[axis][1] = (size_t)fmin(floor(within) + 1.0, size[axis] - 1.0);
        share[axis] = within - floor(within);
    }
    for (size_t c = 0; c < 3; c++) {
        rgb[c] = 0.0;
        for (int k = 0; k < 4; k++) {
            const double weight =
                (k & 1 ? share[0] : 1.0 - share[0]) * (k & 2 ? share[1] : 1.0 - share[1]);
            const size_t pixel = texel[1][k >> 1] * (size_t)size[0] + texel[0][k & 1];
            rgb[c] += weight * mirrored[3 * pixel + c];
        }
    }
}
