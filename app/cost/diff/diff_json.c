// Lists the fields of a comparison, and writes them as JSON.
#include "app/cost/diff/diff.h"
#include "app/report/format/cost_fields.h"

static const char *const mark_names[] = {"same", "slower", "faster"};

// In all fields of this file, DipFieldAt.context is the DipCostDiff.
static const DipCostDiff *diff_of(const DipFieldAt *at) {
    return at->context;
}

DIP_OF_ITEM(bool, has_times, diff_of(at)->has_times)

// --- sides ---------------------------------------------------------------------------------------

DIP_DERIVE(derive_name, diff_of(at)->names[at->index])
DIP_DERIVE(derive_verdict, dip_cost_verdict_names[diff_of(at)->verdicts[at->index]])
#define OF_SIDE(member)                                                                            \
    DIP_COMPUTED(TEXT, DipCostDiff, member[0]), .stride = sizeof *((DipCostDiff *)0)->member
static const DipField side_fields[] = {
    {"name", NULL, NULL, "Name of the report or program, as on the command line.",
     DIP_DERIVED(TEXT, derive_name)},
    {"build", NULL, NULL, "Hash of the file of the program that was measured.", OF_SIDE(builds)},
    {"machine", NULL, NULL,
     "Processor, number of threads and instruction set with which this side was measured.",
     OF_SIDE(machines)},
    {"verdict", NULL, NULL,
     "How quiet this side's machine was: green, amber or red; null without times.",
     DIP_DERIVED(TEXT, derive_verdict), .known = has_times},
    {"reason", NULL, NULL, "The measured figures from which the verdict comes.", OF_SIDE(reasons),
     .known = has_times},
};
static const DipRecord side_record = DIP_RECORD_OF_ARRAYS(
    "side", "One side of the comparison: a report or a program.", side_fields, NULL);

DIP_OF_ITEM(int, count_sides, 2)

// --- differences ---------------------------------------------------------------------------------

typedef struct Difference {
    const char *quantity;
    double a, b, growth;
} Difference;

DIP_DERIVE(derive_quantity, ((const Difference *)at->item)->quantity)
static const DipField difference_fields[] = {
    {"quantity", NULL, NULL, "Name of the quantity that differs.",
     DIP_DERIVED(TEXT, derive_quantity)},
    {"a", NULL, NULL, "Value of the quantity in A.", DIP_FACT(NUMBER, Difference, a)},
    {"b", NULL, NULL, "Value of the quantity in B.", DIP_FACT(NUMBER, Difference, b)},
    {"growth", NULL, NULL,
     "Share by which the quantity grew from A to B; for PSNR and SSIM, the share by which their "
     "error grew.",
     DIP_FACT(NUMBER, Difference, growth)},
};
static const DipRecord difference_record =
    DIP_RECORD("difference", "A quantity whose values in A and B differ.", difference_fields,
               Difference, NULL);

static int count_differences(const DipFieldAt *at) {
    int count = 0;
    for (int q = 0; q < DIP_COST_DIFF_QUANTITY_COUNT; q++) {
        count += dip_cost_diff_differs(at->item, q);
    }
    return count;
}

static const void *get_difference(const DipFieldAt *at, int index, DipFieldScratch *scratch) {
    const DipCostDiffRow *row = at->item;
    int q = 0;
    for (int left = index; left > 0 || !dip_cost_diff_differs(row, q); q++) {
        left -= dip_cost_diff_differs(row, q);
    }
    *(Difference *)scratch = (Difference){dip_cost_diff_title(q), row->values[0][q],
                                          row->values[1][q], dip_cost_diff_growth(row, q)};
    return scratch;
}

// --- rows ----------------------------------------------------------------------------------------

DIP_OF_ITEM(bool, is_timed, ((const DipCostDiffRow *)at->item)->timed)
DIP_OF_ITEM(bool, has_ratios, is_timed(at) && diff_of(at)->kind == DIP_COST_DIFF_REPORTS)
DIP_OF_ITEM(bool, has_stages, is_timed(at) && diff_of(at)->kind == DIP_COST_DIFF_PROGRAMS)

DIP_DERIVE(derive_settings,
           DIP_WRITTEN(dip_cost_settings_text(&((const DipCostDiffRow *)at->item)->quality,
                                              scratch->text)))

#define STAGE(name, text)                                                                          \
    {#name, NULL, NULL, "Of " text ".",                                                            \
     DIP_FACT(ESTIMATE, DipCostDiffRow, stages[DIP_BENCH_STAGE_##name])},
static const DipField stage_fields[] = {DIP_STAGE_LIST(STAGE)};
static const DipRecord stage_record = DIP_RECORD(
    "stages of a row", "1 + (B's time in the stage - A's time in it) / A's time of the frame.",
    stage_fields, DipCostDiffRow, NULL);

#define ROW(KIND, member) DIP_FACT(KIND, DipCostDiffRow, member)
static const DipField row_fields[] = {
    {"settings", NULL, NULL, "The row's settings that are off their defaults.",
     DIP_DERIVED(TEXT, derive_settings)},
    {"path", NULL, NULL, "Name of the camera path along which the frames were drawn.",
     ROW(TEXT, path)},
    {"mark", NULL, NULL,
     "Whether B takes the same time as A, or is surely slower or surely faster.", ROW(NAMED, mark),
     .names = mark_names, .known = is_timed},
    {"a_ms", NULL, "ms", "Mean time of a frame in A.", ROW(NUMBER, ms[0]), .known = is_timed},
    {"b_ms", NULL, "ms", "Mean time of a frame in B.", ROW(NUMBER, ms[1]), .known = is_timed},
    {"change", NULL, NULL,
     "Time of B divided by the time of A; of reports, b_ratio divided by a_ratio.",
     ROW(ESTIMATE, change), .known = is_timed},
    {"a_ratio", NULL, NULL, "A's time divided by its baseline's; reports only.",
     ROW(ESTIMATE, ratios[0]), .known = has_ratios},
    {"b_ratio", NULL, NULL, "B's time divided by its baseline's; reports only.",
     ROW(ESTIMATE, ratios[1]), .known = has_ratios},
    {"stages", NULL, NULL, "What each stage alone makes of the change; programs only.",
     .kind = DIP_FIELD_RECORD, .where = DIP_FIELD_JSON, .record = &stage_record,
     .known = has_stages},
    {"differences", NULL, NULL, "Errors, pictures and counters that differ.",
     DIP_LIST(.record = &difference_record, .count = count_differences, .item = get_difference)},
};
static const DipRecord row_record = DIP_RECORD(
    "row", "A combination of settings that both sides have.", row_fields, DipCostDiffRow, NULL);

DIP_DERIVE(derive_busy, DIP_MADE(bool, dip_cost_diff_is_busy(diff_of(at))))

#define DIFF(KIND, member) DIP_FACT(KIND, DipCostDiff, member)
static const DipField note_element = {
    .kind = DIP_FIELD_TEXT, .size = DIP_COST_DIFF_NOTE, .stride = DIP_COST_DIFF_NOTE};
static const DipField diff_fields[] = {
    {"format", NULL, NULL, "Number of the file's format.",
     DIP_DERIVED(WHOLE, dip_cost_derive_format)},
    {"sides", NULL, NULL, "The two sides of the comparison, first A and then B.",
     DIP_LIST(.record = &side_record, .count = count_sides)},
    {"notes", NULL, NULL, "Texts that say in what both sides differ as a whole.",
     DIP_LIST(.element = &note_element, DIP_ARRAY(DipCostDiff, notes, note_count))},
    {"busy", NULL, NULL, "Whether a machine was too busy for its times to be believed.",
     DIP_DERIVED(FLAG, derive_busy)},
    {"slower", NULL, NULL, "Number of rows that are surely slower in B.", DIFF(WHOLE, slower)},
    {"faster", NULL, NULL, "Number of rows that are surely faster in B.", DIFF(WHOLE, faster)},
    {"failed_times", NULL, NULL, "Number of rows that are slower by more than --fail-over.",
     DIFF(WHOLE, failed_times)},
    {"failed_errors", NULL, NULL, "Number of rows whose error grew by more than --fail-over.",
     DIFF(WHOLE, failed_errors)},
    {"cause", NULL, NULL, "The likely cause of a slowdown; \"\" if nothing is sure.",
     DIFF(TEXT, cause)},
    {"rows", NULL, NULL, "The combinations that both sides have.",
     DIP_LIST(.record = &row_record, DIP_ARRAY(DipCostDiff, rows, row_count), .points = true)},
};
const DipRecord dip_cost_diff_record = DIP_RECORD(
    "comparison", "What `diptych cost diff --json` writes.", diff_fields, DipCostDiff, NULL);

bool dip_cost_diff_write_json(const DipCostDiff *diff, const char *file, DipError *err) {
    return dip_fields_write_json(&dip_cost_diff_record, diff, file, err);
}
