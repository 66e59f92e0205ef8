// Makes the ground below a model, and a texture of the shade that the model leaves on the ground.
// The model's lowest surfaces are drawn into a grid of heights. The heights determine how much of
// the light from above reaches each texel. Computes with + - * / and square roots alone, so that
// the texture has the same bits on every machine.
#include "app/session/ground.h"

#include "renderer/scene/motion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GRID = 256 }; // Texels of the shade, and cells of the grid of heights, along each side.

// Distance from the model down to the ground, as a share of the model's size. This gap keeps the
// model's underside and the ground from lying in one plane.
static const double gap = 5e-4;

// The shade is the product of these layers. In a layer, a surface that is lower than `reach` times
// the model's size darkens the ground around it by up to `strength`; the higher the surface is, the
// less it darkens. So low surfaces leave a small dark shade, and high surfaces a wide faint one.
static const struct {
    double reach;
    double strength;
} layers[] = {{0.015, 0.42}, {0.05, 0.36}, {0.15, 0.30}, {0.40, 0.25}};
enum { LAYERS = sizeof layers / sizeof *layers };

// --- the scene's triangles -----------------------------------------------------------------------

typedef struct Point {
    double at[3];
} Point;

static Point vertex_of(const DipObjectDef *object, const DipMeshDef *mesh, uint32_t index) {
    const float *p = mesh->positions + 3 * (size_t)index;
    Point point;
    for (int i = 0; i < 3; i++) {
        const float *row = object->transform + 4 * i;
        point.at[i] =
            (double)row[0] * p[0] + (double)row[1] * p[1] + (double)row[2] * p[2] + (double)row[3];
    }
    return point;
}

static DipSurface surface_of(const DipSceneDef *def, const DipObjectDef *object) {
    return def->materials[def->meshes[object->mesh].material].surface;
}

// A function that is called for each triangle of the scene that is not sky.
typedef void (*Visit)(void *context, const Point corners[3]);

static void visit_triangles(const DipSceneDef *def, Visit visit, void *context) {
    for (int o = 0; o < def->object_count; o++) {
        const DipObjectDef *object = &def->objects[o];
        const DipMeshDef *mesh = &def->meshes[object->mesh];
        if (surface_of(def, object) == DIP_SURFACE_SKY) {
            continue;
        }
        for (uint32_t i = 0; i + 2 < mesh->index_count; i += 3) {
            Point corners[3];
            for (uint32_t c = 0; c < 3; c++) {
                corners[c] = vertex_of(object, mesh, mesh->indices[i + c]);
            }
            visit(context, corners);
        }
    }
}

// Calls the function for each triangle at each of several moments of the scene's clips. If there is
// no memory for the moved scene, visits the scene at rest.
static void visit_moments(const DipSceneDef *def, int moments, Visit visit, void *context) {
    DipPosedDef *posed = def->motion ? dip_posed_def_create(def, NULL) : NULL;
    for (int k = 0; posed && k < moments; k++) {
        dip_posed_def_set_share(posed, (double)k / moments);
        visit_triangles(dip_posed_def(posed), visit, context);
    }
    if (!posed) {
        visit_triangles(def, visit, context);
    }
    dip_posed_def_destroy(&posed);
}

// --- extent and silhouette -----------------------------------------------------------------------

typedef struct ExtentJob {
    DipExtent extent;
    bool found;
} ExtentJob;

static void extend(void *context, const Point corners[3]) {
    ExtentJob *job = context;
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < 3; i++) {
            const double at = corners[c].at[i];
            job->extent.low[i] = job->found ? fmin(job->extent.low[i], at) : at;
            job->extent.high[i] = job->found ? fmax(job->extent.high[i], at) : at;
        }
        job->found = true;
    }
}

// A copy of a scene in which each moving mesh is replaced by the corners of a box. The box holds
// the mesh at all moments, so only objects move in the copy.
typedef struct BoxedScene {
    DipSceneDef def;
    DipMotionDef motion;
    DipMeshDef *meshes;
    float (*corners)[24]; // [moving mesh]: the eight corners of its box.
} BoxedScene;

static void box_mesh(const DipMovingMesh *moving, float corners[24], DipMeshDef *mesh) {
    static const uint32_t indices[9] = {0, 1, 2, 3, 4, 5, 6, 7, 7};
    for (int i = 0; i < 24; i++) {
        const int axis = i % 3;
        corners[i] = moving->box[(i / 3 >> axis & 1) ? 3 + axis : axis];
    }
    mesh->positions = corners;
    mesh->vertex_count = 8;
    mesh->indices = indices;
    mesh->index_count = 9;
}

// Makes the boxed scene. The result is the scene itself if no mesh moves, if a moving mesh has no
// box, or if memory runs out.
static void make_boxed(const DipSceneDef *def, BoxedScene *boxed) {
    const DipMotionDef *motion = def->motion;
    const size_t moving = motion ? (size_t)motion->mesh_count : 0;
    *boxed = (BoxedScene){.def = *def};
    boxed->meshes = calloc((size_t)def->mesh_count + 1, sizeof *boxed->meshes);
    boxed->corners = calloc(moving + 1, sizeof *boxed->corners);
    bool made = moving > 0 && boxed->meshes && boxed->corners;
    for (size_t m = 0; made && m < moving; m++) {
        made = motion->meshes[m].box != NULL;
    }
    if (!made) {
        return;
    }
    memcpy(boxed->meshes, def->meshes, (size_t)def->mesh_count * sizeof *boxed->meshes);
    for (size_t m = 0; m < moving; m++) {
        box_mesh(&motion->meshes[m], boxed->corners[m], &boxed->meshes[motion->meshes[m].mesh]);
    }
    boxed->motion = *motion;
    boxed->motion.mesh_count = 0;
    boxed->def.motion = &boxed->motion;
    boxed->def.meshes = boxed->meshes;
}

DipExtent dip_extent_of(const DipSceneDef *def) {
    ExtentJob job = {.found = false};
    BoxedScene boxed;
    make_boxed(def, &boxed);
    visit_moments(&boxed.def, DIP_MOTION_MOMENTS, extend, &job);
    free(boxed.meshes);
    free(boxed.corners);
    return job.extent;
}

typedef struct SilhouetteJob {
    DipSilhouette silhouette;
    const DipExtent *extent;
} SilhouetteJob;

static void widen(void *context, const Point corners[3]) {
    SilhouetteJob *job = context;
    const double *low = job->extent->low;
    const double *high = job->extent->high;
    const double height = high[1] - low[1];
    for (int c = 0; c < 3; c++) {
        const double x = corners[c].at[0] - 0.5 * (low[0] + high[0]);
        const double z = corners[c].at[2] - 0.5 * (low[2] + high[2]);
        const double share = height > 0.0 ? (corners[c].at[1] - low[1]) / height : 0.0;
        const int slice = (int)fmin(share * DIP_SILHOUETTE_SLICES, DIP_SILHOUETTE_SLICES - 1);
        double *radius = &job->silhouette.radius[slice];
        *radius = fmax(*radius, sqrt(x * x + z * z));
    }
}

DipSilhouette dip_silhouette_of(const DipSceneDef *def, const DipExtent *extent) {
    SilhouetteJob job = {.extent = extent};
    for (int i = 0; i < DIP_SILHOUETTE_SLICES; i++) {
        job.silhouette.radius[i] = -1.0;
    }
    visit_moments(def, DIP_MOTION_MOMENTS, widen, &job);
    return job.silhouette;
}

// --- a grid of heights ---------------------------------------------------------------------------

// Square cells in the plane of the ground. Row 0 has the least z.
typedef struct Grid {
    double low[2];             // Least x and z.
    double cell;               // Size of a cell.
    double floor;              // The height that counts as 0.
    double most;               // Surfaces that lie higher do not count.
    bool facing_up;            // True to leave out surfaces that do not face up.
    float height[GRID * GRID]; // Height of each cell's lowest surface; greater than `most` if the
                               // cell has no surface up to `most`.
} Grid;

static int cell_at(const Grid *grid, int axis, double at) {
    const double cell = (at - grid->low[axis == 2]) / grid->cell;
    return cell < 0.0 ? 0 : cell >= GRID ? GRID - 1 : (int)cell;
}

static void lower(Grid *grid, int column, int row, double height) {
    float *cell = &grid->height[GRID * row + column];
    if (height >= 0.0 && height < (double)*cell) {
        *cell = (float)height;
    }
}

// Draws a triangle into the grid: each cell keeps the lesser of its height and the triangle's
// height. The triangle covers the cells whose centres lie in it, seen from above, and the cells of
// its corners, so that no triangle is too small to count.
static void draw_triangle(void *context, const Point p[3]) {
    Grid *grid = context;
    const double x1 = p[1].at[0] - p[0].at[0], z1 = p[1].at[2] - p[0].at[2];
    const double x2 = p[2].at[0] - p[0].at[0], z2 = p[2].at[2] - p[0].at[2];
    const double area = x1 * z2 - x2 * z1; // Negative if the triangle faces up.
    int from[2] = {GRID, GRID};
    int to[2] = {-1, -1};
    double lowest = INFINITY;
    if (grid->facing_up && area >= 0.0) {
        return;
    }
    for (int c = 0; c < 3; c++) {
        const int column = cell_at(grid, 0, p[c].at[0]);
        const int row = cell_at(grid, 2, p[c].at[2]);
        from[0] = column < from[0] ? column : from[0];
        from[1] = row < from[1] ? row : from[1];
        to[0] = column > to[0] ? column : to[0];
        to[1] = row > to[1] ? row : to[1];
        lowest = fmin(lowest, p[c].at[1] - grid->floor);
        lower(grid, column, row, p[c].at[1] - grid->floor);
    }
    if (lowest > grid->most || area == 0.0) {
        return;
    }
    for (int row = from[1]; row <= to[1]; row++) {
        for (int column = from[0]; column <= to[0]; column++) {
            const double x = grid->low[0] + (column + 0.5) * grid->cell - p[0].at[0];
            const double z = grid->low[1] + (row + 0.5) * grid->cell - p[0].at[2];
            const double second = (x * z2 - x2 * z) / area;
            const double third = (x1 * z - x * z1) / area;
            if (second >= 0.0 && third >= 0.0 && second + third <= 1.0) {
                lower(grid, column, row,
                      p[0].at[1] + second * (p[1].at[1] - p[0].at[1]) +
                          third * (p[2].at[1] - p[0].at[1]) - grid->floor);
            }
        }
    }
}

static void fill_grid(Grid *grid, const DipSceneDef *def) {
    for (int i = 0; i < GRID * GRID; i++) {
        grid->height[i] = INFINITY;
    }
    visit_moments(def, 1, draw_triangle, grid);
}

// --- where a ground is missing -------------------------------------------------------------------

static double width_of(const DipExtent *extent) {
    return fmax(extent->high[0] - extent->low[0], extent->high[2] - extent->low[2]);
}

static double height_of(const DipExtent *extent) {
    return extent->high[1] - extent->low[1];
}

// Returns the size of the model. Lengths on the ground are multiples of this size.
static double size_of(const DipExtent *extent) {
    return fmax(width_of(extent), 0.7 * height_of(extent));
}

// Returns whether surfaces that face up cover most of the rectangle below the model, near its
// lowest point.
static bool has_ground(const DipSceneDef *def, const DipExtent *extent) {
    Grid *grid = malloc(sizeof *grid);
    if (!grid) {
        return true; // Without memory, the model is shown without a ground.
    }
    const double lowest = 0.04 * size_of(extent);
    *grid = (Grid){.low = {extent->low[0], extent->low[2]},
                   .cell = width_of(extent) / GRID,
                   .floor = extent->low[1],
                   .most = lowest,
                   .facing_up = true};
    fill_grid(grid, def);
    int covered = 0;
    for (int i = 0; i < GRID * GRID; i++) {
        covered += (double)grid->height[i] <= lowest;
    }
    const double cells = (extent->high[0] - extent->low[0]) * (extent->high[2] - extent->low[2]) /
                         (grid->cell * grid->cell);
    free(grid);
    return covered >= 0.6 * cells;
}

bool dip_ground_is_missing(const DipSceneDef *def, const DipExtent *extent) {
    for (int o = 0; o < def->object_count; o++) {
        const DipSurface surface = surface_of(def, &def->objects[o]);
        if (surface == DIP_SURFACE_SKY || surface == DIP_SURFACE_WATER) {
            return false;
        }
    }
    // A flat scene is a ground itself. Far above or below the origin, floats are too coarse for the
    // gap between the scene and the ground.
    const double size = size_of(extent);
    const double far = fmax(fabs(extent->low[1]), fabs(extent->high[1]));
    return width_of(extent) > 0.0 && height_of(extent) > 0.05 * width_of(extent) &&
           far < 1e3 * size && !has_ground(def, extent);
}

// --- shade ---------------------------------------------------------------------------------------

// Replaces each value of a line by the mean of the values up to `reach` places away. Beyond the
// ends, values are 0.
static void blur_line(const float *from, float *to, size_t step, int reach) {
    double sum = 0.0;
    for (int i = 0; i < reach && i < GRID; i++) {
        sum += (double)from[(size_t)i * step];
    }
    for (int i = 0; i < GRID; i++) {
        if (i + reach < GRID) {
            sum += (double)from[(size_t)(i + reach) * step];
        }
        if (i - reach - 1 >= 0) {
            sum -= (double)from[(size_t)(i - reach - 1) * step];
        }
        to[(size_t)i * step] = (float)(sum / (2 * reach + 1));
    }
}

// Blurs a square along both axes. Three means in succession along an axis come near to a Gaussian.
static void blur(float *values, float *scratch, int reach) {
    for (int pass = 0; pass < 3; pass++) {
        for (size_t row = 0; row < GRID; row++) {
            blur_line(values + GRID * row, scratch + GRID * row, 1, reach);
        }
        for (size_t column = 0; column < GRID; column++) {
            blur_line(scratch + column, values + column, GRID, reach);
        }
    }
}

// Returns the weight of the shade at a texel. It is 1 in the middle of the ground and falls to 0
// before the border, so that the border is not seen.
static double fading(int column, int row) {
    const double x = (column + 0.5) / GRID * 2.0 - 1.0;
    const double z = (row + 0.5) / GRID * 2.0 - 1.0;
    const double distance = sqrt(x * x + z * z);
    const double t = distance < 0.6 ? 0.0 : distance > 0.98 ? 1.0 : (distance - 0.6) / 0.38;
    return 1.0 - t * t * (3.0 - 2.0 * t);
}

// Writes the share of light that each texel gets, as linear values. Returns false when memory runs
// out.
static bool fill_shade(const Grid *grid, double size, uint8_t *rgba8) {
    float *layer = malloc(3 * sizeof *layer * GRID * GRID);
    if (!layer) {
        return false;
    }
    float *scratch = layer + GRID * GRID;
    float *light = scratch + GRID * GRID;
    for (int i = 0; i < GRID * GRID; i++) {
        light[i] = 1.0f;
    }
    for (int l = 0; l < LAYERS; l++) {
        const double reach = layers[l].reach * size;
        const int cells = (int)(0.5 * reach / grid->cell);
        for (int i = 0; i < GRID * GRID; i++) {
            const double height = (double)grid->height[i];
            layer[i] = height < reach ? (float)(1.0 - height / reach) : 0.0f;
        }
        blur(layer, scratch, cells > 1 ? cells : 1);
        for (int i = 0; i < GRID * GRID; i++) {
            light[i] *= (float)(1.0 - layers[l].strength * fmin(2.0 * (double)layer[i], 1.0));
        }
    }
    for (int i = 0; i < GRID * GRID; i++) {
        const double dark = (1.0 - (double)light[i]) * fading(i % GRID, i / GRID);
        const uint8_t code = (uint8_t)(255.0 * (1.0 - dark) + 0.5);
        memset(rgba8 + 4 * (size_t)i, code, 3);
        rgba8[4 * i + 3] = 255;
    }
    free(layer);
    return true;
}

// --- the scene with the ground -------------------------------------------------------------------

static void fill_square(DipAddedSurface *ground, const Grid *grid, double level) {
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    const double size = grid->cell * GRID;
    for (int i = 0; i < 4; i++) {
        const int right = i == 1 || i == 2;
        const int front = i < 2; // Seen from above, the corners run counter-clockwise.
        ground->positions[3 * i] = (float)(grid->low[0] + right * size);
        ground->positions[3 * i + 1] = (float)level;
        ground->positions[3 * i + 2] = (float)(grid->low[1] + front * size);
        ground->uv[2 * i] = (float)right;
        ground->uv[2 * i + 1] = (float)front;
    }
    memcpy(ground->indices, indices, sizeof indices);
}

DipAddedSurface *dip_ground_create(const DipSceneDef *def, const DipExtent *extent, DipError *err) {
    const DipTextureDef shade = {.name = "shade of the ground",
                                 .width = GRID,
                                 .height = GRID,
                                 .encoding = DIP_ENCODING_LINEAR,
                                 .wrap_u = DIP_WRAP_CLAMP,
                                 .wrap_v = DIP_WRAP_CLAMP};
    const DipMeshDef square = {.name = "ground", .vertex_count = 4, .index_count = 6};
    DipAddedSurface *ground =
        dip_added_surface_create(def, &shade, def->background_lin, &square, err);
    if (!ground) {
        return NULL;
    }
    Grid *grid = malloc(sizeof *grid);
    const double size = size_of(extent);
    const double half = 0.5 * width_of(extent) + 0.8 * size;
    if (grid) {
        *grid = (Grid){.low = {0.5 * (extent->low[0] + extent->high[0]) - half,
                               0.5 * (extent->low[2] + extent->high[2]) - half},
                       .cell = 2.0 * half / GRID,
                       .floor = extent->low[1],
                       .most = layers[LAYERS - 1].reach * size};
        fill_grid(grid, def);
    }
    if (grid && fill_shade(grid, size, ground->rgba8)) {
        fill_square(ground, grid, extent->low[1] - gap * size);
    } else {
        dip_added_surface_destroy(&ground);
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, square.name, "out of memory");
    }
    free(grid);
    return ground;
}
