// Converts the Jacobian of texture coordinates to probes and a level: docs/picture.md, "Textures".
#include "renderer/reference/internal/footprint.h"

#include <math.h>

// The major axis of a footprint, its length, and its ratio to the minor axis.
typedef struct Frame {
    double major[2];
    double length;
    double ratio;
} Frame;

static Frame judge(const double a[2], const double b[2], double cap) {
    const double length_a = hypot(a[0], a[1]);
    const double length_b = hypot(b[0], b[1]);
    const bool a_is_major = length_a >= length_b;
    const double longer = a_is_major ? length_a : length_b;
    const double shorter = a_is_major ? length_b : length_a;
    Frame frame = {{a_is_major ? a[0] : b[0], a_is_major ? a[1] : b[1]}, longer, 1.0};
    if (longer > 0.0) {
        frame.ratio = shorter > 0.0 ? fmin(longer / shorter, cap) : cap;
    }
    return frame;
}

static Frame judge_plain(const double ddx[2], const double ddy[2], int max_anisotropy) {
    const double s = sqrt(0.5);
    const double turned_x[2] = {(ddx[0] + ddy[0]) * s, (ddx[1] + ddy[1]) * s};
    const double turned_y[2] = {(ddy[0] - ddx[0]) * s, (ddy[1] - ddx[1]) * s};
    const Frame screen = judge(ddx, ddy, max_anisotropy);
    const Frame turned = judge(turned_x, turned_y, fmax(1.0, max_anisotropy * 0.5));
    return turned.ratio > screen.ratio ? turned : screen;
}

// Finds the singular values and the major left singular vector of a 2x2 matrix without
// cancellation. The matrix is the sum of a scaled rotation (length q, the angle of (e, h)) and a
// scaled reflection (length r, the angle of (f, g)). Then M = q + r, m = |det| / M, and the
// direction is half the sum of both angles.
static Frame judge_ellipse(const double ddx[2], const double ddy[2], int max_anisotropy) {
    const double e = (ddx[0] + ddy[1]) * 0.5;
    const double f = (ddx[0] - ddy[1]) * 0.5;
    const double g = (ddx[1] + ddy[0]) * 0.5;
    const double h = (ddx[1] - ddy[0]) * 0.5;
    const double longer = hypot(e, h) + hypot(f, g);
    if (!(longer > 0.0)) {
        return (Frame){{0.0, 0.0}, longer, 1.0};
    }
    // Dividing before multiplying keeps the determinant of huge or tiny derivatives in range.
    const double shorter = fabs(ddx[0] / longer * ddy[1] - ddx[1] / longer * ddy[0]); // |det| / M
    const double angle = (atan2(g, f) + atan2(h, e)) * 0.5;
    const double ratio = shorter > 0.0 ? longer / shorter : max_anisotropy;
    return (Frame){
        {longer * cos(angle), longer * sin(angle)}, longer, fmax(1.0, fmin(ratio, max_anisotropy))};
}

DipFootprint dip_reference_footprint(const double ddx[2], const double ddy[2], int max_anisotropy,
                                     bool exact_footprint, int min_level) {
    if (!isfinite(ddx[0]) || !isfinite(ddx[1]) || !isfinite(ddy[0]) || !isfinite(ddy[1])) {
        return (DipFootprint){{0.0, 0.0}, 1.0, 1, NAN};
    }
    if (max_anisotropy <= 1) {
        const double rho = fmax(hypot(ddx[0], ddx[1]), hypot(ddy[0], ddy[1]));
        return (DipFootprint){{0.0, 0.0}, 1.0, 1, log2(rho)};
    }
    const Frame frame = exact_footprint ? judge_ellipse(ddx, ddy, max_anisotropy)
                                        : judge_plain(ddx, ddy, max_anisotropy);
    // Keeps probes at least a texel apart.
    const double most = fmax(1.0, frame.length / (1 << min_level));
    const int probe_count = (int)ceil(fmin(frame.ratio, most) - 1e-4);
    return (DipFootprint){{frame.major[0], frame.major[1]},
                          frame.ratio,
                          probe_count < 1 ? 1 : probe_count,
                          log2(frame.length / frame.ratio)};
}

int dip_reference_coarser_probes(int probe_count, double fraction) {
    return (int)ceil(probe_count * fmax(0.5, fraction));
}

double dip_reference_level(double lambda, double bias, int min_level, int last_level) {
    const double first = min_level < last_level ? min_level : last_level;
    const double biased = lambda + bias;
    // NaN fails the comparison and selects the smallest level.
    const double level = biased < last_level ? fmax(biased, first) : last_level;
    return floor(level * 256.0 + 0.5) / 256.0;
}
