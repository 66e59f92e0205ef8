// Evaluates animated models at a time: key frames, tracks of nodes, morph weights and joints.
//
// The formulas of tracks are those of the glTF 2.0 specification, appendix C. Everything is
// computed in double precision with operations that have the same bits on every machine.
#include "assets/animation.h"

#include "assets/animation/animation_parts.h"
#include "renderer/base/assert.h"
#include "renderer/base/fp_mode.h"
#include "renderer/base/trig.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float max_blend = 0x1.fffffep-1f; // The greatest float below 1.

// The translation, rotation and scale of a node.
typedef struct NodeState {
    double translation[3];
    double rotation[4];
    double scale[3];
} NodeState;

struct DipAnimatedPose {
    const DipAnimatedModel *model;
    NodeState *states;     // One for each node.
    double (*global)[12];  // The world transform of each node: rows of a 3x4 matrix.
    double *morph_weights; // Those of all nodes.
    DipObjectPose *objects;
    float *shape_weights; // Those of all objects.
    float *joints;        // The matrices of all objects.
};

// --- matrices ------------------------------------------------------------------------------------

void dip_animated_multiply(const double a[12], const double b[12], double to[12]) {
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            double sum = column == 3 ? a[4 * row + 3] : 0.0;
            for (int k = 0; k < 3; ++k) {
                sum += a[4 * row + k] * b[4 * k + column];
            }
            to[4 * row + column] = sum;
        }
    }
}

// Makes the matrix of translation * rotation * scale.
static void compose(const NodeState *state, double to[12]) {
    const double x = state->rotation[0];
    const double y = state->rotation[1];
    const double z = state->rotation[2];
    const double w = state->rotation[3];
    const double rotation[3][3] = {
        {1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
        {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
        {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            to[4 * row + column] = rotation[row][column] * state->scale[column];
        }
        to[4 * row + 3] = state->translation[row];
    }
}

static void to_floats(const double *from, int count, float *to) {
    for (int i = 0; i < count; ++i) {
        to[i] = (float)from[i];
    }
}

static void normalise_rotation(double q[4]) {
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const bool usable = isfinite(length) && length > 0.0;
    for (int i = 0; i < 4; ++i) {
        q[i] = usable ? q[i] / length : i == 3;
    }
}

// --- tracks --------------------------------------------------------------------------------------

// Where a time lies among the keys of a track.
typedef struct Place {
    uint32_t key;    // The last key that is not after the time, or 0.
    bool between;    // True if there is a key after it and the time is not before the first key.
    double fraction; // 0..1 from this key to the next.
    double seconds;  // From this key to the next.
} Place;

static Place find_place(const DipTrack *track, double time_s) {
    uint32_t low = 0;
    uint32_t high = track->key_count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (track->times[middle] <= time_s) {
            low = middle;
        } else {
            high = middle;
        }
    }
    Place place = {.key = low};
    place.between = time_s > track->times[low] && low + 1 < track->key_count;
    if (place.between) {
        place.seconds = (double)track->times[low + 1] - track->times[low];
        place.fraction = (time_s - track->times[low]) / place.seconds;
    }
    return place;
}

// Returns the value of a key: with CUBICSPLINE the second of its three.
static const float *value_of(const DipTrack *track, uint32_t key) {
    const bool spline = track->interpolation == DIP_INTERPOLATION_CUBICSPLINE;
    const size_t index = spline ? 3 * (size_t)key + 1 : key;
    return track->values + index * (size_t)track->width;
}

static double lerp(double a, double b, double u) {
    return a + u * (b - a);
}

// Rotates from a to b along the shorter way. The angle is computed from chords, because acos of the
// dot product loses half its digits at small angles.
static void slerp(const float *a, const float *b, double u, double *to) {
    double dot = 0.0;
    double apart = 0.0;
    double along = 0.0;
    for (int i = 0; i < 4; ++i) {
        dot += (double)a[i] * b[i];
    }
    const double sign = dot < 0.0 ? -1.0 : 1.0;
    for (int i = 0; i < 4; ++i) {
        apart += (a[i] - sign * b[i]) * (a[i] - sign * b[i]);
        along += (a[i] + sign * b[i]) * (a[i] + sign * b[i]);
    }
    const double angle = 2.0 * dip_atan2(sqrt(apart), sqrt(along));
    double from = 1.0 - u;
    double towards = u;
    if (angle > 1e-6) { // At smaller angles, the two ways differ by less than 1e-18.
        const double sine = dip_sin(angle);
        from = dip_sin((1.0 - u) * angle) / sine;
        towards = dip_sin(u * angle) / sine;
    }
    for (int i = 0; i < 4; ++i) {
        to[i] = from * a[i] + towards * sign * b[i];
    }
}

// The cubic Hermite spline between two keys. Tangents are per second.
static double spline(const DipTrack *track, const Place *place, int component) {
    const float *value = value_of(track, place->key) + component;
    const float *next = value_of(track, place->key + 1) + component;
    const double u = place->fraction;
    const double u2 = u * u;
    const double u3 = u2 * u;
    const double out_tangent = place->seconds * value[track->width];
    const double in_tangent = place->seconds * next[-track->width];
    return (2 * u3 - 3 * u2 + 1) * *value + (u3 - 2 * u2 + u) * out_tangent +
           (3 * u2 - 2 * u3) * *next + (u3 - u2) * in_tangent;
}

// Writes the value of a track: `width` numbers. A rotation may have any length.
static void sample(const DipTrack *track, double time_s, double *to) {
    const Place place = find_place(track, time_s);
    const float *value = value_of(track, place.key);
    const bool changes = place.between && track->interpolation != DIP_INTERPOLATION_STEP;
    const bool linear = track->interpolation == DIP_INTERPOLATION_LINEAR;
    if (changes && linear && track->target == DIP_TRACK_ROTATION) {
        slerp(value, value_of(track, place.key + 1), place.fraction, to);
        return;
    }
    for (int i = 0; i < track->width; ++i) {
        to[i] = value[i];
        if (changes) {
            const float *next = value_of(track, place.key + 1);
            to[i] = linear ? lerp(value[i], next[i], place.fraction) : spline(track, &place, i);
        }
    }
}

static void move_node(NodeState *state, const DipTrack *track, double time_s) {
    double *const values[] = {[DIP_TRACK_TRANSLATION] = state->translation,
                              [DIP_TRACK_ROTATION] = state->rotation,
                              [DIP_TRACK_SCALE] = state->scale};
    if (track->target != DIP_TRACK_WEIGHTS) {
        sample(track, time_s, values[track->target]);
    }
}

static void apply_track(DipAnimatedPose *pose, const DipTrack *track, double time_s) {
    if (track->target == DIP_TRACK_WEIGHTS) {
        sample(track, time_s, pose->morph_weights + pose->model->nodes[track->node].first_weight);
    } else {
        move_node(&pose->states[track->node], track, time_s);
    }
}

// --- poses ---------------------------------------------------------------------------------------

static void rest_node(const DipAnimatedNode *node, NodeState *state) {
    memcpy(state->translation, node->translation, sizeof state->translation);
    memcpy(state->rotation, node->rotation, sizeof state->rotation);
    memcpy(state->scale, node->scale, sizeof state->scale);
}

static void rest(DipAnimatedPose *pose) {
    const DipAnimatedModel *model = pose->model;
    for (int i = 0; i < model->node_count; ++i) {
        rest_node(&model->nodes[i], &pose->states[i]);
    }
    for (int i = 0; i < model->weight_count; ++i) {
        pose->morph_weights[i] = model->rest_weights[i];
    }
}

// Computes the transform of a node relative to its parent. Normalises the state's rotation.
static void place_locally(const DipAnimatedNode *node, NodeState *state, double local[12]) {
    normalise_rotation(state->rotation);
    compose(state, local);
    if (node->has_matrix) {
        memcpy(local, node->matrix, sizeof node->matrix);
    }
}

void dip_animated_local(const DipAnimatedNode *node, double local[12]) {
    NodeState state;
    rest_node(node, &state);
    place_locally(node, &state, local);
}

void dip_animated_place_node(const DipAnimatedModel *model, const DipAnimationPlan *plan, int node,
                             double time_s, double world[12]) {
    static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    memcpy(world, identity, sizeof identity);
    for (int at = node; at != DIP_NO_NODE; at = model->nodes[at].parent) {
        NodeState state;
        double local[12];
        double below[12];
        rest_node(&model->nodes[at], &state);
        for (int i = 0; i < plan->track_count; ++i) {
            if (plan->tracks[i].node == at) {
                move_node(&state, &plan->tracks[i], time_s);
            }
        }
        place_locally(&model->nodes[at], &state, local);
        memcpy(below, world, sizeof below);
        dip_animated_multiply(local, below, world);
    }
}

// Computes the world transforms. A node comes after its parent.
static void place_nodes(DipAnimatedPose *pose) {
    for (int i = 0; i < pose->model->node_count; ++i) {
        const DipAnimatedNode *node = &pose->model->nodes[i];
        double local[12];
        place_locally(node, &pose->states[i], local);
        if (node->parent == DIP_NO_NODE) {
            memcpy(pose->global[i], local, sizeof local);
        } else {
            dip_animated_multiply(pose->global[node->parent], local, pose->global[i]);
        }
    }
}

static void place_joints(DipAnimatedPose *pose, const DipAnimatedSkin *skin, float *to) {
    for (int j = 0; j < skin->joint_count; ++j) {
        double joint[12];
        dip_animated_multiply(pose->global[skin->nodes[j]], skin->inverse_binds + 12 * (size_t)j,
                              joint);
        to_floats(joint, 12, to + 12 * (size_t)j);
    }
}

// Skinned objects are placed by their joints alone, as glTF demands.
static void place_object(DipAnimatedPose *pose, int index) {
    static const float identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    const DipAnimatedModel *model = pose->model;
    const DipObjectPlan *plan = &model->plans[index];
    DipObjectPose *object = &pose->objects[index];
    if (plan->skin == DIP_NO_SKIN) {
        to_floats(pose->global[plan->node], 12, object->transform);
    } else {
        memcpy(object->transform, identity, sizeof identity);
        place_joints(pose, &model->skins[plan->skin], (float *)object->joint_transforms);
    }
}

// Sets the weights of the shapes from the node's morph weights.
static void morph(DipAnimatedPose *pose, int index) {
    const DipAnimatedModel *model = pose->model;
    const DipAnimatedNode *node = &model->nodes[model->plans[index].node];
    float *weights = (float *)pose->objects[index].weights;
    weights[0] = 1.0f;
    to_floats(pose->morph_weights + node->first_weight, node->weight_count, weights + 1);
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

// Returns the time within an animation that repeats.
static double wrap_time(double time_s, double duration_s) {
    if (!isfinite(time_s) || !(duration_s > 0.0)) {
        return 0.0;
    }
    const double wrapped = time_s - floor(time_s / duration_s) * duration_s;
    return wrapped > 0.0 && wrapped < duration_s ? wrapped : 0.0;
}

void dip_animated_pose_set(DipAnimatedPose *pose, int animation, double time_s) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(time_s);
    const DipAnimatedModel *model = pose->model;
    const bool moves = model->def.animation_count > 0;
    DIP_ASSERT(!moves || (animation >= 0 && animation < model->def.animation_count));
    const double at_s = moves ? wrap_time(time_s, model->animations[animation].duration_s) : 0.0;
    rest(pose);
    for (int i = 0; moves && i < model->animation_plans[animation].track_count; ++i) {
        apply_track(pose, &model->animation_plans[animation].tracks[i], at_s);
    }
    place_nodes(pose);
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
    const size_t nodes = (size_t)model->node_count;
    pose->states = calloc(nodes + 1, sizeof *pose->states);
    pose->global = calloc(nodes + 1, sizeof *pose->global);
    pose->morph_weights = calloc((size_t)model->weight_count + 1, sizeof *pose->morph_weights);
    pose->objects = calloc((size_t)model->def.object_count + 1, sizeof *pose->objects);
    pose->shape_weights = calloc(shapes + 1, sizeof *pose->shape_weights);
    pose->joints = calloc(joints + 1, 12 * sizeof *pose->joints);
    return pose->states && pose->global && pose->morph_weights && pose->objects &&
           pose->shape_weights && pose->joints;
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
    void *const arrays[] = {pose->states,  pose->global,        pose->morph_weights,
                            pose->objects, pose->shape_weights, pose->joints};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; ++i) {
        free(arrays[i]);
    }
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
