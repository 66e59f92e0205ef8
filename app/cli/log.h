// Prints warnings and errors on standard error and, on request, to a log file. Also checks that
// standard output has been written.
#ifndef DIP_APP_CLI_LOG_H
#define DIP_APP_CLI_LOG_H

#include "renderer/base/error.h"

#include <stdbool.h>

// Opens a log file. From now on, the functions below also append to this file every line that they
// print, without "diptych: ". Fails with DIP_ERROR_IO if the file cannot be opened, or with
// DIP_ERROR_RUNTIME if the machine is the cause, for example because too many files are open.
bool dip_log_open(const char *file, DipError *err);
void dip_log_close(void);

// Prints one line "diptych: file:line: [key] message" for each error, and "diptych: file:line:
// warning: [key] message" for each warning. Leaves out the file, the line and the key if there are
// none.
void dip_log_error(const DipError *err);
void dip_log_errors(const DipErrorList *list);

// Prints a note (not an error) as one line "diptych: ...".
void dip_log_note(const char *format, ...) DIP_PRINTF(1, 2);

// Flushes standard output, which may be a file on a full disk. Fails with DIP_ERROR_IO if anything
// that the program printed was lost. Call this function once, at the end of the program.
bool dip_output_finish(DipError *err);

#endif
