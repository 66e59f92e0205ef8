// Runs the command `diptych cost diff`: reads its options, finds out what A and B are, compares
// them and judges the result.
#include "app/cli/program_file.h"
#include "app/cost/command.h"
#include "app/cost/diff/diff.h"
#include "app/report/format/formats.h"
#include "renderer/base/assert.h"
#include "renderer/base/number.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// A row is called slower or faster only if its time surely changed by more than this factor, or by
// more than --fail-over allows if that is less.
static const double least_limit = 1.01;

// --- options -------------------------------------------------------------------------------------

#define FIELD(name) offsetof(DipCostDiffArguments, name)

// Together, these sets use several samples per pixel (aa), adaptive AA (aaa, asd), anisotropic
// filtering (af, aaf) and compressed textures (opt). Adaptive AA shades alpha-clipped surfaces once
// per group of samples.
static const char default_sets[] = "aa=none;aa=4;aa=8;af=16;aa=8,af=16;aa=8,aaa=on;opt=advanced;"
                                   "aa=8,aaa=on,asd=2,af=16,aaf=on";

static bool read_share(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    DipCostDiffArguments *diff = fields;
    const size_t length = strlen(value);
    double percent;
    if (length < 2 || value[length - 1] != '%' || !dip_number_parse(value, length - 1, &percent) ||
        percent < 0.1 || percent > 1000.0) {
        return dip_option_refuse(err, DIP_ERROR_RANGE, row->name, value,
                                 "a share from 0.1% to 1000%, such as 3%");
    }
    diff->fail_over = 1.0 + percent / 100.0;
    return true;
}

static const DipOptionRow judge_rows[] = {
    {"--fail-over", "P%", DIP_OPTION_CUSTOM, .read = read_share,
     .text = "Exit with code 1 if B takes surely more than P % longer with any settings, or if an "
             "error grew by more than P %. Without the option, differences are only reported."},
};

static const DipOptionRow run_rows[] = {
    {"--sets", "LIST", DIP_OPTION_LIST, FIELD(sets), .count = FIELD(set_count),
     .room = DIP_COST_DIFF_MAX_SETS, .separator = ';', .item = DIP_OPTION_SET,
     .text =
         "Settings to time, as SET;SET;... in quotes. The default is eight sets of antialiasing, "
         "adaptive AA, anisotropic filtering and texture optimisations."},
    {"--frames", "N", DIP_OPTION_INTEGER, FIELD(frames), .least = 1, .most = 1000,
     .text = "Draw this many frames, which divide the camera path evenly. The default is 6. If a "
             "program is compared with a report, the frames are those of the report."},
};

static const DipOptionTable judge_table = DIP_OPTION_TABLE("Judging and output", judge_rows);
static const DipOptionTable run_table = DIP_OPTION_TABLE("Timing programs", run_rows);

static const DipOptionPart parts[] = {
    {&judge_table, 0},
    {&dip_json_option_table, FIELD(json)},
    {&run_table, 0},
    {&dip_measure_option_table, offsetof(DipCostDiffArguments, measure)},
    {&dip_starts_option_table, offsetof(DipCostDiffArguments, measure)},
    {&dip_scene_option_table, offsetof(DipCostDiffArguments, session)},
    {&dip_path_option_table, offsetof(DipCostDiffArguments, session)},
    {&dip_category_option_table, offsetof(DipCostDiffArguments, session)},
    {&dip_size_option_table, offsetof(DipCostDiffArguments, session)},
    {&dip_threads_option_table, offsetof(DipCostDiffArguments, session)},
    {&dip_program_option_table, offsetof(DipCostDiffArguments, program)},
};
static const DipOptionParts option_parts = {parts, DIP_ARRAY_COUNT(parts)};

static void set_defaults(void *arguments) {
    DipCostDiffArguments *diff = arguments;
    diff->measure.starts = DIP_COST_DIFF_STARTS;
    dip_option_store(&run_rows[0], default_sets, diff, NULL);
}

static bool check(const void *arguments, DipError *err) {
    const DipCostDiffArguments *diff = arguments;
    if (diff->side_count != 2) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "cost diff",
                             "there is nothing to compare; give two reports or programs: cost diff "
                             "A B");
    }
    if (diff->measure.starts < 2) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "--starts",
                             "1 start has no spread; give 2 or more");
    }
    return dip_session_options_check(&diff->session, err);
}

// --- comparing -----------------------------------------------------------------------------------

// Returns the program's file if a side is a program, or NULL if it is a report.
static const char *program_of(const char *name) {
    struct stat status;
    const size_t length = strlen(name);
    if (strcmp(name, ".") == 0) {
        return dip_program_file();
    }
    const bool is_report = (length >= 5 && strcmp(name + length - 5, ".json") == 0) ||
                           stat(name, &status) != 0 || S_ISDIR(status.st_mode) ||
                           access(name, X_OK) != 0;
    return is_report ? NULL : name;
}

// Compares two reports, two programs, or a report and a program. In the last case, the program
// measures the baseline and the settings of --sets again, on the report's first path
// (dip_cost_diff_measure_report).
static bool compare(const DipCostDiffArguments *arguments, DipCostDiff *diff, DipError *err) {
    const char *programs[2];
    DipCostReport reports[2] = {{.rows = NULL}, {.rows = NULL}};
    bool done = true;
    for (int i = 0; done && i < 2; i++) {
        programs[i] = program_of(arguments->sides[i]);
        done = programs[i] || dip_cost_read_report(arguments->sides[i], &reports[i], err);
    }
    if (done && programs[0] && programs[1]) {
        return dip_cost_diff_programs(arguments, programs, diff, err);
    }
    if (done && (programs[0] || programs[1])) {
        const int p = programs[0] ? 0 : 1;
        diff->some_rows = true;
        dip_cost_diff_note(diff, "errors are not compared: only `diptych cost` measures them");
        done =
            dip_cost_diff_measure_report(arguments, programs[p], &reports[1 - p], &reports[p], err);
    }
    done = done && dip_cost_diff_reports(&reports[0], &reports[1], diff, err);
    dip_cost_report_free(&reports[0]);
    dip_cost_report_free(&reports[1]);
    return done;
}

// --- the result ----------------------------------------------------------------------------------

static bool judge(const DipCostDiff *diff, DipError *err) {
    const double percent = 100.0 * (diff->fail_over - 1.0);
    if (diff->failed_times + diff->failed_errors > 0) {
        return dip_error_set_runtime(err, DIP_ERROR_RUNTIME, NULL, 0, "--fail-over",
                                     "%d rows are slower and %d have a greater error in %.80s, by "
                                     "more than %.3g %%",
                                     diff->failed_times, diff->failed_errors, diff->names[1],
                                     percent);
    }
    if (dip_cost_diff_is_busy(diff)) {
        const int side = diff->verdicts[0] == DIP_COST_RED ? 0 : 1;
        return dip_error_set_runtime(err, DIP_ERROR_BUSY, NULL, 0, "cost diff",
                                     "the machine was too busy to compare times. %.200s",
                                     diff->reasons[side]);
    }
    return true;
}

static bool run(DipSession *session, const void *all_arguments, DipError *err) {
    (void)session;
    const DipCostDiffArguments *arguments = all_arguments;
    DipCostDiff *diff = calloc(1, sizeof *diff);
    if (!diff) {
        return dip_cost_diff_no_memory(err);
    }
    diff->fail_over = arguments->fail_over;
    diff->limit = diff->fail_over > 0.0 ? fmin(least_limit, diff->fail_over) : least_limit;
    diff->names[0] = arguments->sides[0];
    diff->names[1] = arguments->sides[1];
    const bool done = compare(arguments, diff, err) && dip_cost_diff_print(diff, stdout, err) &&
                      (!arguments->json || dip_cost_diff_write_json(diff, arguments->json, err)) &&
                      judge(diff, err);
    dip_cost_diff_free(diff);
    free(diff);
    return done;
}

static const DipExample examples[] = {
    {"diptych cost diff before/cost.json after/cost.json",
     "compares two reports: every error and counter, and the ratios of the times"},
    {"diptych cost diff ../main/build/release/diptych .",
     "times another build and this program, in turn, in about two minutes"},
    {"diptych cost diff base/diptych head/diptych --fail-over 3% --json diff.json",
     "checks a pull request: exits with code 1 if it makes anything surely 3 % slower"},
    {"diptych cost diff report .",
     "measures rows of a report again with this program and compares the two"},
};

const DipCommand dip_cost_diff_command = {
    .name = "cost diff",
    .summary = "find what got slower or worse between two reports or builds",
    .usage = "A B [OPTION]...",
    .text =
        "Cost diff compares A with B. Each of them is a report (a cost.json, or a folder that has "
        "one), or a program (another build of diptych; a dot stands for this program).\n\n"
        "Errors, pictures and counters are exact, so every difference is named. Two programs are "
        "timed anew: they are started several times and draw in turn. A report's times are "
        "compared as ratios to its own baseline. A row is slower if its whole 95 % interval is "
        "more than 1 % above 1; between reports, intervals are widened so that all of them hold "
        "together.\n\n"
        "The exit code is 0 if nothing is beyond --fail-over, 1 if something is, 2 if the input is "
        "wrong, and 3 if the machine was too busy to tell.",
    .examples = examples,
    .example_count = DIP_ARRAY_COUNT(examples),
    .lists_settings = true,
    .parts = &option_parts,
    .operands = {offsetof(DipCostDiffArguments, sides), offsetof(DipCostDiffArguments, side_count),
                 2},
    .options_size = sizeof(DipCostDiffArguments),
    .set_defaults = set_defaults,
    .check = check,
    .run = run,
};
