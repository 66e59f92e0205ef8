// Lists the fields of combinations that draw the same pictures as a row, of predictions, and of
// combinations that were timed under other conditions than the rows.
#include "app/report/format/cost_fields_private.h"

#include <float.h>
#include <limits.h>
#include <math.h>

DIP_DERIVE(derive_same_as,
           &dip_cost_report_of(at)->rows[((const DipCostSame *)at->item)->row].quality)
static const DipField same_fields[] = {
    {"settings", NULL, NULL, "All quality settings of the combination.",
     DIP_FACT(SETTINGS, DipCostSame, quality)},
    {"row", NULL, NULL, "Index of the row that stands for the combination.",
     DIP_FACT(WHOLE, DipCostSame, row), .most = DIP_COST_MAX_ROWS - 1},
    {"same_as", "draws the same as", NULL,
     "Settings of the row that stands for the combination, as far as they are off their defaults.",
     DIP_SHOWN(SETTINGS, derive_same_as)},
};

DIP_OF_ITEM(bool, check_same,
            dip_cost_is_row(dip_cost_report_of(at), ((const DipCostSame *)at->item)->row))

const DipRecord dip_cost_same_record =
    DIP_RECORD("same pictures",
               "A combination that draws the same pictures as a row with fewer settings off their "
               "defaults.",
               same_fields, DipCostSame, check_same);

static const DipField misses_fields[] = {
    {"rows", NULL, NULL, "Number of combinations that were compared.",
     DIP_FACT(WHOLE, DipCostMisses, rows), .most = DIP_COST_MAX_ROWS},
    {"median", NULL, NULL, "Median of |predicted / measured - 1| over the compared combinations.",
     DIP_FACT(NUMBER, DipCostMisses, median), .most = DBL_MAX},
    {"p90", NULL, NULL, "90th percentile of |predicted / measured - 1|.",
     DIP_FACT(NUMBER, DipCostMisses, p90), .most = DBL_MAX},
    {"within_5_percent", NULL, NULL, "Share of the combinations that are missed by at most 5 %.",
     DIP_FACT(NUMBER, DipCostMisses, within_5), .most = 1.0},
    {"within_10_percent", NULL, NULL, "Share of the combinations that are missed by at most 10 %.",
     DIP_FACT(NUMBER, DipCostMisses, within_10), .most = 1.0},
};
const DipRecord dip_cost_misses_record = DIP_RECORD(
    "misses", "How far predictions lie from measurements.", misses_fields, DipCostMisses, NULL);

#define MISSES_FIELD(name, MEMBER, means)                                                          \
    {                                                                                              \
        name, NULL, NULL, means, DIP_FACT(RECORD, DipCostPredictions, MEMBER),                     \
            .record = &dip_cost_misses_record                                                      \
    }
static const DipField all_misses_fields[] = {
    MISSES_FIELD("times", times,
                 "Misses of the mean times of rows that were measured after the prediction."),
    MISSES_FIELD("flip", errors,
                 "Misses of the FLIP of rows that were measured after the prediction."),
    MISSES_FIELD("times_left_out", times_left_out,
                 "Misses of the mean times of the first rows, each predicted from the others."),
    MISSES_FIELD("flip_left_out", errors_left_out,
                 "Misses of the FLIP of the first rows, each predicted from the others."),
};
static const DipRecord all_misses_record =
    DIP_RECORD("misses of --predict", "How far the predictions of --predict lie from measurements.",
               all_misses_fields, DipCostPredictions, NULL);

static const DipField prediction_fields[] = {
    {"settings", NULL, NULL, "All quality settings of the combination.",
     DIP_FACT(SETTINGS, DipCostPrediction, quality)},
    {"ms", "predicted mean", "ms", "Predicted mean time of a frame.",
     DIP_FACT(NUMBER, DipCostPrediction, ms), .most = DIP_COST_MOST_MS, .digits = 2},
    {"p95_ms", "predicted p95", "ms", "Predicted 95th percentile of the frames along the path.",
     DIP_FACT(NUMBER, DipCostPrediction, p95_ms), .most = DIP_COST_MOST_MS, .digits = 2},
    {"flip", "predicted FLIP", NULL, "Predicted mean FLIP of a frame.",
     DIP_FACT(NUMBER, DipCostPrediction, flip), .most = DIP_COST_MOST_MEAN, .digits = 4},
    {"row", NULL, NULL, "Index of the row that measured the combination, or -1.",
     DIP_FACT(WHOLE, DipCostPrediction, row), .least = -1, .most = DIP_COST_MAX_ROWS - 1},
};

DIP_OF_ITEM(bool, check_prediction,
            ((const DipCostPrediction *)at->item)->row < dip_cost_report_of(at)->row_count)

const DipRecord dip_cost_prediction_of_report_record = DIP_RECORD(
    "prediction", "A combination whose time and error were predicted from measured rows.",
    prediction_fields, DipCostPrediction, check_prediction);

static const DipField predictions_fields[] = {
    {"searched", NULL, NULL,
     "Number of all combinations that were predicted; 0 if it is not known. If there are more than "
     "`combinations` has, only those that were counted, measured or looked best were kept.",
     DIP_FACT(WHOLE, DipCostPredictions, searched), .most = INT_MAX},
    {"trained", NULL, NULL, "Number of rows that were measured to predict all others.",
     DIP_FACT(WHOLE, DipCostPredictions, trained), .most = DIP_COST_MAX_ROWS},
    {"misses", NULL, NULL, "How far the predictions lie from measurements.", PART,
     .record = &all_misses_record},
    {"combinations", NULL, NULL, "The combinations whose time and error were predicted.",
     DIP_LIST(.record = &dip_cost_prediction_of_report_record,
              DIP_ARRAY(DipCostPredictions, list, count), .points = true,
              .most = DIP_COST_MAX_ROWS)},
};
const DipRecord dip_cost_predictions_record =
    DIP_RECORD("predictions", "The combinations that --predict ranked.", predictions_fields,
               DipCostPredictions, NULL);

static const DipField elsewhere_fields[] = {
    {"settings", NULL, NULL, "All quality settings of the combination.",
     DIP_FACT(SETTINGS, DipCostElsewhere, quality)},
    {"ms", "mean", "ms", "Mean time of a frame with these settings under these conditions.",
     DIP_FACT(ESTIMATE, DipCostElsewhere, ms), .least = DIP_COST_LEAST_MS, .most = DIP_COST_MOST_MS,
     .digits = 2},
    STAGE_NAMES_FIELD(DipCostElsewhere, NULL),
    COUNTERS_FIELD(DipCostElsewhere, NULL),
};

DIP_OF_ITEM(bool, check_elsewhere, isfinite(((const DipCostElsewhere *)at->item)->ms.value))

const DipRecord dip_cost_elsewhere_record =
    DIP_RECORD("combination elsewhere",
               "A combination that was timed at another size, on another path or with another "
               "number of threads.",
               elsewhere_fields, DipCostElsewhere, check_elsewhere);

enum { MOST_SIDE = 16384 }; // Greatest width and height of a picture, in pixels.

static const DipField smaller_fields[] = {
    {"width", NULL, "px", "Width of the smaller pictures.",
     DIP_FACT(WHOLE, DipCostReport, smaller_width), .least = 1, .most = MOST_SIDE},
    {"height", NULL, "px", "Height of the smaller pictures.",
     DIP_FACT(WHOLE, DipCostReport, smaller_height), .least = 1, .most = MOST_SIDE},
    {"combinations", NULL, NULL, "The combinations that were timed at the smaller size.",
     DIP_LIST(.record = &dip_cost_elsewhere_record,
              DIP_ARRAY(DipCostReport, smaller, smaller_count), .most = DIP_COST_MAX_SMALLER)},
};

bool dip_cost_has_smaller(const DipFieldAt *at) {
    return dip_cost_report_of(at)->smaller_count > 0;
}

const DipRecord dip_cost_smaller_record =
    DIP_RECORD("smaller pictures",
               "A few combinations at about half the width and height, which tell work that grows "
               "with the picture from work that does not.",
               smaller_fields, DipCostReport, dip_cost_has_smaller);
