// Writes the rows as Markdown tables, one per topic.
#include "tests/stability/document.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_LINE = 1024 };

size_t stability_row_count(void) {
    size_t count = 0;
    for (size_t t = 0; t < stability_topic_count; t++) {
        count += stability_topics[t]->row_count;
    }
    return count;
}

static const char *const introduction =
    "# Numerical stability\n"
    "\n"
    "This page lists inputs that are numerically difficult for a renderer, and what Diptych\n"
    "promises for each. The program `stability` (`tests/stability/`) writes the page from the\n"
    "tests: `build/ci/tests/stability/stability --document docs/stability.md`.\n"
    "\n"
    "Each row states a promise, the independent truth that the test compares Diptych with, and\n"
    "the greatest error that the test accepts. Then come the number of cases that the test\n"
    "compares, with each instruction set, and the greatest error that it found. A row has several\n"
    "errors if its code is compiled once per instruction set, and the instruction sets differ.\n"
    "The hash is of the names of the cases and of the bits of all pictures and numbers that\n"
    "Diptych made for them: it must be the same with every instruction set, compiler and system.\n"
    "`./test` measures every row, and fails if a row has other cases or another hash than stand\n"
    "here. `diptych verify` measures every row with fewer cases. Rows N1 to N56 come from a list\n"
    "of cases that are known to be hard in this field. Rows A1 and up were added after attacks\n"
    "on Diptych.\n";

static void write_errors(FILE *file, const StabilityMeasured *measured) {
    bool same = true;
    int first = -1;
    for (int i = 0; i < DIP_ISA_COUNT; i++) {
        if (measured->known[i]) {
            same = same && (first < 0 || measured->worst[i] == measured->worst[first]);
            first = first < 0 ? i : first;
        }
    }
    if (first < 0) {
        fputs("not measured", file);
    } else if (same) {
        fprintf(file, "%.3g", measured->worst[first]);
    } else {
        const char *between = "";
        for (int i = 0; i < DIP_ISA_COUNT; i++) {
            if (measured->known[i]) {
                fprintf(file, "%s%s %.3g", between, dip_isa_name((DipIsa)i), measured->worst[i]);
                between = ", ";
            }
        }
    }
}

// Returns the least number of cases that an instruction set compared.
static uint64_t least_cases(const StabilityMeasured *measured) {
    uint64_t least = UINT64_MAX;
    for (int i = 0; i < DIP_ISA_COUNT; i++) {
        if (measured->known[i] && measured->cases[i] < least) {
            least = measured->cases[i];
        }
    }
    return least == UINT64_MAX ? 0 : least;
}

// Writes the hash, or all hashes if instruction sets differ, which --expect then refuses.
static void write_hashes(FILE *file, const StabilityMeasured *measured) {
    const char *last = "";
    for (int i = 0; i < DIP_ISA_COUNT; i++) {
        if (measured->known[i] && strcmp(measured->hash[i], last) != 0) {
            fprintf(file, "%s%s", *last ? ", " : "", measured->hash[i]);
            last = measured->hash[i];
        }
    }
}

// Formats the columns that --check compares.
static void format_row(const StabilityRow *row, char line[MAX_LINE]) {
    snprintf(line, MAX_LINE, "| %s | %s | %s | %.3g %s |", row->id, row->promise, row->truth,
             row->bound, row->unit);
}

static void write_topic(FILE *file, const StabilityTopic *topic,
                        const StabilityMeasured *measured) {
    fprintf(file, "\n## %s\n\n", topic->title);
    fputs("| row | promise | truth | bound | cases | hash | greatest error |\n"
          "|---|---|---|---|---|---|---|\n",
          file);
    for (size_t r = 0; r < topic->row_count; r++) {
        char line[MAX_LINE];
        format_row(&topic->rows[r], line);
        fprintf(file, "%s %" PRIu64 " | ", line, least_cases(&measured[r]));
        write_hashes(file, &measured[r]);
        fputs(" | ", file);
        write_errors(file, &measured[r]);
        fputs(" |\n", file);
    }
}

bool stability_document_write(const char *path, const StabilityMeasured *measured) {
    FILE *file = fopen(path, "w");
    if (!file) {
        return false;
    }
    fputs(introduction, file);
    for (size_t t = 0; t < stability_topic_count; t++) {
        write_topic(file, stability_topics[t], measured);
        measured += stability_topics[t]->row_count;
    }
    fprintf(file, "\n%s", stability_not_promised);
    const bool written = !ferror(file);
    return fclose(file) == 0 && written;
}

// Reads the number of cases and the hash from a line of the page that begins with the columns of a
// row. Returns false for another line, or if there is no number above 0 or no hash.
static bool read_row(const char *line, const StabilityRow *row, StabilityListed *listed) {
    char expected[MAX_LINE];
    format_row(row, expected);
    const size_t length = strlen(expected);
    return strncmp(line, expected, length) == 0 &&
           sscanf(line + length, "%" SCNu64 " | %32[0-9a-f] |", &listed->cases, listed->hash) ==
               2 &&
           listed->cases > 0;
}

static bool is_row_line(const char *line) {
    return strncmp(line, "| ", 2) == 0 && strncmp(line, "| row |", 7) != 0;
}

static const StabilityRow *row_at(size_t index) {
    size_t t = 0;
    while (t < stability_topic_count && index >= stability_topics[t]->row_count) {
        index -= stability_topics[t++]->row_count;
    }
    return t < stability_topic_count ? &stability_topics[t]->rows[index] : NULL;
}

bool stability_document_read(const char *path, StabilityListed *listed) {
    FILE *file = fopen(path, "r");
    if (!file) {
        fprintf(stderr, "%s: cannot be read\n", path);
        return false;
    }
    char line[MAX_LINE];
    size_t index = 0;
    bool agrees = true;
    while (agrees && fgets(line, sizeof line, file)) {
        if (is_row_line(line)) {
            const StabilityRow *row = row_at(index);
            agrees = row && read_row(line, row, &listed[index]);
            index++;
            if (!agrees) {
                fprintf(stderr, "%s: expected row %s, its number of cases and its hash, found %s",
                        path, row ? row->id : "(none)", line);
            }
        }
    }
    fclose(file);
    if (agrees && index != stability_row_count()) {
        fprintf(stderr, "%s: has %zu rows, but the catalogue has %zu\n", path, index,
                stability_row_count());
        return false;
    }
    return agrees;
}

bool stability_document_check(const char *path) {
    StabilityListed *listed = calloc(stability_row_count(), sizeof *listed);
    const bool agrees = listed && stability_document_read(path, listed);
    free(listed);
    return agrees;
}
