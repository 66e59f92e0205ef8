// Tests the render scale: the box filter against whole numbers and double precision, the light that
// the pipeline hands to it, and the sizes that are drawn.
#include "renderer/base/srgb.h"
#include "renderer/catalogue/random.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/draw/box.h"
#include "tests/renderer/scene/stage.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static DipSrgbEncodeTable codes;

// --- the box filter ------------------------------------------------------------------------------

// A random picture in 16-bit light, and the smaller picture that is made of it.
typedef struct Pictures {
    DipBoxFilter box;
    uint16_t *light16; // red, green and blue of each pixel
    uint8_t *rgba8;
} Pictures;

static void make_pictures(Pictures *pictures, Random *random, int from_width, int from_height,
                          int width, int height) {
    const size_t from = (size_t)from_width * (size_t)from_height * 3;
    const size_t kept = dip_box_light_bytes(from_width, from_height, width, height);
    pictures->light16 = malloc(from * sizeof *pictures->light16);
    pictures->rgba8 = calloc((size_t)width * (size_t)height, 4);
    assert_non_null(pictures->light16);
    assert_non_null(pictures->rgba8);
    for (size_t i = 0; i < from; i++) {
        pictures->light16[i] = (uint16_t)random_u64(random);
    }
    pictures->box = (DipBoxFilter){.from_width = from_width,
                                   .from_height = from_height,
                                   .to = {.rgba8 = pictures->rgba8,
                                          .stride_bytes = (size_t)width * 4,
                                          .width = width,
                                          .height = height},
                                   .light16 = kept ? malloc(kept) : NULL,
                                   .srgb = &codes};
    assert_true(!kept || pictures->box.light16);
}

static void free_pictures(Pictures *pictures) {
    free(pictures->light16);
    free(pictures->rgba8);
    free(pictures->box.light16);
}

static uint16_t light_at(const Pictures *pictures, int x, int y, int c) {
    return pictures->light16[3 * (y * pictures->box.from_width + x) + c];
}

static int smaller(int a, int b) {
    return a < b ? a : b;
}

// Hands the picture over as the tiles of a pass are, and averages it.
static void average(const Pictures *pictures, DipPool *pool) {
    enum { TILE = DIP_TARGET_TILE };
    static uint16_t light16[3 * TILE * TILE];
    DipBoxFilter box = pictures->box;
    for (int y0 = 0; y0 < box.from_height; y0 += TILE) {
        for (int x0 = 0; x0 < box.from_width; x0 += TILE) {
            const DipTargetRegion pixels = {x0, y0, smaller(x0 + TILE, box.from_width),
                                            smaller(y0 + TILE, box.from_height)};
            for (int y = y0; y < pixels.y1; y++) {
                for (int x = x0; x < pixels.x1; x++) {
                    for (int c = 0; c < 3; c++) {
                        light16[c * TILE * TILE + (y - y0) * TILE + x - x0] =
                            light_at(pictures, x, y, c);
                    }
                }
            }
            dip_box_take_tile(&box, &pixels, light16);
        }
    }
    dip_box_filter(&box, pool);
}

// Returns the mean of a channel over the part of the larger picture that belongs to a pixel, in
// double precision.
static double mean_at(const Pictures *pictures, int x, int y, int c) {
    const DipBoxFilter *box = &pictures->box;
    const double across = (double)box->from_width / box->to.width;
    const double down = (double)box->from_height / box->to.height;
    double sum = 0.0;
    for (int j = 0; j < box->from_height; j++) {
        const double high = fmin(j + 1.0, (y + 1) * down) - fmax(j, y * down);
        for (int i = 0; high > 0.0 && i < box->from_width; i++) {
            const double wide = fmin(i + 1.0, (x + 1) * across) - fmax(i, x * across);
            if (wide > 0.0) {
                sum += wide * high * light_at(pictures, i, j, c);
            }
        }
    }
    return sum / (across * down);
}

static void filters_match_double_precision_at_every_ratio(void **state) {
    (void)state;
    static const int sizes[][4] = {{80, 60, 64, 48},    {5, 5, 4, 4},      {81, 61, 65, 49},
                                   {96, 72, 64, 48},    {3, 2, 2, 1},      {128, 96, 64, 48},
                                   {191, 143, 127, 95}, {100, 75, 67, 50}, {1, 1, 1, 1},
                                   {2, 3, 1, 2},        {7, 90, 7, 72},    {130, 9, 65, 8}};
    Random random = {1025};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        Pictures pictures;
        make_pictures(&pictures, &random, sizes[s][0], sizes[s][1], sizes[s][2], sizes[s][3]);
        average(&pictures, NULL);
        for (int i = 0; i < sizes[s][2] * sizes[s][3]; i++) {
            for (int c = 0; c < 3; c++) {
                const double mean = mean_at(&pictures, i % sizes[s][2], i / sizes[s][2], c);
                const int code = pictures.rgba8[4 * i + c];
                // The mean is rounded once; a sum of doubles may lie on the other side of a half.
                assert_true(code == dip_srgb_code(&codes, (int)floor(mean + 0.5 - 1e-6)) ||
                            code == dip_srgb_code(&codes, (int)floor(mean + 0.5 + 1e-6)));
            }
            assert_int_equal(pictures.rgba8[4 * i + 3], 255);
        }
        free_pictures(&pictures);
    }
}

// Returns the exact mean over the part of the larger picture that belongs to a pixel, rounded to
// the nearest whole number, halves up. Lengths are in units of 1 / (from * to).
static uint32_t whole_mean(const Pictures *pictures, int x, int y, int c) {
    const DipBoxFilter *box = &pictures->box;
    const int64_t from[2] = {box->from_width, box->from_height};
    const int64_t to[2] = {box->to.width, box->to.height}, at[2] = {x, y};
    uint64_t sum = 0;
    int64_t begin[2], end[2];
    for (int axis = 0; axis < 2; axis++) {
        begin[axis] = at[axis] * from[axis];
        end[axis] = begin[axis] + from[axis];
    }
    for (int64_t j = begin[1] / to[1]; j * to[1] < end[1]; j++) {
        for (int64_t i = begin[0] / to[0]; i * to[0] < end[0]; i++) {
            const int64_t pixel[2] = {i, j};
            int64_t overlap[2];
            for (int axis = 0; axis < 2; axis++) {
                const int64_t first = pixel[axis] * to[axis], last = first + to[axis];
                overlap[axis] = (last < end[axis] ? last : end[axis]) -
                                (first > begin[axis] ? first : begin[axis]);
            }
            sum += (uint64_t)(overlap[0] * overlap[1]) * light_at(pictures, (int)i, (int)j, c);
        }
    }
    const uint64_t whole = (uint64_t)(from[0] * from[1]);
    return (uint32_t)((2 * sum + whole) / (2 * whole));
}

// Averages the pictures, and returns all 16 bits of the light of each channel. A table of codes
// shows some of them: the upper eight, the eight from bit 4 on, or whether the lowest four are at
// least a number.
static void average_light(Pictures *pictures, int code_count, uint16_t *light16) {
    static DipSrgbEncodeTable table;
    enum { RUNS = (DIP_LINEAR16_MAX + 1) / DIP_SRGB_RUN };
    const DipSrgbEncodeTable *const srgb = pictures->box.srgb;
    pictures->box.srgb = &table;
    memset(light16, 0, (size_t)code_count * sizeof *light16);
    for (int pass = 0; pass <= DIP_SRGB_RUN; pass++) {
        for (int r = 0; r < RUNS; r++) {
            table.runs[r] = (uint16_t)(pass == 0   ? (r >> 4) * DIP_SRGB_RUN
                                       : pass == 1 ? (r & 255) * DIP_SRGB_RUN
                                                   : DIP_SRGB_RUN - (pass - 1));
        }
        average(pictures, NULL);
        for (int i = 0; i < code_count; i++) {
            const int code = pictures->rgba8[i];
            light16[i] = (uint16_t)(pass == 0   ? code << 8
                                    : pass == 1 ? light16[i] | (code & 15) << 4
                                                : light16[i] + code);
        }
    }
    pictures->box.srgb = srgb;
}

static void every_ratio_is_exact_in_whole_numbers(void **state) {
    (void)state;
    static uint16_t light16[4 * 8192];
    Random random = {31};
    for (int i = 0; i < 400; i++) {
        const bool wide = i % 8 == 0; // The greatest sums have the greatest sizes.
        const int width = random_int(&random, wide ? 4000 : 1, wide ? 4096 : 90);
        const int height = wide ? 1 : random_int(&random, 1, 40);
        Pictures pictures;
        make_pictures(&pictures, &random, random_int(&random, width, 2 * width),
                      random_int(&random, height, 2 * height), width, height);
        if (i % 3 == 0) { // Few different lights give means at halves.
            const int count = 3 * pictures.box.from_width * pictures.box.from_height;
            for (int k = 0; k < count; k++) {
                pictures.light16[k] = (uint16_t)(65535 - pictures.light16[k] % 2);
            }
        }
        average_light(&pictures, 4 * width * height, light16);
        for (int p = 0; p < width * height; p++) {
            for (int c = 0; c < 3; c++) {
                assert_int_equal(light16[4 * p + c],
                                 whole_mean(&pictures, p % width, p / width, c));
            }
        }
        free_pictures(&pictures);
    }
}

static void twice_the_size_is_the_rounded_mean_of_four_whole_numbers(void **state) {
    (void)state;
    enum { WIDTH = 131, HEIGHT = 47 };
    Random random = {4};
    Pictures pictures;
    make_pictures(&pictures, &random, 2 * WIDTH, 2 * HEIGHT, WIDTH, HEIGHT);
    DipPool *pool = dip_pool_create(3, NULL);
    average(&pictures, pool);
    dip_pool_destroy(&pool);
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            for (int c = 0; c < 3; c++) {
                uint32_t sum = 2;
                for (int k = 0; k < 4; k++) {
                    sum += light_at(&pictures, 2 * x + k % 2, 2 * y + k / 2, c);
                }
                assert_int_equal(pictures.rgba8[4 * (y * WIDTH + x) + c],
                                 dip_srgb_code(&codes, (int32_t)(sum >> 2)));
            }
        }
    }
    free_pictures(&pictures);
}

static void a_single_colour_stays_exact(void **state) {
    (void)state;
    Random random = {7};
    for (int i = 0; i < 300; i++) {
        const int width = random_int(&random, 1, 70), height = random_int(&random, 1, 20);
        const int from_width = random_int(&random, width, 2 * width);
        const int from_height = random_int(&random, height, 2 * height);
        const uint16_t light = (uint16_t)random_u64(&random);
        Pictures pictures;
        make_pictures(&pictures, &random, from_width, from_height, width, height);
        for (int k = 0; k < 3 * from_width * from_height; k++) {
            pictures.light16[k] = light;
        }
        average(&pictures, NULL);
        for (int k = 0; k < width * height; k++) {
            assert_int_equal(pictures.rgba8[4 * k], dip_srgb_code(&codes, light));
        }
        free_pictures(&pictures);
    }
}

// --- the light of the larger picture -------------------------------------------------------------

static void shade(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        batch->colour[0][i] = batch->varying[0][i];
        batch->colour[1][i] = 0.5f;
        batch->colour[2][i] = batch->varying[1][i];
    }
}

static void place(const DipVertexBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        for (int k = 0; k < 2; k++) {
            batch->clip[k][i] = batch->in[k][i];
            batch->varying[k][i] = 0.5f + 0.5f * batch->in[k][i];
        }
        batch->clip[2][i] = 0.5f;
        batch->clip[3][i] = 1.0f;
    }
}

enum { LIT_WIDTH = 150, LIT_HEIGHT = 71 };

typedef uint16_t LitPicture[LIT_HEIGHT][LIT_WIDTH][3];

static void keep_light(void *context, const DipTargetRegion *pixels, const uint16_t *light16) {
    enum { TILE = DIP_TARGET_TILE };
    LitPicture *picture = context;
    assert_non_null(light16);
    for (int y = pixels->y0; y < pixels->y1; y++) {
        for (int x = pixels->x0; x < pixels->x1; x++) {
            for (int c = 0; c < 3; c++) {
                (*picture)[y][x][c] =
                    light16[c * TILE * TILE + (y - pixels->y0) * TILE + x - pixels->x0];
            }
        }
    }
}

// The light of a tile is the light that would be encoded: it has the code that the pixel has
// without it, and is as precise as the mean of its samples, which a readback knows. The target
// stays as it was.
static void the_light_of_tiles_is_the_mean_of_the_samples(void **state) {
    (void)state;
    enum { WIDTH = LIT_WIDTH, HEIGHT = LIT_HEIGHT };
    static uint8_t picture[HEIGHT][WIDTH][4];
    static uint8_t untouched[HEIGHT][WIDTH][4];
    static LitPicture light16;
    static const float vertices[6][3] = {{-0.9f, -0.8f, 0}, {0.7f, -0.3f, 0}, {-0.1f, 0.9f, 0},
                                         {0.2f, 0.1f, 0},   {2.0f, 0.3f, 0},  {0.6f, 3.0f, 0}};
    static const uint32_t indices[6] = {0, 1, 2, 3, 4, 5};
    const DipTargetRegion all = {0, 0, WIDTH, HEIGHT};
    DipSampleValue *samples = calloc(dip_sample_room(&all), sizeof *samples);
    DipMesh *mesh =
        dip_mesh_create(&(DipMeshData){"triangles", &vertices[0][0], 3, 6, indices, 6}, NULL);
    assert_non_null(samples);
    for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
        DipPipeline *pipeline = dip_isa_available((DipIsa)isa)
                                    ? dip_pipeline_create(NULL, (DipIsa)isa, WIDTH, HEIGHT, NULL)
                                    : NULL;
        static const int counts[] = {1, 2, 4, 6, 8};
        for (int s = 0; pipeline && s < 5; s++) {
            const DipSampleReadback readback = {all, samples};
            const DipDraw draw = {
                .mesh = mesh, .vertex_shader = place, .fragment_shader = shade, .varying_count = 2};
            DipPass pass = {.draws = &draw,
                            .draw_count = 1,
                            .sample_count = counts[s],
                            .clear_lin = {0.1f, 0.7f, 1.0f},
                            .target = {.rgba8 = &picture[0][0][0],
                                       .stride_bytes = WIDTH * 4,
                                       .width = WIDTH,
                                       .height = HEIGHT},
                            .tile_done = keep_light,
                            .tile_context = &light16,
                            .readback = &readback};
            memset(light16, 1, sizeof light16);
            memset(picture, 7, sizeof picture);
            memset(untouched, 7, sizeof untouched);
            DipError err = {0};
            if (!dip_pipeline_draw(pipeline, &pass, NULL, NULL, &err)) {
                fail_msg("%s: %s", err.key, err.message);
            }
            assert_memory_equal(picture, untouched, sizeof picture);
            pass.tile_done = NULL;
            assert_true(dip_pipeline_draw(pipeline, &pass, NULL, NULL, &err));
            for (int i = 0; i < WIDTH * HEIGHT; i++) {
                const int x = i % WIDTH, y = i / WIDTH;
                for (int c = 0; c < 3; c++) {
                    int sum = counts[s] / 2;
                    for (int k = 0; k < counts[s]; k++) {
                        sum += samples[dip_sample_index(&all, x, y) + (size_t)k].linear16[c];
                    }
                    assert_int_equal(light16[y][x][c], sum / counts[s]);
                    assert_int_equal(picture[y][x][c], dip_srgb_code(&codes, light16[y][x][c]));
                }
            }
        }
        dip_pipeline_destroy(&pipeline);
    }
    dip_mesh_destroy(&mesh);
    free(samples);
}

// What a pass with an ordered draw is drawn to.
typedef struct OrderedPictures {
    LitPicture light16;
    uint8_t codes[LIT_HEIGHT][LIT_WIDTH][4];
    float floats[LIT_HEIGHT][LIT_WIDTH][4];
} OrderedPictures;

// Draws a pass to the light of its tiles, to sRGB codes, and to floats.
static void draw_three_times(DipPipeline *pipeline, const DipPass *pass, OrderedPictures *out) {
    DipPass other = *pass;
    memset(out, 1, sizeof *out);
    other.target = (DipTarget){.rgba8 = &out->codes[0][0][0],
                               .stride_bytes = LIT_WIDTH * 4,
                               .width = LIT_WIDTH,
                               .height = LIT_HEIGHT};
    other.tile_done = keep_light;
    other.tile_context = &out->light16;
    assert_true(dip_pipeline_draw(pipeline, &other, NULL, NULL, NULL));
    for (size_t i = 0; i < sizeof out->codes; i++) {
        assert_int_equal((&out->codes[0][0][0])[i], 1); // The target stays as it was.
    }
    other.tile_done = NULL;
    assert_true(dip_pipeline_draw(pipeline, &other, NULL, NULL, NULL));
    other.target.format = DIP_FORMAT_RGBA32F;
    other.target.rgba8 = (uint8_t *)&out->floats[0][0][0];
    other.target.stride_bytes = LIT_WIDTH * sizeof out->floats[0][0];
    assert_true(dip_pipeline_draw(pipeline, &other, NULL, NULL, NULL));
}

// Ordered draws change nothing of this, in the tiles that they reach and in the others: the light
// has the code that the pixel has without it, and is as precise as the floats of another target but
// for the rounding of the samples. Where an ordered draw blends nothing, the light has the same
// bits as without it.
static void the_light_of_tiles_is_the_same_beside_ordered_draws(void **state) {
    (void)state;
    static OrderedPictures plain, glass, nothing;
    static const float vertices[6][3] = {{-0.9f, -0.8f, 0}, {0.7f, -0.3f, 0}, {-0.1f, 0.9f, 0},
                                         {-1.0f, 0.1f, 0},  {-0.2f, 0.3f, 0}, {-0.6f, 1.0f, 0}};
    static const uint32_t indices[2][3] = {{0, 1, 2}, {3, 4, 5}};
    const DipDrawState blend = {
        .depth_test = DIP_DEPTH_ALWAYS,
        .blend = {true,
                  {DIP_BLEND_CONSTANT, DIP_BLEND_ONE_MINUS_CONSTANT, DIP_BLEND_ADD},
                  DIP_BLEND_ALPHA_IS_SOURCE,
                  {0.3f, 0.6f, 0.9f, 0.0f}}};
    const DipDrawState blend_nothing = {.depth_test = DIP_DEPTH_ALWAYS,
                                        .blend = {true,
                                                  {DIP_BLEND_ZERO, DIP_BLEND_ONE, DIP_BLEND_ADD},
                                                  DIP_BLEND_ALPHA_IS_SOURCE,
                                                  {0.0f, 0.0f, 0.0f, 0.0f}}};
    DipDraw draws[2];
    for (int d = 0; d < 2; d++) {
        const DipMeshData data = {"triangle", &vertices[0][0], 3, 6, indices[d], 3};
        draws[d] = (DipDraw){.mesh = dip_mesh_create(&data, NULL),
                             .vertex_shader = place,
                             .fragment_shader = shade,
                             .varying_count = 2};
    }
    for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
        DipPipeline *pipeline =
            dip_isa_available((DipIsa)isa)
                ? dip_pipeline_create(NULL, (DipIsa)isa, LIT_WIDTH, LIT_HEIGHT, NULL)
                : NULL;
        static const int counts[] = {1, 2, 4, 6, 8};
        for (int s = 0; pipeline && s < 5; s++) {
            DipPass pass = {.draws = draws,
                            .draw_count = 1,
                            .sample_count = counts[s],
                            .clear_lin = {0.1f, 0.7f, 1.0f}};
            draw_three_times(pipeline, &pass, &plain);
            pass.draw_count = 2;
            draws[1].state = &blend;
            draw_three_times(pipeline, &pass, &glass);
            draws[1].state = &blend_nothing;
            draw_three_times(pipeline, &pass, &nothing);
            assert_memory_equal(plain.light16, nothing.light16, sizeof plain.light16);
            int blended = 0;
            for (int i = 0; i < LIT_WIDTH * LIT_HEIGHT * 3; i++) {
                const int x = i / 3 % LIT_WIDTH, y = i / 3 / LIT_WIDTH, c = i % 3;
                const uint16_t light = glass.light16[y][x][c];
                assert_int_equal(glass.codes[y][x][c], dip_srgb_code(&codes, light));
                assert_true(fabs(65535.0 * (double)glass.floats[y][x][c] - light) <= 1.01);
                blended += light != plain.light16[y][x][c];
            }
            assert_true(blended > 1000);
        }
        dip_pipeline_destroy(&pipeline);
    }
    dip_mesh_destroy((DipMesh **)&draws[0].mesh);
    dip_mesh_destroy((DipMesh **)&draws[1].mesh);
}

// --- frames --------------------------------------------------------------------------------------

static void sizes_are_rounded_to_the_nearest_whole_number(void **state) {
    (void)state;
    // A step is over / under; halves are rounded up.
    static const struct {
        const char *step;
        int over, under;
    } steps[] = {{"1", 1, 1},       {"1.25", 5, 4},    {"1.5", 3, 2},     {"2", 2, 1},
                 {"1/1.3", 10, 13}, {"1/1.5", 10, 15}, {"1/1.7", 10, 17}, {"1/2", 10, 20}};
    for (int s = 0; s < 8; s++) {
        char text[32];
        DipQuality quality;
        snprintf(text, sizeof text, "scale=%s", steps[s].step);
        assert_true(dip_quality_parse(text, &quality, NULL));
        assert_true(dip_quality_scale(&quality) == (double)steps[s].over / steps[s].under);
        assert_int_equal(dip_quality_upscales(&quality), steps[s].over < steps[s].under);
        for (int size = 1; size <= DIP_MAX_FRAME_SIZE; size++) {
            const int drawn = dip_quality_drawn_size(&quality, size);
            // The size is nearest to the exact one, and never 0.
            const int miss = 2 * (drawn * steps[s].under - size * steps[s].over);
            assert_true(drawn >= 1 && miss <= steps[s].under && miss > -steps[s].under);
        }
    }
}

static Stage open_stage(DipTestSceneKind kind, int width, int height) {
    return stage_open_kind(kind, stage_def(width, height, ""), 1);
}

// The larger picture, with its reflection, has the work of a frame of its size.
static void the_work_is_that_of_a_larger_frame(void **state) {
    (void)state;
    static const struct {
        const char *settings;
        int width, height;
    } rows[] = {{"scale=2", 320, 240}, {"scale=1.5", 240, 180}, {"scale=1.25,aa=4", 200, 150}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        Stage stage = open_stage(DIP_TEST_SCENE_water, 160, 120);
        const DipFrame small = stage_draw_kind(&stage, rows[i].settings);
        assert_int_equal(small.width, 160);
        assert_int_equal(small.height, 120);
        Stage larger = open_stage(DIP_TEST_SCENE_water, rows[i].width, rows[i].height);
        DipReflectionDef reflection = larger.made->reflection;
        DipQuality quality;
        assert_true(dip_quality_parse(rows[i].settings, &quality, NULL));
        reflection.width = dip_quality_drawn_size(&quality, reflection.width);
        reflection.height = dip_quality_drawn_size(&quality, reflection.height);
        assert_true(dip_renderer_set_reflection(larger.renderer, &reflection, NULL));
        const DipFrame large = stage_draw_kind(&larger, quality.step[DIP_SETTING_AA] ? "aa=4" : "");
        assert_true(small.effects.reflection.run);
        assert_memory_equal(&small.counters, &large.counters, sizeof large.counters);
        stage_close(&larger);
        stage_close(&stage);
    }
}

// Turning a scale on and off leaves the picture and the recording of tiles as they were.
static void a_scale_that_is_turned_off_leaves_nothing(void **state) {
    (void)state;
    char hashes[3][33];
    Stage stage = open_stage(DIP_TEST_SCENE_water, 160, 120);
    assert_true(dip_renderer_record_tiles(stage.renderer, true, NULL));
    DipFrame frame = stage_draw_kind(&stage, "aa=2");
    dip_frame_hash(&frame, hashes[0]);
    assert_int_equal(frame.tiles.across, 3);
    frame = stage_draw_kind(&stage, "aa=2,scale=1.5");
    dip_frame_hash(&frame, hashes[1]);
    assert_null(frame.tiles.records);
    frame = stage_draw_kind(&stage, "aa=2");
    dip_frame_hash(&frame, hashes[2]);
    assert_int_equal(frame.tiles.across, 3);
    assert_string_equal(hashes[0], hashes[2]);
    assert_string_not_equal(hashes[0], hashes[1]);
    DipSampleValue samples[DIP_READBACK_STRIDE];
    const DipSampleReadback readback = {{0, 0, 1, 1}, samples};
    DipError err = {0};
    DipQuality quality;
    assert_true(dip_quality_parse("scale=2", &quality, NULL));
    assert_true(dip_renderer_set_quality(stage.renderer, &quality, NULL));
    assert_false(dip_renderer_read_samples(stage.renderer, stage.scene, &stage.made->pose, 0,
                                           &readback, &err));
    assert_int_equal(err.code, DIP_ERROR_UNSUPPORTED);
    assert_string_equal(err.key, "scale");
    stage_close(&stage);
}

static void pictures_that_would_be_too_large_are_refused(void **state) {
    (void)state;
    DipQuality quality;
    DipFrame frame;
    DipError err = {0};
    Stage stage = open_stage(DIP_TEST_SCENE_vertex_colours, DIP_MAX_FRAME_SIZE / 2 + 1, 1);
    assert_true(dip_quality_parse("scale=2", &quality, NULL));
    assert_true(dip_renderer_set_quality(stage.renderer, &quality, NULL));
    assert_false(
        dip_renderer_draw(stage.renderer, stage.scene, &stage.made->pose, 0, &frame, &err));
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    assert_string_equal(err.key, "scale");
    stage_draw_kind(&stage, "scale=1.25");
    stage_close(&stage);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(filters_match_double_precision_at_every_ratio),
        cmocka_unit_test(every_ratio_is_exact_in_whole_numbers),
        cmocka_unit_test(twice_the_size_is_the_rounded_mean_of_four_whole_numbers),
        cmocka_unit_test(a_single_colour_stays_exact),
        cmocka_unit_test(the_light_of_tiles_is_the_mean_of_the_samples),
        cmocka_unit_test(the_light_of_tiles_is_the_same_beside_ordered_draws),
        cmocka_unit_test(sizes_are_rounded_to_the_nearest_whole_number),
        cmocka_unit_test(the_work_is_that_of_a_larger_frame),
        cmocka_unit_test(a_scale_that_is_turned_off_leaves_nothing),
        cmocka_unit_test(pictures_that_would_be_too_large_are_refused),
    };
    dip_srgb_encode_table(&codes);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
