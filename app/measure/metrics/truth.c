// Draws the two halves of a truth (truth.h) tile by tile, computes their mean and their difference,
// and stores the truth in the cache.
#include "app/measure/metrics/truth.h"

#include "app/files/whole_file.h"
#include "app/measure/metrics/meter.h"
#include "renderer/base/file.h"
#include "renderer/base/fp_mode.h"
#include "renderer/base/hash.h"
#include "renderer/base/srgb.h"
#include "renderer/reference/convergence.h"
#include "renderer/scene/frame.h"

#include <dirent.h>
#include <limits.h>
#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum {
    HALVES = 2,
    TILES_AT_ONCE = 128, // Greatest number of tiles that one step draws, unless the job is live.
    PIXELS_AT_ONCE = 1 << 14,  // Pixels for which one step computes the mean of the halves.
    LIVE_CACHE_BYTES = 1 << 30 // A live job (truth.h) adds nothing to a cache larger than this.
};

const int dip_truth_level_samples[DIP_TRUTH_LEVELS] = {4, 16, DIP_TRUTH_SAMPLES};

// What the next step of a job does.
typedef enum Phase { LOAD, PREPARE, DRAW, JOIN, MEASURE_FLOOR, STORE, END } Phase;

// One half of a truth, in the form in which it is drawn and in the two forms that the meter
// compares.
typedef struct Half {
    double *lin;    // Linear light. Owned; the other arrays lie in the same memory.
    float *rounded; // The same values as floats.
    uint8_t *rgba8; // The same values, encoded to 8-bit sRGB.
} Half;

struct DipTruthJob {
    DipTruthDef def;
    const char *cache; // NULL if there is no cache.
    DipPool *pool;
    bool live;
    Phase phase;
    int level; // Index in dip_truth_level_samples; the last level has def.samples instead.
    DipSrgbEncodeTable encode;
    DipConvergence *convergence; // NULL if the def's function `draw` draws.
    Half halves[HALVES];
    int drawn;      // Tiles of the level drawn so far, in both halves together.
    size_t joined;  // Number of pixels for which the mean of the halves has been computed.
    DipMeter meter; // Compares the halves.
    DipTruth truth;
    bool has_truth; // True if `truth` holds the truth of the last complete level.
};

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "truth", "out of memory");
}

// --- the cache -----------------------------------------------------------------------------------

bool dip_truth_default_folder(char *folder, size_t size_bytes) {
    const char *cache = getenv("XDG_CACHE_HOME");
    const char *home = getenv("HOME");
    const bool has_cache = cache && *cache == '/'; // The specification ignores a relative path.
    if (!has_cache && !(home && *home)) {
        return false;
    }
    const int length = snprintf(folder, size_bytes, "%s%s/diptych", has_cache ? cache : home,
                                has_cache ? "" : "/.cache");
    return length > 0 && (size_t)length < size_bytes;
}

// Writes the key of a truth, which names its file: a hash of everything that the truth depends on,
// including a version number of the code that makes it.
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
    dip_hash_number(&hash, def->pixels_per_degree); // The noise floor's FLIP depends on it.
    dip_hash_hex(&hash, key);
}

// A file holds the truth's arrays one after the other, then its floor, and then a hash of all these
// bytes as 32 digits. The arrays lie in memory in the same order, followed by room for the floor
// and the hash. Byte order and layout are those of the machine that wrote the file.
static size_t arrays_size(const DipTruth *truth) {
    return (size_t)truth->width * (size_t)truth->height * (3 * sizeof(float) + 4 + 1);
}

static size_t file_size(const DipTruth *truth) {
    return arrays_size(truth) + sizeof truth->floor + 32;
}

static bool file_name(const DipTruth *truth, const char *cache, char file[PATH_MAX]) {
    const int length = snprintf(file, PATH_MAX, "%s/truth-%s.bin", cache, truth->key);
    return length > 0 && length < PATH_MAX;
}

static void hash_contents(const unsigned char *bytes, size_t size, char hex[33]) {
    DipHash hash = dip_hash_begin(0);
    dip_hash_bytes(&hash, bytes, size);
    dip_hash_hex(&hash, hex);
}

// Reads the contents of a truth. The caller has set its key, size and arrays. Returns false if
// there is no such file or if the file is damaged.
static bool load_file(DipTruth *truth, const char *cache) {
    char name[PATH_MAX], hex[33];
    unsigned char *bytes;
    size_t size;
    if (!file_name(truth, cache, name) ||
        !dip_file_read(name, "truth", file_size(truth), &bytes, &size, NULL)) {
        return false;
    }
    bool whole = size == file_size(truth);
    if (whole) {
        hash_contents(bytes, size - 32, hex);
        whole = memcmp(hex, bytes + size - 32, 32) == 0;
    }
    if (whole) {
        memcpy(truth->rgb_lin, bytes, arrays_size(truth));
        memcpy(&truth->floor, bytes + arrays_size(truth), sizeof truth->floor);
    }
    free(bytes);
    return whole;
}

static bool store_file(const DipTruth *truth, const char *cache, DipError *err) {
    char name[PATH_MAX], hex[33];
    DipError fault;
    unsigned char *bytes = (unsigned char *)truth->rgb_lin;
    const size_t size = file_size(truth);
    memcpy(bytes + arrays_size(truth), &truth->floor, sizeof truth->floor);
    hash_contents(bytes, size - 32, hex);
    memcpy(bytes + size - 32, hex, 32);
    if (!file_name(truth, cache, name)) {
        return dip_error_set_runtime(err, DIP_ERROR_OVERSIZED, cache, 0, "--cache",
                                     "the name is too long");
    }
    return dip_whole_file_write(name, bytes, size, &fault) ||
           dip_error_set_runtime(err, fault.code, name, 0, "--cache", "%s", fault.message);
}

static int64_t cache_bytes(const char *cache) {
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

// --- levels --------------------------------------------------------------------------------------

static size_t pixel_count(const DipTruthJob *job) {
    return (size_t)job->def.width * (size_t)job->def.height;
}

static int samples_of_level(const DipTruthJob *job) {
    return job->level < DIP_TRUTH_LEVELS - 1 ? dip_truth_level_samples[job->level]
                                             : job->def.samples;
}

// Goes to the next level. Skips levels that are not coarser than the last level.
static void next_level(DipTruthJob *job) {
    do {
        job->level++;
    } while (job->level < DIP_TRUTH_LEVELS - 1 &&
             dip_truth_level_samples[job->level] >= job->def.samples);
    job->drawn = 0;
    job->joined = 0;
}

// Frees everything but the truth.
static void free_halves(DipTruthJob *job) {
    dip_convergence_destroy(&job->convergence);
    dip_meter_free(&job->meter);
    for (int h = 0; h < HALVES; h++) {
        free(job->halves[h].lin);
        job->halves[h] = (Half){0};
    }
}

static bool check_def(const DipTruthDef *def, DipError *err) {
    int side = 1;
    while (side * side < def->samples && side < 64) {
        side++;
    }
    if (def->width < 1 || def->height < 1 || def->width > DIP_MAX_FRAME_SIZE ||
        def->height > DIP_MAX_FRAME_SIZE) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "size",
                             "%dx%d is out of range, accepted 1..%d each", def->width, def->height,
                             DIP_MAX_FRAME_SIZE);
    }
    if (side * side != def->samples) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "samples",
                             "%d, accepted 1, 4, 9, ... 4096", def->samples);
    }
    return (def->pixels_per_degree >= DIP_FLIP_MIN_PIXELS_PER_DEGREE &&
            def->pixels_per_degree <= DIP_FLIP_MAX_PIXELS_PER_DEGREE) ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "pixels_per_degree", "%g, accepted %g..%g",
                         def->pixels_per_degree, DIP_FLIP_MIN_PIXELS_PER_DEGREE,
                         DIP_FLIP_MAX_PIXELS_PER_DEGREE);
}

DipTruthJob *dip_truth_job_create(const DipTruthDef *def, const char *cache, DipPool *pool,
                                  bool live, DipError *err) {
    DIP_FP_MODE_SCOPE();
    if (!check_def(def, err)) {
        return NULL;
    }
    DipTruthJob *job = calloc(1, sizeof *job);
    if (!job) {
        out_of_memory(err);
        return NULL;
    }
    *job = (DipTruthJob){.def = *def, .cache = cache, .pool = pool, .live = live};
    job->level = live ? -1 : DIP_TRUTH_LEVELS - 2;
    next_level(job);
    job->phase = cache ? LOAD : PREPARE;
    job->truth = (DipTruth){.width = def->width, .height = def->height};
    job->truth.rgb_lin = malloc(file_size(&job->truth));
    find_key(def, job->truth.key);
    dip_srgb_encode_table(&job->encode);
    if (!job->truth.rgb_lin) {
        out_of_memory(err);
        dip_truth_job_destroy(&job);
        return NULL;
    }
    job->truth.rgba8 = (uint8_t *)(job->truth.rgb_lin + 3 * pixel_count(job));
    job->truth.classes = job->truth.rgba8 + 4 * pixel_count(job);
    return job;
}

void dip_truth_job_destroy(DipTruthJob **job) {
    if (*job) {
        free_halves(*job);
        dip_truth_free(&(*job)->truth);
        free(*job);
        *job = NULL;
    }
}

// --- drawing -----------------------------------------------------------------------------------

static DipStep prepare(DipTruthJob *job, DipError *err) {
    const DipTruthDef *def = &job->def;
    const size_t pixels = pixel_count(job);
    bool made = true;
    for (int h = 0; h < HALVES; h++) {
        Half *half = &job->halves[h];
        half->lin = malloc(pixels * (3 * sizeof(double) + 3 * sizeof(float) + 4));
        if (!half->lin) {
            out_of_memory(err);
            return DIP_STEP_FAILED;
        }
        half->rounded = (float *)(half->lin + 3 * pixels);
        half->rgba8 = (uint8_t *)(half->rounded + 3 * pixels);
    }
    if (def->draw) {
        // The caller's function does not say what the pixels show.
        memset(job->truth.classes, DIP_SEEN_TEXTURED, pixels);
    } else {
        dip_reference_set_time(def->reference, def->time_ns);
        job->convergence =
            dip_convergence_create(def->reference, &def->pose, def->width, def->height, err);
        made = job->convergence != NULL;
    }
    job->phase = DRAW;
    return made ? DIP_STEP_WORKING : DIP_STEP_FAILED;
}

// Returns the number of parts in which a half is drawn: tiles, or 1 if the def's function draws.
static int part_count(const DipTruthJob *job) {
    return job->convergence ? dip_convergence_tile_count(job->convergence) : 1;
}

typedef struct Tiles {
    DipTruthJob *job;
    int half;
    int first;
    atomic_bool failed;
} Tiles;

static void draw_tile(void *context, int index, int worker) {
    (void)worker;
    Tiles *tiles = context;
    DipTruthJob *job = tiles->job;
    if (!dip_convergence_add_tile(job->convergence, tiles->first + index, samples_of_level(job),
                                  (uint32_t)tiles->half + 1, 1.0, job->halves[tiles->half].lin,
                                  tiles->half == 0 ? job->truth.classes : NULL, NULL)) {
        tiles->failed = true;
    }
}

static bool draw_tiles(DipTruthJob *job, DipError *err) {
    const int parts = part_count(job);
    Tiles tiles = {.job = job, .half = job->drawn / parts, .first = job->drawn % parts};
    const int most = job->live ? 1 : TILES_AT_ONCE;
    const int count = parts - tiles.first < most ? parts - tiles.first : most;
    dip_pool_run(job->pool, count, draw_tile, &tiles);
    job->drawn += count;
    return !tiles.failed || out_of_memory(err);
}

static DipStep draw(DipTruthJob *job, DipError *err) {
    const int half = job->drawn / part_count(job);
    if (job->drawn % part_count(job) == 0) {
        memset(job->halves[half].lin, 0, pixel_count(job) * 3 * sizeof(double));
    }
    if (!job->def.draw) {
        if (!draw_tiles(job, err)) {
            return DIP_STEP_FAILED;
        }
    } else if (job->def.draw(&job->def, half, job->halves[half].lin, err)) {
        job->drawn++;
    } else {
        return DIP_STEP_FAILED;
    }
    job->phase = job->drawn == HALVES * part_count(job) ? JOIN : DRAW;
    return DIP_STEP_WORKING;
}

// --- the mean and the floor ----------------------------------------------------------------------

// Writes linear light twice: as floats, and clamped to 0..1 and encoded to 8-bit sRGB with alpha
// 255.
static void round_light(const DipTruthJob *job, const double *lin, size_t pixels, float *rounded,
                        uint8_t *rgba8) {
    for (size_t i = 0; i < pixels; i++) {
        for (size_t c = 0; c < 3; c++) {
            const double value = fmin(fmax(lin[3 * i + c], 0.0), 1.0);
            rounded[3 * i + c] = (float)lin[3 * i + c];
            rgba8[4 * i + c] = dip_srgb_code(&job->encode, (int)(value * DIP_LINEAR16_MAX + 0.5));
        }
        rgba8[4 * i + 3] = 255;
    }
}

static DipSrgbPicture half_picture(const DipTruthJob *job, int half) {
    return (DipSrgbPicture){job->halves[half].rgba8, 4 * (size_t)job->def.width, job->def.width,
                            job->def.height};
}

// Prepares the comparison of the halves. For all levels but the last, only squared differences are
// measured.
static bool begin_floor(DipTruthJob *job, DipError *err) {
    const DipTruthDef *def = &job->def;
    const bool last = job->level == DIP_TRUTH_LEVELS - 1;
    const DipSrgbPicture first = half_picture(job, 0);
    const DipMeterStandard standard = {.picture = half_picture(job, 1),
                                       .rgb_lin = job->halves[1].rounded,
                                       .classes = job->truth.classes};
    dip_meter_free(&job->meter);
    if (!dip_meter_init(&job->meter, last ? DIP_METER_PICTURES : DIP_METER_DIFFERENCES, def->width,
                        def->height, def->pixels_per_degree)) {
        return out_of_memory(err);
    }
    dip_meter_set_standard(&job->meter, &standard);
    dip_meter_begin(&job->meter, &first, job->halves[0].rounded);
    job->phase = MEASURE_FLOOR;
    return true;
}

// Computes the mean of the halves for the next pixels. Only this step sets the floating-point mode:
// the others call functions that set it themselves, or the caller's function `draw`, which runs in
// the caller's mode.
static DipStep join_halves(DipTruthJob *job, DipError *err) {
    DIP_FP_MODE_SCOPE();
    const size_t from = job->joined;
    const size_t left = pixel_count(job) - from;
    const size_t count = left < PIXELS_AT_ONCE ? left : PIXELS_AT_ONCE;
    job->has_truth = false;
    for (int h = 0; h < HALVES; h++) {
        const Half *half = &job->halves[h];
        round_light(job, half->lin + 3 * from, count, half->rounded + 3 * from,
                    half->rgba8 + 4 * from);
    }
    double *mean = job->halves[0].lin + 3 * from;
    for (size_t i = 0; i < 3 * count; i++) {
        mean[i] = 0.5 * (mean[i] + job->halves[1].lin[3 * from + i]);
    }
    round_light(job, mean, count, job->truth.rgb_lin + 3 * from, job->truth.rgba8 + 4 * from);
    job->joined += count;
    return count < left || begin_floor(job, err) ? DIP_STEP_WORKING : DIP_STEP_FAILED;
}

static DipStep measure_floor(DipTruthJob *job, DipError *err) {
    const DipStep step = dip_meter_step(&job->meter);
    if (step == DIP_STEP_FAILED) {
        out_of_memory(err);
    }
    if (step != DIP_STEP_DONE) {
        return step;
    }
    job->truth.floor = job->meter.sums;
    job->truth.samples = HALVES * samples_of_level(job);
    job->has_truth = true;
    if (job->level < DIP_TRUTH_LEVELS - 1) {
        next_level(job);
        job->phase = DRAW;
    } else {
        dip_meter_end_burst(&job->meter, &job->truth.floor);
        free_halves(job);
        job->phase = job->cache ? STORE : END;
    }
    return DIP_STEP_RESULT;
}

// --- the job -------------------------------------------------------------------------------------

static DipStep load(DipTruthJob *job) {
    job->has_truth = load_file(&job->truth, job->cache);
    job->phase = job->has_truth ? END : PREPARE;
    job->truth.samples = HALVES * job->def.samples;
    return job->has_truth ? DIP_STEP_RESULT : DIP_STEP_WORKING;
}

// Writes the truth to the cache. A live job does not fail if this fails.
static DipStep store(DipTruthJob *job, DipError *err) {
    job->phase = END;
    if (job->live && cache_bytes(job->cache) > LIVE_CACHE_BYTES) {
        return DIP_STEP_DONE;
    }
    return store_file(&job->truth, job->cache, job->live ? NULL : err) || job->live
               ? DIP_STEP_DONE
               : DIP_STEP_FAILED;
}

DipStep dip_truth_job_step(DipTruthJob *job, DipError *err) {
    switch (job->phase) {
    case LOAD:
        return load(job);
    case PREPARE:
        return prepare(job, err);
    case DRAW:
        return draw(job, err);
    case JOIN:
        return join_halves(job, err);
    case MEASURE_FLOOR:
        return measure_floor(job, err);
    case STORE:
        return store(job, err);
    case END:
        break;
    }
    return DIP_STEP_DONE;
}

const DipTruth *dip_truth_job_truth(const DipTruthJob *job) {
    return job->has_truth ? &job->truth : NULL;
}

double dip_truth_job_drawn(const DipTruthJob *job, int *samples) {
    DIP_FP_MODE_SCOPE();
    *samples = job->phase < STORE ? HALVES * samples_of_level(job) : 0;
    double share = job->phase >= DRAW && job->phase < STORE
                       ? (double)job->drawn / (HALVES * part_count(job))
                       : 0.0;
    DIP_FP_PIN(share);
    return share;
}

bool dip_truth_get(DipTruth *truth, const DipTruthDef *def, const char *cache, DipPool *pool,
                   DipTruthProgress *progress, void *context, DipError *err) {
    DipTruthJob *job = dip_truth_job_create(def, cache, pool, false, err);
    DipStep step = job ? DIP_STEP_WORKING : DIP_STEP_FAILED;
    while (step == DIP_STEP_WORKING || step == DIP_STEP_RESULT) {
        int samples;
        const bool draws = job->phase == DRAW;
        step = dip_truth_job_step(job, err);
        if (draws && progress && step == DIP_STEP_WORKING &&
            !progress(context, dip_truth_job_drawn(job, &samples))) {
            dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "truth", "interrupted");
            step = DIP_STEP_FAILED;
        }
    }
    *truth = (DipTruth){0};
    if (step == DIP_STEP_DONE) {
        *truth = job->truth;
        job->truth = (DipTruth){0};
    }
    dip_truth_job_destroy(&job);
    return step == DIP_STEP_DONE;
}

double dip_truth_floor_rmse(const DipMetricSums *floor, int region) {
    // The error of the mean of two independent halves is half of their difference. Halving is exact
    // in every floating-point mode.
    return dip_metrics_of(floor, region).rmse_lin / 2.0;
}

bool dip_truth_hides(const DipMetricSums *floor, const DipMetricSums *sums) {
    DIP_FP_MODE_SCOPE();
    double least = 3.0 * dip_truth_floor_rmse(floor, 0);
    double error = dip_metrics_of(sums, 0).rmse_lin;
    DIP_FP_PIN(least);
    DIP_FP_PIN(error);
    return error < least;
}

DipMeterStandard dip_truth_standard(const DipTruth *truth) {
    return (DipMeterStandard){
        .picture = {truth->rgba8, 4 * (size_t)truth->width, truth->width, truth->height},
        .rgb_lin = truth->rgb_lin,
        .classes = truth->classes,
    };
}

void dip_truth_free(DipTruth *truth) {
    free(truth->rgb_lin);
    *truth = (DipTruth){0};
}
