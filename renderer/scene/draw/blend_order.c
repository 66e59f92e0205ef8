// Orders blended objects. The sort is a heap sort: it allocates nothing, and since no two objects
// are equal, it has one result.
#include "renderer/scene/draw/blend_order.h"

int64_t dip_blend_depth(const DipView *view, const DipBox *bounds) {
    static const double limit = 0x1p62;
    double depth = 0.0;
    for (int i = 0; i < 3; i++) {
        depth += ((double)bounds->centre[i] - view->eye[i]) * -view->axis[2][i];
    }
    const double steps = depth / view->near_m * 65536.0;
    if (!(steps > -limit)) {
        return -((int64_t)1 << 62);
    }
    return steps < limit ? (int64_t)steps : (int64_t)1 << 62;
}

int dip_blend_layer(const float *levels, int count, double eye, double centre, bool is_water) {
    int passed = 0;
    bool beyond_own = false;
    for (int i = 0; i < count; i++) {
        const double level = (double)levels[i];
        const bool own = is_water && level == centre;
        passed += !own && (eye > level) != (centre > level);
        beyond_own = beyond_own || own;
    }
    return 2 * passed + beyond_own;
}

// Whether a is drawn before b.
static bool is_before(const DipBlendedObject *a, const DipBlendedObject *b) {
    if (a->layer != b->layer) {
        return a->layer > b->layer;
    }
    return a->depth != b->depth ? a->depth > b->depth : a->object < b->object;
}

// Moves an object down a heap whose roots are drawn after their children.
static void sink(DipBlendedObject *heap, int at, int count) {
    const DipBlendedObject moved = heap[at];
    for (int child = 2 * at + 1; child < count; child = 2 * at + 1) {
        if (child + 1 < count && is_before(&heap[child], &heap[child + 1])) {
            child++;
        }
        if (!is_before(&moved, &heap[child])) {
            break;
        }
        heap[at] = heap[child];
        at = child;
    }
    heap[at] = moved;
}

void dip_blend_sort(DipBlendedObject *objects, int count) {
    for (int i = count / 2 - 1; i >= 0; i--) {
        sink(objects, i, count);
    }
    for (int left = count - 1; left > 0; left--) {
        const DipBlendedObject last = objects[0];
        objects[0] = objects[left];
        objects[left] = last;
        sink(objects, 0, left);
    }
}
