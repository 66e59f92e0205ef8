// Shades points with lights, in loops that the compiler turns into vector code.
#include "app/gallery/kit/light.h"

#include "app/gallery/kit/kit.h"

static inline DipKitVector vector_at(const float *const arrays[3], int i) {
    return (DipKitVector){arrays[0][i], arrays[1][i], arrays[2][i]};
}

void dip_kit_normalise(const float *const in[3], int count, float (*out)[DIP_FRAGMENT_BATCH]) {
    for (int i = 0; i < count; i++) {
        const DipKitVector v = vector_at(in, i);
        dip_kit_put(out, i, dip_kit_times(v, dip_kit_per_length(v, 1e-30f)));
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

// The ray from each point to a light.
typedef struct Rays {
    float toward[3][DIP_FRAGMENT_BATCH]; // Unit vectors towards the light.
    float strength[DIP_FRAGMENT_BATCH];  // Share of the light that arrives, 0..1.
} Rays;

static void find_rays(const DipKitLight *light, const DipKitPoints *points, Rays *rays) {
    const DipKitVector position = dip_kit_vector(light->position);
    const DipKitVector direction = dip_kit_vector(light->direction);
    const float fade = 1.0f / (light->reach * light->reach);
    for (int i = 0; i < points->count; i++) {
        const DipKitVector way = dip_kit_minus(position, vector_at(points->position, i));
        const float squared = dip_kit_dot(way, way) + 1e-12f;
        dip_kit_put(rays->toward, i, dip_kit_times(way, 1.0f / sqrtf(squared)));
        rays->strength[i] = 1.0f / (1.0f + squared * fade);
    }
    for (int i = 0; light->kind == DIP_KIT_SPOT && i < points->count; i++) {
        const DipKitVector ray = dip_kit_get(rays->toward, i);
        rays->strength[i] *=
            dip_kit_smooth(light->outer_cos, light->inner_cos, -dip_kit_dot(ray, direction));
    }
}

static void find_parallel_rays(const DipKitLight *light, int count, Rays *rays) {
    for (int i = 0; i < count; i++) {
        dip_kit_put(rays->toward, i, dip_kit_times(dip_kit_vector(light->direction), -1.0f));
        rays->strength[i] = 1.0f;
    }
}

// Multiplies each ray's strength by the diffuse factor, the cosine between the normal and the
// ray. Writes to `specular` the strength times the specular factor: the cosine between the
// normal and Blinn's half-way vector, raised to a power. Both results are 0 where the surface
// faces away from the light.
static void find_factors(const DipKitPoints *points, const DipKitMaterial *material, Rays *rays,
                         float *specular) {
    const DipKitVector eye = dip_kit_vector(points->eye);
    for (int i = 0; i < points->count; i++) {
        const DipKitVector normal = vector_at(points->normal, i);
        const DipKitVector ray = dip_kit_get(rays->toward, i);
        const DipKitVector to_eye = dip_kit_minus(eye, vector_at(points->position, i));
        const DipKitVector half =
            dip_kit_plus(ray, dip_kit_times(to_eye, dip_kit_per_length(to_eye, 1e-30f)));
        const float lit = dip_kit_dot(normal, ray);
        const float mirrored = dip_kit_dot(normal, half) * dip_kit_per_length(half, 1e-12f);
        const float peak =
            dip_kit_power(dip_kit_greatest(mirrored, 0.0f), material->exponent_doubled);
        specular[i] = lit > 0.0f ? peak * rays->strength[i] : 0.0f;
        rays->strength[i] = lit > 0.0f ? lit * rays->strength[i] : 0.0f;
    }
}

void dip_kit_light_sky(const float sky[3], float upright, const DipKitMaterial *material,
                       const DipKitPoints *points, float (*out)[DIP_FRAGMENT_BATCH]) {
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < points->count; i++) {
            const float open = upright + (1.0f - upright) * points->normal[1][i];
            out[c][i] = sky[c] * open * material->diffuse[c];
        }
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
