// Tests passes that are drawn near to far (geometry/order.h). Rectangles that overlap, many of them
// equally near, must show the nearest one in each pixel and the earliest one of those that are
// equally near, whatever the order of drawing. The expected picture is found pixel by pixel,
// without the pipeline.
#include "renderer/pipeline/pipeline.h"
#include "renderer/catalogue/random.h"
#include "tests/support/srgb.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

// The two digits of a draw's number in base LEVELS are its light in red and green.
enum { LEVELS = 20 };

enum { WIDTH = 100, HEIGHT = 70, DRAWS = 400, DEPTHS = 5, CORNERS = 4 };

// A rectangle of whole pixels.
typedef struct Rectangle {
    int x0, y0, x1, y1;
    int depth; // 1..DEPTHS; greater is nearer
    bool clipped;
    int number; // index of the draw
} Rectangle;

// The order in which the pipeline is told to draw: what the bounds of the draws say.
typedef enum Bounds { BOUNDS_NEAR_FIRST, BOUNDS_FAR_FIRST, BOUNDS_RANDOM, BOUNDS_NONE } Bounds;

static Rectangle rectangles[DRAWS];
static DipDraw draws[DRAWS];
static DipMesh *meshes[DRAWS];
static float to_clip[DRAWS][16];

static void copy_vertices(const DipVertexBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        for (int c = 0; c < 3; c++) {
            batch->clip[c][i] = batch->in[c][i];
        }
        batch->clip[3][i] = 1.0f;
    }
}

static void show_colour(DipFragmentBatch *batch) {
    const Rectangle *rectangle = batch->uniforms;
    for (int i = 0; i < batch->count; i++) {
        batch->colour[0][i] = (float)(rectangle->number % LEVELS) / (LEVELS - 1);
        batch->colour[1][i] = (float)(rectangle->number / LEVELS) / (LEVELS - 1);
        batch->colour[2][i] = 1.0f; // the background has none
    }
}

// Which pixels a clipped rectangle keeps.
static bool kept(const Rectangle *rectangle, int x, int y) {
    return !rectangle->clipped || (x * 7 + y * 3 + rectangle->x0) % 4 != 0;
}

static void clip(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        batch->keep[i] = kept(batch->uniforms, (int)batch->x[i], (int)batch->y[i]);
    }
}

static DipMesh *mesh_of(const Rectangle *r) {
    const float left = (float)r->x0 / WIDTH * 2.0f - 1.0f;
    const float right = (float)r->x1 / WIDTH * 2.0f - 1.0f;
    const float top = 1.0f - (float)r->y0 / HEIGHT * 2.0f;
    const float bottom = 1.0f - (float)r->y1 / HEIGHT * 2.0f;
    // The farthest ones have about the least depth that a float can have.
    const float z = r->depth == 1 ? 0x1p-149f : (float)r->depth / (DEPTHS + 1);
    const float vertices[CORNERS][3] = {
        {left, bottom, z}, {right, bottom, z}, {right, top, z}, {left, top, z}};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    const DipMeshData data = {"rectangle", &vertices[0][0], 3, CORNERS, indices, 6};
    return dip_mesh_create(&data, NULL);
}

// The rectangles at the front are large, so that whole blocks are hidden.
static void make_rectangles(int clipped) {
    Random random = {2026};
    for (int d = 0; d < DRAWS; d++) {
        Rectangle *r = &rectangles[d];
        r->depth = random_int(&random, 1, DEPTHS);
        r->x0 = random_int(&random, 0, WIDTH - 12);
        r->y0 = random_int(&random, 0, HEIGHT - 12);
        r->x1 = random_int(&random, r->x0 + 2, WIDTH);
        r->y1 = random_int(&random, r->y0 + 2, HEIGHT);
        r->clipped = d < clipped;
        r->number = d;
        meshes[d] = mesh_of(r);
        assert_non_null(meshes[d]);
        draws[d] = (DipDraw){.mesh = meshes[d],
                             .vertex_shader = copy_vertices,
                             .fragment_shader = show_colour,
                             .clip_shader = r->clipped ? clip : NULL,
                             .uniforms = r};
    }
}

static void free_rectangles(void) {
    for (int d = 0; d < DRAWS; d++) {
        dip_mesh_destroy(&meshes[d]);
    }
}

// Sets matrices that keep all boxes in view. Their last number decides the order of drawing.
static void set_bounds(Bounds bounds) {
    Random random = {7};
    for (int d = 0; d < DRAWS; d++) {
        const float rank[] = {[BOUNDS_NEAR_FIRST] = (float)(2 * DEPTHS - rectangles[d].depth),
                              [BOUNDS_FAR_FIRST] = (float)(DEPTHS + rectangles[d].depth),
                              [BOUNDS_RANDOM] = (float)random_real(&random, 2.0, 20.0),
                              [BOUNDS_NONE] = 1.0f};
        memset(to_clip[d], 0, sizeof to_clip[d]);
        to_clip[d][0] = to_clip[d][5] = to_clip[d][10] = 1.0f;
        to_clip[d][15] = rank[bounds];
        draws[d].bounds_to_clip = bounds == BOUNDS_NONE ? NULL : to_clip[d];
    }
}

enum { NOTHING = -1 };

// Returns the draw that a pixel must show, or NOTHING.
static int draw_at(int x, int y) {
    int shown = NOTHING;
    for (int d = 0; d < DRAWS; d++) {
        const Rectangle *r = &rectangles[d];
        const bool covers = x >= r->x0 && x < r->x1 && y >= r->y0 && y < r->y1;
        if (covers && kept(r, x, y) && (shown < 0 || r->depth > rectangles[shown].depth)) {
            shown = d;
        }
    }
    return shown;
}

static int level_of(uint8_t code) {
    return (int)lround(srgb_light(code) * (LEVELS - 1));
}

// Draws the rectangles, and compares every pixel.
static DipPipelineCounters draw(DipIsa isa, int sample_count, Bounds bounds) {
    static uint8_t rgba8[HEIGHT][WIDTH][4];
    DipPipeline *pipeline = dip_pipeline_create(NULL, isa, WIDTH, HEIGHT, NULL);
    DipPipelineCounters counters = {0};
    const DipPass pass = {.draws = draws,
                          .draw_count = DRAWS,
                          .sample_count = sample_count,
                          .target = {.rgba8 = rgba8[0][0],
                                     .stride_bytes = sizeof rgba8[0],
                                     .width = WIDTH,
                                     .height = HEIGHT}};
    set_bounds(bounds);
    assert_non_null(pipeline);
    assert_true(dip_pipeline_draw(pipeline, &pass, &counters, NULL, NULL));
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            const uint8_t *pixel = rgba8[y][x];
            const int found = pixel[2] ? level_of(pixel[0]) + LEVELS * level_of(pixel[1]) : NOTHING;
            assert_int_equal(found, draw_at(x, y));
        }
    }
    dip_pipeline_destroy(&pipeline);
    return counters;
}

static void the_order_of_drawing_changes_no_pixel(void **state) {
    (void)state;
    static const int clipped[] = {0, 200, 300, DRAWS}; // with 300 and more, the order is used
    static const int sample_counts[] = {1, 2, 4, 6, 8};
    for (size_t c = 0; c < sizeof clipped / sizeof *clipped; c++) {
        make_rectangles(clipped[c]);
        for (int i = 0; i < DIP_ISA_COUNT * 5; i++) {
            const DipIsa isa = (DipIsa)(i / 5);
            for (Bounds b = 0; dip_isa_available(isa) && b <= BOUNDS_NONE; b++) {
                draw(isa, sample_counts[i % 5], b);
            }
        }
        free_rectangles();
    }
}

// Near to far, fewer fragments are tested than far to near, and than in submission order.
static void the_order_saves_clip_tests(void **state) {
    (void)state;
    make_rectangles(DRAWS);
    const uint64_t near_first = draw(DIP_ISA_SCALAR, 4, BOUNDS_NEAR_FIRST).fragments_clip_tested;
    const uint64_t far_first = draw(DIP_ISA_SCALAR, 4, BOUNDS_FAR_FIRST).fragments_clip_tested;
    const uint64_t submitted = draw(DIP_ISA_SCALAR, 4, BOUNDS_NONE).fragments_clip_tested;
    assert_true(near_first < submitted && submitted < far_first);
    free_rectangles();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_order_of_drawing_changes_no_pixel),
        cmocka_unit_test(the_order_saves_clip_tests),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
