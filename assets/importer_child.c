// The importer process: limits itself, loads the model files, and hands over the scene as a sealed
// pack.
#define _GNU_SOURCE // F_ADD_SEALS, close_range
#include "assets/importer.h"

#include "assets/importer_private.h"
#include "assets/model_parts.h"
#include "assets/pack/scene_pack.h"

#ifdef __linux__

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

// Address space that is not memory in use: the program and its libraries, the stack of the thread
// that reads models, and for each thread its stack and the heap that the C library reserves for it.
static const uint64_t reserved_bytes = (uint64_t)1 << 30;
static const uint64_t reserved_per_thread_bytes = (uint64_t)160 << 20;

// Each attempt to seal takes up to 150 ms by itself.
enum { MAX_SEAL_ATTEMPTS = 100, SEAL_PAUSE_NS = 10000000 };

typedef struct Task {
    uint64_t number[IMPORT_ARGUMENT_COUNT];
    const char *files[DIP_MAX_MODEL_FILES];
    int file_count;
    const char *animation_name;
    DipMaterialRule rules[DIP_MAX_MATERIAL_RULES];
    int rule_count;
} Task;

// --- arguments -----------------------------------------------------------------------------------

static bool parse_number(const char *text, uint64_t *number) {
    char *end = NULL;
    errno = 0;
    *number = strtoull(text, &end, 10);
    return errno == 0 && text[0] >= '0' && text[0] <= '9' && *end == '\0';
}

static const char *text_or_null(const char *text) {
    return text[0] ? text : NULL;
}

static bool parse_rule(char *const *arguments, DipMaterialRule *rule) {
    uint64_t mark;
    uint64_t line;
    if (!parse_number(arguments[IMPORT_RULE_mark], &mark) || mark >= DIP_MARK_COUNT ||
        !parse_number(arguments[IMPORT_RULE_line], &line) || line > INT_MAX) {
        return false;
    }
    *rule = (DipMaterialRule){.mark = (DipMaterialMark)mark,
                              .pattern = arguments[IMPORT_RULE_pattern],
                              .light_map = text_or_null(arguments[IMPORT_RULE_light_map]),
                              .file = text_or_null(arguments[IMPORT_RULE_file]),
                              .line = (int)line,
                              .key = text_or_null(arguments[IMPORT_RULE_key])};
    return true;
}

// Parses the rules, and the files after them.
static bool parse_rules_and_files(int count, char *const *arguments, Task *task) {
    const uint64_t rules = task->number[IMPORT_ARGUMENT_rules];
    if (rules > DIP_MAX_MATERIAL_RULES) {
        return false;
    }
    task->rule_count = (int)rules;
    task->file_count = count - task->rule_count * (int)IMPORT_RULE_ARGUMENT_COUNT;
    if (task->file_count < 1 || task->file_count > DIP_MAX_MODEL_FILES) {
        return false;
    }
    for (int i = 0; i < task->rule_count; ++i) {
        if (!parse_rule(arguments + i * (int)IMPORT_RULE_ARGUMENT_COUNT, &task->rules[i])) {
            return false;
        }
    }
    for (int i = 0; i < task->file_count; ++i) {
        task->files[i] = arguments[count - task->file_count + i];
    }
    return true;
}

static bool parse_task(int count, char *const *arguments, Task *task) {
    if (count > 0 && strcmp(arguments[0], import_mark) == 0) {
        count--;
        arguments++;
    }
    if (count < IMPORT_ARGUMENT_COUNT + 1) {
        return false;
    }
    for (int i = 0; i < IMPORT_ARGUMENT_COUNT; ++i) {
        if (!parse_number(arguments[i], &task->number[i])) {
            return false;
        }
    }
    task->animation_name = arguments[IMPORT_ARGUMENT_COUNT];
    const uint64_t threads = task->number[IMPORT_ARGUMENT_threads];
    return task->number[IMPORT_ARGUMENT_version] == IMPORT_VERSION && threads >= 1 &&
           threads <= DIP_MAX_THREADS && task->number[IMPORT_ARGUMENT_up] < DIP_UP_COUNT &&
           task->number[IMPORT_ARGUMENT_animation] <= DIP_MODEL_ANIMATION_NAMED &&
           parse_rules_and_files(count - IMPORT_ARGUMENT_COUNT - 1,
                                 arguments + IMPORT_ARGUMENT_COUNT + 1, task);
}

// --- limits --------------------------------------------------------------------------------------

static void close_other_files(void) {
#ifdef SYS_close_range
    if (syscall(SYS_close_range, (unsigned)IMPORT_PIPE + 1, ~0u, 0) == 0) {
        return;
    }
#endif
    DIR *listing = opendir("/proc/self/fd");
    for (struct dirent *entry = listing ? readdir(listing) : NULL; entry;
         entry = readdir(listing)) {
        const int file = atoi(entry->d_name);
        if (file > IMPORT_PIPE && file != dirfd(listing)) {
            close(file);
        }
    }
    if (listing) {
        closedir(listing);
    }
}

// Sets both limits of a resource, or the highest that are allowed.
static bool limit(int resource, uint64_t soft, uint64_t hard) {
    struct rlimit now;
    if (getrlimit(resource, &now) != 0) {
        return false;
    }
    const rlim_t most = now.rlim_max;
    const rlim_t new_hard = hard < most ? (rlim_t)hard : most;
    const struct rlimit wanted = {.rlim_cur = soft < new_hard ? (rlim_t)soft : new_hard,
                                  .rlim_max = new_hard};
    return setrlimit(resource, &wanted) == 0;
}

// Limits the process. Processor time ends it by SIGXCPU, a second later by SIGKILL.
static bool limit_process(const Task *task) {
    const uint64_t cpu_s = task->number[IMPORT_ARGUMENT_cpu_s];
    const uint64_t memory = task->number[IMPORT_ARGUMENT_memory_bytes];
    const uint64_t space =
        memory + reserved_bytes + task->number[IMPORT_ARGUMENT_threads] * reserved_per_thread_bytes;
    signal(SIGINT, SIG_IGN);  // Ctrl-C is for the program; its end ends this process, too.
    signal(SIGXFSZ, SIG_IGN); // Writing beyond the limit fails with EFBIG.
    signal(SIGPIPE, SIG_IGN);
    close_other_files();
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && limit(RLIMIT_CORE, 0, 0) &&
           limit(RLIMIT_CPU, cpu_s, cpu_s + 1) && limit(RLIMIT_FSIZE, memory, memory) &&
           (IMPORT_IS_SANITIZED || limit(RLIMIT_AS, space, space));
}

// Lets this process end with the program. Returns false if the program has ended already.
static bool follow_program(const Task *task) {
    return prctl(PR_SET_PDEATHSIG, SIGKILL) == 0 &&
           (uint64_t)getppid() == task->number[IMPORT_ARGUMENT_program_id];
}

// --- loading -------------------------------------------------------------------------------------

// Seals the pack. Linux refuses with EBUSY while anything holds a page of the file for a moment,
// for example to move the page; so this function tries again.
static bool seal(void) {
    const int seals = F_SEAL_WRITE | F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL;
    const struct timespec pause = {.tv_nsec = SEAL_PAUSE_NS};
    for (int attempt = 1; fcntl(IMPORT_PACK_FILE, F_ADD_SEALS, seals) != 0; ++attempt) {
        if (errno != EBUSY || attempt == MAX_SEAL_ATTEMPTS) {
            return false;
        }
        nanosleep(&pause, NULL);
    }
    return true;
}

// Writes the pack and seals it. Then tells the program that the pack is complete, or why there is
// none. Returns false if there is none.
static bool hand_over(const DipModel *model, DipScenePack *pack) {
    if (model) {
        pack->scene = model->def;
        pack->times = model->times;
        pack->clips = model->clip_names;
        pack->clip_count = model->clip_count;
    }
    errno = 0;
    const bool done = dip_scene_pack_note(IMPORT_PACK_FILE, DIP_IMPORT_PACKS, 0) &&
                      dip_scene_pack_write(IMPORT_PACK_FILE, pack) && seal();
    const unsigned char failure = (unsigned char)(done ? 0 : errno ? errno : EIO);
    return write(IMPORT_PIPE, &failure, 1) == 1 && done;
}

// Returns the double whose bits an argument has.
static double double_of(const Task *task, ImportArgument argument) {
    double number;
    memcpy(&number, &task->number[argument], sizeof number);
    return number;
}

static bool load_and_hand_over(const Task *task) {
    DipScenePack pack = {0};
    DipPool *pool = dip_pool_create((int)task->number[IMPORT_ARGUMENT_threads], &pack.failure);
    const DipModelLoad load = {
        .files = task->files,
        .file_count = task->file_count,
        .options = {.normal_maps = task->number[IMPORT_ARGUMENT_normal_maps] == 1,
                    .up = (DipUpAxis)task->number[IMPORT_ARGUMENT_up],
                    .rules = task->rules,
                    .rule_count = task->rule_count,
                    .shading = task->number[IMPORT_ARGUMENT_flat] == 1 ? DIP_MODEL_SHADING_flat
                                                                       : DIP_MODEL_SHADING_auto,
                    .has_light_scale = task->number[IMPORT_ARGUMENT_has_light_scale] == 1,
                    .light_scale = double_of(task, IMPORT_ARGUMENT_light_scale),
                    .animation = (DipModelAnimation)task->number[IMPORT_ARGUMENT_animation],
                    .animation_name = task->animation_name,
                    .animation_is_held = task->number[IMPORT_ARGUMENT_animation_is_held] == 1,
                    .animation_held_s = double_of(task, IMPORT_ARGUMENT_animation_held_s)},
        .pool = pool,
        .warnings = &pack.warnings,
        .note_file = IMPORT_PACK_FILE,
        .picture_only = task->number[IMPORT_ARGUMENT_picture_only] == 1,
    };
    DipModel *model = pool ? dip_model_load_here(&load, &pack.failure) : NULL;
    const bool done = hand_over(model, &pack);
    dip_model_destroy(&model);
    dip_error_list_free(&pack.warnings);
    dip_pool_destroy(&pool);
    return done;
}

int dip_importer_run(int count, char *const *arguments) {
    Task task;
    if (!parse_task(count, arguments, &task) || fcntl(IMPORT_PACK_FILE, F_GET_SEALS) < 0) {
        return IMPORT_EXIT_ARGUMENTS;
    }
    if (!follow_program(&task)) {
        return IMPORT_EXIT_ORPHANED;
    }
    if (!limit_process(&task)) {
        return IMPORT_EXIT_LIMITS;
    }
    return load_and_hand_over(&task) ? IMPORT_EXIT_DONE : IMPORT_EXIT_NO_PACK;
}

#else

int dip_importer_run(int count, char *const *arguments) {
    (void)count;
    (void)arguments;
    return IMPORT_EXIT_ARGUMENTS;
}

#endif
