// Finds a field of a draw state or attachment that is wrong, and says what is accepted.
#include "renderer/pipeline/run/state_check.h"

#include <math.h>

static bool in_range(int value, int least, int most, const char *field, DipError *err) {
    return (value >= least && value <= most) ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, field, "%d, accepted %d..%d", value, least,
                         most);
}

static bool is_finite(float value, const char *field, DipError *err) {
    return isfinite(value) || dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, field,
                                            "%g, accepted finite numbers", (double)value);
}

static bool check_equation(const DipBlendEquation *equation, const char *field, DipError *err) {
    return in_range((int)equation->source, 0, DIP_BLEND_FACTOR_COUNT - 1, field, err) &&
           in_range((int)equation->target, 0, DIP_BLEND_FACTOR_COUNT - 1, field, err) &&
           in_range((int)equation->op, 0, DIP_BLEND_OP_COUNT - 1, field, err);
}

// Whether an equation has not been set, or gives 0.
static bool is_zero(const DipBlendEquation *equation) {
    return equation->source == DIP_BLEND_ZERO && equation->target == DIP_BLEND_ZERO &&
           equation->op == DIP_BLEND_ADD;
}

static bool check_blend(const DipBlend *blend, DipError *err) {
    for (int c = 0; c < 4; c++) {
        if (!is_finite(blend->constant[c], "draws.state.blend.constant", err)) {
            return false;
        }
    }
    if (blend->enabled && is_zero(&blend->colour) && is_zero(&blend->alpha)) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "draws.state.blend.colour",
                             "blending without equations, accepted a mode such as "
                             "DIP_BLEND_MODE_ALPHA, or equations of your own");
    }
    return check_equation(&blend->colour, "draws.state.blend.colour", err) &&
           check_equation(&blend->alpha, "draws.state.blend.alpha", err);
}

static bool check_face(const DipStencilFace *face, const char *field, DipError *err) {
    return in_range((int)face->function, 0, DIP_COMPARE_GREATER, field, err) &&
           in_range((int)face->stencil_failed, 0, DIP_STENCIL_OP_COUNT - 1, field, err) &&
           in_range((int)face->depth_failed, 0, DIP_STENCIL_OP_COUNT - 1, field, err) &&
           in_range((int)face->passed, 0, DIP_STENCIL_OP_COUNT - 1, field, err);
}

// Checks that the stencil test can find or change something.
static bool check_masks(const DipStencil *stencil, DipError *err) {
    const bool back_has_masks =
        stencil->back_has_values && (stencil->back_read_mask || stencil->back_write_mask);
    return !stencil->enabled || stencil->read_mask || stencil->write_mask || back_has_masks ||
           dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "draws.state.stencil.read_mask",
                         "all masks of the test are 0, accepted a read_mask or write_mask above 0");
}

static bool check_line_width(float width, DipError *err) {
    return (width >= 0.0f && width <= DIP_MAX_LINE_WIDTH) ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "draws.state.line_width",
                         "%g pixels, accepted 0..%g", (double)width, (double)DIP_MAX_LINE_WIDTH);
}

bool dip_state_check(const DipDrawState *state, DipError *err) {
    enum { ALL_CHANNELS = 15 };
    return !state ||
           (check_blend(&state->blend, err) &&
            in_range(state->kept_channels, 0, ALL_CHANNELS, "draws.state.kept_channels", err) &&
            in_range((int)state->depth_test, 0, DIP_DEPTH_TEST_COUNT - 1, "draws.state.depth_test",
                     err) &&
            is_finite(state->depth_bias.slope, "draws.state.depth_bias.slope", err) &&
            is_finite(state->depth_bias.relative, "draws.state.depth_bias.relative", err) &&
            is_finite(state->depth_bias.constant, "draws.state.depth_bias.constant", err) &&
            check_face(&state->stencil.front, "draws.state.stencil.front", err) &&
            check_face(&state->stencil.back, "draws.state.stencil.back", err) &&
            check_masks(&state->stencil, err) &&
            in_range((int)state->fill, 0, DIP_FILL_COUNT - 1, "draws.state.fill", err) &&
            check_line_width(state->line_width, err));
}

static bool check_depth(const DipPass *pass, DipError *err) {
    const DipAttachments *a = &pass->attachments;
    const DipDepth *depth = a->depth;
    if (!depth) {
        return (a->depth_load != DIP_LOAD_KEEP && a->stencil_load != DIP_LOAD_KEEP) ||
               dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "attachments.depth",
                             "NULL, accepted depths if the pass keeps earlier depths or stencil "
                             "values (DIP_LOAD_KEEP)");
    }
    const int width = dip_depth_width(depth);
    const int height = dip_depth_height(depth);
    if (width != pass->target.width || height != pass->target.height) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "attachments.depth",
                             "%dx%d pixels, accepted the target's %dx%d", width, height,
                             pass->target.width, pass->target.height);
    }
    return dip_depth_sample_count(depth) == pass->sample_count ||
           dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "attachments.depth",
                         "%d samples per pixel, accepted the pass's %d",
                         dip_depth_sample_count(depth), pass->sample_count);
}

static const char *format_name(DipFormat format) {
    static const char *const names[DIP_FORMAT_COUNT] = {
        [DIP_FORMAT_SRGB8] = "DIP_FORMAT_SRGB8",     [DIP_FORMAT_LINEAR8] = "DIP_FORMAT_LINEAR8",
        [DIP_FORMAT_RGBA32F] = "DIP_FORMAT_RGBA32F", [DIP_FORMAT_R32F] = "DIP_FORMAT_R32F",
        [DIP_FORMAT_CALLER] = "DIP_FORMAT_CALLER",
    };
    return names[format];
}

// Checks the samples that outlive the pass.
static bool check_samples(const DipPass *pass, DipError *err) {
    const DipSamples *samples = pass->attachments.samples;
    if (!samples) {
        return !pass->attachments.keep_target ||
               dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "attachments.samples",
                             "NULL, accepted samples if the pass keeps its target");
    }
    const int width = dip_samples_width(samples);
    const int height = dip_samples_height(samples);
    if (width != pass->target.width || height != pass->target.height) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "attachments.samples",
                             "%dx%d pixels, accepted the target's %dx%d", width, height,
                             pass->target.width, pass->target.height);
    }
    if (dip_samples_sample_count(samples) != pass->sample_count) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "attachments.samples",
                             "%d samples per pixel, accepted the pass's %d",
                             dip_samples_sample_count(samples), pass->sample_count);
    }
    return dip_samples_format(samples) == pass->target.format ||
           dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "attachments.samples",
                         "samples for targets of %s, accepted the target's %s",
                         format_name(dip_samples_format(samples)),
                         format_name(pass->target.format));
}

bool dip_attachments_check(const DipPass *pass, DipError *err) {
    const DipAttachments *a = &pass->attachments;
    const bool keeps_caller = pass->target.format == DIP_FORMAT_CALLER &&
                              a->colour_load == DIP_LOAD_KEEP && !a->samples && !pass->target.load;
    if (keeps_caller) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "target.load",
                             "NULL, accepted a function if the pass keeps the target's colours");
    }
    if (!(a->clear_depth >= 0.0f && a->clear_depth <= 1.0f)) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "attachments.clear_depth",
                             "%g, accepted 0..1", (double)a->clear_depth);
    }
    return in_range((int)a->colour_load, 0, DIP_LOAD_DISCARD, "attachments.colour_load", err) &&
           in_range((int)a->depth_load, 0, DIP_LOAD_DISCARD, "attachments.depth_load", err) &&
           in_range((int)a->stencil_load, 0, DIP_LOAD_DISCARD, "attachments.stencil_load", err) &&
           in_range((int)a->colour_store, 0, DIP_STORE_REVERT, "attachments.colour_store", err) &&
           in_range((int)a->depth_store, 0, DIP_STORE_REVERT, "attachments.depth_store", err) &&
           in_range((int)a->stencil_store, 0, DIP_STORE_REVERT, "attachments.stencil_store", err) &&
           check_depth(pass, err) && check_samples(pass, err);
}

bool dip_rectangle_check(const DipTargetRegion *rectangle, const DipTarget *target,
                         const char *field, DipError *err) {
    if (!rectangle->x0 && !rectangle->y0 && !rectangle->x1 && !rectangle->y1) {
        return true;
    }
    return (rectangle->x0 >= 0 && rectangle->x0 < rectangle->x1 && rectangle->x1 <= target->width &&
            rectangle->y0 >= 0 && rectangle->y0 < rectangle->y1 &&
            rectangle->y1 <= target->height) ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, field,
                         "x %d..%d, y %d..%d, accepted a rectangle within %dx%d pixels",
                         rectangle->x0, rectangle->x1, rectangle->y0, rectangle->y1, target->width,
                         target->height);
}
