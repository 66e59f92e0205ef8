// What a measurement says of the machine.
#ifndef DIP_APP_MACHINE_H
#define DIP_APP_MACHINE_H

#include <stddef.h>

// The processor's name as Linux has it, or "unknown processor".
void dip_machine_processor(char *name, size_t size_bytes);

// Processors that are online, at least 1.
int dip_machine_processor_count(void);

// The most memory of this process that was resident at a time so far.
size_t dip_machine_peak_rss_bytes(void);

#endif
