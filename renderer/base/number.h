// Conversion of numbers from and to text: strict, exact and the same in every locale.
#ifndef DIP_RENDERER_BASE_NUMBER_H
#define DIP_RENDERER_BASE_NUMBER_H

#include "renderer/base/api.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    DIP_MAX_NUMBER_LENGTH = 63, // characters of the longest text that is read as a number
    DIP_NUMBER_TEXT_SIZE = 32   // bytes that dip_number_format writes at most
};

// Reads the whole of text[0..length-1] as a decimal number: an optional sign, digits with an
// optional '.', and an optional exponent. White space, hexadecimal numbers, "inf", "nan", texts
// longer than DIP_MAX_NUMBER_LENGTH and numbers too great for a double are refused. A number too
// small for a normal double becomes the nearest subnormal or 0. The result is correctly rounded. On
// failure, returns false and leaves *value unchanged. Thread-safe.
DIP_API bool dip_number_parse(const char *text, size_t length, double *value);

// Reads the whole of text[0..length-1] as an integer: an optional sign and digits. Numbers outside
// -INT_MAX..INT_MAX are refused. On failure, returns false and leaves *value unchanged.
// Thread-safe.
DIP_API bool dip_integer_parse(const char *text, size_t length, int *value);

// Writes a finite number with 15, 16 or 17 significant digits: the smallest of these numbers of
// digits from which the same double is read back. Returns the length of the text. Thread-safe.
DIP_API size_t dip_number_format(double value, char buffer[DIP_NUMBER_TEXT_SIZE]);

#ifdef __cplusplus
}
#endif

#endif
