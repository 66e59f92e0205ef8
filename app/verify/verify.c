// Implements the command `diptych verify`. Draws pictures with every instruction set of the
// machine, on one thread and on several, and compares them with the hashes that Diptych ships. Then
// measures the catalogue of hard cases (docs/stability.md). Prints the results of both.
#include "app/verify/verify.h"

#include "app/cli/machine.h"
#include "app/cli/progress.h"
#include "renderer/base/assert.h"
#include "renderer/base/pool.h"
#include "renderer/catalogue/shipped_hashes.h"
#include "renderer/catalogue/stability.h"

#include <stdio.h>

typedef struct VerifyOptions {
    DipProgramOptions program;
    bool all;     // True to run as many cases of each row of the catalogue as ./test does.
    int threads;  // The number of threads to compare with one thread; 0 for all processors, at
                  // least 2.
    bool verbose; // True to print every row of the catalogue.
} VerifyOptions;

// A verification in progress. A row of the catalogue is one promise, with its hard cases.
typedef struct Verification {
    const VerifyOptions *options;
    int threads[2];    // 1, and the number that the options ask for.
    DipPool *pools[2]; // A pool with each of these numbers of threads.
    DipProgress progress;
    int64_t done;
    uint64_t differing_pictures;
    int failing_rows;
    int row_count;
} Verification;

static void count_step(void *context) {
    Verification *verification = context;
    dip_progress_show(&verification->progress, ++verification->done);
}

// --- pictures ---------------------------------------------------------------------------------

// The result of drawing all pictures with one instruction set and one number of threads.
typedef struct PictureResult {
    uint64_t differing; // Number of pictures whose hash differs; all if they could not be drawn.
    char first[200];    // The first case that differs, or why the pictures could not be drawn.
} PictureResult;

static PictureResult draw_pictures(Verification *verification, DipIsa isa, int pool) {
    StabilityRun run = {.isa = isa, .pool = verification->pools[pool], .depth = STABILITY_FULL};
    PictureResult result = {0};
    stability_compare_hashes(&run, count_step, verification);
    result.differing = run.broken ? stability_hash_count : run.failed_count;
    snprintf(result.first, sizeof result.first, "%.199s",
             run.broken ? run.broken_why : run.worst_at);
    verification->differing_pictures += result.differing;
    return result;
}

static void print_picture_result(const PictureResult *result) {
    if (result->differing) {
        printf("  %llu of %zu differ (%s)", (unsigned long long)result->differing,
               stability_hash_count, result->first);
    } else {
        printf("  %-20s", "the same bits");
    }
}

static void verify_pictures(Verification *verification) {
    PictureResult results[DIP_ISA_COUNT][2];
    for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
        for (int p = 0; p < 2 && dip_isa_available((DipIsa)isa); p++) {
            results[isa][p] = draw_pictures(verification, (DipIsa)isa, p);
        }
    }
    dip_progress_end(&verification->progress, verification->done);
    printf("\nPictures: %zu pictures, compared with the hashes that Diptych ships\n",
           stability_hash_count);
    printf("  %-10s  %-20s  %d threads\n", "", "1 thread", verification->threads[1]);
    for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
        if (dip_isa_available((DipIsa)isa)) {
            printf("  %-10s", dip_isa_name((DipIsa)isa));
            print_picture_result(&results[isa][0]);
            print_picture_result(&results[isa][1]);
            printf("\n");
        }
    }
}

// --- hard cases -------------------------------------------------------------------------------

// The result of a row over all instruction sets with which it is measured.
typedef struct RowResult {
    bool holds;
    double worst;  // Greatest error.
    char why[400]; // Describes the case that breaks the promise, if one does.
} RowResult;

static RowResult measure_row(const Verification *verification, const StabilityRow *row) {
    RowResult result = {.holds = true};
    for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
        if (!(row->per_isa ? dip_isa_available((DipIsa)isa) : (DipIsa)isa == dip_isa_best())) {
            continue;
        }
        StabilityRun run = {
            .isa = (DipIsa)isa,
            .pool = verification->pools[1],
            .depth = verification->options->all ? STABILITY_FULL : STABILITY_SHORT,
            .seed = 1,
        };
        if (!stability_measure(row, &run) && result.holds) {
            result.holds = false;
            snprintf(result.why, sizeof result.why, "%s: %.370s", dip_isa_name((DipIsa)isa),
                     run.broken ? run.broken_why : run.worst_at);
        }
        result.worst = run.worst > result.worst ? run.worst : result.worst;
    }
    return result;
}

static void print_row(const StabilityRow *row, const RowResult *result) {
    printf("    %-4s %s\n         %s: greatest error %.3g, accepted %.3g %s\n", row->id,
           row->promise, result->holds ? "holds" : "BROKEN", result->worst, row->bound, row->unit);
    if (!result->holds) {
        printf("         %s\n", result->why);
    }
}

static int verify_topic(Verification *verification, const StabilityTopic *topic) {
    RowResult results[64];
    int failing = 0;
    DIP_ASSERT(topic->row_count <= DIP_ARRAY_COUNT(results));
    for (size_t r = 0; r < topic->row_count; r++) {
        results[r] = measure_row(verification, &topic->rows[r]);
        failing += !results[r].holds;
        count_step(verification);
    }
    dip_progress_end(&verification->progress, verification->done);
    printf("  %-45s %2zu promises, %s", topic->title, topic->row_count,
           failing ? "" : "all hold\n");
    if (failing) {
        printf("%d BROKEN\n", failing);
    }
    for (size_t r = 0; r < topic->row_count; r++) {
        if (verification->options->verbose || !results[r].holds) {
            print_row(&topic->rows[r], &results[r]);
        }
    }
    fflush(stdout);
    return failing;
}

static void verify_rows(Verification *verification) {
    printf("\nHard cases (docs/stability.md)\n");
    for (size_t t = 0; t < stability_topic_count; t++) {
        verification->failing_rows += verify_topic(verification, stability_topics[t]);
        verification->row_count += (int)stability_topics[t]->row_count;
    }
}

// --- command ----------------------------------------------------------------------------------

static void print_machine(void) {
    char processor[128];
    dip_machine_processor(processor, sizeof processor);
    printf("Diptych %s, built with %s %s\n%s, %d processors online\n", DIP_VERSION,
#if defined(__clang__)
           "clang", __clang_version__,
#else
           "gcc", __VERSION__,
#endif
           processor, dip_machine_processor_count());
}

static int64_t count_steps(void) {
    int64_t steps = 0;
    for (int isa = 0; isa < DIP_ISA_COUNT; isa++) {
        steps += dip_isa_available((DipIsa)isa) ? 2 * (int64_t)stability_hash_count : 0;
    }
    for (size_t t = 0; t < stability_topic_count; t++) {
        steps += (int64_t)stability_topics[t]->row_count;
    }
    return steps;
}

static bool conclude(const Verification *verification, DipError *err) {
    if (!verification->differing_pictures && !verification->failing_rows) {
        printf("\nVerified: this machine draws the same bits, and all %d promises hold.\n",
               verification->row_count);
        return true;
    }
    return dip_error_set_runtime(err, DIP_ERROR_RUNTIME, NULL, 0, "verify",
                                 "%llu pictures differ and %d of %d promises are broken; please "
                                 "report the output above",
                                 (unsigned long long)verification->differing_pictures,
                                 verification->failing_rows, verification->row_count);
}

static bool run_verify(DipSession *session, const void *arguments, DipError *err) {
    (void)session;
    const VerifyOptions *options = arguments;
    const int processors = dip_machine_processor_count();
    Verification verification = {.options = options, .threads = {1, options->threads}};
    if (!options->threads) {
        verification.threads[1] = processors < 2 ? 2 : processors;
    }
    bool opened = true;
    for (int p = 0; p < 2 && opened; p++) {
        verification.pools[p] = dip_pool_create(verification.threads[p], err);
        opened = verification.pools[p] != NULL;
    }
    if (opened) {
        verification.progress = dip_progress_begin("steps", count_steps());
        print_machine();
        verify_pictures(&verification);
        verify_rows(&verification);
    }
    dip_pool_destroy(&verification.pools[0]);
    dip_pool_destroy(&verification.pools[1]);
    return opened && conclude(&verification, err);
}

#define FIELD(name) offsetof(VerifyOptions, name)

static const DipOptionRow rows[] = {
    {"--threads", "N", DIP_OPTION_INTEGER, FIELD(threads), .least = 0, .most = DIP_MAX_THREADS,
     .text =
         "Compare one thread with this many threads. 0, the default, stands for all processors, "
         "but at least 2 threads."},
    {"--all", NULL, DIP_OPTION_FLAG, FIELD(all),
     .text = "Run as many cases of every hard case as the tests do. This takes a few minutes."},
    {"--list", NULL, DIP_OPTION_FLAG, FIELD(verbose),
     .text = "Also print every promise, its bound and the greatest error found."},
};

static const DipOptionTable table = DIP_OPTION_TABLE("What to verify", rows);

static const DipOptionPart parts[] = {
    {&table, 0},
    {&dip_program_option_table, FIELD(program)},
};
static const DipOptionParts all_parts = {parts, DIP_ARRAY_COUNT(parts)};

static const DipExample examples[] = {
    {"diptych verify", "checks this machine in about ten seconds"},
    {"diptych verify --list", "also prints every promise and the error found"},
};

const DipCommand dip_verify_command = {
    .name = "verify",
    .summary = "check that this machine draws the same bits, and that hard cases hold",
    .usage = "[OPTION]...",
    .text =
        "Verify draws pictures with every instruction set of this machine, on one thread and on "
        "several, and compares them with the hashes that Diptych ships. Then it measures the "
        "catalogue of numerically hard cases, each against an independent truth. The exit code "
        "is 0 if every picture has the same bits and every promise holds, and 1 otherwise.\n\n"
        "The page docs/stability.md lists the promises. Verify needs no scene, no window and "
        "no files.",
    .examples = examples,
    .example_count = DIP_ARRAY_COUNT(examples),
    .parts = &all_parts,
    .options_size = sizeof(VerifyOptions),
    .run = run_verify,
};
