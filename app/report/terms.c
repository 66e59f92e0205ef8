// Lists the terms of each stage of a frame and of FLIP, by their names and formulas.
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
    double groups;      // Number of sample groups per pixel, each with its own alpha-clip test.
    double adaptive;    // 1 if alpha-clipped surfaces are clipped once per sample group.
    double all;         // 1 if every surface is shaded once per sample group.
    double covers;      // 1 if alpha decides how many samples a clipped surface covers.
    double probes;      // Greatest number of probes of one texture read.
    double anisotropic; // 1 with anisotropic filtering.
    double exact;       // 1 with advanced AF.
    double full_levels; // 1 if the finest mip levels are read.
    double raw;         // 1 if colour textures are not compressed.
    double compressed;  // 1 with opt=standard or opt=advanced.
    double advanced;    // 1 with opt=advanced.
    double biased[3];   // 1 if miplod is at least as coarse as quality (the first value), as
                        // performance (the second) and as high-performance (the third).
    double sharp[2];    // 1 if miplod is at least as sharp as `sharp` (the first value), as
                        // `sharper` (the second).
    double scaled;      // 1 if a larger picture is drawn and averaged.
    double fraction;    // 1 if the scale of the larger picture is not a whole number.
    double below;       // 1 if a smaller picture is drawn and enlarged.
    double scale;       // Width of the drawn picture divided by the frame's width.
    double drawn_part;  // Pixels that are drawn per pixel of a frame, if scale is below 1; else 1.
    double enlarged[3]; // 1 with a scale below 1 and upscale=bilinear (the first value), =bicubic
                        // (the second) and =easu (the third).
    double temporal;    // 1 with taa=alternate.
    double history;     // 1 with taa=history.
    double coloured;    // 1 if mip levels are shown as colours.
    double fxaa;        // 1 with post=fxaa.
    double smaa;        // 1 with post=smaa.
    double sharpness;   // Strength of the sharpening, 0..1.
    double shadows;     // 1 with shadows.
    double shadow_step; // Size of the smallest shadow map divided by the size of the map that these
                        // settings have; 0 without shadows.
    double filters; // Pixels that all filters of the finished picture write per pixel of a frame; 1
                    // if there are no filters.
} Work;

#define C(name) (w->counters[DIP_COST_COUNTER_##name])

// All combinations of a scene pose the same number of vertices, so a fit cannot separate the time
// of posing them from the constant time of a frame. In scenes with posed vertices, the term "frame"
// is therefore 0, and the price of the vertices includes the constant time, which is below 0.001
// ms.
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
    X("fragment with a normal map", C(fragments_normal_mapped))                                    \
    X("fragment of metal and gloss", C(fragments_pbr))                                             \
    X("fragment with a clear coat", C(fragments_coated))                                           \
    X("fragment with a sheen", C(fragments_sheen))                                                 \
    X("fragment that lets light through", C(fragments_transmitting))                               \
    X("fragment that sees an environment", C(fragments_surrounded))                                \
    X("fragment blended", C(fragments_blended))                                                    \
    X("fragment that reads the shadow map", C(fragments_shadowed))                                 \
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
    X("pixel resolved, per sample", C(pixels_resolved) * w->samples)                               \
    X("pixel resolved, aaa=all", C(pixels_resolved) * w->all)                                      \
    X("byte of a picture that is averaged", C(target_bytes) * w->scaled)                           \
    X("pixel averaged from parts of pixels",                                                       \
      C(target_bytes) / (4.0 * w->scale * w->scale) * w->fraction)                                 \
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
    X("pixel sharpened", C(pixels_filtered) / w->filters * (w->sharpness > 0.0))                   \
    X("edge found by FXAA", C(edges_found) * w->fxaa)                                              \
    X("edge found by SMAA", C(edges_found) * w->smaa)

// After the constant term "picture", the first terms stand for errors at edges. The next ones stand
// for errors at the edges of alpha-clipped surfaces, for those in textures, and for those of the
// other settings. The last ones are products of two terms, since one error hides a part of another
// error in the same place.
#define FLIP_TERMS(X)                                                                              \
    X("picture", 1.0)                                                                              \
    X("one sample", 1.0 - w->several)                                                              \
    X("per sample", 1.0 / w->samples)                                                              \
    X("several samples, per group", w->several / w->groups)                                        \
    X("several samples, per root of the groups", w->several / sqrt(w->groups))                     \
    X("aaa=coverage", w->covers)                                                                   \
    X("aaa=coverage, per sample", w->covers / w->samples)                                          \
    X("aaa=all", w->all)                                                                           \
    X("aaa=all, per group", w->all / w->groups)                                                    \
    X("one probe", 1.0 - w->anisotropic)                                                           \
    X("per probe", 1.0 / w->probes)                                                                \
    X("per square of the probes", 1.0 / (w->probes * w->probes))                                   \
    X("advanced AF, beyond one probe", w->anisotropic * w->exact * (1.0 - 1.0 / w->probes))        \
    X("advanced AF, per probe", w->anisotropic * w->exact / w->probes)                             \
    X("compressed textures", w->compressed)                                                        \
    X("opt=advanced", w->advanced)                                                                 \
    X("miplod=quality", w->biased[0])                                                              \
    X("miplod=performance", w->biased[1])                                                          \
    X("miplod=high-performance", w->biased[2])                                                     \
    X("miplod=sharp", w->sharp[0])                                                                 \
    X("miplod=sharper", w->sharp[1])                                                               \
    X("scale above 1, per step", w->scaled *(1.0 - 1.0 / w->scale))                                \
    X("scale above 1, per pixel drawn", w->scaled *(1.0 - 1.0 / (w->scale * w->scale)))            \
    X("scale below 1, bilinear", w->enlarged[0] * (1.0 / w->scale - 1.0))                          \
    X("scale below 1, bicubic", w->enlarged[1] * (1.0 / w->scale - 1.0))                           \
    X("scale below 1, EASU", w->enlarged[2] * (1.0 / w->scale - 1.0))                              \
    X("temporal AA", w->temporal)                                                                  \
    X("taa=history", w->history)                                                                   \
    X("taa=history, several samples", w->history * w->several)                                     \
    X("taa=history, per probe", w->history / w->probes)                                            \
    X("post=fxaa", w->fxaa)                                                                        \
    X("post=smaa", w->smaa)                                                                        \
    X("post=fxaa, several samples", w->fxaa * w->several)                                          \
    X("post=smaa, several samples", w->smaa * w->several)                                          \
    X("sharpening", w->sharpness)                                                                  \
    X("square of the sharpening", w->sharpness * w->sharpness)                                     \
    X("shadows", w->shadows)                                                                       \
    X("shadows, per texel", w->shadow_step)                                                        \
    X("mip colours", w->coloured)                                                                  \
    X("one sample, per probe", (1.0 - w->several) / w->probes)                                     \
    X("several samples, per group and probe", w->several / (w->groups * w->probes))                \
    X("one sample, one probe", (1.0 - w->several) * (1.0 - w->anisotropic))                        \
    X("aaa=all, per probe", w->all / w->probes)                                                    \
    X("miplod=quality, per probe", w->biased[0] / w->probes)                                       \
    X("miplod=performance, per probe", w->biased[1] / w->probes)                                   \
    X("miplod=high-performance, per probe", w->biased[2] / w->probes)                              \
    X("miplod=sharp, per probe", w->sharp[0] / w->probes)                                          \
    X("miplod=sharper, per probe", w->sharp[1] / w->probes)                                        \
    X("compressed textures, per probe", w->compressed / w->probes)                                 \
    X("opt=advanced, per probe", w->advanced / w->probes)                                          \
    X("scale above 1, several samples", w->scaled * w->several * (1.0 - 1.0 / w->scale))           \
    X("scale above 1, per probe", w->scaled / w->probes * (1.0 - 1.0 / w->scale))                  \
    X("scale above 1, miplod=sharp", w->scaled * w->sharp[0] * (1.0 - 1.0 / w->scale))             \
    X("scale above 1, miplod=sharper", w->scaled * w->sharp[1] * (1.0 - 1.0 / w->scale))           \
    X("scale above 1, taa=history", w->scaled * w->history * (1.0 - 1.0 / w->scale))               \
    X("scale below 1, several samples", w->below * w->several * (1.0 / w->scale - 1.0))            \
    X("scale below 1, per probe", w->below / w->probes * (1.0 / w->scale - 1.0))                   \
    X("scale below 1, sharpening", w->below * w->sharpness * (1.0 / w->scale - 1.0))               \
    X("taa=history, sharpening", w->history * w->sharpness)                                        \
    X("taa=history, miplod=sharp", w->history * w->sharp[0])                                       \
    X("compressed textures, miplod=quality", w->compressed * w->biased[0])                         \
    X("compressed textures, miplod=high-performance", w->compressed * w->biased[2])

// Calls X(index of the part, list of its terms) for all parts that are modelled.
#define PARTS(X)                                                                                   \
    X(DIP_COST_STAGE_geometry, GEOMETRY_TERMS)                                                     \
    X(DIP_COST_STAGE_raster, RASTER_TERMS)                                                         \
    X(DIP_COST_STAGE_shading, SHADING_TERMS)                                                       \
    X(DIP_COST_STAGE_resolve, RESOLVE_TERMS)                                                       \
    X(DIP_COST_STAGE_rest, REST_TERMS)                                                             \
    X(DIP_COST_PART_FLIP, FLIP_TERMS)

#define COUNT(name, formula)     +1
#define NAME(name, formula)      name,
#define AMOUNT(name, formula)    *amounts++ = formula;
#define COUNT_PART(index, TERMS) [index] = 0 TERMS(COUNT),
#define NAME_PART(index, TERMS)  [index] = {TERMS(NAME)},
#define ADD_PART(index, TERMS)                                                                     \
    case index:                                                                                    \
        TERMS(AMOUNT) break;

static const int counts[DIP_COST_PART_COUNT] = {PARTS(COUNT_PART)};
static const char *const names[DIP_COST_PART_COUNT][DIP_COST_MAX_TERMS] = {PARTS(NAME_PART)};

int dip_cost_term_count(int part) {
    return counts[part];
}

const char *dip_cost_term_name(int part, int term) {
    DIP_ASSERT(term >= 0 && term < counts[part]);
    return names[part][term];
}

static Work work_of(const double counters[DIP_COST_COUNTER_COUNT], const DipQuality *quality) {
    static const double sharpness[] = {0.0, 0.25, 0.5, 1.0};
    const int level = quality->step[DIP_SETTING_MIPLOD];
    const int post = quality->step[DIP_SETTING_POST];
    const int sharpen = quality->step[DIP_SETTING_SHARPEN];
    const int shadow_size = dip_quality_shadow_size(quality);
    const double samples = dip_quality_sample_count(quality);
    const double probes = dip_quality_max_anisotropy(quality);
    const double scale = dip_quality_scale(quality);
    const bool enlarges = dip_quality_upscales(quality);
    const int upscale = quality->step[DIP_SETTING_UPSCALE];
    const double filters = dip_cost_pixels_filtered(quality);
    return (Work){
        .counters = counters,
        .samples = samples,
        .several = samples > 1.0,
        .groups = samples / dip_quality_samples_per_group(quality),
        .adaptive = quality->step[DIP_SETTING_AAA] >= DIP_AAA_ON,
        .all = dip_quality_groups_shade_all(quality),
        .covers = dip_quality_covers_by_alpha(quality),
        .probes = probes,
        .anisotropic = probes > 1.0,
        .exact = quality->step[DIP_SETTING_AAF] != 0,
        .full_levels = level >= DIP_MIPLOD_HIGH_QUALITY,
        .raw = !dip_quality_compresses(quality),
        .compressed = quality->step[DIP_SETTING_OPT] != DIP_OPT_OFF,
        .advanced = quality->step[DIP_SETTING_OPT] == DIP_OPT_ADVANCED,
        .biased = {level <= DIP_MIPLOD_QUALITY, level <= DIP_MIPLOD_PERFORMANCE,
                   level <= DIP_MIPLOD_HIGH_PERFORMANCE},
        .sharp = {level >= DIP_MIPLOD_SHARP, level >= DIP_MIPLOD_SHARPER},
        .scaled = scale > 1.0,
        .fraction = scale > 1.0 && scale > floor(scale),
        .below = enlarges,
        .scale = scale,
        .drawn_part = fmin(1.0, scale * scale),
        .enlarged = {enlarges && upscale == DIP_UPSCALE_BILINEAR,
                     enlarges && upscale == DIP_UPSCALE_BICUBIC,
                     enlarges && upscale == DIP_UPSCALE_EASU},
        .temporal = dip_quality_alternates(quality),
        .history = dip_quality_has_history(quality),
        .coloured = quality->step[DIP_SETTING_MIPDEBUG] != 0,
        .fxaa = post == DIP_POST_STEP_FXAA,
        .smaa = post == DIP_POST_STEP_SMAA,
        .sharpness = sharpness[sharpen],
        .shadows = shadow_size > 0,
        .shadow_step = shadow_size ? 512.0 / shadow_size : 0.0,
        .filters = filters > 0.0 ? filters : 1.0,
    };
}

static void write_amounts(int part, const Work *w, double amounts[DIP_COST_MAX_TERMS]) {
    switch (part) {
        PARTS(ADD_PART)
    default:
        DIP_ASSERT(false);
    }
}

void dip_cost_terms(int part, const double counters[DIP_COST_COUNTER_COUNT],
                    const DipQuality *quality, double amounts[DIP_COST_MAX_TERMS]) {
    const Work work = work_of(counters, quality);
    write_amounts(part, &work, amounts);
}

double dip_cost_sum_terms(int first, int end, const double (*prices)[DIP_COST_MAX_TERMS],
                          const double counters[DIP_COST_COUNTER_COUNT],
                          const DipQuality *quality) {
    const Work work = work_of(counters, quality);
    double amounts[DIP_COST_MAX_TERMS], sum = 0.0;
    for (int part = first; part < end; part++) {
        write_amounts(part, &work, amounts);
        for (int t = 0; t < counts[part]; t++) {
            sum += amounts[t] * prices[part][t];
        }
    }
    return sum;
}
