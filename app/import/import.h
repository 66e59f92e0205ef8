// Declares `diptych import`, the hidden command that imports models for another process of Diptych.
#ifndef DIP_APP_IMPORT_IMPORT_H
#define DIP_APP_IMPORT_IMPORT_H

#include "app/cli/command.h"

extern const DipCommand dip_import_command;

#endif
