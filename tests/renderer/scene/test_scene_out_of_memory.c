// Tests what scenes and renderers do when memory runs out: an operation that fails says so, leaks
// nothing and changes nothing. Afterwards, the renderer draws the right picture.
#include "renderer/scene/renderer.h"
#include "renderer/scene/resources/instancing.h"
#include "renderer/catalogue/scenes.h"
#include "tests/support/out_of_memory.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 64, HEIGHT = 48, PANES = 2 };

typedef struct Hash {
    char hex[33];
} Hash;

// A scene in memory, and what the operation under test makes of it.
typedef struct Fixture {
    DipTestScene made;
    DipPool *pool;
    DipScene *scene;
    DipRenderer *panes[PANES];
    DipFrame frames[PANES];
    DipQuality quality; // Settings that the operation selects.
    Hash before[PANES];
    Hash after[PANES]; // Pictures with these settings, from renderers that never failed.
    int width;         // Size that the operation selects.
    int height;
} Fixture;

static Hash hash_of(const DipFrame *frame) {
    Hash hash;
    dip_frame_hash(frame, hash.hex);
    return hash;
}

static void assert_same(Hash a, Hash b) {
    assert_string_equal(a.hex, b.hex);
}

static Hash draw(Fixture *fixture, int pane) {
    DipError err;
    if (!dip_renderer_draw(fixture->panes[pane], fixture->scene, &fixture->made.pose, 0,
                           &fixture->frames[pane], &err)) {
        fail_msg("cannot draw: %s", err.message);
    }
    return hash_of(&fixture->frames[pane]);
}

// --- making things -------------------------------------------------------------------------------

static bool make_scene(void *context, DipError *err) {
    Fixture *fixture = context;
    fixture->scene = dip_scene_create(&fixture->made.def, fixture->pool, err);
    return fixture->scene != NULL;
}

static bool make_renderer(void *context, DipError *err) {
    Fixture *fixture = context;
    DipRendererDef def = dip_renderer_default_def();
    def.pool = fixture->pool;
    def.width = WIDTH;
    def.height = HEIGHT;
    def.reflection = fixture->made.reflection;
    const int pane = fixture->panes[0] ? 1 : 0;
    fixture->panes[pane] = dip_renderer_create(&def, err);
    return fixture->panes[pane] != NULL;
}

static bool make_pool(void *context, DipError *err) {
    Fixture *fixture = context;
    fixture->pool = dip_pool_create(2, err);
    return fixture->pool != NULL;
}

static void must_make_scene(void *context) {
    assert_true(make_scene(context, NULL));
}

static void must_make_panes(void *context) {
    must_make_scene(context);
    for (int p = 0; p < PANES; p++) {
        assert_true(make_renderer(context, NULL));
    }
}

static void free_panes(void *context) {
    Fixture *fixture = context;
    for (int p = 0; p < PANES; p++) {
        dip_renderer_destroy(&fixture->panes[p]);
    }
    dip_scene_destroy(&fixture->scene);
}

static void free_pool(void *context) {
    dip_pool_destroy(&((Fixture *)context)->pool);
}

// Stores the first picture of each pane, drawn by new renderers.
static void draw_truth(Fixture *fixture, const DipQuality *quality, Hash hashes[PANES]) {
    must_make_panes(fixture);
    for (int p = 0; p < PANES; p++) {
        if (quality) {
            assert_true(dip_renderer_set_quality(fixture->panes[p], quality, NULL));
        }
        if (fixture->width) {
            assert_true(
                dip_renderer_resize(fixture->panes[p], fixture->width, fixture->height, NULL));
        }
        hashes[p] = draw(fixture, p);
    }
    free_panes(fixture);
}

static void begin(Fixture *fixture, DipTestSceneKind kind) {
    *fixture = (Fixture){.quality = dip_quality_default()};
    dip_test_scene_make(&fixture->made, kind);
    assert_true(make_pool(fixture, NULL));
    draw_truth(fixture, NULL, fixture->before);
}

static void end(Fixture *fixture) {
    dip_pool_destroy(&fixture->pool);
    dip_test_scene_free(&fixture->made);
}

// Checks an operation on a fixture, whose name is printed like that of printf. The operation may
// leave out `finish`, which is free_panes then. short_count: see DipOutOfMemory.
__attribute__((format(printf, 4, 5))) static void
check(Fixture *fixture, const DipOutOfMemory *operation, int short_count, const char *format, ...) {
    char name[64];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(name, sizeof name, format, arguments);
    va_end(arguments);
    DipOutOfMemory named = *operation;
    named.name = name;
    named.context = fixture;
    named.short_count = short_count;
    if (!named.finish) {
        named.finish = free_panes;
    }
    dip_out_of_memory_check(&named);
}

// --- loading -------------------------------------------------------------------------------------

static void check_pool(void *context, bool succeeded) {
    const Fixture *fixture = context;
    assert_int_equal(fixture->pool != NULL, succeeded);
}

static const DipOutOfMemory starting = {
    .run = make_pool, .check = check_pool, .finish = free_pool, .needs_every_allocation = true};

static void pool_starts_all_threads_or_none(void **state) {
    (void)state;
    Fixture fixture = {.pool = NULL};
    check(&fixture, &starting, 0, "a pool of two threads");
}

static void check_scene(void *context, bool succeeded) {
    Fixture *fixture = context;
    assert_int_equal(fixture->scene != NULL, succeeded);
    if (succeeded) {
        assert_true(make_renderer(fixture, NULL));
        assert_same(draw(fixture, 0), fixture->before[0]);
    }
}

static const DipOutOfMemory making = {
    .run = make_scene, .check = check_scene, .needs_every_allocation = true};

static void scene_is_made_whole_or_not_at_all(void **state) {
    (void)state;
    static Fixture fixture;
    for (int kind = 0; kind < DIP_TEST_SCENE_COUNT; kind++) {
        begin(&fixture, (DipTestSceneKind)kind);
        check(&fixture, &making, 12, "scene %s", dip_test_scene_name((DipTestSceneKind)kind));
        end(&fixture);
    }
}

// A blended mesh of two quads falls into two pieces.
static void blended_meshes_are_cut_or_no_scene_is_made(void **state) {
    (void)state;
    static Fixture fixture;
    begin(&fixture, DIP_TEST_SCENE_fence);
    DipTestScene *made = &fixture.made;
    DipMeshDef mesh = made->meshes[made->def.mesh_count - 1];
    float positions[6 * 3];
    const uint32_t indices[6] = {0, 1, 2, 3, 4, 5};
    for (int i = 0; i < 18; i++) {
        positions[i] = (float)(i / 9) + (i % 4 == 0 ? 1.0f : 0.0f);
    }
    mesh.vertex_count = mesh.index_count = 6;
    mesh.positions = positions;
    mesh.indices = indices;
    mesh.normals = mesh.uv0 = mesh.uv1 = mesh.colours_lin = NULL;
    made->materials[mesh.material].surface = DIP_SURFACE_BLENDED;
    made->meshes[made->def.mesh_count - 1] = mesh;
    draw_truth(&fixture, NULL, fixture.before);
    check(&fixture, &making, 0, "a blended mesh that is cut");
    end(&fixture);
}

static void environments_are_blurred_or_no_scene_is_made(void **state) {
    (void)state;
    static Fixture fixture;
    static const float light[6] = {0.2f, 0.4f, 0.6f, 1.5f, 0.1f, 0.3f};
    static const DipEnvironmentDef environment = {light, 2, 1};
    begin(&fixture, DIP_TEST_SCENE_metal_gloss);
    fixture.made.def.environment = &environment;
    draw_truth(&fixture, NULL, fixture.before);
    check(&fixture, &making, 12, "a scene with an environment");
    end(&fixture);
}

static void check_renderer(void *context, bool succeeded) {
    Fixture *fixture = context;
    assert_int_equal(fixture->panes[0] != NULL, succeeded);
    if (!succeeded) {
        assert_true(make_renderer(fixture, NULL));
    }
    assert_same(draw(fixture, 0), fixture->before[0]);
}

static const DipOutOfMemory making_a_renderer = {.prepare = must_make_scene,
                                                 .run = make_renderer,
                                                 .check = check_renderer,
                                                 .needs_every_allocation = true};

static void renderer_is_made_whole_or_not_at_all(void **state) {
    (void)state;
    static Fixture fixture;
    begin(&fixture, DIP_TEST_SCENE_water_effects);
    check(&fixture, &making_a_renderer, 0, "a renderer");
    end(&fixture);
}

// --- drawing -------------------------------------------------------------------------------------

static bool draw_one(void *context, DipError *err) {
    Fixture *fixture = context;
    return dip_renderer_draw(fixture->panes[0], fixture->scene, &fixture->made.pose, 0,
                             &fixture->frames[0], err);
}

static bool draw_pair(void *context, DipError *err) {
    Fixture *fixture = context;
    return dip_renderer_draw_frames(fixture->panes, PANES, fixture->scene, &fixture->made.pose, 0,
                                    (DipFrame *const[2]){&fixture->frames[0], &fixture->frames[1]},
                                    err);
}

// Draws again after a failed draw. The next frame must be right.
static void check_frame(void *context, bool succeeded) {
    Fixture *fixture = context;
    if (!succeeded) {
        assert_true(draw_one(fixture, NULL));
    }
    assert_same(hash_of(&fixture->frames[0]), fixture->before[0]);
}

static void check_pair(void *context, bool succeeded) {
    Fixture *fixture = context;
    if (!succeeded) {
        assert_true(draw_pair(fixture, NULL));
    }
    for (int p = 0; p < PANES; p++) {
        assert_same(hash_of(&fixture->frames[p]), fixture->before[p]);
    }
}

static const DipOutOfMemory drawing = {
    .prepare = must_make_panes, .run = draw_one, .check = check_frame};

static const DipOutOfMemory drawing_a_pair = {
    .prepare = must_make_panes, .run = draw_pair, .check = check_pair};

// Turns a scene of metallic-roughness surfaces into one with rough glass.
static void begin_glass(Fixture *fixture) {
    begin(fixture, DIP_TEST_SCENE_metal_gloss);
    DipTestScene *made = &fixture->made;
    for (int i = 1; i < made->def.material_count; i++) {
        made->materials[i].surface = DIP_SURFACE_BLENDED;
        made->pbrs[i].roughness = 0.5f;
        made->pbrs[i].transmission = made->pbrs[i].scattering = 1.0f;
    }
    draw_truth(fixture, NULL, fixture->before);
    assert_true(fixture->frames[0].effects.scattering.run);
}

// The backdrop of rough glass is made in the first frame, too.
static void failed_frame_with_rough_glass_leaves_the_renderer_usable(void **state) {
    (void)state;
    static Fixture fixture;
    begin_glass(&fixture);
    check(&fixture, &drawing, 27, "first frame with rough glass");
    end(&fixture);
}

// The first frame of a scene allocates the memory of all later frames.
static void failed_frame_leaves_the_renderer_usable(void **state) {
    (void)state;
    static Fixture fixture;
    static const DipTestSceneKind kinds[] = {DIP_TEST_SCENE_fence, DIP_TEST_SCENE_huge,
                                             DIP_TEST_SCENE_water_effects};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        begin(&fixture, kinds[i]);
        check(&fixture, &drawing, 27, "first frame of %s", dip_test_scene_name(kinds[i]));
        check(&fixture, &drawing_a_pair, 27, "first pair of %s", dip_test_scene_name(kinds[i]));
        end(&fixture);
    }
}

// --- changes -------------------------------------------------------------------------------------

// Makes panes that have drawn a frame with the default settings.
static void make_drawn_panes(void *context) {
    Fixture *fixture = context;
    must_make_panes(fixture);
    for (int p = 0; p < PANES; p++) {
        assert_same(draw(fixture, p), fixture->before[p]);
    }
}

static bool change_and_draw(void *context, DipError *err) {
    Fixture *fixture = context;
    return dip_renderer_set_quality(fixture->panes[0], &fixture->quality, err) &&
           draw_one(fixture, err);
}

// After a failure, the old settings must still draw the old picture, and the new settings must draw
// the new picture as soon as there is memory.
static void check_change(void *context, bool succeeded) {
    Fixture *fixture = context;
    const DipQuality old = dip_quality_default();
    if (!succeeded) {
        assert_true(dip_renderer_set_quality(fixture->panes[0], &old, NULL));
        assert_same(draw(fixture, 0), fixture->before[0]);
        assert_true(change_and_draw(fixture, NULL));
    }
    assert_same(hash_of(&fixture->frames[0]), fixture->after[0]);
    assert_true(dip_renderer_set_quality(fixture->panes[0], &old, NULL));
    assert_same(draw(fixture, 0), fixture->before[0]);
    assert_same(draw(fixture, 1), fixture->before[1]);
}

static const DipOutOfMemory changing = {
    .prepare = make_drawn_panes, .run = change_and_draw, .check = check_change};

static void failed_change_of_a_setting_can_be_taken_back(void **state) {
    (void)state;
    static Fixture fixture;
    begin(&fixture, DIP_TEST_SCENE_water_effects);
    for (int setting = 0; setting < DIP_SETTING_COUNT; setting++) {
        for (int step = 0; step < dip_setting_info((DipSetting)setting)->step_count; step++) {
            fixture.quality = dip_quality_default();
            if (fixture.quality.step[setting] == step) {
                continue;
            }
            fixture.quality.step[setting] = (uint8_t)step;
            // Not every number of samples can be divided into every number of groups.
            while (!dip_quality_check(&fixture.quality, NULL)) {
                fixture.quality.step[DIP_SETTING_AA]++;
            }
            draw_truth(&fixture, &fixture.quality, fixture.after);
            check(&fixture, &changing, 27, "change of %s to step %d",
                  dip_setting_info((DipSetting)setting)->key, step);
        }
    }
    end(&fixture);
}

// Surfaces that are lit at their vertices have more varyings with shadows, so the renderer reserves
// the memory of its passes anew.
static void failed_shadow_map_can_be_made_again(void **state) {
    (void)state;
    static Fixture fixture;
    static const DipTestSceneKind kinds[] = {DIP_TEST_SCENE_lights, DIP_TEST_SCENE_gouraud_lights};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        begin(&fixture, kinds[i]);
        assert_true(dip_quality_parse("shadows=512", &fixture.quality, NULL));
        draw_truth(&fixture, &fixture.quality, fixture.after);
        check(&fixture, &changing, 0, "shadow map of %s", dip_test_scene_name(kinds[i]));
        end(&fixture);
    }
}

static DipUnsharedMeshes *unshared;

static bool copy_shared_meshes(void *context, DipError *err) {
    const Fixture *fixture = context;
    unshared = dip_unshared_meshes_create(fixture->scene, fixture->pool, err);
    return unshared != NULL;
}

static void free_copies(void *context) {
    dip_unshared_meshes_destroy(&unshared);
    free_panes(context);
}

static const DipOutOfMemory copying = {.prepare = must_make_scene,
                                       .run = copy_shared_meshes,
                                       .finish = free_copies,
                                       .needs_every_allocation = true};

// With gi=off, each object has a mesh of its own. An object whose copy failed must not be drawn
// with the mesh that it shares.
static void meshes_are_copied_for_all_objects_or_for_none(void **state) {
    (void)state;
    static Fixture fixture;
    begin(&fixture, DIP_TEST_SCENE_cube_on_plane);
    DipTestScene *made = &fixture.made;
    for (int copy = 0; copy < 2; copy++) {
        assert_true(made->def.object_count < DIP_TEST_SCENE_PARTS);
        made->objects[made->def.object_count] = made->objects[0];
        made->objects[made->def.object_count++].transform[3] += 1.5f + (float)copy;
    }
    check(&fixture, &copying, 0, "a mesh of its own for each object");
    end(&fixture);
}

static bool resize(void *context, DipError *err) {
    Fixture *fixture = context;
    return dip_renderer_resize(fixture->panes[0], fixture->width, fixture->height, err);
}

static void check_resize(void *context, bool succeeded) {
    Fixture *fixture = context;
    if (!succeeded) {
        assert_same(draw(fixture, 0), fixture->before[0]);
        assert_true(resize(fixture, NULL));
    }
    assert_same(draw(fixture, 0), fixture->after[0]);
}

static const DipOutOfMemory resizing = {.prepare = make_drawn_panes,
                                        .run = resize,
                                        .check = check_resize,
                                        .needs_every_allocation = true};

static void failed_resize_keeps_the_old_size(void **state) {
    (void)state;
    static Fixture fixture;
    begin(&fixture, DIP_TEST_SCENE_water_effects);
    fixture.width = 161;
    fixture.height = 67;
    draw_truth(&fixture, NULL, fixture.after);
    check(&fixture, &resizing, 0, "a new size of a pane");
    end(&fixture);
}

static bool compress(void *context, DipError *err) {
    Fixture *fixture = context;
    return dip_scene_compress_textures(fixture->scene, fixture->pool, err);
}

static void check_compress(void *context, bool succeeded) {
    Fixture *fixture = context;
    assert_same(draw(fixture, 0), fixture->before[0]);
    fixture->quality.step[DIP_SETTING_OPT] = 1;
    assert_int_equal(change_and_draw(fixture, NULL), true);
    assert_same(hash_of(&fixture->frames[0]), fixture->after[0]);
    (void)succeeded;
}

static const DipOutOfMemory compressing = {.prepare = make_drawn_panes,
                                           .run = compress,
                                           .check = check_compress,
                                           .needs_every_allocation = true};

static void failed_compression_can_be_repeated(void **state) {
    (void)state;
    static Fixture fixture;
    begin(&fixture, DIP_TEST_SCENE_water_effects);
    fixture.quality.step[DIP_SETTING_OPT] = 1;
    draw_truth(&fixture, &fixture.quality, fixture.after);
    check(&fixture, &compressing, 0, "compressed textures");
    end(&fixture);
}

static bool set_mip_pictures(void *context, DipError *err) {
    Fixture *fixture = context;
    const DipTextureDef *pictures[DIP_MIP_DEBUG_LEVELS];
    for (int level = 0; level < DIP_MIP_DEBUG_LEVELS; level++) {
        pictures[level] = &fixture->made.def.textures[0];
    }
    return dip_renderer_set_mip_pictures(fixture->panes[0], pictures, err);
}

static void check_mip_pictures(void *context, bool succeeded) {
    Fixture *fixture = context;
    fixture->quality.step[DIP_SETTING_MIPDEBUG] = 1;
    assert_true(change_and_draw(fixture, NULL));
    const Hash hash = hash_of(&fixture->frames[0]);
    assert_int_equal(strcmp(hash.hex, fixture->after[0].hex) == 0, !succeeded);
}

static const DipOutOfMemory setting_pictures = {.prepare = make_drawn_panes,
                                                .run = set_mip_pictures,
                                                .check = check_mip_pictures,
                                                .needs_every_allocation = true};

static void failed_mip_pictures_keep_the_old_ones(void **state) {
    (void)state;
    static Fixture fixture;
    begin(&fixture, DIP_TEST_SCENE_grazing_checker);
    fixture.quality.step[DIP_SETTING_MIPDEBUG] = 1;
    draw_truth(&fixture, &fixture.quality, fixture.after);
    check(&fixture, &setting_pictures, 0, "pictures for mip debugging");
    end(&fixture);
}

// Draws another scene with a renderer that has drawn one.
static DipScene *other;

static bool draw_other(void *context, DipError *err) {
    Fixture *fixture = context;
    return dip_renderer_draw(fixture->panes[0], other, &fixture->made.pose, 0, &fixture->frames[0],
                             err);
}

static void check_other(void *context, bool succeeded) {
    Fixture *fixture = context;
    (void)succeeded;
    assert_same(draw(fixture, 0), fixture->before[0]);
    assert_true(draw_other(fixture, NULL));
    assert_same(hash_of(&fixture->frames[0]), fixture->after[0]);
}

static const DipOutOfMemory drawing_another = {
    .prepare = make_drawn_panes, .run = draw_other, .check = check_other};

static void failed_change_of_scene_keeps_the_old_scene_drawable(void **state) {
    (void)state;
    static Fixture fixture;
    static DipTestScene sky;
    begin(&fixture, DIP_TEST_SCENE_water);
    dip_test_scene_make(&sky, DIP_TEST_SCENE_water_effects);
    other = dip_scene_create(&sky.def, NULL, NULL);
    must_make_panes(&fixture);
    assert_true(draw_other(&fixture, NULL));
    fixture.after[0] = hash_of(&fixture.frames[0]);
    free_panes(&fixture);
    check(&fixture, &drawing_another, 0, "first frame of another scene");
    dip_scene_destroy(&other);
    dip_test_scene_free(&sky);
    end(&fixture);
}

int main(int argc, char **argv) {
    dip_out_of_memory_read_options(argc, argv);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pool_starts_all_threads_or_none),
        cmocka_unit_test(scene_is_made_whole_or_not_at_all),
        cmocka_unit_test(blended_meshes_are_cut_or_no_scene_is_made),
        cmocka_unit_test(environments_are_blurred_or_no_scene_is_made),
        cmocka_unit_test(renderer_is_made_whole_or_not_at_all),
        cmocka_unit_test(failed_frame_leaves_the_renderer_usable),
        cmocka_unit_test(failed_frame_with_rough_glass_leaves_the_renderer_usable),
        cmocka_unit_test(failed_change_of_a_setting_can_be_taken_back),
        cmocka_unit_test(failed_shadow_map_can_be_made_again),
        cmocka_unit_test(meshes_are_copied_for_all_objects_or_for_none),
        cmocka_unit_test(failed_resize_keeps_the_old_size),
        cmocka_unit_test(failed_compression_can_be_repeated),
        cmocka_unit_test(failed_mip_pictures_keep_the_old_ones),
        cmocka_unit_test(failed_change_of_scene_keeps_the_old_scene_drawable),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
