// Starts another program, sends it requests for frames and reads its answers through pipes. Also
// holds the child's side, which answers.
#include "app/measure/timing/child.h"

#include "app/measure/timing/processors.h"
#include "app/measure/timing/thread_use.h"
#include "renderer/base/fp_mode.h"
#include "renderer/base/number.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <math.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

// Room for a line of the protocol: 1024 bytes, and for each counter its name, '=', 20 digits and a
// blank.
enum {
#define ADD_COUNTER(name, text) +(int)sizeof #name + 22
    LINE_SIZE = 1024 DIP_COUNTER_LIST(ADD_COUNTER)
#undef ADD_COUNTER
};

extern char **environ;

struct DipChild {
    DipChildDef def;       // Its texts are borrowed.
    pid_t pid;             // 0 if there is no process.
    FILE *to;              // The child's standard input.
    FILE *from;            // The child's standard output.
    DipThreadWatch *watch; // NULL if the system does not tell the threads' times.
    int processors;        // The last number given to dip_child_confine; 0 before.
};

// --- starting ----------------------------------------------------------------------------------

// Returns the command line with the program as argv[0] and --serve at the end. The texts are
// borrowed; the caller frees the array.
static char **child_arguments(const DipChildDef *def) {
    char **arguments = calloc((size_t)def->argc + 2, sizeof *arguments);
    if (arguments) {
        memcpy(arguments, def->argv, (size_t)def->argc * sizeof *arguments);
        arguments[0] = (char *)def->program;
        arguments[def->argc] = (char *)"--serve";
    }
    return arguments;
}

// Starts the child with `in` as its standard input and `out` as its standard output. The child does
// not inherit the other ends of the pipes, because these ends are close-on-exec. Returns 0 or an
// errno.
static int spawn(DipChild *child, int in, int out) {
    char **arguments = child_arguments(&child->def);
    posix_spawn_file_actions_t actions;
    if (!arguments || posix_spawn_file_actions_init(&actions) != 0) {
        free(arguments);
        return ENOMEM;
    }
    posix_spawn_file_actions_adddup2(&actions, in, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
    const int failure =
        posix_spawn(&child->pid, child->def.program, &actions, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    free(arguments);
    child->pid = failure ? 0 : child->pid;
    return failure;
}

static bool close_on_exec(const int pipe_ends[2]) {
    return fcntl(pipe_ends[0], F_SETFD, FD_CLOEXEC) == 0 &&
           fcntl(pipe_ends[1], F_SETFD, FD_CLOEXEC) == 0;
}

static bool start(DipChild *child, DipError *err) {
    int down[2] = {-1, -1};
    int up[2] = {-1, -1};
    int failure = 0;
    if (pipe(down) == 0 && pipe(up) == 0 && close_on_exec(down) && close_on_exec(up)) {
        failure = spawn(child, down[0], up[1]);
        child->to = fdopen(down[1], "w");
        child->from = fdopen(up[0], "r");
        failure = failure == 0 && !(child->to && child->from) ? ENOMEM : failure;
    } else {
        failure = errno;
    }
    const int unused[] = {down[0], up[1], child->to ? -1 : down[1], child->from ? -1 : up[0]};
    for (int i = 0; i < 4; i++) {
        if (unused[i] >= 0) {
            close(unused[i]);
        }
    }
    return (failure == 0 && child->to && child->from) ||
           dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, child->def.key,
                         "%s cannot be started: %s", child->def.program, strerror(failure));
}

static bool read_line(DipChild *child, char line[LINE_SIZE], DipError *err) {
    return fgets(line, LINE_SIZE, child->from) ||
           dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, child->def.key,
                         "%s has ended; see its own message above", child->def.program);
}

static bool check_greeting(DipChild *child, DipError *err) {
    const DipChildDef *def = &child->def;
    char line[LINE_SIZE], what[32];
    int count, frames;
    if (!read_line(child, line, err)) {
        return false;
    }
    if (sscanf(line, "diptych-%31s 1 %d %d", what, &count, &frames) != 3 ||
        strcmp(what, def->what) != 0) {
        return dip_error_set_runtime(
            err, DIP_ERROR_FORMAT, NULL, 0, def->key,
            "%s did not answer as diptych's %s does; is it a diptych of another version?",
            def->program, def->what);
    }
    return (count == def->count && frames == def->frames) ||
           dip_error_set_runtime(err, DIP_ERROR_CONFLICT, NULL, 0, def->key,
                                 "%s has %d combinations of %d frames, but this program has %d "
                                 "combinations of %d frames",
                                 def->program, count, frames, def->count, def->frames);
}

DipChild *dip_child_start(const DipChildDef *def, DipError *err) {
    DipChild *child = calloc(1, sizeof *child);
    if (!child) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, def->key, "out of memory");
        return NULL;
    }
    child->def = *def;
    // With SIGPIPE ignored, writing to a child that has ended does not end this program. The next
    // read finds the end of the file, which is then reported.
    signal(SIGPIPE, SIG_IGN);
    if (!start(child, err) || !check_greeting(child, err)) {
        dip_child_stop(&child, false);
        return NULL;
    }
    child->watch = dip_thread_watch_open_process((long)child->pid);
    return child;
}

int dip_child_thread_count(const DipChild *child) {
    return dip_thread_watch_count(child->watch);
}

void dip_child_confine(DipChild *child, int threads) {
    if (threads != child->processors) {
        dip_processors_confine((long)child->pid, threads);
        child->processors = threads;
    }
}

void dip_child_stop(DipChild **child_pointer, bool at_once) {
    DipChild *child = *child_pointer;
    if (!child) {
        return;
    }
    dip_thread_watch_close(&child->watch);
    if (at_once && child->pid) {
        kill(child->pid, SIGTERM);
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

// Writes how long the threads ran and waited during a frame. timed->wait becomes a time in
// milliseconds, or NAN if it is not known. dip_child_draw later divides it by the frame's time, so
// that it becomes a share; dip_child_serve sends it to the parent as it is.
static void set_use(DipTimed *timed, const DipThreadUse *before, const DipThreadUse *after) {
    DIP_FP_MODE_SCOPE();
    timed->wait = after->has_wait ? 1e-6 * (double)(after->wait_ns - before->wait_ns) : NAN;
    timed->cpu_ms = 1e-6 * (double)(after->cpu_ns - before->cpu_ns);
    timed->switches = (double)(after->switches - before->switches);
}

static void store_number(const char *word, const char *value, const char *name, double *to) {
    if (strcmp(word, name) == 0) {
        dip_number_parse(value, strlen(value), to);
    }
}

// Stores one NAME=VALUE of an answer. Ignores an unknown name.
static void store_word(char *word, DipBenchSample *sample, DipTimed *timed) {
    char *value = strchr(word, '=');
    if (!value) {
        return;
    }
    *value++ = '\0';
    store_number(word, value, "wait_ms", &timed->wait);
    store_number(word, value, "cpu_ms", &timed->cpu_ms);
    store_number(word, value, "switches", &timed->switches);
    for (int stage = 0; stage < DIP_BENCH_STAGE_COUNT; stage++) {
        char name[32];
        snprintf(name, sizeof name, "%s_ms", dip_bench_stage_names[stage]);
        store_number(word, value, name, &sample->ms[stage]);
    }
    if (strcmp(word, "hash") == 0) {
        snprintf(sample->hash, sizeof sample->hash, "%s", value);
    }
#define STORE_COUNTER(name, text)                                                                  \
    if (strcmp(word, #name) == 0) {                                                                \
        sample->counters.name = strtoull(value, NULL, 10);                                         \
    }
    DIP_COUNTER_LIST(STORE_COUNTER)
#undef STORE_COUNTER
}

bool dip_child_draw(DipChild *child, const char *request, DipBenchSample *sample, DipTimed *timed,
                    DipError *err) {
    DIP_FP_MODE_SCOPE();
    char line[LINE_SIZE];
    *sample = (DipBenchSample){.hash = ""};
    const DipThreadUse before = dip_thread_watch_read(child->watch);
    fprintf(child->to, "%s\n", request);
    fflush(child->to);
    if (!read_line(child, line, err)) {
        return false;
    }
    const DipThreadUse after = dip_thread_watch_read(child->watch);
    // Sets timed->wait and cpu_ms from the watch, which knows no switches of the child. A newer
    // build measures all three itself, and store_word then replaces them by the build's answer. For
    // older builds, the watch's values are used, although they include the wait until the child
    // reads the request.
    set_use(timed, &before, &after);
    char *rest = NULL;
    for (char *word = strtok_r(line, " \n", &rest); word; word = strtok_r(NULL, " \n", &rest)) {
        store_word(word, sample, timed);
    }
    dip_bench_sample_time(sample, timed);
    timed->wait /= timed->ms;
    return timed->ms > 0.0 ||
           dip_error_set_runtime(err, DIP_ERROR_FORMAT, NULL, 0, child->def.key,
                                 "%s answered without a time", child->def.program);
}

// --- answering ---------------------------------------------------------------------------------

// printf rounds as the floating-point mode says.
static void answer(const DipBenchSample *sample, const DipTimed *timed) {
    DIP_FP_MODE_SCOPE();
    for (int stage = 0; stage < DIP_BENCH_STAGE_COUNT; stage++) {
        printf("%s_ms=%.6f ", dip_bench_stage_names[stage], sample->ms[stage]);
    }
#define PRINT_COUNTER(name, text) printf("%s=%" PRIu64 " ", #name, sample->counters.name);
    DIP_COUNTER_LIST(PRINT_COUNTER)
#undef PRINT_COUNTER
    if (!isnan(timed->wait)) {
        printf("wait_ms=%.6f cpu_ms=%.6f switches=%.0f ", timed->wait, timed->cpu_ms,
               timed->switches);
    }
    printf("hash=%s\n", sample->hash);
    fflush(stdout);
}

bool dip_child_serve(const char *what, int count, int frames,
                     bool (*prepare)(void *context, const char *request, DipError *err),
                     bool (*draw)(void *context, const char *request, DipBenchSample *sample,
                                  DipError *err),
                     void *context, DipError *err) {
    char line[LINE_SIZE];
    bool done = true;
    DipThreadWatch *watch = dip_thread_watch_open();
    printf("diptych-%s 1 %d %d\n", what, count, frames);
    fflush(stdout);
    while (done && fgets(line, sizeof line, stdin)) {
        DipBenchSample sample;
        line[strcspn(line, "\n")] = '\0';
        done = !prepare || prepare(context, line, err);
        const DipThreadUse before = dip_thread_watch_read(watch);
        done = done && draw(context, line, &sample, err);
        if (done) {
            const DipThreadUse after = dip_thread_watch_read(watch);
            DipTimed timed;
            set_use(&timed, &before, &after);
            answer(&sample, &timed);
        }
    }
    dip_thread_watch_close(&watch);
    return done;
}
