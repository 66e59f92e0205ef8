// Culls by the bounding boxes of meshes, groups of chunks, and chunks. If a box lies wholly inside
// all planes, the smaller boxes within it need no test.
#include "renderer/pipeline/cull.h"

#include "renderer/base/fp_mode.h"
#include "renderer/pipeline/geometry/chunk_cull.h"
#include "renderer/pipeline/geometry/mesh_layout.h"

#include <math.h>
#include <string.h>

// Floats has one value for each of four planes.
typedef float Floats __attribute__((vector_size(16)));
typedef int32_t Ints __attribute__((vector_size(16)));

// Transforms four clip-space planes, with the coordinates clip[0] to clip[3], back to the space
// that matrix m maps to clip space, and returns coordinate c of the result. Row r of m yields clip
// coordinate r, so the new planes are weighted sums of the rows.
static inline Floats transformed(const float *m, const Floats clip[4], int c) {
    return clip[0] * m[c] + clip[1] * m[4 + c] + clip[2] * m[8 + c] + clip[3] * m[12 + c];
}

static DipCullPlanes no_planes(void) {
    DipCullPlanes planes = {.count = 0};
    for (int p = 0; p < DIP_MAX_CULL_PLANES; p++) {
        planes.normal[3][p] = 1.0f;
    }
    return planes;
}

static int blocks_end(int end) {
    return (end + DIP_BLOCK - 1) / DIP_BLOCK * DIP_BLOCK;
}

DipTargetRegion dip_viewport(const DipPass *pass) {
    return pass->viewport.x1 ? pass->viewport
                             : (DipTargetRegion){0, 0, pass->target.width, pass->target.height};
}

static int greater(int a, int b) {
    return a > b ? a : b;
}

static int smaller(int a, int b) {
    return a < b ? a : b;
}

// Returns what two rectangles have in common. `by` may be all 0, which stands for all pixels. If
// they have nothing in common, the result is one pixel of `region`.
static DipTargetRegion common(DipTargetRegion region, const DipTargetRegion *by) {
    if (!by->x1) {
        return region;
    }
    region.x0 = smaller(greater(region.x0, by->x0), region.x1 - 1);
    region.y0 = smaller(greater(region.y0, by->y0), region.y1 - 1);
    region.x1 = greater(smaller(region.x1, by->x1), region.x0 + 1);
    region.y1 = greater(smaller(region.y1, by->y1), region.y0 + 1);
    return region;
}

DipTargetRegion dip_drawn_region(const DipPass *pass) {
    const DipTargetRegion target = {0, 0, pass->target.width, pass->target.height};
    DipTargetRegion region = common(target, &pass->region);
    region = common(region, &pass->viewport);
    region = common(region, &pass->scissor);
    return (DipTargetRegion){region.x0 / DIP_BLOCK * DIP_BLOCK, region.y0 / DIP_BLOCK * DIP_BLOCK,
                             blocks_end(region.x1), blocks_end(region.y1)};
}

// A rectangle of the picture in normalised device coordinates, x / w and y / w.
typedef struct NdcRegion {
    float left, right, bottom, top;
} NdcRegion;

static const NdcRegion whole = {-1.0f, 1.0f, -1.0f, 1.0f};

static NdcRegion ndc_region(const DipPass *pass) {
    if (!pass->region.x1 && !pass->viewport.x1 && !pass->scissor.x1) {
        return whole;
    }
    const DipTargetRegion region = dip_drawn_region(pass);
    const DipTargetRegion viewport = dip_viewport(pass);
    const float x = 2.0f / (float)(viewport.x1 - viewport.x0);
    const float y = 2.0f / (float)(viewport.y1 - viewport.y0);
    return (NdcRegion){
        (float)(region.x0 - viewport.x0) * x - 1.0f, (float)(region.x1 - viewport.x0) * x - 1.0f,
        1.0f - (float)(region.y1 - viewport.y0) * y, 1.0f - (float)(region.y0 - viewport.y0) * y};
}

static DipCullPlanes view_planes(const float *m, const NdcRegion *region) {
    const Floats sides[4] = {{1.0f, -1.0f, 0.0f, 0.0f},
                             {0.0f, 0.0f, 1.0f, -1.0f},
                             {0.0f, 0.0f, 0.0f, 0.0f},
                             {-region->left, region->right, -region->bottom, region->top}};
    const Floats depths[4] = {{0.0f, 0.0f, 0.0f, 0.0f}, // and two planes of padding
                              {0.0f, 0.0f, 0.0f, 0.0f},
                              {1.0f, -1.0f, 0.0f, 0.0f},
                              {0.0f, 1.0f, 0.0f, 0.0f}};
    DipCullPlanes planes = no_planes();
    planes.count = DIP_VIEW_PLANES;
    for (int c = 0; c < 4; c++) {
        const Floats at_sides = transformed(m, sides, c);
        const Floats at_depths = transformed(m, depths, c);
        memcpy(planes.normal[c], &at_sides, sizeof at_sides);
        memcpy(planes.normal[c] + 4, &at_depths, (DIP_VIEW_PLANES - 4) * sizeof(float));
    }
    return planes;
}

static DipCullPlanes pass_planes(const DipPass *pass, const NdcRegion *region, const float *m) {
    DipCullPlanes planes = view_planes(m, region);
    for (int p = 0; p < pass->clip_plane_count; p++) {
        Floats clip[4];
        for (int r = 0; r < 4; r++) {
            clip[r] = (Floats){pass->clip_planes[p][r]};
        }
        for (int c = 0; c < 4; c++) {
            planes.normal[c][planes.count] = transformed(m, clip, c)[0];
        }
        planes.count++;
    }
    return planes;
}

// Rounds a matrix to floats, because shaders use floats.
static void round_matrix(const double matrix[16], float rounded[16]) {
    for (int i = 0; i < 16; i++) {
        rounded[i] = (float)matrix[i];
    }
}

DipCullPlanes dip_cull_pass_planes(const DipPass *pass, const double world_to_clip[16]) {
    DIP_FP_MODE_SCOPE();
    const NdcRegion region = ndc_region(pass);
    float m[16];
    round_matrix(world_to_clip, m);
    return pass_planes(pass, &region, m);
}

DipCullPlanes dip_cull_view_planes(const double world_to_clip[16]) {
    DIP_FP_MODE_SCOPE();
    float m[16];
    round_matrix(world_to_clip, m);
    return view_planes(m, &whole);
}

static double magnitude(double v) {
    return v < 0.0 ? -v : v;
}

// Relative tolerance. It covers float rounding in the matrix, the planes and the vertex shader.
#define ROUNDING 1e-5f

static Floats magnitudes(Floats v) {
    return (Floats)((Ints)v & INT32_MAX);
}

static Floats load(const float *from) {
    Floats v;
    memcpy(&v, from, sizeof v);
    return v;
}

static bool any(Ints mask) {
    uint64_t halves[2];
    memcpy(halves, &mask, sizeof halves);
    return halves[0] | halves[1];
}

// The position of a box relative to planes 4 v .. 4 v + 3, one lane per plane.
typedef struct Sides {
    Ints outside; // the box is wholly outside the plane
    Ints crossed; // the box is not wholly inside the plane
} Sides;

static Sides sides_of(const DipCullPlanes *planes, const DipBox *box, int v) {
    Floats distance = load(planes->normal[3] + 4 * v);
    Floats radius = {0.0f, 0.0f, 0.0f, 0.0f};
    Floats size = magnitudes(distance);
    for (int c = 0; c < 3; c++) {
        const Floats normal = load(planes->normal[c] + 4 * v);
        const Floats length = magnitudes(normal);
        distance += normal * box->centre[c];
        radius += length * box->extent[c];
        size += length * fabsf(box->centre[c]);
    }
    const Floats margin = (size + radius) * ROUNDING;
    return (Sides){distance + radius < -margin, distance - radius <= margin};
}

// Returns whether a box lies wholly outside one of the planes. Sets *crosses to whether the box is
// only partly inside, so that the smaller boxes within it have to be tested.
static bool outside(const DipCullPlanes *planes, const DipBox *box, bool *crosses) {
    Sides all = sides_of(planes, box, 0);
    for (int v = 1; 4 * v < planes->count; v++) {
        const Sides sides = sides_of(planes, box, v);
        all.outside |= sides.outside;
        all.crossed |= sides.crossed;
    }
    *crosses = any(all.crossed);
    return any(all.outside);
}

bool dip_cull_outside(const DipCullPlanes *planes, const DipBox *box) {
    DIP_FP_MODE_SCOPE();
    bool crosses;
    return outside(planes, box, &crosses);
}

DipBox dip_cull_transform_box(const float transform[12], const DipBox *box) {
    DIP_FP_MODE_SCOPE();
    DipBox moved;
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
        moved.centre[axis] = (float)centre;
        moved.extent[axis] = (float)(extent + ROUNDING * size);
    }
    return moved;
}

static uint32_t cull_draw(const DipCullPlanes *planes, const DipMesh *mesh, uint32_t draw,
                          DipVisibleChunk *visible) {
    uint32_t count = 0;
    bool mesh_crosses;
    if (outside(planes, &mesh->box, &mesh_crosses)) {
        return 0;
    }
    for (uint32_t first = 0; first < mesh->chunk_count; first += DIP_GROUP_CHUNKS) {
        bool group_crosses = false;
        if (mesh_crosses &&
            outside(planes, &mesh->groups[first / DIP_GROUP_CHUNKS], &group_crosses)) {
            continue;
        }
        const uint32_t rest = mesh->chunk_count - first;
        const uint32_t end = first + (rest < DIP_GROUP_CHUNKS ? rest : DIP_GROUP_CHUNKS);
        for (uint32_t c = first; c < end; c++) {
            bool crosses;
            if (!group_crosses || !outside(planes, &mesh->chunks[c].box, &crosses)) {
                visible[count++] = (DipVisibleChunk){draw, c};
            }
        }
    }
    return count;
}

enum { PARTS = 64, DRAWS_PER_PART = 64 };

// A part of a pass's draws, whose chunks are culled by one thread.
typedef struct Part {
    uint32_t first; // numbers of its draws in the order in which they are drawn
    uint32_t end;
    uint32_t room;    // index into `visible` of the room for all chunks of its draws
    uint32_t count;   // number of chunks in view
    uint64_t in_view; // draws
    uint64_t culled;
} Part;

// The culling of a pass.
typedef struct CullRun {
    const DipPass *pass;
    const uint32_t *order;
    DipVisibleChunk *visible;
    NdcRegion region;
    Part parts[PARTS];
} CullRun;

static const DipDraw *draw_at(const CullRun *run, uint32_t i, uint32_t *number) {
    *number = run->order ? run->order[i] : i;
    return &run->pass->draws[*number];
}

static void cull_part(void *context, int index, int worker) {
    (void)worker;
    CullRun *run = context;
    Part part = run->parts[index];
    for (uint32_t i = part.first; i < part.end; i++) {
        uint32_t number;
        const DipDraw *draw = draw_at(run, i, &number);
        DipCullPlanes planes = no_planes();
        if (!draw->mesh->chunk_count) {
            continue;
        }
        if (draw->bounds_to_clip) {
            planes = pass_planes(run->pass, &run->region, draw->bounds_to_clip);
        }
        const uint32_t chunks =
            cull_draw(&planes, draw->mesh, number, run->visible + part.room + part.count);
        *(chunks ? &part.in_view : &part.culled) += 1;
        part.count += chunks;
    }
    run->parts[index] = part;
}

// Divides the draws into parts, and the room for visible chunks among them. Returns the number of
// parts.
static int divide(CullRun *run) {
    const uint64_t draws = (uint64_t)run->pass->draw_count;
    const uint64_t wanted = (draws + DRAWS_PER_PART - 1) / DRAWS_PER_PART;
    const int count = wanted < PARTS ? (int)wanted : PARTS;
    uint32_t next = 0;
    uint32_t room = 0;
    for (int p = 0; p < count; p++) {
        const uint32_t end = (uint32_t)(draws * (uint64_t)(p + 1) / (uint64_t)count);
        run->parts[p] = (Part){.first = next, .end = end, .room = room};
        for (; next < end && p + 1 < count; next++) {
            uint32_t number;
            room += draw_at(run, next, &number)->mesh->chunk_count;
        }
    }
    return count;
}

uint32_t dip_cull_chunks(const DipPass *pass, const uint32_t *order, DipPool *pool,
                         DipVisibleChunk *visible, uint64_t *in_view, uint64_t *culled) {
    CullRun run = {.pass = pass, .order = order, .visible = visible, .region = ndc_region(pass)};
    const int parts = divide(&run);
    dip_pool_run(parts > 1 ? pool : NULL, parts, cull_part, &run);
    uint32_t count = 0;
    for (int p = 0; p < parts; p++) {
        const Part *part = &run.parts[p];
        if (part->count && part->room != count) {
            memmove(visible + count, visible + part->room, part->count * sizeof *visible);
        }
        count += part->count;
        *in_view += part->in_view;
        *culled += part->culled;
    }
    return count;
}
