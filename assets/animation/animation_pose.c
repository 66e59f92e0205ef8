// Evaluates animated models at a time: key frames, morph weights and joints. The rig of nodes is
// evaluated by renderer/scene/rig.h.
//
// Everything is computed in double precision with operations that have the same bits on every
// machine.
#include "assets/animation.h"

#include "assets/animation/animation_parts.h"
#include "renderer/base/assert.h"
#include "renderer/base/fp_mode.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float max_blend = 0x1.fffffep-1f; // The greatest float below 1.

struct DipAnimatedPose {
    const DipAnimatedModel *model;
    DipRigPose *rig;
    DipObjectPose *objects;
    float *shape_weights; // Those of all objects.
    float *joints;        // The matrices of all objects.
};

static void to_floats(const double *from, int count, float *to) {
    for (int i = 0; i < count; ++i) {
        to[i] = (float)from[i];
    }
}

// --- poses ---------------------------------------------------------------------------------------

// Skinned objects are placed by their joints alone, as glTF demands.
static void place_object(DipAnimatedPose *pose, int index) {
    static const float identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    const DipAnimatedModel *model = pose->model;
    const DipObjectPlan *plan = &model->plans[index];
    DipObjectPose *object = &pose->objects[index];
    if (plan->skin == DIP_NO_SKIN) {
        to_floats(dip_rig_pose_world(pose->rig, plan->node), 12, object->transform);
    } else {
        memcpy(object->transform, identity, sizeof identity);
        dip_rig_pose_joints(pose->rig, &model->skins[plan->skin],
                            (float *)object->joint_transforms);
    }
}

// Sets the weights of the shapes from the node's morph weights.
static void morph(DipAnimatedPose *pose, int index) {
    const DipAnimatedModel *model = pose->model;
    const int node = model->plans[index].node;
    float *weights = (float *)pose->objects[index].weights;
    weights[0] = 1.0f;
    to_floats(dip_rig_pose_weights(pose->rig, node), model->nodes[node].weight_count, weights + 1);
}

// Blends the two key frames around the time. time_s: 0 up to the animation's end.
static void blend_frames(DipAnimatedPose *pose, int animation, double time_s) {
    const DipAnimationPlan *plan = &pose->model->animation_plans[animation];
    const double frames =
        time_s / pose->model->animations[animation].duration_s * plan->frame_count;
    const int whole = (int)frames < plan->frame_count ? (int)frames : plan->frame_count - 1;
    DipObjectPose *object = &pose->objects[0];
    float *weights = (float *)object->weights;
    weights[object->key_frame] = 0.0f;
    weights[object->next_key_frame] = 0.0f;
    object->key_frame = plan->first_frame + whole;
    object->next_key_frame = plan->first_frame + (whole + 1) % plan->frame_count;
    object->blend = plan->frame_count > 1 ? fminf((float)(frames - whole), max_blend) : 0.0f;
    weights[object->next_key_frame] = object->blend;
    weights[object->key_frame] = 1.0f - object->blend;
}

void dip_animated_pose_set(DipAnimatedPose *pose, int animation, double time_s) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(time_s);
    const DipAnimatedModel *model = pose->model;
    const bool moves = model->def.animation_count > 0;
    DIP_ASSERT(!moves || (animation >= 0 && animation < model->def.animation_count));
    const DipAnimationPlan *plan = moves ? &model->animation_plans[animation] : NULL;
    const double at_s =
        moves ? dip_rig_wrap_time(time_s, model->animations[animation].duration_s) : 0.0;
    dip_rig_pose_set(pose->rig, moves ? plan->tracks : NULL, moves ? plan->track_count : 0, at_s);
    for (int i = 0; i < model->def.object_count; ++i) {
        place_object(pose, i);
        if (model->def.key_frame_count == 0) {
            morph(pose, i);
        }
    }
    if (model->def.key_frame_count > 0) {
        blend_frames(pose, animation, at_s);
    }
}

// --- creating and destroying ---------------------------------------------------------------------

// Gives each object its part of the arrays of weights and matrices.
static void share_arrays(DipAnimatedPose *pose) {
    const DipAnimatedDef *def = &pose->model->def;
    float *weights = pose->shape_weights;
    float *joints = pose->joints;
    for (int i = 0; i < def->object_count; ++i) {
        const DipAnimatedObject *object = &def->objects[i];
        pose->objects[i].weights = weights;
        pose->objects[i].joint_transforms = object->joint_count > 0 ? joints : NULL;
        weights += def->meshes[object->mesh].shape_count;
        joints += 12 * (size_t)object->joint_count;
    }
}

static bool allocate(DipAnimatedPose *pose) {
    const DipAnimatedModel *model = pose->model;
    size_t shapes = 0;
    size_t joints = 0;
    for (int i = 0; i < model->def.object_count; ++i) {
        const DipAnimatedObject *object = &model->objects[i];
        shapes += (size_t)model->meshes[object->mesh].shape_count;
        joints += (size_t)object->joint_count;
    }
    const DipRig rig = dip_animated_rig(model);
    pose->rig = dip_rig_pose_create(&rig);
    pose->objects = calloc((size_t)model->def.object_count + 1, sizeof *pose->objects);
    pose->shape_weights = calloc(shapes + 1, sizeof *pose->shape_weights);
    pose->joints = calloc(joints + 1, 12 * sizeof *pose->joints);
    return pose->rig && pose->objects && pose->shape_weights && pose->joints;
}

DipAnimatedPose *dip_animated_pose_create(const DipAnimatedModel *model, DipError *err) {
    DIP_FP_MODE_SCOPE();
    DipAnimatedPose *pose = calloc(1, sizeof *pose);
    if (pose) {
        pose->model = model;
    }
    if (!pose || !allocate(pose)) {
        dip_animated_pose_destroy(&pose);
        dip_model_out_of_memory(err, model->path);
        return NULL;
    }
    share_arrays(pose);
    dip_animated_pose_set(pose, 0, 0.0);
    return pose;
}

void dip_animated_pose_destroy(DipAnimatedPose **pose_pointer) {
    DipAnimatedPose *pose = *pose_pointer;
    if (!pose) {
        return;
    }
    *pose_pointer = NULL;
    dip_rig_pose_destroy(&pose->rig);
    free(pose->objects);
    free(pose->shape_weights);
    free(pose->joints);
    free(pose);
}

const DipObjectPose *dip_animated_pose_object(const DipAnimatedPose *pose, int object) {
    DIP_ASSERT(object >= 0 && object < pose->model->def.object_count);
    return &pose->objects[object];
}

// --- vertices ------------------------------------------------------------------------------------

// Writes the weighted sum over the shapes of a vertex's position or normal.
static void mix_shapes(const DipAnimatedMesh *mesh, const float *values, const float *weights,
                       uint32_t vertex, double to[3]) {
    to[0] = to[1] = to[2] = 0.0;
    for (int s = 0; s < mesh->shape_count; ++s) {
        if (weights[s] != 0.0f) {
            const float *v = values + 3 * ((size_t)s * mesh->vertex_count + vertex);
            for (int i = 0; i < 3; ++i) {
                to[i] += (double)weights[s] * v[i];
            }
        }
    }
}

// Moves a vector by the joints of a vertex. w: 1 for a position, 0 for a direction.
static void move_by_joints(const DipAnimatedMesh *mesh, const float *matrices, uint32_t vertex,
                           double w, double v[3]) {
    double sum[3] = {0.0, 0.0, 0.0};
    for (size_t k = 4 * (size_t)vertex; k < 4 * (size_t)vertex + 4; ++k) {
        const double weight = mesh->joint_weights[k];
        const float *m = matrices + 12 * (size_t)mesh->joints[k];
        for (int row = 0; weight != 0.0 && row < 3; ++row) {
            const float *r = m + 4 * row;
            sum[row] += weight * (r[0] * v[0] + r[1] * v[1] + r[2] * v[2] + r[3] * w);
        }
    }
    memcpy(v, sum, sizeof sum);
}

void dip_animated_pose_vertices(const DipAnimatedPose *pose, int object, float *positions,
                                float *normals) {
    DIP_FP_MODE_SCOPE();
    const DipAnimatedMesh *mesh = &pose->model->meshes[pose->model->objects[object].mesh];
    const DipObjectPose *posed = dip_animated_pose_object(pose, object);
    for (uint32_t i = 0; i < mesh->vertex_count; ++i) {
        double v[3];
        mix_shapes(mesh, mesh->positions, posed->weights, i, v);
        if (posed->joint_transforms) {
            move_by_joints(mesh, posed->joint_transforms, i, 1.0, v);
        }
        to_floats(v, 3, positions + 3 * (size_t)i);
        if (!normals) {
            continue;
        }
        mix_shapes(mesh, mesh->normals, posed->weights, i, v);
        if (posed->joint_transforms) {
            move_by_joints(mesh, posed->joint_transforms, i, 0.0, v);
        }
        dip_model_unit_normal(v, normals + 3 * (size_t)i);
    }
}
