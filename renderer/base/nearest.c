// Levenshtein distance, computed row by row.
#include "renderer/base/nearest.h"

#include <ctype.h>
#include <string.h>

enum { MAX_LENGTH = 63 }; // Letters of a known name that are compared; later ones are ignored.

static size_t distance(const char *a, const char *b) {
    size_t row[MAX_LENGTH + 1];
    const size_t length = strlen(b) < MAX_LENGTH ? strlen(b) : MAX_LENGTH;
    for (size_t j = 0; j <= length; j++) {
        row[j] = j;
    }
    for (size_t i = 0; a[i]; i++) {
        size_t diagonal = row[0];
        row[0] = i + 1;
        for (size_t j = 1; j <= length; j++) {
            const int same = tolower((unsigned char)a[i]) == tolower((unsigned char)b[j - 1]);
            size_t best = diagonal + (same ? 0 : 1);
            best = row[j] + 1 < best ? row[j] + 1 : best;
            best = row[j - 1] + 1 < best ? row[j - 1] + 1 : best;
            diagonal = row[j];
            row[j] = best;
        }
    }
    return row[length];
}

const char *dip_nearest_name(const char *name, const char *const *names, size_t count) {
    size_t nearest = 0;
    for (size_t i = 1; i < count; i++) {
        if (distance(name, names[i]) < distance(name, names[nearest])) {
            nearest = i;
        }
    }
    return names[nearest];
}

const char *dip_nearest_likely(const char *name, const char *const *names, size_t count) {
    const char *nearest = count ? dip_nearest_name(name, names, count) : NULL;
    const size_t allowed = nearest && strlen(nearest) > 3 ? strlen(nearest) / 3 : 1;
    return nearest && distance(name, nearest) <= allowed ? nearest : NULL;
}
