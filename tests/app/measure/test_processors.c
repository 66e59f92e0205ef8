// Tests of the choice of processors: their order by a made folder, and where the threads of this
// process and of another one may run afterwards.
#define _GNU_SOURCE // Declares sched_getaffinity() and cpu_set_t.
#include "app/measure/timing/processors.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <dirent.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

// --- order ---------------------------------------------------------------------------------------

// Writes a line into a file of a processor, and makes the file's folders.
static void write_file(const char *top, int processor, const char *folder, const char *name,
                       const char *line) {
    char path[256];
    snprintf(path, sizeof path, "%s/cpu%d", top, processor);
    mkdir(path, 0777);
    snprintf(path, sizeof path, "%s/cpu%d/%s", top, processor, folder);
    mkdir(path, 0777);
    snprintf(path, sizeof path, "%s/cpu%d/%s/%s", top, processor, folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "%s\n", line);
    fclose(file);
}

static void expect_order(const char *folder, int from, const int *given, int count,
                         const int *expected) {
    int order[16];
    memcpy(order, given, (size_t)count * sizeof *order);
    dip_processors_sort(folder, from, order, count);
    assert_memory_equal(order, expected, (size_t)count * sizeof *order);
}

static void fast_cores_come_first_and_second_processors_last(void **state) {
    (void)state;
    char top[] = "/tmp/test_processors_XXXXXX";
    assert_non_null(mkdtemp(top));
    // Two fast cores with the processors 0 and 1, and 2 and 11; two slow cores, 4 and 5.
    const char *const siblings[] = {"0-1", "0-1", "2,11", NULL, "4", "5"};
    const char *const speeds[] = {"4800000", "4800000", "4800000", NULL, "3600000", "3600000"};
    for (int i = 0; i < 6; i++) {
        if (siblings[i]) {
            write_file(top, i, "topology", "thread_siblings_list", siblings[i]);
            write_file(top, i, "cpufreq", "cpuinfo_max_freq", speeds[i]);
        }
    }
    write_file(top, 11, "topology", "thread_siblings_list", "2,11");
    write_file(top, 11, "cpufreq", "cpuinfo_max_freq", "4800000");
    const int all[] = {0, 1, 2, 4, 5, 11};
    expect_order(top, 0, all, 6, (const int[]){0, 2, 4, 5, 1, 11});
    // Equally suitable ones begin with number 5 and begin anew after the last.
    expect_order(top, 5, all, 6, (const int[]){0, 2, 5, 4, 11, 1});
    expect_order(top, 2, all, 6, (const int[]){2, 0, 4, 5, 11, 1});
    // The second processor of a core counts as the first if the first one may not be used.
    expect_order(top, 0, (const int[]){1, 4, 11}, 3, (const int[]){1, 11, 4});
    // The capacity is what counts where there is one.
    write_file(top, 5, "", "cpu_capacity", "1024");
    write_file(top, 4, "", "cpu_capacity", "446");
    expect_order(top, 0, (const int[]){4, 5}, 2, (const int[]){5, 4});
    // Without any files, the numbers alone decide.
    expect_order("/nonexistent", 0, (const int[]){2, 0, 1}, 3, (const int[]){0, 1, 2});
    expect_order("/nonexistent", 1, (const int[]){2, 0, 1}, 3, (const int[]){1, 2, 0});
    char command[64];
    snprintf(command, sizeof command, "rm -r %s", top);
    assert_int_equal(system(command), 0);
}

// --- confining -----------------------------------------------------------------------------------

// Returns how many processors all threads of a process may use, and adds these to the set. All its
// threads must have the same ones.
static int processors_of(pid_t process, int threads, cpu_set_t *set) {
    char folder[48];
    int seen = 0;
    snprintf(folder, sizeof folder, "/proc/%ld/task", (long)process);
    DIR *tasks = opendir(folder);
    assert_non_null(tasks);
    for (const struct dirent *entry; (entry = readdir(tasks)) != NULL;) {
        if (entry->d_name[0] != '.') {
            cpu_set_t own;
            const pid_t thread = (pid_t)strtol(entry->d_name, NULL, 10);
            assert_int_equal(sched_getaffinity(thread, sizeof own, &own), 0);
            assert_true(seen == 0 || CPU_EQUAL(set, &own));
            *set = own;
            seen++;
        }
    }
    closedir(tasks);
    assert_int_equal(seen, threads);
    return CPU_COUNT(set);
}

static void *tell_and_sleep(void *pipe_end) {
    close(*(int *)pipe_end); // The parent reads the end of the file.
    pause();
    return NULL;
}

// Starts a process with two threads that sleep until it is killed.
static pid_t start_two_threads(void) {
    int ends[2];
    char byte;
    assert_int_equal(pipe(ends), 0);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        pthread_t thread;
        if (pthread_create(&thread, NULL, tell_and_sleep, &ends[1]) == 0) {
            pause();
        }
        _exit(1);
    }
    close(ends[1]);
    assert_int_equal(read(ends[0], &byte, 1), 0);
    close(ends[0]);
    return child;
}

static void all_threads_of_all_processes_use_the_same_few_processors(void **state) {
    (void)state;
    cpu_set_t own, first, second;
    if (!dip_processors_confine((long)getpid(), 0)) {
        skip(); // This system cannot do it.
    }
    const int all = processors_of(getpid(), 1, &own);
    const pid_t children[] = {start_two_threads(), start_two_threads()};
    for (int threads = 1; threads <= all + 1 && threads < 4; threads++) {
        const int expected = threads < all ? threads : all;
        assert_true(dip_processors_confine((long)children[0], threads));
        assert_true(dip_processors_confine((long)children[1], threads));
        assert_int_equal(processors_of(children[0], 2, &first), expected);
        assert_int_equal(processors_of(children[1], 2, &second), expected);
        assert_true(CPU_EQUAL(&first, &second));
    }
    assert_true(dip_processors_confine((long)children[0], 0));
    assert_int_equal(processors_of(children[0], 2, &first), all);
    assert_int_equal(processors_of(getpid(), 1, &own), all); // This process was never confined.
    for (int i = 0; i < 2; i++) {
        kill(children[i], SIGKILL);
        waitpid(children[i], NULL, 0);
    }
    assert_false(dip_processors_confine(0x7fffffff, 1)); // No process has this number.
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fast_cores_come_first_and_second_processors_last),
        cmocka_unit_test(all_threads_of_all_processes_use_the_same_few_processors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
