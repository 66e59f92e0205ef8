// The terms of each stage, as lists of names and formulas.
#include "app/report/terms.h"

#include "renderer/base/assert.h"

#include <math.h>

// What the formulas see.
typedef struct Work {
    const double *counters;
    double samples;     // Per pixel.
    double several;     // 1 with several samples per pixel.
    double adaptive;    // 1 with adaptive AA.
    double anisotropic; // 1 with anisotropic filtering.
    double full_levels; // 1 if the finest mip levels are read.
    double raw;         // 1 if colour textures are not compressed.
    double advanced;    // 1 with opt=advanced.
    double exact;       // 1 with advanced AF.
} Work;

#define C(name) (w->counters[DIP_COST_COUNTER_##name])

#define GEOMETRY_TERMS(X)                                                                          \
    X("frame", 1.0)                                                                                \
    X("triangle in", C(triangles_in))                                                              \
    X("triangle drawn", C(triangles_drawn))

#define RASTER_TERMS(X)                                                                            \
    X("frame", 1.0)                                                                                \
    X("triangle in a tile", C(tile_triangles))                                                     \
    X("triangle in a tile, of several samples", C(tile_triangles) * w->several)                    \
    X("sub-block tested", C(sub_blocks_tested))                                                    \
    X("sub-block tested, per sample", C(sub_blocks_tested) * w->samples)                           \
    X("sub-block tested, adaptive AA", C(sub_blocks_tested) * w->adaptive)                         \
    X("sub-block tested, adaptive AA, per sample",                                                 \
      C(sub_blocks_tested) * w->adaptive * w->samples)                                             \
    X("sub-block accepted, per sample", C(sub_blocks_accepted) * w->samples)                       \
    X("fragment clip tested", C(fragments_clip_tested))                                            \
    X("sample group of a clipped triangle", C(clip_sample_groups))                                 \
    X("texture probe of a clip map", C(clip_probes))                                               \
    X("texture probe of a clip map, advanced AF", C(clip_probes) * w->exact)                       \
    X("sample shown", C(samples_shown))

#define SHADING_TERMS(X)                                                                           \
    X("frame", 1.0)                                                                                \
    X("fragment shaded", C(fragments_shaded))                                                      \
    X("fragment shaded, anisotropic filtering", C(fragments_shaded) * w->anisotropic)              \
    X("fragment shaded outside of whole blocks", C(fragments_shaded) - C(fragments_of_blocks))     \
    X("batch of fragments", C(shader_batches))                                                     \
    X("texture probe", C(texture_probes) - C(clip_probes))                                         \
    X("texel fetched", C(texels_fetched))                                                          \
    X("fragment with a normal map", C(fragments_normal_mapped))                                    \
    X("fragment of the sky", C(fragments_sky))                                                     \
    X("fragment of water", C(fragments_reflecting))                                                \
    X("sample shown", C(samples_shown))                                                            \
    X("fragment clip tested", C(fragments_clip_tested))                                            \
    X("texel fetched from compressed textures", C(texels_fetched) * (1.0 - w->raw))                \
    X("texel fetched from all mip levels", C(texels_fetched) * w->full_levels)                     \
    X("texel fetched from uncompressed textures", C(texels_fetched) * w->raw)                      \
    X("texture probe with opt=advanced", (C(texture_probes) - C(clip_probes)) * w->advanced)       \
    X("texture probe of advanced AF", (C(texture_probes) - C(clip_probes)) * w->exact)

#define RESOLVE_TERMS(X)                                                                           \
    X("frame", 1.0)                                                                                \
    X("sample shown, of several per pixel", w->samples > 1.0 ? C(samples_shown) : 0.0)             \
    X("pixel resolved", C(pixels_resolved))                                                        \
    X("pixel resolved, per sample", C(pixels_resolved) * w->samples)

#define REST_TERMS(X)                                                                              \
    X("frame", 1.0)                                                                                \
    X("pass", C(passes))                                                                           \
    X("tile", C(tiles_drawn))

#define COUNT(name, formula)  +1
#define NAME(name, formula)   name,
#define AMOUNT(name, formula) *amounts++ = formula;

static const int counts[DIP_COST_STAGE_COUNT] = {
    [DIP_COST_STAGE_geometry] = 0 GEOMETRY_TERMS(COUNT),
    [DIP_COST_STAGE_raster] = 0 RASTER_TERMS(COUNT),
    [DIP_COST_STAGE_shading] = 0 SHADING_TERMS(COUNT),
    [DIP_COST_STAGE_resolve] = 0 RESOLVE_TERMS(COUNT),
    [DIP_COST_STAGE_rest] = 0 REST_TERMS(COUNT),
};

static const char *const names[DIP_COST_STAGE_COUNT][DIP_COST_MAX_TERMS] = {
    [DIP_COST_STAGE_geometry] = {GEOMETRY_TERMS(NAME)},
    [DIP_COST_STAGE_raster] = {RASTER_TERMS(NAME)},
    [DIP_COST_STAGE_shading] = {SHADING_TERMS(NAME)},
    [DIP_COST_STAGE_resolve] = {RESOLVE_TERMS(NAME)},
    [DIP_COST_STAGE_rest] = {REST_TERMS(NAME)},
};

int dip_cost_term_count(DipCostStage stage) {
    return counts[stage];
}

const char *dip_cost_term_name(DipCostStage stage, int term) {
    DIP_ASSERT(term >= 0 && term < counts[stage]);
    return names[stage][term];
}

void dip_cost_terms(DipCostStage stage, const double counters[DIP_COST_COUNTER_COUNT],
                    const DipQuality *quality, double amounts[DIP_COST_MAX_TERMS]) {
    const Work work = {
        .counters = counters,
        .samples = dip_quality_sample_count(quality),
        .several = dip_quality_sample_count(quality) > 1,
        .adaptive = quality->step[DIP_SETTING_AAA] != 0,
        .anisotropic = dip_quality_max_anisotropy(quality) > 1,
        .full_levels = quality->step[DIP_SETTING_MIPLOD] == DIP_MIPLOD_HIGH_QUALITY,
        .raw = !dip_quality_compresses(quality),
        .advanced = quality->step[DIP_SETTING_OPT] == DIP_OPT_ADVANCED,
        .exact = quality->step[DIP_SETTING_AAF] != 0,
    };
    const Work *const w = &work;
    switch (stage) {
    case DIP_COST_STAGE_geometry:
        GEOMETRY_TERMS(AMOUNT) break;
    case DIP_COST_STAGE_raster:
        RASTER_TERMS(AMOUNT) break;
    case DIP_COST_STAGE_shading:
        SHADING_TERMS(AMOUNT) break;
    case DIP_COST_STAGE_resolve:
        RESOLVE_TERMS(AMOUNT) break;
    default:
        REST_TERMS(AMOUNT) break;
    }
}

void dip_cost_error_terms(const DipQuality *quality, double terms[DIP_COST_ERROR_TERMS]) {
    const double samples = dip_quality_sample_count(quality);
    const double groups = samples / dip_quality_samples_per_group(quality);
    const double probes = dip_quality_max_anisotropy(quality);
    const double several = samples > 1.0;
    const double anisotropic = probes > 1.0;
    const double exact = anisotropic && quality->step[DIP_SETTING_AAF];
    const int level = quality->step[DIP_SETTING_MIPLOD];
    const double biased[3] = {level <= DIP_MIPLOD_QUALITY, level <= DIP_MIPLOD_PERFORMANCE,
                              level <= DIP_MIPLOD_HIGH_PERFORMANCE};
    const double compressed = quality->step[DIP_SETTING_OPT] != DIP_OPT_OFF;
    const double advanced = quality->step[DIP_SETTING_OPT] == DIP_OPT_ADVANCED;
    const double values[DIP_COST_ERROR_TERMS] = {
        1.0,
        // Edges, and the edges of alpha-clipped surfaces, which have a decision per sample group.
        1.0 - several,
        1.0 / samples,
        several / groups,
        several / sqrt(groups),
        // Textures.
        1.0 - anisotropic,
        1.0 / probes,
        1.0 / (probes * probes),
        exact * (1.0 - 1.0 / probes),
        exact / probes,
        compressed,
        advanced,
        biased[0],
        biased[1],
        biased[2],
        quality->step[DIP_SETTING_TAA] != 0,
        quality->step[DIP_SETTING_MIPDEBUG] != 0,
        // An error hides a part of another error in the same place.
        (1.0 - several) / probes,
        several / (groups * probes),
        (1.0 - several) * (1.0 - anisotropic),
        biased[0] / probes,
        biased[1] / probes,
        biased[2] / probes,
        compressed / probes,
        advanced / probes,
        compressed * biased[0],
        compressed * biased[2],
    };
    for (int t = 0; t < DIP_COST_ERROR_TERMS; t++) {
        terms[t] = values[t];
    }
}
