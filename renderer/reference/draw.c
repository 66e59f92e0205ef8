// Draws the picture that the settings define. Coverage is exact and depth is tested per sample.
// Each patch (a piece of a surface, docs/picture.md) is shaded once per pixel.
#include "renderer/reference/internal/differences.h"
#include "renderer/reference/internal/internal.h"

#include "renderer/base/fp_mode.h"
#include "renderer/pipeline/pattern.h"

#include <math.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;

enum { NOTHING = -1 };

// The nearest surface so far at each sample: its depth and the index of its triangle.
typedef struct Samples {
    double *depths;
    int32_t *triangles;
} Samples;

// A blended triangle in a pixel.
typedef struct Layer {
    int32_t triangle;
    unsigned mask; // samples that it covers
    size_t next;   // index of another layer of the pixel, plus 1; 0: there is none
    bool shaded;   // rgba is valid
    double rgba[DIP_REF_LAYER];
} Layer;

// The layers of a picture.
typedef struct Layers {
    Layer *items;
    size_t count;
    size_t capacity;
    size_t *first; // for each pixel, the index of one of its layers, plus 1; NULL: none are blended
    bool complete; // false: memory ran out
} Layers;

typedef struct Drawing {
    const DipReference *reference;
    const DipSamplePattern *pattern;
    DipSampleGroups groups; // the sample groups of clipped surfaces
    bool groups_shade_all;  // the groups are those of all surfaces
    bool covers_by_alpha;   // alpha decides how many samples a clipped surface covers
    DipRefTriangles triangles;
    DipRefFilter filter;
    DipRefFilter group_filter; // filter of surfaces that have several sample groups in a pixel
    Samples samples;
    Layers layers;
    DipRefShot shot;
    int width;
    int height;
    int mirrored_size[2];           // width and height of the picture of the mirrored scene
    const double *mirrored;         // picture of the mirrored scene; NULL if water does not reflect
    bool without_blended;           // blended surfaces are left out
    const DipRefBackdrop *backdrop; // what rough glass shows blurred; NULL: it shows it sharp
} Drawing;

// Sets the filters of a picture that has several sample groups or only one.
static void set_filters(Drawing *drawing, const DipRefFilter *filter) {
    drawing->filter = drawing->group_filter = *filter;
    drawing->group_filter.bias -= round(128.0 * log2(drawing->groups.count)) / 256.0;
}

// Returns twice the area of the triangle (from, to, (x, y)), exactly. Positions are in 1/256
// pixel. Their magnitude is at most 2^29, because triangles are cut at the guard band.
static int64_t find_edge(const DipRefVertex *from, const DipRefVertex *to, int64_t x, int64_t y) {
    const int64_t from_x = (int64_t)from->x, from_y = (int64_t)from->y;
    return ((int64_t)to->x - from_x) * (y - from_y) - ((int64_t)to->y - from_y) * (x - from_x);
}

// Returns true if samples on this edge belong to the triangle. They do if the rest of the triangle
// lies to the right of the edge. Samples on an exactly horizontal edge belong to the triangle if
// its rest lies below. The corners are clockwise to the eye.
static bool is_top_left(const DipRefVertex *from, const DipRefVertex *to) {
    return to->y < from->y || (to->y == from->y && to->x > from->x);
}

static void find_edges(const DipRefTriangle *triangle, int64_t x, int64_t y, int64_t edges[3]) {
    for (int i = 0; i < 3; i++) {
        edges[i] =
            find_edge(&triangle->vertices[(i + 1) % 3], &triangle->vertices[(i + 2) % 3], x, y);
    }
}

static bool covers(const DipRefTriangle *triangle, int64_t x, int64_t y) {
    int64_t edges[3];
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

static DipRefPosition place_at(const DipRefTriangle *triangle, int64_t x, int64_t y) {
    int64_t edges[3];
    find_edges(triangle, x, y, edges);
    return (DipRefPosition){
        triangle, {(double)edges[0], (double)edges[1], (double)edges[2]}, (double)x, (double)y};
}

// Returns the position of one of a pixel's samples on a triangle.
static DipRefPosition place_at_sample(const Drawing *drawing, const DipRefTriangle *triangle, int x,
                                      int y, int sample) {
    return place_at(triangle, (int64_t)x * 256 + drawing->pattern->x[sample],
                    (int64_t)y * 256 + drawing->pattern->y[sample]);
}

// Finds the position at which a surface is shaded in a pixel. mask has a bit for each sample that
// shows the surface. If all samples show the surface, the position is the pixel's centre. Otherwise
// it is the position of the first sample in mask.
static DipRefPosition place_to_shade(const Drawing *drawing, const DipRefTriangle *triangle, int x,
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

static bool has_groups(const Drawing *drawing, const DipRefTriangle *triangle) {
    const bool all = drawing->groups_shade_all && !triangle->blended;
    return (triangle->clipped || all) && drawing->groups.count > 1;
}

static const DipRefFilter *filter_of(const Drawing *drawing, const DipRefTriangle *triangle) {
    return has_groups(drawing, triangle) ? &drawing->group_filter : &drawing->filter;
}

// Finds the position at which a sample group is shaded: the centroid of its samples in mask,
// rounded down.
static DipRefPosition place_of_pass(const Drawing *drawing, const DipRefTriangle *triangle, int x,
                                    int y, unsigned mask) {
    int sum_x = 0, sum_y = 0, count = 0;
    for (int s = 0; s < drawing->pattern->count; s++) {
        if (mask >> s & 1) {
            sum_x += drawing->pattern->x[s];
            sum_y += drawing->pattern->y[s];
            count++;
        }
    }
    return place_at(triangle, (int64_t)x * 256 + sum_x / count, (int64_t)y * 256 + sum_y / count);
}

static bool alpha_keeps(const Drawing *drawing, const DipRefPosition *place) {
    const double alpha = dip_reference_alpha(place, filter_of(drawing, place->triangle));
    return (float)alpha >= place->triangle->material->alpha_cutoff;
}

// Returns the first samples, in the order of alpha to coverage, as many as alpha asks for.
static unsigned samples_by_alpha(const Drawing *drawing, const DipRefPosition *place) {
    double slope;
    const double alpha = dip_reference_alpha_slope(place, &drawing->filter, &slope);
    const double cutoff = (double)place->triangle->material->alpha_cutoff;
    const double share = ((double)(float)alpha - cutoff) / fmax(slope, 0.02) + 0.5;
    const double wanted = floor(fmin(fmax(share, 0.0), 1.0) * drawing->pattern->count + 0.5);
    unsigned samples = 0;
    for (int i = 0; i < (int)wanted; i++) {
        samples |= 1u << drawing->pattern->order[i];
    }
    return samples;
}

// Returns the covered samples that the alpha test keeps. Each sample group is tested on its own.
static unsigned clip_samples(const Drawing *drawing, const DipRefTriangle *triangle, int x, int y,
                             unsigned mask) {
    if (!has_groups(drawing, triangle)) {
        const DipRefPosition place = place_to_shade(drawing, triangle, x, y, mask);
        if (drawing->covers_by_alpha) {
            return mask & samples_by_alpha(drawing, &place);
        }
        return alpha_keeps(drawing, &place) ? mask : 0;
    }
    unsigned kept = 0;
    for (int p = 0; p < drawing->groups.count; p++) {
        const unsigned covered = mask & drawing->groups.samples[p];
        if (covered) {
            const DipRefPosition place = place_of_pass(drawing, triangle, x, y, covered);
            kept |= alpha_keeps(drawing, &place) ? covered : 0;
        }
    }
    return kept;
}

static void add_layer(Drawing *drawing, int32_t index, int x, int y, unsigned mask) {
    Layers *layers = &drawing->layers;
    if (layers->count == layers->capacity) {
        const size_t capacity = layers->capacity ? 2 * layers->capacity : 1024;
        Layer *items = realloc(layers->items, capacity * sizeof *items);
        if (!items) {
            layers->complete = false;
            return;
        }
        layers->items = items;
        layers->capacity = capacity;
    }
    size_t *first = &layers->first[(size_t)y * (size_t)drawing->width + (size_t)x];
    layers->items[layers->count++] = (Layer){.triangle = index, .mask = mask, .next = *first};
    *first = layers->count;
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
    if (mask && triangle->clipped) {
        mask = clip_samples(drawing, triangle, x, y, mask);
    }
    if (triangle->blended) {
        if (mask && !drawing->without_blended) {
            add_layer(drawing, index, x, y, mask);
        }
        return;
    }
    const size_t first = ((size_t)y * (size_t)drawing->width + (size_t)x) * (size_t)pattern->count;
    for (int s = 0; s < pattern->count; s++) {
        if (mask >> s & 1) {
            const DipRefPosition place = place_at_sample(drawing, triangle, x, y, s);
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

// Shades a surface at the samples in mask, which belong to one pixel or to one sample group of a
// pixel. rgba[3] is the share of what lies behind that the surface covers.
static void shade(const Drawing *drawing, int32_t surface, int x, int y, unsigned mask,
                  double rgba[DIP_REF_LAYER]) {
    const DipRefTriangle *triangle = &drawing->triangles.items[surface];
    const DipRefPosition place = has_groups(drawing, triangle)
                                     ? place_of_pass(drawing, triangle, x, y, mask)
                                     : place_to_shade(drawing, triangle, x, y, mask);
    dip_reference_shade(&place, filter_of(drawing, triangle), rgba);
    rgba[3] = dip_reference_opacity(&place, filter_of(drawing, triangle));
    if (drawing->mirrored && triangle->water) {
        double mirrored[3];
        dip_reference_read_mirrored(drawing->mirrored, drawing->mirrored_size, drawing->width,
                                    drawing->height, &place, mirrored);
        dip_reference_blend_water(drawing->reference, &drawing->shot, &place, mirrored, rgba);
    }
    dip_reference_see_through(&place, filter_of(drawing, triangle), drawing->backdrop, rgba);
}

static bool same_patch(const Drawing *drawing, int32_t a, int32_t b) {
    const DipRefTriangle *triangles = drawing->triangles.items;
    return a == b || (a != NOTHING && b != NOTHING && triangles[a].patch == triangles[b].patch);
}

// Returns the samples that are shaded together with sample s.
static unsigned shaded_with(const Drawing *drawing, const int32_t *surfaces, int s) {
    unsigned mask = 0;
    for (int other = 0; other < drawing->pattern->count; other++) {
        mask |= (unsigned)same_patch(drawing, surfaces[other], surfaces[s]) << other;
    }
    if (surfaces[s] != NOTHING && has_groups(drawing, &drawing->triangles.items[surfaces[s]])) {
        mask &= drawing->groups.sharing[s];
    }
    return mask;
}

// Returns the farthest layer of a sample that is left: one in front of the depth `behind`, or at
// this depth and submitted after the triangle `last`. Returns NULL if none is left.
static Layer *next_layer(const Drawing *drawing, int x, int y, int s, double behind, int32_t last,
                         double *depth) {
    const Layers *layers = &drawing->layers;
    Layer *found = NULL;
    size_t at = layers->first[(size_t)y * (size_t)drawing->width + (size_t)x];
    for (; at; at = layers->items[at - 1].next) {
        Layer *layer = &layers->items[at - 1];
        if (!(layer->mask >> s & 1)) {
            continue;
        }
        const DipRefPosition place =
            place_at_sample(drawing, &drawing->triangles.items[layer->triangle], x, y, s);
        const double own = dip_reference_depth(&place, drawing->reference->def->near_m);
        const bool is_left = own > behind || (own == behind && layer->triangle > last);
        const bool is_first =
            !found || own < *depth || (own == *depth && layer->triangle < found->triangle);
        if (is_left && is_first) {
            found = layer;
            *depth = own;
        }
    }
    return found;
}

// Blends the layers of a sample over its colour, from far to near.
static void blend_sample(const Drawing *drawing, int x, int y, int s, double rgb[3]) {
    const size_t pixel = (size_t)y * (size_t)drawing->width + (size_t)x;
    double behind = drawing->samples.depths[pixel * (size_t)drawing->pattern->count + (size_t)s];
    int32_t last = INT32_MAX; // a layer at the depth of the opaque surface is hidden
    double depth = 0.0;
    Layer *layer = next_layer(drawing, x, y, s, behind, last, &depth);
    while (layer) {
        if (!layer->shaded) {
            shade(drawing, layer->triangle, x, y, layer->mask, layer->rgba);
            layer->shaded = true;
        }
        dip_reference_blend(layer->rgba, rgb);
        behind = depth;
        last = layer->triangle;
        layer = next_layer(drawing, x, y, s, behind, last, &depth);
    }
}

// Adds the colours of the samples in mask, which show one colour below their layers.
static void add_samples(const Drawing *drawing, int x, int y, unsigned mask, const double colour[3],
                        double sum[3]) {
    const size_t pixel = (size_t)y * (size_t)drawing->width + (size_t)x;
    if (!drawing->layers.first || !drawing->layers.first[pixel]) {
        for (int c = 0; c < 3; c++) {
            sum[c] += colour[c] * __builtin_popcount(mask);
        }
        return;
    }
    for (unsigned left = mask; left; left &= left - 1) {
        double rgb[3] = {colour[0], colour[1], colour[2]};
        blend_sample(drawing, x, y, __builtin_ctz(left), rgb);
        for (int c = 0; c < 3; c++) {
            sum[c] += rgb[c];
        }
    }
}

// Computes the mean of a pixel's samples. Each surface among them is shaded once, or once per
// sample group.
static void resolve_pixel(const Drawing *drawing, int x, int y, double rgb[3]) {
    const int count = drawing->pattern->count;
    const int32_t *surfaces = drawing->samples.triangles +
                              ((size_t)y * (size_t)drawing->width + (size_t)x) * (size_t)count;
    double sum[3] = {0};
    unsigned done = 0;
    for (int s = 0; s < count; s++) {
        if (done >> s & 1) {
            continue;
        }
        const unsigned mask = shaded_with(drawing, surfaces, s);
        done |= mask;
        double colour[DIP_REF_LAYER];
        if (surfaces[s] == NOTHING) {
            for (int c = 0; c < 3; c++) {
                colour[c] = drawing->reference->def->background_lin[c];
            }
        } else {
            shade(drawing, surfaces[s], x, y, mask, colour);
        }
        add_samples(drawing, x, y, mask, colour, sum);
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
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, NULL, "out of memory for %zu samples",
                             count);
    }
    for (size_t i = 0; i < count; i++) {
        drawing->samples.triangles[i] = NOTHING;
    }
    return true;
}

static bool out_of_layers(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, NULL,
                         "out of memory for blended surfaces");
}

static bool make_layers(Drawing *drawing, DipError *err) {
    drawing->layers = (Layers){.complete = true};
    if (drawing->triangles.has_blended && !drawing->without_blended) {
        const size_t pixels = (size_t)drawing->width * (size_t)drawing->height;
        drawing->layers.first = calloc(pixels, sizeof *drawing->layers.first);
        return drawing->layers.first || out_of_layers(err);
    }
    return true;
}

// Draws the picture of a shot (a view that is drawn to one picture). The caller must have built the
// shot's triangles.
static bool draw_built(Drawing *drawing, double *rgb_lin, DipError *err) {
    bool made = make_samples(drawing, err) && make_layers(drawing, err);
    if (made) {
        draw_triangles(drawing);
        made = drawing->layers.complete || out_of_layers(err);
    }
    if (made) {
        for (int y = 0; y < drawing->height; y++) {
            for (int x = 0; x < drawing->width; x++) {
                resolve_pixel(drawing, x, y,
                              rgb_lin + 3 * ((size_t)y * (size_t)drawing->width + (size_t)x));
            }
        }
    }
    free(drawing->samples.depths);
    free(drawing->samples.triangles);
    free(drawing->layers.items);
    free(drawing->layers.first);
    return made;
}

// Draws the mirrored scene with the same settings. Returns NULL on failure.
static double *draw_mirrored(const Drawing *drawing, DipError *err) {
    Drawing mirrored = *drawing;
    mirrored.width = mirrored.shot.width = drawing->mirrored_size[0];
    mirrored.height = mirrored.shot.height = drawing->mirrored_size[1];
    mirrored.shot.mirrored = true;
    // Only the frame itself may be sharper than its textures' sizes ask for.
    DipRefFilter filter = drawing->filter;
    filter.bias = fmax(0.0, filter.bias - filter.scale_bias);
    set_filters(&mirrored, &filter);
    // The height of two texels of the mirrored picture, at a distance of 1.
    mirrored.shot.margin =
        4.0 * tan(drawing->shot.pose->fov_y_deg * (pi / 360.0)) / mirrored.height;
    double *rgb_lin = malloc((size_t)mirrored.width * (size_t)mirrored.height * 3 * sizeof(double));
    if (!rgb_lin) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, NULL, "out of memory for the reflection");
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
    if (drawing->reference->differs) {
        dip_reference_round_picture(rgb_lin, mirrored.width * mirrored.height);
    }
    return rgb_lin;
}

// Draws what rough glass shows blurred: the picture without blended surfaces. rgb_lin is scratch
// space for it. Returns NULL on failure.
static DipRefBackdrop *draw_backdrop(const Drawing *drawing, double *rgb_lin, DipError *err) {
    Drawing behind = *drawing;
    behind.without_blended = true;
    if (!draw_built(&behind, rgb_lin, err)) {
        return NULL;
    }
    DipRefBackdrop *backdrop =
        dip_reference_backdrop_create(rgb_lin, drawing->width, drawing->height);
    if (!backdrop) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, NULL, "out of memory for rough glass");
    }
    return backdrop;
}

// Draws the picture of a view in any number of pixels. aspect: width / height of the view.
static bool draw_picture(const DipReference *reference, const DipQuality *quality,
                         const DipPose *pose, double aspect, int width, int height, double *rgb_lin,
                         DipError *err) {
    Drawing drawing = {
        .reference = reference,
        .pattern = dip_sample_pattern_of(
            dip_quality_sample_count(quality),
            dip_pattern_kind(dip_quality_alternates(quality), reference->frame_index)),
        .groups_shade_all = dip_quality_groups_shade_all(quality),
        .covers_by_alpha = dip_quality_covers_by_alpha(quality),
        .shot = {pose, width, height, aspect, .rounded = true,
                 .shadows = quality->step[DIP_SETTING_SHADOWS] != 0},
        .mirrored_size = {dip_quality_drawn_size(quality, reference->reflection.width),
                          dip_quality_drawn_size(quality, reference->reflection.height)},
        .width = width,
        .height = height,
    };
    dip_sample_groups_make(&drawing.groups, drawing.pattern,
                           dip_quality_samples_per_group(quality));
    const DipRefFilter filter = dip_reference_colour_filter(quality);
    set_filters(&drawing, &filter);
    bool drawn = dip_reference_build_triangles(reference, &drawing.shot, &drawing.triangles, err);
    double *mirrored = NULL;
    if (drawn && dip_reference_reflects(reference, pose) && drawing.triangles.has_water) {
        mirrored = draw_mirrored(&drawing, err);
        drawing.mirrored = mirrored;
        drawn = mirrored != NULL;
    }
    DipRefBackdrop *backdrop = NULL;
    if (drawn && drawing.triangles.has_scattering) {
        backdrop = draw_backdrop(&drawing, rgb_lin, err);
        drawing.backdrop = backdrop;
        drawn = backdrop != NULL;
    }
    drawn = drawn && draw_built(&drawing, rgb_lin, err);
    dip_reference_triangles_free(&drawing.triangles);
    dip_reference_backdrop_destroy(&backdrop);
    free(mirrored);
    return drawn;
}

// Computes the mean of a larger picture over the part that belongs to one pixel of a smaller one.
static void average_box(const double *larger, int from_width, int from_height, int x, int y,
                        int width, int height, double rgb[3]) {
    const double ratio_x = (double)from_width / width, ratio_y = (double)from_height / height;
    double sum[3] = {0.0, 0.0, 0.0};
    for (int j = (int)(y * ratio_y); j < from_height && j < (y + 1) * ratio_y; j++) {
        const double high = fmin(j + 1.0, (y + 1) * ratio_y) - fmax(j, y * ratio_y);
        for (int i = (int)(x * ratio_x); i < from_width && i < (x + 1) * ratio_x; i++) {
            const double wide = fmin(i + 1.0, (x + 1) * ratio_x) - fmax(i, x * ratio_x);
            for (int c = 0; c < 3; c++) {
                sum[c] += high * wide *
                          larger[3 * ((size_t)j * (size_t)from_width + (size_t)i) + (size_t)c];
            }
        }
    }
    for (int c = 0; c < 3; c++) {
        rgb[c] = sum[c] / (ratio_x * ratio_y);
    }
}

bool dip_reference_draw(const DipReference *reference, const DipQuality *quality,
                        const DipPose *pose, int width, int height, double *rgb_lin,
                        DipError *err) {
    DIP_FP_MODE_SCOPE();
    if (!dip_quality_check(quality, err) ||
        !dip_reference_check_frame(reference, pose, width, height, err)) {
        return false;
    }
    if (reference->for_truth) {
        return dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, "reference",
                             "it was created for converged pictures only, accepted one of "
                             "dip_reference_create");
    }
    const double aspect = (double)width / height;
    const int drawn_width = dip_quality_drawn_size(quality, width);
    const int drawn_height = dip_quality_drawn_size(quality, height);
    if (drawn_width == width && drawn_height == height) {
        return draw_picture(reference, quality, pose, aspect, width, height, rgb_lin, err);
    }
    if (!dip_reference_check_frame(reference, pose, drawn_width, drawn_height, err)) {
        return false;
    }
    double *picture = malloc((size_t)drawn_width * (size_t)drawn_height * 3 * sizeof *picture);
    if (!picture) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, NULL,
                             "out of memory for a picture of %dx%d pixels", drawn_width,
                             drawn_height);
    }
    bool drawn =
        draw_picture(reference, quality, pose, aspect, drawn_width, drawn_height, picture, err);
    if (drawn && dip_quality_upscales(quality)) {
        drawn = dip_reference_enlarge(quality->step[DIP_SETTING_UPSCALE], picture, drawn_width,
                                      drawn_height, rgb_lin, width, height, err);
    } else {
        for (int i = 0; drawn && i < width * height; i++) {
            average_box(picture, drawn_width, drawn_height, i % width, i / width, width, height,
                        rgb_lin + 3 * (size_t)i);
        }
    }
    free(picture);
    return drawn;
}
