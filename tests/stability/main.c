// Measures the catalogue of hard cases and writes docs/stability.md.
#include "tests/stability/document.h"
#include "renderer/catalogue/shipped_hashes.h"
#include "renderer/catalogue/stability.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const usage =
    "Usage: stability [OPTION]...\n"
    "Measures the rows of the catalogue of hard cases (tests/stability/) with every instruction "
    "set\n"
    "of this machine. Exit code: 0 if every row holds, 1 if a row does not, 2 for a wrong option.\n"
    "\n"
    "  --list             List the rows without measuring them.\n"
    "  --topic NAME       Measure only the rows of this topic.\n"
    "  --row ID           Measure only this row, for example N26.\n"
    "  --isa NAME         Measure only with this instruction set.\n"
    "  --depth DEPTH      Number of cases: short, full (the default) or long.\n"
    "  --seed N           Seed of the random cases. The default is 1.\n"
    "  --threads N        Threads to draw with. The default is 2.\n"
    "  --document FILE    Also write the catalogue with the errors measured, as Markdown.\n"
    "  --check FILE       Only compare the rows with a file that --document wrote. Fails if a\n"
    "                     promise, a truth or a bound differs.\n"
    "  --expect FILE      Also compare the number of cases and the hash of each row with those in "
    "a\n"
    "                     file that --document wrote. Needs the depth full and the seed 1.\n"
    "  --print-hashes     Print the table of shipped hashes (shipped_list.inc) as this build "
    "draws\n"
    "                     the pictures.\n";

typedef struct Options {
    bool list;
    bool print_hashes;
    const char *topic;
    const char *row;
    const char *isa;
    StabilityDepth depth;
    uint64_t seed;
    int threads;
    const char *document;
    const char *check;
    const char *expect;
} Options;

static bool parse_depth(const char *text, StabilityDepth *depth) {
    static const char *const names[] = {"short", "full", "long"};
    for (int i = 0; i < 3; i++) {
        if (strcmp(text, names[i]) == 0) {
            *depth = (StabilityDepth)i;
            return true;
        }
    }
    return false;
}

static bool parse_value(const char *name, const char *value, Options *options) {
    DipIsa isa;
    char *end = NULL;
    if (strcmp(name, "--topic") == 0) {
        options->topic = value;
    } else if (strcmp(name, "--row") == 0) {
        options->row = value;
    } else if (strcmp(name, "--isa") == 0) {
        options->isa = value;
        return dip_isa_parse(value, &isa) && dip_isa_available(isa);
    } else if (strcmp(name, "--depth") == 0) {
        return parse_depth(value, &options->depth);
    } else if (strcmp(name, "--seed") == 0) {
        options->seed = strtoull(value, &end, 10);
        return *value && !*end;
    } else if (strcmp(name, "--threads") == 0) {
        options->threads = (int)strtol(value, &end, 10);
        return *value && !*end && options->threads >= 1 && options->threads <= DIP_MAX_THREADS;
    } else if (strcmp(name, "--document") == 0) {
        options->document = value;
    } else if (strcmp(name, "--check") == 0) {
        options->check = value;
    } else if (strcmp(name, "--expect") == 0) {
        options->expect = value;
    } else {
        return false;
    }
    return true;
}

static bool parse_options(int argc, char **argv, Options *options) {
    *options = (Options){.depth = STABILITY_FULL, .seed = 1, .threads = 2};
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--list") == 0) {
            options->list = true;
        } else if (strcmp(argv[i], "--print-hashes") == 0) {
            options->print_hashes = true;
        } else if (strcmp(argv[i], "--help") == 0) {
            fputs(usage, stdout);
            exit(0);
        } else if (i + 1 >= argc || !parse_value(argv[i], argv[i + 1], options)) {
            fprintf(stderr, "stability: %s is no option, or its value is missing or wrong\n%s",
                    argv[i], usage);
            return false;
        } else {
            i++;
        }
    }
    if (options->expect && (options->depth != STABILITY_FULL || options->seed != 1)) {
        fprintf(stderr, "stability: --expect needs the depth full and the seed 1\n");
        return false;
    }
    return true;
}

static bool is_chosen(const Options *options, const StabilityTopic *topic,
                      const StabilityRow *row) {
    return (!options->topic || strcmp(options->topic, topic->name) == 0) &&
           (!options->row || strcmp(options->row, row->id) == 0);
}

static void list_rows(const Options *options) {
    for (size_t t = 0; t < stability_topic_count; t++) {
        const StabilityTopic *topic = stability_topics[t];
        for (size_t r = 0; r < topic->row_count; r++) {
            const StabilityRow *row = &topic->rows[r];
            if (is_chosen(options, topic, row)) {
                printf("%-9s %-4s %s\n", topic->name, row->id, row->promise);
            }
        }
    }
}

static void print_result(const StabilityRow *row, const StabilityRun *run, bool holds) {
    printf("%-4s %-7s %-6s %-10.3g bound %-10.3g %s\n", row->id,
           row->per_isa ? dip_isa_name(run->isa) : "-", holds ? "holds" : "FAILS", run->worst,
           row->bound, row->unit);
    if (!holds) {
        printf("     %s\n     %s\n", row->promise, run->broken ? run->broken_why : run->worst_at);
    }
    fflush(stdout);
}

// Breaks the row if it compared other cases than the page lists, or has other results.
static void compare_with_page(StabilityRun *run, const char *hash, const StabilityListed *listed) {
    if (run->case_count != listed->cases) {
        stability_break(run, "the row compared %" PRIu64 " cases, expected %" PRIu64,
                        run->case_count, listed->cases);
    } else if (strcmp(hash, listed->hash) != 0) {
        stability_break(run, "the cases and results have the hash %s, expected %s", hash,
                        listed->hash);
    }
}

// Measures a row with each instruction set that the options choose. listed: what the page says of
// it, if the options name a page. Returns the number of failures.
static int measure_row(const Options *options, const StabilityRow *row, DipPool *pool,
                       const StabilityListed *listed, StabilityMeasured *measured) {
    int failures = 0;
    for (int i = 0; i < DIP_ISA_COUNT; i++) {
        const DipIsa isa = (DipIsa)i;
        const bool chosen = options->isa   ? strcmp(dip_isa_name(isa), options->isa) == 0
                            : row->per_isa ? dip_isa_available(isa)
                                           : isa == dip_isa_best();
        if (!chosen) {
            continue;
        }
        StabilityRun run = {
            .isa = isa, .pool = pool, .depth = options->depth, .seed = options->seed};
        bool holds = stability_measure(row, &run);
        dip_hash_hex(&run.hash, measured->hash[i]);
        if (holds && options->expect) {
            compare_with_page(&run, measured->hash[i], listed);
            holds = !run.broken;
        }
        failures += !holds;
        measured->known[i] = !run.broken;
        measured->worst[i] = run.worst;
        measured->cases[i] = run.case_count;
        print_result(row, &run, holds);
    }
    return failures;
}

// listed: what the page says of each row, if the options name a page.
static int measure_rows(const Options *options, DipPool *pool, const StabilityListed *listed,
                        StabilityMeasured *measured) {
    int failures = 0;
    int count = 0;
    size_t index = 0;
    for (size_t t = 0; t < stability_topic_count; t++) {
        const StabilityTopic *topic = stability_topics[t];
        for (size_t r = 0; r < topic->row_count; r++, index++) {
            if (is_chosen(options, topic, &topic->rows[r])) {
                failures +=
                    measure_row(options, &topic->rows[r], pool, &listed[index], &measured[index]);
                count++;
            }
        }
    }
    printf("%d rows measured, %d measurements outside their bounds\n", count, failures);
    return count ? failures : 1;
}

static int run(const Options *options) {
    DipError err;
    DipPool *pool = dip_pool_create(options->threads, &err);
    StabilityMeasured *measured = calloc(stability_row_count(), sizeof *measured);
    StabilityListed *listed = calloc(stability_row_count(), sizeof *listed);
    int failures = 1;
    if (!pool || !measured || !listed) {
        fprintf(stderr, "stability: no memory or no threads\n");
    } else if (options->print_hashes) {
        failures = !stability_print_hashes(pool);
    } else if (!options->expect || stability_document_read(options->expect, listed)) {
        failures = measure_rows(options, pool, listed, measured);
        if (options->document && !stability_document_write(options->document, measured)) {
            fprintf(stderr, "stability: cannot write %s\n", options->document);
            failures++;
        }
    }
    free(listed);
    free(measured);
    dip_pool_destroy(&pool);
    return failures != 0;
}

int main(int argc, char **argv) {
    Options options;
    if (!parse_options(argc, argv, &options)) {
        return 2;
    }
    if (options.list) {
        list_rows(&options);
        return 0;
    }
    return options.check ? !stability_document_check(options.check) : run(&options);
}
