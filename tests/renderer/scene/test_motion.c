// Measures how continuous the courtyard's pictures are along the shipped camera paths. The camera
// turns and moves by 1/256 of a pixel (renderer/catalogue/motion.h has the measurements), and it
// crosses the moments at which the plan switches an effect or culling changes what is drawn.
//
// The test samples each path at equal times. For every sampled pose it draws the settings in turn,
// or all of them with --all. It also searches motions of a whole pixel for steps that pop. Usage:
// test_motion [--frames N] [--all]
#include "assets/model.h"
#include "campaths/campath.h"
#include "renderer/catalogue/motion.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 320, HEIGHT = 240 };

static const double step_px = 1.0 / 256.0;
static const double distance_m = 5.0;  // typical distance of what the paths show
static const int64_t switch_ns = 1000; // time between the poses before and after a switch

static const struct {
    const char *name;
    double fov_y_deg;
} paths[] = {{"aa", 45.0},      {"aaa", 45.0},    {"af", 55.0},
             {"ambient", 55.0}, {"miplod", 50.0}, {"water", 50.0}};
enum { PATHS = sizeof paths / sizeof *paths };

static const char *const settings[] = {
    "aa=none",
    "aa=4,af=16",
    "aa=2,miplod=quality",
    "aa=8,aaa=on,asd=1,af=16,aaf=on",
    "aa=4,taa=on",
    "aa=4,af=16,opt=advanced",
    "aa=none,miplod=performance",
    "aa=6,aaa=on,asd=3,af=8,aaf=on",
    "aa=4,aaa=on,asd=1,opt=standard",
    "aa=none,af=2,miplod=quality",
    "aa=none,miplod=high-performance",
    "aa=none,af=4,aaf=on,opt=standard",
    "aa=8,aaa=on,asd=4,gi=off",
    "aa=none,af=16,mipdebug=on",
};
enum { SETTINGS = sizeof settings / sizeof *settings };

// What is measured. The bounds are those of the rows A61 to A64 of the catalogue.
enum {
    BLOCK,
    PICTURE,
    TRILINEAR,
    ANISOTROPIC,
    FOUND_TRILINEAR,
    FOUND_ANISOTROPIC,
    SWITCH_BLOCK,
    SWITCH_BROAD,
    MEASURES
};
static const struct {
    const char *what;
    const char *unit;
    double bound;
} measures[MEASURES] = {
    {"steps: mean change of a block", "of light", 0.125},
    {"steps: mean change of a picture", "times h times the gradient", 8.0},
    {"steps: change of a quarter of a block, af=none", "of light", 0.01},
    {"steps: change of a quarter of a block, anisotropic", "of light", 0.04},
    {"searches: change of a quarter of a block, af=none", "of light", 0.01},
    {"searches: change of a quarter of a block, anisotropic", "of light", 0.04},
    {"switches: mean change of a block", "of light", 0.125},
    {"switches: change of a quarter of a block", "of light", 0.01},
};

typedef struct Court {
    DipPool *pool;
    DipScene *scene;
    DipRenderer *renderer;
    DipCamPath *path;
    int path_index;
    int frames; // sampled poses of each path
    bool all;   // draw every setting at every sampled pose
    StabilityRun runs[MEASURES];
    StabilityPicture before;
    StabilityPicture half;
    StabilityPicture after;
    int64_t clouds_ns; // time of the pictures of a search
    DipFrame frame;    // drawn last
} Court;

static void fail(const char *what, const DipError *err) {
    fprintf(stderr, "test_motion: %s: %s\n", what, err->message);
    exit(1);
}

static void open_court(Court *court) {
    const char *file = DIP_SOURCE_DIR "/assets/courtyard/court.gltf";
    DipError err = {0};
    court->pool = dip_pool_create(0, &err);
    DipModel *model = dip_model_load_with_normals(&file, 1, court->pool, NULL, &err);
    court->scene = model ? dip_scene_create(dip_model_scene_def(model), court->pool, &err) : NULL;
    dip_model_destroy(&model);
    DipRendererDef def = dip_renderer_default_def();
    def.pool = court->pool;
    def.width = WIDTH;
    def.height = HEIGHT;
    def.reflection = (DipReflectionDef){.width = 320, .height = 240, .level_m = 0.66};
    court->renderer = court->scene ? dip_renderer_create(&def, &err) : NULL;
    if (!court->renderer) {
        fail(file, &err);
    }
    StabilityPicture *const pictures[] = {&court->before, &court->half, &court->after};
    for (int i = 0; i < 3; i++) {
        pictures[i]->width = WIDTH;
        pictures[i]->height = HEIGHT;
        pictures[i]->rgb_lin = calloc((size_t)WIDTH * HEIGHT * 3, sizeof(double));
        if (!pictures[i]->rgb_lin) {
            fail("pictures", &(DipError){.message = "out of memory"});
        }
    }
}

static void close_court(Court *court) {
    stability_picture_free(&court->before);
    stability_picture_free(&court->half);
    stability_picture_free(&court->after);
    dip_renderer_destroy(&court->renderer);
    dip_scene_destroy(&court->scene);
    dip_pool_destroy(&court->pool);
}

static void set_quality(Court *court, const char *text) {
    DipError err = {0};
    DipQuality quality;
    if (!dip_quality_parse(text, &quality, &err) ||
        !dip_renderer_set_quality(court->renderer, &quality, &err)) {
        fail(text, &err);
    }
}

static int64_t frame_ns(const Court *court, int frame) {
    return dip_campath_info(court->path).duration_ns / court->frames * frame;
}

static DipPose pose_at(const Court *court, int64_t time_ns) {
    DipPose pose = {.fov_y_deg = paths[court->path_index].fov_y_deg};
    dip_campath_sample(court->path, time_ns, &pose);
    return pose;
}

// Draws into court->frame. The clouds stand still during a step, so that only the camera moves.
static void draw(Court *court, const DipPose *pose, int64_t clouds_ns) {
    DipError err = {0};
    dip_renderer_set_frame_index(court->renderer, 0);
    if (!dip_renderer_draw(court->renderer, court->scene, pose, clouds_ns, &court->frame, &err)) {
        fail(paths[court->path_index].name, &err);
    }
}

static void draw_picture(Court *court, const DipPose *pose, int64_t clouds_ns,
                         StabilityPicture *picture) {
    draw(court, pose, clouds_ns);
    stability_decode(&court->frame, picture);
}

// --- steps ------------------------------------------------------------------------------------

// Returns how much of a block's change half of a step makes, in percent: near 50 for a motion, near
// 0 or 100 for a single jump.
static double half_percent(Court *court, const DipPose *pose, MotionStep step, int64_t time_ns,
                           const MotionPeak *peak) {
    step.step_px *= 0.5;
    const DipPose half = motion_move(pose, &step);
    draw_picture(court, &half, time_ns, &court->half);
    const double all = motion_block_change(&court->before, &court->after, peak->x, peak->y);
    const double part = motion_block_change(&court->before, &court->half, peak->x, peak->y);
    return all > 0.0 ? 100.0 * part / all : 0.0;
}

static bool has_probes(const char *text) {
    return strstr(text, "af=") != NULL;
}

// Draws the picture before and after a step. court->before has the picture of the pose.
static void measure_step(Court *court, int64_t time_ns, MotionKind kind, const char *text) {
    const MotionStep step = {kind, step_px, HEIGHT, distance_m};
    const DipPose pose = pose_at(court, time_ns);
    const DipPose moved = motion_move(&pose, &step);
    draw_picture(court, &moved, time_ns, &court->after);
    const MotionChange change = motion_compare(&court->before, &court->after);
    char where[120];
    snprintf(where, sizeof where, "%s.pth at %.2f s, %s with %s", paths[court->path_index].name,
             1e-9 * (double)time_ns, motion_names[kind], text);
    const int broad = has_probes(text) ? ANISOTROPIC : TRILINEAR;
    const MotionPeak *const peaks[] = {&change.mean, &change.broad};
    const int kept[] = {BLOCK, broad};
    for (int i = 0; i < 2; i++) {
        StabilityRun *run = &court->runs[kept[i]];
        const bool worse = peaks[i]->value > run->worst;
        stability_error(run, peaks[i]->value,
                        "%s, block at %d,%d; half of the step makes %.0f %% of its mean change",
                        where, peaks[i]->x, peaks[i]->y,
                        worse ? half_percent(court, &pose, step, time_ns, peaks[i]) : 0.0);
    }
    stability_error(&court->runs[PICTURE], change.picture / (step_px * change.gradient), "%s",
                    where);
}

static bool draw_searched(void *context, const DipPose *pose, StabilityPicture *picture) {
    Court *court = context;
    draw_picture(court, pose, court->clouds_ns, picture);
    return true;
}

static void measure_search(Court *court, int64_t time_ns, MotionKind kind, const char *text) {
    MotionSearch search = {.draw = draw_searched,
                           .context = court,
                           .pose = pose_at(court, time_ns),
                           .step = {kind, 0.0, HEIGHT, distance_m},
                           .pictures = {court->before, court->half, court->after}};
    MotionChange change;
    double at_px;
    court->clouds_ns = time_ns;
    motion_search(&search, &change, &at_px);
    stability_error(&court->runs[has_probes(text) ? FOUND_ANISOTROPIC : FOUND_TRILINEAR],
                    change.broad.value,
                    "%s.pth at %.2f s, %s with %s, after %.4f pixels, block at %d,%d",
                    paths[court->path_index].name, 1e-9 * (double)time_ns, motion_names[kind], text,
                    at_px, change.broad.x, change.broad.y);
}

static void measure_searches(Court *court) {
    for (int f = 0; f < court->frames; f++) {
        for (int s = 0; s < SETTINGS; s++) {
            const bool chosen = s % court->frames == f && (s + court->path_index) % 3 == 0;
            if (court->all || chosen) {
                set_quality(court, settings[s]);
                measure_search(court, frame_ns(court, f),
                               (MotionKind)((f + s + court->path_index) % MOTION_KINDS),
                               settings[s]);
            }
        }
    }
}

static void measure_steps(Court *court) {
    for (int f = 0; f < court->frames; f++) {
        const int64_t time_ns = frame_ns(court, f);
        const DipPose pose = pose_at(court, time_ns);
        for (int s = 0; s < SETTINGS; s++) {
            if (!court->all && s % court->frames != f) {
                continue;
            }
            set_quality(court, settings[s]);
            draw_picture(court, &pose, time_ns, &court->before);
            const int first = court->all ? 0 : (s + court->path_index) % 2;
            for (int k = first; k < MOTION_KINDS; k += court->all ? 1 : 2) {
                measure_step(court, time_ns, (MotionKind)k, settings[s]);
            }
        }
    }
}

// --- switches ---------------------------------------------------------------------------------

// What the plan and culling decide about a frame.
typedef struct Decisions {
    bool effects[6];
    uint64_t passes;
    uint64_t triangles;
} Decisions;

static Decisions decisions_at(Court *court, int64_t time_ns, int64_t clouds_ns) {
    const DipPose pose = pose_at(court, time_ns);
    draw(court, &pose, clouds_ns);
    const DipEffects *effects = &court->frame.effects;
    return (Decisions){
        .effects = {effects->reflection.run, effects->alpha_clip.run, effects->adaptive_aa.run,
                    effects->light_map.run, effects->normal_map.run, effects->sky.run},
        .passes = court->frame.counters.passes,
        .triangles = court->frame.counters.triangles_in,
    };
}

static bool same_effects(const Decisions *a, const Decisions *b) {
    return memcmp(a->effects, b->effects, sizeof a->effects) == 0 && a->passes == b->passes;
}

static bool same_decisions(const Decisions *a, const Decisions *b) {
    return same_effects(a, b) && a->triangles == b->triangles;
}

// Finds a moment in [from_ns, to_ns] at which the decisions change, and compares the pictures
// before and after it. The decisions at from_ns and to_ns differ in what `same` compares.
static void measure_switch(Court *court, int64_t from_ns, int64_t to_ns, const Decisions *first,
                           bool (*same)(const Decisions *, const Decisions *), const char *text) {
    const int64_t clouds_ns = from_ns;
    while (to_ns - from_ns > switch_ns) {
        const int64_t middle_ns = from_ns + (to_ns - from_ns) / 2;
        const Decisions middle = decisions_at(court, middle_ns, clouds_ns);
        if (same(first, &middle)) {
            from_ns = middle_ns;
        } else {
            to_ns = middle_ns;
        }
    }
    const DipPose before = pose_at(court, from_ns);
    const DipPose after = pose_at(court, to_ns);
    draw_picture(court, &before, clouds_ns, &court->before);
    draw_picture(court, &after, clouds_ns, &court->after);
    const MotionChange change = motion_compare(&court->before, &court->after);
    const char *what = same == same_effects ? "effects" : "culling";
    const char *path = paths[court->path_index].name;
    const double at_s = 1e-9 * (double)from_ns;
    stability_error(&court->runs[SWITCH_BLOCK], change.mean.value,
                    "%s.pth at %.6f s, %s with %s, block at %d,%d", path, at_s, what, text,
                    change.mean.x, change.mean.y);
    stability_error(&court->runs[SWITCH_BROAD], change.broad.value,
                    "%s.pth at %.6f s, %s with %s, block at %d,%d", path, at_s, what, text,
                    change.broad.x, change.broad.y);
}

static void measure_switches(Court *court, const char *text) {
    set_quality(court, text);
    Decisions before = decisions_at(court, 0, 0);
    for (int f = 1; f <= court->frames; f++) {
        const int64_t from_ns = frame_ns(court, f - 1);
        const int64_t to_ns = frame_ns(court, f);
        const Decisions after = decisions_at(court, to_ns, from_ns);
        if (!same_effects(&before, &after)) {
            measure_switch(court, from_ns, to_ns, &before, same_effects, text);
        }
        if (!same_decisions(&before, &after)) {
            measure_switch(court, from_ns, to_ns, &before, same_decisions, text);
        }
        before = after;
    }
}

// --- the whole --------------------------------------------------------------------------------

static void follow(Court *court, int path_index) {
    char file[512];
    DipError err = {0};
    snprintf(file, sizeof file, "%s/campaths/%s.pth", DIP_SOURCE_DIR, paths[path_index].name);
    if (!dip_campath_load(file, &court->path, &err)) {
        fail(file, &err);
    }
    court->path_index = path_index;
    measure_steps(court);
    measure_searches(court);
    measure_switches(court, "aa=none");
    if (court->all) {
        measure_switches(court, "aa=4,aaa=on,asd=1,af=8");
    }
    dip_campath_destroy(&court->path);
}

static bool report(const Court *court) {
    bool holds = true;
    for (int i = 0; i < MEASURES; i++) {
        const StabilityRun *run = &court->runs[i];
        const bool within = run->worst <= measures[i].bound && run->case_count > 0;
        printf("%-5s %.5f (at most %.3f) %s: %s, %llu cases\n      %s\n", within ? "ok" : "FAILS",
               run->worst, measures[i].bound, measures[i].unit, measures[i].what,
               (unsigned long long)run->case_count, run->worst_at);
        holds = holds && within;
    }
    return holds;
}

int main(int argc, char **argv) {
    static Court court = {.frames = 4};
    for (int i = 1; i < argc; i++) {
        if (i + 1 < argc && strcmp(argv[i], "--frames") == 0) {
            court.frames = atoi(argv[++i]);
        } else if (strcmp(argv[i], "--all") == 0) {
            court.all = true;
        }
    }
    open_court(&court);
    for (int p = 0; p < PATHS; p++) {
        follow(&court, p);
    }
    const bool holds = report(&court);
    close_court(&court);
    return !holds;
}
