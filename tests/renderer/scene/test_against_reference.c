// Compares the pictures of the fast renderer with the pictures of the reference, for every step of
// every setting, on scenes made in code.
#include "renderer/reference/reference.h"
#include "renderer/scene/renderer.h"
#include "tests/renderer/scene/image.h"
#include "renderer/catalogue/scenes.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const int sizes[][2] = {{160, 120}, {97, 61}};

static const int64_t time_ns = INT64_C(123456789012); // all pictures show this time

// A scene in the fast renderer and in the reference.
typedef struct Pair {
    DipTestScene scene;
    DipReference *reference;
    DipScene *fast_scene;
    DipPool *pool;
    DipRenderer *renderer;
    int width;
    int height;
    double *expected;
} Pair;

static void fail_with(const DipError *err) {
    char text[640];
    dip_error_format(err, text, sizeof text);
    fail_msg("%s", text);
}

// Changes a scene before both renderers get it.
typedef void Change(DipTestScene *scene);

static void open_changed_pair(Pair *pair, DipTestSceneKind kind, Change *change, int width,
                              int height) {
    DipError err = {0};
    dip_test_scene_make(&pair->scene, kind);
    if (change) {
        change(&pair->scene);
    }
    pair->width = width;
    pair->height = height;
    pair->expected = malloc((size_t)width * (size_t)height * 3 * sizeof(double));
    pair->reference = dip_reference_create(&pair->scene.def, &err);
    pair->fast_scene = pair->reference ? dip_scene_create(&pair->scene.def, NULL, &err) : NULL;
    pair->pool = pair->fast_scene ? dip_pool_create(1, &err) : NULL;
    if (pair->reference) {
        dip_reference_set_time(pair->reference, time_ns);
    }
    DipRendererDef def = dip_renderer_default_def();
    def.pool = pair->pool;
    def.width = width;
    def.height = height;
    def.reflection = pair->scene.reflection;
    pair->renderer = pair->pool ? dip_renderer_create(&def, &err) : NULL;
    if (!pair->renderer) {
        fail_with(&err);
    }
    assert_non_null(pair->expected);
    dip_reference_set_reflection(pair->reference, &pair->scene.reflection);
}

static void open_pair(Pair *pair, DipTestSceneKind kind, int width, int height) {
    open_changed_pair(pair, kind, NULL, width, height);
}

static void close_pair(Pair *pair) {
    dip_renderer_destroy(&pair->renderer);
    dip_pool_destroy(&pair->pool);
    dip_scene_destroy(&pair->fast_scene);
    dip_reference_destroy(&pair->reference);
    dip_test_scene_free(&pair->scene);
    free(pair->expected);
}

// The bounds for scenes in which rounding cannot switch a sample between covered and uncovered. The
// remaining differences come from the frame's 8 bits (half a step is up to 0.0045 of light, at
// white) and from the fast renderer's texels and floats.
static const DipImageBounds steady = {0.0016, 0.01, 0.0, 0.01};

// Where alpha is close to the cutoff, rounding may decide whether a pixel of a clipped surface
// appears.
static const DipImageBounds fence = {0.004, 0.01, 0.0015, 1.0};
static const DipImageBounds fence_mips = {0.010, 0.01, 0.0015, 1.0};
// This scene is bright, so the few pixels that appear or disappear have large errors.
static const DipImageBounds mirrored_fence = {0.008, 0.01, 0.0015, 1.0};
// Adaptive AA divides a pixel's samples into groups and tests alpha once per group. So alpha is
// tested at more columns of positions. Along the edge of an upright bar, u is constant, so all
// positions of a column may lie on the edge. Each position decides about the samples of only
// one group.
static const DipImageBounds fence_passes = {0.004, 0.01, 0.006, 0.5};
// A vertex position halfway between two steps of 1/256 pixel may be rounded to either step.
// Slivers show this most.
static const DipImageBounds slivers = {0.004, 0.01, 0.001, 0.5};
// With AF, the number of probes in the coarser level changes in steps with the level of detail.
// Towards the horizon, rounding moves a few pixels across such a step.
static const DipImageBounds huge_af = {0.0018, 0.01, 0.0005, 0.08};
// A level sharper than the footprint has more contrast between neighbouring probes, so those
// few pixels differ more.
static const DipImageBounds huge_sharp_af = {0.0022, 0.01, 0.0015, 0.17};
// The narrow blend multiplies differences in the level of detail by four.
static const DipImageBounds narrow_mips = {0.0016, 0.02, 0.0, 0.02};
static const DipImageBounds huge_narrow_mips = {0.0016, 0.021, 0.0, 0.021};
static const DipImageBounds huge_narrow = {0.0018, 0.01, 0.0005, 0.08};
// Reflections in water are rounded to 8 bits twice. The narrow blend makes them sharper than
// the wide blend does.
static const DipImageBounds water_narrow = {0.0018, 0.01, 0.0, 0.01};
// The displacement of the clouds is read from rounded texels, which moves the clouds a little.
// The cover makes the edges of clouds steep.
static const DipImageBounds sky = {0.0023, 0.01, 0.0, 0.01};
// With alpha to coverage, rounding may move one sample in each pixel of an edge.
static const DipImageBounds fence_coverage = {0.004, 0.01, 0.003, 1.0};
static const DipImageBounds fence_coverage_mips = {0.010, 0.01, 0.003, 1.0};
static const DipImageBounds mirrored_coverage = {0.008, 0.01, 0.003, 1.0};
static const DipImageBounds fence_passes_mips = {0.010, 0.01, 0.006, 1.0};
// Every surface is shaded at several positions of a pixel, and slivers reach only some.
static const DipImageBounds steady_all = {0.0016, 0.02, 0.0, 0.02};
static const DipImageBounds huge_narrow_all = {0.0018, 0.01, 0.001, 0.08};
// A larger picture has more slivers, whose vertices may be rounded to either step.
static const DipImageBounds scaled = {0.0016, 0.01, 0.0002, 0.13};
// Larger pictures that blend are averaged from codes of 8 bits.
static const DipImageBounds scaled_codes = {0.0018, 0.01, 0.0, 0.01};
// Where a surface is seen nearly from the side, its reflection changes within a step of the
// fast renderer's tables, which are coarser than those of the reference.
static const DipImageBounds gloss = {0.0025, 0.01, 0.004, 0.1};

// Returns the bounds for a picture of a scene with these settings.
static const DipImageBounds *bounds_of(DipTestSceneKind kind, const DipQuality *quality) {
    const bool is_scaled = quality->step[DIP_SETTING_SCALE] != DIP_SCALE_1;
    const bool covers = dip_quality_covers_by_alpha(quality);
    const bool all = dip_quality_groups_shade_all(quality);
    const bool mip_colours = quality->step[DIP_SETTING_MIPDEBUG] != 0;
    const bool narrow = quality->step[DIP_SETTING_OPT] == DIP_OPT_ADVANCED;
    const bool anisotropic = quality->step[DIP_SETTING_AF] != 0;
    const bool sharp = anisotropic && quality->step[DIP_SETTING_MIPLOD] > DIP_MIPLOD_HIGH_QUALITY;
    const bool passes = dip_quality_samples_per_group(quality) < dip_quality_sample_count(quality);
    switch (kind) {
    case DIP_TEST_SCENE_sky:
        return mip_colours ? &steady : &sky;
    case DIP_TEST_SCENE_water:
        return mip_colours && narrow ? &narrow_mips : narrow ? &water_narrow : &steady;
    case DIP_TEST_SCENE_clear_water:
        return is_scaled               ? &scaled_codes
               : mip_colours && narrow ? &narrow_mips
               : narrow                ? &water_narrow
                                       : &steady;
    case DIP_TEST_SCENE_water_effects:
        return mip_colours ? &fence_mips : covers ? &mirrored_coverage : &mirrored_fence;
    case DIP_TEST_SCENE_fence:
    case DIP_TEST_SCENE_lights:
    case DIP_TEST_SCENE_gouraud_lights:
        return mip_colours && covers ? &fence_coverage_mips
               : mip_colours && all  ? &fence_passes_mips
               : mip_colours         ? &fence_mips
               : covers              ? &fence_coverage
               : passes              ? &fence_passes
                                     : &fence;
    case DIP_TEST_SCENE_metal_gloss:
    case DIP_TEST_SCENE_blending:
        return &gloss;
    case DIP_TEST_SCENE_slivers:
        return &slivers;
    case DIP_TEST_SCENE_huge:
        return mip_colours   ? (narrow ? &huge_narrow_mips : &steady)
               : narrow      ? (all ? &huge_narrow_all : &huge_narrow)
               : sharp       ? &huge_sharp_af
               : anisotropic ? &huge_af
               : is_scaled   ? &scaled
                             : &steady;
    default:
        return mip_colours && narrow ? &narrow_mips
               : all                 ? &steady_all
               : is_scaled           ? &scaled
                                     : &steady;
    }
}

// Returns the bounds for a picture that is enlarged from a smaller one with these bounds. A pixel
// of the smaller picture shows in several pixels. EASU may turn by a quarter where the smaller
// pixels around differ by a code or two, so that their rounding decides about the direction of the
// edge.
static DipImageBounds enlarged_bounds(DipImageBounds bounds, const DipQuality *quality) {
    const bool follows_edges = quality->step[DIP_SETTING_UPSCALE] == DIP_UPSCALE_EASU;
    if (dip_quality_upscales(quality)) {
        bounds.rms_lin += follows_edges ? 0.0025 : 0.0;
        bounds.over_share = 3.0 * bounds.over_share + (follows_edges ? 0.025 : 0.001);
        bounds.over_max_lin = fmax(bounds.over_max_lin, follows_edges ? 0.25 : 0.02);
    }
    return bounds;
}

static bool matches(Pair *pair, DipTestSceneKind kind, const char *settings, int frame_index) {
    DipError err = {0};
    DipQuality quality;
    DipFrame frame;
    dip_reference_set_frame_index(pair->reference, (uint64_t)frame_index);
    dip_renderer_set_frame_index(pair->renderer, (uint64_t)frame_index);
    if (!dip_quality_parse(settings, &quality, &err) ||
        !dip_reference_draw(pair->reference, &quality, &pair->scene.pose, pair->width, pair->height,
                            pair->expected, &err) ||
        !dip_renderer_set_quality(pair->renderer, &quality, &err) ||
        !dip_renderer_draw(pair->renderer, pair->fast_scene, &pair->scene.pose, time_ns, &frame,
                           &err)) {
        fail_with(&err);
    }
    char name[160];
    snprintf(name, sizeof name, "%s_%dx%d_%s_%d", dip_test_scene_name(kind), pair->width,
             pair->height, settings, frame_index);
    for (char *slash = strchr(name, '/'); slash; slash = strchr(slash, '/')) {
        *slash = '-'; // The name is that of a file.
    }
    const DipImageBounds bounds = enlarged_bounds(*bounds_of(kind, &quality), &quality);
    return dip_image_check(name, pair->expected, &frame, &bounds);
}

// The half of the pictures to compare, 0 or 1; -1 compares all.
static int half = -1;

enum { SIZES = sizeof sizes / sizeof *sizes };

// The scenes that check_all has drawn so far. A scene is opened once, since compressing its
// textures takes as long as several pictures.
static Pair opened[SIZES][DIP_TEST_SCENE_COUNT];

static Pair *pair_of(int size, DipTestSceneKind kind) {
    Pair *pair = &opened[size][kind];
    if (!pair->renderer) {
        open_pair(pair, kind, sizes[size][0], sizes[size][1]);
    }
    return pair;
}

static int close_all(void **state) {
    (void)state;
    for (int i = 0; i < SIZES * DIP_TEST_SCENE_COUNT; i++) {
        Pair *pair = &opened[i / DIP_TEST_SCENE_COUNT][i % DIP_TEST_SCENE_COUNT];
        if (pair->renderer) {
            close_pair(pair);
        }
    }
    return 0;
}

// Compares pictures with all settings of the list in all scenes and sizes, in the first frame_count
// frames of each. Of two successive settings, scenes or sizes one belongs to each half. Reports all
// failures before the test fails.
static void check_all(const char *const *settings, size_t count, int frame_count) {
    int missed = 0;
    for (int s = 0; s < SIZES; s++) {
        for (int kind = 0; kind < DIP_TEST_SCENE_COUNT; kind++) {
            Pair *pair = pair_of(s, (DipTestSceneKind)kind);
            for (size_t i = 0; i < count * (size_t)frame_count; i++) {
                if ((s + kind + (int)(i % count)) % 2 == 1 - half) {
                    continue;
                }
                missed +=
                    !matches(pair, (DipTestSceneKind)kind, settings[i % count], (int)(i / count));
            }
        }
    }
    assert_int_equal(missed, 0);
}

#define CHECK_ALL(frame_count, ...)                                                                \
    do {                                                                                           \
        static const char *const settings[] = {__VA_ARGS__};                                       \
        check_all(settings, sizeof settings / sizeof settings[0], frame_count);                    \
    } while (0)

static void antialiasing_matches_the_reference(void **state) {
    (void)state;
    CHECK_ALL(1, "aa=none", "aa=2", "aa=4", "aa=6", "aa=8", "aa=4,af=16,aaf=on", "aa=6,af=4");
}

static void temporal_antialiasing_matches_the_reference(void **state) {
    (void)state;
    CHECK_ALL(2, "aa=2,taa=on", "aa=4,taa=on", "aa=6,taa=on", "aa=8,taa=on",
              "aa=8,taa=on,aaa=on,asd=2,af=4");
}

static void adaptive_antialiasing_matches_the_reference(void **state) {
    (void)state;
    CHECK_ALL(1, "aaa=on", "aa=2,aaa=on", "aa=2,aaa=on,asd=2", "aa=4,aaa=on", "aa=4,aaa=on,asd=2",
              "aa=6,aaa=on", "aa=6,aaa=on,asd=2", "aa=6,aaa=on,asd=3", "aa=8,aaa=on",
              "aa=8,aaa=on,asd=2", "aa=8,aaa=on,asd=4", "aa=8,aaa=on,asd=4,mipdebug=on",
              "aa=4,aaa=on,asd=2,af=16,aaf=on", "aa=6,aaa=on,miplod=high-performance");
}

static void alpha_to_coverage_matches_the_reference(void **state) {
    (void)state;
    CHECK_ALL(1, "aaa=coverage", "aa=2,aaa=coverage", "aa=4,aaa=coverage", "aa=6,aaa=coverage",
              "aa=8,aaa=coverage", "aa=4,aaa=coverage,af=16,aaf=on", "aa=8,aaa=coverage,af=4",
              "aa=8,aaa=coverage,opt=advanced,miplod=quality", "aa=4,aaa=coverage,mipdebug=on");
    CHECK_ALL(2, "aa=4,taa=on,aaa=coverage", "aa=8,taa=on,aaa=coverage");
}

static void supersampling_of_all_surfaces_matches_the_reference(void **state) {
    (void)state;
    CHECK_ALL(1, "aaa=all", "aa=2,aaa=all", "aa=2,aaa=all,asd=2", "aa=4,aaa=all",
              "aa=4,aaa=all,asd=2", "aa=6,aaa=all,asd=3", "aa=8,aaa=all", "aa=8,aaa=all,asd=4,af=4",
              "aa=4,aaa=all,mipdebug=on", "aa=4,aaa=all,af=16,aaf=on,opt=advanced");
}

static void render_scales_match_the_reference(void **state) {
    (void)state;
    CHECK_ALL(1, "scale=1.25", "scale=1.5", "scale=2", "scale=2,aa=4,af=16,aaf=on",
              "scale=1.25,aa=4,aaa=on", "scale=1.5,mipdebug=on", "scale=2,miplod=sharper",
              "scale=1.25,aa=2,aaa=all,opt=advanced");
}

static void smaller_pictures_match_the_reference(void **state) {
    (void)state;
    CHECK_ALL(1, "scale=1/2", "scale=1/1.7,upscale=bicubic", "scale=1/1.5,upscale=easu",
              "scale=1/1.3,aa=4,af=16,aaf=on,upscale=easu",
              "scale=1/1.5,aa=4,aaa=on,upscale=bicubic", "scale=1/2,aa=4,mipdebug=on",
              "scale=1/2,miplod=performance,aa=8,aaa=coverage");
}

static void anisotropic_filtering_matches_the_reference(void **state) {
    (void)state;
    CHECK_ALL(1, "af=2", "af=4", "af=8", "af=16", "af=2,aaf=on", "af=4,aaf=on", "af=8,aaf=on",
              "af=16,aaf=on", "aaf=on");
}

static void mip_level_of_detail_matches_the_reference(void **state) {
    (void)state;
    CHECK_ALL(1, "miplod=quality", "miplod=performance", "miplod=high-performance",
              "miplod=high-performance,af=16,aaf=on", "miplod=quality,af=8,aa=2", "miplod=sharp",
              "miplod=sharper", "miplod=sharper,af=16,aaf=on,aa=4",
              "miplod=sharper,aa=4,aaa=on,opt=advanced");
}

static void mip_colours_match_the_reference(void **state) {
    (void)state;
    CHECK_ALL(1, "mipdebug=on", "mipdebug=on,af=16", "mipdebug=on,af=16,aaf=on,aa=4",
              "mipdebug=on,miplod=high-performance", "mipdebug=on,miplod=sharper");
}

static void texture_optimisation_matches_the_reference(void **state) {
    (void)state;
    CHECK_ALL(1, "opt=standard", "opt=standard,af=16,aaf=on,aa=4", "opt=advanced",
              "opt=advanced,af=2", "opt=advanced,af=8", "opt=advanced,af=16,aaf=on",
              "opt=advanced,aa=8,aaa=on,asd=2,miplod=quality", "opt=advanced,mipdebug=on,af=4",
              "opt=advanced,miplod=high-performance,af=4");
}

static void remove_normals(DipTestScene *scene) {
    for (int m = 0; m < scene->def.mesh_count; m++) {
        const DipMeshDef *mesh = &scene->meshes[m];
        if (mesh->normals) {
            memset((float *)(uintptr_t)mesh->normals, 0,
                   (size_t)mesh->vertex_count * 3 * sizeof(float));
        }
    }
}

// Flattens every object along one axis of its mesh. Normals along the other axes become 0.
static void flatten(DipTestScene *scene, int axis) {
    for (int o = 0; o < scene->def.object_count; o++) {
        for (int row = 0; row < 3; row++) {
            scene->objects[o].transform[4 * row + axis] = 0.0f;
        }
    }
}

static void flatten_x(DipTestScene *scene) {
    flatten(scene, 0);
}

static void flatten_y(DipTestScene *scene) {
    flatten(scene, 1);
}

static void flatten_z(DipTestScene *scene) {
    flatten(scene, 2);
}

static void normals_without_direction_match_the_reference(void **state) {
    (void)state;
    static const DipTestSceneKind kinds[] = {DIP_TEST_SCENE_normal_map, DIP_TEST_SCENE_lights,
                                             DIP_TEST_SCENE_gouraud_lights,
                                             DIP_TEST_SCENE_lit_sphere};
    static Change *const changes[] = {remove_normals, flatten_x, flatten_y, flatten_z};
    int missed = 0;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        for (size_t c = 0; c < sizeof changes / sizeof *changes; c++) {
            Pair pair;
            open_changed_pair(&pair, kinds[k], changes[c], sizes[0][0], sizes[0][1]);
            missed += !matches(&pair, kinds[k], "aa=4,af=4", (int)c);
            close_pair(&pair);
        }
    }
    assert_int_equal(missed, 0);
}

// Where send_lights_away puts the lights.
static double far_m;

// Moves every point and spot light to a distance, without changing its direction and strength at
// the origin. A spot light then shines past the origin, between the inner and the outer cone.
static void send_lights_away(DipTestScene *scene) {
    for (int l = 0; l < scene->lighting.light_count; l++) {
        DipLightDef *light = &scene->lights[l];
        if (light->kind == DIP_LIGHT_DIRECTIONAL) {
            continue;
        }
        float *at = light->position_world;
        float *a = light->attenuation;
        const double near_m = sqrt((double)at[0] * at[0] + at[1] * at[1] + at[2] * at[2]);
        const double loss = a[0] + a[1] * near_m + a[2] * near_m * near_m;
        a[0] = (float)(0.5 * loss);
        a[1] = (float)(0.5 * loss / far_m);
        a[2] = 0.0f;
        light->range_m = 0.0f;
        light->inner_deg = 2.0f;
        light->outer_deg = 50.0f;
        for (int c = 0; c < 3; c++) {
            light->direction_world[c] = (float)(-at[c] / near_m + (c == 1 ? 0.3 : 0.0));
            at[c] = (float)(at[c] * (far_m / near_m));
        }
    }
}

// Lights on both sides of the distance from which the fast renderer takes them for directional.
static void lights_far_away_match_the_reference(void **state) {
    (void)state;
    static const double distances_m[] = {1e9, 9e17, 1.1e18, 3e19, 1e30, 1e38};
    static const DipTestSceneKind kinds[] = {DIP_TEST_SCENE_lights, DIP_TEST_SCENE_gouraud_lights};
    int missed = 0;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        for (size_t d = 0; d < sizeof distances_m / sizeof *distances_m; d++) {
            Pair pair;
            far_m = distances_m[d];
            open_changed_pair(&pair, kinds[k], send_lights_away, sizes[0][0], sizes[0][1]);
            missed += !matches(&pair, kinds[k], "aa=4,af=4", (int)d);
            close_pair(&pair);
        }
    }
    assert_int_equal(missed, 0);
}

// How make_clipped changes the fence.
static struct {
    float cutoff;
    float u, v; // What is added to the texture coordinates of clipped surfaces.
} clipped;

static void make_clipped(DipTestScene *scene) {
    for (int m = 0; m < scene->def.material_count; m++) {
        scene->materials[m].alpha_cutoff = clipped.cutoff;
    }
    for (int m = 0; m < scene->def.mesh_count; m++) {
        const DipMeshDef *mesh = &scene->meshes[m];
        float *uv = (float *)(uintptr_t)mesh->uv0;
        const bool clips = scene->materials[mesh->material].surface == DIP_SURFACE_CLIPPED;
        for (uint32_t i = 0; clips && i < mesh->vertex_count; i++) {
            uv[2 * i] += clipped.u;
            uv[2 * i + 1] += clipped.v;
        }
    }
}

// Marks the pixels in which the fast picture has the reference's colour, after the reference's
// coordinates have moved by (u, v).
static void mark_equal(const Pair *fast, const DipFrame *frame, const DipQuality *quality, float u,
                       float v, bool *equal) {
    Pair moved;
    DipError err = {0};
    clipped.u = u;
    clipped.v = v;
    open_changed_pair(&moved, DIP_TEST_SCENE_fence, make_clipped, fast->width, fast->height);
    if (!dip_reference_draw(moved.reference, quality, &moved.scene.pose, moved.width, moved.height,
                            moved.expected, &err)) {
        fail_with(&err);
    }
    for (int i = 0; i < moved.width * moved.height; i++) {
        const DipFrame pixel = {.rgba8 = frame->rgba8 +
                                         (size_t)(i / moved.width) * frame->stride_bytes +
                                         4 * (size_t)(i % moved.width),
                                .stride_bytes = frame->stride_bytes,
                                .width = 1,
                                .height = 1};
        equal[i] |= dip_image_compare(moved.expected + 3 * i, &pixel, 0.01).over_count == 0;
    }
    close_pair(&moved);
}

// With a cutoff of 1, a surface is kept only where all texels that are read have the alpha 1. The
// outermost such position is the centre of a texel. Where coordinates make many pixels lie there,
// rounding decides about each of them, in either renderer. So the fast renderer must agree, in
// every pixel, with a reference whose coordinates have moved by at most 1/512 texel, half a step of
// the filter. The texture has 128 texels.
static void the_greatest_cutoffs_match_the_reference(void **state) {
    (void)state;
    static const float cutoffs[] = {(float)(254.5 / 255.0), 0.99999994f, 1.0f};
    static const char *const settings[] = {"aa=none", "aa=4", "af=8", "miplod=performance",
                                           "aa=4,aaa=on"};
    static const float step = 1.0f / 512 / 128;
    static const float moves[5][2] = {{0, 0}, {step, 0}, {-step, 0}, {0, step}, {0, -step}};
    for (size_t c = 0; c < sizeof cutoffs / sizeof *cutoffs; c++) {
        for (size_t s = 0; s < sizeof settings / sizeof *settings; s++) {
            bool equal[160 * 120] = {false};
            int differing = 0;
            Pair pair;
            DipQuality quality;
            DipFrame frame;
            clipped.cutoff = cutoffs[c];
            clipped.u = clipped.v = 0.0f;
            open_changed_pair(&pair, DIP_TEST_SCENE_fence, make_clipped, sizes[0][0], sizes[0][1]);
            assert_true(dip_quality_parse(settings[s], &quality, NULL));
            assert_true(dip_renderer_set_quality(pair.renderer, &quality, NULL));
            assert_true(dip_renderer_draw(pair.renderer, pair.fast_scene, &pair.scene.pose, time_ns,
                                          &frame, NULL));
            for (int m = 0; m < 5; m++) {
                mark_equal(&pair, &frame, &quality, moves[m][0], moves[m][1], equal);
            }
            for (int i = 0; i < pair.width * pair.height; i++) {
                differing += !equal[i];
            }
            if (differing) {
                fail_msg("cutoff %.8f, %s: %d pixels differ", (double)cutoffs[c], settings[s],
                         differing);
            }
            close_pair(&pair);
        }
    }
}

// Usage: test_against_reference [--half N]
int main(int argc, char **argv) {
    if (argc == 3 && strcmp(argv[1], "--half") == 0) {
        half = atoi(argv[2]);
    } else if (argc != 1) {
        fprintf(stderr, "usage: test_against_reference [--half 0|1]\n");
        return 2;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(antialiasing_matches_the_reference),
        cmocka_unit_test(normals_without_direction_match_the_reference),
        cmocka_unit_test(lights_far_away_match_the_reference),
        cmocka_unit_test(temporal_antialiasing_matches_the_reference),
        cmocka_unit_test(adaptive_antialiasing_matches_the_reference),
        cmocka_unit_test(alpha_to_coverage_matches_the_reference),
        cmocka_unit_test(supersampling_of_all_surfaces_matches_the_reference),
        cmocka_unit_test(render_scales_match_the_reference),
        cmocka_unit_test(smaller_pictures_match_the_reference),
        cmocka_unit_test(anisotropic_filtering_matches_the_reference),
        cmocka_unit_test(mip_level_of_detail_matches_the_reference),
        cmocka_unit_test(mip_colours_match_the_reference),
        cmocka_unit_test(texture_optimisation_matches_the_reference),
        cmocka_unit_test(the_greatest_cutoffs_match_the_reference),
    };
    return cmocka_run_group_tests(tests, NULL, close_all);
}
