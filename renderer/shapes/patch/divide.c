// Divides edges and insides of patches.
#include "renderer/shapes/patch/divide.h"

#include <math.h>

enum {
    MAX_FRACTIONAL_ODD = 63,           // the greatest odd factor
    JUST_ABOVE_ONE = DIP_PLACE_ONE + 1 // smallest factor that gives a fractional-odd patch a ring
};

// --- positions on an edge ------------------------------------------------------------------------

static int without_highest_bit(int value) {
    int bit = 1;
    while (2 * bit <= value) {
        bit *= 2;
    }
    return value - bit;
}

static uint32_t reciprocal(int value) {
    return (uint32_t)((DIP_PLACE_ONE + value / 2) / value);
}

// factor: in 1/65536. odd: the number of parts is odd. An even division has at least two parts.
static DipDivision divide(int factor, bool odd) {
    int half = (factor + 1) / 2;
    if (odd || half == DIP_PLACE_ONE / 2) {
        half += DIP_PLACE_ONE / 2;
    }
    const int coarse = half / DIP_PLACE_ONE;
    const int fine = (half + DIP_PLACE_ONE - 1) / DIP_PLACE_ONE;
    DipDivision division = {.parts = 2 * fine - odd,
                            .split = fine + 1,
                            .coarse_step = reciprocal(2 * coarse - odd),
                            .fine_step = reciprocal(2 * fine - odd),
                            .fraction = (uint32_t)(half - coarse * DIP_PLACE_ONE)};
    if (coarse != fine) {
        division.split = odd && coarse == 1 ? 0 : 2 * without_highest_bit(coarse - odd) + 1;
    }
    return division;
}

uint32_t dip_division_place(const DipDivision *division, int p) {
    const int mirrored = division->parts - p;
    if (p == mirrored) {
        return DIP_PLACE_ONE / 2;
    }
    if (p > mirrored) {
        return DIP_PLACE_ONE - dip_division_place(division, mirrored);
    }
    const uint32_t on_fine = (uint32_t)p * division->fine_step;
    const uint32_t on_coarse = (uint32_t)(p > division->split ? p - 1 : p) * division->coarse_step;
    // The sum is below 2^32, because positions before the middle are at most about 2^15.
    return (on_coarse * (DIP_PLACE_ONE - division->fraction) + on_fine * division->fraction +
            DIP_PLACE_ONE / 2) /
           DIP_PLACE_ONE;
}

// --- factors -------------------------------------------------------------------------------------

// Returns a factor in 1/65536, clamped to what the partitioning accepts.
static int clamp_factor(float factor, DipPartitioning partitioning) {
    const bool whole = partitioning == DIP_PARTITIONING_INTEGER;
    const float most = whole ? DIP_MAX_TESSELLATION : MAX_FRACTIONAL_ODD;
    const float clamped = factor < 1.0f ? 1.0f : factor > most ? most : factor;
    return (int)((double)(whole ? ceilf(clamped) : clamped) * DIP_PLACE_ONE + 0.5);
}

static bool is_odd(int factor, DipPartitioning partitioning) {
    return partitioning == DIP_PARTITIONING_FRACTIONAL_ODD || factor / DIP_PLACE_ONE % 2 == 1;
}

DipPatchPlan dip_patch_plan(const DipTessellationFactors *factors, DipDomain domain,
                            DipPartitioning partitioning) {
    DipPatchPlan plan = {.edge_count = domain == DIP_DOMAIN_QUAD ? 4 : 3};
    int inside[2];
    int greatest = DIP_PLACE_ONE;
    for (int e = 0; e < plan.edge_count; e++) {
        const int factor = clamp_factor(factors->edge[e], partitioning);
        greatest = factor > greatest ? factor : greatest;
        plan.left_out = plan.left_out || !(factors->edge[e] > 0.0f);
        plan.edge[e] = divide(factor, is_odd(factor, partitioning));
    }
    for (int i = 0; i < plan.edge_count - 2; i++) {
        inside[i] = clamp_factor(factors->inside[i], partitioning);
        greatest = inside[i] > greatest ? inside[i] : greatest;
    }
    plan.undivided = greatest == DIP_PLACE_ONE;
    for (int i = 0; i < plan.edge_count - 2; i++) {
        // The inside of a divided patch has at least one inner ring: a point with integer factors,
        // a small triangle or quadrilateral with fractional ones.
        const bool odd = is_odd(inside[i], partitioning);
        const bool fractional = partitioning == DIP_PARTITIONING_FRACTIONAL_ODD;
        const bool single = inside[i] == DIP_PLACE_ONE;
        plan.inside[i] = divide(single && fractional ? JUST_ABOVE_ONE : inside[i],
                                odd && (fractional || !single));
    }
    return plan;
}

DipPatchCounts dip_patch_count(const DipPatchPlan *plan) {
    if (plan->left_out) {
        return (DipPatchCounts){0, 0};
    }
    if (plan->undivided) {
        return (DipPatchCounts){(uint64_t)plan->edge_count, (uint64_t)plan->edge_count - 2};
    }
    int outer = 0;
    for (int e = 0; e < plan->edge_count; e++) {
        outer += plan->edge[e].parts;
    }
    const int u = plan->inside[0].parts;
    if (plan->edge_count == 4) {
        const int v = plan->inside[1].parts;
        return (DipPatchCounts){(uint64_t)(outer + (u - 1) * (v - 1)),
                                (uint64_t)(outer + 2 * (u + v - 4) + 2 * (u - 2) * (v - 2))};
    }
    int points = outer;
    int triangles = outer;
    for (int parts = u - 2; parts > 0; parts -= 2) {
        points += 3 * parts;
        triangles += 6 * parts;
    }
    // The innermost ring is a point or a triangle.
    return (DipPatchCounts){(uint64_t)(points + (u % 2 == 0)),
                            (uint64_t)(triangles - (u % 2 ? 2 : 0))};
}
