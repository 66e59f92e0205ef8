// Shadows of the strongest directional light: docs/picture.md, "Shadows". A place is in shadow if a
// ray from it to the light meets a surface that casts shadows. All rays are parallel, so the
// surfaces lie in a grid of cells across the rays, and a ray meets only what is in its cell.
#include "renderer/reference/internal/internal.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

// A triangle that casts a shadow. Its corners have the coordinates of the light: two across the
// rays, and one along them, which is greater nearer to the light.
typedef struct Caster {
    double corners[3][3];
    double uv[3][2];
    float alphas[3];               // of the vertices
    bool clipped;                  // the surface may have holes
    const DipRefTexture *clip_map; // of a clipped surface, or NULL
    double alpha_cutoff;
} Caster;

struct DipRefShadows {
    int light;
    double axis[3][3]; // unit vectors; the last points to the light
    double least_m;    // a ray begins this far from its place, so that no surface shades itself
    double low[2];     // least coordinates of the grid
    double cell[2];    // size of a cell
    int cells[2];      // number of cells
    Caster *casters;
    size_t count;
    // The casters of a cell are those with the indices items[first[cell]] to
    // items[first[cell + 1] - 1].
    size_t *first;
    uint32_t *items;
};

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// --- the light -----------------------------------------------------------------------------------

// Returns the index of the directional light of the greatest luminance, the first of equal ones, or
// -1 if there is none.
static int find_light(const DipLightingDef *lighting) {
    int found = -1;
    double greatest = 0.0;
    for (int l = 0; lighting && l < lighting->light_count; l++) {
        const DipLightDef *light = &lighting->lights[l];
        const float *rgb = light->colour_lin;
        const double luminance = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
        if (light->kind == DIP_LIGHT_DIRECTIONAL && luminance > greatest) {
            greatest = luminance;
            found = l;
        }
    }
    return found;
}

// Finds the axes of a light: any three that are at right angles, the last towards the light.
static void find_axes(const DipLightDef *light, double axis[3][3]) {
    const float *way = light->direction_world;
    const double length =
        sqrt((double)way[0] * way[0] + (double)way[1] * way[1] + (double)way[2] * way[2]);
    int least = 0;
    for (int i = 0; i < 3; i++) {
        axis[2][i] = -way[i] / length;
        least = fabs(axis[2][i]) < fabs(axis[2][least]) ? i : least;
    }
    const int j = (least + 1) % 3, k = (least + 2) % 3;
    const double across = sqrt(axis[2][j] * axis[2][j] + axis[2][k] * axis[2][k]);
    axis[0][least] = 0.0;
    axis[0][j] = -axis[2][k] / across;
    axis[0][k] = axis[2][j] / across;
    for (int i = 0; i < 3; i++) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        axis[1][i] = axis[2][a] * axis[0][b] - axis[2][b] * axis[0][a];
    }
}

// --- the casters ---------------------------------------------------------------------------------

static bool casts(const DipMaterialDef *material) {
    return (material->surface == DIP_SURFACE_OPAQUE || material->surface == DIP_SURFACE_CLIPPED) &&
           (material->lit || material->light_map != DIP_NO_TEXTURE);
}

static const DipMaterialDef *material_of(const DipSceneDef *def, const DipObjectDef *object) {
    return &def->materials[def->meshes[object->mesh].material];
}

static size_t count_casters(const DipSceneDef *def) {
    size_t count = 0;
    for (int o = 0; o < def->object_count; o++) {
        if (casts(material_of(def, &def->objects[o]))) {
            count += def->meshes[def->objects[o].mesh].index_count / 3;
        }
    }
    return count;
}

static void set_corner(const DipRefShadows *shadows, const DipObjectDef *object,
                       const DipMeshDef *mesh, uint32_t index, int corner, Caster *caster) {
    const float *p = mesh->positions + 3 * (size_t)index;
    double world[3];
    for (int i = 0; i < 3; i++) {
        const float *row = object->transform + 4 * i;
        world[i] =
            (double)row[0] * p[0] + (double)row[1] * p[1] + (double)row[2] * p[2] + (double)row[3];
    }
    for (int i = 0; i < 3; i++) {
        caster->corners[corner][i] = dot(shadows->axis[i], world);
    }
    for (int i = 0; i < 2; i++) {
        caster->uv[corner][i] = mesh->uv0 ? mesh->uv0[2 * (size_t)index + (size_t)i] : 0.0;
    }
    caster->alphas[corner] = mesh->alphas ? mesh->alphas[index] : 1.0f;
}

static void add_casters(const DipReference *reference, DipRefShadows *shadows) {
    const DipSceneDef *def = reference->def;
    for (int o = 0; o < def->object_count; o++) {
        const DipObjectDef *object = &def->objects[o];
        const DipMeshDef *mesh = &def->meshes[object->mesh];
        const DipMaterialDef *material = material_of(def, object);
        const bool clipped = material->surface == DIP_SURFACE_CLIPPED;
        const bool mapped = clipped && mesh->uv0 && material->colour_texture != DIP_NO_TEXTURE;
        for (uint32_t i = 0; casts(material) && i < mesh->index_count; i += 3) {
            Caster *caster = &shadows->casters[shadows->count++];
            *caster =
                (Caster){.clipped = mapped || (clipped && mesh->alphas),
                         .clip_map = mapped ? &reference->textures[material->colour_texture] : NULL,
                         .alpha_cutoff = material->alpha_cutoff};
            for (int k = 0; k < 3; k++) {
                set_corner(shadows, object, mesh, mesh->indices[i + (uint32_t)k], k, caster);
            }
        }
    }
}

// --- the grid ------------------------------------------------------------------------------------

static int cell_at(const DipRefShadows *shadows, int axis, double at) {
    const double cell = (at - shadows->low[axis]) / shadows->cell[axis];
    const int last = shadows->cells[axis] - 1;
    return cell >= last ? last : cell > 0.0 ? (int)cell : 0;
}

// Finds the cells that a caster may reach: from[i] to to[i] along each axis.
static void find_cells(const DipRefShadows *shadows, const Caster *caster, int from[2], int to[2]) {
    const double(*p)[3] = (const double(*)[3])caster->corners;
    for (int i = 0; i < 2; i++) {
        from[i] = cell_at(shadows, i, fmin(p[0][i], fmin(p[1][i], p[2][i])));
        to[i] = cell_at(shadows, i, fmax(p[0][i], fmax(p[1][i], p[2][i])));
    }
}

// Divides a grid of the given extent into side x side cells. Returns how many items all cells
// together hold.
static double divide_grid(DipRefShadows *shadows, const double extent[2], int side) {
    double items = 0.0;
    for (int i = 0; i < 2; i++) {
        shadows->cells[i] = side;
        shadows->cell[i] = fmax(extent[i] / side, 1e-30);
    }
    for (size_t c = 0; c < shadows->count; c++) {
        int from[2], to[2];
        find_cells(shadows, &shadows->casters[c], from, to);
        items += (double)(to[0] - from[0] + 1) * (to[1] - from[1] + 1);
    }
    return items;
}

// Lays the grid over all casters. It has about as many cells as there are casters, but fewer if
// many casters are large.
static void lay_grid(DipRefShadows *shadows) {
    double low[3] = {INFINITY, INFINITY, INFINITY};
    double high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t c = 0; c < shadows->count; c++) {
        for (int k = 0; k < 9; k++) {
            const double at = shadows->casters[c].corners[k / 3][k % 3];
            low[k % 3] = fmin(low[k % 3], at);
            high[k % 3] = fmax(high[k % 3], at);
        }
    }
    double greatest = 0.0;
    for (int i = 0; i < 3; i++) {
        greatest = fmax(greatest, fmax(fabs(low[i]), fabs(high[i])));
    }
    shadows->least_m = 1e-9 * greatest;
    shadows->low[0] = low[0];
    shadows->low[1] = low[1];
    const double extent[2] = {high[0] - low[0], high[1] - low[1]};
    const double most = 64.0 * ((double)shadows->count + 64.0);
    int side = (int)fmin(fmax(sqrt((double)shadows->count), 1.0), 1024.0);
    while (divide_grid(shadows, extent, side) > most && side > 1) {
        side /= 2;
    }
}

// Visits all cells that each caster may reach. Counts the casters of each cell and, unless
// count_only is true, writes their indices.
static void fill_cells(DipRefShadows *shadows, size_t *cursor, bool count_only) {
    for (size_t c = 0; c < shadows->count; c++) {
        int from[2], to[2];
        find_cells(shadows, &shadows->casters[c], from, to);
        for (int y = from[1]; y <= to[1]; y++) {
            for (int x = from[0]; x <= to[0]; x++) {
                size_t *at = &cursor[y * shadows->cells[0] + x];
                if (!count_only) {
                    shadows->items[*at] = (uint32_t)c;
                }
                ++*at;
            }
        }
    }
}

static bool make_cells(DipRefShadows *shadows) {
    lay_grid(shadows);
    const size_t cells = (size_t)shadows->cells[0] * (size_t)shadows->cells[1];
    size_t *cursor = calloc(cells, sizeof *cursor);
    shadows->first = calloc(cells + 1, sizeof *shadows->first);
    if (!cursor || !shadows->first) {
        free(cursor);
        return false;
    }
    fill_cells(shadows, cursor, true);
    for (size_t i = 0; i < cells; i++) {
        shadows->first[i + 1] = shadows->first[i] + cursor[i];
        cursor[i] = shadows->first[i];
    }
    shadows->items = malloc((shadows->first[cells] + 1) * sizeof *shadows->items);
    if (shadows->items) {
        fill_cells(shadows, cursor, false);
    }
    free(cursor);
    return shadows->items != NULL;
}

bool dip_reference_shadows_create(const DipReference *reference, DipRefShadows **shadows,
                                  DipError *err) {
    const DipLightingDef *lighting = reference->def->lighting;
    const int light = find_light(lighting);
    const size_t count = light >= 0 ? count_casters(reference->def) : 0;
    *shadows = NULL;
    if (count == 0) {
        return true;
    }
    DipRefShadows *made = calloc(1, sizeof *made);
    bool whole = made != NULL && count <= UINT32_MAX;
    if (whole) {
        made->light = light;
        find_axes(&lighting->lights[light], made->axis);
        made->casters = malloc(count * sizeof *made->casters);
        whole = made->casters != NULL;
    }
    if (whole) {
        add_casters(reference, made);
        whole = make_cells(made);
    }
    if (!whole) {
        dip_reference_shadows_destroy(&made);
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, NULL, "no memory for shadows");
    }
    *shadows = made;
    return true;
}

void dip_reference_shadows_destroy(DipRefShadows **shadows) {
    if (*shadows) {
        free((*shadows)->casters);
        free((*shadows)->first);
        free((*shadows)->items);
        free(*shadows);
        *shadows = NULL;
    }
}

int dip_reference_shadow_light(const DipRefShadows *shadows) {
    return shadows ? shadows->light : -1;
}

// --- rays ----------------------------------------------------------------------------------------

// Returns true if a ray from `place`, in the light's coordinates, meets a caster.
static bool meets(const DipRefShadows *shadows, const Caster *caster, const double place[3]) {
    const double(*p)[3] = caster->corners;
    double weights[3];
    for (int i = 0; i < 3; i++) {
        const double *a = p[(i + 1) % 3];
        const double *b = p[(i + 2) % 3];
        weights[i] = (a[0] - place[0]) * (b[1] - place[1]) - (a[1] - place[1]) * (b[0] - place[0]);
    }
    const bool inside = (weights[0] >= 0.0 && weights[1] >= 0.0 && weights[2] >= 0.0) ||
                        (weights[0] <= 0.0 && weights[1] <= 0.0 && weights[2] <= 0.0);
    const double area = weights[0] + weights[1] + weights[2];
    if (!inside || area == 0.0) {
        return false;
    }
    double at = 0.0, alpha = 0.0, uv[2] = {0.0, 0.0};
    for (int i = 0; i < 3; i++) {
        at += weights[i] * p[i][2] / area;
        uv[0] += weights[i] * caster->uv[i][0] / area;
        uv[1] += weights[i] * caster->uv[i][1] / area;
        alpha += weights[i] * (double)caster->alphas[i] / area;
    }
    if (!(at > place[2] + shadows->least_m)) {
        return false;
    }
    double rgba[4] = {0.0, 0.0, 0.0, 1.0};
    if (caster->clip_map) {
        dip_reference_sample_finest(caster->clip_map, uv, rgba);
    }
    return !caster->clipped || rgba[3] * alpha >= caster->alpha_cutoff;
}

double dip_reference_sunlit(const DipRefLit *lit, const double place[3]) {
    const DipRefShadows *shadows = lit->shadows;
    if (!shadows) {
        return 1.0;
    }
    double world[3];
    double at[3];
    for (int i = 0; i < 3; i++) {
        world[i] = lit->eye[i] + place[i];
    }
    for (int i = 0; i < 3; i++) {
        at[i] = dot(shadows->axis[i], world);
    }
    const int cell = cell_at(shadows, 1, at[1]) * shadows->cells[0] + cell_at(shadows, 0, at[0]);
    for (size_t i = shadows->first[cell]; i < shadows->first[cell + 1]; i++) {
        if (meets(shadows, &shadows->casters[shadows->items[i]], at)) {
            return 0.0;
        }
    }
    return 1.0;
}
