// The bounds of a model and what follows from them.
#include "assets/model_parts.h"

#include <math.h>

// Distance of the near plane as a fraction of the model's diagonal. Depth is reversed and has no
// far plane, so a small distance costs no precision.
static const double near_fraction = 1e-4;

static void extend_bounds(DipModelBounds *bounds, const DipMeshDef *mesh,
                          const float transform[12]) {
    float mesh_low[3] = {INFINITY, INFINITY, INFINITY};
    float mesh_high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t i = 0; i < mesh->vertex_count; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const float p = mesh->positions[3 * (size_t)i + (size_t)axis];
            mesh_low[axis] = fminf(mesh_low[axis], p);
            mesh_high[axis] = fmaxf(mesh_high[axis], p);
        }
    }
    for (int corner = 0; corner < 8; ++corner) {
        for (int axis = 0; axis < 3; ++axis) {
            double p = transform[4 * axis + 3];
            for (int k = 0; k < 3; ++k) {
                p += (double)transform[4 * axis + k] *
                     ((corner >> k & 1) ? mesh_high[k] : mesh_low[k]);
            }
            bounds->low[axis] = fmin(bounds->low[axis], p);
            bounds->high[axis] = fmax(bounds->high[axis], p);
        }
    }
}

// Extends the bounds by all objects that are not sky.
static void extend_by_scene(DipModelBounds *bounds, const DipSceneDef *def) {
    for (int i = 0; i < def->object_count; ++i) {
        const DipMeshDef *mesh = &def->meshes[def->objects[i].mesh];
        if (def->materials[mesh->material].surface != DIP_SURFACE_SKY) {
            extend_bounds(bounds, mesh, def->objects[i].transform);
        }
    }
}

bool dip_model_bounds(const DipModel *model, DipModelBounds *to, DipError *err) {
    DipModelBounds bounds = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, 0};
    DipPosedDef *posed = model->def.motion ? dip_posed_def_create(&model->def, err) : NULL;
    if (model->def.motion && !posed) {
        return false;
    }
    for (int k = 0; posed && k < DIP_MOTION_MOMENTS; ++k) {
        dip_posed_def_set_share(posed, (double)k / DIP_MOTION_MOMENTS);
        extend_by_scene(&bounds, dip_posed_def(posed));
    }
    if (!posed) {
        extend_by_scene(&bounds, &model->def);
    }
    dip_posed_def_destroy(&posed);
    double square = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double size = bounds.high[axis] - bounds.low[axis];
        square += size * size;
    }
    bounds.diagonal = sqrt(square);
    *to = bounds;
    return true;
}

float dip_model_near_distance(const DipModelBounds *bounds) {
    const double near_m = near_fraction * bounds->diagonal;
    return isfinite(near_m)
               ? (float)fmin(fmax(near_m, (double)DIP_MIN_NEAR_M), (double)DIP_MAX_NEAR_M)
               : 0.01f;
}
