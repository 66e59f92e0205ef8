// The tables of sample patterns, and the sample groups that follow from them.
#include "renderer/pipeline/pattern.h"

#include "renderer/base/assert.h"

static const DipSamplePattern patterns[DIP_PATTERN_KINDS][5] =
    {
        [DIP_PATTERN_STANDARD] =
            {
                {1, 128, 128, {128}, {128}, {{0}}, {0}},
                {2, 64, 192, {192, 64}, {192, 64}, {{0}}, {0, 1}},
                {4,
                 32,
                 224,
                 {96, 224, 32, 160},
                 {32, 96, 160, 224},
                 {[2] = {0x03, 0x0c}},
                 {0, 3, 1, 2}},
                {6,
                 21,
                 235,
                 {107, 64, 192, 149, 235, 21},
                 {107, 192, 64, 235, 149, 21},
                 {[2] = {0x21, 0x0a, 0x14}, [3] = {0x19, 0x26}},
                 {0, 3, 2, 5, 4, 1}},
                {8,
                 16,
                 240,
                 {144, 112, 208, 80, 48, 16, 176, 240},
                 {80, 176, 144, 48, 208, 112, 240, 16},
                 {[2] = {0x81, 0x12, 0x44, 0x28}, [4] = {0x8d, 0x72}},
                 {0, 1, 2, 5, 3, 6, 7, 4}},
            },
        [DIP_PATTERN_EVEN] =
            {
                {1, 128, 128, {128}, {128}, {{0}}, {0}},
                {2, 32, 224, {32, 224}, {160, 96}, {{0}}, {0, 1}},
                {4,
                 16,
                 240,
                 {16, 240, 112, 144},
                 {112, 144, 240, 16},
                 {[2] = {0x05, 0x0a}},
                 {0, 1, 2, 3}},
                {6,
                 11,
                 245,
                 {11, 245, 75, 181, 96, 160},
                 {203, 53, 139, 117, 32, 224},
                 {[2] = {0x05, 0x12, 0x28}, [3] = {0x25, 0x1a}},
                 {2, 3, 4, 5, 0, 1}},
                {8,
                 8,
                 248,
                 {8, 248, 40, 216, 72, 184, 120, 136},
                 {104, 152, 216, 40, 24, 232, 168, 88},
                 {[2] = {0x11, 0x22, 0x44, 0x88}, [4] = {0x65, 0x9a}},
                 {6, 7, 4, 5, 0, 1, 2, 3}},
            },
        [DIP_PATTERN_ODD] =
            {
                {1, 128, 128, {128}, {128}, {{0}}, {0}},
                {2, 32, 224, {96, 160}, {32, 224}, {{0}}, {0, 1}},
                {4,
                 48,
                 208,
                 {48, 208, 80, 176},
                 {176, 80, 48, 208},
                 {[2] = {0x05, 0x0a}},
                 {0, 1, 2, 3}},
                {6,
                 11,
                 245,
                 {32, 224, 53, 203, 117, 139},
                 {160, 96, 11, 245, 75, 181},
                 {[2] = {0x21, 0x0a, 0x14}, [3] = {0x15, 0x2a}},
                 {4, 5, 0, 1, 2, 3}},
                {8,
                 8,
                 248,
                 {24, 232, 56, 200, 88, 168, 104, 152},
                 {184, 72, 56, 200, 120, 136, 248, 8},
                 {[2] = {0x41, 0x82, 0x14, 0x28}, [4] = {0x95, 0x6a}},
                 {4, 5, 2, 3, 0, 1, 6, 7}},
            },
};

const DipSamplePattern *dip_sample_pattern_of(int sample_count, DipPatternKind kind) {
    DIP_ASSERT(kind < DIP_PATTERN_KINDS);
    for (int i = 0; i < (int)DIP_ARRAY_COUNT(patterns[kind]); i++) {
        if (patterns[kind][i].count == sample_count) {
            return &patterns[kind][i];
        }
    }
    DIP_ASSERT(!"sample_count is 1, 2, 4, 6 or 8");
    return &patterns[kind][0];
}

const DipSamplePattern *dip_sample_pattern(int sample_count) {
    return dip_sample_pattern_of(sample_count, DIP_PATTERN_STANDARD);
}

bool dip_sample_groups_exist(int sample_count, int samples_per_group) {
    return samples_per_group == 1 || (samples_per_group == sample_count && sample_count == 2) ||
           (samples_per_group > 1 && samples_per_group <= DIP_MAX_SHARING &&
            dip_sample_pattern(sample_count)->sharing[samples_per_group][0] != 0);
}

static void set_centroids(DipSampleGroups *groups, const DipSamplePattern *pattern) {
    for (unsigned set = 1; set < 1u << pattern->count; set++) {
        int x = 0;
        int y = 0;
        for (int s = 0; s < pattern->count; s++) {
            x += set >> s & 1 ? pattern->x[s] : 0;
            y += set >> s & 1 ? pattern->y[s] : 0;
        }
        const int count = __builtin_popcount(set);
        groups->centroid[set] = x / count | y / count << 8;
    }
}

void dip_sample_groups_make(DipSampleGroups *groups, const DipSamplePattern *pattern,
                            int samples_per_group) {
    const unsigned all = (1u << pattern->count) - 1;
    *groups = (DipSampleGroups){.count = pattern->count / samples_per_group};
    for (int g = 0; g < groups->count; g++) {
        groups->samples[g] =
            (uint8_t)(groups->count == 1       ? all
                      : samples_per_group == 1 ? 1u << g
                                               : pattern->sharing[samples_per_group][g]);
    }
    for (int s = 0; s < pattern->count; s++) {
        for (int g = 0; g < groups->count; g++) {
            groups->sharing[s] |= groups->samples[g] >> s & 1 ? groups->samples[g] : 0;
        }
    }
    set_centroids(groups, pattern);
}
