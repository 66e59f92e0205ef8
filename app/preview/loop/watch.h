// Watches files for changes, by looking at their times, sizes and inodes four times a second. This
// works on every file system.
//
// A change is reported when the files have stopped changing for half a second, so that a file is
// not read while another program still writes it.
#ifndef DIP_APP_PREVIEW_LOOP_WATCH_H
#define DIP_APP_PREVIEW_LOOP_WATCH_H

#include <stdbool.h>
#include <stdint.h>

enum { DIP_WATCH_NAME_SIZE = 256 };

typedef struct DipWatch DipWatch;

// Returns NULL when memory runs out.
DipWatch *dip_watch_create(void);
void dip_watch_destroy(DipWatch **watch);

// These functions replace the list of watched files. Call dip_watch_begin_list, then dip_watch_file
// and dip_watch_folder for each entry, then dip_watch_end_list. An entry that was in the old list
// is still compared with its state at the last look, so that no change is missed. The files need
// not exist. If memory runs out, an entry is left out.
void dip_watch_begin_list(DipWatch *watch);
void dip_watch_end_list(DipWatch *watch);
void dip_watch_file(DipWatch *watch, const char *file);

// Watches the models, and the files that models use, in the folder of a file and in that folder's
// direct subfolders. Ignores other kinds of files, hidden files and folders, and files whose names
// begin with "diptych-", as those of screenshots do. Looks at no more than 2048 names of a folder.
void dip_watch_folder(DipWatch *watch, const char *file);

// Looks at the files if a quarter of a second has passed since the last look. Returns true once
// after files have changed and come to rest. Then sets `name`: if the last change was seen in a
// folder, to the name of the file in it that was written last; if it was seen in a file, to that
// file's name. The name has no folder; it is "" if files have only disappeared. `now_ns` is the
// time on any clock that does not go backwards.
bool dip_watch_poll(DipWatch *watch, int64_t now_ns, char name[DIP_WATCH_NAME_SIZE]);

#endif
