// Draws one tile: coverage, then shading, then resolve.
#include "renderer/pipeline/run/tile_worker.h"

#include "renderer/base/pages.h"
#include "renderer/base/clock.h"
#include "renderer/pipeline/geometry/visit.h"
#include "renderer/pipeline/resolve/readback.h"
#include "renderer/pipeline/resolve/resolve.h"
#include "renderer/pipeline/run/pass_results.h"

#include <stdlib.h>
#include <string.h>

// Fills a list up to a multiple of DIP_BATCH_ALIGN with copies of its last fragment, so that
// vectors read valid triangles.
static void pad_list(DipFragmentList *list) {
    const int last = list->count - 1;
    for (int i = list->count; i % DIP_BATCH_ALIGN; i++) {
        list->triangle[i] = list->triangle[last];
        list->position[i] = list->position[last];
    }
}

// Tells the shaders of a draw which of a list's fragments lie on front faces, if they read this.
static void set_front(const DipTilePass *pass, const DipDraw *draw, const DipFragmentList *list,
                      DipFragmentBatch *batch, bool *has_front) {
    const bool reads = draw->state && draw->state->reads_front;
    if (!reads && !*has_front) {
        return; // as in most draws
    }
    for (int i = 0; i < DIP_FRAGMENT_BATCH; i++) {
        batch->front[i] = reads && i < batch->count &&
                          pass->geometry->triangles[list->triangle[i]].patch & DIP_ORDERED_FRONT;
    }
    *has_front = reads;
}

int dip_tile_worker_shade(DipTileWorker *worker, uint32_t draw_index, DipFragmentList *list) {
    const DipTilePass *pass = worker->pass;
    const DipDraw *draw = &pass->pass->draws[draw_index];
    DipFragmentBatch *batch = &worker->batch;
    pad_list(list);
    pass->kernels->dip_kernel_interpolate(&worker->shading.input, list, draw->varying_count,
                                          draw->value_only_varying_count, batch);
    set_front(pass, draw, list, batch, &worker->batch_has_front);
    dip_shader_guard_bind(&worker->guard, draw_index, draw->varying_count,
                          draw->varying_count - draw->value_only_varying_count, batch);
    draw->fragment_shader(batch);
    worker->tile_record.counters.shader_batches++;
    if (list == &worker->shading.whole_lists[draw_index]) {
        worker->tile_record.counters.fragments_of_blocks += (uint64_t)batch->count;
    }
    return batch->count;
}

// Shades the first fragments of a list, at most one batch. Their colours go to the worker's encoded
// batch. Returns the number of these fragments.
static int shade_batch(DipTileWorker *worker, uint32_t draw, DipFragmentList *list) {
    const DipTilePass *pass = worker->pass;
    const int count = dip_tile_worker_shade(worker, draw, list);
    pass->kernels->dip_kernel_encode(&worker->batch, worker->shading.light16 ? NULL : pass->srgb,
                                     &worker->encoded);
    worker->shading.fragments += (uint64_t)count;
    return count;
}

void dip_fragment_list_drop(DipFragmentList *list, int count) {
    list->count -= count;
    const size_t left = (size_t)list->count;
    memcpy(list->triangle, list->triangle + count, left * sizeof *list->triangle);
    memcpy(list->position, list->position + count, left * sizeof *list->position);
    memcpy(list->samples, list->samples + count, left * sizeof *list->samples);
}

static void flush_list(DipTileShading *shading, uint32_t draw) {
    DipTileWorker *worker = shading->context;
    DipFragmentList *list = &shading->lists[draw];
    const int count = shade_batch(worker, draw, list);
    dip_store_fragments(shading, list, count, &worker->encoded);
    if (worker->pass->pass->readback) {
        dip_readback_fragments(worker->pass->pass->readback, shading, list, count, false,
                               &worker->encoded);
    }
    dip_fragment_list_drop(list, count);
}

static void flush_whole_list(DipTileShading *shading, uint32_t draw) {
    DipTileWorker *worker = shading->context;
    DipFragmentList *list = &shading->whole_lists[draw];
    shade_batch(worker, draw, list);
    dip_store_whole(shading, list, &worker->encoded);
    if (worker->pass->pass->readback) {
        dip_readback_fragments(worker->pass->pass->readback, shading, list, list->count, true,
                               &worker->encoded);
    }
    list->count = 0;
}

const uint8_t *dip_tile_worker_clip(void *context, uint32_t draw_index) {
    DipTileWorker *worker = context;
    const DipTilePass *pass = worker->pass;
    const DipDraw *draw = &pass->pass->draws[draw_index];
    DipFragmentBatch *batch = &worker->clip_batch;
    pass->kernels->dip_kernel_interpolate(&worker->shading.input, &worker->clip_list,
                                          draw->clip_varying_count, 0, batch);
    set_front(pass, draw, &worker->clip_list, batch, &worker->clip_batch_has_front);
    dip_shader_guard_bind(&worker->clip_guard, draw_index, draw->clip_varying_count,
                          draw->clip_varying_count, batch);
    draw->clip_shader(batch);
    worker->tile_record.counters.fragments_clip_tested += (uint64_t)worker->clip_list.count;
    return batch->keep;
}

// Returns the number of sample groups of alpha-clipped draws.
static int sample_group_count(const DipTilePass *pass) {
    return pass->groups ? pass->groups->count : 1;
}

DipClipTest dip_tile_worker_clip_test(DipTileWorker *worker, const DipSampleGroups *groups) {
    const DipTilePass *pass = worker->pass;
    return (DipClipTest){
        .list = &worker->clip_list,
        .test = dip_tile_worker_clip,
        .context = worker,
        .groups = groups,
        .order = pass->pass->alpha_to_coverage ? pass->pattern->order : NULL,
        .queue = &worker->clip_queue,
        .triangles = pass->geometry->triangles,
    };
}

void dip_tile_worker_end_clip(DipTileWorker *worker) {
    if (worker->clip_queue.count) {
        worker->pass->kernels->dip_kernel_clip(&worker->tile, &worker->clip);
    }
}

void dip_tile_worker_cover(DipTileWorker *worker, uint32_t index) {
    const DipTilePass *pass = worker->pass;
    const DipTriangle *triangle = &pass->geometry->triangles[index];
    if (!pass->clips) {
        pass->kernels->dip_kernel_draw_triangle(&worker->tile, triangle, index + 1, NULL);
        return;
    }
    const bool clipped = pass->pass->draws[triangle->draw].clip_shader != NULL;
    worker->tile_record.counters.clip_sample_groups +=
        clipped ? (uint64_t)sample_group_count(pass) : 0;
    if (triangle->draw != worker->clip_queue.draw) {
        dip_tile_worker_end_clip(worker);
    }
    pass->kernels->dip_kernel_draw_triangle(&worker->tile, triangle, index + 1,
                                            clipped ? &worker->clip : NULL);
}

static void draw_triangle(void *context, uint32_t index) {
    dip_tile_worker_cover(context, index);
}

static int greatest(int a, int b) {
    return a > b ? a : b;
}

// Sets the number of pixels at each side of the tile that are not needed. region: rectangle of the
// target that is drawn. needed: rectangle of the tile that is needed, or NULL for the whole tile.
static void set_margins(const DipTargetRegion *region, const DipTileRegion *needed, DipTile *tile) {
    static const DipTileRegion whole = {0, 0, DIP_TILE, DIP_TILE};
    needed = needed ? needed : &whole;
    tile->left = greatest(region->x0 - tile->x0, needed->x0);
    tile->top = greatest(region->y0 - tile->y0, needed->y0);
    tile->right = greatest(tile->x0 + DIP_TILE - region->x1, DIP_TILE - needed->x1);
    tile->bottom = greatest(tile->y0 + DIP_TILE - region->y1, DIP_TILE - needed->y1);
}

// Where the colours of plain draws go: into the target, or in a tile that is merged into the
// samples.
static void set_destination(DipTileWorker *worker) {
    const DipTarget *target = &worker->pass->pass->target;
    DipTileShading *shading = &worker->shading;
    worker->merging = false;
    shading->share.paused = false;
    if (worker->pass->merges_all) {
        dip_merged_tile_begin(worker);
        return;
    }
    shading->flush = flush_list;
    shading->flush_whole = flush_whole_list;
    shading->stride = target->stride_bytes / 4;
    shading->pixels = (uint32_t *)(void *)target->rgba8 +
                      (size_t)worker->tile.y0 * shading->stride + (size_t)worker->tile.x0;
    if (worker->pass->pass->readback) {
        dip_readback_begin(worker->pass->pass->readback, shading);
    }
}

static void begin_tile(DipTileWorker *worker, int index) {
    const DipTilePass *pass = worker->pass;
    const DipGeometry *geometry = pass->geometry;
    const DipTarget *target = &pass->pass->target;
    DipTile *tile = &worker->tile;
    tile->x0 = index % geometry->tiles_x * DIP_TILE;
    tile->y0 = index / geometry->tiles_x * DIP_TILE;
    const DipTileRegion *needed = pass->pass->tile_regions;
    set_margins(&geometry->region, needed ? &needed[index] : NULL, tile);
    tile->pattern = pass->pattern;
    tile->touched = 0;
    tile->near_to_far = geometry->near_to_far ? geometry->triangles : NULL;
    if (geometry->near_to_far) {
        memset(tile->bound, 0, sizeof tile->bound);
        memset(tile->drawn, 0, sizeof tile->drawn);
    }
    tile->grouped = 0;
    tile->sub_blocks_tested = 0;
    tile->sub_blocks_accepted = 0;
    DipTileShading *shading = &worker->shading;
    shading->tile = tile;
    shading->input = (DipShadingInput){geometry->triangles, geometry->planes,
                                       geometry->plane_stride, tile->x0, tile->y0};
    shading->draws = pass->pass->draws;
    shading->single_draw = pass->pass->draw_count == 1;
    shading->groups = pass->groups;
    shading->groups_shade_all = pass->pass->groups_shade_all;
    shading->context = worker;
    shading->width = target->width - tile->x0 < DIP_TILE ? target->width - tile->x0 : DIP_TILE;
    shading->height = target->height - tile->y0 < DIP_TILE ? target->height - tile->y0 : DIP_TILE;
    shading->light16 = dip_pass_hands_light(pass->pass) ? worker->light16 : NULL;
    shading->clear_rgba8 = pass->clear_rgba8;
    memcpy(shading->clear_linear16, pass->clear_linear16, sizeof shading->clear_linear16);
    shading->multi_fragment_count = 0;
    shading->fragments = 0;
    shading->copied = 0;
    shading->samples = 0;
    worker->batch.work = (DipShaderWork){0};
    worker->clip_batch.work = (DipShaderWork){0};
    worker->clip = dip_tile_worker_clip_test(worker, pass->groups);
    set_destination(worker);
}

void dip_tile_worker_record_mixed(const DipTileWorker *worker) {
    if (!worker->pass->recording.mixed) {
        return;
    }
    const DipTileShading *shading = &worker->shading;
    const size_t width = (size_t)worker->pass->pass->target.width;
    uint8_t *first =
        worker->pass->recording.mixed + (size_t)worker->tile.y0 * width + (size_t)worker->tile.x0;
    for (int i = 0; i < shading->multi_fragment_count; i++) {
        const size_t pixel = shading->multi_fragment[i];
        first[pixel / DIP_TILE * width + pixel % DIP_TILE] = 1;
    }
}

void dip_plain_tile_end(DipTileWorker *worker, int64_t begin_ns) {
    const DipTilePass *pass = worker->pass;
    DipTileRecord *record = &worker->tile_record;
    const int64_t covered_ns = dip_clock_ns();
    dip_tile_worker_shade_tile(worker);
    const int64_t shaded_ns = dip_clock_ns();
    dip_resolve_multi_fragment(&worker->shading, pass->srgb);
    record->raster_ns += covered_ns - begin_ns;
    record->shading_ns = shaded_ns - covered_ns;
    record->resolve_ns = dip_clock_ns() - shaded_ns;
    dip_tile_worker_record_mixed(worker);
}

// Covers, shades and resolves a tile of a pass that is not merged.
static void draw_plain_tile(DipTileWorker *worker, int index) {
    const int64_t begin_ns = dip_clock_ns();
    dip_geometry_visit(worker->pass->geometry, index, draw_triangle, worker);
    dip_tile_worker_end_clip(worker);
    dip_plain_tile_end(worker, begin_ns);
}

void dip_tile_worker_shade_tile(DipTileWorker *worker) {
    DipTileShading *shading = &worker->shading;
    worker->pass->kernels->dip_kernel_collect(shading);
    for (int i = 0; i < shading->active_count; i++) {
        const uint32_t draw = shading->active[i];
        if (shading->whole_lists[draw].count) {
            shading->flush_whole(shading, draw);
        }
        if (shading->lists[draw].count) {
            shading->flush(shading, draw);
        }
        shading->is_active[draw] = 0;
    }
    shading->active_count = 0;
}

static void add_shader_work(const DipShaderWork *from, DipPipelineCounters *to) {
    to->texture_probes += from->probes;
    to->texels_fetched += from->texels;
    for (int i = 0; i < DIP_SHADER_COUNT_MAX; i++) {
        to->shader_counts[i] += from->counts[i];
    }
}

void dip_tile_worker_begin_pass(DipTileWorker *worker) {
    const DipTilePass *pass = worker->pass;
    worker->pass_record = (DipTileRecord){.raster_ns = 0};
    worker->shading.share.offers = false;
    worker->shading.share.from = NULL;
    DipShaderGuard *const guards[2] = {&worker->guard, &worker->clip_guard};
    for (int i = 0; i < 2; i++) {
        dip_shader_guard_begin(guards[i], pass->kernels, pass->pass, pass->at_once,
                               pass->at_once_count, pass->srgb_light);
    }
}

// Hands the finished tile to the caller.
static void hand_over(DipTileWorker *worker) {
    const DipPass *pass = worker->pass->pass;
    const DipTile *tile = &worker->tile;
    const DipTileShading *shading = &worker->shading;
    const DipTargetRegion pixels = {tile->x0, tile->y0, tile->x0 + shading->width,
                                    tile->y0 + shading->height};
    const int64_t begin_ns = dip_clock_ns();
    pass->tile_done(pass->tile_context, &pixels, shading->light16);
    worker->tile_record.resolve_ns += dip_clock_ns() - begin_ns;
}

// Counts the work of a drawn tile that is known only when it has ended.
static void count_tile(DipTileWorker *worker) {
    DipPipelineCounters *counters = &worker->tile_record.counters;
    counters->tiles_drawn = 1;
    counters->sub_blocks_tested = worker->tile.sub_blocks_tested;
    counters->sub_blocks_accepted = worker->tile.sub_blocks_accepted;
    counters->fragments_shaded = worker->shading.fragments;
    counters->fragments_copied = worker->shading.copied;
    counters->samples_shown = worker->shading.samples;
    counters->pixels_resolved += (uint64_t)worker->shading.multi_fragment_count;
    counters->clip_probes = worker->clip_batch.work.probes;
    add_shader_work(&worker->batch.work, counters);
    add_shader_work(&worker->clip_batch.work, counters);
}

void dip_tile_worker_draw(DipTileWorker *worker, int index) {
    const DipTilePass *pass = worker->pass;
    worker->tile_record = (DipTileRecord){.raster_ns = 0};
    const int64_t begin_ns = dip_clock_ns();
    begin_tile(worker, index);
    worker->tile_record.raster_ns = dip_clock_ns() - begin_ns;
    if (pass->merged) {
        dip_merged_tile_draw(worker, index);
    } else {
        draw_plain_tile(worker, index);
    }
    if (pass->pass->depths) {
        dip_store_pass_depths(pass->pass, &worker->tile);
    }
    if (pass->pass->tile_done) {
        hand_over(worker);
    }
    count_tile(worker);
    dip_tile_record_add(&worker->tile_record, &worker->pass_record);
    if (pass->recording.tiles) {
        pass->recording.tiles[index] = worker->tile_record;
    }
}

// --- creating and destroying -------------------------------------------------------------------

static void *allocate_aligned(size_t size_bytes) {
    void *memory = dip_lines_alloc(size_bytes);
    if (memory) {
        memset(memory, 0, size_bytes);
    }
    return memory;
}

DipTileWorker *dip_tile_worker_create(const DipTilePass *pass) {
    DipTileWorker *worker = allocate_aligned(sizeof *worker);
    if (!worker) {
        return NULL;
    }
    const size_t samples = (size_t)DIP_TILE_PIXELS * DIP_MAX_SAMPLES;
    DipTileShading *shading = &worker->shading;
    worker->pass = pass;
    worker->tile.depth = allocate_aligned(samples * sizeof *worker->tile.depth);
    worker->tile.id = allocate_aligned(samples * sizeof *worker->tile.id);
    shading->sum = allocate_aligned(DIP_TILE_PIXELS * sizeof *shading->sum);
    shading->multi_fragment = allocate_aligned(DIP_TILE_PIXELS * sizeof *shading->multi_fragment);
    if (!worker->tile.depth || !worker->tile.id || !shading->sum || !shading->multi_fragment) {
        dip_tile_worker_destroy(&worker);
    }
    return worker;
}

bool dip_tile_worker_make_merge(DipTileWorker *worker) {
    return dip_merge_tile_allocate(&worker->merge);
}

bool dip_tile_worker_make_light(DipTileWorker *worker) {
    if (!worker->light16) {
        worker->light16 = allocate_aligned(3 * DIP_TILE_PIXELS * sizeof *worker->light16);
    }
    return worker->light16 != NULL;
}

static void free_lists(DipTileShading *shading) {
    free(shading->list_memory);
    free(shading->active);
    free(shading->is_active);
}

void dip_tile_worker_destroy(DipTileWorker **worker_pointer) {
    DipTileWorker *worker = *worker_pointer;
    if (worker) {
        dip_lines_free(worker->tile.depth);
        dip_lines_free(worker->tile.id);
        dip_lines_free(worker->shading.sum);
        dip_lines_free(worker->shading.multi_fragment);
        dip_lines_free(worker->light16);
        dip_merge_tile_free(&worker->merge);
        free_lists(&worker->shading);
        dip_lines_free(worker);
        *worker_pointer = NULL;
    }
}

// Returns the first cache line that starts in a block of memory.
static void *first_line(void *memory) {
    const uintptr_t offset = (uintptr_t)memory % DIP_CACHE_LINE;
    return (char *)memory + (offset ? DIP_CACHE_LINE - offset : 0);
}

bool dip_tile_worker_make_lists(DipTileWorker *worker, int draw_count) {
    DipTileShading *shading = &worker->shading;
    const size_t count = (size_t)draw_count;
    free_lists(shading);
    // Memory that the system has cleared costs no pages for lists that are not used, but it is not
    // aligned.
    shading->list_memory = calloc(2 * count + 1, sizeof *shading->lists);
    shading->lists = shading->whole_lists = NULL;
    if (shading->list_memory) {
        shading->lists = first_line(shading->list_memory);
        shading->whole_lists = shading->lists + count;
    }
    shading->active = calloc(count, sizeof *shading->active);
    shading->is_active = calloc(count, sizeof *shading->is_active);
    return shading->list_memory && shading->active && shading->is_active;
}
