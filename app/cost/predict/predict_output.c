// Prints the times that combinations of a report are predicted to take under other conditions than
// the report's, and writes them as JSON and CSV. The conditions are the size of the pictures, the
// camera path, the threads and the instruction set. Together they are called a place, and the place
// that the times are predicted for is called "there" (predict_elsewhere.h).
#include "app/cost/predict/predict_elsewhere.h"

#include "app/files/whole_file.h"
#include "app/report/format/sections.h"
#include "app/report/verdict.h"

// --- fields --------------------------------------------------------------------------------------

// The context of all items is the prediction.
static const DipCostElsewherePrediction *prediction_of(const DipFieldAt *at) {
    return at->context;
}

static int timed_of(const DipFieldAt *at) {
    return ((const DipCostPredictedThere *)at->item)->timed;
}

DIP_DERIVE(derive_what, "diptych cost predict")
DIP_DERIVE(derive_there, &prediction_of(at)->there)
DIP_DERIVE(derive_role, timed_of(at) < 0                                ? "predicted"
                        : timed_of(at) < prediction_of(at)->timed_count ? "timed"
                                                                        : "checked")
DIP_DERIVE(derive_timed, timed_of(at) >= 0 ? &prediction_of(at)->timed[timed_of(at)] : NULL)

static const DipField place_fields[] = {
    {"width", NULL, "px", "Width of the pictures that are drawn there.",
     DIP_FACT(WHOLE, DipCostReport, width)},
    {"height", NULL, "px", "Height of the pictures that are drawn there.",
     DIP_FACT(WHOLE, DipCostReport, height)},
    {"path", NULL, NULL, "Camera path along which the frames are drawn.",
     DIP_FACT(TEXT, DipCostReport, paths[0])},
    {"threads", NULL, NULL, "Number of threads that draw the frames.",
     DIP_FACT(WHOLE, DipCostReport, threads)},
    {"isa", NULL, NULL, "Instruction set with which the frames are drawn.",
     DIP_FACT(TEXT, DipCostReport, isa)},
};
static const DipRecord place_record = DIP_RECORD(
    "place",
    "The place of a measurement: size of the pictures, camera path, threads and instruction set.",
    place_fields, DipCostReport, NULL);

static const DipField there_fields[] = {
    {"settings", "combination", NULL, "All quality settings of the combination.",
     DIP_FACT(SETTINGS, DipCostPredictedThere, quality)},
    {"role", NULL, NULL, "Whether the combination was predicted, timed or checked.",
     DIP_DERIVED(TEXT, derive_role)},
    {"report_ms", "report", "ms", "Mean time in the report: measured, or predicted there.",
     DIP_FACT(NUMBER, DipCostPredictedThere, report_ms), .digits = 2},
    {"report_alone_ms", NULL, "ms", "Mean time predicted from the report alone.",
     DIP_FACT(NUMBER, DipCostPredictedThere, as_is_ms), .digits = 2},
    {"ms", "predicted", "ms",
     "Mean time predicted from the report and from what was timed there, or from the report alone "
     "(`from_report_alone`).",
     DIP_FACT(NUMBER, DipCostPredictedThere, ms), .digits = 2},
    {"timed", NULL, NULL,
     "Mean time that was timed there; null if the combination was not timed there.",
     DIP_DERIVED(RECORD, derive_timed), .record = &dip_cost_elsewhere_record},
    {"there", NULL, NULL, "The place for which the times are predicted.", .kind = DIP_FIELD_RECORD,
     .derive = derive_there, .record = &place_record},
};
static const DipRecord there_record =
    DIP_RECORD("combination there", "A combination of the report, with its times there.",
               there_fields, DipCostPredictedThere, NULL);

#define MISSES(name, MEMBER, means)                                                                \
    {                                                                                              \
        name, NULL, NULL, means, DIP_FACT(RECORD, DipCostElsewherePrediction, MEMBER),             \
            .record = &dip_cost_misses_record                                                      \
    }
static const DipField misses_fields[] = {
    MISSES("report_rows_left_out", fit,
           "Misses of the report's rows, each predicted from all others."),
    MISSES("timed_by_report_alone", timed_as_is,
           "Misses of the combinations that were timed there, predicted from the report alone."),
    MISSES("timed_left_out", timed_left_out,
           "Misses of the combinations that were timed there, each predicted from the report and "
           "the others."),
    MISSES("checked_by_report_alone", checked_as_is,
           "Misses of the combinations that were timed only as a check, predicted from the report "
           "alone."),
    MISSES("checked", checked_fitted,
           "Misses of the combinations that were timed only as a check, predicted as in "
           "`ms`."),
};
static const DipRecord misses_record =
    DIP_RECORD("misses there", "How far the predictions lie from what was timed.", misses_fields,
               DipCostElsewherePrediction, NULL);

static const DipField prediction_fields[] = {
    {"what", NULL, NULL, "Name of the command that wrote the file.",
     DIP_DERIVED(TEXT, derive_what)},
    {"format", NULL, NULL, "Number of the file's format.",
     DIP_DERIVED(WHOLE, dip_cost_derive_format)},
    {"scene", NULL, NULL, "Name of the scene that is drawn.",
     DIP_FACT(TEXT, DipCostElsewherePrediction, report.scene)},
    {"scene_hash", NULL, NULL, "Hash of the scene that is drawn.",
     DIP_FACT(TEXT, DipCostElsewherePrediction, report.scene_hash)},
    {"report", NULL, NULL, "Where the report was measured.",
     DIP_FACT(RECORD, DipCostElsewherePrediction, report), .record = &place_record},
    {"there", NULL, NULL, "The place for which the times are predicted.",
     DIP_FACT(RECORD, DipCostElsewherePrediction, there), .record = &place_record},
    {"factor", NULL, NULL, "How many times as long frames take there as the report alone predicts.",
     DIP_FACT(NUMBER, DipCostElsewherePrediction, factor)},
    {"from_report_alone", NULL, NULL,
     "Whether `ms` is `report_alone_ms`: nothing was timed there, or the times there would each be "
     "missed further (in the median) if predicted with the help of the others.",
     DIP_FACT(FLAG, DipCostElsewherePrediction, from_report)},
    {"wait", NULL, NULL,
     "Share of their time for which the threads waited for a processor, in what was timed there.",
     DIP_FACT(NUMBER, DipCostElsewherePrediction, wait)},
    {"misses", NULL, NULL, "How far the predictions lie from what was timed.",
     .kind = DIP_FIELD_RECORD, .where = DIP_FIELD_JSON, .record = &misses_record},
    {"combinations", NULL, NULL, "The combinations of the report, with their times there.",
     DIP_LIST(.record = &there_record, DIP_ARRAY(DipCostElsewherePrediction, list, count),
              .points = true)},
};
const DipRecord dip_cost_prediction_record =
    DIP_RECORD("prediction elsewhere", "What `diptych cost predict --json` writes.",
               prediction_fields, DipCostElsewherePrediction, NULL);

// --- the terminal --------------------------------------------------------------------------------

static void print_place(DipForm *form, const char *what, const DipCostReport *place) {
    dip_form_fact(form, what, "%dx%d pixels, path %s, %d thread%s, %s", place->width, place->height,
                  place->paths[0], place->threads, dip_cost_plural(place->threads), place->isa);
}

static void print_checks(DipForm *form, const DipCostElsewherePrediction *p) {
    if (p->timed_count > 0) {
        dip_form_fact(form, "Timed",
                      "%d combination%s there, beside the report's baseline: %.3f times as long as "
                      "the report alone predicts",
                      p->timed_count, dip_cost_plural(p->timed_count), p->factor);
        dip_section_misses(form, "by report", &p->timed_as_is);
        dip_section_misses(form, "by the others", &p->timed_left_out);
        dip_form_fact(form, "Predicted", "%s",
                      p->from_report ? "from the report alone: with the help of the others, these "
                                       "times are missed further"
                                     : "from the report and these times");
    } else {
        dip_form_fact(form, "Timed", "nothing: the predictions come from the report alone");
    }
    if (p->checked_count > 0) {
        dip_form_fact(form, "Checked", "%d other combination%s there", p->checked_count,
                      dip_cost_plural(p->checked_count));
        dip_section_misses(form, "by report", &p->checked_as_is);
        if (p->timed_count > 0) {
            dip_section_misses(form, "as predicted", &p->checked_fitted);
        }
    }
    if (p->wait > dip_cost_wait_limits.green) {
        dip_form_fact(form, "Warning",
                      "The threads waited %.0f %% of their time for a core, which other programs "
                      "held, so the times that were taken there are %s.",
                      100.0 * p->wait, p->wait > dip_cost_wait_limits.red ? "wrong" : "less sure");
    }
}

void dip_cost_predict_there_print(const DipCostElsewherePrediction *p, FILE *out) {
    const DipCostReport *report = &p->report;
    DipForm form = {.out = out};
    char smaller[64] = "";
    if (report->smaller_count > 0) {
        snprintf(smaller, sizeof smaller, " and %d at %dx%d", report->smaller_count,
                 report->smaller_width, report->smaller_height);
    }
    dip_form_table(&form, &(DipTable){.caption = "Mean times of a frame, in milliseconds of the "
                                                 "report's run.",
                                      .record = &there_record,
                                      .context = (void *)p,
                                      .columns = "settings; report_ms; ms; timed.ms=timed",
                                      .items = p->list,
                                      .count = p->count});
    dip_form_heading(&form, NULL, "How they were predicted");
    dip_form_fact(&form, "Scene", "%s", report->scene);
    print_place(&form, "Report", report);
    print_place(&form, "There", &p->there);
    dip_form_fact(&form, "Model", "prices of work from %d row%s%s of the report", report->row_count,
                  dip_cost_plural(report->row_count), smaller);
    dip_section_misses(&form, "by the others", &p->fit);
    print_checks(&form, p);
    dip_form_end(&form);
}

// --- files ---------------------------------------------------------------------------------------

bool dip_cost_predict_there_write_json(const DipCostElsewherePrediction *p, const char *file,
                                       DipError *err) {
    return dip_fields_write_json(&dip_cost_prediction_record, p, file, err);
}

static bool print_csv(const void *context, FILE *out) {
    static const char columns[] =
        "there.width=width; there.height=height; there.path=path; there.threads=threads; "
        "settings; role; report_ms; report_alone_ms; ms; timed.ms";
    const DipCostElsewherePrediction *p = context;
    for (int i = -1; i < p->count; i++) {
        const DipFieldAt at = {(void *)context, i < 0 ? NULL : &p->list[i], i, NULL};
        dip_fields_print_csv(&there_record, &at, columns, out);
    }
    return true;
}

bool dip_cost_predict_there_write_csv(const DipCostElsewherePrediction *p, const char *file,
                                      DipError *err) {
    return dip_whole_file_print(file, print_csv, p, err);
}
