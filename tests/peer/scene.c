// Loads the shipped courtyard or models, or creates a synthetic scene.
#include "tests/peer/scene.h"

#include "tests/peer/synthetic_scenes.h"
#include "config/config.h"
#include "renderer/base/srgb.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double DEFAULT_FOV_Y_DEG = 55.0;

static bool load_models(DipPeerScene *scene, const char *const *files, int count, DipPool *pool,
                        DipError *err) {
    scene->model = dip_model_load(files, count, pool, NULL, err);
    if (scene->model) {
        scene->def = *dip_model_scene_def(scene->model);
    }
    return scene->model != NULL;
}

// --- the courtyard, with the values of the shipped ini -----------------------------------------

static bool apply_config(DipPeerScene *scene, const DipConfig *config,
                         const DipPeerOptions *options, DipPool *pool, DipError *err) {
    const char *files[DIP_CONFIG_MAX_MODELS];
    for (size_t i = 0; i < config->xfile.count; i++) {
        files[i] = config->xfile.items[i].path;
    }
    if (!load_models(scene, files, (int)config->xfile.count, pool, err)) {
        return false;
    }
    for (int c = 0; c < 3; c++) {
        scene->def.background_lin[c] = (float)dip_srgb_decode(config->background.rgb[c] / 255.0);
    }
    scene->def.near_m = (float)config->near_m;
    const DipConfigCamera *camera = &config->camera[DIP_CATEGORY_DEFAULT];
    scene->fov_y_deg = camera->fov_y_deg;
    return options->path || dip_campath_load(camera->file.path, &scene->path, err);
}

static bool open_courtyard(DipPeerScene *scene, const DipPeerOptions *options, DipPool *pool,
                           DipError *err) {
    DipConfig config;
    DipErrorList faults = {0};
    bool opened = dip_config_load(DIP_SOURCE_DIR "/config/courtyard.ini", &config, &faults);
    if (opened) {
        opened = apply_config(scene, &config, options, pool, err);
        dip_config_free(&config);
    } else if (err && faults.count) {
        *err = faults.items[0];
    }
    dip_error_list_free(&faults);
    snprintf(scene->name, sizeof scene->name, "courtyard");
    return opened;
}

// --- models ------------------------------------------------------------------------------------

static bool make_orbit(DipPeerScene *scene, const DipPeerOptions *options, DipPool *pool,
                       DipError *err) {
    DipCamOrbitDef orbit = dip_campath_default_orbit();
    orbit.aspect = (double)options->width / options->height;
    if (options->fov_y_deg > 0.0) {
        orbit.fov_y_deg = options->fov_y_deg;
    }
    DipScene *drawn = dip_scene_create(&scene->def, pool, err);
    if (!drawn) {
        return false;
    }
    float low[3];
    float high[3];
    dip_scene_bounds(drawn, low, high);
    dip_scene_destroy(&drawn);
    for (int axis = 0; axis < 3; axis++) {
        orbit.min_world[axis] = low[axis];
        orbit.max_world[axis] = high[axis];
    }
    scene->fov_y_deg = orbit.fov_y_deg;
    return dip_campath_orbit(&orbit, &scene->path, err);
}

static bool open_models(DipPeerScene *scene, const DipPeerOptions *options, DipPool *pool,
                        DipError *err) {
    const char *slash = strrchr(options->models[0], '/');
    snprintf(scene->name, sizeof scene->name, "%s%s", slash ? slash + 1 : options->models[0],
             options->model_count > 1 ? " and more" : "");
    return load_models(scene, options->models, options->model_count, pool, err) &&
           (options->path || make_orbit(scene, options, pool, err));
}

// --- synthetic scenes --------------------------------------------------------------------------

static bool open_synthetic(DipPeerScene *scene, const DipPeerOptions *options, DipError *err) {
    const double aspect = (double)options->width / options->height;
    if (options->fov_y_deg > 0.0) {
        scene->fov_y_deg = options->fov_y_deg;
    }
    if (options->scene == DIP_PEER_SCENE_LARGE) {
        snprintf(scene->name, sizeof scene->name, "a few large triangles");
        scene->synthetic = dip_peer_room(err);
    } else if (options->scene == DIP_PEER_SCENE_TINY) {
        const int count = options->width * options->height / 3;
        snprintf(scene->name, sizeof scene->name, "triangles of about 3 pixels");
        scene->synthetic = dip_peer_coloured_relief(count < 2 ? 2 : count, scene->fov_y_deg, aspect,
                                                    options->turn_deg, &scene->colours_lin, err);
    } else {
        snprintf(scene->name, sizeof scene->name, "a grid");
        scene->synthetic = dip_synthetic_relief(options->grid_triangles, scene->fov_y_deg, aspect,
                                                options->turn_deg, err);
    }
    if (!scene->synthetic) {
        return false;
    }
    scene->all_in_view = options->scene != DIP_PEER_SCENE_LARGE && options->turn_deg == 0.0;
    scene->def = scene->synthetic->def;
    if (!options->path) {
        scene->path = scene->synthetic->path;
        scene->synthetic->path = NULL;
    }
    return true;
}

// -----------------------------------------------------------------------------------------------

// Leaves out of the scene what the peers do not draw: surfaces that show what lies behind them are
// drawn as opaque ones, and the fixed light shines instead of the scene's lights. Fails with
// MEMORY.
static bool make_plain(DipPeerScene *scene, DipError *err) {
    DipSceneDef *def = &scene->def;
    const size_t count = (size_t)def->material_count;
    scene->materials = calloc(count + 1, sizeof *scene->materials);
    if (!scene->materials) {
        return dip_error_set(err, DIP_ERROR_MEMORY, "", 0, "scene", "out of memory");
    }
    for (size_t i = 0; i < count; i++) {
        DipMaterialDef *material = &scene->materials[i];
        *material = def->materials[i];
        material->transmission = 0.0f;
        if (material->surface == DIP_SURFACE_BLENDED) {
            material->surface = DIP_SURFACE_OPAQUE;
        }
    }
    def->materials = scene->materials;
    def->lighting = NULL;
    return true;
}

static uint64_t count_triangles(const DipSceneDef *def) {
    uint64_t count = 0;
    for (int i = 0; i < def->object_count; i++) {
        count += def->meshes[def->objects[i].mesh].index_count / 3;
    }
    return count;
}

bool dip_peer_scene_open(const DipPeerOptions *options, DipPool *pool, DipPeerScene *scene,
                         DipError *err) {
    *scene = (DipPeerScene){.fov_y_deg = DEFAULT_FOV_Y_DEG};
    bool opened;
    switch (options->scene) {
    case DIP_PEER_SCENE_COURTYARD:
        opened = open_courtyard(scene, options, pool, err);
        break;
    case DIP_PEER_SCENE_MODELS:
        opened = open_models(scene, options, pool, err);
        break;
    default:
        opened = open_synthetic(scene, options, err);
    }
    opened = opened && make_plain(scene, err);
    if (opened && options->path) {
        opened = dip_campath_load(options->path, &scene->path, err);
    }
    if (!opened) {
        dip_peer_scene_close(scene);
        return false;
    }
    if (options->fov_y_deg > 0.0) {
        scene->fov_y_deg = options->fov_y_deg;
    }
    scene->triangle_count = count_triangles(&scene->def);
    return true;
}

void dip_peer_scene_close(DipPeerScene *scene) {
    dip_campath_destroy(&scene->path);
    dip_synthetic_destroy(&scene->synthetic);
    free(scene->colours_lin);
    scene->colours_lin = NULL;
    free(scene->materials);
    scene->materials = NULL;
    dip_model_destroy(&scene->model);
}

DipPose dip_peer_scene_pose(const DipPeerScene *scene, int index, int count) {
    const int64_t duration_ns = dip_campath_info(scene->path).duration_ns;
    DipPose pose = {.fov_y_deg = scene->fov_y_deg};
    dip_campath_sample(scene->path, duration_ns / count * index, &pose);
    return pose;
}
