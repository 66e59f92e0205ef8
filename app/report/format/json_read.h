// Reading fields of JSON objects, with checks of their ranges.
#ifndef DIP_APP_REPORT_FORMAT_JSON_READ_H
#define DIP_APP_REPORT_FORMAT_JSON_READ_H

#include "renderer/base/error.h"

#include <stdbool.h>
#include <stddef.h>

struct cJSON;

// Ranges of measurements, far beyond what can be measured. They keep all values that are computed
// from measurements finite.
#define DIP_JSON_MIN_MS    1e-6
#define DIP_JSON_MAX_MS    1e9
#define DIP_JSON_MAX_COUNT 1e15
#define DIP_JSON_MAX_MEAN  1e6

// Fills in the error for a part of a report that is missing or wrong. Returns false.
bool dip_json_missing(const char *file, const char *what, DipError *err);

// Reads a whole number in least..most. Sets *ok to false and returns -1 if there is none.
int dip_json_integer(const struct cJSON *object, const char *name, int least, int most, bool *ok);

// Returns a number, or 0 if there is none. A number outside of 0..most sets *ok to false.
double dip_json_number(const struct cJSON *object, const char *name, double most, bool *ok);

// Copies a text and cuts it to the size. Sets *ok to false if the item is not a text.
void dip_json_copy_text(const struct cJSON *item, char *to, size_t size, bool *ok);

// Reads an array of exactly `count` numbers in least..most. Returns false if there is none.
bool dip_json_numbers(const struct cJSON *array, int count, double least, double most, double *to);

#endif
