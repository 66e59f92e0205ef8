// Makes the materials and textures of adversarial scenes.
#include "tests/stability/search/maker.h"

#include <stddef.h>

static const int sizes[][2] = {{16, 16}, {64, 64}, {256, 256}, {7, 5},   {1, 9},
                               {9, 1},   {1, 1},   {33, 17},   {128, 4}, {2, 64}};

static void choose_alpha(SearchMaker *maker, int texture) {
    DipTestScene *scene = &maker->made->scene;
    uint8_t *texels = dip_test_scene_texels(scene, texture);
    const int width = scene->textures[texture].width;
    const int count = width * scene->textures[texture].height;
    const int kind = (int)choices_draw(maker->choices, 4);
    for (int i = 0; i < count; i++) {
        const int x = i % width;
        const int y = i / width;
        const int alphas[] = {x % 8 < 2 || y % 8 < 2 ? 255 : 0, 128, (x * 37 + y * 11) & 255,
                              texels[4 * i]};
        texels[4 * i + 3] = (uint8_t)alphas[kind];
    }
}

// Adds a texture, or returns one of the earlier ones if there are enough.
static int choose_texture(SearchMaker *maker) {
    DipTestScene *scene = &maker->made->scene;
    Choices *choices = maker->choices;
    if (scene->def.texture_count == DIP_TEST_SCENE_PARTS) {
        return (int)choices_draw(choices, DIP_TEST_SCENE_PARTS);
    }
    const int *size = sizes[choices_draw(choices, sizeof sizes / sizeof *sizes)];
    const DipTestTexture kind = choices_draw(choices, 2) ? DIP_TEST_NOISE : DIP_TEST_CHECKER;
    const int texture = dip_test_scene_add_texture(scene, kind, size[0], size[1]);
    scene->textures[texture].wrap_u = choices_rarely(choices, 4) ? DIP_WRAP_CLAMP : DIP_WRAP_REPEAT;
    scene->textures[texture].wrap_v = choices_rarely(choices, 4) ? DIP_WRAP_CLAMP : DIP_WRAP_REPEAT;
    scene->textures[texture].encoding =
        choices_rarely(choices, 4) ? DIP_ENCODING_LINEAR : DIP_ENCODING_SRGB;
    choose_alpha(maker, texture);
    return texture;
}

static bool has_room(const SearchMaker *maker) {
    return maker->made->scene.def.texture_count < DIP_TEST_SCENE_PARTS;
}

static float choose_share(SearchMaker *maker) {
    return 1.0f - (float)choices_draw(maker->choices, 9) / 8.0f;
}

static void choose_sky(SearchMaker *maker, DipMaterialDef *material) {
    DipTestScene *scene = &maker->made->scene;
    if (!has_room(maker)) {
        return;
    }
    material->surface = DIP_SURFACE_SKY;
    material->colour_texture = dip_test_scene_add_clouds(scene, 64);
    scene->def.sky.clear = 0.2f;
    scene->def.sky.dense = 0.8f;
    scene->def.sky.overcast = (float)choices_draw(maker->choices, 5) / 4.0f;
    scene->def.sky.layers[0].speed_per_min = choices_real(maker->choices, DIP_MAX_SKY_SPEED);
}

static void choose_clip(SearchMaker *maker, DipMaterialDef *material) {
    const float cutoffs[] = {0.5f, 0.0f, 1.0f, 128.0f / 255.0f, 1.0f / 255.0f, 0.25f};
    material->surface = DIP_SURFACE_CLIPPED;
    material->alpha_cutoff = cutoffs[choices_draw(maker->choices, 6)];
    material->colour_texture = choose_texture(maker);
}

static void choose_light(SearchMaker *maker, DipMaterialDef *material) {
    Choices *choices = maker->choices;
    material->lit = choices_rarely(choices, 2);
    if (choices_rarely(choices, 4)) {
        material->light_map = choose_texture(maker);
        material->light_map_scale = 2.0f * choose_share(maker);
    }
    if (choices_rarely(choices, 4) && has_room(maker)) {
        material->normal_map = choices_draw(choices, 2)
                                   ? choose_texture(maker)
                                   : dip_test_scene_add_bumps(&maker->made->scene, 64);
        material->roughness = choose_share(maker);
    }
}

int search_make_material(SearchMaker *maker) {
    Choices *choices = maker->choices;
    const int index = dip_test_scene_add_material(&maker->made->scene, DIP_NO_TEXTURE);
    DipMaterialDef *material = &maker->made->scene.materials[index];
    material->double_sided = !choices_rarely(choices, 3);
    for (int c = 0; c < 3; c++) {
        material->base_colour_lin[c] = choose_share(maker);
    }
    switch (choices_draw(choices, 8)) {
    case 4:
    case 5:
        choose_clip(maker, material);
        break;
    case 6:
        material->surface = DIP_SURFACE_WATER;
        break;
    case 7:
        choose_sky(maker, material);
        break;
    default:
        if (choices_draw(choices, 4)) {
            material->colour_texture = choose_texture(maker);
        }
    }
    if (material->surface != DIP_SURFACE_SKY) {
        choose_light(maker, material);
    }
    return index;
}
