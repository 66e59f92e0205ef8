// Tests that several threads may see one environment at once: all get the same light. Also tests
// that another thread can stop a converged picture. The thread sanitizer runs these tests, too.
#include "renderer/catalogue/scenes.h"
#include "renderer/reference/internal/internal.h"

#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

enum { COLUMNS = 16, ROWS = 8, DIRECTIONS = 200, THREADS = 3 };

static float texels[ROWS * COLUMNS * 3];
static const DipEnvironmentDef def = {texels, COLUMNS, ROWS};

typedef struct Seen {
    const DipRefEnvironment *environment;
    double rgb[DIRECTIONS][3];
} Seen;

static void *see(void *context) {
    Seen *seen = context;
    for (int i = 0; i < DIRECTIONS; i++) {
        const double y = 1.0 - 2.0 * (i + 0.5) / DIRECTIONS, angle = 2.4 * i;
        const double across = sqrt(1.0 - y * y);
        const double towards[3] = {across * cos(angle), y, across * sin(angle)};
        dip_reference_environment_see(seen->environment, 0.05 * (i % 20), towards, seen->rgb[i]);
    }
    return NULL;
}

static void threads_see_the_same_light(void **state) {
    (void)state;
    static Seen seen[THREADS + 1];
    pthread_t threads[THREADS];
    for (int i = 0; i < ROWS * COLUMNS * 3; i++) {
        texels[i] = (float)(i * 37 % 101) / 50.0f;
    }
    DipRefEnvironment *shared = dip_reference_environment_create(&def);
    DipRefEnvironment *alone = dip_reference_environment_create(&def);
    assert_true(shared && alone);
    seen[THREADS].environment = alone;
    for (int t = 0; t < THREADS; t++) {
        seen[t].environment = shared;
        assert_int_equal(pthread_create(&threads[t], NULL, see, &seen[t]), 0);
    }
    see(&seen[THREADS]);
    for (int t = 0; t < THREADS; t++) {
        pthread_join(threads[t], NULL);
        assert_memory_equal(seen[t].rgb, seen[THREADS].rgb, sizeof seen[t].rgb);
    }
    dip_reference_environment_destroy(&shared);
    dip_reference_environment_destroy(&alone);
}

static DipCancelFlag stop;

static void *stop_soon(void *context) {
    (void)context;
    nanosleep(&(struct timespec){.tv_nsec = 20000000}, NULL);
    atomic_store(&stop, true);
    return NULL;
}

// The picture has so many samples that it takes many seconds unless it is stopped.
static void a_picture_that_is_stopped_is_refused(void **state) {
    (void)state;
    enum { SIZE = 32, SAMPLES = 10000 };
    static double rgb_lin[SIZE * SIZE * 3];
    DipTestScene scene;
    DipError err = {0};
    pthread_t thread;
    dip_test_scene_make(&scene, DIP_TEST_SCENE_soup);
    DipReference *reference = dip_reference_create_for_truth(&scene.def, &stop, NULL);
    assert_non_null(reference);
    assert_int_equal(pthread_create(&thread, NULL, stop_soon, NULL), 0);
    const bool drawn =
        dip_reference_converge(reference, &scene.pose, SIZE, SIZE, SAMPLES, 1, rgb_lin, &err);
    pthread_join(thread, NULL);
    assert_false(drawn);
    assert_int_equal(err.code, DIP_ERROR_RUNTIME);
    dip_reference_destroy(&reference);
    dip_test_scene_free(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_see_the_same_light),
        cmocka_unit_test(a_picture_that_is_stopped_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
