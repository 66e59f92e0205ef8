// The plain model of merged passes.
#include "tests/renderer/pipeline/merge_model.h"

#include <math.h>
#include <string.h>

double model_shade(const ModelDraw *draw, bool front, int x, int y, int channel) {
    const double share = (1.0 + ((x + 3 * y) & 3)) / 4.0;
    return (double)draw->colour[channel] * (front ? 0.5 * share : share);
}

bool model_keeps(bool front, int x, int y) {
    return (x ^ y) & (front ? 4 : 2);
}

// Half a unit in the last place of a float, relative to its value.
static const double unit = 0x1p-24;

static ModelValue exact(double v) {
    return (ModelValue){v, 0.0};
}

static ModelValue rounded(double v) {
    return (ModelValue){v, fabs(v) * unit};
}

static ModelValue times(ModelValue a, ModelValue b) {
    const double v = a.value * b.value;
    const double error = fabs(a.value) * b.error + fabs(b.value) * a.error + a.error * b.error;
    return (ModelValue){v, error + (fabs(v) + error) * unit};
}

static ModelValue plus(ModelValue a, double sign, ModelValue b) {
    const double v = a.value + sign * b.value;
    const double error = a.error + b.error;
    return (ModelValue){v, error + (fabs(v) + error) * unit};
}

static ModelValue one_minus(ModelValue a) {
    return plus(exact(1.0), -1.0, a);
}

static ModelValue lesser(ModelValue a, ModelValue b) {
    return (ModelValue){fmin(a.value, b.value), fmax(a.error, b.error)};
}

static ModelValue greater(ModelValue a, ModelValue b) {
    return (ModelValue){fmax(a.value, b.value), fmax(a.error, b.error)};
}

static ModelValue factor(DipBlendFactor kind, const ModelValue s[4], const ModelValue t[4], int c,
                         const float *constant) {
    switch (kind) {
    case DIP_BLEND_ZERO:
        return exact(0.0);
    case DIP_BLEND_ONE:
        return exact(1.0);
    case DIP_BLEND_SOURCE_COLOUR:
        return s[c];
    case DIP_BLEND_ONE_MINUS_SOURCE_COLOUR:
        return one_minus(s[c]);
    case DIP_BLEND_TARGET_COLOUR:
        return t[c];
    case DIP_BLEND_ONE_MINUS_TARGET_COLOUR:
        return one_minus(t[c]);
    case DIP_BLEND_SOURCE_ALPHA:
        return s[3];
    case DIP_BLEND_ONE_MINUS_SOURCE_ALPHA:
        return one_minus(s[3]);
    case DIP_BLEND_TARGET_ALPHA:
        return t[3];
    case DIP_BLEND_ONE_MINUS_TARGET_ALPHA:
        return one_minus(t[3]);
    case DIP_BLEND_CONSTANT:
        return exact((double)constant[c]);
    case DIP_BLEND_ONE_MINUS_CONSTANT:
        return one_minus(exact((double)constant[c]));
    default:
        return c == 3 ? exact(1.0) : lesser(s[3], one_minus(t[3]));
    }
}

static ModelValue merged(const DipBlend *blend, const ModelValue s[4], const ModelValue t[4],
                         int c) {
    const DipBlendEquation *e = c == 3 ? &blend->alpha : &blend->colour;
    const ModelValue a = times(s[c], factor(e->source, s, t, c, blend->constant));
    const ModelValue b = times(t[c], factor(e->target, s, t, c, blend->constant));
    switch (e->op) {
    case DIP_BLEND_ADD:
        return plus(a, 1.0, b);
    case DIP_BLEND_SUBTRACT:
        return plus(a, -1.0, b);
    case DIP_BLEND_REVERSE_SUBTRACT:
        return plus(b, -1.0, a);
    case DIP_BLEND_MIN:
        return lesser(s[c], t[c]);
    default:
        return greater(s[c], t[c]);
    }
}

static ModelValue clamp(ModelValue v) {
    return (ModelValue){v.value > 0.0 ? fmin(v.value, 1.0) : 0.0, v.error};
}

void model_clear(Model *model, const float clear[4], float depth, uint8_t stencil) {
    for (int y = model->stored.y0; y < model->stored.y1; y++) {
        for (int x = model->stored.x0; x < model->stored.x1; x++) {
            for (int s = 0; s < model->sample_count; s++) {
                for (int c = 0; clear && c < 4; c++) {
                    model->colour[y][x][s][c] = exact(clear[c]);
                }
                model->depth[y][x][s] = depth >= 0.0f ? depth : model->depth[y][x][s];
                model->stencil[y][x][s] = depth >= 0.0f ? stencil : model->stencil[y][x][s];
            }
        }
    }
}

// Whether a shader of the draw sees a front face.
static bool shows_front(const ModelDraw *draw, bool front) {
    return draw->state.reads_front && front;
}

static void write_colour(const Model *model, const ModelDraw *draw, bool front, int x, int y,
                         ModelValue t[4]) {
    ModelValue s[4];
    ModelValue result[4];
    for (int c = 0; c < 4; c++) {
        s[c] = rounded(model_shade(draw, shows_front(draw, front), x, y, c));
        s[c] = model->clamps ? clamp(s[c]) : s[c];
    }
    for (int c = 0; c < 4; c++) {
        result[c] = draw->state.blend.enabled ? merged(&draw->state.blend, s, t, c) : s[c];
        result[c] = model->clamps ? clamp(result[c]) : result[c];
    }
    const bool plain = !dip_state_is_ordered(&draw->state);
    for (int c = 0; c < 4; c++) {
        if (!(draw->state.kept_channels >> c & 1)) {
            t[c] = plain && c == 3 ? exact(1.0) : result[c];
        }
    }
}

static bool compare(DipCompare function, int a, int b) {
    const bool results[] = {
        [DIP_COMPARE_ALWAYS] = true,
        [DIP_COMPARE_NEVER] = false,
        [DIP_COMPARE_LESS] = a<b, [DIP_COMPARE_LESS_OR_EQUAL] = a <= b,
                               [DIP_COMPARE_EQUAL] = a == b, [DIP_COMPARE_NOT_EQUAL] = a != b,
                               [DIP_COMPARE_GREATER_OR_EQUAL] = a >= b, [DIP_COMPARE_GREATER] = a>
            b};
    return results[function];
}

static int operate(DipStencilOp op, int v, int reference) {
    const int results[] = {[DIP_STENCIL_KEEP] = v,
                           [DIP_STENCIL_ZERO] = 0,
                           [DIP_STENCIL_REPLACE] = reference,
                           [DIP_STENCIL_INCREMENT_CLAMP] = v == 255 ? 255 : v + 1,
                           [DIP_STENCIL_DECREMENT_CLAMP] = v == 0 ? 0 : v - 1,
                           [DIP_STENCIL_INVERT] = 255 - v,
                           [DIP_STENCIL_INCREMENT_WRAP] = (v + 1) % 256,
                           [DIP_STENCIL_DECREMENT_WRAP] = (v + 255) % 256};
    return results[op];
}

static bool depth_passes(DipDepthTest test, double z, double stored) {
    const bool results[] = {
        [DIP_DEPTH_NEARER] = z > stored,  [DIP_DEPTH_NEARER_OR_EQUAL] = z >= stored,
        [DIP_DEPTH_EQUAL] = z == stored,  [DIP_DEPTH_NOT_EQUAL] = z != stored,
        [DIP_DEPTH_FARTHER] = z < stored, [DIP_DEPTH_FARTHER_OR_EQUAL] = z <= stored,
        [DIP_DEPTH_ALWAYS] = true,        [DIP_DEPTH_NEVER] = false};
    return results[test];
}

static void draw_sample(Model *model, const ModelDraw *draw, bool front, double unbiased, int x,
                        int y, int s) {
    const DipDrawState *state = &draw->state;
    if (state->kept_samples >> s & 1) {
        return;
    }
    // The triangles are parallel to the screen, and depths and constants are dyadic.
    const double z = fmin(fmax(unbiased + (double)state->depth_bias.constant, 0.0), 1.0);
    const bool passes_depth = depth_passes(state->depth_test, z, model->depth[y][x][s]);
    bool passes = true;
    if (state->stencil.enabled) {
        const DipStencil *stencil = &state->stencil;
        const DipStencilFace *face = front ? &stencil->front : &stencil->back;
        const bool own = stencil->back_has_values && !front;
        const int reference = own ? stencil->back_reference : stencil->reference;
        const int read = own ? stencil->back_read_mask : stencil->read_mask;
        const int write = own ? stencil->back_write_mask : stencil->write_mask;
        uint8_t *stored = &model->stencil[y][x][s];
        passes = compare(face->function, reference & read, *stored & read);
        const int value = operate(!passes         ? face->stencil_failed
                                  : !passes_depth ? face->depth_failed
                                                  : face->passed,
                                  *stored, reference);
        *stored = (uint8_t)((*stored & ~write) | (value & write));
    }
    if (passes && passes_depth) {
        model->depth[y][x][s] = state->keep_depth ? model->depth[y][x][s] : z;
        write_colour(model, draw, front, x, y, model->colour[y][x][s]);
    }
}

// A front face winds counter-clockwise with y up. The positions have y down.
static int64_t area_of(const DipOracleTriangle *t) {
    return ((int64_t)t->x[1] - t->x[0]) * ((int64_t)t->y[2] - t->y[0]) -
           ((int64_t)t->x[2] - t->x[0]) * ((int64_t)t->y[1] - t->y[0]);
}

void model_draw(Model *model, const ModelDraw *draw) {
    static uint8_t masks[MODEL_HEIGHT * MODEL_WIDTH];
    const DipOracleRegion region = {0, 0, MODEL_WIDTH, MODEL_HEIGHT};
    for (int t = 0; t < MODEL_TRIANGLES; t++) {
        const bool front = area_of(&draw->triangle[t]) < 0;
        if (draw->cull == (front ? DIP_CULL_FRONT : DIP_CULL_BACK)) {
            continue;
        }
        dip_oracle_cover(&draw->triangle[t], dip_sample_pattern(model->sample_count), &region,
                         masks);
        for (int y = model->stored.y0; y < model->stored.y1; y++) {
            for (int x = model->stored.x0; x < model->stored.x1; x++) {
                for (int s = 0; s < model->sample_count; s++) {
                    if (masks[y * MODEL_WIDTH + x] >> s & 1 &&
                        (!draw->clips || model_keeps(shows_front(draw, front), x, y))) {
                        draw_sample(model, draw, front, draw->depth[t], x, y, s);
                    }
                }
            }
        }
    }
}

void model_resolve(Model *model) {
    for (int y = 0; y < MODEL_HEIGHT; y++) {
        for (int x = 0; x < MODEL_WIDTH; x++) {
            for (int c = 0; c < 4; c++) {
                ModelValue mean = {0.0, 0.0};
                for (int s = 0; s < model->sample_count; s++) {
                    mean.value += model->colour[y][x][s][c].value / model->sample_count;
                    mean.error += model->colour[y][x][s][c].error / model->sample_count;
                }
                mean.error += fabs(mean.value) * unit;
                for (int s = 0; s < model->sample_count; s++) {
                    model->colour[y][x][s][c] = mean;
                }
            }
        }
    }
}
