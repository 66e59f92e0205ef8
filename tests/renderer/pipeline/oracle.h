// Coverage by exact integers, one sample at a time: what any rasteriser of ours must agree with.
// And triangles that are likely to tell if it does not.
#ifndef DIP_TESTS_RENDERER_PIPELINE_ORACLE_H
#define DIP_TESTS_RENDERER_PIPELINE_ORACLE_H

#include "renderer/pipeline/pattern.h"
#include "tests/renderer/random.h"

#include <stdbool.h>
#include <stdint.h>

// Rounded screen positions, 1/256 pixel, y down, within +-DIP_ORACLE_LIMIT.
typedef struct DipOracleTriangle {
    int32_t x[3];
    int32_t y[3];
} DipOracleTriangle;

enum { DIP_ORACLE_LIMIT = 1 << 22 };

// Pixels x0..x0+width-1, y0..y0+height-1.
typedef struct DipOracleRegion {
    int x0;
    int y0;
    int width;
    int height;
} DipOracleRegion;

// Sets masks[y * width + x] (relative to the region) to the samples that the triangle covers, bit
// s for sample s, whichever way it winds; returns how many these are. Top-left rule: a sample on an
// edge belongs to the triangle whose left edge it is, or whose horizontal upper edge.
uint64_t dip_oracle_cover(const DipOracleTriangle *triangle, const DipSamplePattern *pattern,
                          const DipOracleRegion *region, uint8_t *masks);

// X(name, "what is hard about it")
#define DIP_ORACLE_LIST(X)                                                                         \
    X(small, "a few pixels, anywhere in the region and about it")                                  \
    X(large, "about the size of the region")                                                       \
    X(sliver, "as long as the region, from nothing to 2/256 pixel wide")                           \
    X(on_samples, "vertices exactly on samples")                                                   \
    X(through_samples, "edges exactly through samples, ending anywhere")                           \
    X(guard, "vertices as far out as they may be")                                                 \
    X(flat, "no area: points, lines, lines through samples")                                       \
    X(axis_aligned, "horizontal and vertical edges at sample rows and columns")

typedef enum DipOracleKind {
#define DIP_ORACLE_ENUM(name, text) DIP_ORACLE_##name,
    DIP_ORACLE_LIST(DIP_ORACLE_ENUM)
#undef DIP_ORACLE_ENUM
        DIP_ORACLE_KINDS
} DipOracleKind;

const char *dip_oracle_kind_name(DipOracleKind kind);

// A random triangle of a kind, in and about a region; its corners lie within +-limit.
DipOracleTriangle dip_oracle_make(DipOracleKind kind, Random *random,
                                  const DipSamplePattern *pattern, const DipOracleRegion *region,
                                  int32_t limit);

enum { DIP_ORACLE_FAN = 8 };

// Triangles about one shared corner in the region, which lies on a sample half of the time, whose
// outer corners lie beyond the region: together they cover each of its samples exactly once.
void dip_oracle_make_fan(Random *random, const DipSamplePattern *pattern,
                         const DipOracleRegion *region, DipOracleTriangle fan[DIP_ORACLE_FAN]);

#endif
