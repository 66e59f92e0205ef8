// Reads and writes the cache of truths.
#include "app/measure/metrics/internal/truth_cache.h"

#include "app/files/whole_file.h"
#include "renderer/base/file.h"
#include "renderer/base/hash.h"

#include <dirent.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// Hashes everything that the truth depends on, including a version number of the code that makes
// it.
void dip_truth_find_key(const DipTruthDef *def, char key[33]) {
    DipHash hash = dip_hash_begin(0);
    dip_hash_text(&hash, "diptych truth 1");
    dip_hash_text(&hash, def->scene_hash);
    for (int i = 0; i < 3; i++) {
        dip_hash_number(&hash, def->pose.position_world[i]);
    }
    for (int i = 0; i < 4; i++) {
        dip_hash_number(&hash, def->pose.orientation[i]);
    }
    dip_hash_number(&hash, def->pose.fov_y_deg);
    dip_hash_integer(&hash, def->time_ns);
    dip_hash_integer(&hash, def->width);
    dip_hash_integer(&hash, def->height);
    dip_hash_integer(&hash, def->samples);
    dip_hash_number(&hash, def->pixels_per_degree); // the noise floor's FLIP depends on this number
    dip_hash_hex(&hash, key);
}

bool dip_truth_default_folder(char *folder, size_t size_bytes) {
    const char *cache = getenv("XDG_CACHE_HOME");
    const char *home = getenv("HOME");
    const bool has_cache = cache && *cache;
    if (!has_cache && !(home && *home)) {
        return false;
    }
    const int length = snprintf(folder, size_bytes, "%s%s/diptych", has_cache ? cache : home,
                                has_cache ? "" : "/.cache");
    return length > 0 && (size_t)length < size_bytes;
}

// A file holds the truth's arrays one after the other, as they lie in memory, and then 32 digits of
// their hash. Byte order and layout are those of the machine that wrote the file.
static size_t file_size(const DipTruth *truth) {
    const size_t pixels = (size_t)truth->width * (size_t)truth->height;
    return pixels * (3 * sizeof(float) + 4 + 1) + sizeof(DipMetricSums) + 32;
}

static bool file_name(const DipTruth *truth, const char *cache, char file[PATH_MAX]) {
    const int length = snprintf(file, PATH_MAX, "%s/truth-%s.bin", cache, truth->key);
    return length > 0 && length < PATH_MAX;
}

typedef struct Part {
    void *bytes;
    size_t size;
} Part;

enum { PARTS = 4 };

static void list_parts(DipTruth *truth, Part parts[PARTS]) {
    const size_t pixels = (size_t)truth->width * (size_t)truth->height;
    parts[0] = (Part){truth->rgb_lin, pixels * 3 * sizeof(float)};
    parts[1] = (Part){truth->rgba8, pixels * 4};
    parts[2] = (Part){truth->classes, pixels};
    parts[3] = (Part){&truth->floor, sizeof truth->floor};
}

static void hash_contents(const unsigned char *bytes, size_t size, char hex[33]) {
    DipHash hash = dip_hash_begin(0);
    dip_hash_bytes(&hash, bytes, size);
    dip_hash_hex(&hash, hex);
}

bool dip_truth_load(DipTruth *truth, const char *cache) {
    char name[PATH_MAX];
    unsigned char *bytes;
    size_t size;
    if (!file_name(truth, cache, name) ||
        !dip_file_read(name, "truth", file_size(truth), &bytes, &size, NULL)) {
        return false;
    }
    bool loaded = size == file_size(truth);
    if (loaded) {
        char hex[33];
        hash_contents(bytes, size - 32, hex);
        loaded = memcmp(hex, bytes + size - 32, 32) == 0;
    }
    Part parts[PARTS];
    list_parts(truth, parts);
    for (size_t p = 0, at = 0; loaded && p < PARTS; at += parts[p++].size) {
        memcpy(parts[p].bytes, bytes + at, parts[p].size);
    }
    free(bytes);
    return loaded;
}

bool dip_truth_store(DipTruth *truth, const char *cache, DipError *err) {
    char name[PATH_MAX];
    const size_t size = file_size(truth);
    unsigned char *bytes = malloc(size);
    if (!bytes) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "truth", "out of memory");
    }
    Part parts[PARTS];
    list_parts(truth, parts);
    for (size_t p = 0, at = 0; p < PARTS; at += parts[p++].size) {
        memcpy(bytes + at, parts[p].bytes, parts[p].size);
    }
    char hex[33];
    hash_contents(bytes, size - 32, hex);
    memcpy(bytes + size - 32, hex, 32);
    const bool stored = (file_name(truth, cache, name) ||
                         dip_error_set_runtime(err, DIP_ERROR_OVERSIZED, cache, 0, "--cache",
                                               "the name is too long")) &&
                        dip_whole_file_write(name, bytes, size, err);
    free(bytes);
    return stored;
}

int64_t dip_truth_cache_bytes(const char *cache) {
    DIR *folder = opendir(cache);
    int64_t bytes = 0;
    for (const struct dirent *entry; folder && (entry = readdir(folder));) {
        char name[PATH_MAX];
        struct stat status;
        const int length = snprintf(name, sizeof name, "%s/%s", cache, entry->d_name);
        if (strncmp(entry->d_name, "truth-", 6) == 0 && length < PATH_MAX &&
            stat(name, &status) == 0) {
            bytes += status.st_size;
        }
    }
    if (folder) {
        closedir(folder);
    }
    return bytes;
}
