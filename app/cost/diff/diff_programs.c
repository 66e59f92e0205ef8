// Compares two programs that take turns at every frame, and measures the rows of a report again
// with a program.
//
// In both cases, pairs of subjects are timed. A subject is a set of settings that one program
// draws. The two subjects of a pair, called sides, take turns at every frame. The programs are
// started several times, because each start is by chance a little faster or slower than another.
//
// The programs run as `PROGRAM bench ... --serve` (app/measure/timing/child.h). With two programs,
// both sides of pair p draw set p, each in its own program. With one program, the sides draw set 0
// and set p + 1. The last pair is the A/A pair, whose times should be equal: program 0 draws set 0
// and the last set, which has the same settings.
#include "app/cost/diff/diff.h"

#include "app/cli/progress.h"
#include "app/cli/machine.h"
#include "app/measure/timing/child.h"
#include "app/measure/timing/driver.h"
#include "app/report/verdict.h"
#include "app/session/session.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// What is timed: the programs and the pairs, with their times.
typedef struct Duel {
    const char *programs[2]; // The second is NULL if there is only one program. Borrowed.
    char sets[(DIP_COST_DIFF_MAX_SETS + 2) * DIP_COST_TEXT];
    int set_count;
    int pair_count;
    int starts;
    int rounds;
    int frames;
    int threads;       // Number of threads with which a program draws.
    DipDriver *driver; // Times the subjects. Subject 2 * pair + side is one side of a pair; side 0
                       // is its base. Owned.
    DipTimesFit *fit;  // Owned.
    // [subject * frames + frame]: the frame's first drawing, with its counters and hash. Owned.
    DipBenchSample *first;
} Duel;

enum { MOST_ARGUMENTS = 48 + 2 * DIP_MAX_MODELS, MOST_SUBJECTS = 2 * (DIP_COST_DIFF_MAX_SETS + 1) };

// Pause in nanoseconds before each timed frame. If there are two programs, the threads of the
// program that drew last fall asleep in this pause.
static const int64_t rest_ns = 1000000;

// --- the command line of the programs ------------------------------------------------------------

typedef struct CommandLine {
    char *list[MOST_ARGUMENTS];
    int count;
    char numbers[8][32]; // Texts of the options that are numbers.
    int number_count;
} CommandLine;

static void add_option(CommandLine *line, const char *name, const char *value) {
    if (value) {
        line->list[line->count++] = (char *)name;
        line->list[line->count++] = (char *)value;
    }
}

static void add_number(CommandLine *line, const char *name, const char *format, ...)
    DIP_PRINTF(3, 4);
static void add_number(CommandLine *line, const char *name, const char *format, ...) {
    char *text = line->numbers[line->number_count++];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof line->numbers[0], format, arguments);
    va_end(arguments);
    add_option(line, name, text);
}

// Adds the options that say what the programs draw (scene, path and size), and with which threads
// and instruction set.
static void add_session(CommandLine *line, const DipSessionOptions *session) {
    add_option(line, "--config", session->config);
    for (int m = 0; m < session->model_count; m++) {
        add_option(line, "--model", session->models[m]);
    }
    add_option(line, "--scene", session->scene);
    if (session->look) {
        add_number(line, "--look", "%d", session->look + 1);
    }
    add_option(line, "--up", session->up ? dip_up_axis_names[session->up] : NULL);
    add_option(line, "--shading",
               session->has_shading ? dip_model_shading_names[session->shading] : NULL);
    if (session->import_seconds) {
        add_number(line, "--import-seconds", "%d", session->import_seconds);
    }
    if (session->force_all_effects) {
        line->list[line->count++] = (char *)"--force-all-effects";
    }
    if (session->no_ground) {
        line->list[line->count++] = (char *)"--no-ground";
    }
    add_option(line, "--animation", session->animation);
    if (session->has_animation_time) {
        add_number(line, "--animation-time", "%.17g", session->animation_time_s);
    }
    add_option(line, "--path", session->path);
    add_option(line, "--category", session->category);
    if (session->has_size) {
        add_number(line, "--size", "%dx%d", session->size.width, session->size.height);
    }
    if (session->has_threads) {
        add_number(line, "--threads", "%d", session->threads);
    }
    add_option(line, "--isa", session->has_isa ? dip_isa_name(session->isa) : NULL);
}

// Appends a set of settings to duel->sets.
static void add_set(Duel *duel, const char *text) {
    const size_t used = strlen(duel->sets);
    snprintf(duel->sets + used, sizeof duel->sets - used, "%s%s", used ? ";" : "", text);
    duel->set_count++;
}

// --- drawing -------------------------------------------------------------------------------------

typedef struct Programs {
    Duel *duel;
    CommandLine line;
    DipChild *children[2];
} Programs;

static bool draw(void *context, const DipDriverTurn *turn, DipTimed *timed, DipError *err) {
    const Programs *p = context;
    const Duel *duel = p->duel;
    const int pair = turn->subject / 2, side = turn->subject % 2, same = duel->pair_count - 1;
    const bool two = duel->programs[1] != NULL;
    const int set = two ? (pair == same && side == 0 ? 0 : pair) : side * (pair + 1);
    const bool first = turn->phase == DIP_DRIVER_WARM_UP && turn->start == 0;
    char request[64];
    DipBenchSample sample;
    snprintf(request, sizeof request, "draw %d %d %d", set, turn->frame, first);
    if (!dip_child_draw(p->children[two && side == 1 && pair < same], request, &sample, timed,
                        err)) {
        return false;
    }
    if (first) {
        duel->first[turn->subject * duel->frames + turn->frame] = sample;
    }
    return true;
}

static void stop_programs(Programs *p) {
    dip_child_stop(&p->children[0], dip_interrupted());
    dip_child_stop(&p->children[1], dip_interrupted());
}

// Starts the programs anew. If a program does not answer at its first start, the command line
// probably names a wrong file, so the error is one of the input.
static bool start_programs(void *context, int start, DipError *err) {
    Programs *p = context;
    Duel *duel = p->duel;
    stop_programs(p);
    for (int i = 0; i < 2 && duel->programs[i]; i++) {
        const DipChildDef def = {duel->programs[i], p->line.list, p->line.count, "bench",
                                 duel->set_count,   duel->frames, "--vs"};
        p->children[i] = dip_child_start(&def, err);
        if (!p->children[i]) {
            if (err && err->code != DIP_ERROR_MEMORY) {
                err->origin = start == 0 ? DIP_ORIGIN_INPUT : DIP_ORIGIN_RUNTIME;
                memcpy(err->key, "cost diff", sizeof "cost diff");
            }
            return false;
        }
        if (duel->threads == 0) {
            // The program's ini file decides how many threads draw. The number of threads that draw
            // follows from the number of all threads of the program: the program has a pool for
            // bench and a pool for the session, and the main thread is in both.
            const int threads = (dip_child_thread_count(p->children[i]) + 1) / 2;
            duel->threads = threads > 0 ? threads : 1;
        }
        dip_child_confine(p->children[i], duel->threads);
    }
    return true;
}

static bool run_starts(Programs *p, uint64_t seed, DipError *err) {
    Duel *duel = p->duel;
    int base_of[MOST_SUBJECTS];
    for (int s = 0; s < 2 * duel->pair_count; s++) {
        base_of[s] = s - s % 2;
    }
    const DipDriverDef timing = {
        .subjects = 2 * duel->pair_count,
        .base_of = base_of,
        .block_subjects = 1,
        .starts = duel->starts,
        .rounds = duel->rounds,
        .frames = duel->frames,
        .warm_frames = duel->frames,
        .seed = seed,
        .in_turn = true,
        .rest_ns = rest_ns,
    };
    const DipDriverCalls calls = {.draw = draw, .start = start_programs, .context = p};
    duel->driver = dip_driver_create(&timing, &calls, err);
    if (duel->driver && dip_drive(duel->driver, "frames", "cost diff", "interrupted", err)) {
        const DipTimes times = dip_driver_times(duel->driver);
        duel->fit = dip_times_fit(&times, err);
    }
    stop_programs(p);
    return duel->fit != NULL;
}

// Times all pairs: `frames` frames in each of `rounds` rounds of each start. Fails as
// dip_child_start and dip_child_draw do, with DIP_ERROR_RUNTIME if the user presses Ctrl-C, or with
// DIP_ERROR_MEMORY.
static bool run_duel(Duel *duel, const DipCostDiffArguments *arguments, int frames, int rounds,
                     DipError *err) {
    const DipSessionOptions *session = &arguments->session;
    Programs p = {.duel = duel};
    duel->pair_count = duel->set_count - (duel->programs[1] ? 0 : 1);
    duel->starts = arguments->measure.starts;
    duel->rounds = rounds;
    duel->frames = frames;
    duel->threads = !session->has_threads ? 0
                    : session->threads    ? session->threads
                                          : dip_machine_processor_count();
    add_option(&p.line, "diptych", "bench");
    add_option(&p.line, "--sets", duel->sets);
    add_number(&p.line, "--frames", "%d", frames);
    add_session(&p.line, session);
    duel->first = calloc(2 * (size_t)duel->pair_count * (size_t)frames, sizeof *duel->first);
    dip_interrupt_watch();
    return (duel->first || dip_cost_diff_no_memory(err)) &&
           run_starts(&p, (uint64_t)dip_measure_seed(&arguments->measure), err);
}

static void free_duel(Duel *duel) {
    dip_driver_destroy(&duel->driver);
    dip_times_fit_free(&duel->fit);
    free(duel->first);
}

// --- estimates -----------------------------------------------------------------------------------

// Writes the means of a subject's counters over its frames. `counters` has the order of
// DIP_COUNTER_LIST and must be all 0 before the call.
static void count_work(const Duel *duel, int subject, double *counters) {
    for (int f = 0; f < duel->frames; f++) {
        dip_counters_add(&duel->first[subject * duel->frames + f].counters, counters);
    }
    for (int c = 0; c < DIP_COUNTER_COUNT; c++) {
        counters[c] /= duel->frames;
    }
}

// Judges the machine by the waiting times and the A/A pair.
static DipCostVerdict judge_duel(const Duel *duel, char reason[DIP_COST_REASON]) {
    const int same = 2 * duel->pair_count - 1;
    const DipDriverMachine machine = dip_driver_machine(duel->driver, duel->threads);
    DipCostSigns signs = dip_cost_signs_of(duel->fit, same + 1, &same, 1);
    signs.wait = machine.has_wait ? machine.wait : 0.0;
    return dip_cost_verdict_of(&signs, reason);
}

// --- two programs --------------------------------------------------------------------------------

static void compare_work(const Duel *duel, int pair, DipCostDiffRow *row) {
    for (int side = 0; side < 2; side++) {
        for (int q = 0; q < DIP_COST_DIFF_QUANTITY_COUNT; q++) {
            row->values[side][q] = q < DIP_COST_DIFF_ERROR_COUNT ? NAN : 0.0;
        }
        count_work(duel, 2 * pair + side, row->values[side] + DIP_COST_DIFF_FIRST_COUNTER);
    }
    const DipBenchSample *a = duel->first + 2 * pair * duel->frames, *b = a + duel->frames;
    for (int f = 0; f < duel->frames; f++) {
        row->values[1][DIP_COST_DIFF_pictures] += strcmp(a[f].hash, b[f].hash) != 0;
    }
}

static void compare_pair(const Duel *duel, const DipCostDiffArguments *arguments, int pair,
                         DipCostDiffRow *row) {
    const DipSessionOptions *session = &arguments->session;
    *row = (DipCostDiffRow){.quality = arguments->sets[pair].quality, .timed = true};
    snprintf(row->path, sizeof row->path, "%s",
             session->category ? session->category
             : session->path   ? "PATH"
                               : "DEFAULT");
    compare_work(duel, pair, row);
    for (int side = 0; side < 2; side++) {
        row->ms[side] = dip_times_along(duel->fit, 2 * pair + side).mean_ms.value;
    }
    row->change = dip_times_ratio(duel->fit, 2 * pair + 1);
    row->surely_above = row->change.low;
    row->surely_below = row->change.high;
}

// Computes for each row and each stage by what factor A's time of the whole frame would change if
// only this stage took as long as it takes in B.
static bool compare_stages(const Duel *duel, DipCostDiff *diff, DipError *err) {
    const DipTimes times = dip_driver_times(duel->driver);
    for (int stage = 0; stage < DIP_COST_DIFF_STAGES; stage++) {
        DipTimesFit *fit = dip_times_fit_part(&times, stage, err);
        if (!fit) {
            return false;
        }
        for (int r = 0; r < diff->row_count; r++) {
            diff->rows[r].stages[stage] = dip_times_ratio(fit, 2 * r + 1);
        }
        dip_times_fit_free(&fit);
    }
    return true;
}

static void judge_machine(const Duel *duel, DipCostDiff *diff) {
    char processor[DIP_COST_TEXT];
    dip_machine_processor(processor, sizeof processor);
    for (int side = 0; side < 2; side++) {
        diff->verdicts[side] = judge_duel(duel, diff->reasons[side]);
        snprintf(diff->machines[side], sizeof diff->machines[side], "%s, %d thread%s", processor,
                 duel->threads, dip_cost_plural(duel->threads));
    }
    if (!dip_driver_machine(duel->driver, duel->threads).has_wait) {
        dip_cost_diff_note(diff, "this system does not tell how long threads wait for a core, so "
                                 "only the A/A times show whether the machine was quiet");
    }
}

static bool compare_pairs(const Duel *duel, const DipCostDiffArguments *arguments,
                          DipCostDiff *diff, DipError *err) {
    diff->rows = calloc((size_t)arguments->set_count, sizeof *diff->rows);
    if (!diff->rows) {
        return dip_cost_diff_no_memory(err);
    }
    diff->kind = DIP_COST_DIFF_PROGRAMS;
    diff->same_machine = true;
    diff->has_times = true;
    while (diff->row_count < arguments->set_count) {
        compare_pair(duel, arguments, diff->row_count, &diff->rows[diff->row_count]);
        diff->row_count++;
    }
    judge_machine(duel, diff);
    dip_cost_diff_leave_out_uncounted(diff);
    dip_cost_diff_mark(diff);
    const DipTimes times = dip_driver_times(duel->driver);
    return compare_stages(duel, diff, err) &&
           (diff->slower == 0 || dip_cost_diff_explain(diff, &times, duel->fit, err));
}

bool dip_cost_diff_programs(const DipCostDiffArguments *arguments, const char *const programs[2],
                            DipCostDiff *diff, DipError *err) {
    Duel duel = {.programs = {programs[0], programs[1]}};
    for (int s = 0; s <= arguments->set_count; s++) { // The last set is that of the A/A pair.
        add_set(&duel, arguments->sets[s % arguments->set_count].text);
    }
    const bool done =
        run_duel(&duel, arguments, arguments->frames ? arguments->frames : DIP_COST_DIFF_FRAMES,
                 arguments->measure.rounds ? arguments->measure.rounds : DIP_COST_DIFF_ROUNDS,
                 err) &&
        compare_pairs(&duel, arguments, diff, err);
    free_duel(&duel);
    if (!done) {
        dip_cost_diff_free(diff);
    }
    return done;
}

// --- a report and a program ----------------------------------------------------------------------

// Lists the rows to measure: those of path 0 whose settings `arguments` lists. Leaves out the
// baseline, which is side 0 of every pair. Returns their number.
static int list_rows(const DipCostDiffArguments *arguments, const DipCostReport *report,
                     int rows[DIP_COST_DIFF_MAX_SETS]) {
    int count = 0;
    for (int s = 0; s < arguments->set_count; s++) {
        const DipQuality *quality = &arguments->sets[s].quality;
        const int row = dip_report_find(report, quality, 0, 0);
        if (row >= 0 && memcmp(quality, &report->options.baseline, sizeof *quality) != 0) {
            rows[count++] = row;
        }
    }
    return count;
}

// Adds a combination as a set. Another build may not know every setting, so settings that have
// their defaults are left out. If all have, the set is "aa=none", because a set may not be empty.
static void add_quality(Duel *duel, const DipQuality *quality) {
    const DipQuality standard = dip_quality_default();
    char text[DIP_COST_TEXT] = "aa=none";
    if (memcmp(quality, &standard, sizeof standard) != 0) {
        dip_cost_settings_text(quality, text);
    }
    add_set(duel, text);
}

// Returns whether a path of a report has the name of a category, which is not the name of a camera
// or of a file that --path gave.
static bool is_category(const char *path) {
    for (int c = 0; c < DIP_CATEGORY_COUNT; c++) {
        if (strcmp(dip_session_category(c), path) == 0) {
            return true;
        }
    }
    return false;
}

// Returns the arguments, completed from the report: the options of size, threads, instruction set
// and camera path that were not given get the values with which the report was measured. With a
// model, a category needs no option: the camera orbits the model. If this machine lacks the
// report's instruction set, the best one that the machine has takes its place.
static DipCostDiffArguments options_of_report(const DipCostDiffArguments *arguments,
                                              const DipCostReport *report) {
    DipCostDiffArguments all = *arguments;
    DipSessionOptions *session = &all.session;
    DipIsa isa;
    if (!session->has_size) {
        session->has_size = true;
        session->size = (DipOptionSize){report->width, report->height};
    }
    if (!session->has_threads) {
        session->has_threads = true;
        session->threads = report->threads;
    }
    if (!session->has_isa) {
        const bool known = dip_isa_parse(report->isa, &isa) && dip_isa_available(isa);
        session->has_isa = true;
        session->isa = known ? isa : dip_isa_best();
    }
    if (!session->path && !session->category) {
        const bool named = is_category(report->paths[0]);
        session->category = named && !session->model_count ? report->paths[0] : NULL;
        session->path = named ? NULL : report->paths[0];
    }
    return all;
}

// A report has only the name of the file that --path gave, without folder and ending. If the
// program did not start with the report's path, adds to the error what the user must give.
static void ask_for_path(const DipCostDiffArguments *arguments, const DipCostReport *report,
                         DipError *err) {
    const DipSessionOptions *session = &arguments->session;
    if (err && err->origin == DIP_ORIGIN_INPUT && !session->path && !session->category &&
        !is_category(report->paths[0])) {
        const size_t length = strlen(err->message);
        snprintf(err->message + length, sizeof err->message - length,
                 "; if it did not find the path \"%s\" of the report, give the path's file or "
                 "camera with --path",
                 report->paths[0]);
    }
}

// Fills in the new report. It has the first path of the old report, the baseline and `count` rows.
static bool make_report(const DipCostReport *report, const Duel *duel, const int *rows, int count,
                        const DipSessionOptions *session, DipCostReport *measured, DipError *err) {
    *measured = (DipCostReport){
        .threads = duel->threads,
        .width = session->size.width,
        .height = session->size.height,
        .options = report->options,
        .path_count = 1,
        .combined_first = count + 1,
        .rounds = report->rounds,
        .starts = duel->starts,
    };
    memcpy(measured->paths[0], report->paths[0], sizeof measured->paths[0]);
    snprintf(measured->scene, sizeof measured->scene, "%s", report->scene);
    snprintf(measured->isa, sizeof measured->isa, "%s", dip_isa_name(session->isa));
    dip_machine_processor(measured->processor, sizeof measured->processor);
    measured->rows = calloc((size_t)count + 1, sizeof *measured->rows);
    measured->row_count = measured->rows ? count + 1 : 0;
    if (!measured->rows || !dip_cost_report_alloc(measured, NULL)) {
        return dip_cost_diff_no_memory(err);
    }
    for (int i = 0; i <= count; i++) {
        // Row 0 is the baseline, which is side 0 of every pair.
        const int subject = i ? 2 * i - 1 : 0;
        DipCostRow *row = &measured->rows[i];
        row->quality = i ? report->rows[rows[i - 1]].quality : report->options.baseline;
        count_work(duel, subject, row->counters);
        row->time.mean_ms.value = dip_times_along(duel->fit, subject).mean_ms.value;
        row->time.ratio = i ? dip_times_ratio(duel->fit, subject) : dip_estimate_unknown(1.0);
    }
    measured->verdict = judge_duel(duel, measured->verdict_reason);
    return true;
}

bool dip_cost_diff_measure_report(const DipCostDiffArguments *arguments, const char *program,
                                  const DipCostReport *report, DipCostReport *measured,
                                  DipError *err) {
    int rows[DIP_COST_DIFF_MAX_SETS];
    const int count = list_rows(arguments, report, rows);
    *measured = (DipCostReport){.rows = NULL};
    if (report->rounds == 0 || count == 0) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "cost diff",
                             "the report has %s; name settings of its first path with --sets",
                             report->rounds == 0 ? "no times to compare with"
                                                 : "none of the settings to time");
    }
    const DipCostDiffArguments all = options_of_report(arguments, report);
    Duel duel = {.programs = {program}};
    for (int i = 0; i < count + 2; i++) { // The last set is that of the A/A pair.
        const bool is_row = i > 0 && i <= count;
        add_quality(&duel, is_row ? &report->rows[rows[i - 1]].quality : &report->options.baseline);
    }
    const bool done = run_duel(&duel, &all, dip_cost_frame_count(report),
                               arguments->measure.rounds ? arguments->measure.rounds : 1, err) &&
                      make_report(report, &duel, rows, count, &all.session, measured, err);
    free_duel(&duel);
    if (!done) {
        ask_for_path(arguments, report, err);
        dip_cost_report_free(measured);
    }
    return done;
}
