// The path commands take files, but no options of their own. Checks the number and the names of the
// files.
#include "app/path/options.h"

#include "renderer/base/assert.h"

#include <string.h>

static const DipOptionPart parts[] = {
    {&dip_program_option_table, offsetof(DipPathOptions, program)},
};
const DipOptionParts dip_path_option_parts = {parts, DIP_ARRAY_COUNT(parts)};

bool dip_path_info_options_check(const void *options, DipError *err) {
    const DipPathOptions *path = options;
    return path->file_count == 1 || dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "path info",
                                                  "needs a file: path info FILE");
}

static bool ends_with(const char *text, const char *end) {
    const size_t length = strlen(text);
    return length >= strlen(end) && strcmp(text + length - strlen(end), end) == 0;
}

bool dip_path_convert_options_check(const void *options, DipError *err) {
    const DipPathOptions *path = options;
    if (path->file_count != 2) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "path convert",
                             "needs two files but got %d: path convert IN OUT", path->file_count);
    }
    return ends_with(path->files[1], ".pth") || ends_with(path->files[1], ".bth") ||
           dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, "path convert",
                         "'%.200s' names no format; write to a file that ends in .pth (text) or "
                         ".bth (binary)",
                         path->files[1]);
}
