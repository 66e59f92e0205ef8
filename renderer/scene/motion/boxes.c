// Bounds the meshes of a motion over their clips.
#include "renderer/scene/motion.h"

#include "renderer/base/fp_mode.h"

#include <math.h>

enum { BATCH = 96, MAX_KEYS = 4096 };

// Returns the track that alone decides the shape of a mesh and is straight between its keys, so
// that the shapes at the keys bound all others. Returns NULL if there is none.
static const DipTrack *shape_track(const DipMotionDef *motion, const DipMovingMesh *mesh) {
    const DipMotionRig *rig = &motion->rigs[mesh->rig];
    for (int t = 0; mesh->skin == DIP_NO_SKIN && !rig->is_held && t < rig->track_count; t++) {
        const DipTrack *track = &rig->tracks[t];
        if (track->target == DIP_TRACK_WEIGHTS && track->node == mesh->node) {
            const bool straight = track->interpolation != DIP_INTERPOLATION_CUBICSPLINE;
            return straight && track->key_count <= MAX_KEYS ? track : NULL;
        }
    }
    return NULL;
}

// Extends a box by the vertices of a mesh in a pose.
static void extend(const DipMotionPose *pose, const DipMovingMesh *mesh, int moving, float box[6]) {
    float positions[3 * BATCH];
    for (uint32_t first = 0; first < mesh->vertex_count; first += BATCH) {
        const uint32_t left = mesh->vertex_count - first;
        const uint32_t count = left < BATCH ? left : BATCH;
        dip_motion_pose_vertices(pose, moving, first, count, 3, positions, NULL);
        for (size_t i = 0; i < 3 * (size_t)count; i++) {
            const size_t axis = i % 3;
            box[axis] = fminf(box[axis], positions[i]);
            box[3 + axis] = fmaxf(box[3 + axis], positions[i]);
        }
    }
}

// Bounds a mesh at the keys of its track. The last key may lie at the end of the clip, where the
// clip begins again.
static void bound_at_keys(DipMotionPose *pose, const DipMotionDef *motion, int moving,
                          const DipTrack *track, float box[6]) {
    const DipMovingMesh *mesh = &motion->meshes[moving];
    const int64_t end_ns = (int64_t)(motion->rigs[mesh->rig].duration_s * 1e9) - 1;
    for (uint32_t k = 0; k < track->key_count; k++) {
        const int64_t key_ns = (int64_t)((double)track->times[k] * 1e9);
        dip_motion_pose_set(pose, key_ns < end_ns ? key_ns : end_ns);
        extend(pose, mesh, moving, box);
    }
}

bool dip_motion_bound_meshes(const DipMotionDef *motion, float (*boxes)[6]) {
    DIP_FP_MODE_SCOPE();
    DipMotionPose *pose = dip_motion_pose_create(motion);
    if (!pose) {
        return false;
    }
    for (int m = 0; m < motion->mesh_count; m++) {
        for (int i = 0; i < 6; i++) {
            boxes[m][i] = i < 3 ? INFINITY : -INFINITY;
        }
    }
    for (int k = 0; k < DIP_MOTION_MOMENTS; k++) {
        dip_motion_pose_set_share(pose, (double)k / DIP_MOTION_MOMENTS);
        for (int m = 0; m < motion->mesh_count; m++) {
            const DipMovingMesh *mesh = &motion->meshes[m];
            const bool counts = k == 0 || !motion->rigs[mesh->rig].is_held;
            if (counts && (k == 0 || !shape_track(motion, mesh))) {
                extend(pose, mesh, m, boxes[m]);
            }
        }
    }
    for (int m = 0; m < motion->mesh_count; m++) {
        const DipTrack *track = shape_track(motion, &motion->meshes[m]);
        if (track) {
            bound_at_keys(pose, motion, m, track, boxes[m]);
        }
    }
    dip_motion_pose_destroy(&pose);
    return true;
}
