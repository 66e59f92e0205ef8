// The table of keys: look-up, the nearest name, and how each is described.
#include "config/config_private.h"

#include "renderer/base/assert.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

enum { MAX_NAME = 64 }; // longer names resemble no key

static const DipConfigKeyInfo infos[DIP_KEY_COUNT] = {
#define INFO_KEY(NAME, field, TYPE, fallback, low, high, text)                                     \
    {#NAME, DIP_TYPE_##TYPE, fallback, low, high, text, offsetof(DipConfig, field)},
#define INFO_CAMERA(NAME, fallback, text)                                                          \
    {"CAMPATH_" #NAME,                                                                             \
     DIP_TYPE_FILE,                                                                                \
     fallback,                                                                                     \
     0,                                                                                            \
     0,                                                                                            \
     "camera path " text,                                                                          \
     offsetof(DipConfig, camera[DIP_CATEGORY_##NAME].file)},                                       \
        {"CAMPATH_" #NAME "_FOV",                                                                  \
         DIP_TYPE_NUMBER,                                                                          \
         fallback,                                                                                 \
         1,                                                                                        \
         170,                                                                                      \
         "its vertical field of view, degrees",                                                    \
         offsetof(DipConfig, camera[DIP_CATEGORY_##NAME].fov_y_deg)},
#define INFO_PICTURE(NAME, size, text)                                                             \
    {#NAME,                                                                                        \
     DIP_TYPE_FILE,                                                                                \
     "",                                                                                           \
     0,                                                                                            \
     0,                                                                                            \
     "mip-debug picture for level size " text,                                                     \
     offsetof(DipConfig, mip_picture[DIP_MIP_LEVEL_##size])},
    DIP_CONFIG_LIST(INFO_KEY, INFO_CAMERA, INFO_PICTURE)};

const DipConfigKeyInfo *dip_config_key_info(DipConfigKey key) {
    DIP_ASSERT(key < DIP_KEY_COUNT);
    return &infos[key];
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

// Levenshtein's distance, without regard to case. Both shorter than MAX_NAME.
static int edit_distance(const char *a, const char *b) {
    const int b_length = (int)strlen(b);
    int row[MAX_NAME];
    for (int j = 0; j <= b_length; j++) {
        row[j] = j;
    }
    for (int i = 1; a[i - 1]; i++) {
        int diagonal = row[0];
        row[0] = i;
        for (int j = 1; j <= b_length; j++) {
            const bool same = toupper((unsigned char)a[i - 1]) == toupper((unsigned char)b[j - 1]);
            const int cost = min3(row[j] + 1, row[j - 1] + 1, diagonal + !same);
            diagonal = row[j];
            row[j] = cost;
        }
    }
    return row[b_length];
}

const char *dip_config_nearest_key(const char *name) {
    const size_t length = strlen(name);
    if (length >= MAX_NAME) {
        return NULL;
    }
    // A third of the letters wrong, or two of a short name, and it is another word.
    int nearest = 1 + (int)(length / 3 > 2 ? length / 3 : 2);
    const char *found = NULL;
    for (int k = 0; k < DIP_KEY_COUNT; k++) {
        const int distance = edit_distance(name, infos[k].name);
        if (distance < nearest) {
            nearest = distance;
            found = infos[k].name;
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
    }
}

size_t dip_config_document_key(DipConfigKey key, char *buffer, size_t size_bytes) {
    const DipConfigKeyInfo *info = dip_config_key_info(key);
    char accepted[128];
    dip_config_describe(key, accepted, sizeof accepted);
    const char *fallback = info->fallback ? info->fallback : "*required*";
    if (info->fallback && !info->fallback[0]) {
        fallback = info->type == DIP_TYPE_SETTINGS ? "each setting's own" : "none";
    }
    const int length = snprintf(buffer, size_bytes, "| `%s` | %s | %s | %s |", info->name, accepted,
                                fallback, info->text);
    return (size_t)length;
}
