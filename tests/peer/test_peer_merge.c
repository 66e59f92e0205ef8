// Draws random lists of draws with blending, depth and stencil states by our pipeline and by Mesa's
// llvmpipe, and compares the pictures. The target has four floats per pixel and one sample, where
// llvmpipe rounds no intermediate result to bytes. Exit code 77 means that there is no llvmpipe.
//
//     test_peer_merge [--lists N]    (default 30; the long run draws 300)
#include "tests/peer/gl.h"
#include "tests/renderer/pipeline/merge_list.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { VERTICES = 3 * MODEL_TRIANGLES };

typedef float Picture[MODEL_HEIGHT][MODEL_WIDTH][4];

static int list_count = 30;
static DipGl gl;
static GLuint program;
static GLint colour_place, clips_place, reads_front_place;

// --- our pipeline --------------------------------------------------------------------------------

static void vertex_shader(const DipVertexBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        for (int c = 0; c < 3; c++) {
            batch->clip[c][i] = batch->in[c][i];
        }
        batch->clip[3][i] = 1.0f;
    }
}

static void fragment_shader(DipFragmentBatch *batch) {
    const ModelDraw *draw = batch->uniforms;
    for (int i = 0; i < batch->count; i++) {
        for (int c = 0; c < 3; c++) {
            batch->colour[c][i] =
                (float)model_shade(draw, batch->front[i], (int)batch->x[i], (int)batch->y[i], c);
        }
        batch->alpha[i] =
            (float)model_shade(draw, batch->front[i], (int)batch->x[i], (int)batch->y[i], 3);
    }
}

static void clip_shader(DipFragmentBatch *batch) {
    for (int i = 0; i < batch->count; i++) {
        batch->keep[i] = model_keeps(batch->front[i], (int)batch->x[i], (int)batch->y[i]);
    }
}

// Positions as both sides get them: clip coordinates with w = 1.
static void vertices_of(const ModelDraw *draw, float vertices[VERTICES][3]) {
    for (int i = 0; i < VERTICES; i++) {
        const DipOracleTriangle *triangle = &draw->triangle[i / 3];
        vertices[i][0] = (float)triangle->x[i % 3] * (2.0f / 256.0f / MODEL_WIDTH) - 1.0f;
        vertices[i][1] = 1.0f - (float)triangle->y[i % 3] * (2.0f / 256.0f / MODEL_HEIGHT);
        vertices[i][2] = draw->depth[i / 3];
    }
}

static void draw_ours(DipPipeline *pipeline, const ModelList *list, Picture picture) {
    DipDraw draws[MODEL_DRAWS];
    DipMesh *meshes[MODEL_DRAWS];
    uint32_t indices[VERTICES];
    for (int d = 0; d < MODEL_DRAWS; d++) {
        const ModelDraw *model = &list->draws[0][d];
        float vertices[VERTICES][3];
        vertices_of(model, vertices);
        for (uint32_t i = 0; i < VERTICES; i++) {
            indices[i] = i;
        }
        const DipMeshData data = {"draw", &vertices[0][0], 3, VERTICES, indices, VERTICES};
        meshes[d] = dip_mesh_create(&data, NULL);
        assert_non_null(meshes[d]);
        draws[d] = (DipDraw){.mesh = meshes[d],
                             .vertex_shader = vertex_shader,
                             .fragment_shader = fragment_shader,
                             .clip_shader = model->clips ? clip_shader : NULL,
                             .uniforms = model,
                             .cull = model->cull,
                             .state = &model->state};
    }
    const DipPass pass = {
        .draws = draws,
        .draw_count = MODEL_DRAWS,
        .sample_count = 1,
        .clear_lin = {list->clear[0], list->clear[1], list->clear[2]},
        .target = {.floats = &picture[0][0][0],
                   .stride_bytes = sizeof picture[0],
                   .width = MODEL_WIDTH,
                   .height = MODEL_HEIGHT,
                   .format = DIP_FORMAT_RGBA32F},
        .attachments = {.clear_transparent = list->clear[3] < 0.5f,
                        .clear_depth = list->clear_depth,
                        .clear_stencil = list->clear_stencil},
        .scissor = list->scissor[0],
    };
    DipPipelineCounters counters = {0};
    DipStageTimes times = {0};
    assert_true(dip_pipeline_draw(pipeline, &pass, &counters, &times, NULL));
    for (int d = 0; d < MODEL_DRAWS; d++) {
        dip_mesh_destroy(&meshes[d]);
    }
}

// --- llvmpipe ------------------------------------------------------------------------------------

static GLuint make_shader(GLenum kind, const char *source) {
    const GLuint shader = gl.CreateShader(kind);
    gl.ShaderSource(shader, 1, &source, NULL);
    gl.CompileShader(shader);
    return shader;
}

static void make_program(void) {
    program = gl.CreateProgram();
    gl.AttachShader(program,
                    make_shader(GL_VERTEX_SHADER, "#version 330 core\n"
                                                  "in vec3 position;\n"
                                                  "void main() {\n"
                                                  "    gl_Position = vec4(position, 1.0);\n"
                                                  "}\n"));
    gl.AttachShader(program,
                    make_shader(GL_FRAGMENT_SHADER,
                                "#version 330 core\n"
                                "uniform vec4 colour;\n"
                                "uniform int clips;\n"
                                "uniform int reads_front;\n"
                                "out vec4 pixel;\n"
                                "void main() {\n"
                                "    int x = int(gl_FragCoord.x);\n"
                                "    int y = int(gl_FragCoord.y);\n"
                                "    bool front = reads_front != 0 && gl_FrontFacing;\n"
                                "    if (clips != 0 && ((x ^ y) & (front ? 4 : 2)) == 0) {\n"
                                "        discard;\n"
                                "    }\n"
                                "    float share = (1.0 + float((x + 3 * y) & 3)) / 4.0;\n"
                                "    pixel = colour * (front ? 0.5 * share : share);\n"
                                "}\n"));
    gl.BindAttribLocation(program, 0, "position");
    gl.LinkProgram(program);
    GLint linked = GL_FALSE;
    gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    assert_true(linked);
    colour_place = gl.GetUniformLocation(program, "colour");
    clips_place = gl.GetUniformLocation(program, "clips");
    reads_front_place = gl.GetUniformLocation(program, "reads_front");
    gl.UseProgram(program);
}

static void make_buffers(void) {
    GLuint names[2], framebuffer, array, buffer;
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.GenRenderbuffers(2, names);
    gl.BindRenderbuffer(GL_RENDERBUFFER, names[0]);
    gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, 0, GL_RGBA32F, MODEL_WIDTH, MODEL_HEIGHT);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, names[0]);
    gl.BindRenderbuffer(GL_RENDERBUFFER, names[1]);
    gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, 0, GL_DEPTH32F_STENCIL8, MODEL_WIDTH,
                                      MODEL_HEIGHT);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                               names[1]);
    assert_int_equal(gl.CheckFramebufferStatus(GL_FRAMEBUFFER), GL_FRAMEBUFFER_COMPLETE);
    gl.GenVertexArrays(1, &array);
    gl.BindVertexArray(array);
    gl.GenBuffers(1, &buffer);
    gl.BindBuffer(GL_ARRAY_BUFFER, buffer);
    gl.EnableVertexAttribArray(0);
    gl.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, NULL);
    gl.ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    gl.Viewport(0, 0, MODEL_WIDTH, MODEL_HEIGHT);
}

static void set_enabled(GLenum what, bool enabled) {
    if (enabled) {
        gl.Enable(what);
    } else {
        gl.Disable(what);
    }
}

static const GLenum factors[DIP_BLEND_FACTOR_COUNT] = {
    [DIP_BLEND_ZERO] = GL_ZERO,
    [DIP_BLEND_ONE] = GL_ONE,
    [DIP_BLEND_SOURCE_COLOUR] = GL_SRC_COLOR,
    [DIP_BLEND_ONE_MINUS_SOURCE_COLOUR] = GL_ONE_MINUS_SRC_COLOR,
    [DIP_BLEND_TARGET_COLOUR] = GL_DST_COLOR,
    [DIP_BLEND_ONE_MINUS_TARGET_COLOUR] = GL_ONE_MINUS_DST_COLOR,
    [DIP_BLEND_SOURCE_ALPHA] = GL_SRC_ALPHA,
    [DIP_BLEND_ONE_MINUS_SOURCE_ALPHA] = GL_ONE_MINUS_SRC_ALPHA,
    [DIP_BLEND_TARGET_ALPHA] = GL_DST_ALPHA,
    [DIP_BLEND_ONE_MINUS_TARGET_ALPHA] = GL_ONE_MINUS_DST_ALPHA,
    [DIP_BLEND_CONSTANT] = GL_CONSTANT_COLOR,
    [DIP_BLEND_ONE_MINUS_CONSTANT] = GL_ONE_MINUS_CONSTANT_COLOR,
    [DIP_BLEND_SOURCE_ALPHA_SATURATED] = GL_SRC_ALPHA_SATURATE,
};

static const GLenum ops[DIP_BLEND_OP_COUNT] = {
    [DIP_BLEND_ADD] = GL_FUNC_ADD,
    [DIP_BLEND_SUBTRACT] = GL_FUNC_SUBTRACT,
    [DIP_BLEND_REVERSE_SUBTRACT] = GL_FUNC_REVERSE_SUBTRACT,
    [DIP_BLEND_MIN] = GL_MIN,
    [DIP_BLEND_MAX] = GL_MAX,
};

static const GLenum depth_tests[DIP_DEPTH_TEST_COUNT] = {
    [DIP_DEPTH_NEARER] = GL_GREATER, [DIP_DEPTH_NEARER_OR_EQUAL] = GL_GEQUAL,
    [DIP_DEPTH_EQUAL] = GL_EQUAL,    [DIP_DEPTH_NOT_EQUAL] = GL_NOTEQUAL,
    [DIP_DEPTH_FARTHER] = GL_LESS,   [DIP_DEPTH_FARTHER_OR_EQUAL] = GL_LEQUAL,
    [DIP_DEPTH_ALWAYS] = GL_ALWAYS,  [DIP_DEPTH_NEVER] = GL_NEVER,
};

static const GLenum compares[] = {
    [DIP_COMPARE_ALWAYS] = GL_ALWAYS,
    [DIP_COMPARE_NEVER] = GL_NEVER,
    [DIP_COMPARE_LESS] = GL_LESS,
    [DIP_COMPARE_LESS_OR_EQUAL] = GL_LEQUAL,
    [DIP_COMPARE_EQUAL] = GL_EQUAL,
    [DIP_COMPARE_NOT_EQUAL] = GL_NOTEQUAL,
    [DIP_COMPARE_GREATER_OR_EQUAL] = GL_GEQUAL,
    [DIP_COMPARE_GREATER] = GL_GREATER,
};

static const GLenum stencil_ops[DIP_STENCIL_OP_COUNT] = {
    [DIP_STENCIL_KEEP] = GL_KEEP,
    [DIP_STENCIL_ZERO] = GL_ZERO,
    [DIP_STENCIL_REPLACE] = GL_REPLACE,
    [DIP_STENCIL_INCREMENT_CLAMP] = GL_INCR,
    [DIP_STENCIL_DECREMENT_CLAMP] = GL_DECR,
    [DIP_STENCIL_INVERT] = GL_INVERT,
    [DIP_STENCIL_INCREMENT_WRAP] = GL_INCR_WRAP,
    [DIP_STENCIL_DECREMENT_WRAP] = GL_DECR_WRAP,
};

static void set_stencil(const DipStencil *stencil) {
    const DipStencilFace *faces[2] = {&stencil->front, &stencil->back};
    const GLenum names[2] = {GL_FRONT, GL_BACK};
    set_enabled(GL_STENCIL_TEST, stencil->enabled);
    for (int i = 0; i < 2; i++) {
        const bool own = i == 1 && stencil->back_has_values;
        gl.StencilFuncSeparate(names[i], compares[faces[i]->function],
                               own ? stencil->back_reference : stencil->reference,
                               own ? stencil->back_read_mask : stencil->read_mask);
        gl.StencilMaskSeparate(names[i], own ? stencil->back_write_mask : stencil->write_mask);
        gl.StencilOpSeparate(names[i], stencil_ops[faces[i]->stencil_failed],
                             stencil_ops[faces[i]->depth_failed], stencil_ops[faces[i]->passed]);
    }
}

static void set_state(const ModelDraw *draw) {
    const DipDrawState *state = &draw->state;
    const DipBlend *blend = &state->blend;
    const uint8_t kept = state->kept_channels;
    set_enabled(GL_BLEND, blend->enabled);
    gl.BlendFuncSeparate(factors[blend->colour.source], factors[blend->colour.target],
                         factors[blend->alpha.source], factors[blend->alpha.target]);
    gl.BlendEquationSeparate(ops[blend->colour.op], ops[blend->alpha.op]);
    gl.BlendColor(blend->constant[0], blend->constant[1], blend->constant[2], blend->constant[3]);
    gl.ColorMask(!(kept & DIP_CHANNEL_RED), !(kept & DIP_CHANNEL_GREEN), !(kept & DIP_CHANNEL_BLUE),
                 !(kept & DIP_CHANNEL_ALPHA));
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(depth_tests[state->depth_test]);
    gl.DepthMask(!state->keep_depth);
    set_stencil(&state->stencil);
    set_enabled(GL_CULL_FACE, draw->cull != DIP_CULL_NONE);
    gl.CullFace(draw->cull == DIP_CULL_FRONT ? GL_FRONT : GL_BACK);
}

static void draw_theirs(const ModelList *list, Picture picture) {
    const DipTargetRegion *s = &list->scissor[0];
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.DepthMask(GL_TRUE);
    gl.StencilMask(255);
    set_enabled(GL_SCISSOR_TEST, s->x1 > 0);
    gl.Scissor(s->x0, s->y0, s->x1 - s->x0, s->y1 - s->y0);
    gl.ClearColor(list->clear[0], list->clear[1], list->clear[2], list->clear[3]);
    gl.ClearDepth((double)list->clear_depth);
    gl.ClearStencil(list->clear_stencil);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    for (int d = 0; d < MODEL_DRAWS; d++) {
        const ModelDraw *draw = &list->draws[0][d];
        // A plain draw writes the alpha 1.
        const bool plain = !dip_state_is_ordered(&draw->state);
        float vertices[VERTICES][3];
        if (draw->state.kept_samples & 1) {
            continue; // With one sample per pixel, the draw changes nothing.
        }
        vertices_of(draw, vertices);
        gl.BufferData(GL_ARRAY_BUFFER, sizeof vertices, vertices, GL_STREAM_DRAW);
        set_state(draw);
        gl.Uniform4fv(colour_place, 1, draw->colour);
        gl.Uniform1i(clips_place, draw->clips);
        gl.Uniform1i(reads_front_place, draw->state.reads_front);
        if (plain) {
            gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
        }
        gl.DrawArrays(GL_TRIANGLES, 0, VERTICES);
    }
    gl.Finish();
    gl.ReadPixels(0, 0, MODEL_WIDTH, MODEL_HEIGHT, GL_RGBA, GL_FLOAT, picture);
    assert_int_equal(gl.GetError(), GL_NO_ERROR);
}

// --- comparing -----------------------------------------------------------------------------------

// The lists for OpenGL: draws that write another alpha than their shader's do not exist there, so
// every draw is ordered. OpenGL counts the constant part of a depth bias in units that depend on
// the depth, so no draw has one.
static void order_all(ModelList *list) {
    for (int d = 0; d < MODEL_DRAWS; d++) {
        list->draws[0][d].state.ordered = true;
        list->draws[0][d].state.depth_bias.constant = 0.0f;
    }
}

// Whether an edge of some triangle passes within 1/64 pixel of a pixel's centre. llvmpipe rounds
// positions in floats of its own, so such a pixel may fall to either side.
static bool is_ambiguous(const ModelList *list, int x, int y) {
    for (int d = 0; d < MODEL_DRAWS; d++) {
        for (int t = 0; t < MODEL_TRIANGLES; t++) {
            const DipOracleTriangle *triangle = &list->draws[0][d].triangle[t];
            for (int i = 0; i < 3; i++) {
                const double ax = triangle->x[i] / 256.0;
                const double ay = triangle->y[i] / 256.0;
                const double dx = triangle->x[(i + 1) % 3] / 256.0 - ax;
                const double dy = triangle->y[(i + 1) % 3] / 256.0 - ay;
                const double side = dx * (y + 0.5 - ay) - dy * (x + 0.5 - ax);
                if (fabs(side) <= sqrt(dx * dx + dy * dy) / 64.0) {
                    return true;
                }
            }
        }
    }
    return false;
}

static void same_pictures(void **state) {
    (void)state;
    static Picture ours, theirs;
    static ModelList list;
    Random random = {1234};
    DipPool *pool = dip_pool_create(2, NULL);
    DipPipeline *pipeline =
        dip_pipeline_create(pool, dip_isa_best(), MODEL_WIDTH, MODEL_HEIGHT, NULL);
    int pixels = 0;
    int differ = 0;
    for (int i = 0; i < list_count; i++) {
        model_random_list(&random, &list);
        order_all(&list);
        memset(ours, 0, sizeof ours);
        draw_ours(pipeline, &list, ours);
        draw_theirs(&list, theirs);
        const DipTargetRegion *s = &list.scissor[0];
        for (int y = 0; y < MODEL_HEIGHT; y++) {
            for (int x = 0; x < MODEL_WIDTH; x++) {
                const bool stored =
                    (!s->x1 || (x >= s->x0 && x < s->x1 && y >= s->y0 && y < s->y1)) &&
                    !is_ambiguous(&list, x, y);
                bool same = true;
                for (int c = 0; stored && c < 4; c++) {
                    const double a = ours[y][x][c];
                    const double b = theirs[y][x][c];
                    // Colours that have grown enlarge the rounding of every later draw.
                    same = same && (fabs(a - b) <= 1e-4 * (1.0 + fabs(a)) || !(fabs(a) < 1e3));
                }
                pixels += stored;
                differ += !same;
            }
        }
    }
    dip_pipeline_destroy(&pipeline);
    dip_pool_destroy(&pool);
    print_message("%d of %d pixels differ\n", differ, pixels);
    assert_true(pixels > 1000 * list_count);
    assert_int_equal(differ, 0);
}

int main(int argc, char **argv) {
    if (argc == 3 && strcmp(argv[1], "--lists") == 0) {
        list_count = atoi(argv[2]);
    }
    DipError err = {0};
    if (!dip_gl_open(&gl, 2, &err)) {
        printf("skipped: %s\n", err.message);
        return 77;
    }
    make_program();
    make_buffers();
    const struct CMUnitTest tests[] = {cmocka_unit_test(same_pictures)};
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    dip_gl_close(&gl);
    return failed;
}
