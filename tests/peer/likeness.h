// Measures how much two pictures differ.
#ifndef DIP_TESTS_PEER_LIKENESS_H
#define DIP_TESTS_PEER_LIKENESS_H

#include <stddef.h>
#include <stdint.h>

// Returns the mean squared difference of red, green and blue, in units of squared 8-bit steps.
// Pixels have 4 bytes; alpha is ignored.
double dip_likeness_squared_error(const uint8_t *a, size_t a_stride_bytes, const uint8_t *b,
                                  size_t b_stride_bytes, int width, int height);

// Returns the PSNR, in decibels relative to full scale (255), for a mean squared error. The PSNR is
// infinite if the error is 0.
double dip_likeness_psnr_db(double squared_error);

#endif
