// The pipeline: runs the geometry jobs, then the tiles, and adds up what they did.
#include "renderer/pipeline/pipeline.h"

#include "renderer/base/assert.h"
#include "renderer/base/clock.h"
#include "renderer/base/srgb.h"
#include "renderer/pipeline/geometry/geometry.h"
#include "renderer/pipeline/geometry/visit.h"
#include "renderer/pipeline/kernels/kernels.h"
#include "renderer/pipeline/resolve/resolve.h"
#include "renderer/pipeline/shading/tile_shading.h"

#include <stdlib.h>
#include <string.h>

enum { CACHE_LINE = 64 };

// The parts of a tile's work that are timed.
typedef enum TileStage { STAGE_RASTER, STAGE_SHADING, STAGE_RESOLVE, STAGE_COUNT } TileStage;

// What one tile did; added up in tile order after the phase.
typedef struct TileWork {
    DipSampleWork sampling;
    uint64_t sub_blocks_tested;
    uint64_t sub_blocks_accepted;
    uint64_t clip_tested;
    uint64_t clip_passes;
    uint64_t fragments;
    uint64_t samples;
    uint64_t mixed;
    int64_t stage_ns[STAGE_COUNT];
} TileWork;

// Everything a worker writes while it runs jobs and tiles.
typedef struct Worker {
    DipPipeline *pipeline;
    DipGeometryScratch geometry;
    DipTile tile;
    DipTileShading shading;
    DipFragmentBatch batch;
    DipFragmentBatch clip_batch;
    DipFragmentList clip_list;
    DipEncodedBatch encoded;
    TileWork *work; // of the tile in hand
} Worker;

struct DipPipeline {
    DipPool *pool;
    const DipKernels *kernels;
    int width;
    int height;
    int worker_count;
    Worker **workers; // each allocated apart, so that they share no cache line
    DipGeometry geometry;
    TileWork *tile_work;
    int draw_room; // lists per worker
    DipSrgbEncodeTable *srgb;
    float srgb_light[256]; // of the codes
    const DipPass *pass;
    const DipSamplePattern *pattern;
    const DipGeometry *drawn; // of this pipeline, or of another that draws the same
    DipSamplePasses passes_made;
    const DipSamplePasses *passes; // NULL: alpha-clipped draws have one pass
    uint32_t clear_rgba8;
    int32_t clear_linear16[3];
};

static void *allocate_aligned(size_t size_bytes) {
    void *memory =
        aligned_alloc(CACHE_LINE, (size_bytes + CACHE_LINE - 1) / CACHE_LINE * CACHE_LINE);
    if (memory) {
        memset(memory, 0, size_bytes);
    }
    return memory;
}

// --- one tile ----------------------------------------------------------------------------------

// Fills a list's tail with its last fragment, so that vectors read valid triangles.
static void pad_list(DipFragmentList *list) {
    const int last = list->count - 1;
    for (int i = list->count; i % DIP_BATCH_ALIGN; i++) {
        list->triangle[i] = list->triangle[last];
        list->place[i] = list->place[last];
    }
}

static void bind_batch(const Worker *worker, const DipDraw *draw, DipFragmentBatch *batch) {
    batch->samplers = draw->samplers;
    batch->uniforms = draw->uniforms;
    batch->sample_colour = worker->pipeline->kernels->dip_kernel_sample_colour;
    batch->sample_colours = worker->pipeline->kernels->dip_kernel_sample_colours;
    batch->sample_alpha = worker->pipeline->kernels->dip_kernel_sample_alpha;
    batch->sample_target = worker->pipeline->kernels->dip_kernel_sample_target;
    batch->srgb_light = worker->pipeline->srgb_light;
}

// Shades the first fragments of a list, at most a batch, into the worker's encoded batch.
static int shade_batch(Worker *worker, uint32_t draw_index, DipFragmentList *list) {
    const DipPipeline *pipeline = worker->pipeline;
    const DipDraw *draw = &pipeline->pass->draws[draw_index];
    DipFragmentBatch *batch = &worker->batch;
    pad_list(list);
    pipeline->kernels->dip_kernel_interpolate(&worker->shading.input, list, draw->slot_count,
                                              draw->plain_slot_count, batch);
    bind_batch(worker, draw, batch);
    draw->fragment_shader(batch);
    pipeline->kernels->dip_kernel_encode(batch, pipeline->srgb->code, &worker->encoded);
    worker->shading.fragments += (uint64_t)batch->count;
    return batch->count;
}

static void flush_list(DipTileShading *shading, uint32_t draw) {
    Worker *worker = shading->context;
    DipFragmentList *list = &shading->lists[draw];
    const int count = shade_batch(worker, draw, list);
    dip_store_fragments(shading, list, count, &worker->encoded);
    list->count -= count;
    const size_t left = (size_t)list->count;
    memcpy(list->triangle, list->triangle + count, left * sizeof *list->triangle);
    memcpy(list->place, list->place + count, left * sizeof *list->place);
    memcpy(list->samples, list->samples + count, left * sizeof *list->samples);
}

static void flush_whole_list(DipTileShading *shading, uint32_t draw) {
    Worker *worker = shading->context;
    DipFragmentList *list = &shading->whole_lists[draw];
    shade_batch(worker, draw, list);
    dip_store_whole(shading, list, &worker->encoded);
    list->count = 0;
}

// The clip shader's verdict on the fragments in the worker's clip list.
static const uint8_t *clip_test(void *context, const DipTriangle *triangle) {
    Worker *worker = context;
    const DipPipeline *pipeline = worker->pipeline;
    const DipDraw *draw = &pipeline->pass->draws[triangle->draw];
    DipFragmentBatch *batch = &worker->clip_batch;
    pipeline->kernels->dip_kernel_interpolate(&worker->shading.input, &worker->clip_list,
                                              draw->clip_slot_count, 0, batch);
    bind_batch(worker, draw, batch);
    draw->clip_shader(batch);
    worker->work->clip_tested += (uint64_t)worker->clip_list.count;
    return batch->keep;
}

// Of alpha-clipped draws.
static int pass_count(const DipPipeline *pipeline) {
    return pipeline->passes ? pipeline->passes->count : 1;
}

static void draw_triangle(void *context, uint32_t index) {
    Worker *worker = context;
    const DipPipeline *pipeline = worker->pipeline;
    const DipTriangle *triangle = &pipeline->drawn->triangles[index];
    const DipClipTest clip = {&worker->clip_list, clip_test, worker, pipeline->passes};
    const bool clipped = pipeline->pass->draws[triangle->draw].clip_shader != NULL;
    worker->work->clip_passes += clipped ? (uint64_t)pass_count(pipeline) : 0;
    pipeline->kernels->dip_kernel_draw_triangle(&worker->tile, triangle, index + 1,
                                                clipped ? &clip : NULL);
}

static int greatest(int a, int b) {
    return a > b ? a : b;
}

// What of the tile is not drawn.
static void set_margins(const DipRegion *region, const DipTilePart *part, DipTile *tile) {
    static const DipTilePart whole = {0, 0, DIP_TILE, DIP_TILE};
    part = part ? part : &whole;
    tile->left = greatest(region->x0 - tile->x0, part->x0);
    tile->top = greatest(region->y0 - tile->y0, part->y0);
    tile->right = greatest(tile->x0 + DIP_TILE - region->x1, DIP_TILE - part->x1);
    tile->bottom = greatest(tile->y0 + DIP_TILE - region->y1, DIP_TILE - part->y1);
}

static void begin_tile(Worker *worker, int index) {
    const DipPipeline *pipeline = worker->pipeline;
    const DipGeometry *geometry = pipeline->drawn;
    const DipTarget *target = &pipeline->pass->target;
    DipTile *tile = &worker->tile;
    tile->x0 = index % geometry->tiles_x * DIP_TILE;
    tile->y0 = index / geometry->tiles_x * DIP_TILE;
    const DipTilePart *parts = pipeline->pass->tile_parts;
    set_margins(&geometry->region, parts ? &parts[index] : NULL, tile);
    tile->pattern = pipeline->pattern;
    tile->touched = 0;
    tile->passed = 0;
    tile->sub_blocks_tested = 0;
    tile->sub_blocks_accepted = 0;
    DipTileShading *shading = &worker->shading;
    shading->tile = tile;
    shading->input = (DipShadingInput){geometry->triangles, geometry->surfaces,
                                       geometry->surface_stride, tile->x0, tile->y0};
    shading->draws = pipeline->pass->draws;
    shading->passes = pipeline->passes;
    shading->flush = flush_list;
    shading->flush_whole = flush_whole_list;
    shading->context = worker;
    shading->width = target->width - tile->x0 < DIP_TILE ? target->width - tile->x0 : DIP_TILE;
    shading->height = target->height - tile->y0 < DIP_TILE ? target->height - tile->y0 : DIP_TILE;
    shading->stride = target->stride_bytes / 4;
    shading->pixels =
        (uint32_t *)(void *)target->rgba8 + (size_t)tile->y0 * shading->stride + (size_t)tile->x0;
    shading->clear_rgba8 = pipeline->clear_rgba8;
    memcpy(shading->clear_linear16, pipeline->clear_linear16, sizeof shading->clear_linear16);
    shading->mixed_count = 0;
    shading->fragments = 0;
    shading->samples = 0;
    worker->batch.work = (DipSampleWork){0};
    worker->clip_batch.work = (DipSampleWork){0};
}

static void shade_tile(Worker *worker) {
    DipTileShading *shading = &worker->shading;
    worker->pipeline->kernels->dip_kernel_collect(shading);
    for (int i = 0; i < shading->active_count; i++) {
        const uint32_t draw = shading->active[i];
        if (shading->whole_lists[draw].count) {
            flush_whole_list(shading, draw);
        }
        if (shading->lists[draw].count) {
            flush_list(shading, draw);
        }
        shading->is_active[draw] = 0;
    }
    shading->active_count = 0;
}

static void run_tile(DipPipeline *pipeline, int tile, int worker_index) {
    const int index = pipeline->drawn->tiles[tile];
    Worker *worker = pipeline->workers[worker_index];
    TileWork *work = &pipeline->tile_work[index];
    *work = (TileWork){0};
    worker->work = work;
    const int64_t begin = dip_clock_ns();
    begin_tile(worker, index);
    dip_geometry_visit(pipeline->drawn, index, draw_triangle, worker);
    const int64_t covered = dip_clock_ns();
    shade_tile(worker);
    const int64_t shaded = dip_clock_ns();
    dip_resolve_mixed(&worker->shading, pipeline->srgb->code);
    const int64_t resolved = dip_clock_ns();
    work->stage_ns[STAGE_RASTER] = covered - begin;
    work->stage_ns[STAGE_SHADING] = shaded - covered;
    work->stage_ns[STAGE_RESOLVE] = resolved - shaded;
    work->sub_blocks_tested = worker->tile.sub_blocks_tested;
    work->sub_blocks_accepted = worker->tile.sub_blocks_accepted;
    work->fragments = worker->shading.fragments;
    work->samples = worker->shading.samples;
    work->mixed = (uint64_t)worker->shading.mixed_count;
    work->sampling.probes = worker->batch.work.probes + worker->clip_batch.work.probes;
    work->sampling.texels = worker->batch.work.texels + worker->clip_batch.work.texels;
    work->sampling.normal_mapped = worker->batch.work.normal_mapped;
    work->sampling.sky = worker->batch.work.sky;
    work->sampling.reflecting = worker->batch.work.reflecting;
}

// --- one pass ----------------------------------------------------------------------------------

static void run_job(void *context, int index, int worker_index) {
    DipPipeline *pipeline = context;
    dip_geometry_run_job(&pipeline->geometry, pipeline->kernels, index,
                         &pipeline->workers[worker_index]->geometry);
}

static bool run_geometry(DipPipeline *pipeline, const DipPass *pass, const DipPass *also,
                         DipError *err) {
    do {
        if (!dip_geometry_begin(&pipeline->geometry, pass, also, err)) {
            return false;
        }
        dip_pool_run(pipeline->pool, pipeline->geometry.job_count, run_job, pipeline);
    } while (dip_geometry_grow_after_overflow(&pipeline->geometry));
    return true;
}

static void add_counters(const DipPipeline *pipeline, DipCounters *counters) {
    const DipTarget *target = &pipeline->pass->target;
    counters->target_bytes += 4 * (uint64_t)target->width * (uint64_t)target->height;
    const DipGeometry *geometry = pipeline->drawn;
    for (int j = 0; j < geometry->job_count; j++) {
        counters->triangles_in += geometry->jobs[j].triangles_in;
        counters->triangles_drawn += geometry->jobs[j].triangles_drawn;
        counters->tile_triangles += geometry->jobs[j].tile_triangles;
    }
    const int tiles = geometry->tile_count;
    counters->passes++;
    counters->tiles_drawn += (uint64_t)tiles;
    counters->tiles_spared += dip_geometry_tiles(geometry) - (uint64_t)tiles;
    for (int t = 0; t < tiles; t++) {
        const TileWork *work = &pipeline->tile_work[geometry->tiles[t]];
        counters->sub_blocks_tested += work->sub_blocks_tested;
        counters->sub_blocks_accepted += work->sub_blocks_accepted;
        counters->fragments_clip_tested += work->clip_tested;
        counters->clip_passes += work->clip_passes;
        counters->fragments_shaded += work->fragments;
        counters->samples_shown += work->samples;
        counters->pixels_resolved += work->mixed;
        counters->texture_probes += work->sampling.probes;
        counters->texels_fetched += work->sampling.texels;
        counters->fragments_normal_mapped += work->sampling.normal_mapped;
        counters->fragments_sky += work->sampling.sky;
        counters->fragments_reflecting += work->sampling.reflecting;
    }
}

// The stages of a pipeline's tiles, summed over the workers.
typedef struct StageSums {
    int64_t ns[STAGE_COUNT];
    int64_t total_ns;
} StageSums;

static StageSums sum_stages(const DipPipeline *pipeline) {
    StageSums sums = {0};
    for (int t = 0; t < pipeline->drawn->tile_count; t++) {
        const TileWork *work = &pipeline->tile_work[pipeline->drawn->tiles[t]];
        for (int s = 0; s < STAGE_COUNT; s++) {
            sums.ns[s] += work->stage_ns[s];
            sums.total_ns += work->stage_ns[s];
        }
    }
    return sums;
}

// tile_scale: milliseconds of wall time per nanosecond of the workers' sums.
static void add_times(const StageSums *sums, int64_t geometry_ns, double tile_scale,
                      DipStageTimes *times) {
    times->geometry_ms += 1e-6 * (double)geometry_ns;
    times->raster_ms += tile_scale * (double)sums->ns[STAGE_RASTER];
    times->shading_ms += tile_scale * (double)sums->ns[STAGE_SHADING];
    times->resolve_ms += tile_scale * (double)sums->ns[STAGE_RESOLVE];
    times->total_ms += 1e-6 * (double)geometry_ns + tile_scale * (double)sums->total_ns;
}

static void set_clear(DipPipeline *pipeline, const float clear_lin[3]) {
    pipeline->clear_rgba8 = 0xff000000u;
    for (int c = 0; c < 3; c++) {
        const float light =
            clear_lin[c] > 0.0f ? (clear_lin[c] < 1.0f ? clear_lin[c] : 1.0f) : 0.0f;
        pipeline->clear_linear16[c] = (int32_t)(light * 65535.0f + 0.5f);
        pipeline->clear_rgba8 |= (uint32_t)pipeline->srgb->code[pipeline->clear_linear16[c]]
                                 << (8 * c);
    }
}

static void set_passes(DipPipeline *pipeline, const DipPass *pass) {
    pipeline->passes = NULL;
    if (pass->samples_per_pass && pass->samples_per_pass < pass->sample_count) {
        DIP_ASSERT(dip_sample_passes_exist(pass->sample_count, pass->samples_per_pass));
        dip_sample_passes_make(&pipeline->passes_made,
                               dip_sample_pattern_of(pass->sample_count, pass->pattern),
                               pass->samples_per_pass);
        pipeline->passes = &pipeline->passes_made;
    }
}

// Lists are kept per draw; more draws than ever before need more of them.
static bool make_lists(DipPipeline *pipeline, int draw_count, DipError *err) {
    if (draw_count <= pipeline->draw_room) {
        return true;
    }
    pipeline->draw_room = 0;
    for (int w = 0; w < pipeline->worker_count; w++) {
        DipTileShading *shading = &pipeline->workers[w]->shading;
        free(shading->lists);
        free(shading->whole_lists);
        free(shading->active);
        free(shading->is_active);
        shading->lists = calloc((size_t)draw_count, sizeof *shading->lists);
        shading->whole_lists = calloc((size_t)draw_count, sizeof *shading->whole_lists);
        shading->active = calloc((size_t)draw_count, sizeof *shading->active);
        shading->is_active = calloc((size_t)draw_count, sizeof *shading->is_active);
        if (!shading->lists || !shading->whole_lists || !shading->active || !shading->is_active) {
            return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "pass", "no memory for %d draws",
                                 draw_count);
        }
    }
    pipeline->draw_room = draw_count;
    return true;
}

bool dip_pipeline_reserve(DipPipeline *pipeline, const DipPass *pass, DipError *err) {
    return make_lists(pipeline, pass->draw_count, err) &&
           dip_geometry_reserve(&pipeline->geometry, pass, err);
}

static void check_pass(const DipPipeline *pipeline, const DipPass *pass) {
    DIP_ASSERT(pass->target.width == pipeline->width && pass->target.height == pipeline->height);
    DIP_ASSERT(pass->target.stride_bytes % 4 == 0);
    DIP_ASSERT(pass->target.stride_bytes >= 4 * (size_t)pass->target.width);
    DIP_ASSERT(pass->clip_plane_count >= 0 && pass->clip_plane_count <= DIP_MAX_CLIP_PLANES);
    DIP_ASSERT(pass->region.x0 >= 0 && pass->region.x1 <= pass->target.width);
    DIP_ASSERT(pass->region.y0 >= 0 && pass->region.y1 <= pass->target.height);
    DIP_ASSERT(!pass->region.x1 ||
               (pass->region.x0 < pass->region.x1 && pass->region.y0 < pass->region.y1));
    for (int d = 0; d < pass->draw_count; d++) {
        DIP_ASSERT(pass->draws[d].slot_count >= 0 && pass->draws[d].slot_count <= DIP_MAX_SLOTS);
        DIP_ASSERT(pass->draws[d].plain_slot_count >= 0 &&
                   pass->draws[d].plain_slot_count <= pass->draws[d].slot_count);
    }
}

static bool begin_pass(DipPipeline *pipeline, const DipPass *pass, DipError *err) {
    check_pass(pipeline, pass);
    if (!make_lists(pipeline, pass->draw_count, err)) {
        return false;
    }
    pipeline->pass = pass;
    pipeline->pattern = dip_sample_pattern_of(pass->sample_count, pass->pattern);
    pipeline->drawn = &pipeline->geometry;
    set_clear(pipeline, pass->clear_lin);
    set_passes(pipeline, pass);
    return true;
}

// Passes that are drawn at once.
typedef struct Passes {
    const DipPassWork *works;
    int count;
} Passes;

// One tile of each, in turn first, so that what one finds in the caches is fair.
static void run_tiles(void *context, int tile, int worker_index) {
    const Passes *passes = context;
    for (int i = 0; i < passes->count; i++) {
        DipPipeline *pipeline = passes->works[(tile + i) % passes->count].pipeline;
        if (tile < pipeline->drawn->tile_count) {
            run_tile(pipeline, tile, worker_index);
        }
    }
}

// The geometry of each pass, or of the first for all; geometry_ns: what each took.
static bool run_geometries(const Passes *passes, bool shared, int64_t *geometry_ns, DipError *err) {
    for (int i = 0; i < passes->count; i++) {
        const DipPassWork *work = &passes->works[i];
        if (shared && i) {
            work->pipeline->drawn = passes->works[0].pipeline->drawn;
            geometry_ns[i] = geometry_ns[0];
            continue;
        }
        const DipPass *also = shared && passes->count > 1 ? passes->works[1].pass : NULL;
        const int64_t begin_ns = dip_clock_ns();
        if (!run_geometry(work->pipeline, work->pass, also, err)) {
            return false;
        }
        geometry_ns[i] = dip_clock_ns() - begin_ns;
    }
    return true;
}

static bool draw_passes(const Passes *passes, bool shared, DipError *err) {
    enum { MOST = 2 };
    for (int i = 0; i < passes->count; i++) {
        if (!begin_pass(passes->works[i].pipeline, passes->works[i].pass, err)) {
            return false;
        }
    }
    int64_t geometry_ns[MOST];
    if (!run_geometries(passes, shared, geometry_ns, err)) {
        return false;
    }
    int tiles = 0;
    for (int i = 0; i < passes->count; i++) {
        tiles = greatest(tiles, passes->works[i].pipeline->drawn->tile_count);
    }
    const int64_t begin_ns = dip_clock_ns();
    dip_pool_run(passes->works[0].pipeline->pool, tiles, run_tiles, (void *)passes);
    const int64_t tiles_ns = dip_clock_ns() - begin_ns;
    StageSums sums[MOST];
    int64_t sum_ns = 0;
    for (int i = 0; i < passes->count; i++) {
        sums[i] = sum_stages(passes->works[i].pipeline);
        sum_ns += sums[i].total_ns;
    }
    const double scale = sum_ns ? 1e-6 * (double)tiles_ns / (double)sum_ns : 0.0;
    for (int i = 0; i < passes->count; i++) {
        const DipPassWork *work = &passes->works[i];
        add_counters(work->pipeline, work->counters);
        add_times(&sums[i], geometry_ns[i], scale, work->times);
    }
    return true;
}

bool dip_pipeline_draw(DipPipeline *pipeline, const DipPass *pass, DipCounters *counters,
                       DipStageTimes *times, DipError *err) {
    const DipPassWork work = {pipeline, pass, counters, times};
    const Passes passes = {&work, 1};
    return draw_passes(&passes, false, err);
}

bool dip_pipeline_draw_pair(const DipPassWork works[2], bool same_geometry, DipError *err) {
    DIP_ASSERT(works[0].pipeline != works[1].pipeline);
    DIP_ASSERT(works[0].pipeline->pool == works[1].pipeline->pool);
    const Passes passes = {works, 2};
    return draw_passes(&passes, same_geometry, err);
}

// --- making and ending -------------------------------------------------------------------------

static Worker *create_worker(DipPipeline *pipeline) {
    Worker *worker = allocate_aligned(sizeof *worker);
    if (!worker) {
        return NULL;
    }
    const size_t samples = (size_t)DIP_TILE_PIXELS * DIP_MAX_SAMPLES;
    worker->pipeline = pipeline;
    worker->tile.depth = allocate_aligned(samples * sizeof *worker->tile.depth);
    worker->tile.id = allocate_aligned(samples * sizeof *worker->tile.id);
    worker->shading.sum = allocate_aligned(DIP_TILE_PIXELS * sizeof *worker->shading.sum);
    worker->shading.mixed = allocate_aligned(DIP_TILE_PIXELS * sizeof *worker->shading.mixed);
    return worker;
}

static bool worker_complete(const Worker *worker) {
    return worker && worker->tile.depth && worker->tile.id && worker->shading.sum &&
           worker->shading.mixed;
}

static void destroy_worker(Worker *worker) {
    if (worker) {
        free(worker->tile.depth);
        free(worker->tile.id);
        free(worker->shading.sum);
        free(worker->shading.mixed);
        free(worker->shading.lists);
        free(worker->shading.whole_lists);
        free(worker->shading.active);
        free(worker->shading.is_active);
        free(worker);
    }
}

static bool allocate_parts(DipPipeline *pipeline) {
    const size_t tiles = (size_t)pipeline->geometry.tiles_x * (size_t)pipeline->geometry.tiles_y;
    pipeline->tile_work = calloc(tiles, sizeof *pipeline->tile_work);
    pipeline->srgb = malloc(sizeof *pipeline->srgb);
    pipeline->workers = calloc((size_t)pipeline->worker_count, sizeof *pipeline->workers);
    if (!pipeline->tile_work || !pipeline->srgb || !pipeline->workers) {
        return false;
    }
    for (int w = 0; w < pipeline->worker_count; w++) {
        pipeline->workers[w] = create_worker(pipeline);
        if (!worker_complete(pipeline->workers[w])) {
            return false;
        }
    }
    return true;
}

DipPipeline *dip_pipeline_create(DipPool *pool, DipIsa isa, int width, int height, DipError *err) {
    if (width < 1 || height < 1 || width > DIP_MAX_FRAME_SIZE || height > DIP_MAX_FRAME_SIZE) {
        dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "size", "%dx%d pixels, accepted 1x1 to %dx%d",
                      width, height, DIP_MAX_FRAME_SIZE, DIP_MAX_FRAME_SIZE);
        return NULL;
    }
    if (!dip_isa_available(isa)) {
        dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, "isa",
                      "%s is not available on this machine", dip_isa_name(isa));
        return NULL;
    }
    DipPipeline *pipeline = calloc(1, sizeof *pipeline);
    if (pipeline) {
        pipeline->pool = pool;
        pipeline->kernels = dip_kernels(isa);
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
    dip_srgb_encode_table(pipeline->srgb);
    DipSrgbDecodeTable decode;
    dip_srgb_decode_table(&decode);
    for (int i = 0; i < 256; i++) {
        pipeline->srgb_light[i] = (float)decode.linear[i];
    }
    return pipeline;
}

void dip_pipeline_destroy(DipPipeline **pipeline_pointer) {
    DipPipeline *pipeline = *pipeline_pointer;
    if (!pipeline) {
        return;
    }
    for (int w = 0; pipeline->workers && w < pipeline->worker_count; w++) {
        destroy_worker(pipeline->workers[w]);
    }
    dip_geometry_free(&pipeline->geometry);
    free(pipeline->workers);
    free(pipeline->tile_work);
    free(pipeline->srgb);
    free(pipeline);
    *pipeline_pointer = NULL;
}
