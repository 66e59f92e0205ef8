// Measures how much a change of each setting delays the frames around the change.
//
//   dip_bench_changes [ROUNDS]
//
// Draws two panes of the courtyard at 640x480 along the ambient path, as the preview does. One of
// the panes (the requested pane) changes from the default quality to one step of one setting, and
// back. The time of a frame includes both panes. For every change, six frames are measured: the
// last frame before the change and the first five after it. Each time is divided by the median time
// of the frames with the same settings. "longest" is the greatest of the six ratios. The whole
// measurement is repeated ROUNDS times. The table has the median and the minimum of "longest" over
// these rounds. The minimum is useful because noise can only add time.
#include "assets/model.h"
#include "campaths/campath.h"
#include "renderer/base/clock.h"
#include "renderer/scene/renderer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WARM = 12, AROUND = 5, MAX_ROUNDS = 200, FRAMES_PER_SECOND = 30 };

typedef struct Court {
    DipPool *pool;
    DipScene *scene;
    DipCamPath *path;
    DipRenderer *panes[2];
    int frame_index;
} Court;

static bool fail(const DipError *err) {
    char text[512];
    dip_error_format(err, text, sizeof text);
    fprintf(stderr, "%s\n", text);
    return false;
}

static bool open_court(Court *court) {
    const char *file = DIP_SOURCE_DIR "/assets/courtyard/court.gltf";
    DipError err = {0};
    DipRendererDef def = dip_renderer_default_def();
    def.pool = court->pool = dip_pool_create(0, &err);
    DipModel *model =
        court->pool ? dip_model_load_with_normals(&file, 1, court->pool, NULL, &err) : NULL;
    court->scene = model ? dip_scene_create(dip_model_scene_def(model), court->pool, &err) : NULL;
    dip_model_destroy(&model);
    if (!court->scene ||
        !dip_campath_load(DIP_SOURCE_DIR "/campaths/ambient.pth", &court->path, &err) ||
        !dip_scene_compress_textures(court->scene, court->pool,
                                     &err)) { // as the preview compresses them
        return fail(&err);
    }
    for (int p = 0; p < 2; p++) {
        court->panes[p] = dip_renderer_create(&def, &err);
    }
    return (court->panes[0] && court->panes[1]) || fail(&err);
}

static void close_court(Court *court) {
    for (int p = 0; p < 2; p++) {
        dip_renderer_destroy(&court->panes[p]);
    }
    dip_campath_destroy(&court->path);
    dip_scene_destroy(&court->scene);
    dip_pool_destroy(&court->pool);
}

// Draws both panes and returns the milliseconds that this took, or -1 after a failure.
static double draw(Court *court) {
    const int64_t time_ns = court->frame_index++ * INT64_C(1000000000) / FRAMES_PER_SECOND;
    DipPose pose = {.fov_y_deg = 45.0};
    dip_campath_sample(court->path, time_ns, &pose);
    const int64_t begin_ns = dip_clock_ns();
    DipError err;
    DipFrame frames[2];
    if (!dip_renderer_draw_frames(court->panes, 2, court->scene, &pose, time_ns,
                                  (DipFrame *const[2]){&frames[0], &frames[1]}, &err)) {
        fail(&err);
        return -1.0;
    }
    return 1e-6 * (double)(dip_clock_ns() - begin_ns);
}

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(const double *values, int count) {
    double sorted[MAX_ROUNDS];
    memcpy(sorted, values, (size_t)count * sizeof *sorted);
    qsort(sorted, (size_t)count, sizeof *sorted, compare);
    return sorted[count / 2];
}

// Times of successive frames with one quality. The first time belongs to the first frame with this
// quality.
typedef struct Stretch {
    double ms[WARM + AROUND];
} Stretch;

static void play(Court *court, const DipQuality *quality, Stretch *stretch) {
    dip_renderer_set_quality(court->panes[1], quality, NULL);
    for (int i = 0; i < WARM + AROUND; i++) {
        stretch->ms[i] = draw(court);
    }
}

// Finds the longest frame around the change from one stretch to the next. Each frame's time is
// divided by the median time of its own stretch. Returns the greatest ratio.
static double longest_ratio(const Stretch *before, const Stretch *after) {
    double longest = before->ms[WARM + AROUND - 1] / median(before->ms, WARM + AROUND);
    const double middle = median(after->ms, WARM + AROUND);
    for (int i = 0; i < AROUND; i++) {
        longest = after->ms[i] / middle > longest ? after->ms[i] / middle : longest;
    }
    return longest;
}

static double minimum(const double *values, int count) {
    double found = values[0];
    for (int i = 1; i < count; i++) {
        found = values[i] < found ? values[i] : found;
    }
    return found;
}

// Measures the change to a step of a setting and back, and prints a line.
static void measure(Court *court, DipSetting setting, int step, int rounds) {
    const DipSettingInfo *info = dip_setting_info(setting);
    const DipQuality base = dip_quality_default();
    DipQuality changed = base;
    changed.step[setting] = (uint8_t)step;
    if (setting == DIP_SETTING_AAA || setting == DIP_SETTING_TAA) {
        changed.step[DIP_SETTING_AA] = 2; // these settings need several samples per pixel
    }
    if (!dip_quality_check(&changed, NULL)) {
        return;
    }
    double ms[MAX_ROUNDS], there[MAX_ROUNDS], back[MAX_ROUNDS];
    for (int r = 0; r < rounds; r++) {
        Stretch stretches[3];
        play(court, &base, &stretches[0]);
        play(court, &changed, &stretches[1]);
        play(court, &base, &stretches[2]);
        ms[r] = median(stretches[1].ms, WARM + AROUND);
        there[r] = longest_ratio(&stretches[0], &stretches[1]);
        back[r] = longest_ratio(&stretches[1], &stretches[2]);
    }
    char name[64];
    snprintf(name, sizeof name, "%s=%s", info->key, info->steps[step]);
    printf("%-26s %8.2f %10.2f %6.2f %10.2f %6.2f\n", name, median(ms, rounds),
           median(there, rounds), minimum(there, rounds), median(back, rounds),
           minimum(back, rounds));
    fflush(stdout);
}

int main(int argc, char **argv) {
    const int asked = argc > 1 ? atoi(argv[1]) : 15;
    const int rounds = asked < 1 ? 1 : asked > MAX_ROUNDS ? MAX_ROUNDS : asked;
    static Court court;
    const bool opened = open_court(&court);
    if (opened) {
        printf("%-26s %8s %17s %17s\n", "", "median", "longest, change", "longest, back");
        printf("%-26s %8s %10s %6s %10s %6s\n", "", "ms", "median", "min", "median", "min");
    }
    for (int s = 0; opened && s < DIP_SETTING_COUNT; s++) {
        const DipSettingInfo *info = dip_setting_info((DipSetting)s);
        for (int step = 0; step < info->step_count; step++) {
            if (step != info->default_step) {
                measure(&court, (DipSetting)s, step, rounds);
            }
        }
    }
    close_court(&court);
    return opened ? 0 : 1;
}
