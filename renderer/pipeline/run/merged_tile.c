// Draws one tile of a merged pass (merge/merge_tile.h): runs of plain draws are covered and shaded
// as in any pass, but their colours go to the samples; the triangles of ordered draws are merged
// one after the other. A tile that need not be merged becomes a merged one at its first triangle of
// an ordered draw. Until then, plain draws have covered it but are not shaded.
#include "renderer/base/clock.h"
#include "renderer/pipeline/geometry/visit.h"
#include "renderer/pipeline/run/tile_worker.h"

#include <string.h>

// --- plain draws ---------------------------------------------------------------------------------

static void flush_list(DipTileShading *shading, uint32_t draw) {
    DipTileWorker *worker = shading->context;
    DipFragmentList *list = &shading->lists[draw];
    const int count = dip_tile_worker_shade(worker, draw, list);
    shading->fragments += (uint64_t)count;
    dip_merge_store_fragments(&worker->pass->merge, &worker->merge, &worker->tile, list, count,
                              &worker->batch);
    dip_fragment_list_drop(list, count);
}

static void flush_whole_list(DipTileShading *shading, uint32_t draw) {
    DipTileWorker *worker = shading->context;
    DipFragmentList *list = &shading->whole_lists[draw];
    shading->fragments += (uint64_t)dip_tile_worker_shade(worker, draw, list);
    dip_merge_store_whole(&worker->pass->merge, &worker->merge, &worker->tile, list,
                          &worker->batch);
    list->count = 0;
}

// Shades what the plain draws since the last ordered draw have covered.
static void shade_plain_draws(DipTileWorker *worker) {
    if (!worker->merge.plain_left) {
        return;
    }
    worker->merge.plain_left = false;
    if (!worker->pass->merge.has_colours) {
        return; // nothing reads the visibility buffer
    }
    const int64_t begin_ns = dip_clock_ns();
    dip_tile_worker_shade_tile(worker);
    worker->shading_ns += dip_clock_ns() - begin_ns;
    worker->tile_record.counters.pixels_resolved += (uint64_t)worker->shading.multi_fragment_count;
    dip_tile_worker_record_mixed(worker);
    worker->shading.multi_fragment_count = 0;
    dip_merge_clear_ids(&worker->tile);
}

// --- ordered draws -------------------------------------------------------------------------------

static void shade_ordered_batch(DipTileWorker *worker, DipOrderedBatch *batch) {
    const DipMergePass *pass = &worker->pass->merge;
    for (int i = 0; i < batch->count; i++) {
        dip_merge_ready_block(pass, &worker->merge, &worker->tile, batch->waiting[i].number / 4);
    }
    for (int i = 0; i < DIP_FRAGMENT_BATCH; i++) {
        worker->batch.alpha[i] = 1.0f;
    }
    const int count = dip_tile_worker_shade(worker, (uint32_t)worker->merge.draw, &batch->list);
    worker->tile_record.counters.fragments_ordered += (uint64_t)count;
    pass->kernels->dip_kernel_blend(&worker->merge.colours, worker->merge.ordered.state, batch,
                                    &worker->batch);
    batch->list.count = 0;
    batch->count = 0;
}

// Shades the queued fragments of the current ordered draw, and blends them.
static void shade_queue(void *context) {
    DipTileWorker *worker = context;
    DipOrdered *ordered = &worker->merge.ordered;
    const int64_t begin_ns = dip_clock_ns();
    for (int i = 0; i < DIP_ORDERED_BATCHES && ordered->batches[i].count; i++) {
        shade_ordered_batch(worker, &ordered->batches[i]);
    }
    ordered->full = 0;
    worker->shading_ns += dip_clock_ns() - begin_ns;
}

// Ends the current ordered draw, if there is one.
static void end_ordered_draw(DipTileWorker *worker) {
    if (worker->merge.draw >= 0) {
        if (worker->merge.ordered.batches[0].count) {
            shade_queue(worker);
        }
        worker->merge.draw = -1;
    }
}

static void begin_ordered_draw(DipTileWorker *worker, uint32_t draw_index, DipClipTest *clip) {
    static const DipDrawState zero;
    enum { ALL_CHANNELS = 15 };
    const DipDraw *draw = &worker->pass->pass->draws[draw_index];
    DipOrdered *ordered = &worker->merge.ordered;
    worker->merge.draw = draw_index;
    ordered->state = draw->state ? draw->state : &zero;
    ordered->shades = worker->pass->merge.has_colours &&
                      (ordered->state->kept_channels & ALL_CHANNELS) != ALL_CHANNELS;
    ordered->clip = draw->clip_shader ? clip : NULL;
    ordered->flush = shade_queue;
    ordered->context = worker;
}

// The visit of a tile's triangles.
typedef struct MergeVisit {
    DipTileWorker *worker;
    DipClipTest clip;
} MergeVisit;

static void draw_triangle(void *context, uint32_t index) {
    MergeVisit *visit = context;
    DipTileWorker *worker = visit->worker;
    const DipTriangle *triangle = &worker->pass->geometry->triangles[index];
    if (!worker->pass->merge.is_ordered[triangle->draw]) {
        end_ordered_draw(worker);
        worker->merge.plain_left = true;
        dip_tile_worker_cover(worker, index);
        return;
    }
    dip_tile_worker_end_clip(worker);
    if (!worker->merging) {
        const bool plain_left = worker->merge.plain_left;
        dip_merged_tile_begin(worker);
        worker->merge.plain_left = plain_left;
    }
    if (worker->merge.draw != (int64_t)triangle->draw) {
        end_ordered_draw(worker);
        shade_plain_draws(worker);
        begin_ordered_draw(worker, triangle->draw, &visit->clip);
    }
    worker->pass->kernels->dip_kernel_draw_ordered(&worker->tile, triangle, index,
                                                   &worker->merge.ordered);
}

// --- a tile --------------------------------------------------------------------------------------

void dip_merged_tile_begin(DipTileWorker *worker) {
    DipTileShading *shading = &worker->shading;
    worker->merging = true;
    shading->share.paused = true; // Its colours do not go to pixels.
    memset(shading->share.offered, 0, sizeof shading->share.offered);
    shading->flush = flush_list;
    shading->flush_whole = flush_whole_list;
    shading->stride = DIP_TILE;
    shading->pixels = worker->merge.scratch;
    worker->shading_ns = 0;
    dip_merge_begin(&worker->pass->merge, &worker->merge, &worker->tile);
}

void dip_merged_tile_draw(DipTileWorker *worker, int index) {
    DipTileRecord *record = &worker->tile_record;
    MergeVisit visit = {worker, dip_tile_worker_clip_test(worker, NULL)};
    const int64_t begin_ns = dip_clock_ns();
    worker->merge.draw = -1;
    worker->merge.plain_left = false;
    dip_geometry_visit(worker->pass->geometry, index, draw_triangle, &visit);
    dip_tile_worker_end_clip(worker);
    if (!worker->merging) {
        dip_plain_tile_end(worker, begin_ns);
        return;
    }
    end_ordered_draw(worker);
    shade_plain_draws(worker);
    const int64_t drawn_ns = dip_clock_ns();
    dip_store_attachments(&worker->pass->merge, &worker->merge, &worker->tile,
                          worker->shading.light16);
    record->raster_ns += drawn_ns - begin_ns - worker->shading_ns;
    record->shading_ns = worker->shading_ns;
    record->resolve_ns = dip_clock_ns() - drawn_ns;
}
