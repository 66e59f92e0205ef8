// Checks of model files before assimp reads them: they refuse files that would make assimp run out
// of stack, memory or time.
#include "assets/model_parts.h"
#include "renderer/base/file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum {
    MAX_JSON_DEPTH = 512,
    // This number also limits how deep nodes nest, because every node with children has an array.
    // For each level of nodes assimp uses some 600 bytes of stack.
    MAX_JSON_ARRAYS = 400000,
};

typedef struct JsonScan {
    const char *path;
    bool in_string;
    bool escaped; // the character before was an unescaped backslash
    int depth;    // number of objects and arrays that are open
    int max_depth;
    long array_count;
} JsonScan;

static void scan_character(JsonScan *scan, int c) {
    if (scan->in_string) {
        scan->in_string = c != '"' || scan->escaped;
        scan->escaped = !scan->escaped && c == '\\';
        return;
    }
    scan->in_string = c == '"';
    scan->escaped = false;
    scan->array_count += c == '[';
    scan->depth += (c == '{' || c == '[') - (c == '}' || c == ']');
    scan->max_depth = scan->depth > scan->max_depth ? scan->depth : scan->max_depth;
}

static bool check_scan(const JsonScan *scan, DipError *err) {
    return (scan->max_depth <= MAX_JSON_DEPTH && scan->array_count <= MAX_JSON_ARRAYS) ||
           dip_error_set(err, DIP_ERROR_RANGE, scan->path, 0, NULL,
                         "JSON is nested %d deep and has %ld arrays, accepted %d and %d",
                         scan->max_depth, scan->array_count, MAX_JSON_DEPTH, MAX_JSON_ARRAYS);
}

static bool cannot_open(const char *path, DipError *err) {
    return dip_error_set(err, dip_file_open_code(errno), path, 0, NULL, "cannot open the model: %s",
                         strerror(errno));
}

// Scans the text of a .gltf of glTF 1, or of the first chunk of a .glb (binary).
static bool check_json(const char *path, bool binary, DipError *err) {
    FILE *file = fopen(path, "rb");
    unsigned char header[20] = {0}; // glb: 12 bytes, then the JSON chunk's length and type
    if (!file) {
        return cannot_open(path, err);
    }
    if (binary && fread(header, 1, sizeof header, file) != sizeof header) {
        fclose(file);
        return dip_error_set(err, DIP_ERROR_TRUNCATED, path, 0, NULL,
                             "the model file ends too early");
    }
    unsigned long left = binary
                             ? header[12] | (unsigned long)header[13] << 8 |
                                   (unsigned long)header[14] << 16 | (unsigned long)header[15] << 24
                             : ~0UL;
    JsonScan scan = {.path = path};
    for (int c = 0; left > 0 && (c = getc(file)) != EOF; --left) {
        scan_character(&scan, c);
    }
    fclose(file);
    // assimp would allocate the whole length that the header tells, and find out then.
    if (binary && left > 0) {
        return dip_error_set(err, DIP_ERROR_TRUNCATED, path, 0, NULL,
                             "the model file ends too early");
    }
    return check_scan(&scan, err);
}

// Opens a file and finds its size.
static FILE *open_sized(const char *path, long *size_bytes, DipError *err) {
    FILE *file = fopen(path, "rb");
    if (!file) {
        cannot_open(path, err);
        return NULL;
    }
    if (fseek(file, 0, SEEK_END) != 0) {
        fclose(file);
        dip_error_set(err, DIP_ERROR_IO, path, 0, NULL, "the model file cannot be read");
        return NULL;
    }
    *size_bytes = ftell(file);
    rewind(file);
    return file;
}

// Compares the counts in a PLY header with the file's size. An element takes at least one byte, in
// text and in binary files.
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
    return fits ||
           dip_error_set(err, DIP_ERROR_TRUNCATED, path, 0, element,
                         "a file of %ld bytes cannot hold %.0f elements", size_bytes, count);
}

// Reads the next number of an OFF header and skips comments. Returns false if there is no number.
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

// Compares the counts in an OFF header with the file's size, because assimp allocates memory for
// all vertices and faces at once. Each vertex or face takes at least one byte in the file.
static bool check_off(const char *path, DipError *err) {
    long size_bytes;
    FILE *file = open_sized(path, &size_bytes, err);
    if (!file) {
        return false;
    }
    char word[64] = "";
    double count = 0.0;
    bool fits = true;
    // The first word is [ST][C][N][4][n]OFF. If it has the n, the dimension comes before the
    // counts.
    if (fscanf(file, "%63s", word) == 1 && strstr(word, "OFF") &&
        (!strchr(word, 'n') || next_count(file, &count))) {
        for (int i = 0; i < 2 && fits && next_count(file, &count); ++i) {
            fits = count >= 0.0 && count <= (double)size_bytes;
        }
    }
    fclose(file);
    return fits ||
           dip_error_set(err, DIP_ERROR_TRUNCATED, path, 0, NULL,
                         "a file of %ld bytes cannot hold %.0f elements", size_bytes, count);
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
