// Blends shaded fragments into the colours of a tile's samples, compiled once per instruction set.
// Each blend is two products and a sum, each rounded once, so every instruction set gives the same
// bits.
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/merge/ordered.h"
#include "renderer/simd/vec.h"

enum { VECTORS = DIP_SUB_BLOCK_PIXELS / DIP_LANES, CHANNELS = 4, ALPHA = 3 };

typedef struct Colour {
    Vf channel[CHANNELS];
} Colour;

// The colours of a sub-block's fragments, spread to its pixels. Pixels without a fragment have any
// colour.
typedef struct Spread {
    float channel[CHANNELS][DIP_SUB_BLOCK_PIXELS];
} Spread;

// The colours of a sub-block's 16 pixels: of a Spread, or of the batch if all pixels have a
// fragment.
typedef struct Source {
    const float *channel[CHANNELS];
} Source;

VEC_INLINE Vf one_minus(Vf v) {
    return 1.0f - v;
}

// Returns the factor of one channel. s and t: the source's and the target's colour.
VEC_INLINE Vf factor_of(DipBlendFactor factor, const Colour *s, const Colour *t, int channel,
                        float constant) {
    switch (factor) {
    case DIP_BLEND_ONE:
        return vf_splat(1.0f);
    case DIP_BLEND_SOURCE_COLOUR:
        return s->channel[channel];
    case DIP_BLEND_ONE_MINUS_SOURCE_COLOUR:
        return one_minus(s->channel[channel]);
    case DIP_BLEND_TARGET_COLOUR:
        return t->channel[channel];
    case DIP_BLEND_ONE_MINUS_TARGET_COLOUR:
        return one_minus(t->channel[channel]);
    case DIP_BLEND_SOURCE_ALPHA:
        return s->channel[ALPHA];
    case DIP_BLEND_ONE_MINUS_SOURCE_ALPHA:
        return one_minus(s->channel[ALPHA]);
    case DIP_BLEND_TARGET_ALPHA:
        return t->channel[ALPHA];
    case DIP_BLEND_ONE_MINUS_TARGET_ALPHA:
        return one_minus(t->channel[ALPHA]);
    case DIP_BLEND_CONSTANT:
        return vf_splat(constant);
    case DIP_BLEND_ONE_MINUS_CONSTANT:
        return vf_splat(1.0f - constant);
    case DIP_BLEND_SOURCE_ALPHA_SATURATED:
        return channel == ALPHA ? vf_splat(1.0f)
                                : vf_min(s->channel[ALPHA], one_minus(t->channel[ALPHA]));
    case DIP_BLEND_ZERO:
    case DIP_BLEND_FACTOR_COUNT:
        break;
    }
    return vf_splat(0.0f);
}

VEC_INLINE Vf blend_channel(const DipBlend *blend, const Colour *s, const Colour *t, int channel) {
    const DipBlendEquation *equation = channel == ALPHA ? &blend->alpha : &blend->colour;
    const Vf source = s->channel[channel];
    const Vf target = t->channel[channel];
    if (equation->op == DIP_BLEND_MIN) {
        return vf_min(source, target);
    }
    if (equation->op == DIP_BLEND_MAX) {
        return vf_max(source, target);
    }
    const float constant = blend->constant[channel];
    const Vf a = source * factor_of(equation->source, s, t, channel, constant);
    const Vf b = target * factor_of(equation->target, s, t, channel, constant);
    return equation->op == DIP_BLEND_SUBTRACT           ? a - b
           : equation->op == DIP_BLEND_REVERSE_SUBTRACT ? b - a
                                                        : a + b;
}

// Returns v within 0..1; a NaN becomes 0.
VEC_INLINE Vf clamped(Vf v) {
    return vf_min(vf_max(v, vf_splat(0.0f)), vf_splat(1.0f));
}

// How a draw's fragments change the colours.
typedef struct Blending {
    const DipBlend *blend;
    unsigned kept_channels;
    bool clamps;
} Blending;

// Blends one vector of one sample's colours. first: index of the vector's first value.
VEC_INLINE void blend_vector(DipTileColours *colours, const Blending *how, const Source *source,
                             int v, int first, unsigned bits) {
    const Mask mask = mask_from_bits(bits);
    Colour s;
    Colour t;
#pragma GCC unroll 4
    for (int c = 0; c < CHANNELS; c++) {
        const Vf from = vf_load(source->channel[c] + v * DIP_LANES);
        s.channel[c] = how->clamps ? clamped(from) : from;
        t.channel[c] = vf_load(colours->channel[c] + first);
    }
#pragma GCC unroll 4
    for (int c = 0; c < CHANNELS; c++) {
        if (how->kept_channels >> c & 1) {
            continue;
        }
        Vf result = s.channel[c];
        if (how->blend->enabled) {
            result = blend_channel(how->blend, &s, &t, c);
            result = how->clamps ? clamped(result) : result;
        }
        vf_store_lanes(colours->channel[c] + first, mask, result, t.channel[c]);
    }
}

VEC_INLINE void blend_sample(DipTileColours *colours, const Blending *how, const Source *source,
                             int first, unsigned pixels) {
    for (int v = 0; v < VECTORS; v++) {
        const unsigned bits = pixels >> (v * DIP_LANES) & VEC_ALL_LANES;
        if (bits) {
            blend_vector(colours, how, source, v, first + v * DIP_LANES, bits);
        }
    }
}

// Spreads the colours of a sub-block's fragments, `from`, to their pixels.
VEC_INLINE void spread(const Source *from, unsigned pixels, Spread *to) {
    int at = 0;
    for (int v = 0; v < VECTORS; v++) {
        const unsigned bits = pixels >> (v * DIP_LANES) & VEC_ALL_LANES;
        for (int c = 0; c < CHANNELS; c++) {
            vf_store(to->channel[c] + v * DIP_LANES, vf_expand(from->channel[c] + at, bits));
        }
        at += __builtin_popcount(bits);
    }
}

// Whether every pixel of a sub-block shows its fragment in all samples or in none.
static bool is_uniform(const DipOrderedSubBlock *sub_block, int sample_count) {
    for (int s = 1; s < sample_count; s++) {
        if (sub_block->visible[s] != sub_block->visible[0]) {
            return false;
        }
    }
    return true;
}

// Blends the colours of one sub-block, whose fragments begin at index `at` of the batch.
VEC_INLINE void blend_sub_block(DipTileColours *colours, const Blending *how,
                                const DipOrderedSubBlock *sub_block, const DipFragmentBatch *batch,
                                int at) {
    const int sample_count = colours->sample_count;
    Spread pixels;
    Source source = {
        {batch->colour[0] + at, batch->colour[1] + at, batch->colour[2] + at, batch->alpha + at}};
    if (sub_block->pixels != 0xffff) {
        spread(&source, sub_block->pixels, &pixels);
        for (int c = 0; c < CHANNELS; c++) {
            source.channel[c] = pixels.channel[c];
        }
    }
    if (sample_count == 1) {
        blend_sample(colours, how, &source, sub_block->first, sub_block->visible[0]);
        return;
    }
    if (!dip_is_split(colours, sub_block->number)) {
        if (is_uniform(sub_block, sample_count)) {
            blend_sample(colours, how, &source, sub_block->first, sub_block->visible[0]);
            return;
        }
        dip_split(colours, sub_block->number);
    }
    for (int s = 0; s < sample_count; s++) {
        blend_sample(colours, how, &source, sub_block->first + s * DIP_BLOCK_PIXELS,
                     sub_block->visible[s]);
    }
}

VEC_INLINE void blend_batch(DipTileColours *colours, const Blending *how,
                            const DipOrderedBatch *ordered, const DipFragmentBatch *batch) {
    int at = 0;
    for (int i = 0; i < ordered->count; i++) {
        const DipOrderedSubBlock *sub_block = &ordered->waiting[i];
        blend_sub_block(colours, how, sub_block, batch, at);
        at += __builtin_popcount(sub_block->pixels);
    }
}

static bool same_equation(const DipBlendEquation *a, const DipBlendEquation *b) {
    return a->source == b->source && a->target == b->target && a->op == b->op;
}

// Blends with a mode that the compiler knows, if the draw has it. Returns whether it has.
VEC_INLINE bool blend_as(const DipBlend *mode, DipTileColours *colours, const DipDrawState *state,
                         const DipOrderedBatch *ordered, const DipFragmentBatch *batch) {
    const DipBlend *blend = &state->blend;
    if (state->kept_channels || blend->enabled != mode->enabled ||
        (mode->enabled && !(same_equation(&blend->colour, &mode->colour) &&
                            same_equation(&blend->alpha, &mode->alpha)))) {
        return false;
    }
    const Blending clamping = {mode, 0, true};
    const Blending free_range = {mode, 0, false};
    if (colours->clamps) {
        blend_batch(colours, &clamping, ordered, batch);
    } else {
        blend_batch(colours, &free_range, ordered, batch);
    }
    return true;
}

void DIP_KERNEL(dip_kernel_blend)(DipTileColours *colours, const DipDrawState *state,
                                  const DipOrderedBatch *ordered, const DipFragmentBatch *batch) {
    static const DipBlend none = {0};
    static const DipBlend alpha = DIP_BLEND_MODE_ALPHA;
    static const DipBlend additive = DIP_BLEND_MODE_ADDITIVE;
    static const DipBlend multiplicative = DIP_BLEND_MODE_MULTIPLICATIVE;
    static const DipBlend double_multiplicative = DIP_BLEND_MODE_DOUBLE_MULTIPLICATIVE;
    if (blend_as(&none, colours, state, ordered, batch) ||
        blend_as(&alpha, colours, state, ordered, batch) ||
        blend_as(&additive, colours, state, ordered, batch) ||
        blend_as(&multiplicative, colours, state, ordered, batch) ||
        blend_as(&double_multiplicative, colours, state, ordered, batch)) {
        return;
    }
    const Blending how = {&state->blend, state->kept_channels, colours->clamps};
    blend_batch(colours, &how, ordered, batch);
}
