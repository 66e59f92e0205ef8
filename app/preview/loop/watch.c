// Detects changes of files by comparing stamps, which are computed from names, times, sizes and
// inodes.
#include "app/preview/loop/watch.h"

#include "app/files/whole_file.h"
#include "renderer/base/assert.h"
#include "renderer/base/hash.h"

#include <dirent.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

static const int64_t period_ns = 250000000;
enum {
    RESTING_POLLS = 2,  // Polls without a change after which the files count as at rest.
    MAX_ENTRIES = 2048, // Greatest number of names in a folder that are looked at.
    MAX_DEPTH = 1       // Levels of subfolders that are looked at.
};

// The state of a file or of the files in a folder.
typedef struct Stamp {
    uint64_t hash; // Hash of names, times, sizes and inodes, independent of the files' order.
    int count;     // Number of files.
    int64_t newest_ns;
    char newest[DIP_WATCH_NAME_SIZE]; // Name of the file that was written last.
} Stamp;

typedef struct Entry {
    char *file; // Path of a file, or of a folder without a final slash (except "/").
    bool folder;
    bool listed; // The entry is in the new list (dip_watch_begin_list).
    Stamp stamp;
} Entry;

struct DipWatch {
    Entry *entries;
    int count;
    int64_t next_ns;                // When to look again.
    bool changed;                   // Something has changed and was not reported yet.
    int resting;                    // Polls since the last change.
    char name[DIP_WATCH_NAME_SIZE]; // The name that dip_watch_poll reports.
};

DipWatch *dip_watch_create(void) {
    return calloc(1, sizeof(DipWatch));
}

void dip_watch_destroy(DipWatch **watch_pointer) {
    DipWatch *watch = *watch_pointer;
    if (!watch) {
        return;
    }
    *watch_pointer = NULL;
    for (int i = 0; i < watch->count; ++i) {
        free(watch->entries[i].file);
    }
    free(watch->entries);
    free(watch);
}

// --- stamps --------------------------------------------------------------------------------------

static void add_file(Stamp *stamp, const char *name, const struct stat *status) {
    const int64_t time_ns =
        (int64_t)status->st_mtim.tv_sec * INT64_C(1000000000) + status->st_mtim.tv_nsec;
    DipHash hash = dip_hash_begin(0);
    dip_hash_text(&hash, name);
    dip_hash_integer(&hash, time_ns);
    dip_hash_integer(&hash, status->st_size);
    dip_hash_integer(&hash, (int64_t)status->st_ino);
    stamp->hash += hash.lanes[0]; // A sum is the same in any order.
    ++stamp->count;
    if (stamp->count == 1 || time_ns > stamp->newest_ns) {
        stamp->newest_ns = time_ns;
        snprintf(stamp->newest, sizeof stamp->newest, "%.255s", name);
    }
}

static bool is_part_of_model(const char *name) {
    static const char *const endings[] = {
        ".gltf", ".glb", ".bin", ".obj", ".mtl", ".x",    ".ply", ".stl",  ".dae", ".fbx",
        ".3ds",  ".md2", ".off", ".png", ".jpg", ".jpeg", ".tga", ".bmp",  ".dds", ".pcx",
        ".ppm",  ".pgm", ".hdr", ".gif", ".psd", ".pnm",  ".dxf", ".blend"};
    const char *ending = strrchr(name, '.');
    const bool screenshot = strncmp(name, "diptych-", 8) == 0;
    for (size_t i = 0; ending && !screenshot && i < DIP_ARRAY_COUNT(endings); ++i) {
        if (strcasecmp(ending, endings[i]) == 0) {
            return true;
        }
    }
    return false;
}

static void add_folder(Stamp *stamp, const char *folder, int depth) {
    DIR *listing = opendir(folder);
    if (!listing) {
        return;
    }
    const struct dirent *found;
    for (int i = 0; i < MAX_ENTRIES && (found = readdir(listing)); ++i) {
        char file[PATH_MAX];
        struct stat status;
        const int length = snprintf(file, sizeof file, "%s/%s", folder, found->d_name);
        if (found->d_name[0] == '.' || length >= (int)sizeof file || stat(file, &status) != 0) {
            continue; // Hidden names include "." and "..".
        }
        if (S_ISDIR(status.st_mode)) {
            if (depth < MAX_DEPTH) {
                add_folder(stamp, file, depth + 1);
            }
        } else if (is_part_of_model(found->d_name)) {
            add_file(stamp, found->d_name, &status);
        }
    }
    closedir(listing);
}

static void take_stamp(const Entry *entry, Stamp *stamp) {
    struct stat status;
    *stamp = (Stamp){.count = 0};
    if (entry->folder) {
        add_folder(stamp, entry->file, 0);
    } else if (stat(entry->file, &status) == 0) {
        add_file(stamp, dip_base_name(entry->file), &status);
    }
}

// --- the list ------------------------------------------------------------------------------------

void dip_watch_begin_list(DipWatch *watch) {
    for (int i = 0; i < watch->count; ++i) {
        watch->entries[i].listed = false;
    }
}

void dip_watch_end_list(DipWatch *watch) {
    int kept = 0;
    for (int i = 0; i < watch->count; ++i) {
        if (watch->entries[i].listed) {
            watch->entries[kept++] = watch->entries[i];
        } else {
            free(watch->entries[i].file);
        }
    }
    watch->count = kept;
}

// Adds an entry to the list, or marks a known one as listed. Takes ownership of `file`, which is
// NULL if memory has run out.
static void add_entry(DipWatch *watch, char *file, bool folder) {
    for (int i = 0; file && i < watch->count; ++i) {
        Entry *known = &watch->entries[i];
        if (known->folder == folder && strcmp(known->file, file) == 0) {
            known->listed = true;
            free(file);
            return;
        }
    }
    Entry *grown =
        file ? realloc(watch->entries, ((size_t)watch->count + 1) * sizeof *grown) : NULL;
    if (!grown) {
        free(file);
        return;
    }
    watch->entries = grown;
    Entry *entry = &watch->entries[watch->count++];
    *entry = (Entry){.file = file, .folder = folder, .listed = true};
    take_stamp(entry, &entry->stamp);
}

void dip_watch_file(DipWatch *watch, const char *file) {
    add_entry(watch, strdup(file), false);
}

void dip_watch_folder(DipWatch *watch, const char *file) {
    // Length of the folder's path with its slash; 0 without a folder.
    const size_t length = (size_t)(dip_base_name(file) - file);
    add_entry(watch, length == 0 ? strdup(".") : strndup(file, length > 1 ? length - 1 : 1), true);
}

// --- looking -------------------------------------------------------------------------------------

// Returns whether an entry has changed since the last look.
static bool look(DipWatch *watch, Entry *entry) {
    Stamp now;
    take_stamp(entry, &now);
    const Stamp before = entry->stamp;
    if (now.hash == before.hash && now.count == before.count) {
        return false;
    }
    const bool only_removed =
        now.count < before.count && (now.count == 0 || now.newest_ns <= before.newest_ns);
    snprintf(watch->name, sizeof watch->name, "%s", only_removed ? "" : now.newest);
    entry->stamp = now;
    return true;
}

bool dip_watch_poll(DipWatch *watch, int64_t now_ns, char name[DIP_WATCH_NAME_SIZE]) {
    bool changed = false;
    if (now_ns < watch->next_ns) {
        return false;
    }
    watch->next_ns = now_ns + period_ns;
    for (int i = 0; i < watch->count; ++i) {
        changed = look(watch, &watch->entries[i]) || changed;
    }
    watch->changed = watch->changed || changed;
    watch->resting = changed ? 0 : watch->resting + 1;
    if (!watch->changed || watch->resting < RESTING_POLLS) {
        return false;
    }
    watch->changed = false;
    memcpy(name, watch->name, sizeof watch->name);
    return true;
}
