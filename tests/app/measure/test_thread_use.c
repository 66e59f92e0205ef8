// Tests of the watch on threads, of this process and of another one.
#include "app/measure/timing/thread_use.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <signal.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static void the_watch_counts_processor_time(void **state) {
    (void)state;
    DipThreadWatch *watch = dip_thread_watch_open();
    const DipThreadUse before = dip_thread_watch_read(watch);
    const clock_t begin = clock();
    while (clock() - begin < CLOCKS_PER_SEC / 10) {
    }
    const DipThreadUse after = dip_thread_watch_read(watch);
    assert_true(before.has_wait == (watch != NULL));
    assert_true(after.cpu_ns - before.cpu_ns > 80000000);
    assert_true(after.wait_ns >= before.wait_ns && after.switches >= before.switches);
    dip_thread_watch_close(&watch);
    assert_null(watch);
    assert_true(dip_thread_watch_read(NULL).cpu_ns >= after.cpu_ns / 2);
}

// Burns .1 s of processor time, says so by closing its end of the pipe, and waits to be killed.
static void run_child(int pipe_end) {
    const clock_t begin = clock();
    while (clock() - begin < CLOCKS_PER_SEC / 10) {
    }
    close(pipe_end);
    pause();
    _exit(0);
}

static void the_watch_sees_another_process(void **state) {
    (void)state;
    int ends[2];
    char byte;
    assert_int_equal(pipe(ends), 0);
    const pid_t pid = fork();
    assert_true(pid >= 0);
    if (pid == 0) {
        run_child(ends[1]);
    }
    close(ends[1]);
    assert_int_equal(read(ends[0], &byte, 1), 0);
    close(ends[0]);
    DipThreadWatch *own = dip_thread_watch_open();
    DipThreadWatch *watch = dip_thread_watch_open_process((long)pid);
    // The switches of this process are not those of the other one. The loop ends at the first
    // switch, or without one on an idle machine.
    const clock_t begin = clock();
    while (dip_thread_watch_read(own).switches == 0 && clock() - begin < 3 * CLOCKS_PER_SEC) {
    }
    const DipThreadUse use = dip_thread_watch_read(watch);
    const int count = dip_thread_watch_count(watch);
    const bool tells = own != NULL; // Whether this system tells the threads' times.
    dip_thread_watch_close(&own);
    dip_thread_watch_close(&watch);
    kill(pid, SIGKILL);
    waitpid(pid, NULL, 0);
    if (tells) {
        assert_int_equal(count, 1);
        assert_true(use.cpu_ns > 80000000);
        assert_int_equal(use.switches, 0);
    }
    assert_null(dip_thread_watch_open_process(0x7fffffff)); // No process has this number.
    assert_int_equal(dip_thread_watch_count(NULL), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_watch_counts_processor_time),
        cmocka_unit_test(the_watch_sees_another_process),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
