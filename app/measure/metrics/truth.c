// Draws the two halves of a truth (truth.h) on the pool, computes their mean and difference, and
// reads and writes the cache.
#include "app/measure/metrics/truth.h"

#include "app/files/folder.h"
#include "app/files/whole_file.h"
#include "app/measure/metrics/meter.h"
#include "renderer/base/file.h"
#include "renderer/base/hash.h"
#include "renderer/reference/convergence.h"

#include <limits.h>
#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HALVES = 2, TILES_AT_ONCE = 128 }; // progress is reported after each batch of tiles

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "truth", "out of memory");
}

// --- the key -----------------------------------------------------------------------------------

// Hashes everything that the truth depends on, including a version number of the code that makes
// it.
static void find_key(const DipTruthDef *def, char key[33]) {
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

// --- making ------------------------------------------------------------------------------------

// One half while it is drawn.
typedef struct Half {
    const DipTruthDef *def;
    const DipConvergence *convergence;
    double *rgb_lin;
    uint8_t *classes; // what pixels show; only for the first half, NULL for the second half
    uint32_t seed;
    int first_tile; // index of the current batch's first tile
    atomic_bool failed;
} Half;

static void draw_tile(void *context, int index, int worker) {
    (void)worker;
    Half *drawn = context;
    if (!dip_convergence_add_tile(drawn->convergence, drawn->first_tile + index,
                                  drawn->def->samples, drawn->seed, 1.0, drawn->rgb_lin,
                                  drawn->classes, NULL)) {
        drawn->failed = true;
    }
}

static bool draw_half(Half *drawn, int half, DipPool *pool, DipTruthProgress *progress,
                      void *context, DipError *err) {
    const int tiles = dip_convergence_tile_count(drawn->convergence);
    drawn->seed = (uint32_t)half + 1;
    for (int tile = 0; tile < tiles; tile += TILES_AT_ONCE) {
        const int count = tiles - tile < TILES_AT_ONCE ? tiles - tile : TILES_AT_ONCE;
        drawn->first_tile = tile;
        dip_pool_run(pool, count, draw_tile, drawn);
        if (drawn->failed) {
            return out_of_memory(err);
        }
        if (!progress(context, (half + (double)(tile + count) / tiles) / HALVES)) {
            return dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "truth", "interrupted");
        }
    }
    return true;
}

void dip_truth_encode(const DipSrgbEncodeTable *table, const double *rgb_lin, size_t pixel_count,
                      uint8_t *rgba8) {
    for (size_t i = 0; i < pixel_count; i++) {
        for (size_t c = 0; c < 3; c++) {
            const double value = fmin(fmax(rgb_lin[3 * i + c], 0.0), 1.0);
            rgba8[4 * i + c] = table->code[(int)(value * DIP_LINEAR16_MAX + 0.5)];
        }
        rgba8[4 * i + 3] = 255;
    }
}

static void encode(const double *rgb_lin, size_t pixel_count, uint8_t *rgba8) {
    DipSrgbEncodeTable table;
    dip_srgb_encode_table(&table);
    dip_truth_encode(&table, rgb_lin, pixel_count, rgba8);
}

static void round_to_floats(const double *rgb_lin, size_t count, float *out) {
    for (size_t i = 0; i < count; i++) {
        out[i] = (float)rgb_lin[i];
    }
}

// Computes the noise floor: the metrics of the first half against the second half.
static bool measure_floor(DipTruth *truth, const DipTruthDef *def, double *const halves[HALVES],
                          DipError *err) {
    const size_t pixels = (size_t)truth->width * (size_t)truth->height;
    DipMeter meter;
    if (!dip_meter_init(&meter, truth->width, truth->height, def->pixels_per_degree)) {
        return out_of_memory(err);
    }
    DipFlipAnalysis analysis = {0};
    uint8_t *codes = malloc(HALVES * pixels * 4);
    float *light = malloc(HALVES * pixels * 3 * sizeof *light);
    bool measured = codes && light && dip_flip_analysis_init(&meter.flip, &analysis);
    if (measured) {
        DipSrgbPicture pictures[HALVES];
        for (size_t h = 0; h < HALVES; h++) {
            encode(halves[h], pixels, codes + h * pixels * 4);
            round_to_floats(halves[h], pixels * 3, light + h * pixels * 3);
            pictures[h] = (DipSrgbPicture){codes + h * pixels * 4, (size_t)truth->width * 4,
                                           truth->width, truth->height};
        }
        dip_flip_analyse(&meter.flip, &pictures[1], &analysis);
        const DipMeterStandard standard = {pictures[1], light + pixels * 3, &analysis,
                                           truth->classes};
        truth->floor = (DipMetricSums){0};
        dip_meter_begin_burst(&meter);
        measured = dip_meter_add(&meter, &pictures[0], light, &standard, &truth->floor);
        dip_meter_end_burst(&meter, &truth->floor);
    }
    dip_flip_analysis_free(&analysis);
    free(codes);
    free(light);
    dip_meter_free(&meter);
    return measured || out_of_memory(err);
}

// Draws both halves with the reference renderer.
static bool draw_halves(DipTruth *truth, const DipTruthDef *def, double *const halves[HALVES],
                        DipPool *pool, DipTruthProgress *progress, void *context, DipError *err) {
    dip_reference_set_time(def->reference, def->time_ns);
    DipConvergence *convergence =
        dip_convergence_create(def->reference, &def->pose, def->width, def->height, err);
    bool made = convergence != NULL;
    for (int h = 0; made && h < HALVES; h++) {
        Half drawn = {.def = def,
                      .convergence = convergence,
                      .rgb_lin = halves[h],
                      .classes = h == 0 ? truth->classes : NULL};
        made = draw_half(&drawn, h, pool, progress, context, err);
    }
    dip_convergence_destroy(&convergence);
    return made;
}

// Draws both halves with the caller's function, which does not say what the pixels show.
static bool draw_own_halves(DipTruth *truth, const DipTruthDef *def, double *const halves[HALVES],
                            DipTruthProgress *progress, void *context, DipError *err) {
    memset(truth->classes, DIP_SEEN_TEXTURED, (size_t)truth->width * (size_t)truth->height);
    for (int h = 0; h < HALVES; h++) {
        if (!def->draw(def, h, halves[h], err)) {
            return false;
        }
        if (!progress(context, (h + 1.0) / HALVES)) {
            return dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "truth", "interrupted");
        }
    }
    return true;
}

static bool make_truth(DipTruth *truth, const DipTruthDef *def, DipPool *pool,
                       DipTruthProgress *progress, void *context, DipError *err) {
    const size_t values = (size_t)truth->width * (size_t)truth->height * 3;
    double *halves[HALVES] = {calloc(values, sizeof(double)), calloc(values, sizeof(double))};
    bool made = (halves[0] && halves[1]) || out_of_memory(err);
    made = made && (def->draw ? draw_own_halves(truth, def, halves, progress, context, err)
                              : draw_halves(truth, def, halves, pool, progress, context, err));
    made = made && measure_floor(truth, def, halves, err);
    for (size_t i = 0; made && i < values; i++) {
        halves[0][i] = 0.5 * (halves[0][i] + halves[1][i]);
    }
    if (made) {
        round_to_floats(halves[0], values, truth->rgb_lin);
        encode(halves[0], values / 3, truth->rgba8);
    }
    free(halves[0]);
    free(halves[1]);
    return made;
}

// --- the cache ---------------------------------------------------------------------------------

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

static bool load(DipTruth *truth, const char *cache) {
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

static bool store(DipTruth *truth, const char *cache, DipError *err) {
    char name[PATH_MAX];
    const size_t size = file_size(truth);
    unsigned char *bytes = malloc(size);
    if (!bytes) {
        return out_of_memory(err);
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

bool dip_truth_get(DipTruth *truth, const DipTruthDef *def, const char *cache, DipPool *pool,
                   DipTruthProgress *progress, void *context, DipError *err) {
    const size_t pixels = (size_t)def->width * (size_t)def->height;
    *truth = (DipTruth){
        .width = def->width,
        .height = def->height,
        .rgb_lin = malloc(pixels * 3 * sizeof(float)),
        .rgba8 = malloc(pixels * 4),
        .classes = malloc(pixels),
    };
    find_key(def, truth->key);
    bool got = (truth->rgb_lin && truth->rgba8 && truth->classes) || out_of_memory(err);
    if (got && !(cache && load(truth, cache))) {
        got = make_truth(truth, def, pool, progress, context, err) &&
              (!cache || store(truth, cache, err));
    }
    if (!got) {
        dip_truth_free(truth);
    }
    return got;
}

double dip_truth_floor_rmse(const DipMetricSums *floor, int region) {
    // The error of the mean of two independent halves is half of their difference.
    return dip_metrics_of(floor, region).rmse_lin / 2.0;
}

void dip_truth_free(DipTruth *truth) {
    free(truth->rgb_lin);
    free(truth->rgba8);
    free(truth->classes);
    *truth = (DipTruth){0};
}
