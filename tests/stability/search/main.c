// Searches for scenes that Diptych draws wrongly: makes random adversarial scenes, checks them, and
// replays and shrinks those that fail.
#include "tests/stability/search/shrink.h"

#include "tests/stability/search/save_pictures.h"

#include <inttypes.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *const usage =
    "Usage: stability_search [OPTION]... [FILE]...\n"
    "Checks the scenes of the files, and then random scenes, against the reference and against\n"
    "invariances. A file holds the choices from which a scene is made. Exit code: 0 if every "
    "scene\n"
    "is right, 1 if one is not, 2 for a wrong option.\n"
    "\n"
    "  --count N         Number of random scenes. The default is 0.\n"
    "  --seed S          Seed of the random scenes. The default is 1.\n"
    "  --mirrored        Let random scenes have mirrored textures, too. Without this option, SEED "
    "and\n"
    "                    INDEX stand for the same scenes as before there were any.\n"
    "  --known FILE      A file with the random scenes that are known to be wrong, one SEED:INDEX\n"
    "                    at the beginning of each line. No other one may be wrong, and all of "
    "them\n"
    "                    that are checked must be.\n"
    "  --replay WHAT     Check one scene again and describe it. WHAT is SEED:INDEX or a file.\n"
    "  --shrink WHAT     Shrink a failing scene, describe it and write its choices to a file.\n"
    "  --save FILE       The file that --shrink or --replay writes the choices to.\n"
    "                    The default for --shrink is shrunk.txt.\n"
    "  --pictures NAME   With --replay or --shrink, write NAME_fast.ppm, NAME_reference.ppm and\n"
    "                    NAME_difference.ppm (16 times the difference in linear light).\n"
    "  --threads N       Threads of the check that compares thread counts. The default is 3.\n";

typedef struct Options {
    int count;
    const char *known;
    uint64_t seed;
    bool mirrored;
    const char *replay;
    const char *shrink;
    const char *save;
    const char *pictures;
    int threads;
    char **files;
    int file_count;
} Options;

// --- crashes -------------------------------------------------------------------------------------

static char crash_message[256];

static void tell_crash(int signal_number) {
    const ssize_t written = write(2, crash_message, strlen(crash_message));
    (void)written;
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

static void catch_crashes(void) {
    static const int signals[] = {SIGSEGV, SIGABRT, SIGFPE, SIGILL};
    for (size_t i = 0; i < sizeof signals / sizeof *signals; i++) {
        signal(signals[i], tell_crash);
    }
}

// --- scenes --------------------------------------------------------------------------------------

// Draws new choices for the scene with this index.
static void choose_scene(Choices *choices, uint64_t seed, uint64_t index, bool mirrored) {
    static SearchScene scene;
    Random random = {seed ^ index * 0xd1342543de82ef95u};
    choices_begin(choices, random_u64(&random));
    choices->mirrored = mirrored;
    search_scene_make(&scene, choices);
    dip_test_scene_free(&scene.scene);
    choices_rewind(choices);
}

static bool report(const char *what, bool mirrored, const SearchFinding *finding) {
    if (finding->check) {
        printf("%s: %s: %s\n  replay: stability_search%s --replay %s\n", what, finding->check,
               finding->text, mirrored ? " --mirrored" : "", what);
        fflush(stdout);
    }
    return finding->check == NULL;
}

static bool check(const SearchBench *bench, Choices *choices, const char *what) {
    SearchFinding finding;
    snprintf(crash_message, sizeof crash_message,
             "\nstability_search: crashed; replay: stability_search --replay %s\n", what);
    search_check(bench, choices, NULL, &finding);
    return report(what, choices->mirrored, &finding);
}

// Reads the list of --known into a text that begins and ends with a line break. Returns NULL if it
// cannot be read.
static char *read_known(const char *file) {
    enum { ROOM = 1 << 16 };
    FILE *in = file ? fopen(file, "r") : NULL;
    char *text = calloc(ROOM, 1);
    if (!text || (file && !in)) {
        fprintf(stderr, "stability_search: %s cannot be read\n", file ? file : "the list");
        free(text);
        return NULL;
    }
    text[0] = '\n';
    const size_t size = in ? fread(text + 1, 1, ROOM - 3, in) : 0;
    text[size + 1] = '\n';
    if (in) {
        fclose(in);
    }
    return text;
}

// Whether a list has a line that begins with this scene.
static bool is_known(const char *known, const char *scene) {
    char begin[80];
    const int length = snprintf(begin, sizeof begin, "\n%s", scene);
    const char *at = strstr(known, begin);
    while (at && at[length] != ' ' && at[length] != '\n') {
        at = strstr(at + 1, begin);
    }
    return at != NULL;
}

static int search(const SearchBench *bench, const Options *options) {
    static Choices choices;
    int failures = 0;
    int unknown = 0; // Wrong scenes that are not in the list.
    int failed_files = 0;
    char *known = read_known(options->known);
    if (!known) {
        return 2;
    }
    for (int i = 0; i < options->file_count; i++) {
        if (!choices_load(&choices, options->files[i])) {
            fprintf(stderr, "stability_search: %s is no file of choices\n", options->files[i]);
            free(known);
            return 2;
        }
        failed_files += !check(bench, &choices, options->files[i]);
    }
    for (int i = 0; i < options->count; i++) {
        char what[64];
        snprintf(what, sizeof what, "%" PRIu64 ":%d", options->seed, i);
        choose_scene(&choices, options->seed, (uint64_t)i, options->mirrored);
        const bool wrong = !check(bench, &choices, what);
        failures += wrong;
        const bool listed = is_known(known, what);
        unknown += wrong && !listed;
        if (listed && !wrong) {
            printf("%s: right now, but listed as wrong\n", what);
        }
        if ((i + 1) % 500 == 0) {
            printf("%d of %d scenes, %d wrong\n", i + 1, options->count, failures);
            fflush(stdout);
        }
    }
    printf("seed %" PRIu64 ": %d of %d scenes wrong, %d not known; %d of %d files wrong\n",
           options->seed, failures, options->count, unknown, failed_files, options->file_count);
    free(known);
    return unknown > 0 || failed_files > 0;
}

// --- one scene -----------------------------------------------------------------------------------

// Loads the choices of SEED:INDEX or of a file.
static bool load(Choices *choices, const char *what, bool mirrored) {
    char *colon = NULL;
    const uint64_t seed = strtoull(what, &colon, 10);
    if (colon == what || (*colon != ':' && *colon != '\0')) {
        return choices_load(choices, what);
    }
    char *end = colon;
    const uint64_t index = *colon == ':' ? strtoull(colon + 1, &end, 10) : 0;
    choose_scene(choices, seed, index, mirrored);
    return *end == '\0';
}

static void describe(Choices *choices) {
    static SearchScene scene;
    choices_rewind(choices);
    search_scene_make(&scene, choices);
    search_scene_describe(&scene, stdout);
    dip_test_scene_free(&scene.scene);
}

// Writes the choices to a file whose comment says what is wrong with the scene.
static bool save(const Choices *choices, const SearchFinding *finding, const char *file) {
    char comment[640];
    snprintf(comment, sizeof comment, "# %s: %s", finding->check ? finding->check : "right",
             finding->text);
    if (!choices_save(choices, file, comment)) {
        fprintf(stderr, "stability_search: cannot write %s\n", file);
        return false;
    }
    printf("replay: stability_search --replay %s\n", file);
    return true;
}

static int treat_one(const SearchBench *bench, const Options *options) {
    static Choices choices;
    const char *what = options->shrink ? options->shrink : options->replay;
    SearchFinding finding;
    if (!load(&choices, what, options->mirrored)) {
        fprintf(stderr, "stability_search: %s is no file of choices and no SEED:INDEX\n", what);
        return 2;
    }
    search_check(bench, &choices, NULL, &finding);
    if (options->shrink && finding.check) {
        search_shrink(bench, &choices, &finding);
    }
    describe(&choices);
    printf("%s: %s\n", finding.check ? finding.check : "right", finding.text);
    const char *file = options->save                      ? options->save
                       : options->shrink && finding.check ? "shrunk.txt"
                                                          : NULL;
    const bool saved = !file || save(&choices, &finding, file);
    const bool drawn =
        !options->pictures || search_save_pictures(bench, &choices, options->pictures);
    return finding.check != NULL || !saved || !drawn;
}

// --- options -------------------------------------------------------------------------------------

static bool parse_number(const char *text, uint64_t most, uint64_t *number) {
    char *end = NULL;
    *number = strtoull(text, &end, 10);
    return *text >= '0' && *text <= '9' && !*end && *number <= most;
}

static bool parse_value(const char *name, const char *value, Options *options) {
    uint64_t number = 0;
    if (strcmp(name, "--count") == 0) {
        const bool good = parse_number(value, INT32_MAX, &number);
        options->count = (int)number;
        return good;
    }
    if (strcmp(name, "--seed") == 0) {
        return parse_number(value, UINT64_MAX, &options->seed);
    }
    if (strcmp(name, "--threads") == 0) {
        const bool good = parse_number(value, DIP_MAX_THREADS, &number);
        options->threads = (int)number;
        return good && number > 0;
    }
    const struct {
        const char *name;
        const char **value;
    } texts[] = {{"--known", &options->known},
                 {"--replay", &options->replay},
                 {"--shrink", &options->shrink},
                 {"--save", &options->save},
                 {"--pictures", &options->pictures}};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        if (strcmp(name, texts[i].name) == 0) {
            *texts[i].value = value;
            return true;
        }
    }
    return false;
}

static bool parse_options(int argc, char **argv, Options *options) {
    *options = (Options){.seed = 1, .threads = 3};
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0) {
            fputs(usage, stdout);
            exit(0);
        }
        if (strcmp(argv[i], "--mirrored") == 0) {
            options->mirrored = true;
            continue;
        }
        if (argv[i][0] != '-') {
            options->files = argv + i;
            options->file_count = argc - i;
            return true;
        }
        if (i + 1 >= argc || !parse_value(argv[i], argv[i + 1], options)) {
            fprintf(stderr,
                    "stability_search: %s is no option, or its value is missing or wrong\n%s",
                    argv[i], usage);
            return false;
        }
        i++;
    }
    return true;
}

int main(int argc, char **argv) {
    Options options;
    if (!parse_options(argc, argv, &options)) {
        return 2;
    }
    catch_crashes();
    DipError err = {0};
    SearchBench bench = {dip_pool_create(1, &err), dip_pool_create(options.threads, &err)};
    int code = 1;
    if (bench.pool_of_one && bench.pool_of_many) {
        code = options.replay || options.shrink ? treat_one(&bench, &options)
                                                : search(&bench, &options);
    } else {
        fprintf(stderr, "stability_search: %s\n", err.message);
    }
    dip_pool_destroy(&bench.pool_of_one);
    dip_pool_destroy(&bench.pool_of_many);
    return code;
}
