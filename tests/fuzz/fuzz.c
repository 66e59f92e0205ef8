// Files and checks that the fuzzers share.
#include "tests/fuzz/fuzz.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[512]; // Empty until the first call of fuzz_path.

void fuzz_broken_promise(const char *promise, const char *file, int line) {
    fprintf(stderr, "%s:%d: broken promise: %s\n", file, line, promise);
    abort();
}

static void remove_folder(void) {
    char path[1024];
    DIR *listing = opendir(folder);
    for (struct dirent *entry = listing ? readdir(listing) : NULL; entry;
         entry = readdir(listing)) {
        if (entry->d_name[0] != '.') {
            snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
            remove(path);
        }
    }
    if (listing) {
        closedir(listing);
    }
    rmdir(folder);
}

const char *fuzz_path(const char *name) {
    static char paths[4][1024];
    static unsigned next;
    if (!folder[0]) {
        const char *parent = getenv("TMPDIR");
        snprintf(folder, sizeof folder, "%s/diptych-fuzz.XXXXXX", parent ? parent : "/tmp");
        FUZZ_CHECK(mkdtemp(folder) != NULL);
        atexit(remove_folder);
    }
    char *path = paths[next++ % 4];
    snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}

const char *fuzz_write(const char *name, const void *bytes, size_t size_bytes) {
    const char *path = fuzz_path(name);
    FILE *file = fopen(path, "wb");
    FUZZ_CHECK(file != NULL);
    FUZZ_CHECK(fwrite(bytes, 1, size_bytes, file) == size_bytes);
    FUZZ_CHECK(fclose(file) == 0);
    return path;
}

uint8_t *fuzz_copy(const void *bytes, size_t size_bytes, bool ended) {
    uint8_t *copy = malloc(size_bytes + ended + (size_bytes + ended == 0));
    FUZZ_CHECK(copy != NULL);
    memcpy(copy, bytes, size_bytes);
    if (ended) {
        copy[size_bytes] = '\0';
    }
    return copy;
}

bool fuzz_same_number(double a, double b) {
    return a == b || (isnan(a) && isnan(b));
}
