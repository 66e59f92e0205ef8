// Declares the command `diptych cost` and its subcommands, such as `diptych cost merge`.
#ifndef DIP_APP_COST_COMMAND_H
#define DIP_APP_COST_COMMAND_H

#include "app/cli/command.h"

extern const DipCommand dip_cost_command;
extern const DipCommand dip_cost_merge_command;   // in merge/merge.c
extern const DipCommand dip_cost_diff_command;    // in diff/diff_command.c
extern const DipCommand dip_cost_advise_command;  // in advise/advise_command.c
extern const DipCommand dip_cost_predict_command; // in predict/predict_command.c

#endif
