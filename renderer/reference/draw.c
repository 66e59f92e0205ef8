// The picture of the settings: exact coverage, depth per sample, one shading per pixel and surface.
#include "renderer/reference/private.h"

#include "renderer/raster/pattern.h"

#include <math.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;

__extension__ typedef __int128 Int128;

enum { NOTHING = -1 };

// The nearest surface so far, per sample: depth and the index of its triangle.
typedef struct Samples {
    double *depths;
    int32_t *triangles;
} Samples;

typedef struct Drawing {
    const DipReference *reference;
    const DipSamplePattern *pattern;
    DipRefTriangles triangles;
    DipRefFilter filter;
    Samples samples;
    DipRefShot shot;
    int width;
    int height;
    const double *mirrored; // the mirrored scene's picture; NULL: water does not reflect
} Drawing;

// Twice the area of (from, to, place), exactly; positions in 1/256 pixel.
static Int128 find_edge(const DipRefVertex *from, const DipRefVertex *to, int64_t x, int64_t y) {
    const int64_t from_x = (int64_t)from->x, from_y = (int64_t)from->y;
    return (Int128)((int64_t)to->x - from_x) * (y - from_y) -
           (Int128)((int64_t)to->y - from_y) * (x - from_x);
}

// Whether samples on this edge belong to the triangle: the edge is exactly horizontal and above
// the rest, or the rest lies to its right. Corners go clockwise to the eye.
static bool is_top_left(const DipRefVertex *from, const DipRefVertex *to) {
    return to->y < from->y || (to->y == from->y && to->x > from->x);
}

static void find_edges(const DipRefTriangle *triangle, int64_t x, int64_t y, Int128 edges[3]) {
    for (int i = 0; i < 3; i++) {
        edges[i] =
            find_edge(&triangle->vertices[(i + 1) % 3], &triangle->vertices[(i + 2) % 3], x, y);
    }
}

static bool covers(const DipRefTriangle *triangle, int64_t x, int64_t y) {
    Int128 edges[3];
    find_edges(triangle, x, y, edges);
    for (int i = 0; i < 3; i++) {
        const bool kept =
            is_top_left(&triangle->vertices[(i + 1) % 3], &triangle->vertices[(i + 2) % 3]);
        if (edges[i] < 0 || (edges[i] == 0 && !kept)) {
            return false;
        }
    }
    return true;
}

static DipRefPlace place_at(const DipRefTriangle *triangle, int64_t x, int64_t y) {
    Int128 edges[3];
    find_edges(triangle, x, y, edges);
    return (DipRefPlace){
        triangle, {(double)edges[0], (double)edges[1], (double)edges[2]}, (double)x, (double)y};
}

// A sample of a pixel.
static DipRefPlace place_at_sample(const Drawing *drawing, const DipRefTriangle *triangle, int x,
                                   int y, int sample) {
    return place_at(triangle, (int64_t)x * 256 + drawing->pattern->x[sample],
                    (int64_t)y * 256 + drawing->pattern->y[sample]);
}

// Where a surface that has these samples of a pixel (one bit each) is shaded: the centre when it
// has all, else the sample of the lowest index.
static DipRefPlace place_to_shade(const Drawing *drawing, const DipRefTriangle *triangle, int x,
                                  int y, unsigned mask) {
    if (mask == (1u << drawing->pattern->count) - 1u) {
        return place_at(triangle, (int64_t)x * 256 + 128, (int64_t)y * 256 + 128);
    }
    int lowest = 0;
    while (!(mask >> lowest & 1)) {
        lowest++;
    }
    return place_at_sample(drawing, triangle, x, y, lowest);
}

static void draw_in_pixel(Drawing *drawing, int32_t index, int x, int y) {
    const DipRefTriangle *triangle = &drawing->triangles.items[index];
    const DipSamplePattern *pattern = drawing->pattern;
    unsigned mask = 0;
    for (int s = 0; s < pattern->count; s++) {
        const bool covered =
            covers(triangle, (int64_t)x * 256 + pattern->x[s], (int64_t)y * 256 + pattern->y[s]);
        mask |= (unsigned)covered << s;
    }
    if (!mask) {
        return;
    }
    if (triangle->clipped) {
        const DipRefPlace place = place_to_shade(drawing, triangle, x, y, mask);
        if ((float)dip_reference_alpha(&place, &drawing->filter) <
            triangle->material->alpha_cutoff) {
            return;
        }
    }
    const size_t first = ((size_t)y * (size_t)drawing->width + (size_t)x) * (size_t)pattern->count;
    for (int s = 0; s < pattern->count; s++) {
        if (mask >> s & 1) {
            const DipRefPlace place = place_at_sample(drawing, triangle, x, y, s);
            const double depth = dip_reference_depth(&place, drawing->reference->def->near_m);
            if (depth > drawing->samples.depths[first + (size_t)s]) {
                drawing->samples.depths[first + (size_t)s] = depth;
                drawing->samples.triangles[first + (size_t)s] = index;
            }
        }
    }
}

static void draw_triangles(Drawing *drawing) {
    for (size_t t = 0; t < drawing->triangles.count; t++) {
        const DipRefTriangle *triangle = &drawing->triangles.items[t];
        for (int y = triangle->min_y; y <= triangle->max_y; y++) {
            for (int x = triangle->min_x; x <= triangle->max_x; x++) {
                draw_in_pixel(drawing, (int32_t)t, x, y);
            }
        }
    }
}

static void shade(const Drawing *drawing, const DipRefPlace *place, double rgb[3]) {
    dip_reference_shade(place, &drawing->filter, rgb);
    if (drawing->mirrored && place->triangle->material->surface == DIP_SURFACE_WATER) {
        double mirrored[3];
        dip_reference_read_mirrored(drawing->reference, drawing->mirrored, drawing->width,
                                    drawing->height, place, mirrored);
        dip_reference_blend_water(drawing->reference, drawing->shot.pose, drawing->width,
                                  drawing->height, place, mirrored, rgb);
    }
}

// The mean over a pixel's samples, each surface among them shaded once.
static void resolve_pixel(const Drawing *drawing, int x, int y, double rgb[3]) {
    const int count = drawing->pattern->count;
    const int32_t *surfaces = drawing->samples.triangles +
                              ((size_t)y * (size_t)drawing->width + (size_t)x) * (size_t)count;
    double sum[3] = {0};
    unsigned done = 0;
    for (int s = 0; s < count; s++) {
        unsigned mask = 0;
        int held = 0;
        for (int other = s; other < count && !(done >> s & 1); other++) {
            if (surfaces[other] == surfaces[s]) {
                mask |= 1u << other;
                held++;
            }
        }
        if (!mask) {
            continue;
        }
        done |= mask;
        double colour[3];
        if (surfaces[s] == NOTHING) {
            for (int c = 0; c < 3; c++) {
                colour[c] = drawing->reference->def->background_lin[c];
            }
        } else {
            const DipRefPlace place =
                place_to_shade(drawing, &drawing->triangles.items[surfaces[s]], x, y, mask);
            shade(drawing, &place, colour);
        }
        for (int c = 0; c < 3; c++) {
            sum[c] += colour[c] * held;
        }
    }
    for (int c = 0; c < 3; c++) {
        rgb[c] = sum[c] / count;
    }
}

static bool make_samples(Drawing *drawing, DipError *err) {
    const size_t count =
        (size_t)drawing->width * (size_t)drawing->height * (size_t)drawing->pattern->count;
    drawing->samples.depths = calloc(count, sizeof *drawing->samples.depths); // 0: infinitely far
    drawing->samples.triangles = malloc(count * sizeof *drawing->samples.triangles);
    if (!drawing->samples.depths || !drawing->samples.triangles) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, NULL, "no memory for %zu samples",
                             count);
    }
    for (size_t i = 0; i < count; i++) {
        drawing->samples.triangles[i] = NOTHING;
    }
    return true;
}

static bool sees_water(const Drawing *drawing) {
    for (size_t t = 0; t < drawing->triangles.count; t++) {
        if (drawing->triangles.items[t].material->surface == DIP_SURFACE_WATER) {
            return true;
        }
    }
    return false;
}

// The picture of a shot whose triangles are built.
static bool draw_built(Drawing *drawing, double *rgb_lin, DipError *err) {
    const bool made = make_samples(drawing, err);
    if (made) {
        draw_triangles(drawing);
        for (int y = 0; y < drawing->height; y++) {
            for (int x = 0; x < drawing->width; x++) {
                resolve_pixel(drawing, x, y,
                              rgb_lin + 3 * ((size_t)y * (size_t)drawing->width + (size_t)x));
            }
        }
    }
    free(drawing->samples.depths);
    free(drawing->samples.triangles);
    return made;
}

// The mirrored scene's picture as the same settings draw it; NULL on failure.
static double *draw_mirrored(const Drawing *drawing, DipError *err) {
    const DipReflectionDef *reflection = &drawing->reference->reflection;
    Drawing mirrored = *drawing;
    mirrored.width = mirrored.shot.width = reflection->width;
    mirrored.height = mirrored.shot.height = reflection->height;
    mirrored.shot.mirrored = true;
    // Two pixels of the picture, at a distance of 1.
    mirrored.shot.margin =
        4.0 * tan(drawing->shot.pose->fov_y_deg * (pi / 360.0)) / reflection->height;
    double *rgb_lin = malloc((size_t)mirrored.width * (size_t)mirrored.height * 3 * sizeof(double));
    if (!rgb_lin) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, NULL, "no memory for the reflection");
        return NULL;
    }
    const bool drawn = dip_reference_build_triangles(drawing->reference, &mirrored.shot,
                                                     &mirrored.triangles, err) &&
                       draw_built(&mirrored, rgb_lin, err);
    dip_reference_triangles_free(&mirrored.triangles);
    if (!drawn) {
        free(rgb_lin);
        return NULL;
    }
    return rgb_lin;
}

bool dip_reference_draw(const DipReference *reference, const DipQuality *quality,
                        const DipPose *pose, int width, int height, double *rgb_lin,
                        DipError *err) {
    if (!dip_quality_check(quality, err) || !dip_reference_check_size(width, height, err)) {
        return false;
    }
    Drawing drawing = {
        .reference = reference,
        .pattern = dip_sample_pattern(dip_quality_sample_count(quality)),
        .filter = dip_reference_colour_filter(quality),
        .shot = {pose, width, height, (double)width / height, .rounded = true},
        .width = width,
        .height = height,
    };
    bool drawn = dip_reference_build_triangles(reference, &drawing.shot, &drawing.triangles, err);
    double *mirrored = NULL;
    if (drawn && dip_reference_reflects(reference, pose) && sees_water(&drawing)) {
        mirrored = draw_mirrored(&drawing, err);
        drawing.mirrored = mirrored;
        drawn = mirrored != NULL;
    }
    drawn = drawn && draw_built(&drawing, rgb_lin, err);
    dip_reference_triangles_free(&drawing.triangles);
    free(mirrored);
    return drawn;
}
