// Gives the materials of half of the scenes what model files may give them: metal and gloss,
// blending, alphas of vertices, and lights. Mirrors axes of textures, if this was asked for.
//
// These choices come after all others of a scene, so that files of choices that were saved before
// keep their meaning. The maps that are chosen here repeat, and are textures of their own.
#include "tests/stability/search/maker.h"

// Returns a number from 0 to 1. The number 0 means 0.
static float choose_amount(SearchMaker *maker) {
    return (float)choices_draw(maker->choices, 9) / 8.0f;
}

// Returns a number from 0 to 1, and most often 0 or 1, so that what glass lets through is seen. The
// number 0 means 0.
static float choose_extreme(SearchMaker *maker) {
    static const float amounts[] = {0.0f, 0.0f, 0.0f, 0.0f, 0.125f, 0.5f, 0.875f, 1.0f, 1.0f};
    return amounts[choices_draw(maker->choices, sizeof amounts / sizeof *amounts)];
}

// Returns a number from 1 to 0. The number 0 means 1.
static float choose_share(SearchMaker *maker) {
    return 1.0f - choose_amount(maker);
}

static void choose_colour(SearchMaker *maker, float rgb_lin[3]) {
    for (int c = 0; c < 3; c++) {
        rgb_lin[c] = choose_share(maker);
    }
}

// Adds a texture for one material in `one_in`, or returns DIP_NO_TEXTURE.
static int choose_map(SearchMaker *maker, int one_in, DipEncoding encoding) {
    DipTestScene *scene = &maker->made->scene;
    const bool wanted = choices_rarely(maker->choices, one_in);
    if (!wanted || scene->def.texture_count == DIP_TEST_SCENE_PARTS) {
        return DIP_NO_TEXTURE;
    }
    const DipTestTexture kind = choices_draw(maker->choices, 2) ? DIP_TEST_NOISE : DIP_TEST_CHECKER;
    const int texture = dip_test_scene_add_texture(scene, kind, 32, 32);
    scene->textures[texture].encoding = encoding;
    return texture;
}

static void choose_maps(SearchMaker *maker, DipPbrDef *pbr) {
    pbr->metal_rough_map = choose_map(maker, 4, DIP_ENCODING_LINEAR);
    pbr->occlusion_map = choose_map(maker, 4, DIP_ENCODING_LINEAR);
    pbr->occlusion_at_uv1 = choices_draw(maker->choices, 2);
    pbr->occlusion_strength = choose_share(maker);
    pbr->emission_map = choose_map(maker, 4, DIP_ENCODING_SRGB);
    pbr->emission_at_uv1 = choices_draw(maker->choices, 2);
    if (choices_rarely(maker->choices, 4)) {
        choose_colour(maker, pbr->emission_lin);
    }
}

static void choose_layers(SearchMaker *maker, DipPbrDef *pbr) {
    if (choices_rarely(maker->choices, 3)) {
        pbr->coat = choose_share(maker);
        pbr->coat_roughness = choose_amount(maker);
    }
    if (choices_rarely(maker->choices, 2)) {
        choose_colour(maker, pbr->sheen_lin);
        pbr->sheen_roughness = choose_amount(maker);
    }
    if (choices_draw(maker->choices, 4)) {
        pbr->transmission = 1.0f - choose_extreme(maker);
    }
}

static void choose_gloss(SearchMaker *maker, int material) {
    Choices *choices = maker->choices;
    const float metallic = choose_extreme(maker);
    DipPbrDef *pbr =
        dip_test_scene_add_pbr(&maker->made->scene, material, metallic, choose_share(maker));
    if (choices_rarely(choices, 3)) {
        choose_colour(maker, pbr->f0_lin);
        pbr->f90 = choose_share(maker);
    }
    if (choices_rarely(choices, 3)) {
        pbr->normal_scale = 2.0f * choose_share(maker);
    }
    choose_maps(maker, pbr);
    choose_layers(maker, pbr);
}

static bool is_plain(const DipMaterialDef *material) {
    return material->surface == DIP_SURFACE_OPAQUE || material->surface == DIP_SURFACE_CLIPPED;
}

static void finish_material(SearchMaker *maker, int index, bool clear_water) {
    DipMaterialDef *material = &maker->made->scene.materials[index];
    if (material->surface == DIP_SURFACE_WATER && clear_water) {
        material->transmission = choose_share(maker);
    }
    if (!is_plain(material)) {
        return;
    }
    if (material->surface == DIP_SURFACE_OPAQUE && choices_draw(maker->choices, 4) &&
        !clear_water) {
        material->surface = DIP_SURFACE_BLENDED;
        material->opacity = 1.0f - 0.75f * choose_extreme(maker);
    }
    if (choices_draw(maker->choices, 4)) {
        choose_gloss(maker, index);
    }
}

static void choose_alphas(SearchMaker *maker, int index) {
    DipTestScene *scene = &maker->made->scene;
    DipMeshDef *mesh = &scene->meshes[index];
    const DipSurface surface = scene->materials[mesh->material].surface;
    const bool has_alpha = surface == DIP_SURFACE_CLIPPED || surface == DIP_SURFACE_BLENDED;
    if (!has_alpha || !choices_rarely(maker->choices, 2)) {
        return;
    }
    float *alphas = dip_test_scene_alloc(scene, mesh->vertex_count, sizeof *alphas);
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        alphas[v] = choose_share(maker);
    }
    mesh->alphas = alphas;
}

static void choose_light(SearchMaker *maker, DipLightDef *light) {
    Choices *choices = maker->choices;
    *light = (DipLightDef){.direction_world = {0.25f, -1.0f, -0.5f}, .attenuation = {1.0f}};
    choose_colour(maker, light->colour_lin);
    light->kind = choices_draw(choices, 2) ? DIP_LIGHT_POINT : DIP_LIGHT_DIRECTIONAL;
    for (int i = 0; i < 3; i++) {
        light->direction_world[i] += (float)choices_real(choices, 0.5);
        light->position_world[i] =
            (float)(maker->made->scene.pose.position_world[i] + choices_real(choices, 4.0));
    }
}

static void choose_lights(SearchMaker *maker) {
    DipTestScene *scene = &maker->made->scene;
    const int count = (int)choices_draw(maker->choices, 4);
    for (int i = 0; i < count; i++) {
        choose_light(maker, &scene->lights[i]);
    }
    const float ambient = choose_amount(maker);
    scene->lighting = (DipLightingDef){
        .ambient_lin = {ambient, ambient, ambient},
        .lights = scene->lights,
        .light_count = count,
        .shading = choices_draw(maker->choices, 2) ? DIP_SHADING_GOURAUD : DIP_SHADING_PHONG};
    scene->def.lighting = &scene->lighting;
}

static bool is_of_sky(const DipTestScene *scene, int texture) {
    for (int i = 0; i < scene->def.material_count; i++) {
        if (scene->materials[i].surface == DIP_SURFACE_SKY &&
            scene->materials[i].colour_texture == texture) {
            return true;
        }
    }
    return false;
}

static DipWrap choose_wrap(SearchMaker *maker, DipWrap wrap) {
    return choices_draw(maker->choices, 2) ? DIP_WRAP_MIRROR : wrap;
}

// Random scenes without mirrored textures draw no numbers here, and stay what they were before
// textures could be mirrored. Files from before have no numbers left, so all of these are 0.
static void choose_mirrors(SearchMaker *maker) {
    DipTestScene *scene = &maker->made->scene;
    if (!maker->choices->recorded && !maker->choices->mirrored) {
        return;
    }
    for (int i = 0; i < scene->def.texture_count; i++) {
        DipTextureDef *texture = &scene->textures[i];
        if (!is_of_sky(scene, i)) {
            texture->wrap_u = choose_wrap(maker, texture->wrap_u);
            texture->wrap_v = choose_wrap(maker, texture->wrap_v);
        }
    }
}

static void finish_like_a_model(SearchMaker *maker) {
    DipTestScene *scene = &maker->made->scene;
    if (!choices_rarely(maker->choices, 2)) {
        return;
    }
    // No order is promised where blended surfaces and water that one sees through overlap, so a
    // scene has one of the two only.
    const bool clear_water = choices_rarely(maker->choices, 4);
    for (int i = 0; i < scene->def.material_count; i++) {
        finish_material(maker, i, clear_water);
    }
    for (int i = 0; i < scene->def.mesh_count; i++) {
        choose_alphas(maker, i);
    }
    if (choices_rarely(maker->choices, 3)) {
        choose_lights(maker);
    }
    const float scattering = choices_draw(maker->choices, 2) ? 1.0f : 0.0f;
    for (int i = 0; i < scene->def.material_count; i++) {
        scene->pbrs[i].scattering = scattering;
    }
}

void search_finish_materials(SearchMaker *maker) {
    finish_like_a_model(maker);
    choose_mirrors(maker);
}
