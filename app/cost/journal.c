// The journal is a text file. Each line has a kind, a key, numbers in exact hexadecimal notation,
// and a checksum.
#include "app/cost/journal.h"

#include "renderer/base/hash.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { KEY_LENGTH = 32 };

typedef struct Entry {
    bool is_round;
    char key[KEY_LENGTH + 1];
    double *values;
    int count;
} Entry;

struct DipCostJournal {
    char file[PATH_MAX];
    char plan[KEY_LENGTH + 1];
    FILE *out;
    Entry *entries;
    int count;
    int capacity;
};

static bool io_fault(const DipCostJournal *journal, DipError *err) {
    return dip_error_set_runtime(err, DIP_ERROR_IO, journal->file, 0, NULL, "cannot be written: %s",
                                 strerror(errno));
}

// Appends an entry and takes ownership of its values.
static bool keep(DipCostJournal *journal, const Entry *entry) {
    if (journal->count == journal->capacity) {
        const int capacity = journal->capacity ? 2 * journal->capacity : 256;
        Entry *entries = realloc(journal->entries, (size_t)capacity * sizeof *entries);
        if (!entries) {
            return false;
        }
        journal->entries = entries;
        journal->capacity = capacity;
    }
    journal->entries[journal->count++] = *entry;
    return true;
}

static void check_of(const char *text, size_t length, char check[33]) {
    DipHash hash = dip_hash_begin(0);
    dip_hash_bytes(&hash, text, length);
    dip_hash_hex(&hash, check);
}

// Reads the text from..end as numbers separated by spaces. Returns NULL if the text has another
// form.
static double *read_values(const char *from, const char *end, int *count) {
    int room = 1;
    for (const char *c = from; c < end; c++) {
        room += *c == ' ';
    }
    double *values = malloc((size_t)room * sizeof *values);
    *count = 0;
    while (values && from < end) {
        char *rest;
        values[*count] = strtod(from, &rest);
        if (rest == from || rest > end) {
            free(values);
            return NULL;
        }
        ++*count;
        from = rest + (rest < end);
    }
    return values;
}

// Reads and keeps one line without its line break: "errors KEY v v ... CHECK" or "round PLAN v v
// ... CHECK". Ignores a line whose checksum CHECK is wrong.
static void read_line(DipCostJournal *journal, char *line, size_t length) {
    Entry entry = {.is_round = strncmp(line, "round ", 6) == 0};
    const size_t head = entry.is_round ? 6 : 7;
    char check[33];
    if (length < head + KEY_LENGTH + 1 + 33 ||
        (!entry.is_round && strncmp(line, "errors ", 7) != 0)) {
        return;
    }
    const size_t body = length - 33; // without " CHECK"
    check_of(line, body, check);
    if (line[body] != ' ' || memcmp(line + body + 1, check, 32) != 0) {
        return;
    }
    memcpy(entry.key, line + head, KEY_LENGTH);
    line[body] = '\0';
    entry.values = read_values(line + head + KEY_LENGTH + 1, line + body, &entry.count);
    if (entry.values && !keep(journal, &entry)) {
        free(entry.values);
    }
}

// Reads all complete lines. Cuts an incomplete line off the end of the file.
static bool read_file(DipCostJournal *journal) {
    FILE *in = fopen(journal->file, "r");
    if (!in) {
        return true;
    }
    char *line = NULL;
    size_t room = 0;
    long whole = 0;
    for (ssize_t length; (length = getline(&line, &room, in)) > 0;) {
        if (line[length - 1] != '\n') {
            break;
        }
        whole = ftell(in);
        read_line(journal, line, (size_t)length - 1);
    }
    free(line);
    fclose(in);
    return truncate(journal->file, whole) == 0;
}

DipCostJournal *dip_cost_journal_open(const char *folder, const char *plan, DipError *err) {
    DipCostJournal *journal = calloc(1, sizeof *journal);
    if (!journal) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
        return NULL;
    }
    const int length = snprintf(journal->file, sizeof journal->file, "%s/cost.state", folder);
    snprintf(journal->plan, sizeof journal->plan, "%s", plan);
    if (length < 0 || (size_t)length >= sizeof journal->file) {
        dip_error_set_runtime(err, DIP_ERROR_OVERSIZED, folder, 0, "--out", "the name is too long");
        dip_cost_journal_close(&journal, false);
        return NULL;
    }
    const bool read = read_file(journal);
    journal->out = read ? fopen(journal->file, "a") : NULL;
    if (!journal->out) {
        io_fault(journal, err);
        dip_cost_journal_close(&journal, false);
    }
    return journal;
}

void dip_cost_journal_close(DipCostJournal **state_pointer, bool finished) {
    DipCostJournal *journal = *state_pointer;
    if (!journal) {
        return;
    }
    if (journal->out) {
        fclose(journal->out);
        if (finished) {
            remove(journal->file);
        }
    }
    for (int i = 0; i < journal->count; i++) {
        free(journal->entries[i].values);
    }
    free(journal->entries);
    free(journal);
    *state_pointer = NULL;
}

static bool append(DipCostJournal *journal, bool is_round, const char *key, const double *values,
                   int count, DipError *err) {
    char *text = NULL;
    size_t size = 0;
    FILE *line = open_memstream(&text, &size);
    if (!line) {
        return io_fault(journal, err);
    }
    fprintf(line, "%s %s", is_round ? "round" : "errors", key);
    for (int i = 0; i < count; i++) {
        fprintf(line, " %a", values[i]);
    }
    bool written = fclose(line) == 0;
    if (written) {
        char check[33];
        check_of(text, size, check);
        written = fprintf(journal->out, "%s %s\n", text, check) > 0 && fflush(journal->out) == 0;
    }
    free(text);
    Entry entry = {is_round, "", malloc((size_t)count * sizeof *values), count};
    snprintf(entry.key, sizeof entry.key, "%s", key);
    if (!entry.values || !keep(journal, &entry)) {
        free(entry.values);
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
    }
    memcpy(entry.values, values, (size_t)count * sizeof *values);
    return written || io_fault(journal, err);
}

bool dip_cost_journal_find(const DipCostJournal *journal, const char *key, DipMetricSums *sums) {
    for (int i = 0; i < journal->count; i++) {
        const Entry *entry = &journal->entries[i];
        if (!entry->is_round && entry->count == DIP_METRIC_SUM_COUNT &&
            strcmp(entry->key, key) == 0) {
            memcpy(sums, entry->values, sizeof *sums);
            return true;
        }
    }
    return false;
}

bool dip_cost_journal_add(DipCostJournal *journal, const char *key, const DipMetricSums *sums,
                          DipError *err) {
    double values[DIP_METRIC_SUM_COUNT];
    memcpy(values, sums, sizeof values);
    return append(journal, false, key, values, DIP_METRIC_SUM_COUNT, err);
}

const double *dip_cost_journal_round(const DipCostJournal *journal, int round, int count) {
    for (int i = 0; i < journal->count; i++) {
        const Entry *entry = &journal->entries[i];
        if (entry->is_round && entry->count == count && strcmp(entry->key, journal->plan) == 0 &&
            round-- == 0) {
            return entry->values;
        }
    }
    return NULL;
}

bool dip_cost_journal_add_round(DipCostJournal *journal, const double *ms, int count,
                                DipError *err) {
    return append(journal, true, journal->plan, ms, count, err);
}
