// Writes the sections of a report, and prints a report for a terminal.
#include "app/report/format/sections.h"

#include "app/report/analysis.h"
#include "app/report/format/formats.h"
#include "app/report/words.h"

#include <math.h>
#include <string.h>

// --- the answer ----------------------------------------------------------------------------------

static double flip_of(const DipCostReport *report, int row) {
    return dip_cost_row_metrics(report, row).flip;
}

void dip_section_ties(DipForm *form, const DipCandidates *candidates, const DipAdvice *advice) {
    char list[DIP_ADVICE_TIES * (DIP_COST_TEXT + 2)] = "";
    size_t length = 0;
    for (int i = 0; i < advice->tie_count && i < DIP_ADVICE_TIES; i++) {
        char settings[DIP_COST_TEXT];
        dip_cost_settings_text(&candidates->list[advice->ties[i]].quality, settings);
        length += (size_t)snprintf(list + length, sizeof list - length, "%s%s", i > 0 ? "; " : "",
                                   settings);
    }
    if (advice->tie_count > 0) {
        dip_form_fact(form, "As good", "%d more within 1 %% of FLIP: %s%s", advice->tie_count, list,
                      advice->tie_count > DIP_ADVICE_TIES ? "; ..." : "");
    }
}

// Writes what the next better settings cost, in the kind of time (such as p95) that the budget
// limits.
static void write_next(DipForm *form, const DipCandidates *candidates, const DipAdvice *advice) {
    char text[DIP_COST_TEXT], ms[DIP_NUMBER_BYTES], flip[DIP_NUMBER_BYTES], fits[DIP_NUMBER_BYTES];
    if (advice->next < 0) {
        dip_form_fact(form, "Next better", "nothing that was measured");
        return;
    }
    const DipCandidate *next = &candidates->list[advice->next];
    dip_cost_settings_text(&next->quality, text);
    dip_number_text(advice->next_ms, 2, true, "-", ms);
    dip_number_text(next->flip - candidates->list[advice->chosen].flip, 4, true, "-", flip);
    dip_fits_text(advice->next_fits, fits);
    dip_form_fact(form, "Next better", "%s: %s ms %s, FLIP %s; fits with %s", text, ms,
                  dip_time_kind_names[candidates->kind], flip, fits);
}

void dip_section_ini(DipForm *form, const DipQuality *quality) {
    char text[DIP_SETTINGS_BYTES + 16] = "REQUESTED: ";
    dip_quality_format(quality, text + strlen(text), DIP_SETTINGS_BYTES);
    dip_form_code(form, "Line for ini", text);
}

// Returns the settings in which some combination differs from the baseline (bit s for setting s).
static unsigned varied_settings(const DipCostReport *report) {
    const DipCostPredictions *predicted = &report->predicted;
    const int rows = report->row_count - report->combined_first;
    unsigned varied = 0;
    for (int i = 0; i < (predicted->count > 0 ? predicted->count : rows); i++) {
        const DipQuality *quality = predicted->count > 0
                                        ? &predicted->list[i].quality
                                        : &report->rows[report->combined_first + i].quality;
        for (int s = 0; s < DIP_SETTING_COUNT; s++) {
            varied |= (unsigned)(quality->step[s] != report->options.baseline.step[s]) << s;
        }
    }
    return varied;
}

// Writes among which combinations the advice was chosen.
static void write_searched(DipForm *form, const DipCostReport *report) {
    const DipCostPredictions *predicted = &report->predicted;
    const unsigned varied = varied_settings(report);
    const int measured = report->choice.candidates.count;
    char idle[DIP_COST_TEXT] = "";
    int settings = 0;
    for (int s = 0; s < DIP_SETTING_COUNT; s++) {
        settings += (int)(varied >> s & 1);
    }
    for (int i = 0; predicted->count > 0 && i < report->sweep_count; i++) {
        const DipSetting setting = report->sweeps[i].setting;
        if (!(varied >> setting & 1)) {
            const size_t length = strlen(idle);
            snprintf(idle + length, sizeof idle - length, "%s%s", length > 0 ? ", " : "",
                     dip_setting_info(setting)->key);
        }
    }
    if (settings == 0) {
        dip_form_fact(form, "Best of", "one combination%s",
                      idle[0] ? ": no setting changes a picture here" : "");
    } else if (predicted->count > 0) {
        dip_form_fact(form, "Best of", "%d combinations of %d settings: all predicted, %d measured",
                      dip_cost_searched(report), settings, measured);
    } else {
        dip_form_fact(form, "Best of", "%d combinations of %d settings: all measured", measured,
                      settings);
    }
    if (idle[0] && settings > 0) {
        dip_form_fact(form, "Not combined", "%s: no step changes a picture here", idle);
    }
}

static void write_chosen(DipForm *form, const DipCostReport *report, const DipAdvice *advice) {
    const DipCandidates *candidates = &report->choice.candidates;
    const DipCandidate *chosen = &candidates->list[advice->chosen];
    const DipEstimate time = dip_estimate_widen(&chosen->time, chosen->common_error);
    const double base = flip_of(report, report->base_rows[0]);
    const DipLimits budget = {&advice->budget_ms, 1, false}; // Nothing doubtful is advised.
    char text[300], fits[DIP_NUMBER_BYTES], against[96] = "", ms[DIP_NUMBER_BYTES];
    char interval[DIP_CELL_BYTES], mean[DIP_NUMBER_BYTES];
    dip_cost_settings_text(&chosen->quality, text);
    dip_form_paragraph(form, "chosen", "%s", text);
    dip_limited_number(time.value, 2, false, budget, "-", ms);
    dip_field_interval_text(&(DipField){.unit = "ms", .digits = 2}, budget, &time, interval);
    dip_limited_number(dip_cost_ms(report, chosen->row), 2, false, budget, "-", mean);
    dip_form_fact(form, "Time", "%s ms %s along the path (%s), mean %s ms", ms,
                  dip_time_kind_names[candidates->kind], interval, mean);
    dip_fits_text(advice->fits, fits);
    dip_form_fact(form, "Fits", "with %s", fits);
    if (base > 0.0) {
        dip_number_text(100.0 * (chosen->flip / base - 1.0), 0, true, "-", fits);
        snprintf(against, sizeof against, ", %s %% against the baseline's %.4f", fits, base);
    }
    dip_form_fact(form, "Error", "FLIP %.4f%s", chosen->flip, against);
    write_searched(form, report);
    dip_section_ties(form, candidates, advice);
    write_next(form, candidates, advice);
    dip_section_ini(form, &chosen->quality);
}

static void write_nothing(DipForm *form, const DipCandidates *candidates, const DipAdvice *advice) {
    char text[DIP_COST_TEXT], fits[DIP_NUMBER_BYTES], ms[DIP_NUMBER_BYTES];
    const DipCandidate *fastest = &candidates->list[advice->next];
    dip_cost_settings_text(&fastest->quality, text);
    dip_limited_number(fastest->time.value, 2, false, (DipLimits){&advice->budget_ms, 1, false},
                       "-", ms);
    dip_fits_text(advice->next_fits, fits);
    dip_form_paragraph(form, NULL,
                       "Nothing that was measured surely fits. The fastest settings, %s, take %s "
                       "ms %s and fit with %s.",
                       text, ms, dip_time_kind_names[candidates->kind], fits);
}

static const char *const tier_names[DIP_COST_TIER_COUNT] = {"low", "medium", "high", "ultra"};

DIP_DERIVE(derive_tier, tier_names[at->index])
static const void *derive_line(const DipFieldAt *at, DipFieldScratch *scratch) {
    const DipQuality *quality = ((const DipCostTier *)at->item)->quality;
    strcpy(scratch->text, quality ? "REQUESTED: " : "nothing surely fits");
    if (quality) {
        dip_quality_format(quality, scratch->text + strlen(scratch->text), DIP_SETTINGS_BYTES);
    }
    return scratch->text;
}

static const DipField tier_fields[] = {
    {"tier", NULL, NULL, "Name of the tier.", DIP_DERIVED(TEXT, derive_tier)},
    {"budget", NULL, "ms", "The time that a frame may take.",
     DIP_FACT(NUMBER, DipCostTier, budget_ms), .digits = 3, .show = DIP_SHOW_FIGURES},
    {"line", "line for ini", NULL, "The best settings.", DIP_DERIVED(TEXT, derive_line),
     .show = DIP_SHOW_CODE},
};
static const DipRecord tier_record =
    DIP_RECORD("tier", "A tier of a settings menu.", tier_fields, DipCostTier, NULL);

void dip_section_tiers(DipForm *form, DipCostTier *tiers, int count) {
    if (count != DIP_COST_TIER_COUNT) {
        return;
    }
    for (int i = 1; i < count; i++) {
        const DipCostTier tier = tiers[i];
        int at = i;
        for (; at > 0 && tiers[at - 1].budget_ms > tier.budget_ms; at--) {
            tiers[at] = tiers[at - 1];
        }
        tiers[at] = tier;
    }
    DIP_FORM_TABLE(form, .id = "tiers",
                   .caption = "The four budgets as the tiers of a settings menu.",
                   .record = &tier_record, .columns = "tier; budget; line", .items = tiers,
                   .count = count, .row = &tiers->row);
}

static void write_advice(DipForm *form, const DipCostReport *report, int index) {
    const DipAdvice *advice = &report->choice.advice[index];
    char budget[DIP_BUDGET_BYTES];
    dip_budget_text(advice->budget_ms, budget);
    dip_form_heading(form, index == 0 ? "advice" : NULL, "%s on this machine", budget);
    if (advice->chosen >= 0) {
        write_chosen(form, report, advice);
    } else {
        write_nothing(form, &report->choice.candidates, advice);
    }
}

void dip_section_answer(DipForm *form, const DipCostReport *report) {
    const DipCostChoice *choice = &report->choice;
    DipCostTier tiers[DIP_COST_MAX_BUDGETS];
    if (choice->candidates.disturbed && choice->candidates.count > 0) {
        dip_form_heading(form, "advice", "No advice");
        dip_form_paragraph(form, NULL,
                           "The machine was too busy: the times are wrong, so no settings are "
                           "advised. %s",
                           report->verdict_reason);
        dip_form_paragraph(form, NULL,
                           "What to do: close other programs and give the same command again. With "
                           "--quick, the machine must be quiet for a shorter time. If nothing else "
                           "runs here, other users of the same computer may, as on a virtual "
                           "machine: try again later. All errors below are right.");
        return;
    }
    for (int i = 0; i < choice->advice_count; i++) {
        const DipCandidate *chosen = dip_cost_chosen(report, i);
        write_advice(form, report, i);
        tiers[i] = (DipCostTier){choice->advice[i].budget_ms, chosen ? &chosen->quality : NULL,
                                 chosen ? chosen->row : -1};
    }
    if (form->is_page && choice->advice_count > 0) {
        dip_form_paragraph(form, "note",
                           "Advised is the least FLIP whose %s time along path %s is within the "
                           "budget with at least 95 %%. Of the settings within 1 %% of that FLIP "
                           "whose times cannot be told from the fastest one's, it is the set that "
                           "leaves most settings at their defaults. \u201cNext better\u201d is the "
                           "fastest combination whose FLIP "
                           "is at least 1 %% below that of the advised one.",
                           dip_time_kind_names[choice->candidates.kind], report->paths[0]);
    }
    dip_section_tiers(form, tiers, choice->advice_count);
}

// --- the front -----------------------------------------------------------------------------------

void dip_section_front(DipForm *form, const DipCostReport *report) {
    const DipCostChoice *choice = &report->choice;
    DipCostLine lines[DIP_COST_MAX_ROWS];
    char caption[512], columns[160];
    if (choice->candidates.disturbed) {
        DIP_FORM_TABLE(
            form, .id = "pareto-front", .set = "front",
            .caption = "Combinations from the fastest to the one with the least FLIP. Each has "
                       "at least 1 % less FLIP than the line before. The order comes from times "
                       "of a busy machine: neighbours may be in the wrong order.",
            .columns = "settings; number; row.figures.all.flip; "
                       "row.over_time.flicker_rms_lin; change_flip",
            DIP_COST_LINES(report, lines, dip_cost_front_lines(report, lines)));
        return;
    }
    snprintf(
        columns, sizeof columns,
        "settings; number; time.value=%s; row.figures.all.flip; row.over_time.flicker_rms_lin; "
        "change_ms; change_flip; price_ms",
        dip_time_kind_names[choice->candidates.kind]);
    snprintf(caption, sizeof caption,
             "The Pareto front of %d measured combination%s on path %s: no other combination has "
             "less %s time and less FLIP. The FLIP of each is at least 1 %% below that of the line "
             "before, from which it changes.%s",
             choice->candidates.count, dip_cost_plural(choice->candidates.count), report->paths[0],
             dip_time_kind_names[choice->candidates.kind],
             choice->knee >= 0 ? " Beyond the knee, more time buys least." : "");
    DIP_FORM_TABLE(form, .id = "pareto-front", .caption = caption, .set = "front",
                   .columns = columns,
                   DIP_COST_LINES(report, lines, dip_cost_front_lines(report, lines)));
}

void dip_section_same(DipForm *form, const DipCostReport *report) {
    if (report->same_count == 0) {
        return;
    }
    if (!form->is_page) {
        dip_form_paragraph(form, NULL,
                           "%d more combinations draw the same pictures as one with fewer settings "
                           "off their defaults; cost.json lists them.",
                           report->same_count);
        return;
    }
    DIP_FORM_TABLE(form, .id = "same-pictures",
                   .caption = "Each of these combinations draws the same pictures, by hash, at all "
                              "viewpoints as one with fewer settings off their defaults.",
                   .record = &dip_cost_same_record, .columns = "settings; same_as",
                   .context = (void *)report, .items = report->same, .count = report->same_count,
                   .row = &report->same->row);
}

// --- what was measured ---------------------------------------------------------------------------

static void write_facts(DipForm *form, const DipCostReport *report) {
    const DipCostOptions *o = &report->options;
    char baseline[DIP_COST_TEXT];
    dip_cost_settings_text(&o->baseline, baseline);
    dip_form_fact(form, "Scene", "%s", report->scene);
    dip_form_fact(form, "Picture", "%dx%d pixels", report->width, report->height);
    dip_form_fact(form, "Processor", "%s", report->processor);
    dip_form_fact(form, "Renderer", "%d thread%s, %s", report->threads,
                  dip_cost_plural(report->threads), report->isa);
    if (report->date[0]) {
        dip_form_fact(form, "Measured", "%s, by Diptych %s", report->date, report->version);
    } else {
        dip_form_fact(form, "Version", "Diptych %s", report->version);
    }
    if (report->several_builds) {
        dip_form_fact(form, "Warning",
                      "The parts of this report were measured by different builds of Diptych, so "
                      "their errors may be those of different pictures.");
    }
    const int warnings = report->warning_count + report->warnings_left_out;
    if (warnings > 0) {
        dip_form_fact(form, "Warnings", "%d when the scene was loaded%s", warnings,
                      form->is_page ? "" : "; cost.json and cost.html list them");
    }
    dip_form_fact(form, "Baseline", "%s", baseline);
    if (report->rounds > 0) {
        dip_form_fact(form, "Times",
                      "%d frames along each path in %d rounds of random order, each beside the "
                      "baseline; ratio = time / the baseline's time",
                      dip_cost_frame_count(report), report->rounds);
    }
    dip_form_fact(form, "Errors", "%d viewpoint%s on each path, %d successive frame%s at each",
                  o->places, dip_cost_plural(o->places), o->burst, dip_cost_plural(o->burst));
    dip_form_fact(form, "Truth", "the converged picture: 2 x %d samples per pixel", o->samples);
}

void dip_section_measured(DipForm *form, const DipCostReport *report) {
    DipCostLine lines[DIP_COST_MAX_PATHS];
    dip_form_heading(form, "measured", "What was measured");
    write_facts(form, report);
    if (report->rounds == 0) {
        return;
    }
    const char *verdict = dip_cost_verdict_names[report->verdict];
    char level[DIP_COST_REASON], style[32];
    dip_cost_level_text(report, level);
    snprintf(style, sizeof style, "verdict %s", verdict);
    dip_form_paragraph(
        form, style, "The machine was %s. %s%s %s", verdict, report->verdict_reason,
        report->verdict == DIP_COST_RED ? " The times are wrong, and no settings are advised." : "",
        level);
    const int count = dip_cost_same_lines(report, lines);
    // These ratios say how wrong the times are, so they keep their digits on a busy machine.
    DIP_FORM_TABLE(form, .id = "baseline-twice",
                   .caption =
                       "On each path, the baseline was timed a second time as if it were another "
                       "setting (A/A). Differences between settings that are smaller are noise.",
                   .columns = "path; ratio", .record = &dip_cost_line_record,
                   .context = (void *)report, .row = &lines->row, .items = lines, .count = count);
}

// --- predictions ---------------------------------------------------------------------------------

void dip_section_misses(DipForm *form, const char *what, const DipCostMisses *misses) {
    if (misses->rows > 0) {
        dip_form_fact(form, what, "missed by %.1f %% in the median, 90 %% by at most %.1f %%",
                      100.0 * misses->median, 100.0 * misses->p90);
    }
}

void dip_section_predictions(DipForm *form, const DipCostReport *report) {
    const DipCostPredictions *p = &report->predicted;
    if (p->count <= 1) {
        return;
    }
    char then[128] = "None of the others was measured afterwards.";
    if (p->times.rows > 0) {
        snprintf(then, sizeof then,
                 "The %d combinations that the prediction found best were then measured.",
                 p->times.rows);
    }
    dip_form_heading(form, "predicted", "Predicted combinations");
    dip_form_paragraph(
        form, NULL,
        "The times and errors of %d combinations on path %s were predicted from %d "
        "measured ones. %s The table also tells how well each of the combinations that were "
        "measured first is predicted from the others of these.%s",
        dip_cost_searched(report), report->paths[0], p->trained, then,
        p->count > DIP_COST_MOST_COUNTED
            ? " The work of combinations was composed from the work of those that change fewer "
              "settings."
            : "");
    dip_section_misses(form, "Times", &p->times);
    dip_section_misses(form, "FLIP", &p->errors);
    dip_section_misses(form, "Times, first", &p->times_left_out);
    dip_section_misses(form, "FLIP, first", &p->errors_left_out);
    dip_form_end(form);
}

// --- the rest ------------------------------------------------------------------------------------

void dip_section_interactions(DipForm *form, const DipCostReport *report) {
    if (!report->analysis || report->analysis->interaction_count == 0) {
        return;
    }
    dip_form_heading(form, "interactions", "Two settings together");
    DIP_FORM_TABLE(
        form, .id = "interaction-table",
        .caption = "Two settings at their last steps, against each alone: means over the "
                   "combinations of the other settings. A time above 1 means that both together "
                   "cost more than the product of their ratios. A FLIP above 0 means that both "
                   "together lower FLIP by less than the sum of what each lowers it.",
        .record = &dip_cost_interaction_record,
        .columns = "a=setting; b=with; time; flip; combinations", .context = (void *)report,
        .limits = dip_cost_budgets(report), .items = report->analysis->interactions,
        .count = report->analysis->interaction_count);
}

void dip_section_sweep(DipForm *form, const DipCostReport *report, int sweep) {
    DipCostLine lines[DIP_COST_MAX_SWEEP_ROWS];
    char id[32], set[32], title[DIP_COST_TEXT], caption[DIP_COST_TEXT + 64],
        order[2 * DIP_COST_TEXT];
    snprintf(id, sizeof id, "steps-%d", sweep);
    snprintf(set, sizeof set, "sweep-%d", sweep);
    dip_cost_sweep_title(report, &report->sweeps[sweep], title);
    snprintf(caption, sizeof caption, "%s on path %s: times and errors of each step", title,
             report->paths[report->sweeps[sweep].path]);
    DIP_FORM_TABLE(form, .id = id, .caption = caption, .set = set,
                   .columns =
                       "step; row.ms.value; row.p95_ms.value; ratio; row.figures.all.rmse_lin; "
                       "row.figures.all.psnr_db; row.figures.all.ssim; row.figures.all.flip; "
                       "row.over_time.flicker_rms_lin; row.over_time.two_frame_mean_rms_lin; "
                       "row.at_floor=noise floor",
                   DIP_COST_LINES(report, lines, dip_cost_step_lines(report, sweep, lines)));
    if (dip_cost_order_text(report, &report->sweeps[sweep], order, sizeof order)) {
        dip_form_paragraph(form, "note", "%s", order);
    }
}

DIP_OF_ITEM(bool, has_price, ((const DipCostFit *)at->item)->ns[at->index] > 0.0)

void dip_section_fit(DipForm *form, const DipCostReport *report) {
    const DipCostFit *fit = report->analysis ? &report->analysis->fit : NULL;
    char smaller[64] = "", caption[512];
    if (!fit || fit->rows == 0) {
        return;
    }
    if (report->smaller_count > 0) {
        snprintf(smaller, sizeof smaller, " and of %d combinations at %dx%d", report->smaller_count,
                 report->smaller_width, report->smaller_height);
    }
    snprintf(caption, sizeof caption,
             "A linear fit explains the times of the stages of %d rows%s by their work: R\u00b2 is "
             "%.3f, the median error is %.1f %%. If each row is predicted from all others, the "
             "median error is %.1f %%, and %.0f %% of the rows are predicted within 10 %%.",
             fit->rows, smaller, fit->r2, 100.0 * fit->median_miss, 100.0 * fit->others.median,
             100.0 * fit->others.within_10);
    DIP_FORM_TABLE(form, .id = "prices-of-work", .caption = caption,
                   .record = &dip_cost_price_record, .columns = "work; stage; ns",
                   .context = (void *)report, .items = fit, .count = fit->count,
                   .shows = has_price);
}

void dip_section_truth(DipForm *form, const DipCostReport *report) {
    DipCostLine lines[DIP_COST_MAX_PATHS];
    dip_form_heading(form, "truth", "The truth and its noise floor");
    DIP_FORM_TABLE(
        form, .id = "noise-floors",
        .caption =
            "What the truth's own noise makes of each metric. An RMSE below three times this one "
            "is \"at floor\", and combinations whose FLIP is below this one rank alike.",
        .columns = "path; floor.rmse_lin; floor.psnr_db; floor.ssim; floor.flip",
        DIP_COST_LINES(report, lines, dip_cost_floor_lines(report, lines)));
    if (report->refused_count > 0) {
        dip_form_heading(form, NULL, "Steps left out");
    }
    for (int i = 0; i < report->refused_count; i++) {
        dip_form_paragraph(form, NULL, "%s", report->refused[i]);
    }
}

void dip_cost_print(const DipCostReport *report, FILE *out) {
    DipForm form = {.out = out};
    dip_section_answer(&form, report);
    dip_section_front(&form, report);
    dip_section_same(&form, report);
    dip_section_measured(&form, report);
    dip_section_predictions(&form, report);
    dip_section_interactions(&form, report);
    for (int s = 0; s < report->sweep_count; s++) {
        dip_section_sweep(&form, report, s);
    }
    dip_section_fit(&form, report);
    dip_section_truth(&form, report);
    dip_form_end(&form);
}
