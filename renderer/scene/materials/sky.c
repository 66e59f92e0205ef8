// Computes the sky at a given time. Times and the periods of the layers are whole numbers of
// nanoseconds, so the layers of clouds repeat exactly.
#include "renderer/scene/materials/sky.h"

#include "renderer/base/fp_mode.h"

#include <string.h>

static const double minute_ns = 60e9;
// A layer that is slower than this stands still. A layer of this speed has a period of about 2
// years.
static const double least_speed_per_min = 1e-6;

DipSkyDef dip_sky_default(void) {
    DIP_FP_MODE_SCOPE();
    return (DipSkyDef){
        .layers = {{.scale = 1.0f, .speed_per_min = 0.3, .perturbation_widths = 0.03f},
                   {.scale = 1.7f, .speed_per_min = -0.2, .perturbation_widths = 0.05f}},
        .perturbation_scale = 1.0f,
        .blend = 0.4f,
        .clear = 0.75f,
        .dense = 1.0f,
        .overcast = 0.5f,
        .zenith_lin = {0.10f, 0.24f, 0.58f},
        .horizon_lin = {0.27f, 0.41f, 0.65f},
        .cloud_lin = {0.90f, 0.91f, 0.93f},
        .glare_lin = {0.90f, 0.75f, 0.50f},
        .tint_lin = {1.0f, 1.0f, 1.0f},
    };
}

double dip_sky_phase(double speed_per_min, int64_t time_ns) {
    const double speed = speed_per_min < 0.0 ? -speed_per_min : speed_per_min;
    if (!(speed >= least_speed_per_min)) {
        return 0.0;
    }
    const int64_t period_ns = (int64_t)(minute_ns / speed + 0.5);
    const int64_t rest_ns = time_ns % period_ns;
    const int64_t into_ns = rest_ns < 0 ? rest_ns + period_ns : rest_ns;
    const double phase = (double)into_ns / (double)period_ns;
    return speed_per_min < 0.0 && into_ns ? 1.0 - phase : phase;
}

DipSkyUniforms dip_sky_at(const DipSkyDef *sky, int64_t time_ns) {
    DipSkyUniforms uniforms = {
        .perturbation_scale = sky->perturbation_scale,
        .blend = sky->blend,
        .clear = sky->clear,
        .inverse_range = sky->dense > sky->clear ? 1.0f / (sky->dense - sky->clear) : 0.0f,
        .overcast = sky->overcast,
    };
    for (int i = 0; i < 2; i++) {
        uniforms.layers[i].scale = sky->layers[i].scale;
        uniforms.layers[i].phase = (float)dip_sky_phase(sky->layers[i].speed_per_min, time_ns);
        uniforms.layers[i].perturbation_widths = sky->layers[i].perturbation_widths;
    }
    memcpy(uniforms.zenith_lin, sky->zenith_lin, sizeof uniforms.zenith_lin);
    memcpy(uniforms.horizon_lin, sky->horizon_lin, sizeof uniforms.horizon_lin);
    memcpy(uniforms.cloud_lin, sky->cloud_lin, sizeof uniforms.cloud_lin);
    memcpy(uniforms.glare_lin, sky->glare_lin, sizeof uniforms.glare_lin);
    memcpy(uniforms.tint_lin, sky->tint_lin, sizeof uniforms.tint_lin);
    return uniforms;
}
