// Makes the folders that files are written to.
#ifndef DIP_APP_FILES_FOLDER_H
#define DIP_APP_FILES_FOLDER_H

#include "renderer/base/error.h"

// Makes the folder and its missing parents. Fails with DIP_ERROR_OVERSIZED or DIP_ERROR_IO;
// `option` names the option at fault in the message. Thread-safe.
bool dip_folder_make(const char *folder, const char *option, DipError *err);

#endif
