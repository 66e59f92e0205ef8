// Handles errors of the X server.
#include "app/display/sdl/sdl_private.h"

#include <SDL2/SDL_syswm.h>
#include <X11/Xlib.h>

// Xlib passes no context to a handler.
static Window own_window; // None: no watch.
static XErrorHandler previous_handler;

static int handle_error(Display *display, XErrorEvent *event) {
    if (event->error_code == BadWindow && event->resourceid != own_window) {
        return 0;
    }
    return previous_handler(display, event);
}

void dip_sdl_x_errors_watch(SDL_Window *own) {
    SDL_SysWMinfo info;
    SDL_VERSION(&info.version);
    if (own_window == None && SDL_GetWindowWMInfo(own, &info) && info.subsystem == SDL_SYSWM_X11) {
        own_window = info.info.x11.window;
        previous_handler = XSetErrorHandler(handle_error);
    }
}

void dip_sdl_x_errors_end(void) {
    if (own_window != None) {
        XSetErrorHandler(previous_handler);
        own_window = None;
    }
}
