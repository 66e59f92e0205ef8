// A camera path in memory: the rules for its keys, its statistics, and the pose at a time.
#include "campaths/campath_private.h"

#include "renderer/base/fp_mode.h"
#include "renderer/base/assert.h"
#include "renderer/base/trig.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const dip_campath_key_names[7] = {"x", "y", "z", "qx", "qy", "qz", "qw"};

static const double MIN_QUATERNION = 1e-6; // lowest accepted length of a quaternion
static const double MAX_QUATERNION = 1e6;  // highest accepted length of a quaternion

double dip_campath_dot(const double a[4], const double b[4]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

bool dip_campath_is_unit(const double q[4]) {
    return fabs(dip_campath_dot(q, q) - 1.0) <= DIP_CAMPATH_UNIT_TOLERANCE;
}

double dip_campath_component(const DipCamKey *key, int index) {
    return index < 3 ? key->position_world[index] : key->orientation[index - 3];
}

// After one division the squared length is within 1e-15 of 1. dip_campath_is_unit accepts this
// length, so a quaternion is never normalised twice.
static void normalise(double q[4]) {
    const double length = sqrt(dip_campath_dot(q, q));
    for (int i = 0; i < 4; i++) {
        q[i] /= length;
    }
}

bool dip_campath_admit(DipCamKey *key, const DipCamKey *before, const char *name, int line,
                       DipError *err) {
    for (int i = 0; i < 7; i++) {
        const double limit = i < 3 ? DIP_CAMPATH_MAX_POSITION : MAX_QUATERNION;
        const double value = dip_campath_component(key, i);
        if (!(fabs(value) <= limit)) {
            return dip_error_set(err, DIP_ERROR_RANGE, name, line, dip_campath_key_names[i],
                                 "%.9g is out of range, accepted %g..%g", value, -limit, limit);
        }
    }
    double *q = key->orientation;
    if (!dip_campath_is_unit(q)) {
        const double length = sqrt(dip_campath_dot(q, q));
        if (length < MIN_QUATERNION || length > MAX_QUATERNION) {
            return dip_error_set(err, DIP_ERROR_RANGE, name, line, "qx qy qz qw",
                                 "the quaternion has length %.9g, accepted %g..%g", length,
                                 MIN_QUATERNION, MAX_QUATERNION);
        }
        normalise(q);
    }
    if (before && dip_campath_dot(before->orientation, q) < 0.0) {
        for (int i = 0; i < 4; i++) {
            q[i] = -q[i];
        }
    }
    return true;
}

DipCamPath *dip_campath_allocate(size_t key_count, int64_t period_ns, const char *name,
                                 DipError *err) {
    DIP_ASSERT(key_count >= 1 && key_count <= DIP_CAMPATH_MAX_KEYS);
    // A path takes at most 1e6 * 56 bytes and 3.6e18 ns, so neither product can overflow.
    DipCamPath *path = malloc(sizeof *path + key_count * sizeof path->keys[0]);
    if (!path) {
        dip_error_set(err, DIP_ERROR_MEMORY, name, 0, NULL, "out of memory for %zu keys",
                      key_count);
        return NULL;
    }
    path->key_count = key_count;
    path->period_ns = period_ns;
    path->duration_ns = (int64_t)key_count * period_ns;
    path->closing_sign = 1.0;
    return path;
}

void dip_campath_finish(DipCamPath *path) {
    const DipCamKey *last = &path->keys[path->key_count - 1];
    const double dot = dip_campath_dot(last->orientation, path->keys[0].orientation);
    path->closing_sign = dot < 0.0 ? -1.0 : 1.0;
}

bool dip_campath_create(const DipCamKey *keys, size_t key_count, int64_t period_ns,
                        DipCamPath **path, DipError *err) {
    DIP_FP_MODE_SCOPE();
    *path = NULL;
    if (key_count < 1 || key_count > DIP_CAMPATH_MAX_KEYS) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "keys", "%zu keys, accepted 1..%d",
                             key_count, DIP_CAMPATH_MAX_KEYS);
    }
    if (period_ns < DIP_CAMPATH_MIN_PERIOD_NS || period_ns > DIP_CAMPATH_MAX_PERIOD_NS) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "period",
                             "%lld ns is out of range, accepted %lld..%lld", (long long)period_ns,
                             (long long)DIP_CAMPATH_MIN_PERIOD_NS,
                             (long long)DIP_CAMPATH_MAX_PERIOD_NS);
    }
    DipCamPath *made = dip_campath_allocate(key_count, period_ns, NULL, err);
    if (!made) {
        return false;
    }
    for (size_t i = 0; i < key_count; i++) {
        made->keys[i] = keys[i];
        if (!dip_campath_admit(&made->keys[i], i ? &made->keys[i - 1] : NULL, NULL, 0, err)) {
            free(made);
            return false;
        }
    }
    dip_campath_finish(made);
    *path = made;
    return true;
}

void dip_campath_destroy(DipCamPath **path) {
    if (path) {
        free(*path);
        *path = NULL;
    }
}

DipCamKey dip_campath_key(const DipCamPath *path, size_t index) {
    DIP_ASSERT(index < path->key_count);
    return path->keys[index];
}

// Finds the orientation at the end of the step that starts at key `index`. An orientation has two
// quaternions, q and -q. Returns the one on the hemisphere of that key (dot product >= 0).
static void step_target(const DipCamPath *path, size_t index, double q[4]) {
    const size_t next = index + 1 < path->key_count ? index + 1 : 0;
    const double sign = next == 0 ? path->closing_sign : 1.0;
    for (int i = 0; i < 4; i++) {
        q[i] = sign * path->keys[next].orientation[i];
    }
}

// Returns the angle between two unit quaternions as 4-vectors, which is half the angle between the
// rotations. It is computed from chords, because acos of the dot product loses half its digits at
// small angles.
static double angle_between(const double a[4], const double b[4]) {
    double apart = 0.0;
    double along = 0.0;
    for (int i = 0; i < 4; i++) {
        apart += (a[i] - b[i]) * (a[i] - b[i]);
        along += (a[i] + b[i]) * (a[i] + b[i]);
    }
    return 2.0 * dip_atan2(sqrt(apart), sqrt(along));
}

// a and b lie on one hemisphere, so their angle is at most pi/2 and its sine is 0 only if they are
// equal. Orientations 180 degrees apart have the angle pi/2; the signs of their quaternions decide
// which way the camera turns.
static void slerp(const double a[4], const double b[4], double u, double q[4]) {
    const double angle = angle_between(a, b);
    double from = 1.0 - u;
    double to = u;
    if (angle > 1e-6) { // At smaller angles LERP differs from SLERP by less than 1e-18.
        const double sine = dip_sin(angle);
        from = dip_sin((1.0 - u) * angle) / sine;
        to = dip_sin(u * angle) / sine;
    }
    for (int i = 0; i < 4; i++) {
        q[i] = from * a[i] + to * b[i];
    }
    normalise(q);
}

// Returns the time modulo a duration above 0, from 0 to below the duration.
static int64_t wrap(int64_t time_ns, int64_t duration_ns) {
    const int64_t rest_ns = time_ns % duration_ns;
    return rest_ns < 0 ? rest_ns + duration_ns : rest_ns;
}

void dip_campath_sample(const DipCamPath *path, int64_t time_ns, DipPose *pose) {
    DIP_FP_MODE_SCOPE();
    const int64_t phase_ns = wrap(time_ns, path->duration_ns);
    const size_t index = (size_t)(phase_ns / path->period_ns);
    const int64_t past_ns = phase_ns % path->period_ns;
    const DipCamKey *a = &path->keys[index];
    memcpy(pose->position_world, a->position_world, sizeof pose->position_world);
    memcpy(pose->orientation, a->orientation, sizeof pose->orientation);
    if (past_ns == 0 || path->key_count == 1) {
        return;
    }
    const double u = (double)past_ns / (double)path->period_ns;
    const DipCamKey *b = &path->keys[index + 1 < path->key_count ? index + 1 : 0];
    for (int i = 0; i < 3; i++) {
        pose->position_world[i] += u * (b->position_world[i] - a->position_world[i]);
    }
    double target[4];
    step_target(path, index, target);
    slerp(a->orientation, target, u, pose->orientation);
}

const char *const dip_campath_end_names[DIP_CAMPATH_END_COUNT] = {
#define END_NAME(name, text) #name,
    DIP_CAMPATH_END_LIST(END_NAME)
#undef END_NAME
};

int64_t dip_campath_span_ns(const DipCamPath *path, DipCamPathEnd end) {
    const int64_t last_ns = path->duration_ns - path->period_ns; // Time of the last key.
    return end == DIP_CAMPATH_END_loop   ? path->duration_ns
           : end == DIP_CAMPATH_END_once ? last_ns
                                         : 2 * last_ns; // At most 7.2e18.
}

int64_t dip_campath_time_at_end(const DipCamPath *path, DipCamPathEnd end, int64_t time_ns) {
    const int64_t span_ns = dip_campath_span_ns(path, end);
    if (span_ns == 0) {
        return 0;
    }
    if (end == DIP_CAMPATH_END_once) {
        return time_ns < 0 ? 0 : time_ns < span_ns ? time_ns : span_ns;
    }
    const int64_t phase_ns = wrap(time_ns, span_ns);
    const bool forwards = end == DIP_CAMPATH_END_loop || phase_ns <= span_ns / 2;
    return forwards ? phase_ns : span_ns - phase_ns;
}

DipCamPathInfo dip_campath_info(const DipCamPath *path) {
    DIP_FP_MODE_SCOPE();
    DipCamPathInfo info = {
        .key_count = path->key_count,
        .period_ns = path->period_ns,
        .duration_ns = path->duration_ns,
    };
    memcpy(info.min_world, path->keys[0].position_world, sizeof info.min_world);
    memcpy(info.max_world, path->keys[0].position_world, sizeof info.max_world);
    const double period_s = (double)path->period_ns * 1e-9;
    for (size_t k = 0; k < path->key_count; k++) {
        const double *p = path->keys[k].position_world;
        const double *next = path->keys[k + 1 < path->key_count ? k + 1 : 0].position_world;
        double squared = 0.0;
        for (int i = 0; i < 3; i++) {
            info.min_world[i] = fmin(info.min_world[i], p[i]);
            info.max_world[i] = fmax(info.max_world[i], p[i]);
            squared += (next[i] - p[i]) * (next[i] - p[i]);
        }
        double target[4];
        step_target(path, k, target);
        const double turn_deg = angle_between(path->keys[k].orientation, target) * 360.0 / DIP_PI;
        info.length_m += sqrt(squared);
        info.max_speed_m_per_s = fmax(info.max_speed_m_per_s, sqrt(squared) / period_s);
        info.max_turn_deg_per_s = fmax(info.max_turn_deg_per_s, turn_deg / period_s);
    }
    return info;
}
