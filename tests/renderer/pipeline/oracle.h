// The oracle computes coverage with exact integers, one sample at a time; every rasteriser of ours
// must agree with it. This file also creates triangles that are hard to cover correctly.
#ifndef DIP_TESTS_RENDERER_PIPELINE_ORACLE_H
#define DIP_TESTS_RENDERER_PIPELINE_ORACLE_H

#include "renderer/pipeline/pattern.h"
#include "tests/renderer/random.h"

#include <stdbool.h>
#include <stdint.h>

// A triangle of rounded screen positions in 1/256 pixel, y down, within +-DIP_ORACLE_LIMIT.
typedef struct DipOracleTriangle {
    int32_t x[3];
    int32_t y[3];
} DipOracleTriangle;

enum { DIP_ORACLE_LIMIT = 1 << 22 };

// The pixels x0..x0+width-1, y0..y0+height-1.
typedef struct DipOracleRegion {
    int x0;
    int y0;
    int width;
    int height;
} DipOracleRegion;

// Finds the samples that a triangle of either winding covers, by the top-left rule: a sample on an
// edge belongs to the triangle if the edge is its left or its upper horizontal edge. Sets masks[y *
// width + x] (relative to the region), with bit s for sample s. Returns the number of covered
// samples.
uint64_t dip_oracle_cover(const DipOracleTriangle *triangle, const DipSamplePattern *pattern,
                          const DipOracleRegion *region, uint8_t *masks);

// The kinds of triangles. X(name, "what is hard about it")
#define DIP_ORACLE_LIST(X)                                                                         \
    X(small, "a few pixels large, anywhere in the region and around it")                           \
    X(large, "about the size of the region")                                                       \
    X(sliver, "as long as the region, at most 2/256 pixel wide")                                   \
    X(on_samples, "vertices exactly on samples")                                                   \
    X(through_samples, "edges exactly through samples, ending anywhere")                           \
    X(guard, "vertices as far outside as they are allowed to be")                                  \
    X(flat, "without area: points, lines, lines through samples")                                  \
    X(axis_aligned, "horizontal and vertical edges at sample rows and columns")

typedef enum DipOracleKind {
#define DIP_ORACLE_ENUM(name, text) DIP_ORACLE_##name,
    DIP_ORACLE_LIST(DIP_ORACLE_ENUM)
#undef DIP_ORACLE_ENUM
        DIP_ORACLE_KINDS
} DipOracleKind;

const char *dip_oracle_kind_name(DipOracleKind kind);

// Creates a random triangle of a kind, in and around a region. Its corners lie within +-limit.
DipOracleTriangle dip_oracle_make(DipOracleKind kind, Random *random,
                                  const DipSamplePattern *pattern, const DipOracleRegion *region,
                                  int32_t limit);

enum { DIP_ORACLE_FAN = 8 };

// Creates triangles around one corner in the region that all of them share; half of the time this
// corner lies on a sample. The outer corners lie outside the region, so that together the triangles
// cover each of its samples exactly once.
void dip_oracle_make_fan(Random *random, const DipSamplePattern *pattern,
                         const DipOracleRegion *region, DipOracleTriangle fan[DIP_ORACLE_FAN]);

#endif
