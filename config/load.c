// Loading: inih's key and value pairs into the struct, then what concerns several keys.
#include "config/config_private.h"

#include <errno.h>
#include <ini.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Loader {
    DipConfigReader reader;
    DipConfig *config;
    bool failed[DIP_KEY_COUNT]; // given, but with a bad value: not missing
} Loader;

static void add(Loader *loader, DipErrorCode code, int line, DipConfigKey key,
                const char *message) {
    dip_config_add_fault(&loader->reader, code, DIP_SEVERITY_ERROR, line, dip_config_key_name(key),
                         "%s", message);
}

static void refuse_name(Loader *loader, const char *name) {
    const int line = loader->reader.line;
    const char *nearest = dip_config_nearest_key(name);
    if (!name[0]) {
        dip_config_add_fault(&loader->reader, DIP_ERROR_FORMAT, DIP_SEVERITY_ERROR, line, NULL,
                             "no key before the value, accepted KEY: value");
    } else if (nearest) {
        dip_config_add_fault(&loader->reader, DIP_ERROR_UNKNOWN, DIP_SEVERITY_ERROR, line, name,
                             "no such key, accepted is the similar %s", nearest);
    } else {
        dip_config_add_fault(&loader->reader, DIP_ERROR_UNKNOWN, DIP_SEVERITY_ERROR, line, name,
                             "no such key, accepted are those in docs/config.md");
    }
}

static void warn_if_repeated(Loader *loader, DipConfigKey key) {
    const int before = loader->config->line[key];
    if (before && dip_config_key_info(key)->type != DIP_TYPE_FILES) {
        dip_config_add_fault(&loader->reader, DIP_ERROR_CONFLICT, DIP_SEVERITY_WARNING,
                             loader->reader.line, dip_config_key_name(key),
                             "given in line %d already, accepted is this later value", before);
    }
}

// The ini_handler. Always 1: faults are collected here, with their lines, not by inih.
static int handle(void *context, const char *section, const char *name, const char *value) {
    (void)section; // the reader lets none through
    Loader *loader = context;
    DipConfigKey key;
    if (!dip_config_find_key(name, &key)) {
        refuse_name(loader, name);
        return 1;
    }
    const int line = loader->reader.line;
    warn_if_repeated(loader, key);
    loader->config->line[key] = line;
    DipError err;
    if (!value[0]) {
        char accepted[128];
        dip_config_describe(key, accepted, sizeof accepted);
        dip_config_add_fault(&loader->reader, DIP_ERROR_MISSING, DIP_SEVERITY_ERROR, line, name,
                             "no value, accepted %s", accepted);
        loader->failed[key] = true;
    } else if (!dip_config_set_value(loader->config, key, value, line, &err)) {
        dip_config_add_fault(&loader->reader, err.code, DIP_SEVERITY_ERROR, line, name, "%s",
                             err.message);
        loader->failed[key] = true;
    }
    return 1;
}

// ---- What concerns several keys ----

static DipConfigKey path_key(int category) {
    static const DipConfigKey keys[] = {
#define PATH_KEY(NAME, fallback, text) DIP_KEY_CAMPATH_##NAME,
        DIP_CONFIG_LIST(DIP_CONFIG_NONE, PATH_KEY, DIP_CONFIG_NONE)
#undef PATH_KEY
    };
    return keys[category];
}

static DipConfigKey fov_key(int category) {
    return (DipConfigKey)(path_key(category) + 1); // the list gives them side by side
}

static bool is_fov_key(int key) {
    for (int c = 0; c < DIP_CATEGORY_COUNT; c++) {
        if ((int)fov_key(c) == key) {
            return true;
        }
    }
    return false;
}

static const char *skip_idle(const char *at) {
    while ((at[0] == '.' && at[1] == '/') || at[0] == '/') {
        at += at[0] == '.' ? 2 : 1;
    }
    return at;
}

// Component by component, past "./" and doubled slashes. ".." stays: what it means is up to links.
bool dip_config_same_file(const DipConfigFile *a, const DipConfigFile *b) {
    if (!a->path || !b->path || (a->path[0] == '/') != (b->path[0] == '/')) {
        return false;
    }
    const char *p = skip_idle(a->path);
    const char *q = skip_idle(b->path);
    while (*p && *p == *q) {
        const bool at_slash = *p == '/';
        p++;
        q++;
        if (at_slash) {
            p = skip_idle(p);
            q = skip_idle(q);
        }
    }
    return *p == *q;
}

static bool has_fov(const Loader *loader, int category) {
    return loader->config->line[fov_key(category)] && !loader->failed[fov_key(category)];
}

static void require_keys(Loader *loader) {
    for (int k = 0; k < DIP_KEY_COUNT; k++) {
        const DipConfigKeyInfo *info = dip_config_key_info((DipConfigKey)k);
        if (loader->config->line[k] || is_fov_key(k)) {
            continue;
        }
        DipError err;
        if (!info->fallback) {
            char accepted[128];
            dip_config_describe((DipConfigKey)k, accepted, sizeof accepted);
            dip_config_add_fault(&loader->reader, DIP_ERROR_MISSING, DIP_SEVERITY_ERROR, 0,
                                 info->name, "missing, accepted %s: %s", accepted, info->text);
        } else if (info->type != DIP_TYPE_FILE &&
                   !dip_config_set_value(loader->config, (DipConfigKey)k, info->fallback, 0,
                                         &err)) {
            add(loader, err.code, 0, (DipConfigKey)k, err.message);
        }
    }
}

// Figure 12 gives CAMPATH_AAA_FOV twice and CAMPATH_AAF_FOV not at all; a path that another
// category flies too has that category's field of view.
static void borrow_fov(Loader *loader, int category) {
    DipConfig *config = loader->config;
    DipConfigCamera *camera = &config->camera[category];
    for (int other = 0; other < DIP_CATEGORY_COUNT; other++) {
        if (has_fov(loader, other) &&
            dip_config_same_file(&config->camera[other].file, &camera->file)) {
            camera->fov_y_deg = config->camera[other].fov_y_deg;
            return;
        }
    }
    add(loader, DIP_ERROR_MISSING, 0, fov_key(category),
        "missing, accepted a number 1..170, or another category with the same path file");
}

// Against the first category with the same path, so that one odd value is one fault.
static void compare_fov(Loader *loader, int category) {
    DipConfig *config = loader->config;
    const DipConfigCamera *camera = &config->camera[category];
    for (int first = 0; first < category; first++) {
        if (!has_fov(loader, first) ||
            !dip_config_same_file(&config->camera[first].file, &camera->file)) {
            continue;
        }
        if (config->camera[first].fov_y_deg != camera->fov_y_deg) {
            dip_config_add_fault(
                &loader->reader, DIP_ERROR_CONFLICT, DIP_SEVERITY_ERROR,
                config->line[fov_key(category)], dip_config_key_name(fov_key(category)),
                "%g, but %s in line %d is %g for the same path '%s', accepted one value",
                camera->fov_y_deg, dip_config_key_name(fov_key(first)),
                config->line[fov_key(first)], config->camera[first].fov_y_deg, camera->file.text);
        }
        return;
    }
}

static void settle_cameras(Loader *loader) {
    DipConfig *config = loader->config;
    for (int c = 0; c < DIP_CATEGORY_COUNT; c++) {
        const bool has_path = config->camera[c].file.path != NULL;
        const int fov_line = config->line[fov_key(c)];
        if (has_fov(loader, c) && has_path) {
            compare_fov(loader, c);
        } else if (has_path && !fov_line) {
            borrow_fov(loader, c);
        } else if (!has_path && fov_line && !config->line[path_key(c)] &&
                   dip_config_key_info(path_key(c))->fallback) {
            add(loader, DIP_ERROR_MISSING, fov_line, path_key(c),
                "missing beside its field of view, accepted a file");
        } else if (!has_path && !fov_line && !dip_config_key_info(fov_key(c))->fallback) {
            add(loader, DIP_ERROR_MISSING, 0, fov_key(c), "missing, accepted a number 1..170");
        }
    }
}

static void compare_sky(Loader *loader) {
    const DipConfig *config = loader->config;
    if (loader->failed[DIP_KEY_SKY_CLEAR] || loader->failed[DIP_KEY_SKY_DENSE] ||
        config->sky_dense > config->sky_clear) {
        return;
    }
    const DipConfigKey key =
        config->line[DIP_KEY_SKY_DENSE] ? DIP_KEY_SKY_DENSE : DIP_KEY_SKY_CLEAR;
    dip_config_add_fault(&loader->reader, DIP_ERROR_CONFLICT, DIP_SEVERITY_ERROR, config->line[key],
                         dip_config_key_name(key),
                         "SKY_DENSE is %g and SKY_CLEAR %g, accepted the former greater",
                         config->sky_dense, config->sky_clear);
}

static bool read_file(Loader *loader) {
    DipConfigReader *reader = &loader->reader;
    reader->stream = fopen(reader->file, "rb");
    if (!reader->stream) {
        dip_config_add_fault(reader, DIP_ERROR_IO, DIP_SEVERITY_ERROR, 0, NULL,
                             "cannot be opened (%s), accepted an ini file", strerror(errno));
        return false;
    }
    const int result = ini_parse_stream(dip_config_read_line, reader, handle, loader);
    const bool is_broken = ferror(reader->stream) != 0;
    fclose(reader->stream);
    if (is_broken) {
        dip_config_add_fault(reader, DIP_ERROR_IO, DIP_SEVERITY_ERROR, 0, NULL,
                             "cannot be read, accepted an ini file");
    } else if (result != 0) {
        // Lines come clean and the handler never objects, so only memory is left.
        dip_config_add_fault(reader, DIP_ERROR_MEMORY, DIP_SEVERITY_ERROR, 0, NULL,
                             "no memory to read it");
    }
    // What stands below a stop would only seem to be missing.
    return !is_broken && result == 0 && !reader->stopped;
}

bool dip_config_load(const char *file, DipConfig *config, DipErrorList *faults) {
    const size_t errors_before = faults->error_count;
    *config = (DipConfig){0};
    Loader loader = {.reader = {.file = file, .faults = faults}, .config = config};
    config->file = malloc(strlen(file) + 1);
    if (!config->file) {
        dip_config_add_fault(&loader.reader, DIP_ERROR_MEMORY, DIP_SEVERITY_ERROR, 0, NULL,
                             "no memory to read it");
        return false;
    }
    strcpy(config->file, file);
    if (read_file(&loader)) {
        require_keys(&loader);
        settle_cameras(&loader);
        compare_sky(&loader);
    }
    if (faults->error_count == errors_before) {
        return true;
    }
    dip_config_free(config);
    return false;
}

bool dip_config_file_fault(const DipConfig *config, const DipConfigFile *file, DipErrorCode code,
                           DipError *err, const char *format, ...) {
    char message[sizeof err->message];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    return dip_error_set(err, code, config->file, file->line, dip_config_key_name(file->key), "%s",
                         message);
}
