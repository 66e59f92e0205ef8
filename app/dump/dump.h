// `diptych dump`: draws frames without a display.
#ifndef DIP_APP_DUMP_DUMP_H
#define DIP_APP_DUMP_DUMP_H

#include "app/cli/command.h"

extern const DipCommand dip_dump_command;

#endif
