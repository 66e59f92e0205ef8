// Flushing standard output.
#include "app/output.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

bool dip_output_finish(DipError *err) {
    // An earlier print may have failed, but its reason is gone; then the flush may well succeed.
    const bool lost = ferror(stdout) != 0;
    errno = 0;
    if (fflush(stdout) == 0 && !lost) {
        return true;
    }
    return dip_error_set_runtime(err, DIP_ERROR_IO, NULL, 0, NULL,
                                 "standard output cannot be written%s%s", errno ? ": " : "",
                                 errno ? strerror(errno) : "");
}
