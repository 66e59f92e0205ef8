// Notices that memory runs out inside cJSON. Most of its functions do not say so: an object then
// merely lacks a part.
//
// The functions replace the allocator of cJSON for the whole process, so only one thread may use
// cJSON between begin and end.
#ifndef DIP_APP_REPORT_FORMAT_JSON_MEMORY_H
#define DIP_APP_REPORT_FORMAT_JSON_MEMORY_H

#include <stdbool.h>

// Begins to watch the allocations of cJSON.
void dip_json_memory_begin(void);

// Returns whether an allocation has failed since dip_json_memory_begin.
bool dip_json_memory_ran_out(void);

// Gives cJSON its own allocator back.
void dip_json_memory_end(void);

#endif
