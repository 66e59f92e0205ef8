// Makes the allocations of an operation fail in turn, and checks each outcome.
#include "tests/support/out_of_memory.h"

#include "tests/support/allocation.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

// The build sets it: of the allocations that the short test chooses, one in so many fails.
// Sanitizers are slow, and a build without them fails all that are chosen.
#ifndef DIP_CHOSEN_PER_FAILURE
#define DIP_CHOSEN_PER_FAILURE 1
#endif

static bool every_allocation;

void dip_out_of_memory_read_options(int argc, char **argv) {
    for (int i = 1; i < argc; i++) {
        every_allocation |= strcmp(argv[i], "--long") == 0;
    }
}

bool dip_out_of_memory_first_error(DipErrorList *faults, DipError *err) {
    const bool none = faults->error_count == 0;
    bool kept = none;
    for (size_t i = 0; i < faults->count && !kept; i++) {
        kept = faults->items[i].severity == DIP_SEVERITY_ERROR;
        *err = faults->items[i];
    }
    dip_error_list_free(faults);
    if (!kept) {
        fail_msg("the list has lost its only error");
    }
    return none;
}

// One try: which allocations fail.
typedef struct Try {
    const DipOutOfMemory *operation;
    DipFailing failing;
    int64_t number;
} Try;

static void refuse(const Try *try, const char *what, const char *detail) {
    dip_allocation_print_failed();
    fail_msg("%s, allocation %lld%s fails: %s%s", try->operation->name, (long long)try->number,
             try->failing == DIP_FAIL_ALL_FROM ? " and all later ones" : "", what, detail);
}

// True if the text says that memory, files or threads have run out.
static bool names_the_cause(const char *message) {
    static const char *const causes[] = {"memory", "Too many open files",
                                         "Resource temporarily unavailable", "thread"};
    for (size_t i = 0; i < sizeof causes / sizeof *causes; i++) {
        if (strstr(message, causes[i])) {
            return true;
        }
    }
    return false;
}

static void check_error(const Try *try, const DipError *err) {
    char line[1024];
    dip_error_format(err, line, sizeof line);
    if (err->code == DIP_ERROR_NONE || !err->message[0]) {
        refuse(try, "the operation fails without an error", "");
    }
    if (strpbrk(line, "\r\n")) {
        refuse(try, "the error has more than one line: ", line);
    }
    if (!names_the_cause(line)) {
        refuse(try, "the error does not say that memory ran out: ", line);
    }
    if (err->line != 0 && !err->file[0]) {
        refuse(try, "the error names a line of no file: ", line);
    }
    if (err->origin != DIP_ORIGIN_RUNTIME) {
        refuse(try, "the user gets the blame, exit code 2: ", line);
    }
}

static void check_holdings(const Try *try, DipHoldings before) {
    const DipHoldings after = dip_allocation_holdings();
    char detail[160];
    snprintf(detail, sizeof detail, "%lld blocks, %lld bytes, %d threads, %d files",
             (long long)(after.blocks - before.blocks), (long long)(after.bytes - before.bytes),
             after.threads - before.threads, after.descriptors - before.descriptors);
    if (memcmp(&after, &before, sizeof after) != 0) {
        refuse(try, "the operation leaks ", detail);
    }
}

static void call(const DipOutOfMemory *operation, void (*function)(void *)) {
    if (function) {
        function(operation->context);
    }
}

// Runs the operation once. Returns whether it succeeded; stores the number of its allocations.
static bool run_once(const Try *try, int64_t *count) {
    const DipOutOfMemory *operation = try->operation;
    const DipHoldings before = dip_allocation_holdings();
    DipError err = {.code = DIP_ERROR_NONE};
    call(operation, operation->prepare);
    dip_allocation_arm(try->failing, try->number);
    const bool succeeded = operation->run(operation->context, &err);
    *count = dip_allocation_disarm();
    if (!succeeded && !dip_allocation_failed()) {
        refuse(try, "the operation fails although no allocation did: ", err.message);
    }
    if (!succeeded) {
        check_error(try, &err);
    } else if (operation->needs_every_allocation && dip_allocation_failed()) {
        refuse(try, "the operation succeeds", "");
    }
    if (operation->check) {
        operation->check(operation->context, succeeded);
    }
    call(operation, operation->finish);
    check_holdings(try, before);
    return succeeded;
}

void dip_out_of_memory_check(const DipOutOfMemory *operation) {
    Try try = {.operation = operation, .failing = DIP_FAIL_NONE};
    int64_t count = 0;
    // The first run may allocate what the process keeps for good.
    call(operation, operation->prepare);
    DipError err;
    assert_true(operation->run(operation->context, &err));
    call(operation, operation->finish);
    assert_true(run_once(&try, &count));
    int64_t tries = count;
    if (!every_allocation) {
        const int64_t most = operation->short_count;
        const int64_t chosen = most && most < count ? most : count;
        tries = (chosen + DIP_CHOSEN_PER_FAILURE - 1) / DIP_CHOSEN_PER_FAILURE;
    }
    int64_t survived = 0;
    for (int64_t i = 0; i < tries; i++) {
        int64_t ignored;
        try.number = i * count / tries;
        try.failing = DIP_FAIL_ONE;
        survived += run_once(&try, &ignored);
        try.failing = DIP_FAIL_ALL_FROM;
        survived += run_once(&try, &ignored);
    }
    print_message("%s: %lld allocations, %lld failed alone and with all later ones, "
                  "%lld times without consequence\n",
                  operation->name, (long long)count, (long long)tries, (long long)survived);
}
