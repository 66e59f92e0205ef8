// Areas that SMAA 1x blends: how much of a pixel lies beyond the line that replaces the stairs of
// an edge. SMAA ships a picture of these areas; here they are computed.
#ifndef DIP_RENDERER_POST_FILTERS_SMAA_AREAS_H
#define DIP_RENDERER_POST_FILTERS_SMAA_AREAS_H

// Greatest distances, in pixels, from a pixel to the end of its edge.
enum { DIP_SMAA_STRAIGHT = 32, DIP_SMAA_DIAGONAL = 8 };

// Edges that cross the ends of a straight edge, as bits of a pattern.
enum {
    DIP_SMAA_LEFT_BELOW = 1,
    DIP_SMAA_RIGHT_BELOW = 2,
    DIP_SMAA_LEFT_ABOVE = 4,
    DIP_SMAA_RIGHT_ABOVE = 8,
    DIP_SMAA_PATTERNS = 16
};

// Each entry has the shares, 0..1, by which the pixel below the edge and the pixel above it are
// blended with the other one.
typedef struct DipSmaaAreas {
    // [pattern][pixels to the left end][pixels to the right end]
    float straight[DIP_SMAA_PATTERNS][DIP_SMAA_STRAIGHT + 1][DIP_SMAA_STRAIGHT + 1][2];
    // [edges at the left end][edges at the right end][pixels to the left][pixels to the right]; the
    // edges at an end are 2 for an edge along x plus 1 for an edge along y
    float diagonal[4][4][DIP_SMAA_DIAGONAL + 1][DIP_SMAA_DIAGONAL + 1][2];
} DipSmaaAreas;

// Computes all areas with + - * / and sqrt alone.
void dip_smaa_areas_make(DipSmaaAreas *areas);

#endif
