// Tests large texture coordinates. Whole numbers added to the coordinates of repeating textures do
// not change a picture, and a floor of 20 km looks right wherever the eye is.
#include "renderer/reference/reference.h"
#include "renderer/scene/draw/draws.h"
#include "renderer/scene/renderer.h"
#include "renderer/catalogue/random.h"
#include "tests/renderer/scene/image.h"
#include "renderer/catalogue/scenes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 160, HEIGHT = 120 };

// Draws a scene into `pixels`, which is WIDTH * HEIGHT pixels large.
static void draw(const DipTestScene *scene, const char *settings, uint32_t *pixels) {
    DipPool *pool = dip_pool_create(1, NULL);
    DipRendererDef def = dip_renderer_default_def();
    def.pool = pool;
    def.width = WIDTH;
    def.height = HEIGHT;
    def.reflection = scene->reflection;
    assert_true(dip_quality_parse(settings, &def.quality, NULL));
    DipScene *made = dip_scene_create(&scene->def, NULL, NULL);
    DipRenderer *renderer = dip_renderer_create(&def, NULL);
    DipFrame frame;
    assert_non_null(made);
    assert_non_null(renderer);
    assert_true(dip_renderer_draw(renderer, made, &scene->pose, 0, &frame, NULL));
    for (int y = 0; y < HEIGHT; y++) {
        memcpy(pixels + y * WIDTH, frame.rgba8 + (size_t)y * frame.stride_bytes, 4 * WIDTH);
    }
    dip_renderer_destroy(&renderer);
    dip_scene_destroy(&made);
    dip_pool_destroy(&pool);
}

static int count_differences(const uint32_t *a, const uint32_t *b) {
    int count = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        count += a[i] != b[i];
    }
    return count;
}

// Whether a texture, which may be DIP_NO_TEXTURE, repeats along an axis.
static bool repeats(const DipTestScene *scene, int texture, int axis) {
    return texture == DIP_NO_TEXTURE || (axis ? scene->textures[texture].wrap_v
                                              : scene->textures[texture].wrap_u) == DIP_WRAP_REPEAT;
}

// Rounds coordinates to multiples of 1/8, which floats hold up to 2^21, and adds whole numbers
// along the axes that repeat. uv: may be NULL.
static void shift(float *uv, uint32_t vertex_count, const bool axes[2], const float by[2]) {
    for (uint32_t i = 0; uv && i < 2 * vertex_count; i++) {
        uv[i] = roundf(uv[i] * 8.0f) / 8.0f + (axes[i % 2] ? by[i % 2] : 0.0f);
    }
}

static void shift_scene(DipTestScene *scene, const float by[2]) {
    for (int m = 0; m < scene->def.mesh_count; m++) {
        DipMeshDef *mesh = &scene->meshes[m];
        const DipMaterialDef *material = &scene->materials[mesh->material];
        bool axes[2][2];
        for (int axis = 0; axis < 2; axis++) {
            axes[0][axis] = material->surface != DIP_SURFACE_SKY &&
                            repeats(scene, material->colour_texture, axis) &&
                            repeats(scene, material->normal_map, axis);
            axes[1][axis] = repeats(scene, material->light_map, axis);
        }
        shift((float *)mesh->uv0, mesh->vertex_count, axes[0], by);
        shift((float *)mesh->uv1, mesh->vertex_count, axes[1], by);
    }
}

static void whole_numbers_added_to_repeating_coordinates_change_no_bit(void **state) {
    (void)state;
    static const float shifts[][2] = {
        {0.0f, 0.0f}, {4096.0f, 0.0f}, {-65536.0f, 4096.0f}, {1048576.0f, -1048576.0f}};
    static const char *const settings[] = {"aa=none", "aa=4,af=16",
                                           "aa=8,aaa=on,asd=2,af=4,aaf=on"};
    static uint32_t pictures[2][WIDTH * HEIGHT];
    int missed = 0;
    for (int kind = 0; kind < DIP_TEST_SCENE_COUNT; kind++) {
        for (size_t s = 0; s < sizeof settings / sizeof settings[0]; s++) {
            for (size_t i = 0; i < sizeof shifts / sizeof shifts[0]; i++) {
                DipTestScene scene;
                dip_test_scene_make(&scene, (DipTestSceneKind)kind);
                shift_scene(&scene, shifts[i]);
                draw(&scene, settings[s], pictures[i > 0]);
                dip_test_scene_free(&scene);
                const int count = i ? count_differences(pictures[0], pictures[1]) : 0;
                if (count) {
                    printf("%s, %s: %d pixels differ with (%.0f, %.0f) added\n",
                           dip_test_scene_name((DipTestSceneKind)kind), settings[s], count,
                           (double)shifts[i][0], (double)shifts[i][1]);
                    missed++;
                }
            }
        }
    }
    assert_int_equal(missed, 0);
}

// --- coordinates that do not repeat ------------------------------------------------------------

// A texture of a black and a white texel, clamped along u, on a quad that fills the picture. Its u
// runs from -100 to 100, so the left half is black and the right half is white.
static void clamped_coordinates_are_not_reduced(void **state) {
    (void)state;
    DipTestScene scene;
    dip_test_scene_begin(&scene);
    const int texture = dip_test_scene_add_texture(&scene, DIP_TEST_CHECKER, 2, 1);
    memset(dip_test_scene_texels(&scene, texture), 0, 3);
    memset(dip_test_scene_texels(&scene, texture) + 4, 255, 3);
    scene.textures[texture].wrap_u = DIP_WRAP_CLAMP;
    const int material = dip_test_scene_add_material(&scene, texture);
    dip_test_scene_add_quad(&scene, material, (const float[]){-2, -2, -1}, (const float[]){4, 0, 0},
                            (const float[]){0, 4, 0}, 200, 200);
    for (int v = 0; v < 4; v++) {
        ((float *)scene.meshes[0].uv0)[2 * v] -= 100.0f;
    }
    static uint32_t pixels[WIDTH * HEIGHT];
    draw(&scene, "aa=none", pixels);
    dip_test_scene_free(&scene);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int x = i % WIDTH - WIDTH / 2;
        if (x < -8 || x >= 8) {
            assert_int_equal(pixels[i], x < 0 ? 0xff000000u : 0xffffffffu);
        }
    }
}

// The layers of a sky multiply its coordinates by 1 and by 1.7.
static void the_coordinates_of_a_sky_are_not_reduced(void **state) {
    (void)state;
    DipTestScene scene;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_sky);
    for (uint32_t i = 0; i < 2 * scene.meshes[0].vertex_count; i++) {
        ((float *)scene.meshes[0].uv0)[i] += 40.0f;
    }
    DipReference *reference = dip_reference_create(&scene.def, NULL);
    static double expected[WIDTH * HEIGHT * 3];
    static uint32_t pixels[WIDTH * HEIGHT];
    const DipQuality quality = dip_quality_default();
    assert_non_null(reference);
    assert_true(
        dip_reference_draw(reference, &quality, &scene.pose, WIDTH, HEIGHT, expected, NULL));
    draw(&scene, "", pixels);
    const DipFrame frame = {
        .rgba8 = (uint8_t *)pixels, .stride_bytes = 4 * WIDTH, .width = WIDTH, .height = HEIGHT};
    const double rms_lin = dip_image_compare(expected, &frame, 1.0).rms_lin;
    printf("RMS %.4f\n", rms_lin);
    assert_true(rms_lin < 0.003);
    dip_reference_destroy(&reference);
    dip_test_scene_free(&scene);
}

// --- a floor of 20 km --------------------------------------------------------------------------

// The coordinates that the fragment shader gets at each pixel.
typedef struct Seen {
    bool there;
    double u;
    double v;
} Seen;

static Seen seen[HEIGHT][WIDTH];

static void record(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        seen[(int)batch->y[i]][(int)batch->x[i]] =
            (Seen){true, (double)batch->varying[0][i], (double)batch->varying[1][i]};
        for (int c = 0; c < 3; c++) {
            batch->colour[c][i] = 0.0f;
        }
    }
}

// Makes a floor of 20 km at y = 0 with one repeat of its texture per metre. At x = z = 0, the
// coordinates are (offset, offset).
static void make_floor(DipTestScene *scene, float offset) {
    dip_test_scene_begin(scene);
    const int material = dip_test_scene_add_material(
        scene, dip_test_scene_add_texture(scene, DIP_TEST_NOISE, 64, 64));
    dip_test_scene_add_quad(scene, material, (const float[]){-10000, 0, 10000},
                            (const float[]){20000, 0, 0}, (const float[]){0, 0, -20000}, 20000,
                            20000);
    for (int i = 0; i < 8; i++) {
        ((float *)scene->meshes[0].uv0)[i] += offset - 10000.0f;
    }
}

// Draws the floor and fills in `seen`.
static void draw_floor(const DipTestScene *scene) {
    DipPool *pool = dip_pool_create(1, NULL);
    DipScene *made = dip_scene_create(&scene->def, NULL, NULL);
    DipPipeline *pipeline = dip_pipeline_create(pool, dip_isa_best(), WIDTH, HEIGHT, NULL);
    assert_non_null(made);
    assert_non_null(pipeline);
    const DipQuality quality = dip_quality_default();
    const DipView view = dip_view_make(&scene->pose, 0.1, (double)WIDTH / HEIGHT);
    static DipMaterialSamplers samplers[DIP_TEST_SCENE_PARTS];
    const DipDrawInput input = {.scene = made,
                                .kernels = dip_material_kernels(dip_isa_best()),
                                .quality = &quality,
                                .samplers = (const DipMaterialSamplers *)samplers};
    const DipDrawView pass_view = {.view = &view, .width = WIDTH, .height = HEIGHT};
    DipDrawSet set = {.count = 0};
    assert_true(dip_draw_set_make(&set, made, false, NULL));
    dip_draw_set_fill(&set, &input, &pass_view);
    set.draws[0].fragment_shader = record;
    static uint32_t pixels[WIDTH * HEIGHT];
    const DipPass pass = {.draws = set.draws,
                          .draw_count = 1,
                          .sample_count = 1,
                          .target = {.rgba8 = (uint8_t *)pixels,
                                     .stride_bytes = 4 * WIDTH,
                                     .width = WIDTH,
                                     .height = HEIGHT}};
    DipPipelineCounters counters = {0};
    DipStageTimes times = {0};
    memset(seen, 0, sizeof seen);
    assert_true(dip_pipeline_draw(pipeline, &pass, &counters, &times, NULL));
    dip_draw_set_free(&set);
    dip_pipeline_destroy(&pipeline);
    dip_scene_destroy(&made);
    dip_pool_destroy(&pool);
}

// Computes the exact coordinates of the floor at a position in pixels, without the offset.
static void exact_coordinates(const DipPose *pose, long double x, long double y,
                              long double uv[2]) {
    const long double slope = 1.0L / sqrtl(3.0L); // the field of view is 60 degrees
    const long double ray[3] = {(2.0L * x / WIDTH - 1.0L) * slope * WIDTH / HEIGHT,
                                (1.0L - 2.0L * y / HEIGHT) * slope, -1.0L};
    const long double a = pose->orientation[0], b = pose->orientation[1], c = pose->orientation[2],
                      d = pose->orientation[3];
    const long double rows[3][3] = {
        {1 - 2 * (b * b + c * c), 2 * (a * b - d * c), 2 * (a * c + d * b)},
        {2 * (a * b + d * c), 1 - 2 * (a * a + c * c), 2 * (b * c - d * a)},
        {2 * (a * c - d * b), 2 * (b * c + d * a), 1 - 2 * (a * a + b * b)}};
    long double world[3];
    for (int i = 0; i < 3; i++) {
        world[i] = rows[i][0] * ray[0] + rows[i][1] * ray[1] + rows[i][2] * ray[2];
    }
    const long double distance = -pose->position_world[1] / world[1];
    uv[0] = pose->position_world[0] + world[0] * distance;
    uv[1] = -pose->position_world[2] - world[2] * distance;
}

// Returns the difference of two repeating coordinates, within +-1/2.
static double wrapped(long double difference) {
    return (double)(difference - floorl(difference + 0.5L));
}

// Returns by how many pixels the texture is out of place at pixel (x, y). Returns 0 where a pixel
// covers so much of the texture that repeats could be confused.
static double displacement(const DipPose *pose, int x, int y) {
    long double at[2], right[2], below[2];
    const long double step = 0.001L;
    exact_coordinates(pose, x + 0.5L, y + 0.5L, at);
    exact_coordinates(pose, x + 0.5L + step, y + 0.5L, right);
    exact_coordinates(pose, x + 0.5L, y + 0.5L + step, below);
    double j[4];
    for (int i = 0; i < 2; i++) {
        j[i] = (double)((right[i] - at[i]) / step);
        j[2 + i] = (double)((below[i] - at[i]) / step);
    }
    if (fabs(j[0]) + fabs(j[1]) + fabs(j[2]) + fabs(j[3]) > 0.25) {
        return 0.0;
    }
    const double u = wrapped(seen[y][x].u - at[0]);
    const double v = wrapped(seen[y][x].v - at[1]);
    const double area = j[0] * j[3] - j[1] * j[2];
    return hypot((u * j[3] - v * j[2]) / area, (v * j[0] - u * j[1]) / area);
}

// Turns a camera by yaw, then pitch, then roll, in radians.
static void turn(double yaw, double pitch, double roll, double q[4]) {
    const double a[4] = {cos(yaw / 2) * sin(-pitch / 2), sin(yaw / 2) * cos(pitch / 2),
                         sin(yaw / 2) * sin(pitch / 2), cos(yaw / 2) * cos(pitch / 2)};
    const double c = cos(roll / 2);
    const double s = sin(roll / 2);
    q[0] = a[0] * c + a[1] * s;
    q[1] = a[1] * c - a[0] * s;
    q[2] = a[2] * c + a[3] * s;
    q[3] = a[3] * c - a[2] * s;
}

// Draws the floor and returns the greatest displacement of its texture. Adds the pixels that show
// the floor to *count.
static double worst_displacement(const DipPose *pose, float offset, int *count) {
    DipTestScene scene;
    make_floor(&scene, offset);
    scene.pose = *pose;
    draw_floor(&scene);
    double worst = 0.0;
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            if (seen[y][x].there) {
                worst = fmax(worst, displacement(pose, x, y));
                *count += 1;
            }
        }
    }
    dip_test_scene_free(&scene);
    return worst;
}

// Held to exact rays in long double. The vertices are rounded to 1/256 pixel, so a displacement of
// a few thousandths of a pixel is right.
static void a_floor_of_20_km_shows_its_texture_in_place(void **state) {
    (void)state;
    static const double eyes[][2] = {
        {0.3, 0.6}, {100.25, -300.5}, {9000.3, 8000.7}, {-9990.2, 5.3}, {-7000.9, 9999.0}};
    static const float offsets[] = {0.0f, 65536.0f};
    enum { POSES = 60 };
    Random random = {5};
    double worst = 0.0;
    int count = 0;
    for (int i = 0; i < POSES; i++) {
        const double *eye = eyes[i % 5];
        DipPose pose = {
            .position_world = {eye[0], pow(10.0, random_real(&random, -1.0, 0.5)), eye[1]},
            .fov_y_deg = 60.0};
        turn(random_real(&random, -3.1, 3.1), random_real(&random, 0.0, 0.6),
             random_real(&random, -0.3, 0.3), pose.orientation);
        worst = fmax(worst, worst_displacement(&pose, offsets[i / 5 % 2], &count));
    }
    printf("worst displacement %.4f pixels\n", worst);
    assert_true(count > POSES * WIDTH * HEIGHT / 4);
    assert_true(worst < 0.015);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_numbers_added_to_repeating_coordinates_change_no_bit),
        cmocka_unit_test(clamped_coordinates_are_not_reduced),
        cmocka_unit_test(the_coordinates_of_a_sky_are_not_reduced),
        cmocka_unit_test(a_floor_of_20_km_shows_its_texture_in_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
