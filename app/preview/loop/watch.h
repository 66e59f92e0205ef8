// Watches files for changes, by looking at their times and sizes four times a second. This works on
// every file system.
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

// Replace the list of watched files: call dip_watch_begin_list, then dip_watch_file and
// dip_watch_folder for each entry, then dip_watch_end_list. What is known about an entry that was
// in the old list is kept, so that no change is missed. The files need not exist. If memory runs
// out, an entry is left out.
void dip_watch_begin_list(DipWatch *watch);
void dip_watch_end_list(DipWatch *watch);
void dip_watch_file(DipWatch *watch, const char *file);

// Watches the models, and the files that models use, in the folder of a file and in that folder's
// subfolders. Other kinds of files do not count, and neither do screenshots of the preview.
void dip_watch_folder(DipWatch *watch, const char *file);

// Looks at the files if a quarter of a second has passed since the last look. Returns true once
// after files have changed and come to rest, and sets `name` to the name, without its folder, of a
// file that has changed; "" if files have only disappeared. now_ns: any clock that does not go
// backwards.
bool dip_watch_poll(DipWatch *watch, int64_t now_ns, char name[DIP_WATCH_NAME_SIZE]);

#endif
