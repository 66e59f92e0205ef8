// Folders that commands write to.
#ifndef DIP_APP_FILES_FOLDER_H
#define DIP_APP_FILES_FOLDER_H

#include "renderer/base/error.h"

// Makes the folder and those above it, as far as they are missing. option: for messages.
bool dip_folder_make(const char *folder, const char *option, DipError *err);

#endif
