// Reads scene packs.
#include "assets/pack/scene_pack.h"

#include "assets/model_parts.h"
#include "assets/pack/scene_pack_check.h"
#include "renderer/base/assert.h"
#include "renderer/base/fp_mode.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// The lighting that a scene's `lighting` points to. `def` comes first, so that both have the same
// address.
typedef struct PackedLighting {
    DipLightingDef def;
    DipLightDef lights[DIP_MAX_LIGHTS];
} PackedLighting;

// --- values --------------------------------------------------------------------------------------

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

// True for DIP_NO_TEXTURE and for the index of a texture.
static bool is_texture(const DipPackReader *reader, int32_t index) {
    return index >= DIP_NO_TEXTURE &&
           (index < 0 || (uint64_t)index < reader->header.textures.count);
}

// --- the scene -----------------------------------------------------------------------------------

static bool read_texture(DipPackReader *reader, uint64_t index, DipTextureDef *def) {
    PackTexture record;
    const void *texels;
    dip_pack_read_record(reader, &reader->header.textures, index, &record, sizeof record);
    if (record.width < 1 || record.width > DIP_MAX_TEXTURE_SIZE || record.height < 1 ||
        record.height > DIP_MAX_TEXTURE_SIZE) {
        return dip_pack_refuse(reader, "size of a texture", index);
    }
    *def = (DipTextureDef){.width = record.width,
                           .height = record.height,
                           .encoding = (DipEncoding)record.encoding,
                           .wrap_u = (DipWrap)record.wrap_u,
                           .wrap_v = (DipWrap)record.wrap_v};
    const uint64_t texel_count = (uint64_t)record.width * (uint64_t)record.height;
    const bool ok = record.encoding <= DIP_ENCODING_LINEAR && record.wrap_u <= DIP_WRAP_MIRROR &&
                    record.wrap_v <= DIP_WRAP_MIRROR &&
                    dip_pack_read_text(reader, record.name, &def->name) &&
                    dip_pack_read_array(reader, record.rgba8, texel_count, 4, &texels) && texels;
    def->rgba8 = ok ? texels : NULL;
    return ok || dip_pack_refuse(reader, "a texture", index);
}

// Reads the reflection of a material. Returns false if a value is out of range.
static bool read_pbr(const DipPackReader *reader, const PackPbr *record, DipPbrDef *def) {
    *def = (DipPbrDef){.metallic = record->metallic,
                       .roughness = record->roughness,
                       .f90 = record->f90,
                       .metal_rough_map = record->metal_rough_map,
                       .occlusion_map = record->occlusion_map,
                       .occlusion_at_uv1 = (record->maps_at_uv1 & 1) != 0,
                       .occlusion_strength = record->occlusion_strength,
                       .emission_map = record->emission_map,
                       .emission_at_uv1 = (record->maps_at_uv1 & 2) != 0,
                       .normal_scale = record->normal_scale,
                       .coat = record->coat,
                       .coat_roughness = record->coat_roughness,
                       .sheen_roughness = record->sheen_roughness,
                       .transmission = record->transmission,
                       .scattering = record->scattering};
    memcpy(def->sheen_lin, record->sheen_lin, sizeof def->sheen_lin);
    const float *sheen = record->sheen_lin;
    memcpy(def->f0_lin, record->f0_lin, sizeof def->f0_lin);
    memcpy(def->emission_lin, record->emission_lin, sizeof def->emission_lin);
    const float *f0 = record->f0_lin;
    return within_unit(record->metallic) && within_unit(record->roughness) && within_unit(f0[0]) &&
           within_unit(f0[1]) && within_unit(f0[2]) && within_unit(record->f90) &&
           within_unit(record->occlusion_strength) && within_unit(record->coat) &&
           within_unit(record->coat_roughness) && within_unit(sheen[0]) && within_unit(sheen[1]) &&
           within_unit(sheen[2]) && within_unit(record->sheen_roughness) &&
           within_unit(record->transmission) && within_unit(record->scattering) &&
           are_light(record->emission_lin) && isfinite(record->normal_scale) &&
           record->maps_at_uv1 <= 3 && is_texture(reader, record->metal_rough_map) &&
           is_texture(reader, record->occlusion_map) && is_texture(reader, record->emission_map);
}

static bool read_material(DipPackReader *reader, uint64_t index, DipMaterialDef *def) {
    PackMaterial record;
    dip_pack_read_record(reader, &reader->header.materials, index, &record, sizeof record);
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
                            .transmission = record.transmission,
                            .pbr = record.has_pbr == 1 ? &reader->pbrs[index] : NULL};
    memcpy(def->base_colour_lin, record.base_colour_lin, sizeof def->base_colour_lin);
    memcpy(def->specular_lin, record.specular_lin, sizeof def->specular_lin);
    const float *base = record.base_colour_lin;
    const bool numbers = within_unit(base[0]) && within_unit(base[1]) && within_unit(base[2]) &&
                         within_unit(record.roughness) && within_unit(record.alpha_cutoff) &&
                         within_unit(record.opacity) && within_unit(record.transmission) &&
                         record.light_map_scale >= 0.0f && isfinite(record.light_map_scale) &&
                         are_light(record.specular_lin) && record.shininess >= 0.0f &&
                         record.shininess <= (float)DIP_MAX_SHININESS;
    const bool textures = is_texture(reader, record.colour_texture) &&
                          is_texture(reader, record.light_map) &&
                          is_texture(reader, record.normal_map);
    const bool ok = numbers && textures && record.surface <= DIP_SURFACE_SKY &&
                    dip_pack_is_boolean(record.double_sided) && dip_pack_is_boolean(record.lit) &&
                    dip_pack_is_boolean(record.has_pbr) &&
                    (!def->pbr || read_pbr(reader, &record.pbr, &reader->pbrs[index])) &&
                    dip_pack_read_text(reader, record.name, &def->name);
    return ok || dip_pack_refuse(reader, "a material", index);
}

static bool read_indices(DipPackReader *reader, const PackMesh *record, DipMeshDef *def) {
    const void *array;
    if (record->index_count % 3 != 0 ||
        !dip_pack_read_array(reader, record->indices, record->index_count, sizeof *def->indices,
                             &array) ||
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

static bool read_mesh(DipPackReader *reader, uint64_t index, DipMeshDef *def) {
    PackMesh record;
    dip_pack_read_record(reader, &reader->header.meshes, index, &record, sizeof record);
    *def = (DipMeshDef){.vertex_count = record.vertex_count,
                        .index_count = record.index_count,
                        .material = record.material};
    const uint64_t rows = record.vertex_count;
    const bool ok = record.material >= 0 &&
                    (uint64_t)record.material < reader->header.materials.count &&
                    dip_pack_read_text(reader, record.name, &def->name) &&
                    dip_pack_read_floats(reader, record.positions, 3 * rows, &def->positions) &&
                    dip_pack_read_floats(reader, record.normals, 3 * rows, &def->normals) &&
                    dip_pack_read_floats(reader, record.uv0, 2 * rows, &def->uv0) &&
                    dip_pack_read_floats(reader, record.uv1, 2 * rows, &def->uv1) &&
                    dip_pack_read_floats(reader, record.colours_lin, 3 * rows, &def->colours_lin) &&
                    dip_pack_read_floats(reader, record.alphas, rows, &def->alphas) &&
                    read_indices(reader, &record, def) && def->positions;
    return ok || dip_pack_refuse(reader, "a mesh", index);
}

static bool read_light(DipPackReader *reader, uint64_t index, DipLightDef *def) {
    PackLight record;
    dip_pack_read_record(reader, &reader->header.lights, index, &record, sizeof record);
    if (record.kind > DIP_LIGHT_SPOT) {
        return dip_pack_refuse(reader, "kind of a light", index);
    }
    *def = (DipLightDef){.kind = (DipLightKind)record.kind,
                         .range_m = record.range_m,
                         .inner_deg = record.inner_deg,
                         .outer_deg = record.outer_deg};
    memcpy(def->colour_lin, record.colour_lin, sizeof def->colour_lin);
    memcpy(def->position_world, record.position_world, sizeof def->position_world);
    memcpy(def->direction_world, record.direction_world, sizeof def->direction_world);
    memcpy(def->attenuation, record.attenuation, sizeof def->attenuation);
    const bool ok = dip_pack_read_text(reader, record.name, &def->name) && !dip_light_fault(def);
    return ok || dip_pack_refuse(reader, "a light", index);
}

// Reads the lighting if the pack has lights.
static bool read_lighting(DipPackReader *reader, DipSceneDef *scene) {
    const PackHeader *header = &reader->header;
    const float *ambient = header->ambient_lin;
    const float *sky = header->sky_lin;
    const bool numbers = are_light(ambient) && are_light(sky) && sky[0] <= ambient[0] &&
                         sky[1] <= ambient[1] && sky[2] <= ambient[2];
    if (!numbers || header->shading > DIP_SHADING_GOURAUD ||
        header->lights.count > DIP_MAX_LIGHTS) {
        return dip_pack_refuse(reader, "lighting", header->lights.count);
    }
    if (header->lights.count == 0) {
        return true;
    }
    PackedLighting *packed = calloc(1, sizeof *packed);
    if (!packed) {
        return dip_pack_out_of_memory(reader);
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

static bool read_object(DipPackReader *reader, uint64_t index, DipObjectDef *def) {
    PackObject record;
    dip_pack_read_record(reader, &reader->header.objects, index, &record, sizeof record);
    def->mesh = record.mesh;
    memcpy(def->transform, record.transform, sizeof def->transform);
    const bool ok = record.mesh >= 0 && (uint64_t)record.mesh < reader->header.meshes.count &&
                    dip_pack_all_finite(record.transform, 12) &&
                    dip_pack_read_text(reader, record.name, &def->name);
    return ok || dip_pack_refuse(reader, "an object", index);
}

// --- names of animations -------------------------------------------------------------------------

static bool read_clips(const DipPackReader *reader, DipScenePack *pack) {
    const uint64_t count = reader->header.clips.count;
    const char **clips = calloc(count + 1, sizeof *clips);
    pack->clips = clips;
    if (!clips) {
        return dip_pack_out_of_memory(reader);
    }
    for (uint64_t i = 0; i < count; ++i) {
        PackClip record;
        dip_pack_read_record(reader, &reader->header.clips, i, &record, sizeof record);
        if (!dip_pack_read_text(reader, record.name, &clips[i])) {
            return dip_pack_refuse(reader, "a clip", i);
        }
    }
    pack->clip_count = (int)count;
    return true;
}

// --- all parts of the scene ----------------------------------------------------------------------

// Allocates the arrays of the scene; dip_scene_pack_free frees them.
static bool allocate_scene(const DipPackReader *reader, DipSceneDef *scene) {
    const PackHeader *header = &reader->header;
    scene->textures = calloc(header->textures.count + 1, sizeof *scene->textures);
    scene->materials = calloc(header->materials.count + 1, sizeof *scene->materials);
    scene->meshes = calloc(header->meshes.count + 1, sizeof *scene->meshes);
    scene->objects = calloc(header->objects.count + 1, sizeof *scene->objects);
    return (scene->textures && scene->materials && scene->meshes && scene->objects) ||
           dip_pack_out_of_memory(reader);
}

// Reads all records of a section with `read` into the scene's array of the same name.
#define READ_RECORDS(name, type, read, number)                                                     \
    for (uint64_t i = 0; i < header->name.count; ++i) {                                            \
        if (!read(reader, i, (type *)scene->name + i)) {                                           \
            return false;                                                                          \
        }                                                                                          \
    }                                                                                              \
    scene->number = (int)header->name.count

static bool read_scene(DipPackReader *reader, DipScenePack *pack) {
    const PackHeader *header = &reader->header;
    DipSceneDef *scene = &pack->scene;
    if (!(header->near_m > 0.0f) || !isfinite(header->near_m) ||
        !dip_pack_all_finite(header->background_lin, 3)) {
        return dip_pack_refuse(reader, "near plane or background", 0);
    }
    scene->near_m = header->near_m;
    memcpy(scene->background_lin, header->background_lin, sizeof scene->background_lin);
    scene->sky = dip_sky_default();
    reader->arrays_end = sizeof *header;
    pack->pbrs = calloc(header->materials.count + 1, sizeof *pack->pbrs);
    reader->pbrs = pack->pbrs;
    if (!pack->pbrs) {
        return dip_pack_out_of_memory(reader);
    }
    if (!allocate_scene(reader, scene)) {
        return false;
    }
    READ_RECORDS(textures, DipTextureDef, read_texture, texture_count);
    READ_RECORDS(materials, DipMaterialDef, read_material, material_count);
    READ_RECORDS(meshes, DipMeshDef, read_mesh, mesh_count);
    READ_RECORDS(objects, DipObjectDef, read_object, object_count);
    return read_lighting(reader, scene) && dip_pack_read_motion(reader, pack) &&
           read_clips(reader, pack);
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

static bool read_error(const DipPackReader *reader, const PackSection *section, uint64_t index,
                       DipSeverity severity, DipError *error) {
    PackError record;
    dip_pack_read_record(reader, section, index, &record, sizeof record);
    *error = (DipError){.code = (DipErrorCode)record.code,
                        .origin = (DipOrigin)record.origin,
                        .severity = severity,
                        .line = record.line};
    const bool ok = record.code > DIP_ERROR_NONE && record.code <= DIP_ERROR_RUNTIME &&
                    record.origin <= DIP_ORIGIN_RUNTIME && record.severity == severity &&
                    record.line >= 0 && copy_line(error->file, record.file, sizeof record.file) &&
                    copy_line(error->key, record.key, sizeof record.key) &&
                    copy_line(error->message, record.message, sizeof record.message);
    return ok || dip_pack_refuse(reader, "a message", index);
}

static bool read_messages(const DipPackReader *reader, DipScenePack *pack) {
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
        return dip_pack_refuse(reader, "several failures", failures->count);
    }
    return failures->count == 0 ||
           read_error(reader, failures, 0, DIP_SEVERITY_ERROR, &pack->failure);
}

// --- the pack ------------------------------------------------------------------------------------

bool dip_scene_pack_read(const void *bytes, size_t size_bytes, DipScenePack *pack, DipError *err) {
    DIP_FP_MODE_SCOPE();
    DipPackReader reader = {.bytes = bytes, .size_bytes = size_bytes, .err = err};
    DIP_ASSERT((uintptr_t)bytes % 8 == 0);
    *pack = (DipScenePack){0};
    const bool ok =
        dip_pack_read_header(&reader) && read_messages(&reader, pack) && read_scene(&reader, pack);
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
    dip_pack_free_motion(pack->motion);
    free((void *)pack->clips);
    dip_error_list_free(&pack->warnings);
    *pack = (DipScenePack){0};
}

bool dip_scene_pack_read_note(int pack_file, DipImportStage *stage, int *file_index) {
    PackHeader header;
    if (pread(pack_file, &header, sizeof header, 0) != (ssize_t)sizeof header ||
        !dip_pack_has_layout(&header) || header.stage > DIP_IMPORT_DONE ||
        header.file_index >= DIP_MAX_MODEL_FILES) {
        return false;
    }
    *stage = (DipImportStage)header.stage;
    *file_index = (int)header.file_index;
    return true;
}
