// The bounds of a model and what follows from them.
#include "assets/model_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Distance of the near plane as a fraction of the model's diagonal. Depth is reversed and has no
// far plane, so a small distance costs no precision.
static const double near_fraction = 1e-4;

// Writes the box of a mesh: least x, y and z, and then greatest x, y and z.
static void bound_mesh(const DipMeshDef *mesh, float box[6]) {
    for (int axis = 0; axis < 3; ++axis) {
        box[axis] = INFINITY;
        box[3 + axis] = -INFINITY;
        for (uint32_t i = 0; i < mesh->vertex_count; ++i) {
            const float p = mesh->positions[3 * (size_t)i + (size_t)axis];
            box[axis] = fminf(box[axis], p);
            box[3 + axis] = fmaxf(box[3 + axis], p);
        }
    }
}

static void extend_bounds(DipModelBounds *bounds, const float box[6], const float transform[12]) {
    for (int corner = 0; corner < 8; ++corner) {
        for (int axis = 0; axis < 3; ++axis) {
            double p = transform[4 * axis + 3];
            for (int k = 0; k < 3; ++k) {
                p += (double)transform[4 * axis + k] * box[(corner >> k & 1) ? 3 + k : k];
            }
            bounds->low[axis] = fmin(bounds->low[axis], p);
            bounds->high[axis] = fmax(bounds->high[axis], p);
        }
    }
}

// Extends the bounds by all objects that are not sky. pose: a moment of the motion, or NULL.
// boxes: those of all meshes.
static void extend_by_scene(DipModelBounds *bounds, const DipSceneDef *def,
                            const DipMotionPose *pose, const float (*boxes)[6]) {
    const DipMotionDef *motion = def->motion;
    int moving = 0;
    for (int i = 0; i < def->object_count; ++i) {
        const DipObjectDef *object = &def->objects[i];
        float transform[12];
        memcpy(transform, object->transform, sizeof transform);
        if (pose && moving < motion->object_count && motion->objects[moving].object == i) {
            dip_motion_pose_transform(pose, moving++, transform);
        }
        if (def->materials[def->meshes[object->mesh].material].surface != DIP_SURFACE_SKY) {
            extend_bounds(bounds, boxes[object->mesh], transform);
        }
    }
}

bool dip_model_bounds(const DipModel *model, DipModelBounds *to) {
    DipModelBounds bounds = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, 0};
    const DipSceneDef *def = &model->def;
    const DipMotionDef *motion = def->motion;
    DipMotionPose *pose = motion ? dip_motion_pose_create(motion) : NULL;
    float(*boxes)[6] = calloc((size_t)def->mesh_count + 1, sizeof *boxes);
    const bool made = boxes && (pose || !motion);
    for (int m = 0; made && m < def->mesh_count; ++m) {
        bound_mesh(&def->meshes[m], boxes[m]);
    }
    for (int m = 0; made && motion && m < motion->mesh_count; ++m) {
        if (motion->meshes[m].box) {
            memcpy(boxes[motion->meshes[m].mesh], motion->meshes[m].box, sizeof *boxes);
        }
    }
    for (int k = 0; made && k < (pose ? DIP_MOTION_MOMENTS : 1); ++k) {
        if (pose) {
            dip_motion_pose_set_share(pose, (double)k / DIP_MOTION_MOMENTS);
        }
        extend_by_scene(&bounds, def, pose, (const float(*)[6])boxes);
    }
    dip_motion_pose_destroy(&pose);
    free(boxes);
    double square = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double size = bounds.high[axis] - bounds.low[axis];
        square += size * size;
    }
    bounds.diagonal = sqrt(square);
    *to = bounds;
    return made;
}

float dip_model_near_distance(const DipModelBounds *bounds) {
    const double near_m = near_fraction * bounds->diagonal;
    return isfinite(near_m)
               ? (float)fmin(fmax(near_m, (double)DIP_MIN_NEAR_M), (double)DIP_MAX_NEAR_M)
               : 0.01f;
}
