// Declares the commands `diptych path info` and `diptych path convert`, which describe and rewrite
// camera paths.
#ifndef DIP_APP_PATH_PATH_H
#define DIP_APP_PATH_PATH_H

#include "app/cli/command.h"

extern const DipCommand dip_path_info_command;
extern const DipCommand dip_path_convert_command;

#endif
