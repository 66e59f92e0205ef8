// Light and highlight of normal-mapped surfaces: docs/picture.md, "Normal maps".
#include "renderer/reference/internal/internal.h"

#include <math.h>

const double dip_reference_sun[3] = {-0.42, 0.67, 0.61};

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void normalise(double v[3]) {
    const double length = sqrt(dot(v, v));
    for (int i = 0; i < 3; i++) {
        v[i] = length > 0.0 ? v[i] / length : 0.0;
    }
}

// Returns the cosine between a normal and the direction to the sun, or 0 if the surface faces away.
static double meet_sun(const double normal[3]) {
    return fmax(0.0,
                dot(normal, dip_reference_sun) / sqrt(dot(dip_reference_sun, dip_reference_sun)));
}

double dip_reference_light(const double normal[3], double sunlit) {
    return 0.35 + 0.15 * normal[1] + 0.65 * sunlit * meet_sun(normal);
}

bool dip_reference_is_solid(const DipMaterialDef *material) {
    return material->surface == DIP_SURFACE_OPAQUE || material->surface == DIP_SURFACE_CLIPPED ||
           material->surface == DIP_SURFACE_BLENDED;
}

bool dip_reference_is_bumpy(const DipMaterialDef *material) {
    const bool has_light = material->lit || material->light_map != DIP_NO_TEXTURE;
    return dip_reference_is_solid(material) && has_light && material->normal_map != DIP_NO_TEXTURE;
}

// Returns the size of the derivatives of u0 or v0, which the derivatives' rounding errors are
// relative to.
static double size_of(const DipRefVaryings *varyings, int coordinate) {
    const int axis = coordinate - DIP_REF_U0;
    const DipRefTriangle *triangle = varyings->triangle;
    const double magnitude = fabs(varyings->value[coordinate] - triangle->repeat[axis]);
    return fabs(varyings->ddx[coordinate]) + fabs(varyings->ddy[coordinate]) +
           (triangle->repeats[axis] ? fmin(1.0, magnitude) : magnitude) * varyings->depth_change;
}

// Finds the tangents. along_u points where u grows while v stays constant, made perpendicular to
// the normal. against_v is perpendicular to both and points where v shrinks. dP/du is (dP/dx dv/dy
// - dP/dy dv/dx) / (du/dx dv/dy - du/dy dv/dx), and dP/dv is found accordingly. Returns false if
// the texture coordinates have no area or if u grows along the normal.
static bool find_tangents(const DipRefVaryings *varyings, const double normal[3], double along_u[3],
                          double against_v[3]) {
    const double *dx = varyings->ddx;
    const double *dy = varyings->ddy;
    const double area = dx[DIP_REF_U0] * dy[DIP_REF_V0] - dy[DIP_REF_U0] * dx[DIP_REF_V0];
    const double limit = 0x1p-14 * size_of(varyings, DIP_REF_U0) * size_of(varyings, DIP_REF_V0);
    if (!(fabs(area) > limit)) {
        return false;
    }
    double down[3]; // dP/dv
    for (int i = 0; i < 3; i++) {
        const double p_dx = dx[DIP_REF_X + i], p_dy = dy[DIP_REF_X + i];
        along_u[i] = (p_dx * dy[DIP_REF_V0] - p_dy * dx[DIP_REF_V0]) / area;
        down[i] = (p_dy * dx[DIP_REF_U0] - p_dx * dy[DIP_REF_U0]) / area;
    }
    const double rise = dot(along_u, normal);
    for (int i = 0; i < 3; i++) {
        along_u[i] -= rise * normal[i];
    }
    const bool is_flat = dot(along_u, along_u) > 0x1p-20 * rise * rise;
    normalise(along_u);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        against_v[i] = normal[j] * along_u[k] - normal[k] * along_u[j];
    }
    if (dot(against_v, down) > 0.0) {
        for (int i = 0; i < 3; i++) {
            against_v[i] = -against_v[i];
        }
    }
    return is_flat;
}

// Turns a normal by the map's filtered normal, whose x and y are multiplied by scale. Returns the
// length of the filtered normal before that.
static double map_normal(const DipRefVaryings *varyings, const double texel[3], double scale,
                         const double normal[3], double mapped[3]) {
    double along_u[3];
    double against_v[3];
    double m[3];
    for (int i = 0; i < 3; i++) {
        m[i] = (255.0 * texel[i] - 128.0) / 127.0;
        mapped[i] = normal[i];
    }
    m[2] = fmax(m[2], 0.125);
    const double length = sqrt(dot(m, m));
    m[0] *= scale;
    m[1] *= scale;
    const double scaled_length = sqrt(dot(m, m));
    if (find_tangents(varyings, normal, along_u, against_v)) {
        for (int i = 0; i < 3; i++) {
            mapped[i] =
                (m[0] * along_u[i] + m[1] * against_v[i] + m[2] * normal[i]) / scaled_length;
        }
    }
    return length;
}

static double find_highlight(double roughness, double length, const double ray[3],
                             const double mapped[3], double sunlit) {
    double sun[3] = {dip_reference_sun[0], dip_reference_sun[1], dip_reference_sun[2]};
    double half[3] = {-ray[0], -ray[1], -ray[2]};
    normalise(sun);
    normalise(half);
    for (int i = 0; i < 3; i++) {
        half[i] += sun[i];
    }
    normalise(half);
    const double alpha = fmax(roughness * roughness, 0.1);
    const double spread = 2.0 * fmax(0.0, 1.0 / fmax(length, 0.1) - 1.0);
    const double alpha2 = fmin(alpha * alpha + spread, 1.0);
    const double n_h = fmax(0.0, dot(mapped, half));
    const double l_h = dot(sun, half);
    const double d = n_h * n_h * (alpha2 - 1.0) + 1.0;
    const double lobe = alpha2 / (d * d * fmax(0.1, l_h * l_h) * (4.0 * sqrt(alpha2) + 2.0));
    return 0.04 * 0.65 * meet_sun(mapped) * sunlit * lobe;
}

double dip_reference_normal(const DipRefVaryings *varyings, const double texel[3], double scale,
                            double normal[3]) {
    double mesh[3];
    for (int i = 0; i < 3; i++) {
        mesh[i] = normal[i] = varyings->value[DIP_REF_NORMAL_X + i];
    }
    normalise(mesh);
    normalise(normal);
    return texel ? map_normal(varyings, texel, scale, mesh, normal) : 1.0;
}

void dip_reference_light_bumps(const DipMaterialDef *material, const DipRefVaryings *varyings,
                               const double texel[3], const double light[3], double rgb[3]) {
    double normal[3];
    double mapped[3];
    double ray[3];
    dip_reference_ray(varyings, ray);
    dip_reference_normal(varyings, NULL, 1.0, normal);
    const double length = dip_reference_normal(varyings, texel, 1.0, mapped);
    double sunlit = 1.0;
    double ratio = 1.0;
    if (light) {
        const double luminance = 0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2];
        sunlit = fmin(fmax((luminance - 0.4) / 0.5, 0.0), 1.0);
        ratio = dip_reference_light(mapped, sunlit) / dip_reference_light(normal, sunlit);
        ratio = fmin(fmax(ratio, 0.25), 2.5);
    }
    const double shine = find_highlight(material->roughness, length, ray, mapped, sunlit);
    for (int c = 0; c < 3; c++) {
        rgb[c] = rgb[c] * (light ? light[c] * ratio : dip_reference_light(mapped, 1.0)) + shine;
    }
}
