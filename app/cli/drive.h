// Times frames in a command: steps a timing driver until it is done, shows the progress and obeys
// Ctrl-C.
#ifndef DIP_APP_CLI_DRIVE_H
#define DIP_APP_CLI_DRIVE_H

#include "app/measure/timing/driver.h"

// Steps until the driver is done, and shows on standard error how many frames are timed. `things`
// is the word for them: "frames". Fails as the driver does. Once the user has pressed Ctrl-C
// (progress.h), fails with DIP_ERROR_RUNTIME, the key `command` and the message `interrupted`.
bool dip_drive(DipDriver *driver, const char *things, const char *command, const char *interrupted,
               DipError *err);

#endif
