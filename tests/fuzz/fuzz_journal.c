// Fuzzes the reader of the journal of an unfinished cost report. Each input is read twice: as it
// is, and with the right checksum added to every line, because changes of a line break its
// checksum. Measurements that were found are found again, after the journal was closed, and in a
// new journal to which they were added.
#include "app/cost/journal.h"
#include "renderer/base/hash.h"
#include "tests/fuzz/fuzz.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const char plan[] = "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa";
static const char key[] = "0123456789abcdef0123456789abcdef";

static void make_folder(const char *name) {
    FUZZ_CHECK(mkdir(fuzz_path(name), 0700) == 0 || errno == EEXIST);
}

// Opens the journal in a folder with this name. A folder's journal is open only once at a time, so
// journals that are compared stand in folders of their own.
static DipCostJournal *open_journal(const char *name) {
    const char *folder = fuzz_path(name);
    DipError err = {0};
    DipCostJournal *journal = dip_cost_journal_open(folder, plan, &err);
    FUZZ_CHECK(journal != NULL);
    return journal;
}

static void check_same_numbers(const double *a, const double *b, int count) {
    FUZZ_CHECK((a == NULL) == (b == NULL));
    for (int i = 0; a && i < count; i++) {
        FUZZ_CHECK(fuzz_same_number(a[i], b[i]));
    }
}

static void check_same_rounds(const DipCostJournal *a, const DipCostJournal *b) {
    int seed = 0;
    const int rounds = dip_cost_journal_round_count(a, &seed);
    FUZZ_CHECK(rounds == dip_cost_journal_round_count(b, NULL));
    for (int r = 0; r < rounds; r++) {
        int count_a, count_b;
        DipTimed *timed_a = dip_cost_journal_round(a, r, seed, &count_a);
        DipTimed *timed_b = dip_cost_journal_round(b, r, seed, &count_b);
        FUZZ_CHECK(count_a == count_b);
        for (int i = 0; i < count_a; i++) {
            const DipTimed *x = &timed_a[i], *y = &timed_b[i];
            FUZZ_CHECK(x->subject == y->subject && x->frame == y->frame && x->block == y->block);
            check_same_numbers(&x->ms, &y->ms, (int)(sizeof *x - offsetof(DipTimed, ms)) / 8);
        }
        free(timed_a);
        free(timed_b);
    }
}

// Compares the measurements that both journals have for the key, and their rounds.
static void check_same(const DipCostJournal *a, const DipCostJournal *b) {
    DipCostBurstErrors errors_a, errors_b;
    const bool found = dip_cost_journal_find(a, key, &errors_a);
    FUZZ_CHECK(found == dip_cost_journal_find(b, key, &errors_b));
    if (found) {
        check_same_numbers((const double *)&errors_a, (const double *)&errors_b,
                           (int)(sizeof errors_a / sizeof(double)));
    }
    check_same_rounds(a, b);
}

static void add_all(const DipCostJournal *from, DipCostJournal *to) {
    DipCostBurstErrors errors;
    if (dip_cost_journal_find(from, key, &errors)) {
        FUZZ_CHECK(dip_cost_journal_add(to, key, &errors, NULL));
    }
    int seed = 0;
    const int rounds = dip_cost_journal_round_count(from, &seed);
    for (int r = 0; r < rounds; r++) {
        int count;
        DipTimed *timed = dip_cost_journal_round(from, r, seed, &count);
        FUZZ_CHECK(count == 0 || dip_cost_journal_add_round(to, seed, timed, count, NULL));
        free(timed);
    }
}

static void check_journal(const void *bytes, size_t size_bytes) {
    make_folder("journal");
    make_folder("again");
    fuzz_write("journal/cost.state", bytes, size_bytes);
    fuzz_write("again/cost.state", bytes, size_bytes);
    DipCostJournal *journal = open_journal("journal"), *again = open_journal("again");
    dip_cost_journal_close(&again, false); // Opening it has cut an incomplete line off.
    again = open_journal("again");
    check_same(journal, again);
    dip_cost_journal_close(&again, true); // Removes the file.
    DipCostJournal *made = open_journal("again");
    add_all(journal, made);
    dip_cost_journal_close(&made, false);
    DipCostJournal *read = open_journal("again");
    dip_cost_journal_close(&read, true);
    dip_cost_journal_close(&journal, true);
}

// Adds the checksum to every line.
static char *sign(const uint8_t *bytes, size_t size_bytes, size_t *signed_bytes) {
    char *text = NULL;
    FILE *out = open_memstream(&text, signed_bytes);
    FUZZ_CHECK(out != NULL);
    for (const uint8_t *at = bytes, *end = bytes + size_bytes; at < end;) {
        const uint8_t *newline = memchr(at, '\n', (size_t)(end - at));
        const size_t length = (size_t)((newline ? newline : end) - at);
        char check[33];
        DipHash hash = dip_hash_begin(0);
        dip_hash_bytes(&hash, at, length);
        dip_hash_hex(&hash, check);
        fwrite(at, 1, length, out);
        fprintf(out, " %s\n", check);
        at = newline ? newline + 1 : end;
    }
    fclose(out);
    return text;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size_bytes) {
    size_t signed_bytes = 0;
    char *text = sign(bytes, size_bytes, &signed_bytes);
    check_journal(bytes, size_bytes);
    check_journal(text, signed_bytes);
    free(text);
    return 0;
}
