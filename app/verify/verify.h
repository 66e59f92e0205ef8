// Declares the command `diptych verify`. It checks that this machine draws the same bits as every
// other machine, and measures each numerically hard case of docs/stability.md
// against an independent truth.
#ifndef DIP_APP_VERIFY_VERIFY_H
#define DIP_APP_VERIFY_VERIFY_H

#include "app/cli/command.h"

extern const DipCommand dip_verify_command;

#endif
