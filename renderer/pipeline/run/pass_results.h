// What a pass did: its counters and its times, from the records of the tiles that were drawn.
#ifndef DIP_RENDERER_PIPELINE_RUN_PASS_RESULTS_H
#define DIP_RENDERER_PIPELINE_RUN_PASS_RESULTS_H

#include "renderer/pipeline/geometry/geometry.h"
#include "renderer/pipeline/pipeline.h"

// Adds the counters and times of a record to those of another.
void dip_tile_record_add(const DipTileRecord *from, DipTileRecord *to);

// Returns the time of all stages of a record, in nanoseconds.
int64_t dip_tile_record_ns(const DipTileRecord *record);

// Adds the work of a pass to counters. tiles: the sum of the records of the tiles that were drawn.
void dip_pass_add_counters(const DipPass *pass, const DipGeometry *geometry,
                           const DipTileRecord *tiles, DipPipelineCounters *counters);

// Adds the times of a pass. tile_scale: milliseconds of wall-clock time per nanosecond in `tiles`.
void dip_pass_add_times(const DipTileRecord *tiles, int64_t geometry_ns, double tile_scale,
                        DipStageTimes *times);

#endif
