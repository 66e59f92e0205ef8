// Checks of model files before assimp sees them: what would make it run out of stack or time.
#include "assets/model_parts.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum {
    MAX_JSON_DEPTH = 512,
    // Each node with children has a list, so this bounds how deep nodes nest; assimp spends some
    // 600 bytes of stack a level.
    MAX_JSON_ARRAYS = 400000,
};

typedef struct JsonScan {
    bool in_string;
    bool escaped;
    int depth;
    int max_depth;
    long array_count;
} JsonScan;

static void scan_character(JsonScan *scan, int c) {
    if (scan->in_string) {
        scan->in_string = scan->escaped || c != '"';
        scan->escaped = !scan->escaped && c == '\\';
        return;
    }
    scan->in_string = c == '"';
    scan->array_count += c == '[';
    scan->depth += (c == '{' || c == '[') - (c == '}' || c == ']');
    scan->max_depth = scan->depth > scan->max_depth ? scan->depth : scan->max_depth;
}

// The text of a .gltf, or of a .glb's first chunk.
static bool check_json(const char *path, bool binary, DipError *err) {
    FILE *file = fopen(path, "rb");
    unsigned char header[20] = {0}; // glb: 12 bytes, then the JSON chunk's length and type
    if (!file || (binary && fread(header, 1, sizeof header, file) != sizeof header)) {
        if (file) {
            fclose(file);
        }
        return dip_error_set(err, DIP_ERROR_TRUNCATED, path, 0, NULL, "model file ends too early");
    }
    unsigned long left = binary
                             ? header[12] | (unsigned long)header[13] << 8 |
                                   (unsigned long)header[14] << 16 | (unsigned long)header[15] << 24
                             : ~0UL;
    JsonScan scan = {0};
    for (int c = 0; left > 0 && (c = getc(file)) != EOF; --left) {
        scan_character(&scan, c);
    }
    fclose(file);
    if (scan.max_depth > MAX_JSON_DEPTH || scan.array_count > MAX_JSON_ARRAYS) {
        return dip_error_set(err, DIP_ERROR_RANGE, path, 0, NULL,
                             "JSON is nested %d deep and has %ld lists, accepted %d and %d",
                             scan.max_depth, scan.array_count, MAX_JSON_DEPTH, MAX_JSON_ARRAYS);
    }
    return true;
}

// Opens a file and tells its size.
static FILE *open_sized(const char *path, long *size_bytes, DipError *err) {
    FILE *file = fopen(path, "rb");
    if (!file || fseek(file, 0, SEEK_END) != 0) {
        if (file) {
            fclose(file);
        }
        dip_error_set(err, DIP_ERROR_IO, path, 0, NULL, "model file cannot be read");
        return NULL;
    }
    *size_bytes = ftell(file);
    rewind(file);
    return file;
}

// An element takes at least a byte, in text and in binary files.
static bool check_ply(const char *path, DipError *err) {
    long size_bytes;
    FILE *file = open_sized(path, &size_bytes, err);
    if (!file) {
        return false;
    }
    char line[256];
    char element[64] = "";
    double count = 0.0;
    bool fits = true;
    for (int i = 0; fits && i < 1000 && fgets(line, sizeof line, file); ++i) {
        if (strncmp(line, "end_header", 10) == 0) {
            break;
        }
        const bool counts = sscanf(line, "element %63s %lf", element, &count) == 2;
        fits = !counts || (count >= 0.0 && count <= (double)size_bytes);
    }
    fclose(file);
    return fits || dip_error_set(err, DIP_ERROR_TRUNCATED, path, 0, element,
                                 "file of %ld bytes cannot hold %.0f elements", size_bytes, count);
}

// The next number of an OFF file's header, past comments; false when something else stands there.
static bool next_count(FILE *file, double *count) {
    int c = getc(file);
    while (c == '#' || c == ' ' || c == '\t' || c == '\r' || c == '\n') {
        while (c == '#' && (c = getc(file)) != '\n' && c != EOF) {
            c = '#';
        }
        c = getc(file);
    }
    return ungetc(c, file) != EOF && fscanf(file, "%lf", count) == 1;
}

// assimp makes room for as many vertices and faces as the header says. Each takes at least a byte.
static bool check_off(const char *path, DipError *err) {
    long size_bytes;
    FILE *file = open_sized(path, &size_bytes, err);
    if (!file) {
        return false;
    }
    char word[64] = "";
    double count = 0.0;
    bool fits = true;
    // [ST][C][N][4][n]OFF; n: the dimension comes before the counts.
    if (fscanf(file, "%63s", word) == 1 && strstr(word, "OFF") &&
        (!strchr(word, 'n') || next_count(file, &count))) {
        for (int i = 0; i < 2 && fits && next_count(file, &count); ++i) {
            fits = count >= 0.0 && count <= (double)size_bytes;
        }
    }
    fclose(file);
    return fits || dip_error_set(err, DIP_ERROR_TRUNCATED, path, 0, NULL,
                                 "file of %ld bytes cannot hold %.0f elements", size_bytes, count);
}

bool dip_model_precheck(const char *path, DipError *err) {
    const char *dot = strrchr(path, '.');
    if (!dot) {
        return true;
    }
    if (strcasecmp(dot, ".ply") == 0) {
        return check_ply(path, err);
    }
    if (strcasecmp(dot, ".off") == 0) {
        return check_off(path, err);
    }
    const bool binary = strcasecmp(dot, ".glb") == 0;
    return (!binary && strcasecmp(dot, ".gltf") != 0) || check_json(path, binary, err);
}
