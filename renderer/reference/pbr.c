// Metallic-roughness surfaces: docs/picture.md, "Metal and gloss".
#include "renderer/reference/internal/internal.h"

#include <math.h>
#include <pthread.h>

static const double pi = 3.14159265358979323846;

// Steps of the tables along each axis, of those that have as few as the fast renderer's, and of the
// integrals along each of their two axes.
enum { STEPS = 64, FEW_STEPS = 32, INTEGRAL_STEPS = 24 };

// Shares of reflected light. Entry i of an axis is the value at (i + 0.5) / steps.
typedef struct Tables {
    int steps;              // at most STEPS
    double a[STEPS][STEPS]; // over roughness and n.v
    double b[STEPS][STEPS];
    double grazing[STEPS]; // over n.v
} Tables;

static Tables tables = {.steps = STEPS};
static Tables few_tables = {.steps = FEW_STEPS};

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void normalise(double v[3]) {
    const double length = sqrt(dot(v, v));
    for (int i = 0; i < 3; i++) {
        v[i] = length > 0.0 ? v[i] / length : 0.0;
    }
}

static double clamp01(double x) {
    return fmin(fmax(x, 0.0), 1.0);
}

// --- tables --------------------------------------------------------------------------------------

// Smith's Lambda of the GGX distribution.
static double lambda(double cosine, double alpha) {
    const double tangent2 = 1.0 / (cosine * cosine) - 1.0;
    return 0.5 * (sqrt(1.0 + alpha * alpha * tangent2) - 1.0);
}

// Finds a visible half vector: "Sampling visible GGX normals with spherical caps" (Dupuy and
// Benyoub 2023). u and w are 0..1.
static void find_half(const double view[3], double alpha, double u, double w, double half[3]) {
    double stretched[3] = {alpha * view[0], alpha * view[1], view[2]};
    normalise(stretched);
    const double z = (1.0 - w) * (1.0 + stretched[2]) - stretched[2];
    const double radius = sqrt(clamp01(1.0 - z * z));
    half[0] = alpha * (radius * cos(2.0 * pi * u) + stretched[0]);
    half[1] = alpha * (radius * sin(2.0 * pi * u) + stretched[1]);
    half[2] = z + stretched[2];
    normalise(half);
}

// Adds one sample of the integrals of A and B.
static void add_lobe(const double view[3], double alpha, double u, double w, double *a, double *b) {
    double half[3];
    find_half(view, alpha, u, w, half);
    const double v_h = dot(view, half);
    const double light_z = 2.0 * v_h * half[2] - view[2];
    if (light_z > 0.0) {
        const double seen = 1.0 + lambda(view[2], alpha);
        const double share = seen / (seen + lambda(light_z, alpha));
        const double grazing = pow(clamp01(1.0 - v_h), 5.0);
        *a += share * (1.0 - grazing);
        *b += share * grazing;
    }
}

static void fill_entry(Tables *out, int r, int v) {
    const double count = INTEGRAL_STEPS * INTEGRAL_STEPS;
    const double roughness = (r + 0.5) / out->steps;
    const double cosine = (v + 0.5) / out->steps;
    const double view[3] = {sqrt(1.0 - cosine * cosine), 0.0, cosine};
    for (int i = 0; i < INTEGRAL_STEPS * INTEGRAL_STEPS; i++) {
        const double u = (i / INTEGRAL_STEPS + 0.5) / INTEGRAL_STEPS;
        const double w = (i % INTEGRAL_STEPS + 0.5) / INTEGRAL_STEPS;
        add_lobe(view, fmax(roughness * roughness, 1e-4), u, w, &out->a[r][v], &out->b[r][v]);
        if (r == 0) {
            const double light[3] = {sqrt(w) * cos(2.0 * pi * u), sqrt(w) * sin(2.0 * pi * u),
                                     sqrt(1.0 - w)};
            const double v_h = sqrt(0.5 * (1.0 + dot(view, light)));
            out->grazing[v] += pow(1.0 - v_h, 5.0) / count;
        }
    }
    out->a[r][v] /= count;
    out->b[r][v] /= count;
}

static void fill(Tables *out) {
    for (int i = 0; i < out->steps * out->steps; i++) {
        fill_entry(out, i / out->steps, i % out->steps);
    }
}

static void fill_tables(void) {
    fill(&tables);
}

static void fill_few_tables(void) {
    fill(&few_tables);
}

void dip_reference_pbr_prepare(void) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, fill_tables);
}

void dip_reference_pbr_prepare_few(void) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, fill_few_tables);
}

// Finds where a value lies among the entries of an axis: the entry before it, and the share of the
// next one.
static int find_entry(int steps, double value, double *share) {
    const double at = fmin(fmax(value * steps - 0.5, 0.0), steps - 1.0);
    const int entry = (int)fmin(at, steps - 2.0);
    *share = at - entry;
    return entry;
}

// Reads between entries. fast: position on the axis whose entries follow each other.
static double interpolate(const double (*table)[STEPS], int steps, double slow, double fast) {
    double dr;
    double dv;
    const int r = find_entry(steps, slow, &dr);
    const int v = find_entry(steps, fast, &dv);
    return (1.0 - dr) * ((1.0 - dv) * table[r][v] + dv * table[r][v + 1]) +
           dr * ((1.0 - dv) * table[r + 1][v] + dv * table[r + 1][v + 1]);
}

static double interpolate_row(const double row[STEPS], int steps, double value) {
    double share;
    const int i = find_entry(steps, value, &share);
    return row[i] + (row[i + 1] - row[i]) * share;
}

// --- lobes ---------------------------------------------------------------------------------------

// A surface or its coat at one point.
typedef struct Lobe {
    const Tables *tables;
    double normal[3];
    double to_eye[3];
    double roughness;
    double light_alpha; // width for lights
    double a, b;
} Lobe;

static double facing_of(const Lobe *lobe) {
    return clamp01(dot(lobe->normal, lobe->to_eye));
}

static void read_lobe(Lobe *lobe) {
    const Tables *from = lobe->tables;
    lobe->a = interpolate(from->a, from->steps, lobe->roughness, facing_of(lobe));
    lobe->b = interpolate(from->b, from->steps, lobe->roughness, facing_of(lobe));
}

// The radiance that a lobe sees. environment: NULL for the surroundings of the lighting.
static void reflect(const Lobe *lobe, const DipLightingDef *lighting,
                    const DipRefEnvironment *environment, double rgb[3]) {
    const double alpha = lobe->roughness * lobe->roughness;
    const double lean = (1.0 - alpha) * (sqrt(1.0 - alpha) + alpha);
    double towards[3];
    for (int i = 0; i < 3; i++) {
        const double mirrored = 2.0 * facing_of(lobe) * lobe->normal[i] - lobe->to_eye[i];
        towards[i] = lobe->normal[i] + (mirrored - lobe->normal[i]) * lean;
    }
    normalise(towards);
    const double blur = fmin(1.0, 1.0083 - 0.6222 * alpha + 0.2566 * alpha * alpha +
                                      0.0316 * alpha * alpha * alpha);
    if (environment) {
        dip_reference_environment_see(environment, lobe->roughness, towards, rgb);
        return;
    }
    for (int c = 0; c < 3; c++) {
        rgb[c] =
            fmax(0.0, lighting->ambient_lin[c] + 1.5 * lighting->sky_lin[c] * blur * towards[1]);
    }
}

// The light that falls on a white matt surface from its surroundings.
static void soften(const Lobe *lobe, const DipLightingDef *lighting,
                   const DipRefEnvironment *environment, double rgb[3]) {
    if (environment) {
        dip_reference_environment_soften(environment, lobe->normal, rgb);
        return;
    }
    for (int c = 0; c < 3; c++) {
        rgb[c] = lighting->ambient_lin[c] + lighting->sky_lin[c] * lobe->normal[1];
    }
}

// What the lobe makes of a light of strength 1, without its colour, and (1 - v.h)^5.
static double meet(const Lobe *lobe, const double to_light[3], double *fresnel) {
    double half[3];
    for (int i = 0; i < 3; i++) {
        half[i] = lobe->to_eye[i] + to_light[i];
    }
    normalise(half);
    const double alpha2 = lobe->light_alpha * lobe->light_alpha;
    const double n_l = clamp01(dot(lobe->normal, to_light));
    const double n_v = fmax(facing_of(lobe), 1e-4);
    const double n_h = clamp01(dot(lobe->normal, half));
    const double spread = n_h * n_h * (alpha2 - 1.0) + 1.0;
    const double density = alpha2 / (pi * spread * spread);
    const double visibility = 0.5 / (n_l * sqrt(n_v * n_v * (1.0 - alpha2) + alpha2) +
                                     n_v * sqrt(n_l * n_l * (1.0 - alpha2) + alpha2));
    *fresnel = pow(1.0 - clamp01(dot(lobe->to_eye, half)), 5.0);
    return pi * n_l * density * visibility;
}

// --- surfaces ------------------------------------------------------------------------------------

// A metallic-roughness surface at one point.
typedef struct Surface {
    const DipRefTriangle *triangle;
    const DipLightingDef *lighting;
    double place[3];
    double base[3];
    double metallic;
    double roughness; // without the spread of the normal map
    double occlusion;
    double f0_greatest;  // of what is not metal
    double f90;          // of what is not metal
    double sunlit;       // the part of the light with shadows that arrives
    double transmission; // share of what would be diffuse light that comes from behind
} Surface;

static const Tables *tables_of(const DipRefTriangle *triangle) {
    return triangle->few_entries ? &few_tables : &tables;
}

static const DipLightingDef *lighting_of(const DipRefTriangle *triangle) {
    static const DipLightDef sun = {.kind = DIP_LIGHT_DIRECTIONAL,
                                    .colour_lin = {0.65f, 0.65f, 0.65f},
                                    .direction_world = {0.42f, -0.67f, -0.61f}};
    static const DipLightingDef fixed = {.ambient_lin = {0.35f, 0.35f, 0.35f},
                                         .sky_lin = {0.15f, 0.15f, 0.15f},
                                         .lights = &sun,
                                         .light_count = 1};
    static const DipLightingDef nothing = {.light_count = 0};
    if (triangle->lit.lighting) {
        return triangle->lit.lighting;
    }
    return triangle->environment ? &nothing : &fixed;
}

// Whether the surface is seen from the side away from its normal.
static bool is_behind(const DipRefVaryings *varyings, const double normal[3]) {
    const double *x = &varyings->ddx[DIP_REF_X];
    const double *y = &varyings->ddy[DIP_REF_X];
    const double plane[3] = {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2],
                             x[0] * y[1] - x[1] * y[0]};
    const double eye_side = -dot(plane, &varyings->value[DIP_REF_X]);
    return eye_side > 0.0 ? dot(plane, normal) < 0.0 : dot(plane, normal) > 0.0;
}

// Finds the normals of the mesh and of the surface. Returns the length of the map's normal.
static double find_normals(const DipRefTriangle *triangle, const DipRefVaryings *varyings,
                           const double texel[3], double mesh[3], double mapped[3]) {
    dip_reference_normal(varyings, NULL, 1.0, mesh);
    const double length =
        dip_reference_normal(varyings, texel, triangle->pbr->normal_scale, mapped);
    if (triangle->material->double_sided && is_behind(varyings, mesh)) {
        for (int i = 0; i < 3; i++) {
            mesh[i] = -mesh[i];
            mapped[i] = -mapped[i];
        }
    }
    return length;
}

// Finds the direction to a light and the part of its light that arrives.
static double find_arrival(const Surface *surface, int index, double to_light[3]) {
    const DipRefLit *lit = &surface->triangle->lit;
    const double share = dip_reference_arrival(&surface->lighting->lights[index], lit->eye,
                                               surface->place, to_light);
    return index == dip_reference_shadow_light(lit->shadows) ? share * surface->sunlit : share;
}

// Returns the share of uniform light that a white sheen sends to the eye.
static double sheen_albedo(double roughness, double cosine) {
    const double r = fmax(0.1, roughness);
    const double slope = -1.9362 + 1.0678 * r + 0.4573 * r * r - 0.8469 / (r + 0.1);
    const double shift = -0.6014 + 0.5538 * r - 0.4670 * r * r - 0.1255 / (r + 0.1);
    return fmin(1.0, exp(slope * cosine + shift));
}

// Returns what a white sheen gives of a light: pi times the lobe of "Production friendly microfacet
// sheen BRDF" (Estevez and Kulla 2017), times the cosine of the light's angle.
static double sheen_of_light(const Lobe *lobe, double roughness, const double to_light[3]) {
    const double alpha = pow(fmax(0.1, roughness), 2.0);
    double half[3];
    for (int i = 0; i < 3; i++) {
        half[i] = to_light[i] + lobe->to_eye[i];
    }
    normalise(half);
    const double n_h = clamp01(dot(lobe->normal, half));
    const double n_l = clamp01(dot(lobe->normal, to_light));
    const double n_v = facing_of(lobe);
    const double sine2 = fmax(1.0 - n_h * n_h, 0.0078125);
    const double distribution = (2.0 + 1.0 / alpha) * pow(sine2, 0.5 / alpha) / 2.0;
    return n_l * distribution / fmax(1.0, 4.0 * (n_l + n_v - n_l * n_v));
}

static double greatest_sheen(const DipPbrDef *pbr) {
    return fmax(pbr->sheen_lin[0], fmax(pbr->sheen_lin[1], pbr->sheen_lin[2]));
}

// Adds one light to a colour.
static void add_light(const Surface *surface, const Lobe *lobe, int index, double rgb[3]) {
    const DipLightDef *light = &surface->lighting->lights[index];
    const double rest = 1.0 - surface->metallic;
    const double diffuse = 1.0 - surface->transmission;
    double to_light[3];
    double fresnel;
    const double share = find_arrival(surface, index, to_light);
    const double strength = meet(lobe, to_light, &fresnel);
    const double n_l = clamp01(dot(lobe->normal, to_light));
    const double f90 = rest * surface->f90 + surface->metallic;
    const double kept =
        1.0 - (surface->f0_greatest + (surface->f90 - surface->f0_greatest) * fresnel);
    const DipPbrDef *pbr = surface->triangle->pbr;
    const double albedo = fmax(sheen_albedo(pbr->sheen_roughness, facing_of(lobe)),
                               sheen_albedo(pbr->sheen_roughness, n_l));
    const double below = 1.0 - greatest_sheen(pbr) * albedo;
    const double scattered = sheen_of_light(lobe, pbr->sheen_roughness, to_light);
    for (int c = 0; c < 3; c++) {
        const double f0 = rest * pbr->f0_lin[c] + surface->metallic * surface->base[c];
        const double gain = 1.0 + f0 * (1.0 / (lobe->a + lobe->b) - 1.0);
        rgb[c] += share * light->colour_lin[c] *
                  (below * ((f0 + (f90 - f0) * fresnel) * gain * strength +
                            kept * rest * diffuse * surface->base[c] * n_l) +
                   pbr->sheen_lin[c] * scattered);
    }
}

static void light_surface(const Surface *surface, const Lobe *lobe, double rgb[3]) {
    const double rest = 1.0 - surface->metallic;
    const double grazing =
        interpolate_row(lobe->tables->grazing, lobe->tables->steps, facing_of(lobe));
    const double f90 = rest * surface->f90 + surface->metallic;
    const double kept =
        1.0 - (surface->f0_greatest + (surface->f90 - surface->f0_greatest) * grazing);
    const DipPbrDef *pbr = surface->triangle->pbr;
    const double albedo = sheen_albedo(pbr->sheen_roughness, facing_of(lobe));
    const double below = 1.0 - greatest_sheen(pbr) * albedo;
    const double diffuse = 1.0 - surface->transmission;
    double seen[3];
    double soft[3];
    reflect(lobe, surface->lighting, surface->triangle->environment, seen);
    soften(lobe, surface->lighting, surface->triangle->environment, soft);
    for (int c = 0; c < 3; c++) {
        const double f0 =
            rest * surface->triangle->pbr->f0_lin[c] + surface->metallic * surface->base[c];
        const double gain = 1.0 + f0 * (1.0 / (lobe->a + lobe->b) - 1.0);
        rgb[c] =
            surface->occlusion * (below * ((f0 * lobe->a + f90 * lobe->b) * gain * seen[c] +
                                           kept * rest * diffuse * surface->base[c] * soft[c]) +
                                  pbr->sheen_lin[c] * albedo * soft[c]);
    }
    for (int l = 0; l < surface->lighting->light_count; l++) {
        add_light(surface, lobe, l, rgb);
    }
}

// Covers the colour with the clear coat.
static void add_coat(const Surface *surface, const double normal[3], const double to_eye[3],
                     double rgb[3]) {
    const DipPbrDef *pbr = surface->triangle->pbr;
    Lobe lobe = {.tables = tables_of(surface->triangle), .roughness = pbr->coat_roughness};
    for (int i = 0; i < 3; i++) {
        lobe.normal[i] = normal[i];
        lobe.to_eye[i] = to_eye[i];
    }
    lobe.light_alpha = fmax(0.1, lobe.roughness * lobe.roughness);
    read_lobe(&lobe);
    const double gain = 1.0 + 0.04 * (1.0 / (lobe.a + lobe.b) - 1.0);
    const double below = 1.0 - pbr->coat * (0.04 + 0.96 * pow(1.0 - facing_of(&lobe), 5.0));
    double seen[3];
    reflect(&lobe, surface->lighting, surface->triangle->environment, seen);
    for (int c = 0; c < 3; c++) {
        rgb[c] = rgb[c] * below +
                 pbr->coat * gain * surface->occlusion * (0.04 * lobe.a + lobe.b) * seen[c];
    }
    for (int l = 0; l < surface->lighting->light_count; l++) {
        const DipLightDef *light = &surface->lighting->lights[l];
        double to_light[3];
        double fresnel;
        const double share = find_arrival(surface, l, to_light);
        const double strength = meet(&lobe, to_light, &fresnel);
        for (int c = 0; c < 3; c++) {
            rgb[c] += share * light->colour_lin[c] * pbr->coat * gain * strength *
                      (0.04 + 0.96 * fresnel);
        }
    }
}

// Finds the numbers that maps change: metallic and occlusion. Returns the roughness.
static double read_maps(const DipRefFilter *filter, const DipRefVaryings *varyings,
                        Surface *surface) {
    const DipRefTriangle *triangle = surface->triangle;
    const DipPbrDef *pbr = triangle->pbr;
    double texel[4];
    double roughness = pbr->roughness;
    surface->metallic = pbr->metallic;
    surface->occlusion = 1.0;
    if (triangle->metal_rough) {
        dip_reference_read_data(triangle->metal_rough, filter, varyings, DIP_REF_U0, texel);
        roughness *= texel[1];
        surface->metallic *= texel[2];
    }
    if (triangle->occlusion) {
        dip_reference_read_data(triangle->occlusion, filter, varyings,
                                pbr->occlusion_at_uv1 ? DIP_REF_U1 : DIP_REF_U0, texel);
        surface->occlusion = 1.0 + pbr->occlusion_strength * (texel[0] - 1.0);
    }
    return roughness;
}

static void add_emission(const DipRefTriangle *triangle, const DipRefFilter *filter,
                         const DipRefVaryings *varyings, double rgb[3]) {
    double texel[4] = {1.0, 1.0, 1.0, 1.0};
    if (triangle->emission) {
        dip_reference_read_data(triangle->emission, filter, varyings,
                                triangle->pbr->emission_at_uv1 ? DIP_REF_U1 : DIP_REF_U0, texel);
    }
    for (int c = 0; c < 3; c++) {
        rgb[c] += triangle->pbr->emission_lin[c] * texel[c];
    }
}

// Describes the surface and its lobe at a place. mesh: receives the normal without the normal map.
static void begin_surface(const DipRefTriangle *triangle, const DipRefFilter *filter,
                          const DipRefVaryings *varyings, const double texel[3],
                          const double base[3], Surface *surface, Lobe *lobe, double mesh[3]) {
    const DipPbrDef *pbr = triangle->pbr;
    *surface = (Surface){.triangle = triangle, .lighting = lighting_of(triangle)};
    surface->roughness = read_maps(filter, varyings, surface);
    *lobe = (Lobe){.tables = tables_of(triangle), .roughness = surface->roughness};
    const double length = find_normals(triangle, varyings, texel, mesh, lobe->normal);
    double ray[3];
    dip_reference_ray(varyings, ray);
    for (int i = 0; i < 3; i++) {
        surface->place[i] = varyings->value[DIP_REF_X + i];
        surface->base[i] = base[i];
        surface->f0_greatest = fmax(surface->f0_greatest, pbr->f0_lin[i]);
        lobe->to_eye[i] = -ray[i];
    }
    surface->f90 = pbr->f90;
    surface->transmission = triangle->blended ? (double)pbr->transmission : 0.0;
    normalise(lobe->to_eye);
    const double spread = 2.0 * fmax(0.0, 1.0 / fmax(length, 0.1) - 1.0);
    const double alpha = lobe->roughness * lobe->roughness;
    const double least = fmax(0.1, alpha);
    lobe->light_alpha = sqrt(fmin(1.0, least * least + spread));
    lobe->roughness = pow(fmin(1.0, alpha * alpha + spread), 0.25);
    read_lobe(lobe);
}

void dip_reference_shade_pbr(const DipRefTriangle *triangle, const DipRefFilter *filter,
                             const DipRefVaryings *varyings, const double texel[3], double rgb[3]) {
    Surface surface;
    Lobe lobe;
    double mesh[3];
    begin_surface(triangle, filter, varyings, texel, rgb, &surface, &lobe, mesh);
    surface.sunlit = dip_reference_sunlit(&triangle->lit, surface.place);
    light_surface(&surface, &lobe, rgb);
    add_emission(triangle, filter, varyings, rgb);
    if (triangle->pbr->coat > 0.0f) {
        add_coat(&surface, mesh, lobe.to_eye, rgb);
    }
}

double dip_reference_transmit_pbr(const DipRefTriangle *triangle, const DipRefFilter *filter,
                                  const DipRefVaryings *varyings, const double texel[3],
                                  const double base[3], double through[3]) {
    Surface surface;
    Lobe lobe;
    double mesh[3];
    begin_surface(triangle, filter, varyings, texel, base, &surface, &lobe, mesh);
    const double rest = 1.0 - surface.metallic;
    const double f90 = rest * surface.f90 + surface.metallic;
    const double n_v = clamp01(dot(mesh, lobe.to_eye));
    const double coat = 1.0 - triangle->pbr->coat * (0.04 + 0.96 * pow(1.0 - n_v, 5.0));
    for (int c = 0; c < 3; c++) {
        const double f0 = rest * triangle->pbr->f0_lin[c] + surface.metallic * base[c];
        const double kept = clamp01(1.0 - (f0 * lobe.a + f90 * lobe.b));
        through[c] = rest * surface.transmission * base[c] * kept * coat;
    }
    return surface.roughness;
}
