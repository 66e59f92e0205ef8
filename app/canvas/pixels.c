// Computes with rectangles.
#include "app/canvas/pixels.h"

static int smaller(int a, int b) {
    return a < b ? a : b;
}

static int larger(int a, int b) {
    return a > b ? a : b;
}

bool dip_rect_is_empty(DipRect rect) {
    return rect.width < 1 || rect.height < 1;
}

bool dip_rect_equals(DipRect a, DipRect b) {
    return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
}

bool dip_rect_holds(DipRect rect, int x, int y) {
    return x >= rect.x && x < rect.x + rect.width && y >= rect.y && y < rect.y + rect.height;
}

static DipRect from_corners(int left, int top, int right, int bottom) {
    return (DipRect){left, top, right - left, bottom - top};
}

DipRect dip_rect_intersect(DipRect a, DipRect b) {
    return from_corners(larger(a.x, b.x), larger(a.y, b.y), smaller(a.x + a.width, b.x + b.width),
                        smaller(a.y + a.height, b.y + b.height));
}

DipRect dip_rect_unite(DipRect a, DipRect b) {
    if (dip_rect_is_empty(a)) {
        return b;
    }
    if (dip_rect_is_empty(b)) {
        return a;
    }
    return from_corners(smaller(a.x, b.x), smaller(a.y, b.y), larger(a.x + a.width, b.x + b.width),
                        larger(a.y + a.height, b.y + b.height));
}
