// Checks what shaders read.
#include "renderer/pipeline/run/shader_guard.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

// --- faults --------------------------------------------------------------------------------------

static bool is_earlier(uint32_t draw, const DipError *err, uint32_t than_draw,
                       const DipError *than) {
    return !than->code || draw < than_draw ||
           (draw == than_draw && strcmp(err->message, than->message) < 0);
}

// Keeps a fault of the current draw, unless an earlier one is kept. Returns false.
static bool refuse(DipShaderGuard *guard, DipErrorCode code, const char *field, const char *format,
                   ...) DIP_PRINTF(4, 5);
static bool refuse(DipShaderGuard *guard, DipErrorCode code, const char *field, const char *format,
                   ...) {
    char message[sizeof guard->fault.message];
    char key[sizeof guard->fault.key];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    snprintf(key, sizeof key, "draws[%u].%s", guard->draw_index, field);
    DipError err;
    dip_error_set(&err, code, NULL, 0, key, "%s", message);
    if (is_earlier(guard->draw_index, &err, guard->fault_draw, &guard->fault)) {
        guard->fault = err;
        guard->fault_draw = guard->draw_index;
    }
    return false;
}

void dip_shader_guard_collect(const DipShaderGuard *guard, DipError *fault, uint32_t *fault_draw) {
    if (guard->fault.code && is_earlier(guard->fault_draw, &guard->fault, *fault_draw, fault)) {
        *fault = guard->fault;
        *fault_draw = guard->fault_draw;
    }
}

// --- textures ------------------------------------------------------------------------------------

static bool check_number(DipShaderGuard *guard, const char *name, int value, int least, int most) {
    return (value >= least && value <= most) || refuse(guard, DIP_ERROR_RANGE, "samplers",
                                                       "a shader reads a sampler whose %s is %d, "
                                                       "accepted %d..%d",
                                                       name, value, least, most);
}

static bool check_shown(DipShaderGuard *guard, const DipSampler *sampler) {
    const int last = dip_texture_level_count(sampler->shown) - 1;
    for (int l = 0; l < dip_texture_level_count(sampler->texture); l++) {
        if (!check_number(guard, "shown_level", sampler->shown_level[l], 0, last)) {
            return false;
        }
    }
    return true;
}

static bool check_sampler(DipShaderGuard *guard, const DipSampler *sampler) {
    enum { MOST_LOD8 = 1 << 20 };
    if (!sampler || !sampler->texture) {
        return refuse(guard, DIP_ERROR_MISSING, "samplers",
                      "a shader reads a sampler that has no texture");
    }
    return check_number(guard, "max_anisotropy", sampler->max_anisotropy, 0, 16) &&
           check_number(guard, "filter", (int)sampler->filter, 0, DIP_FILTER_COUNT - 1) &&
           check_number(guard, "min_lod8", sampler->min_lod8, 0, MOST_LOD8) &&
           check_number(guard, "bias_lod8", sampler->bias_lod8, -MOST_LOD8, MOST_LOD8) &&
           (!sampler->shown || check_shown(guard, sampler));
}

// Without mips and anisotropic filtering, a read does not depend on derivatives.
static bool needs_derivatives(const DipSampler *sampler) {
    return !sampler->no_mips ||
           (sampler->max_anisotropy > 1 && sampler->filter != DIP_FILTER_POINT);
}

static bool check_coordinates(DipShaderGuard *guard, const DipSampler *sampler, int u) {
    const int own = DIP_MAX_VARYINGS - guard->draw->computed_varying_count;
    const bool exists = u >= 0 && u < DIP_MAX_VARYINGS - 1;
    if (exists && (u + 1 < guard->derivative_count || u >= own)) {
        return true;
    }
    if (!exists || u + 1 >= guard->varying_count) {
        return refuse(guard, DIP_ERROR_RANGE, "varying_count",
                      "a shader reads a texture at the varyings %d and %d, but it gets %d varyings",
                      u, u < DIP_MAX_VARYINGS ? u + 1 : u, guard->varying_count);
    }
    return !needs_derivatives(sampler) ||
           refuse(guard, DIP_ERROR_CONFLICT, "value_only_varying_count",
                  "a shader reads a texture at the varyings %d and %d, accepted varyings with "
                  "derivatives, of which it gets %d",
                  u, u + 1, guard->derivative_count);
}

static bool check_read(DipShaderGuard *guard, const DipSampler *sampler, int u_varying) {
    return check_sampler(guard, sampler) && check_coordinates(guard, sampler, u_varying);
}

static void sample_colour(DipFragmentBatch *batch, const DipSampler *sampler, int u_varying,
                          float (*out)[DIP_FRAGMENT_BATCH]) {
    if (check_read(batch->guard, sampler, u_varying)) {
        batch->guard->kernels->dip_kernel_sample_colour(batch, sampler, u_varying, out);
    } else {
        memset(out, 0, 3 * sizeof *out);
    }
}

static void sample_colours(DipFragmentBatch *batch, const DipSampler *const samplers[2],
                           int u_varying, float (*const out[2])[DIP_FRAGMENT_BATCH]) {
    if (check_read(batch->guard, samplers[0], u_varying) &&
        check_read(batch->guard, samplers[1], u_varying)) {
        batch->guard->kernels->dip_kernel_sample_colours(batch, samplers, u_varying, out);
    } else {
        memset(out[0], 0, 3 * sizeof *out[0]);
        memset(out[1], 0, 3 * sizeof *out[1]);
    }
}

static void sample_alpha(DipFragmentBatch *batch, const DipSampler *sampler, int u_varying,
                         float *out) {
    if (check_read(batch->guard, sampler, u_varying)) {
        batch->guard->kernels->dip_kernel_sample_alpha(batch, sampler, u_varying, out);
    } else {
        memset(out, 0, DIP_FRAGMENT_BATCH * sizeof *out);
    }
}

static void sample_alpha_slope(DipFragmentBatch *batch, const DipSampler *sampler, int u_varying,
                               float *out, float *slope) {
    if (check_read(batch->guard, sampler, u_varying)) {
        batch->guard->kernels->dip_kernel_sample_alpha_slope(batch, sampler, u_varying, out, slope);
    } else {
        memset(out, 0, DIP_FRAGMENT_BATCH * sizeof *out);
        memset(slope, 0, DIP_FRAGMENT_BATCH * sizeof *slope);
    }
}

// --- targets and depths --------------------------------------------------------------------------

static int64_t row_bytes(const DipTarget *target) {
    return (int64_t)target->width * 4;
}

// Returns whether two targets with the same rows share bytes, if b begins `bytes` after a. Targets
// of one larger picture may lie side by side, so that their rows take turns.
static bool share_rows(const DipTarget *a, const DipTarget *b, int64_t bytes) {
    const int64_t stride = (int64_t)a->stride_bytes;
    const int64_t rows = bytes / stride;
    const int64_t column = bytes % stride;
    return rows < a->height &&
           (column < row_bytes(a) || (column + row_bytes(b) > stride && rows + 1 < a->height));
}

// Returns whether two targets share bytes. If their rows are of different lengths, bytes between
// the rows count, too.
static bool overlap(const DipTarget *a, const DipTarget *b) {
    if (!a->rgba8 || !b->rgba8 || a->height < 1 || b->height < 1) {
        return false;
    }
    const DipTarget *first = (uintptr_t)a->rgba8 <= (uintptr_t)b->rgba8 ? a : b;
    const DipTarget *second = first == a ? b : a;
    const int64_t bytes = (int64_t)((uintptr_t)second->rgba8 - (uintptr_t)first->rgba8);
    return first->stride_bytes == second->stride_bytes
               ? share_rows(first, second, bytes)
               : bytes < (int64_t)first->stride_bytes * first->height;
}

// Returns whether a pass writes a target's bytes while it is drawn.
static bool writes(const DipPass *pass, const DipTarget *target) {
    return !pass->attachments.keep_target && pass->target.format != DIP_FORMAT_CALLER &&
           overlap(target, &pass->target);
}

// Names guard->at_once[index] in a message.
static const char *drawing_pass(const DipShaderGuard *guard, int index) {
    return guard->at_once[index] == guard->pass ? "the pass" : "a pass that is drawn at once";
}

static bool check_target(DipShaderGuard *guard, const DipTarget *target) {
    if (!target || target->format != DIP_FORMAT_SRGB8 || !target->rgba8) {
        return refuse(guard, DIP_ERROR_CONFLICT, "sample_target",
                      "a shader reads a target that is not DIP_FORMAT_SRGB8 or has no pixels");
    }
    const size_t row = (size_t)target->width * 4;
    if (target->width < 1 || target->height < 1 || target->width > DIP_MAX_TARGET_SIZE ||
        target->height > DIP_MAX_TARGET_SIZE || target->stride_bytes < row ||
        target->stride_bytes % 4 || target->stride_bytes / 4 > INT32_MAX / DIP_MAX_TARGET_SIZE) {
        return refuse(guard, DIP_ERROR_RANGE, "sample_target",
                      "a shader reads a target of %dx%d pixels and rows of %zu bytes",
                      target->width, target->height, target->stride_bytes);
    }
    for (int i = 0; i < guard->at_once_count; i++) {
        if (writes(guard->at_once[i], target)) {
            return refuse(guard, DIP_ERROR_CONFLICT, "sample_target",
                          "a shader reads the target that %s draws, accepted the target of an "
                          "earlier pass",
                          drawing_pass(guard, i));
        }
    }
    return true;
}

static void sample_target(DipFragmentBatch *batch, const DipTarget *target, const float *u,
                          const float *v, float (*out)[DIP_FRAGMENT_BATCH]) {
    if (check_target(batch->guard, target)) {
        batch->guard->kernels->dip_kernel_sample_target(batch, target, u, v, out);
    } else {
        memset(out, 0, 3 * sizeof *out);
    }
}

static bool check_shadow(DipShaderGuard *guard, const DipShadowMap *map) {
    if (!map || !map->depth) {
        return refuse(guard, DIP_ERROR_MISSING, "sample_shadow",
                      "a shader reads a shadow map that has no depths");
    }
    for (int i = 0; i < guard->at_once_count; i++) {
        if (map->depth == guard->at_once[i]->attachments.depth) {
            return refuse(guard, DIP_ERROR_CONFLICT, "sample_shadow",
                          "a shader reads the depths that %s draws, accepted those of an earlier "
                          "pass",
                          drawing_pass(guard, i));
        }
    }
    return true;
}

static void sample_shadow(DipFragmentBatch *batch, const DipShadowMap *map, const float *u,
                          const float *v, const float *z, float *out) {
    if (check_shadow(batch->guard, map)) {
        batch->guard->kernels->dip_kernel_sample_shadow(batch, map, u, v, z, out);
    } else {
        memset(out, 0, DIP_FRAGMENT_BATCH * sizeof *out);
    }
}

// --- binding -------------------------------------------------------------------------------------

void dip_shader_guard_begin(DipShaderGuard *guard, const DipKernels *kernels, const DipPass *pass,
                            const DipPass *const *at_once, int at_once_count,
                            const float *srgb_light) {
    guard->kernels = kernels;
    guard->pass = pass;
    guard->at_once = at_once;
    guard->at_once_count = at_once_count;
    guard->srgb_light = srgb_light;
    guard->fault.code = DIP_ERROR_NONE;
}

static uint32_t first_bits(int count) {
    return (1u << count) - 1;
}

// Sets to 0 what earlier draws left in varyings that this batch does not have. Most draws of a pass
// have the same varyings, so that there is nothing to do.
static void clear_others(DipShaderGuard *guard, DipFragmentBatch *batch) {
    const uint32_t values = first_bits(guard->varying_count);
    const uint32_t derivatives = first_bits(guard->derivative_count);
    for (uint32_t left = guard->written_values & ~values; left; left &= left - 1) {
        const int s = __builtin_ctz(left);
        memset(batch->varying[s], 0, sizeof batch->varying[s]);
    }
    for (uint32_t left = guard->written_derivatives & ~derivatives; left; left &= left - 1) {
        const int s = __builtin_ctz(left);
        memset(batch->varying_dx[s], 0, sizeof batch->varying_dx[s]);
        memset(batch->varying_dy[s], 0, sizeof batch->varying_dy[s]);
    }
    const uint32_t own = first_bits(DIP_MAX_VARYINGS) &
                         ~first_bits(DIP_MAX_VARYINGS - guard->draw->computed_varying_count);
    guard->written_values = values | own;
    guard->written_derivatives = derivatives | own;
}

// Sets to 0 what the shader may leave unset, as far as it may be read (shader.h).
static void clear_outputs(DipFragmentBatch *batch) {
    const size_t count =
        (size_t)(batch->count + DIP_BATCH_ALIGN - 1) / DIP_BATCH_ALIGN * DIP_BATCH_ALIGN;
    for (int c = 0; c < 3; c++) {
        memset(batch->colour[c], 0, count * sizeof *batch->colour[c]);
    }
    memset(batch->keep, 0, count * sizeof *batch->keep);
}

void dip_shader_guard_bind(DipShaderGuard *guard, uint32_t draw, int varying_count,
                           int derivative_count, DipFragmentBatch *batch) {
    static const DipSampler no_samplers[DIP_MAX_SAMPLERS];
    guard->draw = &guard->pass->draws[draw];
    guard->draw_index = draw;
    guard->varying_count = varying_count;
    guard->derivative_count = derivative_count;
    clear_others(guard, batch);
    clear_outputs(batch);
    batch->samplers = guard->draw->samplers ? guard->draw->samplers : no_samplers;
    batch->uniforms = guard->draw->uniforms;
    batch->sample_colour = sample_colour;
    batch->sample_colours = sample_colours;
    batch->sample_alpha = sample_alpha;
    batch->sample_alpha_slope = sample_alpha_slope;
    batch->sample_target = sample_target;
    batch->sample_shadow = sample_shadow;
    batch->srgb_light = guard->srgb_light;
    batch->guard = guard;
}
