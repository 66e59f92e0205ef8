// Folders that files are written to.
#ifndef DIP_APP_FILES_FOLDER_H
#define DIP_APP_FILES_FOLDER_H

#include "renderer/base/api.h"
#include "renderer/base/error.h"

#ifdef __cplusplus
extern "C" {
#endif

// Makes the folder and its missing parents. Fails with DIP_ERROR_OVERSIZED or DIP_ERROR_IO;
// `option` names the option at fault in the message. Thread-safe.
DIP_API bool dip_folder_make(const char *folder, const char *option, DipError *err);

#ifdef __cplusplus
}
#endif

#endif
