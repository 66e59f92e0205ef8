// A filter is made whole or not at all when memory runs out.
#include "renderer/post/post.h"
#include "tests/support/out_of_memory.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

typedef struct Fixture {
    DipPostFilter filter;
    DipPost *post;
} Fixture;

static bool make_filter(void *context, DipError *err) {
    Fixture *fixture = context;
    // An error of an earlier call, which the error of this call must replace.
    dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "earlier", "an earlier error");
    const DipPostDef def = {fixture->filter, 40, 30, 40, 30, 0.5f, dip_isa_best(), NULL};
    fixture->post = dip_post_create(&def, err);
    return fixture->post != NULL;
}

static void check_filter(void *context, bool succeeded) {
    Fixture *fixture = context;
    assert_int_equal(fixture->post != NULL, succeeded);
}

static void finish(void *context) {
    Fixture *fixture = context;
    dip_post_destroy(&fixture->post);
}

static void filters_are_made_whole_or_not_at_all(void **state) {
    (void)state;
    for (int filter = 0; filter < DIP_POST_COUNT; filter++) {
        Fixture fixture = {.filter = (DipPostFilter)filter};
        const DipOutOfMemory operation = {.name = dip_post_name(fixture.filter),
                                          .context = &fixture,
                                          .run = make_filter,
                                          .check = check_filter,
                                          .finish = finish,
                                          .needs_every_allocation = true};
        dip_out_of_memory_check(&operation);
    }
}

int main(int argc, char **argv) {
    dip_out_of_memory_read_options(argc, argv);
    const struct CMUnitTest tests[] = {cmocka_unit_test(filters_are_made_whole_or_not_at_all)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
