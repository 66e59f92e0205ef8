// Runs the programs, start by start, and estimates from their times.
#include "app/cost/diff/diff_duel.h"

#include "app/cli/drive.h"
#include "app/cli/interrupt.h"
#include "app/cli/machine.h"
#include "app/cost/diff/diff.h"
#include "app/measure/timing/child.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ARGUMENTS = 40 + 2 * DIP_MAX_MODELS, MOST_SUBJECTS = 2 * (DIP_COST_DIFF_MAX_SETS + 1) };

// Rest before a frame, in which the other program's threads go to sleep.
static const int64_t rest_ns = 1000000;

// --- the command line of the programs ------------------------------------------------------------

typedef struct CommandLine {
    char *list[MOST_ARGUMENTS];
    int count;
    char numbers[8][24]; // Texts of the options that are numbers.
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

// Adds the options of the scene and of the drawing.
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

void dip_cost_duel_add_set(DipCostDuel *duel, const char *text) {
    const size_t used = strlen(duel->sets);
    snprintf(duel->sets + used, sizeof duel->sets - used, "%s%s", used ? ";" : "", text);
    duel->set_count++;
}

// --- drawing -------------------------------------------------------------------------------------

typedef struct Programs {
    DipCostDuel *duel;
    CommandLine line;
    DipChild *children[2];
} Programs;

static bool draw(void *context, const DipDriverTurn *turn, DipTimed *timed, DipError *err) {
    const Programs *p = context;
    const DipCostDuel *duel = p->duel;
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

// Starts the programs anew. A program that does not answer is a mistake on the command line.
static bool start_programs(void *context, int start, DipError *err) {
    Programs *p = context;
    DipCostDuel *duel = p->duel;
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
            // The programs' ini decides, so the threads are counted. bench has a pool of its own
            // beside the session's, and the main thread is in both.
            const int threads = (dip_child_thread_count(p->children[i]) + 1) / 2;
            duel->threads = threads > 0 ? threads : 1;
        }
    }
    return true;
}

static bool run_starts(Programs *p, uint64_t seed, DipError *err) {
    DipCostDuel *duel = p->duel;
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

bool dip_cost_duel_run(DipCostDuel *duel, const DipCostDiffArguments *arguments, int frames,
                       int rounds, DipError *err) {
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

void dip_cost_duel_free(DipCostDuel *duel) {
    dip_driver_destroy(&duel->driver);
    dip_times_fit_free(&duel->fit);
    free(duel->first);
}

// --- estimates -----------------------------------------------------------------------------------

void dip_cost_duel_count(const DipCostDuel *duel, int subject, double *counters) {
    for (int f = 0; f < duel->frames; f++) {
        dip_counters_add(&duel->first[subject * duel->frames + f].counters, counters);
    }
    for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
        counters[c] /= duel->frames;
    }
}

bool dip_cost_duel_per_start(const DipCostDuel *duel, DipBenchStage stage, double *per_start,
                             DipError *err) {
    DipTimes times = dip_driver_times(duel->driver);
    DipTimed *list = malloc(((size_t)times.count + 1) * sizeof *list);
    bool done = list || dip_cost_diff_no_memory(err);
    const int count = times.count;
    const DipTimed *all = times.list;
    times.list = list;
    times.starts = 1;
    for (int start = 0; done && start < duel->starts; start++) {
        times.count = 0;
        for (int i = 0; i < count; i++) {
            if (all[i].start == start) {
                list[times.count] = all[i];
                list[times.count++].start = 0;
            }
        }
        DipTimesFit *fit = dip_times_fit_part(&times, (int)stage, err);
        done = fit != NULL;
        for (int p = 0; done && p < duel->pair_count - 1; p++) {
            per_start[p * duel->starts + start] = dip_times_along(fit, 2 * p + 1).mean_ms.value -
                                                  dip_times_along(fit, 2 * p).mean_ms.value;
        }
        dip_times_fit_free(&fit);
    }
    free(list);
    return done;
}

DipCostVerdict dip_cost_duel_verdict(const DipCostDuel *duel, char reason[DIP_COST_REASON]) {
    const int same = 2 * duel->pair_count - 1;
    const DipDriverMachine machine = dip_driver_machine(duel->driver, duel->threads);
    DipCostSigns signs = dip_cost_signs_of(duel->fit, same + 1, &same, 1);
    signs.wait = machine.has_wait ? machine.wait : 0.0;
    return dip_cost_verdict_of(&signs, reason);
}
