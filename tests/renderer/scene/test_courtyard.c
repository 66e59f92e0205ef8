// Compares the fast renderer's pictures of the courtyard with the reference's, along every path.
//
// Usage: test_courtyard [--size WxH] [--frames N] [--time]
// --time compares nothing. It prints how long the reference takes, in milliseconds.
#include "assets/model.h"
#include "campaths/campath.h"
#include "renderer/base/clock.h"
#include "renderer/reference/reference.h"
#include "renderer/scene/renderer.h"
#include "tests/renderer/scene/image.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const paths[] = {"ambient", "aa", "af", "aaa", "miplod", "water"};

static const char *const settings[] = {
    "aa=none",
    "aa=8,af=16,aaf=on",
    "aa=4,af=16",
    "aa=6,miplod=high-performance",
    "aa=2,af=4,aaf=on,mipdebug=on",
    "aa=8,taa=on,aaa=on,asd=2",
    "aa=6,aaa=on,af=16",
    "opt=standard,aa=4",
    "opt=advanced,aa=2,af=16",
};

// Rounding changes single samples: of the fence where alpha is close to the cutoff, and of small
// triangles far away. All other pixels differ only by the rounding to 8 bits.
static const DipImageBounds bounds = {0.012, 0.02, 0.002, 1.0};

static const DipReflectionDef reflection = {.width = 80, .height = 60, .level_m = 0.66};

typedef struct Court {
    int width;
    int height;
    int frames;
    DipPool *pool;
    DipModel *model;
    DipScene *scene;
    DipReference *reference;
    DipRenderer *renderer;
    double *expected;
} Court;

static bool tell(const char *what, const DipError *err) {
    char text[640] = "";
    dip_error_format(err, text, sizeof text);
    fprintf(stderr, "%s: %s\n", what, text);
    return false;
}

static bool open_court(Court *court) {
    const char *file = DIP_SOURCE_DIR "/assets/courtyard/court.gltf";
    DipError err = {0};
    court->expected =
        malloc((size_t)court->width * (size_t)court->height * 3 * sizeof *court->expected);
    court->pool = dip_pool_create(0, &err);
    court->model =
        court->pool ? dip_model_load_with_normals(&file, 1, court->pool, NULL, &err) : NULL;
    if (!court->model || !court->expected) {
        return tell(file, &err);
    }
    const DipSceneDef *def = dip_model_scene_def(court->model);
    DipRendererDef renderer_def = dip_renderer_default_def();
    renderer_def.pool = court->pool;
    renderer_def.width = court->width;
    renderer_def.height = court->height;
    renderer_def.reflection = reflection;
    court->scene = dip_scene_create(def, court->pool, &err);
    court->reference = court->scene ? dip_reference_create(def, &err) : NULL;
    court->renderer = court->reference ? dip_renderer_create(&renderer_def, &err) : NULL;
    if (court->reference) {
        dip_reference_set_reflection(court->reference, &reflection);
    }
    return court->renderer || tell(file, &err);
}

static void close_court(Court *court) {
    dip_renderer_destroy(&court->renderer);
    dip_reference_destroy(&court->reference);
    dip_scene_destroy(&court->scene);
    dip_model_destroy(&court->model);
    dip_pool_destroy(&court->pool);
    free(court->expected);
}

static bool matches(Court *court, const char *path, int frame_index, const DipPose *pose,
                    const char *text) {
    DipError err = {0};
    DipQuality quality;
    DipFrame frame;
    if (!dip_quality_parse(text, &quality, &err) ||
        !dip_reference_draw(court->reference, &quality, pose, court->width, court->height,
                            court->expected, &err) ||
        !dip_renderer_set_quality(court->renderer, &quality, &err) ||
        !dip_renderer_draw(court->renderer, court->scene, pose, 0, &frame, &err)) {
        return tell(text, &err);
    }
    char name[160];
    snprintf(name, sizeof name, "court_%s%d_%s", path, frame_index, text);
    const DipImageError error = dip_image_compare(court->expected, &frame, bounds.pixel_lin);
    printf("%-52s rms %.5f  mean %.5f  over %.4f\n", name, error.rms_lin, error.mean_lin,
           (double)error.over_count / (frame.width * frame.height));
    return dip_image_check(name, court->expected, &frame, &bounds);
}

static void print_times(Court *court, const DipPose *pose) {
    const int64_t start_ns = dip_clock_ns();
    dip_reference_converge(court->reference, pose, court->width, court->height, 4, 1,
                           court->expected, NULL);
    printf("converge: %.1f ms a sample\n", (double)(dip_clock_ns() - start_ns) / 4e6);
    for (size_t s = 0; s < sizeof settings / sizeof settings[0]; s++) {
        DipQuality quality;
        const int64_t from_ns = dip_clock_ns();
        if (dip_quality_parse(settings[s], &quality, NULL)) {
            dip_reference_draw(court->reference, &quality, pose, court->width, court->height,
                               court->expected, NULL);
        }
        printf("%s: %.0f ms\n", settings[s], (double)(dip_clock_ns() - from_ns) / 1e6);
    }
}

// Draws frames along a path. Returns the number of frames that missed the bounds, or -1 on failure.
static int follow(Court *court, const char *name, bool only_time) {
    char file[512];
    DipError err = {0};
    snprintf(file, sizeof file, "%s/campaths/%s.pth", DIP_SOURCE_DIR, name);
    DipCamPath *path;
    if (!dip_campath_load(file, &path, &err)) {
        tell(file, &err);
        return -1;
    }
    int missed = 0;
    for (int f = 0; f < court->frames; f++) {
        DipPose pose = {.fov_y_deg = 50.0};
        dip_campath_sample(path, dip_campath_info(path).duration_ns * f / court->frames, &pose);
        if (only_time) {
            print_times(court, &pose);
            continue;
        }
        for (size_t s = 0; s < sizeof settings / sizeof settings[0]; s++) {
            missed += !matches(court, name, f, &pose, settings[s]);
        }
    }
    dip_campath_destroy(&path);
    return missed;
}

int main(int argc, char **argv) {
    Court court = {.width = 160, .height = 120, .frames = 2};
    bool only_time = false;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--time") == 0) {
            only_time = true;
        } else if (i + 1 < argc && strcmp(argv[i], "--frames") == 0) {
            court.frames = atoi(argv[++i]);
        } else if (i + 1 < argc && strcmp(argv[i], "--size") == 0) {
            sscanf(argv[++i], "%dx%d", &court.width, &court.height);
        }
    }
    bool failed = !open_court(&court);
    for (size_t p = 0; !failed && p < sizeof paths / sizeof paths[0]; p++) {
        failed |= follow(&court, paths[p], only_time) != 0;
    }
    close_court(&court);
    return failed;
}
