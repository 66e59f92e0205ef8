// Reads the processor and waiting times of threads from /proc/PID/task/*/schedstat, and the number
// of involuntary context switches from getrusage.
#define _DEFAULT_SOURCE 1 // Declares getrusage's ru_nivcsw with every C library.
#include "app/measure/timing/thread_use.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

struct DipThreadWatch {
    int *files; // The file schedstat of each watched thread, open for reading.
    int count;
    bool is_other; // The threads are those of another process.
};

static bool read_thread(int file, DipThreadUse *sum) {
    char text[96];
    const ssize_t length = pread(file, text, sizeof text - 1, 0);
    if (length <= 0) {
        return false; // The thread has ended, or the kernel keeps no such figures.
    }
    text[length] = '\0';
    char *rest;
    sum->cpu_ns += strtoll(text, &rest, 10);
    sum->wait_ns += strtoll(rest, NULL, 10);
    return true;
}

static bool add_thread(DipThreadWatch *watch, const char *folder, const char *thread) {
    char name[96];
    const int length = snprintf(name, sizeof name, "%s/%.20s/schedstat", folder, thread);
    int *files = realloc(watch->files, ((size_t)watch->count + 1) * sizeof *files);
    watch->files = files ? files : watch->files;
    if (!files || length >= (int)sizeof name) {
        return false;
    }
    const int file = open(name, O_RDONLY | O_CLOEXEC);
    if (file < 0) {
        return false;
    }
    watch->files[watch->count++] = file;
    DipThreadUse sum = {0};
    return read_thread(file, &sum);
}

// Returns whether a thread has a lower priority than the calling thread. Such a thread draws no
// timed frame, so its waiting time says nothing about a frame.
static bool is_background(const char *thread) {
    return getpriority(PRIO_PROCESS, (id_t)strtoul(thread, NULL, 10)) >
           getpriority(PRIO_PROCESS, 0);
}

static DipThreadWatch *open_watch(const char *folder) {
    DIR *threads = opendir(folder);
    DipThreadWatch *watch = threads ? calloc(1, sizeof *watch) : NULL;
    bool complete = watch != NULL;
    for (const struct dirent *entry; complete && (entry = readdir(threads)) != NULL;) {
        complete = entry->d_name[0] == '.' || is_background(entry->d_name) ||
                   add_thread(watch, folder, entry->d_name);
    }
    if (threads) {
        closedir(threads);
    }
    if (!complete) {
        dip_thread_watch_close(&watch);
    }
    return watch;
}

DipThreadWatch *dip_thread_watch_open(void) {
    return open_watch("/proc/self/task");
}

DipThreadWatch *dip_thread_watch_open_process(long pid) {
    char folder[48];
    snprintf(folder, sizeof folder, "/proc/%ld/task", pid);
    DipThreadWatch *watch = open_watch(folder);
    if (watch) {
        watch->is_other = true;
    }
    return watch;
}

int dip_thread_watch_count(const DipThreadWatch *watch) {
    return watch ? watch->count : 0;
}

void dip_thread_watch_close(DipThreadWatch **watch_pointer) {
    DipThreadWatch *watch = *watch_pointer;
    if (watch) {
        for (int i = 0; i < watch->count; i++) {
            close(watch->files[i]);
        }
        free(watch->files);
        free(watch);
    }
    *watch_pointer = NULL;
}

DipThreadUse dip_thread_watch_read(const DipThreadWatch *watch) {
    DipThreadUse sum = {.has_wait = watch != NULL};
    for (int i = 0; watch && i < watch->count; i++) {
        read_thread(watch->files[i], &sum);
    }
    if (!watch) {
        struct timespec time;
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
        sum.cpu_ns = (int64_t)time.tv_sec * 1000000000 + time.tv_nsec;
    }
    struct rusage usage;
    const bool is_other = watch && watch->is_other; // getrusage does not tell of other processes.
    sum.switches = !is_other && getrusage(RUSAGE_SELF, &usage) == 0 ? usage.ru_nivcsw : 0;
    return sum;
}
