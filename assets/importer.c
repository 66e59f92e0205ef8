// The program's side of an import: starts the importer process, waits for it within its limits,
// explains its end if it failed, and takes over the scene that it made.
#define _GNU_SOURCE // memfd_create, pipe2, F_GET_SEALS
#include "assets/importer.h"

#include "assets/importer_private.h"
#include "assets/model_parts.h"
#include "assets/pack/scene_pack.h"

#ifdef __linux__

#include "renderer/base/assert.h"
#include "renderer/base/clock.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

typedef enum EndKind {
    END_DONE,    // The pack is complete.
    END_NO_PACK, // The process could not write the pack.
    END_EXITED,  // The process ended by itself without a pack.
    END_SIGNAL,  // A signal ended the process.
    END_TIMEOUT, // The process was ended because it took too long.
    END_UNKNOWN, // The system does not tell, because the program ignores SIGCHLD.
} EndKind;

typedef struct Child {
    const DipModelLoad *load;
    DipImporter importer; // Without defaults: every limit is given.
    int pack_file;
    int pipe;
    pid_t process; // 0 if there is no process to wait for.
    EndKind end;
    int end_code; // NO_PACK: an errno; EXITED: the exit code; SIGNAL: the signal.
} Child;

static uint64_t default_memory_bytes(void) {
    const uint64_t least = (uint64_t)1 << 30;
    const long pages = sysconf(_SC_PHYS_PAGES);
    const long page_bytes = sysconf(_SC_PAGESIZE);
    const uint64_t all = pages > 0 && page_bytes > 0 ? (uint64_t)pages * (uint64_t)page_bytes : 0;
    return all / 4 * 3 > least ? all / 4 * 3 : least;
}

static DipImporter with_defaults(const DipImporter *given) {
    DipImporter importer = *given;
    importer.memory_bytes = given->memory_bytes ? given->memory_bytes : default_memory_bytes();
    importer.wall_s = given->wall_s > 0 ? given->wall_s : DIP_IMPORT_WALL_S;
    importer.cpu_s = given->cpu_s > 0 ? given->cpu_s : 4 * importer.wall_s;
    return importer;
}

// --- starting ------------------------------------------------------------------------------------

static bool cannot_start(const Child *child, int failure, DipError *err) {
    return dip_error_set_runtime(err, DIP_ERROR_RUNTIME, child->load->files[0], 0, NULL,
                                 "cannot start the importer %s: %s", child->importer.program,
                                 strerror(failure));
}

// Moves a file to a number that is none of those that the importer inherits. Returns -1 and leaves
// errno on failure.
static int move_up(int file) {
    const int moved = file >= 0 ? fcntl(file, F_DUPFD_CLOEXEC, IMPORT_PIPE + 1) : -1;
    const int failure = errno;
    if (file >= 0) {
        close(file);
    }
    errno = failure;
    return moved;
}

// Makes the pack file and the pipe. Returns the writing end of the pipe, or -1 and errno.
static int make_files(Child *child) {
    int ends[2];
    child->pack_file = move_up(memfd_create("diptych-scene", MFD_CLOEXEC | MFD_ALLOW_SEALING));
    if (child->pack_file < 0 || !dip_scene_pack_note(child->pack_file, DIP_IMPORT_STARTS, 0) ||
        pipe2(ends, O_CLOEXEC) != 0) {
        return -1;
    }
    child->pipe = ends[0];
    return move_up(ends[1]);
}

// True for the environment variables that the importer needs to start: where libraries are, and how
// sanitizers behave.
static bool is_passed_on(const char *variable) {
    static const char *const names[] = {
        "LD_LIBRARY_PATH=", "ASAN_OPTIONS=", "LSAN_OPTIONS=", "TSAN_OPTIONS=", "UBSAN_OPTIONS="};
    for (size_t i = 0; i < DIP_ARRAY_COUNT(names); ++i) {
        if (strncmp(variable, names[i], strlen(names[i])) == 0) {
            return true;
        }
    }
    return false;
}

// The command line and the environment of the importer.
typedef struct Invocation {
    char numbers[IMPORT_ARGUMENT_COUNT][IMPORT_NUMBER_BYTES];
    char rule_numbers[DIP_MAX_MATERIAL_RULES][2][IMPORT_NUMBER_BYTES]; // mark, line
    const char *arguments[2 + DIP_IMPORTER_MAX_ARGUMENTS + 1];
    const char *environment[8];
} Invocation;

static const char *text_or_empty(const char *text) {
    return text ? text : "";
}

// Adds the arguments of the rules. Returns the new count of arguments.
static size_t add_rules(const DipModelLoad *load, Invocation *invocation, size_t count) {
    for (int i = 0; i < load->options.rule_count; ++i) {
        const DipMaterialRule *rule = &load->options.rules[i];
        char(*numbers)[IMPORT_NUMBER_BYTES] = invocation->rule_numbers[i];
        snprintf(numbers[0], IMPORT_NUMBER_BYTES, "%d", (int)rule->mark);
        snprintf(numbers[1], IMPORT_NUMBER_BYTES, "%d", rule->line);
        const char **to = invocation->arguments + count;
        to[IMPORT_RULE_mark] = numbers[0];
        to[IMPORT_RULE_line] = numbers[1];
        to[IMPORT_RULE_pattern] = rule->pattern;
        to[IMPORT_RULE_light_map] = text_or_empty(rule->light_map);
        to[IMPORT_RULE_file] = text_or_empty(rule->file);
        to[IMPORT_RULE_key] = text_or_empty(rule->key);
        count += IMPORT_RULE_ARGUMENT_COUNT;
    }
    return count;
}

static void fill_invocation(const Child *child, Invocation *invocation) {
    const DipModelLoad *load = child->load;
    uint64_t light_scale;
    memcpy(&light_scale, &load->options.light_scale, sizeof light_scale);
    uint64_t held_s;
    memcpy(&held_s, &load->options.animation_held_s, sizeof held_s);
    const uint64_t values[IMPORT_ARGUMENT_COUNT] = {
        [IMPORT_ARGUMENT_version] = IMPORT_VERSION,
        [IMPORT_ARGUMENT_program_id] = (uint64_t)getpid(),
        [IMPORT_ARGUMENT_threads] = (uint64_t)(load->pool ? dip_pool_thread_count(load->pool) : 1),
        [IMPORT_ARGUMENT_normal_maps] = load->options.normal_maps,
        [IMPORT_ARGUMENT_up] = load->options.up,
        [IMPORT_ARGUMENT_rules] = (uint64_t)load->options.rule_count,
        [IMPORT_ARGUMENT_flat] = load->options.shading == DIP_MODEL_SHADING_flat,
        [IMPORT_ARGUMENT_has_light_scale] = load->options.has_light_scale,
        [IMPORT_ARGUMENT_light_scale] = light_scale,
        [IMPORT_ARGUMENT_animation] = load->options.animation,
        [IMPORT_ARGUMENT_animation_is_held] = load->options.animation_is_held,
        [IMPORT_ARGUMENT_animation_held_s] = held_s,
        [IMPORT_ARGUMENT_picture_only] = load->picture_only,
        [IMPORT_ARGUMENT_memory_bytes] = child->importer.memory_bytes,
        [IMPORT_ARGUMENT_cpu_s] = (uint64_t)child->importer.cpu_s,
    };
    size_t count = 0;
    invocation->arguments[count++] = child->importer.program;
    if (child->importer.command) {
        invocation->arguments[count++] = child->importer.command;
    }
    invocation->arguments[count++] = import_mark;
    for (int i = 0; i < IMPORT_ARGUMENT_COUNT; ++i) {
        snprintf(invocation->numbers[i], IMPORT_NUMBER_BYTES, "%" PRIu64, values[i]);
        invocation->arguments[count++] = invocation->numbers[i];
    }
    invocation->arguments[count++] = text_or_empty(load->options.animation_name);
    count = add_rules(load, invocation, count);
    memcpy(invocation->arguments + count, load->files,
           (size_t)load->file_count * sizeof *load->files);
    size_t variables = 0;
    // For glibc: huge pages for decoded pictures, and memory that is reused from picture to picture
    // instead of given back, which saves the kernel half of its work.
    invocation->environment[variables++] =
        "GLIBC_TUNABLES=glibc.malloc.hugetlb=1:glibc.malloc.mmap_threshold=8388608:"
        "glibc.malloc.trim_threshold=67108864";
    for (char **variable = environ; *variable; ++variable) {
        if (is_passed_on(*variable) && variables + 1 < DIP_ARRAY_COUNT(invocation->environment)) {
            invocation->environment[variables++] = *variable;
        }
    }
}

// The importer gets no input, and what its libraries print is dropped. With a sanitizer, its errors
// are printed, because the sanitizer reports there.
static int add_file_actions(const Child *child, int pipe_end, posix_spawn_file_actions_t *actions) {
    int failure = posix_spawn_file_actions_addopen(actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    for (int file = STDOUT_FILENO; !failure && file <= STDERR_FILENO - IMPORT_IS_SANITIZED;
         ++file) {
        failure = posix_spawn_file_actions_addopen(actions, file, "/dev/null", O_WRONLY, 0);
    }
    failure = failure
                  ? failure
                  : posix_spawn_file_actions_adddup2(actions, child->pack_file, IMPORT_PACK_FILE);
    return failure ? failure : posix_spawn_file_actions_adddup2(actions, pipe_end, IMPORT_PIPE);
}

// The importer starts with the default action for every signal, whatever the program has set.
static int set_signals(posix_spawnattr_t *attributes) {
    sigset_t all;
    sigset_t none;
    sigfillset(&all);
    sigemptyset(&none);
    int failure = posix_spawnattr_setsigdefault(attributes, &all);
    failure = failure ? failure : posix_spawnattr_setsigmask(attributes, &none);
    return failure ? failure
                   : posix_spawnattr_setflags(attributes,
                                              POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
}

// Returns 0 or an errno.
static int spawn(Child *child, int pipe_end) {
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    Invocation *invocation = calloc(1, sizeof *invocation);
    if (!invocation) {
        return ENOMEM;
    }
    fill_invocation(child, invocation);
    int failure = posix_spawn_file_actions_init(&actions);
    if (!failure) {
        failure = posix_spawnattr_init(&attributes);
        if (!failure) {
            failure = add_file_actions(child, pipe_end, &actions);
            failure = failure ? failure : set_signals(&attributes);
            failure = failure ? failure
                              : posix_spawn(&child->process, child->importer.program, &actions,
                                            &attributes, (char *const *)invocation->arguments,
                                            (char *const *)invocation->environment);
            posix_spawnattr_destroy(&attributes);
        }
        posix_spawn_file_actions_destroy(&actions);
    }
    free(invocation);
    return failure;
}

static bool start(Child *child, DipError *err) {
    const int pipe_end = make_files(child);
    if (pipe_end < 0) {
        return cannot_start(child, errno, err);
    }
    const int failure = spawn(child, pipe_end);
    close(pipe_end);
    if (failure) {
        child->process = 0;
        return cannot_start(child, failure, err);
    }
    return true;
}

// --- waiting -------------------------------------------------------------------------------------

static void set_end(Child *child, EndKind end, int code) {
    child->end = end;
    child->end_code = code;
    child->process = 0;
}

static void kill_child(Child *child) {
    if (child->process) {
        kill(child->process, SIGKILL);
        while (waitpid(child->process, NULL, 0) < 0 && errno == EINTR) {
        }
        child->process = 0;
    }
}

// Waits until the importer has written to the pipe or closed it. Returns false if neither happens
// before end_ns. Sets *failure to the byte that the importer wrote: 0, or an errno; or to -1 if it
// wrote none.
static bool wait_for_pipe(Child *child, int64_t end_ns, int *failure) {
    struct pollfd pipe = {.fd = child->pipe, .events = POLLIN};
    for (;;) {
        const int64_t left_ms = (end_ns - dip_clock_ns()) / 1000000;
        const int ready =
            poll(&pipe, 1, left_ms > 0 ? (int)(left_ms < INT_MAX ? left_ms : INT_MAX) : 0);
        if (ready > 0) {
            unsigned char byte;
            const ssize_t count = read(child->pipe, &byte, 1);
            if (count < 0 && errno == EINTR) {
                continue;
            }
            *failure = count == 1 ? byte : -1;
            return true;
        }
        if (left_ms <= 0 || (ready < 0 && errno != EINTR)) {
            return false;
        }
    }
}

// Waits for the end of an importer that has closed the pipe.
static void wait_for_end(Child *child, int64_t end_ns) {
    int status = 0;
    pid_t ended = 0;
    while ((ended = waitpid(child->process, &status, WNOHANG)) == 0 && dip_clock_ns() < end_ns) {
        poll(NULL, 0, 1);
    }
    if (ended == 0) {
        kill_child(child);
        set_end(child, END_TIMEOUT, 0);
    } else if (ended < 0) {
        set_end(child, END_UNKNOWN, 0);
    } else if (WIFSIGNALED(status)) {
        set_end(child, END_SIGNAL, WTERMSIG(status));
    } else {
        set_end(child, END_EXITED, WEXITSTATUS(status));
    }
}

// Waits for the pack. When it is complete, the importer may still be ending; close_child waits for
// that.
static void wait_for_pack(Child *child) {
    const int64_t end_ns = dip_clock_ns() + (int64_t)child->importer.wall_s * 1000000000;
    int failure = -1;
    if (!wait_for_pipe(child, end_ns, &failure)) {
        kill_child(child);
        set_end(child, END_TIMEOUT, 0);
    } else if (failure < 0) {
        wait_for_end(child, end_ns);
    } else {
        child->end = failure ? END_NO_PACK : END_DONE;
        child->end_code = failure;
    }
}

// --- explaining ----------------------------------------------------------------------------------

static const char *signal_name(int number, char text[32]) {
    static const struct {
        int number;
        const char *name;
    } names[] = {{SIGSEGV, "SIGSEGV"}, {SIGABRT, "SIGABRT"}, {SIGBUS, "SIGBUS"},
                 {SIGFPE, "SIGFPE"},   {SIGILL, "SIGILL"},   {SIGKILL, "SIGKILL"},
                 {SIGTERM, "SIGTERM"}, {SIGSYS, "SIGSYS"},   {SIGTRAP, "SIGTRAP"}};
    for (size_t i = 0; i < DIP_ARRAY_COUNT(names); ++i) {
        if (names[i].number == number) {
            return names[i].name;
        }
    }
    snprintf(text, 32, "signal %d", number);
    return text;
}

// Finds the model file at which the importer stopped, and what it was doing.
static const char *last_step(const Child *child, const char **file) {
    DipImportStage stage = DIP_IMPORT_STARTS;
    int index = 0;
    static const char *const doing[] = {
        [DIP_IMPORT_STARTS] = "while it started",
        [DIP_IMPORT_READS] = "while it read the model",
        [DIP_IMPORT_PICTURES] = "while it decoded pictures",
        [DIP_IMPORT_PACKS] = "while it handed over the model",
        [DIP_IMPORT_DONE] = "after it had handed over the model",
    };
    const bool known = dip_scene_pack_read_note(child->pack_file, &stage, &index) &&
                       index < child->load->file_count;
    *file = child->load->files[known ? index : 0];
    return doing[known ? stage : DIP_IMPORT_STARTS];
}

static bool explain_signal(const Child *child, const char *file, const char *step, DipError *err) {
    char text[32];
    if (child->end_code == SIGXCPU) {
        return dip_error_set(err, DIP_ERROR_OVERSIZED, file, 0, NULL,
                             "the importer used up its processor time %s, accepted %d s", step,
                             child->importer.cpu_s);
    }
    return dip_error_set(err, DIP_ERROR_RUNTIME, file, 0, NULL, "the importer crashed %s (%s)",
                         step, signal_name(child->end_code, text));
}

// EFBIG comes from the limit of the pack's size, every other errno from the system.
static bool explain_no_pack(const Child *child, const char *file, DipError *err) {
    if (child->end_code == EFBIG) {
        return dip_error_set(err, DIP_ERROR_OVERSIZED, file, 0, NULL,
                             "the imported model does not fit into memory, accepted %" PRIu64
                             " MiB",
                             child->importer.memory_bytes >> 20);
    }
    return dip_error_set_runtime(err, DIP_ERROR_RUNTIME, file, 0, NULL,
                                 "the importer could not hand over the model: %s",
                                 strerror(child->end_code));
}

// Fills *err with the reason why there is no pack. A file that ends the importer counts as bad
// input. Returns false.
static bool explain_end(const Child *child, DipError *err) {
    const char *file;
    const char *step = last_step(child, &file);
    if (child->end == END_NO_PACK) {
        return explain_no_pack(child, file, err);
    }
    DipError reason = {0};
    switch (child->end) {
    case END_SIGNAL:
        explain_signal(child, file, step, &reason);
        break;
    case END_EXITED:
        dip_error_set(&reason, DIP_ERROR_RUNTIME, file, 0, NULL,
                      "the importer ended %s with exit code %d and without a result", step,
                      child->end_code);
        break;
    case END_TIMEOUT:
        dip_error_set(&reason, DIP_ERROR_OVERSIZED, file, 0, NULL,
                      "the importer hung %s, accepted at most %d s", step, child->importer.wall_s);
        break;
    default:
        dip_error_set(&reason, DIP_ERROR_RUNTIME, file, 0, NULL, "the importer ended %s", step);
    }
    reason.origin = DIP_ORIGIN_INPUT;
    if (err) {
        *err = reason;
    }
    return false;
}

// --- taking over ---------------------------------------------------------------------------------

// Maps the pack. An importer could shrink or change a file that is not sealed while it is read.
static bool map_pack(const Child *child, DipModel *model, DipError *err) {
    const int seals = F_SEAL_WRITE | F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL;
    struct stat info;
    if (fcntl(child->pack_file, F_GET_SEALS) != seals || fstat(child->pack_file, &info) != 0 ||
        info.st_size <= 0) {
        return dip_error_set(err, DIP_ERROR_FORMAT, child->load->files[0], 0, NULL,
                             "the importer's result is not sealed");
    }
    model->pack_size_bytes = (size_t)info.st_size;
    void *bytes = mmap(NULL, model->pack_size_bytes, PROT_READ, MAP_PRIVATE | MAP_POPULATE,
                       child->pack_file, 0);
    model->pack_bytes = bytes == MAP_FAILED ? NULL : bytes;
    return model->pack_bytes || dip_model_out_of_memory(err, child->load->files[0]);
}

void dip_model_unmap_pack(DipModel *model) {
    if (model->pack_bytes) {
        munmap(model->pack_bytes, model->pack_size_bytes);
        model->pack_bytes = NULL;
    }
}

static void pass_on_warnings(const DipErrorList *warnings, DipErrorList *to) {
    for (size_t i = 0; to && i < warnings->count; ++i) {
        dip_error_list_add(to, &warnings->items[i]);
    }
}

// Copies the error with which the import failed. If the importer ran out of memory, its limit is to
// blame, not the machine.
static bool pass_on_failure(const Child *child, const DipError *failure, DipError *err) {
    if (failure->code == DIP_ERROR_MEMORY) {
        const char *file;
        const char *step = last_step(child, &file);
        (void)step;
        return dip_error_set(err, DIP_ERROR_OVERSIZED, failure->file[0] ? failure->file : file, 0,
                             NULL, "the importer ran out of memory, accepted %" PRIu64 " MiB",
                             child->importer.memory_bytes >> 20);
    }
    if (err) {
        *err = *failure;
    }
    return false;
}

static bool take_pack(const Child *child, DipModel *model, DipError *err) {
    if (!map_pack(child, model, err)) {
        return false;
    }
    DipScenePack *pack = dip_model_alloc(model, 1, sizeof *pack);
    if (!pack) {
        return dip_model_out_of_memory(err, child->load->files[0]);
    }
    model->pack = pack;
    DipError malformed;
    if (!dip_scene_pack_read(model->pack_bytes, model->pack_size_bytes, pack, &malformed)) {
        return dip_error_set(err, malformed.code, child->load->files[0], 0, NULL, "%s",
                             malformed.message);
    }
    if (pack->failure.code != DIP_ERROR_NONE) {
        return pass_on_failure(child, &pack->failure, err);
    }
    pass_on_warnings(&pack->warnings, child->load->warnings);
    model->def = pack->scene;
    model->clip_names = pack->clips;
    model->clip_count = pack->clip_count;
    return true;
}

static void close_child(Child *child) {
    kill_child(child);
    if (child->pack_file >= 0) {
        close(child->pack_file);
    }
    if (child->pipe >= 0) {
        close(child->pipe);
    }
}

static bool import(Child *child, DipModel *model, DipError *err) {
    if (!start(child, err)) {
        return false;
    }
    wait_for_pack(child);
    return child->end == END_DONE ? take_pack(child, model, err) : explain_end(child, err);
}

DipModel *dip_model_load_in_child(const DipModelLoad *load, const DipImporter *importer,
                                  DipError *err) {
    const int64_t begin_ns = dip_clock_ns();
    DipModel *model = calloc(1, sizeof *model);
    if (!model) {
        dip_model_out_of_memory(err, load->files[0]);
        return NULL;
    }
    Child child = {.load = load, .importer = with_defaults(importer), .pack_file = -1, .pipe = -1};
    const bool imported = import(&child, model, err);
    close_child(&child);
    if (!imported) {
        dip_model_destroy(&model);
        return NULL;
    }
    model->times.pictures_ms = model->pack->times.pictures_ms;
    model->times.import_ms = 1e-6 * (double)(dip_clock_ns() - begin_ns) - model->times.pictures_ms;
    return model;
}

#else

DipModel *dip_model_load_in_child(const DipModelLoad *load, const DipImporter *importer,
                                  DipError *err) {
    (void)importer;
    return dip_model_load_here(load, err);
}

void dip_model_unmap_pack(DipModel *model) {
    (void)model;
}

#endif
