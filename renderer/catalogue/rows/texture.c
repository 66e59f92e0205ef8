// Rows about textures: addressing, mip levels, level of detail, alpha.
#define DIP_LANES      1 // footprint_simd.h serves one instruction set at a time: here, scalar
#define DIP_ISA_SUFFIX scalar
#include "renderer/base/srgb.h"
#include "renderer/pipeline/texture/footprint_simd.h"
#include "renderer/catalogue/random.h"
#include "renderer/catalogue/scenes.h"
#include "renderer/catalogue/pictures.h"

#include <math.h>
#include <string.h>

enum { SIDE = 8 }; // pixels of a picture across and down

// --- a quad that fills the picture ------------------------------------------------------------

// Adds a texture with linear encoding, so that its texels are light.
static int add_texture(DipTestScene *scene, int width, int height) {
    const int texture = dip_test_scene_add_texture(scene, DIP_TEST_NOISE, width, height);
    scene->textures[texture].encoding = DIP_ENCODING_LINEAR;
    return texture;
}

// Makes a scene with one texture on a quad that fills the picture. The quad lies 1 m in front of
// the camera; a pixel is 2 / SIDE m wide. Returns the quad's mesh.
static DipTestMesh make_quad(DipTestScene *scene, int width, int height) {
    dip_test_scene_begin(scene);
    scene->pose.fov_y_deg = 90.0;
    const int material = dip_test_scene_add_material(scene, add_texture(scene, width, height));
    scene->materials[material].double_sided = true;
    const DipTestMesh mesh = dip_test_scene_add_mesh(scene, 4, 6, DIP_TEST_UV0, material);
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    static const float corners[4][2] = {{-2.0f, 2.0f}, {-2.0f, -2.0f}, {2.0f, -2.0f}, {2.0f, 2.0f}};
    memcpy(mesh.indices, indices, sizeof indices);
    for (int i = 0; i < 4; i++) {
        mesh.positions[3 * i] = corners[i][0];
        mesh.positions[3 * i + 1] = corners[i][1];
        mesh.positions[3 * i + 2] = -1.0f;
    }
    return mesh;
}

// Gives the quad the texture coordinates u + x per_metre and v - y per_metre at the point (x, y).
static void map_quad(const DipTestMesh *mesh, double u, double v, double per_metre) {
    for (int i = 0; i < 4; i++) {
        mesh->uv0[2 * i] = (float)(u + mesh->positions[3 * i] * per_metre);
        mesh->uv0[2 * i + 1] = (float)(v - mesh->positions[3 * i + 1] * per_metre);
    }
}

static bool draw(StabilityRun *run, const DipTestScene *scene, const char *settings,
                 StabilityPicture *picture) {
    const StabilityShot shot = {.def = &scene->def,
                                .pose = &scene->pose,
                                .settings = settings,
                                .width = SIDE,
                                .height = SIDE};
    return stability_draw(run, &shot, picture);
}

// Returns the greatest difference between a picture and one colour.
static double distance_to(const StabilityPicture *picture, const double rgb[3]) {
    double greatest = 0.0;
    for (int i = 0; i < 3 * SIDE * SIDE; i++) {
        greatest = fmax(greatest, fabs(picture->rgb_lin[i] - rgb[i % 3]));
    }
    return greatest;
}

// --- addressing -------------------------------------------------------------------------------

// Computes the colour of a bilinear read at a coordinate u of a texture that is one texel high.
static void read_exactly(const uint8_t *rgba8, int width, float u, double rgb[3]) {
    const double fraction = (double)u - floor((double)u); // exact, or rounded to 1 for tiny u < 0
    const double at = fraction * width - 0.5;
    const double cell = floor(at);
    const int left = ((int)cell + width) % width;
    const int right = ((int)cell + 1 + width) % width;
    for (int c = 0; c < 3; c++) {
        const double a = rgba8[4 * left + c] / 255.0;
        const double b = rgba8[4 * right + c] / 255.0;
        rgb[c] = a + (b - a) * (at - cell);
    }
}

static void compare_read(StabilityRun *run, float u, int width) {
    static DipTestScene scene;
    const DipTestMesh mesh = make_quad(&scene, width, 1);
    map_quad(&mesh, (double)u, 0.5, 0.0);
    double expected[3];
    read_exactly(dip_test_scene_texels(&scene, 0), width, u, expected);
    StabilityPicture picture;
    if (draw(run, &scene, "aa=none", &picture)) {
        stability_error(run, distance_to(&picture, expected), "u = %a, %d texels", (double)u,
                        width);
        stability_picture_free(&picture);
    }
    dip_test_scene_free(&scene);
}

// Every exponent and both signs: tiny negative coordinates, neighbours of whole numbers, whole
// numbers too large for a fraction.
static void measure_wrap(StabilityRun *run) {
    Random random = {run->seed};
    const int step = stability_count(run, 37, 1, 1);
    for (int exponent = -149; exponent <= 127; exponent += step) {
        const float power = ldexpf(1.0f, exponent);
        const float values[] = {power, -power, nextafterf(power, 0.0f), nextafterf(-power, 0.0f),
                                (float)(power * random_real(&random, 1.0, 2.0))};
        for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
            compare_read(run, values[i], i % 2 ? 8 : 7);
        }
    }
    compare_read(run, 0.0f, 8);
    compare_read(run, -1e-9f, 8);
    compare_read(run, nextafterf(1.0f, 0.0f), 7);
}

// --- mip chains -------------------------------------------------------------------------------

// Minifies a texture so far that one texel of the last level fills the picture.
static void compare_mean(StabilityRun *run, int width, int height) {
    static DipTestScene scene;
    const DipTestMesh mesh = make_quad(&scene, width, height);
    map_quad(&mesh, 0.25, 0.25, 4096.0);
    const uint8_t *texels = dip_test_scene_texels(&scene, 0);
    double mean[3] = {0.0};
    for (int i = 0; i < 4 * width * height; i++) {
        if (i % 4 < 3) {
            mean[i % 4] += texels[i] / 255.0 / (width * (double)height);
        }
    }
    StabilityPicture picture;
    if (draw(run, &scene, "aa=none", &picture)) {
        stability_error(run, distance_to(&picture, mean), "%dx%d texels", width, height);
        stability_picture_free(&picture);
    }
    dip_test_scene_free(&scene);
}

static void measure_odd_sizes(StabilityRun *run) {
    static const int sizes[][2] = {{1, 1},  {1, 2},   {3, 1},  {1, 9},   {5, 7},    {17, 16},
                                   {31, 3}, {127, 1}, {64, 1}, {255, 3}, {33, 129}, {1, 1000}};
    Random random = {run->seed};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        compare_mean(run, sizes[i][0], sizes[i][1]);
    }
    const int count = stability_count(run, 0, 60, 3000);
    for (int i = 0; i < count; i++) {
        const int width = random_int(&random, 1, 80);
        compare_mean(run, width, random_int(&random, 1, 80));
    }
}

// A texture of one texel has one level. Every setting of filtering must stay inside it.
static void measure_single_texel(StabilityRun *run) {
    static const char *const settings[] = {
        "aa=none",           "af=16",
        "af=16,aaf=on",      "aa=8,af=16,miplod=high-performance",
        "af=8,opt=standard", "af=16,opt=advanced,miplod=quality"};
    static DipTestScene scene;
    Random random = {run->seed};
    const int count = stability_count(run, 12, 300, 10000);
    for (int i = 0; i < count; i++) {
        const DipTestMesh mesh = make_quad(&scene, 1, 1);
        const double scale = ldexp(1.0, random_int(&random, -60, 60));
        const double u = random_real(&random, -scale, scale);
        const double v = random_real(&random, -scale, scale);
        map_quad(&mesh, u, v, random_real(&random, -scale, scale));
        const uint8_t *texel = dip_test_scene_texels(&scene, 0);
        const double expected[3] = {texel[0] / 255.0, texel[1] / 255.0, texel[2] / 255.0};
        StabilityPicture picture;
        if (draw(run, &scene, settings[i % 6], &picture)) {
            // BC1 rounds the colour to 5 or 6 bits, which is another promise.
            if (!strstr(settings[i % 6], "opt")) {
                stability_error(run, distance_to(&picture, expected), "%s, scale %g",
                                settings[i % 6], scale);
            } else {
                stability_expect(run, distance_to(&picture, expected) < 0.05, "%s, scale %g",
                                 settings[i % 6], scale);
            }
            stability_picture_free(&picture);
        }
        dip_test_scene_free(&scene);
    }
}

// --- level of detail --------------------------------------------------------------------------

// Texture scales from extreme magnification to extreme minification, with every bias: the picture
// of a texture of one colour is that colour, whatever level is read.
static void measure_bias(StabilityRun *run) {
    static const char *const settings[] = {"miplod=high-quality", "miplod=quality",
                                           "miplod=performance", "miplod=high-performance",
                                           "aa=4,af=16,miplod=high-performance"};
    static const double white[3] = {1.0, 1.0, 1.0};
    static DipTestScene scene;
    const int step = stability_count(run, 24, 4, 1);
    for (int exponent = -100; exponent <= 100; exponent += step) {
        for (int i = 0; i < 5; i++) {
            const DipTestMesh mesh = make_quad(&scene, 64, 16);
            memset(dip_test_scene_texels(&scene, 0), 255, (size_t)64 * 16 * 4);
            map_quad(&mesh, 0.3, 0.7, ldexp(1.0, exponent));
            StabilityPicture picture;
            if (draw(run, &scene, settings[i], &picture)) {
                stability_error(run, distance_to(&picture, white), "2^%d repeats per metre, %s",
                                exponent, settings[i]);
                stability_picture_free(&picture);
            }
            dip_test_scene_free(&scene);
        }
    }
}

// Moves a textured quad away in small steps and compares the pictures of neighbours. All pixels
// have the same level of detail, so a jump of the level or of its fraction would show in all of
// them.
static void measure_level_steps(StabilityRun *run) {
    static DipTestScene scene;
    StabilityPicture before = {0};
    const int step = stability_count(run, 8, 1, 1);
    for (int i = 0; i <= 512; i += step) {
        double part = 1.0; // 2^(i % 64 / 64), without the exp2 of libm
        for (int k = 0; k < i % 64; k++) {
            part *= 0x1.02c9a3e778061p+0; // 2^(1/64)
        }
        const DipTestMesh mesh = make_quad(&scene, 64, 64);
        map_quad(&mesh, 0.5, 0.5, ldexp(part, i / 64 - 4));
        StabilityPicture picture;
        const bool drawn = draw(run, &scene, "mipdebug=on", &picture);
        dip_test_scene_free(&scene);
        if (drawn && before.rgb_lin) {
            double greatest = 0.0;
            for (int k = 0; k < 3 * SIDE * SIDE; k++) {
                greatest = fmax(greatest, fabs(picture.rgb_lin[k] - before.rgb_lin[k]));
            }
            // A step of 1/64 level changes the blend of two mip colours by 1/64.
            stability_error(run, greatest / step, "step %d", i);
        }
        stability_picture_free(&before);
        before = drawn ? picture : (StabilityPicture){0};
    }
    stability_picture_free(&before);
}

static float scalar_log2(float x) {
    Vf v = {x};
    v = log2_of(v);
    return v[0];
}

static void measure_log2(StabilityRun *run) {
    Random random = {run->seed};
    const int count = stability_count(run, 10000, 1000000, 100000000);
    for (int exponent = -126; exponent <= 127; exponent++) {
        stability_expect(run, scalar_log2(ldexpf(1.0f, exponent)) == (float)exponent, "log2(2^%d)",
                         exponent);
    }
    float last = scalar_log2(1.0f);
    for (int i = 0; i < count; i++) {
        const double span = 1.0 + (i + 1.0) / count;
        const float x = (float)span;
        const float found = scalar_log2(x);
        stability_expect(run, found >= last, "log2 falls at %a", (double)x);
        last = found;
        const float any = (float)random_magnitude(&random, -120, 120);
        stability_keep(run, (double[]){found, scalar_log2(any)}, 2);
        stability_error(run, (double)scalar_log2(any) - (double)log2l((long double)any), "log2(%a)",
                        (double)any);
    }
}

// --- alpha ------------------------------------------------------------------------------------

// Makes a clipped quad whose texels all have one alpha, and returns the share of pixels that show.
static double shown_share(StabilityRun *run, int alpha, float cutoff, const char *settings) {
    static DipTestScene scene;
    static const float black[3] = {0.0f, 0.0f, 0.0f};
    const DipTestMesh mesh = make_quad(&scene, 8, 8);
    map_quad(&mesh, 0.3, 0.3, 1.7);
    uint8_t *texels = dip_test_scene_texels(&scene, 0);
    memset(texels, 255, (size_t)8 * 8 * 4);
    for (int i = 0; i < 64; i++) {
        texels[4 * i + 3] = (uint8_t)alpha;
    }
    scene.materials[0].surface = DIP_SURFACE_CLIPPED;
    scene.materials[0].alpha_cutoff = cutoff;
    memcpy(scene.def.background_lin, black, sizeof black);
    StabilityPicture picture;
    double share = NAN;
    if (draw(run, &scene, settings, &picture)) {
        share = 0.0;
        for (int i = 0; i < SIDE * SIDE; i++) {
            share += picture.rgb_lin[3 * i] / (SIDE * SIDE);
        }
        stability_picture_free(&picture);
    }
    dip_test_scene_free(&scene);
    return share;
}

static void measure_equal_alpha(StabilityRun *run) {
    static const char *const settings[] = {"aa=none", "aa=4,aaa=on,af=16", "opt=advanced"};
    const int step = stability_count(run, 51, 1, 1);
    for (int alpha = 0; alpha <= 255; alpha += step) {
        const float equal = (float)alpha / 255.0f;
        for (int i = 0; i < 3; i++) {
            stability_error(run, 1.0 - shown_share(run, alpha, equal, settings[i]),
                            "alpha %d of 255 at an equal cutoff with %s", alpha, settings[i]);
            if (alpha < 255) {
                const float above = (float)(alpha + 0.5) / 255.0f;
                stability_error(run, shown_share(run, alpha, above, settings[i]),
                                "alpha %d of 255 below the cutoff with %s", alpha, settings[i]);
            }
        }
    }
}

// Halfway between a texel of alpha 0 and one of alpha 255, alpha is exactly 1/2.
static void measure_halfway_alpha(StabilityRun *run) {
    static const float cutoffs[] = {0.5f, 0.49f, 0.51f};
    static DipTestScene scene;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 4; k++) {
            const DipTestMesh mesh = make_quad(&scene, 2, 2);
            // The texel boundaries are at 0, 1/2 and 1.
            map_quad(&mesh, k % 2 ? 0.5 : 1.0, k / 2 ? 0.25 : 0.75, 0.0);
            uint8_t *texels = dip_test_scene_texels(&scene, 0);
            memset(texels, 255, 16);
            texels[3] = texels[11] = 0;
            scene.materials[0].surface = DIP_SURFACE_CLIPPED;
            scene.materials[0].alpha_cutoff = cutoffs[i];
            memset(scene.def.background_lin, 0, sizeof scene.def.background_lin);
            StabilityPicture picture;
            if (draw(run, &scene, "aa=8", &picture)) {
                const double expected[3] = {i < 2, i < 2, i < 2};
                stability_error(run, distance_to(&picture, expected), "cutoff %g, boundary %d",
                                (double)cutoffs[i], k);
                stability_picture_free(&picture);
            }
            dip_test_scene_free(&scene);
        }
    }
}

static const StabilityRow rows[] = {
    {.id = "N27",
     .promise = "Repeating coordinates of every exponent and sign read the right texels: tiny "
                "negative ones, neighbours of whole numbers, and numbers too large for a fraction.",
     .truth = "the bilinear read in double precision",
     .unit = "of light",
     .bound = 0.01,
     .per_isa = true,
     .measure = measure_wrap},
    {.id = "N28",
     .promise = "The mip levels of textures of any size keep the mean of the texels.",
     .truth = "the mean of all texels",
     .unit = "of light",
     .bound = 0.006,
     .per_isa = true,
     .measure = measure_odd_sizes},
    {.id = "N30",
     .promise = "A texture of one texel shows its colour with every filter and scale.",
     .truth = "the texel",
     .unit = "of light",
     .bound = 0.006,
     .per_isa = true,
     .measure = measure_single_texel},
    {.id = "N31",
     .promise = "No bias and no dropped level leads out of the mip chain, from 2^-100 to 2^100 "
                "repeats per metre.",
     .truth = "the colour of a texture of one colour",
     .unit = "of light",
     .bound = 0.0,
     .per_isa = true,
     .measure = measure_bias},
    {.id = "N32",
     .promise = "Level of detail and blend change together: 1/64 of a level changes mip colours by "
                "1/64 of their difference, without a jump at whole levels.",
     .truth = "the greatest change of a blend of two colours",
     .unit = "of light",
     .bound = 0.025,
     .per_isa = true,
     .measure = measure_level_steps},
    {.id = "N33",
     .promise =
         "The binary logarithm of the level of detail is exact at powers of two, never falls "
         "and errs by less than 1.4e-5.",
     .truth = "`log2l`",
     .unit = "levels",
     .bound = 1.4e-5,
     .measure = measure_log2},
    {.id = "N34",
     .promise =
         "Adaptive AA, AF and compressed textures, too, keep alpha that equals the cutoff and "
         "drop alpha half a step below it.",
     .truth = "the comparison of the two values",
     .unit = "share of the pixels",
     .per_isa = true,
     .measure = measure_equal_alpha},
    {.id = "N35",
     .promise = "Halfway between texels of alpha 0 and 1, alpha is exactly 1/2: a cutoff of 1/2 "
                "keeps it.",
     .truth = "1/2",
     .unit = "of light",
     .per_isa = true,
     .measure = measure_halfway_alpha},
};

const StabilityTopic stability_texture = {"texture", "Textures and level of detail", rows,
                                          sizeof rows / sizeof *rows};
