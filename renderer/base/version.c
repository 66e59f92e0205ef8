// Tells the library's version.
#include "renderer/base/version.h"

#define TEXT(number)              #number
#define JOIN(major, minor, patch) TEXT(major) "." TEXT(minor) "." TEXT(patch)

const char *dip_version(void) {
    return JOIN(DIP_VERSION_MAJOR, DIP_VERSION_MINOR, DIP_VERSION_PATCH);
}
