// Flushes standard output.
#include "app/cli/output.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

bool dip_output_finish(DipError *err) {
    // An earlier print may have failed, and its errno is lost. The flush can succeed all the same.
    const bool lost = ferror(stdout) != 0;
    errno = 0;
    if (fflush(stdout) == 0 && !lost) {
        return true;
    }
    return dip_error_set_runtime(err, DIP_ERROR_IO, NULL, 0, NULL,
                                 "standard output cannot be written%s%s", errno ? ": " : "",
                                 errno ? strerror(errno) : "");
}
