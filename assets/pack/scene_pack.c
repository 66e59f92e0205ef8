// Reads scene packs and checks every value in them.
#include "assets/pack/scene_pack.h"

#include "assets/model_parts.h"
#include "assets/pack/scene_pack_layout.h"
#include "renderer/base/assert.h"
#include "renderer/base/fp_mode.h"
#include "renderer/scene/motion.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct Reader {
    const uint8_t *bytes;
    uint64_t size_bytes;
    PackHeader header;
    uint64_t arrays_end; // End of the last array, in bytes. The next array begins here or later.
    DipError *err;
    DipPbrDef *pbrs; // One for each material.
} Reader;

// The lighting that a scene's `lighting` points to. `def` comes first, so that both have the same
// address.
typedef struct PackedLighting {
    DipLightingDef def;
    DipLightDef lights[DIP_MAX_LIGHTS];
} PackedLighting;

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

// --- reporting faults ----------------------------------------------------------------------------

static bool refuse(const Reader *reader, const char *what, uint64_t index) {
    return dip_error_set(reader->err, DIP_ERROR_FORMAT, NULL, 0, NULL,
                         "the importer's result is malformed: %s (item %llu)", what,
                         (unsigned long long)index);
}

static bool out_of_memory(const Reader *reader) {
    return dip_error_set(reader->err, DIP_ERROR_MEMORY, NULL, 0, NULL, "out of memory");
}

// --- values --------------------------------------------------------------------------------------

// True if no float is infinite or NaN. Tests the exponents as integers, which compilers vectorise.
static bool all_finite(const void *floats, uint64_t count) {
    const uint32_t exponent = 0x7f800000;
    const uint8_t *bytes = floats;
    uint32_t found = 0;
    for (uint64_t i = 0; i < count; ++i) {
        uint32_t bits;
        memcpy(&bits, bytes + sizeof bits * i, sizeof bits);
        found |= (bits & exponent) == exponent;
    }
    return !found;
}

static bool within_unit(float value) {
    return value >= 0.0f && value <= 1.0f;
}

// True for three channels of light.
static bool are_light(const float lin[3]) {
    bool ok = true;
    for (int c = 0; c < 3; ++c) {
        ok = ok && lin[c] >= 0.0f && lin[c] <= DIP_MAX_LIGHT_LIN;
    }
    return ok;
}

static bool is_boolean(uint32_t value) {
    return value <= 1;
}

// True for DIP_NO_TEXTURE and for the index of a texture.
static bool is_texture(const Reader *reader, int32_t index) {
    return index >= DIP_NO_TEXTURE &&
           (index < 0 || (uint64_t)index < reader->header.textures.count);
}

// Reads record `index` of a section.
static void read_record(const Reader *reader, const PackSection *section, uint64_t index,
                        void *record, size_t record_bytes) {
    memcpy(record, reader->bytes + section->offset + index * record_bytes, record_bytes);
}

// Finds a text. The section of text ends with a zero byte (check_sections), so every text ends.
static bool read_text(const Reader *reader, uint64_t offset, const char **text) {
    const bool inside = offset < reader->header.text.count;
    *text = inside ? (const char *)reader->bytes + reader->header.text.offset + offset : NULL;
    return inside;
}

// Finds an array. The offset 0 gives NULL. Counts and item sizes are below 2^33, so that their
// product does not overflow.
static bool read_array(Reader *reader, uint64_t offset, uint64_t count, uint64_t item_bytes,
                       const void **array) {
    *array = NULL;
    if (offset == 0) {
        return true;
    }
    const uint64_t size = reader->size_bytes;
    if (offset % PACK_ALIGNMENT != 0 || offset < reader->arrays_end || offset > size ||
        count * item_bytes > size - offset) {
        return false;
    }
    *array = reader->bytes + offset;
    reader->arrays_end = offset + count * item_bytes;
    return true;
}

// Finds an array of floats, which must be finite.
static bool read_floats(Reader *reader, uint64_t offset, uint64_t count, const float **floats) {
    const void *array;
    const bool ok = read_array(reader, offset, count, sizeof **floats, &array) &&
                    all_finite(array, array ? count : 0);
    *floats = array;
    return ok;
}

// --- the header ----------------------------------------------------------------------------------

static bool check_section(const Reader *reader, const PackSection *section, size_t record_bytes,
                          uint64_t most) {
    const uint64_t size = reader->size_bytes;
    return section->offset >= sizeof(PackHeader) && section->offset <= size &&
           section->count <= most && section->count <= (size - section->offset) / record_bytes;
}

static bool check_sections(const Reader *reader) {
    const PackHeader *header = &reader->header;
#define CHECK_SECTION(name, type)                                                                  \
    if (!check_section(reader, &header->name, sizeof(type),                                        \
                       sizeof(type) > 1 ? PACK_MAX_RECORDS : UINT64_MAX)) {                        \
        return refuse(reader, "section " #name, header->name.count);                               \
    }
    PACK_SECTION_LIST(CHECK_SECTION)
#undef CHECK_SECTION
    const PackSection *text = &header->text;
    return (text->count > 0 && reader->bytes[text->offset + text->count - 1] == '\0') ||
           refuse(reader, "the text has no end", text->count);
}

static bool has_layout(const PackHeader *header) {
    return memcmp(header->magic, pack_magic, sizeof header->magic) == 0 &&
           header->version == PACK_VERSION && header->header_bytes == sizeof *header;
}

static bool read_header(Reader *reader) {
    PackHeader *header = &reader->header;
    if (reader->size_bytes < sizeof *header) {
        return refuse(reader, "it ends too early", reader->size_bytes);
    }
    memcpy(header, reader->bytes, sizeof *header);
    if (!has_layout(header)) {
        return refuse(reader, "it is not of this version", header->version);
    }
    if (header->stage != DIP_IMPORT_DONE || header->total_bytes != reader->size_bytes) {
        return refuse(reader, "it is incomplete", header->stage);
    }
    if (!isfinite(header->import_ms) || !isfinite(header->pictures_ms)) {
        return refuse(reader, "times", 0);
    }
    return check_sections(reader);
}

// --- the scene -----------------------------------------------------------------------------------

static bool read_texture(Reader *reader, uint64_t index, DipTextureDef *def) {
    PackTexture record;
    const void *texels;
    read_record(reader, &reader->header.textures, index, &record, sizeof record);
    if (record.width < 1 || record.width > DIP_MAX_TEXTURE_SIZE || record.height < 1 ||
        record.height > DIP_MAX_TEXTURE_SIZE) {
        return refuse(reader, "size of a texture", index);
    }
    *def = (DipTextureDef){.width = record.width,
                           .height = record.height,
                           .encoding = (DipEncoding)record.encoding,
                           .wrap_u = (DipWrap)record.wrap_u,
                           .wrap_v = (DipWrap)record.wrap_v};
    const uint64_t texel_count = (uint64_t)record.width * (uint64_t)record.height;
    const bool ok = record.encoding <= DIP_ENCODING_LINEAR && record.wrap_u <= DIP_WRAP_MIRROR &&
                    record.wrap_v <= DIP_WRAP_MIRROR &&
                    read_text(reader, record.name, &def->name) &&
                    read_array(reader, record.rgba8, texel_count, 4, &texels) && texels;
    def->rgba8 = ok ? texels : NULL;
    return ok || refuse(reader, "a texture", index);
}

// Reads the reflection of a material. Returns false if a value is out of range.
static bool read_pbr(const Reader *reader, const PackPbr *record, DipPbrDef *def) {
    *def = (DipPbrDef){.metallic = record->metallic,
                       .roughness = record->roughness,
                       .metal_rough_map = record->metal_rough_map,
                       .occlusion_map = record->occlusion_map,
                       .occlusion_at_uv1 = record->occlusion_at_uv1 == 1,
                       .occlusion_strength = record->occlusion_strength,
                       .emission_map = record->emission_map,
                       .emission_at_uv1 = record->emission_at_uv1 == 1,
                       .normal_scale = record->normal_scale,
                       .coat = record->coat,
                       .coat_roughness = record->coat_roughness};
    memcpy(def->f0_lin, record->f0_lin, sizeof def->f0_lin);
    memcpy(def->emission_lin, record->emission_lin, sizeof def->emission_lin);
    const float *f0 = record->f0_lin;
    return within_unit(record->metallic) && within_unit(record->roughness) && within_unit(f0[0]) &&
           within_unit(f0[1]) && within_unit(f0[2]) && within_unit(record->occlusion_strength) &&
           within_unit(record->coat) && within_unit(record->coat_roughness) &&
           are_light(record->emission_lin) && isfinite(record->normal_scale) &&
           is_boolean(record->occlusion_at_uv1) && is_boolean(record->emission_at_uv1) &&
           is_texture(reader, record->metal_rough_map) &&
           is_texture(reader, record->occlusion_map) && is_texture(reader, record->emission_map);
}

static bool read_material(Reader *reader, uint64_t index, DipMaterialDef *def) {
    PackMaterial record;
    read_record(reader, &reader->header.materials, index, &record, sizeof record);
    *def = (DipMaterialDef){.surface = (DipSurface)record.surface,
                            .colour_texture = record.colour_texture,
                            .light_map = record.light_map,
                            .normal_map = record.normal_map,
                            .light_map_scale = record.light_map_scale,
                            .roughness = record.roughness,
                            .alpha_cutoff = record.alpha_cutoff,
                            .shininess = record.shininess,
                            .double_sided = record.double_sided == 1,
                            .lit = record.lit == 1,
                            .opacity = record.opacity,
                            .pbr = record.has_pbr == 1 ? &reader->pbrs[index] : NULL};
    memcpy(def->base_colour_lin, record.base_colour_lin, sizeof def->base_colour_lin);
    memcpy(def->specular_lin, record.specular_lin, sizeof def->specular_lin);
    const float *base = record.base_colour_lin;
    const bool numbers = within_unit(base[0]) && within_unit(base[1]) && within_unit(base[2]) &&
                         within_unit(record.roughness) && within_unit(record.alpha_cutoff) &&
                         within_unit(record.opacity) && record.light_map_scale >= 0.0f &&
                         isfinite(record.light_map_scale) && are_light(record.specular_lin) &&
                         record.shininess >= 0.0f && record.shininess <= (float)DIP_MAX_SHININESS;
    const bool textures = is_texture(reader, record.colour_texture) &&
                          is_texture(reader, record.light_map) &&
                          is_texture(reader, record.normal_map);
    const bool ok = numbers && textures && record.surface <= DIP_SURFACE_SKY &&
                    is_boolean(record.double_sided) && is_boolean(record.lit) &&
                    is_boolean(record.has_pbr) &&
                    (!def->pbr || read_pbr(reader, &record.pbr, &reader->pbrs[index])) &&
                    read_text(reader, record.name, &def->name);
    return ok || refuse(reader, "a material", index);
}

static bool read_indices(Reader *reader, const PackMesh *record, DipMeshDef *def) {
    const void *array;
    if (record->index_count % 3 != 0 ||
        !read_array(reader, record->indices, record->index_count, sizeof *def->indices, &array) ||
        (!array && record->index_count > 0)) {
        return false;
    }
    def->indices = array;
    uint32_t outside = 0;
    for (uint32_t i = 0; i < record->index_count; ++i) {
        outside |= def->indices[i] >= record->vertex_count;
    }
    return !outside;
}

static bool read_mesh(Reader *reader, uint64_t index, DipMeshDef *def) {
    PackMesh record;
    read_record(reader, &reader->header.meshes, index, &record, sizeof record);
    *def = (DipMeshDef){.vertex_count = record.vertex_count,
                        .index_count = record.index_count,
                        .material = record.material};
    const uint64_t rows = record.vertex_count;
    const bool ok = record.material >= 0 &&
                    (uint64_t)record.material < reader->header.materials.count &&
                    read_text(reader, record.name, &def->name) &&
                    read_floats(reader, record.positions, 3 * rows, &def->positions) &&
                    read_floats(reader, record.normals, 3 * rows, &def->normals) &&
                    read_floats(reader, record.uv0, 2 * rows, &def->uv0) &&
                    read_floats(reader, record.uv1, 2 * rows, &def->uv1) &&
                    read_floats(reader, record.colours_lin, 3 * rows, &def->colours_lin) &&
                    read_indices(reader, &record, def) && def->positions;
    return ok || refuse(reader, "a mesh", index);
}

static bool read_light(Reader *reader, uint64_t index, DipLightDef *def) {
    PackLight record;
    read_record(reader, &reader->header.lights, index, &record, sizeof record);
    if (record.kind > DIP_LIGHT_SPOT) {
        return refuse(reader, "kind of a light", index);
    }
    *def = (DipLightDef){.kind = (DipLightKind)record.kind,
                         .range_m = record.range_m,
                         .inner_deg = record.inner_deg,
                         .outer_deg = record.outer_deg};
    memcpy(def->colour_lin, record.colour_lin, sizeof def->colour_lin);
    memcpy(def->position_world, record.position_world, sizeof def->position_world);
    memcpy(def->direction_world, record.direction_world, sizeof def->direction_world);
    memcpy(def->attenuation, record.attenuation, sizeof def->attenuation);
    const bool ok = read_text(reader, record.name, &def->name) && !dip_light_fault(def);
    return ok || refuse(reader, "a light", index);
}

// Reads the lighting if the pack has lights.
static bool read_lighting(Reader *reader, DipSceneDef *scene) {
    const PackHeader *header = &reader->header;
    const float *ambient = header->ambient_lin;
    const float *sky = header->sky_lin;
    const bool numbers = are_light(ambient) && are_light(sky) && sky[0] <= ambient[0] &&
                         sky[1] <= ambient[1] && sky[2] <= ambient[2];
    if (!numbers || header->shading > DIP_SHADING_GOURAUD ||
        header->lights.count > DIP_MAX_LIGHTS) {
        return refuse(reader, "lighting", header->lights.count);
    }
    if (header->lights.count == 0) {
        return true;
    }
    PackedLighting *packed = calloc(1, sizeof *packed);
    if (!packed) {
        return out_of_memory(reader);
    }
    scene->lighting = &packed->def;
    packed->def.lights = packed->lights;
    packed->def.light_count = (int)header->lights.count;
    packed->def.shading = (DipShading)header->shading;
    memcpy(packed->def.ambient_lin, ambient, sizeof packed->def.ambient_lin);
    memcpy(packed->def.sky_lin, sky, sizeof packed->def.sky_lin);
    for (int i = 0; i < packed->def.light_count; ++i) {
        if (!read_light(reader, (uint64_t)i, &packed->lights[i])) {
            return false;
        }
    }
    return true;
}

static bool read_object(Reader *reader, uint64_t index, DipObjectDef *def) {
    PackObject record;
    read_record(reader, &reader->header.objects, index, &record, sizeof record);
    def->mesh = record.mesh;
    memcpy(def->transform, record.transform, sizeof def->transform);
    const bool ok = record.mesh >= 0 && (uint64_t)record.mesh < reader->header.meshes.count &&
                    all_finite(record.transform, 12) && read_text(reader, record.name, &def->name);
    return ok || refuse(reader, "an object", index);
}

// --- the motion ----------------------------------------------------------------------------------

// How many records of each kind the rigs have taken.
typedef struct RigParts {
    uint64_t nodes;
    uint64_t skins;
    uint64_t tracks;
} RigParts;

static bool read_rig(Reader *reader, uint64_t index, struct DipPackedMotion *motion,
                     RigParts *taken) {
    const PackHeader *header = &reader->header;
    PackRig record;
    read_record(reader, &header->rigs, index, &record, sizeof record);
    if (record.node_count > header->nodes.count - taken->nodes ||
        record.skin_count > header->skins.count - taken->skins ||
        record.track_count > header->tracks.count - taken->tracks ||
        record.weight_count > PACK_MAX_RECORDS) {
        return refuse(reader, "counts of a rig", index);
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
    const bool ok =
        is_boolean(record.is_held) && read_text(reader, record.clip, &rig->clip) &&
        read_floats(reader, record.rest_weights, record.weight_count, &rig->rig.rest_weights) &&
        (rig->rig.rest_weights || record.weight_count == 0);
    return ok || refuse(reader, "a rig", index);
}

static bool read_node(const Reader *reader, uint64_t index, DipRigNode *node) {
    PackNode record;
    read_record(reader, &reader->header.nodes, index, &record, sizeof record);
    *node = (DipRigNode){.parent = record.parent,
                         .has_matrix = record.has_matrix == 1,
                         .first_weight = record.first_weight,
                         .weight_count = record.weight_count};
    memcpy(node->matrix, record.matrix, sizeof node->matrix);
    memcpy(node->translation, record.translation, sizeof node->translation);
    memcpy(node->rotation, record.rotation, sizeof node->rotation);
    memcpy(node->scale, record.scale, sizeof node->scale);
    return is_boolean(record.has_matrix) || refuse(reader, "a node", index);
}

static bool read_skin(Reader *reader, uint64_t index, DipRigSkin *skin) {
    PackSkin record;
    const void *nodes;
    const void *binds;
    read_record(reader, &reader->header.skins, index, &record, sizeof record);
    const uint64_t joints = record.joint_count;
    const bool ok = joints <= PACK_MAX_RECORDS &&
                    read_array(reader, record.nodes, joints, sizeof *skin->nodes, &nodes) &&
                    read_array(reader, record.inverse_binds, joints, 12 * sizeof(double), &binds) &&
                    ((nodes && binds) || joints == 0);
    if (ok) {
        *skin = (DipRigSkin){.joint_count = (int)joints, .nodes = nodes, .inverse_binds = binds};
    }
    return ok || refuse(reader, "a skin", index);
}

static bool read_track(Reader *reader, uint64_t index, DipTrack *track) {
    PackTrack record;
    read_record(reader, &reader->header.tracks, index, &record, sizeof record);
    if (record.target > DIP_TRACK_WEIGHTS || record.interpolation > DIP_INTERPOLATION_CUBICSPLINE ||
        record.width < 0 || record.width > PACK_MAX_RECORDS || record.key_count < 1) {
        return refuse(reader, "kind of a track", index);
    }
    *track = (DipTrack){.target = (DipTrackTarget)record.target,
                        .interpolation = (DipInterpolation)record.interpolation,
                        .node = record.node,
                        .width = record.width,
                        .key_count = record.key_count};
    const bool ok =
        read_floats(reader, record.times, record.key_count, &track->times) && track->times &&
        read_floats(reader, record.values, dip_track_value_count(track), &track->values) &&
        (track->values || track->width == 0);
    return ok || refuse(reader, "a track", index);
}

static bool read_moving_object(const Reader *reader, uint64_t index, DipMovingObject *object) {
    PackMovingObject record;
    read_record(reader, &reader->header.moving_objects, index, &record, sizeof record);
    *object = (DipMovingObject){.object = record.object, .rig = record.rig, .node = record.node};
    memcpy(object->offset, record.offset, sizeof object->offset);
    return true;
}

static bool read_moving_mesh(Reader *reader, uint64_t index, DipMovingMesh *mesh) {
    PackMovingMesh record;
    const void *joints;
    read_record(reader, &reader->header.moving_meshes, index, &record, sizeof record);
    if (record.shape_count < 1 || record.shape_count > PACK_MAX_RECORDS) {
        return refuse(reader, "shapes of a moving mesh", index);
    }
    *mesh = (DipMovingMesh){.mesh = record.mesh,
                            .rig = record.rig,
                            .node = record.node,
                            .skin = record.skin,
                            .vertex_count = record.vertex_count,
                            .shape_count = (int)record.shape_count};
    const uint64_t rows = (uint64_t)record.shape_count * record.vertex_count;
    const uint64_t corners = 4 * (uint64_t)record.vertex_count;
    const bool ok = read_floats(reader, record.positions, 3 * rows, &mesh->positions) &&
                    read_floats(reader, record.normals, 3 * rows, &mesh->normals) &&
                    read_array(reader, record.joints, corners, sizeof *mesh->joints, &joints) &&
                    read_floats(reader, record.joint_weights, corners, &mesh->joint_weights) &&
                    read_floats(reader, record.box, 6, &mesh->box) && mesh->positions;
    mesh->joints = ok ? joints : NULL;
    return ok || refuse(reader, "a moving mesh", index);
}

static bool allocate_motion(const Reader *reader, struct DipPackedMotion *motion) {
    const PackHeader *header = &reader->header;
    motion->rigs = calloc(header->rigs.count + 1, sizeof *motion->rigs);
    motion->nodes = calloc(header->nodes.count + 1, sizeof *motion->nodes);
    motion->skins = calloc(header->skins.count + 1, sizeof *motion->skins);
    motion->tracks = calloc(header->tracks.count + 1, sizeof *motion->tracks);
    motion->objects = calloc(header->moving_objects.count + 1, sizeof *motion->objects);
    motion->meshes = calloc(header->moving_meshes.count + 1, sizeof *motion->meshes);
    return (motion->rigs && motion->nodes && motion->skins && motion->tracks && motion->objects &&
            motion->meshes) ||
           out_of_memory(reader);
}

static void free_motion(struct DipPackedMotion *motion) {
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

static bool read_motion_parts(Reader *reader, struct DipPackedMotion *motion) {
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

// Reads the motion if the pack has one.
static bool read_motion(Reader *reader, DipScenePack *pack) {
    const PackHeader *header = &reader->header;
    if (header->rigs.count == 0) {
        const bool empty = header->moving_objects.count == 0 && header->moving_meshes.count == 0;
        return empty || refuse(reader, "motion without rigs", 0);
    }
    pack->motion = calloc(1, sizeof *pack->motion);
    if (!pack->motion) {
        return out_of_memory(reader);
    }
    if (!allocate_motion(reader, pack->motion) || !read_motion_parts(reader, pack->motion)) {
        return false;
    }
    DipError fault;
    pack->scene.motion = &pack->motion->def;
    return dip_motion_check(&pack->scene, &fault) || refuse(reader, fault.message, 0);
}

static bool read_clips(const Reader *reader, DipScenePack *pack) {
    const uint64_t count = reader->header.clips.count;
    const char **clips = calloc(count + 1, sizeof *clips);
    pack->clips = clips;
    if (!clips) {
        return out_of_memory(reader);
    }
    for (uint64_t i = 0; i < count; ++i) {
        PackClip record;
        read_record(reader, &reader->header.clips, i, &record, sizeof record);
        if (!read_text(reader, record.name, &clips[i])) {
            return refuse(reader, "a clip", i);
        }
    }
    pack->clip_count = (int)count;
    return true;
}

// --- all parts of the scene ----------------------------------------------------------------------

// Allocates the arrays of the scene; dip_scene_pack_free frees them.
static bool allocate_scene(const Reader *reader, DipSceneDef *scene) {
    const PackHeader *header = &reader->header;
    scene->textures = calloc(header->textures.count + 1, sizeof *scene->textures);
    scene->materials = calloc(header->materials.count + 1, sizeof *scene->materials);
    scene->meshes = calloc(header->meshes.count + 1, sizeof *scene->meshes);
    scene->objects = calloc(header->objects.count + 1, sizeof *scene->objects);
    return (scene->textures && scene->materials && scene->meshes && scene->objects) ||
           out_of_memory(reader);
}

// Reads all records of a section with `read` into the scene's array of the same name.
#define READ_RECORDS(name, type, read, number)                                                     \
    for (uint64_t i = 0; i < header->name.count; ++i) {                                            \
        if (!read(reader, i, (type *)scene->name + i)) {                                           \
            return false;                                                                          \
        }                                                                                          \
    }                                                                                              \
    scene->number = (int)header->name.count

static bool read_scene(Reader *reader, DipScenePack *pack) {
    const PackHeader *header = &reader->header;
    DipSceneDef *scene = &pack->scene;
    if (!(header->near_m > 0.0f) || !isfinite(header->near_m) ||
        !all_finite(header->background_lin, 3)) {
        return refuse(reader, "near plane or background", 0);
    }
    scene->near_m = header->near_m;
    memcpy(scene->background_lin, header->background_lin, sizeof scene->background_lin);
    scene->sky = dip_sky_default();
    reader->arrays_end = sizeof *header;
    pack->pbrs = calloc(header->materials.count + 1, sizeof *pack->pbrs);
    reader->pbrs = pack->pbrs;
    if (!pack->pbrs) {
        return out_of_memory(reader);
    }
    if (!allocate_scene(reader, scene)) {
        return false;
    }
    READ_RECORDS(textures, DipTextureDef, read_texture, texture_count);
    READ_RECORDS(materials, DipMaterialDef, read_material, material_count);
    READ_RECORDS(meshes, DipMeshDef, read_mesh, mesh_count);
    READ_RECORDS(objects, DipObjectDef, read_object, object_count);
    return read_lighting(reader, scene) && read_motion(reader, pack) && read_clips(reader, pack);
}

// --- errors and warnings -------------------------------------------------------------------------

// Replaces control characters by spaces, because a message must stay on one line. Returns false if
// the text has no end.
static bool copy_line(char *to, const char *from, size_t size_bytes) {
    if (!memchr(from, '\0', size_bytes)) {
        return false;
    }
    for (size_t i = 0; i < size_bytes; ++i) {
        to[i] = from[i] && (unsigned char)from[i] < ' ' ? ' ' : from[i];
    }
    return true;
}

static bool read_error(const Reader *reader, const PackSection *section, uint64_t index,
                       DipSeverity severity, DipError *error) {
    PackError record;
    read_record(reader, section, index, &record, sizeof record);
    *error = (DipError){.code = (DipErrorCode)record.code,
                        .origin = (DipOrigin)record.origin,
                        .severity = severity,
                        .line = record.line};
    const bool ok = record.code > DIP_ERROR_NONE && record.code <= DIP_ERROR_RUNTIME &&
                    record.origin <= DIP_ORIGIN_RUNTIME && record.severity == severity &&
                    record.line >= 0 && copy_line(error->file, record.file, sizeof record.file) &&
                    copy_line(error->key, record.key, sizeof record.key) &&
                    copy_line(error->message, record.message, sizeof record.message);
    return ok || refuse(reader, "a message", index);
}

static bool read_messages(const Reader *reader, DipScenePack *pack) {
    const PackSection *warnings = &reader->header.warnings;
    const PackSection *failures = &reader->header.failures;
    for (uint64_t i = 0; i < warnings->count; ++i) {
        DipError warning;
        if (!read_error(reader, warnings, i, DIP_SEVERITY_WARNING, &warning)) {
            return false;
        }
        dip_error_list_add(&pack->warnings, &warning);
    }
    if (failures->count > 1) {
        return refuse(reader, "several failures", failures->count);
    }
    return failures->count == 0 ||
           read_error(reader, failures, 0, DIP_SEVERITY_ERROR, &pack->failure);
}

// --- the pack ------------------------------------------------------------------------------------

bool dip_scene_pack_read(const void *bytes, size_t size_bytes, DipScenePack *pack, DipError *err) {
    DIP_FP_MODE_SCOPE();
    Reader reader = {.bytes = bytes, .size_bytes = size_bytes, .err = err};
    DIP_ASSERT((uintptr_t)bytes % 8 == 0);
    *pack = (DipScenePack){0};
    const bool ok =
        read_header(&reader) && read_messages(&reader, pack) && read_scene(&reader, pack);
    if (!ok) {
        dip_scene_pack_free(pack);
        return false;
    }
    pack->times = (DipModelTimes){.import_ms = reader.header.import_ms,
                                  .pictures_ms = reader.header.pictures_ms};
    return true;
}

void dip_scene_pack_free(DipScenePack *pack) {
    free((void *)pack->scene.textures);
    free((void *)pack->scene.materials);
    free((void *)pack->scene.meshes);
    free((void *)pack->scene.objects);
    free((void *)pack->scene.lighting);
    free(pack->pbrs);
    free_motion(pack->motion);
    free((void *)pack->clips);
    dip_error_list_free(&pack->warnings);
    *pack = (DipScenePack){0};
}

bool dip_scene_pack_read_note(int pack_file, DipImportStage *stage, int *file_index) {
    PackHeader header;
    if (pread(pack_file, &header, sizeof header, 0) != (ssize_t)sizeof header ||
        !has_layout(&header) || header.stage > DIP_IMPORT_DONE ||
        header.file_index >= DIP_MAX_MODEL_FILES) {
        return false;
    }
    *stage = (DipImportStage)header.stage;
    *file_index = (int)header.file_index;
    return true;
}
