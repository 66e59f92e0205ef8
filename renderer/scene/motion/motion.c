// Moves a scene to a time: places its objects and computes the vertices of its moving meshes.
#include "renderer/scene/motion.h"

#include "renderer/base/fp_mode.h"
#include "renderer/scene/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BATCH = 96 }; // Vertices that are computed at once; a multiple of 3.

struct DipMotionPose {
    const DipMotionDef *motion;
    int rig_count; // Those of the motion, which may be gone when the pose is destroyed.
    int mesh_count;
    DipRigPose **rigs; // One for each rig.
    double *times_s;   // The time of each rig's clip.
    float **weights;   // For each moving mesh, the weight of each shape.
    float **joints;    // For each moving mesh, the matrices of its joints; NULL without joints.
};

// --- poses ---------------------------------------------------------------------------------------

static void weigh_shapes(const DipMotionPose *pose, int index) {
    const DipMovingMesh *mesh = &pose->motion->meshes[index];
    float *weights = pose->weights[index];
    weights[0] = 1.0f;
    const double *of_node = dip_rig_pose_weights(pose->rigs[mesh->rig], mesh->node);
    for (int s = 1; s < mesh->shape_count; s++) {
        weights[s] = (float)of_node[s - 1];
    }
}

// Moves the pose to the times of the clips in times_s.
static void move(DipMotionPose *pose) {
    const DipMotionDef *motion = pose->motion;
    for (int r = 0; r < motion->rig_count; r++) {
        const DipMotionRig *rig = &motion->rigs[r];
        const double time_s = rig->is_held ? rig->held_s : pose->times_s[r];
        pose->times_s[r] = dip_rig_wrap_time(time_s, rig->duration_s);
        dip_rig_pose_set(pose->rigs[r], rig->tracks, rig->track_count, pose->times_s[r]);
    }
    for (int m = 0; m < motion->mesh_count; m++) {
        const DipMovingMesh *mesh = &motion->meshes[m];
        weigh_shapes(pose, m);
        if (mesh->skin != DIP_NO_SKIN) {
            dip_rig_pose_joints(pose->rigs[mesh->rig], &motion->rigs[mesh->rig].skins[mesh->skin],
                                pose->joints[m]);
        }
    }
}

void dip_motion_pose_set(DipMotionPose *pose, int64_t time_ns) {
    DIP_FP_MODE_SCOPE();
    for (int r = 0; r < pose->motion->rig_count; r++) {
        pose->times_s[r] = (double)time_ns / 1e9;
    }
    move(pose);
}

void dip_motion_pose_set_share(DipMotionPose *pose, double share) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(share);
    for (int r = 0; r < pose->motion->rig_count; r++) {
        pose->times_s[r] = share * pose->motion->rigs[r].duration_s;
    }
    move(pose);
}

void dip_motion_pose_transform(const DipMotionPose *pose, int moving, float transform[12]) {
    DIP_FP_MODE_SCOPE();
    const DipMovingObject *object = &pose->motion->objects[moving];
    double placed[12];
    double world[12];
    dip_rig_multiply(pose->motion->rigs[object->rig].root,
                     dip_rig_pose_world(pose->rigs[object->rig], object->node), placed);
    dip_rig_multiply(placed, object->offset, world);
    bool finite = true;
    for (int i = 0; i < 12; i++) {
        transform[i] = (float)world[i];
        finite = finite && isfinite(transform[i]);
    }
    if (!finite) {
        memset(transform, 0, 12 * sizeof *transform);
    }
}

// --- creating and destroying ---------------------------------------------------------------------

static bool allocate(DipMotionPose *pose) {
    const DipMotionDef *motion = pose->motion;
    pose->rigs = calloc((size_t)motion->rig_count + 1, sizeof *pose->rigs);
    pose->times_s = calloc((size_t)motion->rig_count + 1, sizeof *pose->times_s);
    pose->weights = calloc((size_t)motion->mesh_count + 1, sizeof *pose->weights);
    pose->joints = calloc((size_t)motion->mesh_count + 1, sizeof *pose->joints);
    bool made = pose->rigs && pose->times_s && pose->weights && pose->joints;
    for (int r = 0; made && r < motion->rig_count; r++) {
        pose->rigs[r] = dip_rig_pose_create(&motion->rigs[r].rig);
        made = pose->rigs[r] != NULL;
    }
    for (int m = 0; made && m < motion->mesh_count; m++) {
        const DipMovingMesh *mesh = &motion->meshes[m];
        const bool skinned = mesh->skin != DIP_NO_SKIN;
        const int joints = skinned ? motion->rigs[mesh->rig].skins[mesh->skin].joint_count : 0;
        pose->weights[m] = calloc((size_t)mesh->shape_count + 1, sizeof(float));
        pose->joints[m] = calloc((size_t)joints + 1, 12 * sizeof(float));
        made = pose->weights[m] && pose->joints[m];
    }
    return made;
}

DipMotionPose *dip_motion_pose_create(const DipMotionDef *motion) {
    DipMotionPose *pose = calloc(1, sizeof *pose);
    if (!pose) {
        return NULL;
    }
    pose->motion = motion;
    pose->rig_count = motion->rig_count;
    pose->mesh_count = motion->mesh_count;
    if (allocate(pose)) {
        dip_motion_pose_set(pose, 0);
    } else {
        dip_motion_pose_destroy(&pose);
    }
    return pose;
}

void dip_motion_pose_destroy(DipMotionPose **pose_pointer) {
    DipMotionPose *pose = *pose_pointer;
    if (!pose) {
        return;
    }
    for (int r = 0; pose->rigs && r < pose->rig_count; r++) {
        dip_rig_pose_destroy(&pose->rigs[r]);
    }
    for (int m = 0; m < pose->mesh_count; m++) {
        free(pose->weights ? pose->weights[m] : NULL);
        free(pose->joints ? pose->joints[m] : NULL);
    }
    free(pose->rigs);
    free(pose->times_s);
    free(pose->weights);
    free(pose->joints);
    free(pose);
    *pose_pointer = NULL;
}

// --- vertices ------------------------------------------------------------------------------------

// Sums up the shapes of some vertices: `count` floats from number `first` of each shape on.
static void mix_shapes(const float *shapes, size_t shape_floats, int shape_count,
                       const float *weights, size_t first, size_t count, float *sum) {
    memset(sum, 0, count * sizeof *sum);
    for (int s = 0; s < shape_count; s++) {
        const float weight = weights[s];
        const float *from = shapes + (size_t)s * shape_floats + first;
        for (size_t i = 0; weight != 0.0f && i < count; i++) {
            sum[i] += weight * from[i];
        }
    }
}

// Writes a unit vector along v, or +Y if v has no direction.
static void write_normal(const double v[3], float normal[3]) {
    const double square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    const bool usable = square > 0.0 && isfinite(square);
    const double scale = usable ? 1.0 / sqrt(square) : 0.0;
    for (int i = 0; i < 3; i++) {
        normal[i] = usable ? (float)(v[i] * scale) : i == 1 ? 1.0f : 0.0f;
    }
}

// Turns a normal by the inverse transpose of a matrix. Its cofactors have the same direction; the
// sign keeps normals pointing outwards where the matrix mirrors.
static void turn_normal(const float m[12], float normal[3]) {
    double cofactors[3][3];
    double v[3];
    for (int r = 0; r < 3; r++) {
        const float *a = m + 4 * ((r + 1) % 3);
        const float *b = m + 4 * ((r + 2) % 3);
        for (int c = 0; c < 3; c++) {
            const int j = (c + 1) % 3;
            const int k = (c + 2) % 3;
            cofactors[r][c] = (double)a[j] * (double)b[k] - (double)a[k] * (double)b[j];
        }
    }
    const double determinant = (double)m[0] * cofactors[0][0] + (double)m[1] * cofactors[0][1] +
                               (double)m[2] * cofactors[0][2];
    for (int r = 0; r < 3; r++) {
        const double *row = cofactors[r];
        v[r] = row[0] * (double)normal[0] + row[1] * (double)normal[1] + row[2] * (double)normal[2];
        v[r] = determinant < 0.0 ? -v[r] : v[r];
    }
    write_normal(v, normal);
}

// Moves a vertex by the weighted mean of the matrices of its joints. normal may be NULL.
static void move_by_joints(const float *matrices, const uint16_t joints[4], const float weights[4],
                           float position[3], float *normal) {
    float m[12] = {0.0f};
    for (int k = 0; k < 4; k++) {
        const float *joint = matrices + 12 * (size_t)joints[k];
        const float weight = weights[k];
        for (int i = 0; weight != 0.0f && i < 12; i++) {
            m[i] += weight * joint[i];
        }
    }
    const float p[3] = {position[0], position[1], position[2]};
    for (int r = 0; r < 3; r++) {
        const float *row = m + 4 * r;
        position[r] = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
    }
    if (normal) {
        turn_normal(m, normal);
    }
}

// Gives three vertices the normal of their triangle.
static void face_normal(const float p[9], float normals[9]) {
    double v[3];
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        v[i] = ((double)p[3 + j] - (double)p[j]) * ((double)p[6 + k] - (double)p[k]) -
               ((double)p[3 + k] - (double)p[k]) * ((double)p[6 + j] - (double)p[j]);
    }
    for (size_t corner = 0; corner < 3; corner++) {
        write_normal(v, normals + 3 * corner);
    }
}

// Some vertices while they are computed.
typedef struct Batch {
    float positions[3 * BATCH];
    float normals[3 * BATCH];
} Batch;

static void finish_normals(const DipMovingMesh *mesh, uint32_t count, Batch *batch) {
    for (uint32_t i = 0; !mesh->normals && i + 2 < count; i += 3) {
        face_normal(batch->positions + 3 * (size_t)i, batch->normals + 3 * (size_t)i);
    }
    for (uint32_t i = 0; mesh->normals && mesh->skin == DIP_NO_SKIN && i < count; i++) {
        float *normal = batch->normals + 3 * (size_t)i;
        const double v[3] = {(double)normal[0], (double)normal[1], (double)normal[2]};
        write_normal(v, normal);
    }
}

// Computes up to BATCH vertices. shape_floats: the numbers of a shape.
static void compute(const DipMotionPose *pose, int moving, size_t shape_floats, uint32_t first,
                    uint32_t count, bool with_normals, Batch *batch) {
    const DipMovingMesh *mesh = &pose->motion->meshes[moving];
    const float *weights = pose->weights[moving];
    const size_t from = 3 * (size_t)first;
    mix_shapes(mesh->positions, shape_floats, mesh->shape_count, weights, from, 3 * (size_t)count,
               batch->positions);
    if (with_normals && mesh->normals) {
        mix_shapes(mesh->normals, shape_floats, mesh->shape_count, weights, from, 3 * (size_t)count,
                   batch->normals);
    }
    for (uint32_t i = 0; mesh->skin != DIP_NO_SKIN && i < count; i++) {
        const size_t vertex = (size_t)first + i;
        float *normal =
            with_normals && mesh->normals ? batch->normals + 3 * (size_t)i : (float *)NULL;
        move_by_joints(pose->joints[moving], mesh->joints + 4 * vertex,
                       mesh->joint_weights + 4 * vertex, batch->positions + 3 * (size_t)i, normal);
    }
    for (size_t i = 0; i < 3 * (size_t)count; i++) {
        batch->positions[i] = isfinite(batch->positions[i]) ? batch->positions[i] : 0.0f;
    }
    if (with_normals) {
        finish_normals(mesh, count, batch);
    }
}

static void scatter(const float *from, uint32_t count, size_t stride, float *to) {
    for (uint32_t i = 0; i < count; i++) {
        memcpy(to + stride * i, from + 3 * (size_t)i, 3 * sizeof *to);
    }
}

void dip_motion_pose_vertices(const DipMotionPose *pose, int moving, uint32_t first, uint32_t count,
                              size_t stride, float *positions, float *normals) {
    DIP_FP_MODE_SCOPE();
    const size_t shape_floats = 3 * (size_t)pose->motion->meshes[moving].vertex_count;
    Batch batch;
    for (uint32_t done = 0; done < count; done += BATCH) {
        const uint32_t now = count - done < BATCH ? count - done : BATCH;
        compute(pose, moving, shape_floats, first + done, now, normals != NULL, &batch);
        scatter(batch.positions, now, stride, positions + stride * done);
        if (normals) {
            scatter(batch.normals, now, stride, normals + stride * done);
        }
    }
}
