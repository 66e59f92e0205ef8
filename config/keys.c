// The table of keys: look-up, the key nearest to a misspelt name, and descriptions for messages and
// documentation.
#include "config/config_private.h"

#include "renderer/base/assert.h"
#include "renderer/base/fp_mode.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_NAME = 64 }; // Longer names get no suggestion.

static const DipConfigKeyInfo infos[DIP_KEY_COUNT] = {
#define INFO_KEY(NAME, field, TYPE, fallback, low, high, text)                                     \
    {#NAME, DIP_TYPE_##TYPE, fallback, low, high, text, offsetof(DipConfig, field)},
#define INFO_CAMERA(NAME, fov, text)                                                               \
    {"CAMPATH_" #NAME,                                                                             \
     DIP_TYPE_FILE,                                                                                \
     "",                                                                                           \
     0,                                                                                            \
     0,                                                                                            \
     "camera path " text,                                                                          \
     offsetof(DipConfig, camera[DIP_CATEGORY_##NAME].file)},                                       \
        {"CAMPATH_" #NAME "_FOV",                                                                  \
         DIP_TYPE_NUMBER,                                                                          \
         fov,                                                                                      \
         1,                                                                                        \
         170,                                                                                      \
         "vertical field of view of that path, degrees",                                           \
         offsetof(DipConfig, camera[DIP_CATEGORY_##NAME].fov_y_deg)},
#define INFO_PICTURE(NAME, size, text)                                                             \
    {#NAME,                                                                                        \
     DIP_TYPE_FILE,                                                                                \
     "",                                                                                           \
     0,                                                                                            \
     0,                                                                                            \
     "picture that replaces the flat colour of mip levels of size " text,                          \
     offsetof(DipConfig, mip_picture[DIP_MIP_LEVEL_##size])},
    DIP_CONFIG_LIST(INFO_KEY, INFO_CAMERA, INFO_PICTURE)};

const DipConfigKeyInfo *dip_config_key_info(DipConfigKey key) {
    DIP_ASSERT(key < DIP_KEY_COUNT);
    return &infos[key];
}

bool dip_config_may_repeat(DipConfigType type) {
    return type == DIP_TYPE_FILES || type == DIP_TYPE_MATERIALS || type == DIP_TYPE_LIGHTMAPS ||
           type == DIP_TYPE_LIGHTS;
}

const char *dip_config_key_name(DipConfigKey key) {
    return dip_config_key_info(key)->name;
}

bool dip_config_find_key(const char *name, DipConfigKey *key) {
    for (int k = 0; k < DIP_KEY_COUNT; k++) {
        if (strcmp(name, infos[k].name) == 0) {
            *key = (DipConfigKey)k;
            return true;
        }
    }
    return false;
}

static int min3(int a, int b, int c) {
    const int least = a < b ? a : b;
    return least < c ? least : c;
}

static bool same_letter(char a, char b) {
    return toupper((unsigned char)a) == toupper((unsigned char)b);
}

// Returns the optimal string alignment distance of two names, ignoring case: the number of letters
// to insert, delete or replace plus the number of neighbours to swap. Both strings are shorter than
// MAX_NAME.
static int edit_distance(const char *a, const char *b) {
    const int b_length = (int)strlen(b);
    int rows[3][MAX_NAME]; // row i of the table is rows[i % 3]
    for (int j = 0; j <= b_length; j++) {
        rows[0][j] = j;
    }
    int i = 1;
    for (; a[i - 1]; i++) {
        int *row = rows[i % 3];
        const int *above = rows[(i + 2) % 3];
        const int *two_above = rows[(i + 1) % 3];
        row[0] = i;
        for (int j = 1; j <= b_length; j++) {
            const int replaced = above[j - 1] + !same_letter(a[i - 1], b[j - 1]);
            row[j] = min3(above[j] + 1, row[j - 1] + 1, replaced);
            if (i > 1 && j > 1 && same_letter(a[i - 1], b[j - 2]) &&
                same_letter(a[i - 2], b[j - 1]) && two_above[j - 2] + 1 < row[j]) {
                row[j] = two_above[j - 2] + 1;
            }
        }
    }
    return rows[(i - 1) % 3][b_length];
}

const char *dip_config_nearest_key(const char *name) {
    const size_t length = strlen(name);
    if (length >= MAX_NAME) {
        return NULL;
    }
    // At this distance more than a third of the letters are wrong, so the name is another word.
    int nearest = 1 + (int)(length / 3 > 1 ? length / 3 : 1);
    const char *found = NULL;
    for (int k = 0; k < DIP_KEY_COUNT; k++) {
        // Each letter of the difference in length counts as wrong.
        if (abs((int)strlen(infos[k].name) - (int)length) < nearest) {
            const int distance = edit_distance(name, infos[k].name);
            found = distance < nearest ? infos[k].name : found;
            nearest = distance < nearest ? distance : nearest;
        }
    }
    return found;
}

void dip_config_describe(DipConfigKey key, char *buffer, size_t size_bytes) {
    const DipConfigKeyInfo *info = dip_config_key_info(key);
    switch (info->type) {
    case DIP_TYPE_SIZE:
        snprintf(buffer, size_bytes, "WIDTHxHEIGHT, %g..%g each", info->low, info->high);
        break;
    case DIP_TYPE_NUMBER:
        snprintf(buffer, size_bytes, "a number %g..%g", info->low, info->high);
        break;
    case DIP_TYPE_INTEGER:
        snprintf(buffer, size_bytes, "a whole number %g..%g", info->low, info->high);
        break;
    case DIP_TYPE_FLAG:
        snprintf(buffer, size_bytes, "true or false");
        break;
    case DIP_TYPE_FILE:
        snprintf(buffer, size_bytes, "a file");
        break;
    case DIP_TYPE_FILES:
        snprintf(buffer, size_bytes, "a file, up to %d times", DIP_CONFIG_MAX_MODELS);
        break;
    case DIP_TYPE_SETTINGS:
        snprintf(buffer, size_bytes, "settings such as aa=4,af=16");
        break;
    case DIP_TYPE_COLOR:
        snprintf(buffer, size_bytes, "R,G,B, %g..%g each", info->low, info->high);
        break;
    case DIP_TYPE_ISA:
        snprintf(buffer, size_bytes,
                 "auto"
#define ISA_NAME(name, NAME, lanes) " " #name
                 DIP_ISA_LIST(ISA_NAME)
#undef ISA_NAME
        );
        break;
    case DIP_TYPE_NAME:
        snprintf(buffer, size_bytes, "a name of at most %d bytes", DIP_CONFIG_MAX_NAME - 1);
        break;
    case DIP_TYPE_MATERIALS:
        snprintf(buffer, size_bytes, "a name with * and ?, up to %d times",
                 DIP_CONFIG_MAX_MATERIALS);
        break;
    case DIP_TYPE_LIGHTMAPS:
        snprintf(buffer, size_bytes, "a name with * and ?, or NAME = PICTURE, up to %d times",
                 DIP_CONFIG_MAX_MATERIALS);
        break;
    case DIP_TYPE_SHADING:
        snprintf(buffer, size_bytes, "auto flat gouraud phong");
        break;
    case DIP_TYPE_LIGHTS:
        snprintf(buffer, size_bytes, "a light such as point at=0,3,0 strength=4, up to %d times",
                 DIP_MAX_LIGHTS);
        break;
    case DIP_TYPE_SCALE:
        snprintf(buffer, size_bytes, "auto or a number %g..%g", info->low, info->high);
        break;
    }
}

// Returns the default of a key as the table in docs/config.md words it.
static const char *default_in_words(DipConfigKey key) {
    const DipConfigKeyInfo *info = dip_config_key_info(key);
    if (!info->fallback) {
        return "*required*";
    }
    if (info->fallback[0]) {
        return info->fallback;
    }
    if (info->type == DIP_TYPE_SETTINGS) {
        return "the default of each setting";
    }
    if (key == DIP_KEY_ANIMATION) {
        return "the first of each model";
    }
    if (key == DIP_KEY_CAMPATH_DEFAULT) {
        return "an orbit";
    }
    return strncmp(info->name, "CAMPATH_", 8) == 0 ? "`CAMPATH_DEFAULT`" : "none";
}

size_t dip_config_document_key(DipConfigKey key, char *buffer, size_t size_bytes) {
    DIP_FP_MODE_SCOPE();
    const DipConfigKeyInfo *info = dip_config_key_info(key);
    char accepted[128];
    dip_config_describe(key, accepted, sizeof accepted);
    const int length = snprintf(buffer, size_bytes, "| `%s` | %s | %s | %s |", info->name, accepted,
                                default_in_words(key), info->text);
    return (size_t)length;
}
