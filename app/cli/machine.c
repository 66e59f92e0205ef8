// Reads the machine's properties from Linux, measures the length of a processor cycle, and hashes
// the program's file.
#include "app/cli/machine.h"

#include "app/cli/program_file.h"
#include "renderer/base/clock.h"
#include "renderer/base/hash.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

void dip_machine_processor(char *name, size_t size_bytes) {
    snprintf(name, size_bytes, "unknown processor");
    FILE *in = fopen("/proc/cpuinfo", "r");
    char line[256];
    while (in && fgets(line, sizeof line, in)) {
        const char *colon = strchr(line, ':');
        if (strncmp(line, "model name", strlen("model name")) == 0 && colon) {
            line[strcspn(line, "\n")] = '\0';
            const char *value = colon + 1 + strspn(colon + 1, " ");
            snprintf(name, size_bytes, "%s", *value ? value : "unknown processor");
            break;
        }
    }
    if (in) {
        fclose(in);
    }
}

void dip_machine_build(char hex[33]) {
    hex[0] = '\0';
    FILE *in = fopen(dip_program_file(), "rb");
    if (!in) {
        return;
    }
    DipHash hash = dip_hash_begin(0);
    char block[1 << 16];
    for (size_t got; (got = fread(block, 1, sizeof block, in)) > 0;) {
        dip_hash_bytes(&hash, block, got);
    }
    if (!ferror(in)) {
        dip_hash_hex(&hash, hex);
    }
    fclose(in);
}

int dip_machine_processor_count(void) {
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online < 1 ? 1 : (int)online;
}

// Times a chain of additions, each of which needs the result of the one before and takes one cycle.
// The empty assembler statements hide the values from the compiler. The addend is in a register,
// since some processors merge successive additions of constants. The result is the time of one
// addition in the fastest round.
double dip_machine_ns_per_cycle(void) {
    enum { ROUNDS = 60, STEPS = 200000, PER_STEP = 8 };
    double fastest = 1e30;
    for (int round = 0; round < ROUNDS; round++) {
        uint64_t sum = 0;
        uint64_t addend = (uint64_t)round;
        const int64_t begin_ns = dip_clock_ns();
        for (int i = 0; i < STEPS; i++) {
            for (int k = 0; k < PER_STEP; k++) { // Compilers unroll this loop.
                __asm__ volatile("" : "+r"(sum), "+r"(addend));
                sum += addend;
            }
        }
        __asm__ volatile("" : "+r"(sum));
        const double ns = (double)(dip_clock_ns() - begin_ns) / (STEPS * PER_STEP);
        fastest = ns < fastest ? ns : fastest;
    }
    return fastest;
}

size_t dip_machine_peak_rss_bytes(void) {
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? (size_t)usage.ru_maxrss * 1024 : 0;
}
