// Enlarges the smaller picture of a scale below 1, in double precision (docs/post.md, Enlarging).
#include "renderer/reference/internal/internal.h"

#include <math.h>
#include <stdlib.h>

// The smaller picture: its codes, 0..1, which are whole multiples of 1/255, and their light.
typedef struct Source {
    double *codes;
    double *light;
    int width;
    int height;
} Source;

static double clamp(double value, double least, double most) {
    return fmin(fmax(value, least), most);
}

// Returns a channel of a pixel. Beyond the border, it is that of the nearest pixel.
static double read(const Source *source, const double *values, int x, int y, int channel) {
    x = x < 0 ? 0 : x < source->width ? x : source->width - 1;
    y = y < 0 ? 0 : y < source->height ? y : source->height - 1;
    return values[3 * ((size_t)y * (size_t)source->width + (size_t)x) + (size_t)channel];
}

// A place in the source: between the pixels x and x + 1, y and y + 1, and these parts of the way.
typedef struct Place {
    int x;
    int y;
    double part_x;
    double part_y;
} Place;

// Finds where the centre of a pixel of the result lies in the source along one axis.
static double find_place(int pixel, int from, int to, int *first) {
    const int numerator = (2 * pixel + 1) * from - to;
    const double place = numerator / (2.0 * to);
    *first = (int)floor(place);
    return place - *first;
}

// Clamps to the range of the four nearest pixels.
static double within_nearest(const Source *source, const double *values, const Place *place,
                             int channel, double value) {
    double least = 1.0, most = 0.0;
    for (int k = 0; k < 4; k++) {
        const double near = read(source, values, place->x + k % 2, place->y + k / 2, channel);
        least = fmin(least, near);
        most = fmax(most, near);
    }
    return clamp(value, least, most);
}

// --- separable filters ---------------------------------------------------------------------------

static double tent_weight(double distance) {
    return fmax(0.0, 1.0 - distance);
}

static double spline_weight(double distance) {
    const double d = distance;
    return d < 1.0   ? (1.5 * d - 2.5) * d * d + 1.0
           : d < 2.0 ? ((2.5 - 0.5 * d) * d - 4.0) * d + 2.0
                     : 0.0;
}

static void sum_light(const Source *source, const Place *place, bool bicubic, double rgb_lin[3]) {
    for (int c = 0; c < 3; c++) {
        double sum = 0.0;
        for (int k = 0; k < 16; k++) {
            const int dx = k % 4 - 1, dy = k / 4 - 1;
            const double across = fabs(dx - place->part_x), down = fabs(dy - place->part_y);
            const double weight = bicubic ? spline_weight(across) * spline_weight(down)
                                          : tent_weight(across) * tent_weight(down);
            sum += weight * read(source, source->light, place->x + dx, place->y + dy, c);
        }
        rgb_lin[c] = bicubic ? within_nearest(source, source->light, place, c, sum) : sum;
    }
}

// --- EASU ----------------------------------------------------------------------------------------

// The edge at a place: the direction across it, and how much of an edge it is, 0..1.
typedef struct Edge {
    double across[2];
    double amount;
} Edge;

static double luma(const Source *source, int x, int y) {
    return 0.5 * read(source, source->codes, x, y, 0) + read(source, source->codes, x, y, 1) +
           0.5 * read(source, source->codes, x, y, 2);
}

// Adds what a pixel of the source says about the edge along an axis.
static void add_to_edge(const Source *source, int x, int y, int axis, double weight, Edge *edge) {
    const double before = luma(source, x - !axis, y - axis);
    const double middle = luma(source, x, y);
    const double after = luma(source, x + !axis, y + axis);
    const double half = fmax(fabs(after - middle), fabs(middle - before));
    const double share = half > 0.0 ? fmin(1.0, fabs(after - before) / half) : 0.0;
    edge->across[axis] += weight * (after - before);
    edge->amount += weight * share * share;
}

static Edge find_edge(const Source *source, const Place *place) {
    Edge edge = {.amount = 0.0};
    for (int k = 0; k < 4; k++) {
        const double weight =
            tent_weight(fabs(k % 2 - place->part_x)) * tent_weight(fabs((k >> 1) - place->part_y));
        add_to_edge(source, place->x + k % 2, place->y + k / 2, 0, weight, &edge);
        add_to_edge(source, place->x + k % 2, place->y + k / 2, 1, weight, &edge);
    }
    const double square = edge.across[0] * edge.across[0] + edge.across[1] * edge.across[1];
    if (square < 1.0 / 32768.0) {
        edge.across[0] = 1.0;
    } else {
        edge.across[0] /= sqrt(square);
        edge.across[1] /= sqrt(square);
    }
    edge.amount = edge.amount * edge.amount / 4.0;
    return edge;
}

// Returns the weight of the pixel at a distance from the place.
static double easu_weight(const Edge *edge, double x, double y) {
    const double *a = edge->across;
    const double stretch = (a[0] * a[0] + a[1] * a[1]) / fmax(fabs(a[0]), fabs(a[1]));
    const double across = (x * a[0] + y * a[1]) * (1.0 + (stretch - 1.0) * edge->amount);
    const double along = (y * a[0] - x * a[1]) * (1.0 - 0.5 * edge->amount);
    const double lobe = 0.5 - 0.29 * edge->amount;
    const double square = fmin(across * across + along * along, 1.0 / lobe);
    const double base = 0.4 * square - 1.0, window = lobe * square - 1.0;
    return (25.0 / 16.0 * base * base - 9.0 / 16.0) * window * window;
}

static void follow_edges(const Source *source, const Place *place, double rgb_lin[3]) {
    const Edge edge = find_edge(source, place);
    double sum[3] = {0.0, 0.0, 0.0}, total = 0.0;
    for (int k = 0; k < 16; k++) {
        const int dx = k % 4 - 1, dy = k / 4 - 1;
        const bool corner = (k % 4 == 0 || k % 4 == 3) && (k / 4 == 0 || k / 4 == 3);
        const double weight =
            corner ? 0.0 : easu_weight(&edge, dx - place->part_x, dy - place->part_y);
        for (int c = 0; c < 3; c++) {
            sum[c] += weight * read(source, source->codes, place->x + dx, place->y + dy, c);
        }
        total += weight;
    }
    for (int c = 0; c < 3; c++) {
        rgb_lin[c] = dip_reference_decode_srgb(
            within_nearest(source, source->codes, place, c, sum[c] / total));
    }
}

// --- the picture ---------------------------------------------------------------------------------

bool dip_reference_enlarge(int upscale, const double *drawn_lin, int from_width, int from_height,
                           double *rgb_lin, int width, int height, DipError *err) {
    const size_t count = (size_t)from_width * (size_t)from_height * 3;
    Source source = {malloc(count * sizeof(double)), malloc(count * sizeof(double)), from_width,
                     from_height};
    const bool made = source.codes && source.light;
    for (size_t i = 0; made && i < count; i++) {
        source.codes[i] = floor(255.0 * dip_reference_encode_srgb(drawn_lin[i]) + 0.5) / 255.0;
        source.light[i] = dip_reference_decode_srgb(source.codes[i]);
    }
    for (int i = 0; made && i < width * height; i++) {
        Place place;
        place.part_x = find_place(i % width, from_width, width, &place.x);
        place.part_y = find_place(i / width, from_height, height, &place.y);
        double *rgb = rgb_lin + 3 * (size_t)i;
        if (upscale == DIP_UPSCALE_EASU) {
            follow_edges(&source, &place, rgb);
        } else {
            sum_light(&source, &place, upscale == DIP_UPSCALE_BICUBIC, rgb);
        }
    }
    free(source.codes);
    free(source.light);
    return made ||
           dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, NULL,
                         "out of memory for a picture of %dx%d pixels", from_width, from_height);
}
