// Finds a field of a pass that is wrong, and says what is accepted.
#include "renderer/pipeline/run/pass_check.h"

#include <stdarg.h>
#include <stdio.h>

static bool in_range(int value, int least, int most, const char *field, DipError *err) {
    return (value >= least && value <= most) ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, field, "%d, accepted %d..%d", value, least,
                         most);
}

static bool is_set(const void *pointer, const char *field, DipError *err) {
    return pointer ||
           dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, field, "NULL, accepted a pointer");
}

static bool check_target(const DipTarget *target, int width, int height, DipError *err) {
    if (!is_set(target->rgba8, "target.rgba8", err)) {
        return false;
    }
    if (target->width != width || target->height != height) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "target.width",
                             "%dx%d pixels, accepted the pipeline's %dx%d", target->width,
                             target->height, width, height);
    }
    if (target->stride_bytes % 4 != 0 || target->stride_bytes < 4 * (size_t)width) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "target.stride_bytes",
                             "%zu, accepted multiples of 4 from %zu", target->stride_bytes,
                             4 * (size_t)width);
    }
    return (uintptr_t)target->rgba8 % 4 == 0 ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "target.rgba8",
                         "not aligned, accepted addresses that are multiples of 4");
}

static bool check_region(const DipTargetRegion *region, int width, int height, DipError *err) {
    if (!region->x0 && !region->y0 && !region->x1 && !region->y1) {
        return true;
    }
    return (region->x0 >= 0 && region->x0 < region->x1 && region->x1 <= width && region->y0 >= 0 &&
            region->y0 < region->y1 && region->y1 <= height) ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "region",
                         "x %d..%d, y %d..%d, accepted a rectangle within %dx%d pixels", region->x0,
                         region->x1, region->y0, region->y1, width, height);
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
    return !pass->samples_per_group || pass->samples_per_group == count ||
           dip_sample_groups_exist(count, pass->samples_per_group) ||
           dip_error_set(
               err, DIP_ERROR_CONFLICT, NULL, 0, "samples_per_group",
               "groups of %d out of %d samples, accepted if dip_sample_groups_exist is true",
               pass->samples_per_group, count);
}

static bool check_draw(const DipDraw *draw, DipError *err) {
    return is_set(draw->mesh, "draws.mesh", err) &&
           is_set((const void *)(uintptr_t)draw->vertex_shader, "draws.vertex_shader", err) &&
           is_set((const void *)(uintptr_t)draw->fragment_shader, "draws.fragment_shader", err) &&
           in_range(draw->varying_count, 0, DIP_MAX_VARYINGS, "draws.varying_count", err) &&
           in_range(draw->clip_varying_count, 0, draw->varying_count, "draws.clip_varying_count",
                    err) &&
           in_range(draw->value_only_varying_count, 0, draw->varying_count,
                    "draws.value_only_varying_count", err) &&
           in_range((int)draw->cull, DIP_CULL_NONE, DIP_CULL_FRONT, "draws.cull", err);
}

bool dip_pass_check(const DipPass *pass, int width, int height, DipError *err) {
    if (!is_set(pass, "pass", err) || !check_target(&pass->target, width, height, err) ||
        !check_region(&pass->region, width, height, err) || !check_samples(pass, err) ||
        !in_range(pass->clip_plane_count, 0, DIP_MAX_CLIP_PLANES, "clip_plane_count", err) ||
        !in_range(pass->draw_count, 0, INT32_MAX, "draw_count", err) ||
        (pass->draw_count && !is_set(pass->draws, "draws", err))) {
        return false;
    }
    for (int d = 0; d < pass->draw_count; d++) {
        if (!check_draw(&pass->draws[d], err)) {
            return false;
        }
    }
    return true;
}
