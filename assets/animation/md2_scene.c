// Lets the key frames of an MD2 file play in a scene. assimp reads the file's material; the shapes
// of all frames come from the reader of animated models.
//
// A clip becomes a mesh that changes its shape: its shape 0 is empty, and each key frame is a morph
// target. A track weighs the targets, so that two neighbouring frames blend.
#include "assets/animation/animation_parts.h"

#include <stdio.h>
#include <string.h>

// --- which clip plays ----------------------------------------------------------------------------

// Notes the names of the file's animations. Frames whose names are digits only form an animation
// without a name, which gets one. *clip becomes the animation that plays, or DIP_NOT_FOUND.
static bool choose(DipModel *model, DipAnimatedModel *frames, int *clip) {
    const int count = frames->def.animation_count;
    const char **names = dip_animated_alloc(frames, (size_t)count, sizeof *names);
    bool ok = names != NULL;
    for (int i = 0; ok && i < count; ++i) {
        DipAnimation *animation = &frames->animations[i];
        char made[32];
        snprintf(made, sizeof made, "animation %d", i);
        if (!animation->name[0]) {
            animation->name = dip_animated_text(frames, made, sizeof made);
        }
        names[i] = animation->name;
        ok = names[i] && dip_model_note_clip(model, names[i]);
    }
    *clip = ok ? dip_model_choose_clip(model, names, count) : DIP_NOT_FOUND;
    return ok;
}

bool dip_model_read_key_frames(DipModel *model, DipModelFile *file, DipError *err) {
    DipError why = {0};
    DipAnimatedModel *frames = dip_animated_model_make(file->path);
    if (!frames) {
        return dip_model_out_of_memory(err, file->path);
    }
    const char *skin;
    int clip = DIP_NOT_FOUND;
    bool ok = dip_md2_read(frames, &skin, &why);
    if (ok) {
        ok = choose(model, frames, &clip) || dip_animated_no_room(frames, &why);
    }
    if (!ok && why.origin != DIP_ORIGIN_RUNTIME) {
        dip_model_warn(model, file->path, why.key, "the key frames are not played: %.150s",
                       why.message);
        ok = true;
    }
    file->clip = clip;
    if (clip >= 0) {
        file->key_frames = frames;
    } else {
        dip_animated_model_destroy(&frames);
    }
    if (!ok && err) {
        *err = why;
    }
    return ok;
}

// --- the mesh ------------------------------------------------------------------------------------

// Copies floats behind `before` zeros. NULL counts as zeros.
static float *copy(DipModel *model, const float *from, size_t count, size_t before) {
    float *to = dip_model_alloc(model, before + count, sizeof *to);
    if (to && from) {
        memcpy(to + before, from, count * sizeof *to);
    }
    return to;
}

// Copies the values of the clip's first `frames` frames.
static float *copy_frames(DipModel *model, const DipModelFile *file, const float *values,
                          int frames, int empty_shapes) {
    const size_t floats = 3 * (size_t)file->key_frames->meshes[0].vertex_count;
    const int first = file->key_frames->animation_plans[file->clip].first_frame;
    return copy(model, values + floats * (size_t)first, floats * (size_t)frames,
                floats * (size_t)empty_shapes);
}

// Adds a rig of one node, whose track gives each frame the weight 1 at its time. After the last
// frame the first one follows.
static bool add_rig(DipModel *model, DipModelFile *file, const double root[12]) {
    DipAnimatedModel *from = file->key_frames;
    const size_t frames = (size_t)from->animation_plans[file->clip].frame_count;
    const DipAnimation *animation = &from->animations[file->clip];
    float *rest = dip_animated_alloc(from, frames, sizeof *rest);
    float *times = dip_animated_alloc(from, frames + 1, sizeof *times);
    float *values = dip_animated_alloc(from, (frames + 1) * frames, sizeof *values);
    if (!rest || !times || !values) {
        return false;
    }
    rest[0] = 1.0f;
    for (size_t i = 0; i <= frames; ++i) {
        times[i] = (float)(animation->duration_s * (double)i / (double)frames);
        values[i * frames + i % frames] = 1.0f;
    }
    from->nodes[0].weight_count = (int)frames;
    from->rest_weights = rest;
    from->weight_count = (int)frames;
    const DipTrack track = {.target = DIP_TRACK_WEIGHTS,
                            .interpolation = DIP_INTERPOLATION_LINEAR,
                            .width = (int)frames,
                            .key_count = (uint32_t)frames + 1,
                            .times = times,
                            .values = values};
    DipMotionRig rig = {.clip = animation->name,
                        .duration_s = animation->duration_s,
                        .rig = dip_animated_rig(from),
                        .tracks = &track,
                        .track_count = 1};
    memcpy(rig.root, root, sizeof rig.root);
    return dip_model_add_rig(model, &rig);
}

// Lets a mesh play the clip.
static bool move_mesh(DipModel *model, DipModelFile *file, int mesh, const double root[12]) {
    const DipAnimatedMesh *from = &file->key_frames->meshes[0];
    const int frames = file->key_frames->animation_plans[file->clip].frame_count;
    const DipMovingMesh moving = {.mesh = mesh,
                                  .rig = model->motion.rig_count,
                                  .skin = DIP_NO_SKIN,
                                  .vertex_count = from->vertex_count,
                                  .shape_count = 1 + frames,
                                  .positions = copy_frames(model, file, from->positions, frames, 1),
                                  .normals = copy_frames(model, file, from->normals, frames, 1)};
    return moving.positions && moving.normals && dip_model_add_moving_mesh(model, &moving) &&
           add_rig(model, file, root);
}

int dip_model_key_frame_mesh(DipModel *model, int index, unsigned source, int material,
                             const double root[12], DipError *err) {
    DipModelFile *file = &model->files[index];
    const DipMaterialPlan *surface = &model->plans[material];
    const DipAnimatedMesh *from = &file->key_frames->meshes[0];
    const size_t coordinates = 2 * (size_t)from->vertex_count;
    uint32_t *indices = dip_model_alloc(model, from->index_count, sizeof *indices);
    const DipMeshDef def = {.name = dip_model_copy_text(model, from->name),
                            .vertex_count = from->vertex_count,
                            .positions = copy_frames(model, file, from->positions, 1, 0),
                            .normals = copy_frames(model, file, from->normals, 1, 0),
                            .uv0 = surface->has_uv0 ? copy(model, from->uv0, coordinates, 0) : NULL,
                            .uv1 = surface->has_uv1 ? copy(model, from->uv0, coordinates, 0) : NULL,
                            .index_count = from->index_count,
                            .indices = indices,
                            .material = material};
    const DipMeshKey key = {index, source, material, DIP_NOT_FOUND};
    const bool moves = file->key_frames->animation_plans[file->clip].frame_count > 1;
    int mesh = DIP_NOT_FOUND;
    if (def.name && def.positions && def.normals && indices && (def.uv0 || !surface->has_uv0) &&
        (def.uv1 || !surface->has_uv1)) {
        memcpy(indices, from->indices, from->index_count * sizeof *indices);
        mesh = dip_model_add_mesh(model, &def, &key);
    }
    if (mesh < 0 || (moves && !move_mesh(model, file, mesh, root))) {
        dip_animated_no_room(file->key_frames, err);
        return DIP_NOT_FOUND;
    }
    return mesh;
}
