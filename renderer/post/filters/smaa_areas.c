// Computes the areas of SMAA 1x (Jimenez et al., "SMAA: Enhanced Subpixel Morphological
// Antialiasing", 2012). For each end of an edge, the crossing edges say where the line that
// replaces the stairs ends: half a pixel above the edge, half a pixel below it, or on it.
#include "renderer/post/filters/smaa_areas.h"

#include <math.h>
#include <stdbool.h>

typedef struct Point {
    double x;
    double y;
} Point;

// Areas on both sides of an edge, within one pixel's width. y points up.
typedef struct Areas {
    double below;
    double above;
} Areas;

static Areas sum(Areas a, Areas b) {
    return (Areas){a.below + b.below, a.above + b.above};
}

// --- straight edges ------------------------------------------------------------------------------

// Returns the areas between the edge, which is the x axis, and the line from p to q, within the
// column of pixels from x to x + 1. A line that ends within the column counts as if it went on.
static Areas between(Point p, Point q, int x) {
    const double x0 = x;
    const double x1 = x + 1.0;
    if (!((x0 >= p.x && x0 < q.x) || (x1 > p.x && x1 <= q.x))) {
        return (Areas){0.0, 0.0};
    }
    const double slope = (q.y - p.y) / (q.x - p.x);
    const double y0 = p.y + slope * (x0 - p.x);
    const double y1 = p.y + slope * (x1 - p.x);
    const double tiny = 1e-4;
    if ((y0 < 0.0) == (y1 < 0.0) || fabs(y0) < tiny || fabs(y1) < tiny) { // a trapezoid
        const double area = (y0 + y1) / 2.0;
        return area < 0.0 ? (Areas){-area, 0.0} : (Areas){0.0, area};
    }
    // Two triangles that meet where the line crosses the edge. Where the line ends within the
    // column, one of them is missing.
    const double crossing = p.x - p.y / slope;
    const double first = crossing > p.x ? y0 * (crossing - x0) / 2.0 : 0.0;
    const double second = crossing < q.x ? y1 * (x1 - crossing) / 2.0 : 0.0;
    const bool first_above = fabs(first) > fabs(second) ? first >= 0.0 : second < 0.0;
    return first_above ? (Areas){fabs(second), fabs(first)} : (Areas){fabs(first), fabs(second)};
}

// Short bumps are blended more than their areas, because they would hardly be smoothed otherwise.
static double smoothed_share(double area, double length) {
    const double share = length / 32.0 > 1.0 ? 1.0 : length / 32.0;
    return area * share + sqrt(area * 2.0) * 0.5 * (1.0 - share);
}

static Areas smoothed(Areas a, double length) {
    return (Areas){smoothed_share(a.below, length), smoothed_share(a.above, length)};
}

// Returns where a line ends: .5 above the edge, -.5 below it, or 0. If edges cross the end on both
// sides, the line goes to the side to which it does not go at the other end.
static double height_of(bool above, bool below, bool other_above) {
    if (above && below) {
        return other_above ? -0.5 : 0.5;
    }
    return above ? 0.5 : below ? -0.5 : 0.0;
}

static Areas straight_areas(int pattern, int left, int right) {
    const bool left_above = pattern & DIP_SMAA_LEFT_ABOVE;
    const bool left_below = pattern & DIP_SMAA_LEFT_BELOW;
    const bool right_above = pattern & DIP_SMAA_RIGHT_ABOVE;
    const bool right_below = pattern & DIP_SMAA_RIGHT_BELOW;
    const Areas none = {0.0, 0.0};
    // An end that edges cross on both sides says nothing, unless the other end has one side only.
    if ((left_above && left_below && right_above == right_below) ||
        (right_above && right_below && left_above == left_below)) {
        return none;
    }
    const double from = height_of(left_above, left_below, right_above);
    const double to = height_of(right_above, right_below, left_above);
    const double length = left + right + 1;
    const Point start = {0.0, from};
    const Point middle = {length / 2.0, 0.0};
    const Point end = {length, to};
    if (from == 0.0) {
        return to != 0.0 && left >= right ? between(middle, end, left) : none;
    }
    if (to == 0.0) {
        return left <= right ? between(start, middle, left) : none;
    }
    if (from != to) {
        return between(start, end, left);
    }
    return sum(smoothed(between(start, middle, left), length),
               smoothed(between(middle, end, left), length));
}

// --- diagonal edges ------------------------------------------------------------------------------

// Returns the part of the square from (x, y) to (x + 1, y + 1) that lies on the inner side of the
// line from p to q. The square is cut by the line, and the rest is measured as a polygon.
static double part_inside(Point p, Point q, int x, int y) {
    const Point corners[4] = {{x, y}, {x + 1.0, y}, {x + 1.0, y + 1.0}, {x, y + 1.0}};
    Point polygon[8];
    int count = 0;
    for (int i = 0; i < 4; i++) {
        const Point a = corners[i];
        const Point b = corners[(i + 1) % 4];
        const double side_a = (q.y - p.y) * (a.x - p.x) - (q.x - p.x) * (a.y - p.y);
        const double side_b = (q.y - p.y) * (b.x - p.x) - (q.x - p.x) * (b.y - p.y);
        if (side_a > 0.0) {
            polygon[count++] = a;
        }
        if ((side_a > 0.0) != (side_b > 0.0)) {
            const double t = side_a / (side_a - side_b);
            polygon[count++] = (Point){a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t};
        }
    }
    double twice = 0.0;
    for (int i = 0; i < count; i++) {
        const Point a = polygon[i];
        const Point b = polygon[(i + 1) % count];
        twice += a.x * b.y - b.x * a.y;
    }
    return twice / 2.0;
}

// Returns the shares of the two pixels at the diagonal stairs, which run from (0, 0) to
// (length, length), for a line that starts at p and ends at q behind the stairs' end.
static Areas diagonal_line(Point p, Point q, int left, double length) {
    const Point end = {q.x + length, q.y + length};
    return (Areas){1.0 - part_inside(p, end, 1 + left, left),
                   part_inside(p, end, 1 + left, 1 + left)};
}

// The lines by the edges at both ends, [left][right]: two lines, whose mean is taken, each by its
// start and its end behind the stairs' end.
typedef struct Line {
    signed char x0, y0, x1, y1;
} Line;

static const Line lines[4][4][2] = {
    {{{1, 1, 1, 1}, {1, 0, 1, 0}},
     {{0, 0, 1, 1}, {1, 0, 1, 1}},
     {{0, 0, 1, 0}, {1, 0, 1, 0}},
     {{0, 0, 1, 1}, {1, 0, 1, 0}}},
    {{{1, 0, 0, 0}, {1, 0, 1, 0}},
     {{1, 0, 1, 1}, {1, 0, 1, 1}},
     {{1, 0, 1, 0}, {1, 0, 1, 0}},
     {{1, 0, 1, 1}, {1, 0, 1, 0}}},
    {{{1, 1, 0, 0}, {1, 1, 1, 0}},
     {{1, 1, 1, 1}, {1, 1, 1, 1}},
     {{1, 1, 1, 0}, {1, 1, 1, 0}},
     {{1, 1, 1, 1}, {1, 1, 1, 0}}},
    {{{1, 1, 0, 0}, {1, 0, 1, 0}},
     {{1, 1, 1, 1}, {1, 0, 1, 1}},
     {{1, 1, 1, 0}, {1, 0, 1, 0}},
     {{1, 1, 1, 1}, {1, 0, 1, 0}}},
};

static Areas diagonal_areas(int edges_left, int edges_right, int left, int right) {
    Areas total = {0.0, 0.0};
    for (int i = 0; i < 2; i++) {
        const Line line = lines[edges_left][edges_right][i];
        total = sum(total, diagonal_line((Point){line.x0, line.y0}, (Point){line.x1, line.y1}, left,
                                         left + right + 1));
    }
    return (Areas){total.below / 2.0, total.above / 2.0};
}

// -------------------------------------------------------------------------------------------------

static void store(float to[2], Areas areas) {
    to[0] = (float)areas.below;
    to[1] = (float)areas.above;
}

void dip_smaa_areas_make(DipSmaaAreas *areas) {
    for (int pattern = 0; pattern < DIP_SMAA_PATTERNS; pattern++) {
        for (int left = 0; left <= DIP_SMAA_STRAIGHT; left++) {
            for (int right = 0; right <= DIP_SMAA_STRAIGHT; right++) {
                store(areas->straight[pattern][left][right], straight_areas(pattern, left, right));
            }
        }
    }
    for (int ends = 0; ends < 16; ends++) {
        for (int left = 0; left <= DIP_SMAA_DIAGONAL; left++) {
            for (int right = 0; right <= DIP_SMAA_DIAGONAL; right++) {
                store(areas->diagonal[ends / 4][ends % 4][left][right],
                      diagonal_areas(ends / 4, ends % 4, left, right));
            }
        }
    }
}
