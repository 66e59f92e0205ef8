// Culling by bounding boxes: of a mesh, of its groups of chunks, of its chunks. A box that lies
// wholly inside a plane spares what it holds the test against that plane.
#include "renderer/geometry/cull.h"

#include "renderer/geometry/mesh.h"

#include <stdbool.h>

enum { VIEW_PLANES = 6, MAX_PLANES = VIEW_PLANES + DIP_MAX_CLIP_PLANES };

// Half-spaces in the mesh's space: inside where dot(normal, (x, y, z, 1)) >= 0.
typedef struct Planes {
    int count;
    double normal[MAX_PLANES][4];
} Planes;

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

// The picture's region in x / w and y / w, from -1 to 1 where it is whole.
typedef struct NdcRegion {
    float left, right, bottom, top;
} NdcRegion;

static NdcRegion ndc_region(const DipPass *pass) {
    if (!pass->region.x1) {
        return (NdcRegion){-1.0f, 1.0f, -1.0f, 1.0f};
    }
    const DipRegion region = dip_drawn_region(pass);
    const float x = 2.0f / (float)pass->target.width;
    const float y = 2.0f / (float)pass->target.height;
    return (NdcRegion){(float)region.x0 * x - 1.0f, (float)region.x1 * x - 1.0f,
                       1.0f - (float)region.y1 * y, 1.0f - (float)region.y0 * y};
}

static void place_view(const float *m, const NdcRegion *region, double (*normal)[4]) {
    const float view[VIEW_PLANES][4] = {{1, 0, 0, -region->left},
                                        {-1, 0, 0, region->right},
                                        {0, 1, 0, -region->bottom},
                                        {0, -1, 0, region->top},
                                        {0, 0, 1, 0},
                                        {0, 0, -1, 1}};
    for (int p = 0; p < VIEW_PLANES; p++) {
        place_plane(m, view[p], normal[p]);
    }
}

static Planes place_planes(const DipPass *pass, const NdcRegion *region, const float *m) {
    Planes planes = {.count = VIEW_PLANES + pass->clip_plane_count};
    place_view(m, region, planes.normal);
    for (int p = 0; p < pass->clip_plane_count; p++) {
        place_plane(m, pass->clip_planes[p], planes.normal[VIEW_PLANES + p]);
    }
    return planes;
}

static double magnitude(double v) {
    return v < 0.0 ? -v : v;
}

// Whether a box lies outside one of the planes in the set *crossed (bit p: plane p), from which
// those that it lies wholly inside of are taken.
static bool outside(const Planes *planes, const DipBox *box, unsigned *crossed) {
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
        // The margin covers the rounding of the matrix and of the shader's own arithmetic.
        const double margin = 1e-5 * (size + radius);
        if (distance + radius < -margin) {
            return true;
        }
        if (distance - radius > margin) {
            *crossed &= ~(1u << p);
        }
    }
    return false;
}

bool dip_cull_in_view(const float to_clip[16], const DipBox *box) {
    static const NdcRegion whole = {-1.0f, 1.0f, -1.0f, 1.0f};
    Planes planes = {.count = VIEW_PLANES};
    unsigned crossed = (1u << VIEW_PLANES) - 1;
    place_view(to_clip, &whole, planes.normal);
    return !outside(&planes, box, &crossed);
}

static uint32_t cull_draw(const Planes *planes, const DipMesh *mesh, uint32_t draw,
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
        Planes planes = {.count = 0};
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
