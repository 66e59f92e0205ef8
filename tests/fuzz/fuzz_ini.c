// Fuzzes the reader of the configuration. A configuration that was read is the same when it is
// written, with indentation and CRLF, and read again. Its lights are within the ranges that a scene
// accepts; they are not written, because their numbers no longer are those of the text.
#include "config/config.h"
#include "config/config_private.h"
#include "renderer/base/number.h"
#include "tests/fuzz/fuzz.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- writing -------------------------------------------------------------------------------------

static void write_number(FILE *out, double value) {
    char text[DIP_NUMBER_TEXT_SIZE];
    dip_number_format(value, text);
    fputs(text, out);
}

static void write_isa(FILE *out, int isa) {
    static const char *const names[] = {
#define ISA_NAME(name, NAME, lanes) #name,
        DIP_ISA_LIST(ISA_NAME)
#undef ISA_NAME
    };
    fputs(isa == DIP_CONFIG_ISA_AUTO ? "auto" : names[isa], out);
}

static void write_scale(FILE *out, const DipConfigScale *scale) {
    if (scale->automatic) {
        fputs("auto", out);
    } else {
        write_number(out, scale->factor);
    }
}

static void write_value(FILE *out, DipConfigType type, const void *field) {
    char settings[256];
    const DipConfigSize *size = field;
    const DipConfigColor *colour = field;
    const DipConfigMaterial *material = field;
    switch (type) {
    case DIP_TYPE_SIZE:
        fprintf(out, "%dx%d", size->width, size->height);
        break;
    case DIP_TYPE_NUMBER:
        write_number(out, *(const double *)field);
        break;
    case DIP_TYPE_INTEGER:
        fprintf(out, "%d", *(const int *)field);
        break;
    case DIP_TYPE_FLAG:
        fputs(*(const bool *)field ? "true" : "false", out);
        break;
    case DIP_TYPE_SETTINGS:
        dip_quality_format(field, settings, sizeof settings);
        fputs(settings, out);
        break;
    case DIP_TYPE_COLOR:
        fprintf(out, "%d,%d,%d", colour->rgb[0], colour->rgb[1], colour->rgb[2]);
        break;
    case DIP_TYPE_ISA:
        write_isa(out, *(const int *)field);
        break;
    case DIP_TYPE_NAME:
        fputs(((const DipConfigName *)field)->text, out);
        break;
    case DIP_TYPE_FILE:
    case DIP_TYPE_FILES:
        fputs(((const DipConfigFile *)field)->text, out);
        break;
    case DIP_TYPE_MATERIALS:
    case DIP_TYPE_LIGHTMAPS:
        fputs(material->pattern, out);
        if (material->light_map.path) {
            fprintf(out, " = %s", material->light_map.text);
        }
        break;
    case DIP_TYPE_SHADING: {
        static const char *const names[] = {"auto", "flat", "gouraud", "phong"};
        fputs(names[*(const DipConfigShading *)field], out);
        break;
    }
    case DIP_TYPE_SCALE:
        write_scale(out, field);
        break;
    case DIP_TYPE_LIGHTS:
        break;
    }
}

static void write_line(FILE *out, const DipConfigKeyInfo *info, const void *field) {
    fprintf(out, "\t %s = ", info->name);
    write_value(out, info->type, field);
    fputs(" ; comment\r\n", out);
}

static const void *field_of(const DipConfig *config, int key) {
    return (const char *)config + dip_config_key_info((DipConfigKey)key)->offset;
}

// Writes the keys that the first file gave.
static void write_config(FILE *out, const DipConfig *config) {
    for (int k = 0; k < DIP_KEY_COUNT; k++) {
        const DipConfigKeyInfo *info = dip_config_key_info((DipConfigKey)k);
        const void *field = field_of(config, k);
        const DipConfigFiles *files = field;
        const DipConfigMaterials *materials = field;
        const bool repeats = dip_config_may_repeat(info->type);
        const bool unwritten = config->line[k] == 0 || info->type == DIP_TYPE_LIGHTS;
        const size_t count = unwritten                      ? 0
                             : info->type == DIP_TYPE_FILES ? files->count
                             : repeats                      ? materials->count
                                                            : 1;
        for (size_t i = 0; i < count; i++) {
            write_line(out, info,
                       info->type == DIP_TYPE_FILES ? &files->items[i]
                       : repeats                    ? (const void *)&materials->items[i]
                                                    : field);
        }
    }
}

// --- comparing -----------------------------------------------------------------------------------

static bool same_file(const DipConfigFile *a, const DipConfigFile *b) {
    return (a->path == NULL) == (b->path == NULL) &&
           (!a->path || (strcmp(a->path, b->path) == 0 && strcmp(a->text, b->text) == 0));
}

static bool same_files(const DipConfigFiles *a, const DipConfigFiles *b) {
    bool same = a->count == b->count;
    for (size_t i = 0; same && i < a->count; i++) {
        same = same_file(&a->items[i], &b->items[i]);
    }
    return same;
}

static bool same_materials(const DipConfigMaterials *a, const DipConfigMaterials *b) {
    bool same = a->count == b->count;
    for (size_t i = 0; same && i < a->count; i++) {
        same = strcmp(a->items[i].pattern, b->items[i].pattern) == 0 &&
               same_file(&a->items[i].light_map, &b->items[i].light_map);
    }
    return same;
}

static bool same_value(DipConfigType type, const void *a, const void *b) {
    switch (type) {
    case DIP_TYPE_SIZE:
        return memcmp(a, b, sizeof(DipConfigSize)) == 0;
    case DIP_TYPE_NUMBER:
        return memcmp(a, b, sizeof(double)) == 0;
    case DIP_TYPE_INTEGER:
    case DIP_TYPE_ISA:
        return memcmp(a, b, sizeof(int)) == 0;
    case DIP_TYPE_FLAG:
        return memcmp(a, b, sizeof(bool)) == 0;
    case DIP_TYPE_SETTINGS:
        return memcmp(a, b, sizeof(DipQuality)) == 0;
    case DIP_TYPE_COLOR:
        return memcmp(a, b, sizeof(DipConfigColor)) == 0;
    case DIP_TYPE_NAME:
        return strcmp(((const DipConfigName *)a)->text, ((const DipConfigName *)b)->text) == 0;
    case DIP_TYPE_FILE:
        return same_file(a, b);
    case DIP_TYPE_FILES:
        return same_files(a, b);
    case DIP_TYPE_MATERIALS:
    case DIP_TYPE_LIGHTMAPS:
        return same_materials(a, b);
    case DIP_TYPE_SHADING:
        return memcmp(a, b, sizeof(DipConfigShading)) == 0;
    case DIP_TYPE_SCALE:
        return ((const DipConfigScale *)a)->automatic == ((const DipConfigScale *)b)->automatic &&
               ((const DipConfigScale *)a)->factor == ((const DipConfigScale *)b)->factor;
    case DIP_TYPE_LIGHTS:
        return true;
    }
    return false;
}

// --- the check -----------------------------------------------------------------------------------

static void check_range(const DipConfigKeyInfo *info, const void *field) {
    if (info->type == DIP_TYPE_NUMBER && info->fallback && info->fallback[0]) {
        const double value = *(const double *)field;
        FUZZ_CHECK(value == 0.0 || (value >= info->low && value <= info->high));
    }
}

static void check_light(const DipLightDef *light) {
    const bool directional = light->kind == DIP_LIGHT_DIRECTIONAL;
    const float *d = light->direction_world;
    const float *a = light->attenuation;
    for (int i = 0; i < 3; i++) {
        FUZZ_CHECK(light->colour_lin[i] >= 0.0f && light->colour_lin[i] <= 1e6f);
        FUZZ_CHECK(fabsf(light->position_world[i]) <= 1e9f && a[i] >= 0.0f && a[i] <= 1e9f);
    }
    FUZZ_CHECK(directional || a[0] > 0.0f || a[1] > 0.0f || a[2] > 0.0f);
    FUZZ_CHECK(light->range_m >= 0.0f && light->range_m <= 1e9f);
    const float square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    FUZZ_CHECK(light->kind == DIP_LIGHT_POINT || fabsf(square - 1.0f) < 1e-5f);
    if (light->kind == DIP_LIGHT_SPOT) {
        FUZZ_CHECK(light->outer_deg > 0.0f && light->outer_deg <= 90.0f);
        FUZZ_CHECK(light->inner_deg >= 0.0f && light->inner_deg <= light->outer_deg);
    }
}

static void check_lights(const DipConfigLights *lights) {
    FUZZ_CHECK(lights->count <= DIP_MAX_LIGHTS);
    for (size_t i = 0; i < lights->count; i++) {
        check_light(&lights->items[i]);
    }
}

static void check_accepted(const DipConfig *config) {
    char *text = NULL;
    size_t size_bytes = 0;
    FILE *out = open_memstream(&text, &size_bytes);
    FUZZ_CHECK(out != NULL);
    write_config(out, config);
    fclose(out);
    DipConfig again;
    DipErrorList faults = {0};
    FUZZ_CHECK(dip_config_load(fuzz_write("x.ini", text, size_bytes), &again, &faults));
    FUZZ_CHECK(faults.count == 0);
    check_lights(&config->light);
    for (int k = 0; k < DIP_KEY_COUNT; k++) {
        const DipConfigKeyInfo *info = dip_config_key_info((DipConfigKey)k);
        check_range(info, field_of(config, k));
        FUZZ_CHECK(same_value(info->type, field_of(config, k), field_of(&again, k)));
    }
    dip_config_free(&again);
    dip_error_list_free(&faults);
    free(text);
}

static void check_faults(const DipErrorList *faults) {
    for (size_t i = 0; i < faults->count; i++) {
        char line[1024];
        dip_error_format(&faults->items[i], line, sizeof line);
        FUZZ_CHECK(faults->items[i].code != DIP_ERROR_NONE && faults->items[i].message[0]);
        FUZZ_CHECK(!strchr(line, '\n'));
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size_bytes) {
    DipConfig config;
    DipErrorList faults = {0};
    const bool accepted = dip_config_load(fuzz_write("x.ini", bytes, size_bytes), &config, &faults);
    FUZZ_CHECK(accepted == (faults.error_count == 0));
    check_faults(&faults);
    if (accepted) {
        check_accepted(&config);
        dip_config_free(&config);
    }
    dip_error_list_free(&faults);
    return 0;
}
