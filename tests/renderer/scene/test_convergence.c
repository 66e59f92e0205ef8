// Tests that the settings improve the picture: along the courtyard's paths, the error against the
// converged reference must fall at every step of antialiasing and of anisotropic filtering.
//
// Usage: test_convergence [--samples N] [--frames N] [--size WxH]
// The error is the RMS over all pixels and channels of the path's frames, in linear light.
#include "assets/model.h"
#include "campaths/campath.h"
#include "renderer/base/srgb.h"
#include "renderer/reference/reference.h"
#include "renderer/scene/renderer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_ROWS = 16, MAX_FRAMES = 64 };

typedef struct Options {
    int samples;
    int frames;
    int width;
    int height;
} Options;

typedef struct Bench {
    Options options;
    DipPool *pool;
    DipModel *model;
    DipScene *scene;
    DipReference *reference;
    DipRenderer *renderer;
    DipSrgbDecodeTable srgb;
    double *truth; // the converged pictures of all frames, which count as exact
} Bench;

// A path and a list of settings whose errors must fall from row to row.
typedef struct Sweep {
    const char *path;
    double fov_y_deg;
    int row_count;
    const char *rows[MAX_ROWS];
} Sweep;

static const Sweep sweeps[] = {
    {"aa",
     45.0,
     5,
     {"aa=none,af=16,aaf=on", "aa=2,af=16,aaf=on", "aa=4,af=16,aaf=on", "aa=6,af=16,aaf=on",
      "aa=8,af=16,aaf=on"}},
    {"aa", 45.0, 5, {"aa=none", "aa=2", "aa=4", "aa=6", "aa=8"}},
    {"af", 55.0, 5, {"aa=8,af=none", "aa=8,af=2", "aa=8,af=4", "aa=8,af=8", "aa=8,af=16"}},
    {"af", 55.0, 5, {"af=none", "af=2", "af=4", "af=8", "af=16"}},
    {"af",
     55.0,
     5,
     {"aa=8,aaf=on", "aa=8,af=2,aaf=on", "aa=8,af=4,aaf=on", "aa=8,af=8,aaf=on",
      "aa=8,af=16,aaf=on"}},
    {"af", 55.0, 3, {"aa=8,opt=advanced", "aa=8,opt=standard", "aa=8"}},
    {"af", 55.0, 3, {"aa=8,af=16,opt=advanced", "aa=8,af=16,opt=standard", "aa=8,af=16"}},
    {"miplod",
     50.0,
     6,
     {"aa=8,miplod=high-performance", "aa=8,miplod=performance", "aa=8,miplod=quality",
      "aa=8,miplod=high-quality", "aa=8,miplod=sharp", "aa=8,miplod=sharper"}},
    {"miplod", 50.0, 3, {"aa=8,opt=advanced", "aa=8,opt=standard", "aa=8"}},
    {"aa", 45.0, 4, {"scale=1", "scale=1.25", "scale=1.5", "scale=2"}},
    {"aaa", 45.0, 2, {"aa=2", "aa=2,aaa=on"}},
    {"aaa", 45.0, 4, {"aa=4", "aa=4,aaa=coverage", "aa=4,aaa=on", "aa=4,aaa=all"}},
    {"aaa", 45.0, 3, {"aa=8", "aa=8,aaa=coverage", "aa=8,aaa=all"}},
    {"aaa", 45.0, 4, {"aa=2", "aa=2,aaa=all", "aa=4,aaa=all", "aa=8,aaa=all"}},
    {"aaa", 45.0, 3, {"aa=4", "aa=4,aaa=on,asd=2", "aa=4,aaa=on"}},
    {"aaa", 45.0, 4, {"aa=6", "aa=6,aaa=on,asd=3", "aa=6,aaa=on,asd=2", "aa=6,aaa=on"}},
    {"aaa", 45.0, 4, {"aa=8", "aa=8,aaa=on,asd=4", "aa=8,aaa=on,asd=2", "aa=8,aaa=on"}},
    {"aaa", 45.0, 5, {"aaa=on", "aa=2,aaa=on", "aa=4,aaa=on", "aa=6,aaa=on", "aa=8,aaa=on"}},
    {"aaa",
     45.0,
     4,
     {"aa=8,af=16", "aa=8,aaa=on,asd=4,af=16", "aa=8,aaa=on,asd=2,af=16", "aa=8,aaa=on,af=16"}},
};

static bool fail(const char *what, const DipError *err) {
    char text[512] = "";
    if (err) {
        dip_error_format(err, text, sizeof text);
    }
    fprintf(stderr, "%s %s\n", what, text);
    return false;
}

static bool open_bench(Bench *bench) {
    const char *file = DIP_SOURCE_DIR "/assets/courtyard/court.gltf";
    DipError err = {0};
    DipRendererDef def = dip_renderer_default_def();
    const size_t values = (size_t)bench->options.width * (size_t)bench->options.height * 3;
    dip_srgb_decode_table(&bench->srgb);
    bench->truth = malloc((size_t)bench->options.frames * values * sizeof *bench->truth);
    bench->pool = dip_pool_create(0, &err);
    bench->model =
        bench->pool ? dip_model_load_with_normals(&file, 1, bench->pool, NULL, &err) : NULL;
    if (!bench->model || !bench->truth) {
        return fail("cannot load:", &err);
    }
    const DipSceneDef *scene = dip_model_scene_def(bench->model);
    bench->scene = dip_scene_create(scene, bench->pool, &err);
    bench->reference = dip_reference_create(scene, &err);
    def.pool = bench->pool;
    def.width = bench->options.width;
    def.height = bench->options.height;
    bench->renderer = dip_renderer_create(&def, &err);
    return (bench->scene && bench->reference && bench->renderer) || fail("cannot load:", &err);
}

static void close_bench(Bench *bench) {
    dip_renderer_destroy(&bench->renderer);
    dip_reference_destroy(&bench->reference);
    dip_scene_destroy(&bench->scene);
    dip_model_destroy(&bench->model);
    dip_pool_destroy(&bench->pool);
    free(bench->truth);
}

static DipPose pose_at(const Bench *bench, const DipCamPath *path, double fov_y_deg, int frame) {
    const DipCamPathInfo info = dip_campath_info(path);
    DipPose pose = {.fov_y_deg = fov_y_deg};
    dip_campath_sample(path, info.duration_ns * frame / bench->options.frames, &pose);
    return pose;
}

typedef struct TruthJobs {
    Bench *bench;
    const DipPose *poses;
    bool failed;
} TruthJobs;

static void converge(void *context, int index, int worker) {
    (void)worker;
    TruthJobs *jobs = context;
    const Options *options = &jobs->bench->options;
    double *truth =
        jobs->bench->truth + (size_t)index * (size_t)options->width * (size_t)options->height * 3;
    if (!dip_reference_converge(jobs->bench->reference, &jobs->poses[index], options->width,
                                options->height, options->samples, (uint32_t)index + 1, truth,
                                NULL)) {
        jobs->failed = true;
    }
}

static double squared_error(const Bench *bench, const DipFrame *frame, const double *truth) {
    double sum = 0.0;
    for (int y = 0; y < frame->height; y++) {
        const uint8_t *row = frame->rgba8 + (size_t)y * frame->stride_bytes;
        for (int x = 0; x < frame->width; x++) {
            for (int c = 0; c < 3; c++) {
                const double e = bench->srgb.linear[row[4 * x + c]] - *truth++;
                sum += e * e;
            }
        }
    }
    return sum;
}

static bool measure(Bench *bench, const char *settings, const DipPose *poses, double *rms) {
    DipError err = {0};
    DipQuality quality;
    const size_t values = (size_t)bench->options.width * (size_t)bench->options.height * 3;
    double sum = 0.0;
    if (!dip_quality_parse(settings, &quality, &err) ||
        !dip_renderer_set_quality(bench->renderer, &quality, &err)) {
        return fail(settings, &err);
    }
    for (int f = 0; f < bench->options.frames; f++) {
        DipFrame frame;
        if (!dip_renderer_draw(bench->renderer, bench->scene, &poses[f], 0, &frame, &err)) {
            return fail("cannot draw:", &err);
        }
        sum += squared_error(bench, &frame, bench->truth + (size_t)f * values);
    }
    *rms = sqrt(sum / ((double)values * bench->options.frames));
    return true;
}

static bool run_sweep(Bench *bench, const Sweep *sweep, const DipPose *poses) {
    double last = INFINITY;
    bool falls = true;
    printf("path %s\n", sweep->path);
    for (int r = 0; r < sweep->row_count; r++) {
        double rms;
        if (!measure(bench, sweep->rows[r], poses, &rms)) {
            return false;
        }
        printf("  %-32s %.6f%s\n", sweep->rows[r], rms, rms < last ? "" : "  does not fall");
        falls = falls && rms < last;
        last = rms;
    }
    fflush(stdout);
    return falls;
}

// Runs every sweep. Converges the frames of each path only once.
static bool run_all(Bench *bench) {
    bool passed = true;
    const char *truth_of = "";
    static DipPose poses[MAX_FRAMES];
    for (size_t s = 0; s < sizeof sweeps / sizeof *sweeps; s++) {
        const Sweep *sweep = &sweeps[s];
        if (strcmp(truth_of, sweep->path) != 0) {
            char file[256];
            DipError err = {0};
            DipCamPath *path;
            snprintf(file, sizeof file, DIP_SOURCE_DIR "/campaths/%s.pth", sweep->path);
            if (!dip_campath_load(file, &path, &err)) {
                return fail("cannot load:", &err);
            }
            for (int f = 0; f < bench->options.frames; f++) {
                poses[f] = pose_at(bench, path, sweep->fov_y_deg, f);
            }
            dip_campath_destroy(&path);
            TruthJobs jobs = {bench, poses, false};
            dip_pool_run(bench->pool, bench->options.frames, converge, &jobs);
            if (jobs.failed) {
                return fail("the reference failed", NULL);
            }
            truth_of = sweep->path;
        }
        passed = run_sweep(bench, sweep, poses) && passed;
    }
    return passed;
}

static bool parse_options(int argc, char **argv, Options *options) {
    *options = (Options){.samples = 64, .frames = 2, .width = 160, .height = 120};
    for (int i = 1; i + 1 < argc; i += 2) {
        if (strcmp(argv[i], "--samples") == 0) {
            options->samples = atoi(argv[i + 1]);
        } else if (strcmp(argv[i], "--frames") == 0) {
            options->frames = atoi(argv[i + 1]);
        } else if (strcmp(argv[i], "--size") != 0 ||
                   sscanf(argv[i + 1], "%dx%d", &options->width, &options->height) != 2) {
            return false;
        }
    }
    return argc % 2 == 1 && options->frames >= 1 && options->frames <= MAX_FRAMES;
}

int main(int argc, char **argv) {
    static Bench bench;
    if (!parse_options(argc, argv, &bench.options)) {
        fprintf(stderr, "usage: test_convergence [--samples N] [--frames N] [--size WxH]\n");
        return 2;
    }
    const bool passed = open_bench(&bench) && run_all(&bench);
    close_bench(&bench);
    return passed ? 0 : 1;
}
