// Blends shaded fragments into the colours of a tile's samples, compiled once per instruction set.
// Each blend is two products and a sum, each rounded once, so every instruction set gives the same
// bits.
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/simd/vec.h"

enum { VECTORS = DIP_SUB_BLOCK_PIXELS / DIP_LANES, CHANNELS = 4, ALPHA = 3 };

typedef struct Colour {
    Vf channel[CHANNELS];
} Colour;

// The colours of a sub-block's fragments. Pixels without a fragment have any colour.
typedef struct Source {
    float channel[CHANNELS][DIP_SUB_BLOCK_PIXELS];
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

// Blends one vector of one sample's colours. first: index of the vector's first value.
VEC_INLINE void blend_vector(DipTileColours *colours, const DipDrawState *state,
                             const Source *source, int v, int first, unsigned bits) {
    const Mask mask = mask_from_bits(bits);
    Colour s;
    Colour t;
    for (int c = 0; c < CHANNELS; c++) {
        s.channel[c] = vf_load(source->channel[c] + v * DIP_LANES);
        t.channel[c] = vf_load(colours->channel[c] + first);
    }
    for (int c = 0; c < CHANNELS; c++) {
        if (state->kept_channels >> c & 1) {
            continue;
        }
        Vf result = state->blend.enabled ? blend_channel(&state->blend, &s, &t, c) : s.channel[c];
        if (colours->clamps) {
            result = clamped(result);
        }
        vf_store_lanes(colours->channel[c] + first, mask, result, t.channel[c]);
    }
}

static void blend_sample(DipTileColours *colours, const DipDrawState *state, const Source *source,
                         int first, unsigned pixels) {
    for (int v = 0; v < VECTORS; v++) {
        const unsigned bits = pixels >> (v * DIP_LANES) & VEC_ALL_LANES;
        if (bits) {
            blend_vector(colours, state, source, v, first + v * DIP_LANES, bits);
        }
    }
}

// Spreads the batch's next colours to the pixels of a sub-block. Returns their number.
static int spread(const DipFragmentBatch *batch, int at, unsigned pixels, bool clamps,
                  Source *source) {
    const float *from[CHANNELS] = {batch->colour[0], batch->colour[1], batch->colour[2],
                                   batch->alpha};
    const int count = __builtin_popcount(pixels);
    for (int c = 0; c < CHANNELS; c++) {
        const float *next = from[c] + at;
        if (count == DIP_SUB_BLOCK_PIXELS) {
            memcpy(source->channel[c], next, sizeof source->channel[c]);
        } else {
            memset(source->channel[c], 0, sizeof source->channel[c]);
            for (unsigned left = pixels; left; left &= left - 1) {
                source->channel[c][__builtin_ctz(left)] = *next++;
            }
        }
        for (int i = 0; clamps && i < DIP_SUB_BLOCK_PIXELS; i += DIP_LANES) {
            vf_store(source->channel[c] + i, clamped(vf_load(source->channel[c] + i)));
        }
    }
    return count;
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

void DIP_KERNEL(dip_kernel_blend)(DipTileColours *colours, const DipOrdered *ordered,
                                  const DipFragmentBatch *batch) {
    const int sample_count = colours->sample_count;
    int at = 0;
    for (int i = 0; i < ordered->count; i++) {
        const DipOrderedSubBlock *sub_block = &ordered->waiting[i];
        const int number = dip_sub_block_number(sub_block->first, sample_count);
        Source source;
        at += spread(batch, at, sub_block->pixels, colours->clamps, &source);
        if (!dip_is_split(colours, number)) {
            if (is_uniform(sub_block, sample_count)) {
                blend_sample(colours, ordered->state, &source, sub_block->first,
                             sub_block->visible[0]);
                continue;
            }
            dip_split(colours, number);
        }
        for (int s = 0; s < sample_count; s++) {
            blend_sample(colours, ordered->state, &source, sub_block->first + s * DIP_BLOCK_PIXELS,
                         sub_block->visible[s]);
        }
    }
}
