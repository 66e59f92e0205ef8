// Draw state: how a draw's fragments are merged with the colours, depths and stencil values that
// are already there.
//
// A draw whose state is NULL or all 0 is *plain*: it is opaque, the nearest surface is shown, and
// solid triangles are filled. Any other state makes a draw *ordered*. Ordered draws take effect in
// submission order, triangle by triangle, in every sample. Plain draws before an ordered draw are
// finished first. Plain draws after it are drawn after it: where they are nearer than the depths
// there, they cover its colours, also those of blended draws that keep the depths behind them. The
// pipeline sorts nothing. The order is the caller's, and the picture is the same for any number of
// threads.
//
// Colours are merged in linear light, in 32-bit floats: blending computes the two products and
// their sum with one rounding each. With targets of 8 bits per channel, the shader's colour is
// clamped to 0..1 before blending, and the result is clamped after it. Targets of floats clamp
// nothing.
#ifndef DIP_RENDERER_PIPELINE_STATE_H
#define DIP_RENDERER_PIPELINE_STATE_H

#include "renderer/base/api.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Comparisons of integers or depths, as "left operand FUNCTION right operand".
typedef enum DipCompare {
    DIP_COMPARE_ALWAYS,
    DIP_COMPARE_NEVER,
    DIP_COMPARE_LESS,
    DIP_COMPARE_LESS_OR_EQUAL,
    DIP_COMPARE_EQUAL,
    DIP_COMPARE_NOT_EQUAL,
    DIP_COMPARE_GREATER_OR_EQUAL,
    DIP_COMPARE_GREATER,
} DipCompare;

// --- blending ------------------------------------------------------------------------------------

// A factor of the blend equation. In the equation for alpha, a colour stands for its alpha, and
// DIP_BLEND_SOURCE_ALPHA_SATURATED is 1.
typedef enum DipBlendFactor {
    DIP_BLEND_ZERO,
    DIP_BLEND_ONE,
    DIP_BLEND_SOURCE_COLOUR, // the colour that the fragment shader wrote
    DIP_BLEND_ONE_MINUS_SOURCE_COLOUR,
    DIP_BLEND_TARGET_COLOUR, // the colour that the target holds
    DIP_BLEND_ONE_MINUS_TARGET_COLOUR,
    DIP_BLEND_SOURCE_ALPHA,
    DIP_BLEND_ONE_MINUS_SOURCE_ALPHA,
    DIP_BLEND_TARGET_ALPHA,
    DIP_BLEND_ONE_MINUS_TARGET_ALPHA,
    DIP_BLEND_CONSTANT, // DipBlend.constant
    DIP_BLEND_ONE_MINUS_CONSTANT,
    DIP_BLEND_SOURCE_ALPHA_SATURATED, // min(source alpha, 1 - target alpha)
    DIP_BLEND_FACTOR_COUNT
} DipBlendFactor;

// s is the source's value times its factor, t the target's value times its factor.
typedef enum DipBlendOp {
    DIP_BLEND_ADD,              // s + t
    DIP_BLEND_SUBTRACT,         // s - t
    DIP_BLEND_REVERSE_SUBTRACT, // t - s
    DIP_BLEND_MIN,              // the smaller of both values, without their factors
    DIP_BLEND_MAX,              // the greater of both values, without their factors
    DIP_BLEND_OP_COUNT
} DipBlendOp;

typedef struct DipBlendEquation {
    DipBlendFactor source;
    DipBlendFactor target;
    DipBlendOp op;
} DipBlendEquation;

// Blending. If it is not enabled, the source replaces the target. If it is enabled, both equations
// must be set: an equation that is all 0 gives 0, and if both are all 0, the draw is refused.
typedef struct DipBlend {
    bool enabled;
    DipBlendEquation colour;
    DipBlendEquation alpha;
    float constant[4]; // red, green, blue and alpha of DIP_BLEND_CONSTANT; finite
} DipBlend;

// Initialisers of DipBlend for common modes. s is the source's colour, a its alpha, t the target's
// colour. The source's alpha replaces the target's in all of them but the last.
// clang-format off
#define DIP_BLEND_ALPHA_IS_SOURCE {DIP_BLEND_ONE, DIP_BLEND_ZERO, DIP_BLEND_ADD}
// s a + t (1 - a)
#define DIP_BLEND_MODE_ALPHA                                                                       \
    {true, {DIP_BLEND_SOURCE_ALPHA, DIP_BLEND_ONE_MINUS_SOURCE_ALPHA, DIP_BLEND_ADD},              \
     DIP_BLEND_ALPHA_IS_SOURCE, {0, 0, 0, 0}}
// s a + t
#define DIP_BLEND_MODE_ADDITIVE                                                                    \
    {true, {DIP_BLEND_SOURCE_ALPHA, DIP_BLEND_ONE, DIP_BLEND_ADD},                                 \
     DIP_BLEND_ALPHA_IS_SOURCE, {0, 0, 0, 0}}
// s t
#define DIP_BLEND_MODE_MULTIPLICATIVE                                                              \
    {true, {DIP_BLEND_ZERO, DIP_BLEND_SOURCE_COLOUR, DIP_BLEND_ADD},                               \
     DIP_BLEND_ALPHA_IS_SOURCE, {0, 0, 0, 0}}
// 2 s t
#define DIP_BLEND_MODE_DOUBLE_MULTIPLICATIVE                                                       \
    {true, {DIP_BLEND_TARGET_COLOUR, DIP_BLEND_SOURCE_COLOUR, DIP_BLEND_ADD},                      \
     DIP_BLEND_ALPHA_IS_SOURCE, {0, 0, 0, 0}}
// s + t (1 - a), for colours that are multiplied by their alpha already. Alpha is blended in the
// same way, so that a picture that begins transparent ends as such a layer itself. With s = 0 it
// darkens, with a = 0 it adds light.
#define DIP_BLEND_MODE_PREMULTIPLIED                                                               \
    {true, {DIP_BLEND_ONE, DIP_BLEND_ONE_MINUS_SOURCE_ALPHA, DIP_BLEND_ADD},                       \
     {DIP_BLEND_ONE, DIP_BLEND_ONE_MINUS_SOURCE_ALPHA, DIP_BLEND_ADD}, {0, 0, 0, 0}}
// clang-format on

// Channels that a draw leaves as they are (DipDrawState.kept_channels).
enum { DIP_CHANNEL_RED = 1, DIP_CHANNEL_GREEN = 2, DIP_CHANNEL_BLUE = 4, DIP_CHANNEL_ALPHA = 8 };

// --- depth ---------------------------------------------------------------------------------------

// A sample passes the depth test if its fragment is, compared with the stored depth, ...
// Depth is z / w of the clip position, where the greater value is the nearer one (shader.h).
typedef enum DipDepthTest {
    DIP_DEPTH_NEARER,
    DIP_DEPTH_NEARER_OR_EQUAL,
    DIP_DEPTH_EQUAL,
    DIP_DEPTH_NOT_EQUAL,
    DIP_DEPTH_FARTHER,
    DIP_DEPTH_FARTHER_OR_EQUAL,
    DIP_DEPTH_ALWAYS,
    DIP_DEPTH_NEVER,
    DIP_DEPTH_TEST_COUNT
} DipDepthTest;

// Moves surfaces towards the eye (positive) or away from it (negative), for the depth test and for
// the depth that is stored. The depth z of a sample becomes
//     z + slope * max(|dz/dx|, |dz/dy|) + constant + relative * 2^-23 * z
// with dz/dx and dz/dy per pixel, and is then clamped to 0..1. With reversed depth, `relative`
// moves a surface by the same share of its distance everywhere: its units are units in the last
// place of the sample's own depth. `constant` moves all surfaces by the same depth, as the constant
// bias of Direct3D 9 does; OpenGL and later versions of Direct3D count it in units of their format.
// `constant` suits parallel projections, whose depths are equally coarse everywhere.
typedef struct DipDepthBias {
    float slope;
    float relative;
    float constant;
} DipDepthBias;

// --- stencil -------------------------------------------------------------------------------------

typedef enum DipStencilOp {
    DIP_STENCIL_KEEP,
    DIP_STENCIL_ZERO,
    DIP_STENCIL_REPLACE,         // by the reference
    DIP_STENCIL_INCREMENT_CLAMP, // up to 255
    DIP_STENCIL_DECREMENT_CLAMP, // down to 0
    DIP_STENCIL_INVERT,
    DIP_STENCIL_INCREMENT_WRAP,
    DIP_STENCIL_DECREMENT_WRAP,
    DIP_STENCIL_OP_COUNT
} DipStencilOp;

// A sample passes the stencil test if
//     (reference & read_mask) FUNCTION (stored value & read_mask).
typedef struct DipStencilFace {
    DipCompare function;
    DipStencilOp stencil_failed; // the stencil test failed
    DipStencilOp depth_failed;   // the stencil test passed and the depth test failed
    DipStencilOp passed;         // both passed
} DipStencilFace;

// The stencil test, which comes before the depth test. A clip shader comes before both, so what it
// cuts away changes no stencil value. An operation writes the bits of write_mask only: with a
// write_mask of 0, none. With a read_mask of 0, a test compares 0 with 0. Both are legal alone, as
// in Direct3D 9, whose masks are all ones at first; these are 0 at first. A test of which all masks
// are 0 can find and change nothing: it is refused.
typedef struct DipStencil {
    bool enabled;
    uint8_t reference;
    uint8_t read_mask;
    uint8_t write_mask;
    DipStencilFace front; // for triangles that wind counter-clockwise on the screen
    DipStencilFace back;  // for the others, such as the front faces of a mirrored object
    // If true, the three values below replace those above for back faces. If false, both faces
    // share those above.
    bool back_has_values;
    uint8_t back_reference;
    uint8_t back_read_mask;
    uint8_t back_write_mask;
} DipStencil;

// --- the state -----------------------------------------------------------------------------------

typedef enum DipFill {
    DIP_FILL_SOLID,
    // Only the parts of a triangle that lie within half of line_width of one of its edges. Edges
    // that clipping makes are not drawn; where clipping divides a triangle into several, a line
    // ends where its part ends. An edge between two triangles gets half of its line from each of
    // them; an outline therefore has half of the width.
    DIP_FILL_WIREFRAME,
    DIP_FILL_COUNT
} DipFill;

typedef struct DipDrawState {
    // Draws in submission order even if everything below is 0. The picture has the same colours, up
    // to the position at which fragments of joined triangles are shaded (patch.h).
    bool ordered;
    DipBlend blend;
    uint8_t kept_channels; // DIP_CHANNEL_* that the draw does not write
    DipDepthTest depth_test;
    bool keep_depth; // does not write depth
    DipDepthBias depth_bias;
    DipStencil stencil;
    DipFill fill;
    float line_width; // of wireframes, in pixels, 0..DIP_MAX_LINE_WIDTH; 0 means 1
    // Bit s: the draw leaves sample s of each pixel as it is, with its colour, depth and stencil
    // value. Bits of samples that the pass does not have change nothing. The position at which a
    // fragment is shaded does not depend on these bits, only on the samples that the triangle
    // covers. A fragment of which no sample can change is not shaded.
    uint8_t kept_samples;
    // The draw's shaders read which fragments lie on front faces (DipFragmentBatch.front).
    bool reads_front;
} DipDrawState;

#define DIP_MAX_LINE_WIDTH 64.0f

// Returns whether a draw with this state is ordered. state may be NULL.
DIP_API bool dip_state_is_ordered(const DipDrawState *state);

#ifdef __cplusplus
}
#endif

#endif
