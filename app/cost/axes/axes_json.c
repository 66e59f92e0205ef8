// The fields of `diptych cost axes`, and its files: JSON and CSV.
#include "app/cost/axes/axes.h"

#include "app/files/whole_file.h"
#include "app/report/format/cost_fields.h"
#include "app/report/viewpoints.h"

#include <math.h>

// The context of all items is the DipCostAxes.
static const DipCostAxes *axes_of(const DipFieldAt *at) {
    return at->context;
}

// The report's row of an item.
static const DipCostRow *row_of(const DipFieldAt *at) {
    return &axes_of(at)->report.rows[at->index];
}

static bool is_judged(const DipFieldAt *at) {
    return row_of(at)->judged[0];
}

static bool is_scaled(const DipFieldAt *at) {
    return axes_of(at)->rows[at->index].axis == DIP_COST_AXIS_SCALE;
}

static bool has_threads(const DipFieldAt *at) {
    return axes_of(at)->rows[at->index].axis == DIP_COST_AXIS_THREADS;
}

static bool is_compared(const DipFieldAt *at) {
    return is_judged(at) && at->index > 0;
}

// The value is `expression`.
#define DERIVE(name, TYPE, expression)                                                             \
    static const void *name(const DipFieldAt *at, DipFieldScratch *scratch) {                      \
        *(TYPE *)scratch = (expression);                                                           \
        return scratch;                                                                            \
    }
#define AXIS_METRIC(METRIC)                                                                        \
    DERIVE(derive_##METRIC, DipEstimate,                                                           \
           dip_cost_metric(&axes_of(at)->report, at->index, DIP_COST_##METRIC))                    \
    DERIVE(derive_change_##METRIC, DipEstimate,                                                    \
           dip_cost_metric_change(&axes_of(at)->report, at->index, 0, DIP_COST_##METRIC))
DERIVE(derive_ms, DipEstimate, row_of(at)->time.mean_ms)
DERIVE(derive_ratio, DipEstimate, row_of(at)->time.ratio)
DERIVE(derive_draw, double, row_of(at)->stage_ms[0])
DERIVE(derive_enlarge, double, row_of(at)->stage_ms[1])
DERIVE(derive_textures, double, (double)axes_of(at)->scene_texture_bytes)
DERIVE(derive_checked, double, (double)axes_of(at)->checked_pictures)
DERIVE(derive_pixel, double,
       1e6 * row_of(at)->time.mean_ms.value /
           ((double)axes_of(at)->rows[at->index].shown_width *
            axes_of(at)->rows[at->index].shown_height))
AXIS_METRIC(RMSE)
AXIS_METRIC(FLIP)
DERIVE(derive_PSNR, DipEstimate, dip_cost_metric(&axes_of(at)->report, at->index, DIP_COST_PSNR))
DERIVE(derive_SSIM, DipEstimate, dip_cost_metric(&axes_of(at)->report, at->index, DIP_COST_SSIM))

static const void *derive_counters(const DipFieldAt *at, DipFieldScratch *scratch) {
    (void)scratch;
    return row_of(at)->counters;
}

static const void *derive_isa(const DipFieldAt *at, DipFieldScratch *scratch) {
    (void)scratch;
    return dip_isa_name(axes_of(at)->rows[at->index].isa);
}

static const void *derive_what(const DipFieldAt *at, DipFieldScratch *scratch) {
    (void)at;
    (void)scratch;
    return "diptych cost axes";
}

static const void *derive_verdict(const DipFieldAt *at, DipFieldScratch *scratch) {
    (void)scratch;
    return dip_cost_verdict_names[axes_of(at)->report.verdict];
}

static int count_frames(const DipFieldAt *at) {
    return dip_cost_frame_count(&axes_of(at)->report);
}

static const DipField frame_element = {.kind = DIP_FIELD_NUMBER};
#define FRAMES(name, member, means)                                                                \
    static const void *get_##member(const DipFieldAt *at, int index, DipFieldScratch *scratch) {   \
        (void)scratch;                                                                             \
        return &row_of(at)->pairs[index].member;                                                   \
    }                                                                                              \
    static const DipFieldList member##_list = {                                                    \
        .element = &frame_element, .count = count_frames, .item = get_##member};
FRAMES("frame_ms", ms, "")
FRAMES("frame_base_ms", base_ms, "")
FRAMES("frame_wait", wait, "")

#define ROW(KIND, member) DIP_FACT(KIND, DipCostAxisRow, member)
static const DipField row_fields[] = {
    {"axis", NULL, NULL, "What differs from the base: size, scale, threads or isa.",
     ROW(NAMED, axis), .names = dip_cost_axis_names},
    {"value", NULL, NULL, "The row's value on its axis.", ROW(TEXT, name)},
    {"width", NULL, "px", "Width of the picture that is drawn.", ROW(WHOLE, width)},
    {"height", NULL, "px", "Height of the picture that is drawn.", ROW(WHOLE, height)},
    {"shown_width", NULL, "px", "Width of the picture that is shown.", ROW(WHOLE, shown_width)},
    {"shown_height", NULL, "px", "Height of the picture that is shown.", ROW(WHOLE, shown_height)},
    {"threads", NULL, NULL, "Number of threads.", ROW(WHOLE, threads)},
    {"isa", NULL, NULL, "Instruction set.", DIP_DERIVED(TEXT, derive_isa)},
    {"ms", "mean", "ms", "Mean time of a frame.", DIP_DERIVED(ESTIMATE, derive_ms), .digits = 2},
    {"ratio", NULL, NULL, "Time divided by that of the base.", DIP_DERIVED(ESTIMATE, derive_ratio),
     .digits = 3},
    {"ns_per_pixel", "ns/pixel", NULL, "Mean time of a pixel that is shown.",
     DIP_DERIVED(NUMBER, derive_pixel), .digits = 2},
    {"memory_bytes", NULL, NULL, "Bytes that the row's renderer holds; null if that is not told.",
     ROW(NUMBER, memory_bytes)},
    {"frame_mj", NULL, "mJ", "Energy of a frame; null if the machine does not tell.",
     ROW(NUMBER, frame_mj)},
    {"draw_ms", "drawing", "ms", "The part of the time that draws; axis scale only.",
     DIP_DERIVED(NUMBER, derive_draw), .known = is_scaled},
    {"enlarge_ms", "enlarge", "ms", "The part of the time that enlarges; axis scale only.",
     DIP_DERIVED(NUMBER, derive_enlarge), .known = is_scaled},
    {"speed_up", NULL, NULL, "How many times as fast as with the fewest threads.",
     ROW(ESTIMATE, speed_up), .known = has_threads, .digits = 2},
    {"efficiency", NULL, NULL, "The speed-up over the ratio of the numbers of threads.",
     ROW(NUMBER, efficiency), .known = has_threads},
    {"rmse_lin", "RMSE", "linear", "RMSE against the truth.", DIP_DERIVED(ESTIMATE, derive_RMSE),
     .known = is_judged},
    {"psnr_db", "PSNR", "dB", "PSNR against the truth.", DIP_DERIVED(ESTIMATE, derive_PSNR),
     .known = is_judged},
    {"ssim", "SSIM", NULL, "SSIM against the truth.", DIP_DERIVED(ESTIMATE, derive_SSIM),
     .known = is_judged},
    {"flip", "FLIP", NULL, "FLIP against the truth.", DIP_DERIVED(ESTIMATE, derive_FLIP),
     .known = is_judged},
    {"flip_change", NULL, NULL, "FLIP minus that of the base.",
     DIP_DERIVED(ESTIMATE, derive_change_FLIP), .known = is_compared},
    {"rmse_lin_change", NULL, NULL, "RMSE minus that of the base.",
     DIP_DERIVED(ESTIMATE, derive_change_RMSE), .known = is_compared},
    {"counters", NULL, NULL, "Work of a frame, as means over the timed frames.",
     .kind = DIP_FIELD_NUMBERS, .where = DIP_FIELD_JSON | DIP_FIELD_DERIVED,
     .derive = derive_counters, .size = sizeof(double) * DIP_COST_COUNTER_COUNT,
     .names = dip_cost_counter_names},
    {"frame_ms", NULL, "ms", "Time of each frame along the path.", .kind = DIP_FIELD_LIST,
     .where = DIP_FIELD_JSON, .list = &ms_list},
    {"frame_base_ms", NULL, "ms", "Time of the base's same frame.", .kind = DIP_FIELD_LIST,
     .where = DIP_FIELD_JSON, .list = &base_ms_list},
    {"frame_wait", NULL, NULL, "Share of its time that the frame waited for processors.",
     .kind = DIP_FIELD_LIST, .where = DIP_FIELD_JSON, .list = &wait_list},
    {"verdict", NULL, NULL, "How quiet the machine was; CSV only.", .kind = DIP_FIELD_TEXT,
     .derive = derive_verdict},
};
static const DipRecord row_record =
    DIP_RECORD("row", "A size, render scale, number of threads or instruction set.", row_fields,
               DipCostAxisRow, NULL);

#define TEXT(name, member, means)                                                                  \
    { name, NULL, NULL, means, DIP_FACT(TEXT, DipCostAxes, member) }
#define WHOLE(name, member, means)                                                                 \
    { name, NULL, NULL, means, DIP_FACT(WHOLE, DipCostAxes, member) }
static const DipField axes_fields[] = {
    {"what", NULL, NULL, "The command.", DIP_DERIVED(TEXT, derive_what)},
    {"format", NULL, NULL, "The format of the file.", DIP_DERIVED(WHOLE, dip_cost_derive_format)},
    TEXT("version", report.version, "Version of Diptych."),
    TEXT("build", report.build, "Hash of the program's file."),
    TEXT("date", report.date, "When the measurement ended, ISO 8601 in UTC."),
    TEXT("scene", report.scene, "Name of the scene."),
    TEXT("scene_hash", report.scene_hash, "Hash of the scene."),
    TEXT("path", report.paths[0], "The camera path."),
    TEXT("processor", report.processor, "The processor."),
    {"settings", NULL, NULL, "All quality settings.",
     DIP_FACT(SETTINGS, DipCostAxes, report.options.baseline)},
    WHOLE("rounds", report.options.rounds, "Number of rounds timed."),
    WHOLE("timed_frames", report.options.timed_frames, "Number of frames in each round."),
    WHOLE("seed", report.options.seed, "Seed of the random order of the timing."),
    WHOLE("places", report.options.end_place, "Number of viewpoints where errors were measured."),
    WHOLE("samples", report.options.samples, "Samples per pixel in each half of the truth."),
    {"pixels_per_degree", NULL, NULL, "Pixels per degree of the field of view, for FLIP.",
     DIP_FACT(NUMBER, DipCostAxes, report.options.pixels_per_degree)},
    {"verdict", NULL, NULL, "How quiet the machine was.",
     DIP_FACT(NAMED, DipCostAxes, report.verdict), .names = dip_cost_verdict_names},
    TEXT("reason", report.verdict_reason, "What the verdict comes from."),
    {"wait", NULL, NULL, "Waiting time of all timed frames divided by (their time x threads).",
     DIP_FACT(NUMBER, DipCostAxes, report.machine.wait)},
    TEXT("energy", energy, "Where energy comes from, or why it is missing."),
    TEXT("note", note, "What was left out of the default values."),
    {"scene_texture_bytes", NULL, NULL, "Bytes of the scene's textures, which all rows share.",
     DIP_DERIVED(NUMBER, derive_textures)},
    {"checked_pictures", NULL, NULL, "Pictures that were compared with the base's.",
     DIP_DERIVED(NUMBER, derive_checked)},
    {"rows", NULL, NULL, "The rows; the first is the base, the second the base again (A/A).",
     .kind = DIP_FIELD_LIST, .where = DIP_FIELD_JSON,
     .list = &(const DipFieldList){.record = &row_record,
                                   .items = offsetof(DipCostAxes, rows),
                                   .counted = offsetof(DipCostAxes, report.row_count)}},
};
const DipRecord dip_cost_axes_record =
    DIP_RECORD("axes", "What `diptych cost axes --json` writes.", axes_fields, DipCostAxes, NULL);

static bool print_json(const void *context, FILE *out) {
    const DipFieldAt at = {(void *)context, context, 0, NULL};
    dip_fields_print_json(&dip_cost_axes_record, &at, out);
    return true;
}

bool dip_cost_axes_write_json(const DipCostAxes *axes, const char *file, DipError *err) {
    return dip_whole_file_print(file, print_json, axes, err);
}

static bool print_csv(const void *context, FILE *out) {
    static const DipColumn columns[] = {
        {"axis", NULL},        {"value", NULL},        {"width", NULL},        {"height", NULL},
        {"shown_width", NULL}, {"shown_height", NULL}, {"threads", NULL},      {"isa", NULL},
        {"ms", NULL},          {"ratio", NULL},        {"ns_per_pixel", NULL}, {"draw_ms", NULL},
        {"enlarge_ms", NULL},  {"rmse_lin", NULL},     {"flip", NULL},         {"speed_up", NULL},
        {"efficiency", NULL},  {"memory_bytes", NULL}, {"frame_mj", NULL},     {"verdict", NULL}};
    const DipCostAxes *axes = context;
    for (int i = -1; i < axes->report.row_count; i++) {
        const DipFieldAt at = {(void *)context, i < 0 ? NULL : &axes->rows[i], i, NULL};
        dip_fields_print_csv(&row_record, &at, columns, DIP_FIELD_COUNT_OF(columns), out);
    }
    return true;
}

bool dip_cost_axes_write_csv(const DipCostAxes *axes, const char *file, DipError *err) {
    return dip_whole_file_print(file, print_csv, axes, err);
}
