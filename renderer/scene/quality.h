// The image-quality settings of one pane (one of the two pictures that the preview compares), and
// the one list that defines them.
//
// DIP_SETTING_LIST yields the enumerators, the struct, the parser, the help, the panel and the
// reports, so a setting or a step is added here and nowhere else. The value of a setting is the
// index of one of its steps (dip_setting_info). The first step is not always the default.
//
// The command line, the ini and the reports write settings as text: "aa=4,af=16,aaf=on". A setting
// that is left out has its default.
#ifndef DIP_RENDERER_SCENE_QUALITY_H
#define DIP_RENDERER_SCENE_QUALITY_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// X(key, NAME, "Title", "Short title", default step, (steps), (labels), (narrow labels),
//   "what it does")
// A label is a step's name for people; a narrow one has at most six characters.
#define DIP_SETTING_LIST(X)                                                                        \
    X(aa, AA, "Antialiasing", "Antialias.", 0, ("none", "2", "4", "6", "8"),                       \
      ("none", "2x", "4x", "6x", "8x"), ("none", "2x", "4x", "6x", "8x"),                          \
      "coverage and depth samples per pixel; a surface is still shaded once per pixel")            \
    X(taa, TAA, "Temporal AA", "Temporal", 0, ("off", "alternate", "history"),                     \
      ("off", "alternate", "history"), ("off", "altern", "hist."),                                 \
      "alternate (or on): two sample patterns alternate from frame to frame; history: each frame " \
      "is blended with the frames before it, as the camera has moved them")                        \
    X(aaa, AAA, "Adaptive AA", "Adaptive", 0, ("off", "coverage", "on", "all"),                    \
      ("off", "coverage", "on", "all"), ("off", "cover", "on", "all"),                             \
      "coverage: the alpha of clipped surfaces decides how many samples they cover; on: they are " \
      "clipped and shaded once per sample group of each pixel; all: so is every other surface")    \
    X(asd, ASD, "Adaptive AA group size", "Group size", 0, ("1", "2", "3", "4"),                   \
      ("1", "2", "3", "4"), ("1", "2", "3", "4"),                                                  \
      "samples that share one sample group: 1 2 with aa=2 and aa=4, 1 2 3 with aa=6, "             \
      "1 2 4 with aa=8")                                                                           \
    X(af, AF, "Anisotropic filtering", "Anisotrop.", 0, ("none", "2", "4", "8", "16"),             \
      ("none", "2x", "4x", "8x", "16x"), ("none", "2x", "4x", "8x", "16x"),                        \
      "at most this many texture probes along the long axis of a footprint; none: trilinear")      \
    X(aaf, AAF, "Advanced AF", "Adv. AF", 0, ("off", "on"), ("off", "on"), ("off", "on"),          \
      "footprints are exact ellipses, so filtering does not depend on a surface's angle")          \
    X(opt, OPT, "Texture optimisation", "Tex. opt.", 0, ("off", "standard", "advanced"),           \
      ("off", "standard", "advanced"), ("off", "std.", "adv."),                                    \
      "standard compresses colour textures with BC1; advanced also filters with fewer probes")     \
    X(miplod, MIPLOD, "Mip level of detail", "Mip detail", 3,                                      \
      ("high-performance", "performance", "quality", "high-quality", "sharp", "sharper"),          \
      ("high perf.", "perform.", "quality", "high qual.", "sharp", "sharper"),                     \
      ("h.perf", "perf", "qual", "h.qual", "sharp", "sharp+"),                                     \
      "bias towards smaller mip levels; high-performance also drops the largest levels; sharp "    \
      "and sharper: a bias towards larger levels than the texture's size asks for")                \
    X(scale, SCALE, "Render scale", "Scale", 4,                                                    \
      ("1/2", "1/1.7", "1/1.5", "1/1.3", "1", "1.25", "1.5", "2"),                                 \
      ("1/2", "1/1.7", "1/1.5", "1/1.3", "1x", "1.25x", "1.5x", "2x"),                             \
      (".50", ".59", ".67", ".77", "1x", "1.25", "1.5x", "2x"),                                    \
      "the picture is drawn this many times as wide and high; a larger one is averaged in linear " \
      "light, a smaller one is enlarged as upscale says")                                          \
    X(upscale, UPSCALE, "Upscaling filter", "Upscaling", 0, ("bilinear", "bicubic", "easu"),       \
      ("bilinear", "bicubic", "EASU"), ("bilin.", "bicub.", "EASU"),                               \
      "how the smaller picture of a scale below 1 is enlarged: from four pixels, from sixteen, "   \
      "or along edges (FSR 1)")                                                                    \
    X(post, POST, "Post-process AA", "Post AA", 0, ("off", "fxaa", "smaa"),                        \
      ("off", "FXAA", "SMAA"), ("off", "FXAA", "SMAA"),                                            \
      "smooths the edges that it finds in the finished picture, also those of textures")           \
    X(sharpen, SHARPEN, "Sharpening", "Sharpen", 0, ("off", "low", "medium", "high"),              \
      ("off", "low", "medium", "high"), ("off", "low", "medium", "high"),                          \
      "raises the contrast of neighbouring pixels in the finished picture; raises the error, too") \
    X(shadows, SHADOWS, "Shadows", "Shadows", 0, ("off", "512", "1024", "2048"),                   \
      ("off", "512", "1024", "2048"), ("off", "512", "1024", "2048"),                              \
      "the scene's strongest directional light casts shadows; texels along a side of their map")   \
    X(gi, GI, "Geometry instancing", "Instancing", 1, ("off", "on"), ("off", "on"), ("off", "on"), \
      "on: repeated objects share one mesh; off: each has a copy; the picture is the same")        \
    X(mipdebug, MIPDEBUG, "Mip colours", "Mip col.", 0, ("off", "on"), ("off", "on"),              \
      ("off", "on"), "colour textures show each of their mip levels as a flat colour")

typedef enum DipSetting {
#define DIP_SETTING_ENUM(key, NAME, title, brief, def, steps, labels, narrow, text)                \
    DIP_SETTING_##NAME,
    DIP_SETTING_LIST(DIP_SETTING_ENUM)
#undef DIP_SETTING_ENUM
        DIP_SETTING_COUNT
} DipSetting;

enum {
    DIP_MAX_STEPS = 8,
    DIP_SETTINGS_BYTES = 256 // Room for the text of any settings; test_quality.c checks it.
};

// The steps of taa, aaa, opt, miplod, scale, upscale and post, by name.
enum { DIP_TAA_OFF, DIP_TAA_ALTERNATE, DIP_TAA_HISTORY };
enum { DIP_AAA_OFF, DIP_AAA_COVERAGE, DIP_AAA_ON, DIP_AAA_ALL };
enum { DIP_OPT_OFF, DIP_OPT_STANDARD, DIP_OPT_ADVANCED };
enum {
    DIP_MIPLOD_HIGH_PERFORMANCE,
    DIP_MIPLOD_PERFORMANCE,
    DIP_MIPLOD_QUALITY,
    DIP_MIPLOD_HIGH_QUALITY,
    DIP_MIPLOD_SHARP,
    DIP_MIPLOD_SHARPER
};

enum {
    DIP_SCALE_1_2,
    DIP_SCALE_1_1_7,
    DIP_SCALE_1_1_5,
    DIP_SCALE_1_1_3,
    DIP_SCALE_1, // the frame's own size
    DIP_SCALE_1_25,
    DIP_SCALE_1_5,
    DIP_SCALE_2
};

enum { DIP_UPSCALE_BILINEAR, DIP_UPSCALE_BICUBIC, DIP_UPSCALE_EASU };

enum { DIP_POST_STEP_OFF, DIP_POST_STEP_FXAA, DIP_POST_STEP_SMAA };

// One pane's settings: the index of a step for each setting. Plain data that may be copied freely.
// All functions but dip_quality_check, dip_quality_equal and dip_quality_count_changes need
// settings that dip_quality_check accepts.
typedef struct DipQuality {
    uint8_t step[DIP_SETTING_COUNT];
} DipQuality;

// Describes a setting for panels and help texts. All strings are static.
typedef struct DipSettingInfo {
    const char *key;         // "aa"
    const char *title;       // "Antialiasing"
    const char *short_title; // "Antialias.", at most ten characters
    const char *text;        // what the setting does, in one sentence
    int step_count;          // 2..DIP_MAX_STEPS
    int default_step;
    const char *steps[DIP_MAX_STEPS];         // "none", "2", ...
    const char *labels[DIP_MAX_STEPS];        // for people: "none", "2x", ...
    const char *narrow_labels[DIP_MAX_STEPS]; // at most six characters: "h.perf"
} DipSettingInfo;

DIP_API const DipSettingInfo *dip_setting_info(DipSetting setting);

// Returns the step at a position of a list whose last entry is the best picture. Texture
// optimisation and the group size of adaptive AA begin with their best step, so their order is
// reversed. The function is its own inverse.
DIP_API int dip_setting_step_at(DipSetting setting, int position);

DIP_API DipQuality dip_quality_default(void);

// Reads settings from text; a setting that the text leaves out gets its default. taa=on is another
// way to write taa=alternate. err may be NULL.
// Fails with DIP_ERROR_UNKNOWN (a setting or a step), MISSING (a setting without a step), OVERSIZED
// (a part that is too long for key=step), CONFLICT (a setting given twice) or an error of
// dip_quality_check. On failure *quality is unchanged. Thread-safe.
DIP_API bool dip_quality_parse(const char *text, DipQuality *quality, DipError *err);

// Writes all settings in the order of DIP_SETTING_LIST: "aa=none,taa=off,...". Cuts the text to the
// buffer and returns the length of the whole text, as snprintf does.
DIP_API size_t dip_quality_format(const DipQuality *quality, char *buffer, size_t size_bytes);

// Writes the settings that differ from their defaults: "aa=4,af=16", or "defaults". Cuts the text
// to the buffer and returns the length of the whole text.
DIP_API size_t dip_quality_format_changes(const DipQuality *quality, char *buffer,
                                          size_t size_bytes);

// Returns the number of settings that differ from their defaults.
DIP_API int dip_quality_count_changes(const DipQuality *quality);

DIP_API bool dip_quality_equal(const DipQuality *a, const DipQuality *b);

// Returns the settings with every one turned off that has no effect beside the others: alternating
// samples and adaptive AA without samples, adaptive AA with a single sample group, a group size
// without adaptive AA, advanced AF without AF, and an upscaling filter at a render scale of 1 or
// more. Both draw the same pictures in every scene, and take the same time.
DIP_API DipQuality dip_quality_effective(const DipQuality *quality);

// Returns what a setting needs to have an effect beside the other settings, such as "needs AF", or
// NULL if its step, or one of its steps if it is off, has an effect.
DIP_API const char *dip_quality_needs(const DipQuality *quality, DipSetting setting);

// Fails if a step is out of range (RANGE) or if the samples of aa cannot be divided into groups of
// asd samples (CONFLICT), even when adaptive AA is off.
DIP_API bool dip_quality_check(const DipQuality *quality, DipError *err);

DIP_API int dip_quality_sample_count(const DipQuality *quality);   // 1, 2, 4, 6 or 8
DIP_API int dip_quality_max_anisotropy(const DipQuality *quality); // 1 (trilinear), 2, 4, 8 or 16

// Returns the width or height at which a picture of the given width or height is drawn: size times
// the step of scale, rounded to the nearest whole number, halves up. size: 1 or more.
DIP_API int dip_quality_drawn_size(const DipQuality *quality, int size);

// Returns the step of scale as a number: 0.5 to 2.
DIP_API double dip_quality_scale(const DipQuality *quality);

// Returns true if scale is below 1, so that a smaller picture is drawn and enlarged.
DIP_API bool dip_quality_upscales(const DipQuality *quality);

// Returns the width and height of the shadow map, in texels; 0 without shadows.
DIP_API int dip_quality_shadow_size(const DipQuality *quality);

// Returns true if two sample patterns alternate from frame to frame: taa=alternate.
DIP_API bool dip_quality_alternates(const DipQuality *quality);

// Returns true if frames are blended with the frames before them: taa=history.
DIP_API bool dip_quality_has_history(const DipQuality *quality);

// Returns the bias of miplod, of a scale below 1 and of a history, in 1/256 level. Greater values
// mean smaller mip levels. A scale s below 1 has the bias log2 s, so that textures are read at the
// levels that fit the frame, not the smaller picture. A history has the bias -1, because the mean
// of its frames is smoother than each of them. Where mip colours show the levels, neither the
// scale nor the history nor the steps that are sharper than high-quality have a bias.
DIP_API int32_t dip_quality_bias_lod8(const DipQuality *quality);

// Returns the settings with which the textures of the mirrored scene are read that water shows.
// They are the frame's, except that miplod is at most high-quality, that scale is 1 instead of
// less, and that there is no history: each texel of the mirrored picture may cover several pixels
// of the frame, so a level that is too sharp would sparkle in whole blocks.
DIP_API DipQuality dip_quality_mirrored(const DipQuality *quality);

// Returns true if colour textures are drawn compressed. This is so with opt=standard and
// opt=advanced, unless mip colours replace the texels.
DIP_API bool dip_quality_compresses(const DipQuality *quality);

// Returns the samples per sample group of alpha-clipped surfaces: asd with aaa=on and aaa=all,
// otherwise all samples.
DIP_API int dip_quality_samples_per_group(const DipQuality *quality);

// Returns true if all surfaces are shaded once per sample group: aaa=all with several groups.
DIP_API bool dip_quality_groups_shade_all(const DipQuality *quality);

// Returns the level-of-detail bias of a surface with sample groups, in 1/256 level:
// -log2(sqrt(groups)). A sample group (samples of a pixel that are clipped and shaded together)
// covers only a part of the pixel, so it reads finer levels than a whole pixel would. Finer levels
// still show the thin parts of clip maps; coarser levels average these parts away.
DIP_API int32_t dip_quality_groups_bias_lod8(const DipQuality *quality);

// Returns true if alpha decides how many samples a clipped surface covers: aaa=coverage with
// several samples.
DIP_API bool dip_quality_covers_by_alpha(const DipQuality *quality);

#ifdef __cplusplus
}
#endif

#endif
