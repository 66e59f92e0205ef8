// The commands `diptych cost`, `diptych cost merge` and `diptych cost assets`.
#ifndef DIP_APP_COST_COMMAND_H
#define DIP_APP_COST_COMMAND_H

#include "app/command.h"

extern const DipCommand dip_cost_command;
extern const DipCommand dip_cost_merge_command;
extern const DipCommand dip_cost_assets_command;

#endif
