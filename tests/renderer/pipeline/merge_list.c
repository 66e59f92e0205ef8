// Makes random lists of draws with states.
#include "tests/renderer/pipeline/merge_list.h"

#include <string.h>

static DipDrawState random_state(Random *random) {
    DipDrawState state = {.ordered = random_int(random, 0, 9) == 0};
    if (random_int(random, 0, 3) == 0) {
        // One of these alone makes the draw ordered.
        state.kept_samples = random_int(random, 0, 3) ? 0 : (uint8_t)random_int(random, 0, 255);
        state.reads_front = random_int(random, 0, 3) == 0;
        return state;
    }
    DipBlend *blend = &state.blend;
    blend->enabled = random_int(random, 0, 2) > 0;
    DipBlendEquation *equations[2] = {&blend->colour, &blend->alpha};
    for (int i = 0; i < 2; i++) {
        equations[i]->source = (DipBlendFactor)random_int(random, 0, DIP_BLEND_FACTOR_COUNT - 1);
        equations[i]->target = (DipBlendFactor)random_int(random, 0, DIP_BLEND_FACTOR_COUNT - 1);
        equations[i]->op = (DipBlendOp)random_int(random, 0, DIP_BLEND_OP_COUNT - 1);
    }
    static const DipBlendEquation none[2];
    if (!memcmp(&blend->colour, none, sizeof *none) && !memcmp(&blend->alpha, none, sizeof *none)) {
        blend->colour.source = DIP_BLEND_ONE; // Blending without equations is refused.
    }
    for (int c = 0; c < 4; c++) {
        blend->constant[c] = (float)random_real(random, 0.0, 1.0);
    }
    state.kept_channels = random_int(random, 0, 4) ? 0 : (uint8_t)random_int(random, 0, 15);
    state.depth_test = random_int(random, 0, 2)
                           ? DIP_DEPTH_NEARER_OR_EQUAL
                           : (DipDepthTest)random_int(random, 0, DIP_DEPTH_TEST_COUNT - 1);
    state.keep_depth = random_int(random, 0, 2) == 0;
    DipStencil *stencil = &state.stencil;
    stencil->enabled = random_int(random, 0, 2) == 0;
    stencil->reference = (uint8_t)random_int(random, 0, 255);
    stencil->read_mask = random_int(random, 0, 1) ? 255 : (uint8_t)random_int(random, 0, 255);
    stencil->write_mask = random_int(random, 0, 1) ? 255 : (uint8_t)random_int(random, 0, 255);
    if (!stencil->read_mask && !stencil->write_mask) {
        stencil->write_mask = 1; // A test without masks is refused.
    }
    DipStencilFace *faces[2] = {&stencil->front, &stencil->back};
    for (int i = 0; i < 2; i++) {
        faces[i]->function = (DipCompare)random_int(random, 0, DIP_COMPARE_GREATER);
        faces[i]->stencil_failed = (DipStencilOp)random_int(random, 0, DIP_STENCIL_OP_COUNT - 1);
        faces[i]->depth_failed = (DipStencilOp)random_int(random, 0, DIP_STENCIL_OP_COUNT - 1);
        faces[i]->passed = (DipStencilOp)random_int(random, 0, DIP_STENCIL_OP_COUNT - 1);
    }
    stencil->back_has_values = random_int(random, 0, 1);
    stencil->back_reference = (uint8_t)random_int(random, 0, 255);
    stencil->back_read_mask = (uint8_t)random_int(random, 0, 255);
    stencil->back_write_mask = (uint8_t)random_int(random, 0, 255);
    state.depth_bias.constant =
        random_int(random, 0, 3) ? 0.0f : (float)random_int(random, -20, 20) / 32.0f;
    state.kept_samples = random_int(random, 0, 3) ? 0 : (uint8_t)random_int(random, 0, 255);
    state.reads_front = random_int(random, 0, 3) == 0;
    return state;
}

static ModelDraw random_draw(Random *random, int sample_count) {
    static const DipOracleKind kinds[] = {DIP_ORACLE_small,      DIP_ORACLE_large,
                                          DIP_ORACLE_large,      DIP_ORACLE_sliver,
                                          DIP_ORACLE_on_samples, DIP_ORACLE_axis_aligned};
    const DipOracleRegion region = {0, 0, MODEL_WIDTH, MODEL_HEIGHT};
    ModelDraw draw = {.clips = random_int(random, 0, 4) == 0,
                      .cull = (DipCull)random_int(random, 0, 5),
                      .state = random_state(random)};
    draw.cull = draw.cull > DIP_CULL_FRONT ? DIP_CULL_NONE : draw.cull;
    for (int t = 0; t < MODEL_TRIANGLES; t++) {
        draw.triangle[t] = dip_oracle_make(kinds[random_int(random, 0, 5)], random,
                                           dip_sample_pattern(sample_count), &region, 200 * 256);
        draw.depth[t] = (float)random_int(random, 1, 15) / 16.0f;
    }
    for (int c = 0; c < 4; c++) {
        draw.colour[c] = (float)random_real(random, 0.0, 1.0);
    }
    return draw;
}

static DipTargetRegion random_rectangle(Random *random) {
    const int x = random_int(random, 0, MODEL_WIDTH - 2);
    const int y = random_int(random, 0, MODEL_HEIGHT - 2);
    if (random_int(random, 0, 2)) {
        return (DipTargetRegion){0, 0, 0, 0};
    }
    return (DipTargetRegion){x, y, random_int(random, x + 1, MODEL_WIDTH),
                             random_int(random, y + 1, MODEL_HEIGHT)};
}

void model_random_list(Random *random, ModelList *list) {
    static const int counts[] = {1, 2, 4, 6, 8};
    list->sample_count = counts[random_int(random, 0, 4)];
    list->format = random_int(random, 0, 2) ? DIP_FORMAT_RGBA32F : DIP_FORMAT_SRGB8;
    list->keeps_colour = list->format == DIP_FORMAT_RGBA32F && random_int(random, 0, 1);
    list->keeps_depth = random_int(random, 0, 1);
    for (int c = 0; c < 3; c++) {
        list->clear[c] = (float)random_real(random, 0.0, 1.0);
    }
    list->clear[3] = random_int(random, 0, 1) ? 1.0f : 0.0f;
    list->clear_depth = random_int(random, 0, 2) ? 0.0f : (float)random_int(random, 0, 16) / 16.0f;
    list->clear_stencil = (uint8_t)random_int(random, 0, 255);
    for (int p = 0; p < MODEL_PASSES; p++) {
        list->scissor[p] = random_rectangle(random);
        list->viewport[p] = (DipTargetRegion){0, 0, 0, 0};
        for (int d = 0; d < MODEL_DRAWS; d++) {
            list->draws[p][d] = random_draw(random, list->sample_count);
        }
    }
}
