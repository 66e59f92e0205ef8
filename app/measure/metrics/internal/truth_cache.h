// The files of truths that were drawn before. Processes may share a folder.
#ifndef DIP_APP_MEASURE_METRICS_INTERNAL_TRUTH_CACHE_H
#define DIP_APP_MEASURE_METRICS_INTERNAL_TRUTH_CACHE_H

#include "app/measure/metrics/truth.h"

// Writes the key of a truth, which names its file.
void dip_truth_find_key(const DipTruthDef *def, char key[33]);

// Reads the truth, whose key, size and arrays are set, from a folder. Returns false if there is no
// such file or if the file is damaged.
bool dip_truth_load(DipTruth *truth, const char *cache);

// Writes the truth to a folder.
bool dip_truth_store(DipTruth *truth, const char *cache, DipError *err);

// Returns the bytes that the truths of a folder take.
int64_t dip_truth_cache_bytes(const char *cache);

#endif
