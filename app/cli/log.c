// Formats errors and writes them to standard error and to the log file.
#include "app/cli/log.h"

#include "app/files/put.h"
#include "renderer/base/file.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static FILE *log_file;

bool dip_log_open(const char *file, DipError *err) {
    log_file = fopen(file, "a");
    if (log_file) {
        return true;
    }
    const bool is_machine = dip_file_open_code(errno) == DIP_ERROR_RUNTIME;
    return dip_error_set(err, is_machine ? DIP_ERROR_RUNTIME : DIP_ERROR_IO, file, 0, "log",
                         "cannot be written: %s", strerror(errno));
}

void dip_log_close(void) {
    if (log_file) {
        fclose(log_file);
        log_file = NULL;
    }
}

static void print_line(const char *text) {
    fprintf(stderr, "diptych: %s\n", text);
    if (log_file) {
        fprintf(log_file, "%s\n", text);
        fflush(log_file);
    }
}

void dip_log_error(const DipError *err) {
    char text[1024];
    dip_error_format(err, text, sizeof text);
    dip_put_clean(text); // Messages quote files, which may hold control characters.
    print_line(text);
}

void dip_log_note(const char *format, ...) {
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    print_line(text);
}

void dip_log_errors(const DipErrorList *list) {
    for (size_t i = 0; i < list->count; i++) {
        dip_log_error(&list->items[i]);
    }
}

bool dip_output_finish(DipError *err) {
    // An earlier print may have failed, even if the flush succeeds. Its errno is lost.
    const bool lost = ferror(stdout) != 0;
    errno = 0;
    if (fflush(stdout) == 0 && !lost) {
        return true;
    }
    return dip_error_set_runtime(err, DIP_ERROR_IO, NULL, 0, NULL,
                                 "standard output cannot be written%s%s", errno ? ": " : "",
                                 errno ? strerror(errno) : "");
}
