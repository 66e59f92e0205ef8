// Adds up the work and the times of a pass whose tiles have been drawn.
#include "renderer/pipeline/run/pass_results.h"

static void add_geometry_counters(const DipGeometry *geometry, DipPipelineCounters *counters) {
    counters->draws_in_view += geometry->draws_in_view;
    counters->draws_culled += geometry->draws_culled;
    for (int j = 0; j < geometry->job_count; j++) {
        counters->triangles_in += geometry->jobs[j].triangles_in;
        counters->triangles_drawn += geometry->jobs[j].triangles_drawn;
        counters->tile_triangles += geometry->jobs[j].tile_triangles;
    }
}

static void add_tile_counters(const DipTileWork *work, DipPipelineCounters *counters) {
    counters->sub_blocks_tested += work->sub_blocks_tested;
    counters->sub_blocks_accepted += work->sub_blocks_accepted;
    counters->fragments_clip_tested += work->clip_tested;
    counters->clip_sample_groups += work->clip_sample_groups;
    counters->fragments_shaded += work->fragments;
    counters->fragments_copied += work->copied_fragments;
    counters->fragments_of_blocks += work->block_fragments;
    counters->shader_batches += work->batches;
    counters->fragments_ordered += work->ordered_fragments;
    counters->samples_shown += work->samples;
    counters->pixels_resolved += work->multi_fragment_pixels;
    counters->texture_probes += work->sampling.probes;
    counters->clip_probes += work->clip_probes;
    counters->texels_fetched += work->sampling.texels;
    for (int i = 0; i < DIP_SHADER_COUNT_MAX; i++) {
        counters->shader_counts[i] += work->sampling.counts[i];
    }
}

// Returns the bytes that the pass writes to each pixel of its target.
static uint64_t stored_bytes(const DipPass *pass) {
    if (!dip_pass_stores_target(pass)) {
        return 0;
    }
    switch (pass->target.format) {
    case DIP_FORMAT_RGBA32F:
        return 16;
    case DIP_FORMAT_CALLER:
        return 0; // the caller's memory is not known
    default:
        return 4;
    }
}

void dip_pass_add_counters(const DipTilePass *tile_pass, const DipTileWork *work,
                           DipPipelineCounters *counters) {
    const DipTarget *target = &tile_pass->pass->target;
    const DipGeometry *geometry = tile_pass->geometry;
    const int tiles = geometry->tile_count;
    counters->passes++;
    counters->target_bytes +=
        stored_bytes(tile_pass->pass) * (uint64_t)target->width * (uint64_t)target->height;
    counters->tiles_drawn += (uint64_t)tiles;
    counters->tiles_spared += dip_geometry_tiles(geometry) - (uint64_t)tiles;
    add_geometry_counters(geometry, counters);
    for (int t = 0; t < tiles; t++) {
        add_tile_counters(&work[geometry->tiles[t]], counters);
    }
}

void dip_pass_record_tiles(const DipTilePass *tile_pass, const DipTileWork *work,
                           DipTileRecord *records) {
    const DipGeometry *geometry = tile_pass->geometry;
    for (int t = 0; t < geometry->tile_count; t++) {
        const int index = geometry->tiles[t];
        records[index].counters.tiles_drawn = 1;
        add_tile_counters(&work[index], &records[index].counters);
        records[index].raster_ns = work[index].stage_ns[DIP_TILE_STAGE_RASTER];
        records[index].shading_ns = work[index].stage_ns[DIP_TILE_STAGE_SHADING];
        records[index].resolve_ns = work[index].stage_ns[DIP_TILE_STAGE_RESOLVE];
    }
}

DipStageSums dip_pass_sum_stages(const DipTilePass *tile_pass, const DipTileWork *work) {
    const DipGeometry *geometry = tile_pass->geometry;
    DipStageSums sums = {.total_ns = 0};
    for (int t = 0; t < geometry->tile_count; t++) {
        const int64_t *stage_ns = work[geometry->tiles[t]].stage_ns;
        for (int s = 0; s < DIP_TILE_STAGE_COUNT; s++) {
            sums.ns[s] += stage_ns[s];
            sums.total_ns += stage_ns[s];
        }
    }
    return sums;
}

void dip_pass_add_times(const DipStageSums *sums, int64_t geometry_ns, double tile_scale,
                        DipStageTimes *times) {
    times->geometry_ms += 1e-6 * (double)geometry_ns;
    times->raster_ms += tile_scale * (double)sums->ns[DIP_TILE_STAGE_RASTER];
    times->shading_ms += tile_scale * (double)sums->ns[DIP_TILE_STAGE_SHADING];
    times->resolve_ms += tile_scale * (double)sums->ns[DIP_TILE_STAGE_RESOLVE];
    times->total_ms += 1e-6 * (double)geometry_ns + tile_scale * (double)sums->total_ns;
}
