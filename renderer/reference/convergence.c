// Draws the converged picture (the mean of many samples per pixel) tile by tile. Each tile is drawn
// only from the triangles that reach the tile. The arithmetic on samples is the same as in
// converge.c; this file only skips what cannot be visible.
#include "renderer/reference/convergence.h"

#include "renderer/base/fp_mode.h"
#include "renderer/reference/internal/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// TILE is the width and height of a tile, in pixels. A tile's samples fit the second-level cache.
enum { NOTHING = -1, TILE = 8 };

// The triangles that reach each tile. The indices of a tile's triangles are items[first[tile]] to
// items[first[tile + 1] - 1].
typedef struct Bins {
    size_t *first;
    int32_t *items;
} Bins;

struct DipConvergence {
    const DipReference *reference;
    DipPose pose;
    DipRefShot shot;          // its pose is the copy above
    DipConvergence *mirrored; // the same frame of the mirrored scene, which water shows; or NULL
    DipRefBackdrop *backdrop; // what rough glass shows blurred; NULL: it shows it sharp
    DipRefTriangles triangles;
    Bins bins;
    int tiles_x;
    int tiles_y;
};

// The samples of a tile, pixel by pixel.
typedef struct Samples {
    const DipConvergence *convergence;
    const struct Samples
        *mirrored; // the mirrored samples; NULL if the tile has no reflecting water
    double *x;     // positions in the frame, in 1/256 pixel
    double *y;
    double *depths;
    // Depths of the nearest alpha-clipped triangles, even where alpha removes them.
    double *clip_depths;
    int32_t *triangles;
    DipRefPeel *peels; // of each sample; NULL if no blended surface is in view
    int per_pixel;
    int x0; // first pixel of the tile
    int y0;
    int x1; // one past the last pixel of the tile
    int y1;
    void *memory;
} Samples;

// --- bins --------------------------------------------------------------------------------------

// Visits all tiles that each triangle reaches, in submission order. Counts the triangles of each
// tile and, unless count_only is true, writes their indices. Returns false if the work should stop.
static bool fill_bins(DipConvergence *c, size_t *cursor, bool count_only) {
    for (size_t t = 0; t < c->triangles.count; t++) {
        const DipRefTriangle *triangle = &c->triangles.items[t];
        if (t % DIP_REF_STOP_PERIOD == 0 && dip_reference_stopped(c->reference, NULL)) {
            return false;
        }
        for (int y = triangle->min_y / TILE; y <= triangle->max_y / TILE; y++) {
            for (int x = triangle->min_x / TILE; x <= triangle->max_x / TILE; x++) {
                size_t *at = &cursor[y * c->tiles_x + x];
                if (!count_only) {
                    c->bins.items[*at] = (int32_t)t;
                }
                ++*at;
            }
        }
    }
    return true;
}

static bool make_bins(DipConvergence *c) {
    const size_t tiles = (size_t)dip_convergence_tile_count(c);
    size_t *cursor = calloc(tiles, sizeof *cursor);
    c->bins.first = calloc(tiles + 1, sizeof *c->bins.first);
    if (!cursor || !c->bins.first) {
        free(cursor);
        return false;
    }
    bool filled = fill_bins(c, cursor, true);
    for (size_t t = 0; t < tiles; t++) {
        c->bins.first[t + 1] = c->bins.first[t] + cursor[t];
        cursor[t] = c->bins.first[t];
    }
    c->bins.items = malloc((c->bins.first[tiles] + 1) * sizeof *c->bins.items);
    filled = filled && c->bins.items && fill_bins(c, cursor, false);
    free(cursor);
    return filled;
}

static DipConvergence *create(const DipReference *reference, const DipRefShot *shot,
                              DipError *err) {
    DipConvergence *c = calloc(1, sizeof *c);
    if (!c) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, NULL, "no memory for the converged picture");
        return NULL;
    }
    c->reference = reference;
    c->pose = *shot->pose;
    c->shot = *shot;
    c->shot.pose = &c->pose;
    c->tiles_x = (c->shot.width + TILE - 1) / TILE;
    c->tiles_y = (c->shot.height + TILE - 1) / TILE;
    bool made = dip_reference_build_triangles(reference, shot, &c->triangles, err);
    if (made && !make_bins(c)) {
        made = !dip_reference_stopped(reference, err) &&
               dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, NULL,
                             "no memory for the converged picture");
    }
    if (!made) {
        dip_convergence_destroy(&c);
    }
    return c;
}

DipConvergence *dip_convergence_create(const DipReference *reference, const DipPose *pose,
                                       int width, int height, DipError *err) {
    DIP_FP_MODE_SCOPE();
    if (!dip_reference_check_frame(reference, pose, width, height, err)) {
        return NULL;
    }
    DipRefShot shot = {pose, width, height, (double)width / height, .shadows = true};
    DipConvergence *c = create(reference, &shot, err);
    if (c && c->triangles.has_scattering &&
        !dip_reference_converge_backdrop(reference, pose, width, height, &c->backdrop, err)) {
        dip_convergence_destroy(&c);
    }
    if (c && dip_reference_reflects(reference, pose)) {
        shot.mirrored = true;
        c->mirrored = create(reference, &shot, err);
        if (!c->mirrored) {
            dip_convergence_destroy(&c);
        }
    }
    return c;
}

void dip_convergence_destroy(DipConvergence **convergence) {
    if (!*convergence) {
        return;
    }
    dip_convergence_destroy(&(*convergence)->mirrored);
    dip_reference_backdrop_destroy(&(*convergence)->backdrop);
    dip_reference_triangles_free(&(*convergence)->triangles);
    free((*convergence)->bins.first);
    free((*convergence)->bins.items);
    free(*convergence);
    *convergence = NULL;
}

int dip_convergence_tile_count(const DipConvergence *convergence) {
    return convergence->tiles_x * convergence->tiles_y;
}

// --- samples -----------------------------------------------------------------------------------

static bool make_samples(const DipConvergence *c, int tile, int per_pixel, Samples *samples) {
    const size_t count = (size_t)TILE * TILE * (size_t)per_pixel;
    const size_t peels = c->triangles.has_blended ? count : 0;
    double *memory =
        malloc(peels * sizeof(DipRefPeel) + count * (4 * sizeof(double) + sizeof(int32_t)));
    const int x0 = tile % c->tiles_x * TILE;
    const int y0 = tile / c->tiles_x * TILE;
    *samples = (Samples){
        .convergence = c,
        .per_pixel = per_pixel,
        .x0 = x0,
        .y0 = y0,
        .x1 = x0 + TILE < c->shot.width ? x0 + TILE : c->shot.width,
        .y1 = y0 + TILE < c->shot.height ? y0 + TILE : c->shot.height,
        .memory = memory,
    };
    if (memory) {
        samples->peels = peels ? (DipRefPeel *)memory : NULL;
        memory = (double *)((DipRefPeel *)memory + peels);
        samples->x = memory;
        samples->y = memory + count;
        samples->depths = memory + 2 * count;
        samples->clip_depths = memory + 3 * count;
        samples->triangles = (int32_t *)(memory + 4 * count);
    }
    return samples->memory != NULL;
}

// Returns the index of a pixel's first sample.
static size_t first_of(const Samples *samples, int x, int y) {
    return (size_t)((y - samples->y0) * TILE + (x - samples->x0)) * (size_t)samples->per_pixel;
}

static void place_samples(Samples *samples, int side, uint32_t seed) {
    for (int y = samples->y0; y < samples->y1; y++) {
        for (int x = samples->x0; x < samples->x1; x++) {
            const size_t pixel = (size_t)y * (size_t)samples->convergence->shot.width + (size_t)x;
            const size_t first = first_of(samples, x, y);
            for (int s = 0; s < samples->per_pixel; s++) {
                const size_t i = first + (size_t)s;
                dip_reference_sample_position(s, side, seed, pixel, x, y, &samples->x[i],
                                              &samples->y[i]);
                samples->depths[i] = 0.0;
                samples->clip_depths[i] = 0.0;
                samples->triangles[i] = NOTHING;
            }
        }
    }
}

// --- triangles ---------------------------------------------------------------------------------

// An edge function, a * (y - y0) - b * (x - x0). Even after rounding, the function is monotone in x
// and in y. So the function's greatest value within a box is exactly the value at one of the
// corners.
typedef struct Edge {
    double a;
    double b;
    double x0;
    double y0;
} Edge;

static double edge_at(const Edge *edge, double x, double y) {
    return edge->a * (y - edge->y0) - edge->b * (x - edge->x0);
}

static void find_edges(const DipRefTriangle *triangle, Edge edges[3]) {
    for (int i = 0; i < 3; i++) {
        const DipRefVertex *from = &triangle->vertices[(i + 1) % 3];
        const DipRefVertex *to = &triangle->vertices[(i + 2) % 3];
        edges[i] = (Edge){to->x - from->x, to->y - from->y, from->x, from->y};
    }
}

static bool misses_pixel(const Edge edges[3], int x, int y) {
    for (int i = 0; i < 3; i++) {
        const double greatest_x = edges[i].b > 0.0 ? 256.0 * x : 256.0 * (x + 1.0);
        const double greatest_y = edges[i].a > 0.0 ? 256.0 * (y + 1.0) : 256.0 * y;
        if (edge_at(&edges[i], greatest_x, greatest_y) < 0.0) {
            return true;
        }
    }
    return false;
}

static void draw_in_sample(Samples *samples, const DipRefTriangle *triangle, int32_t index,
                           size_t i, const DipRefPosition *place) {
    const double depth = dip_reference_depth(place, samples->convergence->reference->def->near_m);
    if (triangle->blended) {
        dip_reference_peel_offer(&samples->peels[i], depth, index);
        return;
    }
    if (triangle->clipped) {
        samples->clip_depths[i] = fmax(samples->clip_depths[i], depth);
    }
    if (depth <= samples->depths[i]) {
        return;
    }
    if (triangle->clipped &&
        (float)dip_reference_alpha(place, NULL) < triangle->material->alpha_cutoff) {
        return;
    }
    samples->depths[i] = depth;
    samples->triangles[i] = index;
}

static void draw_in_pixel(Samples *samples, const DipRefTriangle *triangle, int32_t index,
                          const Edge edges[3], size_t first) {
    DipRefPosition place = {.triangle = triangle};
    for (size_t i = first; i < first + (size_t)samples->per_pixel; i++) {
        place.edges[0] = edge_at(&edges[0], samples->x[i], samples->y[i]);
        place.edges[1] = edge_at(&edges[1], samples->x[i], samples->y[i]);
        place.edges[2] = edge_at(&edges[2], samples->x[i], samples->y[i]);
        if (place.edges[0] >= 0.0 && place.edges[1] >= 0.0 && place.edges[2] >= 0.0) {
            draw_in_sample(samples, triangle, index, i, &place);
        }
    }
}

static int larger(int a, int b) {
    return a > b ? a : b;
}

static int smaller(int a, int b) {
    return a < b ? a : b;
}

// Draws the triangles that are not blended, or offers the blended ones to each sample's peel.
static void draw_triangles(Samples *samples, int tile, bool blended) {
    const DipConvergence *c = samples->convergence;
    for (size_t k = c->bins.first[tile]; k < c->bins.first[tile + 1]; k++) {
        const int32_t index = c->bins.items[k];
        const DipRefTriangle *triangle = &c->triangles.items[index];
        if (triangle->blended != blended) {
            continue;
        }
        Edge edges[3];
        find_edges(triangle, edges);
        const int last_x = smaller(triangle->max_x, samples->x1 - 1);
        const int last_y = smaller(triangle->max_y, samples->y1 - 1);
        for (int y = larger(triangle->min_y, samples->y0); y <= last_y; y++) {
            for (int x = larger(triangle->min_x, samples->x0); x <= last_x; x++) {
                if (!misses_pixel(edges, x, y)) {
                    draw_in_pixel(samples, triangle, index, edges, first_of(samples, x, y));
                }
            }
        }
    }
}

// --- what is seen ------------------------------------------------------------------------------

static DipRefPosition place_on(const DipRefTriangle *triangle, double x, double y) {
    Edge edges[3];
    DipRefPosition place = {.triangle = triangle, .x = x, .y = y};
    find_edges(triangle, edges);
    for (int e = 0; e < 3; e++) {
        place.edges[e] = edge_at(&edges[e], x, y);
    }
    return place;
}

// Whether a sample sees water, whose blended surfaces have been drawn.
static bool shows_water(const Samples *samples, size_t i) {
    const int32_t seen = samples->triangles[i];
    return (seen != NOTHING && samples->convergence->triangles.items[seen].water) ||
           (samples->peels && samples->peels[i].water);
}

static void find_colour(const Samples *samples, size_t i, double rgb[3]);

// Shades the surface at a place of sample i. rgba[3] is the share of what lies behind that it
// covers.
static void shade_surface(const Samples *samples, size_t i, const DipRefPosition *place,
                          double rgba[DIP_REF_LAYER]) {
    const DipConvergence *c = samples->convergence;
    dip_reference_shade(place, NULL, rgba);
    rgba[3] = dip_reference_opacity(place, NULL);
    if (samples->mirrored && place->triangle->water) {
        double mirrored[3];
        find_colour(samples->mirrored, i, mirrored);
        dip_reference_blend_water(c->reference, &c->shot, place, mirrored, rgba);
    }
    dip_reference_see_through(place, NULL, c->backdrop, rgba);
}

// Shades what is not blended.
static void shade_sample(const Samples *samples, size_t i, double rgb[3]) {
    const DipConvergence *c = samples->convergence;
    for (int k = 0; k < 3; k++) {
        rgb[k] = c->reference->def->background_lin[k];
    }
    if (samples->triangles[i] == NOTHING) {
        return;
    }
    const DipRefPosition place =
        place_on(&c->triangles.items[samples->triangles[i]], samples->x[i], samples->y[i]);
    double rgba[DIP_REF_LAYER];
    shade_surface(samples, i, &place, rgba);
    memcpy(rgb, rgba, 3 * sizeof *rgb);
}

// Returns the colour of a sample with its blended surfaces.
static void find_colour(const Samples *samples, size_t i, double rgb[3]) {
    if (samples->peels) {
        memcpy(rgb, samples->peels[i].rgb, sizeof samples->peels[i].rgb);
    } else {
        shade_sample(samples, i, rgb);
    }
}

// Calls a function for each sample within the frame. Returns whether any call returned true.
static bool for_each_sample(Samples *samples, bool (*visit)(Samples *samples, size_t i)) {
    bool any = false;
    for (int y = samples->y0; y < samples->y1; y++) {
        for (int x = samples->x0; x < samples->x1; x++) {
            const size_t first = first_of(samples, x, y);
            for (size_t i = first; i < first + (size_t)samples->per_pixel; i++) {
                any = visit(samples, i) || any;
            }
        }
    }
    return any;
}

static bool begin_peel(Samples *samples, size_t i) {
    double rgb[3];
    shade_sample(samples, i, rgb);
    samples->peels[i] = dip_reference_peel_begin(rgb, samples->depths[i]);
    return false;
}

static bool blend_next(Samples *samples, size_t i) {
    DipRefPeel *peel = &samples->peels[i];
    if (peel->next == NOTHING) {
        return false;
    }
    const DipRefTriangle *triangle = &samples->convergence->triangles.items[peel->next];
    const DipRefPosition place = place_on(triangle, samples->x[i], samples->y[i]);
    double rgba[DIP_REF_LAYER];
    shade_surface(samples, i, &place, rgba);
    dip_reference_peel_blend(peel, rgba);
    peel->water = peel->water || triangle->water;
    return true;
}

// Draws the blended surfaces of all samples. Each round draws the farthest that is left of each.
static void blend_samples(Samples *samples, int tile) {
    if (!samples->peels) {
        return;
    }
    for_each_sample(samples, begin_peel);
    do {
        draw_triangles(samples, tile, true);
    } while (for_each_sample(samples, blend_next));
}

static void shade_pixel(const Samples *samples, size_t first, double share, double *rgb_lin) {
    for (size_t i = first; i < first + (size_t)samples->per_pixel; i++) {
        double rgb[3];
        find_colour(samples, i, rgb);
        for (int k = 0; k < 3; k++) {
            rgb_lin[k] += share / samples->per_pixel * rgb[k];
        }
    }
}

// Returns how far the plane of triangle a lies in front of the plane of triangle b at a position,
// as a difference of depths.
static double depth_between(const Samples *samples, const DipRefTriangle *a,
                            const DipRefTriangle *b, double x, double y) {
    const double near_m = samples->convergence->reference->def->near_m;
    const DipRefPosition at_a = place_on(a, x, y);
    const DipRefPosition at_b = place_on(b, x, y);
    return dip_reference_depth(&at_a, near_m) - dip_reference_depth(&at_b, near_m);
}

// Returns true if sample i shows a continuation of the surface that the first sample shows. This is
// so if both samples show the same material and lie on planes that meet within a pixel. Depths are
// linear on the screen, so their difference is linear too. A corner between two walls counts as a
// continuation; an edge with something behind it does not.
static bool goes_on(const Samples *samples, size_t first, size_t i) {
    const DipConvergence *c = samples->convergence;
    if (samples->triangles[i] == samples->triangles[first]) {
        return true;
    }
    if (samples->triangles[i] == NOTHING || samples->triangles[first] == NOTHING) {
        return false;
    }
    const DipRefTriangle *a = &c->triangles.items[samples->triangles[first]];
    const DipRefTriangle *b = &c->triangles.items[samples->triangles[i]];
    const double x = samples->x[i], y = samples->y[i];
    const double gap = depth_between(samples, a, b, x, y);
    const double per_x = depth_between(samples, a, b, x + 256.0, y) - gap;
    const double per_y = depth_between(samples, a, b, x, y + 256.0) - gap;
    const double rounding = 1e-9 * samples->depths[i];
    return a->material == b->material &&
           fabs(gap) <= sqrt(per_x * per_x + per_y * per_y) + rounding;
}

static DipSeen classify(const Samples *samples, size_t first) {
    const DipConvergence *c = samples->convergence;
    bool water = false, clipped = false, edge = false;
    for (size_t i = first; i < first + (size_t)samples->per_pixel; i++) {
        water = water || shows_water(samples, i);
        clipped = clipped ||
                  (samples->clip_depths[i] > 0.0 && samples->clip_depths[i] >= samples->depths[i]);
        edge = edge || !goes_on(samples, first, i);
    }
    if (water || clipped || edge) {
        return water ? DIP_SEEN_WATER : clipped ? DIP_SEEN_CLIPPED : DIP_SEEN_EDGE;
    }
    if (samples->triangles[first] == NOTHING) {
        return DIP_SEEN_PLAIN;
    }
    const DipRefTriangle *triangle = &c->triangles.items[samples->triangles[first]];
    return triangle->colour && triangle->material->surface != DIP_SURFACE_SKY ? DIP_SEEN_TEXTURED
                                                                              : DIP_SEEN_PLAIN;
}

static bool has_water(const DipConvergence *c, int tile) {
    bool any = false;
    for (size_t k = c->bins.first[tile]; !any && k < c->bins.first[tile + 1]; k++) {
        any = c->triangles.items[c->bins.items[k]].water;
    }
    return any;
}

// Places the samples of a tile and finds the triangle that each of them shows.
static bool draw_samples(const DipConvergence *convergence, int tile, int sample_count, int side,
                         uint32_t seed, Samples *samples) {
    if (!make_samples(convergence, tile, sample_count, samples)) {
        return false;
    }
    place_samples(samples, side, seed);
    draw_triangles(samples, tile, false);
    return true;
}

bool dip_convergence_add_tile(const DipConvergence *convergence, int tile, int sample_count,
                              uint32_t seed, double share, double *rgb_lin, uint8_t *classes,
                              DipError *err) {
    DIP_FP_MODE_SCOPE();
    int side;
    Samples samples;
    Samples mirrored = {0};
    const int tile_count = dip_convergence_tile_count(convergence);
    if (tile < 0 || tile >= tile_count) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "tile", "%d, accepted 0..%d", tile,
                             tile_count - 1);
    }
    if (!dip_reference_check_samples(sample_count, &side, err)) {
        return false;
    }
    bool drawn = draw_samples(convergence, tile, sample_count, side, seed, &samples);
    if (drawn && convergence->mirrored && has_water(convergence, tile)) {
        drawn = draw_samples(convergence->mirrored, tile, sample_count, side, seed, &mirrored);
        samples.mirrored = &mirrored;
    }
    if (!drawn) {
        free(samples.memory);
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, NULL, "no memory for %d samples",
                             sample_count);
    }
    if (samples.mirrored) {
        blend_samples(&mirrored, tile);
    }
    blend_samples(&samples, tile);
    for (int y = samples.y0; y < samples.y1; y++) {
        for (int x = samples.x0; x < samples.x1; x++) {
            const size_t pixel = (size_t)y * (size_t)convergence->shot.width + (size_t)x;
            const size_t first = first_of(&samples, x, y);
            shade_pixel(&samples, first, share, rgb_lin + 3 * pixel);
            if (classes) {
                classes[pixel] = (uint8_t)classify(&samples, first);
            }
        }
    }
    free(samples.memory);
    free(mirrored.memory);
    return true;
}
