// Places the points of patches and joins them to triangles.
//
// A patch consists of rings. The outer ring has the points of the patch's edges, each divided by
// its own factor. The inner rings have the points of the inside factors. Neighbouring rings are
// stitched edge by edge. The inner rings of a quadrilateral together form a grid.
#include "renderer/shapes/patch/net.h"

#include "renderer/base/assert.h"

enum { TWO_THIRDS = 0xaaaa }; // of DIP_PLACE_ONE, rounded down

// --- points and triangles ------------------------------------------------------------------------

static void add_point(DipPatchNet *net, uint32_t u, uint32_t v, uint32_t w) {
    const uint32_t point[3] = {u, v, w};
    for (int i = 0; i < 3; i++) {
        net->location[i][net->point_count] = (float)point[i] * (1.0f / DIP_PLACE_ONE);
    }
    net->point_count++;
}

static void add_triangle(DipPatchNet *net, uint32_t a, uint32_t b, uint32_t c) {
    uint32_t *corner = net->indices + net->index_count;
    corner[0] = a;
    corner[1] = b;
    corner[2] = c;
    net->index_count += 3;
}

// Points along one edge of a ring. Rings run in the direction of the control points.
typedef struct Chain {
    const DipDivision *division;
    int start;      // the first point's number in the division
    int parts;      // number of parts; 0 for a single point
    uint32_t first; // index of the first point
    uint32_t step;  // distance of the next point's index, modulo 2^32
    uint32_t last;  // index of the last point
} Chain;

static uint32_t chain_point(const Chain *chain, int i) {
    return i == chain->parts ? chain->last : chain->first + (uint32_t)i * chain->step;
}

// Returns twice the position of the middle of part i along the edge, or a great number after the
// last part.
static uint32_t part_middle(const Chain *chain, int i) {
    if (i == chain->parts) {
        return 4 * DIP_PLACE_ONE;
    }
    return dip_division_place(chain->division, chain->start + i) +
           dip_division_place(chain->division, chain->start + i + 1);
}

// Fills the strip between an edge of a ring and the same edge of the next inner ring. Each part of
// either edge becomes the base of a triangle; the triangles are in the order of the parts' middles.
static void stitch(DipPatchNet *net, const Chain *outer, const Chain *inner) {
    int i = 0;
    int j = 0;
    while (i < outer->parts || j < inner->parts) {
        const uint32_t from_outer = chain_point(outer, i);
        const uint32_t from_inner = chain_point(inner, j);
        if (part_middle(outer, i) <= part_middle(inner, j)) {
            add_triangle(net, from_outer, chain_point(outer, ++i), from_inner);
        } else {
            add_triangle(net, from_outer, chain_point(inner, ++j), from_inner);
        }
    }
}

// Sets the chains of an outer ring whose first point is point 0.
static void outer_chains(const DipDivision *const edges[], int count, Chain *chains) {
    uint32_t first = 0;
    for (int e = 0; e < count; e++) {
        const uint32_t next = first + (uint32_t)edges[e]->parts;
        chains[e] = (Chain){edges[e], 0, edges[e]->parts, first, 1, e == count - 1 ? 0 : next};
        first = next;
    }
}

// --- triangles -----------------------------------------------------------------------------------

// Adds a point on the side that lies opposite control point e and runs from control point e + 1 to
// control point e + 2. across, along: weights of the control points e and e + 2.
static void add_triangle_point(DipPatchNet *net, int e, uint32_t across, uint32_t along) {
    uint32_t weight[3];
    weight[e] = across;
    weight[(e + 2) % 3] = along;
    weight[(e + 1) % 3] = DIP_PLACE_ONE - across - along;
    add_point(net, weight[0], weight[1], weight[2]);
}

// Adds inner ring k of a triangle and sets its chains.
static void add_inner_ring(DipPatchNet *net, const DipDivision *inside, int k, Chain chains[3]) {
    const int parts = inside->parts - 2 * k;
    const uint32_t across =
        (dip_division_place(inside, k) * TWO_THIRDS + DIP_PLACE_ONE / 2) / DIP_PLACE_ONE;
    const uint32_t ring = net->point_count;
    for (int e = 0; e < 3; e++) {
        const uint32_t first = net->point_count;
        for (int i = 0; i < parts; i++) {
            add_triangle_point(net, e, across,
                               dip_division_place(inside, k + i) - (across + 1) / 2);
        }
        chains[e] = (Chain){inside, k, parts, first, 1, e == 2 ? ring : first + (uint32_t)parts};
    }
    if (parts == 0) {
        add_triangle_point(net, 2, across, DIP_PLACE_ONE / 2 - (across + 1) / 2);
    }
}

static void fill_triangle(DipPatchNet *net, const DipPatchPlan *plan) {
    for (int e = 0; e < 3; e++) {
        for (int p = 0; p < plan->edge[e].parts; p++) {
            add_triangle_point(net, e, 0, dip_division_place(&plan->edge[e], p));
        }
    }
    if (plan->undivided) {
        add_triangle(net, 0, 1, 2);
        return;
    }
    Chain rings[2][3];
    const DipDivision *const edges[3] = {&plan->edge[0], &plan->edge[1], &plan->edge[2]};
    const DipDivision *inside = &plan->inside[0];
    outer_chains(edges, 3, rings[0]);
    int k = 1;
    for (; 2 * k <= inside->parts; k++) {
        add_inner_ring(net, inside, k, rings[k % 2]);
        for (int e = 0; e < 3; e++) {
            stitch(net, &rings[(k + 1) % 2][e], &rings[k % 2][e]);
        }
    }
    const Chain *innermost = rings[(k + 1) % 2];
    if (innermost[0].parts == 1) {
        add_triangle(net, innermost[0].first, innermost[1].first, innermost[2].first);
    }
}

// --- quadrilaterals ------------------------------------------------------------------------------

// Adds the points of the outer ring, from (0, 0) through (1, 0), (1, 1) and (0, 1).
static void add_quad_ring(DipPatchNet *net, const DipDivision *const edges[4]) {
    for (int e = 0; e < 4; e++) {
        for (int p = 0; p < edges[e]->parts; p++) {
            const uint32_t along = dip_division_place(edges[e], p);
            const uint32_t points[4][2] = {{along, 0},
                                           {DIP_PLACE_ONE, along},
                                           {DIP_PLACE_ONE - along, DIP_PLACE_ONE},
                                           {0, DIP_PLACE_ONE - along}};
            add_point(net, points[e][0], points[e][1], 0);
        }
    }
}

static void add_grid(DipPatchNet *net, const DipDivision *across, const DipDivision *down) {
    const uint32_t first = net->point_count;
    const uint32_t stride = (uint32_t)across->parts - 1;
    for (int j = 1; j < down->parts; j++) {
        for (int i = 1; i < across->parts; i++) {
            add_point(net, dip_division_place(across, i), dip_division_place(down, j), 0);
        }
    }
    for (uint32_t j = 0; j + 2 < (uint32_t)down->parts; j++) {
        for (uint32_t i = 0; i + 2 < (uint32_t)across->parts; i++) {
            const uint32_t corner = first + j * stride + i;
            add_triangle(net, corner, corner + 1, corner + stride + 1);
            add_triangle(net, corner, corner + stride + 1, corner + stride);
        }
    }
}

static void fill_quad(DipPatchNet *net, const DipPatchPlan *plan) {
    // The edges v = 0, u = 1, v = 1 and u = 0, in the direction of the control points.
    const DipDivision *const edges[4] = {&plan->edge[1], &plan->edge[2], &plan->edge[3],
                                         &plan->edge[0]};
    add_quad_ring(net, edges);
    if (plan->undivided) {
        add_triangle(net, 0, 1, 2);
        add_triangle(net, 0, 2, 3);
        return;
    }
    const DipDivision *u = &plan->inside[0];
    const DipDivision *v = &plan->inside[1];
    const uint32_t stride = (uint32_t)u->parts - 1;
    const uint32_t corner[4] = {net->point_count, net->point_count + stride - 1,
                                net->point_count + stride * ((uint32_t)v->parts - 1) - 1,
                                net->point_count + stride * ((uint32_t)v->parts - 2)};
    const uint32_t step[4] = {1, stride, UINT32_MAX, 0u - stride};
    Chain outer[4];
    outer_chains(edges, 4, outer);
    for (int e = 0; e < 4; e++) {
        const DipDivision *inside = e % 2 ? v : u;
        const Chain inner = {inside, 1, inside->parts - 2, corner[e], step[e], corner[(e + 1) % 4]};
        stitch(net, &outer[e], &inner);
    }
    add_grid(net, u, v);
}

void dip_net_fill(DipPatchNet *net, const DipPatchPlan *plan) {
    net->point_count = 0;
    net->index_count = 0;
    if (!plan->left_out && plan->edge_count == 4) {
        fill_quad(net, plan);
    } else if (!plan->left_out) {
        fill_triangle(net, plan);
    }
    DIP_ASSERT(net->point_count == dip_patch_count(plan).points);
    DIP_ASSERT(net->index_count == 3 * dip_patch_count(plan).triangles);
}
