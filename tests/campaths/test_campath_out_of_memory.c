// Tests what camera paths do when memory runs out: a path is loaded or saved whole or not at all.
#include "campaths/campath.h"
#include "tests/support/out_of_memory.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { KEYS = 300 }; // The array of keys grows several times.

static char pth[64];
static char bth[64];
static DipCamKey keys[KEYS];

typedef struct Fixture {
    const char *file;
    DipCamPath *path;
} Fixture;

static bool create(void *context, DipError *err) {
    Fixture *fixture = context;
    return dip_campath_create(keys, KEYS, 250000000, &fixture->path, err);
}

static bool load(void *context, DipError *err) {
    Fixture *fixture = context;
    return dip_campath_load(fixture->file, &fixture->path, err);
}

static bool orbit(void *context, DipError *err) {
    Fixture *fixture = context;
    const DipCamOrbitDef def = dip_campath_default_orbit();
    return dip_campath_orbit(&def, &fixture->path, err);
}

static bool save(void *context, DipError *err) {
    Fixture *fixture = context;
    return fixture->file == pth ? dip_campath_save_pth(fixture->path, pth, err)
                                : dip_campath_save_bth(fixture->path, bth, err);
}

static void check_path(void *context, bool succeeded) {
    const Fixture *fixture = context;
    assert_int_equal(fixture->path != NULL, succeeded);
    if (succeeded) {
        assert_true(dip_campath_info(fixture->path).key_count > 1);
    }
}

// A failed save must leave the file as it was.
static void check_file(void *context, bool succeeded) {
    const Fixture *fixture = context;
    DipCamPath *path;
    (void)succeeded;
    assert_true(dip_campath_load(fixture->file, &path, NULL));
    assert_int_equal(dip_campath_info(path).key_count, KEYS);
    dip_campath_destroy(&path);
}

static void free_path(void *context) {
    dip_campath_destroy(&((Fixture *)context)->path);
}

static void must_create(void *context) {
    assert_true(create(context, NULL));
}

static void path_is_made_whole_or_not_at_all(void **state) {
    (void)state;
    Fixture fixture = {.path = NULL};
    DipOutOfMemory operation = {.name = "a path from keys",
                                .context = &fixture,
                                .run = create,
                                .check = check_path,
                                .finish = free_path,
                                .needs_every_allocation = true};
    dip_out_of_memory_check(&operation);
    operation.name = "an orbit";
    operation.run = orbit;
    dip_out_of_memory_check(&operation);
    operation.name = "loading a .pth";
    operation.run = load;
    fixture.file = pth;
    dip_out_of_memory_check(&operation);
    operation.name = "loading a .bth";
    fixture.file = bth;
    dip_out_of_memory_check(&operation);
}

static void failed_save_keeps_the_old_file(void **state) {
    (void)state;
    Fixture fixture = {.file = pth};
    DipOutOfMemory operation = {.name = "saving a .pth",
                                .context = &fixture,
                                .prepare = must_create,
                                .run = save,
                                .check = check_file,
                                .finish = free_path,
                                .needs_every_allocation = true};
    dip_out_of_memory_check(&operation);
    operation.name = "saving a .bth";
    fixture.file = bth;
    dip_out_of_memory_check(&operation);
}

static int make_files(void **state) {
    (void)state;
    DipCamPath *path = NULL;
    snprintf(pth, sizeof pth, "/tmp/campath_out_of_memory.%d.pth", (int)getpid());
    snprintf(bth, sizeof bth, "/tmp/campath_out_of_memory.%d.bth", (int)getpid());
    for (int i = 0; i < KEYS; i++) {
        keys[i] = (DipCamKey){{i, 0.5, -i}, {0.0, 0.0, 0.0, 1.0}};
    }
    const bool made = dip_campath_create(keys, KEYS, 250000000, &path, NULL) &&
                      dip_campath_save_pth(path, pth, NULL) &&
                      dip_campath_save_bth(path, bth, NULL);
    dip_campath_destroy(&path);
    return made ? 0 : -1;
}

static int remove_files(void **state) {
    (void)state;
    return remove(pth) | remove(bth);
}

int main(int argc, char **argv) {
    dip_out_of_memory_read_options(argc, argv);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(path_is_made_whole_or_not_at_all),
        cmocka_unit_test(failed_save_keeps_the_old_file),
    };
    return cmocka_run_group_tests(tests, make_files, remove_files);
}
