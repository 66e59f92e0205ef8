// Finds a field of a pass that is wrong, and says what is accepted.
#include "renderer/pipeline/run/pass_check.h"

#include "renderer/pipeline/merge/merge_tile.h"
#include "renderer/pipeline/run/state_check.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static bool in_range(int value, int least, int most, const char *field, DipError *err) {
    return (value >= least && value <= most) ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, field, "%d, accepted %d..%d", value, least,
                         most);
}

static bool is_set(const void *pointer, const char *field, DipError *err) {
    return pointer ||
           dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, field, "NULL, accepted a pointer");
}

// Returns the bytes of a pixel in the target's memory, or 0 if it has none.
static size_t pixel_bytes(DipFormat format) {
    static const size_t bytes[DIP_FORMAT_COUNT] = {
        [DIP_FORMAT_SRGB8] = 4,
        [DIP_FORMAT_LINEAR8] = 4,
        [DIP_FORMAT_RGBA32F] = 16,
        [DIP_FORMAT_R32F] = 4,
    };
    return bytes[format];
}

static bool check_memory(const DipTarget *target, DipError *err) {
    const size_t row = pixel_bytes(target->format) * (size_t)target->width;
    if (target->stride_bytes % 4 != 0 || target->stride_bytes < row) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "target.stride_bytes",
                             "%zu, accepted multiples of 4 from %zu", target->stride_bytes, row);
    }
    return (uintptr_t)target->rgba8 % 4 == 0 ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "target.rgba8",
                         "not aligned, accepted addresses that are multiples of 4");
}

// Checks that the target has pixels, unless the pass needs none.
static bool check_pixels(const DipPass *pass, DipError *err) {
    const DipAttachments *a = &pass->attachments;
    const bool may_lack_pixels = a->samples ? a->keep_target : a->depth != NULL;
    return pass->target.rgba8 || may_lack_pixels ||
           dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "target.rgba8", "NULL, accepted %s",
                         a->samples ? "a pointer, or attachments.keep_target for a pass that keeps "
                                      "samples alone"
                                    : "a pointer, or attachments.depth for a pass without colours");
}

static bool check_target(const DipPass *pass, int width, int height, DipError *err) {
    const DipTarget *target = &pass->target;
    if (!in_range((int)target->format, 0, DIP_FORMAT_COUNT - 1, "target.format", err)) {
        return false;
    }
    if (target->format != DIP_FORMAT_CALLER && !check_pixels(pass, err)) {
        return false;
    }
    if (target->width != width || target->height != height) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "target.width",
                             "%dx%d pixels, accepted the pipeline's %dx%d", target->width,
                             target->height, width, height);
    }
    if (target->format == DIP_FORMAT_CALLER) {
        return (pass->attachments.samples && pass->attachments.keep_target) ||
               is_set((const void *)(uintptr_t)target->store, "target.store", err);
    }
    return !target->rgba8 || check_memory(target, err);
}

static bool check_samples(const DipPass *pass, DipError *err) {
    const int count = pass->sample_count;
    if (count != 1 && count != 2 && count != 4 && count != 6 && count != 8) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "sample_count",
                             "%d, accepted 1, 2, 4, 6 or 8", count);
    }
    if (!in_range((int)pass->pattern, 0, DIP_PATTERN_KINDS - 1, "pattern", err)) {
        return false;
    }
    if (!pass->samples_per_group || pass->samples_per_group == count) {
        return true;
    }
    if (pass->alpha_to_coverage) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "alpha_to_coverage",
                             "with groups of %d samples, accepted undivided samples",
                             pass->samples_per_group);
    }
    return dip_sample_groups_exist(count, pass->samples_per_group) ||
           dip_error_set(
               err, DIP_ERROR_CONFLICT, NULL, 0, "samples_per_group",
               "groups of %d out of %d samples, accepted if dip_sample_groups_exist is true",
               pass->samples_per_group, count);
}

// Checks the rectangles that are needed of each tile.
static bool check_tile_regions(const DipPass *pass, DipError *err) {
    const int across = (pass->target.width + DIP_TARGET_TILE - 1) / DIP_TARGET_TILE;
    const int down = (pass->target.height + DIP_TARGET_TILE - 1) / DIP_TARGET_TILE;
    for (int i = 0; pass->tile_regions && i < across * down; i++) {
        const DipTileRegion *r = &pass->tile_regions[i];
        const int bits = r->x0 | r->y0 | r->x1 | r->y1;
        if (bits && (bits % 8 != 0 || r->x0 >= r->x1 || r->x1 > DIP_TARGET_TILE || r->y0 >= r->y1 ||
                     r->y1 > DIP_TARGET_TILE)) {
            return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "tile_regions",
                                 "x %d..%d, y %d..%d of tile %d, accepted multiples of 8 that make "
                                 "a rectangle within 64x64 pixels, or all 0",
                                 r->x0, r->x1, r->y0, r->y1, i);
        }
    }
    return true;
}

// shades: the pass has colours, so that the draw needs a fragment shader.
static bool check_draw(const DipDraw *draw, bool shades, DipError *err) {
    return is_set(draw->mesh, "draws.mesh", err) &&
           is_set((const void *)(uintptr_t)draw->vertex_shader, "draws.vertex_shader", err) &&
           (!shades ||
            is_set((const void *)(uintptr_t)draw->fragment_shader, "draws.fragment_shader", err)) &&
           in_range(draw->varying_count, 0, DIP_MAX_VARYINGS, "draws.varying_count", err) &&
           in_range(draw->clip_varying_count, 0, draw->varying_count, "draws.clip_varying_count",
                    err) &&
           in_range(draw->value_only_varying_count, 0, draw->varying_count,
                    "draws.value_only_varying_count", err) &&
           in_range(draw->computed_varying_count, 0, DIP_MAX_VARYINGS - draw->varying_count,
                    "draws.computed_varying_count", err) &&
           in_range((int)draw->cull, DIP_CULL_NONE, DIP_CULL_FRONT, "draws.cull", err) &&
           dip_state_check(draw->state, err);
}

// Puts the draw's index into the key of its error: "draws[7].mesh" in place of "draws.mesh".
// Returns false.
static bool name_draw(int index, DipError *err) {
    if (err) {
        char key[sizeof err->key + 16];
        snprintf(key, sizeof key, "draws[%d]%s", index, err->key + sizeof "draws" - 1);
        memcpy(err->key, key, sizeof err->key);
        err->key[sizeof err->key - 1] = '\0';
    }
    return false;
}

static bool check_clear(const float clear_lin[3], DipError *err) {
    for (int c = 0; c < 3; c++) {
        if (isnan(clear_lin[c])) {
            return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "clear_lin",
                                 "NaN, accepted numbers");
        }
    }
    return true;
}

// Checks everything but the rule that a pass with a readback is not merged.
static bool check_readback(const DipSampleReadback *readback, const DipTarget *target,
                           DipError *err) {
    if (!readback) {
        return true;
    }
    const DipTargetRegion *region = &readback->region;
    if (region->x0 >= region->x1 || region->y0 >= region->y1) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "readback.region",
                             "it is empty, accepted a rectangle of at least one pixel");
    }
    return dip_rectangle_check(region, target, "readback.region", err) &&
           is_set(readback->samples, "readback.samples", err);
}

bool dip_pass_check_draws(const DipPass *pass, DipError *err) {
    if (!in_range(pass->draw_count, 0, INT32_MAX, "draw_count", err) ||
        (pass->draw_count && !is_set(pass->draws, "draws", err))) {
        return false;
    }
    for (int d = 0; d < pass->draw_count; d++) {
        if (!check_draw(&pass->draws[d], dip_pass_has_colours(pass), err)) {
            return name_draw(d, err);
        }
    }
    return true;
}

bool dip_pass_check(const DipPass *pass, int width, int height, DipError *err) {
    return is_set(pass, "pass", err) && check_target(pass, width, height, err) &&
           dip_rectangle_check(&pass->region, &pass->target, "region", err) &&
           check_tile_regions(pass, err) &&
           dip_rectangle_check(&pass->viewport, &pass->target, "viewport", err) &&
           dip_rectangle_check(&pass->scissor, &pass->target, "scissor", err) &&
           check_samples(pass, err) && check_clear(pass->clear_lin, err) &&
           dip_attachments_check(pass, err) &&
           in_range(pass->clip_plane_count, 0, DIP_MAX_CLIP_PLANES, "clip_plane_count", err) &&
           check_readback(pass->readback, &pass->target, err) && dip_pass_check_draws(pass, err) &&
           (!pass->readback || !dip_pass_is_merged(pass) ||
            dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "readback",
                          "the pass is merged, accepted a pass of plain draws into sRGB bytes"));
}
