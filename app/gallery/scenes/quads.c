// Draws the gallery scene "quads": three quads. Fragment shaders compute their pictures without any
// texture. They come from seed 001, where they are called "Horrible trick", "Flame" and "ShaderToy
// shader"; gallery.h says what a seed is.
//
// The first quad shows rings that move outwards. The second shows a flame, whose light is summed
// along rays. The third shows a wobbling sphere over a fluid; marching along rays finds both
// surfaces. Multisampling alone does not help here, since it shades each pixel once. Instead,
// derivatives tell how many pixels wide the rings are. Rings narrower than five pixels begin to
// fade out, and rings of two pixels have vanished.
#include "app/gallery/kit/kit.h"

enum { RINGS, FLAME, BOWL, QUADS, FLAME_STEPS = 20, BOWL_STEPS = 36, SHADOW_STEPS = 8 };

typedef struct Uniforms {
    DipKitObject object;
    float turns; // Time as a share of the loop, 0..1.
} Uniforms;

typedef float Lanes[DIP_FRAGMENT_BATCH];

// --- rings ---------------------------------------------------------------------------------------

// Shades rings: grey = 1/2 + 1/2 cos(pi * rings * distance from the centre - time).
static void shade_rings(DipFragmentBatch *batch) {
    static const float rings = 44.0f;
    const Uniforms *uniforms = batch->uniforms;
    for (int i = 0; i < batch->count; i++) {
        const float u = batch->varying[DIP_KIT_UV][i] - 0.5f;
        const float v = batch->varying[DIP_KIT_UV + 1][i] - 0.5f;
        const float distance = sqrtf(u * u + v * v);
        const float wave = dip_kit_wave(0.25f + 0.5f * rings * distance - 12.0f * uniforms->turns);
        // Change of u and of v per pixel. The rings begin to fade out where a fifth of the wave's
        // period lies on a pixel, and vanish where half of it does.
        const float du =
            fabsf(batch->varying_dx[DIP_KIT_UV][i]) + fabsf(batch->varying_dy[DIP_KIT_UV][i]);
        const float dv = fabsf(batch->varying_dx[DIP_KIT_UV + 1][i]) +
                         fabsf(batch->varying_dy[DIP_KIT_UV + 1][i]);
        const float fade = dip_kit_smooth(0.5f, 0.2f, 0.5f * rings * dip_kit_greatest(du, dv));
        const float grey = 0.5f + 0.5f * wave * fade;
        const float warm = 1.0f - distance;
        dip_kit_set(batch->colour, i, grey * (0.30f + 0.65f * warm), grey * 0.62f,
                    grey * (1.0f - 0.55f * warm));
    }
}

// --- flame ---------------------------------------------------------------------------------------

// Shades a flame: sums its light along rays that cross it from front to back. The flame is round,
// and wide below and narrow above. Waves that rise with time move the flame's surface.
static void shade_flame(DipFragmentBatch *batch) {
    const Uniforms *uniforms = batch->uniforms;
    const float time = uniforms->turns;
    Lanes glow = {0};
    Lanes core = {0};
    for (int s = 0; s < FLAME_STEPS; s++) {
        const float z = 1.3f * (((float)s + 0.5f) / FLAME_STEPS - 0.5f);
        for (int i = 0; i < batch->count; i++) {
            const float y = 1.0f - batch->varying[DIP_KIT_UV + 1][i]; // 0 below, 1 above
            const float x0 = 2.4f * (batch->varying[DIP_KIT_UV][i] - 0.5f);
            const float sway = 0.16f * y * dip_kit_wave(1.1f * y - 9.0f * time + 0.2f * z);
            const float x = x0 + sway;
            const float licks = dip_kit_wave(1.6f * x + 2.3f * y - 21.0f * time) +
                                dip_kit_wave(2.1f * z - 1.7f * x + 1.9f * y - 15.0f * time) +
                                0.5f * dip_kit_wave(4.2f * x + 3.1f * z + 4.4f * y - 33.0f * time);
            const float round = y < 0.18f ? dip_kit_smooth(0.02f, 0.18f, y) : 1.0f;
            const float width = 0.56f * round * (1.04f - y) + 0.085f * y * licks;
            const float inside = width - sqrtf(x * x + z * z);
            glow[i] += inside > 0.0f ? 1.0f : dip_kit_smooth(-0.16f, 0.0f, inside) * 0.22f;
            core[i] += dip_kit_smooth(0.04f, 0.34f, inside);
        }
    }
    for (int i = 0; i < batch->count; i++) {
        const float y = 1.0f - batch->varying[DIP_KIT_UV + 1][i];
        const float g = glow[i] * (2.4f / FLAME_STEPS) * (1.15f - y);
        const float c = core[i] * (2.6f / FLAME_STEPS);
        const float blue = dip_kit_smooth(0.26f, 0.04f, y) * g;
        dip_kit_set(batch->colour, i, 0.010f + 0.95f * g + 0.5f * c,
                    0.008f + 0.26f * g * g + 0.75f * c,
                    0.014f + 0.02f * g + 0.30f * c * c + 0.8f * blue * (1.0f - 0.6f * c));
    }
}

// --- the sphere over the fluid -------------------------------------------------------------------

// Returns the height of the fluid's surface above a point of the x-z plane.
static inline float fluid_at(DipKitVector p, float turns) {
    return -1.0f + 0.13f * dip_kit_wave(0.31f * p.x + 4.0f * turns) +
           0.11f * dip_kit_wave(0.37f * p.z - 0.15f * p.x - 5.0f * turns) +
           0.04f * dip_kit_wave(0.9f * p.x + 0.7f * p.z + 8.0f * turns);
}

// Returns roughly the signed distance of a point from the sphere, whose surface waves distort.
static inline float sphere_at(DipKitVector p, float turns) {
    const float bumps = dip_kit_wave(0.5f * p.x + 3.0f * turns) +
                        dip_kit_wave(0.6f * p.y - 6.0f * turns) +
                        dip_kit_wave(0.55f * p.z + 5.0f * turns);
    return sqrtf(dip_kit_dot(p, p)) - 0.86f - 0.07f * bumps;
}

// Returns roughly the distance of a point from the fluid.
static inline float above_fluid(DipKitVector p, float turns) {
    return 0.75f * (p.y - fluid_at(p, turns));
}

static inline float scene_at(DipKitVector p, float turns) {
    return dip_kit_least(sphere_at(p, turns), above_fluid(p, turns));
}

// Returns a point between a and b. If `share` is 0, the point is a; if it is 1, the point is b.
static inline DipKitVector point_between(DipKitVector a, DipKitVector b, float share) {
    return dip_kit_plus(a, dip_kit_times(dip_kit_minus(b, a), share));
}

// The rays of a batch through the third quad's picture. They begin at bowl_eye.
typedef struct March {
    Lanes points[3];    // Points that the rays have reached.
    Lanes rays[3];      // Directions of the rays, of unit length.
    Lanes shadow;       // Share of the light that reaches each point.
    DipKitVector light; // Position of the light.
} March;

static const DipKitVector bowl_eye = {0.0f, 0.85f, 3.4f};

static void begin_march(const DipFragmentBatch *batch, March *march) {
    for (int i = 0; i < batch->count; i++) {
        const DipKitVector ray = {1.15f * (batch->varying[DIP_KIT_UV][i] - 0.5f),
                                  1.15f * (0.5f - batch->varying[DIP_KIT_UV + 1][i]) - 0.22f,
                                  -1.0f};
        dip_kit_put(march->points, i, bowl_eye);
        dip_kit_put(march->rays, i, dip_kit_times(ray, dip_kit_per_length(ray, 0.0f)));
    }
}

// Steps from each point to the light and computes a soft shadow from how near to the sphere the
// steps come.
static void find_shadows(int count, float turns, March *march) {
    for (int i = 0; i < count; i++) {
        march->shadow[i] = 1.0f;
    }
    for (int s = 0; s < SHADOW_STEPS; s++) {
        const float way = 0.06f + 0.94f * ((float)s + 0.5f) / SHADOW_STEPS;
        for (int i = 0; i < count; i++) {
            const DipKitVector p = point_between(dip_kit_get(march->points, i), march->light, way);
            const float open = dip_kit_clamp(0.5f + 2.2f * sphere_at(p, turns) / way, 0.0f, 1.0f);
            march->shadow[i] = dip_kit_least(open, march->shadow[i]);
        }
    }
}

static void shade_hit(DipFragmentBatch *batch, March *march, float turns, int i) {
    static const float sky[3] = {0.16f, 0.20f, 0.30f};
    static const float step = 0.02f;
    const DipKitVector p = dip_kit_get(march->points, i);
    const DipKitVector ray = dip_kit_get(march->rays, i);
    const float here = scene_at(p, turns);
    DipKitVector normal = {scene_at((DipKitVector){p.x + step, p.y, p.z}, turns) - here,
                           scene_at((DipKitVector){p.x, p.y + step, p.z}, turns) - here,
                           scene_at((DipKitVector){p.x, p.y, p.z + step}, turns) - here};
    normal = dip_kit_times(normal, dip_kit_per_length(normal, 1e-12f));
    const DipKitVector to_light = dip_kit_minus(march->light, p);
    const float l = dip_kit_per_length(to_light, 0.0f);
    const float toward = dip_kit_dot(normal, to_light) * l;
    const float facing = -dip_kit_dot(normal, ray);
    const DipKitVector mirrored = dip_kit_plus(ray, dip_kit_times(normal, 2.0f * facing));
    const float mirror = dip_kit_dot(mirrored, to_light) * l;
    const float highlight = dip_kit_power(dip_kit_greatest(mirror, 0.0f), 5);
    const float rim = dip_kit_power(1.0f - dip_kit_clamp(facing, 0.0f, 1.0f), 1);
    const bool sphere = sphere_at(p, turns) < above_fluid(p, turns);
    const float lit = dip_kit_greatest(toward, 0.0f) * march->shadow[i];
    const DipKitVector from_eye = dip_kit_minus(p, bowl_eye);
    const float fog = dip_kit_smooth(4.0f, 10.0f, sqrtf(dip_kit_dot(from_eye, from_eye)));
    const float body[3] = {sphere ? 0.85f : 0.05f, sphere ? 0.28f : 0.30f, sphere ? 0.14f : 0.42f};
    for (int c = 0; c < 3; c++) {
        const float light =
            body[c] * (0.10f + 1.15f * lit) + 0.7f * highlight * march->shadow[i] + sky[c] * rim;
        batch->colour[c][i] = dip_kit_mix(light, sky[c], fog);
    }
}

static void shade_bowl(DipFragmentBatch *batch) {
    const float turns = ((const Uniforms *)batch->uniforms)->turns;
    March march;
    begin_march(batch, &march);
    for (int s = 0; s < BOWL_STEPS; s++) {
        for (int i = 0; i < batch->count; i++) {
            const DipKitVector p = dip_kit_get(march.points, i);
            const float length = dip_kit_least(0.9f * scene_at(p, turns), 1.0f);
            const DipKitVector way = dip_kit_times(dip_kit_get(march.rays, i), length);
            dip_kit_put(march.points, i, dip_kit_plus(p, way));
        }
    }
    march.light =
        (DipKitVector){2.6f * dip_kit_wave(turns), 2.4f, 2.6f * dip_kit_wave(turns + 0.25f)};
    find_shadows(batch->count, turns, &march);
    for (int i = 0; i < batch->count; i++) {
        shade_hit(batch, &march, turns, i);
    }
}

// --- drawing -------------------------------------------------------------------------------------

static DipGalleryCamera camera(double turn) {
    return (DipGalleryCamera){
        .eye = {2.2 * dip_sin(turn), 0.2 * dip_sin(2.0 * turn), 5.1 + 1.6 * dip_cos(2.0 * turn)},
        .target = {1.9 * dip_sin(turn), 0.0, 0.0}};
}

static bool draw(const DipGalleryView *view, DipError *err) {
    static const float clear_lin[3] = {0.020f, 0.022f, 0.028f};
    static DipFragmentShader *const shaders[QUADS] = {shade_rings, shade_flame, shade_bowl};
    const Uniforms uniforms = {.turns = view->turns};
    DipKitList list = dip_kit_list(view, 0.1, err);
    for (int q = 0; q < QUADS; q++) {
        // The outer quads turn towards the middle, like the wings of a triptych.
        const DipMatrix model =
            dip_kit_chain(dip_matrix_translation(2.12 * (q - 1), 0.0, q == 1 ? 0.0 : 0.35),
                          dip_matrix_rotation(1, -0.35 * (q - 1)));
        dip_kit_add(&list, view->stock->meshes[0], &uniforms, &model, shaders[q]);
    }
    return dip_kit_show(&list, clear_lin);
}

const DipGalleryScene dip_gallery_quads = {
    .info = {.name = "quads",
             .title = "Procedural quads",
             .text =
                 "Rings, a flame and a ray-marched sphere over a fluid, each computed per pixel "
                 "in a fragment shader.",
             DIP_KIT_LOOKS("three quads")},
    .meshes = {{DIP_KIT_QUAD, {2.0f, 2.0f}}},
    .camera = camera,
    .draw = draw,
};
