// How alike two pictures are.
#ifndef DIP_TESTS_PEER_LIKENESS_H
#define DIP_TESTS_PEER_LIKENESS_H

#include <stddef.h>
#include <stdint.h>

// Mean of the squared differences of red, green and blue, in codes squared. Pixels of 4 bytes;
// alpha is left out.
double dip_likeness_squared_error(const uint8_t *a, size_t a_stride_bytes, const uint8_t *b,
                                  size_t b_stride_bytes, int width, int height);

// Decibels below full scale (255); infinite for no error.
double dip_likeness_psnr_db(double squared_error);

#endif
