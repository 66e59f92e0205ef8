// Adds up the work and the times of a pass whose tiles have been drawn.
#include "renderer/pipeline/run/pass_results.h"

#include "renderer/pipeline/merge/merge_tile.h"

static void add_geometry_counters(const DipGeometry *geometry, DipPipelineCounters *counters) {
    counters->draws_in_view += geometry->draws_in_view;
    counters->draws_culled += geometry->draws_culled;
    for (int j = 0; j < geometry->job_count; j++) {
        counters->triangles_in += geometry->jobs[j].triangles_in;
        counters->triangles_drawn += geometry->jobs[j].triangles_drawn;
        counters->tile_triangles += geometry->jobs[j].tile_triangles;
    }
}

static void add_counters(const DipPipelineCounters *from, DipPipelineCounters *to) {
#define DIP_ADD_COUNTER(name, text) to->name += from->name;
    DIP_PIPELINE_COUNTER_LIST(DIP_ADD_COUNTER)
#undef DIP_ADD_COUNTER
    for (int i = 0; i < DIP_SHADER_COUNT_MAX; i++) {
        to->shader_counts[i] += from->shader_counts[i];
    }
}

void dip_tile_record_add(const DipTileRecord *from, DipTileRecord *to) {
    add_counters(&from->counters, &to->counters);
    to->raster_ns += from->raster_ns;
    to->shading_ns += from->shading_ns;
    to->resolve_ns += from->resolve_ns;
}

int64_t dip_tile_record_ns(const DipTileRecord *record) {
    return record->raster_ns + record->shading_ns + record->resolve_ns;
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

void dip_pass_add_counters(const DipPass *pass, const DipGeometry *geometry,
                           const DipTileRecord *tiles, DipPipelineCounters *counters) {
    counters->passes++;
    counters->target_bytes +=
        stored_bytes(pass) * (uint64_t)pass->target.width * (uint64_t)pass->target.height;
    counters->tiles_spared += dip_geometry_tiles(geometry) - (uint64_t)geometry->tile_count;
    add_geometry_counters(geometry, counters);
    add_counters(&tiles->counters, counters);
}

void dip_pass_add_times(const DipTileRecord *tiles, int64_t geometry_ns, double tile_scale,
                        DipStageTimes *times) {
    times->geometry_ms += 1e-6 * (double)geometry_ns;
    times->raster_ms += tile_scale * (double)tiles->raster_ns;
    times->shading_ms += tile_scale * (double)tiles->shading_ns;
    times->resolve_ms += tile_scale * (double)tiles->resolve_ns;
    times->total_ms += 1e-6 * (double)geometry_ns + tile_scale * (double)dip_tile_record_ns(tiles);
}
