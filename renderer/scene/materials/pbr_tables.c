// Makes the tables of metallic-roughness surfaces: integrals of the GGX lobe by 256 samples each.
// The azimuths of the samples are whole multiples of 1/256 turn, whose sines and cosines come from
// halving angles, so that nothing but + - * / and sqrt is needed.
#include "renderer/scene/materials/pbr.h"

#include <math.h>
#include <pthread.h>

enum { SAMPLES = DIP_PBR_SAMPLES, SAMPLE_BITS = 8 };

static double larger(double a, double b) {
    return a > b ? a : b;
}

static int reversed_bits(int value) {
    int reversed = 0;
    for (int bit = 0; bit < SAMPLE_BITS; bit++) {
        reversed |= (value >> bit & 1) << (SAMPLE_BITS - 1 - bit);
    }
    return reversed;
}

void dip_pbr_samples_make(DipPbrSample samples[SAMPLES]) {
    // A quarter turn, halved until it is 1 / SAMPLES of a turn.
    double step_cosine = 0.0;
    double step_sine = 1.0;
    for (int parts = 4; parts < SAMPLES; parts *= 2) {
        const double half = sqrt((1.0 + step_cosine) / 2.0);
        step_sine = step_sine / (2.0 * half);
        step_cosine = half;
    }
    double cosine = 1.0;
    double sine = 0.0;
    for (int turn = 0; turn < SAMPLES; turn++) {
        DipPbrSample *sample = &samples[reversed_bits(turn)];
        sample->cosine = cosine;
        sample->sine = sine;
        const double next = cosine * step_cosine - sine * step_sine;
        sine = cosine * step_sine + sine * step_cosine;
        cosine = next;
    }
    for (int i = 0; i < SAMPLES; i++) {
        samples[i].u = (i + 0.5) / SAMPLES;
    }
}

// Smith's Lambda of the GGX distribution: 1 / (1 + Lambda) is the unshadowed share.
static double shadowing(double cosine, double alpha2) {
    return (sqrt(1.0 + alpha2 * (1.0 - cosine * cosine) / (cosine * cosine)) - 1.0) / 2.0;
}

static double fifth_power(double x) {
    const double bounded = x > 1.0 ? 1.0 : larger(x, 0.0);
    const double square = bounded * bounded;
    return square * square * bounded;
}

// Finds a visible half vector for the view (x, 0, z) in tangent space: "Sampling the GGX
// distribution of visible normals" (Heitz 2018). Its y component is not needed. half[0] is its x,
// half[1] its z.
static void find_half(double x, double z, double alpha, const DipPbrSample *sample,
                      double half[2]) {
    const double stretched_x = alpha * x;
    const double inverse = 1.0 / sqrt(stretched_x * stretched_x + z * z);
    const double hx = stretched_x * inverse;
    const double hz = z * inverse;
    // The tangents are (0, 1, 0) and (-hz, 0, hx), because the view has no y component.
    const double radius = sqrt(sample->u);
    const double p1 = radius * sample->cosine;
    const double share = 0.5 * (1.0 + hz);
    const double p2 =
        (1.0 - share) * sqrt(larger(0.0, 1.0 - p1 * p1)) + share * radius * sample->sine;
    const double p3 = sqrt(larger(0.0, 1.0 - p1 * p1 - p2 * p2));
    const double nx = alpha * (p3 * hx - p2 * hz);
    const double ny = alpha * p1;
    const double nz = larger(1e-9, p2 * hx + p3 * hz);
    const double length = sqrt(nx * nx + ny * ny + nz * nz);
    half[0] = nx / length;
    half[1] = nz / length;
}

// Returns a share as a whole number of 1/65535.
static uint32_t encode(double share) {
    return (uint32_t)(share * 65535.0 + 0.5);
}

static int32_t pack(uint32_t low, uint32_t high) {
    return (int32_t)(low | high << 16);
}

static int32_t lobe_entry(const DipPbrSample samples[SAMPLES], double roughness, double z) {
    const double alpha = larger(roughness * roughness, 1e-4);
    const double x = sqrt(1.0 - z * z);
    const double view = shadowing(z, alpha * alpha);
    double a = 0.0;
    double b = 0.0;
    for (int i = 0; i < SAMPLES; i++) {
        double half[2];
        find_half(x, z, alpha, &samples[i], half);
        const double v_h = x * half[0] + z * half[1];
        const double light_z = 2.0 * v_h * half[1] - z;
        if (light_z > 0.0) {
            const double light = shadowing(light_z, alpha * alpha);
            const double share = (1.0 + view) / (1.0 + view + light);
            const double grazing = fifth_power(1.0 - v_h);
            a += share * (1.0 - grazing);
            b += share * grazing;
        }
    }
    return pack(encode(a / SAMPLES), encode(b / SAMPLES));
}

// The mean of (1 - v.h)^5 with the light's direction by the cosine. v.h is the cosine of half the
// angle between view and light.
static uint32_t grazing_entry(const DipPbrSample samples[SAMPLES], double z) {
    const double x = sqrt(1.0 - z * z);
    double sum = 0.0;
    for (int i = 0; i < SAMPLES; i++) {
        const double light_x = sqrt(samples[i].u) * samples[i].cosine;
        const double light_z = sqrt(1.0 - samples[i].u);
        const double v_l = x * light_x + z * light_z;
        sum += fifth_power(1.0 - sqrt((1.0 + v_l) / 2.0));
    }
    return encode(sum / SAMPLES);
}

DipSheen dip_sheen_make(const float lin[3], double roughness) {
    static const double log2_e = 1.44269504088896340736;
    const double r = larger(roughness, 0.1);
    const double exponent = 0.5 / (r * r);
    const double slope = -1.9362 + 1.0678 * r + 0.4573 * r * r - 0.8469 / (r + 0.1);
    const double shift = -0.6014 + 0.5538 * r - 0.4670 * r * r - 0.1255 / (r + 0.1);
    return (DipSheen){.lin = {lin[0], lin[1], lin[2]},
                      .greatest =
                          (float)larger((double)lin[0], larger((double)lin[1], (double)lin[2])),
                      .exponent = (float)exponent,
                      .scale = (float)(1.0 + exponent),
                      .albedo_slope = (float)(slope * log2_e),
                      .albedo_shift = (float)(shift * log2_e)};
}

static DipPbrTables tables;

static void make_tables(void) {
    DipPbrSample samples[SAMPLES];
    dip_pbr_samples_make(samples);
    for (int r = 0; r < DIP_PBR_TABLE; r++) {
        for (int v = 0; v < DIP_PBR_TABLE; v++) {
            tables.lobe[r * DIP_PBR_TABLE + v] =
                lobe_entry(samples, (r + 0.5) / DIP_PBR_TABLE, (v + 0.5) / DIP_PBR_TABLE);
        }
    }
    for (int v = DIP_PBR_TABLE - 1; v >= 0; v--) {
        const uint32_t own = grazing_entry(samples, (v + 0.5) / DIP_PBR_TABLE);
        const bool last = v == DIP_PBR_TABLE - 1;
        const uint32_t next = last ? own : (uint32_t)tables.grazing[v + 1] & 0xffff;
        tables.grazing[v] = pack(own, next);
    }
}

const DipPbrTables *dip_pbr_tables(void) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, make_tables);
    return &tables;
}
