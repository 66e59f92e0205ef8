// Makes the lighting of a scene from the lights of its files and the options of the load.
#include "assets/model_parts.h"

#include <math.h>
#include <string.h>

const char *const dip_model_shading_names[DIP_MODEL_SHADING_COUNT] = {
#define DIP_MODEL_SHADING_NAME(name, text) #name,
    DIP_MODEL_SHADING_LIST(DIP_MODEL_SHADING_NAME)
#undef DIP_MODEL_SHADING_NAME
};

// --- the lights of the files ---------------------------------------------------------------------

static double distance(const DipLightDef *light, const double point[3]) {
    double square = 0.0;
    for (int i = 0; i < 3; ++i) {
        const double d = (double)light->position_world[i] - point[i];
        square += d * d;
    }
    return sqrt(square);
}

// Luminance of a light on a surface that faces it at a point; cones and ranges do not count.
static double luminance_at(const DipLightDef *light, const double point[3], double least_m) {
    const float *c = light->colour_lin;
    const double luminance = 0.2126 * (double)c[0] + 0.7152 * (double)c[1] + 0.0722 * (double)c[2];
    if (light->kind == DIP_LIGHT_DIRECTIONAL) {
        return luminance;
    }
    const float *a = light->attenuation;
    const double d = fmax(distance(light, point), least_m);
    return luminance / ((double)a[0] + (double)a[1] * d + (double)a[2] * d * d);
}

// Returns the factor that makes the light at the models' centre 1, or 1 if there is no such factor.
static double automatic_scale(const DipModel *model, const DipModelBounds *bounds) {
    double centre[3];
    for (int i = 0; i < 3; ++i) {
        centre[i] = 0.5 * (bounds->low[i] + bounds->high[i]);
    }
    double sum = 0.0;
    for (int i = 0; i < model->light_count; ++i) {
        sum += luminance_at(&model->lights[i], centre, 0.25 * bounds->diagonal);
    }
    const double scale = 1.0 / sum;
    return isfinite(scale) && scale > 0.0 ? scale : 1.0;
}

// Multiplies a light. The colour of a point or spot light stays at most bright_lin: beyond, its
// attenuation is divided instead, which is the same light.
static bool scale_light(DipLightDef *light, double scale) {
    static const double bright_lin = 1e6;
    double most = 0.0;
    for (int c = 0; c < 3; ++c) {
        most = fmax(most, scale * (double)light->colour_lin[c]);
    }
    double excess = 1.0;
    if (light->kind != DIP_LIGHT_DIRECTIONAL && most > bright_lin) {
        excess = most / bright_lin;
    }
    for (int c = 0; c < 3; ++c) {
        light->colour_lin[c] = (float)(scale * (double)light->colour_lin[c] / excess);
        light->attenuation[c] = (float)((double)light->attenuation[c] / excess);
    }
    return !dip_light_fault(light);
}

void dip_model_scale_lights(DipModel *model, const DipModelBounds *bounds) {
    const double scale =
        model->has_light_scale ? model->light_scale : automatic_scale(model, bounds);
    int kept = 0;
    for (int i = 0; i < model->light_count; ++i) {
        model->lights[kept] = model->lights[i];
        if (scale_light(&model->lights[kept], scale)) {
            kept++;
        } else {
            dip_model_warn(model, model->files[0].path, model->lights[i].name,
                           "the light is left out: it is too strong");
        }
    }
    model->light_count = kept;
    if (kept == 0) {
        return;
    }
    for (int c = 0; c < 3; ++c) {
        model->lighting.ambient_lin[c] =
            (float)fmin(scale * model->ambient_lin[c], (double)DIP_MAX_LIGHT_LIN);
    }
    model->lighting.lights = model->lights;
    model->lighting.light_count = kept;
    model->def.lighting = &model->lighting;
}

// --- the lighting of the scene -------------------------------------------------------------------

bool dip_model_check_lights(const DipModelOptions *options, DipError *err) {
    if (options->light_count < 0 || options->light_count > DIP_MAX_LIGHTS) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, NULL, "%d lights, accepted 0..%d",
                             options->light_count, DIP_MAX_LIGHTS);
    }
    for (int i = 0; i < options->light_count; ++i) {
        const char *fault = dip_light_fault(&options->lights[i]);
        if (fault) {
            return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, options->lights[i].name,
                                 "light %d: %s", i, fault);
        }
    }
    if (options->has_light_scale &&
        !(options->light_scale >= 0.0 && options->light_scale <= DIP_MAX_LIGHT_SCALE)) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, NULL,
                             "the scale of the lights is %g, accepted 0..%d", options->light_scale,
                             DIP_MAX_LIGHT_SCALE);
    }
    for (int c = 0; options->ambient_lin && c < 3; ++c) {
        const float ambient = options->ambient_lin[c];
        if (!(ambient >= 0.0f && ambient <= DIP_MAX_LIGHT_LIN)) {
            return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, NULL,
                                 "the ambient light is %g, accepted 0..%g", (double)ambient,
                                 (double)DIP_MAX_LIGHT_LIN);
        }
    }
    return options->shading < DIP_MODEL_SHADING_COUNT ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, NULL, "the shading is %d, accepted 0..%d",
                         (int)options->shading, DIP_MODEL_SHADING_COUNT - 1);
}

// Puts the caller's lights before those of the files. Returns false when memory runs out.
static bool join_lights(DipModel *model, const DipModelLoad *load, const DipLightingDef *files) {
    const DipModelOptions *options = &load->options;
    const int own = options->light_count;
    const int room = DIP_MAX_LIGHTS - own;
    const int kept = files->light_count < room ? files->light_count : room;
    DipLightDef *lights = dip_model_alloc(model, (size_t)(own + kept), sizeof *lights);
    if (!lights) {
        return false;
    }
    for (int i = 0; i < own + kept; ++i) {
        lights[i] = i < own ? options->lights[i] : files->lights[i - own];
        lights[i].name = dip_model_copy_text(model, lights[i].name ? lights[i].name : "");
        if (!lights[i].name) {
            return false;
        }
    }
    model->lighting.lights = lights;
    model->lighting.light_count = own + kept;
    if (kept < files->light_count) {
        model->warnings = load->warnings;
        dip_model_warn(model, load->files[0], NULL,
                       "%d lights of the models are left out, accepted %d in a scene",
                       files->light_count - kept, DIP_MAX_LIGHTS);
        model->warnings = NULL;
    }
    return true;
}

static void set_ambient(DipModel *model, const float *ambient_lin, const DipLightingDef *files) {
    for (int c = 0; c < 3; ++c) {
        const float own = ambient_lin ? ambient_lin[c] : DIP_MODEL_AMBIENT_LIN;
        model->lighting.ambient_lin[c] = fminf(own + files->ambient_lin[c], DIP_MAX_LIGHT_LIN);
    }
}

bool dip_model_light(DipModel *model, const DipModelLoad *load, DipError *err) {
    static const DipLightingDef none = {.light_count = 0};
    const DipModelOptions *options = &load->options;
    const DipLightingDef files = model->def.lighting ? *model->def.lighting : none;
    if (files.light_count + options->light_count > 0) {
        model->lighting = none;
        if (!join_lights(model, load, &files)) {
            return dip_model_out_of_memory(err, load->files[0]);
        }
        set_ambient(model, options->ambient_lin, &files);
    } else if (options->shading == DIP_MODEL_SHADING_auto) {
        model->def.lighting = NULL;
        return true;
    } else {
        model->lighting = *dip_lighting_fixed();
    }
    const bool fragments =
        options->shading == DIP_MODEL_SHADING_auto || options->shading == DIP_MODEL_SHADING_phong;
    model->lighting.shading = fragments ? DIP_SHADING_PHONG : DIP_SHADING_GOURAUD;
    model->def.lighting = &model->lighting;
    return true;
}
