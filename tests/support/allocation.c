// Counts allocations, makes chosen ones fail, and records what is held.
#define _GNU_SOURCE
#include "tests/support/allocation.h"

#include "tests/support/allocation_private.h"

#include <dirent.h>
#include <errno.h>
#include <execinfo.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static atomic_int failing; // A DipFailing.
static atomic_int_least64_t first_failing;
static atomic_int_least64_t calls;
static atomic_int_least64_t failures;
static atomic_int threads;

// --- the stack of the first failure --------------------------------------------------------------

enum { STACK_DEPTH = 24 };

static void *stack[STACK_DEPTH];
static int stack_depth;

void dip_allocation_print_failed(void) {
    fflush(stderr);
    backtrace_symbols_fd(stack, stack_depth, STDERR_FILENO);
}

// --- failing -------------------------------------------------------------------------------------

void dip_allocation_arm(DipFailing how, int64_t number) {
    atomic_store(&calls, 0);
    atomic_store(&failures, 0);
    atomic_store(&first_failing, number);
    stack_depth = 0;
    atomic_store(&failing, how);
}

int64_t dip_allocation_disarm(void) {
    atomic_store(&failing, DIP_FAIL_NONE);
    return atomic_load(&calls);
}

int64_t dip_allocation_count(void) {
    return atomic_load(&calls);
}

int64_t dip_allocation_failed(void) {
    return atomic_load(&failures);
}

bool dip_allocation_fails(int error_number) {
    const int64_t number = atomic_fetch_add(&calls, 1);
    const int how = atomic_load(&failing);
    const int64_t first = atomic_load(&first_failing);
    if (how == DIP_FAIL_NONE || number < first || (how == DIP_FAIL_ONE && number > first)) {
        return false;
    }
    if (atomic_fetch_add(&failures, 1) == 0) {
        stack_depth = backtrace(stack, STACK_DEPTH);
    }
    errno = error_number;
    return true;
}

// --- what is held --------------------------------------------------------------------------------

// A table of the live blocks with open addressing. Blocks that a library has allocated are not in
// the table, although Diptych may free them.
enum { SLOT_BITS = 20, SLOTS = 1 << SLOT_BITS };

typedef struct Slot {
    uintptr_t address; // 0: the slot is free.
    size_t size_bytes;
} Slot;

static Slot slots[SLOTS];
static int64_t blocks;
static int64_t bytes;
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;

static size_t home_of(uintptr_t address) {
    return (size_t)(((uint64_t)address * UINT64_C(0x9e3779b97f4a7c15)) >> (64 - SLOT_BITS));
}

// Returns the slot of an address, or the free slot where it would be.
static size_t find(uintptr_t address) {
    size_t s = home_of(address);
    while (slots[s].address && slots[s].address != address) {
        s = (s + 1) % SLOTS;
    }
    return s;
}

// Empties a slot, and moves later entries so that every entry is still found from its home.
static void empty_slot(size_t hole) {
    size_t s = hole;
    for (;;) {
        s = (s + 1) % SLOTS;
        if (!slots[s].address) {
            break;
        }
        const size_t home = home_of(slots[s].address);
        if ((s - home) % SLOTS >= (s - hole) % SLOTS) {
            slots[hole] = slots[s];
            hole = s;
        }
    }
    slots[hole] = (Slot){0};
}

void *dip_allocation_hold(void *block, size_t size_bytes) {
    if (block) {
        pthread_mutex_lock(&mutex);
        if (blocks >= SLOTS / 2) {
            fputs("allocation.c: too many live blocks\n", stderr);
            abort();
        }
        slots[find((uintptr_t)block)] = (Slot){(uintptr_t)block, size_bytes};
        blocks++;
        bytes += (int64_t)size_bytes;
        pthread_mutex_unlock(&mutex);
    }
    return block;
}

size_t dip_allocation_release(const void *block) {
    size_t size_bytes = 0;
    pthread_mutex_lock(&mutex);
    const size_t s = find((uintptr_t)block);
    if (block && slots[s].address) {
        size_bytes = slots[s].size_bytes;
        blocks--;
        bytes -= (int64_t)size_bytes;
        empty_slot(s);
    }
    pthread_mutex_unlock(&mutex);
    return size_bytes;
}

void dip_allocation_thread(int change) {
    atomic_fetch_add(&threads, change);
}

// Sanitizers and libraries keep no files open that come and go, so any difference is Diptych's.
static int count_descriptors(void) {
    DIR *listing = __real_opendir("/proc/self/fd");
    int count = -1; // The listing has a descriptor, too.
    while (listing && readdir(listing)) {
        count++;
    }
    if (listing) {
        closedir(listing);
    }
    return count;
}

DipHoldings dip_allocation_holdings(void) {
    return (DipHoldings){
        .blocks = blocks,
        .bytes = bytes,
        .threads = atomic_load(&threads),
        .descriptors = count_descriptors(),
    };
}
