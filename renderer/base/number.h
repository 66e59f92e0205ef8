// Numbers from text and to text: strict, exact and the same in every locale.
#ifndef DIP_RENDERER_BASE_NUMBER_H
#define DIP_RENDERER_BASE_NUMBER_H

#include "renderer/base/api.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    DIP_MAX_NUMBER_LENGTH = 63, // characters of a number's text
    DIP_NUMBER_TEXT_SIZE = 32   // bytes that dip_number_format needs at most
};

// Reads the whole of text[0..length-1] as a decimal number: sign, digits, '.', exponent, with at
// least one digit. No white space, hexadecimal, "inf" or "nan"; a number too great for a double is
// refused, one too small becomes 0 or the nearest subnormal. *value is unchanged on failure.
// Correctly rounded. Thread-safe.
DIP_API bool dip_number_parse(const char *text, size_t length, double *value);

// As above for an optional sign and digits, within int.
DIP_API bool dip_integer_parse(const char *text, size_t length, int *value);

// Writes the shortest of 15, 16 or 17 significant digits that reads back as the same double (a
// finite one). Returns the length. Thread-safe.
DIP_API size_t dip_number_format(double value, char buffer[DIP_NUMBER_TEXT_SIZE]);

#ifdef __cplusplus
}
#endif

#endif
