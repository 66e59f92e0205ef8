// Reads the animation that a glTF scene plays, and says which objects and meshes it moves.
#include "assets/gltf/scene.h"

#include <stdlib.h>
#include <string.h>

// --- the clip ------------------------------------------------------------------------------------

// Notes the names of the file's animations, and finds the one that plays, or DIP_NOT_FOUND. *name
// becomes its name.
static bool choose(DipGltfScene *scene, int *clip, const char **name) {
    DipGltfReader *reader = &scene->reader;
    const DipGltfItems *table = &reader->gltf.tables[DIP_GLTF_animations];
    const char **names = calloc((size_t)table->count + 1, sizeof *names);
    bool ok = names != NULL;
    for (int i = 0; ok && i < table->count; ++i) {
        names[i] = dip_gltf_name(reader, table->items[i], "animation", i);
        ok = names[i] && dip_model_note_clip(scene->model, names[i]);
    }
    *clip = ok ? dip_model_choose_clip(scene->model, names, table->count) : DIP_NOT_FOUND;
    *name = *clip >= 0 ? names[*clip] : NULL;
    free(names);
    return ok || dip_gltf_no_room(reader);
}

// Reads the animation that plays. If it cannot be read, warns, and the file stands still.
static bool read_clip(DipGltfScene *scene, int clip, const char *name, bool *is_read) {
    DipGltf *gltf = &scene->reader.gltf;
    DipError *err = gltf->err;
    DipError why = {0};
    gltf->err = &why;
    *is_read = dip_gltf_read_animation(&scene->reader, clip);
    gltf->err = err;
    if (!*is_read && why.origin == DIP_ORIGIN_RUNTIME) {
        if (err) {
            *err = why;
        }
        return false;
    }
    if (!*is_read) {
        dip_model_warn(scene->model, gltf->path, why.key,
                       "the animation \"%.60s\" is not played: %.150s", name, why.message);
    }
    return true;
}

// Marks the nodes that the tracks move, and those below them.
static void mark_moved(DipGltfScene *scene, const DipAnimationPlan *plan) {
    const DipAnimatedModel *from = scene->reader.model;
    for (int t = 0; t < plan->track_count; ++t) {
        const DipTrack *track = &plan->tracks[t];
        bool *marked =
            track->target == DIP_TRACK_WEIGHTS ? scene->changes_weights : scene->is_moved;
        marked[track->node] = true;
    }
    for (int n = 0; n < from->node_count; ++n) {
        const int parent = from->nodes[n].parent;
        scene->is_moved[n] =
            scene->is_moved[n] || (parent != DIP_NO_NODE && scene->is_moved[parent]);
    }
}

bool dip_gltf_scene_choose_clip(DipGltfScene *scene) {
    DipGltfReader *reader = &scene->reader;
    const size_t nodes = (size_t)reader->model->node_count;
    bool is_read = false;
    scene->clip = DIP_NOT_FOUND;
    scene->is_moved = dip_gltf_alloc(reader, nodes, sizeof *scene->is_moved);
    scene->changes_weights = dip_gltf_alloc(reader, nodes, sizeof *scene->changes_weights);
    if (!scene->is_moved || !scene->changes_weights) {
        return dip_gltf_no_room(reader);
    }
    int clip;
    const char *name;
    if (!choose(scene, &clip, &name) || (clip >= 0 && !read_clip(scene, clip, name, &is_read))) {
        return false;
    }
    if (is_read) {
        scene->clip = clip;
        mark_moved(scene, &reader->model->animation_plans[clip]);
    }
    return true;
}

bool dip_gltf_scene_keep_clip(DipGltfScene *scene) {
    const DipAnimatedModel *from = scene->reader.model;
    if (!scene->moves) {
        return true;
    }
    const DipAnimationPlan *plan = &from->animation_plans[scene->clip];
    DipMotionRig rig = {.clip = from->animations[scene->clip].name,
                        .duration_s = from->animations[scene->clip].duration_s,
                        .rig = dip_animated_rig(from),
                        .skins = from->skins,
                        .skin_count = from->skin_count,
                        .tracks = plan->tracks,
                        .track_count = plan->track_count};
    memcpy(rig.root, scene->root, sizeof rig.root);
    return dip_model_add_rig(scene->model, &rig) || dip_gltf_no_room(&scene->reader);
}

// --- what moves ----------------------------------------------------------------------------------

bool dip_gltf_scene_deforms(const DipGltfScene *scene, int object) {
    const DipAnimatedModel *from = scene->reader.model;
    const DipObjectPlan *plan = &from->plans[object];
    bool deforms = from->meshes[from->objects[object].mesh].shape_count > 1 &&
                   scene->changes_weights[plan->node];
    if (plan->skin != DIP_NO_SKIN) {
        const DipRigSkin *skin = &from->skins[plan->skin];
        for (int j = 0; !deforms && j < skin->joint_count; ++j) {
            deforms = scene->is_moved[skin->nodes[j]];
        }
    }
    return deforms;
}

bool dip_gltf_scene_move_object(DipGltfScene *scene, int object, const double offset[12]) {
    const DipObjectPlan *plan = &scene->reader.model->plans[object];
    if (plan->skin != DIP_NO_SKIN || !scene->is_moved[plan->node]) {
        return true; // A skin places its mesh itself.
    }
    DipMovingObject moving = {.object = scene->model->def.object_count - 1,
                              .rig = scene->model->motion.rig_count,
                              .node = plan->node};
    memcpy(moving.offset, offset, sizeof moving.offset);
    scene->moves = true;
    return dip_model_add_moving_object(scene->model, &moving) || dip_gltf_no_room(&scene->reader);
}

// Copies items for the vertices of a mesh of the scene: item vertices[i] of each shape, or item i
// if vertices is NULL.
static void *copy(DipGltfScene *scene, const void *from, size_t item_bytes, size_t shape_items,
                  int shape_count, const uint32_t *vertices, uint32_t count) {
    char *to = dip_model_alloc(scene->model, (size_t)shape_count * count, item_bytes);
    for (size_t s = 0; to && s < (size_t)shape_count; ++s) {
        const char *shape = (const char *)from + item_bytes * s * shape_items;
        for (size_t i = 0; i < count; ++i) {
            memcpy(to + item_bytes * (s * count + i),
                   shape + item_bytes * (vertices ? vertices[i] : i), item_bytes);
        }
    }
    return to;
}

bool dip_gltf_scene_move_mesh(DipGltfScene *scene, int object, int mesh, uint32_t count,
                              const uint32_t *vertices) {
    const DipAnimatedModel *from = scene->reader.model;
    const DipObjectPlan *plan = &from->plans[object];
    const DipAnimatedMesh *part = &from->meshes[from->objects[object].mesh];
    const bool skinned = plan->skin != DIP_NO_SKIN;
    DipMovingMesh moving = {.mesh = mesh,
                            .rig = scene->model->motion.rig_count,
                            .node = plan->node,
                            .skin = plan->skin,
                            .vertex_count = count,
                            .shape_count = part->shape_count};
    const size_t all = part->vertex_count;
    const int shapes = part->shape_count;
    moving.positions =
        copy(scene, part->positions, 3 * sizeof(float), all, shapes, vertices, count);
    if (!vertices) {
        moving.normals = copy(scene, part->normals, 3 * sizeof(float), all, shapes, NULL, count);
    }
    if (skinned) {
        moving.joints = copy(scene, part->joints, 4 * sizeof(uint16_t), all, 1, vertices, count);
        moving.joint_weights =
            copy(scene, part->joint_weights, 4 * sizeof(float), all, 1, vertices, count);
    }
    scene->moves = true;
    return (moving.positions && (vertices || moving.normals) &&
            (!skinned || (moving.joints && moving.joint_weights)) &&
            dip_model_add_moving_mesh(scene->model, &moving)) ||
           dip_gltf_no_room(&scene->reader);
}
