// Reads the lights of model files.
//
// assimp gives a light's position and direction relative to the node with the light's name. Its
// numbers mean different things in different formats; docs/models.md, Lights, says how they are
// understood here.
#include "assets/model_parts.h"

#include <assimp/light.h>
#include <assimp/metadata.h>
#include <assimp/scene.h>

#include <math.h>
#include <string.h>

static const double degrees_per_radian = 57.295779513082320877;

static bool all_within(const float *values, int count, float low, float high) {
    bool ok = true;
    for (int i = 0; i < count; ++i) {
        ok = ok && values[i] >= low && values[i] <= high; // False for NaN.
    }
    return ok;
}

static bool is_zero(const float v[3]) {
    return v[0] == 0.0f && v[1] == 0.0f && v[2] == 0.0f;
}

static bool is_finite(const float v[3]) {
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

const char *dip_light_fault(const DipLightDef *light) {
    const float most = DIP_MAX_LIGHT_LIN;
    if (light->kind != DIP_LIGHT_DIRECTIONAL && light->kind != DIP_LIGHT_POINT &&
        light->kind != DIP_LIGHT_SPOT) {
        return "its kind is unknown";
    }
    if (!all_within(light->colour_lin, 3, 0.0f, most)) {
        return "its colour or strength is negative, too large or not a number";
    }
    if (!is_finite(light->position_world)) {
        return "its position is not finite";
    }
    if (!is_finite(light->direction_world) ||
        (light->kind != DIP_LIGHT_POINT && is_zero(light->direction_world))) {
        return "its direction is zero or not finite";
    }
    if (!all_within(light->attenuation, 3, 0.0f, most) ||
        (light->kind != DIP_LIGHT_DIRECTIONAL && is_zero(light->attenuation))) {
        return "its attenuation is zero, negative, too large or not a number";
    }
    if (!all_within(&light->range_m, 1, 0.0f, most)) {
        return "its range is negative, too large or not a number";
    }
    const bool spot = light->kind == DIP_LIGHT_SPOT;
    if (!all_within(&light->outer_deg, 1, 0.0f, 90.0f) || (spot && light->outer_deg == 0.0f) ||
        !all_within(&light->inner_deg, 1, 0.0f, light->outer_deg)) {
        return "its cone is not within 0..90 degrees";
    }
    return NULL;
}

// --- one light -----------------------------------------------------------------------------------

// Finds the first node with the name, and its transform to the world. *world begins as the
// transform above `node`, and keeps that if there is no such node.
static const struct aiNode *find_node(const struct aiNode *node, const char *name,
                                      double world[12]) {
    double own[12];
    dip_model_multiply(world, &node->mTransformation, own);
    const struct aiNode *found = strcmp(node->mName.data, name) == 0 ? node : NULL;
    for (unsigned i = 0; !found && i < node->mNumChildren; ++i) {
        double below[12];
        memcpy(below, own, sizeof below);
        found = find_node(node->mChildren[i], name, below);
        if (found) {
            memcpy(world, below, sizeof below);
            return found;
        }
    }
    if (found) {
        memcpy(world, own, sizeof own);
    }
    return found;
}

// Colours that are not linear are strength times an sRGB colour whose greatest channel is 1, so
// that the strength stays linear.
static void set_colour(const struct aiColor3D *colour, bool linear, double lin[3]) {
    const double raw[3] = {colour->r, colour->g, colour->b};
    const double strength = fmax(raw[0], fmax(raw[1], raw[2]));
    for (int c = 0; c < 3; ++c) {
        lin[c] = raw[c];
        if (!linear && raw[c] >= 0.0 && strength > 0.0 && isfinite(strength)) {
            lin[c] =
                strength * (double)dip_model_colour_to_linear((float)(raw[c] / strength), false);
        }
    }
}

static void set_place(const struct aiLight *from, const double world[12], DipLightDef *light) {
    const double position[3] = {from->mPosition.x, from->mPosition.y, from->mPosition.z};
    const double direction[3] = {from->mDirection.x, from->mDirection.y, from->mDirection.z};
    double to[3];
    for (int row = 0; row < 3; ++row) {
        const double *m = world + 4 * row;
        to[row] = m[0] * direction[0] + m[1] * direction[1] + m[2] * direction[2];
        light->position_world[row] =
            light->kind == DIP_LIGHT_DIRECTIONAL
                ? 0.0f
                : (float)(m[0] * position[0] + m[1] * position[1] + m[2] * position[2] + m[3]);
    }
    const double length = sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);
    for (int row = 0; row < 3; ++row) {
        light->direction_world[row] = light->kind == DIP_LIGHT_POINT ? 0.0f
                                      : length > 0.0                 ? (float)(to[row] / length)
                                                                     : 0.0f;
    }
}

// Returns the distance at which a light of glTF ends, or 0. assimp keeps it as metadata of the
// node.
static float range_of(const struct aiNode *node) {
    const struct aiMetadataEntry *entry =
        node ? dip_model_metadata(node->mMetaData, "PBR_LightRange") : NULL;
    double range = 0.0;
    if (entry && entry->mType == AI_FLOAT) {
        range = (double)*(const float *)entry->mData;
    } else if (entry && entry->mType == AI_DOUBLE) {
        range = *(const double *)entry->mData;
    }
    return range > 0.0 && range <= (double)DIP_MAX_LIGHT_LIN ? (float)range : 0.0f;
}

// assimp gives the half angles of glTF, and the full angles of other formats.
static void set_cone(const struct aiLight *from, bool half, DipLightDef *light) {
    const double scale = half ? degrees_per_radian : 0.5 * degrees_per_radian;
    const float outer = (float)(scale * (double)from->mAngleOuterCone);
    const float inner = (float)(scale * (double)from->mAngleInnerCone);
    light->outer_deg = outer > 90.0f ? 90.0f : outer; // NaN stays, and dip_light_fault finds it.
    light->inner_deg = inner < 0.0f ? 0.0f : inner > light->outer_deg ? light->outer_deg : inner;
}

static void set_fading(const struct aiLight *from, const struct aiNode *node, bool half,
                       DipLightDef *light) {
    light->attenuation[0] = 1.0f;
    if (light->kind == DIP_LIGHT_DIRECTIONAL) {
        return;
    }
    const float given[3] = {from->mAttenuationConstant, from->mAttenuationLinear,
                            from->mAttenuationQuadratic};
    if (!is_zero(given)) { // Readers that know of no attenuation give zeros.
        memcpy(light->attenuation, given, sizeof given);
    }
    light->range_m = range_of(node);
    if (light->kind == DIP_LIGHT_SPOT) {
        set_cone(from, half, light);
    }
}

static bool kind_of(const struct aiLight *light, DipLightKind *kind) {
    *kind = light->mType == aiLightSource_POINT  ? DIP_LIGHT_POINT
            : light->mType == aiLightSource_SPOT ? DIP_LIGHT_SPOT
                                                 : DIP_LIGHT_DIRECTIONAL;
    return *kind != DIP_LIGHT_DIRECTIONAL || light->mType == aiLightSource_DIRECTIONAL;
}

// --- the lights of a file ------------------------------------------------------------------------

static void warn(DipModel *model, const char *file, const char *name, const char *why) {
    dip_model_warn(model, file, name[0] ? name : NULL, "the light is left out: %s", why);
}

static void add_ambient(DipModel *model, const DipModelFile *file, const struct aiLight *light) {
    double lin[3];
    set_colour(&light->mColorAmbient, file->linear_colours, lin);
    for (int c = 0; c < 3; ++c) {
        if (!(lin[c] >= 0.0 && lin[c] <= (double)DIP_MAX_LIGHT_LIN)) {
            warn(model, file->path, light->mName.data,
                 "its colour or strength is negative, too large or not a number");
            return;
        }
    }
    for (int c = 0; c < 3; ++c) {
        model->ambient_lin[c] += lin[c];
    }
}

static bool keep_light(DipModel *model, const char *file, DipLightDef light, DipError *err) {
    light.name = dip_model_copy_text(model, light.name);
    DipLightDef *lights = dip_array_grow(model->lights, model->light_count, sizeof *lights);
    model->lights = lights ? lights : model->lights;
    if (!light.name || !lights) {
        return dip_model_out_of_memory(err, file);
    }
    lights[model->light_count++] = light;
    return true;
}

bool dip_model_add_light(DipModel *model, const char *file, const DipLightDef *light,
                         DipError *err) {
    if (is_zero(light->colour_lin)) {
        return true;
    }
    if (model->light_count == DIP_MAX_LIGHTS) {
        model->lights_left_out++;
        return true;
    }
    const char *fault = dip_light_fault(light);
    if (fault) {
        warn(model, file, light->name, fault);
        return true;
    }
    return keep_light(model, file, *light, err);
}

void dip_model_warn_of_lights(DipModel *model, const char *file, int left_out_before) {
    const int left_out = model->lights_left_out - left_out_before;
    if (left_out > 0) {
        dip_model_warn(model, file, NULL, "%d lights are left out, accepted %d in a scene",
                       left_out, DIP_MAX_LIGHTS);
    }
}

static bool add_light(DipModel *model, const DipModelFile *file, const struct aiLight *from,
                      const double above[12], DipError *err) {
    DipLightDef light = {.name = from->mName.data};
    if (from->mType == aiLightSource_AMBIENT) {
        add_ambient(model, file, from);
        return true;
    }
    if (!kind_of(from, &light.kind)) {
        warn(model, file->path, from->mName.data,
             from->mType == aiLightSource_AREA ? "area lights are not drawn"
                                               : "lights of its kind are not drawn");
        return true;
    }
    double world[12];
    double lin[3];
    set_colour(&from->mColorDiffuse, file->linear_colours, lin);
    for (int c = 0; c < 3; ++c) {
        light.colour_lin[c] = (float)lin[c];
    }
    memcpy(world, above, sizeof world);
    const struct aiNode *node = find_node(file->scene->mRootNode, from->mName.data, world);
    set_place(from, world, &light);
    set_fading(from, node, file->linear_colours, &light);
    return dip_model_add_light(model, file->path, &light, err);
}

bool dip_model_read_lights(DipModel *model, const DipModelFile *file, const double world[12],
                           DipError *err) {
    if (model->has_light_scale && model->light_scale == 0.0) {
        return true;
    }
    const int left_out_before = model->lights_left_out;
    for (unsigned i = 0; i < file->scene->mNumLights; ++i) {
        const struct aiLight *light = file->scene->mLights[i];
        if (light && !add_light(model, file, light, world, err)) {
            return false;
        }
    }
    dip_model_warn_of_lights(model, file->path, left_out_before);
    return true;
}
