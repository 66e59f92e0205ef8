// The commands `diptych cost`, `diptych cost merge`, `diptych cost assets` and `diptych cost diff`.
#ifndef DIP_APP_COST_COMMAND_H
#define DIP_APP_COST_COMMAND_H

#include "app/command.h"

extern const DipCommand dip_cost_command;
extern const DipCommand dip_cost_merge_command;
extern const DipCommand dip_cost_assets_command;
extern const DipCommand dip_cost_diff_command; // in diff_command.c

#endif
