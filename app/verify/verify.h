// Declares the command `diptych verify`, which checks that this machine draws the same bits as
// every other and measures the catalogue of hard cases.
#ifndef DIP_APP_VERIFY_VERIFY_H
#define DIP_APP_VERIFY_VERIFY_H

#include "app/cli/command.h"

extern const DipCommand dip_verify_command;

#endif
