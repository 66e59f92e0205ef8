// What a pass did: its counters, the records of its tiles, and its times. Each function is given
// the pass that was drawn and the work of all tiles of its target.
#ifndef DIP_RENDERER_PIPELINE_RUN_PASS_RESULTS_H
#define DIP_RENDERER_PIPELINE_RUN_PASS_RESULTS_H

#include "renderer/pipeline/pipeline.h"
#include "renderer/pipeline/run/tile_worker.h"

// Adds the work of a pass to counters.
void dip_pass_add_counters(const DipTilePass *tile_pass, const DipTileWork *work,
                           DipPipelineCounters *counters);

// Writes the records of the tiles that were drawn. The other records stay as they are.
void dip_pass_record_tiles(const DipTilePass *tile_pass, const DipTileWork *work,
                           DipTileRecord *records);

// The time of each stage, summed over a pass's tiles on all workers.
typedef struct DipStageSums {
    int64_t ns[DIP_TILE_STAGE_COUNT];
    int64_t total_ns;
} DipStageSums;

DipStageSums dip_pass_sum_stages(const DipTilePass *tile_pass, const DipTileWork *work);

// Adds the times of a pass. tile_scale: milliseconds of wall-clock time per nanosecond in `sums`.
void dip_pass_add_times(const DipStageSums *sums, int64_t geometry_ns, double tile_scale,
                        DipStageTimes *times);

#endif
