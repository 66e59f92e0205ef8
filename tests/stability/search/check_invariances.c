// Compares pictures that must have the same bits: of one scene drawn in different ways, and of
// scenes that must look the same.
#include "tests/stability/search/check.h"

#include <math.h>
#include <string.h>

// How to draw a scene.
typedef struct Way {
    DipPool *pool;
    DipIsa isa;
    bool force_all_effects;
    bool together; // draw a second frame with other settings at the same time
} Way;

// Changes a scene in a way that must not change its picture. Returns false if the scene is none of
// those for which this is promised.
typedef bool Change(SearchScene *made);

// --- drawing -------------------------------------------------------------------------------------

static DipRenderer *create_renderer(const SearchScene *made, const Way *way, DipQuality quality,
                                    DipError *err) {
    DipRendererDef def = dip_renderer_default_def();
    def.pool = way->pool;
    def.isa = way->isa;
    def.width = made->width;
    def.height = made->height;
    def.quality = quality;
    def.reflection = made->scene.reflection;
    def.force_all_effects = way->force_all_effects;
    DipRenderer *renderer = dip_renderer_create(&def, err);
    if (renderer) {
        dip_renderer_set_frame_index(renderer, made->frame_index);
    }
    return renderer;
}

static bool draw_frames(const SearchScene *made, const Way *way, const DipScene *scene,
                        char hash[33], DipError *err) {
    DipQuality other = dip_quality_default();
    other.step[DIP_SETTING_GI] = made->quality.step[DIP_SETTING_GI];
    other.step[DIP_SETTING_AA] = 4;
    DipRenderer *renderers[2] = {create_renderer(made, way, made->quality, err), NULL};
    renderers[1] = way->together ? create_renderer(made, way, other, err) : NULL;
    DipFrame frames[2];
    DipFrame *const drawn[2] = {&frames[0], &frames[1]};
    const int count = way->together ? 2 : 1;
    const bool good = renderers[0] && (renderers[1] || !way->together) &&
                      dip_renderer_draw_frames(renderers, count, scene, &made->scene.pose,
                                               made->time_ns, drawn, err);
    if (good) {
        dip_frame_hash(&frames[0], hash);
    }
    dip_renderer_destroy(&renderers[0]);
    dip_renderer_destroy(&renderers[1]);
    return good;
}

// Draws a scene. If this fails, the hash is the error's text, so that it differs from others.
static bool draw_hash(const SearchScene *made, const Way *way, char hash[33],
                      SearchFinding *finding) {
    DipError err = {0};
    DipScene *scene = dip_scene_create(&made->scene.def, way->pool, &err);
    const bool good = scene && draw_frames(made, way, scene, hash, &err);
    dip_scene_destroy(&scene);
    return good || search_found(finding, "drawing", INFINITY, "%s %s", err.key, err.message);
}

// --- scenes that look the same -------------------------------------------------------------------

// Calls `is` for each vertex of each object. Returns true if it returns true for all of them.
static bool all_vertices(const SearchScene *made,
                         bool (*is)(const SearchScene *made, const double offset[3])) {
    for (int i = 0; i < made->scene.def.object_count; i++) {
        const DipObjectDef *object = &made->scene.objects[i];
        for (uint32_t v = 0; v < made->scene.meshes[object->mesh].vertex_count; v++) {
            double offset[3];
            search_vertex_from_eye(made, object, v, offset);
            if (!is(made, offset)) {
                return false;
            }
        }
    }
    return true;
}

static bool is_behind_near_plane(const SearchScene *made, const double offset[3]) {
    return search_depth(made, offset) >= 1.001 * (double)made->scene.def.near_m;
}

static bool move_near_plane(SearchScene *made) {
    const bool possible = made->scene.reflection.width == 0 && made->scene.def.near_m > 1e-9f &&
                          all_vertices(made, is_behind_near_plane);
    made->scene.def.near_m *= 0x1p-7f;
    return possible;
}

// Corners on edges that reach further than 512 m are computed in double. So only a world that is
// smaller can be scaled.
static bool is_close(const SearchScene *made, const double offset[3]) {
    (void)made;
    return fabs(offset[0]) < 200.0 && fabs(offset[1]) < 200.0 && fabs(offset[2]) < 200.0;
}

static bool is_identity(const DipObjectDef *object) {
    static const float identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    return memcmp(object->transform, identity, sizeof identity) == 0;
}

static bool all_identity(const SearchScene *made) {
    for (int i = 0; i < made->scene.def.object_count; i++) {
        if (!is_identity(&made->scene.objects[i])) {
            return false;
        }
    }
    return true;
}

// Other lights would have to be scaled or moved with the world.
static bool all_lights_are_directional(const SearchScene *made) {
    for (int i = 0; i < made->scene.lighting.light_count; i++) {
        if (made->scene.lights[i].kind != DIP_LIGHT_DIRECTIONAL) {
            return false;
        }
    }
    return true;
}

static bool scale_world(SearchScene *made) {
    const double factor = 0x1p-9;
    const double *eye = made->scene.pose.position_world;
    bool possible = made->scene.def.near_m > 1e-9f && all_identity(made) &&
                    all_lights_are_directional(made) && all_vertices(made, is_close) &&
                    is_close(made, eye);
    for (int m = 0; m < made->scene.def.mesh_count; m++) {
        float *positions = (float *)(uintptr_t)made->scene.meshes[m].positions;
        for (uint32_t i = 0; i < 3 * made->scene.meshes[m].vertex_count; i++) {
            possible = possible && (positions[i] == 0.0f || fabsf(positions[i]) > 1e-15f);
            positions[i] *= (float)factor;
        }
    }
    for (int i = 0; i < 3; i++) {
        made->scene.pose.position_world[i] *= factor;
    }
    made->scene.reflection.level_m *= factor;
    made->scene.def.near_m *= (float)factor;
    return possible;
}

// Adds a number to a float. Returns false if the sum is rounded.
static bool add_exactly(float *value, double number) {
    const float sum = (float)((double)*value + number);
    const bool exact = (double)sum - number == (double)*value;
    *value = sum;
    return exact;
}

static bool move_all(SearchScene *made) {
    static const double move[3] = {3072.0, -1024.0, 5120.0};
    bool exact = all_identity(made) && all_lights_are_directional(made);
    for (int m = 0; m < made->scene.def.mesh_count; m++) {
        float *positions = (float *)(uintptr_t)made->scene.meshes[m].positions;
        for (uint32_t i = 0; i < 3 * made->scene.meshes[m].vertex_count; i++) {
            exact = add_exactly(&positions[i], move[i % 3]) && exact;
        }
    }
    for (int i = 0; i < 3; i++) {
        double *eye = &made->scene.pose.position_world[i];
        const double old = *eye;
        *eye += move[i];
        exact = exact && *eye - move[i] == old;
    }
    const double level = made->scene.reflection.level_m;
    made->scene.reflection.level_m += move[1];
    return exact && made->scene.reflection.level_m - move[1] == level;
}

static bool repeats(const SearchScene *made, int texture, int axis) {
    if (texture == DIP_NO_TEXTURE) {
        return true;
    }
    const DipTextureDef *def = &made->scene.textures[texture];
    const DipWrap wrap = axis ? def->wrap_v : def->wrap_u;
    return wrap == DIP_WRAP_REPEAT || wrap == DIP_WRAP_MIRROR;
}

// Adds even numbers, which move mirrored textures by whole pairs of copies.
static bool add_whole_numbers(SearchScene *made) {
    bool any = false;
    for (int m = 0; m < made->scene.def.mesh_count; m++) {
        const DipMeshDef *mesh = &made->scene.meshes[m];
        const DipMaterialDef *material = &made->scene.materials[mesh->material];
        float *uv0 = (float *)(uintptr_t)mesh->uv0;
        for (int axis = 0; uv0 && axis < 2; axis++) {
            if (material->surface == DIP_SURFACE_SKY ||
                !repeats(made, material->colour_texture, axis) ||
                !repeats(made, material->normal_map, axis)) {
                continue;
            }
            for (uint32_t v = 0; v < mesh->vertex_count; v++) {
                if (!add_exactly(&uv0[2 * v + (uint32_t)axis], axis ? -256.0 : 1280.0)) {
                    return false;
                }
            }
            any = true;
        }
    }
    return any;
}

static bool switch_instancing(SearchScene *made) {
    made->quality.step[DIP_SETTING_GI] ^= 1;
    return true;
}

typedef struct Invariance {
    const char *name;
    Change *change;
} Invariance;

static const Invariance invariances[] = {
    {"near plane", move_near_plane},
    {"world scaled by 2^-9", scale_world},
    {"moved together by multiples of 1024 m", move_all},
    {"texture coordinates plus whole numbers", add_whole_numbers},
    {"geometry instancing", switch_instancing},
};

// --- the check -----------------------------------------------------------------------------------

static bool is_wanted(const char *only, const char *name) {
    return !only || strcmp(only, "drawing") == 0 || strcmp(only, name) == 0;
}

static bool check_way(const SearchScene *made, const Way *way, const char *name,
                      const char *expected, SearchFinding *finding) {
    char hash[33];
    if (!draw_hash(made, way, hash, finding)) {
        return false;
    }
    return strcmp(hash, expected) == 0 ||
           search_found(finding, name, 1.0, "the picture has other bits (%s instead of %s, %s)",
                        hash, expected, dip_isa_name(way->isa));
}

static bool check_ways(const SearchBench *bench, const SearchScene *made, const char *only,
                       const char *expected, SearchFinding *finding) {
    Way way = {.pool = bench->pool_of_many, .isa = dip_isa_best()};
    bool good = !is_wanted(only, "threads") || check_way(made, &way, "threads", expected, finding);
    way.pool = bench->pool_of_one;
    for (int i = 0; good && is_wanted(only, "instruction set") && i < DIP_ISA_COUNT; i++) {
        way.isa = (DipIsa)i;
        good = !dip_isa_available(way.isa) || way.isa == dip_isa_best() ||
               check_way(made, &way, "instruction set", expected, finding);
    }
    way.isa = dip_isa_best();
    way.force_all_effects = true;
    good = good && (!is_wanted(only, "all effects forced") ||
                    check_way(made, &way, "all effects forced", expected, finding));
    way.force_all_effects = false;
    way.together = true;
    return good && (!is_wanted(only, "frames drawn together") ||
                    check_way(made, &way, "frames drawn together", expected, finding));
}

static bool check_changes(const Way *way, Choices *choices, const char *only, const char *expected,
                          SearchFinding *finding) {
    static SearchScene changed;
    bool good = true;
    for (size_t i = 0; good && i < sizeof invariances / sizeof *invariances; i++) {
        if (!is_wanted(only, invariances[i].name)) {
            continue;
        }
        choices_rewind(choices);
        search_scene_make(&changed, choices);
        if (invariances[i].change(&changed)) {
            good = check_way(&changed, way, invariances[i].name, expected, finding);
        }
        dip_test_scene_free(&changed.scene);
    }
    return good;
}

bool search_check_invariances(const SearchBench *bench, Choices *choices, const char *only,
                              SearchFinding *finding) {
    static SearchScene made;
    choices_rewind(choices);
    search_scene_make(&made, choices);
    const Way way = {.pool = bench->pool_of_one, .isa = dip_isa_best()};
    char expected[33];
    const bool good = draw_hash(&made, &way, expected, finding) &&
                      check_ways(bench, &made, only, expected, finding) &&
                      check_changes(&way, choices, only, expected, finding);
    dip_test_scene_free(&made.scene);
    return good;
}
