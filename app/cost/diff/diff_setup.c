// Making the command line of `bench`, and reading what the programs counted.
#include "app/cost/diff/diff_setup.h"

#include "app/cli/machine.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void add_argument(DipCostSetup *setup, const char *text) {
    setup->arguments[setup->argument_count++] = (char *)text;
}

static void add_option(DipCostSetup *setup, const char *name, const char *value) {
    if (value) {
        add_argument(setup, name);
        add_argument(setup, value);
    }
}

static void add_number(DipCostSetup *setup, const char *name, int number) {
    char *text = setup->numbers[setup->number_count++];
    snprintf(text, DIP_COST_SETUP_NUMBER, "%d", number);
    add_option(setup, name, text);
}

void dip_cost_setup_add_set(DipCostSetup *setup, const char *text) {
    const size_t used = strlen(setup->sets);
    snprintf(setup->sets + used, sizeof setup->sets - used, "%s%s", used ? ";" : "", text);
    setup->def.combination_count++;
}

static void add_size(DipCostSetup *setup, int width, int height) {
    char *text = setup->numbers[setup->number_count++];
    snprintf(text, DIP_COST_SETUP_NUMBER, "%dx%d", width, height);
    add_option(setup, "--size", text);
}

// Hands the options of the scene and of the drawing on to `bench`.
static void add_session(DipCostSetup *setup, const DipSessionOptions *session) {
    add_option(setup, "--config", session->config);
    for (int m = 0; m < session->model_count; m++) {
        add_option(setup, "--model", session->models[m]);
    }
    add_option(setup, "--scene", session->scene);
    if (session->look) {
        add_number(setup, "--look", session->look + 1);
    }
    add_option(setup, "--up", session->up ? dip_up_axis_names[session->up] : NULL);
    add_option(setup, "--shading",
               session->has_shading ? dip_model_shading_names[session->shading] : NULL);
    if (session->import_seconds) {
        add_number(setup, "--import-seconds", session->import_seconds);
    }
    if (session->force_all_effects) {
        add_argument(setup, "--force-all-effects");
    }
    add_option(setup, "--path", session->path);
    add_option(setup, "--category", session->category);
    if (session->has_size) {
        add_size(setup, session->size.width, session->size.height);
    }
    if (session->has_threads) {
        add_number(setup, "--threads", session->threads);
    }
    add_option(setup, "--isa", session->has_isa ? dip_isa_name(session->isa) : NULL);
}

// Completes the command line once all sets are there.
void dip_cost_setup_finish(DipCostSetup *setup, const DipCostDiffArguments *arguments, int frames,
                           int rounds) {
    add_argument(setup, "diptych");
    add_argument(setup, "bench");
    add_option(setup, "--sets", setup->sets);
    add_number(setup, "--frames", frames);
    add_session(setup, &arguments->session);
    setup->def.argc = setup->argument_count;
    setup->def.argv = setup->arguments;
    setup->def.frames = frames;
    setup->def.threads = !arguments->session.has_threads ? 0
                         : arguments->session.threads    ? arguments->session.threads
                                                         : dip_machine_processor_count();
    setup->def.starts = arguments->measure.starts;
    setup->def.rounds = rounds;
    setup->def.seed = (uint64_t)dip_measure_seed(&arguments->measure);
}

void dip_cost_setup_free(DipCostSetup *setup) {
    if (setup) {
        dip_cost_duel_free(&setup->duel);
        free(setup);
    }
}

// --- work ----------------------------------------------------------------------------------------

const DipBenchSample *dip_cost_setup_sample(const DipCostSetup *setup, int side, int pair,
                                            int frame) {
    const int row = side * setup->def.pair_count + pair;
    return &setup->duel.first[row * setup->def.frames + frame];
}

void dip_cost_setup_count(const DipCostSetup *setup, int side, int pair, double *counters) {
    const int frames = setup->def.frames;
    for (int f = 0; f < frames; f++) {
        dip_counters_add(&dip_cost_setup_sample(setup, side, pair, f)->counters, counters);
    }
    for (int c = 0; c < DIP_COST_COUNTER_COUNT; c++) {
        counters[c] /= frames;
    }
}
