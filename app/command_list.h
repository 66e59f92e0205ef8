// Declares the list of Diptych's commands.
#ifndef DIP_APP_COMMAND_LIST_H
#define DIP_APP_COMMAND_LIST_H

#include "app/cli/command.h"

extern const DipCommandList dip_command_list;

#endif
