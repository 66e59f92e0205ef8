// Tests of the table that compares the machines of merged parts.
#include "app/cost/merge/merge_machines.h"
#include "tests/app/cost/made_report.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// Adds a part whose row aa=4 takes `ms` milliseconds beside a baseline of 1 ms.
static void add_part(DipCostMachines *machines, const char *processor, int rounds, double ms) {
    DipCostReport part;
    DipError err = {0};
    dip_made_report(&part, rounds);
    snprintf(part.processor, sizeof part.processor, "%s", processor);
    if (rounds > 0) {
        dip_made_times(&part, part.sweeps[0].rows[part.sweeps[0].row_count - 1], ms);
        assert_true(dip_cost_estimate_times(&part, &err));
    }
    dip_cost_machines_add(machines, &part);
    dip_cost_report_free(&part);
}

static char *print(const DipCostMachines *machines) {
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    dip_cost_machines_print(machines, out);
    fclose(out);
    return text;
}

static void machines_with_times_are_compared(void **state) {
    (void)state;
    DipCostMachines *machines = calloc(1, sizeof *machines);
    assert_non_null(machines);
    add_part(machines, "no times", 0, 4.0);
    add_part(machines, "first machine", 4, 4.0);
    add_part(machines, "equal machine", 4, 4.0);
    add_part(machines, "slow machine", 4, 6.0);
    assert_int_equal(machines->count, 3);
    char *text = print(machines);
    assert_non_null(strstr(text, "the 3 parts that have times"));
    assert_null(strstr(text, "no times"));
    assert_non_null(strstr(text, "  1  first machine"));
    assert_non_null(strstr(text, "  3  slow machine"));
    assert_non_null(strstr(text, "   4.000    4.000    6.000*\n"));
    free(text);
    free(machines);
}

static void one_machine_needs_no_table(void **state) {
    (void)state;
    DipCostMachines *machines = calloc(1, sizeof *machines);
    assert_non_null(machines);
    add_part(machines, "first machine", 4, 4.0);
    add_part(machines, "no times", 0, 4.0);
    char *text = print(machines);
    assert_string_equal(text, "");
    free(text);
    free(machines);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(machines_with_times_are_compared),
        cmocka_unit_test(one_machine_needs_no_table),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
