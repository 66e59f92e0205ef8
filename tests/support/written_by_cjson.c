// Lets cJSON write to memory that a hook of Diptych allocates, in the wrapper that the linker puts
// before cJSON. The library is not built with the memory sanitizer, so the sanitizer would take
// what it writes as unwritten.
#include <cjson/cJSON.h>
#include <malloc.h>
#include <sanitizer/msan_interface.h>

static void *(*allocate)(size_t size);

static void *allocate_written(size_t size) {
    void *memory = allocate(size);
    if (memory) {
        __msan_unpoison(memory, malloc_usable_size(memory));
    }
    return memory;
}

void __real_cJSON_InitHooks(cJSON_Hooks *hooks);
void __wrap_cJSON_InitHooks(cJSON_Hooks *hooks);
void __wrap_cJSON_InitHooks(cJSON_Hooks *hooks) {
    cJSON_Hooks written;
    if (hooks) {
        allocate = hooks->malloc_fn;
        written = (cJSON_Hooks){.malloc_fn = allocate_written, .free_fn = hooks->free_fn};
    }
    __real_cJSON_InitHooks(hooks ? &written : NULL);
}
