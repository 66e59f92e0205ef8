// The options of `diptych cost diff`.
#include "app/cost/diff/diff_options.h"

#include "renderer/base/assert.h"
#include "renderer/base/number.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#define FIELD(name) offsetof(DipCostDiffArguments, name)

// Settings that use each part of the renderer: samples, filters, sample groups, compression, and
// all of them.
static const char default_sets[] = "aa=none;aa=4;aa=8;af=16;aa=8,af=16;aa=8,aaa=on;opt=advanced;"
                                   "aa=8,aaa=on,asd=2,af=16,aaf=on";

static bool read_set(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    (void)row;
    DipCostDiffArguments *diff = fields;
    DipCostDiffSet *set = &diff->sets[diff->set_count];
    snprintf(set->text, sizeof set->text, "%s", value);
    return dip_quality_parse(value, &set->quality, err);
}

static bool read_share(void *fields, const DipOptionRow *row, const char *value, DipError *err) {
    DipCostDiffArguments *diff = fields;
    const size_t length = strlen(value);
    double percent;
    if (length < 2 || value[length - 1] != '%' || !dip_number_parse(value, length - 1, &percent) ||
        percent < 0.1 || percent > 1000.0) {
        return dip_option_refuse(err, DIP_ERROR_RANGE, row->name, value,
                                 "a share from 0.1% to 1000%, such as 3%");
    }
    diff->fail_over = 1.0 + percent / 100.0;
    return true;
}

static const DipOptionRow judge_rows[] = {
    {"--fail-over", "P%", DIP_OPTION_CUSTOM, .read = read_share,
     .text = "Exit with code 1 if B takes surely more than P % longer with any settings, or if an "
             "error grew by more than P %. Without the option, differences are only reported."},
};

static const DipOptionRow run_rows[] = {
    {"--sets", "LIST", DIP_OPTION_LIST, .count = FIELD(set_count), .room = DIP_COST_DIFF_MAX_SETS,
     .separator = ';', .read = read_set,
     .text = "Settings to time, as SET;SET;... in quotes. The default is eight sets that use every "
             "part of the renderer."},
    {"--frames", "N", DIP_OPTION_INTEGER, FIELD(frames), .least = 1, .most = 1000,
     .text = "Draw this many frames, which divide the camera path evenly. The default is 6. If a "
             "program is compared with a report, the frames are those of the report."},
};

static const DipOptionTable judge_table = DIP_OPTION_TABLE("Judging and output", judge_rows);
static const DipOptionTable run_table = DIP_OPTION_TABLE("Timing programs", run_rows);

static const DipOptionPart parts[] = {
    {&judge_table, 0},
    {&dip_json_option_table, FIELD(json)},
    {&run_table, 0},
    {&dip_measure_option_table, offsetof(DipCostDiffArguments, measure)},
    {&dip_starts_option_table, offsetof(DipCostDiffArguments, measure)},
    {&dip_scene_option_table, offsetof(DipCostDiffArguments, session)},
    {&dip_path_option_table, offsetof(DipCostDiffArguments, session)},
    {&dip_category_option_table, offsetof(DipCostDiffArguments, session)},
    {&dip_size_option_table, offsetof(DipCostDiffArguments, session)},
    {&dip_threads_option_table, offsetof(DipCostDiffArguments, session)},
    {&dip_program_option_table, offsetof(DipCostDiffArguments, program)},
};
const DipOptionParts dip_cost_diff_option_parts = {parts, DIP_ARRAY_COUNT(parts)};

void dip_cost_diff_options_default(void *arguments, int argc, char *const *argv) {
    (void)argc;
    (void)argv;
    DipCostDiffArguments *diff = arguments;
    diff->measure.starts = DIP_COST_DIFF_STARTS;
    dip_option_store(&run_rows[0], default_sets, diff, NULL);
}

bool dip_cost_diff_options_check(const void *arguments, DipError *err) {
    const DipCostDiffArguments *diff = arguments;
    if (diff->side_count != 2) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "cost diff",
                             "there is nothing to compare; give two reports or programs: cost diff "
                             "A B");
    }
    if (diff->measure.starts < 2) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "--starts",
                             "1 start has no spread; give 2 or more");
    }
    return dip_session_options_check(&diff->session, err);
}
