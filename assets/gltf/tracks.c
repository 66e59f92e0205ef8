// Reads the animations of glTF models.
#include "assets/gltf/reader.h"

#include <cjson/cJSON.h>

#include <math.h>
#include <string.h>

// The samplers of an animation, which its channels name.
typedef struct Samplers {
    DipGltfReader *reader;
    DipGltfItems items;
} Samplers;

static bool read_interpolation(const DipGltf *gltf, const cJSON *sampler,
                               DipInterpolation *interpolation) {
    static const char *const names[] = {"STEP", "LINEAR", "CUBICSPLINE"};
    const cJSON *json = cJSON_GetObjectItemCaseSensitive(sampler, "interpolation");
    *interpolation = DIP_INTERPOLATION_LINEAR;
    if (!json) {
        return true;
    }
    for (int i = 0; cJSON_IsString(json) && i <= DIP_INTERPOLATION_CUBICSPLINE; ++i) {
        if (strcmp(json->valuestring, names[i]) == 0) {
            *interpolation = (DipInterpolation)i;
            return true;
        }
    }
    return dip_gltf_refuse(gltf, DIP_ERROR_UNKNOWN, "interpolation",
                           "the interpolation is not known, accepted STEP, LINEAR and CUBICSPLINE");
}

// Reads the times of the keys, which must ascend.
static bool read_times(DipGltfReader *reader, int index, DipTrack *track) {
    DipGltfAccessor accessor;
    if (!dip_gltf_accessor(&reader->gltf, index, 1, "input", &accessor)) {
        return false;
    }
    float *times = dip_gltf_alloc(reader, accessor.count, sizeof *times);
    if (!times) {
        return dip_gltf_no_room(reader);
    }
    if (!dip_gltf_floats(&reader->gltf, &accessor, "input", times)) {
        return false;
    }
    for (uint32_t i = 0; i < accessor.count; ++i) {
        if (times[i] < 0.0f || (i > 0 && times[i] <= times[i - 1])) {
            return dip_gltf_refuse(&reader->gltf, DIP_ERROR_RANGE, "input",
                                   "the times of an animation do not ascend from 0 at key %u", i);
        }
    }
    track->times = times;
    track->key_count = accessor.count;
    return true;
}

// Makes quaternions unit vectors.
static void normalise_rotations(float *values, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) {
        float *q = values + 4 * (size_t)i;
        const double length = sqrt((double)q[0] * q[0] + (double)q[1] * q[1] + (double)q[2] * q[2] +
                                   (double)q[3] * q[3]);
        for (int k = 0; k < 4; ++k) {
            q[k] = length > 0.0 ? (float)(q[k] / length) : k == 3;
        }
    }
}

static bool read_values(DipGltfReader *reader, int index, DipTrack *track) {
    const bool is_weights = track->target == DIP_TRACK_WEIGHTS;
    const bool is_spline = track->interpolation == DIP_INTERPOLATION_CUBICSPLINE;
    DipGltfAccessor accessor;
    if (!dip_gltf_accessor(&reader->gltf, index, is_weights ? 1 : track->width, "output",
                           &accessor)) {
        return false;
    }
    const uint64_t values = (uint64_t)track->key_count * (is_spline ? 3 : 1) *
                            (is_weights ? (uint64_t)track->width : 1);
    if (accessor.count != values) {
        return dip_gltf_refuse(&reader->gltf, DIP_ERROR_RANGE, "output",
                               "an animation has %u values for %u keys, expected %llu",
                               accessor.count, track->key_count, (unsigned long long)values);
    }
    float *floats = dip_gltf_alloc(reader, accessor.count, (size_t)accessor.width * sizeof *floats);
    if (!floats) {
        return dip_gltf_no_room(reader);
    }
    track->values = floats;
    if (!dip_gltf_floats(&reader->gltf, &accessor, "output", floats)) {
        return false;
    }
    if (track->target == DIP_TRACK_ROTATION && !is_spline) {
        normalise_rotations(floats, track->key_count);
    }
    return true;
}

// Finds out what a channel moves. *used becomes false if it moves nothing that Diptych knows.
static bool read_target(DipGltfReader *reader, const cJSON *channel, DipTrack *track, bool *used) {
    static const char *const paths[] = {"translation", "rotation", "scale", "weights"};
    static const int widths[] = {3, 4, 3, 0};
    const cJSON *target = cJSON_GetObjectItemCaseSensitive(channel, "target");
    const cJSON *path = cJSON_GetObjectItemCaseSensitive(target, "path");
    int node;
    *used = false;
    if (!dip_gltf_integer(&reader->gltf, target, "node", -1, &node)) {
        return false;
    }
    if (node < 0) {
        return true;
    }
    if (!dip_gltf_item(&reader->gltf, DIP_GLTF_nodes, node)) {
        return false;
    }
    track->node = reader->node_of[node];
    for (int i = 0; cJSON_IsString(path) && i <= DIP_TRACK_WEIGHTS; ++i) {
        if (strcmp(path->valuestring, paths[i]) == 0) {
            const DipRigNode *moved = &reader->model->nodes[track->node];
            track->target = (DipTrackTarget)i;
            track->width = i == DIP_TRACK_WEIGHTS ? moved->weight_count : widths[i];
            *used = track->width > 0;
            return i == DIP_TRACK_WEIGHTS || !moved->has_matrix ||
                   dip_gltf_refuse(&reader->gltf, DIP_ERROR_FORMAT, "channels",
                                   "an animation moves node %d, which has a matrix", node);
        }
    }
    return true;
}

static bool read_channel(const Samplers *samplers, const cJSON *channel, DipAnimationPlan *plan,
                         DipTrack *tracks) {
    DipGltfReader *reader = samplers->reader;
    const DipGltf *gltf = &reader->gltf;
    DipTrack track = {0};
    bool used;
    int index;
    int input;
    int output;
    if (!channel || !read_target(reader, channel, &track, &used) ||
        !dip_gltf_integer(gltf, channel, "sampler", -1, &index)) {
        return false;
    }
    if (!used) {
        return true;
    }
    const cJSON *sampler = dip_gltf_list_item(gltf, &samplers->items, index, "samplers");
    if (!sampler || !dip_gltf_integer(gltf, sampler, "input", -1, &input) ||
        !dip_gltf_integer(gltf, sampler, "output", -1, &output) ||
        !read_interpolation(gltf, sampler, &track.interpolation) ||
        !read_times(reader, input, &track) || !read_values(reader, output, &track)) {
        return false;
    }
    tracks[plan->track_count++] = track;
    return true;
}

// The animation lasts until the last key of any track.
static double duration_of(const DipAnimationPlan *plan) {
    double duration_s = 0.0;
    for (int i = 0; i < plan->track_count; ++i) {
        const DipTrack *track = &plan->tracks[i];
        duration_s = fmax(duration_s, (double)track->times[track->key_count - 1]);
    }
    return duration_s;
}

static bool read_channels(const Samplers *samplers, const DipGltfItems *channels,
                          DipAnimationPlan *plan) {
    DipGltfReader *reader = samplers->reader;
    DipTrack *tracks = dip_gltf_alloc(reader, (size_t)channels->count, sizeof *tracks);
    if (!tracks) {
        return dip_gltf_no_room(reader);
    }
    plan->tracks = tracks;
    for (int i = 0; i < channels->count; ++i) {
        const cJSON *channel = dip_gltf_list_item(&reader->gltf, channels, i, "channels");
        if (!read_channel(samplers, channel, plan, tracks)) {
            return false;
        }
    }
    return true;
}

static bool read_animation(DipGltfReader *reader, int index) {
    DipAnimatedModel *model = reader->model;
    const cJSON *json = dip_gltf_item(&reader->gltf, DIP_GLTF_animations, index);
    const char *name = json ? dip_gltf_name(reader, json, "animation", index) : NULL;
    if (!name) {
        return json && dip_gltf_no_room(reader);
    }
    Samplers samplers = {.reader = reader};
    DipGltfItems channels = {0};
    DipAnimationPlan *plan = &model->animation_plans[index];
    const bool ok = dip_gltf_list(&reader->gltf, json, "samplers", &samplers.items) &&
                    dip_gltf_list(&reader->gltf, json, "channels", &channels) &&
                    read_channels(&samplers, &channels, plan);
    dip_gltf_free_list(&samplers.items);
    dip_gltf_free_list(&channels);
    model->animations[index] = (DipAnimation){name, ok ? duration_of(plan) : 0.0};
    return ok;
}

static bool prepare(DipGltfReader *reader) {
    DipAnimatedModel *model = reader->model;
    const size_t count = (size_t)reader->gltf.tables[DIP_GLTF_animations].count;
    model->animations = dip_gltf_alloc(reader, count, sizeof *model->animations);
    model->animation_plans = dip_gltf_alloc(reader, count, sizeof *model->animation_plans);
    return (model->animations && model->animation_plans) || dip_gltf_no_room(reader);
}

bool dip_gltf_read_animation(DipGltfReader *reader, int index) {
    return prepare(reader) && read_animation(reader, index);
}

bool dip_gltf_read_animations(DipGltfReader *reader) {
    DipAnimatedModel *model = reader->model;
    const int count = reader->gltf.tables[DIP_GLTF_animations].count;
    if (!prepare(reader)) {
        return false;
    }
    for (int i = 0; i < count; ++i) {
        if (!read_animation(reader, i)) {
            return false;
        }
    }
    model->def.animation_count = count;
    return true;
}
