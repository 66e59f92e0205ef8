// Gives changed glTF files to the readers in this process, where a sanitizer sees all that they do.
// (fuzz_model.c gives any bytes to the importer's process instead.)
//
// Each file must be refused with a reason, or be read into a scene that the renderer draws. The
// same numbers of the command line always make the same files, so that a fault can be repeated:
// the last line of the output names the file at fault.
#include "assets/animation.h"
#include "assets/cameras.h"
#include "assets/model.h"
#include "renderer/scene/renderer.h"
#include "tests/assets/same_scene.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/gltf/mutate.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_SEEDS = 64, ROOM_BYTES = 1 << 18, WIDTH = 24, HEIGHT = 16 };
// Larger models are slow, but reach no other code.
enum { MOST_TRIANGLES = 2000, MOST_VERTICES = 1 << 18, MOST_TEXELS = 1 << 18 };

static const char usage[] =
    "Usage: gltf_mutants --count N [--first N] [--keep FOLDER] FILE...\n"
    "Reads N changed copies of the model files and draws what the readers accept.\n"
    "  --first N       Number of the first copy. The default is 0.\n"
    "  --keep FOLDER   Write each copy into this folder, and leave it there.\n";

typedef struct Seed {
    const char *file;
    const char *ending; // gltf or glb
    uint8_t *bytes;
    size_t size_bytes;
} Seed;

typedef struct Options {
    uint64_t first;
    uint64_t count;
    const char *keep;
    Seed seeds[MOST_SEEDS];
    size_t seed_count;
} Options;

// How often something was done.
typedef struct Tally {
    uint64_t models;
    uint64_t drawn;
    uint64_t animated;
    uint64_t cameras;
} Tally;

#if defined(__SANITIZE_ADDRESS__)
#define ASAN 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define ASAN 1
#endif
#endif

#ifdef ASAN
// A file may describe so much that memory runs out, which the readers must survive.
const char *__asan_default_options(void);
const char *__asan_default_options(void) {
    return "allocator_may_return_null=1:max_allocation_size_mb=1024";
}
#endif

// --- checks --------------------------------------------------------------------------------------

static void check_refused(const DipError *err) {
    FUZZ_CHECK(err->code != DIP_ERROR_NONE && err->message[0] && err->file[0]);
    FUZZ_CHECK(!strchr(err->message, '\n'));
}

static void check_warnings(const DipErrorList *warnings) {
    for (size_t i = 0; i < warnings->count; i++) {
        FUZZ_CHECK(warnings->items[i].message[0] && !strchr(warnings->items[i].message, '\n'));
    }
}

static bool is_small(const DipSceneDef *scene) {
    uint64_t triangles = 0;
    uint64_t texels = 0;
    for (int i = 0; i < scene->object_count; i++) {
        triangles += scene->meshes[scene->objects[i].mesh].index_count / 3;
    }
    for (int i = 0; i < scene->texture_count; i++) {
        texels += (uint64_t)scene->textures[i].width * (uint64_t)scene->textures[i].height;
    }
    return triangles <= MOST_TRIANGLES && texels <= MOST_TEXELS;
}

// Draws a frame with random settings, from a little before the models, which lie near the origin.
// Returns false if the renderer refuses the settings.
static bool draw(const DipScene *scene, DipPool *pool, Random *random) {
    DipRendererDef def = dip_renderer_default_def();
    def.pool = pool;
    def.width = WIDTH;
    def.height = HEIGHT;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        const int steps = dip_setting_info((DipSetting)s)->step_count;
        def.quality.step[s] =
            (uint8_t)(random_int(random, 0, 1) * random_int(random, 0, steps - 1));
    }
    DipError err = {0};
    DipRenderer *renderer = dip_renderer_create(&def, &err);
    if (!renderer) {
        FUZZ_CHECK(err.code != DIP_ERROR_NONE && err.message[0]);
        return false;
    }
    const DipPose pose = {.position_world = {random_real(random, -0.5, 1.5), 0.5, 1.7},
                          .orientation = {0.0, 0.0, 0.0, 1.0},
                          .fov_y_deg = 70.0};
    DipFrame frame;
    const bool drawn = dip_renderer_draw(renderer, scene, &pose, 0, &frame, &err);
    FUZZ_CHECK(drawn || (err.code != DIP_ERROR_NONE && err.message[0]));
    static uint8_t pixels[HEIGHT][4 * WIDTH];
    unsigned sum = 0;
    for (int y = 0; drawn && y < HEIGHT; y++) {
        memcpy(pixels[y], frame.rgba8 + (size_t)y * frame.stride_bytes, sizeof pixels[y]);
        for (int i = 0; i < 4 * WIDTH; i++) {
            sum += pixels[y][i];
        }
    }
    FUZZ_CHECK(!drawn || sum > 0); // Alpha is not 0. The memory sanitizer sees that all is written.
    dip_renderer_destroy(&renderer);
    return drawn;
}

static void read_model(const char *file, DipPool *pool, Random *random, Tally *tally) {
    const DipModelOptions options = {.normal_maps = true};
    DipErrorList warnings = {0};
    DipError err = {0};
    DipModel *model = dip_model_load_with(&file, 1, &options, NULL, &warnings, &err);
    if (model) {
        const DipSceneDef *def = dip_model_scene_def(model);
        read_whole_scene(def);
        DipScene *scene = dip_scene_create(def, NULL, &err);
        FUZZ_CHECK(scene || (err.code != DIP_ERROR_NONE && err.message[0]));
        tally->models++;
        tally->drawn += scene && is_small(def) && draw(scene, pool, random);
        dip_scene_destroy(&scene);
    } else {
        check_refused(&err);
    }
    check_warnings(&warnings);
    dip_error_list_free(&warnings);
    dip_model_destroy(&model);
}

static void check_poses(const DipAnimatedModel *model, const DipAnimatedDef *def) {
    static const double times_s[] = {0.0, 0.3, 1e9};
    DipAnimatedPose *pose = dip_animated_pose_create(model, NULL);
    FUZZ_CHECK(pose != NULL);
    for (size_t t = 0; t < sizeof times_s / sizeof *times_s; t++) {
        const int count = def->animation_count;
        dip_animated_pose_set(pose, count > 0 ? (int)t % count : 0, times_s[t]);
        for (int i = 0; i < def->object_count; i++) {
            const uint32_t vertices = def->meshes[def->objects[i].mesh].vertex_count;
            float *both = malloc(6 * sizeof(float) * vertices);
            FUZZ_CHECK(both != NULL);
            dip_animated_pose_vertices(pose, i, both, both + 3 * (size_t)vertices);
            for (size_t k = 3 * (size_t)vertices; k < 6 * (size_t)vertices; k++) {
                FUZZ_CHECK(isfinite(both[k])); // The normals. Positions may overflow.
            }
            free(both);
        }
    }
    dip_animated_pose_destroy(&pose);
}

static void read_animated(const char *file, Tally *tally) {
    DipErrorList warnings = {0};
    DipError err = {0};
    DipAnimatedModel *model = dip_animated_model_load(file, NULL, &warnings, &err);
    if (model) {
        const DipAnimatedDef *def = dip_animated_model_def(model);
        uint64_t vertices = 0;
        for (int i = 0; i < def->object_count; i++) {
            const DipAnimatedMesh *mesh = &def->meshes[def->objects[i].mesh];
            vertices += (uint64_t)mesh->shape_count * mesh->vertex_count;
        }
        if (vertices <= MOST_VERTICES) {
            check_poses(model, def);
        }
        tally->animated++;
    } else {
        check_refused(&err);
    }
    check_warnings(&warnings);
    dip_error_list_free(&warnings);
    dip_animated_model_destroy(&model);
}

static void read_cameras(const char *file, Tally *tally) {
    DipError err = {0};
    DipModelCameras *cameras = dip_model_cameras_load(file, DIP_UP_auto, NULL, &err);
    if (cameras) {
        tally->cameras++;
    } else {
        check_refused(&err);
    }
    dip_model_cameras_destroy(&cameras);
}

// --- files ---------------------------------------------------------------------------------------

// glTF 1 is read by assimp, which promises less about malformed files.
static bool is_version_1(const uint8_t *bytes, size_t size_bytes) {
    static const char *const texts[] = {"\"version\":\"1", "\"version\": \"1"};
    for (size_t t = 0; t < sizeof texts / sizeof *texts; t++) {
        const size_t length = strlen(texts[t]);
        for (size_t i = 0; i + length <= size_bytes; i++) {
            if (memcmp(bytes + i, texts[t], length) == 0) {
                return true;
            }
        }
    }
    return false;
}

// Makes copy `number` of the model files, and reads it.
static void read_copy(const Options *options, uint64_t number, DipPool *pool, Tally *tally) {
    static uint8_t bytes[ROOM_BYTES];
    Random random = {number};
    const Seed *seed = &options->seeds[random_u64(&random) % options->seed_count];
    memcpy(bytes, seed->bytes, seed->size_bytes);
    const size_t size_bytes = mutate_gltf(&random, bytes, seed->size_bytes, sizeof bytes);
    if (is_version_1(bytes, size_bytes)) {
        return;
    }
    printf("--first %" PRIu64 " --count 1, from %s\n", number, seed->file);
    fflush(stdout);
    char name[64];
    snprintf(name, sizeof name, "copy%" PRIu64 ".%s", number, seed->ending);
    const char *file = fuzz_write(name, bytes, size_bytes);
    if (options->keep) {
        char kept[1024];
        snprintf(kept, sizeof kept, "%s/%s", options->keep, name);
        FILE *out = fopen(kept, "wb");
        FUZZ_CHECK(out && fwrite(bytes, 1, size_bytes, out) == size_bytes && fclose(out) == 0);
    }
    read_model(file, pool, &random, tally);
    read_animated(file, tally);
    read_cameras(file, tally);
    remove(file);
}

// Returns false if the file cannot be read or is too large.
static bool load_seed(const char *file, Options *options) {
    Seed *seed = &options->seeds[options->seed_count];
    const char *dot = strrchr(file, '.');
    FILE *in = fopen(file, "rb");
    uint8_t *bytes = malloc(ROOM_BYTES / 2);
    if (!in || !bytes || !dot || options->seed_count == MOST_SEEDS) {
        fprintf(stderr, "gltf_mutants: %s cannot be read\n", file);
        return false;
    }
    *seed = (Seed){.file = file, .ending = dot + 1, .bytes = bytes};
    seed->size_bytes = fread(bytes, 1, ROOM_BYTES / 2, in);
    fclose(in);
    options->seed_count++;
    return seed->size_bytes < ROOM_BYTES / 2;
}

static bool parse_options(int argc, char **argv, Options *options) {
    for (int i = 1; i < argc; i++) {
        const bool has_value = i + 1 < argc;
        if (strcmp(argv[i], "--first") == 0 && has_value) {
            options->first = strtoull(argv[++i], NULL, 10);
        } else if (strcmp(argv[i], "--count") == 0 && has_value) {
            options->count = strtoull(argv[++i], NULL, 10);
        } else if (strcmp(argv[i], "--keep") == 0 && has_value) {
            options->keep = argv[++i];
        } else if (!load_seed(argv[i], options)) {
            return false;
        }
    }
    return options->count > 0 && options->seed_count > 0;
}

int main(int argc, char **argv) {
    static Options options;
    Tally tally = {0};
    if (!parse_options(argc, argv, &options)) {
        fputs(usage, stderr);
        return 2;
    }
    DipPool *pool = dip_pool_create(1, NULL);
    FUZZ_CHECK(pool != NULL);
    for (uint64_t i = 0; i < options.count; i++) {
        read_copy(&options, options.first + i, pool, &tally);
    }
    printf("%" PRIu64 " copies: %" PRIu64 " became models, of which %" PRIu64
           " were drawn; %" PRIu64 " became animated models; the cameras of %" PRIu64
           " were read\n",
           options.count, tally.models, tally.drawn, tally.animated, tally.cameras);
    dip_pool_destroy(&pool);
    for (size_t i = 0; i < options.seed_count; i++) {
        free(options.seeds[i].bytes);
    }
    return 0;
}
