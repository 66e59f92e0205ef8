// Writes scene packs. Arrays are written straight from the scene to the file, so the only copies
// in memory are those of the records, which are small.
#include "assets/pack/scene_pack.h"
#include "assets/pack/scene_pack_layout.h"
#include "renderer/scene/motion.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct Writer {
    int file;
    uint64_t end; // Where the next array or section begins, in bytes from the start of the pack.
    char *text;   // The section of text.
    size_t text_bytes;
    size_t text_capacity;
    PackHeader header;
} Writer;

static bool write_at(int file, uint64_t offset, const void *bytes, size_t size_bytes) {
    const char *from = bytes;
    while (size_bytes > 0) {
        const ssize_t count = pwrite(file, from, size_bytes, (off_t)offset);
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count <= 0) {
            return false;
        }
        from += count;
        offset += (uint64_t)count;
        size_bytes -= (size_t)count;
    }
    return true;
}

static PackHeader header_of(DipImportStage stage, int file_index) {
    PackHeader header = {.version = PACK_VERSION,
                         .header_bytes = sizeof header,
                         .stage = stage,
                         .file_index = (uint32_t)file_index};
    memcpy(header.magic, pack_magic, sizeof header.magic);
    return header;
}

bool dip_scene_pack_note(int pack_file, DipImportStage stage, int file_index) {
    const PackHeader header = header_of(stage, file_index);
    return write_at(pack_file, 0, &header, sizeof header);
}

// Appends an array and sets *offset to its place. A NULL array gets the offset 0.
static bool add_array(Writer *writer, const void *bytes, size_t size_bytes, uint64_t *offset) {
    *offset = bytes ? writer->end : 0;
    if (!bytes) {
        return true;
    }
    const uint64_t end = writer->end + size_bytes;
    writer->end = (end + PACK_ALIGNMENT - 1) / PACK_ALIGNMENT * PACK_ALIGNMENT;
    return write_at(writer->file, *offset, bytes, size_bytes);
}

// Appends a text to the section of text and sets *offset to its place there.
static bool add_text(Writer *writer, const char *text, uint64_t *offset) {
    const size_t size_bytes = strlen(text) + 1;
    if (writer->text_capacity - writer->text_bytes < size_bytes) {
        const size_t capacity = 2 * writer->text_capacity + size_bytes + 4096;
        char *grown = realloc(writer->text, capacity);
        if (!grown) {
            return false;
        }
        writer->text = grown;
        writer->text_capacity = capacity;
    }
    memcpy(writer->text + writer->text_bytes, text, size_bytes);
    *offset = writer->text_bytes;
    writer->text_bytes += size_bytes;
    return true;
}

// Appends a section of records.
static bool add_section(Writer *writer, const void *records, uint64_t count, size_t record_bytes,
                        PackSection *section) {
    section->count = count;
    return add_array(writer, records, (size_t)count * record_bytes, &section->offset);
}

static bool add_textures(Writer *writer, const DipSceneDef *scene) {
    const size_t count = (size_t)scene->texture_count;
    PackTexture *records = calloc(count + 1, sizeof *records);
    bool ok = records != NULL;
    for (size_t i = 0; ok && i < count; ++i) {
        const DipTextureDef *def = &scene->textures[i];
        records[i] = (PackTexture){.width = def->width,
                                   .height = def->height,
                                   .encoding = def->encoding,
                                   .wrap_u = def->wrap_u,
                                   .wrap_v = def->wrap_v};
        ok = add_text(writer, def->name, &records[i].name) &&
             add_array(writer, def->rgba8, 4 * (size_t)def->width * (size_t)def->height,
                       &records[i].rgba8);
    }
    ok = ok && add_section(writer, records, count, sizeof *records, &writer->header.textures);
    free(records);
    return ok;
}

static PackPbr pbr_of(const DipPbrDef *def) {
    PackPbr record = {.metallic = def->metallic,
                      .roughness = def->roughness,
                      .f90 = def->f90,
                      .metal_rough_map = def->metal_rough_map,
                      .occlusion_map = def->occlusion_map,
                      .maps_at_uv1 =
                          (def->occlusion_at_uv1 ? 1U : 0U) | (def->emission_at_uv1 ? 2U : 0U),
                      .occlusion_strength = def->occlusion_strength,
                      .emission_map = def->emission_map,
                      .normal_scale = def->normal_scale,
                      .coat = def->coat,
                      .coat_roughness = def->coat_roughness,
                      .sheen_roughness = def->sheen_roughness,
                      .transmission = def->transmission,
                      .scattering = def->scattering};
    memcpy(record.sheen_lin, def->sheen_lin, sizeof record.sheen_lin);
    memcpy(record.f0_lin, def->f0_lin, sizeof record.f0_lin);
    memcpy(record.emission_lin, def->emission_lin, sizeof record.emission_lin);
    return record;
}

static bool add_materials(Writer *writer, const DipSceneDef *scene) {
    const size_t count = (size_t)scene->material_count;
    PackMaterial *records = calloc(count + 1, sizeof *records);
    bool ok = records != NULL;
    for (size_t i = 0; ok && i < count; ++i) {
        const DipMaterialDef *def = &scene->materials[i];
        records[i] = (PackMaterial){.surface = def->surface,
                                    .colour_texture = def->colour_texture,
                                    .light_map = def->light_map,
                                    .normal_map = def->normal_map,
                                    .light_map_scale = def->light_map_scale,
                                    .roughness = def->roughness,
                                    .alpha_cutoff = def->alpha_cutoff,
                                    .shininess = def->shininess,
                                    .double_sided = def->double_sided,
                                    .lit = def->lit,
                                    .opacity = def->opacity,
                                    .transmission = def->transmission,
                                    .has_pbr = def->pbr != NULL};
        if (def->pbr) {
            records[i].pbr = pbr_of(def->pbr);
        }
        memcpy(records[i].base_colour_lin, def->base_colour_lin, sizeof def->base_colour_lin);
        memcpy(records[i].specular_lin, def->specular_lin, sizeof def->specular_lin);
        ok = add_text(writer, def->name, &records[i].name);
    }
    ok = ok && add_section(writer, records, count, sizeof *records, &writer->header.materials);
    free(records);
    return ok;
}

static bool add_mesh(Writer *writer, const DipMeshDef *def, PackMesh *record) {
    const size_t row = (size_t)def->vertex_count * sizeof(float);
    *record = (PackMesh){.vertex_count = def->vertex_count,
                         .index_count = def->index_count,
                         .material = def->material};
    return add_text(writer, def->name, &record->name) &&
           add_array(writer, def->positions, 3 * row, &record->positions) &&
           add_array(writer, def->normals, 3 * row, &record->normals) &&
           add_array(writer, def->uv0, 2 * row, &record->uv0) &&
           add_array(writer, def->uv1, 2 * row, &record->uv1) &&
           add_array(writer, def->colours_lin, 3 * row, &record->colours_lin) &&
           add_array(writer, def->alphas, row, &record->alphas) &&
           add_array(writer, def->indices, (size_t)def->index_count * sizeof *def->indices,
                     &record->indices);
}

static bool add_meshes(Writer *writer, const DipSceneDef *scene) {
    const size_t count = (size_t)scene->mesh_count;
    PackMesh *records = calloc(count + 1, sizeof *records);
    bool ok = records != NULL;
    for (size_t i = 0; ok && i < count; ++i) {
        ok = add_mesh(writer, &scene->meshes[i], &records[i]);
    }
    ok = ok && add_section(writer, records, count, sizeof *records, &writer->header.meshes);
    free(records);
    return ok;
}

static bool add_objects(Writer *writer, const DipSceneDef *scene) {
    const size_t count = (size_t)scene->object_count;
    PackObject *records = calloc(count + 1, sizeof *records);
    bool ok = records != NULL;
    for (size_t i = 0; ok && i < count; ++i) {
        const DipObjectDef *def = &scene->objects[i];
        records[i].mesh = def->mesh;
        memcpy(records[i].transform, def->transform, sizeof def->transform);
        ok = add_text(writer, def->name, &records[i].name);
    }
    ok = ok && add_section(writer, records, count, sizeof *records, &writer->header.objects);
    free(records);
    return ok;
}

static bool add_lights(Writer *writer, const DipLightingDef *lighting) {
    const size_t count = lighting ? (size_t)lighting->light_count : 0;
    PackLight *records = calloc(count + 1, sizeof *records);
    bool ok = records != NULL;
    for (size_t i = 0; ok && i < count; ++i) {
        const DipLightDef *def = &lighting->lights[i];
        records[i] = (PackLight){.kind = def->kind,
                                 .range_m = def->range_m,
                                 .inner_deg = def->inner_deg,
                                 .outer_deg = def->outer_deg};
        memcpy(records[i].colour_lin, def->colour_lin, sizeof def->colour_lin);
        memcpy(records[i].position_world, def->position_world, sizeof def->position_world);
        memcpy(records[i].direction_world, def->direction_world, sizeof def->direction_world);
        memcpy(records[i].attenuation, def->attenuation, sizeof def->attenuation);
        ok = add_text(writer, def->name ? def->name : "", &records[i].name);
    }
    ok = ok && add_section(writer, records, count, sizeof *records, &writer->header.lights);
    free(records);
    if (count > 0) {
        memcpy(writer->header.ambient_lin, lighting->ambient_lin, sizeof lighting->ambient_lin);
        memcpy(writer->header.sky_lin, lighting->sky_lin, sizeof lighting->sky_lin);
        writer->header.shading = lighting->shading;
    }
    return ok;
}

static bool add_nodes(Writer *writer, const DipMotionDef *motion, size_t count) {
    PackNode *records = calloc(count + 1, sizeof *records);
    size_t to = 0;
    for (int r = 0; records && r < motion->rig_count; ++r) {
        const DipRig *rig = &motion->rigs[r].rig;
        for (int n = 0; n < rig->node_count; ++n) {
            const DipRigNode *node = &rig->nodes[n];
            PackNode *record = &records[to++];
            *record = (PackNode){.parent = node->parent,
                                 .has_matrix = node->has_matrix,
                                 .first_weight = node->first_weight,
                                 .weight_count = node->weight_count};
            memcpy(record->matrix, node->matrix, sizeof record->matrix);
            memcpy(record->translation, node->translation, sizeof record->translation);
            memcpy(record->rotation, node->rotation, sizeof record->rotation);
            memcpy(record->scale, node->scale, sizeof record->scale);
        }
    }
    const bool ok =
        records && add_section(writer, records, count, sizeof *records, &writer->header.nodes);
    free(records);
    return ok;
}

static bool add_skins(Writer *writer, const DipMotionDef *motion, size_t count) {
    PackSkin *records = calloc(count + 1, sizeof *records);
    bool ok = records != NULL;
    size_t to = 0;
    for (int r = 0; r < motion->rig_count; ++r) {
        for (int s = 0; ok && s < motion->rigs[r].skin_count; ++s) {
            const DipRigSkin *skin = &motion->rigs[r].skins[s];
            const size_t joints = (size_t)skin->joint_count;
            PackSkin *record = &records[to++];
            record->joint_count = (uint32_t)skin->joint_count;
            ok = add_array(writer, skin->nodes, joints * sizeof *skin->nodes, &record->nodes) &&
                 add_array(writer, skin->inverse_binds, joints * 12 * sizeof *skin->inverse_binds,
                           &record->inverse_binds);
        }
    }
    ok = ok && add_section(writer, records, count, sizeof *records, &writer->header.skins);
    free(records);
    return ok;
}

static bool add_tracks(Writer *writer, const DipMotionDef *motion, size_t count) {
    PackTrack *records = calloc(count + 1, sizeof *records);
    bool ok = records != NULL;
    size_t to = 0;
    for (int r = 0; r < motion->rig_count; ++r) {
        for (int t = 0; ok && t < motion->rigs[r].track_count; ++t) {
            const DipTrack *track = &motion->rigs[r].tracks[t];
            PackTrack *record = &records[to++];
            *record = (PackTrack){.target = track->target,
                                  .interpolation = track->interpolation,
                                  .node = track->node,
                                  .width = track->width,
                                  .key_count = track->key_count};
            ok = add_array(writer, track->times, track->key_count * sizeof *track->times,
                           &record->times) &&
                 add_array(writer, track->values,
                           dip_track_value_count(track) * sizeof *track->values, &record->values);
        }
    }
    ok = ok && add_section(writer, records, count, sizeof *records, &writer->header.tracks);
    free(records);
    return ok;
}

static bool add_rigs(Writer *writer, const DipMotionDef *motion) {
    const size_t count = (size_t)motion->rig_count;
    PackRig *records = calloc(count + 1, sizeof *records);
    bool ok = records != NULL;
    size_t nodes = 0;
    size_t skins = 0;
    size_t tracks = 0;
    for (size_t i = 0; ok && i < count; ++i) {
        const DipMotionRig *rig = &motion->rigs[i];
        records[i] = (PackRig){.duration_s = rig->duration_s,
                               .held_s = rig->held_s,
                               .is_held = rig->is_held,
                               .node_count = (uint32_t)rig->rig.node_count,
                               .skin_count = (uint32_t)rig->skin_count,
                               .track_count = (uint32_t)rig->track_count,
                               .weight_count = (uint32_t)rig->rig.weight_count};
        memcpy(records[i].root, rig->root, sizeof rig->root);
        ok = add_text(writer, rig->clip, &records[i].clip) &&
             add_array(writer, rig->rig.rest_weights,
                       (size_t)rig->rig.weight_count * sizeof *rig->rig.rest_weights,
                       &records[i].rest_weights);
        nodes += (size_t)rig->rig.node_count;
        skins += (size_t)rig->skin_count;
        tracks += (size_t)rig->track_count;
    }
    ok = ok && add_section(writer, records, count, sizeof *records, &writer->header.rigs) &&
         add_nodes(writer, motion, nodes) && add_skins(writer, motion, skins) &&
         add_tracks(writer, motion, tracks);
    free(records);
    return ok;
}

static bool add_moving_objects(Writer *writer, const DipMotionDef *motion) {
    const size_t count = (size_t)motion->object_count;
    PackMovingObject *records = calloc(count + 1, sizeof *records);
    for (size_t i = 0; records && i < count; ++i) {
        const DipMovingObject *object = &motion->objects[i];
        records[i] =
            (PackMovingObject){.object = object->object, .rig = object->rig, .node = object->node};
        memcpy(records[i].offset, object->offset, sizeof object->offset);
    }
    const bool ok = records && add_section(writer, records, count, sizeof *records,
                                           &writer->header.moving_objects);
    free(records);
    return ok;
}

static bool add_moving_mesh(Writer *writer, const DipMovingMesh *mesh, PackMovingMesh *record) {
    const size_t vertices = mesh->vertex_count;
    const size_t rows = vertices * (size_t)mesh->shape_count;
    *record = (PackMovingMesh){.mesh = mesh->mesh,
                               .rig = mesh->rig,
                               .node = mesh->node,
                               .skin = mesh->skin,
                               .vertex_count = mesh->vertex_count,
                               .shape_count = (uint32_t)mesh->shape_count};
    return add_array(writer, mesh->positions, 3 * rows * sizeof(float), &record->positions) &&
           add_array(writer, mesh->normals, 3 * rows * sizeof(float), &record->normals) &&
           add_array(writer, mesh->joints, 4 * vertices * sizeof(uint16_t), &record->joints) &&
           add_array(writer, mesh->joint_weights, 4 * vertices * sizeof(float),
                     &record->joint_weights) &&
           add_array(writer, mesh->box, 6 * sizeof(float), &record->box);
}

static bool add_moving_meshes(Writer *writer, const DipMotionDef *motion) {
    const size_t count = (size_t)motion->mesh_count;
    PackMovingMesh *records = calloc(count + 1, sizeof *records);
    bool ok = records != NULL;
    for (size_t i = 0; ok && i < count; ++i) {
        ok = add_moving_mesh(writer, &motion->meshes[i], &records[i]);
    }
    ok = ok && add_section(writer, records, count, sizeof *records, &writer->header.moving_meshes);
    free(records);
    return ok;
}

static bool add_motion(Writer *writer, const DipMotionDef *motion) {
    static const DipMotionDef nothing;
    motion = motion ? motion : &nothing;
    return add_rigs(writer, motion) && add_moving_objects(writer, motion) &&
           add_moving_meshes(writer, motion);
}

static bool add_clips(Writer *writer, const char *const *clips, size_t count) {
    PackClip *records = calloc(count + 1, sizeof *records);
    bool ok = records != NULL;
    for (size_t i = 0; ok && i < count; ++i) {
        ok = add_text(writer, clips[i], &records[i].name);
    }
    ok = ok && add_section(writer, records, count, sizeof *records, &writer->header.clips);
    free(records);
    return ok;
}

static bool add_errors(Writer *writer, const DipError *errors, size_t count, PackSection *section) {
    PackError *records = calloc(count + 1, sizeof *records);
    for (size_t i = 0; records && i < count; ++i) {
        const DipError *error = &errors[i];
        records[i] = (PackError){.code = error->code,
                                 .origin = error->origin,
                                 .severity = error->severity,
                                 .line = error->line};
        memcpy(records[i].file, error->file, sizeof error->file);
        memcpy(records[i].key, error->key, sizeof error->key);
        memcpy(records[i].message, error->message, sizeof error->message);
    }
    const bool ok = records && add_section(writer, records, count, sizeof *records, section);
    free(records);
    return ok;
}

static bool write_scene(Writer *writer, const DipSceneDef *scene) {
    PackHeader *header = &writer->header;
    memcpy(header->background_lin, scene->background_lin, sizeof header->background_lin);
    header->near_m = scene->near_m;
    return add_textures(writer, scene) && add_materials(writer, scene) &&
           add_meshes(writer, scene) && add_objects(writer, scene) &&
           add_lights(writer, scene->lighting) && add_motion(writer, scene->motion);
}

static bool write_all(Writer *writer, const DipScenePack *pack) {
    PackHeader *header = &writer->header;
    static const DipSceneDef nothing = {.near_m = 1.0f};
    const bool failed = pack->failure.code != DIP_ERROR_NONE;
    uint64_t empty;
    header->import_ms = pack->times.import_ms;
    header->pictures_ms = pack->times.pictures_ms;
    if (!write_scene(writer, failed ? &nothing : &pack->scene) ||
        !add_clips(writer, pack->clips, (size_t)pack->clip_count) ||
        !add_errors(writer, pack->warnings.items, pack->warnings.count, &header->warnings) ||
        !add_errors(writer, &pack->failure, failed, &header->failures) ||
        !add_text(writer, "", &empty) ||
        !add_section(writer, writer->text, writer->text_bytes, 1, &header->text)) {
        return false;
    }
    header->total_bytes = writer->end;
    return ftruncate(writer->file, (off_t)writer->end) == 0 &&
           write_at(writer->file, 0, header, sizeof *header);
}

bool dip_scene_pack_write(int pack_file, const DipScenePack *pack) {
    Writer writer = {.file = pack_file,
                     .end = (sizeof(PackHeader) + PACK_ALIGNMENT - 1) / PACK_ALIGNMENT *
                            PACK_ALIGNMENT,
                     .header = header_of(DIP_IMPORT_DONE, 0)};
    const bool ok = write_all(&writer, pack);
    free(writer.text);
    return ok;
}
