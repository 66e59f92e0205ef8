// Turns the materials of a glTF file into those of a scene.
#include "assets/gltf/scene.h"

#include <cjson/cJSON.h>

#include <stdio.h>
#include <string.h>

static const float default_cutoff = 0.5f;
static const float dielectric_specular = 0.04f;
static const float stored_light_scale = 2.0f; // Light maps of glTF store light / 2.
static const double luminance[3] = {0.2126, 0.7152, 0.0722};
static const DipTextureUse no_use = {.picture = DIP_NO_TEXTURE};

// A material while it is made.
typedef struct Maker {
    DipGltfScene *scene;
    const DipGltfPart *part;
    const char *mesh_name;
    DipGltfMaterial from;
    DipMaterialPlan plan;
    DipMaterialDef def;
    bool ok; // False after a failure, which has filled *err.
} Maker;

static void warn(const Maker *maker, const char *text) {
    dip_model_warn(maker->scene->model, maker->scene->reader.gltf.path, maker->def.name, "%s",
                   text);
}

// --- pictures ------------------------------------------------------------------------------------

// Registers the picture of a texture.
static int register_picture(Maker *maker, int image) {
    DipGltf *gltf = &maker->scene->reader.gltf;
    const int file = maker->scene->file;
    const char *uri;
    const uint8_t *bytes;
    size_t size_bytes;
    if (!dip_gltf_image(gltf, image, &uri, &bytes, &size_bytes)) {
        maker->ok = false;
        return DIP_NO_TEXTURE;
    }
    if (uri) {
        return dip_model_picture_beside(maker->scene->model, file, uri);
    }
    const cJSON *json = dip_gltf_item(gltf, DIP_GLTF_images, image);
    const cJSON *name = cJSON_GetObjectItemCaseSensitive(json, "name");
    char made[32];
    snprintf(made, sizeof made, "image %d", image);
    return dip_model_picture_bytes(maker->scene->model, file,
                                   cJSON_IsString(name) ? name->valuestring : made, bytes,
                                   size_bytes);
}

// Returns how the material uses a texture, or no_use if it has none or the mesh lacks the texture
// coordinates.
static DipTextureUse use(Maker *maker, const DipGltfTexture *texture, const char *what) {
    DipGltfTextureSource source;
    const int set = texture->placement.set;
    if (texture->index < 0 || !maker->ok) {
        return no_use;
    }
    if (!dip_gltf_describe_texture(&maker->scene->reader.gltf, texture->index, &source)) {
        maker->ok = false;
        return no_use;
    }
    if (source.image < 0) {
        dip_model_warn(maker->scene->model, maker->scene->reader.gltf.path, maker->def.name,
                       "texture %d has no picture", texture->index);
        return no_use;
    }
    if (set >= DIP_GLTF_MAX_SETS || !maker->part->sets[set]) {
        dip_model_warn(maker->scene->model, maker->scene->reader.gltf.path, maker->def.name,
                       "mesh \"%s\" has no texture coordinates %d, so the %s is ignored",
                       maker->mesh_name, set, what);
        return no_use;
    }
    return (DipTextureUse){.picture = register_picture(maker, source.image),
                           .uv_channel = set,
                           .wrap_u = source.wrap_u,
                           .wrap_v = source.wrap_v,
                           .hard = source.is_nearest};
}

// --- texture coordinates -------------------------------------------------------------------------

static DipCoordinates coordinates_of(const DipGltfTexture *texture) {
    DipCoordinates coordinates = {.set = texture->placement.set};
    memcpy(coordinates.matrix, texture->placement.matrix, sizeof coordinates.matrix);
    return coordinates;
}

static bool are_same(const DipCoordinates *a, const DipCoordinates *b) {
    return a->set == b->set && memcmp(a->matrix, b->matrix, sizeof a->matrix) == 0;
}

// Returns true if uv0 or uv1 are the coordinates of a texture, and makes them so if they are still
// free. may_use_uv1: the renderer can read this texture at uv1. *at_uv1 says which it is.
static bool place(Maker *maker, const DipGltfTexture *texture, bool may_use_uv1, bool *at_uv1) {
    DipMaterialPlan *plan = &maker->plan;
    const DipCoordinates wanted = coordinates_of(texture);
    if (!plan->has_uv0) {
        plan->has_uv0 = true;
        plan->uv0 = wanted;
    }
    *at_uv1 = !are_same(&plan->uv0, &wanted);
    if (*at_uv1 && may_use_uv1 && !plan->has_uv1) {
        plan->has_uv1 = true;
        plan->uv1 = wanted;
    }
    return !*at_uv1 || (may_use_uv1 && are_same(&plan->uv1, &wanted));
}

// Drops a picture that needs more texture coordinates than a mesh of the scene can have.
static void place_or_drop(Maker *maker, const DipGltfTexture *texture, bool may_use_uv1,
                          bool *at_uv1, DipTextureUse *picture) {
    *at_uv1 = false;
    if (picture->picture >= 0 && !place(maker, texture, may_use_uv1, at_uv1)) {
        *picture = no_use;
        *at_uv1 = false;
        if (dip_gltf_warns_of(maker->scene, DIP_GLTF_LOSS_COORDINATES)) {
            warn(maker, "pictures are left out whose texture coordinates differ from those of the "
                        "material's other pictures");
        }
    }
}

// --- light ---------------------------------------------------------------------------------------

// Reads the light map: that of a rule, or the occlusion picture.
static void read_light_map(Maker *maker) {
    DipMaterialPlan *plan = &maker->plan;
    const DipMaterialRule *rule = plan->light_rule;
    if (!rule || !rule->light_map) {
        plan->light = use(maker, &maker->from.occlusion, "light map");
        plan->uv1 = coordinates_of(&maker->from.occlusion);
        if (rule && plan->light.picture < 0) {
            warn(maker, "the material is marked as light-mapped, but has no light map");
        }
    } else if (!maker->part->sets[0]) {
        dip_model_warn(maker->scene->model, maker->scene->reader.gltf.path, maker->def.name,
                       "mesh \"%s\" has no texture coordinates, so its light map %s is ignored",
                       maker->mesh_name, rule->light_map);
    } else {
        plan->light.picture =
            dip_model_picture_file(maker->scene->model, maker->scene->file, rule->light_map);
        plan->light.wrap_u = plan->light.wrap_v = DIP_WRAP_REPEAT;
        plan->uv1 =
            (DipCoordinates){.set = maker->part->sets[1] ? 1 : 0, .matrix = {1, 0, 0, 0, 1, 0}};
    }
    plan->has_uv1 = plan->light.picture >= 0;
}

// Describes the reflection and emission. Surfaces with a light map, glass, water and sky have none.
static void read_pbr(Maker *maker) {
    DipMaterialPlan *plan = &maker->plan;
    const DipGltfMaterial *from = &maker->from;
    DipPbrDef *pbr = dip_model_alloc(maker->scene->model, 1, sizeof *pbr);
    bool at_uv1;
    if (!pbr) {
        maker->ok =
            dip_model_out_of_memory(maker->scene->reader.gltf.err, maker->scene->reader.gltf.path);
        return;
    }
    plan->gloss = use(maker, &from->gloss, "specular-glossiness map");
    *pbr = (DipPbrDef){.metallic = (float)from->metallic,
                       .roughness = (float)from->roughness,
                       .metal_rough_map = DIP_NO_TEXTURE,
                       .occlusion_map = DIP_NO_TEXTURE,
                       .emission_map = DIP_NO_TEXTURE,
                       .occlusion_strength = (float)from->occlusion_strength,
                       .normal_scale = (float)from->normal_scale,
                       .coat = (float)from->coat,
                       .coat_roughness = (float)from->coat_roughness,
                       .sheen_roughness = (float)from->sheen_roughness};
    for (int i = 0; i < 3; ++i) {
        pbr->sheen_lin[i] = (float)from->sheen[i];
        // Without the picture that belongs to it, the factor 1 would make a mirror.
        const bool is_mirror = from->gloss.index >= 0 && plan->gloss.picture < 0;
        pbr->f0_lin[i] = is_mirror ? dielectric_specular : (float)from->f0[i];
        pbr->f90 = is_mirror ? 1.0f : (float)from->f90;
        pbr->emission_lin[i] = (float)from->emission[i];
    }
    plan->metal_rough = use(maker, &from->metal_rough, "metallic-roughness map");
    plan->emission = use(maker, &from->emission_map, "emission map");
    plan->occlusion = use(maker, &from->occlusion, "occlusion map");
    place_or_drop(maker, &from->metal_rough, false, &at_uv1, &plan->metal_rough);
    place_or_drop(maker, &from->emission_map, true, &pbr->emission_at_uv1, &plan->emission);
    place_or_drop(maker, &from->occlusion, true, &pbr->occlusion_at_uv1, &plan->occlusion);
    plan->pbr = pbr;
    if (plan->gloss.picture >= 0 && dip_gltf_warns_of(maker->scene, DIP_GLTF_LOSS_GLOSS)) {
        warn(maker, "only the mean of the picture specularGlossinessTexture is drawn");
    }
}

static void warn_of_lost_light(Maker *maker) {
    const DipGltfMaterial *from = &maker->from;
    const bool glows = from->emission[0] + from->emission[1] + from->emission[2] > 0.0;
    const bool is_cloth = from->sheen[0] + from->sheen[1] + from->sheen[2] > 0.0;
    if ((glows || is_cloth || from->coat > 0.0) && !maker->plan.pbr && !from->unlit &&
        dip_gltf_warns_of(maker->scene, DIP_GLTF_LOSS_LIGHT_MAPPED)) {
        warn(maker, "emission, clear coat and sheen are not drawn on surfaces with a light map, "
                    "glass, water and sky");
    }
}

// The scale of a normal map belongs to the metallic-roughness description, which surfaces with a
// light map or one of Diptych's own keys lack.
static void warn_of_normal_scale(Maker *maker) {
    const DipMaterialPlan *plan = &maker->plan;
    const bool is_bumpy =
        plan->light.picture >= 0 || plan->tag == DIP_TAG_SOLID || plan->tag == DIP_TAG_MASK;
    if (plan->normal.picture >= 0 && is_bumpy && !plan->pbr && !plan->unlit &&
        plan->tag != DIP_TAG_WATER && plan->tag != DIP_TAG_SKY && maker->from.normal_scale != 1.0 &&
        dip_gltf_warns_of(maker->scene, DIP_GLTF_LOSS_NORMAL_SCALE)) {
        warn(maker, "the scale of a normal map is not drawn on surfaces with a light map or with "
                    "the keys surface or lightmapped");
    }
}

// --- the surface ---------------------------------------------------------------------------------

// Returns how much of a surface without a reflection covers what lies behind it. What is
// transmitted is tinted by the base colour, so a dark pane covers more.
static double opacity_of(const DipGltfMaterial *from) {
    double shown = 0.0;
    for (int i = 0; i < 3; ++i) {
        shown += luminance[i] * from->base[i];
    }
    const double alpha = from->alpha == DIP_GLTF_BLEND ? from->base[3] : 1.0;
    return alpha * (1.0 - from->transmission * (1.0 - from->metallic) * shown);
}

// A picture of the transmission is not read, so its material stays solid.
static bool transmits(const Maker *maker) {
    const int index = maker->part->material;
    const cJSON *json =
        index < 0 ? NULL : dip_gltf_item(&maker->scene->reader.gltf, DIP_GLTF_materials, index);
    const cJSON *extension = dip_gltf_extension(json, "KHR_materials_transmission");
    return maker->from.transmission > 0.0 && maker->from.alpha != DIP_GLTF_MASK &&
           !cJSON_GetObjectItemCaseSensitive(extension, "transmissionTexture");
}

static void read_surface(Maker *maker) {
    const DipGltfMaterial *from = &maker->from;
    DipMaterialDef *def = &maker->def;
    const float alpha = (float)from->base[3];
    def->alpha_cutoff = default_cutoff;
    def->opacity = 1.0f;
    if (from->alpha == DIP_GLTF_MASK) {
        const float cutoff = (float)from->cutoff;
        maker->plan.invisible = alpha < cutoff;
        def->alpha_cutoff = dip_texel_cutoff(cutoff, alpha);
    }
    if (from->alpha == DIP_GLTF_MASK || maker->plan.tag == DIP_TAG_MASK) {
        def->surface = DIP_SURFACE_CLIPPED;
    } else if (from->alpha == DIP_GLTF_BLEND || transmits(maker)) {
        def->surface = DIP_SURFACE_BLENDED;
        if (maker->plan.pbr) {
            def->opacity = from->alpha == DIP_GLTF_BLEND ? alpha : 1.0f;
            maker->plan.pbr->transmission = transmits(maker) ? (float)from->transmission : 0.0f;
            maker->plan.pbr->scattering = transmits(maker) ? (float)from->scattering : 0.0f;
        } else {
            def->opacity = (float)opacity_of(from);
        }
    }
    if (maker->plan.tag == DIP_TAG_WATER) {
        def->surface = DIP_SURFACE_WATER;
        def->transmission = 1.0f - def->opacity;
        def->opacity = 1.0f;
    } else if (maker->plan.tag == DIP_TAG_SKY) {
        def->surface = DIP_SURFACE_SKY;
    }
}

static void fill(Maker *maker) {
    static const float specular[3] = {dielectric_specular, dielectric_specular,
                                      dielectric_specular};
    const DipGltfMaterial *from = &maker->from;
    DipMaterialPlan *plan = &maker->plan;
    DipMaterialDef *def = &maker->def;
    bool at_uv1;
    for (int i = 0; i < 3; ++i) {
        def->base_colour_lin[i] = (float)from->base[i];
    }
    def->double_sided = from->double_sided;
    def->roughness = (float)from->roughness;
    def->light_map_scale = plan->light_mapped ? stored_light_scale : 1.0f;
    def->colour_texture = def->light_map = def->normal_map = DIP_NO_TEXTURE;
    plan->unlit = from->unlit;
    plan->opacity = plan->normal = plan->light = no_use;
    plan->metal_rough = plan->gloss = plan->occlusion = plan->emission = no_use;
    plan->colour = use(maker, &from->colour, "colour texture");
    place_or_drop(maker, &from->colour, false, &at_uv1, &plan->colour);
    if (maker->scene->model->normal_maps) {
        plan->normal = use(maker, &from->normal, "normal map");
        place_or_drop(maker, &from->normal, false, &at_uv1, &plan->normal);
    }
    if (plan->light_mapped) {
        read_light_map(maker);
    } else if ((plan->tag == DIP_TAG_SOLID || plan->tag == DIP_TAG_MASK) && !plan->unlit &&
               !plan->plain) {
        read_pbr(maker);
    }
    read_surface(maker);
    float f0[3];
    for (int i = 0; i < 3; ++i) {
        f0[i] = from->is_glossy && from->gloss.index < 0 ? (float)from->f0[i] : specular[i];
    }
    dip_material_set_highlight(def, def->roughness, f0);
    warn_of_lost_light(maker);
    warn_of_normal_scale(maker);
}

static int add(Maker *maker, DipGltfScene *scene) {
    maker->def.name = dip_model_copy_text(scene->model, maker->from.name);
    if (!maker->def.name) {
        dip_model_out_of_memory(scene->reader.gltf.err, scene->reader.gltf.path);
        return DIP_NOT_FOUND;
    }
    fill(maker);
    return maker->ok ? dip_model_add_material(scene->model, &maker->def, &maker->plan,
                                              scene->reader.gltf.err)
                     : DIP_NOT_FOUND;
}

// Returns whether the alpha of a part's vertices changes the surface.
static bool has_vertex_alpha(const Maker *maker) {
    return maker->part->has_alpha &&
           (maker->plan.tag == DIP_TAG_MASK ||
            dip_gltf_shows_alpha(&maker->scene->reader.gltf, maker->part->material));
}

int dip_gltf_scene_material(DipGltfScene *scene, int part, const DipGltfNodeState *state) {
    const DipGltfPart *source = &scene->reader.parts[part];
    const int count = scene->reader.gltf.tables[DIP_GLTF_materials].count;
    Maker maker = {.scene = scene,
                   .part = source,
                   .mesh_name = scene->reader.model->meshes[part].name,
                   .ok = true,
                   .plan = {.file = scene->file,
                            .source = (unsigned)(source->material < 0 ? count : source->material),
                            .tag = state->tag,
                            .light_mapped = state->light_mapped,
                            .plain = state->plain}};
    for (int set = 0; set < DIP_GLTF_MAX_SETS; ++set) {
        maker.plan.coordinates |= source->sets[set] ? 1u << set : 0u;
    }
    const char *name = scene->model->files[scene->file].material_names[maker.plan.source];
    dip_model_apply_rules(scene->model, name, &maker.plan);
    maker.plan.vertex_alpha = has_vertex_alpha(&maker);
    int material = dip_model_find_material(scene->model, &maker.plan);
    if (material < 0) {
        const bool ok =
            dip_gltf_describe_material(&scene->reader.gltf, source->material, &maker.from);
        material = ok ? add(&maker, scene) : DIP_NOT_FOUND;
    }
    return material;
}
