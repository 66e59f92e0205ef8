// Reads the motion of a scene pack.
#include "assets/pack/scene_pack_check.h"
#include "renderer/scene/motion.h"

#include <stdlib.h>
#include <string.h>

// The motion that a scene's `motion` points to, and its arrays.
struct DipPackedMotion {
    DipMotionDef def;
    DipMotionRig *rigs;
    DipRigNode *nodes; // those of all rigs
    DipRigSkin *skins;
    DipTrack *tracks;
    DipMovingObject *objects;
    DipMovingMesh *meshes;
};

// How many records of each kind the rigs have taken.
typedef struct RigParts {
    uint64_t nodes;
    uint64_t skins;
    uint64_t tracks;
} RigParts;

static bool read_rig(DipPackReader *reader, uint64_t index, struct DipPackedMotion *motion,
                     RigParts *taken) {
    const PackHeader *header = &reader->header;
    PackRig record;
    dip_pack_read_record(reader, &header->rigs, index, &record, sizeof record);
    if (record.node_count > header->nodes.count - taken->nodes ||
        record.skin_count > header->skins.count - taken->skins ||
        record.track_count > header->tracks.count - taken->tracks ||
        record.weight_count > PACK_MAX_RECORDS) {
        return dip_pack_refuse(reader, "counts of a rig", index);
    }
    DipMotionRig *rig = &motion->rigs[index];
    *rig = (DipMotionRig){.duration_s = record.duration_s,
                          .is_held = record.is_held == 1,
                          .held_s = record.held_s,
                          .rig = {.nodes = motion->nodes + taken->nodes,
                                  .node_count = (int)record.node_count,
                                  .weight_count = (int)record.weight_count},
                          .skins = motion->skins + taken->skins,
                          .skin_count = (int)record.skin_count,
                          .tracks = motion->tracks + taken->tracks,
                          .track_count = (int)record.track_count};
    memcpy(rig->root, record.root, sizeof rig->root);
    taken->nodes += record.node_count;
    taken->skins += record.skin_count;
    taken->tracks += record.track_count;
    const bool ok = dip_pack_is_boolean(record.is_held) &&
                    dip_pack_read_text(reader, record.clip, &rig->clip) &&
                    dip_pack_read_floats(reader, record.rest_weights, record.weight_count,
                                         &rig->rig.rest_weights) &&
                    (rig->rig.rest_weights || record.weight_count == 0);
    return ok || dip_pack_refuse(reader, "a rig", index);
}

static bool read_node(const DipPackReader *reader, uint64_t index, DipRigNode *node) {
    PackNode record;
    dip_pack_read_record(reader, &reader->header.nodes, index, &record, sizeof record);
    *node = (DipRigNode){.parent = record.parent,
                         .has_matrix = record.has_matrix == 1,
                         .first_weight = record.first_weight,
                         .weight_count = record.weight_count};
    memcpy(node->matrix, record.matrix, sizeof node->matrix);
    memcpy(node->translation, record.translation, sizeof node->translation);
    memcpy(node->rotation, record.rotation, sizeof node->rotation);
    memcpy(node->scale, record.scale, sizeof node->scale);
    return dip_pack_is_boolean(record.has_matrix) || dip_pack_refuse(reader, "a node", index);
}

static bool read_skin(DipPackReader *reader, uint64_t index, DipRigSkin *skin) {
    PackSkin record;
    const void *nodes;
    const void *binds;
    dip_pack_read_record(reader, &reader->header.skins, index, &record, sizeof record);
    const uint64_t joints = record.joint_count;
    const bool ok =
        joints <= PACK_MAX_RECORDS &&
        dip_pack_read_array(reader, record.nodes, joints, sizeof *skin->nodes, &nodes) &&
        dip_pack_read_array(reader, record.inverse_binds, joints, 12 * sizeof(double), &binds) &&
        ((nodes && binds) || joints == 0);
    if (ok) {
        *skin = (DipRigSkin){.joint_count = (int)joints, .nodes = nodes, .inverse_binds = binds};
    }
    return ok || dip_pack_refuse(reader, "a skin", index);
}

static bool read_track(DipPackReader *reader, uint64_t index, DipTrack *track) {
    PackTrack record;
    dip_pack_read_record(reader, &reader->header.tracks, index, &record, sizeof record);
    if (record.target > DIP_TRACK_WEIGHTS || record.interpolation > DIP_INTERPOLATION_CUBICSPLINE ||
        record.width < 0 || record.width > PACK_MAX_RECORDS || record.key_count < 1) {
        return dip_pack_refuse(reader, "kind of a track", index);
    }
    *track = (DipTrack){.target = (DipTrackTarget)record.target,
                        .interpolation = (DipInterpolation)record.interpolation,
                        .node = record.node,
                        .width = record.width,
                        .key_count = record.key_count};
    const bool ok =
        dip_pack_read_floats(reader, record.times, record.key_count, &track->times) &&
        track->times &&
        dip_pack_read_floats(reader, record.values, dip_track_value_count(track), &track->values) &&
        (track->values || track->width == 0);
    return ok || dip_pack_refuse(reader, "a track", index);
}

static bool read_moving_object(const DipPackReader *reader, uint64_t index,
                               DipMovingObject *object) {
    PackMovingObject record;
    dip_pack_read_record(reader, &reader->header.moving_objects, index, &record, sizeof record);
    *object = (DipMovingObject){.object = record.object, .rig = record.rig, .node = record.node};
    memcpy(object->offset, record.offset, sizeof object->offset);
    return true;
}

static bool read_moving_mesh(DipPackReader *reader, uint64_t index, DipMovingMesh *mesh) {
    PackMovingMesh record;
    const void *joints;
    dip_pack_read_record(reader, &reader->header.moving_meshes, index, &record, sizeof record);
    if (record.shape_count < 1 || record.shape_count > PACK_MAX_RECORDS) {
        return dip_pack_refuse(reader, "shapes of a moving mesh", index);
    }
    *mesh = (DipMovingMesh){.mesh = record.mesh,
                            .rig = record.rig,
                            .node = record.node,
                            .skin = record.skin,
                            .vertex_count = record.vertex_count,
                            .shape_count = (int)record.shape_count};
    const uint64_t rows = (uint64_t)record.shape_count * record.vertex_count;
    const uint64_t corners = 4 * (uint64_t)record.vertex_count;
    const bool ok =
        dip_pack_read_floats(reader, record.positions, 3 * rows, &mesh->positions) &&
        dip_pack_read_floats(reader, record.normals, 3 * rows, &mesh->normals) &&
        dip_pack_read_array(reader, record.joints, corners, sizeof *mesh->joints, &joints) &&
        dip_pack_read_floats(reader, record.joint_weights, corners, &mesh->joint_weights) &&
        dip_pack_read_floats(reader, record.box, 6, &mesh->box) && mesh->positions;
    mesh->joints = ok ? joints : NULL;
    return ok || dip_pack_refuse(reader, "a moving mesh", index);
}

static bool allocate_motion(const DipPackReader *reader, struct DipPackedMotion *motion) {
    const PackHeader *header = &reader->header;
    motion->rigs = calloc(header->rigs.count + 1, sizeof *motion->rigs);
    motion->nodes = calloc(header->nodes.count + 1, sizeof *motion->nodes);
    motion->skins = calloc(header->skins.count + 1, sizeof *motion->skins);
    motion->tracks = calloc(header->tracks.count + 1, sizeof *motion->tracks);
    motion->objects = calloc(header->moving_objects.count + 1, sizeof *motion->objects);
    motion->meshes = calloc(header->moving_meshes.count + 1, sizeof *motion->meshes);
    return (motion->rigs && motion->nodes && motion->skins && motion->tracks && motion->objects &&
            motion->meshes) ||
           dip_pack_out_of_memory(reader);
}

void dip_pack_free_motion(struct DipPackedMotion *motion) {
    if (motion) {
        free(motion->rigs);
        free(motion->nodes);
        free(motion->skins);
        free(motion->tracks);
        free(motion->objects);
        free(motion->meshes);
        free(motion);
    }
}

// Reads all records of a section with `read` into an array.
#define READ_ALL(section, read, array)                                                             \
    for (uint64_t i = 0; i < header->section.count; ++i) {                                         \
        if (!read(reader, i, (array) + i)) {                                                       \
            return false;                                                                          \
        }                                                                                          \
    }

static bool read_motion_parts(DipPackReader *reader, struct DipPackedMotion *motion) {
    const PackHeader *header = &reader->header;
    RigParts taken = {0};
    for (uint64_t i = 0; i < header->rigs.count; ++i) {
        if (!read_rig(reader, i, motion, &taken)) {
            return false;
        }
    }
    READ_ALL(nodes, read_node, motion->nodes)
    READ_ALL(skins, read_skin, motion->skins)
    READ_ALL(tracks, read_track, motion->tracks)
    READ_ALL(moving_objects, read_moving_object, motion->objects)
    READ_ALL(moving_meshes, read_moving_mesh, motion->meshes)
    motion->def = (DipMotionDef){.rigs = motion->rigs,
                                 .objects = motion->objects,
                                 .meshes = motion->meshes,
                                 .rig_count = (int)header->rigs.count,
                                 .object_count = (int)header->moving_objects.count,
                                 .mesh_count = (int)header->moving_meshes.count};
    return true;
}

bool dip_pack_read_motion(DipPackReader *reader, DipScenePack *pack) {
    const PackHeader *header = &reader->header;
    if (header->rigs.count == 0) {
        const bool empty = header->moving_objects.count == 0 && header->moving_meshes.count == 0;
        return empty || dip_pack_refuse(reader, "motion without rigs", 0);
    }
    pack->motion = calloc(1, sizeof *pack->motion);
    if (!pack->motion) {
        return dip_pack_out_of_memory(reader);
    }
    if (!allocate_motion(reader, pack->motion) || !read_motion_parts(reader, pack->motion)) {
        return false;
    }
    DipError fault;
    pack->scene.motion = &pack->motion->def;
    return dip_motion_check(&pack->scene, &fault) || dip_pack_refuse(reader, fault.message, 0);
}
