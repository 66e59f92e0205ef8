// Makes filters and runs them.
#include "renderer/post/post.h"

#include "renderer/base/fp_mode.h"
#include "renderer/base/pages.h"
#include "renderer/post/filters/filter.h"

#include <stdlib.h>
#include <string.h>

static const char *const names[DIP_POST_COUNT] = {
#define DIP_POST_NAME(name, NAME, text) #name,
    DIP_POST_LIST(DIP_POST_NAME)
#undef DIP_POST_NAME
};

static const DipPostKind *const kinds[DIP_POST_COUNT] = {
    [DIP_POST_FXAA] = &dip_post_fxaa,         [DIP_POST_SMAA] = &dip_post_smaa,
    [DIP_POST_SHARPEN] = &dip_post_sharpen,   [DIP_POST_BILINEAR] = &dip_post_separable,
    [DIP_POST_BICUBIC] = &dip_post_separable, [DIP_POST_EASU] = &dip_post_easu,
};

const char *dip_post_name(DipPostFilter filter) {
    return (unsigned)filter < DIP_POST_COUNT ? names[filter] : "?";
}

bool dip_post_parse(const char *name, DipPostFilter *filter) {
    for (int i = 0; i < DIP_POST_COUNT; i++) {
        if (!strcmp(names[i], name)) {
            *filter = (DipPostFilter)i;
            return true;
        }
    }
    return false;
}

bool dip_post_enlarges(DipPostFilter filter) {
    return filter == DIP_POST_BILINEAR || filter == DIP_POST_BICUBIC || filter == DIP_POST_EASU;
}

static bool check(const DipPostDef *def, DipError *err) {
    if ((unsigned)def->filter >= DIP_POST_COUNT) {
        return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, "filter", "%d, accepted: 0 to %d",
                             (int)def->filter, DIP_POST_COUNT - 1);
    }
    const char *name = names[def->filter];
    if (def->from_width < 1 || def->from_height < 1 || def->to_width > DIP_MAX_POST_SIZE ||
        def->to_height > DIP_MAX_POST_SIZE || def->from_width > def->to_width ||
        def->from_height > def->to_height) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, name,
                             "a picture of %d x %d from one of %d x %d, accepted: sizes of 1 to %d "
                             "that do not shrink",
                             def->to_width, def->to_height, def->from_width, def->from_height,
                             DIP_MAX_POST_SIZE);
    }
    if (!dip_post_enlarges(def->filter) &&
        (def->from_width != def->to_width || def->from_height != def->to_height)) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, name,
                             "a picture of %d x %d from one of %d x %d, accepted: the same size, "
                             "because this filter does not enlarge",
                             def->to_width, def->to_height, def->from_width, def->from_height);
    }
    if (!(def->sharpness >= 0.0f && def->sharpness <= 1.0f)) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, name, "sharpness %g, accepted: 0 to 1",
                             (double)def->sharpness);
    }
    if (!dip_isa_available(def->isa)) {
        return dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, name,
                             "the instruction set %s, which this machine does not have",
                             dip_isa_name(def->isa));
    }
    return true;
}

// Returns NULL if memory runs out.
static DipPost *make(const DipPostDef *def) {
    DipPost *post = calloc(1, sizeof *post);
    if (!post) {
        return NULL;
    }
    post->def = *def;
    post->kernels = dip_post_kernels(def->isa);
    post->worker_count = dip_pool_thread_count(def->pool);
    DipPostArena arena = {0};
    kinds[def->filter]->take(post, &arena);
    post->bytes = arena.used;
    post->memory = dip_pages_alloc(arena.used);
    if (!post->memory) {
        free(post);
        return NULL;
    }
    memset(post->memory, 0, post->bytes);
    arena = (DipPostArena){.memory = post->memory};
    kinds[def->filter]->take(post, &arena);
    kinds[def->filter]->prepare(post);
    return post;
}

DipPost *dip_post_create(const DipPostDef *def, DipError *err) {
    DIP_FP_MODE_SCOPE();
    if (!check(def, err)) {
        return NULL;
    }
    DipPost *post = make(def);
    if (!post) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, names[def->filter],
                      "out of memory for pictures of %d x %d", def->to_width, def->to_height);
    }
    return post;
}

void dip_post_destroy(DipPost **post) {
    if (*post) {
        dip_lines_free((*post)->memory);
        free(*post);
        *post = NULL;
    }
}

size_t dip_post_bytes(const DipPost *post) {
    return sizeof *post + post->bytes;
}

DipPostWork dip_post_run(DipPost *post, const uint8_t *from_rgba8, size_t from_stride_bytes,
                         uint8_t *to_rgba8, size_t to_stride_bytes) {
    post->from = from_rgba8;
    post->from_stride_bytes = from_stride_bytes;
    post->to = to_rgba8;
    post->to_stride_bytes = to_stride_bytes;
    const DipFpMode mode = dip_fp_mode_set();
    kinds[post->def.filter]->run(post);
    dip_fp_mode_restore(mode);
    DipPostWork work = {.pixels_filtered =
                            (uint64_t)post->def.to_width * (uint64_t)post->def.to_height};
    for (int i = 0; post->edges_found && i < post->worker_count; i++) {
        work.edges_found += post->edges_found[i];
        post->edges_found[i] = 0;
    }
    return work;
}
