// Tests what reading an ini does when memory runs out: the configuration is read whole or not at
// all, and the list of faults says why.
#include "config/config.h"
#include "tests/support/out_of_memory.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static bool load(void *context, DipError *err) {
    DipErrorList faults = {0};
    const bool loaded = dip_config_load(DIP_SOURCE_DIR "/config/courtyard.ini", context, &faults);
    return dip_out_of_memory_first_error(&faults, err) && loaded;
}

static void check(void *context, bool succeeded) {
    static const DipConfig empty;
    const DipConfig *config = context;
    if (succeeded) {
        assert_int_equal(config->xfile.count, 1);
        assert_int_equal(config->res.width, 640);
    } else {
        assert_memory_equal(config, &empty, sizeof empty);
    }
}

static void finish(void *context) {
    dip_config_free(context);
}

static void ini_is_read_whole_or_not_at_all(void **state) {
    (void)state;
    static DipConfig config;
    dip_out_of_memory_check(&(DipOutOfMemory){.name = "the courtyard's ini",
                                              .context = &config,
                                              .run = load,
                                              .check = check,
                                              .finish = finish,
                                              .needs_every_allocation = true});
}

int main(int argc, char **argv) {
    dip_out_of_memory_read_options(argc, argv);
    const struct CMUnitTest tests[] = {cmocka_unit_test(ini_is_read_whole_or_not_at_all)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
