// Draws the converged picture, in which each pixel is the mean of many jittered samples. The
// picture is the mean of planes. A plane has one sample of every pixel and is drawn as a whole.
#include "renderer/reference/internal/internal.h"

#include "renderer/base/fp_mode.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// BACKDROP_SIDE: the samples of the backdrop have a grid of this many in each direction of a pixel.
enum { NOTHING = -1, BACKDROP_SIDE = 4 };

// A plane: one sample of every pixel.
typedef struct Plane {
    double *x; // position of the sample in the frame, in 1/256 pixel
    double *y;
    double *depths;
    int32_t *triangles;
    DipRefPeel *peels; // NULL if no blended surface is in view
} Plane;

typedef struct Converging {
    const DipReference *reference;
    DipRefTriangles triangles;
    Plane plane;
    const struct Converging *mirrored; // the mirrored scene at the same positions, or NULL
    const DipRefBackdrop *backdrop;    // what rough glass shows blurred; NULL: it shows it sharp
    DipRefShot shot;
} Converging;

// A bijection of 64-bit numbers in which each output bit depends on all input bits (the finaliser
// of splitmix64), so consecutive inputs give unrelated outputs.
static uint64_t mix(uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

void dip_reference_sample_position(int index, int side, uint32_t seed, size_t pixel, int x, int y,
                                   double *place_x, double *place_y) {
    const uint64_t key = mix(((uint64_t)seed << 32) + (uint64_t)index + 0x9e3779b97f4a7c15u);
    const uint64_t random = mix(key ^ mix(pixel + 1));
    const double jitter_x = (double)(random >> 32) * 0x1p-32;
    const double jitter_y = (double)(random & 0xffffffffu) * 0x1p-32;
    *place_x = 256.0 * (x + (index % side + jitter_x) / side);
    *place_y = 256.0 * (y + (index / side + jitter_y) / side);
}

bool dip_reference_check_samples(int sample_count, int *side, DipError *err) {
    *side = sample_count > 0 ? (int)lround(sqrt(sample_count)) : 0;
    return (sample_count >= 1 && (int64_t)*side * *side == sample_count) ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "samples",
                         "%d per pixel is not a square, accepted 1, 4, 9, 16, ...", sample_count);
}

static void start_plane(Converging *c, int index, int side, uint32_t seed) {
    Plane *plane = &c->plane;
    for (int y = 0; y < c->shot.height; y++) {
        for (int x = 0; x < c->shot.width; x++) {
            const size_t pixel = (size_t)y * (size_t)c->shot.width + (size_t)x;
            dip_reference_sample_position(index, side, seed, pixel, x, y, &plane->x[pixel],
                                          &plane->y[pixel]);
            plane->depths[pixel] = 0.0;
            plane->triangles[pixel] = NOTHING;
        }
    }
}

static DipRefPosition place_at(const DipRefTriangle *triangle, double x, double y) {
    const DipRefVertex *v = triangle->vertices;
    return (DipRefPosition){triangle,
                            {(v[2].x - v[1].x) * (y - v[1].y) - (v[2].y - v[1].y) * (x - v[1].x),
                             (v[0].x - v[2].x) * (y - v[2].y) - (v[0].y - v[2].y) * (x - v[2].x),
                             (v[1].x - v[0].x) * (y - v[0].y) - (v[1].y - v[0].y) * (x - v[0].x)},
                            x,
                            y};
}

static void draw_in_pixel(Converging *c, int32_t index, size_t pixel) {
    const DipRefTriangle *triangle = &c->triangles.items[index];
    const DipRefPosition place = place_at(triangle, c->plane.x[pixel], c->plane.y[pixel]);
    if (place.edges[0] < 0.0 || place.edges[1] < 0.0 || place.edges[2] < 0.0) {
        return;
    }
    const double depth = dip_reference_depth(&place, c->reference->def->near_m);
    if (triangle->blended) {
        dip_reference_peel_offer(&c->plane.peels[pixel], depth, index);
        return;
    }
    if (depth <= c->plane.depths[pixel]) {
        return;
    }
    if (triangle->clipped &&
        (float)dip_reference_alpha(&place, NULL) < triangle->material->alpha_cutoff) {
        return;
    }
    c->plane.depths[pixel] = depth;
    c->plane.triangles[pixel] = index;
}

// Draws the triangles that are not blended, or offers the blended ones to each pixel's peel.
static void draw_triangles(Converging *c, bool blended) {
    for (size_t t = 0; t < c->triangles.count; t++) {
        const DipRefTriangle *triangle = &c->triangles.items[t];
        if (t % DIP_REF_STOP_PERIOD == 0 && dip_reference_stopped(c->reference, NULL)) {
            return;
        }
        if (triangle->blended != blended) {
            continue;
        }
        for (int y = triangle->min_y; y <= triangle->max_y; y++) {
            for (int x = triangle->min_x; x <= triangle->max_x; x++) {
                draw_in_pixel(c, (int32_t)t, (size_t)y * (size_t)c->shot.width + (size_t)x);
            }
        }
    }
}

static void find_colour(const Converging *c, size_t pixel, double rgb[3]);

// Shades the surface at a place of the plane's sample in a pixel. rgba[3] is the share of what lies
// behind that it covers.
static void shade_surface(const Converging *c, size_t pixel, const DipRefPosition *place,
                          double rgba[DIP_REF_LAYER]) {
    dip_reference_shade(place, NULL, rgba);
    rgba[3] = dip_reference_opacity(place, NULL);
    if (c->mirrored && place->triangle->water) {
        double mirrored[3];
        find_colour(c->mirrored, pixel, mirrored);
        dip_reference_blend_water(c->reference, &c->shot, place, mirrored, rgba);
    }
    dip_reference_see_through(place, NULL, c->backdrop, rgba);
}

// Computes the colour of the plane's sample in a pixel, without blended surfaces.
static void shade(const Converging *c, size_t pixel, double rgb[3]) {
    const int32_t index = c->plane.triangles[pixel];
    for (int i = 0; i < 3; i++) {
        rgb[i] = c->reference->def->background_lin[i];
    }
    if (index == NOTHING) {
        return;
    }
    const DipRefPosition place =
        place_at(&c->triangles.items[index], c->plane.x[pixel], c->plane.y[pixel]);
    double rgba[DIP_REF_LAYER];
    shade_surface(c, pixel, &place, rgba);
    memcpy(rgb, rgba, 3 * sizeof *rgb);
}

// Returns the colour of the plane's sample in a pixel with its blended surfaces.
static void find_colour(const Converging *c, size_t pixel, double rgb[3]) {
    if (c->plane.peels) {
        memcpy(rgb, c->plane.peels[pixel].rgb, sizeof c->plane.peels[pixel].rgb);
    } else {
        shade(c, pixel, rgb);
    }
}

// Blends the farthest surface that is left in each pixel. Returns false if none is left anywhere.
static bool blend_next(Converging *c) {
    bool any = false;
    for (size_t pixel = 0; pixel < (size_t)c->shot.width * (size_t)c->shot.height; pixel++) {
        DipRefPeel *peel = &c->plane.peels[pixel];
        if (peel->next != NOTHING) {
            const DipRefPosition place =
                place_at(&c->triangles.items[peel->next], c->plane.x[pixel], c->plane.y[pixel]);
            double rgba[DIP_REF_LAYER];
            shade_surface(c, pixel, &place, rgba);
            dip_reference_peel_blend(peel, rgba);
            any = true;
        }
    }
    return any;
}

static void draw_plane(Converging *c) {
    draw_triangles(c, false);
    for (size_t pixel = 0; c->plane.peels && pixel < (size_t)c->shot.width * (size_t)c->shot.height;
         pixel++) {
        double rgb[3];
        shade(c, pixel, rgb);
        c->plane.peels[pixel] = dip_reference_peel_begin(rgb, c->plane.depths[pixel]);
    }
    bool left = c->plane.peels != NULL;
    while (left) {
        draw_triangles(c, true);
        left = blend_next(c);
    }
}

static void add_plane(const Converging *c, double weight, double *rgb_lin) {
    const size_t pixel_count = (size_t)c->shot.width * (size_t)c->shot.height;
    for (size_t pixel = 0; pixel < pixel_count; pixel++) {
        double rgb[3];
        find_colour(c, pixel, rgb);
        for (size_t i = 0; i < 3; i++) {
            rgb_lin[3 * pixel + i] += weight * rgb[i];
        }
    }
}

static bool make_plane(Converging *c, DipError *err) {
    const size_t count = (size_t)c->shot.width * (size_t)c->shot.height;
    Plane *plane = &c->plane;
    plane->x = malloc(count * sizeof *plane->x);
    plane->y = malloc(count * sizeof *plane->y);
    plane->depths = malloc(count * sizeof *plane->depths);
    plane->triangles = malloc(count * sizeof *plane->triangles);
    if (c->triangles.has_blended) {
        plane->peels = malloc(count * sizeof *plane->peels);
    }
    return (plane->x && plane->y && plane->depths && plane->triangles &&
            (plane->peels || !c->triangles.has_blended)) ||
           dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, NULL, "no memory for %zu samples", count);
}

static bool start(Converging *c, DipError *err) {
    return dip_reference_build_triangles(c->reference, &c->shot, &c->triangles, err) &&
           make_plane(c, err);
}

static void finish(Converging *c) {
    dip_reference_triangles_free(&c->triangles);
    free(c->plane.x);
    free(c->plane.y);
    free(c->plane.depths);
    free(c->plane.triangles);
    free(c->plane.peels);
}

// Adds a sample of each pixel of what is not blended to the backdrop's picture.
static void add_backdrop_plane(Converging *c, Converging *mirrored, int index, double *rgb_lin) {
    if (mirrored) {
        start_plane(mirrored, index, BACKDROP_SIDE, 0);
        draw_plane(mirrored);
    }
    start_plane(c, index, BACKDROP_SIDE, 0);
    draw_triangles(c, false);
    for (size_t pixel = 0; pixel < (size_t)c->shot.width * (size_t)c->shot.height; pixel++) {
        double rgb[3];
        shade(c, pixel, rgb);
        for (size_t i = 0; i < 3; i++) {
            rgb_lin[3 * pixel + i] += rgb[i] / (BACKDROP_SIDE * BACKDROP_SIDE);
        }
    }
}

// Draws the backdrop of a view whose triangles have been built. mirrored: as in
// dip_reference_converge, or NULL.
static bool converge_backdrop(Converging *c, Converging *mirrored, DipRefBackdrop **backdrop,
                              DipError *err) {
    double *rgb_lin = calloc((size_t)c->shot.width * (size_t)c->shot.height * 3, sizeof *rgb_lin);
    bool drawn = rgb_lin != NULL;
    for (int s = 0; drawn && s < BACKDROP_SIDE * BACKDROP_SIDE; s++) {
        add_backdrop_plane(c, mirrored, s, rgb_lin);
        if (dip_reference_stopped(c->reference, err)) {
            free(rgb_lin);
            return false;
        }
    }
    *backdrop =
        drawn ? dip_reference_backdrop_create(rgb_lin, c->shot.width, c->shot.height) : NULL;
    free(rgb_lin);
    return *backdrop ||
           dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, NULL, "no memory for rough glass");
}

bool dip_reference_converge_backdrop(const DipReference *reference, const DipPose *pose, int width,
                                     int height, DipRefBackdrop **backdrop, DipError *err) {
    Converging c = {.reference = reference,
                    .shot = {pose, width, height, (double)width / height, .shadows = true}};
    Converging mirrored = c;
    mirrored.shot.mirrored = true;
    *backdrop = NULL;
    bool drawn = dip_reference_build_triangles(reference, &c.shot, &c.triangles, err);
    if (drawn && c.triangles.has_scattering) {
        drawn = make_plane(&c, err);
        if (drawn && c.triangles.has_water && dip_reference_reflects(reference, pose)) {
            c.mirrored = &mirrored;
            drawn = start(&mirrored, err);
        }
        drawn = drawn && converge_backdrop(&c, c.mirrored ? &mirrored : NULL, backdrop, err);
    }
    finish(&c);
    finish(&mirrored);
    return drawn;
}

bool dip_reference_converge(const DipReference *reference, const DipPose *pose, int width,
                            int height, int sample_count, uint32_t seed, double *rgb_lin,
                            DipError *err) {
    DIP_FP_MODE_SCOPE();
    int side;
    if (!dip_reference_check_samples(sample_count, &side, err) ||
        !dip_reference_check_frame(reference, pose, width, height, err)) {
        return false;
    }
    Converging c = {.reference = reference,
                    .shot = {pose, width, height, (double)width / height, .shadows = true}};
    Converging mirrored = c;
    mirrored.shot.mirrored = true;
    DipRefBackdrop *backdrop = NULL;
    bool converged =
        dip_reference_converge_backdrop(reference, pose, width, height, &backdrop, err) &&
        start(&c, err);
    c.backdrop = backdrop;
    if (converged && dip_reference_reflects(reference, pose)) {
        c.mirrored = &mirrored;
        converged = start(&mirrored, err);
    }
    for (size_t i = 0; converged && i < (size_t)width * (size_t)height * 3; i++) {
        rgb_lin[i] = 0.0;
    }
    for (int s = 0; converged && s < sample_count; s++) {
        if (c.mirrored) {
            start_plane(&mirrored, s, side, seed);
            draw_plane(&mirrored);
        }
        start_plane(&c, s, side, seed);
        draw_plane(&c);
        add_plane(&c, 1.0 / sample_count, rgb_lin);
        // Drawing may have ended early, so that the plane lacks triangles.
        converged = !dip_reference_stopped(reference, err);
    }
    finish(&c);
    finish(&mirrored);
    dip_reference_backdrop_destroy(&backdrop);
    return converged;
}
