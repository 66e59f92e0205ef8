// Lists the fields of a report, in the order in which they are written and read, and defines what
// the lists of fields share.
#include "app/report/format/cost_fields_private.h"

#include <limits.h>
#include <math.h>

// --- what lists share ----------------------------------------------------------------------------

bool dip_cost_is_row(const DipCostReport *report, int row) {
    return row >= 0 && row < report->row_count;
}

#define SETTING_KEY(key, ...) #key,
const char *const dip_cost_setting_keys[] = {DIP_SETTING_LIST(SETTING_KEY)};
#undef SETTING_KEY

int dip_cost_count_set(const bool *flags, int count) {
    int set = 0;
    for (int i = 0; i < count; i++) {
        set += flags[i];
    }
    return set;
}

int dip_cost_find_set(const bool *flags, int number) {
    int i = 0;
    for (int left = number + !flags[0]; left > 0; left -= flags[i]) {
        i++;
    }
    return i;
}

// Returns whether a sum over `count` pixels or bursts (series of successive frames) is possible:
// the count is 0 or at least 1, and the mean lies within its limit.
static bool is_sum(double sum, double count) {
    return (count == 0.0 || count >= 1.0) && fabs(sum) <= DIP_COST_MOST_MEAN * count;
}

bool dip_cost_are_sums(const DipMetricSums *sums) {
    const double bursts = sums->bursts;
    bool ok = is_sum(sums->squared_static, bursts) && is_sum(sums->squared_flicker, bursts) &&
              is_sum(sums->squared_step, bursts) && is_sum(sums->squared_two_mean, bursts);
    for (int i = 0; i < DIP_METRIC_REGION_COUNT; i++) {
        const DipMetricRegionSums *region = &sums->regions[i];
        ok = ok && is_sum(region->squared_lin, region->pixels) &&
             is_sum(region->squared_codes, region->pixels) &&
             is_sum(region->flip, region->pixels) && is_sum(region->ssim, region->ssim_pixels);
    }
    return ok;
}

// --- the report ----------------------------------------------------------------------------------

static const DipField left_out_element = {
    .kind = DIP_FIELD_TEXT, .size = DIP_COST_REASON, .stride = DIP_COST_REASON};

#define WARNING_TEXT(member, known_if, means)                                                      \
    { #member, NULL, NULL, means, DIP_FACT(TEXT, DipError, member), .known = known_if }
DIP_OF_ITEM(bool, has_file, ((const DipError *)at->item)->file[0] != '\0')
DIP_OF_ITEM(bool, has_line, ((const DipError *)at->item)->line > 0)
DIP_OF_ITEM(bool, has_key, ((const DipError *)at->item)->key[0] != '\0')
static const DipField warning_fields[] = {
    WARNING_TEXT(file, has_file, "Name of the file, without its folder; null if it is not known."),
    {"line", NULL, NULL, "Line of the file, from 1; null if it is not known.",
     DIP_FACT(WHOLE, DipError, line), .least = 1, .most = INT_MAX, .known = has_line},
    WARNING_TEXT(key, has_key,
                 "The key, setting or part of the file that the warning is about, or null."),
    WARNING_TEXT(message, NULL, "What was found, and what is done about it."),
};
const DipRecord dip_cost_warning_record =
    DIP_RECORD("warning", "A warning that loading the scene gave.", warning_fields, DipError, NULL);

DIP_DERIVE(derive_warning_count, DIP_MADE(int, dip_cost_report_of(at)->warning_count +
                                                   dip_cost_report_of(at)->warnings_left_out))

DIP_OF_ITEM(bool, has_times, dip_cost_report_of(at)->rounds > 0)
DIP_OF_ITEM(bool, has_predictions, dip_cost_report_of(at)->predicted.count > 0)

const void *dip_cost_derive_format(const DipFieldAt *at, DipFieldScratch *scratch) {
    (void)at;
    return DIP_MADE(int, DIP_COST_JSON_FORMAT);
}

#define HEADER_TEXT(member, means)                                                                 \
    { #member, NULL, NULL, means, DIP_FACT(TEXT, DipCostReport, member) }
#define HEADER_NUMBER(name, member, LEAST, MOST, means)                                            \
    {                                                                                              \
        name, NULL, NULL, means, DIP_FACT(WHOLE, DipCostReport, member), .least = LEAST,           \
                                                                         .most = MOST              \
    }
static const DipField report_fields[] = {
    {"format", NULL, NULL, "Number of the file's format.",
     DIP_DERIVED(WHOLE, dip_cost_derive_format)},
    HEADER_TEXT(version, "Version of the Diptych that measured the report."),
    HEADER_TEXT(build, "Hash of the file of the program that measured the report."),
    {"several_builds", NULL, NULL,
     "Whether the report was merged from parts that different builds of Diptych measured.",
     DIP_FACT(FLAG, DipCostReport, several_builds)},
    HEADER_TEXT(scene, "Name of the scene that was measured."),
    HEADER_TEXT(scene_hash, "Hash of the scene that was measured."),
    HEADER_TEXT(processor, "Name of the processor on which the report was measured."),
    HEADER_TEXT(isa, "Instruction set with which the frames were drawn."),
    HEADER_TEXT(date, "When the measurement ended, ISO 8601 in UTC; \"\" if it is not known."),
    HEADER_NUMBER("threads", threads, 1, 256, "Number of threads that drew the frames."),
    HEADER_NUMBER("width", width, 1, 8192, "Width of the pictures, in pixels."),
    HEADER_NUMBER("height", height, 1, 8192, "Height of the pictures, in pixels."),
    HEADER_NUMBER("rounds", rounds, 0, 10000,
                  "Number of rounds timed; 0 if the report has no times."),
    HEADER_NUMBER("combined_first", combined_first, 0, DIP_COST_MAX_ROWS,
                  "Rows from this index on are the combinations, on path 0. The first is the base "
                  "row of path 0; older programs timed the baseline once more instead."),
    HEADER_NUMBER("places", options.places, 1, DIP_COST_MAX_PLACES,
                  "Number of viewpoints on each path."),
    HEADER_NUMBER("burst", options.burst, 1, DIP_COST_MAX_BURST,
                  "Number of successive frames at each viewpoint."),
    HEADER_NUMBER("samples", options.samples, 0, 4096,
                  "Samples per pixel in each half of the truth."),
    HEADER_NUMBER("timed_frames", options.timed_frames, 1, 100,
                  "Number of frames per path in each round."),
    HEADER_NUMBER("budget_of", options.budget_of, 0, 2,
                  "The time that budgets are meant for: 0 p95, 1 mean, 2 worst."),
    HEADER_NUMBER("seed", options.seed, 0, INT_MAX, "Seed of the random order of the timing."),
    {"pixels_per_degree", NULL, NULL, "Pixels per degree of the field of view, for FLIP.",
     DIP_FACT(NUMBER, DipCostReport, options.pixels_per_degree), .most = DIP_COST_MOST_COUNT},
    {"baseline", NULL, NULL, "All settings of the baseline.",
     DIP_FACT(SETTINGS, DipCostReport, options.baseline)},
    {"paths", NULL, NULL, "The camera paths on which rows were measured.",
     DIP_LIST(.record = &dip_cost_path_record, .counted = offsetof(DipCostReport, path_count),
              .least = 1, .most = DIP_COST_MAX_PATHS)},
    {"machine", NULL, NULL, "What the timing tells about the machine; null without times.", PART,
     .record = &dip_cost_machine_record, .known = has_times},
    {"left_out", NULL, NULL, "Steps of settings that were left out, each with the reason.",
     DIP_LIST(.element = &left_out_element, DIP_ARRAY(DipCostReport, refused, refused_count),
              .most = DIP_COST_MAX_REFUSED)},
    {"warnings", NULL, NULL,
     "The warnings that loading the scene gave, in the order of loading, such as what Diptych does "
     "not draw of it. Empty in files of versions that did not record them.",
     DIP_LIST(.record = &dip_cost_warning_record, DIP_ARRAY(DipCostReport, warnings, warning_count),
              .points = true, .most = DIP_COST_MAX_WARNINGS)},
    HEADER_NUMBER("warnings_left_out", warnings_left_out, 0, DIP_COST_MOST_LEFT_OUT,
                  "Number of further warnings, which the list leaves out."),
    {"warning_count", NULL, NULL, "Number of all warnings that loading the scene gave.",
     DIP_SHOWN(WHOLE, derive_warning_count)},
    {"rows", NULL, NULL, "The measured combinations, each on one camera path.",
     LIST(dip_cost_row_list)},
    {"visits", NULL, NULL, "Every timed frame, from which all times are computed.",
     LIST(dip_cost_visit_list)},
    {"floors", NULL, NULL, "The noise of the truths themselves, for each path and viewpoint.",
     LIST(dip_cost_floor_list)},
    {"same_pictures", NULL, NULL,
     "Combinations without a row of their own, because they draw the same pictures as a row.",
     DIP_LIST(.record = &dip_cost_same_record, DIP_ARRAY(DipCostReport, same, same_count),
              .points = true, .most = DIP_COST_MAX_ROWS)},
    {"sweeps", NULL, NULL,
     "The sweeps: all steps of one setting on one path. The other settings stay the same, but "
     "those of adaptive AA also have all group sizes.",
     DIP_LIST(.record = &dip_cost_sweep_record, DIP_ARRAY(DipCostReport, sweeps, sweep_count),
              .most = DIP_COST_MAX_SWEEPS)},
    {"interactions", NULL, NULL, "Pairs of settings, and how their effects add up.",
     DERIVED_LIST(dip_cost_interaction_list)},
    {"fit", NULL, NULL, "How times follow from work; null with too few rows.",
     DIP_DERIVED(RECORD, dip_cost_derive_fit), .record = &dip_cost_fit_record},
    {"predicted", NULL, NULL, "The combinations that --predict ranked; null without --predict.",
     DIP_FACT(RECORD, DipCostReport, predicted), .record = &dip_cost_predictions_record,
     .known = has_predictions},
    {"smaller", NULL, NULL, "Combinations at a smaller size; null if there are none.", PART,
     .record = &dip_cost_smaller_record, .known = dip_cost_has_smaller},
    {"advice", NULL, NULL, "The row to choose for each time budget.", LIST(dip_cost_advice_list)},
};

static bool check_report(const DipFieldAt *at) {
    const DipCostReport *report = dip_cost_report_of(at);
    bool ok = report->combined_first <= report->row_count &&
              report->rounds != 1; // One round has no interval.
    for (int p = 0; p < report->path_count; p++) {
        ok = ok && dip_cost_is_row(report, report->base_rows[p]) &&
             dip_cost_is_row(report, report->same_rows[p]) &&
             report->rows[report->base_rows[p]].path == p &&
             report->rows[report->same_rows[p]].path == p;
    }
    return ok;
}

const DipRecord dip_cost_report_record =
    DIP_RECORD("report", "What `diptych cost` writes to cost.json.", report_fields, DipCostReport,
               check_report);
