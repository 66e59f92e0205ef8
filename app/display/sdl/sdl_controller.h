// Game controllers, as SDL sees them. Private to this folder.
#ifndef DIP_APP_DISPLAY_SDL_SDL_CONTROLLER_H
#define DIP_APP_DISPLAY_SDL_SDL_CONTROLLER_H

#include "app/display/display.h"

#include <SDL2/SDL.h>

// Makes SDL send events of game controllers. If SDL cannot, there are no controllers.
void dip_sdl_controller_init(void);

// Translates an event of a controller; all other events become DIP_EVENT_NONE. Opens a controller
// that was added and closes one that was removed. SDL_Quit closes the rest.
DipEvent dip_sdl_controller_translate(const SDL_Event *sdl);

#endif
