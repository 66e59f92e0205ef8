// The motion of a loaded model: the clips of its files, and the objects and meshes that the chosen
// ones move.
#include "assets/model_parts.h"

#include <string.h>

// Copies an array so that it lives as long as the model. A NULL stays NULL. Returns false when
// memory runs out.
static bool keep(DipModel *model, const void **array, size_t count, size_t item_bytes) {
    if (!*array) {
        return true;
    }
    void *copy = dip_model_alloc(model, count, item_bytes);
    if (copy) {
        memcpy(copy, *array, count * item_bytes);
    }
    *array = copy;
    return copy != NULL;
}

#define KEEP(model, array, count)                                                                  \
    keep(model, (const void **)&(array), (size_t)(count), sizeof *(array))

// --- clips ---------------------------------------------------------------------------------------

bool dip_model_note_clip(DipModel *model, const char *name) {
    for (int i = 0; i < model->clip_count; ++i) {
        if (strcmp(model->clips[i], name) == 0) {
            return true;
        }
    }
    const char **clips = dip_array_grow(model->clips, model->clip_count, sizeof *clips);
    model->clips = clips ? clips : model->clips;
    model->clip_names = model->clips;
    char *copy = dip_model_copy_text(model, name);
    if (!clips || !copy) {
        return false;
    }
    dip_make_one_line(copy);
    clips[model->clip_count++] = copy;
    return true;
}

int dip_model_choose_clip(const DipModel *model, const char *const *names, int count) {
    if (model->animation == DIP_MODEL_ANIMATION_FIRST && count > 0) {
        return 0;
    }
    for (int i = 0; model->animation == DIP_MODEL_ANIMATION_NAMED && i < count; ++i) {
        if (strcmp(names[i], model->animation_name) == 0) {
            return i;
        }
    }
    return DIP_NOT_FOUND;
}

bool dip_model_check_animation(const DipModel *model, DipError *err) {
    DipNameList list = {.text = "none"};
    if (model->animation != DIP_MODEL_ANIMATION_NAMED) {
        return true;
    }
    for (int i = 0; i < model->clip_count; ++i) {
        if (strcmp(model->clips[i], model->animation_name) == 0) {
            return true;
        }
        dip_name_list_add(&list, model->clips[i]);
    }
    return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, DIP_MODEL_ANIMATION_KEY,
                         "'%.60s' is not an animation of the models, accepted %s%s",
                         model->animation_name, dip_name_list_end(&list),
                         list.left_out > 0 ? "; diptych path info MODEL lists all" : "");
}

// --- the motion ----------------------------------------------------------------------------------

bool dip_model_add_rig(DipModel *model, const DipMotionRig *rig) {
    DipMotionRig *rigs = dip_array_grow(model->rigs, model->motion.rig_count, sizeof *rigs);
    model->rigs = rigs ? rigs : model->rigs;
    if (!rigs) {
        return false;
    }
    DipMotionRig kept = *rig;
    kept.is_held = model->animation_is_held;
    kept.held_s = model->animation_held_s;
    kept.clip = dip_model_copy_text(model, rig->clip);
    bool ok = kept.clip && KEEP(model, kept.rig.nodes, kept.rig.node_count) &&
              KEEP(model, kept.rig.rest_weights, kept.rig.weight_count) &&
              KEEP(model, kept.skins, kept.skin_count) &&
              KEEP(model, kept.tracks, kept.track_count);
    for (int s = 0; ok && s < kept.skin_count; ++s) {
        DipRigSkin *skin = (DipRigSkin *)&kept.skins[s];
        ok = KEEP(model, skin->nodes, skin->joint_count) &&
             KEEP(model, skin->inverse_binds, 12 * (size_t)skin->joint_count);
    }
    for (int t = 0; ok && t < kept.track_count; ++t) {
        DipTrack *track = (DipTrack *)&kept.tracks[t];
        ok = KEEP(model, track->times, track->key_count) &&
             KEEP(model, track->values, dip_track_value_count(track));
    }
    rigs[model->motion.rig_count++] = kept;
    return ok;
}

bool dip_model_add_moving_object(DipModel *model, const DipMovingObject *object) {
    DipMovingObject *objects =
        dip_array_grow(model->moving_objects, model->motion.object_count, sizeof *objects);
    model->moving_objects = objects ? objects : model->moving_objects;
    if (objects) {
        objects[model->motion.object_count++] = *object;
    }
    return objects != NULL;
}

bool dip_model_add_moving_mesh(DipModel *model, const DipMovingMesh *mesh) {
    DipMovingMesh *meshes =
        dip_array_grow(model->moving_meshes, model->motion.mesh_count, sizeof *meshes);
    model->moving_meshes = meshes ? meshes : model->moving_meshes;
    if (meshes) {
        meshes[model->motion.mesh_count++] = *mesh;
    }
    return meshes != NULL;
}

bool dip_model_finish_motion(DipModel *model) {
    DipMotionDef *motion = &model->motion;
    motion->rigs = model->rigs;
    motion->objects = model->moving_objects;
    motion->meshes = model->moving_meshes;
    if (motion->object_count == 0 && motion->mesh_count == 0) {
        return true;
    }
    model->def.motion = motion;
    float(*boxes)[6] = dip_model_alloc(model, (size_t)motion->mesh_count, sizeof *boxes);
    const bool bounded = boxes && dip_motion_bound_meshes(motion, boxes);
    for (int m = 0; bounded && m < motion->mesh_count; ++m) {
        model->moving_meshes[m].box = boxes[m][0] <= boxes[m][3] ? boxes[m] : NULL;
    }
    return bounded;
}

// --- flat shading --------------------------------------------------------------------------------

// Copies the values of the corners in each of several shapes, `width` items each.
static bool unshare(DipModel *model, const void **values, const uint32_t *indices, uint32_t count,
                    size_t item_bytes, size_t shapes, size_t shape_items) {
    const char *from = *values;
    if (!from) {
        return true;
    }
    char *to = dip_model_alloc(model, shapes * count, item_bytes);
    *values = to;
    for (size_t s = 0; to && s < shapes; ++s) {
        for (size_t i = 0; i < count; ++i) {
            memcpy(to + item_bytes * (s * count + i),
                   from + item_bytes * (s * shape_items + indices[i]), item_bytes);
        }
    }
    return to != NULL;
}

bool dip_model_flatten_motion(DipModel *model, int mesh, const uint32_t *indices, uint32_t count) {
    DipMovingMesh *moving = NULL;
    for (int i = 0; i < model->motion.mesh_count; ++i) {
        moving = model->moving_meshes[i].mesh == mesh ? &model->moving_meshes[i] : moving;
    }
    if (!moving) {
        return true;
    }
    const size_t shapes = (size_t)moving->shape_count;
    const size_t vertices = moving->vertex_count;
    moving->normals = NULL; // Those of the triangles.
    moving->vertex_count = count;
    return unshare(model, (const void **)&moving->positions, indices, count, 3 * sizeof(float),
                   shapes, vertices) &&
           unshare(model, (const void **)&moving->joints, indices, count, 4 * sizeof(uint16_t), 1,
                   vertices) &&
           unshare(model, (const void **)&moving->joint_weights, indices, count, 4 * sizeof(float),
                   1, vertices);
}
