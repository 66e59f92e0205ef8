// How small bytes become when they are compressed, as an archive would.
#ifndef DIP_APP_FILES_ZIP_H
#define DIP_APP_FILES_ZIP_H

#include <stddef.h>

// Bytes after deflate; 0 when memory runs out or there are 2^31 of them.
size_t dip_zip_size(const unsigned char *bytes, size_t size_bytes);

#endif
