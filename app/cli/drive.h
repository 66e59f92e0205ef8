// Timing frames in a command: a timing driver steps until it is done, with progress and Ctrl-C.
#ifndef DIP_APP_CLI_DRIVE_H
#define DIP_APP_CLI_DRIVE_H

#include "app/measure/timing/driver.h"

// Steps until the driver is done, and shows on standard error how many frames are timed: `things`
// names them. Fails as the driver does. Once the user has pressed Ctrl-C (interrupt.h), fails with
// DIP_ERROR_RUNTIME, the key `command` and the message `interrupted`.
bool dip_drive(DipDriver *driver, const char *things, const char *command, const char *interrupted,
               DipError *err);

#endif
