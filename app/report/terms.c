// Lists the terms of the model of times (fit.h) for each stage of a frame, each with its name and
// the formula of its amount.
#include "app/report/fit.h"

#include "app/report/combinations.h"
#include "renderer/base/assert.h"

#include <math.h>

// The values that the formulas of terms use. A value that answers a yes-or-no question is 1 for yes
// and 0 for no.
typedef struct Work {
    const double *counters;
    double samples;     // Number of samples per pixel.
    double several;     // 1 if a pixel has several samples.
    double adaptive;    // 1 if alpha-clipped surfaces are clipped once per sample group.
    double all;         // 1 if every surface is shaded once per sample group.
    double covers;      // 1 if alpha decides how many samples a clipped surface covers.
    double anisotropic; // 1 with anisotropic filtering.
    double exact;       // 1 with advanced AF.
    double apart;       // Distance of neighbouring pixels on a surface, in texels of the mip level
                        // that they read, relative to a frame of scale 1 without biases.
    double raw;         // 1 if colour textures are not compressed.
    double advanced;    // 1 with opt=advanced.
    double scaled;      // 1 if a larger picture is drawn and averaged.
    double fraction;    // 1 if the scale of the larger picture is not a whole number.
    double scale;       // Width of the drawn picture divided by the frame's width.
    double drawn_part;  // Pixels that are drawn per pixel of a frame, if scale is below 1; else 1.
    double enlarged[3]; // 1 with a scale below 1 and upscale=bilinear (the first value), =bicubic
                        // (the second) and =easu (the third).
    double history;     // 1 with taa=history.
    double fxaa;        // 1 with post=fxaa.
    double smaa;        // 1 with post=smaa.
    double sharpens;    // 1 if the picture is sharpened.
    double filters;     // Pixels that all filters of the finished picture write per pixel of a
                        // frame; 1 if there are no filters.
} Work;

#define C(name) (w->counters[DIP_COUNTER_##name])

// In one scene, all combinations of settings pose the same number of vertices, so a fit cannot
// separate the time of posing them from the constant time of a frame. In scenes with posed
// vertices, the term "frame" is therefore 0, and the price of the vertices includes the constant
// time, which is below 0.001 ms.
#define GEOMETRY_TERMS(X)                                                                          \
    X("frame", C(vertices_posed) > 0.0 ? 0.0 : 1.0)                                                \
    X("vertex posed", C(vertices_posed))                                                           \
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
    X("texture probe of a clip map, aaa=coverage", C(clip_probes) * w->covers)                     \
    X("sample shown", C(samples_shown))                                                            \
    X("texel of the shadow map", C(shadow_texels))

#define SHADING_TERMS(X)                                                                           \
    X("frame", 1.0)                                                                                \
    X("fragment shaded", C(fragments_shaded))                                                      \
    X("fragment shaded, anisotropic filtering", C(fragments_shaded) * w->anisotropic)              \
    X("fragment shaded outside of whole blocks", C(fragments_shaded) - C(fragments_of_blocks))     \
    X("batch of fragments", C(shader_batches))                                                     \
    X("texture probe", C(texture_probes) - C(clip_probes))                                         \
    X("texel fetched", C(texels_fetched))                                                          \
    X("texel fetched, times the distance of pixels", C(texels_fetched) * w->apart)                 \
    X("fragment with a normal map", C(fragments_normal_mapped))                                    \
    X("fragment of metal and gloss", C(fragments_pbr))                                             \
    X("fragment with a clear coat", C(fragments_coated))                                           \
    X("fragment with a sheen", C(fragments_sheen))                                                 \
    X("fragment that lets light through", C(fragments_transmitting))                               \
    X("fragment of rough glass", C(fragments_scattering))                                          \
    X("fragment that sees an environment", C(fragments_surrounded))                                \
    X("fragment blended", C(fragments_blended))                                                    \
    X("fragment that reads the shadow map", C(fragments_shadowed))                                 \
    X("fragment of the sky", C(fragments_sky))                                                     \
    X("fragment of water", C(fragments_reflecting))                                                \
    X("sample shown", C(samples_shown))                                                            \
    X("fragment clip tested", C(fragments_clip_tested))                                            \
    X("texel fetched from compressed textures", C(texels_fetched) * (1.0 - w->raw))                \
    X("texel fetched from uncompressed textures", C(texels_fetched) * w->raw)                      \
    X("texture probe with opt=advanced", (C(texture_probes) - C(clip_probes)) * w->advanced)       \
    X("texture probe of advanced AF", (C(texture_probes) - C(clip_probes)) * w->exact)

#define RESOLVE_TERMS(X)                                                                           \
    X("frame", 1.0)                                                                                \
    X("sample shown, of several per pixel", w->samples > 1.0 ? C(samples_shown) : 0.0)             \
    X("pixel resolved", C(pixels_resolved))                                                        \
    X("pixel resolved, per sample", C(pixels_resolved) * w->samples)                               \
    X("pixel resolved, aaa=all", C(pixels_resolved) * w->all)                                      \
    X("byte of a picture that is averaged", C(target_bytes) * w->scaled)                           \
    X("pixel averaged from parts of pixels",                                                       \
      C(target_bytes) / (4.0 * w->scale * w->scale) * w->fraction)                                 \
    X("texel of what lies behind rough glass", C(backdrop_texels))                                 \
    X("texel of the shadow map", C(shadow_texels))

#define REST_TERMS(X)                                                                              \
    X("frame", 1.0)                                                                                \
    X("pass", C(passes))                                                                           \
    X("tile", C(tiles_drawn))                                                                      \
    X("pixel of a history", C(pixels_filtered) / w->filters * w->drawn_part * w->history)          \
    X("pixel filtered by FXAA", C(pixels_filtered) / w->filters * w->drawn_part * w->fxaa)         \
    X("pixel filtered by SMAA", C(pixels_filtered) / w->filters * w->drawn_part * w->smaa)         \
    X("pixel enlarged, bilinear", C(pixels_filtered) / w->filters * w->enlarged[0])                \
    X("pixel enlarged, bicubic", C(pixels_filtered) / w->filters * w->enlarged[1])                 \
    X("pixel enlarged, EASU", C(pixels_filtered) / w->filters * w->enlarged[2])                    \
    X("pixel sharpened", C(pixels_filtered) / w->filters * w->sharpens)                            \
    X("edge found by FXAA", C(edges_found) * w->fxaa)                                              \
    X("edge found by SMAA", C(edges_found) * w->smaa)

// Calls X(stage, list of its terms) for all stages.
#define STAGES(X)                                                                                  \
    X(DIP_COST_STAGE_geometry, GEOMETRY_TERMS)                                                     \
    X(DIP_COST_STAGE_raster, RASTER_TERMS)                                                         \
    X(DIP_COST_STAGE_shading, SHADING_TERMS)                                                       \
    X(DIP_COST_STAGE_resolve, RESOLVE_TERMS)                                                       \
    X(DIP_COST_STAGE_rest, REST_TERMS)

#define COUNT(name, formula)      +1
#define NAME(name, formula)       name,
#define AMOUNT(name, formula)     *amounts++ = formula;
#define COUNT_STAGE(stage, TERMS) [stage] = 0 TERMS(COUNT),
#define NAME_STAGE(stage, TERMS)  [stage] = {TERMS(NAME)},
#define ADD_STAGE(stage, TERMS)                                                                    \
    case stage:                                                                                    \
        TERMS(AMOUNT) break;

static const int counts[DIP_COST_STAGE_COUNT] = {STAGES(COUNT_STAGE)};
static const char *const names[DIP_COST_STAGE_COUNT][DIP_COST_MAX_TERMS] = {STAGES(NAME_STAGE)};

int dip_cost_term_count(int stage) {
    return counts[stage];
}

const char *dip_cost_term_name(int stage, int term) {
    DIP_ASSERT(term >= 0 && term < counts[stage]);
    return names[stage][term];
}

static Work work_of(const double counters[DIP_COUNTER_COUNT], const DipQuality *quality) {
    const int post = quality->step[DIP_SETTING_POST];
    const double samples = dip_quality_sample_count(quality);
    const double scale = dip_quality_scale(quality);
    const bool enlarges = dip_quality_upscales(quality);
    const int upscale = quality->step[DIP_SETTING_UPSCALE];
    const double filters = dip_cost_pixels_filtered(quality);
    return (Work){
        .counters = counters,
        .samples = samples,
        .several = samples > 1.0,
        .adaptive = quality->step[DIP_SETTING_AAA] >= DIP_AAA_ON,
        .all = dip_quality_groups_shade_all(quality),
        .covers = dip_quality_covers_by_alpha(quality),
        .anisotropic = dip_quality_max_anisotropy(quality) > 1,
        .exact = quality->step[DIP_SETTING_AAF] != 0,
        // A scale below 1 is part of the bias; that of a larger picture is not.
        .apart = exp2(-dip_quality_bias_lod8(quality) / 256.0) / fmax(1.0, scale),
        .raw = !dip_quality_compresses(quality),
        .advanced = quality->step[DIP_SETTING_OPT] == DIP_OPT_ADVANCED,
        .scaled = scale > 1.0,
        .fraction = scale > 1.0 && scale > floor(scale),
        .scale = scale,
        .drawn_part = fmin(1.0, scale * scale),
        .enlarged = {enlarges && upscale == DIP_UPSCALE_BILINEAR,
                     enlarges && upscale == DIP_UPSCALE_BICUBIC,
                     enlarges && upscale == DIP_UPSCALE_EASU},
        .sharpens = quality->step[DIP_SETTING_SHARPEN] != 0,
        .history = dip_quality_has_history(quality),
        .fxaa = post == DIP_POST_STEP_FXAA,
        .smaa = post == DIP_POST_STEP_SMAA,
        .filters = filters > 0.0 ? filters : 1.0,
    };
}

static void write_amounts(int stage, const Work *w, double amounts[DIP_COST_MAX_TERMS]) {
    switch (stage) {
        STAGES(ADD_STAGE)
    default:
        DIP_ASSERT(false);
    }
}

void dip_cost_terms(int stage, const double counters[DIP_COUNTER_COUNT], const DipQuality *quality,
                    double amounts[DIP_COST_MAX_TERMS]) {
    const Work work = work_of(counters, quality);
    write_amounts(stage, &work, amounts);
}

double dip_cost_sum_terms(int first, int end, const double (*prices)[DIP_COST_MAX_TERMS],
                          const double counters[DIP_COUNTER_COUNT], const DipQuality *quality) {
    const Work work = work_of(counters, quality);
    double amounts[DIP_COST_MAX_TERMS], sum = 0.0;
    for (int stage = first; stage < end; stage++) {
        write_amounts(stage, &work, amounts);
        for (int t = 0; t < counts[stage]; t++) {
            sum += amounts[t] * prices[stage][t];
        }
    }
    return sum;
}
