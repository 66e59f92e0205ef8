// Checks a tessellation, and evaluates the points of its patches.
#include "renderer/shapes/tessellate.h"

#include "renderer/base/fp_mode.h"
#include "renderer/pipeline/shader.h"
#include "renderer/shapes/patch/divide.h"
#include "renderer/shapes/patch/net.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_INDICES = 1 << 30 }; // as for meshes

static bool check_counts(const DipTessellationDef *def, DipError *err) {
    const uint32_t corners = def->domain == DIP_DOMAIN_QUAD ? 4 : 3;
    if ((unsigned)def->domain >= DIP_DOMAIN_COUNT) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "domain", "%d, accepted 0..%d",
                             (int)def->domain, DIP_DOMAIN_COUNT - 1);
    }
    if ((unsigned)def->partitioning >= DIP_PARTITIONING_COUNT) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "partitioning", "%d, accepted 0..%d",
                             (int)def->partitioning, DIP_PARTITIONING_COUNT - 1);
    }
    if (def->attribute_count < 1) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "attribute_count",
                             "%d, accepted at least 1", def->attribute_count);
    }
    const int most = def->function == dip_domain_linear && def->attribute_count < DIP_MAX_ATTRIBUTES
                         ? def->attribute_count
                         : DIP_MAX_ATTRIBUTES;
    if (def->out_attribute_count < 1 || def->out_attribute_count > most) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "out_attribute_count",
                             "%d, accepted 1..%d", def->out_attribute_count, most);
    }
    if (def->index_count % corners != 0) {
        return dip_error_set(err, DIP_ERROR_FORMAT, NULL, 0, "index_count",
                             "%u, accepted a multiple of %u", def->index_count, corners);
    }
    return true;
}

static bool check_pointers(const DipTessellationDef *def, DipError *err) {
    const struct {
        const char *key;
        bool missing;
    } pointers[4] = {{"attributes", !def->attributes},
                     {"indices", !def->indices},
                     {"factors", !def->factors},
                     {"function", !def->function}};
    for (int i = 0; i < 4; i++) {
        if (pointers[i].missing && (def->index_count || i == 3)) {
            return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, pointers[i].key, "NULL");
        }
    }
    for (uint32_t i = 0; i < def->index_count; i++) {
        if (def->indices[i] >= def->vertex_count) {
            return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "indices",
                                 "index %u of %u is out of range, accepted less than %u",
                                 def->indices[i], i, def->vertex_count);
        }
    }
    return true;
}

static bool check_factors(const DipTessellationDef *def, uint32_t count, DipError *err) {
    const int edges = def->domain == DIP_DOMAIN_QUAD ? 4 : 3;
    for (uint32_t i = 0; i < count; i++) {
        const DipTessellationFactors *factors = &def->factors[i];
        bool bad = isnan(factors->inside[0]) || (edges == 4 && isnan(factors->inside[1]));
        for (int e = 0; e < edges; e++) {
            bad = bad || isnan(factors->edge[e]);
        }
        if (bad) {
            return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "factors",
                                 "a factor of patch %u is not a number", i);
        }
    }
    return true;
}

// A tessellation that is being made.
typedef struct Work {
    const DipTessellationDef *def;
    DipShape *shape;
    DipPatchNet *net;
    const DipTessellationFactors *filled; // factors of the net; NULL: none yet
} Work;

static const DipTessellationFactors *factors_of(const DipTessellationDef *def, uint32_t patch) {
    return def->same_factors ? def->factors : def->factors + patch;
}

// Makes the net of a patch, unless the patch before it has the same factors.
static void fill_net(Work *work, const DipTessellationFactors *factors) {
    if (work->filled && memcmp(work->filled, factors, sizeof *factors) == 0) {
        return;
    }
    work->filled = factors;
    const DipPatchPlan plan = dip_patch_plan(factors, work->def->domain, work->def->partitioning);
    dip_net_fill(work->net, &plan);
}

// Appends the vertices and indices of a patch.
static void add_patch(Work *work, uint32_t patch) {
    const DipTessellationDef *def = work->def;
    const DipPatchNet *net = work->net;
    DipShape *shape = work->shape;
    const uint32_t corners = def->domain == DIP_DOMAIN_QUAD ? 4 : 3;
    fill_net(work, factors_of(def, patch));
    if (net->point_count == 0) {
        return;
    }
    DipDomainBatch batch = {.count = (int)net->point_count,
                            .patch = patch,
                            .u = net->location[0],
                            .v = net->location[1],
                            .w = corners == 3 ? net->location[2] : NULL,
                            .out = shape->attributes +
                                   (size_t)shape->vertex_count * (size_t)def->out_attribute_count,
                            .out_attribute_count = def->out_attribute_count,
                            .uniforms = def->uniforms};
    for (uint32_t k = 0; k < corners; k++) {
        batch.control[k] = def->attributes + (size_t)def->indices[(size_t)patch * corners + k] *
                                                 (size_t)def->attribute_count;
    }
    def->function(&batch);
    for (uint32_t i = 0; i < net->index_count; i++) {
        shape->indices[shape->index_count + i] = shape->vertex_count + net->indices[i];
    }
    shape->vertex_count += net->point_count;
    shape->index_count += net->index_count;
}

// Counts the points and triangles of all patches.
static DipPatchCounts count_all(const DipTessellationDef *def, uint32_t patch_count) {
    DipPatchCounts all = {0, 0};
    for (uint32_t i = 0; i < patch_count; i++) {
        const DipPatchPlan plan =
            dip_patch_plan(factors_of(def, i), def->domain, def->partitioning);
        const DipPatchCounts counts = dip_patch_count(&plan);
        if (def->same_factors) {
            return (DipPatchCounts){counts.points * patch_count, counts.triangles * patch_count};
        }
        all.points += counts.points;
        all.triangles += counts.triangles;
    }
    return all;
}

static void *allocate(uint64_t count, size_t element_bytes) {
    return count < SIZE_MAX / element_bytes ? malloc(((size_t)count + 1) * element_bytes) : NULL;
}

bool dip_tessellate(DipShape *shape, const DipTessellationDef *def, DipError *err) {
    DIP_FP_MODE_SCOPE();
    *shape = (DipShape){0};
    if (!check_counts(def, err) || !check_pointers(def, err)) {
        return false;
    }
    const uint32_t patch_count = def->index_count / (def->domain == DIP_DOMAIN_QUAD ? 4 : 3);
    const uint32_t factor_count = def->same_factors && patch_count ? 1 : patch_count;
    if (!check_factors(def, factor_count, err)) {
        return false;
    }
    const DipPatchCounts counts = count_all(def, patch_count);
    if (counts.triangles > MAX_INDICES / 3) {
        return dip_error_set(err, DIP_ERROR_OVERSIZED, NULL, 0, "factors",
                             "%llu triangles, accepted at most %d",
                             (unsigned long long)counts.triangles, MAX_INDICES / 3);
    }
    Work work = {.def = def, .shape = shape, .net = malloc(sizeof *work.net)};
    shape->attribute_count = def->out_attribute_count;
    shape->attributes =
        allocate(counts.points * (uint64_t)def->out_attribute_count, sizeof *shape->attributes);
    shape->indices = allocate(3 * counts.triangles, sizeof *shape->indices);
    const bool made = work.net && shape->attributes && shape->indices;
    if (made) {
        for (uint32_t i = 0; i < patch_count; i++) {
            add_patch(&work, i);
        }
    } else {
        dip_shape_free(shape);
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "shape", "out of memory");
    }
    free(work.net);
    return made;
}

// --- linear interpolation ------------------------------------------------------------------------

static void interpolate_triangle(const DipDomainBatch *batch) {
    const float *a = batch->control[0];
    const float *b = batch->control[1];
    const float *c = batch->control[2];
    const int count = batch->out_attribute_count;
    for (int i = 0; i < batch->count; i++) {
        float *restrict out = batch->out + (size_t)i * (size_t)count;
        for (int k = 0; k < count; k++) {
            out[k] = a[k] * batch->u[i] + b[k] * batch->v[i] + c[k] * batch->w[i];
        }
    }
}

static void interpolate_quad(const DipDomainBatch *batch) {
    const float *const *control = batch->control;
    const int count = batch->out_attribute_count;
    for (int i = 0; i < batch->count; i++) {
        float *restrict out = batch->out + (size_t)i * (size_t)count;
        const float u = batch->u[i];
        const float v = batch->v[i];
        const float weight[4] = {(1.0f - u) * (1.0f - v), u * (1.0f - v), u * v, (1.0f - u) * v};
        for (int k = 0; k < count; k++) {
            out[k] = control[0][k] * weight[0] + control[1][k] * weight[1] +
                     control[2][k] * weight[2] + control[3][k] * weight[3];
        }
    }
}

void dip_domain_linear(const DipDomainBatch *batch) {
    DIP_FP_MODE_SCOPE();
    if (batch->w) {
        interpolate_triangle(batch);
    } else {
        interpolate_quad(batch);
    }
}
