// The oracle computes with exact integers, one sample at a time, which samples a triangle covers.
// Every rasteriser in Diptych must agree with this result. This file also creates triangles whose
// coverage is hard to compute correctly.
#ifndef DIP_RENDERER_CATALOGUE_ORACLE_H
#define DIP_RENDERER_CATALOGUE_ORACLE_H

#include "renderer/pipeline/pattern.h"
#include "renderer/catalogue/random.h"

#include <stdbool.h>
#include <stdint.h>

// A triangle. Its corners are screen positions in units of 1/256 pixel, y down, within
// +-DIP_ORACLE_LIMIT.
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
// edge belongs to the triangle if the edge is its left or its upper horizontal edge. Sets bit s of
// masks[y * width + x] if sample s is covered; x and y count from the region's first pixel. Returns
// the number of covered samples.
uint64_t dip_oracle_cover(const DipOracleTriangle *triangle, const DipSamplePattern *pattern,
                          const DipOracleRegion *region, uint8_t *masks);

// The kinds of triangles. X(name, "how triangles of this kind lie")
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

// Creates a random triangle of the given kind in and around the region. Its corners lie within
// +-limit.
DipOracleTriangle dip_oracle_make(DipOracleKind kind, Random *random,
                                  const DipSamplePattern *pattern, const DipOracleRegion *region,
                                  int32_t limit);

enum { DIP_ORACLE_FAN = 8 };

// Creates triangles that surround one shared corner, the hub. The hub lies in the region, half of
// the time on a sample. All other corners lie outside the region, so that together the triangles
// cover each sample of the region exactly once.
void dip_oracle_make_fan(Random *random, const DipSamplePattern *pattern,
                         const DipOracleRegion *region, DipOracleTriangle fan[DIP_ORACLE_FAN]);

#endif
