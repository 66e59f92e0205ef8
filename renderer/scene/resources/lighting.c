// Keeps the lights of a scene.
#include "renderer/scene/resources/lighting.h"

#include "renderer/base/trig.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const DipLightingDef *dip_lighting_fixed(void) {
    static const DipLightDef sun = {
        .name = "sun",
        .kind = DIP_LIGHT_DIRECTIONAL,
        .colour_lin = {0.65f, 0.65f, 0.65f},
        .direction_world = {0.42f, -0.67f, -0.61f},
    };
    static const DipLightingDef fixed = {
        .ambient_lin = {0.35f, 0.35f, 0.35f},
        .sky_lin = {0.15f, 0.15f, 0.15f},
        .lights = &sun,
        .light_count = 1,
        .shading = DIP_SHADING_GOURAUD,
    };
    return &fixed;
}

// Returns the strongest directional light by its luminance, the first of equal ones, or -1.
static int find_shadow_light(const DipLightingDef *def) {
    int found = -1;
    double greatest = 0.0;
    for (int i = 0; i < def->light_count; i++) {
        const float *colour = def->lights[i].colour_lin;
        const double luminance = (0.2126 * colour[0] + 0.7152 * colour[1]) + 0.0722 * colour[2];
        if (def->lights[i].kind == DIP_LIGHT_DIRECTIONAL && luminance > greatest) {
            greatest = luminance;
            found = i;
        }
    }
    return found;
}

DipSceneLighting *dip_scene_lighting_create(const DipLightingDef *def) {
    DipSceneLighting *lighting = calloc(1, sizeof *lighting);
    if (!lighting) {
        return NULL;
    }
    memcpy(lighting->ambient_lin, def->ambient_lin, sizeof lighting->ambient_lin);
    memcpy(lighting->sky_lin, def->sky_lin, sizeof lighting->sky_lin);
    lighting->shading = def->shading;
    lighting->shadow_light = find_shadow_light(def);
    lighting->count = def->light_count;
    for (int i = 0; i < def->light_count; i++) {
        lighting->lights[i] = def->lights[i];
        lighting->lights[i].name = NULL;
    }
    return lighting;
}

void dip_lighting_reverse(const float direction[3], double reversed[3]) {
    double greatest = 0.0;
    for (int i = 0; i < 3; i++) {
        greatest = fmax(greatest, fabs((double)direction[i]));
    }
    double v[3];
    for (int i = 0; i < 3; i++) {
        v[i] = direction[i] / greatest;
    }
    const double length = sqrt((v[0] * v[0] + v[1] * v[1]) + v[2] * v[2]);
    for (int i = 0; i < 3; i++) {
        reversed[i] = -v[i] / length;
    }
}

static void set_cone(const DipLightDef *light, DipLightUniforms *uniforms) {
    const double inner = dip_cos(light->inner_deg * (DIP_PI / 180.0));
    const double outer = dip_cos(light->outer_deg * (DIP_PI / 180.0));
    const double scale = 1.0 / fmax(0.001, inner - outer);
    uniforms->cone_scale = (float)scale;
    uniforms->cone_shift = (float)(-outer * scale);
}

// A point or spot light that is farther from the eye than this distance acts like a directional
// light, as strong as it is at the eye: the square of a much greater distance is not a float.
#define FAR_AWAY_M 1e18

// Returns the part of a point or spot light that arrives at the eye. to_light: unit vector.
static double share_at_eye(const DipLightDef *light, const DipLightUniforms *uniforms,
                           const double to_light[3], double distance) {
    const float *a = light->attenuation;
    if (light->range_m > 0.0f) {
        return 0.0; // no range is as long as FAR_AWAY_M
    }
    double share = 1.0 / ((a[0] + a[1] * distance) + a[2] * distance * distance);
    if (light->kind == DIP_LIGHT_SPOT) {
        double cosine = 0.0;
        for (int k = 0; k < 3; k++) {
            cosine += to_light[k] * uniforms->to_light[k];
        }
        const double cone = cosine * uniforms->cone_scale + uniforms->cone_shift;
        share *= fmin(fmax(cone, 0.0), 1.0) * fmin(fmax(cone, 0.0), 1.0);
    }
    return share;
}

// Makes a light that is far away directional.
static void make_directional(const DipLightDef *light, const double eye[3],
                             DipLightUniforms *uniforms) {
    double to_light[3];
    double distance2 = 0.0;
    for (int k = 0; k < 3; k++) {
        to_light[k] = light->position_world[k] - eye[k];
        distance2 += to_light[k] * to_light[k];
    }
    if (light->kind == DIP_LIGHT_DIRECTIONAL || !(distance2 > FAR_AWAY_M * FAR_AWAY_M)) {
        return;
    }
    const double distance = sqrt(distance2);
    for (int k = 0; k < 3; k++) {
        to_light[k] /= distance;
    }
    const double share = share_at_eye(light, uniforms, to_light, distance);
    for (int k = 0; k < 3; k++) {
        uniforms->colour_lin[k] = (float)(light->colour_lin[k] * share);
        uniforms->to_light[k] = (float)to_light[k];
    }
    uniforms->kind = DIP_LIGHT_DIRECTIONAL;
}

void dip_lighting_at(const DipSceneLighting *lighting, const double eye[3],
                     DipLightingUniforms *uniforms) {
    memcpy(uniforms->ambient_lin, lighting->ambient_lin, sizeof uniforms->ambient_lin);
    memcpy(uniforms->sky_lin, lighting->sky_lin, sizeof uniforms->sky_lin);
    uniforms->count = lighting->count;
    for (int i = 0; i < lighting->count; i++) {
        const DipLightDef *light = &lighting->lights[i];
        DipLightUniforms *out = &uniforms->lights[i];
        *out = (DipLightUniforms){.kind = light->kind};
        memcpy(out->colour_lin, light->colour_lin, sizeof out->colour_lin);
        memcpy(out->attenuation, light->attenuation, sizeof out->attenuation);
        for (int k = 0; k < 3; k++) {
            out->from_eye[k] = (float)(light->position_world[k] - eye[k]);
        }
        if (light->range_m > 0.0f) {
            out->inverse_range2 = (float)(1.0 / ((double)light->range_m * light->range_m));
        }
        if (light->kind != DIP_LIGHT_POINT) {
            double to_light[3];
            dip_lighting_reverse(light->direction_world, to_light);
            for (int k = 0; k < 3; k++) {
                out->to_light[k] = (float)to_light[k];
            }
        }
        if (light->kind == DIP_LIGHT_SPOT) {
            set_cone(light, out);
        }
        make_directional(light, eye, out);
    }
}

uint64_t dip_lights_reaching(const DipSceneLighting *lighting, const DipBox *box) {
    // The shader rounds the distance to a light, so a light reaches a little farther than its
    // range.
    static const double margin = 1.001;
    uint64_t reaching = 0;
    for (int i = 0; i < lighting->count; i++) {
        const DipLightDef *light = &lighting->lights[i];
        double distance2 = 0.0;
        for (int k = 0; k < 3; k++) {
            const double away = fabs((double)light->position_world[k] - box->centre[k]) -
                                (double)box->extent[k] * margin;
            distance2 += away > 0.0 ? away * away : 0.0;
        }
        const double reach = light->range_m * margin;
        const bool near = !(distance2 > reach * reach);
        if (light->kind == DIP_LIGHT_DIRECTIONAL || light->range_m == 0.0f || near) {
            reaching |= UINT64_C(1) << i;
        }
    }
    return reaching;
}
