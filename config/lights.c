// Parses the lights of the ini: "spot at=0,3,0 to=0,0,0 strength=9 outer=30".
#include "config/config_private.h"

#include "renderer/base/number.h"
#include "renderer/base/srgb.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const kind_names[] = {[DIP_LIGHT_DIRECTIONAL] = "directional",
                                         [DIP_LIGHT_POINT] = "point",
                                         [DIP_LIGHT_SPOT] = "spot"};

enum { MAX_NUMBERS = 3, MOST_M = 1000000000, DIRECTIONAL = 1, POINT = 2, SPOT = 4 };

typedef enum Part {
    PART_at,
    PART_to,
    PART_colour,
    PART_strength,
    PART_range,
    PART_inner,
    PART_outer,
    PART_attenuation,
    PART_COUNT
} Part;

// The parts of a light. Each has one or three numbers.
static const struct {
    const char *name;
    int count;
    double low;
    double high;
    bool whole;   // only whole numbers
    int kinds;    // kinds of lights that have this part
    int required; // kinds of lights that need it
    double otherwise[MAX_NUMBERS];
} parts[PART_COUNT] = {
    [PART_at] = {"at", 3, -MOST_M, MOST_M, false, POINT | SPOT, POINT | SPOT, {0}},
    [PART_to] = {"to", 3, -MOST_M, MOST_M, false, DIRECTIONAL | SPOT, DIRECTIONAL | SPOT, {0}},
    [PART_colour] = {"colour", 3, 0, 255, true, DIRECTIONAL | POINT | SPOT, 0, {255, 255, 255}},
    [PART_strength] = {"strength", 1, 0, 1e6, false, DIRECTIONAL | POINT | SPOT, 0, {1}},
    [PART_range] = {"range", 1, 0, MOST_M, false, POINT | SPOT, 0, {0}},
    [PART_inner] = {"inner", 1, 0, 90, false, SPOT, 0, {0}},
    [PART_outer] = {"outer", 1, 0, 90, false, SPOT, 0, {45}},
    [PART_attenuation] = {"attenuation", 3, 0, MOST_M, false, POINT | SPOT, 0, {0, 0, 1}},
};

typedef struct LightText {
    DipConfigKey key;
    DipLightKind kind;
    bool given[PART_COUNT];
    double value[PART_COUNT][MAX_NUMBERS];
    DipError *err;
} LightText;

static bool refuse(const LightText *light, DipErrorCode code, const char *message) {
    return dip_error_set(light->err, code, NULL, 0, dip_config_key_name(light->key), "%s", message);
}

// --- the text ------------------------------------------------------------------------------------

static bool read_kind(LightText *light, const char *text, size_t length) {
    for (size_t i = 0; i < sizeof kind_names / sizeof *kind_names; i++) {
        if (strlen(kind_names[i]) == length && memcmp(kind_names[i], text, length) == 0) {
            light->kind = (DipLightKind)i;
            return true;
        }
    }
    char message[160];
    snprintf(message, sizeof message,
             "'%.*s' is not a kind of light, accepted directional, point or spot",
             (int)(length < 60 ? length : 60), text);
    return refuse(light, DIP_ERROR_UNKNOWN, message);
}

static bool has_part(const LightText *light, int part) {
    return (parts[part].kinds & 1 << light->kind) != 0;
}

static bool refuse_part(const LightText *light, const char *text, size_t length) {
    char message[220];
    int end = snprintf(message, sizeof message, "'%.*s' is no part of a %s light, accepted",
                       (int)(length < 60 ? length : 60), text, kind_names[light->kind]);
    for (int p = 0; p < PART_COUNT; p++) {
        if (has_part(light, p)) {
            end += snprintf(message + end, sizeof message - (size_t)end, " %s=", parts[p].name);
        }
    }
    return refuse(light, DIP_ERROR_UNKNOWN, message);
}

static bool refuse_numbers(const LightText *light, int part, DipErrorCode code, const char *text,
                           size_t length) {
    char message[220];
    snprintf(message, sizeof message, "%s='%.*s' %s, accepted %s %g..%g%s", parts[part].name,
             (int)(length < 60 ? length : 60), text,
             code == DIP_ERROR_RANGE  ? "is out of range"
             : parts[part].count == 3 ? "is not three numbers"
                                      : "is not a number",
             parts[part].count == 3 ? (parts[part].whole ? "three whole numbers with commas,"
                                                         : "three numbers with commas,")
                                    : "a number",
             parts[part].low, parts[part].high, parts[part].count == 3 ? " each" : "");
    return refuse(light, code, message);
}

static bool read_numbers(LightText *light, int part, const char *text, size_t length) {
    const char *at = text;
    bool in_range = true;
    for (int i = 0; i < parts[part].count; i++) {
        const size_t left = (size_t)(text + length - at);
        const char *comma = i + 1 < parts[part].count ? memchr(at, ',', left) : at + left;
        double *value = &light->value[part][i];
        if (!comma || !dip_number_parse(at, (size_t)(comma - at), value) ||
            (parts[part].whole && *value != floor(*value))) {
            return refuse_numbers(light, part, DIP_ERROR_TYPE, text, length);
        }
        in_range = in_range && *value >= parts[part].low && *value <= parts[part].high;
        at = comma + 1;
    }
    return in_range || refuse_numbers(light, part, DIP_ERROR_RANGE, text, length);
}

static bool read_part(LightText *light, const char *text, size_t length) {
    const char *equals = memchr(text, '=', length);
    const size_t name_length = equals ? (size_t)(equals - text) : length;
    for (int p = 0; p < PART_COUNT; p++) {
        if (strlen(parts[p].name) != name_length || memcmp(parts[p].name, text, name_length) != 0 ||
            !has_part(light, p)) {
            continue;
        }
        char message[80];
        if (light->given[p]) {
            snprintf(message, sizeof message, "'%s' is given twice, accepted once", parts[p].name);
            return refuse(light, DIP_ERROR_CONFLICT, message);
        }
        light->given[p] = true;
        const char *value = equals ? equals + 1 : text + length;
        return read_numbers(light, p, value, (size_t)(text + length - value));
    }
    return refuse_part(light, text, name_length);
}

static bool read_text(LightText *light, const char *text) {
    static const char spaces[] = " \t\v\f";
    size_t length = strcspn(text, spaces);
    if (!read_kind(light, text, length)) {
        return false;
    }
    for (int p = 0; p < PART_COUNT; p++) {
        memcpy(light->value[p], parts[p].otherwise, sizeof light->value[p]);
    }
    for (text += length; *(text += strspn(text, spaces)); text += length) {
        length = strcspn(text, spaces);
        if (!read_part(light, text, length)) {
            return false;
        }
    }
    for (int p = 0; p < PART_COUNT; p++) {
        if ((parts[p].required & 1 << light->kind) && !light->given[p]) {
            char message[80];
            snprintf(message, sizeof message, "the %s light lacks '%s', accepted %s=X,Y,Z",
                     kind_names[light->kind], parts[p].name, parts[p].name);
            return refuse(light, DIP_ERROR_MISSING, message);
        }
    }
    return true;
}

// --- the light -----------------------------------------------------------------------------------

// Sets the unit vector along which the light travels.
static bool set_direction(const LightText *light, DipLightDef *def) {
    double d[3];
    double square = 0.0;
    for (int i = 0; i < 3; i++) {
        const double from = light->kind == DIP_LIGHT_SPOT ? light->value[PART_at][i] : 0.0;
        d[i] = light->value[PART_to][i] - from;
        square += d[i] * d[i];
    }
    const double length = sqrt(square);
    if (!(length >= 1e-9)) {
        return refuse(light, DIP_ERROR_RANGE,
                      light->kind == DIP_LIGHT_SPOT
                          ? "'at' and 'to' are the same point, accepted two points"
                          : "'to' has no length, accepted the way that the light travels");
    }
    for (int i = 0; i < 3; i++) {
        def->direction_world[i] = (float)(d[i] / length);
    }
    return true;
}

static bool set_cone(const LightText *light, DipLightDef *def) {
    def->inner_deg = (float)light->value[PART_inner][0];
    def->outer_deg = (float)light->value[PART_outer][0];
    if (def->outer_deg > 0.0f && def->inner_deg <= def->outer_deg) {
        return true;
    }
    char message[160];
    snprintf(message, sizeof message,
             "inner is %g and outer %g, accepted an outer angle above 0 and not below inner",
             light->value[PART_inner][0], light->value[PART_outer][0]);
    return refuse(light, DIP_ERROR_CONFLICT, message);
}

static bool make_light(const LightText *light, DipLightDef *def) {
    *def = (DipLightDef){.kind = light->kind, .range_m = (float)light->value[PART_range][0]};
    for (int i = 0; i < 3; i++) {
        def->colour_lin[i] = (float)(light->value[PART_strength][0] *
                                     dip_srgb_decode(light->value[PART_colour][i] / 255.0));
        def->position_world[i] = (float)light->value[PART_at][i];
        def->attenuation[i] = (float)light->value[PART_attenuation][i];
    }
    if (def->attenuation[0] == 0.0f && def->attenuation[1] == 0.0f && def->attenuation[2] == 0.0f) {
        return refuse(light, DIP_ERROR_RANGE,
                      "attenuation is 0,0,0, accepted at least one number above 0");
    }
    return (light->kind == DIP_LIGHT_POINT || set_direction(light, def)) &&
           (light->kind != DIP_LIGHT_SPOT || set_cone(light, def));
}

bool dip_config_add_light(DipConfigKey key, const char *text, DipConfigLights *lights,
                          DipError *err) {
    LightText light = {.key = key, .err = err};
    DipLightDef def;
    if (lights->count == DIP_MAX_LIGHTS) {
        return dip_error_set(err, DIP_ERROR_OVERSIZED, NULL, 0, dip_config_key_name(key),
                             "is given more than %d times, accepted up to %d lights",
                             DIP_MAX_LIGHTS, DIP_MAX_LIGHTS);
    }
    if (!read_text(&light, text) || !make_light(&light, &def)) {
        return false;
    }
    DipLightDef *items = realloc(lights->items, (lights->count + 1) * sizeof *items);
    if (!items) {
        return refuse(&light, DIP_ERROR_MEMORY, "out of memory");
    }
    lights->items = items;
    items[lights->count++] = def;
    return true;
}
