// A window of another X11 program, the host, that holds the preview's window. Private to this
// folder.
//
// SDL selects no events on a window that it has not created, and only one program may select
// button presses on a window. The preview therefore makes a child of the host's window. It follows
// the host's window on a connection of its own, and selects the child's events on SDL's connection.
#ifndef DIP_APP_DISPLAY_SDL_SDL_HOST_H
#define DIP_APP_DISPLAY_SDL_SDL_HOST_H

#include "renderer/base/error.h"

#include <SDL2/SDL.h>

#include <stdbool.h>
#include <stdint.h>

typedef struct DipSdlHost DipSdlHost;

// Makes a child that covers the host's window. SDL must have been initialised with its X11 driver.
// From then on, errors of the X server no longer end the process, because the host can destroy its
// window at any time. Fails with MISSING if there is no such window, or with RUNTIME.
DipSdlHost *dip_sdl_host_open(unsigned long window_id, DipError *err);

// Destroys the child. *host may be NULL and becomes NULL.
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

// Hides the child before it is destroyed.
void dip_sdl_host_hide_child(const DipSdlHost *host);

// Returns whether the child cannot be seen, because the host's window or a window around it is
// unmapped. Asks the X server four times a second. now_ns: time on any clock.
bool dip_sdl_host_is_hidden(DipSdlHost *host, int64_t now_ns);

// Gives the child the keyboard focus. Returns whether it did not have the focus before.
bool dip_sdl_host_take_focus(const DipSdlHost *host);

#endif
