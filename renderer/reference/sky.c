// The sky with its clouds: docs/picture.md, "Sky".
#include "renderer/reference/internal/internal.h"

#include <math.h>

// Returns how far a layer has scrolled. Its period is a whole number of nanoseconds.
static double find_scroll(const DipSkyLayer *layer, int64_t time_ns) {
    if (fabs(layer->speed_per_min) < 1e-6) {
        return 0.0;
    }
    const int64_t period_ns = (int64_t)floor(60e9 / fabs(layer->speed_per_min) + 0.5);
    const int64_t rest_ns = time_ns % period_ns; // negative if the time is
    const int64_t into_ns = rest_ns < 0 ? rest_ns + period_ns : rest_ns;
    return copysign((double)into_ns / (double)period_ns, layer->speed_per_min);
}

// Reads the sky's texture at coordinates * scale + shift, with derivatives multiplied by scale *
// slope.
static void read_sky(const DipRefTriangle *triangle, const DipRefFilter *filter,
                     const DipRefVaryings *varyings, double scale, double slope,
                     const double shift[2], double rgba[4]) {
    double uv[2], dx[2], dy[2];
    for (int k = 0; k < 2; k++) {
        uv[k] = varyings->value[DIP_REF_U0 + k] * scale + shift[k];
        dx[k] = varyings->ddx[DIP_REF_U0 + k] * scale * slope;
        dy[k] = varyings->ddy[DIP_REF_U0 + k] * scale * slope;
    }
    if (filter) {
        const DipRefFilter own = dip_reference_data_filter(filter);
        dip_reference_sample(triangle->colour, &own, uv, dx, dy, rgba);
    } else {
        dip_reference_sample_finest(triangle->colour, uv, rgba);
    }
}

static double clamp(double x) {
    return fmin(fmax(x, 0.0), 1.0);
}

static double find_density(const DipRefTriangle *triangle, const DipRefFilter *filter,
                           const DipRefVaryings *varyings) {
    const DipSkyDef *sky = triangle->sky;
    const double nowhere[2] = {0.0, 0.0};
    double push[4];
    double cloud[2];
    read_sky(triangle, filter, varyings, sky->perturbation_scale, 1.0, nowhere, push);
    for (int i = 0; i < 2; i++) {
        const DipSkyLayer *layer = &sky->layers[i];
        const double widths = layer->perturbation_widths;
        const double shift[2] = {(2.0 * push[0] - 1.0) * widths +
                                     find_scroll(layer, triangle->time_ns),
                                 (2.0 * push[1] - 1.0) * widths};
        double texel[4];
        read_sky(triangle, filter, varyings, layer->scale, 1.0 + 8.0 * fabs(widths), shift, texel);
        const double range = (double)sky->dense - sky->clear;
        cloud[i] = range > 0.0 ? clamp((texel[2] - sky->clear) / range) : 0.0;
    }
    return cloud[0] + (cloud[1] - cloud[0]) * sky->blend;
}

void dip_reference_shade_sky(const DipRefTriangle *triangle, const DipRefFilter *filter,
                             const DipRefVaryings *varyings, double rgb[3]) {
    const DipSkyDef *sky = triangle->sky;
    const double density = find_density(triangle, filter, varyings);
    const double *sun = dip_reference_sun;
    double ray[3];
    dip_reference_ray(varyings, ray);
    const double length = sqrt(ray[0] * ray[0] + ray[1] * ray[1] + ray[2] * ray[2]);
    const double sun_length = sqrt(sun[0] * sun[0] + sun[1] * sun[1] + sun[2] * sun[2]);
    const double to_sun =
        clamp((ray[0] * sun[0] + ray[1] * sun[1] + ray[2] * sun[2]) / (length * sun_length));
    const double edge = clamp(density + 2.0 * sky->overcast - 1.0);
    const double cover = edge * edge * (3.0 - 2.0 * edge);
    const double haze = pow(1.0 - clamp(ray[1] / length), 8.0);
    const double glare = (0.25 * pow(to_sun, 8.0) + pow(to_sun, 128.0)) * (1.0 - 0.6 * cover);
    for (int c = 0; c < 3; c++) {
        const double cloud = sky->cloud_lin[c] * (1.0 - 0.2 * density * density);
        const double near = sky->zenith_lin[c] + (cloud - sky->zenith_lin[c]) * cover;
        const double hazy = near + (sky->horizon_lin[c] - near) * haze;
        rgb[c] = clamp((hazy + glare * sky->glare_lin[c]) * sky->tint_lin[c]);
    }
}
