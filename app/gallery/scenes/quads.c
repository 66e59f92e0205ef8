// The gallery scene "quads": pictures that fragment shaders compute by themselves, on three quads.
//
// As in seed 001 ("Horrible trick", "Flame", "ShaderToy shader"): rings that move outwards, a flame
// whose light is summed along rays, and a wobbling sphere over a fluid, found by marching along
// rays. No texture is read. Multisampling does not help here, since each pixel is shaded once; the
// rings therefore fade out where they are narrower than two pixels, by their derivatives.
#include "app/gallery/kit/kit.h"
#include "renderer/base/assert.h"
#include "renderer/base/trig.h"

enum { RINGS, FLAME, BOWL, QUADS, FLAME_STEPS = 20, BOWL_STEPS = 36, SHADOW_STEPS = 8 };

typedef struct Uniforms {
    DipKitObject object;
    float turns; // time as turns of the loop, 0..1
} Uniforms;

typedef struct Content {
    DipKitStock stock;
    Uniforms uniforms[QUADS];
} Content;

static const char *const looks[] = {"three quads"};

typedef float Lanes[DIP_FRAGMENT_BATCH];

// --- rings ---------------------------------------------------------------------------------------

// grey = 1/2 + 1/2 cos(pi * rings * distance from the centre - time)
static void shade_rings(DipFragmentBatch *batch) {
    static const float rings = 44.0f;
    const Uniforms *uniforms = batch->uniforms;
    for (int i = 0; i < batch->count; i++) {
        const float u = batch->varying[DIP_KIT_UV][i] - 0.5f;
        const float v = batch->varying[DIP_KIT_UV + 1][i] - 0.5f;
        const float distance = sqrtf(u * u + v * v);
        const float wave = dip_kit_wave(0.25f + 0.5f * rings * distance - 12.0f * uniforms->turns);
        // Turns per pixel, from the derivatives of u and v.
        const float du =
            fabsf(batch->varying_dx[DIP_KIT_UV][i]) + fabsf(batch->varying_dy[DIP_KIT_UV][i]);
        const float dv = fabsf(batch->varying_dx[DIP_KIT_UV + 1][i]) +
                         fabsf(batch->varying_dy[DIP_KIT_UV + 1][i]);
        const float fade = dip_kit_smooth(0.5f, 0.2f, 0.5f * rings * (du > dv ? du : dv));
        const float grey = 0.5f + 0.5f * wave * fade;
        const float warm = 1.0f - distance;
        batch->colour[0][i] = grey * (0.30f + 0.65f * warm);
        batch->colour[1][i] = grey * 0.62f;
        batch->colour[2][i] = grey * (1.0f - 0.55f * warm);
    }
}

// --- flame ---------------------------------------------------------------------------------------

// Sums the light of a flame along rays that cross it from front to back. The flame is round, wide
// below and narrow above; waves that rise with time move its surface.
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
        batch->colour[0][i] = 0.010f + 0.95f * g + 0.5f * c;
        batch->colour[1][i] = 0.008f + 0.26f * g * g + 0.75f * c;
        batch->colour[2][i] = 0.014f + 0.02f * g + 0.30f * c * c + 0.8f * blue * (1.0f - 0.6f * c);
    }
}

// --- the sphere over the fluid -------------------------------------------------------------------

// Height of the fluid's surface.
static inline float fluid_at(float x, float z, float turns) {
    return -1.0f + 0.13f * dip_kit_wave(0.31f * x + 4.0f * turns) +
           0.11f * dip_kit_wave(0.37f * z - 0.15f * x - 5.0f * turns) +
           0.04f * dip_kit_wave(0.9f * x + 0.7f * z + 8.0f * turns);
}

// Signed distance, roughly, of a point from the sphere, whose surface waves distort.
static inline float sphere_at(float x, float y, float z, float turns) {
    const float bumps = dip_kit_wave(0.5f * x + 3.0f * turns) +
                        dip_kit_wave(0.6f * y - 6.0f * turns) +
                        dip_kit_wave(0.55f * z + 5.0f * turns);
    return sqrtf(x * x + y * y + z * z) - 0.86f - 0.07f * bumps;
}

static inline float scene_at(float x, float y, float z, float turns) {
    const float sphere = sphere_at(x, y, z, turns);
    const float fluid = 0.75f * (y - fluid_at(x, z, turns));
    return sphere < fluid ? sphere : fluid;
}

typedef struct March {
    Lanes x, y, z;    // points that the rays have reached
    Lanes dx, dy, dz; // directions, of unit length
    Lanes shadow;     // share of the light
    float light[3];   // where the light is
} March;

static void begin_march(const DipFragmentBatch *batch, March *march) {
    for (int i = 0; i < batch->count; i++) {
        const float dx = 1.15f * (batch->varying[DIP_KIT_UV][i] - 0.5f);
        const float dy = 1.15f * (0.5f - batch->varying[DIP_KIT_UV + 1][i]) - 0.22f;
        const float scale = 1.0f / sqrtf(dx * dx + dy * dy + 1.0f);
        march->x[i] = 0.0f;
        march->y[i] = 0.85f;
        march->z[i] = 3.4f;
        march->dx[i] = dx * scale;
        march->dy[i] = dy * scale;
        march->dz[i] = -scale;
    }
}

// Steps from each point to the light and keeps how near the sphere came, for soft shadows.
static void find_shadows(int count, float turns, March *march) {
    for (int i = 0; i < count; i++) {
        march->shadow[i] = 1.0f;
    }
    for (int s = 0; s < SHADOW_STEPS; s++) {
        const float way = 0.06f + 0.94f * ((float)s + 0.5f) / SHADOW_STEPS;
        for (int i = 0; i < count; i++) {
            const float x = march->x[i] + way * (march->light[0] - march->x[i]);
            const float y = march->y[i] + way * (march->light[1] - march->y[i]);
            const float z = march->z[i] + way * (march->light[2] - march->z[i]);
            const float open =
                dip_kit_clamp(0.5f + 2.2f * sphere_at(x, y, z, turns) / way, 0.0f, 1.0f);
            march->shadow[i] = open < march->shadow[i] ? open : march->shadow[i];
        }
    }
}

static void shade_hit(DipFragmentBatch *batch, const March *march, float turns, int i) {
    static const float step = 0.02f;
    const float x = march->x[i];
    const float y = march->y[i];
    const float z = march->z[i];
    const float here = scene_at(x, y, z, turns);
    float nx = scene_at(x + step, y, z, turns) - here;
    float ny = scene_at(x, y + step, z, turns) - here;
    float nz = scene_at(x, y, z + step, turns) - here;
    const float n = 1.0f / sqrtf(nx * nx + ny * ny + nz * nz + 1e-12f);
    nx *= n;
    ny *= n;
    nz *= n;
    const float lx = march->light[0] - x;
    const float ly = march->light[1] - y;
    const float lz = march->light[2] - z;
    const float l = 1.0f / sqrtf(lx * lx + ly * ly + lz * lz);
    const float toward = (nx * lx + ny * ly + nz * lz) * l;
    const float facing = -(nx * march->dx[i] + ny * march->dy[i] + nz * march->dz[i]);
    const float rx = march->dx[i] + 2.0f * facing * nx;
    const float ry = march->dy[i] + 2.0f * facing * ny;
    const float rz = march->dz[i] + 2.0f * facing * nz;
    const float mirror = (rx * lx + ry * ly + rz * lz) * l;
    const float highlight = dip_kit_power(mirror > 0.0f ? mirror : 0.0f, 5);
    const float rim = dip_kit_power(1.0f - dip_kit_clamp(facing, 0.0f, 1.0f), 1);
    const bool sphere = sphere_at(x, y, z, turns) < 0.75f * (y - fluid_at(x, z, turns));
    const float lit = (toward > 0.0f ? toward : 0.0f) * march->shadow[i];
    const float distance = sqrtf(x * x + (y - 0.85f) * (y - 0.85f) + (z - 3.4f) * (z - 3.4f));
    const float fog = dip_kit_smooth(4.0f, 10.0f, distance);
    const float body[3] = {sphere ? 0.85f : 0.05f, sphere ? 0.28f : 0.30f, sphere ? 0.14f : 0.42f};
    static const float sky[3] = {0.16f, 0.20f, 0.30f};
    for (int c = 0; c < 3; c++) {
        const float light =
            body[c] * (0.10f + 1.15f * lit) + 0.7f * highlight * march->shadow[i] + sky[c] * rim;
        batch->colour[c][i] = dip_kit_mix(light, sky[c], fog);
    }
}

static void shade_bowl(DipFragmentBatch *batch) {
    const Uniforms *uniforms = batch->uniforms;
    const float turns = uniforms->turns;
    March march;
    begin_march(batch, &march);
    for (int s = 0; s < BOWL_STEPS; s++) {
        for (int i = 0; i < batch->count; i++) {
            const float step = 0.9f * scene_at(march.x[i], march.y[i], march.z[i], turns);
            const float length = step < 1.0f ? step : 1.0f;
            march.x[i] += length * march.dx[i];
            march.y[i] += length * march.dy[i];
            march.z[i] += length * march.dz[i];
        }
    }
    march.light[0] = 2.6f * dip_kit_wave(turns);
    march.light[1] = 2.4f;
    march.light[2] = 2.6f * dip_kit_wave(turns + 0.25f);
    find_shadows(batch->count, turns, &march);
    for (int i = 0; i < batch->count; i++) {
        shade_hit(batch, &march, turns, i);
    }
}

// --- content -------------------------------------------------------------------------------------

static bool create(void *content, const DipGalleryRoom *room, DipError *err) {
    (void)room;
    return dip_kit_quad(&((DipKitStock *)content)->meshes[0], 2.0f, 2.0f, err);
}

// --- drawing -------------------------------------------------------------------------------------

static DipGalleryCamera camera(double turn) {
    return (DipGalleryCamera){
        .eye = {2.2 * dip_sin(turn), 0.2 * dip_sin(2.0 * turn), 5.1 + 1.6 * dip_cos(2.0 * turn)},
        .target = {1.9 * dip_sin(turn), 0.0, 0.0}};
}

static bool draw(void *pointer, const DipGalleryView *view, DipError *err) {
    static const float clear_lin[3] = {0.020f, 0.022f, 0.028f};
    static DipFragmentShader *const shaders[QUADS] = {shade_rings, shade_flame, shade_bowl};
    Content *content = pointer;
    DipKitList list = dip_kit_list(view, 0.1, err);
    for (int q = 0; q < QUADS; q++) {
        // The outer quads turn towards the middle, like the wings of a triptych.
        const DipMatrix move = dip_matrix_translation(2.12 * (q - 1), 0.0, q == 1 ? 0.0 : 0.35);
        const DipMatrix turn = dip_matrix_rotation(1, -0.35 * (q - 1));
        const DipMatrix model = dip_matrix_multiply(&move, &turn);
        content->uniforms[q].turns = (float)(view->time_s / DIP_GALLERY_SECONDS);
        dip_kit_add(&list, content->stock.meshes[0], &content->uniforms[q], &model, shaders[q]);
    }
    return dip_kit_show(&list, clear_lin);
}

const DipGalleryScene dip_gallery_quads = {
    .info = {.name = "quads",
             .title = "Procedural quads",
             .text =
                 "Rings, a flame and a ray-marched sphere over a fluid, each computed per pixel "
                 "in a fragment shader.",
             .looks = looks,
             .look_count = (int)DIP_ARRAY_COUNT(looks)},
    .content_bytes = sizeof(Content),
    .camera = camera,
    .create = create,
    .draw = draw,
};
