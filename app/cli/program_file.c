// The file of the running program.
#define _XOPEN_SOURCE 700 // For realpath.
#include "app/cli/program_file.h"

#include <limits.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/auxv.h>
#include <unistd.h>

static const char in_proc[] = "/proc/self/exe";

static pthread_once_t once = PTHREAD_ONCE_INIT;
static char program_path[PATH_MAX]; // "" if it is unknown.

static void find_path(void) {
    const ssize_t length = readlink(in_proc, program_path, sizeof program_path - 1);
    if (length >= 0) {
        program_path[length] = '\0';
        return;
    }
    const char *started = (const char *)getauxval(AT_EXECFN); // The name that execve was given.
    char resolved[PATH_MAX];
    if (started && realpath(started, resolved)) {
        snprintf(program_path, sizeof program_path, "%s", resolved);
    }
}

const char *dip_program_path(void) {
    pthread_once(&once, find_path);
    return program_path[0] ? program_path : NULL;
}

const char *dip_program_file(void) {
    const char *path = access(in_proc, R_OK) == 0 ? NULL : dip_program_path();
    return path ? path : in_proc;
}
