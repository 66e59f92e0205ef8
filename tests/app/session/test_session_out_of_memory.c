// Tests what opening a session does when memory runs out: the session opens whole or stays empty.
// Usage: test_session_out_of_memory SOURCE_FOLDER [--long]
#include "app/session/session.h"
#include "assets/importer.h"
#include "renderer/base/hash.h"
#include "tests/support/out_of_memory.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

typedef struct Fixture {
    DipSessionOptions options;
    DipImporter importer;
    DipSession session;
    DipSessionFrame frame;
    DipHash expected;
} Fixture;

static Fixture fixture;

static DipHash hash_of(const DipFrame *frame) {
    DipHash hash = dip_hash_begin(0);
    for (int y = 0; y < frame->height; y++) {
        dip_hash_bytes(&hash, frame->rgba8 + (size_t)y * frame->stride_bytes,
                       4 * (size_t)frame->width);
    }
    return hash;
}

static bool open_session(void *context, DipError *err) {
    (void)context;
    const DipSessionDef def = {.options = &fixture.options,
                               .importer = &fixture.importer,
                               .scene = true,
                               .renderers = true,
                               .keep_model = true};
    DipErrorList faults = {0};
    const bool opened = dip_session_open(&fixture.session, &def, &faults);
    return dip_out_of_memory_first_error(&faults, err) && opened;
}

static DipHash draw(void) {
    DipPose pose;
    DipError err;
    if (!dip_session_draw(&fixture.session, 0, 0, &pose, &fixture.frame, &err)) {
        fail_msg("cannot draw: %s", err.message);
    }
    return hash_of(&fixture.frame.panes[DIP_PANE_REQUESTED]);
}

static void check_session(void *context, bool succeeded) {
    (void)context;
    assert_int_equal(fixture.session.scene != NULL, succeeded);
    assert_int_equal(fixture.session.pool != NULL, succeeded);
    assert_int_equal(fixture.session.renderers[1] != NULL, succeeded);
    if (succeeded) {
        const DipHash hash = draw();
        assert_memory_equal(&hash, &fixture.expected, sizeof hash);
    }
}

static void close_session(void *context) {
    (void)context;
    dip_session_close(&fixture.session);
}

static void check_opening(const char *name, int short_count) {
    assert_true(open_session(NULL, NULL));
    fixture.expected = draw();
    close_session(NULL);
    dip_out_of_memory_check(&(DipOutOfMemory){.name = name,
                                              .run = open_session,
                                              .check = check_session,
                                              .finish = close_session,
                                              .short_count = short_count});
}

static char ini[512];
static char model[512];
static char model_with_warnings[512];

static DipSessionOptions options_of(int model_count) {
    return (DipSessionOptions){.config = ini,
                               .models = {model},
                               .model_count = model_count,
                               .has_size = true,
                               .size = {32, 24},
                               .has_threads = true,
                               .threads = 1,
                               .has_requested = true,
                               .requested = dip_quality_default()};
}

static void session_of_a_model_opens_whole_or_not_at_all(void **state) {
    (void)state;
    fixture.options = options_of(1);
    fixture.options.requested.step[DIP_SETTING_OPT] = DIP_OPT_STANDARD;
    check_opening("a session with a model", 30);
}

static void session_with_warnings_opens_whole_or_not_at_all(void **state) {
    (void)state;
    fixture.options = options_of(1);
    fixture.options.models[0] = model_with_warnings;
    check_opening("a session with warnings", 15);
}

static void session_of_the_courtyard_opens_whole_or_not_at_all(void **state) {
    (void)state;
    fixture.options = options_of(0);
    check_opening("a session with the courtyard", 5);
}

// The program is also the importer of its sessions.
static const char importer_word[] = "import";

int main(int argc, char **argv) {
    if (argc > 1 && strcmp(argv[1], importer_word) == 0) {
        return dip_importer_run(argc - 2, argv + 2);
    }
    dip_out_of_memory_read_options(argc, argv);
    const char *source = argc > 1 ? argv[1] : ".";
    snprintf(ini, sizeof ini, "%s/config/courtyard.ini", source);
    snprintf(model, sizeof model, "%s/tests/assets/data/square.gltf", source);
    snprintf(model_with_warnings, sizeof model_with_warnings,
             "%s/tests/assets/data/gltf/losses.gltf", source);
    fixture.importer = (DipImporter){.program = "/proc/self/exe", .command = importer_word};
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(session_of_a_model_opens_whole_or_not_at_all),
        cmocka_unit_test(session_with_warnings_opens_whole_or_not_at_all),
        cmocka_unit_test(session_of_the_courtyard_opens_whole_or_not_at_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
