// Parses values into typed fields. Error messages quote the value and say what is accepted.
#include "config/config_private.h"

#include "renderer/base/number.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool refuse(DipConfigKey key, DipErrorCode code, const char *text, const char *fault,
                   const char *example, DipError *err) {
    char accepted[128];
    dip_config_describe(key, accepted, sizeof accepted);
    return dip_error_set(err, code, NULL, 0, dip_config_key_name(key), "'%s' %s, accepted %s%s",
                         text, fault, accepted, example);
}

// Says which shape the value should have: "'640' is not WIDTHxHEIGHT, accepted ...".
static bool refuse_type(DipConfigKey key, const char *text, DipError *err) {
    switch (dip_config_key_info(key)->type) {
    case DIP_TYPE_SIZE:
        return refuse(key, DIP_ERROR_TYPE, text, "is not WIDTHxHEIGHT", ", for example 640x480",
                      err);
    case DIP_TYPE_COLOR:
        return refuse(key, DIP_ERROR_TYPE, text, "is not R,G,B", ", for example 64,128,255", err);
    case DIP_TYPE_INTEGER:
        return refuse(key, DIP_ERROR_TYPE, text, "is not a whole number", "", err);
    case DIP_TYPE_FLAG:
        return refuse(key, DIP_ERROR_TYPE, text, "is neither true nor false", "", err);
    case DIP_TYPE_SCALE:
        return refuse(key, DIP_ERROR_TYPE, text, "is neither auto nor a number", "", err);
    default:
        return refuse(key, DIP_ERROR_TYPE, text, "is not a number", "", err);
    }
}

static bool refuse_range(DipConfigKey key, const char *text, DipError *err) {
    return refuse(key, DIP_ERROR_RANGE, text, "is out of range", "", err);
}

// Parses exactly `count` whole numbers with `separator` between them.
static bool read_integers(DipConfigKey key, const char *text, char separator, int count,
                          int *values, DipError *err) {
    const DipConfigKeyInfo *info = dip_config_key_info(key);
    const char *at = text;
    bool in_range = true;
    for (int i = 0; i < count; i++) {
        const char *end = i + 1 < count ? strchr(at, separator) : at + strlen(at);
        // A double, so that a number too large for int is out of range and not of another type.
        double number;
        if (!end || !dip_number_parse(at, (size_t)(end - at), &number) ||
            strcspn(at, ".eE") < (size_t)(end - at)) {
            return refuse_type(key, text, err);
        }
        if (number < info->low || number > info->high) {
            in_range = false;
        } else {
            values[i] = (int)number;
        }
        at = end + 1;
    }
    return in_range || refuse_range(key, text, err);
}

static bool set_size(DipConfigKey key, const char *text, DipConfigSize *size, DipError *err) {
    int values[2];
    if (!read_integers(key, text, 'x', 2, values, err)) {
        return false;
    }
    *size = (DipConfigSize){values[0], values[1]};
    return true;
}

static bool set_color(DipConfigKey key, const char *text, DipConfigColor *color, DipError *err) {
    int values[3];
    if (!read_integers(key, text, ',', 3, values, err)) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        color->rgb[i] = (uint8_t)values[i];
    }
    return true;
}

static bool set_number(DipConfigKey key, const char *text, double *number, DipError *err) {
    const DipConfigKeyInfo *info = dip_config_key_info(key);
    double value;
    if (!dip_number_parse(text, strlen(text), &value)) {
        return refuse_type(key, text, err);
    }
    if (value < info->low || value > info->high) {
        return refuse_range(key, text, err);
    }
    *number = value;
    return true;
}

static bool set_flag(DipConfigKey key, const char *text, bool *flag, DipError *err) {
    const bool is_true = strcmp(text, "true") == 0;
    if (!is_true && strcmp(text, "false") != 0) {
        return refuse_type(key, text, err);
    }
    *flag = is_true;
    return true;
}

static bool set_isa(DipConfigKey key, const char *text, int *isa, DipError *err) {
    static const char *const names[] = {
#define ISA_NAME(name, NAME, lanes) #name,
        DIP_ISA_LIST(ISA_NAME)
#undef ISA_NAME
    };
    for (int i = 0; i < DIP_ISA_COUNT; i++) {
        if (strcmp(text, names[i]) == 0) {
            *isa = i;
            return true;
        }
    }
    if (strcmp(text, "auto") != 0) {
        return refuse(key, DIP_ERROR_UNKNOWN, text, "is not an instruction set", "", err);
    }
    *isa = DIP_CONFIG_ISA_AUTO;
    return true;
}

static bool set_shading(DipConfigKey key, const char *text, DipConfigShading *shading,
                        DipError *err) {
    static const char *const names[] = {
#define SHADING_NAME(name) #name,
        DIP_CONFIG_SHADING_LIST(SHADING_NAME)
#undef SHADING_NAME
    };
    for (int i = 0; i < DIP_CONFIG_SHADING_COUNT; i++) {
        if (strcmp(text, names[i]) == 0) {
            *shading = (DipConfigShading)i;
            return true;
        }
    }
    return refuse(key, DIP_ERROR_UNKNOWN, text, "is not a shading", "", err);
}

static bool set_scale(DipConfigKey key, const char *text, DipConfigScale *scale, DipError *err) {
    DipConfigScale given = {.automatic = strcmp(text, "auto") == 0};
    if (!given.automatic && !set_number(key, text, &given.factor, err)) {
        return false;
    }
    *scale = given;
    return true;
}

// Puts the setting's name before the message of the settings parser.
static bool set_settings(DipConfigKey key, const char *text, DipQuality *quality, DipError *err) {
    DipError inner = {0};
    if (dip_quality_parse(text, quality, &inner)) {
        return true;
    }
    return dip_error_set(err, inner.code, NULL, 0, dip_config_key_name(key), "%s: %s", inner.key,
                         inner.message);
}

static bool set_name(DipConfigKey key, const char *text, DipConfigName *name, DipError *err) {
    if (strlen(text) >= sizeof name->text) {
        return dip_error_set(err, DIP_ERROR_OVERSIZED, NULL, 0, dip_config_key_name(key),
                             "'%.40s...' is too long, accepted at most %d bytes", text,
                             DIP_CONFIG_MAX_NAME - 1);
    }
    strcpy(name->text, text);
    return true;
}

static void free_file(DipConfigFile *file) {
    free(file->path);
    free(file->text);
    *file = (DipConfigFile){0};
}

// Copies a file name and joins it to the ini's folder.
static bool make_file(const DipConfig *config, DipConfigKey key, const char *text, int line,
                      DipConfigFile *file, DipError *err) {
    const char *slash = strrchr(config->file, '/');
    const size_t folder = slash && text[0] != '/' ? (size_t)(slash - config->file) + 1 : 0;
    const size_t length = strlen(text);
    *file = (DipConfigFile){
        .path = malloc(folder + length + 1), .text = malloc(length + 1), .key = key, .line = line};
    if (!file->path || !file->text) {
        free_file(file);
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, dip_config_key_name(key),
                             "out of memory");
    }
    memcpy(file->path, config->file, folder);
    memcpy(file->path + folder, text, length + 1);
    memcpy(file->text, text, length + 1);
    return true;
}

static bool set_file(const DipConfig *config, DipConfigKey key, const char *text, int line,
                     DipConfigFile *field, DipError *err) {
    DipConfigFile file = {.key = key};
    if (text[0] && !make_file(config, key, text, line, &file, err)) {
        return false;
    }
    free_file(field);
    *field = file;
    return true;
}

static bool add_file(const DipConfig *config, DipConfigKey key, const char *text, int line,
                     DipConfigFiles *files, DipError *err) {
    if (files->count == DIP_CONFIG_MAX_MODELS) {
        return dip_error_set(err, DIP_ERROR_OVERSIZED, NULL, 0, dip_config_key_name(key),
                             "is given more than %d times, accepted up to %d models",
                             DIP_CONFIG_MAX_MODELS, DIP_CONFIG_MAX_MODELS);
    }
    DipConfigFile *items = realloc(files->items, (files->count + 1) * sizeof *items);
    if (!items) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, dip_config_key_name(key),
                             "out of memory");
    }
    files->items = items;
    if (!make_file(config, key, text, line, &items[files->count], err)) {
        return false;
    }
    files->count++;
    return true;
}

// Splits NAME = PICTURE at the last '=' that stands between spaces or tabs, so that names and files
// may contain '='. Returns the length of the name; *picture is the rest, or "" without such a '='.
static size_t split_light_map(const char *text, const char **picture) {
    static const char spaces[] = " \t\v\f";
    size_t length = strlen(text);
    *picture = "";
    for (size_t i = length; i-- > 1;) {
        if (text[i] == '=' && strchr(spaces, text[i - 1]) && text[i + 1] &&
            strchr(spaces, text[i + 1])) {
            *picture = text + i + 1 + strspn(text + i + 1, spaces);
            length = i;
            break;
        }
    }
    while (length > 0 && strchr(spaces, text[length - 1])) {
        length--;
    }
    return length;
}

static void free_material(DipConfigMaterial *material) {
    free(material->pattern);
    free_file(&material->light_map);
}

static bool add_material(const DipConfig *config, DipConfigKey key, const char *text, int line,
                         DipConfigMaterials *materials, DipError *err) {
    if (materials->count == DIP_CONFIG_MAX_MATERIALS) {
        return dip_error_set(err, DIP_ERROR_OVERSIZED, NULL, 0, dip_config_key_name(key),
                             "is given more than %d times, accepted up to %d names",
                             DIP_CONFIG_MAX_MATERIALS, DIP_CONFIG_MAX_MATERIALS);
    }
    const char *picture = "";
    const bool has_picture = dip_config_key_info(key)->type == DIP_TYPE_LIGHTMAPS;
    const size_t length = has_picture ? split_light_map(text, &picture) : strlen(text);
    DipConfigMaterial *items = realloc(materials->items, (materials->count + 1) * sizeof *items);
    materials->items = items ? items : materials->items;
    DipConfigMaterial material = {.pattern = calloc(length + 1, 1), .key = key, .line = line};
    if (!items || !material.pattern) {
        free_material(&material);
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, dip_config_key_name(key),
                             "out of memory");
    }
    snprintf(material.pattern, length + 1, "%s", text);
    if (picture[0] && !make_file(config, key, picture, line, &material.light_map, err)) {
        free_material(&material);
        return false;
    }
    items[materials->count++] = material;
    return true;
}

bool dip_config_set_value(DipConfig *config, DipConfigKey key, const char *text, int line,
                          DipError *err) {
    const DipConfigKeyInfo *info = dip_config_key_info(key);
    void *field = (char *)config + info->offset;
    switch (info->type) {
    case DIP_TYPE_SIZE:
        return set_size(key, text, field, err);
    case DIP_TYPE_NUMBER:
        return set_number(key, text, field, err);
    case DIP_TYPE_INTEGER:
        return read_integers(key, text, '\0', 1, field, err);
    case DIP_TYPE_FLAG:
        return set_flag(key, text, field, err);
    case DIP_TYPE_FILE:
        return set_file(config, key, text, line, field, err);
    case DIP_TYPE_FILES:
        return add_file(config, key, text, line, field, err);
    case DIP_TYPE_SETTINGS:
        return set_settings(key, text, field, err);
    case DIP_TYPE_COLOR:
        return set_color(key, text, field, err);
    case DIP_TYPE_ISA:
        return set_isa(key, text, field, err);
    case DIP_TYPE_NAME:
        return set_name(key, text, field, err);
    case DIP_TYPE_MATERIALS:
    case DIP_TYPE_LIGHTMAPS:
        return add_material(config, key, text, line, field, err);
    case DIP_TYPE_SHADING:
        return set_shading(key, text, field, err);
    case DIP_TYPE_LIGHTS:
        return dip_config_add_light(key, text, field, err);
    case DIP_TYPE_SCALE:
        return set_scale(key, text, field, err);
    }
    return false;
}

void dip_config_free(DipConfig *config) {
    for (int k = 0; k < DIP_KEY_COUNT; k++) {
        const DipConfigKeyInfo *info = dip_config_key_info((DipConfigKey)k);
        void *field = (char *)config + info->offset;
        if (info->type == DIP_TYPE_FILE) {
            free_file(field);
        } else if (info->type == DIP_TYPE_FILES) {
            DipConfigFiles *files = field;
            for (size_t i = 0; i < files->count; i++) {
                free_file(&files->items[i]);
            }
            free(files->items);
        } else if (info->type == DIP_TYPE_LIGHTS) {
            free(((DipConfigLights *)field)->items);
        } else if (dip_config_may_repeat(info->type)) {
            DipConfigMaterials *materials = field;
            for (size_t i = 0; i < materials->count; i++) {
                free_material(&materials->items[i]);
            }
            free(materials->items);
        }
    }
    free(config->file);
    *config = (DipConfig){0};
}
