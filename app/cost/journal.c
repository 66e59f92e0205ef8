// The journal is a text file. Each line has a kind, a key, numbers in exact hexadecimal notation,
// and a checksum.
#include "app/cost/journal.h"

#include "renderer/base/hash.h"

#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { KEY_LENGTH = 32, ERROR_VALUES = DIP_METRIC_SUM_COUNT + DIP_FLIP_TAIL_COUNT };

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

// Reads the text from..end as numbers with one space between them. Sets *values to NULL if the text
// has another form. Returns false when memory runs out. `*end` must not be part of a number.
static bool read_values(const char *from, const char *end, double **values_read, int *count) {
    int room = 1;
    for (const char *c = from; c < end; c++) {
        room += *c == ' ';
    }
    double *values = malloc((size_t)room * sizeof *values);
    bool is_good = values != NULL;
    *count = 0;
    while (is_good && from < end) {
        char *rest;
        values[*count] = strtod(from, &rest);
        // strtod skips white space before a number.
        is_good = rest != from && rest <= end && !isspace((unsigned char)*from) &&
                  (rest == end || *rest == ' ');
        ++*count;
        from = rest + (rest < end);
    }
    *values_read = is_good ? values : NULL;
    if (!is_good) {
        free(values);
    }
    return values != NULL;
}

// Reads and keeps one line without its line break: "errors KEY v v ... CHECK" or "round PLAN v v
// ... CHECK". Ignores a line whose checksum CHECK is wrong. Returns false when memory runs out.
static bool read_line(DipCostJournal *journal, char *line, size_t length) {
    Entry entry = {.is_round = strncmp(line, "round ", 6) == 0};
    const size_t head = entry.is_round ? 6 : 7;
    char check[33];
    if (length < head + KEY_LENGTH + 1 + 33 ||
        (!entry.is_round && strncmp(line, "errors ", 7) != 0)) {
        return true;
    }
    const size_t body = length - 33; // without " CHECK"
    check_of(line, body, check);
    if (line[body] != ' ' || memcmp(line + body + 1, check, 32) != 0) {
        return true;
    }
    memcpy(entry.key, line + head, KEY_LENGTH);
    line[body] = '\0';
    if (!read_values(line + head + KEY_LENGTH + 1, line + body, &entry.values, &entry.count)) {
        return false;
    }
    if (entry.values && !keep(journal, &entry)) {
        free(entry.values);
        return false;
    }
    return true;
}

// Reads all complete lines. Cuts an incomplete line off the end of the file, but only after the
// whole file was read: if memory runs out, the file keeps its measurements.
static bool read_file(DipCostJournal *journal, DipError *err) {
    FILE *in = fopen(journal->file, "r");
    if (!in) {
        return errno == ENOENT || io_fault(journal, err);
    }
    char *line = NULL;
    size_t room = 0;
    long whole = 0;
    bool kept = true;
    errno = 0;
    for (ssize_t length; kept && (length = getline(&line, &room, in)) > 0;) {
        if (line[length - 1] != '\n') {
            break;
        }
        whole = ftell(in);
        kept = read_line(journal, line, (size_t)length - 1);
    }
    const bool ended = feof(in) != 0;
    const int reason = errno;
    free(line);
    fclose(in);
    if (!kept || (!ended && reason == ENOMEM)) {
        return dip_error_set(err, DIP_ERROR_MEMORY, journal->file, 0, NULL,
                             "cannot be read: out of memory");
    }
    if (!ended) {
        return dip_error_set_runtime(err, DIP_ERROR_IO, journal->file, 0, NULL,
                                     "cannot be read: %s", strerror(reason));
    }
    return truncate(journal->file, whole) == 0 || io_fault(journal, err);
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
    bool opened = read_file(journal, err);
    if (opened) {
        journal->out = fopen(journal->file, "a");
        opened = journal->out || io_fault(journal, err);
    }
    if (!opened) {
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

// Returns the text of a line without its checksum, or NULL when memory runs out. The caller frees
// it.
static char *make_line(bool is_round, const char *key, const double *values, int count,
                       size_t *size) {
    char *text = NULL;
    FILE *line = open_memstream(&text, size);
    if (!line) {
        return NULL;
    }
    fprintf(line, "%s %s", is_round ? "round" : "errors", key);
    for (int i = 0; i < count; i++) {
        fprintf(line, " %a", values[i]);
    }
    const bool made = !ferror(line);
    if (fclose(line) != 0 || !made) {
        free(text);
        return NULL;
    }
    return text;
}

// Keeps a measurement, then writes it to the file. If memory runs out, does neither.
static bool append(DipCostJournal *journal, bool is_round, const char *key, const double *values,
                   int count, DipError *err) {
    size_t size = 0;
    char *text = make_line(is_round, key, values, count, &size);
    Entry entry = {is_round, "", malloc((size_t)count * sizeof *values), count};
    snprintf(entry.key, sizeof entry.key, "%s", key);
    if (!text || !entry.values || !keep(journal, &entry)) {
        free(text);
        free(entry.values);
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
    }
    memcpy(entry.values, values, (size_t)count * sizeof *values);
    char check[33];
    check_of(text, size, check);
    const bool written =
        fprintf(journal->out, "%s %s\n", text, check) > 0 && fflush(journal->out) == 0;
    free(text);
    return written || io_fault(journal, err);
}

bool dip_cost_journal_find(const DipCostJournal *journal, const char *key,
                           DipCostBurstErrors *errors) {
    for (int i = 0; i < journal->count; i++) {
        const Entry *entry = &journal->entries[i];
        if (!entry->is_round && entry->count == ERROR_VALUES && strcmp(entry->key, key) == 0) {
            memcpy(errors, entry->values, sizeof *errors);
            return true;
        }
    }
    return false;
}

bool dip_cost_journal_add(DipCostJournal *journal, const char *key,
                          const DipCostBurstErrors *errors, DipError *err) {
    double values[ERROR_VALUES];
    memcpy(values, errors, sizeof values);
    return append(journal, false, key, values, ERROR_VALUES, err);
}

// --- rounds --------------------------------------------------------------------------------------

// A round's entry has its seed, and then the numbers of each frame.
enum { TIMED_VALUES = 10 + DIP_TIMED_PARTS };

static void write_timed(const DipTimed *timed, double values[TIMED_VALUES]) {
    const double all[10] = {
        timed->subject,          timed->start, timed->round, timed->block,  timed->frame,
        (double)timed->begin_ns, timed->ms,    timed->wait,  timed->cpu_ms, timed->switches};
    memcpy(values, all, sizeof all);
    memcpy(values + 10, timed->parts_ms, sizeof timed->parts_ms);
}

// Returns -1 for what is no index. Such a frame fits no round.
static int read_index(double value) {
    return value >= 0.0 && value <= INT_MAX ? (int)value : -1;
}

static DipTimed read_timed(const double values[TIMED_VALUES]) {
    DipTimed timed = {
        .subject = read_index(values[0]),
        .start = read_index(values[1]),
        .round = read_index(values[2]),
        .block = read_index(values[3]),
        .frame = read_index(values[4]),
        .begin_ns = fabs(values[5]) < 9e18 ? (int64_t)values[5] : 0,
        .ms = values[6],
        .wait = values[7],
        .cpu_ms = values[8],
        .switches = values[9],
    };
    memcpy(timed.parts_ms, values + 10, sizeof timed.parts_ms);
    return timed;
}

static const Entry *find_round(const DipCostJournal *journal, int round, int *rounds) {
    *rounds = 0;
    for (int i = 0; i < journal->count; i++) {
        const Entry *entry = &journal->entries[i];
        if (entry->is_round && entry->count % TIMED_VALUES == 1 &&
            strcmp(entry->key, journal->plan) == 0 && (*rounds)++ == round) {
            return entry;
        }
    }
    return NULL;
}

int dip_cost_journal_round_count(const DipCostJournal *journal) {
    int count;
    find_round(journal, -1, &count);
    return count;
}

DipTimed *dip_cost_journal_round(const DipCostJournal *journal, int round, int seed, int *count) {
    int rounds;
    const Entry *entry = find_round(journal, round, &rounds);
    *count = entry && entry->values[0] == seed ? entry->count / TIMED_VALUES : 0;
    DipTimed *timed = malloc(((size_t)*count + 1) * sizeof *timed);
    for (int i = 0; timed && i < *count; i++) {
        timed[i] = read_timed(entry->values + 1 + i * TIMED_VALUES);
    }
    return timed;
}

void dip_cost_journal_seed(const DipCostJournal *journal, int *seed) {
    int rounds;
    const Entry *entry = find_round(journal, 0, &rounds);
    if (entry) {
        *seed = read_index(entry->values[0]);
    }
}

bool dip_cost_journal_add_round(DipCostJournal *journal, int seed, const DipTimed *timed, int count,
                                DipError *err) {
    double *values = malloc(((size_t)count * TIMED_VALUES + 1) * sizeof *values);
    if (!values) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
    }
    values[0] = seed;
    for (int i = 0; i < count; i++) {
        write_timed(&timed[i], values + 1 + i * TIMED_VALUES);
    }
    const bool added = append(journal, true, journal->plan, values, count * TIMED_VALUES + 1, err);
    free(values);
    return added;
}
