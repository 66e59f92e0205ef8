// Writes the rows as Markdown tables, one per topic.
#include "tests/stability/document.h"

#include <stdio.h>
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
    "the greatest error that the test accepts. The last column has the greatest error that the\n"
    "test found. A row has several errors if its code is compiled once per instruction set, and\n"
    "the instruction sets differ. `./test` measures every row; `diptych verify` measures every\n"
    "row with fewer cases. Rows N1 to N56 come from a list of cases that are known to be hard in\n"
    "this field. Rows A1 and up were added after attacks on Diptych.\n";

static void write_errors(FILE *file, const StabilityErrors *errors) {
    bool same = true;
    int first = -1;
    for (int i = 0; i < DIP_ISA_COUNT; i++) {
        if (errors->known[i]) {
            same = same && (first < 0 || errors->worst[i] == errors->worst[first]);
            first = first < 0 ? i : first;
        }
    }
    if (first < 0) {
        fputs("not measured", file);
    } else if (same) {
        fprintf(file, "%.3g", errors->worst[first]);
    } else {
        const char *between = "";
        for (int i = 0; i < DIP_ISA_COUNT; i++) {
            if (errors->known[i]) {
                fprintf(file, "%s%s %.3g", between, dip_isa_name((DipIsa)i), errors->worst[i]);
                between = ", ";
            }
        }
    }
}

// Formats the columns that --check compares.
static void format_row(const StabilityRow *row, char line[MAX_LINE]) {
    snprintf(line, MAX_LINE, "| %s | %s | %s | %.3g %s |", row->id, row->promise, row->truth,
             row->bound, row->unit);
}

static void write_topic(FILE *file, const StabilityTopic *topic, const StabilityErrors *errors) {
    fprintf(file, "\n## %s\n\n", topic->title);
    fputs("| row | promise | truth | bound | greatest error |\n|---|---|---|---|---|\n", file);
    for (size_t r = 0; r < topic->row_count; r++) {
        char line[MAX_LINE];
        format_row(&topic->rows[r], line);
        fprintf(file, "%s ", line);
        write_errors(file, &errors[r]);
        fputs(" |\n", file);
    }
}

bool stability_document_write(const char *path, const StabilityErrors *errors) {
    FILE *file = fopen(path, "w");
    if (!file) {
        return false;
    }
    fputs(introduction, file);
    for (size_t t = 0; t < stability_topic_count; t++) {
        write_topic(file, stability_topics[t], errors);
        errors += stability_topics[t]->row_count;
    }
    fprintf(file, "\n%s", stability_not_promised);
    const bool written = !ferror(file);
    return fclose(file) == 0 && written;
}

// Returns whether a line of the page begins with the columns of a row.
static bool line_has_row(const char *line, const StabilityRow *row) {
    char expected[MAX_LINE];
    format_row(row, expected);
    return strncmp(line, expected, strlen(expected)) == 0;
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

bool stability_document_check(const char *path) {
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
            const StabilityRow *row = row_at(index++);
            agrees = row && line_has_row(line, row);
            if (!agrees) {
                fprintf(stderr, "%s: expected row %s, found %s", path, row ? row->id : "(none)",
                        line);
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
