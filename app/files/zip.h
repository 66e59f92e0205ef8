// The size of a block of bytes after deflate, the compression of zip archives.
#ifndef DIP_APP_FILES_ZIP_H
#define DIP_APP_FILES_ZIP_H

#include <stddef.h>

// Returns the number of bytes after deflate. Returns 0 when memory runs out, for an empty block,
// and for 2^31 bytes or more. Thread-safe.
size_t dip_zip_size(const unsigned char *bytes, size_t size_bytes);

#endif
