// Measuring the rows of a report again with a program.
#include "app/cost/diff/diff_programs.h"

#include "app/cost/diff/diff_setup.h"
#include "app/cli/machine.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool out_of_memory(DipError *err) {
    return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost diff", "out of memory");
}

static int find_row(const DipCostReport *report, const DipQuality *quality) {
    for (int r = 0; r < report->row_count; r++) {
        if (report->rows[r].path == 0 &&
            memcmp(&report->rows[r].quality, quality, sizeof *quality) == 0) {
            return r;
        }
    }
    return -1;
}

// Lists the rows to measure: the baseline is combination 0 and has no pair of its own.
static int list_rows(const DipCostDiffArguments *arguments, const DipCostReport *report,
                     int rows[DIP_COST_DIFF_MAX_SETS]) {
    int count = 0;
    for (int s = 0; s < arguments->set_count; s++) {
        const int row = find_row(report, &arguments->sets[s].quality);
        if (row >= 0 && memcmp(&arguments->sets[s].quality, &report->options.baseline,
                               sizeof(DipQuality)) != 0) {
            rows[count++] = row;
        }
    }
    return count;
}

// Another build may not know every setting, so those with their defaults are left out.
static void add_quality(DipCostSetup *setup, const DipQuality *quality) {
    const DipQuality standard = dip_quality_default();
    char text[DIP_COST_TEXT] = "aa=none";
    if (memcmp(quality, &standard, sizeof standard) != 0) {
        dip_cost_settings_text(quality, text);
    }
    dip_cost_setup_add_set(setup, text);
}

// Completes the options with what the report was measured with.
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
    if (!session->path && !session->model_count && !session->category) {
        session->category = report->paths[0];
    }
    return all;
}

static DipCostSetup *setup_report(const DipCostDiffArguments *arguments, const char *program,
                                  const DipCostReport *report, const int *rows, int count) {
    DipCostSetup *setup = calloc(1, sizeof *setup);
    if (!setup) {
        return NULL;
    }
    add_quality(setup, &report->options.baseline);
    for (int i = 0; i < count; i++) {
        add_quality(setup, &report->rows[rows[i]].quality);
        setup->def.combination_of[i][1] = i + 1;
    }
    add_quality(setup, &report->options.baseline);
    setup->def.combination_of[count][1] = count + 1; // The A/A pair.
    setup->def.pair_count = count + 1;
    setup->def.program_count = 1;
    setup->def.programs[0] = program;
    dip_cost_setup_finish(setup, arguments, dip_cost_frame_count(report),
                          arguments->measure.rounds ? arguments->measure.rounds : 1);
    return setup;
}

// Fills in the head of a report that has the report's first path and `count` rows besides the
// baseline.
static bool begin_report(const DipCostReport *report, const DipCostSetup *setup, int count,
                         const DipSessionOptions *session, DipCostReport *measured, DipError *err) {
    *measured = (DipCostReport){
        .threads = setup->duel.threads,
        .width = session->size.width,
        .height = session->size.height,
        .options = report->options,
        .path_count = 1,
        .row_count = count + 1,
        .combined_first = count + 1,
        .rounds = report->rounds,
    };
    memcpy(measured->paths[0], report->paths[0], sizeof measured->paths[0]);
    snprintf(measured->scene, sizeof measured->scene, "%s", report->scene);
    snprintf(measured->isa, sizeof measured->isa, "%s", dip_isa_name(session->isa));
    dip_machine_processor(measured->processor, sizeof measured->processor);
    measured->rows = calloc((size_t)count + 1, sizeof *measured->rows);
    if (!measured->rows) {
        measured->row_count = 0;
        return out_of_memory(err);
    }
    return dip_cost_report_alloc(measured, err);
}

static bool fill_report(const DipCostReport *report, const DipCostSetup *setup, const int *rows,
                        int count, DipCostReport *measured, DipError *err) {
    DipCostSigns signs;
    bool done = dip_cost_duel_signs(&setup->duel, &signs, err);
    for (int i = 0; done && i <= count; i++) {
        // Row 0 is the baseline, which is side 0 of every pair.
        DipCostRow *row = &measured->rows[i];
        row->quality = i ? report->rows[rows[i - 1]].quality : report->options.baseline;
        dip_cost_setup_count(setup, i > 0, i ? i - 1 : 0, row->counters);
        row->time.ratio = dip_estimate_unknown(1.0);
        row->time.mean_ms.value = dip_cost_duel_mean_ms(&setup->duel, i > 0, i ? i - 1 : 0);
        done = i == 0 || dip_cost_duel_change(&setup->duel, i - 1, DIP_BENCH_STAGE_total,
                                              &row->time.ratio, err);
    }
    if (done) {
        measured->verdict = dip_cost_verdict_of(&signs, measured->verdict_reason);
    }
    return done;
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
    DipCostSetup *setup = setup_report(&all, program, report, rows, count);
    bool done = setup || out_of_memory(err);
    done = done && dip_cost_duel_run(&setup->def, &setup->duel, err) &&
           begin_report(report, setup, count, &all.session, measured, err) &&
           fill_report(report, setup, rows, count, measured, err);
    dip_cost_setup_free(setup);
    if (!done) {
        dip_cost_report_free(measured);
    }
    return done;
}
