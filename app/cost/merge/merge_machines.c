// Collects what the parts of a merged report tell about the machines that timed them, and prints a
// table of these machines.
#include "app/cost/merge/merge_machines.h"

#include "app/files/put.h"

// True if an earlier sweep of the report has the same setting.
static bool is_repeated(const DipCostReport *report, int sweep) {
    for (int s = 0; s < sweep; s++) {
        if (report->sweeps[s].setting == report->sweeps[sweep].setting) {
            return true;
        }
    }
    return false;
}

// Returns the index of a sweep's last step, or of its first step if the last one is the sweep's
// base.
static int far_step(const DipCostSweep *sweep) {
    const int last = sweep->row_count - 1;
    return sweep->rows[last] == sweep->base ? 0 : last;
}

static void name_row(const DipCostReport *part, const DipCostSweep *sweep,
                     char name[DIP_COST_TEXT]) {
    char base[DIP_COST_TEXT], step[DIP_COST_TEXT];
    dip_cost_step_text(part, sweep, sweep->base, base);
    dip_cost_step_text(part, sweep, sweep->rows[far_step(sweep)], step);
    snprintf(name, DIP_COST_TEXT, "%s %.60s / %.60s", dip_setting_info(sweep->setting)->key, step,
             base);
}

void dip_cost_machines_add(DipCostMachines *machines, const DipCostReport *part) {
    if (part->rounds == 0 || machines->count == DIP_COST_MAX_PARTS) {
        return;
    }
    DipCostMachine *machine = &machines->list[machines->count++];
    *machine = (DipCostMachine){
        .threads = part->threads,
        .verdict = part->verdict,
        .base_ms = dip_cost_ms(part, part->base_rows[0]),
    };
    snprintf(machine->processor, sizeof machine->processor, "%s", part->processor);
    snprintf(machine->isa, sizeof machine->isa, "%s", part->isa);
    machines->row_count = 0;
    for (int s = 0; s < part->sweep_count; s++) {
        const DipCostSweep *sweep = &part->sweeps[s];
        if (!is_repeated(part, s) && sweep->row_count > 1) {
            machine->ratios[machines->row_count] = sweep->ratios[far_step(sweep)];
            name_row(part, sweep, machines->rows[machines->row_count++]);
        }
    }
}

static void print_row(const DipCostMachines *machines, int row, FILE *out) {
    const DipEstimate *first = &machines->list[0].ratios[row];
    dip_put_text(out, "  %-40s", machines->rows[row]);
    for (int m = 0; m < machines->count; m++) {
        const DipEstimate *ratio = &machines->list[m].ratios[row];
        const bool is_apart = ratio->low > first->high || ratio->high < first->low;
        dip_put_text(out, " %7.3f%c", ratio->value, is_apart ? '*' : ' ');
    }
    dip_put_text(out, "\n");
}

void dip_cost_machines_print(const DipCostMachines *machines, FILE *out) {
    if (machines->count < 2) {
        return;
    }
    dip_put_text(
        out,
        "Machines of the %d parts that have times. The report has the times of machine 1.\n"
        "  %-2s %-40s %7s %-8s %-7s %11s\n",
        machines->count, "", "", "threads", "isa", "verdict", "baseline ms");
    for (int m = 0; m < machines->count; m++) {
        const DipCostMachine *machine = &machines->list[m];
        dip_put_text(out, "  %-2d %-40.40s %7d %-8s %-7s %11.3f\n", m + 1, machine->processor,
                     machine->threads, machine->isa, dip_cost_verdict_names[machine->verdict],
                     machine->base_ms);
    }
    dip_put_text(
        out,
        "Time of each setting's last step / time of the base of its sweep. A star marks a ratio "
        "whose 95 %% interval lies apart from that of machine 1.\n  %-40s",
        "");
    for (int m = 0; m < machines->count; m++) {
        dip_put_text(out, " %7d ", m + 1);
    }
    dip_put_text(out, "\n");
    for (int row = 0; row < machines->row_count; row++) {
        print_row(machines, row, out);
    }
    dip_put_text(out, "\n");
}
