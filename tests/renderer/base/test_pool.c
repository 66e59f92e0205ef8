// Tests the worker pool. In every run, each index is processed exactly once, with any number of
// threads.
#include "renderer/base/pool.h"

#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <time.h>

#include <cmocka.h>

enum { MAX_COUNT = 1000, RUNS = 200 };

typedef struct Tally {
    atomic_int runs[MAX_COUNT];
    int thread_count;
    atomic_int bad_worker;
    int64_t plain[MAX_COUNT]; // written without atomics, so the pool must order the writes
} Tally;

static void tally(void *context, int index, int worker) {
    Tally *all = context;
    atomic_fetch_add(&all->runs[index], 1);
    all->plain[index] += index;
    if (worker < 0 || worker >= all->thread_count) {
        atomic_store(&all->bad_worker, 1);
    }
}

static void sleep_ms(long ms) {
    const struct timespec pause = {0, ms * 1000000};
    nanosleep(&pause, NULL);
}

static void every_index_runs_once(void **state) {
    (void)state;
    for (int threads = 1; threads <= 5; threads++) {
        static Tally all;
        all = (Tally){.thread_count = threads};
        DipPool *pool = dip_pool_create(threads, NULL);
        assert_non_null(pool);
        assert_int_equal(dip_pool_thread_count(pool), threads);
        for (int run = 0; run < RUNS; run++) {
            dip_pool_run(pool, run * 5, tally, &all);
            if (run % 50 == 0) {
                sleep_ms(5); // long enough for workers to fall asleep
            }
        }
        for (int i = 0; i < MAX_COUNT; i++) {
            const int expected = RUNS - 1 - i / 5;
            assert_int_equal(all.runs[i], expected > 0 ? expected : 0);
            assert_int_equal(all.plain[i], (int64_t)i * (expected > 0 ? expected : 0));
        }
        assert_int_equal(all.bad_worker, 0);
        dip_pool_destroy(&pool);
        assert_null(pool);
    }
}

// A worker that wakes too late for one run joins the next run.
static void workers_that_wake_late_join_the_next_run(void **state) {
    (void)state;
    enum { THREADS = 4, SHORT_RUNS = 20000, TASKS = 3 };
    static Tally all;
    all = (Tally){.thread_count = THREADS};
    DipPool *pool = dip_pool_create(THREADS, NULL);
    assert_non_null(pool);
    for (int run = 0; run < SHORT_RUNS; run++) {
        dip_pool_run(pool, run % (TASKS + 1), tally, &all);
    }
    for (int i = 0; i < TASKS; i++) {
        const int expected = SHORT_RUNS / (TASKS + 1) * (TASKS - i);
        assert_int_equal(all.runs[i], expected);
        assert_int_equal(all.plain[i], (int64_t)i * expected);
    }
    assert_int_equal(all.bad_worker, 0);
    dip_pool_destroy(&pool);
}

// A pool may be destroyed while its workers still look for work of the last run. All worker threads
// must then end.
static void a_pool_can_be_destroyed_right_after_a_run(void **state) {
    (void)state;
    enum { THREADS = 4, POOLS = 4000, RUNS_EACH = 2 };
    static Tally all;
    all = (Tally){.thread_count = THREADS};
    for (int i = 0; i < POOLS; i++) {
        DipPool *pool = dip_pool_create(THREADS, NULL);
        assert_non_null(pool);
        for (int run = 0; run < RUNS_EACH; run++) {
            dip_pool_run(pool, 1, tally, &all);
        }
        dip_pool_destroy(&pool);
    }
    assert_int_equal(all.runs[0], POOLS * RUNS_EACH);
}

// --- several callers -----------------------------------------------------------------------------

typedef struct Caller {
    DipPool *pool;
    Tally all;
} Caller;

static void *run_many(void *context) {
    Caller *caller = context;
    for (int run = 0; run < RUNS; run++) {
        dip_pool_run(caller->pool, MAX_COUNT, tally, &caller->all);
    }
    return NULL;
}

static void threads_take_turns_in_using_a_pool(void **state) {
    (void)state;
    enum { CALLERS = 3 };
    for (int threads = 1; threads <= 3; threads++) {
        static Caller callers[CALLERS];
        pthread_t ids[CALLERS];
        DipPool *pool = dip_pool_create(threads, NULL);
        for (int c = 0; c < CALLERS; c++) {
            callers[c] = (Caller){.pool = pool, .all = {.thread_count = threads}};
            assert_int_equal(pthread_create(&ids[c], NULL, run_many, &callers[c]), 0);
        }
        for (int c = 0; c < CALLERS; c++) {
            pthread_join(ids[c], NULL);
        }
        for (int c = 0; c < CALLERS; c++) {
            for (int i = 0; i < MAX_COUNT; i++) {
                assert_int_equal(callers[c].all.runs[i], RUNS);
                assert_int_equal(callers[c].all.plain[i], (int64_t)i * RUNS);
            }
            assert_int_equal(callers[c].all.bad_worker, 0);
        }
        dip_pool_destroy(&pool);
    }
}

static void impossible_thread_counts_are_refused(void **state) {
    (void)state;
    DipError err = {0};
    assert_null(dip_pool_create(-1, &err));
    assert_int_equal(err.code, DIP_ERROR_RANGE);
    assert_string_equal(err.key, "threads");
    assert_null(dip_pool_create(DIP_MAX_THREADS + 1, &err));
    assert_int_equal(err.code, DIP_ERROR_RANGE);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_index_runs_once),
        cmocka_unit_test(workers_that_wake_late_join_the_next_run),
        cmocka_unit_test(a_pool_can_be_destroyed_right_after_a_run),
        cmocka_unit_test(threads_take_turns_in_using_a_pool),
        cmocka_unit_test(impossible_thread_counts_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
