// Errors of the X server about windows of other programs. Private to this folder.
//
// Xlib's own handler ends the process at any error. While a file is dropped and while another
// program takes the clipboard, SDL writes to windows of that other program. If the program dies at
// that moment, the X server answers with BadWindow, which must not end the preview.
#ifndef DIP_APP_DISPLAY_SDL_SDL_X_ERRORS_H
#define DIP_APP_DISPLAY_SDL_SDL_X_ERRORS_H

#include <SDL2/SDL.h>

// Makes the process ignore BadWindow if the window is not `own`. The handler that was set before
// gets all other errors. Does nothing if SDL does not use X11. The handler belongs to the process,
// so only one window at a time can be `own`.
void dip_sdl_x_errors_watch(SDL_Window *own);

// Sets the handler that was set before dip_sdl_x_errors_watch. Does nothing without a watch.
void dip_sdl_x_errors_end(void);

#endif
