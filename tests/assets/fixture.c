// Creates files for the tests of assets/.
#include "tests/assets/fixture.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

const uint8_t fixture_png[76] = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52,
    0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x02, 0x08, 0x06, 0x00, 0x00, 0x00, 0x72, 0xb6, 0x0d,
    0x24, 0x00, 0x00, 0x00, 0x13, 0x49, 0x44, 0x41, 0x54, 0x78, 0xda, 0x63, 0xf8, 0xcf, 0xc0, 0xf0,
    0x1f, 0x0c, 0x81, 0x34, 0x08, 0x30, 0x00, 0x00, 0x48, 0xc9, 0x08, 0xf8, 0xc5, 0x34, 0xfd, 0x05,
    0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

static char folder[256];

static void check(int ok, const char *what) {
    if (!ok) {
        perror(what);
        abort();
    }
}

int fixture_open(void **state) {
    (void)state;
    const char *temporary = getenv("TMPDIR");
    const int length = snprintf(folder, sizeof folder, "%s/dip_assets_XXXXXX",
                                temporary && *temporary ? temporary : "/tmp");
    check(length > 0 && (size_t)length < sizeof folder, "TMPDIR");
    check(mkdtemp(folder) != NULL, folder);
    return 0;
}

int fixture_close(void **state) {
    (void)state;
    DIR *listing = opendir(folder);
    check(listing != NULL, folder);
    for (struct dirent *entry = readdir(listing); entry; entry = readdir(listing)) {
        if (entry->d_name[0] != '.') {
            unlink(fixture_path(entry->d_name));
        }
    }
    closedir(listing);
    rmdir(folder);
    return 0;
}

static const char *join(const char *directory, const char *name) {
    static char paths[4][FIXTURE_PATH];
    static int next = 0;
    char *path = paths[next++ % 4];
    snprintf(path, FIXTURE_PATH, "%s/%s", directory, name);
    return path;
}

const char *fixture_path(const char *name) {
    return join(folder, name);
}

const char *fixture_data(const char *name) {
    return join(DIP_TEST_DATA, name);
}

void fixture_write(const char *name, const void *bytes, size_t size_bytes) {
    FILE *file = fopen(fixture_path(name), "wb");
    check(file != NULL, name);
    check(fwrite(bytes, 1, size_bytes, file) == size_bytes, name);
    check(fclose(file) == 0, name);
}

void fixture_write_text(const char *name, const char *text) {
    fixture_write(name, text, strlen(text));
}

uint8_t *fixture_read(const char *path, size_t *size_bytes) {
    FILE *file = fopen(path, "rb");
    check(file != NULL, path);
    uint8_t *bytes = malloc(1 << 20);
    check(bytes != NULL, path);
    *size_bytes = fread(bytes, 1, 1 << 20, file);
    fclose(file);
    return bytes;
}

void fixture_copy(const char *data_name) {
    size_t size_bytes = 0;
    uint8_t *bytes = fixture_read(fixture_data(data_name), &size_bytes);
    fixture_write(data_name, bytes, size_bytes);
    free(bytes);
}

void fixture_write_tga(const char *name, int width, int height, uint8_t grey) {
    uint8_t bytes[18 + 3 * 256] = {0};
    check(width * height <= 256, "picture too large for the fixture");
    bytes[2] = 2; // uncompressed true colour
    bytes[12] = (uint8_t)width;
    bytes[14] = (uint8_t)height;
    bytes[16] = 24;
    bytes[17] = 0x20; // top row first
    memset(bytes + 18, grey, 3 * (size_t)(width * height));
    fixture_write(name, bytes, 18 + 3 * (size_t)(width * height));
}

DipModel *fixture_load(const char *path, const DipModelOptions *options, DipErrorList *warnings) {
    DipError err = {0};
    DipModel *model = dip_model_load_with(&path, 1, options, NULL, warnings, &err);
    if (!model) {
        fail_msg("%s: %s", path, err.message);
    }
    return model;
}

const DipObjectDef *fixture_object(const DipSceneDef *def, const char *name) {
    for (int i = 0; i < def->object_count; ++i) {
        if (strcmp(def->objects[i].name, name) == 0) {
            return &def->objects[i];
        }
    }
    fail_msg("no object %s", name);
    return NULL;
}
