// Where warnings and errors go: standard error, and a file on request.
#ifndef DIP_APP_LOG_H
#define DIP_APP_LOG_H

#include "renderer/base/error.h"

#include <stdbool.h>

// Also appends to a file from now on. Fails with IO.
bool dip_log_open(const char *file, DipError *err);
void dip_log_close(void);

// One line "diptych: file:line: [key] message".
void dip_log_error(const DipError *err);
void dip_log_errors(const DipErrorList *list);

// One line "diptych: ..." that is no fault.
void dip_log_note(const char *format, ...) __attribute__((format(printf, 1, 2)));

#endif
