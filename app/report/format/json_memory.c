// Watches the allocations of cJSON.
#include "app/report/format/json_memory.h"

#include <cjson/cJSON.h>
#include <stdlib.h>

static bool ran_out;

static void *allocate(size_t size_bytes) {
    void *memory = malloc(size_bytes);
    ran_out = ran_out || !memory;
    return memory;
}

static void release(void *memory) {
    free(memory);
}

void dip_json_memory_begin(void) {
    cJSON_Hooks hooks = {.malloc_fn = allocate, .free_fn = release};
    ran_out = false;
    cJSON_InitHooks(&hooks);
}

bool dip_json_memory_ran_out(void) {
    return ran_out;
}

void dip_json_memory_end(void) {
    cJSON_InitHooks(NULL);
}
