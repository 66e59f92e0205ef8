// Makes a table that compares machines. The reports that `diptych cost merge` joins are called
// parts. The table has the machine of each part that has times. The merged report has the times of
// only one of these machines.
#ifndef DIP_APP_COST_MERGE_MERGE_MACHINES_H
#define DIP_APP_COST_MERGE_MERGE_MACHINES_H

#include "app/report/report.h"

#include <stdio.h>

enum { DIP_COST_MACHINE_ROWS = DIP_SETTING_COUNT };

// What one part tells about its machine and its times.
typedef struct DipCostMachine {
    char processor[DIP_COST_TEXT];
    char isa[16];
    int threads;
    DipCostVerdict verdict;
    double base_ms; // Mean time of the baseline on path 0.
    DipEstimate ratios[DIP_COST_MACHINE_ROWS];
} DipCostMachine;

// The machines in the order of the parts. Zero-initialise the struct; it owns nothing.
typedef struct DipCostMachines {
    DipCostMachine list[DIP_COST_MAX_PARTS];
    int count;
    // Names of the compared ratios, such as "aa 8 / none". A ratio is the time of the last step of
    // a setting's first sweep, divided by the time of the sweep's base. If the last step is the
    // base, the ratio has the first step instead.
    char rows[DIP_COST_MACHINE_ROWS][DIP_COST_TEXT];
    int row_count;
} DipCostMachines;

// Adds the machine of a part, unless the part has no times. All parts must have the same sweeps.
void dip_cost_machines_add(DipCostMachines *machines, const DipCostReport *part);

// Prints the table if at least two parts have times.
void dip_cost_machines_print(const DipCostMachines *machines, FILE *out);

#endif
