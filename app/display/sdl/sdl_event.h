// Translates SDL's events to those of display.h. Private to this folder.
#ifndef DIP_APP_DISPLAY_SDL_SDL_EVENT_H
#define DIP_APP_DISPLAY_SDL_SDL_EVENT_H

#include "app/display/display.h"

#include <SDL2/SDL.h>

// Translates an event. An event that display.h has no kind for becomes DIP_EVENT_NONE. A DROP
// borrows the file's name from the SDL event; the caller must free that name.
DipEvent dip_sdl_event_translate(const SDL_Event *sdl);

#endif
