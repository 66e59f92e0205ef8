// Tests what shapes and tessellations do when memory runs out: they are made whole or not at all.
#include "renderer/shapes/tessellate.h"
#include "tests/support/out_of_memory.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

typedef struct Fixture {
    DipShape base;
    DipShape made;
} Fixture;

static bool make_sphere(void *context, DipError *err) {
    Fixture *fixture = context;
    return dip_shape_sphere(&fixture->made, 1.0f, 12, 6, err);
}

static void make_base(void *context) {
    Fixture *fixture = context;
    const float size[3] = {1.0f, 2.0f, 3.0f};
    assert_true(dip_shape_box(&fixture->base, size, NULL));
}

static bool tessellate(void *context, DipError *err) {
    Fixture *fixture = context;
    const DipTessellationFactors factors = {{3.0f, 3.0f, 3.0f, 3.0f}, {3.0f, 3.0f}};
    const DipTessellationDef def = {.attributes = fixture->base.attributes,
                                    .attribute_count = DIP_SHAPE_ATTRIBUTES,
                                    .vertex_count = fixture->base.vertex_count,
                                    .indices = fixture->base.indices,
                                    .index_count = fixture->base.index_count,
                                    .factors = &factors,
                                    .same_factors = true,
                                    .function = dip_domain_linear,
                                    .out_attribute_count = DIP_SHAPE_ATTRIBUTES};
    return dip_tessellate(&fixture->made, &def, err);
}

static void check(void *context, bool succeeded) {
    const Fixture *fixture = context;
    assert_int_equal(fixture->made.attributes != NULL, succeeded);
    assert_int_equal(fixture->made.indices != NULL, succeeded);
    assert_int_equal(fixture->made.index_count > 0, succeeded);
}

static void finish(void *context) {
    Fixture *fixture = context;
    dip_shape_free(&fixture->made);
    dip_shape_free(&fixture->base);
}

static void shapes_are_made_whole_or_not_at_all(void **context) {
    (void)context;
    Fixture fixture = {{0}, {0}};
    const DipOutOfMemory operations[] = {
        {.name = "sphere",
         .context = &fixture,
         .run = make_sphere,
         .check = check,
         .finish = finish,
         .needs_every_allocation = true},
        {.name = "tessellation",
         .context = &fixture,
         .prepare = make_base,
         .run = tessellate,
         .check = check,
         .finish = finish,
         .needs_every_allocation = true},
    };
    for (size_t i = 0; i < sizeof operations / sizeof *operations; i++) {
        dip_out_of_memory_check(&operations[i]);
    }
}

int main(int argc, char **argv) {
    dip_out_of_memory_read_options(argc, argv);
    const struct CMUnitTest tests[] = {cmocka_unit_test(shapes_are_made_whole_or_not_at_all)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
