// The scenes of draw states, drawn by our pipeline.
#ifndef DIP_TESTS_PEER_STATES_OURS_H
#define DIP_TESTS_PEER_STATES_OURS_H

#include "renderer/pipeline/pipeline.h"
#include "tests/peer/states_scenes.h"

typedef struct DipStatesOurs {
    const DipStatesData *data;
    DipPool *pool;
    DipPipeline *pipeline;
    DipPipeline *map_pipeline;
    DipDepth *map;
    DipMesh *meshes[2];
    int width;
    int height;
    int sample_count;
    uint8_t *rgba8;               // owned
    DipPipelineCounters counters; // of the last frame
} DipStatesOurs;

bool dip_states_ours_open(DipStatesOurs *ours, const DipStatesData *data, int width, int height,
                          int sample_count, int threads, DipError *err);
bool dip_states_ours_draw(DipStatesOurs *ours, DipError *err);
void dip_states_ours_close(DipStatesOurs *ours);

#endif
