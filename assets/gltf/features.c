// Names the features that a glTF file uses and Diptych does not draw, each once per file.
#include "assets/gltf/document.h"
#include "assets/model_parts.h"

#include <cjson/cJSON.h>

#include <string.h>

enum { MAX_EXTENSIONS = 64 };

// The extensions that Diptych knows. loss: what the picture lacks, with the extension's name before
// it; "" for the usual words; NULL if nothing is lost.
typedef struct Extension {
    const char *name;
    const char *loss;
} Extension;

static const Extension extensions[] = {
    {"EXT_instance_features", NULL}, // It numbers parts, but does not describe their looks.
    {"EXT_mesh_features", NULL},     // The same.
    {"EXT_mesh_gpu_instancing", NULL},
    {"EXT_meshopt_compression", NULL},
    {"EXT_structural_metadata", NULL}, // It describes numbered parts, but not their looks.
    {"EXT_texture_webp", NULL},
    {"KHR_animation_pointer", "is not played: what it moves, such as materials, lights and lenses, "
                              "stays as it is at rest"},
    {"KHR_draco_mesh_compression", NULL},
    {"KHR_lights_punctual", NULL},
    {"KHR_materials_clearcoat", NULL},
    {"KHR_materials_emissive_strength", NULL},
    {"KHR_materials_ior", NULL},
    {"KHR_materials_pbrSpecularGlossiness", NULL},
    {"KHR_materials_sheen", NULL},
    {"KHR_materials_specular", NULL},
    {"KHR_materials_transmission", "is drawn without refraction"},
    {"KHR_materials_unlit", NULL},
    {"KHR_materials_variants", "is not drawn: the surfaces have the materials of the first look"},
    {"KHR_mesh_quantization", NULL},
    {"KHR_node_hoverability", NULL},  // It is for programs in which a user points at nodes.
    {"KHR_node_selectability", NULL}, // The same.
    {"KHR_node_visibility", NULL},
    {"KHR_texture_basisu", NULL}, // Each picture gives a message of its own.
    {"KHR_texture_transform", NULL},
    {"KHR_xmp", NULL}, // It describes the file, not the picture.
    {"KHR_xmp_json_ld", NULL},
    {"MSFT_lod", NULL}, // The finest level is drawn.
    {"MSFT_texture_dds", NULL},
};

// The names of the extensions of a file.
typedef struct Names {
    const char *items[MAX_EXTENSIONS];
    int count;
    bool has_more; // True if there are others, for which there is no room.
} Names;

// --- extensions ----------------------------------------------------------------------------------

static const Extension *find_extension(const char *name) {
    for (size_t i = 0; i < sizeof extensions / sizeof *extensions; ++i) {
        if (strcmp(extensions[i].name, name) == 0) {
            return &extensions[i];
        }
    }
    return NULL;
}

static void add_name(Names *names, const char *name) {
    for (int i = 0; i < names->count; ++i) {
        if (strcmp(names->items[i], name) == 0) {
            return;
        }
    }
    if (names->count < MAX_EXTENSIONS) {
        names->items[names->count++] = name;
    } else {
        names->has_more = true;
    }
}

static void add_listed(Names *names, const cJSON *list) {
    for (const cJSON *item = list ? list->child : NULL; item; item = item->next) {
        if (cJSON_IsString(item)) {
            add_name(names, item->valuestring);
        }
    }
}

// Adds the extensions that an object and those within it use. A file may use extensions that it
// does not list. `extras` hold anything, and so no extensions.
static void add_used(Names *names, const cJSON *object) {
    for (const cJSON *item = object->child; item; item = item->next) {
        if (item->string && strcmp(item->string, "extras") == 0) {
            continue;
        }
        const bool uses =
            item->string && strcmp(item->string, "extensions") == 0 && cJSON_IsObject(item);
        for (const cJSON *used = uses ? item->child : NULL; used; used = used->next) {
            add_name(names, used->string);
        }
        add_used(names, item);
    }
}

// A surface can be drawn without what describes its look more closely.
static bool is_needed(const char *name) {
    return !find_extension(name) && strncmp(name, "KHR_materials_", 14) != 0;
}

static void warn_of_extension(const DipGltf *gltf, DipModel *model, const char *name,
                              const char *key) {
    const Extension *known = find_extension(name);
    if (known && known->loss) {
        dip_model_warn(model, gltf->path, key, "the glTF extension %s %s", name, known->loss);
    } else if (!known) {
        dip_model_warn(model, gltf->path, key,
                       "the effect of the glTF extension %.80s is not drawn", name);
    }
}

static bool check_required(const DipGltf *gltf, DipModel *model, const Names *required) {
    if (required->has_more) {
        return dip_gltf_refuse(gltf, DIP_ERROR_UNSUPPORTED, "extensionsRequired",
                               "the model needs more than %d glTF extensions, accepted %d",
                               MAX_EXTENSIONS, MAX_EXTENSIONS);
    }
    for (int i = 0; i < required->count; ++i) {
        const char *name = required->items[i];
        if (is_needed(name)) {
            char shown[80];
            size_t length = 0;
            for (; name[length] && length + 1 < sizeof shown; ++length) {
                shown[length] = name[length] >= ' ' && name[length] <= '~' ? name[length] : '?';
            }
            shown[length] = '\0';
            return dip_gltf_refuse(gltf, DIP_ERROR_UNSUPPORTED, "extensionsRequired",
                                   "the model needs the glTF extension \"%s\", which cannot be "
                                   "decoded, accepted those of docs/models.md",
                                   shown);
        }
        if (model) {
            warn_of_extension(gltf, model, name, "extensionsRequired");
        }
    }
    return true;
}

// --- other features ------------------------------------------------------------------------------

static void warn_of_maps(const DipGltf *gltf, DipModel *model) {
    static const struct {
        const char *extension;
        const char *map;
    } maps[] = {
        {"KHR_materials_clearcoat", "clearcoatTexture"},
        {"KHR_materials_clearcoat", "clearcoatRoughnessTexture"},
        {"KHR_materials_clearcoat", "clearcoatNormalTexture"},
        {"KHR_materials_sheen", "sheenColorTexture"},
        {"KHR_materials_sheen", "sheenRoughnessTexture"},
        {"KHR_materials_specular", "specularTexture"},
        {"KHR_materials_specular", "specularColorTexture"},
        {"KHR_materials_transmission", "transmissionTexture"},
    };
    const DipGltfItems *materials = &gltf->tables[DIP_GLTF_materials];
    for (size_t m = 0; m < sizeof maps / sizeof *maps; ++m) {
        bool found = false;
        for (int i = 0; !found && i < materials->count; ++i) {
            const cJSON *extension = dip_gltf_extension(materials->items[i], maps[m].extension);
            found = cJSON_GetObjectItemCaseSensitive(extension, maps[m].map) != NULL;
        }
        if (found) {
            dip_model_warn(model, gltf->path, maps[m].extension, "the picture %s is not drawn",
                           maps[m].map);
        }
    }
}

static bool has_attribute(const cJSON *primitive, const char *name) {
    const cJSON *list = cJSON_GetObjectItemCaseSensitive(primitive, "attributes");
    return cJSON_GetObjectItemCaseSensitive(list, name) != NULL;
}

// True if a morph target of the primitive has an attribute whose name begins like this.
static bool has_target(const cJSON *primitive, const char *begin) {
    const cJSON *targets = cJSON_GetObjectItemCaseSensitive(primitive, "targets");
    for (const cJSON *target = targets ? targets->child : NULL; target; target = target->next) {
        for (const cJSON *item = target->child; item; item = item->next) {
            if (item->string && strncmp(item->string, begin, strlen(begin)) == 0) {
                return true;
            }
        }
    }
    return false;
}

// Warns once if a primitive has an attribute, or a morph target with an attribute of this kind.
static void warn_of_attributes(const DipGltf *gltf, DipModel *model) {
    static const struct {
        const char *name;
        const char *loss;
        bool (*is_in)(const cJSON *primitive, const char *name);
    } attributes[] = {
        {"COLOR_1", "a second set of vertex colours is not drawn", has_attribute},
        {"JOINTS_1", "a vertex follows its first four joints only", has_attribute},
        {"TEXCOORD_8", "texture coordinates beyond the eighth set are not read", has_attribute},
        {"COLOR_", "morph targets do not change the vertices' colours", has_target},
        {"TEXCOORD_", "morph targets do not move texture coordinates", has_target},
    };
    const DipGltfItems *meshes = &gltf->tables[DIP_GLTF_meshes];
    for (size_t a = 0; a < sizeof attributes / sizeof *attributes; ++a) {
        bool found = false;
        for (int i = 0; !found && i < meshes->count; ++i) {
            const cJSON *parts = cJSON_GetObjectItemCaseSensitive(meshes->items[i], "primitives");
            for (const cJSON *part = parts ? parts->child : NULL; part; part = part->next) {
                found = found || attributes[a].is_in(part, attributes[a].name);
            }
        }
        if (found) {
            dip_model_warn(model, gltf->path, attributes[a].name, "%s", attributes[a].loss);
        }
    }
}

static void warn_of_scenes(const DipGltf *gltf, DipModel *model) {
    const int count = gltf->tables[DIP_GLTF_scenes].count;
    if (count > 1) {
        dip_model_warn(model, gltf->path, "scenes",
                       "the file has %d scenes, of which only the default scene is drawn", count);
    }
}

bool dip_gltf_check_extensions(const DipGltf *gltf, DipModel *model) {
    Names required = {.count = 0};
    add_listed(&required, cJSON_GetObjectItemCaseSensitive(gltf->json, "extensionsRequired"));
    if (!check_required(gltf, model, &required)) {
        return false;
    }
    if (!model || !model->warnings) {
        return true;
    }
    Names all = required;
    add_listed(&all, cJSON_GetObjectItemCaseSensitive(gltf->json, "extensionsUsed"));
    add_used(&all, gltf->json);
    for (int i = required.count; i < all.count; ++i) {
        warn_of_extension(gltf, model, all.items[i], "extensionsUsed");
    }
    if (all.has_more) {
        dip_model_warn(model, gltf->path, "extensionsUsed",
                       "the file uses more than %d glTF extensions, of which only %d are checked",
                       MAX_EXTENSIONS, MAX_EXTENSIONS);
    }
    warn_of_maps(gltf, model);
    warn_of_attributes(gltf, model);
    warn_of_scenes(gltf, model);
    return true;
}
