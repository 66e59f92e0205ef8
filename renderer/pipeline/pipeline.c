// The pipeline: runs the geometry jobs of one or several passes, then draws their tiles.
#include "renderer/pipeline/pipeline.h"

#include "renderer/base/fp_mode.h"
#include "renderer/base/clock.h"
#include "renderer/base/srgb.h"
#include "renderer/pipeline/geometry/geometry.h"
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/merge/merge_tile.h"
#include "renderer/pipeline/run/pass_check.h"
#include "renderer/pipeline/run/pass_results.h"
#include "renderer/pipeline/run/tile_worker.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

struct DipPipeline {
    DipPool *pool;
    int width;
    int height;
    int worker_count;
    DipTileWorker **workers;
    DipGeometry geometry;
    DipTilePass tile_pass;      // the pass being drawn
    DipTileRecording recording; // its arrays are NULL unless tiles are recorded
    int draw_room;              // number of draws for which the workers have lists
    uint8_t *is_ordered;        // one per draw (draw_room)
    DipSrgbEncodeTable *srgb;
    float srgb_light[256]; // linear light of the 8-bit sRGB values
    atomic_bool busy;      // a thread is drawing with the pipeline
};

// --- preparing a pass --------------------------------------------------------------------------

static void set_clear(DipTilePass *tile_pass, const float clear_lin[3]) {
    tile_pass->clear_rgba8 = 0xff000000u;
    for (int c = 0; c < 3; c++) {
        const float light =
            clear_lin[c] > 0.0f ? (clear_lin[c] < 1.0f ? clear_lin[c] : 1.0f) : 0.0f;
        tile_pass->clear_linear16[c] = (int32_t)(light * 65535.0f + 0.5f);
        tile_pass->clear_rgba8 |=
            (uint32_t)dip_srgb_code(tile_pass->srgb, tile_pass->clear_linear16[c]) << (8 * c);
    }
}

static void set_sample_groups(DipTilePass *tile_pass, const DipPass *pass) {
    tile_pass->groups = NULL;
    if (pass->samples_per_group && pass->samples_per_group < pass->sample_count) {
        dip_sample_groups_make(&tile_pass->groups_room, tile_pass->pattern,
                               pass->samples_per_group);
        tile_pass->groups = &tile_pass->groups_room;
    }
}

// Makes longer arrays of lists if the pass has more draws than any pass before. Each worker keeps
// fragment lists for every draw.
static bool make_lists(DipPipeline *pipeline, int draw_count, DipError *err) {
    if (draw_count <= pipeline->draw_room) {
        return true;
    }
    pipeline->draw_room = 0;
    free(pipeline->is_ordered);
    pipeline->is_ordered = calloc((size_t)draw_count, sizeof *pipeline->is_ordered);
    if (!pipeline->is_ordered) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "pass", "no memory for %d draws",
                             draw_count);
    }
    for (int w = 0; w < pipeline->worker_count; w++) {
        if (!dip_tile_worker_make_lists(pipeline->workers[w], draw_count)) {
            return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "pass", "no memory for %d draws",
                                 draw_count);
        }
    }
    pipeline->draw_room = draw_count;
    return true;
}

// Allocates what merged passes need (merge/merge_tile.h).
static bool make_merge(DipPipeline *pipeline, const DipPass *pass, DipError *err) {
    for (int w = 0; dip_pass_is_merged(pass) && w < pipeline->worker_count; w++) {
        if (!dip_tile_worker_make_merge(pipeline->workers[w])) {
            return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "pass",
                                 "no memory for the samples of a tile");
        }
    }
    return true;
}

// Allocates what passes need that hand over their light (DipPass.tile_done).
static bool make_light(DipPipeline *pipeline, const DipPass *pass, DipError *err) {
    for (int w = 0; dip_pass_hands_light(pass) && w < pipeline->worker_count; w++) {
        if (!dip_tile_worker_make_light(pipeline->workers[w])) {
            return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "pass",
                                 "no memory for the light of a tile");
        }
    }
    return true;
}

bool dip_pipeline_reserve(DipPipeline *pipeline, const DipPass *pass, DipError *err) {
    DIP_FP_MODE_SCOPE();
    if (!pipeline || !pass) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, pipeline ? "pass" : "pipeline",
                             "NULL, accepted a pointer");
    }
    return dip_pass_check_draws(pass, err) && make_lists(pipeline, pass->draw_count, err) &&
           make_merge(pipeline, pass, err) && make_light(pipeline, pass, err) &&
           dip_geometry_reserve(&pipeline->geometry, pass, err);
}

static void begin_merge(DipPipeline *pipeline, const DipPass *pass) {
    DipTilePass *tile_pass = &pipeline->tile_pass;
    tile_pass->merged = dip_pass_is_merged(pass);
    tile_pass->merges_all = dip_pass_merges_all_tiles(pass);
    if (tile_pass->merged) {
        for (int d = 0; d < pass->draw_count; d++) {
            pipeline->is_ordered[d] = dip_state_is_ordered(pass->draws[d].state);
        }
        tile_pass->merge.is_ordered = pipeline->is_ordered;
        dip_merge_pass_begin(&tile_pass->merge, pass);
    }
}

static void begin_recording(DipPipeline *pipeline) {
    const DipTileRecording *recording = &pipeline->recording;
    pipeline->tile_pass.recording = *recording;
    if (recording->tiles) {
        memset(recording->tiles, 0,
               dip_geometry_tiles(&pipeline->geometry) * sizeof *recording->tiles);
    }
    if (recording->mixed) {
        memset(recording->mixed, 0, (size_t)pipeline->width * (size_t)pipeline->height);
    }
}

static bool begin_pass(DipPipeline *pipeline, const DipPass *pass, const DipPass *const *at_once,
                       int at_once_count, DipError *err) {
    if (!make_lists(pipeline, pass->draw_count, err) || !make_merge(pipeline, pass, err) ||
        !make_light(pipeline, pass, err)) {
        return false;
    }
    DipTilePass *tile_pass = &pipeline->tile_pass;
    tile_pass->pass = pass;
    tile_pass->at_once = at_once;
    tile_pass->at_once_count = at_once_count;
    tile_pass->pattern = dip_sample_pattern_of(pass->sample_count, pass->pattern);
    tile_pass->geometry = &pipeline->geometry;
    set_clear(tile_pass, pass->clear_lin);
    set_sample_groups(tile_pass, pass);
    tile_pass->clips = false;
    for (int d = 0; d < pass->draw_count; d++) {
        tile_pass->clips |= pass->draws[d].clip_shader != NULL;
    }
    begin_merge(pipeline, pass);
    begin_recording(pipeline);
    for (int w = 0; w < pipeline->worker_count; w++) {
        dip_tile_worker_begin_pass(pipeline->workers[w]);
    }
    return true;
}

// --- the geometry stage ------------------------------------------------------------------------

static void run_job(void *context, int index, int worker_index) {
    DipPipeline *pipeline = context;
    dip_geometry_run_job(&pipeline->geometry, pipeline->tile_pass.kernels, index,
                         &pipeline->workers[worker_index]->geometry);
}

// Runs the geometry stage for the first pass. It keeps the triangles that may cover a sample of any
// of the passes.
static bool run_geometry(DipPipeline *pipeline, const DipPass *const *passes, int pass_count,
                         DipError *err) {
    do {
        if (!dip_geometry_begin(&pipeline->geometry, passes, pass_count, pipeline->pool, err)) {
            return false;
        }
        for (int w = 0; w < pipeline->worker_count; w++) {
            pipeline->workers[w]->geometry.next_triangle = 0;
            pipeline->workers[w]->geometry.triangle_end = 0;
        }
        dip_pool_run(pipeline->pool, pipeline->geometry.job_count, run_job, pipeline);
    } while (dip_geometry_grow_after_overflow(&pipeline->geometry));
    return true;
}

// --- drawing passes ----------------------------------------------------------------------------

// Passes that are drawn at once.
typedef struct Batch {
    const DipPassWork *works;
    const DipPass *passes[DIP_MAX_PASSES_AT_ONCE]; // those of the works
    int count;
    bool same_geometry;
    int64_t geometry_ns[DIP_MAX_PASSES_AT_ONCE];
} Batch;

// Whether other passes may copy a pass's pixels, or this pass those of others. The colours of a
// merged tile, of a readback and of a tile that is handed over do not go to pixels, and records
// tell the work of a pass alone.
static bool may_share(const DipPassWork *work) {
    const DipTilePass *tile_pass = &work->pipeline->tile_pass;
    return !tile_pass->merges_all && !work->pass->readback && !work->pass->tile_done &&
           !work->pipeline->recording.tiles;
}

static bool has_own_shading(const DipPass *pass) {
    for (int d = 0; d < pass->draw_count; d++) {
        if (pass->draws[d].own_shading) {
            return true;
        }
    }
    return false;
}

// Tells each worker of a pass which worker's pixels it copies. Worker w draws the same tile of each
// pass, so it copies from worker w of the other pass.
static void share_shading(const DipPassWork *work) {
    const DipPassWork *from = work->copies_from;
    if (!from || !may_share(work) || !may_share(from)) {
        return;
    }
    const bool some_own = has_own_shading(work->pass);
    const bool some_own_there = has_own_shading(from->pass);
    for (int w = 0; w < work->pipeline->worker_count; w++) {
        DipTileShading *offering = &from->pipeline->workers[w]->shading;
        offering->share.offers = true;
        offering->share.some_own = some_own_there;
        DipShadingShare *copying = &work->pipeline->workers[w]->shading.share;
        copying->from = offering;
        copying->some_own = some_own;
    }
}

static void draw_tile(DipPipeline *pipeline, int tile, int worker_index) {
    const DipGeometry *geometry = pipeline->tile_pass.geometry;
    if (tile < geometry->tile_count) {
        dip_tile_worker_draw(pipeline->workers[worker_index], geometry->tiles[tile]);
    }
}

// Draws one tile of each pass, those that copy pixels after those that they copy from. Which of the
// others goes first alternates from tile to tile, so that no pass always gets the warm cache.
static void run_tiles(void *context, int tile, int worker_index) {
    const Batch *batch = context;
    for (int copying = 0; copying <= 1; copying++) {
        for (int i = 0; i < batch->count; i++) {
            const DipPassWork *work = &batch->works[(tile + i) % batch->count];
            if ((work->copies_from != NULL) == copying) {
                draw_tile(work->pipeline, tile, worker_index);
            }
        }
    }
}

// Runs the geometry stage for each pass, or once for all passes if they have the same geometry.
static bool run_geometries(Batch *batch, DipError *err) {
    const int runs = batch->same_geometry ? 1 : batch->count;
    for (int i = 0; i < runs; i++) {
        const int64_t begin_ns = dip_clock_ns();
        if (!run_geometry(batch->works[i].pipeline, batch->passes + i,
                          batch->same_geometry ? batch->count : 1, err)) {
            return false;
        }
        batch->geometry_ns[i] = dip_clock_ns() - begin_ns;
    }
    for (int i = runs; i < batch->count; i++) {
        batch->works[i].pipeline->tile_pass.geometry = &batch->works[0].pipeline->geometry;
        batch->geometry_ns[i] = batch->geometry_ns[0];
    }
    return true;
}

static int greatest_tile_count(const Batch *batch) {
    int greatest = 0;
    for (int i = 0; i < batch->count; i++) {
        const int count = batch->works[i].pipeline->tile_pass.geometry->tile_count;
        greatest = count > greatest ? count : greatest;
    }
    return greatest;
}

// Returns the sum of the records of all tiles that the pipeline's workers have drawn in its pass.
static DipTileRecord sum_tiles(const DipPipeline *pipeline) {
    DipTileRecord sum = {.raster_ns = 0};
    for (int w = 0; w < pipeline->worker_count; w++) {
        dip_tile_record_add(&pipeline->workers[w]->pass_record, &sum);
    }
    return sum;
}

// tiles_ns: wall-clock time of drawing the tiles of all passes.
static void add_results(const Batch *batch, int64_t tiles_ns) {
    DipTileRecord sums[DIP_MAX_PASSES_AT_ONCE];
    int64_t total_ns = 0;
    for (int i = 0; i < batch->count; i++) {
        sums[i] = sum_tiles(batch->works[i].pipeline);
        total_ns += dip_tile_record_ns(&sums[i]);
    }
    const double scale = total_ns ? 1e-6 * (double)tiles_ns / (double)total_ns : 0.0;
    for (int i = 0; i < batch->count; i++) {
        const DipPassWork *work = &batch->works[i];
        if (work->counters) {
            dip_pass_add_counters(work->pass, work->pipeline->tile_pass.geometry, &sums[i],
                                  work->counters);
        }
        if (work->times) {
            dip_pass_add_times(&sums[i], batch->geometry_ns[i], scale, work->times);
        }
    }
}

// Reports the fault of the earliest draw whose shaders read what they cannot have.
static bool check_shaders(const DipPipeline *pipeline, DipError *err) {
    DipError fault = {.code = DIP_ERROR_NONE};
    uint32_t draw = 0;
    for (int w = 0; w < pipeline->worker_count; w++) {
        dip_shader_guard_collect(&pipeline->workers[w]->guard, &fault, &draw);
        dip_shader_guard_collect(&pipeline->workers[w]->clip_guard, &fault, &draw);
    }
    if (fault.code && err) {
        *err = fault;
    }
    return !fault.code;
}

// Whether a pass may change its depths or stencil values, or leave them undefined.
static bool changes_depth(const DipAttachments *attachments) {
    return attachments->depth_store != DIP_STORE_REVERT ||
           attachments->stencil_store != DIP_STORE_REVERT;
}

// Checks that two passes that are drawn at once, and so have no order, do not draw into the same
// samples, depths or stencil values.
static bool check_shared_attachments(const DipPassWork *works, int first, int second,
                                     DipError *err) {
    const DipAttachments *a = &works[first].pass->attachments;
    const DipAttachments *b = &works[second].pass->attachments;
    if (a->samples && a->samples == b->samples) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "attachments.samples",
                             "passes %d and %d draw into the same samples, accepted different "
                             "ones for passes that are drawn at once",
                             first, second);
    }
    if (a->depth && a->depth == b->depth && (changes_depth(a) || changes_depth(b))) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "attachments.depth",
                             "passes %d and %d draw into the same depths, accepted different ones "
                             "for passes that are drawn at once, or passes that revert them",
                             first, second);
    }
    return true;
}

// Checks whether works[index] may be drawn at once with the works before it.
static bool check_work(const DipPassWork *works, int index, DipError *err) {
    const DipPipeline *pipeline = works[index].pipeline;
    if (!pipeline) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "pipeline",
                             "NULL, accepted a pipeline");
    }
    if (!dip_pass_check(works[index].pass, pipeline->width, pipeline->height, err)) {
        return false;
    }
    for (int i = 0; i < index; i++) {
        if (works[i].pipeline == pipeline || works[i].pipeline->pool != pipeline->pool) {
            return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "pipeline",
                                 "passes %d and %d cannot be drawn at once, accepted different "
                                 "pipelines of one pool",
                                 i, index);
        }
        if (!check_shared_attachments(works, i, index, err)) {
            return false;
        }
    }
    return true;
}

// Checks from which work works[index] copies its pixels.
static bool check_copying(const DipPassWork *works, int count, int index, bool same_geometry,
                          DipError *err) {
    const DipPassWork *from = works[index].copies_from;
    bool good = !from;
    for (int i = 0; i < count && same_geometry; i++) {
        good = good || (from == &works[i] && i != index && !from->copies_from);
    }
    return good || dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "copies_from",
                                 "pass %d cannot copy from it, accepted another pass of the same "
                                 "geometry, drawn at once, that copies from none",
                                 index);
}

// Draws passes that have been checked, with pipelines that no other thread uses.
static bool draw_batch(Batch *batch, DipError *err) {
    const DipPassWork *works = batch->works;
    for (int i = 0; i < batch->count; i++) {
        batch->passes[i] = works[i].pass;
    }
    for (int i = 0; i < batch->count; i++) {
        if (!begin_pass(works[i].pipeline, works[i].pass, batch->passes, batch->count, err)) {
            return false;
        }
    }
    for (int i = 0; i < batch->count; i++) {
        share_shading(&works[i]);
    }
    if (!run_geometries(batch, err)) {
        return false;
    }
    const int64_t begin_ns = dip_clock_ns();
    dip_pool_run(works[0].pipeline->pool, greatest_tile_count(batch), run_tiles, batch);
    add_results(batch, dip_clock_ns() - begin_ns);
    for (int i = 0; i < batch->count; i++) {
        if (!check_shaders(works[i].pipeline, err)) {
            return false;
        }
    }
    return true;
}

// Takes the pipelines for this thread. Fails if another thread is drawing with one of them.
static bool take(const DipPassWork *works, int count, DipError *err) {
    for (int i = 0; i < count; i++) {
        if (atomic_exchange_explicit(&works[i].pipeline->busy, true, memory_order_acquire)) {
            for (int k = 0; k < i; k++) {
                atomic_store_explicit(&works[k].pipeline->busy, false, memory_order_release);
            }
            return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "pipeline",
                                 "another thread is drawing with it, accepted one thread at a "
                                 "time");
        }
    }
    return true;
}

bool dip_pipeline_draw_passes(const DipPassWork *works, int count, bool same_geometry,
                              DipError *err) {
    DIP_FP_MODE_SCOPE();
    if (!works) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "works", "NULL, accepted a pointer");
    }
    if (count < 1 || count > DIP_MAX_PASSES_AT_ONCE) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "count", "%d passes, accepted 1..%d",
                             count, DIP_MAX_PASSES_AT_ONCE);
    }
    for (int i = 0; i < count; i++) {
        if (!check_work(works, i, err) || !check_copying(works, count, i, same_geometry, err)) {
            return false;
        }
    }
    if (!take(works, count, err)) {
        return false;
    }
    Batch batch = {.works = works, .count = count, .same_geometry = same_geometry};
    const bool drawn = draw_batch(&batch, err);
    for (int i = 0; i < count; i++) {
        atomic_store_explicit(&works[i].pipeline->busy, false, memory_order_release);
    }
    return drawn;
}

bool dip_pipeline_draw(DipPipeline *pipeline, const DipPass *pass, DipPipelineCounters *counters,
                       DipStageTimes *times, DipError *err) {
    const DipPassWork work = {pipeline, pass, counters, times, NULL};
    return dip_pipeline_draw_passes(&work, 1, false, err);
}

void dip_pipeline_record_tiles(DipPipeline *pipeline, const DipTileRecording *recording) {
    pipeline->recording = recording ? *recording : (DipTileRecording){.tiles = NULL};
}

// --- creating and destroying -------------------------------------------------------------------

static bool allocate_parts(DipPipeline *pipeline) {
    pipeline->srgb = malloc(sizeof *pipeline->srgb);
    pipeline->workers = calloc((size_t)pipeline->worker_count, sizeof(DipTileWorker *));
    if (!pipeline->srgb || !pipeline->workers) {
        return false;
    }
    for (int w = 0; w < pipeline->worker_count; w++) {
        pipeline->workers[w] = dip_tile_worker_create(&pipeline->tile_pass);
        if (!pipeline->workers[w]) {
            return false;
        }
    }
    return true;
}

static void set_srgb_tables(DipPipeline *pipeline) {
    DipSrgbDecodeTable decode;
    dip_srgb_encode_table(pipeline->srgb);
    dip_srgb_decode_table(&decode);
    for (int i = 0; i < 256; i++) {
        pipeline->srgb_light[i] = (float)decode.linear[i];
    }
    pipeline->tile_pass.srgb = pipeline->srgb;
    pipeline->tile_pass.srgb_light = pipeline->srgb_light;
    pipeline->tile_pass.merge.srgb = pipeline->srgb;
    pipeline->tile_pass.merge.srgb_light = pipeline->srgb_light;
    pipeline->tile_pass.merge.kernels = pipeline->tile_pass.kernels;
}

DipPipeline *dip_pipeline_create(DipPool *pool, DipIsa isa, int width, int height, DipError *err) {
    DIP_FP_MODE_SCOPE();
    if (width < 1 || height < 1 || width > DIP_MAX_TARGET_SIZE || height > DIP_MAX_TARGET_SIZE) {
        dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "size", "%dx%d pixels, accepted 1x1 to %dx%d",
                      width, height, DIP_MAX_TARGET_SIZE, DIP_MAX_TARGET_SIZE);
        return NULL;
    }
    if (!dip_isa_available(isa)) {
        dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, "isa",
                      "%s is not available on this machine, accepted dip_isa_best()",
                      dip_isa_name(isa));
        return NULL;
    }
    DipPipeline *pipeline = calloc(1, sizeof *pipeline);
    if (pipeline) {
        pipeline->pool = pool;
        pipeline->tile_pass.kernels = dip_kernels(isa);
        pipeline->width = width;
        pipeline->height = height;
        pipeline->worker_count = dip_pool_thread_count(pool);
        pipeline->geometry.tiles_x = (width + DIP_TILE - 1) / DIP_TILE;
        pipeline->geometry.tiles_y = (height + DIP_TILE - 1) / DIP_TILE;
    }
    if (!pipeline || !allocate_parts(pipeline)) {
        dip_pipeline_destroy(&pipeline);
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "pipeline", "out of memory");
        return NULL;
    }
    set_srgb_tables(pipeline);
    return pipeline;
}

void dip_pipeline_destroy(DipPipeline **pipeline_pointer) {
    DipPipeline *pipeline = *pipeline_pointer;
    if (!pipeline) {
        return;
    }
    for (int w = 0; pipeline->workers && w < pipeline->worker_count; w++) {
        dip_tile_worker_destroy(&pipeline->workers[w]);
    }
    dip_geometry_free(&pipeline->geometry);
    free(pipeline->is_ordered);
    free(pipeline->workers);
    free(pipeline->srgb);
    free(pipeline);
    *pipeline_pointer = NULL;
}
