// The display of a desktop: a window that SDL 2 opens.
#ifndef DIP_APP_DISPLAY_SDL_SDL_DISPLAY_H
#define DIP_APP_DISPLAY_SDL_SDL_DISPLAY_H

#include "app/display/display.h"

// Opens a window with a picture of the given size in pixels, or with a smaller picture if the
// screen is smaller. Fails with RUNTIME if there is no display, or if the display has too few
// colours; the message says which. The caller closes the display.
bool dip_sdl_display_open(DipDisplay *display, int width, int height, DipError *err);

#endif
