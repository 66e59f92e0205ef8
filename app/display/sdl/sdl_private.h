// Declares what the files of this folder do for each other: they translate events, follow the
// window of a host, and handle errors of the X server.
#ifndef DIP_APP_DISPLAY_SDL_SDL_PRIVATE_H
#define DIP_APP_DISPLAY_SDL_SDL_PRIVATE_H

#include "app/display/display.h"

#include <SDL2/SDL.h>

// --- sdl_event.c ----------------------------------------------------------------------------

// Makes SDL send events of game controllers. If SDL cannot, there are no controllers.
void dip_sdl_controller_init(void);

// Translates an event. An event that event.h has no kind for becomes DIP_EVENT_NONE. The event DROP
// points to the file's name in the SDL event; the caller must free that name with SDL_free. Opens a
// controller that was added and closes one that was removed; SDL_Quit closes the rest.
DipEvent dip_sdl_event_translate(const SDL_Event *sdl);

// --- sdl_host.c -----------------------------------------------------------------------------

// A window of another X11 program, the host, that holds the preview's window.
//
// SDL selects no events on a window that it has not created, and only one program may select
// button presses on a window. The preview therefore makes a child of the host's window. It follows
// the host's window on a connection of its own, and selects the child's events on SDL's connection.

typedef struct DipSdlHost DipSdlHost;

// Makes a child that covers the host's window. SDL must have been initialised with its X11 driver.
// From then on, errors of the X server no longer end the process, because the host can destroy its
// window at any time. Fails with MISSING if there is no such window, with RUNTIME if there is no
// X11 display, or with MEMORY.
DipSdlHost *dip_sdl_host_open(unsigned long window_id, DipError *err);

// Destroys the child and frees the host. *host may be NULL and becomes NULL.
void dip_sdl_host_close(DipSdlHost **host);

unsigned long dip_sdl_host_child(const DipSdlHost *host);

// Selects the events of the SDL window that was made from the child. Returns false if SDL does not
// use X11.
bool dip_sdl_host_select(SDL_Window *window);

// Gives the child the size of the host's window if that has changed. Returns false if the host's
// window has gone away.
bool dip_sdl_host_follow(DipSdlHost *host);

// Asks the X server whether the host's window has gone away.
bool dip_sdl_host_is_gone(DipSdlHost *host);

// Hides the child. Call this function before SDL destroys the child's window.
void dip_sdl_host_hide_child(const DipSdlHost *host);

// Returns whether the child cannot be seen, because the host's window or a window around it is
// unmapped. Asks the X server at most four times a second. `now_ns` is the present time on a
// monotonic clock.
bool dip_sdl_host_is_hidden(DipSdlHost *host, int64_t now_ns);

// Gives the child the keyboard focus. Returns whether it did not have the focus before.
bool dip_sdl_host_take_focus(const DipSdlHost *host);

// The functions below handle errors of the X server about windows of other programs.
//
// Xlib's own handler ends the process at any error. While another program drops a file or takes the
// clipboard, SDL writes to windows of that program. If the program dies at that moment, the X
// server answers with BadWindow, which must not end the preview.

// From now on, the process ignores BadWindow errors about all windows but `own`. The handler that
// was set before gets all other errors. Does nothing if SDL does not use X11. The handler belongs
// to the process, so only one window at a time can be `own`.
void dip_sdl_x_errors_watch(SDL_Window *own);

// From now on, the process ignores BadWindow errors about `own`, too, because an event that SDL has
// sent to this window may reach the X server after the window is gone. Call this function before
// the window is destroyed. It waits about 20 ms, so that the X server usually handles such an event
// in time.
void dip_sdl_x_errors_close(SDL_Window *own);

// Undoes dip_sdl_x_errors_watch. Does nothing if no window is watched.
void dip_sdl_x_errors_end(void);

#endif
