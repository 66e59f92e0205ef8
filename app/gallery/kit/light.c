// Shades points with lights, in loops that become vector code.
#include "app/gallery/kit/light.h"

#include "app/gallery/kit/kit.h"

#include <math.h>

void dip_kit_normalise(const float *const in[3], int count, float (*out)[DIP_FRAGMENT_BATCH]) {
    for (int i = 0; i < count; i++) {
        const float x = in[0][i];
        const float y = in[1][i];
        const float z = in[2][i];
        const float scale = 1.0f / sqrtf(x * x + y * y + z * z + 1e-30f);
        out[0][i] = x * scale;
        out[1][i] = y * scale;
        out[2][i] = z * scale;
    }
}

DipKitPoints dip_kit_fragment_points(const DipFragmentBatch *batch,
                                     float (*normals)[DIP_FRAGMENT_BATCH]) {
    const float *const in[3] = {batch->varying[DIP_KIT_NORMAL], batch->varying[DIP_KIT_NORMAL + 1],
                                batch->varying[DIP_KIT_NORMAL + 2]};
    dip_kit_normalise(in, batch->count, normals);
    return (DipKitPoints){
        .count = batch->count,
        .position = {batch->varying[DIP_KIT_WORLD], batch->varying[DIP_KIT_WORLD + 1],
                     batch->varying[DIP_KIT_WORLD + 2]},
        .normal = {normals[0], normals[1], normals[2]},
        .eye = ((const DipKitObject *)batch->uniforms)->eye,
    };
}

// Directions to the light, as unit vectors, and how much of it arrives.
typedef struct Rays {
    float x[DIP_FRAGMENT_BATCH];
    float y[DIP_FRAGMENT_BATCH];
    float z[DIP_FRAGMENT_BATCH];
    float strength[DIP_FRAGMENT_BATCH];
} Rays;

static void find_rays(const DipKitLight *light, const DipKitPoints *points, Rays *rays) {
    const float fade = 1.0f / (light->reach * light->reach);
    for (int i = 0; i < points->count; i++) {
        const float x = light->position[0] - points->position[0][i];
        const float y = light->position[1] - points->position[1][i];
        const float z = light->position[2] - points->position[2][i];
        const float squared = x * x + y * y + z * z + 1e-12f;
        const float scale = 1.0f / sqrtf(squared);
        rays->x[i] = x * scale;
        rays->y[i] = y * scale;
        rays->z[i] = z * scale;
        rays->strength[i] = 1.0f / (1.0f + squared * fade);
    }
    if (light->kind != DIP_KIT_SPOT) {
        return;
    }
    for (int i = 0; i < points->count; i++) {
        const float along = -(rays->x[i] * light->direction[0] + rays->y[i] * light->direction[1] +
                              rays->z[i] * light->direction[2]);
        rays->strength[i] *= dip_kit_smooth(light->outer_cos, light->inner_cos, along);
    }
}

static void find_parallel_rays(const DipKitLight *light, int count, Rays *rays) {
    for (int i = 0; i < count; i++) {
        rays->x[i] = -light->direction[0];
        rays->y[i] = -light->direction[1];
        rays->z[i] = -light->direction[2];
        rays->strength[i] = 1.0f;
    }
}

// Replaces each ray's strength by the diffuse factor and writes the specular factor (Blinn: the
// cosine between the normal and the half-way vector, raised to a power).
static void find_factors(const DipKitPoints *points, const DipKitMaterial *material, Rays *rays,
                         float *specular) {
    for (int i = 0; i < points->count; i++) {
        const float nx = points->normal[0][i];
        const float ny = points->normal[1][i];
        const float nz = points->normal[2][i];
        const float ex = points->eye[0] - points->position[0][i];
        const float ey = points->eye[1] - points->position[1][i];
        const float ez = points->eye[2] - points->position[2][i];
        const float e = 1.0f / sqrtf(ex * ex + ey * ey + ez * ez + 1e-30f);
        const float hx = rays->x[i] + ex * e;
        const float hy = rays->y[i] + ey * e;
        const float hz = rays->z[i] + ez * e;
        const float h = 1.0f / sqrtf(hx * hx + hy * hy + hz * hz + 1e-12f);
        const float toward = nx * rays->x[i] + ny * rays->y[i] + nz * rays->z[i];
        const float half = (nx * hx + ny * hy + nz * hz) * h;
        const float peak = dip_kit_power(half > 0.0f ? half : 0.0f, material->exponent_doubled);
        specular[i] = toward > 0.0f ? peak * rays->strength[i] : 0.0f;
        rays->strength[i] = toward > 0.0f ? toward * rays->strength[i] : 0.0f;
    }
}

void dip_kit_light_add(const DipKitLight *light, const DipKitMaterial *material,
                       const DipKitPoints *points, const float *lit,
                       float (*out)[DIP_FRAGMENT_BATCH]) {
    Rays rays;
    float specular[DIP_FRAGMENT_BATCH];
    if (light->kind == DIP_KIT_DIRECTIONAL) {
        find_parallel_rays(light, points->count, &rays);
    } else {
        find_rays(light, points, &rays);
    }
    find_factors(points, material, &rays, specular);
    for (int i = 0; lit && i < points->count; i++) {
        rays.strength[i] *= lit[i];
        specular[i] *= lit[i];
    }
    for (int c = 0; c < 3; c++) {
        const float diffuse = material->diffuse[c] * light->colour[c];
        const float mirrored = material->specular[c] * light->colour[c];
        for (int i = 0; i < points->count; i++) {
            out[c][i] += diffuse * rays.strength[i] + mirrored * specular[i];
        }
    }
}

void dip_kit_light_all(const float ambient[3], const DipKitLight *lights, int light_count,
                       const DipKitMaterial *material, const DipKitPoints *points,
                       float (*out)[DIP_FRAGMENT_BATCH]) {
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < points->count; i++) {
            out[c][i] = ambient[c];
        }
    }
    for (int l = 0; l < light_count; l++) {
        dip_kit_light_add(&lights[l], material, points, NULL, out);
    }
}

void dip_kit_light_fragments(const DipFragmentBatch *batch, const float ambient[3],
                             const DipKitLight *lights, int light_count,
                             const DipKitMaterial *material, float (*out)[DIP_FRAGMENT_BATCH]) {
    float normals[3][DIP_FRAGMENT_BATCH];
    const DipKitPoints points = dip_kit_fragment_points(batch, normals);
    dip_kit_light_all(ambient, lights, light_count, material, &points, out);
}
