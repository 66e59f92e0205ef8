// The file of the running program: Diptych starts itself again to import models and to time frames,
// and finds the files that were installed with it by its path.
#ifndef DIP_APP_CLI_PROGRAM_FILE_H
#define DIP_APP_CLI_PROGRAM_FILE_H

// Returns the absolute path of the program, without symbolic links. Linux tells it in /proc. Where
// /proc cannot be read, it follows from the name that the program was started by, so the first call
// must come before the working directory changes. Returns NULL if neither tells the path. The text
// stays valid. Any thread may call.
const char *dip_program_path(void);

// Returns a name of the program's file to open or to execute: one that still works after the file
// was replaced or removed if /proc can be read, else dip_program_path. It is never NULL. The text
// stays valid. Any thread may call.
const char *dip_program_file(void);

#endif
