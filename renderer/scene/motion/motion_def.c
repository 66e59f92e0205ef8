// Checks and copies the description of a motion, and makes a scene's description at a time.
#include "renderer/scene/motion.h"

#include "renderer/base/fp_mode.h"
#include "renderer/scene/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- checking ------------------------------------------------------------------------------------

static bool refuse(DipError *err, const char *what, int index) {
    return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "motion", "%s %d is out of range", what,
                         index);
}

static bool are_finite(const float *numbers, size_t count) {
    bool finite = true;
    for (size_t i = 0; i < count; i++) {
        finite = finite && isfinite(numbers[i]);
    }
    return finite;
}

static bool are_finite_doubles(const double *numbers, size_t count) {
    bool finite = true;
    for (size_t i = 0; i < count; i++) {
        finite = finite && isfinite(numbers[i]);
    }
    return finite;
}

static bool is_index(int index, int count) {
    return index >= 0 && index < count;
}

static bool is_node_fine(const DipRig *rig, int index) {
    const DipRigNode *node = &rig->nodes[index];
    return node->parent >= DIP_NO_NODE && node->parent < index && node->first_weight >= 0 &&
           node->weight_count >= 0 && node->weight_count <= rig->weight_count &&
           node->first_weight <= rig->weight_count - node->weight_count &&
           are_finite_doubles(node->matrix, 12) && are_finite_doubles(node->translation, 3) &&
           are_finite_doubles(node->rotation, 4) && are_finite_doubles(node->scale, 3);
}

static bool is_skin_fine(const DipRig *rig, const DipRigSkin *skin) {
    bool fine = skin->joint_count >= 0;
    for (int j = 0; fine && j < skin->joint_count; j++) {
        fine = is_index(skin->nodes[j], rig->node_count) &&
               are_finite_doubles(skin->inverse_binds + 12 * (size_t)j, 12);
    }
    return fine;
}

static bool is_track_fine(const DipRig *rig, const DipTrack *track) {
    static const int widths[] = {3, 4, 3};
    if (track->target < DIP_TRACK_TRANSLATION || track->target > DIP_TRACK_WEIGHTS ||
        track->interpolation < DIP_INTERPOLATION_STEP ||
        track->interpolation > DIP_INTERPOLATION_CUBICSPLINE ||
        !is_index(track->node, rig->node_count) || track->key_count < 1) {
        return false;
    }
    const int width = track->target == DIP_TRACK_WEIGHTS ? rig->nodes[track->node].weight_count
                                                         : widths[track->target];
    bool fine = track->width == width && are_finite(track->times, track->key_count);
    for (uint32_t k = 1; fine && k < track->key_count; k++) {
        fine = track->times[k] > track->times[k - 1];
    }
    return fine && are_finite(track->values, dip_track_value_count(track));
}

static bool check_rig(const DipMotionRig *rig, int index, DipError *err) {
    bool fine = rig->duration_s >= 0.0 && isfinite(rig->duration_s) && isfinite(rig->held_s) &&
                are_finite_doubles(rig->root, 12) &&
                are_finite(rig->rig.rest_weights, (size_t)rig->rig.weight_count);
    for (int n = 0; fine && n < rig->rig.node_count; n++) {
        fine = is_node_fine(&rig->rig, n);
    }
    for (int s = 0; fine && s < rig->skin_count; s++) {
        fine = is_skin_fine(&rig->rig, &rig->skins[s]);
    }
    for (int t = 0; fine && t < rig->track_count; t++) {
        fine = is_track_fine(&rig->rig, &rig->tracks[t]);
    }
    return fine || refuse(err, "rig", index);
}

static bool check_object(const DipSceneDef *scene, int index, DipError *err) {
    const DipMovingObject *object = &scene->motion->objects[index];
    const bool ascends = index == 0 || object->object > object[-1].object;
    const bool fine = ascends && is_index(object->object, scene->object_count) &&
                      is_index(object->rig, scene->motion->rig_count) &&
                      is_index(object->node, scene->motion->rigs[object->rig].rig.node_count) &&
                      are_finite_doubles(object->offset, 12);
    return fine || refuse(err, "moving object", index);
}

// Checks that the triangles of a mesh share no vertices, and have them in order.
static bool has_own_vertices(const DipMeshDef *mesh) {
    bool fine = mesh->index_count == mesh->vertex_count;
    for (uint32_t i = 0; fine && i < mesh->index_count; i++) {
        fine = mesh->indices[i] == i;
    }
    return fine;
}

static bool are_joints_fine(const DipMotionRig *rig, const DipMovingMesh *mesh) {
    if (mesh->skin == DIP_NO_SKIN) {
        return true;
    }
    if (!is_index(mesh->skin, rig->skin_count) || !mesh->joints || !mesh->joint_weights) {
        return false;
    }
    const int joint_count = rig->skins[mesh->skin].joint_count;
    bool fine = are_finite(mesh->joint_weights, 4 * (size_t)mesh->vertex_count);
    for (size_t i = 0; fine && i < 4 * (size_t)mesh->vertex_count; i++) {
        fine = mesh->joints[i] < joint_count;
    }
    return fine;
}

static bool is_box_fine(const float *box) {
    bool fine = !box || are_finite(box, 6);
    for (int axis = 0; box && fine && axis < 3; axis++) {
        fine = box[axis] <= box[3 + axis];
    }
    return fine;
}

static bool check_mesh(const DipSceneDef *scene, int index, DipError *err) {
    const DipMovingMesh *mesh = &scene->motion->meshes[index];
    if ((index > 0 && mesh->mesh <= mesh[-1].mesh) || !is_index(mesh->mesh, scene->mesh_count) ||
        !is_index(mesh->rig, scene->motion->rig_count)) {
        return refuse(err, "moving mesh", index);
    }
    const DipMotionRig *rig = &scene->motion->rigs[mesh->rig];
    const DipMeshDef *def = &scene->meshes[mesh->mesh];
    const size_t floats = 3 * (size_t)mesh->vertex_count * (size_t)mesh->shape_count;
    const int weights =
        is_index(mesh->node, rig->rig.node_count) ? rig->rig.nodes[mesh->node].weight_count : -1;
    const bool fine = weights >= 0 && mesh->shape_count == 1 + weights &&
                      mesh->vertex_count == def->vertex_count &&
                      are_finite(mesh->positions, floats) &&
                      (mesh->normals ? are_finite(mesh->normals, floats)
                                     : !def->normals || has_own_vertices(def)) &&
                      are_joints_fine(rig, mesh) && is_box_fine(mesh->box);
    return fine || refuse(err, "moving mesh", index);
}

bool dip_motion_check(const DipSceneDef *scene, DipError *err) {
    DIP_FP_MODE_SCOPE(); // Subnormal times differ from each other only in this mode.
    const DipMotionDef *motion = scene->motion;
    bool fine = true;
    for (int r = 0; fine && r < motion->rig_count; r++) {
        fine = check_rig(&motion->rigs[r], r, err);
    }
    for (int o = 0; fine && o < motion->object_count; o++) {
        fine = check_object(scene, o, err);
    }
    for (int m = 0; fine && m < motion->mesh_count; m++) {
        fine = check_mesh(scene, m, err);
    }
    return fine;
}

bool dip_motion_plays(const DipMotionDef *motion) {
    DIP_FP_MODE_SCOPE();
    for (int r = 0; r < motion->rig_count; r++) {
        if (!motion->rigs[r].is_held && motion->rigs[r].duration_s > 0.0) {
            return true;
        }
    }
    return false;
}

// --- copying -------------------------------------------------------------------------------------

// Replaces an array by a copy. Returns false if memory runs out; the pointer is then NULL. An array
// that is NULL stays NULL.
static bool copy_array(const void **array, size_t count, size_t item_bytes) {
    if (!*array) {
        return true;
    }
    void *copy = malloc(count * item_bytes + 1);
    if (copy) {
        memcpy(copy, *array, count * item_bytes);
    }
    *array = copy;
    return copy != NULL;
}

#define COPY(array, count) copy_array((const void **)&(array), (size_t)(count), sizeof *(array))

// Replaces the arrays of a rig by copies.
static bool copy_rig(DipMotionRig *rig) {
    const DipMotionRig from = *rig;
    DipRigSkin *skins = NULL;
    DipTrack *tracks = NULL;
    rig->skins = skins = calloc((size_t)from.skin_count + 1, sizeof *skins);
    rig->tracks = tracks = calloc((size_t)from.track_count + 1, sizeof *tracks);
    bool made = COPY(rig->clip, from.clip ? strlen(from.clip) + 1 : 0);
    made = COPY(rig->rig.nodes, from.rig.node_count) && made;
    made = COPY(rig->rig.rest_weights, from.rig.weight_count) && made && skins && tracks;
    for (int s = 0; made && s < from.skin_count; s++) {
        skins[s] = from.skins[s];
        made = COPY(skins[s].nodes, from.skins[s].joint_count);
        made = COPY(skins[s].inverse_binds, 12 * (size_t)from.skins[s].joint_count) && made;
    }
    for (int t = 0; made && t < from.track_count; t++) {
        tracks[t] = from.tracks[t];
        made = COPY(tracks[t].times, from.tracks[t].key_count);
        made = COPY(tracks[t].values, dip_track_value_count(&from.tracks[t])) && made;
    }
    return made;
}

static bool copy_mesh(DipMovingMesh *mesh) {
    const size_t vertices = mesh->vertex_count;
    const size_t floats = 3 * vertices * (size_t)mesh->shape_count;
    bool made = COPY(mesh->positions, floats);
    made = COPY(mesh->normals, floats) && made;
    made = COPY(mesh->joints, 4 * vertices) && made;
    made = COPY(mesh->box, 6) && made;
    return COPY(mesh->joint_weights, 4 * vertices) && made;
}

DipMotionDef *dip_motion_copy(const DipSceneDef *scene) {
    const DipMotionDef *from = scene->motion;
    DipMotionDef *copy = calloc(1, sizeof *copy);
    if (!copy) {
        return NULL;
    }
    DipMotionRig *rigs = calloc((size_t)from->rig_count + 1, sizeof *rigs);
    DipMovingMesh *meshes = calloc((size_t)from->mesh_count + 1, sizeof *meshes);
    copy->rigs = rigs;
    copy->meshes = meshes;
    copy->objects = from->objects;
    copy->object_count = from->object_count;
    bool made = COPY(copy->objects, from->object_count) && rigs && meshes;
    for (int r = 0; made && r < from->rig_count; r++) {
        rigs[r] = from->rigs[r];
        copy->rig_count++;
        made = copy_rig(&rigs[r]);
    }
    for (int m = 0; made && m < from->mesh_count; m++) {
        meshes[m] = from->meshes[m];
        copy->mesh_count++;
        made = copy_mesh(&meshes[m]);
    }
    if (!made) {
        dip_motion_free(&copy);
    }
    return copy;
}

static void free_rig(const DipMotionRig *rig) {
    for (int s = 0; rig->skins && s < rig->skin_count; s++) {
        free((void *)rig->skins[s].nodes);
        free((void *)rig->skins[s].inverse_binds);
    }
    for (int t = 0; rig->tracks && t < rig->track_count; t++) {
        free((void *)rig->tracks[t].times);
        free((void *)rig->tracks[t].values);
    }
    free((void *)rig->clip);
    free((void *)rig->skins);
    free((void *)rig->tracks);
    free((void *)rig->rig.nodes);
    free((void *)rig->rig.rest_weights);
}

void dip_motion_free(DipMotionDef **motion) {
    if (!*motion) {
        return;
    }
    for (int r = 0; r < (*motion)->rig_count; r++) {
        free_rig(&(*motion)->rigs[r]);
    }
    for (int m = 0; m < (*motion)->mesh_count; m++) {
        const DipMovingMesh *mesh = &(*motion)->meshes[m];
        free((void *)mesh->positions);
        free((void *)mesh->normals);
        free((void *)mesh->joints);
        free((void *)mesh->joint_weights);
        free((void *)mesh->box);
    }
    free((void *)(*motion)->rigs);
    free((void *)(*motion)->objects);
    free((void *)(*motion)->meshes);
    free(*motion);
    *motion = NULL;
}

// --- a description at a time ---------------------------------------------------------------------

struct DipPosedDef {
    const DipMotionDef *motion; // borrowed
    DipMotionPose *pose;
    DipSceneDef def;
    DipMeshDef *meshes;
    DipObjectDef *objects;
};

static void follow_pose(DipPosedDef *posed) {
    for (int o = 0; o < posed->motion->object_count; o++) {
        dip_motion_pose_transform(posed->pose, o,
                                  posed->objects[posed->motion->objects[o].object].transform);
    }
    for (int m = 0; m < posed->motion->mesh_count; m++) {
        const DipMeshDef *mesh = &posed->meshes[posed->motion->meshes[m].mesh];
        dip_motion_pose_vertices(posed->pose, m, 0, mesh->vertex_count, 3, (float *)mesh->positions,
                                 (float *)mesh->normals);
    }
}

// Gives the moving meshes arrays of their own.
static bool make_arrays(DipPosedDef *posed, const DipSceneDef *scene) {
    posed->meshes = calloc((size_t)scene->mesh_count + 1, sizeof *posed->meshes);
    posed->objects = calloc((size_t)scene->object_count + 1, sizeof *posed->objects);
    if (!posed->meshes || !posed->objects) {
        return false;
    }
    memcpy(posed->meshes, scene->meshes, (size_t)scene->mesh_count * sizeof *posed->meshes);
    memcpy(posed->objects, scene->objects, (size_t)scene->object_count * sizeof *posed->objects);
    bool made = true;
    for (int m = 0; m < posed->motion->mesh_count; m++) {
        DipMeshDef *mesh = &posed->meshes[posed->motion->meshes[m].mesh];
        made = COPY(mesh->positions, 3 * (size_t)mesh->vertex_count) && made;
        made = COPY(mesh->normals, 3 * (size_t)mesh->vertex_count) && made;
    }
    return made;
}

DipPosedDef *dip_posed_def_create(const DipSceneDef *scene, DipError *err) {
    DIP_FP_MODE_SCOPE();
    DipPosedDef *posed = calloc(1, sizeof *posed);
    if (posed) {
        posed->motion = scene->motion;
        posed->pose = dip_motion_pose_create(scene->motion);
        posed->def = *scene;
        posed->def.motion = NULL;
    }
    if (!posed || !posed->pose || !make_arrays(posed, scene)) {
        dip_posed_def_destroy(&posed);
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "motion", "out of memory");
        return NULL;
    }
    posed->def.meshes = posed->meshes;
    posed->def.objects = posed->objects;
    follow_pose(posed);
    return posed;
}

void dip_posed_def_destroy(DipPosedDef **posed_pointer) {
    DipPosedDef *posed = *posed_pointer;
    if (!posed) {
        return;
    }
    for (int m = 0; posed->meshes && posed->objects && m < posed->motion->mesh_count; m++) {
        const DipMeshDef *mesh = &posed->meshes[posed->motion->meshes[m].mesh];
        free((void *)mesh->positions);
        free((void *)mesh->normals);
    }
    free(posed->meshes);
    free(posed->objects);
    dip_motion_pose_destroy(&posed->pose);
    free(posed);
    *posed_pointer = NULL;
}

const DipSceneDef *dip_posed_def(const DipPosedDef *posed) {
    return &posed->def;
}

void dip_posed_def_set(DipPosedDef *posed, int64_t time_ns) {
    DIP_FP_MODE_SCOPE();
    dip_motion_pose_set(posed->pose, time_ns);
    follow_pose(posed);
}

void dip_posed_def_set_share(DipPosedDef *posed, double share) {
    DIP_FP_MODE_SCOPE();
    DIP_FP_PIN(share);
    dip_motion_pose_set_share(posed->pose, share);
    follow_pose(posed);
}
