// Makes input files for extremes.sh.
//
//     make_inputs picture WIDTH HEIGHT FILE   a PNG file of one colour
//     make_inputs grid N FILE                 a glTF binary: a flat square of 2 * N * N triangles
#include "app/files/pictures.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int fail(const char *what, const char *file) {
    fprintf(stderr, "make_inputs: %s: %s\n", file, what);
    return 1;
}

static int make_picture(int width, int height, const char *file) {
    const size_t count = (size_t)width * (size_t)height;
    static const uint8_t colour[4] = {200, 120, 40, 255};
    DipError err = {0};
    uint8_t *rgba8 = malloc(4 * count);
    for (size_t i = 0; rgba8 && i < count; i++) {
        memcpy(rgba8 + 4 * i, colour, 4);
    }
    const DipFrame frame = {
        .rgba8 = rgba8, .stride_bytes = 4 * (size_t)width, .width = width, .height = height};
    const bool written = rgba8 && dip_png_write(file, &frame, &err);
    free(rgba8);
    return written ? 0 : fail(err.message, file);
}

// --- glTF -------------------------------------------------------------------------------------

// Writes a number of 4 bytes, little-endian on every host.
static void put(FILE *out, uint32_t number) {
    for (int i = 0; i < 4; i++) {
        putc((int)(number >> 8 * i & 255), out);
    }
}

static void put_float(FILE *out, float number) {
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    put(out, bits);
}

static void write_buffers(FILE *out, uint32_t n) {
    for (uint32_t v = 0; v < (n + 1) * (n + 1); v++) {
        put_float(out, 2.0f * (float)(v % (n + 1)) / (float)n - 1.0f);
        put_float(out, 2.0f * (float)(v / (n + 1)) / (float)n - 1.0f);
        put_float(out, 0.0f);
    }
    for (uint32_t i = 0; i < n * n; i++) {
        const uint32_t v = i / n * (n + 1) + i % n;
        const uint32_t corners[6] = {v, v + 1, v + n + 2, v, v + n + 2, v + n + 1};
        for (int c = 0; c < 6; c++) {
            put(out, corners[c]);
        }
    }
}

// The square reaches from -1 to 1 in x and y. Its material is unlit white.
static int make_grid(uint32_t n, const char *file) {
    const uint32_t position_bytes = 12 * (n + 1) * (n + 1);
    const uint32_t index_bytes = 24 * n * n;
    char json[1024];
    const int length = snprintf(
        json, sizeof json,
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
        "\"buffers\":[{\"byteLength\":%u}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%u},"
        "{\"buffer\":0,\"byteOffset\":%u,\"byteLength\":%u}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":%u,\"type\":\"VEC3\","
        "\"min\":[-1,-1,0],\"max\":[1,1,0]},"
        "{\"bufferView\":1,\"componentType\":5125,\"count\":%u,\"type\":\"SCALAR\"}]}",
        position_bytes + index_bytes, position_bytes, position_bytes, index_bytes,
        position_bytes / 12, index_bytes / 4);
    const uint32_t padded = ((uint32_t)length + 3) / 4 * 4;
    FILE *out = fopen(file, "wb");
    if (!out) {
        return fail("cannot be written", file);
    }
    put(out, 0x46546c67); // "glTF"
    put(out, 2);
    put(out, 12 + 8 + padded + 8 + position_bytes + index_bytes);
    put(out, padded);
    put(out, 0x4e4f534a); // "JSON"
    fprintf(out, "%-*s", (int)padded, json);
    put(out, position_bytes + index_bytes);
    put(out, 0x004e4942); // "BIN"
    write_buffers(out, n);
    const bool written = !ferror(out);
    return fclose(out) == 0 && written ? 0 : fail("cannot be written", file);
}

int main(int argc, char **argv) {
    if (argc == 5 && strcmp(argv[1], "picture") == 0) {
        return make_picture(atoi(argv[2]), atoi(argv[3]), argv[4]);
    }
    if (argc == 4 && strcmp(argv[1], "grid") == 0) {
        return make_grid((uint32_t)atoi(argv[2]), argv[3]);
    }
    fprintf(stderr, "usage: make_inputs picture WIDTH HEIGHT FILE | make_inputs grid N FILE\n");
    return 2;
}
