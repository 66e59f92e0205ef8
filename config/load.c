// Loads an ini: reads the key and value pairs that inih finds, then fills in defaults and checks
// values that depend on each other.
#include "config/config_private.h"
#include "renderer/base/file.h"
#include "renderer/base/fp_mode.h"

#include <errno.h>
#include <ini.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Loader {
    DipConfigReader reader;
    DipConfig *config;
    bool failed[DIP_KEY_COUNT]; // true: the ini gives the key, but with a bad value
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
                             "there is no key before the value, accepted KEY: value");
    } else if (nearest) {
        dip_config_add_fault(&loader->reader, DIP_ERROR_UNKNOWN, DIP_SEVERITY_ERROR, line, name,
                             "there is no such key, did you mean %s?", nearest);
    } else {
        dip_config_add_fault(&loader->reader, DIP_ERROR_UNKNOWN, DIP_SEVERITY_ERROR, line, name,
                             "there is no such key, accepted are the keys in docs/config.md");
    }
}

static void warn_if_repeated(Loader *loader, DipConfigKey key) {
    const int before = loader->config->line[key];
    if (before && !dip_config_may_repeat(dip_config_key_info(key)->type)) {
        dip_config_add_fault(&loader->reader, DIP_ERROR_CONFLICT, DIP_SEVERITY_WARNING,
                             loader->reader.line, dip_config_key_name(key),
                             "line %d gives this key too; this later value is accepted", before);
    }
}

// The ini_handler callback of inih. Returns 1 (success) in any case, because this file collects the
// faults and knows their lines.
static int handle(void *context, const char *section, const char *name, const char *value) {
    (void)section; // The reader refuses sections.
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
                             "has no value, accepted %s", accepted);
        loader->failed[key] = true;
    } else if (!dip_config_set_value(loader->config, key, value, line, &err)) {
        dip_config_add_fault(&loader->reader, err.code, DIP_SEVERITY_ERROR, line, name, "%s",
                             err.message);
        loader->failed[key] = true;
    }
    return 1;
}

// ---- Checks of several keys ----

static DipConfigKey path_key(int category) {
    static const DipConfigKey keys[] = {
#define PATH_KEY(NAME, fov, text) DIP_KEY_CAMPATH_##NAME,
        DIP_CONFIG_LIST(DIP_CONFIG_NONE, PATH_KEY, DIP_CONFIG_NONE)
#undef PATH_KEY
    };
    return keys[category];
}

static DipConfigKey fov_key(int category) {
    return (DipConfigKey)(path_key(category) + 1); // CAMPATH_X_FOV follows CAMPATH_X in the enum
}

static bool is_fov_key(int key) {
    for (int c = 0; c < DIP_CATEGORY_COUNT; c++) {
        if ((int)fov_key(c) == key) {
            return true;
        }
    }
    return false;
}

// Skips "./" and repeated slashes, which do not change what a path names.
static const char *skip_idle(const char *at) {
    while ((at[0] == '.' && at[1] == '/') || at[0] == '/') {
        at += at[0] == '.' ? 2 : 1;
    }
    return at;
}

// Compares the paths component by component. ".." is compared as text, because only the file system
// knows where it leads through symbolic links.
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

// Sets a key that the ini leaves out to its default, or reports that it is missing.
static void set_default(Loader *loader, DipConfigKey key) {
    const DipConfigKeyInfo *info = dip_config_key_info(key);
    DipError err;
    if (!info->fallback) {
        char accepted[128];
        dip_config_describe(key, accepted, sizeof accepted);
        dip_config_add_fault(&loader->reader, DIP_ERROR_MISSING, DIP_SEVERITY_ERROR, 0, info->name,
                             "is missing (%s), accepted %s", info->text, accepted);
        return;
    }
    const bool has_value = info->fallback[0] || info->type == DIP_TYPE_SETTINGS;
    if (has_value && !dip_config_set_value(loader->config, key, info->fallback, 0, &err)) {
        add(loader, err.code, 0, key, err.message);
    }
}

static void set_defaults(Loader *loader) {
    for (int k = 0; k < DIP_KEY_COUNT; k++) {
        if (!loader->config->line[k] && !is_fov_key(k)) {
            set_default(loader, (DipConfigKey)k);
        }
    }
}

// A category without a field of view takes the field of view of a category with the same path. If
// there is none, it takes the default. The ini of the 2006 ATI Catalyst Control Preview report, its
// Figure 12, relies on this: it gives CAMPATH_AAA_FOV twice and CAMPATH_AAF_FOV not at all.
static void settle_fov(Loader *loader, int category) {
    DipConfig *config = loader->config;
    DipConfigCamera *camera = &config->camera[category];
    for (int other = 0; other < DIP_CATEGORY_COUNT; other++) {
        if (has_fov(loader, other) &&
            dip_config_same_file(&config->camera[other].file, &camera->file)) {
            camera->fov_y_deg = config->camera[other].fov_y_deg;
            return;
        }
    }
    set_default(loader, fov_key(category));
}

// Compares a category only with the first category that has the same path, so that one odd value
// causes only one fault.
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
                "is %g, but %s in line %d is %g for the same path '%s', accepted one value",
                camera->fov_y_deg, dip_config_key_name(fov_key(first)),
                config->line[fov_key(first)], config->camera[first].fov_y_deg, camera->file.text);
        }
        return;
    }
}

// CAMPATH_DEFAULT_FOV may be given without CAMPATH_DEFAULT. It also applies to the orbit that
// replaces a missing path, and to a path that the command line names.
static void settle_cameras(Loader *loader) {
    DipConfig *config = loader->config;
    for (int c = 0; c < DIP_CATEGORY_COUNT; c++) {
        const bool has_path = config->camera[c].file.path != NULL;
        const int fov_line = config->line[fov_key(c)];
        if (has_fov(loader, c) && has_path) {
            compare_fov(loader, c);
        } else if ((has_path || c == DIP_CATEGORY_DEFAULT) && !fov_line) {
            settle_fov(loader, c);
        } else if (!has_path && fov_line && !config->line[path_key(c)] &&
                   c != DIP_CATEGORY_DEFAULT) {
            add(loader, DIP_ERROR_MISSING, fov_line, path_key(c),
                "is missing, but its field of view is given, accepted a file");
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
                         "SKY_DENSE is %g and SKY_CLEAR %g, accepted a SKY_DENSE above SKY_CLEAR",
                         config->sky_dense, config->sky_clear);
}

static bool read_file(Loader *loader) {
    DipConfigReader *reader = &loader->reader;
    reader->stream = fopen(reader->file, "rb");
    if (!reader->stream) {
        const bool is_machine = dip_file_open_code(errno) == DIP_ERROR_RUNTIME;
        dip_config_add_fault(reader, is_machine ? DIP_ERROR_RUNTIME : DIP_ERROR_IO,
                             DIP_SEVERITY_ERROR, 0, NULL,
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
        // The lines are clean and the handler always succeeds, so inih must be out of memory.
        dip_config_add_fault(reader, DIP_ERROR_MEMORY, DIP_SEVERITY_ERROR, 0, NULL,
                             "is not read: out of memory");
    }
    // If reading stopped early, keys further down would be reported as missing although the file
    // gives them.
    return !is_broken && result == 0 && !reader->stopped;
}

bool dip_config_load(const char *file, DipConfig *config, DipErrorList *faults) {
    DIP_FP_MODE_SCOPE();
    const size_t errors_before = faults->error_count;
    *config = (DipConfig){0};
    Loader loader = {.reader = {.file = file, .faults = faults}, .config = config};
    config->file = malloc(strlen(file) + 1);
    if (!config->file) {
        dip_config_add_fault(&loader.reader, DIP_ERROR_MEMORY, DIP_SEVERITY_ERROR, 0, NULL,
                             "is not read: out of memory");
        return false;
    }
    strcpy(config->file, file);
    if (read_file(&loader)) {
        set_defaults(&loader);
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
