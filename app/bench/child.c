// Starting another program and talking with it through pipes.
#include "app/bench/child.h"

#include "renderer/base/number.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { LINE_SIZE = 1024 };

extern char **environ;

struct DipBenchChild {
    const char *program; // borrowed
    pid_t pid;           // 0 if there is no process
    FILE *to;
    FILE *from;
};

// --- starting ----------------------------------------------------------------------------------

// Returns this program's command line with `program` as argv[0] and --serve at the end. The texts
// are borrowed; the caller frees the array.
static char **child_arguments(const char *program, const DipBenchOptions *options) {
    char **arguments = calloc((size_t)options->argc + 2, sizeof *arguments);
    if (arguments) {
        memcpy(arguments, options->argv, (size_t)options->argc * sizeof *arguments);
        arguments[0] = (char *)program;
        arguments[options->argc] = (char *)"--serve";
    }
    return arguments;
}

// Starts the child with `in` as its standard input and `out` as its standard output. The child does
// not inherit the other ends of the pipes, because these ends are close-on-exec. Returns 0 or an
// errno.
static int spawn(DipBenchChild *child, const DipBenchOptions *options, int in, int out) {
    char **arguments = child_arguments(child->program, options);
    posix_spawn_file_actions_t actions;
    if (!arguments || posix_spawn_file_actions_init(&actions) != 0) {
        free(arguments);
        return ENOMEM;
    }
    posix_spawn_file_actions_adddup2(&actions, in, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
    const int failure =
        posix_spawn(&child->pid, child->program, &actions, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    free(arguments);
    child->pid = failure ? 0 : child->pid;
    return failure;
}

static bool close_on_exec(const int pipe_ends[2]) {
    return fcntl(pipe_ends[0], F_SETFD, FD_CLOEXEC) == 0 &&
           fcntl(pipe_ends[1], F_SETFD, FD_CLOEXEC) == 0;
}

static bool start(DipBenchChild *child, const DipBenchOptions *options, DipError *err) {
    int down[2] = {-1, -1};
    int up[2] = {-1, -1};
    int failure = ENFILE;
    if (pipe(down) == 0 && pipe(up) == 0 && close_on_exec(down) && close_on_exec(up)) {
        failure = spawn(child, options, down[0], up[1]);
        child->to = fdopen(down[1], "w");
        child->from = fdopen(up[0], "r");
    }
    const int unused[] = {down[0], up[1], child->to ? -1 : down[1], child->from ? -1 : up[0]};
    for (int i = 0; i < 4; i++) {
        if (unused[i] >= 0) {
            close(unused[i]);
        }
    }
    return (failure == 0 && child->to && child->from) ||
           dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "--vs", "%s cannot be started: %s",
                         child->program, strerror(failure));
}

static bool read_line(DipBenchChild *child, char line[LINE_SIZE], DipError *err) {
    return fgets(line, LINE_SIZE, child->from) ||
           dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "--vs",
                         "%s has ended; see its own message above", child->program);
}

static bool check_greeting(DipBenchChild *child, const DipBenchPlan *plan, DipError *err) {
    char line[LINE_SIZE];
    int count;
    int frames;
    if (!read_line(child, line, err)) {
        return false;
    }
    if (sscanf(line, "diptych-bench 1 %d %d", &count, &frames) != 2) {
        return dip_error_set_runtime(
            err, DIP_ERROR_FORMAT, NULL, 0, "--vs",
            "%s did not answer as diptych's bench does; is it a diptych of another version?",
            child->program);
    }
    return (count == plan->count && frames == plan->options.frames) ||
           dip_error_set_runtime(err, DIP_ERROR_CONFLICT, NULL, 0, "--vs",
                                 "%s has %d combinations of %d frames, but this program has %d "
                                 "combinations of %d frames",
                                 child->program, count, frames, plan->count, plan->options.frames);
}

DipBenchChild *dip_bench_child_start(const char *program, const DipBenchPlan *plan, DipError *err) {
    DipBenchChild *child = calloc(1, sizeof *child);
    if (!child) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "--vs", "out of memory");
        return NULL;
    }
    child->program = program;
    // With SIGPIPE ignored, writing to a child that has ended does not end this program. The next
    // read finds the end of the file, which is then reported.
    signal(SIGPIPE, SIG_IGN);
    if (!start(child, &plan->options, err) || !check_greeting(child, plan, err)) {
        dip_bench_child_stop(&child);
    }
    return child;
}

long dip_bench_child_pid(const DipBenchChild *child) {
    return (long)child->pid;
}

void dip_bench_child_stop(DipBenchChild **child_pointer) {
    DipBenchChild *child = *child_pointer;
    if (!child) {
        return;
    }
    if (child->to) {
        fclose(child->to);
    }
    if (child->from) {
        fclose(child->from);
    }
    if (child->pid) {
        waitpid(child->pid, NULL, 0);
    }
    free(child);
    *child_pointer = NULL;
}

// --- asking ------------------------------------------------------------------------------------

// Stores one NAME=VALUE of an answer. Ignores an unknown name.
static void store_word(const char *word, DipBenchSample *sample) {
    const char *equals = strchr(word, '=');
    const size_t length = equals ? (size_t)(equals - word) : 0;
    if (length == strlen("hash") && memcmp(word, "hash", length) == 0) {
        snprintf(sample->hash, sizeof sample->hash, "%s", equals + 1);
    }
    for (int stage = 0; length && stage < DIP_BENCH_STAGE_COUNT; stage++) {
        const char *name = dip_bench_stage_names[stage];
        const size_t name_length = strlen(name);
        if (length == name_length + 3 && memcmp(word, name, name_length) == 0 &&
            memcmp(word + name_length, "_ms", 3) == 0) {
            dip_number_parse(equals + 1, strlen(equals + 1), &sample->ms[stage]);
        }
    }
#define STORE_COUNTER(name, text)                                                                  \
    if (length == strlen(#name) && memcmp(word, #name, length) == 0) {                             \
        sample->counters.name = strtoull(equals + 1, NULL, 10);                                    \
    }
    DIP_COUNTER_LIST(STORE_COUNTER)
#undef STORE_COUNTER
}

bool dip_bench_child_draw(void *context, int combination, int frame, bool hash,
                          DipBenchSample *sample, DipError *err) {
    DipBenchChild *child = context;
    char line[LINE_SIZE];
    *sample = (DipBenchSample){.hash = ""};
    fprintf(child->to, "draw %d %d %d\n", combination, frame, hash);
    fflush(child->to);
    if (!read_line(child, line, err)) {
        return false;
    }
    char *rest = NULL;
    for (char *word = strtok_r(line, " \n", &rest); word; word = strtok_r(NULL, " \n", &rest)) {
        store_word(word, sample);
    }
    return sample->ms[DIP_BENCH_STAGE_total] > 0.0 ||
           dip_error_set_runtime(err, DIP_ERROR_FORMAT, NULL, 0, "--vs",
                                 "%s answered without a time", child->program);
}

// --- answering ---------------------------------------------------------------------------------

static void answer(const DipBenchSample *sample) {
    for (int stage = 0; stage < DIP_BENCH_STAGE_COUNT; stage++) {
        printf("%s_ms=%.6f ", dip_bench_stage_names[stage], sample->ms[stage]);
    }
#define PRINT_COUNTER(name, text) printf("%s=%" PRIu64 " ", #name, sample->counters.name);
    DIP_COUNTER_LIST(PRINT_COUNTER)
#undef PRINT_COUNTER
    printf("hash=%s\n", sample->hash);
    fflush(stdout);
}

bool dip_bench_serve(const DipBenchPlan *plan, const DipBenchSource *source, DipError *err) {
    char line[LINE_SIZE];
    printf("diptych-bench 1 %d %d\n", plan->count, plan->options.frames);
    fflush(stdout);
    while (fgets(line, sizeof line, stdin)) {
        int combination;
        int frame;
        int hash;
        DipBenchSample sample;
        if (sscanf(line, "draw %d %d %d", &combination, &frame, &hash) != 3 || combination < 0 ||
            combination >= plan->count || frame < 0 || frame >= plan->options.frames) {
            line[strcspn(line, "\n")] = '\0';
            return dip_error_set_runtime(
                err, DIP_ERROR_FORMAT, NULL, 0, "--serve",
                "'%.60s' is not a request; give draw COMBINATION FRAME 0|1", line);
        }
        if (!source->draw(source->context, combination, frame, hash != 0, &sample, err)) {
            return false;
        }
        answer(&sample);
    }
    return true;
}
