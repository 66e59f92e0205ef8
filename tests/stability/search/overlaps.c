// Finds the pixels in which blended surfaces overlap.
#include "tests/stability/search/overlaps.h"

#include <string.h>

static bool is_blended(const DipMaterialDef *material) {
    return material->surface == DIP_SURFACE_BLENDED ||
           (material->surface == DIP_SURFACE_WATER && material->transmission > 0.0f);
}

static bool has_blended(const SearchScene *made) {
    for (int i = 0; i < made->scene.def.material_count; i++) {
        if (is_blended(&made->scene.materials[i])) {
            return true;
        }
    }
    return false;
}

// Makes blended surfaces white, with one opacity, and everything else black. What is clipped is cut
// as before, and water that is not blended mirrors as before.
static void mark_material(DipMaterialDef *material, float opacity) {
    const bool blended = is_blended(material);
    for (int c = 0; c < 3; c++) {
        material->base_colour_lin[c] = blended ? 1.0f : 0.0f;
    }
    material->lit = false;
    material->pbr = NULL;
    material->light_map = material->normal_map = DIP_NO_TEXTURE;
    if (blended) {
        material->surface = DIP_SURFACE_BLENDED;
        material->opacity = opacity;
    } else if (material->surface == DIP_SURFACE_SKY) {
        material->surface = DIP_SURFACE_OPAQUE;
    }
    if (material->surface != DIP_SURFACE_CLIPPED) {
        material->colour_texture = DIP_NO_TEXTURE;
    }
}

static void mark_scene(SearchScene *made, float opacity) {
    DipTestScene *scene = &made->scene;
    memset(scene->def.background_lin, 0, sizeof scene->def.background_lin);
    for (int i = 0; i < scene->def.mesh_count; i++) {
        if (is_blended(&scene->materials[scene->meshes[i].material])) {
            scene->meshes[i].colours_lin = NULL;
            scene->meshes[i].alphas = NULL;
        }
    }
    for (int i = 0; i < scene->def.material_count; i++) {
        mark_material(&scene->materials[i], opacity);
    }
}

static bool draw_marked(StabilityRun *run, Choices *choices, float opacity,
                        StabilityPicture *picture) {
    static SearchScene made;
    choices_rewind(choices);
    search_scene_make(&made, choices);
    mark_scene(&made, opacity);
    const StabilityShot shot = search_scene_shot(&made);
    const bool drawn = stability_draw_reference(run, &shot, picture);
    dip_test_scene_free(&made.scene);
    return drawn;
}

// A sample of n surfaces has the light 1 - (1 - opacity)^n: 0 or the opacity if n is at most 1. So
// a pixel without overlaps has half the light if the opacity is 1/2 instead of 1. Each overlap adds
// to this half.
static void compare(const StabilityPicture *half, const StabilityPicture *full, bool *overlaps) {
    enum { REACH = 2 }; // Tiny changes of the scene may move edges.
    const double least = 1e-6;
    for (int i = 0; i < full->width * full->height; i++) {
        if (half->rgb_lin[3 * i] - 0.5 * full->rgb_lin[3 * i] <= least) {
            continue;
        }
        for (int y = i / full->width - REACH; y <= i / full->width + REACH; y++) {
            for (int x = i % full->width - REACH; x <= i % full->width + REACH; x++) {
                if (x >= 0 && y >= 0 && x < full->width && y < full->height) {
                    overlaps[y * full->width + x] = true;
                }
            }
        }
    }
}

bool search_find_overlaps(StabilityRun *run, Choices *choices, bool *overlaps) {
    static SearchScene made;
    choices_rewind(choices);
    search_scene_make(&made, choices);
    const bool needed = has_blended(&made);
    memset(overlaps, 0, (size_t)made.width * (size_t)made.height * sizeof *overlaps);
    dip_test_scene_free(&made.scene);
    if (!needed) {
        return true;
    }
    StabilityPicture half = {0};
    StabilityPicture full = {0};
    const bool drawn =
        draw_marked(run, choices, 0.5f, &half) && draw_marked(run, choices, 1.0f, &full);
    if (drawn) {
        compare(&half, &full, overlaps);
    }
    stability_picture_free(&half);
    stability_picture_free(&full);
    return drawn;
}
