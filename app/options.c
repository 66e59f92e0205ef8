// Parsing the command line and printing help from the same table.
#include "app/options_private.h"

#include "renderer/base/assert.h"
#include "renderer/base/clock.h"
#include "renderer/base/nearest.h"
#include "renderer/base/number.h"
#include "renderer/scene/renderer.h"

#include <string.h>

// Commands an option belongs to, as bits.
enum {
    PREVIEW = 1 << DIP_COMMAND_PREVIEW,
    DUMP = 1 << DIP_COMMAND_DUMP,
    PANES = PREVIEW | DUMP, // those that draw two panes
    BENCH = 1 << DIP_COMMAND_BENCH,
    COST = 1 << DIP_COMMAND_COST,
    MERGE = 1 << DIP_COMMAND_COST_MERGE,
    ASSETS = 1 << DIP_COMMAND_COST_ASSETS,
    SCENE = PANES | BENCH | COST | ASSETS, // those that draw, or load what is drawn
    ALL = (1 << DIP_COMMAND_COUNT) - 1,
    MAX_FRAME = 1000000
};

typedef struct OptionRow {
    const char *name;
    const char *argument; // NULL: takes none
    unsigned commands;
    DipOptionSetter *set;
    const char *text;
} OptionRow;

bool dip_option_refuse(DipError *err, DipErrorCode code, const char *key, const char *value,
                       const char *accepted) {
    return dip_error_set(err, code, NULL, 0, key, "'%s', accepted %s", value, accepted);
}

static bool set_config(DipOptions *options, const char *key, const char *value, DipError *err) {
    (void)key;
    (void)err;
    options->config = value;
    return true;
}

static bool set_log(DipOptions *options, const char *key, const char *value, DipError *err) {
    (void)key;
    (void)err;
    options->log = value;
    return true;
}

static bool set_path(DipOptions *options, const char *key, const char *value, DipError *err) {
    (void)key;
    (void)err;
    options->path = value;
    return true;
}

static bool set_category(DipOptions *options, const char *key, const char *value, DipError *err) {
    (void)key;
    (void)err;
    options->category = value;
    return true;
}

static bool set_cost_report(DipOptions *options, const char *key, const char *value,
                            DipError *err) {
    (void)key;
    (void)err;
    options->cost_report = value;
    return true;
}

static bool set_out(DipOptions *options, const char *key, const char *value, DipError *err) {
    (void)key;
    (void)err;
    options->out = value;
    return true;
}

static bool set_json(DipOptions *options, const char *key, const char *value, DipError *err) {
    (void)key;
    (void)err;
    options->json = value;
    return true;
}

static bool set_hash(DipOptions *options, const char *key, const char *value, DipError *err) {
    (void)key;
    (void)value;
    (void)err;
    options->hash = true;
    return true;
}

static bool set_timing(DipOptions *options, const char *key, const char *value, DipError *err) {
    (void)key;
    (void)value;
    (void)err;
    options->timing = true;
    return true;
}

static bool set_force_all_effects(DipOptions *options, const char *key, const char *value,
                                  DipError *err) {
    (void)key;
    (void)value;
    (void)err;
    options->force_all_effects = true;
    return true;
}

static bool set_help(DipOptions *options, const char *key, const char *value, DipError *err) {
    (void)key;
    (void)value;
    (void)err;
    options->help = true;
    return true;
}

static bool set_version(DipOptions *options, const char *key, const char *value, DipError *err) {
    (void)key;
    (void)value;
    (void)err;
    options->version = true;
    return true;
}

static bool set_threads(DipOptions *options, const char *key, const char *value, DipError *err) {
    options->has_threads = true;
    return (dip_integer_parse(value, strlen(value), &options->threads) && options->threads >= 0 &&
            options->threads <= DIP_MAX_THREADS) ||
           dip_option_refuse(err, DIP_ERROR_RANGE, key, value, "1..256, or 0 for all processors");
}

bool dip_option_isa(const char *key, const char *value, DipIsa *isa, DipError *err) {
    char accepted[96] = "auto";
    for (int i = 0; i < DIP_ISA_COUNT; i++) {
        if (dip_isa_available((DipIsa)i)) {
            strcat(strcat(accepted, "|"), dip_isa_name((DipIsa)i));
        }
    }
    if (strcmp(value, "auto") == 0) {
        *isa = dip_isa_best();
        return true;
    }
    if (!dip_isa_parse(value, isa)) {
        return dip_option_refuse(err, DIP_ERROR_UNKNOWN, key, value, accepted);
    }
    return dip_isa_available(*isa) ||
           dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, key,
                         "'%s' is not available on this machine, accepted %s", value, accepted);
}

static bool set_isa(DipOptions *options, const char *key, const char *value, DipError *err) {
    options->has_isa = strcmp(value, "auto") != 0;
    return dip_option_isa(key, value, &options->isa, err);
}

static bool set_model(DipOptions *options, const char *key, const char *value, DipError *err) {
    if (options->model_count == DIP_MAX_OPTION_MODELS) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, key, "more than %d files, accepted %d",
                             DIP_MAX_OPTION_MODELS, DIP_MAX_OPTION_MODELS);
    }
    options->models[options->model_count++] = value;
    return true;
}

static bool set_current(DipOptions *options, const char *key, const char *value, DipError *err) {
    (void)key;
    options->has_current = true;
    return dip_quality_parse(value, &options->current, err);
}

static bool set_requested(DipOptions *options, const char *key, const char *value, DipError *err) {
    (void)key;
    options->has_requested = true;
    return dip_quality_parse(value, &options->requested, err);
}

int dip_option_integers(const char *text, char separator, int count, int *values) {
    int found = 0;
    for (;;) {
        const char *end = strchr(text, separator);
        const size_t length = end ? (size_t)(end - text) : strlen(text);
        if (found == count || !dip_integer_parse(text, length, &values[found])) {
            return 0;
        }
        found++;
        if (!end) {
            return found;
        }
        text = end + 1;
    }
}

bool dip_option_size(const char *key, const char *value, int *width, int *height, DipError *err) {
    int size[2];
    if (dip_option_integers(value, 'x', 2, size) != 2 || size[0] < 1 || size[1] < 1 ||
        size[0] > DIP_MAX_FRAME_SIZE || size[1] > DIP_MAX_FRAME_SIZE) {
        return dip_option_refuse(err, DIP_ERROR_RANGE, key, value,
                                 "WIDTHxHEIGHT of 1..8192 pixels each");
    }
    *width = size[0];
    *height = size[1];
    return true;
}

static bool set_size(DipOptions *options, const char *key, const char *value, DipError *err) {
    options->has_size = true;
    return dip_option_size(key, value, &options->width, &options->height, err);
}

static bool set_frames(DipOptions *options, const char *key, const char *value, DipError *err) {
    int range[3] = {0, 0, 1};
    if (dip_option_integers(value, ':', 3, range) < 2 || range[0] < 0 || range[1] <= range[0] ||
        range[1] > MAX_FRAME || range[2] < 1) {
        return dip_option_refuse(
            err, DIP_ERROR_RANGE, key, value,
            "FIRST:END or FIRST:END:STEP with 0 <= FIRST < END <= 1000000, STEP >= 1");
    }
    options->first_frame = range[0];
    options->end_frame = range[1];
    options->frame_step = range[2];
    return true;
}

static bool set_fps(DipOptions *options, const char *key, const char *value, DipError *err) {
    double fps;
    if (!dip_number_parse(value, strlen(value), &fps) || fps < 0.001 || fps > 1000.0) {
        return dip_option_refuse(err, DIP_ERROR_RANGE, key, value,
                                 "frames per second, 0.001..1000");
    }
    options->fps_milli = (int64_t)(fps * 1000.0 + 0.5);
    return true;
}

static const OptionRow rows[] = {
    {"--config", "FILE", SCENE, set_config, "the ini to read (default: the shipped courtyard)"},
    {"--model", "FILE", SCENE, set_model,
     "a model instead of the ini's, any format assimp reads; may be repeated"},
    {"--path", "FILE", PANES | BENCH | COST, set_path,
     "a camera path (.pth, .bth) instead of the ini's, with CAMPATH_DEFAULT_FOV"},
    {"--category", "NAME", PANES | BENCH, set_category,
     "which of the ini's paths to fly: DEFAULT, AA, AF, AAA, MIPLOD, WATER, ..."},
    {"--current", "SET", PANES, set_current,
     "settings of the left pane, such as aa=none (default: the ini's)"},
    {"--requested", "SET", PANES, set_requested,
     "settings of the right pane, such as aa=4,af=16 (likewise)"},
    {"--size", "WxH", PANES | COST, set_size, "pixels of each pane (default: the ini's RES)"},
    {"--cost", "FILE", PREVIEW, set_cost_report,
     "the cost.json of a `diptych cost` on this scene: what settings cost, and advice"},
    {"--frames", "A:B[:S]", DUMP, set_frames,
     "frames A up to, not including, B, every S-th (default 0:1)"},
    {"--fps", "N", DUMP, set_fps, "frame n shows time n / N seconds (default 30)"},
    {"--out", "DIR", DUMP, set_out,
     "write current_0000.png, requested_0000.png, ... and frames.json there"},
    {"--json", "FILE", DUMP, set_json, "write the record of all frames there"},
    {"--hash", NULL, DUMP, set_hash, "print a line per frame and pane: 0000 current HASH"},
    {"--threads", "N", PANES | COST | ASSETS, set_threads,
     "worker threads (default: all processors)"},
    {"--isa", "NAME", PANES | COST, set_isa,
     "auto, scalar, sse2, avx2, avx512: the same picture each"},
    {"--sets", "LIST", BENCH, dip_bench_set_sets,
     "settings to measure, SET;SET;... in quotes (default: aa none, 4, 8, without and with af=16)"},
    {"--size", "LIST", BENCH, dip_bench_set_size, "WxH,WxH,... pixels (default: the ini's RES)"},
    {"--grid", "LIST", BENCH, dip_bench_set_grid,
     "instead of a scene, reliefs of N,N,... triangles that fill the picture"},
    {"--grid-out-of-view", NULL, BENCH, dip_bench_set_grid_out_of_view,
     "the camera has its back to the grid: the cost of what is not seen"},
    {"--threads", "LIST", BENCH, dip_bench_set_threads,
     "worker threads, such as 1,2 (default: the ini's; 0: all processors)"},
    {"--isa", "LIST", BENCH, dip_bench_set_isa,
     "of auto, scalar, sse2, avx2, avx512 (default: the best here)"},
    {"--frames", "N", BENCH, dip_bench_set_frames,
     "frames that divide the camera path evenly (default 12)"},
    {"--rounds", "N", BENCH, dip_bench_set_rounds,
     "how often each combination draws them (default 10)"},
    {"--seed", "N", BENCH, dip_bench_set_seed, "of the order in the rounds (default: the clock's)"},
    {"--vs", "PROGRAM", BENCH, dip_bench_set_vs,
     "another build of diptych: measure both in turn, print the ratio other / this"},
    {"--csv", "FILE", BENCH, dip_bench_set_csv, "write every frame of every round there"},
    {"--svg", "DIR", BENCH, dip_bench_set_svg,
     "plot time against pixels, samples, triangles, threads there"},
    {"--serve", NULL, BENCH, dip_bench_set_serve,
     "draw what standard input asks for: what --vs starts"},
    {"--out", "DIR", COST | MERGE, set_out,
     "write cost.json, cost.csv and cost.html there; an interrupted run goes on there"},
    {"--baseline", "SET", COST, dip_cost_set_baseline,
     "what every step is set in and measured against (default: all settings' defaults)"},
    {"--combine", "LIST", COST, dip_cost_set_combine,
     "measure every combination of these settings' steps, too; or none (default: aa,af)"},
    {"--budget-ms", "LIST", COST, dip_cost_set_budget,
     "advise the least error within so many ms per frame, such as 8,16.6; combines "
     "aa,aaa,asd,af,aaf"},
    {"--places", "N", COST, dip_cost_set_places,
     "places of each path where errors are measured (default 3)"},
    {"--burst", "N", COST, dip_cost_set_burst,
     "frames in a row at each place, for flicker (default 2)"},
    {"--samples", "N", COST, dip_cost_set_samples,
     "per pixel of each of the truth's two halves, a square (default 64)"},
    {"--pixels-per-degree", "X", COST, dip_cost_set_pixels_per_degree,
     "of the screen FLIP looks at (default 67.02: 3840 pixels on 0.7 m, from 0.7 m)"},
    {"--rounds", "N", COST, dip_cost_set_rounds, "how often times are taken (default 16)"},
    {"--timed", "N", COST, dip_cost_set_timed,
     "frames along the path that are timed in each round (default 4)"},
    {"--seed", "N", COST, dip_cost_set_seed, "of the order in the rounds (default: the clock's)"},
    {"--part", "A:B", COST, dip_cost_set_part,
     "errors only at places A up to, not including, B: one machine's share"},
    {"--errors-only", NULL, COST, dip_cost_set_errors_only, "take no times"},
    {"--cache", "DIR", COST, dip_cost_set_cache,
     "keep truths there (default: $XDG_CACHE_HOME/diptych or ~/.cache/diptych)"},
    {"--force-all-effects", NULL, SCENE, set_force_all_effects,
     "also run effects where they cannot be seen: the same picture, at a greater cost"},
    {"--timing", NULL, PANES, set_timing,
     "at the end say how long start and end took, and the most memory that was used"},
    {"--log", "FILE", SCENE, set_log, "also write warnings and errors there"},
    {"--help", NULL, ALL, set_help, "this help; after a command, help on it"},
    {"--version", NULL, ALL, set_version, "the version"},
};

static const struct {
    const char *typed;
    const char *text;
} commands[DIP_COMMAND_COUNT] = {
#define COMMAND_ROW(NAME, typed, text) {typed, text},
    DIP_COMMAND_LIST(COMMAND_ROW)
#undef COMMAND_ROW
};

// Of rows of one name the command's own.
static const OptionRow *find_row(const char *name, size_t length, DipCommand command) {
    const OptionRow *found = NULL;
    for (size_t i = 0; i < DIP_ARRAY_COUNT(rows); i++) {
        if (strlen(rows[i].name) == length && memcmp(rows[i].name, name, length) == 0 &&
            (!found || rows[i].commands >> command & 1)) {
            found = &rows[i];
        }
    }
    return found;
}

static bool unknown_option(const char *name, DipError *err) {
    const char *names[DIP_ARRAY_COUNT(rows)];
    for (size_t i = 0; i < DIP_ARRAY_COUNT(rows); i++) {
        names[i] = rows[i].name;
    }
    return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, name,
                         "no such option, nearest %s; --help lists them",
                         dip_nearest_name(name, names, DIP_ARRAY_COUNT(names)));
}

// One option, with its value as "--name value" or "--name=value".
static bool parse_option(int argc, char *const *argv, int *index, DipOptions *options,
                         DipError *err) {
    const char *argument = argv[*index];
    const char *equals = strchr(argument, '=');
    const size_t length = equals ? (size_t)(equals - argument) : strlen(argument);
    const OptionRow *row = strcmp(argument, "-h") == 0
                               ? find_row("--help", 6, options->command)
                               : find_row(argument, length, options->command);
    if (!row) {
        return unknown_option(argument, err);
    }
    if (!(row->commands >> options->command & 1)) {
        return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, row->name,
                             "is no option of `diptych %s`; its --help lists them",
                             commands[options->command].typed);
    }
    if (!row->argument) {
        return equals ? dip_error_set(err, DIP_ERROR_TYPE, NULL, 0, row->name, "takes no value")
                      : row->set(options, row->name, NULL, err);
    }
    const char *value = equals ? equals + 1 : *index + 1 < argc ? argv[++*index] : NULL;
    if (!value || !*value) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, row->name, "no value, accepted %s %s",
                             row->name, row->argument);
    }
    return row->set(options, row->name, value, err);
}

static bool unknown_command(const char *word, DipError *err) {
    static const char *const names[] = {"preview", "dump", "bench", "cost", "path"};
    return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, word,
                         "no such command, nearest %s; --help lists them, and a model of this name "
                         "is opened as ./%s",
                         dip_nearest_name(word, names, DIP_ARRAY_COUNT(names)), word);
}

// "cost merge", "cost assets": a second word that makes another command of the first.
static void take_second_word(int argc, char *const *argv, int *index, DipOptions *options) {
    const char *first = commands[options->command].typed;
    for (int c = 0; c < DIP_COMMAND_COUNT && argc > 2; c++) {
        const char *typed = commands[c].typed;
        const size_t length = strlen(first);
        if (strncmp(typed, first, length) == 0 && typed[length] == ' ' &&
            strcmp(typed + length + 1, argv[2]) == 0) {
            options->command = (DipCommand)c;
            *index = 3;
            return;
        }
    }
}

// Takes the command's words off the front; without one it is the preview.
static bool parse_command(int argc, char *const *argv, int *index, DipOptions *options,
                          DipError *err) {
    options->command = DIP_COMMAND_PREVIEW;
    if (argc < 2) {
        return true;
    }
    if (strcmp(argv[1], "path") == 0) {
        const char *word = argc > 2 ? argv[2] : "";
        if (strcmp(word, "info") == 0 || strcmp(word, "convert") == 0) {
            options->command = *word == 'i' ? DIP_COMMAND_PATH_INFO : DIP_COMMAND_PATH_CONVERT;
            *index = 3;
            return true;
        }
        if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0) {
            options->command = DIP_COMMAND_PATH_INFO;
            *index = 2;
            return true;
        }
        return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, "path", "%s%s%s, accepted %s",
                             *word ? "'" : "", *word ? word : "nothing to do", *word ? "'" : "",
                             "path info FILE, path convert IN OUT");
    }
    for (int c = 0; c < DIP_COMMAND_PATH_INFO; c++) {
        if (strcmp(argv[1], commands[c].typed) == 0) {
            options->command = (DipCommand)c;
            *index = 2;
            take_second_word(argc, argv, index, options);
            return true;
        }
    }
    // A bare word that cannot be a file's name with an ending or a folder is a mistyped command.
    if (argv[1][0] != '-' && !strpbrk(argv[1], "./\\")) {
        return unknown_command(argv[1], err);
    }
    return true;
}

static bool parse_operand(DipOptions *options, const char *operand, DipError *err) {
    switch (options->command) {
    case DIP_COMMAND_PREVIEW:
        return set_model(options, operand, operand, err);
    case DIP_COMMAND_COST_MERGE:
        if (options->cost.part_count < DIP_COST_MAX_PARTS) {
            options->cost.parts[options->cost.part_count++] = operand;
            return true;
        }
        break;
    case DIP_COMMAND_PATH_INFO:
    case DIP_COMMAND_PATH_CONVERT:
        if (options->operand_count <
            (options->command == DIP_COMMAND_PATH_INFO ? 1 : DIP_MAX_OPERANDS)) {
            options->operands[options->operand_count++] = operand;
            return true;
        }
        break;
    default:
        break;
    }
    return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, operand,
                         "one argument too many for `diptych %s`",
                         commands[options->command].typed);
}

static bool check_complete(const DipOptions *options, DipError *err) {
    if (options->help || options->version) {
        return true;
    }
    if (options->category && (options->path || options->model_count)) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "--category",
                             "'%s' is one of the ini's paths, and %s takes their place, accepted "
                             "one of the two",
                             options->category, options->path ? "--path" : "a model's orbit");
    }
    if (options->command == DIP_COMMAND_DUMP && !options->out && !options->json && !options->hash) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "dump",
                             "nothing to make, accepted at least one of --out DIR, --json FILE, "
                             "--hash");
    }
    if (options->bench.grid_count && (options->model_count || options->path || options->category)) {
        return dip_error_set(err, DIP_ERROR_CONFLICT, NULL, 0, "--grid",
                             "a grid takes the place of %s, accepted one of the two",
                             options->model_count ? "--model"
                             : options->path      ? "--path"
                                                  : "--category");
    }
    if (options->command == DIP_COMMAND_BENCH && !dip_bench_options_check(&options->bench, err)) {
        return false;
    }
    if ((options->command == DIP_COMMAND_COST || options->command == DIP_COMMAND_COST_MERGE) &&
        !dip_cost_options_check(options, err)) {
        return false;
    }
    if (options->command == DIP_COMMAND_PATH_INFO && options->operand_count != 1) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "path info",
                             "no file, accepted path info FILE");
    }
    if (options->command == DIP_COMMAND_PATH_CONVERT && options->operand_count != 2) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "path convert",
                             "%d of 2 files, accepted path convert IN OUT", options->operand_count);
    }
    return true;
}

bool dip_options_parse(int argc, char *const *argv, DipOptions *options, DipError *err) {
    *options = (DipOptions){
        .begin_ns = dip_clock_ns(), .end_frame = 1, .frame_step = 1, .fps_milli = 30000};
    dip_bench_options_default(&options->bench);
    dip_cost_options_default(&options->cost);
    options->bench.argc = argc;
    options->bench.argv = argv;
    int index = 1;
    if (!parse_command(argc, argv, &index, options, err)) {
        return false;
    }
    bool only_operands = false;
    for (; index < argc; index++) {
        const char *argument = argv[index];
        if (!only_operands && strcmp(argument, "--") == 0) {
            only_operands = true;
        } else if (!only_operands && argument[0] == '-' && argument[1]) {
            if (!parse_option(argc, argv, &index, options, err)) {
                return false;
            }
        } else if (!parse_operand(options, argument, err)) {
            return false;
        }
    }
    return check_complete(options, err);
}

// --- help --------------------------------------------------------------------------------------

static void print_settings(FILE *out) {
    fprintf(out, "\nSettings (SET), joined by commas; what is left out keeps its default (*):\n");
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        const DipSettingInfo *info = dip_setting_info((DipSetting)s);
        char steps[128] = "";
        for (int i = 0; i < info->step_count; i++) {
            strcat(strcat(strcat(steps, i ? "|" : ""), info->steps[i]),
                   i == info->default_step ? "*" : "");
        }
        fprintf(out, "  %-8s %s\n           %s\n", info->key, steps, info->text);
    }
}

static void print_options(unsigned mask, FILE *out) {
    fprintf(out, "\nOptions:\n");
    for (size_t i = 0; i < DIP_ARRAY_COUNT(rows); i++) {
        if (rows[i].commands & mask) {
            char left[40];
            snprintf(left, sizeof left, "%s %s", rows[i].name,
                     rows[i].argument ? rows[i].argument : "");
            fprintf(out, "  %-19s %s\n", left, rows[i].text);
        }
    }
}

static const char *usage_of(DipCommand command) {
    switch (command) {
    case DIP_COMMAND_DUMP:
        return "diptych dump --out DIR | --json FILE | --hash [OPTION]...";
    case DIP_COMMAND_BENCH:
        return "diptych bench [OPTION]...";
    case DIP_COMMAND_COST:
    case DIP_COMMAND_COST_MERGE:
    case DIP_COMMAND_COST_ASSETS:
        return "diptych cost --out DIR [OPTION]...\n"
               "       diptych cost merge --out DIR PART/cost.json...\n"
               "       diptych cost assets [OPTION]...";
    case DIP_COMMAND_PATH_INFO:
    case DIP_COMMAND_PATH_CONVERT:
        return "diptych path info FILE\n       diptych path convert IN OUT.pth|OUT.bth";
    default:
        return "diptych [preview] [OPTION]... [MODEL]...";
    }
}

static const char *examples_of(DipCommand command) {
    switch (command) {
    case DIP_COMMAND_DUMP:
        return "  diptych dump --out out --frames 0:8\n"
               "  diptych dump --hash --frames 0:1200:10 --requested aa=8,af=16 --isa avx2\n"
               "  diptych dump --out out --category AF --current af=none --requested af=16\n";
    case DIP_COMMAND_BENCH:
        return "  diptych bench\n"
               "  diptych bench --sets \"aa=none;aa=4;aa=4,af=16\" --threads 1,2 --isa "
               "avx2,avx512\n"
               "  diptych bench --size 320x240,640x480,1280x960 --svg plots --csv frames.csv\n"
               "  diptych bench --grid 1000,10000,100000 --sets aa=none --grid-out-of-view\n"
               "  diptych bench --vs ../before/build/release/diptych --threads 1 --rounds 40\n"
               "\nTimes are wall-clock milliseconds; docs/bench.md tells how to read them.\n";
    case DIP_COMMAND_COST:
    case DIP_COMMAND_COST_MERGE:
    case DIP_COMMAND_COST_ASSETS:
        return "  diptych cost --out report\n"
               "  diptych cost --out report --budget-ms 8,16.6\n"
               "  diptych cost --out report --model scene.glb --size 1280x720\n"
               "  diptych cost --out part0 --places 8 --part 0:4   # on one machine\n"
               "  diptych cost --out part1 --places 8 --part 4:8 --errors-only   # on another\n"
               "  diptych cost merge --out report part0/cost.json part1/cost.json\n"
               "  diptych cost assets --model scene.glb\n"
               "\nTimes are wall-clock milliseconds; docs/cost.md defines every figure.\n";
    case DIP_COMMAND_PATH_INFO:
    case DIP_COMMAND_PATH_CONVERT:
        return "  diptych path info campaths/ambient.pth\n"
               "  diptych path convert campaths/ambient.pth ambient.bth\n";
    default:
        return "  diptych\n"
               "  diptych --current aa=none --requested aa=8,af=16\n"
               "  diptych model.glb\n";
    }
}

// What the command does; all that share its first word share a help.
static void print_tasks(DipCommand command, FILE *out) {
    const char *typed = commands[command].typed;
    const size_t word = strcspn(typed, " ");
    fputc('\n', out);
    for (int c = 0; c < DIP_COMMAND_COUNT; c++) {
        if (strncmp(commands[c].typed, typed, word) != 0 ||
            (commands[c].typed[word] != ' ' && commands[c].typed[word] != '\0')) {
            continue;
        }
        fprintf(out, "  %-14s %s\n", commands[c].typed, commands[c].text);
    }
}

void dip_options_print_help(const DipOptions *options, bool one_command, FILE *out) {
    fprintf(out, "Diptych: a real-time preview of 3D image-quality settings\n\nUsage: %s\n",
            usage_of(options->command));
    if (one_command) {
        print_tasks(options->command, out);
    } else {
        fprintf(out, "\nCommands; `diptych COMMAND --help` tells more:\n");
        for (int c = 0; c < DIP_COMMAND_COUNT; c++) {
            fprintf(out, "  %-14s %s\n", commands[c].typed, commands[c].text);
        }
    }
    print_options(1u << options->command, out);
    if (1u << options->command & SCENE) {
        print_settings(out);
    }
    fprintf(out, "\nExamples:\n%s", examples_of(options->command));
    fprintf(out, "\nExit codes: 0 done, 1 failed while running, 2 bad command line or input.\n");
}
