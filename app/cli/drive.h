// Times frames in a command: steps a timing driver (app/measure/timing/driver.h) until it is done,
// shows the progress and stops after Ctrl-C.
#ifndef DIP_APP_CLI_DRIVE_H
#define DIP_APP_CLI_DRIVE_H

#include "app/measure/timing/driver.h"

// Steps the driver until it is done. Shows on standard error how many frames have been drawn. If
// the driver then looks for disturbed frames to draw again, also shows in how many rounds it has
// looked. `things` is the word for the frames in the line that shows the progress, such as
// "frames". If the driver fails, fails with the driver's error. After Ctrl-C or SIGTERM
// (progress.h), fails with DIP_ERROR_RUNTIME, the key `command` and the message `interrupted`.
bool dip_drive(DipDriver *driver, const char *things, const char *command, const char *interrupted,
               DipError *err);

#endif
