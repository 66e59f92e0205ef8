// Uses Xlib beside SDL: follows the window of a host, and handles errors of the X server.
#include "app/display/sdl/sdl_private.h"

#include <SDL2/SDL_syswm.h>
#include <X11/Xlib.h>

#include <stdlib.h>

static const int64_t ask_period_ns = 250000000;

struct DipSdlHost {
    Display *display; // Connection to the X server for the host's window; SDL has its own.
    Window window;    // The host's window.
    Window child;
    int width; // Size of the child.
    int height;
    bool gone;
    bool hidden;
    int64_t asked_ns; // When the X server last said whether the child is hidden.
};

static int ignore_error(Display *display, XErrorEvent *event) {
    (void)display;
    (void)event;
    return 0;
}

static bool get_size(const DipSdlHost *host, int *width, int *height) {
    XWindowAttributes attributes;
    if (!XGetWindowAttributes(host->display, host->window, &attributes)) {
        return false;
    }
    *width = SDL_max(attributes.width, 1);
    *height = SDL_max(attributes.height, 1);
    return true;
}

static bool make_child(DipSdlHost *host, DipError *err) {
    if (!get_size(host, &host->width, &host->height)) {
        return dip_error_set(err, DIP_ERROR_MISSING, NULL, 0, "--window-id",
                             "there is no window %lu on the display %s", host->window,
                             DisplayString(host->display));
    }
    XSetWindowAttributes attributes = {.background_pixel = 0, .bit_gravity = NorthWestGravity};
    // The events that report the window's size are selected before the child is made, so that no
    // change is missed.
    XSelectInput(host->display, host->window, StructureNotifyMask);
    host->child = XCreateWindow(host->display, host->window, 0, 0, (unsigned)host->width,
                                (unsigned)host->height, 0, CopyFromParent, InputOutput,
                                CopyFromParent, CWBackPixel | CWBitGravity, &attributes);
    XStoreName(host->display, host->child, "Diptych");
    XMapWindow(host->display, host->child);
    XSync(host->display, False); // The child must exist before SDL looks it up on its own
                                 // connection.
    return true;
}

DipSdlHost *dip_sdl_host_open(unsigned long window_id, DipError *err) {
    DipSdlHost *host = calloc(1, sizeof *host);
    if (!host) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "--window-id", "out of memory");
        return NULL;
    }
    XSetErrorHandler(ignore_error);
    host->window = window_id;
    host->display = XOpenDisplay(NULL);
    if (!host->display) {
        dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "--window-id", "there is no X11 display");
    }
    if (!host->display || !make_child(host, err)) {
        dip_sdl_host_close(&host);
        return NULL;
    }
    return host;
}

void dip_sdl_host_close(DipSdlHost **host_pointer) {
    DipSdlHost *host = *host_pointer;
    if (!host) {
        return;
    }
    *host_pointer = NULL;
    if (host->display) {
        if (host->child) {
            XDestroyWindow(host->display, host->child);
        }
        XCloseDisplay(host->display);
    }
    free(host);
}

unsigned long dip_sdl_host_child(const DipSdlHost *host) {
    return host->child;
}

// Finds the X11 window of an SDL window. Returns false if SDL does not use X11.
static bool find_x11(SDL_Window *window, SDL_SysWMinfo *info) {
    SDL_VERSION(&info->version);
    return SDL_GetWindowWMInfo(window, info) && info->subsystem == SDL_SYSWM_X11;
}

bool dip_sdl_host_select(SDL_Window *window) {
    SDL_SysWMinfo info;
    XSetErrorHandler(ignore_error); // Replaces a handler that SDL may have set.
    if (!find_x11(window, &info)) {
        return false;
    }
    XSelectInput(info.info.x11.display, info.info.x11.window,
                 KeyPressMask | KeyReleaseMask | ButtonPressMask | ButtonReleaseMask |
                     PointerMotionMask | EnterWindowMask | LeaveWindowMask | FocusChangeMask |
                     ExposureMask | StructureNotifyMask | PropertyChangeMask);
    XSync(info.info.x11.display, False);
    return true;
}

bool dip_sdl_host_is_gone(DipSdlHost *host) {
    int width, height;
    host->gone = host->gone || !get_size(host, &width, &height);
    return host->gone;
}

bool dip_sdl_host_follow(DipSdlHost *host) {
    int width = host->width, height = host->height;
    while (!host->gone && XPending(host->display) > 0) {
        XEvent event;
        XNextEvent(host->display, &event);
        if (event.type == ConfigureNotify && event.xconfigure.window == host->window) {
            width = SDL_max(event.xconfigure.width, 1);
            height = SDL_max(event.xconfigure.height, 1);
        }
        host->gone = event.type == DestroyNotify && event.xdestroywindow.window == host->window;
    }
    if (!host->gone && (width != host->width || height != host->height)) {
        host->width = width;
        host->height = height;
        XResizeWindow(host->display, host->child, (unsigned)width, (unsigned)height);
        XFlush(host->display);
    }
    return !host->gone;
}

void dip_sdl_host_hide_child(const DipSdlHost *host) {
    XSetErrorHandler(ignore_error);
    XUnmapWindow(host->display, host->child);
    XSync(host->display, False); // After this, the event that the child is hidden waits on SDL's
                                 // connection.
}

// No event tells that a window around the host's window was unmapped, so the X server is asked.
bool dip_sdl_host_is_hidden(DipSdlHost *host, int64_t now_ns) {
    XWindowAttributes attributes;
    if (now_ns - host->asked_ns >= ask_period_ns) {
        host->asked_ns = now_ns;
        host->hidden = XGetWindowAttributes(host->display, host->child, &attributes) &&
                       attributes.map_state != IsViewable;
    }
    return host->hidden;
}

bool dip_sdl_host_take_focus(const DipSdlHost *host) {
    Window before = None;
    int revert;
    XGetInputFocus(host->display, &before, &revert);
    XSetInputFocus(host->display, host->child, RevertToParent, CurrentTime);
    XFlush(host->display);
    return before != host->child;
}

// --- errors of the X server ----------------------------------------------------------------------

// These variables are global, because Xlib passes no context to an error handler.
static Window own_window; // The window of dip_sdl_x_errors_watch, or None.
static XErrorHandler previous_handler;
static bool closes; // True while own_window is being closed.

static int handle_error(Display *display, XErrorEvent *event) {
    if (event->error_code == BadWindow && (closes || event->resourceid != own_window)) {
        return 0;
    }
    return previous_handler(display, event);
}

void dip_sdl_x_errors_watch(SDL_Window *own) {
    SDL_SysWMinfo info;
    if (own_window == None && find_x11(own, &info)) {
        own_window = info.info.x11.window;
        previous_handler = XSetErrorHandler(handle_error);
    }
}

// SDL uses a second connection to send the window the event that ends a wait for events. The X
// server should handle that event before the window is destroyed, so this function waits: it makes
// several round trips on the first connection.
void dip_sdl_x_errors_close(SDL_Window *own) {
    SDL_SysWMinfo info;
    closes = true;
    if (own && find_x11(own, &info)) {
        for (int i = 0; i < 4; i++) {
            XSync(info.info.x11.display, False);
            SDL_Delay(5);
        }
    }
}

void dip_sdl_x_errors_end(void) {
    closes = false;
    if (own_window != None) {
        XSetErrorHandler(previous_handler);
        own_window = None;
    }
}
