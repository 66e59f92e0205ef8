// Lists of the fields that have the same name in the JSON report as in the C structs.
#ifndef DIP_APP_REPORT_FORMAT_JSON_FIELDS_H
#define DIP_APP_REPORT_FORMAT_JSON_FIELDS_H

// X(field): the texts in DipCostReport.
#define DIP_COST_HEADER_TEXTS(X) X(version) X(build) X(scene) X(scene_hash) X(processor) X(isa)

// X(field, greatest value): numbers of DipCostReport (HEADER) and of its options (OPTION). They are
// whole numbers from 0 on.
#define DIP_COST_HEADER_NUMBERS(X)                                                                 \
    X(threads, 256)                                                                                \
    X(width, 8192)                                                                                 \
    X(height, 8192)                                                                                \
    X(rounds, 10000)                                                                               \
    X(combined_first, DIP_COST_MAX_ROWS)
#define DIP_COST_OPTION_NUMBERS(X)                                                                 \
    X(places, DIP_COST_MAX_PLACES)                                                                 \
    X(burst, DIP_COST_MAX_BURST)                                                                   \
    X(samples, 4096)                                                                               \
    X(timed_frames, 100)                                                                           \
    X(budget_of, 2)                                                                                \
    X(seed, 0x7fffffff)

// X(field): the fields of DipTimePair. Each is an array of a row, in the order of the path.
#define DIP_COST_PAIR_FIELDS(X) X(ms) X(base_ms) X(wait) X(base_wait) X(cpu_ms) X(switches)

// The format of cost.json. It changes when a reader of the last format would misread a file.
#define DIP_COST_JSON_FORMAT 2

#endif
