// Prints the cycles that stages take per unit of their work, and these cycles divided by the unit's
// floor: the fewest cycles in which a core can do a unit of this work (gap.h).
#include "app/bench/gap.h"

#include "renderer/base/assert.h"

typedef struct Unit {
    const char *name;
    DipBenchStage stage; // the stage in which the unit's work is done
    int counter;         // index of the counter that counts the units
    double floors[4]; // cycles per unit with 1, 2, 4 and 8 samples per pixel; if the last three are
                      // 0, the first holds for any number of samples
} Unit;

static const Unit units[] = {
    {"triangle", DIP_BENCH_STAGE_geometry, DIP_COUNTER_triangles_in, {DIP_BENCH_FLOOR_TRIANGLE}},
    {"tile triangle",
     DIP_BENCH_STAGE_raster,
     DIP_COUNTER_tile_triangles,
     {DIP_BENCH_FLOOR_TILE_TRIANGLE}},
    {"sub-block",
     DIP_BENCH_STAGE_raster,
     DIP_COUNTER_sub_blocks_tested,
     {DIP_BENCH_FLOOR_SUB_BLOCK_1, DIP_BENCH_FLOOR_SUB_BLOCK_2, DIP_BENCH_FLOOR_SUB_BLOCK_4,
      DIP_BENCH_FLOOR_SUB_BLOCK_8}},
    {"fragment", DIP_BENCH_STAGE_shading, DIP_COUNTER_fragments_shaded, {DIP_BENCH_FLOOR_FRAGMENT}},
    {"probe", DIP_BENCH_STAGE_shading, DIP_COUNTER_texture_probes, {DIP_BENCH_FLOOR_PROBE}},
};

// Returns the floor of a unit. For 6 samples, this is the floor for 4.
static double floor_of(const Unit *unit, int sample_count) {
    const int index = sample_count >= 8 ? 3 : sample_count >= 4 ? 2 : sample_count - 1;
    return unit->floors[index] > 0.0 ? unit->floors[index] : unit->floors[0];
}

static void print_row(const DipBenchResult *result, int combination, double ns_per_cycle,
                      FILE *out) {
    const DipBenchValues values = dip_bench_values(result->plan, combination);
    const int sample_count = dip_quality_sample_count(&values.set->quality);
    double work[DIP_COUNTER_COUNT];
    dip_bench_result_work(result, combination, work);
    fprintf(out, "%12d", combination + 1);
    for (size_t i = 0; i < DIP_ARRAY_COUNT(units); i++) {
        const Unit *unit = &units[i];
        if (work[unit->counter] > 0.0) {
            const double cycles = dip_bench_result_fastest_ms(result, combination, unit->stage) *
                                  1e6 * values.threads / ns_per_cycle / work[unit->counter];
            fprintf(out, " %9.1f %7.1fx", cycles, cycles / floor_of(unit, sample_count));
        } else {
            fprintf(out, " %9s %8s", "-", "-");
        }
    }
    fprintf(out, "\n");
}

void dip_bench_print_gap(const DipBenchResult *result, double ns_per_cycle, FILE *out) {
    fprintf(out,
            "\nCycles of all threads per unit of work, and how many times the floor that is. A\n"
            "stage's whole time, the shortest of each frame in any round, is divided by each of\n"
            "its units. One cycle is %.3f ns.\n"
            "%-12s",
            ns_per_cycle, "stage");
    for (size_t i = 0; i < DIP_ARRAY_COUNT(units); i++) {
        fprintf(out, " %18s", dip_bench_stage_names[units[i].stage]);
    }
    fprintf(out, "\n%-12s", "row");
    for (size_t i = 0; i < DIP_ARRAY_COUNT(units); i++) {
        fprintf(out, " %18s", units[i].name);
    }
    fprintf(out, "\n");
    for (int c = 0; c < result->plan->count; c++) {
        print_row(result, c, ns_per_cycle, out);
    }
}
