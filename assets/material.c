// Converts assimp's materials to those of the scene.
#include "assets/model_parts.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/scene.h>

#include <math.h>
#include <string.h>

static const float default_cutoff = 0.5f;
static const float default_roughness = 0.6f;
static const float default_grey_srgb = 0.6f;
static const float dielectric_specular = 0.04f; // light that a dielectric mirrors straight back
static const float light_map_scale = 2.0f; // Light maps marked by `lightmapped` store light / 2.

float dip_model_colour_to_linear(float value, bool linear) {
    const double x = value > 0.0f ? (value < 1.0f ? (double)value : 1.0) : 0.0; // NaN becomes 0
    if (linear) {
        return (float)x;
    }
    return (float)(x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4));
}

static DipWrap wrap_of(int mode) {
    const bool clamp = mode == aiTextureMapMode_Clamp || mode == aiTextureMapMode_Decal;
    return clamp                             ? DIP_WRAP_CLAMP
           : mode == aiTextureMapMode_Mirror ? DIP_WRAP_MIRROR
                                             : DIP_WRAP_REPEAT;
}

static void warn_of_transform(DipModel *model, const char *path, const char *name,
                              const struct aiMaterial *material, enum aiTextureType type) {
    struct aiUVTransform t = {0};
    if (aiGetMaterialUVTransform(material, AI_MATKEY_UVTRANSFORM(type, 0), &t) != AI_SUCCESS) {
        return;
    }
    const bool moves = t.mTranslation.x != 0.0f || t.mTranslation.y != 0.0f || t.mRotation != 0.0f;
    if (moves || t.mScaling.x != 1.0f || t.mScaling.y != 1.0f) {
        dip_model_warn(model, path, name, "the texture's offset, scale and rotation are not drawn");
    }
}

// Tries the given types of picture in order. Returns how the material uses the first picture for
// which the mesh has texture coordinates.
static DipTextureUse texture_use(DipModel *model, int file, const char *name,
                                 const struct aiMesh *mesh, const enum aiTextureType *types,
                                 size_t type_count) {
    DipTextureUse use = {.picture = DIP_NO_TEXTURE};
    const struct aiScene *scene = model->files[file].scene;
    const struct aiMaterial *material = scene->mMaterials[mesh->mMaterialIndex];
    const char *path = model->files[file].path;
    struct aiString without_coordinates = {0};
    for (size_t i = 0; i < type_count; ++i) {
        struct aiString texture = {0};
        unsigned channel = 0;
        enum aiTextureMapMode modes[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap,
                                          aiTextureMapMode_Wrap};
        if (aiGetMaterialTexture(material, types[i], 0, &texture, NULL, &channel, NULL, NULL, modes,
                                 NULL) != AI_SUCCESS ||
            texture.length == 0) {
            continue;
        }
        if (channel >= AI_MAX_NUMBER_OF_TEXTURECOORDS || !mesh->mTextureCoords[channel]) {
            without_coordinates = texture;
            continue;
        }
        warn_of_transform(model, path, name, material, types[i]);
        use.picture = dip_model_picture(model, file, texture.data);
        use.uv_channel = (int)channel;
        use.wrap_u = wrap_of((int)modes[0]);
        use.wrap_v = wrap_of((int)modes[1]);
        return use;
    }
    if (without_coordinates.length > 0) {
        dip_model_warn(model, path, name,
                       "mesh \"%s\" has no texture coordinates, so its texture %s is ignored",
                       mesh->mName.data, without_coordinates.data);
    }
    return use;
}

static float float_property(const struct aiMaterial *material, const char *key, unsigned type,
                            unsigned index, float otherwise) {
    ai_real value = 0.0f;
    const bool found =
        aiGetMaterialFloatArray(material, key, type, index, &value, NULL) == AI_SUCCESS;
    return found && isfinite(value) ? value : otherwise;
}

static bool is_black(const float lin[3]) {
    return lin[0] == 0.0f && lin[1] == 0.0f && lin[2] == 0.0f;
}

// Reads the base colour and returns its alpha. Outside glTF, many files have a black base colour
// that does not count: with a colour texture, many exporters write black for "none"; black with an
// alpha of 0 is a material that nobody has filled in, and becomes assimp's default grey.
static float read_base_colour(const DipModelFile *file, const struct aiMaterial *material,
                              bool textured, float base_lin[3]) {
    struct aiColor4D colour = {1.0f, 1.0f, 1.0f, 1.0f};
    if (aiGetMaterialColor(material, AI_MATKEY_BASE_COLOR, &colour) != AI_SUCCESS) {
        aiGetMaterialColor(material, AI_MATKEY_COLOR_DIFFUSE, &colour);
    }
    base_lin[0] = dip_model_colour_to_linear(colour.r, file->linear_colours);
    base_lin[1] = dip_model_colour_to_linear(colour.g, file->linear_colours);
    base_lin[2] = dip_model_colour_to_linear(colour.b, file->linear_colours);
    if (is_black(base_lin) && !file->linear_colours && (textured || colour.a == 0.0f)) {
        const float grey = dip_model_colour_to_linear(default_grey_srgb, false);
        base_lin[0] = base_lin[1] = base_lin[2] = textured ? 1.0f : grey;
    }
    return colour.a;
}

float dip_texel_cutoff(float cutoff, float base_alpha) {
    return cutoff > 0.0f ? fminf(fmaxf(cutoff / base_alpha, 0.0f), 1.0f) : 0.0f;
}

// Decides whether the surface is alpha-clipped and at which alpha. base_alpha multiplies the alpha
// of every texel.
static void read_alpha(DipModel *model, const DipModelFile *file, const struct aiMaterial *material,
                       float base_alpha, DipMaterialPlan *plan, DipMaterialDef *def) {
    struct aiString mode = {0};
    const bool has_mode =
        aiGetMaterialString(material, AI_MATKEY_GLTF_ALPHAMODE, &mode) == AI_SUCCESS;
    const bool masked = has_mode && strcmp(mode.data, "MASK") == 0;
    const bool blended = has_mode && strcmp(mode.data, "BLEND") == 0;
    def->alpha_cutoff = default_cutoff;
    if (masked) {
        const float cutoff = float_property(material, AI_MATKEY_GLTF_ALPHACUTOFF, default_cutoff);
        plan->invisible = base_alpha < cutoff;
        def->alpha_cutoff = dip_texel_cutoff(cutoff, base_alpha);
    } else if (blended) {
        dip_model_warn(
            model, file->path, def->name,
            "blending is not drawn: the surface is solid where its texture's alpha is 0.5 or more");
    }
    const float opacity = float_property(material, AI_MATKEY_OPACITY, 1.0f);
    if (masked || blended || plan->opacity.picture >= 0 || plan->tag == DIP_TAG_MASK) {
        def->surface = DIP_SURFACE_CLIPPED;
    } else if (opacity > 0.0f && opacity < 1.0f) {
        def->surface = DIP_SURFACE_BLENDED;
        def->opacity = opacity;
    } else if (opacity <= 0.0f) { // Nobody exports what cannot be seen.
        dip_model_warn(model, file->path, def->name,
                       "the opacity is 0 or less in the file: the surface is drawn solid");
    }
}

// True if the mesh's material, outside glTF, has a black base colour. Such a surface shows nothing
// but its highlights, so its specular texture becomes its colour texture.
static bool shows_only_highlights(const DipModelFile *file, const struct aiMesh *mesh) {
    float base_lin[3];
    const struct aiMaterial *material = file->scene->mMaterials[mesh->mMaterialIndex];
    read_base_colour(file, material, false, base_lin);
    return !file->linear_colours && is_black(base_lin);
}

// Returns how the material uses its light map. The picture of a rule has no texture coordinates of
// its own in the file, so it takes the mesh's second set, or the first if there is only one.
static DipTextureUse light_use(DipModel *model, int file, const char *name,
                               const struct aiMesh *mesh, const DipMaterialRule *rule) {
    static const enum aiTextureType types[] = {aiTextureType_LIGHTMAP};
    DipTextureUse use = {.picture = DIP_NO_TEXTURE};
    const char *path = model->files[file].path;
    if (!rule || !rule->light_map) {
        use = texture_use(model, file, name, mesh, types, 1);
        if (rule && use.picture < 0) {
            dip_model_warn(model, path, name,
                           "the material is marked as light-mapped, but has no light map");
        }
    } else if (!mesh->mTextureCoords[0]) {
        dip_model_warn(model, path, name,
                       "mesh \"%s\" has no texture coordinates, so its light map %s is ignored",
                       mesh->mName.data, rule->light_map);
    } else {
        use.picture = dip_model_picture_file(model, file, rule->light_map);
        use.uv_channel = mesh->mTextureCoords[1] ? 1 : 0;
        use.wrap_u = use.wrap_v = DIP_WRAP_REPEAT;
    }
    return use;
}

static void read_pictures(DipModel *model, int file, const char *name, const struct aiMesh *mesh,
                          DipMaterialPlan *plan) {
    static const enum aiTextureType colour[] = {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE};
    static const enum aiTextureType specular[] = {aiTextureType_SPECULAR};
    static const enum aiTextureType opacity[] = {aiTextureType_OPACITY};
    static const enum aiTextureType normal[] = {aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA};
    plan->colour = texture_use(model, file, name, mesh, colour, 2);
    if (plan->colour.picture < 0 && shows_only_highlights(&model->files[file], mesh)) {
        plan->colour = texture_use(model, file, name, mesh, specular, 1);
    }
    plan->opacity = texture_use(model, file, name, mesh, opacity, 1);
    plan->normal = (DipTextureUse){.picture = DIP_NO_TEXTURE};
    if (model->normal_maps) {
        plan->normal = texture_use(model, file, name, mesh, normal, 2);
    }
    plan->light = (DipTextureUse){.picture = DIP_NO_TEXTURE};
    plan->metal_rough = plan->gloss = plan->occlusion = plan->emission = plan->light;
    // In glTF the occlusion picture is a light map only if the object's metadata says so.
    if (plan->light_mapped || !model->files[file].linear_colours) {
        plan->light = light_use(model, file, name, mesh, plan->light_rule);
    }
    plan->has_uv1 = plan->light.picture >= 0;
    plan->has_uv0 =
        plan->colour.picture >= 0 || plan->opacity.picture >= 0 || plan->normal.picture >= 0;
}

// The exponent follows from the roughness, and the factor (n + 8) / 8 keeps the highlight's light
// the same for all exponents.
void dip_material_set_highlight(DipMaterialDef *def, float roughness, const float specular_lin[3]) {
    const double alpha = (double)roughness * (double)roughness;
    const double exponent = 2.0 / fmax(alpha * alpha, 1e-9) - 2.0;
    def->shininess = (float)fmin(fmax(exponent, 1.0), DIP_MAX_SHININESS);
    const float scale = (def->shininess + 8.0f) / 8.0f;
    for (int c = 0; c < 3; ++c) {
        def->specular_lin[c] = scale * dip_model_colour_to_linear(specular_lin[c], true);
    }
}

// Sets the highlight of the scene's lights. Outside glTF, a material without an exponent has none.
static void set_highlight(const DipModelFile *file, const struct aiMaterial *material,
                          DipMaterialDef *def) {
    struct aiColor4D specular = {0};
    const float shininess = float_property(material, AI_MATKEY_SHININESS, 0.0f);
    const float strength = float_property(material, AI_MATKEY_SHININESS_STRENGTH, 1.0f);
    if (file->linear_colours) {
        const float dielectric[3] = {dielectric_specular, dielectric_specular, dielectric_specular};
        dip_material_set_highlight(def, def->roughness, dielectric);
    } else if (shininess > 0.0f && strength > 0.0f &&
               aiGetMaterialColor(material, AI_MATKEY_COLOR_SPECULAR, &specular) == AI_SUCCESS) {
        const float scale = fminf(strength, DIP_MAX_LIGHT_LIN);
        def->shininess = fminf(shininess, (float)DIP_MAX_SHININESS);
        def->specular_lin[0] = scale * dip_model_colour_to_linear(specular.r, false);
        def->specular_lin[1] = scale * dip_model_colour_to_linear(specular.g, false);
        def->specular_lin[2] = scale * dip_model_colour_to_linear(specular.b, false);
    }
}

static void fill_material(DipModel *model, int file_index, const struct aiMesh *mesh,
                          DipMaterialPlan *plan, DipMaterialDef *def) {
    const DipModelFile *file = &model->files[file_index];
    const struct aiMaterial *material = file->scene->mMaterials[mesh->mMaterialIndex];
    read_pictures(model, file_index, def->name, mesh, plan);
    const bool textured = plan->colour.picture >= 0;
    const float base_alpha = read_base_colour(file, material, textured, def->base_colour_lin);
    read_alpha(model, file, material, base_alpha, plan, def);
    if (plan->tag == DIP_TAG_WATER) {
        def->surface = DIP_SURFACE_WATER;
        def->transmission = 1.0f - def->opacity;
        def->opacity = 1.0f;
    } else if (plan->tag == DIP_TAG_SKY) {
        def->surface = DIP_SURFACE_SKY;
    }
    int two_sided = 0;
    const bool says =
        aiGetMaterialIntegerArray(material, AI_MATKEY_TWOSIDED, &two_sided, NULL) == AI_SUCCESS;
    def->double_sided = says ? two_sided != 0 : !file->linear_colours;
    const float roughness = float_property(material, AI_MATKEY_ROUGHNESS_FACTOR, default_roughness);
    def->roughness = fminf(fmaxf(roughness, 0.0f), 1.0f);
    set_highlight(file, material, def);
    def->light_map_scale = plan->light_mapped ? light_map_scale : 1.0f;
    def->colour_texture = def->light_map = def->normal_map = DIP_NO_TEXTURE;
}

// Returns one bit for each set of texture coordinates that the mesh has. Meshes with different sets
// cannot share a material.
static unsigned coordinate_mask(const struct aiMesh *mesh) {
    unsigned mask = 0;
    for (unsigned i = 0; i < AI_MAX_NUMBER_OF_TEXTURECOORDS; ++i) {
        mask |= mesh->mTextureCoords[i] ? 1u << i : 0u;
    }
    return mask;
}

int dip_model_find_material(const DipModel *model, const DipMaterialPlan *plan) {
    for (int i = 0; i < model->def.material_count; ++i) {
        const DipMaterialPlan *other = &model->plans[i];
        if (other->file == plan->file && other->source == plan->source && other->tag == plan->tag &&
            other->light_mapped == plan->light_mapped && other->plain == plan->plain &&
            other->coordinates == plan->coordinates && other->vertex_alpha == plan->vertex_alpha) {
            return i;
        }
    }
    return DIP_NOT_FOUND;
}

int dip_model_add_material(DipModel *model, const DipMaterialDef *def, const DipMaterialPlan *plan,
                           DipError *err) {
    const int count = model->def.material_count;
    DipMaterialDef *materials = dip_array_grow(model->materials, count, sizeof *materials);
    model->materials = materials ? materials : model->materials;
    DipMaterialPlan *plans = dip_array_grow(model->plans, count, sizeof *plans);
    model->plans = plans ? plans : model->plans;
    if (!def->name || !materials || !plans) {
        dip_model_out_of_memory(err, model->files[plan->file].path);
        return DIP_NOT_FOUND;
    }
    materials[count] = *def;
    plans[count] = *plan;
    return model->def.material_count++;
}

int dip_model_material(DipModel *model, int file, const struct aiMesh *mesh, DipTag tag,
                       bool light_mapped, DipError *err) {
    DipMaterialPlan plan = {.file = file,
                            .source = mesh->mMaterialIndex,
                            .coordinates = coordinate_mask(mesh),
                            .tag = tag,
                            .light_mapped = light_mapped};
    const char *name = model->files[file].material_names[plan.source];
    dip_model_apply_rules(model, name, &plan);
    const int known = dip_model_find_material(model, &plan);
    if (known >= 0) {
        return known;
    }
    DipMaterialDef def = {.name = dip_model_copy_text(model, name), .opacity = 1.0f};
    if (!def.name) {
        dip_model_out_of_memory(err, model->files[file].path);
        return DIP_NOT_FOUND;
    }
    fill_material(model, file, mesh, &plan, &def);
    return dip_model_add_material(model, &def, &plan, err);
}

static const DipPicture *decoded(const DipModel *model, int picture) {
    const bool usable = picture >= 0 && model->pictures[picture].error.code == DIP_ERROR_NONE;
    return usable ? &model->pictures[picture].picture : NULL;
}

// Returns the picture of a texture: the colour picture, with the alpha of the opacity picture if
// there is one, or enlarged. Opacity pictures belong to formats without hard texels.
static const DipPicture *merged_picture(DipModel *model, const DipTextureKey *key) {
    const DipPicture *colour = decoded(model, key->picture);
    const DipPicture *opacity = decoded(model, key->opacity_picture);
    const bool merges = opacity && (opacity != colour || !colour->has_alpha);
    if (!merges && key->enlargement == 1) {
        return colour;
    }
    DipPicture *merged = dip_array_grow(model->merged, model->merged_count, sizeof *merged);
    if (!merged) {
        return NULL;
    }
    model->merged = merged;
    DipPicture *to = &merged[model->merged_count];
    const bool made = merges ? dip_picture_with_opacity(colour, opacity, to)
                             : dip_picture_enlarge(colour, key->enlargement, to);
    model->merged_count += made;
    return made ? to : NULL;
}

// Returns by how much the texels of a picture are enlarged so that filtering leaves their edges
// hard: 8, but less where more than HARD_SIDE texels would be in a row.
static int enlargement_of(const DipPicture *picture) {
    enum { HARDNESS = 8, HARD_SIDE = 1024 };
    const int side = picture->width > picture->height ? picture->width : picture->height;
    int factor = HARDNESS;
    while (factor > 1 && factor * side > HARD_SIDE) {
        factor /= 2;
    }
    return factor;
}

static int add_texture(DipModel *model, const DipTextureKey *key, const DipTextureDef *wanted) {
    const int count = model->def.texture_count;
    for (int i = 0; i < count; ++i) {
        const DipTextureDef *other = &model->textures[i];
        const DipTextureKey *other_key = &model->texture_keys[i];
        if (other_key->picture == key->picture &&
            other_key->opacity_picture == key->opacity_picture &&
            other_key->enlargement == key->enlargement && other->encoding == wanted->encoding &&
            other->wrap_u == wanted->wrap_u && other->wrap_v == wanted->wrap_v) {
            return i;
        }
    }
    const DipPicture *picture = merged_picture(model, key);
    DipTextureDef *textures = dip_array_grow(model->textures, count, sizeof *textures);
    model->textures = textures ? textures : model->textures;
    DipTextureKey *keys = dip_array_grow(model->texture_keys, count, sizeof *keys);
    model->texture_keys = keys ? keys : model->texture_keys;
    if (!picture || !textures || !keys) {
        return DIP_NOT_FOUND;
    }
    textures[count] = *wanted;
    textures[count].width = picture->width;
    textures[count].height = picture->height;
    textures[count].rgba8 = picture->rgba8;
    keys[count] = *key;
    keys[count].has_alpha = picture->has_alpha;
    return model->def.texture_count++;
}

// Returns the texture that shows a picture, or DIP_NO_TEXTURE if the picture was not decoded. Sets
// *ok to false when memory runs out.
static int texture_of(DipModel *model, const DipTextureUse *use, const DipTextureUse *opacity,
                      DipEncoding encoding, bool *ok) {
    const DipPicture *picture = decoded(model, use->picture);
    const DipTextureKey key = {.picture = picture ? use->picture : DIP_NO_TEXTURE,
                               .opacity_picture = opacity && decoded(model, opacity->picture)
                                                      ? opacity->picture
                                                      : DIP_NO_TEXTURE,
                               .enlargement = picture && use->hard ? enlargement_of(picture) : 1};
    const int named = key.picture >= 0 ? key.picture : key.opacity_picture;
    if (named < 0) {
        return DIP_NO_TEXTURE;
    }
    const DipTextureUse *wraps = key.picture >= 0 ? use : opacity;
    const DipTextureDef wanted = {.name = model->pictures[named].name,
                                  .encoding = encoding,
                                  .wrap_u = wraps->wrap_u,
                                  .wrap_v = wraps->wrap_v};
    const int known = model->def.texture_count;
    const int index = add_texture(model, &key, &wanted);
    if (use->hard && key.enlargement == 1 && index == known) {
        dip_model_warn(model, wanted.name, "magFilter",
                       "the texels have hard edges (NEAREST) in the file, but are drawn smoothly, "
                       "because the picture is larger than 512x512");
    }
    *ok = *ok && index >= 0;
    return index;
}

// Multiplies f0 and the glossiness by the means of a specular-glossiness picture. f0 is that of a
// dielectric if the picture is NULL, because the factor 1 without the picture would make a mirror.
static void apply_gloss(const DipPicture *picture, DipPbrDef *pbr) {
    size_t counts[4][256] = {{0}};
    double means[4] = {0.0, 0.0, 0.0, 0.0};
    const size_t texels = picture ? (size_t)picture->width * (size_t)picture->height : 0;
    for (size_t i = 0; i < 4 * texels; ++i) {
        counts[i % 4][picture->rgba8[i]]++;
    }
    for (int c = 0; c < 4; ++c) {
        for (int value = 0; value < 256; ++value) {
            const float shown = dip_model_colour_to_linear((float)value / 255.0f, c == 3);
            means[c] += (double)counts[c][value] * (double)shown;
        }
    }
    for (int c = 0; c < 3; ++c) {
        pbr->f0_lin[c] =
            texels ? pbr->f0_lin[c] * (float)(means[c] / (double)texels) : dielectric_specular;
    }
    pbr->roughness = texels ? 1.0f - (1.0f - pbr->roughness) * (float)(means[3] / (double)texels)
                            : pbr->roughness;
}

// Gives a material's reflection its textures.
static void finish_pbr(DipModel *model, const DipMaterialPlan *plan, bool *ok) {
    DipPbrDef *pbr = plan->pbr;
    if (plan->gloss.picture >= 0) {
        apply_gloss(decoded(model, plan->gloss.picture), pbr);
    }
    pbr->metal_rough_map = texture_of(model, &plan->metal_rough, NULL, DIP_ENCODING_LINEAR, ok);
    pbr->occlusion_map = texture_of(model, &plan->occlusion, NULL, DIP_ENCODING_LINEAR, ok);
    pbr->emission_map = texture_of(model, &plan->emission, NULL, DIP_ENCODING_SRGB, ok);
}

// Makes a surface opaque if nothing of it is transparent.
static void finish_surface(const DipModel *model, const DipMaterialPlan *plan,
                           DipMaterialDef *def) {
    const int colour = def->colour_texture;
    const bool has_alpha =
        plan->vertex_alpha || (colour >= 0 && model->texture_keys[colour].has_alpha);
    const bool clipped = def->surface == DIP_SURFACE_CLIPPED;
    const bool transmits = def->pbr && def->pbr->transmission > 0.0f;
    const bool blended = def->surface == DIP_SURFACE_BLENDED && def->opacity == 1.0f && !transmits;
    if (!has_alpha && (clipped || blended)) {
        def->surface = DIP_SURFACE_OPAQUE;
    }
}

bool dip_model_finish_materials(DipModel *model, DipError *err) {
    bool ok = true;
    for (int i = 0; i < model->def.material_count; ++i) {
        const DipMaterialPlan *plan = &model->plans[i];
        DipMaterialDef *def = &model->materials[i];
        const DipEncoding encoding =
            plan->tag == DIP_TAG_SKY ? DIP_ENCODING_LINEAR : DIP_ENCODING_SRGB;
        def->colour_texture = texture_of(model, &plan->colour, &plan->opacity, encoding, &ok);
        def->light_map = texture_of(model, &plan->light, NULL, DIP_ENCODING_SRGB, &ok);
        def->normal_map = texture_of(model, &plan->normal, NULL, DIP_ENCODING_LINEAR, &ok);
        const bool solid = plan->tag == DIP_TAG_SOLID || plan->tag == DIP_TAG_MASK;
        def->lit = solid && def->light_map < 0 && !plan->unlit;
        if (def->lit && plan->pbr) {
            finish_pbr(model, plan, &ok);
            def->pbr = plan->pbr;
        }
        if (!ok) {
            return dip_model_out_of_memory(err, model->files[plan->file].path);
        }
        finish_surface(model, plan, def);
    }
    return true;
}
