// Lists the fields of camera paths, of the truths of their viewpoints, and of sweeps along them.
#include "app/report/format/cost_fields_private.h"

#include "app/report/words.h"

#include <string.h>

// --- paths and their truths ----------------------------------------------------------------------

// Checks that the name of a path has only letters, digits, '_' and '-'.
static bool check_path(const DipFieldAt *at) {
    const char *name = dip_cost_report_of(at)->paths[at->index];
    return *name && strspn(name, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                                 "0123456789_-") == strlen(name);
}

#define OF_PATH(KIND, MEMBER)                                                                      \
    DIP_FACT(KIND, DipCostReport, MEMBER[0]), .stride = sizeof *((DipCostReport *)0)->MEMBER
DIP_DERIVE(derive_floor,
           DIP_MADE(DipMetrics, (dip_cost_floor_metrics(dip_cost_report_of(at), at->index))))
static const DipField path_fields[] = {
    {"name", "path", NULL,
     "\"DEFAULT\", \"AA\" and so on: the path's key in the ini, or the name of the path of --path.",
     OF_PATH(TEXT, paths)},
    {"poses", NULL, NULL, "Hash of the poses at the viewpoints.", OF_PATH(TEXT, path_hashes)},
    {"base_row", NULL, NULL, "The row with which the others of the path are timed.",
     OF_PATH(WHOLE, base_rows), .most = DIP_COST_MAX_ROWS - 1},
    {"same_row", NULL, NULL, "The baseline once more, timed as if it were another setting (A/A).",
     OF_PATH(WHOLE, same_rows), .most = DIP_COST_MAX_ROWS - 1},
    {"floor", NULL, NULL,
     "Estimates of the metrics that a perfect picture has, because of the noise in the path's "
     "truths.",
     DIP_DERIVED(RECORD, derive_floor), .record = &dip_cost_metrics_record},
};
const DipRecord dip_cost_path_record = DIP_RECORD_OF_ARRAYS(
    "path", "A camera path on which rows were measured.", path_fields, check_path);

typedef struct Floor {
    int path;
    int place;
    DipMetricSums halves;
} Floor;

static const DipField floor_fields[] = {
    {"path", NULL, NULL, "Index of the camera path.", DIP_FACT(WHOLE, Floor, path),
     .most = DIP_COST_MAX_PATHS - 1},
    {"place", NULL, NULL, "Index of the viewpoint on its path.", DIP_FACT(WHOLE, Floor, place),
     .most = DIP_COST_MAX_PLACES - 1},
    SUMS_FIELD("half_against_half", "Sums of one half of the truth against the other.", Floor,
               halves),
};
static const DipRecord floor_record =
    DIP_RECORD("noise floor", "The two halves of a viewpoint's truth (converged picture).",
               floor_fields, Floor, NULL);

static int all_floors(const DipCostReport *report) {
    return report->path_count * report->options.places;
}

DIP_OF_ITEM(int, count_floors,
            dip_cost_count_set(dip_cost_report_of(at)->has_floor,
                               all_floors(dip_cost_report_of(at))))

static const void *get_floor(const DipFieldAt *at, int index, DipFieldScratch *scratch) {
    const DipCostReport *report = dip_cost_report_of(at);
    const int i = dip_cost_find_set(report->has_floor, index), places = report->options.places;
    return DIP_MADE(Floor, ((Floor){i / places, i % places, report->floors[i]}));
}

static DipErrorCode open_floors(const DipFieldAt *at, int count) {
    return count <= all_floors(dip_cost_report_of(at)) ? DIP_ERROR_NONE : DIP_ERROR_FORMAT;
}

static bool put_floor(const DipFieldAt *at, int index, const void *item) {
    DipCostReport *report = dip_cost_report_of(at);
    const Floor *from = item;
    (void)index;
    if (from->path >= report->path_count || from->place >= report->options.places ||
        !dip_cost_are_sums(&from->halves)) {
        return false;
    }
    report->floors[from->path * report->options.places + from->place] = from->halves;
    report->has_floor[from->path * report->options.places + from->place] = true;
    return true;
}

const DipFieldList dip_cost_floor_list = {.record = &floor_record,
                                          .count = count_floors,
                                          .item = get_floor,
                                          .open = open_floors,
                                          .put = put_floor};

// --- sweeps --------------------------------------------------------------------------------------

// Returns the sweep of a step. All steps of a sweep have the sweep itself as their item.
static const DipCostSweep *sweep_of(const DipFieldAt *at) {
    return at->item;
}

DIP_OF_ITEM(bool, is_step_timed,
            dip_cost_is_timed(dip_cost_report_of(at), sweep_of(at)->rows[at->index]))

// Defines for each metric a function that derives its change from the base of a sweep to a step.
#define CHANGE_FUNCTION(METRIC, ...)                                                               \
    DIP_DERIVE(derive_change_##METRIC,                                                             \
               DIP_MADE(DipEstimate, dip_cost_metric_change(                                       \
                                         dip_cost_report_of(at), sweep_of(at)->rows[at->index],    \
                                         sweep_of(at)->base, DIP_COST_##METRIC)))
METRIC_LIST(CHANGE_FUNCTION)

DIP_DERIVE(derive_row, &dip_cost_report_of(at)->rows[sweep_of(at)->rows[at->index]])
DIP_DERIVE(derive_step,
           DIP_WRITTEN(dip_cost_step_text(dip_cost_report_of(at), sweep_of(at),
                                          sweep_of(at)->rows[at->index], scratch->text)))

#define CHANGE_FIELD(METRIC, NAME, title, unit, DIGITS)                                            \
    {NAME "_change",                                                                               \
     title,                                                                                        \
     unit,                                                                                         \
     title " minus that of the sweep's base, over the viewpoints that both have.",                 \
     DIP_DERIVED(ESTIMATE, derive_change_##METRIC),                                                \
     .digits = DIGITS},
static const DipField step_fields[] = {
    {"row", NULL, NULL, "Index of the step's row.", DIP_FACT(WHOLE, DipCostSweep, rows[0]),
     .stride = sizeof(int), .most = DIP_COST_MAX_ROWS - 1},
    {"step", "step", NULL, "Name of the step.", DIP_DERIVED(TEXT, derive_step)},
    {"ratio", "ratio", NULL, "The step's time divided by that of the sweep's base.",
     DIP_COMPUTED(ESTIMATE, DipCostSweep, ratios[0]), .stride = sizeof(DipEstimate),
     .known = is_step_timed, .show = DIP_SHOW_OF_TIMES, .digits = 3},
    METRIC_LIST(CHANGE_FIELD){"measured", NULL, NULL, "The fields of the step's row.",
                              DIP_SHOWN(RECORD, derive_row), .record = &dip_cost_row_record},
};

DIP_OF_ITEM(bool, check_step,
            dip_cost_is_row(dip_cost_report_of(at), sweep_of(at)->rows[at->index]))

static const DipRecord step_record =
    DIP_RECORD_OF_ARRAYS("step", "A step of a sweep.", step_fields, check_step);

DIP_DERIVE(derive_title,
           DIP_WRITTEN(dip_cost_sweep_title(dip_cost_report_of(at), at->item, scratch->text)))
static const DipField sweep_fields[] = {
    {"title", NULL, NULL, "The setting, and the others that are off their defaults.",
     DIP_DERIVED(TEXT, derive_title)},
    {"setting", NULL, NULL, "Key of the setting.", DIP_FACT(NAMED, DipCostSweep, setting),
     .names = dip_cost_setting_keys, .name_count = DIP_SETTING_COUNT},
    {"path", NULL, NULL, "Index of the camera path.", DIP_FACT(WHOLE, DipCostSweep, path),
     .most = DIP_COST_MAX_PATHS - 1},
    {"base", NULL, NULL, "Index of the row with which the steps are compared.",
     DIP_FACT(WHOLE, DipCostSweep, base), .most = DIP_COST_MAX_ROWS - 1},
    {"steps", NULL, NULL, "The steps, in the order of the setting.",
     DIP_LIST(.record = &step_record, .counted = offsetof(DipCostSweep, row_count),
              .most = DIP_COST_MAX_SWEEP_ROWS)},
};

static bool check_sweep(const DipFieldAt *at) {
    const DipCostSweep *sweep = at->item;
    return sweep->path < dip_cost_report_of(at)->path_count &&
           dip_cost_is_row(dip_cost_report_of(at), sweep->base);
}

const DipRecord dip_cost_sweep_record = DIP_RECORD(
    "sweep",
    "All steps of one setting on one path, without changes of other settings (but for the "
    "group sizes of adaptive AA).",
    sweep_fields, DipCostSweep, check_sweep);
