// SDL's events as the seam's events. Private to this folder.
#ifndef DIP_APP_DISPLAY_SDL_SDL_EVENT_H
#define DIP_APP_DISPLAY_SDL_SDL_EVENT_H

#include "app/display/display.h"

#include <SDL2/SDL.h>

// Translates an event; what the seam has no event for becomes DIP_EVENT_NONE. A DROP borrows the
// name of the file from the SDL event, which the caller frees.
DipEvent dip_sdl_event_translate(const SDL_Event *sdl);

#endif
