// A file of lines: kind, name, numbers in hexadecimal (exact), check.
#include "app/cost/state.h"

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

struct DipCostState {
    char file[PATH_MAX];
    char plan[KEY_LENGTH + 1];
    FILE *out;
    Entry *entries;
    int count;
    int capacity;
};

static bool io_fault(const DipCostState *state, DipError *err) {
    return dip_error_set(err, DIP_ERROR_IO, state->file, 0, NULL, "cannot be written: %s",
                         strerror(errno));
}

// Takes the values over.
static bool keep(DipCostState *state, const Entry *entry) {
    if (state->count == state->capacity) {
        const int capacity = state->capacity ? 2 * state->capacity : 256;
        Entry *entries = realloc(state->entries, (size_t)capacity * sizeof *entries);
        if (!entries) {
            return false;
        }
        state->entries = entries;
        state->capacity = capacity;
    }
    state->entries[state->count++] = *entry;
    return true;
}

static void check_of(const char *text, size_t length, char check[33]) {
    DipHash hash = dip_hash_begin(0);
    dip_hash_bytes(&hash, text, length);
    dip_hash_hex(&hash, check);
}

// The numbers between two places of a line; NULL when one is none.
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

// "errors KEY v v ... CHECK" or "round PLAN v v ... CHECK", without the line's end.
static void read_line(DipCostState *state, char *line, size_t length) {
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
    if (entry.values && !keep(state, &entry)) {
        free(entry.values);
    }
}

// Reads the whole lines there are and cuts off what follows them.
static bool read_file(DipCostState *state) {
    FILE *in = fopen(state->file, "r");
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
        read_line(state, line, (size_t)length - 1);
    }
    free(line);
    fclose(in);
    return truncate(state->file, whole) == 0;
}

DipCostState *dip_cost_state_open(const char *folder, const char *plan, DipError *err) {
    DipCostState *state = calloc(1, sizeof *state);
    if (!state) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
        return NULL;
    }
    const int length = snprintf(state->file, sizeof state->file, "%s/cost.state", folder);
    snprintf(state->plan, sizeof state->plan, "%s", plan);
    if (length < 0 || (size_t)length >= sizeof state->file) {
        dip_error_set(err, DIP_ERROR_OVERSIZED, folder, 0, "--out", "the name is too long");
        dip_cost_state_close(&state, false);
        return NULL;
    }
    const bool read = read_file(state);
    state->out = read ? fopen(state->file, "a") : NULL;
    if (!state->out) {
        io_fault(state, err);
        dip_cost_state_close(&state, false);
    }
    return state;
}

void dip_cost_state_close(DipCostState **state_pointer, bool finished) {
    DipCostState *state = *state_pointer;
    if (!state) {
        return;
    }
    if (state->out) {
        fclose(state->out);
        if (finished) {
            remove(state->file);
        }
    }
    for (int i = 0; i < state->count; i++) {
        free(state->entries[i].values);
    }
    free(state->entries);
    free(state);
    *state_pointer = NULL;
}

static bool append(DipCostState *state, bool is_round, const char *key, const double *values,
                   int count, DipError *err) {
    char *text = NULL;
    size_t size = 0;
    FILE *line = open_memstream(&text, &size);
    if (!line) {
        return io_fault(state, err);
    }
    fprintf(line, "%s %s", is_round ? "round" : "errors", key);
    for (int i = 0; i < count; i++) {
        fprintf(line, " %a", values[i]);
    }
    bool written = fclose(line) == 0;
    if (written) {
        char check[33];
        check_of(text, size, check);
        written = fprintf(state->out, "%s %s\n", text, check) > 0 && fflush(state->out) == 0;
    }
    free(text);
    Entry entry = {is_round, "", malloc((size_t)count * sizeof *values), count};
    snprintf(entry.key, sizeof entry.key, "%s", key);
    if (!entry.values || !keep(state, &entry)) {
        free(entry.values);
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cost", "out of memory");
    }
    memcpy(entry.values, values, (size_t)count * sizeof *values);
    return written || io_fault(state, err);
}

bool dip_cost_state_find(const DipCostState *state, const char *key, DipMetricSums *sums) {
    for (int i = 0; i < state->count; i++) {
        const Entry *entry = &state->entries[i];
        if (!entry->is_round && entry->count == DIP_METRIC_SUM_COUNT &&
            strcmp(entry->key, key) == 0) {
            memcpy(sums, entry->values, sizeof *sums);
            return true;
        }
    }
    return false;
}

bool dip_cost_state_add(DipCostState *state, const char *key, const DipMetricSums *sums,
                        DipError *err) {
    double values[DIP_METRIC_SUM_COUNT];
    memcpy(values, sums, sizeof values);
    return append(state, false, key, values, DIP_METRIC_SUM_COUNT, err);
}

const double *dip_cost_state_round(const DipCostState *state, int round, int count) {
    for (int i = 0; i < state->count; i++) {
        const Entry *entry = &state->entries[i];
        if (entry->is_round && entry->count == count && strcmp(entry->key, state->plan) == 0 &&
            round-- == 0) {
            return entry->values;
        }
    }
    return NULL;
}

bool dip_cost_state_add_round(DipCostState *state, const double *ms, int count, DipError *err) {
    return append(state, true, state->plan, ms, count, err);
}
