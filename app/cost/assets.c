// `diptych cost assets`: size, zipped size and load time of the assets in several formats.
#include "app/cost/cost.h"

#include "app/files/png.h"
#include "app/files/zip.h"
#include "app/measure/stats/statistics.h"
#include "campaths/campath.h"
#include "renderer/base/clock.h"
#include "renderer/base/file.h"

#include <assimp/cexport.h>
#include <assimp/cimport.h>
#include <assimp/scene.h>

#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define STB_DXT_STATIC
#define STB_DXT_IMPLEMENTATION
#include <stb/stb_dxt.h>

enum { LOADS = 5, BC1_BYTES = 8, MAX_FILE_BYTES = 1 << 30 };

typedef struct Size {
    double bytes;
    double zipped;
} Size;

static void add_bytes(Size *size, const unsigned char *bytes, size_t count) {
    size->bytes += (double)count;
    size->zipped += (double)dip_zip_size(bytes, count);
}

// Adds the size of a file; a file that cannot be read counts as empty.
static void add_file(Size *size, const char *file) {
    unsigned char *bytes;
    size_t count;
    if (dip_file_read(file, "file", MAX_FILE_BYTES, &bytes, &count, NULL)) {
        add_bytes(size, bytes, count);
        free(bytes);
    }
}

typedef void EachFile(void *context, const char *file);

static void for_files(const char *folder, EachFile *each, void *context) {
    DIR *open = opendir(folder);
    for (const struct dirent *entry; open && (entry = readdir(open));) {
        char file[PATH_MAX];
        const int length = snprintf(file, sizeof file, "%s/%s", folder, entry->d_name);
        if (entry->d_name[0] != '.' && length > 0 && (size_t)length < sizeof file) {
            each(context, file);
        }
    }
    if (open) {
        closedir(open);
    }
}

static void add_each(void *context, const char *file) {
    add_file(context, file);
}

static void remove_each(void *context, const char *file) {
    (void)context;
    remove(file);
}

static void print_row(const char *name, Size size, double load_ms) {
    printf("  %-42s %10.1f %10.1f", name, size.bytes / 1024.0, size.zipped / 1024.0);
    if (load_ms >= 0.0) {
        printf(" %10.2f\n", load_ms);
    } else {
        printf(" %10s\n", "-");
    }
}

static void print_head(const char *title) {
    printf("%-44s %10s %10s %10s\n", title, "KiB", "zipped KiB", "load ms");
}

// --- meshes ------------------------------------------------------------------------------------

// Returns the median time of loading a model, in milliseconds, or -1 if it cannot be loaded.
static double time_model(const char *file, DipPool *pool) {
    double ms[LOADS];
    double scratch[LOADS];
    for (int i = 0; i < LOADS; i++) {
        DipErrorList warnings = {0};
        const int64_t begin_ns = dip_clock_ns();
        DipModel *model = dip_model_load_with_normals(&file, 1, pool, &warnings, NULL);
        ms[i] = 1e-6 * (double)(dip_clock_ns() - begin_ns);
        dip_error_list_free(&warnings);
        if (!model) {
            return -1.0;
        }
        dip_model_destroy(&model);
    }
    return dip_stats_quantile(ms, LOADS, 0.5, scratch);
}

// Writes the mesh in one format to an empty folder, loads it and prints its row. The folder has no
// pictures, so that only the mesh is loaded.
static void measure_mesh(const struct aiScene *scene, const char *format, const char *ending,
                         const char *name, const char *folder, DipPool *pool) {
    char file[PATH_MAX];
    if (snprintf(file, sizeof file, "%s/model.%s", folder, ending) >= (int)sizeof file) {
        return;
    }
    if (aiExportScene(scene, format, file, 0) == aiReturn_SUCCESS) {
        Size size = {0};
        for_files(folder, add_each, &size);
        print_row(name, size, time_model(file, pool));
    }
    for_files(folder, remove_each, NULL);
}

static void measure_meshes(const char *model, const char *folder, DipPool *pool) {
    static const char *const forms[][3] = {{"gltf2", "gltf", "glTF, text with a binary file"},
                                           {"glb2", "glb", "glTF, one binary file"},
                                           {"obj", "obj", "OBJ, text"},
                                           {"plyb", "ply", "PLY, binary"},
                                           {"x", "x", "X, text"}};
    const struct aiScene *scene = aiImportFile(model, 0);
    print_head("Mesh, as assimp writes it, without pictures");
    for (size_t i = 0; scene && i < sizeof forms / sizeof *forms; i++) {
        measure_mesh(scene, forms[i][0], forms[i][1], forms[i][2], folder, pool);
    }
    if (scene) {
        aiReleaseImport(scene);
    }
}

// --- pictures ----------------------------------------------------------------------------------

static const uint8_t *texel_at(const DipTextureDef *texture, int level, int x, int y) {
    // A real mip level consists of means of texels. This one copies the nearest texels of level 0,
    // because only the compressed size is needed.
    const int sx = (x << level) < texture->width ? x << level : texture->width - 1;
    const int sy = (y << level) < texture->height ? y << level : texture->height - 1;
    return texture->rgba8 + 4 * ((size_t)sy * (size_t)texture->width + (size_t)sx);
}

static size_t blocks_of(int size, int level) {
    const int levels = size >> level > 1 ? size >> level : 1;
    return (size_t)(levels + 3) / 4;
}

// Writes a level's compressed blocks to `to` and returns the position after them.
static uint8_t *compress_level(const DipTextureDef *texture, int level, uint8_t *to) {
    const size_t across = blocks_of(texture->width, level);
    const size_t down = blocks_of(texture->height, level);
    for (size_t b = 0; b < across * down; b++, to += BC1_BYTES) {
        uint8_t block[64];
        for (int i = 0; i < 16; i++) {
            const int x = (int)(4 * (b % across)) + i % 4;
            const int y = (int)(4 * (b / across)) + i / 4;
            memcpy(block + 4 * i, texel_at(texture, level, x, y), 4);
            block[4 * i + 3] = 255;
        }
        stb_compress_dxt_block(to, block, 0, STB_DXT_NORMAL);
    }
    return to;
}

static int level_count(const DipTextureDef *texture) {
    int count = 1;
    while (texture->width >> count > 0 || texture->height >> count > 0) {
        count++;
    }
    return count;
}

// Returns the size of all pictures as BC1 with `levels` stored mip levels each. 0 stands for whole
// mip chains.
static Size measure_bc1(const DipSceneDef *def, int levels) {
    Size size = {0};
    for (int t = 0; t < def->texture_count; t++) {
        const DipTextureDef *texture = &def->textures[t];
        const int count = levels ? levels : level_count(texture);
        // A mip chain is smaller than 3/2 of its first level plus one block per level.
        const size_t room = blocks_of(texture->width, 0) * blocks_of(texture->height, 0);
        uint8_t *blocks = malloc((room + room / 2 + 64) * BC1_BYTES);
        uint8_t *end = blocks;
        for (int level = 0; blocks && level < count; level++) {
            end = compress_level(texture, level, end);
        }
        if (blocks) {
            add_bytes(&size, blocks, (size_t)(end - blocks));
        }
        free(blocks);
    }
    return size;
}

static Size measure_png(const DipSceneDef *def) {
    Size size = {0};
    for (int t = 0; t < def->texture_count; t++) {
        const DipTextureDef *texture = &def->textures[t];
        unsigned char *bytes;
        size_t count;
        if (dip_png_encode(texture->rgba8, (size_t)texture->width * 4, texture->width,
                           texture->height, &bytes, &count)) {
            add_bytes(&size, bytes, count);
            free(bytes);
        }
    }
    return size;
}

static void add_picture(void *context, const char *file) {
    const char *dot = strrchr(file, '.');
    if (dot && (strcmp(dot, ".jpg") == 0 || strcmp(dot, ".png") == 0)) {
        add_file(context, file);
    }
}

static void measure_pictures(const DipSession *session, const char *model_folder) {
    Size shipped = {0};
    for_files(model_folder, add_picture, &shipped);
    print_head("All pictures");
    print_row("as shipped (JPEG, or PNG with alpha)", shipped, session->times.pictures_ms);
    print_row("PNG, without alpha", measure_png(&session->scene_def), -1.0);
    print_row("BC1, largest level", measure_bc1(&session->scene_def, 1), -1.0);
    print_row("BC1, stored mip chain", measure_bc1(&session->scene_def, 0), -1.0);
    printf("  Loading also makes mip chains, in %.1f ms. Only the shipped pictures are loaded and "
           "timed.\n",
           session->times.textures_ms);
}

// --- paths -------------------------------------------------------------------------------------

static double time_path(const char *file) {
    double ms[LOADS];
    double scratch[LOADS];
    for (int i = 0; i < LOADS; i++) {
        DipCamPath *path;
        const int64_t begin_ns = dip_clock_ns();
        if (!dip_campath_load(file, &path, NULL)) {
            return -1.0;
        }
        ms[i] = 1e-6 * (double)(dip_clock_ns() - begin_ns);
        dip_campath_destroy(&path);
    }
    return dip_stats_quantile(ms, LOADS, 0.5, scratch);
}

static void measure_paths(const DipSession *session, const char *folder) {
    char text[PATH_MAX];
    char binary[PATH_MAX];
    Size sizes[2] = {{0}};
    double ms[2] = {0};
    snprintf(text, sizeof text, "%.*s/path.pth", PATH_MAX - 16, folder);
    snprintf(binary, sizeof binary, "%.*s/path.bth", PATH_MAX - 16, folder);
    for (int p = 0; p < session->path_count; p++) {
        if (dip_campath_save_pth(session->paths[p], text, NULL) &&
            dip_campath_save_bth(session->paths[p], binary, NULL)) {
            add_file(&sizes[0], text);
            add_file(&sizes[1], binary);
            ms[0] += time_path(text);
            ms[1] += time_path(binary);
        }
    }
    for_files(folder, remove_each, NULL);
    print_head("All camera paths");
    print_row("text, .pth", sizes[0], ms[0]);
    print_row("binary, .bth", sizes[1], ms[1]);
}

// --- the whole ---------------------------------------------------------------------------------

static void measure_release(const char *model_folder) {
    Size program = {0};
    Size assets = {0};
    add_file(&program, "/proc/self/exe");
    for_files(model_folder, add_each, &assets);
    print_head("The release");
    print_row("program, as it was built", program, -1.0);
    print_row("model and pictures, as shipped", assets, -1.0);
}

// Prints the time of each part of the start (start_times.h), and the time to free everything.
static void measure_session(DipSession *session) {
    const DipStartTimes times = session->times;
    printf("Load and shutdown of the whole program, ms\n  ");
#define PRINT_PART(name, text)                                                                     \
    if (times.name##_ms > 0.0) {                                                                   \
        printf("%s %.1f, ", #name, times.name##_ms);                                               \
    }
    DIP_START_TIME_LIST(PRINT_PART)
#undef PRINT_PART
    printf("all %.1f", 1e-6 * (double)(times.opened_ns - times.begin_ns));
    const int64_t begin_ns = dip_clock_ns();
    dip_session_close(session);
    printf("; shutdown %.1f\n", 1e-6 * (double)(dip_clock_ns() - begin_ns));
}

bool dip_cost_assets_run(DipSession *session, DipError *err) {
    const char *model = dip_session_scene_file(session);
    char model_folder[PATH_MAX] = ".";
    char folder[PATH_MAX];
    const char *scratch = getenv("TMPDIR");
    snprintf(folder, sizeof folder, "%.3000s/diptych-assets.XXXXXX",
             scratch && *scratch ? scratch : "/tmp");
    const char *slash = strrchr(model, '/');
    if (slash && slash - model < PATH_MAX - 1) {
        snprintf(model_folder, sizeof model_folder, "%.*s", (int)(slash - model), model);
    }
    if (!mkdtemp(folder)) {
        return dip_error_set_runtime(err, DIP_ERROR_IO, folder, 0, NULL, "cannot be made: %s",
                                     strerror(errno));
    }
    measure_meshes(model, folder, session->pool);
    measure_pictures(session, model_folder);
    measure_paths(session, folder);
    measure_release(model_folder);
    rmdir(folder);
    measure_session(session);
    return true;
}
