// Reads and writes the journal, a text file. Each line has a kind, a key, numbers in exact
// hexadecimal notation, and a checksum: "errors KEY v v ... CHECK" or "round PLAN v v ... CHECK".
#include "app/cost/journal.h"

#include "renderer/base/file.h"
#include "renderer/base/hash.h"

#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    CHECK = DIP_HASH_HEX_SIZE, // Length of the checksum and of the space before it.
    ERROR_VALUES = DIP_METRIC_SUM_COUNT + DIP_FLIP_TAIL_COUNT,
    TIMED_VALUES = 10 + DIP_TIMED_PARTS // Numbers per frame. In the line of a round, the seed comes
                                        // first, and then the numbers of each frame.
};

struct DipCostJournal {
    char file[PATH_MAX];
    char plan[33];
    FILE *out;
    // The content of the file when it was opened: its good lines without their checksums. Each line
    // ends with a zero byte.
    char *text;
    size_t size;
};

static bool io_fault(const DipCostJournal *journal, DipError *err) {
    return dip_error_set_runtime(err, DIP_ERROR_IO, journal->file, 0, NULL, "cannot be written: %s",
                                 strerror(errno));
}

// Overwrites a line's checksum with zeros, and the whole line if the checksum is wrong.
static void check_line(char *line, size_t length) {
    char check[33];
    const size_t body = length < CHECK ? 0 : length - CHECK;
    DipHash hash = dip_hash_begin(0);
    dip_hash_bytes(&hash, line, body);
    dip_hash_hex(&hash, check);
    const bool good = body > 0 && line[body] == ' ' && !memchr(line, '\0', length) &&
                      memcmp(line + body + 1, check, CHECK - 1) == 0;
    memset(line + (good ? body : 0), 0, length - (good ? body : 0));
}

// Reads all complete lines. Cuts an incomplete line off the end of the file, but only after the
// whole file was read: if memory runs out, the file keeps its measurements.
static bool read_file(DipCostJournal *journal, DipError *err) {
    DipError fault = {0};
    unsigned char *bytes;
    if (!dip_file_read(journal->file, "journal", SIZE_MAX / 2, &bytes, &journal->size, &fault)) {
        if (fault.code != DIP_ERROR_MISSING && err) {
            *err = fault;
        }
        journal->size = 0;
        return fault.code == DIP_ERROR_MISSING;
    }
    journal->text = (char *)bytes;
    size_t whole = 0;
    for (char *end; (end = memchr(journal->text + whole, '\n', journal->size - whole));) {
        *end = '\0';
        check_line(journal->text + whole, (size_t)(end - journal->text) - whole);
        whole = (size_t)(end - journal->text) + 1;
    }
    journal->size = whole;
    return truncate(journal->file, (off_t)whole) == 0 || io_fault(journal, err);
}

// Opens the file for writing and locks it, so that no other run writes to it. The lock ends with
// the process, however the process ends. Another run may finish and remove the file between the
// opening and the locking; then this function opens a new file.
static bool open_file(DipCostJournal *journal, const char *folder, DipError *err) {
    struct stat status = {.st_nlink = 0};
    while (status.st_nlink == 0) {
        if (journal->out) {
            fclose(journal->out);
        }
        journal->out = fopen(journal->file, "ae"); // Child processes do not inherit the lock.
        if (!journal->out) {
            return io_fault(journal, err);
        }
        // Where files cannot be locked, runs are not kept apart.
        if (flock(fileno(journal->out), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            return dip_error_set_runtime(err, DIP_ERROR_CONFLICT, folder, 0, "--out",
                                         "another run writes into this folder; wait until it has "
                                         "ended, or give another folder");
        }
        if (fstat(fileno(journal->out), &status) != 0) {
            return io_fault(journal, err);
        }
    }
    return true;
}

DipCostJournal *dip_cost_journal_open(const char *folder, const char *plan, DipError *err) {
    DipCostJournal *journal = calloc(1, sizeof *journal);
    if (!journal) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
        return NULL;
    }
    const int length = snprintf(journal->file, sizeof journal->file, "%s/cost.state", folder);
    snprintf(journal->plan, sizeof journal->plan, "%s", plan);
    const bool opened = length >= 0 && (size_t)length < sizeof journal->file;
    if (!opened) {
        dip_error_set_runtime(err, DIP_ERROR_OVERSIZED, folder, 0, "--out", "the name is too long");
    }
    if (!opened || !open_file(journal, folder, err) || !read_file(journal, err)) {
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
        if (finished) {
            remove(journal->file);
        }
        fclose(journal->out); // This ends the lock.
    }
    free(journal->text);
    free(journal);
    *state_pointer = NULL;
}

// --- lines ---------------------------------------------------------------------------------------

static void put(FILE *out, DipHash *hash, const char *text) {
    dip_hash_bytes(hash, text, strlen(text));
    fputs(text, out);
}

// Appends a line to the file, for the next run to read.
static bool append(const DipCostJournal *journal, const char *kind, const char *key,
                   const double *values, int count, DipError *err) {
    DipHash hash = dip_hash_begin(0);
    char text[80];
    snprintf(text, sizeof text, "%s %.32s", kind, key);
    put(journal->out, &hash, text);
    for (int i = 0; i < count; i++) {
        snprintf(text, sizeof text, " %a", values[i]);
        put(journal->out, &hash, text);
    }
    dip_hash_hex(&hash, text);
    return (fprintf(journal->out, " %s\n", text) > 0 && fflush(journal->out) == 0 &&
            !ferror(journal->out)) ||
           io_fault(journal, err);
}

// Passes over the first *skip lines with this kind and key, and returns the text of the numbers in
// the next such line. If there is none, returns NULL and subtracts the number of all such lines
// from *skip.
static const char *find(const DipCostJournal *journal, const char *kind, const char *key,
                        int *skip) {
    char head[64];
    const size_t length = (size_t)snprintf(head, sizeof head, "%s %s ", kind, key);
    for (size_t at = 0; at < journal->size; at += strlen(journal->text + at) + 1) {
        if (strncmp(journal->text + at, head, length) == 0 && (*skip)-- == 0) {
            return journal->text + at + length;
        }
    }
    return NULL;
}

// Reads at most `most` numbers with one space between them. Returns how many there are, or 0 if the
// text has more numbers or another form.
static int read_values(const char *text, double *values, int most) {
    for (int count = 0; count < most;) {
        char *rest;
        values[count++] = strtod(text, &rest);
        // strtod skips white space before a number.
        if (rest == text || isspace((unsigned char)*text) || (*rest && *rest != ' ')) {
            return 0;
        }
        if (!*rest) {
            return count;
        }
        text = rest + 1;
    }
    return 0;
}

bool dip_cost_journal_find(const DipCostJournal *journal, const char *key,
                           DipCostBurstErrors *errors) {
    double values[ERROR_VALUES];
    int skip = 0;
    const char *text = find(journal, "errors", key, &skip);
    const bool found = text && read_values(text, values, ERROR_VALUES) == ERROR_VALUES;
    if (found) {
        memcpy(errors, values, sizeof *errors);
    }
    return found;
}

bool dip_cost_journal_add(DipCostJournal *journal, const char *key,
                          const DipCostBurstErrors *errors, DipError *err) {
    double values[ERROR_VALUES];
    memcpy(values, errors, sizeof values);
    return append(journal, "errors", key, values, ERROR_VALUES, err);
}

// --- rounds --------------------------------------------------------------------------------------

_Static_assert(offsetof(DipTimed, parts_ms) == offsetof(DipTimed, ms) + 4 * sizeof(double),
               "the times follow one another");
enum { TIMES_SIZE = (TIMED_VALUES - 6) * sizeof(double) };

// Converts a stored number to an index, or to -1 if it cannot be one. The driver refuses a round
// that has a frame with the index -1 (dip_driver_resume).
static int read_index(double value) {
    return value >= 0.0 && value <= INT_MAX ? (int)value : -1;
}

int dip_cost_journal_round_count(const DipCostJournal *journal, int *seed) {
    int none = 0, all = INT_MAX;
    const char *first = find(journal, "round", journal->plan, &none);
    if (first && seed) {
        *seed = read_index(strtod(first, NULL));
    }
    find(journal, "round", journal->plan, &all);
    return INT_MAX - all;
}

DipTimed *dip_cost_journal_round(const DipCostJournal *journal, int round, int seed, int *count) {
    const char *text = find(journal, "round", journal->plan, &round);
    const int most = text ? (int)strlen(text) / 2 + 1 : 0;
    double *values = malloc(((size_t)most + 1) * sizeof *values);
    const int found = values ? read_values(text, values, most) : 0;
    DipTimed *timed = malloc(((size_t)found + 1) * sizeof *timed);
    *count = timed && found % TIMED_VALUES == 1 && values[0] == seed ? found / TIMED_VALUES : 0;
    for (int i = 0; i < *count; i++) {
        const double *v = values + 1 + i * TIMED_VALUES;
        timed[i] = (DipTimed){.subject = read_index(v[0]),
                              .start = read_index(v[1]),
                              .round = read_index(v[2]),
                              .block = read_index(v[3]),
                              .frame = read_index(v[4]),
                              .begin_ns = fabs(v[5]) < 9e18 ? (int64_t)v[5] : 0};
        memcpy(&timed[i].ms, v + 6, TIMES_SIZE);
    }
    if (!values) {
        free(timed);
        timed = NULL;
    }
    free(values);
    return timed;
}

bool dip_cost_journal_add_round(DipCostJournal *journal, int seed, const DipTimed *timed, int count,
                                DipError *err) {
    double *values = malloc(((size_t)count * TIMED_VALUES + 1) * sizeof *values);
    if (!values) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
    }
    values[0] = seed;
    for (int i = 0; i < count; i++) {
        double *v = values + 1 + i * TIMED_VALUES;
        const double head[6] = {timed[i].subject, timed[i].start, timed[i].round,
                                timed[i].block,   timed[i].frame, (double)timed[i].begin_ns};
        memcpy(v, head, sizeof head);
        memcpy(v + 6, &timed[i].ms, TIMES_SIZE);
    }
    const bool added =
        append(journal, "round", journal->plan, values, count * TIMED_VALUES + 1, err);
    free(values);
    return added;
}
