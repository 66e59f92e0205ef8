// Tests what meshes and textures that can be updated do when memory runs out: they are made whole
// or not at all, and a failed update changes nothing.
#include "renderer/pipeline/mesh.h"
#include "renderer/pipeline/texture/texture_layout.h"
#include "tests/support/out_of_memory.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { SIZE = 9, BYTES = 4 * SIZE * SIZE };

typedef struct Fixture {
    DipMesh *mesh;
    DipTexture *texture;
    uint8_t before[BYTES];
    uint8_t after[BYTES];
    uint8_t found[BYTES];
} Fixture;

static const float vertices[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};

static bool make_mesh(void *context, DipError *err) {
    Fixture *fixture = context;
    const DipMeshData data = {"square", &vertices[0][0], 3, 4, indices, 6};
    fixture->mesh = dip_mesh_create_updatable(&data, err);
    return fixture->mesh != NULL;
}

static void check_mesh(void *context, bool succeeded) {
    Fixture *fixture = context;
    assert_int_equal(fixture->mesh != NULL, succeeded);
}

static DipTextureDef def_of(const Fixture *fixture) {
    return (DipTextureDef){.name = "test",
                           .width = SIZE,
                           .height = SIZE,
                           .rgba8 = fixture->before,
                           .wrap_u = DIP_WRAP_BORDER,
                           .border_rgba8 = {1, 2, 3, 255}};
}

static bool make_stored(void *context, DipError *err) {
    Fixture *fixture = context;
    const DipTextureDef def = def_of(fixture);
    fixture->texture = dip_texture_create_from_levels(&def, 1, err);
    return fixture->texture != NULL;
}

static void check_texture(void *context, bool succeeded) {
    Fixture *fixture = context;
    assert_int_equal(fixture->texture != NULL, succeeded);
}

static void must_make_texture(void *context) {
    Fixture *fixture = context;
    const DipTextureDef def = def_of(fixture);
    fixture->texture = dip_texture_create(&def, NULL);
    assert_non_null(fixture->texture);
    assert_null(fixture->texture->alpha);
}

// The new texels are not opaque, so the texture needs an alpha plane.
static bool update_texture(void *context, DipError *err) {
    Fixture *fixture = context;
    const DipTextureUpdate update = {
        0, 1, SIZE, SIZE - 1, fixture->after + 4 * SIZE, (size_t)SIZE * 4};
    return dip_texture_update(fixture->texture, &update, NULL, err);
}

static void check_update(void *context, bool succeeded) {
    Fixture *fixture = context;
    assert_true(dip_texture_read(fixture->texture, 0, DIP_ENCODING_SRGB, fixture->found, NULL));
    assert_memory_equal(fixture->found, succeeded ? fixture->after : fixture->before, BYTES);
}

static bool read_texture(void *context, DipError *err) {
    Fixture *fixture = context;
    return dip_texture_read(fixture->texture, 0, DIP_ENCODING_SRGB, fixture->found, err);
}

static void finish(void *context) {
    Fixture *fixture = context;
    dip_mesh_destroy(&fixture->mesh);
    dip_texture_destroy(&fixture->texture);
}

static void updates_are_made_whole_or_not_at_all(void **state) {
    (void)state;
    static Fixture fixture;
    for (int i = 0; i < BYTES; i++) {
        fixture.before[i] = i % 4 == 3 ? 255 : (uint8_t)(i * 37);
        fixture.after[i] = i < 4 * SIZE ? fixture.before[i] : (uint8_t)(i * 11);
    }
    const DipOutOfMemory operations[] = {
        {.name = "updatable mesh", .run = make_mesh, .check = check_mesh},
        {.name = "texture of stored levels", .run = make_stored, .check = check_texture},
        {.name = "update of a texture",
         .prepare = must_make_texture,
         .run = update_texture,
         .check = check_update},
        {.name = "reading a texture", .prepare = must_make_texture, .run = read_texture},
    };
    for (size_t i = 0; i < sizeof operations / sizeof *operations; i++) {
        DipOutOfMemory operation = operations[i];
        operation.context = &fixture;
        operation.finish = finish;
        operation.needs_every_allocation = true;
        dip_out_of_memory_check(&operation);
    }
}

int main(int argc, char **argv) {
    dip_out_of_memory_read_options(argc, argv);
    const struct CMUnitTest tests[] = {cmocka_unit_test(updates_are_made_whole_or_not_at_all)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
