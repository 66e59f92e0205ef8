// Declares the command `diptych preview`, which shows both panes in a window or in a terminal.
#ifndef DIP_APP_PREVIEW_COMMAND_H
#define DIP_APP_PREVIEW_COMMAND_H

#include "app/cli/command.h"

extern const DipCommand dip_preview_command;

#endif
