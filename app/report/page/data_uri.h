// Files inside a page, as data URIs.
#ifndef DIP_APP_REPORT_PAGE_DATA_URI_H
#define DIP_APP_REPORT_PAGE_DATA_URI_H

#include <stddef.h>

// Returns "data:TYPE;base64,..." for a file's bytes. The caller frees it. Returns NULL when memory
// runs out.
char *dip_cost_data_uri(const char *type, const unsigned char *bytes, size_t size_bytes);

#endif
