#include "tests/renderer/post/post_model.h"
#include "tests/support/srgb.h"

#include <math.h>

static double code(const ModelPicture *p, int x, int y, int channel) {
    x = x < 0 ? 0 : x >= p->width ? p->width - 1 : x;
    y = y < 0 ? 0 : y >= p->height ? p->height - 1 : y;
    return p->rgba8[4 * (y * p->width + x) + channel] / 255.0;
}

static double clamp(double v, double least, double most) {
    return v < least ? least : v > most ? most : v;
}

// --- FXAA ----------------------------------------------------------------------------------------

static double fxaa_luma(const ModelPicture *p, int x, int y) {
    return 0.299 * code(p, x, y, 0) + 0.587 * code(p, x, y, 1) + 0.114 * code(p, x, y, 2);
}

// Luma at a place between pixels, bilinearly, as a graphics card reads it.
static double fxaa_luma_between(const ModelPicture *p, double x, double y) {
    const int x0 = (int)floor(x), y0 = (int)floor(y);
    const double fx = x - x0, fy = y - y0;
    const double upper = fxaa_luma(p, x0, y0) * (1 - fx) + fxaa_luma(p, x0 + 1, y0) * fx;
    const double lower = fxaa_luma(p, x0, y0 + 1) * (1 - fx) + fxaa_luma(p, x0 + 1, y0 + 1) * fx;
    return upper * (1 - fy) + lower * fy;
}

// A factor that settles a tie.
static double settle(int ties, int decision) {
    return ties >> decision & 1 ? 1 + 1e-5 : 1 - 1e-5;
}

ModelColour model_fxaa(const ModelPicture *p, int ties, int x, int y) {
    double l[3][3], least = 2, greatest = -1;
    ModelColour result;
    for (int j = 0; j < 3; j++) {
        for (int i = 0; i < 3; i++) {
            l[j][i] = fxaa_luma(p, x + i - 1, y + j - 1);
            if (i == 1 || j == 1) {
                least = fmin(least, l[j][i]);
                greatest = fmax(greatest, l[j][i]);
            }
        }
    }
    const double m = l[1][1], range = greatest - least;
    for (int c = 0; c < 3; c++) {
        result.rgb[c] = 255 * code(p, x, y, c);
    }
    if (range * settle(ties, 3) < fmax(0.0312, greatest * 0.125)) {
        return result;
    }
    const double cross = l[0][1] + l[2][1] + l[1][0] + l[1][2];
    const double corners = l[0][0] + l[0][2] + l[2][0] + l[2][2];
    const double blur = fmin(fabs((2 * cross + corners) / 12 - m) / range, 1);
    const double smooth = blur * blur * (3 - 2 * blur);
    const double subpixel = smooth * smooth * 0.75;
    double rows = 0, columns = 0;
    for (int i = 0; i < 3; i++) {
        rows += (i == 1 ? 2 : 1) * fabs(l[0][i] + l[2][i] - 2 * l[1][i]);
        columns += (i == 1 ? 2 : 1) * fabs(l[i][0] + l[i][2] - 2 * l[i][1]);
    }
    const int horizontal = rows * settle(ties, 1) >= columns;
    const double first = horizontal ? l[0][1] : l[1][0], second = horizontal ? l[2][1] : l[1][2];
    const int side = fabs(first - m) * settle(ties, 2) >= fabs(second - m) ? -1 : 1;
    const double mean = ((side < 0 ? first : second) + m) / 2;
    const double enough = fmax(fabs(first - m), fabs(second - m)) / 4 * settle(ties, 0);
    static const double places[] = {1, 2.5, 4.5, 8.5, 20.5};
    double ends[2], difference[2];
    for (int d = 0; d < 2; d++) {
        for (int i = 0; i < 5; i++) {
            const double along = d ? places[i] : -places[i], across = side * 0.5;
            ends[d] = places[i];
            difference[d] = fxaa_luma_between(p, x + (horizontal ? along : across),
                                              y + (horizontal ? across : along)) -
                            mean;
            if (fabs(difference[d]) >= enough) {
                break;
            }
        }
    }
    const int near = ends[0] < ends[1] ? 0 : 1;
    double move =
        (difference[near] < 0) != (m - mean < 0) ? 0.5 - ends[near] / (ends[0] + ends[1]) : 0;
    move = fmax(move, subpixel);
    for (int c = 0; c < 3; c++) {
        const double other = code(p, x + (horizontal ? 0 : side), y + (horizontal ? side : 0), c);
        result.rgb[c] += (255 * other - result.rgb[c]) * move;
    }
    return result;
}

// --- RCAS ----------------------------------------------------------------------------------------

ModelColour model_sharpen(const ModelPicture *p, double sharpness, int x, int y) {
    double lobe = -1;
    for (int c = 0; c < 3; c++) {
        const double n = code(p, x, y - 1, c), w = code(p, x - 1, y, c);
        const double e = code(p, x + 1, y, c), s = code(p, x, y + 1, c);
        const double least = fmin(fmin(n, w), fmin(e, s)), most = fmax(fmax(n, w), fmax(e, s));
        // The strongest lobe for which neither a black nor a white centre would leave 0..1.
        const double dark = most > 0 ? -least / (4 * most) : 0;
        const double light = least < 1 ? (1 - most) / (4 * least - 4) : 0;
        lobe = fmax(lobe, fmax(dark, light));
    }
    lobe = clamp(lobe, -3.0 / 16, 0) * sharpness;
    ModelColour result;
    for (int c = 0; c < 3; c++) {
        const double sum = code(p, x, y - 1, c) + code(p, x - 1, y, c) + code(p, x + 1, y, c) +
                           code(p, x, y + 1, c);
        result.rgb[c] = 255 * clamp((lobe * sum + code(p, x, y, c)) / (4 * lobe + 1), 0, 1);
    }
    return result;
}

// --- enlarging -----------------------------------------------------------------------------------

static double centre(int i, int from, int to) {
    return (i + 0.5) * from / to - 0.5;
}

static double cubic(double t) {
    t = fabs(t);
    return t >= 2  ? 0
           : t < 1 ? 1.5 * t * t * t - 2.5 * t * t + 1
                   : -0.5 * t * t * t + 2.5 * t * t - 4 * t + 2;
}

static double tent(double t) {
    return fmax(0, 1 - fabs(t));
}

static ModelColour weighted(const ModelPicture *p, double x, double y, double (*weight)(double),
                            int clamped) {
    const int x0 = (int)floor(x), y0 = (int)floor(y);
    ModelColour result;
    for (int c = 0; c < 3; c++) {
        double sum = 0, least = 2, most = -1;
        for (int j = -1; j < 3; j++) {
            for (int i = -1; i < 3; i++) {
                const double light = srgb_decode(code(p, x0 + i, y0 + j, c));
                sum += weight(x - x0 - i) * weight(y - y0 - j) * light;
                if (i >= 0 && i < 2 && j >= 0 && j < 2) {
                    least = fmin(least, light);
                    most = fmax(most, light);
                }
            }
        }
        result.rgb[c] = 255 * srgb_encode(clamp(clamped ? clamp(sum, least, most) : sum, 0, 1));
    }
    return result;
}

ModelColour model_bilinear(const ModelPicture *p, int to_width, int to_height, int x, int y) {
    return weighted(p, centre(x, p->width, to_width), centre(y, p->height, to_height), tent, 0);
}

ModelColour model_bicubic(const ModelPicture *p, int to_width, int to_height, int x, int y) {
    return weighted(p, centre(x, p->width, to_width), centre(y, p->height, to_height), cubic, 1);
}

// --- EASU ----------------------------------------------------------------------------------------

static double easu_luma(const ModelPicture *p, int x, int y) {
    return 0.5 * code(p, x, y, 2) + (0.5 * code(p, x, y, 0) + code(p, x, y, 1));
}

// What one of the four nearest pixels adds to the direction and the length of the edge.
static void easu_add(const ModelPicture *p, int x, int y, double weight, double *dx, double *dy,
                     double *length) {
    const double m = easu_luma(p, x, y);
    const double w = easu_luma(p, x - 1, y), e = easu_luma(p, x + 1, y);
    const double n = easu_luma(p, x, y - 1), s = easu_luma(p, x, y + 1);
    const double half_x = fmax(fabs(e - m), fabs(m - w)), half_y = fmax(fabs(s - m), fabs(m - n));
    const double lx = half_x > 0 ? clamp(fabs(e - w) / half_x, 0, 1) : 0;
    const double ly = half_y > 0 ? clamp(fabs(s - n) / half_y, 0, 1) : 0;
    *dx += (e - w) * weight;
    *dy += (s - n) * weight;
    *length += (lx * lx + ly * ly) * weight;
}

ModelColour model_easu(const ModelPicture *p, int to_width, int to_height, int x, int y) {
    const double cx = centre(x, p->width, to_width), cy = centre(y, p->height, to_height);
    const int x0 = (int)floor(cx), y0 = (int)floor(cy);
    const double px = cx - x0, py = cy - y0;
    double dx = 0, dy = 0, length = 0;
    easu_add(p, x0, y0, (1 - px) * (1 - py), &dx, &dy, &length);
    easu_add(p, x0 + 1, y0, px * (1 - py), &dx, &dy, &length);
    easu_add(p, x0, y0 + 1, (1 - px) * py, &dx, &dy, &length);
    easu_add(p, x0 + 1, y0 + 1, px * py, &dx, &dy, &length);
    const double square = dx * dx + dy * dy;
    if (square < 1.0 / 32768) {
        dx = 1;
    } else {
        dx /= sqrt(square);
        dy /= sqrt(square);
    }
    length = length / 2 * (length / 2);
    const double stretch = (dx * dx + dy * dy) / fmax(fabs(dx), fabs(dy));
    const double scale_x = 1 + (stretch - 1) * length, scale_y = 1 - 0.5 * length;
    const double lobe = 0.5 + (1.0 / 4 - 0.04 - 0.5) * length, limit = 1 / lobe;
    double sums[3] = {0}, total = 0;
    ModelColour result;
    for (int j = -1; j < 3; j++) {
        for (int i = -1; i < 3; i++) {
            if ((i == -1 || i == 2) && (j == -1 || j == 2)) {
                continue;
            }
            const double ox = i - px, oy = j - py;
            const double vx = (ox * dx + oy * dy) * scale_x, vy = (-ox * dy + oy * dx) * scale_y;
            const double d2 = fmin(vx * vx + vy * vy, limit);
            const double base = 2.0 / 5 * d2 - 1, window = lobe * d2 - 1;
            const double weight = (25.0 / 16 * base * base - (25.0 / 16 - 1)) * window * window;
            for (int c = 0; c < 3; c++) {
                sums[c] += weight * code(p, x0 + i, y0 + j, c);
            }
            total += weight;
        }
    }
    for (int c = 0; c < 3; c++) {
        double least = 2, most = -1;
        for (int k = 0; k < 4; k++) {
            least = fmin(least, code(p, x0 + k % 2, y0 + k / 2, c));
            most = fmax(most, code(p, x0 + k % 2, y0 + k / 2, c));
        }
        result.rgb[c] = 255 * clamp(clamp(sums[c] / total, least, most), 0, 1);
    }
    return result;
}
