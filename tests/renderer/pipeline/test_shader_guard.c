// Tests that shaders cannot read what is undefined or being drawn, and that what they leave unset
// is defined.
#include "pass_stage.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

// --- what shaders read ---------------------------------------------------------------------------

// What the shader of this test reads.
typedef struct Reading {
    int u_varying;
    const DipTarget *target;    // NULL: it reads a texture
    const DipShadowMap *shadow; // NULL: it reads a texture
} Reading;

static void read_as_told(DipFragmentBatch *batch) {
    const Reading *reading = batch->uniforms;
    if (reading->target) {
        batch->sample_target(batch, reading->target, batch->x, batch->y, batch->colour);
    } else if (reading->shadow) {
        batch->sample_shadow(batch, reading->shadow, batch->x, batch->y, batch->y,
                             batch->colour[0]);
    } else {
        batch->sample_colour(batch, &batch->samplers[1], reading->u_varying, batch->colour);
    }
}

static void three_varyings(const DipVertexBatch *batch) {
    copy_vertices(batch);
    for (int i = 0; i < batch->count; i++) {
        batch->varying[1][i] = batch->in[1][i];
        batch->varying[2][i] = batch->in[2][i];
    }
}

// A reading with one fault, and the error that the pipeline must report.
typedef struct BadReading {
    const char *field;
    DipErrorCode code;
    void (*spoil)(DipPass *pass, DipDraw *draw, DipSampler *sampler, Reading *reading);
} BadReading;

#define MISREAD(name, statement)                                                                   \
    static void name(DipPass *pass, DipDraw *draw, DipSampler *sampler, Reading *reading) {        \
        (void)pass;                                                                                \
        (void)draw;                                                                                \
        (void)sampler;                                                                             \
        (void)reading;                                                                             \
        statement;                                                                                 \
    }
static const DipTarget other_format = {.rgba8 = pictures[1][0],
                                       .stride_bytes = WIDTH * 4,
                                       .width = WIDTH,
                                       .height = HEIGHT,
                                       .format = DIP_FORMAT_LINEAR8};
static const DipTarget no_memory = {.stride_bytes = WIDTH * 4, .width = WIDTH, .height = HEIGHT};
static const DipTarget no_rows = {
    .rgba8 = pictures[1][0], .stride_bytes = WIDTH * 4, .width = WIDTH};
static const DipTarget own_rows = {
    .rgba8 = pictures[0][0] + WIDTH * 8, .stride_bytes = WIDTH * 4, .width = WIDTH, .height = 1};
static const DipShadowMap no_depths;
MISREAD(values_only, draw->value_only_varying_count = 2)
MISREAD(values_for_two_probes, (values_only(pass, draw, sampler, reading), sampler->no_mips = true,
                                sampler->max_anisotropy = 2))
MISREAD(beyond, reading->u_varying = 2)
MISREAD(far_beyond, reading->u_varying = INT32_MAX)
MISREAD(negative, reading->u_varying = -1)
MISREAD(last_computed,
        (draw->computed_varying_count = 2, reading->u_varying = DIP_MAX_VARYINGS - 1))
MISREAD(behind_computed, (draw->computed_varying_count = 2, reading->u_varying = DIP_MAX_VARYINGS))
MISREAD(no_samplers, draw->samplers = NULL)
MISREAD(no_texture, sampler->texture = NULL)
MISREAD(much_anisotropy, sampler->max_anisotropy = 17)
MISREAD(negative_anisotropy, sampler->max_anisotropy = -1)
MISREAD(unknown_filter, sampler->filter = DIP_FILTER_COUNT)
MISREAD(negative_level, sampler->min_lod8 = -256)
MISREAD(great_bias, sampler->bias_lod8 = INT32_MIN)
MISREAD(no_such_level, (sampler->shown = sampler->texture, sampler->shown_level[0] = 9))
MISREAD(linear_target, reading->target = &other_format)
MISREAD(target_without_pixels, reading->target = &no_memory)
MISREAD(target_without_rows, reading->target = &no_rows)
MISREAD(own_target, reading->target = &own_rows)
MISREAD(shadow_of_nothing, reading->shadow = &no_depths)

static const BadReading bad_readings[] = {
    {"value_only_varying_count", DIP_ERROR_CONFLICT, values_only},
    {"value_only_varying_count", DIP_ERROR_CONFLICT, values_for_two_probes},
    {"varying_count", DIP_ERROR_RANGE, beyond},
    {"varying_count", DIP_ERROR_RANGE, far_beyond},
    {"varying_count", DIP_ERROR_RANGE, negative},
    {"varying_count", DIP_ERROR_RANGE, last_computed},
    {"varying_count", DIP_ERROR_RANGE, behind_computed},
    {"samplers", DIP_ERROR_MISSING, no_samplers},
    {"samplers", DIP_ERROR_MISSING, no_texture},
    {"samplers", DIP_ERROR_RANGE, much_anisotropy},
    {"samplers", DIP_ERROR_RANGE, negative_anisotropy},
    {"samplers", DIP_ERROR_RANGE, unknown_filter},
    {"samplers", DIP_ERROR_RANGE, negative_level},
    {"samplers", DIP_ERROR_RANGE, great_bias},
    {"samplers", DIP_ERROR_RANGE, no_such_level},
    {"sample_target", DIP_ERROR_CONFLICT, linear_target},
    {"sample_target", DIP_ERROR_CONFLICT, target_without_pixels},
    {"sample_target", DIP_ERROR_RANGE, target_without_rows},
    {"sample_target", DIP_ERROR_CONFLICT, own_target},
    {"sample_shadow", DIP_ERROR_MISSING, shadow_of_nothing},
};

// Draws with a shader that reads sampler 1 at the varyings 1 and 2, or with a fault. bad: or NULL.
static bool draw_reading(const Stage *stage, const BadReading *bad, int samples, DipError *err) {
    static const uint8_t texel[4] = {255, 255, 255, 255};
    const DipTextureDef def = {.name = "white", .width = 1, .height = 1, .rgba8 = texel};
    DipTexture *texture = dip_texture_create(&def, NULL);
    DipSampler samplers[2] = {{.texture = NULL}, {.texture = texture}};
    Reading reading = {.u_varying = 1};
    DipDraw draw = stage->draw;
    draw.vertex_shader = three_varyings;
    draw.fragment_shader = read_as_told;
    draw.varying_count = 3;
    draw.samplers = samplers;
    draw.uniforms = &reading;
    DipPass pass = good_pass(stage, 0);
    pass.draws = &draw;
    pass.sample_count = samples;
    if (bad) {
        bad->spoil(&pass, &draw, &samplers[1], &reading);
    }
    const bool drawn = dip_pipeline_draw(stage->pipelines[0], &pass, NULL, NULL, err);
    dip_texture_destroy(&texture);
    return drawn;
}

// What a read without mips takes no derivatives for: one probe, and the nearest texel.
MISREAD(values_for_one_probe, (values_only(pass, draw, sampler, reading), sampler->no_mips = true,
                               sampler->max_anisotropy = 1))
MISREAD(values_for_a_point, (values_for_one_probe(pass, draw, sampler, reading),
                             sampler->max_anisotropy = 16, sampler->filter = DIP_FILTER_POINT))

static void a_read_of_one_place_needs_no_derivatives(void **state) {
    const Stage *stage = *state;
    static const BadReading readings[2] = {{.spoil = values_for_one_probe},
                                           {.spoil = values_for_a_point}};
    for (int i = 0; i < 2; i++) {
        DipError err = {0};
        if (!draw_reading(stage, &readings[i], 1, &err)) {
            fail_msg("%d: %s", i, err.message);
        }
    }
}

static void read_last_sampler(DipFragmentBatch *batch) {
    batch->sample_colour(batch, &batch->samplers[DIP_MAX_SAMPLERS - 1], 0, batch->colour);
}

static void the_last_sampler_can_be_read(void **state) {
    const Stage *stage = *state;
    static const uint8_t texel[4] = {10, 200, 30, 255};
    const DipTextureDef def = {.name = "green", .width = 1, .height = 1, .rgba8 = texel};
    DipTexture *texture = dip_texture_create(&def, NULL);
    DipSampler samplers[DIP_MAX_SAMPLERS] = {[DIP_MAX_SAMPLERS - 1] = {.texture = texture}};
    DipDraw draw = stage->draw;
    draw.vertex_shader = three_varyings;
    draw.fragment_shader = read_last_sampler;
    draw.varying_count = 2;
    draw.samplers = samplers;
    DipPass pass = good_pass(stage, 0);
    pass.draws = &draw;
    pass.sample_count = 1;
    assert_true(dip_pipeline_draw(stage->pipelines[0], &pass, NULL, NULL, NULL));
    const uint8_t *middle = pictures[0][0] + (HEIGHT / 2 * WIDTH + WIDTH / 2) * 4;
    assert_memory_equal(middle, texel, sizeof texel);
    dip_texture_destroy(&texture);
}

static void readings_that_are_not_allowed_are_refused_by_name(void **state) {
    const Stage *stage = *state;
    assert_true(draw_reading(stage, NULL, 4, NULL)); // max_anisotropy is 0, which means 1
    for (size_t i = 0; i < sizeof bad_readings / sizeof *bad_readings; i++) {
        DipError err = {0};
        char key[64];
        snprintf(key, sizeof key, "draws[0].%s", bad_readings[i].field);
        assert_false(draw_reading(stage, &bad_readings[i], i % 2 ? 4 : 1, &err));
        assert_string_equal(err.key, key);
        assert_int_equal(err.code, bad_readings[i].code);
    }
    assert_true(draw_reading(stage, NULL, 4, NULL)); // the pipeline still works
}

// Draws two passes at once. The shader of the second one reads what `reading` names.
static bool draw_beside(const Stage *stage, const DipPass *drawing, Reading *reading,
                        DipError *err) {
    DipDraw draw = stage->draw;
    draw.fragment_shader = read_as_told;
    draw.uniforms = reading;
    DipPass pass = good_pass(stage, 1);
    pass.draws = &draw;
    const DipPassWork works[2] = {{stage->pipelines[0], drawing, NULL, NULL, NULL},
                                  {stage->pipelines[1], &pass, NULL, NULL, NULL}};
    return dip_pipeline_draw_passes(works, 2, false, err);
}

// Passes that are drawn at once have no order, so none may read what another one draws.
static void a_pass_reads_nothing_that_is_drawn_at_once(void **state) {
    const Stage *stage = *state;
    DipPass drawing = good_pass(stage, 0);
    DipError err = {0};
    assert_false(draw_beside(stage, &drawing, &(Reading){.target = &drawing.target}, &err));
    assert_int_equal(err.code, DIP_ERROR_CONFLICT);
    assert_string_equal(err.key, "draws[0].sample_target");
    assert_non_null(strstr(err.message, "at once"));
    DipDepth *depth = dip_depth_create(WIDTH, HEIGHT, 1, NULL);
    const DipShadowMap map = {.depth = depth};
    drawing.attachments.depth = depth;
    drawing.sample_count = 1;
    assert_false(draw_beside(stage, &drawing, &(Reading){.shadow = &map}, &err));
    assert_string_equal(err.key, "draws[0].sample_shadow");
    drawing.attachments.depth = NULL;
    assert_true(draw_beside(stage, &drawing, &(Reading){.shadow = &map}, &err));
    dip_depth_destroy(&depth);
}

// A target that lies beside the drawn one in a larger picture shares no bytes with it, and may be
// read. One column further to the left, or to the right and so in the next row, it does.
static void a_pass_reads_targets_beside_the_drawn_one(void **state) {
    enum { STRIDE = 3 * WIDTH * 4, COLUMNS = 5, ROWS = 4 };
    static uint8_t picture[(HEIGHT + ROWS) * STRIDE];
    static const struct {
        int column, row;
        bool beside;
    } cases[] = {{WIDTH, 0, true},
                 {WIDTH - 1, 0, false},
                 {WIDTH, ROWS, true},
                 {WIDTH - 1, ROWS, false},
                 {3 * WIDTH - COLUMNS, 0, true},
                 {3 * WIDTH - COLUMNS + 1, 0, false}};
    const Stage *stage = *state;
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        DipPass drawing = good_pass(stage, 0);
        drawing.target.rgba8 = picture;
        drawing.target.stride_bytes = STRIDE;
        const DipTarget read = {.rgba8 = picture + cases[c].row * STRIDE + cases[c].column * 4,
                                .stride_bytes = STRIDE,
                                .width = COLUMNS,
                                .height = ROWS};
        assert_int_equal(draw_beside(stage, &drawing, &(Reading){.target = &read}, NULL),
                         cases[c].beside);
        // The same with the read target before the drawn one.
        const DipTarget first = {
            .rgba8 = picture, .stride_bytes = STRIDE, .width = COLUMNS, .height = ROWS};
        drawing.target.rgba8 = picture + (COLUMNS - !cases[c].beside) * 4;
        assert_int_equal(draw_beside(stage, &drawing, &(Reading){.target = &first}, NULL),
                         cases[c].beside);
    }
}

// --- what shaders leave unset --------------------------------------------------------------------

static void leave_unset(DipFragmentBatch *batch) {
    (void)batch;
}

static void leave_vertices_unset(const DipVertexBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        for (int c = 0; c < 3; c++) {
            batch->clip[c][i] = batch->in[c][i] + batch->in[c + 3][i]; // the mesh has 3 attributes
        }
        batch->clip[3][i] = 1.0f;
    }
}

static void show_last_varying(DipFragmentBatch *batch) {
    const int last = DIP_MAX_VARYINGS - 1;
    for (int i = 0; i < batch->count; i++) {
        batch->colour[0][i] = batch->varying[last][i] + batch->varying_dx[0][i];
        batch->colour[1][i] = batch->varying[0][i];
        batch->colour[2][i] = batch->varying[1][i];
    }
}

static void write_varyings(const DipVertexBatch *batch, int count) {
    copy_vertices(batch);
    for (int s = 0; s < count; s++) {
        for (int i = 0; i < batch->count; i++) {
            batch->varying[s][i] = 0.2f * (float)(s + 1) + batch->in[0][i];
        }
    }
}

static void write_all(const DipVertexBatch *batch) {
    write_varyings(batch, DIP_MAX_VARYINGS);
}

static void write_first(const DipVertexBatch *batch) {
    write_varyings(batch, 1);
}

// Every array of a pipeline holds numbers of another pass before each of these draws.
static void what_shaders_leave_unset_is_zero(void **state) {
    const Stage *stage = *state;
    const DipDraw unset[3] = {
        {.mesh = stage->mesh, .vertex_shader = copy_vertices, .fragment_shader = leave_unset},
        {.mesh = stage->mesh,
         .vertex_shader = leave_vertices_unset,
         .fragment_shader = show_last_varying,
         .varying_count = 2,
         .value_only_varying_count = 2},
        {.mesh = stage->mesh,
         .vertex_shader = copy_vertices,
         .fragment_shader = show_varying,
         .clip_shader = leave_unset,
         .varying_count = 1}};
    DipDraw full = stage->draw;
    full.vertex_shader = write_all;
    full.varying_count = DIP_MAX_VARYINGS;
    for (int d = 0; d < 3; d++) {
        DipPass pass = good_pass(stage, 0);
        pass.draws = &full;
        assert_true(dip_pipeline_draw(stage->pipelines[0], &pass, NULL, NULL, NULL));
        pass.draws = &unset[d];
        assert_true(dip_pipeline_draw(stage->pipelines[0], &pass, NULL, NULL, NULL));
        for (size_t b = 0; b < sizeof pictures[0][0]; b++) {
            assert_int_equal(pictures[0][0][b], b % 4 == 3 ? 255 : 0);
        }
    }
}

// The alpha that a shader leaves unset is 1: a blended draw without colours is black on white.
static void the_alpha_that_shaders_leave_unset_is_one(void **state) {
    const Stage *stage = *state;
    static const DipDrawState blended = {.blend = DIP_BLEND_MODE_ALPHA};
    static const uint8_t black[4] = {0, 0, 0, 255};
    DipDraw draw = stage->draw;
    draw.fragment_shader = leave_unset;
    draw.state = &blended;
    DipPass pass = good_pass(stage, 0);
    pass.draws = &draw;
    pass.clear_lin[0] = pass.clear_lin[1] = pass.clear_lin[2] = 1.0f;
    assert_true(dip_pipeline_draw(stage->pipelines[0], &pass, NULL, NULL, NULL));
    const uint8_t *middle = pictures[0][0] + (HEIGHT / 2 * WIDTH + WIDTH / 2) * 4;
    assert_memory_equal(middle, black, sizeof black);
    assert_int_equal(pictures[0][0][0], 255); // The corner shows no triangle.
}

// A vertex shader may write varyings that a draw does not have: they change nothing.
static void varyings_that_a_draw_lacks_are_dropped(void **state) {
    const Stage *stage = *state;
    DipDraw draw = stage->draw;
    DipPass passes[2] = {good_pass(stage, 0), good_pass(stage, 1)};
    passes[0].draws = passes[1].draws = &draw;
    draw.vertex_shader = write_first;
    assert_true(dip_pipeline_draw(stage->pipelines[0], &passes[0], NULL, NULL, NULL));
    draw.vertex_shader = write_all;
    assert_true(dip_pipeline_draw(stage->pipelines[0], &passes[1], NULL, NULL, NULL));
    assert_memory_equal(pictures[0][0], pictures[0][1], sizeof pictures[0][0]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_read_of_one_place_needs_no_derivatives),
        cmocka_unit_test(the_last_sampler_can_be_read),
        cmocka_unit_test(readings_that_are_not_allowed_are_refused_by_name),
        cmocka_unit_test(a_pass_reads_nothing_that_is_drawn_at_once),
        cmocka_unit_test(a_pass_reads_targets_beside_the_drawn_one),
        cmocka_unit_test(what_shaders_leave_unset_is_zero),
        cmocka_unit_test(the_alpha_that_shaders_leave_unset_is_one),
        cmocka_unit_test(varyings_that_a_draw_lacks_are_dropped),
    };
    return cmocka_run_group_tests(tests, open_stage, close_stage);
}
