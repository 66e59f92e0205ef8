// Counts what a frame did: the sums of its passes, and what the pipeline does not know of.
#include "renderer/scene/draw/frame_counters.h"

#include "renderer/scene/resources/scene_layout.h"

// Converts the passes' counters to a frame's counters.
static DipCounters convert(const DipPipelineCounters *passes) {
    DipCounters counters = {
        .fragments_lit = passes->shader_counts[DIP_SHADER_COUNT_LIT],
        .fragments_normal_mapped = passes->shader_counts[DIP_SHADER_COUNT_NORMAL_MAPPED],
        .fragments_pbr = passes->shader_counts[DIP_SHADER_COUNT_PBR],
        .fragments_occluded = passes->shader_counts[DIP_SHADER_COUNT_OCCLUDED],
        .fragments_emitting = passes->shader_counts[DIP_SHADER_COUNT_EMITTING],
        .fragments_coated = passes->shader_counts[DIP_SHADER_COUNT_COATED],
        .fragments_surrounded = passes->shader_counts[DIP_SHADER_COUNT_SURROUNDED],
        .fragments_sheen = passes->shader_counts[DIP_SHADER_COUNT_SHEEN],
        .fragments_transmitting = passes->shader_counts[DIP_SHADER_COUNT_TRANSMITTING],
        .fragments_scattering = passes->shader_counts[DIP_SHADER_COUNT_SCATTERING],
        .fragments_shadowed = passes->shader_counts[DIP_SHADER_COUNT_SHADOWED],
        .fragments_blended = passes->fragments_ordered, // all ordered draws of a scene blend
        .fragments_sky = passes->shader_counts[DIP_SHADER_COUNT_SKY],
        .fragments_reflecting = passes->shader_counts[DIP_SHADER_COUNT_REFLECTING],
    };
#define COPY(name, text) counters.name = passes->name;
    DIP_PIPELINE_COUNTER_LIST(COPY)
#undef COPY
    return counters;
}

// Counts the memory of the textures that effects use, even of effects that this frame does not run.
static void count_bytes(const DipScene *scene, DipCounters *counters) {
    counters->normal_map_bytes = scene->normal_map_bytes;
    counters->clip_map_bytes = scene->clip_map_bytes;
    counters->cloud_bytes = scene->cloud_bytes;
}

static void count_shadows(const DipFrameSetup *setup, DipCounters *counters) {
    const DipShadows *shadows = &setup->renderer->shadows;
    const uint64_t width = shadows->depth ? (uint64_t)dip_depth_width(shadows->depth) : 0;
    const bool drawn = setup->plan.effects.shadows.run;
    counters->shadow_bytes = width * width * 5; // depth and stencil value
    counters->shadow_texels = drawn ? width * width : 0;
    counters->draws_culled += drawn ? (uint64_t)shadows->set.culled : 0;
    // The ordered draws of the shadow map do not blend.
    counters->fragments_blended -= setup->shadow_counters.fragments_ordered;
}

static void count_mirror(const DipMirror *mirror, bool drawn, DipCounters *counters) {
    const uint64_t across = (uint64_t)dip_frame_tiles(mirror->target.width);
    const uint64_t down = (uint64_t)dip_frame_tiles(mirror->target.height);
    counters->reflection_bytes = mirror->target.stride_bytes * (uint64_t)mirror->target.height;
    counters->tiles_spared += drawn ? 0 : across * down;
}

static void count_backdrop(const DipFrameSetup *setup, DipCounters *counters) {
    const DipBackdropParts *backdrop = &setup->renderer->backdrop;
    const uint64_t across = (uint64_t)dip_frame_tiles(backdrop->target.width);
    const uint64_t down = (uint64_t)dip_frame_tiles(backdrop->target.height);
    counters->fragments_behind = setup->fragments_behind;
    counters->backdrop_texels = setup->backdrop_texels;
    counters->backdrop_bytes = dip_backdrop_bytes(backdrop);
    counters->tiles_spared += setup->plan.effects.scattering.run ? 0 : across * down;
}

DipCounters dip_frame_counters(const DipFrameSetup *setup) {
    const DipRenderer *renderer = setup->renderer;
    const bool reflects = setup->plan.effects.reflection.run;
    DipCounters counters = convert(&setup->counters);
    counters.fragments_mirrored = setup->fragments_mirrored;
    counters.vertices_posed = setup->scene->moving_vertices;
    count_backdrop(setup, &counters);
    count_mirror(&renderer->mirror, reflects, &counters);
    count_shadows(setup, &counters);
    // The pipeline counts only the draws that it was given.
    counters.draws_culled += (uint64_t)renderer->set.culled;
    counters.draws_culled += reflects ? (uint64_t)renderer->mirror.set.culled : 0;
    count_bytes(setup->scene, &counters);
    dip_count_geometry(setup->scene, renderer->unshared, &counters);
    return counters;
}
