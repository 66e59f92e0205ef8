// Declares the command `diptych compare`, which measures how much two pictures differ. It can apply
// a filter to the first picture before it compares them.
#ifndef DIP_APP_COMPARE_COMPARE_H
#define DIP_APP_COMPARE_COMPARE_H

#include "app/cli/command.h"

extern const DipCommand dip_compare_command;

#endif
