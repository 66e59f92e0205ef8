// Printing predictions of times elsewhere, and writing them as JSON and CSV.
#include "app/cost/predict/predict_elsewhere.h"

#include "app/report/format/cost_fields.h"
#include "app/report/verdict.h"
#include "app/files/whole_file.h"
#include "app/files/put.h"

// --- the table -----------------------------------------------------------------------------------

static void print_place(const char *what, const DipCostReport *place, FILE *out) {
    dip_put_text(out, "%-8s %dx%d pixels, path %s, %d thread%s, %s\n", what, place->width,
                 place->height, place->paths[0], place->threads, dip_cost_plural(place->threads),
                 place->isa);
}

static void print_misses(const char *what, const DipCostMisses *misses, FILE *out) {
    dip_put_text(out, "         %-46s median %5.1f %%, 90 %% within %5.1f %%\n", what,
                 100.0 * misses->median, 100.0 * misses->p90);
}

static void print_checks(const DipCostElsewherePrediction *p, FILE *out) {
    static const char alone[] = "the report alone misses them by";
    if (p->timed_count > 0) {
        dip_put_text(
            out,
            "timed    %d combination%s there, beside the report's baseline: %s %.3f times as long "
            "as the report alone predicts\n",
            p->timed_count, dip_cost_plural(p->timed_count),
            p->timed_count == 1 ? "it takes" : "they take", p->factor);
        print_misses(alone, &p->timed_as_is, out);
        print_misses("each predicted from the report and the others", &p->timed_left_out, out);
    } else {
        dip_put_text(out, "timed    nothing: the predictions come from the report alone\n");
    }
    if (p->checked_count > 0) {
        dip_put_text(out, "checked  %d other combination%s there\n", p->checked_count,
                     dip_cost_plural(p->checked_count));
        print_misses(alone, &p->checked_as_is, out);
        if (p->timed_count > 0) {
            print_misses("the predictions miss them by", &p->checked_fitted, out);
        }
    }
    if (p->wait > dip_cost_wait_limits.green) {
        dip_put_text(out,
                     "warning  the threads waited %.0f %% of their time for a core, which other "
                     "programs held, so the times that were taken there are %s\n",
                     100.0 * p->wait, p->wait > dip_cost_wait_limits.red ? "wrong" : "less sure");
    }
}

static void print_combination(const DipCostElsewherePrediction *p, const DipCostPredictedThere *c,
                              FILE *out) {
    char text[DIP_COST_TEXT];
    dip_cost_settings_text(&c->quality, text);
    dip_put_text(out, "  %-34s %9.2f %9.2f", text, c->report_ms, c->ms);
    if (c->timed >= 0) {
        const DipEstimate *ms = &p->timed[c->timed].ms;
        dip_put_text(out, " %9.2f %8.2f to %.2f", ms->value, ms->low, ms->high);
    }
    dip_put_text(out, "\n");
}

void dip_cost_predict_there_print(const DipCostElsewherePrediction *p, FILE *out) {
    dip_put_text(out, "scene    %s\n", p->report.scene);
    print_place("report", &p->report, out);
    print_place("there", &p->there, out);
    dip_put_text(out, "model    prices of work from %d row%s", p->report.row_count,
                 dip_cost_plural(p->report.row_count));
    if (p->report.smaller_count > 0) {
        dip_put_text(out, " and %d at %dx%d", p->report.smaller_count, p->report.smaller_width,
                     p->report.smaller_height);
    }
    dip_put_text(out, " of the report\n");
    print_misses("each row predicted from the others", &p->fit, out);
    print_checks(p, out);
    const bool any_timed = p->timed_count + p->checked_count > 0;
    dip_put_text(out, "\nMean times of a frame, in milliseconds of the report's run:\n");
    dip_put_text(out, "  %-34s %9s %9s%s\n", "combination", "report", "predicted",
                 any_timed ? "     timed 95 % interval" : "");
    for (int i = 0; i < p->count; i++) {
        print_combination(p, &p->list[i], out);
    }
}

// --- files ---------------------------------------------------------------------------------------

// The context of all items is the prediction.
static const DipCostElsewherePrediction *prediction_of(const DipFieldAt *at) {
    return at->context;
}

static const void *derive_what(const DipFieldAt *at, DipFieldScratch *scratch) {
    (void)at;
    (void)scratch;
    return "diptych cost predict";
}

static const void *derive_there(const DipFieldAt *at, DipFieldScratch *scratch) {
    (void)scratch;
    return &prediction_of(at)->there;
}

static const void *derive_role(const DipFieldAt *at, DipFieldScratch *scratch) {
    const int timed = ((const DipCostPredictedThere *)at->item)->timed;
    (void)scratch;
    return timed < 0 ? "predicted" : timed < prediction_of(at)->timed_count ? "timed" : "checked";
}

static const void *derive_timed(const DipFieldAt *at, DipFieldScratch *scratch) {
    const int timed = ((const DipCostPredictedThere *)at->item)->timed;
    (void)scratch;
    return timed >= 0 ? &prediction_of(at)->timed[timed] : NULL;
}

static const DipField place_fields[] = {
    {"width", NULL, "px", "Width of the pictures.", DIP_FACT(WHOLE, DipCostReport, width)},
    {"height", NULL, "px", "Height of the pictures.", DIP_FACT(WHOLE, DipCostReport, height)},
    {"path", NULL, NULL, "The camera path.", DIP_FACT(TEXT, DipCostReport, paths[0])},
    {"threads", NULL, NULL, "Number of threads.", DIP_FACT(WHOLE, DipCostReport, threads)},
    {"isa", NULL, NULL, "Instruction set.", DIP_FACT(TEXT, DipCostReport, isa)},
};
static const DipRecord place_record =
    DIP_RECORD("place", "Where something is drawn.", place_fields, DipCostReport, NULL);

static const DipField there_fields[] = {
    {"settings", "combination", NULL, "All quality settings.",
     DIP_FACT(SETTINGS, DipCostPredictedThere, quality)},
    {"role", NULL, NULL, "Whether the combination was predicted, timed or checked.",
     DIP_DERIVED(TEXT, derive_role)},
    {"report_ms", "report", "ms", "Mean time in the report: measured, or predicted there.",
     DIP_FACT(NUMBER, DipCostPredictedThere, report_ms), .digits = 2},
    {"report_alone_ms", NULL, "ms", "Mean time predicted from the report alone.",
     DIP_FACT(NUMBER, DipCostPredictedThere, as_is_ms), .digits = 2},
    {"ms", "predicted", "ms", "Mean time predicted from the report and from what was timed there.",
     DIP_FACT(NUMBER, DipCostPredictedThere, ms), .digits = 2},
    {"timed", NULL, NULL, "What was timed there; null otherwise.",
     DIP_DERIVED(RECORD, derive_timed), .record = &dip_cost_elsewhere_record},
    {"there", NULL, NULL, "The place.", .kind = DIP_FIELD_RECORD, .derive = derive_there,
     .record = &place_record},
};
static const DipRecord there_record = DIP_RECORD(
    "combination there", "A combination of the report.", there_fields, DipCostPredictedThere, NULL);

#define MISSES(name, MEMBER, means)                                                                \
    {                                                                                              \
        name, NULL, NULL, means, DIP_FACT(RECORD, DipCostElsewherePrediction, MEMBER),             \
            .record = &dip_cost_misses_record                                                      \
    }
static const DipField misses_fields[] = {
    MISSES("report_rows_left_out", fit, "Each row of the report predicted from the others."),
    MISSES("timed_by_report_alone", timed_as_is, "What was timed, predicted by the report alone."),
    MISSES("timed_left_out", timed_left_out, "Each that was timed, predicted from the others."),
    MISSES("checked_by_report_alone", checked_as_is,
           "What was checked, predicted by the report alone."),
    MISSES("checked", checked_fitted, "What was checked, predicted from all."),
};
static const DipRecord misses_record =
    DIP_RECORD("misses there", "How well it did.", misses_fields, DipCostElsewherePrediction, NULL);

static const DipField prediction_fields[] = {
    {"what", NULL, NULL, "The command.", DIP_DERIVED(TEXT, derive_what)},
    {"format", NULL, NULL, "The format of the file.", DIP_DERIVED(WHOLE, dip_cost_derive_format)},
    {"scene", NULL, NULL, "Name of the scene.",
     DIP_FACT(TEXT, DipCostElsewherePrediction, report.scene)},
    {"scene_hash", NULL, NULL, "Hash of the scene.",
     DIP_FACT(TEXT, DipCostElsewherePrediction, report.scene_hash)},
    {"report", NULL, NULL, "Where the report was measured.",
     DIP_FACT(RECORD, DipCostElsewherePrediction, report), .record = &place_record},
    {"there", NULL, NULL, "What is predicted.", DIP_FACT(RECORD, DipCostElsewherePrediction, there),
     .record = &place_record},
    {"factor", NULL, NULL, "How many times as long as the report alone predicts it takes there.",
     DIP_FACT(NUMBER, DipCostElsewherePrediction, factor)},
    {"wait", NULL, NULL, "Share of their time that threads waited for a processor.",
     DIP_FACT(NUMBER, DipCostElsewherePrediction, wait)},
    {"misses", NULL, NULL, "How well it did.", .kind = DIP_FIELD_RECORD, .where = DIP_FIELD_JSON,
     .record = &misses_record},
    {"combinations", NULL, NULL, "The combinations.", .kind = DIP_FIELD_LIST,
     .where = DIP_FIELD_JSON,
     .list = &(const DipFieldList){.record = &there_record,
                                   .items = offsetof(DipCostElsewherePrediction, list),
                                   .points = true,
                                   .counted = offsetof(DipCostElsewherePrediction, count)}},
};
const DipRecord dip_cost_prediction_record =
    DIP_RECORD("prediction elsewhere", "What `diptych cost predict --json` writes.",
               prediction_fields, DipCostElsewherePrediction, NULL);

static bool print_json(const void *context, FILE *out) {
    dip_fields_print_json(&dip_cost_prediction_record,
                          &(DipFieldAt){(void *)context, context, 0, NULL}, out);
    return true;
}

bool dip_cost_predict_there_write_json(const DipCostElsewherePrediction *p, const char *file,
                                       DipError *err) {
    return dip_whole_file_print(file, print_json, p, err);
}

static bool print_csv(const void *context, FILE *out) {
    static const DipColumn columns[] = {{"there.width", "width"},
                                        {"there.height", "height"},
                                        {"there.path", "path"},
                                        {"there.threads", "threads"},
                                        {"settings", NULL},
                                        {"role", NULL},
                                        {"report_ms", NULL},
                                        {"report_alone_ms", NULL},
                                        {"ms", NULL},
                                        {"timed.ms", NULL}};
    const DipCostElsewherePrediction *p = context;
    for (int i = -1; i < p->count; i++) {
        const DipFieldAt at = {(void *)context, i < 0 ? NULL : &p->list[i], i, NULL};
        dip_fields_print_csv(&there_record, &at, columns, DIP_FIELD_COUNT_OF(columns), out);
    }
    return true;
}

bool dip_cost_predict_there_write_csv(const DipCostElsewherePrediction *p, const char *file,
                                      DipError *err) {
    return dip_whole_file_print(file, print_csv, p, err);
}
