// Helps to save files from the window: finds a free name, words the notice that names a saved file,
// and appends poses to a file.
//
// The file of poses is a camera path in the text format (campaths/campath.h). A new file has one
// second from key to key. `--path poses.pth` flies from pose to pose, and --pose takes the seven
// numbers of a line.
#ifndef DIP_APP_PREVIEW_STATE_POSES_H
#define DIP_APP_PREVIEW_STATE_POSES_H

#include "renderer/base/error.h"
#include "renderer/scene/pose.h"

#include <stdbool.h>
#include <stddef.h>

#define DIP_POSES_FILE "poses.pth" // The file of poses, in the working folder.

// Appends a pose as the last key of a path file, with its field of view in a comment. Makes the
// file if there is none. Sets *count to the number of poses in the file. If the file is not a
// camera path in the text format, or cannot be written, fails and leaves the file as it is.
bool dip_poses_append(const char *file, const DipPose *pose, size_t *count, DipError *err);

// Writes a notice that names a saved file and the working folder, in which it lies: "Saved
// diptych-0001.png in /home/me". If the folder's path is long, its beginning is cut off; if the
// path is not known, the notice leaves it out.
void dip_saved_describe(const char *what, const char *file, char *text, size_t size_bytes);

// Finds the first name, from "NAME-0001.ENDING" on, that no file in the working folder has. Returns
// false if all numbers to 9999 are taken.
bool dip_saved_free_name(const char *name, const char *ending, char *file, size_t size_bytes);

#endif
