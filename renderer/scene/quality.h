// The image-quality settings of one pane, and the one list that defines them.
//
// DIP_SETTING_LIST yields the enumerators, the struct, the parser, the help, the panel and the
// reports: a setting or a step is added here and nowhere else. A setting's value is the index of
// its step in dip_setting_info(); the first step need not be the default.
//
// Text form (command line, ini, reports): "aa=4,af=16,aaf=on"; what is left out keeps its default.
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

// X(key, NAME, "Title", default step, (steps), "what it does")
#define DIP_SETTING_LIST(X)                                                                        \
    X(aa, AA, "Antialiasing", 0, ("none", "2", "4", "6", "8"),                                     \
      "coverage and depth samples per pixel; shading stays once per pixel and surface")            \
    X(taa, TAA, "Temporal AA", 0, ("off", "on"),                                                   \
      "the sample pattern alternates from frame to frame")                                         \
    X(aaa, AAA, "Adaptive AA", 0, ("off", "on"),                                                   \
      "alpha-clipped surfaces are sampled at more than one place per pixel")                       \
    X(asd, ASD, "Adaptive AA divisor", 0, ("1", "2", "3", "4"),                                    \
      "samples that share one pass of adaptive AA; aa=2: 1 2, 4: 1 2, 6: 1 2 3, 8: 1 2 4")         \
    X(af, AF, "Anisotropic filtering", 0, ("none", "2", "4", "8", "16"),                           \
      "texture probes along the long axis of a pixel's footprint, at most this many")              \
    X(aaf, AAF, "Advanced AF", 0, ("off", "on"),                                                   \
      "footprints from the exact ellipse, the same at every angle")                                \
    X(opt, OPT, "Texture optimisation", 0, ("off", "standard", "advanced"),                        \
      "standard: BC1 colour textures; advanced: also cheaper filtering")                           \
    X(miplod, MIPLOD, "Mip level of detail", 3,                                                    \
      ("high-performance", "performance", "quality", "high-quality"),                              \
      "bias towards smaller mip levels; high-performance also drops the largest levels")           \
    X(gi, GI, "Geometry instancing", 1, ("off", "on"), "repeated objects share one mesh")          \
    X(mipdebug, MIPDEBUG, "Mip colours", 0, ("off", "on"),                                         \
      "colour textures show their mip levels as flat colours")

typedef enum DipSetting {
#define DIP_SETTING_ENUM(key, NAME, title, def, steps, text) DIP_SETTING_##NAME,
    DIP_SETTING_LIST(DIP_SETTING_ENUM)
#undef DIP_SETTING_ENUM
        DIP_SETTING_COUNT
} DipSetting;

enum { DIP_MAX_STEPS = 5 };

// Step indices that code compares with.
enum { DIP_OPT_OFF, DIP_OPT_STANDARD, DIP_OPT_ADVANCED };
enum {
    DIP_MIPLOD_HIGH_PERFORMANCE,
    DIP_MIPLOD_PERFORMANCE,
    DIP_MIPLOD_QUALITY,
    DIP_MIPLOD_HIGH_QUALITY
};

// One pane's settings: a step index per setting. Plain data, copied freely.
typedef struct DipQuality {
    uint8_t step[DIP_SETTING_COUNT];
} DipQuality;

// What a panel or a help text needs to know of a setting. Static storage.
typedef struct DipSettingInfo {
    const char *key;   // "aa"
    const char *title; // "Antialiasing"
    const char *text;  // one sentence
    int step_count;    // 2..DIP_MAX_STEPS
    int default_step;
    const char *steps[DIP_MAX_STEPS]; // "none", "2", ...
} DipSettingInfo;

DIP_API const DipSettingInfo *dip_setting_info(DipSetting setting);

DIP_API DipQuality dip_quality_default(void);

// Reads settings as text over the defaults. NULL err is allowed. Fails with DIP_ERROR_UNKNOWN
// (setting or step), CONFLICT (a setting twice); then
// *quality is unchanged. Thread-safe.
DIP_API bool dip_quality_parse(const char *text, DipQuality *quality, DipError *err);

// Writes all settings in list order, "aa=none,taa=off,..."; returns the length as snprintf does.
DIP_API size_t dip_quality_format(const DipQuality *quality, char *buffer, size_t size_bytes);

// Fails when a step is out of range (RANGE) or does not fit another setting (CONFLICT: an asd that
// aa has no passes for).
DIP_API bool dip_quality_check(const DipQuality *quality, DipError *err);

DIP_API int dip_quality_sample_count(const DipQuality *quality);   // 1, 2, 4, 6 or 8
DIP_API int dip_quality_max_anisotropy(const DipQuality *quality); // 1 (trilinear), 2, 4, 8 or 16

// Whether colour textures are shown compressed. Mip colours hide them.
DIP_API bool dip_quality_compresses(const DipQuality *quality);

// Of alpha-clipped surfaces: all samples, unless adaptive AA makes passes.
DIP_API int dip_quality_samples_per_group(const DipQuality *quality);

#ifdef __cplusplus
}
#endif

#endif
