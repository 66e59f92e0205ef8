// Tests how draws change colours and depths against closed forms: published results of blending,
// ordered draws against plain ones, wireframes by distances to edges, depth bias and viewports.
#include "state_stage.h"

#include "renderer/base/srgb.h"
#include "renderer/catalogue/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// --- blending ------------------------------------------------------------------------------------

// Two overlapping rectangles, blue with alpha 1 and yellow with alpha 1/2, over grey 128. The codes
// are those of blue alone, yellow alone and both, blended in linear light and in codes.
typedef struct Mode {
    DipBlend blend;
    int linear_light[3][3];
    int codes[3][3];
} Mode;

static void draw_mode(const Mode *mode, bool in_codes) {
    static const Colour colours[2] = {{{0, 0, 1, 1}}, {{1, 1, 0, 0.5f}}};
    const DipDrawState state = {.blend = mode->blend, .depth_test = DIP_DEPTH_ALWAYS};
    DipMesh *meshes[2] = {rectangle(8, 8, 48, 48, 0.5f), rectangle(32, 8, 80, 48, 0.5f)};
    const DipDraw draws[2] = {draw_of(meshes[0], &colours[0], &state),
                              draw_of(meshes[1], &colours[1], &state)};
    DipPass pass = pass_of(draws, 2, 1);
    DipSrgbDecodeTable table;
    dip_srgb_decode_table(&table);
    pass.target.format = in_codes ? DIP_FORMAT_LINEAR8 : DIP_FORMAT_SRGB8;
    for (int c = 0; c < 3; c++) {
        pass.clear_lin[c] = in_codes ? 128.0f / 255.0f : (float)table.linear[128];
    }
    run(&pass);
    static const int at[3] = {16, 64, 40};
    for (int k = 0; k < 3; k++) {
        for (int c = 0; c < 3; c++) {
            const int expected = in_codes ? mode->codes[k][c] : mode->linear_light[k][c];
            const int found = picture[20][at[k]][c];
            if (abs(found - expected) > (in_codes ? 1 : 0)) {
                fail_msg("place %d, channel %d: code %d, expected %d", k, c, found, expected);
            }
        }
    }
    dip_mesh_destroy(&meshes[0]);
    dip_mesh_destroy(&meshes[1]);
}

static void published_modes(void **state) {
    (void)state;
    static const Mode modes[] = {
        {DIP_BLEND_MODE_ADDITIVE,
         {{128, 128, 255}, {220, 220, 128}, {220, 220, 255}},
         {{128, 128, 255}, {255, 255, 128}, {255, 255, 255}}},
        {DIP_BLEND_MODE_MULTIPLICATIVE,
         {{0, 0, 128}, {128, 128, 0}, {0, 0, 0}},
         {{0, 0, 128}, {128, 128, 0}, {0, 0, 0}}},
        {DIP_BLEND_MODE_DOUBLE_MULTIPLICATIVE,
         {{0, 0, 176}, {176, 176, 0}, {0, 0, 0}},
         {{0, 0, 255}, {255, 255, 0}, {0, 0, 0}}},
        {DIP_BLEND_MODE_ALPHA,
         {{0, 0, 255}, {205, 205, 92}, {188, 188, 188}},
         {{0, 0, 255}, {191, 191, 64}, {128, 128, 128}}},
        {DIP_BLEND_MODE_PREMULTIPLIED,
         {{0, 0, 255}, {255, 255, 92}, {255, 255, 188}},
         {{0, 0, 255}, {255, 255, 64}, {255, 255, 128}}},
    };
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        draw_mode(&modes[i], false);
        draw_mode(&modes[i], true);
    }
}

// Two premultiplied colours over a transparent layer, and the layer over a background, are the same
// as both over the background.
static void premultiplied_layers(void **state) {
    (void)state;
    static float floats[HEIGHT][WIDTH][4];
    static const Colour colours[2] = {{{0.3f, 0.1f, 0.05f, 0.4f}}, {{0.02f, 0.2f, 0.3f, 0.75f}}};
    static const DipDrawState layer = {.blend = DIP_BLEND_MODE_PREMULTIPLIED,
                                       .depth_test = DIP_DEPTH_ALWAYS};
    DipMesh *mesh = rectangle(8, 8, 48, 48, 0.5f);
    const DipDraw draws[2] = {draw_of(mesh, &colours[0], &layer),
                              draw_of(mesh, &colours[1], &layer)};
    DipPass pass = pass_of(draws, 2, 1);
    pass.target.format = DIP_FORMAT_RGBA32F;
    pass.target.floats = &floats[0][0][0];
    pass.target.stride_bytes = sizeof floats[0];
    pass.attachments.clear_transparent = true;
    run(&pass);
    const float *found = floats[20][20];
    assert_true(fabs((double)found[3] - (1.0 - 0.6 * 0.25)) < 1e-6);
    for (int c = 0; c < 3; c++) {
        const double background = 0.5 + 0.1 * c;
        const double first = (double)colours[0].channel[c] + background * 0.6;
        const double both = (double)colours[1].channel[c] + first * 0.25;
        const double of_layer = (double)found[c] + background * (1.0 - (double)found[3]);
        assert_true(fabs(of_layer - both) < 1e-6);
    }
    assert_true(floats[60][20][3] == 0.0f);
    dip_mesh_destroy(&mesh);
}

// A pass that keeps the target's colours stores every code unchanged, also where a draw has touched
// them without effect.
static void kept_codes(void **state) {
    (void)state;
    static const Colour colour = {{0.3f, 0.6f, 0.9f, 0.2f}};
    const DipDrawState invisible = {
        .blend = {.enabled = true,
                  .colour = {DIP_BLEND_ZERO, DIP_BLEND_ONE, DIP_BLEND_ADD},
                  .alpha = {DIP_BLEND_ZERO, DIP_BLEND_ONE, DIP_BLEND_ADD}}};
    DipMesh *mesh = rectangle(3, 3, 90, 40, 0.5f);
    const DipDraw draw = draw_of(mesh, &colour, &invisible);
    for (int format = DIP_FORMAT_SRGB8; format <= DIP_FORMAT_LINEAR8; format++) {
        for (int samples = 1; samples <= 8; samples += 7) {
            for (int i = 0; i < WIDTH * HEIGHT * 4; i++) {
                (&picture[0][0][0])[i] = (uint8_t)(i * 7 + i / 251);
            }
            static uint8_t before[HEIGHT][WIDTH][4];
            memcpy(before, picture, sizeof before);
            DipPass pass = pass_of(&draw, 1, samples);
            pass.target.format = (DipFormat)format;
            pass.attachments.colour_load = DIP_LOAD_KEEP;
            run(&pass);
            assert_memory_equal(before, picture, sizeof before);
        }
    }
    dip_mesh_destroy(&mesh);
}

// --- ordered and plain ---------------------------------------------------------------------------

static void depth_colour(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        batch->colour[0][i] = batch->varying[0][i];
        batch->colour[1][i] = 0.5f + 0.2f * batch->varying_dx[0][i] * 64.0f;
        batch->colour[2][i] = 1.0f - batch->varying[0][i];
    }
}

// Plain draws that are marked as ordered have the same bits.
static void ordered_like_plain(void **state) {
    (void)state;
    static uint8_t plain[HEIGHT][WIDTH][4];
    static const DipDrawState ordered = {.ordered = true};
    Random random = {7};
    for (int round = 0; round < 60; round++) {
        DipMesh *meshes[4];
        DipDraw draws[4];
        float corners[12][3];
        for (int d = 0; d < 4; d++) {
            for (int i = 0; i < 12; i++) {
                corners[i][0] = (float)random_int(&random, -2000, WIDTH * 256 + 2000) / 256.0f;
                corners[i][1] = (float)random_int(&random, -2000, HEIGHT * 256 + 2000) / 256.0f;
                corners[i][2] = (float)random_real(&random, 0.1, 0.9);
            }
            meshes[d] = triangles(&corners[0][0], 12);
            draws[d] = draw_of(meshes[d], NULL, NULL);
            draws[d].fragment_shader = depth_colour;
        }
        DipPass pass = pass_of(draws, 4, 1);
        run(&pass);
        memcpy(plain, picture, sizeof plain);
        for (int first = 0; first < 4; first++) {
            for (int d = 0; d < 4; d++) {
                draws[d].state = d >= first ? &ordered : NULL;
            }
            run(&pass);
            assert_memory_equal(plain, picture, sizeof plain);
        }
        for (int d = 0; d < 4; d++) {
            dip_mesh_destroy(&meshes[d]);
        }
    }
}

// --- wireframes ----------------------------------------------------------------------------------

static double distance_to_line(const float a[3], const float b[3], double x, double y) {
    const double dx = (double)b[0] - a[0];
    const double dy = (double)b[1] - a[1];
    return fabs(dx * (y - a[1]) - dy * (x - a[0])) / sqrt(dx * dx + dy * dy);
}

static bool inside(const float *c, double x, double y) {
    int sides[2] = {0, 0};
    for (int i = 0; i < 3; i++) {
        const float *a = c + 3 * i;
        const float *b = c + 3 * ((i + 1) % 3);
        const double side = ((double)b[0] - a[0]) * (y - a[1]) - ((double)b[1] - a[1]) * (x - a[0]);
        sides[side > 0.0]++;
    }
    return !sides[0] || !sides[1];
}

// cut: the pixels x < 40 are clipped away. The new edge must not be drawn. What clipping leaves is
// divided into triangles, and a line ends where its triangle ends, so up to a third of the pixels
// near the edges may be missing.
static void check_wires(Random *random, bool cut) {
    static const Colour white = {{1, 1, 1, 1}};
    float c[3][3];
    for (int i = 0; i < 3; i++) {
        c[i][0] = (float)random_int(random, 0, WIDTH * 256) / 256.0f;
        c[i][1] = (float)random_int(random, 0, HEIGHT * 256) / 256.0f;
        c[i][2] = 0.5f;
    }
    const DipDrawState state = {.fill = DIP_FILL_WIREFRAME,
                                .line_width = (float)random_real(random, 0.5, cut ? 4.0 : 12.0)};
    DipMesh *mesh = triangles(&c[0][0], 3);
    const DipDraw draw = draw_of(mesh, &white, &state);
    DipPass pass = pass_of(&draw, 1, 1);
    if (cut) {
        pass.clip_plane_count = 1;
        pass.clip_planes[0][0] = 1.0f;
        pass.clip_planes[0][3] = 1.0f - 80.0f / WIDTH;
    }
    run(&pass);
    int expected_count = 0;
    int missing = 0;
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = cut ? 41 : 0; x < WIDTH; x++) {
            double nearest = 1e9;
            for (int i = 0; i < 3; i++) {
                nearest = fmin(nearest, distance_to_line(c[i], c[(i + 1) % 3], x + 0.5, y + 0.5));
            }
            const double from_line = nearest - 0.5 * (double)state.line_width;
            // Edge values are rounded, so nothing is said about samples within 1/32 pixel.
            if (fabs(from_line) < 1.0 / 32.0 || nearest < 1.0 / 32.0) {
                continue;
            }
            const bool expected = inside(&c[0][0], x + 0.5, y + 0.5) && from_line < 0.0;
            const bool drawn = picture[y][x][0] == 255;
            expected_count += expected;
            missing += expected && !drawn;
            if ((drawn && !expected) || (expected && !drawn && !cut)) {
                fail_msg("pixel %d, %d: distance %g, width %g, %s drawn", x, y, nearest,
                         (double)state.line_width, expected ? "not" : "wrongly");
            }
        }
    }
    assert_true(missing <= 8 + expected_count / 3);
    dip_mesh_destroy(&mesh);
}

static void wireframes(void **state) {
    (void)state;
    Random random = {5};
    for (int i = 0; i < 300; i++) {
        check_wires(&random, i % 2);
    }
}

// --- depth bias ----------------------------------------------------------------------------------

static void depth_bias(void **state) {
    (void)state;
    static const Colour white = {{1, 1, 1, 1}};
    Random random = {3};
    DipDepth *depth = dip_depth_create(WIDTH, HEIGHT, 1, NULL);
    for (int i = 0; i < 50; i++) {
        const double dx = random_real(&random, -0.004, 0.004);
        const double dy = random_real(&random, -0.004, 0.004);
        float c[6][3] = {{0, 0, 0}, {0, HEIGHT, 0},     {WIDTH, HEIGHT, 0},
                         {0, 0, 0}, {WIDTH, HEIGHT, 0}, {WIDTH, 0, 0}};
        for (int k = 0; k < 6; k++) {
            c[k][2] = (float)(0.5 + dx * ((double)c[k][0] - WIDTH / 2) +
                              dy * ((double)c[k][1] - HEIGHT / 2));
        }
        const DipDrawState biased = {.depth_bias = {(float)random_real(&random, -3.0, 3.0),
                                                    (float)random_real(&random, -2e5, 2e5),
                                                    (float)random_real(&random, -0.2, 0.2)}};
        DipMesh *mesh = triangles(&c[0][0], 6);
        const DipDraw draw = draw_of(mesh, &white, &biased);
        DipPass pass = pass_of(&draw, 1, 1);
        pass.attachments.depth = depth;
        run(&pass);
        for (int y = 0; y < HEIGHT; y++) {
            for (int x = 0; x < WIDTH; x++) {
                const double z = 0.5 + dx * (x + 0.5 - WIDTH / 2) + dy * (y + 0.5 - HEIGHT / 2);
                const double moved = z +
                                     (double)biased.depth_bias.slope * fmax(fabs(dx), fabs(dy)) +
                                     (double)biased.depth_bias.constant +
                                     (double)biased.depth_bias.relative * 0x1p-23 * z;
                const double found = dip_depth_row(depth, 0, y)[x];
                if (fabs(found - fmin(fmax(moved, 0.0), 1.0)) > 2e-6) {
                    fail_msg("pixel %d, %d: depth %.8g, expected %.8g", x, y, found, moved);
                }
            }
        }
        dip_mesh_destroy(&mesh);
    }
    dip_depth_destroy(&depth);
}

// --- viewports and scissors ----------------------------------------------------------------------

static void viewports(void **state) {
    (void)state;
    static const Colour white = {{1, 1, 1, 1}};
    const float c[3][3] = {{-30, -10, 0.5f}, {110, 20, 0.5f}, {40, 90, 0.5f}};
    DipMesh *mesh = triangles(&c[0][0], 3);
    const DipDraw draw = draw_of(mesh, &white, NULL);
    memset(picture, 77, sizeof picture);
    DipPass pass = pass_of(&draw, 1, 1);
    pass.viewport = (DipTargetRegion){11, 7, 11 + WIDTH / 2, 7 + HEIGHT / 2};
    pass.scissor = (DipTargetRegion){13, 5, 50, 37};
    run(&pass);
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            const bool stored = x >= 13 && x < 50 && y >= 7 && y < 37 && x < 11 + WIDTH / 2;
            const double px = (x + 0.5 - 11) * 2.0;
            const double py = (y + 0.5 - 7) * 2.0;
            const int expected = !stored ? 77 : inside(&c[0][0], px, py) ? 255 : 0;
            bool near_edge = false;
            for (int i = 0; i < 3; i++) {
                near_edge |= distance_to_line(c[i], c[(i + 1) % 3], px, py) < 0.02;
            }
            if (!near_edge) {
                assert_int_equal(picture[y][x][0], expected);
            }
        }
    }
    dip_mesh_destroy(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(published_modes), cmocka_unit_test(premultiplied_layers),
        cmocka_unit_test(kept_codes),      cmocka_unit_test(ordered_like_plain),
        cmocka_unit_test(wireframes),      cmocka_unit_test(depth_bias),
        cmocka_unit_test(viewports),
    };
    return cmocka_run_group_tests(tests, open_pipeline, close_pipeline);
}
