// Loads the models of a session and makes the scene that shows them.
#include "app/session/session_private.h"

#include "assets/model.h"
#include "assets/picture.h"
#include "renderer/base/srgb.h"

#include <stdlib.h>
#include <string.h>

static void set_colour(const DipConfigColor *colour, double scale, float lin[3]) {
    for (int c = 0; c < 3; c++) {
        lin[c] = (float)(scale * dip_srgb_decode(colour->rgb[c] / 255.0));
    }
}

static DipSkyDef sky_of(const DipConfig *config) {
    DipSkyDef sky = {
        .layers = {{(float)config->sky_layer1_scale, config->sky_layer1_speed,
                    (float)config->sky_layer1_perturbation},
                   {(float)config->sky_layer2_scale, config->sky_layer2_speed,
                    (float)config->sky_layer2_perturbation}},
        .perturbation_scale = (float)config->sky_perturbation_scale,
        .blend = (float)config->sky_blend,
        .clear = (float)config->sky_clear,
        .dense = (float)config->sky_dense,
        .overcast = (float)config->sky_overcast,
    };
    set_colour(&config->sky_color, 1.0, sky.zenith_lin);
    set_colour(&config->sky_horizon_color, 1.0, sky.horizon_lin);
    set_colour(&config->sky_cloud_color, 1.0, sky.cloud_lin);
    set_colour(&config->sky_glare_color, config->sky_glare, sky.glare_lin);
    set_colour(&config->sky_tint, config->sky_brightness, sky.tint_lin);
    return sky;
}

// Returns whether some object has the material of a sky.
static bool has_sky(const DipSceneDef *def) {
    bool found = false;
    for (int i = 0; i < def->object_count; i++) {
        const int material = def->meshes[def->objects[i].mesh].material;
        found |= def->materials[material].surface == DIP_SURFACE_SKY;
    }
    return found;
}

// The background of models that have no surroundings of their own: a light grey, against which dark
// and bright models stand out. This grey is the colour of the models' ground, too.
static const DipConfigColor plain_background = {{172, 174, 178}};

// Sets the background, the sky, the environment and the near plane. For the ini's models, all four
// come from the ini. A model given with --model keeps its own near plane. If such a model has a
// sky, the colour of the sky's horizon becomes the background, so that gaps beside the sky do not
// show.
static void set_surroundings(const DipSession *session, DipSceneDef *def) {
    if (session->options->model_count) {
        if (has_sky(def)) {
            memcpy(def->background_lin, def->sky.horizon_lin, sizeof def->background_lin);
        } else {
            set_colour(&plain_background, 1.0, def->background_lin);
        }
        return;
    }
    def->environment = session->environment;
    set_colour(&session->config.background, 1.0, def->background_lin);
    def->near_m = (float)session->config.near_m;
    def->sky = sky_of(&session->config);
}

// Returns the session's importer with the time limit of the command line.
static DipImporter importer_of(const DipSession *session) {
    DipImporter importer = session->importer ? *session->importer : (DipImporter){.wall_s = 0};
    if (session->options->import_seconds > 0) {
        importer.wall_s = session->options->import_seconds;
    }
    return importer;
}

// Adds a rule for each material that a key of the ini names. Returns the new number of rules.
static int add_rules(const DipConfig *config, const DipConfigMaterials *materials,
                     DipMaterialMark mark, DipMaterialRule *rules, int count) {
    for (size_t i = 0; i < materials->count; i++) {
        const DipConfigMaterial *material = &materials->items[i];
        rules[count++] = (DipMaterialRule){.mark = mark,
                                           .pattern = material->pattern,
                                           .light_map = material->light_map.path,
                                           .file = config->file,
                                           .line = material->line,
                                           .key = dip_config_key_name(material->key)};
    }
    return count;
}

static int compare_lines(const void *a, const void *b) {
    return ((const DipMaterialRule *)a)->line - ((const DipMaterialRule *)b)->line;
}

// Makes the rules for materials from the MATERIAL_ keys of the ini, in the order of the lines,
// because a later rule outranks an earlier one. Returns the number of rules.
static int rules_of(const DipConfig *config, DipMaterialRule rules[DIP_MAX_MATERIAL_RULES]) {
    const struct {
        const DipConfigMaterials *materials;
        DipMaterialMark mark;
    } keys[] = {{&config->material_solid, DIP_MARK_SOLID},
                {&config->material_clip, DIP_MARK_CLIP},
                {&config->material_glass, DIP_MARK_GLASS},
                {&config->material_water, DIP_MARK_WATER},
                {&config->material_sky, DIP_MARK_SKY},
                {&config->material_lightmap, DIP_MARK_LIGHT_MAP}};
    _Static_assert(sizeof keys / sizeof *keys * DIP_CONFIG_MAX_MATERIALS <= DIP_MAX_MATERIAL_RULES,
                   "every key fits");
    int count = 0;
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        count = add_rules(config, keys[i].materials, keys[i].mark, rules, count);
    }
    qsort(rules, (size_t)count, sizeof *rules, compare_lines);
    return count;
}

_Static_assert((int)DIP_CONFIG_SHADING_COUNT == (int)DIP_MODEL_SHADING_COUNT &&
                   (int)DIP_CONFIG_SHADING_flat == (int)DIP_MODEL_SHADING_flat &&
                   (int)DIP_CONFIG_SHADING_gouraud == (int)DIP_MODEL_SHADING_gouraud &&
                   (int)DIP_CONFIG_SHADING_phong == (int)DIP_MODEL_SHADING_phong,
               "the ini and the loader have the same shadings");

// Sets how the models are lit. The lights of the ini shine only on the ini's models: a model given
// with --model has no lights but its own.
static void set_light(const DipSession *session, float ambient_lin[3], DipModelOptions *options) {
    const DipConfig *config = &session->config;
    if (!session->options->model_count) {
        set_colour(&config->ambient, 1.0, ambient_lin);
        options->ambient_lin = ambient_lin;
        options->lights = config->light.items;
        options->light_count = (int)config->light.count;
        options->has_light_scale = !config->light_scale.automatic;
        options->light_scale = config->light_scale.factor;
        options->shading = (DipModelShading)config->shading;
    }
    if (session->options->has_shading) {
        options->shading = session->options->shading;
    }
}

// Returns the animation that shall play, or NULL for the first animation of each model. The ini
// chooses the animation of its own models only, not of those that --model names.
static const char *chosen_animation(const DipSession *session) {
    const char *of_ini = session->options->model_count ? "" : session->config.animation.text;
    return session->options->animation ? session->options->animation : of_ini[0] ? of_ini : NULL;
}

// Sets which animation plays, and whether it stands still.
static void set_animation(const DipSession *session, DipModelOptions *options) {
    const char *name = chosen_animation(session);
    options->animation = !name                       ? DIP_MODEL_ANIMATION_FIRST
                         : strcmp(name, "none") == 0 ? DIP_MODEL_ANIMATION_NONE
                                                     : DIP_MODEL_ANIMATION_NAMED;
    options->animation_name = name;
    options->animation_is_held = session->options->has_animation_time;
    options->animation_held_s = session->options->animation_time_s;
}

// Keeps the names of the animations. Fails when memory runs out.
static bool keep_animations(DipSession *session, const DipModel *model, DipError *err) {
    DipSessionAnimations *animations = &session->animations;
    const char *chosen = chosen_animation(session);
    int count;
    const char *const *names = dip_model_animations(model, &count);
    animations->playing = chosen || count == 0 ? -1 : 0;
    animations->names = calloc((size_t)count + 1, sizeof *animations->names);
    for (int i = 0; animations->names && i < count; i++) {
        char *name = strdup(names[i]);
        if (!name) {
            return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "animations", "out of memory");
        }
        animations->names[animations->count++] = name;
        animations->playing = chosen && strcmp(name, chosen) == 0 ? i : animations->playing;
    }
    return animations->names ||
           dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "animations", "out of memory");
}

void dip_session_free_animations(DipSession *session) {
    for (int i = 0; i < session->animations.count; i++) {
        free(session->animations.names[i]);
    }
    free(session->animations.names);
    session->animations = (DipSessionAnimations){.playing = -1};
}

int dip_session_model_files(const DipSession *session, const char *files[DIP_MAX_MODELS]) {
    const DipSessionOptions *options = session->options;
    const DipConfigFiles *named = &session->config.xfile;
    const int count = options->model_count ? options->model_count : (int)named->count;
    for (int i = 0; i < count; i++) {
        files[i] = options->model_count ? options->models[i] : named->items[i].path;
    }
    return count;
}

// Reads the environment of the ini's models. If it cannot be read, the error has the line of the
// ini that names it.
static bool load_environment(DipSession *session, DipErrorList *faults) {
    const DipConfigFile *file = &session->config.environment;
    const int line = session->config.line[DIP_KEY_ENVIRONMENT_BACKGROUND];
    if (!file->path && session->config.environment_background && !session->options->model_count) {
        return dip_session_refuse(faults, DIP_ERROR_MISSING, session->config.file, line,
                                  "ENVIRONMENT_BACKGROUND", "there is no ENVIRONMENT to show");
    }
    if (!file->path || session->options->model_count || session->environment) {
        return true;
    }
    DipError err;
    session->environment = dip_environment_read_file(file->path, &err);
    return session->environment || dip_session_place_fault(session, file, faults, &err);
}

static DipModel *load_model(const DipSession *session, DipErrorList *faults, DipSceneDef *def,
                            DipError *err) {
    const char *files[DIP_MAX_MODELS];
    const int count = dip_session_model_files(session, files);
    const DipImporter importer = importer_of(session);
    DipMaterialRule rules[DIP_MAX_MATERIAL_RULES];
    const int rule_count = session->options->model_count ? 0 : rules_of(&session->config, rules);
    DipModelOptions options = {.normal_maps = true,
                               .up = session->options->up,
                               .rules = rules,
                               .rule_count = rule_count,
                               .importer = session->importer ? &importer : NULL};
    float ambient_lin[3];
    set_light(session, ambient_lin, &options);
    set_animation(session, &options);
    DipModel *model = dip_model_load_with(files, count, &options, session->pool, faults, err);
    if (model) {
        *def = *dip_model_scene_def(model);
        set_surroundings(session, def);
    }
    return model;
}

// Shows the environment behind the scene if this is wanted. Otherwise, adds a ground if the models
// need a ground and a ground is wanted. Fails only if memory runs out.
static bool add_surface(const DipSession *session, const DipExtent *extent, DipSceneDef *def,
                        DipAddedSurface **added, DipError *err) {
    const bool wanted =
        session->options->model_count ? !session->options->no_ground : session->config.ground;
    const bool environment = def->environment && session->config.environment_background;
    if (!environment && !(wanted && dip_ground_is_missing(def, extent))) {
        return true;
    }
    *added =
        environment ? dip_backdrop_create(def, extent, err) : dip_ground_create(def, extent, err);
    if (*added) {
        *def = (*added)->def;
    }
    return *added != NULL;
}

const char *dip_session_scene_file(const DipSession *session) {
    if (session->shows_gallery) {
        return session->gallery_scene == DIP_GALLERY_TOUR
                   ? "tour"
                   : dip_gallery_info(session->gallery_scene)->name;
    }
    const char *files[DIP_MAX_MODELS];
    return dip_session_model_files(session, files) > 0 ? files[0] : "";
}

bool dip_session_keep_model(DipSession *session, DipError *err) {
    if (session->shows_gallery) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "--scene",
                             "a scene of the gallery has no models that the reference renderer "
                             "could draw");
    }
    if (!session->model) {
        DipErrorList warnings = {0}; // The first load has already reported these warnings.
        session->model = load_model(session, &warnings, &session->scene_def, err);
        dip_error_list_free(&warnings);
        if (session->model &&
            !add_surface(session, &session->extent, &session->scene_def, &session->added, err)) {
            dip_model_destroy(&session->model);
        }
    }
    return session->model != NULL;
}

bool dip_session_load_scene(DipSession *session, bool keep_model, DipErrorList *faults) {
    DipError err = {0};
    DipSceneDef def;
    DipAddedSurface *added = NULL;
    if (!load_environment(session, faults)) {
        return false;
    }
    DipModel *model = load_model(session, faults, &def, &err);
    if (model) {
        session->extent = dip_extent_of(&def);
        if (dip_session_orbits(session)) {
            session->silhouette = dip_silhouette_of(&def, &session->extent);
        }
        session->scene = keep_animations(session, model, &err) &&
                                 add_surface(session, &session->extent, &def, &added, &err)
                             ? dip_scene_create(&def, session->pool, &err)
                             : NULL;
        session->times.import_ms = dip_model_times(model).import_ms;
        session->times.pictures_ms = dip_model_times(model).pictures_ms;
        if (session->scene && keep_model) {
            session->model = model;
            session->added = added;
            session->scene_def = def;
        } else {
            dip_added_surface_destroy(&added);
            dip_model_destroy(&model);
        }
    }
    if (session->scene) {
        session->times.textures_ms = dip_scene_times(session->scene).textures_ms;
        session->times.meshes_ms = dip_scene_times(session->scene).meshes_ms;
        return true;
    }
    if (strcmp(err.key, DIP_MODEL_ANIMATION_KEY) == 0 && !session->options->animation) {
        return dip_session_refuse(faults, err.code, session->config.file,
                                  session->config.line[DIP_KEY_ANIMATION], "ANIMATION", "%s",
                                  err.message);
    }
    const DipConfigFiles *named = &session->config.xfile;
    for (size_t i = 0; !session->options->model_count && i < named->count; i++) {
        if (strcmp(err.file, named->items[i].path) == 0) {
            return dip_session_place_fault(session, &named->items[i], faults, &err);
        }
    }
    return dip_session_add_fault(faults, &err);
}
