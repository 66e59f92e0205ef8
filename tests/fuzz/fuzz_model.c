// Fuzzes the import of model files, through the importer process. The first line of an input is the
// ending of the model's file name, the rest its content.
//
// The libraries that read models may crash or hang in the importer; that ends only the importer,
// and the load fails with a message. A finding is a crash of the program, a result of the importer
// that the program must refuse, or a report of a sanitizer about Diptych's own code in the
// importer.
#define _GNU_SOURCE // memfd_create
#include "assets/importer.h"
#include "tests/assets/same_scene.h"
#include "tests/fuzz/fuzz.h"

#include <ctype.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

enum {
    PIPE_FILE = 4, // The pipe that the importer inherits (assets/importer_private.h).
    COVERAGE_FILE = 200,
    COVERAGE_BYTES = 1 << 16,
    REPORT_EXIT_CODE = 86
};

// --- coverage ------------------------------------------------------------------------------------

#ifdef FUZZ_WITH_LIBFUZZER
// libFuzzer guides its search by counters of the code's edges. The importer's counters are handed
// to the program through a shared file, and to libFuzzer as these extra counters.
__attribute__((section("__libfuzzer_extra_counters"))) static uint8_t extra[COVERAGE_BYTES];
static uint8_t *counters_begin;
static uint8_t *counters_end;
static uint8_t *shared;
static bool is_importer;

static void map_shared(void) {
    shared = mmap(NULL, COVERAGE_BYTES, PROT_READ | PROT_WRITE, MAP_SHARED, COVERAGE_FILE, 0);
    FUZZ_CHECK(shared != MAP_FAILED);
}

static void enter_importer(void) {
    map_shared();
    is_importer = true;
}

static void make_shared(void) {
    const int file = memfd_create("coverage", 0);
    FUZZ_CHECK(file >= 0 && ftruncate(file, COVERAGE_BYTES) == 0);
    FUZZ_CHECK(dup2(file, COVERAGE_FILE) == COVERAGE_FILE);
    close(file);
    map_shared();
}

// The linker directs all calls of the function __sanitizer_cov_8bit_counters_init here, which
// registers the counters before main begins.
void __real___sanitizer_cov_8bit_counters_init(uint8_t *begin, uint8_t *end);
void __wrap___sanitizer_cov_8bit_counters_init(uint8_t *begin, uint8_t *end);
void __wrap___sanitizer_cov_8bit_counters_init(uint8_t *begin, uint8_t *end) {
    counters_begin = begin;
    counters_end = end;
    __real___sanitizer_cov_8bit_counters_init(begin, end);
}

// The linker directs all calls of write here. The importer's last action is to write to its pipe;
// then the program may end it.
ssize_t __real_write(int file, const void *bytes, size_t size_bytes);
ssize_t __wrap_write(int file, const void *bytes, size_t size_bytes);
ssize_t __wrap_write(int file, const void *bytes, size_t size_bytes) {
    if (file == PIPE_FILE && is_importer) {
        const size_t count = (size_t)(counters_end - counters_begin);
        memcpy(shared, counters_begin, count < COVERAGE_BYTES ? count : COVERAGE_BYTES);
    }
    return __real_write(file, bytes, size_bytes);
}

static void take_coverage(void) {
    memcpy(extra, shared, COVERAGE_BYTES);
    memset(shared, 0, COVERAGE_BYTES);
}
#else
static void enter_importer(void) {
}
static void make_shared(void) {
}
static void take_coverage(void) {
}
#endif

// --- the importer --------------------------------------------------------------------------------

// In the importer, this function does not return. In the program, it says where and how the
// sanitizers of the importer report.
int LLVMFuzzerInitialize(int *argc, char ***argv) {
    if (*argc > 2 && strcmp((*argv)[1], "import") == 0) {
        enter_importer();
        _exit(dip_importer_run(*argc - 2, *argv + 2));
    }
    char options[1200];
    snprintf(options, sizeof options,
             "exitcode=%d:log_path=%s:detect_leaks=0:allocator_may_return_null=1:"
             "max_allocation_size_mb=1024:hard_rss_limit_mb=2048:"
             "external_symbolizer_path=/usr/bin/llvm-symbolizer",
             REPORT_EXIT_CODE, fuzz_path("report"));
    setenv("ASAN_OPTIONS", options, 1);
    make_shared();
    return 0;
}

// Finds the report that the importer's sanitizers wrote, prints it, and removes it. Returns true if
// the innermost function that it names is Diptych's own.
static bool is_own_fault(void) {
    char command[1200];
    static char report[1 << 16];
    snprintf(command, sizeof command, "cat %s.* 2>/dev/null; rm -f %s.*", fuzz_path("report"),
             fuzz_path("report"));
    FILE *pipe = popen(command, "r");
    FUZZ_CHECK(pipe != NULL);
    const size_t length = fread(report, 1, sizeof report - 1, pipe);
    pclose(pipe);
    report[length] = '\0';
    static const char *const libraries[] = {"libassimp", "libdraco", "libmeshoptimizer", "libwebp"};
    const char *library = NULL;
    for (size_t i = 0; i < sizeof libraries / sizeof *libraries; ++i) {
        const char *found = strstr(report, libraries[i]);
        library = found && (!library || found < library) ? found : library;
    }
    const char *own = strstr(report, "/assets/");
    const char *renderer = strstr(report, "/renderer/");
    own = !own || (renderer && renderer < own) ? renderer : own;
    const bool is_own = own && (!library || own < library);
    if (is_own) {
        fputs(report, stderr);
    }
    return is_own;
}

// --- the check -----------------------------------------------------------------------------------

// Splits the input. Returns NULL if it does not begin with the ending of a file name.
static const uint8_t *split(const uint8_t *bytes, size_t size_bytes, char ending[16]) {
    const uint8_t *newline = memchr(bytes, '\n', size_bytes < 15 ? size_bytes : 15);
    size_t length = newline ? (size_t)(newline - bytes) : 0;
    for (size_t i = 0; i < length; i++) {
        if (!isalnum(bytes[i])) {
            return NULL;
        }
    }
    memcpy(ending, bytes, length);
    ending[length] = '\0';
    return length > 0 ? newline + 1 : NULL;
}

static void check_accepted(const DipModel *model) {
    const DipSceneDef *def = dip_model_scene_def(model);
    read_whole_scene(def);
    DipError err = {0};
    DipScene *scene = dip_scene_create(def, NULL, &err);
    FUZZ_CHECK(scene || (err.code != DIP_ERROR_NONE && err.message[0]));
    dip_scene_destroy(&scene);
}

// The messages quote the file, so only their beginning is Diptych's own.
static bool begins(const DipError *err, const char *text) {
    return strncmp(err->message, text, strlen(text)) == 0;
}

static void check_refused(const DipError *err) {
    FUZZ_CHECK(err->code != DIP_ERROR_NONE && err->message[0] && err->file[0]);
    FUZZ_CHECK(!strchr(err->message, '\n'));
    FUZZ_CHECK(!begins(err, "cannot start the importer"));
    FUZZ_CHECK(!begins(err, "the importer's result is"));
    if (begins(err, "the importer ended")) {
        FUZZ_CHECK(!is_own_fault());
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size_bytes) {
    static const DipImporter importer = {
        .program = "/proc/self/exe", .command = "import", .wall_s = 10, .cpu_s = 1};
    const DipModelOptions options = {
        .normal_maps = true, .importer = &importer, .animation = DIP_MODEL_ANIMATION_FIRST};
    char ending[16];
    char name[32];
    const uint8_t *content = size_bytes > 0 ? split(bytes, size_bytes, ending) : NULL;
    if (!content) {
        return -1;
    }
    snprintf(name, sizeof name, "model.%s", ending);
    const char *file = fuzz_write(name, content, (size_t)(bytes + size_bytes - content));
    DipErrorList warnings = {0};
    DipError err = {0};
    DipModel *model = dip_model_load_with(&file, 1, &options, NULL, &warnings, &err);
    take_coverage();
    if (model) {
        check_accepted(model);
    } else {
        check_refused(&err);
    }
    dip_model_destroy(&model);
    dip_error_list_free(&warnings);
    remove(file);
    return 0;
}
