// The answer at the top of the HTML page: the best settings for each time budget.
#include "app/report/page/html_parts.h"
#include "app/report/tiers.h"
#include "app/files/put.h"
#include "app/report/words.h"

// --- the answer ----------------------------------------------------------------------------------

static void write_ties(const DipCandidates *candidates, const DipAdvice *advice, FILE *out) {
    if (advice->tie_count == 0) {
        return;
    }
    dip_put_html(out, "<div><dt>As good within 1 %% of FLIP</dt><dd>%d more: ", advice->tie_count);
    for (int i = 0; i < advice->tie_count && i < DIP_ADVICE_TIES; i++) {
        dip_put_html(out, "%s", i > 0 ? "; " : "");
        dip_html_quality(&candidates->list[advice->ties[i]].quality, out);
    }
    dip_put_html(out, "%s</dd></div>\n", advice->tie_count > DIP_ADVICE_TIES ? "; &hellip;" : "");
}

// What the next better settings cost, in the kind of time of the budget.
static void write_next(const DipCandidates *candidates, const DipAdvice *advice, FILE *out) {
    char ms[DIP_NUMBER_BYTES], flip[DIP_NUMBER_BYTES], fits[DIP_NUMBER_BYTES];
    dip_put_html(out, "<div><dt>Next better</dt><dd>");
    if (advice->next < 0) {
        dip_put_html(out, "nothing that was measured</dd></div>\n");
        return;
    }
    const DipCandidate *next = &candidates->list[advice->next];
    dip_number_text(advice->next_ms, 2, true, "-", ms);
    dip_number_text(next->flip - candidates->list[advice->chosen].flip, 4, true, "-", flip);
    dip_fits_text(advice->next_fits, fits);
    dip_html_quality(&next->quality, out);
    dip_put_html(out, ": %s ms %s, FLIP %s; fits with %s</dd></div>\n", ms,
                 dip_time_kind_names[candidates->kind], flip, fits);
}

static void write_chosen(const DipCostReport *report, const DipAdvice *advice, FILE *out) {
    const DipCandidates *candidates = &report->choice.candidates;
    const DipCandidate *chosen = &candidates->list[advice->chosen];
    const DipEstimate time = dip_estimate_widen(&chosen->time, chosen->common_error);
    char text[256], fits[DIP_NUMBER_BYTES];
    dip_fits_text(advice->fits, fits);
    dip_put_html(out, "<p class=\"chosen\">");
    dip_html_quality(&chosen->quality, out);
    dip_put_html(
        out,
        "</p>\n<dl class=\"facts\">\n<div><dt>Time</dt><dd>%.2f ms %s along the path, %.2f to "
        "%.2f; mean %.2f ms</dd></div>\n<div><dt>Fits</dt><dd>with %s</dd></div>\n"
        "<div><dt>Error</dt><dd>FLIP %.4f",
        time.value, dip_time_kind_names[candidates->kind], time.low, time.high,
        dip_cost_ms(report, chosen->row), fits, chosen->flip);
    const double base = dip_cost_row_metrics(report, report->base_rows[0], 0).flip;
    if (base > 0.0) {
        dip_number_text(100.0 * (chosen->flip / base - 1.0), 0, true, "-", fits);
        dip_put_html(out, ", %s %% against the baseline's %.4f", fits, base);
    }
    dip_put_html(out, "</dd></div>\n");
    write_ties(candidates, advice, out);
    write_next(candidates, advice, out);
    dip_quality_format(&chosen->quality, text, sizeof text);
    dip_put_html(
        out, "<div><dt>Line for the ini</dt><dd class=\"code\">REQUESTED: %s</dd></div>\n</dl>\n",
        text);
}

static void write_nothing(const DipCandidates *candidates, const DipAdvice *advice, FILE *out) {
    char fits[DIP_NUMBER_BYTES];
    const DipCandidate *fastest = &candidates->list[advice->next];
    dip_fits_text(advice->next_fits, fits);
    dip_put_html(out, "<p>Nothing that was measured surely fits. The fastest settings, ");
    dip_html_quality(&fastest->quality, out);
    dip_put_html(out, ", take %.2f ms %s and fit with %s.</p>\n", fastest->time.value,
                 dip_time_kind_names[candidates->kind], fits);
}

// --- tiers ---------------------------------------------------------------------------------------

static void write_tier(const char *name, const DipCostTier *tier, FILE *out) {
    char text[256] = "", ms[DIP_NUMBER_BYTES];
    if (tier->quality) {
        dip_quality_format(tier->quality, text, sizeof text);
    }
    dip_budget_ms_text(tier->budget_ms, ms);
    dip_html_line_begin(out, tier->row);
    dip_put_html(out, "<th scope=\"row\">%s</th><td>%s</td><td class=\"l code\">%s%s</td></tr>\n",
                 name, ms, tier->quality ? "REQUESTED: " : "nothing is surely that fast", text);
}

// Four budgets make the four tiers of a settings menu.
static void write_tiers(const DipCostReport *report, FILE *out) {
    DipCostTier tiers[DIP_COST_TIER_COUNT];
    if (!dip_cost_tiers_of(report, tiers)) {
        return;
    }
    dip_html_table_begin(out, "tiers", NULL);
    dip_put_html(out, "The four budgets as the tiers of a settings menu, with lines for the ini.");
    dip_html_columns_begin(out);
    dip_html_text_column(out, "tier");
    dip_html_column(out, "budget", "ms");
    dip_html_text_column(out, "line of the ini");
    dip_html_columns_end(out);
    for (int i = 0; i < DIP_COST_TIER_COUNT; i++) {
        write_tier(dip_cost_tier_names[i], &tiers[i], out);
    }
    dip_html_table_end(out);
}

void dip_html_advice(const DipCostReport *report, FILE *out) {
    const DipCostChoice *choice = &report->choice;
    if (choice->candidates.disturbed && choice->candidates.count > 0) {
        dip_put_html(out,
                     "<h2 id=\"advice\">No advice</h2>\n<p>The machine was too busy: the times are "
                     "wrong, so no settings are advised. ");
        dip_put_html(out, "%s", report->verdict_reason);
        dip_put_html(out, "</p>\n");
        return;
    }
    for (int i = 0; i < choice->advice_count; i++) {
        char budget[DIP_BUDGET_BYTES];
        dip_budget_text(choice->advice[i].budget_ms, budget);
        dip_put_html(out, "<section class=\"answer\">\n<h2%s>%s on this machine</h2>\n",
                     i == 0 ? " id=\"advice\"" : "", budget);
        if (choice->advice[i].chosen >= 0) {
            write_chosen(report, &choice->advice[i], out);
        } else {
            write_nothing(&choice->candidates, &choice->advice[i], out);
        }
        dip_put_html(out, "</section>\n");
    }
    if (choice->advice_count > 0) {
        dip_put_html(
            out,
            "<p class=\"note\">Advised is the least FLIP whose %s time along path %s is within "
            "the budget with at least 95 %%; of settings within 1 %% of it, the fastest. "
            "&ldquo;Next better&rdquo; is the fastest combination whose FLIP is at least 1 %% "
            "below that of the advised one.</p>\n",
            dip_time_kind_names[choice->candidates.kind], report->paths[0]);
        write_tiers(report, out);
    }
}
