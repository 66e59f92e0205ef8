// Finds out the properties of the machine and of the program that a measurement reports.
#ifndef DIP_APP_CLI_MACHINE_H
#define DIP_APP_CLI_MACHINE_H

#include <stddef.h>

// Copies the name of the processor, as Linux gives it, or "unknown processor".
void dip_machine_processor(char *name, size_t size_bytes);

// Writes a hash of this program's file, or "" if the file cannot be read. The hash has 128 bits, so
// two files that differ practically never have the same hash.
void dip_machine_build(char hex[33]);

// Returns the number of processors that are online, at least 1.
int dip_machine_processor_count(void);

// Measures the length of a cycle of this processor, in nanoseconds. Takes about a twentieth of a
// second.
double dip_machine_ns_per_cycle(void);

// Returns the greatest resident memory of this process so far, in bytes, or 0 if it is unknown.
size_t dip_machine_peak_rss_bytes(void);

#endif
