// Reads the lights of glTF scenes (KHR_lights_punctual). Every node with a light is a light.
#include "assets/gltf/scene.h"

#include "renderer/base/trig.h"

#include <cjson/cJSON.h>

#include <math.h>
#include <string.h>

static const double quarter_turn_deg = 90.0;

static bool kind_of(const cJSON *light, DipLightKind *kind) {
    static const struct {
        const char *name;
        DipLightKind kind;
    } kinds[] = {{"directional", DIP_LIGHT_DIRECTIONAL},
                 {"point", DIP_LIGHT_POINT},
                 {"spot", DIP_LIGHT_SPOT}};
    const cJSON *type = cJSON_GetObjectItemCaseSensitive(light, "type");
    for (size_t i = 0; cJSON_IsString(type) && i < sizeof kinds / sizeof *kinds; ++i) {
        if (strcmp(type->valuestring, kinds[i].name) == 0) {
            *kind = kinds[i].kind;
            return true;
        }
    }
    return false;
}

// A light shines along the -z of its node.
static void set_place(const double world[12], DipLightDef *light) {
    double square = 0.0;
    for (int row = 0; row < 3; ++row) {
        square += world[4 * row + 2] * world[4 * row + 2];
    }
    const double length = sqrt(square);
    for (int row = 0; row < 3; ++row) {
        if (light->kind != DIP_LIGHT_DIRECTIONAL) {
            light->position_world[row] = (float)world[4 * row + 3];
        }
        if (light->kind != DIP_LIGHT_POINT && length > 0.0) {
            light->direction_world[row] = (float)(-world[4 * row + 2] / length);
        }
    }
}

static void set_cone(const cJSON *json, DipLightDef *light) {
    const cJSON *spot = cJSON_GetObjectItemCaseSensitive(json, "spot");
    const double degrees = 180.0 / DIP_PI;
    const double outer = degrees * dip_gltf_number_of(spot, "outerConeAngle", DIP_PI / 4.0);
    const double inner = degrees * dip_gltf_number_of(spot, "innerConeAngle", 0.0);
    light->outer_deg = (float)fmin(outer, quarter_turn_deg);
    light->inner_deg = (float)fmin(fmax(inner, 0.0), (double)light->outer_deg);
}

// Fades with the square of the distance, and ends at the range if there is one.
static void set_fading(const cJSON *json, DipLightDef *light) {
    const double range = dip_gltf_number_of(json, "range", 0.0);
    light->attenuation[light->kind == DIP_LIGHT_DIRECTIONAL ? 0 : 2] = 1.0f;
    if (light->kind != DIP_LIGHT_DIRECTIONAL && range > 0.0 && range <= (double)DIP_MAX_LIGHT_LIN) {
        light->range_m = (float)range;
    }
}

static bool add(DipGltfScene *scene, const cJSON *json, const char *name, const double world[12]) {
    const DipGltf *gltf = &scene->reader.gltf;
    DipLightDef light = {.name = name};
    double colour[3] = {1.0, 1.0, 1.0};
    if (!kind_of(json, &light.kind)) {
        dip_model_warn(scene->model, gltf->path, name,
                       "the light is left out: lights of its kind are not drawn");
        return true;
    }
    if (!dip_gltf_numbers(gltf, json, "color", 3, colour)) {
        return false;
    }
    const double intensity = dip_gltf_number_of(json, "intensity", 1.0);
    for (int i = 0; i < 3; ++i) {
        light.colour_lin[i] = (float)(intensity * colour[i]);
    }
    set_place(world, &light);
    set_fading(json, &light);
    if (light.kind == DIP_LIGHT_SPOT) {
        set_cone(json, &light);
    }
    return dip_model_add_light(scene->model, gltf->path, &light, gltf->err);
}

bool dip_gltf_scene_light(DipGltfScene *scene, const cJSON *node, int index,
                          const double world[12]) {
    const DipModel *model = scene->model;
    const DipGltf *gltf = &scene->reader.gltf;
    const cJSON *used = dip_gltf_extension(node, "KHR_lights_punctual");
    if (!used || (model->has_light_scale && model->light_scale == 0.0)) {
        return true;
    }
    int light;
    if (!dip_gltf_integer(gltf, used, "light", -1, &light)) {
        return false;
    }
    const cJSON *json = dip_gltf_list_item(gltf, &scene->lights, light, "lights");
    if (!json) {
        return false;
    }
    const char *name = dip_gltf_name(&scene->reader, node, "light", index);
    if (scene->is_moved[scene->reader.node_of[index]] &&
        dip_gltf_warns_of(scene, DIP_GLTF_LOSS_MOVED_LIGHT)) {
        dip_model_warn(scene->model, gltf->path, name,
                       "lights stand still where the animation moves them");
    }
    return name ? add(scene, json, name, world) : dip_gltf_no_room(&scene->reader);
}
