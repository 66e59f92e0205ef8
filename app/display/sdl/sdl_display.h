// Opens the display of a desktop, which is a window of SDL 2.
#ifndef DIP_APP_DISPLAY_SDL_SDL_DISPLAY_H
#define DIP_APP_DISPLAY_SDL_SDL_DISPLAY_H

#include "app/display/display.h"

// If window_id is 0, opens a window with a picture of the given size in pixels, or with a smaller
// picture if the screen is smaller.
//
// Otherwise shows the picture inside an X11 window of another program, the host, and ignores the
// given size. The display is a child of the host's window, keeps that window's size and takes its
// own keyboard and mouse events. A click on the display gives the display the keyboard focus. When
// the host's window goes away, the display sends QUIT.
//
// Fails with RUNTIME if there is no display, or if the display has too few colours; the message
// says which of the two is the case. Fails with MISSING if there is no window with this id, and
// with MEMORY when memory runs out. The caller closes the display.
bool dip_sdl_display_open(DipDisplay *display, unsigned long window_id, int width, int height,
                          DipError *err);

// Returns whether the host's window has gone away.
bool dip_sdl_display_has_lost_host(const DipDisplay *display);

#endif
