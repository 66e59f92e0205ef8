// What shaders call, behind checks: a read that the draw does not allow gives 0 and is reported by
// name, since a wrong read would otherwise show what an earlier batch left in memory.
#ifndef DIP_RENDERER_PIPELINE_RUN_SHADER_GUARD_H
#define DIP_RENDERER_PIPELINE_RUN_SHADER_GUARD_H

#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/pipeline.h"

// The checks of one batch's reads, and the varyings that its arrays hold.
typedef struct DipShaderGuard {
    const DipKernels *kernels;
    const DipPass *pass;
    const DipPass *const *at_once; // the passes that are drawn at once, `pass` among them
    int at_once_count;
    const float *srgb_light;
    const DipDraw *draw;
    uint32_t draw_index;
    int varying_count;    // varyings of the current batch
    int derivative_count; // the first of them, which have derivatives
    // Bit s: varying s, or its derivatives, may hold numbers other than 0.
    uint32_t written_values;
    uint32_t written_derivatives;
    // The fault of the pass's earliest draw that has one. Its code is DIP_ERROR_NONE if none has.
    DipError fault;
    uint32_t fault_draw;
} DipShaderGuard;

// Forgets the faults of earlier passes. at_once: the passes that are drawn at once, this one among
// them; borrowed until the next call.
void dip_shader_guard_begin(DipShaderGuard *guard, const DipKernels *kernels, const DipPass *pass,
                            const DipPass *const *at_once, int at_once_count,
                            const float *srgb_light);

// Binds a batch to a draw: its uniforms, samplers and functions. The first varying_count varyings
// have been interpolated, derivative_count of them with derivatives. Sets to 0 what the shader may
// read or leave unset: other varyings and derivatives, colours, and the marks of clip shaders.
void dip_shader_guard_bind(DipShaderGuard *guard, uint32_t draw, int varying_count,
                           int derivative_count, DipFragmentBatch *batch);

// Copies the earlier of two faults to *fault. Which fault is the earlier one does not depend on the
// order of the calls.
void dip_shader_guard_collect(const DipShaderGuard *guard, DipError *fault, uint32_t *fault_draw);

#endif
