// The window through SDL.
#include "app/preview/window.h"

#include "app/files/png.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { DIVIDER_PX = 2, MIN_WINDOW_WIDTH = 320, MIN_WINDOW_HEIGHT = 160, MAX_SCREENSHOTS = 9999 };

struct DipWindow {
    SDL_Window *window;
    SDL_Renderer *renderer;
    SDL_Texture *pictures[DIP_PANE_COUNT];
    int picture_width[DIP_PANE_COUNT];
    int picture_height[DIP_PANE_COUNT];
    DipText *text;
    bool sdl_open;
};

static bool sdl_failed(DipError *err) {
    return dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "preview",
                         "there is no display to open a window on (%s); `diptych dump` draws "
                         "without one",
                         SDL_GetError());
}

// SDL falls back to drivers that show nothing; they count only when the user asked for one.
static bool has_display(void) {
    const char *driver = SDL_GetCurrentVideoDriver();
    const bool shows_nothing =
        !driver || strcmp(driver, "offscreen") == 0 || strcmp(driver, "dummy") == 0;
    return !shows_nothing || SDL_getenv("SDL_VIDEODRIVER");
}

// Software presenting: the pictures come from this processor anyway, and no driver is needed.
static bool open_window(DipWindow *window, int width, int height, DipError *err) {
    SDL_SetHint(SDL_HINT_RENDER_SCALE_QUALITY, "nearest");
    SDL_SetHint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "1");
    if (SDL_Init(SDL_INIT_VIDEO) != 0) {
        return sdl_failed(err);
    }
    window->sdl_open = true;
    if (!has_display()) {
        SDL_SetError("neither DISPLAY nor WAYLAND_DISPLAY leads to one");
        return sdl_failed(err);
    }
    // X takes pixels as they are; SDL's other way, through OpenGL, costs memory and, without a
    // graphics card, a third of the frames. Other displays know only that way.
    if (strcmp(SDL_GetCurrentVideoDriver(), "x11") == 0) {
        SDL_SetHint(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0");
    }
    SDL_Rect usable;
    if (SDL_GetDisplayUsableBounds(0, &usable) == 0) {
        width = width > usable.w ? usable.w : width;
        height = height > usable.h ? usable.h : height;
    }
    window->window = SDL_CreateWindow("Diptych", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                                      width, height, SDL_WINDOW_RESIZABLE);
    if (!window->window) {
        return sdl_failed(err);
    }
    SDL_SetWindowMinimumSize(window->window, MIN_WINDOW_WIDTH, MIN_WINDOW_HEIGHT);
    window->renderer = SDL_CreateRenderer(window->window, -1, SDL_RENDERER_SOFTWARE);
    return window->renderer || sdl_failed(err);
}

DipWindow *dip_window_create(int pane_width, int pane_height, DipError *err) {
    DipWindow *window = calloc(1, sizeof *window);
    if (!window) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "preview", "out of memory");
        return NULL;
    }
    if (!open_window(window, 2 * pane_width + DIVIDER_PX, pane_height, err) ||
        !(window->text = dip_text_create(window->renderer, err))) {
        dip_window_destroy(&window);
    }
    return window;
}

void dip_window_destroy(DipWindow **window_pointer) {
    DipWindow *window = *window_pointer;
    if (!window) {
        return;
    }
    *window_pointer = NULL;
    dip_text_destroy(&window->text);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        if (window->pictures[p]) {
            SDL_DestroyTexture(window->pictures[p]);
        }
    }
    if (window->renderer) {
        SDL_DestroyRenderer(window->renderer);
    }
    if (window->window) {
        SDL_DestroyWindow(window->window);
    }
    if (window->sdl_open) {
        SDL_Quit();
    }
    free(window);
}

static void pane_rects(const DipWindow *window, SDL_Rect panes[DIP_PANE_COUNT]) {
    int width = 0;
    int height = 0;
    SDL_GetRendererOutputSize(window->renderer, &width, &height);
    const int pane_width = width > DIVIDER_PX + 2 ? (width - DIVIDER_PX) / 2 : 1;
    height = height > 1 ? height : 1;
    panes[DIP_PANE_CURRENT] = (SDL_Rect){0, 0, pane_width, height};
    panes[DIP_PANE_REQUESTED] = (SDL_Rect){width - pane_width, 0, pane_width, height};
}

void dip_window_pane_size(const DipWindow *window, int *width, int *height) {
    SDL_Rect panes[DIP_PANE_COUNT];
    pane_rects(window, panes);
    // A window may be wider than a picture may be; what is drawn is then scaled up.
    *width = panes[0].w < DIP_MAX_FRAME_SIZE ? panes[0].w : DIP_MAX_FRAME_SIZE;
    *height = panes[0].h < DIP_MAX_FRAME_SIZE ? panes[0].h : DIP_MAX_FRAME_SIZE;
}

int dip_window_pane_at(const DipWindow *window, int x) {
    SDL_Rect panes[DIP_PANE_COUNT];
    pane_rects(window, panes);
    return x < panes[DIP_PANE_REQUESTED].x ? DIP_PANE_CURRENT : DIP_PANE_REQUESTED;
}

bool dip_window_set_picture(DipWindow *window, int pane, const DipFrame *frame, DipError *err) {
    SDL_Texture **picture = &window->pictures[pane];
    if (!*picture || window->picture_width[pane] != frame->width ||
        window->picture_height[pane] != frame->height) {
        if (*picture) {
            SDL_DestroyTexture(*picture);
        }
        *picture = SDL_CreateTexture(window->renderer, SDL_PIXELFORMAT_RGBA32,
                                     SDL_TEXTUREACCESS_STREAMING, frame->width, frame->height);
        window->picture_width[pane] = frame->width;
        window->picture_height[pane] = frame->height;
    }
    if (!*picture ||
        SDL_UpdateTexture(*picture, NULL, frame->rgba8, (int)frame->stride_bytes) != 0) {
        return dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "preview", "%s", SDL_GetError());
    }
    return true;
}

static void draw(DipWindow *window, const DipPreviewState *state,
                 const DipPaneFigures figures[DIP_PANE_COUNT]) {
    SDL_Rect panes[DIP_PANE_COUNT];
    pane_rects(window, panes);
    SDL_SetRenderDrawColor(window->renderer, 10, 11, 14, 255);
    SDL_RenderClear(window->renderer);
    for (int p = 0; p < DIP_PANE_COUNT; ++p) {
        if (window->pictures[p]) {
            SDL_SetTextureBlendMode(window->pictures[p], SDL_BLENDMODE_NONE);
            SDL_RenderCopy(window->renderer, window->pictures[p], NULL, &panes[p]);
        }
    }
    dip_overlay_draw(window->renderer, window->text, state, panes, figures);
}

void dip_window_present(DipWindow *window, const DipPreviewState *state,
                        const DipPaneFigures figures[DIP_PANE_COUNT]) {
    draw(window, state, figures);
    SDL_RenderPresent(window->renderer);
}

static bool free_name(char *file, size_t size_bytes) {
    for (int i = 1; i <= MAX_SCREENSHOTS; ++i) {
        snprintf(file, size_bytes, "diptych-%04d.png", i);
        if (access(file, F_OK) != 0) {
            return true;
        }
    }
    return false;
}

bool dip_window_screenshot(DipWindow *window, const DipPreviewState *state,
                           const DipPaneFigures figures[DIP_PANE_COUNT], char *file,
                           size_t size_bytes, DipError *err) {
    int width = 0;
    int height = 0;
    if (SDL_GetRendererOutputSize(window->renderer, &width, &height) != 0 || width < 1 ||
        height < 1 || !free_name(file, size_bytes)) {
        return dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, "screenshot",
                             "no file name is free, or the window is closed");
    }
    const size_t stride_bytes = 4 * (size_t)width;
    uint8_t *pixels = malloc(stride_bytes * (size_t)height);
    if (!pixels) {
        return dip_error_set(err, DIP_ERROR_MEMORY, file, 0, "screenshot", "out of memory");
    }
    draw(window, state, figures);
    const DipFrame frame = {
        .rgba8 = pixels, .stride_bytes = stride_bytes, .width = width, .height = height};
    bool done = SDL_RenderReadPixels(window->renderer, NULL, SDL_PIXELFORMAT_RGBA32, pixels,
                                     (int)stride_bytes) == 0 ||
                dip_error_set(err, DIP_ERROR_RUNTIME, file, 0, "screenshot", "%s", SDL_GetError());
    done = done && dip_png_write(file, &frame, err);
    free(pixels);
    return done;
}

void dip_window_full_screen(DipWindow *window, bool on) {
    SDL_SetWindowFullscreen(window->window, on ? SDL_WINDOW_FULLSCREEN_DESKTOP : 0);
}

int64_t dip_window_refresh_ns(const DipWindow *window) {
    SDL_DisplayMode mode;
    const int display = SDL_GetWindowDisplayIndex(window->window);
    const bool known = display >= 0 && SDL_GetCurrentDisplayMode(display, &mode) == 0;
    return 1000000000 / (known && mode.refresh_rate > 0 ? mode.refresh_rate : 60);
}
