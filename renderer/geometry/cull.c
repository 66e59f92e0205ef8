// Culling by bounding boxes: of a mesh, of its groups of chunks, of its chunks. A box that lies
// wholly inside a plane spares what it holds the test against that plane.
#include "renderer/geometry/cull.h"

// Row r of the matrix gives clip coordinate r, so a plane in clip space is a sum of rows.
static void place_plane(const float *m, const float clip[4], double normal[4]) {
    for (int c = 0; c < 4; c++) {
        normal[c] = (double)clip[0] * m[c] + (double)clip[1] * m[4 + c] +
                    (double)clip[2] * m[8 + c] + (double)clip[3] * m[12 + c];
    }
}

static int blocks_end(int end) {
    return (end + DIP_BLOCK - 1) / DIP_BLOCK * DIP_BLOCK;
}

DipRegion dip_drawn_region(const DipPass *pass) {
    const DipRegion *region = &pass->region;
    if (!region->x1) {
        return (DipRegion){0, 0, blocks_end(pass->target.width), blocks_end(pass->target.height)};
    }
    return (DipRegion){region->x0 / DIP_BLOCK * DIP_BLOCK, region->y0 / DIP_BLOCK * DIP_BLOCK,
                       blocks_end(region->x1), blocks_end(region->y1)};
}

// The picture's region in x / w and y / w.
typedef struct NdcRegion {
    float left, right, bottom, top;
} NdcRegion;

static const NdcRegion whole = {-1.0f, 1.0f, -1.0f, 1.0f};

static NdcRegion ndc_region(const DipPass *pass) {
    if (!pass->region.x1) {
        return whole;
    }
    const DipRegion region = dip_drawn_region(pass);
    const float x = 2.0f / (float)pass->target.width;
    const float y = 2.0f / (float)pass->target.height;
    return (NdcRegion){(float)region.x0 * x - 1.0f, (float)region.x1 * x - 1.0f,
                       1.0f - (float)region.y1 * y, 1.0f - (float)region.y0 * y};
}

static void place_view(const float *m, const NdcRegion *region, double (*normal)[4]) {
    const float view[DIP_VIEW_PLANES][4] = {{1, 0, 0, -region->left},
                                            {-1, 0, 0, region->right},
                                            {0, 1, 0, -region->bottom},
                                            {0, -1, 0, region->top},
                                            {0, 0, 1, 0},
                                            {0, 0, -1, 1}};
    for (int p = 0; p < DIP_VIEW_PLANES; p++) {
        place_plane(m, view[p], normal[p]);
    }
}

static DipCullPlanes place_planes(const DipPass *pass, const NdcRegion *region, const float *m) {
    DipCullPlanes planes = {.count = DIP_VIEW_PLANES + pass->clip_plane_count};
    place_view(m, region, planes.normal);
    for (int p = 0; p < pass->clip_plane_count; p++) {
        place_plane(m, pass->clip_planes[p], planes.normal[DIP_VIEW_PLANES + p]);
    }
    return planes;
}

// A view's matrix as the shaders have it.
static void world_to_clip(const DipView *view, float m[16]) {
    for (int i = 0; i < 16; i++) {
        m[i] = (float)view->world_to_clip[i];
    }
}

DipCullPlanes dip_cull_pass_planes(const DipPass *pass, const DipView *view) {
    const NdcRegion region = ndc_region(pass);
    float m[16];
    world_to_clip(view, m);
    return place_planes(pass, &region, m);
}

DipCullPlanes dip_cull_view_planes(const DipView *view) {
    DipCullPlanes planes = {.count = DIP_VIEW_PLANES};
    float m[16];
    world_to_clip(view, m);
    place_view(m, &whole, planes.normal);
    return planes;
}

static double magnitude(double v) {
    return v < 0.0 ? -v : v;
}

// Of what is summed up: covers the rounding of a matrix and of the shader's own arithmetic.
#define ROUNDING 1e-5

// Whether a box lies outside one of the planes in the set *crossed (bit p: plane p), from which
// those that it lies wholly inside of are taken.
static bool outside(const DipCullPlanes *planes, const DipBox *box, unsigned *crossed) {
    for (unsigned left = *crossed; left; left &= left - 1) {
        const int p = __builtin_ctz(left);
        const double *normal = planes->normal[p];
        double distance = normal[3];
        double radius = 0.0;
        double size = magnitude(normal[3]);
        for (int c = 0; c < 3; c++) {
            const double length = magnitude(normal[c]);
            distance += normal[c] * box->centre[c];
            radius += length * box->extent[c];
            size += length * magnitude(box->centre[c]);
        }
        const double margin = ROUNDING * (size + radius);
        if (distance + radius < -margin) {
            return true;
        }
        if (distance - radius > margin) {
            *crossed &= ~(1u << p);
        }
    }
    return false;
}

bool dip_cull_outside(const DipCullPlanes *planes, const DipBox *box) {
    unsigned crossed = (1u << planes->count) - 1;
    return outside(planes, box, &crossed);
}

DipBox dip_cull_place_box(const float transform[12], const DipBox *box) {
    DipBox placed;
    for (int axis = 0; axis < 3; axis++) {
        const float *m = transform + 4 * axis;
        double centre = m[3];
        double extent = 0.0;
        double size = magnitude(m[3]);
        for (int k = 0; k < 3; k++) {
            const double length = magnitude(m[k]);
            centre += (double)m[k] * box->centre[k];
            extent += length * box->extent[k];
            size += length * (magnitude(box->centre[k]) + box->extent[k]);
        }
        placed.centre[axis] = (float)centre;
        placed.extent[axis] = (float)(extent + ROUNDING * size);
    }
    return placed;
}

static uint32_t cull_draw(const DipCullPlanes *planes, const DipMesh *mesh, uint32_t draw,
                          DipVisibleChunk *visible) {
    uint32_t count = 0;
    unsigned mesh_crossed = (1u << planes->count) - 1;
    if (outside(planes, &mesh->box, &mesh_crossed)) {
        return 0;
    }
    for (uint32_t first = 0; first < mesh->chunk_count; first += DIP_GROUP_CHUNKS) {
        unsigned group_crossed = mesh_crossed;
        if (outside(planes, &mesh->groups[first / DIP_GROUP_CHUNKS], &group_crossed)) {
            continue;
        }
        const uint32_t rest = mesh->chunk_count - first;
        const uint32_t end = first + (rest < DIP_GROUP_CHUNKS ? rest : DIP_GROUP_CHUNKS);
        for (uint32_t c = first; c < end; c++) {
            unsigned crossed = group_crossed;
            if (!outside(planes, &mesh->chunks[c].box, &crossed)) {
                visible[count++] = (DipVisibleChunk){draw, c};
            }
        }
    }
    return count;
}

uint32_t dip_cull_chunks(const DipPass *pass, DipVisibleChunk *visible) {
    const NdcRegion region = ndc_region(pass);
    uint32_t count = 0;
    for (uint32_t d = 0; d < (uint32_t)pass->draw_count; d++) {
        const DipDraw *draw = &pass->draws[d];
        DipCullPlanes planes = {.count = 0};
        if (!draw->mesh->chunk_count) {
            continue;
        }
        if (draw->bounds_to_clip) {
            planes = place_planes(pass, &region, draw->bounds_to_clip);
        }
        count += cull_draw(&planes, draw->mesh, d, visible + count);
    }
    return count;
}
