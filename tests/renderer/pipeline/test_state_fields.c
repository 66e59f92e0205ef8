// Tests formats of targets and masks of stencils against closed forms, and that a pass check
// refuses what is wrong with a state by the name of the field.
#include "state_stage.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

// --- formats -------------------------------------------------------------------------------------

// A caller's format: characters by brightness.
typedef struct Characters {
    char text[HEIGHT][WIDTH];
} Characters;

static void store_characters(void *context, int x, int y, int count, const float *const colour[4]) {
    Characters *characters = context;
    for (int i = 0; i < count; i++) {
        characters->text[y][x + i] = colour[1][i] > 2.0f ? '#' : colour[1][i] > 0.2f ? 'o' : '.';
    }
}

static void formats(void **state) {
    (void)state;
    static const Colour bright = {{0.25f, 3.5f, -1.0f, 0.5f}};
    static float floats[HEIGHT][WIDTH][4];
    static float single[HEIGHT][WIDTH];
    static Characters characters;
    const DipDrawState ordered = {.ordered = true};
    DipMesh *mesh = rectangle(10, 10, 50, 30, 0.5f);
    const DipDraw draw = draw_of(mesh, &bright, &ordered);
    for (int samples = 1; samples <= 8; samples += 7) {
        DipPass pass = pass_of(&draw, 1, samples);
        pass.clear_lin[1] = 0.5f;
        pass.target.format = DIP_FORMAT_RGBA32F;
        pass.target.floats = &floats[0][0][0];
        pass.target.stride_bytes = sizeof floats[0];
        run(&pass);
        assert_memory_equal(floats[20][20], bright.channel, sizeof bright.channel);
        const float cleared[4] = {0.0f, 0.5f, 0.0f, 1.0f};
        assert_memory_equal(floats[50][70], cleared, sizeof cleared);
        pass.target.format = DIP_FORMAT_R32F;
        pass.target.floats = &single[0][0];
        pass.target.stride_bytes = sizeof single[0];
        run(&pass);
        assert_true(single[20][20] == 0.25f && single[50][70] == 0.0f);
        pass.target = (DipTarget){.width = WIDTH,
                                  .height = HEIGHT,
                                  .format = DIP_FORMAT_CALLER,
                                  .store = store_characters,
                                  .context = &characters};
        run(&pass);
        assert_true(characters.text[20][20] == '#' && characters.text[50][70] == 'o');
    }
    // A plain draw of a format of 8 bits: the shader's values are clamped.
    const DipDraw plain = draw_of(mesh, &bright, NULL);
    DipPass pass = pass_of(&plain, 1, 4);
    pass.target.format = DIP_FORMAT_LINEAR8;
    run(&pass);
    static const uint8_t codes[4] = {64, 255, 0, 255};
    assert_memory_equal(picture[20][20], codes, sizeof codes);
    dip_mesh_destroy(&mesh);
}

// --- stencil masks -------------------------------------------------------------------------------

static DipStencil masked(DipCompare function, DipStencilOp passed, int reference, int read,
                         int write) {
    const DipStencilFace face = {.function = function, .passed = passed};
    return (DipStencil){.enabled = true,
                        .reference = (uint8_t)reference,
                        .read_mask = (uint8_t)read,
                        .write_mask = (uint8_t)write,
                        .front = face,
                        .back = face};
}

// A mask of 0 is legal if the other is not: with a read mask of 0 a test compares 0 with 0, and
// with a write mask of 0 the stored values stay. Each row draws over the one before it.
static void masks_of_zero(void **test_state) {
    (void)test_state;
    const struct {
        DipStencil stencil;
        bool is_drawn;
    } rows[] = {
        // The values are 9 at first, and 5 from here on.
        {masked(DIP_COMPARE_EQUAL, DIP_STENCIL_REPLACE, 5, 0, 255), true},
        {masked(DIP_COMPARE_NOT_EQUAL, DIP_STENCIL_ZERO, 5, 0, 255), false},
        {masked(DIP_COMPARE_EQUAL, DIP_STENCIL_ZERO, 9, 255, 0), false},
        {masked(DIP_COMPARE_EQUAL, DIP_STENCIL_ZERO, 5, 255, 0), true},
        {masked(DIP_COMPARE_EQUAL, DIP_STENCIL_ZERO, 5, 255, 0), true},
    };
    enum { ROWS = sizeof rows / sizeof *rows };
    DipMesh *mesh = rectangle(1, 1, 5, 5, 0.5f);
    Colour colours[ROWS];
    DipDrawState states[ROWS];
    DipDraw draws[ROWS];
    int red = 0; // of the last row that is drawn
    for (int i = 0; i < ROWS; i++) {
        colours[i] = (Colour){{(float)(i + 1) / ROWS, 0, 0, 1}};
        states[i] = (DipDrawState){
            .ordered = true, .depth_test = DIP_DEPTH_ALWAYS, .stencil = rows[i].stencil};
        draws[i] = draw_of(mesh, &colours[i], &states[i]);
        DipPass pass = pass_of(draws, i + 1, 1);
        pass.attachments.clear_stencil = 9;
        pass.target.format = DIP_FORMAT_LINEAR8;
        run(&pass);
        red = rows[i].is_drawn ? 255 * (i + 1) / ROWS : red;
        assert_int_equal(picture[3][3][0], red);
    }
    dip_mesh_destroy(&mesh);
}

// --- bad fields ----------------------------------------------------------------------------------

typedef struct BadField {
    const char *field;
    DipErrorCode code;
    void (*spoil)(DipPass *pass, DipDrawState *state);
} BadField;

static void spoil_factor(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->blend.colour.source = DIP_BLEND_FACTOR_COUNT;
}

static void spoil_op(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->blend.alpha.op = DIP_BLEND_OP_COUNT;
}

static void spoil_constant(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->blend.constant[2] = NAN;
}

static void spoil_channels(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->kept_channels = 16;
}

static void spoil_depth_test(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->depth_test = DIP_DEPTH_TEST_COUNT;
}

static void spoil_bias(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->depth_bias.slope = INFINITY;
}

static void spoil_constant_bias(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->depth_bias.constant = NAN;
}

static void spoil_stencil(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->stencil.back.passed = DIP_STENCIL_OP_COUNT;
}

static void spoil_fill(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->fill = DIP_FILL_COUNT;
}

static void spoil_width(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->line_width = -1.0f;
}

static void spoil_format(DipPass *pass, DipDrawState *state) {
    (void)state;
    pass->target.format = DIP_FORMAT_COUNT;
}

static void spoil_stride(DipPass *pass, DipDrawState *state) {
    (void)state;
    pass->target.format = DIP_FORMAT_RGBA32F; // a row has 16 bytes per pixel
}

static void spoil_store(DipPass *pass, DipDrawState *state) {
    (void)state;
    pass->target.format = DIP_FORMAT_CALLER;
}

static void spoil_load(DipPass *pass, DipDrawState *state) {
    (void)state;
    pass->target.format = DIP_FORMAT_CALLER;
    pass->target.store = store_characters;
    pass->attachments.colour_load = DIP_LOAD_KEEP;
}

static void spoil_clear_depth(DipPass *pass, DipDrawState *state) {
    (void)state;
    pass->attachments.clear_depth = 1.5f;
}

static void spoil_colour_load(DipPass *pass, DipDrawState *state) {
    (void)state;
    pass->attachments.colour_load = (DipLoad)3;
}

static void spoil_viewport(DipPass *pass, DipDrawState *state) {
    (void)state;
    pass->viewport = (DipTargetRegion){0, 0, WIDTH + 1, HEIGHT};
}

static void spoil_scissor(DipPass *pass, DipDrawState *state) {
    (void)state;
    pass->scissor = (DipTargetRegion){5, 5, 5, 9};
}

static void spoil_target(DipPass *pass, DipDrawState *state) {
    (void)state;
    pass->target.rgba8 = NULL;
}

static void spoil_equations(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->blend.enabled = true;
}

static void spoil_masks(DipPass *pass, DipDrawState *state) {
    (void)pass;
    state->stencil = (DipStencil){.enabled = true, .front = {.function = DIP_COMPARE_EQUAL}};
}

static void spoil_depth_load(DipPass *pass, DipDrawState *state) {
    (void)state;
    pass->attachments.depth_load = DIP_LOAD_KEEP;
}

static void spoil_stencil_load(DipPass *pass, DipDrawState *state) {
    (void)state;
    pass->attachments.stencil_load = DIP_LOAD_KEEP;
}

static void bad_fields(void **test_state) {
    (void)test_state;
    static const BadField bad[] = {
        {"draws[0].state.blend.colour", DIP_ERROR_RANGE, spoil_factor},
        {"draws[0].state.blend.alpha", DIP_ERROR_RANGE, spoil_op},
        {"draws[0].state.blend.constant", DIP_ERROR_RANGE, spoil_constant},
        {"draws[0].state.kept_channels", DIP_ERROR_RANGE, spoil_channels},
        {"draws[0].state.depth_test", DIP_ERROR_RANGE, spoil_depth_test},
        {"draws[0].state.depth_bias.slope", DIP_ERROR_RANGE, spoil_bias},
        {"draws[0].state.depth_bias.constant", DIP_ERROR_RANGE, spoil_constant_bias},
        {"draws[0].state.stencil.back", DIP_ERROR_RANGE, spoil_stencil},
        {"draws[0].state.fill", DIP_ERROR_RANGE, spoil_fill},
        {"draws[0].state.line_width", DIP_ERROR_RANGE, spoil_width},
        {"target.format", DIP_ERROR_RANGE, spoil_format},
        {"target.stride_bytes", DIP_ERROR_RANGE, spoil_stride},
        {"target.store", DIP_ERROR_MISSING, spoil_store},
        {"target.load", DIP_ERROR_MISSING, spoil_load},
        {"attachments.clear_depth", DIP_ERROR_RANGE, spoil_clear_depth},
        {"attachments.colour_load", DIP_ERROR_RANGE, spoil_colour_load},
        {"viewport", DIP_ERROR_RANGE, spoil_viewport},
        {"scissor", DIP_ERROR_RANGE, spoil_scissor},
        {"target.rgba8", DIP_ERROR_MISSING, spoil_target},
        {"draws[0].state.blend.colour", DIP_ERROR_MISSING, spoil_equations},
        {"draws[0].state.stencil.read_mask", DIP_ERROR_MISSING, spoil_masks},
        {"attachments.depth", DIP_ERROR_MISSING, spoil_depth_load},
        {"attachments.depth", DIP_ERROR_MISSING, spoil_stencil_load},
    };
    static const Colour white = {{1, 1, 1, 1}};
    DipMesh *mesh = rectangle(1, 1, 5, 5, 0.5f);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        DipDrawState state = {.ordered = true};
        const DipDraw draw = draw_of(mesh, &white, &state);
        DipPass pass = pass_of(&draw, 1, 1);
        bad[i].spoil(&pass, &state);
        DipPipelineCounters counters = {0};
        DipStageTimes times = {0};
        DipError err = {0};
        assert_false(dip_pipeline_draw(pipeline, &pass, &counters, &times, &err));
        assert_string_equal(err.key, bad[i].field);
        assert_int_equal(err.code, bad[i].code);
    }
    // Depths of another size or another number of samples.
    for (int i = 0; i < 2; i++) {
        DipDepth *depth = dip_depth_create(WIDTH - i, HEIGHT, i ? 1 : 4, NULL);
        const DipDraw draw = draw_of(mesh, &white, NULL);
        DipPass pass = pass_of(&draw, 1, 1);
        pass.attachments.depth = depth;
        DipPipelineCounters counters = {0};
        DipStageTimes times = {0};
        DipError err = {0};
        assert_false(dip_pipeline_draw(pipeline, &pass, &counters, &times, &err));
        assert_string_equal(err.key, "attachments.depth");
        dip_depth_destroy(&depth);
    }
    dip_mesh_destroy(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(formats),
        cmocka_unit_test(masks_of_zero),
        cmocka_unit_test(bad_fields),
    };
    return cmocka_run_group_tests(tests, open_pipeline, close_pipeline);
}
