// Draws the courtyard along the ambient path, with every step of antialiasing and filtering, every
// thread count and every instruction set. The hashes of all pictures must equal the hashes in a
// list, also while tiles are recorded. The gcc and clang builds share this list. The test fails if
// a hash is missing or different, or if any work counter differs.
//
// Usage: test_determinism LIST [--write] [--every N] [--size WxH] [--half N]. --write creates the
// list with the scalar kernels on one thread. --every N draws every N-th frame of the path instead
// of the list's few frames, and compares the pictures of the runs with each other instead of with
// the list. --half 0 and --half 1 draw each instruction set with one of both thread counts, in
// turns; together they draw everything.
#include "assets/model.h"
#include "campaths/campath.h"
#include "renderer/scene/renderer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_SETTINGS = 80, FEW = 3, FRAMES_PER_SECOND = 30 };

typedef struct Options {
    const char *list;
    bool write;
    int every; // value of --every; 0 draws only the frames of the list
    int width;
    int height;
    int half; // value of --half; -1 draws both halves
} Options;

typedef struct Stage {
    DipCamPath *path;
    DipScene *scene;
    char settings[MAX_SETTINGS][64];
    int settings_count;
    int frames[4096];
    int frame_count;
    Options options;
    DipCounters *work; // counters of the first run, per setting and frame
    bool work_known;
} Stage;

static int fail(const char *what, const DipError *err) {
    char text[512] = "";
    if (err) {
        dip_error_format(err, text, sizeof text);
    }
    fprintf(stderr, "%s %s\n", what, text);
    return 1;
}

static bool load(Stage *stage) {
    const char *file = DIP_SOURCE_DIR "/assets/courtyard/court.gltf";
    DipError err;
    DipPool *pool = dip_pool_create(0, &err);
    DipModel *model = pool ? dip_model_load_with_normals(&file, 1, pool, NULL, &err) : NULL;
    stage->scene = model ? dip_scene_create(dip_model_scene_def(model), pool, &err) : NULL;
    const bool loaded = stage->scene && dip_campath_load(DIP_SOURCE_DIR "/campaths/ambient.pth",
                                                         &stage->path, &err);
    dip_model_destroy(&model);
    dip_pool_destroy(&pool);
    return loaded || !fail("cannot load:", &err);
}

static void list_settings(Stage *stage) {
    static const char *const more[] = {"af=4,aaf=on",
                                       "af=16,aaf=on",
                                       "aa=4,miplod=quality",
                                       "af=8,miplod=performance",
                                       "miplod=high-performance",
                                       "mipdebug=on",
                                       "aa=2,taa=on",
                                       "aa=4,taa=on",
                                       "aa=6,taa=on",
                                       "aa=8,taa=on",
                                       "aa=2,aaa=on",
                                       "aa=4,aaa=on",
                                       "aa=4,aaa=on,asd=2",
                                       "aa=6,aaa=on",
                                       "aa=6,aaa=on,asd=2",
                                       "aa=6,aaa=on,asd=3",
                                       "aa=8,aaa=on",
                                       "aa=8,aaa=on,asd=2,af=16",
                                       "aa=8,taa=on,aaa=on,asd=4",
                                       "gi=off",
                                       "gi=off,aa=4,af=16,opt=advanced",
                                       "opt=standard",
                                       "opt=standard,aa=4,af=16",
                                       "opt=advanced",
                                       "opt=advanced,af=4",
                                       "opt=advanced,af=16,aaf=on",
                                       "opt=advanced,aa=8,aaa=on,asd=2,miplod=quality",
                                       "opt=advanced,mipdebug=on",
                                       "miplod=sharp",
                                       "aa=4,af=16,miplod=sharper",
                                       "aa=2,aaa=coverage",
                                       "aa=4,aaa=coverage",
                                       "aa=6,taa=on,aaa=coverage",
                                       "aa=8,aaa=coverage,af=16,aaf=on",
                                       "aa=2,aaa=all",
                                       "aa=4,aaa=all",
                                       "aa=8,aaa=all,asd=4,af=16,opt=advanced",
                                       "scale=2",
                                       "aa=4,scale=1.25",
                                       "af=16,miplod=sharp,scale=1.5"};
    const DipSettingInfo *aa = dip_setting_info(DIP_SETTING_AA);
    const DipSettingInfo *af = dip_setting_info(DIP_SETTING_AF);
    for (int a = 0; a < aa->step_count; a++) {
        for (int f = 0; f < af->step_count; f++) {
            snprintf(stage->settings[stage->settings_count++], sizeof stage->settings[0],
                     "aa=%s,af=%s", aa->steps[a], af->steps[f]);
        }
    }
    for (size_t i = 0; i < sizeof more / sizeof *more; i++) {
        snprintf(stage->settings[stage->settings_count++], sizeof stage->settings[0], "%s",
                 more[i]);
    }
}

static void list_frames(Stage *stage) {
    static const int few[FEW] = {0, 437, 901};
    const DipCamPathInfo info = dip_campath_info(stage->path);
    const int total = (int)(info.duration_ns * FRAMES_PER_SECOND / 1000000000);
    if (!stage->options.every) {
        memcpy(stage->frames, few, sizeof few);
        stage->frame_count = FEW;
    }
    for (int f = 0; stage->options.every && f < total; f += stage->options.every) {
        stage->frames[stage->frame_count++] = f;
    }
}

// A hash as text: 32 digits and the final zero byte. There is one per setting and frame.
typedef char Hash[33];

// Every run must count the same work. Keeps the counters of the first run and compares the counters
// of all other runs with them.
static bool check_work(Stage *stage, int index, const DipCounters *counters) {
    if (!stage->work_known) {
        stage->work[index] = *counters;
    }
    if (memcmp(&stage->work[index], counters, sizeof *counters) == 0) {
        return true;
    }
    fprintf(stderr, "%s frame %d: the counters differ from those of the first run\n",
            stage->settings[index / stage->frame_count], stage->frames[index % stage->frame_count]);
    return false;
}

static bool draw_all(Stage *stage, DipIsa isa, int threads, Hash *hashes) {
    DipError err;
    DipPool *pool = dip_pool_create(threads, &err);
    DipRendererDef def = dip_renderer_default_def();
    def.pool = pool;
    def.isa = isa;
    def.width = stage->options.width;
    def.height = stage->options.height;
    def.reflection = (DipReflectionDef){.width = 160, .height = 120, .level_m = 0.66};
    DipRenderer *renderer = pool ? dip_renderer_create(&def, &err) : NULL;
    // The runs with several threads record their tiles, which must not change the pictures.
    bool drawn = renderer && dip_renderer_record_tiles(renderer, threads > 1, &err);
    bool same_work = true;
    for (int s = 0; drawn && s < stage->settings_count; s++) {
        DipQuality quality;
        drawn = dip_quality_parse(stage->settings[s], &quality, &err) &&
                dip_renderer_set_quality(renderer, &quality, &err);
        for (int f = 0; drawn && f < stage->frame_count; f++) {
            const int64_t time_ns = stage->frames[f] * INT64_C(1000000000) / FRAMES_PER_SECOND;
            DipPose pose = {.fov_y_deg = 45.0};
            DipFrame frame;
            dip_campath_sample(stage->path, time_ns, &pose);
            dip_renderer_set_frame_index(renderer, (uint64_t)stage->frames[f]);
            drawn = dip_renderer_draw(renderer, stage->scene, &pose, time_ns, &frame, &err);
            if (drawn) {
                dip_frame_hash(&frame, hashes[s * stage->frame_count + f]);
                same_work =
                    check_work(stage, s * stage->frame_count + f, &frame.counters) && same_work;
            }
        }
    }
    stage->work_known = true;
    dip_renderer_destroy(&renderer);
    dip_pool_destroy(&pool);
    return drawn ? same_work : !fail("cannot draw:", &err);
}

static bool write_list(const Stage *stage, const Hash *hashes) {
    FILE *list = fopen(stage->options.list, "w");
    if (!list) {
        return !fail("cannot write the list", NULL);
    }
    for (int s = 0; s < stage->settings_count; s++) {
        for (int f = 0; f < stage->frame_count; f++) {
            fprintf(list, "%s %04d %s\n", stage->settings[s], stage->frames[f],
                    hashes[s * stage->frame_count + f]);
        }
    }
    return fclose(list) == 0;
}

static bool read_list(const Stage *stage, Hash *hashes) {
    FILE *list = fopen(stage->options.list, "r");
    bool complete = list != NULL;
    for (int i = 0; complete && i < stage->settings_count * stage->frame_count; i++) {
        char settings[64];
        int frame;
        complete = fscanf(list, "%63s %d %32s", settings, &frame, hashes[i]) == 3 &&
                   strcmp(settings, stage->settings[i / stage->frame_count]) == 0 &&
                   frame == stage->frames[i % stage->frame_count];
    }
    if (list) {
        fclose(list);
    }
    return complete || !fail("the list is missing, or has other settings or frames:", NULL);
}

static int compare(const Stage *stage, const Hash *expected, const Hash *found, DipIsa isa,
                   int threads) {
    int differences = 0;
    for (int i = 0; i < stage->settings_count * stage->frame_count; i++) {
        if (strcmp(expected[i], found[i]) != 0 && differences++ < 10) {
            fprintf(stderr, "%s, %d threads: %s frame %d: expected %s, found %s\n",
                    dip_isa_name(isa), threads, stage->settings[i / stage->frame_count],
                    stage->frames[i % stage->frame_count], expected[i], found[i]);
        }
    }
    printf("%-7s %d threads: %d pictures, %d differ\n", dip_isa_name(isa), threads,
           stage->settings_count * stage->frame_count, differences);
    fflush(stdout);
    return differences;
}

static bool parse_options(int argc, char **argv, Options *options) {
    *options =
        (Options){.list = argc > 1 ? argv[1] : NULL, .width = 320, .height = 240, .half = -1};
    for (int i = 2; i < argc; i++) {
        if (strcmp(argv[i], "--write") == 0) {
            options->write = true;
        } else if (strcmp(argv[i], "--every") == 0 && i + 1 < argc) {
            options->every = atoi(argv[++i]);
        } else if (strcmp(argv[i], "--half") == 0 && i + 1 < argc) {
            options->half = atoi(argv[++i]);
        } else if (strcmp(argv[i], "--size") == 0 && i + 1 < argc) {
            if (sscanf(argv[++i], "%dx%d", &options->width, &options->height) != 2) {
                return false;
            }
        } else {
            return false;
        }
    }
    return options->list != NULL;
}

static int run(Stage *stage, Hash *expected, Hash *found) {
    const bool own_list = stage->options.write || stage->options.every;
    if (own_list ? !draw_all(stage, DIP_ISA_SCALAR, 1, expected) : !read_list(stage, expected)) {
        return 1;
    }
    if (stage->options.write) {
        return !write_list(stage, (const Hash *)expected);
    }
    int differences = 0;
    for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
        for (int threads = 1; threads <= 2 && dip_isa_available((DipIsa)isa); threads++) {
            if (stage->options.half == (isa + threads) % 2) {
                continue;
            }
            if (!draw_all(stage, (DipIsa)isa, threads, found)) {
                return 1;
            }
            differences +=
                compare(stage, (const Hash *)expected, (const Hash *)found, (DipIsa)isa, threads);
        }
    }
    return differences != 0;
}

int main(int argc, char **argv) {
    static Stage stage;
    if (!parse_options(argc, argv, &stage.options)) {
        fprintf(stderr,
                "usage: test_determinism LIST [--write] [--every N] [--size WxH] [--half N]\n");
        return 2;
    }
    if (!load(&stage)) {
        return 1;
    }
    list_settings(&stage);
    list_frames(&stage);
    const size_t count = (size_t)stage.settings_count * (size_t)stage.frame_count;
    Hash *expected = calloc(count, sizeof *expected);
    Hash *found = calloc(count, sizeof *found);
    stage.work = calloc(count, sizeof *stage.work);
    const int result = expected && found && stage.work ? run(&stage, expected, found) : 1;
    free(expected);
    free(found);
    free(stage.work);
    dip_scene_destroy(&stage.scene);
    dip_campath_destroy(&stage.path);
    return result;
}
