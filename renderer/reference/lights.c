// The lights of a scene: docs/picture.md, "Lights".
#include "renderer/reference/internal/internal.h"

#include <math.h>

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Scales a vector to the length 1 and returns its former length. A vector of length 0 stays.
static double normalise(double v[3]) {
    const double length = sqrt(dot(v, v));
    for (int i = 0; i < 3; i++) {
        v[i] = length > 0.0 ? v[i] / length : 0.0;
    }
    return length;
}

// The part of a spot light that reaches a point. to_light: unit vector from the point to the light.
static double find_cone(const DipLightDef *light, const double to_light[3]) {
    const double pi = acos(-1.0);
    const double inner = cos(light->inner_deg * pi / 180.0);
    const double outer = cos(light->outer_deg * pi / 180.0);
    double axis[3];
    for (int i = 0; i < 3; i++) {
        axis[i] = light->direction_world[i];
    }
    normalise(axis);
    const double inside = (-dot(axis, to_light) - outer) / fmax(0.001, inner - outer);
    const double share = fmin(fmax(inside, 0.0), 1.0);
    return share * share;
}

double dip_reference_arrival(const DipLightDef *light, const double eye[3], const double place[3],
                             double to_light[3]) {
    const bool is_far = light->kind == DIP_LIGHT_DIRECTIONAL;
    for (int i = 0; i < 3; i++) {
        to_light[i] = is_far ? -(double)light->direction_world[i]
                             : light->position_world[i] - eye[i] - place[i];
    }
    const double distance = normalise(to_light);
    if (is_far) {
        return 1.0;
    }
    const float *a = light->attenuation;
    const double loss = a[0] + a[1] * distance + a[2] * distance * distance;
    double share = loss > 0.0 ? 1.0 / loss : 0.0;
    if (light->range_m > 0.0f) {
        share *= fmax(0.0, 1.0 - pow(distance / light->range_m, 4.0));
    }
    return light->kind == DIP_LIGHT_SPOT ? share * find_cone(light, to_light) : share;
}

void dip_reference_lights(const DipRefLit *lit, const double place[3], const double ray[3],
                          const double normal[3], double sunlit, double diffuse[3],
                          double highlight[3], double direct[3]) {
    const DipMaterialDef *material = lit->material;
    const double exponent = floor(material->shininess + 0.5);
    const int shadowed = dip_reference_shadow_light(lit->shadows);
    double to_eye[3];
    for (int c = 0; c < 3; c++) {
        diffuse[c] = lit->lighting->ambient_lin[c] + normal[1] * lit->lighting->sky_lin[c];
        highlight[c] = 0.0;
        to_eye[c] = -ray[c];
    }
    normalise(to_eye);
    for (int l = 0; l < lit->lighting->light_count; l++) {
        const DipLightDef *light = &lit->lighting->lights[l];
        double to_light[3];
        const double share = dip_reference_arrival(light, lit->eye, place, to_light) *
                             (l == shadowed ? sunlit : 1.0);
        double *sum = l == shadowed && direct ? direct : diffuse;
        const double facing = dot(normal, to_light);
        if (!(facing > 0.0)) {
            continue;
        }
        double half[3];
        for (int i = 0; i < 3; i++) {
            half[i] = to_light[i] + to_eye[i];
        }
        normalise(half);
        const double peak = pow(fmin(fmax(dot(normal, half), 0.0), 1.0), exponent);
        for (int c = 0; c < 3; c++) {
            sum[c] += share * light->colour_lin[c] * facing;
            highlight[c] += share * light->colour_lin[c] * material->specular_lin[c] * peak;
        }
    }
}
