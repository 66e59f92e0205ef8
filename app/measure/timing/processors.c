// Reads which processors belong to one core, and how fast they are, from Linux' files, and confines
// threads to processors by sched_setaffinity.
#define _GNU_SOURCE // Declares sched_setaffinity() and cpu_set_t.
#include "app/measure/timing/processors.h"

#include <dirent.h>
#include <pthread.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

typedef struct Processor {
    int number;
    bool is_second; // Another of the processors to sort has a lower number and the same core.
    bool is_before; // Its number is below `from`.
    long speed;     // Larger is faster; 0 if it is not known.
} Processor;

// Reads a file of a processor into a text. Returns false if there is none.
static bool read_file(const char *folder, int number, const char *name, char *text, int size) {
    char path[512];
    const int length = snprintf(path, sizeof path, "%s/cpu%d/%s", folder, number, name);
    FILE *file = length < (int)sizeof path ? fopen(path, "r") : NULL;
    const bool has_line = file && fgets(text, size, file);
    if (file) {
        fclose(file);
    }
    return has_line;
}

// Returns whether a list of processors such as "0-1,8" has this one.
static bool list_has(const char *list, int number) {
    for (const char *at = list; *at >= '0' && *at <= '9';) {
        char *end;
        const long first = strtol(at, &end, 10);
        const long last = *end == '-' ? strtol(end + 1, &end, 10) : first;
        if (first <= number && number <= last) {
            return true;
        }
        at = *end == ',' ? end + 1 : end;
    }
    return false;
}

static Processor describe(const char *folder, int number, int from, const int *processors,
                          int count) {
    Processor processor = {.number = number, .is_before = number < from};
    char text[256];
    if (read_file(folder, number, "topology/thread_siblings_list", text, sizeof text)) {
        for (int i = 0; i < count; i++) {
            processor.is_second |= processors[i] < number && list_has(text, processors[i]);
        }
    }
    // The first file tells the speed of cores of several kinds, and exists only on some platforms.
    if (read_file(folder, number, "cpu_capacity", text, sizeof text) ||
        read_file(folder, number, "cpufreq/cpuinfo_max_freq", text, sizeof text)) {
        processor.speed = strtol(text, NULL, 10);
    }
    return processor;
}

static int compare(const void *a, const void *b) {
    const Processor *p = a, *q = b;
    return p->is_second != q->is_second   ? p->is_second - q->is_second
           : p->speed != q->speed         ? (p->speed < q->speed) - (p->speed > q->speed)
           : p->is_before != q->is_before ? p->is_before - q->is_before
                                          : p->number - q->number;
}

void dip_processors_sort(const char *folder, int from, int *processors, int count) {
    Processor *all = malloc((size_t)count * sizeof *all);
    if (!all) {
        return; // The order stays as it is.
    }
    for (int i = 0; i < count; i++) {
        all[i] = describe(folder, processors[i], from, processors, count);
    }
    qsort(all, (size_t)count, sizeof *all, compare);
    for (int i = 0; i < count; i++) {
        processors[i] = all[i].number;
    }
    free(all);
}

#ifdef __linux__
static pthread_once_t once = PTHREAD_ONCE_INIT;
static cpu_set_t usable; // Processors that the first calling thread might use; none if not known.

static void find_usable(void) {
    if (sched_getaffinity(0, sizeof usable, &usable) != 0) {
        CPU_ZERO(&usable);
    }
}

// Returns the best of the usable processors, as many as `threads` says.
static cpu_set_t choose(int threads) {
    pthread_once(&once, find_usable);
    int processors[CPU_SETSIZE], count = 0;
    for (int i = 0; i < CPU_SETSIZE; i++) {
        if (CPU_ISSET(i, &usable)) {
            processors[count++] = i;
        }
    }
    if (threads == 0 || threads >= count) {
        return usable;
    }
    const int from = (int)(getpid() % (processors[count - 1] + 1));
    dip_processors_sort("/sys/devices/system/cpu", from, processors, count);
    cpu_set_t set;
    CPU_ZERO(&set);
    for (int i = 0; i < threads; i++) {
        CPU_SET(processors[i], &set);
    }
    return set;
}

bool dip_processors_confine(long pid, int threads) {
    const cpu_set_t set = choose(threads);
    char folder[48];
    snprintf(folder, sizeof folder, "/proc/%ld/task", pid);
    DIR *tasks = opendir(folder);
    bool confined = tasks != NULL;
    for (const struct dirent *entry; tasks && (entry = readdir(tasks)) != NULL;) {
        if (entry->d_name[0] != '.') {
            const pid_t thread = (pid_t)strtol(entry->d_name, NULL, 10);
            confined &= sched_setaffinity(thread, sizeof set, &set) == 0;
        }
    }
    if (tasks) {
        closedir(tasks);
    }
    return confined;
}
#else
bool dip_processors_confine(long pid, int threads) {
    (void)pid;
    (void)threads;
    return false;
}
#endif
