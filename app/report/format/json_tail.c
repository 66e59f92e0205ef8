// Writing and reading the distribution of FLIP.
#include "app/report/format/json_tail.h"

#include <cjson/cJSON.h>
#include <stddef.h>

// A number of the distribution, and its greatest value.
typedef struct Field {
    const char *name;
    size_t offset;
    double most;
} Field;

#define FIELD(name, most)                                                                          \
    { #name, offsetof(DipFlipTail, name), most }
static const Field fields[DIP_FLIP_TAIL_COUNT] = {
    FIELD(p50, 1.0),
    FIELD(p95, 1.0),
    FIELD(p99, 1.0),
    FIELD(worst, 1.0),
    FIELD(worst_frame, 1e3),
    FIELD(worst_x, 8192.0),
    FIELD(worst_y, 8192.0),
    FIELD(worst_width, 8192.0),
    FIELD(worst_height, 8192.0),
};
#undef FIELD

struct cJSON *dip_cost_tail_add(struct cJSON *to, const DipFlipTail *tail) {
    if (tail->worst_width == 0.0) {
        return NULL;
    }
    cJSON *object = cJSON_AddObjectToObject(to, "flip_tail");
    for (int i = 0; i < DIP_FLIP_TAIL_COUNT; i++) {
        const double *value = (const double *)((const char *)tail + fields[i].offset);
        cJSON_AddNumberToObject(object, fields[i].name, *value);
    }
    return object;
}

bool dip_cost_tail_read(const struct cJSON *from, DipFlipTail *tail) {
    const cJSON *object = cJSON_GetObjectItemCaseSensitive(from, "flip_tail");
    *tail = (DipFlipTail){.p50 = 0.0};
    for (int i = 0; object && i < DIP_FLIP_TAIL_COUNT; i++) {
        const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, fields[i].name);
        if (!cJSON_IsNumber(item) ||
            !(item->valuedouble >= 0.0 && item->valuedouble <= fields[i].most)) {
            return false;
        }
        *(double *)((char *)tail + fields[i].offset) = item->valuedouble;
    }
    return true;
}
