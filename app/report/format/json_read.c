// Reading fields of JSON objects.
#include "app/report/format/json_read.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>

bool dip_json_missing(const char *file, const char *what, DipError *err) {
    return dip_error_set(err, DIP_ERROR_FORMAT, file, 0, what,
                         "is missing, or is not what `diptych cost` writes");
}

int dip_json_integer(const cJSON *object, const char *name, int least, int most, bool *ok) {
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, name);
    const bool good = cJSON_IsNumber(item) && item->valuedouble >= least &&
                      item->valuedouble <= most && floor(item->valuedouble) == item->valuedouble;
    *ok = *ok && good;
    return good ? (int)item->valuedouble : -1;
}

double dip_json_number(const cJSON *object, const char *name, double most, bool *ok) {
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, name);
    const double value = cJSON_IsNumber(item) ? item->valuedouble : 0.0;
    *ok = *ok && value >= 0.0 && value <= most;
    return value;
}

void dip_json_copy_text(const cJSON *item, char *to, size_t size, bool *ok) {
    if (cJSON_IsString(item)) {
        snprintf(to, size, "%s", item->valuestring);
    } else {
        *ok = false;
    }
}

bool dip_json_numbers(const cJSON *array, int count, double least, double most, double *to) {
    if (!cJSON_IsArray(array) || cJSON_GetArraySize(array) != count) {
        return false;
    }
    const cJSON *item;
    cJSON_ArrayForEach(item, array) {
        if (!cJSON_IsNumber(item) || !(item->valuedouble >= least && item->valuedouble <= most)) {
            return false;
        }
        *to++ = item->valuedouble;
    }
    return true;
}
