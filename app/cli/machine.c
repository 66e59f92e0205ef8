// Reads the machine's properties from Linux, and hashes the program's file.
#include "app/cli/machine.h"

#include "renderer/base/hash.h"

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
            snprintf(name, size_bytes, "%s", colon + 2);
            break;
        }
    }
    if (in) {
        fclose(in);
    }
}

void dip_machine_build(char hex[33]) {
    hex[0] = '\0';
    FILE *in = fopen("/proc/self/exe", "rb");
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

size_t dip_machine_peak_rss_bytes(void) {
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? (size_t)usage.ru_maxrss * 1024 : 0;
}
