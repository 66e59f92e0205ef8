// Implements the display with a window of SDL: opens and closes it and copies pixels to it.
#include "app/display/sdl/sdl_display.h"

#include "app/display/sdl/sdl_private.h"
#include "renderer/base/clock.h"

#include <SDL2/SDL.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MIN_WINDOW_WIDTH = 320,
    MIN_WINDOW_HEIGHT = 160,
    MAX_RECTS = 16,
    // A screen with fewer bits per pixel has a palette, and SDL cannot draw pictures on it.
    MIN_BITS_PER_PIXEL = 15
};

typedef struct SdlDisplay {
    SDL_Window *window;
    DipSdlHost *host;   // The window of another program that holds this one, or NULL.
    char *dropped_file; // File name of the last event, if that event was a DROP; otherwise NULL.
    bool sdl_open;
} SdlDisplay;

static bool sdl_failed(DipError *err) {
    return dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "preview",
                         "there is no display to open a window on (%s); `--display terminal` shows "
                         "the preview in a terminal, and `diptych dump` draws without either",
                         SDL_GetError());
}

// --- opening and closing -----------------------------------------------------------------------

// Without a display, SDL falls back to a driver that shows nothing. Such a driver counts as a
// display only if the user chose the driver with SDL_VIDEODRIVER.
static bool has_display(void) {
    const char *driver = SDL_GetCurrentVideoDriver();
    const bool shows_nothing =
        !driver || strcmp(driver, "offscreen") == 0 || strcmp(driver, "dummy") == 0;
    return !shows_nothing || SDL_getenv("SDL_VIDEODRIVER");
}

static bool open_sdl(SdlDisplay *sdl, bool in_host, DipError *err) {
    if (in_host) {
        // A click that gives the window the focus is still a click.
        SDL_SetHint(SDL_HINT_MOUSE_FOCUS_CLICKTHROUGH, "1");
        SDL_SetHint(SDL_HINT_VIDEODRIVER, "x11");
    }
    SDL_SetHint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "1");
    if (SDL_Init(SDL_INIT_VIDEO) != 0) {
        return sdl_failed(err);
    }
    sdl->sdl_open = true;
    if (!has_display()) {
        SDL_SetError("neither DISPLAY nor WAYLAND_DISPLAY leads to one");
        return sdl_failed(err);
    }
    // An X server takes pixels directly from shared memory. SDL can also present pixels through
    // OpenGL, but that costs memory and, without a graphics card, a third of the frame rate. On
    // other window systems, SDL can only use OpenGL.
    if (strcmp(SDL_GetCurrentVideoDriver(), "x11") == 0) {
        SDL_SetHint(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0");
    }
    dip_sdl_controller_init();
    return true;
}

static bool has_enough_colours(DipError *err) {
    SDL_DisplayMode mode;
    if (SDL_GetCurrentDisplayMode(0, &mode) != 0) {
        return true; // The attempt to open the window will report the error.
    }
    return SDL_BITSPERPIXEL(mode.format) >= MIN_BITS_PER_PIXEL ||
           dip_error_set(
               err, DIP_ERROR_RUNTIME, NULL, 0, "preview",
               "the display has too few colours: the window needs %d bits per pixel or more; "
               "`diptych dump` draws without a display",
               MIN_BITS_PER_PIXEL);
}

static bool open_window(SdlDisplay *sdl, int width, int height, DipError *err) {
    SDL_Rect usable;
    if (SDL_GetDisplayUsableBounds(0, &usable) == 0) {
        width = dip_min(width, usable.w);
        height = dip_min(height, usable.h);
    }
    sdl->window = SDL_CreateWindow("Diptych", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, width,
                                   height, SDL_WINDOW_RESIZABLE);
    if (!sdl->window) {
        return sdl_failed(err);
    }
    dip_sdl_x_errors_watch(sdl->window);
    SDL_SetWindowMinimumSize(sdl->window, MIN_WINDOW_WIDTH, MIN_WINDOW_HEIGHT);
    return SDL_GetWindowSurface(sdl->window) || sdl_failed(err);
}

// Makes a child of the host's window, and an SDL window from that child.
static bool open_in_host(SdlDisplay *sdl, unsigned long window_id, DipError *err) {
    sdl->host = dip_sdl_host_open(window_id, err);
    if (!sdl->host) {
        return false;
    }
    sdl->window = SDL_CreateWindowFrom((void *)(uintptr_t)dip_sdl_host_child(sdl->host));
    return (sdl->window && dip_sdl_host_select(sdl->window) && SDL_GetWindowSurface(sdl->window)) ||
           sdl_failed(err);
}

// Returns whether SDL can destroy its window without waiting for ever. SDL first hides a visible
// window and waits for the X server to confirm that. If the host has closed its window meanwhile,
// the confirmation never comes. This function therefore hides the child itself. If SDL does not
// learn that its window is hidden, the child no longer exists.
static bool can_quit(SdlDisplay *sdl) {
    if (sdl->host && sdl->window) {
        dip_sdl_host_hide_child(sdl->host);
        SDL_PumpEvents();
        return (SDL_GetWindowFlags(sdl->window) & SDL_WINDOW_SHOWN) == 0;
    }
    return true;
}

static void close_display(void *context) {
    SdlDisplay *sdl = context;
    const bool quits = can_quit(sdl);
    dip_sdl_x_errors_close(sdl->window);
    SDL_free(sdl->dropped_file);
    if (sdl->window && quits) {
        SDL_DestroyWindow(sdl->window);
    }
    if (sdl->sdl_open && quits) {
        SDL_Quit();
    }
    dip_sdl_x_errors_end(); // Until SDL_Quit has closed SDL's connection, errors of SDL's last
                            // requests may arrive.
    dip_sdl_host_close(&sdl->host);
    free(sdl);
}

// --- pixels ------------------------------------------------------------------------------------

// Copies pixels with red and blue swapped. Most screens need no other conversion.
static void copy_swapped(uint8_t *restrict to, const uint8_t *restrict from, int count) {
    for (int i = 0; i < count; ++i) {
        uint32_t pixel;
        memcpy(&pixel, from + 4 * i, sizeof pixel);
        pixel = (pixel & 0xff00ff00u) | (pixel << 16 & 0xff0000u) | (pixel >> 16 & 0xffu);
        memcpy(to + 4 * i, &pixel, sizeof pixel);
    }
}

static bool has_swapped_bytes(Uint32 format) {
    return SDL_BYTEORDER == SDL_LIL_ENDIAN &&
           (format == SDL_PIXELFORMAT_RGB888 || format == SDL_PIXELFORMAT_ARGB8888);
}

// Copies a rectangle of the picture to the same place of the window's surface.
static bool copy_rect(SDL_Surface *surface, const DipPixels *picture, DipRect rect) {
    const Uint32 format = surface->format->format;
    uint8_t *to = (uint8_t *)surface->pixels + (ptrdiff_t)rect.y * surface->pitch +
                  (ptrdiff_t)rect.x * surface->format->BytesPerPixel;
    const uint8_t *from =
        picture->rgba8 + (size_t)rect.y * picture->stride_bytes + 4 * (size_t)rect.x;
    if (!has_swapped_bytes(format)) {
        return SDL_ConvertPixels(rect.width, rect.height, SDL_PIXELFORMAT_RGBA32, from,
                                 (int)picture->stride_bytes, format, to, surface->pitch) == 0;
    }
    for (int y = 0; y < rect.height; ++y) {
        copy_swapped(to + (ptrdiff_t)y * surface->pitch, from + (size_t)y * picture->stride_bytes,
                     rect.width);
    }
    return true;
}

// Copies at most MAX_RECTS damage rectangles to the window's surface. SDL then sends them to the
// screen.
static bool show_rects(SDL_Window *window, SDL_Surface *surface, const DipPixels *picture,
                       const DipRect *damage, int count) {
    const DipRect both = dip_rect_intersect((DipRect){0, 0, surface->w, surface->h},
                                            (DipRect){0, 0, picture->width, picture->height});
    SDL_Rect rects[MAX_RECTS];
    int rect_count = 0;
    for (int i = 0; i < count; ++i) {
        const DipRect rect = dip_rect_intersect(damage[i], both);
        if (dip_rect_is_empty(rect)) {
            continue;
        }
        if (!copy_rect(surface, picture, rect)) {
            return false;
        }
        rects[rect_count++] = (SDL_Rect){rect.x, rect.y, rect.width, rect.height};
    }
    return rect_count == 0 || SDL_UpdateWindowSurfaceRects(window, rects, rect_count) == 0;
}

// Gets the surface anew each time, since it changes with the window's size.
static bool present(void *context, const DipPixels *picture, const DipRect *damage, int count,
                    DipError *err) {
    SdlDisplay *sdl = context;
    SDL_Surface *surface = SDL_GetWindowSurface(sdl->window);
    bool shown = surface != NULL;
    for (int i = 0; shown && i < count; i += MAX_RECTS) {
        shown =
            show_rects(sdl->window, surface, picture, damage + i, dip_min(count - i, MAX_RECTS));
    }
    // A host may close its window at any time. next_event then returns QUIT.
    return shown || (sdl->host && dip_sdl_host_is_gone(sdl->host)) ||
           dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "preview", "%s", SDL_GetError());
}

// --- the display's other functions --------------------------------------------------------------

static bool next_event(void *context, int timeout_ms, DipEvent *event) {
    SdlDisplay *sdl = context;
    SDL_Event sdl_event;
    SDL_free(sdl->dropped_file);
    sdl->dropped_file = NULL;
    if (sdl->host && !dip_sdl_host_follow(sdl->host)) {
        *event = (DipEvent){.kind = DIP_EVENT_QUIT};
        return true;
    }
    const int found =
        timeout_ms > 0 ? SDL_WaitEventTimeout(&sdl_event, timeout_ms) : SDL_PollEvent(&sdl_event);
    if (!found) {
        return false;
    }
    *event = dip_sdl_event_translate(&sdl_event);
    if (sdl->host && event->kind == DIP_EVENT_MOUSE_DOWN) {
        event->focuses = dip_sdl_host_take_focus(sdl->host);
    }
    if (event->kind == DIP_EVENT_DROP) {
        sdl->dropped_file = sdl_event.drop.file;
    }
    return true;
}

static void size(void *context, int *width, int *height) {
    const SdlDisplay *sdl = context;
    SDL_GetWindowSizeInPixels(sdl->window, width, height);
    *width = dip_max(*width, 1);
    *height = dip_max(*height, 1);
}

// Returns the number of pixels per unit of the window's size. The number is 1 unless the system
// scales windows.
static double scale(void *context) {
    const SdlDisplay *sdl = context;
    int width = 0, height = 0, units = 0;
    SDL_GetWindowSizeInPixels(sdl->window, &width, &height);
    SDL_GetWindowSize(sdl->window, &units, NULL);
    return width > 0 && units > 0 ? (double)width / units : 1.0;
}

static double refresh_hz(void *context) {
    const SdlDisplay *sdl = context;
    SDL_DisplayMode mode;
    const int index = SDL_GetWindowDisplayIndex(sdl->window);
    const bool known = index >= 0 && SDL_GetCurrentDisplayMode(index, &mode) == 0;
    return known && mode.refresh_rate > 0 ? mode.refresh_rate : 60.0;
}

static bool is_hidden(void *context) {
    const SdlDisplay *sdl = context;
    return sdl->host ? dip_sdl_host_is_hidden(sdl->host, dip_clock_ns())
                     : (SDL_GetWindowFlags(sdl->window) &
                        (SDL_WINDOW_HIDDEN | SDL_WINDOW_MINIMIZED)) != 0;
}

static bool set_clipboard(void *context, const char *text) {
    (void)context;
    return SDL_SetClipboardText(text) == 0;
}

static bool get_clipboard(void *context, char *text, size_t size_bytes) {
    (void)context;
    char *held = SDL_GetClipboardText();
    const bool found = held && held[0];
    snprintf(text, size_bytes, "%s", found ? held : "");
    SDL_free(held);
    return found;
}

static void set_title(void *context, const char *title) {
    const SdlDisplay *sdl = context;
    SDL_SetWindowTitle(sdl->window, title);
}

static void set_full_screen(void *context, bool on) {
    const SdlDisplay *sdl = context;
    SDL_SetWindowFullscreen(sdl->window, on ? SDL_WINDOW_FULLSCREEN_DESKTOP : 0);
}

static void set_size(void *context, int width, int height) {
    const SdlDisplay *sdl = context;
    SDL_SetWindowSize(sdl->window, width, height);
}

static DipDisplay display_of(SdlDisplay *sdl) {
    return (DipDisplay){
        .context = sdl,
        .present = present,
        .next_event = next_event,
        .size = size,
        .scale = scale,
        .refresh_hz = refresh_hz,
        .is_hidden = is_hidden,
        // The host decides the size of its windows.
        .set_full_screen = sdl->host ? NULL : set_full_screen,
        .set_size = sdl->host ? NULL : set_size,
        .set_title = sdl->host ? NULL : set_title,
        .set_clipboard = set_clipboard,
        .get_clipboard = get_clipboard,
        .close = close_display,
    };
}

bool dip_sdl_display_open(DipDisplay *display, unsigned long window_id, int width, int height,
                          DipError *err) {
    SdlDisplay *sdl = calloc(1, sizeof *sdl);
    if (!sdl) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "preview", "out of memory");
    }
    if (!open_sdl(sdl, window_id != 0, err) || !has_enough_colours(err) ||
        !(window_id ? open_in_host(sdl, window_id, err) : open_window(sdl, width, height, err))) {
        close_display(sdl);
        return false;
    }
    *display = display_of(sdl);
    return true;
}

bool dip_sdl_display_has_lost_host(const DipDisplay *display) {
    const SdlDisplay *sdl = display->context;
    return sdl->host && dip_sdl_host_is_gone(sdl->host);
}
