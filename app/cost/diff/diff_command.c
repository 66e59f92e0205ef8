// The command `diptych cost diff`: finds out what A and B are, compares them and judges the result.
#include "app/cost/command.h"
#include "app/cost/diff/diff.h"
#include "app/report/format/formats.h"
#include "renderer/base/assert.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// Differences of times below this are not reported.
static const double least_limit = 1.01;

// --- comparing -----------------------------------------------------------------------------------

// Returns the file of a side that is a program, or NULL if it is a report.
static const char *program_of(const char *name) {
    struct stat status;
    const size_t length = strlen(name);
    if (strcmp(name, ".") == 0) {
        return "/proc/self/exe";
    }
    const bool is_report = (length >= 5 && strcmp(name + length - 5, ".json") == 0) ||
                           stat(name, &status) != 0 || S_ISDIR(status.st_mode) ||
                           access(name, X_OK) != 0;
    return is_report ? NULL : name;
}

// Compares what A and B are. Of a report and a program, the program measures rows of the report
// again.
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
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost diff", "out of memory");
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
        "more than 1 % above 1.\n\n"
        "The exit code is 0 if nothing is beyond --fail-over, 1 if something is, 2 if the input is "
        "wrong, and 3 if the machine was too busy to tell.",
    .examples = examples,
    .example_count = DIP_ARRAY_COUNT(examples),
    .lists_settings = true,
    .parts = &dip_cost_diff_option_parts,
    .operands = {offsetof(DipCostDiffArguments, sides), offsetof(DipCostDiffArguments, side_count),
                 2},
    .options_size = sizeof(DipCostDiffArguments),
    .set_defaults = dip_cost_diff_options_default,
    .check = dip_cost_diff_options_check,
    .run = run,
};
