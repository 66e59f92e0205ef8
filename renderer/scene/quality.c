// Implements the settings: their description, parsing, formatting and checking.
#include "renderer/scene/quality.h"

#include "renderer/base/assert.h"
#include "renderer/base/fp_mode.h"
#include "renderer/base/nearest.h"
#include "renderer/pipeline/pattern.h"

#include <stdio.h>
#include <string.h>

#define STEPS(...)    __VA_ARGS__
#define COUNT_OF(...) (sizeof((const char *[]){__VA_ARGS__}) / sizeof(const char *))

static const DipSettingInfo infos[DIP_SETTING_COUNT] = {
#define DIP_SETTING_INFO(key, NAME, title, brief, def, steps, labels, narrow, text)                \
    {#key, title,         brief,          text,          (int)(COUNT_OF steps),                    \
     def,  {STEPS steps}, {STEPS labels}, {STEPS narrow}},
    DIP_SETTING_LIST(DIP_SETTING_INFO)
#undef DIP_SETTING_INFO
};

const DipSettingInfo *dip_setting_info(DipSetting setting) {
    DIP_ASSERT(setting < DIP_SETTING_COUNT);
    return &infos[setting];
}

int dip_setting_step_at(DipSetting setting, int position) {
    const bool best_first = setting == DIP_SETTING_OPT || setting == DIP_SETTING_ASD;
    return best_first ? infos[setting].step_count - 1 - position : position;
}

DipQuality dip_quality_default(void) {
    DipQuality quality;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        quality.step[s] = (uint8_t)infos[s].default_step;
    }
    return quality;
}

// Writes the steps whose bits are set in `mask`, such as "none|2|4".
static void list_steps(const DipSettingInfo *info, unsigned mask, char *buffer, size_t size_bytes) {
    size_t length = 0;
    buffer[0] = '\0';
    for (int i = 0; i < info->step_count; i++) {
        if (mask >> i & 1 && length < size_bytes) {
            length += (size_t)snprintf(buffer + length, size_bytes - length, "%s%s",
                                       length ? "|" : "", info->steps[i]);
        }
    }
}

static bool unknown_setting(const char *name, DipError *err) {
    const char *keys[DIP_SETTING_COUNT];
    char known[128] = "";
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        const size_t length = strlen(known);
        keys[s] = infos[s].key;
        snprintf(known + length, sizeof known - length, "%s%s", s ? " " : "", keys[s]);
    }
    const char *likely = dip_nearest_likely(name, keys, DIP_SETTING_COUNT);
    return dip_error_set(
        err, DIP_ERROR_UNKNOWN, NULL, 0, name, "no setting of this name%s%s%s, accepted %s",
        likely ? " (did you mean " : "", likely ? likely : "", likely ? "?)" : "", known);
}

// Applies one "key=step".
static bool parse_assignment(const char *text, DipQuality *quality, unsigned *seen, DipError *err) {
    char key[64];
    const char *equals = strchr(text, '=');
    snprintf(key, sizeof key, "%.*s", equals ? (int)(equals - text) : (int)strlen(text), text);
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        if (strcmp(key, infos[s].key) != 0) {
            continue;
        }
        char accepted[96];
        list_steps(&infos[s], ~0u, accepted, sizeof accepted);
        if (!equals) {
            return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, key, "no value, accepted %s=%s",
                                 key, accepted);
        }
        if (*seen >> s & 1) {
            return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, key,
                                 "is set twice, accepted once");
        }
        *seen |= 1u << s;
        const char *step = equals + 1;
        if (s == DIP_SETTING_TAA && strcmp(step, "on") == 0) {
            step = infos[s].steps[DIP_TAA_ALTERNATE];
        }
        for (int i = 0; i < infos[s].step_count; i++) {
            if (strcmp(step, infos[s].steps[i]) == 0) {
                quality->step[s] = (uint8_t)i;
                return true;
            }
        }
        return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, key, "'%s' is no step, accepted %s",
                             equals + 1, accepted);
    }
    return unknown_setting(key, err);
}

bool dip_quality_parse(const char *text, DipQuality *quality, DipError *err) {
    DipQuality parsed = dip_quality_default();
    unsigned seen = 0;
    char assignment[128];
    while (*text) {
        const size_t length = strcspn(text, ",");
        if (length >= sizeof assignment) {
            return dip_error_set(err, DIP_ERROR_OVERSIZED, NULL, 0, "settings",
                                 "a part of %zu characters, accepted key=step", length);
        }
        memcpy(assignment, text, length);
        assignment[length] = '\0';
        if (!parse_assignment(assignment, &parsed, &seen, err)) {
            return false;
        }
        text += length + (text[length] == ',');
    }
    if (!dip_quality_check(&parsed, err)) {
        return false;
    }
    *quality = parsed;
    return true;
}

size_t dip_quality_format(const DipQuality *quality, char *buffer, size_t size_bytes) {
    size_t length = 0;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        const size_t room = length < size_bytes ? size_bytes - length : 0;
        length += (size_t)snprintf(room ? buffer + length : NULL, room, "%s%s=%s", s ? "," : "",
                                   infos[s].key, infos[s].steps[quality->step[s]]);
    }
    return length;
}

size_t dip_quality_format_changes(const DipQuality *quality, char *buffer, size_t size_bytes) {
    size_t length = 0;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        if (quality->step[s] != infos[s].default_step) {
            const size_t room = length < size_bytes ? size_bytes - length : 0;
            length +=
                (size_t)snprintf(room ? buffer + length : NULL, room, "%s%s=%s", length ? "," : "",
                                 infos[s].key, infos[s].steps[quality->step[s]]);
        }
    }
    return length ? length : (size_t)snprintf(buffer, size_bytes, "defaults");
}

int dip_quality_count_changes(const DipQuality *quality) {
    int count = 0;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        count += quality->step[s] != infos[s].default_step;
    }
    return count;
}

bool dip_quality_equal(const DipQuality *a, const DipQuality *b) {
    return memcmp(a->step, b->step, sizeof a->step) == 0;
}

// Returns whether sample groups with these settings divide the samples into two groups or more.
static bool has_groups(const DipQuality *quality) {
    const int samples = dip_quality_sample_count(quality);
    const int group = quality->step[DIP_SETTING_ASD] + 1;
    return dip_sample_groups_exist(samples, group) && group < samples;
}

// Returns whether the step of adaptive AA asks for sample groups.
static bool divides(const DipQuality *quality) {
    return quality->step[DIP_SETTING_AAA] >= DIP_AAA_ON;
}

DipQuality dip_quality_effective(const DipQuality *quality) {
    DipQuality effective = *quality;
    uint8_t *step = effective.step;
    step[DIP_SETTING_AAF] = step[DIP_SETTING_AF] ? step[DIP_SETTING_AAF] : 0;
    step[DIP_SETTING_TAA] =
        step[DIP_SETTING_AA] || dip_quality_has_history(quality) ? step[DIP_SETTING_TAA] : 0;
    const bool works = step[DIP_SETTING_AAA] == DIP_AAA_COVERAGE
                           ? dip_quality_sample_count(&effective) > 1
                           : has_groups(&effective);
    step[DIP_SETTING_AAA] = works ? step[DIP_SETTING_AAA] : DIP_AAA_OFF;
    step[DIP_SETTING_ASD] = divides(&effective) ? step[DIP_SETTING_ASD] : 0;
    step[DIP_SETTING_UPSCALE] = dip_quality_upscales(quality) ? step[DIP_SETTING_UPSCALE] : 0;
    return effective;
}

const char *dip_quality_needs(const DipQuality *quality, DipSetting setting) {
    const bool has_samples = dip_quality_sample_count(quality) > 1;
    switch (setting) {
    case DIP_SETTING_TAA:
        return has_samples || quality->step[setting] != DIP_TAA_ALTERNATE ? NULL : "needs AA";
    case DIP_SETTING_AAA:
        return !has_samples                               ? "needs AA"
               : divides(quality) && !has_groups(quality) ? "needs smaller groups"
                                                          : NULL;
    case DIP_SETTING_ASD:
        return has_samples && divides(quality) ? NULL : "needs adaptive AA";
    case DIP_SETTING_AAF:
        return quality->step[DIP_SETTING_AF] ? NULL : "needs AF";
    case DIP_SETTING_UPSCALE:
        return dip_quality_upscales(quality) ? NULL : "needs a scale below 1";
    default:
        return NULL;
    }
}

// Refuses a sample group size (asd) that does not exist for aa's number of samples. This is checked
// even if adaptive AA is off.
static bool check_groups(const DipQuality *quality, DipError *err) {
    const DipSettingInfo *aa = &infos[DIP_SETTING_AA];
    const DipSettingInfo *asd = &infos[DIP_SETTING_ASD];
    const int asd_step = quality->step[DIP_SETTING_ASD];
    unsigned fitting_asd = 0; // steps of asd that fit this aa, as bits
    unsigned fitting_aa = 0;  // steps of aa that fit this asd, as bits
    for (int i = 0; i < asd->step_count; i++) {
        fitting_asd |= (unsigned)dip_sample_groups_exist(dip_quality_sample_count(quality), i + 1)
                       << i;
    }
    for (int i = 0; i < aa->step_count; i++) {
        DipQuality other = *quality;
        other.step[DIP_SETTING_AA] = (uint8_t)i;
        fitting_aa |=
            (unsigned)dip_sample_groups_exist(dip_quality_sample_count(&other), asd_step + 1) << i;
    }
    if (fitting_asd >> asd_step & 1) {
        return true;
    }
    char needed[96];
    char accepted[96];
    list_steps(aa, fitting_aa, needed, sizeof needed);
    list_steps(asd, fitting_asd, accepted, sizeof accepted);
    return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, asd->key,
                         "asd=%s needs aa=%s; with aa=%s, give asd=%s", asd->steps[asd_step],
                         needed, aa->steps[quality->step[DIP_SETTING_AA]], accepted);
}

bool dip_quality_check(const DipQuality *quality, DipError *err) {
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        const int step = quality->step[s];
        if (step >= infos[s].step_count) {
            return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, infos[s].key,
                                 "step %d is out of range, accepted 0..%d", step,
                                 infos[s].step_count - 1);
        }
    }
    return check_groups(quality, err);
}

int dip_quality_sample_count(const DipQuality *quality) {
    static const int samples[] = {1, 2, 4, 6, 8};
    return samples[quality->step[DIP_SETTING_AA]];
}

int dip_quality_max_anisotropy(const DipQuality *quality) {
    return 1 << quality->step[DIP_SETTING_AF];
}

// The steps of scale as exact ratios.
typedef struct Ratio {
    int over;
    int under;
} Ratio;

static Ratio ratio_of(const DipQuality *quality) {
    static const Ratio ratios[] = {
        [DIP_SCALE_1_2] = {1, 2},     [DIP_SCALE_1_1_7] = {10, 17}, [DIP_SCALE_1_1_5] = {2, 3},
        [DIP_SCALE_1_1_3] = {10, 13}, [DIP_SCALE_1] = {1, 1},       [DIP_SCALE_1_25] = {5, 4},
        [DIP_SCALE_1_5] = {3, 2},     [DIP_SCALE_2] = {2, 1},
    };
    return ratios[quality->step[DIP_SETTING_SCALE]];
}

int dip_quality_drawn_size(const DipQuality *quality, int size) {
    const Ratio ratio = ratio_of(quality);
    return (2 * size * ratio.over + ratio.under) / (2 * ratio.under);
}

double dip_quality_scale(const DipQuality *quality) {
    DIP_FP_MODE_SCOPE();
    const Ratio ratio = ratio_of(quality);
    double scale = (double)ratio.over / ratio.under;
    DIP_FP_PIN(scale);
    return scale;
}

bool dip_quality_upscales(const DipQuality *quality) {
    return quality->step[DIP_SETTING_SCALE] < DIP_SCALE_1;
}

int dip_quality_shadow_size(const DipQuality *quality) {
    const int step = quality->step[DIP_SETTING_SHADOWS];
    return step ? 256 << step : 0;
}

int32_t dip_quality_bias_lod8(const DipQuality *quality) {
    static const int32_t bias_lod8[] = {
        [DIP_MIPLOD_HIGH_PERFORMANCE] = 384, [DIP_MIPLOD_PERFORMANCE] = 256,
        [DIP_MIPLOD_QUALITY] = 128,          [DIP_MIPLOD_HIGH_QUALITY] = 0,
        [DIP_MIPLOD_SHARP] = -128,           [DIP_MIPLOD_SHARPER] = -256,
    };
    // log2 of the scale.
    static const int32_t scale_lod8[] = {
        [DIP_SCALE_1_2] = -256,  [DIP_SCALE_1_1_7] = -196, [DIP_SCALE_1_1_5] = -150,
        [DIP_SCALE_1_1_3] = -97, [DIP_SCALE_2] = 0,
    };
    const int32_t bias = bias_lod8[quality->step[DIP_SETTING_MIPLOD]];
    if (quality->step[DIP_SETTING_MIPDEBUG]) {
        return bias < 0 ? 0 : bias;
    }
    const int32_t history_lod8 = dip_quality_has_history(quality) ? -256 : 0;
    return bias + scale_lod8[quality->step[DIP_SETTING_SCALE]] + history_lod8;
}

bool dip_quality_alternates(const DipQuality *quality) {
    return quality->step[DIP_SETTING_TAA] == DIP_TAA_ALTERNATE;
}

bool dip_quality_has_history(const DipQuality *quality) {
    return quality->step[DIP_SETTING_TAA] == DIP_TAA_HISTORY;
}

DipQuality dip_quality_mirrored(const DipQuality *quality) {
    DipQuality mirrored = *quality;
    if (mirrored.step[DIP_SETTING_MIPLOD] > DIP_MIPLOD_HIGH_QUALITY) {
        mirrored.step[DIP_SETTING_MIPLOD] = DIP_MIPLOD_HIGH_QUALITY;
    }
    if (dip_quality_upscales(quality)) {
        mirrored.step[DIP_SETTING_SCALE] = DIP_SCALE_1;
    }
    if (dip_quality_has_history(quality)) {
        mirrored.step[DIP_SETTING_TAA] = DIP_TAA_OFF;
    }
    return mirrored;
}

int dip_quality_samples_per_group(const DipQuality *quality) {
    return divides(quality) ? quality->step[DIP_SETTING_ASD] + 1
                            : dip_quality_sample_count(quality);
}

bool dip_quality_groups_shade_all(const DipQuality *quality) {
    return quality->step[DIP_SETTING_AAA] == DIP_AAA_ALL && has_groups(quality);
}

int32_t dip_quality_groups_bias_lod8(const DipQuality *quality) {
    static const int32_t bias_lod8[DIP_MAX_SAMPLES + 1] = {
        [2] = -128, [3] = -203, [4] = -256, [6] = -331, [8] = -384};
    return bias_lod8[dip_quality_sample_count(quality) / dip_quality_samples_per_group(quality)];
}

bool dip_quality_covers_by_alpha(const DipQuality *quality) {
    return quality->step[DIP_SETTING_AAA] == DIP_AAA_COVERAGE &&
           dip_quality_sample_count(quality) > 1;
}

bool dip_quality_compresses(const DipQuality *quality) {
    return quality->step[DIP_SETTING_OPT] != DIP_OPT_OFF && !quality->step[DIP_SETTING_MIPDEBUG];
}
