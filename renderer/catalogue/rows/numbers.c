// Rows about arithmetic: floating-point modes, and functions that replace those of libm.
#include "campaths/camtrack.h"
#include "renderer/base/hash.h"
#include "renderer/base/number.h"
#include "renderer/base/srgb.h"
#include "renderer/base/trig.h"
#include "renderer/pipeline/cull.h"
#include "renderer/pipeline/geometry/project.h"
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/reference/convergence.h"
#include "renderer/catalogue/random.h"
#include "renderer/catalogue/scenes.h"
#include "renderer/catalogue/fp_modes.h"
#include "renderer/catalogue/pictures.h"
#include "renderer/catalogue/shipped_hashes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- the caller's floating-point mode ---------------------------------------------------------

// What the public functions compute from. It is made before the mode changes.
typedef struct ModeInputs {
    StabilityRun *run;
    DipTestScene *scene;
    DipTestSceneKind kind;
} ModeInputs;

// Calls public functions and adds their results to a hash.
typedef void CallEntries(const ModeInputs *inputs, DipHash *hash);

static void hash_doubles(DipHash *hash, const double *values, size_t count) {
    dip_hash_bytes(hash, values, count * sizeof *values);
}

static void call_trig(const ModeInputs *inputs, DipHash *hash) {
    (void)inputs;
    for (int i = 0; i < 200; i++) {
        // These values are exact, whatever the mode.
        const double x = 0.125 + i * 0.375;
        const double y = -0.9921875 + i * 0.0078125;
        const double values[] = {dip_sin(x),  dip_cos(x),  dip_tan(x),
                                 dip_acos(y), dip_asin(y), dip_atan2(y, x)};
        hash_doubles(hash, values, 6);
    }
}

static void call_srgb(const ModeInputs *inputs, DipHash *hash) {
    (void)inputs;
    DipSrgbDecodeTable decode;
    static DipSrgbEncodeTable encode;
    dip_srgb_decode_table(&decode);
    dip_srgb_encode_table(&encode);
    const double one = dip_srgb_decode(0.3);
    hash_doubles(hash, decode.linear, 256);
    hash_doubles(hash, &one, 1);
    static uint8_t codes[DIP_LINEAR16_MAX + 1];
    for (int i = 0; i <= DIP_LINEAR16_MAX; i++) {
        codes[i] = dip_srgb_code(&encode, i);
    }
    dip_hash_bytes(hash, codes, sizeof codes);
}

static void call_numbers(const ModeInputs *inputs, DipHash *hash) {
    (void)inputs;
    static const char *const texts[] = {"0.1",       "2.2250738585072011e-308", "1e23",
                                        "-0.3",      "9007199254740993",        "4.9e-324",
                                        "123456.789"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        double value = 0.0;
        char text[DIP_NUMBER_TEXT_SIZE];
        dip_number_parse(texts[i], strlen(texts[i]), &value);
        dip_number_format(value, text);
        hash_doubles(hash, &value, 1);
        dip_hash_text(hash, text);
    }
}

static void call_paths(const ModeInputs *inputs, DipHash *hash) {
    DipError err = {0};
    DipCamOrbitDef orbit = dip_campath_default_orbit();
    DipCamPath *path = NULL;
    if (!dip_campath_orbit(&orbit, &path, &err)) {
        stability_break(inputs->run, "no orbit: %s", err.message);
        return;
    }
    DipCamTrack track = dip_camtrack_make(true);
    dip_camtrack_set(&track, 0, path, 45.0);
    for (int i = 0; i < 50; i++) {
        DipPose pose = {.fov_y_deg = 45.0};
        DipPose tracked = {.fov_y_deg = 45.0};
        dip_campath_sample(path, i * INT64_C(377777777), &pose);
        dip_camtrack_pose(&track, i * INT64_C(377777777), &tracked);
        hash_doubles(hash, pose.position_world, 3);
        hash_doubles(hash, pose.orientation, 4);
        hash_doubles(hash, tracked.orientation, 4);
    }
    dip_campath_destroy(&path);
}

static void call_path_reader(const ModeInputs *inputs, DipHash *hash) {
    static const char text[] = "diptych-path 1\n"
                               "period 0.7\n"
                               "0.1 0.2 0.3 0 0 0 1\n"
                               "1.7 0.2 0.3 0.1 0.2 0.3 0.92736185\n"
                               "0.1 0.2 3.3 0 0.6 0 0.8\n";
    DipError err = {0};
    DipCamPath *path = NULL;
    DipPose pose = {.fov_y_deg = 45.0};
    if (dip_campath_parse(text, sizeof text - 1, "mode.pth", &path, &err)) {
        dip_campath_sample(path, 1234567891, &pose);
        hash_doubles(hash, pose.position_world, 3);
        hash_doubles(hash, pose.orientation, 4);
        dip_campath_destroy(&path);
    } else {
        stability_break(inputs->run, "no path: %s", err.message);
    }
}

static void call_culling(const ModeInputs *inputs, DipHash *hash) {
    (void)inputs;
    const double world_to_clip[16] = {1.1, 0.2, 0.3, 0.4,  -0.2, 1.3, 0.1, 0.7,
                                      0.0, 0.0, 0.0, 0.01, 0.1,  0.2, 1.0, 5.3};
    const float transform[12] = {0.7f, 0.1f, 0.2f, 3.3f, 0.3f, 1.7f,
                                 0.1f, 0.9f, 0.2f, 0.3f, 1.1f, 7.7f};
    const DipBox box = {{-1.1f, -0.3f, -0.7f}, {1.3f, 0.9f, 0.1f}};
    const DipBox moved = dip_cull_transform_box(transform, &box);
    const DipCullPlanes planes = dip_cull_view_planes(world_to_clip);
    dip_hash_bytes(hash, &moved, sizeof moved);
    dip_hash_bytes(hash, &planes, sizeof planes);
    dip_hash_integer(hash, dip_cull_outside(&planes, &moved));
}

static void call_renderer(const ModeInputs *inputs, DipHash *hash) {
    static const char *const settings[] = {"aa=4,af=16", "aa=8,aaa=on,opt=advanced,mipdebug=on"};
    for (int i = 0; i < 2; i++) {
        const StabilityShot shot = {.def = &inputs->scene->def,
                                    .pose = &inputs->scene->pose,
                                    .reflection = &inputs->scene->reflection,
                                    .settings = settings[i],
                                    .width = 64,
                                    .height = 48,
                                    .time_ns = 123456789};
        StabilityPicture picture;
        if (stability_draw(inputs->run, &shot, &picture)) {
            dip_hash_text(hash, picture.hash);
            stability_picture_free(&picture);
        }
    }
}

static void call_reference(const ModeInputs *inputs, DipHash *hash) {
    const StabilityShot shot = {.def = &inputs->scene->def,
                                .pose = &inputs->scene->pose,
                                .reflection = &inputs->scene->reflection,
                                .settings = "aa=2,af=4,aaa=on",
                                .width = 24,
                                .height = 18,
                                .time_ns = 123456789};
    StabilityPicture picture;
    if (stability_draw_reference(inputs->run, &shot, &picture)) {
        hash_doubles(hash, picture.rgb_lin, (size_t)24 * 18 * 3);
        stability_picture_free(&picture);
    }
}

static void call_converged(const ModeInputs *inputs, DipHash *hash) {
    double rgb_lin[16 * 12 * 3];
    DipError err = {0};
    DipReference *reference = dip_reference_create_for_truth(&inputs->scene->def, NULL, &err);
    if (reference &&
        dip_reference_converge(reference, &inputs->scene->pose, 16, 12, 4, 1, rgb_lin, &err)) {
        hash_doubles(hash, rgb_lin, sizeof rgb_lin / sizeof *rgb_lin);
    } else {
        stability_break(inputs->run, "no converged picture: %s", err.message);
    }
    dip_reference_destroy(&reference);
}

// Adds the tiles of a converged picture one by one, and classifies the pixels.
static void call_convergence(const ModeInputs *inputs, DipHash *hash) {
    double rgb_lin[16 * 12 * 3] = {0.0};
    uint8_t classes[16 * 12];
    DipError err = {0};
    DipReference *reference = dip_reference_create(&inputs->scene->def, &err);
    DipConvergence *convergence =
        reference ? dip_convergence_create(reference, &inputs->scene->pose, 16, 12, &err) : NULL;
    bool drawn = convergence != NULL;
    for (int t = 0; drawn && t < dip_convergence_tile_count(convergence); t++) {
        drawn = dip_convergence_add_tile(convergence, t, 4, 1, 1.0, rgb_lin, classes, &err);
    }
    if (drawn) {
        hash_doubles(hash, rgb_lin, sizeof rgb_lin / sizeof *rgb_lin);
        dip_hash_bytes(hash, classes, sizeof classes);
    } else {
        stability_break(inputs->run, "no converged picture: %s", err.message);
    }
    dip_convergence_destroy(&convergence);
    dip_reference_destroy(&reference);
}

typedef struct Entries {
    const char *name;
    CallEntries *call;
    bool per_scene; // the functions read a scene
} Entries;

static const Entries renderer_entries[] = {
    {"scene and renderer", call_renderer, true},
};

// Functions that are the same for all instruction sets.
static const Entries other_entries[] = {
    {"trigonometry", call_trig, false},
    {"sRGB tables", call_srgb, false},
    {"reading and writing numbers", call_numbers, false},
    {"orbit, sampling and track of a camera path", call_paths, false},
    {"reading a camera path", call_path_reader, false},
    {"culling", call_culling, false},
    {"reference renderer", call_reference, true},
    {"converged picture", call_converged, true},
    {"tiles of a converged picture", call_convergence, true},
};

static const FpMode fewer_digits[] = {FP_MODE_FLUSH_TO_ZERO, FP_MODE_SHORT_X87};
static const FpMode rounding_modes[] = {FP_MODE_UPWARD, FP_MODE_DOWNWARD, FP_MODE_TOWARD_ZERO};

// Compares results in a mode with results in the usual mode, and the mode before with the mode
// after the calls.
static void compare_mode(const ModeInputs *inputs, const Entries *entry, FpMode mode) {
    char expected[DIP_HASH_HEX_SIZE];
    char found[DIP_HASH_HEX_SIZE];
    DipHash hash = dip_hash_begin(0);
    entry->call(inputs, &hash);
    dip_hash_hex(&hash, expected);
    hash = dip_hash_begin(0);
    const FpModeState before = fp_mode_enter(mode);
    entry->call(inputs, &hash);
    const bool kept = fp_mode_is(mode);
    fp_mode_return(before);
    dip_hash_hex(&hash, found);
    if (!entry->per_scene) { // Pictures are kept, and the reference renderer computes with libm.
        dip_hash_text(&inputs->run->hash, expected);
    }
    const char *scene = entry->per_scene ? dip_test_scene_name(inputs->kind) : "";
    stability_expect(inputs->run, strcmp(expected, found) == 0, "%s in mode %s %s", entry->name,
                     fp_mode_name(mode), scene);
    stability_expect(inputs->run, kept, "%s left another mode than %s %s", entry->name,
                     fp_mode_name(mode), scene);
}

static void compare_modes(StabilityRun *run, const Entries *entries, size_t count,
                          const FpMode *modes, int mode_count) {
    static DipTestScene scene;
    const int scene_count = stability_count(run, 1, DIP_TEST_SCENE_COUNT, DIP_TEST_SCENE_COUNT);
    for (int s = 0; s < scene_count; s++) {
        const DipTestSceneKind kind =
            (DipTestSceneKind)((DIP_TEST_SCENE_water_effects + s) % DIP_TEST_SCENE_COUNT);
        dip_test_scene_make(&scene, kind);
        const ModeInputs inputs = {run, &scene, kind};
        for (size_t e = 0; e < count; e++) {
            for (int m = 0; m < mode_count && (entries[e].per_scene || s == 0); m++) {
                compare_mode(&inputs, &entries[e], modes[m]);
            }
        }
        dip_test_scene_free(&scene);
    }
}

static void measure_fewer_digits(StabilityRun *run) {
    compare_modes(run, renderer_entries, 1, fewer_digits, 2);
}

static void measure_fewer_digits_elsewhere(StabilityRun *run) {
    compare_modes(run, other_entries, sizeof other_entries / sizeof *other_entries, fewer_digits,
                  2);
}

static void measure_rounding_modes(StabilityRun *run) {
    compare_modes(run, renderer_entries, 1, rounding_modes, stability_count(run, 1, 3, 3));
}

static void measure_rounding_modes_elsewhere(StabilityRun *run) {
    compare_modes(run, other_entries, sizeof other_entries / sizeof *other_entries, rounding_modes,
                  stability_count(run, 1, 3, 3));
}

// --- trigonometry -----------------------------------------------------------------------------

// pi/2 in three parts. The first two have 32 significant bits, so that their products with a whole
// number below 2^21 are exact.
static const long double half_pi[3] = {0x1.921fb544p+0L, 0x1.0b4611a6p-34L,
                                       0x1.3198a2e03707344ap-69L};

// Taylor's series of the sine for |x| <= pi/4. The first term left out is below 1e-26.
static long double sine_series(long double x) {
    long double factor = 1.0L;
    for (int n = 25; n >= 3; n -= 2) {
        factor = 1.0L - factor * x * x / (long double)(n * (n - 1));
    }
    return x * factor;
}

// The sine and the cosine in long double. Diptych does not trust sinl: one C library's has an error
// of 6e-16 at large angles.
static void true_sine(double x, long double *sine, long double *cosine) {
    const long double n = rintl((long double)x / half_pi[0]);
    const long double rest = (((long double)x - n * half_pi[0]) - n * half_pi[1]) - n * half_pi[2];
    const long double s = sine_series(rest);
    const long double half = sine_series(0.5L * rest);
    const long double c = 1.0L - 2.0L * half * half;
    const int quadrant = (int)((long long)n & 3);
    *sine = quadrant == 0 ? s : quadrant == 1 ? c : quadrant == 2 ? -s : -c;
    *cosine = quadrant == 0 ? c : quadrant == 1 ? -s : quadrant == 2 ? -c : s;
}

static void measure_sine(StabilityRun *run) {
    Random random = {run->seed};
    const int count = stability_count(run, 2000, 200000, 20000000);
    for (int i = 0; i < count; i++) {
        const double size = ldexp(1.0, random_int(&random, -40, 19));
        const double x = random_real(&random, -size, size);
        long double sine;
        long double cosine;
        true_sine(x, &sine, &cosine);
        stability_keep(run, (double[]){dip_sin(x), dip_cos(x)}, 2);
        stability_error(run, (double)((long double)dip_sin(x) - sine), "sin(%a)", x);
        stability_error(run, (double)((long double)dip_cos(x) - cosine), "cos(%a)", x);
    }
}

// Near x = 1, acos(x) = sqrt(2 d) (1 + d/12 + 3 d^2/160 + 5 d^3/896 + ...) with d = 1 - x, which is
// exact. For d <= 2^-12, the first term left out is below 1e-16 of the last bit of a double.
static long double true_small_arc(double d) {
    const long double e = (long double)d;
    const long double sum = 1.0L + e / 12.0L + 3.0L * e * e / 160.0L + 5.0L * e * e * e / 896.0L +
                            35.0L * e * e * e * e / 18432.0L + 63.0L * e * e * e * e * e / 90112.0L;
    return sqrtl(2.0L * e) * sum;
}

static void measure_arc_cosine(StabilityRun *run) {
    const long double pi = 2.0L * ((half_pi[2] + half_pi[1]) + half_pi[0]);
    Random random = {run->seed};
    const int count = stability_count(run, 2000, 200000, 20000000);
    for (int i = 0; i < count; i++) {
        // The difference to 1 is a multiple of 2^-53, so that x is exact.
        const double d = ceil(random_magnitude(&random, 0, 40)) * 0x1p-53;
        const double x = i % 2 ? 1.0 - d : d - 1.0;
        const long double small = true_small_arc(d);
        const long double angle = i % 2 ? small : pi - small;
        stability_keep(run, (double[]){dip_acos(x)}, 1);
        stability_error(run, (double)(((long double)dip_acos(x) - angle) / angle), "acos(%a)", x);
    }
}

// --- equal bits -------------------------------------------------------------------------------

// Rounds to float after every operation: the compiler may neither fuse nor keep excess precision.
static float rounded(double exact) {
    volatile float result = (float)exact;
    return result;
}

// The projection computes x / w * half + half. The product and the sum are each rounded: a fused
// multiply-add would give another last bit in many of the cases, and then another position.
static void measure_separate_rounding(StabilityRun *run) {
    static float clip[4][DIP_VERTEX_BATCH];
    static DipScreenBatch screen;
    float *const rows[4] = {clip[0], clip[1], clip[2], clip[3]};
    const DipScreenMapping map = {.half_width = 2048.0f,
                                  .half_height = 1536.0f,
                                  .left = -1.0f,
                                  .right = 1.0f,
                                  .bottom = -1.0f,
                                  .top = 1.0f,
                                  .guard_left = 8.0f,
                                  .guard_right = 6.0f,
                                  .guard_top = 8.0f,
                                  .guard_bottom = 6.0f};
    Random random = {run->seed};
    const int batches = stability_count(run, 20, 2000, 100000);
    for (int b = 0; b < batches; b++) {
        for (int i = 0; i < DIP_VERTEX_BATCH; i++) {
            clip[3][i] = (float)random_real(&random, 0.5, 2.0);
            clip[0][i] = (float)random_real(&random, -0.5, 0.5);
            clip[1][i] = (float)random_real(&random, -0.5, 0.5);
            clip[2][i] = 0.1f;
        }
        dip_kernels(run->isa)->dip_kernel_project(&map, DIP_VERTEX_BATCH, rows, &screen);
        for (int i = 0; i < DIP_VERTEX_BATCH; i++) {
            // Quotients, products and sums of floats are exact enough in double for one rounding.
            const float ndc = rounded((double)clip[0][i] / (double)clip[3][i]);
            const float product = rounded((double)ndc * 2048.0 * 256.0);
            const float sum = rounded((double)product + 2048.0 * 256.0);
            stability_keep(run, (double[]){screen.x[i]}, 1);
            stability_error(run, (double)screen.x[i] - rint((double)sum), "x of vertex %d", i);
        }
    }
}

static void measure_hashes(StabilityRun *run) {
    stability_compare_hashes(run, NULL, NULL);
}

static const StabilityRow rows[] = {
    {.id = "N48",
     .promise = "Pictures have the same bits with every instruction set, compiler and platform: no "
                "approximate reciprocals, no fused operations, no functions of libm.",
     .truth = "shipped hashes of pictures that a scalar build drew",
     .unit = "pictures",
     .per_isa = true,
     .measure = measure_hashes},
    {.id = "N49",
     .promise = "Products and sums are rounded separately; no compiler fuses them.",
     .truth = "the projection with each operation rounded by hand",
     .unit = "1/256 pixel",
     .per_isa = true,
     .measure = measure_separate_rounding},
    {.id = "N47",
     .promise = "A caller that flushes subnormal numbers to zero, or whose x87 unit computes with "
                "24 bits, gets the same pictures, and its mode is restored.",
     .truth = "the pictures in the usual mode",
     .unit = "differences",
     .per_isa = true,
     .measure = measure_fewer_digits},
    {.id = "A66",
     .promise = "Such a caller gets the same results of all other functions: the reference "
                "renderer, truths, camera paths, culling, sRGB, sines, and numbers as text.",
     .truth = "the results in the usual mode",
     .unit = "differences",
     .measure = measure_fewer_digits_elsewhere},
    {.id = "A1",
     .promise =
         "A caller that rounds upwards, downwards or to zero gets the same pictures, and its "
         "mode is restored.",
     .truth = "the pictures in the usual mode",
     .unit = "differences",
     .per_isa = true,
     .measure = measure_rounding_modes},
    {.id = "A67",
     .promise = "A caller that rounds upwards, downwards or to zero gets the same results of all "
                "other functions.",
     .truth = "the results in the usual mode",
     .unit = "differences",
     .measure = measure_rounding_modes_elsewhere},
    {.id = "N50",
     .promise = "Sine and cosine come from Diptych's own series and are exact to the last bit or "
                "two.",
     .truth = "Taylor's series in `long double`",
     .unit = "absolute",
     .bound = 2.5e-16,
     .measure = measure_sine},
    {.id = "A2",
     .promise = "The arc cosine loses no digits near +1 and -1.",
     .truth = "the series of the arc cosine at 1, in `long double`",
     .unit = "relative",
     .bound = 1e-15,
     .measure = measure_arc_cosine},
};

const StabilityTopic stability_numbers = {"numbers", "Arithmetic", rows,
                                          sizeof rows / sizeof *rows};
