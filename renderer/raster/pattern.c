// The sample pattern tables.
#include "renderer/raster/pattern.h"

#include "renderer/base/assert.h"

static const DipSamplePattern patterns[] = {
    {1, 128, 128, {128}, {128}},
    {2, 64, 192, {192, 64}, {192, 64}},
    {4, 32, 224, {96, 224, 32, 160}, {32, 96, 160, 224}},
    {6, 21, 235, {107, 64, 192, 149, 235, 21}, {107, 192, 64, 235, 149, 21}},
    {8, 16, 240, {144, 112, 208, 80, 48, 16, 176, 240}, {80, 176, 144, 48, 208, 112, 240, 16}},
};

const DipSamplePattern *dip_sample_pattern(int sample_count) {
    for (int i = 0; i < (int)DIP_ARRAY_COUNT(patterns); i++) {
        if (patterns[i].count == sample_count) {
            return &patterns[i];
        }
    }
    DIP_ASSERT(!"a sample count of the aa setting");
    return &patterns[0];
}
