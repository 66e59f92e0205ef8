// Evaluates rigs: tracks, and the nodes that they move.
#include "renderer/scene/rig.h"

#include "renderer/base/fp_mode.h"
#include "renderer/base/trig.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// The translation, rotation and scale of a node.
typedef struct NodeState {
    double translation[3];
    double rotation[4];
    double scale[3];
} NodeState;

struct DipRigPose {
    DipRig rig;
    NodeState *states;   // One for each node.
    double (*world)[12]; // The world transform of each node.
    double *weights;     // The morph weights of all nodes.
};

size_t dip_track_value_count(const DipTrack *track) {
    const size_t each = track->interpolation == DIP_INTERPOLATION_CUBICSPLINE ? 3 : 1;
    return each * track->key_count * (size_t)track->width;
}

// --- matrices ------------------------------------------------------------------------------------

static void multiply(const double a[12], const double b[12], double to[12]) {
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

void dip_rig_multiply(const double a[12], const double b[12], double to[12]) {
    DIP_FP_MODE_SCOPE();
    multiply(a, b, to);
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

static void apply_track(DipRigPose *pose, const DipTrack *track, double time_s) {
    if (track->target == DIP_TRACK_WEIGHTS) {
        sample(track, time_s, pose->weights + pose->rig.nodes[track->node].first_weight);
    } else {
        move_node(&pose->states[track->node], track, time_s);
    }
}

// --- poses ---------------------------------------------------------------------------------------

static void rest_node(const DipRigNode *node, NodeState *state) {
    memcpy(state->translation, node->translation, sizeof state->translation);
    memcpy(state->rotation, node->rotation, sizeof state->rotation);
    memcpy(state->scale, node->scale, sizeof state->scale);
}

static void rest(DipRigPose *pose) {
    for (int i = 0; i < pose->rig.node_count; ++i) {
        rest_node(&pose->rig.nodes[i], &pose->states[i]);
    }
    for (int i = 0; i < pose->rig.weight_count; ++i) {
        pose->weights[i] = pose->rig.rest_weights[i];
    }
}

// Computes the transform of a node relative to its parent. Normalises the state's rotation.
static void place_locally(const DipRigNode *node, NodeState *state, double local[12]) {
    normalise_rotation(state->rotation);
    compose(state, local);
    if (node->has_matrix) {
        memcpy(local, node->matrix, sizeof node->matrix);
    }
}

void dip_rig_local(const DipRigNode *node, double local[12]) {
    DIP_FP_MODE_SCOPE();
    NodeState state;
    rest_node(node, &state);
    place_locally(node, &state, local);
}

void dip_rig_place_node(const DipRig *rig, const DipTrack *tracks, int track_count, int node,
                        double time_s, double world[12]) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(time_s);
    static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    memcpy(world, identity, sizeof identity);
    for (int at = node; at != DIP_NO_NODE; at = rig->nodes[at].parent) {
        NodeState state;
        double local[12];
        double below[12];
        rest_node(&rig->nodes[at], &state);
        for (int i = 0; i < track_count; ++i) {
            if (tracks[i].node == at) {
                move_node(&state, &tracks[i], time_s);
            }
        }
        place_locally(&rig->nodes[at], &state, local);
        memcpy(below, world, sizeof below);
        multiply(local, below, world);
    }
}

// Computes the world transforms. A node comes after its parent.
static void place_nodes(DipRigPose *pose) {
    for (int i = 0; i < pose->rig.node_count; ++i) {
        const DipRigNode *node = &pose->rig.nodes[i];
        double local[12];
        place_locally(node, &pose->states[i], local);
        if (node->parent == DIP_NO_NODE) {
            memcpy(pose->world[i], local, sizeof local);
        } else {
            multiply(pose->world[node->parent], local, pose->world[i]);
        }
    }
}

double dip_rig_wrap_time(double time_s, double duration_s) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(time_s);
    DIP_FP_PIN(duration_s);
    double wrapped = 0.0;
    if (isfinite(time_s) && duration_s > 0.0) {
        wrapped = time_s - floor(time_s / duration_s) * duration_s;
        wrapped = wrapped > 0.0 && wrapped < duration_s ? wrapped : 0.0;
    }
    DIP_FP_PIN(wrapped);
    return wrapped;
}

void dip_rig_pose_set(DipRigPose *pose, const DipTrack *tracks, int track_count, double time_s) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(time_s);
    rest(pose);
    for (int i = 0; i < track_count; ++i) {
        apply_track(pose, &tracks[i], time_s);
    }
    place_nodes(pose);
}

DipRigPose *dip_rig_pose_create(const DipRig *rig) {
    DipRigPose *pose = calloc(1, sizeof *pose);
    if (!pose) {
        return NULL;
    }
    pose->rig = *rig;
    pose->states = calloc((size_t)rig->node_count + 1, sizeof *pose->states);
    pose->world = calloc((size_t)rig->node_count + 1, sizeof *pose->world);
    pose->weights = calloc((size_t)rig->weight_count + 1, sizeof *pose->weights);
    if (!pose->states || !pose->world || !pose->weights) {
        dip_rig_pose_destroy(&pose);
        return NULL;
    }
    dip_rig_pose_set(pose, NULL, 0, 0.0);
    return pose;
}

void dip_rig_pose_destroy(DipRigPose **pose) {
    if (*pose) {
        free((*pose)->states);
        free((*pose)->world);
        free((*pose)->weights);
        free(*pose);
        *pose = NULL;
    }
}

const double *dip_rig_pose_world(const DipRigPose *pose, int node) {
    return pose->world[node];
}

const double *dip_rig_pose_weights(const DipRigPose *pose, int node) {
    return pose->weights + pose->rig.nodes[node].first_weight;
}

void dip_rig_pose_joints(const DipRigPose *pose, const DipRigSkin *skin, float *to) {
    DIP_FP_MODE_SCOPE();
    for (int j = 0; j < skin->joint_count; ++j) {
        double joint[12];
        multiply(pose->world[skin->nodes[j]], skin->inverse_binds + 12 * (size_t)j, joint);
        for (int i = 0; i < 12; ++i) {
            to[12 * (size_t)j + (size_t)i] = (float)joint[i];
        }
    }
}
